"""Scenes with which the program was once caught (`faults/`), and their right answers; each is one of a family of `attack`."""

import json
import subprocess
import sys
import tomllib
from fractions import Fraction
from functools import partial
from itertools import product
from pathlib import Path

import gapbeam
import numpy as np
import pytest
from attack import events, ground, hinges, signs
from attack.workers import Ended, judge_all
from gapbeam.report import to_json
from oracle import energy
from scenes import one_sided

HERE = Path(__file__).parent
LIMIT = 30.0  # seconds for one scene; a process that takes longer is killed


def fault(name, **analysis):
    """A scene by the beginning of its name, with another analysis."""
    (path,) = HERE.glob(f"{name}.*")
    return {**read(path), "analysis": analysis}


def read(path):
    return json.loads(path.read_text()) if path.suffix == ".json" else tomllib.loads(path.read_text())


def judged(family, made):
    """What a family finds wrong with a scene, in a process of its own."""
    ((_, verdict),) = judge_all(partial(family.judge, seed=0), [made], 1, LIMIT)
    return [verdict.how] if isinstance(verdict, Ended) else verdict.wrong


def followed(name):
    return gapbeam.solve(fault(name, follow="events"))


@pytest.mark.parametrize("name", ["H1_endless_events", "H2_endless_short_span"])
def test_every_path_ends(name):
    made = fault(name)
    assert judged(events, made) == []
    assert gapbeam.solve(made).status == "solved"
    assert gapbeam.solve({**made, "analysis": {"follow": "events"}}).status == "solved"


@pytest.mark.parametrize("name", ["D1_jump_seesaw", "D1_jump_seesaw_live_only", "D1_jump_shaft", "D1_tips_through_clearance"])
def test_the_path_goes_through_clearances(name):
    assert judged(events, fault(name)) == []
    assert followed(name).status == "solved"


def test_seesaw():
    result = followed("D1_jump_seesaw")
    changes = [(event.support, event.factor) for event in result.events]
    assert (1, pytest.approx(0.5, rel=1e-14)) in changes
    assert (2, pytest.approx(0.5, rel=1e-14)) in changes
    assert "turns" in {event.event for event in result.events}
    last = result.steps[-1]
    assert last.reaction == pytest.approx([20.0, 0.0, 10.0], rel=1e-14, abs=1e-13)
    assert result.at(8.0).deflection == pytest.approx(0.1, rel=1e-14)


def test_seesaw_turns_at_once():
    result = followed("D1_jump_seesaw_live_only")
    assert {event.factor for event in result.events} <= {0.0}
    assert result.steps[-1].reaction == pytest.approx([0.0, 0.0, 20.0], abs=1e-13)
    assert result.at(8.0, factor=1e-3).deflection == pytest.approx(0.01, rel=1e-12)


def test_tips_through_a_clearance():
    result = followed("D1_tips_through_clearance")
    assert 0.3 in [pytest.approx(event.factor, rel=1e-14) for event in result.events]
    assert result.steps[-1].reaction == pytest.approx([0.0, -3.5, 19.5], rel=1e-13, abs=1e-13)


@pytest.mark.parametrize("made", [fault("D1_jump_shaft"), read(HERE.parents[1] / "examples" / "shaft_clearance.toml")])
def test_a_shaft_by_events_and_by_steps(made):
    path = gapbeam.solve({**made, "analysis": {"follow": "events"}})
    steps = gapbeam.solve({**made, "analysis": {"steps": 16}})
    assert path.status == steps.status == "solved"
    for step in steps.steps:
        state = path.state(step.factor)
        assert state.state == step.state
        assert state.reaction == pytest.approx(step.reaction, abs=1e-11 * np.abs(step.reaction).max())
        there = (result.at(10.0, factor=step.factor).deflection for result in (path, steps))
        assert next(there) == pytest.approx(next(there), rel=1e-10)


@pytest.mark.parametrize(
    ("name", "support"),
    [
        ("D2_silent_two_springs", 0),
        ("D2_silent_two_springs_1e12", 0),
        ("D2_silent_soft_beam", 1),
        ("D2_silent_shear_soft", 1),
    ],
)
def test_no_silent_scheme(name, support):
    made = fault(name)
    assert judged(signs, made) == []
    assert gapbeam.solve(made).steps[-1].state[support] == "open"


def test_a_stiff_spring_is_open_by_its_distance():
    assert gapbeam.solve(fault("D2_silent_two_springs")).steps[-1].opening[0] == pytest.approx(1e-3, rel=1e-12)


