"""Largest values over the whole way of the load, beside paths in fractions, beside dense states, and by hand."""

import json
import pickle
import random

import gapbeam
import numpy as np
import pytest
from gapbeam.report.json_csv import to_json
from gapbeam.report.text import report_text
from oracle.history import history
from scenes import at, force, random_scene, scene, uniform
from scenes.ground import rail, yielding
from scenes.law import law_scene

FIELDS = ("deflection", "rotation", "moment", "shear", "curvature")
ARM = {
    "units": {"force": "kN", "length": "m"},
    "beam": {"spans": [3.0, 2.0], "EI": 8.0e3},
    "supports": [
        {"node": 0, "name": "bolt"},
        {"node": 1, "name": "pin", "side": "below", "unloading": "broken",
         "law": {"type": "brittle", "stiffness": 5e5, "limit": 90.0}},
        {"node": 2, "name": "rubber", "side": "below", "gap": 0.04,
         "law": {"type": "hardening", "stiffness": 400.0, "limit": 20.0, "slope": 4e3}},
    ],
    "loads": [{"type": "force", "node": 2, "F": 80.0}],
    "analysis": {"follow": "events", "at_limit": "jump"},
}  # fmt: skip
"""A shear pin breaks; what is left carries nothing in bending."""


def arm(**analysis):
    return {**ARM, "analysis": {**ARM["analysis"], **analysis}}


def test_what_breaks_on_the_way_is_not_lost():
    result = gapbeam.solve(arm())
    assert max(abs(value) for value, _ in result._pairs_of_extremes()["moment"].values()) < 1e-12
    envelope = result.envelope()
    least = envelope.extremes["moment"]["min"]
    assert (least.value, least.x) == (pytest.approx(-108.0, rel=1e-13), 3.0)
    assert least.factor == pytest.approx(0.7015, rel=1e-13)
    assert least.leg == 0
    assert least.concurrent["shear"] in (pytest.approx(-36.0), pytest.approx(54.0))
    bolt, pin, rubber = envelope.supports
    assert pin["reaction"]["max"].value == pytest.approx(90.0, rel=1e-13)
    assert bolt["reaction"]["min"].value == pytest.approx(-36.0, rel=1e-13)
    assert (rubber["opening"]["max"].value, rubber["opening"]["max"].factor) == (0.04, 0.0)
    assert pin["reaction"]["max"].concurrent["deflection"] == pytest.approx(90.0 / 5e5)
    assert envelope.over == "path"
    data = json.loads(to_json(result))["history_extremes"]
    assert data["moment"]["min"] == [least.value, 3.0, {"factor": least.factor, "leg": 0}]
    assert [(row["support"], row["name"]) for row in data["supports"]] == [(0, "bolt"), (1, "pin"), (2, "rubber")]
    assert data["supports"][1]["reaction"]["max"] == [pin["reaction"]["max"].value, {"factor": least.factor, "leg": 0}]
    text = report_text(result).partition("Largest values over the loading history")[2]
    assert ["smallest", "-108", "3", "0.7015"] in [line.split() for line in text.splitlines()]
    assert ["1", "pin", "largest", "reaction", "90", "0.7015"] in [line.split() for line in text.splitlines()]


@pytest.mark.parametrize("at_limit", ["stop", "jump", "follow"])
def test_limits_and_what_comes_after(at_limit):
    result = gapbeam.solve(arm(at_limit=at_limit))
    found = result.envelope()
    assert found.extremes["moment"]["min"].value == pytest.approx(-108.0, rel=1e-13)
    assert found.supports[1]["reaction"]["max"].value == pytest.approx(90.0, rel=1e-13)
    largest = found.supports[2]["reaction"]["max"]
    if at_limit == "stop":  # the landing is not on the path
        assert result.status == "limit-load"
        assert largest.value < 20.0
    else:
        assert (largest.value, largest.factor) == (pytest.approx(80.0), 1.0)


def test_both_sides_of_a_jump_count():
    # At the landing the rubber carries all, 80 * 0.7015, at once; afterwards the load falls
    result = gapbeam.solve(arm(history=[0.7015 + 1e-9, 0.0]))
    largest = result.envelope().supports[2]["reaction"]["max"]
    assert largest.value == pytest.approx(80 * 0.7015, rel=1e-8)
    assert largest.leg == 0


def test_every_value_stands_beside_its_leg():
    law = {"type": "plastic", "stiffness": 100.0, "limit": 1.0}
    made = scene([1.0], [at(0, rotation="fixed"), at(1, side="below", law=law, unloading="plastic")], [force(1.0, 2.0)], EI=1.0,
                 analysis={"follow": "events", "history": [1.0, -1.0, 0.5]})  # fmt: skip
    result = gapbeam.solve(made)
    assert {one.leg for row in result.envelope().extremes.values() for one in row.values()} == {0, 1}
    least = result.envelope().extremes["deflection"]["min"]
    assert (least.factor, least.leg) == (-1.0, 1)


