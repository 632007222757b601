"""Random beams on ground whose force falls, for comparison with `oracle/falling_ground.py`; nothing here solves anything."""

import random
from functools import partial

from .foundation import digits, rounded


def random_falling_scene(seed):
    """A scene of one span on one or two foundations, one of which falls at least; often without a state at full load.

    Parameters
    ----------
    seed : int

    Returns
    -------
    dict
    """
    rng = random.Random(seed)
    log = partial(rounded, rng)
    length, EI = rng.randint(16, 48) / 8, log(0.5, 500)
    beta = log(1, 10) / length
    k, size = 4 * EI * beta**4, log(0.5, 50)
    depth = size * beta / (2 * k) * log(0.3, 2)
    foundations = []
    for number in range(1 if rng.random() < 0.7 else 2):
        made = {"side": rng.choice(["below", "below", "above", "both", "both"])}
        if rng.random() < 0.3 or number:
            made["from"], made["to"] = (x / 8 for x in sorted(rng.sample(range(0, int(8 * length) + 1, 2), 2)))
        made["law"] = falling_law(rng, k * log(0.3, 2), depth * log(0.2, 2), log)
        if rng.random() < 0.25:
            made["law"] = along_places(rng, made["law"], made.get("from", 0.0), made.get("to", length), log)
        elif number and rng.random() < 0.4:
            made["law"] = {"type": "plastic", "stiffness": digits(k), "limit": digits(k * depth)}
        if rng.random() < 0.3:
            made["gap"] = digits(depth * log(0.05, 0.6))
        foundations.append(made)
    loads = [_load(rng, length, size, log) for _ in range(rng.randint(1, 3))]
    if rng.random() < 0.6:
        loads.append({"type": "uniform", "q": digits(size / length * log(0.05, 0.6)), "case": "dead"})
    scene = {"beam": {"spans": [length], "EI": EI}, "foundation": foundations, "loads": loads}
    if rng.random() < 0.25:
        scene["beam"]["GA"] = log(0.3, 30) * EI * beta**2
    if rng.random() < 0.6:
        scene["supports"] = [{"x": rng.choice([0.0, length, rng.randint(1, int(8 * length) - 1) / 8])}]
        if rng.random() < 0.7:
            scene["supports"][0]["stiffness"] = digits(k / beta * log(0.1, 3))
            if rng.random() < 0.5:
                scene["supports"][0].update(side="below", gap=digits(depth * log(0.05, 1)))
    return scene


def falling_law(rng, k, depth, log):
    """Points that rise, fall, and rise or stay at last."""
    d, p = depth, k * depth
    points = [[digits(d), digits(p)]]
    if rng.random() < 0.4:
        d, p = d * log(1.2, 2), p * log(1.05, 1.3)
        points.append([digits(d), digits(p)])
    for _ in range(rng.randint(1, 2)):
        d, p = d * log(1.3, 4), p * rng.uniform(0.2, 0.95)
        points.append([digits(d), digits(p)])
    points.append([digits(d * 2), digits(points[-1][1] * rng.choice([1.0, 1.0, 1.5]))])
    return points


def along_places(rng, points, left, right, log):
    """The same law at two places, at one with more force."""
    more = log(1.2, 3)
    other = [[d, digits(p * more)] for d, p in points]
    return [{"x": left, "points": points}, {"x": right, "points": other}]


def _load(rng, length, size, log):
    """A force, or a load along the beam."""
    value = digits(size * log(0.1, 1.0) * rng.choice([1, 1, 1, -1]))
    if rng.random() < 0.6:
        return {"type": "force", "x": rng.randint(0, int(8 * length)) / 8, "F": value}
    return {"type": "uniform", "q": digits(value / length)}


def filled(made, dead, live):
    """A scene under shares of its dead and of its other loads, on ground whose force never falls and is nowhere less."""
    loads = [{**load, **_shared(load, dead if load.get("case") == "dead" else live)} for load in made["loads"]]
    ground = [{**item, "law": _filled_law(item["law"])} for item in made["foundation"]]
    return {**made, "loads": loads, "foundation": ground}


def _shared(load, share):
    return {key: share * load[key] for key in ("F", "q") if key in load}


def _filled_law(law):
    if isinstance(law, dict):
        return law
    if isinstance(law[0], dict):
        return [{**at, "points": _filled_law(at["points"])} for at in law]
    return [[d, max(p for e, p in law if e <= d)] for d, _ in law]
