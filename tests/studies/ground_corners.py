"""Beams on foundations in the corners of what numbers can do to them, for the study extremes, and their true errors."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from .ground_truth import solve_zones

if TYPE_CHECKING:
    from gapbeam.results.result import Result

STIFF = "ground, EI to GA"
"""A beam that nearly only shears: its rotations are a hundred millionth of the slope dw/dx, from which they come."""

Scenes = list[dict[str, Any]]
Values = dict[str, np.ndarray]
Form = Callable[[Mapping[str, Any]], Values]
"""True values of a scene: at `x` deflection, moment and shear; `ends` of contact inside the beam."""


def ground_corners() -> Iterator[tuple[str, str, Scenes, Form | None]]:
    """All families on foundations.

    Yields
    ------
    corner, value : str
        What is extreme, and how much.
    scenes : list of dict
        The scenes.
    closed_form : callable or None
        Their true values where waves die out too often to be carried by the digits of `solve_zones`.
    """
    for k in (1e-12, 1e-6, 1.0, 1e6, 1e12):
        yield "ground, k", f"{k:g}", _moduli(k), None
    for waves in (1e-8, 1e-4, 1.0, 100.0):
        yield "ground, beta L", f"{waves:g}", _waves(waves), None
    yield "ground, beta L", "10000", [_lifted_end(1e4)], _lifted_end_truth
    for share in (1e-2, 1e-4, 1e-6):
        yield "ground, zone to beam", f"{share:g}", _short_zones(share), None
    for apart in (1e-3, 1e-6, 1e-9):
        yield "ground, profile points apart by", f"{apart:g}", _near_points(apart), None
    for ratio in (1e-12, 1e-6, 1e6, 1e12):
        yield "ground, EI beside EI", f"{ratio:g}", _stiffness_ratio(ratio), None
        yield "ground, k beside k", f"{ratio:g}", _moduli_ratio(ratio), None
    for gap in (1e-9, 1.0, 1e3, 1e6):
        yield "ground, gap to deflection", f"{gap:g}", _depths(gap), None
    for GA in (1e-2, 1e2, 1e6):
        yield "ground, GA to k", f"{GA:g}", [_shear(GA, 1.0)], None
    yield STIFF, "1e+11", [_shear(1e-2, 1e9)], None


def _ground(k: Any, side: str = "below", **keys: Any) -> dict[str, Any]:
    return {"k": k, "side": side, **keys}


def _on(ground: list[dict[str, Any]], loads: list[dict[str, Any]], spans: tuple[float, ...] = (8.0,), EI: Any = 1.0,
        supports: tuple[dict[str, Any], ...] = (), **beam: Any) -> dict[str, Any]:  # fmt: skip
    return {"beam": {"spans": list(spans), "EI": EI, **beam}, "supports": list(supports), "foundation": ground, "loads": loads}


def _uniform(q: float) -> dict[str, Any]:
    return {"type": "uniform", "q": q}


def _force(x: float, F: float) -> dict[str, Any]:
    return {"type": "force", "x": x, "F": F}


def _moduli(k: float) -> Scenes:
    """Ground of modulus k under a beam of EI = 1, or k/1000: one-sided, beside supports, and both ways."""
    EI = max(1.0, k / 1000.0)
    loads = [_uniform(1.0), _force(2.5, 20.0), _force(6.0, -3.0)]
    supports = {"node": 0}, {"node": 1, "side": "below", "gap": 0.0078125}, {"node": 2, "side": "above"}
    return [
        _on([_ground(k)], loads, EI=EI),
        _on([_ground(k, gap=0.001 / EI)], loads, (4.0, 4.0), EI, supports),
        _on([_ground(k, "both")], loads, EI=EI),
        _on([_ground(k), _ground(k, "above", gap=0.5)], loads, EI=EI, supports=({"node": 0},)),
    ]


def _waves(waves: float) -> Scenes:
    """A beam that is so many times as long as 1/beta, loads such that deflections are about 1."""
    k = 4.0 * (waves / 8.0) ** 4
    loads = [_uniform(k), _force(2.5, 2.0 * k), _force(6.5, -k)]
    return [_on([_ground(k)], loads), _on([_ground(k)], [_uniform(k), _force(0.0, -k / 3.0)])]


def _lifted_end(waves: float) -> dict[str, Any]:
    """Reference problem P3: a heavy beam, one end lifted over 2/beta; and a force in its middle, far from both ends."""
    return _on([_ground(4.0)], [_uniform(1.0), _force(0.0, -1.5), _force(waves / 2.0, 1.0)], (waves,))


def _lifted_end_truth(scene: Mapping[str, Any]) -> Values:
    """Half-infinite and infinite beams: what they know of each other is exp(-beta L/2)."""
    middle = scene["beam"]["spans"][0] / 2.0
    fade = np.exp(-1.0) * np.array([np.cos(1.0) + np.sin(1.0), np.cos(1.0) - np.sin(1.0), -np.cos(1.0)])
    return {
        "ends": np.array([2.0]),
        "x": np.array([0.0, 2.0, middle, middle + 1.0]),
        "deflection": np.array([-3.5, 0.0, 0.375, 0.25 + fade[0] / 8.0]),
        "moment": np.array([0.0, 1.0, 0.25, fade[1] / 4.0]),
        "shear": np.array([1.5, -0.5, -0.5, fade[2] / 2.0]),
    }


def _short_zones(share: float) -> Scenes:
    """A beam that sags to a sharp stone, evenly and not: contact over about a share of the beam."""
    stone = {"profile": [[0.0, 2.0], [3.0, 2.0], [4.0, 0.5], [5.0, 2.0], [8.0, 2.0]]}
    held, loads = ({"node": 0}, {"node": 1}), [_uniform(1.0), _force(4.5, 0.5)]
    made = [_on([_ground(0.5 / share**2, **stone)], loads[:count], EI=16.0, supports=held) for count in (1, 2)]
    return made if share > 1e-6 else made[:1]  # the other one takes 32,768 springs, and half a minute


def _near_points(apart: float) -> Scenes:
    """Steps of the ground."""
    steps = [[0.0, 0.0], [3.0, 0.0], [3.0 + apart, 0.001], [6.0, 0.0], [6.0 + apart, -0.001], [8.0, 0.0]]
    saw = [[0.0, 0.0], *([3.0 + apart * i, 0.002 * (i % 2)] for i in range(6)), [8.0, 0.0]]
    return [_on([_ground(1e4, profile=points)], [_uniform(1.0), _force(3.0, 2.0)], EI=1e3) for points in (steps, saw)]


def _stiffness_ratio(ratio: float) -> Scenes:
    """A beam of two stiffnesses, the larger 1."""
    EI = [min(1.0, ratio), min(1.0, 1.0 / ratio)]
    loads = [_uniform(1.0), _force(2.0, 3.0), _force(7.0, -2.0)]
    return [_on([_ground(1e-6)], loads, (4.0, 4.0), EI), _on([_ground(1e-6, "both")], loads, (4.0, 4.0), EI)]


def _moduli_ratio(ratio: float) -> Scenes:
    """Ground of two moduli, beside each other, under each other, and one that grows along the beam; the larger is 10."""
    k, other = 10.0 * min(1.0, ratio), 10.0 * min(1.0, 1.0 / ratio)
    loads = [_uniform(1.0), _force(2.0, 3.0), _force(7.0, -1.0)]
    return [
        _on([_ground(k, to=4.0), _ground(other, **{"from": 4.0})], loads),
        _on([_ground(k), _ground(other, gap=0.25)], loads),
        _on([_ground([k, other])], loads),
    ]


def _depths(gap: float) -> Scenes:
    """Ground at a depth of so many times what it is pressed in."""
    loads = [_uniform(1.0), _force(3.0, 2.0)]
    return [_on([_ground(1.0, gap=gap)], loads), _on([_ground(1.0, gap=gap)], loads, supports=({"node": 0}, {"node": 1}))]


def _shear(GA: float, EI: float) -> dict[str, Any]:
    """A beam that hardly resists shear, or bends far more than it shears."""
    return _on([_ground(1.0)], [_uniform(1.0), _force(3.0, 5.0), _force(6.0, -1.0)], EI=EI, GA=GA)


def ground_errors(scene: Mapping[str, Any], result: Result, closed_form: Form | None) -> dict[str, float]:
    """Measure a solved scene of `ground_corners`.

    Parameters
    ----------
    scene : mapping
    result : Result
        Its solution, which tells where contact is about; `solve_zones` proves that it is there.
    closed_form : callable or None
        True values.

    Returns
    -------
    dict
        By kind: largest errors relative to the largest value of the kind, of ends to the length of the beam.

    Raises
    ------
    ArithmeticError
        Contact is not where the result says.
    """
    step, length = result.steps[-1], float(sum(scene["beam"]["spans"]))
    zones = [zone for zone in step.contact if zone.state == "closed"]
    ends = np.array(sorted({end for zone in zones for end in (zone.from_, zone.to) if 0.0 < end < length}))
    if closed_form is not None:
        truth = closed_form(scene)
        x = truth["x"]
        truth = {name: truth[name] for name in ("ends", "deflection", "moment", "shear")}
    else:
        nodes = np.cumsum([0.0, *scene["beam"]["spans"]]).tolist()
        marks = sorted({*nodes, *(load["x"] for load in scene["loads"] if "x" in load), *ends.tolist()})
        x = np.array([*marks, *((a + b) / 2.0 for a, b in pairwise(marks))])
        states = [state != "open" for state in step.state]
        found = solve_zones(scene, [(zone.foundation, zone.from_, zone.to) for zone in zones], x.tolist(), states)
        names = ("ends", "deflection", "rotation", "moment", "shear", "reaction", "resultant")
        truth = {name: np.array(getattr(found, name), dtype=float) for name in names}
    fields = result.at(x)
    mine = {name: getattr(fields, name) for name in ("deflection", "rotation", "moment", "shear")}
    mine |= {"ends": ends, "reaction": step.reaction, "resultant": np.array([zone.resultant for zone in zones])}
    errors = {}
    for name, values in truth.items():
        size = length if name == "ends" else np.abs(values).max(initial=1e-300)
        errors[name] = float(np.abs(mine[name] - values).max(initial=0.0) / size)
    return errors
