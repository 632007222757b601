"""Beams that taper on elastic ground: beside the reference in 20 digits, a closed form, an integration, and themselves."""

import copy
import pickle
import random

import gapbeam
import mpmath as mp
import numpy as np
import pytest
from gapbeam.report.text import report_text
from oracle.foundation import solve as reference
from scenes.foundation import random_scene
from scenes.tapered import stiffness_along, with_tapers

from .test_foundations import assert_agrees, close

STRIP = {
    "units": {"force": "kN", "length": "m"}, "beam": {"spans": [8.0], "EI": 9e4, "GA": 2e6},
    "sections": [
        {"from": 0.0, "to": 4.0, "EI": {"from": 9e4, "to": 7.2e5, "power": 3}, "GA": [2e6, 4e6]},
        {"from": 4.0, "to": 8.0, "EI": {"from": 7.2e5, "to": 9e4, "power": 3}, "GA": [4e6, 2e6]},
    ],
    "foundation": [{"k": 5e4, "side": "below"}],
    "loads": [{"type": "uniform", "q": 20.0, "case": "dead"}, {"type": "force", "x": 4.0, "F": 900.0, "case": "dead"},
              {"type": "moment", "x": 4.0, "M": 1500.0}],
}  # fmt: skip
FIELDS = ("deflection", "rotation", "moment", "shear")


def test_random_tapers_agree_with_the_reference():
    solved = 0
    for seed in range(8):
        made = with_tapers(random.Random(seed), random_scene(seed))
        result = gapbeam.solve(made)
        with mp.workdps(40):
            right = reference(made, digits=20)
        assert result.status == right.status, seed
        if result.status != "solved":
            continue
        solved += 1
        assert_agrees(result, right, made, seed)
        for name in ("deflection", "moment", "shear"):
            extremes = result.steps[-1].extremes[name]
            of_right = [value for value, _ in right.extremes({"deflection": "w"}.get(name, name))]
            assert close([extremes[end].value for end in ("max", "min")], of_right, 1e-12), (seed, name)
    assert solved > 3


@pytest.mark.parametrize("k", [0.3, 40.0, 3e4])
def test_powers_of_the_depth(k):
    """EI = (1 + x)^4 on a constant modulus: w is a sum of powers a of 1 + x, a (a - 1) (a + 1) (a + 2) = -k."""
    length, F, Mo = 1.5, 2.0, -0.7
    made = {
        "beam": {"spans": [length], "EI": 1.0},
        "sections": [{"EI": {"from": 1.0, "to": (1.0 + length) ** 4, "power": 4}}],
        "foundation": [{"k": k}],
        "loads": [{"type": "force", "x": 0.0, "F": F}, {"type": "moment", "x": length, "M": Mo}],
    }
    result = gapbeam.solve(made)
    with mp.workdps(50):
        # (b^2 - 1/4) (b^2 - 9/4) = -k for b = a + 1/2
        a = [s * mp.sqrt(mp.mpf(5) / 4 + r * mp.sqrt(1 - mp.mpf(k))) - mp.mpf(1) / 2 for s in (1, -1) for r in (1, -1)]

        def row(x, of):
            X = 1 + mp.mpf(x)
            by = {
                "deflection": lambda p: X**p,
                "rotation": lambda p: p * X ** (p - 1),
                "moment": lambda p: -p * (p - 1) * X ** (p + 2),
                "shear": lambda p: -p * (p - 1) * (p + 2) * X ** (p + 1),
            }
            return [by[of](p) for p in a]

        matrix = mp.matrix([row(0, "moment"), row(0, "shear"), row(length, "moment"), row(length, "shear")])
        shares = mp.lu_solve(matrix, mp.matrix([0, -F, -Mo, 0]))
        x = np.linspace(0.01, length - 0.01, 23)
        for name in FIELDS:
            expected = [mp.re(mp.fdot(row(place, name), shares)) for place in x]
            assert close(getattr(result.at(x), name), expected, 1e-13), name


