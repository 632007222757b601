"""Trains over foundations and smooth laws: states at positions near to each other, and what changes between them.

With zones of contact and curves no formula says how a state depends on the position. The engine solves the beam on a grid of
positions and finds the changes between neighbours; those that undo each other between two neighbours are not seen.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...base.errors import EngineError, SceneError, Status
from ...engine.beam import SOLVED
from ...engine.quantities import FIELDS
from ...engine.runs import OF_FIELD, OF_FREE_SPAN, OF_RESULTANT, OF_SUPPORT, Runs
from ...engine.trains import SIDES
from ...scene.trains import LEFT, Course
from ..envelopes.envelope import AT_SUPPORTS
from ..paths.compression_check import tensions
from ..state.breakpoints import EVENTS
from ..state.ground import FreeSpan
from .influence import influence_line
from .members import Passing, TrainExtreme, fields_of
from .states import TrainLoads
from .traversals import TrainEvent, UnstablePositions, word_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..paths.compression import Compression
    from ..paths.struts import Struts
    from ..result import Result
    from ..state.step import Step
    from .trains import TrainResult


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
    engine : Runs
        As the engine followed it, from state to state.
    loads : TrainLoads
        Solves at further positions.
    events : list of TrainEvent
        In the order in which they happen.
    unstable_positions : list of UnstablePositions
        Positions that are not solved.
    """

    def __init__(self, result: Result, course: Course, near: float, name: str):
        self.course, self.near, self._scene = course, near, result.scene
        self.loads = TrainLoads(result._beam, result._rule, course, near)
        try:
            self.engine = Runs(
                result._beam, result._rule, course.offset, course.force, course.uniform, course.from_, course.to,
                course.direction == LEFT,
            )  # fmt: skip
        except EngineError as error:
            if error.status != Status.BAD_INPUT:
                raise
            raise SceneError("trains", f"the train {name} {error}") from None
        self.loads.runs = self.engine
        places, events = self.engine.places.tolist(), self.engine.events.tolist()
        self.events = [
            TrainEvent(position, None if k < 0 else k, x, EVENTS[what], course.direction, None if f < 0 else f, branch)
            for (position, x), (k, f, branch, what) in zip(places, events, strict=True)
        ]
        self.unstable_positions = [
            UnstablePositions(first, last, self.loads.state(first, acts).reason, course.direction, word_of(status))
            for (first, last), acts, status in zip(
                self.engine.lost.tolist(), self.engine.lost_acts, self.engine.status.tolist(), strict=True
            )
        ]

    @property
    def solves(self) -> int:
        """Linear solves of the states and events, without those for extremes."""
        return self.engine.solves

    def compressions(self, struts: Struts, tension: np.ndarray) -> Iterator[Compression | None]:
        """Go through the largest compressions beside the Euler load, one a position, as `ExactTraversal.compressions`."""
        for position, acts in zip(self.engine.positions.tolist(), self.engine.acts, strict=True):
            state = self.loads.state(position, acts)
            if state.status == SOLVED:
                yield type(struts)(state.beam).of_step(self._scene, state.step, tensions(state.beam, state.step))

    def members(self, train: TrainResult, combination: str | None) -> list[SampledMember]:
        """Give what an envelope is made of, as `ExactTraversal.members`."""
        return [SampledMember(train, self, combination)]

    influence = staticmethod(influence_line)


class SampledMember(Passing):
    """A train that goes over the beam in one direction, known at positions near to each other; made as `Passing`."""

    def of_fields(self, quantity: str, i: int) -> list[TrainExtreme]:
        """As `Member.of_fields`."""
        values, sides = self._traversal.engine.extremes(OF_FIELD, FIELDS.index(quantity), 0, i)
        return [
            TrainExtreme(self, quantity, value, x, SIDES[side], None, position)
            for (value, x, position, *_), side in zip(values.tolist(), sides.tolist(), strict=True)
        ]

    def of_supports(self, support: int, quantity: str, i: int) -> list[TrainExtreme]:
        """As `Member.of_supports`."""
        values, _ = self._traversal.engine.extremes(OF_SUPPORT, support, AT_SUPPORTS.index(quantity), i)
        return [TrainExtreme(self, quantity, value, None, None, support, position) for value, _, position, *_ in values.tolist()]

    def of_foundations(self, foundation: int, quantity: str, i: int) -> list[TrainExtreme]:
        """As `Member.of_foundations`."""
        if quantity == "resultant":
            values, _ = self._traversal.engine.extremes(OF_RESULTANT, foundation, 0, i)
            found = [(value, position, None) for value, _, position, *_ in values.tolist()]
        else:
            values, _ = self._traversal.engine.extremes(OF_FREE_SPAN, foundation, ("length", "sag").index(quantity), i)
            found = [
                (value, position, FreeSpan(foundation, from_, to, sag))
                for value, _, position, from_, to, sag in values.tolist() if to > from_
            ]  # fmt: skip
        return [TrainExtreme(self, quantity, value, None, None, None, at, foundation, span) for value, at, span in found]

    def curves(self, x: np.ndarray, left: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """As `Member.curves`."""
        beam = self._traversal.loads.beam
        return self._traversal.engine.curves([FIELDS.index(name) for name in fields_of(beam)], x, left | (x >= beam.places.end))

    def state_of(self, extreme: TrainExtreme) -> Step:
        """As `Member.state_of`."""
        return self._train.state(extreme.position, self.direction)
