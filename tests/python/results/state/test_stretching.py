"""Tension that deflections make in a beam held along its axis at two places."""

import math
import random

import gapbeam
import numpy as np
import pytest
from gapbeam.base.errors import GapbeamError, SceneError
from mpmath import mp
from scenes import force, uniform

HELD = [{"node": 0}, {"node": 1}, {"node": 0, "direction": "axial"}, {"node": 1, "direction": "axial"}]


def simple(q=1.0, EI=1.0, EA=1e4, stiffness=math.inf, strain=0.0, **keys):
    """A simple beam of length 1 under a uniform load, held along its axis; warmer by a strain."""
    supports = [*HELD[:3], {**HELD[3], "stiffness": stiffness}]
    loads = [uniform(q), {"type": "temperature", "dT": strain}]
    beam = {"spans": [1.0], "EI": EI, "EA": EA, "alpha": 1.0}
    return {"beam": beam, "supports": supports, "loads": loads, "analysis": {"stretching": True}, **keys}


def tension(q, EI, EA, stiffness, strain):
    """Its tension by closed forms in 120 digits, a third of which cancel: N int 1/EA = int w'**2/2 - strain, by halving."""
    with mp.workdps(120):
        q, EI, strain = mp.mpf(q), mp.mpf(EI), mp.mpf(strain)
        softness = 1 / mp.mpf(EA) + (0 if math.isinf(stiffness) else 1 / mp.mpf(stiffness))

        def lacking(N):
            # w' = a t - b sinh(rate t) at a distance t from the middle
            rate, t = mp.sqrt(mp.mpc(N) / EI), mp.mpf("0.5")
            a, b = q / N, q / (N * rate * mp.cosh(rate * t))
            square = a**2 * t**3 / 3 - 2 * a * b * (t * mp.cosh(rate * t) / rate - mp.sinh(rate * t) / rate**2)
            square += b**2 * (mp.sinh(2 * rate * t) / (4 * rate) - t / 2)
            return N * softness + strain - mp.re(square)

        low = -(mp.pi**2) * EI * (1 - mp.mpf(10) ** -12) if strain > 0 else mp.mpf(10) ** -12
        high = mp.mpf(10) ** 9
        for _ in range(110):
            middle = (low + high) / 2 if low < 0 else mp.sqrt(low * high)
            low, high = (low, middle) if lacking(middle) > 0 else (middle, high)
        return float(low)


@pytest.mark.parametrize(
    ("q", "EI", "EA", "stiffness", "strain"),
    [
        (1.0, 1.0, 1e4, math.inf, 0.0), (1.0, 1.0, 1e4, 300.0, 0.0), (100.0, 1.0, 1e6, math.inf, 0.0),
        (10.0, 1e-4, 1e3, math.inf, 0.0), (0.1, 1.0, 1e4, math.inf, 1e-3), (0.1, 1.0, 1e4, math.inf, 2e-2),
        (3.0, 1.0, 1e2, 50.0, 0.5),
    ],
)  # fmt: skip
def test_a_simple_beam_between_axial_supports(q, EI, EA, stiffness, strain):
    result = gapbeam.solve(simple(q, EI, EA, stiffness, strain))
    assert result.at(0.3).axial_force == pytest.approx(tension(q, EI, EA, stiffness, strain), rel=1e-13)
    given = gapbeam.solve({"beam": {"spans": [1.0], "EI": EI, "N": float(result.at(0.3).axial_force)}, "supports": HELD[:2],
                           "loads": [uniform(q)]})  # fmt: skip
    assert result.at(0.3).deflection == pytest.approx(given.at(0.3).deflection, rel=1e-12)


def test_little_load_makes_little_tension():
    """It grows with the square of the load, and a beam without deflection has none."""
    N = [gapbeam.solve(simple(q)).at(0.5).axial_force for q in (1e-3, 1e-4)]
    assert N[0] / N[1] == pytest.approx(100.0, rel=1e-6)
    assert gapbeam.solve(simple(0.0)).at(0.5).axial_force == 0.0


