"""Trains over foundations and smooth laws: states at positions near to each other, and what changes between them.

With zones of contact and curves no formula says how a state depends on the position. Where an axle comes to an end of the beam,
to a support, a hinge, a force, another section or an end of a foundation is known beforehand; between such places the beam is
solved on a grid, finer than the length in which it bends (4 EI/k)^(1/4) and than its spans, and where neighbours differ the
change between them is found (`train_changes`). Changes that undo each other between two neighbours are not seen.
"""

from __future__ import annotations

from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...base.errors import EngineError, SceneError, Status
from ...engine.beam import SOLVED
from ...engine.ground import zone_changes
from ...scene.ground_laws import CubicGround
from ...scene.trains import LEFT, Course
from ..paths.compression_check import tensions
from ..state.breakpoints import EVENTS, what_happens
from .changes import neighbours
from .grid import grid_step, places_of_jumps, places_of_kinks
from .influence import influence_line
from .sampled_members import SampledMember
from .states import SHEAR, Placed, TrainLoads
from .tops import Straight, Unrolled
from .traversals import TrainEvent, UnstablePositions, word_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..paths.compression import Compression
    from ..paths.struts import Struts
    from ..result import Result
    from .trains import TrainResult, TrainState

LEAST = 4
"""Parts into which the way from one place to the next is cut at least."""
MOST_STATES = 20_000
"""States beyond which a train is refused: they would take minutes."""
NEIGHBOURS = 2.0**-45
"""Share of the beam between positions that are neighbours."""
NEXT_TO = 2.0**-32
"""Next to a change a state may not be settled, since a zone has next to no length there: positions on both sides of it that are as
near as this share of the beam are neighbours."""
BESIDE = 2.0**-26
"""Share of the beam by which an axle stands beside a support when the shear between both is asked for: nearer to it, hardly any
digits of it would be left."""
MOST_CHANGES = 64
"""Changes between two states of the grid, beyond which they are not told apart."""


class Run(NamedTuple):
    """Positions one after the other between two changes, all solved, with the same axles on the beam.

    Attributes
    ----------
    states : list of Placed
        In ascending order.
    """

    states: list[Placed]


class Limit(NamedTuple):
    """A shear between an axle and the support or force that it comes to, which is not there when it has come.

    Attributes
    ----------
    value : float
        The shear.
    x : float
        Place of the support or force.
    side : {"left", "right"}
        On which side of it the axle is.
    state : Placed
        That with the axle on it.
    position : float
        One beside it, at which the axle is on that side.
    """

    value: float
    x: float
    side: str
    state: Placed
    position: float


