"""Prepared cases whose loads move supports."""

import math
import pickle
import random

import gapbeam
import numpy as np
import pytest
from gapbeam.base.errors import Status
from scenes import at, force, random_scene, scene, uniform


def movement(support, value, **keys):
    return {"type": "movement", "support": support, "value": value, **keys}


def settled(made, factors):
    """The scene of a case: movements are settlements, the other loads have their factors."""
    supports, loads = [dict(one) for one in made["supports"]], []
    for load, factor in zip(made["loads"], factors, strict=True):
        if load["type"] == "movement":
            one = supports[load["support"]]
            one["settlement"] = one.get("settlement", 0.0) + factor * load["value"]
        else:
            q = load.get("q")
            key = {"F", "M", "q", "kappa", "dT"}.intersection(load).pop()
            loads.append({**load, key: [factor * one for one in q] if isinstance(q, list | tuple) else factor * load[key]})
    return {**made, "supports": supports, "loads": loads}


def test_a_jacked_pier():
    """A support in the middle of a beam on two: raised by d it takes 48 EI d/L^3, and as much less where it sinks."""
    loads = [movement("pier", -0.01), movement("pier", 0.002, case="dead"), uniform(3.0)]
    beam = gapbeam.prepare(scene([4.0, 4.0], [at(0), at(1, name="pier"), at(2)], loads, EI=500.0))
    stiffness = 48.0 * 500.0 / 8.0**3
    found = beam.solve([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [2.0, -1.0, 1.0], [0.0, 0.0, 1.0]])
    expected = [0.01 * stiffness, -0.002 * stiffness, 0.022 * stiffness + 30.0 * 3.0 * 8.0 / 48.0, 15.0]
    assert found.reaction[:, 1] == pytest.approx(expected, rel=1e-14)
    assert found.deflection[:, 1] == pytest.approx([-0.01, 0.002, -0.022, 0.0], rel=1e-14, abs=1e-17)
    result = beam.result([2.0, -1.0, 1.0])
    assert result.steps[-1].reaction[1] == pytest.approx(expected[2], rel=1e-14)
    assert "0.022" in gapbeam.report.report_text(result)
    assert (beam.solve([2.0, -1.0, 1.0], extra_settlement={"pier": 0.022}).deflection[1]) == pytest.approx(0.0, abs=1e-17)
    assert found.certificate()["equilibrium"].max() < 1e-15
    assert found.at(4.0).deflection == pytest.approx([-0.01, 0.002, -0.022, 0.0], rel=1e-14, abs=1e-17)


@pytest.mark.parametrize("seed", range(40))
def test_cases_are_scenes_with_settlements(seed):
    rng = random.Random(seed)
    made = random_scene(rng, held=True)
    made.pop("analysis", None)
    made["loads"] = [load for load in made["loads"] if load["type"] in ("force", "moment", "uniform", "linear", "curvature")]
    across = [k for k, one in enumerate(made["supports"]) if one.get("direction", "normal") == "normal"]
    for k in rng.sample(across, min(len(across), rng.randint(1, 3))):
        moved = movement(k, rng.uniform(-0.1, 0.1), case=rng.choice(("dead", "live")))
        made["loads"].insert(rng.randint(0, len(made["loads"])), moved)
    try:
        beam = gapbeam.prepare(made)
    except gapbeam.SceneError:  # a dead movement may take the room between two supports
        return
    factors = np.array([[rng.uniform(-1.5, 2.0) for _ in made["loads"]] for _ in range(9)])
    cases = beam.solve(factors)
    extremes = cases.extremes["moment"]["max"].value
    for row, one in enumerate(factors):
        try:
            other = gapbeam.solve(settled(made, one))
        except gapbeam.GapbeamError:
            assert cases.status[row] != Status.SOLVED
            continue
        assert (cases.status[row] == Status.SOLVED) == (other.status == "solved")
        if other.status != "solved":
            continue
        right = other.steps[-1].reaction[beam.supports]
        assert cases.reaction[row] == pytest.approx(right, abs=1e-11 * max(map(abs, right), default=1.0))
        assert extremes[row] == pytest.approx(other.extremes["moment"]["max"].value, rel=1e-10, abs=1e-10)


