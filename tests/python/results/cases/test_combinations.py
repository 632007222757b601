"""Combinations of load cases beside scenes whose loads are multiplied by hand."""

import json
import math
import pickle
import random

import gapbeam
import numpy as np
import pytest
from gapbeam.cli import main
from gapbeam.report import report_text, to_csv, to_json
from gapbeam.report.json_csv import json_parts
from gapbeam.results.cases.combined import WORST
from scenes import at, force, random_scene, scene, uniform
from scenes.law import law_scene

from .test_prepared import scaled

CASES = ("dead", "live", "wind")


def combined(rng, made):
    """A random scene with random cases and combinations of them, some of which move supports."""
    for load in made["loads"]:
        load["case"] = rng.choice(CASES)
    used = sorted({load["case"] for load in made["loads"]})
    made["combinations"] = [
        {"name": f"c{k}", "factors": {case: rng.choice((-1.0, 0.0, 0.9, 1.35)) for case in used if rng.random() < 0.8},
         "settlements": {str(i): rng.choice((-0.01, 0.004)) for i in range(len(made["supports"])) if rng.random() < 0.2}}
        for k in range(3)
    ]  # fmt: skip
    return made


def by_hand(made, one):
    """The scene of one combination, its loads multiplied, its supports moved."""
    written = scaled(made, [one["factors"].get(load["case"], 0.0) for load in made["loads"]])
    written["supports"] = [
        {**support, "settlement": support.get("settlement", 0.0) + one.get("settlements", {}).get(str(k), 0.0)}
        for k, support in enumerate(made["supports"])
    ]
    written["analysis"] = made.get("analysis", {})
    del written["combinations"]
    return written


def fails(made):
    """Whether a scene makes no sense."""
    try:
        gapbeam.solve(made)
    except gapbeam.SceneError:
        return True
    except gapbeam.EngineError:
        pass
    return False


def assert_same(result, made, seed):
    """Every combination beside the scene written by hand."""
    for one in made["combinations"]:
        found = result.combinations[one["name"]]
        if not found.has_answer:
            assert len(found.steps) == 0
            with pytest.raises(gapbeam.EngineError) as caught:
                gapbeam.solve(by_hand(made, one))
            assert found.status == caught.value.status.word, (seed, one)
            continue
        direct = gapbeam.solve(by_hand(made, one))
        assert found.status == direct.status, (seed, one)
        assert found.reason == direct.reason
        if direct.status == "solved":
            assert found._pairs_of_extremes() == direct._pairs_of_extremes(), (seed, one)
            assert found.steps[-1].reaction.tolist() == direct.steps[-1].reaction.tolist(), (seed, one)


@pytest.mark.parametrize("seed", range(60))
def test_combinations_are_scenes_with_scaled_loads(seed):
    rng = random.Random(seed)
    made = combined(rng, random_scene(rng, held=rng.choice((True, None))))
    if rng.random() < 0.7:
        made["analysis"] = {}
    else:
        made["analysis"]["follow"] = rng.choice(("steps", "events"))
    try:
        result = gapbeam.solve(made)
    except gapbeam.GapbeamError:
        assert any(map(fails, (by_hand(made, one) for one in made["combinations"])))
        return
    assert_same(result, made, seed)
    assert result.status == max(result.statuses, key=WORST.index)
    if "solved" in result.statuses:
        assert_exact_envelope(result)


