"""The way of a load as a page follows it: states at events and the intervals between them, in which values are interpolated."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, pi
from typing import TYPE_CHECKING, Any

import numpy as np

from ..base.errors import EngineError
from ..results.envelopes.over_path import is_exact
from ..results.event_words import LIMITS, event_in_words
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
MOST_NUMBERS = 60_000
"""Numbers that the states of one load may take on the page; where they take more, only some of its events are drawn."""


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
        self.intervals: list[dict[str, Any]] = []
        self.left_out = 0
        self._largest = largest
        self._last: dict[str, np.ndarray] = {}

    def difference(self, one: dict[str, np.ndarray], other: dict[str, np.ndarray]) -> float:
        """Largest difference of two states, in parts of the largest values.

        Parameters
        ----------
        one, other : dict
            By `Recorder.columns`.

        Returns
        -------
        float
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

    def interval(self, from_: float, to: float, nodes: list[int], step: Step, **more: Any) -> None:
        """Add an interval in which the same supports act.

        Parameters
        ----------
        from_, to : float
            Its ends on the slider.
        nodes : list of int
            States equally far from each other, between which values are interpolated.
        step : Step
            A state inside.
        **more
            What else there is to be known.
        """
        self.intervals.append({"from": from_, "to": to, "nodes": nodes, "state": self.recorder.codes(step.state), **more})


def way_of_load(result: Result, words: list[str]) -> dict[str, Any]:
    """Give the way of one load.

    Parameters
    ----------
    result : Result
        Of one load, with steps.
    words : list of str
        Words for the states of supports.

    Returns
    -------
    dict
        ``over`` says what the states are: ``path`` exact, ``states`` close to each other, ``steps`` load steps, ``one`` the only
        one.
    """
    largest = {name: max(abs(pair[0]) for pair in row.values()) for name, row in result._pairs_of_extremes().items()}
    way = Way(Recorder(result, words), largest)
    if result.path is None:
        for step in result.steps:
            way.interval(step.factor, step.factor, [way.add(step)], step)
        over = "steps" if len(result.steps) > 1 else "one"
        return {"over": over, "axis": "load factor", "states": way.states, "intervals": way.intervals, "events": []}
    _follow(way, result)
    exact = is_exact(result)
    events = _events(result, way)
    return {"over": "path" if exact else "states", "axis": "load factor", "states": way.states, "intervals": way.intervals,
            "events": events, "left_out": way.left_out}  # fmt: skip


def _follow(way: Way, result: Result) -> None:
    """Go along all segments of a path."""
    path, along = result.path, 0.0
    numbers = 2 * len(result._beam.places.point_x) + 3 * len(result.scene.supports)
    every = -(-len(result.segments) * numbers // MOST_NUMBERS)
    for k, segment in enumerate(result.segments):
        start, stop = segment.start, segment.stop
        leg = getattr(segment, "leg", 0)
        length = abs(stop - start)
        more = {"leg": leg} if len(result.scene.analysis.history) > 1 else {}

        def at(share: float, segment: Any = segment, start: float = start, stop: float = stop) -> Step:
            if share == 0.0 and isinstance(path, BranchPath):
                return path.begin(segment)
            return path.step(segment, start + share * (stop - start) if share < 1.0 else stop)

        if (len(result.segments) - 1 - k) % every:
            way.left_out += 1
        elif is_exact(result):
            first, last = at(0.0), at(1.0)
            nodes = [way.add(first), way.add(last)]
            way.interval(along, along + length, nodes, last, **more)
        else:
            _curved(way, at, along, length, more)
        along += length


def _curved(way: Way, at: Callable[[float], Step], along: float, length: float, more: dict[str, Any]) -> None:
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
        way.interval(places[k], places[k + 1], numbers[k : k + 2], found[k][1] if k else found[k + 1][1], **more)


def _events(result: Result, way: Way) -> list[dict[str, Any]]:
    """Give the events of a path, each at its place on the slider, in words."""
    scene, found = result.scene, []
    on_path = isinstance(result.path, BranchPath)
    places = _places(result)
    if on_path:
        for one in result.limits:
            found.append({"at": _nearest(places, one.factor, 0.0), "factor": one.factor, "words": LIMITS[one.kind].lower()})
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
        The scene.
    event : Event, GroundEvent or TrainEvent
        What happens.

    Returns
    -------
    dict
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
