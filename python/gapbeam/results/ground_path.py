"""The load path of a beam on the ground: every change of zones of contact and of supports at its load factor.

Between two changes the ends of the zones move smoothly with the load, and no formula gives the factor of the next change. So
states are solved on a grid of factors, and where what acts differs between two neighbours, the change between them is found by
bisection, down to neighbouring doubles. Changes that undo each other between two places of the grid are not seen.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from time import perf_counter
from typing import TYPE_CHECKING

import numpy as np

from ..base.errors import EngineError, Status
from ..engine.arrays import Solution
from ..engine.beam import NO_EQUILIBRIUM, Beam
from .branches import Limit
from .ground import Zone, find_zones
from .motion import describe_motion
from .path import Segment
from .step import Step

if TYPE_CHECKING:
    from .result import Result

GRID = 64
"""Parts into which the way of the load is cut before changes are looked for."""
NEAR = 2.0**-44
"""Distance of load factors at which it is enough to know that states between them cannot be settled."""
BEGIN = 2.0**-40
"""What acts here acts from the beginning: at factor 0 a beam without dead load lies on the ground without any force."""


@dataclass(frozen=True, slots=True)
class GroundEvent:
    """A change of what holds the beam.

    Attributes
    ----------
    factor : float
        The load factor at which it happens.
    support : int or None
        Number of the support in the scene, where it is one that changes.
    foundation : int or None
        Number of the foundation in the scene, where it is a zone of contact that changes.
    x : float
        Its place.
    event : str
        Of a support ``opens`` or ``closes``; of a zone ``zone appears``, ``zone vanishes``, ``zones merge``, ``zone splits``,
        ``end reaches`` and ``end leaves`` (an end of the foundation or of the beam).
    branch : int
        Of a foundation with a law the first of its branches that make up the zone; 1 is the zone of contact.
    """

    factor: float
    support: int | None
    foundation: int | None
    x: float
    event: str
    branch: int = 1


class GroundPath:
    """What acts along the load.

    Attributes
    ----------
    events : list of GroundEvent
        Every change above load factor 0.
    segments : list of Segment
        From 0 to 1, or to the factor above which there is no equilibrium; between events.
    solves : int
        Linear solves.
    nodes : int
        Always 0.
    seconds : float
        Time of these.
    limits : list of Limit
        The load factor that ground which yields can carry at most, if the path ends there.
    beyond : float
        A load factor above the last segment at which there is no equilibrium for sure.
    end : Solution or None
        The state without equilibrium above the last segment.
    """

    nodes = 0

    def __init__(self, beam: Beam, rule: str, closed: np.ndarray):
        begin = perf_counter()
        self._beam, self._rule, self._start = beam, rule, closed
        self.solves = 0
        self.events: list[GroundEvent] = []
        self.end: Solution | None = None
        self.limits: list[Limit] = []
        self._yields = _yields(beam)
        self._trouble: EngineError | None = None
        self.beyond = 1.0
        changes = self._follow()
        self._schemes = [acting.closed for _, acting in changes]
        factors = [0.0, *(factor for factor, _ in changes[1:])]
        self.segments = [
            Segment(start, stop, k)
            for k, (start, stop) in enumerate(zip(factors, [*factors[1:], self._last], strict=True))
            if changes
        ]
        if self._yields and 0.0 < self._last < 1.0:
            self.limits.append(Limit(self._last, "mechanism", 0, (), None, None, True))
        self.seconds = perf_counter() - begin

    def closed(self, segment: Segment) -> np.ndarray:
        """Give the scheme of the supports on a segment, as `Path.closed`."""
        return self._schemes[segment.changes]

    def find(self, factor: float) -> Segment | None:
        """Find the segment that a load factor belongs to, as `Path.find`."""
        there = [segment for segment in self.segments if segment.start <= factor <= segment.stop]
        return there[-1] if there else None

    def step(self, segment: Segment, factor: float) -> Step:
        """Give the state at a load factor on a segment, as `Path.step`."""
        return Step(self._beam, factor, self._rule, self.closed(segment))

    def at(self, factor: float) -> np.ndarray:
        """Give the scheme of the supports at a load factor, as `Path.at`."""
        return self.closed([segment for segment in self.segments if segment.start <= max(factor, 0.0)][-1])

    def _follow(self) -> list[tuple[float, _Acting]]:
        """Find what acts from which factor on, and name what changes."""
        begin = self._solve(BEGIN)
        if begin is None:
            if self._trouble is not None:
                raise self._trouble
            self._last = 0.0
            return []
        found, now, at = [(0.0, begin)], begin, BEGIN
        for factor in (k / GRID for k in range(1, GRID + 1)):
            while (then := self._solve(factor)) is None or not then.like(now):
                below, before, above, after = self._bisect(at, now, factor, then)
                if after is None:
                    self._last = below
                    self.beyond = self._prove_end(below)
                    return found
                self.events += self._compare(above, before, after)
                found.append((above, after))
                now, at = after, above
            at = factor
        self._last = 1.0
        return found

    def _prove_end(self, last: float) -> float:
        """Find a factor just above the last one at which there is no equilibrium for sure."""
        if self._trouble is None:
            return last
        for power in range(-50, -9, 4):
            self.end = None
            factor = last * (1.0 + 2.0**power)
            self._solve(factor)
            if self.end is not None:
                return factor
        raise self._trouble

    def _bisect(
        self, low: float, now: _Acting, high: float, then: _Acting | None
    ) -> tuple[float, _Acting, float, _Acting | None]:
        """Find the first change between two factors: neighbouring factors around it, and what acts at these."""
        while True:
            middle = low + (high - low) / 2
            # Where states cannot be settled, what is beyond must be proved anyway (_prove_end)
            near = self._trouble is not None and then is None and high - low <= NEAR * high
            if middle <= low or middle >= high or near:
                return low, now, high, then
            between = self._solve(middle)
            if between is not None and between.like(now):
                low, now = middle, between
            else:
                high, then = middle, between

    def _solve(self, factor: float) -> _Acting | None:
        """Find what acts at a factor; None without equilibrium."""
        try:
            solution = self._beam.solve(factor, self._rule, self._start)
        except EngineError as error:
            # Just below the last load factor next to nothing holds the beam; _prove_end sees to it that it is the last
            if error.status in (Status.NOT_CONVERGED, Status.NOT_FINITE):
                self._trouble = error
                return None
            raise
        self.solves += solution.solves
        if solution.status == NO_EQUILIBRIUM:
            self.end, self._trouble = solution, None
            return None
        return _Acting(solution.closed, find_zones(self._beam, solution.ground))

    def _compare(self, factor: float, before: _Acting, after: _Acting) -> Iterator[GroundEvent]:
        """Name what changes."""
        beam = self._beam
        changed = np.flatnonzero(before.closed != after.closed)
        places = beam.node_x[beam.places.support_nodes]
        for k in changed.tolist():
            name = "closes" if after.closed[k] else "opens"
            yield GroundEvent(factor, int(beam.numbers[k]), None, float(places[k]), name)
        for key in sorted(before.zones.keys() | after.zones.keys()):
            foundation, _, branch = key
            for x, name in _compare_zones(before.zones.get(key, []), after.zones.get(key, [])):
                yield GroundEvent(factor, None, foundation, x, name, branch)


def _yields(beam: Beam) -> bool:
    """Whether some ground carries no more than so much."""
    points, force = beam.columns.ground_law_foundations[:-1], beam.columns.ground_law[1, :-1]
    return bool(np.any((np.diff(points) == 0) & (np.diff(force) == 0.0)))


class _Acting:
    """What holds the beam: supports, and the zones of every foundation."""

    def __init__(self, closed: np.ndarray, zones: dict[tuple[int, int, int], list[Zone]]):
        self.closed, self.zones = closed, zones

    def like(self, other: _Acting) -> bool:
        """Whether the same supports act, and as many zones with ends of the same kind."""
        if not np.array_equal(self.closed, other.closed) or self.zones.keys() != other.zones.keys():
            return False
        return all(
            [(zone.at_left, zone.at_right) for zone in zones] == [(zone.at_left, zone.at_right) for zone in other.zones[key]]
            for key, zones in self.zones.items()
        )


def _compare_zones(before: list[Zone], after: list[Zone]) -> Iterator[tuple[float, str]]:
    """Tell how the zones of one layer become others: where, and what."""
    for zone in after:
        met = [other for other in before if other.meets(zone)]
        if not met:
            yield zone.middle, "zone appears"
        for left, right in pairwise(met):
            yield (left.to + right.from_) / 2, "zones merge"
    for zone in before:
        met = [other for other in after if other.meets(zone)]
        if not met:
            yield zone.middle, "zone vanishes"
        for left, right in pairwise(met):
            yield (left.to + right.from_) / 2, "zone splits"
        if len(met) == 1 and sum(other.meets(met[0]) for other in before) == 1:
            for at, reaches, place in (
                (zone.at_left, met[0].at_left, met[0].from_ if met[0].at_left else zone.from_),
                (zone.at_right, met[0].at_right, met[0].to if met[0].at_right else zone.to),
            ):
                if at != reaches:
                    yield place, "end reaches" if reaches else "end leaves"


def follow_on_ground(result: Result, rule: str, closed: np.ndarray) -> GroundPath | None:
    """Follow the load of a beam on the ground from factor 0 to 1.

    Parameters
    ----------
    result : Result
        Receives the reason where the beam cannot stand.
    rule : {"block", "single"}
        How schemes of the supports are found.
    closed : numpy.ndarray of int
        Where their search starts.

    Returns
    -------
    GroundPath or None
        From 0 to 1, or to the factor above which there is no equilibrium; None if there is none from the beginning.
    """
    path = GroundPath(result.beam, rule, closed)
    if path.limits:
        result.status = "limit-load"
        last, beyond = path.limits[0].factor, path.beyond
        where = f"between the load factors {last:.12g} and {beyond:.12g}" if beyond > last else f"beyond load factor {last:.12g}"
        result.reason = f"limit load: nothing more resists the load {where}"
        if path.end is not None:
            result.motion = list(zip(result.beam.node_x.tolist(), path.end.motion.tolist(), strict=True))
            result.reason += f"; {describe_motion(result.beam, path.end.motion)}"
        return path
    if path.end is not None and (not path.segments or path.segments[-1].stop < 1.0):
        where = f"above load factor {path.segments[-1].stop:.16g}" if path.segments else "at load factor 0"
        result.refuse(where, None if path.end.slides else path.end.motion)
    return path if path.segments else None
