"""Beams with links and ground along them: racks on supports that rub, and pipes in soil that lets them slide."""

from scenes.plain import at, force


def along(node, **keys):
    return at(node, direction="axial", **keys)


def warm(dT, **keys):
    return {"type": "temperature", "dT": dT, **keys}


def own_weight(q=8.0):
    return {"type": "uniform", "q": q, "case": "dead"}


def random_rack(draw):
    """A beam of one to three spans on supports that rub or not, with links along it; no two rigid ones at a node."""
    spans = [draw.choice([1.0, 2.0, 1.5]) for _ in range(draw.choice([1, 2, 2, 3]))]
    end, supports = len(spans), []
    for node in range(end + 1):
        side = draw.choice(["below", "below", "both"])
        supports.append(at(node, side=side, friction=draw.choice([0.0, 0.2, 0.3, 0.5])))
    if end > 1 and supports[1]["side"] == "below" and draw.random() < 0.4:
        supports[1]["gap"] = 0.001
    links = {}
    for node in draw.sample(range(end + 1), draw.choice([0, 1, 1, 2])):
        kind = draw.choice(["left", "right", "spring", "yields"])
        if kind in ("left", "right"):
            links[node] = along(node, side=kind, gap=draw.choice([0.0, 0.01, 0.02, -0.005]))
            if draw.random() < 0.6:
                links[node]["stiffness"] = draw.choice([50.0, 400.0])
            else:
                supports[node]["friction"] = 0.0
        elif kind == "spring":
            links[node] = along(node, stiffness=draw.choice([30.0, 300.0]), settlement=draw.choice([0.0, 0.0, 0.01]))
        else:
            links[node] = along(node, law=[[0.01, 2.0], [1.0, 2.0]], unloading="plastic")
    loads = [own_weight(draw.choice([15.0, 28.0])), force(draw.uniform(0.1, sum(spans) - 0.1), draw.choice([-20.0, -8.0, 25.0]))]
    part = {} if draw.random() < 0.6 else {"from": 0.0, "to": spans[0]}
    loads.append(warm(draw.choice([20.0, 60.0, -40.0]), case=draw.choice(["live", "live", "dead"]), **part))
    if links and draw.random() < 0.25:
        loads.append({"type": "movement", "support": len(supports), "value": draw.choice([0.02, -0.01])})
    if (links or any(one["friction"] for one in supports)) and draw.random() < 0.6:
        x = draw.choice([0.0, sum(spans), spans[0], spans[0] / 2])
        loads.append({"type": "axial", "x": x, "F": draw.choice([3.0, -4.0, 1.0]), "case": draw.choice(["live", "dead"])})
    history = [1.0]
    for _ in range(draw.choice([0, 1, 2, 3])):
        history.append(draw.choice([to for to in (0.0, -1.0, 0.5, 1.5, 1.0, -0.5) if to != history[-1]]))
    beam = {"spans": spans, "EA": draw.choice([50.0, 200.0, 1000.0, 3e4]), "alpha": draw.choice([1e-4, 1e-3])}
    return beam, supports + list(links.values()), loads, history


