"""Axial loads, temperatures and settlements act on bending: beside axial forces that are given, in every way of solving."""

import math
import random
import re

import gapbeam
import numpy as np
import pytest
from gapbeam.base.errors import EngineError
from gapbeam.report import report_text
from scenes import force, uniform

PE = math.pi**2
PINS = [{"node": 0}, {"node": 0, "direction": "axial"}, {"node": 1}]
STOP = {"x": 0.5, "side": "below", "gap": 0.02}
RESULTS = {"q", "F", "dT"}


def column(share, case="live", supports=(*PINS, STOP), **analysis):
    """A column of length, EI and load 1 beside a stop, pressed by that many Euler loads."""
    push = {"type": "axial", "node": 1, "F": -share * PE, "case": case}
    return {"beam": {"spans": [1.0], "EI": 1.0}, "supports": list(supports), "loads": [uniform(1.0), push], "analysis": analysis}


def drawn(seed):
    """A beam with one-sided supports, held along its axis once or twice, under dead, live, wind and sun."""
    draw = random.Random(seed)
    n = draw.randint(1, 5)
    spans = [draw.choice([2.0, 3.0, 5.0]) for _ in range(n)]
    supports = [{"node": i, "side": draw.choice(["both", "below", "above"])} for i in range(1, n)]
    for one in supports:
        if one["side"] != "both":
            one["gap"] = draw.choice([0.0, 0.005])
    supports += [{"node": 0}, {"node": n}, {"node": 0, "direction": "axial"}]
    if draw.random() < 0.5:
        supports.append({"node": n, "direction": "axial", "stiffness": draw.choice([100.0, 1e4])})
    EI = draw.choice([100.0, 1000.0])
    loads = [
        {**uniform(draw.choice([-2.0, 3.0])), "case": "dead"},
        {**force(sum(spans) * draw.random(), draw.choice([5.0, -8.0, 10.0])), "case": "live"},
        {"type": "axial", "node": draw.randint(1, n), "F": EI * draw.choice([-0.2, -0.1, 0.2, 1.0]),
         "case": draw.choice(["dead", "live", "wind"])},
        {"type": "temperature", "dT": draw.choice([30.0, -20.0]), "case": "sun"},
    ]  # fmt: skip
    return {"beam": {"spans": spans, "EI": EI, "EA": 1e4, "alpha": 1e-4}, "supports": supports, "loads": loads}


def times(scene, factors):
    """The scene with every load times the factor of its case."""
    loads = [
        {key: value * factors[load["case"]] if key in RESULTS else value for key, value in load.items() if key != "case"}
        for load in scene["loads"]
    ]
    return {**scene, "loads": loads}


def close(a, b, rtol=1e-12):
    np.testing.assert_allclose(a, b, rtol=0, atol=rtol * np.abs(b).max())


@pytest.mark.parametrize(
    ("share", "reaction"), [(0.34, 0.0), (0.5, 0.14714005862549203), (0.9, 0.53807030793317657), (2.0, 1.6440875059318176)]
)
def test_a_column_against_a_stop(share, reaction):
    step = gapbeam.solve(column(share)).steps[-1]
    assert step.reaction[3] == pytest.approx(reaction, rel=1e-13)


def test_a_column_buckles_instead_of_being_refused():
    result = gapbeam.solve(column(5.0))
    assert result.status == "buckles"
    assert "bears 0.8 times its axial forces" in result.reason
    assert "Forces of axial loads" in report_text(result)
    first = gapbeam.solve(column(5.0, first_order=True))
    assert first.status == "solved"
    close(first.steps[-1].reaction[[0, 2, 3]], np.array([0.5, 0.5, 0.0]))


@pytest.mark.parametrize("case", ["dead", "live"])
def test_axial_forces_have_the_factors_of_their_loads(case):
    """Dead they are there from the start, live they grow, like N that is given."""
    found = gapbeam.solve(column(0.5, case, follow="events"))
    given = column(0.5, follow="events", N_with=case)
    given["loads"].pop()
    given["beam"]["N"] = -0.5 * PE
    (one,), (other,) = found.events, gapbeam.solve(given).events
    assert one.factor == pytest.approx(other.factor, rel=1e-15)
    assert gapbeam.solve(column(0.25, case, buckling=1)).buckling == pytest.approx([4.0], rel=1e-15)