def test_the_start_decides_nothing():
    made = fault("D3_start_decides_status_c579")
    assert judged(signs, made) == []
    for start in product((False, True), repeat=len(one_sided(made))):
        assert gapbeam.solve(made, start=start).status == "no-equilibrium"


@pytest.mark.parametrize("name", ["D4_bound_shear", "D4_bound_zero"])
def test_bounds_hold(name):
    assert judged(signs, fault(name)) == []
    assert gapbeam.solve(fault(name)).steps[-1].bounds[0] > 0.0


def test_no_digit_is_lost_where_shear_is_soft():
    """Uniform GA and no couple: what slips at the tip follows from the moment, and the moment from statics."""
    result = gapbeam.solve(fault("D4_bound_shear"))
    exact = events.Exact(fault("D4_bound_shear"))
    _, values = exact.settle([], Fraction(1))
    assert result.at(11.0).deflection == pytest.approx(float(exact.state_at(Fraction(11), "left", values)[0]), rel=1e-13)


@pytest.mark.parametrize("name", ["D5_refused_3377", "D5_refused_1801_spans"])
def test_what_can_stand_is_solved(name):
    made = fault(name)
    assert judged(hinges, made) == []
    for rule in ("block", "single"):
        assert gapbeam.solve(made, rule=rule).status == "solved"


def test_what_cannot_stand_has_a_motion():
    made = fault("D5_refused_3534")
    assert judged(hinges, made) == []
    assert gapbeam.solve(made).status == "no-equilibrium"


def test_a_soft_spring_beside_a_stiff_one():
    """What a stiff spring carries follows from the balance of its node, not from its own small shortening."""
    made = fault("D6_two_springs_digits")
    assert judged(signs, made) == []
    reaction = gapbeam.solve(made).steps[-1].reaction
    assert reaction[0] == pytest.approx(20.9999999979, rel=1e-13)
    assert reaction.sum() == pytest.approx(50.0, rel=1e-15)


def test_a_support_without_stiffness_is_open():
    """It carries nothing wherever the beam is: open by its distance, or refused."""
    try:
        step = gapbeam.solve(fault("D7_stiffness_zero")).steps[-1]
    except gapbeam.SceneError as error:
        refused = str(error)
    else:
        refused = ""
        assert step.state[2] == "open"
        assert step.opening[2] == pytest.approx(0.1 + 5 * 4.0**4 / (384 * 1e4), rel=1e-12)
    assert not refused or refused.startswith("supports[2].stiffness: ")


@pytest.mark.parametrize("name", ["A1_two_rigid_plastic", "A1_limits_10_20", "A1_rigid_beside_plastic"])
def test_two_rigid_pieces_at_one_place_are_refused(name):
    """Statics cannot tell what each of them takes, as of two rigid supports; each had all of the load."""
    made = read(HERE / f"{name}.json")
    with pytest.raises(gapbeam.SceneError, match=r"supports\[3\]: .*supports\[2\] .* x = 2 .*finite stiffness"):
        gapbeam.solve(made)
    made["supports"][3]["gap"] = 0.5  # apart they do
    step = gapbeam.solve(made).steps[-1]
    assert step.reaction.sum() == pytest.approx(made["loads"][0]["F"], rel=1e-12)


def test_many_supports_that_unload_at_once():
    """13 springs that have yielded: 2**13 ways were to be tried."""
    made = read(HERE / "A2_plastic_13.json")
    result = gapbeam.solve(made)
    assert result.status == "solved"
    ends = {segment.leg: result.path.step(segment, segment.stop) for segment in result.segments}
    # All unload along their first piece: half of the load is taken off an elastic beam
    elastic = {**made, "supports": [{**s, "side": "both"} for s in made["supports"]], "analysis": {}}
    for s in elastic["supports"][2:]:
        s.pop("law"), s.pop("unloading")
        s["stiffness"] = 100.0
    change = 0.5 * gapbeam.solve(elastic).steps[-1].reaction
    assert ends[0].reaction - ends[1].reaction == pytest.approx(change, rel=1e-11)


def test_unloading_gives_back_no_more_than_it_took():
    with pytest.raises(gapbeam.SceneError, match=r"supports\[2\]\.law: .*\[0\.02, 60\] is steeper.*leave unloading out"):
        gapbeam.solve(read(HERE / "A3_plastic_first_piece_soft.json"))


