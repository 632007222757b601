"""The verbs of results for a batch and its summary: what is one number of a result is an array, or a distribution, here."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ..results.envelopes.lifted import Lifted
from ..results.views.columns import Columns, one_of
from ..results.views.extreme import Extreme, Extremes, Source
from ..results.views.labelled import Labelled
from ..results.views.shown import Shown
from .scene_cases import AT_SUPPORTS

if TYPE_CHECKING:
    from .summary import Distribution

WORST = ("solved", "limit-load", "buckles", "no-equilibrium", "no-answer", "refused", "failed")
"""Outcomes of cases, the worst last: that is the outcome of a batch."""


class Lazy(Sequence):
    """Values that are made when they are looked at.

    Parameters
    ----------
    make : callable
        Makes the value of a key.
    keys : sequence of str
        The keys.
    """

    def __init__(self, make: Callable[[str], Any], keys: Sequence[str]) -> None:
        self._make, self._keys = make, keys

    def __len__(self) -> int:
        """Count the values."""
        return len(self._keys)

    def __getitem__(self, k: Any) -> Any:
        """Make a value, or those of a slice."""
        return [self._make(key) for key in self._keys[k]] if isinstance(k, slice) else self._make(self._keys[k])


class ManyVerbs(Shown):
    """What is asked of the results of a table in the words of results."""

    meant: ClassVar = {
        "at": "gapbeam.solve(batch.scene_of(case)).at(x)", "state": "gapbeam.solve(batch.scene_of(case))",
        "result": "gapbeam.solve(batch.scene_of(case))", "historyextremes": "gapbeam.solve(batch.scene_of(case)).history_extremes",
    }  # fmt: skip

    @property
    def _outcomes(self) -> Mapping[str, int]:
        """Cases by outcome."""
        raise NotImplementedError

    @property
    def _reasons(self) -> Mapping[str, str]:
        """Reason of the first case of an outcome."""
        raise NotImplementedError

    @property
    def _there(self) -> Sequence[str]:
        """Names of the results."""
        raise NotImplementedError

    def _of(self, name: str) -> Any:
        """Give the array, or the distribution, of a result."""
        raise NotImplementedError

    @property
    def _drawn(self) -> Sequence[str]:
        """Names of the results, of which each can be drawn."""
        return self._there

    @property
    def status(self) -> str:
        """``solved`` if all cases that are done are; else the worst outcome of one."""
        outcomes = self._outcomes
        return max(outcomes, key=lambda one: WORST.index(one) if one in WORST else len(WORST)) if outcomes else "solved"

    @property
    def reason(self) -> str | None:
        """How many cases are not solved, and why the first of the worst is not; None where all are solved."""
        status = self.status
        if status == "solved":
            return None
        lost = sum(count for outcome, count in self._outcomes.items() if outcome != "solved")
        words = self._reasons.get(status)
        return f"{lost:,} of {sum(self._outcomes.values()):,} cases are not solved; {status}" + (f": {words}" if words else "")

    def _by_support(self, quantity: str) -> Labelled:
        names = [name for name in self._there if name.startswith(f"{quantity}.")]
        if not names:
            raise ValueError(f'the batch has no {quantity} of supports: take "{quantity}" into what is wanted when it is run')
        keys = [name.partition(".")[2] for name in names]
        return Labelled(quantity, "support", [int(key) if key.isdecimal() else key for key in keys], Lazy(self._of, names))

    def _openings(self) -> list[str]:
        """Names of the largest opening of every support."""
        names = [name for name in self._there if name.startswith("opening.")]
        if not names:
            self._by_support("opening")  # says what is missing
        if names == ["opening.max", "opening.min"]:
            raise ValueError("lifted: each scene of the folder has supports of its own; solve the one that the column scene names")
        largest = [name for name in names if name.endswith(".max")]
        of_envelope = sorted(names) == sorted([*largest, *(name.removesuffix(".max") + ".min" for name in largest)])
        return largest if of_envelope else names

    @property
    def extremes(self) -> Extremes:
        """Largest and smallest values of every field, by field, then by ``max`` and ``min``."""
        return Extremes(self._find_extremes)

    def _find_extremes(self) -> dict[str, dict[str, Any]]:
        found: dict[str, dict[str, Any]] = {}
        for name in self._there:
            field, _, kind = name.partition(".")
            if kind in ("max", "min") and field not in AT_SUPPORTS:  # of a support with such a name, or of a folder of scenes
                found.setdefault(field, {})[kind] = self._extreme(field, name)
        return found

    def _extreme(self, field: str, name: str) -> Any:
        return self._of(name)


class BatchVerbs(ManyVerbs):
    """Of a batch: arrays with an entry for every case that is done."""

    _kinds = ("cases", "results")

    @property
    def _outcomes(self) -> Mapping[str, int]:
        return self.statuses()

    @property
    def _reasons(self) -> Mapping[str, str]:
        return self.reasons()

    @property
    def _there(self) -> Sequence[str]:
        return self.results

    def _of(self, name: str) -> np.ndarray:
        return self.read(name)[name]

    def _extreme(self, field: str, name: str) -> Extreme:
        return BatchExtreme(self, field, name)

    @property
    def states(self) -> Labelled:
        """States by number and name of the support, an array of words for every case; None where one is not solved."""
        openings, supports = self.openings, self.scene.supports
        if self.scene.combinations or self.scene.trains:
            raise ValueError("states: there are many; take those of a case, gapbeam.solve(batch.scene_of(case)).states")
        if any(support.law is not None for support in supports):
            raise ValueError("states: some supports have laws; take those of a case, gapbeam.solve(batch.scene_of(case)).states")

        def words(k: str) -> np.ndarray:
            values = openings[int(k)]
            acts = "bilateral" if supports[int(k)].side == "both" else "closed"
            return np.where(np.isnan(values), None, np.where(values > 0.0, "open", acts))

        return Labelled("state", "support", openings.keys(), Lazy(words, list(map(str, range(len(openings))))))

    @property
    def lifted(self) -> list[Lifted]:
        """One-sided supports without contact: in which part of the solved cases, and in which the opening is largest."""
        names = self._openings()
        one_sided = [support.side != "both" for support in self.scene.supports]
        solved, counts = 0, np.zeros(len(names), dtype=np.int64)
        largest, cases = np.zeros(len(names)), np.zeros(len(names), dtype=np.int64)
        for part in self.chunks(["case", *names]):
            table = np.array([part[name] for name in names])
            solved += int(np.isfinite(table).all(axis=0).sum())
            open_ = np.where(np.isfinite(table), table, 0.0)
            counts += (open_ > 0.0).sum(axis=1)
            at = open_.argmax(axis=1)
            most = open_[np.arange(len(names)), at]
            cases = np.where(most > largest, part["case"][at], cases)
            largest = np.maximum(most, largest)
        return [
            Lifted(k, float(largest[k]), case=int(cases[k]), share=float(counts[k] / solved))
            for k in np.flatnonzero(counts).tolist() if one_sided[k]
        ]  # fmt: skip

    def table(self, kind: str = "cases") -> Columns:
        """Give a table.

        Parameters
        ----------
        kind : {"cases", "results"}
            A row for every case, or for every result with its mean and quantiles.

        Returns
        -------
        Columns
            As of `Shown.table`.
        """
        return Columns(self.read()) if one_of(kind, self._kinds) == "cases" else self.summary().table()

    def to_dict(self) -> dict[str, Any]:
        """The summary as plain data, as `Summary.to_dict`.

        Returns
        -------
        dict
        """
        return self.summary().to_dict()


class BatchExtreme(Extreme):
    """Largest or smallest values of a field, arrays with an entry for every case; its attributes are those of `Extreme`."""

    def __init__(self, batch: BatchVerbs, field: str, name: str):
        self._batch, self._name = batch, name
        self.quantity, self.source, self.support, self.foundation, self.span = field, Source(), None, None, None

    @cached_property
    def _pair(self) -> dict[str, np.ndarray]:
        return self._batch.read([self._name, f"{self._name}_x"])

    @property
    def value(self) -> np.ndarray:
        """The values."""
        return self._pair[self._name]

    @property
    def x(self) -> np.ndarray:
        """Their places."""
        return self._pair[f"{self._name}_x"]

    @property
    def concurrent(self) -> dict[str, np.ndarray]:
        """Refuse: a batch does not keep them."""
        raise ValueError("a batch does not keep what goes with an extreme; solve the case, gapbeam.solve(batch.scene_of(case))")


class SummaryVerbs(ManyVerbs):
    """Of a summary: distributions."""

    _kinds = ("results",)

    @property
    def _outcomes(self) -> Mapping[str, int]:
        return self.statuses

    @property
    def _reasons(self) -> Mapping[str, str]:
        return self.reasons

    @property
    def _there(self) -> Sequence[str]:
        return list(self.columns)

    def _of(self, name: str) -> Distribution:
        return self.columns[name]

    @property
    def lifted(self) -> list[Lifted]:
        """One-sided supports without contact: in which part of the cases, and the largest opening."""
        ones = [(k, self.columns[name]) for k, name in enumerate(self._openings())]
        return [Lifted(k, one.largest, share=one.positive / one.count) for k, one in ones if one.positive]

    def _only(self, name: str) -> SummaryVerbs:
        """Give the summary of one result."""
        return replace(self, columns={name: self.columns[name]})

    def table(self, kind: str = "results") -> Columns:
        """Give a table with a row for every result.

        Parameters
        ----------
        kind : {"results"}
            Mean, standard deviation, smallest and largest value, quantiles.

        Returns
        -------
        Columns
            As of `Shown.table`.
        """
        one_of(kind, self._kinds)
        ones = {name: one for name, one in self.columns.items() if one.count}
        table: dict[str, Any] = {"result": list(ones), "cases": [one.count for one in ones.values()]}
        for key in ("mean", "deviation", "least", "largest"):
            table[key] = np.array([getattr(one, key) for one in ones.values()])
        for share in next(iter(ones.values())).quantiles if ones else ():
            table[f"{100 * share:g} %"] = np.array([one.quantiles[share] for one in ones.values()])
        return Columns(table)