@pytest.mark.parametrize("family", ["plastic", "broken", "softening", "hardening"])
def test_supports_beside_paths_in_fractions(family):
    checked = 0
    for seed in range(60):
        made = law_scene(seed, family)
        exact = history(made)
        result = gapbeam.solve(made)
        if exact.status != "solved" or result.status != "solved" or not exact.problem.which:
            continue
        states = [state for segment in exact.segments if segment.leg for state in (segment.start, segment.end)]
        if not states or any(limit.leg < 0 for limit in result.limits):  # there are dead loads only, or something breaks under them
            continue
        which, found = exact.problem.which, result.envelope()
        for name, values in (("reaction", [s.reaction for s in states]), ("deflection", [s.w for s in states])):
            values = np.array(values, dtype=float)
            size = max(np.abs(values).max(), 1e-3)
            for kind, best in (("max", values.max(axis=0)), ("min", values.min(axis=0))):
                ours = [found.supports[k][name][kind].value for k in which]
                assert ours == pytest.approx(best.tolist(), abs=1e-10 * size), (seed, name, kind)
        checked += 1
    assert checked > 30


@pytest.mark.parametrize("family", ["plastic", "broken", "softening", "hardening"])
def test_nothing_between_is_larger(family):
    for seed in range(100, 120):
        result = gapbeam.solve(law_scene(seed, family))
        if not result.segments:
            continue
        states = [
            result.path.step(segment, segment.start + (segment.stop - segment.start) * share)
            for segment in result.segments
            for share in (0.1, 0.37, 0.5, 0.83)
        ]
        check_bounds(result, states)


def check_bounds(result, states, tolerance=1e-10):
    """No state goes beyond the extremes, and each extreme is that of the state it comes from, or is in the curves."""
    found = result.path_envelope()
    values = np.array([state.solution.extremes()[0] for state in states])
    curves = found.fields
    for name, column in result._beam.fields.items():
        row = found.extremes[name]
        size = max(abs(one.value) for one in row.values()) or 1.0
        assert values[:, 0, column].max() <= row["max"].value + tolerance * size, name
        assert values[:, 1, column].min() >= row["min"].value - tolerance * size, name
        assert curves.largest[name].max() <= row["max"].value + tolerance * size
        assert curves.smallest[name].min() >= row["min"].value - tolerance * size
        if name in FIELDS:
            along = np.array([result.at_state(state, curves.x[1:-1]).columns()[name] for state in states])
            inner = np.append(True, np.diff(curves.x[1:-1]) > 0.0) & np.append(np.diff(curves.x[1:-1]) > 0.0, True)
            assert (along <= curves.largest[name][1:-1] + tolerance * size)[:, inner].all(), name
            assert (along >= curves.smallest[name][1:-1] - tolerance * size)[:, inner].all(), name
    for name in ("reaction", "opening", "deflection"):
        table = np.array([getattr(state, name) for state in states])
        size = np.abs(table).max() or 1.0
        assert (table.max(axis=0) <= [row[name]["max"].value + tolerance * size for row in found.supports]).all()
        assert (table.min(axis=0) >= [row[name]["min"].value - tolerance * size for row in found.supports]).all()


def test_what_breaks_under_the_dead_loads_counts():
    """As the arm breaks, but under loads that are dead: the factor is theirs."""
    made = {**arm(), "loads": [{**ARM["loads"][0], "case": "dead"}, force(5.0, 1e-6)]}
    made["supports"] = [{**one, "gap": 0.0} if "gap" in one else one for one in made["supports"]]
    result = gapbeam.solve(made)
    least = result.envelope().extremes["moment"]["min"]
    assert (least.leg, least.x) == (-1, 3.0)
    assert 0.0 < least.factor < 1.0
    live = gapbeam.solve({**arm(), "supports": made["supports"]}).envelope()
    assert least.value == pytest.approx(live.extremes["moment"]["min"].value, rel=1e-9)
    assert least.factor == pytest.approx(live.extremes["moment"]["min"].factor, rel=1e-9)
    assert least.concurrent["deflection"] == pytest.approx(live.extremes["moment"]["min"].concurrent["deflection"], rel=1e-9)
    assert result.envelope(x=[3.0]).fields.smallest["moment"] == pytest.approx([least.value])


