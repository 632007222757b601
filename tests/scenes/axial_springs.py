"""Random beams on springs and sliders along them, with histories; all places on a mesh of quarters."""

import random


def bedded_bar(seed: int) -> dict:
    """A scene: ground along the beam in stretches that overlap, with limits that change, loads along the beam, axial supports."""
    rng = random.Random(seed)
    spans = [rng.choice((2.0, 3.5, 5.0, 8.0)) for _ in range(rng.randint(1, 3))]
    end = sum(spans)

    def place():
        return rng.randrange(int(4 * end) + 1) / 4

    def stretch():
        a, b = sorted(rng.sample(range(int(4 * end) + 1), 2))
        return {"from": a / 4, "to": b / 4}

    def ground():
        limits, kind = [rng.choice((0.5, 1.0, 2.0, 3.0)) for _ in range(2)], rng.random()
        limit = None if kind < 0.1 else limits if kind < 0.4 else [0.0, limits[1]] if kind < 0.5 else limits[0]
        return {"stiffness": rng.choice((1.0, 5.0, 20.0, 100.0)), **({} if limit is None else {"limit": limit})}

    def case():
        return rng.choice(("live", "live", "dead"))

    grounds = [{**stretch(), **ground()} for _ in range(rng.randint(1, 3))]
    if rng.random() < 0.4:
        grounds = [ground()]
    loads = [{"type": "temperature", "dT": rng.uniform(-60, 60), **stretch(), "case": case()} for _ in range(rng.randint(0, 3))]
    loads += [{"type": "axial", "F": rng.uniform(-6, 6), "x": place(), "case": case()} for _ in range(rng.randint(0, 3))]
    loads += [{"type": "axial_uniform", "q": rng.uniform(-1, 1), **stretch(), "case": case()} for _ in range(rng.randint(0, 1))]
    springs = {place(): rng.choice((5.0, 50.0, 500.0, float("inf"))) for _ in range(rng.choice((0, 0, 1, 2)))}
    return {
        "beam": {"spans": spans, "EI": 1e6, "EA": 100.0, "alpha": 1e-3, "depth": 1.0},
        "sections": [{**stretch(), "EA": rng.choice((50.0, 200.0, 1000.0))} for _ in range(rng.randint(0, 2))],
        "supports": [{"x": 0.0}, {"x": end}, *({"x": x, "direction": "axial", "stiffness": k} for x, k in springs.items())],
        "axial_ground": grounds, "loads": loads or [{"type": "temperature", "dT": 30.0}],
        "analysis": {
            "history": [rng.uniform(-1.5, 1.5) for _ in range(rng.randint(1, 4))], "follow": "events", "first_order": True,
        },
    }  # fmt: skip
