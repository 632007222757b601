"""Cases of beams whose state depends on the loading history, and of those on curves: each as the scene with its loads."""

import pickle
import random

import gapbeam
import numpy as np
import pytest
from attack.roads import KINDS as ROADS
from gapbeam import GapbeamError
from gapbeam.base.errors import Status
from scenes.law import law_scene
from scenes.links_along import along, own_weight, warm
from scenes.plain import at, force

CURVES = (
    {"type": "tanh", "stiffness": 5.0, "limit": 20.0},
    {"type": "hyperbolic", "stiffness": 20.0, "limit": 9.0},
    {"type": "cubic", "k1": 5.0, "k3": 30.0, "k2": -10.0},
)

def on_curves(seed):
    made, draw = law_scene(seed, "hardening") | {"analysis": {}}, random.Random(seed)
    made["supports"] = [{**one, "law": draw.choice(CURVES)} if "law" in one else one for one in made["supports"]]
    return made


def with_a_joint_that_yields(seed):
    made = ROADS["plastic"](seed)
    law = {"law": [[0.01, 1.0], [1.0, 1.5]], "unloading": "plastic"}
    made["supports"].append({"x": made["beam"]["spans"][0] / 2, "direction": "rotational", **law})
    return made


KINDS = {kind: ROADS[kind] for kind in ("rack", "pipe", "pile", "pile on ground", "softening", "plastic", "broken")}
KINDS |= {"curves": on_curves, "joint": with_a_joint_that_yields}


def times(load, factor):
    return {key: factor * one if key in ("q", "F", "M", "kappa", "value", "dT") else one for key, one in load.items()}


def alone(scene, factors):
    """The scene with the loads of a case, or what refuses it."""
    try:
        return gapbeam.solve({**scene, "loads": [times(load, by) for load, by in zip(scene["loads"], factors, strict=True)]})
    except GapbeamError as error:
        return error


@pytest.mark.parametrize("kind", KINDS)
def test_a_case_is_the_scene_with_its_loads(kind):
    solved = 0
    for seed in range(12):
        scene, draw = KINDS[kind](seed), random.Random(seed)
        prepared = gapbeam.prepare(scene)
        rows = [[draw.choice((1.0, 0.5, -1.0, 0.0, draw.uniform(-1.0, 2.0))) for _ in scene["loads"]] for _ in range(3)]
        cases = prepared.solve(rows)
        places = np.linspace(0.0, prepared.node_x[-1], 5)
        fields, bounds = cases.at(places).columns(), cases.error_bounds()
        for k, row in enumerate(rows):
            one = alone(scene, row)
            if isinstance(one, GapbeamError) or one.status != "solved":
                assert cases.status[k] == (one.status if isinstance(one, GapbeamError) else Status.NO_EQUILIBRIUM), (seed, k)
                assert np.isnan(cases.deflection[k]).all()
                continue
            solved += 1
            assert cases.status[k] == Status.SOLVED, (seed, k)
            step, extremes = one.steps[-1], one.extremes
            sizes = {name: max(abs(extremes[name][way].value) for way in ("max", "min")) for name in step._beam.fields}
            size = max(sizes["shear"], np.abs(step.reaction).max(initial=0.0))
            np.testing.assert_allclose(cases.reaction[k], step.reaction[prepared.supports], rtol=0, atol=1e-13 * size)
            np.testing.assert_allclose(prepared.result(row).steps[-1].reaction, step.reaction, rtol=0, atol=1e-13 * size)
            acts = [state != "open" for state in np.array(step.state, dtype=object)[prepared.supports]]
            assert cases.closed[k].tolist() == acts, (seed, k)
            found = one.at(places).columns()
            for name, value in found.items():
                if name in sizes:
                    np.testing.assert_allclose(fields[name][k], value, rtol=0, atol=1e-13 * sizes[name], err_msg=name)
                    for way in ("max", "min"):
                        most = extremes[name][way].value
                        assert cases.extremes[name][way].value[k] == pytest.approx(most, abs=1e-13 * sizes[name])
            for name, bound in step.error_bounds.items():
                assert bounds[name][k] == pytest.approx(np.nan if bound is None else bound, rel=0.5, nan_ok=True), name
    assert solved > 12


RACK = {
    "beam": {"spans": [6.0, 6.0, 6.0], "EI": 1e4, "EA": 1e6, "alpha": 1.2e-5},
    "supports": [*(at(k, side="below", friction=0.3, name=f"R-{k}") for k in range(4)), along(1)],
    "loads": [own_weight(10.0), warm(60.0), force(9.0, 20.0)],
}
CASES = [[1.0, 1.0, 0.0], [1.35, -0.5, 1.0], [1.0, 1.0, -30.0]]


def test_digits_do_not_depend_on_who_asks():
    """One case or many, taken out of a pickle, what is wanted, filled again."""
    prepared = gapbeam.prepare(RACK)
    cases = prepared.solve(CASES)
    assert cases.status.tolist() == [0, 0, 1]
    for k, row in enumerate(CASES):
        for one in (prepared.solve(row), pickle.loads(pickle.dumps(prepared)).solve(CASES)[k], prepared.solve([*CASES, row])[3]):
            for name in ("reaction", "deflection", "moment_left", "moment_right", "closed", "status", "solves"):
                assert getattr(one, name).tobytes() == getattr(cases, name)[k].tobytes(), (k, name)
    again = prepared.solve(CASES[::-1], out=prepared.solve(CASES))
    assert again.reaction.tobytes() == cases.reaction[::-1].tobytes()
    assert prepared.solve(CASES, want="reaction").reaction.tobytes() == cases.reaction.tobytes()


