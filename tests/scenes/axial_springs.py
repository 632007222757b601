"""Random beams on springs and sliders along them, with histories; all places on a mesh of quarters."""

import random

from scenes.links_along import bar_on_ground, on_quarters, springs_along, stiffer_sections, warm


def bedded_bar(seed: int) -> dict:
    """A scene: ground along the beam in stretches that overlap, with limits that change, loads along the beam, axial supports."""
    rng = random.Random(seed)
    spans, place, stretch = on_quarters(rng)

    def ground():
        limits, kind = [rng.choice((0.5, 1.0, 2.0, 3.0)) for _ in range(2)], rng.random()
        limit = None if kind < 0.1 else limits if kind < 0.4 else [0.0, limits[1]] if kind < 0.5 else limits[0]
        return {"stiffness": rng.choice((1.0, 5.0, 20.0, 100.0)), **({} if limit is None else {"limit": limit})}

    def case():
        return rng.choice(("live", "live", "dead"))

    grounds = [{**stretch(), **ground()} for _ in range(rng.randint(1, 3))]
    if rng.random() < 0.4:
        grounds = [ground()]
    loads = [warm(rng.uniform(-60, 60), **stretch(), case=case()) for _ in range(rng.randint(0, 3))]
    loads += [{"type": "axial", "F": rng.uniform(-6, 6), "x": place(), "case": case()} for _ in range(rng.randint(0, 3))]
    loads += [{"type": "axial_uniform", "q": rng.uniform(-1, 1), **stretch(), "case": case()} for _ in range(rng.randint(0, 1))]
    springs = springs_along(rng, place)
    return bar_on_ground(rng, spans, stiffer_sections(rng, stretch), springs, grounds, loads)
