"""The path over the load factor: reactions and openings or deflections, straight from one change to the next."""

from __future__ import annotations

import os
import textwrap
from collections.abc import Mapping, Sequence
from itertools import chain
from types import MappingProxyType
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..results import formatting as fmt
from ..results.event_words import EVENT_WORDS
from ..results.paths.branches import BranchPath
from ..scene.names import column_of
from ..scene.rotations import TURNING
from .branches import KINK, MARKERS, Trace, draw_trace, name_limits
from .ground_path import draw_extremes, draw_zones, note_on_ground, states_on_ground
from .labels import measured_width, spread
from .panels import LEFT, WIDTH, Numbers, cut_text, outcome
from .save import literal, save
from .sheet import is_upright, positive
from .support_values import LYING, MOST_CHARACTERS, UPRIGHT, short_names
from .titles import HEIGHT, SIZE, title_lines

if TYPE_CHECKING:
    from ..results.result import Result
    from ..results.state.step import Step
    from ..scene.structs import Scene

#: Inches: height of a panel and of what is above it, the space below for the load factor and on the right for names
PANEL, GAP, FOOT, NAMES = 2.1, 0.25, 0.5, 0.95
#: Points: height of a name, size of its letters; length of the sample of a line beside it, and how far it is from the axes
NAME, NAME_SIZE, SAMPLE, OFF = 9.5, 8.0, 24.0, 8.0

PANELS, OF_LAWS = ("reaction", "opening"), ("reaction", "deflection")
"""Quantities; a support with a law is hardly ever open."""
ZONES, ALONG = "x", "deflection"
"""On the ground the zones of contact come first; without supports the largest deflections follow."""

