"""Breakpoints of the laws of supports: what happens there, in words, and how far it is."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...engine.beam import Beam

OF_SUPPORTS = {
    0: ("opens", "lifts off"), 1: ("closes", "comes into contact"), 3: ("turns", "stops the beam, which has turned freely"),
    4: ("yields", "yields"), 5: ("hardens", "hardens"), 6: ("softens", "softens"), 7: ("breaks", "breaks"),
    8: ("unloads", "unloads"), 9: ("slips", "begins to slip"), 10: ("sticks", "no longer slips"),
}  # fmt: skip
OF_ZONES = {
    20: ("zone appears", "a contact zone appears"), 21: ("zone vanishes", "a contact zone vanishes"),
    22: ("zones merge", "two contact zones merge"), 23: ("zone splits", "a contact zone splits"),
    24: ("end reaches", "contact reaches the end"), 25: ("end leaves", "contact leaves the end"),
}  # fmt: skip
"""Events of supports and of zones of the ground by the codes of gapbeam_pieces: name in results, and words in reports."""
EVENTS = {code: name for code, (name, _) in (OF_SUPPORTS | OF_ZONES).items()}
"""Their names."""


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
