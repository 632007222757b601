"""Scenes drawn at random whose places are exact: all lengths are dyadic numbers, so that every sum of them is a double.

A `Sizes` says how far the magnitudes of a scene spread; whatever is drawn has a few digits only, so that failures can be
read. Beams are drawn with few or many one-sided supports, with clearances, hinges, springs, lack of fit, and loads of all
kinds that bend.
"""

import math
from dataclasses import dataclass

import gapbeam
from scenes import curvature, force, linear, moment, nodes_of, one_sided, place, scene, stretch, uniform

INF = math.inf


@dataclass
class Sizes:
    """How far magnitudes spread.

    Attributes
    ----------
    decades : float
        Stiffnesses, loads and gaps lie within so many powers of ten to either side of an ordinary value.
    doublings : int
        Lengths lie within so many powers of two to either side of 2.
    round : bool
        Whether all numbers are small whole ones times a power of two, so that coincidences are many and exact.
    """

    decades: float = 0.5
    doublings: int = 1
    round: bool = False

    def number(self, rng, usual):
        """A positive number near `usual`."""
        if self.round:
            return float(rng.choice((1, 1, 2, 3, 4, 5, 10))) * 2.0 ** round(math.log2(usual))
        return float(f"{usual * 10.0 ** rng.uniform(-self.decades, self.decades):.3g}")

    def signed(self, rng, usual):
        """A number of either sign near `usual`."""
        return rng.choice((1.0, 1.0, -1.0)) * self.number(rng, usual)

    def length(self, rng):
        """A span."""
        if self.round:
            return float(rng.choice((1, 1, 2, 2, 3, 4)))
        return math.ldexp(rng.randint(8, 15), rng.randint(-self.doublings, self.doublings) - 2)


ROUND, ORDINARY, SPREAD = Sizes(round=True), Sizes(), Sizes(3.0, 4)
WIDE = Sizes(9.0, 10)


def draw_beam(
    rng, sizes, *, spans=(1, 5), bilateral=0.4, most=8, pairs=0.2, gaps=0.6, hinges=0.2, springs=0.3, above=0.33
):
    """A beam with supports, without loads.

    Parameters
    ----------
    rng : random.Random
    sizes : Sizes
    spans : (int, int)
        Fewest and most spans.
    bilateral, pairs : float
        Share of the supports that hold both ways, or are a clearance.
    most : int
        Most one-sided supports.
    gaps, hinges, springs, above : float
        How often a support has a gap, a span a hinge, a support is elastic, a one-sided support acts from above.

    Returns
    -------
    dict
    """
    count = rng.randint(*spans)
    EI = sizes.number(rng, 1e4)
    made = scene([sizes.length(rng) for _ in range(count)], [], EI=EI)
    if rng.random() < 0.3 and count > 1:
        made["beam"]["EI"] = [INF if rng.random() < 0.1 else sizes.number(rng, 1e4) for _ in range(count)]
    if rng.random() < 0.25:
        made["beam"]["GA"] = [INF if rng.random() < 0.4 else sizes.number(rng, 1e4) for _ in range(count)]
    nodes = nodes_of(made)
    if rng.random() < 0.15:
        k = rng.randrange(count)
        start = nodes[k] + made["beam"]["spans"][k] * rng.randrange(8) / 8.0
        made["sections"] = [stretch(start, rng.choice([x for x in nodes if x > start]), EI=sizes.number(rng, 1e4))]
    room = most
    while not made["supports"]:
        for k in range(count + 1):
            for where in _places(rng, made, nodes, k):
                room -= _add_support(rng, sizes, made, where, room, bilateral, pairs, gaps, springs, above)
    if hinges:
        _add_hinges(rng, made, nodes, hinges)
    if rng.random() < 0.3:
        rng.shuffle(made["supports"])
    return made


def until_valid(draw):
    """Draw again as long as the program refuses a scene, as where supports leave no room for the beam."""
    while True:
        kind, made = draw()
        try:
            gapbeam.read_scene(made)
        except gapbeam.SceneError:
            continue
        return kind, made


def _places(rng, made, nodes, k):
    """Where supports may stand at or right of one node."""
    places = [{"node": k}] if rng.random() < 0.8 else []
    if k < len(nodes) - 1 and rng.random() < 0.15:
        places.append({"x": nodes[k] + made["beam"]["spans"][k] * rng.randint(1, 7) / 8.0})
    return places


