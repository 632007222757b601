"""States of a train on smooth laws, found from those at positions near to them.

A beam on a polyline instead of every curve has a hundred breakpoints a support, and is far from the state on the curves. Here every
curve is a line from the start: its tangent where the states nearest to a position say that the support will be. Laws that
rise have but one state at a position, so it does not matter where the tangents begin (`smooth`).
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ...base.errors import EngineError
from ...engine.beam import SOLVED, Beam
from ..state.schemes import starting_scheme
from ..state.smooth import SmoothLaws

if TYPE_CHECKING:
    from ...engine.states import Solution

NEAREST = 4
"""Known states from which a state is guessed at most."""
STEEPEST = 8.0
"""Weight of one of them beyond which the nearest one alone is taken: they are too far away."""


class NearTangents:
    """States on smooth laws at positions of a train.

    Parameters
    ----------
    beam : Beam
        With smooth laws.
    rule : {"block", "single"}
        How contact states are found.
    """

    def __init__(self, beam: Beam, rule: str):
        self._columns, self._curves, self._rule = beam.columns, beam.curves, rule
        self._known: dict[bytes, tuple[list[float], list[np.ndarray]]] = {}  # by the axles that act: positions, deflections

    def keep(self, position: float, acts: np.ndarray, beam: Beam, solution: Solution) -> None:
        """Keep a state, for others to begin with.

        Parameters
        ----------
        position : float
            Of the train, above those kept before.
        acts : numpy.ndarray of bool
            Which axles act.
        beam, solution
            The state.
        """
        at, deflections = self._known.setdefault(acts.tobytes(), ([], []))
        at.append(position)
        deflections.append(SmoothLaws(beam).deflections(solution))

    def solve(
        self, position: float, acts: np.ndarray, load_codes: np.ndarray, load: np.ndarray
    ) -> tuple[Beam, Solution] | None:
        """Solve at a position.

        Parameters
        ----------
        position, acts
            Of the train.
        load_codes, load : numpy.ndarray
            All loads there, as in `Columns`.

        Returns
        -------
        (Beam, Solution) or None
            With tangents instead of the laws, and on the laws; None where the tangents lead nowhere.
        """
        guess = self._guess(position, acts)
        if guess is None:
            return None
        beam = Beam(replace(self._columns, load_codes=load_codes, load=load), self._curves)
        laws = SmoothLaws(beam)
        d, way = laws.past_the_gap(guess)
        force, slope = laws.forces_and_slopes(d)
        if not np.isfinite(slope).all():
            return None
        try:
            beam = laws.with_lines(beam, guess, force * way, slope)
            solution = beam.solve(1.0, self._rule, starting_scheme(beam), on_laws=True)
        except EngineError:
            return None
        if solution.status != SOLVED or solution.indifferent:
            return None
        return beam, solution

    def _guess(self, position: float, acts: np.ndarray) -> np.ndarray | None:
        """Deflections at the laws by a polynomial through the states nearest to a position."""
        at, deflections = self._known.get(acts.tobytes(), ((), ()))
        if not at:
            return None
        first = int(np.searchsorted(at, position)) - NEAREST // 2
        first = max(min(first, len(at) - NEAREST), 0)
        x = np.array(at[first : first + NEAREST])
        weights = np.array([np.prod((position - np.delete(x, i)) / (x[i] - np.delete(x, i))) for i in range(len(x))])
        if np.abs(weights).max() > STEEPEST:
            weights = np.eye(len(x))[np.abs(x - position).argmin()]
        return weights @ np.array(deflections[first : first + NEAREST])