def pin(force, unloading="elastic", **analysis):
    """The rigid pin that breaks at 100, under a force at midspan; without it the beam has the stiffness 48 EI/L**3."""
    made = fault("A6_rigid_brittle", **analysis)
    made["loads"][0]["F"] = force
    made["supports"][2]["unloading"] = unloading
    return gapbeam.solve(made)


def test_a_rigid_pin_holds_and_breaks():
    step = pin(90.0).steps[-1]
    assert (step.reaction[2], step.deflection[2], step.state[2]) == (90.0, 0.0, "branch 1")
    assert pin(100.0).steps[-1].reaction[2] == 100.0
    assert pin(120.0, steps=4).status == "limit-load"
    free = 120.0 / (48 * 2000 / 6.0**3)
    for unloading in ("elastic", "broken", "plastic"):
        stopped = pin(120.0, unloading, follow="events")
        assert (stopped.status, [(e.support, e.event) for e in stopped.events]) == ("limit-load", [(2, "breaks")])
        assert stopped.limits[0].factor == pytest.approx(100 / 120, rel=1e-14)
        assert stopped.limits[0].kind == "limit"
        for at_limit in ("jump", "follow"):
            result = pin(120.0, unloading, follow="events", at_limit=at_limit)
            assert result.status == "solved"
            assert result.steps[-1].deflection[2] == pytest.approx(free, rel=1e-12)
            assert result.steps[-1].reaction[2] == 0.0
    history = [1.0, 0.0, 0.5]
    again = pin(120.0, "broken", follow="events", at_limit="jump", history=history)
    assert again.steps[-1].deflection[2] == pytest.approx(free / 2, rel=1e-12)


@pytest.mark.parametrize("law", ["tanh", "hyperbolic"])
@pytest.mark.parametrize("analysis", [{}, {"follow": "events"}, {"follow": "events", "history": [1.0, 0.5]}])
def test_a_load_that_is_all_that_curves_can_give(law, analysis):
    """They tend to their limit and never have it: displacements of 1e14 came back."""
    soft = {"side": "below", "law": {"type": law, "stiffness": 4e3, "limit": 36.0}}
    made = {
        "beam": {"spans": [4.0], "EI": 1e3},
        "supports": [{"x": 1.0, **soft}, {"x": 3.0, **soft}],
        "loads": [{"type": "force", "x": x, "F": 36.0} for x in (1.0, 3.0)],
        "analysis": analysis,
    }
    result = gapbeam.solve(made)
    assert (result.status, len(result.motion or ())) == ("no-equilibrium", 4)
    made["supports"].append({"x": 2.0, "stiffness": 1.0})
    assert gapbeam.solve(made).status == "solved"
    made["supports"].pop()
    for load in made["loads"]:
        load["F"] = 36.0 * (1 - 1e-6)
    assert gapbeam.solve(made).status == "solved"


def test_no_event_by_rounding():
    """A couple that stays and a force: the support yields at load factor 0 again, not at 1.8e-34."""
    made = {
        "beam": {"spans": [1.125], "EI": 18.625, "hinges": [0.5625]},
        "supports": [
            {"node": 0, "side": "below", "law": [[0.125, 12.875], [0.25, 17.5]], "gap": 0.5, "unloading": "plastic"},
            {"x": 0.25},
            {"node": 1},
        ],
        "loads": [{"type": "force", "x": 0.625, "F": 62.625}, {"type": "moment", "x": 0.0, "M": -29.0, "case": "dead"}],
        "analysis": {"follow": "events", "at_limit": "jump", "history": [1.0, 0.0, 1.5, -0.5]},
    }
    result = gapbeam.solve(made)
    factors = [event.factor for event in result.events] + [s.stop for s in result.segments]
    assert all(factor == 0.0 or abs(factor) > 1e-12 for factor in factors)
    assert all(segment.start != segment.stop for segment in result.segments)


def test_a_state_of_a_path_can_be_looked_at_where_a_part_moves_freely():
    """What is left of the hinge hangs from it alone."""
    made = {
        "beam": {"spans": [3.25, 4.0, 1.625], "EI": 39.125, "hinges": [2.21875]},
        "supports": [
            {"x": 4.125},
            {"node": 2, "side": "below", "gap": 0.375},
            {"x": 7.5, "side": "above", "law": [[0.5, 5.875], [1.125, 22.875]], "gap": 0.375},
            {"x": 8.25},
        ],
        "loads": [{"type": "force", "x": 5.0, "F": 8.875}],
        "analysis": {"follow": "events"},
    }
    result = gapbeam.solve(made)
    for factor in (0.0, 0.5, 1.0):
        state = result.state(factor)
        assert state.indifferent
        assert state.reaction.sum() == pytest.approx(8.875 * factor, rel=1e-12, abs=1e-15)


