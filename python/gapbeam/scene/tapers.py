"""Sections and their stiffnesses, which may change along them: one number, a pair, or a power of a linear depth."""

from __future__ import annotations

from typing import Any

from msgspec import field

from .table import Count, Positive, Stretch, Table


class Taper(Table, forbid_unknown_fields=True, kw_only=True, gc=False):
    """A stiffness that changes along a section as a power of a depth that is linear.

    Parameters
    ----------
    from_ : float
        Stiffness at the left end of the section (force*length^2), a force for GA and EA, above 0 and finite. In Python the name is
        ``from_``.
    to : float
        Stiffness at its right end (force*length^2), likewise.
    power : int
        Power of the depth, 1 to 4 (no unit): 3 for EI of a rectangle of linear depth, 1 for its GA and EA, 4 for EI of a round
        pole. Default 1: the stiffness itself is linear.
    """

    from_: Positive = field(name="from")
    to: Positive
    power: Count = 1


Stiffness = Positive | tuple[Positive, Positive] | Taper


class Section(Stretch, kw_only=True, gc=False):
    """Other stiffness between two places; later sections win over earlier ones.

    Parameters
    ----------
    EI : float, (float, float) or table, optional
        Bending stiffness (force*length^2) here; inf = rigid. Or (at from, at to), linear in between; or a table with from, to and
        power, the power of a linear depth that it is (`Taper`). Left out: as it was.
    GA : float, (float, float) or table, optional
        Shear stiffness kappa*G*A (force) here, likewise. Left out: as it was.
    EA : float, (float, float) or table, optional
        Axial stiffness (force) here, likewise. Left out: as it was.
    N : float, optional
        Axial force (force) that bending feels here, tension positive. Left out: as it was.
    """

    EI: Stiffness | None = None
    GA: Stiffness | None = None
    EA: Stiffness | None = None
    N: float | None = None


def ends_of(value: Any) -> tuple[float, float, int]:
    """Give a stiffness at both ends of its section, and its power of the depth.

    Parameters
    ----------
    value : float, (float, float) or Taper
        Of a section.

    Examples
    --------
    >>> ends_of(2.0), ends_of((1.0, 2.0)), ends_of(Taper(from_=1.0, to=8.0, power=3))
    ((2.0, 2.0, 1), (1.0, 2.0, 1), (1.0, 8.0, 3))
    """
    if isinstance(value, Taper):
        return value.from_, value.to, value.power
    if isinstance(value, tuple | list):
        return value[0], value[1], 1
    return value, value, 1


def is_tapered(section: Any) -> bool:
    """Whether bending, shear or axial stiffness changes along a section.

    Parameters
    ----------
    section : Section
        Of a scene.
    """
    return any(isinstance(getattr(section, key), tuple | list | Taper) for key in ("EI", "GA", "EA"))
