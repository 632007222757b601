"""Envelopes of rows over combinations: all combinations of many rows are solved together on one prepared beam."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..base.errors import SceneError, Status
from ..engine.combinations import Varied, all_combinations
from ..engine.quantities import FIELDS
from ..results.envelopes.envelope import AT_SUPPORTS
from ..results.views.extreme import KINDS
from ..scene.combinations import plan_combinations
from ..scene.reading import read_scene
from .load_steps import at_once
from .prepared import OnOneBeam

if TYPE_CHECKING:
    from .job import Job

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
