"""Parts of a beam on which an influence line has one sign."""

from __future__ import annotations

import numpy as np

from ..base.errors import check_status
from . import calls as _engine
from .beam import Beam
from .quantities import BENDING

LINES = (*BENDING, "reaction", "couple")
"""What there are influence lines of."""


def influence_parts(
    beam: Beam, closed: np.ndarray, quantity: str, place: tuple[int, float], chosen: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Find the parts on which an influence line has one sign, while the same supports act.

    Parameters
    ----------
    beam : Beam
        Without foundations; its loads do not matter.
    closed : numpy.ndarray of int
        The contact state.
    quantity : str
        One of `LINES`.
    place : (int, float)
        Piece and distance from its left end, as for `Solution.values`.
    chosen : numpy.ndarray of bool
        Supports of the scene whose reactions or couples are meant.

    Returns
    -------
    edges : numpy.ndarray
        Right ends of the parts.
    signs : numpy.ndarray of int
        1, -1, or 0 where the line is zero.

    Raises
    ------
    EngineError
        The state is not unique.
    """
    most = 4 * (len(beam.places.pieces) + 1)  # as find_parts in fortran/moving_load/influence_parts
    edges, signs, number, status, message = _engine.gbtprt(
        beam.handle, most, np.append(closed, 0).astype(np.int32), np.append(chosen, False).astype(np.int32),
        place[0], place[1], LINES.index(quantity) + 1,
    )  # fmt: skip
    check_status(status, message)
    return edges[:number], signs[:number]
