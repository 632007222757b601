"""The way of a train over a beam as a page follows it: states at events, between them polynomials in the position."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from heapq import heapify, heappop, heappush
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from ..engine.beam import SOLVED
from ..results.trains.sampled import SampledTraversal
from ..results.trains.states import Placed, TrainLoads
from ..scene.rotations import turns
from .load_ways import PIXEL, Way, of_event
from .states import Recorder, joined_moments, on_ground, packed

if TYPE_CHECKING:
    from ..results.result import Result
    from ..results.trains.trains import TrainResult
    from ..results.trains.traversals import ExactTraversal
    from ..scene.trains import Course

AT_SUPPORTS = ("reaction", "deflection", "opening")
"""Values at supports that a state may have: the first where it does not follow from the shear, all where joints hold rotations."""
WITH_AXLES, WITH_UNIFORM = 3, 4
"""Degrees in the position of what axles and uniform loads of a train make at the joints, while the same supports act."""
MOST_NUMBERS = 40_000
"""Numbers that trains may take on the page; where polynomials take more, parabolas between fewer states do."""
LEAST_STATES = 100
"""States of a train on the ground or on smooth laws that are always drawn."""


class PlacedRecorder(Recorder):
    """Makes the records of states of a beam with a train on it: what axles make between the joints is added by the page."""

    def __init__(self, result: Result, words: list[str]) -> None:
        super().__init__(result, words)
        self._at = result.scene.positions(result.scene.supports)
        self.turning = any(map(turns, result.scene.supports))

    def placed(self, one: Placed, loads: TrainLoads) -> dict[str, np.ndarray]:
        """Give the numbers of a state between which states are drawn.

        Parameters
        ----------
        one : Placed
            A solved one.
        loads : TrainLoads
            Of the beam.

        Returns
        -------
        dict
            As `columns`, on the ground without the jumps and kinks below axles; and the reactions.
        """
        if self.grid is None:
            w, m = (one.values(self.x, np.arange(len(self.x)) == len(self.x) - 1)[row] for row in (0, 2))
            left = one.values(self.x[1:], np.ones(len(self.x) - 1, bool))[2]
            found = {"w": w, "m": m[:-1], "m_left": left}
        else:
            piece, distance = self.grid
            x, at_end = self._beam.places.x_of(piece, distance)
            values = one.values(x, at_end)
            moment, shear = self._of_axles(one, loads, piece, x, at_end)
            found = {"w": values[0], "m": values[2] - moment, "v": values[3] - shear, "p": values[6]}
        rows = one.at_supports if self.with_reactions else ()
        return found | dict(zip(AT_SUPPORTS, rows if self.turning else rows[:1], strict=False))

    @cached_property
    def with_reactions(self) -> bool:
        """Whether reactions do not follow from jumps of the shear: on the ground, and where two supports may act at one place."""
        beam, x = self._beam, self._at
        if self.turning:
            return True
        across, levels = np.flatnonzero(beam.across), beam.places.levels
        for one, other in pairwise(across[np.lexsort((beam.sides[across], x[across]))].tolist()):
            if x[one] == x[other] and not (beam.sides[one] == -1 and beam.sides[other] == 1 and levels[one] < levels[other]):
                return True
        return self.grid is not None

    def _of_axles(
        self, one: Placed, loads: TrainLoads, piece: np.ndarray, x: np.ndarray, at_end: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Moment and shear of simple bars, as long as the pieces, under the train."""
        moment, shear, near = np.zeros(len(x)), np.zeros(len(x)), loads.near
        left, right = self.x[piece], self.x[piece + 1]
        for _, at, end, value in loads.loads(one.position, one.acts):
            here = (at > left + near) & (at < right - near) if end == 0.0 else (np.maximum(at, left) < np.minimum(end, right))
            length = right - left
            if end == 0.0:
                share, before = (at - left) / length, (x < at - near) | ((x <= at + near) & at_end)
                moment += np.where(here, value * np.where(before, (1 - share) * (x - left), share * (right - x)), 0.0)
                shear += np.where(here, value * np.where(before, 1 - share, -share), 0.0)
            else:
                a, b = np.maximum(at, left), np.minimum(end, right)
                total, behind = value * (b - a), value * np.clip(x - a, 0.0, np.maximum(b - a, 0.0))
                at_left = total * (right - (a + b) / 2) / length
                lever = x - a - np.clip(x - a, 0.0, np.maximum(b - a, 0.0)) / 2
                moment += np.where(here, at_left * (x - left) - behind * lever, 0.0)
                shear += np.where(here, at_left - behind, 0.0)
        return moment, shear


