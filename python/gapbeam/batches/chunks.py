"""Chunks of results as files: Parquet where there is pyarrow, else structured arrays of numpy."""

from __future__ import annotations

import io
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from ..base.errors import SceneError
from ..base.files import open_own
from ..base.memory import reserve

FORMATS = ("parquet", "npy")
TEXTS = ("scene", "status", "reason")
NO_ARROW = SceneError("the folder of results holds Parquet files, which need pyarrow: pip install gapbeam[batch]")
FOR_ARROW = 350_000_000
"""Bytes of the address space that loading pyarrow takes, and what it does then: with less it may end the process."""


def best_format() -> str:
    """Tell in which format results are written here.

    Returns
    -------
    str
        ``parquet`` or ``npy``.
    """
    return FORMATS[0] if find_spec("pyarrow") else FORMATS[1]


def load_arrow(refusal: SceneError) -> Any:
    """Load pyarrow, which is to start no threads: it does not survive where there is no memory for them.

    Parameters
    ----------
    refusal : SceneError
        What to say where it is not installed.

    Returns
    -------
    module

    Raises
    ------
    SceneError
        The refusal.
    MemoryError
        There is too little memory for it.
    ImportError
        It is there, and cannot be loaded.
    """
    if "pyarrow" not in sys.modules:
        reserve(FOR_ARROW)
    try:
        import pyarrow
        import pyarrow.parquet
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] != "pyarrow":
            raise
        raise refusal from None
    return pyarrow


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
    return f"pyarrow {load_arrow(NO_ARROW).__version__}"


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
    pyarrow = load_arrow(NO_ARROW)
    arrays = [_texts(column, name == "reason") if name in TEXTS else pyarrow.array(column) for name, column in columns.items()]
    table = pyarrow.Table.from_arrays(arrays, names=list(columns))
    pyarrow.parquet.write_table(table, stream, use_dictionary=[name for name in TEXTS if name in columns])
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
    with _opened(path, names) as table:
        found = {name: _texts_of(table[name]) if name in TEXTS else np.asarray(table[name]) for name in names}
        for name, column in found.items():
            if name not in TEXTS and column.dtype.kind not in "fiu":
                raise ValueError(f"its column {name} holds no numbers")
        return found


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
    with _opened(path, ["status"]) as table:
        if isinstance(table["status"], np.ndarray):
            found, counts = np.unique(table["status"], return_counts=True)
            return dict(zip(_texts_of(found).tolist(), counts.tolist(), strict=True))
        counted = table["status"].value_counts().to_pylist()
        return dict(zip(_texts_of([one["values"] for one in counted]), (one["counts"] for one in counted), strict=True))


@contextmanager
def _opened(path: Path, names: Sequence[str]) -> Iterator[Any]:
    """Open a file, which may hold anything, for some columns by name."""
    try:
        with open_own(path) as stream:
            if path.suffix == ".npy":
                yield np.lib.format.read_array(stream)
                return
            yield load_arrow(NO_ARROW).parquet.ParquetFile(stream, pre_buffer=False).read(columns=list(names), use_threads=False)
    except SceneError:
        raise
    except (OSError, ValueError, KeyError, IndexError, TypeError, NotImplementedError, EOFError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else " ".join(str(error).split())
        remedy = "remove it and start the batch again, which makes it anew"
        raise SceneError(str(path), f"cannot be read ({reason}); {remedy}") from None


def _texts_of(column: Any) -> np.ndarray:
    """Texts of a column, whatever it is made of; empty where there is none."""
    entries = column.to_pylist() if hasattr(column, "to_pylist") else list(column)
    texts = [one.decode() if isinstance(one, bytes) else one or "" for one in entries]
    if not all(isinstance(one, str) for one in texts):
        raise ValueError("what should be a text is none")
    return np.array(texts, dtype=object)
