"""Random scenes with supports that follow laws, for comparison with `oracle/laws.py` and `oracle/history.py`.

All numbers are multiples of 1/8 (exact as doubles) and small, so the oracle reads what the engine reads. Scenes are
drawn from a `random.Random`; nothing here solves anything, but that compressions are parts of a buckling factor, which the
oracle is asked for. No two supports share a place, and no two pieces of a law that follow one another lie on one line, so
every branch is a branch of its own.
"""

import itertools
import random

import oracle.axial_modes as modes

from .foundation import digits
from .plain import force, moment, nodes_of, place, scene, uniform

FAMILIES = ("hardening", "softening", "plastic", "broken")
HISTORY = (1.0, 0.0, 1.5, -0.5)


def eighths(rng, low, high):
    """A multiple of 1/8 from `low` to `high`."""
    return rng.randint(round(8 * low), round(8 * high)) / 8.0


def random_law(rng, family):
    """Points of a law.

    Parameters
    ----------
    rng : random.Random
    family : str
        "hardening": forces that never fall, with level and vertical pieces; "softening": at least one piece falls
        or drops, the last one never falls; "plastic": slopes that only decrease, the first possibly vertical, the
        last possibly level; "broken": rising to a peak, down to nothing at once, nothing from there on.

    Returns
    -------
    list of [float, float]
    """
    while True:
        law = _DRAW[family](rng)
        points = [[0.0, 0.0], *law]
        steps = [(b[0] - a[0], b[1] - a[1]) for a, b in itertools.pairwise(points)]
        bent = all(a[0] * b[1] != a[1] * b[0] for a, b in itertools.pairwise(steps))
        if bent and min(r for _, r in law) >= 0.0 and (family != "plastic" or _concave(steps)):
            return law


def _concave(steps):
    """Whether slopes decrease from piece to piece."""
    return all(a[0] * b[1] < a[1] * b[0] for a, b in itertools.pairwise(steps))


def _rise(rng, d, r):
    """A point after (d, r) that lies higher: sloped, rarely straight above."""
    return [d if rng.random() < 0.15 else d + eighths(rng, 0.125, 0.75), r + eighths(rng, 0.5, 24)]


def _hardening(rng):
    law = [_rise(rng, 0.0, 0.0)]
    for _ in range(rng.randint(0, 3)):
        d, r = law[-1]
        law.append([d + eighths(rng, 0.125, 1), r] if rng.random() < 0.3 else _rise(rng, d, r))
    return law


def _softening(rng):
    law = [_rise(rng, 0.0, 0.0)]
    if rng.random() < 0.4:
        law.append(_rise(rng, *law[-1]))
    for _ in range(rng.randint(1, 2)):
        if law[-1][1] < 0.25:
            law.append(_rise(rng, *law[-1]))
        d, r = law[-1]
        lower = 0.0 if rng.random() < 0.3 else eighths(rng, 0, r - 0.125)
        law.append([d if rng.random() < 0.35 else d + eighths(rng, 0.125, 1), lower])
        d, r = law[-1]
        law.append([d + eighths(rng, 0.125, 1), r + rng.choice((0.0, eighths(rng, 0.125, 8)))])
    return law


def _plastic(rng):
    law = [_rise(rng, 0.0, 0.0)]
    for _ in range(rng.randint(1, 3)):
        d, r = law[-1]
        law.append([d + eighths(rng, 0.125, 1), r + rng.choice((0.0, eighths(rng, 0.125, 12)))])
    return law


def _broken(rng):
    law = [[eighths(rng, 0.125, 0.75), eighths(rng, 0.5, 24)]]
    if rng.random() < 0.3:
        law.append(_rise(rng, *law[-1]))
    d = law[-1][0]
    return [*law, [d, 0.0], [d + 0.5, 0.0]]


_DRAW = {"hardening": _hardening, "softening": _softening, "plastic": _plastic, "broken": _broken}


