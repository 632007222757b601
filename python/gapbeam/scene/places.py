"""Places along the beam, kept as a span and the distance from its left end: a short span far from the origin keeps its digits.

Places that differ by rounding only (`POSITION_TOLERANCE`) count as one **point**: a place becomes the span end that is so
near, else the nearest support or hinge, else the first of the loads' and sections' ends to its left. What is near is near
to the point itself, not to another place near it, so no chain of places can become one: no place is moved by more than the
tolerance, and no two points of a span are nearer to each other than that.
"""

from __future__ import annotations

from dataclasses import dataclass
from operator import attrgetter
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .structs import Scene

POSITION_TOLERANCE = 64 * float(np.finfo(float).eps)
"""Positions whose difference is at most this share of the larger one differ by rounding only."""


def same_place(a: Any, b: Any) -> Any:
    """Whether positions differ by rounding only.

    Parameters
    ----------
    a, b : float or numpy.ndarray
        Positions along the beam (length).

    Returns
    -------
    bool or numpy.ndarray of bool

    Examples
    --------
    >>> bool(same_place(6.0, 6.000000000000001)), bool(same_place(6.0, 6.0000000001))
    (True, False)
    """
    return np.abs(np.subtract(a, b)) <= POSITION_TOLERANCE * np.maximum(np.abs(a), np.abs(b))


