"""The answer in words: what lifts, the largest values, limits, plausibility."""

import json
from pathlib import Path

import gapbeam
import numpy as np
import pytest
import scenes
from gapbeam.cli import main
from gapbeam.report import report_text, to_json
from gapbeam.results import answer as answers
from gapbeam.results.formatting import shown, shown_column
from scenes.ground import pile, rail

EXAMPLES = sorted((Path(__file__).resolve().parents[3] / "examples").glob("*.toml"))
UNITS = {"force": "kN", "length": "m"}


def spans(loads, **more):
    supports = [scenes.at(k, side="below") for k in range(4)]
    return {**scenes.scene([6.0, 6.0, 6.0], supports, loads, EI=1e4), "units": UNITS, **more}


def simple(supports):
    """One span."""
    return scenes.scene([6.0], supports, [scenes.uniform(2.0)], EI=1e4)


def test_what_lifts_is_said_first():
    result = gapbeam.solve(spans([scenes.uniform(2.0, case="dead"), scenes.force(3.0, 160.0)]))
    assert repr(result).splitlines()[1] == "Support 2 (x = 12) lifts off by 24.3 mm."
    (one,) = result.lifted
    assert (one.support, one.factor) == (2, 1.0)
    assert one.opening == pytest.approx(0.0243, rel=1e-12)
    assert json.loads(to_json(result))["lifted"] == [{"support": 2, "opening": one.opening, "factor": 1.0}]


@pytest.mark.parametrize("N", [-10.0, 0.0])
def test_a_beam_that_does_not_stand_is_not_headed_as_solved(N):
    """The last state of its path can move freely, as the support lets go there."""
    supports, loads = [scenes.at(0), scenes.at(1, side="below")], [scenes.uniform(2.0, case="dead"), scenes.force(3.0, -40.0)]
    made = scenes.scene([4.0], supports, loads, EI=1e4, N=N)
    result = gapbeam.solve({**made, "analysis": {"follow": "events"}})
    assert result.status != "solved"
    assert result.steps[-1].indifferent
    lines = repr(result).splitlines()
    assert lines[0] == "Beam without a title"
    assert lines[1].startswith("No equilibrium")


def test_nothing_lifts():
    result = gapbeam.solve(spans([scenes.uniform(2.0)]))
    assert result.lifted == []
    assert repr(result).splitlines()[1] == "No support lifts off."


def test_a_gap_that_closes_is_told():
    made = spans([scenes.uniform(2.0)])
    made["supports"][1]["gap"] = 0.002
    assert repr(gapbeam.solve(made)).splitlines()[1:3] == ["Support 1 (x = 6) closes its gap of 2 mm.", "No support lifts off."]
    made["analysis"] = {"follow": "events"}
    lines = repr(gapbeam.solve(made)).splitlines()
    assert lines[1].startswith("Support 1 (x = 6) closes its gap of 2 mm at ")
    assert lines[1].endswith(" % of the load.")


def test_what_breaks_is_told_with_its_reaction():
    law = {"type": "brittle", "stiffness": 5e5, "limit": 90.0}
    made = scenes.scene([3.0, 2.0], [scenes.at(0), scenes.at(1, side="below", law=law),
                                     scenes.at(2, side="below", gap=0.04, stiffness=400.0)],
                        [scenes.force(5.0, 80.0)], EI=8e3, analysis={"follow": "events", "at_limit": "jump"})  # fmt: skip
    made["units"] = UNITS
    lines = report_text(gapbeam.solve(made)).splitlines()
    assert lines[1].startswith("Limit load at 70.")
    assert lines[1].rstrip().endswith("% of the load: support 1 (x = 3) breaks (90 kN).")
    assert not any("stays in contact" in line for line in lines)  # the pin is lost
    assert any(line.strip().startswith("0.70") and "support 1 (x = 3) breaks (90 kN)" in line for line in lines)