def random_stops(draw):
    """A beam on one-sided supports between stops, springs and links that yield, which axial loads and warmth press or pull."""
    count = draw.randint(1, 5)
    spans = [draw.choice([2.0, 3.0, 5.0]) for _ in range(count)]
    across = [at(0), at(count)]
    for node in range(1, count):
        across.append(at(node, side=draw.choice(["both", "below", "above"]), gap=draw.choice([0.0, 0.005, 0.02])))
    for one in across:
        if one.get("side", "both") == "both":
            one.pop("gap", None)
        if draw.random() < 0.3:
            one["stiffness"] = draw.choice([50.0, 400.0])
    links = []
    for node in draw.sample(range(count + 1), draw.randint(1, min(4, count + 1))):
        kind = draw.choice(["left", "right", "pair", "spring", "yields"])
        if kind == "spring":
            settlement = draw.choice([0.0, 0.0, 0.00390625, -0.0078125])
            links.append(along(node, stiffness=draw.choice([64.0, 512.0, 4096.0]), settlement=settlement))
        elif kind == "yields":
            links.append(along(node, law=[[0.0078125, 8.0], [1.0, 8.0]], unloading="plastic"))
        for side in ("left", "right"):
            if kind in (side, "pair"):
                gap = draw.choice([0.0, 0.0078125, 0.015625, -0.00390625])
                rigid = {} if kind != "pair" and draw.random() < 0.4 else {"stiffness": draw.choice([64.0, 512.0])}
                links.append(along(node, side=side, gap=gap, **rigid))
    if not any(set(one) == {"node", "direction", "stiffness", "settlement"} for one in links):
        links = [one for one in links if one["node"] > 0] + [along(0, stiffness=16.0, settlement=0.0)]
    EI = draw.choice([100.0, 1000.0])
    push = EI * draw.choice([-0.25, -0.125, 0.25, 1.0]) * draw.choice([0.25, 1.0])
    loads = [
        own_weight(draw.choice([-2.0, 3.0])), force(draw.uniform(0.1, sum(spans) - 0.1), draw.choice([5.0, -8.0, 10.0])),
        {"type": "axial", "x": sum(spans[: draw.randint(0, count)]), "F": push, "case": draw.choice(["dead", "live"])},
    ]  # fmt: skip
    if draw.random() < 0.6:
        loads.append(warm(draw.choice([32.0, -16.0, 64.0]), case=draw.choice(["dead", "live"])))
    if draw.random() < 0.3:
        value = draw.choice([0.00390625, -0.00390625, 0.015625])
        loads.append({"type": "movement", "support": len(across) + draw.randrange(len(links)), "value": value})
    return {"beam": {"spans": spans, "EI": EI, "EA": 8192.0, "alpha": 2.0**-13}, "supports": across + links, "loads": loads}


def on_quarters(rng):
    """Spans, and what draws a place and a stretch along them, all on a mesh of quarters."""
    spans = [rng.choice((2.0, 3.5, 5.0, 8.0)) for _ in range(rng.randint(1, 3))]
    end = sum(spans)

    def place():
        return rng.randrange(int(4 * end) + 1) / 4

    def stretch():
        a, b = sorted(rng.sample(range(int(4 * end) + 1), 2))
        return {"from": a / 4, "to": b / 4}

    return spans, place, stretch


def stiffer_sections(rng, stretch):
    return [{**stretch(), "EA": rng.choice((50.0, 200.0, 1000.0))} for _ in range(rng.randint(0, 2))]


def springs_along(rng, place):
    """Stiffnesses of axial supports by their places."""
    return {place(): rng.choice((5.0, 50.0, 500.0, float("inf"))) for _ in range(rng.choice((0, 0, 1, 2)))}


def bar_on_ground(rng, spans, sections, springs, grounds, loads):
    """A bar with a history, warmed where there is no load."""
    supports = [{"x": x, "direction": "axial", "stiffness": k} for x, k in springs.items()]
    history = [rng.uniform(-1.5, 1.5) for _ in range(rng.randint(1, 4))]
    return {
        "beam": {"spans": spans, "EI": 1e6, "EA": 100.0, "alpha": 1e-3, "depth": 1.0}, "sections": sections,
        "supports": [{"x": 0.0}, {"x": sum(spans)}, *supports], "axial_ground": grounds, "loads": loads or [warm(30.0)],
        "analysis": {"history": history, "follow": "events", "first_order": True},
    }  # fmt: skip


def random_pipe(rng):
    """A pipe on rigid ground with limits."""
    spans, place, stretch = on_quarters(rng)
    grounds = [{**stretch(), "limit": rng.choice((0.5, 1.0, 2.0, 3.0))} for _ in range(rng.randint(1, 3))]
    if rng.random() < 0.4:
        grounds = [{"limit": rng.choice((0.5, 1.0, 2.0))}]
    loads = [warm(rng.uniform(-60, 60), **stretch(), case=rng.choice(("live", "live", "dead"))) for _ in range(rng.randint(0, 3))]
    loads += [{"type": "axial", "F": rng.uniform(-6, 6), "x": place(), "case": rng.choice(("live", "live", "dead"))}
              for _ in range(rng.randint(0, 3))]  # fmt: skip
    sections = stiffer_sections(rng, stretch)
    return bar_on_ground(rng, spans, sections, springs_along(rng, place), grounds, loads)