def test_plain_paths_and_turns():
    seen = 0
    for seed in range(80):
        made = random_scene(random.Random(seed))
        made["analysis"] = {"follow": "events"}
        try:
            result = gapbeam.solve(made)
        except gapbeam.EngineError:
            continue
        if len(result.segments) < 2:
            continue
        seen += 1
        check_bounds(result, [
            result.path.step(segment, segment.start + (segment.stop - segment.start) * share)
            for segment in result.segments for share in (0.0, 0.2, 0.7)
        ], 1e-9)  # fmt: skip
    assert seen > 10


def test_steps_count_where_only_they_are_known():
    made = scene([8.0], [at(0), at(1), at(x=4.0, side="below", gap=0.01)], [uniform(2.5)], EI=1e4)
    by_steps = gapbeam.solve({**made, "analysis": {"steps": 5}}).envelope()
    exact = gapbeam.solve({**made, "analysis": {"follow": "events"}}).envelope()
    assert (by_steps.over, exact.over) == ("steps", "path")
    assert exact.extremes["moment"]["max"].value == pytest.approx(15.0, rel=1e-12)
    assert exact.extremes["moment"]["max"].factor == pytest.approx(0.75, rel=1e-12)
    assert by_steps.extremes["moment"]["max"].value < 15.0 - 1e-3
    assert "Only the load steps count" in report_text(gapbeam.solve({**made, "analysis": {"steps": 5}}))
    one = gapbeam.solve(made)
    assert "history_extremes" not in one.to_dict()
    assert one.envelope().extremes["moment"]["max"].factor is None
    with pytest.raises(ValueError, match="not followed"):
        one.path_envelope()


@pytest.mark.parametrize("made", [rail(follow="events"), {**yielding(), "analysis": {"follow": "events"}}])
def test_ground_is_of_states_and_says_so(made):
    result = gapbeam.solve(made)
    found = result.envelope()
    assert found.over == "states"
    assert found.missing == []
    at_end = result._pairs_of_extremes()
    for name in FIELDS:
        assert found.extremes[name]["max"].value >= at_end[name]["max"][0]
        assert found.extremes[name]["min"].value <= at_end[name]["min"][0]
    for factor in np.linspace(0.05, 1.0, 11):
        step = result.state(factor)
        size = max(abs(one.value) for one in found.extremes["moment"].values())
        assert step.solution.extremes()[0][0, 2] <= found.extremes["moment"]["max"].value + 0.01 * size
    assert "3 to 23 states between" in report_text(result)


def test_smooth_laws_that_snap_through():
    law = {"type": "cubic", "k1": 9.0, "k2": -6.0, "k3": 1.0}
    made = scene([1.0], [at(0), at(1), at(x=0.5, law=law)], [force(0.5, 10.0)], EI=1 / 48,
                 analysis={"follow": "events", "at_limit": "jump"})  # fmt: skip
    result = gapbeam.solve(made)
    largest = result.envelope().supports[2]["reaction"]["max"]
    limit = result.limits[0]
    assert result.envelope().over == "states"
    # 9 w - 6 w**2 + w**3 has a peak of 4 at w = 1, and where the load ends it carries 10 less the beam's w
    known = max(4.0, *(step.reaction[2] for step in result.steps), limit.landing.reaction[2])
    assert largest.value == pytest.approx(known, rel=1e-2)


def test_combinations_and_pickles_and_tables():
    made = arm()
    made["combinations"] = [{"name": "half", "factors": {"live": 0.5}}, {"name": "full", "factors": {"live": 1.0}}]
    result = gapbeam.solve(made)
    found = result.path_envelope()
    least = found.extremes["moment"]["min"]
    assert (least.value, least.source.combination) == (pytest.approx(-108.0), "full")
    assert least.factor == pytest.approx(0.7015)
    assert result.envelope().extremes["moment"]["min"].factor is None  # of full loads
    data = json.loads(to_json(result))
    assert data["history_extremes"]["moment"]["min"][2] == {"combination": "full", "factor": least.factor, "leg": 0}
    assert "Largest values over the loading history" in report_text(result)
    single = gapbeam.solve(arm())
    single.envelope()
    again = pickle.loads(pickle.dumps(single))
    assert again == single
    assert again.envelope().extremes["moment"]["min"].value == single.envelope().extremes["moment"]["min"].value
    columns = single.envelope().columns()
    assert {len(column) for column in columns.values()} == {len(columns["x"])}
    assert columns["moment_min_factor"][int(np.argmin(columns["moment_min"]))] == pytest.approx(0.7015)
    assert single.envelope().supports.columns()["reaction_max_leg"] == [0, 0, 0]
    assert single.envelope(x=[3.0]).fields.smallest["moment"] == pytest.approx([-108.0])


