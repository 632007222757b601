"""A beam prepared once and solved for many load cases: every load of the scene times a factor of its own.

Reading and condensing a scene costs far more than solving it. A prepared scene keeps what each load does to the
beam, so a case is one call of the engine, and a million cases are one call as well.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import isfinite
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..base.errors import Status
from ..base.records import Pickled, Record, read_only
from ..engine import engine
from ..engine.lowering import Arrays, LoadRows, lower_by_load
from ..engine.units import scaled
from ..scene.structs import Scene, read_scene
from .arguments import numbers, scheme
from .result import Result
from .stepping import choose_rule
from .steps import LoadSteps


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

    def __init__(self, scene: Scene, rule: str):
        self.scene = scene
        self._arrays, self._rows = lower_by_load(scene)
        self.node_x = self._arrays.node_x
        self.supports = read_only(np.flatnonzero(self._arrays.across))
        self._links = engine.condense(self._arrays)
        self._rule = rule
        self._call = engine.prepare_cases(self._arrays, self._links, *self._sorted_rows(self._arrays, self._rows))

    def _sorted_rows(self, arrays: Arrays, rows: LoadRows) -> tuple[np.ndarray, ...]:
        """Loads on pieces with those at points inside links, by load and piece; loads at nodes."""
        node_of_point = np.full(len(arrays.point_span), -1)
        node_of_point[arrays.node_points] = np.arange(len(arrays.node_points))
        at_node = node_of_point[rows.point] >= 0
        inside = ~at_node
        load = np.concatenate((rows.piece_load, rows.point_load[inside]))
        piece = np.concatenate((rows.piece, rows.point[inside] - 1))
        values = np.zeros((len(load), 5))
        values[: len(rows.piece), :3] = rows.piece_values
        values[len(rows.piece) :, 3:] = rows.point_values[inside]
        order = np.lexsort((piece, load))
        return (
            load[order],
            piece[order],
            values[order],
            rows.point_load[at_node],
            node_of_point[rows.point[at_node]],
            rows.point_values[at_node],
        )

    def solve(self, factors: ArrayLike | None = None, start: Sequence[bool] | None = None) -> Cases:
        """Solve load cases.

        Parameters
        ----------
        factors : array_like, optional
            Factor of every load of the scene, in its order: one case; or a row for each case. Default: all 1.
        start : sequence of bool, optional
            Where the search for the working scheme starts: True (closed) or False for every support across the beam;
            default all closed. Every case starts from it, so its result does not depend on the other cases.

        Returns
        -------
        Cases
            A case that has no solution is recorded in `status`, and the others go on.

        Raises
        ------
        ValueError
            Factors of another number than the loads, or that are no finite numbers; or another `start`.

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
        """
        factors = self._checked(factors)
        many = factors if factors.ndim == 2 else factors[None]
        arrays, units = self._arrays, self._arrays.units
        carries = np.searchsorted(self.supports, arrays.supports)
        closed = np.ones((len(many), max(len(carries), 1)), dtype=np.int32)
        if start is not None:
            closed[:, : len(carries)] = scheme(start, len(self.supports), "support across the beam")[carries]
        w, left, right, _, reaction, solves, status = self._call(many, engine.RULES[self._rule], closed)
        w, reaction = scaled(w, units.deflection), scaled(reaction, units.force)
        left, right = scaled(left, units.moment), scaled(right, units.moment)
        closed, reaction = closed[:, : len(carries)], reaction[:, : len(carries)]
        lost = status == Status.SOLVED
        lost &= ~np.all([np.isfinite(values).all(axis=1) for values in (w, left, right, reaction)], axis=0)
        if lost.any():
            status[lost], closed[lost] = Status.NOT_FINITE, 0
            for values in (w, left, right, reaction):
                values[lost] = np.nan
        if len(carries) < len(self.supports):
            closed = self._with_idle(closed, carries, np.zeros(len(many), dtype=np.int32))
            reaction = self._with_idle(reaction, carries, np.where(status == Status.SOLVED, 0.0, np.nan))
        if factors.ndim == 2:
            return Cases(status, closed, reaction, w, left, right, solves)
        return Cases(status[0], closed[0], reaction[0], w[0], left[0], right[0], solves[0])

    def _with_idle(self, values: np.ndarray, carries: np.ndarray, idle: np.ndarray) -> np.ndarray:
        """Add the columns of supports that can carry nothing."""
        columns = np.repeat(idle[:, None], len(self.supports), axis=1)
        columns[:, carries] = values
        return columns

    def _checked(self, factors: ArrayLike | None) -> np.ndarray:
        count = len(self.scene.loads)
        factors = np.ones(count) if factors is None else numbers("factors", factors)
        if factors.ndim not in (1, 2) or factors.shape[-1] != count:
            raise ValueError(f"factors: expected {count} numbers a case, one for each load, got shape {factors.shape}")
        # Squares leave the range before the factors do, and cost less than asking each
        if not isfinite(np.vdot(factors, factors)) and not np.isfinite(factors).all():
            at = np.argwhere(~np.isfinite(factors))[0]
            raise ValueError(f"factors: the factor of load {at[-1]} is {factors[tuple(at)]}; give a finite number")
        return factors

    def result(self, factors: ArrayLike | None = None) -> Result:
        """Solve one case with all that `gapbeam.solve` gives: fields, extremes, certificate, report.

        Parameters
        ----------
        factors : array_like, optional
            Factor of every load of the scene; default all 1.

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
        if factors.ndim != 1:
            raise ValueError("factors: expected one case")
        arrays = self._with_loads(factors)
        links = engine.condense(arrays)
        result = Result(self.scene, arrays, links, self._rule)
        result.steps = LoadSteps(arrays, links, self._rule, np.ones(len(arrays.supports), dtype=np.int32), 1)
        fallen = result.steps.solve_all()
        if fallen is not None:
            result.refuse("in this load case", fallen[1])
        return result

    def _with_loads(self, factors: np.ndarray) -> Arrays:
        """Arrays in which the loads of a case are live, and nothing is dead."""
        arrays = self._arrays
        is_node = np.zeros(len(arrays.point_span), dtype=bool)
        is_node[arrays.node_points] = True
        live, at_nodes = self._rows.spread(factors, is_node)
        nothing = np.zeros(len(at_nodes))
        axial = arrays.axial
        if axial is not None:
            pulls = axial.with_factors(factors)
            axial = replace(axial, force=np.stack((np.zeros_like(pulls), pulls)))
        return replace(
            arrays,
            dead=np.zeros_like(arrays.dead),
            live=live,
            force=np.stack((nothing, at_nodes[:, 0]), axis=1),
            couple=np.stack((nothing, at_nodes[:, 1]), axis=1),
            axial=axial,
        )


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
        The scene is not valid.
    """
    scene = read_scene(source)
    return Prepared(scene, choose_rule(scene, rule))
