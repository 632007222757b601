"""Places along the beam that differ by rounding only (fortran/scene/stations.f90)."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..engine.tolerances import POSITION_TOLERANCE


def same_place(a: Any, b: Any) -> Any:
    """Whether positions differ by rounding only.

    Parameters
    ----------
    a, b : float or numpy.ndarray
        Positions along the beam (length).

    Returns
    -------
    bool or numpy.ndarray of bool

    Examples
    --------
    >>> bool(same_place(6.0, 6.000000000000001)), bool(same_place(6.0, 6.0000000001))
    (True, False)
    """
    return np.abs(np.subtract(a, b)) <= POSITION_TOLERANCE * np.maximum(np.abs(a), np.abs(b))


def nearest(x: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Number of the point that is nearest to each place, the left one of two.

    Parameters
    ----------
    x : numpy.ndarray
        Places along the beam.
    points : numpy.ndarray
        x of two points or more, from left to right.

    Returns
    -------
    numpy.ndarray of int

    Examples
    --------
    >>> nearest(np.array([-1.0, 2.9, 3.1, 9.0]), np.array([0.0, 6.0, 8.0])).tolist()
    [0, 0, 1, 2]
    """
    after = np.clip(np.searchsorted(points, x), 1, len(points) - 1)
    return np.where(x - points[after - 1] <= points[after] - x, after - 1, after)


def locate(x: np.ndarray, ends: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Span and distance from its left end of given places.

    Parameters
    ----------
    x : numpy.ndarray
        Places along the beam.
    ends : numpy.ndarray
        x of the span ends.

    Returns
    -------
    span : numpy.ndarray of int
        The span; the right end of the beam is the left end of a span that does not exist.
    offset : numpy.ndarray
        Exactly 0 at a span end, also for an x that differs from it by rounding only.
    """
    span = np.clip(np.searchsorted(ends, x, side="right") - 1, 0, len(ends) - 2)
    tolerance = POSITION_TOLERANCE * np.abs(x)
    at_right = ends[span + 1] - x <= tolerance
    if ends[1] > POSITION_TOLERANCE * ends[-1]:  # at the left end what is left of a distance from the right end
        tolerance = np.where(span == 0, POSITION_TOLERANCE * ends[-1], tolerance)
    span = span + at_right
    offset = np.where(at_right, 0.0, x - ends[span])
    return span, np.where(offset <= tolerance, 0.0, offset)
