"""Small scenes drawn by seed for the comparison with an enumeration, many of them degenerate on purpose.

`draw(seed)` gives the same scene in every run. Ties are made exactly: a scene is solved in fractions, loads and gaps
are multiplied until the wanted gap or force is a whole number, and the support is put exactly there. Scenes on which
switching all wrong supports at once never ends are found by simulating that rule for many beams at a time.
"""

import copy
import random
from fractions import Fraction

import numpy as np
import oracle

from .plain import (
    INF,
    at,
    force,
    linear,
    moment,
    nodes_of,
    one_sided,
    place,
    random_scene,
    scene,
    stretch,
    uniform,
)

#: Kinds of scene with their shares
KINDS = {
    "held": 18,
    "any supports": 18,
    "free": 12,
    "round numbers": 10,
    "zero gaps": 8,
    "zero loads": 4,
    "symmetric": 8,
    "over supports": 7,
    "rigid": 5,
    "tie by gap": 4,
    "tie by force": 4,
    "cycling": 2,
}
MOST_ONE_SIDED = 5


def draw(seed, kind=None):
    """Kind and scene of a seed.

    Parameters
    ----------
    seed : int
    kind : str, optional
        One of `KINDS`; default: drawn too.

    Returns
    -------
    kind : str
    made : dict
    """
    rng = random.Random(seed)
    drawn = rng.choices(list(KINDS), list(KINDS.values()))[0]
    kind = kind or drawn
    made = MAKERS[kind](rng)
    made["analysis"] = {"steps": 1 if kind.startswith("tie") or rng.random() < 0.9 else 2}
    return kind, made


# Ordinary scenes


def general(held):
    """Maker of scenes with anything the format allows, but few one-sided supports."""

    def make(rng):
        while True:
            made = random_scene(rng, held=held)
            if 1 <= len(one_sided(made)) <= MOST_ONE_SIDED:
                return made

    return make


def round_numbers(rng, held=None, symmetric=False, over=False, gaps=True, loads=True, rigid=False):
    """A scene in which all numbers are small whole ones, so that coincidences are many."""
    count = rng.randint(1, 4)
    spans = [float(rng.choice((1, 1, 2, 2, 3, 4))) for _ in range(count)]
    EI = float(rng.choice((1, 1, 2, 10, 1000)))
    if rigid:
        EI = [rng.choice((EI, INF, INF)) for _ in range(count)]
    if symmetric:
        spans = (spans + spans[::-1])[len(spans) % 2 :] if rng.random() < 0.5 else spans + spans[::-1]
        spans = spans if spans == spans[::-1] else [spans[0]] * count
        EI = EI if not isinstance(EI, list) else EI[0]
    made = scene(spans, [], EI=EI)
    nodes, room = nodes_of(made), MOST_ONE_SIDED
    half = (len(nodes) + 1) // 2 if symmetric else len(nodes)
    few = room // 2 if symmetric else room
    while len(made["supports"]) < (1 if symmetric else 2):
        made["supports"], few = [], room // 2 if symmetric else room
        for node in range(half):
            side = rng.choice(("both", "below", "below", "above") if held is None else ("below", "below", "above"))
            if rng.random() < 0.15 or (side != "both" and not few):
                continue
            few -= side != "both"
            made["supports"].append(at(node, side=side, **_round_support(rng, side, gaps)))
    made["loads"] = [_round_load(rng, made, over) for _ in range(rng.randint(1, 3))] if loads else []
    if rng.random() < 0.2 and len(nodes) > 2 and held is None:
        made["beam"]["hinges"] = [nodes[rng.randrange(1, len(nodes) - 1)] - rng.choice((0.0, 0.5))]
        _hold_no_hinge(made)
    return _double(made) if symmetric else made


def _round_support(rng, side, gaps):
    keys = {}
    if gaps and side != "both" and rng.random() < 0.5:
        keys["gap"] = rng.choice((1.0, 2.0, -1.0, 0.5, 0.25)) * rng.choice((1.0, 1.0, 0.01))
    if rng.random() < 0.3:
        keys["stiffness"] = float(rng.choice((1, 2, 3, 10, 100)))
    if side == "both" and rng.random() < 0.25:
        keys["rotation"] = rng.choice(("fixed", 1.0, 10.0))
    if rng.random() < 0.1 and gaps:
        keys["settlement"] = rng.choice((1.0, 0.01, -1.0))
    return keys


