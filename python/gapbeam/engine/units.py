"""The engine's units: powers of two near the sizes of a scene, so that nothing is rounded (fortran/scene/units.f90)."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

SMALLEST, LARGEST = float(np.finfo(float).tiny), float(np.finfo(float).max)
"""Between these a number has all its digits."""


class Units(NamedTuple):
    """Units as exponents of two, of lengths, forces and deflections."""

    length: int = 0
    force: int = 0
    deflection: int = 0

    @property
    def field(self) -> tuple[int, int, int, int]:
        """Of deflection, rotation, moment, shear."""
        return self.deflection, self.deflection - self.length, self.force + self.length, self.force


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
