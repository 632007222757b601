"""Smooth laws that soften: limit loads, landings, events and states beside closed forms and roots in 40 digits."""

import json
import math
import pickle
import random

import gapbeam
import mpmath as mp
import numpy as np
import pytest
from gapbeam import SceneError
from oracle.smooth import Problem
from scipy.optimize import brentq

from .test_laws import SNAP, midspan

C1 = {"type": "cubic", "k1": 9.0, "k2": -6.0, "k3": 1.0}
"""Reference problem C1: on a beam of stiffness 1 the load is w + 9 w - 6 w**2 + w**3."""
TOP, FOOT = 2 - math.sqrt(2 / 3), 2 + math.sqrt(2 / 3)
LIMIT, LOWER = 4 + 4 / 3 * math.sqrt(2 / 3), 4 - 4 / 3 * math.sqrt(2 / 3)
LANDING = 2 + 2 * math.sqrt(2 / 3)


def c1(force=10.0, **analysis):
    return midspan(C1, force, 1 / 48, analysis)


def load(w):
    return w + 9 * w - 6 * w**2 + w**3


def energy(w):
    """Of beam and support, without that of the load."""
    return w**2 / 2 + 9 * w**2 / 2 - 2 * w**3 + w**4 / 4


def near(value, tolerance=1e-12):
    return pytest.approx(value, rel=tolerance, abs=tolerance)


@pytest.mark.parametrize("at_limit", ["stop", "jump", "follow"])
@pytest.mark.parametrize("sign", [1, -1])
def test_the_limit_load_of_a_smooth_law(at_limit, sign):
    side = "below" if sign > 0 else "both"
    result = gapbeam.solve(midspan(C1, 10.0 * sign, 1 / 48, {"at_limit": at_limit}, side=side))
    limit = result.limits[0]
    assert (limit.kind, limit.causes, limit.exact, len(result.limits), result.events) == ("limit", (), True, 1, [])
    assert limit.factor == near(LIMIT / 10)
    assert sign * limit.landing.deflection[1] == near(LANDING)
    assert sign * limit.landing.reaction[1] == near(LIMIT - LANDING)
    assert limit.released == near(energy(TOP) - energy(LANDING) - LIMIT * (TOP - LANDING))
    assert all(step.exact and step.certificate["error_bound"] < 1e-12 for step in result.steps)
    deflections = [sign * step.deflection[1] for step in result.steps]
    ends = [(s.start, s.stop, s.stable, s.index) for s in result.segments]
    end = float(mp.findroot(lambda w: load(w) - 10, 4.2))
    if at_limit == "stop":
        assert result.status == "limit-load"
        assert result.reason == "limit load: the load cannot grow beyond load factor 0.50886621079"
        assert (ends, deflections) == ([(0.0, near(LIMIT / 10), True, 0)], near([TOP]))
    elif at_limit == "jump":
        assert result.status == "solved"
        assert ends == [(0.0, near(LIMIT / 10), True, 0), (near(LIMIT / 10), 1.0, True, 0)]
        assert deflections == near([TOP, end])
    else:
        lower = near(LOWER / 10)
        assert ends == [(0.0, near(LIMIT / 10), True, 0), (near(LIMIT / 10), lower, False, 1), (lower, 1.0, True, 0)]
        assert deflections == near([TOP, FOOT, end])


def test_states_between_are_on_the_law():
    result = gapbeam.solve(c1(at_limit="follow"))
    for factor in [0.1, 0.3, 0.4, 0.5, LIMIT / 10 * (1 - 1e-9), 0.7]:
        found = []
        for segment in result.segments:
            if min(segment.start, segment.stop) <= factor <= max(segment.start, segment.stop):
                step = result.path.step(segment, factor)
                assert step.exact
                found.append(float(step.deflection[1]))
        # Near the limit deflections change by much more than the load
        roots = np.roots([1, -6, 10, -10 * factor])
        assert sorted(found) == pytest.approx(sorted(root.real for root in roots if root.imag == 0.0), rel=1e-10)
        assert [load(w) for w in found] == near([10 * factor] * len(found))
    for rule in ("block", "single"):
        stepped = gapbeam.solve(c1(follow="steps", steps=10, at_limit="jump"), rule=rule)
        ways = [load(step.deflection[1]) / 10 for step in stepped.steps]
        assert ways == near([k / 10 for k in range(1, 11)])