def law_scene(rng, family, *, laws=None, alone=True):
    """A beam of 1 to 4 spans on supports with laws, others and loads.

    Parameters
    ----------
    rng : random.Random or int
        An integer is a seed.
    family : str
        One of `FAMILIES`; "plastic" and "broken" have the analysis `history` and one-sided laws.
    laws : int, optional
        Number of supports with a law; default 1 to 6, mostly few.
    alone : bool, optional
        True: a clamp or two bilateral supports hold the beam; False: at most one bilateral support that turns, and
        all others push, most of them up; None: nine in ten as with True.

    Returns
    -------
    dict
    """
    rng = random.Random(f"{family} {rng}") if isinstance(rng, int) else rng
    spans = [eighths(rng, 1, 4) for _ in range(rng.randint(1, 4))]
    made = scene(
        spans, [], EI=eighths(rng, 2, 64) if rng.random() < 0.7 else [eighths(rng, 2, 64) for _ in spans]
    )
    history = family in ("plastic", "broken")
    if alone is None:
        alone = rng.random() < 0.9
    free = _places(rng, made)
    supports = _linear(rng, free, alone)
    count = laws or rng.choice((1, 1, 2, 2, 2, 3, 3, 4, 5, 6))
    for _ in range(min(count, len(free))):
        support = {**free.pop(), "side": _side(rng, alone, not history), "law": random_law(rng, family)}
        if support["side"] != "both" and rng.random() < 0.5:
            support["gap"] = eighths(rng, 0, 0.5)
        supports.append({**support, "unloading": family} if history else support)
    for _ in range(min(rng.choice((0, 0, 1, 2)), len(free))):
        support = {**free.pop(), "side": _side(rng, alone, False), "gap": eighths(rng, 0, 1)}
        if rng.random() < 0.6:
            support["stiffness"] = eighths(rng, 1, 64)
        supports.append(support)
    made["supports"] = sorted(supports, key=lambda s: place(made, s))
    made["loads"] = _loads(rng, made, alone, 3 if family == "softening" else 1)
    made["analysis"] = {"follow": "events", "at_limit": "follow"}
    if history:
        made["analysis"]["history"] = list(HISTORY)
    return made


def in_stretches(seed, families=("plastic", "plastic", "plastic", "hardening")):
    """A scene as of `law_scene`, under an axial force or on two-sided ground.

    Parameters
    ----------
    seed : int
    families : tuple of str
        Of which one is drawn.

    Returns
    -------
    kind : {"tension", "compression", "ground", "both"}
    made : dict
    """
    rng = random.Random(f"in stretches {seed}")
    family = rng.choice(families)
    made = law_scene(rng, family)
    if family != "softening":
        made["analysis"] = {"follow": "events", "history": list(HISTORY)}
    if family == "broken":
        made["analysis"]["at_limit"] = "follow"
    beam, length = made["beam"], nodes_of(made)[-1]
    EI = min(beam["EI"]) if isinstance(beam["EI"], list) else beam["EI"]
    kind = rng.choice(("tension", "compression", "ground", "both"))
    if kind == "compression":
        held = [s for s in made["supports"] if "law" not in s and s.get("side", "both") == "both"]
        first = modes.buckling({**made, "supports": held, "beam": {**beam, "N": -1.0}})[0]
        beam["N"] = digits(-float(first) * rng.uniform(0.1, 0.95))
        return kind, made
    if kind != "ground":
        pull = 10.0 ** rng.uniform(-6, 3) * EI / length**2
        beam["N"] = digits(pull) if rng.random() < 0.5 else [digits(pull * rng.uniform(0.2, 2)) for _ in beam["spans"]]
    if kind != "tension":
        k = EI / length**4 * 10.0 ** rng.uniform(-1, 5)
        ground = {"k": digits(k) if rng.random() < 0.6 else [digits(k), digits(k * rng.uniform(0.1, 4))]}
        if rng.random() < 0.4:
            ground |= {"from": eighths(rng, 0, 0.4 * length), "to": eighths(rng, 0.6 * length, length)}
        if rng.random() < 0.3:
            ground["shear"] = digits(EI / length**2 * 10.0 ** rng.uniform(-1, 1))
        made["foundation"] = [ground]
    return kind, made