def assert_exact_envelope(result):
    """Every extreme is that of the combination it comes from, and nothing is beyond it."""
    envelope = result.envelope(points=7)
    solved = [one for one in result.combinations.values() if one.status == "solved"]
    curves = envelope.fields
    for name, row in envelope.extremes.items():
        each = [one._pairs_of_extremes()[name] for one in solved]
        largest, smallest = row["max"], row["min"]
        assert largest.value == max(one["max"][0] for one in each)
        assert smallest.value == min(one["min"][0] for one in each)
        assert largest.value == result.combinations[largest.combination].extremes[name]["max"].value
        assert largest.combination in {source.combination for source in largest.ties}
        scale = 1e-9 * max(abs(largest.value), abs(smallest.value))
        assert curves.largest[name].max() <= largest.value + scale
        assert curves.smallest[name].min() >= smallest.value - scale
        assert np.all(curves.smallest[name] <= curves.largest[name])
    for k, row in enumerate(envelope.supports):
        for name in ("reaction", "opening", "deflection"):
            values = [getattr(one.steps[-1], name)[k] for one in solved]
            assert row[name]["max"].value == max(values)
            assert row[name]["min"].value == min(values)


@pytest.mark.parametrize("family", ["hardening", "softening"])
def test_laws(family):
    for seed in range(6):
        rng = random.Random(seed)
        made = combined(rng, law_scene(rng, family))
        try:
            result = gapbeam.solve(made)
        except gapbeam.SceneError:
            continue
        assert_same(result, made, seed)


def rack(**keys):
    """Three spans on supports that can lift off."""
    supports = [at(k, side="below", name=f"R-{k + 1}") for k in range(4)]
    loads = [uniform(2.0, case="dead"), force(3.0, 10.0, case="live"), uniform(1.0, case="wind")]
    return scene([6.0] * 3, supports, loads, EI=1e4) | {"combinations": [{"name": "cold", "factors": {"dead": 1.0}, **keys}]}


def test_names_order_and_equality_do_not_depend_on_one_another():
    made = rack()
    made["combinations"] += [{"name": "hot", "factors": {"dead": 1.35, "live": 1.5}, "settlements": {"R-2": 0.01}},
                             {"name": "wind", "factors": {"wind": -3.0}}]  # fmt: skip
    result = gapbeam.solve(made)
    assert result.names == ("cold", "hot", "wind")
    assert result.statuses == ("solved", "solved", "no-equilibrium")
    assert result.status == "no-equilibrium"
    assert result.reason.startswith('combination "wind": no equilibrium at load factor 1')
    turned = gapbeam.solve(made | {"combinations": made["combinations"][::-1]})
    for name in ("cold", "hot"):
        assert turned.combinations[name].steps[-1] == result.combinations[name].steps[-1]
    assert gapbeam.solve(made) == result != turned
    assert pickle.loads(pickle.dumps(result)) == result
    assert result.combinations[1].steps[-1].reaction.tolist() == result.combinations["hot"].steps[-1].reaction.tolist()
    with pytest.raises(KeyError, match="there is no combination"):
        result.combinations["warm"]
    with pytest.raises(ValueError, match="the scene has 3 combinations"):
        result.at(1.0)


def test_settlements_by_name_and_number_move_supports():
    by_name = gapbeam.solve(rack(settlements={"R-2": 0.01})).combinations["cold"].steps[-1]
    for key in (1, "1"):
        assert gapbeam.solve(rack(settlements={key: 0.01})).combinations["cold"].steps[-1] == by_name
    assert by_name.deflection[1] <= 0.01


def test_hot_sustained_keeps_open_supports_open_and_holds_closed_ones_both_ways():
    """A support that thermal movement lifts off carries none of the weight; a closed one may pull."""
    made = rack()
    made["combinations"] += [
        {"name": "hot", "factors": {"dead": 1.0}, "settlements": {"R-2": 0.05}},
        {"name": "sustained", "factors": {"dead": 1.0}, "scheme_of": "hot"},
        {"name": "lifted", "factors": {"wind": -1.0}, "scheme_of": "hot"},
    ]
    result = gapbeam.solve(made)
    hot, sustained, lifted = (result.combinations[name].steps[-1] for name in ("hot", "sustained", "lifted"))
    assert hot.state == ("closed", "open", "closed", "closed")
    assert sustained.state == ("bilateral", "open", "bilateral", "bilateral")
    free = {"beam": made["beam"], "supports": [at(0), at(2), at(3)], "loads": [uniform(2.0)]}
    assert sustained.reaction[[0, 2, 3]] == pytest.approx(gapbeam.solve(free).steps[-1].reaction, rel=1e-13)
    assert lifted.reaction[[0, 2, 3]] == pytest.approx(-0.5 * sustained.reaction[[0, 2, 3]], rel=1e-13)
    made["combinations"][1]["settlements"] = {"R-1": 5.0, "R-2": 5.0, "R-4": 5.0}
    made["beam"]["spans"] = [6.0, 12.0, 6.0]
    result = gapbeam.solve(made)
    if result.statuses[1] != "solved":
        assert "is not solved" in result.combinations["sustained"].reason


