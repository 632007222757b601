"""Names of supports, foundations and loads, and names of load cases."""

import gapbeam
import pytest
from gapbeam.report.text import report_text
from scenes import at, force, scene, uniform


def named():
    """Three supports with names, loads of three cases."""
    supports = [at(0, name="R-101"), at(1, side="below", name="R-102"), at(2, side="below", name="R-103")]
    loads = [uniform(2.0, case="dead", name="weight"), uniform(1.0, case="snow"), force(3.0, 5.0, case="wind")]
    return scene([4.0, 4.0], supports, loads, EI=1e3)


def test_cases_are_live_but_for_dead_ones():
    made = named()
    result = gapbeam.solve(made)
    for load in made["loads"][1:]:
        load["case"] = "live"
    assert result.steps[-1].reaction.tolist() == gapbeam.solve(made).steps[-1].reaction.tolist()


def test_names_are_in_data_and_report():
    made = named() | {"analysis": {"follow": "events"}}
    made["loads"].append(force(3.0, 60.0, case="lifts"))
    result = gapbeam.solve(made)
    assert [row["name"] for row in result.to_dict(1)["steps"][-1]["supports"]] == ["R-101", "R-102", "R-103"]
    assert [(event["support"], event["name"]) for event in result.to_dict(1)["events"]] == [(2, "R-103")]
    text = report_text(result, 120, verbose=True)
    assert "1 R-102" in text
    assert "1 dead, 1 snow, 1 wind, 1 lifts" in text
    assert [event.support for event in result.events] == [2]
    assert "R-103" in text.split("Events")[1].split("Supports at")[0]


def test_columns_have_names_and_cases():
    made = named()
    made["supports"] = {"node": [0, 1, 2], "side": ["both", "below", "below"], "name": ["R-101", "R-102", "R-103"]}
    made["loads"] = {"type": "uniform", "q": [2.0, 1.0], "case": ["dead", "snow"]}
    read = gapbeam.read_scene(made)
    assert [support.name for support in read.supports] == ["R-101", "R-102", "R-103"]
    made["supports"]["name"][2] = "R-101"
    with pytest.raises(gapbeam.SceneError, match=r'supports\[2\].name: "R-101" is the name of supports\[0\] already'):
        gapbeam.read_scene(made)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda made: made["supports"][1].update(name="R-101"), r'supports[1].name: "R-101" is the name of supports[0] already'),
        (
            lambda made: made.update(hinges=[{"x": 2.0, "name": "R-102"}]),
            'hinges[0].name: "R-102" is the name of supports[1] already; give another one',
        ),
        (
            lambda made: made.update(hinges=[{"x": 2.0, "name": "joint"}, {"x": 6.0, "name": "joint"}]),
            'hinges[1].name: "joint" is the name of hinges[0] already; give another one',
        ),
        (lambda made: made["supports"][1].update(name=" "), "supports[1].name: is empty"),
        (lambda made: made["supports"][1].update(name="7"), 'supports[1].name: "7" could be taken for a number'),
        (lambda made: made["supports"][1].update(name=7), "supports[1].name: expected a text in quotes, got 7"),
        (lambda made: made["loads"][1].update(case="Dead"), 'loads[1].case: "Dead" is nearly "dead"'),
        (lambda made: made["loads"][1].update(case=""), "loads[1].case: is empty"),
        (lambda made: made["supports"][1].update(stiffness=-1.0), 'supports "R-102".stiffness: expected a number, 0 or more'),
        (lambda made: made["supports"][0].update(gap=1.0), 'supports "R-101".gap: only a support with side'),
        (lambda made: made["supports"].append(at(1, side="below", name="R-9")), 'this one and supports "R-102" both stand'),
        (lambda made: made["loads"][0].update(q=float("nan")), 'loads "weight".q: expected a finite number'),
    ],
)
def test_refusals(change, message):
    made = named()
    change(made)
    with pytest.raises(gapbeam.SceneError) as caught:
        gapbeam.read_scene(made)
    assert message in str(caught.value)


def test_combinations_may_have_numbers_for_names(tmp_path):
    """A text is a name before it is a number; a number is none."""
    made = named()
    cases = list(dict.fromkeys(load.get("case", "live") for load in made["loads"]))
    made["combinations"] = [
        {"name": name, "factors": dict.fromkeys(cases, factor)} for name, factor in (("1", 1.0), ("0", 2.0), ("7", 3.0))
    ]
    made["combinations"].append({"name": "scheme", "factors": {cases[0]: 1.0}, "scheme_of": "0"})
    result = gapbeam.solve(made)
    assert result.names == ("1", "0", "7", "scheme")
    first, second = result.combinations["1"], result.combinations["0"]
    assert (result.combinations[0].scene.title, result.combinations[1].scene.title) == (first.scene.title, second.scene.title)
    assert first.scene.title.endswith("1")
    with pytest.raises(KeyError, match="there is no combination"):
        result.combinations["2"]
    assert result.envelope().extremes["moment"]["max"].combination == "7"
    assert [one["name"] for one in result.to_dict()["combinations"]] == ["1", "0", "7", "scheme"]
    columns = {f"combinations.0.factors.{cases[0]}": [2.0, 9.0]}
    found = gapbeam.batch({**made, "combinations": made["combinations"][:2]}, columns, tmp_path / "out").read()
    others = [{"name": "x", "factors": {**dict.fromkeys(cases, 2.0), cases[0]: factor}} for factor in (2.0, 9.0)]
    given = [{**made, "combinations": [made["combinations"][0], one]} for one in others]
    largest = [gapbeam.solve(one).envelope().extremes["moment"]["max"].value for one in given]
    assert found["moment.max"] == pytest.approx(largest, rel=1e-12)
    with pytest.raises(gapbeam.SceneError, match="is the name of combinations"):
        gapbeam.solve({**made, "combinations": [made["combinations"][0]] * 2})
