"""The path of a beam with smooth laws: found on their polylines, then put onto the laws themselves.

On a polyline the path has a kink wherever a support passes one, which is nothing on the law. Only what happens is looked for
on the laws (`Arc`): where the load turns round, where the beam begins to give way to another side, where another support passes
an end of its piece, and the load factors that are gone to. What is not found there stays as it is on the polylines, and says so.
"""

from __future__ import annotations

from bisect import bisect_left
from dataclasses import replace
from itertools import pairwise

import numpy as np

from ...base.errors import EngineError, Status
from ...base.records import Pickled, read_only
from ...engine.arrays import History
from ...engine.beam import GIVEN, Beam
from ..state.kinks import passed_kinks
from ..state.smooth import SmoothLaws
from ..state.step import Step
from .arc import Arc, LostError, Point, State
from .branching import Tracer

LIMIT_POINT, BIFURCATION = 1, 2
"""Kinds of limits, as in the engine."""
THROUGH, GIVEN_FACTOR, TURNS_ROUND, BRANCHES, EVENT, UNKNOWN = range(6)
"""What there is between two stretches."""
NEAR = 1e-9
"""Relative size of what is zero."""
AWAY = 0.01
"""Place along an arc where it has left its start."""
WIDE = 0.05
"""Distance of states in sizes of the deflections and the factor, against which the error of a polyline is small."""


