"""Calls of compiled code that Ctrl-C ends at once.

Python hears signals between its own instructions only, and a call of compiled code is one instruction, however long. So the
engine lets Python hear them between linear solves (face/python_signals.c), which is enough where these are short. What is long
by itself is called in a thread beside the main one, which waits where signals are heard; Ctrl-C then ends the work there between
two linear solves too. A thread whose solve is longer than that is left behind: it goes on to the end of it, with arrays that
nobody else has, and is not heard of again; only the next call with the same beam waits for it.
"""

from __future__ import annotations

import mmap
import os
import threading
from _thread import allocate_lock, start_new_thread
from collections.abc import Callable, Iterator
from functools import partial
from queue import SimpleQueue
from time import perf_counter
from typing import Any

import numpy as np

from .. import _engine

SHORT = 700
"""Calls for fewer nodes, or places, take some milliseconds at most."""
FEW_NODES = 1_000
"""Cases with fewer nodes together take some milliseconds at most."""
FEW_CASES = 50
"""So many cases, each solved once more, take some milliseconds."""
NODES_AT_A_TIME = 20_000
"""Nodes of all cases in the first call for many cases; later calls take about `SECONDS`, by what the one before took."""
SECONDS = 0.1
"""Time of a call for some of many cases, and between two looks whether a signal has come."""
PATIENCE = 0.3
"""Seconds that the end of an interrupted call is waited for."""
THREAD = 2**25
"""Bytes that must be there for a thread, mostly its stack: Python does not survive one that cannot begin."""
PART = 200_000
"""Numbers that Python turns into objects or text in some tenths of a second."""


class _Over:
    """Whether a call is over. A lock wakes who waits; Ctrl-C may come when the lock is there already, so it is not what tells."""

    def __init__(self) -> None:
        self.lock = allocate_lock()
        self.lock.acquire()
        self.is_so = False

    def tell(self) -> None:
        self.is_so = True
        self.lock.release()

    def wait(self, seconds: float) -> bool:
        """Wait so long; tell whether it is over."""
        return self.is_so or self.lock.acquire(timeout=seconds) or self.is_so


class _Call:
    """One call: what is called, and what came of it."""

    def __init__(self, routine: Callable, arguments: tuple) -> None:
        self.routine, self.arguments = routine, arguments
        self.result: Any = None
        self.error: BaseException | None = None
        self.over = _Over()
        self.is_left = False

    def make(self) -> None:
        try:
            self.result = self.routine(*self.arguments)
        except BaseException as error:
            self.error = error
        if self.is_left:
            go_on(self.arguments)
        self.over.tell()

    def end(self) -> bool:
        """Let it end where it looks whether it may go on, and wait for that a little; tell whether it has."""
        if not _has_beam(self.arguments):
            return False
        beam = self.arguments[0]
        beam.left = os.getpid(), self.over
        self.is_left = True
        _engine.gbstop(beam, 1)
        ended = self.over.wait(PATIENCE)
        if ended:
            beam.left = None
            go_on(self.arguments)
        return ended


class _Beside:
    """The thread beside the main one; only the main one gives it calls."""

    def __init__(self) -> None:
        self.calls: SimpleQueue[_Call | None] | None = None

    def reset(self) -> None:
        """In a forked process: the thread stayed with the parent."""
        self.calls = None

    def forget(self) -> None:
        """Let the thread end with the call it has; the next call gets a new one."""
        calls, self.calls = self.calls, None
        if calls is not None:
            calls.put(None)

    def make(self, routine: Callable, arguments: tuple) -> Any:
        """Make a call there, and wait for it as long as no signal says otherwise."""
        try:
            if self.calls is None:
                mmap.mmap(-1, THREAD).close()
                calls: SimpleQueue[_Call | None] = SimpleQueue()
                start_new_thread(_work, (calls,))
                self.calls = calls
        except (RuntimeError, OSError, MemoryError):  # no more threads here
            return routine(*arguments)
        call = _Call(routine, arguments)
        try:
            self.calls.put(call)
            while not call.over.wait(SECONDS):
                pass  # signals that went to another thread are heard now
        except BaseException:
            ended = False
            try:
                ended = call.end()
            finally:  # however often Ctrl-C comes
                if not ended:
                    self.forget()
            raise
        if call.error is not None:
            raise call.error
        return call.result


def _work(calls: SimpleQueue[_Call | None]) -> None:
    while (call := calls.get()) is not None:
        call.make()
        del call  # and with it the arrays, before the next one comes