@pytest.mark.parametrize("seed", range(24))
def test_random_beams_in_every_way(seed):
    """As with the axial forces of the chain given for N; in combinations and in cases the same."""
    scene, draw = drawn(seed), random.Random(-seed - 1)
    cases = sorted({load["case"] for load in scene["loads"]})
    factors = [{case: draw.choice([0.0, 1.0, 0.7, -0.5]) for case in cases} for _ in range(3)]
    combined = gapbeam.solve({**scene, "combinations": [{"name": str(k), "factors": f} for k, f in enumerate(factors)]})
    table = np.array([[f[load["case"]] for load in scene["loads"]] for f in factors])
    many = gapbeam.prepare(scene).solve(table)
    ends = np.cumsum([0.0, *scene["beam"]["spans"]])
    for k, f in enumerate(factors):
        alone, there = gapbeam.solve(times(scene, f)), combined.combinations[str(k)]
        assert alone.status == there.status
        if alone.status != "solved":
            continue
        reaction = alone.steps[-1].reaction
        close(there.steps[-1].reaction, reaction)
        across = len(many.reaction[k])
        close(many.reaction[k], reaction[:across])
        N = alone.at((ends[1:] + ends[:-1]) / 2.0).axial_force
        given = times(scene, f)
        given["loads"] = [load for load in given["loads"] if load["type"] in {"uniform", "force"}]
        given["supports"] = scene["supports"][:across]
        given["beam"] = {**scene["beam"], "N": N.tolist()}
        close(gapbeam.solve(given).steps[-1].reaction, reaction[:across])
        sums = re.findall("Sum of (?:reactions|loads) .*", report_text(alone))
        assert len(sums) == 2


@pytest.mark.parametrize("F", [-20.0, 60.0])
def test_under_a_train_they_act_as_beside_standing_forces(F):
    """Envelopes had first order, states at positions second."""
    scene = {
        "beam": {"spans": [6.0, 8.0], "EI": 900.0}, "loads": [{"type": "axial", "node": 2, "F": F}, {"type": "uniform", "q": 3.0}],
        "supports": [{"node": 0}, {"node": 1, "side": "below"}, {"node": 2}, {"node": 0, "direction": "axial"}],
    }  # fmt: skip
    result = gapbeam.solve({**scene, "trains": [{"name": "T", "axles": [[0.0, 12.0]]}]})
    largest = result.envelope().extremes["moment"]["max"]
    there = [{"type": "force", "x": largest.position, "F": 12.0}]
    alone = gapbeam.solve({**scene, "loads": [*scene["loads"], *there]})
    assert alone.extremes["moment"]["max"].value == pytest.approx(largest.value, rel=1e-12)
    assert result.trains["T"].state(largest.position).extremes["moment"]["max"].value == pytest.approx(largest.value, rel=1e-12)
    first = gapbeam.solve({**scene, "trains": [{"name": "T", "axles": [[0.0, 12.0]]}], "analysis": {"first_order": True}})
    assert (first.envelope().extremes["moment"]["max"].value > largest.value) == (F > 0.0)


@pytest.mark.parametrize(
    "more",
    [
        {"loads": [{"type": "axial_uniform", "q": 0.1}], "beam": {"GA": 1e3}},
        {"supports": [{"x": 0.25, "side": "below", "gap": 0.1, "friction": 0.3}], "beam": {"EA": 1e4}},
        {"sections": [{"from": 0.0, "to": 0.5, "GA": [1e3, 2e3]}]},
        {"analysis": {"history": [1.0, 0.0], "follow": "events"}},
    ],
)
def test_beside_what_is_not_available_they_are_of_first_order(more):
    """And the report says how near the compression comes to the Euler load, as ever."""
    scene = column(0.2)
    for key, value in more.items():
        scene[key] = {**scene.get(key, {}), **value} if isinstance(value, dict) else [*scene.get(key, []), *value]
    first = gapbeam.solve({**scene, "analysis": {**scene["analysis"], "first_order": True}})
    result = gapbeam.solve(scene)
    assert not result._beam.feels_axial_loads
    np.testing.assert_array_equal(result.steps[-1].reaction, first.steps[-1].reaction)
    assert result.compression is not None


