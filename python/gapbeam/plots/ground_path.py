"""The ground in the picture of the path: where it carries over the load factor, and how far the beam goes."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby, pairwise
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.ticker import MaxNLocator

from ..base.errors import EngineError
from ..engine.tolerances import LOAD_BEGIN
from ..results.state.ground import joined

if TYPE_CHECKING:
    from ..results.result import Result
    from ..results.state.ground import Contact
    from ..results.state.step import Step

MOST_STATES = 80
"""States about that are solved for between the events."""
MOST_MARKS = 60
"""Events of zones up to which they are marked."""
FILLED, OPEN = ("o", "black"), ("o", "white")
MARKERS = {"zone appears": FILLED, "zones merge": FILLED, "zone vanishes": OPEN, "zone splits": OPEN}
END = ("s", "white")
"""Marker and face of an end of a zone that reaches or leaves the end of its foundation."""
SHADES = ("0.7", "0.85")
NOTES = {FILLED: "filled, a zone appears or two merge", OPEN: "open, a zone vanishes or splits"}


def states_on_ground(result: Result) -> list[list[Step]]:
    """Choose states from event to event, between which the ends of the zones move smoothly.

    Parameters
    ----------
    result : Result
        Of a beam on the ground, following events.

    Returns
    -------
    list of list of Step
        A list for every stretch of the path, in which nothing changes but where zones end.
    """
    segments = result.segments
    end = segments[-1].stop
    while len(segments) > MOST_STATES:  # more than can be told apart
        segments = segments[::2]
    stretches = []
    for segment in segments:
        # What is new at an event is there at its factor already
        last = np.nextafter(segment.stop, 0.0) if segment.stop < end else end
        parts = max(2, round(MOST_STATES * (segment.stop - segment.start) / end))
        begin = max(segment.start, LOAD_BEGIN)
        rest = [result.state(float(factor)) for factor in np.linspace(begin, last, parts)[1:]]
        stretches.append([*_first(result, begin), *rest])
    return stretches


def _first(result: Result, factor: float) -> list[Step]:
    """Solve for where a stretch begins; under next to no load a loose beam may touch the ground by too little for that."""
    state = result.state(factor)
    try:
        _ = state.contact  # solves for it
    except EngineError:
        if factor > LOAD_BEGIN:
            raise
        return []
    return [state]


def draw_zones(axes: Axes, result: Result, stretches: Sequence[Sequence[Step]]) -> None:
    """Draw the zones of contact over the load factor.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        The panel: load factor, and place along the beam.
    result : Result
        Of a beam on the ground.
    stretches : sequence of sequence of Step
        Following events as from `states_on_ground`; else a list of one step for every load step.
    """
    lines, areas = [], {shade: [] for shade in SHADES}
    for stretch in stretches:
        of = [
            (step.factor, {number: list(zones) for number, zones in groupby(joined(step.contact), lambda zone: zone.foundation)})
            for step in stretch
        ]
        for shade, foundation in _shades(result):
            rows = [(factor, zones.get(foundation, [])) for factor, zones in of]
            if len(rows) == 1:
                lines += [[(rows[0][0], zone.from_), (rows[0][0], zone.to)] for zone in rows[0][1]]
            for (low, before), (high, after) in pairwise(rows):
                areas[shade] += [
                    [(low, a[0]), (low, a[1]), (high, b[1]), (high, b[0])] for a, b in _paired(_ends(before), _ends(after))
                ]
    for shade, corners in areas.items():
        axes.add_collection(PolyCollection(corners, facecolors=shade, edgecolors=shade, linewidths=0.3, zorder=2, snap=False,
                                           label="contact"))  # fmt: skip
    axes.add_collection(LineCollection(lines, colors="0.3", linewidths=1.5, zorder=2, clip_on=False,
                                       label="contact at load steps"))  # fmt: skip
    for event in _marked(result):
        marker, face = MARKERS.get(event.event, END)
        axes.plot(event.factor, event.x, marker, color="black", markerfacecolor=face, markersize=4.5, clip_on=False, zorder=4)
    axes.set_ylim(0.0, float(result.scene.span_ends()[-1]))
    axes.yaxis.set_major_locator(MaxNLocator(6))


def _ends(zones: Sequence[Contact]) -> list[tuple[float, float]]:
    return [(zone.from_, zone.to) for zone in zones]


def _paired(
    before: list[tuple[float, float]], after: list[tuple[float, float]]
) -> list[tuple[tuple[float, float], tuple[float, float]]]:
    """Pair the zones of two states beside each other, of which one may be at the event at which a zone vanishes or splits.

    Examples
    --------
    >>> _paired([(0.0, 1.0), (4.0, 6.0)], [(0.0, 1.5)])
    [((0.0, 1.0), (0.0, 1.5)), ((4.0, 6.0), (5.0, 5.0))]
    >>> _paired([(0.0, 3.0)], [(0.0, 1.0), (2.0, 3.0)])
    [((0.0, 1.5), (0.0, 1.0)), ((1.5, 3.0), (2.0, 3.0))]
    """
    if len(before) == len(after):
        return list(zip(before, after, strict=True))
    if len(before) < len(after):
        return [(other, one) for one, other in _paired(after, before)]
    found = []
    for one in before:
        there = next((zone for zone in after if zone[0] <= one[1] and one[0] <= zone[1]), None)
        if there is None:
            found.append((one, (sum(one) / 2,) * 2))
            continue
        parts = [zone for zone in before if zone[0] <= there[1] and there[0] <= zone[1]]
        cuts = [there[0], *((a[1] + b[0]) / 2 for a, b in pairwise(parts)), there[1]]
        found.append((one, tuple(cuts[parts.index(one) :][:2])))
    return found


def draw_extremes(axes: Axes, states: Sequence[Step], dots: bool) -> None:
    """Draw the largest and the smallest deflection of the beam over the load factor.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        The panel.
    states : sequence of Step
        By rising load factor.
    dots : bool
        Whether each is marked.
    """
    factors = [step.factor for step in states]
    found = [step.solution.extremes()[0][:, 0] for step in states]
    for values, pattern, name in zip(np.transpose(found), ("-", "--"), ("largest", "smallest"), strict=True):
        axes.plot(factors, values, pattern, color="black", linewidth=1.3, marker="." if dots else None, clip_on=False,
                  label=name)  # fmt: skip
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False, fontsize=8, handlelength=1.8)


def note_on_ground(result: Result) -> str:
    """Say what the picture shows of the zones.

    Parameters
    ----------
    result : Result
        Of a beam on the ground.
    """
    marked = [MARKERS.get(event.event, END) for event in _marked(result)]
    circles = [words for marker, words in NOTES.items() if marker in marked]
    words = ["grey: in contact with the ground"] if result.segments else ["lines: in contact with the ground"]
    words += [f"circles: {'; '.join(circles)}"] * bool(circles)
    words += ["squares: a zone reaches or leaves an end of the ground"] * (END in marked)
    return "; ".join(words)


def _marked(result: Result) -> list:
    events = [event for event in result.events if event.support is None and event.branch == 1]
    return events if len(events) <= MOST_MARKS else []


def _shades(result: Result) -> list[tuple[str, int]]:
    """One-sided ground is darker, and over what holds both ways."""
    sides = [item.side for item in result.scene.foundation]
    return sorted((SHADES[side == "both"], number) for number, side in enumerate(sides))[::-1]
