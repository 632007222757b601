"""Traversal of a beam on the ground or on smooth laws by a train: a handle in the compiled layer, and typed calls with it."""

from __future__ import annotations

from threading import Lock

import numpy as np

from ..base.errors import check_status
from . import calls as _engine
from .beam import RULES, Beam

OF_FIELD, OF_SUPPORT, OF_RESULTANT, OF_FREE_SPAN = 1, 2, 3, 4
"""What extremes are asked of, as in gapbeam_train_asked."""


class Runs:
    """A train that has gone over a beam on the ground or on smooth laws.

    Parameters
    ----------
    beam : Beam
        The beam; its loads stay, dead and live ones in full.
    rule : {"block", "single"}
        How contact states are found.
    offset, force, uniform, from_, to, backwards
        As for `Traversal`.

    Attributes
    ----------
    positions : numpy.ndarray
        At which it is solved, in ascending order.
    run, acts : numpy.ndarray
        Number of the run of each, in which nothing changes; which axles act, positions by axles.
    lost, lost_acts : numpy.ndarray
        First and last of positions that are not solved, a row each; which axles act at the first.
    status : numpy.ndarray of int
        Of these as Status, or NOT_UNIQUE.
    places, events : numpy.ndarray
        Of every event the position, and the place; support and foundation of the scene, -1 for the other, branch, and what happens
        (gapbeam_pieces).
    solves : int
        Linear solves.
    are_some_of_several : bool
        Whether the beam may have other states at these positions.

    Raises
    ------
    EngineError
        There are too many positions, changes that cannot be told apart, numbers beyond the range of doubles.
    """

    def __init__(
        self, beam: Beam, rule: str, offset: np.ndarray, force: np.ndarray, uniform: np.ndarray, from_: float, to: float,
        backwards: bool,
    ):  # fmt: skip
        self.beam = beam
        self._made_of = beam, rule, offset, force, uniform, from_, to, backwards
        handle, sizes, status, message = _engine.gbrmak(
            beam.handle, offset, force, np.vstack((uniform, np.zeros(3))).T, from_, to, int(backwards), RULES[rule]
        )
        check_status(status, message)
        self._handle, self._one_at_a_time = _engine.Owned(handle), Lock()
        solved, lost, events, self.solves, several = sizes.tolist()
        self.are_some_of_several = several == 1
        place, run, acts, ends, codes, lost_acts, where, what = _engine.gbrget(
            handle, len(offset), solved + 1, lost + 1, events + 1
        )
        self.positions, self.run, self.acts = place[:solved], run[:solved], acts.T[:solved] == 1
        self.lost, self.status, self.lost_acts = ends.T[:lost], codes[:lost], lost_acts.T[:lost] == 1
        self.places, self.events = where.T[:events], what.T[:events]

    def __reduce__(self) -> tuple:
        """Pickle, or copy, by what it is made of: the handle is worth nothing elsewhere."""
        return type(self), self._made_of

    def extremes(self, of: int, number: int, row: int, i: int) -> tuple[np.ndarray, np.ndarray]:
        """Find the largest (0) or smallest (1) value of a quantity over all positions.

        Parameters
        ----------
        of : int
            OF_FIELD, OF_SUPPORT, OF_RESULTANT or OF_FREE_SPAN.
        number, row, i : int
            The quantity, or support or foundation, from 0; of a support 0 reaction, 1 deflection, 2 opening, 3 couple; of a free
            span 0 length, 1 sag.

        Returns
        -------
        values : numpy.ndarray
            Value, x, position, ends and sag of a free span, ties by 6; none where no position is solved.
        sides : numpy.ndarray of int
            Index into SIDES.

        Raises
        ------
        EngineError
            As for the states.
        """
        with self._one_at_a_time:
            ties, values, sides, status, message = _engine.gbrext(self.beam.handle, self._handle, of, number + 1, row + 1, i)
        check_status(status, message)
        return values.T[:ties], sides[:ties]

    def curves(self, quantities: list[int], x: np.ndarray, left: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Largest and smallest values at places of the beam.

        Parameters
        ----------
        quantities : list of int
            Columns of `FIELDS`.
        x, left : numpy.ndarray
            The places; where the value left of one is meant.

        Returns
        -------
        values, positions : numpy.ndarray
            Largest and smallest, by quantities, by places; positions of the train. Infinite where no position is solved.

        Raises
        ------
        EngineError
            As for the states.
        """
        which = np.array(quantities, dtype=np.int32) + 1
        with self._one_at_a_time:
            values, positions, status, message = _engine.gbrcur(self.beam.handle, self._handle, which, x, left.astype(np.int32))
        check_status(status, message)
        largest = np.finfo(float).max
        values[values >= largest], values[values <= -largest] = np.inf, -np.inf
        return values, positions

    def lead(self, position: float, placed: _engine.Handle) -> None:
        """Let states of a beam on which the train stands begin where the train comes to on its way.

        Parameters
        ----------
        position : float
            Of the train.
        placed : Handle
            That beam.

        Raises
        ------
        EngineError
            As for the states.
        """
        with self._one_at_a_time:
            check_status(*_engine.gbrway(self.beam.handle, self._handle, position, placed))
