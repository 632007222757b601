"""Work-precision diagrams of foundations and of trains: error against run time, one line a program."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite

from gapbeam.plots.save import literal
from gapbeam.studies.diagram import HIGHEST, LOWEST, decorate
from matplotlib.figure import Figure

from . import foundation as ground
from . import trains as moving

GROUND_STYLES = {
    ground.OWN: ("black", "none", "*"),
    ground.SPRINGS: ("#0072b2", "-", "o"),
    ground.PLAIN: ("#d55e00", "-", "v"),
    ground.INCREMENTAL: ("#d55e00", "--", "v"),
    ground.OPENSEES: ("#009e73", "-", "s"),
}
"""Colour (Okabe and Ito 2008), line and marker of every program beside a foundation."""
TRAIN_STYLES = {
    moving.OWN: ("black", "none", "*"),
    moving.NUMPY: ("#0072b2", "-", "o"),
    moving.REFINED: ("#0072b2", "--", "D"),
    moving.PYCBA: ("#d55e00", "-", "v"),
    moving.OPENSEES: ("#009e73", "-", "s"),
}
"""The same beside a train."""


def foundation_figure(rows: Sequence[ground.Row]) -> Figure:
    """Draw error against run time of a foundation and of springs, a row of panels for every problem.

    Parameters
    ----------
    rows : sequence of Row
        From `foundation.foundation`.

    Returns
    -------
    matplotlib.figure.Figure
        The points of a line are meshes of more and more springs; what has other zones stands on the upper edge.
    """
    kinds = (("ends", "contact ends"), ("deflection", "deflection"), ("moment", "moment"))
    return _side_by_side(rows, kinds, GROUND_STYLES)


def trains_figure(rows: Sequence[moving.Row]) -> Figure:
    """Draw error against run time of envelopes of trains, a row of panels for every problem.

    Parameters
    ----------
    rows : sequence of Row
        From `trains.trains`.

    Returns
    -------
    matplotlib.figure.Figure
        The points of a line are more and more positions.
    """
    kinds = (("moment", "moment"), ("shear", "shear"), ("most", "largest reaction"), ("least", "smallest reaction"))
    return _side_by_side(rows, kinds, TRAIN_STYLES, "time of one envelope")


def _side_by_side(
    rows: Sequence, kinds: Sequence[tuple[str, str]], styles: Mapping[str, tuple[str, str, str]], time: str = "time of one solve"
) -> Figure:
    """Draw a row of panels for every problem, a panel for every kind of error, a line for every program."""
    problems = list(dict.fromkeys(row.problem for row in rows))
    picture = Figure(figsize=(9.6, 2.9 * len(problems) + 0.5), dpi=150, layout="constrained")
    panels = picture.subplots(len(problems), len(kinds), squeeze=False, sharex=True, sharey=True)
    for line, problem in zip(panels, problems, strict=True):
        for axes, (kind, name) in zip(line, kinds, strict=True):
            for program, (color, style, marker) in styles.items():
                found = [row for row in rows if (row.problem, row.program) == (problem, program) and isfinite(row.seconds)]
                points = [(row.seconds, min(max(getattr(row, kind), LOWEST), HIGHEST)) for row in found]
                if points:
                    size = 11 if marker == "*" else 4
                    look = {"marker": marker, "color": color, "markersize": size, "linewidth": 1.2, "label": program}
                    axes.plot(*zip(*points, strict=True), linestyle=style, clip_on=False, **look)
            decorate(axes, f"{problem}: {name}", "relative error", time)
    for axes in panels.flat:
        axes.label_outer()
    lines = panels[0, 0].get_legend_handles_labels()
    picture.legend(*lines, loc="outside lower center", ncols=3, frameon=False, fontsize=8)
    return literal(picture)