@pytest.mark.parametrize("law", [
    {"type": "tanh", "stiffness": [3e4, 9e4], "limit": 400.0},
    {"type": "hyperbolic", "stiffness": 5e4, "limit": [500.0, 900.0]},
    {"type": "cubic", "k1": 3e4, "k2": 0.0, "k3": 1e9},
])  # fmt: skip
def test_curves_beside_an_integration(law):
    """From the left end of every zone to its right one, by Taylor's method of mpmath on the equations as they are written."""
    made = STRIP | {"foundation": [{"law": law, "side": "below", "gap": -0.001}]}
    result = gapbeam.solve(made)
    assert result.status == "solved"

    def parameter(value, x):
        return value if not isinstance(value, list) else value[0] + (value[1] - value[0]) * x / 8

    def force(x, u):
        if u < 0:
            return mp.mpf(0)
        if law["type"] == "cubic":
            return law["k1"] * u + law["k3"] * u**3
        k, most = parameter(law["stiffness"], x), parameter(law["limit"], x)
        return most * mp.tanh(k * u / most) if law["type"] == "tanh" else u / (1 / k + u / most)

    with mp.workdps(20):
        for start, end in ((0.25, 1.0), (2.5, 3.75), (4.25, 5.5)):
            section = made["sections"][start >= 4.0]

            def rates(x, y, section=section):
                f, g = (1 / stiffness_along(section[key], section, x) for key in ("EI", "GA"))
                w, psi, M, V = y
                return [psi + g * V, -f * M, V, force(x, w + mp.mpf("0.001")) - 20]

            at = result.at(start)
            there = mp.odefun(rates, mp.mpf(start), [mp.mpf(float(getattr(at, name))) for name in FIELDS])(mp.mpf(end))
            for name, expected in zip(FIELDS, there, strict=True):
                largest = max(abs(value.value) for value in result.extremes[name].values())
                assert abs(float(getattr(result.at(end), name)) - expected) < 1e-12 * largest, (start, name)


def test_short_sections_come_near():
    """With the square of their length, and a taper is what they come to."""
    apart = []
    for number in (24, 48):
        sections = []
        for section in STRIP["sections"]:
            x = section["from"] + 4.0 * (np.arange(number) + 0.5) / number
            EI, GA = (stiffness_along(section[key], section, x) for key in ("EI", "GA"))
            sections += [{"from": at - 2.0 / number, "to": at + 2.0 / number, "EI": a, "GA": b}
                         for at, a, b in zip(x.tolist(), EI.tolist(), GA.tolist(), strict=True)]  # fmt: skip
        stepped = gapbeam.solve(STRIP | {"sections": sections})
        apart.append(abs(stepped.steps[-1].contact[0].from_ - gapbeam.solve(STRIP).steps[-1].contact[0].from_))
    assert 3.7 < apart[0] / apart[1] < 4.3


def test_extremes_and_pressures_inside():
    """Of all fields and the curvature, which is no multiple of the moment here; found by looking at many places."""
    made = copy.deepcopy(STRIP)
    made["loads"].append({"type": "curvature", "kappa": 1e-4, "from": 1.0, "to": 7.0})
    result = gapbeam.solve(made)
    x = np.linspace(0.0, 8.0, 40001)
    both, extremes = [result.at(x, side=side) for side in ("left", "right")], result.steps[-1].extremes
    for name in (*FIELDS, "curvature", "pressure"):
        seen = np.concatenate([getattr(fields, name) for fields in both])
        largest = np.abs(seen).max()
        for end, value in (("max", seen.max()), ("min", seen.min())):
            over = (extremes[name][end].value - value) * (1 if end == "max" else -1)
            assert -1e-13 * largest < over < 1e-6 * largest, (name, end)


