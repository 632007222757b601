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
    from ...engine.states import Solution
    from ...scene.structs import Scene
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


class StepModes:
    """What a state is asked about its modes: how it buckles under more of its axial forces, and how it vibrates."""

    solution: Solution

    def modes(self, kind: str, count: int = 1) -> tuple[float, ...]:
        """Find the first values of modes with the supports and the ground that act in this state.

        Parameters
        ----------
        kind : {"buckling", "vibration"}
            Factors of its axial forces, or circular frequencies (rad per unit of time), which need `analysis.frequencies`
            above 0.
        count : int
            How many.

        Returns
        -------
        tuple of float
            In rising order; fewer where there are no more.

        Raises
        ------
        ValueError
            There is no such kind, or `count` is not 1 or more.
        EngineError
            Modes are not available for this beam.
        """
        if kind not in KINDS:
            raise ValueError(f'kind: expected "buckling" or "vibration", got {kind!r}')
        count = _positive("count", count)
        return tuple(values_of_modes(self.solution.state, KINDS[kind], count).tolist())

    def mode(self, kind: str, number: int = 1) -> Mode:
        """Find how the beam moves in a mode.

        Parameters
        ----------
        kind
            As for `modes`.
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
        number = _positive("number", number)
        values = self.modes(kind, number)
        if number > len(values):
            asked = "buckling" if kind == "buckling" else "frequencies"
            there = f"there are {len(values)} such modes, got {number}"
            raise ValueError(f"number: {there}; analysis.{asked} and the beam say how many")
        value = values[number - 1]
        shape = shape_of_mode(self.solution.state, KINDS[kind], value)
        support = None if shape.support < 0 else int(shape.support)
        return Mode(kind, value, *map(read_only, shape[:3]), float(shape.amplitude), support)


def _positive(key: str, value: int) -> int:
    """Check a whole number that is 1 or more."""
    value = whole(key, value)
    if value < 1:
        raise ValueError(f"{key}: expected 1 or more, got {value}")
    return value


class WithModes:
    """What is asked of the last state of a beam about its modes."""

    scene: Scene
    steps: Steps

    @cached_property
    def buckling(self) -> tuple[float, ...]:
        """Factors of all axial forces at which the beam buckles as it stands at the end; see `analysis.buckling`."""
        count = self.scene.analysis.buckling
        return self.steps[-1].modes("buckling", count) if count else ()

    @cached_property
    def frequencies(self) -> tuple[float, ...]:
        """Circular frequencies (rad per unit of time) of the beam as it stands at the end; see `analysis.frequencies`."""
        count = self.scene.analysis.frequencies
        return self.steps[-1].modes("vibration", count) if count else ()

    def mode(self, kind: str, number: int = 1) -> Mode:
        """Find how the beam moves in a mode at the end of the load, as `Step.mode` does of a step.

        Parameters
        ----------
        kind : {"buckling", "vibration"}
            Which modes are meant.
        number : int
            Which of them, from 1.

        Returns
        -------
        Mode
        """
        return self.steps[-1].mode(kind, number)
