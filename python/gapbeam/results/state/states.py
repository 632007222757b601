"""The states of a beam under its load: what is known about every load step, as numpy arrays; fields are made when asked for.

Signs: deflections positive downward, reactions upward, moments sagging, V = dM/dx, rotations and couples clockwise,
axial forces in tension, axial displacements to the right.
"""

from __future__ import annotations

from functools import cached_property, partial
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base.errors import EngineError, NoStepError
from ...base.memory import refuse_beyond
from ...base.records import Pickled
from ...engine.beam import Beam
from ...engine.modes import Buckling
from ...engine.states import ALONG_ONLY, Solution
from ...scene.held import hold
from ...scene.movements import moves_with_load
from ...scene.names import label
from ...scene.structs import Scene
from ...scene.wording import shown
from ..views.extreme import Extremes
from .arguments import finite, numbers, whole
from .fields import Fields, find_places
from .ground import with_ends_of_slip, with_ends_of_zones
from .modes import WithModes
from .motion import FallingGround, describe_fall, describe_motion
from .schemes import starting_scheme
from .step import Step, solve_step
from .steps import LoadSteps, MovedSteps, Steps
from .system import System, system_of

if TYPE_CHECKING:
    from ..paths.branches import BranchPath
    from ..paths.compression import Compression
    from ..paths.ground_path import GroundEvent, GroundPath
    from ..paths.path import Event, Limit, Path, Segment

MOVING, SLIDING = "solved, but free to move: its position is not unique", "solved, but free to slide along its axis"
"""Of a beam in neutral equilibrium, across its axis or along it."""
BYTES_PER_PLACE = 120
"""Memory that a row of a table of fields takes while it is made."""


