"""Panels of a picture under one another: their sizes, frames and words, for results, envelopes and paths."""

import textwrap
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..engine.quantities import QUANTITIES
from ..results import formatting as fmt
from .labels import text_width

if TYPE_CHECKING:
    from ..results.result import Result
    from ..scene.structs import Scene

#: Inches. The width is that of an A4 page between its margins.
WIDTH, LEFT, RIGHT, PANEL, SPACE = 7.4, 0.95, 0.15, 1.5, 0.14

#: Points of a curve at most, about: a span gets fewer points where there are many spans
MOST_POINTS = 100_000

Point = tuple[float, float]

#: Quantity, words on the axis, whether positive values are drawn downward
PANELS = tuple((one.name, one.panel, one.downward) for one in QUANTITIES if one.panel)


def panel_axes(picture: Figure, scene: "Scene", bottom: float, height: float) -> Axes:
    """Add a panel at a height in inches; all have the same x.

    Parameters
    ----------
    picture : matplotlib.figure.Figure
        Where to.
    scene : Scene
        The scene.
    bottom, height : float
        Inches.

    Returns
    -------
    matplotlib.axes.Axes
    """
    total = picture.get_figheight()
    inside = WIDTH - LEFT - RIGHT
    axes = picture.add_axes((LEFT / WIDTH, bottom / total, inside / WIDTH, height / total))
    end = float(scene.span_ends()[-1])
    margin = end * 30 / (inside * 72 - 60)  # 30 points at either end, for symbols and horizontal arrows
    axes.set_xlim(-margin, end + margin)
    return axes


def outcome(result: "Result") -> str:
    """Say on two lines at most why there is no equilibrium, or which limit the load has.

    Parameters
    ----------
    result : Result
        That is not solved to the end.

    Returns
    -------
    str
    """
    begin = "No equilibrium. " if result.status == "no-equilibrium" else ""
    return "\n".join(textwrap.wrap(begin + fmt.sentence(result.reason), 85, max_lines=2))


def cut_text(text: str, most: int) -> str:
    """Cut a text after so many characters.

    Examples
    --------
    >>> cut_text("a long text", 8)
    'a lon...'
    """
    return text if len(text) <= most else text[: most - 3] + "..."


def frame_panel(axes: Axes, scene: "Scene", quantity: str, words: str, downward: bool) -> None:
    """Write on the axes, and mark the supports with faint lines.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        The panel.
    scene : Scene
        The scene.
    quantity, words : str
        What it shows, and what is written.
    downward : bool
        Whether positive values are drawn downward.
    """
    if downward:
        axes.invert_yaxis()
    label = "scale arbitrary"
    if quantity != "motion":
        unit, factor = fmt.shown_unit(scene, quantity)
        label = words + (f" [{unit}]" if unit else "")
        if factor != 1.0:
            axes.yaxis.set_major_formatter(lambda value, _: fmt.number(factor * value).replace("-", "\N{MINUS SIGN}"))
    if quantity == "moment":
        label += "\ndrawn on the tension side"
    elif quantity == "pressure":
        label += "\npositive upward"
    elif quantity in ("deflection", "motion"):
        label = f"{words}\n{label}" if quantity == "motion" else label + "\npositive downward"
    axes.set_ylabel(label, fontsize=8, linespacing=1.3)
    axes.yaxis.set_label_coords(-0.58 / (WIDTH - LEFT - RIGHT), 0.5)
    axes.tick_params(labelsize=7, labelbottom=False, direction="in", length=3)
    axes.spines[["top", "right"]].set_visible(False)
    axes.axhline(0.0, color="black", linewidth=0.7)
    places = np.unique(scene.positions(scene.supports)).tolist()
    if 1 < len(places) <= 60:
        _tick(axes, places, float(scene.span_ends()[-1]))
    if len(scene.supports) <= 60:
        for x in places:
            axes.axvline(x, color="0.75", linewidth=0.5, linestyle=(0, (1, 2)), zorder=0)


def _tick(axes: Axes, places: list[float], end: float) -> None:
    """Put ticks where supports are and at the ends of the beam, as far as their numbers have room."""
    left, right = axes.get_xlim()
    scale = (WIDTH - LEFT - RIGHT) * 72 / (right - left)
    chosen: dict[float, float] = {}  # place -> half the width of its number
    for x in dict.fromkeys((0.0, end, *places)):
        half = text_width(fmt.number(x, 4)) / 2 + 2.0
        if all(abs(x - other) * scale > half + width for other, width in chosen.items()):
            chosen[x] = half
    ticks = sorted(chosen)
    axes.set_xticks(ticks, [fmt.number(x, 4) for x in ticks])


def counts(value: float, extreme: dict[str, tuple[float, float]]) -> bool:
    """Decide whether an extreme is worth words: zero at an end of the beam is not."""
    return abs(value) > 1e-6 * max(abs(pair[0]) for pair in extreme.values())
