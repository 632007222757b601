"""The path of a beam whose supports soften, break, or keep a set: through limit points, to load factors in turn."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from time import perf_counter
from typing import TYPE_CHECKING

import numpy as np

from ..base.errors import EngineError, Status
from ..base.records import Pickled, read_only
from ..engine.arrays import History
from ..engine.beam import ENDINGS, GIVEN, Beam
from .kinks import piece_of, what_happens
from .path import Event, Segment
from .step import Step

if TYPE_CHECKING:
    from .result import Result

MOST_STRETCHES = 20_000
"""Stretches after which a path is cut off; without a history there are finitely many."""
STATES = {"limit": "a limit of the load", "bifurcation": "a bifurcation", "mechanism": "a mechanism"}


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
        The next stable state on the path at the same load factor; dynamics may lead elsewhere.
    """

    factor: float
    kind: str
    leg: int
    causes: tuple[tuple[int, str], ...]
    landing: Step | None


@dataclass(frozen=True, slots=True)
class BranchSegment(Segment):
    """A stretch of the path on which all supports stay on their piece.

    Attributes
    ----------
    number : int
        Its number in the history of the engine.
    leg : int
        Which factor of the history is gone to, from 0.
    path : float
        Load factors passed up to its end, falling ones included.
    stable : bool
        Whether the beam would stay there under this load.
    index : int
        In how many independent ways it gives way by itself.
    ways : int
        Ways on there were at its beginning.
    """

    number: int
    leg: int
    path: float
    stable: bool
    index: int
    ways: int


