"""A beam on a one-sided foundation: error against run time of gapbeam's foundation, and of springs in its place."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal
from functools import partial
from math import inf, isinf
from statistics import median
from time import perf_counter
from typing import Any

import numpy as np
from gapbeam.results import formatting as fmt
from gapbeam.results.cases.cases import Prepared, prepare
from gapbeam.results.result import Result
from gapbeam.results.stepping import solve

from .active_set import NoScheme
from .ground_truth import GroundTruth, solve_ground
from .page import Page
from .programs import has, number_printed
from .springs import Found, by_gapbeam, by_opensees, by_scipy, places

COLUMNS = ("problem", "program", "nodes", "cold", "faster cold", "hot", "faster hot", "ends", "deflection", "moment")
"""Headings of the table."""
WORDS = (
    "Beams on ground that cannot pull:",
    "",
    "* work B: 100 m, EI = 1e5, k = 1e4, own weight 1, 500 down in the middle, 60 up at 30 m;",
    "* free beam: EI = 1, k = 4, own weight 1, 4 long, 20 down in the middle, so that both ends lift;",
    "* lifted end: EI = 1, k = 4, own weight 1, 20 long, one end lifted by 1.5.",
    "",
    "Programs:",
    "",
    "* foundation: gapbeam's, without a mesh. prepared: a further load case, once gapbeam.prepare has read the scene.",
    "* All others have springs at nodes. springs are solved by gapbeam itself (supports as columns).",
    "* scipy is the active set of the study contact, plain or incremental.",
    "* OpenSees, if installed, has springs without tension and Newton's method. It gets up to 1,001 nodes: the time to",
    "  make its model grows with their square.",
    "",
    "All start from Python's numbers. They end with contact ends, and deflection and moment at eleven points, which are",
    "nodes of every mesh. Contact ends of springs are the zeros of the straight lines between the deflections of the",
    "nodes.",
    "",
    "Columns:",
    "",
    "* cold: the first call in a process of its own, once all is imported and a small problem has been solved. hot: again",
    "  and again in turn in one process. Both are medians of several.",
    "* faster: how many times faster than scipy, incremental, with 1,001 nodes.",
    "* ends, deflection, moment: errors against transfer matrices in decimals of 140 digits. They are relative to the",
    "  largest true value, those of the ends to the length of the beam.",
)
"""What the table shows."""
PROBLEMS: dict[str, tuple[dict[str, Any], tuple[float, ...]]] = {
    "work B": (
        {
            "beam": {"spans": [100.0], "EI": 1e5},
            "foundation": [{"k": 1e4, "side": "below"}],
            "loads": [
                {"type": "uniform", "q": 1.0, "case": "dead"},
                {"type": "force", "x": 50.0, "F": 500.0},
                {"type": "force", "x": 30.0, "F": -60.0},
            ],
        },
        (0.3, 47.5, 55.4, 67.6),
    ),
    "free beam": (
        {
            "beam": {"spans": [4.0], "EI": 1.0},
            "foundation": [{"k": 4.0, "side": "below"}],
            "loads": [{"type": "uniform", "q": 1.0, "case": "dead"}, {"type": "force", "x": 2.0, "F": 20.0}],
        },
        (0.2, 3.8),
    ),
    "lifted end": (
        {
            "beam": {"spans": [20.0], "EI": 1.0},
            "foundation": [{"k": 4.0, "side": "below"}],
            "loads": [{"type": "uniform", "q": 1.0, "case": "dead"}, {"type": "force", "x": 0.0, "F": -1.5}],
        },
        (2.1,),
    ),
}
"""Scenes, and about where contact begins and ends in them, by name."""
MESHES = (10, 100, 1000, 10_000, 100_000)
"""Elements of the meshes."""
OPENSEES_LARGEST = 1000
"""Elements of the finest mesh that OpenSees is given."""
OWN, PREPARED, SPRINGS = "foundation", "foundation, prepared", "springs"
"""gapbeam's foundation, a further load case on it, and springs by gapbeam itself."""
PLAIN, INCREMENTAL, OPENSEES = "scipy", "scipy, incremental", "OpenSees"
"""Springs by others."""
BESIDE = (INCREMENTAL, 1000)
"""What all are set beside."""
ROUNDS = 15
"""Rounds in which every program is run, in turn."""
LONGEST = 10.0
"""Seconds after which no further round is begun, but for the first three."""
PROCESSES = 3
"""Processes in which every program is started cold."""

