"""A result as one picture: the beam with its supports and loads, deflection, moment and shear under one another.

Deflection is drawn downward and the moment on the tension side (sagging downward), as engineers do. matplotlib
is used through its objects, without pyplot and its state, so that pictures can be made in any thread.
"""

import os
from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..results import formatting as fmt
from ..results.state.ground import joined
from .beam import SupportLanes, draw_beam, draw_contacts
from .envelope import envelope_figure
from .ground import GroundLanes, draw_ground, draw_surface, points_a_span, zone_handles
from .loads import LoadLanes, draw_loads
from .marks import MOST_MARKS, Marks, find_peaks
from .panels import (
    LEFT,
    MOST_POINTS,
    PANEL,
    PANELS,
    RIGHT,
    SPACE,
    WIDTH,
    Point,
    counts,
    cut_text,
    frame_panel,
    outcome,
    panel_axes,
)
from .save import literal, save
from .states import kinds_of, known_states, legend_handles, plain_kinds
from .thin import coarse, outline
from .train_envelope import train_envelope_figure

if TYPE_CHECKING:
    from ..results.result import Result
    from ..results.state.ground import Contact

def plot(result: "Result", path: str | os.PathLike, step: int = -1) -> None:
    """Draw a result into a file.

    Parameters
    ----------
    result : Result
        What `gapbeam.solve` returned.
    path : str or os.PathLike
        The suffix decides on the format: .png, .pdf or .svg.
    step : int
        Load step; default the last.
    """
    save(figure(result, step), path)


