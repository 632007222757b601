"""Time and memory traffic a node of one linear beam: the engine's kernel beside assembly and LAPACK's dgbsv."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from math import nan
from time import perf_counter

import numpy as np
from gapbeam import _yardsticks
from gapbeam.engine.calls import interruptible
from gapbeam.studies.meshes import SEED, MeshedBeam, one_span
from gapbeam.studies.methods import Method, kernel, yardstick

from .page import Page

COLUMNS = ("beam", "method", "nodes", "ns a node", "faster", "state", "GB/s", "of stream", "difference")
"""Headings of the table."""
WORDS = (
    "One beam, every mesh point a node: assembly, factor and solve of the nodal mixed system. All methods are compiled,",
    "and go from plain arrays to deflections and moments. Memory is allocated before.",
    "",
    "* One span: a simple beam, finely meshed.",
    "* Random: lengths, EI and loads at random, a tenth of the nodes on rigid supports and a tenth on springs.",
    "* ending + 1: with a step of refinement, which goes through everything a second time.",
    "",
    "Columns:",
    "",
    "* ns a node: the fastest of several counts. faster: than assembly and LAPACK's dgbsv, run in turn with it.",
    "* state: bytes a node that the method stores, beside what it is given (5 numbers a node) and gives (2).",
    "* GB/s: all that, the state once each way, over the time. of stream: over the bandwidth of a triad a = b + s c on",
    "  this machine.",
    "* difference: of deflections and moments from those of dgbsv with two steps of refinement, relative to the largest.",
)
"""What the table shows."""
SIZES = (10, 100, 1000, 10**4, 10**5, 10**6)
"""Elements."""
GIVEN, ANSWER = 40, 16
"""Bytes a node of length, EI, load, stiffness and force; of deflection and moment."""
WORK, LEAST = 200_000, 10
"""Elements solved in one timing, and solves, at least."""
SLOW = 0.5
"""Timings that take longer are taken three times only."""
ROUNDS = 7
"""Timings of each method, in turn."""


@dataclass
class Row:
    """What one method needs for one beam.

    Attributes
    ----------
    beam : str
        one span or random.
    method : str
        Its name.
    nodes : int
        Elements of the beam; there is one node more.
    nanoseconds : float
        A node, the fastest.
    faster : float
        How many times faster than dgbsv.
    state : int
        Bytes a node kept.
    bandwidth : float
        Bytes a second moved.
    stream : float
        The same over the bandwidth of a triad.
    difference : float
        From the refined solution.
    """

    beam: str
    method: str
    nodes: int
    nanoseconds: float
    faster: float
    state: int
    bandwidth: float
    stream: float
    difference: float


def random_beam(elements: int) -> MeshedBeam:
    """Make a beam with random lengths, EI, loads and supports.

    Parameters
    ----------
    elements : int
        A tenth of the nodes rest on rigid supports, a tenth on springs.
    """
    random = np.random.default_rng(SEED)
    pick = random.random(elements + 1)
    springs = 10.0 ** random.uniform(-2.0, 4.0, elements + 1)
    stiffness = np.where(pick < 0.1, np.inf, np.where(pick < 0.2, springs, 0.0))
    stiffness[[0, -1]] = np.inf
    return MeshedBeam(
        "random",
        random.uniform(0.5, 2.0, elements),
        10.0 ** random.uniform(-1.0, 1.0, elements),
        random.uniform(-1.0, 2.0, elements),
        stiffness,
        force=random.uniform(-1.0, 1.0, elements + 1),
    )


def stream_bandwidth(elements: int = 10**7) -> float:
    """Measure the bandwidth of the memory by a triad.

    Parameters
    ----------
    elements : int
        Of each of its three arrays; they must not fit into the caches.

    Returns
    -------
    float
        Bytes a second, 24 an element counted.
    """
    triad = interruptible(_yardsticks.ystria)

    def fastest(repeat: int) -> float:
        found = np.inf
        for _ in range(5):
            begin = perf_counter()
            triad(elements, repeat)
            found = min(found, perf_counter() - begin)
        return found

    fastest(1)
    return 24 * elements * 10 / (fastest(12) - fastest(2))


def kernels(largest: int = 10**6) -> Iterator[Row]:
    """Time all methods.

    Parameters
    ----------
    largest : int
        Longer beams are left out.

    Yields
    ------
    Row
        One for every beam and method.
    """
    chain, band, fused = _yardsticks.ysbyte().tolist()
    plans = [(yardstick("dgbsv", 1, reactions=False), band, band)]
    plans += [(yardstick("nodal mixed", 0, reactions=False), chain, chain)]
    # The refined solve reads its solution, the corrections come and go, and both are read to be added
    plans += [(kernel(), fused, fused), (kernel(1), fused + ANSWER, 2 * fused + GIVEN // 2 + 5 * ANSWER // 2)]
    sizes = [elements for elements in SIZES if elements <= largest]
    stream = max(stream_bandwidth() for _ in range(3)) if sizes else nan  # others may use the memory meanwhile
    for make in (one_span, random_beam):
        for elements in sizes:
            yield from _side_by_side(make(elements), plans, stream)


def _side_by_side(beam: MeshedBeam, plans: list[tuple[Method, int, int]], stream: float) -> Iterator[Row]:
    refined = yardstick("", 1, 2, precise=True).run(beam, 1)
    nodes = beam.elements
    repeat = max(LEAST, WORK // nodes)
    one, many = np.full(len(plans), np.inf), np.full(len(plans), np.inf)
    for turn in range(ROUNDS):
        for k, (method, *_) in enumerate(plans):
            if turn > 2 and many[k] > SLOW:
                continue
            one[k] = min(one[k], _timed(method, beam, 1))
            many[k] = min(many[k], _timed(method, beam, repeat + 1))
    fastest = (many - one) / repeat
    for (method, state, traffic), seconds in zip(plans, fastest, strict=True):
        answer = method.run(beam, 1)
        difference = max(
            np.abs(a - b).max() / np.abs(b).max()
            for a, b in ((answer.deflection, refined.deflection), (answer.moment, refined.moment))
        )
        rate = (GIVEN + ANSWER + 2 * traffic) * nodes / seconds
        yield Row(
            beam.name, method.name, nodes, 1e9 * seconds / nodes, fastest[0] / seconds, state, rate, rate / stream, difference
        )


def _timed(method: Method, beam: MeshedBeam, repeat: int) -> float:
    begin = perf_counter()
    method.run(beam, repeat)
    return perf_counter() - begin


def table(rows: Iterable[Row]) -> list[list[str]]:
    """Write the rows as text.

    Parameters
    ----------
    rows : iterable of Row
        From `kernels`.

    Returns
    -------
    list of list of str
        As many columns as `COLUMNS`.
    """
    return [
        [
            row.beam,
            row.method,
            f"{row.nodes:,}",
            f"{row.nanoseconds:.1f}",
            f"{row.faster:.2f}",
            str(row.state),
            f"{row.bandwidth / 1e9:.1f}",
            f"{row.stream:.0%}",
            f"{row.difference:.0e}",
        ]
        for row in rows
    ]


PAGE = Page("kernel", "The linear solver (kernel)", WORDS, COLUMNS, texts=2)
"""How the table is written and printed."""
