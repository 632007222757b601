"""The state at one load factor.

Signs: deflections positive downward, reactions upward, couples clockwise; at axial supports both to the right.
"""

from __future__ import annotations

from functools import cached_property
from time import perf_counter
from typing import NamedTuple

import numpy as np

from ..base.records import Pickled, read_only
from ..engine import engine
from ..engine.arrays import LONGER, STRONGER, refuse_farthest, to_scene
from ..engine.axial import solve_axial
from ..engine.engine import Solution
from ..engine.lowering import Arrays
from ..engine.units import bound_in_scene, scaled

BOUNDED = ("deflection", "rotation", "moment", "shear", "reaction")
"""What has error bounds."""


class Known(NamedTuple):
    """What is kept of a state that was solved: its scheme, and what it took to find it."""

    closed: np.ndarray
    solves: int
    seconds: float


class Step(Pickled):
    """The state at one load factor; arrays have one entry per support, in the order of the scene, and are read-only.

    It is solved when something is first asked for. Two steps are equal if the beam, the load factor and all values are.

    Attributes
    ----------
    factor : float
        Load factor of the live loads.
    """

    __hash__ = None

    def __init__(
        self,
        arrays: Arrays,
        links: np.ndarray,
        factor: float,
        rule: str,
        start: np.ndarray,
        known: Known | None = None,
    ):
        self.factor = factor
        self._arrays = arrays
        self._links = links
        self._rule = rule
        self._start = start
        self._known = known

    def __eq__(self, other: object) -> bool:
        """Whether beam, load factor and all values are equal."""
        if not isinstance(other, Step):
            return NotImplemented
        return self is other or (
            self.factor == other.factor and self._arrays == other._arrays and self.solution == other.solution
        )

    @cached_property
    def _solved(self) -> tuple[Solution, tuple[np.ndarray, ...] | None, float]:
        begin = perf_counter()
        axial = solve_axial(self._arrays, self.factor) if self._arrays.axial is not None else None
        solution = engine.solve(self._arrays, self._links, self.factor, self._rule, self._start)
        slides = self._arrays.axial is not None and axial is None
        if solution.status == engine.SOLVED and not slides:
            _check_range(self._arrays, self.factor, solution, axial)
        return solution, axial, perf_counter() - begin

    @property
    def solution(self) -> Solution:
        """What the engine found."""
        return self._solved[0]

    @property
    def closed(self) -> np.ndarray:
        """The working scheme: 1 where a support across the beam acts, 0 where it is open."""
        return self.solution.closed if self._known is None else self._known.closed

    @property
    def axial(self) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
        """Displacements, tensions and reactions of the axial system, if there is one."""
        return self._solved[1]

    @property
    def seconds(self) -> float:
        """Time it took to find the working scheme."""
        return self._solved[2] if self._known is None else self._known.seconds

    @property
    def solves(self) -> int:
        """Linear solves it took to find the working scheme."""
        return self.solution.solves if self._known is None else self._known.solves

    @property
    def came_back(self) -> bool:
        """Whether the paper's rule (``single``) came back to a scheme that it had seen, so that ``block`` went on."""
        return self.solution.came_back

    @property
    def indifferent(self) -> bool:
        """Whether the beam can move freely without work of the loads: its forces are unique, its position is not."""
        return self.solution.indifferent

    def _along_axis(self, result: np.ndarray, values: int, exponent: str) -> np.ndarray:
        """Put in the values of the axial supports: of the axial system's displacements (0) or reactions (2)."""
        axial = self._arrays.axial
        if axial is not None:
            result[axial.supports] = scaled(self.axial[values][axial.support_points], getattr(axial.units, exponent))
        return read_only(result)

    @cached_property
    def reaction(self) -> np.ndarray:
        """Reactions, positive upward; of an axial support positive to the right."""
        result = np.zeros(len(self._arrays.sides))
        result[self._arrays.supports] = scaled(self.solution.reaction, self._arrays.units.force)
        return self._along_axis(result, 2, "force")

    @cached_property
    def deflection(self) -> np.ndarray:
        """Deflection of the beam at each support, positive downward; at an axial one to the right."""
        arrays = self._arrays
        result = np.where(arrays.across, scaled(self.solution.deflection[arrays.places], arrays.units.deflection), 0.0)
        return self._along_axis(result, 0, "deflection")

    @cached_property
    def opening(self) -> np.ndarray:
        """Distance still to go until a support acts; negative where the beam has gone past one without stiffness."""
        arrays = self._arrays
        way = scaled(ways_to_contact(arrays, self.solution), arrays.units.deflection)
        way[arrays.supports] = np.where(self.solution.closed == 1, 0.0, np.maximum(way[arrays.supports], 0.0))
        return read_only(np.where(arrays.sides == 0, 0.0, way))

    @cached_property
    def couple(self) -> np.ndarray:
        """Couple of each support on the beam, positive clockwise; a rotational restraint acts at open supports too."""
        arrays = self._arrays
        if not arrays.turning.any():
            return read_only(np.zeros(len(arrays.sides)))
        at_node = couples_at_nodes(arrays, self.factor, self.solution)[arrays.places]
        own = scaled(at_node * arrays.couple_share, arrays.units.moment)
        return read_only(np.where(arrays.couple_share > 0.0, own, 0.0))

    @cached_property
    def state(self) -> tuple[str, ...]:
        """``closed``, ``open`` or ``bilateral``."""
        return name_states(self._arrays, self.closed)

    @cached_property
    def _certified(self) -> tuple[np.ndarray, np.ndarray, bool]:
        return engine.certify(self._arrays, self._links, self.factor, self.solution, self.starts)

    @property
    def error_bounds(self) -> dict[str, float | None]:
        """Largest errors of deflections, rotations, moments and shears anywhere along the beam, and of the reactions.

        Deflections and rotations have none (None) where the beam is free to move.
        """
        units = self._arrays.units
        powers = dict(zip(BOUNDED, [*units.field.tolist(), units.force], strict=True))
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
        (_, (deflection, reaction, *_), known), units = self._certified, self._arrays.units
        return bound_in_scene(deflection, units.deflection) if known else None, bound_in_scene(reaction, units.force)

    @property
    def residuals(self) -> dict[str, float]:
        """Relative residuals of equilibrium, compatibility and complementarity."""
        compatibility, equilibrium, complementarity = self._certified[0].tolist()
        return {"equilibrium": equilibrium, "compatibility": compatibility, "complementarity": complementarity + 0.0}

    @property
    def certificate(self) -> dict[str, float | None]:
        """The residuals, and bounds of the errors relative to the largest value of each kind; computed when first asked for."""
        fields = engine.largest_fields(self._arrays, self.factor, self.starts).tolist()
        largest = dict(zip(BOUNDED, [*fields, float(np.abs(self.solution.reaction).max(initial=0.0))], strict=True))
        relative = {kind: _relative(bound, largest[kind]) for kind, bound in self._inner_bounds.items()}
        return {
            **self.residuals,
            "error_bound": None if None in relative.values() else max(relative.values()),
            **{f"error_bound_{kind}": bound for kind, bound in relative.items()},
        }

    @cached_property
    def undecided(self) -> tuple[int, ...]:
        """Supports whose reaction or opening is zero, even in quadruple precision: they may be closed or open."""
        return tuple(self._arrays.supports[self.solution.undecided == 1].tolist())

    @cached_property
    def starts(self) -> np.ndarray:
        """Fields at the left end of every piece of the beam."""
        return engine.recover(self._arrays, self._links, self.factor, self.solution)


