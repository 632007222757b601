"""Random scenes with a train, for comparison with `oracle/trains.py`, and that comparison; nothing here solves anything.

All numbers are short binary fractions, so that what ties on purpose ties in doubles, too. A third of the scenes is made of equal
spans, equal spacings and round numbers: an axle comes to a node where another leaves one, supports touch exactly.
"""

import itertools
import random

from oracle import envelope
from oracle.trains import Passage

from .plain import at, force, nodes_of, scene, stretch, uniform

NAMES = ("moment", "shear", "deflection")


def random_scene(seed):
    """A scene of 1 to 6 spans with one train, usually with an equilibrium everywhere.

    Parameters
    ----------
    seed : int

    Returns
    -------
    dict
    """
    rng = random.Random(seed)
    even = rng.random() < 0.35
    count = rng.choice((1, 2, 2, 3, 3, 4, 5, 6))
    size = rng.randint(8, 48) / 8.0
    spans = [size] * count if even else [max(1.0, round(8 * size * rng.uniform(0.5, 1.5)) / 8) for _ in range(count)]
    P = float(rng.randint(4, 64))
    # A span deflects about 1/64 under an axle; gaps are multiples of 1/1024.
    EI = float(max(1, round(P * size**3 * 64 / 48)))
    made = scene(spans, [], EI=[EI * rng.choice((0.5, 1.0, 1.0, 2.0)) for _ in spans] if rng.random() < 0.25 and not even else EI)
    if rng.random() < 0.1:
        made["beam"]["GA"] = float(round(rng.uniform(3, 30) * EI / size**2) + 1)
    add_supports(rng, made, even, EI / size**3)
    if rng.random() < 0.25 and count > 1:
        at = rng.sample(range(1, 8 * count), rng.choice((1, 1, 2)))
        turning = [s["node"] for s in made["supports"] if "rotation" in s]
        made["beam"]["hinges"] = sorted(x for x in (sum(spans) * k / (8 * count) for k in at) if x not in
                                        {nodes_of(made)[i] for i in turning})
    dead = rng.choice((0.25, 0.5, 1.0, 2.0)) * rng.choice((0.125, 0.25, 0.5)) * P
    made["loads"] = [uniform(dead / 4, case="dead")] if rng.random() < 0.95 else []
    length = sum(spans)
    for _ in range(rng.choice((0, 0, 1, 2))):
        made["loads"].append(force(length * rng.randint(0, 16) / 16, float(rng.randint(-8, 16)) * P / 32, case="dead"))
    if rng.random() < 0.15:
        a, b = sorted(rng.sample(range(17), 2))
        made["loads"].append(uniform(dead / 8, case="dead", **stretch(length * a / 16, length * b / 16)))
    made["trains"] = [random_train(rng, even, size, P, length)]
    return made


def add_supports(rng, made, even, stiff):
    """Supports at most nodes, some between, few of them bilateral; sometimes overhangs."""
    nodes = nodes_of(made)
    places = [i for i in range(len(nodes)) if rng.random() < (0.95 if 0 < i < len(nodes) - 1 else 0.8)]
    places = places if len(places) > 1 else [0, len(nodes) - 1]
    holds = rng.random() < 0.3
    where = [{"node": i} for i in places]
    if rng.random() < 0.2:
        k = rng.randrange(len(nodes) - 1)
        where.append({"x": nodes[k] + made["beam"]["spans"][k] * rng.choice((0.25, 0.5, 0.75))})
    for place in where:
        side = rng.choices(("below", "both", "above", "pair"), (10, 4 if holds else 0.5, 0.5, 1))[0]
        spring = {"stiffness": float(max(1, round(stiff * 2.0 ** rng.randint(2, 12))))} if rng.random() < 0.35 else {}
        gap = 0 if even and rng.random() < 0.6 else rng.choice((0, 0, 1, 2, 4, 8, -1, -2, -4)) / 1024
        settled = {"settlement": rng.randint(-4, 4) / 1024} if rng.random() < 0.1 and not even else {}
        if side == "both":
            turning = {"rotation": rng.choice(("fixed", float(round(stiff) + 1)))} if rng.random() < 0.2 and "node" in place else {}
            made["supports"].append({**place, **spring, **settled, **turning})
        elif side == "pair":
            made["supports"].append({**place, "side": "below", "gap": gap, **spring, **settled})
            made["supports"].append({**place, "side": "above", "gap": abs(gap) + rng.randint(1, 8) / 1024, **spring, **settled})
        else:
            made["supports"].append({**place, "side": side, "gap": gap, **spring, **settled})


