"""Scenes with which the program was once caught (`faults/`), and their right answers; each is one of a family of `attack`."""

import json
import tomllib
from fractions import Fraction
from functools import partial
from itertools import product
from pathlib import Path

import gapbeam
import numpy as np
import pytest
from attack import events, hinges, signs
from attack.workers import Ended, judge_all
from scenes import one_sided

HERE = Path(__file__).parent
LIMIT = 30.0  # seconds for one scene; a process that takes longer is killed


def fault(name, **analysis):
    """A scene by the beginning of its name, with another analysis."""
    (path,) = (HERE / "faults").glob(f"{name}.*")
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


@pytest.mark.parametrize("made", [fault("D1_jump_shaft"), read(HERE.parent / "examples" / "shaft_clearance.toml")])
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
