"""Sources of envelopes of trains: their extreme values, of a train in one direction or of a combination without any."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base.errors import EngineError
from ...engine.beam import Beam
from ...engine.quantities import BENDING, QUANTITIES
from ...engine.trains import SIDES, Extremes, Traversal
from ..envelopes.envelope import AT_SUPPORTS
from ..envelopes.ground_envelope import on_foundation
from ..state.ground import size_of
from ..views.extreme import KINDS, Extreme, Source

if TYPE_CHECKING:
    from ..result import Result
    from ..state.ground import FreeSpan
    from ..state.step import Step
    from .sampled import SampledTraversal
    from .trains import TrainResult
    from .traversals import ExactTraversal, UnstablePositions

OF_FORCES = (*(one.name for one in QUANTITIES if one.by_equilibrium), "reaction", "couple")
"""What is unique where the beam can move freely without work of the loads."""
OF_SUPPORTS = ("reaction", "opening", "deflection", "couple")
"""Values of supports that have them."""


class TrainExtreme(Extreme):
    """A largest or smallest value while trains pass; its attributes are those of `Extreme`.

    Attributes
    ----------
    ties : tuple of TrainExtreme
        Others with the same value.
    """

    def __init__(self, of: Member, quantity: str, value: float, x: float | None, side: str | None, support: int | None,
                 position: float | None, foundation: int | None = None, span: FreeSpan | None = None):  # fmt: skip
        source = Source(of.combination, None, None, of.train, position, of.direction, side)
        super().__init__(quantity, value, x, source, support, foundation, span)
        self.ties: tuple[TrainExtreme, ...] = ()
        self._of = of

    def __eq__(self, other: object) -> bool:
        """Whether values and sources are equal, those of the ties too."""
        if not isinstance(other, TrainExtreme):
            return NotImplemented
        return self._key() == other._key() and self.ties == other.ties

    __hash__ = None

    def _key(self) -> tuple:
        return self.quantity, self.value, self.x, self.support, self.foundation, self.span, self.source

    @property
    def state(self) -> Step:
        """The state in which it is the value: with a train at its position one whose axles are forces."""
        return self._of.state_of(self)

    @cached_property
    def concurrent(self) -> dict[str, float]:
        """What the other quantities are there in this state.

        Of a field the others at the same place, on the side of the extreme; of a support or a foundation what else it has.
        """
        if self.foundation is not None:
            return on_foundation(self.state, self.foundation, self.quantity)
        if self.support is not None:
            rows = self.state.solution.at_supports[:, self.support].tolist()
            there = dict(zip(AT_SUPPORTS, rows, strict=True))
        else:
            there = self._of.fields(self)
        return {name: value for name, value in there.items() if name not in ("x", self.quantity) and self._of.is_unique(name)}

    def to_dict(self) -> dict[str, Any]:
        """Where it comes from, all that tie with it, and the concurrent values, as plain data."""
        ties = [({"x": tie.x} if tie.support is tie.foundation is None else {}) | tie.source.to_dict() for tie in self.ties]
        span = {} if self.span is None else self.span.to_dict()
        return {**span, **self.source.to_dict(), **({"ties": ties} if ties else {}), "concurrent": self.concurrent}


class Member:
    """What an envelope is made of: the positions of a train in one direction, or the state of a combination without trains.

    Attributes
    ----------
    combination, train, direction : str or None
        Of what.
    unstable_positions : list of UnstablePositions
        Positions that are not solved.
    """

    train: str | None = None
    direction: str | None = None

    def __init__(self, combination: str | None) -> None:
        self.combination = combination
        self.unstable_positions: list[UnstablePositions] = []

    def of_fields(self, quantity: str, i: int) -> list[TrainExtreme]:
        """Give the largest (0) or smallest (1) values of a field, all that tie."""
        raise NotImplementedError

    def of_supports(self, support: int, quantity: str, i: int) -> list[TrainExtreme]:
        """Give the same of a support."""
        raise NotImplementedError

    def of_foundations(self, foundation: int, quantity: str, i: int) -> list[TrainExtreme]:
        """Give the same of a foundation: its ``resultant``, ``length`` or ``sag`` of its free spans."""
        raise NotImplementedError

    def curves(self, x: np.ndarray, left: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Give largest and smallest fields at places, left or right of each, and positions, 2 by fields by places."""
        raise NotImplementedError

    def state_of(self, extreme: TrainExtreme) -> Step:
        """Give the state in which a value is an extreme one."""
        raise NotImplementedError

    def seen_states(self) -> Iterator[tuple[str, ...]]:
        """Go through the states of all supports."""
        raise NotImplementedError

    def fields(self, extreme: TrainExtreme) -> dict[str, float]:
        """Give all fields in that state at the place of an extreme value."""
        fields = self.state_of(extreme).fields(extreme.x, extreme.side or "right")
        return {name: float(value) for name, value in fields.columns().items()}

    def is_unique(self, quantity: str) -> bool:
        """Tell whether there is but one value of a quantity in such a state."""
        return True


