"""Results as plain data, in the form of the JSON output."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

from ..base.errors import EngineError
from ..scene.names import name_data
from .envelopes.over_path import is_followed
from .paths.branches import BranchPath
from .paths.dissipation import dissipated
from .state.fields import Fields
from .state.step import Step
from .trains.data import event_data, trains_data

if TYPE_CHECKING:
    import numpy as np

    from .cases.combined import CombinedResult
    from .result import Result

SCHEMA = "gapbeam-result 1"
"""What the form of the JSON output is called; the number grows when a program that reads it has to change."""


def result_data(
    result: Result, points: int = 20, steps: Callable[[Iterator], Any] = list, fields: Callable[[Fields], dict] = Fields.to_dict
) -> dict[str, Any]:
    """Everything as plain data.

    Parameters
    ----------
    result : Result
        Of one load.
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
    data = _head(result) | {"system": result.system.to_dict(), "steps": steps(step_data(result)), **_unsolved(result)}
    if result.limits:
        data["limit"] = _limit_data(result)
    if result.remarks:
        data["remarks"] = result.remarks
    if scene.analysis.follow == "events":
        data["events"] = [event_data(event, scene) for event in result.events]
    if result.steps:
        data["lifted"] = _lifted_data(result)
        data |= _limits_data(result)
        data |= modes_data(result)
        data["fields"] = columns
        data["extremes"] = _extremes_data(result)
    if is_followed(result):
        data["history_extremes"] = result.path_envelope().to_history()
    if scene.trains:
        data |= {} if result.without_trains is None else {"without_trains": result.without_trains}
        data |= trains_data(result)
        data["envelope"] = result.envelope(points).to_dict()
    return data


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
    data = _head(result)
    if result.reason is not None:
        data["reason"] = result.reason
    if result.remarks:
        data["remarks"] = result.remarks
    if result.compression is not None:
        data["compression"] = result.compression.to_dict()
    data["combinations"] = combinations(_combinations(result))
    data |= trains_data(result)
    if is_followed(result):
        data["history_extremes"] = result.path_envelope().to_history()
    data["lifted"] = _lifted_data(result)
    data |= _limits_data(result)
    if result.has_envelope:
        data["envelope"] = result.envelope(points).to_dict()
        if names := [name for name in result.limit_states if result._has_envelope_of(name)]:
            data["envelopes"] = {name: result.envelope(points, limit_state=name).to_dict() for name in names}
    return data


def _combinations(result: CombinedResult) -> Iterator[dict[str, Any]]:
    """Give the combinations as plain data, each made when its turn comes."""
    for k, name in enumerate(result.names):
        limit_state = result._plan.limit_states[k]
        yield {"name": name, **({"limit_state": limit_state} if limit_state else {}), **_combination(result.combinations[k])}


def _combination(result: Result) -> dict[str, Any]:
    """Give one of them."""
    data: dict[str, Any] = {"status": result.status, **_unsolved(result)}
    if result.without_trains is not None:
        data["without_trains"] = result.without_trains
    if result.limits:
        data["limit"] = _limit_data(result)
    if result.scene.analysis.follow == "events":
        data["events"] = [event_data(event, result.scene) for event in result.events]
    if result.compression is not None:
        data["compression"] = result.compression.to_dict()
    if not result.steps:
        return data
    steps = list(step_data(result))
    data |= steps[-1] if len(steps) == 1 else {"steps": steps, "supports": steps[-1]["supports"]}
    data |= _ground_data(result, result.steps[-1])
    data |= {name: values for name, values in modes_data(result).items() if name != "remarks"}
    data["extremes"] = _extremes_data(result)
    return data


def _head(result: Result | CombinedResult) -> dict[str, Any]:
    """What comes first."""
    units = {"force": result.scene.units.force, "length": result.scene.units.length}
    return {"schema": SCHEMA, "title": result.scene.title, "units": units, "status": result.status}


def _unsolved(result: Result) -> dict[str, Any]:
    """Why there is no answer, and how the beam moves."""
    if result.status == "solved":
        return {}
    return {"reason": result.reason, "motion": None if result.motion is None else [list(pair) for pair in result.motion]}


def _extremes_data(result: Result) -> dict[str, Any]:
    """Extremes of every field, with their places."""
    found = result._pairs_of_extremes().items()
    return {name: {which: list(pair) for which, pair in row.items()} for name, row in found}


