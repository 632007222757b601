"""Smooth laws of supports: from the state on a polyline through the curve to the state on the curve itself.

Each curve is replaced by its tangent where the support is, the beam is solved with that, and so on (Newton). Tangents are
pieces of laws as any others, so each of these solves is one of the engine; what it converges to is on the curve, to all
digits.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..base.errors import EngineError, Status
from ..engine.arrays import Solution
from ..engine.beam import GIVEN, Beam
from ..engine.units import scaled

MOST_TANGENTS = 60
"""From a polyline as near as it is some five do."""
MOST_SHORTENED = 12
"""So often a tangent may lead too far; after that the support has opened."""
DIGITS = 4 * np.finfo(float).eps
"""Relative change of a displacement below which the last tangent was one at the solution."""


def solve_on_curves(beam: Beam, factor: float, solution: Solution) -> tuple[Beam, Solution]:
    """Go from the polylines of smooth laws to the laws.

    Parameters
    ----------
    beam : Beam
        With smooth laws (`Beam.curves`).
    factor : float
        Factor of the live loads.
    solution : Solution
        Solved with the polylines.

    Returns
    -------
    beam : Beam
        The same with tangents instead of the laws.
    solution : Solution
        On the laws.

    Raises
    ------
    EngineError
        The tangents do not settle.
    """
    numbers = np.array([number for number, _ in beam.curves])
    groups = [beam.laws[number][0] for number in numbers.tolist()]
    nodes = beam.places.support_nodes[[group.start for group in groups]]
    side, gap, settlement = beam.sides[numbers], beam.columns.support[2, numbers], beam.columns.support[3, numbers]
    closed, solves = solution.closed, solution.solves
    before, way_before = np.full(len(numbers), np.inf), np.zeros(len(numbers), dtype=int)
    shortened = np.zeros(len(numbers), dtype=int)
    for _ in range(MOST_TANGENTS):
        moved = scaled(solution.deflection[nodes], beam.units.deflection) - settlement
        way = np.where(side == 0, np.where(moved < 0.0, -1, 1), side)
        d = way * moved - gap
        forces = [way[i] * float(scaled(solution.reaction[group].sum(), beam.units.force)) for i, group in enumerate(groups)]
        curves = zip(beam.curves, forces, strict=True)
        by_force = [curve.displacement(force) if force > 0.0 else None for (_, curve), force in curves]
        d = np.where([one is None for one in by_force], d, np.array(by_force, dtype=float))
        if not np.isfinite(d).all():
            break  # beyond the range of doubles
        if np.all(np.abs(d - before) <= DIGITS * np.maximum(np.abs(moved), np.abs(gap))):
            return beam, replace(solution, solves=solves)
        # From a flat part of a curve the tangent may lead to its other side: first nearer, on this side
        overshot = (before > 0.0) & ((d <= 0.0) | (way != way_before)) & (np.isfinite(before)) & (shortened < MOST_SHORTENED)
        d, way = np.where(overshot, before / 8, d), np.where(overshot, way_before, way)
        shortened += overshot
        before, way_before = d, way
        kinks = beam.kinks.copy()
        for i, (_, curve) in enumerate(beam.curves):
            if d[i] > 0.0:
                force, slope = curve.force_and_slope(float(d[i]))
            else:
                force, slope = 0.0, curve.force_and_slope(0.0)[1] if side[i] == 0 and gap[i] == 0.0 else 0.0
            # One line on both sides of all kinks, through the point of the curve at this deflection
            at = solution.deflection[nodes[i]]
            if by_force[i] is not None or overshot[i]:
                at = scaled(settlement[i] + way[i] * (gap[i] + d[i]), -beam.units.deflection)
            kinks[0, groups[i]] = at
            kinks[1, groups[i]] = scaled(np.float64(force * (way[i] if side[i] == 0 else 1)), -beam.units.force)
            kinks[2:, groups[i]] = scaled(np.float64(slope), beam.units.deflection - beam.units.force)
        beam = beam.with_kinks(kinks)
        solution = beam.solve(factor, GIVEN, closed)
        solves += solution.solves
    raise EngineError("the smooth laws of the supports could not be met: give them as polylines", Status.NOT_CONVERGED)


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
        Number of the support or kink in the engine.

    Returns
    -------
    float
    """
    node, contact = beam.places.support_nodes[support], beam.kinks[0, support]
    ordinary = int(beam.numbers[support]) not in beam.laws
    for _ in range(MOST_TANGENTS):
        tangent, here = solve_on_curves(beam, factor, beam.solve(factor, GIVEN, closed))
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
