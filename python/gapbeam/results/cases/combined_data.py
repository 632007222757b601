"""Combinations as plain data, in the form of the JSON output."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

from ..data import (
    SCHEMA,
    event_data,
    ground_data,
    lifted_data,
    limit_data,
    limits_data,
    modes_data,
    step_data,
)
from ..envelopes.over_path import is_followed
from ..trains.data import trains_data

if TYPE_CHECKING:
    from ..result import Result
    from .combined import CombinedResult


def combined_data(result: CombinedResult, points: int = 20, combinations: Callable[[Iterator], Any] = list) -> dict[str, Any]:
    """Everything as plain data.

    Parameters
    ----------
    result : CombinedResult
        What `gapbeam.solve` returned.
    points : int
        Divisions of each span in the curves of the envelope.
    combinations : callable
        What becomes of the combinations, which come one by one, each made when its turn comes: a list unless given.

    Returns
    -------
    dict
        Only numbers, strings, lists and dicts.
    """
    scene = result.scene
    data: dict[str, Any] = {
        "schema": SCHEMA,
        "title": scene.title,
        "units": {"force": scene.units.force, "length": scene.units.length},
        "status": result.status,
    }
    if result.reason is not None:
        data["reason"] = result.reason
    if result.remarks:
        data["remarks"] = result.remarks
    if result.compression is not None:
        data["compression"] = result.compression.to_dict()
    data["combinations"] = combinations(_each(result))
    data |= trains_data(result)
    if is_followed(result):
        data["history_extremes"] = result.path_envelope().to_history()
    data["lifted"] = lifted_data(result)
    data |= limits_data(result)
    if result.has_envelope:
        data["envelope"] = result.envelope(points).to_dict()
        if names := [name for name in result.limit_states if result._has_envelope_of(name)]:
            data["envelopes"] = {name: result.envelope(points, limit_state=name).to_dict() for name in names}
    return data


def _each(result: CombinedResult) -> Iterator[dict[str, Any]]:
    """Give the combinations as plain data, each made when its turn comes."""
    for k, name in enumerate(result.names):
        limit_state = result._plan.limit_states[k]
        yield {"name": name, **({"limit_state": limit_state} if limit_state else {}), **_one(result.combinations[k])}


def _one(result: Result) -> dict[str, Any]:
    data: dict[str, Any] = {"status": result.status}
    if result.status != "solved":
        data["reason"] = result.reason
        data["motion"] = None if result.motion is None else [list(pair) for pair in result.motion]
    if result.without_trains is not None:
        data["without_trains"] = result.without_trains
    if result.limits:
        data["limit"] = limit_data(result)
    if result.scene.analysis.follow == "events":
        data["events"] = [event_data(event, result.scene) for event in result.events]
    if result.compression is not None:
        data["compression"] = result.compression.to_dict()
    if not result.steps:
        return data
    steps = list(step_data(result))
    data |= steps[-1] if len(steps) == 1 else {"steps": steps, "supports": steps[-1]["supports"]}
    data |= ground_data(result, result.steps[-1])
    data |= {name: values for name, values in modes_data(result).items() if name != "remarks"}
    found = result._pairs_of_extremes()
    data["extremes"] = {name: {which: list(pair) for which, pair in row.items()} for name, row in found.items()}
    return data
