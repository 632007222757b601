"""A beam prepared once and solved for many load cases: every load of the scene times a factor of its own.

Reading and condensing a scene costs far more than solving it. A prepared scene keeps what each load does to the
beam, so a case is one call of the engine, and a million cases are one call as well.
"""

from __future__ import annotations

import os
import warnings
from collections.abc import Collection, Mapping, Sequence
from functools import cached_property
from math import inf, isfinite
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...base.errors import SceneError
from ...base.hints import few, nearest
from ...base.records import Pickled
from ...engine.arrays import Columns
from ...engine.beam import Beam
from ...engine.cases import OneCase
from ...engine.combinations import Varied
from ...scene.columns import columns
from ...scene.movements import replace_settlements, take_movements
from ...scene.names import cases_of, find
from ...scene.reading import prepared_beam, read_beam
from ...scene.structs import Scene
from ...scene.wording import choice, key_of, shown
from ..formatting import count, title
from ..result import Result
from ..state.arguments import numbers, scheme
from ..state.schemes import choose_rule
from .solved_cases import Cases, case_in_block, wanted_names
from .solver import CaseSolver, solver_of
from .varied import Given, SupportArrays, cases_in, vary

FLOAT = np.dtype(float)
VARIED = ("gap", "settlement", "stiffness", "EI", "GA", "k")
"""What may be given instead of the scene's numbers."""


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

    def __init__(self, solver: CaseSolver):
        self._solver = solver
        self.scene, self.supports = solver.scene, solver.supports
        self.node_x = solver.beam.node_x

    def __repr__(self) -> str:
        """Say what it is, and what to do with it."""
        scene = self.scene
        parts = [count(len(items), noun) for items, noun in
                 ((scene.beam.spans, "span"), (scene.supports, "support"), (scene.loads, "load")) if len(items)]  # fmt: skip
        return f"Prepared({title(scene)}: {', '.join(parts)}); solve(factors) takes a factor for every load, or a row for each case"

    def solve(
        self, factors: ArrayLike | None = None, start: Sequence[bool] | None = None,
        extra_settlement: Mapping[str | int, ArrayLike] | None = None, *,
        gap: Given = None, settlement: Given = None, stiffness: Given = None, EI: Given = None, GA: Given = None, k: Given = None,
        want: str | Collection[str] | None = None, out: Cases | None = None, **others: Any,
    ) -> Cases:  # fmt: skip
        """Solve load cases.

        Parameters
        ----------
        factors : array_like, optional
            Factor of every load of the scene, in its order: one for all cases; or a row for each case. Default: all 1.
        start : sequence of bool, optional
            Where the search for the contact state starts: True (closed) or False for every support across the beam;
            default all closed. Every case starts from it, so its result does not depend on the other cases.
        extra_settlement : mapping, optional
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
        if others:
            extra_settlement = _old_name(others, extra_settlement)
        one = self._solver.one
        if one is not None and (start is extra_settlement is EI is GA is k is want is None):
            found = self._solve_one(one, factors, settlement, gap, stiffness, out)
            if found is not None:
                return found
        given = {"settlement": settlement, "gap": gap, "stiffness": stiffness, "EI": EI, "GA": GA, "k": k}
        factors = self._checked(factors)
        count = len(factors) if factors.ndim == 2 else cases_in({**given, "extra_settlement": extra_settlement})
        # What is asked later is about these
        many = np.array(factors if count is None else np.broadcast_to(factors, (count, factors.shape[-1])), order="C", ndmin=2)
        closed = self._solver.start
        if start is not None:
            closed = self._solver.starting(scheme(start, len(self.supports), "support across the beam"))
        varied = self._vary(extra_settlement, given, many)
        solver = self._solver.along(varied)
        names = wanted_names(want) if out is None else self._fitting(solver.beam, out, want, count)
        return solver.solve(many, closed, varied, names, single=count is None, out=out)

    def _solve_one(
        self, one: OneCase, factors: ArrayLike | None, settlement: Given, gap: Given, stiffness: Given, out: Cases | None
    ) -> Cases | None:
        """Solve one case in the short way; None where it is none, or anything is wrong with it, which the other way says."""
        if type(factors) is not np.ndarray or factors.dtype is not FLOAT:
            if isinstance(factors, Mapping):
                return None
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

    def _fitting(self, beam: Beam, out: Cases, want: str | Collection[str] | None, count: int | None) -> tuple[str, ...]:
        """Refuse cases that cannot be filled again with what is wanted; give what that is."""
        if not isinstance(out, Cases):
            raise ValueError(f"out: expected Cases, of this beam, got {type(out).__name__}")
        if out._beam is not beam:
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
        self, extra_settlement: Mapping[str | int, ArrayLike] | None, given: dict[str, Given], factors: np.ndarray
    ) -> Varied:
        """Numbers that differ from those of the scene, movements of supports among their settlements."""
        varied = vary(self.scene, self._solver.columns, given, len(factors))
        if not isinstance(extra_settlement, Mapping | None):
            raise ValueError("extra_settlement: expected a mapping, as {1: 0.01} by number or name of a support; got "
                             f"{shown(extra_settlement)}; an array for all supports, instead of the scene's, is settlement = [...]")
        if extra_settlement:
            varied = self._solver.settle(varied, self._movements(extra_settlement, len(factors)))
        return self._solver.moved(factors, varied)

    @cached_property
    def _support_arrays(self) -> SupportArrays:
        """What supports may have in the short way."""
        return SupportArrays(self._solver.columns)

    def _movements(self, extra_settlement: Mapping[str | int, ArrayLike] | None, count: int) -> np.ndarray:
        """Further movements of all supports, cases by supports."""
        moves = np.zeros((count, len(self.scene.supports)))
        for key, given in (extra_settlement or {}).items():
            k = find(self.scene.supports, key, f"extra_settlement.{key_of(key)}", "support")
            values = np.asarray(numbers(f"extra_settlement.{key_of(key)}", given))
            if values.shape not in ((), (count,)) or not np.isfinite(values).all():
                got = f"shape {values.shape}" if values.size > 1 else str(values)
                raise ValueError(f"extra_settlement.{key_of(key)}: expected a finite number, or {count}, one a case; got {got}")
            moves[:, k] += values
        return moves

    @property
    def _loads(self) -> str:
        """Name the loads that factors are for, in their order."""
        cases = few(map(shown, cases_of(self.scene.loads)))
        return f"; the loads are, by case, {cases}" if cases else "; the scene has no loads"

    def _checked(self, factors: ArrayLike | None) -> np.ndarray:
        count = len(self.scene.loads)
        if isinstance(factors, Mapping):
            raise ValueError(f"factors: expected a list of {count} numbers, one for each load, got a table{self._loads}")
        factors = np.ones(count) if factors is None else numbers("factors", factors)
        if factors.ndim not in (1, 2) or factors.shape[-1] != count:
            raise ValueError(f"factors: expected {count} numbers a case, one for each load, got shape {factors.shape}{self._loads}")
        # A sum leaves the range before the factors do, and costs less than asking each
        with np.errstate(over="ignore", invalid="ignore"):
            total = np.add.reduce(factors, None)
        if not isfinite(total) and not np.isfinite(factors).all():
            at = np.argwhere(~np.isfinite(factors))[0]
            case = f"case {at[0]}, " if len(at) == 2 else ""
            raise ValueError(f"factors: {case}the factor of load {at[-1]} is {factors[tuple(at)]}; give a finite number")
        return factors

    def result(
        self, factors: ArrayLike | None = None, extra_settlement: Mapping[str | int, ArrayLike] | None = None, *,
        gap: Given = None, settlement: Given = None, stiffness: Given = None, EI: Given = None, GA: Given = None, k: Given = None,
        **others: Any,
    ) -> Result:  # fmt: skip
        """Solve one case with all that `gapbeam.solve` gives: fields, extremes, certificate, report.

        Parameters
        ----------
        factors : array_like, optional
            Factor of every load of the scene; default all 1.
        extra_settlement : mapping, optional
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
        if others:
            extra_settlement = _old_name(others, extra_settlement)
        factors = self._checked(factors)
        given = {"settlement": settlement, "gap": gap, "stiffness": stiffness, "EI": EI, "GA": GA, "k": k}
        if factors.ndim != 1 or cases_in({**given, "extra_settlement": extra_settlement}) is not None:
            raise ValueError(f"{'factors' if factors.ndim != 1 else 'numbers by case'}: expected one case")
        varied = self._vary(extra_settlement, given, factors[None, :])
        solver = self._solver.along(varied)
        result = solver.result(factors, varied)
        if solver.may_buckle and result.compression is not None and result.compression.is_refused:
            raise result.compression.refusal()
        return result


