"""Paths of the load from event to event, followed by the compiled layer."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from ..base.errors import check_status
from ..base.records import read_only
from . import calls as _engine
from .arrays import GroundChanges, History, Stretch, extended
from .beam import RULES, Beam

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


class Followed:
    """A path in the compiled layer; pickled by what it is followed from, and followed again when it is looked at after that.

    Parameters
    ----------
    beam : Beam
        The beam.
    factors : numpy.ndarray
        Load factors that it goes to.
    at_limit : {"stop", "jump", "follow"}
        What to do where the load cannot go on.
    most : int
        Stretches after which the path is cut off.
    """

    def __init__(self, beam: Beam, factors: np.ndarray, at_limit: str, most: int):
        self.beam, self.factors, self.at_limit, self.most = beam, factors, at_limit, most

    def __reduce__(self) -> tuple:
        """Pickle by what it is followed from."""
        return type(self), (self.beam, self.factors, self.at_limit, self.most)

    @cached_property
    def _found(self) -> tuple[np.ndarray, _engine.Owned]:
        sizes, handle, status, message = _engine.gbhist(self.beam.handle, self.factors, AT_LIMIT[self.at_limit], self.most)
        check_status(status, message)
        return sizes, handle

    def history(self) -> History:
        """Give what there is along the path.

        Raises
        ------
        EngineError
            More breakpoints at one factor than can be tried, numbers out of range, or what cannot be told on smooth laws.
        """
        beam, (sizes, handle) = self.beam, self._found
        count, limits, others, runs, events, ending, solves = sizes.tolist()
        along, about, where, which, motion, ways, schemes, parts, at, happens = _engine.gbhget(
            handle, beam.links, beam.supports + 1, count + 1, limits + 1, others + 1, runs + 1, events + 1
        )
        return History(
            along.T[:count], about.T[:count],
            where[:limits], which.T[:limits], ways.T[:others], schemes.T[:others, :-1], parts.T[:runs] - 1, at[:events],
            happens.T[:events] - (1, 0), ENDINGS[ending], motion if motion.any() else None, solves,
        )  # fmt: skip

    def pieces(self, stretch: int) -> tuple[np.ndarray, np.ndarray]:
        """Give the pieces of all supports on a stretch.

        Parameters
        ----------
        stretch : int
            From 0.

        Returns
        -------
        closed : numpy.ndarray of int
            The scheme: 1 where a support of the engine acts.
        breakpoints : numpy.ndarray
            The laws as they have become, as `Beam.breakpoints`.
        """
        closed, laws = _engine.gbhsch(self.beam.handle, self._found[1], self.beam.supports + 1, stretch + 1)
        return read_only(closed[:-1]), laws[:, :-1]

    def lines(self, beam: Beam, stretch: int, factor: float) -> tuple[np.ndarray, int, int]:
        """Find lines in place of smooth laws in the state at a load factor.

        Parameters
        ----------
        beam : Beam
            With the loads of the leg: its dead ones as live ones while these are put on.
        stretch : int
            One of its run, from 0.
        factor : float

        Returns
        -------
        breakpoints : numpy.ndarray
            As `Beam.breakpoints`.
        stretch : int
            That with the scheme.
        how : int
            BY_TANGENTS, WITH_LINES or ON_POLYLINES.

        Raises
        ------
        EngineError
            Memory is at an end.
        """
        at = np.array(stretch + 1, dtype=np.int32)
        laws, how, status, message = _engine.gbhlin(beam.handle, beam.links, self._found[1], beam.supports + 1, at, factor)
        check_status(status, message)
        return laws[:, :-1], int(at) - 1, how

    def tensions(self, stretches: int) -> tuple[np.ndarray, np.ndarray]:
        """Give the axial forces at the ends of all stretches, with links along the beam.

        Parameters
        ----------
        stretches : int
            How many there are.

        Returns
        -------
        ends : numpy.ndarray of int
            Row of both ends of every stretch, 2 rows; from 1.
        tensions : numpy.ndarray
            Axial force of every piece, a row an end.
        """
        ends = _engine.gbhend(self._found[1], stretches)
        return ends, _engine.gbhten(self.beam.handle, self._found[1], self.beam.pieces, int(ends.max(initial=0))).T

    def released(self, limit: int) -> float:
        """Tell how much energy is set free from a limit to its landing.

        Parameters
        ----------
        limit : int
            Which one, from 0.

        Returns
        -------
        float
            Force times length.

        Raises
        ------
        EngineError
            A state that does not stand its audit.
        """
        energy, status, message = _engine.gbheng(self.beam.handle, self._found[1], limit + 1)
        check_status(status, message)
        return float(energy)


class OnStretch:
    """What there is along the beam on a stretch of a path.

    Parameters
    ----------
    followed : Followed
        The path.
    stretch : int
        From 0.
    """

    def __init__(self, followed: Followed, stretch: int):
        self.followed, self.stretch = followed, stretch

    def put_into(self, beam: Beam, factor: float, state: _engine.Owned) -> None:
        """Put it into a state of the beam with the loads of the leg."""
        status, message = _engine.gbhaxi(beam.handle, self.followed._found[1], state, self.stretch + 1, factor)
        check_status(status, message)


def follow_ground(beam: Beam, rule: str, closed: np.ndarray) -> GroundChanges:
    """Follow the load of a beam on the ground from factor 0 to 1.

    Parameters
    ----------
    beam : Beam
    rule : {"block", "single"}
        How schemes of the supports are found.
    closed : numpy.ndarray of int
        Where every search starts.

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
        *ends.tolist(), bool(at_limit), status, motion, bool(slides), solves,
    )  # fmt: skip