def test_what_is_out_of_range_is_that_case():
    beam = gapbeam.prepare(scene([4.0, 4.0], [at(k, side="below") for k in range(3)], [uniform(1.0), movement(1, 1e300)], EI=1.0))
    assert beam.solve([[1.0, 1e300], [1.0, 0.0]]).status.tolist() == [Status.NOT_FINITE, Status.SOLVED]


def test_what_cannot_stand_unmoved_is_refused_by_its_place():
    """It ended in an error that is the program's own."""
    scene = {
        "beam": {"spans": [4.0], "EI": 100.0}, "supports": [{"node": 0}, {"node": 1, "side": "above"}],
        "loads": [{"type": "uniform", "q": -1.0}, {"type": "movement", "support": 1, "value": -0.01, "case": "dead"}],
        "foundation": [{"side": "below", "k": math.inf, "gap": -0.005, "from": 1.0}],
    }  # fmt: skip
    with pytest.raises(gapbeam.SceneError, match=r"supports\[1\]: this one holds the beam at a deflection of 0"):
        gapbeam.prepare(scene)


def test_a_dead_movement_that_parts_two_rigid_supports():
    """Without it they leave no room: the beam has it, cases have their own part of it."""
    pair = [at(1, side="below", gap=-0.002), at(1, side="above", gap=-0.002)]
    loads = [force(5.0, 30.0), movement(2, 0.01, case="dead")]
    made = scene([6.0, 6.0], [at(0), at(2), *pair], loads, EI=1e4)
    prepared = gapbeam.prepare(made)
    right = gapbeam.solve(made).steps[-1].reaction
    assert prepared.solve().reaction == pytest.approx(right, rel=1e-13)
    cases = prepared.solve([[1.0, 1.0], [1.0, 0.0], [1.0, 1.5]])
    assert cases.status.tolist() == [0, Status.BAD_INPUT, 0]
    loads[1]["value"] = 0.015
    assert cases.reaction[2] == pytest.approx(gapbeam.solve(made).steps[-1].reaction, rel=1e-13)
    loads[1]["value"] = 0.01
    made["supports"][2]["settlement"] = 0.001
    right = gapbeam.solve(made).steps[-1].reaction
    assert prepared.solve(settlement={2: [0.001]}).reaction[0] == pytest.approx(right, rel=1e-13)
    assert pickle.loads(pickle.dumps(prepared)).result().steps[-1].reaction == pytest.approx(prepared.solve().reaction, rel=1e-13)


@pytest.mark.parametrize("first_order", [False, True])
def test_axial_supports_that_move_where_nothing_else_pushes(first_order):
    """They were not felt: the beam of the scene has no axial forces."""
    along = [at(0, direction="axial"), at(2, direction="axial", name="jack")]
    made = scene([3.0, 4.0], [at(0), at(1, side="below"), at(2), *along], [uniform(5.0)], EI=1e3, EA=1e5)
    made["analysis"] = {"first_order": first_order}
    prepared = pickle.loads(pickle.dumps(gapbeam.prepare(made)))
    moved = prepared.solve([[1.0], [1.0]], extra_settlement={"jack": [0.006, -0.006]})
    for k, value in enumerate((0.006, -0.006)):
        made["supports"][4]["settlement"] = value
        right, one = gapbeam.solve(made), prepared.solve([1.0], settlement={4: value})
        assert moved.reaction[k] == pytest.approx(right.steps[-1].reaction[:3], rel=1e-14)
        assert moved.at([1.0]).axial_force[k] == pytest.approx(right.extremes["axial_force"]["max"].value, rel=1e-14)
        assert one.at([1.0]).moment == pytest.approx(right.at([1.0]).moment, rel=1e-14)
        assert prepared.result(settlement={"jack": value}).at(1.0).moment == pytest.approx(right.at(1.0).moment, rel=1e-14)
        assert prepared.solve([1.0], settlement={4: value}, out=one) is one
    del made["supports"][4]["settlement"]
    made["loads"].append(movement(4, 0.006))
    cases = gapbeam.prepare(made).solve([1.0, 0.5])
    assert cases.at(1.0).axial_force == pytest.approx(0.5 * 0.006 * 1e5 / 7, rel=1e-14)
