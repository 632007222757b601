"""Follow the load of one beam: at factors 1/n, 2/n, ..., 1, each step starting from the last scheme, or from event to event."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress

import numpy as np

from ..base.errors import WITHOUT_ANSWER, EngineError, SceneError, Status
from ..engine.arrays import Solution
from ..engine.beam import RULES, Beam
from ..scene.structs import Scene
from ..scene.wording import shown
from .arguments import scheme
from .branches import follow_branches
from .compression import check_compression
from .ground_path import follow_on_ground
from .path import follow
from .result import Result
from .step import solve_step
from .steps import LoadSteps, PathSteps
from .trains import refuse_trains


def follow_load(scene: Scene, beam: Beam, rule: str, closed: np.ndarray) -> Result:
    """Solve a beam as its scene says: by load steps, or from event to event.

    Parameters
    ----------
    scene : Scene
        Checked.
    beam : Beam
        Made of it.
    rule : {"block", "single"}
        How the working scheme is found.
    closed : numpy.ndarray of int
        From `starting_scheme`.

    Returns
    -------
    Result

    Raises
    ------
    SceneError
        What is asked for cannot be had for this beam.
    EngineError
        No unique answer exists.
    """
    result = Result(scene, beam, rule)
    if beam.ground_layers:
        _refuse_on_ground(scene, beam)
    refuse_trains(scene, beam)
    if not scene.trains:
        _follow(result, closed)
        check_compression(result)
        return result
    result.trains.pass_all()
    try:
        _follow(result, closed)
        check_compression(result)
    except EngineError as error:
        if error.status not in WITHOUT_ANSWER:
            raise
        advice = "; or give it loads that stay, such as its own weight, and have them in every combination"
        more = advice if error.status == Status.NOT_CONVERGED else ""
        raise EngineError(f"without its trains {error}{more}", error.status) from None
    result.take_trains()
    return result


def _follow(result: Result, closed: np.ndarray) -> Result:
    """Follow the load of a beam without its trains."""
    scene, beam, rule = result.scene, result.beam, result.rule
    if beam.depends_on_path or scene.analysis.history != [1.0]:
        return _on_path(result)
    if scene.analysis.follow == "events":
        result.path = follow_on_ground(result, rule, closed) if beam.ground_layers else follow(result, rule, closed)
        if result.segments:
            result.steps = PathSteps(beam, rule, result.path)
        if beam.curves and result.segments and result.status == "solved":
            _refuse_beyond_bounds(result)
        return result
    result.steps = LoadSteps(beam, rule, closed, scene.analysis.steps)
    fallen = result.steps.solve_all()
    if fallen is not None:
        factor, motion = fallen
        result.refuse(f"at load factor {factor:g}", motion)
    return result


def _refuse_beyond_bounds(result: Result) -> None:
    """Refuse a path along polylines of laws that tend to a force, where the laws themselves cannot carry the load at its end."""
    ends = {getattr(segment, "leg", 0): segment for segment in result.segments}  # of every factor of a history
    for last in ends.values():
        with suppress(EngineError):  # that is said where the step is looked at
            found = solve_step(result.beam, last.stop, result.rule, result.path.closed(last))
            if isinstance(found, Solution):
                result.path = None
                result.steps = LoadSteps(result.beam, result.rule, starting_scheme(result.beam), 0)
                result.refuse(f"at load factor {last.stop:g}", found.motion)
                return


def _refuse_on_ground(scene: Scene, beam: Beam) -> None:
    """Refuse what cannot be had on a foundation."""
    if beam.depends_on_path or beam.curves:
        what = "whose state depends on the way of the load" if beam.depends_on_path else "that are curves"
        raise SceneError("supports", f"laws {what} cannot stand beside a foundation in this version; use polylines that rise")
    if scene.analysis.history != [1.0]:
        raise SceneError("analysis.history", "a beam on a foundation goes back along its path; leave it out")


def _on_path(result: Result) -> Result:
    """Solve a scene whose state depends on the way of the load."""
    analysis = result.scene.analysis
    by_steps = analysis.follow == "steps"
    if by_steps and analysis.at_limit == "follow":
        raise SceneError("analysis.at_limit", '"follow" needs follow = "events": with falling load there is no state by steps')
    if by_steps and analysis.history != [1.0]:
        raise SceneError("analysis.history", 'a history needs follow = "events"')
    result.path = follow_branches(result)
    if result.beam.curves and not result.beam.depends_on_path and result.status == "solved":
        _refuse_beyond_bounds(result)
        if result.path is None:
            return result
    factors = [(k + 1) / analysis.steps for k in range(analysis.steps)] if by_steps else None
    result.steps = PathSteps(result.beam, result.rule, result.path, factors)
    return result


def choose_rule(scene: Scene, rule: str | None) -> str:
    """Take the rule that the caller gives, or else that of the scene.

    Parameters
    ----------
    scene : Scene
        The scene.
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
        The beam.
    start : sequence of bool, optional
        As for `solve`; default all closed, laws on their first piece.

    Returns
    -------
    numpy.ndarray of int
    """
    closed = np.ones(beam.supports, dtype=np.int32)
    if start is None:
        for kinks, middle, _ in beam.laws.values() if beam.has_laws else ():
            closed[kinks.start + max(middle, 1) : kinks.stop] = 0  # on its first piece
        return closed
    one_sided = np.flatnonzero(beam.sides)
    of_all = np.ones(beam.scene_supports, dtype=np.int32)
    of_all[one_sided] = scheme(start, len(one_sided), "one-sided support")
    return of_all[beam.numbers]
