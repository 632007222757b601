"""Masses of a beam that stand at a place."""

from __future__ import annotations

from .table import NotNegative, Point


class Mass(Point, kw_only=True, gc=False):
    """A mass at a place that moves with the beam, for `analysis.frequencies`; its weight is a load of its own.

    Parameters
    ----------
    mass : float
        Mass (force*time^2/length): t with kN, m and s.
    """

    mass: NotNegative
