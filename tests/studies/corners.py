"""Studies of the program itself: what it reaches in the corners, against exact solutions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from math import inf, isnan, nan
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np
from gapbeam.base.errors import GapbeamError
from gapbeam.results import formatting as fmt
from gapbeam.results.stepping import solve
from gapbeam.scene.reading import read_scene
from gapbeam.studies.exact import Reference

from .extremes import Case, cases
from .ground_corners import ground_errors
from .page import Page

if TYPE_CHECKING:
    pass

COLUMNS = ("corner", "value", "scenes", "true error", "error bound", "time", "solves")
"""Headings of the table."""
WORDS = (
    "Every row holds the worst of its scenes.",
    "",
    "* true error: against a solution in rational numbers, relative to the largest value of its kind. Long beams use",
    "  decimals of 200 digits, or a closed form.",
    "* It covers reactions, deflections, moments and shears at all supports, loads and section changes, and in the middle",
    "  of every span.",
    '* error bound: the largest one of the certificates. "fails" means that it is less than the true error of a reaction',
    "  or of the deflection at a support.",
    "* inf: not solved, or numbers that are not finite.",
    "",
    "Some rows are ill conditioned:",
    "",
    "* Loads that cancel: their answers move about as much as the true error when the loads change in their last digits.",
    "* Curves of supports that fall nearly as steeply as the beam is stiff.",
    "* Beams that nearly only shear (EI to GA): their rotations are a small difference of two slopes.",
    "",
    "Beams on the ground (k, beta L and the rest) are compared with transfer matrices in decimals of 140 digits and more.",
    "These prove that contact is where the result says. The ends of contact (relative to the length of the beam),",
    "rotations and total soil reactions of zones count too. They are compared at loads, supports, ends of contact and",
    "half-way between them.",
)
"""What the table shows."""


@dataclass
class Row:
    """What was measured in one case: the worst of its scenes.

    Attributes
    ----------
    corner, value : str
        The case.
    scenes : int
        How many.
    error : float
        Worst true error, relative to the largest value of its kind: reactions, deflections, moments, shears. inf where
        a scene was not solved or its numbers are not finite, nan where the exact solution failed.
    bound : float
        Worst error bound of the certificates; nan where there is none.
    seconds : float
        Longest time of one scene, from the scene to the result; the fastest of three runs of each.
    solves : int
        Most linear solves for one scene.
    worst : dict
        The scene with the worst error.
    kind : str
        What was worst there, or why there is no error.
    ill_conditioned : bool
        Whether no better than the bound can be asked.
    covered : bool
        Whether the error bounds hold for reactions and deflections at supports, in every scene that has one.
    """

    corner: str
    value: str
    scenes: int
    error: float = -1.0
    bound: float = nan
    seconds: float = 0.0
    solves: int = 0
    worst: Any = None
    kind: str = ""
    ill_conditioned: bool = False
    covered: bool = True


def extremes(chosen: Iterable[Case] | None = None) -> Iterator[Row]:
    """Measure true errors in the corners.

    Parameters
    ----------
    chosen : iterable of Case, optional
        Default: all.

    Yields
    ------
    Row
        One for every case.

    Examples
    --------
    >>> from studies.extremes import cases
    >>> row = next(extremes(cases()))
    >>> row.corner, row.value, row.error < 1e-12
    ('EI beside EI', '1e-12', True)
    """
    for case in cases() if chosen is None else chosen:
        row = Row(case.corner, case.value, len(case.scenes), ill_conditioned=case.ill_conditioned)
        for scene in case.scenes:
            error, kind = _measure(row, scene, case.closed_form)
            if not error <= row.error:
                row.error, row.kind, row.worst = error, kind, scene
        yield row


def _measure(row: Row, source: dict[str, Any], closed_form) -> tuple[float, str]:
    """Error of one scene and its kind; time, solves and bound go into the row."""
    scene = read_scene(source)
    begin = perf_counter()
    try:
        with np.errstate(all="ignore"):
            result = solve(scene)
    except GapbeamError as error:
        return inf, f"refused: {error}"
    seconds = perf_counter() - begin
    for _ in range(2 if seconds < 0.1 else 0):  # the fastest of three, where that costs nothing
        begin = perf_counter()
        solve(scene)
        seconds = min(seconds, perf_counter() - begin)
    row.seconds = max(row.seconds, seconds)
    if result.status != "solved":
        return inf, f"{result.status}: {result.reason}"
    step = result.steps[-1]
    row.solves = max(row.solves, step.solves)
    bound = step.certificate.get("error_bound")
    bound = nan if bound is None else bound
    row.bound = bound if isnan(row.bound) else max(row.bound, bound)
    if scene.foundation:
        try:
            errors = ground_errors(source, result, closed_form)
        except ArithmeticError as error:
            return nan, str(error)
        row.covered = row.covered and not max(errors["deflection"], errors.get("reaction", 0.0)) > bound
        kind = max(errors, key=errors.get)
        return errors[kind], kind
    if closed_form is not None:
        truths = dict(zip(("reaction", "deflection"), closed_form(source), strict=True))
        errors = {kind: _largest_error(getattr(step, kind), truth) for kind, truth in truths.items()}
        row.covered = row.covered and not max(errors.values()) > bound
        kind = max(errors, key=errors.get)
        return errors[kind], kind
    reference = Reference(scene)
    try:
        right = reference.solve(step.state)
    except ZeroDivisionError as error:
        return nan, str(error)
    errors = {"reaction": reference.error("reaction", step.reaction)}
    errors["deflection at supports"] = reference.error("place_deflection", step.deflection, "deflection")
    row.covered = row.covered and not max(errors.values()) > bound
    with np.errstate(all="ignore"):
        for side in ("left", "right"):
            fields = result.at(reference.x, side=side)
            errors["deflection"] = reference.error("deflection", fields.deflection)
            inner = slice(1, None) if side == "left" else slice(None, -1)
            for name in ("moment", "shear"):
                errors[f"{name} {side}"] = reference.error(f"{name}_{side}", getattr(fields, name), inner=inner)
    kind = max(errors, key=errors.get)
    return errors[kind], kind if right else f"{kind} (scheme differs from the exact one)"


def _largest_error(found: np.ndarray, truth: np.ndarray) -> float:
    """Relative to the largest value; infinite where all should be zero, and are not."""
    error, size = float(np.abs(found - truth).max()), float(np.abs(truth).max())
    return error / size if size else inf if error else 0.0


def table(rows: Iterable[Row]) -> list[list[str]]:
    """Write the rows as text.

    Parameters
    ----------
    rows : iterable of Row
        From `extremes`.

    Returns
    -------
    list of list of str
        As many columns as `COLUMNS`.
    """
    return [
        [
            row.corner,
            row.value,
            str(row.scenes),
            _small(row.error),
            _small(row.bound) + ("" if row.covered else " fails"),
            fmt.duration(row.seconds),
            str(row.solves),
        ]
        for row in rows
    ]


def _small(value: float) -> str:
    return "-" if isnan(value) else "0" if value == 0.0 else f"{value:.1e}"


def values(rows: Iterable[Row]) -> list[tuple]:
    """Give the rows with all digits, times in seconds.

    Parameters
    ----------
    rows : iterable of Row
        From `extremes`.

    Returns
    -------
    list of tuple
        As many columns as `COLUMNS`, and what the largest error is in.
    """
    return [(row.corner, row.value, row.scenes, row.error, row.bound, row.seconds, row.solves, row.kind) for row in rows]


def worst(rows: list[Row]) -> str:
    """Name the largest error of all that are well conditioned.

    Parameters
    ----------
    rows : list of Row
        From `extremes`.
    """
    found = max((row for row in rows if not row.ill_conditioned), key=lambda row: inf if isnan(row.error) else row.error)
    return f"Worst of all: {_small(found.error)} ({found.corner}, {found.value}: {found.kind})."


PAGE = Page("extremes", "Accuracy in extreme cases", WORDS, COLUMNS, texts=2)
"""How the table is written and printed."""
