"""The way of a train over a beam in one direction: its events, and positions that are not solved."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ..base.errors import Status
from ..engine.beam import Beam
from ..engine.trains import NOT_UNIQUE, Extremes, Passage
from ..scene.trains import LEFT, Course
from .kinks import EVENTS
from .motion import SLIDES, describe_motion
from .train_members import Passing

if TYPE_CHECKING:
    from .trains import TrainResult

NO_ANSWER = {
    NOT_UNIQUE: "the beam can move freely, without work of the loads: its position is not unique",
    Status.INDETERMINATE: "no unique answer: a rigid stretch rests on more rigid supports than statics can tell apart",
    Status.NOT_CONVERGED: "no unique answer: the working scheme could not be settled in the precision at hand",
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
class Gap:
    """Positions at which the beam cannot stand, is not held in one place, or has no unique answer.

    Attributes
    ----------
    from_, to : float
        First and last position.
    reason : str
        How the beam moves, or why there is no answer.
    direction : {"right", "left"}
        Which way the train goes.
    """

    from_: float
    to: float
    reason: str
    direction: str


class TrainWay:
    """A train that has gone over the beam in one direction.

    Attributes
    ----------
    course : Course
        What it is.
    passage : Passage
        How it went.
    near : float
        Distance below which an axle is at the end of the beam.
    """

    def __init__(self, beam: Beam, course: Course, near: float, supports: np.ndarray):
        self.course, self.near = course, near
        self.passage = Passage(beam, course.offset, course.force, course.uniform, course.from_, course.to, course.direction == LEFT)
        p = self.passage
        self.events = [
            TrainEvent(position, support, float(supports[support]), EVENTS[change], course.direction)
            for position, (support, _, change) in zip(p.positions.tolist(), p.events.tolist(), strict=True)
        ]

    @property
    def solves(self) -> int:
        """Linear solves."""
        return self.passage.solves

    def member(self, train: TrainResult, combination: str | None) -> Passing:
        """Give what an envelope is made of.

        Parameters
        ----------
        train : TrainResult
            Whose way it is.
        combination : str or None
            Name of the combination.

        Returns
        -------
        Passing
        """
        return Passing(train, self, combination)

    @cached_property
    def extremes(self) -> tuple[Extremes, list[Extremes]]:
        """Largest and smallest fields, and the same of every support."""
        return self.passage.extremes()

    @cached_property
    def gaps(self) -> list[Gap]:
        """Positions that are not solved."""
        p, found = self.passage, []
        reasons: list[Any] = []
        for (start, end), status, motion in zip(p.ends.tolist(), p.status.tolist(), p.motion_of.tolist(), strict=True):
            if status == Status.SOLVED:
                continue
            if found and found[-1].to == start and reasons[-1] == (status, motion):
                found[-1] = Gap(found[-1].from_, end, found[-1].reason, self.course.direction)
                continue
            reason = NO_ANSWER.get(status)
            if status == Status.NO_EQUILIBRIUM:
                reason = f"no equilibrium: {describe_motion(p.beam, p.motions[motion - 1]) if motion else SLIDES}"
            reasons.append((status, motion))
            found.append(Gap(start, end, reason, self.course.direction))
        return found[::-1] if self.course.direction == LEFT else found
