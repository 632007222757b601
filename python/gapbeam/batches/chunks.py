"""Chunks of results as files: Parquet where there is pyarrow, else structured arrays of numpy."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from ..base.errors import SceneError

FORMATS = ("parquet", "npy")
TEXTS = ("scene", "status", "reason")


def best_format() -> str:
    """Tell in which format results are written here.

    Returns
    -------
    str
        ``parquet`` or ``npy``.
    """
    return FORMATS[0] if find_spec("pyarrow") else FORMATS[1]


def writer(kind: str) -> str:
    """Tell by what files of a format are written, as other versions may write other bytes.

    Parameters
    ----------
    kind : {"parquet", "npy"}
        The format.

    Returns
    -------
    str
        Name and version.
    """
    if kind == "npy":
        return "npy"
    try:
        import pyarrow
    except ImportError:
        raise SceneError("the folder of results holds Parquet files, which need pyarrow: pip install gapbeam[batch]") from None
    return f"pyarrow {pyarrow.__version__}"


def encode(columns: Mapping[str, np.ndarray], kind: str) -> bytes:
    """Give the contents of a file.

    Parameters
    ----------
    columns : mapping
        Arrays of equal length by name; texts are bytes in UTF-8.
    kind : {"parquet", "npy"}
        The format.

    Returns
    -------
    bytes
        The same columns give the same bytes.
    """
    stream = io.BytesIO()
    if kind == "npy":
        rows = np.empty(len(columns["case"]), dtype=[(name, column.dtype) for name, column in columns.items()])
        for name, column in columns.items():
            rows[name] = column
        np.save(stream, rows)
        return stream.getvalue()
    import pyarrow
    from pyarrow import parquet

    arrays = [_texts(column, name == "reason") if name in TEXTS else pyarrow.array(column) for name, column in columns.items()]
    table = pyarrow.Table.from_arrays(arrays, names=list(columns))
    parquet.write_table(table, stream, use_dictionary=[name for name in TEXTS if name in columns])
    return stream.getvalue()


def _texts(column: np.ndarray, may_be_none: bool) -> object:
    """Texts for pyarrow; no text where none is needed."""
    import pyarrow
    from pyarrow import compute

    whole = pyarrow.array(column, type=pyarrow.binary()).cast(pyarrow.string())
    return compute.replace_with_mask(whole, column == b"", pyarrow.scalar(None, pyarrow.string())) if may_be_none else whole


def read_columns(path: Path, names: Sequence[str]) -> dict[str, np.ndarray]:
    """Read some columns of a file.

    Parameters
    ----------
    path : pathlib.Path
        The file.
    names : sequence of str
        Of the columns.

    Returns
    -------
    dict of numpy.ndarray
        Texts are objects, empty where there is none.

    Raises
    ------
    SceneError
        It cannot be read.
    """
    with _readable(path):
        if path.suffix == ".npy":
            rows = np.load(path, mmap_mode="r")
            return {name: _decoded(rows[name]) if name in TEXTS else np.array(rows[name]) for name in names}
        from pyarrow import parquet

        table = parquet.read_table(path, columns=list(names), partitioning=None)
        return {
            name: np.array([text or "" for text in table[name].to_pylist()], dtype=object)
            if name in TEXTS
            else table[name].to_numpy()
            for name in names
        }


def count_statuses(path: Path) -> dict[str, int]:
    """Count the cases of a file by their outcome.

    Parameters
    ----------
    path : pathlib.Path
        The file.

    Returns
    -------
    dict of int

    Raises
    ------
    SceneError
        It cannot be read.
    """
    with _readable(path):
        if path.suffix == ".npy":
            found, counts = np.unique(np.load(path, mmap_mode="r")["status"], return_counts=True)
            return dict(zip(_decoded(found).tolist(), counts.tolist(), strict=True))
        from pyarrow import parquet

        counted = parquet.read_table(path, columns=["status"], partitioning=None)["status"].value_counts().to_pylist()
        return {one["values"]: one["counts"] for one in counted}


@contextmanager
def _readable(path: Path) -> Iterator[None]:
    try:
        yield
    except (OSError, ValueError, KeyError) as error:
        raise SceneError(str(path), f"cannot be read ({error}); remove it and start the batch again, which makes it anew") from None


def _decoded(column: np.ndarray) -> np.ndarray:
    return np.array([text.decode() for text in column.tolist()], dtype=object)