def test_a_case_says_all_there_is():
    """Friction of a case, why one has no equilibrium, and at which share of its loads."""
    prepared = gapbeam.prepare(RACK)
    hot = prepared.result(CASES[0]).steps[-1]
    assert hot.friction[:4].tolist() == alone(RACK, CASES[0]).steps[-1].friction[:4].tolist()
    assert "limit load: nothing more resists the load beyond load factor" in prepared.solve(CASES)[2].reason
    assert prepared.solve(CASES[2]).reason == alone(RACK, CASES[2]).reason


def test_gaps_and_movements_by_case():
    """What supports have by case, and loads that move them on the way, as in the scene; steps and histories of it do not count."""
    scene = RACK | {"loads": [*RACK["loads"], {"type": "movement", "support": "R-2", "value": 0.01}]}
    scene["analysis"] = {"follow": "events", "history": [1.0, 0.0, -1.0], "at_limit": "jump"}
    cases = gapbeam.prepare(scene).solve([1.0, 1.0, 1.0, 0.5], gap={"R-1": [0.0, 0.002]}, EI=[[1e4] * 3, [1e4, 2e4, 1e4]])
    for k, (gap, EI) in enumerate(((0.0, 1e4), (0.002, [1e4, 2e4, 1e4]))):
        supports = [one | ({"gap": gap} if one.get("name") == "R-1" else {}) for one in RACK["supports"]]
        loads = [*RACK["loads"], {"type": "movement", "support": "R-2", "value": 0.005}]
        one = gapbeam.solve(RACK | {"beam": RACK["beam"] | {"EI": EI}, "supports": supports, "loads": loads})
        assert cases.status[k] == 0
        assert cases.reaction[k].tolist() == pytest.approx(one.steps[-1].reaction[:4].tolist(), rel=1e-13)
        assert cases.extremes["axial_force"]["min"].value[k] == pytest.approx(one.extremes["axial_force"]["min"].value, rel=1e-13)


def test_the_order_of_loads_counts():
    """Dead loads are put on first: friction of a beam that was warmed without its weight is none."""
    one = gapbeam.prepare(RACK).solve([1.0, 1.0, 0.0]).extremes["axial_force"]["min"].value
    live = RACK | {"loads": [own_weight(10.0) | {"case": "live"}, warm(60.0, case="dead"), force(9.0, 20.0)]}
    other = gapbeam.prepare(live).solve([1.0, 1.0, 0.0]).extremes["axial_force"]["min"].value
    assert one < -5.0
    assert abs(other) < 1e-9


def test_a_pile_that_is_pushed_in_is_told_among_others():
    """What acts across it is the same in all cases, and found once; what acts along it is not."""
    scene = {
        "beam": {"spans": [20.0], "EI": 1e5, "EA": 8e6}, "foundation": [{"k": 1e4}], "analysis": {"first_order": True},
        "supports": [], "axial_ground": [{"stiffness": 2e4, "limit": 60.0}],
        "loads": [{"type": "axial", "node": 0, "F": 1000.0}, {"type": "force", "node": 0, "F": 10.0}],
    }  # fmt: skip
    pushes = [1.0, 1.1, 1.19, 0.5, 0.6, 0.7, 0.8, 1.3, 0.9, 1.21]
    prepared = gapbeam.prepare(scene)
    for _ in range(2):
        cases = prepared.solve([[push, 1.0 + push / 3.0] for push in pushes])
        assert cases.status.tolist() == [int(push > 1.2) for push in pushes]
    least = [np.nan if push > 1.2 else -1000.0 * push for push in pushes]
    assert cases.extremes["axial_force"]["min"].value.tolist() == pytest.approx(least, nan_ok=True)


@pytest.mark.parametrize("law", [{"type": kind, "stiffness": 1e3, "limit": 40.0} for kind in ("brittle", "plastic")])
def test_a_dead_movement_has_the_factor_of_its_case(law):
    """It was there in full in every case."""
    unloads = {"unloading": "plastic"} if law["type"] == "plastic" else {}

    def scene(dead, live):
        moves = [{"type": "movement", "support": 1, "value": 0.004 * dead, "case": "dead"},
                 {"type": "movement", "support": 1, "value": 0.002 * live}]  # fmt: skip
        return {"beam": {"spans": [2.0, 2.0], "EI": 100.0}, "loads": [{"type": "uniform", "q": 5.0}, *moves],
                "supports": [{"node": 0}, {"node": 1, "side": "below", "law": law, **unloads}, {"node": 2}]}  # fmt: skip

    prepared = gapbeam.prepare(scene(1.0, 1.0))
    for dead, live in ((1.0, 1.0), (0.5, 1.0), (0.0, 0.5), (-1.0, 1.0)):
        alone = gapbeam.solve(scene(dead, live)).steps[-1].reaction
        for found in (prepared.solve([1.0, dead, live]), prepared.result([1.0, dead, live]).steps[-1]):
            assert found.reaction.tolist() == pytest.approx(alone.tolist(), rel=1e-13)
        assert prepared.solve([[1.0, dead, live]] * 9).reaction[7].tolist() == pytest.approx(alone.tolist(), rel=1e-13)
