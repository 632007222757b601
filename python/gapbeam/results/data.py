"""A result as plain data, in the form of the JSON output."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from .result import Fields, Result


def result_data(
    result: Result, points: int = 20, steps: Callable[[Iterator], Any] = list, fields: Callable[[Fields], dict] = Fields.to_dict
) -> dict[str, Any]:
    """Everything as plain data.

    Parameters
    ----------
    result : Result
        What `gapbeam.solve` returned.
    points : int
        Divisions of each span in the table of fields.
    steps : callable
        What becomes of the steps, which come one by one, each made when its turn comes: a list unless given.
    fields : callable
        What becomes of the fields: lists unless given.

    Returns
    -------
    dict
        Only numbers, strings, lists and dicts.

    Raises
    ------
    ValueError
        `points` is no whole number, or too large.
    """
    scene = result.scene
    columns = fields(result.fields(points=points)) if result.steps else {}
    data: dict[str, Any] = {
        "title": scene.title,
        "units": {"force": scene.units.force, "length": scene.units.length},
        "status": result.status,
        "system": result.system.asdict(),
        "steps": steps(step_data(result)),
    }
    if result.status != "solved":
        data["reason"] = result.reason
        data["motion"] = None if result.motion is None else [list(pair) for pair in result.motion]
    if scene.analysis.follow == "events":
        data["events"] = [
            {"factor": e.factor, "support": e.support, "x": e.x, "event": e.event} for e in result.events
        ]
    if result.steps:
        data["fields"] = columns
        data["extremes"] = {
            name: {which: list(pair) for which, pair in row.items()} for name, row in result.extremes().items()
        }
    return data


def step_data(result: Result) -> Iterator[dict[str, Any]]:
    """Give the steps as plain data, each made when its turn comes.

    Parameters
    ----------
    result : Result
        What `gapbeam.solve` returned.

    Yields
    ------
    dict
        A step in the form of the JSON output.
    """
    scene = result.scene
    x = scene.positions(scene.supports).tolist()
    for step in result.steps:
        columns = (step.deflection, step.reaction, step.opening, step.couple)
        rows = [
            {
                "x": x[k],
                "side": support.side,
                "direction": support.direction,
                "deflection": w,
                "reaction": reaction,
                "couple": couple,
                "state": step.state[k],
                "opening": opening,
            }
            for k, (support, w, reaction, opening, couple) in enumerate(
                zip(scene.supports, *(column.tolist() for column in columns), strict=True)
            )
        ]
        yield {
            "factor": step.factor,
            "solves": step.solves,
            "seconds": step.seconds,
            "supports": rows,
            "undecided": list(step.undecided),
            "indifferent": step.indifferent,
            "certificate": step.certificate,
        }
