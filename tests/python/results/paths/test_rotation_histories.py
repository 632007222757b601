"""Histories of restraints and hinges with laws, beside the same law of a deflection: at the tip of a rigid lever of length 1."""

import math
import random

import gapbeam
import pytest
from scenes.units import in_units


def law_of(rng, yields):
    """Points of a law; one that yields gets flatter from piece to piece."""
    points, d, f, slope = [], 0.0, 0.0, rng.choice([2.0, 4.0, 8.0, 16.0])
    for _ in range(rng.randint(2, 4)):
        width = rng.choice([0.03125, 0.0625, 0.125])
        d, f = d + width, f + slope * width
        points.append([d, f])
        slope *= rng.choice([0.0, 0.25, 0.5] if yields else [0.0, 0.25, 0.5, 1.0, 2.0])
    return points


def pair_of(seed):
    """A beam with a law of a rotation, and one with the same law of a deflection; and the ratio of their displacements."""
    rng = random.Random(seed)
    yields = rng.random() < 0.7
    law = {"law": law_of(rng, yields), "unloading": "plastic" if yields else "elastic"}
    history = [rng.choice([1.0, 0.5, 2.0, -0.5, -1.0, 0.0, 1.5]) for _ in range(rng.randint(1, 5))]
    history = [factor for k, factor in enumerate(history) if k == 0 or factor != history[k - 1]]
    history = history if any(history) else [1.0]
    about = {"loads": [{"type": "uniform", "q": rng.choice([1.0, 2.0, 4.0]), "to": 2.0}],
             "analysis": {"follow": "events", "history": history}}  # fmt: skip
    if rng.random() < 0.5:
        stop = {"x": 1.0, "side": rng.choice(["below", "above"]), "gap": rng.choice([0.0, 0.03125]),
                "stiffness": rng.choice([math.inf, 8.0])}  # fmt: skip
        stops = [stop] if rng.random() < 0.6 else []
        turned = {"beam": {"spans": [2.0], "EI": 1.0}, "supports": [{"x": 0.0}, {"x": 2.0, "rotation": law}, *stops], **about}
        lever = [{"x": 0.0}, {"x": 2.0}, *stops, {"x": 3.0, **law}]
        return turned, {"beam": {"spans": [2.0, 1.0], "EI": [1.0, math.inf]}, "supports": lever, **about}, 1.0
    # The half of a symmetric beam, which does not turn at its middle, sees half of the rotation of a hinge there
    clamped = {"rotation": "fixed"}
    turned = {"beam": {"spans": [2.0], "EI": 1.0}, "supports": [{"x": 0.0, **clamped}, {"x": 2.0, **clamped}],
              "hinges": [{"x": 1.0, **law}], **about}  # fmt: skip
    half = {**law, "law": [[d / 2.0, f] for d, f in law["law"]]}
    about = {**about, "loads": [{**about["loads"][0], "to": 1.0}]}
    supports = [{"x": 0.0, **clamped}, {"x": 1.0, "direction": "rotational", **half}]
    return turned, {"beam": {"spans": [1.0], "EI": 1.0}, "supports": supports, **about}, 2.0


@pytest.mark.parametrize("seed", range(40))
def test_beside_a_lever_and_beside_half_the_beam(seed):
    scene, other, ratio = pair_of(seed)
    turned, known = gapbeam.solve(scene), gapbeam.solve(other)
    assert turned.status == known.status
    assert [event.event for event in turned.events] == [event.event for event in known.events]
    for one, two in zip(turned.steps, known.steps, strict=True):
        assert one.factor == pytest.approx(two.factor, abs=1e-13)
        assert one.reaction[-1] == pytest.approx(two.reaction[-1], abs=1e-13)
        assert one.deflection[-1] == pytest.approx(ratio * two.deflection[-1], abs=1e-13)
        assert one.set[-1] == pytest.approx(ratio * two.set[-1], abs=1e-13)
    for leg in range(1, len(scene["analysis"]["history"]) + 1):
        for factor in (0.3, 0.77):
            try:
                found = turned.at(0.5, factor=factor, leg=leg)
            except (ValueError, gapbeam.GapbeamError):
                continue  # not on this leg
            assert found.moment == pytest.approx(known.at(0.5, factor=factor, leg=leg).moment, abs=1e-13)


