"""The path of a beam with smooth laws as it is on their polylines, and the ends of its stretches that are known on the laws."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...base.errors import EngineError
from ...base.records import Pickled, read_only
from ...engine.arcs import Arc, ArcState, LostError, Point, beyond_factor
from ...engine.arrays import History
from ...engine.beam import GIVEN, Beam
from ..state.breakpoints import passed_breakpoints
from ..state.smooth import SmoothLaws

THROUGH, GIVEN_FACTOR, TURNS_ROUND, BRANCHES, EVENT, UNKNOWN = range(6)
"""What there is between two stretches."""
NEAR = 1e-9
"""Relative size of what is zero."""
WIDE = 0.05
"""Distance of states in sizes of the deflections and the factor, against which the error of a polyline is small."""


class PolylinePath(Pickled):
    """The stretches of a path on the polylines of smooth laws, each of whose ends may be put onto the laws.

    Parameters
    ----------
    beam : Beam
        With smooth laws.
    history : History
        Followed on their polylines.
    target : float
        The last load factor that is gone to.

    Attributes
    ----------
    history : History
        With load factors on the laws, where they are known.
    """

    def __init__(self, beam: Beam, history: History, target: float):
        h = history
        self._beam, self._rough, self._target = beam, history, target
        self.history = replace(h, along=h.along.copy(), about=h.about.copy(), limit_factors=h.limit_factors.copy())
        self._dead = beam.with_dead_loads_alone() if 0 in h.about[:, 0] else None
        self._size = max(curve.scale() for _, curve in beam.curves), float(np.abs(h.along).max(initial=0.0))
        # Where no force falls there is one state only, and tangents lead to it
        self._unique = bool((h.breakpoints[:, 2:] >= 0.0).all())
        self._points: dict[tuple[int, int], np.ndarray] = {}
        # Where a jump has landed, a stretch begins at the load factor of the limit
        landings = (h.limits[h.limits[:, 3] > 0, 3] - 1).tolist()
        self._landings = {k for k in landings if h.about[k - 1, 4] and not h.about[k, 4]}
        self._joins = [self._join(k) for k in range(len(h.about))]

    def _join(self, k: int) -> int:
        """What there is at the end of a stretch."""
        h = self._rough
        leg, direction, index, _, _ = h.about[k]
        if direction == 0 or (leg == 0 and self._dead is None):
            return UNKNOWN
        if k + 1 == len(h.about):
            return GIVEN_FACTOR if not h.ending and h.along[k, 1] == self._target else UNKNOWN
        next_leg, next_direction, next_index, ways, _ = h.about[k + 1]
        if next_leg != leg:
            return GIVEN_FACTOR
        if next_direction == 0:
            return UNKNOWN
        if next_direction != direction and not np.array_equal(h.breakpoints[k], h.breakpoints[k + 1]):
            return UNKNOWN  # laws written anew where the load turns round
        if passed_breakpoints(self._beam, h.closed[k], h.closed[k + 1], h.breakpoints[k]):
            return EVENT
        if direction != next_direction and ways == 1:
            return TURNS_ROUND
        return BRANCHES if (direction, index) != (next_direction, next_index) or ways > 1 else THROUGH

    def beam(self, k: int) -> Beam:
        """Give the beam with the laws of a stretch, smooth ones as polylines."""
        beam = self._beam if self._rough.about[k, 0] else self._dead
        return beam.with_breakpoints(self._rough.breakpoints[k])

    def closed(self, k: int) -> np.ndarray:
        """Give the scheme of a stretch."""
        return read_only(self._rough.closed[k].astype(np.int32))

    def _end(self, k: int, end: int) -> Point:
        """Start (0) or stop (1) of a stretch: on the laws where that is known, else on the polylines."""
        if (k, end) in self._points:
            return Point(self._points[k, end], float(self.history.along[k, end]))
        along, beam = self._rough.along, self.beam(k)
        factor = float(along[k - 1, 1] if end == 0 and k in self._landings else along[k, end])
        try:
            return Point(SmoothLaws(beam).deflections(beam.solve(factor, GIVEN, self.closed(k))), factor)
        except EngineError:
            raise LostError from None

    def _arc(self, first: int, last: int, forward: bool = True, turn: int | None = None) -> Arc:
        """The path about some stretches, as far as it is one and so long that its direction on the polylines is right."""
        start, stop = self._end(first, 0), self._end(last, 1)
        while first > 0 and (first, 0) not in self._points and self._joins[first - 1] == THROUGH and self._is_near(start, stop):
            first -= 1
            start = self._end(first, 0)
        while forward and (last, 1) not in self._points and self._joins[last] == THROUGH and self._is_near(start, stop, 2):
            last += 1
            stop = self._end(last, 1)
        return Arc(self.beam(first), self.closed(first), start, stop, None if turn is None else self._end(turn, 1))

    def _is_near(self, start: Point, stop: Point, times: int = 1) -> bool:
        """Whether the error of the polylines may be as large as the distance of two states."""
        away = np.abs(stop.deflection - start.deflection).max()
        size = max(self._size[0], np.abs([start.deflection, stop.deflection]).max())
        return bool(away < times * WIDE * size and abs(stop.factor - start.factor) < times * WIDE * self._size[1])

    def _keep(self, k: int, state: ArcState) -> None:
        """Note the end of a stretch on the laws."""
        self._points[k, 1], self.history.along[k, 1] = state.deflection, state.factor
        if k + 1 < len(self._joins) and k + 1 not in self._landings:
            self._points[k + 1, 0] = state.deflection
            if self._rough.about[k, 0] == self._rough.about[k + 1, 0]:
                self.history.along[k + 1, 0] = state.factor

    def _forget(self, k: int) -> None:
        """Take the end of a stretch on the polylines again."""
        for at, end in ((k, 1), (k + 1, 0)):
            if self._points.pop((at, end), None) is not None:
                self.history.along[at, end] = self._rough.along[at, end]

    def _check(self, state: ArcState, indices: set[int] | None = None) -> None:
        """Whether all supports are on their pieces, and where the beam begins to give way so many ways as on the polylines."""
        if state.arc.wrongness(state.at) > NEAR:
            raise LostError
        if indices is not None and not set(self._beam.laws) - self._beam.smooth:
            values = state.arc.eigenvalues(state.slope)
            falling = int((values < -np.abs(values).min()).sum())
            if not indices <= {falling, falling + 1}:
                raise LostError

    def _at(self, k: int, factor: float) -> ArcState:
        """Find the state on a stretch at a load factor."""
        low, high = (bound if (k, end) in self._points else sign * np.inf for end, bound, sign in ((0, 0.0, -1), (1, 1.0, 1)))
        arc = self._arc(k, k)
        state = arc.root(beyond_factor(factor), low, high)
        if not state.rate[-1] * self._rough.about[k, 1] > 0.0:
            raise LostError
        return state

    def _begin(self, leg: int) -> float:
        """Load factor at which a leg begins."""
        return float(self._rough.along[np.flatnonzero(self._rough.about[:, 0] == leg)[0], 0]) if leg > 1 else 0.0

    def _goal(self, leg: int) -> float:
        """Load factor at which a leg ends on the polylines."""
        return float(self._rough.along[np.flatnonzero(self._rough.about[:, 0] == leg)[-1], 1])
