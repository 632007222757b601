"""Ground along a beam in a state: smallest axial forces, and where the beam slides."""

from __future__ import annotations

import numpy as np

from . import calls as _engine
from .states import Solution


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
