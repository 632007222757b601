"""A train over foundations or smooth laws as a source of an envelope, from states at some positions."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...engine.quantities import FIELDS
from ..envelopes.envelope import AT_SUPPORTS
from ..state.ground import size_of
from .lines import Lines
from .members import Member, TrainExtreme, fields_of
from .peaks import Peak, find_peaks
from .states import Placed

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
        column, sign = FIELDS.index(quantity), 1.0 - 2.0 * i
        limits = [Peak(sign * one.value, one.state, one) for one in self._traversal.limits] if quantity == "shear" else []
        found = find_peaks(self._traversal, lambda state: sign * float(state.extremes[0][i, column]), limits)
        ties = []
        for peak in found:
            if peak.limit is not None:
                x, side, position = peak.limit.x, peak.limit.side, peak.limit.position
            else:
                x = float(peak.state.extremes[1][i, column])
                side, position = _side(peak.state, x, column, sign * peak.value), self._traversal.shown_position(peak.state)
            ties.append(TrainExtreme(self, quantity, sign * peak.value, x, side, None, position))
        return ties

    def of_supports(self, support: int, quantity: str, i: int) -> list[TrainExtreme]:
        """As `Member.of_supports`."""
        row, sign = AT_SUPPORTS.index(quantity), 1.0 - 2.0 * i
        found = find_peaks(self._traversal, lambda state: sign * float(state.at_supports[row, support]))
        return [
            TrainExtreme(self, quantity, sign * peak.value, None, None, support, self._traversal.shown_position(peak.state))
            for peak in found
        ]

    def of_foundations(self, foundation: int, quantity: str, i: int) -> list[TrainExtreme]:
        """As `Member.of_foundations`."""
        sign = 1.0 - 2.0 * i

        def value(state: Placed) -> float:
            if quantity == "resultant":
                return sign * float(state.resultants[foundation])
            return size_of(state.free_span(foundation, quantity), quantity)

        found = []
        for peak in find_peaks(self._traversal, value):
            span = None if quantity == "resultant" else peak.state.free_span(foundation, quantity)
            if quantity == "resultant" or span is not None:
                position = self._traversal.shown_position(peak.state)
                found.append(TrainExtreme(self, quantity, sign * peak.value, None, None, None, position, foundation, span))
        return found

    def curves(self, x: np.ndarray, left: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """As `Member.curves`."""
        beam = self._traversal.loads.beam
        lines = Lines(self._traversal, x, left | (x >= beam.places.end), [FIELDS.index(name) for name in fields_of(beam)])
        return lines.best, lines.at

    def state_of(self, extreme: TrainExtreme) -> Step:
        """As `Member.state_of`."""
        return self._train.state(extreme.position, self.direction)


def _side(state: Placed, x: float, column: int, value: float) -> str | None:
    """On which side of a place a field has a value; None where it does not jump."""
    right, left = state.values(np.array([x, x]), np.array([False, True]))[column].tolist()
    if abs(right - left) <= 2.0**-40 * abs(value):
        return None
    return "left" if abs(left - value) < abs(right - value) else "right"
