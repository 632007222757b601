"""Smooth laws of supports, beside roots in many digits."""

import re

import gapbeam
import mpmath as mp
import numpy as np
import pytest

from .test_laws import midspan

CURVES = {
    "cubic": ({"type": "cubic", "k1": 100.0, "k3": 1e5}, lambda d: 100 * d + 100000 * d**3),
    "without k1": ({"type": "cubic", "k1": 0.0, "k3": 1e5}, lambda d: 100000 * d**3),
    "hyperbolic": ({"type": "hyperbolic", "stiffness": 1000.0, "limit": 2.0}, lambda d: 1000 * d / (1 + 500 * d)),
    "tanh": ({"type": "tanh", "stiffness": 1000.0, "limit": 2.0}, lambda d: 2 * mp.tanh(500 * d)),
    "cube root": ({"type": "power", "d0": 0.015625, "limit": 2.0, "n": 1 / 3}, lambda d: 2 * (64 * d) ** mp.mpf(1 / 3)),
    "power 3": ({"type": "power", "d0": 0.015625, "limit": 2.0, "n": 3.0}, lambda d: 2 * (64 * d) ** 3),
}


def root(function, high):
    """Root of a rising function between 0 and `high`, to 40 digits."""
    with mp.workdps(40):
        between = mp.mpf(0), 2 * mp.mpf(high)
        return mp.findroot(function, between, solver="bisect", tol=mp.mpf(10) ** -80, maxsteps=2000, verify=False)


@pytest.mark.parametrize("name", CURVES)
@pytest.mark.parametrize("load", [1e-6, 0.5, 3.0, 1e4])
@pytest.mark.parametrize(("side", "sign", "gap"), [("below", 1, 0.0), ("above", -1, 0.001), ("both", -1, 0.0), ("both", 1, 0.001)])
def test_a_curve_beside_a_beam(name, load, side, sign, gap):
    law, curve = CURVES[name]
    expected = root(lambda w: 48 * w + (curve(w - gap) if w > gap else 0) - load, load / 48)
    for follow in ("steps", "events"):
        step = gapbeam.solve(midspan(law, load * sign, side=side, gap=gap, analysis={"follow": follow})).steps[-1]
        assert sign * step.deflection[1] == pytest.approx(float(expected), rel=2e-15)
        assert sign * step.reaction[1] == pytest.approx(float(load - 48 * expected), rel=1e-12, abs=1e-15)
        assert step.state[1] == ("branch 1" if expected > gap else "open")
        assert step.opening[1] == pytest.approx(max(float(gap - expected), 0.0), rel=1e-13, abs=1e-18)
        assert step.certificate["error_bound"] < 1e-11


@pytest.mark.parametrize("name", CURVES)
@pytest.mark.parametrize("place", [{"settlement": 0.003}, {"settlement": -0.003}, {"gap": -0.003, "side": "below"}])
def test_a_curve_that_begins_away_from_the_straight_beam(name, place):
    """A simple beam, one end of which is such a support: it has half of the load, at any factor."""
    law, curve = CURVES[name]
    supports = [{"node": 0, "law": law, **place}, {"node": 1}]
    made = {"beam": {"spans": [6.0], "EI": 3000.0}, "supports": supports, "loads": [{"type": "uniform", "q": 0.5}]}
    result = gapbeam.solve({**made, "analysis": {"follow": "events"}})
    for factor in (1e-9, 1e-3, 0.5, 1.0):
        step = result.state(factor)
        expected = 1.5 * factor
        assert step.reaction.tolist() == pytest.approx([expected, expected], rel=1e-14)
        past = root(lambda d, load=expected: curve(d) - load, 0.25)
        assert step.deflection[0] == pytest.approx(float(past) + place.get("settlement", -0.003), rel=1e-13)


def test_factors_of_events_are_those_on_the_curve():
    """A rigid stop at 0.01 beside a spring that is a curve: only contact is an event."""
    law, curve = CURVES["tanh"]
    scene = midspan(law, 3.0)
    scene["supports"].insert(2, {"x": 0.25, "side": "below", "gap": 0.0078125})
    result = gapbeam.solve(scene)
    # Deflection at the quarter is 11/16 of that in the middle, as there is a force in the middle only
    middle = mp.mpf(0.0078125) * 16 / 11
    expected = (48 * middle + curve(middle)) / 3
    assert [(e.support, e.event) for e in result.events] == [(2, "closes")]
    assert result.events[0].factor == pytest.approx(float(expected), rel=1e-14)
    assert len(result.segments) == 2
    assert result.state(0.3).deflection[1] == pytest.approx(float(root(lambda w: 48 * w + curve(w) - 0.9, 0.1)), rel=2e-15)


