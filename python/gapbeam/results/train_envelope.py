"""Largest and smallest values over all positions of trains, in every combination, and where they come from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from ..engine.beam import Beam
from ..engine.trains import SIDES, Extremes
from ..scene.names import names_of
from .arguments import numbers
from .envelope import AT_SUPPORTS, Curves
from .tables import KINDS, SupportRows, curves_with_sources

if TYPE_CHECKING:
    from .result import Result
    from .step import Step
    from .trains import Gap, TrainResult, TrainWay

FIELDS = ("deflection", "rotation", "moment", "shear")
"""Fields that have envelopes."""
OF_SUPPORTS = ("reaction", "opening", "deflection", "couple")
"""Values of supports that have them."""
EQUAL = 2.0**-40
"""Share of a value by which ties differ at most."""


class TrainExtreme:
    """A largest or smallest value, and where it comes from.

    Attributes
    ----------
    quantity : str
        For example ``moment`` or ``reaction``.
    value : float
        The value.
    x : float or None
        Place on the beam; None for a support.
    side : {"left", "right"} or None
        On which side of x it is the value, where an axle or a support is there.
    support : int or None
        Number of the support.
    combination : str or None
        Name of the combination; None in a scene without any.
    train : str or None
        Name of the train; None for the state of a combination in which no train acts.
    position : float or None
        Its position.
    direction : {"right", "left"} or None
        Which way it goes.
    ties : tuple of TrainExtreme
        Others with the same value.
    """

    def __init__(self, of: Member, quantity: str, value: float, x: float | None, side: str | None, support: int | None,
                 position: float | None):  # fmt: skip
        self.quantity, self.value, self.x, self.side, self.support, self.position = quantity, value, x, side, support, position
        self.combination, self.train, self.direction = of.combination, of.train, of.direction
        self.ties: tuple[TrainExtreme, ...] = ()
        self._of = of

    def __repr__(self) -> str:
        """Show value, place and source."""
        where = f" at x = {self.x:.6g}" if self.x is not None else f" of support {self.support}"
        return f"TrainExtreme({self.quantity} {self.value:.6g}{where}, {self.source()})"

    def __eq__(self, other: object) -> bool:
        """Whether values and sources are equal, those of the ties too."""
        if not isinstance(other, TrainExtreme):
            return NotImplemented
        return self._key() == other._key() and self.ties == other.ties

    __hash__ = None

    def _key(self) -> tuple:
        return self.quantity, self.value, self.x, self.support, self.source()

    @property
    def state(self) -> Step:
        """The state in which it is the value: with a train at its position one whose axles are forces."""
        return self._of.state(self.position)

    @cached_property
    def concurrent(self) -> dict[str, float]:
        """What the other quantities are there in this state.

        Of a field the others at the same place, on the side of the extreme; of a support what else it has.
        """
        if self.support is not None:
            rows = self.state.solution.at_supports[:, self.support].tolist()
            return {name: value for name, value in zip(AT_SUPPORTS, rows, strict=True) if name != self.quantity}
        there = self._of.fields(self.position, self.x, self.side or "right")
        return {name: value for name, value in there.items() if name not in ("x", self.quantity)}

    def source(self) -> dict[str, Any]:
        """Where it comes from, as plain data.

        Returns
        -------
        dict
            What is None is left out.
        """
        found = {"combination": self.combination, "train": self.train, "position": self.position, "direction": self.direction}
        found["side"] = self.side
        return {key: value for key, value in found.items() if value is not None}

    def to_dict(self) -> dict[str, Any]:
        """Where it comes from, all that tie with it, and the concurrent values, as plain data.

        Returns
        -------
        dict
        """
        ties = [({} if tie.x is None else {"x": tie.x}) | tie.source() for tie in self.ties]
        return {**self.source(), **({"ties": ties} if ties else {}), "concurrent": self.concurrent}


@dataclass(frozen=True, eq=False)
class TrainCurves(Curves):
    """Largest and smallest values along the beam, with positions; `largest_of`, `smallest_of` number the members of the envelope.

    Places that one chooses are there once. Values are not-a-number where no position is solved.

    Attributes
    ----------
    largest_at, smallest_at : dict
        By field, for every place the position of the train; not-a-number where no train acts.
    """

    largest_at: dict[str, np.ndarray]
    smallest_at: dict[str, np.ndarray]


class Member:
    """What an envelope is made of: the positions of a train in one direction, or the state of a combination without trains.

    Attributes
    ----------
    combination, train, direction : str or None
        Of what.
    gaps : list of Gap
        Positions that are not solved.
    """

    train: str | None = None
    direction: str | None = None

    def __init__(self, combination: str | None) -> None:
        self.combination = combination
        self.gaps: list[Gap] = []

    def of_fields(self, quantity: str, i: int) -> list[TrainExtreme]:
        """Give the largest (0) or smallest (1) values of a field, all that tie."""
        raise NotImplementedError

    def of_supports(self, support: int, quantity: str, i: int) -> list[TrainExtreme]:
        """Give the same of a support."""
        raise NotImplementedError

    def curves(self, piece: np.ndarray, distance: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Give largest and smallest fields at places, and positions, 2 by fields by places."""
        raise NotImplementedError

    def state(self, position: float | None) -> Step:
        """Give the state at a position."""
        raise NotImplementedError

    def fields(self, position: float | None, x: float, side: str) -> dict[str, float]:
        """Give all fields at a place in that state."""
        raise NotImplementedError


