"""Solve cases whose numbers are checked: chosen once for a beam, by its loads condensed one by one, or each case anew."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np

from ...base.errors import Status
from ...base.records import Pickled, read_only
from ...engine.arrays import Columns
from ...engine.beam import Beam
from ...engine.calls import FEW_NODES
from ...engine.cases import OneCase, solve_cases, split_loads
from ...engine.combinations import Varied, all_combinations
from ...scene.held import hold
from ...scene.movements import Movements, replace_settlements
from ...scene.reading import prepared_beam
from ...scene.structs import Scene
from ..paths.compression_check import pieces_in_sections, refused_cases
from ..result import Result
from ..state.fields import find_places
from ..state.schemes import starting_scheme
from .asked import Asked
from .case_result import result_of_case
from .solved_cases import Cases, cases_of
from .varied import base_values


class CaseSolver(Pickled):
    """Cases of a beam by superposition of its loads, condensed one by one, in the contact state of each case.

    Parameters
    ----------
    scene : Scene
        Checked.
    beam : Beam
        Made of it.
    rule : {"block", "single"}
        How contact states are found.
    movements : Movements, optional
        What the loads move; the scene and its beam do not know of it.
    columns : Columns, optional
        Numbers that cases begin with, if they are not those of the beam.

    Attributes
    ----------
    supports : numpy.ndarray of int
        Numbers in the scene of the supports across the beam, and of those that hold rotations.
    start : numpy.ndarray of int
        Where searches start if nothing else is said.
    one : OneCase or None
        The short call for one case, where there is one.
    """

    def __init__(self, scene: Scene, beam: Beam, rule: str, movements: Movements | None = None, columns: Columns | None = None):
        self.scene, self.beam, self.rule, self.movements = hold(scene), beam, rule, movements
        self.columns = beam.columns if columns is None else columns
        self.supports = read_only(np.flatnonzero(beam.bends))
        self.start = read_only(starting_scheme(beam))
        # Columns of the supports of the engine; None if these are the same, one by one
        self._carries = None if np.array_equal(beam.numbers, self.supports) else np.searchsorted(self.supports, beam.numbers)
        # What its effect on bending is, is left out: cases whose compression is beyond the Euler load are refused
        axial = len(beam.bends) - int(beam.bends.sum())
        self.may_buckle = (beam.bars >= 0 or axial > 1) and not scene.analysis.first_order and not beam.feels_axial_loads
        self._may_be_pushed = beam.bars < 0 and axial > 1
        self.one = self._condense()

    def __getstate__(self) -> dict[str, Any]:
        """Leave out the short call."""
        return {name: value for name, value in self.__dict__.items() if name != "one"}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Take the attributes back."""
        super().__setstate__(state)
        hold(self.scene)
        self.one = self._condense()

    def _condense(self) -> OneCase | None:
        """Condense the loads, and make the short call."""
        split_loads(self.beam)
        short = len(self.scene.loads) > 0 and self.beam.links + 1 < FEW_NODES and self.movements is None
        short = short and self._carries is None and not (self.may_buckle or self._may_be_pushed)
        return OneCase(self.beam, self.rule, self.scene) if short else None

    def moved(self, factors: np.ndarray, varied: Varied) -> Varied:
        """Move supports by the loads that do so.

        Parameters
        ----------
        factors : numpy.ndarray
            Of all loads, cases by loads.
        varied : Varied
            Numbers that differ from those of the beam; left as they are.
        """
        if self.movements is None:
            return varied
        moves = np.zeros((len(factors), self.beam.scene_supports))
        self.movements.add_to(moves, factors)
        return self.settle(varied, moves)

    def settle(self, varied: Varied, moves: np.ndarray) -> Varied:
        """Move supports further.

        Parameters
        ----------
        varied : Varied
            As for `moved`.
        moves : numpy.ndarray
            Further movements, cases by supports.
        """
        supports = varied.supports
        if supports is None:
            supports = np.broadcast_to(base_values(self.columns), (len(moves), moves.shape[1] + 1, 3))
        supports = supports.copy()
        supports[:, :-1, 0] += moves
        return replace(varied, supports=supports)

    def along(self, varied: Varied) -> CaseSolver:
        """Give the solver of cases in which supports move along the axis, of whose forces the beam knows nothing so far.

        Parameters
        ----------
        varied : Varied
            Numbers that differ from those of the beam.
        """
        if not self._may_be_pushed or varied.supports is None:
            return self
        moved = varied.supports[:, :-1, 0] != self.columns.support[3, :-1]
        return self._along if moved[:, ~self.beam.bends].any() else self

    @cached_property
    def _along(self) -> CaseSolver:
        """Of the same beam with forces along it: its axial supports have moved by a share of its length, and every case its own."""
        moves = np.where(self.beam.bends, 0.0, self.beam.places.end / 1024)
        return solver_of(self.scene, prepared_beam(replace_settlements(self.scene, moves)), self.rule, self.movements, self.columns)

    def starting(self, closed: np.ndarray) -> np.ndarray:
        """Give the start of a search.

        Parameters
        ----------
        closed : numpy.ndarray of int
            For every support across the beam.

        Returns
        -------
        numpy.ndarray of int
            For every support of the engine.
        """
        return closed if self._carries is None else closed[self._carries]

    def solve(
        self, factors: np.ndarray, closed: np.ndarray, varied: Varied, want: tuple[str, ...], *, single: bool = False,
        out: Cases | None = None,
    ) -> Cases:  # fmt: skip
        """Solve cases.

        Parameters
        ----------
        factors : numpy.ndarray
            Of all loads, finite, cases by loads.
        closed : numpy.ndarray of int
            Where the searches start, supports of the engine.
        varied : Varied
            Numbers that differ from those of the beam.
        want : tuple of str
            From `wanted_names`.
        single : bool
            Whether it is one case, without an axis of cases.
        out : Cases, optional
            Earlier ones to be filled again.
        """
        found = self._find(factors, closed, varied, want, out)
        asked = Asked(self.beam, self.rule, factors, found["closed"], varied, closed, self.scene)
        again = None if asked.is_anew else found
        if self._carries is not None:
            found = self._by_scene(found)
        if self.may_buckle:
            asked, found = self._refuse_buckling(asked, found)
        cases = cases_of({}, None, False) if out is None else out
        cases._fill(found, asked, single, again)
        return cases

    def _find(
        self, factors: np.ndarray, closed: np.ndarray, varied: Varied, want: tuple[str, ...], out: Cases | None
    ) -> dict[str, np.ndarray]:
        """Find the contact states and solve for what is wanted, reactions with columns for the supports across the beam."""
        into = None if out is None else out._take_arrays()
        found = solve_cases(self.beam, factors, self.rule, closed, varied, want, into)
        if self._carries is not None and "reaction" in found:
            idle = np.where(found["status"] == Status.SOLVED, 0.0, np.nan)
            found["reaction"] = self._by_supports(found["reaction"], self._carries, idle)
        return found

    def _buckling(self, asked: Asked, solved: np.ndarray) -> np.ndarray:
        """Which of the solved cases have a compression beyond the Euler load."""
        sections = pieces_in_sections(self.scene, self.beam)
        return solved & refused_cases(self.beam, asked.factors, self.rule, asked.closed, asked.varied, sections)

    def _refuse_buckling(self, asked: Asked, found: dict[str, np.ndarray]) -> tuple[Asked, dict[str, np.ndarray]]:
        """Refuse cases whose compression is beyond the Euler load: their values are not-a-number, and what is asked later too."""
        refused = self._buckling(asked, found["status"] == Status.SOLVED)
        if not refused.any():
            return asked, found
        found = {name: values.copy() for name, values in found.items()}
        for name, values in found.items():
            values[refused] = Status.BAD_INPUT if name == "status" else 0 if values.dtype.kind == "i" else np.nan
        factors = asked.factors.copy()
        factors[refused] = np.nan
        return replace(asked, factors=factors), found

    def _by_scene(self, found: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
        """The same with states of the supports of the scene across the beam."""
        closed = self._by_supports(found["closed"], self._carries, np.zeros(len(found["status"]), dtype=np.int32))
        for k in self.beam.laws if self.beam.has_laws else ():
            at = np.searchsorted(self.supports, k)
            _, middle, at_middle = self.beam.laws[k]  # it acts by the number of closed breakpoints
            closed[:, at] = np.abs(closed[:, at] - middle) + at_middle > 0
        return {**found, "closed": closed}

    def _by_supports(self, values: np.ndarray, carries: np.ndarray, idle: np.ndarray) -> np.ndarray:
        """Add up the columns of the breakpoints of laws, and add those of supports that can carry nothing."""
        columns = np.repeat(idle[:, None], len(self.supports), axis=1)
        columns[:, carries] = 0
        np.add.at(columns, (slice(None), carries), values)
        return columns

    def result(self, factors: np.ndarray, varied: Varied) -> Result:
        """Solve one case with all that there is to say of it, whether the beam would buckle or not.

        Parameters
        ----------
        factors : numpy.ndarray
            Of all loads.
        varied : Varied
            Numbers of this one case.
        """
        return result_of_case(self.scene, self.beam, self.rule, factors, varied)


class WithLaws(CaseSolver):
    """Cases of a beam on laws, each anew where its supports have other numbers: their breakpoints are made of these."""

    def _condense(self) -> None:
        split_loads(self.beam)

    def _find(
        self, factors: np.ndarray, closed: np.ndarray, varied: Varied, want: tuple[str, ...], out: Cases | None
    ) -> dict[str, np.ndarray]:
        if varied.supports is None:
            return super()._find(factors, closed, varied, want, out)
        return self._find_anew(factors, closed, varied, want)

    def _find_anew(self, factors: np.ndarray, closed: np.ndarray, varied: Varied, want: tuple[str, ...]) -> dict[str, np.ndarray]:
        """Solve each case from its numbers on, as `solve_cases` gives it, but for reactions."""
        piece, distance = self._sides_of_nodes
        nodes = len(self.beam.node_x)
        found = all_combinations(self.beam, factors, None, self.rule, closed, piece, distance, varied, extremes=False)
        left, right = found.fields[:, :nodes, 2].copy(), found.fields[:, nodes:, 2].copy()
        solved = found.status == Status.SOLVED
        left[solved, 0] = right[solved, -1] = 0.0  # beside the beam
        arrays = {
            "deflection": found.fields[:, nodes:, 0].copy(), "moment_left": left, "moment_right": right,
            "reaction": found.at_supports[:, 0][:, self.supports],
        }  # fmt: skip
        arrays = {name: arrays[name] for name in want}
        return arrays | {"closed": found.closed.copy(), "solves": found.solves.copy(), "status": found.status.copy()}

    @cached_property
    def _sides_of_nodes(self) -> tuple[np.ndarray, np.ndarray]:
        """Pieces and distances of all nodes, on their left, then on their right."""
        sides = [find_places(self.beam, self.beam.node_x, side) for side in ("left", "right")]
        return tuple(np.concatenate(parts) for parts in zip(*sides, strict=True))


class SolvedAlone(WithLaws):
    """Cases of a beam on ground, with an axial force that bending feels, on curves or on a path, most of them another beam each."""

    def _find(
        self, factors: np.ndarray, closed: np.ndarray, varied: Varied, want: tuple[str, ...], out: Cases | None
    ) -> dict[str, np.ndarray]:
        if varied.is_nothing:
            return CaseSolver._find(self, factors, closed, varied, want, out)
        return self._find_anew(factors, closed, varied, want)

    def _buckling(self, asked: Asked, solved: np.ndarray) -> np.ndarray:
        if self.beam.has_links_along and not (self.beam.has_laws or self.beam.is_on_axial_ground):
            return super()._buckling(asked, solved)  # bars are straight between the supports, whose stiffness is their own
        return np.array([bool(one) and self._buckles(asked, k) for k, one in enumerate(solved)], dtype=bool)

    def _buckles(self, asked: Asked, k: int) -> bool:
        given = asked.varied.supports, asked.varied.spans, asked.varied.moduli
        varied = Varied(*(None if one is None else one[k : k + 1] for one in given))
        found = self.result(asked.factors[k], varied).compression
        return found is not None and found.is_refused


def solver_of(
    scene: Scene, beam: Beam, rule: str, movements: Movements | None = None, columns: Columns | None = None
) -> CaseSolver:
    """Choose how the cases of a beam are solved.

    Parameters
    ----------
    scene, beam, rule, movements, columns
        As for `CaseSolver`.
    """
    kind = SolvedAlone if beam.is_solved_alone else WithLaws if beam.has_laws else CaseSolver
    return kind(scene, beam, rule, movements, columns)