MOST_LINES = 8
"""Supports in a panel; of more those with the largest values."""
MOST_ARROWS = 3
"""Supports on whose lines arrows show which way the load goes."""
CURVE = 100
"""Points about of a line that is curved, since a support has a smooth law."""
MOST_DOTS = 40
"""Load steps that are drawn each; of more those at which the contact state changes, between which nothing bends."""
DASHES = ((), (5, 2), (7, 2, 1, 2), (10, 3), (6, 2, 1, 2, 1, 2))
COLOURS = ("#000000", "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
"""Every line of a picture has a pattern and a colour of its own: twice `MOST_LINES` of them. Colours are those of Okabe and Ito."""
ALIKE = 1e-9
"""Share of the largest value by which lines differ that are drawn as one."""


class Panel(NamedTuple):
    """A panel of the picture.

    Attributes
    ----------
    quantity : str
        By whose unit its numbers are told.
    words : str
        On its axis.
    table : numpy.ndarray, optional
        Values, states by supports; None for what is not of supports.
    lines : dict of int to list of int
        Supports whose lines are one, by the first of them.
    names : dict of int to str
        Names of the lines that are drawn.
    noun : str
        Above the names.
    """

    quantity: str
    words: str
    table: np.ndarray | None = None
    lines: Mapping[int, list[int]] = MappingProxyType({})
    names: Mapping[int, str] = MappingProxyType({})
    noun: str = ""


def plot_path(result: Result, path: str | os.PathLike) -> None:
    """Draw the path into a file.

    Parameters
    ----------
    result : Result
        What `gapbeam.solve` returned, best with ``follow = "events"``.
    path : str or os.PathLike
        The suffix decides on the format: .png, .pdf or .svg.
    """
    save(path_figure(result), path)


def path_figure(result: Result) -> Figure:
    """Draw reactions and openings, and zones of contact with the ground over the load factor, every event marked.

    Parameters
    ----------
    result : Result
        What `gapbeam.solve` returned; a step stands.

    Returns
    -------
    matplotlib.figure.Figure
        Two panels, each line named at its right end; with support laws deflections instead of openings. Following events
        the lines are exact, and go where the load goes, back and forth; by load steps they are straight between the
        steps, which are dots where they are few. With foundations there is a panel of the zones of contact above these; without
        supports the largest and the smallest deflection are below it.

    Raises
    ------
    ValueError
        No step stands.
    """
    if result.combinations:
        raise ValueError("every combination has a path of its own; draw that of one of them, result.combinations[NAME]")
    if not result.steps:
        raise ValueError(f"there is no path to draw: {result.reason}")
    scene = result.scene
    dots = result.path is None and len(result.steps) <= MOST_DOTS
    trace = Trace(result) if isinstance(result.path, BranchPath) else None
    # Beside a loading history zones never change
    stretches = _stretches(result, dots) if scene.foundation and trace is None else []
    states = list(chain(*stretches)) or (_states(result, dots) if trace is None else trace.states)
    factors = np.array([step.factor for step in states])
    panels = _panels(result, states, bool(stretches))
    note = "dots: load steps" if dots else _note(result) if trace is None else trace.note()
    lines = textwrap.wrap(note, 105) if trace is not None or stretches else []
    if stretches:
        lines += textwrap.wrap(note_on_ground(result), 105)
    foot = FOOT + 0.15 * len(lines)
    said = "" if result.status == "solved" else outcome(result)
    title = title_lines(fmt.title(scene))
    lower = HEIGHT * (len(title) - 1)
    height = 0.35 + lower + (0.18 + 0.14 * (1 + said.count("\n"))) * bool(said) + len(panels) * (GAP + PANEL) + foot
    picture = Figure(figsize=(WIDTH, height), dpi=200)
    picture.text(0.02, 1 - 0.14 / height, "\n".join(title), fontsize=SIZE, fontweight="bold", va="top")
    if said:
        picture.text(0.02, 1 - (0.36 + lower) / height, said, fontsize=8, va="top", color="0.3", linespacing=1.3)
    styles = _styles(result, panels, trace)
    longest = max((measured_width(name, NAME_SIZE) for panel in panels for name in panel.names.values()), default=0.0)
    width = WIDTH - LEFT - max(NAMES, (OFF + SAMPLE + longest + 8.0) / 72)
    for row, panel in enumerate(panels):
        above = len(panels) - 1 - row
        bottom = foot + above * (PANEL + GAP)
        axes = picture.add_axes((LEFT / WIDTH, bottom / height, width / WIDTH, PANEL / height))
        axes.set_xlim(min(0.0, factors.min()), factors.max() or 1.0)
        if panel.table is not None:
            chosen = {k: panel.lines[k] for k in panel.names}
            _draw_supports(axes, result, trace, factors, panel.table, chosen, styles, dots)
        elif panel.quantity == ZONES:
            draw_zones(axes, result, stretches)
        else:
            draw_extremes(axes, states, dots)
            if not any(np.any(line.get_ydata()) for line in axes.lines):
                axes.set_yticks([0.0])  # numbers beside nothing mean nothing
        unit, factor = fmt.shown_unit(scene, panel.quantity)
        _frame(axes, width, fmt.heading(panel.words, unit), last=not above)
        axes.yaxis.set_major_formatter(Numbers(factor))
        if panel.table is not None:
            end = len(factors) - 1 if trace is None else trace.end()
            _name_lines(axes, width, panel, {k: float(panel.table[end, k]) for k in panel.names}, styles)
            if len(panel.lines) > len(panel.names):
                axes.set_title(f"the {len(panel.names)} largest of {len(panel.lines)}", loc="right", fontsize=8, color="0.3")
    axes.set_xlabel("load factor" + (f" ({note})" if note and not lines else ""), fontsize=9)
    if trace is not None:
        name_limits(picture.axes[0], trace)
    if lines:
        picture.text(LEFT / WIDTH, 0.05 / height, "\n".join(lines), fontsize=8, va="bottom", color="0.3")
    return literal(picture)


def _panels(result: Result, states: list[Step], on_ground: bool) -> list[Panel]:
    """Choose the panels: supports across the beam always; joints that have a law or a slack, supports along it that let go."""
    scene = result.scene
    tables = {name: np.array([getattr(step, name) for step in states]) for name in {*PANELS, *OF_LAWS}}
    found = [Panel(ZONES, "x of contact")] if on_ground else []

    def add(supports: list[int], noun: str, quantities: Sequence[str], words: Sequence[str]) -> None:
        bent = noun == "joint" or any(scene.supports[k].law is not None for k in supports)
        for name, quantity, said in zip(OF_LAWS if bent else PANELS, quantities, words, strict=True):
            lines = _alike(tables[name], supports)
            drawn = {k: _names(scene, lines[k]) for k in _largest(tables[name], lines)}
            if drawn:
                found.append(Panel(quantity, said, tables[name], lines, drawn, noun))

    directions = column_of(scene.supports, "direction")
    across, turning, along = (
        [k for k, one in enumerate(directions) if one in kinds] for kinds in (("normal",), TURNING, ("axial",))
    )
    signed = {name: f"{name}, {positive(scene, name)}" for name in OF_LAWS} | {"opening": "opening"}
    second = [ALONG if any(scene.supports[k].law is not None for k in which) else "opening" for which in (across, along)]
    add(across, "support", ["reaction", second[0]], [signed["reaction"], signed[second[0]]])
    if turning:
        hinges = {scene.supports[k].direction for k in turning} == {"hinge"}
        back, forth = (UPRIGHT if is_upright(scene) else LYING)[1]
        words = [f"couple, {back} positive", f"rotation, {forth} positive"]
        words = ["moment, sagging positive", "rotation, left less right"] if hinges else words
        add(turning, "joint", ["couple", "rotation"], words)
    if any(step.state[k] != "bilateral" for step in states for k in along):
        add(along, "support", ["reaction", second[1]], ["reaction along the beam", f"{second[1]} along the beam"])
    if not across and (on_ground or not found):
        found.insert(on_ground, Panel(ALONG, signed[ALONG]))
    return found or [Panel(ALONG, signed[ALONG])]


def _stretches(result: Result, dots: bool) -> list[list[Step]]:
    """Choose states on the ground: from event to event, or every load step by itself."""
    return states_on_ground(result) if result.segments else [[step] for step in _states(result, dots)]


def _styles(result: Result, panels: list[Panel], trace: Trace | None) -> dict[int, dict]:
    """Give every support that is drawn a line of its own."""
    shown = {k for panel in panels for k in panel.names}
    if trace is None:
        return {k: _style(order) for order, k in enumerate(sorted(shown))}
    laws = {k for k in shown if result.scene.supports[k].law is not None}
    # What the picture is about is drawn through
    return {k: _style(order) for order, k in enumerate([*sorted(laws), *sorted(shown - laws)])}


def _draw_supports(
    axes: Axes, result: Result, trace: Trace | None, factors: np.ndarray, table: np.ndarray, alike: dict[int, list[int]],
    styles: dict[int, dict], dots: bool,
) -> None:  # fmt: skip
    """Draw one quantity of the supports over the load factor."""
    folded = bool((np.diff(factors) < 0.0).any())
    laws = {k for k in styles if result.scene.supports[k].law is not None}
    for k in alike:
        if trace is not None:
            draw_trace(axes, trace, k, table[:, k], styles[k], arrows=folded and k in _few(table, laws), alike=alike[k])
            continue
        axes.plot(factors, table[:, k], linewidth=1.3, marker="." if dots else None, markersize=4.5, clip_on=False,
                  label=f"support {k}", **styles[k])  # fmt: skip
        _mark_events(axes, result, alike[k], factors, table[:, k])


def _states(result: Result, dots: bool) -> list[Step]:
    """Choose states of rising load factor between which all lines are straight, or with smooth laws look like the curve."""
    states = [result.steps[k] for k in (range(len(result.steps)) if dots else _bends(result))]
    if result.segments:
        states.insert(0, result.state(0.0))
        # Where the beam turns it is in two places at one load factor
        between = {event.factor for event in result.events if event.event == "turns"}
        if result._beam.smooth:
            between |= set(np.linspace(0.0, states[-1].factor, CURVE)[1:].tolist()) - {step.factor for step in states}
        between -= {0.0, states[-1].factor}
        states = sorted([*states, *map(result.state, between)], key=lambda step: step.factor)
    return states


def _note(result: Result) -> str:
    """Say what the marks of events mean."""
    kinds = {event.event for event in result.events if event.support is not None}
    others = sorted(EVENT_WORDS[kind] for kind in kinds - {"closes", "opens", "turns"})
    law = f"squares, it {' or '.join(others)}" if others else ""
    return "; ".join(filter(None, ["circles: filled, the support closes; open, it opens" if kinds else "", law]))


def _bends(result: Result) -> list[int]:
    """Find the steps at which lines may bend: with another contact state than the one before or after."""
    schemes = [states for _, states in result.steps.history()]
    last = len(schemes) - 1
    every = last + 1 if result._beam.is_linear_between_events else max(1, last // CURVE)
    return [k for k in range(last + 1) if k in (0, last) or k % every == 0 or not schemes[k - 1] == schemes[k] == schemes[k + 1]]


def _alike(table: np.ndarray, supports: list[int]) -> dict[int, list[int]]:
    """Put supports together whose lines are one: the first of them stands for all. What is zero all along is left out."""
    same = ALIKE * float(np.abs(table).max(initial=0.0))
    found: dict[int, list[int]] = {}
    for k in supports:
        if np.abs(table[:, k]).max(initial=0.0) > same:
            first = next((j for j in found if np.abs(table[:, j] - table[:, k]).max() <= same), k)
            found.setdefault(first, []).append(k)
    return found


def _largest(table: np.ndarray, lines: dict[int, list[int]]) -> list[int]:
    """Choose the lines to draw: those with the largest values."""
    return sorted(sorted(lines, key=lambda k: -float(np.abs(table[:, k]).max()))[:MOST_LINES])


def _few(table: np.ndarray, supports: set[int]) -> list[int]:
    """Choose those whose direction is shown."""
    return sorted(supports, key=lambda k: (-float(np.abs(table[:, k]).max()), k))[:MOST_ARROWS]


def _style(order: int) -> dict:
    pattern = DASHES[order % len(DASHES)]
    return {"color": COLOURS[order % len(COLOURS)], "linestyle": (0, pattern) if pattern else "-"}


def _mark_events(axes: Axes, result: Result, alike: list[int], factors: np.ndarray, values: np.ndarray) -> None:
    """Mark where a support opens or closes."""
    for event in result.events:
        if event.support in alike and event.event != "turns":
            marker, face = MARKERS.get(event.event, KINK)
            axes.plot(event.factor, np.interp(event.factor, factors, values), marker, color="black", markerfacecolor=face,
                      markersize=5, clip_on=False)  # fmt: skip


def _frame(axes: Axes, width: float, words: str, last: bool) -> None:
    axes.set_ylabel(words, fontsize=9)
    axes.yaxis.set_label_coords(-0.74 / width, 0.5)
    axes.tick_params(labelsize=8, labelbottom=last)
    axes.grid(True, color="0.9", linewidth=0.6)
    axes.axhline(0.0, color="black", linewidth=0.8)
    axes.spines[["top", "right"]].set_visible(False)


def _names(scene: Scene, supports: list[int]) -> str:
    """Name the supports that a line is of, as far as there is room."""
    every = short_names(scene)
    names = [every[k] for k in supports]
    text = ", ".join(names)
    while len(text) > MOST_CHARACTERS and len(names) > 1:
        names.pop()
        text = f"{', '.join(names)}, ..."
    return cut_text(text, MOST_CHARACTERS)


def _name_lines(axes: Axes, width: float, panel: Panel, ends: dict[int, float], styles: dict[int, dict]) -> None:
    """Write the name of every line beside its end, with a sample of it, one above another."""
    if not ends:
        return
    low, high = axes.get_ylim()
    tall, wide = PANEL * 72, width * 72
    # Of equal ends the first support is the uppermost
    order = sorted(ends, key=lambda k: (ends[k], -k))
    at = [(ends[k] - low) / (high - low) for k in order]
    names = [place / tall for place in spread([tall * height for height in at], NAME, tall)]
    sample = (1.0 + OFF / wide, 1.0 + (OFF + SAMPLE) / wide)
    beside = {"transform": axes.transAxes, "clip_on": False}
    for k, end, name in zip(order, at, names, strict=True):
        axes.plot((1.0, sample[0]), (end, name), color="0.7", linewidth=0.6, **beside)
        axes.plot(sample, (name, name), linewidth=1.3, **styles[k], **beside)
        axes.text(sample[1] + 3.0 / wide, name, panel.names[k], fontsize=NAME_SIZE, va="center", transform=axes.transAxes)
    axes.text(sample[0], names[-1] + 0.8 * NAME / tall, panel.noun, fontsize=NAME_SIZE, transform=axes.transAxes)
