"""Scenes in the corners of what numbers can do to a beam, for the study extremes.

Every corner is a family of scenes that differ in one extreme number. Scenes are dicts with the names of the file format.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import inf
from typing import Any

import numpy as np

from .ground_corners import STIFF, ground_corners

WORK_A_SEED = 7
"""Seed of the loads of reference problem P6, work A."""


@dataclass(frozen=True)
class Case:
    """Scenes with one extreme number.

    Attributes
    ----------
    corner : str
        What is extreme.
    value : str
        How much.
    scenes : list of dict
        The scenes.
    closed_form : callable, optional
        Gives the true (reaction, deflection) of all supports of a scene that is too long to be solved exactly; on foundations
        what `ground_corners.ground_errors` takes.
    ill_conditioned : bool
        Whether the answer moves much more than the numbers of the scene: the error bound has to say so.
    """

    corner: str
    value: str
    scenes: list[dict[str, Any]]
    closed_form: Callable[[dict[str, Any]], Any] | None = None
    ill_conditioned: bool = False


def cases(largest: int = 10**6) -> Iterator[Case]:
    """All cases.

    Parameters
    ----------
    largest : int
        Longer beams are left out.

    Yields
    ------
    Case
    """
    for ratio in (1e-12, 1e-6, 1e-3, 1e3, 1e6, 1e12, inf):
        yield Case("EI beside EI", f"{ratio:g}", _stiffness_ratio(ratio))
    for stiffness in (0.0, 1e-12, 1e-6, 1.0, 1e6, 1e12, inf):
        yield Case("support to beam", f"{stiffness:g}", _soft_supports(stiffness))
    for span in (1e-6, 1e-4, 1e-2, 1e2, 1e4, 1e6):
        yield Case("span beside 1", f"{span:g}", _spans(span))
    yield Case("span beside span", "1e-06, 1e+06", _short_beside_long())
    for gap in (1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9, 1e12, 1e15):
        yield Case("gap to deflection", f"{gap:g}", _gaps(gap))
    for count in (2, 10, 100, 1000, 10**4, 10**5, 10**6):
        if count <= largest:
            yield Case("supports, all closed", f"{count:,}", [_equal_spans(count)], _equal_spans_truth)
    for count in (10, 100, 1000):
        if count <= largest:
            yield Case("supports, gaps (work A)", f"{count:,}", [_work_a(count)])
            yield Case("supports, front", f"{count:,}", [_front(count)])
    for slope in (1e-12, 1e-6, 1e-3, 1e3, 1e6, 1e12):
        yield Case("law, slope to slope", f"{slope:g}", _two_slopes(slope), _law_truth)
    for apart in (1e-3, 1e-6, 1e-9):
        yield Case("law, kinks apart by", f"{apart:g}", _near_kinks(apart), _law_truth)
    for rest in (1e-3, 1e-6, 1e-9, 1e-12):
        yield Case("law, falls as steeply but for", f"{rest:g}", _nearly_critical(rest), _law_truth, ill_conditioned=True)
    for small in (1e-3, 1e-6, 1e-9, 1e-12):
        yield Case("nearly a mechanism", f"{small:g}", _nearly_mechanisms(small))
    for ratio in (1e5, 1e10, 1e15):
        yield Case("load beside load", f"{ratio:g}", _loads(ratio))
    for rest in (1e-3, 1e-6, 1e-9):
        yield Case("loads that cancel but for", f"{rest:g}", _cancelling(rest), ill_conditioned=True)
    for force, length in ((-498, 0), (498, 0), (0, -332), (0, 332), (498, -498), (-498, 498)):
        value = f"force {_power(force)}, length {_power(length)}"
        yield Case("units", value, [in_units(scene, 2.0**force, 2.0**length) for scene in _ordinary()])
    for corner, value, scenes, closed_form in ground_corners():
        yield Case(corner, value, scenes, closed_form, ill_conditioned=corner == STIFF)


def _power(exponent: int) -> str:
    return "1" if exponent == 0 else f"{2.0**exponent:.0e}"


def in_units(scene: dict[str, Any], force: float, length: float) -> dict[str, Any]:
    """Write a scene in other units.

    Parameters
    ----------
    scene : dict
        A scene; it is left as it is.
    force, length : float
        Every force is multiplied by the first, every length by the second.

    Returns
    -------
    dict
        The new scene.
    """
    powers = {"EI": (force, length, length), "GA": (force,), "stiffness": (force, 1.0 / length), "rotation": (force, length)}
    powers |= {"F": (force,), "M": (force, length), "q": (force, 1.0 / length), "kappa": (1.0 / length,)}
    powers |= dict.fromkeys(("spans", "hinges", "x", "from", "to", "gap", "settlement"), (length,))

    def multiply(value: Any, factors: tuple[float, ...]) -> Any:
        if isinstance(value, list):
            return [multiply(item, factors) for item in value]
        if isinstance(value, str):
            return value
        for factor in factors:
            value = value * factor
        return value

    def convert(item: dict[str, Any]) -> dict[str, Any]:
        return {key: multiply(value, powers[key]) if key in powers else value for key, value in item.items()}

    return {key: convert(part) if isinstance(part, dict) else [convert(item) for item in part] for key, part in scene.items()}


def _scene(spans, supports, loads, EI=1.0, **beam) -> dict[str, Any]:
    return {"beam": {"spans": list(spans), "EI": EI, **beam}, "supports": supports, "loads": loads}


def _at(node: int, side: str = "both", **keys) -> dict[str, Any]:
    return {"node": node, "side": side, **keys}


def _below(*nodes: int, **keys) -> list[dict[str, Any]]:
    return [_at(node, "below", **keys) for node in nodes]


def _force(where: float, F: float) -> dict[str, Any]:
    return {"type": "force", "x": where, "F": F}


def _push(node: int, F: float) -> dict[str, Any]:
    return {"type": "force", "node": node, "F": F}


def _uniform(q: float, start: float = 0.0, stop: float | None = None) -> dict[str, Any]:
    return {"type": "uniform", "q": q, "from": start} | ({} if stop is None else {"to": stop})


def _stiffness_ratio(ratio: float) -> list[dict[str, Any]]:
    """EI alternates between 1 and `ratio`."""
    EI = [1.0, ratio, 1.0, ratio]
    loads = [_uniform(1.0), _force(2.5, 1.0), _force(3.5, -0.7)]
    every, ends = [_at(i) for i in range(5)], [_at(0), _at(4)]
    clamp = _at(0, rotation="fixed")
    one_sided = _below(1, gap=1e-3) + _below(2, gap=2e-3) + [_at(3, "above", gap=1e-3)]
    springs = [_at(i, stiffness=1.0 + i) for i in range(5)]
    mixed = _scene([1.0, 1.5], [_at(0), *_below(1), _at(2)], [_uniform(1.0), _force(1.7, -3.0)])
    mixed["sections"] = [{"from": 0.4, "to": 1.25, "EI": ratio}]
    return [
        _scene([1.0] * 4, every, loads, EI),
        _scene([1.0] * 4, springs, loads, EI),
        _scene([1.0] * 4, ends + one_sided, loads, EI),
        _scene([1.0] * 4, [clamp], loads, EI),
        _scene([1.0] * 4, [clamp, _at(2), _at(4)], loads, EI, hinges=[1.5]),
        _scene([1.0] * 4, _below(0, 1, 2, 3, 4), [_uniform(1.0), _force(2.5, 5.0)], EI),
        mixed,
    ]


def _soft_supports(stiffness: float) -> list[dict[str, Any]]:
    """Supports that are `stiffness` times EI/l^3."""
    spring = {"stiffness": stiffness}
    loads = [_uniform(1.0), _force(1.5, 1.0), _force(2.25, -2.0)]
    middle = [_at(i, **spring) for i in (1, 2, 3)]
    one_sided = [_at(1, "below", **spring), _at(2, "above", **spring), _at(3, "below", gap=0.01, **spring)]
    made = [
        _scene([1.0] * 4, [_at(0), *middle, _at(4)], loads),
        _scene([1.0] * 4, [_at(0), *one_sided, _at(4)], loads),
        _scene([1.0] * 4, [_at(0, rotation="fixed"), *one_sided, _at(4, **spring)], loads),
    ]
    if stiffness:
        turning = _at(0, rotation=stiffness) if stiffness < inf else _at(0, rotation="fixed")
        made += [
            _scene([1.0] * 4, [turning], loads),
            _scene([1.0] * 4, [_at(0, **spring), *middle, _at(4, **spring)], loads),
            _scene([1.0] * 4, _below(0, 1, 2, 3, 4, **spring), [_uniform(1.0), _force(2.5, 5.0)]),
            _scene([1.0] * 4, [*_below(0, 2, **spring), *_below(1, 3), _at(4)], [_uniform(1.0), _force(1.5, 5.0)]),
        ]
    return made


def _spans(span: float) -> list[dict[str, Any]]:
    """A span between spans of 1."""
    spans = [1.0, span, 1.0]
    every, middle = [_at(i) for i in range(4)], 1.0 + span / 2
    loads = [_uniform(1.0), _force(0.5, 1.0), _force(middle, 2.0)]
    one_sided = [_at(0), *_below(1, 2), _at(3)]
    return [
        _scene(spans, every, loads),
        _scene(spans, one_sided, loads),
        _scene(spans, one_sided, [_force(0.5, 1.0)]),
        _scene(spans, [_at(0), _at(1, stiffness=3.0), _at(2, stiffness=5.0), _at(3)], loads),
        _scene(spans, [_at(1, rotation="fixed"), *_below(3, gap=0.1)], loads),
        _scene(spans, _below(0, 1, 2, 3), loads),
    ]


def _short_beside_long() -> list[dict[str, Any]]:
    """The shortest beside the longest."""
    spans = [1e-6, 1e6, 1e-6, 1e6, 1e-6]
    loads = [_uniform(1.0), _push(2, 3.0)]
    ends = [_at(0), _at(5)]
    return [
        _scene(spans, [_at(i) for i in range(6)], loads),
        _scene(spans, ends + _below(1, 2, 3, 4), loads),
        _scene(spans, ends + [_at(i, stiffness=1e-12) for i in (1, 2, 3, 4)], loads),
        _scene(spans, [_at(0, rotation="fixed")], [_push(1, 1e18), _push(3, 1.0)]),
    ]


def _gaps(gap: float) -> list[dict[str, Any]]:
    """Gaps of `gap` times the deflection without the support, then lack of fit as large."""
    simple = 5.0 * 16.0 / 384.0
    made = []
    for signed in (gap, -gap):
        middle = _at(1, "below", gap=signed * simple)
        ends = [_at(0), _at(2)]
        made += [
            _scene([1.0, 1.0], [*ends, middle], [_uniform(1.0)]),
            _scene([1.0, 1.0], [*ends, middle | {"stiffness": 3.0}], [_uniform(1.0)]),
            _scene([1.0, 1.0], [_at(0, rotation="fixed"), middle, _at(2, "above", gap=abs(middle["gap"]))], [_uniform(1.0)]),
            _scene([1.0] * 3, [_at(0), *_below(1, 2, gap=signed * simple), _at(3)], [_uniform(1.0), _force(2.5, -1.0)]),
        ]
    return made


def _equal_spans(count: int) -> dict[str, Any]:
    """`count` one-sided supports under equal spans with a uniform load: all of them act."""
    return _scene([2.0] * (count - 1), _below(*range(count)), [_uniform(3.0)], EI=5.0)


def _equal_spans_truth(scene: dict[str, Any]) -> tuple[np.ndarray, np.ndarray]:
    """Three-moment equations with constant coefficients, solved by powers of sqrt(3) - 2."""
    spans, q = scene["beam"]["spans"], scene["loads"][0]["q"]
    count, length = len(spans), spans[0]
    root, i = np.sqrt(3.0) - 2.0, np.arange(count + 1)
    moment = -q * length**2 / 12.0 * (1.0 - (root**i + root ** (count - i)) / (1.0 + root**count))
    moment[[0, -1]] = 0.0
    jump = np.diff(moment) / length
    reaction = np.full(count + 1, q * length)
    reaction[[0, -1]] /= 2.0
    reaction[:-1] += jump
    reaction[1:] -= jump
    return reaction, np.zeros(count + 1)


def _work_a(count: int) -> dict[str, Any]:
    """Reference problem P6, work A: `count` spans, elastic one-sided supports with gaps of three sizes."""
    loads = np.random.default_rng(WORK_A_SEED).uniform(-10, 25, count).tolist()
    ends = [6.0 * i for i in range(count + 1)]
    supports = [_at(i, "below", stiffness=1e5, gap=0.002 * (i % 3)) for i in range(1, count)]
    loads = [_uniform(q, a, b) for q, a, b in zip(loads, ends, ends[1:], strict=False)]
    return _scene([6.0] * count, [_at(0), *supports, _at(count)], loads, EI=1e4)


def _front(count: int) -> dict[str, Any]:
    """Reference problem P2, last: a heavy beam on a rigid one-sided base, its end lifted; 30 m on `count` supports."""
    span = 30.0 / (count - 1)
    return _scene([span] * (count - 1), _below(*range(count)), [_uniform(1.0), _push(0, -1.5)])


def _on_law(law: list[list[float]], F: float) -> dict[str, Any]:
    """A simple beam of length 1 and EI 1 with a law and a force at midspan: stiffness 48 there."""
    return _scene([0.5, 0.5], [_at(0), _at(1, "below", law=law), _at(2)], [_push(1, F)])


def _two_slopes(slope: float) -> list[dict[str, Any]]:
    """A first slope of 1, and one beyond; on both, and before the kink."""
    law = [[0.25, 0.25], [0.25 + 1.0 / max(slope, 1.0), 0.25 + min(slope, 1.0)]]
    return [_on_law(law, F) for F in (6.0, 24.0, 240.0)] + [_on_law([[law[0][0] * slope, law[0][1]], [1e13, 1.0]], 24.0)]


def _near_kinks(apart: float) -> list[dict[str, Any]]:
    """Three kinks near each other: flat, steep, flat."""
    law = [[0.25, 4.0], [0.25 + apart, 4.0], [0.25 + 2 * apart, 8.0], [1.0, 9.0]]
    return [_on_law(law, F) for F in (8.0, 12.25, 16.0, 18.0, 40.0)]


def _nearly_critical(rest: float) -> list[dict[str, Any]]:
    """A force that falls with 48 but for a hair, from 48 at a deflection of 1 to 24: the beam takes hardly more load."""
    return [_on_law([[1.0, 48.0], [1.5, 24.0 * (1.0 + rest)], [3.0, 24.0 * (1.0 + rest)]], 96.0 + 12.0 * rest)]


def _law_truth(scene: dict[str, Any]) -> tuple[np.ndarray, np.ndarray]:
    """Reactions and deflections on the piece on which they fit, in fractions of the scene's own numbers."""
    law = [(Fraction(0), Fraction(0)), *((Fraction(d), Fraction(r)) for d, r in scene["supports"][1]["law"])]
    F = Fraction(scene["loads"][0]["F"])
    for k, ((d0, r0), (d1, r1)) in enumerate(pairwise(law)):
        slope = (r1 - r0) / (d1 - d0)
        w = (F - r0 + slope * d0) / (48 + slope)
        if w <= d1 or k == len(law) - 2:
            reaction = F - 48 * w
            return np.array([float(v) for v in (24 * w, reaction, 24 * w)]), np.array([0.0, float(w), 0.0])
    raise AssertionError(scene)