def test_what_has_no_unique_answer_is_recorded_and_the_others_go_on(tmp_path, capsys):
    supports = [at(0, name="left"), at(1, side="below"), at(2, side="below")]
    made = scene([2.0, 2.0], supports, [force(1.0, 5.0, case="a"), force(0.0, 3.0, case="b")], EI=math.inf) | {
        "combinations": [{"name": "b", "factors": {"b": 1.0}}, {"name": "a", "factors": {"a": 1.0}},
                         {"name": "after a", "factors": {"b": 1.0}, "scheme_of": "a"}]}  # fmt: skip
    result = gapbeam.solve(made)
    assert result.statuses == ("solved", "indeterminate", "indeterminate")
    assert result.reason.startswith('combination "a": a rigid stretch of the beam')
    assert '"a", whose contact state it takes, is not solved' in result.combinations["after a"].reason
    with pytest.raises(IndexError, match="no load step stands; a rigid stretch"):
        result.combinations["a"].at(1.0)
    assert result.envelope().supports[0]["reaction"]["max"].value == 3.0
    assert np.isfinite(result.envelope().fields.largest["moment"]).all()
    assert pickle.loads(pickle.dumps(result)) == result
    data = json.loads(to_json(result))
    assert [one["status"] for one in data["combinations"]] == list(result.statuses)
    assert "1 of 3 combinations solved" in report_text(result)
    (tmp_path / "rigid.json").write_text(json.dumps(made).replace("Infinity", "1e999"))
    assert main(["run", str(tmp_path / "rigid.json"), "--quiet"]) == 1
    assert 'combination "a": a rigid stretch' in capsys.readouterr().err
    steps = gapbeam.solve(made | {"analysis": {"follow": "events"}})
    assert steps.statuses == result.statuses


def test_scheme_that_is_a_mechanism_says_so():
    supports = [at(0, side="below"), at(1, side="below"), at(2, side="below")]
    made = scene([2.0, 2.0], supports, [force(2.0, 5.0, case="a"), force(1.0, 5.0, case="b")], EI=100.0) | {
        "combinations": [{"name": "x", "factors": {"a": 1.0}, "settlements": {0: 1.0, 2: 1.0}},
                         {"name": "y", "factors": {"b": 1.0}, "scheme_of": "x"}]}  # fmt: skip
    result = gapbeam.solve(made)
    assert result.combinations["x"].steps[-1].state == ("open", "closed", "open")
    assert result.statuses == ("solved", "no-equilibrium")
    assert 'in the contact state of "x"' in result.combinations["y"].reason


def test_signs_and_spans_expand_to_every_pattern():
    result = gapbeam.solve(rack(factors={"dead": 1.0, "live": 1.5, "wind": 2.0}, expand={"live": "signs", "wind": "spans"}))
    assert len(result.names) == 16
    assert result.names[0] == "cold [live +; wind 111]"
    assert result.names[-1] == "cold [live -; wind 000]"
    spans = [uniform(2.0, **{"from": 6.0 * k, "to": 6.0 * k + 6.0}) for k in (0, 2)]
    direct = gapbeam.solve(scene([6.0] * 3, [at(k, side="below") for k in range(4)],
                                 [uniform(2.0), force(3.0, -15.0), *spans], EI=1e4))  # fmt: skip
    found = result.combinations["cold [live -; wind 101]"]
    assert found.steps[-1].reaction == pytest.approx(direct.steps[-1].reaction, rel=1e-13)


