"""A train over foundations or smooth laws as a source of an envelope, from states at some positions."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...engine.quantities import FIELDS
from ...engine.runs import OF_FIELD, OF_FREE_SPAN, OF_RESULTANT, OF_SUPPORT
from ...engine.trains import SIDES
from ..envelopes.envelope import AT_SUPPORTS
from ..state.ground import FreeSpan
from .members import Member, TrainExtreme, fields_of

if TYPE_CHECKING:
    from ..state.step import Step
    from .sampled_traversal import SampledTraversal
    from .trains import TrainResult


class SampledMember(Member):
    """A train that goes over the beam in one direction, known at positions near to each other.

    Parameters
    ----------
    train : TrainResult
        The train.
    traversal : SampledTraversal
        One of its traversals.
    combination : str or None
        Name of the combination.
    """

    def __init__(self, train: TrainResult, traversal: SampledTraversal, combination: str | None):
        super().__init__(combination)
        self.train, self.direction, self.unstable_positions = train.name, traversal.course.direction, traversal.unstable_positions
        self._train, self._traversal = train, traversal

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
