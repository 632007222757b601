"""Supports whose law is a curve on beams that are solved in stretches: under axial forces, on ground, with mass."""

import math
from copy import deepcopy

import gapbeam
import numpy as np
import pytest
from mpmath import mp, mpf

EI, L = 1e4, 6.0
LAWS = {
    "tanh": ({"type": "tanh", "stiffness": 4e3, "limit": 20.0}, lambda d: 20 * mp.tanh(200 * d)),
    "hyperbolic": ({"type": "hyperbolic", "stiffness": 4e3, "limit": 20.0}, lambda d: 4000 * d / (1 + 200 * d)),
    "cubic": ({"type": "cubic", "k1": 1e3, "k2": -1e5, "k3": 2e7}, lambda d: 1000 * d - 100000 * d**2 + 20000000 * d**3),
    "square root": ({"type": "power", "d0": 0.015625, "limit": 20.0, "n": 0.5}, lambda d: 20 * mp.sqrt(64 * d)),
    "square": ({"type": "power", "d0": 0.015625, "limit": 20.0, "n": 2.0}, lambda d: 20 * (64 * d) ** 2),
}


def span(law, more=None, **support):
    """A simple span with a force on a support in its middle."""
    return {
        "beam": {"spans": [L / 2, L / 2], "EI": EI} | (more or {}),
        "supports": [{"node": 0}, {"node": 1, "side": "below", "law": law, **support}, {"node": 2}],
        "loads": [{"type": "force", "x": L / 2, "F": 60.0}],
    }


def compliance(n):
    """Deflection in the middle under a unit force there: with tension, and with compression."""
    if n == 0:
        return mpf(L) ** 3 / (48 * mpf(EI))
    k = mp.sqrt(abs(mpf(n)) / EI)
    bent = mp.tanh(k * L / 2) if n > 0 else mp.tan(k * L / 2)
    return (mpf(L) / 4 - bent / (2 * k)) / n


@pytest.mark.parametrize("n", [0.0, 3e3, -2e3, 4e5])
@pytest.mark.parametrize("name", LAWS)
def test_states_beside_an_axial_force(name, n):
    law, force = LAWS[name]
    with mp.workdps(40):
        soft = compliance(n)
        # w = (F - R(w)) soft
        w = mp.findroot(lambda w: w - soft * (60 - force(w)), (mpf(0), 60 * soft), solver="anderson", tol=1e-60)
        wanted = float(w), float(force(w))
    result = gapbeam.solve(span(law, {"N": n} if n else {}))
    assert (result.steps[-1].deflection[1], result.steps[-1].reaction[1]) == pytest.approx(wanted, rel=2e-14)


@pytest.mark.parametrize("n", [3e3, -2e3])
@pytest.mark.parametrize("name", LAWS)
def test_factors_at_which_they_close(name, n):
    """Of two of them: the second one beside the first, on its curve."""
    law, force = LAWS[name]
    scene = span(law, {"N": n}, gap=0.002)
    scene["analysis"] = {"follow": "events"}
    scene["supports"].insert(2, {"x": L / 2, "side": "below", "gap": 0.004, "law": law})
    with mp.workdps(40):
        soft, first = compliance(n), mpf(0.002)
        second = mpf(0.004)
        wanted = [float(first / (60 * soft)), float((second / soft + force(second - first)) / 60)]
    result = gapbeam.solve(scene)
    assert [event.event for event in result.events] == ["closes", "closes"]
    assert [event.factor for event in result.events] == pytest.approx(wanted, rel=1e-12)


@pytest.mark.parametrize("name", ["tanh", "hyperbolic"])
def test_a_limit_that_a_curve_tends_to(name):
    """The path ends next to it, in a state that stands; it is known to all digits."""
    law = LAWS[name][0]
    scene = span(law, {"mass": 1.0})
    scene["supports"] = [{"node": 0, "side": "below", "law": law}, {"node": 2, "side": "below"}]
    scene["analysis"] = {"follow": "events", "frequencies": 1}
    plain = deepcopy(scene) | {"beam": {"spans": [L / 2, L / 2], "EI": EI}, "analysis": {"follow": "events"}}
    for one in (scene, plain):
        result = gapbeam.solve(one)
        assert result.status == "limit-load"
        assert "0.666666666667" in result.reason  # 2 * 20/60
        assert 2 / 3 * (1 - 1e-5) < result.steps[-1].factor < 2 / 3
        assert "Limit load (mechanism) at 66.667 % of the load." in result.report()
        assert gapbeam.solve(one | {"analysis": {}}).status == "no-equilibrium"


