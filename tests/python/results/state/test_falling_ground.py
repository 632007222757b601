"""Ground whose force falls: by hand, beside elements and small steps, on every way to one state, and refusals."""

import copy
import math

import gapbeam
import numpy as np
import pytest
from attack import falling
from gapbeam import packs
from oracle.falling_ground import Program
from scenes.falling import filled, random_falling_scene

LAW = [[0.01, 70.0], [0.03, 50.0], [0.1, 50.0]]
"""Up with 7000, down with 1000, from 0.03 on level."""


def bar(F=100.0, EI=math.inf, **analysis):
    """A bar that turns about its left end on falling ground."""
    return {
        "beam": {"spans": [2.0], "EI": EI},
        "supports": [{"x": 0.0}],
        "foundation": [{"side": "below", "law": LAW}],
        "loads": [{"type": "force", "x": 2.0, "F": F}],
        "analysis": analysis,
    }


def block(**analysis):
    """A beam pressed evenly: all of it comes to the peak at once."""
    loads = [{"type": "uniform", "q": 20.0, "case": "dead"}, {"type": "uniform", "q": 100.0}]
    ground = [{"side": "below", "law": LAW}]
    return {"beam": {"spans": [3.0], "EI": 50.0}, "foundation": ground, "loads": loads, "analysis": analysis}


def test_a_bar_by_hand():
    """F = L G/U^2 with G the integral of p u to the tip U; the most where p U^2 = 2 G: U = d (1 + k/s)^(1/3) = 0.02, F = 30 L."""
    result = gapbeam.solve(bar(follow="events"))
    assert result.status == "limit-load"
    assert result.limits[0].factor == pytest.approx(0.6, rel=1e-11)
    tip = 0.015
    G = 7000.0 * 0.01**3 / 3.0 + 80.0 * (tip**2 - 0.01**2) / 2.0 - 1000.0 * (tip**3 - 0.01**3) / 3.0
    factor = 2.0 * G / tip**2 / 100.0
    assert result.at(2.0, factor=factor).deflection == pytest.approx(tip, rel=1e-13)
    assert [(event.event, event.x, event.branch) for event in result.events] == [("zone appears", 2.0, 2)]
    assert result.events[0].factor == pytest.approx(140.0 / 3.0 / 100.0, rel=1e-14)


@pytest.mark.parametrize("way", [{}, {"follow": "events"}, {"steps": 3}])
def test_a_stop_beyond_the_peak_is_not_jumped_to(way):
    """Under all of F the tip could lie on the stop, where it would come to by a jump."""
    made = bar(**way)
    made["supports"].append({"x": 2.0, "side": "below", "gap": 0.05, "stiffness": 1.0e5})
    result = gapbeam.solve(made)
    assert result.status == ("limit-load" if way.get("follow") else "no-equilibrium")
    share = result.limits[0].factor if way.get("follow") else float(result.reason.split("no more than ")[1].split()[0])
    assert share * (2.0 / 3.0 if "steps" in way else 1.0) == pytest.approx(0.6, rel=1e-11)


def test_a_beam_that_reaches_the_peak_everywhere_at_once():
    result = gapbeam.solve(block(follow="events"))
    assert result.limits[0].factor == pytest.approx(0.5, rel=1e-11)
    assert gapbeam.solve(block()).reason.startswith("no equilibrium at load factor 1: the force of the ground falls, and bears no")
    lighter = block()
    lighter["loads"][1]["q"] = 49.0
    assert gapbeam.solve(lighter).at([0.0, 1.0, 3.0]).deflection == pytest.approx(0.01 * 69.0 / 70.0, rel=1e-13)


def test_ground_that_rises_again_is_not_jumped_to():
    made = block()
    made["foundation"][0]["law"] = [[0.01, 70.0], [0.03, 50.0], [0.05, 200.0]]
    assert gapbeam.solve(made).reason.endswith("bears no more than 0.5 times that load factor")


@pytest.mark.parametrize("seed", [15, 37, 40, 246])
def test_beams_that_only_touch_without_loads(seed):
    """The least load brings them to quite other places."""
    known = ("no-equilibrium", "limit-load", "solved")
    for follow in ({}, {"follow": "events"}):
        assert gapbeam.solve({**random_falling_scene(seed), "analysis": follow}).status in known


@pytest.mark.parametrize("follow", [{}, {"follow": "events"}])
def test_a_beam_that_hovers_without_loads_comes_down(follow):
    made = block(**follow)
    made["foundation"][0]["gap"] = 0.005
    made["loads"] = [{"type": "uniform", "q": 49.0}]
    assert gapbeam.solve(made).at([0.0, 1.0, 3.0]).deflection == pytest.approx(0.012, rel=1e-13)


def test_dead_loads_that_the_ground_does_not_bear():
    made = block()
    made["loads"] = [{"type": "uniform", "q": 71.0, "case": "dead"}, {"type": "uniform", "q": -30.0}]
    result = gapbeam.solve(made)
    assert result.status == "no-equilibrium"
    assert gapbeam.solve({**made, "analysis": {"follow": "events"}}).status == "no-equilibrium"
    made["loads"][0].pop("case")  # put on together they are borne
    assert gapbeam.solve(made).at(1.0).deflection == pytest.approx(0.01 * 41.0 / 70.0, rel=1e-13)


