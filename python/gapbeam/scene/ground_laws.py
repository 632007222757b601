"""Laws of the ground by name: every parameter a number or a pair, linear in between."""

from __future__ import annotations

from typing import ClassVar

from .laws import BrittleLaw, HardeningLaw, PlasticLaw, PowerLaw
from .table import NotNegative, Table

Linear = NotNegative | tuple[NotNegative, NotNegative]

PARAMETERS = 3
"""Of any law, for the engine."""


class _GroundLaw(Table, forbid_unknown_fields=True, kw_only=True, gc=False, tag_field="type"):
    """A law by its parameters, each a number or (at from, at to), linear in between."""

    code: ClassVar[int]

    def points(self) -> list[tuple[float, float]] | None:
        """Give the polyline (displacement past the gap, force per length); None where the law is no polyline."""
        return None

    def parameters(self) -> list[tuple[float, float]]:
        """Give the parameters at both ends in the engine's order."""
        return [value if isinstance(value, tuple) else (value, value) for value in self.values()]

    def values(self) -> tuple[Linear, ...]:
        """Give the parameters in the engine's order."""
        return tuple(getattr(self, key) for key in self.__struct_fields__)


class _Limited(_GroundLaw):
    """Of a stiffness at first, up to a limit or towards it.

    Parameters
    ----------
    stiffness : float or (float, float)
        Stiffness at first (force/length^2); or (at from, at to), linear in between.
    limit : float or (float, float)
        The force per length up to which it is elastic, or to which it tends; or (at from, at to), linear in between.
    """

    stiffness: Linear
    limit: Linear


class PlasticGround(_Limited, tag="plastic"):
    """Elastic up to a force that stays."""

    code = 1

    def points(self) -> list[tuple[float, float]] | None:
        """Give the polyline where the parameters are numbers above 0."""
        return _points(PlasticLaw, stiffness=self.stiffness, limit=self.limit)


class HardeningGround(_Limited, tag="hardening"):
    """Of one stiffness up to a force, of another one beyond.

    Parameters
    ----------
    slope : float or (float, float)
        Stiffness beyond (force/length^2), greater or less than the first one; or (at from, at to), linear in between.
    """

    code = 2
    slope: Linear

    def points(self) -> list[tuple[float, float]] | None:
        """Give the polyline where the parameters are numbers above 0."""
        return _points(HardeningLaw, stiffness=self.stiffness, limit=self.limit, slope=self.slope)


class HyperbolicGround(_Limited, tag="hyperbolic"):
    """Force = d/(1/stiffness + d/limit)."""

    code = 3


class TanhGround(_Limited, tag="tanh"):
    """Force = limit*tanh(stiffness*d/limit), the curve of API for sand."""

    code = 4


class CubicGround(_GroundLaw, tag="cubic"):
    """Force = k1*d + k2*d^2 + k3*d^3.

    Parameters
    ----------
    k1 : float or (float, float)
        Stiffness at first (force/length^2); or (at from, at to), linear in between.
    k3 : float or (float, float)
        Hardening (force/length^4); or (at from, at to), linear in between.
    k2 : float or (float, float)
        Below 0 softening (force/length^3), down to -sqrt(3*k1*k3), where the force would fall; or (at from, at to), linear in
        between.
    """

    code = 5
    k1: Linear
    k3: Linear
    k2: float | tuple[float, float] = 0.0

    def values(self) -> tuple[float | tuple[float, float], ...]:
        """Give the parameters in the engine's order."""
        return self.k1, self.k2, self.k3


def _points(kind: type[PlasticLaw | HardeningLaw], **parameters: Linear) -> list[tuple[float, float]] | None:
    """Give the polyline of a law of supports with these parameters; None with pairs, and where a number is not above 0."""
    if any(isinstance(value, tuple) for value in parameters.values()):
        return None
    if not (parameters["stiffness"] > 0.0 and parameters["limit"] > 0.0):
        return None
    return kind(**parameters).points()


GroundLawTable = PlasticGround | HardeningGround | HyperbolicGround | TanhGround | CubicGround | BrittleLaw | PowerLaw
GroundLaw = list[tuple[float, float]] | GroundLawTable

NOT_FOR_GROUND = {
    BrittleLaw: "a law whose force falls is not available for foundations in this version; give a polyline that never falls",
    PowerLaw: "a power of the displacement is not available for foundations: with n below 1 the ground is infinitely stiff at "
    "first, so that a pile would change its side infinitely often; give a polyline, as codes do, or cubic",
}
"""Laws of supports that are no laws of foundations, and why."""


def ground_points(law: GroundLaw) -> list[tuple[float, float]] | None:
    """Give the polyline of a law.

    Parameters
    ----------
    law : list or law table
        Of a foundation.

    Returns
    -------
    list of (float, float) or None
        Displacement past the gap and force per length, from (0, 0) on, which is left out; None where it is no polyline.

    Examples
    --------
    >>> ground_points(PlasticGround(stiffness=100.0, limit=5.0))
    [(0.05, 5.0), (0.1, 5.0)]
    >>> ground_points(PlasticGround(stiffness=100.0, limit=(0.0, 5.0)))
    """
    return law if isinstance(law, list) else law.points()


def ground_parameters(law: GroundLaw | None) -> list[float]:
    """Give a law by parameters as the engine takes it.

    Parameters
    ----------
    law : list, law table or None
        Of a foundation.

    Returns
    -------
    list of float
        Code of the law, 0 for none and for polylines; its parameters at the left end, and at the right end.

    Examples
    --------
    >>> ground_parameters(TanhGround(stiffness=(0.0, 9e3), limit=400.0))
    [4.0, 0.0, 400.0, 0.0, 9000.0, 400.0, 0.0]
    """
    if law is None or ground_points(law) is not None:
        return [0.0] * (1 + 2 * PARAMETERS)
    given = law.parameters()
    given += [(0.0, 0.0)] * (PARAMETERS - len(given))
    return [float(law.code), *(float(left) for left, _ in given), *(float(right) for _, right in given)]
