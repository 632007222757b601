"""Error against run time: what accuracy costs by each method, on families of beams or on any scene."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf, isnan, nan
from time import perf_counter
from typing import Any

import numpy as np
from msgspec import structs

from ..base.errors import SceneError
from ..results import formatting as fmt
from ..results.stepping import solve
from ..scene.analysis import Analysis
from ..scene.reading import read_scene
from ..scene.structs import Scene
from .exact import Reference
from .meshes import (
    MeshedBeam,
    Unfit,
    gapped_spans,
    many_spans,
    mesh,
    one_span,
    soft_and_stiff,
    stiffness_jumps,
)
from .methods import (
    CONDENSED,
    DISPLACEMENT,
    KERNEL,
    KERNEL_REFINED,
    Measured,
    compare,
    from_scene,
    front,
    methods,
)
from .page import literal_markdown, markdown_table
from .page import to_csv as csv_text
from .truth import solve_exactly, solve_one_span

WORDS = (
    "The largest error of deflections, moments and reactions at all nodes, relative to the largest true value of its",
    "kind, and the time of one solve.",
    "",
    "* All methods solve the same beam of the same elements and give the same values at the same nodes.",
    "* Compiled methods go from plain arrays to answers. gapbeam.solve goes from a scene to answers inside Python.",
    "* Contact states are included. The engine uses its own search. The others switch all wrong supports, one at a time",
    "  after 40 solves, which ends most cycles.",
    "* Marked (* or bold) is the Pareto front: no other method is both faster and more accurate on that beam. Errors",
    "  below 4e-16 are equal, and answers without a right digit do not count.",
    "* The true values are decimals of 80 digits, or a closed form.",
    "* Times are the fastest of several, taken in turn, on one machine. Compare them with each other only.",
)
"""What the tables show."""
METHODS = (
    "condensed mixed: the engine's normal route. Only supports are nodes; everything else is condensed exactly and recovered.",
    "nodal mixed: every mesh point a node (deflection and moment unknown), by the engine's 2x2 block elimination.",
    "fused kernel: the same by its kernel for plain beams, without reactions.",
    "dgbsv: the same by LAPACK.",
    "ending + 1, + 2: steps of refinement. Residuals are in plain double with differences first (those of the kernel with "
    "the remainders of the divisions).",
    "dd: residuals in double-double.",
    "displacement: cubic Hermite elements and banded Cholesky (dpbtrf), what most programs do.",
    "displacement, incremental: its residual is summed element by element, differences first, and corrected until "
    "it no longer falls.",
)
"""What the methods are."""
FIELDS = (
    "beam", "elements", "method", "deflection", "moment", "reaction", "error", "seconds", "solves", "front", "failure",
)  # fmt: skip
"""Columns of the CSV."""
Table = tuple[list[str], list[list[str]]]
"""Headings and rows."""
PARTS = (1, 4, 16, 64)
"""Elements a stretch of a scene is cut into."""
GOOD = 1e-12
"""An error that nobody minds."""


@dataclass
class Comparison:
    """One beam by all methods.

    Attributes
    ----------
    beam : str
        Its name; beams of one name are a family.
    elements : int
        In its mesh.
    rows : list of Measured
        What the methods reached.
    """

    beam: str
    elements: int
    rows: list[Measured]


def _gapped(elements: int) -> MeshedBeam:
    return mesh(gapped_spans(elements // 4), 4, "one-sided, gaps")


FAMILIES = {
    "span": (one_span, (10, 100, 1000, 10**4, 10**5, 10**6)),
    "spans": (many_spans, (40, 400, 4000, 40_000)),
    "jumps": (stiffness_jumps, (10, 100, 1000, 10**4, 10**5)),
    "springs": (soft_and_stiff, (40, 400, 4000, 40_000)),
    "gaps": (_gapped, (40, 400, 4000, 40_000)),
}
"""The built-in families and their numbers of elements."""


def families(names: Sequence[str] = (), largest: int = 10**6) -> Iterator[Comparison]:
    """Compare the methods on the built-in families.

    Parameters
    ----------
    names : sequence of str
        Some of `FAMILIES`; default all.
    largest : int
        Finer meshes are left out.

    Yields
    ------
    Comparison
        One for every mesh.

    Examples
    --------
    >>> fine = list(families(["span"], largest=1000))[-1]
    >>> by_name = {row.method: row for row in fine.rows}
    >>> by_name["condensed mixed"].error < 1e-14 < 1e-9 < by_name["displacement"].error
    True
    """
    chosen = methods()
    for name in names or FAMILIES:
        make, sizes = FAMILIES[name]
        for elements in sizes:
            if elements <= largest:
                beam = make(elements)
                truth = solve_one_span(beam) if make is one_span else solve_exactly(beam)
                yield Comparison(beam.name, beam.elements, compare(beam, truth, chosen))


def scene_comparisons(source: Mapping[str, Any] | Scene | str, parts: Sequence[int] = PARTS) -> tuple[list[Comparison], str]:
    """Compare the methods on a scene at load factor 1.

    Parameters
    ----------
    source : Scene, mapping or path
    parts : sequence of int
        Elements into which each stretch between two places where anything changes is cut, one comparison for each.

    Returns
    -------
    comparisons : list of Comparison
        With the engine alone, and against exact fractions at the places of the scene, where meshed beams do not fit.
    remark : str
        Why they do not fit, or empty.

    Raises
    ------
    SceneError
        The scene is not valid, or it has no unique solution to compare with.
    """
    scene = read_scene(source)
    result = solve(structs.replace(scene, analysis=Analysis()))
    if result.status != "solved":
        raise SceneError("", f"nothing to compare: {result.reason}")
    try:
        beams = [mesh(scene, count) for count in parts]
        truths = [solve_exactly(beam, from_scene("").run(beam, 1).closed) for beam in beams]
    except Unfit as unfit:
        remark = f"The scene holds {unfit}, which the compiled methods of this study do not treat: gapbeam.solve alone is measured."
        return [_engine_alone(scene)], remark
    except ArithmeticError as error:
        raise SceneError("", f"nothing to compare with: {error}") from None
    pairs = zip(beams, truths, strict=True)
    return [Comparison(beam.name, beam.elements, compare(beam, truth, methods())) for beam, truth in pairs], ""


def _engine_alone(scene: Scene) -> Comparison:
    reference, rows = Reference(scene), []
    plans = [("gapbeam.solve", {}), ("gapbeam.solve, 10 steps", {"steps": 10}), ("gapbeam.solve, 100 steps", {"steps": 100})]
    for name, plan in [*plans, ("gapbeam.solve, events", {"follow": "events"})]:
        own = structs.replace(scene, analysis=Analysis(**plan))
        seconds = inf
        for _ in range(3):
            begin = perf_counter()
            result = solve(own)
            if result.status == "solved":
                left, right = (result.at(reference.x, side=side) for side in ("left", "right"))
            seconds = min(seconds, perf_counter() - begin)
        if result.status != "solved":
            rows.append(Measured(name, inf, inf, inf, seconds, 0, result.status))
            continue
        reference.solve(result.steps[-1].state)
        moment = max(
            reference.error("moment_left", left.moment, inner=slice(1, None)),
            reference.error("moment_right", right.moment, inner=slice(None, -1)),
        )
        deflection = reference.error("deflection", left.deflection)
        reaction = reference.error("reaction", result.steps[-1].reaction)
        rows.append(Measured(name, deflection, moment, reaction, seconds, result.solves))
    return Comparison(fmt.title(scene, "scene"), len(reference.x) - 1, rows)


def tables(comparisons: Iterable[Comparison], cell: Callable[[Measured, bool], str]) -> dict[str, Table]:
    """Write one table for every family: methods down, numbers of elements across.

    Parameters
    ----------
    comparisons : iterable of Comparison
        From `families` or `scene_comparisons`.
    cell : callable
        Writes what one method reached, given also whether it is on the Pareto front.

    Returns
    -------
    dict of str to (list of str, list of list of str)
        Headings and rows by family.
    """
    found: dict[str, list[Comparison]] = {}
    for comparison in comparisons:
        found.setdefault(comparison.beam, []).append(comparison)
    made = {}
    for name, members in found.items():
        cells: dict[str, list[str]] = {row.method: ["-"] * len(members) for member in members for row in member.rows}
        for place, member in enumerate(members):
            for row, leads in zip(member.rows, front(member.rows), strict=True):
                cells[row.method][place] = cell(row, leads)
        made[name] = (["elements", *(f"{member.elements:,}" for member in members)], [[m, *texts] for m, texts in cells.items()])
    return made


def _error(row: Measured, leads: bool) -> str:
    return row.failure or f"{row.error:.0e}" + "*" * leads


def _time(row: Measured, leads: bool) -> str:
    return "-" if row.failure else fmt.duration(row.seconds) + "*" * leads


def _both(row: Measured, leads: bool) -> str:
    text = row.failure or f"{row.error:.0e}, {fmt.duration(row.seconds)}"
    return f"**{text}**" if leads else text


def findings(comparisons: Sequence[Comparison]) -> list[str]:
    """Say what the tables say, from their numbers, where the displacement method is as good included.

    Parameters
    ----------
    comparisons : sequence of Comparison
        From `families` or `scene_comparisons`.

    Returns
    -------
    list of str
        A few sentences for every family.
    """
    lines = []
    for name in dict.fromkeys(comparison.beam for comparison in comparisons):
        members = [comparison for comparison in comparisons if comparison.beam == name]
        rows = [{row.method: row for row in member.rows} for member in members]
        if not all({CONDENSED, DISPLACEMENT} <= set(found) for found in rows):
            continue
        sizes = [member.elements for member in members]
        best, plain = ([found[method].error for found in rows] for method in (CONDENSED, DISPLACEMENT))
        line = f"{_capital(name)}: condensed mixed is right to {max(best):.0e} on all meshes. The plain displacement method "
        bad = next((k for k, error in enumerate(plain) if not error <= GOOD), len(plain))
        if bad == len(plain):
            line += f"is as good for every practical purpose ({max(plain):.0e} at worst)"
        else:
            line += f"is right to {max(plain[:bad]):.0e} up to {sizes[bad - 1]:,} elements and " if bad else ""
            worst = int(np.argmax(plain))
            line += f"keeps {_kept(plain[worst])} at {sizes[worst]:,}"
        line += f". It takes {_times(rows, DISPLACEMENT, CONDENSED)} the time of condensed mixed"
        if all(KERNEL in found for found in rows):
            error, refined = (max(found[name].error for found in rows) for name in (KERNEL, KERNEL_REFINED))
            line += f". That is {_times(rows, DISPLACEMENT, KERNEL)} the time of the fused kernel (right to {error:.0e}), and "
            line += f"{_times(rows, DISPLACEMENT, KERNEL_REFINED)} that of the refined kernel (right to {refined:.0e})"
        lines.append(f"{line}.")
    return lines


def _times(rows: Sequence[Mapping[str, Measured]], method: str, other: str) -> str:
    """From how many to how many times the time of another a method takes, where it solves the beam."""
    ratios = [found[method].seconds / found[other].seconds for found in rows if not found[method].failure]
    least, most = (f"{limit:.1f}" for limit in (min(ratios, default=nan), max(ratios, default=nan)))
    return f"{least} times" if least == most else f"{least} to {most} times"


def _capital(name: str) -> str:
    return name[:1].upper() + name[1:]


def _kept(error: float) -> str:
    digits = max(0, int(-np.log10(error))) if error < inf else 0
    return "no digit" if digits == 0 else fmt.count(digits, "digit")


def to_csv(comparisons: Iterable[Comparison]) -> str:
    """Write everything as comma-separated values.

    Parameters
    ----------
    comparisons : iterable of Comparison
        From `families` or `scene_comparisons`.

    Returns
    -------
    str
        With all digits; times in seconds; `front` is 1 on the Pareto front.
    """
    rows = []
    for one in comparisons:
        for row, leads in zip(one.rows, front(one.rows), strict=True):
            errors = ["" if isnan(value) else value for value in (row.deflection, row.moment, row.reaction, row.error)]
            rows.append([one.beam, one.elements, row.method, *errors, row.seconds, row.solves, int(leads), row.failure])
    return csv_text(FIELDS, rows)


def to_markdown(comparisons: Sequence[Comparison], picture: str = "", remark: str = "", options: str = "") -> str:
    """Write the page of the documentation.

    Parameters
    ----------
    comparisons : sequence of Comparison
        From `families` or `scene_comparisons`.
    picture : str
        Name of the picture's file beside the page, if there is one.
    remark : str
        From `scene_comparisons`.
    options : str
        What the command was given beside the files to write.
    """
    comparisons = [replace(one, beam=literal_markdown(one.beam)) for one in comparisons]
    command = " ".join(["gapbeam study accuracy", *options.split(), "--markdown docs/accuracy.md --plot docs/accuracy.svg"])
    made = f"This page is made by `{command}`."
    lines = ["# Error against run time", "", made, "", *WORDS, "", "Methods:", "", *(f"* {line}" for line in METHODS), ""]
    if picture:
        caption = "Error against run time: one line a method, the Pareto front in circles, failures at the upper edge"
        lines += [f"![{caption}]({picture})", ""]
    lines += ["Findings:", "", *(f"* {line}" for line in findings(comparisons))] + ([remark] if remark else [])
    for name, (columns, cells) in tables(comparisons, _both).items():
        lines += ["", f"## {_capital(name)}", "", *markdown_table(columns, cells, texts=1)]
    return "\n".join(lines) + "\n"


def print_comparisons(comparisons: Sequence[Comparison], remark: str = "") -> None:
    """Print the tables.

    Parameters
    ----------
    comparisons : sequence of Comparison
        From `families` or `scene_comparisons`.
    remark : str
        From `scene_comparisons`.
    """
    from rich.console import Console

    from ..report.writer import Writer

    say = Writer(Console(highlight=False))
    say.line("Error against run time", "bold")
    for line in (*WORDS, *METHODS):
        say.line(line, "dim")
    times = tables(comparisons, _time)
    for name, (columns, cells) in tables(comparisons, _error).items():
        say.heading(_capital(name))
        say.table(["error at", *columns[1:]], cells, left=(0,))
        say.table(["time for", *columns[1:]], times[name][1], left=(0,))
    say.line()
    for line in [*findings(comparisons), *([remark] if remark else [])]:
        say.line(line)
