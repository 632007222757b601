"""All that a page moves: the load of a scene, its combinations, its trains."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from ..base.characters import visible
from .geometry import beam_data, loads_data, supports_data
from .load_ways import way_of_load
from .train_ways import MOST_NUMBERS, way_of_train

if TYPE_CHECKING:
    from ..results.envelopes.envelope import Envelope
    from ..results.result import Result
    from ..results.trains.envelope import TrainEnvelope

MOST_WAYS = 60
"""Combinations, or trains in combinations, that a page moves."""


class Collected:
    """Ways, and what several of them share, told once.

    Attributes
    ----------
    ways, beams, supports, loads : list of dict
        Of a way the others are given by their numbers.
    words : list of str
        For the states of supports.
    left_out : int
        Ways that are not moved, since there are so many.
    """

    def __init__(self) -> None:
        self.ways: list[dict[str, Any]] = []
        self.beams: list[dict[str, Any]] = []
        self.supports: list[list[dict[str, Any]]] = []
        self.loads: list[list[dict[str, Any]]] = []
        self.words: list[str] = []
        self.left_out = 0

    def add(self, title: str, result: Result, way: dict[str, Any]) -> None:
        """Add a way.

        Parameters
        ----------
        title : str
            What it is called.
        result : Result
            Of one load.
        way : dict
            States, intervals, events; or a motion.
        """
        supports = supports_data(result.scene, result._beam.places.levels)
        self.ways.append({
            "title": title, "beam": _number(self.beams, beam_data(result)), "supports": _number(self.supports, supports),
            "loads": _number(self.loads, loads_data(result.scene)), **way,
        })  # fmt: skip


def _number(known: list[Any], one: Any) -> int:
    if one not in known:
        known.append(one)
    return known.index(one)


def collect_ways(result: Result, envelope: Envelope | TrainEnvelope | None) -> Collected:
    """Find all that a page moves.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.
    envelope : Envelope or TrainEnvelope or None
        Its `Result.envelope`, if there is one.

    Returns
    -------
    Collected
        The combinations that govern come before others, where there are too many.
    """
    found = Collected()
    if not result.combinations:
        _ways_of(found, "", result, envelope)
        return found
    names = list(result.combinations)
    chosen = set(_governing(envelope) if envelope is not None else names)
    chosen = [name for name in names if name in chosen] + [name for name in names if name not in chosen]
    most = MOST_WAYS if not result.scene.trains else max(1, MOST_WAYS // (4 * len(result.scene.trains)))
    chosen = sorted(chosen[:most], key=names.index)
    found.left_out = len(names) - len(chosen)
    for name in chosen:
        _ways_of(found, visible(name), result.combinations[name], envelope, len(chosen))
    return found


def _governing(envelope: Envelope | TrainEnvelope) -> Iterator[str]:
    """Names of the combinations that extremes come from."""
    for row in [*envelope.extremes.values(), *(of for support in envelope.supports for of in support.values())]:
        for one in row.values():
            if one is not None and one.combination is not None:
                yield one.combination


def _ways_of(
    found: Collected, name: str, result: Result, envelope: Envelope | TrainEnvelope | None, shared_by: int = 1
) -> None:  # fmt: skip
    """Add the ways of one load: that of the load, those of its trains, and how it moves where it cannot stand."""
    trains = result.trains.values() if result.scene.trains and result.has_answer else ()
    traversals = [(train, one) for train in trains for one in train.traversals]
    largest = {} if envelope is None else {
        field: max((abs(one.value) for one in row.values() if one is not None), default=0.0) for field, row in envelope.extremes.items()
    }  # fmt: skip
    for train, traversal in traversals:
        going = f", going {traversal.course.direction}" if len(train.traversals) > 1 else ""
        most = MOST_NUMBERS // (len(traversals) * shared_by)
        words = ": ".join(part for part in (name, f"{visible(train.name)}{going}") if part)
        found.add(words, result, way_of_train(result, train, traversal, found.words, largest, most))
    if result.steps:
        alone = "without trains" if traversals else ""
        found.add(": ".join(part for part in (name, alone) if part), result, way_of_load(result, found.words))
    if result.motion:
        motion = {"motion": [list(pair) for pair in result.motion], "reason": result.reason, "axis": "motion"}
        found.add(": ".join(part for part in (name, "free motion") if part), result, motion)
    elif not result.steps and not traversals:
        found.add(name or "no answer", result, {"motion": [], "reason": result.reason, "axis": "motion"})
