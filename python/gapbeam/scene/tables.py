"""Lists of tables given as columns: arrays by key, where a single value holds for all."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from functools import cache
from typing import Any, NamedTuple, get_args, get_type_hints, overload

import msgspec
import numpy as np

from ..base.errors import SceneError
from ..base.records import read_only
from .held import hold
from .loads import Load
from .structs import Foundation, Scene, Section, Support
from .wording import choice

LOADS = {load.__struct_config__.tag: load for load in get_args(Load)}
"""Structs of loads by their type."""


class Table(Sequence):
    """Supports, foundations, loads or sections as columns; a struct is made of a row when it is looked at.

    Parameters
    ----------
    struct : type
        What a row is.
    columns : mapping
        By attribute: an array with an entry a row, or one value for all.
    count : int
        Number of rows.
    """

    def __init__(self, struct: type[msgspec.Struct], columns: Mapping[str, Any], count: int):
        self.struct = struct
        self._columns = {key: read_only(value) for key, value in columns.items()}
        self._count = count

    def __len__(self) -> int:
        """Count the rows."""
        return self._count

    @overload
    def __getitem__(self, index: int) -> Any: ...

    @overload
    def __getitem__(self, index: slice) -> list[Any]: ...

    def __getitem__(self, index: int | slice) -> Any:
        """Make the struct of a row, or those of some rows."""
        if isinstance(index, slice):
            return [self[k] for k in range(self._count)[index]]
        k = range(self._count)[index]
        row = self.struct(**{key: _plain(value[k]) if _is_array(value) else value for key, value in self._columns.items()})
        return hold(row)  # it is made anew each time, so a change would be lost

    def __iter__(self) -> Iterator[Any]:
        """Go through the rows."""
        return (self[k] for k in range(self._count))

    def __eq__(self, other: object) -> bool:
        """Whether all rows are equal, with those of a list too."""
        if isinstance(other, Table) and self.struct is other.struct and self._columns.keys() == other._columns.keys():
            return len(self) == len(other) and all(
                np.array_equal(value, other._columns[key]) for key, value in self._columns.items()
            )
        return isinstance(other, Sequence) and list(self) == list(other)

    __hash__ = None

    def column(self, key: str) -> Any:
        """Give the values of one attribute.

        Parameters
        ----------
        key : str
            Its name.

        Returns
        -------
        numpy.ndarray or object
            One for every row, or one for all; the struct's default where it is not given.
        """
        value = self._columns[key] if key in self._columns else _defaults(self.struct)[key]
        if value is None or isinstance(value, str) or _is_array(value):
            return value
        return np.broadcast_to(np.asarray(value), (self._count, *np.shape(value)))


def _is_array(value: Any) -> bool:
    return isinstance(value, np.ndarray)


def _plain(value: Any) -> Any:
    return tuple(value.tolist()) if _is_array(value) else value.item() if isinstance(value, np.generic) else value


def take_tables(source: Scene | Mapping[str, Any]) -> tuple[Scene | Mapping[str, Any], dict[str, Table]]:
    """Take out of a scene what is given as columns: a mapping of arrays, a pandas DataFrame, a structured array.

    Parameters
    ----------
    source : Scene or mapping
        As a user wrote it; left as it is.

    Returns
    -------
    source : Scene or mapping
        The same with empty lists instead, or with lists where columns hold something else than numbers and words.
    tables : dict
        What was taken out, by key.

    Raises
    ------
    SceneError
        Columns of unequal length.
    """
    tables: dict[str, Table] = {}
    others: dict[str, list[Any]] = {}
    for key in ("supports", "sections", "foundation", "loads"):
        value = source.get(key) if isinstance(source, Mapping) else getattr(source, key)
        if isinstance(value, Table):
            tables[key] = value
        elif (found := _columns(key, value)) is not None:
            columns, count = found
            table = _table(key, columns, count)
            if table is None:
                others[key] = [_row(columns, k) for k in range(count)]
            else:
                tables[key] = table
    if not tables and not others:
        return source, {}
    others |= {key: [] for key in tables}
    if isinstance(source, Mapping):
        return {**source, **others}, tables
    return msgspec.structs.replace(source, **others), tables


def take_arrays(source: Scene | Mapping[str, Any]) -> tuple[Scene | Mapping[str, Any], dict[tuple[int, str], np.ndarray]]:
    """Take out of a scene the profiles and moduli of foundations that are given as arrays of points.

    Parameters
    ----------
    source : Scene or mapping
        As a user wrote it; left as it is.

    Returns
    -------
    source : Scene or mapping
        The same without them.
    arrays : dict
        What was taken out, with two columns, by the number of the foundation and the key.
    """
    items = source.get("foundation") if isinstance(source, Mapping) else source.foundation
    if not isinstance(items, list | tuple):
        return source, {}
    arrays = {}
    rest = list(items)
    for i, item in enumerate(items):
        for key in ("profile", "k"):
            given = item.get(key) if isinstance(item, Mapping) else getattr(item, key, None)
            if type(given) is np.ndarray and given.dtype.kind in "iuf" and given.dtype.itemsize <= 8 and given.shape[1:] == (2,):
                arrays[i, key] = read_only(given.astype(float))
        taken = {key: None for k, key in arrays if k == i}
        if taken and isinstance(item, Mapping):
            rest[i] = {key: value for key, value in item.items() if key not in taken}
        elif taken:
            rest[i] = msgspec.structs.replace(item, **taken)
    if not arrays:
        return source, {}
    if isinstance(source, Mapping):
        return {**source, "foundation": rest}, arrays
    return msgspec.structs.replace(source, foundation=rest), arrays


def _columns(key: str, value: Any) -> tuple[dict[str, Any], int] | None:
    """Columns by name, and their length; None where something else is given."""
    if hasattr(value, "to_numpy") and hasattr(value, "columns"):
        value = {name: value[name].to_numpy() for name in value.columns}
    elif isinstance(value, np.ndarray) and value.dtype.names:
        value = {name: value[name] for name in value.dtype.names}
    if not isinstance(value, Mapping):
        return None
    columns = {name: _column(one) for name, one in value.items()}
    lengths = {name: len(one) for name, one in columns.items() if isinstance(one, np.ndarray)}
    if not lengths:
        return None
    if len(set(lengths.values())) > 1:
        counts = choice((f"{name} has {count}" for name, count in lengths.items()), "and")
        raise SceneError(key, f"its columns are of unequal length: {counts}; give each one number, or one for every row")
    return columns, next(iter(lengths.values()))


def _column(value: Any) -> Any:
    """An array of a list, of its objects where they are of several kinds; anything else as it is."""
    if hasattr(value, "to_numpy"):
        value = value.to_numpy()
    if isinstance(value, np.ndarray):
        return value if value.ndim else value.item()
    if isinstance(value, range):
        return np.array(value)
    if not isinstance(value, list):
        return value
    with suppress(ValueError, OverflowError):  # rows of unequal length, endless integers
        array = np.array(value)
        if array.dtype.kind != "U" or all(isinstance(entry, str) for entry in value):
            return array
    array = np.empty(len(value), dtype=object)
    array[:] = value
    return array


def _table(key: str, columns: dict[str, Any], count: int) -> Table | None:
    """A table of columns that hold what they should; None where they do not, or loads are of several types."""
    struct = {"supports": Support, "sections": Section, "foundation": Foundation}.get(key)
    rest = dict(columns)
    if key == "loads":
        tag = rest.pop("type", None)
        struct = LOADS.get(tag) if isinstance(tag, str) else None
    if struct is None:
        return None
    takes = _takes(struct)
    if not rest.keys() <= takes.keys() or any(one.is_required and name not in rest for name, one in takes.items()):
        return None
    found = {takes[name].attribute: _clean(takes[name], value) for name, value in rest.items()}
    return None if any(value is None for value in found.values()) else Table(struct, found, count)


class _Takes(NamedTuple):
    """What a column takes."""

    attribute: str
    is_required: bool
    words: frozenset[str]
    is_pair: bool


@cache
def _takes(struct: type[msgspec.Struct]) -> dict[str, _Takes]:
    """What columns there may be, by key."""
    hints, found = get_type_hints(struct), {}
    for field in msgspec.structs.fields(struct):
        kind = hints[field.name]
        words = {word for part in (kind, *get_args(kind)) for word in get_args(part) if isinstance(word, str)}
        required = field.name == "k" if struct is Foundation else field.required
        found[field.encode_name] = _Takes(field.name, required, frozenset(words), kind == tuple[float, float])
    return {name: one for name, one in found.items() if name not in ("law", "profile")}


@cache
def _defaults(struct: type[msgspec.Struct]) -> dict[str, Any]:
    """Values of attributes that are not given."""
    return dict(zip(reversed(struct.__struct_fields__), reversed(struct.__struct_defaults__), strict=False))


def _clean(takes: _Takes, value: Any) -> Any:
    """A column of numbers, whole numbers or words of a choice; None for anything else."""
    many = isinstance(value, np.ndarray)
    array = value if many else np.asanyarray(value)
    if np.ma.isMaskedArray(value) or array.ndim != many + takes.is_pair:
        return None
    name, kind = takes.attribute, array.dtype.kind
    if name in ("name", "case"):
        return _own(value) if kind == "U" else None
    if kind == "U" and takes.words:
        return _own(value) if _holds(takes.words, array) else None
    if kind not in "iuf" or array.dtype.itemsize > 8 or (takes.words and name != "rotation"):
        return None
    if array.shape[many:] not in ((), (2,)):
        return None
    if name == "node":
        if kind == "f" and (array == np.round(array)).all() and (abs(array.astype(float)) < 2**31).all():
            value = array = array.astype(np.int64)
        small = array.dtype.kind in "iu" and array.size and array.min() >= -(2**31) and array.max() < 2**31
        return _own(value) if small else None
    return array.astype(float) if array.ndim else float(array)


def _holds(words: frozenset[str], array: np.ndarray) -> bool:
    """Whether all entries are some of the words."""
    is_one = np.zeros(array.shape, dtype=bool)
    for word in words:
        is_one |= array == word
    return bool(is_one.all())


def _own(value: Any) -> Any:
    """The caller's arrays stay his own."""
    return value.copy() if _is_array(value) else value


def _row(columns: dict[str, Any], k: int) -> dict[str, Any]:
    """One row, without what is not given there."""
    row = {name: value[k] if _is_array(value) else value for name, value in columns.items()}
    return {name: value for name, value in row.items() if value is not None}
