"""Traversal of a beam by a train in one direction: its events, and positions that are not solved."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base.errors import Status
from ...engine.influence import LINES
from ...engine.trains import NOT_UNIQUE, Extremes, Traversal
from ...scene.trains import LEFT, Course
from ..state.breakpoints import EVENTS
from ..state.motion import SLIDES, describe_motion
from .members import Neutral, Passing
from .neutral import held_traversal, traversal_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..paths.compression import Compression
    from ..paths.struts import Struts
    from ..result import Result
    from .trains import TrainResult, TrainState

NO_ANSWER = {
    NOT_UNIQUE: "the beam can move freely, without work of the loads: its position is not unique",
    Status.INDETERMINATE: "no unique answer: a rigid stretch rests on more rigid supports than statics can tell apart",
    Status.NOT_CONVERGED: "no unique answer: the contact state could not be settled in the precision at hand",
}
"""Why positions are not solved where the beam does not move along a line."""


@dataclass(frozen=True, slots=True)
class TrainEvent:
    """A change of what holds the beam.

    Attributes
    ----------
    position : float
        Position of the train.
    support : int or None
        Number of the support in the scene, where it is one that changes.
    x : float
        Its place.
    event : str
        ``opens`` or ``closes``; with a law also ``yields``, ``hardens``, ``unloads``; of zones of contact as for `GroundEvent`.
    direction : {"right", "left"}
        Which way the train goes.
    foundation : int or None
        Number of the foundation in the scene, where it is a zone of contact that changes.
    branch : int
        Of a foundation with a law the first of its branches that make up the zone; 1 is the zone of contact.
    """

    position: float
    support: int | None
    x: float
    event: str
    direction: str
    foundation: int | None = None
    branch: int = 1


@dataclass(frozen=True, slots=True)
class UnstablePositions:
    """Positions at which the beam is unstable, is not held in one place, or has no unique answer.

    Attributes
    ----------
    from_, to : float
        First and last position.
    reason : str
        How the beam moves, or why there is no answer.
    direction : {"right", "left"}
        Which way the train goes.
    status : str
        As of a `Result`: ``no-equilibrium``; ``indeterminate`` or ``not-converged`` without a unique answer; ``solved`` where the
        beam can move freely and its forces are unique: these are in the envelope, deflections and rotations are not.
    """

    from_: float
    to: float
    reason: str
    direction: str
    status: str


class ExactTraversal:
    """A train that has gone over the beam in one direction.

    Attributes
    ----------
    course : Course
        What it is.
    engine : Traversal
        As the engine followed it, by polynomials in the position.
    near : float
        Distance below which an axle is at the end of the beam.
    """

    def __init__(self, result: Result, course: Course, near: float, name: str):
        self.course, self.near, self._scene = course, near, result.scene
        self.engine = traversal_of(result._beam, course, course.from_, course.to)
        p, supports = self.engine, self._scene.positions(self._scene.supports)
        self.events = [
            TrainEvent(position, support, float(supports[support]), EVENTS[change], course.direction)
            for position, (support, _, change) in zip(p.positions.tolist(), p.events.tolist(), strict=True)
        ]

    @property
    def solves(self) -> int:
        """Linear solves."""
        return self.engine.solves

    def influence(
        self, state: TrainState, what: str, x: float, chosen: np.ndarray, places: np.ndarray, side: str
    ) -> np.ndarray:
        """Give an influence line in the contact state of a position.

        Parameters
        ----------
        state : TrainState
            That of the position.
        what : {"deflection", "rotation", "moment", "shear", "reaction", "couple"}
            What it is of.
        x : float
            Place on the beam.
        chosen : numpy.ndarray of bool
            The supports whose reactions or couples are meant.
        places : numpy.ndarray
            Where the unit force is.
        side : {"right", "left"}
            Which value is taken where it jumps at x.

        Returns
        -------
        numpy.ndarray
            What the force makes.
        """
        piece, distance = self.engine.beam.find(np.array([x]), side == "left")
        values = self.engine.influence(state.solution.closed, chosen, int(piece[0]), float(distance[0]), places)
        return values[LINES.index(what)]

    def members(self, train: TrainResult, combination: str | None) -> list[Passing]:
        """Give what an envelope is made of.

        Parameters
        ----------
        train : TrainResult
            Whose traversal it is.
        combination : str or None
            Name of the combination.

        Returns
        -------
        list of Passing
            The train at all positions, and where the beam can move freely.
        """
        return [Passing(train, self, combination), *(Neutral(train, self, combination, one) for one in self.neutral.values())]

    @cached_property
    def extremes(self) -> tuple[Extremes, list[Extremes]]:
        """Largest and smallest fields, and the same of every support."""
        return self.engine.extremes()

    def compressions(self, struts: Struts, tension: np.ndarray) -> Iterator[Compression | None]:
        """Go through the largest compressions beside the Euler load, a scheme after the other.

        Parameters
        ----------
        struts : Struts
            Of the beam.
        tension : numpy.ndarray
            Axial force of every piece, which no position changes.
        """
        solved = self.engine.closed[self.engine.status == Status.SOLVED]
        yield from (struts.largest(closed, tension) for closed in np.unique(solved, axis=0))

    @cached_property
    def neutral(self) -> dict[tuple[float, float], Traversal]:
        """Positions at which the beam can move freely, and how the train goes there on a beam that is kept from it."""
        p = self.engine
        found = {}
        for (start, end), status in zip(p.ends.tolist(), p.status.tolist(), strict=True):
            held = held_traversal(self._scene, self.course, self.near, start, end) if status == NOT_UNIQUE else None
            if held is not None:
                found[start, end] = held
        return found

    @cached_property
    def unstable_positions(self) -> list[UnstablePositions]:
        """Positions that are not solved."""
        p, found = self.engine, []
        reasons: list[Any] = []
        for (start, end), status, motion in zip(p.ends.tolist(), p.status.tolist(), p.motion_of.tolist(), strict=True):
            if status == Status.SOLVED:
                continue
            word = "solved" if (start, end) in self.neutral else word_of(status)
            if found and found[-1].to == start and reasons[-1] == (status, motion, word):
                found[-1] = replace(found[-1], to=end)
                continue
            reason = NO_ANSWER.get(status)
            if status == Status.NO_EQUILIBRIUM:
                reason = f"no equilibrium: {describe_motion(p.beam, p.motions[motion - 1]) if motion else SLIDES}"
            elif word == "solved":
                reason += "; the forces are"
            reasons.append((status, motion, word))
            found.append(UnstablePositions(start, end, reason, self.course.direction, word))
        return found[::-1] if self.course.direction == LEFT else found

    def schemes(self, position: float) -> list[tuple[np.ndarray, float]]:
        """Give the schemes that act just before and just after a position at which something changes; none elsewhere.

        Beside each stands a position next to it at which it acts for sure.
        """
        p, found, beside = self.engine, {}, 4 * self.near
        for (start, end), status, closed in zip(p.ends.tolist(), p.status.tolist(), p.closed, strict=True):
            if status == Status.SOLVED and min(abs(position - start), abs(position - end)) <= beside:
                inside = min(max(position, start + beside), max(end - beside, start))
                found.setdefault(closed.tobytes(), (closed, inside))
        return list(found.values())


def word_of(status: int) -> str:
    """Give the word of a status of positions that are not solved.

    Parameters
    ----------
    status : int
        As Status, or NOT_UNIQUE.

    Returns
    -------
    str
        As of a `Result`.
    """
    return Status.INDETERMINATE.word if status == NOT_UNIQUE else Status(status).word
