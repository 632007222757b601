"""Thresholds and limits that the engine and Python both read; their reasons stand in fortran/base/tolerances.f90 and limits.f90.

Attributes
----------
POSITION_TOLERANCE : float
    Positions whose difference is at most this share of the larger one differ by rounding only.
END_TOLERANCE : float
    A place beyond an end of the beam by at most this share of its length is at that end.
LOAD_BEGIN : float
    What acts at this share of the load acts from the beginning.
TRAIN_EQUAL : float
    Share of the largest value under a train by which ties differ at most.
MISSING_OF_LIMIT : numpy.ndarray
    Curves come to their limit where the beam has gone without end: shares of it that a path is short of at its end.
MOST_PATH_SEGMENTS : int
    Segments after which a path through a history is cut off.
CHANGES_AT_A_TIME : int
    Changes of the contact state followed in one call.
"""

from __future__ import annotations

from . import calls as _engine

(
    POSITION_TOLERANCE, END_TOLERANCE, LOAD_BEGIN, TRAIN_EQUAL, MISSING_OF_LIMIT, MOST_PATH_SEGMENTS, CHANGES_AT_A_TIME,
) = _engine.gbtole()  # fmt: skip