def _old_name(others: dict[str, Any], given: Mapping[str | int, ArrayLike] | None) -> Mapping[str | int, ArrayLike] | None:
    """Take further movements of supports by the name that they had; refuse any other name."""
    for name, values in others.items():
        if name == "settlements" and given is None:
            warnings.warn("settlements of cases are called extra_settlement", DeprecationWarning, stacklevel=3)
            given = values
            continue
        meant = nearest(name, (*VARIED, "factors", "extra_settlement", "start", "want", "out"))
        hint = f"did you mean {meant}?" if meant else f"there are {choice(VARIED, 'and')}"
        raise TypeError(f"solve has no {name!r}; {hint}")
    return given


def prepare(source: Scene | Mapping[str, Any] | str | os.PathLike, *, rule: str | None = None) -> Prepared:
    """Prepare a scene to be solved for many load cases.

    Parameters
    ----------
    source : Scene, mapping, str or path
        As for `gapbeam.solve`.
    rule : {"block", "single"}, optional
        How contact states are found, instead of the scene's own ``analysis.rule``.

    Returns
    -------
    Prepared
        The scene with its loads condensed one by one.

    Raises
    ------
    SceneError
        The scene is not valid, or has combinations or trains.
    """
    return Prepared(prepared_solver(source, rule))


