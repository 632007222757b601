"""Random beams above ground that they touch to a few roundings: the gap is the largest deflection of the beam without ground."""

import math
import random

import gapbeam

ROUNDINGS = (0, 0, 1, 2, 5, 20, 50, 90, 200, 1000)


def touching_scene(seed):
    """A scene of one to three spans on supports that hold both ways, above one foundation.

    Parameters
    ----------
    seed : int

    Returns
    -------
    dict
    """
    rng = random.Random(seed)
    spans = [rng.choice((4.0, 6.0, 10.0, rng.uniform(2, 12))) for _ in range(rng.choice((1, 1, 2, 3)))]
    if rng.random() < 0.3:
        spans = [spans[0]] * len(spans)
    nodes = [sum(spans[:i]) for i in range(len(spans) + 1)]
    loads = [{"type": "uniform", "q": 10 ** rng.uniform(-1, 1)}]
    if rng.random() < 0.5:
        loads.append({"type": "force", "x": nodes[-1] * rng.choice((0.5, 0.25, rng.random())), "F": rng.uniform(0, 20)})
    supports = [{"node": i} for i in range(len(nodes))]
    made = {"beam": {"spans": spans, "EI": 10 ** rng.uniform(1, 5)}, "supports": supports, "loads": loads}
    gap = gapbeam.solve(made).extremes["deflection"]["max"].value
    gap *= 1.0 + rng.choice((1, -1)) * rng.choice(ROUNDINGS) * math.ulp(1.0)
    k = 10 ** rng.uniform(0, 9)
    ground = {"side": "below", "gap": gap, "k": k}
    if rng.random() < 0.3:
        del ground["k"]
        kind = rng.choice(("tanh", "hyperbolic", "plastic", "points"))
        ground["law"] = {"type": kind, "stiffness": k, "limit": k * 1e-3}
        if kind == "points":
            ground["law"] = [[1e-3, k * 1e-3], [2e-3, k * 1.5e-3]]
    return made | {"foundation": [ground]}