def _lifted_data(result: Result) -> list[dict[str, Any]]:
    """Give the supports without contact as plain data."""
    supports = result.scene.supports
    return [{**one.to_dict(), **name_data(supports[one.support])} for one in result.lifted]


def _limits_data(result: Result) -> dict[str, Any]:
    """Give how far the limits of the scene are used, as plain data."""
    used = result.utilisations
    return {"utilisations": {name: one.to_dict() for name, one in used.items()}} if used else {}


def modes_data(result: Result) -> dict[str, Any]:
    """Give factors of buckling and frequencies as plain data.

    Parameters
    ----------
    result : Result
        Of one load, with a state.

    Returns
    -------
    dict
        What the scene asks for; ``remarks`` say why where they are not available for this beam.
    """
    found: dict[str, Any] = {}
    for name in ("buckling", "frequencies"):
        if getattr(result.scene.analysis, name):
            try:
                found[name] = list(getattr(result, name))
            except EngineError as error:
                found["remarks"] = [*result.remarks, str(error)]
    return found


def _limit_data(result: Result) -> dict[str, Any]:
    """Give the first limit of the load as plain data."""
    limit = result.limits[0]
    landing = limit.landing
    x = result.scene.positions(result.scene.supports).tolist()
    return {
        "factor": limit.factor,
        "kind": limit.kind,
        **({} if limit.exact else {"exact": False}),
        "landing": None
        if landing is None
        else {"factor": landing.factor, "released": limit.released, "supports": _support_data(result, landing, x)},
    }


def _friction(step: Step, k: int) -> dict[str, Any]:
    """What friction does at a support."""
    slides = step.sliding[k]
    return {"force": float(step.friction[k]), "slip": float(step.slip[k]), "slides": slides if slides != "sticks" else ""}


def _support_data(result: Result, step: Step, x: list[float], lost: np.ndarray | None = None) -> list[dict[str, Any]]:
    """Give the supports of a state as plain data, with what each of them has dissipated."""
    columns = (step.deflection, step.reaction, step.opening, step.couple, step.set)
    return [
        {
            **name_data(support),
            "x": x[k],
            "side": support.side,
            "direction": support.direction,
            **({"at_hinge": support.at_hinge} if support.at_hinge else {}),
            "deflection": w,
            "reaction": reaction,
            "couple": couple,
            "state": step.state[k],
            "opening": opening,
            **({"set": left} if support.unloading == "plastic" else {}),
            **({} if lost is None or not (support.friction or support.unloading == "plastic") else {"dissipated": float(lost[k])}),
            **({"axial": _friction(step, k)} if support.friction else {}),
        }
        for k, (support, w, reaction, opening, couple, left) in enumerate(
            zip(result.scene.supports, *(column.tolist() for column in columns), strict=True)
        )
    ]


def _ground_data(result: Result, step: Step) -> dict[str, Any]:
    """Give contact with the ground and free spans of a state as plain data."""
    if not result.scene.foundation:
        return {}
    names = [name_data(item) for item in result.scene.foundation]
    return {
        "contact": [
            {
                "foundation": c.foundation, **names[c.foundation],
                "from": c.from_, "to": c.to, "state": c.state, "resultant": c.resultant,
            }
            for c in step.contact
        ],
        "free_spans": [{"foundation": span.foundation, **span.to_dict()} for span in step.free_spans],
    }


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
    x = result.scene.positions(result.scene.supports).tolist()
    on_path = result.steps if isinstance(result.path, BranchPath) else None
    lost = dissipated(result)
    for k, step in enumerate(result.steps):
        where = {}
        if on_path is not None:
            segment = on_path.segment(k)
            where = {"path": segment.path - abs(segment.stop - step.factor), "stable": segment.stable}
            where |= {} if step.exact else {"exact": False}
        yield {
            "factor": step.factor,
            **where,
            "solves": step.solves,
            "seconds": step.seconds,
            "supports": _support_data(result, step, x, None if lost is None else lost[k]),
            **({"hinges": [one._asdict() for one in step.hinges]} if result.scene.hinges else {}),
            **_ground_data(result, step),
            **({"slip_zones": [
                {"from": one.from_, "to": one.to, "way": one.way, "friction": one.friction} for one in step.slip_zones
            ]} if result._beam.is_on_axial_ground else {}),
            "undecided": list(step.undecided),
            "indifferent": step.indifferent,
            **({} if step.unique else {"unique": False}),
            "certificate": step.certificate,
        }
