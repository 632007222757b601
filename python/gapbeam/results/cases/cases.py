"""A beam prepared once and solved for many load cases: every load of the scene times a factor of its own.

Reading and condensing a scene costs far more than solving it. A prepared scene keeps what each load does to the
beam, so a case is one call of the engine, and a million cases are one call as well.
"""

from __future__ import annotations

import os
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from math import isfinite
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...base.errors import SceneError, Status
from ...base.records import Pickled, read_only
from ...engine.beam import Beam, RefusalError
from ...engine.calls import FEW_NODES
from ...engine.cases import OneCase, solve_cases, split_loads
from ...engine.combinations import Combined, Varied, all_combinations
from ...scene.names import find
from ...scene.reading import read_beam
from ...scene.refusals import refusal
from ...scene.structs import Scene
from ...scene.wording import key_of
from ..paths.compression import compression_of, pieces_in_sections, refused_cases
from ..result import Result
from ..state.arguments import numbers, scheme
from ..state.fields import find_places
from ..state.schemes import choose_rule, starting_scheme
from ..state.steps import LoadSteps
from .solved_cases import Asked, Cases, case_in_block, cases_of, wanted_names
from .varied import Given, SupportArrays, base_values, cases_in, replace_numbers, vary

FLOAT = np.dtype(float)
STATES = ("at_supports", "extremes", "places", "fields")
"""Values of `Combined`."""


