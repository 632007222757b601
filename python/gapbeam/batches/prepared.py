"""Cases solved together on a prepared beam: columns are loads, factors, numbers of supports, stiffnesses, moduli."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..base.errors import SceneError, Status
from ..engine.combinations import Varied, all_combinations
from ..engine.quantities import BENDING, FIELDS
from ..results.cases.cases import prepared_solver
from ..results.cases.solved_cases import Cases, wanted_names
from ..results.cases.varied import OF_SPANS, OF_SUPPORTS, base_values
from ..results.envelopes.envelope import AT_SUPPORTS
from ..results.views.extreme import KINDS
from ..scene.combinations import plan_combinations
from ..scene.names import DEAD
from ..scene.reading import read_scene
from .load_steps import at_once, is_held, shares_before
from .paths import with_values
from .scene_cases import ERRORS, SceneCases

if TYPE_CHECKING:
    from .job import Job

ROWS = {"reaction": 0, "opening": 2, "couple": 3}
"""Values at supports, as `Cases.states` has them."""
KNOWN = {"input", "reaction", "opening", *BENDING}
"""What follows from the solutions at the nodes, which are not found again for it."""


class OnOneBeam(SceneCases):
    """Rows of a table on one prepared beam; those that it does not solve are scenes of their own, which say why.

    What varies by case is 1 or 0 in the prepared scene, so that the digits are those of the table.

    Parameters
    ----------
    job : Job
        What is done with every row; all its columns may vary by case (`varies_by_case`).

    Raises
    ------
    GapbeamError
        The scene cannot be prepared.
    """

    is_prepared = True

    def __init__(self, job: Job):
        super().__init__(job)
        values = [0.0 if path.parts[0] == "supports" and path.parts[2] != "stiffness" else 1.0 for path in job.paths]
        self._prepared = {**with_values(job.scene, job.paths, values), "combinations": []}
        self._solver = prepared_solver(self._prepared)
        self._cases = np.array([load["case"] for load in self._prepared["loads"]], dtype=object)
        self._base = base_values(self._solver.columns)

    def _take(self, values: np.ndarray) -> tuple[np.ndarray, Varied, np.ndarray]:
        """Factor of every load, what else varies, and whether the numbers of a case can be taken; of others some that can."""
        count, columns = values.shape[1], self._solver.columns
        factors, fine = np.ones((count, len(self._cases))), np.ones(count, dtype=bool)
        supports = spans = moduli = None
        given: list[tuple[np.ndarray, np.ndarray, float]] = []
        with np.errstate(over="ignore", invalid="ignore"):
            for path, column in zip(self._paths, values, strict=True):
                head, *rest = path.parts
                if head == "loads":
                    factors[:, rest[0]] *= column
                elif head == "factors":
                    factors[:, self._cases == rest[0]] *= column[:, None]
                elif head == "beam":
                    if spans is None:
                        spans = np.broadcast_to(columns.span[[1, 2]].T, (count, columns.span.shape[1], 2)).copy()
                    which = rest[1] if rest[1:] else slice(0, -1)
                    fine &= column > 0.0
                    given.append((spans[:, which, OF_SPANS.index(rest[0])].T, column, 1.0))
                elif head == "supports":
                    if supports is None:
                        supports = np.broadcast_to(self._base, (count, *self._base.shape)).copy()
                    fine &= column > 0.0 if rest[1] == "stiffness" else np.isfinite(column)
                    other = 1.0 if rest[1] == "stiffness" else 0.0
                    given.append((supports[:, rest[0], OF_SUPPORTS.index(rest[1])], column, other))
                else:
                    if moduli is None:
                        moduli = np.full((count, columns.foundation.shape[1]), -1.0)
                    fine &= np.isfinite(column) & (column > 0.0)
                    given.append((moduli[:, rest[0]], column, 1.0))
        fine &= np.isfinite(factors).all(axis=1)
        factors[~fine] = 0.0
        for place, column, other in given:
            place[...] = np.where(fine, column, other)
        return factors, Varied(supports, spans, moduli), fine


class PreparedCases(OnOneBeam):
    """Rows that are one state each; parameters and errors as of `OnOneBeam`."""

    def __init__(self, job: Job):
        super().__init__(job)
        scene, beam = self._solver.scene, self._solver.beam
        # Shares of the live loads at which a case has to stand before all of them act
        self._before: list[float] = []
        if (scene.analysis.steps > 1 or scene.analysis.follow == "events") and not is_held(scene):
            if scene.analysis.follow == "events" or self._solver.movements is not None:
                raise SceneError("analysis.follow", "the beam may lose its hold at any share of the loads")
            self._before = shares_before(scene)
        self._sides = beam.sides
        supports = scene.supports
        x = scene.positions(supports)
        self._nodes = np.abs(beam.node_x - x[:, None]).argmin(axis=1)
        # Reactions and openings then follow from what is known of the nodes
        self._is_simple = not scene.foundation and all(
            one.law is None and one.direction == "normal" and one.stiffness > 0.0 for one in supports
        )
        done = ("input", ERRORS, *(("reaction", "opening") if self._is_simple else ()))
        self._rest = [name for name in job.want if name not in done and "@" not in name]
        self._fields = [name for name in self._rest if name not in ROWS]
        has_fields = self._fields or self._places or ERRORS in job.want
        self._names = wanted_names(("reaction", "deflection", *(["moment"] if has_fields else [])))

    def seconds(self, nodes: int, states: int) -> float:
        """Tell roughly how long a case takes; arguments as of `SceneCases.seconds`."""
        steps = 1 + len(self._before)
        if self._solver.beam.beyond_one_search is not None:
            return super().seconds(nodes, steps)
        if self._scene["foundation"]:
            return 2e-2 * steps
        known = KNOWN if any(path.parts[0] == "beam" for path in self._paths) else {*KNOWN, ERRORS}
        is_known = self._is_simple and set(self._want) - set(self._places) <= known
        return steps * (3e-6 + 4e-7 * nodes if is_known else 2e-5 + 3e-6 * nodes)

    def solve_together(self, values: np.ndarray, numbers: dict[str, np.ndarray]) -> Sequence[int]:
        """Solve cases in few calls of the engine; arguments as of `SceneCases.solve_together`.

        Returns
        -------
        sequence of int
            Cases that are not solved.
        """
        factors, varied, fine = self._take(values)
        start = self._solver.start
        moved = self._solver.moved(factors, varied)
        found = self._solver.solve(factors, start, moved, self._names)
        solved = fine & (found.status == Status.SOLVED)
        for share in self._before:
            part = factors * np.where(self._cases == DEAD, 1.0, share)
            solved &= self._solver.solve(part, start, self._solver.moved(part, varied), ()).status == Status.SOLVED
        states = found._combined() if len(self._rest) > len(self._fields) else None
        if states is not None:
            solved &= states.status == Status.SOLVED  # forces along the beam too
        if self._is_simple:
            self._keep_simple(found, moved, solved, numbers)
        for kind, bound in (found.error_bounds() if ERRORS in self._want else {}).items():
            numbers[f"{ERRORS}.{kind}"][solved] = bound[solved]
        for name in (name for name in self._rest if name in ROWS):
            for k, one in enumerate(self._supports):
                numbers[f"{name}.{one}"][solved] = states.at_supports[solved, ROWS[name], k]
        for name, extremes in (found._extremes_of(self._fields) if self._fields else {}).items():
            for kind, (extreme, place) in extremes.items():
                numbers[f"{name}.{kind}"][solved] = extreme[solved]
                numbers[f"{name}.{kind}_x"][solved] = place[solved]
        if self._places:
            there = found.at(self._x)
            for k, name in enumerate(self._places):
                numbers[name][solved] = getattr(there, name.partition("@")[0])[solved, k] + 0.0
        return np.flatnonzero(~solved).tolist()

    def _keep_simple(self, found: Cases, varied: Varied, solved: np.ndarray, numbers: dict[str, np.ndarray]) -> None:
        """Keep reactions, and openings by the deflections of the nodes."""
        for k, one in enumerate(self._supports):
            if "reaction" in self._want:
                numbers[f"reaction.{one}"][solved] = found.reaction[solved, k] + 0.0  # there is one zero
            if "opening" in self._want:
                settlement, gap, _ = self._base[k] if varied.supports is None else varied.supports[:, k].T
                away = self._sides[k] * (settlement + self._sides[k] * gap - found.deflection[:, self._nodes[k]])
                numbers[f"opening.{one}"][solved] = np.where(found.closed[:, k], 0.0, np.maximum(away, 0.0) + 0.0)[solved]


NUMBERS = 1_000_000
"""Numbers of all combinations that are solved in one go, at most."""


class PreparedCombinations(OnOneBeam):
    """Rows that have an envelope over the same combinations each; parameters and errors as of `OnOneBeam`."""

    def __init__(self, job: Job):
        super().__init__(job)
        scene, beam = self._prepared, self._solver.beam
        plan = plan_combinations(read_scene({**scene, "combinations": job.scene["combinations"]}))
        if not self._solver.scene.analysis.is_one_step and at_once(job.scene, job.paths)["analysis"]["steps"] > 1:
            raise SceneError("analysis", "every combination is followed by itself")
        in_parts = any("parts" in one.expand.values() for one in plan.scene.combinations)
        if in_parts or len(plan.scene.loads) > len(scene["loads"]) or any(other is not None for other in plan.scheme_of):
            raise SceneError("combinations", "their loads or contact states are not those of the scene")
        if plan.settlements.any() or self._solver.movements is not None or beam.bars >= 0 or beam.in_stretches:
            raise SceneError("combinations", "moved supports, compression and zones of contact are looked at one by one")
        self._factors = plan.factors
        # Both sides of every place: where a field jumps, the larger and the smaller value count
        sides = [beam.find(np.array(self._x), left) for left in (False, True)]
        self._piece, self._distance = map(np.concatenate, zip(*sides, strict=True))

    def seconds(self, nodes: int, states: int) -> float:
        """Tell roughly how long a case takes; arguments as of `SceneCases.seconds`."""
        return states * (2e-5 + 3e-6 * nodes)

    def solve_together(self, values: np.ndarray, numbers: dict[str, np.ndarray]) -> Sequence[int]:
        """Solve cases in few calls of the engine; arguments as of `SceneCases.solve_together`.

        Returns
        -------
        sequence of int
            Cases that are not solved.
        """
        beam, count = self._solver.beam, values.shape[1]
        a_row = len(self._factors) * (beam.columns.load.shape[1] + 4 * beam.scene_supports + len(FIELDS) * (4 + len(self._piece)))
        some = max(NUMBERS // a_row, 1)
        left: list[int] = []
        for first in range(0, count, some):
            part = slice(first, min(first + some, count))
            here = {name: column[part] for name, column in numbers.items()}
            left += [first + k for k in self._solve_some(values[:, part], here)]
        return left

    def _solve_some(self, values: np.ndarray, numbers: dict[str, np.ndarray]) -> list[int]:
        factors, varied, fine = self._take(values)
        rows, count = len(fine), len(self._factors)
        own = (None if one is None else np.repeat(one, count, axis=0) for one in (varied.supports, varied.spans, varied.moduli))
        with np.errstate(over="ignore"):
            products = (factors[:, None] * self._factors).reshape(rows * count, -1)
        fine &= np.isfinite(products).all(axis=1).reshape(rows, count).all(axis=1)
        products[~np.repeat(fine, count)] = 0.0
        solver = self._solver
        found = all_combinations(
            solver.beam, products, None, solver.rule, solver.start, self._piece, self._distance, Varied(*own)
        )
        solved = fine & (found.status.reshape(rows, count) == Status.SOLVED).all(axis=1)
        tables = found.at_supports, found.extremes, found.places, found.fields
        at_supports, extremes, places, fields = (one.reshape(rows, count, *one.shape[1:])[solved] for one in tables)
        for name in (name for name in self._want if name != "input" and "@" not in name):
            for end, kind, best in ((0, "max", np.argmax), (1, "min", np.argmin)):
                if name in AT_SUPPORTS and name != "deflection":
                    row = getattr(at_supports[:, :, AT_SUPPORTS.index(name)], kind)(axis=1)
                    for k, one in enumerate(self._supports):
                        numbers[f"{name}.{one}.{kind}"][solved] = row[:, k] + 0.0  # there is one zero
                    continue
                column = FIELDS.index(name)
                which = best(extremes[:, :, column, end], axis=1)[:, None]
                for suffix, table in (("", extremes), ("_x", places)):
                    numbers[f"{name}.{kind}{suffix}"][solved] = np.take_along_axis(table[:, :, column, end], which, axis=1)[:, 0]
        for k, name in enumerate(self._places):
            there = fields[:, :, [k, k + len(self._places)], FIELDS.index(name.partition("@")[0])].reshape(len(fields), -1)
            for kind in KINDS:
                numbers[f"{name}.{kind}"][solved] = getattr(there, kind)(axis=1) + 0.0
        return np.flatnonzero(~solved).tolist()
