"""Laws of the ground by name: every parameter a number, a pair or a table, linear in between."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from itertools import pairwise
from typing import Any, ClassVar

import numpy as np

from ..engine.arrays import PARAMETER
from ..engine.laws import PARAMETERS
from .ground_tables import Along, AlongSigned, at_both_ends, is_table
from .laws import BrittleLaw, HardeningLaw, PlasticLaw
from .table import Positive, Table

EVERYWHERE = -sys.float_info.max
"""Instead of the place of a law."""


class _GroundLaw(Table, forbid_unknown_fields=True, kw_only=True, gc=False, tag_field="type"):
    """A law by its parameters, each a number, (at from, at to) or points (x, value), linear in between."""

    code: ClassVar[int]
    like: ClassVar[type[PlasticLaw | HardeningLaw] | None] = None
    """The law of supports with the same parameters that is the same polyline."""

    def points(self) -> list[tuple[float, float]] | None:
        """Give the polyline (displacement past the gap, force per length); None where it is none, or one that varies or is 0."""
        given = dict(zip(self.__struct_fields__, self.values(), strict=True))
        if self.like is None or any(isinstance(value, tuple) or is_table(value) for value in given.values()):
            return None
        return self.like(**given).points() if given["stiffness"] > 0.0 and given["limit"] > 0.0 else None

    def parameters(self) -> list[tuple[float, float]]:
        """Give the parameters at both ends in the engine's order."""
        return list(map(at_both_ends, self.values()))

    def tables(self) -> list[tuple[int, Any]]:
        """Give the parameters that are tables, each with what it is for the engine."""
        return [(PARAMETER + k, value) for k, value in enumerate(self.values()) if is_table(value)]

    def values(self) -> tuple[Along | AlongSigned, ...]:
        """Give the parameters in the engine's order."""
        return tuple(getattr(self, key) for key in self.__struct_fields__)


class _Limited(_GroundLaw):
    """Of a stiffness at first, up to a limit or towards it.

    Parameters
    ----------
    stiffness : float, (float, float) or list of (float, float)
        Stiffness at first (force/length^2); or (at from, at to), or points (x, value), linear in between.
    limit : float, (float, float) or list of (float, float)
        Line reaction (force/length) up to which it is elastic, or to which it tends; or (at from, at to), or points (x, value),
        linear in between.
    """

    stiffness: Along
    limit: Along


class PlasticGround(_Limited, tag="plastic"):
    """Elastic up to a force that stays."""

    code, like = 1, PlasticLaw


class HardeningGround(_Limited, tag="hardening"):
    """Of one stiffness up to a force, of another one beyond.

    Parameters
    ----------
    slope : float, (float, float) or list of (float, float)
        Stiffness beyond (force/length^2), greater or less than the first one; or (at from, at to), or points (x, value), linear
        in between.
    """

    code, like = 2, HardeningLaw
    slope: Along


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
    k1 : float, (float, float) or list of (float, float)
        Stiffness at first (force/length^2); or (at from, at to), or points (x, value), linear in between.
    k3 : float, (float, float) or list of (float, float)
        Hardening (force/length^4); or (at from, at to), or points (x, value), linear in between.
    k2 : float, (float, float) or list of (float, float)
        Below 0 softening (force/length^3), down to -sqrt(3*k1*k3), where the force would fall; or (at from, at to), or points
        (x, value), linear in between.
    """

    code = 5
    k1: Along
    k3: Along
    k2: AlongSigned = 0.0

    def values(self) -> tuple[Along | AlongSigned, ...]:
        """Give the parameters in the engine's order."""
        return self.k1, self.k2, self.k3


class PowerGround(_GroundLaw, tag="power"):
    """Force = limit*(d/d0)^n, with n = 1, 2 or 3: a cubic.

    Parameters
    ----------
    d0 : float
        Displacement (length) at which the force is limit.
    limit : float, (float, float) or list of (float, float)
        Line reaction (force/length) at d0; or (at from, at to), or points (x, value), linear in between.
    n : float
        Exponent (no unit): 1, 2 or 3.
    """

    code = 5
    d0: Positive
    limit: Along
    n: Positive

    def values(self) -> tuple[Along | AlongSigned, ...]:
        """Give the parameters of the cubic."""
        scale = float(np.float64(self.d0) ** -self.n)
        if is_table(self.limit):
            only = [(x, value * scale) for x, value in self.limit]
        else:
            only = tuple(value * scale for value in at_both_ends(self.limit))
        return tuple(only if k == self.n else 0.0 for k in (1.0, 2.0, 3.0))


class LawAt(Table, forbid_unknown_fields=True, kw_only=True, gc=False):
    """The polyline of a law at one place; between two places it is linear point by point.

    Parameters
    ----------
    x : float
        Position (length, from the left end of the beam).
    points : list of (float, float)
        Displacement past the gap and force per length (length, force/length), from (0, 0) on, which is left out; as many at
        every position.
    """

    x: float
    points: list[tuple[float, float]]


GroundLawTable = PlasticGround | HardeningGround | HyperbolicGround | TanhGround | CubicGround | PowerGround | BrittleLaw
GroundLaw = list[tuple[float, float] | LawAt] | GroundLawTable

NOT_FOR_GROUND = {
    BrittleLaw: "ground has no force that drops at once; give a polyline that falls over a way",
}
"""Laws of supports that are no laws of foundations, and why."""
NO_POWER = (
    "with n below 1 the ground is infinitely stiff at first, so that a pile would change its side infinitely often, with others no "
    "series holds where contact begins; give a polyline, as codes do"
)
"""Why a power is a law of foundations with some exponents only."""


