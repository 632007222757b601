"""How many linear solves it takes to find the contact state: reference problems from all starts, fronts, scale."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np
from gapbeam.results import formatting as fmt
from gapbeam.results.stepping import solve
from gapbeam.studies.meshes import gapped_spans

from .fronts import random_front, scaled
from .page import Page

if TYPE_CHECKING:

    from gapbeam.results.result import Result

COLUMNS = ("problem", "one-sided", "block", "single", "events", "closed", "time")
"""Headings of the table."""
WORDS = (
    "How many linear solves it takes to find the contact state:",
    "",
    "* block: by the rule `block`. With few supports it is the largest number over all starting contact states, else that",
    "  from all supports closed.",
    "* single: by the paper's rule, from all supports closed.",
    "* events: changes along the load from 0 to 1.",
    "* closed: supports closed in the end.",
    "* time: of the rule `block`, from scene to result, the fastest of 3.",
    "",
    "A warm start is the contact state of a load that is smaller by 0.1, 1 or 10 %. Solves of a part of the beam count by",
    "the part's share of it. Fronts are drawn at random: what lifts the beam, its base, the spacing of the supports.",
)
"""What the table shows."""

FRONTS = 12
"""Random fronts that are counted."""
MOST_STARTS = 4
"""Supports up to which all starting schemes are tried."""
MOST_SINGLE = 400
"""Supports up to which the rule single, one change a solve, and events are tried."""


@dataclass
class Row:
    """What was counted for one problem; None where it was not tried.

    Attributes
    ----------
    problem : str
        Its name.
    supports : int
        One-sided supports.
    block, single : int or None
        Linear solves by each rule.
    events : int or None
        Events on the path.
    closed : int
        Supports closed in the end.
    seconds : float
        Time of the rule block.
    """

    problem: str
    supports: int
    block: int
    single: int | None
    events: int | None
    closed: int
    seconds: float


def paper_beam(sides: tuple[str, str, str]) -> dict[str, Any]:
    """Reference problem P1, the paper's beam, with the sides of its three supports.

    Parameters
    ----------
    sides : tuple of str
        ``above`` or ``below`` at x = 2, 4, 6.

    Returns
    -------
    dict
        The scene.
    """
    supports = [{"node": 0, "rotation": "fixed"}, *({"node": i + 1, "side": side} for i, side in enumerate(sides))]
    forces = (0.70707, -4.3597, 2.1155)
    loads = [{"type": "force", "node": i + 1, "F": force} for i, force in enumerate(forces)]
    return {"beam": {"spans": [2.0] * 3, "EI": 44.5}, "supports": supports, "loads": loads}


def lifted_end(count: int, share: float = 1.0) -> dict[str, Any]:
    """Reference problem P2: a heavy beam on a rigid one-sided base met at many supports, one end lifted.

    Parameters
    ----------
    count : int
        Supports.
    share : float
        Share of the lifting force 1.5.

    Returns
    -------
    dict
        The scene, 20 long with weight and EI 1: with the full force a length of 3 is lifted.
    """
    return {
        "beam": {"spans": [20.0 / (count - 1)] * (count - 1), "EI": 1.0},
        "supports": [{"node": i, "side": "below"} for i in range(count)],
        "loads": [{"type": "uniform", "q": 1.0, "case": "dead"}, {"type": "force", "x": 0.0, "F": -1.5 * share}],
    }


def spans_on_laws(count: int, pieces: int = 6) -> dict[str, Any]:
    """Many equal spans on supports whose laws have pieces of random slopes, none falling.

    Parameters
    ----------
    count : int
        Spans.
    pieces : int
        Pieces of every law.

    Returns
    -------
    dict
        The scene.
    """
    rng = np.random.default_rng(7)
    force = rng.uniform(2.0, 10.0, (count - 1, 6))
    way = np.cumsum(force / rng.uniform(200.0, 20_000.0, (count - 1, 6)), axis=1)[:, :pieces].tolist()
    force = np.cumsum(force, axis=1)[:, :pieces].tolist()
    q = rng.uniform(2.0, 12.0, count).tolist()
    laws = ([list(point) for point in zip(*law, strict=True)] for law in zip(way, force, strict=True))
    inner = [{"node": i + 1, "side": "below", "law": law} for i, law in enumerate(laws)]
    return {
        "beam": {"spans": [4.0] * count, "EI": 2e4},
        "supports": [{"node": 0, "rotation": "fixed"}, *inner, {"node": count}],
        "loads": [{"type": "uniform", "from": 4.0 * j, "to": 4.0 * (j + 1), "q": q[j]} for j in range(count)],
    }


def sprung_base(count: int, share: float = 1.0) -> dict[str, Any]:
    """Reference problem P6, work B: a free beam on a one-sided foundation as springs.

    Parameters
    ----------
    count : int
        Elements; there is one support more.
    share : float
        Share of the two forces.

    Returns
    -------
    dict
        The scene.
    """
    h = 100.0 / count
    stiffness = [1e4 * h * (0.5 if i in (0, count) else 1.0) for i in range(count + 1)]
    return {
        "beam": {"spans": [h] * count, "EI": 1e5},
        "supports": [{"node": i, "side": "below", "stiffness": c} for i, c in enumerate(stiffness)],
        "loads": [
            {"type": "uniform", "q": 1.0, "case": "dead"},
            {"type": "force", "x": 50.0, "F": 500.0 * share},
            {"type": "force", "x": 30.0, "F": -60.0 * share},
        ],
    }


def _small_problems() -> Iterator[tuple[str, dict[str, Any]]]:
    for sides in (("above", "below", "below"), ("above",) * 3, ("above", "above", "below"), ("below", "above", "above")):
        signs = "".join("+" if side == "above" else "-" for side in sides)
        yield f"P1 paper's beam ({signs})", paper_beam(sides)
    own = {"type": "uniform", "q": 1.0, "case": "dead"}
    yield "P2 far end lifts", {
        "beam": {"spans": [1.0, 1.0], "EI": 1.0},
        "supports": [{"node": i, "side": "below"} for i in range(3)],
        "loads": [own, {"type": "uniform", "q": 10.0, "to": 1.0}],
    }
    stops = [{"x": x, "side": "below", "gap": 0.01} for x in (1.0, 3.0)]
    yield "P2 cantilever on stops, P = 200", {
        "beam": {"spans": [1.0] * 5, "EI": 2162.7},
        "supports": [{"node": 0, "rotation": "fixed"}, *stops],
        "loads": [{"type": "force", "x": 2.0, "F": 200.0}],
    }
    springs = [("above", 1e6, -0.009), ("below", 1e8, 0.018), ("below", 1e6, -0.012)]
    inner = [{"node": i + 1, "side": s, "stiffness": c, "gap": g} for i, (s, c, g) in enumerate(springs)]
    yield "P6 smallest cycle", {
        "beam": {"spans": [1.0] * 4, "EI": 1000.0},
        "supports": [{"node": 0}, *inner, {"node": 4}],
        "loads": [{"type": "force", "x": 1.0, "F": -80.0}, {"type": "force", "x": 2.0, "F": 35.0}],
    }
    inner = [{"node": 1, "side": "below", "stiffness": 1e5, "gap": 0.015}]
    inner += [{"node": 2, "side": "below", "stiffness": 1e6, "gap": 0.010}]
    yield "P6 tie", {
        "beam": {"spans": [1.0] * 3, "EI": 1000.0},
        "supports": [{"node": 0}, *inner, {"node": 3}],
        "loads": [{"type": "force", "x": 1.0, "F": 60.0}, {"type": "force", "x": 2.0, "F": -30.0}],
    }


def schemes(largest: int = 10_000) -> Iterator[Row]:
    """Count linear solves.

    Parameters
    ----------
    largest : int
        Supports of the largest problems.

    Yields
    ------
    Row
        One for every problem.

    Examples
    --------
    >>> row = next(schemes())
    >>> row.problem, row.block, row.single, row.closed
    ("P1 paper's beam (+--)", 3, 2, 2)
    """
    for name, scene in _small_problems():
        yield _count(name, scene)
    for count in (10, 100, 1000, 10_000):
        if count <= largest:
            yield _count(f"work A, {count:,} spans", gapped_spans(count))
    for count in (100, 1000, 10_000):
        if count <= largest:
            yield _count(f"work B, {count:,} springs", sprung_base(count))
            yield _count_warm(f"work B, {count:,} springs, warm, 10 %", sprung_base(count, 0.9), sprung_base(count))
    for count in (100, 1000, 10_000):
        if count <= largest:
            yield _count(f"lifted end, {count:,} supports", lifted_end(count))
            for less in (0.001, 0.01, 0.1):
                yield _count_warm(f"lifted end, {count:,}, warm, {less:.1%}", lifted_end(count, 1.0 - less), lifted_end(count))
    for count in (10, 100, 1000, 10_000):
        if count <= largest:
            yield _count(f"laws of 6 pieces, {count:,} spans", spans_on_laws(count))
            yield _count(f"their first pieces only, {count:,} spans", spans_on_laws(count, 1))
    for seed in range(FRONTS):
        name, scene = random_front(seed, min(largest, 10_000))
        yield _count(f"front {seed}: {name}", scene)
        for less in (0.001, 0.01, 0.1):
            yield _count_warm(f"front {seed}, warm, {less:.1%}", scaled(scene, 1.0 - less), scene)


def _timed(scene: dict[str, Any], **options: Any) -> tuple[Result, float]:
    fastest = float("inf")
    for _ in range(3):
        begin = perf_counter()
        result = solve(scene, **options)
        fastest = min(fastest, perf_counter() - begin)
    return result, fastest


def _count(name: str, scene: dict[str, Any]) -> Row:
    supports = sum(support.get("side", "both") != "both" for support in scene["supports"])
    result, seconds = _timed(scene)
    closed = sum(state not in ("open", "bilateral") for state in result.steps[-1].state)
    starts: list[Any] = [None]
    if supports <= MOST_STARTS:
        starts = list(itertools.product((False, True), repeat=supports))
    block = max(solve(scene, rule="block", start=start).steps[-1].solves for start in starts)
    single = events = None
    if supports <= MOST_SINGLE:
        single = solve(scene, rule="single").steps[-1].solves  # the paper's rule begins with all supports closed
        events = len(solve({**scene, "analysis": {"follow": "events"}}).events)
    return Row(name, supports, block, single, events, closed, seconds)


def _count_warm(name: str, before: dict[str, Any], scene: dict[str, Any]) -> Row:
    start = [state == "closed" for state in solve(before).steps[-1].state]
    result, seconds = _timed(scene, start=start)
    step = result.steps[-1]
    return Row(name, len(start), step.solves, None, None, step.state.count("closed"), seconds)


def table(rows: list[Row]) -> list[list[str]]:
    """Write the rows as text.

    Parameters
    ----------
    rows : list of Row
        From `schemes`.

    Returns
    -------
    list of list of str
        As many columns as `COLUMNS`.
    """
    return [
        [
            row.problem,
            f"{row.supports:,}",
            str(row.block),
            "-" if row.single is None else str(row.single),
            "-" if row.events is None else str(row.events),
            f"{row.closed:,}",
            fmt.duration(row.seconds),
        ]
        for row in rows
    ]


PAGE = Page("schemes", "Solves needed to find the contact state", WORDS, COLUMNS, texts=1)
"""How the table is written and printed."""
