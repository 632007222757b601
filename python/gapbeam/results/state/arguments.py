"""Arguments of the functions that a user calls, checked: what makes no sense is refused in words."""

from __future__ import annotations

import operator
from decimal import Decimal
from math import isfinite
from numbers import Real
from typing import Any

import numpy as np

from ...base.errors import SceneError
from ...scene.wording import shown


def numbers(place: str, value: Any) -> np.ndarray:
    """Take a number, or numbers in lists or an array of any shape.

    Parameters
    ----------
    place : str
        Name of the argument.
    value : object
        What the caller gave.

    Returns
    -------
    numpy.ndarray of float
        The caller's own array where it is one.

    Raises
    ------
    ValueError
        Something else, rows of unequal length, masked values, or beyond the range of doubles.

    Examples
    --------
    >>> numbers("x", [1, 2.5])
    array([1. , 2.5])
    """
    try:
        array = np.asanyarray(value)
    except ValueError:
        raise ValueError(f"{place}: expected numbers in rows of equal length") from None
    if type(array) is np.ndarray and array.dtype == float:
        return array
    if array.dtype == object and any(type(entry).__name__ == "NAType" for entry in array.ravel().tolist()):
        raise ValueError(f"{place}: expected numbers, and some of these are missing (pandas.NA); fill them or leave them out")
    exotic = array.dtype == object and all(isinstance(entry, Real | Decimal) for entry in array.ravel().tolist())
    if array.dtype.kind not in "biuf" and not exotic:
        raise ValueError(f"{place}: expected numbers, got {_words(value)}")
    if np.ma.is_masked(array):
        raise ValueError(f"{place}: expected numbers, some of these are masked")
    try:
        return np.asarray(array, dtype=float)
    except OverflowError:
        raise ValueError(f"{place}: expected numbers that double precision holds, got {_words(value)}") from None


def finite(place: str, value: Any) -> float:
    """Take a finite number.

    Parameters
    ----------
    place : str
        Name of the argument.
    value : object
        What the caller gave.

    Raises
    ------
    ValueError
        Something else.
    """
    number = numbers(place, value)
    if number.ndim > 0:
        raise ValueError(f"{place}: expected one number, got an array of shape {number.shape}")
    if not isfinite(number):
        raise ValueError(f"{place}: expected a finite number, got {number}")
    return float(number)


def whole(place: str, value: Any, least: int | None = None) -> int:
    """Take a whole number.

    Parameters
    ----------
    place : str
        Name of the argument.
    value : object
        What the caller gave.
    least : int, optional
        The smallest that is allowed.

    Raises
    ------
    ValueError
        Something else, or a smaller one.

    Examples
    --------
    >>> whole("points", 20, least=1)
    20
    """
    bound = "" if least is None else f", {least} or more"
    if isinstance(value, float | np.floating) and value.is_integer():
        value = int(value)
    try:
        number = operator.index(value)
    except TypeError:
        raise ValueError(f"{place}: expected a whole number{bound}, got {_words(value)}") from None
    if isinstance(value, bool | np.bool_) or (least is not None and number < least):
        raise ValueError(f"{place}: expected a whole number{bound}, got {_words(value)}")
    return number


def scheme(start: Any, count: int, supports: str) -> np.ndarray:
    """Take a starting scheme.

    Parameters
    ----------
    start : object
        What the caller gave: for every support True (closed) or False, or 1 or 0.
    count : int
        Number of supports.
    supports : str
        Which these are, for the message.

    Returns
    -------
    numpy.ndarray of int
        1 where a support is closed.

    Raises
    ------
    SceneError
        Something else, or of another length.
    """
    try:
        array = np.asanyarray(start)
    except ValueError:
        array = np.array(None)
    if array.ndim != 1:
        raise SceneError("start", f"expected a list of True (closed) and False, one per {supports}, got {_words(start)}")
    if len(array) != count:
        raise SceneError("start", f"expected {count} entries, one per {supports}, got {len(array)}")
    wrong = [k for k, entry in enumerate(array.tolist()) if entry not in (True, False)]
    if wrong:
        raise SceneError(f"start[{wrong[0]}]", f"expected True (closed) or False, got {_words(array.tolist()[wrong[0]])}")
    return array.astype(np.int32)


def _words(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return f"an array of {value.dtype} of shape {value.shape}"
    return shown(value)
