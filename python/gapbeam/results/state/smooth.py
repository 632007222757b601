"""Smooth laws of supports over the deflections of the beam, and lines in place of them."""

from __future__ import annotations

import numpy as np

from ...base.errors import EngineError, Status
from ...engine.beam import Beam
from ...engine.states import Solution
from ...engine.units import scaled


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

    def audit(self, solution: Solution, factor: float, tolerance: float) -> None:
        """Refuse a state in which a support has not the force of its law.

        Parameters
        ----------
        solution : Solution
            The state.
        factor : float
            Its load factor, for the message.
        tolerance : float
            Share of the largest reaction that is nothing.

        Raises
        ------
        EngineError
            Which support, and both forces.
        """
        d, way = self.past_the_gap(self.deflections(solution))
        force, found = self.forces_and_slopes(d)[0] * way, self.reactions(solution)
        off = np.abs(found - force)
        worst = int(off.argmax())
        if off[worst] > tolerance * np.abs(solution.at_supports[0]).max():
            raise EngineError(
                f"supports[{self._numbers[worst]}].law: at load factor {factor:.9g} the path leads to a reaction of "
                f"{found[worst]:.6g}, where the law gives {force[worst] + 0.0:.6g}: the supports may carry less than this load; "
                "lower it, or give the laws as polylines",
                Status.NOT_CONVERGED,
            )

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
