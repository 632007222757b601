"""The folder of a batch: a manifest that says what is solved, and a file for every chunk that is done.

A chunk is done where its file is there: it is written under another name, down to the disk, and renamed. So whatever ends a
batch, it goes on from what is there, and nothing is in part.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..base.errors import SceneError
from ..base.files import open_own, write_lasting
from ..scene.wording import choice, shown
from .chunks import FORMATS

MANIFEST = "_manifest.json"
"""Programs that read all Parquet files of a folder pass over names that begin like this."""
LOCK = ".lock"
TEXTS = {"title", "name", "case", "force", "length"}
"""Keys of a scene that hold any text."""
ELSE = "give --out another folder, or remove this one to begin anew"
CHANGES = {
    "gapbeam": "was written by gapbeam {0}, and this is {1}",
    "writer": "was written with {0}, and here is {1}, which may write other bytes",
    "scene": "holds results of another scene",
    "table": "holds results of another table",
    "columns": "holds other columns ({0})",
    "chunk": "has files of {0} cases, not of {1}",
    "format": "holds {0} files, not {1}",
    "cases": "says that there are {0} cases, and the table has {1}",
    "chunks": "says that there are {0} files, and there are {1}",
    "inputs": "says that the table has the columns {0}, and it has {1}",
    "want": "says that {0} is wanted, and it is {1}",
    "supports": "names other supports ({0})",
    "data": "says that the scene is another one",
}
"""What may be different in a folder, in words: all that its manifest says."""
KINDS = {
    str: ("a text", ("gapbeam", "writer", "format", "scene", "table")),
    int: ("a whole number from 1 on", ("cases", "chunk", "chunks")),
    list: ("a list of texts", ("inputs", "want", "columns", "supports")),
}
"""What stands in a manifest, but the scene."""
Share = tuple[int, int]
"""Of a batch: the third of ten is (3, 10)."""
PART = re.compile(r"part-(\d{6,18})\.(\w+)")


@dataclass(frozen=True)
class Folder:
    """A folder of results.

    Attributes
    ----------
    path : pathlib.Path
        Where it is.
    manifest : dict
        ``gapbeam`` and ``writer`` (versions), ``format``, ``scene`` and ``table`` (hashes), ``data`` (the scene), ``want``,
        ``columns``, ``inputs``, ``cases``, ``chunk`` (cases a file) and ``chunks`` (files).
    share : (int, int) or None
        What of the batch is looked at; None: all.
    """

    path: Path
    manifest: dict[str, Any]
    share: Share | None = None

    def chunks(self) -> range:
        """Give the chunks of the share."""
        number, of = self.share or (1, 1)
        count = self.manifest["chunks"]
        return range((number - 1) * count // of, number * count // of)

    def file(self, chunk: int) -> Path:
        """Give the file of a chunk."""
        return self.path / f"part-{chunk:06d}.{self.manifest['format']}"

    def part(self, chunk: int) -> tuple[int, int]:
        """Give the first case of a chunk, and the one after its last."""
        size = self.manifest["chunk"]
        return chunk * size, min((chunk + 1) * size, self.manifest["cases"])

    def done(self) -> list[int]:
        """Give the chunks that are done, in order."""
        numbers = (int(one[1]) for one in map(PART.fullmatch, os.listdir(self.path)) if one and one[2] == self.manifest["format"])
        return sorted(set(numbers).intersection(self.chunks()))

    def expect_cases(self, chunk: int, count: int) -> None:
        """Refuse a file that has not as many cases as it should have.

        Raises
        ------
        SceneError
            Names the file.
        """
        first, stop = self.part(chunk)
        if count != stop - first:
            remedy = "remove it and start the batch again, which makes it anew"
            raise SceneError(str(self.file(chunk)), f"holds {count:,} cases, and should hold {stop - first:,}; {remedy}")

    def write(self, chunk: int, data: bytes) -> None:
        """Write a chunk.

        Raises
        ------
        OSError
            Names the file, and why it cannot be written; the batch can be started again.
        """
        try:
            write_lasting(self.file(chunk), data, _mark(self.share))
        except OSError as error:
            remedy = "when that is mended, start the same batch again, and it continues"
            raise OSError(error.errno, f"{error.strerror}; {remedy}", error.filename) from None

    def remove(self, chunk: int) -> None:
        """Remove a chunk, so that it is made anew."""
        self.file(chunk).unlink(missing_ok=True)


def _mark(share: Share | None) -> str:
    """End of the names of files that only this share writes."""
    return "" if share is None else ".{}-of-{}".format(*share)


def open_folder(path: str | os.PathLike, share: Share | None = None) -> Folder:
    """Open a folder that a batch has begun.

    Parameters
    ----------
    path : str or path
        The folder.
    share : (int, int), optional
        What of the batch is looked at.

    Raises
    ------
    SceneError
        It is none, or its manifest says what cannot be.
    """
    path = Path(path)
    try:
        with open_own(path / MANIFEST) as stream:
            manifest = json.loads(stream.read())
    except (FileNotFoundError, NotADirectoryError):
        raise SceneError(str(path), "is no folder of a batch; give the one that gapbeam batch --out has written") from None
    except (OSError, ValueError, RecursionError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        raise SceneError(str(path / MANIFEST), f"cannot be read ({reason}); {ELSE}") from None
    _check(str(path / MANIFEST), manifest)
    return Folder(path, manifest, share)


def _check(place: str, manifest: Any) -> None:
    """Refuse a manifest that no batch can have written."""
    if not isinstance(manifest, dict):
        raise SceneError(place, f"expected an object, got {shown(manifest)}; {ELSE}")

    def expect(key: str, words: str, right: bool) -> None:
        if key not in manifest:
            raise SceneError(place, f"does not say {key}; {ELSE}")
        if not right:
            raise SceneError(f"{place}, {key}", f"expected {words}, got {shown(manifest[key])}; {ELSE}")

    for kind, (words, keys) in KINDS.items():
        for key in keys:
            value = manifest.get(key)
            right = type(value) is kind and (kind is not int or value > 0)
            expect(key, words, right and (kind is not list or all(isinstance(one, str) for one in value)))
    expect("data", "a scene, or null", isinstance(manifest.get("data"), dict | None))
    expect("format", choice(FORMATS), manifest["format"] in FORMATS)
    chunks = -(-manifest["cases"] // manifest["chunk"])
    words = f"{chunks}, as many as {manifest['cases']} cases in files of {manifest['chunk']} take"
    expect("chunks", words, manifest["chunks"] == chunks)


def begin_folder(path: Path, manifest: Mapping[str, Any], share: Share | None = None) -> Folder:
    """Begin a folder, or go on with it.

    Parameters
    ----------
    path : pathlib.Path
        The folder, locked.
    manifest : mapping
        What is to be solved.
    share : (int, int), optional
        What of it is solved here, while others may solve the rest.

    Raises
    ------
    SceneError
        It holds results of something else.
    OSError
        It cannot be written.
    """
    if not (path / MANIFEST).exists():
        if any(not one.name.startswith(".") for one in os.scandir(path)) and not (path / MANIFEST).exists():
            raise SceneError(str(path), "holds other files, and no batch; give --out a new folder")
        contents = (json.dumps(manifest, indent=1) + "\n").encode()
        write_lasting(path / MANIFEST, contents, _mark(share), is_first=share is not None)
    folder = open_folder(path, share)
    for key, words in CHANGES.items():
        before, now = folder.manifest[key], json.loads(json.dumps(manifest[key]))
        if before != now:
            told = [", ".join(one) if isinstance(one, list) else one for one in (before, now)]
            raise SceneError(str(path), f"{words.format(*told)}; {ELSE}")
    for one in os.scandir(path):
        if share is None and one.name.startswith(f"{LOCK}."):  # of a part that was ended
            os.unlink(one.path)
        if one.name.startswith(".part-") and one.name.endswith(_mark(share)):  # being written when the process ended
            os.unlink(one.path)
    return folder


@contextmanager
def locked(path: Path, share: Share | None = None) -> Iterator[None]:
    """Keep other batches out of a folder, which is made where it is not there.

    The lock is the system's, so it ends with the process, whatever ends that.

    Parameters
    ----------
    path : pathlib.Path
        The folder.
    share : (int, int), optional
        Keep out only who solves the same share, or all.

    Raises
    ------
    SceneError
        Another batch is at work there, or it is a file.
    OSError
        It cannot be made or written.
    """
    try:
        path.mkdir(parents=True, exist_ok=True)
    except FileExistsError:
        raise SceneError(str(path), "is a file, and results go into a folder; give --out another name") from None
    another = "another batch writes into this folder; wait for its end, or give another one"
    if share is None:
        with _held(path / LOCK, another):
            yield
        return
    own = path / f"{LOCK}{_mark(share)}"
    with _held(path / LOCK, another, is_shared=True), _held(own, "the same part is at work in this folder; wait for its end"):
        try:
            yield
        finally:
            with suppress(OSError):
                own.unlink()


@contextmanager
def _held(name: Path, refusal: str, is_shared: bool = False) -> Iterator[None]:
    """Hold a lock."""
    descriptor = os.open(name, os.O_RDWR | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0), 0o666)
    try:
        try:
            _lock(descriptor, is_shared)
            is_there = os.path.samestat(os.fstat(descriptor), os.stat(name))  # not removed meanwhile by who had it
        except OSError:
            is_there = False
        if not is_there:
            raise SceneError(str(name.parent), refusal)
        yield
    finally:
        os.close(descriptor)


def _lock(descriptor: int, is_shared: bool) -> None:
    try:
        import fcntl
    except ImportError:  # Windows
        import msvcrt

        if not is_shared:  # it has no such locks
            msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
        return
    fcntl.flock(descriptor, (fcntl.LOCK_SH if is_shared else fcntl.LOCK_EX) | fcntl.LOCK_NB)


def as_json(value: Any) -> Any:
    """Give plain data without numbers that JSON does not know: inf is written as a text.

    Examples
    --------
    >>> as_json({"EI": float("inf"), "spans": [6.0]})
    {'EI': 'inf', 'spans': [6.0]}
    """
    if isinstance(value, dict):
        return {key: as_json(one) for key, one in value.items()}
    if isinstance(value, list | tuple):
        return [as_json(one) for one in value]
    if isinstance(value, float) and value in (float("inf"), -float("inf")):
        return str(value)
    return value


def from_json(value: Any) -> Any:
    """Take back what `as_json` wrote, where no text is inf by itself."""
    if isinstance(value, dict):
        return {key: one if key in TEXTS else from_json(one) for key, one in value.items()}
    if isinstance(value, list):
        return [from_json(one) for one in value]
    return float(value) if value in ("inf", "-inf") else value
