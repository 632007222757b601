"""A train at a position as loads of the beam, and the state there."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ...base.errors import FALLEN, WITHOUT_ANSWER, EngineError, Status
from ...engine.beam import SOLVED, Beam
from ...engine.quantities import FIELDS
from ...engine.trains import NOT_UNIQUE
from ...scene.columns import BY_X, DISTRIBUTED, FORCE
from ..state.motion import cause_of_fall, describe_fall
from ..state.schemes import starting_scheme
from ..state.step import Step
from .traversals import NO_ANSWER

if TYPE_CHECKING:
    from ...engine.runs import Runs
    from ...scene.trains import Course


class Placed:
    """The state at one position of a train.

    Attributes
    ----------
    position : float
        Position of the train.
    acts : numpy.ndarray of bool
        Which axles act.
    beam : Beam
        With the train as loads.
    step : Step
        The state, if it is solved.
    status : int
        SOLVED; else as Status, or NOT_UNIQUE.
    reason : str or None
        Why it is not solved.
    """

    def __init__(self, position: float, acts: np.ndarray, beam: Beam, step: Step):
        self.position, self.acts, self.beam, self.step = position, acts, beam, step
        self.status, self.reason = SOLVED, None
        try:
            solution = self.step.solution
        except EngineError as error:
            if error.status not in WITHOUT_ANSWER:
                raise
            self.status = error.status
            known = error.status == Status.INDETERMINATE
            self.reason = NO_ANSWER[error.status] if known else f"no unique answer: {error}"
            return
        if solution.status in FALLEN:
            self.status = solution.status
            _, self.reason = describe_fall(beam, "", None if solution.slides else solution.motion, cause_of_fall(solution))
        elif solution.indifferent:
            self.status, self.reason = NOT_UNIQUE, NO_ANSWER[NOT_UNIQUE]

    @property
    def at_supports(self) -> np.ndarray:
        """Reaction, deflection, opening, couple (rows) of the supports."""
        return self.step.solution.at_supports

    def values(self, x: np.ndarray, left: np.ndarray) -> np.ndarray:
        """Give all fields at places, each on its side; fields of the engine by places."""
        piece, distance = np.zeros(len(x), dtype=np.int32), np.zeros(len(x))
        for side in (False, True):
            piece[left == side], distance[left == side] = self.beam.find(x[left == side], side)
        found = np.full((len(FIELDS), len(x)), np.nan)
        values = self.step.solution.values(piece, distance)
        found[: len(values)] = values
        return found


class TrainLoads:
    """A beam that a train is put on at any position.

    Parameters
    ----------
    beam : Beam
        The beam.
    rule : {"block", "single"}
        How contact states are found.
    course : Course
        The train.
    near : float
        Distance below which an axle is at the end of the beam.

    Attributes
    ----------
    runs : Runs or None
        The train on its way, once it has gone over the beam.
    """

    def __init__(self, beam: Beam, rule: str, course: Course, near: float):
        self.beam, self.rule, self.course, self.near = beam, rule, course, near
        self.start = starting_scheme(beam)
        self.runs: Runs | None = None

    def acting(self, position: float) -> np.ndarray:
        """Tell which axles act at a position, those at the ends of the beam included."""
        return self.course.acting(position, self.beam.places.end, self.near)

    def loads(self, position: float, acts: np.ndarray) -> list[tuple[int, float, float, float]]:
        """Give the train as loads: kind, place or left end, right end, value."""
        found = self.course.loads(position, self.beam.places.end, self.near, acts)
        return [(DISTRIBUTED if right else FORCE, left, right, value) for left, right, value in found]

    def state(self, position: float, acts: np.ndarray | None = None) -> Placed:
        """Solve at a position.

        Parameters
        ----------
        position : float
            Of the train.
        acts : numpy.ndarray of bool, optional
            Which axles act; default those on the beam.

        Raises
        ------
        EngineError
            Numbers are beyond the range of doubles.
        """
        acts = self.acting(position) if acts is None else acts
        base, loads = self.beam.columns, self.loads(position, acts)
        codes = np.array([(kind, 0, BY_X) for kind, *_ in loads], dtype=np.int32).reshape(-1, 3).T
        numbers = np.array([(left, right, value, value) for _, left, right, value in loads]).reshape(-1, 4).T
        load_codes, load = (
            np.asfortranarray(np.concatenate((own[:, :-1], new, own[:, -1:]), axis=1))
            for own, new in ((base.load_codes, codes), (base.load, numbers))
        )
        beam = Beam(replace(base, load_codes=load_codes, load=load), self.beam.curves)
        self.lead(beam, position)
        return Placed(position, acts, beam, Step(beam, 1.0, self.rule, self.start))

    def lead(self, beam: Beam, position: float) -> None:
        """Let the state of a beam with the train on it be the one to which it comes on its way, where there may be others.

        Parameters
        ----------
        beam : Beam
            New.
        position : float
            Of the train.

        Raises
        ------
        EngineError
            Numbers are beyond the range of doubles.
        """
        if self.runs is not None and self.runs.are_some_of_several:
            beam.begin_on_way(self.runs, position)