@pytest.mark.parametrize("change", [1e-12, 1e-6, 1e-3, 0.004, 0.02, -1e-6, -1e-3, -0.004, -0.02])
@pytest.mark.parametrize("at_limit", ["stop", "jump", "follow"])
def test_a_load_near_the_limit(change, at_limit):
    """Whether the limit is passed is told by the law, not by its polyline."""
    result = gapbeam.solve(c1(LIMIT * (1 + change), at_limit=at_limit))
    assert len(result.limits) == int(change > 0)
    assert result.status == ("limit-load" if change > 0 and at_limit == "stop" else "solved")
    if change > 0:
        assert result.limits[0].factor == near(1 / (1 + change))
        assert result.limits[0].landing.deflection[1] == near(LANDING)
    else:
        assert load(result.steps[-1].deflection[1]) == near(LIMIT * (1 + change))
        assert result.steps[-1].deflection[1] < TOP


def test_a_history():
    result = gapbeam.solve(c1(at_limit="jump", history=[1.0, 0.0, 0.8]))
    assert [(limit.leg, limit.exact) for limit in result.limits] == [(0, True), (1, True), (2, True)]
    assert [limit.factor for limit in result.limits] == near([LIMIT / 10, LOWER / 10, LIMIT / 10])
    assert [limit.landing.deflection[1] for limit in result.limits] == near([LANDING, 2 - 2 * math.sqrt(2 / 3), LANDING])
    assert result.steps[-1].deflection[1] == near(4.0)

def test_a_history_that_turns_back_within_the_error_of_the_polyline():
    """What comes after cannot be told then."""
    for change in (1e-3, -1e-3):
        result = gapbeam.solve(c1(at_limit="jump", history=[LIMIT / 10 * (1 + change), 0.0]))
        assert len(result.limits) == (2 if change > 0 else 0)
    peak = {**C1, "k2": -5.9}  # not at a kink of its polyline
    limit = gapbeam.solve(midspan(peak, 10.0, 1 / 48)).limits[0].factor
    with pytest.raises(gapbeam.EngineError, match=r"is so near a limit load that the smooth laws"):
        gapbeam.solve(midspan(peak, 10.0, 1 / 48, {"at_limit": "jump", "history": [limit * (1 - 1e-9), 0.0]}))


@pytest.mark.parametrize("law", [C1, SNAP])
def test_limits_while_dead_loads_are_put_on(law):
    scene = midspan(law, 1.0, 1 / 48, {"at_limit": "stop"})
    scene["loads"].append({"type": "force", "node": 1, "F": 10.0, "case": "dead"})
    smooth = law is C1
    for at_limit in ("stop", "jump"):
        scene["analysis"]["at_limit"] = at_limit
        result = gapbeam.solve(scene)
        limit = result.limits[0]
        assert (limit.leg, limit.exact) == (-1, True)
        assert limit.factor == near(LIMIT / 10 if smooth else 0.5)
        assert limit.landing.deflection[1] == near(LANDING if smooth else 3.25)
        assert limit.released == near(3.0 if smooth else 1.6875)
    assert result.steps[-1].deflection[1] == near(float(mp.findroot(lambda w: load(w) - 11, 4.2)) if smooth else 6.25)
    scene["supports"][2]["settlement"] = 0.001
    assert gapbeam.solve(scene).limits[0].landing is None


@pytest.mark.parametrize("gap", [1.0, 2.5, 3.2])
def test_events_of_others_are_on_the_law(gap):
    """A spring at the quarter closes when the middle has come to `gap`: on the way up, down, and up again."""
    scene = c1(at_limit="follow")
    scene["supports"].append({"x": 0.25, "side": "below", "gap": gap * 11 / 16, "stiffness": 2.0})
    result = gapbeam.solve(scene)
    assert [event.event for event in result.events] == ["closes"]
    assert result.events[0].factor == near(load(gap) / 10)
    assert all(segment.exact for segment in result.segments)
    scene["analysis"]["at_limit"] = "jump"
    jumped = gapbeam.solve(scene)
    assert jumped.limits[0].factor == near(result.limits[0].factor)
    assert jumped.limits[0].released == near(result.limits[0].released)
    assert jumped.steps[-1].deflection == near(result.steps[-1].deflection)


def test_a_brittle_support_beside_it():
    scene = c1(at_limit="follow")
    scene["supports"].append({"x": 0.25, "side": "below", "law": {"type": "brittle", "stiffness": 3.0, "limit": 3.0}})
    result = gapbeam.solve(scene)
    assert all(segment.exact for segment in result.segments)
    assert [event.event for event in result.events] == ["breaks"]
    # With u the deflection at the quarter: simple beam, forces P less r in the middle and the brittle one's there
    with mp.workdps(30):
        quarter, middle, both = 3 * 48 / mp.mpf(256), mp.mpf(1), mp.mpf(11) / 16

        def at_break(w, P):
            r = 9 * w - 6 * w**2 + w**3
            return [middle * (P - r) - both * 3 - w, both * (P - r) - quarter * 3 - 1]

        _, P = mp.findroot(at_break, (2.0, 6.4))
    assert result.events[0].factor == near(float(P) / 10)


