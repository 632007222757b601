"""Sections that taper, beside closed forms and double integration in 30 digits."""

import copy
import json
import math
import random
import tomllib
from itertools import pairwise

import gapbeam
import mpmath as mp
import numpy as np
import pytest
from gapbeam import SceneError
from gapbeam.report.text import report_text
from gapbeam.results.proof import proof_data
from oracle.tapered_beam import TaperedBeam

inf = math.inf
CANTILEVER = {
    "beam": {"spans": [1.0], "EI": 1.0}, "supports": [{"node": 0, "rotation": "fixed"}],
    "loads": [{"type": "force", "node": 1, "F": 1.0}],
}  # fmt: skip
GIRDER = {
    "beam": {"spans": [20.0, 25.0, 20.0], "EI": 4e6, "GA": 3e6},
    "sections": [
        {"from": 14.0, "to": 20.0, "EI": {"from": 4e6, "to": 2.2e7, "power": 3}, "GA": [3e6, 5.4e6]},
        {"from": 20.0, "to": 26.0, "EI": {"from": 2.2e7, "to": 4e6, "power": 3}, "GA": [5.4e6, 3e6]},
    ],
    "supports": [{"node": 0, "side": "below"}, {"node": 1}, {"node": 2, "side": "below"},
                 {"node": 3, "side": "below", "gap": 0.03}],
    "loads": [{"type": "uniform", "q": 60.0, "case": "dead"}, {"type": "force", "x": 32.0, "F": 4000.0},
              {"type": "force", "x": 17.0, "F": 500.0, "case": "wind"}],
}  # fmt: skip


def close(value, expected, digits=1e-14):
    assert abs(value - expected) <= digits * abs(expected), (value, expected)


@pytest.mark.parametrize(("EI", "expected"), [
    ({"from": 2.0, "to": 1.0}, math.log(2.0) - 0.5),
    ([2.0, 1.0], math.log(2.0) - 0.5),
    ({"from": 8.0, "to": 1.0, "power": 3}, math.log(2.0) - 0.625),
    ({"from": 4.0, "to": 1.0, "power": 2}, 1.5 - 2.0 * math.log(2.0)),
    ({"from": 16.0, "to": 1.0, "power": 4}, 1.0 / 24.0),
])  # fmt: skip
def test_cantilever_whose_depth_doubles(EI, expected):
    """int s^2/(1 + s)^n ds from the tip."""
    result = gapbeam.solve(CANTILEVER | {"sections": [{"EI": EI}]})
    close(result.at(1.0).deflection, expected)


def test_shear_and_axial_stiffness():
    """Shear: int V/GA = ln 2; axial: N int 1/EA, and at a place inside."""
    result = gapbeam.solve(CANTILEVER | {"sections": [{"EI": 1e12, "GA": [1.0, 2.0]}]})
    close(result.at(1.0).deflection, math.log(2.0), 1e-11)
    pulled = [{"type": "axial", "node": 1, "F": 3.0}]
    scene = CANTILEVER | {"sections": [{"EA": {"from": 1.0, "to": 4.0, "power": 2}}], "loads": pulled}
    scene["supports"] = [*CANTILEVER["supports"], {"node": 0, "direction": "axial"}]
    result = gapbeam.solve(scene)
    close(result.at(1.0).axial_displacement, 3.0 * 0.5)
    close(result.at(0.5).axial_displacement, 3.0 * (1.0 - 1.0 / 1.5))


def test_heat_between_two_walls():
    """N int 1/EA = alpha dT L; the middle moves towards the deep end."""
    scene = {
        "beam": {"spans": [2.0], "EI": 100.0, "alpha": 1e-3}, "sections": [{"EA": [100.0, 300.0]}],
        "supports": [{"node": 0, "rotation": "fixed"}, *({"node": i, "direction": "axial"} for i in (0, 1))],
        "loads": [{"type": "temperature", "dT": 50.0}],
    }  # fmt: skip
    result = gapbeam.solve(scene)
    force = -0.1 / (2.0 * math.log(3.0) / 200.0)
    close(result.at(1.0).axial_force, force)
    close(result.at(1.0).axial_displacement, 0.05 + force * math.log(2.0) / 100.0, 1e-13)


