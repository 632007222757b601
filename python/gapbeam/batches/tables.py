"""Tables whose rows are cases: arrays in Python, CSV, Parquet, a folder of scenes.

A table is read some rows at a time. What is read of it can be sent to another process, which makes numbers of it.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from ..base.errors import SceneError
from ..scene.wording import choice, shown
from .chunks import load_arrow

SCENES = (".toml", ".json")


class Rows(Protocol):
    """Some rows of a table, on their way to where they are solved."""

    def __len__(self) -> int:
        """Count them."""

    def columns(self) -> tuple[np.ndarray, dict[int, str]]:
        """Give their numbers, columns by rows, and what is wrong with rows that cannot be read."""


class Table(Protocol):
    """A table of cases.

    Attributes
    ----------
    names : tuple of str
        Of the columns.
    cases : int
        Number of rows.
    digest : str
        Hexadecimal; another table has another one.
    """

    names: tuple[str, ...]
    cases: int
    digest: str

    def rows(self, first: int, stop: int) -> Rows:
        """Give the rows from first to stop, which is left out."""


@dataclass(frozen=True)
class Numbers:
    """Rows that are numbers already, columns by rows."""

    values: np.ndarray

    def __len__(self) -> int:
        """Count the rows."""
        return self.values.shape[1]

    def columns(self) -> tuple[np.ndarray, dict[int, str]]:
        """Give the numbers; nothing is wrong with them."""
        return self.values, {}


class Arrays:
    """Columns in memory.

    Parameters
    ----------
    columns : mapping
        Arrays by name; a single number holds for every row.

    Raises
    ------
    SceneError
        Columns of unequal length, or that hold something else than numbers.
    """

    def __init__(self, columns: Mapping[str, Any]):
        found = {str(name): _array(str(name), value) for name, value in columns.items()}
        lengths = {name: len(value) for name, value in found.items() if value.ndim}
        if not lengths:
            raise SceneError("table", "has no column with a number for every case; give one array at least")
        if len(set(lengths.values())) > 1:
            counts = choice((f"{name} has {count}" for name, count in lengths.items()), "and")
            raise SceneError("table", f"its columns are of unequal length: {counts}; give each one number a case")
        self.names = tuple(found)
        self.cases = next(iter(lengths.values()))
        self._columns = [np.broadcast_to(value, self.cases) for value in found.values()]
        digest = hashlib.sha256(repr((self.names, self.cases)).encode())
        for value in found.values():
            digest.update(np.ascontiguousarray(value))
        self.digest = digest.hexdigest()

    def rows(self, first: int, stop: int) -> Numbers:
        """Give the rows from first to stop, which is left out."""
        return Numbers(np.array([column[first:stop] for column in self._columns]))


def _array(name: str, value: Any) -> np.ndarray:
    """Numbers of a column in double precision."""
    if hasattr(value, "to_numpy"):
        value = value.to_numpy()
    if isinstance(value, np.ma.MaskedArray):
        value = value.astype(float).filled(np.nan)
    try:
        array = np.asarray(value)
        if array.dtype.kind in "biufO":
            array = array.astype(float)
    except (TypeError, ValueError, OverflowError):
        array = np.array("")
    if array.dtype.kind != "f" or array.ndim > 1:
        raise SceneError(f"column {shown(name)}", "expected numbers, one a case")
    return array


class ParquetTable:
    """A Parquet file, which pyarrow reads.

    Parameters
    ----------
    path : pathlib.Path
        The file.

    Raises
    ------
    SceneError
        There is no pyarrow, or the file is no Parquet file of numbers.
    """

    def __init__(self, path: Path):
        pyarrow = load_arrow(SceneError(str(path), "Parquet files need pyarrow: pip install gapbeam[batch], or give a .csv file"))
        try:
            self._file = pyarrow.parquet.ParquetFile(path, pre_buffer=False)
        except (OSError, ValueError) as error:
            raise SceneError(str(path), f"cannot be read as a Parquet file ({error})") from None
        schema = self._file.schema_arrow
        for one in schema:
            kind = one.type
            if not (pyarrow.types.is_integer(kind) or pyarrow.types.is_floating(kind) or pyarrow.types.is_null(kind)):
                raise SceneError(f"{path}, column {shown(one.name)}", f"expected numbers, it holds {kind}")
        self.names, self.cases = tuple(schema.names), self._file.metadata.num_rows
        self.digest = _digest_of_file(path)
        self._next, self._parts = -1, iter(())
        self._left = np.empty((len(self.names), 0))

    def rows(self, first: int, stop: int) -> Numbers:
        """Give the rows from first to stop, which is left out; quickly where they go on from the last ones."""
        if first != self._next:
            begin, group = 0, 0
            while begin + (size := self._file.metadata.row_group(group).num_rows) <= first:
                begin, group = begin + size, group + 1
            self._parts = self._batches(range(group, self._file.num_row_groups))
            self._left, self._next = self._left[:, :0], begin
            self._take(first - begin)
        return Numbers(self._take(stop - first))

    def _take(self, count: int) -> np.ndarray:
        parts, there = [self._left], self._left.shape[1]
        while there < count:
            parts.append(next(self._parts))
            there += parts[-1].shape[1]
        found = np.concatenate(parts, axis=1)
        self._left = found[:, count:].copy()
        self._next += count
        return found[:, :count]

    def _batches(self, groups: range) -> Iterator[np.ndarray]:
        for part in self._file.iter_batches(65_536, row_groups=list(groups), use_threads=False):
            # Whole numbers beyond 2**53 are rounded, as those of other tables are
            yield np.array([column.cast("float64", safe=False).to_numpy(zero_copy_only=False) for column in part.columns])


@dataclass(frozen=True)
class SceneFiles:
    """Some scenes of a folder: the rows are files."""

    paths: tuple[str, ...]

    def __len__(self) -> int:
        """Count them."""
        return len(self.paths)

    def columns(self) -> tuple[np.ndarray, dict[int, str]]:
        """Give no numbers."""
        return np.empty((0, len(self.paths))), {}


@dataclass
class SceneFolder:
    """A folder of scenes, in the order of their names.

    Parameters
    ----------
    path : pathlib.Path
        The folder.

    Raises
    ------
    SceneError
        It holds no scene.
    """

    path: Path
    names: tuple[str, ...] = ()
    files: list[str] = field(default_factory=list)
    digest: str = ""

    def __post_init__(self) -> None:
        """Find the scenes."""
        try:
            self.files = sorted(one.name for one in os.scandir(self.path) if one.name.lower().endswith(SCENES) and one.is_file())
        except OSError as error:
            raise SceneError(str(self.path), f"cannot be read ({error.strerror})") from None
        if not self.files:
            raise SceneError(str(self.path), "the folder holds no scene (.toml or .json)")
        digest = hashlib.sha256()
        for name in self.files:
            digest.update(f"{name}\0{_digest_of_file(self.path / name)}\n".encode("utf-8", "surrogateescape"))
        self.digest = digest.hexdigest()

    @property
    def cases(self) -> int:
        """Number of scenes."""
        return len(self.files)

    def rows(self, first: int, stop: int) -> SceneFiles:
        """Give the scenes from first to stop, which is left out."""
        return SceneFiles(tuple(str((self.path / name).absolute()) for name in self.files[first:stop]))


def _digest_of_file(path: Path) -> str:
    """Give the SHA-256 of a file, hexadecimal."""
    try:
        with open(path, "rb") as stream:
            return hashlib.file_digest(stream, "sha256").hexdigest()
    except OSError as error:
        raise SceneError(str(path), "there is no such file" if isinstance(error, FileNotFoundError) else
                         f"cannot be read ({error.strerror})") from None  # fmt: skip


def take_table(source: Any) -> Table:
    """Take a table from wherever it comes.

    Parameters
    ----------
    source : str, path, Table, mapping, DataFrame, structured array or iterable
        Name of a .csv or .parquet file; arrays by column; pairs of a name and an array; or what has rows of its own, as
        `gapbeam.sample.draw` gives it.

    Raises
    ------
    SceneError
        It is no table.
    """
    if isinstance(source, str | os.PathLike):
        path = Path(source)
        if path.suffix.lower() == ".csv":
            from .csv_tables import CsvTable

            return CsvTable(path)
        if path.suffix.lower() in (".parquet", ".pq"):
            if not path.is_file():
                raise SceneError(str(path), "there is no such file")
            return ParquetTable(path)
        raise SceneError(str(path), f'a table ends in .csv or .parquet, not in "{path.suffix}"')
    if all(hasattr(source, name) for name in ("names", "cases", "digest", "rows")):
        return source
    if isinstance(source, np.ndarray) and source.dtype.names:
        return Arrays({name: source[name] for name in source.dtype.names})
    if hasattr(source, "to_numpy") and hasattr(source, "columns"):
        return Arrays({name: source[name] for name in source.columns})
    if isinstance(source, Iterable) and not isinstance(source, Mapping):
        with suppress(TypeError, ValueError):
            source = dict(source)
    if not isinstance(source, Mapping):
        raise SceneError("table", f"expected columns of numbers by name, or a .csv or .parquet file, got {shown(source)}")
    return Arrays(source)
