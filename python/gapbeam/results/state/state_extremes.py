"""Largest and smallest fields of one state."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..views.extreme import KINDS, Extreme, Source
from .fields import find_places

if TYPE_CHECKING:
    from ...engine.beam import Beam
    from .step import Step


class StateExtreme(Extreme):
    """A largest or smallest field of one state; its attributes are those of `Extreme`."""

    def __init__(self, state: Step, beam: Beam, quantity: str, value: float, x: float, source: Source):
        super().__init__(quantity, value, x, source)
        self._state, self._beam = state, beam

    @property
    def state(self) -> Step:
        """The state in which it is the value."""
        return self._state

    @cached_property
    def concurrent(self) -> dict[str, float]:
        """What the other fields are at the same place, on the side of the extreme."""
        rows = [self._state.values(*find_places(self._beam, np.array([self.x]), side))[:, 0] for side in ("right", "left")]
        of = self._beam.fields[self.quantity]
        there = min(rows, key=lambda row: abs(float(row[of]) - self.value))
        return {name: float(there[k]) for name, k in self._beam.fields.items() if name != self.quantity}


def extremes_of_state(state: Step, beam: Beam, source: Source) -> dict[str, dict[str, StateExtreme]]:
    """Find the largest and smallest fields of a state.

    Parameters
    ----------
    state : Step
    beam : Beam
        Its beam.
    source : Source
        Where it comes from.

    Returns
    -------
    dict
        By field, then by ``max`` and ``min``.
    """
    values, x = (table.tolist() for table in state.solution.extremes())
    return {
        name: {kind: StateExtreme(state, beam, name, values[i][k], x[i][k], source) for i, kind in enumerate(KINDS)}
        for name, k in beam.fields.items()
    }