def test_extremes_inside_a_taper():
    """Curvature of EI = h^3, h = 2 - x, M = x - 1: largest where 3 (1 - x) = h."""
    result = gapbeam.solve(CANTILEVER | {"sections": [{"EI": {"from": 8.0, "to": 1.0, "power": 3}}]})
    close(result.extremes["curvature"]["min"].value, -0.5 / 1.5**3)
    close(result.extremes["curvature"]["min"].x, 0.5)


def random_scene(rng):
    """A beam with tapers of all powers, and the same for the oracle."""
    spans = [rng.choice([2.0, 3.0, 4.5]) for _ in range(rng.randint(1, 3))]
    end = sum(spans)
    cuts = sorted({0.0, end, *(round(rng.uniform(0.3, end - 0.3) * 8) / 8 for _ in range(rng.randint(0, 3)))})

    def stiffness(base):
        one = base * rng.choice([0.5, 1.0, 2.0, 3.7])
        other, power = one * rng.choice([0.05, 0.25, 0.5, 1.0001, 1.5, 2.0, 4.0, 8.0]), rng.randint(1, 4)
        if rng.random() < 0.25:
            return one, (one, one, 1)
        if rng.random() < 0.4:
            return [one, other], (one, other, 1)
        return {"from": one, "to": other, "power": power}, (one, other, power)

    sections, exact = [], []
    for a, b in pairwise(cuts):
        EI, bending = stiffness(1000.0)
        GA, shear = stiffness(600.0) if rng.random() < 0.4 else (inf, (inf, inf, 1))
        sections.append({"from": a, "to": b, "EI": EI, "GA": GA})
        exact.append((a, b, bending, shear))
    inner = sorted({round(rng.uniform(0.2, end - 0.2) * 16) / 16 for _ in range(rng.randint(1, 3))})
    supports = [{"x": 0.0, "side": "both", "rotation": rng.choice(["fixed", 2000.0])}]
    for x in (*inner, end):
        one = {"x": x, "side": rng.choice(["both", "below", "below", "above"])}
        if rng.random() < 0.4:
            one["stiffness"] = rng.choice([50.0, 500.0, 1e4])
        if one["side"] != "both":
            one["gap"] = rng.choice([0.0, 0.0, 0.002, 0.01])
        supports.append(one)
    hinge = round(rng.uniform(0.5, end - 0.5) * 32) / 32 + 1 / 64
    hinges = [hinge] if rng.random() < 0.3 else []
    loads, given = [], []
    for _ in range(rng.randint(1, 4)):
        kind = rng.choice(["force", "moment", "linear", "curvature"])
        a, b = sorted(k / 8 for k in rng.sample(range(int(end * 8) + 1), 2))
        if kind in ("force", "moment"):
            value = rng.uniform(-20.0, 60.0)
            loads.append({"type": kind, "x": a, "F" if kind == "force" else "M": value})
            given.append((kind, a, value))
        elif kind == "curvature":
            value = rng.uniform(-0.003, 0.003)
            loads.append({"type": kind, "from": a, "to": b, "kappa": value})
            given.append((kind, a, b, value))
        else:
            q = [rng.uniform(-5.0, 20.0), rng.uniform(-5.0, 20.0)]
            loads.append({"type": kind, "from": a, "to": b, "q": q})
            given.append((kind, a, b, *q))
    scene = {"beam": {"spans": spans, "EI": 1000.0, "hinges": hinges}, "sections": sections, "supports": supports, "loads": loads}
    return scene, (end, exact, given, hinges)


SIGN = {"both": 0, "below": 1, "above": -1}


