"""Movements of supports that grow with the load factor, beside settlements in rational numbers."""

import pickle
import random
from fractions import Fraction
from itertools import pairwise

import gapbeam
import numpy as np
import oracle
import pytest
from scenes import at, force, random_scene, scene, uniform

EVENTS = {"follow": "events"}


def movement(support, value, **keys):
    return {"type": "movement", "support": support, "value": value, **keys}


def settled(made, factor):
    """The same scene with settlements instead, at a load factor."""
    supports = [dict(one) for one in made["supports"]]
    for load in made["loads"]:
        if load["type"] == "movement":
            share = 1 if load.get("case") == "dead" else Fraction(factor)
            before = Fraction(supports[load["support"]].get("settlement", 0.0))
            supports[load["support"]]["settlement"] = before + share * Fraction(load["value"])
    return {**made, "supports": supports, "loads": [load for load in made["loads"] if load["type"] != "movement"]}


def follow(made):
    """Solve from event to event."""
    return gapbeam.solve({**made, "analysis": EVENTS})


def compare(result, made, factor):
    """Supports and fields of a state beside the rational solution with settlements."""
    exact = oracle.solve(settled(made, factor), factor)
    state = result.state(factor)
    size = max(map(abs, exact.reaction)) + 1e-300
    far = max(map(abs, exact.deflection)) + 1e-300
    assert tuple(state.state) in exact.valid_states() or any(abs(one) < 1e-12 * size for one in exact.reaction), factor
    assert np.array(state.reaction) == pytest.approx(np.array(exact.reaction, dtype=float), abs=float(1e-12 * size)), factor
    assert np.array(state.deflection) == pytest.approx(np.array(exact.deflection, dtype=float), abs=float(1e-11 * far)), factor
    assert np.array(state.opening) == pytest.approx(np.array(exact.opening, dtype=float), abs=float(1e-11 * far)), factor


def test_a_jack_lifts_a_beam_off_its_neighbours():
    """Four spans L under q, the middle support jacked up by d: its neighbours carry 8/7 q L - 66/7 EI d/L^3 (three moments), so
    they let go at d = 4/33 q L^4/EI."""
    q, span, EI = 10.0, 4.0, 2000.0
    supports = [at(k, side="below") for k in range(5)]
    supports[2]["name"] = "jack"
    made = scene([span] * 4, supports, [uniform(q, case="dead"), movement("jack", -0.5)], EI=EI)
    result = follow(made)
    lift = 4.0 / 33.0 * q * span**4 / EI
    assert [(one.support, one.event) for one in result.events] == [(1, "opens"), (3, "opens")]
    assert [one.factor for one in result.events] == pytest.approx([lift / 0.5] * 2, rel=1e-14)
    assert result.state(0.2).reaction[1] == pytest.approx(8 / 7 * q * span - 66 / 7 * EI * 0.1 / span**3, rel=1e-13)
    # From there on two spans of 2 L carry
    assert result.state(1.0).reaction[0] == pytest.approx(0.375 * q * 2 * span - 3.0 * EI * 0.5 / (2 * span) ** 3, rel=1e-13)
    assert "-0.5" in str(result.to_dict()["steps"][-1]["supports"][2]["deflection"])


def test_back_and_forth():
    """A history over lifts: what lets go comes back at the same lift."""
    made = scene([4.0] * 4, [at(k, side="below") for k in range(5)], [uniform(10.0, case="dead"), movement(2, -0.5)], EI=2000.0)
    result = gapbeam.solve({**made, "analysis": EVENTS | {"history": [1.0, 0.0, -1.0]}})
    first = [one for one in result.events if one.support == 1][:2]
    assert [one.event for one in first] == ["opens", "closes"]
    assert [one.factor for one in first] == pytest.approx([256 / 825] * 2, rel=1e-14)


def test_a_plastic_support_keeps_a_set():
    """Under P a beam of flexibility f = L^3/48 EI yields on its middle support (10 < P k/(1 + k f)), which is jacked up by d, then
    let down: R (1 + k f) = k (d (1 - s) + 10 (1 + k f)/k) where s is the part let down, so it opens at d s = 10 (1 + k f)/k."""
    law = {"type": "plastic", "stiffness": 1e3, "limit": 10.0}
    supports = [at(0), at(1, side="below", law=law, unloading="plastic"), at(2)]
    made = scene([2.0, 2.0], supports, [force(2.0, 30.0, case="dead"), movement(1, -0.1)], EI=1000.0)
    result = gapbeam.solve({**made, "analysis": EVENTS | {"history": [1.0, 0.0]}})
    softness = 1e-3 * (1.0 + 1e3 * 4.0**3 / 48e3)
    assert [(one.event, one.factor) for one in result.events] == [
        ("unloads", 1.0), ("opens", pytest.approx(1.0 - 10.0 * softness / 0.1, rel=1e-14)),
    ]  # fmt: skip
    half = 1.0 - 5.0 * softness / 0.1
    assert result.state(half).reaction[1] == pytest.approx(5.0, rel=1e-13)
    assert result.state(0.0).deflection[1] == pytest.approx(0.04, rel=1e-13)


