"""Energy that supports dissipate along a loading history: what they take up, less what they would give back."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...scene.names import column_of
from .branches import BranchPath

if TYPE_CHECKING:
    from ..result import Result
    from ..state.step import Step


class _Moment(NamedTuple):
    """Forces over movements, by which supports take up energy: of laws, and of friction."""

    force: np.ndarray
    movement: np.ndarray
    friction: np.ndarray
    slip: np.ndarray


def dissipated(result: Result) -> np.ndarray | None:
    """Find what supports have dissipated up to every step of a loading history.

    Parameters
    ----------
    result : Result
        Of one load.

    Returns
    -------
    numpy.ndarray or None
        Force times length, or couple times angle: steps by supports, 0 of those that neither yield for good nor rub. What is lost
        while dead loads are put on is left out. None where no history is followed.

    Examples
    --------
    >>> import gapbeam
    >>> scene = {"beam": {"spans": [1.0], "EI": 1.0}, "loads": [{"type": "force", "x": 0.5, "F": 4.0}],
    ...          "supports": [{"node": 0}, {"node": 1}, {"x": 0.5, "law": [[0.01, 1.0], [1.0, 1.0]], "unloading": "plastic"}],
    ...          "analysis": {"follow": "events", "history": [1.0]}}
    >>> result = gapbeam.solve(scene)
    >>> dissipated(result)[-1].round(6).tolist(), round(float(result.steps[-1].deflection[2]), 6)
    ([0.0, 0.0, 0.0525], 0.0625)
    """
    path, scene = result.path, result.scene
    yields = np.array(column_of(scene.supports, "unloading")) == "plastic"
    rubs = np.array(column_of(scene.supports, "friction"), dtype=float) > 0.0
    if not isinstance(path, BranchPath) or not (yields.any() or rubs.any()):
        return None
    # Pushed to the right a support pushes to the left; upward is against deflections already
    way = np.where(np.array(column_of(scene.supports, "direction")) == "axial", -1.0, 1.0)

    def at(state: Step) -> _Moment:
        return _Moment(way * state.reaction, state.solution.yielded()[2], -state.friction, state.slip)

    def between(one: _Moment, other: _Moment) -> np.ndarray:
        of_law = (one.force + other.force) / 2 * (other.movement - one.movement)
        return of_law + (one.friction + other.friction) / 2 * (other.slip - one.slip)

    taken, last, starts = np.zeros(len(scene.supports)), None, []
    for segment in path.segments:
        states = path.along(segment)
        first = at(states[0])
        taken = taken + between(last, first) if last is not None else states[0].solution.yielded()[0]
        starts.append((first, taken))
        last = first
        for state in states[1:]:
            now = at(state)
            taken = taken + between(last, now)
            last = now
    numbers = {segment.number: k for k, segment in enumerate(path.segments)}
    found = []
    for k, step in enumerate(result.steps):
        first, before = starts[numbers[result.steps.segment(k).number]]
        lost = before + between(first, at(step)) - step.solution.yielded()[0]
        found.append(np.where(yields | rubs, lost, 0.0))
    return np.array(found).reshape(-1, len(scene.supports))