class States(Pickled, WithModes):
    """All load steps of a beam, without what stands on them; its attributes are those of `Result`."""

    __hash__ = None

    def __init__(self, scene: Scene, beam: Beam, rule: str):
        self.scene = hold(scene)
        self.status = "solved"
        self._reason: str | None = None
        self.motion: list[tuple[float, float]] | None = None
        self.steps: Steps = LoadSteps(beam, rule, np.ones(beam.supports, dtype=np.int32), 0)
        self._beam = beam
        self._rule = rule
        self.path: Path | BranchPath | GroundPath | None = None
        self.without_trains: str | None = None
        self.has_answer = True
        self.compression: Compression | None = None
        self.remarks: list[str] = []

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Take the attributes back."""
        super().__setstate__(state)
        hold(self.scene)

    @property
    def reason(self) -> str | None:
        """Why there is no equilibrium or no unique answer, which limit there is, or that the beam is free to move."""
        return self._neutral_words if self._reason is None else self._reason

    @reason.setter
    def reason(self, words: str | None) -> None:
        self._reason = words

    @property
    def _neutral_words(self) -> str | None:
        """What is said where it stands at the end of the load, but can move freely without work of the loads."""
        if self.status != "solved" or not self.steps or not self.steps[-1].indifferent:
            return None
        chain = self.steps[-1].solution.chain
        return SLIDING if chain is not None and chain.loose == ALONG_ONLY else MOVING

    def __eq__(self, other: object) -> bool:
        """Whether scene, outcome, events and all steps are equal."""
        if not isinstance(other, States):
            return NotImplemented
        return self is other or (
            self.scene == other.scene
            and self._beam == other._beam
            and (self.status, self.reason, self.motion) == (other.status, other.reason, other.motion)
            and self.events == other.events
            and len(self.steps) == len(other.steps)
            and all(a == b for a, b in zip(self.steps, other.steps, strict=True))
        )

    @property
    def depends_on_path(self) -> bool:
        """Whether states depend on the loading history: by the laws of supports, or since it goes to several factors in turn."""
        return self._beam.depends_on_path or self.scene.analysis.has_history

    @property
    def is_linear_between_events(self) -> bool:
        """Whether values are linear in the load factor from one event to the next, the same on every way of the load."""
        return self._beam.is_linear_between_events and not self.depends_on_path

    @property
    def events(self) -> list[Event] | list[GroundEvent]:
        """Every change of the contact state and of zones of contact with its load factor, following events."""
        return [] if self.path is None else self.path.events

    @property
    def segments(self) -> list[Segment]:
        """The stretches between the events, following events."""
        return [] if self.path is None else self.path.segments

    @property
    def limits(self) -> list[Limit]:
        """Where the load could not go on, with supports that soften or yield."""
        return getattr(self.path, "limits", [])

    @property
    def solves(self) -> int:
        """Linear solves of the whole beam until all schemes were found."""
        return self.steps.solves if self.path is None else self.path.solves

    @property
    def seconds(self) -> float:
        """Time of these."""
        return self.steps.seconds if self.path is None else self.path.seconds

    def _refuse(self, where: str, motion: np.ndarray | None, cause: Buckling | FallingGround | None = None) -> None:
        """Note that there is no equilibrium, or that the beam buckles.

        Parameters
        ----------
        where : str
            At or above which load factor.
        motion : numpy.ndarray or None
            Displacements of the nodes in the free motion; None where the beam slides along its axis.
        cause : Buckling or FallingGround, optional
            How it buckles, or what falling ground bears.
        """
        self.status, self.reason = self.steps.outcome = describe_fall(self._beam, where, motion, cause)
        if motion is not None:
            x, w = cause[1:] if isinstance(cause, Buckling) else (self._beam.node_x, motion)
            self.motion = list(zip(x.tolist(), w.tolist(), strict=True))

    def _refuse_answer(self, error: EngineError) -> None:
        """Note that there is no unique answer.

        Parameters
        ----------
        error : EngineError
            What stands in its way.
        """
        self.status, self.reason, self.path, self.has_answer = error.status.word, str(error), None, False
        self.steps = LoadSteps(self._beam, self._rule, np.ones(self._beam.supports, dtype=np.int32), 0)
        self.steps.outcome = self.status, self.reason

    def _refuse_limit(self, path: BranchPath | Path) -> None:
        """Note that the load cannot go to its last factor.

        Parameters
        ----------
        path : BranchPath or Path
            As far as it goes.
        """
        self.path = path
        limit = path.limits[0]
        self.status = "limit-load"
        what = {
            "limit": "the load cannot grow beyond load factor",
            "bifurcation": "several ways go on, none of them stable, at load factor",
            "mechanism": "nothing more resists the load beyond load factor",
        }[limit.kind]
        causes = ", ".join(f"support {label(self.scene.supports, k)} {event}" for k, event in limit.causes)
        self.reason = f"limit load: {what} {limit.factor:.12g}" + (f", where {causes}" if causes else "")
        if limit.leg < 0:
            self.reason += ", while the dead loads are put on (they count from 0 to 1)"
        if path.motion is not None:
            self.motion = list(zip(self._beam.node_x.tolist(), path.motion.tolist(), strict=True))
            self.reason += f"; {describe_motion(self._beam, path.motion)}"
        elif limit.kind == "mechanism" and moves_with_load(self.scene):
            self.reason += "; supports that loads move may leave no room between them there"

    def state(self, factor: float, leg: int | None = None) -> Step:
        """Solve the exact state at any load factor.

        Parameters
        ----------
        factor : float
            Load factor; following events, within the path, where the scheme is known beforehand.
        leg : int, optional
            Which factor of the history the load goes to then, from 0; default the last time that it passes `factor`.

        Returns
        -------
        Step
            One linear solve away from what is known.

        Raises
        ------
        ValueError
            Where there is no equilibrium at that factor, or it is no finite number.
        """
        factor = finite("factor", factor)
        if leg is not None and (len(self.scene.analysis.history) > 1 or leg != 0):
            return self._on_leg(factor, whole("leg", leg))
        segment = self.path.find(factor) if self.path is not None else None
        if segment is not None:
            return self.path.step(segment, factor)
        if self._beam.depends_on_path and not isinstance(self.steps, MovedSteps):
            raise ValueError(f"factor: the path of the load does not come to load factor {factor:g}")
        if not self.segments:
            closed = self.steps.nearest(factor)
        else:
            closed = starting_scheme(self._beam) if self.depends_on_path else self.path.at(factor)
        step = solve_step(self.steps.beam_at(factor), factor, self._rule, closed)
        if isinstance(step, Solution):
            raise ValueError(f"factor: there is no equilibrium at load factor {factor:g}")
        return step

    def _on_leg(self, factor: float, leg: int) -> Step:
        there = [one for one in self.segments if getattr(one, "leg", 0) == leg]
        found = [one for one in there if min(one.start, one.stop) <= factor <= max(one.start, one.stop)]
        if not found:
            legs = sorted({getattr(one, "leg", 0) for one in self.segments} - {-1})
            known = f"its legs are {legs[0]} to {legs[-1]}" if legs else "it is not followed through a history"
            raise ValueError(f"leg: the load does not pass load factor {factor:g} on leg {leg}; {known}")
        return self.path.step(max(found, key=lambda one: (one.stable, one.number)), factor)

    @cached_property
    def system(self) -> System:
        """What the system of equations consisted of."""
        return system_of(self)

    def _chosen(self, step: int | None, factor: float | None = None) -> Step:
        """Give a step by its number, or the state at a load factor, whichever the caller asks for."""
        if factor is not None:
            if step is not None:
                raise ValueError(f"step: give a load step or a load factor, not both (got {shown(step)} and {shown(factor)})")
            return self.state(factor)
        number = -1 if step is None else whole("step", step)
        count = len(self.steps)
        if count == 0:
            raise NoStepError(self.status, self.reason)
        if count == 1 and number not in (0, -1):
            raise IndexError(f"step: there is one load step, number 0, got {shown(number)}; for a load factor give factor = ...")
        if not -count <= number < count:
            raise IndexError(f"step: expected a number from 0 to {count - 1}, or from -{count} to -1, got {shown(number)}")
        return self.steps[number]

    def at_state(self, state: Step, x: Any, side: str = "right") -> Fields:
        """Exact values anywhere along the beam in a state of it, for example the landing of a limit.

        Parameters
        ----------
        state : Step
            The state.
        x, side
            As for `Result.at`.

        Returns
        -------
        Fields
            Arrays of the shape of `x`.

        Raises
        ------
        ValueError
            As for `Result.at`.
        """
        x = np.array(numbers("x", x))
        piece, distance = find_places(self._beam, x.ravel(), side)
        return self._fields(x, piece, distance, state)

    def _fields(self, x: np.ndarray, piece: np.ndarray, distance: np.ndarray, state: Step) -> Fields:
        values = state.values(piece, distance)
        return Fields(x, **{name: values[row].reshape(x.shape) for name, row in self._beam.fields.items()})

    def fields(self, step: int | None = None, points: int = 20) -> Fields:
        """Tabulate all fields, for drawing.

        Parameters
        ----------
        step : int, optional
            Number of the load step; default the last.
        points : int
            Equal divisions of every span, beside all places where something changes.

        Returns
        -------
        Fields
            With every place between two pieces twice: the values left of it, then those right of it. On the ground the ends
            of the zones of contact, or of slip, are among them.

        Raises
        ------
        ValueError
            `step` or `points` is no whole number, or `points` is less than 1 or more than memory holds.
        IndexError
            There is no such step.
        """
        state = self._chosen(step)
        piece, distance = self._places_along(points)
        if state.solution.ground is not None:
            piece, distance = with_ends_of_zones(piece, distance, self._beam, state.solution.ground)
        elif self._beam.is_on_axial_ground:
            piece, distance = with_ends_of_slip(piece, distance, state)
        x, _ = self._beam.places.x_of(piece, distance)
        return self._fields(x, piece + np.int32(1), distance, state)

    def _places_along(self, points: int) -> tuple[np.ndarray, np.ndarray]:
        """Choose places for a table of fields.

        Parameters
        ----------
        points : int
            Equal divisions of every span, beside all places where something changes.

        Returns
        -------
        piece : numpy.ndarray of int
            Piece of every place, from 0.
        distance : numpy.ndarray
            Distance from its left end.

        Raises
        ------
        ValueError
            `points` is no whole number, or less than 1 or more than memory holds.
        """
        points = whole("points", points, least=1)
        rows = float(min(points, 2**62)) * len(self.scene.beam.spans)
        refuse_beyond("points", f"fields at {shown(points)} points a span", rows * BYTES_PER_PLACE, "give fewer")
        places, lengths = self._beam.places, self._beam.places.pieces[:, 0]
        spans = np.asarray(self.scene.beam.spans, dtype=float)[places.span]
        parts = np.maximum(np.ceil(points * (lengths / spans)).astype(int), 1)
        piece = np.repeat(np.arange(len(lengths), dtype=np.int32), parts + 1)
        place = np.arange(len(piece)) - np.repeat(np.cumsum(parts + 1) - (parts + 1), parts + 1)
        return piece, lengths[piece] * (place / parts[piece])

    @property
    def extremes(self) -> Extremes:
        """Exact largest and smallest values of every field at the end of the load; those of a step has ``steps[k].extremes``."""
        return Extremes(partial(self._chosen, None), self._pairs_of_extremes, 'result.extremes["moment"]["max"].value')

    def _pairs_of_extremes(self, step: int | None = None) -> dict[str, dict[str, tuple[float, float]]]:
        """Give ``{"moment": {"max": (value, x), ...}, ...}`` in a load step, default the last."""
        values, x = (table.tolist() for table in self._chosen(step).solution.extremes())
        return {
            name: {"max": (values[0][k], x[0][k]), "min": (values[1][k], x[1][k])} for name, k in self._beam.fields.items()
        }

    def history(self) -> list[tuple[float, tuple[str, ...]]]:
        """Follow the contact state over the load.

        Returns
        -------
        list of (float, tuple of str)
            Load factor and the state of every support, one row a load step.
        """
        return list(self.steps.history())