def test_a_beam_that_is_stiff_enough_has_one_state_whatever_the_ground_does():
    made = bar(F=100.0)
    made["supports"].append({"x": 2.0, "stiffness": 2.0e4})
    result = gapbeam.solve(made)
    assert result.steps[-1].unique
    tip = float(result.at(2.0).deflection)
    rest = tip - 0.01
    G = 7000.0 * 0.01**3 / 3.0 + (80.0 * (tip**2 - 0.01**2) / 2.0 - 1000.0 * (tip**3 - 0.01**3) / 3.0 if rest > 0.0 else 0.0)
    G = G if rest > 0.0 else 7000.0 * tip**3 / 3.0
    assert 2.0 * G / tip**2 + 2.0e4 * tip == pytest.approx(100.0, rel=1e-13)


def test_what_the_report_says_of_other_states():
    text = gapbeam.solve(bar(F=58.0)).report()
    assert "The force of the ground falls, so that other stable states are not excluded." in " ".join(text.split())
    assert gapbeam.solve(bar(F=58.0)).to_dict()["steps"][-1]["unique"] is False


@pytest.mark.parametrize("seed", [13, 21, 22])
def test_beside_elements_and_small_steps(seed):
    made = random_falling_scene(seed)
    result = gapbeam.solve({**made, "analysis": {"follow": "events"}})
    program = Program(made)
    w, reached = program.follow(lambda dead, live: gapbeam.solve(filled(made, dead, live)), steps=128)
    if result.status == "limit-load":
        assert reached - 1.0 == pytest.approx(result.limits[0].factor, rel=0.02)
        return
    assert reached == 2.0
    x = np.linspace(0.0, program.length, 9)
    found = np.array([program.deflection(w, at) for at in x])
    assert found == pytest.approx(result.at(x).deflection, abs=0.02 * np.abs(found).max())


@pytest.mark.parametrize("seed", [*range(20, 31), *range(32, 44)])
def test_fields_satisfy_the_law_and_events_lead_to_the_same_state(seed):
    assert falling.judge(random_falling_scene(seed)).wrong == []


def test_combinations_cases_and_steps():
    made = bar(F=58.0)
    result = gapbeam.solve({**made, "analysis": {"steps": 4}})
    w = float(gapbeam.solve(made).at(2.0).deflection)
    assert float(result.at(2.0).deflection) == pytest.approx(w, rel=1e-14)
    combined = copy.deepcopy(made)
    combined["loads"][0]["case"] = "a"
    combined["combinations"] = [{"name": "one", "factors": {"a": 1.0}}, {"name": "more", "factors": {"a": 1.1}}]
    both = gapbeam.solve(combined).combinations
    assert both["one"].at(2.0).deflection == pytest.approx(w, rel=1e-14)
    assert both["more"].status == "no-equilibrium"
    cases = gapbeam.prepare(made).solve([[1.0], [1.1]])
    assert cases.status.tolist() == [0, 1]
    assert cases.result(0).at(2.0).deflection == pytest.approx(w, rel=1e-14)


def test_cyclic_clay_falls_above_the_depth_at_which_the_soil_flows_around():
    clay = {"D": 0.6, "cu": 26.0, "gamma": 8.0, "eps50": 0.01}
    y50, zr = 2.5 * 0.01 * 0.6, 6.0 * 26.0 * 0.6 / (8.0 * 0.6 + 0.5 * 26.0)
    law = packs.matlock_clay(2.0, **clay, cyclic=True)
    ultimate = packs.matlock_clay(2.0, **clay)[-1][1]
    assert law[-3] == pytest.approx((3.0 * y50, 0.72 * ultimate))
    assert law[-2] == pytest.approx((15.0 * y50, 0.72 * ultimate * 2.0 / zr))
    assert law[-1][1] == law[-2][1]
    deep = packs.matlock_clay(2.0 * zr, **clay, cyclic=True)
    assert {p for _, p in deep[-3:]} == {0.72 * 9.0 * 26.0 * 0.6}


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"law": [[0.01, 5.0], [0.02, 4.0]]}, "it ends falling, so its force would become negative beyond [0.02, 4]"),
        ({"law": [[0.01, 5.0], [0.01, 4.0], [1.0, 4.0]]}, "ground has no vertical piece, as at [0.01, 4]"),
    ],
)
def test_laws_that_make_no_sense(change, message):
    made = bar()
    made["foundation"][0].update(change)
    with pytest.raises(gapbeam.SceneError) as error:
        gapbeam.solve(made)
    assert message in str(error.value)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"beam": {"spans": [2.0], "EI": 1e3, "N": -5.0}}, "on ground whose force falls a beam is not compressed"),
        ({"foundation": [{"law": LAW}, {"law": {"type": "tanh", "stiffness": 9.0, "limit": 3.0}}]}, "acts by curves"),
        ({"foundation": [{"side": "below", "law": LAW, "gap": -0.02}]}, "without loads the beam is not in equilibrium"),
        (
            {
                "beam": {"spans": [2.0], "EI": 10.0},
                "foundation": [{"side": "below", "law": LAW, "gap": -0.02}],
                "supports": [{"x": 0.0}, {"x": 2.0}],
            },
            "gaps and settlements alone press the ground so far",
        ),
        ({"trains": [{"name": "t", "axles": [[0.0, 10.0]]}], "loads": []}, "goes over ground whose force falls"),
    ],
)
def test_what_is_refused(change, message):
    with pytest.raises((gapbeam.EngineError, gapbeam.SceneError)) as error:
        gapbeam.solve({**bar(), **change})
    assert message in str(error.value)
