"""The verbs of results for many cases: what is one number of a result is an array here, with an entry for every case."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from dataclasses import fields, replace
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ...base.errors import Status, UnsolvedError
from ...base.hints import no_such
from ...base.records import read_only
from ...engine.combinations import Combined
from ...scene.names import labels
from ..envelopes.envelope import AT_SUPPORTS
from ..envelopes.lifted import Lifted, least_openings, lifted_in_cases
from ..envelopes.tables import support_places
from ..state.arguments import whole
from ..state.step import name_states
from ..views.columns import Columns, one_of
from ..views.extreme import KINDS, SYMBOLS, Extreme, Extremes, Source
from ..views.labelled import Labelled, by_support
from ..views.shown import Shown
from .case_result import result_of_case, why_not_solved

if TYPE_CHECKING:
    from ...scene.structs import Scene
    from ..result import Result
    from .solved_cases import Cases

AT_ONCE = 64
"""Cases whose fields are found at the places of all of them."""


class CaseExtreme(Extreme):
    """Largest or smallest values of a field, arrays with an entry for every case; its attributes are those of `Extreme`."""

    def __init__(self, cases: Cases, quantity: str, value: np.ndarray, x: np.ndarray):
        super().__init__(quantity, value, x, Source())
        self._cases = cases

    @property
    def state(self) -> Any:
        """Refuse: every case has a state of its own."""
        raise ValueError("each case has a state of its own; take cases.result(case).steps[-1]")

    @cached_property
    def concurrent(self) -> dict[str, np.ndarray]:
        """What the other fields are there, in the same case, on the side of the extreme."""
        value, x = np.ravel(self.value), np.ravel(self.x)
        found: dict[str, np.ndarray] = {}
        for first in range(0, len(value), AT_ONCE):
            part = slice(first, min(first + AT_ONCE, len(value)))
            rows, known = np.arange(part.stop - part.start), np.isfinite(x[part])
            cases = self._cases[part] if np.ndim(self.value) else self._cases
            there = [cases.at(np.where(known, x[part], 0.0), side).columns() for side in ("right", "left")]
            there = [{name: np.atleast_2d(one)[rows, rows] for name, one in side.items() if name != "x"} for side in there]
            away = [np.abs(side[self.quantity] - value[part]) for side in there]
            for name in there[0]:
                column = np.where(away[1] < away[0], there[1][name], there[0][name])
                found.setdefault(name, np.full(len(value), np.nan))[part] = column
        return {name: one.reshape(np.shape(self.value))[()] for name, one in found.items() if name != self.quantity}


class CaseExtremes(Extremes):
    """Largest and smallest values of every field, arrays with an entry for every case; each field is looked at when asked for."""

    def __init__(self, cases: Cases):
        super().__init__(dict, cases._pairs_of_extremes, 'cases.extremes["moment"]["max"].value')
        self._cases, self._found = cases, {}

    def __getitem__(self, key: str) -> dict[str, CaseExtreme]:
        """Give ``{"max": Extreme, "min": Extreme}`` of a field."""
        if key not in self._cases._beam.fields:
            raise KeyError(no_such("field", key, self, SYMBOLS))
        if key not in self._found:
            pairs = self._cases._extremes_of((key,))[key]
            self._found[key] = {kind: CaseExtreme(self._cases, key, *pairs[kind]) for kind in KINDS}
        return self._found[key]

    def __iter__(self) -> Iterator[str]:
        """Go through the fields."""
        return iter(self._cases._beam.fields)

    def __len__(self) -> int:
        """Count the fields."""
        return len(self._cases._beam.fields)


class CaseStates(Labelled):
    """States by number and name of the support; calling it gives what the method gave that this was."""

    def __call__(self) -> Combined:
        """Give the engine's own arrays."""
        warnings.warn("states of cases are an attribute, by support", DeprecationWarning, stacklevel=2)
        return self._combined()


