"""The way of a train over a beam as a page follows it: states at events, between them polynomials in the position."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from ..engine.beam import SOLVED
from ..results import formatting as fmt
from ..results.trains.states import Placed, TrainLoads
from ..scene.names import label
from .load_ways import DEEPEST, PIXEL, Way
from .states import Recorder, free_spans_of, joined_moments, packed, zones_of

if TYPE_CHECKING:
    from ..results.result import Result
    from ..results.trains.trains import TrainResult
    from ..results.trains.traversals import ExactTraversal, SampledTraversal
    from ..scene.trains import Course

WITH_AXLES, WITH_UNIFORM = 3, 4
"""Degrees in the position of what axles and uniform loads of a train make at the joints, while the same supports act."""
MOST_NUMBERS = 24_000
"""Numbers that a train may take on the page; where its polynomials take more, straight lines between close states do."""


class PlacedRecorder(Recorder):
    """Makes the records of states of a beam with a train on it: what axles make between the joints is added by the page."""

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
            lengths = self._beam.places.pieces[:, 0]
            x = np.where(distance == lengths[piece], self.x[piece + 1], self.x[piece] + distance)
            values = one.values(x, distance == lengths[piece])
            moment, shear = self._of_axles(one, loads, piece, x, distance == lengths[piece])
            found = {"w": values[0], "m": values[2] - moment, "v": values[3] - shear, "p": values[6]}
        return found | {"reaction": one.at_supports[0]}

    def _of_axles(
        self, one: Placed, loads: TrainLoads, piece: np.ndarray, x: np.ndarray, at_end: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Moment and shear of simple bars, as long as the pieces, under the train."""
        moment, shear = np.zeros(len(x)), np.zeros(len(x))
        left, right = self.x[piece], self.x[piece + 1]
        for _, at, end, value in loads.loads(one.position, one.acts):
            here = (at > left) & (at < right) if end == 0.0 else (np.maximum(at, left) < np.minimum(end, right))
            length = right - left
            if end == 0.0:
                share, before = (at - left) / length, (x < at) | ((x == at) & at_end)
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
    """

    def __init__(self, recorder: PlacedRecorder, largest: dict[str, float], loads: TrainLoads) -> None:
        super().__init__(recorder, largest)
        self.loads = loads
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

        Returns
        -------
        int
        """
        key = one.position, one.acts.tobytes()
        placed, columns, number = self._known[key]
        if number is None:
            number = len(self.states)
            record: dict[str, Any] = {"position": one.position}
            if self.recorder.grid is not None:
                record |= {"zones": zones_of(one.step), "free": free_spans_of(one.step)}
            packable = columns if self.recorder.grid is not None else joined_moments(columns)
            self.states.append(record | {f"{name}_packed": packed(values) for name, values in packable.items()})
            self._known[key] = placed, columns, number
        return number

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

    def halve(self, from_: float, to: float, depth: int = 0) -> None:
        """Add the interval between two positions by straight lines between states.

        Parameters
        ----------
        from_, to : float
            Its ends.
        depth : int
            Times that it has been halved.
        """
        middle = from_ + (to - from_) / 2
        acts = self.loads.acting(middle)
        ends = [self.at(position, acts) for position in (from_, middle, to)]
        if None in ends:
            return
        (one, first), (inside, found), (other, last) = ends
        straight = {name: (first[name] + last[name]) / 2 for name in first if name != "reaction"}
        if depth < DEEPEST and self.difference(straight, {name: found[name] for name in straight}) > PIXEL:
            self.halve(from_, middle, depth + 1)
            self.halve(middle, to, depth + 1)
        else:
            self.interval(from_, to, [self.number(one), self.number(other)], inside.step)


def way_of_train(
    result: Result, train: TrainResult, traversal: ExactTraversal | SampledTraversal, words: list[str], largest: dict[str, float],
    most: int = MOST_NUMBERS,
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

    Returns
    -------
    dict
    """
    course, beam = traversal.course, result._beam
    loads = TrainLoads(beam, result._rule, course, traversal.near)
    way = TrainWay(PlacedRecorder(result, words), largest, loads)
    lost = [one for one in train.unstable_positions if one.direction == course.direction]
    changes = sorted({one.position for one in traversal.events} | {end for one in lost for end in (one.from_, one.to)})
    ends = _ends(course, changes, way.recorder.x)
    degree = WITH_UNIFORM if len(course.uniform) else WITH_AXLES
    numbers = 2 * len(way.recorder.x) + len(result.scene.supports)
    exact = beam.is_linear_between_events and len(ends) * degree * numbers <= most
    for from_, to in pairwise(ends):
        if to - from_ <= 4 * traversal.near or any(one.from_ <= from_ and to <= one.to for one in lost):
            continue
        way.run(from_, to, degree) if exact else way.halve(from_, to)
    scene = result.scene
    events = []
    for one in traversal.events:
        of_support = one.support is not None
        name = fmt.support(scene, one.support) if of_support else f"foundation {label(scene.foundation, one.foundation)}"
        what = {"support": one.support} if of_support else {"foundation": one.foundation}
        events.append({"at": one.position, **what, "x": one.x, "words": f"{name} {one.event}"})
    return {
        "over": "positions" if exact else "close positions", "axis": "position", "states": way.states, "intervals": way.intervals,
        "events": sorted(events, key=lambda one: one["at"]), "left": course.direction == "left",
        "axles": np.column_stack((course.offset, course.force)).tolist(), "uniform": course.uniform.tolist(),
        "lost": [{"from": one.from_, "to": one.to, "words": one.reason} for one in lost],
    }  # fmt: skip


def _ends(course: Course, changes: list[float], x: np.ndarray) -> list[float]:
    """Positions at which something changes: events, and loads that pass a joint."""
    of_train = np.concatenate((course.offset, course.uniform[:, 1:].ravel() if len(course.uniform) else []))
    passing = (x[:, None] - of_train[None, :]).ravel()
    inside = passing[(passing > course.from_) & (passing < course.to)].tolist()
    found = sorted({course.from_, course.to, *inside, *(one for one in changes if course.from_ <= one <= course.to)})
    return found
