"""The path of a beam with smooth laws: found on their polylines, then put onto the laws themselves.

On a polyline the path bends wherever a support passes a breakpoint, which is nothing on the law. Only what happens is looked for
on the laws (`Arc`): where the load turns round, where the beam begins to give way to another side, where another support passes
an end of its piece, and the load factors that are gone to. What is not found there stays as it is on the polylines, and says so.
"""

from __future__ import annotations

from bisect import bisect_left
from dataclasses import replace
from itertools import pairwise

import numpy as np

from ...base.errors import EngineError, Status
from ...engine.arcs import BEFORE, BEYOND, RATE, Arc, ArcState, LostError, of_breakpoint, of_eigenvalue
from ...engine.arrays import History
from ...engine.beam import GIVEN, Beam
from ..state.breakpoints import passed_breakpoints
from ..state.smooth import SmoothLaws
from ..state.step import Step
from .polyline_path import BRANCHES, EVENT, GIVEN_FACTOR, NEAR, THROUGH, TURNS_ROUND, UNKNOWN, PolylinePath

LIMIT_POINT, BIFURCATION = 1, 2
"""Kinds of limits, as in the engine."""
AWAY = 0.01
"""Place along an arc where it has left its start."""


class CurvedPath(PolylinePath):
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
        super().__init__(beam, history, target)
        h, self._stops = history, stops
        self._traced: tuple[int, Arc, np.ndarray, np.ndarray] | None = None
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

    def _merge(self) -> list[tuple[int, int]]:
        starts = [k + 1 for k, join in enumerate(self._joins) if join != THROUGH or k + 1 in self._landings]
        ends = [0, *(k for k in starts if k < len(self._joins)), len(self._joins)]
        return [(a, b - 1) for a, b in pairwise(ends) if a < b]

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
            state = arc.root(of_eigenvalue(min(indices)), low)
            if (k, 0) in self._points and state.at < NEAR:
                raise LostError  # where the stretch begins, which rounding puts before or beyond
            self._check(state, indices)
        else:
            arc, h = self._arc(k, k, forward=False), self._rough
            ends = passed_breakpoints(self._beam, h.closed[k], h.closed[k + 1], h.breakpoints[k])
            passed = [of_breakpoint(*one) for one in ends]
            # It may have been at the same breakpoint at the start of the arc
            first = AWAY if abs(arc.value(passed[0], 0.0)) < NEAR else 0.0
            state = arc.root(passed[0], max(low, first) if first else low, first=first)
            # Not at the event itself, where a support may be on either side of it by rounding
            rate = arc.rate_beside(state.at, BEFORE)
            if max(abs(arc.value(one, state.at)) for one in passed) > NEAR or not direction * rate > 0.0:
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

    def _branch_off(self, k: int, arc: Arc, state: ArcState, leg: int) -> None:
        """Go on from a bifurcation on the laws: on the polylines chance decides whether stable ways go on there."""
        h, goal = self.history, self._target
        way = int(self._rough.about[k, 1])
        last = leg == int(self._rough.about[-1, 0])
        try:
            points, arrives, lost = arc.branch(state.point, way, goal if last else self._goal(leg))
        except LostError:
            return
        stays = len(points) == 1  # no way on is stable
        is_limit = bool((h.limits[:, 2] == k + 1).any())
        if stays and is_limit:
            return
        if not self._stops or lost or (arrives and not last):
            if stays or is_limit or lost:
                raise EngineError(
                    f"at load factor {state.factor:.9g} equal smooth laws soften together, and how the path continues from there "
                    'cannot be followed on them: use at_limit = "stop" without further load factors, or make one of them differ '
                    "a little",
                    Status.NOT_CONVERGED,
                )
            return
        self._traced = k + 1, arc, state.point, points
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
            "closed": h.closed[kept], "breakpoints": h.breakpoints[kept],
            "others": h.others[others], "other_schemes": h.other_schemes[others],
            "limits": limits, "limit_factors": factors, "ending": "" if arrives else "ended", "motion": None,
        }  # fmt: skip
        self.history = replace(h, about=about, along=along, **cut)
        self._rough = replace(self._rough, about=about.copy(), along=along.copy(), **cut)
        self._landings = {landing for landing in self._landings if landing <= k}
        self._joins = [*self._joins[: k + 1], *([] if stays else [GIVEN_FACTOR if arrives else UNKNOWN])]

    def _leave(self, k: int, state: ArcState) -> None:
        """Whether the load goes as it does on the polylines after an event."""
        arc = self._arc(k, k)
        away = np.abs(arc.at(0.0).deflection - state.deflection).max(initial=0.0)
        rises = arc.rate_beside(0.0, BEYOND) * self._rough.about[k, 1] > 0.0
        if away > NEAR * np.abs(state.deflection).max(initial=0.0) or not rises:
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
        states = arc.roots(RATE)
        if (turns[0], 0) in self._points and self._joins[turns[0] - 1] == BRANCHES:
            # Where branches cross the load is stationary on the one of them that is no turn, and its rate is rounding
            states = [state for state in states if state.at > AWAY]
        if len(turns) == 1:
            # Others may follow close behind
            way = self._rough.about[turns[0], 1]
            states = [state for state in states if way * arc.rate_beside(state.at, BEFORE) > 0.0]
            states = states or [arc.root(RATE, 0.0 if (turns[0], 0) in self._points else -np.inf)]
        kept = self._which(turns, len(states))
        about = self._rough.about
        for k, state in zip(kept, states, strict=True):
            self._check(state, {int(about[k, 2]), int(about[k + 1, 2])})
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
                h, along=h.along[: k + 1], about=h.about[: k + 1], closed=h.closed[: k + 1], breakpoints=h.breakpoints[: k + 1],
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
        """
        first, last = next(run for run in self.runs if run[0] <= k <= run[1])
        along, direction = self.history.along, self._rough.about[k, 1]
        for at, end in ((first, 0), (last, 1)):
            if (at, end) in self._points and along[at, end] == factor:
                return self._through(at, self._points[at, end], factor)
        if self._traced is not None and self._traced[0] == k:
            _, arc, origin, points = self._traced
            try:
                deflection = arc.at_factor(points, origin, factor)[:-1]
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
