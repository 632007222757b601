"""Modes of a state: how a beam buckles under more of its axial forces, and how it vibrates."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ...base.records import Record, read_only
from ...engine.modes import BUCKLING, VIBRATION, shape_of_mode, values_of_modes
from .arguments import whole

if TYPE_CHECKING:
    from ...scene.structs import Scene
    from .step import Step
    from .steps import Steps

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
    amplitude : float
        How many times these deflections (length) swing when a support opens or closes first: beyond that the beam is another one.
        Infinite where no support can. Zones of contact with one-sided ground move with any.
    support : int or None
        Number of that support.
    """

    kind: str
    value: float
    x: np.ndarray
    deflection: np.ndarray
    moment: np.ndarray
    amplitude: float
    support: int | None


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
    return tuple(values_of_modes(step.solution.state, KINDS[kind], count).tolist())


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
    shape = shape_of_mode(step.solution.state, KINDS[kind], value)
    support = None if shape.support < 0 else int(shape.support)
    return Mode(kind, value, *map(read_only, shape[:3]), float(shape.amplitude), support)


class WithModes:
    """What is asked of the last state of a beam about its modes."""

    scene: Scene
    steps: Steps

    @cached_property
    def buckling(self) -> tuple[float, ...]:
        """Factors of all axial forces at which the beam buckles as it stands at the end; see `analysis.buckling`."""
        count = self.scene.analysis.buckling
        return modes_of(self.steps[-1], "buckling", count) if count else ()

    @cached_property
    def frequencies(self) -> tuple[float, ...]:
        """Circular frequencies (rad per unit of time) of the beam as it stands at the end; see `analysis.frequencies`."""
        count = self.scene.analysis.frequencies
        return modes_of(self.steps[-1], "vibration", count) if count else ()

    def mode(self, kind: str, number: int = 1) -> Mode:
        """Find how the beam moves in a mode.

        Parameters
        ----------
        kind : {"buckling", "vibration"}
            Which modes are meant.
        number : int
            Which of them, from 1.

        Returns
        -------
        Mode

        Raises
        ------
        ValueError
            There is no such mode.
        EngineError
            Modes are not available for this beam.
        """
        if kind not in KINDS:
            raise ValueError(f'kind: expected "buckling" or "vibration", got {kind!r}')
        number = whole("number", number)
        asked = "buckling" if kind == "buckling" else "frequencies"
        values = modes_of(self.steps[-1], kind, max(number, getattr(self.scene.analysis, asked)))
        if not 1 <= number <= len(values):
            there = f"there are {len(values)} such modes, got {number}"
            raise ValueError(f"number: {there}; analysis.{asked} and the beam say how many")
        return mode_of(self.steps[-1], kind, values[number - 1])