def test_a_balance_with_two_softening_tips():
    """Equal tips about a pin: the beam tips over, at constant sum, where the slope of the law is zero."""
    k1, size = 100.0, 0.0625
    law = {"type": "cubic", "k1": k1, "k2": -1.95 * k1 / size, "k3": k1 / size**2}
    scene = {
        "beam": {"spans": [1.0, 1.0], "EI": 20.0},
        "supports": [{"node": 0, "side": "below", "law": law}, {"node": 1}, {"node": 2, "side": "below", "law": law}],
        "loads": [{"type": "force", "node": node, "F": 10.0} for node in (0, 2)],
        "analysis": {"follow": "events"},
    }
    w = (1.95 - math.sqrt(1.95**2 - 3)) / 3 * size
    force = 60 * w + w * (k1 + law["k2"] * w + law["k3"] * w**2)
    limit = gapbeam.solve(scene).limits[0]
    assert (limit.kind, limit.exact) == ("bifurcation", True)
    assert limit.factor == near(force / 10)
    # It comes to rest where both tips carry what is left of the load beyond the bending of the cantilevers
    tips = limit.landing.deflection[[0, 2]]
    r = [d * (k1 + law["k2"] * d + law["k3"] * d * d) for d in tips]
    assert r[0] == near(r[1], 1e-10)
    assert abs(tips[0] - tips[1]) > 0.05
    assert r[0] + 60 * tips.mean() == near(force, 1e-11)
    # With one load a little greater it is a limit point; what is not resolved says so
    scene["loads"][1]["F"] = 10.01
    assert gapbeam.solve(scene).limits[0].kind == "limit"
    scene["analysis"]["at_limit"] = "follow"
    scene["loads"][1]["F"] = 10.0
    followed = gapbeam.solve(scene)
    rough = [segment for segment in followed.segments if not segment.exact]
    assert rough
    assert "Known on the polylines of the smooth laws only" in gapbeam.report.text.report_text(followed)
    data = json.loads(gapbeam.report.to_json(followed, points=2))
    assert sum("exact" in step for step in data["steps"]) == len(rough)


def test_pickled_and_drawn(tmp_path):
    result = gapbeam.solve(c1(at_limit="follow"))
    again = pickle.loads(pickle.dumps(result))
    assert again == result
    assert again.state(0.7) == result.state(0.7)
    trace = gapbeam.plots.branches.Trace(result)
    assert len(trace.spans) == 3
    at = np.array([step.deflection[1] for step in trace.states])
    assert trace.factors * 10 == pytest.approx(load(at), rel=1e-11, abs=1e-12)
    assert (np.diff(at) > -1e-12).all()
    gapbeam.plots.plot_path(result, tmp_path / "c1.svg")


def test_mirrored_and_positive_k2():
    law = {"type": "cubic", "k1": 100.0, "k2": 1e3, "k3": 0.0}
    for sign in (1, -1):
        step = gapbeam.solve(midspan(law, 3.0 * sign, side="both")).steps[-1]
        assert sign * step.deflection[1] == near((-148 + math.sqrt(148**2 + 12e3)) / 2e3)
    assert gapbeam.solve(midspan({"type": "cubic", "k1": 0.0, "k2": 2.0, "k3": 0.0})).steps[-1].state[1] == "branch 1"
    almost = {"type": "cubic", "k1": 0.9, "k2": -0.6, "k3": 0.1}
    assert gapbeam.solve(midspan(almost, 0.1)).status == "solved"
    with pytest.raises(SceneError, match=r"law\.k2: expected -2\*sqrt\(k1\*k3\) = -0\.6 or more"):
        gapbeam.solve(midspan({**almost, "k2": -0.6001}, 0.1))


# Beside the independent solution


def drawn(seed):
    """A simple beam on one to three supports with softening laws."""
    rng = random.Random(seed)
    count = rng.randint(1, 3)
    places = sorted(rng.sample([k / 16 for k in range(2, 15)], count))
    EI = rng.choice([0.5, 1.0, 2.0])
    laws = []
    for _ in range(count):
        size, k1, share = rng.choice([0.0078125, 0.015625, 0.03125]), rng.uniform(50, 3000) * EI, rng.uniform(1.6, 2.0)
        laws.append((k1, -share * k1 / size, k1 / size**2))
    peak = sum(k1 * (k1 / k3) ** 0.5 for k1, _, k3 in laws)
    loads = [(rng.choice([k / 16 for k in range(2, 15)]), peak * rng.uniform(0.2, 1.5)) for _ in range(rng.randint(1, 2))]
    return places, laws, loads, EI


