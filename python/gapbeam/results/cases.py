"""A beam prepared once and solved for many load cases: every load of the scene times a factor of its own.

Reading and condensing a scene costs far more than solving it. A prepared scene keeps what each load does to the
beam, so a case is one call of the engine, and a million cases are one call as well.
"""

from __future__ import annotations

import os
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import isfinite
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..base.errors import SceneError, Status
from ..base.records import Pickled, Record, read_only
from ..engine.beam import FIELDS, Beam, RefusalError
from ..engine.case_extremes import case_extremes
from ..engine.combinations import Combined, all_combinations
from ..scene.names import find
from ..scene.reading import read_beam
from ..scene.refusals import refusal
from ..scene.structs import Scene
from ..scene.wording import key_of
from .arguments import numbers, scheme
from .following import choose_rule, starting_scheme
from .result import Fields, Result, find_places
from .steps import LoadSteps
from .varied import Given, base_values, cases_in, replace_supports, vary_supports


@dataclass(frozen=True, slots=True, eq=False)
class Asked(Record):
    """What was asked for, so that more can be asked.

    Attributes
    ----------
    beam : Beam
        The prepared beam.
    rule : str
        How working schemes are found.
    factors : numpy.ndarray
        Cases by loads.
    closed : numpy.ndarray of int
        Working schemes that were found, or where the searches start: cases by supports of the engine.
    supports : numpy.ndarray or None
        Settlement, gap and stiffness of the supports where they differ from those of the scene, settlements included.
    """

    beam: Beam
    rule: str
    factors: np.ndarray
    closed: np.ndarray
    supports: np.ndarray | None = None

    def solve(self, x: np.ndarray | None = None, side: str = "right") -> Combined:
        """Solve all cases.

        Parameters
        ----------
        x : numpy.ndarray, optional
            Places at which fields are wanted.
        side : {"right", "left"}
            Which value is taken where a field jumps.

        Returns
        -------
        Combined
        """
        where = (None, None) if x is None else find_places(self.beam, x, side)
        return all_combinations(self.beam, self.factors, None, self.rule, self.closed, *where, self.supports)