def test_a_pile_on_curves_of_growing_strength():
    """Ten curves of one kind: equilibrium of every support with its own law, and of all with the loads."""
    supports = [
        {"x": float(i), "side": "both", "law": {"type": "power", "d0": 0.01, "limit": 2.0 * (i + 1), "n": 1 / 3}} for i in range(10)
    ]
    scene = {
        "beam": {"spans": [9.0], "EI": 2e4},
        "supports": supports,
        "loads": [{"type": "force", "x": 0.0, "F": 12.0}],
    }
    step = gapbeam.solve(scene).steps[-1]
    laws = [np.sign(w) * 2.0 * (i + 1) * (abs(w) / 0.01) ** (1 / 3) for i, w in enumerate(step.deflection)]
    assert step.reaction == pytest.approx(np.array(laws), rel=1e-12)
    assert step.reaction.sum() == pytest.approx(12.0, rel=1e-12)
    assert (step.reaction * np.arange(10)).sum() == pytest.approx(0.0, abs=1e-11)


@pytest.mark.parametrize("name", ["cubic", "hyperbolic", "tanh"])
def test_a_curve_that_is_just_touched(name):
    """Where an overhang lifts off from it: no force there, and deflections elsewhere."""
    supports = [{"node": 0, "side": "below", "law": CURVES[name][0]}, {"node": 2}, {"node": 3, "side": "below", "gap": 0.002}]
    loads = [{"type": "uniform", "q": 1.7}, {"type": "force", "node": 3, "F": 40.0}]
    made = {"beam": {"spans": [2.8, 4.45, 2.05], "EI": 3140.0}, "supports": supports, "loads": loads}
    result = gapbeam.solve({**made, "analysis": {"follow": "events"}})
    (closes,) = [one.factor for one in result.events if one.event == "closes"]
    for segment in result.segments:
        if closes in (segment.start, segment.stop):
            step = result.path.step(segment, closes)
            assert abs(step.reaction[0]) < 1e-12 * np.abs(step.reaction).max()
            assert abs(step.deflection[0]) < 1e-12


@pytest.mark.parametrize(
    "law",
    [{"type": "tanh", "stiffness": 500.0, "limit": 80.0}, {"type": "hyperbolic", "stiffness": 500.0, "limit": 80.0},
     {"type": "cubic", "k1": 300.0, "k3": 1e5}],
)  # fmt: skip
@pytest.mark.parametrize("side", ["both", "below"])
def test_a_settled_support_that_next_to_nothing_reaches(side, law):
    """R = k (d F/F0 - s) to first order, which the last digits of the deflection leave; tangents were not taken for settled."""
    EI, s = 3000.0, 0.006
    stiffness = law.get("stiffness", law.get("k1"))
    for L in np.linspace(3.0, 8.0, 13):
        # Of the beam without the support, in the middle of its two spans under a force at 0.4 of the first
        softness = 2 * L**3 / (12 * EI) * 0.2 * (3 - 4 * 0.2**2)
        beside = 1 + stiffness * (2 * L) ** 3 / (48 * EI)
        supports = [{"node": 0}, {"node": 1, "side": side, "law": law, "settlement": s}, {"node": 2}]
        for share in (0.0, 1e-16, -1e-16, 3e-16, -1e-14, 1e-13, -1e-12):
            loads = [{"type": "force", "x": 0.4 * L, "F": s / softness * (1 + share)}]
            made = {"beam": {"spans": [L, L], "EI": EI}, "supports": supports, "loads": loads}
            expected = stiffness * s * (share if side == "both" else max(share, 0.0)) / beside
            assert gapbeam.solve(made).steps[-1].reaction[1] == pytest.approx(expected, abs=16e-16 * stiffness * s)


def test_a_compressed_beam_without_loads_on_a_curve():
    """At the origin a curve has its slope; a force of nothing was taken for a flat part, and the beam was held by nothing."""
    law = {"type": "tanh", "stiffness": 2000.0, "limit": 180.0}
    made = {"beam": {"spans": [7.8], "EI": 30000.0, "N": -3.4}, "supports": [{"node": 0, "law": law}, {"node": 1}], "loads": []}
    assert gapbeam.solve(made).status == "solved"


