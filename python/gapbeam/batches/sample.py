"""Random numbers for batches, by case: the same case has the same numbers, whatever is drawn before or beside it.

They come from the counter-based generator Philox (Salmon et al., Parallel random numbers: as easy as 1, 2, 3, SC 2011). The counter
is the number of the case, the key is made of the seed and the name of the column, so nothing has to be kept or drawn in turn.

>>> table = draw(3, {"supports.R-101.gap": normal(0.01, 0.002), "factors.wind": uniform(0.5, 1.0)}, seed=7)
>>> table.columns()["factors.wind"].round(3)
array([0.713, 0.7  , 0.885])
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..base.errors import SceneError
from ..results.state.arguments import finite, whole
from ..scene.wording import shown
from .quantile import normal_quantile

BITS = 53
METHODS = ("random", "latin-hypercube")


@dataclass(frozen=True)
class Distribution:
    """How a number is distributed.

    Attributes
    ----------
    kind : {"normal", "lognormal", "uniform"}
        Its kind.
    a, b : float
        Mean and standard deviation (lognormal: of the logarithm), or the ends.
    """

    kind: str
    a: float
    b: float

    def numbers(self, standard: np.ndarray | None, share: np.ndarray) -> np.ndarray:
        """Give numbers of this distribution.

        Parameters
        ----------
        standard : numpy.ndarray or None
            Standard normal numbers; None to make them of `share`.
        share : numpy.ndarray
            Which share of all numbers lies below, between 0 and 1.

        Returns
        -------
        numpy.ndarray
        """
        if self.kind == "uniform":
            if standard is not None:
                share = np.array([0.5 * math.erfc(-z / math.sqrt(2.0)) for z in standard.tolist()])
            return self.a + (self.b - self.a) * share
        found = self.a + self.b * (normal_quantile(share) if standard is None else standard)
        # The C library's exponential: numpy's has other last digits on other processors
        return np.array(list(map(math.exp, found.tolist()))) if self.kind == "lognormal" else found


def normal(mean: float, deviation: float) -> Distribution:
    """Give a normal distribution.

    Parameters
    ----------
    mean, deviation : float
        Mean and standard deviation.

    Returns
    -------
    Distribution
    """
    return Distribution("normal", finite("mean", mean), _deviation(deviation))


def lognormal(mean: float, deviation: float) -> Distribution:
    """Give a lognormal distribution.

    Parameters
    ----------
    mean, deviation : float
        Mean and standard deviation of the numbers themselves, not of their logarithms.

    Returns
    -------
    Distribution
    """
    mean, deviation = finite("mean", mean), _deviation(deviation)
    if mean <= 0.0:
        raise ValueError(f"mean: lognormal numbers are positive, so their mean is; got {mean:g}")
    variance = math.log1p((deviation / mean) ** 2)
    return Distribution("lognormal", math.log(mean) - 0.5 * variance, math.sqrt(variance))


def uniform(low: float, high: float) -> Distribution:
    """Give a uniform distribution.

    Parameters
    ----------
    low, high : float
        Its ends.

    Returns
    -------
    Distribution
    """
    low, high = finite("low", low), finite("high", high)
    if not low <= high or not math.isfinite(high - low):
        raise ValueError(f"high: expected a number from {low:g} on, got {high:g}")
    return Distribution("uniform", low, high)


def _deviation(value: float) -> float:
    value = finite("deviation", value)
    if value < 0.0:
        raise ValueError(f"deviation: expected 0 or a positive number, got {value:g}")
    return value


@dataclass(frozen=True)
class DrawnRows:
    """Some cases, as numbers only where they are solved."""

    of: Draws
    first: int
    stop: int

    def __len__(self) -> int:
        """Count them."""
        return self.stop - self.first

    def columns(self) -> tuple[np.ndarray, dict[int, str]]:
        """Draw the numbers, columns by rows; nothing is wrong with them."""
        return self.of.numbers(self.first, self.stop), {}


@dataclass(frozen=True, eq=False)
class Draws:
    """A table of random numbers, a case a row, for `gapbeam.batch`; it takes no memory.

    Attributes
    ----------
    cases : int
        Number of rows.
    """

    cases: int
    distributions: dict[str, Distribution]
    seed: int
    factor: np.ndarray | None
    method: str
    _strata: np.ndarray | None = field(default=None, repr=False)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the columns."""
        return tuple(self.distributions)

    @property
    def digest(self) -> str:
        """Hexadecimal; other draws have another one."""
        factor = None if self.factor is None else self.factor.tolist()
        return hashlib.sha256(repr((self.cases, self.distributions, self.seed, factor, self.method)).encode()).hexdigest()

    def rows(self, first: int, stop: int) -> DrawnRows | Any:
        """Give the rows from first to stop, which is left out."""
        if self._strata is None:
            return DrawnRows(self, first, stop)
        from .tables import Numbers

        return Numbers(self.numbers(first, stop))

    def columns(self) -> dict[str, np.ndarray]:
        """Give all numbers.

        Returns
        -------
        dict of numpy.ndarray
            By column.
        """
        return dict(zip(self.names, self.numbers(0, self.cases), strict=True))

    def numbers(self, first: int, stop: int) -> np.ndarray:
        """Give the numbers of some cases.

        Parameters
        ----------
        first, stop : int
            The first case, and the one after the last.

        Returns
        -------
        numpy.ndarray
            Columns by cases.
        """
        if self._strata is not None:
            shares = list(self._strata[first:stop].T)
        else:
            shares = [_shares(self.seed, name, first, stop) for name in self.names]
        if self.factor is None:
            return np.array([one.numbers(None, share) for one, share in zip(self.distributions.values(), shares, strict=True)])
        independent = [normal_quantile(share) for share in shares]
        found = []
        for row, one in zip(self.factor.tolist(), self.distributions.values(), strict=True):
            standard = np.zeros(stop - first)
            for weight, part in zip(row, independent, strict=True):  # in this order, by no library that has another one
                if weight:
                    standard = standard + weight * part
            found.append(one.numbers(standard, shares[0]))
        return np.array(found)