@dataclass(frozen=True, slots=True, eq=False)
class Cases(Record):
    """Solutions of load cases; arrays have one row a case, or no such axis after `Prepared.solve` with one case.

    The arrays are read-only. Two are equal if all their arrays are, but for `solves`.

    Attributes
    ----------
    status : numpy.ndarray of int
        0 solved, 1 no equilibrium, above 10 another reason why there is no unique answer; `Prepared.result` of that case
        says it in words. Values of a case that is not solved are not-a-number.
    closed : numpy.ndarray of int
        1 where a support across the beam acts, 0 where it is open or the case is not solved; in the order of the scene.
    reaction : numpy.ndarray
        Reaction of every support across the beam, positive upward.
    deflection : numpy.ndarray
        At every node (`Prepared.node_x`), positive downward.
    moment_left, moment_right : numpy.ndarray
        Left and right of every node, sagging positive.
    solves : numpy.ndarray of int
        Linear solves.
    """

    status: np.ndarray
    closed: np.ndarray
    reaction: np.ndarray
    deflection: np.ndarray
    moment_left: np.ndarray
    moment_right: np.ndarray
    solves: np.ndarray = field(compare=False)
    _asked: Asked | None = field(default=None, compare=False, repr=False)

    def at(self, x: ArrayLike, side: str = "right") -> Fields:
        """Exact values anywhere along the beam, of all cases in few calls of the engine.

        Parameters
        ----------
        x : float or array_like
            Places along the beam.
        side : {"right", "left"}
            Which value is taken where a field jumps.

        Returns
        -------
        Fields
            Of every case a row of the shape of `x` (of one case that shape alone); not-a-number where it is not solved.

        Raises
        ------
        ValueError
            A place outside the beam, or something else than numbers; another side.

        Examples
        --------
        >>> import gapbeam
        >>> beam = gapbeam.prepare({"beam": {"spans": [4.0], "EI": 1.0}, "supports": [{"node": 0}, {"node": 1}],
        ...                         "loads": [{"type": "uniform", "q": 1.0}]})
        >>> beam.solve([[1.0], [3.0]]).at([1.0, 2.0]).moment
        array([[1.5, 2. ],
               [4.5, 6. ]])
        """
        places = np.array(numbers("x", x))
        found = self._asked.solve(places.ravel(), side)
        shape = self.status.shape + places.shape
        of = self._asked.beam.fields
        return Fields(places, **{name: found.fields[:, :, column].reshape(shape).copy() for name, column in of.items()})

    def states(self) -> Combined:
        """Values at all supports and extremes of all fields, of all cases in few calls of the engine.

        Returns
        -------
        Combined
            As arrays, cases along their first axis.
        """
        return self._asked.solve()

    def extremes(self) -> dict[str, dict[str, tuple[np.ndarray, np.ndarray]]]:
        """Exact largest and smallest values of every field with their places, of all cases in few calls of the engine.

        Returns
        -------
        dict
            ``{"moment": {"max": (values, x), "min": (values, x)}, ...}``, arrays with an entry for every case.
        """
        return self.extremes_of(self._asked.beam.fields)

    def extremes_of(self, names: Collection[str]) -> dict[str, dict[str, tuple[np.ndarray, np.ndarray]]]:
        """Find those of some fields, each of which takes time of its own.

        Parameters
        ----------
        names : collection of str
            Of the fields.

        Returns
        -------
        dict
            As of `extremes`.
        """
        asked, shape = self._asked, self.status.shape
        nodes = tuple(np.atleast_2d(one) for one in (self.deflection, self.moment_left, self.moment_right))
        there = case_extremes(
            asked.beam, asked.rule, asked.factors, asked.supports, asked.closed, np.atleast_1d(self.status), nodes, names
        )  # fmt: skip
        if there is None:
            states = self.states()
            there = {name: (states.extremes[:, FIELDS.index(name)], states.places[:, FIELDS.index(name)]) for name in names}
        return {
            name: {kind: (values[:, row].reshape(shape), x[:, row].reshape(shape)) for row, kind in enumerate(("max", "min"))}
            for name, (values, x) in there.items()
        }


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
        beam.split_loads()

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Take the attributes back."""
        super().__setstate__(state)
        self._beam.split_loads()

    def solve(
        self, factors: ArrayLike | None = None, start: Sequence[bool] | None = None,
        settlements: Mapping[str | int, ArrayLike] | None = None, *,
        gap: Given = None, settlement: Given = None, stiffness: Given = None,
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

        Returns
        -------
        Cases
            A case that has no solution is recorded in `status`, and the others go on.

        Raises
        ------
        ValueError
            Factors of another number than the loads, or that are no finite numbers; another `start`; arrays of another shape.
        SceneError
            A support that is not there, or a number that a support cannot have: names the case and the support.

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
        """
        factors = self._checked(factors)
        varied = not (settlements is None is settlement and gap is None is stiffness)
        given = {"settlement": settlement, "gap": gap, "stiffness": stiffness} if varied else {}
        count = len(factors) if factors.ndim == 2 else cases_in(given)
        # What is asked later is about these
        many = np.array(factors, ndmin=2) if count is None else np.array(np.broadcast_to(factors, (count, factors.shape[-1])))
        if start is None:
            closed = self._start
        else:
            closed = scheme(start, len(self.supports), "support across the beam")
            closed = closed if self._carries is None else closed[self._carries]
        supports = self._vary(settlements, given, len(many)) if varied else None
        if supports is None or self._is_simple:
            found = self._beam.solve_cases(many, self._rule, closed, supports)
        else:
            found = self._solve_again(Asked(self._beam, self._rule, many, closed, supports))
        w, left, right, reaction, closed, solves, status = found
        asked = Asked(self._beam, self._rule, many, closed, supports)
        if self._carries is not None:
            closed = self._by_supports(closed, self._carries, np.zeros(len(many), dtype=np.int32))
            if reaction.shape[1] != len(self.supports):
                reaction = self._by_supports(reaction, self._carries, np.where(status == Status.SOLVED, 0.0, np.nan))
            for k in self._beam.laws if self._beam.has_laws else ():
                closed[:, np.searchsorted(self.supports, k)] = self._acts(k, closed[:, np.searchsorted(self.supports, k)])
        if count is None:
            return Cases(status[0], closed[0], reaction[0], w[0], left[0], right[0], solves[0], asked)
        return Cases(status, closed, reaction, w, left, right, solves, asked)

    def _vary(
        self, settlements: Mapping[str | int, ArrayLike] | None, given: dict[str, Given], count: int
    ) -> np.ndarray | None:
        """Settlement, gap and stiffness of all supports in all cases; None if they are those of the scene."""
        supports = vary_supports(self.scene, self._beam.columns, given, count)
        moves = self._movements(settlements, count)
        if moves.any():
            if supports is None:
                supports = np.broadcast_to(base_values(self._beam.columns), (count, moves.shape[1] + 1, 3)).copy()
            supports[:, :-1, 0] += moves
        return supports

    @cached_property
    def _start(self) -> np.ndarray:
        """Where searches start if nothing else is said."""
        return read_only(starting_scheme(self._beam))

    @cached_property
    def _is_simple(self) -> bool:
        """Whether supports can get other numbers without being looked at together: no laws, no ground, one at a place."""
        nodes = self._beam.places.support_nodes
        return not (self._beam.has_laws or self._beam.ground_layers) and len(np.unique(nodes)) == len(nodes)

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

    def _solve_again(self, asked: Asked) -> tuple[np.ndarray, ...]:
        """Solve cases with other supports from the scene on, as `Beam.solve_cases` gives them, but for reactions."""
        beam, nodes = self._beam, len(self.node_x)
        sides = [find_places(beam, self.node_x, side) for side in ("left", "right")]
        piece, distance = (np.concatenate(parts) for parts in zip(*sides, strict=True))
        found = all_combinations(beam, asked.factors, None, self._rule, asked.closed, piece, distance, asked.supports)
        w, left, right = found.fields[:, nodes:, 0], found.fields[:, :nodes, 2].copy(), found.fields[:, nodes:, 2].copy()
        solved = found.status == Status.SOLVED
        left[solved, 0] = right[solved, -1] = 0.0  # beside the beam
        reaction = found.at_supports[:, 0][:, self.supports]
        return w, left, right, reaction, found.closed.copy(), found.solves, found.status

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
            raise ValueError(f"factors: the factor of load {at[-1]} is {factors[tuple(at)]}; give a finite number")
        return factors

    def result(
        self, factors: ArrayLike | None = None, settlements: Mapping[str | int, ArrayLike] | None = None, *,
        gap: Given = None, settlement: Given = None, stiffness: Given = None,
    ) -> Result:  # fmt: skip
        """Solve one case with all that `gapbeam.solve` gives: fields, extremes, certificate, report.

        Parameters
        ----------
        factors : array_like, optional
            Factor of every load of the scene; default all 1.
        settlements : mapping, optional
            As for `solve`, numbers only.
        gap, settlement, stiffness : array_like or mapping, optional
            As for `solve`, of one case.

        Returns
        -------
        Result
            One step at load factor 1 with the loads of the case.

        Raises
        ------
        ValueError
            As for `solve`.
        EngineError
            No unique answer exists.
        """
        factors = self._checked(factors)
        given = {"settlement": settlement, "gap": gap, "stiffness": stiffness}
        if factors.ndim != 1 or cases_in(given) is not None:
            raise ValueError(f"{'factors' if factors.ndim != 1 else 'supports'}: expected one case")
        base, scene = self._beam, self.scene
        supports = self._vary(settlements, given, 1)
        if supports is not None:
            scene, columns = replace_supports(scene, base.columns, supports[0])
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
        The scene is not valid; or the state of a support depends on the way of the load to it, or its law is a curve, so that
        each case is more than one solve.
    """
    scene, beam = read_beam(source)
    if scene.combinations:
        raise SceneError("combinations", "cases are prepared for factors of every load, which the caller gives; leave combinations "
                         "out, or use gapbeam.solve, which solves all of them")  # fmt: skip
    if beam.depends_on_path or beam.curves:
        what = "its state depends on the way of the load" if beam.depends_on_path else "one of them is a curve"
        raise SceneError("supports", f"cases cannot be prepared with these laws, as {what}; use gapbeam.solve for each case")
    return Prepared(scene, beam, choose_rule(scene, rule))
