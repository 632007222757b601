"""Files that are written in whole or left as they were."""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from typing import BinaryIO

_UNFINISHED: set[str] = set()
"""Files that are not complete, by the names that they have until then."""


def write_files(contents: Mapping[str | os.PathLike, bytes | Iterable[str]]) -> None:
    """Write files, each in whole, and none of them before all are complete.

    They are written under other names beside their places and put there at the end, so neither a full disk nor Ctrl-C
    leaves half a file. A link stays a link; what it points to is replaced, and keeps owner and permissions. Devices
    and pipes are written to as they are.

    Parameters
    ----------
    contents : mapping of path to bytes or iterable of str
        What is to stand in each file, texts in UTF-8.

    Raises
    ------
    OSError
        Names the file, and why it cannot be written.
    """
    places = {name: os.path.realpath(name) for name in contents if not _is_device(name)}
    beside = {name: os.path.join(os.path.dirname(place), f".gapbeam-{os.urandom(8).hex()}") for name, place in places.items()}
    _UNFINISHED.update(beside.values())
    try:
        for name, content in contents.items():
            data = [content] if isinstance(content, bytes) else (text.encode("utf-8") for text in content)
            with _named(name):
                if name in places:
                    _write_new(beside[name], data, places[name])
                else:
                    with open(name, "wb") as stream:
                        stream.writelines(data)
        for name, place in places.items():
            with _named(name):
                os.replace(beside[name], place)
    finally:
        remove_unfinished(beside.values())


def write_lasting(path: str | os.PathLike, data: bytes, mark: str = "", *, is_first: bool = False) -> None:
    """Write a file that is there in whole or not at all, even where the machine loses its power meanwhile.

    It is written beside its place, under its name after a dot, down to the disk; then it is renamed, and the folder written. A link
    at either place is replaced, not followed.

    Parameters
    ----------
    path : path
        The file; another one of this name is replaced.
    data : bytes
        What is to stand in it.
    mark : str
        Ends its name meanwhile, where several processes may write the same file.
    is_first : bool
        Leave a file of this name as it is.

    Raises
    ------
    OSError
        Names the file, and why it cannot be written.
    """
    folder, name = os.path.split(os.path.abspath(path))
    beside = os.path.join(folder, f".{name}{mark}")
    _UNFINISHED.add(beside)
    try:
        with _named(path):
            with suppress(FileNotFoundError):
                os.unlink(beside)
            with open(beside, "xb") as stream:
                stream.write(data)
                stream.flush()
                os.fsync(stream.fileno())
            if is_first:
                with suppress(FileExistsError):
                    os.link(beside, path)
            else:
                os.replace(beside, path)
            _sync_folder(folder)
    finally:
        remove_unfinished([beside])


def open_own(path: str | os.PathLike) -> BinaryIO:
    """Open a file for reading where it is one by itself: no link is followed, and nothing is waited for.

    Parameters
    ----------
    path : path
        The file.

    Returns
    -------
    binary file

    Raises
    ------
    OSError
        Names the file, and why it cannot be read.
    """
    with _named(path):
        flags = os.O_RDONLY | sum(getattr(os, name, 0) for name in ("O_NOFOLLOW", "O_NONBLOCK", "O_CLOEXEC", "O_BINARY"))
        try:
            descriptor = os.open(path, flags)
        except OSError as error:
            if error.errno != errno.ELOOP:
                raise
            raise OSError(errno.ELOOP, "it is a link") from None
        if not stat.S_ISREG(os.fstat(descriptor).st_mode):
            os.close(descriptor)
            raise OSError(errno.EINVAL, "it is no file")
        return open(descriptor, "rb")


def _sync_folder(folder: str) -> None:
    """Write the names of a folder down to the disk, where the system can do that."""
    with suppress(PermissionError):  # Windows opens no folders
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)


def remove_unfinished(paths: Iterable[str] = _UNFINISHED) -> None:
    """Remove files that are not complete.

    Parameters
    ----------
    paths : iterable of str
        Which ones; default all, as when the process is to end in the middle of its work.
    """
    for path in list(paths):
        with suppress(OSError):  # most are in their places by now
            os.unlink(path)
        _UNFINISHED.discard(path)


def _is_device(name: str | os.PathLike) -> bool:
    """Whether there is something that cannot be replaced by a file."""
    try:
        return not stat.S_ISREG(os.stat(name).st_mode)
    except FileNotFoundError:
        return False


def _write_new(path: str, data: Iterable[bytes], model: str) -> None:
    """Write a file that is not there yet, down to the disk, with owner and permissions of another one if that exists."""
    old = os.stat(model) if os.path.exists(model) else None
    if old and not os.access(model, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
    with open(path, "xb") as stream:
        if old:
            with suppress(AttributeError, PermissionError):  # Windows has no owners, and only root gives files away
                os.chown(path, old.st_uid, old.st_gid)
            with suppress(PermissionError):  # a disk that knows no permissions
                os.chmod(path, stat.S_IMODE(old.st_mode))
        stream.writelines(data)
        stream.flush()
        os.fsync(stream.fileno())


@contextmanager
def _named(name: str | os.PathLike) -> Iterator[None]:
    """Let an error name the file that the user named."""
    try:
        yield
    except OSError as error:
        raise OSError(error.errno, error.strerror, os.fspath(name)) from None
