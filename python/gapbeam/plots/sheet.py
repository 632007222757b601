"""The page of a picture: a heading, the sketch of the beam, and panels along it; under one another, or side by side for a pile."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..results import formatting as fmt
from .labels import measured_width, text_width
from .panels import LEFT, PANEL, RIGHT, SPACE, WIDTH, Numbers, axis_label
from .titles import HEIGHT, SIZE, title_lines
from .turned import Turned

if TYPE_CHECKING:
    from matplotlib.lines import Line2D

    from ..scene.structs import Scene

LENGTH, COLUMN, BETWEEN, SIDE, TITLES = 5.2, 1.6, 0.22, 0.3, 0.6
"""Inches of a picture of an upright beam: its height, the width of a panel, space between panels, at the left, for titles."""
ENDS = 30.0
"""Points at either end of the beam, for symbols and arrows along it."""
MOST_TICKS = 60
"""Places of supports up to which there are ticks and faint lines."""


class Sheet:
    """A figure with room for everything, whose parts are asked for one after the other.

    Parameters
    ----------
    scene : Scene
        The scene.
    heading : float
        Inches for title and text.
    bottom, top : float
        What the sketch takes below and above the axis of the beam (points).
    panels : int
        How many there will be.
    foot : float
        Inches for notes below everything.

    Attributes
    ----------
    picture : matplotlib.figure.Figure
        The figure.
    sketch : matplotlib.axes.Axes or Turned
        Where the beam is drawn; a unit across it is a point.
    """

    def __init__(self, scene: Scene, heading: float, bottom: float, top: float, panels: int, foot: float = 0.0) -> None:
        self.scene, self.heading, self.foot = scene, heading, foot
        self.upright = is_upright(scene)
        self.end = float(scene.span_ends()[-1])
        depth = (top - bottom) / 72
        if self.upright:
            width = max(WIDTH, SIDE + depth + panels * (COLUMN + BETWEEN) + 1.5 * BETWEEN + RIGHT)
            height = heading + TITLES + LENGTH + 0.15 + foot
            self._next = SIDE + depth + 2.5 * BETWEEN
        else:
            width, height = WIDTH, heading + 0.04 + depth + panels * (PANEL + SPACE) + 0.42 + foot
            self._next = height - heading - depth - SPACE
        self.picture = Figure(figsize=(width, height), dpi=200)
        self.width, self.height = width, height
        self._last: Axes | None = None
        if self.upright:
            axes = self._standing(SIDE, depth)
            self.sketch = Turned(axes, -1.0)
        else:
            axes = self.sketch = self._lying(height - heading - depth, depth)
        axes.set_axis_off()
        self.sketch.set_ylim(bottom, top)

    def write_heading(self, text: str, handles: list[Line2D]) -> None:
        """Write title and text, and the legend beside or under them."""
        rows = _legend_rows(text, handles)
        left = LEFT / self.width * 0.25
        lines = title_lines(fmt.title(self.scene, "Beam"))
        lower = HEIGHT * (len(lines) - 1)
        self.picture.text(left, 1 - 0.14 / self.height, "\n".join(lines), fontsize=SIZE, fontweight="bold", va="top")
        self.picture.text(left, 1 - (0.34 + lower) / self.height, text, fontsize=8, va="top", color="0.3", linespacing=1.4)
        if handles:
            under = lower + (0.34 if not rows else 0.36 + 0.16 * (1 + text.count("\n")))
            self.picture.legend(
                handles=handles, loc="upper right", bbox_to_anchor=(1 - RIGHT / self.width, 1 - under / self.height),
                ncols=-(-len(handles) // max(rows, 1)), frameon=False, fontsize=7.5, handletextpad=0.1, columnspacing=1.0,
                borderpad=0,
            )  # fmt: skip

    def panel(self, quantity: str, words: str, downward: bool) -> Axes | Turned:
        """Add the next panel, with its words, ticks and faint lines at supports."""
        if self.upright:
            axes = self._standing(self._next, COLUMN)
            self._next += COLUMN + BETWEEN
            axes.set_title(axis_label(self.scene, quantity, words, "right"), fontsize=8, linespacing=1.3)
            axes.tick_params(labelsize=7, labelleft=self._last is None, direction="in", length=3)
            axes.spines[["bottom", "right"]].set_visible(False)
            axes.xaxis.tick_top()
            axes.axvline(0.0, color="black", linewidth=0.7)
        else:
            self._next -= PANEL
            axes = self._lying(self._next, PANEL)
            self._next -= SPACE
            axes.set_ylabel(axis_label(self.scene, quantity, words), fontsize=8, linespacing=1.3)
            axes.yaxis.set_label_coords(-0.58 / (WIDTH - LEFT - RIGHT), 0.5)
            axes.tick_params(labelsize=7, labelbottom=False, direction="in", length=3)
            axes.spines[["top", "right"]].set_visible(False)
            axes.axhline(0.0, color="black", linewidth=0.7)
            if downward:
                axes.invert_yaxis()
        self._number(axes, quantity)
        places = np.unique(self.scene.positions(self.scene.supports)).tolist()
        if 1 < len(places) <= MOST_TICKS:
            self._tick(axes, places)
        if len(self.scene.supports) <= 2 * MOST_TICKS and len(places) <= MOST_TICKS:
            for x in places:
                (axes.axhline if self.upright else axes.axvline)(x, color="0.75", linewidth=0.5, linestyle=(0, (1, 2)), zorder=0)
        first, self._last = self._last is None, axes
        if self.upright and first:
            axes.set_ylabel(fmt.with_unit(self.scene, "x"), fontsize=8)
        return Turned(axes, 1.0) if self.upright else axes

    def finish(self) -> None:
        """Write what runs along the beam."""
        if not self.upright and self._last is not None:
            self._last.tick_params(labelbottom=True)
            self._last.set_xlabel(fmt.with_unit(self.scene, "x"), fontsize=8)

    def _number(self, axes: Axes, quantity: str) -> None:
        """Write the numbers of an axis in the unit that is shown."""
        if quantity == "motion":
            return
        axis = axes.xaxis if self.upright else axes.yaxis
        axis.set_major_formatter(Numbers(fmt.shown_unit(self.scene, quantity)[1]))
        if self.upright:
            axes.locator_params(axis="x", nbins=4)

    def _tick(self, axes: Axes, places: list[float]) -> None:
        """Put ticks where supports are and at the ends of the beam, as far as their numbers have room."""
        scale = along(self.scene) / self.end
        chosen: dict[float, float] = {}  # place -> half the room of its number
        for x in dict.fromkeys((0.0, self.end, *places)):
            half = 5.0 if self.upright else text_width(fmt.number(x, 4)) / 2 + 2.0
            if all(abs(x - other) * scale > half + width for other, width in chosen.items()):
                chosen[x] = half
        ticks = sorted(chosen)
        (axes.set_yticks if self.upright else axes.set_xticks)(ticks, [fmt.number(x, 4) for x in ticks])

    def _lying(self, bottom: float, height: float) -> Axes:
        inside = WIDTH - LEFT - RIGHT
        axes = self.picture.add_axes((LEFT / WIDTH, bottom / self.height, inside / WIDTH, height / self.height))
        margin = self.end * ENDS / along(self.scene)
        axes.set_xlim(-margin, self.end + margin)
        return axes

    def _standing(self, left: float, width: float) -> Axes:
        place = left / self.width, (0.15 + self.foot) / self.height, width / self.width, LENGTH / self.height
        axes = self.picture.add_axes(place)
        margin = self.end * ENDS / along(self.scene)
        axes.set_ylim(self.end + margin, -margin)
        return axes


def _legend_rows(text: str, handles: list[Line2D]) -> int:
    """Count the rows of a legend under a text; 0 where it has room beside it."""
    wide = [measured_width(str(handle.get_label()), 7.5) + 26.0 for handle in handles]
    page = (WIDTH - RIGHT - LEFT / 4) * 72
    if measured_width(text, 8.0) + 12.0 + sum(wide) <= page:
        return 0
    return -(-len(wide) // max(1, int(page / max(wide))))


def heading_height(scene: Scene, text: str, handles: list[Line2D]) -> float:
    """Give the height of title, text and legend (inches)."""
    return 0.6 + HEIGHT * (len(title_lines(fmt.title(scene))) - 1) + 0.15 * text.count("\n") + 0.17 * _legend_rows(text, handles)


def positive(scene: Scene, quantity: str) -> str:
    """Say which way values are positive: deflections downward, reactions upward; of an upright beam to the right and left."""
    lying, upright = {"deflection": ("downward", "to the right"), "reaction": ("upward", "to the left")}[quantity]
    return f"{upright if is_upright(scene) else lying} positive"


def is_upright(scene: Scene) -> bool:
    """Whether the beam is drawn upright."""
    return scene.beam.direction == "down"


def along(scene: Scene) -> float:
    """Give the length of the drawn beam (points)."""
    return (LENGTH if is_upright(scene) else WIDTH - LEFT - RIGHT) * 72 - 2 * ENDS
