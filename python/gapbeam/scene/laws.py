"""Laws of supports by the numbers that engineers have, as polylines and as curves."""

from __future__ import annotations

from math import inf, isfinite, tanh
from typing import Any, ClassVar

import numpy as np

from ..engine.tolerances import CUBIC_ROUNDING
from .table import NotNegative, Positive, Table

PIECES = 96
"""Pieces of the polyline that a curve is followed with, before it is solved itself."""


class _Law(Table, forbid_unknown_fields=True, kw_only=True, gc=False, tag_field="type"):
    """A law by its parameters."""

    smooth: ClassVar[bool] = False

    def points(self) -> list[tuple[float, float]]:
        """Give the polyline (displacement past the gap, force)."""
        raise NotImplementedError


class _Elastic(_Law):
    """Elastic up to a force.

    Parameters
    ----------
    stiffness : float
        Stiffness (force/length) up to the limit; inf = rigid.
    limit : float
        Force (force) up to which it is elastic.
    """

    stiffness: Positive
    limit: Positive

    def points(self) -> list[tuple[float, float]]:
        """Give the polyline."""
        d = self.limit / self.stiffness
        return [(d, self.limit), *self.beyond(d)]

    def beyond(self, d: float) -> list[tuple[float, float]]:
        """Give the points beyond the limit, which is reached at the displacement `d`."""
        raise NotImplementedError


class PlasticLaw(_Elastic, tag="plastic"):
    """Elastic up to a force that stays."""

    def beyond(self, d: float) -> list[tuple[float, float]]:
        """Stay."""
        return [(2 * d or 1.0, self.limit)]


class BrittleLaw(_Elastic, tag="brittle"):
    """Elastic up to a force at which it breaks."""

    def beyond(self, d: float) -> list[tuple[float, float]]:
        """Drop."""
        return [(d, 0.0), (2 * d or 1.0, 0.0)]


class HardeningLaw(_Elastic, tag="hardening"):
    """Of one stiffness up to a force, of another one beyond.

    Parameters
    ----------
    slope : float
        Stiffness beyond (force/length), greater or less than the first one; inf = rigid.
    """

    slope: NotNegative

    def beyond(self, d: float) -> list[tuple[float, float]]:
        """Go on, so that the slope comes out of it to all digits."""
        if not self.slope:
            return [(2 * d or 1.0, self.limit)]
        if self.slope == inf:
            return [(d, 2 * self.limit)] if d else []
        way = max(d, self.limit / self.slope)
        rise = self.slope * way if way else self.limit
        return [(d + way, self.limit + rise)]


class _Curve(_Law):
    """A smooth law."""

    smooth: ClassVar[bool] = True

    def scale(self) -> float:
        """Give a displacement that is typical of the law."""
        raise NotImplementedError

    def force_and_slope(self, d: float) -> tuple[float, float]:
        """Give force and slope at a displacement, 0 or more."""
        raise NotImplementedError

    def displacement(self, _: float) -> float | None:
        """Give the displacement at a force; None, as the curve is followed by displacements."""
        return None

    def bound(self) -> float:
        """Give the force that it never exceeds."""
        return inf

    def points(self) -> list[tuple[float, float]]:
        """Give a polyline through points of the curve, closer where it bends."""
        ways = self.scale() * np.geomspace(2.0**-20, 2.0**20, PIECES)
        points = [(float(d), self.force_and_slope(float(d))[0]) for d in ways]
        # Where a curve has become flat to the last digit, or leaves the range of doubles, a point less
        rising = [p for p, q in zip(points, [(0.0, 0.0), *points[:-1]], strict=True) if q[1] < p[1] < inf]
        return rising or [(self.scale(), self.force_and_slope(self.scale())[0])]


class CubicLaw(_Curve, tag="cubic"):
    """Force = k1*d + k2*d^2 + k3*d^3.

    Parameters
    ----------
    k1 : float
        Stiffness at first (force/length).
    k3 : float
        Hardening (force/length^3).
    k2 : float
        Below 0 softening (force/length^2), down to -2*sqrt(k1*k3): the force may fall, but not below 0.
    """

    k1: NotNegative
    k3: NotNegative
    k2: float = 0.0

    def scale(self) -> float:
        """Give the displacement at which two of the parts are equal."""
        if self.k1 and self.k3:
            return self.k1**0.5 / self.k3**0.5
        return (self.k2 / self.k3 if self.k3 else self.k1 / self.k2 if self.k2 else 1.0) or 1.0

    def force_and_slope(self, d: float) -> tuple[float, float]:
        """Give force and slope."""
        return d * (self.k1 + d * (self.k2 + self.k3 * d)), self.k1 + d * (2 * self.k2 + 3 * self.k3 * d)

    def points(self) -> list[tuple[float, float]]:
        """Give the polyline; where the law softens with closer points at equal distances."""
        if self.k2 >= 0.0:
            return super().points()
        last = 2.0 * self.scale()  # twice where the force is nearest to 0
        close = np.linspace(0.0, last, PIECES + 1)
        ways = self.scale() * np.geomspace(2.0**-20, 2.0**20, PIECES)
        ways = np.concatenate((ways[ways < 0.9 * close[1]], close[1:], ways[ways > 1.1 * last]))
        return [(d, max(self.force_and_slope(d)[0], 0.0)) for d in ways.tolist()]

    def least_k2(self) -> float:
        """Give the least k2 with which the force stays 0 or more."""
        return -2.0 * self.k1**0.5 * self.k3**0.5 + 0.0