class TrainWay(Way):
    """States and intervals of a train in one direction.

    Parameters
    ----------
    recorder : PlacedRecorder
        Of the beam.
    largest : dict
        Largest value of every field.
    loads : TrainLoads
        Puts the train on the beam.

    Attributes
    ----------
    numbers : int
        How many a state takes.
    """

    def __init__(self, recorder: PlacedRecorder, largest: dict[str, float], loads: TrainLoads) -> None:
        super().__init__(recorder, largest)
        self.loads = loads
        self.rows: list[dict[str, np.ndarray]] = []
        grid = recorder.grid
        at_supports = len(AT_SUPPORTS) if recorder.turning else int(recorder.with_reactions)
        self.numbers = (2 * len(recorder.x) if grid is None else 4 * len(grid[0])) + at_supports * len(loads.beam.sides)
        self._known: dict[tuple[float, bytes], tuple[Placed, dict[str, np.ndarray], int | None]] = {}

    def at(self, position: float, acts: np.ndarray) -> tuple[Placed, dict[str, np.ndarray]] | None:
        """Solve at a position.

        Parameters
        ----------
        position : float
            Of the train.
        acts : numpy.ndarray of bool
            Which axles act.

        Returns
        -------
        (Placed, dict) or None
            With its numbers; None where it is not solved.
        """
        key = position, acts.tobytes()
        if key not in self._known:
            one = self.loads.state(position, acts)
            if one.status != SOLVED:
                return None
            self._known[key] = one, self.recorder.placed(one, self.loads), None
        return self._known[key][:2]

    def number(self, one: Placed) -> int:
        """Give the number of a state on the page.

        Parameters
        ----------
        one : Placed
            A solved one.
        """
        key = one.position, one.acts.tobytes()
        placed, columns, number = self._known[key]
        if number is None:
            number = len(self.states)
            self.states.append(on_ground(one.step) if self.recorder.grid is not None else {})
            self.rows.append(columns)
            self._known[key] = placed, columns, number
        return number

    def matrix(self) -> dict[str, Any]:
        """Give the numbers of all states.

        Returns
        -------
        dict
            ``columns`` names with their lengths, ``packed`` the states one after the other.
        """
        rows = self.rows
        if self.recorder.grid is None:  # no couples: one moment for both sides of a joint
            shorter = [joined_moments(row) for row in rows]
            rows = shorter if all("m_left" not in row for row in shorter) else rows
        columns = [[name, len(values)] for name, values in rows[0].items()] if rows else []
        flat = [values for row in rows for values in row.values()]
        return {"columns": columns, "packed": packed(np.concatenate(flat)) if flat else ""}

    def run(self, from_: float, to: float, degree: int) -> None:
        """Add the interval between two positions, as one polynomial, or halved until straight lines do.

        Parameters
        ----------
        from_, to : float
            Its ends; the same axles act, on the same pieces of the beam.
        degree : int
            Of the polynomials in the position.
        """
        middle = from_ + (to - from_) / 2
        acts = self.loads.acting(middle)
        nodes = [self.at(position, acts) for position in np.linspace(from_, to, degree + 1).tolist()]
        inside = self.at(middle, acts)
        if inside is None or None in nodes:
            return
        self.interval(from_, to, [self.number(one) for one, _ in nodes], inside[0].step)

    def refine(self, ends: list[float], most: int) -> float:
        """Add parabolas and straight lines between states; the worst are halved as long as they are wrong by more than a pixel.

        Parameters
        ----------
        ends : list of float
            Positions between which to begin.
        most : int
            States that are taken.

        Returns
        -------
        float
            By how many pixels the worst is wrong at the end.
        """
        queue = [one for pair in pairwise(ends) if (one := self._parabola(*pair)) is not None]
        heapify(queue)
        while len(queue) < most // 2 and queue and -queue[0][0] > PIXEL:
            _, from_, middle, to = heappop(queue)
            for one in (self._parabola(from_, middle), self._parabola(middle, to)):
                if one is not None:
                    heappush(queue, one)
        lines = sorted(((self._straight(one), one) for one in queue), reverse=True)
        bent = [pair for pair in lines[: max(most - len(lines), 0)] if pair[0] > PIXEL]  # a parabola takes one state more
        straight = lines[len(bent) :]
        runs = [(one[1], one[3], 2) for _, one in bent] + [(one[1], one[3], 1) for _, one in straight]
        for run in sorted(runs):
            self.run(*run)
        return max((*(-one[0] for _, one in bent), *(error for error, _ in straight)), default=0.0) / PIXEL

    def _straight(self, one: tuple[float, float, float, float]) -> float:
        """Error of a straight line where a parabola may stand."""
        _, from_, middle, to = one
        acts = self.loads.acting(middle)
        first, inside, last = (self.at(position, acts)[1] for position in (from_, middle, to))
        drawn = {name: (first[name] + last[name]) / 2 for name in inside if name not in AT_SUPPORTS}
        return self.difference(drawn, {name: inside[name] for name in drawn})

    def _parabola(self, from_: float, to: float) -> tuple[float, float, float, float] | None:
        """Error of parabolas between two positions, less than 0 so that the worst comes first; and positions."""
        positions = [from_ + (to - from_) * part for part in (0.0, 0.25, 0.5, 0.75, 1.0)]
        acts = self.loads.acting(positions[2])
        states = [self.at(position, acts) for position in positions]
        if to - from_ <= 4 * self.loads.near or None in states:
            return None
        nodes, error = [states[k][1] for k in (0, 2, 4)], 0.0
        for (_, found), parts in ((states[1], (3, 6, -1)), (states[3], (-1, 6, 3))):
            drawn = {name: sum(part * one[name] for part, one in zip(parts, nodes, strict=True)) / 8 for name in found}
            drawn, found = ({name: values for name, values in one.items() if name not in AT_SUPPORTS} for one in (drawn, found))
            error = max(error, self.difference(drawn, found))
        return -error, from_, positions[2], to