def draw(
    cases: int, columns: Mapping[str, Distribution], *, seed: int = 0,
    correlation: Mapping[tuple[str, str], float] | None = None, method: str = "random",
) -> Draws:  # fmt: skip
    """Draw random numbers for a batch.

    Parameters
    ----------
    cases : int
        How many rows.
    columns : mapping
        A distribution for each column: `normal`, `lognormal`, `uniform`.
    seed : int
        Another one gives other numbers.
    correlation : mapping, optional
        By pairs of columns the correlation of the normal numbers behind them (Gaussian copula; of normal columns it is their own),
        pairs that are left out 0.
    method : {"random", "latin-hypercube"}
        A Latin hypercube (McKay, Beckman and Conover, 1979) has one case in each of as many strata of every column; it comes from
        scipy, and all of it is in memory.

    Returns
    -------
    Draws
        A table whose numbers are made when they are needed. The number of a case and column depends on seed, column and
        correlation, not on how many cases or other columns there are (but with a Latin hypercube).

    Raises
    ------
    ValueError
        Something of another kind; correlations that cannot be.

    Examples
    --------
    >>> table = draw(1000, {"a": normal(0.0, 1.0), "b": lognormal(2.0, 0.5)}, correlation={("a", "b"): 0.8})
    >>> a, b = table.columns().values()
    >>> round(float(np.corrcoef(a, np.log(b))[0, 1]), 2)
    0.81
    """
    cases, seed = whole("cases", cases, least=1), whole("seed", seed, least=0)
    for name, one in columns.items():
        if not isinstance(name, str) or not isinstance(one, Distribution):
            raise ValueError(f"columns: expected a distribution for each column by its name, got {shown(name)}: {shown(one)}")
    if method not in METHODS:
        raise ValueError(f'method: expected "random" or "latin-hypercube", got {shown(method)}')
    factor = None if not correlation else _factor(list(columns), correlation)
    strata = None
    if method == "latin-hypercube":
        try:
            from scipy.stats.qmc import LatinHypercube
        except ModuleNotFoundError:
            raise SceneError("method", '"latin-hypercube" needs scipy: pip install scipy, or take "random"') from None
        strata = LatinHypercube(len(columns), seed=seed).random(cases)
        strata = np.clip(strata, 0.5**BITS, 1.0 - 0.5**BITS)
    return Draws(cases, dict(columns), seed, factor, method, strata)


def _shares(seed: int, name: str, first: int, stop: int) -> np.ndarray:
    """Independent numbers between 0 and 1, ends left out, of a column."""
    key = hashlib.sha256(f"{seed} {name}".encode()).digest()
    generator = np.random.Philox(counter=first // 4, key=np.frombuffer(key[:16], dtype="<u8").astype(np.uint64))
    raw = generator.random_raw(stop - first // 4 * 4)[first % 4 :]  # four numbers a count
    return ((raw >> np.uint64(64 - BITS)).astype(float) + 0.5) * 0.5**BITS


def _factor(names: list[str], correlation: Mapping[tuple[str, str], float]) -> np.ndarray:
    """Cholesky's factor of the matrix of correlations."""
    matrix = np.eye(len(names))
    for pair, value in correlation.items():
        try:
            i, j = (names.index(name) for name in pair)
        except (TypeError, ValueError):
            raise ValueError(f"correlation: expected pairs of columns, got {shown(pair)}") from None
        value = finite("correlation", value)
        if i == j or abs(value) > 1.0:
            raise ValueError(f"correlation: expected a number from -1 to 1 for two columns, got {value:g} for {shown(pair)}")
        matrix[i, j] = matrix[j, i] = value
    factor = np.zeros_like(matrix)
    for i in range(len(names)):
        for j in range(i + 1):
            rest = matrix[i, j] - math.fsum(factor[i, k] * factor[j, k] for k in range(j))
            if i == j:
                if rest < -1e-12:
                    raise ValueError(f"correlation: no numbers have all of these, up to those of {shown(names[i])}; take less")
                factor[i, i] = math.sqrt(max(rest, 0.0))
            elif factor[j, j] > 1e-8:
                factor[i, j] = rest / factor[j, j]
            elif abs(rest) > 1e-8:  # column j follows from those before it, and so does what it has in common with i
                raise ValueError(f"correlation: no numbers have all of these, up to those of {shown(names[i])}; take less")
    return factor