def test_patterns_are_of_the_spans_that_the_case_reaches():
    """Loads of other cases stand in the other spans: they make no patterns."""
    made = rack(factors={"dead": 1.0, "live": 1.0, "snow": 1.0}, expand={"snow": "spans"})
    made["loads"].append(uniform(3.0, **{"from": 7.0, "to": 17.0, "case": "snow"}))
    result = gapbeam.solve(made)
    assert result.names == tuple(f"cold [snow {bits}]" for bits in ("11", "10", "01", "00"))
    stretches = {"11": (7.0, 17.0), "10": (7.0, 12.0), "01": (12.0, 17.0)}
    for bits, (start, stop) in stretches.items():
        direct = scene([6.0] * 3, made["supports"], [*made["loads"][:2], uniform(3.0, **{"from": start, "to": stop})], EI=1e4)
        found = result.combinations[f"cold [snow {bits}]"].steps[-1].reaction
        assert found == pytest.approx(gapbeam.solve(direct).steps[-1].reaction, rel=1e-13)


def test_linear_loads_are_cut_at_span_ends():
    made = rack(factors={"snow": 1.0, "dead": 1.0}, expand={"snow": "spans"})
    made["loads"].append({"type": "linear", "q": [1.0, 4.0], "from": 2.0, "to": 17.0, "case": "snow"})
    result = gapbeam.solve(made)
    whole = gapbeam.solve(scene([6.0] * 3, made["supports"], [made["loads"][0], made["loads"][-1]], EI=1e4))
    assert result.combinations["cold [snow 111]"].steps[-1].reaction == pytest.approx(whole.steps[-1].reaction, rel=1e-13)


def test_all_equal_values_are_named():
    made = rack()
    made["combinations"] = [{"name": "a", "factors": {"live": 1.0}}, {"name": "b", "factors": {"live": 1.0, "wind": 0.0}},
                            {"name": "c", "factors": {"live": 0.5}}]  # fmt: skip
    extreme = gapbeam.solve(made).envelope().extremes["moment"]["max"]
    assert [source.combination for source in extreme.ties] == ["a", "b"]
    assert extreme.x == 3.0
    assert extreme.concurrent["deflection"] == extreme.result.at(3.0).deflection


@pytest.mark.parametrize(("names", "words"), [("ab", "a, b"), ("abc", "a, b, c"), ("abcd", "a, b, c and 1 more")])
def test_the_report_names_a_few_of_equal_values(names, words):
    made = rack() | {"combinations": [{"name": name, "factors": {"live": 1.0}} for name in names]}
    (line,) = (line for line in report_text(gapbeam.solve(made)).splitlines() if line.startswith("moment"))
    assert line.split(None, 4)[-1].rstrip() == words


def test_smallest_reactions_are_not_floored_at_zero():
    """Dead reactions are in the envelope: the smallest is that of the dead load alone."""
    made = scene([4.0], [at(0), at(1)], [uniform(115.0, case="dead"), uniform(10.0)])
    made["combinations"] = [{"name": "g", "factors": {"dead": 1.0}}, {"name": "gq", "factors": {"dead": 1.0, "live": 1.5}}]
    row = gapbeam.solve(made).envelope().supports[0]["reaction"]
    assert (row["min"].value, row["min"].combination) == (230.0, "g")
    assert (row["max"].value, row["max"].combination) == (260.0, "gq")


