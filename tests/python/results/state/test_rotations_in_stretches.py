"""Restraints and hinges with laws on ground, under axial forces and under trains: closed forms, and couples in their place."""

import math
import random
from itertools import pairwise

import gapbeam
import numpy as np
import pytest
from oracle.axial_force import solve
from oracle.axial_ground import Unsettled, solve_on_ground
from scenes.axial_force import random_scene
from scenes.foundation import digits, eighths
from scenes.plain import nodes_of, place
from scenes.train import assert_as_forces

EI, K = 300.0, 50.0
BETA = (K / (4 * EI)) ** 0.25
LONG = {"beam": {"spans": [30.0 / BETA], "EI": EI}, "foundation": [{"k": K, "side": "both"}]}


def head_of(**keys):
    """A pile under a force at its head, whose rotation is held by a law."""
    head = {"node": 0, "stiffness": 0.0, "rotation": keys, "name": "head"}
    return gapbeam.solve(LONG | {"supports": [head], "loads": [{"type": "force", "node": 0, "F": 10.0}]})


def test_pile_head_that_yields():
    """Under P and a couple at the head w = (2 P beta + 2 M beta^2)/k, psi = -(2 P beta^2 + 4 M beta^3)/k (Hetenyi 1946)."""
    P = 10.0
    for limit, stiffness in ((1e9, 500.0), (3.0, 500.0), (0.0, 500.0)):
        free = 2 * P * BETA**2 / K
        moment = min(limit, stiffness * free / (1 + stiffness * 4 * BETA**3 / K))
        result = head_of(law=[[moment / stiffness, limit], [1.0, limit]]) if limit == 3.0 else (
            head_of(stiffness=stiffness, slack=0.0) if limit else head_of(slack=10.0))
        w = (2 * P * BETA - 2 * moment * BETA**2) / K
        assert result.at(0.0).deflection == pytest.approx(w, rel=1e-12)
        assert abs(result.at(0.0).moment) == pytest.approx(moment, rel=1e-12, abs=1e-12)


def test_slack_of_a_joint_on_ground():
    """A joint in a long beam on ground turns by M0 - freely up to its slack; beyond that the beam is one with a kink."""
    middle = 15.0 / BETA
    loads = [{"type": "force", "x": middle, "F": 10.0}]
    free = gapbeam.solve(LONG | {"beam": LONG["beam"] | {"hinges": [middle]}, "loads": loads})
    turn = free.at(middle - 1e-9).rotation - free.at(middle + 1e-9).rotation
    for share in (1.5, 0.5):
        result = gapbeam.solve(LONG | {"hinges": [{"x": middle, "slack": share * turn}], "loads": loads})
        # The kink of a hinge by its moment M is 2 M/(2 EI beta)... each half turns by 4 M beta^3/k
        moment = max(0.0, (1.0 - share) * turn / (8 * BETA**3 / K))
        assert result.at(middle).moment == pytest.approx(moment, rel=1e-7, abs=1e-9)
        assert result.steps[-1].state[-1] == ("open" if share > 1.0 else "branch 1")


def law_of(rng, moment, turn):
    """Keys of a rotation that is held: slack, one way, or by points, rigid at first or not."""
    kind = rng.random()
    if kind < 0.35:
        return {"stiffness": math.inf if rng.random() < 0.3 else digits(moment / turn * rng.uniform(0.1, 5.0)),
                "slack": digits(turn * rng.uniform(0.01, 1.0))}  # fmt: skip
    points, d, f = [], 0.0, 0.0
    for k in range(rng.randint(1, 3)):
        d += 0.0 if k == 0 and kind > 0.8 else turn * rng.uniform(0.1, 0.6)
        f += moment * rng.uniform(0.0 if k else 0.1, 0.6)
        points.append([digits(d), digits(f)])
    points.append([digits(points[-1][0] + turn), digits(points[-1][1] + moment * rng.choice((0.0, 0.0, 0.5)))])
    return {"law": points, "slack": rng.choice((0.0, 0.0, digits(turn * rng.uniform(0.0, 0.3))))}


