"""Scenes in which parts of many kinds meet: each has two to five of them, drawn at random."""

import random
from itertools import accumulate

PARTS = ("along", "friction", "temperature", "hinge", "restraints", "taper", "ground", "N", "mass", "laws", "plastic", "curves",
         "GA")  # fmt: skip


def mixed_scene(seed):
    """What meets in a scene, and the scene."""
    rng = random.Random(f"mixed {seed}")
    parts = set(rng.sample(PARTS, rng.randint(2, 5)))
    spans = [round(rng.uniform(2.0, 8.0), 2) for _ in range(rng.randint(1, 4))]
    nodes = [round(x, 6) for x in accumulate(spans, initial=0.0)]
    beam = {"spans": spans, "EI": round(10.0 ** rng.uniform(2.5, 4.5), 2)}
    made = {"beam": beam, "supports": _supports(rng, parts, nodes), "loads": _loads(rng, parts, nodes)}
    if parts & {"along", "friction", "temperature"}:
        beam["EA"] = round(beam["EI"] * rng.uniform(5.0, 100.0), 2)
    if "temperature" in parts:
        beam |= {"alpha": 1.2e-5, "depth": 0.4}
    if "GA" in parts:
        beam["GA"] = round(beam["EI"] * rng.uniform(0.5, 20.0), 2)
    if "N" in parts:
        beam["N"] = round(rng.choice((1.0, 1.0, -1.0)) * 10.0 ** rng.uniform(0.0, 2.3) * beam["EI"] * 1e-4, 3)
    if "mass" in parts:
        beam["mass"] = round(rng.uniform(0.1, 3.0), 2)
    if "hinge" in parts:
        made["hinges"] = [{"x": round(rng.uniform(0.1, 0.9) * nodes[-1], 2), **_joint(rng, rng.random())}]
    if "taper" in parts:
        k = rng.randrange(len(spans))
        EI = [beam["EI"], round(beam["EI"] * rng.uniform(0.4, 3.0), 2)]
        made["sections"] = [{"from": nodes[k], "to": nodes[k + 1], "EI": EI}]
    if "ground" in parts:
        side = rng.choice(("below", "both"))
        made["foundation"] = [{"from": rng.choice((0.0, 0.2)) * nodes[-1], "to": rng.uniform(0.5, 1.0) * nodes[-1], "side": side,
                               "k": round(10.0 ** rng.uniform(1.5, 3.5), 1)}]  # fmt: skip
        if side == "below" and rng.random() < 0.4:
            made["foundation"][0]["gap"] = round(rng.uniform(0.0005, 0.006), 4)
    return " ".join(sorted(parts)), made


def _joint(rng, kind):
    """What holds a rotation: free, a spring, a law, or a slack."""
    if kind < 0.3:
        return {"stiffness": round(10.0 ** rng.uniform(2.0, 4.5), 1)}
    if kind < 0.6:
        return {"law": [[0.002, round(rng.uniform(3.0, 20.0), 1)], [0.02, round(rng.uniform(25.0, 40.0), 1)]]}
    return {"slack": round(rng.uniform(0.0005, 0.01), 4)} if kind < 0.8 else {}


def _supports(rng, parts, nodes):
    supports = []
    for x in nodes:
        one = {"x": x, "side": rng.choice(("both", "below", "below"))}
        if x in (nodes[0], nodes[-1]) and rng.random() < 0.6:
            one["side"] = "both"
        kind = rng.random()
        if "laws" in parts and kind < 0.5:
            one["law"] = [[0.004, round(rng.uniform(5.0, 40.0), 1)], [0.03, round(rng.uniform(45.0, 70.0), 1)]]
            one |= {"unloading": "plastic"} if "plastic" in parts and rng.random() < 0.7 else {}
        elif "curves" in parts and kind < 0.3:
            stiffness, limit = round(rng.uniform(500.0, 5e3), 1), round(rng.uniform(40.0, 200.0), 1)
            one["law"] = {"type": "tanh", "stiffness": stiffness, "limit": limit}
        elif kind < 0.4:
            one["stiffness"] = round(10.0 ** rng.uniform(2.5, 5.0), 1)
        if one["side"] != "both" and rng.random() < 0.4:
            one["gap"] = round(rng.uniform(0.0005, 0.01), 4)
        if "friction" in parts and "law" not in one and rng.random() < 0.5:
            one["friction"] = round(rng.uniform(0.1, 0.5), 2)
        if "restraints" in parts and rng.random() < 0.4:
            side = rng.choice(("both", "both", "clockwise", "counterclockwise"))
            one["rotation"] = {"side": side, **_joint(rng, rng.uniform(0.0, 0.8))}
        supports.append(one)
    if parts & {"along", "friction", "temperature"}:
        spring = {"stiffness": round(10.0 ** rng.uniform(3.0, 5.0), 1)} if rng.random() < 0.5 else {}
        supports.append({"x": rng.choice(nodes), "direction": "axial", **spring})
        if rng.random() < 0.4:
            side = rng.choice(("left", "right", "both"))
            gap = {} if side == "both" else {"gap": round(rng.uniform(0.0001, 0.004), 5)}
            supports.append({"x": rng.choice(nodes), "direction": "axial", "side": side, "stiffness": 2e4, **gap})
    return supports


def _loads(rng, parts, nodes):
    # Its own weight tells what hangs from a hinge
    length, loads = nodes[-1], [{"type": "uniform", "q": round(rng.uniform(0.2, 1.0), 2), "case": "dead"}]
    for _ in range(rng.randint(1, 3)):
        kind, part = rng.random(), {"from": rng.uniform(0.0, 0.4) * length, "to": rng.uniform(0.5, 1.0) * length}
        if kind < 0.35:
            one = {"type": "uniform", "q": round(rng.uniform(-2.0, 10.0), 2), **(part if rng.random() < 0.4 else {})}
        elif kind < 0.6:
            one = {"type": "force", "F": round(rng.uniform(-15.0, 40.0), 2), "x": round(rng.random() * length, 2)}
        elif kind < 0.75:
            one = {"type": "moment", "M": round(rng.uniform(-20.0, 40.0), 2), "x": round(rng.uniform(0.01, 0.99) * length, 2)}
        elif kind < 0.85:
            one = {"type": "linear", "q": [round(rng.uniform(-2.0, 8.0), 2) for _ in range(2)], **part}
        else:
            one = {"type": "curvature", "kappa": round(rng.uniform(-0.002, 0.002), 5)}
        loads.append({**one, "case": rng.choice(("live", "live", "dead"))})
    if "temperature" in parts:
        warm = {"dT": round(rng.uniform(-40.0, 60.0), 1), "gradient": round(rng.uniform(-10.0, 10.0), 1)}
        loads.append({"type": "temperature", **warm, "case": rng.choice(("live", "dead"))})
    if parts & {"along", "friction"}:
        loads.append({"type": "axial", "F": round(rng.uniform(-15.0, 15.0), 2), "x": round(rng.random() * length, 2)})
    return loads
