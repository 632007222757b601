"""Starts and rules of the search for the supports that act."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...base.errors import SceneError
from ...engine.beam import RULES, Beam
from ...scene.structs import Scene
from ...scene.wording import shown
from .arguments import scheme


def choose_rule(scene: Scene, rule: str | None) -> str:
    """Take the rule that the caller gives, or else that of the scene.

    Parameters
    ----------
    scene : Scene
    rule : str or None
        What the caller gives.

    Returns
    -------
    str
        ``block`` or ``single``.

    Raises
    ------
    SceneError
        There is no such rule.
    """
    rule = scene.analysis.rule if rule is None else rule
    if not isinstance(rule, str) or rule not in RULES:
        raise SceneError("rule", f"expected one of {', '.join(RULES)}, got {shown(rule)}")
    return rule


def starting_scheme(beam: Beam, start: Sequence[bool] | None = None) -> np.ndarray:
    """Give the scheme from which the first search starts.

    Parameters
    ----------
    beam : Beam
    start : sequence of bool, optional
        As for `solve`; default all closed, laws on their first piece.
    """
    closed = np.ones(beam.supports, dtype=np.int32)
    if start is None:
        for breakpoints, middle, _ in beam.laws.values() if beam.has_laws else ():
            closed[breakpoints.start + max(middle, 1) : breakpoints.stop] = 0  # on its first piece
        return closed
    one_sided = np.flatnonzero(beam.sides)
    of_all = np.ones(beam.scene_supports, dtype=np.int32)
    of_all[one_sided] = scheme(start, len(one_sided), "one-sided support")
    return of_all[beam.numbers]