@pytest.mark.parametrize("seed", [*range(5), 6, 7])
def test_random_beams(seed):
    """Reactions, their signs, and fields at places of no other meaning, beside double integration for the scheme that was found."""
    scene, (end, exact, given, hinges) = random_scene(random.Random(seed))
    result = gapbeam.solve(scene)
    if hinges and result.status == "no-equilibrium" and "tips about the hinge" in result.reason:
        return
    assert result.status == "solved"
    state, supports = result.steps[-1], scene["supports"]
    acting = [k for k in range(len(supports)) if state.state[k] != "open"]
    with mp.workdps(30):
        springs = [(supports[k]["x"], 0 if "stiffness" not in supports[k] else 1 / mp.mpf(supports[k]["stiffness"]),
                    SIGN[supports[k]["side"]] * mp.mpf(supports[k].get("gap", 0.0))) for k in acting]  # fmt: skip
        rotation = supports[0]["rotation"]
        beam = TaperedBeam(end, exact, given, hinges, springs, [(0.0, 0 if rotation == "fixed" else 1 / mp.mpf(rotation))])
        places = [end * k / 13.01 for k in range(1, 13)]  # no load stands there
        fields = np.array([[float(value) for value in beam.fields(x)] for x in places])
        reactions = np.array([float(value) for value in beam.reactions])
    size = max(np.abs(reactions).max(), 1e-12)
    assert np.abs(state.reaction[acting] - reactions).max() <= 1e-13 * size
    assert all(SIGN[supports[k]["side"]] * value >= -1e-13 * size for k, value in zip(acting, reactions, strict=True)
               if supports[k]["side"] != "both")  # fmt: skip
    for k in set(range(len(supports))) - set(acting):
        assert SIGN[supports[k]["side"]] * state.deflection[k] <= supports[k]["gap"] + 1e-15
    found = result.at(places)
    for k, quantity in enumerate(("deflection", "rotation", "moment", "shear")):
        largest = max(np.abs(fields[:, k]).max(), 1e-12)
        assert np.abs(getattr(found, quantity) - fields[:, k]).max() <= 1e-13 * largest, quantity
        dense = getattr(result.at(np.linspace(0.0, end, 501)), quantity)
        extremes = result.extremes[quantity]
        assert dense.max() <= extremes["max"].value + 1e-13 * largest
        assert dense.min() >= extremes["min"].value - 1e-13 * largest


@pytest.mark.parametrize("power", [1, 3, 4])
def test_steep_tapers_from_both_sides(power):
    """A ratio of 1e9, and the beam seen from the other side: within the bounds that are stated."""
    scene = {
        "beam": {"spans": [2.0, 1.0], "EI": 1.0}, "sections": [{"EI": {"from": 1e6, "to": 1e-3, "power": power}}],
        "supports": [{"node": 0, "rotation": "fixed"}, {"node": 1, "side": "below"}, {"node": 2, "rotation": "fixed"}],
        "loads": [{"type": "linear", "q": [1.0, 3.0]}],
    }  # fmt: skip
    turned = scene | {
        "beam": {"spans": [1.0, 2.0], "EI": 1.0}, "sections": [{"EI": {"from": 1e-3, "to": 1e6, "power": power}}],
        "supports": scene["supports"][::-1], "loads": [{"type": "linear", "q": [3.0, 1.0]}],
    }  # fmt: skip
    turned["supports"] = [one | {"node": 2 - one["node"]} for one in turned["supports"]]
    one, other = gapbeam.solve(scene), gapbeam.solve(turned)
    bounds = one.steps[-1].certificate
    assert np.allclose(one.steps[-1].reaction, other.steps[-1].reaction[::-1], rtol=0.0, atol=2.0 * bounds["error_bound_reaction"])
    for quantity in ("deflection", "moment"):
        apart = abs(one.extremes[quantity]["max"].value - other.extremes[quantity]["max"].value)
        assert apart <= 2.0 * bounds[f"error_bound_{quantity}"]


def test_cut_by_loads_and_equal_ends():
    """A load inside cuts a taper without changing it; two equal ends are one number, bit by bit."""
    cut = GIRDER | {"loads": [*GIRDER["loads"], {"type": "force", "x": 15.3, "F": 0.0}]}
    one, other = gapbeam.solve(GIRDER), gapbeam.solve(cut)
    assert np.allclose(one.steps[-1].reaction, other.steps[-1].reaction, rtol=1e-13, atol=0.0)
    plain = [gapbeam.solve(GIRDER | {"sections": [{"from": 14.0, "to": 20.0, "EI": EI}]}) for EI in (5e6, [5e6, 5e6])]
    assert plain[0].steps[-1].reaction.tolist() == plain[1].steps[-1].reaction.tolist()
    assert len({one.extremes["deflection"]["max"].value for one in plain}) == 1


