"""Work-precision diagrams: error against run time, one line a method (Hairer, Norsett and Wanner 1993)."""

from __future__ import annotations

import os
from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator

from ..plots.save import literal, save
from .accuracy import Comparison
from .methods import front

STYLES = {
    "condensed mixed": ("black", "-", "o"),
    "fused kernel": ("#0072b2", "-", "D"),
    "fused kernel + 1": ("#0072b2", "--", "D"),
    "nodal mixed": ("#56b4e9", "-", "s"),
    "nodal mixed + 1": ("#56b4e9", "--", "s"),
    "nodal mixed + 2": ("#56b4e9", ":", "s"),
    "nodal mixed + 1 dd": ("#009e73", "--", "s"),
    "dgbsv": ("#e69f00", "-", "^"),
    "dgbsv + 1": ("#e69f00", "--", "^"),
    "dgbsv + 2": ("#e69f00", ":", "^"),
    "displacement": ("#d55e00", "-", "v"),
    "displacement, incremental": ("#d55e00", "--", "v"),
    "gapbeam.solve": ("0.35", "-", "x"),
    "gapbeam.solve, 10 steps": ("0.35", "--", "x"),
    "gapbeam.solve, 100 steps": ("0.35", ":", "x"),
    "gapbeam.solve, events": ("#cc79a7", "-", "x"),
}
"""Colour (Okabe and Ito 2008), line and marker of every method."""
LOWEST, HIGHEST = 3e-17, 4.0
"""Errors shown; those beyond stand on the edge."""


def plot_accuracy(comparisons: Sequence[Comparison], path: str | os.PathLike) -> None:
    """Draw error against run time into a file.

    Parameters
    ----------
    comparisons : sequence of Comparison
        From `accuracy.families` or `scene_comparisons`.
    path : str or os.PathLike
        The suffix decides on the format: .png, .pdf or .svg.
    """
    save(accuracy_figure(comparisons), path)


def accuracy_figure(comparisons: Sequence[Comparison]) -> Figure:
    """Draw error against run time, a panel for every family of beams.

    Parameters
    ----------
    comparisons : sequence of Comparison
        From `accuracy.families` or `scene_comparisons`.

    Returns
    -------
    matplotlib.figure.Figure
        The points of a line are meshes of more and more elements; the last panel holds the legend.
    """
    names = list(dict.fromkeys(comparison.beam for comparison in comparisons))
    columns = min(3, len(names) + 1)
    rows = -(-(len(names) + 1) // columns)
    widths = [5.2, 2.4] if len(names) == 1 else [3.3] * columns  # the legend needs less than a panel
    picture = Figure(figsize=(sum(widths) + 0.3, 3.4 * rows), dpi=150, layout="constrained")
    panels = picture.subplots(rows, columns, squeeze=False, width_ratios=widths).ravel()
    for axes, name in zip(panels, names, strict=False):
        _panel(axes, name, [comparison for comparison in comparisons if comparison.beam == name])
    for axes in panels[len(names) :]:
        axes.set_axis_off()
    lines = {str(line.get_label()): line for axes in panels for line in axes.get_lines()}
    order = [name for name in STYLES if name in lines]
    legend = panels[len(names)].legend(
        [lines[name] for name in order], order, loc="center left", frameon=False, fontsize=8, title="method (circled: Pareto front)"
    )
    legend.get_title().set_fontsize(8)
    return literal(picture)


def _panel(axes: Axes, name: str, members: Sequence[Comparison]) -> None:
    """One family: a line for every method, a point for every mesh, circles around the Pareto front of each mesh."""
    found: dict[str, list[tuple[float, float]]] = {}
    leading = []
    for member in members:
        for row, leads in zip(member.rows, front(member.rows), strict=True):
            point = (row.seconds, min(max(row.error, LOWEST), HIGHEST))
            found.setdefault(row.method, []).append(point)
            if leads:
                leading.append(point)
    axes.plot(*zip(*leading, strict=True), "o", color="black", fillstyle="none", markersize=9, markeredgewidth=0.6)
    for method, points in found.items():
        color, line, marker = STYLES[method]
        axes.plot(*zip(*points, strict=True), line, marker=marker, color=color, linewidth=1.2, markersize=4, label=method)
    sizes = [member.elements for member in members]
    span = f"{sizes[0]:,} to {sizes[-1]:,} elements" if len(sizes) > 1 else f"{sizes[0]:,} elements"
    decorate(axes, f"{name}: {span}", "largest relative error")


def decorate(axes: Axes, title: str, error: str, time: str = "time of one solve") -> None:
    """Make axes those of error over run time.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        The panel.
    title : str
        Its heading.
    error, time : str
        What stands beside its axes.
    """
    axes.set_title(title, fontsize=9, loc="left")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_ylim(LOWEST / 2, HIGHEST * 2)
    axes.set_yticks([10.0**k for k in range(-16, 1, 4)])
    axes.xaxis.set_major_locator(LogLocator(numticks=6))
    axes.minorticks_off()
    axes.xaxis.set_major_formatter(lambda seconds, _: _time(seconds))
    axes.yaxis.set_major_formatter(lambda error, _: f"{error:.0e}" if error < 1.0 else "1")
    axes.set_xlabel(time, fontsize=8)
    axes.set_ylabel(error, fontsize=8)
    axes.tick_params(labelsize=8)
    axes.grid(True, color="0.92", linewidth=0.6)
    for spine in ("top", "right"):
        axes.spines[spine].set_visible(False)


def _time(seconds: float) -> str:
    unit, name = next((pair for pair in ((1.0, "s"), (1e-3, "ms")) if seconds > 0.99 * pair[0]), (1e-6, "us"))
    return f"{seconds / unit:g} {name}"