def test_one_support_along_the_axis_lets_temperature_pass():
    scene = column(0.0)
    scene["beam"] |= {"alpha": 1e-5}
    scene["loads"][1] = {"type": "temperature", "dT": 20.0}
    assert not gapbeam.solve(scene)._beam.in_stretches


def test_what_a_spring_takes_where_it_stands_leaves_no_force_beside_it():
    """A rounding of it held an overhang like a string: it was taken for stiff, and zones of the ground could not be settled."""
    scene = {
        "beam": {"spans": [4.0, 2.0], "EI": 2000.0, "EA": 2e5}, "sections": [{"from": 5.0, "EA": [6e4, 2e5]}],
        "supports": [{"node": 2}, {"node": 1}, {"node": 1, "direction": "axial", "stiffness": 1e5}],
        "foundation": [{"k": 5000.0, "side": "below"}],
        "loads": [{"type": "linear", "q": [-9.0, 6.0]}, {"type": "axial", "node": 1, "F": 90.0},
                  {"type": "curvature", "from": 5.0, "to": 5.5, "kappa": 0.003}],
    }  # fmt: skip
    result = gapbeam.solve(scene)
    scene["loads"][1]["F"] = 0.0
    assert result.steps[-1].reaction == pytest.approx([*gapbeam.solve(scene).steps[-1].reaction[:2], -90.0], rel=1e-13)


def test_compression_beyond_the_shear_stiffness_is_refused():
    scene = column(0.5)
    scene["beam"]["GA"] = 4.0
    with pytest.raises(EngineError, match=r"the compression from x = 0 to x = 0\.5 is not below GA there"):
        gapbeam.solve(scene)


def test_the_report_says_so():
    words = " ".join(report_text(gapbeam.solve(column(0.5, buckling=1))).split())
    assert "N = -4.9348 (compression) all along the beam. Forces of axial loads, temperatures and settlements" in words
    assert "times that of first order" in words
    assert "Buckling factors: 8 times all N" in words
    assert "left out" not in words


@pytest.mark.parametrize("size", [1.0, 1e-4, 1e-8])
def test_no_force_is_left_where_nothing_holds_the_beam_along_its_axis(size):
    """Rounding of the reaction of a spring was taken for a tension of a weightless overhang, which it held up."""
    below = [{"node": 0, "side": "below", "gap": 0.0069}, {"node": 1, "side": "below"}, {"node": 2, "side": "below"}]
    along = [{"node": node, "direction": "axial", "stiffness": stiffness} for node, stiffness in ((1, 3366.7), (2, 43253.2))]
    supports = [*below, {"node": 3}, *along]
    made = {"beam": {"spans": [6.2, 6.9, 4.7], "EI": 633.0, "EA": 46463.0}, "supports": supports}
    bends = [{"type": "uniform", "q": 1.8, "from": 5.4, "to": 12.0}, {"type": "moment", "x": 8.2, "M": 28.7}]
    found = gapbeam.solve({**made, "loads": [*bends, {"type": "axial", "x": 12.5, "F": -10.7 * size}]})
    tension = [float(found.at(x).axial_force) for x in (3.0, 9.0, 12.8, 15.0)]
    assert (tension[0], tension[3]) == (0.0, 0.0)
    sections = [{"from": a, "to": b, "N": N} for a, b, N in ((6.2, 12.5, tension[1]), (12.5, 13.1, tension[2]))]
    given = gapbeam.solve({**made, "supports": supports[:4], "sections": sections, "loads": bends})
    assert found.steps[-1].reaction[:4] == pytest.approx(given.steps[-1].reaction, rel=1e-12)
