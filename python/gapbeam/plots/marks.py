"""Values beside a curve: the largest ones first, each where it covers neither another one nor a symbol nor the axes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from ..results import formatting as fmt
from .panels import LEFT, PANEL, RIGHT, WIDTH, Point

if TYPE_CHECKING:
    from ..results.state.fields import Fields

DIGITS = 4
"""Of a value."""
MOST_MARKS = 24
"""Largest values of spans that are written, where there is room."""
WORTH = 0.02
"""Share of the largest value from which one of a span is written."""
LETTER, HIGH, OFF = 4.6, 8.5, 4.0
"""Width of a letter, height of a line, distance from the point (points of 1/72 inch)."""
ROUNDS = 8
"""Secants to a zero of the shear."""


class Marks:
    """The labels of a panel; its limits along both axes are set before.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        The panel.
    factor : float
        How many shown units are one of the scene, for example 1000 for mm.
    avoid : sequence of (float, float)
        Points that labels keep clear of.
    curve : (numpy.ndarray, numpy.ndarray), optional
        What is drawn; labels cover as little of it as may be.
    """

    def __init__(
        self, axes: Axes, factor: float = 1.0, avoid: Sequence[Point] = (), curve: tuple[np.ndarray, np.ndarray] | None = None
    ) -> None:
        self.axes, self.factor = axes, factor
        self.width, self.height = (WIDTH - LEFT - RIGHT) * 72, PANEL * 72
        self.taken: list[tuple[float, float, float, float]] = []
        self.avoid = self._points(np.array(avoid, dtype=float).reshape(-1, 2))
        self.curve = np.zeros((0, 2))
        if curve is not None:
            x = np.linspace(curve[0][0], curve[0][-1], int(self.width))
            self.curve = self._points(np.column_stack((x, np.interp(x, *curve))))

    def extreme(self, value: float, x: float, more: str = "") -> None:
        """Write an extreme and its place, which are never left out."""
        self._write(value, x, f"{self._number(value)} at {fmt.number(x, DIGITS)}{more}".replace("-", "\N{MINUS SIGN}"), must=True)

    def peak(self, value: float, x: float) -> None:
        """Write a value where there is room."""
        self._write(value, x, self._number(value).replace("-", "\N{MINUS SIGN}"), must=False)

    def _number(self, value: float) -> str:
        return fmt.number(self.factor * value, DIGITS)

    def _points(self, places: np.ndarray) -> np.ndarray:
        """Give places of the panel in points from its lower left corner."""
        (left, right), (low, high) = self.axes.get_xlim(), self.axes.get_ylim()
        return (places - (left, low)) / (right - left, high - low) * (self.width, self.height)

    def _write(self, value: float, x: float, text: str, must: bool) -> None:
        up = (value > 0.0) != self.axes.yaxis_inverted()
        (at, foot), wide = self._points(np.array([[x, value]]))[0], LETTER * len(text) + 2.0
        starts = {"center": at - wide / 2, "left": at - 2.0, "right": at - wide + 2.0}
        found = []
        for level in range(4 if must else 1):
            away = OFF + level * HIGH
            for order, (align, start) in enumerate(starts.items()):
                box = (start, foot + away, start + wide, foot + away + HIGH)
                if not up:
                    box = (start, foot - away - HIGH, start + wide, foot - away)
                if box[0] < 2.0 or box[2] > self.width + 9.0 or box[1] < -4.0 or box[3] > self.height + 8.0 or not self._free(box):
                    continue
                covered = 20 * _inside(self.avoid, box) + _inside(self.curve, box)
                if must or not covered:
                    found.append((covered + 2 * level + order / 4, align, away, box))
        if not found and not must:
            return
        if not found:  # at an end of a long text
            start = min(max(starts["center"], 2.0), self.width + 9.0 - wide)
            found = [(0.0, "left", OFF, (start, foot, start + wide, foot + HIGH))]
        _, align, away, box = min(found)
        self.taken.append(box)
        anchor = {"center": (box[0] + box[2]) / 2, "left": box[0], "right": box[2]}[align] - at
        self.axes.plot([x], [value], "o", color="black", markersize=2.6, zorder=4)
        self.axes.annotate(text, (x, value), (anchor, away if up else -away), textcoords="offset points", fontsize=7.5, zorder=5,
                           ha=align, va="bottom" if up else "top")  # fmt: skip

    def _free(self, box: tuple[float, float, float, float]) -> bool:
        return all(
            box[0] >= other[2] + 1.0 or box[2] <= other[0] - 1.0 or box[1] >= other[3] or box[3] <= other[1] for other in self.taken
        )


def _inside(points: np.ndarray, box: tuple[float, float, float, float]) -> int:
    """Count points in a rectangle."""
    x, y = points.T
    return int(((x > box[0]) & (x < box[2]) & (y > box[1]) & (y < box[3])).sum())


def find_peaks(fields: Fields, ends: np.ndarray, at: Callable[[np.ndarray], Fields]) -> list[tuple[float, float]]:
    """Find the largest and the smallest moment of every span, where the shear is zero or jumps.

    Parameters
    ----------
    fields : Fields
        At points along the beam.
    ends : numpy.ndarray
        Ends of the spans.
    at : callable
        Gives exact fields at places.

    Returns
    -------
    list of (float, float)
        Values and places, the largest first; only those that are worth a label.
    """
    x, moment = fields.x, fields.moment
    first = np.searchsorted(x, ends)
    found = set()
    for a, b in pairwise(first.tolist()):
        if b > a:
            found |= {a + int(np.argmax(moment[a : b + 1])), a + int(np.argmin(moment[a : b + 1]))}
    worth = WORTH * np.abs(moment).max(initial=0.0)
    chosen = sorted((k for k in found if abs(moment[k]) > worth), key=lambda k: -abs(moment[k]))[: 2 * MOST_MARKS]
    low = x[[max(0, k - 1) for k in chosen]]
    high = x[[min(len(x) - 1, k + 1) for k in chosen]]
    middle = x[chosen]
    if not len(middle):
        return []
    # On the side on which the shear changes its sign; by secants that keep a bracket (the Illinois rule)
    left, here = at(low).shear, at(middle).shear
    on_left = left * here < 0.0
    low, high = np.where(on_left, low, middle), np.where(on_left, middle, high)
    a, b = np.where(on_left, left, here), at(high).shear
    inside = low + (high - low) / 2
    for _ in range(ROUNDS):
        share = np.divide(a, a - b, out=np.where(np.abs(a) <= np.abs(b), 0.0, 1.0), where=a * b < 0.0)
        inside = low + (high - low) * share
        shear = at(inside).shear
        same = shear * a > 0.0
        low, high = np.where(same, inside, low), np.where(same, high, inside)
        a, b = np.where(same, shear, a / 2), np.where(same, b / 2, shear)
    values, before = at(inside).moment, at(middle).moment
    better = np.sign(before) * (values - before) > 0.0
    pairs = zip(np.where(better, values, before).tolist(), np.where(better, inside, middle).tolist(), strict=True)
    return sorted(set(pairs), key=lambda pair: -abs(pair[0]))