def test_polylines_cut_the_taper_too():
    """A law of one slope is a modulus. The beam is soft in shear, so that many parts of it are needed."""
    made = {
        "beam": {"spans": [3.625], "EI": 76.1, "hinges": [3.5]},
        "sections": [{"EI": {"from": 266.0, "to": 40.3, "power": 2}}, {"from": 1.25, "to": 3.375, "GA": [13.1, 88.0]}],
        "supports": [{"node": 1, "side": "above", "gap": 6.38e-06}, {"x": 2.875, "side": "below", "gap": 1.18e-05}],
        "loads": [{"type": "linear", "q": [0.244, -0.147], "from": 2.0, "to": 3.25}, {"type": "uniform", "q": 0.022}],
    }
    x = np.linspace(0.0, 3.625, 30)
    by_law, by_modulus = (
        gapbeam.solve(made | {"foundation": [{"side": "below", "gap": 2.44e-6, **given}]})
        for given in ({"law": [[2.0**-16, 1.75]]}, {"k": 1.75 * 2.0**16})
    )
    for name in FIELDS:
        assert close(getattr(by_law.at(x), name), getattr(by_modulus.at(x), name), 1e-13), name


def test_mirrored_strips():
    """Left and right are alike, also where EI and GA taper against each other."""
    made = copy.deepcopy(STRIP)
    made["sections"] = [{"EI": {"from": 9e4, "to": 4e6, "power": 3}, "GA": [4e6, 2e5]}]
    made["foundation"] = [{"k": [3e4, 9e4], "side": "below", "gap": [0.0, 0.002]}]
    other = copy.deepcopy(made)
    other["sections"] = [{"EI": {"from": 4e6, "to": 9e4, "power": 3}, "GA": [2e5, 4e6]}]
    other["foundation"] = [{"k": [9e4, 3e4], "side": "below", "gap": [0.002, 0.0]}]
    other["loads"][2]["M"] *= -1
    x = np.linspace(0.0, 8.0, 33)
    one, two = gapbeam.solve(made), gapbeam.solve(other)
    for name, sign in zip(FIELDS, (1, -1, 1, -1), strict=True):
        assert close(getattr(one.at(x), name), sign * getattr(two.at(8.0 - x, side="left"), name), 1e-14), name


@pytest.mark.parametrize("power", [1, 4])
def test_as_steep_as_may_be(power):
    """EI from 1 to 1e12 times that: as two beams that meet would have it, one of them rigid, nearly."""
    made = STRIP | {"sections": [{"EI": {"from": 1e3, "to": 9.9e14, "power": power}}]}
    result = gapbeam.solve(made)
    assert result.status == "solved"
    assert max(result.steps[-1].residuals.values()) < 1e-14


def test_all_ways_through_a_taper():
    """Events, steps, combinations, and prepared cases end in the same states."""
    result = gapbeam.solve(STRIP | {"analysis": {"follow": "events"}})
    assert [event.event for event in result.events] == ["end leaves"]
    factor = result.events[0].factor
    at_end = gapbeam.solve(STRIP)
    assert result.steps[-1].contact == at_end.steps[-1].contact
    x = np.linspace(0.0, 8.0, 9)
    edge = copy.deepcopy(STRIP)
    edge["loads"][2]["M"] *= factor
    assert abs(float(gapbeam.solve(edge).at(0.0).deflection)) < 1e-16
    steps = gapbeam.solve(STRIP | {"analysis": {"steps": 4}})
    np.testing.assert_array_equal(steps.at(x).moment, at_end.at(x).moment)
    combined = gapbeam.solve(STRIP | {"combinations": [{"name": "all", "factors": {"dead": 1.0, "live": 1.0}}]})
    assert close(combined.combinations["all"].at(x).moment, at_end.at(x).moment, 1e-15)
    found = gapbeam.prepare(STRIP).solve([[1.0, 1.0, 1.0], [1.0, 1.0, 0.5]])
    half = copy.deepcopy(STRIP)
    half["loads"][2]["M"] *= 0.5
    for k, one in enumerate((at_end, gapbeam.solve(half))):
        assert close(found.at(x, case=k).moment, one.at(x).moment, 1e-14)
    assert pickle.loads(pickle.dumps(at_end)).at(3.0).moment == at_end.at(3.0).moment
    assert "2 sections (2 tapered)" in report_text(at_end, verbose=True)
