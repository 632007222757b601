"""Reaction over deflection of one support along the loading history, with the energy that it takes up in every cycle."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure

from ..base.characters import with_minus_signs
from ..base.hints import no_such
from ..results import formatting as fmt
from ..results.paths.branches import BranchPath
from ..scene.names import labels
from ..scene.wording import shown
from .branches import KINK, MARKERS, Trace
from .panels import cut_text
from .save import literal
from .sheet import positive

if TYPE_CHECKING:
    from ..results.result import Result
    from ..results.state.step import Step

SIZE = (5.6, 4.2)
"""Inches."""
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#000000")
"""Of cycles in turn; of Okabe and Ito, their greys differ."""
MOST_CYCLES = 12
"""Cycles whose energy is written each; of more the sum."""
SIDE_BY_SIDE = 48
"""Characters of words on a cycle of which two fit beside each other."""
ROUNDING = 1e-12
"""Share of what goes in and out of a cycle below which what stays in it is rounding."""
FINE = 200
"""States about along a path that is not kept as segments."""


class Cycle(NamedTuple):
    """A cycle of the load: to a factor of its history and back to the next, or what is left at the end.

    Attributes
    ----------
    points : slice
        Of the states.
    legs : tuple of int
        Which factors of the history are gone to.
    energy : float
        What the support takes up: its reaction times its movement, summed up (force times length).
    closed : bool
        Whether the load comes back.
    """

    points: slice
    legs: tuple[int, ...]
    energy: float
    closed: bool


def hysteresis_figure(result: Result, support: int | str | None = None) -> Figure:
    """Draw the reaction of a support over its deflection, with the energy that it takes up in every cycle of the load.

    Parameters
    ----------
    result : Result
        What `gapbeam.solve` returned; best with ``follow = "events"`` and a ``history``.
    support : int or str, optional
        Number or name; default the one that takes up most energy.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    ValueError
        No state stands, there is no such support, or it is one along the axis.
    """
    if result.combinations:
        raise ValueError("every combination has a way of the load of its own; draw one of them, result.combinations[NAME]")
    if not result.steps:
        raise ValueError(f"there is nothing to draw: {result.reason}")
    states, legs, marks = _way(result)
    scene = result.scene
    reaction, deflection = (np.array([getattr(state, name) for state in states]) for name in ("reaction", "deflection"))
    across = [k for k, one in enumerate(scene.supports) if one.direction == "normal"]
    if support is None and across:
        chosen = max(across, key=lambda k: (abs(_energy(reaction[:, k], deflection[:, k])), float(np.abs(reaction[:, k]).max())))
    else:
        chosen = _number(result, support, across)
    force, movement = reaction[:, chosen], deflection[:, chosen]
    cycles = find_cycles(force, movement, legs)
    picture = Figure(figsize=SIZE, dpi=200, layout="constrained")
    axes = picture.add_subplot()
    factor = fmt.shown_unit(scene, "deflection")[1]
    for number, cycle in enumerate(cycles):
        colour = COLOURS[number % len(COLOURS)]
        axes.plot(factor * movement[cycle.points], force[cycle.points], color=colour, linewidth=1.5, zorder=3,
                  label=_words(result, cycle, number) if len(cycles) <= MOST_CYCLES else None)  # fmt: skip
        _arrows(axes, factor * movement[cycle.points], force[cycle.points], colour)
    for point, k, what in marks:
        if k == chosen:
            marker, face = MARKERS.get(what, KINK)
            axes.plot(factor * movement[point], force[point], marker, color="black", markerfacecolor=face, markersize=4.5, zorder=4)
    axes.axhline(0.0, color="black", linewidth=0.7)
    axes.axvline(0.0, color="black", linewidth=0.7)
    axes.grid(True, color="0.9", linewidth=0.6)
    axes.spines[["top", "right"]].set_visible(False)
    axes.set_xlabel(fmt.shown_heading(scene, "deflection", f"deflection, {positive(scene, 'deflection')}"), fontsize=9)
    axes.set_ylabel(fmt.with_unit(scene, "reaction", f"reaction, {positive(scene, 'reaction')}"), fontsize=9)
    axes.tick_params(labelsize=8)
    axes.set_title(f"{cut_text(fmt.title(scene), 60)}\n{fmt.support(scene, chosen)}", fontsize=9, fontweight="bold", loc="left")
    if len(cycles) > MOST_CYCLES:
        total = with_minus_signs(fmt.value(scene, "moment", sum(cycle.energy for cycle in cycles), 4))
        axes.plot([], [], color=COLOURS[0], label=f"{len(cycles)} cycles: energy {total} in all")
    longest = max((len(line.get_label()) for line in axes.get_lines()), default=0)
    columns = 2 if len(cycles) > 2 and longest <= SIDE_BY_SIDE else 1
    picture.legend(loc="outside lower center", ncols=columns, fontsize=8, frameon=False)
    return literal(picture)


def find_cycles(force: np.ndarray, movement: np.ndarray, legs: np.ndarray) -> list[Cycle]:
    """Cut the loading history into cycles: two factors of its history each.

    Parameters
    ----------
    force, movement : numpy.ndarray
        Reaction and deflection of a support, state by state.
    legs : numpy.ndarray of int
        Which factor of the history each state is on the way to, ascending.
    """
    there = np.unique(legs).tolist()
    found = []
    for first in range(0, len(there), 2):
        pair = tuple(there[first : first + 2])
        which = np.flatnonzero(np.isin(legs, pair))
        begin = max(int(which[0]) - 1, 0)  # from where the one before ended
        points = slice(begin, int(which[-1]) + 1)
        found.append(Cycle(points, pair, _energy(force[points], movement[points]), len(pair) == 2))
    return found


def _energy(force: np.ndarray, movement: np.ndarray) -> float:
    """Sum up reaction times movement; exact where the force is linear from state to state, and 0 where it is but rounding."""
    parts = (force[1:] + force[:-1]) / 2 * np.diff(movement)
    energy = float(parts.sum())
    return energy if abs(energy) > ROUNDING * np.abs(parts).sum() else 0.0


def _way(result: Result) -> tuple[list[Step], np.ndarray, list]:
    """Give the states in the order of the path, the leg of each, and what is marked."""
    if isinstance(result.path, BranchPath):
        trace = Trace(result)
        legs = np.zeros(len(trace.states), dtype=int)
        for segment, (first, last) in zip(result.path.segments, trace.spans, strict=True):
            legs[first : last + 1] = segment.leg
        legs[trace.spans[-1][1] + 1 :] = legs[trace.spans[-1][1]]
        return trace.states, legs, trace.marks
    if result.segments:
        ends = [0.0, *sorted({segment.stop for segment in result.segments})]
        between = [a + (b - a) * share for a, b in pairwise(ends) for share in np.linspace(0.0, 1.0, max(2, FINE // len(ends)))]
        states = [result.state(factor) for factor in dict.fromkeys(between)]
        return states, np.zeros(len(states), dtype=int), []
    states = list(result.steps)
    rises = np.sign(np.diff([0.0, *(state.factor for state in states)]))
    return states, np.concatenate(([0], np.cumsum(rises[1:] * rises[:-1] < 0.0))).astype(int), []


def _number(result: Result, support: Any, across: list[int]) -> int:
    """Find a support by its number or its name."""
    names = labels(result.scene.supports)
    if support in names:
        support = names.index(support)
    if isinstance(support, str):
        raise ValueError(no_such("support", support, names))
    if not isinstance(support, int | np.integer) or isinstance(support, bool) or not -len(names) <= support < len(names):
        raise ValueError(f"support: expected a number below {len(names)} or a name, got {shown(support)}")
    chosen = range(len(names))[support]
    if chosen not in across:
        raise ValueError(f"support: {names[chosen]} acts along the axis; give one across the beam")
    return chosen


def _words(result: Result, cycle: Cycle, number: int) -> str:
    """Name a cycle with its energy."""
    history = [*result.scene.analysis.history]
    energy = with_minus_signs(fmt.value(result.scene, "moment", cycle.energy, 4))
    if not history:
        return f"to load factor {fmt.number(result.steps[-1].factor, 4)}: energy {energy}"
    legs = [leg for leg in cycle.legs if 0 <= leg < len(history)]
    begin = history[legs[0] - 1] if legs and legs[0] else 0.0
    way = with_minus_signs(" to ".join(fmt.number(factor, 4) for factor in (begin, *(history[leg] for leg in legs))))
    return f"{'cycle' if cycle.closed else 'part'} {number + 1} (load factor {way}): energy {energy}"


def _arrows(axes: Any, x: np.ndarray, y: np.ndarray, colour: str) -> None:
    """Show which way the cycle is gone through, at its longest stretches."""
    size = np.hypot(np.diff(x) / (np.ptp(x) or 1.0), np.diff(y) / (np.ptp(y) or 1.0))
    for k in np.argsort(-size)[:3].tolist():
        if size[k] > 0.15 or (len(size) > 20 and size[k] > 0.0):
            start, stop = ((x[k] + share * (x[k + 1] - x[k]), y[k] + share * (y[k + 1] - y[k])) for share in (0.5, 0.53))
            look = {"arrowstyle": "-|>", "linewidth": 0.0, "color": colour, "mutation_scale": 12.0, "shrinkA": 0.0, "shrinkB": 0.0}
            axes.annotate("", stop, start, arrowprops=look, zorder=4)
