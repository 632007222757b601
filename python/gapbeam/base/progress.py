"""Progress of what takes longer than a second: one line on a terminal, which is gone at the end."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from threading import Event, Thread
from time import perf_counter

AFTER = 1.0
"""Seconds until it is shown."""
EVERY = 0.25
"""Seconds between two looks."""
CLEAR = "\r\x1b[K"
"""Takes a line of a terminal away."""


def line(words: str, seconds: float, done: int = 0, total: int = 0, before: int = 0) -> str:
    """Word how far something is.

    Parameters
    ----------
    words : str
        What is at work, or what is counted where `total` is known.
    seconds : float
        Since it began.
    done, total : int
        How many are done, of how many; 0 where nothing is counted.
    before : int
        How many of them were done when it began.

    Examples
    --------
    >>> line("solving", 2.3)
    'solving, 2 s'
    >>> line("cases", 2.0, 3000, 9000, 1000)
    '3,000 of 9,000 cases, 1,000 a second, 6 s left'
    """
    if not total:
        return f"{words}, {seconds:.0f} s"
    rate = (done - before) / seconds if seconds > 0.0 else 0.0
    left = f", {rate:,.0f} a second, {(total - done) / rate:,.0f} s left" if rate > 0.0 else f", {seconds:.0f} s"
    return f"{done:,} of {total:,} {words}{left}"


@contextmanager
def shown_progress(words: str, wanted: bool = True) -> Iterator[Callable[[int, int], None] | None]:
    """Show progress on standard error while something is at work there, if that is a terminal.

    Parameters
    ----------
    words : str
        As of `line`.
    wanted : bool
        Whether it is shown at all.

    Yields
    ------
    callable or None
        Takes how many are done, and of how many; None where nothing is shown.
    """
    stream = sys.stderr
    if not wanted or stream is None or not stream.isatty():
        yield None
        return
    begin, counts, end = perf_counter(), [], Event()

    def progress(done: int, total: int) -> None:
        counts[:] = (done, total, counts[2] if counts else done)

    def show() -> None:
        pause = AFTER
        while not end.wait(pause):
            stream.write(f"{CLEAR}{line(words, perf_counter() - begin, *counts)}")
            stream.flush()
            pause = EVERY

    thread = Thread(target=show, daemon=True)
    with suppress(RuntimeError):  # no memory for a thread
        thread.start()
    try:
        yield progress
    finally:
        end.set()
        if thread.ident is not None:
            thread.join()
            if perf_counter() - begin > AFTER:
                stream.write(CLEAR)
                stream.flush()