class SampledTraversal:
    """A train that has gone over the beam in one direction.

    Parameters
    ----------
    result : Result
        Its beam.
    course : Course
        What it is.
    near : float
        Distance below which an axle is at the end of the beam.
    name : str
        Of the train.

    Attributes
    ----------
    course, near
        As above.
    loads : TrainLoads
        Solves at further positions.
    jumps : numpy.ndarray
        Places at which the shear jumps without the train.
    runs : list of Run
        The states, in ascending order.
    events : list of TrainEvent
        In the order in which they happen.
    unstable_positions : list of UnstablePositions
        Positions that are not solved.
    solves : int
        Linear solves of these, without those for extremes.
    """

    def __init__(self, result: Result, course: Course, near: float, name: str):
        self.course, self.near = course, near
        self.loads = TrainLoads(result._beam, result._rule, course, near)
        self.jumps = places_of_jumps(result.scene)
        self._scene, self._name = result.scene, name
        self._neighbours = NEIGHBOURS * result._beam.places.end
        self._read(self._walk())
        self._fill_short_runs()
        self.solves = self.loads.solves

    def compressions(self, struts: Struts, tension: np.ndarray) -> Iterator[Compression | None]:
        """Go through the largest compressions beside the Euler load, one a position, as `ExactTraversal.compressions`."""
        for run in self.runs:
            for state in run.states:
                if state.status == SOLVED:
                    here = type(struts)(state.beam)
                    yield here.of_step(self._scene, state.step, tensions(state.beam, state.step))

    def members(self, train: TrainResult, combination: str | None) -> list[SampledMember]:
        """Give what an envelope is made of.

        Parameters
        ----------
        train : TrainResult
            Whose traversal it is.
        combination : str or None
            Name of the combination.
        """
        return [SampledMember(train, self, combination)]

    def influence(
        self, state: TrainState, what: str, x: float, chosen: np.ndarray, places: np.ndarray, side: str
    ) -> np.ndarray:
        """Give an influence line, as `ExactTraversal.influence`."""
        return influence_line(state, what, x, chosen, places, side)

    def ruler(self, low: float, high: float) -> Unrolled | Straight:
        """Give what positions between two changes are measured by, so that values are smooth up to the ends.

        Parameters
        ----------
        low, high : float
            First and last position.

        Returns
        -------
        Unrolled or Straight
            Zones of contact are born on the ground only.
        """
        return Unrolled(low, high) if self.loads.beam.ground_layers and high > low else Straight()

    @cached_property
    def limits(self) -> list[Limit]:
        """Shears between axles and the supports and forces that they come to."""
        found, course, near = [], self.course, self.near
        for run in self.runs:
            if len(run.states) < 2:
                continue
            for state, sign, side in ((run.states[0], 1.0, "right"), (run.states[-1], -1.0, "left")):
                places = state.position + course.offset
                for x in self.jumps.tolist():
                    there = state.acts & (np.abs(places - x) <= near)
                    if there.any():
                        shear = state.values(np.array([x]), np.array([side == "left"]))[SHEAR, 0]
                        value = float(shear + sign * course.force[there].sum())
                        found.append(Limit(value, x, side, state, state.position + sign * BESIDE * self.loads.beam.places.end))
        return found

    def shown_position(self, state: Placed) -> float:
        """Give the next position at which the axles of a state are on the beam: its own but where an axle is just beside an end."""
        for away in (0.0, -4 * self.near, 4 * self.near):
            if np.array_equal(self.loads.acting(state.position + away), state.acts):
                return state.position + away
        return state.position

    def _borders(self) -> np.ndarray:
        """Positions between which states change smoothly as long as the same acts."""
        course, places = self.course, places_of_kinks(self._scene)
        ends = course.uniform[:, 1:].ravel()
        met = (places[:, None] - np.concatenate((course.offset, ends))).ravel()
        met = np.unique(met[(met > course.from_) & (met < course.to)])
        met = np.concatenate(([course.from_], met, [course.to]))
        apart = np.append(True, np.diff(met) > 4 * self.near)
        met = met[apart]
        met[-1] = course.to
        return met

    def _grid(self, borders: np.ndarray) -> np.ndarray:
        """Parts between the borders."""
        parts = np.ceil(np.diff(borders) / grid_step(self._scene, self.loads.beam, self._largest_deflection())).astype(int)
        parts = np.maximum(parts, LEAST)
        if (count := int(parts.sum())) > MOST_STATES:
            problem = f"the train {self._name} would take states at {count:,} positions, which is too many"
            raise SceneError("trains", f"{problem}; give from and to, or a train with fewer axles")
        return parts

    def _largest_deflection(self) -> float:
        """How far the beam goes down or up about, on ground that gets stiffer by that; 0 without."""
        if not (self.loads.beam.columns.foundation[6, :-1] == CubicGround.code).any():
            return 0.0
        course = self.course
        states = [self.loads.state(course.from_ + share * (course.to - course.from_)) for share in (0.25, 0.5, 0.75)]
        return max((float(np.abs(one.extremes[0][:, 0]).max()) for one in states if one.status == SOLVED), default=0.0)

    def _walk(self) -> list[list[Placed]]:
        """All states in ascending order, cell by cell; in a cell the same axles are on the beam."""
        course, loads = self.course, self.loads
        first = loads.state(course.from_)
        if course.from_ == course.to:
            return [[first]]
        borders = self._borders()
        cells, here = [], [first]
        for (start, stop), parts in zip(pairwise(borders.tolist()), self._grid(borders).tolist(), strict=True):
            acts = loads.acting(start + (stop - start) / 2)
            if not np.array_equal(acts, here[-1].acts):
                cells.append(here)
                here = [loads.state(start, acts, of_grid=True)]
                here[0].take_undecided(cells[-1][-1])
            elif len(here) > 1:
                cells.append(here)
                here = here[-1:]
            for k in range(1, parts + 1):
                at = stop if k == parts else start + (stop - start) * k / parts
                self._advance(here, loads.state(at, acts, of_grid=True))
            on_it = loads.acting(stop)
            if not np.array_equal(on_it, acts):
                cells.append(here)
                here = [loads.state(stop, on_it)]
                here[0].take_undecided(cells[-1][-1])
        return [*cells, here]

    def _advance(self, here: list[Placed], then: Placed) -> None:
        """Go on to a state, with the neighbours of every change in between."""
        for _ in range(MOST_CHANGES):
            then.take_undecided(here[-1])
            if here[-1].is_like(then):
                here.append(then)
                return
            below, above = neighbours(self.loads, here[-1], then, self._neighbours)
            if below is not here[-1]:
                here.append(below)
            here.append(above)
            if above is then:
                return
        where = f"changes near position {then.position:.12g} of train {self._name}"
        raise EngineError(f"{where} are too many to be told apart", Status.NOT_CONVERGED)

    def _read(self, cells: list[list[Placed]]) -> None:
        """Runs, events and unstable positions from all states."""
        narrow = NEXT_TO * self.loads.beam.places.end
        self.runs: list[Run] = []
        self.unstable_positions: list[UnstablePositions] = []
        events: list[TrainEvent] = []
        last: Placed | None = None
        missing: list[Placed] = []
        for states in cells:
            run: list[Placed] = []
            for state in states:
                if state.status != SOLVED:
                    if missing and missing[-1].status != state.status:
                        self._note_gap(missing)
                        missing, last = [], None
                    missing.append(state)
                    run = []
                    continue
                if missing and not (last and _is_narrow(missing, last, state, narrow)):
                    self._note_gap(missing)
                    last = None
                missing = []
                if last is not None and last is not state and not last.is_like(state):
                    events += self._changes(last, state)
                    run = []
                if not run:
                    self.runs.append(Run(run := []))
                run.append(state)
                last = state
        if missing:
            self._note_gap(missing)
        back = self.course.direction == LEFT
        self.events = events[::-1] if back else events
        if back:
            self.unstable_positions.reverse()

    def _fill_short_runs(self) -> None:
        """Solve in the middle between two changes with nothing between: two states do not tell how values bend."""
        for run in self.runs:
            if len(run.states) == 2 and run.states[1].position - run.states[0].position > 4 * self._neighbours:
                first, last = run.states
                middle = self.loads.state(first.position + (last.position - first.position) / 2, first.acts)
                middle.take_undecided(first)
                if first.is_like(middle) and middle.is_like(last):
                    run.states.insert(1, middle)

    def _note_gap(self, states: list[Placed]) -> None:
        first, last = states[0], states[-1]
        found = UnstablePositions(first.position, last.position, first.reason, self.course.direction, word_of(first.status))
        self.unstable_positions.append(found)

    def _changes(self, below: Placed, above: Placed) -> list[TrainEvent]:
        """What changes between two neighbours, in the direction of the train."""
        back = self.course.direction == LEFT
        before, after = (above, below) if back else (below, above)
        direction, at = self.course.direction, after.position
        found = []
        for k, (was, is_) in enumerate(zip(before.pieces, after.pieces, strict=True)):
            if was is None or is_ is None or was == is_:
                continue
            words = what_happens(was, is_) if k in before.beam.laws else "closes" if is_.number else "opens"
            if words:
                found.append(TrainEvent(at, k, float(self._support_places[k]), words, direction))
        ground, later = before.step.solution.ground, after.step.solution.ground
        if ground is not None:
            _, about, x = zone_changes(before.beam, ground, after.beam, later)
            found += [
                TrainEvent(at, None, self._at_end(place), EVENTS[event], direction, foundation, branch)
                for (foundation, branch, event), place in zip(about.tolist(), x.tolist(), strict=True)
            ]
        return found[::-1] if back else found

    def _at_end(self, x: float) -> float:
        """A place, or the end of the beam or of a foundation that is as near as neighbouring positions: zones begin there."""
        return float(min(self._ends, key=lambda end: abs(end - x))) if np.abs(self._ends - x).min() <= 4 * self._neighbours else x

    @cached_property
    def _ends(self) -> np.ndarray:
        end = self.loads.beam.places.end
        stretches = [(item.from_, end if item.to is None else item.to) for item in self._scene.foundation]
        return np.unique([0.0, end, *np.array(stretches).ravel()])

    @cached_property
    def _support_places(self) -> np.ndarray:
        return self._scene.positions(self._scene.supports)


def _is_narrow(missing: list[Placed], last: Placed, state: Placed, narrow: float) -> bool:
    """Whether states were only not settled, next to a change."""
    unsettled = all(one.status in (Status.NOT_CONVERGED, Status.NOT_FINITE) for one in missing)
    return unsettled and state.position - last.position <= narrow