def _nearly_mechanisms(small: float) -> list[dict[str, Any]]:
    """Held by a lever arm, a spring or a preponderance of `small`."""
    near = 1.0 - small
    return [
        # a long arm held by two supports close to each other
        _scene([small, 1.0], [_at(0), _at(1)], [_push(2, 1.0)]),
        _scene([small, 1.0], [_at(0, "above"), *_below(1)], [_push(2, 1.0)]),
        # a weak spring is all that holds the end, or the rotation
        _scene([1.0, 1.0], [_at(0), _at(2, stiffness=small)], [_push(1, 1.0)]),
        _scene([1.0, 1.0], [_at(0, rotation=small)], [_push(2, 1.0)]),
        # the resultant is just inside the last support: it nearly tips
        _scene([1.0, 1.0], _below(0, 1), [_push(0, 1.0), _push(2, near)]),
        _scene([2.0, 1.0, 2.0], _below(1, 2), [_push(0, 1.0), _push(3, near), _uniform(small)]),
        # the hinge is nearly over the support
        _scene([1.0, small, 1.0], [_at(0), _at(1), _at(3)], [_push(2, 1.0), _force(0.5, 1.0)], hinges=[1.0 + small]),
        # a stretch between two hinges, carried by a short arm
        _scene(
            [1.0, small, 1.0, 1.0, 1.0], [_at(0), _at(1), *_below(4), _at(5)], [_uniform(1.0)], hinges=[1.0 + small, 2.0 + small]
        ),
    ]


