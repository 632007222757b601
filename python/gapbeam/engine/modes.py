"""Modes of solved states: factors of the axial forces at which a beam buckles, frequencies at which it vibrates."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..base.errors import check_status
from . import calls as _engine
from .states import State

BUCKLING, VIBRATION = 1, 2
"""What is asked for, as in gapbeam_state_modes."""
ROOM, PARTS = 4096, 16
"""Places of a shape at first; places on every stretch at least, so that its curve can be drawn."""


class Buckling(NamedTuple):
    """How a beam gives way that does not bear its axial forces.

    Attributes
    ----------
    share : float
        How much of them it bears, all other loads in full.
    x, deflection : numpy.ndarray
        Places and deflections as it gives way, the largest 1.
    """

    share: float
    x: np.ndarray
    deflection: np.ndarray


def values_of_modes(state: State, what: int, count: int) -> np.ndarray:
    """Find the first values of modes, with the supports and the ground that act in a state.

    Parameters
    ----------
    state : State
        Solved.
    what : {BUCKLING, VIBRATION}
        Factors of all axial forces, or circular frequencies (rad per unit of time).
    count : int
        How many.

    Returns
    -------
    numpy.ndarray
        In rising order; fewer where there are no more.

    Raises
    ------
    EngineError
        They are not available for this beam.
    """
    values, found, status, message = _engine.gbmode(state.beam.handle, state.handle, what, count)
    check_status(status, message)
    return values[:found]


class Shape(NamedTuple):
    """How a beam moves in a mode.

    Attributes
    ----------
    x, deflection : numpy.ndarray
        Places and deflections there, the largest 1.
    moment : numpy.ndarray
        Moments left and right of them with these, 2 rows.
    amplitude : float
        How many times these deflections swing when a support opens or closes first; infinite where none does.
    support : int
        Number of that support in the scene; -1 where there is none.
    """

    x: np.ndarray
    deflection: np.ndarray
    moment: np.ndarray
    amplitude: float
    support: int


def shape_of_mode(state: State, what: int, value: float) -> Shape:
    """Find how a beam moves in a mode.

    Parameters
    ----------
    state, what
        As for `values_of_modes`.
    value : float
        One of its values.

    Raises
    ------
    EngineError
        They are not available for this beam.
    """
    room = ROOM
    while True:
        x, w, moment, amplitude, support, found, status, message = _engine.gbshap(
            state.beam.handle, state.handle, what, value, PARTS, room
        )
        check_status(status, message)
        if found <= room:
            return Shape(x[:found], w[:found], moment[:, :found], amplitude, support)
        room = found


def buckled_shape(state: State) -> tuple[np.ndarray, np.ndarray]:
    """Find how a beam gives way that does not bear its axial forces.

    Parameters
    ----------
    state : State
        Of such a beam.

    Returns
    -------
    x, deflection : numpy.ndarray
        Places, and deflections there, the largest 1.
    """
    room = ROOM
    while True:
        x, w, found = _engine.gbbuck(state.beam.handle, state.handle, room)
        if found <= room:
            return x[:found], w[:found]
        room = found