def drawn(seed):
    """A beam on one-sided supports, held along its axis at two of them, under loads, heat and forces along it."""
    draw = random.Random(seed)
    n = draw.randint(1, 4)
    spans = [draw.choice([2.0, 3.0, 5.0]) for _ in range(n)]
    supports = [{"node": i, "side": draw.choice(["both", "below"]), "gap": 0.0} for i in range(1, n)]
    for one in supports:
        one["gap"] = draw.choice([0.0, 0.01]) if one["side"] == "below" else 0.0
    ends = sorted(draw.sample(range(n + 1), 2))
    supports += [{"node": 0}, {"node": n}]
    supports += [{"node": k, "direction": "axial", "stiffness": draw.choice([math.inf, 1e3, 1e5])} for k in ends]
    loads = [uniform(draw.uniform(1.0, 20.0)), force(draw.uniform(0.0, sum(spans)), draw.uniform(-20.0, 40.0))]
    if draw.random() < 0.5:
        loads.append({"type": "temperature", "dT": draw.uniform(-20.0, 40.0)})
    if draw.random() < 0.4:
        loads.append({"type": "axial", "node": draw.randint(0, n), "F": draw.uniform(-5.0, 10.0)})
    beam = {"spans": spans, "EI": draw.choice([1.0, 100.0]), "EA": 10 ** draw.uniform(3, 5), "alpha": 1e-5}
    scene = {"beam": beam, "supports": supports, "loads": loads, "analysis": {"stretching": True}}
    if draw.random() < 0.3:
        scene["foundation"] = [{"k": draw.uniform(0.1, 20.0), "side": draw.choice(["both", "below"])}]
    return scene, [sum(spans[:k]) for k in ends]


@pytest.mark.parametrize("seed", range(60))
def test_random_beams(seed):
    """The stretch between the supports is what force, heat and slopes make of it: integrals of fields, panel by panel."""
    scene, (left, right) = drawn(seed)
    result = gapbeam.solve(scene)
    assert result.status == "solved"
    warm = sum(1e-5 * load["dT"] for load in scene["loads"] if load["type"] == "temperature")
    borders = np.unique([left, right, *np.cumsum(scene["beam"]["spans"]), *np.linspace(left, right, 200),
                         *(load["x"] for load in scene["loads"] if "x" in load)])  # fmt: skip
    borders = borders[(borders >= left) & (borders <= right)]
    points, weights = np.polynomial.legendre.leggauss(12)
    from_, to = borders[:-1, None], borders[1:, None]
    x, share = (from_ + to + (to - from_) * points) / 2, (to - from_) * weights / 2
    fields = result.at(x)
    lengthening = (share * fields.rotation**2).sum() / 2
    longer = (share * fields.axial_force).sum() / scene["beam"]["EA"] + warm * (right - left) - lengthening
    moved = result.at(right, side="left").axial_displacement - result.at(left).axial_displacement
    sizes = [abs(longer), lengthening, abs(warm) * (right - left), (share * abs(fields.axial_force)).sum() / scene["beam"]["EA"]]
    assert moved == pytest.approx(longer, abs=1e-11 * max(sizes))
    u = result.at(np.linspace(0.0, sum(scene["beam"]["spans"]), 2001)).axial_displacement
    found = result.extremes["axial_displacement"]
    assert found["max"].value >= u.max() - 1e-15
    assert found["max"].value == pytest.approx(u.max(), abs=1e-4 * np.ptp(u) + 1e-15)
    assert found["min"].value <= u.min() + 1e-15
    assert found["min"].value == pytest.approx(u.min(), abs=1e-4 * np.ptp(u) + 1e-15)


def test_a_cable_over_a_roller():
    """Nearly without bending stiffness: tension by the length of two parabolas, 24 N**3 = EA (q l)**2 of spans l."""
    scene = simple(1.0, 1e-9, 1e6)
    scene["beam"]["spans"] = [0.5, 0.5]
    scene["supports"] = [{"node": 0}, {"node": 1, "side": "below"}, {"node": 2}, {"node": 0, "direction": "axial"},
                         {"node": 2, "direction": "axial"}]  # fmt: skip
    result = gapbeam.solve(scene)
    assert result.at(0.2).axial_force == pytest.approx((1e6 * 0.25 / 24) ** (1 / 3), rel=1e-4)
    assert result.reactions[1] == pytest.approx(0.5, rel=1e-3)


