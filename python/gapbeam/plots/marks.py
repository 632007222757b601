"""Values beside a curve: the largest ones first, each where it covers neither another one nor a symbol nor the axes."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise, product
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from ..base.characters import with_minus_signs
from ..results import formatting as fmt
from .labels import measured_width
from .panels import Point
from .turned import Turned, is_turned, raw

if TYPE_CHECKING:
    from ..results.state.fields import Fields

DIGITS = 4
"""Of a value."""
MOST_MARKS = 24
"""Largest values of spans that are written, where there is room."""
WORTH = 0.02
"""Share of the largest value from which one of a span is written."""
LETTERS, HIGH, OFF, NEAR = 7.5, 8.5, 4.0, 5.0
"""Size of letters, height of a line, distance from the point, from symbols (points of 1/72 inch)."""
FAR = 1.8
"""Lines between a label and its point from which a leader connects them."""
INWARD = 12.0
"""Price of a label on the side of the axis: as that of six lines farther off."""
JUMP = 16
"""Points on a jump."""
ROUNDS = 8
"""Secants to a zero of the shear."""


Box = tuple[float, float, float, float]
"""Left, lower, right and upper edge (points)."""


class Marks:
    """The labels of a panel; its limits along both axes are set before.

    Parameters
    ----------
    axes : matplotlib.axes.Axes or Turned
        The panel.
    factor : float
        How many shown units are one of the scene, for example 1000 for mm.
    avoid : sequence of (float, float)
        Points that labels keep clear of.
    curves : sequence of (numpy.ndarray, numpy.ndarray)
        What is drawn; labels cover as little of it as may be.
    """

    def __init__(
        self, axes: Axes | Turned, factor: float = 1.0, avoid: Sequence[Point] = (),
        curves: Sequence[tuple[np.ndarray, np.ndarray]] = (),
    ) -> None:
        self.axes, self.factor, self.turned = axes, factor, is_turned(axes)
        size = axes.figure.bbox_inches.size * 72 * raw(axes).get_position().size
        self.width, self.height = size.tolist()
        self.taken: list[Box] = []
        self.written: set[tuple[str, str]] = set()
        self.avoid = self._points(np.array(avoid, dtype=float).reshape(-1, 2))
        along = int(max(self.width, self.height))
        self.curve = np.concatenate([np.zeros((0, 2)), *(self._along(x, y, along) for x, y in curves)])

    def _along(self, x: np.ndarray, y: np.ndarray, count: int) -> np.ndarray:
        """Give points on a curve, near one another on jumps too (points)."""
        at = np.linspace(x[0], x[-1], count)
        found = self._points(np.column_stack((at, np.interp(at, x, y))))
        steps = np.diff(found, axis=0)
        steep = np.abs(steps).max(axis=1) > HIGH / 2
        between = [found[:-1][steep] + share * steps[steep] for share in np.linspace(0.0, 1.0, JUMP)]
        return np.concatenate((found, *between))

    def extreme(self, value: float, x: float, more: str = "") -> None:
        """Write an extreme and its place, which are never left out, but once only of a constant."""
        if not more and (self._number(value), fmt.number(x, DIGITS)) in self.written:
            return
        self._write(value, x, with_minus_signs(f"{self._number(value)} at {fmt.number(x, DIGITS)}{more}"), must=True)

    def peak(self, value: float, x: float) -> None:
        """Write a value where there is room, unless it is written."""
        if (self._number(value), fmt.number(x, DIGITS)) in self.written:
            return
        self._write(value, x, with_minus_signs(self._number(value)), must=False)

    def _number(self, value: float) -> str:
        return fmt.number(self.factor * value, DIGITS)

    def _points(self, places: np.ndarray) -> np.ndarray:
        """Give places and values in points to the right and upward from the lower left corner of the panel."""
        (left, right), (low, high) = self.axes.get_xlim(), self.axes.get_ylim()
        share = (places - (left, low)) / (right - left, high - low)
        return (share[:, ::-1] * (1.0, -1.0) + (0.0, 1.0) if self.turned else share) * (self.width, self.height)

    def _boxes(self, at: np.ndarray, wide: float, outward: bool, levels: int) -> Iterator[tuple[float, str, str, Box]]:
        """Propose places for a label: the dearer the farther off; with its alignments, and its box."""
        x, y = at.tolist()
        for level in range(levels):
            away = OFF + level * HIGH
            if self.turned:
                for order, (side, start) in enumerate((("left", x + OFF), ("right", x - OFF - wide))):
                    for up, aside in product((away - OFF, OFF - away), (0.0, 2.0 * HIGH)):
                        left = start + (aside if side == "left" else -aside)
                        box = (left, y + up - HIGH / 2, left + wide, y + up + HIGH / 2)
                        yield 2 * level + aside / HIGH + (order != (not outward)) / 2, side, "center", box
                continue
            for up in (outward, not outward) if levels > 1 else (outward,):
                foot, price = y + away if up else y - away - HIGH, 2 * level + INWARD * (up != outward)
                for order, (align, start) in enumerate((("center", x - wide / 2), ("left", x - 2.0), ("right", x - wide + 2.0))):
                    yield price + order / 4, align, "bottom" if up else "top", (start, foot, start + wide, foot + HIGH)

    def _write(self, value: float, x: float, text: str, must: bool) -> None:
        outward = (value > 0.0) != self.axes.yaxis_inverted()
        at, wide = self._points(np.array([[x, value]]))[0], measured_width(text, LETTERS) + 2.0
        found = []
        out = 5.0 * self.turned  # there is room beside the panels of upright beams
        for price, align, upright, box in self._boxes(at, wide, outward, (5 + 5 * self.turned) if must else 1):
            aside = box[0] < 2.0 - 2.0 * out or box[2] > self.width + 9.0 + out
            if aside or box[1] < 1.0 - out or box[3] > self.height + 8.0 or not self._free(box):
                continue
            wide_box = (box[0] - NEAR, box[1] - NEAR, box[2] + NEAR, box[3] + NEAR)
            on_others, on_curve = _inside(self.avoid, wide_box), _inside(self.curve, box)
            if must or not on_others + on_curve:
                found.append((20 * on_others + 2 * on_curve + price, align, upright, box))
        if not found and not must:
            return
        if not found:  # at an end of a long text: anywhere inside that is free
            start = min(max(at[0] - wide / 2, 2.0), self.width + 9.0 - wide)
            rows = [(start, foot, start + wide, foot + HIGH) for foot in np.arange(0.0, self.height - HIGH, HIGH / 2)]
            box = min((box for box in rows if self._free(box)), key=lambda box: abs(box[1] - at[1]), default=rows[0])
            found = [(0.0, "left", "bottom", box)]
        _, align, upright, box = min(found)
        on_line = not _inside(self.curve, box) and _inside(self.avoid, box)  # of the ground: it is interrupted there
        behind = {"bbox": {"facecolor": "white", "edgecolor": "none", "pad": 0.4, "alpha": 0.85}} if on_line else {}
        self.taken.append(box)
        self.written.add((self._number(value), fmt.number(x, DIGITS)))
        anchor = np.array([
            {"center": (box[0] + box[2]) / 2, "left": box[0], "right": box[2]}[align],
            {"center": (box[1] + box[3]) / 2, "bottom": box[1], "top": box[3]}[upright],
        ]) - at  # fmt: skip
        if abs(anchor[1]) > FAR * HIGH:
            behind["arrowprops"] = {"arrowstyle": "-", "color": "0.6", "linewidth": 0.4, "shrinkA": 0.0, "shrinkB": 1.5}
        self.axes.plot([x], [value], "o", color="black", markersize=2.6, zorder=4)
        place = (value, x) if self.turned else (x, value)
        raw(self.axes).annotate(text, place, anchor.tolist(), textcoords="offset points", fontsize=LETTERS, zorder=5, ha=align,
                                va=upright, **behind)  # fmt: skip

    def _free(self, box: Box) -> bool:
        return all(
            box[0] >= other[2] + 1.0 or box[2] <= other[0] - 1.0 or box[1] >= other[3] or box[3] <= other[1] for other in self.taken
        )


def _inside(points: np.ndarray, box: Box) -> int:
    """Count points in a rectangle."""
    x, y = points.T
    return int(((x > box[0]) & (x < box[2]) & (y > box[1]) & (y < box[3])).sum())


def find_peaks(
    x: np.ndarray, moment: np.ndarray, ends: np.ndarray, at: Callable[[np.ndarray], Fields]
) -> list[tuple[float, float]]:
    """Find the largest and the smallest moment of every span, where the shear is zero or jumps.

    Parameters
    ----------
    x, moment : numpy.ndarray
        Points along the beam, and the moment there.
    ends : numpy.ndarray
        Ends of the spans.
    at : callable
        Gives exact fields at places.

    Returns
    -------
    list of (float, float)
        Values and places, the largest first; only those that are worth a label.
    """
    first = np.searchsorted(x, ends)  # places at which something changes are there twice
    found = set()
    for a, b in pairwise(first.tolist()):
        if b > a:
            found |= {a + int(np.argmax(moment[a : b + 1])), a + int(np.argmin(moment[a : b + 1]))}
    worth = WORTH * np.abs(moment).max(initial=0.0)
    chosen = sorted((k for k in found if abs(moment[k]) > worth), key=lambda k: -abs(moment[k]))[: 2 * MOST_MARKS]
    middle = x[chosen]
    low = x[np.maximum(np.searchsorted(x, middle) - 1, 0)]
    high = x[np.minimum(np.searchsorted(x, middle, side="right"), len(x) - 1)]
    if not len(middle):
        return []
    # On the side on which the shear changes its sign; by secants that keep a bracket (the Illinois rule)
    left, here = at(low).shear, at(middle).shear
    on_left = left * here < 0.0
    low, high = np.where(on_left, low, middle), np.where(on_left, middle, high)
    a, b = np.where(on_left, left, here), at(high).shear
    zero, inside = a * b < 0.0, low + (high - low) / 2
    for _ in range(ROUNDS):
        share = np.divide(a, a - b, out=np.where(np.abs(a) <= np.abs(b), 0.0, 1.0), where=a * b < 0.0)
        inside = low + (high - low) * share
        shear = at(inside).shear
        same = shear * a > 0.0
        low, high = np.where(same, inside, low), np.where(same, high, inside)
        a, b = np.where(same, shear, a / 2), np.where(same, b / 2, shear)
    values, before = at(inside).moment, at(middle).moment
    better = zero & (np.sign(before) * (values - before) > 0.0)
    pairs = zip(np.where(better, values, before).tolist(), np.where(better, inside, middle).tolist(), strict=True)
    return sorted(set(pairs), key=lambda pair: -abs(pair[0]))
