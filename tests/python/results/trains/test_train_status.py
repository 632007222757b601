"""What a scene with trains is: solved at all positions, or not; and what the beam does without them."""

import json

import gapbeam
import pytest
from gapbeam.cli import main
from gapbeam.report import report_text, to_json


def plank(**changes):
    """A plank on two trestles; the board at its end has no hold without the man that stands on it."""
    made = {
        "beam": {"spans": [2.0, 1.0], "EI": 1.0},
        "supports": [{"node": 0, "side": "below"}, {"node": 1, "side": "below"}],
        "loads": [{"type": "uniform", "q": 1.0, "case": "dead"}],
        "trains": [{"name": "man", "axles": [[0.0, 5.0]]}],
    }
    return {**made, **changes}


def test_the_status_counts_positions(tmp_path, capsys):
    result = gapbeam.solve(plank())
    assert result.status == "no-equilibrium"
    assert result.reason.startswith("train man, positions 2.3 to 3: no equilibrium: the beam tips about the support at x = 2")
    assert result.without_trains is None
    assert result.envelope().extremes["moment"]["max"] is not None
    data = json.loads(to_json(result))
    assert (data["status"], data["reason"]) == (result.status, result.reason)
    assert "Positions that are not solved" in report_text(result)
    assert gapbeam.solve(plank(trains=[{"axles": [[0.0, 5.0]], "to": 2.2}])).status == "solved"
    path = tmp_path / "plank.json"
    path.write_text(json.dumps(plank()))
    outputs = ["--json", str(tmp_path / "out.json"), "--csv", str(tmp_path / "out.csv")]
    assert main(["run", str(path), "--quiet", *outputs]) == 1
    assert capsys.readouterr().err.endswith("no support resists\n")
    assert (tmp_path / "out.csv").exists()
    done = gapbeam.batch(plank(), {"trains[0].axles[0][1]": [5.0, 0.5]}, tmp_path / "cases")
    assert list(done.read()["status"]) == ["no-equilibrium", "solved"]


def test_a_state_without_train_that_falls(tmp_path, capsys):
    """It is in no envelope: the answer stands, and this is said."""
    made = plank(loads=[{"type": "uniform", "q": 1.0, "case": "dead"}, {"type": "force", "x": 3.0, "F": 2.0, "case": "dead"}],
                 trains=[{"name": "man", "axles": [[0.0, 20.0]], "from": 0.5, "to": 1.0}])  # fmt: skip
    result = gapbeam.solve(made)
    assert (result.status, result.reason) == ("solved", None)
    assert result.without_trains.startswith("no equilibrium at load factor 1: the beam tips about the support at x = 2")
    state = gapbeam.solve({**made, "trains": [], "loads": [*made["loads"], {"type": "force", "x": 0.5, "F": 20.0}]})
    assert result.trains["man"].state(0.5).reaction == pytest.approx(state.steps[-1].reaction, rel=1e-12)
    largest = result.envelope().extremes["moment"]["max"]
    assert largest.value >= state.extremes["moment"]["max"].value * (1 - 1e-12)
    data = json.loads(to_json(result))
    assert data["status"] == "solved"
    assert data["without_trains"] == result.without_trains
    assert "reason" not in data
    text = report_text(result)
    assert "Without its trains the beam is unstable" in text
    assert "This state is not in the envelope" in text
    (tmp_path / "plank.json").write_text(json.dumps(made))
    assert main(["run", str(tmp_path / "plank.json"), "--quiet"]) == 0
    assert capsys.readouterr().err == ""
    # Beside a combination without the train it counts
    combinations = [{"name": "with", "factors": {"dead": 1.0, "live": 1.0}}, {"name": "without", "factors": {"dead": 1.0}}]
    combined = gapbeam.solve({**made, "combinations": combinations})
    assert combined.statuses == ("solved", "no-equilibrium")
    assert combined.combinations["with"].without_trains == result.without_trains
    assert combined.envelope().extremes["moment"]["max"].value == pytest.approx(largest.value, rel=1e-12)
    report_text(combined)
    assert json.loads(to_json(combined))["combinations"][0]["without_trains"] == result.without_trains


