"""The ground of a solved beam, from the compiled layer: where it acts, along the axis too, and smallest axial forces there."""

from __future__ import annotations

import numpy as np

from ..base.errors import check_status
from . import calls as _engine
from .beam import Beam
from .states import Ground, Solution


def ground_runs(beam: Beam, ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """Join stretches beside each other in which a layer of ground does the same.

    Parameters
    ----------
    beam : Beam
    ground : Ground
        A solution.

    Returns
    -------
    about : numpy.ndarray of int
        Foundation, side (1 below, -1 above, 0 both), pieces of its law (0: linear), the piece on which it acts (0: no
        contact), 1 where it only touches, of every run, runs by 5: by foundation, below before above, from left to right.
    values : numpy.ndarray
        Its ends, the force on the beam (up) and the largest distance between beam and ground, runs by 4, in the scene's
        units.

    Raises
    ------
    EngineError
        There is no memory.
    """
    number, about, values, status, message = _engine.gbgrun(beam.handle, ground.state.handle, ground.stretches, ground.layers)
    check_status(status, message)
    return about.T[:number], values.T[:number]


def least_tensions(solution: Solution) -> np.ndarray:
    """Give the smallest axial force of every piece.

    Parameters
    ----------
    solution : Solution
        Of a beam on such ground.

    Returns
    -------
    numpy.ndarray
        In the scene's units, tension positive.
    """
    beam = solution.state.beam
    return _engine.gbleas(beam.handle, solution.state.handle, beam.pieces)


def parts_that_slide(solution: Solution) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Tell where the beam slides, or has slid last.

    Parameters
    ----------
    solution : Solution
        As for `least_tensions`.

    Returns
    -------
    places : numpy.ndarray
        Left and right ends (rows) of the parts.
    ways : numpy.ndarray of int
        1 to the right, -1 to the left.
    forces : numpy.ndarray
        Force of the ground on the beam along each, to the right.
    """
    beam, most = solution.state.beam, 4 * solution.state.beam.pieces
    while True:
        number, places, ways, forces = _engine.gbpart(beam.handle, solution.state.handle, most)
        if number <= most:
            return places[:, :number], ways[:number], forces[:number]
        most = number
