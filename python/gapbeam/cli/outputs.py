"""Input and output of a command: the scene, the files that its options name, standard output."""

from __future__ import annotations

import os
import stat
import sys
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path

from ..base.errors import SceneError
from ..base.files import write_files

PICTURES = (".png", ".pdf", ".svg")
SUFFIXES = {
    "--json": (".json",), "--csv": (".csv",), "--xlsx": (".xlsx",), "--markdown": (".md",), "--output": (".json",),
    "--plot": PICTURES, "--path": PICTURES, "--html": (".html", ".htm"),
}  # fmt: skip
"""Suffixes of the files that an option takes; only pictures need one."""


def source(name: str) -> Mapping | str:
    """Give `read_scene` what it takes: the name of a file, or the contents of standard input."""
    if name != "-":
        return name
    from ..scene.files import read_standard_input

    return read_standard_input()


@contextmanager
def until_closed() -> Iterator[None]:
    """Write to standard output until its reader has seen enough; a title may hold characters it has not."""
    if sys.stdout is None:  # closed: nobody reads
        sys.stdout = open(os.devnull, "w")  # noqa: SIM115  to the end of the process
    if hasattr(sys.stdout, "reconfigure"):
        sys.stdout.reconfigure(errors="backslashreplace")
    try:
        yield
        sys.stdout.flush()
    except (BrokenPipeError, SystemExit):  # rich turns the first into the second
        _drop_standard_output()
    except OSError as error:
        if error.errno is not None and error.filename is None:
            _drop_standard_output()
            raise OSError(error.errno, error.strerror, "standard output") from None
        raise


def _drop_standard_output() -> None:
    """Let go of what cannot be written, or the end of Python would try once more."""
    with suppress(OSError):  # a caller's own stream may be no file
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


class Outputs:
    """The files that options of a command name; what could not be written, or would destroy another file, is refused at once.

    Parameters
    ----------
    names : mapping of str to (str or None)
        The names by option, None where it is not given; - is standard output.
    scene : str, optional
        Name of the scene that is read; - is standard input.

    Raises
    ------
    SceneError
        Names the option, and what to give instead.
    """

    def __init__(self, names: Mapping[str, str | None], scene: str | None = None) -> None:
        self._names = {option: name for option, name in names.items() if name is not None}
        for option, name in self._names.items():
            if name == "-" and SUFFIXES[option] not in (PICTURES, SUFFIXES["--xlsx"]):
                if sys.stdout is None:
                    raise SceneError(option, "standard output is closed; give the name of a file")
                continue
            _check_suffix(option, name)
            _check_place(option, name)
            if _is_open_file(name, 1):
                raise SceneError(option, f'standard output goes to "{name}" already; give - or another file')
            if scene is not None and (_is_open_file(name, 0) if scene == "-" else _same(name, scene)):
                raise SceneError(option, f'"{name}" is the scene; give another file')
        self._check_different()

    def _check_different(self) -> None:
        rows = list(self._names.items())
        for index, (option, name) in enumerate(rows):
            for other, before in rows[:index]:
                if _same(name, before):
                    raise SceneError(f'{other}, {option} need different files, got "{before}" and "{name}"')

    def __contains__(self, option: str) -> bool:
        """Whether an option is given."""
        return option in self._names

    def __getitem__(self, option: str) -> str:
        """Give the name that came with an option."""
        return self._names[option]

    def suffix(self, option: str) -> str:
        """Suffix of the file of an option, which decides on the format of a picture."""
        return Path(self[option]).suffix

    @property
    def on_standard_output(self) -> bool:
        """Whether one of them is standard output, where nothing else may go then."""
        return "-" in self._names.values()

    def write(self, contents: Mapping[str, bytes | Iterable[str]]) -> None:
        """Write all files or none, then what goes to standard output.

        Parameters
        ----------
        contents : mapping of str to (bytes or iterable of str)
            What the options asked for.
        """
        named = {self._names[option]: content for option, content in contents.items()}
        text = "".join(named.pop("-", ()))
        write_files(named)
        with until_closed():
            if text:
                sys.stdout.write(text)


def _check_suffix(option: str, name: str) -> None:
    suffix, right = Path(name).suffix.lower(), SUFFIXES[option]
    if suffix not in right and (suffix or right in (PICTURES, SUFFIXES["--xlsx"])):
        *head, last = right
        raise SceneError(option, f'expected a file that ends in {", ".join(head)}{" or " if head else ""}{last}, got "{name}"')


def _check_place(option: str, name: str) -> None:
    if not name or "\0" in name or os.path.isdir(name):
        raise SceneError(option, f'expected the name of a file, got "{name}"')
    place = os.path.realpath(name)
    folder = os.path.dirname(place)
    if not os.path.isdir(folder):
        raise SceneError(option, f'the folder of "{name}" does not exist')
    try:
        exists, is_file = True, stat.S_ISREG(os.stat(place).st_mode)
    except FileNotFoundError:
        exists = is_file = False
    except OSError as error:
        raise SceneError(option, f'cannot write "{name}" ({error.strerror})') from None
    if exists and not os.access(place, os.W_OK):
        raise SceneError(option, f'no permission to write "{name}"')
    if (is_file or not exists) and not os.access(folder, os.W_OK):
        raise SceneError(option, f'no permission to write in the folder of "{name}"')


def _same(first: str, second: str) -> bool:
    """Whether two names lead to one file, by whatever links and spellings."""
    if os.path.realpath(first) == os.path.realpath(second):
        return True
    return os.path.exists(first) and os.path.exists(second) and os.path.samefile(first, second)


def _is_open_file(name: str, descriptor: int) -> bool:
    """Whether standard input (0) or output (1) is this very file; devices and pipes are none."""
    try:
        opened, found = os.fstat(descriptor), os.stat(name)
    except OSError:
        return False
    return stat.S_ISREG(found.st_mode) and os.path.samestat(opened, found)