class Passing(Member):
    """A train that goes over the beam in one direction.

    Parameters
    ----------
    train : TrainResult
        The train.
    way : TrainWay
        One of its ways.
    combination : str, optional
        Name of the combination.
    """

    def __init__(self, train: TrainResult, way: TrainWay, combination: str | None = None):
        super().__init__(combination)
        self.train, self.direction, self.gaps = train.name, way.course.direction, way.gaps
        self._train, self._way = train, way
        self._fields, self._supports = way.extremes

    def of_fields(self, quantity: str, i: int) -> list[TrainExtreme]:
        """As `Member.of_fields`."""
        return self._ties(self._fields, quantity, FIELDS.index(quantity), i, None)

    def of_supports(self, support: int, quantity: str, i: int) -> list[TrainExtreme]:
        """As `Member.of_supports`."""
        return self._ties(self._supports[support], quantity, OF_SUPPORTS.index(quantity), i, support)

    def _ties(self, found: Extremes, quantity: str, k: int, i: int, support: int | None) -> list[TrainExtreme]:
        count = int(found.count[i, k])
        rows = zip(found.values[i, k, :count].tolist(), found.sides[i, k, :count].tolist(), strict=True)
        return [
            TrainExtreme(self, quantity, value, x if support is None else None, SIDES[side], support, position)
            for (value, x, position), side in rows
        ]

    def curves(self, piece: np.ndarray, distance: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """As `Member.curves`."""
        return self._way.passage.curves(piece, distance)

    def state(self, position: float | None) -> Step:
        """As `Member.state`."""
        return self._train.at(position, self.direction)

    def fields(self, position: float | None, x: float, side: str) -> dict[str, float]:
        """As `Member.fields`."""
        return {name: float(value) for name, value in self.state(position).fields(x, side).columns().items()}


class Standing(Member):
    """A combination in which no train acts.

    Parameters
    ----------
    result : Result
        A solved one.
    combination : str
        Its name.
    """

    def __init__(self, result: Result, combination: str):
        super().__init__(combination)
        self._result = result
        self._extremes = result.extremes()

    def of_fields(self, quantity: str, i: int) -> list[TrainExtreme]:
        """As `Member.of_fields`."""
        value, x = self._extremes[quantity][KINDS[i]]
        side = None
        if abs(self.fields(None, x, "right")[quantity] - value) > abs(self.fields(None, x, "left")[quantity] - value):
            side = "left"
        return [TrainExtreme(self, quantity, value, x, side, None, None)]

    def of_supports(self, support: int, quantity: str, i: int) -> list[TrainExtreme]:
        """As `Member.of_supports`."""
        value = float(self.state(None).solution.at_supports[AT_SUPPORTS.index(quantity), support])
        return [TrainExtreme(self, quantity, value, None, None, support, None)]

    def curves(self, piece: np.ndarray, distance: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """As `Member.curves`."""
        step, beam = self._result.steps[-1], self._result.beam
        values = beam.values(step.factor, step.starts, step.solution, piece, distance)
        found = np.array([values[beam.fields[name]] for name in FIELDS])
        return np.stack((found, found)), np.full((2, *found.shape), np.nan)

    def state(self, position: float | None) -> Step:
        """As `Member.state`."""
        return self._result.steps[-1]

    def fields(self, position: float | None, x: float, side: str) -> dict[str, float]:
        """As `Member.fields`."""
        return {name: float(value) for name, value in self._result.at(x, side=side).columns().items()}


class TrainEnvelope:
    """Largest and smallest values over all positions of trains; never floored at zero. Trains pass one at a time.

    A state in which no train acts is in it only where a combination gives its case no factor.

    Attributes
    ----------
    members : list of Member
        What it is made of.
    extremes : dict
        ``{"moment": {"max": TrainExtreme, "min": TrainExtreme}, ...}`` of the whole beam, exact in place and position; None
        where nothing is solved.
    supports : list of dict
        The same of reaction, opening, deflection, couple of every support; its `columns` are a table.
    gaps : list of (Member, Gap)
        Positions that are not in it, as there the beam cannot stand.
    """

    def __init__(self, result: Result, members: Sequence[Member], x: np.ndarray | None = None, points: int = 20):
        if not members:
            raise ValueError("envelope: no combination is solved, and no train acts in any")
        self._result, self.members, self._x, self._points = result, list(members), x, points
        self.gaps = [(member, gap) for member in members for gap in member.gaps]

    @cached_property
    def extremes(self) -> dict[str, dict[str, TrainExtreme | None]]:
        """Exact extremes of every field, by ``max`` and ``min``."""
        return {
            name: {kind: _merged([one.of_fields(name, i) for one in self.members], i) for i, kind in enumerate(KINDS)}
            for name in FIELDS
        }

    @cached_property
    def supports(self) -> SupportRows:
        """Extremes at every support, in the order of the scene, by quantity and by ``max`` and ``min``."""
        rows = [
            {
                name: {kind: _merged([one.of_supports(k, name, i) for one in self.members], i) for i, kind in enumerate(KINDS)}
                for name in OF_SUPPORTS
            }
            for k in range(len(self._result.scene.supports))
        ]
        return SupportRows(self._result.scene, rows)

    @cached_property
    def fields(self) -> TrainCurves:
        """Largest and smallest fields along the beam, at the places asked for."""
        beam = self._result.beam
        x = places_along(beam, self._points) if self._x is None else self._x
        n = len(x)
        piece, distance = beam.find(x, False)
        between = np.flatnonzero((distance == 0.0) & (piece > 1))  # there fields may jump
        pieces, distances = map(np.concatenate, zip((piece, distance), beam.find(x[between], True), strict=True))
        rows = np.append(np.arange(n), between)
        if self._x is None:
            order = np.argsort(np.append(2 * np.arange(n) + 1, 2 * between))
            x, rows = x[rows][order], np.argsort(order)
        halves = ((slice(0, n), rows[:n]), (slice(n, None), rows[n:]))
        values, positions = np.empty((2, 4, len(x))), np.full((2, 4, len(x)), np.nan)
        members = np.zeros((2, 4, len(x)), dtype=np.int32)
        values[0], values[1] = -np.inf, np.inf
        for number, member in enumerate(self.members):
            found, where = member.curves(pieces, distances)
            for (half, at), (i, sign) in product(halves, enumerate((1.0, -1.0))):
                better = sign * found[i][:, half] > sign * values[i][:, at]
                row, column = np.nonzero(better)
                values[i][row, at[column]] = found[i][:, half][better]
                positions[i][row, at[column]] = where[i][:, half][better]
                members[i][row, at[column]] = number
        values[np.isinf(values)] = np.nan
        tables = (values, members, positions)
        return TrainCurves(x, *(dict(zip(FIELDS, table[i], strict=True)) for table in tables for i in (0, 1)))

    def columns(self) -> dict[str, Any]:
        """The curves as columns of a table, for example for pandas.

        Returns
        -------
        dict
            ``x``, of every field its largest and smallest values (``moment_max``), the position of the train that gives them
            (``moment_max_position``), its name and direction and, in a scene with combinations, their names.
        """
        curves = self.fields
        keys = ["combination", "train", "direction"] if self._result.scene.combinations else ["train", "direction"]
        positions = {f"{name}_max_position": curves.largest_at[name] for name in FIELDS}
        positions |= {f"{name}_min_position": curves.smallest_at[name] for name in FIELDS}
        return curves_with_sources(curves, self.members, keys) | positions

    def to_dict(self) -> dict[str, Any]:
        """Everything as plain data, in the form of the JSON output.

        Returns
        -------
        dict
            Only numbers, strings, lists and dicts.
        """
        names, curves = names_of(self._result.scene.supports), self.fields
        return {
            "supports": [
                {
                    **({} if names[k] is None else {"name": names[k]}),
                    **{name: {kind: _pair(one) for kind, one in row.items()} for name, row in support.items()},
                }
                for k, support in enumerate(self.supports)
            ],
            "extremes": {
                name: {kind: _pair(one, with_x=True) for kind, one in row.items()} for name, row in self.extremes.items()
            },
            "fields": {
                "x": curves.x.tolist(),
                **{
                    name: {
                        "max": _numbers(curves.largest[name]), "min": _numbers(curves.smallest[name]),
                        "max_at": _numbers(curves.largest_at[name]), "min_at": _numbers(curves.smallest_at[name]),
                    }
                    for name in FIELDS
                },
            },
        }  # fmt: skip


def _pair(extreme: TrainExtreme | None, with_x: bool = False) -> list[Any]:
    if extreme is None:
        return []
    return [extreme.value, *([extreme.x] if with_x else []), extreme.to_dict()]


def _numbers(values: np.ndarray) -> list[float | None]:
    return [value if np.isfinite(value) else None for value in values.tolist()]


def _merged(found: list[list[TrainExtreme]], i: int) -> TrainExtreme | None:
    """The largest (0) or smallest (1) of several, with all ties; None where nothing is solved."""
    ties = [tie for some in found for tie in some]
    if not ties:
        return None
    values = [tie.value for tie in ties]
    best = min(values) if i else max(values)
    slack = EQUAL * max(abs(value) for value in values)
    first, *others = [tie for tie in ties if abs(tie.value - best) <= slack]
    first.ties = tuple(others)
    return first


def places_along(beam: Beam, points: int = 20) -> np.ndarray:
    """Divide all spans equally, and add all places where something is.

    Parameters
    ----------
    beam : Beam
        The beam.
    points : int
        Divisions of a span.

    Returns
    -------
    numpy.ndarray
    """
    places = beam.places
    lengths = places.pieces[:, 0]
    spans = np.bincount(places.span, weights=lengths)[places.span]
    parts = np.maximum(np.ceil(points * (lengths / spans)).astype(int), 1)
    rows = zip(places.point_x, lengths, parts, strict=False)
    inner = [start + length * np.arange(count) / count for start, length, count in rows]
    return np.append(np.concatenate(inner), places.end)


def places_given(beam: Beam, x: Any, name: str = "x") -> np.ndarray | None:
    """Take places on the beam that a caller gives.

    Parameters
    ----------
    beam : Beam
        The beam.
    x : array_like or None
        The places.
    name : str
        Name of the argument.

    Returns
    -------
    numpy.ndarray or None
        None where none are given.

    Raises
    ------
    ValueError
        A place outside the beam.
    """
    if x is None:
        return None
    x = np.atleast_1d(np.array(numbers(name, x), dtype=float)).ravel()
    off = x[~((x >= 0) & (x <= beam.places.end))]
    if len(off):
        raise ValueError(f"{name}: the beam goes from 0 to {beam.places.end:g}, got {off[0]:g}")
    return x