def random_train(rng, even, size, P, length):
    """1 to 5 axles, sometimes with a uniform load, a range, `inside`, both directions."""
    count = rng.choice((1, 1, 2, 2, 3, 4, 5))
    if even:
        gaps = [size * rng.choice((0.5, 1.0, 1.0, 2.0, 0.25))] * (count - 1)
        forces = [P] * count
    else:
        gaps = [rng.randint(2, 40) / 8.0 for _ in range(count - 1)]
        forces = [P * rng.choice((0.25, 0.5, 1.0, 1.0, 1.5)) for _ in range(count)]
    train = {"name": "train", "axles": [[d, F] for d, F in zip(itertools.accumulate([0.0, *gaps]), forces, strict=True)]}
    if rng.random() < 0.2:
        train["factor"] = 1.25
    if rng.random() < 0.2 and count > 1:
        train["q"] = P / 8 * rng.choice((0.5, 1.0, 2.0))
    if rng.random() < 0.4:
        train["both_directions"] = True
    kind = rng.random()
    if kind < 0.15 and sum(gaps) < length:
        train["inside"] = True
    elif kind < 0.3:
        train["from"], train["to"] = length * rng.randint(0, 7) / 16, length * rng.randint(8, 16) / 16
    return train


def ties():
    """Scenes by hand in which something ties exactly, by what ties.

    Returns
    -------
    dict
    """
    below = [at(i, side="below") for i in range(5)]
    touched = [at(0), at(1), {"x": 2.0, "side": "below", "gap": 1 / 64}]
    cantilever = [at(0, rotation="fixed"), at(1, side="below", gap=0.25)]
    hinged = [at(0), at(1), at(2), {"x": 3.0, "side": "below"}]
    ceiling = [at(0), at(2), at(1, side="above", gap=1 / 64)]

    def with_train(spans, supports, loads, axles, EI=1.0, **train):
        beam = {"hinges": train.pop("hinges")} if "hinges" in train else {}
        return {**scene(spans, supports, loads, EI=EI, **beam), "trains": [{"name": "train", "axles": axles, **train}]}

    return {
        # The largest deflection of the simple beam is the gap: a double root, no event.
        "touches": with_train([4.0], touched, [], [[0.0, 48.0]], 4096.0),
        "hardly closes": with_train([4.0], touched, [], [[0.0, 48.0 + 2.0**-30]], 4096.0),
        # Both end reactions vanish with the axle in the middle: one opens where the other closes.
        "changes sides": with_train([1.0] * 3, below[:4], [uniform(3.0)], [[0.0, 16.0]]),
        "changes sides, two axles": with_train([1.0] * 3, below[:4], [uniform(3.0)], [[0.0, 8.0]] * 2, both_directions=True),
        # An axle enters where another leaves: at that place alone both act.
        "as long as the beam": with_train([2.0, 2.0], below[:3], [uniform(1.0)], [[0.0, 8.0], [4.0, 8.0]]),
        "overhangs at both ends": with_train([1.0, 2.0, 1.0], below[1:3], [uniform(8.0)], [[0.0, 8.0], [4.0, 8.0]]),
        "leaves a free end": with_train([2.0], cantilever, [], [[0.0, 1.0], [2.0, 1.0]], both_directions=True),
        # A support that touches without force while the train is beyond the hinge.
        "touches all along": with_train([2.0, 2.0], hinged, [], [[0.0, 4.0]], 64.0, hinges=[2.0], both_directions=True),
        "an axle on every node": with_train([1.0] * 4, below, [uniform(1.0)], [[float(k), 8.0] for k in range(5)]),
        "an axle that lifts": with_train([1.0] * 3, below[:4], [uniform(4.0)], [[0.0, 8.0], [1.0, -6.0], [2.0, 8.0]]),
        "at the edge of tipping": with_train([2.0, 1.0], below[:2], [uniform(1.0)], [[0.0, 1.5]]),
        "tips at the very end": with_train([2.0, 1.0], below[:2], [uniform(1.0)], [[0.0, 1.5], [0.5, 2.0**-40]]),
        "under a ceiling": with_train([2.0] * 2, ceiling, [], [[0.0, -8.0], [1.0, 16.0]], 64.0),
        "longer than the beam": with_train([1.0] * 2, below[:3], [uniform(1.0)], [[0.0, 8.0], [5.0, 8.0]], q=0.5),
    }


def passages_of(made, at=()):
    """The oracle's passages of the first train: to the right, and to the left if it runs in both directions."""
    train = made["trains"][0]
    return [Passage(made, train, mirrored, at) for mirrored in ((False, True) if train.get("both_directions") else (False,))]


def exact_envelope(passages, xs=()):
    """The envelope as the scene format has it, of extremes of the oracle."""
    def over(function, *arguments):
        return envelope.merged(*(function(p, *arguments) for p in passages))

    count = range(len(passages[0].supports))
    return {
        "supports": [{"reaction": over(envelope.reaction, i), "opening": over(envelope.opening, i)} for i in count],
        "extremes": {"moment": over(envelope.extremes, "moment"), "shear": over(envelope.extremes, "shear"),
                     "deflection": over(envelope.deflection)},
        "fields": {name: [over(envelope.curve, name, x) for x in xs] for name in NAMES},
    }