def test_positions_that_fall_in_a_combination():
    combinations = [{"name": name, "factors": {"dead": 1.0, "live": live}} for name, live in (("heavy", 1.0), ("light", 0.1))]
    result = gapbeam.solve(plank(combinations=combinations))
    assert result.statuses == ("no-equilibrium", "solved")
    assert result.status == "no-equilibrium"
    assert "train man, positions 2.3 to 3" in result.reason
    assert {member.combination for member in result.envelope()._members} == {"heavy", "light"}
    assert "They are left out" not in report_text(result)
    # The scheme of a combination whose state without trains stands can be taken
    combinations.append({"name": "after", "factors": {"dead": 1.2}, "scheme_of": "heavy"})
    assert gapbeam.solve(plank(combinations=combinations)).statuses == ("no-equilibrium", "solved", "solved")


@pytest.mark.parametrize("turn", [1, -1])
def test_a_combination_that_stands_nowhere_hides_none_that_stands(turn):
    """Heavy, the man on the board makes the plank tip at all his positions; light, it stands at all of them."""
    combinations = [{"name": name, "factors": {"dead": 1.0, "live": live}} for name, live in (("heavy", 1.0), ("light", 0.1))]
    trains = [{"name": "man", "axles": [[0.0, 5.0]], "from": 2.5}]
    both = gapbeam.solve(plank(trains=trains, combinations=combinations[::turn]))
    light = gapbeam.solve(plank(trains=trains, combinations=combinations[1:]))
    assert (sorted(both.statuses), light.statuses) == (["no-equilibrium", "solved"], ("solved",))
    found, expected = both.envelope().fields, light.envelope().fields
    for name, values in expected.largest.items():
        assert found.largest[name].tolist() == values.tolist()
        assert found.smallest[name].tolist() == expected.smallest[name].tolist()
        assert found.largest_at[name].tolist() == expected.largest_at[name].tolist()


def test_combinations_of_which_none_has_an_answer_can_be_shown(tmp_path, capsys):
    """A rigid beam on three rigid supports: no forces are unique, with and without the train."""
    scene = {
        "beam": {"spans": [1.0, 1.0], "EI": float("inf")}, "supports": [{"node": i} for i in range(3)],
        "loads": [{"type": "uniform", "q": 1.0, "case": "dead"}], "trains": [{"name": "t", "axles": [[0.0, 1.0]]}],
        "combinations": [{"name": "a", "factors": {"dead": 1.0, "live": 1.0}}, {"name": "b", "factors": {"dead": 1.0}}],
    }  # fmt: skip
    result = gapbeam.solve(scene)
    assert set(result.statuses) == {"indeterminate"}
    assert "0 of 2 combinations solved" in result._repr_html_()
    assert "Envelope of 0 of 2 combinations, the others are not solved" in str([text.get_text() for text in result.plot().texts])
    path = tmp_path / "rigid.toml"
    gapbeam.read_scene(scene).to_toml(path)
    assert main(["run", str(path), "--quiet", "--plot", str(tmp_path / "rigid.svg"), "--html", str(tmp_path / "rigid.html")]) == 1
    assert "statics" in capsys.readouterr().err


@pytest.mark.parametrize("combined", [False, True])
def test_a_train_under_which_the_beam_always_falls_can_be_shown(tmp_path, combined):
    """Nothing is said of supports then."""
    heavy = plank(trains=[{"name": "man", "axles": [[0.0, 5.0]], "from": 2.9, "to": 3.0}])
    if combined:
        heavy["combinations"] = [{"name": "a", "factors": {"dead": 1.0, "live": 1.0}}]
    result = gapbeam.solve(heavy)
    assert result.status == "no-equilibrium"
    assert result.envelope().extremes["moment"] == {"max": None, "min": None}
    for shown in (result, result.envelope()):
        assert "lifts off" not in repr(shown) + shown.report()
        assert "of 1 combination" in repr(shown) or "tips" in repr(shown)
        assert shown.lifted == []
    assert set(result.envelope().states.to_dict().values()) == {()}
    assert "nan" not in result._repr_html_().partition("<img")[0]
    words = " ".join(text.get_text() for text in result.plot().texts)
    assert ("Envelope of 0 of 1 combination" if combined else "tips about") in words
    assert "tips about" in result.to_html(tmp_path / "page.html")


def test_positions_have_no_zero_below_zero():
    tipping = plank(supports=[{"x": 1.0, "side": "below"}, {"node": 2, "side": "below"}], loads=[])
    result = gapbeam.solve(tipping)
    assert result.reason.startswith("train man, positions 0 to 1: ")
    assert "man, 0 to 1: no equilibrium" in report_text(result)