def test_all_ways_of_solving():
    """Steps, combinations, cases, and the modes of a stretched state."""
    scene = simple(30.0, strain=1e-3)
    scene["loads"][0]["case"], scene["loads"][1]["case"] = "wind", "sun"
    alone = gapbeam.solve(scene)
    steps = gapbeam.solve({**scene, "analysis": {"stretching": True, "steps": 4}})
    assert steps.at(0.5).axial_force == alone.at(0.5).axial_force
    quarter = simple(7.5, strain=2.5e-4)
    assert steps.steps[0].solution is not None
    assert steps.at(0.5, factor=0.25).axial_force == pytest.approx(gapbeam.solve(quarter).at(0.5).axial_force, rel=1e-13)
    cases = gapbeam.prepare(scene).solve([[1.0, 1.0], [0.25, 0.25]])
    assert cases.deflection[0].max() == pytest.approx(alone.at(0.5).deflection, rel=1e-13) or len(cases.deflection[0]) == 2
    assert cases.at(0.5).moment[0] == pytest.approx(alone.at(0.5).moment, rel=1e-13)
    combined = gapbeam.solve({**scene, "combinations": [{"name": "all", "factors": {"wind": 1.0, "sun": 1.0}}]})
    assert combined.at(0.5, combination="all").moment == pytest.approx(alone.at(0.5).moment, rel=1e-13)
    pressed = simple(0.1, strain=1e-3, analysis={"stretching": True, "buckling": 1, "frequencies": 1})
    pressed["beam"]["mass"] = 1.0
    found = gapbeam.solve(pressed)
    N = float(found.at(0.5).axial_force)
    assert found.buckling[0] == pytest.approx(math.pi**2 / -N, rel=1e-12)
    assert found.frequencies[0] == pytest.approx(math.pi * math.sqrt(math.pi**2 + N), rel=1e-11)
    assert "stretch" in alone.report()


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"analysis": {"stretching": True, "first_order": True}}, "beside first_order = true"),
        ({"analysis": {"stretching": True, "follow": "events"}}, 'beside follow = "events"'),
        ({"analysis": {"stretching": True, "history": [1.0, 0.0]}}, "beside history"),
        ({"supports": HELD[:3]}, "at two places, not at 1"),
        ({"supports": [*HELD[:3], {**HELD[3], "side": "left"}]}, "axial supports that act one way"),
        ({"beam": {"spans": [1.0], "EI": 1.0, "alpha": 1.0}}, "infinite EA"),
    ],
)
def test_what_is_refused(keys, words):
    with pytest.raises(GapbeamError) as caught:
        gapbeam.solve(simple(**keys))
    assert words in str(caught.value)
    if "analysis" in keys:
        assert isinstance(caught.value, SceneError)
        assert caught.value.place == "analysis.stretching"


@pytest.mark.parametrize("keys", [
    {"loads": [force(0.3, 4.0), {"type": "axial_uniform", "q": 5.0}]},
    {"loads": [force(0.3, 4.0)], "sections": [{"from": 0.25, "to": 0.75, "EA": [5e3, 2e4]}]},
])  # fmt: skip
def test_displacements_along_the_axis_where_its_elongation_changes(keys):
    """One more node changes nothing, and between nodes it is the integral of N/EA - w'**2/2."""
    made = simple(**keys)
    result = gapbeam.solve(made)
    x = np.array([0.1, 0.375, 0.625, 0.9])
    along = result.at(x).axial_displacement
    cut = gapbeam.solve({**made, "loads": [*made["loads"], *(force(place, 0.0) for place in x)]})
    np.testing.assert_allclose(cut.at(x).axial_displacement, along, rtol=1e-12)
    nodes, weights = np.polynomial.legendre.leggauss(12)
    for start, stop, value in ((0.25, 0.3, 0.3), (0.3, 0.375, 0.375), (0.375, 0.7, 0.7)):
        there = result.at((start + stop) / 2 + (stop - start) / 2 * nodes)
        EA = 5e3 + (there.x - 0.25) * 3e4 if "sections" in made else 1e4
        change = (stop - start) / 2 * weights @ (there.axial_force / EA - there.rotation**2 / 2)
        ends = result.at([start, value]).axial_displacement
        assert ends[1] - ends[0] == pytest.approx(change, rel=1e-11, abs=1e-17)
    extremes = result.extremes["axial_displacement"]
    sampled = result.at(np.linspace(0.0, 1.0, 2001)).axial_displacement
    for way, found in (("max", sampled.max()), ("min", sampled.min())):
        assert extremes[way].value == pytest.approx(float(result.at(extremes[way].x).axial_displacement), rel=1e-12, abs=1e-20)
        assert abs(extremes[way].value) >= abs(found) * (1 - 1e-14)
        assert extremes[way].value == pytest.approx(found, rel=1e-4)


def test_a_stiff_beam_under_a_triangular_load():
    """w' = q (7 - 30 x**2 + 15 x**4)/(360 EI): squares of degree 8, whose integral is 192/7."""
    q, EA = 1e-8, 1e4
    stiff = simple(EA=EA)
    stiff["loads"] = [{"type": "linear", "q": [0.0, q]}]
    tension = float(gapbeam.solve(stiff).at(0.3).axial_force)
    assert tension / EA * (360 / q) ** 2 == pytest.approx(96 / 7, rel=1e-13)
