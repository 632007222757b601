"""Envelopes as a picture: largest and smallest deflection, moment and shear while trains pass, what governs marked."""

from typing import TYPE_CHECKING

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..base.characters import visible
from ..results import formatting as fmt
from .beam import SupportLanes, draw_beam
from .ground import GroundLanes, draw_ground, points_a_span
from .marks import Marks
from .panels import LEFT, PANEL, PANELS, RIGHT, SPACE, WIDTH, cut_text, frame_panel, panel_axes
from .save import literal

if TYPE_CHECKING:
    from ..results.result import Result
    from ..results.trains.envelope import TrainCurves
    from ..results.trains.members import TrainExtreme

POINTS, MOST_POINTS = 40, 100
"""Divisions of a span at which the curves are drawn; on foundations more where the beam bends within short lengths."""


def train_envelope_figure(result: "Result") -> Figure:
    """Draw the envelope of a result as a matplotlib figure.

    Parameters
    ----------
    result : Result
        Of a scene with trains.

    Returns
    -------
    matplotlib.figure.Figure
        The beam, then deflection, moment and shear; the largest and the smallest value of each is marked with its place and the
        position of the train.
    """
    scene = result.scene
    envelope = result.envelope(int(min(max(POINTS, points_a_span(scene, result._beam)), MOST_POINTS)))
    states = tuple("bilateral" if support.side == "both" else "one-sided" for support in scene.supports)
    width = (WIDTH - LEFT - RIGHT) * 72
    ground = GroundLanes(scene, width)
    supports = SupportLanes(scene, states, width, (ground.below, ground.above))
    beam = (supports.top - supports.bottom) / 72
    panels = [panel for panel in PANELS if panel[0] in envelope.extremes]
    heading = 0.6
    height = heading + 0.04 + beam + len(panels) * (PANEL + SPACE) + 0.42
    picture = Figure(figsize=(WIDTH, height), dpi=200)
    left = LEFT / WIDTH * 0.25
    picture.text(left, 1 - 0.22 / height, cut_text(fmt.title(scene, "Beam"), 95), fontsize=10, fontweight="bold", va="center")
    names = ", ".join(dict.fromkeys(member.train for member in envelope._members if member.train))
    number = f" in {fmt.count(len(result.combinations), 'combination')}" if result.combinations else ""
    text = cut_text(f"largest and smallest values{number} while trains pass: {visible(names)}", 110)
    picture.text(left, 1 - 0.34 / height, text, fontsize=8, va="top", color="0.3")
    axes = panel_axes(picture, scene, height - heading - beam, beam)
    axes.set_axis_off()
    axes.set_ylim(supports.bottom, supports.top)
    draw_ground(axes, ground, ())
    draw_beam(axes, scene, states, supports)
    bottom = height - heading - beam - SPACE
    for quantity, words, downward in panels:
        bottom -= PANEL
        panel = panel_axes(picture, scene, bottom, PANEL)
        frame_panel(panel, scene, quantity, words, downward)
        _draw(panel, envelope.fields, quantity, envelope.extremes[quantity], fmt.shown_unit(scene, quantity)[1])
        bottom -= SPACE
    panel.tick_params(labelbottom=True)
    panel.set_xlabel(fmt.with_unit(scene, "x"), fontsize=8)
    return literal(picture)


def _draw(axes: Axes, curves: "TrainCurves", quantity: str, extremes: "dict[str, TrainExtreme | None]", factor: float) -> None:
    """Draw the two curves of a field, and mark its extremes."""
    x, high, low = curves.x, curves.largest[quantity], curves.smallest[quantity]
    axes.fill_between(x, low, high, color="0.9", linewidth=0, zorder=1)
    for values in (high, low):
        axes.plot(x, values, color="black", linewidth=1.0, solid_joinstyle="round", zorder=3, label="curve")
    shown = [extreme for extreme in extremes.values() if extreme is not None]
    values = [0.0, *(extreme.value for extreme in shown)]
    span = (max(values) - min(values)) or 1.0
    bounds = (min(values) - 0.24 * span, max(values) + 0.24 * span)
    axes.set_ylim(bounds[::-1] if axes.yaxis_inverted() else bounds)
    marks = Marks(axes, factor)
    for extreme in shown:
        if abs(extreme.value) <= 1e-6 * max(map(abs, values)):
            continue
        more = f", {visible(extreme.combination)}" if extreme.combination else ""
        if extreme.train:
            more += f", {visible(extreme.train)} at {fmt.number(extreme.position, 4)}"
        marks.extreme(extreme.value, extreme.x, more)
