"""Restraints and hinges with laws, slack and sides: closed forms, and random beams beside rational numbers."""

import random
from fractions import Fraction

import gapbeam
import numpy as np
import pytest
from oracle.rotation_laws import pieces, solve

YIELDS = {"law": [[0.0, 1.0], [1.0, 1.0]]}
CLAMPED = {
    "beam": {"spans": [1.0], "EI": 1.0},
    "supports": [{"node": 0, "rotation": YIELDS}, {"node": 1, "rotation": YIELDS}],
    "hinges": [{"x": 0.5, **YIELDS}],
    "loads": [{"type": "uniform", "q": 1.0}],
    "analysis": {"follow": "events", "history": [20.0]},
}
"""A clamped beam of which every section yields at 1."""


def test_first_yield_and_mechanism():
    result = gapbeam.solve(CLAMPED)
    assert result.status == "limit-load"
    assert [(event.factor, event.support, event.event) for event in result.events] == [(12.0, 2, "yields"), (12.0, 3, "yields")]
    assert [(limit.kind, limit.factor) for limit in result.limits] == [("mechanism", 16.0)]
    assert [list(point) for point in result.motion] == [[0.0, 0.0], [0.5, 1.0], [1.0, 0.0]]
    assert result.at(0.5, factor=14.0).moment == pytest.approx(14.0 / 8.0 - 1.0, abs=1e-14)


def test_elastic_until_the_first_yield():
    """A law of one piece is a stiffness: M = (q L^2/12)/(1 + 2 EI/(c L))."""
    stiffness = 3.0
    scene = {"beam": {"spans": [2.0], "EI": 5.0}, "loads": [{"type": "uniform", "q": 1.0}],
             "supports": [{"node": k, "rotation": {"law": [[1.0, stiffness]]}} for k in (0, 1)]}  # fmt: skip
    step = gapbeam.solve(scene).steps[-1]
    moment = 4.0 / 12.0 / (1.0 + 2.0 * 5.0 / (stiffness * 2.0))
    assert step.reaction[2:].tolist() == pytest.approx([moment, -moment], rel=1e-15)
    assert step.couple.tolist() == pytest.approx([-moment, moment, 0.0, 0.0], rel=1e-15)
    scene["supports"] = [{"node": k, "rotation": stiffness} for k in (0, 1)]
    assert gapbeam.solve(scene).steps[-1].couple.tolist() == pytest.approx([-moment, moment], rel=1e-15)


@pytest.mark.parametrize(("q", "state", "moment"), [(1.0, "open", 0.0), (8.0, "branch 1", (3.0 - 1.5 * 0.125) / 2.0 - 1.0)])
def test_slack_hinge(q, state, moment):
    """A propped cantilever with a hinge at its middle; past the slack it is one with a kink: R = 3 q L/8 - 3 EI kink/(2 L^2)."""
    scene = {"beam": {"spans": [1.0], "EI": 1.0}, "supports": [{"node": 0}, {"node": 1, "rotation": "fixed"}],
             "hinges": [{"x": 0.5, "slack": 0.125}], "loads": [{"type": "uniform", "q": q}]}  # fmt: skip
    result = gapbeam.solve(scene)
    assert result.steps[-1].state[2] == state
    assert result.steps[-1].reaction[2] == pytest.approx(moment, abs=1e-15)
    assert result.at(0.5).moment == pytest.approx(moment, abs=1e-15)
    if state == "open":  # a cantilever of 1/2 that carries half of the other part at its tip
        assert result.at(0.5).deflection == pytest.approx(1 / 128 + 1 / 96, rel=1e-14)
        assert result.steps[-1].opening[2] == pytest.approx(0.125 - result.steps[-1].deflection[2], rel=1e-14)


