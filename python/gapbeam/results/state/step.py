"""The state at one load factor.

Signs: deflections positive downward, reactions upward, couples clockwise; at axial supports both to the right.
"""

from __future__ import annotations

import warnings
from collections import namedtuple
from collections.abc import Iterator
from functools import cached_property, partial
from time import perf_counter
from typing import NamedTuple

import numpy as np

from ...base.records import Pickled, read_only
from ...engine.beam import BY_TANGENTS, ON_LINES, ON_POLYLINES, SOLVED, WITH_LINES, Beam
from ...engine.case_certificates import BOUNDED
from ...engine.states import Along, Solution
from ...engine.units import bound_in_scene, scaled
from ...scene.places import nearest
from ...scene.wording import number
from ..views.extreme import Extremes, Source
from .breakpoints import piece_of
from .ground import Contact, FreeSpan, Run, SlipZone, find_contact, find_free_spans, find_runs, slip_zones
from .modes import StepModes
from .state_extremes import extremes_of_state

SLIDING = {0: "sticks", 1: "right", -1: "left"}
CONDITIONS = {0: "open", 1: "closed", 2: "bilateral"}
BRANCH = 10
"""States of supports, as gapbeam_pieces numbers them; of a law BRANCH plus the number of the piece."""
PLASTIC = 1
"""Unloading, as in gapbeam_scene."""


class Known(NamedTuple):
    """What is kept of a state that was solved: its scheme, and what it took to find it."""

    closed: np.ndarray
    solves: int
    seconds: float


class HingeState(NamedTuple):
    """A hinge with a stiffness in one state.

    Attributes
    ----------
    x : float
        Its place.
    moment : float
        Moment there, sagging.
    rotation : float
        Rotation left of it less that right of it: moment over stiffness.
    """

    x: float
    moment: float
    rotation: float


