"""From a scene to the engine's arrays, leaving out what the scene does not need.

The beam is cut into pieces wherever anything changes: at span ends, supports, hinges, ends of sections and of
distributed loads, point loads. A place is kept as a span and the distance from its left end, so that a short span
far from the origin keeps its digits. Only beam ends, supports and hinges become nodes of the system, and on overhangs
the places of loads: the moments there follow from the loads farther out alone.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from operator import attrgetter

import numpy as np

from ..base.records import Record, read_only
from ..scene.checks import SIDES, contact_levels, rotational_stiffnesses
from ..scene.places import find_nearby_points, find_points
from ..scene.structs import (
    AxialLoad,
    CurvatureLoad,
    ForceLoad,
    LinearLoad,
    MomentLoad,
    Scene,
    UniformLoad,
)
from .arrays import EngineArrays, refuse_range, to_engine
from .axial import Axial, lower_axial
from .units import Units, choose_units

PLAIN, HINGE, RESTRAINED = 0, 1, 2
"""Kinds of node, as in gapbeam_band."""
CASES = {"dead": 0, "live": 1}
KINDS_OF_LOADS = (ForceLoad, MomentLoad, AxialLoad, UniformLoad, LinearLoad, CurvatureLoad)
"""Loads at a point, along the beam, and on a stretch."""


@dataclass(frozen=True, eq=False)
class Arrays(Record):
    """A scene as arrays, in its own units; `engine` is what the engine takes.

    Attributes
    ----------
    ends : numpy.ndarray
        x of the span ends.
    point_span, point_offset, point_x : numpy.ndarray
        Place of every point between pieces: its span, the distance from the span's left end, and x.
    pieces : numpy.ndarray
        Length, EI, GA of every piece, n by 3.
    dead, live : numpy.ndarray
        Load per length at the left and right end of every piece, imposed curvature, force and couple at its right end
        unless a node is there, n by 5.
    node_points : numpy.ndarray of int
        The points that are nodes.
    kinds : numpy.ndarray of int
        PLAIN, HINGE or RESTRAINED for every node.
    turning : numpy.ndarray
        Stiffness of the rotational restraint of every node, 0 where there is none.
    force, couple : numpy.ndarray
        Dead and live force and couple at every node, nodes by 2.
    supports : numpy.ndarray of int
        Supports across the beam that can carry, by their number in the scene.
    support_nodes, support_sides : numpy.ndarray of int
        Node and side of each of them.
    support_stiffness, support_contact : numpy.ndarray
        Stiffness, and deflection at which it begins to act.
    across : numpy.ndarray of bool
        Which supports of the scene are across the beam, not axial.
    places : numpy.ndarray of int
        Node of every support of the scene; 0 for axial ones.
    sides : numpy.ndarray of int
        Side of every support of the scene.
    levels : numpy.ndarray
        Deflection at which every support of the scene begins to act; 0 for axial ones.
    couple_share : numpy.ndarray
        The share every support of the scene has in the rotational restraint of its node.
    axial : Axial or None
        The axial system, if the scene needs it.
    """

    ends: np.ndarray
    point_span: np.ndarray
    point_offset: np.ndarray
    point_x: np.ndarray
    pieces: np.ndarray
    dead: np.ndarray
    live: np.ndarray
    node_points: np.ndarray
    kinds: np.ndarray
    turning: np.ndarray
    force: np.ndarray
    couple: np.ndarray
    supports: np.ndarray
    support_nodes: np.ndarray
    support_sides: np.ndarray
    support_stiffness: np.ndarray
    support_contact: np.ndarray
    across: np.ndarray
    places: np.ndarray
    sides: np.ndarray
    levels: np.ndarray
    couple_share: np.ndarray
    axial: Axial | None

    @cached_property
    def units(self) -> Units:
        """The engine's units."""
        return choose_units(self)

    @cached_property
    def engine(self) -> EngineArrays:
        """The same in the engine's units."""
        return to_engine(self, self.units)

    @cached_property
    def _first_points(self) -> np.ndarray:
        """The point at every span end, and the number of points."""
        return read_only(np.searchsorted(self.point_span, np.arange(len(self.ends) + 1)))

    def find_pieces(self, x: np.ndarray, left: bool) -> tuple[np.ndarray, np.ndarray]:
        """Find the piece of given places.

        Parameters
        ----------
        x : numpy.ndarray
            Places on the beam.
        left : bool
            Whether the piece left of a point is meant, or that on its right.

        Returns
        -------
        piece : numpy.ndarray of int
            The pieces.
        distance : numpy.ndarray
            Distances from their left ends.
        """
        point, distance = find_nearby_points(x, self.ends, self.point_span, self.point_offset, self._first_points)
        before = (distance == 0.0) & (point > 0) & (left | (point == len(self.pieces)))
        piece = np.where(before, point - 1, point)
        return piece, np.where(before, self.pieces[piece, 0], distance)

    @property
    def node_x(self) -> np.ndarray:
        """X of every node."""
        return read_only(self.point_x[self.node_points])


