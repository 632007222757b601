"""Random piles through layers of ground with laws, and beams over such; nothing here solves anything."""

import random
from functools import partial
from itertools import pairwise

from .foundation import digits, rounded


def random_layered_scene(seed):
    """A beam of one span on one to four foundations that touch, each with a law that never falls, loaded at its ends and along.

    Parameters
    ----------
    seed : int

    Returns
    -------
    dict
    """
    rng = random.Random(seed)
    log = partial(rounded, rng)
    length, EI = rng.randint(16, 160) / 8, log(0.5, 5000)
    beta = log(2, 12) / length
    k, size = 4 * EI * beta**4, log(0.5, 50)
    depth = size * beta / (2 * k)
    count = rng.choice((1, 2, 2, 3, 4))
    borders = [0.0, *(x / 8 for x in sorted(rng.sample(range(1, int(8 * length)), count - 1))), length]
    side = rng.choice(("both", "both", "below", "above"))
    alike = _polyline(rng, 1.0, 1.0, log)
    ground = []
    for start, end in pairwise(borders):
        points = alike if rng.random() < 0.5 else _polyline(rng, 1.0, 1.0, log)
        places = [(start, log(0.3, 3)), (end, log(0.3, 3))] if rng.random() < 0.6 else [(start, log(0.3, 3))]
        law = [{"x": x, "points": [[digits(d * depth), digits(p * share * k * depth)] for d, p in points]} for x, share in places]
        made = {"from": start, "to": end, "side": side, "law": law if len(places) > 1 else law[0]["points"]}
        if side != "both" and rng.random() < 0.3:
            made["gap"] = digits(depth * log(0.05, 0.5))
        ground.append(made)
    ends = [0.0, length]
    place = rng.choice((*ends, rng.randint(1, int(8 * length) - 1) / 8))
    loads = [{"type": "force", "x": place, "F": digits(size * rng.choice((-1, 1)))}]
    if rng.random() < 0.4:
        loads.append({"type": "moment", "x": rng.choice(ends), "M": digits(size / beta * rng.uniform(-1, 1))})
    if rng.random() < (0.3 if side == "both" else 0.9):
        sign = {"both": rng.choice((-1, 1)), "below": 1, "above": -1}[side]
        loads.append({"type": "uniform", "q": digits(sign * size / length * log(0.1, 3)), "case": "dead"})
    scene = {"beam": {"spans": [length], "EI": EI}, "foundation": ground, "loads": loads}
    if rng.random() < 0.2:
        scene["supports"] = [{"x": rng.choice(ends), "stiffness": digits(k / beta * log(0.1, 3))}]
        if rng.random() < 0.5:
            scene["supports"][0].update(side=rng.choice(("below", "above")), gap=digits(depth * log(0.05, 1)))
    return scene


def _polyline(rng, d, p, log):
    """Points up to some times a displacement d and a force p, less and less steep; the first ones may be quite near to 0."""
    share = rng.choice((0.1, 0.1, 1e-3, 1e-5))
    x, slope, points = d * share, p / d / rng.choice((1.0, share)), []
    y = slope * x
    for _ in range(rng.randint(1, 5)):
        points.append([x, y])
        step, slope = x * log(0.5, 4), slope * rng.uniform(0.2, 0.9)
        x, y = x + step, y + slope * step
    return points