def name_states(arrays: Arrays, closed: np.ndarray) -> tuple[str, ...]:
    """Name the state of every support of the scene in a working scheme.

    Parameters
    ----------
    arrays : Arrays
        The lowered scene.
    closed : numpy.ndarray of int
        1 where a support that can carry acts.

    Returns
    -------
    tuple of str
        ``closed``, ``open`` or ``bilateral``.
    """
    acts = np.zeros(len(arrays.sides), dtype=bool)
    acts[arrays.supports] = closed == 1
    return tuple(np.where(arrays.sides == 0, "bilateral", np.where(acts, "closed", "open")).tolist())


def couples_at_nodes(arrays: Arrays, factor: float, solution: Solution) -> np.ndarray:
    """Couples of the rotational restraints on the beam.

    Parameters
    ----------
    arrays : Arrays
        The lowered scene.
    factor : float
        Factor of the live loads.
    solution : Solution
        Solved at that factor.

    Returns
    -------
    numpy.ndarray
        At every node, positive clockwise, in the engine's units.
    """
    # Across a node the moment grows by the applied couple and that of the supports
    return solution.moment_right - solution.moment_left - arrays.engine.couple @ (1.0, factor)


def ways_to_contact(arrays: Arrays, solution: Solution) -> np.ndarray:
    """Distances that the beam is from its one-sided supports.

    Parameters
    ----------
    arrays : Arrays
        The lowered scene.
    solution : Solution
        Solved.

    Returns
    -------
    numpy.ndarray
        Of every support of the scene, in the engine's units: negative where the beam has gone past it, 0 for others.
    """
    levels = scaled(arrays.levels, -arrays.units.deflection)
    return arrays.sides * (levels - solution.deflection[arrays.places])


