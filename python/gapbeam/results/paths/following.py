"""Follow the load of one beam: at factors 1/n, 2/n, ..., 1, each step starting from the last scheme, or from event to event."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING

import numpy as np

from ...base.errors import WITHOUT_ANSWER, EngineError, SceneError, Status
from ...engine.arrays import Solution
from ...engine.beam import Beam
from ...scene.structs import Scene
from ..state.schemes import starting_scheme
from ..state.step import solve_step
from ..state.steps import LoadSteps, PathSteps
from .branches import follow_branches
from .compression import check_compression
from .ground_path import follow_on_ground
from .path import follow

if TYPE_CHECKING:
    from ..result import Result


def follow_load(result: Result, closed: np.ndarray) -> None:
    """Solve a beam as its scene says: by load steps, or from event to event.

    Parameters
    ----------
    result : Result
        Of its scene, without states yet.
    closed : numpy.ndarray of int
        From `starting_scheme`.

    Raises
    ------
    SceneError
        What is asked for cannot be had for this beam.
    EngineError
        No unique answer exists.
    """
    scene, beam = result.scene, result.beam
    if beam.ground_layers:
        _refuse_on_ground(scene, beam)
    if not scene.trains:
        _follow(result, closed)
        check_compression(result)
        return
    if beam.depends_on_path:
        what = "laws whose state depends on the way of the load cannot stand beside trains"
        raise SceneError("supports", f"{what} in this version; use polylines that rise")
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


def _follow(result: Result, closed: np.ndarray) -> None:
    """Follow the load of a beam without its trains."""
    scene, beam, rule = result.scene, result.beam, result.rule
    if beam.depends_on_path or scene.analysis.history != [1.0]:
        _on_path(result)
        return
    if scene.analysis.follow == "events":
        result.path = follow_on_ground(result, rule, closed) if beam.ground_layers else follow(result, rule, closed)
        if result.segments:
            result.steps = PathSteps(beam, rule, result.path)
        if beam.curves and result.segments and result.status == "solved":
            _refuse_beyond_bounds(result)
        return
    result.steps = LoadSteps(beam, rule, closed, scene.analysis.steps)
    fallen = result.steps.solve_all()
    if fallen is not None:
        factor, motion = fallen
        result.refuse(f"at load factor {factor:g}", motion)


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


def _on_path(result: Result) -> None:
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
            return
    factors = [(k + 1) / analysis.steps for k in range(analysis.steps)] if by_steps else None
    result.steps = PathSteps(result.beam, result.rule, result.path, factors)
