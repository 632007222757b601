"""A train over a beam: error against run time of gapbeam's exact envelope, and of tables of positions by others."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal
from functools import partial
from math import inf, isinf
from time import perf_counter, process_time
from typing import Any

import numpy as np
from gapbeam.results import formatting as fmt
from gapbeam.results.stepping import solve

from .active_set import NoScheme
from .page import Page
from .programs import has
from .train_positions import Swept, by_numpy
from .train_programs import axles_missing, by_opensees, by_pycba
from .train_truth import TrainTruth, solve_train

COLUMNS = ("problem", "program", "positions", "time", "faster", "moment", "shear", "largest reaction", "smallest reaction")
"""Headings of the table."""
WORDS = (
    "A vehicle of three axles crosses five spans of 20, 25, 30, 25 and 20 m, EI = 2e6. Its axles of 35, 145 and 145 are",
    "4.3 apart: AASHTO's design truck in kN and m.",
    "",
    "* both ways: rigid two-way supports, own weight 12.",
    "* bearings: compression-only supports with a flexibility of 1/5e5, own weight 2. Supports open and close 8 times",
    "  while it passes.",
    "",
    "Programs:",
    "",
    "* gapbeam: `gapbeam.solve` and the exact extremes of the envelope, from Python's numbers to Python's numbers. It has",
    "  no positions.",
    "* numpy: what a careful script does. It solves all positions at once, with one inverse for every set of active",
    "  supports. Positions at which that set changes are bisected until doubles have no number between.",
    "* It includes positions at which an axle is at a support, with the shears on both sides, and moments where the shear",
    "  is zero.",
    "* numpy, refined: it then searches around the best position of every value, 40 times at half the distance. It finds",
    "  the best of all unless that is near another position.",
    "* OpenSees, if installed: a load step for every position, and springs without tension.",
    "* PyCBA: it has two-way supports only, and stores 100 points a span of every position. It gets up to 10,000",
    "  positions.",
    "",
    "Columns:",
    "",
    "* time: the least of several rounds in which all take their turn. It is the clock's or the processor's, whichever is",
    "  less: another program adds to the first, threads to the second.",
    "* faster: how many times faster than numpy, refined, with 1,000 positions.",
    "* moment, shear: errors of the largest and smallest along the beam. largest, smallest reaction: at the support where",
    "  it is worst.",
    "",
    "Errors are relative to the largest true value of their kind. The true envelope is exact, in decimals of 60 digits",
    "(Macaulay's functions; roots of polynomials in the position).",
)
"""What the table shows."""
SPANS = [20.0, 25.0, 30.0, 25.0, 20.0]
"""Of both problems."""


def _problem(weight: float, **support: Any) -> dict[str, Any]:
    return {
        "beam": {"spans": SPANS, "EI": 2e6},
        "supports": [{"node": i, **support} for i in range(len(SPANS) + 1)],
        "loads": [{"type": "uniform", "q": weight, "case": "dead"}],
        "trains": [{"name": "truck", "axles": [[0.0, 35.0], [4.3, 145.0], [8.6, 145.0]]}],
    }


PROBLEMS = {"both ways": _problem(12.0), "bearings": _problem(2.0, side="below", stiffness=5e5)}
"""Scenes by name."""
POSITIONS = (100, 1000, 10_000, 100_000)
"""Positions that are tabulated."""
PYCBA_MOST = 10_000
"""Most positions that PyCBA is given."""
REFINED_MOST = 10_000
"""Most positions beside which the loop in numpy searches on."""
OWN, NUMPY, REFINED, PYCBA, OPENSEES = "gapbeam", "numpy", "numpy, refined", "PyCBA", "OpenSees"
"""Programs."""
BESIDE = (REFINED, 1000)
"""What all are set beside."""
ROUNDS = 15
"""Rounds in which every program is run, in turn."""
SLOW = 0.5
"""Programs that take longer, in seconds, are timed once only, after they have answered once."""

Key = tuple[str, int]
"""Program, and its positions, 0 without any."""


@dataclass
class Row:
    """What one program did with one problem.

    Attributes
    ----------
    problem, program : str
        Their names.
    positions : int
        How many; 0 where there are none.
    seconds, faster : float
        Time, and how many times faster that is than numpy beside it; infinite and not-a-number where it did not run.
    moment, shear, most, least : float
        Errors; the last two of the largest and the smallest reaction. Infinite where there is no answer.
    """

    problem: str
    program: str
    positions: int
    seconds: float
    faster: float
    moment: float
    shear: float
    most: float
    least: float


def trains(largest: int = 100_000) -> Iterator[Row]:
    """Run all programs side by side.

    Parameters
    ----------
    largest : int
        Most positions.

    Yields
    ------
    Row
        One for every problem, program and number of positions; a program that is not there, or does not know such supports, has
        one without positions.
    """
    for problem, scene in PROBLEMS.items():
        yield from _side_by_side(problem, scene, [size for size in POSITIONS if size <= largest])


def _side_by_side(problem: str, scene: Mapping[str, Any], sizes: Sequence[int]) -> Iterator[Row]:
    truth = solve_train(scene)
    runs: dict[Key, Callable[[], Swept]] = {(OWN, 0): partial(_own, scene)}
    runs |= {(NUMPY, size): by_numpy(scene, size) for size in sizes}
    runs |= {(REFINED, size): by_numpy(scene, size, True) for size in sizes if size <= REFINED_MOST}
    runs.setdefault(BESIDE, by_numpy(scene, BESIDE[1], True))
    if has("openseespy"):
        runs |= {(OPENSEES, size): by_opensees(scene, size) for size in sizes}
    if has("pycba") and all("side" not in support for support in scene["supports"]):
        runs |= {(PYCBA, size): by_pycba(scene, size) for size in sizes if size <= PYCBA_MOST}
    answers: dict[Key, Swept | None] = {key: _try(run) for key, run in runs.items()}
    seconds = dict.fromkeys((key for key, answer in answers.items() if answer is not None), inf)
    for turn in range(ROUNDS):
        for key, least in seconds.items():
            if turn and least > SLOW:
                continue
            clock, processor = perf_counter(), process_time()
            runs[key]()
            seconds[key] = min(least, perf_counter() - clock, process_time() - processor)
    for key, answer in answers.items():
        time = seconds.get(key, inf)
        yield Row(problem, *key, time, seconds[BESIDE] / time, *(_errors(answer, truth) if answer else (inf,) * 4))
    for name in (OPENSEES, PYCBA):
        if not any(key[0] == name for key in answers):
            yield Row(problem, name, 0, inf, 0.0, *(inf,) * 4)


def _own(scene: Mapping[str, Any]) -> Swept:
    envelope = solve(scene).envelope()
    moment, shear = ([envelope.extremes[name][kind].value for kind in ("max", "min")] for name in ("moment", "shear"))
    reaction = [[support["reaction"][kind].value for support in envelope.supports] for kind in ("max", "min")]
    return Swept(np.array(moment), np.array(shear), np.array(reaction))


def _try(run: Callable[[], Swept]) -> Swept | None:
    """Run once; None where it is given up."""
    try:
        return run()
    except NoScheme:
        return None


def _errors(found: Swept, truth: TrainTruth) -> tuple[float, float, float, float]:
    """Errors of moment, shear, largest and smallest reactions."""
    size = max(abs(value) for pair in truth.reaction for value in pair)
    largest, smallest = zip(*truth.reaction, strict=True)
    return (
        _error(found.moment, truth.moment, max(map(abs, truth.moment))),
        _error(found.shear, truth.shear, max(map(abs, truth.shear))),
        _error(found.reaction[0], largest, size),
        _error(found.reaction[1], smallest, size),
    )


def _error(values: np.ndarray, true: Sequence[Decimal], size: Decimal) -> float:
    return float(max(abs(Decimal(value) - exact) for value, exact in zip(values.tolist(), true, strict=True)) / size)


def findings(rows: Sequence[Row]) -> str:
    """Say what the table says, from its numbers.

    Parameters
    ----------
    rows : sequence of Row
        From `trains`.
    """
    said = []
    for problem in dict.fromkeys(row.problem for row in rows):
        here = [row for row in rows if row.problem == problem]
        own = next(row for row in here if row.program == OWN)
        said.append(
            f"* {problem[:1].upper()}{problem[1:]}: gapbeam has moments, shears and reactions right to {own.moment:.0e}, "
            f"{own.shear:.0e} and {max(own.most, own.least):.0e} in {fmt.duration(own.seconds)}."
        )
        finest = [row for row in here if row.program == NUMPY][-1:]
        for row in finest + [row for row in here if (row.program, row.positions) == BESIDE]:
            said.append(
                f"  * {row.program}{',' if row.program == REFINED else ''} with {row.positions:,} positions has them right to "
                f"{row.moment:.0e}, {row.shear:.0e} and "
                f"{max(row.most, row.least):.0e} in {row.seconds / own.seconds:.0f} times that time."
            )
        for row in [row for row in here if row.program == PYCBA and row.positions][-1:]:
            said.append(
                f"  * PyCBA with {row.positions:,} positions has moments right to {row.moment:.0e}, and largest reactions to "
                f"{row.most:.0e}. Its smallest ones are wrong by {row.least:.0%} of the largest with any number of positions: its "
                "envelopes begin at zero, and under own weight no reaction falls to zero here."
            )
    if has("pycba"):
        missing, tried = axles_missing()
        said.append(
            f"* An axle at the last support acts. Where the last axle of a vehicle is there, PyCBA leaves it out on {missing} of "
            f"{tried} beams. Their spans and axle distances are tenths, and the difference of two sums exceeds the length."
        )
    return "\n".join(said)


def table(rows: Iterable[Row]) -> list[list[str]]:
    """Write the rows as text.

    Parameters
    ----------
    rows : iterable of Row
        From `trains`.

    Returns
    -------
    list of list of str
        As many columns as `COLUMNS`.
    """
    return [
        [
            row.problem,
            row.program,
            f"{row.positions:,}" if row.positions else "-",
            *(("-", "-") if isinf(row.seconds) else (fmt.duration(row.seconds), f"{row.faster:.2g}")),
            *(_error_text(row, error) for error in (row.moment, row.shear, row.most, row.least)),
        ]
        for row in rows
    ]


def _error_text(row: Row, error: float) -> str:
    if not isinf(error):
        return f"{error:.0e}"
    if row.positions:
        return "fails"
    return "not installed" if not has({PYCBA: "pycba", OPENSEES: "openseespy"}[row.program]) else "cannot"


CAPTION = "Error of the envelope of a train against run time, for two beams"
PAGE = Page("trains", "Moving loads: exact envelopes or positions", WORDS, COLUMNS, 2, "trains-study", CAPTION)
"""How the table is written and printed."""
