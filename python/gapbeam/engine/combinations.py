"""Combinations of loads on one beam, many in one call of the compiled layer."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields

import numpy as np

from ..base.errors import check_ended
from ..base.records import Record
from . import calls as _engine
from .beam import RULES, Beam
from .quantities import FIELDS

NUMBERS_AT_A_TIME = 4_000_000
"""Values at places in one call."""


@dataclass(frozen=True, slots=True, eq=False)
class Varied(Record):
    """Numbers of combinations in place of those of the beam; None where they stay.

    Attributes
    ----------
    supports : numpy.ndarray or None
        Settlement, gap and stiffness of the supports: combinations by supports of the scene (and one more) by 3.
    spans : numpy.ndarray or None
        EI and GA of the spans: combinations by spans (and one more) by 2.
    moduli : numpy.ndarray or None
        Of the foundations, negative where one stays: combinations by foundations (and one more).
    """

    supports: np.ndarray | None = None
    spans: np.ndarray | None = None
    moduli: np.ndarray | None = None

    @property
    def is_nothing(self) -> bool:
        """Whether all stay."""
        return self.supports is self.spans is self.moduli is None

    def of(self, which: slice | np.ndarray) -> Varied:
        """Give those of some combinations."""
        return Varied(*(None if one is None else one[which] for one in (self.supports, self.spans, self.moduli)))

    def part(self, which: slice) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Take the numbers of some combinations, as GBCOMB does."""
        count = which.stop - which.start
        given = self.supports, self.spans, self.moduli
        own = ((count, 1, 3), (count, 1, 2), (count, 1))
        return tuple((np.zeros(shape) if one is None else one[which]).T for one, shape in zip(given, own, strict=True))


@dataclass(frozen=True, slots=True, eq=False)
class Combined(Record):
    """Combinations at full load, in the scene's units; values are not-a-number where one is not solved.

    Attributes
    ----------
    status : numpy.ndarray of int
        0 solved, 1 no equilibrium, above 10 the code of an error.
    closed : numpy.ndarray of int
        Contact states, combinations by supports of the engine.
    at_supports : numpy.ndarray
        Reaction, deflection, opening and couple (rows) of the scene's supports, combinations by 4 by supports.
    extremes, places : numpy.ndarray
        Maximum and minimum of every field in the order of `FIELDS`, and where they are, combinations by fields by 2; or by 0 by 2.
    fields : numpy.ndarray
        The fields at the places asked for, combinations by places by fields.
    solves : numpy.ndarray of int
        Linear solves.
    """

    status: np.ndarray
    closed: np.ndarray
    at_supports: np.ndarray
    extremes: np.ndarray
    places: np.ndarray
    fields: np.ndarray
    solves: np.ndarray


def solve_combinations(
    beam: Beam, factors: np.ndarray, settlements: np.ndarray | None, rule: str, closed: np.ndarray,
    piece: np.ndarray | None = None, distance: np.ndarray | None = None, varied: Varied | None = None, extremes: bool = True,
) -> Iterator[tuple[slice, Combined]]:  # fmt: skip
    """Solve combinations, so many at a time that each call is a short one.

    Parameters
    ----------
    beam : Beam
    factors : numpy.ndarray
        Factor of every load, combinations by loads.
    settlements : numpy.ndarray or None
        Further movement of every support, combinations by supports of the scene; None where nothing moves.
    rule : {"block", "single"}
        How contact states are found.
    closed : numpy.ndarray of int
        Where the searches start: supports of the engine, or combinations by supports.
    piece, distance : numpy.ndarray, optional
        Places at which fields are wanted, as for `Solution.values`.
    varied : Varied, optional
        Numbers that differ from those of the beam.
    extremes : bool
        Whether they are wanted, which may take longer than all else.

    Yields
    ------
    part : slice
        Which combinations.
    found : Combined
        Their results.

    Raises
    ------
    MemoryError
        The system gives no more memory.
    """
    count = len(factors)
    settlements = np.zeros((count, beam.scene_supports)) if settlements is None else settlements
    piece = np.zeros(0, np.int32) if piece is None else piece
    distance = np.zeros(0) if distance is None else distance
    about = np.append(piece, 1).astype(np.int32), np.append(distance, 0.0)
    schemes = np.zeros((count, beam.supports + 1), dtype=np.int32)
    schemes[:, :-1] = closed
    most = max(NUMBERS_AT_A_TIME // (len(FIELDS) * (len(piece) + 1)), 1)
    for part in _engine.short_parts(count, beam.links + 1, most):
        shares, moves = (
            np.column_stack((rows[part], np.zeros(part.stop - part.start))).T for rows in (factors, settlements)
        )
        own = (varied or Varied()).part(part)
        scheme = np.asfortranarray(schemes[part].T)
        values, largest, places, fields_at, solves, status = _engine.gbcomb(
            beam.handle, len(FIELDS), len(FIELDS) if extremes else 0, np.asfortranarray(shares), np.asfortranarray(moves), *own,
            RULES[rule], scheme, *about,
        )
        check_ended(status)
        yield part, Combined(
            status, scheme.T[:, :-1], values.T[:, :, :-1], largest.T, places.T, fields_at.T[:, :-1], solves
        )


def all_combinations(
    beam: Beam, factors: np.ndarray, settlements: np.ndarray | None, rule: str, closed: np.ndarray,
    piece: np.ndarray | None = None, distance: np.ndarray | None = None, varied: Varied | None = None, extremes: bool = True,
) -> Combined:  # fmt: skip
    """Solve combinations, and keep all results.

    Parameters
    ----------
    beam, factors, settlements, rule, closed, piece, distance, varied, extremes
        As for `solve_combinations`.

    Returns
    -------
    Combined
        Of all of them.
    """
    if not len(factors):  # no rows, of the length that those of one combination have
        nothing = np.zeros((1, factors.shape[1]))
        one = all_combinations(beam, nothing, None, rule, np.zeros(beam.supports, np.int32), piece, distance, None, extremes)
        return Combined(*(getattr(one, part.name)[:0] for part in fields(Combined)))
    asked = beam, factors, settlements, rule, closed, piece, distance, varied, extremes
    parts = [found for _, found in solve_combinations(*asked)]
    if len(parts) == 1:
        return parts[0]
    joined = (np.concatenate([getattr(part, one.name) for part in parts]) for one in fields(Combined))
    return Combined(*joined)
