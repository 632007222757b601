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
from .energy import work_of_live_loads
from .kinks import piece_of, what_happens
from .path import Event, Segment
from .step import Step

if TYPE_CHECKING:
    from ..scene.structs import Scene
    from .result import Result

MOST_STRETCHES = 20_000
"""Stretches after which a path is cut off; without a history there are finitely many."""
DIRECTIONS = {1: "rising", -1: "falling", 0: "turning"}


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
    released : float or None
        By how much the potential energy is less there (force times length).
    """

    factor: float
    kind: str
    leg: int
    causes: tuple[tuple[int, str], ...]
    landing: Step | None
    released: float | None


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
    others : tuple of OtherWay
        Ways on there were at its beginning beside it.
    """

    number: int
    leg: int
    path: float
    stable: bool
    index: int
    others: tuple[OtherWay, ...]


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

    def __init__(self, scene: Scene, beam: Beam, history: History, seconds: float):
        self._scene = scene
        self._beam = beam
        self._history = history
        self._ways = np.sign(np.diff(scene.analysis.history, prepend=0.0)).tolist()
        self.ending = history.ending
        self.motion = history.motion
        self.solves, self.nodes, self.seconds = history.solves, 0, seconds
        self.segments = self._segments()
        self.events = self._events()

    def _segments(self) -> list[BranchSegment]:
        found: list[BranchSegment] = []
        path = 0.0
        for k, ((start, stop), (leg, direction, index, _, skipped)) in enumerate(
            zip(self._history.along.tolist(), self._history.about.tolist(), strict=True)
        ):
            if skipped or leg == 0 or direction == 0:
                continue
            path += abs(stop - start)
            stable = index == 0 and direction == self._ways[leg - 1]
            found.append(BranchSegment(start, stop, 0, k, leg - 1, path, stable, index, self._others(k)))
        return found

    def _others(self, k: int) -> tuple[OtherWay, ...]:
        """Ways that were not taken where a stretch begins."""
        h = self._history
        before = h.closed[k - 1] if k else h.closed[k]
        return tuple(
            OtherWay(DIRECTIONS[direction], index, tuple(self._between(before, h.other_schemes[j], h.kinks[k])))
            for j, (stretch, direction, index) in enumerate(h.others.tolist())
            if stretch == k + 1
        )

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
        h = self._history
        return self._between(h.closed[before], h.closed[after], h.kinks[after], h.kinks[before])

    def _between(
        self, before: np.ndarray, after: np.ndarray, kinks: np.ndarray, kinks_before: np.ndarray | None = None
    ) -> list[tuple[int, str]]:
        """Supports to which something happens between two schemes."""
        beam, found = self._beam, {}
        for j in np.flatnonzero(before != after).tolist():
            i = int(beam.numbers[j])
            if i in beam.laws:
                old = piece_of(beam, i, before, kinks if kinks_before is None else kinks_before)
                found[i] = what_happens(old, piece_of(beam, i, after, kinks))
            else:
                found[i] = "closes" if after[j] else "opens"
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
            released = self._released(before, landing, factor) if landing else None
            found.append(Limit(factor, ENDINGS[kind], leg - 1, tuple(causes), step, released))
        return found

    def _released(self, before: int, landing: int, factor: float) -> float:
        """Energy that is set free from a limit to the landing: along a path it changes by the work of the loads only."""
        found = 0.0
        for k in range(before, landing):
            # In a jump the landing is said to begin at the factor of the limit
            start, stop = (float(v) for v in self._history.along[k])
            if k == landing - 1:
                start, stop = float(self._history.along[k - 1, 1]), factor
            if start != stop:
                ends = [work_of_live_loads(self._scene, self._beam, self._step(k, at)) for at in (start, stop)]
                found += (stop - start) * sum(ends) / 2
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
    path = BranchPath(result.scene, result.beam, history, perf_counter() - begin)
    if path.ending == "cut off":
        raise EngineError(
            f"the path has more than {MOST_STRETCHES:,} stretches: shorten the history, or follow it in parts", Status.NOT_CONVERGED
        )
    if path.ending:
        result.refuse_limit(path)
    return path
