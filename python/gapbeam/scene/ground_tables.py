"""Numbers of a foundation along the beam: one, a pair (at from, at to), or a table of points (x, value)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..base.errors import SceneError
from .table import NotNegative
from .wording import shown

Along = NotNegative | list[NotNegative | tuple[float, NotNegative]]
AlongSigned = float | list[float | tuple[float, float]]


def is_table(value: Any) -> bool:
    """Whether a value is a table, not a number or a pair.

    Parameters
    ----------
    value : float, (float, float) or table
        Of a foundation, as `settled` gives it.
    """
    return isinstance(value, list | np.ndarray)


def settled(value: Any, place: str) -> Any:
    """Tell a pair from a table: both come as lists.

    Parameters
    ----------
    value : float, list, array or None
        Of a foundation.
    place : str
        Where it stands.

    Returns
    -------
    float, (float, float), table or None

    Raises
    ------
    SceneError
        It is none of these.

    Examples
    --------
    >>> settled([1.0, 2.0], "foundation[0].k"), settled([(0.0, 1.0), (5.0, 2.0)], "foundation[0].k")
    ((1.0, 2.0), [(0.0, 1.0), (5.0, 2.0)])
    """
    if is_table(value) and not len(value):
        raise SceneError(place, "has no point; give (x, value)")
    if not isinstance(value, list):
        return value
    points = [isinstance(one, tuple) for one in value]
    if all(points):
        return value
    if any(points) or len(value) != 2:
        raise SceneError(place, f"expected a number, a pair of numbers or a list of pairs of numbers, got {shown(value)}")
    return tuple(value)


def at_both_ends(value: Any) -> tuple[float, float]:
    """Give the numbers at both ends of a foundation.

    Parameters
    ----------
    value : float, (float, float), table or None
        As `settled` gives it.

    Returns
    -------
    (float, float)
        0 of a table, which the engine follows, and where there is nothing.
    """
    if value is None or is_table(value):
        return 0.0, 0.0
    return value if isinstance(value, tuple) else (value, value)


def least_and_most(value: Any) -> tuple[float, float]:
    """Give the least and the greatest of the numbers.

    Parameters
    ----------
    value : float, (float, float) or table
        As `settled` gives it.
    """
    numbers = np.asarray(value, dtype=float)[:, 1] if is_table(value) else np.atleast_1d(value)
    return float(np.min(numbers)), float(np.max(numbers))


def least_between(value: Any, stretch: tuple[float, float], start: float, stop: float) -> float:
    """Give the least of the numbers between two places.

    Parameters
    ----------
    value : float, (float, float) or table
        As `settled` gives it.
    stretch : (float, float)
        Ends of the foundation.
    start, stop : float
        The places.

    Examples
    --------
    >>> least_between([(0.0, 1.0), (2.0, 3.0), (2.0, 0.5), (9.0, 4.0)], (0.0, 9.0), 1.0, 3.0)
    0.5
    """
    points = np.asarray(value, dtype=float) if is_table(value) else np.column_stack((stretch, at_both_ends(value)))
    inside = points[(points[:, 0] > start) & (points[:, 0] < stop), 1]
    return float(min([*_at_place(points, start)[1:], *inside, *_at_place(points, stop)[:1]]))


def _at_place(points: np.ndarray, x: float) -> tuple[float, float]:
    """Follow a table (x and value in ascending order, n by 2; two at a place are a step) to a place: values left and right of it.

    Examples
    --------
    >>> _at_place(np.array([[0.0, 1.0], [2.0, 3.0], [2.0, 0.5]]), 2.0)
    (3.0, 0.5)
    """
    places, values = points[:, 0], points[:, 1]
    left, right = np.searchsorted(places, x, "left"), np.searchsorted(places, x, "right")
    if left == right:
        between = float(np.interp(x, places, values))
        return between, between
    return float(values[left]), float(values[right - 1])


def points_of(tables: Sequence[tuple[int, int, Any]]) -> tuple[np.ndarray, np.ndarray]:
    """Put tables beside each other as the engine takes them.

    Parameters
    ----------
    tables : sequence of (int, int, table)
        Number of the foundation, from 1; of what it is; its points.

    Returns
    -------
    foundations, points : numpy.ndarray
        Number of the foundation of every point; x, value, and of what, 3 rows. Both with one entry more.
    """
    count = sum(len(table) for _, _, table in tables)
    foundations, points = np.zeros(count + 1, np.int32), np.zeros((3, count + 1), order="F")
    at = 0
    for number, quantity, table in tables:
        here = slice(at, at := at + len(table))
        foundations[here], points[:2, here], points[2, here] = number, np.asarray(table, dtype=float).T, quantity
    return foundations, points
