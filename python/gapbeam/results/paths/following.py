"""Follow the load of one beam: at factors 1/n, 2/n, ..., 1, each step starting from the last scheme, or from event to event."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING

import msgspec
import numpy as np

from ...base.errors import WITHOUT_ANSWER, EngineError, SceneError, Status
from ...engine.states import Solution
from ...scene.movements import refuse_movements, settle_movements
from ...scene.reading import beam_of
from ..state.motion import cause_of_fall
from ..state.schemes import starting_scheme
from ..state.step import solve_step
from ..state.steps import LoadSteps, MovedSteps, PathSteps
from .branches import follow_branches
from .compression_check import check_compression
from .ground_path import GroundPath, follow_on_ground
from .path import Path, follow

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
    scene, beam = result.scene, result._beam
    follow_scene = _way(result)
    if not scene.trains:
        follow_scene(result, closed)
        check_compression(result)
        return
    if beam.depends_on_path:
        refuse_movements(scene, "a support cannot be moved by a load under trains")
        if beam.has_links_along:
            what = "friction, ground along the beam, and axial supports that push one way or have a law,"
            advice = "but for friction neither feels the other: solve the beam without its trains, and without these"
            raise SceneError("supports", f"{what} cannot be combined with trains in this version; {advice}")
        what = "supports whose state depends on the loading history cannot be combined with trains"
        raise SceneError("supports", f"{what} in this version; use non-decreasing polylines")
    result.trains.pass_all()
    try:
        follow_scene(result, closed)
        check_compression(result)
    except EngineError as error:
        if error.status not in WITHOUT_ANSWER:
            raise
        advice = "; or give it loads that stay, such as its own weight, and have them in every combination"
        more = advice if error.status == Status.NOT_CONVERGED else ""
        raise EngineError(f"without its trains {error}{more}", error.status) from None
    result._take_trains()


def _way(result: Result) -> Callable[[Result, np.ndarray], None]:
    """Choose how the load of a beam is followed without its trains."""
    if result.depends_on_path:
        return follow_path
    if result.scene.analysis.follow == "steps":
        return _by_steps
    return partial(_by_events, follow_on_ground if result._beam.in_stretches else follow)


def _by_steps(result: Result, closed: np.ndarray) -> None:
    """Solve at equal steps of the load factor."""
    _take_steps(result, LoadSteps(result._beam, result._rule, closed, result.scene.analysis.steps))


def _take_steps(result: Result, steps: LoadSteps) -> None:
    result.steps = steps
    fallen = steps.solve_all()
    if fallen is not None:
        factor, *how = fallen
        result._refuse(f"at load factor {factor:g}", *how)


def _by_events(follow_events: Callable[..., Path | GroundPath | None], result: Result, closed: np.ndarray) -> None:
    """Follow the load from event to event."""
    result.path = follow_events(result, result._rule, closed)
    if result.segments:
        result.steps = PathSteps(result._beam, result._rule, result.path)
    _refuse_beyond_bounds(result)


def _refuse_beyond_bounds(result: Result) -> None:
    """Refuse a path along polylines of laws that tend to a force, where the laws themselves cannot carry the load at its end."""
    if result._beam.beyond_one_search != "curve" or result.status != "solved":
        return
    ends = {getattr(segment, "leg", 0): segment for segment in result.segments}  # of every factor of a history
    for last in ends.values():
        with suppress(EngineError):  # that is said where the step is looked at
            found = solve_step(result._beam, last.stop, result._rule, result.path.closed(last))
            if isinstance(found, Solution):
                result.path = None
                result.steps = LoadSteps(result._beam, result._rule, starting_scheme(result._beam), 0)
                result._refuse(f"at load factor {last.stop:g}", found.motion, cause_of_fall(found))
                return


def _moves_settled(result: Result) -> bool:
    """Solve every step by itself where loads do no more than move supports: these have moved then, on whatever path."""
    scene = result.scene
    if scene.analysis.has_history:
        return False
    if result._beam.has_links_along:  # of first order, as where the movement is followed
        scene = msgspec.structs.replace(scene, analysis=msgspec.structs.replace(scene.analysis, first_order=True))
    settled = settle_movements(scene)
    beam = result._beam if settled is scene else beam_of(settled)
    if beam.depends_on_path:
        return False
    _take_steps(result, MovedSteps(scene, beam, result._rule, starting_scheme(beam), scene.analysis.steps))
    return True


def follow_path(result: Result, closed: np.ndarray | None = None) -> None:
    """Solve a scene whose state depends on the loading history.

    Parameters
    ----------
    result : Result
        Of its scene, without states yet.
    closed : numpy.ndarray of int, optional
        Nothing depends on it.

    Raises
    ------
    SceneError
        What is asked for cannot be had for this beam.
    EngineError
        No unique answer exists.
    """
    analysis = result.scene.analysis
    by_steps = analysis.follow == "steps"
    if by_steps and analysis.at_limit == "follow":
        raise SceneError("analysis.at_limit", '"follow" needs follow = "events": with falling load there is no state by steps')
    try:
        result.path = follow_branches(result)
    except EngineError as error:
        if not (error.status == Status.NOT_CONVERGED and by_steps and _moves_settled(result)):
            raise
        return
    _refuse_beyond_bounds(result)
    if result.path is None:
        return
    factors = [(k + 1) / analysis.steps for k in range(analysis.steps)] if by_steps else None
    result.steps = PathSteps(result._beam, result._rule, result.path, factors)
    result.steps.outcome = result.status, result._reason
    if result._beam.curves and len(result.steps):
        _ = result.steps[-1].solution  # what a path along polylines has led to stands its audit, or is refused
