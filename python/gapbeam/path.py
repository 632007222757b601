"""The load path: every change of the working scheme at its exact load factor."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from . import engine
from .errors import EngineError

if TYPE_CHECKING:
    from .lowering import Arrays
    from .results import Result

MOST_EVENTS_PER_SUPPORT = 50
"""A path has finitely many events; more than this many say that rounding decides them."""


@dataclass(frozen=True, slots=True)
class Event:
    """A change of the working scheme.

    Attributes
    ----------
    factor : float
        The load factor at which it happens.
    support : int
        Number of the support in the scene.
    x : float
        Its place.
    event : str
        ``opens`` or ``closes``.
    """

    factor: float
    support: int
    x: float
    event: str


@dataclass(frozen=True, slots=True)
class Segment:
    """A stretch of the path on which one scheme acts and all values are linear in the factor.

    Attributes
    ----------
    start, stop : float
        Load factors.
    closed : numpy.ndarray of int
        1 where a support acts.
    solves : int
        Linear solves it took to find it.
    """

    start: float
    stop: float
    closed: np.ndarray
    solves: int


def follow(result: Result, rule: str, closed: np.ndarray) -> list[Segment]:
    """Follow the load from factor 0 to 1, from event to event.

    Parameters
    ----------
    result : Result
        Receives events, and the reason where the beam cannot stand.
    rule : {"block", "single"}
        How schemes are found.
    closed : numpy.ndarray of int
        Where the search at factor 0 starts.

    Returns
    -------
    list of Segment
        From 0 to 1, or to the factor above which there is no equilibrium.
    """
    arrays, links = result.arrays, result.links
    solution = engine.solve(arrays, links, 0.0, rule, closed)
    if solution.status == engine.NO_EQUILIBRIUM:
        result.refuse("at load factor 0", solution.motion)
        return []
    factor, closed, marginal, solves = 0.0, solution.closed, solution.marginal, solution.solves
    segments: list[Segment] = []
    limit = 10 + MOST_EVENTS_PER_SUPPORT * len(closed)
    while factor < 1.0:
        before = closed
        status, following, closed, marginal, motion, more = engine.next_event(
            arrays, links, factor, rule, closed, marginal
        )
        if status == engine.NO_EQUILIBRIUM:
            result.refuse(f"above load factor {factor:.16g}", motion)
            break
        if factor > 0.0:
            result.events += [_event(arrays, factor, k, closed[k]) for k in np.flatnonzero(closed != before)]
        if following > factor or not segments:
            segments.append(Segment(factor, min(following, 1.0), closed, solves + more))
        if len(segments) > limit:
            raise EngineError(f"more than {limit} events: rounding decides them; follow the load by steps")
        factor, solves = following, 0
    return segments


def _event(arrays: Arrays, factor: float, k: int, now_closed: int) -> Event:
    x = float(arrays.node_x[arrays.support_nodes[k]])
    return Event(factor, int(arrays.supports[k]), x, "closes" if now_closed else "opens")

