"""Random scenes with one-sided foundations, for comparison with `oracle/foundation.py`; nothing here solves anything.

Lengths are multiples of 1/8, all other numbers have three digits; stiffnesses and gaps are chosen about the scale on
which the foundation bends the beam and is closed by the loads, so that most scenes lift off somewhere.
"""

import math
import random

from .plain import INF, curvature, force, linear, moment, nodes_of, place, scene, stretch, uniform


def random_scene(seed):
    """A scene of 1 to 4 spans with one or two foundations; usually with an equilibrium.

    Parameters
    ----------
    seed : int

    Returns
    -------
    dict
    """
    rng = random.Random(seed)
    spans = [eighths(rng, 1, 5) for _ in range(rng.choice((1, 1, 2, 2, 3, 4)))]
    length = sum(spans)
    EI = rounded(rng, 0.5, 500)
    made = scene(spans, [], EI=[rounded(rng, EI / 3, EI * 3) for _ in spans] if rng.random() < 0.3 else EI)
    beta = rounded(rng, 1, 20) / length
    k = 4 * EI * beta**4
    if rng.random() < 0.25:
        made["beam"]["GA"] = digits(rounded(rng, 0.3, 30) * EI * beta**2)
    size = rounded(rng, 0.5, 50)  # of forces
    depth = size * beta / (2 * k)  # and what they press in
    made["foundation"] = [foundation(rng, length, k, depth)]
    if rng.random() < 0.4:
        made["foundation"].append(second(rng, made["foundation"][0], length, k, depth))
    add_supports(rng, made, k / beta, depth)
    add_parts(rng, made, EI, length)
    made["loads"] = [load(rng, made, length, size, EI) for _ in range(rng.randint(1, 4))]
    if rng.random() < 0.8 or "hinges" in made["beam"]:
        made["loads"].append(uniform(rounded(rng, 0.05, 1.5) * size / length, case="dead"))
    for item in made["loads"]:
        if "case" not in item and rng.random() < 0.2:
            item["case"] = "dead"
        if item["type"] == "moment" and place(made, item) in made["beam"].get("hinges", []):
            item.update(type="force", F=item.pop("M"))
    return made


def eighths(rng, low, high):
    """A multiple of 1/8."""
    return rng.randint(round(8 * low), round(8 * high)) / 8.0


def digits(value):
    """A number with three digits."""
    return float(f"{value:.3g}")


def rounded(rng, low, high):
    """A logarithmically even number of three digits."""
    return digits(math.exp(rng.uniform(math.log(low), math.log(high))))


def part(rng, length):
    """(from, to), at least 1/4 long."""
    while True:
        a, b = sorted((eighths(rng, 0, length), eighths(rng, 0, length)))
        if b - a >= 0.25:
            return a, b


def foundation(rng, length, k, depth, **keys):
    """A foundation of stiffness k or so."""
    made = stretch(*part(rng, length)) if rng.random() < 0.4 else {}
    start, end = made.get("from", 0.0), made.get("to", length)
    side = made["side"] = rng.choice(("below", "below", "below", "below", "above", "both"))
    kind = rng.random()
    if kind < 0.25:
        made["law"] = law(rng, k, depth)
    elif kind < 0.4:
        made["k"] = [digits(k * rng.choice((0, 0.2, 1))), digits(k * rng.uniform(0.5, 2))]
        rng.shuffle(made["k"])
    else:
        made["k"] = digits(k)
    kind = rng.random()
    low = -1 if side != "both" else 0
    if kind < 0.25:
        made["gap"] = digits(depth * rng.uniform(low / 2, 1))
    elif kind < 0.4:
        made["gap"] = [digits(depth * rng.uniform(low / 2, 1)) for _ in range(2)]
    elif kind < 0.6:
        places = sorted({eighths(rng, start, end) for _ in range(rng.randint(2, 5))} | {start})
        made["profile"] = [[x, digits(depth * rng.uniform(low, 2))] for x in places]
    return {**made, **keys}


