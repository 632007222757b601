"""Envelopes of the combinations of one limit state."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from ...scene.wording import enumerated, shown

if TYPE_CHECKING:
    from ..envelopes.envelope import Envelope
    from ..result import Result
    from ..trains.envelope import TrainEnvelope
    from .combined import CombinedResult


def members_of(name: str | None, limit_states: Sequence[str]) -> np.ndarray:
    """Tell which combinations belong to a limit state.

    Parameters
    ----------
    name : str or None
        Its name; None: all combinations count.
    limit_states : sequence of str
        That of every combination, empty where it has none.

    Returns
    -------
    numpy.ndarray of bool

    Raises
    ------
    ValueError
        There is no such limit state.
    """
    if name is None:
        return np.ones(len(limit_states), dtype=bool)
    found = np.array([one == name for one in limit_states], dtype=bool)
    if not (name and found.any()):
        there = list(dict.fromkeys(filter(None, limit_states)))
        words = f"there is no {shown(name)}; there are {enumerated(map(shown, there))}" if there else (
            'no combination has one; write for example limit_state = "ULS" into [[combinations]]')  # fmt: skip
        raise ValueError(f"limit_state: {words}")
    return found


def without_others(values: np.ndarray, chosen: np.ndarray) -> np.ndarray:
    """Make the values of combinations that are not chosen no numbers, so that they do not count.

    Parameters
    ----------
    values : numpy.ndarray
        Of combinations (rows).
    chosen : numpy.ndarray of bool
        Which combinations count.
    """
    if chosen.all():
        return values
    return np.where(chosen.reshape(-1, *[1] * (values.ndim - 1)), values, np.nan)


def envelopes_to_tell(result: Result) -> Iterator[tuple[str | None, Envelope | TrainEnvelope]]:
    """Go through the envelopes that a report tells: of every limit state, and of all where combinations have none.

    Parameters
    ----------
    result : Result
        With combinations or trains.

    Yields
    ------
    name : str or None
        Of the limit state; None: of all combinations.
    envelope : Envelope or TrainEnvelope
    """
    names = getattr(result, "limit_states", ())
    for name in names:
        if result._has_envelope_of(name):
            yield name, result.envelope(limit_state=name)
    if not names or not all(one.limit_state for one in result.scene.combinations):
        yield None, result.envelope()


def names_in_pictures(result: CombinedResult) -> dict[str, tuple[str, str]]:
    """Give what pictures call every combination, and its limit state, by its name.

    Parameters
    ----------
    result : CombinedResult
        Patterns are written out; the many placements of loads on parts of spans have one name.
    """
    found = {}
    for name, i in zip(result.names, result._plan.origin, strict=True):
        one = result.scene.combinations[i]
        case = next((case for case, rule in one.expand.items() if rule == "parts"), None)
        found[name] = name if case is None else f"{one.name} [{case} on parts]", one.limit_state
    return found