def test_sums_of_reactions_stand_above_those_of_loads():
    made = scenes.scene([4.0, 4.0], [scenes.at(0, rotation="fixed"), scenes.at(2), scenes.at(0, direction="axial")],
                        [scenes.uniform(2.0, case="dead"), {"type": "linear", "q": [0.0, 3.0], "from": 2.0},
                         {"type": "moment", "x": 3.0, "M": 7.0}, {"type": "axial", "node": 2, "F": 5.0}],
                        EI=1e4, EA=1e6, analysis={"steps": 2})  # fmt: skip
    made["units"] = UNITS
    text = report_text(gapbeam.solve(made)).splitlines()
    reactions, loads = (line.rstrip() for line in text if line.startswith("Sum of "))
    # 2 x 8 + 3 x 6 / 2, and 2 x 8 x 4 + 9 x 6 + 7
    assert reactions == "Sum of reactions  25 kN   moment about x = 0  125 kN m   along the beam  5 kN"
    assert loads.split() == ["Sum", "of", "loads", "25", "kN", "125", "kN", "m", "5", "kN"]


def test_rounding_is_written_as_zero():
    supports = [scenes.at(0), scenes.at(1), scenes.at(2)]
    made = scenes.scene([500.0, 600.0, 150.0], supports, [scenes.force(250.0, -2500.0)], EI=1.3e11)
    text = report_text(gapbeam.solve(made))
    assert "e-1" not in text.partition("Error bound")[0]


@pytest.mark.parametrize("unit", [1.0, 2.0**43])
def test_openings_of_restraints_are_rotations(unit):
    """However small the unit of length: an opening of 1.3e-3 is much beside the largest rotation, also in cases."""
    made = {"beam": {"spans": [4.0 * unit], "EI": 1e4 * unit**2},
            "supports": [{"node": 0, "rotation": {"stiffness": 1e3 * unit, "slack": 0.02}}, {"node": 1}],
            "loads": [{"type": "uniform", "q": 5.0 / unit}]}  # fmt: skip
    (one,) = gapbeam.solve(made).lifted
    assert (one.support, one.opening) == (2, pytest.approx(0.02 - 1.0 / 750.0, rel=1e-12))
    (of_cases,) = gapbeam.prepare(made).solve([[0.0], [1.0]]).lifted
    assert (of_cases.support, of_cases.case, of_cases.share) == (2, 0, 1.0)


def test_a_combination_is_named():
    combinations = [{"name": "heavy", "factors": {"dead": 1.0, "live": 1.0}}, {"name": "empty", "factors": {"dead": 1.0}}]
    result = gapbeam.solve(spans([scenes.uniform(2.0, case="dead"), scenes.force(3.0, 160.0)], combinations=combinations))
    (one,) = result.lifted
    assert (one.support, one.combination, one.factor) == (2, "heavy", None)
    lines = repr(result).splitlines()
    assert lines[1] == "2 of 2 combinations solved."
    assert lines[2].endswith("lifts off by 24.3 mm (heavy).")
    rows = report_text(result).partition("Reactions by combination")[2].splitlines()
    heavy = next(row for row in rows if row.startswith("heavy"))
    assert heavy.split() == ["heavy", "71.5", "119.75", "0", "\u219124.3", "4.75", "196", "196"]


def test_a_beam_that_cannot_stand_says_why():
    result = gapbeam.solve(spans([scenes.force(3.0, -1.0)]))
    assert result.lifted == []
    assert repr(result).splitlines()[1].startswith("No equilibrium.")
    for verbose in (False, True):  # there is no step to tell of
        text = report_text(result, verbose=verbose)
        assert "The mechanism" in text
        assert ("equations" in text) == verbose
        assert "0 steps" not in text