def beam_of(seed, ground):
    """A beam with such restraints and hinges, and without them."""
    rng = random.Random(f"rotations {seed} {ground}")
    made = random_scene(seed, ground=ground, u=(1e-4, 1e2))
    for item in made.get("foundation", ()):
        item.pop("shear", None)
        item["side"] = rng.choice(("below", "both"))
    hinges, length = made["beam"].pop("hinges", []), nodes_of(made)[-1]
    size = max([abs(load.get("F", 0.0)) for load in made["loads"]] + [1e-9])
    stiff = max(made["beam"]["EI"]) if isinstance(made["beam"]["EI"], list) else made["beam"]["EI"]
    moment, turn = size * length / 20, size * length**2 / stiff / 20
    for support in made["supports"]:
        support.pop("rotation", None)
        alone = sum(place(made, other) == place(made, support) for other in made["supports"]) == 1
        if alone and place(made, support) not in hinges and rng.random() < 0.5:
            support["rotation"] = law_of(rng, moment, turn)
            if "law" not in support["rotation"] and rng.random() < 0.5:
                support["rotation"]["side"] = rng.choice(("clockwise", "counterclockwise"))
    for support in made["supports"]:
        if place(made, support) in hinges and "rotation" not in support and rng.random() < 0.7:  # on one side of a plain hinge
            hinges.remove(place(made, support))
            made["beam"].setdefault("hinges", []).append(place(made, support))
            support |= {"at_hinge": rng.choice(("left", "right")), "rotation": law_of(rng, moment, turn)}
    taken = {place(made, one) for one in made["supports"] if "rotation" in one}
    taken |= {load["x"] for load in made["loads"] if load["type"] == "moment"}
    hinges = [x for x in {*hinges, eighths(rng, 0.125, length - 0.125)} if x not in taken]
    made["hinges"] = [{"x": x, **law_of(rng, moment, turn)} for x in hinges]
    for hinge in made["hinges"]:
        if "law" not in hinge and rng.random() < 0.5:
            hinge["side"] = rng.choice(("sagging", "hogging"))
    return made


def force_by(keys, rotation):
    """Range of the couples that a law allows at a rotation, within roundings."""
    slack, sense = keys.get("slack", 0.0), {"counterclockwise": 1, "clockwise": -1, "sagging": 1, "hogging": -1}
    if "law" not in keys:
        sides = [sense[keys["side"]]] if "side" in keys else [1, -1]
        for side in sides:
            past = side * rotation - slack
            if past > -1e-12 * (slack + abs(rotation)):
                if math.isinf(keys["stiffness"]):
                    return (0.0, side * math.inf)
                return (side * max(past, 0.0) * keys["stiffness"],) * 2
        return (0.0, 0.0)
    way, past = math.copysign(1.0, rotation), max(abs(rotation) - slack, 0.0)
    points = [[0.0, 0.0], *keys["law"]]
    at = [f for d, f in points if abs(d - past) <= 1e-12 * (slack + abs(rotation))]
    if len(at) > 1:  # a rigid piece; without slack it is one at the middle
        return (way * min(at) if slack or min(at) else -way * max(at), way * max(at))
    if past > points[-1][0]:
        (a, f), (b, g) = points[-2:]
        return (way * (f + (g - f) * (past - a) / (b - a)),) * 2
    return (way * float(np.interp(past, *np.transpose(points))),) * 2


def with_couples(made, step):
    """The beam without what holds its rotations, and their couples as loads."""
    supports, loads = [dict(one) for one in made["supports"]], list(made["loads"])
    held = [one for one in supports if "rotation" in one]
    numbers = range(len(supports), len(supports) + len(held) + len(made["hinges"]))
    for one, k in zip([*held, *made["hinges"]], numbers, strict=True):
        couple = float(step.reaction[k])
        where = {key: one[key] for key in ("node", "x") if key in one}
        if one in made["hinges"]:
            for way, side in ((-1, "left"), (1, "right")):
                loads.append({"type": "moment", **where, "M": way * couple, "at_hinge": side})
        else:
            where |= {"at_hinge": one.pop("at_hinge")} if "at_hinge" in one else {}
            loads.append({"type": "moment", **where, "M": -couple})
            del one["rotation"]
    loads = [load | {"case": "dead"} for load in loads]
    beam = made["beam"] | {"hinges": [*made["beam"].get("hinges", []), *(hinge["x"] for hinge in made["hinges"])]}
    return {key: value for key, value in made.items() if key != "hinges"} | {"beam": beam, "supports": supports, "loads": loads}


