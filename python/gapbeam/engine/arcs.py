"""Pieces of paths on smooth laws, as the compiled layer follows them along the line between two states."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from ..base.errors import EngineError, check_status
from . import calls as _engine
from .arrays import extended
from .beam import Beam

BEFORE, BEYOND = -1, 1
"""Sides of a place along an arc."""


class LostError(Exception):
    """The path on the smooth laws is not where the polylines have it."""


class Point(NamedTuple):
    """Deflections at the smooth laws, and the load factor."""

    deflection: np.ndarray
    factor: float


class Test(NamedTuple):
    """A function of the place along an arc: its code, as in gapbeam_arc_roots, and what it is about."""

    __test__ = False  # not one of pytest

    kind: int
    number: int = 0
    about: tuple[float, float, float] = (0.0, 0.0, 0.0)


RATE = Test(2)
"""How fast the load factor changes."""


def beyond_factor(factor: float) -> Test:
    """Give the load factor less a given one.

    Parameters
    ----------
    factor : float
        The load factor.

    Returns
    -------
    Test
    """
    return Test(1, 0, (factor, 0.0, 0.0))


def of_eigenvalue(number: int) -> Test:
    """Give an eigenvalue.

    Parameters
    ----------
    number : int
        Which one, in ascending order from 0.

    Returns
    -------
    Test
    """
    return Test(3, number + 1)


def of_breakpoint(support: int, level: float, force: float, by_force: bool) -> Test:
    """Give how far a support is from an end of its piece, as a share of the largest deflection or reaction.

    Parameters
    ----------
    support : int
        Number of the support, or breakpoint, in the engine.
    level, force : float
        Deflection and force at the end, in the engine's units.
    by_force : bool
        Whether the force tells how far it is, as on a vertical piece.

    Returns
    -------
    Test
    """
    return Test(4, support + 1, (level, force, float(by_force)))


class ArcState(NamedTuple):
    """A state on the smooth laws.

    Attributes
    ----------
    arc : Arc
        The arc.
    at : float
        Place along it.
    point : numpy.ndarray
        Deflections at the smooth laws, and the load factor.
    rate : numpy.ndarray
        Their derivatives along the arc.
    slope : numpy.ndarray
        Slopes of the laws.
    breakpoints : numpy.ndarray
        As `Beam.breakpoints`, with springs through the points of the laws instead of these.
    """

    arc: Arc
    at: float
    point: np.ndarray
    rate: np.ndarray
    slope: np.ndarray
    breakpoints: np.ndarray

    @property
    def deflection(self) -> np.ndarray:
        """Deflections at the smooth laws."""
        return self.point[:-1]

    @property
    def factor(self) -> float:
        """The load factor."""
        return float(self.point[-1])

    @property
    def beam(self) -> Beam:
        """The beam with springs instead of the smooth laws."""
        return self.arc.beam.with_breakpoints(self.breakpoints)


class Branch(NamedTuple):
    """What comes after a bifurcation.

    Attributes
    ----------
    points : numpy.ndarray
        Deflections at the laws and load factor (columns), from the bifurcation on; that alone where no way on is stable.
    arrives : bool
        Whether it ends at the load factor wanted; else the load cannot grow beyond its end.
    lost : bool
        Whether a stable way goes on, but not to be followed: another support passes an end of its piece, for instance.
    """

    points: np.ndarray
    arrives: bool
    lost: bool


class Arc:
    """The path on the smooth laws along the line between two states; places are 0 and 1 at these.

    Parameters
    ----------
    beam : Beam
        With smooth laws.
    closed : numpy.ndarray of int
        The scheme.
    start, stop : Point
        The states, near the path or on it.
    turn : Point, optional
        Where between them the load turns round. Places along the arc are told by the deflections alone then, in a way in which
        both parts of it go on.

    Attributes
    ----------
    beam : Beam
        As above.

    Raises
    ------
    LostError
        They are one and the same, or the beam cannot be solved there.
    """

    def __init__(self, beam: Beam, closed: np.ndarray, start: Point, stop: Point, turn: Point | None = None):
        self.beam, self._made_of = beam, (beam, closed, start, stop, turn)
        ends = np.array([[*start.deflection, start.factor], [*stop.deflection, stop.factor]])
        between = np.zeros(len(ends[0])) if turn is None else np.array([*turn.deflection, turn.factor])
        laws = np.column_stack((beam.breakpoints, np.zeros(4)))
        (self._handle,) = _checked(
            _engine.gbamak(beam.handle, beam.links, extended(closed), laws, ends.T, between, turn is not None)
        )

    def __reduce__(self) -> tuple:
        """Pickle by what it is made of."""
        return type(self), self._made_of

    def at(self, place: float) -> ArcState:
        """Find a state.

        Parameters
        ----------
        place : float
            Where.

        Returns
        -------
        ArcState

        Raises
        ------
        LostError
            There is none near.
        """
        beam = self.beam
        point, rate, slope, laws = self._call(_engine.gbaget, beam.supports + 1, len(beam.curves), place)
        return ArcState(self, place, point, rate, slope, laws[:, :-1])

    def root(self, test: Test, low: float = -np.inf, high: float = np.inf, first: float = 0.0) -> ArcState:
        """Find where a function is zero, near the two states.

        Parameters
        ----------
        test : Test
            The function.
        low, high : float
            Places beyond which not to look.
        first : float
            Place at which to begin.

        Returns
        -------
        ArcState

        Raises
        ------
        LostError
            Nowhere.
        """
        places, _ = self._call(_engine.gbaroo, *test, (low, high, first), 0)
        return self.at(float(places[0]))

    def roots(self, test: Test) -> list[ArcState]:
        """Find all places between the two states where a function is zero.

        Parameters
        ----------
        test : Test
            The function.

        Returns
        -------
        list of ArcState

        Raises
        ------
        LostError
            The path is not there all along.
        """
        places, count = self._call(_engine.gbaroo, *test, (0.0, 1.0, 0.0), 1)
        return [self.at(place) for place in places[:count].tolist()]

    def value(self, test: Test, place: float) -> float:
        """Give the value of a function.

        Parameters
        ----------
        test : Test
            The function.
        place : float
            Where.

        Returns
        -------
        float

        Raises
        ------
        LostError
            There is no state near.
        """
        return float(self._call(_engine.gbalok, *test, place, 0, 0)[0])

    def rate_beside(self, place: float, way: int) -> float:
        """Tell how fast the load factor changes on one side of a place, where the law of a support may begin or end.

        Parameters
        ----------
        place : float
            Where.
        way : {BEFORE, BEYOND}
            On which side.

        Returns
        -------
        float

        Raises
        ------
        LostError
            There is no state near.
        """
        return float(self._call(_engine.gbalok, *RATE, place, way, 0)[0])

    def wrongness(self, place: float) -> float:
        """Tell how far a support is beyond the piece on which it is taken to be.

        Parameters
        ----------
        place : float
            Where.

        Returns
        -------
        float
            Share of the largest reaction or deflection.

        Raises
        ------
        LostError
            There is no state near, or it cannot be checked.
        """
        return float(self._call(_engine.gbalok, *RATE, place, 0, 1)[0])

    def eigenvalues(self, slope: np.ndarray) -> np.ndarray:
        """Give numbers of the signs of the eigenvalues of the tangent stiffness, in ascending order, one a law.

        Parameters
        ----------
        slope : numpy.ndarray
            Slopes of the laws in a state.

        Returns
        -------
        numpy.ndarray
            1 + F (slope - spring), made symmetric.

        Raises
        ------
        LostError
            The other supports soften too.
        """
        return self._call(_engine.gbaeig, slope)[0]

    def branch(self, origin: np.ndarray, way: int, goal: float) -> Branch:
        """Follow a stable way on from a bifurcation until the load cannot grow any more.

        Parameters
        ----------
        origin : numpy.ndarray
            The bifurcation: deflections at the laws and load factor.
        way : int
            1 or -1: where the load goes.
        goal : float
            Load factor at which to end.

        Returns
        -------
        Branch

        Raises
        ------
        LostError
            Whether a stable way goes on cannot be told.
        """
        points, count, arrives, lost = self._call(_engine.gbabra, origin, way, goal)
        return Branch(points.T[:count].copy(), bool(arrives), bool(lost))

    def at_factor(self, points: np.ndarray, origin: np.ndarray, factor: float) -> np.ndarray:
        """Find the point of a branch at a load factor.

        Parameters
        ----------
        points : numpy.ndarray
            As `Branch.points`, along which the factor rises or falls.
        origin : numpy.ndarray
            The bifurcation.
        factor : float
            Between those of the first and the last one.

        Returns
        -------
        numpy.ndarray

        Raises
        ------
        LostError
            There is none.
        """
        return self._call(_engine.gbafac, origin, points.T, factor)[0]

    def _call(self, routine: Callable, *about: Any) -> tuple:
        return _checked(routine(self.beam.handle, self.beam.links, self._handle, *about))


def _checked(found: tuple) -> tuple:
    """What a routine has found, without its status."""
    *found, status, message = found
    try:
        check_status(status, message)
    except EngineError:
        raise LostError from None
    return tuple(found)
