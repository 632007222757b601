"""Reaction over deflection of one support along the loading history, with the energy that it takes up in every cycle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure

from ..base.characters import with_minus_signs
from ..results import formatting as fmt
from ..results.paths.branches import BranchPath
from ..results.paths.loop import Cycle, loop_of
from ..scene.rotations import at_support
from .branches import KINK, MARKERS, Trace
from .save import literal
from .sheet import positive
from .titles import title_lines

if TYPE_CHECKING:
    from ..results.result import Result

SIZE = (5.6, 4.2)
"""Inches."""
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#000000")
"""Of cycles in turn; of Okabe and Ito, their greys differ."""
MOST_CYCLES = 12
"""Cycles whose energy is written each; of more the sum."""
SIDE_BY_SIDE = 48
"""Characters of words on a cycle of which two fit beside each other."""


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
        No state stands, or there is no such support.
    """
    loop = loop_of(result, support)
    chosen, force, movement, cycles, scene = loop.support, loop.reaction, loop.movement, loop.cycles, result.scene
    marks = Trace(result).marks if isinstance(result.path, BranchPath) else []
    picture = Figure(figsize=SIZE, dpi=200, layout="constrained")
    axes = picture.add_subplot()
    quantities = [at_support(scene, name, chosen) for name in ("deflection", "reaction")]
    factor = fmt.shown_unit(scene, quantities[0])[1]
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
    ways = [f"{name}, {positive(scene, name)}" for name in ("deflection", "reaction")]
    if scene.supports[chosen].direction == "axial":
        ways = ["displacement along the beam, positive to the right", "reaction, positive to the right"]
    elif scene.supports[chosen].direction == "rotational":
        ways = ["rotation, positive clockwise", "couple, positive counterclockwise"]
    elif scene.supports[chosen].direction == "hinge":
        ways = ["rotation left of the hinge less that right of it", "moment, positive sagging"]
    axes.set_xlabel(fmt.shown_heading(scene, quantities[0], ways[0]), fontsize=9)
    axes.set_ylabel(fmt.with_unit(scene, quantities[1], ways[1]), fontsize=9)
    axes.tick_params(labelsize=8)
    title = [*title_lines(fmt.title(scene), SIZE[0] - 1.0), fmt.support(scene, chosen)]
    axes.set_title("\n".join(title), fontsize=9, fontweight="bold", loc="left")
    if len(cycles) > MOST_CYCLES:
        total = with_minus_signs(fmt.value(scene, "moment", sum(cycle.energy for cycle in cycles), 4))
        axes.plot([], [], color=COLOURS[0], label=f"{len(cycles)} cycles: energy {total} in all")
    longest = max((len(line.get_label()) for line in axes.get_lines()), default=0)
    columns = 2 if len(cycles) > 2 and longest <= SIDE_BY_SIDE else 1
    picture.legend(loc="outside lower center", ncols=columns, fontsize=8, frameon=False)
    return literal(picture)


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
