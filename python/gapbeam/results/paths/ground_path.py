"""The load path of a beam on the ground: every change of zones of contact and of supports at its load factor."""

from __future__ import annotations

from dataclasses import dataclass
from time import perf_counter
from typing import TYPE_CHECKING

import numpy as np

from ...base.errors import Status
from ...engine.beam import GIVEN, SOLVED, Beam
from ...engine.paths import follow_ground
from ...scene.ground_laws import any_falls
from ..state.breakpoints import EVENTS
from ..state.motion import FallingGround, cause_of_fall, describe_motion
from ..state.step import Step
from .path import Limit, Path, Segment

if TYPE_CHECKING:
    from ..result import Result

SAME_FACTOR = 1e-12
"""Load factors as near to each other as this share of themselves are one."""


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
        Of a support ``opens`` or ``closes``, with a law also ``yields``, ``hardens``, ``unloads``; of a zone
        ``zone appears``, ``zone vanishes``, ``zones merge``, ``zone splits``,
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


class GroundPath(Path):
    """What acts along the load on the ground; its attributes are those of `Path`, and these.

    Attributes
    ----------
    events : list of GroundEvent
        Every change above load factor 0.
    limits : list of Limit
        The load factor that ground which yields can carry at most, if the path ends there.
    beyond : float
        A load factor above the last segment at which there is no equilibrium for sure.
    motion : numpy.ndarray or None
        How the beam moves there; None if it stands to the end, or slides along its axis.
    stands : bool
        Whether it stands to the end.
    buckles : bool
        Whether it does not bear its axial forces above the last segment.
    """

    nodes = 0

    def __init__(self, beam: Beam, rule: str, closed: np.ndarray):
        begin = perf_counter()
        self._beam, self._rule = beam, rule
        found = follow_ground(beam, rule, closed)
        self._schemes = found.closed
        self.solves = found.solves
        self.beyond = found.beyond
        self.stands = found.status == SOLVED
        self.buckles = found.status == Status.BUCKLES
        self.motion = None if self.stands or found.slides else found.motion
        columns = (found.factor, found.support, found.foundation, found.x, found.event, found.branch)
        self.events = [
            GroundEvent(factor, k if k >= 0 else None, f if f >= 0 else None, x, EVENTS[event], branch)
            for factor, k, f, x, event, branch in zip(*(column.tolist() for column in columns), strict=True)
        ]
        starts = found.begins.tolist()
        ends = [*starts[1:], found.last][: len(starts)]
        self.segments = [Segment(start, stop, k) for k, (start, stop) in enumerate(zip(starts, ends, strict=True))]
        self.limits = [Limit(found.last, "mechanism", 0, (), None, None, True)] if found.at_limit else []
        self.seconds = perf_counter() - begin

    def closed(self, segment: Segment) -> np.ndarray:
        """Give the scheme of the supports on a segment, as `Path.closed`."""
        return self._schemes[segment.changes]

    def step(self, segment: Segment, factor: float) -> Step:
        """Give the state at a load factor on a segment, as `Path.step`."""
        # On curves the search finds the tangents anew
        return Step(self._beam, factor, self._rule if self._beam.curves else GIVEN, self.closed(segment))


def follow_on_ground(result: Result, rule: str, closed: np.ndarray) -> GroundPath | None:
    """Follow the load of a beam on the ground from factor 0 to 1.

    Parameters
    ----------
    result : Result
        Receives the reason where the beam is unstable.
    rule : {"block", "single"}
        How schemes of the supports are found.
    closed : numpy.ndarray of int
        Where their search starts.

    Returns
    -------
    GroundPath or None
        From 0 to 1, or to the factor above which there is no equilibrium; None if there is none from the beginning.
    """
    path = GroundPath(result._beam, rule, closed)
    asks = path.buckles or (not path.stands and any_falls(result.scene.foundation))
    cause = cause_of_fall(result._beam.solve(path.beyond, rule, closed)) if asks else None
    if path.limits:
        result.status = "limit-load"
        where = f"beyond {_last_factor(path.limits[0].factor, path.beyond, digits=12)}"
        result.reason = f"limit load: nothing more resists the load {where}"
        if isinstance(cause, FallingGround):
            result.reason = f"limit load: the force of the ground falls, and the load cannot grow {where}"
        if path.motion is not None:
            result.motion = list(zip(result._beam.node_x.tolist(), path.motion.tolist(), strict=True))
            if not isinstance(cause, FallingGround):
                result.reason += f"; {describe_motion(result._beam, path.motion)}"
        return path
    if not path.stands:
        where = f"above {_last_factor(path.segments[-1].stop, path.beyond)}" if path.segments else "at load factor 0"
        result._refuse(where, path.motion, cause)
    return path if path.segments else None


def _last_factor(last: float, beyond: float, digits: int = 16) -> str:
    """Word the load factor above which there is no equilibrium; next to it states may be settled no more."""
    if beyond - last <= SAME_FACTOR * last:
        return f"load factor {last:.{digits}g}"
    return f"a load factor between {last:.12g} and {beyond:.12g}"