def prepared_solver(source: Scene | Mapping[str, Any] | str | os.PathLike, rule: str | None = None) -> CaseSolver:
    """Prepare a scene for cases whose numbers are checked.

    Parameters
    ----------
    source, rule
        As for `prepare`.

    Raises
    ------
    SceneError
        As for `prepare`.
    """
    scene, beam = read_beam(source)
    if scene.combinations:
        raise SceneError("combinations", "cases are prepared for factors of every load, which the caller gives; leave combinations "
                         "out, or use gapbeam.solve, which solves all of them")  # fmt: skip
    if scene.trains:
        raise SceneError("trains", "cases are prepared for loads that stay where they are; leave trains out, or use gapbeam.solve, "
                         "which moves them")  # fmt: skip
    taken, (without, movements) = beam.columns, take_movements(scene)
    if movements is not None:
        unmoved, taken = _unmoved(scene, without)
        if unmoved.depends_on_path or unmoved.has_links_along:  # supports move as the loads grow, but with dead ones from the start
            without, movements = take_movements(scene, only_dead=True)
            unmoved, taken = (beam, beam.columns) if movements is None else _unmoved(scene, without)
        scene, beam = without, unmoved
    return solver_of(scene, beam, choose_rule(scene, rule), movements, taken)


def _unmoved(scene: Scene, without: Scene) -> tuple[Beam, Columns]:
    """Make the beam of a scene whose supports no load moves, and the numbers that cases begin with."""
    try:
        beam = prepared_beam(without)
    except SceneError:
        dead = take_movements(scene, only_dead=True)[1]
        if dead is None or any(one.k == inf for one in scene.foundation):  # whether rigid ground leaves room is not asked in cases
            raise
        # They part supports that leave no room without them: the beam has them, and every case its own instead
        moves = np.zeros((1, len(scene.supports)))
        dead.add_to(moves, np.ones((1, len(scene.loads))))
        return prepared_beam(replace_settlements(without, moves[0])), columns(without)
    return beam, beam.columns