def _round_load(rng, made, over):
    nodes = nodes_of(made)
    size = float(rng.choice((1, 1, 2, 3, 10, -1, -2, -3, 12, 24)))
    if over:
        return force(place(made, rng.choice(made["supports"])), size)
    kind = rng.choice(("force", "force", "moment", "uniform", "uniform", "linear"))
    if kind == "uniform":
        a, b = sorted(rng.sample(range(len(nodes)), 2))
        return uniform(size, **stretch(nodes[a], nodes[b])) if rng.random() < 0.5 else uniform(size)
    if kind == "linear":
        return linear(size, 0.0)
    x = rng.choice((*nodes, *(x - 0.5 for x in nodes[1:])))
    return force(x, size) if kind == "force" else moment(x, size)


def _hold_no_hinge(made):
    """Keep couples and rotational supports away from hinges."""
    hinges = made["beam"]["hinges"]
    for support in made["supports"]:
        if place(made, support) in hinges:
            support.pop("rotation", None)
    made["loads"] = [load for load in made["loads"] if load["type"] != "moment" or load["x"] not in hinges]


def _double(made):
    """The scene with everything on its left half repeated on the right, as in a mirror."""
    length, last = nodes_of(made)[-1], len(made["beam"]["spans"])
    made["beam"].pop("hinges", None)
    for support in list(made["supports"]):
        if 2 * support["node"] != last:
            made["supports"].append(dict(support, node=last - support["node"]))
    loads = [load for load in made["loads"] if load["type"] != "linear"]
    for load in list(loads):
        if load["type"] == "moment":
            loads.append(dict(load, x=length - load["x"], M=-load["M"]))
        elif "x" in load:
            loads.append(dict(load, x=length - load["x"]))
        elif "from" in load:
            loads.append(dict(load, **stretch(length - load["to"], length - load["from"])))
    made["loads"] = loads or [uniform(1.0)]
    return made


def zero_loads(rng):
    """No load at all or loads of size 0; lack of fit may still bend the beam."""
    made = general(rng.choice((True, None, False)))(rng) if rng.random() < 0.5 else round_numbers(rng)
    for load in made["loads"]:
        for key in ("F", "M", "kappa", "q"):
            if key in load:
                load[key] = [0.0, 0.0] if load["type"] == "linear" else 0.0
    if rng.random() < 0.4:
        made["loads"] = []
    return made


# Ties


def tie_by_gap(rng):
    """A support that the beam touches exactly, without force."""
    while True:
        made = round_numbers(rng, gaps=rng.random() < 0.5)
        beam = oracle.Oracle(made)
        found = _solved(beam)
        free = [i for i in range(len(nodes_of(made))) if all(s["node"] != i for s in made["supports"])]
        if found is None or not free or len(one_sided(made)) >= MOST_ONE_SIDED:
            continue
        node = rng.choice(free)
        w = found.oracle.state_at(Fraction(nodes_of(made)[node]), "right", found.values)[0]
        many = _whole(made, w)
        if many is None:
            continue
        made = _times(made, many)
        side = rng.choice(("below", "above"))
        spring = {"stiffness": float(rng.choice((1, 10, 100)))} if rng.random() < 0.4 else {}
        made["supports"].append(at(node, side=side, gap=float(w * many) * (1 if side == "below" else -1), **spring))
        if _tied(made):
            return made


def tie_by_force(rng):
    """A closed support whose force is exactly zero: what it carried is lifted off it."""
    while True:
        made = round_numbers(rng)
        beam = oracle.Oracle(made)
        found = _solved(beam)
        if found is None or not one_sided(made):
            continue
        closed = [i for i in one_sided(made) if found.state[i] == "closed" and found.reaction[i] != 0]
        if not closed:
            continue
        i = rng.choice(closed)
        R = found.values[beam.force_column + i]
        many = _whole(made, R)
        if many is None:
            continue
        x = place(made, made["supports"][i])
        made = _times(made, many)
        made["loads"].append(force(x, -float(R * many)))
        if _tied(made):
            return made


def _tied(made):
    found = _solved(oracle.Oracle(made))
    return found is not None and any(found.tied)


def _solved(beam):
    try:
        found = beam.solve()
    except oracle.Redundant:
        return None
    return found if found.status == "solved" else None


def _whole(made, value):
    """By what loads and gaps have to be multiplied to make a value of the answer a whole number, or None."""
    if any(s.get("settlement") for s in made["supports"]):
        return None
    many = value.denominator
    return many if many < 2**20 and abs(value.numerator) < 2**45 else None