def test_a_factor_between_governs():
    """D2: a simple beam with a stop at midspan has its largest sagging moment where the stop is reached."""
    length, EI, gap, q = 8.0, 1e4, 0.01, 2.5
    made = scene([length], [at(0), at(1), at(x=length / 2, side="below", gap=gap)], [uniform(q)], EI=EI)
    reached = 76.8 * EI * gap / length**4
    hint = next(one for one in gapbeam.solve(made).hints() if one.quantity == "moment" and one.kind == "max")
    assert hint.factor == pytest.approx(reached / q, rel=1e-12)
    assert hint.value == pytest.approx(9.6 * EI * gap / length**2, rel=1e-12)
    made["combinations"] = [{"name": "all", "factors": {"live": 1.0}}]
    result = gapbeam.solve(made)
    assert hint.value in [one.value for one in result.hints()]
    assert " 0.75 " in report_text(result, 120).split("Load factors between 0 and 1")[1]
    assert hint.value > result.envelope().extremes["moment"]["max"].value


def test_json_csv_and_report():
    made = rack() | {"title": "Rack"}
    made["combinations"].append({"name": "storm", "factors": {"wind": -3.0}})
    made["combinations"].append({"name": "snow", "factors": {"dead": 1.0, "wind": 1.5}})
    result = gapbeam.solve(made)
    data = json.loads(to_json(result, points=2))
    assert data == json.loads("".join(json_parts(result, points=2)))
    assert [one["status"] for one in data["combinations"]] == ["solved", "no-equilibrium", "solved"]
    assert data["combinations"][0]["supports"][1]["name"] == "R-2"
    largest = data["envelope"]["extremes"]["moment"]["max"]
    assert largest[0] == result.combinations["snow"].extremes["moment"]["max"].value
    assert largest[2]["combination"] == "snow"
    assert set(largest[2]["concurrent"]) == {"deflection", "rotation", "shear", "curvature"}
    assert data["envelope"]["supports"][0]["reaction"]["min"][1]["combination"] == "cold"
    assert len(data["envelope"]["fields"]["x"]) == len(data["envelope"]["fields"]["moment"]["max"])
    assert to_csv(result, points=1).splitlines()[0].startswith("x,deflection_max,deflection_min,")
    text = report_text(result, 110)
    assert text.index("What governs") < text.index("Supports, all combinations") < text.index("Combinations\n")
    assert "2 of 3 combinations solved" in text
    assert "No combination has loads of the case \"live\"." in text
    assert "storm: no equilibrium" in " ".join(text.split())


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"factors": {"snow": 1.0}}, 'combinations "cold".factors.snow: no load is of this case; the cases are "dead", "live" and'),
        ({"factors": {"dead": float("inf")}}, 'combinations "cold".factors.dead: expected a finite number, got inf'),
        ({"factors": {"dead": "1,35"}}, 'combinations[0].factors.dead: expected a number, got "1,35"'),
        ({"factors": [1.0]}, "combinations[0].factors: expected a table of numbers, got [1.0]"),
        ({"settlements": {"R-9": 0.01}}, 'combinations "cold".settlements.R-9: there is no support "R-9"; the names are'),
        ({"settlements": {9: 0.01}}, 'combinations "cold".settlements.9: there is no support 9; their numbers go from 0 to 3'),
        ({"settlements": {1: 0.01, "R-2": 0.01}}, "this support has a movement already"),
        ({"scheme_of": "cold"}, 'combinations "cold".scheme_of: is the combination itself'),
        ({"scheme_of": "warm"}, 'combinations "cold".scheme_of: there is no combination "warm"'),
        ({"expand": {"wind": "signs"}}, 'combinations "cold".expand.wind: has no factor'),
        ({"expand": {"wind": "sign"}}, 'combinations[0].expand.wind: expected "parts", "signs" or "spans", got "sign"'),
        ({"factors": {"live": 1.0}, "expand": {"live": "spans"}}, 'loads[1]: a case with expand = "spans" has distributed loads'),
        ({"name": None}, "combinations[0].name"),
        ({"factor": {}}, 'combinations[0].factor: unknown key; did you mean "factors"?'),
    ],
)  # fmt: skip
def test_refusals(keys, message):
    with pytest.raises(gapbeam.SceneError) as caught:
        gapbeam.read_scene(rack(**keys))
    assert message in str(caught.value)


