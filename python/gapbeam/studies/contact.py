"""Contact at scale: gapbeam beside the active set that a user would write with numpy and scipy, on reference problem P6."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import astuple, dataclass
from time import perf_counter
from typing import Any

import numpy as np

from ..results import formatting as fmt
from ..results.cases import Prepared, prepare
from ..results.stepping import solve
from .active_set import active_set
from .meshes import MeshedBeam, mesh
from .methods import CONDENSED, yardstick
from .page import Page
from .schemes import gapped_spans, sprung_base
from .truth import error, solve_exactly

COLUMNS = ("problem", "program", "time", "faster", "solves", "deflection", "reaction", "states")
"""Headings of the table."""
WORDS = (
    "Reference problem P6: work A, many spans on elastic one-sided supports with gaps; work B, a free beam on a one-sided",
    "foundation of springs. The active set is what a user would write with numpy and scipy: cubic Hermite elements (4 a span in",
    "work A), all wrong supports switched at once, banded Cholesky; plain, or incremental with residuals formed element by",
    "element. All start with the same dict and end with deflection, reaction and state of every support, inside Python; the",
    "engine alone goes from plain arrays to the same answers, compiled; prepared scene is what a further load case takes once",
    "gapbeam.prepare has read the dict, alone, or for each of many cases in one call: then nearly all of it is the engine, and the",
    "rest of a case alone is the call from Python; most of the time of gapbeam.solve is reading and checking the dict. They are",
    "run in turn, the fastest of several counts. faster: how many times faster than the plain active set. Errors are relative to",
    "the largest value at a support, against decimals of 80 digits; states counts supports whose state is wrong.",
)
"""What the table shows."""
ROUNDS = 100
"""Rounds in which every program is run twice, in turn; the second run finds its data in the caches."""
LONGEST = 2.0
"""Seconds after which no further round is begun, but for the first three."""
SIZES = (
    (("work A", "spans"), gapped_spans, 4, (10, 100, 1000, 10_000)),
    (("work B", "springs"), sprung_base, 1, (100, 1000, 10_000)),
)
"""Name, maker, elements a span, and sizes of the two works."""
OWN, PLAIN = "gapbeam.solve", "active set"
"""The program that is measured, and the one it is set beside."""
PREPARED, TOGETHER = "prepared scene", "prepared, cases together"
"""A further load case, alone and one of many."""
CASES = 3000
"""Elements of all cases that are solved together."""
ENGINE = yardstick(CONDENSED, 4)
"""The engine's normal route without Python."""

Found = tuple[np.ndarray, np.ndarray, np.ndarray, int]
"""Deflection, reaction and state (closed) of the supports, solves."""


@dataclass
class Row:
    """What one program did with one problem.

    Attributes
    ----------
    problem, program : str
        Their names.
    seconds : float
        From the dict to the answer, the fastest.
    faster : float
        How many times faster than the plain active set.
    solves : int
        Linear solves.
    deflection, reaction : float
        Errors relative to the largest value.
    wrong : int
        Supports in the wrong state.
    """

    problem: str
    program: str
    seconds: float
    faster: float
    solves: int
    deflection: float
    reaction: float
    wrong: int


def contact(largest: int = 10_000) -> Iterator[Row]:
    """Run all programs side by side.

    Parameters
    ----------
    largest : int
        Spans or springs of the largest problems.

    Yields
    ------
    Row
        One for every problem and program.
    """
    for (work, unit), make, parts, sizes in SIZES:
        for count in sizes:
            if count <= largest:
                yield from _side_by_side(f"{work}, {count:,} {unit}", make(count), parts)


def _side_by_side(problem: str, scene: dict[str, Any], parts: int) -> Iterator[Row]:
    beam, prepared = mesh(scene, 1), prepare(scene)
    cases = np.ones((max(2, CASES // beam.elements), len(prepared.scene.loads)))
    programs: dict[str, Callable[[], Found]] = {
        OWN: lambda: _own(scene),
        PREPARED: lambda: _prepared(prepared),
        TOGETHER: lambda: _together(prepared, cases),
        "engine alone": lambda: _engine_alone(beam),
        PLAIN: lambda: _active_set(scene, parts, incremental=False),
        "active set, incremental": lambda: _active_set(scene, parts, incremental=True),
    }
    answers = {name: run() for name, run in programs.items()}
    truth = solve_exactly(beam, answers[OWN][2])
    seconds = dict.fromkeys(programs, np.inf)
    begin = perf_counter()
    for turn in range(ROUNDS):
        if turn > 2 and perf_counter() - begin > LONGEST:
            break
        for name, run in [pair for pair in programs.items() for _ in range(2)]:
            start = perf_counter()
            run()
            seconds[name] = min(seconds[name], perf_counter() - start)
    seconds[TOGETHER] /= len(cases)
    for name, (w, reaction, closed, solves) in answers.items():
        errors = error(w, truth.deflection), error(reaction, truth.reaction)
        wrong = int(np.count_nonzero(closed != truth.closed))
        yield Row(problem, name, seconds[name], seconds[PLAIN] / seconds[name], solves, *errors, wrong)


def _own(scene: dict[str, Any]) -> Found:
    step = solve(scene).steps[-1]
    return step.deflection, step.reaction, np.array(step.state) != "open", step.solves


def _prepared(scene: Prepared) -> Found:
    case = scene.solve()
    return case.deflection, case.reaction, case.closed != 0, int(case.solves)


def _together(scene: Prepared, factors: np.ndarray) -> Found:
    cases = scene.solve(factors)
    return cases.deflection[-1], cases.reaction[-1], cases.closed[-1] != 0, int(cases.solves[-1])


def _engine_alone(beam: MeshedBeam) -> Found:
    answer = ENGINE.run(beam, 1)
    return answer.deflection, answer.reaction, answer.closed, answer.solves


def _active_set(scene: dict[str, Any], parts: int, incremental: bool) -> Found:
    found = active_set(scene, parts, incremental)
    return found.deflection, found.reaction, found.closed, found.solves


def table(rows: Iterable[Row]) -> list[list[str]]:
    """Write the rows as text.

    Parameters
    ----------
    rows : iterable of Row
        From `contact`.

    Returns
    -------
    list of list of str
        As many columns as `COLUMNS`.
    """
    return [
        [
            row.problem,
            row.program,
            fmt.duration(row.seconds),
            f"{row.faster:.2g}",
            str(row.solves),
            f"{row.deflection:.0e}",
            f"{row.reaction:.0e}",
            str(row.wrong),
        ]
        for row in rows
    ]


def values(rows: Iterable[Row]) -> list[tuple]:
    """Give the rows with all digits, times in seconds.

    Parameters
    ----------
    rows : iterable of Row
        From `contact`.

    Returns
    -------
    list of tuple
        As many columns as `COLUMNS`.
    """
    return [astuple(row) for row in rows]


PAGE = Page("contact", "Contact at scale", WORDS, COLUMNS, texts=2)
"""How the table is written and printed."""
