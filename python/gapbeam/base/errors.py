"""Exceptions of gapbeam.

Every message about a scene has the form ``place: what is wrong, what to do``, where the place is the path of
the key as a user would write it (``supports[2].gap``; lists count from 0).

>>> print(SceneError("supports[2].gap", 'expected a number, got "0,02"'))
supports[2].gap: expected a number, got "0,02"
"""

from __future__ import annotations

import re
from collections.abc import Container, Sequence
from enum import IntEnum

from .characters import visible


class GapbeamError(Exception):
    """Base of all errors that gapbeam raises on purpose."""


class SceneError(GapbeamError, ValueError):
    """A scene that cannot be read, or that makes no sense.

    Parameters
    ----------
    place : str
        Path of the key, or name of the file; empty if there is none to name.
    problem : str
        What is wrong, with the offending value, and what was expected.

    Attributes
    ----------
    place : str
        As above.
    problem : str
        As above. The message shows control characters of both as escapes.
    """

    def __init__(self, place: str, problem: str | None = None) -> None:
        if problem is None:
            place, problem = "", place
        super().__init__(visible(f"{place}: {problem}" if place else problem))
        self.place = place
        self.problem = problem

    def __reduce__(self) -> tuple:
        """Pickle by place and problem, as made."""
        return type(self), (self.place, self.problem)


class SceneFileError(SceneError):
    """All mistakes of a scene file, each with its line.

    Parameters
    ----------
    file : str
        Its name.
    mistakes : sequence of (int or None, str, str)
        Line, place and problem of each.

    Attributes
    ----------
    place, problem : str
        Of the first one.
    file, mistakes
        As above.
    """

    def __init__(self, file: str, mistakes: Sequence[tuple[int | None, str, str]]) -> None:
        _, place, problem = mistakes[0]
        super().__init__(place, problem)
        self.file, self.mistakes = file, tuple(mistakes)
        lines = []
        for line, place, problem in mistakes:
            where = file if line is None else f"{file}:{line}"
            lines.append(visible(f"{where}: {f'{place}: ' if place else ''}{problem}"))
        self.args = ("\n".join(lines),)

    def __reduce__(self) -> tuple:
        """Pickle by what it was made of."""
        return type(self), (self.file, self.mistakes)


class UnsolvedError(GapbeamError):
    """A result that is not solved, raised by its ``raise_for_status``.

    Parameters
    ----------
    status : str
        Of the result.
    reason : str or None
        Why.

    Attributes
    ----------
    status, reason
        As above.
    """

    def __init__(self, status: str, reason: str | None) -> None:
        super().__init__(reason or status)
        self.status, self.reason = status, reason

    def __reduce__(self) -> tuple:
        """Pickle as made."""
        return type(self), (self.status, self.reason)


class NoStepError(UnsolvedError, IndexError):
    """A load step of a result was asked for, and none stands; ``status`` and ``reason`` are those of the result."""

    def __str__(self) -> str:
        """Say that there is none, and why."""
        return f"no load step stands; {self.reason}"


class Status(IntEnum):
    """Status codes, the same as in Fortran, C and Fortran 77; above 10 they are errors."""

    SOLVED = 0
    NO_EQUILIBRIUM = 1
    BUCKLES = 2
    BAD_INPUT = 11
    INDETERMINATE = 12
    NOT_CONVERGED = 13
    NOT_FINITE = 14
    NO_MEMORY = 15
    NOT_PREPARED = 16
    OTHER_VERSION = 17
    STOPPED = 18

    @property
    def word(self) -> str:
        """How a result says it: ``solved``, ``no-equilibrium``, ``indeterminate``."""
        return self.name.lower().replace("_", "-")


FALLEN = (Status.NO_EQUILIBRIUM, Status.BUCKLES)
"""Outcomes of a beam that does not stand."""
WITHOUT_ANSWER = (Status.INDETERMINATE, Status.NOT_CONVERGED, Status.NOT_FINITE)
"""Errors that are about one load on a beam: other loads on it may have an answer."""
ENDED = (Status.NO_MEMORY, Status.STOPPED)
"""Errors that are about a whole call, however many loads it is for."""


class EngineError(GapbeamError, RuntimeError):
    """The engine could not treat a valid scene.

    Parameters
    ----------
    message : str
        Why, and what to do about it.
    status : int
        Code of the engine.

    Attributes
    ----------
    status : Status
        As above.
    """

    def __init__(self, message: str, status: int = Status.NOT_CONVERGED) -> None:
        super().__init__(message)
        self.status = Status(status)

    def __reduce__(self) -> tuple:
        """Pickle with the status."""
        return type(self), (str(self), int(self.status))


def check_ended(status: Container[int]) -> None:
    """Raise what has ended a call for many loads.

    Parameters
    ----------
    status : numpy.ndarray of int
        From the engine, of every load.

    Raises
    ------
    MemoryError, EngineError
        As for `check_status`.
    """
    for one in ENDED:
        if one in status:
            check_status(one)


def check_status(status: int, message: bytes = b"", where: str = "") -> None:
    """Raise what a status of the engine says, unless it is an outcome.

    Parameters
    ----------
    status : int
        From the engine.
    message : bytes
        Its words for an error; supports count from 1 in them, as in Fortran.
    where : str
        What they are about, to be put before them.

    Raises
    ------
    MemoryError
        The system gives the engine no more memory.
    EngineError
        Any other error.
    """
    if status == Status.NO_MEMORY:
        raise MemoryError(
            f"{where}the system gives the engine no more memory: end other programs, raise the limit of this one "
            "(ulimit -v), or take fewer spans and supports"
        )
    if status == Status.STOPPED:
        raise EngineError(f"{where}the call was ended before it was done: a signal has ended another call with this beam", status)
    if status not in (Status.SOLVED, *FALLEN):
        words = message.decode().strip()
        for named, key in (("support", "supports"), ("foundation", "foundation")):
            words = re.sub(rf"{named} (\d+) of \d+", lambda found, key=key: f"{key}[{int(found[1]) - 1}]", words)
        raise EngineError(where + re.sub(r"\]: (law|stiffness|unloading)\b", r"].\1", words), status)
