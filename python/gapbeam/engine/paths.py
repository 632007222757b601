"""Paths of the load from event to event, followed by the compiled layer."""

from __future__ import annotations

import numpy as np

from ..base.errors import check_status
from . import calls as _engine
from .arrays import GroundChanges, History, Stretch, extended
from .beam import RULES, Beam
from .states import Solution

AT_LIMIT = {"stop": 0, "jump": 1, "follow": 2}
ENDINGS = ("", "limit", "bifurcation", "mechanism", "ended", "cut off")
"""Ways to go on at a limit and how a path ends, as in gapbeam_history."""
TURNS = 3
"""The event in which the beam turns; all others change the scheme."""
NO_EVENT = -1
"""A change of the scheme that is none: along one straight line, or one smooth law."""


def follow_stretch(beam: Beam, factor: float, closed: np.ndarray, marginal: np.ndarray, most: int) -> Stretch:
    """Follow the load from a factor to 1, from event to event.

    Parameters
    ----------
    beam : Beam
        The beam.
    factor, closed
        As for `Beam.solve`; `closed` is the scheme at the factor.
    marginal : numpy.ndarray of int
        1 for the supports at zero there.
    most : int
        Number of events after which it stops short of 1.

    Returns
    -------
    Stretch
        The events on the way.

    Raises
    ------
    EngineError
        Where no unique solution exists on the way, with the engine's message.
    """
    m = beam.supports
    closed, marginal, at = extended(closed), extended(marginal), np.array(factor)
    count, factors, which, what, motion, solves, nodes, status, message = _engine.gbpath(
        most, beam.handle, beam.links, 1.0, at, closed, marginal
    )
    factor = float(at)
    check_status(status, message, f"at load factor {factor:.15g}: ")
    events = factors[:count], which[:count] - 1, what[:count]
    return Stretch(status, factor, closed[:m], marginal[:m], *events, motion, solves, nodes)


def follow_history(beam: Beam, factors: np.ndarray, at_limit: str, most: int) -> History:
    """Put on the dead loads and go through load factors in turn, by the path itself.

    Parameters
    ----------
    beam : Beam
        The beam.
    factors : numpy.ndarray
        Load factors.
    at_limit : {"stop", "jump", "follow"}
        What to do where the load cannot go on.
    most : int
        Stretches after which the path is cut off.

    Returns
    -------
    History

    Raises
    ------
    EngineError
        More breakpoints at one factor than can be tried, or numbers out of range.
    """
    sizes, status, message = _engine.gbhist(beam.handle, factors, AT_LIMIT[at_limit], most)
    check_status(status, message)
    count, limits, others, ending, solves = sizes.tolist()
    along, about, closed, breakpoints, where, which, motion, ways, schemes = _engine.gbhget(
        beam.handle, beam.links, beam.supports + 1, count + 1, limits + 1, others + 1
    )
    return History(
        along.T[:count], about.T[:count], closed.T[:count, :-1], np.moveaxis(breakpoints, 2, 0)[:count, :, :-1], where[:limits],
        which.T[:limits], ways.T[:others], schemes.T[:others, :-1], ENDINGS[ending], motion if motion.any() else None, solves,
    )  # fmt: skip


def follow_ground(beam: Beam, rule: str, closed: np.ndarray) -> GroundChanges:
    """Follow the load of a beam on the ground from factor 0 to 1.

    Parameters
    ----------
    beam : Beam
        The beam.
    rule : {"block", "single"}
        How schemes of the supports are found.
    closed : numpy.ndarray of int
        Where every search starts.

    Returns
    -------
    GroundChanges

    Raises
    ------
    EngineError
        A state that cannot be settled, or numbers out of range.
    """
    sizes, ends, motion, status, message = _engine.gbgpth(beam.handle, beam.links, RULES[rule], extended(closed))
    check_status(status, message)
    events, segments, solves, at_limit, slides = sizes.tolist()
    at, which, begins, schemes = _engine.gbgpte(beam.handle, beam.supports + 1, events + 1, segments + 1)
    at, which = at[:, :events], which[:, :events]
    return GroundChanges(
        at[0], at[1], which[0] - 1, which[1] - 1, which[2], which[3], begins[:segments], schemes.T[:segments, :-1],
        float(ends[0]), float(ends[1]), bool(at_limit), status, motion, bool(slides), solves,
    )  # fmt: skip


def energy_between(one: Solution, other: Solution) -> float:
    """Energy that is set free on the way from one state of a path to another, along which all but smooth laws is linear.

    Parameters
    ----------
    one, other : Solution
        The states, with the same loads.

    Returns
    -------
    float
        Force times length.
    """
    beam = one.state.beam
    states = (part for solution in (one, other) for part in (solution.state.handle, solution.state.fields))
    return float(_engine.gbwork(beam.handle, beam.pieces, *states))
