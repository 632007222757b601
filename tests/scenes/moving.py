"""Random scenes whose supports and foundations loads move, and the same scenes at rest where these have gone to."""

import copy
import random

from .foundation import digits, random_scene


def movement(by, *, support=None, foundation=None, **keys):
    """A load that moves a support or a foundation."""
    what = {"support": support} if foundation is None else {"foundation": foundation}
    return {"type": "movement", **what, "value": by, **keys}


def random_moving_scene(seed):
    """A random scene on the ground with one to four movements, about as large as what the loads press in.

    Parameters
    ----------
    seed : int

    Returns
    -------
    dict
    """
    rng = random.Random(-seed - 1)
    made = random_scene(seed)
    depth = _depth(made)
    for _ in range(rng.randint(1, 4)):
        by, case = digits(depth * rng.uniform(-1.5, 1.5)), rng.choice(({}, {}, {}, {"case": "dead"}))
        if made["supports"] and rng.random() < 0.4:
            made["loads"].append(movement(by, support=rng.randrange(len(made["supports"])), **case))
        else:
            by = [by, digits(depth * rng.uniform(-1.5, 1.5))] if rng.random() < 0.4 else by
            made["loads"].append(movement(by, foundation=rng.randrange(len(made["foundation"])), **case))
    return made


def _depth(made):
    """What the largest load presses an infinite beam into the ground."""
    ground, EI = made["foundation"][0], made["beam"]["EI"]
    k = ground.get("k") or ground["law"][0][1] / ground["law"][0][0]
    k = max(k) if isinstance(k, list) else k
    EI = max(EI) if isinstance(EI, list) else EI
    length = sum(made["beam"]["spans"])
    sizes = {"force": "F", "moment": "M", "uniform": "q", "linear": "q"}
    size = 0.0
    for load in made["loads"]:
        if load["type"] in sizes:
            given = load[sizes[load["type"]]]
            given = max(map(abs, given)) if isinstance(given, list) else abs(given)
            size = max(size, given * (length if load["type"] in ("uniform", "linear") else 1.0))
    return size * (k / EI / 4) ** 0.25 / (2 * k)


def at_rest(made, factor):
    """The same scene where its movements are settlements and gaps, as they are at a load factor; numbers may be mpf.

    A foundation that holds both ways becomes two, below and above.
    """
    scene = copy.deepcopy(made)
    moves = [load for load in scene["loads"] if load["type"] == "movement"]
    scene["loads"] = [load for load in scene["loads"] if load["type"] != "movement"]
    for load in moves:
        if "support" in load:
            support = scene["supports"][load["support"]]
            support["settlement"] = support.get("settlement", 0.0) + _share(load, factor) * load["value"]
    ground = []
    for number, item in enumerate(scene["foundation"]):
        own = [load for load in moves if load.get("foundation") == number]
        if not own:
            ground.append(item)
            continue
        ends = [[v, v] if not isinstance(v, list) else v for v in (load["value"] for load in own)]
        by = [sum(_share(load, factor) * v[i] for load, v in zip(own, ends, strict=True)) for i in (0, 1)]
        for side in {"both": ("below", "above")}.get(item.get("side", "both"), (item.get("side"),)):
            ground.append(_moved({**item, "side": side}, by if side == "below" else [-one for one in by], made))
    return {**scene, "foundation": ground}


def _share(load, factor):
    return 1 if load.get("case") == "dead" else factor


def _moved(item, by, made):
    """A one-sided foundation with other gaps."""
    start, end = item.get("from", 0.0), item.get("to", sum(made["beam"]["spans"]))
    if "profile" in item:
        points = [[x, gap] for x, gap in item["profile"]]
        for x in (start, end):
            if all(abs(x - one[0]) > 0 for one in points):
                points.append([x, _along(item["profile"], x)])
        points = sorted(one for one in points if start <= one[0] <= end)
        profile = [[x, gap + by[0] + (by[1] - by[0]) * (x - start) / (end - start)] for x, gap in points]
        return {**item, "profile": profile}
    gap = item.get("gap", 0.0)
    gap = gap if isinstance(gap, list) else [gap, gap]
    return {**item, "gap": [gap[0] + by[0], gap[1] + by[1]]}


def _along(points, x):
    """The value of a table at a place."""
    if x <= points[0][0] or x >= points[-1][0]:
        return points[0][1] if x <= points[0][0] else points[-1][1]
    k = next(k for k, one in enumerate(points) if one[0] > x)
    (a, u), (b, v) = points[k - 1], points[k]
    return u + (v - u) * (x - a) / (b - a)