@pytest.mark.parametrize(
    "sizes",
    [
        (2000, 1, 3000, 1, 4000, 1, 5000, 1),
        (700, 64, 800, 64, 900, 64),
        (1000, 8, 1500, 8, 2000, 8),
    ],
)
def test_long_prepared_beams(sizes):
    """Arrays of Python have a row more than there are supports; in a process of its own, since it was once ended by a signal."""
    command = [sys.executable, str(HERE / "L1_prepared_long.py"), *map(str, sizes)]
    run = subprocess.run(command, capture_output=True, text=True, timeout=10 * LIMIT, check=False)
    assert (run.returncode, run.stderr) == (0, "")


@pytest.mark.parametrize(
    ("family", "seed"),
    [
        (events, 8208),  # events nearer to each other than 1e-12 of the way
        (events, 13652),
        (events, 14301),
        (events, 15762),  # a beam so soft that it crosses a clearance within 1e-14 of the way
        (events, 15138),  # a couple at an elastic end that the load nearly takes away
        (events, 16551),  # a rigid stretch, where quadruple precision needs refinement to tell signs
        (events, 19387),  # imposed curvature makes no force, but rounding of one beside a short span
        (signs, 13882),  # a couple on a beam far softer in shear than in bending
    ],
)
def test_seeds_that_were_wrong(family, seed):
    assert family.FAMILY.judge_seed(seed).wrong == []


def test_an_axle_behind_a_support_with_a_gap():
    """What is behind it is statically determinate: no stretch is so short that its stiffness hides the shear."""
    made = fault("B2_overhang_refused")
    result = gapbeam.solve({key: value for key, value in made.items() if key != "analysis"})
    shear = result.envelope().extremes["shear"]["max"]
    assert (shear.value, shear.x, shear.position) == pytest.approx((24.0, 6.0, 7.0), rel=1e-12)
    assert shear.concurrent["moment"] == pytest.approx(-14.0, rel=1e-11)
    state = shear.state
    assert state.reaction == pytest.approx([44 / 12, 388 / 12], rel=1e-12)
    assert max(state.error_bounds[kind] for kind in ("moment", "shear", "reaction")) < 1e-12
    assert json.loads(to_json(result))["envelope"]["extremes"]["shear"]["max"][0] == shear.value


@pytest.mark.parametrize("distance", [1e-3, 1e-6, 1e-9, 1e-12])
@pytest.mark.parametrize("gap", [0.0, 0.01, 10.0])
def test_bounds_are_those_of_statics_however_near_a_load_is(distance, gap):
    made = fault("B2_overhang_refused")
    del made["analysis"], made["trains"]
    made["supports"][1]["gap"] = gap
    made["loads"] += [{"type": "force", "x": 6.0 + distance, "F": 10.0}, {"type": "force", "x": 7.0, "F": 10.0}]
    assert judged(signs, made) == []
    bounds = gapbeam.solve(made).steps[-1].error_bounds
    assert max(bounds[kind] for kind in ("moment", "shear", "reaction")) < 1e-12
    assert max(bounds["deflection"], bounds["rotation"]) < 1e-14 * max(gap, 1.0)


def test_what_lifts_a_beam_is_not_taken_for_rounding():
    """A couple behind a support with a great gap tips the beam, and nothing holds it down; at a tie it would pull instead."""
    made = {"beam": {"spans": [5.4, 2.7], "EI": 4610.0},
            "supports": [{"node": 0, "side": "below"}, {"node": 1, "side": "below", "gap": 4.59}],
            "loads": [{"type": "uniform", "q": 0.0162, "case": "dead"}, {"type": "moment", "x": 5.98, "M": 287.0},
                      {"type": "force", "x": 5.40000000003, "F": 2.03}]}  # fmt: skip
    assert judged(signs, made) == []
    assert gapbeam.solve(made).status == "no-equilibrium"
    made["supports"].append({"node": 1, "side": "above", "gap": 1e-4})
    made["supports"][0]["side"] = "both"
    assert judged(signs, made) == []


