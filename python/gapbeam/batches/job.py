"""The work on every case of a batch, the same wherever it is done."""

from __future__ import annotations

import os
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from threading import Event
from typing import Any

import numpy as np

from ..base.characters import visible
from ..base.errors import EngineError, SceneError
from ..results.result import Result
from ..results.state.step import BOUNDED
from ..results.stepping import solve
from ..scene.structs import Scene
from .paths import KeyPath, with_values
from .prepared import PreparedRoad, at_once, prepared_road
from .tables import Rows, SceneFiles

SOLVED, FAILED = "solved", "failed"
"""Outcomes of a case are those of a `Result` (solved, no-equilibrium, limit-load), and refused (its numbers make no scene),
no-answer (the engine gives none) and failed (a fault of the program or its memory)."""
STATUS = "S20"
LONGEST = 400
"""Characters of a reason."""
AT_SUPPORTS = ("reaction", "opening", "couple")
ERRORS = "error_bound"
"""Bounds of the errors of one state."""
KINDS = ("max", "min")
WANTED = ("input", "reaction", "opening", "deflection", "moment")
"""What is kept of every case where nothing else is said."""


class StoppedError(Exception):
    """The batch is to end before this chunk does."""


@dataclass(frozen=True)
class Job:
    """What is done with every row of a table.

    Attributes
    ----------
    scene : dict or None
        The scene as plain data; None where every row is a scene of its own.
    paths : tuple of KeyPath
        What the columns of the table are.
    want : tuple of str
        What is kept of each case.
    supports : tuple of str
        Names or numbers of the supports.
    """

    scene: dict[str, Any] | None
    paths: tuple[KeyPath, ...]
    want: tuple[str, ...]
    supports: tuple[str, ...]

    @property
    def is_prepared(self) -> bool:
        """Whether cases are solved on a prepared beam, or each as a scene of its own."""
        return self.prepared is not None

    @property
    def has_envelopes(self) -> bool:
        """Whether a case has an envelope, over combinations or trains, in place of one state."""
        return self.scene is not None and bool(self.scene["combinations"] or self.scene["trains"])

    @property
    def _ends(self) -> list[str]:
        """What stands behind the name of a support."""
        return [f".{kind}" for kind in KINDS] if self.has_envelopes else [""]

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the numbers that are kept of each case."""
        found: list[str] = []
        for name in self.want:
            if name == "input":
                found += [path.text for path in self.paths]
            elif name in AT_SUPPORTS:
                found += [f"{name}.{one}{end}" for one in (KINDS if self.scene is None else self.supports) for end in self._ends]
            elif name == ERRORS:
                found += [f"{name}.{kind}" for kind in BOUNDED]
            else:
                found += [f"{name}.{kind}{end}" for kind in KINDS for end in ("", "_x")]
        return tuple(found)

    @cached_property
    def prepared(self) -> PreparedRoad | None:
        """The prepared beam, where there can be one."""
        return None if self.scene is None else prepared_road(self.scene, self.paths)

    @cached_property
    def _at_once(self) -> dict[str, Any] | None:
        """The scene without load steps that change nothing."""
        return None if self.scene is None else at_once(self.scene, self.paths)

    def __getstate__(self) -> dict[str, Any]:
        """Pickle without what is made on the way."""
        return {name: getattr(self, name) for name in self.__dataclass_fields__}

    def solve(self, rows: Rows, first: int, stop: Event | None = None) -> dict[str, np.ndarray]:
        """Solve some cases.

        Parameters
        ----------
        rows : Rows
            Of the table.
        first : int
            Number of the first of them.
        stop : threading.Event, optional
            Set where the work is to end.

        Returns
        -------
        dict
            ``case``, ``status``, ``reason`` and the numbers wanted: an entry for every case, not-a-number where it is not solved.

        Raises
        ------
        StoppedError
            `stop` was set.
        """
        values, problems = rows.columns()
        count = len(rows)
        numbers = {name: np.full(count, np.nan) for name in self.columns}
        if "input" in self.want:
            numbers |= {path.text: row for path, row in zip(self.paths, values, strict=True)}
        outcomes: dict[int, tuple[str, str]] = {row: ("refused", problem) for row, problem in problems.items()}
        rest: Sequence[int] = range(count)
        if self.is_prepared:
            with suppress(MemoryError):  # one by one they may fit
                rest = np.flatnonzero(~self.prepared.solve(values, self.want, numbers, self.supports)).tolist()
        for row in rest:
            if stop is not None and stop.is_set():
                raise StoppedError
            if row not in problems:
                source = rows.paths[row] if isinstance(rows, SceneFiles) else None
                outcomes[row] = self._solve_one(source, values[:, row].tolist(), row, numbers)
        found: dict[str, np.ndarray] = {"case": np.arange(first, first + count)}
        if self.scene is None:
            found["scene"] = np.array([visible(os.path.basename(path)).encode() for path in rows.paths])
        status = np.full(count, SOLVED, dtype=STATUS)
        reasons = {}
        for row, (outcome, reason) in outcomes.items():
            status[row] = outcome
            if reason:
                reasons[row] = visible(" ".join(reason.split()))[:LONGEST].encode()
        reason = np.zeros(count, dtype=f"S{max(map(len, reasons.values()), default=1)}")
        for row, text in reasons.items():
            reason[row] = text
        return found | {"status": status, "reason": reason} | numbers

    def _solve_one(self, source: Any, row: list[float], k: int, numbers: dict[str, np.ndarray]) -> tuple[str, str]:
        """Solve a case as a scene of its own."""
        try:
            wrong = next((path.text for path, value in zip(self.paths, row, strict=True) if value != value), None)
            if wrong is not None:
                raise SceneError(wrong, "expected a number, got nan")
            result = solve(with_values(self._at_once, self.paths, row) if source is None else source)
            if result.status != SOLVED and self._at_once is not self.scene:
                result = solve(with_values(self.scene, self.paths, row))  # its reason names the load step
            if result.status != SOLVED:
                return result.status, result.reason or ""
            if result.combinations or result.scene.trains:
                return self._keep_envelope(result, k, numbers)
            step, extremes = result.steps[-1], {}
            if set(self.want) - {"input", ERRORS, *AT_SUPPORTS}:
                extremes = result.extremes()
            if ERRORS in self.want:
                for kind, bound in step.error_bounds.items():
                    numbers[f"{ERRORS}.{kind}"][k] = np.nan if bound is None else bound
            at_supports = {name: (self._kept(result.scene, getattr(step, name)),) for name in AT_SUPPORTS}
            self._keep(k, numbers, at_supports, extremes)
            return SOLVED, ""
        except SceneError as error:
            return "refused", str(error)
        except EngineError as error:
            return "no-answer", str(error)
        except MemoryError:
            return FAILED, "not enough memory; start fewer jobs, and the batch again with --retry-failed"
        except Exception as error:
            return FAILED, f"internal error: {type(error).__name__} ({error}); this is a fault of gapbeam, please report it"

    def _keep_envelope(self, result: Result, k: int, numbers: dict[str, np.ndarray]) -> tuple[str, str]:
        """Keep what is wanted of an envelope; the beam can stand everywhere in it."""
        envelope = result.envelope()
        at_supports = {
            name: tuple(
                self._kept(result.scene, np.array([one[name][kind].value for one in envelope.supports])) for kind in KINDS
            )
            for name in AT_SUPPORTS
            if name in self.want
        }
        extremes = {name: {kind: (one[kind].value, one[kind].x) for kind in KINDS} for name, one in envelope.extremes.items()}
        self._keep(k, numbers, at_supports, extremes)
        return SOLVED, ""

    def _kept(self, scene: Scene, values: np.ndarray) -> np.ndarray:
        """Values at the supports that are kept: of a scene of a folder only those across the beam have the same direction."""
        return values if self.scene is not None else values[[one.direction == "normal" for one in scene.supports]]

    def _keep(
        self, k: int, numbers: dict[str, np.ndarray], at_supports: dict[str, tuple[np.ndarray, ...]],
        extremes: dict[str, dict[str, tuple[float, float]]],
    ) -> None:  # fmt: skip
        """Keep what is wanted of a case: values at supports (or their largest and smallest ones), extremes of fields."""
        for name in self.want:
            if name in AT_SUPPORTS and self.scene is None:
                if at_supports[name][0].size:  # else not-a-number: the beam is on foundations alone
                    numbers[f"{name}.max"][k] = at_supports[name][0].max()
                    numbers[f"{name}.min"][k] = at_supports[name][-1].min()
            elif name in AT_SUPPORTS:
                for end, values in zip(self._ends, at_supports[name], strict=True):
                    for one, value in zip(self.supports, values, strict=True):
                        numbers[f"{name}.{one}{end}"][k] = value + 0.0  # there is one zero
            elif name not in ("input", ERRORS):
                for kind in KINDS:
                    numbers[f"{name}.{kind}"][k], numbers[f"{name}.{kind}_x"][k] = extremes[name][kind]
