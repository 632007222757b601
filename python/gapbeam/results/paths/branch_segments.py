"""Segments of a path through limit points, its limits, and ways on from there that were not taken."""

from __future__ import annotations

from dataclasses import dataclass

from ..state.step import Step
from .path import Segment


@dataclass(frozen=True, slots=True)
class Limit:
    """Where the load cannot go on.

    Attributes
    ----------
    factor : float
        The load factor.
    kind : str
        ``limit``: the load must fall; ``bifurcation``: several ways go on, none of them stable; ``mechanism``: none does.
    leg : int
        Which factor of the history was gone to, from 0; -1 while the dead loads were put on.
    causes : tuple of (int, str)
        Supports and what happens to them there.
    landing : Step or None
        The next stable state on the path at the same load factor; dynamics may lead elsewhere. None too while settlements or
        preloads (negative gaps) grow with the dead loads.
    released : float or None
        By how much the potential energy is less there (force times length).
    exact : bool
        Whether factor and landing are those of the smooth laws; False where only those of their polylines are known.
    """

    factor: float
    kind: str
    leg: int
    causes: tuple[tuple[int, str], ...]
    landing: Step | None
    released: float | None
    exact: bool


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
