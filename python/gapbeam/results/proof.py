"""A state as a file that others can check: the scene, what every support does in it, and what is claimed.

`tests/oracle/checkers/proof_checker.py` decides whether it is right, without anything of this package.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping, Sequence
from math import inf, isfinite
from typing import Any

import msgspec
import numpy as np

from ..base.errors import SceneError
from ..engine.beam import Beam
from ..scene.combinations import plan_combinations, times
from ..scene.laws import is_smooth, law_points
from ..scene.movements import moves_ground, settle_movements
from ..scene.places import nearest, same_place
from ..scene.reading import read_beam, read_scene
from ..scene.structs import Scene
from ..scene.temperature import as_curvatures
from ..scene.wording import enumerated, shown
from .result import Result
from .state.step import Step
from .stepping import solve

FORMAT = "gapbeam-proof 1"
"""What the form of the file is called."""


def proof_data(
    source: Scene | Mapping[str, Any] | str | os.PathLike, factor: float | None = None, combination: str | None = None
) -> dict[str, Any]:
    """Solve a scene and give one state of it as plain data that a checker takes.

    Parameters
    ----------
    source : Scene, mapping, str or path
        As for `gapbeam.solve`.
    factor : float, optional
        Load factor of the state; default the last one of the scene.
    combination : str, optional
        Name of the combination; default the last one.

    Returns
    -------
    dict
        The scene of this state alone (its loads times their factors, no combinations), ``solved`` with states and values, or
        ``no-equilibrium`` with the motion. Values are hexadecimal doubles.

    Raises
    ------
    SceneError
        What is asked for is not there, or the load does not come so far.
    EngineError
        No unique answer exists.

    Examples
    --------
    >>> data = proof_data({"beam": {"spans": [2.0], "EI": 1.0}, "supports": [{"node": 0}, {"node": 1, "side": "below"}],
    ...                    "loads": [{"type": "force", "x": 1.0, "F": 3.0}]})
    >>> data["states"], data["values"]["reaction"]
    (['bilateral', 'closed'], ['0x1.8000000000000p+0', '0x1.8000000000000p+0'])
    """
    scene = _one_load(read_scene(source), combination)
    for k, load in enumerate(scene.loads):
        if moves_ground(load):
            raise SceneError(f"loads[{k}]", "proofs do not know ground that moves; write it as the gap of the foundation")
    for k, ground in enumerate(scene.foundation):
        if ground.k == inf:
            raise SceneError(f"foundation[{k}].k", "proofs do not know rigid ground; give it a stiffness")
    at = scene.analysis.history[-1] if factor is None else factor
    if not isfinite(at):
        raise SceneError("--factor", f"expected a finite number, got {shown(at)}")
    beam = read_beam(scene)[1]
    if beam.depends_on_path:
        result = solve(scene)
        step = _on_path(result, at)
        scene = _at_factor(scene, at)
    else:
        scene = _at_factor(scene, at)
        result = solve(scene)
        step = result.steps[-1] if result.status == "solved" else None
    data = {"format": FORMAT, "scene": _plain(scene, beam), "status": result.status}
    if step is None:
        return data | {"states": [], "values": {}, "motion": _motion(scene, result, beam), "zones": []}
    values = {"deflection": _hexadecimal(step.deflection), "reaction": _hexadecimal(step.reaction)}
    zones = [[zone.foundation, *_hexadecimal((zone.from_, zone.to))] for zone in step.contact]
    return data | {"states": list(step.state), "values": values, "motion": [], "zones": zones}


def _one_load(scene: Scene, combination: str | None) -> Scene:
    """One load of a scene: that of a combination, or the only one."""
    if scene.trains:
        raise SceneError("trains", "a proof is of loads that stay; leave the trains out, or put one in a place as forces")
    if not scene.combinations:
        if combination is not None:
            raise SceneError("--combination", "the scene has no combinations; leave it out")
        return scene
    for i, one in enumerate(scene.combinations):
        if "parts" in one.expand.values():
            problem = 'a proof is of loads that stand somewhere; write those on parts of spans as loads of a case of their own'
            raise SceneError(f"combinations[{i}].expand", problem)
    plan = plan_combinations(scene)
    name = plan.names[-1] if combination is None else combination
    if name not in plan.names:
        raise SceneError("--combination", f"there is no {shown(name)}; there are {enumerated(map(shown, plan.names))}")
    k = plan.names.index(name)
    if plan.scheme_of[k] is not None:
        raise SceneError("--combination", f"{shown(name)} takes the supports that act in another one, which is no state of its own")
    return plan.scene_of(k)


def _at_factor(scene: Scene, factor: float) -> Scene:
    """The scene whose state in full is that of the load factor, reached in one step."""
    loads = [load if load.case == "dead" or factor == 1.0 else times(load, factor) for load in scene.loads]
    once = msgspec.structs.replace(scene.analysis, steps=1, follow="steps", history=[1.0], at_limit="stop", N_with="dead")
    grown = scene
    if scene.analysis.N_with == "live":
        N = (factor * np.asarray(scene.beam.N)).tolist()
        sections = [one if one.N is None else msgspec.structs.replace(one, N=factor * one.N) for one in scene.sections]
        grown = msgspec.structs.replace(scene, beam=msgspec.structs.replace(scene.beam, N=N), sections=sections)
    return as_curvatures(settle_movements(msgspec.structs.replace(grown, loads=loads, analysis=once)), those_that_bend_only=True)


def _on_path(result: Result, factor: float) -> Step | None:
    """The state at a factor, where it depends on the loading history."""
    if result.status == "no-equilibrium":
        return None
    try:
        return result.state(factor)
    except ValueError:
        reason = f" ({result.reason})" if result.reason else ""
        raise SceneError("--factor", f"the load does not come to {factor:g}{reason}; give a factor below its limit") from None


def _motion(scene: Scene, result: Result, beam: Beam) -> list[str]:
    """Displacements of span ends and hinges in the free motion; none where the beam slides along its axis."""
    if result.motion is None:
        return []
    x, w = zip(*result.motion, strict=True)
    knots = np.unique(np.concatenate((scene.span_ends(), _snapped(scene.beam.hinges, beam))))
    return _hexadecimal(np.interp(knots, x, w))


def _snapped(places: Sequence[float], beam: Beam) -> np.ndarray:
    """Places as the engine takes them: what differs from one of its points by rounding only is there."""
    x, points = np.asarray(places, dtype=float), beam.places.point_x
    point = points[nearest(x, points)]
    inside = np.clip(x, points[0], points[-1])
    return np.where(same_place(inside, point), point, inside)


def _plain(scene: Scene, beam: Beam) -> dict[str, Any]:
    """The scene with every key that changes a result, laws as points, and places that are one as one number."""
    data = {"title": scene.title, **{key: msgspec.to_builtins(getattr(scene, key)) for key in ("units", "beam")}}
    for unused in ("width", "direction", "alpha", "depth", "mass", *(() if np.any(scene.beam.N) else ("N",))):
        del data["beam"][unused]
    if scene.analysis.stretching:
        data["stretching"] = True  # which checkers do not know, and say so
    data["beam"]["hinges"] = _snapped(scene.beam.hinges, beam).tolist()
    for key in ("sections", "supports", "foundation", "loads"):
        items = map(msgspec.to_builtins, getattr(scene, key))
        data[key] = [{name: value for name, value in table.items() if value is not None} for table in items]
        for name in ("x", "from", "to"):
            tables = [table for table in data[key] if name in table]
            for table, x in zip(tables, _snapped([table[name] for table in tables], beam).tolist(), strict=True):
                table[name] = x
    for table in data["sections"]:
        for key in [key for key in ("EI", "GA", "EA") if isinstance(table.get(key), tuple | list | dict)]:
            table[f"tapered {key}"] = table.pop(key)  # which checkers do not know, and say so
    for table in data["foundation"]:
        if not table["shear"]:
            del table["shear"]
    if scene.hinges:
        data["hinges"] = list(map(msgspec.to_builtins, scene.hinges))
    for table, support in zip(data["supports"], scene.supports, strict=True):
        if not support.friction:
            del table["friction"]
        if support.law is not None:
            del table["stiffness"]
            if not is_smooth(support.law):
                table["law"] = law_points(support.law)
    return json.loads(json.dumps(data))  # tuples are lists


def _hexadecimal(values: Iterable[float]) -> list[str]:
    return [float(value).hex() for value in values]
