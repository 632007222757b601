"""Reactions as arrows under the supports: as long as they are large, with their heads where they point."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from .states import HEAD, area, mirrored
from .turned import Turned, shifted

if TYPE_CHECKING:
    from .support_values import SupportValues

ARROW, SHORTEST = 15.0, 7.0
"""Length of the longest and of the shortest arrow (points)."""
BLUE = "#00538A"
"""Dark in grey too."""
MOST_HEADS = 120
"""Arrows that have heads; more are thin lines from an axis, upward where they push up."""
NONE = 1e-9
"""Share of the largest reaction below which there is none."""
BESIDE = 3.0
"""How far an arrow is moved aside where one points the other way (points)."""


def arrow_lane(values: SupportValues | None) -> float:
    """Give the height that the arrows take (points)."""
    return 0.0 if values is None or not len(values.up) else ARROW + 2.0


def draw_reactions(axes: Axes | Turned, values: SupportValues, x: np.ndarray, top: float) -> None:
    """Draw the reactions across the beam; of an envelope the largest that push up, and beside them those that push down.

    Parameters
    ----------
    axes : matplotlib.axes.Axes or Turned
        The panel of the beam; its vertical unit is one point.
    values : SupportValues
        The reactions.
    x : numpy.ndarray
        Places of the supports.
    top : float
        Upper end of the arrows.
    """
    up, down = values.up, values.down
    largest = max(up.max(initial=0.0), down.max(initial=0.0))
    pushing, pulling = (np.flatnonzero(force > NONE * largest) for force in (up, down))
    if not len(pushing) + len(pulling):
        return
    heads = len(pushing) + len(pulling) <= MOST_HEADS
    high, low = up.max(initial=0.0), down.max(initial=0.0)
    axis = top - ARROW * high / (high + low)  # of lines without heads
    for which, force, sign in ((pushing, up, 1.0), (pulling, down, -1.0)):
        if not len(which):
            continue
        places, size = x[which], force[which] / largest
        both = np.isin(places, x[pulling if sign > 0.0 else pushing])
        if heads:
            ends = np.column_stack((np.full(len(which), top), top - SHORTEST - (ARROW - SHORTEST) * size))
        else:
            ends = axis + np.column_stack((np.zeros(len(which)), sign * ARROW * force[which] / (high + low)))
        for beside in np.unique(both):
            chosen = both == beside
            move = shifted(axes, BESIDE * sign * beside)
            # One line with breaks: one path in a file
            line = np.column_stack((ends[chosen], np.full(chosen.sum(), np.nan))).ravel()
            axes.plot(np.repeat(places[chosen], 3), line, color=BLUE, linewidth=1.3 if heads else 0.4, solid_capstyle="butt",
                      zorder=4, transform=move, label="reactions")  # fmt: skip
            if heads:
                tips = ends[chosen, 0 if sign > 0.0 else 1]
                axes.scatter(places[chosen], tips, marker=mirrored(HEAD, sign), s=area(5.0),
                             c=BLUE, linewidths=0, zorder=4.5, transform=move,
                             label=f"reactions {'up' if sign > 0.0 else 'down'}")  # fmt: skip
