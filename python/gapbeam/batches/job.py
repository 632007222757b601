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
from ..base.errors import GapbeamError
from ..results.state.step import BOUNDED
from ..results.views.extreme import KINDS
from .paths import KeyPath, varies_by_case
from .prepared import PreparedCases, PreparedCombinations
from .scene_cases import AT_SUPPORTS, ERRORS, LIMIT, SOLVED, FolderCases, SceneCases
from .tables import Rows

STATUS = "S20"
LONGEST = 400
"""Characters of a reason."""


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
    def has_envelopes(self) -> bool:
        """Whether a case has an envelope, over combinations or trains, in place of one state."""
        return self.scene is not None and bool(self.scene["combinations"] or self.scene["trains"])

    @property
    def ends(self) -> list[str]:
        """Ends of the names of columns of a support."""
        return [f".{kind}" for kind in KINDS] if self.has_envelopes else [""]

    @cached_property
    def columns(self) -> tuple[str, ...]:
        """Names of the numbers that are kept of each case."""
        found: list[str] = []
        for name in self.want:
            if name == "input":
                found += [path.text for path in self.paths]
            elif name in AT_SUPPORTS:
                found += [f"{name}.{one}{end}" for one in (KINDS if self.scene is None else self.supports) for end in self.ends]
            elif name == ERRORS:
                found += [f"{name}.{kind}" for kind in BOUNDED]
            elif name == LIMIT:
                found.append(LIMIT)
            elif "@" in name:
                found += [f"{name}{end}" for end in self.ends]
            else:
                found += [f"{name}.{kind}{end}" for kind in KINDS for end in ("", "_x")]
        return tuple(found)

    @cached_property
    def cases(self) -> SceneCases:
        """How the cases are solved: together on a prepared beam where that can be, else one by one."""
        if self.scene is None:
            return FolderCases(self)
        is_at_once = not self.scene["trains"] and self.scene["analysis"]["history"] == [1.0] and LIMIT not in self.want
        if is_at_once and all(varies_by_case(self.scene, path) for path in self.paths):
            with suppress(GapbeamError):
                return (PreparedCombinations if self.scene["combinations"] else PreparedCases)(self)
        return SceneCases(self)

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
        count = values.shape[1]
        numbers = {name: np.full(count, np.nan) for name in self.columns}
        if "input" in self.want:
            numbers |= {path.text: row for path, row in zip(self.paths, values, strict=True)}
        outcomes: dict[int, tuple[str, str]] = {row: ("refused", problem) for row, problem in problems.items()}
        rest: Sequence[int] = range(count)
        with suppress(MemoryError):  # one by one they may fit
            rest = self.cases.solve_together(values, numbers)
        for row in rest:
            if stop is not None and stop.is_set():
                raise StoppedError
            if row not in problems:
                outcomes[row] = self.cases.solve_one(rows, values, row, numbers)
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