class BranchPath(Pickled):
    """The path, as `gapbeam.results.path.Path` is for other beams.

    Attributes
    ----------
    events : list of Event
        What happens to the supports, in the order of the path.
    segments : list of BranchSegment
        The stretches of the path that count; what is passed in a jump does not.
    limits : list of Limit
        Where the load could not go on.
    ending : str
        How the path ended: empty at the last factor, ``ended``, ``mechanism``, or ``cut off``.
    motion : numpy.ndarray or None
        Displacements of the nodes in the mechanism in which it ended.
    solves, nodes : int
        Linear solves of the whole beam, all in quadruple precision; 0.
    seconds : float
        Time of these.
    """

    def __init__(self, beam: Beam, factors: np.ndarray, history: History, seconds: float):
        self._beam = beam
        self._history = history
        self._ways = np.sign(np.diff(factors, prepend=0.0)).tolist()
        self.ending = history.ending
        self.motion = history.motion
        self.solves, self.nodes, self.seconds = history.solves, 0, seconds
        self.segments = self._segments()
        self.events = self._events()

    def _segments(self) -> list[BranchSegment]:
        found: list[BranchSegment] = []
        path = 0.0
        for k, ((start, stop), (leg, direction, index, ways, skipped)) in enumerate(
            zip(self._history.along.tolist(), self._history.about.tolist(), strict=True)
        ):
            if skipped or leg == 0 or direction == 0:
                continue
            path += abs(stop - start)
            stable = index == 0 and direction == self._ways[leg - 1]
            found.append(BranchSegment(start, stop, 0, k, leg - 1, path, stable, index, ways))
        return found

    def _events(self) -> list[Event]:
        beam, h = self._beam, self._history
        x = beam.node_x[beam.places.support_nodes]
        places = dict(zip(beam.numbers.tolist(), x.tolist(), strict=True))
        found: list[Event] = []
        before = None
        passed: list[tuple[int, str]] = []
        for k, (leg, direction, *_, skipped) in enumerate(h.about.tolist()):
            if skipped:
                # What is passed in a jump happens where it begins
                passed += self._changes(k - 1, k)
                before = k
                continue
            factor = float(h.along[k, 0])
            if direction == 0 and k + 1 < len(h.about):
                held = np.flatnonzero(h.closed[k + 1] > h.closed[k])
                if leg > 0 and len(held):
                    number = int(beam.numbers[held[0]])
                    found.append(Event(factor, number, places[number], "turns"))
            if before is not None and leg > 0:
                changes, passed = [*passed, *self._changes(before, k)], []
                at_start = factor == 0.0 and self._leg_begins(k) and leg == 1
                found += [Event(factor, i, places[i], what) for i, what in changes if not at_start]
            before = k
        if passed and self._history.limits.size:
            # The path ends at a limit: what happens there is all that happens
            limit = self.limits[-1]
            found += [Event(limit.factor, i, places[i], what) for i, what in limit.causes]
        return found

    def _leg_begins(self, k: int) -> bool:
        return k == 0 or self._history.about[k, 0] != self._history.about[k - 1, 0]

    def _changes(self, before: int, after: int) -> list[tuple[int, str]]:
        """Supports to which something happens between two stretches."""
        beam, h = self._beam, self._history
        found = {}
        for j in np.flatnonzero(h.closed[before] != h.closed[after]).tolist():
            i = int(beam.numbers[j])
            if i in beam.laws:
                old, new = (piece_of(beam, i, h.closed[k], h.kinks[k]) for k in (before, after))
                found[i] = what_happens(old, new)
            else:
                found[i] = "closes" if h.closed[after, j] else "opens"
        return sorted((i, what) for i, what in found.items() if what)

    @cached_property
    def limits(self) -> list[Limit]:
        """Where the load could not go on."""
        found = []
        for factor, (kind, leg, before, landing) in zip(
            self._history.limit_factors.tolist(), self._history.limits.tolist(), strict=True
        ):
            causes = self._changes(before - 1, before) if 0 < before < len(self._history.about) else []
            step = self._step(landing - 1, factor) if landing else None
            found.append(Limit(factor, ENDINGS[kind], leg - 1, tuple(causes), step))
        return found

    def closed(self, segment: BranchSegment) -> np.ndarray:
        """Give the scheme of a segment.

        Parameters
        ----------
        segment : BranchSegment
            One of the segments.

        Returns
        -------
        numpy.ndarray of int
        """
        return self._history.closed[segment.number].astype(np.int32)

    def beam(self, segment: BranchSegment) -> Beam:
        """Give the beam with the laws of its supports as they are on a segment.

        Parameters
        ----------
        segment : BranchSegment
            One of the segments.

        Returns
        -------
        Beam
        """
        return self._beam_at(segment.number)

    def ends(self, segment: BranchSegment) -> tuple[Step, Step]:
        """Give the states at both ends of a segment.

        Parameters
        ----------
        segment : BranchSegment
            One of the segments.

        Returns
        -------
        (Step, Step)
            The second one need not be at the greater load factor.
        """
        return self._step(segment.number, segment.start), self._step(segment.number, segment.stop)

    def jumps_to(self, segment: BranchSegment) -> bool:
        """Whether a segment begins where a jump has landed.

        Parameters
        ----------
        segment : BranchSegment
            One of the segments.

        Returns
        -------
        bool
        """
        return segment.number > 0 and bool(self._history.about[segment.number - 1, -1])

    def _beam_at(self, k: int) -> Beam:
        kinks = self._history.kinks[k]
        return self._beam if np.array_equal(kinks, self._beam.kinks) else self._beam.with_kinks(kinks)

    def _step(self, k: int, factor: float) -> Step:
        return Step(self._beam_at(k), factor, GIVEN, read_only(self._history.closed[k].astype(np.int32)))

    def find(self, factor: float) -> BranchSegment | None:
        """Find the segment that a load factor belongs to.

        Parameters
        ----------
        factor : float
            Load factor.

        Returns
        -------
        BranchSegment or None
            The last one with it, a stable one if there is any; None if the path does not pass it.
        """
        there = [s for s in self.segments if min(s.start, s.stop) <= factor <= max(s.start, s.stop)]
        return max(there, key=lambda s: (s.stable, s.number), default=None)


def follow_branches(result: Result) -> BranchPath:
    """Follow the load of a scene through its factors in turn.

    Parameters
    ----------
    result : Result
        Receives the status, and the reason where the load cannot go on.

    Returns
    -------
    BranchPath
    """
    begin = perf_counter()
    analysis = result.scene.analysis
    factors = np.asarray(analysis.history, dtype=float)
    history = result.beam.follow_history(factors, analysis.at_limit, MOST_STRETCHES)
    path = BranchPath(result.beam, factors, history, perf_counter() - begin)
    if path.ending == "cut off":
        raise EngineError(
            f"the path has more than {MOST_STRETCHES:,} stretches: shorten the history, or follow it in parts", Status.NOT_CONVERGED
        )
    if path.ending:
        result.refuse_limit(path)
    return path
