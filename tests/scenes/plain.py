"""Scenes for the tests: short builders, and random scenes.

Nothing here solves anything: scenes are plain dicts with the names of the file format, and the random ones
are drawn from a `random.Random`, seeded or driven by hypothesis.
"""

import math
from fractions import Fraction
from itertools import accumulate

INF = math.inf


def scene(spans, supports, loads=(), *, EI=1.0, sections=(), analysis=None, **beam):
    """A scene as a dict.

    Examples
    --------
    >>> scene([2.0], [at(0)], [force(1.0, 3.0)])["loads"]
    [{'type': 'force', 'x': 1.0, 'F': 3.0}]
    """
    made = {
        "beam": {"spans": list(spans), "EI": EI, **beam},
        "supports": list(supports),
        "loads": list(loads),
    }
    if sections:
        made["sections"] = list(sections)
    if analysis:
        made["analysis"] = analysis
    return made


def at(node=None, **keys):
    """A support at a node, or with `x=...` anywhere."""
    return {"node": node, **keys} if node is not None else keys


def force(x, F, **keys):
    """A point force."""
    return {"type": "force", "x": x, "F": F, **keys}


def moment(x, M, **keys):
    """A couple."""
    return {"type": "moment", "x": x, "M": M, **keys}


def uniform(q, **keys):
    """A uniform load; `stretch(a, b)` limits it."""
    return {"type": "uniform", "q": q, **keys}


def linear(q_from, q_to, **keys):
    """A linear load."""
    return {"type": "linear", "q": [q_from, q_to], **keys}


def curvature(kappa, **keys):
    """An imposed curvature."""
    return {"type": "curvature", "kappa": kappa, **keys}


def stretch(start, end, **keys):
    """The keys `from` and `to`, with others."""
    return {"from": start, "to": end, **keys}


def nodes_of(scene):
    """The x of the nodes, each rounded once."""
    spans = map(Fraction, map(float, scene["beam"]["spans"]))
    return [float(x) for x in accumulate(spans, initial=Fraction(0))]


def place(scene, item):
    """The x of a support or a point load."""
    return item["x"] if "x" in item else nodes_of(scene)[item["node"]]


def one_sided(scene):
    """Indices of the one-sided supports."""
    return [i for i, s in enumerate(scene["supports"]) if s.get("side", "both") != "both"]


# Random scenes


def random_scene(rng, *, held=None, linear_only=False):
    """A scene of 1 to 5 spans with anything the format allows and at most 8 one-sided supports.

    Parameters
    ----------
    rng : random.Random
    held : bool, optional
        True: two or more bilateral supports, no hinge; False: no bilateral support; None: whatever comes.
    linear_only : bool
        Bilateral supports only.

    Returns
    -------
    dict
    """
    count = rng.randint(1, 5)
    spans = [rng.choice((rng.randint(4, 32) / 4.0, round(rng.uniform(1.0, 8.0), 2))) for _ in range(count)]
    made = scene(spans, [], EI=_stiffnesses(rng, count, 1e3, 1e5))
    if rng.random() < 0.4:
        made["beam"]["GA"] = _stiffnesses(rng, count, 1e3, 1e5)
    _add_supports(rng, made, held, linear_only)
    _add_sections(rng, made)
    _add_hinges(rng, made, held)
    made["loads"] = [_random_load(rng, made) for _ in range(rng.randint(1, 5))]
    made["analysis"] = {"steps": rng.randint(1, 3), "rule": rng.choice(("block", "single"))}
    return made


def _stiffness(rng, low, high):
    """A logarithmically even number of three digits."""
    return float(f"{math.exp(rng.uniform(math.log(low), math.log(high))):.3g}")


def _stiffnesses(rng, count, low, high):
    """One stiffness, or a list with one for each span."""
    return (
        [_stiffness(rng, low, high) for _ in range(count)]
        if rng.random() < 0.3
        else _stiffness(rng, low, high)
    )


def _places(rng, made):
    """Distinct x of supports: most of the nodes and a few others."""
    nodes = nodes_of(made)
    chosen = [{"node": i} for i in range(len(nodes)) if rng.random() < 0.8]
    for _ in range(rng.choice((0, 0, 1, 2))):
        i = rng.randrange(len(nodes) - 1)
        x = nodes[i] + made["beam"]["spans"][i] * rng.randint(1, 7) / 8.0
        if all(abs(place(made, other) - x) > 1e-6 for other in chosen):
            chosen.append({"x": x})
    return chosen