def second(rng, first, length, k, depth):
    """Another foundation: against the first, under it, or anywhere."""
    kind, factor = rng.randrange(3), rng.choice((0.1, 1, 5))
    if kind == 0:
        side = "above" if first["side"] == "below" else "below"
        return foundation(rng, length, factor * k, depth, side=side)
    if kind == 1:
        made = {key: first[key] for key in ("from", "to", "side") if key in first}
        return {**made, "k": digits(factor * k), "gap": digits(depth * rng.uniform(0.1, 1.5))}
    return foundation(rng, length, factor * k, depth)


def law(rng, k, depth):
    """Points of a law whose slopes are not negative, rarely level at its end."""
    d = r = 0.0
    points = []
    for i in range(rng.randint(1, 3)):
        d += depth * rng.uniform(0.2, 1.5)
        r += 0.0 if i and rng.random() < 0.15 else k * depth * rng.uniform(0.1, 2)
        points.append([digits(d), digits(r)])
    return points


def add_supports(rng, made, k, depth):
    """Fill the supports: stiffness about k, gaps about the depth; two-sided clearances too."""
    length = nodes_of(made)[-1]
    places = [{"node": i} for i in range(len(made["beam"]["spans"]) + 1) if rng.random() < 0.5]
    places += [{"x": eighths(rng, 0, length)} for _ in range(rng.choice((0, 0, 1, 2)))]
    seen, sided = set(), 0
    for where in places:
        x = place(made, where)
        if x in seen:
            continue
        seen.add(x)
        side = rng.choice(("both", "below", "below", "above", "pair"))
        values = {"stiffness": digits(k * rng.uniform(0.05, 5))} if rng.random() < 0.4 else {}
        if rng.random() < 0.2:
            values["settlement"] = digits(depth * rng.uniform(-1, 1))
        if rng.random() < 0.2:
            values["rotation"] = rng.choice(("fixed", rounded(rng, 0.1, 100)))
        if side == "pair" and sided < 5:
            for each in ("below", "above"):
                made["supports"].append({**where, **values, "side": each, "gap": digits(depth * rng.uniform(0.1, 1))})
                values.pop("rotation", None)
            sided += 2
        elif side in ("below", "above") and sided < 6:
            gap = {"gap": digits(depth * rng.uniform(-0.5, 1))} if rng.random() < 0.6 else {}
            made["supports"].append({**where, **values, "side": side, **gap})
            sided += 1
        else:
            made["supports"].append({**where, **values})


def add_parts(rng, made, EI, length):
    """Sections and hinges, the hinges away from supports that hold rotations."""
    if rng.random() < 0.2:
        section = {"EI": rounded(rng, EI / 4, EI * 4)}
        if made["beam"].get("GA", INF) != INF and rng.random() < 0.5:
            section["GA"] = digits(made["beam"]["GA"] * rng.uniform(0.3, 3))
        made["sections"] = [stretch(*part(rng, length), **section)]
    turned = {place(made, s) for s in made["supports"] if "rotation" in s}
    places = {eighths(rng, 0.125, length - 0.125) for _ in range(rng.choice((0, 0, 0, 1, 2)))}
    if places - turned:
        made["beam"]["hinges"] = sorted(places - turned)


def load(rng, made, length, size, EI):
    """A load, mostly downward."""
    sign = 1 if rng.random() < 0.75 else -1
    F, kind = sign * rounded(rng, size / 5, size), rng.random()
    if kind < 0.4:
        where = rng.choice(({"x": eighths(rng, 0, length)}, {"node": rng.randrange(len(made["beam"]["spans"]) + 1)}))
        return force(place(made, where), F) if "x" in where else {"type": "force", **where, "F": F}
    if kind < 0.55:
        return moment(eighths(rng, 0, length), digits(F * rng.uniform(0.1, 1)))
    a, b = part(rng, length)
    q = digits(F / (b - a))
    if kind < 0.75:
        return uniform(q, **stretch(a, b))
    if kind < 0.92:
        return linear(q, digits(q * rng.uniform(-1, 2)), **stretch(a, b))
    return curvature(digits(F * length / EI / 10), **stretch(a, b))
