"""Workers that solve chunks: threads, processes, or whatever has the interface of `concurrent.futures.Executor`."""

from __future__ import annotations

import os
import pickle
import signal
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    CancelledError,
    Executor,
    Future,
    ThreadPoolExecutor,
    wait,
)
from contextlib import contextmanager
from functools import partial

from ..base.errors import GapbeamError
from .chunks import encode
from .job import Job
from .tables import Rows

LOOK = 0.2
"""Seconds between two looks whether something is done."""
_MADE = threading.local()
"""Of each thread the job that it last worked at."""


class LostWorkerError(GapbeamError):
    """A process that solved cases is gone.

    Attributes
    ----------
    is_failure : bool
        It is no fault of what was asked.
    """

    is_failure = True


def work(key: str, packed: bytes, rows: Rows, first: int, kind: str, stop: threading.Event | None = None) -> bytes:
    """Solve a chunk, in whatever process.

    Parameters
    ----------
    key : str
        Tells jobs apart.
    packed : bytes
        The job, pickled once for all chunks.
    rows : Rows
        Of the table.
    first : int
        Number of the first case.
    kind : {"parquet", "npy"}
        Format of the file.
    stop : threading.Event, optional
        As for `Job.solve`.

    Returns
    -------
    bytes
        Contents of the file.
    """
    if getattr(_MADE, "key", None) != key:
        _MADE.key, _MADE.job = key, pickle.loads(packed)
    job: Job = _MADE.job
    return encode(job.solve(rows, first, stop), kind)


def cores() -> int:
    """Count the cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@contextmanager
def threads(jobs: int) -> Iterator[tuple[Executor, Callable]]:
    """Offer threads of this process, which end soon when the batch is interrupted.

    Parameters
    ----------
    jobs : int
        How many.

    Yields
    ------
    executor : Executor
        The threads.
    work : callable
        What they are to be given.
    """
    stop = threading.Event()
    executor = ThreadPoolExecutor(jobs, "gapbeam-batch")
    try:
        yield executor, partial(work, stop=stop)
    finally:
        stop.set()
        executor.shutdown(wait=False, cancel_futures=True)


@contextmanager
def processes(jobs: int) -> Iterator[Executor]:
    """Offer processes of this machine; they end with the process that made them, whatever ends it.

    Parameters
    ----------
    jobs : int
        How many.
    """
    from concurrent.futures import ProcessPoolExecutor
    from multiprocessing import get_context

    before = os.environ.get("PYTHONWARNINGS")
    # Python's own helper would complain on the terminal of semaphores that Ctrl-C leaves, and remove them
    os.environ["PYTHONWARNINGS"] = ",".join(filter(None, (before, "ignore:resource_tracker:UserWarning")))
    try:
        executor = ProcessPoolExecutor(jobs, get_context("spawn"), _begin_process)
    finally:
        if before is None:
            del os.environ["PYTHONWARNINGS"]
        else:
            os.environ["PYTHONWARNINGS"] = before
    try:
        with _held_back(signal.SIGINT):
            executor.submit(os.getpid)  # the first task starts all processes
        yield executor
    finally:
        executor.shutdown(wait=False, cancel_futures=True)


@contextmanager
def _held_back(number: int) -> Iterator[None]:
    """Hold a signal back, in processes that are started meanwhile until they see to it themselves."""
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {number})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _begin_process() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C goes to all; the first process sees to it
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    from multiprocessing import parent_process

    parent_process().join()
    os._exit(1)


@contextmanager
def _telling_of_lost_workers() -> Iterator[None]:
    try:
        yield
    except Exception as error:
        if not isinstance(error, BrokenExecutor | CancelledError) and type(error).__module__.partition(".")[0] != "distributed":
            raise
        raise LostWorkerError(
            f"a worker is gone ({type(error).__name__}): it was ended, or there was not enough memory; start the same batch again, "
            "and it continues, with fewer jobs if memory was short"
        ) from None


def in_turn(
    executor: Executor, tasks: Iterator[tuple[int, Callable[[], tuple]]], call: Callable, most: int
) -> Iterator[tuple[int, bytes]]:
    """Give an executor so many tasks at a time that memory holds them, and what is done as soon as it is.

    Parameters
    ----------
    executor : Executor
        Where they are done.
    tasks : iterator of (int, callable)
        A number, and what makes the arguments when they are needed.
    call : callable
        What is called there.
    most : int
        Tasks at a time.

    Yields
    ------
    number : int
        Of the task.
    data : bytes
        What came of it.

    Raises
    ------
    LostWorkerError
        A worker is gone.
    """
    running: dict[Future, int] = {}
    try:
        while True:
            while len(running) < most and (task := next(tasks, None)) is not None:
                arguments = task[1]()
                with _telling_of_lost_workers():
                    running[executor.submit(call, *arguments)] = task[0]
            if not running:
                return
            for ready in wait(running, LOOK, FIRST_COMPLETED).done:
                with _telling_of_lost_workers():
                    data = ready.result()
                yield running.pop(ready), data
    finally:
        for one in running:
            one.cancel()
