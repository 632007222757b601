"""Laws of supports by the numbers that engineers have; what they are stands in the compiled layer."""

from __future__ import annotations

from typing import ClassVar

from ..engine.laws import PARAMETERS, CurveValues, curve_values, points_of_law
from .table import NotNegative, Positive, Table


class _Law(Table, forbid_unknown_fields=True, kw_only=True, gc=False, tag_field="type"):
    """A law by its parameters."""

    smooth: ClassVar[bool] = False
    code: ClassVar[int]
    """As in gapbeam_laws."""

    def parameters(self) -> list[float]:
        """Give the parameters in the engine's order, and 0 for those that it does not have."""
        found = [float(getattr(self, key)) for key in self.__struct_fields__]
        return found + [0.0] * (PARAMETERS - len(found))

    def points(self) -> list[tuple[float, float]]:
        """Give the polyline (displacement past the gap, force); of a curve the one that it is followed with."""
        return points_of_law(self.code, self.parameters())


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


class PlasticLaw(_Elastic, tag="plastic"):
    """Elastic up to a force that stays."""

    code = 1


class BrittleLaw(_Elastic, tag="brittle"):
    """Elastic up to a force at which it breaks."""

    code = 8


class HardeningLaw(_Elastic, tag="hardening"):
    """Of one stiffness up to a force, of another one beyond.

    Parameters
    ----------
    slope : float
        Stiffness beyond (force/length), greater or less than the first one; inf = rigid.
    """

    code = 2
    slope: NotNegative


class _Curve(_Law):
    """A smooth law."""

    smooth: ClassVar[bool] = True

    def values(self, d: float) -> CurveValues:
        """Give force, slope and work at a displacement, 0 or more, and what the law has everywhere."""
        return curve_values(self.code, self.parameters(), d)

    def scale(self) -> float:
        """Give a displacement that is typical of the law."""
        return self.values(0.0).scale


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

    code = 5
    k1: NotNegative
    k3: NotNegative
    k2: float = 0.0

    def parameters(self) -> list[float]:
        """Give the parameters in the engine's order."""
        return [float(self.k1), float(self.k2), float(self.k3)]


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


class HyperbolicLaw(_Levelling, tag="hyperbolic"):
    """Force = d/(1/stiffness + d/limit)."""

    code = 3


class TanhLaw(_Levelling, tag="tanh"):
    """Force = limit*tanh(stiffness*d/limit)."""

    code = 4


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

    code = 7
    d0: Positive
    limit: Positive
    n: Positive


LawTable = PlasticLaw | BrittleLaw | HardeningLaw | CubicLaw | HyperbolicLaw | TanhLaw | PowerLaw
Law = list[tuple[float, float]] | LawTable


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