@pytest.mark.parametrize(("force", "length"), [(2.0**80, 1.0), (1.0, 2.0**-30), (2.0**-40, 2.0**50)])
@pytest.mark.parametrize("seed", range(0, 40, 8))
def test_in_other_units(seed, force, length):
    """Forces and lengths far from 1: couples are scaled, rotations and sets are not."""
    scene, _, _ = pair_of(seed)
    there = gapbeam.solve(in_units(scene, force, length))
    for one, two in zip(gapbeam.solve(scene).steps, there.steps, strict=True):
        assert two.reaction[-1] == pytest.approx(force * length * one.reaction[-1], rel=1e-13)
        assert two.deflection[-1] == pytest.approx(one.deflection[-1], rel=1e-13)
        assert two.set[-1] == pytest.approx(one.set[-1], abs=1e-13)


def test_a_loop_closes_and_its_energy_is_that_of_its_area():
    """A joint 1 000 that yields at 10, turned to and fro by couples: elastic-plastic, area 4 F (u - u_y)."""
    joint = {"law": [[0.01, 10.0], [1.0, 10.0]], "unloading": "plastic"}
    scene = {"beam": {"spans": [1.0], "EI": 100.0}, "supports": [{"node": 0, "rotation": joint}, {"node": 1}],
             "loads": [{"type": "moment", "node": 0, "M": 14.0}],
             "analysis": {"follow": "events", "history": [1.0, -1.0, 1.0, -1.0, 1.0]}}  # fmt: skip
    loop = gapbeam.solve(scene).loop("rotation of 0")
    most = 4.0 / 300.0  # what the joint leaves of the couple turns the beam with 3 EI/L
    assert max(loop.movement) == pytest.approx(most, rel=1e-14)
    assert loop.cycles[1].energy == pytest.approx(4.0 * 10.0 * (most - 0.01), rel=1e-12)
    assert loop.cycles[1].closed


def test_what_statics_leaves_at_rest_does_not_turn_back():
    """Curvature of an overhang moves no support. What refinement left of their rates went to and fro, and was told as a limit."""
    yields = {"rotation": {"law": [[0.002, 10.0], [0.01, 30.0]], "unloading": "plastic"}}
    softer = {"law": [[0.01, 5.0], [0.02, 7.5], [0.04, 9.0]]}
    result = gapbeam.solve({
        "beam": {"spans": [4.0, 5.0], "EI": 2000.0}, "supports": [{"node": 1, **softer}, {"node": 0, **yields}],
        "loads": [{"type": "uniform", "from": 4.0, "q": 5.0, "case": "dead"}, {"type": "curvature", "from": 4.0, "kappa": -0.004}],
        "analysis": {"follow": "events", "history": [1.0, 0.0, 1.5]},
    })  # fmt: skip
    assert (result.status, result.events) == ("solved", [])
    assert result.at(9.0, factor=1.5).deflection - result.at(9.0, factor=0.0).deflection == pytest.approx(-1.5 * 0.004 * 25 / 2)


def test_a_joint_without_moment_beside_one_that_yields():
    """Beyond the hinge the beam hangs without load: that its joint does not move was no way on, and the limit was told there."""
    joint = {"law": [[0.0015, 3.0], [0.003, 4.5], [0.006, 5.4]], "unloading": "plastic"}
    clamp = {"law": [[0.002, 10.0], [0.01, 30.0]], "unloading": "plastic"}
    stop = {"side": "above", "law": [[0.005, 10.0], [0.01, 15.0], [0.02, 18.0]]}
    lifts = {"side": "below", "law": [[0.01, 5.0], [0.02, 7.5], [0.04, 9.0]]}
    result = gapbeam.solve({
        "beam": {"spans": [3.0, 2.0], "EI": [2500.0, 5000.0]}, "hinges": [{"x": 3.8, **joint}],
        "supports": [{"node": 1, **stop, "rotation": 1000.0}, {"node": 2, **lifts}, {"node": 0, "rotation": clamp}],
        "loads": [{"type": "force", "x": 3.0, "F": 40.0}],
        "analysis": {"follow": "events", "history": [1.0, 0.0, 1.5, -0.5]},
    })  # fmt: skip
    assert result.status == "solved"
    assert [(event.support, event.event) for event in result.events][-3:] == [(0, "closes"), (0, "yields"), (0, "yields")]
    assert result.steps[-1].reaction[1] == 0.0