def test_a_beam_tips_at_a_position():
    """All that is said of an extreme is of one state: that before, or that after the beam tips onto its hold-down."""
    result = gapbeam.solve(read(HERE / "B1_snap_concurrent.json"))
    row = result.envelope().supports[0]
    opening = row["opening"]["max"]
    assert (opening.value, opening.position) == (pytest.approx(0.01, rel=1e-12), pytest.approx(5.2, rel=1e-12))
    assert opening.concurrent["deflection"] == pytest.approx(-0.01, rel=1e-12)
    assert opening.state.state == ("open", "closed", "closed")
    least = result.envelope().extremes["deflection"]["min"]
    assert least.state.fields(0.0).deflection == pytest.approx(-0.01, rel=1e-12)
    # What belongs to the state before has that one
    train = result.trains["t"]
    before, after = (scheme for scheme, _ in train.traversals[0].schemes(5.2))
    assert [train.state(5.2, "right", scheme).opening[0] for scheme in (before, after)] == pytest.approx([0.0, 0.01], abs=1e-12)
    for row in result.envelope().supports:
        for quantity, kinds in row.items():
            for extreme in kinds.values():
                values = {"reaction": 0, "deflection": 1, "opening": 2, "couple": 3}
                found = extreme.state.solution.at_supports[values[quantity], extreme.support]
                assert found == pytest.approx(extreme.value, abs=1e-11)


def test_forces_where_the_beam_can_move_freely():
    made = read(HERE / "B3_neutral_positions.json")
    result = gapbeam.solve(made)
    (train,) = result.trains.values()
    assert [gap.status for gap in train.unstable_positions] == ["no-equilibrium", "no-equilibrium", "solved"]
    assert (train.unstable_positions[-1].from_, train.unstable_positions[-1].to) == pytest.approx((9.2, 12.6), rel=1e-12)
    extremes = result.envelope().extremes
    assert extremes["deflection"] == extremes["rotation"] == {"max": None, "min": None}
    largest = extremes["moment"]["max"]
    assert (largest.value, largest.x, largest.position) == pytest.approx((42.5, 10.9, 10.9), rel=1e-12)
    assert set(largest.concurrent) == {"shear", "curvature"}
    assert [extremes["shear"][kind].value for kind in ("max", "min")] == pytest.approx([50.0, -50.0], rel=1e-12)
    assert result.envelope().supports[0]["reaction"]["max"].value == pytest.approx(50.0, rel=1e-12)
    curves = result.envelope(x=[10.0, 11.75]).fields
    assert curves.largest["moment"] == pytest.approx([50.0 * x * (3.4 - x) / 3.4 for x in (0.8, 2.55)], rel=1e-12)
    assert np.isnan(curves.largest["deflection"]).all()
    assert json.loads(to_json(result))["trains"][0]["gaps"][-1]["status"] == "solved"
    # With a foot that keeps the free part from falling there are neutral positions beside others
    made["supports"].append({"node": 0, "side": "below"})
    made["beam"]["hinges"] = [4.21, 9.0]
    for position in (1.0, 9.5, 11.3):
        (train,) = gapbeam.solve(made).trains.values()
        moment = train.state(position).extremes["moment"]["max"].value if position > 9.2 else None
        assert moment is None or moment <= gapbeam.solve(made).envelope().extremes["moment"]["max"].value * (1 + 1e-12)


def test_the_factor_of_a_case_acts_once_on_trains_that_go_together(tmp_path):
    done = gapbeam.batch(HERE / "B4_together_factor.toml", HERE / "B4_factors.csv", tmp_path / "out")
    found = done.read()
    assert found["moment.max"] == pytest.approx([32.80792842606836 * factor for factor in (1.0, 2.0, 0.5)], rel=1e-12)
    # The factor of a member counts, that of its case does not
    made = read(HERE / "B4_together_factor.toml")
    made["trains"][0] |= {"factor": 1.5, "case": "other"}
    made["trains"][2]["both_directions"] = True
    done = gapbeam.batch(made, {"factors.crane": [1.0, 2.0], "factors.other": [0.0, 3.0]}, tmp_path / "more")
    for k, (crane, other) in enumerate(((1.0, 0.0), (2.0, 3.0))):
        alone = gapbeam.solve({**made, "combinations": [{"name": "one", "factors": {"crane": crane, "other": other}}]})
        assert done.read()["moment.max"][k] == pytest.approx(alone.envelope().extremes["moment"]["max"].value, rel=1e-12)


