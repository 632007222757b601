"""The diagram of one field alone, for a page of the user's own."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..engine.quantities import QUANTITIES
from ..results import formatting as fmt
from ..results.views.extreme import KINDS
from .panels import PANELS, WIDTH
from .save import literal
from .titles import SIZE, title_lines

if TYPE_CHECKING:
    from ..results.result import Result
    from ..results.views.columns import Columns
    from ..scene.structs import Scene

HEIGHT = 2.6
"""Inches of a picture of its own."""
POINTS, POINTS_ALL = 20, 400
"""Divisions of a span, and of a beam, at least: so many that no corners are seen."""


def draw_diagram(result: "Result", quantity: str, axes: Axes | None = None) -> Figure:
    """Draw one field along the beam; of combinations and trains its largest and smallest values.

    Parameters
    ----------
    result : Result
        What `gapbeam.solve` returned.
    quantity : str
        Name of the field.
    axes : matplotlib.axes.Axes, optional
        Where to; default a figure of its own.

    Returns
    -------
    matplotlib.figure.Figure
        That of the axes.
    """
    if result.combinations or result.scene.trains:
        return draw_table(result.scene, result.table("fields"), quantity, axes)
    fields = result.fields(points=max(POINTS, POINTS_ALL // len(result.scene.beam.spans)))
    return _draw(result.scene, quantity, fields.x, [getattr(fields, quantity)], axes)


def draw_table(scene: "Scene", table: "Columns", quantity: str, axes: Axes | None = None) -> Figure:
    """Draw the largest and smallest values of a field along the beam.

    Parameters
    ----------
    scene : Scene
    table : Columns
        Table of fields of an envelope, a train or cases.
    quantity : str
        Name of the field.
    axes : matplotlib.axes.Axes, optional
        Where to; default a figure of its own.

    Returns
    -------
    matplotlib.figure.Figure
        That of the axes.
    """
    return _draw(scene, quantity, table["x"], [table[f"{quantity}_{kind}"] for kind in KINDS], axes)


def draw_tables(scene: "Scene", table: "Columns", title: str) -> Figure:
    """Draw the largest and smallest values of all fields along the beam, under one another.

    Parameters
    ----------
    scene : Scene
    table : Columns
        As for `draw_table`.
    title : str
        What stands above.
    """
    names = [name for name, *_ in PANELS if f"{name}_max" in table]
    picture = Figure(figsize=(WIDTH, 0.4 + HEIGHT * len(names) * 0.8), dpi=200, layout="constrained")
    picture.suptitle("\n".join(title_lines(title)), fontsize=SIZE, fontweight="bold", x=0.01, ha="left")
    for axes, name in zip(np.ravel(picture.subplots(len(names), squeeze=False, sharex=True)), names, strict=True):
        draw_table(scene, table, name, axes)
        axes.label_outer()
    return literal(picture)


def _draw(scene: "Scene", quantity: str, x: np.ndarray, rows: list[np.ndarray], axes: Axes | None) -> Figure:
    own = axes is None
    if own:
        axes = Figure(figsize=(WIDTH, HEIGHT), dpi=200, layout="constrained").add_subplot()
    below = rows[1] if len(rows) > 1 else 0.0
    axes.fill_between(x, below, rows[0], color="0.9", linewidth=0)
    for values in rows:
        axes.plot(x, values, color="black", linewidth=1.1)
    axes.axhline(0.0, color="black", linewidth=0.7)
    for place in np.unique(scene.positions(scene.supports)) if len(scene.supports) <= 60 else ():
        axes.axvline(place, color="0.75", linewidth=0.5, linestyle=(0, (1, 2)), zorder=0)
    if any(one.name == quantity and one.downward for one in QUANTITIES) and not axes.yaxis_inverted():
        axes.invert_yaxis()
    axes.set_xlabel(fmt.with_unit(scene, "x"))
    axes.set_ylabel(fmt.with_unit(scene, quantity))
    return literal(axes.figure) if own else axes.figure
