"""Ground whose numbers are tables over x, and the same ground as several foundations with pairs; nothing here solves anything."""

import copy
import itertools
import random

from .curved import random_curved_scene
from .foundation import digits, eighths, random_scene
from .plain import nodes_of

LAWS = ("stiffness", "limit", "slope", "k1", "k2", "k3")


def random_tabled_scene(seed):
    """A scene on ground some of whose numbers are tables; it may be refused as a scene, where a curve has a limit of 0.

    Parameters
    ----------
    seed : int

    Returns
    -------
    dict
    """
    rng = random.Random(seed)
    made = rng.choice((random_scene, random_scene, random_curved_scene))(rng.randrange(10**9))
    return with_tables(rng, made)


def with_tables(rng, made):
    """The same scene with tables for some numbers of its ground."""
    made, length = copy.deepcopy(made), nodes_of(made)[-1]
    for item in made["foundation"]:
        ends = item.get("from", 0.0), item.get("to", length)
        if "k" in item and rng.random() < 0.8:
            item["k"] = table(rng, item["k"], *ends)
        if isinstance(item.get("law"), dict):
            for key in LAWS:
                if key in item["law"] and rng.random() < 0.6:
                    item["law"][key] = table(rng, item["law"][key], *ends, zeros=key not in ("limit", "k1", "k3"))
        elif "law" in item and rng.random() < 0.8:
            item["law"] = polylines(rng, item["law"], *ends)
    return made


def polylines(rng, law, start, end):
    """The points of a law at some places, forces times a number there, and often displacements too."""
    found, bends = [], rng.random() < 0.6
    for x in sorted({eighths(rng, max(start - 1.0, 0.0), end + 1.0) for _ in range(rng.randint(1, 4))}):
        stiffer, farther = rng.uniform(0.2, 2.0), rng.uniform(0.3, 3.0) if bends else 1.0
        found.append({"x": x, "points": [[digits(farther * d), digits(stiffer * r)] for d, r in law]})
    return found


def table(rng, value, start, end, zeros=True):
    """Points about a number or a pair, here and there a step, 0, or a point beside the foundation."""
    size = max(map(abs, value)) if isinstance(value, list | tuple) else value
    places = sorted({eighths(rng, max(start - 1.0, 0.0), end + 1.0) for _ in range(rng.randint(1, 5))})
    places = sorted(places + [x for x in places if rng.random() < 0.25])
    values = [digits(size * rng.uniform(0.2, 2.0)) for _ in places]
    if zeros and len(places) > 2 and rng.random() < 0.3:
        k = rng.randrange(len(places) - 1)
        values[k : k + 2] = 0.0, 0.0
    elif zeros and rng.random() < 0.2:
        values[0] = 0.0 if len(places) > 1 else values[0]
    return [[x, v] for x, v in zip(places, values, strict=True)]


def is_table(value):
    """Whether a value of a foundation is a list of points."""
    return isinstance(value, list) and isinstance(value[0], list)


def tables_of(item):
    """All tables of a foundation but its profile."""
    law = item["law"] if isinstance(item.get("law"), dict) else {}
    return [value for value in (item.get("k"), *law.values()) if is_table(value)]


def limits(value, x, y, start, end):
    """A number, a pair or a table just right of x and just left of y, between which it is linear."""
    if not isinstance(value, list | tuple):
        return [value, value]
    if not is_table(value):
        value = [[start, value[0]], [end, value[1]]]
    middle = (x + y) / 2
    if middle <= value[0][0]:
        return [value[0][1]] * 2
    for (a, u), (b, v) in itertools.pairwise(value):
        if a < middle < b:
            return [u + (v - u) * (at - a) / (b - a) for at in (x, y)]
    return [value[-1][1]] * 2


def in_parts(made):
    """The same scene with a foundation with pairs for every part between points of tables, and the number of each one's origin."""
    made, length, origin, parts = copy.deepcopy(made), nodes_of(made)[-1], [], []
    for number, item in enumerate(made["foundation"]):
        start, end = item.get("from", 0.0), item.get("to", length)
        places = sorted({start, end, *(x for points in tables_of(item) for x, _ in points if start < x < end)})
        for x, y in itertools.pairwise(places):
            part = {**item, "from": x, "to": y}
            if "k" in item:
                part["k"] = limits(item["k"], x, y, start, end)
            if "gap" in item:
                part["gap"] = limits(item["gap"], x, y, start, end)
            if isinstance(item.get("law"), dict):
                part["law"] = {k: v if k == "type" else limits(v, x, y, start, end) for k, v in item["law"].items()}
            if carries(part):
                parts.append(part)
                origin.append(number)
    made["foundation"] = parts
    return made, origin


def carries(part):
    """Whether ground with pairs ever pushes."""
    law = part.get("law")
    if not isinstance(law, dict):
        return law is not None or any(part["k"])
    if law["type"] == "cubic":
        return any(any(law.get(key, ())) for key in ("k1", "k2", "k3"))
    return any(law["stiffness"]) and (law["type"] != "plastic" or any(law["limit"]))
