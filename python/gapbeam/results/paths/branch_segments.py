"""Segments of a path through limit points, and ways on from there that were not taken."""

from __future__ import annotations

from dataclasses import dataclass

from .path import Segment


@dataclass(frozen=True, slots=True)
class OtherWay:
    """A way on from a tie that was not taken.

    Attributes
    ----------
    direction : str
        ``rising``, ``falling`` or ``turning``: what the load does along it.
    index : int
        In how many independent ways the beam gives way by itself there.
    changes : tuple of (int, str)
        Supports, and what happens to them.
    """

    direction: str
    index: int
    changes: tuple[tuple[int, str], ...]


@dataclass(frozen=True, slots=True)
class BranchSegment(Segment):
    """A stretch of the path on which all supports stay on their piece; of a smooth law there is one only.

    Attributes
    ----------
    first, number : int
        Its first and last number in the history of the engine.
    leg : int
        Which factor of the history is gone to, from 0.
    path : float
        Load factors passed up to its end, falling ones included.
    stable : bool
        Whether the beam would stay there under this load.
    index : int
        In how many independent ways it gives way by itself.
    others : tuple of OtherWay
        Ways on there were at its beginning beside it.
    exact : bool
        Whether its end is on the smooth laws; False where it is known on their polylines only.
    """

    first: int
    number: int
    leg: int
    path: float
    stable: bool
    index: int
    others: tuple[OtherWay, ...]
    exact: bool