@pytest.mark.parametrize(("q", "couple", "rotation"), [(8.0, 1.0, 0.0), (-8.0, 0.0, -8.0 / 24.0)])
def test_a_foot_that_tips(q, couple, rotation):
    scene = {"beam": {"spans": [1.0], "EI": 1.0}, "loads": [{"type": "uniform", "q": q}],
             "supports": [{"node": 0, "rotation": {"side": "counterclockwise"}}, {"node": 1}]}  # fmt: skip
    step = gapbeam.solve(scene).steps[-1]
    assert step.reaction[2] == pytest.approx(couple, abs=1e-15)
    assert step.deflection[2] == pytest.approx(rotation, abs=1e-15)
    assert step.state[2] == ("closed" if couple else "open")


def test_a_dry_joint_takes_hogging_moments_only():
    """Over a middle support it holds; in a field it is a hinge."""
    scene = {"beam": {"spans": [1.0, 1.0], "EI": 1.0}, "supports": [{"node": k} for k in range(3)],
             "loads": [{"type": "uniform", "q": 8.0}], "hinges": [{"node": 1, "side": "hogging"}]}  # fmt: skip
    assert gapbeam.solve(scene).steps[-1].reaction[3] == pytest.approx(-1.0, rel=1e-14)
    scene["loads"][0]["q"] = -8.0
    step = gapbeam.solve(scene).steps[-1]
    assert step.state[3] == "open"
    assert step.reaction.tolist() == [-4.0, -8.0, -4.0, 0.0]


def test_imposed_rotation_moves_the_law():
    """A movement of a restraint with a law is its settlement, dead or live."""
    law = {"law": [[0.25, 1.0], [1.0, 1.5]]}
    base = {"beam": {"spans": [2.0], "EI": 1.0}, "loads": [{"type": "uniform", "q": 1.0}]}
    restraint = {"node": 0, "direction": "rotational", **law}
    turned = gapbeam.solve({**base, "supports": [{"node": 0}, {"node": 1}, {**restraint, "settlement": 0.125}]})
    for case in ("live", "dead"):
        load = {"type": "movement", "support": 0, "rotation": 0.125, "case": case}
        result = gapbeam.solve({**base, "supports": [{"node": 0, "rotation": law}, {"node": 1}], "loads": [*base["loads"], load]})
        assert result.steps[-1].reaction.tolist() == pytest.approx(turned.steps[-1].reaction.tolist(), rel=1e-14)


def test_couple_beside_a_hinge_with_a_law():
    base = {"beam": {"spans": [2.0], "EI": 1.0}, "supports": [{"node": 0}, {"node": 1, "rotation": "fixed"}],
            "hinges": [{"x": 1.0, "law": [[0.125, 0.25], [1.0, 0.5]]}]}  # fmt: skip
    at = gapbeam.solve({**base, "loads": [{"type": "moment", "x": 1.0, "M": 1.0, "at_hinge": "left"}]}).steps[-1]
    aside = gapbeam.solve({**base, "loads": [{"type": "moment", "x": 1.0 - 1e-9, "M": 1.0}]}).steps[-1]
    assert at.reaction.tolist() == pytest.approx(aside.reaction.tolist(), abs=1e-8)


def law_of(rng):
    """A law that rises or stays, rigid at first or not, as points."""
    rigid, points, d, f = rng.random() < 0.4, [], Fraction(0), Fraction(0)
    for k in range(rng.randint(1, 3)):
        d += 0 if rigid and k == 0 else Fraction(rng.randint(1, 4), 16)
        f += Fraction(rng.randint(1 if k == 0 else 0, 4), 8)
        points.append((d, f))
    return [*points, (points[-1][0] + 1, points[-1][1] + Fraction(rng.randint(0, 4), 8))]


