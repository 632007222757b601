"""Smooth laws of supports: from the state on a polyline through the curve to the state on the curve itself.

Each curve is replaced by its tangent where the support is, the beam is solved with that, and so on (Newton). Tangents are
pieces of laws as any others, so each of these solves is one of the engine; what it converges to is on the curve, to all
digits.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...base.errors import EngineError, Status
from ...engine.beam import GIVEN, NO_EQUILIBRIUM, SOLVED, Beam
from ...engine.states import Solution
from ...engine.units import scaled

USUAL_TANGENTS, MOST_TANGENTS = 10, 60
"""From a polyline as near as it is some five do."""
MOST_SHORTENED = 12
"""So often a tangent may lead too far; after that the support has opened."""
DIGITS = 4 * np.finfo(float).eps
"""Relative change of a displacement below which the last tangent was one at the solution."""
LAST_DIGIT = np.finfo(float).eps / 2
"""Share of a force by which a tangent at the solution is beside its curve at most."""
ROUNDING = 1e-13
"""The same where more tangents bring no more digits."""
AUDITED = 16
"""So many times that a force may be off its curve when all is done."""
LESS = 1e-9
"""Share by which laws are taken to give less than all that they can, to see whether anything else holds the beam."""
NOT_MET = "the smooth laws of the supports could not be met: give them as polylines"


class SmoothLaws:
    """The smooth laws of a beam, as forces over the deflections of the beam where they are.

    Parameters
    ----------
    beam : Beam
        With smooth laws (`Beam.curves`).

    Attributes
    ----------
    groups : list of slice
        Their breakpoints in the engine.
    nodes : numpy.ndarray of int
        Their nodes.
    side, gap, settlement : numpy.ndarray
        As in the scene.
    """

    def __init__(self, beam: Beam):
        self.beam = beam
        self.curves = [curve for _, curve in beam.curves]
        self._numbers = np.array([number for number, _ in beam.curves])
        self.groups = [beam.laws[number][0] for number in self._numbers.tolist()]
        self.nodes = beam.places.support_nodes[[group.start for group in self.groups]]
        self.side = beam.sides[self._numbers]
        self.gap, self.settlement = beam.columns.support[2:4, self._numbers]

    def deflections(self, solution: Solution) -> np.ndarray:
        """Give the deflections there in the scene's units."""
        return scaled(solution.deflection[self.nodes], self.beam.units.deflection)

    def reactions(self, solution: Solution) -> np.ndarray:
        """Give the reactions there in the scene's units, positive upward."""
        return solution.at_supports[0, self._numbers]

    def past_the_gap(self, deflection: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Give the displacements past the gap, negative where a support is open, and which way they go (1 downward)."""
        moved = deflection - self.settlement
        way = np.where(self.side == 0, np.where(moved < 0.0, -1, 1), self.side)
        return way * moved - self.gap, way

    def forces_and_slopes(self, d: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Give forces, in the way of the displacement `d` past the gap, and slopes."""
        found = np.zeros((2, len(d)))
        for i, curve in enumerate(self.curves):
            if d[i] > 0.0:
                found[:, i] = curve.force_and_slope(float(d[i]))
            elif self.side[i] == 0 and self.gap[i] == 0.0:
                found[1, i] = curve.force_and_slope(0.0)[1]
        return found[0], found[1]

    def springs(self, deflection: np.ndarray) -> np.ndarray:
        """Give stiffnesses about those of the laws at given deflections, none of them falling; 0 where there is none."""
        d, _ = self.past_the_gap(deflection)
        found = np.zeros(len(d))
        for i, curve in enumerate(self.curves):
            for at in (d[i], d[i] / 2, curve.scale(), curve.scale() / 2):
                if at > 0.0 and not found[i] > 0.0:
                    force, slope = curve.force_and_slope(float(at))
                    found[i] = max(slope, force / at)
        return found

    def let_go(self, motion: np.ndarray, force: np.ndarray, way: np.ndarray) -> bool:
        """Tell whether all laws give as much against a motion as they ever can, so that no other state stops it.

        Parameters
        ----------
        motion : numpy.ndarray
            Displacements of the nodes, positive downward.
        force, way : numpy.ndarray
            Forces, and which way the supports are pressed (1 downward).
        """
        moved = motion[self.nodes]
        gives_all = (way * moved > 0.0) & (force >= (1.0 - DIGITS) * np.array([curve.bound() for curve in self.curves]))
        is_left = (force == 0.0) & (self.side * moved < 0.0)
        return bool(np.all((moved == 0.0) | gives_all | is_left))

    def at_capacity(self, beam: Beam, factor: float, solution: Solution) -> Solution | None:
        """Tell whether the load is, to the last digit, all that the laws can ever give, so that no finite displacement carries it.

        Parameters
        ----------
        beam : Beam
            With tangents instead of the laws.
        factor : float
            Load factor.
        solution : Solution
            Solved with these.

        Returns
        -------
        Solution or None
            That there is no equilibrium; None where there is.
        """
        deflection, reaction = self.deflections(solution), self.reactions(solution)
        d, way = self.past_the_gap(deflection)
        force, bound = way * reaction, np.array([curve.bound() for curve in self.curves])
        full = force >= (1.0 - DIGITS) * bound
        if not full.any():
            return None
        # A little less, and level: does anything else hold the beam
        slope = np.where(full, 0.0, self.forces_and_slopes(d)[1])
        force = np.where(full, (1.0 - LESS) * bound, force)
        try:
            found = self.with_lines(beam, deflection, force * way, slope).solve(factor, "block", solution.closed)
        except EngineError:
            return None
        falls = found.status == NO_EQUILIBRIUM and not found.slides
        return found if falls and self.let_go(found.motion, np.where(full, bound, force), way) else None

    def audit(self, reached: np.ndarray, d: np.ndarray, given: np.ndarray, size: float) -> None:
        """Refuse forces that are not on the laws.

        Parameters
        ----------
        reached, d : numpy.ndarray
            Forces and displacements past the gap.
        given : numpy.ndarray of bool
            Which displacements are those of the forces.
        size : float
            The largest displacement, of which `d` is known to rounding.

        Raises
        ------
        EngineError
            They are off by more than rounding.
        """
        force, slope = self.forces_and_slopes(d)
        with np.errstate(invalid="ignore"):
            terms = np.abs(force) + slope * size
            # What rounding makes of the largest may be at one that only touches
            off = np.abs(force - reached) > AUDITED * (ROUNDING * terms + LAST_DIGIT * np.abs(reached).max(initial=0.0))
        if np.any(off & ~given):
            where = int(np.flatnonzero(off & ~given)[0])
            number = int(self._numbers[where])
            raise EngineError(f"supports[{number}].law: the result does not stand its own audit: the force is not that of "
                              "the law at the deflection; give the law as a polyline, and report the scene", Status.NOT_CONVERGED)

    def with_lines(self, beam: Beam, deflection: np.ndarray, force: np.ndarray, slope: np.ndarray) -> Beam:
        """Make the beam with lines instead of the laws.

        Parameters
        ----------
        beam : Beam
            The beam.
        deflection, force : numpy.ndarray
            A point of each line, in the scene's units; forces upward.
        slope : numpy.ndarray
            Slopes of the lines.
        """
        units, breakpoints = beam.units, beam.breakpoints.copy()
        lines = np.array([
            scaled(deflection, -units.deflection),
            scaled(force * np.where(self.side == 0, 1, self.side), -units.force),
            *2 * [scaled(slope, units.deflection - units.force)],
        ])  # fmt: skip
        for i, group in enumerate(self.groups):
            breakpoints[:, group] = lines[:, i, None]  # on both sides of all breakpoints
        return beam.with_breakpoints(breakpoints)


def solve_on_curves(beam: Beam, factor: float, solution: Solution, rule: str = GIVEN) -> tuple[Beam, Solution]:
    """Go from the polylines of smooth laws to the laws.

    Parameters
    ----------
    beam : Beam
        With smooth laws (`Beam.curves`).
    factor : float
        Factor of the live loads.
    solution : Solution
        Solved with the polylines.
    rule : {"given", "block", "single"}
        How the scheme of the other supports is found.

    Returns
    -------
    beam : Beam
        The same with tangents instead of the laws.
    solution : Solution
        On the laws; without equilibrium where they give all that they can.

    Raises
    ------
    EngineError
        The tangents do not settle.
    """
    laws = SmoothLaws(beam)
    count = len(laws.curves)
    closed, solves = solution.closed, solution.solves
    before, way_before = np.full(count, np.inf), np.zeros(count, dtype=int)
    shortened = np.zeros(count, dtype=int)
    change_before = np.zeros(count)
    for tangents in range(MOST_TANGENTS):
        deflection = laws.deflections(solution)
        moved = deflection - laws.settlement
        d, way = laws.past_the_gap(deflection)
        reached = way * laws.reactions(solution)
        by_force = [
            curve.displacement(force) if force > 0.0 else None for curve, force in zip(laws.curves, reached.tolist(), strict=True)
        ]
        given = np.array([one is not None for one in by_force])
        d = np.where(given, np.array(by_force, dtype=float), d)
        if not np.isfinite(d).all():
            break  # beyond the range of doubles
        size = np.maximum(np.abs(moved), np.abs(laws.gap))
        if np.all(np.abs(d - before) <= (DIGITS * size if tangents < USUAL_TANGENTS else ROUNDING * size.max())):
            laws.audit(reached, d, given, size.max(initial=0.0))
            return beam, replace(laws.at_capacity(beam, factor, solution) or solution, solves=solves)
        if tangents and not given.any():
            # The tangents have met the curves to the last digit: another round would move the displacements by rounding alone
            force, slope = laws.forces_and_slopes(d)
            with np.errstate(invalid="ignore"):
                met = np.abs(force - reached) <= LAST_DIGIT * (np.abs(force) + slope * size)
            if met.all():
                return beam, replace(laws.at_capacity(beam, factor, solution) or solution, solves=solves)
        # From a flat part of a curve the tangent may lead to its other side: first nearer, on this side
        overshot = (before > 0.0) & ((d <= 0.0) | (way != way_before)) & (np.isfinite(before)) & (shortened < MOST_SHORTENED)
        d, way = np.where(overshot, before / 8, d), np.where(overshot, way_before, way)
        shortened += overshot
        # About a bend they may go to and fro for ever: then half as far
        change = d - before
        halved = (tangents >= USUAL_TANGENTS) & (d > 0.0) & (way == way_before) & (np.sign(change) == -np.sign(change_before))
        d = np.where(halved, (d + before) / 2, d)
        before, way_before, change_before = d, way, change
        force, slope = laws.forces_and_slopes(d)
        at = np.where(given | overshot | halved, laws.settlement + way * (laws.gap + d), deflection)
        beam = laws.with_lines(beam, at, force * way, slope)
        solution = beam.solve(factor, rule, closed)
        solves += solution.solves
        if solution.status == NO_EQUILIBRIUM and not solution.slides and laws.let_go(solution.motion, force, way):
            return beam, replace(solution, solves=solves)
        if solution.status != SOLVED:
            break
        closed = solution.closed
    raise EngineError(NOT_MET, Status.NOT_CONVERGED)


def with_openings(beam: Beam, solution: Solution) -> Solution:
    """Put right how far supports with smooth laws are open: what replaced the laws begins elsewhere.

    Parameters
    ----------
    beam : Beam
        With smooth laws, or lines instead of them.
    solution : Solution
        On the laws.
    """
    laws = SmoothLaws(beam)
    d, _ = laws.past_the_gap(laws.deflections(solution))
    at_supports = solution.at_supports.copy()
    at_supports[2, [number for number, _ in beam.curves]] = np.maximum(-d, 0.0)
    return replace(solution, at_supports=at_supports)


def factor_on_curves(beam: Beam, factor: float, closed: np.ndarray, support: int) -> float:
    """Load factor at which a support changes its state, on the smooth laws of others.

    Parameters
    ----------
    beam : Beam
        With smooth laws.
    factor : float
        The same with their polylines.
    closed : numpy.ndarray of int
        The scheme before.
    support : int
        Number of the support or breakpoint in the engine.
    """
    node, contact = beam.places.support_nodes[support], beam.breakpoints[0, support]
    ordinary = int(beam.numbers[support]) not in beam.laws
    for _ in range(MOST_TANGENTS):
        tangent, here = solve_on_curves(beam, factor, beam.solve(factor, GIVEN, closed))
        if here.status != SOLVED:
            raise EngineError(NOT_MET, Status.NOT_CONVERGED)
        step = max(abs(factor), 1.0)
        there = tangent.solve(factor + step, GIVEN, closed)
        if ordinary and closed[support]:
            now, then = here.reaction[support], there.reaction[support]
        else:
            now, then = here.deflection[node] - contact, there.deflection[node] - contact
        if now == then:
            return factor
        change = step * now / (then - now)
        factor -= change
        if abs(change) <= DIGITS * abs(factor):
            return float(factor)
    return float(factor)