def test_a_force_of_next_to_nothing_beside_reactions():
    """The force on a curve that is met in an event is known to the last digit of the other reactions."""
    law = {"type": "tanh", "stiffness": 2925.7, "limit": 73.2}
    supports = [{"x": 19.67}, {"x": 16.47}, {"x": 12.56, "side": "below", "law": law}, {"x": 5.02}, {"x": 0.0}]
    loads = [{"type": "linear", "q": [-1.35, 7.67], "from": 9.8, "to": 18.45}, {"type": "force", "F": 3.52, "x": 10.17},
             {"type": "temperature", "dT": -0.1, "gradient": 9.4, "case": "dead"}]  # fmt: skip
    beam = {"spans": [5.02, 7.54, 3.91, 3.2], "EI": 1347.79, "alpha": 1.2e-05, "depth": 0.4}
    result = gapbeam.solve({"beam": beam, "supports": supports, "loads": loads, "analysis": {"follow": "events"}})
    (closes,) = result.events
    step = result.path.step(result.segments[-1], closes.factor)
    assert abs(step.reaction[2]) < 1e-13 * np.abs(step.reaction).max()


def test_a_support_that_opens_on_the_curve_only():
    """On the polyline of the law the end is still held; on the curve it would pull by 0.006, so it is open."""
    scene = {
        "beam": {"spans": [4.0, 4.0, 4.0], "EI": 200.0},
        "supports": [
            {"node": 0, "side": "below"}, {"node": 3, "side": "below"},
            {"node": 1, "side": "below", "gap": 0.002, "law": {"type": "tanh", "stiffness": 400.0, "limit": 15.0}},
            {"node": 2, "law": {"type": "hyperbolic", "stiffness": 400.0, "limit": 15.0}},
        ],
        "loads": [{"type": "uniform", "q": 0.5}, *({"type": "force", "x": x, "F": 10.0} for x in (4.8655, 6.3655))],
    }  # fmt: skip
    step = gapbeam.solve(scene).steps[-1]
    assert step.state == ("open", "open", "branch 1", "branch 1")
    assert step.opening[:2].min() > 0.0
    assert step.reaction.sum() == pytest.approx(26.0, rel=1e-13)


@pytest.mark.parametrize("follow", ["steps", "events"])
def test_loads_beyond_what_a_law_tends_to(follow):
    """Its polyline rises a little for ever, and held the beam some 1e12 away; the tangents then ended in an error."""
    law = {"type": "tanh", "stiffness": 1700.0, "limit": 31.0}
    supports = [{"node": 0, "side": "both", "gap": 0.001, "law": [[0.02, 3.2]]}, {"node": 2, "side": "below"}]
    supports.append({"node": 1, "side": "both", "gap": 0.001, "law": law})
    made = {"beam": {"spans": [2.5, 4.5], "EI": 2e3}, "supports": supports, "analysis": {"follow": follow}}
    result = gapbeam.solve({**made, "loads": [{"type": "uniform", "q": -4.0}]})
    if follow == "steps":
        assert (result.status, len(result.steps)) == ("no-equilibrium", 0)
        assert result.reason.startswith("no equilibrium at load factor 1: the beam tips about the support at x = 0: ")
    else:
        # 28 * 3.5 * factor = 31 * 2.5
        assert result.status == "no-equilibrium"
        assert float(re.search(r"above load factor ([0-9.]+):", result.reason)[1]) == pytest.approx(77.5 / 98, rel=1e-14)
        assert result.state(0.79).reaction == pytest.approx([8.848, 0.0, -30.968], rel=1e-12)
    assert gapbeam.solve({**made, "loads": [{"type": "uniform", "q": -3.0}]}).status == "solved"  # 21 * 3.5 < 31 * 2.5