@pytest.mark.parametrize("ground", [True, False])
@pytest.mark.parametrize("seed", range(12))
def test_random_beams_beside_many_digits(seed, ground):
    """What holds rotations is on its law, and the beam is that with its couples."""
    made = beam_of(seed, ground)
    result = gapbeam.solve(made)
    if result.status != "solved":
        return
    step = result.steps[-1]
    laws = [*(one["rotation"] for one in made["supports"] if "rotation" in one), *made["hinges"]]
    first = len(made["supports"])
    for k, keys in enumerate(laws, first):
        low, high = sorted(force_by(keys, float(step.deflection[k])))
        size = np.abs(step.reaction[first:]).max()
        assert low - 1e-11 * size <= step.reaction[k] <= high + 1e-11 * size, (k, keys)
    other = with_couples(made, step)
    try:
        exact = solve_on_ground(other)[0] if ground else solve(other)
    except Unsettled:
        pytest.skip("the other solution comes to no end")
    if exact.status != "solved":
        pytest.skip("couples alone do not hold it")
    x = np.linspace(0.0, sum(made["beam"]["spans"]), 15)
    found, truth = result.at(x), [exact.at(place) for place in x.tolist()]
    forces = max([0.0, *(abs(float(one)) for one in exact.reaction)])
    for quantity in ("deflection", "rotation", "moment", "shear"):
        expected = np.array([float(getattr(one, quantity)) for one in truth])
        size = max(np.abs(expected).max(), forces if quantity == "shear" else 1e-60)
        assert np.abs(getattr(found, quantity) - expected).max() <= 1e-8 * size, quantity
    assert np.abs(step.reaction[:first] - np.array(list(map(float, exact.reaction)))).max(initial=0.0) <= 1e-8 * forces


@pytest.mark.parametrize("seed", range(10))
def test_events_cases_and_combinations(seed):
    """Followed event by event the beam ends as by steps; cases and combinations are states; between events nothing changes."""
    made = beam_of(seed, ground=seed % 2 == 0)
    *loads, dead = made["loads"]
    made["loads"] = [*({key: value for key, value in load.items() if key != "case"} for load in loads), dead]
    try:
        steps, events = (gapbeam.solve(made | {"analysis": {"follow": follow}}) for follow in ("steps", "events"))
    except gapbeam.EngineError as error:
        pytest.skip(str(error))
    if steps.status != "solved":
        assert events.status in ("limit-load", "no-equilibrium")
        return
    size, ways = np.abs(steps.steps[-1].reaction).max(), np.abs(steps.steps[-1].deflection).max()
    assert steps.steps[-1].state == events.steps[-1].state
    assert np.abs(steps.steps[-1].reaction - events.steps[-1].reaction).max() <= 1e-12 * size
    assert np.abs(steps.steps[-1].deflection - events.steps[-1].deflection).max() <= 1e-12 * ways
    factors = sorted({0.0, 1.0, *(event.factor for event in events.events)})
    for low, high in pairwise(factors):
        if high - low > 1e-6:
            inside = {events.state(low + share * (high - low)).state for share in (0.1, 0.5, 0.9)}
            assert len(inside) == 1, (low, high)
    both = gapbeam.solve(made | {"combinations": [{"name": "half", "factors": {"dead": 1.0, "live": 0.5}}]}).combinations["half"]
    assert np.abs(both.steps[-1].reaction - events.state(0.5).reaction).max() <= 1e-12 * size
    factors = [0.5 if load.get("case") != "dead" else 1.0 for load in made["loads"]]
    cases = gapbeam.prepare(made).solve(np.array([factors, [1.0] * len(factors)]))
    assert np.abs(cases.reaction[0] - both.steps[-1].reaction).max() <= 1e-12 * size
    assert np.abs(cases.reaction[1] - steps.steps[-1].reaction).max() <= 1e-12 * size


