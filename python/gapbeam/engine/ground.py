"""Zones in which the ground acts on a solved beam, from the compiled layer."""

from __future__ import annotations

import numpy as np

from ..base.errors import check_status
from . import calls as _engine
from .beam import Beam
from .states import Ground


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