def go_on(arguments: tuple) -> None:
    """Let calls with a beam go on that a signal has ended.

    Parameters
    ----------
    arguments : tuple
        Of the call that was ended; the beam is the first, if it has one.
    """
    if _has_beam(arguments):
        _engine.gbstop(arguments[0], 0)


def _has_beam(arguments: tuple) -> bool:
    return bool(arguments) and isinstance(arguments[0], Handle)


def _wait_for_what_is_left(arguments: tuple) -> None:
    """Wait, where signals are heard, for a call with the same beam that is left behind: the next one would be ended with it."""
    if not _has_beam(arguments) or arguments[0].left is None:
        return
    process, over = arguments[0].left
    if process == os.getpid():  # in a forked process there is no thread that goes on
        while not over.wait(SECONDS):
            pass
    arguments[0].left = None
    go_on(arguments)


_BESIDE = _Beside()
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_BESIDE.reset)


def interruptible(routine: Callable, size: Callable[..., int] = lambda *_: SHORT) -> Callable:
    """Let Ctrl-C end the calls of a compiled routine at once.

    Parameters
    ----------
    routine : callable
        It must let go of Python's lock, and its arrays must not be used after an interrupted call.
    size : callable
        Tells from the arguments how many nodes or places a call is for, where its linear solves are short if these are few;
        default: any call may take long between them.

    Returns
    -------
    callable
        Takes and returns what the routine does; KeyboardInterrupt, or what another handler of a signal raises, ends it.
    """

    def call(*arguments: Any) -> Any:
        _wait_for_what_is_left(arguments)
        if size(*arguments) < SHORT or threading.current_thread() is not threading.main_thread():
            try:
                return routine(*arguments)
            except BaseException:
                go_on(arguments)
                raise
        return _BESIDE.make(routine, arguments)

    return call


class Owned(int):
    """A number by which the compiled layer knows an object: a beam, room for its cases, a state, its fields, a path, a train.

    The object is freed with the last reference to the number; calls that go on after Ctrl-C keep theirs. Nothing of it is written
    in Python, which hears signals between its own instructions: a Ctrl-C inside `__del__` would be printed and lost. The property
    binds the number to the routine, and Python calls what it gets.
    """

    __del__ = property(partial(partial, _engine.gbdrop))


class Handle(Owned):
    """A beam.

    Attributes
    ----------
    has_curves : bool
        Whether there is ground under it whose law is a curve: then even a few nodes may take long between two linear solves.
    left : tuple, optional
        Of a call with it that a signal has ended and that goes on to its next look: its process, and whether that is over.
    """

    has_curves = False
    left: tuple[int, _Over] | None = None


def parts(count: int) -> Iterator[slice]:
    """Cut a long sequence into parts, for what numpy and json do in one instruction.

    Parameters
    ----------
    count : int
        Its length.

    Yields
    ------
    slice
        From the first to the last.

    Examples
    --------
    >>> [(part.start, part.stop) for part in parts(500_000)]
    [(0, 200000), (200000, 400000), (400000, 500000)]
    """
    for first in range(0, count, PART):
        yield slice(first, min(first + PART, count))


