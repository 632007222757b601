"""A piece of the path of a beam with smooth laws, on the laws themselves: states, limit points and events to all digits.

What is near it is known from the polylines. The other supports stay on their pieces, so the beam is linear but for the smooth
laws: put springs in their place, and the deflections x there are u0 + factor u1 - F (r(x) - k x). These are solved together
with the place along the line between two known states (Newton, pseudo-arclength; Keller 1977), which has no trouble where
the load turns round. A limit point, an event or a load factor is then the root of one function of that place.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ...base.errors import EngineError
from ...engine.beam import GIVEN, SOLVED, Beam
from ...engine.states import Solution
from ..state.smooth import SmoothLaws

MOST_CORRECTIONS = 25
"""From the polyline five or so do."""
SETTLED, ROUNDING, NOISE = 4 * np.finfo(float).eps, 1e-13, 1e-9
"""Relative change below which a state is found; below which it is, if changes grow no smaller any more; the same after many."""
BESIDE = (1e-6, 1e-4, 1e-2)
"""Places beside another one, the nearest at which there is a state being taken."""
BRANCH = 1e-6
"""Relative singular value below which the path branches."""
JUMP = 1e-6
"""Share of its values nearby up to which a function is zero."""
CLOSE = 17
"""Places between two states at which signs are compared."""
LONGEST, FARTHEST = 0.02, 0.2
"""Longest step with which a root is looked for beyond the two states, and how far, in sizes of the deflections and the factor."""


class LostError(Exception):
    """The path on the smooth laws is not where the polylines have it."""


class Point(NamedTuple):
    """Deflections at the smooth laws, and the load factor."""

    deflection: np.ndarray
    factor: float


class State(NamedTuple):
    """A state on the smooth laws.

    Attributes
    ----------
    at : float
        Place along the arc.
    point : numpy.ndarray
        Deflections at the smooth laws, and the load factor.
    rate : numpy.ndarray
        Their derivatives along the arc.
    slope : numpy.ndarray
        Slopes of the laws.
    beam : Beam
        With springs through the points of the laws instead of these.
    solution : Solution
        Its solution.
    """

    at: float
    point: np.ndarray
    rate: np.ndarray
    slope: np.ndarray
    beam: Beam
    solution: Solution

    @property
    def deflection(self) -> np.ndarray:
        """Deflections at the smooth laws."""
        return self.point[:-1]

    @property
    def factor(self) -> float:
        """The load factor."""
        return float(self.point[-1])


class Arc:
    """The path on the smooth laws along the line between two states.

    Parameters
    ----------
    beam : Beam
        With smooth laws.
    closed : numpy.ndarray of int
        The scheme.
    start, stop : Point
        The states, near the path or on it.
    turn : Point, optional
        Where between them the load turns round. Places along the arc are told by the deflections alone then, in a way in which
        both parts of it go on.

    Attributes
    ----------
    laws : SmoothLaws
        The laws.
    weights : numpy.ndarray
        Sizes of the deflections and of the load factor.
    springs : numpy.ndarray
        Stiffnesses of the springs in place of the laws.
    flexibility, under_load : numpy.ndarray
        Deflections due to a force at each law, and due to the live loads, with these springs.

    Raises
    ------
    LostError
        They are one and the same, or the beam cannot be solved there.
    """

    def __init__(self, beam: Beam, closed: np.ndarray, start: Point, stop: Point, turn: Point | None = None):
        self._beam, self._closed, self.laws = beam, closed.astype(np.int32), SmoothLaws(beam)
        self._ends = np.array([[*start.deflection, start.factor], [*stop.deflection, stop.factor]])
        if not np.isfinite(self._ends).all():
            raise LostError
        sizes = np.abs(self._ends).max(axis=0)
        self.weights = np.append(np.full(len(sizes) - 1, sizes[:-1].max() or 1.0), sizes[-1] or 1.0)
        self._along = (self._ends[1] - self._ends[0]) / self.weights
        if turn is not None:
            parts = turn.deflection - start.deflection, stop.deflection - turn.deflection
            self._along[:] = np.append(sum(part / (np.abs(part).max() or 1.0) for part in parts), 0.0)
        self._length = float(self._along @ ((self._ends[1] - self._ends[0]) / self.weights))
        if not self._length > 0.0:
            raise LostError
        self.springs = self.laws.springs(self._ends.mean(axis=0)[:-1])
        if not (np.isfinite(self.springs) & (self.springs > 0.0)).all():
            raise LostError
        self.flexibility, self.under_load = self._responses()
        self._known: dict[float, State] = {}

    def _solve(self, deflection: np.ndarray, force: np.ndarray, factor: float) -> tuple[Beam, Solution, np.ndarray]:
        """Solve with springs through given points."""
        try:
            beam = self.laws.with_lines(self._beam, deflection, force, self.springs)
            solution = beam.solve(float(factor), GIVEN, self._closed)
        except EngineError:
            raise LostError from None
        if solution.status != SOLVED:
            raise LostError
        return beam, solution, self.laws.deflections(solution)

    def holds_at(self, point: np.ndarray, force: np.ndarray, tolerance: float) -> bool:
        """Tell whether all other supports are on their pieces in a state.

        Parameters
        ----------
        point : numpy.ndarray
            Deflections at the smooth laws, and the load factor.
        force : numpy.ndarray
            Forces of the laws there, positive downward deflections resisted.
        tolerance : float
            Share of the largest reaction or deflection that is nothing.
        """
        _, solution, _ = self._solve(point[:-1], force, point[-1])
        return bool(solution.certify()[0][2] <= tolerance)

    def _responses(self) -> tuple[np.ndarray, np.ndarray]:
        """Deflections due to a force at each law, and due to the live loads."""
        point = self._ends[0]
        force = self.springs * np.maximum(np.abs(point[:-1]), self.weights[0])
        _, _, still = self._solve(point[:-1], 0 * force, point[-1])
        loaded = self._solve(point[:-1], 0 * force, point[-1] + self.weights[-1])[2]
        pushed = [self._solve(point[:-1], row, point[-1])[2] for row in np.diag(force)]
        return (still - np.array(pushed)).T / force, (loaded - still) / self.weights[-1]

    def at(self, place: float) -> State:
        """Find a state.

        Parameters
        ----------
        place : float
            Along the line between the two states, 0 and 1 at these.

        Returns
        -------
        State

        Raises
        ------
        LostError
            There is none near.
        """
        if place in self._known:
            return self._known[place]
        below = max((at for at in self._known if at < place), default=None)
        above = min((at for at in self._known if at > place), default=None)
        if place in (0.0, 1.0) or (below is None and above is None):
            point = self._ends[0] + place * (self._ends[1] - self._ends[0])
        elif below is None or above is None:
            near = self._known[above if below is None else below]
            point = near.point + (place - near.at) * near.rate
        else:
            share = (place - below) / (above - below)
            point = self._known[below].point + share * (self._known[above].point - self._known[below].point)
        before, halved = np.inf, False
        for correction in range(MOST_CORRECTIONS):
            d, way = self.laws.past_the_gap(point[:-1])
            force, slope = self.laws.forces_and_slopes(d)
            beam, solution, deflection = self._solve(point[:-1], force * way, point[-1])
            matrix = np.zeros((len(point), len(point)))
            with np.errstate(invalid="ignore"):  # a law that begins steep; looked at below
                matrix[:-1, :-1] = np.eye(len(d)) + self.flexibility * (slope - self.springs)
            matrix[:-1, -1] = -self.under_load * self.weights[-1] / self.weights[0]
            matrix[-1] = self._along
            left = place * self._length - self._along @ ((point - self._ends[0]) / self.weights)
            columns = np.zeros((len(point), 2))
            columns[:, 0], columns[-1, 1] = np.append((deflection - point[:-1]) / self.weights[0], left), self._length
            if not (np.isfinite(matrix).all() and np.isfinite(columns).all()):
                break
            # Where the path branches the way to the other branch is left out
            solved = np.linalg.lstsq(matrix, columns, rcond=BRANCH)[0].T
            change, rate = solved * self.weights
            size, wrong = np.abs(solved[0]).max(), np.abs(columns[:, 0]).max()
            noise = ROUNDING if correction < MOST_CORRECTIONS // 2 else NOISE
            if wrong <= NOISE and (size <= SETTLED or (size <= noise and size >= before / 2 and not halved)):
                self._known[place] = State(place, point, rate, slope, beam, solution)
                return self._known[place]
            # Where a law begins they may go to and fro for ever: then half as far
            halved = size >= before
            point, before = point + (change / 2 if halved else change), size
        raise LostError

    def rate_beside(self, place: float, way: int) -> float:
        """Tell how fast the load factor changes on one side of a place, where the law of a support may begin or end.

        Parameters
        ----------
        place : float
            Along the arc.
        way : int
            On which side: -1 before, 1 beyond.
        """
        for beside in BESIDE:
            with suppress(LostError):
                return float(self.at(place + way * beside).rate[-1])
        raise LostError

    def eigenvalues(self, state: State) -> np.ndarray:
        """Give numbers of the signs of the eigenvalues of the tangent stiffness, in ascending order, one a law.

        Parameters
        ----------
        state : State
            On this arc.

        Returns
        -------
        numpy.ndarray
            1 + F (slope - spring), made symmetric.

        Raises
        ------
        LostError
            The other supports soften too.
        """
        values, vectors = np.linalg.eigh((self.flexibility + self.flexibility.T) / 2)
        if values.min() < -NOISE * values.max():
            raise LostError
        root = vectors * np.sqrt(np.maximum(values, 0.0))
        return np.linalg.eigvalsh(np.eye(len(values)) + root.T @ ((state.slope - self.springs)[:, None] * root))

    def root(
        self, test: Callable[[State], float], low: float = -np.inf, high: float = np.inf, first: float = 0.0
    ) -> State:
        """Find where a function is zero, near the two states.

        Parameters
        ----------
        test : callable
            The function.
        low, high : float
            Places beyond which not to look.
        first : float
            Place at which to begin.

        Returns
        -------
        State

        Raises
        ------
        LostError
            Nowhere.
        """
        found: dict[float, float] = {}
        for place in (first, 1.0, *self._beyond()):
            if not low <= place <= high:
                continue
            try:
                found[place] = test(self.at(place))
            except LostError:
                low, high = (low, place) if place > 0.5 else (place, high)
                continue
            if found[place] == 0.0:
                return self.at(place)
            for a, b in pairwise(sorted(found)):
                if found[a] * found[b] < 0.0:
                    return self._between(test, a, b)
        raise LostError

    def roots(self, test: Callable[[State], float]) -> list[State]:
        """Find all places between the two states where a function is zero.

        Parameters
        ----------
        test : callable
            The function.

        Returns
        -------
        list of State

        Raises
        ------
        LostError
            The path is not there all along.
        """
        found = {place: test(self.at(place)) for place in np.linspace(0.0, 1.0, CLOSE).tolist()}
        before, last = (self.at(place) for place in list(found)[-2:])
        if np.abs((before.point + (last.at - before.at) * before.rate - last.point) / self.weights).max() > LONGEST:
            raise LostError  # no path from one to the other
        states = []
        for a, b in pairwise(found):
            if found[a] * found[b] < 0.0:
                # At the end of a law the sign may change without a zero
                with suppress(LostError):
                    states.append(self._between(test, a, b))
        return states

    def _beyond(self) -> Iterator[float]:
        """Places beyond the two states, farther and farther."""
        way, step = 0.0, 0.25
        while way * self._length**0.5 < max(FARTHEST, 4.0 * self._length**0.5):
            way += step
            yield from (1.0 + way, -way)
            step = max(min(2.0 * step, LONGEST / self._length**0.5), 0.25)

    def _between(self, test: Callable[[State], float], b: float, a: float) -> State:
        """Chandrupatla's method (Advances in Engineering Software 28, 1997)."""
        at_a, at_b = test(self.at(a)), test(self.at(b))
        share, size = 0.5, max(abs(at_a), abs(at_b))
        while True:
            place = a + share * (b - a)
            value = test(self.at(place))
            if (value > 0.0) == (at_a > 0.0):
                c, at_c = a, at_a
            else:
                b, c, at_b, at_c = a, b, at_a, at_b
            a, at_a = place, value
            best = a if abs(at_a) < abs(at_b) else b
            least = SETTLED * max(abs(best), 1.0) / abs(b - a) if a != b else 1.0
            if least > 0.5 or 0.0 in (at_a, at_b):
                if min(abs(at_a), abs(at_b)) > JUMP * size:
                    raise LostError  # no zero, but another path
                return self.at(a if at_a == 0.0 else b if at_b == 0.0 else best)
            x, y = (a - b) / (c - b), (at_a - at_b) / (at_c - at_b)
            share = 0.5
            if y * y < x and (1.0 - y) ** 2 < 1.0 - x:
                share = at_a / (at_b - at_a) * at_c / (at_b - at_c)
                share += (c - a) / (b - a) * at_a / (at_c - at_a) * at_b / (at_c - at_b)
            share = min(max(share, least), 1.0 - least)