class CurvedPath(Pickled):
    """The history of a beam on its smooth laws.

    Parameters
    ----------
    beam : Beam
        With smooth laws.
    history : History
        Followed on their polylines; with ``at_limit = "jump"`` where the path is to stop at the first limit.
    target : float
        The last load factor that is gone to. The history may go on beyond it.
    stops : bool
        Whether the path stops at the first limit.

    Attributes
    ----------
    history : History
        With load factors on the laws, where they are known.
    runs : list of (int, int)
        First and last stretch of what is one segment on the laws.
    unreached : int or None
        Leg at the end of which the load factor was not found on the laws: there is a limit load before it.
    """

    def __init__(self, beam: Beam, history: History, target: float, stops: bool):
        h = history
        self._beam, self._rough, self._target, self._stops = beam, history, target, stops
        self.history = replace(h, along=h.along.copy(), about=h.about.copy(), limit_factors=h.limit_factors.copy())
        self._dead = beam.with_dead_loads_alone() if 0 in h.about[:, 0] else None
        self._size = max(curve.scale() for _, curve in beam.curves), float(np.abs(h.along).max(initial=0.0))
        # Where no force falls there is one state only, and tangents lead to it
        self._unique = bool((h.kinks[:, 2:] >= 0.0).all())
        self._points: dict[tuple[int, int], np.ndarray] = {}
        self._traced: tuple[int, Tracer, list[np.ndarray]] | None = None
        # Where a jump has landed, a stretch begins at the load factor of the limit
        landings = (h.limits[h.limits[:, 3] > 0, 3] - 1).tolist()
        self._landings = {k for k in landings if h.about[k - 1, 4] and not h.about[k, 4]}
        self._joins = [self._join(k) for k in range(len(h.about))]
        self.unreached: int | None = None
        k = 0
        while k < len(self._joins):
            turns = self._turns_from(k)
            try:
                if turns:
                    self._put_turns_on_the_laws(turns)
                elif self._joins[k] not in (THROUGH, UNKNOWN):
                    self._put_on_the_laws(k, self._joins[k])
            except LostError:
                if self._joins[k] == GIVEN_FACTOR and not self._unique:
                    self._miss(k)
            if self._traced is not None:
                break
            k = turns[-1] + 1 if turns else k + 1
        for j, (_, leg, before, landing) in enumerate(self.history.limits):
            self.history.limit_factors[j] = self.history.along[before - 1, 1] if before else self.history.limit_factors[j]
            if leg in h.about[:, 0] and leg < h.about[-1, 0]:
                goal = self._goal(leg)
                if (self.history.limit_factors[j] - goal) * (goal - self._begin(leg)) > 0.0:
                    self.unreached = int(leg)  # it would have come there before
            if landing - 1 in self._landings:
                self.history.along[landing - 1, 0] = self.history.limit_factors[j]
        self.runs = self._merge()
        self._cut()
        if stops and len(self.history.limits):
            self._stop()

    # What there is between two stretches

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
        if next_direction != direction and not np.array_equal(h.kinks[k], h.kinks[k + 1]):
            return UNKNOWN  # laws written anew where the load turns round
        if passed_kinks(self._beam, h.closed[k], h.closed[k + 1], h.kinks[k]):
            return EVENT
        if direction != next_direction and ways == 1:
            return TURNS_ROUND
        return BRANCHES if (direction, index) != (next_direction, next_index) or ways > 1 else THROUGH

    def _merge(self) -> list[tuple[int, int]]:
        starts = [k + 1 for k, join in enumerate(self._joins) if join != THROUGH or k + 1 in self._landings]
        ends = [0, *(k for k in starts if k < len(self._joins)), len(self._joins)]
        return [(a, b - 1) for a, b in pairwise(ends) if a < b]

    # Onto the laws

    def beam(self, k: int) -> Beam:
        """Give the beam with the laws of a stretch, smooth ones as polylines."""
        beam = self._beam if self._rough.about[k, 0] else self._dead
        return beam.with_kinks(self._rough.kinks[k])

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

    def _put_on_the_laws(self, k: int, join: int) -> None:
        """Find the end of a stretch on the laws."""
        direction, index = self._rough.about[k, 1:3]
        low = 0.0 if (k, 0) in self._points else -np.inf
        if join == GIVEN_FACTOR:
            state = self._at(k, float(self._rough.along[k, 1]))
            self._check(state)
        elif join == BRANCHES:
            arc = self._arc(k, k, forward=False)
            indices = {int(index), int(self._rough.about[k + 1, 2])}
            if min(indices) == len(self._beam.curves):
                raise LostError
            state = arc.root(lambda state: arc.eigenvalues(state)[min(indices)], low)
            self._check(state, arc, indices)
        else:
            arc, h = self._arc(k, k, forward=False), self._rough
            passed = passed_kinks(self._beam, h.closed[k], h.closed[k + 1], h.kinks[k])
            # It may have been at the same kink at the start of the arc
            first = AWAY if abs(passed[0].margin(arc.at(0.0).solution)) < NEAR else 0.0
            state = arc.root(lambda state: passed[0].margin(state.solution), max(low, first) if first else low, first=first)
            # Not at the event itself, where a support may be on either side of it by rounding
            rate = arc.rate_beside(state.at, -1)
            if max(abs(kink.margin(state.solution)) for kink in passed) > NEAR or not direction * rate > 0.0:
                raise LostError
            self._check(state)
            leg, goal = h.about[k, 0], self._goal(h.about[k, 0])
            way = np.sign(goal - self._begin(leg))
            if leg == h.about[-1, 0] and direction == way and way * (state.factor - goal) > 0.0:
                self._miss(k)  # what happens there does so beyond
        self._keep(k, state)
        if join == BRANCHES and index == 0:
            leg = int(self._rough.about[k, 0])
            if leg > 0 and direction == np.sign(self._goal(leg) - self._begin(leg)):
                self._branch_off(k, arc, state, leg)
        if join == GIVEN_FACTOR:
            self.history.along[k, 1] = self._rough.along[k, 1]  # there to the last digit, or no step is found there
        if join == EVENT:
            try:
                self._leave(k + 1, state)
            except LostError:
                self._forget(k)
                raise

    def _branch_off(self, k: int, arc: Arc, state: State, leg: int) -> None:
        """Go on from a bifurcation on the laws: on the polylines chance decides whether stable ways go on there."""
        h, goal = self.history, self._target
        way = int(self._rough.about[k, 1])
        last = leg == int(self._rough.about[-1, 0])
        tracer = Tracer(arc, state)
        try:
            points, arrives, lost = tracer.follow(way, goal if last else self._goal(leg))
        except LostError:
            return
        stays = len(points) == 1  # no way on is stable
        is_limit = bool((h.limits[:, 2] == k + 1).any())
        if stays and is_limit:
            return
        if not self._stops or lost or (arrives and not last):
            if stays or is_limit or lost:
                raise EngineError(
                    f"at load factor {state.factor:.9g} equal smooth laws soften together, and how the beam goes on from there "
                    'cannot be followed on them: use at_limit = "stop" without further load factors, or make one of them differ '
                    "a little",
                    Status.NOT_CONVERGED,
                )
            return
        self._traced = k + 1, tracer, points
        kept = np.append(np.arange(k + 1), [] if stays else k).astype(int)
        about, along = h.about[kept], h.along[kept]
        if not stays:
            about[-1, 1:], along[-1] = (way, 0, 2, 0), (state.factor, points[-1][-1])
            self._points[k + 1, 0], self._points[k + 1, 1] = state.deflection, points[-1][:-1]
        about[:, 4] = np.where(np.arange(len(about)) >= k + 1, 0, about[:, 4])
        limits, factors = h.limits[h.limits[:, 2] <= k], h.limit_factors[h.limits[:, 2] <= k]
        if not arrives:
            limits = np.vstack([limits, [BIFURCATION if stays else LIMIT_POINT, leg, len(kept), 0]]).astype(h.limits.dtype)
            factors = np.append(factors, points[-1][-1])
        others = h.others[:, 0] <= k + 1
        cut = {
            "closed": h.closed[kept], "kinks": h.kinks[kept], "others": h.others[others], "other_schemes": h.other_schemes[others],
            "limits": limits, "limit_factors": factors, "ending": "" if arrives else "ended", "motion": None,
        }  # fmt: skip
        self.history = replace(h, about=about, along=along, **cut)
        self._rough = replace(self._rough, about=about.copy(), along=along.copy(), **cut)
        self._landings = {landing for landing in self._landings if landing <= k}
        self._joins = [*self._joins[: k + 1], *([] if stays else [GIVEN_FACTOR if arrives else UNKNOWN])]

    def _leave(self, k: int, state: State) -> None:
        """Whether the load goes as it does on the polylines after an event."""
        arc = self._arc(k, k)
        away = np.abs(arc.at(0.0).deflection - state.deflection).max(initial=0.0)
        if away > NEAR * np.abs(state.deflection).max(initial=0.0) or not arc.rate_beside(0.0, 1) * self._rough.about[k, 1] > 0.0:
            raise LostError

    def _keep(self, k: int, state: State) -> None:
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

    def _check(self, state: State, arc: Arc | None = None, indices: set[int] | None = None) -> None:
        """Whether all supports are on their pieces, and where the beam begins to give way so many ways as on the polylines."""
        if state.beam.certify(state.factor, state.solution)[0][2] > NEAR:
            raise LostError
        if arc is not None and not set(self._beam.laws) - self._beam.smooth:
            values = arc.eigenvalues(state)
            falling = int((values < -np.abs(values).min()).sum())
            if not indices <= {falling, falling + 1}:
                raise LostError

    # Where the load turns round

    def _turns_from(self, k: int) -> list[int]:
        """Ends of stretches at which the load turns round, near each other: on the polylines it may do so more than once."""
        if self._joins[k] != TURNS_ROUND:
            return []
        found, at = [k], k
        try:
            while at + 1 < len(self._joins) and self._joins[at + 1] in (THROUGH, TURNS_ROUND):
                at += 1
                if not self._is_near(self._end(found[-1], 1), self._end(at, 1)):
                    break
                if self._joins[at] == TURNS_ROUND:
                    found.append(at)
        except LostError:
            pass
        return found

    def _put_turns_on_the_laws(self, turns: list[int]) -> None:
        """Find where the load turns round on the laws."""
        arc = self._arc(turns[0], turns[-1] + 1, turn=turns[0])
        states = arc.roots(lambda state: state.rate[-1])
        if len(turns) == 1:
            # Others may follow close behind
            way = self._rough.about[turns[0], 1]
            states = [state for state in states if way * arc.rate_beside(state.at, -1) > 0.0]
            states = states or [arc.root(lambda state: state.rate[-1], 0.0 if (turns[0], 0) in self._points else -np.inf)]
        kept = self._which(turns, len(states))
        about = self._rough.about
        for k, state in zip(kept, states, strict=True):
            self._check(state, arc, {int(about[k, 2]), int(about[k + 1, 2])})
        for k in set(turns) - set(kept):
            self._joins[k] = THROUGH
            self._drop_limit(k)
        for k in turns:
            # What is between them is of no length
            if kept:
                self._keep(k, states[min(bisect_left(kept, k), len(kept) - 1)])

    def _which(self, turns: list[int], count: int) -> list[int]:
        """Choose as many of the turns as there are on the laws, to and fro in turn; limits of the load before others."""
        left = len(turns) - count
        if left < 0 or left % 2:
            raise LostError
        limits, found, at = set((self.history.limits[:, 2] - 1).tolist()), [], 0
        for _ in range(count):
            chosen = max(range(at, at + left + 1, 2), key=lambda j: (turns[j] in limits, j))
            found.append(turns[chosen])
            left -= chosen - at
            at = chosen + 1
        return found

    def _drop_limit(self, k: int) -> None:
        """Go through what is no limit on the laws."""
        h = self.history
        for _, _, before, landing in h.limits[h.limits[:, 2] == k + 1]:
            if landing - 1 in self._landings:
                h.about[before : landing - 1, 4] = 0
                h.along[landing - 1, 0] = h.along[landing - 2, 1]
                self._landings.discard(landing - 1)
        keep = h.limits[:, 2] != k + 1
        self.history = replace(h, limits=h.limits[keep], limit_factors=h.limit_factors[keep])

    def _miss(self, k: int) -> None:
        """Note that the path does not come to the end of its leg as on the polylines; what is beyond a limit may not matter."""
        if self.unreached is None and not (self._stops and (self.history.limits[:, 2] <= k).any()):
            self.unreached = int(self._rough.about[k, 0])

    def _at(self, k: int, factor: float) -> State:
        """Find the state on a stretch at a load factor."""
        low, high = (bound if (k, end) in self._points else sign * np.inf for end, bound, sign in ((0, 0.0, -1), (1, 1.0, 1)))
        arc = self._arc(k, k)
        state = arc.root(lambda state: state.factor - factor, low, high)
        if not state.rate[-1] * self._rough.about[k, 1] > 0.0:
            raise LostError
        return state

    def _cut(self) -> None:
        """End the path where it first comes to the last load factor."""
        h = self.history
        last = int(h.about[-1, 0]) if len(h.about) else 0
        for number, (first, stop) in enumerate(self.runs):
            leg, direction, _, _, skipped = h.about[first]
            way = np.sign(self._target - self._begin(leg))
            before, beyond = way * (self._target - np.array([h.along[first, 0], h.along[stop, 1]])) * (1, -1)
            if leg != last or skipped or direction != way or before < 0.0 or beyond <= 0.0:
                continue
            k = next(k for k in range(first, stop + 1) if way * (h.along[k, 1] - self._target) >= 0.0)
            try:
                self._points[k, 1] = self._at(k, self._target).deflection
            except LostError:
                self._points.pop((k, 1), None)
            h.along[k, 1] = self._target
            keep = h.limits[:, 2] <= k
            self.history = replace(
                h, along=h.along[: k + 1], about=h.about[: k + 1], closed=h.closed[: k + 1], kinks=h.kinks[: k + 1],
                limits=h.limits[keep], limit_factors=h.limit_factors[keep], ending="", motion=None,
            )  # fmt: skip
            self.runs = [*self.runs[:number], (first, k)]
            return

    def _stop(self) -> None:
        """End the path at its first limit; what is beyond was only looked at."""
        h, before, landing = self.history, *map(int, self.history.limits[0, 2:])
        h.about[before:, 4] = 1
        if landing - 1 in self._landings:
            h.along[landing - 1, 0] = h.along[landing - 2, 1]
        self.history = replace(h, limits=h.limits[:1], limit_factors=h.limit_factors[:1], ending=h.ending or "ended")

    def _begin(self, leg: int) -> float:
        """Load factor at which a leg begins."""
        return float(self._rough.along[np.flatnonzero(self._rough.about[:, 0] == leg)[0], 0]) if leg > 1 else 0.0

    def _goal(self, leg: int) -> float:
        """Load factor at which a leg ends on the polylines."""
        return float(self._rough.along[np.flatnonzero(self._rough.about[:, 0] == leg)[-1], 1])

    # What is asked for

    def is_exact(self, k: int) -> bool:
        """Whether the end of a stretch is known on the laws."""
        return (k, 1) in self._points or (self._unique and self._joins[k] == GIVEN_FACTOR)

    def step(self, k: int, factor: float) -> Step:
        """Give the state at a load factor.

        Parameters
        ----------
        k : int
            Number of a stretch of its run.
        factor : float
            The load factor.

        Returns
        -------
        Step
        """
        first, last = next(run for run in self.runs if run[0] <= k <= run[1])
        along, direction = self.history.along, self._rough.about[k, 1]
        for at, end in ((first, 0), (last, 1)):
            if (at, end) in self._points and along[at, end] == factor:
                return self._through(at, self._points[at, end], factor)
        if self._traced is not None and self._traced[0] == k:
            _, tracer, points = self._traced
            try:
                deflection = tracer.at_factor(points, factor)[:-1]
            except LostError:
                return Step(self.beam(k), factor, GIVEN, self.closed(k), settled=True, exact=False)
            return self._through(k, deflection, factor)
        unknown = self._joins[last] != THROUGH and not self.is_exact(last) and factor == along[last, 1]
        k = next((k for k in range(first, last + 1) if direction * (along[k, 1] - factor) >= 0.0), last)
        try:
            if unknown:
                raise LostError
            return Step(self._at(k, factor).beam, factor, GIVEN, self.closed(k), settled=True)
        except LostError:
            by_tangents = self._unique and not unknown
            return Step(self.beam(k), factor, GIVEN, self.closed(k), settled=not by_tangents, exact=by_tangents)

    def _through(self, k: int, deflection: np.ndarray, factor: float) -> Step:
        """Give the state on a stretch with known deflections at the laws."""
        laws = SmoothLaws(self.beam(k))
        d, way = laws.past_the_gap(deflection)
        beam = laws.with_lines(laws.beam, deflection, laws.forces_and_slopes(d)[0] * way, laws.springs(deflection))
        return Step(beam, factor, GIVEN, self.closed(k), settled=True)