class CaseVerbs(Shown):
    """What is asked of cases in the words of results."""

    __slots__ = ()
    _kinds = ("cases", "supports", "fields")
    meant: ClassVar = {"historyextremes": "extremes: every case is one state", "steps": "result(case).steps"}

    @property
    def scene(self) -> Scene:
        """The prepared scene; what varies by case is as there."""
        return self._one.scene if self._one is not None else self._asked.scene

    def __len__(self) -> int:
        """Count the cases."""
        self._axis()
        return self._shape[0]

    def __bool__(self) -> bool:
        """Give True, for one case and for none too."""
        return True

    def __iter__(self) -> Iterator[Cases]:
        """Go through the cases."""
        self._axis()
        return (self[k] for k in range(len(self)))

    def _axis(self) -> None:
        if not self._shape:
            raise TypeError("this is one case, without an axis of cases: leave out the number; Prepared.solve([factors]) has one")

    def __getitem__(self, key: Any) -> Cases:
        """Give one case by its number, or several by a slice, a list of numbers or a mask.

        Raises
        ------
        IndexError
            There is no such case.
        """
        self._axis()
        asked, count = self._asked, len(self)
        try:
            rows = np.arange(count)[key]
        except IndexError as error:
            there = f"their numbers go from 0 to {count - 1}" if count else "there are none"
            one = isinstance(key, int | np.integer)
            raise IndexError(f"there is no case {key}; {there}" if one else f"cases: {error}; {there}") from None
        single, rows = np.ndim(rows) == 0, np.atleast_1d(rows)
        states = [replace(there, **{one.name: getattr(there, one.name)[rows] for one in fields(there)}) for there in asked.states]
        part = replace(asked, factors=asked.factors[rows], closed=asked.closed[rows], varied=asked.varied.of(rows), states=states)
        return self._made({name: getattr(self, name)[rows] for name in self._wanted}, part, single)

    @property
    def ok(self) -> Any:
        """Whether each is solved: an array of bool, of one case a bool."""
        found = read_only(np.equal(self.status, Status.SOLVED))
        return found if self._shape else bool(found)

    @property
    def reason(self) -> str | None:
        """Which cases are not solved, and why the first of them is not; None where all are."""
        asked = self._asked
        lost = np.flatnonzero(np.atleast_1d(self.status) != Status.SOLVED).tolist()
        if not lost:
            return None
        words = why_not_solved(*self._about(asked, lost[0])) or f"status {Status(int(np.atleast_1d(self.status)[lost[0]])).word}"
        more = f"; {len(lost) - 1:,} more of {len(asked.factors):,} not solved" if len(lost) > 1 else ""
        return f"case {lost[0]}: {words}{more}" if self._shape else words

    def raise_for_status(self) -> Cases:
        """Raise an `UnsolvedError` unless all cases are solved; give the cases themselves."""
        lost = np.atleast_1d(self.status)[np.atleast_1d(self.status) != Status.SOLVED]
        if len(lost):
            raise UnsolvedError(Status(int(lost[0])).word, self.reason)
        return self

    def _about(self, asked: Any, k: int) -> tuple[Any, ...]:
        return self.scene, asked.beam, asked.rule, asked.factors[k], asked.varied.of(slice(k, k + 1))

    def result(self, case: int | None = None) -> Result:
        """Solve one case with all that `gapbeam.solve` gives: fields, extremes, certificate, report.

        Parameters
        ----------
        case : int, optional
            Its number; needed where there are several.

        Returns
        -------
        Result

        Raises
        ------
        ValueError
            Without a number of several cases.
        """
        if self._shape:
            if case is None:
                raise ValueError(f"case: give the number of one, from 0 to {len(self) - 1}, as cases.result(0)")
            return self[whole("case", case)].result()
        return result_of_case(*self._about(self._asked, 0))

    def _by_support(self, quantity: str) -> Labelled:
        if quantity == "reaction" and "reaction" in self._names and np.shape(self.reaction)[-1] == len(self.scene.supports):
            return by_support(self.scene, quantity, self.reaction.T)
        values = self._combined().at_supports[:, AT_SUPPORTS.index(quantity)]
        return by_support(self.scene, quantity, values.T if self._shape else values[0])

    @property
    def states(self) -> Labelled:
        """States by number and name of the support, an array of words for every case; None where one is not solved."""
        asked, solved = self._asked, np.atleast_1d(self.ok)
        schemes, which = np.unique(asked.closed, axis=0, return_inverse=True)
        names = np.array([name_states(asked.beam, one) for one in schemes], dtype=object).reshape(len(schemes), -1)
        words = np.where(solved[:, None], names[which.ravel()], None) if len(schemes) else names
        keys = by_support(self.scene, "state", ()).keys()
        found = CaseStates("state", "support", keys, words.T if self._shape else words[0])
        found._combined = self._combined
        return found

    @property
    def lifted(self) -> list[Lifted]:
        """One-sided supports without contact: in which part of the cases, and in which the opening is largest."""
        return self._lifted(self._combined().at_supports[:, 2])

    def _lifted(self, openings: np.ndarray) -> list[Lifted]:
        """Find them by the openings, cases by supports."""
        solved = np.atleast_1d(self.ok)
        if not solved.any():
            return []
        return lifted_in_cases(openings, solved, least_openings(self.scene.supports, self.extremes))

    @property
    def extremes(self) -> CaseExtremes:
        """Exact largest and smallest values of every field with their places, arrays by field, then by ``max`` and ``min``."""
        return CaseExtremes(self)

    def table(self, kind: str = "cases", points: int = 20) -> Columns:
        """Give a table.

        Parameters
        ----------
        kind : {"cases", "supports", "fields"}
            A row for every case with reactions and extremes; for every support, or along the beam, the largest and smallest values.
        points : int
            Divisions of every span in the table of fields.

        Returns
        -------
        Columns
            As of `Shown.table`.
        """
        if one_of(kind, self._kinds) == "cases":
            return Columns(self._rows())
        if kind == "fields":
            x = np.unique(np.concatenate([np.linspace(a, b, points + 1) for a, b in pairwise(self.scene.span_ends().tolist())]))
            table: dict[str, Any] = {"x": x}
            for name, values in self.at(x).columns().items():
                if name != "x":
                    table |= dict(zip((f"{name}_max", f"{name}_min"), _most(np.atleast_2d(values)), strict=True))
            return Columns(table)
        table = support_places(self.scene)
        for name, found in (("reaction", self.reactions), ("opening", self.openings)):
            values = np.reshape(np.asarray(found, dtype=float), (len(self.scene.supports), -1)).T
            table |= dict(zip((f"{name}_max", f"{name}_min"), _most(values), strict=True))
        share = {one.support: one.share for one in self._lifted(values)}
        return Columns(table | {"lifted_share": np.array([share.get(k, 0.0) for k in range(len(self.scene.supports))])})

    def _rows(self) -> dict[str, Any]:
        """Columns of the table of cases."""
        status = np.atleast_1d(self.status).tolist()
        table: dict[str, Any] = {"case": np.arange(len(status)), "status": [Status(one).word for one in status]}
        reactions = np.reshape(np.asarray(self.reactions, dtype=float), (len(self.scene.supports), -1))
        table |= {f"reaction {name}": row for name, row in zip(labels(self.scene.supports), reactions, strict=True)}
        for name, row in self.extremes.items():
            for kind, one in row.items():
                table |= {f"{name}_{kind}": np.ravel(one.value), f"{name}_{kind}_x": np.ravel(one.x)}
        return table

    def to_dict(self) -> dict[str, Any]:
        """Everything as plain data: the table of cases, and the reason where some are not solved.

        Returns
        -------
        dict
            Only numbers, strings, lists and dicts; None where a case is not solved.
        """
        table = {name: _plain(column) for name, column in self._rows().items()}
        reason = self.reason
        return {"title": self.scene.title, **({} if reason is None else {"reason": reason}), **table}


def _most(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Largest and smallest values of all cases; not-a-number where none is solved."""
    return np.fmax.reduce(values, axis=0, initial=np.nan), np.fmin.reduce(values, axis=0, initial=np.nan)


def _plain(column: Any) -> list[Any]:
    values = column.tolist() if isinstance(column, np.ndarray) else column
    return [None if one != one else one for one in values]
