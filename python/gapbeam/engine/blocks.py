"""Memory for the results of many cases, which stays with their beam from call to call.

New memory costs a quarter of the time of a call, as the system clears it page by page.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from functools import partial
from operator import attrgetter

import numpy as np

MOST_SPARE = 2**26
"""Bytes that are kept at most."""


class Block:
    """What arrays are views of; with the last of them it goes back to those that are kept.

    Parameters
    ----------
    memory : numpy.ndarray
        The memory itself, of doubles.
    spare : collections.deque
        Where memory is kept that nobody uses, one piece at most.
    """

    __slots__ = ("__array_interface__", "_leave", "_memory")

    def __init__(self, memory: np.ndarray, spare: deque[np.ndarray]) -> None:
        self._memory = memory
        self._leave = partial(spare.append, memory) if memory.nbytes <= MOST_SPARE else int
        self.__array_interface__ = memory.__array_interface__

    __del__ = property(attrgetter("_leave"))
    """Keeps the memory for the next call; by then nothing refers to it. Not in Python, as in `gapbeam.engine.calls.Owned`."""

    def arrays(self, shapes: Sequence[tuple[tuple[int, ...], type]]) -> list[np.ndarray]:
        """Cut it into arrays, always the same ones.

        Parameters
        ----------
        shapes : sequence of tuple
            Shapes with types, those of doubles first.
        """
        values, at, made = np.asarray(self).view(np.uint8), 0, []
        for shape, kind in shapes:
            end = at + int(np.prod(shape)) * np.dtype(kind).itemsize
            made.append(values[at:end].view(kind).reshape(shape))
            at = end
        return made


def new_block(spare: deque[np.ndarray], size: int) -> Block:
    """Take memory that is kept, or new one.

    Parameters
    ----------
    spare : collections.deque
        Where memory is kept that nobody uses.
    size : int
        Bytes.
    """
    count = size // 8 + 1
    try:
        memory = spare.pop()
    except IndexError:
        memory = None
    if memory is None or not count <= memory.size <= 4 * count:
        memory = None  # given back before there is more
        memory = np.empty(count)
    return Block(memory, spare)


def block_of(values: np.ndarray) -> Block:
    """Find the block that an array is a view of.

    Parameters
    ----------
    values : numpy.ndarray
        From `Block.arrays`.
    """
    base = values
    while isinstance(base, np.ndarray):
        base = base.base
    return base