@dataclass(frozen=True, slots=True, eq=False)
class LoadRows(Record):
    """What each load of a scene does across the beam, a row for every piece or point that it acts on.

    Attributes
    ----------
    piece_load, piece : numpy.ndarray of int
        Number of the load in the scene, and the piece.
    piece_values : numpy.ndarray
        Load at both ends of the piece and imposed curvature, rows by 3.
    point_load, point : numpy.ndarray of int
        Number of the load in the scene, and the point.
    point_values : numpy.ndarray
        Force and couple, rows by 2.
    """

    piece_load: np.ndarray
    piece: np.ndarray
    piece_values: np.ndarray
    point_load: np.ndarray
    point: np.ndarray
    point_values: np.ndarray

    def spread(self, share: np.ndarray, is_node: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Sum the loads as the engine takes them.

        Parameters
        ----------
        share : numpy.ndarray
            By how much each load of the scene counts.
        is_node : numpy.ndarray of bool
            Which points are nodes.

        Returns
        -------
        pieces : numpy.ndarray
            Loads of every piece and at its right end, pieces by 5; what acts on a node is the node's alone.
        nodes : numpy.ndarray
            Force and couple of every node, nodes by 2.
        """
        size = len(is_node)
        on_pieces = _sum_columns(self.piece, share[self.piece_load], self.piece_values, size - 1)
        at_points = _sum_columns(self.point, share[self.point_load], self.point_values, size)
        inside = np.where(is_node[1:, None], 0.0, at_points[1:])
        return np.hstack((on_pieces, inside)), at_points[is_node]


def _sum_columns(where: np.ndarray, weight: np.ndarray, values: np.ndarray, size: int) -> np.ndarray:
    """Sum weighted rows by place: size by columns."""
    return np.stack([np.bincount(where, weight * column, size) for column in values.T], axis=1)


def lower(scene: Scene) -> Arrays:
    """Turn a checked scene into arrays.

    Parameters
    ----------
    scene : Scene
        As `read_scene` returns it.

    Returns
    -------
    Arrays
        Contiguous double and 32-bit integer arrays.
    """
    return lower_by_load(scene)[0]


def lower_by_load(scene: Scene) -> tuple[Arrays, LoadRows]:
    """Turn a checked scene into arrays, and say what each of its loads does.

    Parameters
    ----------
    scene : Scene
        As `read_scene` returns it.

    Returns
    -------
    Arrays
        As from `lower`.
    LoadRows
        The loads one by one.
    """
    ends = scene.span_ends()
    lengths = np.asarray(scene.beam.spans, dtype=float)
    kinds_of_loads = np.array(list(map(KINDS_OF_LOADS.index, map(type, scene.loads))), dtype=int)
    point_load = np.flatnonzero(kinds_of_loads < 2)
    stretch_load = np.flatnonzero(kinds_of_loads > 2)
    at_a_point, stretches = ([scene.loads[k] for k in some] for some in (point_load, stretch_load))

    points = find_points(scene, ends)
    span, offset = points.span, points.offset
    at_loads = points.load_from[point_load]
    load_from, load_to = points.load_from[stretch_load], points.load_to[stretch_load]

    pieces, EA = _pieces(scene, lengths, span, offset, points.section_from, points.section_to)
    q, bent = _end_values(stretches, kinds_of_loads[stretch_load])
    stretch, piece, piece_values = _distributed(q, bent, ends, span, offset, load_from, load_to)
    point_values = np.zeros((len(at_a_point), 2))
    for column, name in enumerate(("F", "M")):
        some = np.flatnonzero(kinds_of_loads[point_load] == column)
        point_values[some, column] = [getattr(at_a_point[k], name) for k in some]
    rows = LoadRows(stretch_load[stretch], piece, piece_values, point_load, at_loads, point_values)

    across = np.array([support.direction == "normal" for support in scene.supports], dtype=bool)
    at_normal = points.supports[across]
    is_node = np.zeros(len(span), dtype=bool)
    is_node[[0, -1]] = True
    is_node[points.hinges] = True
    is_node[at_normal] = True
    is_node |= _beyond(at_normal, len(span)) & _bears(len(span), at_loads, load_from, load_to)
    node_of_point = np.cumsum(is_node) - 1
    kinds = np.zeros(node_of_point[-1] + 1, dtype=np.int32)
    kinds[node_of_point[points.hinges]] = HINGE
    places = np.where(across, node_of_point[points.supports], 0).astype(np.int32)
    turning, couple_share = _restraints(scene.supports, places, kinds)
    sides = np.array([SIDES[support.side] for support in scene.supports], dtype=np.int32)
    stiffness = np.array([support.stiffness for support in scene.supports], dtype=float)
    levels = np.where(across, contact_levels(scene.supports), 0.0)
    carries = np.flatnonzero(across & ((stiffness > 0.0) | (sides == 0)))

    shares = [np.array([load.case == case for load in scene.loads], dtype=float) for case in CASES]
    (dead, dead_nodes), (live, live_nodes) = (rows.spread(share, is_node) for share in shares)
    arrays = Arrays(
        ends=ends,
        point_span=span,
        point_offset=offset,
        point_x=ends[span] + offset,
        pieces=pieces,
        dead=dead,
        live=live,
        node_points=np.flatnonzero(is_node),
        kinds=kinds,
        turning=turning,
        force=np.stack((dead_nodes[:, 0], live_nodes[:, 0]), axis=1),
        couple=np.stack((dead_nodes[:, 1], live_nodes[:, 1]), axis=1),
        supports=carries,
        support_nodes=places[carries],
        support_sides=sides[carries],
        support_stiffness=stiffness[carries],
        support_contact=levels[carries],
        across=across,
        places=places,
        sides=sides,
        levels=levels,
        couple_share=couple_share,
        axial=lower_axial(scene, points, ends[span] + offset, pieces[:, 0], EA),
    )
    return arrays, rows


def _beyond(at_supports: np.ndarray, count: int) -> np.ndarray:
    """Which points lie beyond the outermost supports."""
    beyond = np.zeros(count, dtype=bool)
    if at_supports.size:
        beyond[: at_supports.min()] = True
        beyond[at_supports.max() + 1 :] = True
    return beyond


def _bears(count: int, *places: np.ndarray) -> np.ndarray:
    """Which points are among places of loads."""
    bears = np.zeros(count, dtype=bool)
    for part in places:
        bears[part] = True
    return bears


def _expand(start: np.ndarray, stop: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """All pieces start..stop-1 of every stretch, and the stretch of each."""
    counts = stop - start
    owner = np.repeat(np.arange(len(start), dtype=np.int32), counts)
    before = np.cumsum(counts) - counts  # pieces of earlier stretches
    pieces = np.repeat((start - before).astype(np.int32), counts)
    pieces += np.arange(len(owner), dtype=np.int32)
    return pieces, owner


def _pieces(scene, lengths, span, offset, start, stop) -> tuple[np.ndarray, np.ndarray]:
    """Length and stiffnesses of every piece; later sections win."""
    left = span[:-1]
    pieces = np.empty((len(left), 3))
    pieces[:, 0] = np.where(span[1:] == left, offset[1:], lengths[left]) - offset[:-1]
    axial = np.empty(len(left))
    covered, owner = _expand(start, stop)
    for name, column in (("EI", pieces[:, 1]), ("GA", pieces[:, 2]), ("EA", axial)):
        column[:] = np.broadcast_to(np.asarray(getattr(scene.beam, name), dtype=float), lengths.shape)[left]
        given = np.array(list(map(attrgetter(name), scene.sections)), dtype=float)  # nan where left out
        if not np.all(np.isnan(given)):
            values = given[owner]
            valid = ~np.isnan(values)
            column[covered[valid]] = values[valid]  # of several values for one piece numpy keeps the last
    return pieces, axial


def _distributed(q, bent, ends, span, offset, start, stop) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """For every piece under a load: the load, the piece, and load at its ends and imposed curvature."""
    piece, load = _expand(start, stop)
    values = np.zeros((len(piece), 3))
    if not len(q):
        return load, piece, values

    def distance(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        return (ends[span[b]] - ends[span[a]]) + (offset[b] - offset[a])

    values[:, :2] = q[load, :1]
    sloped = np.flatnonzero((q[:, 0] != q[:, 1])[load])
    if len(sloped):
        owner, at = load[sloped], piece[sloped]
        for column in (0, 1):
            share = distance(start[owner], at + column) / distance(start[owner], stop[owner])
            values[sloped, column] = q[owner, 0] * (1.0 - share) + q[owner, 1] * share
    if bent.any():
        values[:, 2] = np.where(bent[load], values[:, 0], 0.0)
        values[bent[load], :2] = 0.0
    return load, piece, values


def _end_values(loads, kinds) -> tuple[np.ndarray, np.ndarray]:
    """Values of distributed loads at both their ends, and which of them are curvatures."""
    values = np.zeros((len(loads), 2))
    for kind, name in ((UniformLoad, "q"), (LinearLoad, "q"), (CurvatureLoad, "kappa")):
        some = np.flatnonzero(kinds == KINDS_OF_LOADS.index(kind))
        if len(some):
            found = np.array(list(map(attrgetter(name), map(loads.__getitem__, some.tolist()))), dtype=float)
            values[some] = found.reshape(len(some), -1)
    return values, kinds == KINDS_OF_LOADS.index(CurvatureLoad)


def _restraints(supports, places, kinds) -> tuple[np.ndarray, np.ndarray]:
    """Rotational stiffness of every node and the share of every support in it; sets the kind of these nodes."""
    own = rotational_stiffnesses(supports)
    stiffness = np.bincount(places, own, len(kinds))
    for k in np.flatnonzero(np.isinf(stiffness) & (np.bincount(places, np.isinf(own), len(kinds)) == 0.0))[:1]:
        which = np.flatnonzero(places == k)[-1]
        refuse_range(f"the rotations of supports[{which}] and others at its place are too great together", 'give "fixed"')
    kinds[stiffness > 0.0] = RESTRAINED
    elastic = (own > 0.0) & np.isfinite(own)
    share = np.where(np.isinf(own), 1.0, 0.0)
    np.divide(own, stiffness[places], out=share, where=elastic)
    return stiffness, share
