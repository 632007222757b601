"""Envelopes of what foundations carry and of free spans, and envelopes as columns of tables."""

import csv
import io
import json
import pickle

import gapbeam
import numpy as np
import pytest
from gapbeam.report import report_text, to_csv
from scenes import at, force, scene, uniform


def footing(**keys):
    """A beam on two foundations, one of which it leaves altogether in some combinations."""
    loads = [uniform(10.0, case="dead"), force(3.0, 300.0, case="live"), force(0.0, -60.0, case="wind")]
    made = scene([12.0, 8.0], [at(2, name="wall")], loads, EI=2e4)
    made["foundation"] = [
        {"k": 5e3, "side": "below", "name": "clay", "to": 12.0},
        {"law": [[0.01, 20.0], [0.05, 30.0]], "side": "below", "from": 12.0},
    ]
    made["combinations"] = [
        {"name": "full", "factors": {"dead": 1.35, "live": 1.5}},
        {"name": "wind", "factors": {"dead": 1.0, "wind": 1.5}},
        {"name": "wind again", "factors": {"dead": 1.0, "wind": 1.5}},
        {"name": "both", "factors": {"dead": 1.0, "live": 1.5, "wind": 1.5}},
    ]
    return {**made, **keys}


def test_foundations_and_free_spans():
    result = gapbeam.solve(footing())
    envelope = result.envelope()
    steps = {name: one.steps[-1] for name, one in result.combinations.items()}
    for k, row in enumerate(envelope.foundations):
        carried = {name: sum(zone.resultant for zone in step.contact if zone.foundation == k) for name, step in steps.items()}
        for kind, best in (("max", max), ("min", min)):
            one = row["resultant"][kind]
            assert one.value == carried[one.combination] == pytest.approx(best(carried.values()), rel=1e-12)
            assert one.result is result.combinations[one.combination]
        spans = {(name, span) for name, step in steps.items() for span in step.free_spans if span.foundation == k}
        longest, deepest = row["free_span"]["longest"], row["free_span"]["deepest"]
        assert {(one.combination, one.span) for one in (longest, deepest)} <= spans
        assert longest.value == pytest.approx(max(span.to - span.from_ for _, span in spans), rel=1e-12)
        assert deepest.value == pytest.approx(max(span.sag for _, span in spans), rel=1e-12)
    lifted = envelope.foundations[0]["resultant"]["min"]
    assert (lifted.value, [one.combination for one in lifted.ties]) == (0.0, ["wind", "wind again"])
    found = json.loads(json.dumps(envelope.to_dict()))["foundations"]
    assert found[0]["name"] == "clay"
    assert found[0]["free_span"]["longest"] == [
        12.0, {"from": 0.0, "to": 12.0, "sag": envelope.foundations[0]["free_span"]["deepest"].value, "combination": "wind",
               "ties": [{"combination": "wind again"}]},
    ]  # fmt: skip
    text = report_text(result, 120)
    assert "Free spans, all combinations at full load" in text
    assert "0 clay  longest" in text


def test_what_does_not_stand_or_lift_is_left_out():
    made = footing(combinations=[{"name": "dead", "factors": {"dead": 1.0}}, {"name": "storm", "factors": {"wind": 200.0}}])
    made["supports"] = []
    result = gapbeam.solve(made)
    assert result.statuses == ("solved", "no-equilibrium")
    rows = result.envelope().foundations
    assert [row["free_span"] for row in rows] == [{"longest": None, "deepest": None}] * 2
    assert sum(row["resultant"]["min"].value for row in rows) == pytest.approx(200.0, rel=1e-12)
    assert "There is no free span." in report_text(result, 120)
    assert np.isnan(result.combinations.columns()["moment_max"]).tolist() == [False, True]


def test_envelope_of_one_load_has_foundations():
    made = footing(combinations=[])
    del made["loads"][1]
    result = gapbeam.solve(made)
    longest = result.envelope().foundations[0]["free_span"]["longest"]
    assert longest.combination is None
    assert longest.span in result.steps[-1].free_spans