def frozen(made, s, mirrored=False):
    """The scene with the train standing at s, as forces and a uniform load, all of them dead."""
    train, length = made["trains"][0], nodes_of(made)[-1]
    sign, factor = (1 if mirrored else -1), train.get("factor", 1.0)
    loads = [force(s + sign * d, factor * F, case="dead") for d, F in train["axles"] if 0 <= s + sign * d <= length]
    low, high = sorted((s, s + sign * train["axles"][-1][0]))
    if train.get("q") and max(low, 0.0) < min(high, length):
        loads.append(uniform(factor * train["q"], case="dead", **stretch(max(low, 0.0), min(high, length))))
    return {**{key: item for key, item in made.items() if key != "trains"}, "loads": made["loads"] + loads}


def assert_as_forces(made, solve, x, positions):
    """States under the first train are those of the scene with its axles as forces, and inside the envelope.

    Parameters
    ----------
    made : dict
        The scene, whose train runs to the right.
    solve : callable
        Solves a scene.
    x : numpy.ndarray
        Where fields are compared.
    positions : numpy.ndarray
        Of the train.

    Returns
    -------
    object
        The result with the train.
    """
    result = solve(made)
    (train,), envelope = result.trains.values(), result.envelope().extremes
    for position in positions.tolist():
        still, found = solve(frozen(made, position)), train.at(x, position=position)
        for quantity in ("deflection", "moment", "shear"):
            expected = getattr(still.at(x), quantity)
            assert abs(getattr(found, quantity) - expected).max() <= 1e-11 * abs(expected).max(), quantity
            for way, sign in (("max", 1), ("min", -1)):
                value = still.extremes[quantity][way].value
                assert sign * (envelope[quantity][way].value - value) >= -1e-10 * abs(value), (quantity, way)
    return result


# Comparison with a result in plain data (`gapbeam run --json`)


def differences(made, data, xs=(), tolerance=1e-10):
    """What a result says otherwise than the oracle, in words; empty where they agree.

    Numbers are compared relative to the largest of their kind, places relative to the length of the beam. A support that touches
    without force may be called closed or open, and opens or closes anywhere between the places where that is decided.

    Parameters
    ----------
    made : dict
        The scene.
    data : dict
        "trains" and "envelope" as in the scene format.
    xs : sequence of float
        Places of the curves in the envelope's fields.
    tolerance : float

    Returns
    -------
    list of str
    """
    passages = passages_of(made, xs)
    found = []
    for passage in passages:
        found += different_events(passage, data["trains"][0], tolerance)
    return found + different_envelope(exact_envelope(passages, xs), data["envelope"], float(passages[0].length), tolerance)


def different_events(passage, said, tolerance):
    """Differences between the events of one direction and what a result says."""
    name, room = ("left" if passage.mirrored else "right"), 1e3 * tolerance * float(passage.length)
    theirs = sorted((e["support"], e["position"], e["event"]) for e in said["events"] if e.get("direction", "right") == name)
    ours = sorted((e.support, float(e.place), e.event, float(e.since)) for e in passage.events)
    if len(ours) == len(theirs):
        pairs = zip(ours, theirs, strict=True)
        if all(o[0] == t[0] and o[2] == t[2] and min(o[1], o[3]) - room <= t[1] <= max(o[1], o[3]) + room for o, t in pairs):
            return []
    return [f"running to the {name}: events {theirs}, exactly {ours}"]


def different_envelope(exact, said, length, tolerance):
    """Differences between envelopes."""
    found = []

    def compare(words, ours, theirs, scale):
        for end in ("max", "min"):
            limit = ours[end]
            if end in theirs and limit.value is not None:
                number, *places = theirs[end]
                if not abs(number - float(limit.value)) <= tolerance * scale:
                    found.append(f"{end} of {words}: {number!r}, exactly {float(limit.value)!r} with the train at "
                                 f"{[float(w.position) for w in limit.places]}; said to be at {places}")

    for name in ("reaction", "opening"):
        scale = largest([support[name] for support in exact["supports"]])
        for i, (ours, theirs) in enumerate(zip(exact["supports"], said["supports"], strict=True)):
            compare(f"{name} {i}", ours[name], theirs.get(name, {}), scale)
    for name in NAMES:
        scale = largest([exact["extremes"][name]])
        compare(name, exact["extremes"][name], said["extremes"][name], scale)
        for k, ours in enumerate(exact["fields"][name]):
            curves = said["fields"][name]
            compare(f"{name} at {said['fields']['x'][k]}", ours, {end: [curves[end][k]] for end in curves}, scale)
    return found


def largest(pairs):
    """The largest absolute value among extremes."""
    return max((abs(float(limit.value)) for two in pairs for limit in two.values() if limit.value is not None), default=0.0) or 1.0
