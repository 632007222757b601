"""The diagram of one field alone, for a page of the user's own."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..engine.quantities import QUANTITIES
from ..results import formatting as fmt
from .panels import WIDTH
from .save import literal

if TYPE_CHECKING:
    from ..results.result import Result

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
    own = axes is None
    if own:
        axes = Figure(figsize=(WIDTH, HEIGHT), dpi=200, layout="constrained").add_subplot()
    scene = result.scene
    if result.combinations or scene.trains:
        curves = result.envelope().fields
        x, rows = curves.x, [curves.largest[quantity], curves.smallest[quantity]]
    else:
        fields = result.fields(points=max(POINTS, POINTS_ALL // len(scene.beam.spans)))
        x, rows = fields.x, [getattr(fields, quantity)]
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