def locate(x: np.ndarray, ends: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Span and distance from its left end of given places.

    Parameters
    ----------
    x : numpy.ndarray
        Places along the beam.
    ends : numpy.ndarray
        x of the span ends.

    Returns
    -------
    span : numpy.ndarray of int
        The span; the right end of the beam is the left end of a span that does not exist.
    offset : numpy.ndarray
        Exactly 0 at a span end, also for an x that differs from it by rounding only.
    """
    span = np.clip(np.searchsorted(ends, x, side="right") - 1, 0, len(ends) - 2)
    tolerance = POSITION_TOLERANCE * np.abs(x)
    at_right = ends[span + 1] - x <= tolerance
    span = span + at_right
    offset = np.where(at_right, 0.0, x - ends[span])
    return span, np.where(offset <= tolerance, 0.0, offset)


@dataclass(frozen=True, slots=True)
class Points:
    """The points of a scene from left to right, and at which of them its parts are.

    Attributes
    ----------
    span, offset : numpy.ndarray
        Span of every point, and the distance from its left end.
    supports, hinges : numpy.ndarray of int
        Point of every support and hinge.
    section_from, section_to, load_from, load_to : numpy.ndarray of int
        Points between which every section and every load acts; a load at one place from and to the same point.
    """

    span: np.ndarray
    offset: np.ndarray
    supports: np.ndarray
    hinges: np.ndarray
    section_from: np.ndarray
    section_to: np.ndarray
    load_from: np.ndarray
    load_to: np.ndarray


def find_points(scene: Scene, ends: np.ndarray) -> Points:
    """Find the points of a scene.

    Parameters
    ----------
    scene : Scene
        Every place in it is on the beam.
    ends : numpy.ndarray
        x of the span ends.

    Returns
    -------
    Points
        Span ends among them.
    """
    places = _Places(ends)
    supports = places.add_items(scene.supports)
    hinges = places.add_x(np.asarray(scene.beam.hinges, dtype=float))
    anchors = places.number
    section_from, section_to = places.add_stretches(scene.sections)
    has_node = np.array([hasattr(load, "node") for load in scene.loads], dtype=bool)
    at_a_place, along = np.flatnonzero(has_node), np.flatnonzero(~has_node)
    at = places.add_items([scene.loads[k] for k in at_a_place])
    start, stop = places.add_stretches([scene.loads[k] for k in along])
    span, offset, index = places.merge(anchors)
    load_from, load_to = np.empty(len(scene.loads), dtype=np.int32), np.empty(len(scene.loads), dtype=np.int32)
    load_from[at_a_place] = load_to[at_a_place] = index[at]
    load_from[along], load_to[along] = index[start], index[stop]
    return Points(span, offset, index[supports], index[hinges], index[section_from], index[section_to], load_from, load_to)


def find_nearby_points(
    x: np.ndarray, ends: np.ndarray, point_span: np.ndarray, point_offset: np.ndarray, first: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Find the points at given places, or left of them.

    Parameters
    ----------
    x : numpy.ndarray
        Places on the beam.
    ends : numpy.ndarray
        x of the span ends.
    point_span, point_offset : numpy.ndarray
        Span and distance from its left end of every point.
    first : numpy.ndarray of int
        The point at every span end, and the number of points.

    Returns
    -------
    point : numpy.ndarray of int
        The nearest point that differs by rounding only; else the next one to the left, in the same span.
    distance : numpy.ndarray
        Distance from it, 0 in the first case.
    """
    span, offset = locate(x, ends)
    # The last point that is not right of the place. Spans and offsets are compared as they are: counted from the left end
    # of a long beam a place would lose the digits of its offset
    point, beyond = first[span], first[span + 1]
    while np.any(beyond - point > 1):
        middle = (point + beyond) // 2
        not_right = point_offset[middle] <= offset
        point, beyond = np.where(not_right, middle, point), np.where(not_right, beyond, middle)
    after = np.minimum(point + 1, len(point_offset) - 1)
    to_left = offset - point_offset[point]
    to_right = np.where(point_span[after] == span, point_offset[after] - offset, np.inf)
    tolerance = POSITION_TOLERANCE * (ends[span] + offset)
    at_right = (to_right <= tolerance) & (to_right < to_left)
    return np.where(at_right, after, point), np.where(at_right | (to_left <= tolerance), 0.0, to_left)


class _Places:
    """Collects places and merges those that differ by rounding only."""

    def __init__(self, ends: np.ndarray):
        self.ends = ends
        self.spans = [np.arange(len(ends), dtype=np.int32)]
        self.offsets = [np.zeros(len(ends))]
        self.number = len(ends)

    def _add(self, span: np.ndarray, offset: np.ndarray) -> slice:
        self.spans.append(span.astype(np.int32))
        self.offsets.append(offset)
        self.number += len(span)
        return slice(self.number - len(span), self.number)

    def add_x(self, x: np.ndarray) -> slice:
        return self._add(*locate(x, self.ends))

    def add_items(self, items: Sequence) -> slice:
        """Supports or point loads, given by node or by x."""
        by_node = np.array([item.x is None for item in items], dtype=bool)
        x = np.array([0.0 if item.x is None else item.x for item in items], dtype=float)
        span, offset = locate(x, self.ends)
        span[by_node] = [item.node for item in items if item.x is None]
        offset[by_node] = 0.0
        return self._add(span, offset)

    def add_stretches(self, items: Sequence) -> tuple[slice, slice]:
        """Both ends of sections or distributed loads."""
        start = np.array(list(map(attrgetter("from_"), items)), dtype=float)
        stop = np.array(list(map(attrgetter("to"), items)), dtype=float)  # nan where left out
        return self.add_x(start), self.add_x(np.where(np.isnan(stop), self.ends[-1], stop))

    def merge(self, anchors: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Distinct points from left to right, and for every collected place the number of its point.

        The first `anchors` places are span ends, supports and hinges. Nothing collected is kept, and the work is done in
        place: this is where a large scene needs most memory.
        """
        span, offset = np.concatenate(self.spans), np.concatenate(self.offsets)
        self.spans.clear()
        self.offsets.clear()
        order = np.lexsort((offset, span))
        span, offset = span[order], offset[order]
        tolerance = self.ends[span]
        tolerance += offset
        tolerance *= POSITION_TOLERANCE
        # For every place, from left to right, the one that stands for its point
        stands = np.empty(len(order), dtype=np.int32)
        anchor, rest = np.flatnonzero(order < anchors), np.flatnonzero(order >= anchors)
        stands[anchor] = anchor[_first_of_point(span[anchor], offset[anchor], tolerance[anchor])]
        stands[rest] = _nearest(anchor[stands[anchor] == anchor], rest, span, offset, tolerance)
        rest = rest[stands[rest] < 0]
        stands[rest] = rest[_first_of_point(span[rest], offset[rest], tolerance[rest])]
        chosen = stands == np.arange(len(order))
        index = np.empty(len(order), dtype=np.int32)
        index[order] = (np.cumsum(chosen, dtype=np.int32) - 1)[stands]
        return span[chosen], offset[chosen], index


def _first_of_point(span: np.ndarray, offset: np.ndarray, tolerance: np.ndarray) -> np.ndarray:
    """For every place, from left to right, the first of its point: a point ends where its first is too far to the left."""
    number = np.arange(len(span), dtype=np.int32)
    first = np.ones(len(span), dtype=bool)
    first[1:] = (np.diff(offset) > tolerance[1:]) | (span[1:] != span[:-1])
    begin = np.maximum.accumulate(np.where(first, number, 0))
    # Only in a chain, where each place is near the one before, can one be far from the first
    chain = last = -1
    for i in np.flatnonzero(offset - offset[begin] > tolerance).tolist():
        if begin[i] != chain:
            chain = last = begin[i]
        if offset[i] - offset[last] > tolerance[i]:
            first[i] = True
            last = i
    return np.maximum.accumulate(np.where(first, number, 0))


def _nearest(
    points: np.ndarray, places: np.ndarray, span: np.ndarray, offset: np.ndarray, tolerance: np.ndarray
) -> np.ndarray:
    """For every place the nearest of the given points within the tolerance, -1 where there is none."""
    at = np.searchsorted(points, places)
    left, right = points[at - 1], points[np.minimum(at, len(points) - 1)]
    to_left, to_right = offset[places] - offset[left], offset[right] - offset[places]
    near_left = to_left <= tolerance[places]
    near_right = (span[right] == span[places]) & (right > places) & (to_right <= tolerance[right])
    return np.where(near_right & ~(near_left & (to_left <= to_right)), right, np.where(near_left, left, -1))
