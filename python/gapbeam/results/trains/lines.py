"""Largest and smallest fields at places of the beam over all positions of a train, from states at some of them.

At a place values are smooth in the position but where an axle comes to it, and where something changes. Polynomials through the
states nearest to an extreme value tell its position so well that one more state there gives the value.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from .peaks import ALIKE, NEAREST
from .states import SHEAR, Placed
from .tops import Straight, Unrolled, highest, nearer, vertex

if TYPE_CHECKING:
    from .sampled_traversal import SampledTraversal

MOST_STEPS = 5
"""Polynomials after which the best state is taken; one or two do."""


class Lines:
    """Fields at places of the beam, in all states of a train.

    Parameters
    ----------
    traversal : SampledTraversal
        The states.
    x : numpy.ndarray
        The places.
    left : numpy.ndarray of bool
        Where the value left of a place is meant.
    rows : sequence of int
        Fields of the engine.
    """

    def __init__(self, traversal: SampledTraversal, x: np.ndarray, left: np.ndarray, rows: list[int]):
        self._traversal, self._x, self._left, self._rows = traversal, x, left, rows
        shape = 2, len(rows), len(x)
        self.best, self.at = np.full(shape, -np.inf), np.full(shape, np.nan)
        self._tables = [np.array([self._values(state) for state in run.states]) for run in traversal.runs]
        sizes = [np.abs(table).max(axis=(0, 2)) for table in self._tables]
        self._scale = np.max(sizes, axis=0) if sizes else np.ones(len(rows))
        self._on_jump = np.isin(x, traversal.jumps)
        self._passed: dict[float, Placed] = {}
        self._take_limits()
        positions = [np.array([state.position for state in run.states]) for run in traversal.runs]
        for at, table in zip(positions, self._tables, strict=True):
            self._take_all(at, table)
        # The more is known, the fewer places may have more
        tables = zip(traversal.runs, positions, self._tables, strict=True)
        for run, at, table in sorted(tables, key=lambda one: -np.abs(one[2]).max()):
            self._climb(run.states, at, table)
        self.best[1] *= -1.0

    def _values(self, state: Placed) -> np.ndarray:
        """Fields at the places, fields by places."""
        return state.values(self._x, self._left)[self._rows]

    def _take_all(self, at: np.ndarray, table: np.ndarray) -> None:
        """Consider states."""
        for i, sign in enumerate((1.0, -1.0)):
            which = (sign * table).argmax(axis=0)
            values = sign * np.take_along_axis(table, which[None], axis=0)[0]
            better = values > self.best[i]
            self.best[i][better] = values[better]
            self.at[i][better] = at[which][better]

    def _take(self, i: int, row: int, k: int, value: float, position: float) -> None:
        """Consider one value."""
        if value > self.best[i, row, k]:
            self.best[i, row, k], self.at[i, row, k] = value, position

    def _take_limits(self) -> None:
        """Consider shears between an axle and the support or force to which it comes."""
        row = self._rows.index(SHEAR)
        for limit in self._traversal.limits:
            here = np.flatnonzero((np.abs(self._x - limit.x) <= self._traversal.near) & (self._left == (limit.side == "left")))
            for k in here.tolist():
                for i, sign in enumerate((1.0, -1.0)):
                    self._take(i, row, k, sign * limit.value, limit.position)

    def _climb(self, states: list[Placed], at: np.ndarray, table: np.ndarray) -> None:
        """Find what is greater between the states of a run."""
        if len(states) < 2:
            return
        ruler = self._traversal.ruler(states[0].position, states[-1].position)
        for k in range(len(self._x)):
            passed = self._pass(k, states)
            for start, stop in pairwise((float(at[0]), *passed, float(at[-1]))):
                part = self._part(k, start, stop, states, at, table[:, :, k], passed)
                if part is not None:
                    where, values = part
                    for row in range(len(self._rows)):
                        self._climb_line(row, k, ruler.angle(where), values[:, row], states[0], ruler)

    def _pass(self, k: int, states: list[Placed]) -> dict[float, np.ndarray]:
        """Consider the positions at which axles stand at a place; give the fields on both sides of it at those inside a run."""
        low, high, beside = states[0].position, states[-1].position, 4 * self._traversal.near
        met = np.unique(self._x[k] - self._traversal.course.offset[states[0].acts])
        passed = {}
        for position in met[(met >= low - beside) & (met <= high + beside)].tolist():
            at_end = states[0] if position <= low + beside else states[-1] if position >= high - beside else None
            if at_end is not None and self._on_jump[k]:
                continue  # _take_limits has them
            state = self._state(position, states[0]) if at_end is None else at_end
            if state.status != states[0].status:
                continue
            both = state.values(self._x[[k, k]], np.array([False, True]))[self._rows].T
            of_beam = [row != SHEAR for row in self._rows]  # what jumps there without an axle has two places
            both[:, of_beam] = both[int(self._left[k]), of_beam]
            if at_end is None:
                passed[position] = both
            for i, sign in enumerate((1.0, -1.0)):
                for row, value in enumerate((sign * both).max(axis=0).tolist()):
                    self._take(i, row, k, value, state.position)
        return passed

    def _part(
        self, k: int, start: float, stop: float, states: list[Placed], at: np.ndarray, table: np.ndarray,
        passed: dict[float, np.ndarray],
    ) -> tuple[np.ndarray, np.ndarray] | None:  # fmt: skip
        """Give positions from one to another, one at least between, and the fields there; None where one is not solved."""
        inside = (at > start) & (at < stop)
        where, values = at[inside], table[inside]
        if not len(where):
            middle = self._state(start + (stop - start) / 2, states[0])
            if middle.status != states[0].status or not start < middle.position < stop:
                return None
            where, values = np.array([middle.position]), middle.values(self._x[[k]], self._left[[k]])[self._rows].T
            for i, sign in enumerate((1.0, -1.0)):
                for row, value in enumerate(values[0].tolist()):
                    self._take(i, row, k, sign * value, middle.position)
        ends = []
        for position, end in ((start, 0), (stop, -1)):
            both = passed.get(position)
            if both is None:
                ends.append(table[end])
            else:  # on which side of a passing axle the field goes on, the neighbour tells
                ends.append(np.take_along_axis(both, np.abs(both - values[end]).argmin(axis=0)[None], axis=0)[0])
        return np.concatenate(([start], where, [stop])), np.vstack((ends[0], values, ends[1]))

    def _state(self, position: float, like: Placed) -> Placed:
        if position not in self._passed:
            self._passed[position] = self._traversal.loads.state(position, like.acts)
        return self._passed[position]

    @np.errstate(over="ignore")  # beside the greatest number a forecast may be beyond it
    def _climb_line(
        self, row: int, k: int, at: np.ndarray, values: np.ndarray, like: Placed, ruler: Unrolled | Straight
    ) -> None:
        """Find what is greater between positions, as angles of a ruler, where the values at one place are known."""
        rise, widths = np.diff(values), np.diff(at)
        bend = np.abs(np.diff(rise / widths)) * np.maximum(widths[1:], widths[:-1])
        gain = np.concatenate((bend[:1], bend, bend[-1:]))
        for i, sign in enumerate((1.0, -1.0)):
            up = np.concatenate(([0.0], sign * rise))
            down = np.concatenate((-sign * rise, [0.0]))
            hills = (up >= 0.0) & (down >= 0.0) & (gain > 2.0**-48 * self._scale[row])
            # Zones are born at the ends of a run only, not where an axle passes
            if not ruler.begins(at[0]):
                hills[0] &= down[0] <= gain[0]
            if not ruler.ends(at[-1]):
                hills[-1] &= up[-1] <= gain[-1]
            hills &= sign * values + gain > self.best[i, row, k]
            for j in np.flatnonzero(hills).tolist():
                self._climb_hill(i, row, k, at, values, j, like, ruler)

    def _climb_hill(
        self, i: int, row: int, k: int, at: np.ndarray, values: np.ndarray, j: int, like: Placed, ruler: Unrolled | Straight
    ) -> None:
        """Go to the top near a state by polynomials through its neighbours."""
        sign = 1.0 - 2.0 * i
        first = min(max(j - NEAREST // 2, 0), max(len(at) - NEAREST, 0))
        near = slice(first, first + NEAREST)
        states = dict(zip(at[near].tolist(), (sign * values[near]).tolist(), strict=True))
        left, right, best = float(at[max(j - 1, 0)]), float(at[min(j + 1, len(at) - 1)]), float(at[j])
        place, height = self._top(at[near], sign * values[near], left, right, ruler)
        if height is not None and len(states) == NEAREST:
            gain = height - sign * float(values[j])
            if height + gain < self.best[i, row, k]:
                return  # even with twice of what the polynomial gains here, the greatest is elsewhere
        width = right - left
        for _ in range(MOST_STEPS):
            at_end = place is None and (ruler.begins(best) or ruler.ends(best))
            if at_end:
                place = nearer(best, left, right, width, ruler)
            if place is None or place in states:
                return
            position = ruler.position(place)
            # Beside the birth of a zone all places are looked at in the same states
            state = self._state(position, like) if at_end else self._traversal.loads.state(position, like.acts)
            if state.status != like.status:
                return
            value = sign * float(state.values(self._x[[k]], self._left[[k]])[self._rows[row], 0])
            self._take(i, row, k, value, state.position)
            if height is not None and abs(value - height) <= ALIKE * self._scale[row]:
                return
            states[place] = value
            if best in (left, right) and value < states[best]:
                left, right = sorted((best, place))
            best = max(best, place, key=states.get)
            place, height = vertex(best, states, left, right)

    def _top(
        self, at: np.ndarray, values: np.ndarray, left: float, right: float, ruler: Unrolled | Straight
    ) -> tuple[float | None, float | None]:
        """Top of the polynomial in the angle or of that in the position, whichever is higher."""
        place, height = highest(at, values, left, right)
        if place is None or not ruler.bears_zones:
            return place, height
        positions = np.array([ruler.position(one) for one in at.tolist()])
        other, higher = highest(positions, values, ruler.position(left), ruler.position(right))
        return (place, height) if other is None or higher <= height else (float(ruler.angle(other)), higher)