def held(rng, sides):
    """A rotation that is held: keys of a scene, and pieces."""
    gap, kind = Fraction(rng.choice([0, 0, 1, 2]), 16), rng.random()
    if kind < 0.3:
        way, stiffness = rng.choice([1, -1]), rng.choice([None, 2, 8])
        keys = {"side": sides[way], "slack": float(gap), "stiffness": float("inf") if stiffness is None else float(stiffness)}
        return keys, pieces(way, stiffness, gap)
    if kind < 0.5:
        stiffness = rng.choice([None, 2, 8])
        keys = {"slack": float(gap + Fraction(1, 16)), "stiffness": float("inf") if stiffness is None else float(stiffness)}
        return keys, pieces(0, None, gap + Fraction(1, 16), [(0, 1)] if stiffness is None else [(1, stiffness)])
    points = law_of(rng)
    return {"slack": float(gap), "law": [[float(d), float(f)] for d, f in points]}, pieces(0, None, gap, points)


def beam_of(seed):
    """A random beam: a scene, and the same for the oracle."""
    rng = random.Random(seed)
    spans = [Fraction(rng.randint(2, 4), 2) for _ in range(rng.randint(1, 2))]
    ends = [sum(spans[:k], Fraction(0)) for k in range(len(spans) + 1)]
    supports, laws, turned = [], [], []
    for k, x in enumerate(ends):
        side = rng.choice([0, 1]) if 0 < k < len(spans) else rng.choice([0, 0, 1])
        stiffness, gap = rng.choice([None, None, 16]), Fraction(rng.choice([0, 1]), 32) if side else 0
        supports.append({"x": float(x), "side": "below" if side else "both", "gap": float(gap),
                         "stiffness": float("inf") if stiffness is None else float(stiffness)})  # fmt: skip
        laws.append((x, "w", pieces(side, stiffness, gap)))
        if rng.random() < 0.5:
            keys, law = held(rng, {1: "counterclockwise", -1: "clockwise"})
            supports[-1]["rotation"] = keys
            turned.append((x, "turn", law))
    hinges, joints = [], []
    for x in rng.sample([Fraction(k, 4) for k in (1, 2, 3, 5)], rng.randint(0 if turned else 1, 1)):
        if x < ends[-1] and x not in ends:
            keys, law = held(rng, {1: "sagging", -1: "hogging"})
            hinges.append({"x": float(x), **keys})
            joints.append((x, "hinge", law))
    q, force = Fraction(rng.randint(-1, 2)), (spans[0] * Fraction(2, 5), Fraction(rng.choice([-2, 1, 3])))
    loads = [{"type": "uniform", "q": float(q)}, {"type": "force", "x": float(force[0]), "F": float(force[1])}]
    scene = {"beam": {"spans": list(map(float, spans)), "EI": 0.5}, "supports": supports, "hinges": hinges, "loads": loads}
    # Places are those of the doubles
    return scene, (spans, Fraction(1, 2), [*laws, *turned, *joints], q, [(Fraction(loads[1]["x"]), force[1])])


def last_step(scene, follow, exact):
    """The beam under full load; None where it does not stand, as the exact numbers say too."""
    try:
        result = gapbeam.solve(scene | {"analysis": {"follow": follow}})
    except gapbeam.EngineError:
        assert exact is None or not any(exact[0])  # a part of it is free
        return None
    if result.status != "solved":
        assert exact is None
        return None
    return result.steps[-1]


def assert_close(step, forces, ways):
    assert np.abs(step.reaction - forces).max() <= 1e-13 * max(1.0, np.abs(forces).max())
    if not step.indifferent:
        assert np.abs(step.deflection - ways).max() <= 1e-13 * max(1.0, np.abs(ways).max())


@pytest.mark.parametrize("follow", ["steps", "events"])
@pytest.mark.parametrize("seed", range(40))
def test_random_beams_beside_rationals(seed, follow):
    scene, about = beam_of(seed)
    exact = solve(*about)
    step = last_step(scene, follow, exact)
    if step is None:
        return
    assert exact is not None
    forces, ways = (np.array(list(map(float, values))) for values in exact)
    assert_close(step, forces, ways)
    bounds = step.error_bounds
    assert bounds["moment"] < 1e-11


