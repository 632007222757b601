"""The points of a path in their order, for its picture: the load may fall, some stretches are unstable, some jumped over."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from matplotlib.axes import Axes

from ..base.characters import with_minus_signs
from ..results import formatting as fmt
from ..results.paths.branches import BranchPath

if TYPE_CHECKING:
    from ..results.result import Result
    from ..results.state.step import Step

STABLE, UNSTABLE, JUMP = range(3)
MOST_MARKS = 300
"""Events up to which they are marked."""
MOST_POINTS = 40
"""Ends of segments up to which arrows show the direction of a path."""
MARKERS = {"closes": ("o", "black"), "opens": ("o", "white"), "breaks": ("X", "black")}
"""Markers and their faces; whatever else happens to a support is a breakpoint of its law."""
KINK = ("s", "black")
NOTES = {
    "closes": "circles: filled, the support closes; open, it opens",
    "breaks": "crosses: a support breaks",
    "kink": "squares: a support {what}",
    "limit": "triangles: limit loads",
    "unstable": "dotted: unstable",
    "jump": "arrows: jumps",
}


class Mark(NamedTuple):
    """What is marked on the line of a support.

    Attributes
    ----------
    point : int
        Point of the trace.
    support : int
        Number of the support; -1 for all.
    what : str
        An event, or ``limit``.
    """

    point: int
    support: int
    what: str


class Trace:
    """The points of a path, and how it goes from each to the next.

    Parameters
    ----------
    result : Result
        With a `BranchPath`.

    Attributes
    ----------
    states : list of Step
        Both ends of every segment, with smooth laws also between them, and where a jump would land that is not made.
    spans : list of (int, int)
        First and last point of every segment.
    factors : numpy.ndarray
        Their load factors.
    ways : list of int
        STABLE, UNSTABLE or JUMP, from each point to the next.
    marks, limits : list of Mark
        Events and limits; limits alone. Where a limit is no event is marked.
    lands : bool
        Whether the last point is where a jump would land that is not made.
    """

    def __init__(self, result: Result):
        path: BranchPath = result.path
        self.states: list[Step] = []
        self.spans: list[tuple[int, int]] = []
        self.ways: list[int] = []
        for segment in path.segments:
            if self.states:
                self.ways.append(JUMP if path.jumps_to(segment) else STABLE)
            first = len(self.states)
            self.states += path.along(segment)
            self.spans.append((first, len(self.states) - 1))
            self.ways += (len(self.states) - 1 - first) * [STABLE if segment.stable else UNSTABLE]
        self.limits = _limits(path, self.spans)
        limits = {mark.point for mark in self.limits}
        events = _events(result, self.spans) if len(result.events) <= MOST_MARKS else []
        self.marks = [mark for mark in events if mark.what != "turns" and mark.point not in limits] + self.limits
        self.lands = bool(path.ending and path.limits) and path.limits[-1].landing is not None
        if self.lands:
            self.states.append(path.limits[-1].landing)
            self.ways.append(JUMP)
        self.factors = np.array([step.factor for step in self.states])

    def runs(self) -> list[tuple[int, slice]]:
        """Cut the path where the way of going on changes.

        Returns
        -------
        list of (int, slice)
            STABLE, UNSTABLE or JUMP, and the points.
        """
        cuts = [0, *(k for k, (a, b) in enumerate(pairwise(self.ways), 1) if a != b), len(self.ways)]
        return [(self.ways[a], slice(a, b + 1)) for a, b in pairwise(cuts)]

    def end(self) -> int:
        """Find the point at the right edge of the picture, the last of several."""
        return int(np.flatnonzero(self.factors == self.factors.max())[-1])

    def note(self) -> str:
        """Say what lines and marks mean, as far as they occur."""
        named = {_kind(mark.what) for mark in self.marks}
        named |= {name for name, way in (("unstable", UNSTABLE), ("jump", JUMP)) if way in self.ways}
        what = " or ".join(sorted({mark.what for mark in self.marks if _kind(mark.what) == "kink"}))
        notes = [text.format(what=what) for name, text in NOTES.items() if name in named]
        if self.lands:
            notes[-1] = "arrow and diamonds: where the load would jump to"
        return "; ".join(notes)


def _kind(what: str) -> str:
    return {"opens": "closes"}.get(what, what if what in ("closes", "breaks", "limit") else "kink")


def _events(result: Result, spans: list[tuple[int, int]]) -> list[Mark]:
    """Find the ends of segments at which events happen; both go along the path."""
    stops = [segment.stop for segment in result.path.segments]
    found, at = [], 0
    for event in result.events:
        there = next((k for k in range(at, len(stops)) if stops[k] == event.factor), None)
        if there is not None:
            at = there
            found.append(Mark(spans[at][1], event.support, event.event))
    return found


def _limits(path: BranchPath, spans: list[tuple[int, int]]) -> list[Mark]:
    found, at = [], 0
    for limit in path.limits:
        there = (k for k in range(at, len(path.segments)) if path.segments[k].stop == limit.factor)
        k = next((k for k in there if path.segments[k].leg == limit.leg), None)
        if k is not None:
            at = k
            found.append(Mark(spans[k][1], -1, "limit"))
    return found


def draw_trace(
    axes: Axes, trace: Trace, k: int, values: np.ndarray, style: dict, arrows: bool, alike: Sequence[int] = ()
) -> None:
    """Draw the line of a support and its marks.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        Where.
    trace : Trace
        The path.
    k : int
        Number of the support.
    values : numpy.ndarray
        At the points of the path.
    style : dict
        Of its line.
    arrows : bool
        Whether to show the direction of the path.
    alike : sequence of int
        Supports whose line it is too.
    """
    named = False
    for way, points in trace.runs():
        x, y = trace.factors[points], values[points]
        if way == JUMP:
            for ends in pairwise(zip(x, y, strict=True)):
                _arrow(axes, *ends, {"arrowstyle": "->", "linewidth": 0.7, "color": "0.4"})
            if trace.lands and points.stop == len(trace.states):
                axes.plot(x[-1], y[-1], "D", color="black", markerfacecolor="white", markersize=4, clip_on=False)
            continue
        label = None if named else f"support {k}"
        named = named or way == STABLE
        if way == UNSTABLE:
            axes.plot(x, y, linewidth=1.0, color="0.4", linestyle=(0, (0.8, 2.4)), clip_on=False,
                      label=f"unstable {k}")  # fmt: skip
        else:
            axes.plot(x, y, linewidth=1.5, clip_on=False, label=label, **style)
    if arrows and 2 * len(trace.spans) <= MOST_POINTS:
        for first, last in trace.spans:
            middle = (trace.factors[first] + trace.factors[last]) / 2
            j = first + int(np.abs(trace.factors[first:last] - middle).argmin()) if last > first + 1 else first
            x, y = trace.factors[j : j + 2], values[j : j + 2]
            if abs(trace.factors[last] - trace.factors[first]) > 0.12 * np.ptp(trace.factors):
                near = [(x[0] + share * (x[1] - x[0]), y[0] + share * (y[1] - y[0])) for share in (0.6, 0.62)]
                _arrow(axes, *near, {"arrowstyle": "-|>", "linewidth": 0.0, "color": style["color"], "mutation_scale": 10.0})
    for point, support, what in trace.marks:
        if what == "limit":
            axes.plot(trace.factors[point], values[point], "^", color="black", markersize=6.5, clip_on=False)
        elif support == k or support in alike:
            marker, face = MARKERS.get(what, KINK)
            axes.plot(trace.factors[point], values[point], marker, color="black", markerfacecolor=face,
                      markersize=5 if marker == "o" else 4.2, clip_on=False)  # fmt: skip


def _arrow(axes: Axes, start: tuple[float, float], stop: tuple[float, float], look: dict) -> None:
    axes.annotate("", stop, start, arrowprops={"shrinkA": 0.0, "shrinkB": 0.0, **look}, annotation_clip=False)


def name_limits(axes: Axes, trace: Trace) -> None:
    """Write the limit loads above the panel, as far as there is room.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        The upper panel.
    trace : Trace
        The path.
    """
    low, high = axes.get_xlim()
    taken: list[float] = []
    for factor in sorted({float(trace.factors[mark.point]) for mark in trace.limits}, reverse=True):
        share = (factor - low) / (high - low)
        if all(abs(share - other) > 0.14 for other in taken):
            taken.append(share)
            axes.text(share, 1.02, with_minus_signs(f"limit {fmt.number(factor, 5)}"), fontsize=7.5, color="0.3", va="bottom",
                      ha="right" if share > 0.9 else "left" if share < 0.1 else "center", transform=axes.transAxes)  # fmt: skip
