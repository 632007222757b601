"""Reactions as arrows under the supports: as long as they are large, with their heads where they point."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.path import Path

if TYPE_CHECKING:
    from ..results.state.step import Step
    from ..scene.structs import Scene

ARROW, SHORTEST = 15.0, 7.0
"""Length of the longest and of the shortest arrow (points)."""
BLUE = "#00538A"
"""Dark in grey too."""
MOST_HEADS = 120
"""Arrows that have heads; more are thin lines from an axis, upward where they push up."""
NONE = 1e-9

_HEAD = Path([(0, 0), (-0.45, -1), (0.45, -1), (0, 0)], [1, 2, 2, 79])


def arrow_lane(step: Step | None) -> float:
    """Give the height that the arrows take (points)."""
    return 0.0 if step is None or not len(step.reaction) else ARROW + 2.0


def draw_reactions(axes: Axes, scene: Scene, step: Step, x: np.ndarray, top: float) -> None:
    """Draw the reactions across the beam.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        The panel of the beam; its vertical unit is one point.
    scene : Scene
        The scene.
    step : Step
        The state.
    x : numpy.ndarray
        Places of the supports.
    top : float
        Upper end of the arrows.
    """
    across = np.array([support.direction == "normal" for support in scene.supports])
    force = np.where(across, step.reaction, 0.0)
    largest = np.abs(force).max(initial=0.0)
    which = np.flatnonzero(np.abs(force) > NONE * largest)
    if not len(which):
        return
    x, force = x[which], force[which]
    heads = len(which) <= MOST_HEADS
    if heads:
        length = SHORTEST + (ARROW - SHORTEST) * np.abs(force) / largest
        ends = np.column_stack((np.full(len(x), top), top - length))
    else:
        zero = top - ARROW * max(0.0, force.max()) / np.ptp(np.append(force, 0.0))
        ends = np.column_stack((np.full(len(x), zero), zero + ARROW * force / np.ptp(np.append(force, 0.0))))
    # One line with breaks: one path in a file
    axes.plot(np.repeat(x, 3), np.column_stack((ends, np.full(len(x), np.nan))).ravel(), color=BLUE,
              linewidth=1.3 if heads else 0.4, solid_capstyle="butt", zorder=4, label="reactions")  # fmt: skip
    for sign in (1.0, -1.0) if heads else ():
        points = sign * force > 0.0
        if points.any():
            tips = ends[points, 0 if sign > 0.0 else 1]
            axes.scatter(x[points], tips, marker=Path(_HEAD.vertices * (1.0, sign), _HEAD.codes), s=(2.0 * 5.0) ** 2, c=BLUE,
                         linewidths=0, zorder=4.5, label=f"reactions {'up' if sign > 0.0 else 'down'}")  # fmt: skip