@pytest.mark.parametrize("ground", [False, True])
def test_under_trains(ground):
    """A rail with loose joints and an abutment that yields: a state under axles is that of the scene with them as forces."""
    scene = {
        "beam": {"spans": [4.0, 4.0, 4.0], "EI": 1000.0},
        "supports": [{"node": 0, "rotation": {"law": [[0.004, 6.0], [0.1, 6.0]]}}, {"node": 1, "side": "below"}, {"node": 2},
                     {"node": 3, "side": "below"}],
        "hinges": [{"x": 5.0, "slack": 0.002}], "loads": [{"type": "uniform", "q": 2.0, "case": "dead"}],
        "trains": [{"axles": [[0.0, 20.0], [1.5, 20.0]]}],
    }  # fmt: skip
    if ground:
        scene["foundation"] = [{"k": 300.0, "from": 8.0}]
    result = assert_as_forces(scene, gapbeam.solve, np.linspace(0.1, 11.9, 12), np.linspace(0.5, 11.5, 12))
    events = {(event.support, event.event) for one in result.trains["train 1"].traversals for event in one.events}
    assert {number for number, _ in events} >= {4, 5}  # the restraint yields, the joint closes


def test_modes_with_a_joint_that_is_loose_and_one_that_is_not():
    """What does not act is a hinge, what does holds as its spring."""
    scene = {"beam": {"spans": [2.0, 2.0], "EI": 10.0, "mass": 1.0}, "supports": [{"node": 0, "rotation": "fixed"}, {"node": 2}],
             "loads": [{"type": "uniform", "q": 1.0}], "analysis": {"frequencies": 3}}  # fmt: skip
    loose, tight = (gapbeam.solve(scene | {"hinges": [{"x": 2.0, "stiffness": 4.0, "slack": slack}]}) for slack in (9.0, 1e-9))
    assert [one.steps[-1].state[-1] for one in (loose, tight)] == ["open", "branch 1"]
    hinged = gapbeam.solve(scene | {"beam": scene["beam"] | {"hinges": [2.0]}})
    elastic = gapbeam.solve(scene | {"hinges": [{"x": 2.0, "stiffness": 4.0}]})
    assert loose.frequencies == pytest.approx(hinged.frequencies, rel=1e-13)
    assert tight.frequencies == pytest.approx(elastic.frequencies, rel=1e-13)
    assert loose.mode("vibration").amplitude < math.inf


@pytest.mark.parametrize(("force", "factor"), [(20.0, None), (40.0, 0.6497548783981961)])
def test_what_yields_with_the_ground(force, factor):
    """Tie and ground yield: the beam turns about c when 5 + 10 c - 10 (4 - c) = F, F/2 = 10 c^2 - 80, so c = (1 + sqrt 26)/2."""
    c = (1 + math.sqrt(26)) / 2
    scene = {"beam": {"spans": [4.0], "EI": 1e3}, "foundation": [{"law": [[0.01, 10.0], [1.0, 10.0]], "side": "both"}],
             "supports": [{"x": 0.0, "law": [[0.01, 5.0], [1.0, 5.0]], "side": "both"}],
             "loads": [{"type": "force", "x": 0.5, "F": force}], "analysis": {"follow": "events"}}  # fmt: skip
    result = gapbeam.solve(scene)
    if factor is None:
        assert (result.status, result.steps[-1].reaction[0]) == ("solved", 5.0)
    else:
        assert (result.status, result.limits[0].kind) == ("limit-load", "mechanism")
        assert result.limits[0].factor * force == pytest.approx(20.0 * c - 35.0, rel=1e-12)


TURNING = [((0.0, 2.0, 3.0), "below", 122.5), ((0.0, 3.0, 4.0), "below", 107.5), ((0.0, 3.0, 4.0), "both", 60.0 + 20.0 * 6**0.5)]