def described(places, laws, loads, EI, at_limit):
    return {
        "beam": {"spans": [1.0], "EI": EI},
        "supports": [
            {"node": 0},
            {"node": 1},
            *(
                {"x": x, "side": "below", "law": {"type": "cubic", "k1": k1, "k2": k2, "k3": k3}}
                for x, (k1, k2, k3) in zip(places, laws, strict=True)
            ),
        ],
        "loads": [{"type": "force", "x": x, "F": F} for x, F in loads],
        "analysis": {"follow": "events", "at_limit": at_limit},
    }


def apart(step, exact):
    """Largest difference of deflections, relative to the largest."""
    exact = np.array(exact, dtype=float)
    return np.abs(step.deflection[2:] - exact).max() / np.abs(exact).max()


def test_random_paths():
    """A few have turns smaller than the error of the polylines, or a turn and an event in one step of the other solution."""
    turned, left_out = 0, []
    for seed in range(25):
        scene = drawn(seed)
        problem = Problem(*scene)
        rows = problem.follow(1.0)
        expected = problem.happenings(rows)
        result = gapbeam.solve(described(*scene, "follow"))
        if not all(getattr(segment, "exact", True) for segment in result.segments) or expected is None:
            left_out.append(seed)
            continue
        assert result.status == "solved", seed
        assert [step.factor for step in result.steps] == near([float(factor) for _, factor in expected] + [1.0]), seed
        assert [event.factor for event in result.events] == near([float(factor) for x, factor in expected if x is None]), seed
        for step, (x, _) in zip(result.steps, expected, strict=False):
            assert x is None or apart(step, x) < 1e-9, seed
        assert apart(result.steps[-1], problem.state(rows[-1][0], mp.mpf(1))) < 1e-12, seed
        half = float(expected[0][1] if expected else 1) / 2
        there = problem.state(min(rows, key=lambda row: abs(row[0][-1] - half) + (row[0][-1] > 2 * half))[0], mp.mpf(half))
        assert apart(result.state(half), there) < 1e-12 or len(result.segments) > 1, seed
        turns = [factor for x, factor in expected if x is not None]
        if not turns:
            continue
        turned += 1
        first = next(k for k, row in enumerate(rows) if row[1] < 0)
        landed = next(y for y, way, sign, _ in rows[first:] if way > 0 and sign > 0 and y[-1] >= turns[0])
        there = problem.state(landed, turns[0])
        released = set()
        for at_limit in ("stop", "jump") if turned % 4 == 0 else ("jump",):  # up to the limit both do the same
            other = gapbeam.solve(described(*scene, at_limit))
            limit = other.limits[0]
            assert limit.exact, seed
            assert limit.factor == near(float(turns[0])), seed
            assert apart(limit.landing, there) < 1e-12, seed
            assert other.status == ("limit-load" if at_limit == "stop" else "solved")
            released.add(limit.released)
        assert max(released) == pytest.approx(min(released), rel=1e-9)
        assert min(released) > 0.0
    assert turned > 6
    assert len(left_out) < 3, left_out


def test_a_path_ends_at_its_last_load_factor():
    """Not a digit before it, where no step was: a result without any was called solved."""
    plastic, power = {"type": "plastic", "stiffness": 43666.47, "limit": 39.3}, {"type": "power", "d0": 0.02, "limit": 20.0, "n": 2}
    supports = [{"node": 0, "side": "both", "gap": 0.003, "law": plastic}, {"node": 1, "side": "both", "gap": 0.02, "law": power}]
    beam = {"spans": [2.0], "EI": 900.0}
    for q in np.arange(1.0, 5.0, 0.25):
        result = gapbeam.solve({"beam": beam, "supports": supports, "loads": [{"type": "uniform", "q": q}]})
        assert [s.stop for s in result.segments][-1] == 1.0
        assert result.steps[0].reaction == near(np.array([q, q]))


