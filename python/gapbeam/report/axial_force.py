"""Axial forces in bending in the report: where they act, what they change, factors of buckling, frequencies."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from ..base.errors import EngineError, SceneError
from ..base.hints import few
from ..results import formatting as fmt
from ..results.answer import is_one_of_several
from ..results.equilibrium import acting_axial_forces, axial_forces, feels_axial_force
from ..results.stepping import solve
from ..scene.ground_laws import any_falls

if TYPE_CHECKING:
    from ..results.result import Result
    from ..results.state.step import Step
    from .writer import Writer

MOST_STRETCHES = 4
"""Stretches with an axial force of their own that are named."""
MOST_PIECES = 10_000
"""Of a beam that is solved again without its axial forces."""
MOST_ROWS = 24
"""Combinations whose modes are listed."""
MOST_MODES = 10
"""Values of modes that are listed."""
MOST_POINTS = 17
"""Of the mode in which a beam buckles."""
TURNS = 2.0 * math.pi
"""Radians of a turn."""


def write_axial_force(say: Writer, result: Result, at: str) -> None:
    """Print what axial forces do to bending, and modes.

    Parameters
    ----------
    say : Writer
        Where to write.
    result : Result
        Of one load, with a state.
    at : str
        Which state it is.
    """
    analysis = result.scene.analysis
    if feels_axial_force(result):
        say.heading(f"Axial force in bending {at}")
        say.line(axial_forces_in_words(result, result.steps[-1]))
        say.line("shear = dM/dx, normal to the deflected axis: sections are designed for it. transverse = shear + N w': loads and "
                 "reactions balance it.", "dim")  # fmt: skip
        if words := _beside_first_order(result):
            say.line(words)
    elif analysis.buckling or analysis.frequencies:
        say.heading(f"Modes {at}")
    if analysis.buckling:
        say.line(_buckling_in_words(result))
    if analysis.frequencies and not (analysis.buckling and isinstance(_values(result, "buckling"), str)):
        _frequencies(say, result)


def write_modes_of_combinations(say: Writer, result: Result) -> None:
    """Print modes of combinations, and which of their states are not known to be the only ones.

    Parameters
    ----------
    say : Writer
        Where to write.
    result : CombinedResult
        What `gapbeam.solve` returned.
    """
    analysis = result.scene.analysis
    solved = [name for name, status in zip(result.names, result.statuses, strict=True) if status == "solved"]
    falling = any_falls(result.scene.foundation)
    if not solved or not (analysis.buckling or analysis.frequencies or result._beam.has_axial_force or falling):
        return
    several = [name for name in solved[:MOST_ROWS] if is_one_of_several(result.combinations[name])]
    if analysis.buckling or analysis.frequencies:
        say.heading("Modes")
        asked = [name for name in ("buckling", "frequencies") if getattr(analysis, name)]
        rows = [[name, *(_listed(_values(result.combinations[name], of)) for of in asked)] for name in solved[:MOST_ROWS]]
        heads = {"buckling": "buckling factors of all N", "frequencies": "frequencies [rad per unit of time]"}
        say.table(["", *(heads[of] for of in asked)], rows, left=tuple(range(1 + len(asked))))
        if len(solved) > MOST_ROWS:
            say.line(f"{len(solved) - MOST_ROWS:,} more are in the output of --json.", "dim")
    if several:
        where = "On ground whose force falls" if falling else "Under compression"
        say.line(f"{where} other stable states are not excluded in {', '.join(several)}.", "red")


def axial_forces_in_words(result: Result, step: Step | None) -> str:
    """Say where which axial force acts.

    Parameters
    ----------
    result : Result
        Of one load, with axial forces that bending feels.
    step : Step or None
        The state; None: the beam buckles.

    Returns
    -------
    str
        Sentences.
    """
    scene = result.scene
    of_loads = "Forces of axial loads, temperatures and settlements act on bending (second order)."
    if scene.analysis.stretching:
        of_loads = f"{of_loads} What deflections lengthen the beam by pulls it (stretching)."
    if result._beam.feels_axial_loads and step is None:
        return of_loads
    runs = axial_forces(scene) if step is None else acting_axial_forces(result, step)
    ends = "all along the beam" if len(runs) == 1 else ""
    texts = [
        " to ".join(
            f"{fmt.value(scene, 'axial_force', N)}{'' if not N else ' (tension)' if N > 0.0 else ' (compression)'}"
            for N in ((run.left,) if run.left == run.right else (run.left, run.right))
        )
        + (f" {ends}" if ends else f" from x = {fmt.number(run.from_, fmt.DIGITS)} to {fmt.number(run.to, fmt.DIGITS)}")
        for run in runs[:MOST_STRETCHES]
    ]
    growth = "It grows with the load factor" if scene.analysis.N_with == "live" else "It acts in full at every load factor"
    more = f"; and so on, {len(runs)} stretches" if len(runs) > MOST_STRETCHES else ""
    return f"N = {'; '.join(texts)}{more}. {of_loads if result._beam.feels_axial_loads else growth + '.'}"


def some_of(motion: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Choose some points of a mode, with the one that moves most.

    Parameters
    ----------
    motion : list of (float, float)
        Places and deflections.
    """
    last = len(motion) - 1
    most = max(range(len(motion)), key=lambda k: abs(motion[k][1]))
    chosen = {round(k * last / (MOST_POINTS - 1)) for k in range(MOST_POINTS)} | {most}
    return [motion[k] for k in sorted(chosen)]


