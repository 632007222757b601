"""The envelope of combinations as one picture: largest and smallest values along the beam, and which combination gives them."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.transforms import blended_transform_factory

from ..base.characters import visible
from ..results import formatting as fmt
from .beam import SupportLanes, draw_beam
from .ground import GroundLanes, draw_ground, points_a_span
from .labels import text_width
from .marks import Marks
from .panels import (
    LEFT,
    MOST_POINTS,
    PANEL,
    PANELS,
    RIGHT,
    SPACE,
    WIDTH,
    counts,
    cut_text,
    frame_panel,
    panel_axes,
)
from .save import literal
from .thin import outline

if TYPE_CHECKING:
    from ..results.cases.combined import CombinedResult
    from ..results.envelopes.envelope import Curves, Envelope

STRIP = 0.06
"""Height of the strip that tells which combination governs, as a share of the panel."""
SHADES = ("0.88", "0.70")
MOST_POINTS_FILLED = 20_000
"""Points of a curve up to which the range is filled."""
MOST_STRIPS = 500
"""Changes of the combination that governs that are drawn along a beam."""
MOST_NAMED = 26
"""Characters of the name of a combination beside its value."""


def envelope_figure(result: CombinedResult) -> Figure:
    """Draw the envelope of combinations as a matplotlib figure.

    Parameters
    ----------
    result : CombinedResult
        What `gapbeam.solve` returned.

    Returns
    -------
    matplotlib.figure.Figure
        Under the beam a panel for every field: the range between its smallest and its largest values; the strips at the edges
        tell which combination gives them, and extremes have place and combination beside them.
    """
    scene = result.scene
    solved = "solved" in result.statuses
    points = int(max(2, min(max(40, points_a_span(scene, result._beam)), MOST_POINTS // len(scene.beam.spans))))
    envelope = result.envelope(points) if solved else None
    panels = [panel for panel in PANELS if envelope is not None and panel[0] in envelope.extremes]
    states = tuple("bilateral" if support.side == "both" else "one-sided" for support in scene.supports)
    width = (WIDTH - LEFT - RIGHT) * 72
    ground = GroundLanes(scene, width)
    supports = SupportLanes(scene, states, width, (ground.below, ground.above))
    beam, heading = (supports.top + 4.0 - supports.bottom) / 72, 0.6
    height = heading + 0.04 + beam + len(panels) * (PANEL + SPACE) + 0.42
    picture = Figure(figsize=(WIDTH, height), dpi=200)
    top = height - heading
    axes = panel_axes(picture, scene, top - beam, beam)
    axes.set_axis_off()
    axes.set_ylim(supports.bottom, supports.top + 4.0)
    draw_ground(axes, ground, ())
    draw_beam(axes, scene, states, supports)
    _headings(picture, result)
    bottom = top - beam - SPACE
    for quantity, words, downward in panels:
        bottom -= PANEL
        axes = panel_axes(picture, scene, bottom, PANEL)
        frame_panel(axes, scene, quantity, words, downward)
        _range(axes, quantity, envelope, result.names, fmt.shown_unit(scene, quantity)[1])
        bottom -= SPACE
    if panels:
        axes.tick_params(labelbottom=True)
        axes.set_xlabel(fmt.with_unit(scene, "x"), fontsize=8)
    return literal(picture)


def _headings(picture: Figure, result: CombinedResult) -> None:
    height, left = picture.get_figheight(), LEFT / WIDTH * 0.25
    title = cut_text(fmt.title(result.scene, "Beam"), 95)
    picture.text(left, 1 - 0.22 / height, title, fontsize=10, fontweight="bold", va="center")
    solved = result.statuses.count("solved")
    text = f"Envelope of {fmt.count(solved, 'combination')}; the strips tell which one governs"
    if solved < len(result.names):
        text = f"Envelope of {solved:,} of {fmt.count(len(result.names), 'combination')}, the others are not solved"
    picture.text(left, 1 - 0.34 / height, text, fontsize=8, va="top", color="0.3", linespacing=1.4)


def _range(axes: Axes, quantity: str, envelope: Envelope, names: tuple[str, ...], factor: float) -> None:
    """Draw the range of one field, its extremes, and which combinations give it."""
    curves, extremes = envelope.fields, envelope.extremes[quantity]
    width = (WIDTH - LEFT - RIGHT) * 72
    for values in (curves.largest[quantity], curves.smallest[quantity]):
        x, y = outline(curves.x, values, width)
        axes.plot(x, y, color="black", linewidth=1.1 if len(x) < 3000 else 0.6, solid_joinstyle="round", zorder=3, label="curve")
    if len(curves.x) <= MOST_POINTS_FILLED:
        axes.fill_between(curves.x, curves.smallest[quantity], curves.largest[quantity], color="0.9", linewidth=0, zorder=1)
    pairs = {kind: (one.value, one.x) for kind, one in extremes.items()}
    low, high = min(0.0, pairs["min"][0]), max(0.0, pairs["max"][0])
    span = (high - low) or 1.0
    bounds = (low - span * 0.34, high + span * 0.34)
    axes.set_ylim(bounds[::-1] if axes.yaxis_inverted() else bounds)
    marks = Marks(axes, factor)
    for one in extremes.values():
        if counts(one.value, pairs):
            others = f" +{len(one.ties) - 1}" if len(one.ties) > 1 else ""
            marks.extreme(one.value, one.x, f", {cut_text(visible(one.combination or ''), MOST_NAMED)}{others}")
    upper, lower = 1.0 - STRIP, 0.0
    if axes.yaxis_inverted():
        upper, lower = lower, upper
    _strip(axes, curves, curves.largest_of[quantity], names, upper)
    _strip(axes, curves, curves.smallest_of[quantity], names, lower)


def _strip(axes: Axes, curves: Curves, of: np.ndarray, names: tuple[str, ...], bottom: float) -> None:
    """Draw which combination governs along the beam, with its name where there is room."""
    changes = np.concatenate(([0], np.flatnonzero(np.diff(of)) + 1, [len(of)]))
    ends = np.append(curves.x[changes[:-1]], curves.x[-1])
    left, right = axes.get_xlim()
    scale = (WIDTH - LEFT - RIGHT) * 72 / (right - left)
    if len(changes) > MOST_STRIPS:
        return  # no eye could part them
    place = blended_transform_factory(axes.transData, axes.transAxes)
    for shade in (0, 1):
        pairs = [(a, b - a) for a, b in list(pairwise(ends.tolist()))[shade::2]]
        axes.broken_barh(pairs, (bottom, STRIP), facecolors=SHADES[shade], linewidth=0, transform=place, zorder=2, label="governs")
    for first, (a, b) in zip(changes.tolist(), pairwise(ends.tolist()), strict=False):
        name = visible(names[of[first]])
        if text_width(name) < (b - a) * scale:
            axes.text((a + b) / 2, bottom + STRIP / 2, name, fontsize=5.5, ha="center", va="center", transform=place, zorder=6)