def test_a_path_that_does_not_begin():
    """Nothing resists the load from the start: there is no stretch to put onto the laws."""
    supports = [{"node": 0, "side": "below", "gap": 0.001, "law": {"type": "tanh", "stiffness": 800.0, "limit": 33.0}},
                {"node": 1, "side": "both", "gap": 0.02, "law": {"type": "plastic", "stiffness": 3e4, "limit": 14.0}}]  # fmt: skip
    result = gapbeam.solve({"beam": {"spans": [4.0], "EI": 400.0}, "supports": supports, "loads": [{"type": "uniform", "q": -2.0}]})
    assert (result.status, [limit.kind for limit in result.limits], len(result.steps)) == ("limit-load", ["mechanism"], 0)
    assert result.reason.startswith("limit load: nothing more resists the load beyond load factor 0")
    assert result.limits[0].exact


def test_a_steep_curve_that_just_begins_to_act():
    """Its force is told by the last digit of the deflection there."""
    steep = {"type": "power", "d0": 0.005, "limit": 30.0, "n": 0.3}
    yields = {"x": 20.0, "law": [[0.005, 30.0], [0.03, 30.0]], "unloading": "plastic"}
    supports = [{"x": 14.02, "side": "below", "law": steep}, yields, {"x": 3.0, "settlement": -0.004}]
    loads = [{"type": "linear", "q": [0.621, 8.78]}]
    result = gapbeam.solve({"beam": {"spans": [20.0], "EI": 8000.0}, "supports": supports, "loads": loads})
    (closes,) = [one.factor for one in result.events if one.event == "closes"]
    assert 0.0 < closes < 0.01
    assert abs(result.state(closes).reaction[0]) < 1e-9
    assert len(result.to_dict()["steps"]) == 1


def test_a_support_that_keeps_a_set_beside_a_curve():
    """What it turns back from is where the curve leads it: its load and deflection by statics, with w0 = atanh(R0/60) 60/3000."""
    F, L, EI = 80.0, 6.0, 4500.0

    def middle(load, plastic):
        end = (load - plastic) / 2.0
        return math.atanh(end / 60.0) * 0.02 / 2.0 + (load - plastic) * L**3 / (48.0 * EI)

    made = {
        "beam": {"spans": [L], "EI": EI},
        "supports": [{"node": 0, "law": {"type": "tanh", "stiffness": 3000.0, "limit": 60.0}}, {"node": 1},
                     {"x": 3.0, "law": [[0.01, 20.0], [0.1, 20.0]], "unloading": "plastic"}],
        "loads": [{"type": "force", "x": 3.0, "F": F}], "analysis": {"follow": "events", "history": [1.0, 0.0, 0.8]},
    }  # fmt: skip
    result = gapbeam.solve(made)
    reached = middle(F, 20.0)
    assert result.state(1.0, leg=0).deflection[2] == pytest.approx(reached, rel=1e-14)
    for factor in (1.0 - 1e-9, 0.9, 0.5, 0.3):  # back, by 2000 over the way from where it turned
        plastic = brentq(lambda R, f=factor: middle(f * F, R) - (reached - (20.0 - R) / 2000.0), -20.0, 20.0, xtol=1e-15)
        step = result.state(factor, leg=1)
        assert step.exact
        assert step.reaction[2] == pytest.approx(plastic, rel=1e-12)
        assert step.set[2] == pytest.approx(reached - 0.01, rel=1e-13)
    lowest = middle(0.0, -20.0)
    assert result.state(0.0, leg=1).deflection[2] == pytest.approx(lowest, rel=1e-12)
    for factor in (0.1, 0.6):
        plastic = brentq(lambda R, f=factor: middle(f * F, R) - (lowest + (R + 20.0) / 2000.0), -20.0, 20.0, xtol=1e-15)
        assert result.state(factor, leg=2).reaction[2] == pytest.approx(plastic, rel=1e-11)
    assert [segment.exact for segment in result.segments if segment.leg == 0] == [True, True]
    assert not any(segment.exact for segment in result.segments if segment.leg > 0)  # where it yields is known on the polyline


def test_a_steep_curve_at_an_event_that_is_not_found_on_the_laws():
    """What its polyline leaves out where it begins is no force that the law does not give."""
    steep = {"x": 0, "law": {"type": "power", "d0": 0.005, "limit": 50, "n": 0.3}, "rotation": 100.0}
    loads = [{"type": "movement", "support": 0, "value": 0.008}, {"type": "force", "x": 6.0, "F": 40}]
    scene = {"beam": {"spans": [9], "EI": 2e4}, "supports": [{"x": 4.0, "side": "below", "gap": 0.02}, steep], "loads": loads}
    step = gapbeam.solve({**scene, "analysis": {"follow": "events"}}).steps[0]
    assert step.reaction == pytest.approx([0.0, 40 * step.factor])
    assert abs(step.deflection[1]) < 0.005 * 2.0**-22
