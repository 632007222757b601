"""Loads of a scene: forces, couples, distributed loads, curvatures, temperature, axial forces, movements of supports."""

from __future__ import annotations

from typing import Literal

from .table import Point, Stretch, Table


class _PointLoad(Point, kw_only=True, gc=False, tag_field="type"):
    """A load at one place.

    Parameters
    ----------
    case : str
        Its load case, any name: dead acts in full from the start, all others (default live) are scaled by the load factor.
        Combinations give cases factors by these names.
    """

    case: str = "live"


class _StretchLoad(Stretch, kw_only=True, gc=False, tag_field="type"):
    """A load over a stretch.

    Parameters
    ----------
    name : str, optional
        Its name, unique among loads; shown instead of its number.
    case : str
        Its load case, any name: dead acts in full from the start, all others (default live) are scaled by the load factor.
        Combinations give cases factors by these names.
    """

    name: str | None = None
    case: str = "live"


class ForceLoad(_PointLoad, kw_only=True, gc=False, tag="force"):
    """A force across the beam, at a node or at x.

    Parameters
    ----------
    F : float
        Force (force), positive downward.
    """

    F: float


class MomentLoad(_PointLoad, kw_only=True, gc=False, tag="moment"):
    """A couple at a node or at x; exactly at a hinge it needs at_hinge.

    Parameters
    ----------
    M : float
        Couple (force*length), positive clockwise.
    at_hinge : {"left", "right"}, optional
        At a hinge: on which part of the beam it acts, that left of the hinge or that right of it.
    """

    M: float
    at_hinge: Literal["left", "right"] | None = None


class AxialLoad(_PointLoad, kw_only=True, gc=False, tag="axial"):
    """A horizontal force at a node or at x; needs a support with direction axial.

    Parameters
    ----------
    F : float
        Horizontal force (force), positive to the right.
    """

    F: float


class AxialUniformLoad(_StretchLoad, kw_only=True, gc=False, tag="axial_uniform"):
    """A constant distributed load along the beam; needs a support with direction axial. Default: over the whole beam.

    Parameters
    ----------
    q : float
        Load (force/length), positive to the right.
    """

    q: float


class UniformLoad(_StretchLoad, kw_only=True, gc=False, tag="uniform"):
    """A constant distributed load from one place to another; default: the whole beam.

    Parameters
    ----------
    q : float
        Load (force/length), positive downward.
    """

    q: float


class LinearLoad(_StretchLoad, kw_only=True, gc=False, tag="linear"):
    """A linearly varying distributed load from one place to another; default: the whole beam.

    Parameters
    ----------
    q : (float, float)
        Load (force/length) at the left and at the right end, positive downward.
    """

    q: tuple[float, float]


class CurvatureLoad(_StretchLoad, kw_only=True, gc=False, tag="curvature"):
    """An imposed curvature (temperature, shrinkage, prestress); default: over the whole beam.

    Parameters
    ----------
    kappa : float or (float, float)
        Curvature (1/length), added to w'' = -M/EI; positive where the upper side gets longer (warmer above). Or (at from, at to),
        linear in between: not over rigid ground; along tapered sections only on the ground or with N.
    """

    kappa: float | tuple[float, float]


class TemperatureLoad(_StretchLoad, kw_only=True, gc=False, tag="temperature"):
    """A change of temperature from one place to another; default: over the whole beam. It needs `beam.alpha`.

    Parameters
    ----------
    dT : float
        Change of the mean temperature (no unit), in the degrees of `beam.alpha`, positive warmer. It lengthens the beam, by
        alpha dT per length, which makes forces between supports of direction axial only.
    gradient : float
        Temperature of the bottom less that of the top, over `beam.depth` (no unit), positive warmer below. It bends as a sagging
        moment does, by the curvature alpha gradient/depth: kappa = -alpha gradient/depth.
    """

    dT: float = 0.0
    gradient: float = 0.0


class MovementLoad(Table, forbid_unknown_fields=True, kw_only=True, gc=False, tag_field="type", tag="movement"):
    """A movement of a support, beside its settlement: what jacks, sinks, or is lifted by heat. Or its rotation. Or moving ground.

    Parameters
    ----------
    support : int or str, optional
        Number, from 0, or name of the support.
    foundation : int or str, optional
        Instead of support: number, from 0, or name of the foundation.
    value : float or (float, float), optional
        Movement (length), positive downward, of an axial support to the right. It moves the place at which the support begins
        to act, or the ground. Of a foundation also a pair, at its left and at its right end, linear in between.
    rotation : float, optional
        Instead of value: rotation (no unit), in rad, positive clockwise, of a support that holds the rotation of the beam, rigidly
        or by a stiffness.
    name : str, optional
        Its name, unique among loads; shown instead of its number.
    case : str
        Its load case, any name: dead acts in full from the start, all others (default live) are scaled by the load factor.
        Combinations give cases factors by these names.
    """

    support: int | str | None = None
    foundation: int | str | None = None
    value: float | tuple[float, float] | None = None
    rotation: float | None = None
    name: str | None = None
    case: str = "live"


Load = (
    ForceLoad | MomentLoad | UniformLoad | LinearLoad | CurvatureLoad | TemperatureLoad | AxialLoad | AxialUniformLoad
    | MovementLoad
)
