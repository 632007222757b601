"""Random beams on rigid ground: profiles with corners, ground that ends, supports, hinges, loads that press and lift."""

import math
import random
from itertools import accumulate, pairwise


def rigid_scene(seed, warm=False, pulled=False, haunched=False):
    """A scene of one to three spans on one or two rigid foundations below.

    Parameters
    ----------
    seed : int
    warm : bool
        Also with imposed curvatures.
    pulled : bool
        With a tension, the same all along or one of each span.
    haunched : bool
        With spans of which EI changes linearly, or as the cube of a linear depth.

    Returns
    -------
    dict
    """
    rng = random.Random(seed)
    spans = [rng.choice((4.0, 6.0, 10.0, rng.uniform(2, 12))) for _ in range(rng.choice((1, 1, 2, 3)))]
    length = sum(spans)
    beam = {"spans": spans, "EI": [rng.choice((1e3, 1e4, rng.uniform(100, 1e5))) for _ in spans]}
    if rng.random() < 0.2:
        beam["hinges"] = [rng.uniform(0.1, 0.9) * length]
    cuts = [0.0, length] if rng.random() < 0.75 else [0.0, rng.uniform(0.3, 0.7) * length, length]
    ground = [_ground(rng, *ends) for ends in pairwise(cuts)]
    supports = [{"x": rng.uniform(0, length), **_support(rng)} for _ in range(rng.randint(0, 3))]
    loads = [{"type": "uniform", "q": rng.choice((1.0, 5.0, rng.uniform(0.1, 20)))}]
    for _ in range(rng.randint(0, 4)):
        kind = rng.random()
        if kind < 0.5:
            loads.append({"type": "force", "x": rng.uniform(0, length), "F": rng.choice((-1, 1, 1)) * rng.uniform(0.1, 30)})
        elif kind < 0.7:
            loads.append({"type": "moment", "x": rng.uniform(0, length), "M": rng.uniform(-10, 10)})
        else:
            left, right = sorted(rng.uniform(0, length) for _ in range(2))
            loads.append({"type": "linear", "from": left, "to": right, "q": [rng.uniform(-5, 15), rng.uniform(-5, 15)]})
    for _ in range(rng.randint(1, 2) if warm else 0):
        left, right = sorted(rng.choice((0.0, length, rng.uniform(0, length))) for _ in range(2))
        if left < right:
            loads.append({"type": "curvature", "from": left, "to": right, "kappa": rng.uniform(-2e-3, 2e-3)})
    if pulled:
        pulls = [10.0 ** rng.uniform(-2, 2) * min(beam["EI"]) / length**2 for _ in spans]
        beam["N"] = rng.choice((pulls, pulls[:1] * len(spans)))
    made = {"beam": beam, "supports": supports, "foundation": ground, "loads": loads}
    return made | {"sections": _haunches(rng, **beam)} if haunched else made


def _haunches(rng, spans, EI, **_):
    ends = [0.0, *accumulate(spans)]
    changes = []
    for (left, right), here in zip(pairwise(ends), EI, strict=True):
        there = here * 10 ** rng.uniform(-1, 1)
        changes.append(
            {"from": left, "to": right, "EI": [here, there] if rng.random() < 0.5 else {"from": here, "to": there, "power": 3}}
        )
    return [one for one in changes if rng.random() < 0.8]


def tied_scene(seed):
    """A scene on a grid: corners of the ground, hinges, supports and loads at the same places, levels that are the same.

    Parameters
    ----------
    seed : int

    Returns
    -------
    dict
    """
    rng = random.Random(seed)
    spans = [float(rng.choice((2, 4, 6))) for _ in range(rng.choice((1, 2, 3)))]
    length = int(sum(spans))
    beam = {"spans": spans, "EI": [rng.choice((100.0, 1e3, 1e3, 1e4)) for _ in spans]}
    if rng.random() < 0.4:
        beam["N"] = [rng.choice((10.0, 100.0))] * len(spans)
    if rng.random() < 0.2:
        beam["hinges"] = [float(rng.randint(1, length - 1))]
    levels = [rng.choice((0.0, 0.0, 0.01, -0.01)) for _ in range(length + 1)]
    corners = sorted({0, length, *rng.sample(range(length + 1), min(length + 1, rng.randint(2, 5)))})
    rock = {"k": math.inf, "side": "below", "from": 0.0, "to": float(length)}
    ground = [rock | {"profile": [[float(x), levels[x]] for x in corners]}]
    if rng.random() < 0.3:
        step = float(rng.randint(1, length - 1))
        ground = [rock | {"to": step, "gap": rng.choice((0.0, 0.01, [0.0, 0.01]))},
                  rock | {"from": step, "gap": rng.choice((0.0, 0.01, [0.01, 0.0]))}]  # fmt: skip
    supports = [
        {"x": float(rng.randint(0, length)), "side": rng.choice(("below", "above")), "stiffness": 1e3, "gap": rng.choice(levels)}
        for _ in range(rng.randint(0, 2))
    ]
    loads = [{"type": "uniform", "q": rng.choice((1.0, 4.0))}]
    for _ in range(rng.randint(0, 3)):
        x = float(rng.randint(0, length))
        if rng.random() < 0.5:
            loads.append({"type": "force", "x": x, "F": rng.choice((-2.0, -1.0, 1.0, 4.0))})
        elif x not in beam.get("hinges", ()):
            loads.append({"type": "moment", "x": x, "M": rng.choice((-1.0, 1.0))})
    return {"beam": beam, "supports": supports, "foundation": ground, "loads": loads}


def _ground(rng, left, right):
    made = {"k": math.inf, "side": "below", "from": left, "to": right}
    if rng.random() < 0.25:
        made["from"] = left + rng.uniform(0, 0.3) * (right - left)
    if rng.random() < 0.2:
        made["to"] = right - rng.uniform(0, 0.3) * (right - left)
    kind = rng.random()
    if kind < 0.3:
        made["gap"] = rng.choice((0.0, 0.01, -0.01, [0.0, 0.02]))
    elif kind < 0.8:
        places = sorted(rng.uniform(made["from"], made["to"]) for _ in range(rng.randint(2, 6)))
        made["profile"] = [[x, rng.choice((0.0, rng.uniform(-0.02, 0.02)))] for x in places]
    return made


def _support(rng):
    kind = rng.random()
    if kind < 0.3:
        return {"side": "both", "stiffness": rng.choice((100.0, 1e4))}
    if kind < 0.6:
        return {"side": "below", "stiffness": rng.choice((1e3, math.inf)), "gap": rng.uniform(-0.05, 0.05)}
    if kind < 0.8:
        return {"side": "above", "stiffness": 1e3, "gap": rng.uniform(-0.02, 0.05)}
    return {"side": "both", "settlement": -rng.uniform(0.03, 0.06)}


def pressed_scene(seed):
    """A scene on rigid ground under compression, less than the beam bears between its ends, which are held both ways.

    Parameters
    ----------
    seed : int
    """
    scene, rng = rigid_scene(seed, seed % 3 == 0), random.Random(seed)
    beam, length = scene["beam"], sum(scene["beam"]["spans"])
    beam.pop("hinges", None)
    scene["supports"] += [{"x": x, "side": "both", "stiffness": rng.choice((1e3, 1e5))} for x in (0.0, length)]
    beam["N"] = [-rng.uniform(0.05, 0.95) * math.pi**2 * min(beam["EI"]) / length**2] * len(beam["spans"])
    return scene