def test_every_mode_agrees():
    """Events, steps, combinations, prepared cases and plastic supports take tapers from one place."""
    once = gapbeam.solve(GIRDER)
    events = gapbeam.solve(GIRDER | {"analysis": {"follow": "events", "steps": 4}})
    assert [(one.support, one.event) for one in events.events] == [(0, "opens")]
    at = events.state(events.events[0].factor)
    assert abs(at.deflection[events.events[0].support] - GIRDER["supports"][events.events[0].support].get("gap", 0.0)) < 1e-14
    assert np.allclose(events.steps[-1].reaction, once.steps[-1].reaction, rtol=1e-13)
    factors = [[1.0, a, b] for a in (0.0, 0.5, 1.0) for b in (0.0, 1.0)]
    cases = gapbeam.prepare(GIRDER).solve(np.array(factors))
    named = [dict(zip(("dead", "live", "wind"), row, strict=True)) for row in factors]
    combined = gapbeam.solve(GIRDER | {"combinations": [{"name": str(k), "factors": row} for k, row in enumerate(named)]})
    for k, one in enumerate(combined.combinations.values()):
        assert np.allclose(cases.reaction[k], one.steps[-1].reaction, rtol=0.0, atol=1e-10)
    assert np.allclose(cases.reaction[-1], once.steps[-1].reaction, rtol=1e-13)


def test_short_sections_tend_to_it():
    """Stepped sections are off by the square of their length."""
    apart = []
    for number in (10, 20):
        sections = []
        for section in GIRDER["sections"]:
            a, b = section["from"], section["to"]
            ends = section["EI"]["from"] ** (1 / 3), section["EI"]["to"] ** (1 / 3)
            for k in range(number):
                t = (k + 0.5) / number
                sections.append({"from": a + (b - a) * k / number, "to": a + (b - a) * (k + 1) / number,
                                 "EI": (ends[0] * (1 - t) + ends[1] * t) ** 3,
                                 "GA": section["GA"][0] * (1 - t) + section["GA"][1] * t})  # fmt: skip
        stepped = gapbeam.solve(GIRDER | {"sections": sections})
        apart.append(abs(stepped.steps[-1].reaction - gapbeam.solve(GIRDER).steps[-1].reaction).max())
    assert 3.9 < apart[0] / apart[1] < 4.1


@pytest.mark.parametrize(("changes", "words"), [
    ({"EI": [0.0, 1.0]}, "sections[0].EI: expected a number above 0 (infinite: rigid), got 0"),
    ({"EI": [1.0, inf]}, "sections[0].EI: expected a finite number above 0, got inf"),
    ({"EI": [inf, 1.0]}, "sections[0].EI: expected a finite number, for it changes along the section, got inf"),
    ({"EI": [1.0, 1e14]}, "sections[0].EI: expected at most 1000000000000 times"),
    ({"GA": {"from": 1.0, "to": 2.0, "power": 5}}, "sections[0].GA: expected a power of the depth of 1 to 4, got 5"),
    ({"EI": {"from": 1.0, "to": 2.0, "power": 1.5}}, "sections[0].EI.power: expected a whole number, got 1.5"),
    ({"EI": {"from": 1.0}}, "sections[0].EI.to: this key is missing"),
    ({"EI": [1.0, 2.0, 3.0]}, "sections[0].EI: expected a number, a pair of numbers or a table"),
])  # fmt: skip
def test_what_no_taper_can_be(changes, words):
    with pytest.raises(SceneError) as caught:
        gapbeam.solve(CANTILEVER | {"sections": [changes]})
    assert words in str(caught.value)


def test_a_span_has_one_stiffness():
    with pytest.raises(SceneError, match="section"):
        gapbeam.solve(GIRDER | {"beam": {"spans": [20.0, 25.0, 20.0], "EI": [1.0, 2.0, {"from": 1.0, "to": 2.0}]}})


def test_a_result_keeps_its_tapers():
    with pytest.raises(AttributeError, match="a result keeps its model"):
        gapbeam.solve(GIRDER).scene.sections[0].EI.to = 1.0
    assert copy.copy(gapbeam.solve(GIRDER).scene.sections[0].EI).power == 3


def test_written_and_read_again():
    scene = gapbeam.read_scene(GIRDER)
    again = gapbeam.read_scene(tomllib.loads(scene.to_toml()))
    assert again == scene
    assert gapbeam.replace(scene, "sections[0].EI.to", 3e7).sections[0].EI.to == 3e7
    data = json.loads(gapbeam.solve(GIRDER).to_json())
    assert data["status"] == "solved"
    assert "2 sections (2 tapered)" in report_text(gapbeam.solve(GIRDER), verbose=True)


def test_proofs_are_not_decided():
    """The checker does not know tapers, and says so."""
    data = proof_data(GIRDER | {"analysis": {}})
    assert data["scene"]["sections"][0]["tapered EI"] == {"from": 4e6, "to": 2.2e7, "power": 3}
    assert "EI" not in data["scene"]["sections"][0]