@pytest.mark.parametrize("seed", range(0, 40, 4))
def test_units_far_from_one(seed):
    """Lengths, forces and angles scaled by powers of two: the same digits."""
    scene, _ = beam_of(seed)
    try:
        result = gapbeam.solve(scene)
    except gapbeam.EngineError:
        return
    if result.status != "solved":
        return
    length, force, way = 2.0**70, 2.0**-30, 2.0**40
    angle = way / length
    scene["beam"] = {"spans": [length * one for one in scene["beam"]["spans"]], "EI": scene["beam"]["EI"] * force * length**3 / way}
    for one in scene["supports"]:
        one.update(x=one["x"] * length, gap=one["gap"] * way, stiffness=one["stiffness"] * force / way)
    for one in [*scene["hinges"], *(one["rotation"] for one in scene["supports"] if "rotation" in one)]:
        one["slack"] *= angle
        if "stiffness" in one:
            one["stiffness"] *= force * length / angle
        if "law" in one:
            one["law"] = [[d * angle, f * force * length] for d, f in one["law"]]
    for one in scene["hinges"]:
        one["x"] *= length
    scene["loads"][0]["q"] *= force / length
    scene["loads"][1].update(x=scene["loads"][1]["x"] * length, F=scene["loads"][1]["F"] * force)
    other, step = gapbeam.solve(scene).steps[-1], result.steps[-1]
    turning = np.array([one.direction != "normal" for one in result.scene.supports])
    assert other.state == step.state
    scaled = other.reaction / np.where(turning, force * length, force)
    assert np.abs(scaled - step.reaction).max() <= 1e-13 * max(1.0, np.abs(step.reaction).max())


def test_combinations_and_cases_are_states():
    scene = {**CLAMPED, "loads": [{"type": "uniform", "q": 13.0}, {"type": "force", "x": 0.25, "F": 1.0, "case": "wind"}]}
    scene["supports"] = [{"node": 0, "rotation": {"slack": 0.01}}, {"node": 1, "rotation": {"side": "clockwise"}}]
    scene["hinges"] = [{"x": 0.5, "slack": 0.05, "stiffness": 4.0}]
    del scene["analysis"]
    factors = [(1.0, 1.0), (0.5, -1.0), (0.0, 1.0), (-1.0, 0.0)]
    names = ["a", "b", "c", "d"]
    combined = [{"name": name, "factors": {"live": a, "wind": b}} for name, (a, b) in zip(names, factors, strict=True)]
    result = gapbeam.solve({**scene, "combinations": combined})
    many = gapbeam.prepare(scene).solve(factors)
    for k, (name, (a, b)) in enumerate(zip(names, factors, strict=True)):
        loads = [{**scene["loads"][0], "q": 13.0 * a}, {**scene["loads"][1], "F": b}]
        step = gapbeam.solve({**scene, "loads": loads}).steps[-1]
        for other in (result.combinations[name].steps[-1].reaction, many.reaction[k]):
            assert other.tolist() == pytest.approx(step.reaction.tolist(), abs=1e-13)


def test_names_report_and_file():
    scene = {**CLAMPED, "supports": [{"node": 0, "name": "A", "rotation": YIELDS}, {"node": 1, "rotation": YIELDS}]}
    result = gapbeam.solve({**scene, "analysis": {"follow": "events", "history": [13.0]}})
    assert [support.name for support in result.scene.supports[2:]] == ["rotation of A", "rotation of 1", "hinge 0"]
    text = str(result)
    assert "rotation of A (x = 0) yields (1)" in text
    assert "Largest reaction    6.5 at support A" in text
    data = result.to_dict()
    assert [one["direction"] for one in data["steps"][-1]["supports"]] == ["normal", "normal", "rotational", "rotational", "hinge"]
    again = gapbeam.solve(result.scene)
    assert again.steps[-1] == result.steps[-1]
