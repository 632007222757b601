"""Traversal of a prepared beam by a train: a handle in the compiled layer, and typed calls with it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..base.errors import check_status
from ..base.records import Record
from . import calls as _engine
from .beam import Beam
from .quantities import BENDING

NOT_UNIQUE = 3
"""Status of stretches on which the beam can move freely without work of the loads, as in gapbeam_train_path."""
SIDES = (None, "left", "right")
"""On which side of x a value is, as in gapbeam_train_envelope."""


@dataclass(frozen=True, slots=True, eq=False)
class Extremes(Record):
    """Largest and smallest values of some quantities, with all ties.

    Attributes
    ----------
    count : numpy.ndarray of int
        Ties of the largest (first) and of the smallest value of every quantity, 2 by quantities.
    values : numpy.ndarray
        Value, x, position of every tie, 2 by quantities by ties by 3.
    sides : numpy.ndarray of int
        Index into SIDES; 2 by quantities by ties.
    """

    count: np.ndarray
    values: np.ndarray
    sides: np.ndarray


class Traversal:
    """A train that has gone over a beam.

    Parameters
    ----------
    beam : Beam
        The beam; its loads stay, dead and live ones in full.
    offset, force : numpy.ndarray
        Distances of the axles from the place of the train, to the right, and their forces (down).
    uniform : numpy.ndarray
        Uniform loads (down), and the distances from the place of the train between which each acts: a row a load.
    from_, to : float
        Positions of the train.
    backwards : bool
        Whether it goes towards smaller positions; only the order of the events depends on it.

    Attributes
    ----------
    ends : numpy.ndarray
        First and last position of every stretch, in ascending order.
    status, motion_of : numpy.ndarray of int
        As Status, or NOT_UNIQUE; number of its motion, from 1 (0: none, or the beam slides along its axis).
    closed : numpy.ndarray of int
        Scheme of every stretch.
    motions : numpy.ndarray
        Displacements of the nodes, a row a motion.
    positions, events : numpy.ndarray
        Of every event the position; support of the scene, its state from there on, what happens (gapbeam_pieces).
    solves : int
        Linear solves.

    Raises
    ------
    EngineError
        No unique state exists at some position.
    """

    def __init__(
        self, beam: Beam, offset: np.ndarray, force: np.ndarray, uniform: np.ndarray, from_: float, to: float, backwards: bool,
    ):  # fmt: skip
        self.beam = beam
        self._made_of = beam, offset, force, uniform, from_, to, backwards
        handle, sizes, status, message = _engine.gbtmak(
            beam.handle, offset, force, np.vstack((uniform, np.zeros(3))).T, from_, to, int(backwards)
        )
        check_status(status, message)
        self._handle = _engine.Owned(handle)
        stretches, motions, events, self.solves = sizes.tolist()
        ends, codes, closed, motion, position, what = _engine.gbtget(
            handle, beam.supports + 1, beam.links, stretches + 1, motions + 1, events + 1
        )
        self.ends = ends.T[:stretches]
        self.status, self.motion_of = codes[:, :stretches]
        self.closed = closed.T[:stretches, :-1]
        self.motions = motion.T[:motions]
        self.positions, self.events = position[:events], what.T[:events]

    def __reduce__(self) -> tuple:
        """Pickle, or copy, by what it is made of: the handle is worth nothing elsewhere."""
        return type(self), self._made_of

    def extremes(self) -> tuple[Extremes, list[Extremes]]:
        """Largest and smallest values over all positions, and where they are.

        Returns
        -------
        fields : Extremes
            Of `BENDING`.
        supports : list of Extremes
            Of reaction, opening, deflection, couple of every support of the scene.

        Raises
        ------
        EngineError
            No memory.
        """
        count = self.beam.scene_supports
        fields, sides, ties, supports, support_sides, support_ties, status, message = _engine.gbtenv(
            self.beam.handle, self._handle, count + 1, len(BENDING)
        )
        check_status(status, message)
        return Extremes(ties, fields.T.swapaxes(0, 1), sides.T.swapaxes(0, 1)), [
            Extremes(support_ties[:, :, k], supports[..., k].T.swapaxes(0, 1), support_sides[..., k].T.swapaxes(0, 1))
            for k in range(count)
        ]

    def curves(self, piece: np.ndarray, distance: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Largest and smallest values at places of the beam.

        Parameters
        ----------
        piece, distance
            As for `Solution.values`.

        Returns
        -------
        values, positions : numpy.ndarray
            Largest and smallest, by `BENDING`, by places; positions of the train. Infinite where no
            position is solved.

        Raises
        ------
        EngineError
            No memory.
        """
        values, positions, status, message = _engine.gbtcur(self.beam.handle, self._handle, len(BENDING), piece, distance)
        check_status(status, message)
        largest = np.finfo(float).max
        values[values >= largest], values[values <= -largest] = np.inf, -np.inf
        return values, positions

    def influence(
        self, closed: np.ndarray, supports: np.ndarray, piece: int, distance: float, places: np.ndarray
    ) -> np.ndarray:
        """Influence lines of a scheme.

        Parameters
        ----------
        closed : numpy.ndarray of int
            The scheme.
        supports : numpy.ndarray of bool
            Supports of the scene whose reactions and couples are meant.
        piece, distance
            A place of the beam, as for `Solution.values`.
        places : numpy.ndarray
            Where the unit force is.

        Returns
        -------
        numpy.ndarray
            `BENDING` at the place, and sums of the reactions and of the couples, by places.

        Raises
        ------
        EngineError
            The state is not unique.
        """
        values, status, message = _engine.gbtinf(
            self.beam.handle, self._handle, len(BENDING) + 2, np.append(closed, 0).astype(np.int32),
            np.append(supports, False).astype(np.int32),
            piece, distance, places,
        )  # fmt: skip
        check_status(status, message)
        return values