def test_of_many_names_the_first_are_told_and_how_many_there_are_more():
    made = scene([1.0], [at(0), at(1)], [uniform(1.0)])
    made["combinations"] = [{"name": f"c{k}", "factors": {"live": 1.0}} for k in range(15)]
    made["combinations"][0]["scheme_of"] = "warm"
    with pytest.raises(gapbeam.SceneError, match=r'there are "c0", .*, "c11" and 3 more$'):
        gapbeam.read_scene(made)


def test_too_many_patterns_are_refused():
    made = scene([1.0] * 20, [at(k) for k in range(21)], [uniform(1.0)])
    made["combinations"] = [{"name": "p", "factors": {"live": 1.0}, "expand": {"live": "spans"}}]
    with pytest.raises(gapbeam.SceneError, match="makes 1,048,576 combinations"):
        gapbeam.read_scene(made)


def test_supports_inside_spans_have_no_patterns_by_span():
    made = scene([4.0], [at(0), at(x=2.0), at(1)], [uniform(1.0)])
    made["combinations"] = [{"name": "p", "factors": {"live": 1.0}, "expand": {"live": "spans"}}]
    with pytest.raises(gapbeam.SceneError, match="support 1 at x = 2 stands inside a span"):
        gapbeam.read_scene(made)


def test_a_factor_that_leaves_the_range_of_numbers_is_named():
    made = scene([4.0], [at(0), at(1)], [uniform(20.0, case="wind")])
    made["combinations"] = [{"name": "p", "factors": {"wind": 1e308}, "expand": {"wind": "signs"}}]
    with pytest.raises(gapbeam.SceneError, match=r'^combinations "p"\.factors\.wind: loads\[0\] times this factor is beyond'):
        gapbeam.solve(made)


def test_movements_that_leave_no_room_name_the_combination():
    made = scene([4.0], [at(0), at(1, side="below", gap=0.01), at(1, side="above", gap=0.01)], [uniform(1.0)])
    made["combinations"] = [{"name": "fine", "factors": {"live": 1.0}},
                            {"name": "jam", "factors": {"live": 1.0}, "settlements": {1: -0.05}}]  # fmt: skip
    with pytest.raises(gapbeam.SceneError, match=r'combinations "jam": supports.* leave no room'):
        gapbeam.solve(made)


def test_what_cannot_be_prepared_is_refused():
    with pytest.raises(gapbeam.SceneError, match="combinations: cases are prepared"):
        gapbeam.prepare(rack())
    made = rack(scheme_of="hot")
    made["combinations"].append({"name": "hot", "factors": {"dead": 1.0}})
    made["supports"][1]["law"] = [[0.01, 10.0]]
    with pytest.raises(gapbeam.SceneError, match='supports "R-2" has a law'):
        gapbeam.read_scene(made)




def test_a_scheme_that_is_not_decided_is_named():
    supports = [at(0), at(1, side="below", gap=0.0, name="mid"), at(2)]
    made = scene([2.0, 2.0], supports, [force(1.0, 0.0, case="a"), force(1.0, 5.0, case="b")], EI=100.0) | {
        "combinations": [{"name": "x", "factors": {"a": 1.0}}, {"name": "y", "factors": {"b": 1.0}, "scheme_of": "x"}]}  # fmt: skip
    result = gapbeam.solve(made)
    assert len(result.remarks) == 1
    assert 'takes the contact state of "x", in which reaction or opening of support mid' in result.remarks[0]
    with pytest.raises(IndexError, match="the scene has 2 combinations"):
        result.steps[-1]