def test_what_happens_beyond_the_end_on_the_curves_only():
    """On the polylines it lifts off at full load; it was followed to a load factor of 1.0074, where it does on the curve."""
    law = {"type": "cubic", "k1": 17.467762644554078, "k2": 1746.7762644554077, "k3": 63316.91138959399}
    scene = {
        "beam": {"spans": [6.0, 6.0], "EI": 1715.295908980719}, "analysis": {"follow": "events"},
        "supports": [{"node": 0, "side": "above", "gap": 0.005, "settlement": 0.001}, {"node": 1, "law": law},
                     {"node": 2, "settlement": 0.001}],
        "loads": [{"type": "force", "x": 10.21, "F": -8.0}],
    }  # fmt: skip
    result = gapbeam.solve(scene)
    assert [event.event for event in result.events] == ["closes"]
    assert result.steps[-1].factor == 1.0
    at_once = gapbeam.solve(scene | {"analysis": {}}).steps[-1]
    assert result.steps[-1].reaction == pytest.approx(at_once.reaction, rel=1e-12)


def test_a_curve_that_begins_steep_closes_where_it_is_met():
    """Past its beginning its deflection hardly grows; it closed at 0.0708256480 beside another curve."""
    scene = {
        "beam": {"spans": [6.0, 6.0, 4.0, 5.0], "EI": 6.4e4}, "loads": [{"type": "uniform", "q": 5.0}],
        "supports": [
            {"node": 0, "side": "below", "gap": 0.002, "law": {"type": "power", "d0": 0.0015, "limit": 8.0, "n": 0.5}},
            {"node": 1, "stiffness": 2.7e4}, {"node": 2, "law": {"type": "hyperbolic", "stiffness": 36.0, "limit": 1.4}},
            {"node": 3, "rotation": 6.4e4}, {"node": 4},
        ],
        "analysis": {"follow": "events"},
    }  # fmt: skip
    (event,) = gapbeam.solve(scene).events
    below, above = (
        gapbeam.solve(scene | {"loads": [{"type": "uniform", "q": 5.0 * event.factor * share}], "analysis": {}}).steps[-1]
        for share in (1 - 1e-12, 1 + 1e-12)
    )
    assert below.opening[0] > 0.0
    assert above.reaction[0] > 0.0


def test_an_event_next_to_a_curve_that_is_next_to_level():
    """Its slope of 1e-40 of the beam's gave a free end no deflection at all, and the event was at 0.4541."""
    scene = {
        "beam": {"spans": [6.0, 5.0, 3.0], "EI": 7331.474546899111}, "loads": [{"type": "uniform", "q": -1.5}],
        "supports": [
            {"node": 0, "side": "above", "law": {"type": "power", "d0": 0.0004526080385813654, "limit": 31.89713258527872, "n": 3}},
            {"node": 1, "law": {"type": "tanh", "stiffness": 18669.64888891069, "limit": 35.424183284876555}},
            {"node": 2, "side": "above", "gap": 0.005, "law": {"type": "cubic", "k1": 0.0, "k2": 0.0, "k3": 178897.2852748831}},
            {"node": 3, "side": "below"},
        ],
        "analysis": {"follow": "events"},
    }  # fmt: skip
    event = gapbeam.solve(scene).events[-1]
    load = [{"type": "uniform", "q": -1.5 * event.factor}]
    at_once = gapbeam.solve(scene | {"loads": load, "analysis": {}}).steps[-1]
    assert (event.support, event.event) == (0, "closes")
    assert abs(at_once.deflection[0]) < 1e-15


def test_an_event_just_beside_another_one():
    """The tangents led past a support that opens just before: it closed at 0.5587493."""
    scene = {
        "beam": {"spans": [6.0, 3.0, 2.0], "EI": 13289.370577379661, "GA": 66446.8528868983},
        "supports": [
            {"node": 0, "law": {"type": "tanh", "stiffness": 209.41386546201988, "limit": 1.3223630098940482}},
            {"node": 1, "side": "below", "gap": 0.005, "settlement": 0.001,
             "law": {"type": "cubic", "k1": 0.0, "k2": 0.0, "k3": 7563624.015758617}},
            {"node": 2, "side": "above"}, {"node": 3, "side": "below", "gap": 0.002},
        ],
        "loads": [{"type": "force", "x": 4.58, "F": 10.0}], "analysis": {"follow": "events"},
    }  # fmt: skip
    event = gapbeam.solve(scene).events[-1]
    assert (event.support, event.event) == (2, "closes")
    below, above = (
        gapbeam.solve(scene | {"loads": [{"type": "force", "x": 4.58, "F": 10.0 * event.factor * share}], "analysis": {}}).steps[-1]
        for share in (1 - 1e-11, 1 + 1e-11)
    )
    assert below.opening[2] > 0.0
    assert above.reaction[2] < 0.0