def _beside_first_order(result: Result) -> str:
    """Compare the largest moment with that without axial forces; empty where that is not cheap, or not there."""
    step = result.steps[-1]
    if not result.stands or result.scene.trains or step.factor != 1.0 or result.depends_on_path:
        return ""
    if result._beam.pieces > MOST_PIECES:
        return ""
    data = result.scene.to_dict()
    data["beam"]["N"], data["analysis"] = 0.0, {"rule": result._rule, "first_order": True}
    sections = [{name: value for name, value in one.items() if name != "N"} for one in data.get("sections", ())]
    data["sections"] = [one for one in sections if {*one} - {"from", "to"}]
    data.pop("combinations", None)
    try:
        first = solve(data)
    except (SceneError, EngineError):
        return ""
    here = _largest_moment(step)
    if first.status != "solved":
        return f"Largest |moment| {fmt.value(result.scene, 'moment', here)}. Without N there is no equilibrium."
    there = _largest_moment(first.steps[-1])
    share = f", {here / there:.3g} times that" if there else ""
    words = [fmt.value(result.scene, "moment", value) for value in (here, there)]
    return f"Largest |moment| {words[0]}{share} of first order (N = 0), {words[1]}." if there else ""


def _largest_moment(step: Step) -> float:
    return max(abs(one.value) for one in step.extremes["moment"].values())


def _values(result: Result, of: str) -> tuple[float, ...] | str:
    """Values of modes, or why there are none."""
    try:
        return getattr(result, of)
    except EngineError as error:
        return str(error)


def _listed(values: tuple[float, ...] | str) -> str:
    if isinstance(values, str):
        return values
    return few(map(fmt.number, values), MOST_MODES) or "none"


def _buckling_in_words(result: Result) -> str:
    values = _values(result, "buckling")
    if isinstance(values, str):
        return fmt.sentence(values)
    if not values:
        return "Buckling factors: none, whatever all N are multiplied by."
    return f"Buckling factors: {_listed(values)} times all N, with the supports and the ground that act here."


def _frequencies(say: Writer, result: Result) -> None:
    values = _values(result, "frequencies")
    if isinstance(values, str):
        say.line(fmt.sentence(values))
    elif not values:
        say.line("Frequencies: none. Does the beam have a mass?")
    else:
        say.line(f"Frequencies omega: {_listed(values)} rad per unit of time, with the supports and the ground that act here;")
        say.line(f"f = omega/2pi: {_listed(tuple(value / TURNS for value in values))} per unit of time.")
        mode = result.mode("vibration")
        if mode.support is not None:
            does = "closes" if result.steps[-1].state[mode.support] == "open" else "opens"
            amplitude = fmt.value(result.scene, "deflection", mode.amplitude)
            say.line(f"The first mode {does} {fmt.support(result.scene, mode.support)} from an amplitude of {amplitude} on.")