def _add_support(rng, sizes, made, where, room, bilateral, pairs, gaps, springs, above):
    """Add one support, or two that make a clearance; how many are one-sided."""
    kind, keys = rng.random(), {}
    if rng.random() < 0.15:
        keys["settlement"] = sizes.signed(rng, 0.01)

    def own():
        return {"stiffness": sizes.number(rng, 1e4)} if rng.random() < springs else {}

    def gap(likely):
        return {"gap": rng.choice((1.0, 1.0, 1.0, -1.0)) * sizes.number(rng, 0.01)} if rng.random() < likely else {}

    if kind < bilateral or not room:
        if kind >= bilateral and bilateral == 0.0:
            return 0
        if rng.random() < 0.2:
            keys["rotation"] = rng.choice(("fixed", sizes.number(rng, 1e4)))
        made["supports"].append(dict(where, **own(), **keys))
        return 0
    if kind < bilateral + pairs and room > 1:
        made["supports"].append(dict(where, side="below", gap=sizes.number(rng, 0.01), **own(), **keys))
        above = {"gap": sizes.number(rng, 0.01)} if rng.random() < 0.6 else {}
        made["supports"].append(dict(where, side="above", **above, **own(), **keys))
        return 2
    side = "above" if rng.random() < above else "below"
    made["supports"].append(dict(where, side=side, **gap(gaps), **own(), **keys))
    return 1


def _add_hinges(rng, made, nodes, likely):
    """Hinges, not where a support holds the rotation."""
    clamped = [place(made, s) for s in made["supports"] if "rotation" in s]
    found = []
    for k, span in enumerate(made["beam"]["spans"]):
        x = nodes[k] + span * rng.choice((0, 1, 2, 4, 6, 7)) / 8.0
        if rng.random() < likely and x > 0.0 and x not in clamped:
            found.append(x)
    if found:
        made["beam"]["hinges"] = sorted(set(found))


def draw_loads(rng, sizes, made, *, dead=0.3, most=4, down=False):
    """Loads of all kinds that bend.

    Parameters
    ----------
    rng : random.Random
    sizes : Sizes
    made : dict
        The beam.
    dead : float
        Share of the dead loads.
    most : int
    down : bool
        Whether all forces go down.

    Returns
    -------
    list of dict
    """
    nodes, hinges, loads = nodes_of(made), made["beam"].get("hinges", []), []
    signed = sizes.number if down else sizes.signed
    spots = [*nodes, *(nodes[k] + span * rng.randint(1, 7) / 8.0 for k, span in enumerate(made["beam"]["spans"]))]
    for _ in range(rng.randint(1, most)):
        kind = rng.choices(("force", "uniform", "moment", "linear", "curvature"), (5, 4, 1.5, 1, 0.5))[0]
        case = {"case": "dead"} if rng.random() < dead else {}
        x = rng.choice(spots)
        if kind == "force" or (kind == "moment" and x in hinges):
            loads.append(force(x, signed(rng, 10.0), **case))
        elif kind == "moment":
            loads.append(moment(x, signed(rng, 10.0), **case))
        else:
            a, b = sorted(rng.sample(range(len(nodes)), 2))
            where = stretch(nodes[a], nodes[b]) if rng.random() < 0.5 else {}
            if kind == "uniform":
                loads.append(uniform(signed(rng, 5.0), **where, **case))
            elif kind == "linear":
                loads.append(linear(signed(rng, 5.0), signed(rng, 5.0), **where, **case))
            else:
                loads.append(curvature(sizes.signed(rng, 1e-3), **where, **case))
    return loads


def mirror_double(made):
    """The beam with its supports and loads repeated on a mirrored half, so that coincidences are exact."""
    spans, length, last = made["beam"]["spans"], nodes_of(made)[-1], len(made["beam"]["spans"])
    new = scene(spans + spans[::-1], [], EI=made["beam"]["EI"], sections=made.get("sections", []))
    for section in made.get("sections", []):
        new["sections"] = [*new["sections"], dict(section, **stretch(2 * length - section["to"], 2 * length - section["from"]))]
    for key in ("EI", "GA"):
        value = made["beam"].get(key)
        if isinstance(value, list):
            new["beam"][key] = value + value[::-1]
    if made["beam"].get("hinges"):
        new["beam"]["hinges"] = sorted({h for x in made["beam"]["hinges"] for h in (x, 2 * length - x)})
    for support in made["supports"]:
        x = place(made, support)
        keys = {k: v for k, v in support.items() if k not in ("x", "node")}
        new["supports"].append(dict(x=x, **keys))
        if x < length:
            new["supports"].append(dict(x=2 * length - x, **keys))
    for load in made["loads"]:
        new["loads"].append(load)
        if "x" in load:
            if load["x"] < length:
                other = dict(load, x=2 * length - load["x"])
                if load["type"] == "moment":
                    other["M"] = -load["M"]
                new["loads"].append(other)
        else:
            a, b = load.get("from", 0.0), load.get("to", nodes_of(made)[last])
            other = dict(load, **stretch(2 * length - b, 2 * length - a))
            load["to"] = b
            if load["type"] == "linear":
                other["q"] = load["q"][::-1]
            new["loads"].append(other)
    return new


__all__ = [
    "INF", "ORDINARY", "ROUND", "SPREAD", "WIDE", "Sizes", "draw_beam", "draw_loads", "force", "mirror_double", "nodes_of",
    "one_sided", "place", "uniform", "until_valid",
]  # fmt: skip