def _loads(ratio: float) -> list[dict[str, Any]]:
    """Loads of 1 and of `ratio`."""
    every = [_at(i) for i in range(4)]
    one_sided = [_at(0), *_below(1, 2), _at(3)]
    far = [_force(0.5, ratio), _force(2.5, 1.0)]
    return [
        _scene([1.0] * 3, every, far),
        _scene([1.0] * 3, one_sided, far),
        _scene([1.0] * 3, one_sided, [_push(1, ratio), _force(1.5, 1.0)]),
        _scene([1.0] * 3, _below(0, 1, 2, 3), [_push(1, ratio), _push(2, 1.0), _uniform(0.01)]),
        _scene([1.0] * 3, one_sided, [_uniform(ratio), _force(1.5, -1.0), {"type": "moment", "x": 0.25, "M": 1.0}]),
        _scene([1.0] * 3, [_at(0), _at(1, stiffness=2.0), _at(2, stiffness=3.0), _at(3)], far),
    ]


def _cancelling(rest: float) -> list[dict[str, Any]]:
    """Opposite loads of 1 so near to each other that `rest` of them is left."""
    pair = [_force(0.25, 1.0), _force(0.25 + rest, -1.0)]
    return [
        _scene([1.0] * 3, [_at(i) for i in range(4)], pair),
        _scene([1.0] * 3, [_at(0), *_below(1, stiffness=2.0), _at(2, "above", stiffness=3.0), _at(3)], pair),
    ]


