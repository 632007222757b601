"""The load path: every change of the contact state at its exact load factor."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass, replace
from time import perf_counter
from typing import TYPE_CHECKING

import numpy as np

from ...base.errors import EngineError
from ...base.records import read_only
from ...engine.arrays import Stretch
from ...engine.beam import GIVEN, NO_EQUILIBRIUM, Beam
from ...engine.paths import NO_EVENT, TURNS, follow_stretch
from ...engine.tolerances import CHANGES_AT_A_TIME, MISSING_OF_LIMIT
from ..state.breakpoints import EVENTS
from ..state.step import Step, solve_step

if TYPE_CHECKING:
    from ..result import Result


@dataclass(frozen=True, slots=True)
class Event:
    """A change of the contact state, or a turn of the beam.

    Attributes
    ----------
    factor : float
        The load factor at which it happens.
    support : int
        Number of the support in the scene.
    x : float
        Its place.
    event : str
        ``opens``, ``closes``, or ``turns``: the beam has lost its hold and turns, at constant load, until this support
        holds it. What opens and closes with that is listed beside it, at the same factor. Of a support with a law also
        ``yields``, ``hardens``, ``softens``, ``breaks`` and ``unloads``.
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
    changes : int
        Events before it.
    """

    start: float
    stop: float
    changes: int


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


class Path:
    """The schemes along the load, kept as the changes from one to the next.

    Attributes
    ----------
    events : list of Event
        Every change above load factor 0, and every turn of the beam.
    segments : list of Segment
        From 0 to 1, or to the factor above which there is no equilibrium; between events.
    solves : int
        Linear solves of the whole beam.
    nodes : int
        Nodes at which the solution was made anew besides.
    seconds : float
        Time of these.
    limits : list of Limit
        The load factor that curves of supports can carry at most, if the path ends there.
    motion : numpy.ndarray or None
        How the beam moves there.
    """

    def __init__(self, beam: Beam, closed: np.ndarray, stretches: list[Stretch], solves: int, seconds: float):
        self._beam = beam
        self._closed = closed
        self._factors = np.concatenate([piece.factors for piece in stretches])
        self._supports = np.concatenate([piece.supports for piece in stretches])
        self._events = np.concatenate([piece.events for piece in stretches])
        self.solves = solves + sum(piece.solves for piece in stretches)
        self.nodes = sum(piece.nodes for piece in stretches)
        self.seconds = seconds
        self.events: list[Event] = []
        counted = self._name_events()
        self.segments = self._between(stretches[-1].factor, counted)
        self.limits: list[Limit] = []
        self.motion: np.ndarray | None = None

    def _between(self, end: float, counted: np.ndarray) -> list[Segment]:
        """Segments between the changes that count; all of them do but those along smooth laws."""
        ends = np.append(np.diff(self._factors) > 0.0, True) if len(self._factors) else np.zeros(0, bool)
        counts = np.flatnonzero(ends) + 1
        if not counted.all():
            first = np.append(0, counts[:-1])
            counts = counts[[counted[a:b].any() for a, b in zip(first, counts, strict=True)]]
        starts = {0.0: 0} | {float(self._factors[count - 1]): int(count) for count in counts}
        stops = [*list(starts)[1:], end]
        return [
            Segment(start, stop, changes)
            for (start, changes), stop in zip(starts.items(), stops, strict=True)
            if start < stop
        ]

    def closed(self, segment: Segment) -> np.ndarray:
        """Give the scheme of a segment.

        Parameters
        ----------
        segment : Segment
            One of the segments.

        Returns
        -------
        numpy.ndarray of int
            1 where a support acts.
        """
        before = slice(segment.changes)
        changed = self._supports[before][self._events[before] != TURNS]
        times = np.bincount(changed, minlength=len(self._closed))
        return self._closed ^ (times & 1).astype(np.int32)

    def at(self, factor: float) -> np.ndarray:
        """Give the scheme at a load factor.

        Parameters
        ----------
        factor : float

        Returns
        -------
        numpy.ndarray of int
            1 where a support acts; at an event after the change.
        """
        return self.closed([segment for segment in self.segments if segment.start <= max(factor, 0.0)][-1])

    def find(self, factor: float) -> Segment | None:
        """Find the segment that a load factor belongs to.

        Parameters
        ----------
        factor : float

        Returns
        -------
        Segment or None
            The one that begins there, where two meet; None if the path does not pass it.
        """
        there = [segment for segment in self.segments if segment.start <= factor <= segment.stop]
        return there[-1] if there else None

    def step(self, segment: Segment, factor: float) -> Step:
        """Give the state on a segment at a load factor.

        Parameters
        ----------
        segment : Segment
            One of the segments.
        factor : float
            One of its load factors.
        """
        return Step(self._beam, factor, GIVEN, read_only(self.closed(segment)))

    def _end_on_curves(self, motion: np.ndarray) -> bool:
        """End a path along polylines where the curves themselves carry the load: there, or next to a limit, which is noted."""
        last = self.segments[-1]
        for share in (0.0, *MISSING_OF_LIMIT.tolist()):
            stop = last.stop * (1.0 - share)
            with suppress(EngineError):
                if stop > last.start and isinstance(solve_step(self._beam, stop, GIVEN, self.closed(last)), Step):
                    if share > 0.0:
                        self.segments[-1], self.motion = replace(last, stop=stop), motion
                        self.limits = [Limit(last.stop, "mechanism", 0, (), None, None, True)]
                    return True
        return False

    def _name_events(self) -> np.ndarray:
        """List the events, and tell which changes are any."""
        beam = self._beam
        counted = self._events != NO_EVENT
        places, numbers = beam.node_x[beam.places.support_nodes].tolist(), beam.numbers.tolist()
        columns = (self._factors.tolist(), self._supports.tolist(), self._events.tolist())
        for factor, k, event in zip(*columns, strict=True):
            # What changes at factor 0 is no event, unless the beam turns there
            if event != NO_EVENT and (factor > 0.0 or event == TURNS):
                self.events.append(Event(factor, numbers[k], places[k], EVENTS[event]))
        # What is between two events along smooth laws happens at no factor of its own
        self._factors = np.maximum.accumulate(np.where(counted, self._factors, 0.0)) if beam.curves else self._factors
        return counted


def follow(result: Result, rule: str, closed: np.ndarray) -> Path | None:
    """Follow the load from factor 0 to 1, from event to event.

    Parameters
    ----------
    result : Result
        Receives the reason where the beam is unstable.
    rule : {"block", "single"}
        How schemes are found.
    closed : numpy.ndarray of int
        Where the search at factor 0 starts.

    Returns
    -------
    Path or None
        From 0 to 1, or to the factor above which there is no equilibrium; None if there is none at 0.
    """
    begin = perf_counter()
    beam = result._beam
    solution = beam.solve(0.0, rule, closed)
    if solution.slides:
        # What nothing holds along its axis moves as soon as it is pushed
        result._refuse("above load factor 0", None)
        return None
    if solution.status == NO_EQUILIBRIUM:
        result._refuse("at load factor 0", solution.motion)
        return None
    factor, scheme, marginal, stretches = 0.0, solution.closed, solution.undecided, []
    while factor < 1.0:
        piece = follow_stretch(beam, factor, scheme, marginal, CHANGES_AT_A_TIME)
        stretches.append(piece)
        factor, scheme, marginal = piece.factor, piece.closed, piece.marginal
        if piece.status == NO_EQUILIBRIUM:
            break
    path = Path(beam, solution.closed, stretches, solution.solves, perf_counter() - begin)
    if piece.status != NO_EQUILIBRIUM:
        return path
    stands = not (beam.curves and path.segments) or path._end_on_curves(piece.motion)
    if path.limits:
        result._refuse_limit(path)
    else:
        result._refuse(f"above load factor {factor:.16g}", piece.motion)
    return path if stands else None
