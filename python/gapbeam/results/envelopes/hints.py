"""Factors between none and the full load that govern: with supports that open and close, the worst need not be the last."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base.errors import EngineError
from ...engine.quantities import FIELDS
from ..paths.path import follow
from ..state.schemes import starting_scheme

if TYPE_CHECKING:
    from ..result import Result
    from ..state.step import Step

CLOSE = 1e-9
"""What is nearer than this, as a share of the largest value, is not looked at: far more than error bounds are."""


@dataclass(frozen=True, slots=True)
class Hint:
    """An extreme that is greater at some load factor between 0 and 1 than at either end.

    Attributes
    ----------
    combination : str or None
        Name of the combination; None in a scene without any.
    quantity : str
        For example ``moment`` or ``reaction``.
    kind : {"max", "min"}
        Whether it is the largest or the smallest value.
    factor : float
        Factor of all loads but the dead ones at which it is greatest.
    value, x : float
        The value there, and its place.
    support : int or None
        Number of the support it belongs to.
    at_full_load : float
        The extreme at full load.
    """

    combination: str | None
    quantity: str
    kind: str
    factor: float
    value: float
    x: float
    support: int | None
    at_full_load: float

    def to_dict(self) -> dict[str, Any]:
        """As plain data, what is None left out."""
        return {key: value for key, value in asdict(self).items() if value is not None}


def find_hints(result: Result, combination: str | None = None) -> list[Hint]:
    """Follow the load from the dead loads alone to the full load, and compare extremes on the way with those at both ends.

    Between two events all values are linear in the load factor, so every extreme is greatest at an event, or at one of the ends:
    nothing is missed between.

    Parameters
    ----------
    result : Result
        Of one load.
    combination : str, optional
        Its name.

    Returns
    -------
    list of Hint
        None for beams on foundations or with smooth laws, whose values are not linear between events, where the state depends
        on the loading history, and where there is no equilibrium.
    """
    states = _states(result)
    if not states:
        return []
    x = result.scene.positions(result.scene.supports)
    found = []
    rows = [_values(result, step, x) for step in states]
    factors = np.array([step.factor for step in states])
    for (quantity, support), at_end in rows[-1].items():
        table = np.array([row[quantity, support] for row in rows])  # states by (max, min) by (value, x)
        scale = np.abs(table[:, :, 0]).max()
        for column, (kind, sign) in enumerate((("max", 1.0), ("min", -1.0))):
            values = sign * table[:, column, 0]
            k = int(values.argmax())
            end = 0 if values[0] > values[-1] else len(values) - 1
            more = values[k] - values[end]
            if more <= CLOSE * scale or more <= _bound(states[k], quantity) + _bound(states[end], quantity):
                continue
            found.append(
                Hint(combination, quantity, kind, float(factors[k]), sign * float(values[k]), float(table[k, column, 1]), support,
                     float(at_end[column][0]))
            )  # fmt: skip
    return found


def _states(result: Result) -> list[Step]:
    """States at no load but the dead ones, at every event, and at full load."""
    scene, beam = result.scene, result._beam
    if not (result.stands and result.is_linear_between_events):
        return []
    path = result.path
    if path is None:
        trial = result._another(scene, beam, result._rule)
        try:
            path = follow(trial, result._rule, starting_scheme(beam))
        except EngineError:
            return []
        if trial.status != "solved":
            return []
    if len(path.segments) < 2:
        return []
    # Where the beam turns at constant load values jump: both ends of every segment count
    turns = any(event.event == "turns" for event in path.events)
    starts = path.segments if turns else path.segments[:1]
    states = [(segment, factor) for segment in path.segments for factor in (segment.start, segment.stop)
              if factor == segment.stop or segment in starts]  # fmt: skip
    return [path.step(segment, factor) for segment, factor in states]


def _values(result: Result, step: Step, x: np.ndarray) -> dict[tuple[str, int | None], list[tuple[float, float]]]:
    """Largest and smallest values with their places, by quantity and support."""
    values, places = step.solution.extremes()
    found: dict[tuple[str, int | None], list[tuple[float, float]]] = {
        (name, None): [(values[i, FIELDS.index(name)], places[i, FIELDS.index(name)]) for i in (0, 1)]
        for name in result._beam.fields
    }
    for name in ("reaction", "opening"):
        for k, value in enumerate(getattr(step, name).tolist()):
            found[name, k] = [(value, x[k])] * 2
    return found


def _bound(step: Step, quantity: str) -> float:
    return step.error_bounds.get("deflection" if quantity == "opening" else quantity) or 0.0


def beyond(hints: list[Hint], largest: dict[tuple[str, int | None, str], float]) -> Iterator[Hint]:
    """Choose the hints that go beyond what all combinations have at full load, of every quantity the greatest one.

    Parameters
    ----------
    hints : list of Hint
        From all combinations.
    largest : dict
        Extremes at full load by quantity, support and kind.
    """
    best: dict[tuple[str, int | None, str], Hint] = {}
    for hint in hints:
        key, sign = (hint.quantity, hint.support, hint.kind), 1.0 if hint.kind == "max" else -1.0
        more = sign * (hint.value - largest[key])
        greatest = key not in best or sign * (hint.value - best[key].value) > 0.0
        if more > CLOSE * max(abs(hint.value), abs(largest[key])) and greatest:
            best[key] = hint
    yield from best.values()