def test_limits_are_used_so_far(tmp_path, capsys):
    limits = {"moment": 411.0, "shear": 50.25, "opening": 0.03}
    made = spans([scenes.uniform(2.0, case="dead"), scenes.force(3.0, 160.0)], limits=limits)
    result = gapbeam.solve(made)
    used = result.utilisations
    assert [used[name].ratio for name in ("moment", "shear", "opening")] == pytest.approx([0.5, 2.0, 0.81], rel=1e-12)
    assert (used["shear"].x, used["opening"].support) == (6.0, 2)
    assert any(line.startswith("Limit of shear") and "200% used, EXCEEDED" in line for line in report_text(result).splitlines())
    assert json.loads(to_json(result))["utilisations"]["moment"] == used["moment"].to_dict()
    scene = tmp_path / "a.json"
    scene.write_text(json.dumps(made))
    assert main(["run", str(scene), "--quiet"]) == 0
    assert main(["run", str(scene), "--quiet", "--limits"]) == 1
    assert "shear" in capsys.readouterr().err
    del made["limits"]
    scene.write_text(json.dumps(made))
    assert main(["run", str(scene), "--quiet", "--limits"]) == 2
    assert "--limits: the scene has no [limits]" in capsys.readouterr().err


def test_a_pressure_per_area_needs_a_width():
    ground = {"foundation": [{"k": 1e4, "side": "below"}], "limits": {"pressure": 150.0}}
    made = {**scenes.scene([6.0], [], [scenes.uniform(30.0)], EI=1e5), **ground}
    with pytest.raises(gapbeam.SceneError, match=r"beam\.width"):
        gapbeam.solve(made)
    made["beam"]["width"] = 1.5
    assert gapbeam.solve(made).utilisations["pressure"].value == pytest.approx(20.0, rel=1e-12)
    with pytest.raises(gapbeam.SceneError, match="no foundation"):
        gapbeam.solve(spans([scenes.uniform(2.0)], limits={"pressure": 1.0}))


@pytest.mark.parametrize(
    ("made", "words"),
    [
        (spans([scenes.force(3.0, -1.0)]), "loads[0].F = -1 acts upward; loads are positive downward."),
        (spans([scenes.uniform(0.0)]), "all values of loads are 0"),
        (spans([scenes.uniform(2.0)], combinations=[{"name": "a", "factors": {"live": 1.0}, "settlements": {"1": 15.0}}]),
         "combinations a.settlements.1 = 15 is 250 % of the shortest span"),
        (simple([scenes.at(0), scenes.at(1), scenes.at(0, side="below", gap=0.2)]),
         "supports[2].gap = 0.2 is 3.3 % of the shortest span"),
        (simple([scenes.at(0), scenes.at(1, stiffness=5.0)]), "supports[1].stiffness = 5 "),
        ({**simple([]), "foundation": [{"k": 3.0, "side": "below"}]}, "foundation[0].k = 3 "),
        (simple([scenes.at(0), scenes.at(1), scenes.at(0, side="below", gap=0.004)]), None),
        (simple([scenes.at(0), scenes.at(1, stiffness=5e3)]), None),
        (spans([], trains=[{"name": "t", "axles": [[0.0, 1.0]]}]), None),
    ],
)  # fmt: skip
def test_checks_name_key_and_value(made, words):
    lines = [line for line in repr(gapbeam.solve(made)).splitlines() if line.startswith("Check: ")]
    assert len(lines) == (words is not None)
    assert words is None or words in lines[0]


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_no_example_is_doubted(path):
    assert "Check:" not in repr(gapbeam.solve(path))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"EI": 10.0}, "beam.EI = 10"),
        ({"EI": 1e15}, "beam.EI = 1e+15"),
        ({"gap": 2.0}, "supports[2].gap = 2"),
        ({"loads": []}, "loads is empty"),
        ({}, None),
    ],
)
def test_slips_are_named(change, words):
    made = spans(change.get("loads", [scenes.uniform(2.0)]))
    made["beam"]["EI"] = change.get("EI", 1e4)
    made["supports"][2]["gap"] = change.get("gap", 0.0)
    text = repr(gapbeam.solve(made))
    assert ("?" in text or "empty" in text) == (words is not None)
    assert words is None or words in text


