"""Records of results: arrays that nobody changes, `==` that answers with a bool, pickling."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

import numpy as np


def read_only(value: Any) -> Any:
    """Protect an array, or the arrays of a tuple or a dict, against changes.

    Parameters
    ----------
    value : object
        An array, or a tuple or dict in which arrays stand; anything else is left as it is.

    Returns
    -------
    object
        The same object.
    """
    if isinstance(value, np.ndarray):
        value.setflags(write=False)
    elif isinstance(value, tuple):
        for part in value:
            read_only(part)
    elif isinstance(value, dict):
        read_only(tuple(value.values()))
    return value


class Record:
    """Base of frozen dataclasses whose fields are arrays; give them ``eq=False``.

    Their arrays are read-only. Two records are equal if their fields are, to the last bit, where not-a-number equals
    itself; fields with ``compare=False`` do not count.
    """

    __slots__ = ()
    __hash__ = None

    def __post_init__(self) -> None:
        """Protect the arrays."""
        for name in self.__dataclass_fields__:
            read_only(getattr(self, name))

    def __eq__(self, other: object) -> bool:
        """Whether all fields are equal."""
        if type(other) is not type(self):
            return NotImplemented
        return self is other or all(
            _same(getattr(self, field.name), getattr(other, field.name)) for field in fields(self) if field.compare
        )

    def __reduce__(self) -> tuple:
        """Pickle as made: pickling alone would forget that arrays are read-only."""
        return type(self), tuple(getattr(self, field.name) for field in fields(self))


class Pickled:
    """Base of classes that pickle by their attributes, whose arrays are read-only after that as before."""

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Take the attributes back."""
        self.__dict__.update(state)
        read_only(tuple(state.values()))


def _same(a: Any, b: Any) -> bool:
    if isinstance(a, np.ndarray | np.generic) and isinstance(b, np.ndarray | np.generic):
        return np.array_equal(a, b, equal_nan=True)
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(_same(value, b[key]) for key, value in a.items())
    return bool(a == b)