def way_of_train(
    result: Result, train: TrainResult, traversal: ExactTraversal | SampledTraversal, words: list[str], largest: dict[str, float],
    most: int = MOST_NUMBERS, also: Sequence[float] = (),
) -> dict[str, Any]:  # fmt: skip
    """Give the way of a train in one direction.

    Parameters
    ----------
    result : Result
        Of one load.
    train : TrainResult
        One of its trains.
    traversal : ExactTraversal or SampledTraversal
        The train in one direction.
    words : list of str
        Words for the states of supports.
    largest : dict
        Largest value of every field over all positions.
    most : int
        Numbers that it may take.
    also : sequence of float
        Positions whose states are given too.
    """
    course, beam = traversal.course, result._beam
    sampled = isinstance(traversal, SampledTraversal)
    loads = traversal.loads if sampled else TrainLoads(beam, result._rule, course, traversal.near)
    way = TrainWay(PlacedRecorder(result, words), largest, loads)
    lost = [one for one in train.unstable_positions if one.direction == course.direction]
    changes = sorted({one.position for one in traversal.events} | {end for one in lost for end in (one.from_, one.to)} | {*also})
    ends = _ends(course, changes, way.recorder.x)
    degree = WITH_UNIFORM if len(course.uniform) else WITH_AXLES
    exact, worst = beam.is_linear_between_events and len(ends) * degree * way.numbers <= most, 0.0
    if not exact:
        kept = ends if beam.in_stretches else _kept(course, changes, way.recorder.x)
        worst = way.refine(kept, max(LEAST_STATES, most // way.numbers))
    for from_, to in pairwise(ends if exact else []):
        if to - from_ > 4 * traversal.near and not any(one.from_ <= from_ and to <= one.to for one in lost):
            way.run(from_, to, degree)
    events = [{"at": one.position, **of_event(result.scene, one)} for one in traversal.events]
    return {
        "over": "positions" if exact else "close positions", "axis": "position",
        "states": way.states if beam.in_stretches else len(way.states),
        **way.matrix(), **way.to_dict(),
        "events": sorted(events, key=lambda one: one["at"], reverse=course.direction == "left"), "left": course.direction == "left",
        "axles": np.column_stack((course.offset, course.force)).tolist(), "uniform": course.uniform.tolist(),
        "pixels": worst, "lost": [{"from": one.from_, "to": one.to, "words": one.reason} for one in lost],
    }  # fmt: skip


def _ends(course: Course, changes: list[float], x: np.ndarray) -> list[float]:
    """Positions at which something changes: events, and loads that pass a joint."""
    of_train = np.concatenate((course.offset, course.uniform[:, 1:].ravel() if len(course.uniform) else []))
    passing = (x[:, None] - of_train[None, :]).ravel()
    inside = passing[(passing > course.from_) & (passing < course.to)].tolist()
    found = sorted({course.from_, course.to, *inside, *(one for one in changes if course.from_ <= one <= course.to)})
    return found


def _kept(course: Course, changes: list[float], x: np.ndarray) -> list[float]:
    """Positions of `_ends` but those at which loads pass inner joints."""
    return _ends(course, changes, x[[0, -1]])