Key = tuple[str, int]
"""Program, and elements of its mesh, 0 without one."""


@dataclass
class Row:
    """What one program did with one problem.

    Attributes
    ----------
    problem, program : str
        Their names.
    nodes : int
        Of its mesh; 0 without one.
    cold, faster_cold : float
        Seconds of the first call in a process of its own, and how many times faster that is than the active set beside it.
    seconds, faster : float
        The same again and again in one process.
    ends, deflection, moment : float
        Errors; infinite where there are other zones, or no answer.
    """

    problem: str
    program: str
    nodes: int
    cold: float
    faster_cold: float
    seconds: float
    faster: float
    ends: float
    deflection: float
    moment: float


def foundation(largest: int = 100_000) -> Iterator[Row]:
    """Run all programs side by side.

    Parameters
    ----------
    largest : int
        Elements of the finest mesh.

    Yields
    ------
    Row
        One for every problem, program and mesh.
    """
    for problem in PROBLEMS:
        yield from _side_by_side(problem, _programs(largest))


def _programs(largest: int) -> list[Key]:
    """Programs and their meshes; the one that all are set beside is always there."""
    sizes = [size for size in MESHES if size <= largest]
    found = [(OWN, 0), (PREPARED, 0)]
    for name in (SPRINGS, PLAIN, INCREMENTAL):
        found += [(name, size) for size in sizes]
    if BESIDE not in found:
        found.append(BESIDE)
    if has("openseespy"):
        found += [(OPENSEES, size) for size in sizes if size <= OPENSEES_LARGEST]
    return found


def _side_by_side(problem: str, keys: Sequence[Key]) -> Iterator[Row]:
    scene, ends = PROBLEMS[problem]
    truth = solve_ground(scene, ends, places(scene["beam"]["spans"][0]).tolist())
    programs = {key: _ready(key, scene) for key in keys}
    answers = {key: _try(run) for key, run in programs.items()}
    programs = {key: run for key, run in programs.items() if answers[key] is not None}
    times: dict[Key, list[float]] = {key: [] for key in programs}
    begin = perf_counter()
    for turn in range(ROUNDS):
        if turn > 2 and perf_counter() - begin > LONGEST:
            break
        for key, run in programs.items():
            start = perf_counter()
            run()
            times[key].append(perf_counter() - start)
    cold = {key: _cold(key, problem) for key in programs}
    hot = {key: median(found) for key, found in times.items()}
    for key in keys:
        name, size = key
        errors = (inf,) * 3 if answers[key] is None else _errors(answers[key], truth, scene["beam"]["spans"][0])
        seconds = (cold[key], cold[BESIDE] / cold[key], hot[key], hot[BESIDE] / hot[key]) if key in hot else (inf,) * 4
        yield Row(problem, name, size + 1 if size else 0, *seconds, *errors)


def _ready(key: Key, scene: Mapping[str, Any]) -> Callable[[], Found]:
    """Make the call of a program."""
    name, size = key
    at = places(scene["beam"]["spans"][0])
    if name == OWN:
        return partial(_own, scene, at)
    if name == PREPARED:
        return partial(_prepared, prepare(scene), at)
    if name == SPRINGS:
        return by_gapbeam(scene, size)
    if name == OPENSEES:
        return by_opensees(scene, size)
    return by_scipy(scene, size, name == INCREMENTAL)


def _own(scene: Mapping[str, Any], at: np.ndarray) -> Found:
    return _found(solve(scene), at)


def _prepared(scene: Prepared, at: np.ndarray) -> Found:
    return _found(scene.result(), at)


def _found(result: Result, at: np.ndarray) -> Found:
    fields, length = result.at(at), at[-1]
    ends = [end for zone in result.steps[-1].contact for end in (zone.from_, zone.to) if 0.0 < end < length]
    return Found(np.array(ends), fields.deflection, fields.moment)