def ground_points(law: GroundLaw) -> list[tuple[float, float]] | None:
    """Give the polyline of a law.

    Parameters
    ----------
    law : list or law table
        Of a foundation.

    Returns
    -------
    list of (float, float) or None
        Displacement past the gap and force per length, from (0, 0) on, which is left out; None where it is no polyline, or one
        that varies.

    Examples
    --------
    >>> ground_points(PlasticGround(stiffness=100.0, limit=5.0))
    [(0.05, 5.0), (0.1, 5.0)]
    >>> ground_points(PlasticGround(stiffness=100.0, limit=(0.0, 5.0)))
    """
    if isinstance(law, list):
        return None if varies(law) else law
    return law.points()


def varies(law: GroundLaw | None) -> bool:
    """Whether a law is a polyline that is not the same everywhere.

    Parameters
    ----------
    law : list, law table or None
        Of a foundation.
    """
    return isinstance(law, list) and len(law) > 0 and isinstance(law[0], LawAt)


def falls(law: GroundLaw | None) -> bool:
    """Whether the force of a law falls anywhere.

    Parameters
    ----------
    law : list, law table or None
        Of a foundation.

    Examples
    --------
    >>> falls([(0.01, 50.0), (0.03, 20.0), (0.1, 20.0)])
    True
    """
    if not isinstance(law, list):
        return False  # laws by name never fall
    polylines = [place.points for place in law] if varies(law) else [law]
    return any(after < before for points in polylines for (_, before), (_, after) in pairwise(points))


def any_falls(foundations: Iterable[Any]) -> bool:
    """Whether the force of any foundation falls.

    Parameters
    ----------
    foundations : iterable of Foundation
        Of a scene that has been read.
    """
    return any(falls(foundation.law) for foundation in foundations)


def slopes_of_branch(law: list[LawAt], branch: int) -> list[tuple[float, float]]:
    """Give the slope of a piece of a polyline that varies, at its places.

    Parameters
    ----------
    law : list of LawAt
        Of a foundation.
    branch : int
        The piece, from 1; the last one goes on.

    Returns
    -------
    list of (float, float)
        Place, and slope there.

    Examples
    --------
    >>> slopes_of_branch([LawAt(x=0.0, points=[(0.1, 5.0)]), LawAt(x=3.0, points=[(0.1, 7.0)])], 1)
    [(0.0, 50.0), (3.0, 70.0)]
    """
    found = []
    for place in law:
        (d, p), (e, q) = [(0.0, 0.0), *place.points][min(branch, len(place.points)) - 1 :][:2]
        found.append((place.x, (q - p) / (e - d)))
    return found


def is_straight(law: list[LawAt]) -> bool:
    """Whether a polyline that varies has the same displacements everywhere, so that its slopes are straight between its places.

    Parameters
    ----------
    law : list of LawAt
        Of a foundation.
    """
    return all([d for d, _ in place.points] == [d for d, _ in law[0].points] for place in law)


def points_with_places(law: GroundLaw) -> list[tuple[float, float, float]]:
    """Give the points of a law for the engine.

    Parameters
    ----------
    law : list or law table
        Of a foundation.

    Returns
    -------
    list of (float, float, float)
        Displacement past the gap, force per length, and place, `EVERYWHERE` of a law that is the same everywhere.

    Examples
    --------
    >>> points_with_places([LawAt(x=0.0, points=[(0.1, 5.0)]), LawAt(x=3.0, points=[(0.1, 7.0)])])
    [(0.1, 5.0, 0.0), (0.1, 7.0, 3.0)]
    """
    if varies(law):
        return [(*point, place.x) for place in law for point in place.points]
    return [(*point, EVERYWHERE) for point in ground_points(law) or ()]


def ground_parameters(law: GroundLaw | None) -> list[float]:
    """Give a law by parameters as the engine takes it.

    Parameters
    ----------
    law : list, law table or None
        Of a foundation.

    Returns
    -------
    list of float
        Code of the law, 0 for none and for polylines; its parameters at the left end, and at the right end, 0 of tables.

    Examples
    --------
    >>> ground_parameters(TanhGround(stiffness=(0.0, 9e3), limit=400.0))
    [4.0, 0.0, 400.0, 0.0, 9000.0, 400.0, 0.0]
    """
    if law is None or isinstance(law, list) or ground_points(law) is not None:
        return [0.0] * (1 + 2 * PARAMETERS)
    given = law.parameters()
    given += [(0.0, 0.0)] * (PARAMETERS - len(given))
    return [float(law.code), *(float(left) for left, _ in given), *(float(right) for _, right in given)]


def tables_of(foundation: Any) -> list[Any]:
    """Give the tables that say how stiff a foundation is, of its modulus and of the parameters or the first slope of its law.

    Parameters
    ----------
    foundation : Foundation
        Of a scene that has been read.
    """
    if varies(foundation.law):
        return [slopes_of_branch(foundation.law, 1)]
    return [foundation.k] if is_table(foundation.k) else [table for _, table in parameter_tables(foundation.law)]


def parameter_tables(law: GroundLaw | None) -> list[tuple[int, Any]]:
    """Give the tables of the parameters of a law.

    Parameters
    ----------
    law : list, law table or None
        Of a foundation.

    Returns
    -------
    list of (int, list)
        Of what it is, for the engine, and its points.

    Examples
    --------
    >>> parameter_tables(TanhGround(stiffness=9e3, limit=[(0.0, 100.0), (8.0, 400.0)]))
    [(4, [(0.0, 100.0), (8.0, 400.0)])]
    """
    return [] if law is None or isinstance(law, list) else law.tables()
