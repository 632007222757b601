"""The way of a load as a page follows it: states at events and the intervals between them, in which values are interpolated."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, pi
from typing import TYPE_CHECKING, Any

import numpy as np

from ..base.errors import EngineError
from ..results.envelopes.over_path import is_exact
from ..results.event_words import event_in_words, limit_in_words
from ..results.paths.branches import BranchPath
from .states import FIELD_OF, Recorder, stands

if TYPE_CHECKING:
    from ..results.paths.ground_path import GroundEvent
    from ..results.paths.path import Event
    from ..results.result import Result
    from ..results.state.step import Step
    from ..results.trains.traversals import TrainEvent
    from ..scene.structs import Scene

PIXEL = 1.0 / 160.0
"""Share of the height of a panel by which a drawn state may differ from the exact one, where values are curved."""
DEEPEST = 6
"""Times that an interval is halved at most."""
SAME = 1e-9
"""Share of the largest value by which states on both sides of an event differ by rounding."""
WITH_DOUBLES, WITH_SUPPORTS, MOST_NUMBERS = 9_000, 25_000, 50_000
"""Numbers on a page up to which all are doubles; up to which those of supports are, all others having seven digits; and up to
which all events of a load are drawn."""


class Way:
    """States and intervals of one slider, as they grow.

    Parameters
    ----------
    recorder : Recorder
        Of the beam.
    largest : dict
        Largest value of every field, by which differences are judged.

    Attributes
    ----------
    left_out : int
        Intervals that are not given, since they would take too many numbers.
    """

    def __init__(self, recorder: Recorder, largest: dict[str, float]) -> None:
        self.recorder = recorder
        self.states: list[dict[str, Any]] = []
        self.intervals: list[list[Any]] = []
        self.schemes: dict[str, int] = {}
        self.left_out = 0
        self._largest = largest
        self._last: dict[str, np.ndarray] = {}

    def difference(self, one: dict[str, np.ndarray], other: dict[str, np.ndarray]) -> float:
        """Largest difference of two states, in parts of the largest values.

        Parameters
        ----------
        one, other : dict
            By `Recorder.columns`.
        """
        sizes = {name: self._largest.get(FIELD_OF[name]) or 1.0 for name in one}
        return max(float(np.abs(one[name] - other[name]).max(initial=0.0)) / size for name, size in sizes.items())

    def add(self, step: Step) -> int:
        """Add a state, unless the last one is the same.

        Parameters
        ----------
        step : Step
            The state.

        Returns
        -------
        int
            Its number.
        """
        columns = self.recorder.columns(step)
        if not self._last or self.difference(columns, self._last) > SAME:
            self.states.append(self.recorder.record(step))
            self._last = columns
        return len(self.states) - 1

    def interval(self, from_: float, to: float, nodes: list[int], step: Step, leg: int | None = None) -> None:
        """Add an interval in which the same supports act.

        Parameters
        ----------
        from_, to : float
            Its ends on the slider.
        nodes : list of int
            States equally far from each other, between which values are interpolated.
        step : Step
            A state inside.
        leg : int, optional
            Which factor of a history the load goes to.
        """
        scheme = self.schemes.setdefault(self.recorder.codes(step.state), len(self.schemes))
        self.intervals.append([from_, to, scheme, nodes, *([] if leg is None else [leg])])

    def to_dict(self) -> dict[str, Any]:
        """Give the intervals.

        Returns
        -------
        dict
            ``intervals`` rows of both ends, number of the scheme, numbers of the states, leg; ``schemes`` a digit a support.
        """
        return {"intervals": self.intervals, "schemes": list(self.schemes)}


def count_numbers(result: Result) -> int:
    """Count the numbers that the states of a load take.

    Parameters
    ----------
    result : Result
        Of one load.
    """
    numbers = 2 * len(result._beam.places.point_x) + 3 * len(result.scene.supports)
    return numbers * (len(result.steps) if result.path is None else len(result.segments) + 1)


def way_of_load(result: Result, words: list[str], together: int) -> dict[str, Any]:
    """Give the way of one load.

    Parameters
    ----------
    result : Result
        Of one load, with steps.
    words : list of str
        Words for the states of supports.
    together : int
        Numbers that all loads of the page take.

    Returns
    -------
    dict
        ``over`` says what the states are: ``path`` exact, ``states`` close to each other, ``steps`` load steps, ``one`` the only
        one.
    """
    largest = {name: max(abs(pair[0]) for pair in row.values()) for name, row in result._pairs_of_extremes().items()}
    short = (together > WITH_DOUBLES) + (together > WITH_SUPPORTS)
    way = Way(Recorder(result, words, short), largest)
    if result.path is None:
        for step in result.steps:
            way.interval(step.factor, step.factor, [way.add(step)], step)
        over = "steps" if len(result.steps) > 1 else "one"
        return {"over": over, "axis": "load factor", "states": way.states, **way.to_dict(), "events": []}
    _follow(way, result, -(-together // MOST_NUMBERS))
    exact = is_exact(result)
    events = _events(result)
    return {"over": "path" if exact else "states", "axis": "load factor", "states": way.states, **way.to_dict(), "events": events,
            "left_out": way.left_out, "short": short}  # fmt: skip


def _follow(way: Way, result: Result, every: int) -> None:
    """Go along the segments of a path: all, or only some."""
    path, along = result.path, 0.0
    for k, segment in enumerate(result.segments):
        start, stop = segment.start, segment.stop
        leg = getattr(segment, "leg", 0)
        length = abs(stop - start)
        shown = leg if len(result.scene.analysis.history) > 1 else None

        def at(share: float, segment: Any = segment, start: float = start, stop: float = stop) -> Step:
            if share == 0.0 and isinstance(path, BranchPath):
                return path.begin(segment)
            return path.step(segment, start + share * (stop - start) if share < 1.0 else stop)

        if (len(result.segments) - 1 - k) % every:
            way.left_out += 1
        elif is_exact(result):
            first, last = at(0.0), at(1.0)
            nodes = [way.add(first), way.add(last)]
            way.interval(along, along + length, nodes, last, shown)
        else:
            _curved(way, at, along, length, shown)
        along += length


def _curved(way: Way, at: Callable[[float], Step], along: float, length: float, leg: int | None) -> None:
    """Go along a segment on which values are curved: by states so close that straight lines between them are right to a pixel."""

    def share(u: float) -> float:  # closer at both ends, where the load may turn round
        return 0.0 if u == 0.0 else 1.0 if u == 1.0 else (1.0 - cos(pi * u)) / 2

    def state(u: float) -> tuple[float, Step, dict[str, np.ndarray]] | None:
        try:
            step = at(share(u))
            return (u, step, way.recorder.columns(step)) if stands(step) else None
        except EngineError:  # so near an event that the state is not found: its neighbours do
            return None

    def between(one: Any, other: Any, depth: int) -> list[Any]:
        middle = state((one[0] + other[0]) / 2)
        if middle is None:
            return []
        part = (share(middle[0]) - share(one[0])) / (share(other[0]) - share(one[0]))
        straight = {name: (1 - part) * one[2][name] + part * other[2][name] for name in one[2]}
        if depth > 1 and way.difference(straight, middle[2]) < PIXEL:
            return []
        if depth >= DEEPEST:
            return [middle]
        return [*between(one, middle, depth + 1), middle, *between(middle, other, depth + 1)]

    first, last = state(0.0), state(1.0)
    if first is None or last is None:
        found = [one for one in (first, last) if one is not None]
    else:
        found = [first, *between(first, last, 0), last]
    numbers = [way.add(one[1]) for one in found]
    places = [along + share(one[0]) * length for one in found]
    for k in range(len(found) - 1):
        way.interval(places[k], places[k + 1], numbers[k : k + 2], found[k][1] if k else found[k + 1][1], leg)


def _events(result: Result) -> list[dict[str, Any]]:
    """Give the events of a path, each at its place on the slider, in words."""
    scene, found = result.scene, []
    on_path = isinstance(result.path, BranchPath)
    places = _places(result)
    if on_path:
        for one in result.limits:
            words = limit_in_words(result, one.kind).lower()
            found.append({"at": _nearest(places, one.factor, 0.0), "factor": one.factor, "words": words})
    along = 0.0
    for event in result.events:
        along = _nearest(places, event.factor, along)
        found.append({"at": along, "factor": event.factor, **of_event(scene, event)})
    return sorted(found, key=lambda one: one["at"])


def of_event(scene: Scene, event: Event | GroundEvent | TrainEvent) -> dict[str, Any]:
    """Give what an event is about, where it is, and what happens in words.

    Parameters
    ----------
    scene : Scene
    event : Event, GroundEvent or TrainEvent
        What happens.
    """
    what = {"foundation": event.foundation} if event.support is None else {"support": event.support}
    return {**what, "x": event.x, "words": event_in_words(scene, event)}


def _places(result: Result) -> list[tuple[float, float]]:
    """Places on the slider and load factors where segments begin and end."""
    along, found = 0.0, []
    for segment in result.segments:
        found.append((along, segment.start))
        along += abs(segment.stop - segment.start)
        found.append((along, segment.stop))
    return found


def _nearest(places: list[tuple[float, float]], factor: float, from_: float) -> float:
    """Place on the slider of a load factor, not before another one."""
    behind = [(abs(one - factor), at) for at, one in places if at >= from_ - 1e-12] or [(0.0, from_)]
    return min(behind)[1]
