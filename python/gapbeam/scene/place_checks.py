"""Checks of scenes: can what stands at the same place stand there together.

What is at the same place is what has the same point (`places`), as when the scene is solved.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..base.errors import SceneError
from .checks import Rows, contact_levels, rotational_stiffnesses
from .places import POSITION_TOLERANCE, Points, find_points
from .wording import number

if TYPE_CHECKING:
    from .structs import Scene


def check_places(scene: Scene) -> None:
    """Refuse a scene in which parts at the same place contradict each other.

    Parameters
    ----------
    scene : Scene
        Every value makes sense by itself, and every place is on the beam.

    Raises
    ------
    SceneError
        Of several errors the first one found.
    """
    ends = scene.span_ends()
    points = find_points(scene, ends)
    for first, second in _twice(points.hinges, np.arange(len(points.hinges)))[:1]:
        there = f"at x = {number(scene.beam.hinges[second])} there is a hinge already (beam.hinges[{first}])"
        raise SceneError(f"beam.hinges[{second}]", f"{there}; remove one of them")
    _check_stretches(Rows("sections", scene.sections), points.section_from, points.section_to, ends[-1])
    _check_supports(scene, points)
    along = np.array([not hasattr(load, "node") for load in scene.loads], dtype=bool)
    stretches = Rows("loads", [scene.loads[k] for k in np.flatnonzero(along)], np.flatnonzero(along).tolist())
    _check_stretches(stretches, points.load_from[along], points.load_to[along], ends[-1])
    for k in np.flatnonzero(np.isin(points.load_from, points.hinges) & ~along):
        if hasattr(scene.loads[k], "M"):
            there = f"the moment acts exactly at the hinge at x = {number(scene.positions([scene.loads[k]])[0])}"
            problem = f"{there}, so it is open which side takes it; put it on one side of the hinge"
            raise SceneError(f"loads[{k}]", problem)


def _twice(points: np.ndarray, chosen: np.ndarray) -> list[tuple[int, int]]:
    """Pairs of the chosen that are at the same point, from left to right."""
    order = chosen[np.argsort(points[chosen], kind="stable")]
    same = np.flatnonzero(np.diff(points[order]) == 0)
    return [(int(order[k]), int(order[k + 1])) for k in same]


def _check_stretches(rows: Rows, start: np.ndarray, stop: np.ndarray, end: float) -> None:
    """Refuse a stretch that begins and ends at one point, or ends before it begins."""
    for row in np.flatnonzero(start >= stop)[:1]:
        item = rows.items[row]
        stretch = f"from = {number(item.from_)} to = {number(end if item.to is None else item.to)}"
        raise SceneError(rows.path(row), f"the stretch {stretch} has no length; from must be less than to")


def _check_supports(scene: Scene, points: Points) -> None:
    """Check supports at the same point, and at hinges."""
    items = scene.supports
    rows, x = Rows("supports", items), scene.positions(items)
    stiffness, turn = np.array([item.stiffness for item in items], dtype=float), rotational_stiffnesses(items)
    side = np.array([item.side for item in items], dtype=object)
    axial = np.array([item.direction == "axial" for item in items], dtype=bool)
    held_hinge = (turn > 0) & np.isin(points.supports, points.hinges)
    rows.refuse_first(held_hinge, "rotation", "there is a hinge here, so it is open which side is held; move one aside")
    rigid = {name: np.isinf(stiffness) & ~axial & (side == name) for name in ("both", "below", "above")}
    for chosen, what in (
        (axial, "hold the beam horizontally"),
        (np.isinf(turn), "hold the rotation of the beam rigidly"),
        *((chosen, f'are rigid with side = "{name}"') for name, chosen in rigid.items()),
    ):
        for first, second in _twice(points.supports, np.flatnonzero(chosen))[:1]:
            twice = f"this one and {rows.path(first)} both stand at x = {number(x[second])} and {what}"
            raise SceneError(rows.path(second), f"{twice}; remove one of them")
    level = contact_levels(items)
    for lower, upper in (("below", "above"), ("below", "both"), ("both", "above")):
        _, low, high = np.intersect1d(
            *(points.supports[rigid[name]] for name in (lower, upper)), assume_unique=True, return_indices=True
        )
        low, high = np.flatnonzero(rigid[lower])[low], np.flatnonzero(rigid[upper])[high]
        stop, start = level[low], level[high]
        slack = POSITION_TOLERANCE * np.maximum(np.abs(stop), np.abs(start))
        tight = stop - start < -slack if "both" not in (lower, upper) else stop - start <= slack
        for k in np.flatnonzero(tight)[:1]:
            here = f"this one ({lower}, acts at a deflection of {number(stop[k])})"
            there = f"{rows.path(high[k])} ({upper}, acts at {number(start[k])})"
            problem = f"{here} and {there} leave no room at x = {number(x[low[k]])}; give a greater gap"
            raise SceneError(rows.path(low[k]), problem)