def short_parts(count: int, nodes: int, most: int | None = None) -> Iterator[slice]:
    """Cut many cases into parts, so that what is done with each takes about `SECONDS`, by what the one before took.

    Parameters
    ----------
    count, nodes : int
        Cases, and nodes of each.
    most : int, optional
        Cases of a part at most.
    """
    most = count if most is None else most
    some, first = min(max(NODES_AT_A_TIME // nodes, 1), most), 0
    while first < count:
        part, begin = slice(first, min(first + some, count)), perf_counter()
        yield part
        some = min(max(int(some * min(max(SECONDS / (perf_counter() - begin), 0.25), 4.0)), 1), most)
        first = part.stop


def _on_ground(beam: Handle, stretches: int) -> int:
    """Count the stretches of a solution on the ground, as far as they are short work."""
    return SHORT if beam.has_curves else stretches


def _solve(beam: Handle, links: int, *about: Any) -> tuple:
    """Solve one state, which is freed even where nobody waits for it any more."""
    *found, state, status, message = _engine.gbsolv(beam, *about)
    return *found, Owned(state), status, message


def _follow(beam: Handle, *about: Any) -> tuple:
    sizes, path, status, message = _engine.gbhist(beam, *about)
    return sizes, Owned(path), status, message


def _recover(beam: Handle, pieces: int, state: Owned) -> tuple:
    fields, status, message = _engine.gbreco(beam, state)
    return Owned(fields), status, message


gbsize = _engine.gbsize
gbroom = _engine.gbroom
gbone = _engine.gbone
gbnumb = _engine.gbnumb
gbhget = _engine.gbhget
gbhsch = _engine.gbhsch
gbhaxi = _engine.gbhaxi
gbalng = _engine.gbalng
gbhend = _engine.gbhend
gbhten = _engine.gbhten
gbsget = _engine.gbsget
gblawv = _engine.gblawv
gbtole = _engine.gbtole
gblawp = _engine.gblawp
gbgget = _engine.gbgget
gbgpte = _engine.gbgpte
gbmake = interruptible(
    lambda *arrays: _engine.gbmake(*arrays, threading.main_thread().ident),
    lambda span, hinge, section, codes, support, *rest: span.shape[1] + support.shape[1] + rest[-5].shape[1],  # of profiles
)
gbcopy = interruptible(_engine.gbcopy)
gbplac = interruptible(_engine.gbplac, lambda beam, pieces, *_: pieces)
gbsolv = interruptible(_solve, lambda beam, links, *_: SHORT if beam.has_curves else links)
gbpath = interruptible(_engine.gbpath)
gbhist = interruptible(_follow)
gbhlin = interruptible(lambda beam, links, *about: _engine.gbhlin(beam, *about), lambda beam, links, *_: links)
gbheng = interruptible(_engine.gbheng)
gbgpth = interruptible(_engine.gbgpth)
gbmode = interruptible(_engine.gbmode)
gbshap = interruptible(_engine.gbshap)
gbbuck = _engine.gbbuck
gblaws = interruptible(lambda beam, laws, _: _engine.gblaws(beam, laws), lambda beam, laws, pieces: pieces + laws.shape[1])
gbreco = interruptible(_recover, lambda beam, pieces, *_: pieces)
gbcert = interruptible(lambda beam, nodes, *about: _engine.gbcert(beam, *about), lambda beam, nodes, *_: 3 * nodes)
gbfind = interruptible(_engine.gbfind, lambda beam, x, *_: len(x))
gbvalu = interruptible(
    lambda beam, stretches, *about: _engine.gbvalu(beam, *about),
    lambda beam, stretches, state, fields, count, piece, distance: len(piece) + (stretches and _on_ground(beam, stretches)),
)
gbextr = interruptible(
    lambda beam, pieces, stretches, *about: _engine.gbextr(beam, *about),
    lambda beam, pieces, stretches, *_: _on_ground(beam, stretches) if stretches else pieces,
)
gblarg = interruptible(lambda beam, pieces, *about: _engine.gblarg(beam, *about), lambda beam, pieces, *_: pieces)
gbslop = _engine.gbslop
gbyiel = _engine.gbyiel
gbleas = _engine.gbleas
gbpart = _engine.gbpart
gbgrun = interruptible(_engine.gbgrun, lambda beam, state, stretches, layers: _on_ground(beam, stretches))
gbcomb = interruptible(_engine.gbcomb)
gbcext = interruptible(_engine.gbcext, lambda beam, factors, *_: SHORT * (factors.shape[1] > FEW_CASES))
gbccrt = interruptible(_engine.gbccrt)
gbshar = interruptible(lambda beam, _: _engine.gbshar(beam), lambda beam, count: count)
gbtmak = interruptible(_engine.gbtmak)
gbtget = _engine.gbtget
gbtenv = interruptible(_engine.gbtenv)
gbtcur = interruptible(_engine.gbtcur)
gbtinf = interruptible(_engine.gbtinf)
gbtprt = interruptible(_engine.gbtprt)
gbrmak = interruptible(_engine.gbrmak)
gbrget = _engine.gbrget
gbrext = interruptible(_engine.gbrext)
gbrcur = interruptible(_engine.gbrcur)
gbrway = interruptible(_engine.gbrway)
_short_cases = interruptible(_engine.gbcase, lambda *_: 0)
_long_cases = interruptible(_engine.gbcase)


def gbcase(
    beam: Handle, room: Owned, factors: np.ndarray, supports: np.ndarray, spans: np.ndarray, rule: int, *results: np.ndarray
) -> None:
    """Solve load cases, so many at a time that each call is a short one.

    Parameters
    ----------
    beam, room, factors, supports, spans, rule, *results
        As for GBCASE, cases along the last axes; results, from the schemes on, are changed in place.
    """
    cases, nodes = factors.shape[1], max(values.shape[0] for values in results[:5])
    if cases * nodes < FEW_NODES:
        _short_cases(beam, room, factors, supports, spans, rule, *results)
        return
    for part in short_parts(cases, nodes):
        given = factors[:, part], *(one if one.shape[1] == 1 else one[..., part] for one in (supports, spans))
        _long_cases(beam, room, *given, rule, *(values[..., part] for values in results))