def _ordinary() -> list[dict[str, Any]]:
    """Scenes of every kind with ordinary numbers."""
    gaps = [_at(0), _at(1, "below", gap=0.01), _at(2, "above", gap=0.02), _at(3, "below", stiffness=50.0, gap=-0.01), _at(4)]
    loads = [_uniform(1.0), _force(1.25, 6.0), _force(3.5, -4.0), {"type": "moment", "x": 0.75, "M": 2.0}]
    loads.append({"type": "linear", "q": [2.0, -1.0], "from": 0.5, "to": 2.25})
    short = _scene([1.0] * 2, [_at(0), _at(1), _at(2)], loads[:2], EI=3.0)
    short["sections"] = [{"from": 0.25, "to": 1.5, "EI": 12.0}]
    return [
        short,
        _scene([1.0] * 4, gaps, loads, EI=7.0),
        _scene([1.0] * 4, gaps, loads, EI=7.0, GA=20.0),
        _scene([1.0] * 4, [_at(0, rotation="fixed"), _at(2, stiffness=30.0), *_below(4)], loads, EI=7.0, hinges=[1.5]),
        _scene([1.0] * 4, [_at(0, rotation=5.0), _at(3, "below", settlement=0.02)], loads, EI=[7.0, inf, 2.0, 3.0]),
        _scene([1.0] * 4, _below(0, 1, 2, 3, 4), [_uniform(1.0), _force(2.5, 8.0)], EI=7.0),
        _scene([1.0] * 4, _below(0, 1, 2, 3, 4, stiffness=40.0), [_uniform(1.0), _force(2.5, 8.0)], EI=7.0),
    ]
