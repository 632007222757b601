"""Axial force in bending: errors beside textbook stability functions in doubles, and run time beside no axial force."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from math import inf, nan
from time import perf_counter
from typing import Any

import numpy as np
from gapbeam.results.cases.cases import prepare
from gapbeam.results.stepping import solve
from mpmath import mp, mpf

from .page import Page

COLUMNS = ("problem", "program", "u or spans", "moment", "rotation", "ms", "times N = 0")
"""Headings of the table."""
WORDS = (
    "Two equal spans on three supports with a uniform load on the first one, under an axial force N:",
    "",
    "* u = sqrt(|N| L^2/EI) of a span, in tension, and in compression below the first Euler load (u = pi).",
    "* stability functions: slopes at the supports as unknowns, with the stiffnesses of textbooks (Livesley and Chandler",
    "  1956) as they stand there, in doubles.",
    "* moment, rotation: errors of the moment over the middle support, and of the rotation at the left end, relative to their",
    "  true values, from closed forms in 60 digits.",
    "",
    "Spans of 6 m on bearings that push up only, uniform load, under tension:",
    "",
    "* ms: the fastest of several calls of gapbeam.solve with a dict. times N = 0: over that of the same scene without N.",
    "  compressed: with a little compression, under which a state has to be proved the only one, or followed.",
    "",
    "1,000 cases of ten such spans in one call of a prepared beam, beside first order: the uniform load varies, and the axial load",
    "that bending feels is the same in all cases (in all), or varies too (by case).",
)
"""What the table shows."""
TENSIONS = (1e-6, 1e-4, 1e-2, 1.0, 10.0, 1e2, 1e3, 1e4)
COMPRESSIONS = (1e-4, 1e-2, 1.0, 3.0)
"""Parameters u."""
SPANS = (1, 10, 100, 1000)
CASE_SPANS, CASES = 10, 1000
ROUNDS = 7
"""Timings of each."""


@dataclass
class Row:
    """What one program makes of one problem.

    Attributes
    ----------
    problem, program : str
        Their names.
    size : float
        u, or the number of spans.
    moment, rotation : float
        Relative errors; not-a-number where they are not looked at.
    seconds, times : float
        Run time, and over that without an axial force; not-a-number likewise.
    """

    problem: str
    program: str
    size: float
    moment: float = nan
    rotation: float = nan
    seconds: float = nan
    times: float = nan


def axial(largest: int = SPANS[-1]) -> Iterator[Row]:
    """Measure.

    Parameters
    ----------
    largest : int
        Most spans of the timings.

    Yields
    ------
    Row
    """
    for problem, sign, parameters in (("tension", 1, TENSIONS), ("compression", -1, COMPRESSIONS)):
        for u in parameters:
            true = closed_form(u, sign)
            for program, find in (("gapbeam", by_gapbeam), ("stability functions", by_stability_functions)):
                errors = (abs(float((mpf(found) - exact) / exact)) for found, exact in zip(find(u, sign), true, strict=True))
                yield Row(problem, program, u, *(error if error == error else inf for error in errors))
    for count in (count for count in SPANS if count <= largest):
        without = _seconds(bearings(count, 0.0))
        for program, N in (("N = 0", 0.0), ("tension", 500.0), ("compressed", -1.0)):
            seconds = _seconds(bearings(count, N)) if N else without
            yield Row("bearings", program, count, seconds=seconds, times=seconds / without)
    if largest < CASE_SPANS:
        return
    without = _seconds_of_cases(-1.0, by_case=True, first_order=True)
    yield Row("1000 cases", "first order", CASE_SPANS, seconds=without, times=1.0)
    for by_case in (False, True):
        for program, N in (("tension", 500.0), ("compressed", -1.0)):
            seconds = _seconds_of_cases(N, by_case)
            yield Row("1000 cases", f"{program} {'by case' if by_case else 'in all'}", CASE_SPANS, seconds=seconds,
                      times=seconds / without)  # fmt: skip


def closed_form(u: float, sign: int) -> tuple[mpf, mpf]:
    """Moment over the middle support and rotation at the left end, for EI = L = q = 1, in many digits.

    Parameters
    ----------
    u : float
        sqrt(|N| L^2/EI).
    sign : {1, -1}
        Tension or compression.
    """
    with mp.workdps(60):
        v = mpf(u) if sign > 0 else mpf(u) * 1j
        near = (v * mp.coth(v) - 1) / v**2
        far = (1 - v / mp.sinh(v)) / v**2
        turn = (v / 2 - mp.tanh(v / 2)) / v**3
        moment = -turn / (2 * near)
        return mp.re(moment), mp.re(turn + far * moment)


def by_gapbeam(u: float, sign: int) -> tuple[float, float]:
    """The same by gapbeam; arguments as of `closed_form`."""
    supports = [{"node": k} for k in range(3)]
    loads = [{"type": "uniform", "q": 1.0, "from": 0.0, "to": 1.0}]
    result = solve({"beam": {"spans": [1.0, 1.0], "EI": 1.0, "N": sign * u * u}, "supports": supports, "loads": loads})
    return float(result.at(1.0).moment), float(result.at(0.0).rotation)


def by_stability_functions(u: float, sign: int) -> tuple[float, float]:
    """The same by slopes at the supports and textbook stiffnesses in doubles; arguments as of `closed_form`."""
    with np.errstate(all="ignore"):
        c, s = (np.cosh(u), np.sinh(u)) if sign > 0 else (np.cos(u), np.sin(u))
        divisor = 2.0 - 2.0 * c + sign * u * s
        own, carried = u * sign * (u * c - s) / divisor, u * sign * (s - u) / divisor
        # Couples that hold both ends of the loaded span, clockwise on the left one
        half = u / 2.0
        fixed = sign * (half / (np.tanh(half) if sign > 0 else np.tan(half)) - 1.0) / u**2
        stiffness = np.array([[own, carried, 0.0], [carried, 2.0 * own, carried], [0.0, carried, own]])
        try:
            turned = np.linalg.solve(stiffness, [fixed, -fixed, 0.0])
        except np.linalg.LinAlgError:
            return nan, nan
        return float(own * turned[1] + carried * turned[2]), float(turned[0])


def bearings(count: int, N: float) -> dict[str, Any]:
    """Give a scene of many spans on bearings.

    Parameters
    ----------
    count : int
        Spans.
    N : float
        Axial force.
    """
    ends = ("both", *("below" for _ in range(count - 1)), "both")
    return {
        "beam": {"spans": [6.0] * count, "EI": 1e4, "N": N},
        "supports": [{"node": k, "side": side} for k, side in enumerate(ends)],
        "loads": [{"type": "uniform", "q": 10.0}],
    }


def _seconds(scene: dict[str, Any]) -> float:
    best = inf
    for _ in range(ROUNDS):
        begin = perf_counter()
        solve(scene)
        best = min(best, perf_counter() - begin)
    return best


def _seconds_of_cases(N: float, by_case: bool, first_order: bool = False) -> float:
    scene = bearings(CASE_SPANS, 0.0)
    scene["supports"].append({"node": 0, "direction": "axial"})
    scene["loads"].append({"type": "axial", "node": CASE_SPANS, "F": N})
    prepared = prepare({**scene, "analysis": {"first_order": first_order}})
    factors = np.random.default_rng(1).uniform(0.5, 1.5, (CASES, 2))
    if not by_case:
        factors[:, 1] = 1.0
    best = inf
    for _ in range(ROUNDS):
        begin = perf_counter()
        prepared.solve(factors)
        best = min(best, perf_counter() - begin)
    return best


def table(rows: Iterable[Row]) -> list[list[str]]:
    """Write the rows as text.

    Parameters
    ----------
    rows : iterable of Row
        From `axial`.

    Returns
    -------
    list of list of str
        As many columns as `COLUMNS`.
    """
    def written(value: float, form: str) -> str:
        return "" if value != value else format(value, form)

    return [
        [
            row.problem, row.program, f"{row.size:g}", written(row.moment, ".0e"), written(row.rotation, ".0e"),
            written(1e3 * row.seconds, ".2f"), written(row.times, ".1f"),
        ]
        for row in rows
    ]  # fmt: skip


PAGE = Page("axial", "Axial force in bending: errors and times", WORDS, COLUMNS, texts=2, file="axial-study")
