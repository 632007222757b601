"""Largest and smallest values over all positions of trains, in every combination, and where they come from."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ...engine.beam import Beam
from ...engine.tolerances import END_TOLERANCE, TRAIN_EQUAL
from ..envelopes.envelope import Curves
from ..envelopes.tables import SupportRows, curves_with_sources
from ..envelopes.verbs import PartVerbs
from ..state.arguments import numbers
from ..views.extreme import KINDS, Extremes
from .members import OF_SUPPORTS, Member, TrainExtreme, fields_of

if TYPE_CHECKING:
    from ..result import Result
    from .traversals import UnstablePositions

OF_FOUNDATIONS = {"resultant": (("max", "resultant", 0), ("min", "resultant", 1)),
                  "free_span": (("longest", "length", 0), ("deepest", "sag", 0))}  # fmt: skip
"""Values of foundations that have envelopes: their kinds, what is asked of a member, the largest (0) or the smallest (1)."""


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
    _beside: ClassVar = {"max_at": "largest_at", "min_at": "smallest_at"}


class TrainEnvelope(PartVerbs):
    """Largest and smallest values over all positions of trains; never floored at zero. Trains pass one at a time.

    A state in which no train acts is in it only where a combination gives its case no factor.

    It has the verbs of results, with largest and smallest values. Its status is that of the result.

    Attributes
    ----------
    unstable_positions : list of (Member, UnstablePositions)
        Positions that are not in it, as the beam is unstable there.
    """

    def __init__(self, result: Result, members: Sequence[Member], x: np.ndarray | None = None, points: int = 20):
        if not members:
            raise ValueError("envelope: no combination is solved, and no train acts in any")
        self._result, self._members, self._x, self._points = result, list(members), x, points
        self.unstable_positions = [(member, one) for member in members for one in member.unstable_positions]

    @property
    def gaps(self) -> list[tuple[Member, UnstablePositions]]:
        """Give the same as `unstable_positions`, by the name that it had."""
        warnings.warn("gaps of trains are called unstable_positions", DeprecationWarning, stacklevel=2)
        return self.unstable_positions

    renamed: ClassVar = {"members": "_members"}
    _tells_what_is_not_solved = True

    def _curves_at(self, x: Any) -> TrainCurves:
        return TrainEnvelope(self._result, self._members, places_given(self._result._beam, x)).fields

    def _seen_states(self) -> Iterator[tuple[str, ...]]:
        for one in self._members:
            yield from one.seen_states()

    @cached_property
    def extremes(self) -> Extremes:
        """Extremes of every field, exact in place and position, by ``max`` and ``min``; None where nothing is solved."""
        return Extremes(self._find_extremes)

    def _find_extremes(self) -> dict[str, dict[str, TrainExtreme | None]]:
        return {
            name: {kind: _merged([one.of_fields(name, i) for one in self._members], i) for i, kind in enumerate(KINDS)}
            for name in fields_of(self._result._beam)
        }

    @cached_property
    def foundations(self) -> list[dict[str, dict[str, TrainExtreme | None]]]:
        """Extremes of every foundation, in the order of the scene, as `Envelope.foundations`."""
        return [
            {
                name: {kind: _merged([one.of_foundations(k, what, i) for one in self._members], i) for kind, what, i in kinds}
                for name, kinds in OF_FOUNDATIONS.items()
            }
            for k in range(len(self._result.scene.foundation))
        ]

    @cached_property
    def supports(self) -> SupportRows:
        """Extremes of reaction, opening, deflection and couple at every support, by ``max`` and ``min``; `columns` make a table."""
        rows = [
            {
                name: {kind: _merged([one.of_supports(k, name, i) for one in self._members], i) for i, kind in enumerate(KINDS)}
                for name in OF_SUPPORTS
            }
            for k in range(len(self._result.scene.supports))
        ]
        for row, x in zip(rows, self.scene.positions(self.scene.supports).tolist(), strict=True):
            for one in (one for kinds in row.values() for one in kinds.values() if one is not None):
                for tie in (one, *one.ties):
                    tie.x = x
        return SupportRows(self._result.scene, rows)

    @cached_property
    def fields(self) -> TrainCurves:
        """Largest and smallest fields along the beam, at the places asked for."""
        beam = self._result._beam
        x = places_along(beam, self._points) if self._x is None else self._x
        n = len(x)
        piece, distance = beam.find(x, False)
        between = np.flatnonzero((distance == 0.0) & (piece > 1))  # there fields may jump
        rows = np.append(np.arange(n), between)
        places, left = x[rows], np.arange(len(rows)) >= n
        if self._x is None:
            order = np.argsort(np.append(2 * np.arange(n) + 1, 2 * between))
            x, rows = x[rows][order], np.argsort(order)
        halves = ((slice(0, n), rows[:n]), (slice(n, None), rows[n:]))
        fields = fields_of(beam)
        values, positions = np.empty((2, len(fields), len(x))), np.full((2, len(fields), len(x)), np.nan)
        members = np.zeros((2, len(fields), len(x)), dtype=np.int32)
        values[0], values[1] = -np.inf, np.inf
        for number, member in enumerate(self._members):
            found, where = member.curves(places, left)
            for (half, at), (i, sign) in product(halves, enumerate((1.0, -1.0))):
                here, known = found[i][:, half], values[i][:, at]
                better = sign * here > sign * known
                row, column = np.nonzero(better)
                values[i][row, at[column]] = here[better]
                # Of members that tie the first one is named
                apart = sign * (here[better] - known[better]) > TRAIN_EQUAL * np.abs(here[better])
                row, column = row[apart], column[apart]
                positions[i][row, at[column]] = where[i][:, half][row, column]
                members[i][row, at[column]] = number
        values[np.isinf(values)] = np.nan
        tables = (values, members, positions)
        return TrainCurves(x, *(dict(zip(fields, table[i], strict=True)) for table in tables for i in (0, 1)))

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
        positions = {f"{name}_max_position": where for name, where in curves.largest_at.items()}
        positions |= {f"{name}_min_position": where for name, where in curves.smallest_at.items()}
        return curves_with_sources(curves, self._members, keys) | positions


def _merged(found: list[list[TrainExtreme]], i: int) -> TrainExtreme | None:
    """The largest (0) or smallest (1) of several, with all ties; None where nothing is solved."""
    ties = [tie for some in found for tie in some]
    if not ties:
        return None
    values = [tie.value for tie in ties]
    best = min(values) if i else max(values)
    slack = TRAIN_EQUAL * max(abs(value) for value in values)
    first, *others = [tie for tie in ties if abs(tie.value - best) <= slack]
    first.ties = tuple(others)
    return first


def places_along(beam: Beam, points: int = 20) -> np.ndarray:
    """Divide all spans equally, and add all places where something is.

    Parameters
    ----------
    beam : Beam
    points : int
        Divisions of a span.
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
    x, end = np.atleast_1d(np.array(numbers(name, x), dtype=float)).ravel(), beam.places.end
    slack = END_TOLERANCE * end
    off = x[~((x >= -slack) & (x <= end + slack))]
    if len(off):
        raise ValueError(f"{name}: the beam goes from 0 to {end:g}, got {off[0]:g}")
    return np.clip(x, 0.0, end)