def test_modes_are_those_on_the_slope_of_the_curve():
    law = LAWS["tanh"][0]
    asked = {"buckling": 2, "frequencies": 2}
    scene = span(law, {"N": -2e3, "mass": 0.3}) | {"analysis": asked}
    curved = gapbeam.solve(scene)
    w = curved.steps[-1].deflection[1]
    straight = deepcopy(scene)
    straight["supports"][1] = {"node": 1, "stiffness": 4e3 / math.cosh(200 * w) ** 2}
    other = gapbeam.solve(straight)
    assert curved.buckling == pytest.approx(other.buckling, rel=1e-12)
    assert curved.frequencies == pytest.approx(other.frequencies, rel=1e-12)


@pytest.mark.parametrize(
    "ground", [{"k": 300.0}, {"k": 3e4, "side": "below", "gap": 0.001}, {"k": math.inf, "side": "below", "gap": 0.002}]
)
def test_states_on_ground(ground):
    """As beside a spring both ways that gives the same force there."""
    law, force = LAWS["hyperbolic"]
    scene = span(law) | {"foundation": [ground]}
    step = gapbeam.solve(scene).steps[-1]
    w, r = step.deflection[1], step.reaction[1]
    assert r == pytest.approx(float(force(w)), rel=1e-13)
    scene["supports"][1] = {"node": 1, "stiffness": 1e3, "settlement": w - r / 1e3}
    other = gapbeam.solve(scene).steps[-1]
    assert step.reaction == pytest.approx(other.reaction, rel=1e-12)
    assert w == pytest.approx(other.deflection[1], rel=1e-12)


def test_a_zone_that_appears_beside_a_curve():
    """At a factor known to all digits, on the tangent there."""
    scene = span(LAWS["hyperbolic"][0]) | {"foundation": [{"k": 3e3, "side": "below", "gap": 0.008}]}
    (event,) = gapbeam.solve(scene | {"analysis": {"follow": "events"}}).events
    touched = float((mpf(0.008) / compliance(0) + LAWS["hyperbolic"][1](mpf(0.008))) / 60)
    assert (event.event, event.x) == ("zone appears", pytest.approx(L / 2))
    assert event.factor == pytest.approx(touched, rel=1e-13)


def test_both_ways_with_a_gap():
    """The curve is mirrored, and begins where the gap ends on either side."""
    scene = span(LAWS["hyperbolic"][0], {"N": 3e3}, side="both", gap=0.002) | {"analysis": {"follow": "events"}}
    down = gapbeam.solve(scene)
    up = gapbeam.solve(scene | {"loads": [{"type": "force", "x": L / 2, "F": -60.0}]})
    for result in (down, up):
        assert [(event.event, event.factor) for event in result.events] == [
            ("closes", pytest.approx(float(mpf(0.002) / (60 * compliance(3e3))), rel=1e-13))
        ]
        assert result.steps[-1].state[1] == "branch 1"
    assert up.steps[-1].reaction == pytest.approx(-down.steps[-1].reaction, rel=1e-14)
    assert up.state(0.01).state[1] == "open"


def test_axial_loads_bend_beside_curves():
    """They were of first order there."""
    scene = span(LAWS["tanh"][0], {"EA": 1e6})
    scene["supports"] += [{"node": 0, "direction": "axial"}]
    pulled = gapbeam.solve(scene | {"loads": [*scene["loads"], {"type": "axial", "x": L, "F": 3e3}]})
    given = gapbeam.solve(span(LAWS["tanh"][0], {"N": 3e3}))
    assert pulled.steps[-1].reaction[:3] == pytest.approx(given.steps[-1].reaction, rel=1e-13)


def test_cases_and_combinations():
    scene = span(LAWS["hyperbolic"][0], {"N": 3e3})
    wanted = [gapbeam.solve(scene | {"loads": [{**scene["loads"][0], "F": 60.0 * f}]}).steps[-1].reaction for f in (0.5, 1.5)]
    cases = gapbeam.prepare(scene).solve(factors=[[0.5], [1.5]])
    assert cases.reaction == pytest.approx(np.array(wanted), rel=1e-13)


@pytest.mark.parametrize(
    ("more", "what"),
    [
        ({"foundation": [{"law": [[0.01, 5.0], [0.02, 1.0], [0.03, 1.0]]}]}, "a curve beside a foundation whose force falls"),
        ({"foundation": [{"k": 1.0}], "analysis": {"follow": "events", "history": [1.0, 0.0]}}, "a curve with a history"),
    ],
)
def test_refusals(more, what):
    with pytest.raises((gapbeam.SceneError, gapbeam.EngineError), match=rf"supports\[1\]\.law: {what}.*; give its points"):
        gapbeam.solve(span(LAWS["tanh"][0]) | more)