class _Levelling(_Curve):
    """A curve that tends to a force.

    Parameters
    ----------
    stiffness : float
        Stiffness at first (force/length).
    limit : float
        Force (force) that it tends to.
    """

    stiffness: Positive
    limit: Positive

    def scale(self) -> float:
        """Give the displacement at which the first stiffness would reach the limit."""
        return self.limit / self.stiffness

    def bound(self) -> float:
        """Give the limit."""
        return self.limit


class HyperbolicLaw(_Levelling, tag="hyperbolic"):
    """Force = d/(1/stiffness + d/limit)."""

    def force_and_slope(self, d: float) -> tuple[float, float]:
        """Give force and slope."""
        share = 1.0 / (1.0 + d * self.stiffness / self.limit)
        return self.stiffness * d * share, self.stiffness * share * share


class TanhLaw(_Levelling, tag="tanh"):
    """Force = limit*tanh(stiffness*d/limit)."""

    def force_and_slope(self, d: float) -> tuple[float, float]:
        """Give force and slope."""
        share = tanh(self.stiffness * d / self.limit)
        return self.limit * share, self.stiffness * (1.0 - share) * (1.0 + share)


class PowerLaw(_Curve, tag="power"):
    """Force = limit*(d/d0)^n; with n below 1 infinitely stiff at first.

    Parameters
    ----------
    d0 : float
        Displacement (length) at which the force is limit.
    limit : float
        Force (force) at d0.
    n : float
        Exponent (no unit).
    """

    d0: Positive
    limit: Positive
    n: Positive

    def scale(self) -> float:
        """Give d0."""
        return self.d0

    def force_and_slope(self, d: float) -> tuple[float, float]:
        """Give force and slope."""
        if d == 0.0:
            return 0.0, inf if self.n < 1.0 else 0.0 if self.n > 1.0 else self.limit / self.d0
        force = self.limit * _power(d / self.d0, self.n)
        return force, self.n * force / d

    def displacement(self, force: float) -> float | None:
        """Give the displacement at a force, where the curve begins steep."""
        return self.d0 * _power(force / self.limit, 1.0 / self.n) if self.n < 1.0 else None


def _power(base: float, exponent: float) -> float:
    """Raise to a power; infinite beyond the range of doubles."""
    try:
        return float(base) ** exponent
    except OverflowError:
        return inf


LawTable = PlasticLaw | BrittleLaw | HardeningLaw | CubicLaw | HyperbolicLaw | TanhLaw | PowerLaw
Law = list[tuple[float, float]] | LawTable


def wrong_parameter(law: Any) -> tuple[str, float, str] | None:
    """Find a parameter of a law's table that is out of range.

    Parameters
    ----------
    law : Law
        From a scene.

    Returns
    -------
    None or (str, float, str)
        Key, value, and what was expected.
    """
    if isinstance(law, list):
        return None
    for key in law.__struct_fields__:
        value = getattr(law, key)
        rigid = key == "slope" or (key == "stiffness" and not law.smooth)
        least = 0.0 if key in ("k1", "k3", "slope") else -inf if key == "k2" else None
        if not (value > 0.0 or (least is not None and value >= least)) or not (isfinite(value) or rigid):
            more = "a number" if rigid else "a finite number"
            return key, value, more + {None: " above 0", 0.0: " of 0 or more", -inf: ""}[least]
    if isinstance(law, CubicLaw):
        least = law.least_k2()
        if law.k2 < least * (1 + CUBIC_ROUNDING):
            return "k2", law.k2, f"-2*sqrt(k1*k3) = {least:.9g} or more, since a support that pushes cannot pull"
        if law.k1 == law.k2 == law.k3 == 0.0:
            return "k1", law.k1, "a number above 0 for k1, k2 or k3"
    return None


def is_smooth(law: Law) -> bool:
    """Whether a law is a curve."""
    return not isinstance(law, list) and law.smooth


def law_points(law: Law) -> list[tuple[float, float]]:
    """Give the polyline of a law.

    Parameters
    ----------
    law : list or law table
        Of a support.

    Returns
    -------
    list of (float, float)
        Displacement past the gap and force, from (0, 0) on, which is left out.

    Examples
    --------
    >>> law_points(PlasticLaw(stiffness=100.0, limit=5.0))
    [(0.05, 5.0), (0.1, 5.0)]
    """
    return law if isinstance(law, list) else law.points()