def _add_supports(rng, made, held, linear_only):
    """Fill the supports of a scene."""
    places = _places(rng, made)
    while len(places) < 2:
        places = _places(rng, made)
    bilateral = set(rng.sample(range(len(places)), 2)) if held else set()
    room = 8
    for k, where in enumerate(places):
        kind = rng.choice(("both", "both", "both", "below", "below", "above", "pair"))
        if held is False and kind == "both":
            kind = "below"
        if linear_only or k in bilateral or (room < 2 and held is not False):
            kind = "both"
        if kind == "pair" and room >= 2:
            made["supports"] += _clearance(rng, where)
            room -= 2
        elif kind == "both":
            made["supports"].append(dict(where, **_springs(rng), **_settlement(rng), **_rotation(rng)))
        elif room:
            side = "below" if kind == "pair" else kind
            gap = {"gap": rng.choice((0.0, round(rng.uniform(-0.01, 0.02), 4)))} if rng.random() < 0.6 else {}
            made["supports"].append(dict(where, side=side, **gap, **_springs(rng), **_settlement(rng)))
            room -= 1
    rng.shuffle(made["supports"])


def _clearance(rng, where):
    """A support below and one above at one place."""
    gap = round(rng.uniform(0.001, 0.02), 4)
    lower = dict(where, side="below", gap=gap, **_springs(rng))
    upper = dict(
        where, side="above", gap=rng.choice((0.0, round(rng.uniform(0.0, 0.02), 4))), **_springs(rng)
    )
    if "stiffness" in lower and rng.random() < 0.3:
        lower["gap"] = -gap  # squeezed between a spring and whatever is above
    settlement = _settlement(rng)
    return [dict(lower, **settlement), dict(upper, **settlement)]


def _springs(rng):
    return {"stiffness": _stiffness(rng, 1e2, 1e6)} if rng.random() < 0.3 else {}


def _settlement(rng):
    return {"settlement": round(rng.uniform(-0.01, 0.02), 4)} if rng.random() < 0.25 else {}


def _rotation(rng):
    if rng.random() < 0.75:
        return {}
    return {"rotation": "fixed" if rng.random() < 0.5 else _stiffness(rng, 1e2, 1e6)}


def _along(length, part, parts):
    """The x at `part` of `parts` of the beam; its end exactly."""
    return length if part == parts else length * part / parts


def _add_sections(rng, made):
    """Other stiffness over stretches, sometimes a rigid one where it cannot make the forces ambiguous."""
    length = nodes_of(made)[-1]
    sections = []
    for _ in range(rng.choice((0, 0, 1, 2))):
        a, b = sorted(rng.sample(range(17), 2))
        section = stretch(_along(length, a, 16), _along(length, b, 16), EI=_stiffness(rng, 1e3, 1e5))
        if rng.random() < 0.3:
            section["GA"] = _stiffness(rng, 1e3, 1e5)
        sections.append(section)
    if rng.random() < 0.25:
        a = rng.randrange(16)
        start, end = _along(length, a, 16), _along(length, rng.randint(a + 1, min(a + 6, 16)), 16)
        inside = [s for s in made["supports"] if start - 1e-6 <= place(made, s) <= end + 1e-6]
        if len({place(made, s) for s in inside}) <= 1:
            sections.append(
                stretch(start, end, EI=INF, GA=INF) if rng.random() < 0.7 else stretch(start, end, EI=INF)
            )
    if sections:
        made["sections"] = sections


def _add_hinges(rng, made, held):
    """Hinges, not where a support turns with the beam."""
    length = nodes_of(made)[-1]
    wanted = 0 if held else rng.choice((0, 0, 0, 1, 2))
    turning = [place(made, s) for s in made["supports"] if s.get("rotation", "free") != "free"]
    found = []
    for _ in range(wanted):
        x = rng.choice((*nodes_of(made)[1:-1], length * rng.randint(1, 31) / 32.0))
        if all(abs(x - other) > 1e-6 for other in (*turning, *found)):
            found.append(x)
    if found:
        made["beam"]["hinges"] = sorted(found)


def _random_load(rng, made):
    """One load of any kind but axial."""
    length = nodes_of(made)[-1]
    kind = rng.choice(("force", "force", "moment", "uniform", "uniform", "linear", "curvature"))
    case = rng.choice(({}, {}, {"case": "dead"}, {"case": "live"}))
    if kind in ("force", "moment"):
        x = rng.choice((*nodes_of(made), *(round(0.999 * length * rng.random(), 3) for _ in range(4))))
        if kind == "force":
            return force(x, round(rng.uniform(-60.0, 140.0), 2), **case)
        hinges = made["beam"].get("hinges", [])
        x = x if all(abs(x - hinge) > 1e-6 for hinge in hinges) else length / 64.0
        return moment(x, round(rng.uniform(-100.0, 100.0), 2), **case)
    if rng.random() < 0.7:
        a, b = sorted(rng.sample(range(41), 2))
        case = dict(case, **stretch(_along(length, a, 40), _along(length, b, 40)))
    if kind == "uniform":
        return uniform(round(rng.uniform(-10.0, 25.0), 2), **case)
    if kind == "linear":
        return linear(round(rng.uniform(-20.0, 30.0), 2), round(rng.uniform(-20.0, 30.0), 2), **case)
    return curvature(round(rng.uniform(-4e-3, 4e-3), 5), **case)