def test_tables_of_combinations():
    result = gapbeam.solve(footing())
    table, supports = result.combinations.columns(), result.envelope().supports
    assert table["combination"] == list(result.names)
    assert {len(column) for column in table.values()} == {4}
    for k, one in enumerate(result.combinations.values()):
        for name, row in one._pairs_of_extremes().items():
            for kind, pair in row.items():
                assert (table[f"{name}_{kind}"][k], table[f"{name}_{kind}_x"][k]) == pair
        assert table["reaction wall"][k] == one.steps[-1].reaction[0]
    columns = supports.columns()
    assert columns["support"] == ["wall"]
    assert columns["x"].tolist() == [20.0]
    for name, row in supports[0].items():
        for kind, one in row.items():
            assert (columns[f"{name}_{kind}"][0], columns[f"{name}_{kind}_combination"][0]) == (one.value, one.combination)
    assert pickle.loads(pickle.dumps(result)).combinations.columns().keys() == table.keys()


def test_tables_while_trains_pass():
    made = scene([6.0, 6.0], [at(0), at(1, side="below", name="pier"), at(2)], [uniform(1.0, case="dead")], EI=1e4)
    made["trains"] = [{"name": "crane", "axles": [[0.0, 10.0]]}]
    rows = gapbeam.solve(made).envelope().supports.columns()
    assert (rows["support"], rows["reaction_max_train"][1], rows["reaction_max_position"][1]) == (["0", "pier", "2"], "crane", 6.0)
    assert "reaction_max_combination" not in rows
    made["combinations"] = [{"name": "with", "factors": {"dead": 1.0, "live": 1.5}}, {"name": "without", "factors": {"dead": 1.0}}]
    result = gapbeam.solve(made)
    table, rows = result.combinations.columns(), result.envelope().supports.columns()
    assert table["reaction pier_max"].tolist() == [pytest.approx(22.5), pytest.approx(7.5)]
    assert table["moment_max"][0] == result.combinations["with"].envelope().extremes["moment"]["max"].value
    assert (rows["reaction_max_combination"][1], rows["reaction_max"][1]) == ("with", table["reaction pier_max"][0])


def test_curves_say_where_they_come_from():
    result = gapbeam.solve(footing())
    envelope = result.envelope(points=4)
    columns, curves = envelope.columns(), envelope.fields
    assert columns["moment_max_combination"] == [result.names[k] for k in curves.largest_of["moment"]]
    header, *rows = csv.reader(io.StringIO(to_csv(result, points=4)))
    assert [name.partition(" ")[0] for name in header] == list(columns)
    assert [float(row[header.index("moment_min")]) for row in rows] == curves.smallest["moment"].tolist()
    for name in ("pressure_min_combination", "curvature_min_combination"):
        assert [row[list(columns).index(name)] for row in rows] == columns[name]


def test_curves_while_trains_pass_have_positions():
    made = scene([6.0], [at(0), at(1)], [uniform(1.0, case="dead")], EI=1e4)
    made["units"] = {"force": "kN", "length": "m"}
    made["trains"] = [{"name": "crane", "axles": [[0.0, 10.0]], "both_directions": True}]
    result = gapbeam.solve(made)
    columns = result.envelope(x=[1.5, 3.0]).columns()
    assert columns["moment_max_position"].tolist() == [1.5, 3.0]
    assert columns["moment_max_train"] == ["crane", "crane"]
    assert columns["moment_max_direction"] == ["right", "right"]
    header, *rows = csv.reader(io.StringIO(to_csv(result, points=2)))
    assert header[:3] == ["x [m]", "deflection_max [m]", "deflection_min [m]"]
    assert {len(row) for row in rows} == {len(header)}
    assert rows[1][header.index("moment_max_position [m]")] == "3.0"
    assert rows[1][header.index("moment_max_train")] == "crane"
