"""Solve all combinations of a scene: one after the other, or, where each is one search, in few calls of the engine."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from ...base.errors import FALLEN, WITHOUT_ANSWER, EngineError, Status
from ...base.records import Pickled
from ...engine.combinations import Combined, all_combinations, solve_combinations
from ...engine.quantities import FIELDS
from ..envelopes.full_load import at_full_load, fields_on_sides
from ..paths.compression import WARNED
from ..paths.struts import euler
from .combinations import Combinations


class OneByOne(Pickled):
    """Combinations solved one after the other, as the loading history, or trains that pass, ask for.

    Parameters
    ----------
    combinations : Combinations
        Results by number, each made when it is looked at.
    """

    def __init__(self, combinations: Combinations):
        self._combinations, self._plan, self._beam = combinations, combinations._plan, combinations._beam

    def solve(self, note: Callable[[int], None]) -> tuple[Combined, list[str]]:
        """Solve all combinations at full load.

        Parameters
        ----------
        note : callable
            Called with the number of a combination that was solved by itself, for its compression.

        Returns
        -------
        found : Combined
            Their states.
        statuses : list of str
            The status of each.
        """
        beam, count = self._beam, len(self._plan)
        nan = np.full
        found = Combined(
            np.zeros(count, np.int32), np.zeros((count, beam.supports), np.int32),
            nan((count, 4, beam.scene_supports), np.nan), nan((count, len(FIELDS), 2), np.nan),
            nan((count, len(FIELDS), 2), np.nan),
            np.zeros((count, 0, len(FIELDS))), np.zeros(count, np.int64),
        )  # fmt: skip
        found = _changeable(found)
        statuses = [self._take(found, k, note) for k in range(count)]
        found.__post_init__()
        return found, statuses

    def _take(self, found: Combined, k: int, note: Callable[[int], None]) -> str:
        """Put the state of a combination at full load into arrays."""
        result = self._combinations[k]
        try:
            values = at_full_load(result)
        except EngineError as error:
            if error.status not in WITHOUT_ANSWER:
                raise
            self._combinations.failed[k] = error.status
            result._refuse_answer(error)
            values = at_full_load(result)
        note(k)
        found.status[k] = next((one for one in FALLEN if one.word == result.status), Status.SOLVED)
        found.at_supports[k], found.extremes[k], found.places[k], found.solves[k] = values
        return result.status

    def compressed(self, found: Combined) -> list[int]:
        """Give the combinations whose compression is still to be looked at: none, as each was checked when it was solved.

        Parameters
        ----------
        found : Combined
            From `solve`.
        """
        return []

    def fields_at(
        self, found: Combined, statuses: Sequence[str], piece: np.ndarray, distance: np.ndarray, x: np.ndarray, left: np.ndarray
    ) -> Iterator[tuple[slice, np.ndarray]]:
        """Give fields at places, some combinations at a time.

        Parameters
        ----------
        found, statuses
            From `solve`.
        piece, distance : numpy.ndarray
            The places, as for `Beam.values`.
        x : numpy.ndarray
            The same from the left end of the beam.
        left : numpy.ndarray of bool
            Whether values left of them are meant where a field jumps.

        Yields
        ------
        part : slice
            Which combinations.
        values : numpy.ndarray
            Combinations by places by fields.
        """
        yield from self._alone(range(len(self._plan)), statuses, x, left)

    def _alone(self, which: Sequence[int], statuses: Sequence[str], x: np.ndarray, left: np.ndarray) -> Iterator:
        for k in which:
            if statuses[k] == "solved":
                yield slice(k, k + 1), fields_on_sides(self._combinations[k], x, left)[None]


class AtOnce(OneByOne):
    """Combinations solved in few calls of the engine, those in the contact state of others after them."""

    def solve(self, note: Callable[[int], None]) -> tuple[Combined, list[str]]:
        """Solve all combinations, as `OneByOne.solve`."""
        plan = self._plan
        found = all_combinations(self._beam, plan.factors, plan.settlements, self._combinations._rule, self._combinations._start)
        alone = self._in_states_of_others()
        for k in np.flatnonzero(found.status > max(FALLEN)).tolist():
            if k not in alone:
                self._combinations.failed[k] = Status(found.status[k])
                if found.status[k] in (Status.BAD_INPUT, Status.NOT_FINITE):
                    self._combinations[k]  # says it in words where there is not even a beam
        words = {status: Status(status).word for status in np.unique(found.status).tolist()}
        statuses = [words[status] for status in found.status.tolist()]
        if alone:
            found = _changeable(found)
            for k in alone:
                statuses[k] = self._take(found, k, note)
            found.__post_init__()
        return found, statuses

    def _in_states_of_others(self) -> list[int]:
        return [k for k, other in enumerate(self._plan.scheme_of) if other is not None]

    def compressed(self, found: Combined) -> list[int]:
        """Give the combinations whose compression is to be looked at: those that are not far below the Euler load."""
        with np.errstate(invalid="ignore"):
            force = -found.extremes[:, FIELDS.index("axial_force"), 1]
            least = euler(float(self._beam.places.pieces[:, 1].min()), 2.0 * self._beam.places.end)
            return np.flatnonzero(force > WARNED * least).tolist()

    def fields_at(
        self, found: Combined, statuses: Sequence[str], piece: np.ndarray, distance: np.ndarray, x: np.ndarray, left: np.ndarray
    ) -> Iterator[tuple[slice, np.ndarray]]:
        """Give fields at places, as `OneByOne.fields_at`."""
        plan, alone = self._plan, self._in_states_of_others()
        left_out = {*alone, *np.flatnonzero(found.status)}
        for part, there in solve_combinations(
            self._beam, plan.factors, plan.settlements, self._combinations._rule, found.closed, piece, distance
        ):
            values = there.fields
            here = [k - part.start for k in left_out if part.start <= k < part.stop]
            if here:
                values = values.copy()
                values[here] = np.nan
            yield part, values
        yield from self._alone(alone, statuses, x, left)


def _changeable(found: Combined) -> Combined:
    """The same with arrays of their own that can be changed until they are protected again."""
    made = object.__new__(Combined)
    for name in Combined.__dataclass_fields__:
        object.__setattr__(made, name, np.array(getattr(found, name)))
    return made