def test_a_movement_that_comes_back_leaves_a_beam_without_load():
    """Where the support that moved lets go all deflections are 0, and rounding of the load factor is all there is."""
    yields = {"law": [[0.004, 8.0], [0.008, 12.0], [0.016, 14.4]], "unloading": "plastic"}
    comes = at(2, side="above", law=[[0.02, 10.0], [0.06, 10.0]], gap=0.002)
    made = scene([5.0, 4.0], [at(1), comes, {"x": 2.5, **yields}], [movement(1, 0.01)], EI=5e3)
    result = gapbeam.solve({**made, "analysis": {**EVENTS, "history": [1.0, 0.0, 1.5, -0.5]}})
    assert [event.event for event in result.events] == ["closes", "opens"] * 2
    assert result.loop(2).energy == pytest.approx(0.0, abs=1e-12)
    for segment in result.segments[2::2]:
        assert np.abs(result.path.along(segment)[-1].reaction).max() < 1e-12


def test_dead_movements_are_settlements():
    made = scene([4.0, 5.0], [at(0), at(1), at(2)], [uniform(3.0), movement(1, 0.01, case="dead")], EI=500.0)
    other = scene([4.0, 5.0], [at(0), at(1, settlement=0.01), at(2)], [uniform(3.0)], EI=500.0)
    assert (gapbeam.solve(made).state(1.0).reaction == gapbeam.solve(other).state(1.0).reaction).all()


def test_supports_that_meet_are_named():
    """A support raised by 0.05 comes to one 0.02 above it at a factor of 0.4; what stops there is no free motion."""
    supports = [at(0), at(1, side="below", gap=0.01), at(1, side="above", gap=0.01), at(2)]
    made = scene([4.0, 4.0], supports, [uniform(10.0, case="dead"), movement(1, -0.05)], EI=2000.0)
    result = gapbeam.solve(made)
    assert result.status == "limit-load"
    assert result.limits[0].factor == pytest.approx(0.4, rel=1e-14)
    assert result.reason.endswith("supports that loads move may leave no room between them there")
    assert str(result).splitlines()[1].startswith("Limit of movements at load factor 0.4")


@pytest.mark.parametrize("moved", [2, 3])
def test_what_moves_comes_to_what_is_pressed_already(moved):
    """Whichever of the two the scene names first."""
    pair = [at(2, side="above", gap=0.002), at(2, side="below")]
    loads = [force(9.0, -500.0, case="dead"), movement(moved, -0.0035)]
    made = scene([6.0, 3.0], [at(0), at(1), *(pair if moved == 3 else pair[::-1])], loads, EI=1e4)
    result = gapbeam.solve(made)
    assert result.status == "limit-load"
    assert result.limits[0].factor == pytest.approx(4.0 / 7.0, rel=1e-14)


def test_combinations():
    """Factors of cases multiply movements, those of dead too."""
    loads = [uniform(3.0, case="live"), movement(1, 0.01, case="dead"), movement(2, -0.004, case="heat")]
    made = scene([4.0, 5.0], [at(0, side="below"), at(1, side="below"), at(2, side="below")], loads, EI=500.0)
    factors = [{"dead": 1.35, "live": 1.5}, {"dead": 1.0, "heat": 2.0}, {"live": 1.0, "heat": -1.0}]
    made["combinations"] = [{"name": f"c{k}", "factors": one} for k, one in enumerate(factors)]
    result = gapbeam.solve(made)
    for k, one in enumerate(factors):
        moved = 0.01 * one.get("dead", 0.0), -0.004 * one.get("heat", 0.0)
        supports = [at(0, side="below"), at(1, side="below", settlement=moved[0]), at(2, side="below", settlement=moved[1])]
        other = gapbeam.solve(scene([4.0, 5.0], supports, [uniform(3.0 * one.get("live", 0.0))], EI=500.0))
        assert result.combinations[k].status == other.status
        if other.status == "solved":
            found, right = result.combinations[k].steps[-1].reaction, other.steps[-1].reaction
            assert found == pytest.approx(right, abs=1e-12 * max(map(abs, right), default=1.0))


@pytest.mark.parametrize("block", range(6))
def test_random_scenes(block):
    """At factors between events, and on steps, everything is as with settlements."""
    rng = random.Random(block)
    compared = 0
    for _ in range(20):
        made = random_scene(rng, held=True)
        made.pop("analysis", None)
        across = [k for k, one in enumerate(made["supports"]) if one.get("direction", "normal") == "normal"]
        for k in rng.sample(across, min(len(across), rng.randint(1, 3))):
            case = rng.choice(({}, {}, {"case": "dead"}))
            made["loads"].append(movement(k, rng.randint(-64, 64) / 1024.0, **case))
        try:
            result = follow(made)
        except gapbeam.SceneError:  # a dead movement may take the room between two supports
            continue
        if result.status != "solved":
            continue
        places = [0.0, *sorted({one.factor for one in result.events}), 1.0]
        for a, b in pairwise(places):
            if b - a > 1e-6:
                compare(result, made, round((a + b) / 2 * 2**20) / 2**20)
                compared += 1
        steps = gapbeam.solve({**made, "analysis": {"steps": 4}})
        for one in steps.steps:
            compare(steps, made, one.factor)
    assert compared > 12


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"support": 7}, "there is no support 7"),
        ({"value": float("inf")}, "expected a finite number"),
    ],
)
def test_refusals(change, message):
    supports = [at(0, direction="axial"), at(0), at(1)]
    with pytest.raises(gapbeam.SceneError, match=message):
        gapbeam.solve(scene([4.0], supports, [movement(1, 0.1) | change]))


