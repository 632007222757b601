"""Laws of supports by code and parameters, as the compiled layer has them in gapbeam_laws."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from . import calls as _engine

PARAMETERS = 3
"""Of any law."""


class CurveValues(NamedTuple):
    """A smooth law at a displacement past the gap.

    Attributes
    ----------
    force, slope : float
        Force and its slope.
    scale : float
        A displacement that is typical of the law.
    """

    force: float
    slope: float
    scale: float


def curve_values(code: int, parameters: list[float], d: float) -> CurveValues:
    """Give what a smooth law has at a displacement.

    Parameters
    ----------
    code : int
        The law.
    parameters : list of float
        Its parameters.
    d : float
        Displacement past the gap, 0 or more.
    """
    return CurveValues(*_engine.gblawv(code, np.array(parameters), d).tolist())


def points_of_law(code: int, parameters: list[float]) -> list[tuple[float, float]]:
    """Give the polyline of a law, through points of the curve where it is one.

    Parameters
    ----------
    code, parameters
        The law.

    Returns
    -------
    list of (float, float)
        Displacement past the gap and force, from (0, 0) on, which is left out.
    """
    count, points = _engine.gblawp(code, np.array(parameters))
    return list(map(tuple, points[:, :count].T.tolist()))