def symmetric_scene(rng, family):
    """A beam on bilateral ends with two or three supports with laws, symmetric like its loads: ties at every kink.

    Parameters
    ----------
    rng : random.Random or int
    family : str

    Returns
    -------
    dict
    """
    rng = random.Random(f"symmetric {family} {rng}") if isinstance(rng, int) else rng
    span = eighths(rng, 1, 4)
    a, law = eighths(rng, 0.25, span - 0.25), random_law(rng, family)
    side = rng.choice(("below", "both")) if family in ("hardening", "softening") else "below"
    supports = [{"node": 0}, *({"x": x, "side": side, "law": law} for x in (a, 2 * span - a)), {"node": 2}]
    if rng.random() < 0.5:
        supports.insert(2, {"node": 1, "side": side, "law": random_law(rng, family)})
    F = 2 * eighths(rng, 4, 64)
    loads = [force(a, F), force(2 * span - a, F)] if rng.random() < 0.5 else [uniform(F)]
    if family in ("plastic", "broken"):
        supports = [{**s, "unloading": family} if "law" in s else s for s in supports]
    analysis = {"follow": "events", "at_limit": "follow"}
    return scene([span, span], supports, loads, EI=eighths(rng, 2, 64), analysis=analysis)


def _places(rng, made):
    """Where supports can be: nodes, and places between them at quarters of multiples of 1/8."""
    nodes = nodes_of(made)
    found = [{"node": i} for i in range(len(nodes))]
    for a, b in itertools.pairwise(nodes):
        inner = {a + eighths(rng, 0.125, b - a - 0.125) for _ in range(3)}
        found += [{"x": x} for x in sorted(inner)]
    rng.shuffle(found)
    return found


def _linear(rng, free, alone):
    """Take the places of the bilateral supports."""
    if alone and rng.random() < 0.3:
        return [{**free.pop(), "rotation": "fixed"}]
    count = rng.choice((2, 2, 2, 3)) if alone else rng.choice((0, 1, 1))
    supports = [free.pop() for _ in range(count)]
    if alone and count == 3:
        supports[-1]["stiffness"] = eighths(rng, 1, 64)
    elif supports and rng.random() < 0.2:
        supports[-1]["rotation"] = eighths(rng, 1, 64)
    return supports


def _side(rng, alone, both):
    """A side; a beam that does not stand alone lies on its supports."""
    if not alone:
        return "below" if rng.random() < 0.8 else "above"
    return (
        rng.choice(("below", "below", "above", "both")) if both else rng.choice(("below", "below", "above"))
    )


def _loads(rng, made, alone, times):
    """One to four live loads, and often dead ones; the first acts downward."""
    length = nodes_of(made)[-1]
    loads = [force(eighths(rng, 0.125, length), times * eighths(rng, 4, 64))]
    for _ in range(rng.choice((0, 1, 1, 2, 3))):
        loads.append(_load(rng, length, 32))
    if not alone or rng.random() < 0.4:
        loads.append(uniform(eighths(rng, 0.125, 4), case="dead"))
        if rng.random() < 0.4:
            loads.append({**_load(rng, length, 8), "case": "dead"})
    return loads


def _load(rng, length, size):
    """A load of any type."""
    sign = rng.choice((1, 1, -1))
    kind = rng.choice(("force", "moment", "uniform"))
    if kind == "uniform":
        a = rng.choice((0.0, eighths(rng, 0, length - 0.25)))
        b = rng.choice((length, eighths(rng, a + 0.125, length)))
        return uniform(sign * eighths(rng, 0.25, size / 4), **{"from": a, "to": b})
    make = force if kind == "force" else moment
    return make(eighths(rng, 0, length), sign * eighths(rng, 0.5, size))
