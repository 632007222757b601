"""A train at a position as loads of the beam, and the state there: for foundations and smooth laws."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ...base.errors import WITHOUT_ANSWER, EngineError, Status
from ...engine.beam import NO_EQUILIBRIUM, SOLVED, Beam
from ...engine.ground import zone_changes
from ...engine.quantities import FIELDS
from ...engine.trains import NOT_UNIQUE
from ...scene.columns import BY_X, DISTRIBUTED, FORCE
from ..state.breakpoints import Piece, piece_of
from ..state.ground import FreeSpan, size_of
from ..state.motion import SLIDES, describe_motion
from ..state.schemes import starting_scheme
from ..state.smooth import SmoothLaws
from ..state.step import Step
from .tangents import NearTangents
from .traversals import NO_ANSWER

if TYPE_CHECKING:
    from ...scene.trains import Course

SHEAR = FIELDS.index("shear")
"""Row of the shear among the fields."""


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
    past : numpy.ndarray
        How far supports with smooth laws are past their gaps.
    status : int
        SOLVED; else as Status, or NOT_UNIQUE.
    reason : str or None
        Why it is not solved.
    pieces : list of (Piece or None)
        What every support does; None where that is not decided.
    solves : int
        Linear solves.
    """

    def __init__(self, position: float, acts: np.ndarray, beam: Beam, step: Step):
        self.position, self.acts, self.beam, self.step = position, acts, beam, step
        self.status, self.reason, self.solves = SOLVED, None, 0
        self.pieces: list[Piece | None] = []
        self.past = np.zeros(0)
        try:
            solution = self.step.solution
        except EngineError as error:
            if error.status not in WITHOUT_ANSWER:
                raise
            self.status = error.status
            known = error.status == Status.INDETERMINATE
            self.reason = NO_ANSWER[error.status] if known else f"no unique answer: {error}"
            return
        self.solves = solution.solves
        if solution.status == NO_EQUILIBRIUM:
            self.status = NO_EQUILIBRIUM
            self.reason = f"no equilibrium: {SLIDES if solution.slides else describe_motion(beam, solution.motion)}"
        elif solution.indifferent:
            self.status, self.reason = NOT_UNIQUE, NO_ANSWER[NOT_UNIQUE]
        else:
            self.pieces = self._find_pieces()

    def _find_pieces(self) -> list[Piece | None]:
        """What every support does."""
        beam, solution = self.beam, self.step.solution
        acting = np.zeros(beam.scene_supports, dtype=int)
        np.add.at(acting, beam.numbers, solution.closed)
        found: list[Piece | None] = [Piece(min(count, 1), 0.0, 1) for count in acting.tolist()]
        for k in beam.laws.keys() - beam.smooth if beam.has_laws else ():
            found[k] = piece_of(beam, k, solution.closed, beam.breakpoints)
        if beam.curves:
            laws = SmoothLaws(beam)
            self.past, ways = laws.past_the_gap(laws.deflections(solution))
            held = (self.past > 0.0) | ((laws.side == 0) & (laws.gap == 0.0))
            acts = held & (laws.reactions(solution) != 0.0)
            ways = np.where(laws.side == 0, np.where(held, ways, 1), 1)
            for (k, _), number, way in zip(beam.curves, acts.tolist(), ways.tolist(), strict=True):
                found[k] = Piece(int(number), float(number), way)
        for k in set(beam.numbers[solution.undecided == 1].tolist()) - beam.smooth:
            found[k] = None
        return found

    def take_undecided(self, before: Placed) -> None:
        """Take what is not decided here to be as it was before."""
        if self.status == before.status == SOLVED:
            self.pieces = [old if new is None else new for old, new in zip(before.pieces, self.pieces, strict=True)]

    def is_like(self, other: Placed) -> bool:
        """Whether the same holds the beam: supports, and as many zones of contact with ends of the same kind."""
        if self.status != other.status or self.status != SOLVED:
            return self.status == other.status
        for one, two in zip(self.pieces, other.pieces, strict=True):
            if one is not None and two is not None and (one.number, one.way) != (two.number, two.way):
                return False
        ground, after = self.step.solution.ground, other.step.solution.ground
        return ground is None or zone_changes(self.beam, ground, other.beam, after)[0]

    @cached_property
    def extremes(self) -> tuple[np.ndarray, np.ndarray]:
        """Largest and smallest fields, and their places, 2 by fields of the engine."""
        return self.step.solution.extremes()

    @property
    def at_supports(self) -> np.ndarray:
        """Reaction, deflection, opening, couple (rows) of the supports."""
        return self.step.solution.at_supports

    @cached_property
    def resultants(self) -> np.ndarray:
        """Force of every foundation on the beam, positive upward."""
        found = np.zeros(len(self.beam.columns.foundation_sides) - 1)
        for zone in self.step.contact:
            found[zone.foundation] += zone.resultant
        return found

    def free_span(self, foundation: int, quantity: str) -> FreeSpan | None:
        """Give the free span of a foundation that is the longest (``length``) or the deepest (``sag``), if there is any."""
        spans = [span for span in self.step.free_spans if span.foundation == foundation]
        return max(spans, key=lambda span: size_of(span, quantity), default=None)

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
    """

    def __init__(self, beam: Beam, rule: str, course: Course, near: float):
        self.beam, self.rule, self.course, self.near = beam, rule, course, near
        self.start = starting_scheme(beam)
        self.solves = 0
        self._lines = NearTangents(beam, rule) if beam.curves else None

    def acting(self, position: float) -> np.ndarray:
        """Tell which axles act at a position, those at the ends of the beam included."""
        x = position + self.course.offset
        return (x >= -self.near) & (x <= self.beam.places.end + self.near)

    def loads(self, position: float, acts: np.ndarray) -> list[tuple[int, float, float, float]]:
        """Give the train as loads: kind, place or left end, right end, value."""
        end, course = self.beam.places.end, self.course
        x = np.clip(position + course.offset[acts], 0.0, end)
        found = [(FORCE, place, 0.0, force) for place, force in zip(x.tolist(), course.force[acts].tolist(), strict=True)]
        for q, low, high in course.uniform.tolist():
            low, high = max(position + low, 0.0), min(position + high, end)
            if q != 0.0 and high - low > self.near:
                found.append((DISTRIBUTED, low, high, q))
        return found

    def state(self, position: float, acts: np.ndarray | None = None, of_grid: bool = False) -> Placed:
        """Solve at a position.

        Parameters
        ----------
        position : float
            Of the train.
        acts : numpy.ndarray of bool, optional
            Which axles act; default those on the beam.
        of_grid : bool
            Whether states on smooth laws are looked for from this one on, if the same axles act.

        Returns
        -------
        Placed

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
        found = None if self._lines is None else self._lines.solve(position, acts, load_codes, load)
        if found is None:
            beam = Beam(replace(base, load_codes=load_codes, load=load), self.beam.curves)
            step = Step(beam, 1.0, self.rule, self.start)
        else:
            beam, solution = found
            step = Step(beam, 1.0, self.rule, self.start, settled=True, solution=solution)
        placed = Placed(position, acts, beam, step)
        if of_grid and self._lines is not None and placed.status == SOLVED:
            self._lines.keep(position, acts, beam, step.solution)
        self.solves += placed.solves
        return placed
