"""A result at full load: as arrays for envelopes, and its own envelope."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from ...engine.quantities import FIELDS
from ..views.extreme import Source
from .envelope import Envelope

if TYPE_CHECKING:
    from ..result import Result
    from ..state.step import Step


def envelope_of_one(result: Result, points: int, x: np.ndarray | None = None) -> Envelope:
    """Make the envelope of one load.

    Parameters
    ----------
    result : Result
        A solved one.
    points : int
        Divisions of every span for its curves.
    x : numpy.ndarray, optional
        Places for them instead.

    Raises
    ------
    ValueError
        It is not solved.
    """
    at_supports, extremes, places, _ = at_full_load(result)
    return Envelope(
        result, result._beam.fields, [Source()], at_supports[None], extremes[None], places[None], [result].__getitem__,
        partial(_curves, result, points, x), x is not None,
    )


def _curves(result: Result, points: int, x: np.ndarray | None) -> tuple[np.ndarray, Iterator[tuple[slice, np.ndarray]]]:
    """Places along the beam, and the fields there."""
    if x is not None:
        x, left = on_both_sides(x)
        return x, iter([(slice(0, 1), fields_on_sides(result, x, left)[None])])
    fields = result.fields(points=points).columns()
    values = np.full((1, len(fields["x"]), len(FIELDS)), np.nan)
    for name, column in result._beam.fields.items():
        values[0, :, column] = fields[name]
    return fields["x"], iter([(slice(0, 1), values)])


def on_both_sides(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Give places twice, and which of them are meant from the left: those of the second half."""
    return np.tile(x, 2), np.arange(2 * len(x)) >= len(x)


def fields_on_sides(result: Result, x: np.ndarray, left: np.ndarray, state: Step | None = None) -> np.ndarray:
    """Give the fields of a state at places, each on its side.

    Parameters
    ----------
    result : Result
        A solved one.
    x : numpy.ndarray
        Places.
    left : numpy.ndarray of bool
        Where the value left of the place is meant.
    state : Step, optional
        Default the last one.

    Returns
    -------
    numpy.ndarray
        Places by fields.
    """
    values = np.full((len(x), len(FIELDS)), np.nan)
    for side, which in (("left", left), ("right", ~left)):
        found = result.at_state(result.steps[-1] if state is None else state, x[which], side).columns()
        for name, column in result._beam.fields.items():
            values[which, column] = found[name]
    return values


def at_full_load(result: Result) -> tuple[np.ndarray, np.ndarray, np.ndarray, int]:
    """Give the state of a result at full load as arrays.

    Parameters
    ----------
    result : Result
        Of one load.

    Returns
    -------
    at_supports : numpy.ndarray
        Reaction, deflection, opening, couple (rows) of the supports; not-a-number where it is not solved.
    extremes, places : numpy.ndarray
        Maximum and minimum of every field, and where they are, fields by 2.
    solves : int
        Linear solves.
    """
    at_supports = np.full((4, len(result.scene.supports)), np.nan)
    extremes, places = np.full((2, len(FIELDS), 2), np.nan)
    if result.stands:
        at_supports = result.steps[-1].solution.at_supports
        for name, row in result._pairs_of_extremes().items():
            column = FIELDS.index(name)
            extremes[column], places[column] = zip(row["max"], row["min"], strict=True)
    return at_supports, extremes, places, result.solves
