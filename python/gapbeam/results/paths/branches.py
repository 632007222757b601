"""The path of a beam whose supports soften, break, or keep a set: through limit points, to load factors in turn."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import groupby
from time import perf_counter
from typing import TYPE_CHECKING

import numpy as np

from ...base.errors import EngineError, Status
from ...base.records import Pickled
from ...engine.beam import BY_TANGENTS, GIVEN, ON_POLYLINES, Beam
from ...engine.paths import ENDINGS, Followed, OnStretch
from ...engine.tolerances import MOST_PATH_SEGMENTS
from ..state.breakpoints import EVENTS, piece_of, what_happens
from ..state.step import Step
from .path import Event, Limit, Segment

if TYPE_CHECKING:
    from ...scene.structs import Scene
    from ..result import Result

CURVE = 25
"""States of a segment with smooth laws in a picture."""
DIRECTIONS = {1: "rising", -1: "falling", 0: "turning"}


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


class BranchPath(Pickled):
    """The path, as `gapbeam.results.path.Path` is for other beams.

    Attributes
    ----------
    events : list of Event
        What happens to the supports, in the order of the path.
    segments : list of BranchSegment
        The stretches of the path that count; what is passed in a jump does not.
    ending : str
        How the path ended: empty at the last factor, ``ended``, ``mechanism``, or ``cut off``.
    motion : numpy.ndarray or None
        Displacements of the nodes in the mechanism in which it ended.
    solves, nodes, seconds
        As of `Path`; all solves are in quadruple precision.
    """

    def __init__(self, scene: Scene, followed: Followed):
        begin = perf_counter()
        self._followed, self._beam = followed, followed.beam
        self._history = history = followed.history()
        self._dead = self._beam.with_dead_loads_alone() if 0 in history.about[:, 0] else None
        self._support_x = scene.positions(scene.supports).tolist()
        self._ways = np.sign(np.diff(scene.analysis.history, prepend=0.0)).tolist()
        self.ending = history.ending
        self.motion = history.motion
        self.solves, self.nodes = history.solves, 0
        self.segments = self._segments()
        self.events = self._events()
        self.seconds = perf_counter() - begin

    def _segments(self) -> list[BranchSegment]:
        found: list[BranchSegment] = []
        path, h = 0.0, self._history
        about, along, branching = h.about.tolist(), h.along.tolist(), set(h.others[:, 0].tolist())
        for first, last in h.runs.tolist():
            leg, direction, index, _, skipped, exact, _ = about[last]
            if skipped or leg == 0 or direction == 0:
                continue
            start, stop = along[first][0], along[last][1]
            path += abs(stop - start)
            stable = index == 0 and direction == self._ways[leg - 1]
            others = self._others(first) if first + 1 in branching else ()
            found.append(BranchSegment(start, stop, 0, first, last, leg - 1, path, stable, index, others, bool(exact)))
        return found

    def _others(self, k: int) -> tuple[OtherWay, ...]:
        """Ways that were not taken where a stretch begins."""
        h, found = self._history, []
        for j in np.flatnonzero(h.others[:, 0] == k + 1).tolist():
            before, (_, breakpoints) = self._scheme(max(k - 1, 0)), self._followed.pieces(k)
            changes = tuple(self._between(before, h.other_schemes[j], breakpoints))
            found.append(OtherWay(DIRECTIONS[int(h.others[j, 1])], int(h.others[j, 2]), changes))
        return tuple(found)

    def _events(self) -> list[Event]:
        beam, h = self._beam, self._history
        x = beam.node_x[beam.places.support_nodes]
        places = dict(zip(beam.numbers.tolist(), x.tolist(), strict=True))
        if beam.has_links_along:
            places |= dict(enumerate(self._support_x))
        happens = zip(h.event_factors.tolist(), h.events.tolist(), strict=True)
        return [Event(factor, support, places[support], EVENTS[what]) for factor, (support, what) in happens]

    def _changes(self, before: int, after: int) -> list[tuple[int, str]]:
        """Supports to which something happens between two stretches."""
        (one, breakpoints_before), (other, breakpoints) = map(self._followed.pieces, (before, after))
        return self._between(one, other, breakpoints, breakpoints_before)

    def _between(
        self, before: np.ndarray, after: np.ndarray, breakpoints: np.ndarray, breakpoints_before: np.ndarray | None = None
    ) -> list[tuple[int, str]]:
        """Supports to which something happens between two schemes."""
        beam, found = self._beam, {}
        for j in np.flatnonzero(before != after).tolist():
            i = int(beam.numbers[j])
            if i in beam.laws:
                old = piece_of(beam, i, before, breakpoints if breakpoints_before is None else breakpoints_before)
                found[i] = what_happens(old, piece_of(beam, i, after, breakpoints))
            else:
                found[i] = "closes" if after[j] else "opens"
        return sorted((i, what) for i, what in found.items() if what)

    @cached_property
    def limits(self) -> list[Limit]:
        """Where the load could not go on."""
        found, h = [], self._history
        for j, (factor, (kind, leg, before, landing)) in enumerate(zip(h.limit_factors.tolist(), h.limits.tolist(), strict=True)):
            causes = self._changes(before - 1, before) if 0 < before < len(h.about) else []
            step = self._step(landing - 1, factor) if landing and (leg > 0 or self._dead is not None) else None
            released = None if step is None else self._followed.released(j)
            exact = (before == 0 or bool(h.about[before - 1, 5])) and (step is None or step.exact)
            found.append(Limit(factor, ENDINGS[kind], leg - 1, tuple(causes), step, released, exact))
        return found

    def closed(self, segment: BranchSegment) -> np.ndarray:
        """Give the scheme of a segment, as `Path.closed`."""
        return self._scheme(segment.number)

    def pressed(self) -> Iterator[tuple[np.ndarray, np.ndarray | None, list[float], np.ndarray]]:
        """Give what tells whether the beam buckles, with links along the beam: of segments with the same scheme together.

        Yields
        ------
        closed : numpy.ndarray of int
            The scheme.
        breakpoints : numpy.ndarray or None
            The laws of supports as they have become, if there are any.
        factors : list of float
            Load factors at which segments start and stop.
        tensions : numpy.ndarray
            Axial force of every piece there, a row a load factor.
        """
        ends, tensions = self._followed.tensions(len(self._history.about))
        for _, group in groupby(self.segments, lambda segment: self._history.about[segment.number, 6]):
            segments = list(group)
            closed, breakpoints = self._followed.pieces(segments[0].number)
            factors = [factor for segment in segments for factor in (segment.start, segment.stop)]
            # Where one segment stops the next one starts
            rows, first = np.unique(ends[:, [segment.number for segment in segments]].T.ravel() - 1, return_index=True)
            there = slice(rows[0], rows[-1] + 1) if rows[-1] - rows[0] < len(rows) else rows  # a slice is no copy
            yield closed, breakpoints if self._beam.has_laws else None, [factors[k] for k in first.tolist()], tensions[there]

    def beam(self, segment: BranchSegment) -> Beam:
        """Give the beam with the laws of its supports as they are on a segment.

        Parameters
        ----------
        segment : BranchSegment
            One of the segments.
        """
        return self._beam_at(segment.number)

    def along(self, segment: BranchSegment) -> list[Step]:
        """Give the states at both ends of a segment, and with smooth laws some between them.

        Parameters
        ----------
        segment : BranchSegment
            One of the segments.

        Returns
        -------
        list of Step
            In the order of the path; the last one need not be at the greatest load factor.
        """
        # Closer at both ends, where the load may turn round
        share = (1.0 - np.cos(np.linspace(0.0, np.pi, CURVE if self._beam.curves else 2))) / 2
        between = (segment.start + share * (segment.stop - segment.start))[1:-1].tolist()
        factors = [segment.start, *between, segment.stop]
        return [self._step(segment.number if k else segment.first, factor) for k, factor in enumerate(factors)]

    def at_dead_limits(self) -> list[Step]:
        """Give the states on both sides of the jumps while the dead loads are put on; their factor is that of the dead loads.

        Returns
        -------
        list of Step
            None where settlements or preloads grow with them.
        """
        found, h = [], self._history
        for factor, (_, leg, before, landing) in zip(h.limit_factors.tolist(), h.limits.tolist(), strict=True):
            if leg == 0 and self._dead is not None:
                jumps = landing and not (landing == len(h.about) and self.ending)
                found += [self._step(k - 1, factor) for k in (before, landing if jumps else 0) if k]
        return found

    def step(self, segment: BranchSegment, factor: float) -> Step:
        """Give the state on a segment at a load factor, as `Path.step`."""
        return self._step(segment.number, factor)

    def begin(self, segment: BranchSegment) -> Step:
        """Give the state with which a segment begins.

        Parameters
        ----------
        segment : BranchSegment
            One of the segments.
        """
        return self._step(segment.first, segment.start)

    def jumps_to(self, segment: BranchSegment) -> bool:
        """Whether a segment begins where a jump has landed.

        Parameters
        ----------
        segment : BranchSegment
            One of the segments.
        """
        return segment.first > 0 and bool(self._history.about[segment.first - 1, 4])

    def _beam_at(self, k: int) -> Beam:
        return self._loaded(k).with_breakpoints(self._followed.pieces(k)[1])

    def _loaded(self, k: int) -> Beam:
        """The beam with the loads of the leg of a stretch."""
        return self._beam if self._history.about[k, 0] else self._dead

    def _step(self, k: int, factor: float) -> Step:
        if not self._beam.curves:
            along = OnStretch(self._followed, k) if self._beam.has_links_along else None
            return Step(self._beam_at(k), factor, GIVEN, self._scheme(k), along=along)
        breakpoints, k, how = self._followed.lines(self._loaded(k), k, factor)
        beam = self._loaded(k).with_breakpoints(breakpoints)
        return Step(beam, factor, GIVEN, self._scheme(k), settled=how != BY_TANGENTS, exact=how != ON_POLYLINES)

    def _scheme(self, k: int) -> np.ndarray:
        return self._followed.pieces(k)[0]

    def find(self, factor: float) -> BranchSegment | None:
        """Find the segment that a load factor belongs to, as `Path.find`."""
        there = [s for s in self.segments if min(s.start, s.stop) <= factor <= max(s.start, s.stop)]
        return max(there, key=lambda s: (s.stable, s.number), default=None)


def follow_branches(result: Result) -> BranchPath:
    """Follow the load of a scene through its factors in turn.

    Parameters
    ----------
    result : Result
        Receives the status, and the reason where the load cannot go on.
    """
    analysis = result.scene.analysis
    factors = np.asarray(analysis.history, dtype=float)
    followed = Followed(result._beam, factors, analysis.at_limit, MOST_PATH_SEGMENTS)
    path = BranchPath(result.scene, followed)
    if path.ending == "cut off":
        raise EngineError(
            f"the path has more than {len(path._history.about):,} stretches: shorten the history, or follow it in parts",
            Status.NOT_CONVERGED,
        )
    if path.ending:
        result._refuse_limit(path)
    return path
