"""The ways to solve a meshed beam that the studies compare, timed side by side.

All but `gapbeam.solve` are compiled and timed without Python: from plain arrays to deflections, moments and reactions of all
nodes, contact state included. `gapbeam.solve` is timed as users call it, from a scene to the fields at the same places.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf, nan
from time import perf_counter

import numpy as np
from msgspec import structs

from .. import _yardsticks
from ..base.errors import GapbeamError, Status, check_status
from ..engine.calls import interruptible
from ..results.stepping import solve
from ..scene.analysis import Analysis
from .meshes import MeshedBeam
from .truth import Truth, error

CONDENSED, KERNEL, KERNEL_REFINED = "condensed mixed", "fused kernel", "fused kernel + 1"
DISPLACEMENT, INCREMENTAL = "displacement", "displacement, incremental"
"""Names that other modules ask for."""
SHORTEST = 4e-3
"""Seconds that one timing takes at least: short solves are repeated."""
ROUNDS = 5
"""Timings of every method, taken in turn; the fastest counts."""
SLOW = 0.3
"""Solves that take longer are timed twice only."""
MOST_EVENTS = 10_000
"""One-sided supports up to which events are followed."""
FLOOR = 2.0**-51
"""Errors below this one are equal: the answers themselves are rounded to half of it."""
USELESS = 0.1
"""Answers with larger errors have no digit right, and no place on the Pareto front."""
WHY = {1: "singular", 2: "no scheme"}
"""What became of a beam that a compiled method did not solve, as in yardstick_beam."""


@dataclass(frozen=True)
class Answer:
    """Deflections, moments and reactions (None where a method gives none) at all nodes; schemes solved; why it failed."""

    deflection: np.ndarray
    moment: np.ndarray
    reaction: np.ndarray | None
    closed: np.ndarray
    solves: int
    failure: str = ""


@dataclass(frozen=True)
class Method:
    """A way to solve a beam.

    Attributes
    ----------
    name : str
        As tables and pictures call it.
    run : callable
        Solves a beam as often as told, and answers.
    fits : callable
        Whether it can solve a beam.
    """

    name: str
    run: Callable[[MeshedBeam, int], Answer]
    fits: Callable[[MeshedBeam], bool] = lambda beam: True


@dataclass
class Measured:
    """What one method reached on one beam.

    Attributes
    ----------
    method : str
        Its name.
    deflection, moment, reaction : float
        Largest errors, relative to the largest true value of the kind; inf where it failed, nan where it gives none.
    seconds : float
        For one beam.
    solves : int
        Linear solves, refinement not counted.
    failure : str
        Why it failed, else empty.
    """

    method: str
    deflection: float
    moment: float
    reaction: float
    seconds: float
    solves: int
    failure: str = ""

    @property
    def error(self) -> float:
        """The largest of the three."""
        return float(np.nanmax([self.deflection, self.moment, self.reaction]))


def yardstick(name: str, number: int, refinements: int = 0, precise: bool = False, reactions: bool = True) -> Method:
    """Make a compiled method of gapbeam._yardsticks.

    Parameters
    ----------
    name : str
        Its name.
    number : int
        0 nodal mixed by the engine's elimination, 1 by dgbsv, 2 displacement, 3 incremental, 4 condensed mixed.
    refinements : int
        Steps of iterative refinement of the nodal mixed ones.
    precise : bool
        Whether the residuals are in double-double, or else in plain double with differences first.
    reactions : bool
        Whether reactions are wanted; mixed methods can leave them out where no support is one-sided.
    """
    solve = interruptible(_yardsticks.ysbeam, lambda method, refine, precise, reactions, length, *_: len(length))

    def run(beam: MeshedBeam, repeat: int) -> Answer:
        w, m, r, closed, solves, status = solve(
            number, refinements, precise, reactions, beam.length, beam.EI, beam.q, beam.side, beam.stiffness, beam.level,
            beam.force, *beam.clamped, repeat,
        )  # fmt: skip
        return Answer(w, m, r, closed != 0, solves, WHY.get(status, ""))

    return Method(name, run)


def kernel(refinements: int = 0) -> Method:
    """Make the method of the engine's fused kernel: linear beams, their ends supported, supports at level 0.

    Parameters
    ----------
    refinements : int
        Steps of refinement.
    """
    solve = interruptible(_yardsticks.yskern, lambda length, *_: len(length))

    def run(beam: MeshedBeam, repeat: int) -> Answer:
        w, m, status = solve(beam.length, beam.EI, beam.q, beam.stiffness, beam.force, refinements, repeat)
        if status == Status.NO_MEMORY:
            check_status(status)
        return Answer(w, m, None, beam.stiffness > 0.0, 1, WHY[1] if status else "")

    def fits(beam: MeshedBeam) -> bool:
        supported = beam.elements > 1 and min(beam.stiffness[[0, -1]]) > 0.0
        return bool(supported and not (beam.one_sided or np.any(beam.level) or any(beam.clamped)))

    return Method(KERNEL_REFINED if refinements else KERNEL, run, fits)


def from_scene(name: str, **analysis) -> Method:
    """Make a method that calls `gapbeam.solve`.

    Parameters
    ----------
    name : str
        Its name.
    **analysis
        Options of the scene's analysis.
    """

    def run(beam: MeshedBeam, repeat: int) -> Answer:
        scene = structs.replace(beam.scene, analysis=Analysis(**analysis))
        for _ in range(repeat):
            result = solve(scene)
            if result.status != "solved":
                return Answer(*[np.full(len(beam.x), nan)] * 3, beam.stiffness > 0.0, 0, result.status)
            fields = result.at(beam.x)
            step = result.steps[-1]
        moment = fields.moment.copy()
        moment[-1] = result.at(beam.x[-1:], side="left").moment[0]
        reaction, closed = np.zeros(len(beam.x)), np.zeros(len(beam.x), bool)
        nodes = np.flatnonzero(beam.stiffness > 0.0)
        reaction[nodes] = step.reaction[beam.supports]
        closed[nodes] = (np.array(step.state) != "open")[beam.supports]
        return Answer(fields.deflection, moment, reaction, closed, result.solves)

    def fits(beam: MeshedBeam) -> bool:
        return beam.scene is not None and (analysis.get("follow") != "events" or beam.one_sided <= MOST_EVENTS)

    return Method(name, run, fits)


def methods() -> list[Method]:
    """All of them, those of the engine first."""
    return [
        yardstick(CONDENSED, 4),
        kernel(),
        kernel(1),
        yardstick("nodal mixed", 0),
        yardstick("nodal mixed + 1", 0, 1),
        yardstick("nodal mixed + 2", 0, 2),
        yardstick("nodal mixed + 1 dd", 0, 1, True),
        yardstick("dgbsv", 1),
        yardstick("dgbsv + 1", 1, 1),
        yardstick("dgbsv + 2", 1, 2),
        yardstick(DISPLACEMENT, 2),
        yardstick(INCREMENTAL, 3),
        from_scene("gapbeam.solve"),
        from_scene("gapbeam.solve, 10 steps", steps=10),
        from_scene("gapbeam.solve, 100 steps", steps=100),
        from_scene("gapbeam.solve, events", follow="events"),
    ]


def compare(beam: MeshedBeam, truth: Truth, chosen: Sequence[Method]) -> list[Measured]:
    """Solve a beam by several methods, in turn.

    Parameters
    ----------
    beam : MeshedBeam
    truth : Truth
        Its true answer.
    chosen : sequence of Method
        Those that do not fit are left out.

    Returns
    -------
    list of Measured
        In the same order.
    """
    chosen = [method for method in chosen if method.fits(beam)]
    rows, repeats = [], []
    for method in chosen:
        begin = perf_counter()
        answer = _attempt(method, beam)
        seconds = perf_counter() - begin
        rows.append(_judge(method.name, answer, truth, seconds))
        repeats.append(max(1, round(SHORTEST / seconds)))
    for turn in range(ROUNDS):
        for method, row, repeat in zip(chosen, rows, repeats, strict=True):
            if row.failure or (turn > 1 and row.seconds > SLOW):
                continue
            begin = perf_counter()
            method.run(beam, repeat)
            row.seconds = min(row.seconds, (perf_counter() - begin) / repeat)
    return rows


def _attempt(method: Method, beam: MeshedBeam) -> Answer:
    try:
        return method.run(beam, 1)
    except GapbeamError as error:
        nothing = np.full(beam.elements + 1, nan)
        return Answer(nothing, nothing, nothing, beam.stiffness > 0.0, 0, str(error))


def _judge(name: str, answer: Answer, truth: Truth, seconds: float) -> Measured:
    if answer.failure:
        return Measured(name, inf, inf, inf, seconds, answer.solves, answer.failure)
    return Measured(
        name,
        error(answer.deflection, truth.deflection),
        error(answer.moment, truth.moment),
        nan if answer.reaction is None else error(answer.reaction, truth.reaction),
        seconds,
        answer.solves,
    )


def front(rows: Sequence[Measured]) -> list[bool]:
    """Find the Pareto front: methods than which no other one is both faster and more accurate.

    Parameters
    ----------
    rows : sequence of Measured
        Of one beam.

    Examples
    --------
    >>> def row(error, seconds):
    ...     return Measured("", error, 0.0, 0.0, seconds, 1)
    >>> front([row(3e-15, 3.0), row(1e-10, 1.0), row(1e-10, 2.0)])
    [True, True, False]
    """
    costs = [(max(row.error, FLOOR), row.seconds) for row in rows]
    return [a < USELESS and not any(b <= a and t <= s and (b, t) != (a, s) for b, t in costs) for a, s in costs]
