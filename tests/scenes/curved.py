"""Random beams on ground whose laws have parameters, for comparison with `oracle/curved.py`; nothing here solves anything."""

import math
import random
from functools import partial

from .foundation import digits, rounded


def random_curved_scene(seed):
    """A scene of one span with one or two foundations, of all laws with parameters; often without an equilibrium.

    Parameters
    ----------
    seed : int

    Returns
    -------
    dict
    """
    rng = random.Random(seed)
    log = partial(rounded, rng)

    def parameter(value, may_begin_at_0=True):
        choice = rng.random()
        if choice < 0.3:
            return digits(value)
        if choice < 0.5 and may_begin_at_0:
            return [0.0, digits(2 * value)]
        return [digits(value * log(0.3, 3)), digits(value * log(0.3, 3))]

    length, EI = rng.randint(16, 48) / 8, log(0.5, 500)
    beta = log(1, 12) / length
    k, size = 4 * EI * beta**4, log(0.5, 50)
    depth = size * beta / (2 * k)
    beam = {"spans": [length], "EI": EI}
    if rng.random() < 0.25:
        beam["GA"] = log(0.3, 30) * EI * beta**2
    foundations = []
    for number in range(1 if rng.random() < 0.75 else 2):
        made = {"side": rng.choice(["below", "below", "above", "both", "both"])}
        if rng.random() < 0.3 or number:
            made["from"], made["to"] = (x / 8 for x in sorted(rng.sample(range(0, int(8 * length) + 1, 2), 2)))
        made["law"] = random_law(rng, k, depth, log, parameter)
        if rng.random() < 0.4:
            made["gap"] = digits((1 if made["side"] == "both" else rng.choice([1, 1, -1])) * depth * log(0.05, 1))
        foundations.append(made)
    loads = [random_load(rng, length, size, beta, log) for _ in range(rng.randint(1, 3))]
    if rng.random() < 0.7:
        loads.append({"type": "uniform", "q": digits(size / length * log(0.1, 1)), "case": "dead"})
    scene = {"beam": beam, "foundation": foundations, "loads": loads}
    if rng.random() < 0.5:
        scene["supports"] = [{"x": rng.choice([0.0, length, rng.randint(1, int(8 * length) - 1) / 8])}]
        if rng.random() < 0.5:
            scene["supports"][0]["stiffness"] = digits(k / beta * log(0.1, 3))
    return scene


def random_law(rng, k, depth, log, parameter):
    """A law of stiffness k or so."""
    kind = rng.choice(["tanh", "tanh", "hyperbolic", "cubic", "plastic", "hardening"])
    limit = k * depth * log(0.3, 10)
    if kind == "cubic":
        law = {"type": kind, "k1": parameter(k), "k3": parameter(k / depth**2 * log(0.1, 10))}
        if rng.random() < 0.3 and not isinstance(law["k1"], list) and not isinstance(law["k3"], list):
            law["k2"] = digits(rng.choice([1, -0.9]) * math.sqrt(3 * law["k1"] * law["k3"]))
        return law
    law = {"type": kind, "stiffness": parameter(k), "limit": parameter(limit, False)}
    if isinstance(law["stiffness"], list) and law["stiffness"][0] == 0 and rng.random() < 0.5:
        law["limit"] = [0.0, digits(2 * limit)]
    return law | ({"slope": parameter(k * log(0.02, 1.5), False)} if kind == "hardening" else {})


def random_load(rng, length, size, beta, log):
    """A force, a moment or a uniform load."""
    choice = rng.random()
    x = rng.choice([0.0, length, rng.randint(1, int(8 * length) - 1) / 8, rng.randint(1, int(8 * length) - 1) / 8])
    if choice < 0.6:
        return {"type": "force", "x": x, "F": digits(rng.choice([1, 1, -1]) * size * log(0.3, 2))}
    if choice < 0.8:
        return {"type": "moment", "x": x, "M": digits(rng.choice([1, -1]) * size / beta * log(0.1, 1))}
    return {"type": "uniform", "q": digits(size / length * log(0.3, 3))}