def test_beside_a_foundation_and_on_curves_they_are_refused():
    axial = at(0, direction="axial")
    ground = scene([4.0], [at(0), at(1), axial], [movement(2, 0.1)], EA=1.0) | {"foundation": [{"k": 100.0}]}
    curve = scene([4.0], [at(0), at(1, law={"type": "tanh", "stiffness": 1.0, "limit": 1.0})], [movement(1, 0.1)])
    for made, message in ((ground, "beside a foundation an axial support"), (curve, "its law is a curve")):
        with pytest.raises(gapbeam.SceneError, match=message):
            gapbeam.solve(made)


def test_axial_supports_beside_a_curve_are_not_moved():
    """It ended the process."""
    law = {"type": "tanh", "stiffness": 3e3, "limit": 30.0}
    scene = {
        "beam": {"spans": [4.0, 3.0], "EI": 1e4, "EA": 1e5}, "analysis": {"first_order": True},
        "supports": [{"node": 0}, {"node": 2, "law": law}, {"node": 0, "direction": "axial"}, {"node": 2, "direction": "axial"}],
        "loads": [{"type": "movement", "support": 3, "value": 0.01}, {"type": "uniform", "q": 2.0}],
    }  # fmt: skip
    with pytest.raises(gapbeam.SceneError, match=r"supports\[3\]\.direction: a load that moves an axial support beside a support"):
        gapbeam.solve(scene)


def free_at_first(**analysis):
    """Two bodies, of which the support in the middle holds one; the other has no load, and is free to turn."""
    supports = [at(0, stiffness=1e3, settlement=-0.001), at(1, side="below", stiffness=1e5)]
    loads = [force(2.5, 5.0), movement(1, -0.003)]
    return scene([3.0, 5.0], supports, loads, EI=2e4, hinges=[6.0]) | {"analysis": analysis}


@pytest.mark.parametrize("steps", [1, 3])
def test_where_no_path_begins_every_step_is_that_with_settlements(steps):
    """As in prepared cases and combinations, where supports have moved, on whatever path."""
    made = free_at_first(steps=steps)
    result = gapbeam.solve(made)
    assert result.steps[-1].indifferent
    assert len(result.steps) == steps
    for step in result.steps:
        right = gapbeam.solve(settled(free_at_first(), step.factor) | {"loads": [force(2.5, 5.0 * step.factor)]})
        assert step.reaction == pytest.approx(right.steps[-1].reaction, rel=1e-12)
        assert result.state(step.factor).reaction == pytest.approx(step.reaction, rel=1e-12)
    assert gapbeam.prepare(made).solve([1.0, 1.0]).reaction == pytest.approx(result.steps[-1].reaction, rel=1e-12)
    assert "free to move" in result.report()
    assert pickle.loads(pickle.dumps(result)).steps[0].reaction == pytest.approx(result.steps[0].reaction)


def test_axial_supports_move_where_no_path_begins():
    """As a settlement does, and the beam bends under what that presses."""
    supports = [at(0), at(1), at(3, side="below"), at(0, direction="axial"), at(3, direction="axial")]
    made = scene([3.0, 2.0, 2.0], supports, [force(5.0, 5.0), movement(4, 0.0004)], EA=1e5, hinges=[1.0])
    result = gapbeam.solve(made)
    assert result.steps[-1].reaction[3:] == pytest.approx([-40.0 / 7, 40.0 / 7], rel=1e-14)
    settled = gapbeam.solve(scene([3.0, 2.0, 2.0], [*supports[:-1], at(3, direction="axial", settlement=0.0004)],
                                  [force(5.0, 5.0)], EA=1e5, hinges=[1.0]))  # fmt: skip
    assert result.steps[-1].reaction == pytest.approx(settled.steps[-1].reaction, rel=1e-14)
    made["analysis"] = {"first_order": True}
    assert gapbeam.solve(made).steps[-1].reaction == pytest.approx([0.0, 2.5, 2.5, -40.0 / 7, 40.0 / 7], rel=1e-14)
    made = made | {"loads": [force(5.0, 5.0), movement(4, -0.5)], "analysis": {}}
    assert gapbeam.solve(made).status == "buckles"


def test_a_path_that_does_not_begin_is_refused_by_events():
    with pytest.raises(gapbeam.EngineError, match=r"can move freely.*take steps"):
        gapbeam.solve(free_at_first(**EVENTS))
