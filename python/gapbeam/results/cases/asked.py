"""The question that cases answer, kept so that more can be asked of them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ...base.errors import Status
from ...base.records import Record
from ...engine.beam import Beam
from ...engine.case_certificates import case_certificates
from ...engine.cases import WANTED, solve_cases
from ...engine.combinations import Combined, Varied, all_combinations
from ...scene.structs import Scene
from ..state.fields import find_places


@dataclass(frozen=True, slots=True, eq=False)
class Asked(Record):
    """What was asked for, so that more can be asked.

    Attributes
    ----------
    beam : Beam
        The prepared beam.
    rule : str
        How contact states are found.
    factors : numpy.ndarray
        Cases by loads.
    closed : numpy.ndarray of int
        Contact states that were found, or where the searches start: cases by supports of the engine.
    varied : Varied
        Numbers of the scene that differ from case to case, settlements included.
    start : numpy.ndarray of int or None
        Where the searches for the schemes that were found had started, supports of the engine; None if not known.
    scene : Scene or None
        The prepared scene.
    states : list of Combined
        What is known of them, but for fields at places: nothing, or one entry.
    """

    beam: Beam
    rule: str
    factors: np.ndarray
    closed: np.ndarray
    varied: Varied
    start: np.ndarray | None = None
    scene: Scene | None = None
    states: list[Combined] = field(default_factory=list, compare=False)

    @property
    def is_anew(self) -> bool:
        """Whether each case is another beam, with all that is asked of it: what is in contact, or the breakpoints of laws vary."""
        return self.beam.is_solved_alone or (self.beam.has_laws and self.varied.supports is not None)

    def solve(self, x: np.ndarray | None = None, side: str = "right") -> Combined:
        """Solve all cases.

        Parameters
        ----------
        x : numpy.ndarray, optional
            Places at which fields are wanted.
        side : {"right", "left"}
            Which value is taken where a field jumps.
        """
        asked = self.beam, self.factors, None, self.rule, self.closed
        if x is not None:
            return all_combinations(*asked, *find_places(self.beam, x, side), self.varied, extremes=False)
        found = self.states[0] if self.states else all_combinations(*asked, varied=self.varied)
        if self.is_anew and not self.states:
            self.states.append(found)
        return found

    def _once_more(self, status: np.ndarray, want: tuple[str, ...]) -> tuple[np.ndarray, dict[str, np.ndarray]]:
        """Solve all cases for what was not wanted at first, from the same start, as another one may lead to other last digits."""
        start = self.closed if self.start is None else self.start
        found = solve_cases(self.beam, self.factors, self.rule, start, self.varied, want)
        return np.where(status == Status.SOLVED, found["status"], status), found

    def solutions(self, status: np.ndarray, known: dict[str, np.ndarray]) -> tuple[Any, ...] | None:
        """Give what fields follow from.

        Parameters
        ----------
        status : numpy.ndarray of int
            That of all cases.
        known : dict of numpy.ndarray
            What is known of `WANTED`.

        Returns
        -------
        tuple or None
            As `case_extremes` takes it; None where each case was solved with all that is asked of it.
        """
        if self.is_anew:
            return None
        at_nodes = WANTED[:3]
        if not set(at_nodes) <= set(known):
            status, known = self._once_more(status, at_nodes)
        return self.beam, self.rule, self.factors, self.varied, self.closed, status, tuple(known[name] for name in at_nodes)

    def certified(self, status: np.ndarray, known: dict[str, np.ndarray]) -> tuple[dict[str, np.ndarray], np.ndarray]:
        """Give residuals and bounds, and the reactions to which they belong.

        Parameters
        ----------
        status, known
            As for `solutions`.

        Returns
        -------
        found : dict of numpy.ndarray
            By `case_certificates`.
        reaction : numpy.ndarray
            Cases by supports.
        """
        about = self.beam, self.rule, self.factors, self.closed
        if self.is_anew:
            return case_certificates(*about, status, self.varied, None), self.solve().at_supports[:, 0]
        # Reactions of the engine's supports, which those of the scene are without laws, and if all of them can carry
        is_whole = set(WANTED) <= set(known) and not self.beam.has_laws and known["reaction"].shape[1] == self.beam.supports
        if not is_whole:
            status, known = self._once_more(status, WANTED)
        return case_certificates(*about, status, self.varied, tuple(known[name] for name in WANTED)), known["reaction"]