class Prepared(Pickled):
    """A scene ready to be solved for other loads; it can be pickled, for other processes.

    Attributes
    ----------
    scene : Scene
        The scene; its loads are those that the factors belong to, whether dead or live.
    node_x : numpy.ndarray
        Places of the nodes: beam ends, supports, hinges, and on overhangs the places of loads.
    supports : numpy.ndarray of int
        Numbers in the scene of the supports across the beam, the columns of `Cases.reaction`.
    """

    def __init__(self, scene: Scene, beam: Beam, rule: str):
        self.scene = scene
        self._beam = beam
        self._rule = rule
        self.node_x = beam.node_x
        self.supports = read_only(np.flatnonzero(beam.across))
        # Columns of the supports of the engine; None if these are the same, one by one
        self._carries = None if np.array_equal(beam.numbers, self.supports) else np.searchsorted(self.supports, beam.numbers)
        # What its effect on bending is, is left out: cases whose compression is beyond the Euler load are refused
        axial = len(beam.across) - int(beam.across.sum())
        self._may_buckle = (beam.bars >= 0 or axial > 1) and not scene.analysis.first_order
        self._one = self._one_case()

    def __getstate__(self) -> dict[str, Any]:
        """Leave out what is for the short way."""
        return {name: value for name, value in self.__dict__.items() if name not in ("_one", "_support_arrays")}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Take the attributes back."""
        super().__setstate__(state)
        self._one = self._one_case()

    def _one_case(self) -> OneCase | None:
        """Split the loads; and the short way for one case, where there is one."""
        beam = self._beam
        if beam.ground_layers:
            return None
        split_loads(beam)
        short = len(self.scene.loads) > 0 and beam.links + 1 < FEW_NODES
        if not short or beam.has_laws or self._carries is not None or self._may_buckle:
            return None
        return OneCase(beam, self._rule)

    def solve(
        self, factors: ArrayLike | None = None, start: Sequence[bool] | None = None,
        settlements: Mapping[str | int, ArrayLike] | None = None, *,
        gap: Given = None, settlement: Given = None, stiffness: Given = None, EI: Given = None, GA: Given = None, k: Given = None,
        want: str | Collection[str] | None = None, out: Cases | None = None,
    ) -> Cases:  # fmt: skip
        """Solve load cases.

        Parameters
        ----------
        factors : array_like, optional
            Factor of every load of the scene, in its order: one for all cases; or a row for each case. Default: all 1.
        start : sequence of bool, optional
            Where the search for the working scheme starts: True (closed) or False for every support across the beam;
            default all closed. Every case starts from it, so its result does not depend on the other cases.
        settlements : mapping, optional
            Further movement of supports (length, positive downward), by name or number: one for all cases, or an array with
            one for each.
        gap, settlement, stiffness : array_like or mapping, optional
            What supports have instead of the scene's numbers: an array with one for every support, or a row of them for each
            case; or by name or number of some supports one for all cases, or an array with one for each.
        EI, GA : array_like or mapping, optional
            Likewise bending and shear stiffness of the spans (``beam.EI``); sections keep their own.
        k : array_like or mapping, optional
            Likewise the modulus of foundations.
        want : str or collection of str, optional
            Which arrays of `Cases` are made, moment for both moments; status, closed and solves always are. Default: all.
        out : Cases, optional
            Earlier cases of this beam, as many as there are now, to be filled again with what was wanted then, where it can be
            in the same memory: arrays that were taken out of it change. It is what is returned.

        Returns
        -------
        Cases
            A case that has no solution is recorded in `status`, and the others go on; so is one whose axial compression is beyond
            the Euler load (``Status.BAD_INPUT``), unless the scene has ``analysis.first_order = true``.

        Raises
        ------
        ValueError
            Factors of another number than the loads, or that are no finite numbers; another `start`; arrays of another shape; cases
            to be filled again that are not such as these.
        SceneError
            A support, span or foundation that is not there, or a number that it cannot have: names the case and the place.

        Examples
        --------
        >>> import gapbeam
        >>> beam = gapbeam.prepare({
        ...     "beam": {"spans": [2.0, 2.0], "EI": 100.0},
        ...     "supports": [{"node": i, "side": "below"} for i in range(3)],
        ...     "loads": [{"type": "uniform", "q": 1.0}, {"type": "uniform", "q": 1.0, "to": 2.0}],
        ... })
        >>> beam.solve([[1.0, 0.0], [1.0, 10.0]]).reaction.round(3)
        array([[ 0.75,  2.5 ,  0.75],
               [10.  , 14.  ,  0.  ]])
        >>> beam.solve([1.0, 0.0], gap={1: [0.0, 0.01, 0.1]}).reaction.round(3)
        array([[0.75 , 2.5  , 0.75 ],
               [1.125, 1.75 , 1.125],
               [2.   , 0.   , 2.   ]])
        >>> beam.solve([1.0, 1.0], EI=[[100.0, 100.0], [100.0, 400.0]], want="reaction").reaction.round(3)
        array([[1.625, 3.75 , 0.625],
               [1.55 , 3.9  , 0.55 ]])
        """
        one = self._one
        if one is not None and (start is settlements is EI is GA is k is want is None):
            found = self._solve_one(one, factors, settlement, gap, stiffness, out)
            if found is not None:
                return found
        given = {"settlement": settlement, "gap": gap, "stiffness": stiffness, "EI": EI, "GA": GA, "k": k}
        return self._solve_many(self._checked(factors), start, settlements, given, want, out)

    def _solve_one(
        self, one: OneCase, factors: ArrayLike | None, settlement: Given, gap: Given, stiffness: Given, out: Cases | None
    ) -> Cases | None:
        """Solve one case in the short way; None where it is none, or anything is wrong with it, which the other way says."""
        if type(factors) is not np.ndarray or factors.dtype is not FLOAT:
            factors = np.ones(one.shape) if factors is None else numbers("factors", factors)
        supports = None
        if not (settlement is gap is stiffness is None):
            supports = self._support_arrays.take(settlement, gap, stiffness)
            if supports is None:
                return None
        if factors.shape != one.shape or not (out is None or (type(out) is Cases and out._one is one)):
            return None
        block = np.empty(one.size) if out is None else out._block
        return case_in_block(one, block, supports, out) if one.solve(factors, supports, block) else None

    def _solve_many(
        self, factors: np.ndarray, start: Sequence[bool] | None, settlements: Mapping[str | int, ArrayLike] | None,
        given: dict[str, Given], want: str | Collection[str] | None, out: Cases | None,
    ) -> Cases:  # fmt: skip
        """Solve any number of cases, arguments as for `solve`, factors checked."""
        count = len(factors) if factors.ndim == 2 else cases_in({**given, "settlements": settlements})
        # What is asked later is about these
        many = np.array(factors if count is None else np.broadcast_to(factors, (count, factors.shape[-1])), order="C", ndmin=2)
        if start is None:
            closed = self._start
        else:
            closed = scheme(start, len(self.supports), "support across the beam")
            closed = closed if self._carries is None else closed[self._carries]
        varied = self._vary(settlements, given, len(many))
        names = wanted_names(want) if out is None else self._fitting(out, want, count)
        again = states = None
        if self._beam.ground_layers or not (varied.supports is None or self._is_simple):
            found, states = self._solve_again(Asked(self._beam, self._rule, many, closed, varied), names)
        else:
            into = None if out is None else out._take_arrays()
            found = again = solve_cases(self._beam, many, self._rule, closed, varied, names, into)
        asked = Asked(self._beam, self._rule, many, found["closed"], varied, states, closed)
        if self._carries is not None:
            found = self._by_scene(found)
        if self._may_buckle:
            asked, found = self._refuse_buckling(asked, found)
        cases = cases_of({}, None, False) if out is None else out
        cases._fill(found, asked, count is None, again)
        return cases

    def _refuse_buckling(self, asked: Asked, found: dict[str, np.ndarray]) -> tuple[Asked, dict[str, np.ndarray]]:
        """Refuse cases whose compression is beyond the Euler load: their values are not-a-number, and what is asked later too."""
        solved = found["status"] == Status.SOLVED
        if self._beam.ground_layers:
            refused = np.array([bool(solved[k]) and self._buckles(asked, k) for k in range(len(solved))], dtype=bool)
        else:
            sections = pieces_in_sections(self.scene, self._beam)
            refused = solved & refused_cases(self._beam, asked.factors, self._rule, asked.closed, asked.varied, sections)
        if not refused.any():
            return asked, found
        found = {name: values.copy() for name, values in found.items()}
        for name, values in found.items():
            values[refused] = Status.BAD_INPUT if name == "status" else 0 if values.dtype.kind == "i" else np.nan
        factors = asked.factors.copy()
        factors[refused] = np.nan
        states = asked.states
        if states is not None:
            states = replace(
                states, status=np.where(refused, Status.BAD_INPUT, states.status).astype(np.int32),
                **{name: np.where(refused[:, None, None], np.nan, getattr(states, name)) for name in STATES},
            )  # fmt: skip
        return replace(asked, factors=factors, states=states), found

    def _buckles(self, asked: Asked, k: int) -> bool:
        """Whether a case on the ground does."""
        given = asked.varied.supports, asked.varied.spans, asked.varied.moduli
        varied = Varied(*(None if one is None else one[k : k + 1] for one in given))
        found = self._result_of(asked.factors[k], varied).compression
        return found is not None and found.is_refused

    def _fitting(self, out: Cases, want: str | Collection[str] | None, count: int | None) -> tuple[str, ...]:
        """Refuse cases that cannot be filled again with what is wanted; give what that is."""
        if not isinstance(out, Cases):
            raise ValueError(f"out: expected Cases, of this beam, got {type(out).__name__}")
        if out._beam is not self._beam:
            raise ValueError("out: these cases are of another prepared beam; give cases of this one")
        if want is not None and out._names != wanted_names(want):
            wanted = ", ".join(out._names) or "nothing else"
            raise ValueError(f"out: of these cases {wanted} was wanted; want the same, or leave want out")
        shape = () if count is None else (count,)
        if out._shape != shape:
            said = ["one case without an axis of cases" if not one else f"{one[0]} cases" for one in (out._shape, shape)]
            raise ValueError(f"out: these are {said[0]}, and there are {said[1]} to solve; give as many")
        return out._names

    def _vary(
        self, settlements: Mapping[str | int, ArrayLike] | None, given: dict[str, Given], count: int
    ) -> Varied:
        """Numbers that differ from those of the scene, movements of supports among their settlements."""
        varied = vary(self.scene, self._beam.columns, given, count)
        if not isinstance(settlements, Mapping | None):
            raise ValueError(f"settlements: expected a mapping, as {{1: 0.01}} by number or name of a support; got {settlements!r}")
        if not settlements:
            return varied
        moves = self._movements(settlements, count)
        supports = varied.supports
        if supports is None:
            supports = np.broadcast_to(base_values(self._beam.columns), (count, moves.shape[1] + 1, 3))
        supports = supports.copy()
        supports[:, :-1, 0] += moves
        return Varied(supports, varied.spans, varied.moduli)

    @cached_property
    def _start(self) -> np.ndarray:
        """Where searches start if nothing else is said."""
        return read_only(starting_scheme(self._beam))

    @cached_property
    def _is_simple(self) -> bool:
        """Whether supports can get other numbers while the beam stays: no laws, no ground."""
        return not (self._beam.has_laws or self._beam.ground_layers)

    @cached_property
    def _support_arrays(self) -> SupportArrays:
        """What supports may have in the short way."""
        return SupportArrays(self._beam.columns, self._is_simple)

    def _movements(self, settlements: Mapping[str | int, ArrayLike] | None, count: int) -> np.ndarray:
        """Further movements of all supports, cases by supports."""
        moves = np.zeros((count, len(self.scene.supports)))
        for key, given in (settlements or {}).items():
            k = find(self.scene.supports, key, f"settlements.{key_of(key)}", "support")
            values = np.asarray(numbers(f"settlements.{key_of(key)}", given))
            if values.shape not in ((), (count,)) or not np.isfinite(values).all():
                got = f"shape {values.shape}" if values.size > 1 else str(values)
                raise ValueError(f"settlements.{key_of(key)}: expected a finite number, or {count}, one a case; got {got}")
            moves[:, k] += values
        return moves

    def _solve_again(self, asked: Asked, want: tuple[str, ...]) -> tuple[dict[str, np.ndarray], Combined]:
        """Solve cases with other numbers from the scene on, as `solve_cases` gives them, but for reactions; and all else."""
        beam, nodes = self._beam, len(self.node_x)
        sides = [find_places(beam, self.node_x, side) for side in ("left", "right")]
        piece, distance = (np.concatenate(parts) for parts in zip(*sides, strict=True))
        found = all_combinations(beam, asked.factors, None, self._rule, asked.closed, piece, distance, asked.varied)
        left, right = found.fields[:, :nodes, 2].copy(), found.fields[:, nodes:, 2].copy()
        solved = found.status == Status.SOLVED
        left[solved, 0] = right[solved, -1] = 0.0  # beside the beam
        arrays = {
            "deflection": found.fields[:, nodes:, 0].copy(), "moment_left": left, "moment_right": right,
            "reaction": found.at_supports[:, 0][:, self.supports],
        }  # fmt: skip
        arrays = {name: arrays[name] for name in want}
        arrays |= {"closed": found.closed.copy(), "solves": found.solves.copy(), "status": found.status.copy()}
        return arrays, replace(found, fields=found.fields[:, :0].copy())

    def _by_scene(self, found: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
        """The same with columns for the supports of the scene across the beam."""
        columns, status = self._carries, found["status"]
        closed = self._by_supports(found["closed"], columns, np.zeros(len(status), dtype=np.int32))
        for k in self._beam.laws if self._beam.has_laws else ():
            closed[:, np.searchsorted(self.supports, k)] = self._acts(k, closed[:, np.searchsorted(self.supports, k)])
        found = {**found, "closed": closed}
        if "reaction" in found and found["reaction"].shape[1] != len(self.supports):
            idle = np.where(status == Status.SOLVED, 0.0, np.nan)
            found["reaction"] = self._by_supports(found["reaction"], columns, idle)
        return found

    def _by_supports(self, values: np.ndarray, carries: np.ndarray, idle: np.ndarray) -> np.ndarray:
        """Add up the columns of the kinks of laws, and add those of supports that can carry nothing."""
        columns = np.repeat(idle[:, None], len(self.supports), axis=1)
        columns[:, carries] = 0
        np.add.at(columns, (slice(None), carries), values)
        return columns

    def _acts(self, support: int, kinks: np.ndarray) -> np.ndarray:
        """Whether a support with a law acts, from the number of closed kinks."""
        _, middle, at_middle = self._beam.laws[support]
        return (np.abs(kinks - middle) + at_middle > 0).astype(np.int32)

    def _checked(self, factors: ArrayLike | None) -> np.ndarray:
        count = len(self.scene.loads)
        factors = np.ones(count) if factors is None else numbers("factors", factors)
        if factors.ndim not in (1, 2) or factors.shape[-1] != count:
            raise ValueError(f"factors: expected {count} numbers a case, one for each load, got shape {factors.shape}")
        # A sum leaves the range before the factors do, and costs less than asking each
        with np.errstate(over="ignore", invalid="ignore"):
            total = np.add.reduce(factors, None)
        if not isfinite(total) and not np.isfinite(factors).all():
            at = np.argwhere(~np.isfinite(factors))[0]
            case = f"case {at[0]}, " if len(at) == 2 else ""
            raise ValueError(f"factors: {case}the factor of load {at[-1]} is {factors[tuple(at)]}; give a finite number")
        return factors

    def result(
        self, factors: ArrayLike | None = None, settlements: Mapping[str | int, ArrayLike] | None = None, *,
        gap: Given = None, settlement: Given = None, stiffness: Given = None, EI: Given = None, GA: Given = None, k: Given = None,
    ) -> Result:  # fmt: skip
        """Solve one case with all that `gapbeam.solve` gives: fields, extremes, certificate, report.

        Parameters
        ----------
        factors : array_like, optional
            Factor of every load of the scene; default all 1.
        settlements : mapping, optional
            As for `solve`, numbers only.
        gap, settlement, stiffness, EI, GA, k : array_like or mapping, optional
            As for `solve`, of one case.

        Returns
        -------
        Result
            One step at load factor 1 with the loads of the case.

        Raises
        ------
        ValueError
            As for `solve`.
        SceneError
            Its axial compression is beyond the Euler load.
        EngineError
            No unique answer exists.
        """
        factors = self._checked(factors)
        given = {"settlement": settlement, "gap": gap, "stiffness": stiffness, "EI": EI, "GA": GA, "k": k}
        if factors.ndim != 1 or cases_in({**given, "settlements": settlements}) is not None:
            raise ValueError(f"{'factors' if factors.ndim != 1 else 'numbers by case'}: expected one case")
        result = self._result_of(factors, self._vary(settlements, given, 1))
        if self._may_buckle and result.compression is not None and result.compression.is_refused:
            raise result.compression.refusal()
        return result

    def _result_of(self, factors: np.ndarray, varied: Varied) -> Result:
        """Solve one case with all that there is to say of it, whether the beam would buckle or not."""
        base, scene = self._beam, self.scene
        if not varied.is_nothing:
            scene, columns = replace_numbers(scene, base.columns, varied)
            try:
                base = Beam(columns)
            except RefusalError as refused:
                raise refusal(scene, *refused.codes) from None
        beam = base.with_factors(factors)
        result = Result(scene, beam, self._rule)
        result.steps = LoadSteps(beam, self._rule, starting_scheme(beam), 1)
        fallen = result.steps.solve_all()
        if fallen is not None:
            result.refuse("in this load case", fallen[1])
        for step in result.steps:
            result.compression = compression_of(result, step)
        return result


def prepare(source: Scene | Mapping[str, Any] | str | os.PathLike, *, rule: str | None = None) -> Prepared:
    """Prepare a scene to be solved for many load cases.

    Parameters
    ----------
    source : Scene, mapping, str or path
        As for `gapbeam.solve`.
    rule : {"block", "single"}, optional
        How working schemes are found, instead of the scene's own ``analysis.rule``.

    Returns
    -------
    Prepared
        The scene with its loads condensed one by one.

    Raises
    ------
    SceneError
        The scene is not valid, or has combinations or trains; or the state of a support depends on the way of the load to it, or
        its law is a curve, so that each case is more than one solve.
    """
    scene, beam = read_beam(source)
    if scene.combinations:
        raise SceneError("combinations", "cases are prepared for factors of every load, which the caller gives; leave combinations "
                         "out, or use gapbeam.solve, which solves all of them")  # fmt: skip
    if scene.trains:
        raise SceneError("trains", "cases are prepared for loads that stay where they are; leave trains out, or use gapbeam.solve, "
                         "which moves them")  # fmt: skip
    if beam.depends_on_path or beam.curves:
        what = "its state depends on the way of the load" if beam.depends_on_path else "one of them is a curve"
        raise SceneError("supports", f"cases cannot be prepared with these laws, as {what}; use gapbeam.solve for each case")
    return Prepared(scene, beam, choose_rule(scene, rule))
