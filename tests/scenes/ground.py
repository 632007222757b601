"""Small scenes on the ground for the tests of report and pictures."""

import random

import scenes

UNITS = {"units": {"force": "kN", "length": "m"}}


def on_ground(spans, ground, loads, supports=(), **keys):
    """A scene with foundations, in kN and m."""
    return scenes.scene(spans, supports, loads, **keys) | {"foundation": list(ground)} | UNITS


def rail(**analysis):
    """A long rail under a force: it lies on the ground under the force and at both ends, and lifts off between."""
    loads = [scenes.force(15.0, 2.0), scenes.uniform(0.001, case="dead")]
    return on_ground([15.0, 15.0], [{"k": 4.0, "side": "below"}], loads, analysis=analysis)


def stopped(**analysis):
    """A beam turns about its end until ground near its tip, then a support under the tip stops it."""
    supports = [scenes.at(0), scenes.at(1, side="below", gap=0.02)]
    ground = [{"k": 10.0, "side": "below", "gap": 0.01, "from": 1.0}]
    return on_ground([2.0], ground, [scenes.uniform(10.0)], supports, EI=100.0, analysis=analysis)


def patches(count):
    """A beam on short patches of ground."""
    ground = [{"k": 100.0, "side": "below", "from": 2.0 * i, "to": 2.0 * i + 1.0} for i in range(count)]
    return on_ground([2.0 * count], ground, [scenes.uniform(1.0)], EI=10.0)


def two():
    """Ground that holds both ways, and beside it, below a part of it, one-sided ground with a growing gap."""
    ground = [{"k": 100.0, "to": 12.0}, {"k": [50.0, 500.0], "side": "below", "gap": [0.0, 0.05], "from": 8.0}]
    return on_ground([10.0, 10.0], ground, [scenes.force(4.0, 20.0), scenes.force(17.0, 50.0), scenes.force(12.0, -10.0)], EI=1e3)


def yielding():
    """Ground with a law of two branches."""
    loads = [scenes.force(5.0, 100.0), scenes.uniform(1.0, case="dead")]
    return on_ground([5.0, 5.0], [{"side": "below", "law": [[0.01, 20.0], [0.05, 30.0]]}], loads, EI=1e3)


def touching(over=0.0):
    """A simple beam that sags to the ground at midspan and no farther, but for a share of the way."""
    ground = [{"k": 4.0, "side": "below", "gap": 5.0 * 3.0 * 8.0**4 / 384.0 * (1.0 - over)}]
    return on_ground([8.0], ground, [scenes.uniform(3.0)], [scenes.at(0), scenes.at(1)])


def footing(steps=1):
    """A short beam that tips off its ground the more the load grows."""
    loads = [scenes.force(1.0, 300.0), scenes.uniform(12.0, case="dead")]
    return on_ground([6.0], [{"k": 2e4, "side": "below"}], loads, EI=5e4, analysis={"steps": steps})


def rough_pipe(seed, points=201):
    """A pipe over the survey of a rough seabed, a random walk that is drawn back to its level; laid empty, and then filled."""
    rng, gap, profile = random.Random(seed), 0.0, []
    for i in range(points):
        gap = 0.85 * gap + rng.gauss(0.0, 0.06)
        profile.append([1000.0 * i / (points - 1), round(gap, 3)])
    loads = [scenes.uniform(0.55, case="dead"), scenes.uniform(1.05)]
    ground = [{"k": 500.0, "side": "below", "profile": profile}]
    return on_ground([1000.0], ground, loads, EI=9.04e4, analysis={"follow": "events"})


def over_peaks(peaks, **keys):
    """A beam on two supports that a force in its middle bends onto peaks (x, gap), each a foundation of its own: it is down by
    4 times the load factor there, and by 2.75 times at the quarters."""
    ground = [{"from": x - 0.125, "to": x + 0.125, "k": 50.0, "side": "below",
               "profile": [[x - 0.125, gap + 1.0], [x, gap], [x + 0.125, gap + 1.0]]} for x, gap in peaks]  # fmt: skip
    return on_ground([2.0], ground, [scenes.force(1.0, 24.0)], [scenes.at(0), scenes.at(1)], analysis={"follow": "events"}, **keys)


def pile(load, turned=False):
    """A pile in two layers with laws, one under the other, under a force at its head; `turned`: seen from its tip."""
    length, border = 18.3, 6.1
    law = [[1e-6, 0.5], [1e-5, 1.0], [1e-3, 4.0], [1e-2, 9.0], [0.1, 20.0]]
    layers = [(0.0, border, 1.0, 3.0), (border, length, 2.0, 5.0)]
    if turned:
        layers = [(length - end, length - start, low, high) for start, end, high, low in layers[::-1]]
    ground = [
        {"from": start, "to": end, "law": [{"x": x, "points": [[d, share * p] for d, p in law]} for x, share in places]}
        for start, end, first, last in layers
        for places in [((start, first), (end, last))]
    ]
    return on_ground([length], ground, [scenes.force(length if turned else 0.0, load)], EI=1.2e5, analysis={"follow": "events"})
