"""What happens to a support at a kink of its law, in words."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..engine.beam import Beam


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


def pieces(beam: Beam, closed: np.ndarray, kinks: np.ndarray) -> dict[int, Piece]:
    """Give the acting pieces of all laws.

    Parameters
    ----------
    beam : Beam
        The beam.
    closed : numpy.ndarray of int
        Its scheme.
    kinks : numpy.ndarray
        As `Beam.kinks`, the laws as they have become.

    Returns
    -------
    dict
        By number of the support in the scene.
    """
    found = {}
    first = np.searchsorted(beam.numbers, np.arange(beam.scene_supports + 1))
    for k, middle, at_middle in beam.laws:
        begin, end = int(first[k]), int(first[k + 1])
        count = int(closed[begin:end].sum())
        slope = kinks[2, begin + count - 1] if count else kinks[3, begin]
        number = abs(count - middle) + at_middle
        found[k] = Piece(number, float(slope) if number else 0.0, 1 if count >= middle else -1)
    return found


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
    if after.slope < 0.0:
        return "breaks" if np.isinf(after.slope) else "softens"
    return "hardens" if after.slope > before.slope else "yields"
