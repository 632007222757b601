"""Tops of polynomials through values at some positions, in the position or in an angle.

Where a zone of contact is born values go like the power 3/2 of the distance from there, which no polynomial in the position
follows, but one in its root does (`Unrolled`).
"""

from __future__ import annotations

from collections.abc import Mapping
from math import cos, pi, sin
from typing import Any, NamedTuple

import numpy as np

NEAREST_BIRTH = 2.0**-11
"""Share of the angle to the next state down to which is looked beside the birth of a zone: its square is that of the way, and what
is greater still nearer is so by less than one part in 1e9 of what values bend."""


class Unrolled(NamedTuple):
    """Positions between two changes as an angle from 0 to pi, whose square is the distance from either end, next to it.

    Attributes
    ----------
    low, high : float
        The ends.

    Examples
    --------
    >>> way = Unrolled(2.0, 6.0)
    >>> way.angle(np.array([2.0, 4.0, 6.0])).round(6).tolist(), round(way.position(way.angle(2.5)), 12)
    ([0.0, 1.570796, 3.141593], 2.5)
    """

    low: float
    high: float
    bears_zones = True

    def angle(self, position: Any) -> Any:
        """Give the angle of positions."""
        below, above = np.maximum(position - self.low, 0.0), np.maximum(self.high - position, 0.0)
        return 2.0 * np.arctan2(np.sqrt(below), np.sqrt(above))

    def position(self, angle: float) -> float:
        """Give the position of an angle."""
        if angle <= pi / 2:
            return self.low + (self.high - self.low) * sin(angle / 2) ** 2
        return self.high - (self.high - self.low) * cos(angle / 2) ** 2

    def begins(self, angle: float) -> bool:
        """Tell whether an angle is the first one."""
        return angle <= 0.0

    def ends(self, angle: float) -> bool:
        """Tell whether an angle is the last one."""
        return angle >= pi


class Straight(NamedTuple):
    """The same where there is nothing to be unrolled: the angle is the position."""

    bears_zones = False

    def angle(self, position: Any) -> Any:
        """Give the position."""
        return position

    def position(self, angle: float) -> float:
        """Give the position."""
        return angle

    def begins(self, angle: float) -> bool:
        """Tell that no zone is born."""
        return False

    ends = begins


def nearer(best: float, left: float, right: float, width: float, ruler: Unrolled | Straight) -> float | None:
    """Give the angle to look at next where values fall from the end of a run on.

    Parameters
    ----------
    best, left, right : float
        That end, and the bounds.
    width : float
        Of the bounds at first.
    ruler : Unrolled or Straight
        What angles are of.

    Returns
    -------
    float or None
        None where nothing can be born, or what may still be greater is no more than rounding.
    """
    away = right + left - 2.0 * best
    born = ruler.begins(best) or ruler.ends(best)
    return best + away / 4.0 if born and abs(away) > NEAREST_BIRTH * width else None


def vertex(best: float, heights: Mapping[float, float], left: float, right: float) -> tuple[float | None, float]:
    """Find the top of the parabola through the highest point and the two nearest to it.

    Parameters
    ----------
    best : float
        Place of the highest point.
    heights : mapping of float to float
        Of all points, by their places.
    left, right : float
        Bounds.

    Returns
    -------
    place, height : float
        None, 0 where there is no top between the bounds.

    Examples
    --------
    >>> vertex(2.0, {0.0: 2.0, 2.0: 8.0, 3.0: 5.0}, 0.0, 3.0)
    (1.75, 8.125)
    """
    if len(heights) < 3:
        return None, 0.0
    a, b = sorted((at for at in heights if at != best), key=lambda at: abs(at - best))[:2]
    f = heights[best]
    da, db = a - best, b - best
    slope_a, slope_b = (heights[a] - f) / da, (heights[b] - f) / db
    bend = (slope_a - slope_b) / (da - db)
    if not bend < 0.0:
        return None, 0.0
    slope = slope_a - bend * da
    place = best - slope / (2.0 * bend)
    return (place, f - slope / (4.0 * bend) * slope) if left < place < right else (None, 0.0)


def highest(at: np.ndarray, heights: np.ndarray, left: float, right: float) -> tuple[float | None, float | None]:
    """Find the highest point between bounds of the polynomial through points, if it is a stationary one.

    Parameters
    ----------
    at, heights : numpy.ndarray
        The points.
    left, right : float
        Bounds.

    Returns
    -------
    place, height : float
        None, None where there is none.

    Examples
    --------
    >>> highest(np.array([0.0, 1.0, 3.0]), np.array([0.0, 3.0, 3.0]), 1.0, 3.0)
    (2.0, 4.0)
    """
    middle, half = (left + right) / 2, (right - left) / 2
    # A power of two: products of great numbers would be beyond all numbers
    size = 2.0 ** np.floor(np.log2(np.abs(heights).max(initial=1e-300)))
    lowest = (heights / size).min()
    factors = np.linalg.solve(np.vander((at - middle) / half), heights / size - lowest)
    roots = np.roots(np.polyder(factors))
    places = roots[(np.abs(roots.imag) <= 1e-9) & (np.abs(roots.real) <= 1.0)].real
    if not len(places):
        return None, None
    found = np.polyval(factors, places)
    best = int(found.argmax())
    return float(middle + half * places[best]), float((found[best] + lowest) * size)
