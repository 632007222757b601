"""What many cases of one beam would take if this machine only moved their arrays, or only did their arithmetic."""

from __future__ import annotations

from functools import cache
from time import perf_counter

from gapbeam import _yardsticks
from gapbeam.engine.calls import interruptible

from .batch_cases import Batch
from .kernel import stream_bandwidth

MEMORY, ARITHMETIC = "limit, memory", "limit, arithmetic"
"""Names of the limits in the table."""
NODE, SPAN_MORE = 66, 16
"""Operations a node of the elimination in `batch_programs.loop`, both ways, and a span for moments and reactions."""


def limits(batch: Batch) -> dict[str, float]:
    """Find the least time a case, by either.

    Parameters
    ----------
    batch : Batch
        The cases.

    Returns
    -------
    dict of float
        Seconds: to read loads (gaps and settlements where they vary) and write deflections, moments, reactions and states once; and
        to do the operations of one contact state, though most cases need several, without refinement.
    """
    spans = batch.q.shape[1]
    numbers = spans + 3 * (spans + 1) + (0 if batch.factors else 2 * (spans + 1))
    operations = NODE * (spans - 1) + SPAN_MORE * spans
    return {MEMORY: (8 * numbers + spans + 1) / bandwidth(), ARITHMETIC: operations / peak()}


@cache
def bandwidth() -> float:
    """Measure the bandwidth of the memory.

    Returns
    -------
    float
        Bytes a second.
    """
    return stream_bandwidth()


@cache
def peak(turns: int = 2_000_000) -> float:
    """Measure how many multiplications and additions a core does at most.

    Parameters
    ----------
    turns : int
        How long that is tried.

    Returns
    -------
    float
        Operations a second, the most of several tries.
    """
    work = interruptible(_yardsticks.yspeak)
    found = 0.0
    for _ in range(9):
        begin = perf_counter()
        operations, _ = work(turns)
        found = max(found, operations / (perf_counter() - begin))
    return found
