"""Envelopes: largest and smallest values over combinations, where they come from, and what goes with them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar, overload

import numpy as np

from ...base.records import Record
from ...engine.quantities import FIELDS
from ..state.state_extremes import StateExtreme
from ..views.extreme import Extreme, Extremes, Source
from .ground_envelope import GroundExtreme, find_ground_extremes
from .tables import curves_with_sources, support_places
from .verbs import PartVerbs

if TYPE_CHECKING:
    from ..result import Result
    from ..state.step import Step

AT_SUPPORTS = ("reaction", "deflection", "opening", "couple")
"""Rows of the values at supports."""
OF_SUPPORTS = ("reaction", "opening", "deflection")
"""What an envelope tells of every support."""
EQUAL = 1e-12
"""Share of the largest value along the beam by which curves of combinations that coincide differ."""
NEAR = 10.0
"""How many error bounds from an extreme another combination is looked at for a tie."""


class EnvelopeExtreme(Extreme):
    """The largest or smallest value of a quantity over all combinations, or over the loading history.

    Its attributes are those of `Extreme`.
    """

    def __init__(self, of: Envelope, quantity: str, values: np.ndarray, which: int, x: float, support: int | None, sign: int):
        super().__init__(quantity, float(values[which]), x, of.sources[which], support)
        self._of, self._values, self._which, self._sign = of, values, which, sign

    @property
    def result(self) -> Result:
        """The result of that combination."""
        return self._of._result_of(self._which)

    @property
    def state(self) -> Step:
        """The state in which it is the value."""
        return self._of._state_of(self._which)

    @cached_property
    def ties(self) -> tuple[Source, ...]:
        """All sources of this value, the first one included: those whose values differ by no more than their error bounds."""
        bound = self._of._bound(self._which, self.quantity)
        away = self._sign * (self.value - self._values)
        found = []
        for k in np.flatnonzero(away <= NEAR * bound).tolist():
            if away[k] <= 0.0 or away[k] <= bound + self._of._bound(k, self.quantity):
                found.append(self._of.sources[k])
        return tuple(found)

    @cached_property
    def concurrent(self) -> dict[str, float]:
        """What the other quantities are there, in the combination it comes from.

        Of a field the others at the same place, on the side of the extreme; of a support what else it has.
        """
        if self.support is not None:
            rows = self._of.at_supports[self._which, :, self.support].tolist()
            return {name: value for name, value in zip(AT_SUPPORTS, rows, strict=True) if name != self.quantity}
        return StateExtreme(self.state, self.result._beam, self.quantity, self.value, self.x, self.source).concurrent

    def to_dict(self) -> dict[str, Any]:
        """As plain data: its source, all that tie with it, and the concurrent values.

        Returns
        -------
        dict
        """
        ties = {"ties": [one.to_dict() for one in self.ties if one != self.source]} if len(self.ties) > 1 else {}
        return {**self.source.to_dict(), **ties, "concurrent": self.concurrent}


@dataclass(frozen=True, eq=False)
class Curves(Record):
    """Largest and smallest values of every field along the beam.

    Attributes
    ----------
    x : numpy.ndarray
        Places; where something changes twice: the values left of it, then those right of it.
    largest, smallest : dict
        By field, an array with a value for every place.
    largest_of, smallest_of : dict
        By field, for every place the number of the combination that gives the value: the first one of those that coincide
        there but for rounding.
    """

    x: np.ndarray
    largest: dict[str, np.ndarray]
    smallest: dict[str, np.ndarray]
    largest_of: dict[str, np.ndarray]
    smallest_of: dict[str, np.ndarray]
    _beside: ClassVar = {"max_of": "largest_of", "min_of": "smallest_of"}

    def columns(self) -> dict[str, np.ndarray]:
        """As columns of a table, for example for pandas.

        Returns
        -------
        dict
            ``x``, and of every field its largest and smallest values, as ``moment_max`` and ``moment_min``.
        """
        found = {"x": self.x}
        for name in self.largest:
            found |= {f"{name}_max": self.largest[name], f"{name}_min": self.smallest[name]}
        return found

    def to_dict(self) -> dict[str, Any]:
        """As plain data, in the form of the JSON output; None for what is no number."""
        tables = {"max": self.largest, "min": self.smallest} | {key: getattr(self, name) for key, name in self._beside.items()}
        fields = {name: {key: _numbers(of[name]) for key, of in tables.items()} for name in self.largest}
        return {"x": self.x.tolist(), **fields}


class SupportExtremes(Sequence):
    """Extremes at the supports of a scene, each made when it is looked at.

    Parameters
    ----------
    of : Envelope
        Whose they are.
    """

    def __init__(self, of: Envelope):
        self._of = of
        self._x = of.scene.positions(of.scene.supports)
        self._rows = [AT_SUPPORTS.index(name) for name in OF_SUPPORTS]
        values = of.at_supports[:, self._rows]
        self._of_all = {
            kind: best(values, axis=0) if len(self._x) else np.zeros((len(self._rows), 0), int)
            for kind, best in (("max", np.nanargmax), ("min", np.nanargmin))
        }

    def __len__(self) -> int:
        """Count the supports."""
        return len(self._x)

    @overload
    def __getitem__(self, index: int) -> dict[str, dict[str, Extreme]]: ...

    @overload
    def __getitem__(self, index: slice) -> list[dict[str, dict[str, Extreme]]]: ...

    def __getitem__(self, index: int | slice) -> Any:
        """Give the extremes of a support: by quantity, then by ``max`` and ``min``."""
        if isinstance(index, slice):
            return [self[k] for k in range(len(self))[index]]
        k = range(len(self))[index]
        return {
            name: {
                kind: EnvelopeExtreme(self._of, name, self._of.at_supports[:, row, k], int(which[i, k]), float(self._x[k]), k, sign)
                for (kind, which), sign in zip(self._of_all.items(), (1, -1), strict=True)
            }
            for i, (name, row) in enumerate(zip(OF_SUPPORTS, self._rows, strict=True))
        }

    def values(self, quantity: str, kind: str) -> np.ndarray:
        """As `SupportRows.values`: the largest or smallest value of every support."""
        i = OF_SUPPORTS.index(quantity)
        return self._of.at_supports[self._of_all[kind][i], self._rows[i], np.arange(len(self))]

    def columns(self) -> dict[str, Any]:
        """As columns of a table, for example for pandas.

        Returns
        -------
        dict
            ``support`` (name or number), ``x``, and of every quantity ``reaction_max`` and ``reaction_min``, in a scene with
            combinations each with the first one it comes from, ``reaction_max_combination``; over the loading history with
            ``reaction_max_factor`` and ``reaction_max_leg``.
        """
        found = support_places(self._of.scene)
        for i, name in enumerate(OF_SUPPORTS):
            for kind, which in self._of_all.items():
                found[f"{name}_{kind}"] = self.values(name, kind)
                for key in self._of._keys:
                    found[f"{name}_{kind}_{key}"] = [getattr(self._of.sources[k], key) for k in which[i].tolist()]
        return found


class Envelope(PartVerbs):
    """Largest and smallest values over all combinations that are solved, each at its full load; never floored at zero.

    It has the verbs of results, with largest and smallest values. Its status is that of the result.

    Attributes
    ----------
    sources : list of Source
        Where values may come from: the combinations.
    limit_state : str or None
        The limit state whose combinations count; None: all.
    """

    limit_state: str | None = None

    def __init__(
        self, result: Result, fields: dict[str, int], sources: Sequence[Source], at_supports: np.ndarray, extremes: np.ndarray,
        places: np.ndarray, result_of: Callable[[int], Result],
        curves: Callable[[], tuple[np.ndarray, Iterator[tuple[slice, np.ndarray]]]], on_both_sides: bool,
        state_of: Callable[[int], Step] | None = None, keys: Sequence[str] | None = None,
    ):  # fmt: skip
        self._result, self.sources, self.at_supports = result, list(sources), at_supports
        self._result_of, self._given_state = result_of, state_of
        # What of a source tells where a value comes from
        self._keys = (["combination"] if result.scene.combinations else []) if keys is None else keys
        self._fields, self._values, self._places, self._make = fields, extremes, places, curves
        self._on_both_sides = on_both_sides  # are the second half of the curves' places the first ones again, from the left
        self._bounds: dict[int, dict[str, float]] = {}
        if not np.isfinite(extremes[:, 2, 0]).any():
            raise ValueError("no combination is solved, so there is no envelope")

    @property
    def _solved(self) -> list[int]:
        """Sources that count."""
        return np.flatnonzero(np.isfinite(self._values[:, 2, 0])).tolist()

    def _state_of(self, k: int) -> Step:
        """Give the state of a source."""
        return self._result_of(k).steps[-1] if self._given_state is None else self._given_state(k)

    def _seen_states(self) -> Iterator[tuple[str, ...]]:
        return (self._state_of(k).state for k in self._solved)

    renamed: ClassVar = {"bound": "_bound", "result_of": "_result_of", "state_of": "_state_of", "keys": "_keys"}

    def _curves_at(self, x: Any) -> Curves:
        return self._result.envelope(x=x, **({} if self.limit_state is None else {"limit_state": self.limit_state})).fields

    def _bound(self, k: int, quantity: str) -> float:
        """Give the error bound of a quantity in a combination.

        Parameters
        ----------
        k : int
            Number of the combination.
        quantity : str
            Of a field or of supports; where nothing is known 0.
        """
        if k not in self._bounds:
            bounds = self._state_of(k).error_bounds
            self._bounds[k] = {name: bound or 0.0 for name, bound in bounds.items()}
        return self._bounds[k].get("deflection" if quantity == "opening" else quantity, 0.0)

    @cached_property
    def extremes(self) -> Extremes:
        """Exact extremes of every field, by ``max`` and ``min``."""
        return Extremes(self._find_extremes)

    def _find_extremes(self) -> dict[str, dict[str, Extreme]]:
        found: dict[str, dict[str, Extreme]] = {}
        for name, column in self._fields.items():
            found[name] = {}
            for row, (kind, best, sign) in enumerate((("max", np.nanargmax, 1), ("min", np.nanargmin, -1))):
                values = self._values[:, column, row]
                k = int(best(values))
                found[name][kind] = EnvelopeExtreme(self, name, values, k, float(self._places[k, column, row]), None, sign)
        return found

    @cached_property
    def supports(self) -> SupportExtremes:
        """Extremes at every support, in the order of the scene: reaction, opening and deflection, each by ``max`` and ``min``."""
        return SupportExtremes(self)

    @cached_property
    def foundations(self) -> list[dict[str, dict[str, GroundExtreme | None]]]:
        """Extremes of every foundation, in the order of the scene.

        ``resultant`` by ``max`` and ``min``, ``free_span`` by ``longest`` and ``deepest`` (None where the beam lies on the
        foundation everywhere and always). Every combination is looked at, so each is solved once more.
        """
        return find_ground_extremes(self, self._solved) if self.scene.foundation else []

    @cached_property
    def fields(self) -> Curves:
        """Largest and smallest values of every field along the beam."""
        x, parts = self._make()
        shape = 2, len(x), len(FIELDS)
        best, of = np.full(shape, np.nan), np.zeros(shape, dtype=np.int32)
        equal = np.broadcast_to(EQUAL * np.fmax.reduce(np.abs(self._values), axis=(0, 2)), shape[1:])
        for part, values in parts:
            for row, (extreme, sign) in enumerate(((np.fmax, 1.0), (np.fmin, -1.0))):
                there = extreme.reduce(values, axis=0)  # passes over what is not a number
                better = (sign * (there - best[row]) > equal) | (np.isnan(best[row]) & ~np.isnan(there))
                if better.any():
                    near = sign * (there[better] - values[:, better]) <= equal[better]
                    of[row][better] = part.start + near.argmax(axis=0)
                best[row] = extreme(best[row], there)
        if self._on_both_sides:
            x, best, of = _joined(x, best, of)
        names = self._fields.items()
        tables = [{name: table[row][:, column].copy() for name, column in names} for table in (best, of) for row in (0, 1)]
        return Curves(x, *tables)

    def columns(self) -> dict[str, Any]:
        """The curves as columns of a table, for example for pandas.

        Returns
        -------
        dict
            ``x``, of every field its largest and smallest values (``moment_max``), and in a scene with combinations the one that
            gives them (``moment_max_combination``); over the loading history ``moment_max_factor`` and ``moment_max_leg``.
        """
        return curves_with_sources(self.fields, self.sources, self._keys)


def _numbers(values: np.ndarray) -> list[float | None]:
    return [value if np.isfinite(value) else None for value in values.tolist()]


def _joined(x: np.ndarray, best: np.ndarray, of: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Of two values at every place the larger one, or the smaller one."""
    n = len(x) // 2
    first, second = best[:, :n], best[:, n:]
    later = np.stack((second[0] > first[0], second[1] < first[1]))
    return x[:n], np.where(later, second, first), np.where(later, of[:, n:], of[:, :n])