def figure(result: "Result", step: int = -1) -> Figure:
    """Draw a result as a matplotlib figure.

    Parameters
    ----------
    result : Result
        What `gapbeam.solve` returned.
    step : int
        Load step; default the last.

    Returns
    -------
    matplotlib.figure.Figure
        The first panel holds the beam; the symbols of all supports in the same state and on the same side are one
        collection there, labelled for example ``open below``. Without equilibrium the second panel shows the
        free motion, else the panels are those of the fields. Of combinations and trains their envelope.
    """
    if result.scene.trains:
        return train_envelope_figure(result)
    if result.combinations:
        return envelope_figure(result)
    scene = result.scene
    stands = result.status != "no-equilibrium" and len(result.steps) > 0
    panels = [("motion", "free motion", True)]
    contact: tuple[Contact, ...] = ()
    states = tuple("bilateral" if support.side == "both" else "one-sided" for support in scene.supports)
    kinds = plain_kinds(states)
    if stands:
        contact = result.steps[step].contact
        points = int(max(2, min(max(40, points_a_span(scene, result._beam)), MOST_POINTS // len(scene.beam.spans))))
        fields = result.fields(step, points=points)
        panels = [panel for panel in PANELS if getattr(fields, panel[0]) is not None]
        states = result.steps[step].state
        kinds = kinds_of(result._beam, result.steps[step])
    elif not result.motion:
        panels = []

    width = (WIDTH - LEFT - RIGHT) * 72
    ground = GroundLanes(scene, width)
    supports = SupportLanes(scene, states, width, (ground.below, ground.above), result.steps[step] if stands else None, kinds)
    loads = LoadLanes(scene, supports.top, width, result.steps[step].factor if stands else 1.0)
    beam = (loads.top - supports.bottom) / 72
    texts = _headline(result, step, contact) if stands else outcome(result)
    handles = legend_handles(kinds) * (not supports.rows) + zone_handles(contact)
    low = _meets(texts, handles)  # the legend has a line of its own
    heading = (0.6 if stands else 0.75) + 0.17 * low
    height = heading + 0.04 + beam + len(panels) * (PANEL + SPACE) + 0.42
    picture = Figure(figsize=(WIDTH, height), dpi=200)

    top = height - heading
    axes = panel_axes(picture, scene, top - beam, beam)
    axes.set_axis_off()
    axes.set_ylim(supports.bottom, loads.top)  # one unit is one point
    draw_ground(axes, ground, contact)
    draw_beam(axes, scene, states, supports)
    draw_loads(axes, loads)
    _headings(picture, result, texts, handles, low)
    bottom = top - beam - SPACE
    for quantity, words, downward in panels:
        bottom -= PANEL
        panel = panel_axes(picture, scene, bottom, PANEL)
        frame_panel(panel, scene, quantity, words, downward)
        if stands:
            contacts = ()
            if quantity == "deflection":
                contacts = draw_contacts(panel, scene, supports, float(np.abs(fields.deflection).max()))
            marks = _curve(panel, fields.x, getattr(fields, quantity), result._pairs_of_extremes(step)[quantity], contacts,
                           fmt.shown_unit(scene, quantity)[1])  # fmt: skip
            if quantity == "moment":
                peaks = find_peaks(fields, scene.span_ends(), lambda x: result.at(x, step))
                for value, x in peaks[:MOST_MARKS]:
                    marks.peak(value, x)
            if quantity == "deflection":
                draw_surface(panel, scene, width)
        else:
            _motion(panel, result)
        bottom -= SPACE
    if panels:
        panel.tick_params(labelbottom=True)
        panel.set_xlabel(fmt.with_unit(scene, "x"), fontsize=8)
    return literal(picture)


def _headings(picture: Figure, result: "Result", text: str, handles: list[Line2D], low: bool) -> None:
    """Write title and state, and the legend beside or under them."""
    height = picture.get_figheight()
    left = LEFT / WIDTH * 0.25
    title = fmt.title(result.scene, "Beam")
    picture.text(left, 1 - 0.22 / height, cut_text(title, 95), fontsize=10, fontweight="bold", va="center")
    picture.text(left, 1 - 0.34 / height, text, fontsize=8, va="top", color="0.3", linespacing=1.4)
    if handles:
        picture.legend(
            handles=handles, loc="center right", bbox_to_anchor=(1 - RIGHT / WIDTH, 1 - (0.61 if low else 0.42) / height),
            ncols=len(handles), frameon=False, fontsize=7.5, handletextpad=0.1, columnspacing=1.0, borderpad=0,
        )  # fmt: skip


def _headline(result: "Result", step: int, contact: "tuple[Contact, ...]") -> str:
    """Say how many supports are in which state."""
    states = result.steps[step].state
    counted, factor = Counter(states), result.steps[step].factor
    text = f"load factor {fmt.number(factor)}"
    if result.status == "limit-load" and result.steps[step] is result.steps[-1]:
        text += " (limit load)"
    text += "".join(
        f", {counted[state]:,} {'on ' if state.startswith('branch') else ''}{state}" for state in known_states(states)
    )
    return text + (f", contact in {fmt.count(len(joined(contact)), 'zone')}" if contact else "")


def _meets(text: str, handles: list[Line2D]) -> bool:
    """Whether legend and text have no room side by side."""
    entries = sum(4.6 * len(str(handle.get_label())) + 26.0 for handle in handles)
    return bool(handles) and 4.7 * max(map(len, text.split("\n"))) + entries > (WIDTH - RIGHT - LEFT / 4) * 72


def _curve(
    axes: Axes, x: np.ndarray, values: np.ndarray, extreme: dict[str, tuple[float, float]], avoid: Sequence[Point], factor: float
) -> Marks:
    """Draw one field with its largest and smallest value, whose labels keep clear of some points."""
    x, values = outline(x, values, (WIDTH - LEFT - RIGHT) * 72)
    inner, heights = coarse(x, values, np.ptp(values) / (5.0 * PANEL * 72))
    axes.fill(np.r_[x[0], inner, x[-1]], np.r_[0.0, heights, 0.0], color="0.9", linewidth=0, zorder=1)
    axes.plot(x, values, color="black", linewidth=1.1 if len(x) < 3000 else 0.6, solid_joinstyle="round", zorder=3, label="curve")
    shown = {kind: pair for kind, pair in extreme.items() if counts(pair[0], extreme)}
    low = min([0.0, *(value for value, _ in shown.values())])
    high = max([0.0, *(value for value, _ in shown.values())])
    span = (high - low) or 1.0
    room = {"max": high > 0.0 and "max" in shown, "min": low < 0.0 and "min" in shown}
    bounds = (low - span * (0.24 if room["min"] else 0.08), high + span * (0.24 if room["max"] else 0.08))
    axes.set_ylim(bounds[::-1] if axes.yaxis_inverted() else bounds)
    marks = Marks(axes, factor, avoid, (x, values))
    for value, place in shown.values():
        marks.extreme(value, place)
    return marks


def _motion(axes: Axes, result: "Result") -> None:
    x, displacement = np.transpose(result.motion)
    largest = np.abs(displacement).max() or 1.0
    axes.plot(x, displacement / largest, "--", color="black", linewidth=1.2, label="curve")
    axes.set_ylim(1.25, -1.25)
    axes.set_yticks([])
