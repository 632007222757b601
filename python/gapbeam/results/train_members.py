"""What envelopes of trains are made of: their extreme values, of a train in one direction or of a combination without any."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ..engine.beam import Beam
from ..engine.trains import SIDES, Extremes
from .envelope import AT_SUPPORTS
from .ground import size_of
from .tables import KINDS

if TYPE_CHECKING:
    from .ground import FreeSpan
    from .result import Result
    from .step import Step
    from .train_ways import Gap, TrainWay
    from .trains import TrainResult

FIELDS = ("deflection", "rotation", "moment", "shear", "pressure")
"""Fields that have envelopes; the last one on foundations only."""
OF_SUPPORTS = ("reaction", "opening", "deflection", "couple")
"""Values of supports that have them."""


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
    support, foundation : int or None
        Number of the support, or of the foundation.
    span : FreeSpan or None
        The free span, if it is one's length or sag.
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
                 position: float | None, foundation: int | None = None, span: FreeSpan | None = None):  # fmt: skip
        self.quantity, self.value, self.x, self.side, self.support, self.position = quantity, value, x, side, support, position
        self.foundation, self.span = foundation, span
        self.combination, self.train, self.direction = of.combination, of.train, of.direction
        self.ties: tuple[TrainExtreme, ...] = ()
        self._of = of

    def __repr__(self) -> str:
        """Show value, place and source."""
        where = f" at x = {self.x:.6g}" if self.x is not None else f" of support {self.support}"
        where = where if self.foundation is None else f" of foundation {self.foundation}"
        return f"TrainExtreme({self.quantity} {self.value:.6g}{where}, {self.source()})"

    def __eq__(self, other: object) -> bool:
        """Whether values and sources are equal, those of the ties too."""
        if not isinstance(other, TrainExtreme):
            return NotImplemented
        return self._key() == other._key() and self.ties == other.ties

    __hash__ = None

    def _key(self) -> tuple:
        return self.quantity, self.value, self.x, self.support, self.foundation, self.span, self.source()

    @property
    def state(self) -> Step:
        """The state in which it is the value: with a train at its position one whose axles are forces."""
        return self._of.state(self.position)

    @cached_property
    def concurrent(self) -> dict[str, float]:
        """What the other quantities are there in this state.

        Of a field the others at the same place, on the side of the extreme; of a support or a foundation what else it has.
        """
        if self.foundation is not None:
            zones = [zone.resultant for zone in self.state.contact if zone.foundation == self.foundation]
            spans = [span for span in self.state.free_spans if span.foundation == self.foundation]
            found = {"resultant": sum(zones), "length": max((span.to - span.from_ for span in spans), default=0.0),
                     "sag": max((span.sag for span in spans), default=0.0)}  # fmt: skip
            return {name: value for name, value in found.items() if name != self.quantity}
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
        span = {} if self.span is None else {"from": self.span.from_, "to": self.span.to, "sag": self.span.sag}
        return {**span, **self.source(), **({"ties": ties} if ties else {}), "concurrent": self.concurrent}


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

    def of_foundations(self, foundation: int, quantity: str, i: int) -> list[TrainExtreme]:
        """Give the same of a foundation: its ``resultant``, ``length`` or ``sag`` of its free spans."""
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

    def of_foundations(self, foundation: int, quantity: str, i: int) -> list[TrainExtreme]:
        """As `Member.of_foundations`."""
        step = self.state(None)
        if quantity == "resultant":
            value = sum(zone.resultant for zone in step.contact if zone.foundation == foundation)
            return [TrainExtreme(self, quantity, value, None, None, None, None, foundation)]
        spans = [span for span in step.free_spans if span.foundation == foundation]
        span = max(spans, key=lambda one: size_of(one, quantity), default=None)
        return [TrainExtreme(self, quantity, size_of(span, quantity), None, None, None, None, foundation, span)] if span else []

    def curves(self, piece: np.ndarray, distance: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """As `Member.curves`."""
        step, beam = self._result.steps[-1], self._result.beam
        values = beam.values(step.factor, step.starts, step.solution, piece, distance)
        found = np.array([values[beam.fields[name]] for name in fields_of(beam)])
        return np.stack((found, found)), np.full((2, *found.shape), np.nan)

    def state(self, position: float | None) -> Step:
        """As `Member.state`."""
        return self._result.steps[-1]

    def fields(self, position: float | None, x: float, side: str) -> dict[str, float]:
        """As `Member.fields`."""
        return {name: float(value) for name, value in self._result.at(x, side=side).columns().items()}


def fields_of(beam: Beam) -> tuple[str, ...]:
    """Give the fields of a beam that have envelopes.

    Parameters
    ----------
    beam : Beam
        The beam.

    Returns
    -------
    tuple of str
        Some of FIELDS.
    """
    return FIELDS if beam.ground_layers else FIELDS[:-1]
