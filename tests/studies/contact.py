"""Contact at scale: gapbeam beside the active set that a user would write with numpy and scipy, on reference problem P6."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from time import perf_counter
from typing import Any

import numpy as np
from gapbeam.results import formatting as fmt
from gapbeam.results.cases.cases import Prepared, prepare
from gapbeam.results.stepping import solve
from gapbeam.studies.meshes import MeshedBeam, gapped_spans, mesh
from gapbeam.studies.methods import CONDENSED, yardstick
from gapbeam.studies.truth import error, solve_exactly

from .active_set import active_set
from .page import Page
from .programs import number_printed
from .schemes import sprung_base

COLUMNS = ("problem", "program", "cold", "faster cold", "hot", "faster hot", "solves", "deflection", "reaction", "states")
"""Headings of the table."""
WORDS = (
    "Reference problem P6. Work A: many spans on elastic one-sided supports with gaps. Work B: a free beam on a row of",
    "one-sided springs.",
    "",
    "* active set: what a user would write with numpy and scipy. It has cubic Hermite elements (4 a span in work A) and",
    "  banded Cholesky, and switches all wrong supports at once.",
    "* incremental: the same, with residuals formed element by element.",
    "* engine alone: the compiled engine, from plain arrays to the same answers.",
    "* prepared scene: a further load case, once gapbeam.prepare has read the dict. It is solved alone, or as one of many",
    "  cases in one call.",
    "",
    "All start with the same dict, or columns. They end with deflection, reaction and state of every support, inside",
    "Python.",
    "",
    "Columns:",
    "",
    "* cold: the first call in a process of its own, the fastest of three processes. Everything is imported, and a small",
    "  problem has been solved.",
    "* hot: again and again in turn in one process, the fastest of several counts.",
    "* faster: how many times faster than the incremental active set, which has all digits as gapbeam has.",
    "* deflection, reaction: errors relative to the largest value at a support, against decimals of 80 digits.",
    "* states: supports whose state is wrong.",
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
OWN, BESIDE = "gapbeam.solve", "active set, incremental"
"""The program that is measured, and the one it is set beside."""
FROM_COLUMNS, PLAIN = "gapbeam.solve, columns", "active set"
"""The same from columns; the active set without incremental residuals."""
PROCESSES = 3
"""Processes in which every program is started cold."""
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
    cold, faster_cold : float
        Seconds of the first call in a process of its own, and how many times faster that is than the incremental active set;
        not-a-number for what is not started cold.
    seconds, faster : float
        The same again and again in one process.
    solves : int
        Linear solves.
    deflection, reaction : float
        Errors relative to the largest value.
    wrong : int
        Supports in the wrong state.
    """

    problem: str
    program: str
    cold: float
    faster_cold: float
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
                yield from _side_by_side(f"{work}, {count:,} {unit}", make, count, parts)


def _side_by_side(problem: str, make: Callable[[int], dict[str, Any]], count: int, parts: int) -> Iterator[Row]:
    scene = make(count)
    beam, prepared = mesh(scene, 1), prepare(scene)
    cases = np.ones((max(2, CASES // beam.elements), len(prepared.scene.loads)))
    programs: dict[str, Callable[[], Found]] = {
        **{name: ready(scene, parts) for name, ready in READY.items()},
        TOGETHER: lambda: _together(prepared, cases),
        "engine alone": lambda: _engine_alone(beam),
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
    cold = dict.fromkeys(programs, np.nan) | _cold(make, count, parts)
    for name, (w, reaction, closed, solves) in answers.items():
        errors = error(w, truth.deflection), error(reaction, truth.reaction)
        wrong = int(np.count_nonzero(closed != truth.closed))
        times = cold[name], cold[BESIDE] / cold[name], seconds[name], seconds[BESIDE] / seconds[name]
        yield Row(problem, name, *times, solves, *errors, wrong)


def _cold(make: Callable[[int], dict[str, Any]], count: int, parts: int) -> dict[str, float]:
    """Seconds of the first call of every program that a user may start with."""
    found = dict.fromkeys(READY, np.inf)
    for _ in range(PROCESSES):
        for name in READY:
            code = f"from {__name__} import first_call; print(first_call({name!r}, {make.__name__!r}, {count}, {parts}))"
            found[name] = min(found[name], number_printed(code))
    return found


def first_call(name: str, work: str, count: int, parts: int) -> float:
    """Time the first call of a program in this process, once all is imported.

    Parameters
    ----------
    name : str
        The program, from READY.
    work : str
        Name of what makes the scene.
    count, parts : int
        Spans or springs, and elements a span of the active set.

    Returns
    -------
    float
        Seconds.
    """
    make = {one[1].__name__: one[1] for one in SIZES}[work]
    READY[name](make(3), parts)()  # imports what is imported on first use
    run = READY[name](make(count), parts)
    begin = perf_counter()
    run()
    return perf_counter() - begin


def as_columns(scene: dict[str, Any]) -> dict[str, Any]:
    """Write the supports of a scene, and loads of one type, as columns.

    Parameters
    ----------
    scene : dict
        With supports at nodes.

    Returns
    -------
    dict
        The same scene.
    """
    supports, loads = scene["supports"], scene["loads"]
    defaults = {"side": "both", "stiffness": np.inf, "gap": 0.0}
    made = {key: np.array([support.get(key, default) for support in supports]) for key, default in defaults.items()}
    made["node"] = np.array([support["node"] for support in supports])
    if len({tuple(load) for load in loads}) == 1:
        loads = {key: np.array([load[key] for load in loads]) for key in loads[0]} | {"type": loads[0]["type"]}
    return {**scene, "beam": {**scene["beam"], "spans": np.array(scene["beam"]["spans"])}, "supports": made, "loads": loads}


def _own(scene: dict[str, Any]) -> Found:
    step = solve(scene).steps[-1]
    return step.deflection, step.reaction, step.closed != 0, step.solves


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


READY: dict[str, Callable[[dict[str, Any], int], Callable[[], Found]]] = {
    OWN: lambda scene, _: partial(_own, scene),
    FROM_COLUMNS: lambda scene, _: partial(_own, as_columns(scene)),
    PREPARED: lambda scene, _: partial(_prepared, prepare(scene)),
    PLAIN: lambda scene, parts: partial(_active_set, scene, parts, incremental=False),
    BESIDE: lambda scene, parts: partial(_active_set, scene, parts, incremental=True),
}
"""What a user may start with: makes the call for a scene."""


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
            *(text for time, faster in ((row.cold, row.faster_cold), (row.seconds, row.faster)) for text in _timed(time, faster)),
            str(row.solves),
            f"{row.deflection:.0e}",
            f"{row.reaction:.0e}",
            str(row.wrong),
        ]
        for row in rows
    ]


def _timed(seconds: float, faster: float) -> tuple[str, str]:
    return ("-", "-") if np.isnan(seconds) else (fmt.duration(seconds), f"{faster:.2g}")


PAGE = Page("contact", "Contact with many supports", WORDS, COLUMNS, texts=2)
"""How the table is written and printed."""
