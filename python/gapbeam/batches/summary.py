"""Distributions of results: exact counts and exact quantiles, with the memory of one chunk, also while a batch runs.

A quantile is a result: the smallest one that at least that share of all are not greater than. It is found digit by digit: the order
of doubles is that of their bits, so counting the first 16 bits tells where it lies, and three more rounds which one it is.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ..base.errors import SceneError
from ..base.records import Record
from ..results.state.arguments import finite, numbers, whole
from ..scene.wording import shown
from .verbs import SummaryVerbs

if TYPE_CHECKING:
    from .batch import Batch

SHARES, BINS = (0.01, 0.5, 0.99), 40
DIGIT = 16
"""Bits that are counted at a time."""
SIGN = np.uint64(2**63)


@dataclass(frozen=True, eq=False)
class Distribution(Record):
    """How a result is distributed over the cases that are solved.

    Attributes
    ----------
    count : int
        Of them.
    mean, deviation : float
        Mean and standard deviation.
    least, largest : float
        The smallest and the largest one.
    quantiles : dict of float
        By share the smallest result that at least this share of all are not greater than.
    edges, counts : numpy.ndarray
        A histogram: how many lie between two edges; the last part holds its upper edge too.
    above : dict of int
        By limit how many are greater.
    positive : int
        How many are greater than zero; of an opening the cases without contact.
    """

    count: int
    mean: float
    deviation: float
    least: float
    largest: float
    quantiles: dict[float, float]
    edges: np.ndarray
    counts: np.ndarray
    above: dict[float, int]
    positive: int = 0


@dataclass(frozen=True, repr=False)
class Summary(SummaryVerbs):
    """What a batch has found so far; it has the verbs of results, with distributions.

    Attributes
    ----------
    cases, done : int
        Cases of the table, and those that are done.
    statuses : dict of int
        Of these by outcome.
    reasons : dict of str
        By outcome the reason of the first such case.
    columns : dict of Distribution
        By name of the result.
    units : dict of (str, float)
        By name of the result its unit in pictures, and how many of it are one of the scene: 1000 for mm where lengths are in m.
    """

    cases: int
    done: int
    statuses: dict[str, int]
    reasons: dict[str, str]
    columns: dict[str, Distribution]
    units: dict[str, tuple[str, float]] = field(default_factory=dict)

    renamed: ClassVar = {"asdict": "to_dict"}

    def to_dict(self) -> dict[str, Any]:
        """As plain data.

        Returns
        -------
        dict
            Only numbers, strings, lists and dicts; shares and limits as texts. Results that no case has are left out.
        """
        return {
            "cases": self.cases, "done": self.done, "statuses": self.statuses, "reasons": self.reasons,
            "columns": {
                name: {
                    "count": one.count, "mean": one.mean, "deviation": one.deviation, "least": one.least, "largest": one.largest,
                    "quantiles": {repr(share): value for share, value in one.quantiles.items()},
                    "edges": one.edges.tolist(), "counts": one.counts.tolist(),
                    "above": {repr(limit): count for limit, count in one.above.items()},
                }
                for name, one in self.columns.items()
                if one.count
            },
        }  # fmt: skip


def summarize(
    batch: Batch, names: Iterable[str] | None = None, *, shares: Sequence[float] = SHARES,
    limits: Mapping[str, float | Sequence[float]] | None = None, bins: int = BINS,
) -> Summary:  # fmt: skip
    """Tell how results are distributed, of the cases that are done so far.

    Parameters
    ----------
    batch : Batch
    names : iterable of str, optional
        Of results; default all but the places of extremes.
    shares : sequence of float
        Which quantiles, between 0 and 1.
    limits : mapping, optional
        By name of a result one or more limits, to count the cases above.
    bins : int
        Parts of the histograms.

    Raises
    ------
    SceneError
        There is no such result, or nothing is done.
    ValueError
        A share outside 0 to 1, or something that is no number.
    """
    names = [name for name in batch.results if not name.endswith("_x")] if names is None else list(names)
    wanted = {name: [finite("limits", one) for one in np.ravel(values).tolist()] for name, values in (limits or {}).items()}
    names = tuple(dict.fromkeys((*names, *wanted)))
    for name in names:
        if name not in batch.numbers and name in batch.columns:
            raise SceneError(str(batch.path), f"column {shown(name)} holds no numbers")
    for share in numbers("shares", shares).ravel().tolist():
        if not 0.0 <= share <= 1.0:
            raise ValueError(f"shares: expected numbers from 0 to 1, got {share:g}")
    bins = whole("bins", bins, least=1)
    counters = {name: _Counter(wanted.get(name, []), [float(share) for share in shares], bins) for name in names}

    def parts() -> Iterator[dict[str, np.ndarray]]:
        for part in batch.chunks(names):
            for name in counters:
                if np.isinf(part[name]).any():
                    raise SceneError(str(batch.path), f"column {shown(name)} holds infinite numbers, which have no distribution")
            yield part

    _count(counters, parts)
    columns = {name: counter.found() for name, counter in counters.items()}
    units = {name: found for name in columns if (found := batch.unit(name)) is not None}
    return Summary(batch.cases, batch.done, batch.statuses(), batch.reasons(), columns, units)


def distribution(values: np.ndarray) -> Distribution:
    """Tell how numbers are distributed; what is not a number does not count.

    Parameters
    ----------
    values : numpy.ndarray
        The numbers.
    """
    counter = _Counter([], list(SHARES), BINS)
    _count({"": counter}, lambda: [{"": values}])
    return counter.found()


def _count(counters: dict[str, _Counter], parts: Callable[[], Iterable[Mapping[str, np.ndarray]]]) -> None:
    """Go through all numbers in rounds: once for their range, then once for every digit."""
    for part in parts():
        for name, counter in counters.items():
            counter.range(part[name])
    for counter in counters.values():
        counter.divide()
    for digit in range(64 // DIGIT):
        for part in parts():
            for name, counter in counters.items():
                counter.count_digit(part[name], digit)
        for counter in counters.values():
            counter.choose_digit()


class _Counter:
    """Counts one result, chunk by chunk and round by round."""

    def __init__(self, limits: list[float], shares: list[float], bins: int):
        self._above = dict.fromkeys(limits, 0)
        self._shares, self._bins = shares, bins
        self._count, self._least, self._largest, self._sums = 0, math.inf, -math.inf, []
        self._positive = 0
        self._squares: list[float] = []

    def range(self, values: np.ndarray) -> None:
        """Count, add up, find the ends."""
        values = values[~np.isnan(values)]
        if not len(values):
            return
        self._count += len(values)
        self._sums.append(float(values.sum()))
        self._least = min(self._least, float(values.min()))
        self._largest = max(self._largest, float(values.max()))
        self._positive += int((values > 0.0).sum())
        for limit in self._above:
            self._above[limit] += int((values > limit).sum())

    def divide(self) -> None:
        """Divide the range into the parts of the histogram, and see which places quantiles have in the order of all."""
        self._mean = math.fsum(self._sums) / self._count if self._count else math.nan
        ends = (self._least, self._largest) if self._count else (math.nan, math.nan)
        self._edges = np.linspace(*ends, self._bins + 1)
        self._edges[-1] = ends[1]
        self._counts = np.zeros(self._bins, dtype=np.int64)
        self._ranks = [min(max(math.ceil(share * self._count), 1), self._count) for share in self._shares]
        self._prefixes = [0] * len(self._shares)
        self._digits = {0: np.zeros(2**DIGIT, dtype=np.int64)}

    def count_digit(self, values: np.ndarray, digit: int) -> None:
        """Count the next bits of what has the bits that are known; in the first round also the histogram."""
        values = values[~np.isnan(values)]
        if not len(values):
            return
        if digit == 0:
            self._squares.append(float(((values - self._mean) ** 2).sum()))
            at = np.clip(np.searchsorted(self._edges, values, "right") - 1, 0, self._bins - 1)
            self._counts += np.bincount(at, minlength=self._bins)
        bits = (values + 0.0).view(np.uint64)  # + 0.0: there is one zero
        ordered = np.where(bits & SIGN, ~bits, bits | SIGN)
        rest = 64 - DIGIT * (digit + 1)
        for prefix, counts in self._digits.items():
            same = ordered if digit == 0 else ordered[ordered >> np.uint64(rest + DIGIT) == np.uint64(prefix)]
            counts += np.bincount((same >> np.uint64(rest)).astype(np.int64) & (2**DIGIT - 1), minlength=2**DIGIT)

    def choose_digit(self) -> None:
        """Choose the next bits of every quantile."""
        if not self._count:
            return
        for k, prefix in enumerate(self._prefixes):
            up_to = np.cumsum(self._digits[prefix])
            digit = int(np.searchsorted(up_to, self._ranks[k]))
            self._ranks[k] -= int(up_to[digit - 1]) if digit else 0
            self._prefixes[k] = (prefix << DIGIT) | digit
        self._digits = {prefix: np.zeros(2**DIGIT, dtype=np.int64) for prefix in self._prefixes}

    def found(self) -> Distribution:
        """Give what was counted."""
        if not self._count:
            nothing = dict.fromkeys(self._shares, math.nan)
            return Distribution(0, math.nan, math.nan, math.nan, math.nan, nothing, self._edges, self._counts, self._above)
        ordered = np.array(self._prefixes, dtype=np.uint64)
        values = np.where(ordered & SIGN, ordered & ~SIGN, ~ordered).view(float).tolist()
        deviation = math.sqrt(math.fsum(self._squares) / max(self._count - 1, 1))
        return Distribution(
            self._count, self._mean, deviation, self._least, self._largest, dict(zip(self._shares, values, strict=True)),
            self._edges, self._counts, self._above, self._positive,
        )  # fmt: skip
