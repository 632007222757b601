"""Cases that are solved one by one, each as a scene of its own."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ..base.errors import EngineError, SceneError
from ..results.result import Result
from ..results.stepping import solve
from ..results.views.extreme import KINDS
from ..scene.names import labels
from ..scene.structs import Scene
from .load_steps import at_once
from .paths import with_values
from .tables import Rows

if TYPE_CHECKING:
    from .job import Job

SOLVED, FAILED = "solved", "failed"
"""Outcomes of a case are those of a `Result` (solved, no-equilibrium, limit-load), and refused (its numbers make no scene),
no-answer (the engine gives none) and failed (a fault of the program or its memory)."""
AT_SUPPORTS = ("reaction", "opening", "couple")
ERRORS = "error_bound"
"""Bounds of the errors of one state."""
LIMIT = "limit.factor"
"""Load factor at which the load cannot go on, where it is followed; there is none where it reaches its end."""


def place_of(name: str) -> float:
    """Read the place of a value along the beam.

    Parameters
    ----------
    name : str
        Of the value.

    Returns
    -------
    float
        Not-a-number where that is none.

    Examples
    --------
    >>> place_of("moment@15.0")
    15.0
    """
    try:
        return float(name.partition("@")[2])
    except ValueError:
        return float("nan")


class SceneCases:
    """Every row of a table put into a scene, which is solved.

    Parameters
    ----------
    job : Job
        What is done with every row.
    """

    is_prepared = False
    """Whether cases are solved together on a prepared beam."""

    def __init__(self, job: Job):
        self._scene, self._paths, self._want, self._supports, self._ends = job.scene, job.paths, job.want, job.supports, job.ends
        self._places = [name for name in job.want if "@" in name]
        self._x = [place_of(name) for name in self._places]

    def seconds(self, nodes: int, states: int) -> float:
        """Tell roughly how long a case takes.

        Parameters
        ----------
        nodes : int
            Of the beam.
        states : int
            Of a case, as of its combinations and trains.
        """
        return states * (7e-4 + 6e-6 * nodes + (2e-2 if self._scene["foundation"] else 0.0))

    def solve_together(self, values: np.ndarray, numbers: dict[str, np.ndarray]) -> Sequence[int]:
        """Solve the cases that can be solved together: none.

        Parameters
        ----------
        values : numpy.ndarray
            Columns of the table by cases.
        numbers : dict of numpy.ndarray
            What is kept, by name of the column; changed where cases are solved.

        Returns
        -------
        sequence of int
            Cases that are left.
        """
        return range(values.shape[1])

    def solve_one(self, rows: Rows, values: np.ndarray, k: int, numbers: dict[str, np.ndarray]) -> tuple[str, str]:
        """Solve one case as a scene of its own.

        Parameters
        ----------
        rows : Rows
            Of the table.
        values, numbers
            As for `solve_together`.
        k : int
            The case.

        Returns
        -------
        status, reason : str
            What came of it, and why; no reason where it is solved.
        """
        try:
            result = self._result(rows, values[:, k].tolist(), k)
            if LIMIT in self._want:
                numbers[LIMIT][k] = _limit_factor(result)
            if result.status != SOLVED:
                return result.status, result.reason or ""
            if result.combinations or result.scene.trains:
                self._keep_envelope(result, k, numbers)
            else:
                self._keep_state(result, k, numbers)
            return SOLVED, ""
        except SceneError as error:
            return "refused", str(error)
        except EngineError as error:
            return "no-answer", str(error)
        except MemoryError:
            return FAILED, "not enough memory; start fewer jobs, and the batch again with --retry-failed"
        except Exception as error:
            return FAILED, f"internal error: {type(error).__name__} ({error}); this is a fault of gapbeam, please report it"

    @cached_property
    def _at_once(self) -> dict[str, Any]:
        """The scene without load steps that change nothing."""
        return at_once(self._scene, self._paths)

    def _result(self, rows: Rows, row: list[float], k: int) -> Result:
        """Solve the scene with the numbers of a row."""
        wrong = next((path.text for path, value in zip(self._paths, row, strict=True) if value != value), None)
        if wrong is not None:
            raise SceneError(wrong, "expected a number, got nan")
        result = solve(with_values(self._at_once, self._paths, row))
        if result.status == SOLVED or self._at_once is self._scene:
            return result
        return solve(with_values(self._scene, self._paths, row))  # its reason names the load step

    def _keep_state(self, result: Result, k: int, numbers: dict[str, np.ndarray]) -> None:
        """Keep what is wanted of a state."""
        step, extremes = result.steps[-1], {}
        if set(self._want) - {"input", ERRORS, LIMIT, *AT_SUPPORTS, *self._places}:
            extremes = result._pairs_of_extremes()
        if ERRORS in self._want:
            for kind, bound in step.error_bounds.items():
                numbers[f"{ERRORS}.{kind}"][k] = np.nan if bound is None else bound
        self._keep(result.scene, {name: (getattr(step, name),) for name in AT_SUPPORTS}, extremes, k, numbers)
        self._keep_at_places(result, lambda x: (result.at(x).columns(),), k, numbers)

    def _keep_envelope(self, result: Result, k: int, numbers: dict[str, np.ndarray]) -> None:
        """Keep what is wanted of an envelope; the beam can stand everywhere in it."""
        envelope = result.envelope()
        at_supports = {
            name: tuple(np.array([one[name][kind].value for one in envelope.supports]) for kind in KINDS)
            for name in AT_SUPPORTS
            if name in self._want
        }
        extremes = {name: {kind: (one[kind].value, one[kind].x) for kind in KINDS} for name, one in envelope.extremes.items()}
        self._keep(result.scene, at_supports, extremes, k, numbers)

        def at(x: list[float]) -> tuple[dict[str, np.ndarray], ...]:
            curves = result.envelope(x=x).fields
            return curves.largest, curves.smallest

        self._keep_at_places(result, at, k, numbers)

    def _keep_at_places(
        self, result: Result, at: Callable[[list[float]], tuple[Mapping[str, np.ndarray], ...]], k: int,
        numbers: dict[str, np.ndarray],
    ) -> None:  # fmt: skip
        """Keep values at places along the beam, or their largest and smallest ones; `at` gives fields there."""
        if not self._places:
            return
        length = float(result.scene.span_ends()[-1])
        for name, x in zip(self._places, self._x, strict=True):
            if x > length:
                raise SceneError(name, f"the beam of this case ends at {length:g}; take a place on it")
        for end, fields in zip(self._ends, at(self._x), strict=True):
            for row, name in enumerate(self._places):
                numbers[f"{name}{end}"][k] = fields[name.partition("@")[0]][row] + 0.0

    def _keep(
        self, scene: Scene, at_supports: dict[str, tuple[np.ndarray, ...]], extremes: dict[str, dict[str, tuple[float, float]]],
        k: int, numbers: dict[str, np.ndarray],
    ) -> None:  # fmt: skip
        """Keep values at supports (or their largest and smallest ones), and extremes of fields."""
        for name in self._want:
            if name in AT_SUPPORTS:
                self._keep_at_supports(name, scene, at_supports[name], k, numbers)
            elif name not in ("input", ERRORS, LIMIT) and "@" not in name:
                for kind in KINDS:
                    numbers[f"{name}.{kind}"][k], numbers[f"{name}.{kind}_x"][k] = extremes[name][kind]

    def _keep_at_supports(
        self, name: str, scene: Scene, of_kinds: tuple[np.ndarray, ...], k: int, numbers: dict[str, np.ndarray]
    ) -> None:
        """Keep the values at every support; a hinge whose slack a row sets to 0 is none."""
        there = labels(scene.supports)
        for end, values in zip(self._ends, of_kinds, strict=True):
            for one, value in zip(there, values, strict=True):
                if f"{name}.{one}{end}" in numbers:
                    numbers[f"{name}.{one}{end}"][k] = value + 0.0  # there is one zero


def _limit_factor(result: Result) -> float:
    """Load factor at which the load cannot go on; not-a-number where it is not known to have one."""
    if result.limits:
        return result.limits[0].factor
    is_end = result.status == "no-equilibrium" and result.path is not None and len(result.steps)
    return result.steps[-1].factor if is_end else np.nan


class FolderCases(SceneCases):
    """Every row the name of a file, whose scene is solved as it is."""

    def _result(self, rows: Rows, row: list[float], k: int) -> Result:
        return solve(rows.paths[k])

    def _keep_at_supports(
        self, name: str, scene: Scene, of_kinds: tuple[np.ndarray, ...], k: int, numbers: dict[str, np.ndarray]
    ) -> None:
        """Keep the largest and smallest value at the supports across the beam; only those have the same direction."""
        across = [one.direction == "normal" for one in scene.supports]
        largest, smallest = of_kinds[0][across], of_kinds[-1][across]
        if largest.size:  # else not-a-number: the beam is on foundations alone
            numbers[f"{name}.max"][k] = largest.max()
            numbers[f"{name}.min"][k] = smallest.min()
