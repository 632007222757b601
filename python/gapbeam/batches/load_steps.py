"""Load steps of a scene whose cases need not be followed: which of them can change an outcome.

The loads under which a beam on one-sided supports stands are a convex set; where a step must be kept, it is one of few.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import inf
from typing import Any

from msgspec.structs import replace

from ..base.errors import GapbeamError
from ..results.stepping import solve
from ..scene.analysis import Analysis
from ..scene.names import DEAD, cases_of
from ..scene.reading import read_scene
from ..scene.structs import Scene
from .paths import KeyPath, varies_by_case


def is_held(scene: Scene) -> bool:
    """Whether what holds both ways keeps the beam from moving, so that it can stand under any loads.

    Parameters
    ----------
    scene : Scene
        As it is solved.
    """
    supports, foundation = (
        [one for one in items if one.side == "both" and one.law is None] for items in (scene.supports, scene.foundation)
    )
    alone = replace(
        scene, supports=supports, foundation=foundation, loads=[], trains=[], combinations=[], analysis=Analysis()
    )
    try:
        return not solve(alone).steps[-1].indifferent
    except GapbeamError:
        return False


def shares_before(scene: Scene) -> list[float]:
    """Give the shares of the live loads at which a beam has to stand, before all of them act, for all load steps to stand.

    Parameters
    ----------
    scene : Scene
        As it is solved.

    Returns
    -------
    list of float
        The loads under which supports without laws have an equilibrium are a convex set, in which no load is: where the first
        step stands and the last one, those between do, and without dead loads the last one is enough.
    """
    steps = scene.analysis.steps
    if any(one.law is not None for one in (*scene.supports, *scene.foundation)) or _is_rigid(scene):
        return [k / steps for k in range(1, steps)]
    return [1 / steps] if steps > 1 and DEAD in cases_of(scene.loads) else []


def _is_rigid(scene: Scene) -> bool:
    """Whether any stretch is rigid, so that statics may not tell the reactions of some scheme on the way apart."""
    given = [scene.beam.EI, *(one.EI for one in scene.sections)]
    return any(inf in (one if isinstance(one, list | tuple) else [one]) for one in given)


def at_once(scene: dict[str, Any], paths: Sequence[KeyPath]) -> dict[str, Any]:
    """Leave out load steps that change nothing.

    Parameters
    ----------
    scene : dict
        As plain data, of a case that is solved as a scene of its own.
    paths : sequence of KeyPath
        What varies by case.

    Returns
    -------
    dict
        With one load step where whether a case is solved, and its state then, do not depend on those before it.
    """
    analysis = scene["analysis"]
    if analysis["steps"] == 1 or analysis["follow"] != "steps" or analysis["history"] != [1.0]:
        return scene
    if not all(path.parts[0] in ("combinations", "trains") or varies_by_case(scene, path) for path in paths):
        return scene
    loose = any(path.parts[0] == "supports" and path.parts[2] == "stiffness" for path in paths)
    solved = read_scene(scene)
    before = shares_before(solved)
    if before and (loose or len(before) > 1 or not is_held(solved)):
        return scene
    return {**scene, "analysis": {**analysis, "steps": 1}}
