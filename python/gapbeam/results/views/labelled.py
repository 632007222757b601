"""Values of supports or combinations, found by number and by name."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from ...base.hints import no_such
from ...scene.names import names_of
from ...scene.structs import Scene
from .. import formatting as fmt

MOST = 12
"""Values that are shown."""


class Labelled(Sequence):
    """Values by number and by name: a sequence of the values, with keys. It cannot be changed.

    Parameters
    ----------
    quantity : str
        What the values are.
    noun : str
        What they belong to, in the singular.
    keys : sequence of (str or int)
        Names; the number where there is none.
    values : sequence
        One for each key.

    Examples
    --------
    >>> reactions = Labelled("reaction", "support", ["A", 1], np.array([2.5, 0.0]))
    >>> reactions["A"], reactions[0], max(reactions), dict(reactions.items())
    (2.5, 2.5, 2.5, {'A': 2.5, 1: 0.0})
    >>> reactions["B"]
    Traceback (most recent call last):
    ...
    KeyError: "there is no support 'B'; there are 'A', 1"
    """

    __hash__ = None

    def __init__(self, quantity: str, noun: str, keys: Sequence[str | int], values: Sequence[Any]) -> None:
        self.quantity, self._noun, self._keys, self._values = quantity, noun, tuple(keys), values

    def __len__(self) -> int:
        """Count the values."""
        return len(self._keys)

    def __getitem__(self, key: Any) -> Any:
        """Give a value by number or by name; of a slice the values.

        Raises
        ------
        KeyError
            There is no such name.
        IndexError
            There is no such number.
        """
        if isinstance(key, slice):
            return self._values[key]
        if not isinstance(key, str):
            count = len(self)
            try:
                return self._plain(range(count)[key])
            except IndexError:
                there = f"their numbers go from 0 to {count - 1}" if count else "there are none"
                raise IndexError(f"there is no {self._noun} {key}; {there}") from None
        if key not in self._keys:
            raise KeyError(no_such(self._noun, key, self._keys))
        return self._plain(self._keys.index(key))

    def _plain(self, k: int) -> Any:
        value = self._values[k]
        return value.item() if isinstance(value, np.generic) else value

    def __iter__(self) -> Iterator[Any]:
        """Go through the values."""
        return (self._plain(k) for k in range(len(self)))

    def keys(self) -> tuple[str | int, ...]:
        """Give the names, or the number where there is none.

        Returns
        -------
        tuple of (str or int)
        """
        return self._keys

    def values(self) -> list[Any]:
        """Give the values.

        Returns
        -------
        list
        """
        return list(self)

    def items(self) -> Iterable[tuple[str | int, Any]]:
        """Give names with values.

        Returns
        -------
        iterable of (str or int, object)
        """
        return zip(self._keys, self, strict=True)

    def to_dict(self) -> dict[str | int, Any]:
        """As a dict by name.

        Returns
        -------
        dict
        """
        return dict(self.items())

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> np.ndarray:
        """As an array, for numpy."""
        return np.array([np.asarray(one) for one in self] if self.is_nested else self._values, dtype=dtype)

    @property
    def is_nested(self) -> bool:
        """Whether the values are such sequences themselves, as of combinations."""
        return len(self) > 0 and isinstance(self._values[0], Labelled)

    def __eq__(self, other: object) -> bool:
        """Whether names and values are equal."""
        if not isinstance(other, Labelled):
            return NotImplemented
        return self._keys == other._keys and all(np.array_equal(a, b) for a, b in zip(self, other, strict=True))

    def __repr__(self) -> str:
        """Show names and values, of many the first."""
        if self.is_nested:
            rows = [f"{key}: {value!r}" for key, value in zip(self._keys[:MOST], self, strict=False)]
        else:
            rows = [f"{key} {_word(value)}" for key, value in zip(self._keys[:MOST], self, strict=False)]
        rows += [f"{len(self) - MOST:,} more"] if len(self) > MOST else []
        return "\n".join(rows) if self.is_nested else f"{self.quantity}: {', '.join(rows)}"


def _word(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return f"{value.size:,} values"
    if isinstance(value, dict):
        return f"({', '.join(f'{kind} {fmt.number(one.value)}' for kind, one in value.items() if one is not None)})"
    if isinstance(value, tuple):
        return " or ".join(map(str, value))
    return fmt.number(value) if isinstance(value, float) else value if isinstance(value, str) else repr(value)


def by_support(scene: Scene, quantity: str, values: Sequence[Any]) -> Labelled:
    """Name values of the supports of a scene.

    Parameters
    ----------
    scene : Scene
        Whose supports they are.
    quantity : str
        What the values are.
    values : sequence
        One for every support.
    """
    keys = [k if name is None else name for k, name in enumerate(names_of(scene.supports))]
    return Labelled(quantity, "support", keys, values)
