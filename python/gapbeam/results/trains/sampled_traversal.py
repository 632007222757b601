"""Trains over foundations and smooth laws: states at positions near to each other, and what changes between them.

With zones of contact and curves no formula says how a state depends on the position. The engine solves the beam on a grid of
positions and finds the changes between neighbours; those that undo each other between two neighbours are not seen.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...base.errors import EngineError, SceneError, Status
from ...engine.beam import SOLVED
from ...engine.runs import Runs
from ...scene.trains import LEFT, Course
from ..paths.compression_check import tensions
from ..state.breakpoints import EVENTS
from .influence import influence_line
from .sampled_members import SampledMember
from .states import TrainLoads
from .traversals import TrainEvent, UnstablePositions, word_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..paths.compression import Compression
    from ..paths.struts import Struts
    from ..result import Result
    from .trains import TrainResult, TrainState


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
