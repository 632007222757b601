"""Scenes whose lengths, stiffnesses, loads and gaps are of any magnitude, and one scene in any units."""

import copy
import math

from .plain import scene

POWERS = {
    "spans": (1, 0, 0), "hinges": (1, 0, 0), "x": (1, 0, 0), "from": (1, 0, 0), "to": (1, 0, 0),
    "gap": (0, 0, 1), "settlement": (0, 0, 1), "kappa": (-2, 0, 1),
    "F": (0, 1, 0), "M": (1, 1, 0), "q": (-1, 1, 0),
    "EI": (3, 1, -1), "GA": (1, 1, -1), "stiffness": (0, 1, -1), "rotation": (2, 1, -1),
}  # fmt: skip
"""Powers of the units of length, force and deflection in every number of a scene."""


def in_units(made, *units):
    """The scene in units that are two to the given powers: of length, force, and deflection.

    Raises
    ------
    OverflowError
        A number of the scene is beyond the range of doubles, or so near to its end that it loses digits.
    """

    def convert(value, power):
        if isinstance(value, list):
            return [convert(number, power) for number in value]
        if isinstance(value, str) or value == 0 or math.isinf(value):
            return value
        converted = math.ldexp(value, power)
        if abs(converted) < 2.0**-1022:
            raise OverflowError
        return converted

    made = copy.deepcopy(made)
    for item in (made["beam"], *made["supports"], *made["loads"], *made.get("sections", ())):
        for key in item.keys() & POWERS.keys():
            item[key] = convert(item[key], sum(unit * power for unit, power in zip(units, POWERS[key], strict=True)))
    return made


def extreme_scene(rng, decades):
    """A scene of 1 to 4 spans in which every number may be up to so many decades from 1; spans are powers of two."""

    def size():
        return 10.0 ** rng.uniform(-decades, decades)

    def sometimes():
        return size() if rng.random() < 0.5 else 1.0

    spans = [2.0 ** int(math.log2(size())) for _ in range(rng.randint(1, 4))]
    if rng.random() < 0.7:
        spans.sort()  # a short span behind a long one is lost in rounding
    ends = [math.fsum(spans[:i]) for i in range(len(spans) + 1)]

    def place():
        if rng.random() < 0.6:
            return {"node": rng.randint(0, len(spans))}
        i = rng.randrange(len(spans))
        return {"x": ends[i] + spans[i] * rng.randint(0, 8) / 8.0}

    stiff, load = size(), size()
    supports = []
    for _ in range(rng.randint(1, 5)):
        support = {**place(), "side": rng.choice(("both", "both", "below", "above"))}
        if rng.random() < 0.4:
            support["stiffness"] = stiff * sometimes()
        if support["side"] != "both" and rng.random() < 0.5:
            support["gap"] = rng.choice((1.0, -1.0)) * sometimes()
        if rng.random() < 0.3:
            support["settlement"] = sometimes()
        if rng.random() < 0.3:
            support["rotation"] = rng.choice(("fixed", sometimes()))
        supports.append(support)
    loads = [_load(rng, load, sometimes, place) for _ in range(rng.randint(1, 4))]
    beam = {"EI": math.inf if rng.random() < 0.2 else [stiff * sometimes() for _ in spans]}
    if rng.random() < 0.3:
        beam["GA"] = [stiff * sometimes() for _ in spans]
    if rng.random() < 0.3:
        beam["EA"] = sometimes()
        held = {"stiffness": rng.choice((math.inf, sometimes())), "settlement": rng.choice((0.0, sometimes()))}
        supports.append({"node": 0, "direction": "axial", **held})
        loads.append({"type": "axial", "node": len(spans), "F": sometimes()})
    return scene(spans, supports, loads, analysis={"steps": rng.randint(1, 3), "first_order": True}, **beam)


def _load(rng, load, sometimes, place):
    """A load of any kind."""
    kind = rng.choice(("force", "moment", "uniform", "linear", "curvature"))
    found = {"type": kind, "case": rng.choice(("live", "live", "dead"))}
    if kind in ("force", "moment"):
        found |= place() | {"F" if kind == "force" else "M": rng.choice((1.0, -1.0)) * load * sometimes()}
    elif kind == "linear":
        found["q"] = [load * sometimes(), rng.choice((1.0, -1.0)) * load * sometimes()]
    else:
        found["q" if kind == "uniform" else "kappa"] = (load if kind == "uniform" else 1.0) * sometimes()
    return found
