"""Breakpoints of the laws of supports: what happens there, in words, and how far it is."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...engine.beam import Beam
from ...engine.states import Solution

EVENTS = {
    0: "opens", 1: "closes", 3: "turns", 4: "yields", 5: "hardens", 6: "softens", 7: "breaks", 8: "unloads",
    20: "zone appears", 21: "zone vanishes", 22: "zones merge", 23: "zone splits", 24: "end reaches", 25: "end leaves",
}  # fmt: skip
"""What happens, by the codes of gapbeam_pieces."""


class Piece(NamedTuple):
    """The piece of a law that acts.

    Attributes
    ----------
    number : int
        From 1; 0 where the support is open.
    slope : float
        Force/length, in the engine's units; infinite where it is rigid, minus infinite where it breaks.
    way : int
        Which way it is from the middle of the law: 1 towards what the support resists first, -1 the other way.
    """

    number: int
    slope: float
    way: int


def piece_of(beam: Beam, support: int, closed: np.ndarray, breakpoints: np.ndarray) -> Piece:
    """Give the acting piece of a law.

    Parameters
    ----------
    beam : Beam
        The beam.
    support : int
        Number of the support in the scene, one of `Beam.laws`.
    closed : numpy.ndarray of int
        Scheme of the beam.
    breakpoints : numpy.ndarray
        As `Beam.breakpoints`, the laws as they have become.

    Returns
    -------
    Piece
        A smooth law has one piece only.
    """
    where, middle, at_middle = beam.laws[support]
    count = int(closed[where].sum())
    number = abs(count - middle) + at_middle
    way = 1 if count >= middle else -1
    if support in beam.smooth:
        return Piece(min(number, 1), float(bool(number)), way)
    slope = breakpoints[2, where.start + count - 1] if count else breakpoints[3, where.start]
    return Piece(number, float(slope) if number else 0.0, way)


def what_happens(before: Piece, after: Piece) -> str:
    """Name what happens between two pieces of a law.

    Parameters
    ----------
    before, after : Piece
        The pieces.

    Returns
    -------
    str
        Empty where nothing does.

    Examples
    --------
    >>> elastic, flat, falling = Piece(1, 5.0, 1), Piece(2, 0.0, 1), Piece(3, -1.0, 1)
    >>> what_happens(elastic, flat), what_happens(flat, falling), what_happens(flat, elastic)
    ('yields', 'softens', 'unloads')
    >>> what_happens(Piece(0, 0.0, 1), elastic), what_happens(elastic, Piece(0, 0.0, 1))
    ('closes', 'opens')
    """
    if before == after or (before.slope == after.slope and before.number and after.number):
        return ""
    if not before.number or not after.number:
        return "closes" if after.number else "opens"
    if after.number < before.number:
        return "unloads"
    if before.slope == -np.inf:
        return ""  # the foot of a drop; it has broken at its top
    if after.slope < 0.0:
        return "breaks" if np.isinf(after.slope) else "softens"
    return "hardens" if after.slope > before.slope else "yields"


class Breakpoint(NamedTuple):
    """An end of the piece on which a support is.

    Attributes
    ----------
    node : int
        Its node.
    group : slice
        Its breakpoints in the engine.
    level, force : float
        Deflection and force there, in the engine's units.
    by_force : bool
        Whether the force tells how far it is, as on a vertical piece.
    side : int
        Of the support; 1 where it holds both ways.
    """

    node: int
    group: slice
    level: float
    force: float
    by_force: bool
    side: int

    def margin(self, solution: Solution) -> float:
        """Tell how far a state is from it, as a share of the largest deflection or reaction."""
        if self.by_force:
            values, here = solution.reaction, self.side * solution.reaction[self.group].sum() - self.force
        else:
            values, here = solution.deflection, solution.deflection[self.node] - self.level
        return float(here / (np.abs(values).max() or 1.0))


def passed_breakpoints(beam: Beam, before: np.ndarray, after: np.ndarray, breakpoints: np.ndarray) -> list[Breakpoint]:
    """List what is passed between two schemes; along a smooth law only where it begins.

    Parameters
    ----------
    beam : Beam
        The beam.
    before, after : numpy.ndarray of int
        The schemes.
    breakpoints : numpy.ndarray
        As `Beam.breakpoints`, with the first scheme.
    """
    found = []
    for j in np.flatnonzero(before != after).tolist():
        i, group, by_force = int(beam.numbers[j]), slice(j, j + 1), bool(before[j])
        if i in beam.laws:
            group, piece = beam.laws[i][0], piece_of(beam, i, before, breakpoints)
            if i in beam.smooth and piece.number == piece_of(beam, i, after, breakpoints).number:
                continue
            by_force = bool(np.isinf(piece.slope))
        node, side = int(beam.places.support_nodes[j]), int(beam.sides[i]) or 1
        found.append(Breakpoint(node, group, float(breakpoints[0, j]), float(breakpoints[1, j]), by_force, side))
    return found