@pytest.mark.parametrize(
    ("places", "words"), [({"from": 14.5, "to": 20.0}, "trains[0] has no axle on the beam"), ({"to": 20.0}, None)]
)
def test_a_train_that_never_comes_to_the_beam_is_named(places, words):
    made = spans([scenes.uniform(2.0, case="dead")]) | {"trains": [{"axles": [[0.0, 5.0], [2.0, 5.0]], **places}]}
    made["beam"]["spans"] = [6.0, 6.0]
    made["supports"] = made["supports"][:3]
    text = repr(gapbeam.solve(made))
    assert ("Check:" in text) == (words is not None)
    assert words is None or words in " ".join(text.split())


def test_numbers_near_the_end_of_the_range_are_written():
    scene = gapbeam.read_scene(spans([scenes.uniform(2.0)]))
    assert shown(scene, "deflection", np.float64(1.25e307)) == "1.2500e+310"
    assert shown_column(scene, "opening", [0.0, 1.25e307]) == ("opening\nmm", ["0", "1.2500e+310"])


def test_a_path_of_many_states_says_what_is_at_full_load(monkeypatch):
    result = gapbeam.solve(pile(20.0))
    monkeypatch.setattr(answers, "MOST_WORK", 0)
    said = answers.answer(result)
    assert "largest values are looked for on request only" in said[0]
    largest = result.steps[-1].extremes["shear"]["max"]
    assert said[1] == "At full load:"
    assert any(line.startswith("Largest shear") and f"{largest.value:.4f}"[:5] in line for line in said)


def test_states_on_ground_take_longer(monkeypatch):
    """A pile and a rail with as many states: one has stretches in which the modulus changes, the other has not."""
    monkeypatch.setattr(answers, "MOST_WORK", 300_000)
    assert not answers.has_cheap_envelope(gapbeam.solve(pile(20.0)))
    assert answers.has_cheap_envelope(gapbeam.solve(rail(follow="steps", steps=99)))


def test_a_hold_down_that_carries_at_times_is_not_said_to_have_no_contact():
    """At other load factors, in other combinations, while trains pass."""
    ends = [scenes.at(0, side="above", gap=0.001), scenes.at(0, side="below"), scenes.at(1), scenes.at(2)]
    lift = scenes.force(9.0, 80.0, case="lift")
    made = scenes.scene([6.0, 6.0], ends, [scenes.uniform(2.0, case="dead"), lift], EI=1e4) | {"units": UNITS}
    combinations = [{"name": "rest", "factors": {"dead": 1.0}}, {"name": "up", "factors": {"dead": 1.0, "lift": 1.0}}]
    combined = gapbeam.solve({**made, "combinations": combinations})
    assert combined.combinations["up"].steps[-1].reaction[0] < -1.0
    said = "Support 0 (x = 0) is not always in contact: opening up to 1 mm (gap 1 mm, rest)."
    assert said in repr(combined)
    assert said in repr(combined.envelope())
    rest = gapbeam.solve({**made, "combinations": combinations[:1]})
    assert "Support 0 (x = 0) has no contact: opening 1 mm (gap 1 mm, rest)." in repr(rest)
    train = gapbeam.solve({**made, "loads": made["loads"][:1], "trains": [{"name": "crane", "axles": [[0.0, 80.0]]}]})
    assert "Support 0 (x = 0) is not always in contact: opening up to 1 mm (gap 1 mm, crane at " in repr(train)
    there_and_back = {**made, "analysis": {"follow": "events", "history": [1.0, -1.0]}}
    said = "Support 0 (x = 0) is not always in contact: opening up to 1 mm (gap 1 mm, load factor "
    assert said in repr(gapbeam.solve(there_and_back))