class Step(Pickled, StepModes):
    """The state at one load factor; arrays have one entry per support, in the order of the scene, and are read-only.

    It is solved when something is first asked for. Two steps are equal if the beam, the load factor and all values are.

    Attributes
    ----------
    factor : float
        Load factor of the live loads.
    exact : bool
        Whether it is on the smooth laws themselves; False where only the state on their polylines is known.
    """

    __hash__ = None

    def __init__(
        self, beam: Beam, factor: float, rule: str, start: np.ndarray, known: Known | None = None,
        settled: bool = False, exact: bool = True, solution: Solution | None = None, along: Along | None = None,
    ):  # fmt: skip
        self.factor = factor
        self.exact = exact
        # Whether the beam has lines or polylines instead of smooth laws that are right for this state
        self._settled = settled
        self._beam = beam
        self._rule = rule
        self._start = start
        self._known = known
        self._along = along
        if solution is not None:
            self._solved = solution, 0.0

    def __repr__(self) -> str:
        """Show the load factor; what there is more is solved for when it is asked for."""
        return f"Step(factor={number(self.factor)})"

    def __eq__(self, other: object) -> bool:
        """Whether beam, load factor and all values are equal."""
        if not isinstance(other, Step):
            return NotImplemented
        return self is other or (
            self.factor == other.factor and self._beam == other._beam and self.solution == other.solution
        )

    @cached_property
    def _solved(self) -> tuple[Solution, float]:
        begin = perf_counter()
        how = ON_LINES
        if self._beam.curves:
            how = (WITH_LINES if self.exact else ON_POLYLINES) if self._settled else BY_TANGENTS
        return self._beam.solve(self.factor, self._rule, self._start, how, self._along), perf_counter() - begin

    @property
    def solution(self) -> Solution:
        """What the engine found."""
        return self._solved[0]

    @property
    def closed(self) -> np.ndarray:
        """The contact state: 1 where a support across the beam acts, 0 where it is open."""
        return self.solution.closed if self._known is None else self._known.closed

    @property
    def seconds(self) -> float:
        """Time it took to find the contact state."""
        return self._solved[1] if self._known is None else self._known.seconds

    @property
    def solves(self) -> int:
        """Linear solves it took to find the contact state."""
        return self.solution.solves if self._known is None else self._known.solves

    @property
    def came_back(self) -> bool:
        """Whether the paper's rule (``single``) came back to a scheme that it had seen, so that ``block`` went on."""
        return self.solution.came_back

    @property
    def indifferent(self) -> bool:
        """Whether the beam can move freely without work of the loads: its forces are unique, its position is not."""
        return self.solution.indifferent

    @property
    def unique(self) -> bool:
        """Whether it is known to be the only state; under compression other stable ones may not be excluded."""
        return self.solution.unique

    @property
    def reaction(self) -> np.ndarray:
        """Reactions, positive upward; of an axial support positive to the right."""
        return self.solution.at_supports[0]

    @property
    def deflection(self) -> np.ndarray:
        """Deflection of the beam at each support, positive downward; at an axial one to the right."""
        return self.solution.at_supports[1]

    @property
    def opening(self) -> np.ndarray:
        """Distance still to go until a support acts; negative where the beam has gone past one without stiffness."""
        return self.solution.at_supports[2]

    @property
    def couple(self) -> np.ndarray:
        """Couple of each support on the beam, positive clockwise; a rotational restraint acts at open supports too."""
        return self.solution.at_supports[3]

    @property
    def breakpoints(self) -> np.ndarray:
        """The laws of the supports as they are in this state, as `Beam.breakpoints`."""
        return self._beam.breakpoints

    @property
    def kinks(self) -> np.ndarray:
        """Give the same as `breakpoints`, by the name that it had."""
        warnings.warn("kinks of laws are called breakpoints", DeprecationWarning, stacklevel=2)
        return self.breakpoints

    @cached_property
    def set(self) -> np.ndarray:
        """Permanent set of each support with plastic unloading (length, angle), 0 of others: its displacement without force.

        Of one side positive in the direction in which it gives way, else as deflections are: what is left if it is unloaded
        parallel to its first segment.
        """
        beam = self._beam
        if not (beam.columns.support_codes[3, :-1] == PLASTIC).any():
            return read_only(np.zeros(beam.scene_supports))
        return read_only(self.solution.yielded()[1])

    @cached_property
    def state(self) -> tuple[str, ...]:
        """``closed``, ``open`` or ``bilateral``; of a law ``open`` or ``branch 1``, ``branch 2`` and so on."""
        names, chain = name_states(self._beam, self.closed), self.solution.chain if self._beam.has_links_along else None
        if chain is None:
            return names
        # Of links along the beam the engine tells
        told = [name if across else CONDITIONS.get(code, f"branch {code - BRANCH}") for name, across, code in zip(
            names, self._beam.across.tolist(), chain.conditions.tolist(), strict=True)]  # fmt: skip
        return tuple(told)

    @cached_property
    def hinges(self) -> tuple[HingeState, ...]:
        """What the hinges with a stiffness do, from left to right."""
        x, stiffness = self._beam.columns.hinge[:, :-1]
        which = np.flatnonzero(stiffness > 0.0)
        which = which[np.argsort(x[which])]
        nodes = nearest(x[which], self._beam.node_x)
        # Between the couples on its two sides, if there are any
        moment = scaled(self.solution.moment_left[nodes], self._beam.units.field[2])
        turned = moment / stiffness[which]
        return tuple(map(HingeState._make, zip(x[which].tolist(), moment.tolist(), turned.tolist(), strict=True)))

    @cached_property
    def slip_zones(self) -> tuple[SlipZone, ...]:
        """Where the beam slides over ground along its axis, or has slid last, from left to right."""
        return slip_zones(self)

    @property
    def friction(self) -> np.ndarray:
        """Force of friction of each support on the beam, positive to the right; 0 where there is none."""
        chain = self.solution.chain
        return read_only(np.zeros(self._beam.scene_supports)) if chain is None else chain.friction

    @property
    def slip(self) -> np.ndarray:
        """How far the beam has gone over each support that has friction, positive to the right; else 0."""
        chain = self.solution.chain
        return read_only(np.zeros(self._beam.scene_supports)) if chain is None else chain.slip

    @property
    def sliding(self) -> tuple[str, ...]:
        """Which way the beam slides over each support that has friction: ``left``, ``right`` or ``sticks``; else empty."""
        chain, has = self.solution.chain, self._beam.columns.support[-1, :-1] > 0.0
        slides = np.zeros(len(has), dtype=int) if chain is None else chain.slides
        return tuple(SLIDING[way] if there else "" for there, way in zip(has.tolist(), slides.tolist(), strict=True))

    @cached_property
    def _certified(self) -> tuple[np.ndarray, np.ndarray, bool]:
        return self.solution.certify()

    @property
    def error_bounds(self) -> dict[str, float | None]:
        """Largest errors of deflections, rotations, moments and shears anywhere along the beam, and of the reactions.

        Deflections and rotations have none (None) where the beam is free to move, or where quadruple precision does not
        confirm the contact state; the others are infinite then.
        """
        units = self._beam.units
        powers = dict(zip(BOUNDED, [*units.field, units.force], strict=True))
        return {
            kind: None if bound is None else bound_in_scene(bound, powers[kind]) for kind, bound in self._inner_bounds.items()
        }

    @property
    def _inner_bounds(self) -> dict[str, float | None]:
        """The same in the engine's units."""
        _, (_, reaction, *fields), known = self._certified
        named = dict(zip(BOUNDED, map(float, (*fields, reaction)), strict=True))
        return named if known else {**named, "deflection": None, "rotation": None}

    @property
    def bounds(self) -> tuple[float | None, float]:
        """Largest errors of the deflections of the nodes (None where the beam is free to move) and of the reactions."""
        (_, (deflection, reaction, *_), known), units = self._certified, self._beam.units
        return bound_in_scene(deflection, units.deflection) if known else None, bound_in_scene(reaction, units.force)

    @property
    def residuals(self) -> dict[str, float]:
        """Relative residuals of equilibrium, compatibility and complementarity; infinite where bounds are."""
        compatibility, equilibrium, complementarity = self._certified[0].tolist()
        return {"equilibrium": equilibrium, "compatibility": compatibility, "complementarity": complementarity + 0.0}

    @property
    def certificate(self) -> dict[str, float | None]:
        """The residuals, and bounds of the errors relative to the largest value of each kind; computed when first asked for.

        None for what there is not.
        """
        fields = self.solution.largest_fields().tolist()
        across = self._beam.across[self._beam.numbers]
        largest = dict(zip(BOUNDED, [*fields, float(np.abs(self.solution.reaction[across]).max(initial=0.0))], strict=True))
        relative = {kind: _relative(bound, largest[kind]) for kind, bound in self._inner_bounds.items()}
        return {
            **{name: residual if np.isfinite(residual) else None for name, residual in self.residuals.items()},
            "error_bound": None if None in relative.values() else max(relative.values()),
            **{f"error_bound_{kind}": bound for kind, bound in relative.items()},
        }

    @cached_property
    def undecided(self) -> tuple[int, ...]:
        """Supports whose reaction or opening is zero, even in quadruple precision: they may be closed or open."""
        return tuple(dict.fromkeys(self._beam.numbers[self.solution.undecided == 1].tolist()))

    @cached_property
    def runs(self) -> tuple[Run, ...]:
        """What every layer of ground does along the beam."""
        return find_runs(self._beam, self.solution.ground)

    @cached_property
    def contact(self) -> tuple[Contact, ...]:
        """The zones in which the ground acts, foundation by foundation from left to right."""
        return find_contact(self.runs)

    @cached_property
    def free_spans(self) -> tuple[FreeSpan, ...]:
        """The stretches in which the beam has no contact with ground that is there."""
        return find_free_spans(self.runs)

    @property
    def extremes(self) -> Extremes:
        """Exact largest and smallest values of every field, by field, then by ``max`` and ``min``."""
        find = partial(extremes_of_state, self, self._beam, Source(factor=self.factor))
        return Extremes(find, self.solution.extremes, 'step.extremes["moment"]["max"].value')

    def __iter__(self) -> Iterator[tuple]:
        """Go through the supports: named tuples of their values, of which pandas makes a table."""
        columns = {name: getattr(self, name) for name in ("state", "reaction", "deflection", "opening", "couple")}
        return map(namedtuple("Support", columns)._make, zip(*columns.values(), strict=True))

    def values(self, piece: np.ndarray, distance: np.ndarray) -> np.ndarray:
        """Fields at given distances from the left ends of pieces, as `Solution.values`: with the loads that act in this state."""
        return self.solution.values(piece, distance)

    def forgotten(self) -> Step:
        """The same step that has not been solved yet: of many steps only what is looked at should be in memory.

        Returns
        -------
        Step
        """
        return Step(
            self._beam, self.factor, self._rule, self._start, self._known, self._settled, self.exact, along=self._along
        )


