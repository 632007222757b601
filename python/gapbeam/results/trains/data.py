"""Trains as plain data, in the form of the JSON output."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from ...scene.names import name_data

if TYPE_CHECKING:
    from ...scene.structs import Scene
    from ..paths.ground_path import GroundEvent
    from ..paths.path import Event
    from ..result import Result
    from .trains import TrainResult
    from .traversals import TrainEvent


def passing_trains(result: Result) -> Iterator[tuple[str | None, TrainResult]]:
    """Go through the trains of a result, in every combination in which they act.

    Parameters
    ----------
    result : Result
        What `gapbeam.solve` returned.

    Yields
    ------
    combination : str or None
        Its name; None in a scene without any.
    train : TrainResult
    """
    if not result.combinations:
        for train in result.trains.values():
            yield None, train
        return
    for name, combination in result.combinations.items():
        for train in combination.trains.values() if combination.has_answer else ():
            yield name, train


def lost_positions(trains: Mapping[str, TrainResult]) -> tuple[str, str] | None:
    """Say that positions of trains are not solved.

    Parameters
    ----------
    trains : mapping of TrainResult
        Of a scene, or of a combination.

    Returns
    -------
    status, reason : str
        Of the first at which the beam is unstable, else of the first without a unique answer; None where all are solved.
    """
    lost = [(train, gap) for train in trains.values() for gap in train.unstable_positions if gap.status != "solved"]
    if not lost:
        return None
    train, gap = next((one for one in lost if one[1].status == "no-equilibrium"), lost[0])
    return gap.status, f"train {train.name}, positions {gap.from_:.6g} to {gap.to:.6g}: {gap.reason}"


def trains_data(result: Result) -> dict[str, Any]:
    """Give trains as plain data: events, and positions that are not solved.

    Parameters
    ----------
    result : Result
        What `gapbeam.solve` returned.

    Returns
    -------
    dict
        Empty without trains.
    """
    if not result.scene.trains:
        return {}
    return {"trains": [train_data(train, result.scene, combination) for combination, train in passing_trains(result)]}


def train_data(train: TrainResult, scene: Scene, combination: str | None = None) -> dict[str, Any]:
    """Give a train as plain data: events, and positions that are not solved.

    Parameters
    ----------
    train : TrainResult
    scene : Scene
        Knows the names of supports and foundations.
    combination : str, optional
        In which it passes.
    """
    return {
        "name": train.name,
        **({} if combination is None else {"combination": combination}),
        "case": train.train.case,
        "events": [event_data(event, scene) for event in train.events],
        "gaps": [
            {"from": gap.from_, "to": gap.to, "status": gap.status, "reason": gap.reason, "direction": gap.direction}
            for gap in train.unstable_positions
        ],
        "solves": train.solves,
    }


def event_data(event: Event | GroundEvent | TrainEvent, scene: Scene) -> dict[str, Any]:
    """Give an event as plain data.

    Parameters
    ----------
    event : Event, GroundEvent or TrainEvent
        Of a support, or of a zone of contact with the ground.
    scene : Scene
        Knows their names.

    Returns
    -------
    dict
        ``factor``, or ``position`` and ``direction`` of a train; ``support`` or ``foundation`` is there, the number of what
        changes; ``branch`` only beyond the first.
    """
    kind, items = ("support", scene.supports) if event.support is not None else ("foundation", scene.foundation)
    number, branch = getattr(event, kind), getattr(event, "branch", 1)
    found = {kind: number, **name_data(items[number]), "x": event.x, "event": event.event}
    found |= {"branch": branch} if branch != 1 else {}
    position = getattr(event, "position", None)
    if position is None:
        return {"factor": event.factor, **found}
    return {"position": position, **found, "direction": event.direction}
