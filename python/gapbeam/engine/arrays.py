"""Records of the arrays that go to the Fortran layer and come back."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..base.records import Record

MODULUS, GAP, PARAMETER = 1, 2, 3
"""Of what a table is, as in gapbeam_scene; the parameters of a law follow the first one."""


@dataclass(frozen=True, slots=True, eq=False)
class Columns(Record):
    """What a beam is made of, as columns with one entry more than there are numbers: f2py takes none that is empty.

    Entries lie one after another in memory (Fortran's order), as in the Fortran 77 interface.

    Attributes
    ----------
    span : numpy.ndarray
        Length, EI, GA, EA, N, mass of the spans, 6 rows.
    hinge : numpy.ndarray
        Place of every hinge, and couple per relative rotation, 2 rows.
    section : numpy.ndarray
        Left and right end of the sections; EI, GA, EA at both, N; limit of ground along the beam at both, its stiffness; powers
        of a depth that EI, GA, EA are, 15 rows.
    support_codes, support : numpy.ndarray
        Side, direction, node, way of unloading and law by its code of the supports, 5 rows of int; x, stiffness, gap, settlement,
        rotation, parameters of the law, 8 rows.
    law_supports, law : numpy.ndarray
        Points of the laws: number of the support, from 1; displacement and force, 2 rows.
    load_codes, load : numpy.ndarray
        Kind, case and node of the loads, 3 rows of int; x or left end, right end, value, value at the right end, 4 rows.
    foundation_sides, foundation : numpy.ndarray
        Side of the foundations, int; left and right end, modulus there, gap there, law and its parameters at both ends,
        shear, 14 rows.
    table_foundations, table : numpy.ndarray
        Points of the tables of foundations: number of the foundation, from 1; x, value, and of what, as in gapbeam_scene, 3 rows.
    ground_law_foundations, ground_law : numpy.ndarray
        Points of the laws of foundations: number of the foundation, from 1; displacement, force per length, and place, 3 rows.
    mass : numpy.ndarray
        Places of lumped masses, and these, 2 rows.
    axial_forces : numpy.ndarray of int
        Whether the axial forces N grow with the load factor; whether axial loads have no effect on bending; whether deflections
        stretch the beam.
    """

    span: np.ndarray
    hinge: np.ndarray
    section: np.ndarray
    support_codes: np.ndarray
    support: np.ndarray
    law_supports: np.ndarray
    law: np.ndarray
    load_codes: np.ndarray
    load: np.ndarray
    foundation_sides: np.ndarray
    foundation: np.ndarray
    table_foundations: np.ndarray
    table: np.ndarray
    ground_law_foundations: np.ndarray
    ground_law: np.ndarray
    mass: np.ndarray
    axial_forces: np.ndarray

    def of_tables(self, quantity: int) -> tuple[np.ndarray, np.ndarray]:
        """Give the points of the tables of one quantity.

        Parameters
        ----------
        quantity : int
            Of what, as in gapbeam_scene.

        Returns
        -------
        foundations, values : numpy.ndarray
            Number of the foundation, from 0, and the value of every point.
        """
        which = np.flatnonzero(self.table[2, :-1] == quantity)
        return self.table_foundations[which] - 1, self.table[1, which]

    def with_laws(self) -> np.ndarray:
        """Give the supports that have a law, by points or by its code.

        Returns
        -------
        numpy.ndarray of int
            Their numbers, from 0.
        """
        return np.union1d(self.law_supports[:-1] - 1, np.flatnonzero(self.support_codes[4, :-1]))

    def has_varying_laws(self) -> bool:
        """Whether a law of a foundation by points is not the same everywhere."""
        return bool((self.ground_law[2, :-1] > -np.finfo(float).max).any())

    def slopes_of_laws(self) -> np.ndarray:
        """Give the slopes of all pieces of the laws of foundations by points."""
        which, (way, force, place) = self.ground_law_foundations[:-1], self.ground_law[:, :-1]
        first = np.append(True, (np.diff(which) != 0) | (np.diff(place) != 0.0))[: len(which)]
        ways, forces = (np.where(first, values, np.diff(values, prepend=0.0)) for values in (way, force))
        return np.divide(forces, ways, out=np.zeros(len(ways)), where=ways > 0.0)

    def greatest_of_ground(self) -> np.ndarray:
        """Give the greatest modulus, and the greatest of every parameter of its law, of every foundation.

        Returns
        -------
        numpy.ndarray
            Moduli, then parameters, rows by foundations; 0 where there is none.
        """
        ends = self.foundation[[[2, 3], [7, 10], [8, 11], [9, 12]], :-1]
        most = ends.max(axis=1)
        for row, quantity in enumerate((MODULUS, PARAMETER, PARAMETER + 1, PARAMETER + 2)):
            np.maximum.at(most[row], *self.of_tables(quantity))
        return most


@dataclass(frozen=True, slots=True, eq=False)
class GroundChanges(Record):
    """What changes along the load of a beam on the ground, as in gapbeam_ground_path.

    Attributes
    ----------
    factor, x : numpy.ndarray
        Load factor and place of every event.
    support, foundation : numpy.ndarray of int
        Number in the scene of what changes; -1 for the other.
    branch : numpy.ndarray of int
        Of a foundation the first of the branches of its law that make up the zone.
    event : numpy.ndarray of int
        What happens, as in gapbeam_pieces.
    begins : numpy.ndarray
        Load factor at which every segment begins; none if there is no equilibrium at the first.
    closed : numpy.ndarray of int
        Its scheme, segments by supports of the engine.
    last, beyond : float
        Load factor that the path goes to; one above which there is no equilibrium for sure.
    at_limit : bool
        Whether it ends where ground that yields carries no more.
    status : int
        SOLVED, or NO_EQUILIBRIUM or BUCKLES above `last`.
    motion : numpy.ndarray
        Of the nodes there, as in `Solution`.
    slides : bool
        Whether nothing holds the beam along its axis.
    solves : int
        Linear solves.
    """

    factor: np.ndarray
    x: np.ndarray
    support: np.ndarray
    foundation: np.ndarray
    branch: np.ndarray
    event: np.ndarray
    begins: np.ndarray
    closed: np.ndarray
    last: float
    beyond: float
    at_limit: bool
    status: int
    motion: np.ndarray
    slides: bool
    solves: int


@dataclass(frozen=True, slots=True)
class Stretch:
    """A piece of the load path.

    Attributes
    ----------
    status : int
        SOLVED, or NO_EQUILIBRIUM if the beam begins to move above `factor`.
    factor : float
        How far it goes.
    closed : numpy.ndarray of int
        The scheme there, before what changes there.
    marginal : numpy.ndarray of int
        1 for the supports at zero there.
    factors : numpy.ndarray
        Load factors of the events, those at its beginning included.
    supports : numpy.ndarray of int
        Their supports, from 0.
    events : numpy.ndarray of int
        What happens to them, as in gapbeam_pieces, or -1: a change of the scheme that is no event.
    motion : numpy.ndarray
        As in `Solution`.
    solves : int
        Linear solves of the whole beam.
    nodes : int
        Nodes at which the solution was made anew besides.
    """

    status: int
    factor: float
    closed: np.ndarray
    marginal: np.ndarray
    factors: np.ndarray
    supports: np.ndarray
    events: np.ndarray
    motion: np.ndarray
    solves: int
    nodes: int


@dataclass(frozen=True, slots=True)
class History:
    """The path of the load through factors in turn, stretch by stretch.

    Attributes
    ----------
    along : numpy.ndarray
        Load factors at both ends of the stretches, n by 2.
    about : numpy.ndarray of int
        Leg (0 while the dead loads are put on, then from 1), direction (1 rising, -1 falling, 0 turning at constant load), number
        of ways in which the beam gives way by itself, ways on at the beginning, 1 if passed in a jump, 1 if its end is on the
        smooth laws, the stretch (from 1) from which on the pieces of all supports are the same; n by 7.
    limit_factors : numpy.ndarray
        Where the load could not go on.
    limits : numpy.ndarray of int
        Kind (as an index into ENDINGS), leg, last stretch before it and stretch of the landing, both from 1 (0: none); m by 4.
    others : numpy.ndarray of int
        Ways not taken at ties: stretch that was taken instead (from 1), direction, number of ways of giving way; k by 3.
    other_schemes : numpy.ndarray of int
        Their schemes, k by supports of the engine.
    runs : numpy.ndarray of int
        First and last stretch of every part on which all supports stay on their piece, a smooth law being one; r by 2.
    event_factors : numpy.ndarray
        Load factors at which something happens to a support.
    events : numpy.ndarray of int
        Number of the support in the scene, and what happens, as gapbeam_pieces numbers it; e by 2.
    ending : str
        How it ended: one of ENDINGS; empty at the last factor.
    motion : numpy.ndarray or None
        Displacements of the nodes in the mechanism in which it ended.
    solves : int
        Linear solves.
    """

    along: np.ndarray
    about: np.ndarray
    limit_factors: np.ndarray
    limits: np.ndarray
    others: np.ndarray
    other_schemes: np.ndarray
    runs: np.ndarray
    event_factors: np.ndarray
    events: np.ndarray
    ending: str
    motion: np.ndarray | None
    solves: int


@dataclass(frozen=True, slots=True, eq=False)
class Places(Record):
    """What there is along a beam, in the scene's units.

    Attributes
    ----------
    end : float
        The beam's right end.
    point_x : numpy.ndarray
        Places of the points between pieces.
    span : numpy.ndarray of int
        Span of every piece.
    pieces : numpy.ndarray
        Length, EI, GA of every piece, n by 3.
    dead, live : numpy.ndarray
        Load per length at the left and right end of every piece, imposed curvature, force and couple at its right end
        unless a node is there, and by how much the curvature rises along it, n by 6.
    node_points : numpy.ndarray of int
        The points that are nodes.
    kinds : numpy.ndarray of int
        PLAIN, HINGE or RESTRAINED for every node.
    turning : numpy.ndarray
        Stiffness of the rotational restraint of every node, 0 where there is none.
    force, couple : numpy.ndarray
        Dead and live force and couple at every node, nodes by 2.
    support_nodes : numpy.ndarray of int
        Node of every support of the engine.
    levels : numpy.ndarray
        Deflection at which every support of the scene begins to act, moved in full by loads that do so; 0 for axial ones.
    """

    end: float
    point_x: np.ndarray
    span: np.ndarray
    pieces: np.ndarray
    dead: np.ndarray
    live: np.ndarray
    node_points: np.ndarray
    kinds: np.ndarray
    turning: np.ndarray
    force: np.ndarray
    couple: np.ndarray
    support_nodes: np.ndarray
    levels: np.ndarray

    def x_of(self, piece: np.ndarray, distance: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Give the places at distances from the left ends of pieces, numbered from 0, and which of them are right ends."""
        at_end = distance == self.pieces[piece, 0]
        return np.where(at_end, self.point_x[piece + 1], self.point_x[piece] + distance), at_end


def extended(closed: np.ndarray) -> np.ndarray:
    """Copy a scheme, with one entry more."""
    return np.append(closed, 0).astype(np.int32)