def _times(made, many):
    """Loads and gaps multiplied: the answer is multiplied too (exactly, as all of them are small dyadic numbers)."""
    new = copy.deepcopy(made)
    for item in (*new["supports"], *new["loads"]):
        for key in ("gap", "F", "M", "q"):
            if key in item:
                value = item[key]
                item[key] = [v * many for v in value] if isinstance(value, list) else value * many
                exact = [Fraction(v) * many for v in (value if isinstance(value, list) else [value])]
                assert exact == [Fraction(v) for v in np.ravel(item[key]).tolist()] or key == "gap"
    return new


# Cycles of switching all wrong supports at once


def cycling(rng):
    """A beam on which switching all wrong supports, from all closed, comes back to a scheme it had before."""
    numbers = np.random.default_rng(rng.getrandbits(60))
    clamped, count, most = rng.random() < 0.3, rng.choice((3, 3, 4, 4, 5)), rng.choice((0.0, 0.02, 0.02, 0.1, 0.1))
    size = 512
    while True:
        sides = numbers.choice((-1, 1), (size, count))
        stiffness = np.round(10.0 ** numbers.uniform(3, 8, (size, count)), 0)
        rigid = numbers.random((size, count)) < 0.5
        gaps = np.round(numbers.uniform(-most, most, (size, count)), 4)
        loads = np.round(numbers.uniform(-100, 100, (size, count)), 2)
        hits = np.flatnonzero(_cycles(clamped, 1000.0, sides, np.where(rigid, 0.0, 1.0 / stiffness), gaps, loads))
        if len(hits):
            break
    k = hits[0]
    supports = [at(0, rotation="fixed")] if clamped else [at(0), at(count + 1)]
    for i in range(count):
        spring = {} if rigid[k, i] else {"stiffness": float(stiffness[k, i])}
        side = "below" if sides[k, i] > 0 else "above"
        supports.append(at(i + 1, side=side, gap=float(gaps[k, i]), **spring))
    points = [force(i + 1.0, float(loads[k, i])) for i in range(count)]
    return scene([1.0] * (count + (not clamped)), supports, points, EI=1000.0)


def _cycles(clamped, EI, sides, compliance, gaps, loads):
    """Whether the rule goes on for more solves than there are schemes; spans of 1, for many beams at a time."""
    size, count = sides.shape
    x = np.arange(1.0, count + 1.0)
    a, b = np.minimum.outer(x, x), np.maximum.outer(x, x)
    length = count + 1.0
    if clamped:
        flexibility = a**2 * (3.0 * b - a) / (6.0 * EI)
    else:
        flexibility = a * (length - b) * (length**2 - a**2 - (length - b) ** 2) / (6.0 * EI * length)
    free, level, eye = loads @ flexibility, sides * gaps, np.eye(count)
    closed, moving = np.ones((size, count), dtype=bool), np.arange(size)
    for _ in range(2**count + 1):
        now = closed[moving]
        both = now[:, :, None] & now[:, None, :]
        matrix = np.where(both, flexibility + compliance[moving, :, None] * eye, eye)
        penetrated = np.where(now, (free - level)[moving], 0.0)
        reaction = np.linalg.solve(matrix, penetrated[:, :, None])[:, :, 0]
        apart = sides[moving] * (level[moving] - (free[moving] - reaction @ flexibility))
        wrong = np.where(now, sides[moving] * reaction < 0.0, apart < 0.0)
        closed[moving] ^= wrong
        moving = moving[wrong.any(axis=1)]
    return np.isin(np.arange(size), moving)


MAKERS = {
    "held": general(True),
    "any supports": general(None),
    "free": lambda rng: general(False)(rng) if rng.random() < 0.5 else round_numbers(rng, held=False),
    "round numbers": round_numbers,
    "zero gaps": lambda rng: round_numbers(rng, held=rng.choice((None, False)), gaps=False),
    "zero loads": zero_loads,
    "symmetric": lambda rng: round_numbers(rng, held=rng.choice((None, False)), symmetric=True),
    "over supports": lambda rng: round_numbers(rng, held=rng.choice((None, False)), over=True),
    "rigid": lambda rng: round_numbers(rng, held=rng.choice((None, False)), rigid=True),
    "tie by gap": tie_by_gap,
    "tie by force": tie_by_force,
    "cycling": cycling,
}
assert MAKERS.keys() == KINDS.keys()
