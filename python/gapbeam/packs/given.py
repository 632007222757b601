"""Numbers given to a pack, checked."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import isfinite
from numbers import Real

from ..base.errors import SceneError


def check_above_zero(place: str, **numbers: float) -> None:
    """Refuse numbers that are not above 0.

    Parameters
    ----------
    place : str
        Name of the pack.
    **numbers : float
        By their names.

    Raises
    ------
    SceneError
        Names the pack, the number and its value.
    """
    _check(place, numbers, lambda value: value > 0.0, "a number above 0")


def check_not_negative(place: str, **numbers: float) -> None:
    """Refuse numbers below 0; as `check_above_zero`."""
    _check(place, numbers, lambda value: value >= 0.0, "0 or more")


def check_between(place: str, name: str, value: float, least: float, most: float) -> None:
    """Refuse a number outside a range.

    Parameters
    ----------
    place, name : str
        Of the pack and of the number.
    value : float
        What is given.
    least, most : float
        Ends of the range, both allowed.

    Raises
    ------
    SceneError
        Names the pack, the number and its value.
    """
    _check(place, {name: value}, lambda value: least <= value <= most, f"{least:g} to {most:g}")


def _check(place: str, numbers: Mapping[str, float], is_right: Callable[[float], bool], expected: str) -> None:
    for name, value in numbers.items():
        is_number = isinstance(value, Real)
        if not (is_number and isfinite(value) and is_right(value)):
            raise SceneError(f"{place}: {name}", f"expected {expected}, got {f'{value:g}' if is_number else repr(value)}")