class Passing(Member):
    """A train that goes over the beam in one direction.

    Parameters
    ----------
    train : TrainResult
        The train.
    traversal : ExactTraversal or SampledTraversal
        One of its traversals.
    combination : str, optional
        Name of the combination.
    """

    def __init__(self, train: TrainResult, traversal: ExactTraversal | SampledTraversal, combination: str | None = None):
        super().__init__(combination)
        self.train, self.direction, self.unstable_positions = train.name, traversal.course.direction, traversal.unstable_positions
        self._train, self._traversal = train, traversal

    def _extremes(self) -> tuple[Extremes, list[Extremes]]:
        return self._traversal.extremes

    def of_fields(self, quantity: str, i: int) -> list[TrainExtreme]:
        """As `Member.of_fields`."""
        return self._ties(self._extremes()[0], quantity, BENDING.index(quantity), i, None)

    def of_supports(self, support: int, quantity: str, i: int) -> list[TrainExtreme]:
        """As `Member.of_supports`."""
        return self._ties(self._extremes()[1][support], quantity, OF_SUPPORTS.index(quantity), i, support)

    def _ties(self, found: Extremes, quantity: str, k: int, i: int, support: int | None) -> list[TrainExtreme]:
        count = int(found.count[i, k])
        rows = zip(found.values[i, k, :count].tolist(), found.sides[i, k, :count].tolist(), strict=True)
        return [
            TrainExtreme(self, quantity, value, x if support is None else None, SIDES[side], support, position)
            for (value, x, position), side in rows
        ]

    def curves(self, x: np.ndarray, left: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """As `Member.curves`."""
        engine = self._traversal.engine
        return engine.curves(*_found(engine.beam, x, left))

    def seen_states(self) -> Iterator[tuple[str, ...]]:
        """As `Member.seen_states`: those between the events."""
        of = self._traversal
        ends = [of.course.from_, of.course.to, *(end for gap in of.unstable_positions for end in (gap.from_, gap.to))]
        for before, after in pairwise(sorted({*ends, *(event.position for event in of.events)})):
            with suppress(EngineError, ValueError):  # the beam does not stand there
                yield self._train.state((before + after) / 2, self.direction).state

    def state_of(self, extreme: TrainExtreme) -> Step:
        """As `Member.state_of`: where the beam tips at a position, that before or that after it, whichever has the value."""
        states = []
        for scheme, inside in self._traversal.schemes(extreme.position):
            for position in (extreme.position, inside):
                try:
                    states.append(self._train.state(position, self.direction, scheme))
                    break
                except (EngineError, ValueError):  # on the other side of a change by rounding
                    continue
        if not states:
            return self._train.state(extreme.position, self.direction)
        return min(states, key=lambda state: abs(_value_in(state, extreme) - extreme.value))


class Neutral(Passing):
    """A train at positions at which the beam can move freely: forces are unique there, deflections and rotations are not.

    Parameters
    ----------
    train, traversal, combination
        As of `Passing`.
    held : Traversal
        On a beam that is kept from moving, by supports after its own.
    """

    def __init__(self, train: TrainResult, traversal: ExactTraversal, combination: str | None, held: Traversal):
        super().__init__(train, traversal, combination)
        self.unstable_positions, self._held, self._of_held = [], held, held.extremes()

    def _extremes(self) -> tuple[Extremes, list[Extremes]]:
        return self._of_held

    def of_fields(self, quantity: str, i: int) -> list[TrainExtreme]:
        """As `Member.of_fields`."""
        return super().of_fields(quantity, i) if quantity in OF_FORCES else []

    def of_supports(self, support: int, quantity: str, i: int) -> list[TrainExtreme]:
        """As `Member.of_supports`."""
        return super().of_supports(support, quantity, i) if quantity in OF_FORCES else []

    def curves(self, x: np.ndarray, left: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """As `Member.curves`."""
        values, positions = (found.copy() for found in self._held.curves(*_found(self._held.beam, x, left)))
        values[:, [k for k, name in enumerate(BENDING) if name not in OF_FORCES]] = np.nan
        return values, positions

    def state_of(self, extreme: TrainExtreme) -> Step:
        """As `Member.state_of`: one of those that are possible there."""
        try:
            return self._train.state(extreme.position, self.direction)
        except (EngineError, ValueError):  # the beam falls beside it, by rounding there
            start, end, beside = self._held.ends[0, 0], self._held.ends[-1, 1], 4 * self._traversal.near
            return self._train.state(float(min(max(extreme.position, start + beside), end - beside)), self.direction)

    def is_unique(self, quantity: str) -> bool:
        """As `Member.is_unique`."""
        return quantity in OF_FORCES


def _found(beam: Beam, x: np.ndarray, left: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Find pieces and distances on the beam of a member: each combination may be cut at other places."""
    (piece, distance), of_left = beam.find(x, False), beam.find(x[left], True)
    piece[left], distance[left] = of_left
    return piece, distance


def _value_in(state: Step, extreme: TrainExtreme) -> float:
    """What a state has for an extreme value."""
    if extreme.support is not None:
        return float(state.solution.at_supports[AT_SUPPORTS.index(extreme.quantity), extreme.support])
    return float(state.fields(extreme.x, extreme.side or "right").columns()[extreme.quantity])


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
        self._result, self._step = result, result.steps[-1]
        self._extremes = result._pairs_of_extremes()

    def of_fields(self, quantity: str, i: int) -> list[TrainExtreme]:
        """As `Member.of_fields`."""
        value, x = self._extremes[quantity][KINDS[i]]
        side = None
        right, left = (float(self._result.at(x, side=one).columns()[quantity]) for one in ("right", "left"))
        if abs(right - value) > abs(left - value):
            side = "left"
        return [TrainExtreme(self, quantity, value, x, side, None, None)]

    def of_supports(self, support: int, quantity: str, i: int) -> list[TrainExtreme]:
        """As `Member.of_supports`."""
        value = float(self._step.solution.at_supports[AT_SUPPORTS.index(quantity), support])
        return [TrainExtreme(self, quantity, value, None, None, support, None)]

    def of_foundations(self, foundation: int, quantity: str, i: int) -> list[TrainExtreme]:
        """As `Member.of_foundations`."""
        step = self._step
        if quantity == "resultant":
            value = sum(zone.resultant for zone in step.contact if zone.foundation == foundation)
            return [TrainExtreme(self, quantity, value, None, None, None, None, foundation)]
        spans = [span for span in step.free_spans if span.foundation == foundation]
        span = max(spans, key=lambda one: size_of(one, quantity), default=None)
        return [TrainExtreme(self, quantity, size_of(span, quantity), None, None, None, None, foundation, span)] if span else []

    def curves(self, x: np.ndarray, left: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """As `Member.curves`."""
        step, beam = self._result.steps[-1], self._result._beam
        values = step.solution.values(*_found(beam, x, left))
        found = np.array([values[beam.fields[name]] for name in fields_of(beam)])
        return np.stack((found, found)), np.full((2, *found.shape), np.nan)

    def seen_states(self) -> Iterator[tuple[str, ...]]:
        """As `Member.seen_states`."""
        return iter([self._step.state])

    def state_of(self, extreme: TrainExtreme) -> Step:
        """As `Member.state_of`."""
        return self._step

    def fields(self, extreme: TrainExtreme) -> dict[str, float]:
        """As `Member.fields`."""
        return {name: float(value) for name, value in self._result.at(extreme.x, side=extreme.side or "right").columns().items()}


def fields_of(beam: Beam) -> tuple[str, ...]:
    """Give the fields of a beam that have envelopes.

    Returns
    -------
    tuple of str
        Some of `FIELDS`.
    """
    return tuple(one.name for one in QUANTITIES if one.of == "bending" or (one.of == "ground" and beam.ground_layers))