def _check_range(arrays: Arrays, factor: float, solution: Solution, axial: tuple[np.ndarray, ...] | None) -> None:
    """Refuse a solution with numbers that are none, or none in the scene's units."""
    units, x = arrays.units, arrays.node_x
    with np.errstate(over="ignore", invalid="ignore"):
        ways, couples = ways_to_contact(arrays, solution), couples_at_nodes(arrays, factor, solution)
    numbers = [
        (solution.deflection, units.deflection, x, "deflection", LONGER),
        (ways, units.deflection, x[arrays.places], "opening of the support", LONGER),
        (solution.moment_left, units.moment, x, "moment", STRONGER),
        (solution.moment_right, units.moment, x, "moment", STRONGER),
        (solution.shear, units.force, x[1:], "shear", STRONGER),
        (solution.reaction, units.force, x[arrays.support_nodes], "reaction of the support", STRONGER),
        (np.where(arrays.turning > 0.0, couples, 0.0), units.moment, x, "couple of the rotational restraint", STRONGER),
    ]
    if not all(np.isfinite(np.abs(values).max(initial=0.0)) for values, *_ in numbers):
        refuse_farthest(arrays)
    if arrays.axial is not None:
        (u, tension, reaction), power = axial, arrays.axial.units
        x = arrays.point_x[arrays.axial.points]
        numbers += [
            (u, power.deflection, x, "axial displacement", LONGER),
            (reaction, power.force, x, "axial reaction", STRONGER),
            (tension, power.force, x[1:], "axial force", STRONGER),
        ]
    for values, exponent, place, what, remedy in numbers:
        to_scene(values, exponent, place, what, remedy)


def _relative(bound: float | None, size: float) -> float | None:
    """Bound as a share of the largest value; None where there is none, or none that is a number."""
    if bound is None or not np.isfinite(bound):
        return None
    with np.errstate(over="ignore"):
        share = float(np.divide(bound, size)) if size > 0.0 else 0.0
    return share if np.isfinite(share) else None


def solve_step(
    arrays: Arrays, links: np.ndarray, factor: float, rule: str, closed: np.ndarray
) -> Step | Solution | None:
    """Solve one state.

    Parameters
    ----------
    arrays, links, factor, rule, closed
        As for `engine.solve`.

    Returns
    -------
    Step, Solution or None
        The step; the solution with its motion where there is no equilibrium; None where the beam slides.
    """
    step = Step(arrays, links, factor, rule, closed)
    if arrays.axial is not None and step.axial is None:
        return None
    return step if step.solution.status == engine.SOLVED else step.solution
