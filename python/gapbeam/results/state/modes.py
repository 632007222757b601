"""Modes of a state: how a beam buckles under more of its axial forces, and how it vibrates."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...base.records import Record, read_only
from ...engine.modes import BUCKLING, VIBRATION, shape_of_mode, values_of_modes

if TYPE_CHECKING:
    from .step import Step

KINDS = {"buckling": BUCKLING, "vibration": VIBRATION}


@dataclass(frozen=True, slots=True, eq=False)
class Mode(Record):
    """How a beam moves in a mode, with the supports and the ground that act.

    Attributes
    ----------
    kind : {"buckling", "vibration"}
        Of which it is a mode.
    value : float
        Factor of all axial forces N, or circular frequency (rad per unit of time).
    x, deflection : numpy.ndarray
        Places and deflections (length), positive downward, the largest 1.
    moment : numpy.ndarray
        Moments (force*length) with these, left and right of the places, 2 rows.
    """

    kind: str
    value: float
    x: np.ndarray
    deflection: np.ndarray
    moment: np.ndarray


def modes_of(step: Step, kind: str, count: int) -> tuple[float, ...]:
    """Find the first values of modes of a state.

    Parameters
    ----------
    step : Step
        The state.
    kind : {"buckling", "vibration"}
        Factors of its axial forces, or circular frequencies.
    count : int
        How many.

    Returns
    -------
    tuple of float
        In rising order; fewer where there are no more.

    Raises
    ------
    EngineError
        They are not available for this beam.
    """
    return tuple(values_of_modes(step.solution.state, KINDS[kind], count).tolist()) if count else ()


def mode_of(step: Step, kind: str, value: float) -> Mode:
    """Find how a beam moves in a mode.

    Parameters
    ----------
    step, kind
        As for `modes_of`.
    value : float
        One of its values.

    Returns
    -------
    Mode

    Raises
    ------
    EngineError
        They are not available for this beam.
    """
    return Mode(kind, value, *map(read_only, shape_of_mode(step.solution.state, KINDS[kind], value)))
