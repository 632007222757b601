"""Largest and smallest values over the whole way of the load: what it passes may be worse than where it ends.

Between two events all values are linear in the load factor. So at every place the largest value on a stretch of the path is at one
of its ends, and the ends of all stretches have the extremes of the whole path, exactly; where the path jumps both sides count.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base.errors import EngineError, Status
from ...base.memory import refuse_beyond
from ...base.records import read_only
from ...engine.beam import SOLVED
from ...engine.quantities import FIELDS
from ...scene.names import names_data
from ..paths.branches import CURVE, BranchPath
from ..views.extreme import Source
from .envelope import AT_SUPPORTS, OF_SUPPORTS, Envelope
from .full_load import fields_on_sides, on_both_sides

if TYPE_CHECKING:
    from ..result import Result
    from ..state.step import Step

PARTS, LEAST, MOST = 96, 4, 24
"""Parts of the whole way, and least and most of one segment, at whose ends states are looked at, where values are curved in the
load factor."""


def is_followed(result: Result) -> bool:
    """Whether there is more than one state of the load.

    Parameters
    ----------
    result : Result
        Of one load, or of combinations.

    Returns
    -------
    bool
        True following events or a history, by load steps, and where the state depends on the loading history.
    """
    if result.scene.analysis.is_one_step and not result.depends_on_path:
        return False
    if result.combinations:
        return any(map(is_followed, result.combinations.values()))
    return len(result.steps) > 0 and (result.path is not None or result.scene.analysis.steps > 1)


def count_states(result: Result) -> int:
    """Count the states that have to be solved for extremes over the path of one load: at most so many.

    Parameters
    ----------
    result : Result
        A followed one.
    """
    if result.path is None:
        return len(result.steps)
    return sum(parts + 1 for parts in _parts(result)) + len(result.steps) + 2 * len(result.limits)


def is_exact(result: Result) -> bool:
    """Whether extremes over the path of one load are exact: it has been followed, and values are linear between its events.

    Parameters
    ----------
    result : Result
        A followed one.

    Returns
    -------
    bool
        False by load steps, on foundations, and with smooth laws.
    """
    return result.path is not None and result._beam.is_linear_between_events


def _states(result: Result) -> Iterator[tuple[Source, Step]]:
    """States that have the extremes of one load: ends of stretches, or what states there are."""
    path = result.path
    if path is None:
        yield from ((Source(None, step.factor, 0), step) for step in result.steps)
        return
    curved = not is_exact(result)
    jumps = curved or isinstance(path, BranchPath) or any(event.event == "turns" for event in result.events)
    if isinstance(path, BranchPath):
        yield from ((Source(None, step.factor, -1), step) for step in path.at_dead_limits())
    for k, (segment, parts) in enumerate(zip(result.segments, _parts(result), strict=True)):
        leg = getattr(segment, "leg", 0)
        if isinstance(path, BranchPath):
            found = path.along(segment)
        else:
            factors = np.linspace(segment.start, segment.stop, parts + 1).tolist()
            found = [path.step(segment, factor) for factor in factors[0 if jumps or k == 0 else -1 :]]
        yield from ((Source(None, step.factor, leg), step) for step in found)
    if curved and result.scene.analysis.follow == "steps":
        for k, step in enumerate(result.steps):
            yield Source(None, step.factor, getattr(result.steps.segment(k), "leg", 0)), step


def _parts(result: Result) -> list[int]:
    """Parts of each segment between which states are looked at: one where values are linear."""
    ways = [abs(segment.stop - segment.start) for segment in result.segments]
    if is_exact(result):
        return [1 for _ in ways]
    if isinstance(result.path, BranchPath):
        return [CURVE - 1 for _ in ways]
    whole = sum(ways) or 1.0
    return [min(max(math.ceil(PARTS * way / whole), LEAST), MOST) for way in ways]


class PathEnvelope(Envelope):
    """Largest and smallest values over the whole way of the load, as an `Envelope`: each with its load factor and leg.

    With combinations over the ways of all that are solved or have a limit load, as far as these go.

    Parameters
    ----------
    result : Result
        A followed one (`is_followed`).
    points : int
        Divisions of every span at which its curves are made, when they are asked for.
    x : numpy.ndarray, optional
        Places of the curves instead.

    Attributes
    ----------
    over : str
        ``path``: exact, of every load factor that is passed; ``states``: on foundations and with smooth laws, whose values are
        curved between events, of the events and of 3 to 23 states between each two; ``steps``: of the load steps only.
    missing : list of (Source, str)
        States that could not be solved, and why; they do not count.

    Raises
    ------
    ValueError
        No state stands.
    SceneError
        There is not the memory for so many states.
    """

    def __init__(self, result: Result, points: int = 20, x: np.ndarray | None = None):
        self.missing: list[tuple[Source, str]] = []
        self._results: list[Result] = []
        self._states: list[Step] = []
        sources: list[Source] = []
        named = [(name, result.combinations[name]) for name in result.combinations] if result.combinations else [(None, result)]
        followed = [(name, one) for name, one in named if len(one.steps)]
        numbers = len(AT_SUPPORTS) * len(result.scene.supports) + 4 * len(FIELDS)
        count = sum(count_states(one) for _, one in followed)
        refuse_beyond("analysis.follow", f"extremes over {count:,} states", 8.0 * count * numbers, "follow the load in parts")
        at_supports = np.empty((count, len(AT_SUPPORTS), len(result.scene.supports)))
        values, places = np.full((2, count, len(FIELDS), 2), np.nan)
        for name, one in followed:
            for source, step in _states(one):
                source = source._replace(combination=name)
                try:
                    if step.solution.status != SOLVED:
                        raise EngineError("held by so little that rounding decides whether it stands", Status.INDETERMINATE)
                    found, x_found = step.solution.extremes()
                    k, n = len(sources), found.shape[1]
                    at_supports[k], values[k, :n], places[k, :n] = step.solution.at_supports, found.T, x_found.T
                except EngineError as error:
                    self.missing.append((source, str(error)))
                    continue
                sources.append(source)
                self._results.append(one)
                self._states.append(step.forgotten())
        if not sources:
            raise ValueError("no state of the path stands, so there are no extremes over it")
        kinds = {"steps" if one.path is None else "path" if is_exact(one) else "states" for _, one in followed if is_followed(one)}
        self.over = max(kinds, key=["path", "states", "steps"].index)
        at_supports, values, places = (table[: len(sources)] for table in (at_supports, values, places))
        there = {name: column for _, one in followed for name, column in one._beam.fields.items()}
        super().__init__(
            result, there, sources, *map(read_only, (at_supports, values, places)), self._results.__getitem__,
            partial(self._curves, points, x), x is not None, self._states.__getitem__,
            [*(["combination"] if result.combinations else []), "factor", "leg"],
        )  # fmt: skip

    def _curves(self, points: int, x: np.ndarray | None) -> tuple[np.ndarray, Iterator[tuple[slice, np.ndarray]]]:
        """Places along the beam, and the fields there of one state after the other."""
        if x is not None:
            x, left = on_both_sides(x)
        else:
            x, left = self._results[0]._beam.places.x_of(*self._results[0]._places_along(points))
        return x, (
            (slice(k, k + 1), fields_on_sides(one, x, left, step)[None])
            for k, (one, step) in enumerate(zip(self._results, self._states, strict=True))
        )

    def to_history(self) -> dict[str, Any]:
        """As plain data, in the form of ``history_extremes`` of the JSON output.

        Returns
        -------
        dict
            ``over`` what they are; by field ``{"max": [value, x, {"factor": ..., "leg": ...}], "min": ...}``; ``supports``, each
            with its number, name and ``reaction``, ``opening``, ``deflection`` as ``{"max": [value, {...}], ...}``; ``missing``
            only where states could not be solved.
        """
        missing = [{**source.to_dict(), "reason": reason} for source, reason in self.missing]
        fields = {
            name: {kind: [one.value, one.x, one.source.to_dict()] for kind, one in row.items()}
            for name, row in self.extremes.items()
        }
        supports = [
            {
                "support": k,
                **name,
                **{what: {kind: [one.value, one.source.to_dict()] for kind, one in row[what].items()} for what in OF_SUPPORTS},
            }
            for k, (name, row) in enumerate(zip(names_data(self.scene.supports), self.supports, strict=True))
        ]
        return {"over": self.over, **fields, "supports": supports, **({"missing": missing} if missing else {})}
