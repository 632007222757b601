"""Sides and directions of supports: their words and codes."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..base.errors import SceneError

SIDES = {
    "both": 0, "below": 1, "above": -1, "left": 1, "right": -1, "counterclockwise": 1, "clockwise": -1, "sagging": 1,
    "hogging": -1,
}  # fmt: skip
DIRECTIONS = {"normal": 0, "axial": 1, "rotational": 2, "hinge": 3}
AT_HINGE = {None: 0, "left": 2, "right": 3}
"""What is added to the direction of one that holds a rotation, by the side of a hinge."""
ONE_WAY = {
    "normal": ("below", "above"), "axial": ("left", "right"), "rotational": ("counterclockwise", "clockwise"),
    "hinge": ("sagging", "hogging", "counterclockwise", "clockwise"),
}  # fmt: skip
"""Sides of supports that act one way, by their direction."""
WHAT = {
    "normal": "a support across the beam is below or above it", "axial": "an axial support pushes to the left or to the right",
    "rotational": "a support that holds the rotation turns the beam counterclockwise or clockwise",
    "hinge": "a hinge takes sagging or hogging moments",
}  # fmt: skip


def refuse_sides(sides: Any, codes: np.ndarray) -> None:
    """Refuse sides of another direction: an axial support that is below, one across the beam that pushes to the left.

    Parameters
    ----------
    sides : numpy.ndarray, list of str or str
        Of all supports.
    codes : numpy.ndarray
        Their columns of whole numbers, with one more at the end: side and direction first.

    Raises
    ------
    SceneError
        There is one.
    """
    words = np.asarray(sides)
    if not codes[1, :-1].any() and np.isin(words, ("both", *ONE_WAY["normal"])).all():
        return
    for direction, ways in ONE_WAY.items():
        of_it = codes[1, :-1] == DIRECTIONS[direction]
        wrong = np.flatnonzero(of_it & (codes[0, :-1] != 0) & ~np.isin(words, ways))
        if not len(wrong):
            continue
        i = int(wrong[0])
        side = sides if isinstance(sides, str) else sides[i]
        other = ', or direction = "axial"' if direction == "normal" and side in ONE_WAY["axial"] else ""
        both = "" if direction == "normal" else ' or "both"'
        ask = f'"{ways[0]}", "{ways[1]}"{both}' if both else f'"{ways[0]}" or "{ways[1]}"'
        raise SceneError(f"supports[{i}].side", f'{WHAT[direction]}; use side = {ask}{other}, got "{side}"')