def _try(run: Callable[[], Found]) -> Found | None:
    """Run once; None where springs are given up."""
    try:
        return run()
    except (NoScheme, np.linalg.LinAlgError):
        return None


def _errors(found: Found, truth: GroundTruth, length: float) -> tuple[float, float, float]:
    """Errors of contact ends, deflection and moment."""
    ends = inf
    if len(found.ends) == len(truth.ends):
        ends = _error(found.ends, truth.ends, Decimal(length))
    return ends, *(
        _error(values, true, max(abs(value) for value in true))
        for values, true in ((found.deflection, truth.deflection), (found.moment, truth.moment))
    )


def _error(values: np.ndarray, true: Sequence[Decimal], size: Decimal) -> float:
    if not np.isfinite(values).all():
        return inf
    return float(max(abs(Decimal(value) - exact) for value, exact in zip(values.tolist(), true, strict=True)) / size)


def _cold(key: Key, problem: str) -> float:
    """Seconds of the first call in a process of its own."""
    found = []
    for _ in range(PROCESSES):
        code = f"from {__name__} import first_call; print(first_call({key!r}, {problem!r}))"
        found.append(number_printed(code))
    return median(found)


def first_call(key: Key, problem: str) -> float:
    """Time the first call of a program in this process, once all is imported.

    Parameters
    ----------
    key : tuple of str and int
        Program, and elements of its mesh.
    problem : str
        From `PROBLEMS`.

    Returns
    -------
    float
        Seconds.
    """
    small, size = PROBLEMS["free beam"][0], min(key[1], 10)
    changed = {**small, "foundation": [{**small["foundation"][0], "k": 3.0}]}
    _ready((key[0], size), changed)()  # imports what is imported on first use
    run = _ready(key, PROBLEMS[problem][0])
    begin = perf_counter()
    run()
    return perf_counter() - begin


def findings(rows: Sequence[Row]) -> str:
    """Say what the table says, from its numbers.

    Parameters
    ----------
    rows : sequence of Row
        From `foundation`.
    """
    said = []
    for problem in dict.fromkeys(row.problem for row in rows):
        here = [row for row in rows if row.problem == problem]
        own = next(row for row in here if row.program == OWN)
        finest = [row for row in here if row.program == SPRINGS][-1]
        ratio = finest.seconds / own.seconds
        said.append(
            f"* {problem[:1].upper()}{problem[1:]}: the foundation has contact ends, deflections and moments right to "
            f"{own.ends:.0e}, {own.deflection:.0e} and {own.moment:.0e}, in {fmt.duration(own.seconds)}. {finest.nodes:,} springs "
            f"by gapbeam itself have them right to {_error_text(finest.ends)}, {finest.deflection:.0e} and {finest.moment:.0e}, in "
            f"{ratio:{'.0f' if ratio >= 10.0 else '.2g'}} times that time."
        )
    return "\n".join(said)


def table(rows: Iterable[Row]) -> list[list[str]]:
    """Write the rows as text.

    Parameters
    ----------
    rows : iterable of Row
        From `foundation`.

    Returns
    -------
    list of list of str
        As many columns as `COLUMNS`.
    """
    return [
        [
            row.problem,
            row.program,
            f"{row.nodes:,}" if row.nodes else "-",
            *(text for time, faster in ((row.cold, row.faster_cold), (row.seconds, row.faster)) for text in _timed(time, faster)),
            _error_text(row.ends, isinf(row.seconds)),
            _error_text(row.deflection, isinf(row.seconds)),
            _error_text(row.moment, isinf(row.seconds)),
        ]
        for row in rows
    ]


def _timed(seconds: float, faster: float) -> tuple[str, str]:
    return ("-", "-") if isinf(seconds) else (fmt.duration(seconds), f"{faster:.2g}")


def _error_text(error: float, failed: bool = False) -> str:
    if failed:
        return "fails"
    return "other zones" if isinf(error) else f"{error:.0e}"


CAPTION = "Error of contact ends, deflection and moment against run time, for three beams"
PAGE = Page("foundation", "Beams on ground: foundation or springs", WORDS, COLUMNS, 2, "foundation-study", CAPTION)
"""How the table is written and printed."""
