"""Changes between two states of a train: neighbouring positions around each.

How far a support, or a zone of contact, still is from its change tells where that is (secants, from the side on which there is such
a distance); where that does not lead on, the way is cut in half.
"""

from __future__ import annotations

from typing import NamedTuple

from ...engine.beam import SOLVED
from ...engine.ground import zone_changes
from ..state.breakpoints import EVENTS
from .states import Placed, TrainLoads


class Change(NamedTuple):
    """The first of the changes between two states.

    Attributes
    ----------
    support, foundation : int or None
        What changes, a support without a law or with a smooth one, or a foundation.
    x : float
        Its place.
    branch : int
        Of a foundation's law.
    event : str
        What happens to a zone.
    """

    support: int | None
    foundation: int | None
    x: float
    branch: int
    event: str


def neighbours(loads: TrainLoads, below: Placed, above: Placed, width: float) -> tuple[Placed, Placed]:
    """Find neighbouring positions around the first change between two states.

    Parameters
    ----------
    loads : TrainLoads
        Solves.
    below, above : Placed
        The states.
    width : float
        Distance of neighbours.

    Returns
    -------
    below, above : Placed
        Neighbours; what is before the change is like the first state.
    """
    roots = _Roots()
    while (gap := above.position - below.position) > width:
        roots.look_at(below, above)
        place = roots.next_place(below.position, above.position, width)
        place = below.position + gap / 2 if place is None else place
        if not below.position < place < above.position:
            break
        state = loads.state(place, below.acts)
        state.take_undecided(below)
        if below.is_like(state):
            below = state
        else:
            above = state
    return below, above


class _Roots:
    """Where the distance from a change is 0, from the states at which it is known."""

    def __init__(self):
        self._what: tuple | None = None
        self._known: dict[bool, list[tuple[float, float]]] = {}  # of states below and above: position, distance
        self._before: float | None = None
        self._last_gap, self._short = float("inf"), False
        self._turns = 0

    def look_at(self, below: Placed, above: Placed) -> None:
        """Take the states on both sides."""
        change = _first_change(below, above)
        what = None if change is None else (change.support, change.foundation, change.branch, change.event)
        if what != self._what:
            self._what, self._known, self._before = what, {False: [], True: []}, None
        for is_above, state in ((False, below), (True, above)) if change is not None else ():
            points = self._known[is_above]
            if not points or points[-1][0] != state.position:
                points.append((state.position, _distance(state, change)))

    def next_place(self, low: float, high: float, width: float) -> float | None:
        """Give the place to look at next; None if that cannot be told, or does not lead on."""
        self._turns = 0 if high - low < self._last_gap / 8 else self._turns + 1
        self._last_gap = high - low if self._turns == 0 else self._last_gap
        if self._what is None or self._turns > 3:
            self._turns, self._last_gap, self._before = 0, high - low, None
            return None
        found = []
        for is_above, points in self._known.items():
            (first, far), (second, near) = points[-2:] if len(points) > 1 else ((0.0, 0.0), (0.0, 0.0))
            if far > near > 0.0:
                root = second + near * (second - first) / (far - near)
                found.append((abs(root - second), root, -1.0 if is_above else 1.0))
        if not found:
            return None
        way, root, onward = min(found)
        beyond = way / 4 if self._before is None else min(way / 4, 2 * abs(root - self._before))
        self._before, self._short = root, not self._short
        place = root + (-onward if self._short else onward) * max(beyond, width / 4)
        return place if low < place < high else None


def _first_change(below: Placed, above: Placed) -> Change | None:
    """What changes; None if it is no matter of distances."""
    if below.status != SOLVED or above.status != SOLVED:
        return None
    for k, (was, is_) in enumerate(zip(below.pieces, above.pieces, strict=True)):
        if was is not None and is_ is not None and (was.number, was.way) != (is_.number, is_.way):
            return None if k in below.beam.laws.keys() - below.beam.smooth else Change(k, None, 0.0, 1, "")
    ground, after = below.step.solution.ground, above.step.solution.ground
    if ground is None:
        return None
    _, about, x = zone_changes(below.beam, ground, above.beam, after)
    if not len(about):
        return None
    foundation, branch, event = about[0].tolist()
    return Change(None, foundation, float(x[0]), branch, EVENTS[event])


def _distance(state: Placed, what: Change) -> float:
    """How far a state is from the change, in a measure that goes to 0 linearly with the position; 0 where there is none."""
    if what.support in state.beam.smooth:
        return abs(float(state.past[[k for k, _ in state.beam.curves].index(what.support)]))
    if what.support is not None:
        piece = state.pieces[what.support]
        row = 2 if piece is not None and piece.number == 0 else 0
        return abs(float(state.at_supports[row, what.support]))
    runs = [run for run in state.step.runs if run.foundation == what.foundation and not run.touches]
    if what.event in ("end reaches", "end leaves"):
        ends = [abs(end - what.x) for run in runs if run.acts >= what.branch for end in (run.from_, run.to)]
        return min((end for end in ends if end > 0.0), default=0.0)
    acts = what.event in ("zone appears", "zone vanishes")
    here = [run for run in runs if (run.acts >= what.branch) == acts and run.from_ <= what.x <= run.to]
    if not here:
        return 0.0
    length = here[0].to - here[0].from_
    # Inside, a zone or the gap between two is as long as the square root of the way
    return length if here[0].from_ == runs[0].from_ or here[0].to == runs[-1].to else length**2