def test_the_command_writes_all_of_it(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    made = rack()
    made["combinations"].append({"name": "snow", "factors": {"dead": 1.0, "wind": 1.5}, "expand": {"wind": "signs"}})
    (tmp_path / "rack.json").write_text(json.dumps(made))
    assert main(["run", "rack.json", "--quiet", "--json", "all.json", "--csv", "all.csv", "--plot", "all.svg"]) == 0
    assert list(json.loads((tmp_path / "all.json").read_text())["envelope"]) == ["supports", "extremes", "fields"]
    assert (tmp_path / "all.csv").read_text().startswith("x,deflection_max")
    assert ">R-4<" in (tmp_path / "all.svg").read_text()
    assert "B = snow [wind +]" in (tmp_path / "all.svg").read_text().replace("\N{NO-BREAK SPACE}", " ")
    assert main(["check", "rack.json"]) == 0
    assert "3 loads; 3 combinations" in capsys.readouterr().out
    assert main(["run", "rack.json", "--path", "path.svg"]) == 2
    told = capsys.readouterr().err
    assert "--path: draws the way of one load" in told
    assert told.endswith(': gapbeam.solve(SCENE).combinations[NAME].plot("path")\n')
    made["combinations"].append({"name": "storm", "factors": {"wind": -3.0}})
    (tmp_path / "rack.json").write_text(json.dumps(made))
    assert main(["run", "rack.json", "--quiet", "--csv", "all.csv"]) == 1
    assert 'combination "storm": no equilibrium' in capsys.readouterr().err
    assert (tmp_path / "all.csv").read_text().startswith("x,deflection_max")


def test_envelopes_on_the_ground_and_along_the_axis():
    loads = [uniform(5.0, case="dead"), force(1.0, 100.0, case="crane"), {"type": "axial", "x": 10.0, "F": 10.0, "case": "brake"}]
    made = scene([10.0], [{"node": 0, "direction": "axial", "name": "fix"}], loads, EI=2e4, EA=1e6)
    made["foundation"] = [{"k": 5e3, "side": "below", "name": "clay"}]
    made["combinations"] = [{"name": "g", "factors": {"dead": 1.0}},
                            {"name": "gq", "factors": {"dead": 1.35, "crane": 1.5, "brake": 1.5}, "expand": {"brake": "signs"},
                             "settlements": {"fix": 0.001}}]  # fmt: skip
    result = gapbeam.solve(made)
    assert_exact_envelope(result)
    extremes = result.envelope().extremes
    assert (extremes["axial_force"]["min"].value, extremes["axial_force"]["min"].combination) == (-15.0, "gq [brake -]")
    assert extremes["axial_displacement"]["max"].value == pytest.approx(0.001 + 15.0 * 10.0 / 1e6, rel=1e-13)
    pressure = extremes["pressure"]["max"]
    assert pressure.value == pytest.approx(5e3 * pressure.concurrent["deflection"], rel=1e-13)
    assert "clay" in json.dumps(result.to_dict(2))
    assert result.hints() == []
    assert "Not looked for" in report_text(result, 100)


AXIAL = [{"node": 0}, {"node": 0, "direction": "axial"}, {"node": 1}]
SLIDING = [{"node": 0, "friction": 0.3}, {"node": 1}]


def heated(supports, combinations):
    """A beam with a uniform load, cold or hot."""
    return {
        "beam": {"spans": [6.0], "EI": 3.0e3, "EA": 1.0e5, "alpha": 1.2e-5}, "supports": supports,
        "loads": [{"type": "uniform", "q": 2.0, "case": "dead"}, {"type": "temperature", "dT": 100.0, "case": "hot"}],
        "combinations": [{"name": name, "factors": dict.fromkeys(cases, 1.0)} for name, cases in combinations.items()],
    }  # fmt: skip


@pytest.mark.parametrize("supports", [AXIAL, SLIDING])
def test_where_nothing_acts_along_the_beam_its_axial_force_is_0(supports):
    result = gapbeam.solve(heated(supports, {"cold": ["dead"]}))
    data = json.loads(to_json(result))
    assert data["envelope"]["extremes"]["axial_force"]["max"][:2] == [0.0, 0.0]
    assert "Largest axial force" not in report_text(result)
    assert "axial_force" in result.to_html()
    assert pickle.loads(pickle.dumps(result)).combinations["cold"].at(3).axial_force == 0.0


@pytest.mark.parametrize("stiffness", [math.inf, 3000.0])
def test_an_axial_force_of_0_counts_in_the_envelope(stiffness):
    """Friction along the beam is followed from event to event, combination by combination, one of them without an axial load."""
    supports = [*AXIAL[:2], {"node": 1, "friction": 0.3, "stiffness": stiffness}]
    result = gapbeam.solve(heated(supports, {"cold": ["dead"], "hot": ["dead", "hot"]}))
    envelope, force = result.envelope(), 0.3 * 6.0
    assert [envelope.extremes["axial_force"][kind].value for kind in ("max", "min")] == pytest.approx([0.0, -force], abs=1e-12)
    assert envelope.extremes["axial_force"]["max"].combination == "cold"
    at = envelope.at(3.0)
    assert (at.largest["axial_force"], at.smallest["axial_force"]) == pytest.approx((0.0, -force), abs=1e-12)
    assert result.at(3.0, combination="cold").axial_force == 0.0


def test_what_bends_the_beam_in_one_combination_only():
    """Where nothing acts along it, what reactions balance is the shear."""
    scene = {
        "beam": {"spans": [3.0, 5.0], "EI": 3000.0}, "supports": [{"node": k} for k in range(3)],
        "loads": [{"type": "uniform", "q": 5.0, "case": "dead"}, {"type": "axial", "node": 2, "F": -40.0}],
        "combinations": [{"name": "A", "factors": {"dead": 1.2, "live": 1.2}},
                         {"name": "B", "factors": {"dead": 1.0}, "limit_state": "SLS"}],
    }  # fmt: skip
    scene["supports"].append({"node": 0, "direction": "axial"})
    result = gapbeam.solve(scene)
    alone = gapbeam.solve({**scene, "combinations": [], "loads": scene["loads"][:1]})
    extremes = result.combinations["B"].extremes
    assert extremes["transverse"]["max"].value == extremes["shear"]["max"].value == alone.extremes["shear"]["max"].value
    assert extremes["axial_force"]["min"].value == 0.0
    assert result.to_dict()["envelope"]
    assert result.report()


def test_a_temperature_after_a_combination_without_it_that_follows_a_settlement():
    """What a combination leaves out is there for the next one."""
    made = {
        "beam": {"spans": [3.0, 3.0], "EI": 1000.0, "EA": 1e6, "alpha": 1e-5},
        "supports": [{"node": 0}, {"node": 1}, {"node": 2}, {"node": 2, "direction": "axial"},
                     {"node": 0, "direction": "axial", "stiffness": 1e4}],
        "loads": [{"type": "temperature", "dT": -20.0, "case": "cold"}, {"type": "axial_uniform", "q": 1.0, "case": "drag"}],
    }  # fmt: skip
    moved = {"name": "moved", "factors": {"cold": 0.5, "drag": 1.0}, "settlements": {"4": -0.003}}
    others = [{"name": "warm", "factors": {"drag": 1.0}}, {"name": "cold", "factors": {"cold": 2.0, "drag": 1.0}}]
    result = gapbeam.solve({**made, "combinations": [moved, *others]})
    alone = [one.extremes["axial_force"] for one in result.combinations.values()]
    for way, most in (("max", max), ("min", min)):
        found = result.envelope().extremes["axial_force"][way].value
        assert found == pytest.approx(most(one[way].value for one in alone), rel=1e-14)
    assert alone[2]["max"].value > alone[1]["max"].value + 20.0
    cold = gapbeam.solve({**made, "combinations": [moved, others[0], {**others[1], "factors": {"cold": 6.0, "drag": 1.0}}]})
    source = cold.envelope().extremes["axial_force"]["max"].source
    assert source.combination == "cold"