def test_a_zone_is_born_just_before_a_greatest_value():
    """Values go like the power 3/2 from there; parabolas in the position saw the greatest value at the birth itself."""
    result = gapbeam.solve(read(HERE / "C1_ground_train_20.json"))
    train, shear = result.trains["t"], result.envelope().extremes["shear"]["max"]
    assert shear.value == pytest.approx(50.566861733, rel=1e-10)
    assert shear.position == pytest.approx(6.363583, abs=1e-5)
    born = next(event.position for event in train.events if event.event == "zone appears")
    for away in np.geomspace(1e-5, 0.3, 25).tolist():
        assert train.state(born + away).extremes["shear"]["max"].value <= shear.value * (1 + 1e-12)


@pytest.mark.parametrize(("seed", "quantity"), [(39, "shear"), (172, "rotation")])
def test_greatest_values_beside_changes_of_zones(seed, quantity):
    """One before a zone is born, on the smooth side of it; one at five thousandths of the way to the next state."""
    scenes = {
        39: {"beam": {"spans": [8.0], "EI": 445.819857619748}, "foundation": [{"k": 36.71540398306674, "side": "below"}],
             "loads": [{"type": "uniform", "q": 0.2761096809315411, "case": "dead"}],
             "trains": [{"axles": [[0.0, 39.195894858235285], [2.5, 32.73891403452295]], "q": 5.0, "from": 3.24, "to": 6.78}]},
        172: {"beam": {"spans": [10.0], "EI": 304.61371762773996}, "foundation": [{"k": 177.42710196369964, "side": "below"}],
              "loads": [{"type": "uniform", "q": 0.5064609391304156, "case": "dead"}],
              "trains": [{"axles": [[0.0, 3.744039505453697], [1.9, 54.568405813102444]], "from": 0.0, "to": 2.59}],
              "supports": [{"x": 6.93, "side": "below", "gap": 0.0012630987406215674, "stiffness": 397.234535409546}]},
    }  # fmt: skip
    result = gapbeam.solve(scenes[seed])
    (train,) = result.trains.values()
    largest = result.envelope().extremes[quantity]["max"]
    for event in train.events:
        for away in np.geomspace(1e-5, 0.2, 12).tolist():
            for position in (event.position - away, event.position + away):
                if train.train.from_ <= position <= train.train.to:
                    assert train.state(position).extremes[quantity]["max"].value <= largest.value * (1 + 1e-9)


@pytest.mark.parametrize(("name", "zones"), [("C2_rough_curves_7001", 45), ("C3_cubic_gap", 2)])
def test_curves_on_bumps_and_with_gaps(name, zones):
    """Judged by what the fields leave over of differential equations, contact and laws; the state is unique."""
    made = read(HERE / f"{name}.json")
    assert ground.judge(made).wrong == []  # without a limit: these take seconds, and machines are busy
    assert len(gapbeam.solve(made).steps[-1].contact) == zones


def test_a_beam_over_160_bumps():
    """On every one of them, and on both ends; it carries its load, which is audited stretch by stretch."""
    contact = gapbeam.solve(HERE / "C2_bumps_160.json").steps[-1].contact
    assert len(contact) == 161
    assert sum(zone.resultant for zone in contact) == pytest.approx(2.0 * 400.0, rel=1e-14)


def test_beam_that_touches_the_ground_to_a_rounding():
    """The deflection at midspan is the gap to 1e-14, as it would be exactly: 5 q L^4/(384 EI)."""
    (zone,) = gapbeam.solve(HERE / "C4_touching_tie.json").steps[-1].contact
    assert (zone.from_, zone.to, zone.state, zone.resultant) == (5.0, 5.0, "touching", 0.0)


@pytest.mark.parametrize("seed", [5575, 7769])
def test_curves_that_begin_at_nothing(seed):
    """Hyperbolic: pressed far beyond a short stretch in which the force grows; or approached from one side."""
    kind, made = ground.draw_scene(seed, tapers=False, joints=False)
    assert kind == "curved"
    assert ground.judge(made).wrong == []


def test_cubic_law_with_a_gap():
    """Displacement elements with a line search on the energy, which come near with the square of their length."""
    made = read(HERE / "C3_cubic_gap.json")
    x, w, _ = energy.solve(made, 1024)
    assert np.abs(gapbeam.solve(made).at(x).deflection - w).max() <= 4e-6 * np.abs(w).max()