@pytest.mark.parametrize(("ties", "side", "limit"), TURNING)
def test_a_soft_beam_turns_about_a_tie(ties, side, limit):
    """F (c - 1) = 50 c + 50 |c - 2| or 3 + 20 (4 - c) + 5 c^2, its least at c = 3; and + 5 (4 - c)^2 at c = 1 + sqrt 6."""
    sizes = {0.0: 50.0, 2.0: 50.0, 3.0: 50.0, 4.0: 20.0}
    supports = [{"x": x, "law": [[0.27, sizes[x]], [27.0, sizes[x]]], "side": "both"} for x in ties]
    scene = {"beam": {"spans": [4.0], "EI": 1.5}, "supports": supports, "loads": [{"type": "force", "x": 1.0, "F": 1000.0}],
             "foundation": [{"law": [[2e-4, 10.0], [0.01, 10.0]], "side": side}], "analysis": {"follow": "events"}}  # fmt: skip
    assert gapbeam.solve(scene).limits[0].factor * 1000.0 == pytest.approx(limit, rel=1e-12)


AROUND = [{"foundation": [{"k": 1000.0, "side": "both"}]}, {"foundation": [{"k": 10.0, "from": 2.5}]}, {"beam": {"N": 30.0}}]


@pytest.mark.parametrize("around", AROUND)
@pytest.mark.parametrize("side", ["left", "right"])
def test_one_side_of_a_hinge(side, around):
    """A restraint on one side of a hinge, rigid or elastic, is the couple that it gives."""
    scene = around | {"loads": [{"type": "uniform", "q": 5.0}, {"type": "force", "x": 0.3, "F": 20.0}], "hinges": [],
                      "beam": {"spans": [2.0, 2.0], "EI": 100.0, "hinges": [1.0], **around.get("beam", {})}}  # fmt: skip
    for stiffness in (math.inf, 50.0):
        held = {"x": 1.0, "stiffness": 0.0, "rotation": {"stiffness": stiffness, "slack": 0.0}, "at_hinge": side}
        made = scene | {"supports": [{"node": 0}, {"node": 1}, {"node": 2}, held]}
        result = gapbeam.solve(made)
        other, x = gapbeam.solve(with_couples(made, result.steps[-1])), np.linspace(0.0, 4.0, 17)
        assert abs(result.steps[-1].reaction[-1]) > 0.05
        for quantity in ("deflection", "rotation", "moment", "shear"):
            expected = getattr(other.at(x), quantity)
            assert np.abs(getattr(result.at(x), quantity) - expected).max() <= 1e-11 * np.abs(expected).max(), quantity


def test_refused_on_rigid_ground():
    scene = {"beam": {"spans": [4.0], "EI": 1.0}, "foundation": [{"k": math.inf, "side": "below"}],
             "loads": [{"type": "uniform", "q": 1.0}], "hinges": [{"x": 2.0, "slack": 0.1}]}  # fmt: skip
    with pytest.raises(gapbeam.SceneError, match="not available over rigid ground; give the ground a stiffness"):
        gapbeam.solve(scene)


@pytest.mark.parametrize("M", [-1.0, -4.0, -5.0, -5.1])
@pytest.mark.parametrize("side", ["sagging", "hogging"])
def test_a_part_without_load_beyond_a_joint_that_holds_one_way_is_free(M, side):
    """Rounding of the couples far from the joint says nothing of its state: it carries nothing in either."""
    made = {
        "beam": {"spans": [3.0, 6.0], "EI": 10000.0}, "sections": [{"to": 1.5, "EI": 20000.0}],
        "hinges": [{"x": 6.3, "stiffness": 1000.0, "side": side}], "foundation": [{"to": 4.5, "k": 50.0}],
        "supports": [{"node": 1, "rotation": 10000.0}, {"x": 1.5, "stiffness": 1000.0, "rotation": 1000.0}],
        "loads": [{"type": "moment", "x": 0.3, "M": M}, {"type": "moment", "x": 3.0, "M": 10.0, "case": "dead"}],
    }  # fmt: skip
    both = gapbeam.solve({**made, "hinges": []})
    for follow in ("steps", "events"):
        result = gapbeam.solve({**made, "analysis": {"follow": follow}})
        assert result.status == "solved"
        assert result.steps[-1].indifferent
        assert result.steps[-1].reaction[:2] == pytest.approx(both.steps[-1].reaction, rel=1e-13)
        assert abs(result.steps[-1].reaction[2]) < 1e-25