def name_states(beam: Beam, closed: np.ndarray) -> tuple[str, ...]:
    """Name the state of every support of the scene in a contact state.

    Parameters
    ----------
    beam : Beam
    closed : numpy.ndarray of int
        1 where a support that can carry acts.

    Returns
    -------
    tuple of str
        ``closed``, ``open`` or ``bilateral``; of a law ``open`` or ``branch 1``, ``branch 2`` and so on.
    """
    acting = np.zeros(beam.scene_supports, dtype=np.int64)
    np.add.at(acting, beam.numbers, closed)
    names = np.array(["open", "closed", "bilateral"], dtype=object)  # so that all supports share three words
    states = names[np.where(beam.sides == 0, 2, acting > 0)].tolist()
    for k in beam.laws if beam.has_laws else ():
        piece = piece_of(beam, k, closed, beam.breakpoints).number
        states[k] = f"branch {piece}" if piece else "open"
    return tuple(states)


def _relative(bound: float | None, size: float) -> float | None:
    """Bound as a share of the largest value; None where there is none, or none that is a number."""
    if bound is None or not np.isfinite(bound):
        return None
    with np.errstate(over="ignore"):
        share = float(np.divide(bound, size)) if size > 0.0 else 0.0
    return share if np.isfinite(share) else None


def solve_step(beam: Beam, factor: float, rule: str, closed: np.ndarray) -> Step | Solution:
    """Solve one state.

    Parameters
    ----------
    beam : Beam
    factor, rule, closed
        As for `Beam.solve`.

    Returns
    -------
    Step or Solution
        The step; the solution with its motion where there is no equilibrium.
    """
    step = Step(beam, factor, rule, closed)
    return step if step.solution.status == SOLVED else step.solution
