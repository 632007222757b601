"""The state at one load factor.

Signs: deflections positive downward, reactions upward, couples clockwise; at axial supports both to the right.
"""

from __future__ import annotations

from functools import cached_property
from time import perf_counter
from typing import NamedTuple

import numpy as np

from . import engine
from .engine import Solution
from .lowering import Arrays
from .records import Pickled, read_only

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
        axial = engine.solve_axial(self._arrays, self.factor) if self._arrays.axial is not None else None
        solution = engine.solve(self._arrays, self._links, self.factor, self._rule, self._start)
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

    def _scatter(self, normal: np.ndarray, axial: np.ndarray | None = None) -> np.ndarray:
        """Values of the supports across the beam and along it, in the order of the scene."""
        arrays = self._arrays
        result = np.zeros(self._arrays.support_count)
        result[arrays.supports] = normal
        if axial is not None and arrays.axial is not None:
            result[arrays.axial.supports] = axial[arrays.axial.support_points]
        return read_only(result)

    @cached_property
    def reaction(self) -> np.ndarray:
        """Reactions, positive upward; of an axial support positive to the right."""
        return self._scatter(self.solution.reaction, self.axial[2] if self.axial else None)

    @cached_property
    def deflection(self) -> np.ndarray:
        """Deflection of the beam at each support, positive downward; at an axial one to the right."""
        w = self.solution.deflection[self._arrays.support_nodes]
        return self._scatter(w, self.axial[0] if self.axial else None)

    @cached_property
    def opening(self) -> np.ndarray:
        """Distance still to go until a support acts."""
        arrays = self._arrays
        w = self.solution.deflection[arrays.support_nodes]
        way = arrays.support_sides * (arrays.support_contact - w)
        return self._scatter(np.where(self.solution.closed == 1, 0.0, np.maximum(way, 0.0)))

    @cached_property
    def couple(self) -> np.ndarray:
        """Couple of each support on the beam, positive clockwise."""
        arrays = self._arrays
        nodes = arrays.support_nodes
        at_node = self.solution.moment_right - self.solution.moment_left
        at_node = at_node - arrays.couple @ (1.0, self.factor)  # M_right = M_left + applied couple + support's
        return self._scatter(np.where(arrays.couple_share > 0.0, at_node[nodes] * arrays.couple_share, 0.0))

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
        _, (_, reaction, *fields), known = self._certified
        named = dict(zip(BOUNDED, map(float, (*fields, reaction)), strict=True))
        return named if known else {**named, "deflection": None, "rotation": None}

    @property
    def bounds(self) -> tuple[float | None, float]:
        """Largest errors of the deflections of the nodes (None where the beam is free to move) and of the reactions."""
        _, (deflection, reaction, *_), known = self._certified
        return float(deflection) if known else None, float(reaction)

    @property
    def residuals(self) -> dict[str, float]:
        """Relative residuals of equilibrium, compatibility and complementarity."""
        compatibility, equilibrium, complementarity = self._certified[0].tolist()
        return {"equilibrium": equilibrium, "compatibility": compatibility, "complementarity": complementarity + 0.0}

    @property
    def certificate(self) -> dict[str, float | None]:
        """The residuals, and bounds of the errors relative to the largest value of each kind; computed when first asked for."""
        fields = np.abs(engine.extremes(self._arrays, self.factor, self.starts)[0]).max(axis=0)
        largest = dict(zip(BOUNDED, [*fields.tolist(), np.abs(self.solution.reaction).max(initial=0.0)], strict=True))
        relative = {
            kind: None if bound is None else float(bound / largest[kind]) if largest[kind] > 0.0 else 0.0
            for kind, bound in self.error_bounds.items()
        }
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
        1 where a support across the beam acts.

    Returns
    -------
    tuple of str
        ``closed``, ``open`` or ``bilateral``.
    """
    names = np.where(arrays.support_sides == 0, "bilateral", np.where(closed == 1, "closed", "open"))
    result = ["bilateral"] * arrays.support_count
    for k, name in zip(arrays.supports.tolist(), names.tolist(), strict=True):
        result[k] = name
    return tuple(result)


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
