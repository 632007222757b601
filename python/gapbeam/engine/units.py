"""The engine's units: powers of two, so that nothing is rounded, near the sizes of the scene itself.

Lengths along the beam, forces and deflections have a unit each: the equations are linear, so deflections need not have
the unit of the lengths.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..base.records import read_only

if TYPE_CHECKING:
    from .lowering import Arrays

ORDINARY_EXPONENT = 64
"""Scenes whose lengths, forces or deflections are beyond two to this power are solved in other units."""
SMALLEST, LARGEST = float(np.finfo(float).tiny), float(np.finfo(float).max)
"""Between these a number has all its digits."""


@dataclass(frozen=True, slots=True)
class Units:
    """Units as powers of two.

    Attributes
    ----------
    length, force, deflection : int
        Exponents; the others follow from them.
    """

    length: int = 0
    force: int = 0
    deflection: int = 0

    @property
    def rotation(self) -> int:
        """Of rotations."""
        return self.deflection - self.length

    @property
    def moment(self) -> int:
        """Of moments and couples."""
        return self.force + self.length

    @property
    def stiffness(self) -> int:
        """Of supports."""
        return self.force - self.deflection

    @property
    def turning(self) -> int:
        """Of rotational restraints."""
        return self.moment - self.rotation

    @property
    def piece(self) -> np.ndarray:
        """Of length, EI and GA."""
        return read_only(np.array([self.length, self.turning + self.length, self.force - self.rotation]))

    @property
    def load(self) -> np.ndarray:
        """Of the load per length at both ends of a piece, imposed curvature, force and couple."""
        per_length = self.force - self.length
        return read_only(np.array([per_length, per_length, self.rotation - self.length, self.force, self.moment]))

    @property
    def field(self) -> np.ndarray:
        """Of deflection, rotation, moment, shear."""
        return read_only(np.array([self.deflection, self.rotation, self.moment, self.force]))


def choose_units(arrays: Arrays) -> Units:
    """Choose the engine's units: 1 but for scenes far from it.

    Parameters
    ----------
    arrays : Arrays
        The lowered scene.

    Returns
    -------
    Units
        In these the lengths of the pieces lie about 1, and so does EI; loads and contact levels likewise, as the
        deflections that they make.
    """
    length = middle_exponent(arrays.pieces[:, 0])
    stiff = (
        (arrays.pieces[:, 1], 3 * length),
        (arrays.pieces[:, 2], length),
        (arrays.support_stiffness, 0),
        (arrays.turning, 2 * length),
    )
    stiffness = next((found - power for values, power in stiff if (found := middle_exponent(values)) is not None), None)
    loads = np.array([np.abs(part).max(axis=0) for part in (arrays.dead, arrays.live)]).max(axis=0)
    force = _largest((loads[:2], length), (loads[3], 0), (arrays.force, 0), (loads[4], -length), (arrays.couple, -length))
    way = _largest((loads[2], 2 * length), (arrays.support_contact, 0))
    return _with_loads(length, stiffness, force, way)


def choose_axial_units(
    length: np.ndarray, EA: np.ndarray, stiffness: np.ndarray, force: np.ndarray, settlement: np.ndarray
) -> Units:
    """Choose the units of the axial system: 1 but for scenes far from it.

    Parameters
    ----------
    length, EA : numpy.ndarray
        Of every piece.
    stiffness, settlement : numpy.ndarray
        Of the axial supports.
    force : numpy.ndarray
        The axial loads.

    Returns
    -------
    Units
        Of force and displacement along the axis.
    """
    elastic = np.isfinite(EA)
    soft = np.frexp(length[elastic])[1] - np.frexp(EA[elastic])[1]
    stiff = -(int(soft.min()) + int(soft.max())) // 2 if len(soft) else middle_exponent(stiffness)
    return _with_loads(0, stiff, _largest((force, 0)), _largest((settlement, 0)))


def _with_loads(length: int, stiffness: int | None, force: int | None, way: int | None) -> Units:
    """Units of force and deflection from the stiffness of the beam, and the largest force and way imposed on it."""
    if stiffness is None:
        stiffness = (force or 0) - (length if way is None else way)
    effects = [effect for effect in (None if force is None else force - stiffness, way) if effect is not None]
    deflection = (min(effects) + max(effects)) // 2 if effects else length
    units = Units(length, stiffness + deflection, deflection)
    return units if max(abs(length), abs(units.force), abs(deflection)) > ORDINARY_EXPONENT else Units()


def middle_exponent(values: np.ndarray) -> int | None:
    """Middle between the exponents of the smallest and the largest number.

    Parameters
    ----------
    values : numpy.ndarray
        Numbers, 0 or more.

    Returns
    -------
    int or None
        Of those that are finite and above 0; None if there are none.
    """
    values = values[(values > 0.0) & (values <= LARGEST)]
    return int(np.frexp([values.min(), values.max()])[1].sum()) // 2 if len(values) else None


def _largest(*columns: tuple[np.ndarray, int]) -> int | None:
    """The largest exponent of all columns, each with a power added; None where all numbers are 0."""
    sizes = [(np.abs(values).max(initial=0.0), power) for values, power in columns]
    return max((int(np.frexp(size)[1]) + power for size, power in sizes if size > 0.0), default=None)


def bound_in_scene(bound: float, exponent: int) -> float:
    """Take a bound of errors from the engine's units to the scene's.

    Parameters
    ----------
    bound : float
        In the engine's units.
    exponent : int
        Exponent of its unit.

    Returns
    -------
    float
        In the scene's units; where it and what it bounds may have been rounded, the next greater number; infinite where it
        left the range of double precision.
    """
    if not bound <= LARGEST:
        return math.inf
    found = float(scaled(np.float64(bound), exponent))
    return math.nextafter(found, math.inf) if exponent and bound > 0.0 and found < SMALLEST else found


def scaled(values: np.ndarray, exponent: int | np.ndarray) -> np.ndarray:
    """Multiply by powers of two.

    Parameters
    ----------
    values : numpy.ndarray
        Numbers.
    exponent : int or numpy.ndarray
        The powers.

    Returns
    -------
    numpy.ndarray
        inf where a product is too great; `values` itself where all exponents are 0.
    """
    if not np.any(exponent):
        return values
    with np.errstate(over="ignore"):
        return np.ldexp(values, exponent)
