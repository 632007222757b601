"""Many cases of one beam: gapbeam's prepared scene beside numpy over cases, loops in scipy, numba, JAX, and what a machine can."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from math import inf, isnan, nan
from time import perf_counter

import numpy as np
from gapbeam.results import formatting as fmt
from gapbeam.studies.meshes import mesh
from gapbeam.studies.truth import Truth, solve_exactly

from .active_set import NoScheme
from .batch_cases import SIZES, Batch, Found, make
from .batch_limits import ARITHMETIC, MEMORY, bandwidth, limits, peak
from .batch_programs import OWN, PROGRAMS, first_call, given, installed
from .page import Page
from .programs import number_printed

COLUMNS = (
    "problem", "program", "cases", "first call", "time a case", "cases a second", "gapbeam is faster", "deflection", "moment",
    "reaction", "states",
)  # fmt: skip
"""Headings of the table."""
WORDS = (
    "Beams of equal spans, held both ways at their ends. Between them are elastic compression-only supports with gaps.",
    "",
    "* 3 to 1,000 spans: every case has another random load on every span (work A of reference problem P6).",
    "* Random gaps: 12 supports, with another gap and settlement of each in every case.",
    "",
    "All programs go from Python's arrays to arrays of deflection, moment, reaction and state of every support, on one",
    "core.",
    "",
    "* gapbeam: `gapbeam.prepare(scene).solve`, refined as always. The others refine nothing, and switch all wrong",
    "  supports of a case until it is settled.",
    "* numpy, all cases: elimination node by node, for 2,000 cases at once.",
    "* numpy, matrices: cases sorted by contact state, where there are few enough. Each contact state has a matrix from",
    "  loads and levels to all results. Products may use further cores.",
    "* scipy, loop: banded Cholesky, case by case.",
    "* numba, loop, if installed: the same elimination in scalars, compiled.",
    "* jax, all cases: the same, compiled and mapped over the cases (jit, vmap). Settled cases wait for the others.",
    "* limit, memory: the arrays of a case, read and written once, at the bandwidth of a triad.",
    "* limit, arithmetic: the operations of one contact state, unrefined, as fast as a core multiplies and adds. Most",
    "  cases need several contact states.",
    "",
    "Columns:",
    "",
    "* first call: in a process of its own once numpy is imported, the least of three. It includes import, preparation,",
    "  compilation and all cases.",
    "* time a case: the least of several rounds in which all take their turn, over the cases.",
    "* gapbeam is faster: how many times, without the first call.",
    "* deflection, moment, reaction: the worst error of 20 cases against decimals of 80 digits, relative to the largest",
    "  value of the case.",
    "* states: cases, of all, in which a support is in another state than gapbeam finds.",
)
"""What the table shows."""
EXACT = 20
"""Cases that are solved in decimals."""
ROUNDS, PROCESSES = 15, 3
"""Rounds in which all are run in turn, and processes in which every program is started."""
LONGEST = 12.0
"""Seconds after which no further round is begun, but for the first three."""


@dataclass
class Row:
    """What one program did with one problem.

    Attributes
    ----------
    problem, program : str
        Their names.
    cases : int
        How many; 0 where the program is not there or does not take the problem.
    cold, seconds, rate, ratio : float
        Seconds of the first call and a case, cases a second, and time beside that of gapbeam.
    deflection, moment, reaction : float
        Errors.
    states : int
        Cases that differ from those of gapbeam.
    """

    problem: str
    program: str
    cases: int = 0
    cold: float = nan
    seconds: float = inf
    rate: float = 0.0
    ratio: float = inf
    deflection: float = inf
    moment: float = inf
    reaction: float = inf
    states: int = 0


def batch(largest: int = 100_000) -> Iterator[Row]:
    """Run all programs side by side.

    Parameters
    ----------
    largest : int
        Most cases.

    Yields
    ------
    Row
        One for every problem and program; a program that is not there, or does not take the problem, has one without cases. Then
        the limits, without errors.
    """
    for problem in SIZES:
        yield from _side_by_side(problem, largest)


def _side_by_side(problem: str, largest: int) -> Iterator[Row]:
    all_cases = make(problem, largest)
    runs: dict[str, Callable[[], Found]] = {}
    answers: dict[str, Found] = {}
    for name, ready in PROGRAMS.items():
        if installed(name):
            try:
                runs[name] = ready(given(all_cases, name))
                answers[name] = runs[name]()
            except NoScheme:
                runs.pop(name, None)
    least = dict.fromkeys(runs, inf)
    begin = perf_counter()
    for turn in range(ROUNDS):
        if turn > 2 and perf_counter() - begin > LONGEST:
            break
        for name, run in runs.items():
            start = perf_counter()
            run()
            least[name] = min(least[name], perf_counter() - start)
    cases = {name: len(found.closed) for name, found in answers.items()}
    seconds = {name: time / cases[name] for name, time in least.items()}
    truths = [_exactly(all_cases, answers[OWN], case) for case in range(min(EXACT, len(all_cases.q)))]
    cold = _cold(problem, largest, list(runs))
    for name in PROGRAMS:
        if name not in answers:
            yield Row(problem, name)
            continue
        found = answers[name]
        states = int(np.count_nonzero((found.closed != answers[OWN].closed[: cases[name]]).any(axis=1)))
        times = cold[name], seconds[name], 1.0 / seconds[name], seconds[name] / seconds[OWN]
        yield Row(problem, name, cases[name], *times, *errors(found, truths), states)
    for name, limit in limits(all_cases).items():
        yield Row(problem, name, len(all_cases.q), nan, limit, 1.0 / limit, limit / seconds[OWN], nan, nan, nan)


def _exactly(cases: Batch, found: Found, case: int) -> Truth:
    """Solve a case in decimals; the levels are sums of doubles as every program forms them."""
    one = replace(cases, q=cases.q[case : case + 1], gap=cases.gap[case : case + 1], factors=False)
    beam = mesh(one.scene(), 1)
    beam.level[:] = cases.gap[case] + cases.settlement[case]
    return solve_exactly(beam, found.closed[case])


def errors(found: Found, truths: Sequence[Truth]) -> tuple[float, float, float]:
    """Errors of the first cases, relative to the largest value of each.

    Parameters
    ----------
    found : Found
        What a program found.
    truths : sequence of Truth
        Of the first cases.

    Returns
    -------
    tuple of float
        The worst of deflection, moment and reaction.
    """
    worst = [0.0, 0.0, 0.0]
    for case, truth in enumerate(truths):
        for k, name in enumerate(("deflection", "moment", "reaction")):
            high, low = getattr(truth, name)
            wrong = np.abs((getattr(found, name)[case] - high) - low).max() / np.abs(high).max()
            worst[k] = max(worst[k], float(wrong))
    return worst[0], worst[1], worst[2]


def _cold(problem: str, largest: int, names: Sequence[str]) -> dict[str, float]:
    """Seconds of the first call of every program in processes of their own."""
    found = dict.fromkeys(names, inf)
    for _ in range(PROCESSES):
        for name in names:
            code = f"from {first_call.__module__} import first_call; print(first_call({problem!r}, {name!r}, {largest}))"
            found[name] = min(found[name], number_printed(code))
    return found


def findings(rows: Sequence[Row]) -> str:
    """Say what the table says, from its numbers.

    Parameters
    ----------
    rows : sequence of Row
        From `batch`.
    """
    said = []
    for problem in dict.fromkeys(row.problem for row in rows):
        own, *others = [row for row in rows if row.problem == problem and row.cases and row.program not in (MEMORY, ARITHMETIC)]
        share = {row.program: row.ratio for row in rows if row.problem == problem}
        said.append(
            f"* {problem[:1].upper()}{problem[1:]}: gapbeam solves {_rounded(own.rate)} cases a second ({own.cases:,} in "
            f"{fmt.duration(own.cases * own.seconds)}), right to {_worst(own):.0e}."
        )
        said += [f"  * {row.program}: {_rounded(row.ratio)} times as long, right to {_worst(row):.0e}." for row in others]
        said.append(
            f"  * Its arrays alone would take {_share(share[MEMORY])} of gapbeam's time, the operations of one contact state "
            f"{_share(share[ARITHMETIC])}."
        )
    said.append(f"* This machine's triad moves {bandwidth() / 1e9:.1f} GB/s, and a core does {peak() / 1e9:.1f} Gflop/s.")
    return "\n".join(said)


def _share(ratio: float) -> str:
    return f"{100.0 * ratio:.2g} %"


def _worst(row: Row) -> float:
    return max(row.deflection, row.moment, row.reaction)


def table(rows: Iterable[Row]) -> list[list[str]]:
    """Write the rows as text.

    Parameters
    ----------
    rows : iterable of Row
        From `batch`.

    Returns
    -------
    list of list of str
        As many columns as `COLUMNS`.
    """
    return [
        [
            row.problem, row.program, f"{row.cases:,}", _known(row.cold, fmt.duration),
            fmt.duration(row.seconds) if row.seconds > 1e-7 else f"{1e9 * row.seconds:.3g} ns", _rounded(row.rate),
            _rounded(row.ratio) if row.ratio > 0.1 else f"{row.ratio:.2g}",
            *(_known(error, "{:.0e}".format) for error in (row.deflection, row.moment, row.reaction)),
            "-" if isnan(row.deflection) else str(row.states),
        ]
        if row.cases
        else [row.problem, row.program, "gives up" if installed(row.program) else "not installed", *["-"] * 8]
        for row in rows
    ]  # fmt: skip


def _known(number: float, worded: Callable[[float], str]) -> str:
    """A number in words, where there is one; limits have no errors and no first call."""
    return "-" if isnan(number) else worded(number)


def _rounded(number: float) -> str:
    """Three digits, and no more than two after the point."""
    return f"{float(f'{number:.3g}'):,.{0 if number >= 99.5 else 1 if number >= 9.95 else 2}f}"


PAGE = Page("batch", "Run time of many load cases", WORDS, COLUMNS, 2, "batch-study")
"""How the table is written and printed."""
