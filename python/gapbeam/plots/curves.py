"""Fields in their panels: exact curves, the area under them, their largest values."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import PathPatch
from matplotlib.path import Path

from ..results import formatting as fmt
from .bezier import Cells, path_of
from .ground import draw_surface
from .marks import Marks
from .panels import PANEL, Point, counts
from .sheet import along
from .thin import coarse, outline
from .turned import Turned, is_turned

if TYPE_CHECKING:
    from ..scene.structs import Scene

MOST_CELLS = 4_000
"""Cells of a beam up to which every one is a curve of its own; of more what no eye parts is drawn once."""
MOST_FILLED = 400
"""Cells up to which the area under a curve has a curved edge."""
BEYOND = 0.15
"""Share of the range beyond the surface of the ground, for labels."""
ROOM, NO_ROOM = 0.24, 0.08
"""Share of the range of values above and below, where there is a label and where there is none."""


def draw_field(
    axes: Axes | Turned, scene: Scene, cells: Cells, quantity: str, extreme: dict[str, Point], avoid: Sequence[Point],
    factor: float, seats: Sequence[Point] = (),
) -> Marks:  # fmt: skip
    """Draw one field with its largest and smallest value, whose labels keep clear of some points.

    Parameters
    ----------
    axes : matplotlib.axes.Axes or Turned
        The panel.
    scene : Scene
    cells : Cells
        The fields.
    quantity : str
        Which.
    extreme : dict
        As from `Result.extremes`.
    avoid : sequence of (float, float)
        Points that labels keep clear of.
    factor : float
    seats : sequence of (float, float)
        Points that are in the panel too.

    Returns
    -------
    Marks
        For more labels.
    """
    x, values = cells.along(quantity)
    shown = {kind: pair for kind, pair in extreme.items() if counts(pair[0], extreme)}
    limit_values(axes, [value for value, _ in shown.values()] + [value for _, value in seats], ROOM)
    if quantity == "deflection":
        draw_surface(axes, scene, along(scene), BEYOND, factor)
    if not values.any():
        _say_zero(axes, scene)
    if len(cells.x) <= MOST_CELLS:
        points = cells.control_points(quantity)
        vertices, codes = path_of(points, np.ptp(values) / (20.0 * PANEL * 72))
        add_path(axes, vertices, codes, 1.1 if len(points) < 750 else 0.6)
        ends = points[:, (0, 3)].reshape(-1, 2)
        ends = ends[np.append(True, np.abs(np.diff(ends, axis=0)).max(axis=1) > 1e-9 * np.ptp(values))].T
    else:
        ends = outline(x, values, along(scene))
        axes.plot(*ends, color="black", linewidth=0.6, solid_joinstyle="round", zorder=3, label="curve")
    if len(cells.x) > MOST_FILLED:
        vertices = np.column_stack(coarse(*ends, np.ptp(values) / (5.0 * PANEL * 72)))
        codes = [2] * len(vertices)
    _fill(axes, vertices, codes)
    marks = Marks(axes, fmt.shown_unit(scene, quantity)[1], avoid, [cells.along(quantity)])
    for value, place in shown.values():
        marks.extreme(value, place)
    return marks


def _fill(axes: Axes | Turned, vertices: np.ndarray, codes: Sequence[int]) -> None:
    """Fill the area between a path and the axis."""
    first, last = vertices[0, 0], vertices[-1, 0]
    corners = np.concatenate(([[first, 0.0]], vertices, [[last, 0.0]]))
    axes.add_artist(PathPatch(Path(corners, [1, 2, *codes[1:], 2]), facecolor="0.9", edgecolor="none", linewidth=0, zorder=1))


def add_path(axes: Axes | Turned, vertices: np.ndarray, codes: np.ndarray, width: float) -> None:
    """Draw a path as the curve of a panel."""
    axes.add_artist(PathPatch(Path(vertices, codes), facecolor="none", edgecolor="black", linewidth=width, joinstyle="round",
                             zorder=3, label="curve"))  # fmt: skip


def limit_values(axes: Axes | Turned, values: Sequence[float], room: float) -> None:
    """Set the limits of a panel by the values that are labelled, with room for the labels.

    Parameters
    ----------
    axes : matplotlib.axes.Axes or Turned
        The panel.
    values : sequence of float
        Largest and smallest.
    room : float
        Share of the range beyond a label.
    """
    low, high = min([0.0, *values]), max([0.0, *values])
    span = (high - low) or 1.0
    below, above = (room if value else NO_ROOM for value in (low, high))
    if is_turned(axes):
        below = above = max(below, above)
    low, high = low - span * below, high + span * above
    axes.set_ylim(*((high, low) if axes.yaxis_inverted() else (low, high)))


def _say_zero(axes: Axes | Turned, scene: Scene) -> None:
    """Say that there is nothing, instead of numbers on an axis that mean nothing."""
    inner = axes.axes if is_turned(axes) else axes
    (inner.set_xticks if is_turned(axes) else inner.set_yticks)([0.0], [fmt.number(0.0)])
    place, off = (float(scene.span_ends()[-1]) / 2, 0.0), (0.0, 4.0 + 6.0 * is_turned(axes))
    axes.annotate("zero along the whole beam", place, off, textcoords="offset points", fontsize=7.5, color="0.3",
                  ha="center", va="bottom", rotation=90 * is_turned(axes))  # fmt: skip
