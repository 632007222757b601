"""The verbs of results for envelopes, trains, prepared cases, batches and summaries: the same words with the same meaning."""

import json
import pickle
import zipfile

import gapbeam
import numpy as np
import pytest
from matplotlib.figure import Figure

from .test_verbs import BEAM, COMBINATIONS, LOADS, SUPPORTS, scene

VERBS = (
    "status", "ok", "reason", "raise_for_status", "reactions", "openings", "lifted", "extremes", "table", "plot", "report",
    "to_dict", "to_json", "to_excel", "_repr_html_",
)  # fmt: skip


@pytest.fixture(scope="module")
def things(tmp_path_factory):
    followed = gapbeam.solve(scene(analysis=gapbeam.Analysis(follow="events")))
    combined = gapbeam.solve(scene(combinations=COMBINATIONS))
    crane = gapbeam.Train(name="crane", axles=[(0.0, 100.0)])
    train = gapbeam.solve(gapbeam.Scene(beam=BEAM, supports=SUPPORTS, loads=LOADS[:1], trains=[crane]))
    cases = gapbeam.prepare(scene()).solve([[1.0, 0.0], [1.0, 1.0], [1.0, 1.5]])
    batch = gapbeam.batch(scene(), {"factors.crane": [0.0, 1.0, 1.5]}, tmp_path_factory.mktemp("batch") / "b")
    return {
        "result": followed, "combined": combined, "one load": gapbeam.solve(scene()).envelope(), "envelope": combined.envelope(),
        "over the path": followed.path_envelope(), "over trains": train.envelope(), "train": train.trains["crane"],
        "cases": cases, "case": cases[1], "batch": batch, "summary": batch.summary(),
    }  # fmt: skip


NAMES = ("result", "combined", "one load", "envelope", "over the path", "over trains", "train", "cases", "case", "batch", "summary")


@pytest.mark.parametrize("name", NAMES)
def test_all_have_the_same_verbs(things, name, tmp_path):
    one = things[name]
    assert [verb for verb in VERBS if not hasattr(type(one), verb) and verb not in dir(one)] == []
    assert np.all(one.ok)
    assert one.raise_for_status() is one
    assert one.reason is None
    text = repr(one)
    assert 2 <= len(text.splitlines()) <= 12
    assert "object at 0x" not in text
    assert isinstance(one.plot(), Figure)
    assert one.plot(str(tmp_path / "a.svg")).axes
    assert (tmp_path / "a.svg").read_text().startswith("<?xml")
    assert one.report().count("\n") >= 2
    told = one.to_json(tmp_path / "a.json")
    assert json.loads(told) == json.loads((tmp_path / "a.json").read_text())
    shown = one._repr_html_()
    assert shown.startswith("<div>")
    assert "<img" in shown
    assert "<script" not in shown


@pytest.mark.parametrize("name", NAMES)
def test_tables_become_sheets(things, name, tmp_path):
    pytest.importorskip("xlsxwriter")
    one = things[name]
    one.to_excel(tmp_path / "a.xlsx")
    with zipfile.ZipFile(tmp_path / "a.xlsx") as book:
        names = book.read("xl/workbook.xml").decode()
        assert 'name="answer"' in names
        words = book.read("xl/sharedStrings.xml").decode()
    whole = one.result() if name == "case" else one
    for kind in whole._kinds:
        table = whole.table(kind)
        assert (f'name="{kind}"' in names) == (table.count > 0)
        assert all(f"<t>{heading}</t>" in words for heading in table if table.count)
    with pytest.raises(ValueError, match=r"ends in \.xlsx"):
        one.to_excel(tmp_path / "a.txt")


def test_without_xlsxwriter_the_message_says_how_to_install_it(things, monkeypatch, tmp_path):
    monkeypatch.setitem(__import__("sys").modules, "xlsxwriter", None)
    with pytest.raises(ImportError, match=r'pip install "gapbeam\[excel\]"'):
        things["result"].to_excel(tmp_path / "a.xlsx")


def test_a_table_that_no_sheet_holds_is_refused(things, monkeypatch, tmp_path):
    pytest.importorskip("xlsxwriter")
    monkeypatch.setattr(gapbeam.show.excel, "MOST_ROWS", 3)
    with pytest.raises(ValueError, match="write table"):
        things["result"].to_excel(tmp_path / "a.xlsx")


@pytest.mark.parametrize("name", ["one load", "envelope", "over the path", "over trains", "train"])
def test_parts_have_ranges(things, name):
    one = things[name]
    for quantity, values in (("reaction", one.reactions), ("opening", one.openings)):
        for k, key in enumerate("ABCD"):
            assert values[key] is not values[k] or values[key] == values[k]
            rows = one._ranges.supports[k][quantity]
            assert values[key]["max"].value == rows["max"].value >= values[k]["min"].value
    assert one.states["C"] in (("open",), ("closed", "open"), ("closed",))
    curves = one.envelope(x=[3.0, 7.0]).fields if name == "train" else one.at([3.0, 7.0])
    assert np.all(curves.largest["moment"] >= curves.smallest["moment"])
    assert one.table("supports")["reaction_max"].tolist() == [row["max"].value for row in one.reactions]
    assert "moment_max" in one.table("fields")
    with pytest.raises(ValueError, match="kind: expected"):
        one.table("cases")
    axes = Figure().add_subplot()
    assert one.plot("moment", ax=axes) is axes.figure
    with pytest.raises(ValueError, match="kind: expected None"):
        one.plot("path")


def test_states_of_parts_are_all_that_occur(things):
    lifts = things["result"].openings["C"] > 0.0
    assert lifts
    assert things["over the path"].states["C"] == ("closed", "open")
    assert things["over the path"].states["A"] == ("closed",)
    assert things["envelope"].states["C"] == ("closed", "open")
    train = things["train"]
    occur = {train.state(position).state[3] for position in np.linspace(0.01, 17.99, 60)}
    assert train.states["D"] == tuple(sorted(occur))


def test_a_state_of_an_envelope(things):
    combined, envelope = things["combined"], things["envelope"]
    assert envelope.at(3.0, combination="lift").moment == combined.at(3.0, combination="lift").moment
    assert things["over the path"].at(3.0, factor=0.5).moment == things["result"].at(3.0, factor=0.5).moment
    assert things["over trains"].at(3.0, position=2.0).moment == things["train"].at(3.0, position=2.0).moment


@pytest.mark.parametrize("name", NAMES[:7])
def test_extremes_are_of_one_type(things, name):
    one = things[name]
    for field in ("moment", "shear", "deflection", "rotation"):
        for extreme in one.extremes[field].values():
            assert isinstance(extreme, gapbeam.Extreme)
            assert extreme.source.to_dict().keys() <= {"combination", "factor", "leg", "train", "position", "direction", "side"}
            there = extreme.concurrent
            assert there.keys() >= {"moment", "shear", "deflection", "rotation"} - {field}
            side = extreme.state.values(*one._result._beam.find(np.array([extreme.x]), False)) if hasattr(one, "_result") else None
            assert side is None or np.isfinite(side).all()
    assert f"{one.extremes['moment']['max'].value:.6g}" in repr(one.extremes)
    with pytest.raises(KeyError, match="did you mean 'moment'"):
        one.extremes["M"]


def test_what_goes_with_an_extreme_of_a_state(things):
    step = things["result"].steps[-1]
    largest = step.extremes["moment"]["max"]
    at = things["result"].at(largest.x)
    assert largest.concurrent["deflection"] == pytest.approx(float(at.deflection))
    assert largest.source.factor == step.factor
    assert largest.state is step
    least = step.extremes["shear"]["min"]
    left = things["result"].at(least.x, side="left")
    assert least.concurrent["moment"] == pytest.approx(float(left.moment))


def test_of_the_whole_way(things):
    result = things["result"]
    largest = result.history_extremes["deflection"]["min"]
    assert largest.value == result.path_envelope().extremes["deflection"]["min"].value
    assert largest.source.factor is not None
    with pytest.raises(ValueError, match="the load is not followed"):
        gapbeam.solve(scene()).history_extremes["moment"]


def test_old_calls_say_what_to_write(things):
    result, cases, train = things["result"], things["cases"], things["train"]
    with pytest.warns(DeprecationWarning, match="write result.extremes"):
        old = result.extremes()
    assert old["moment"]["max"] == (result.extremes["moment"]["max"].value, result.extremes["moment"]["max"].x)
    with pytest.warns(DeprecationWarning, match="path_envelope"):
        assert result.history_extremes().extremes["moment"]["max"].value == result.history_extremes["moment"]["max"].value
    with pytest.warns(DeprecationWarning, match="write cases.extremes"):
        values, x = cases.extremes()["moment"]["max"]
    assert values.tolist() == cases.extremes["moment"]["max"].value.tolist()
    assert x.tolist() == cases.extremes["moment"]["max"].x.tolist()
    with pytest.warns(DeprecationWarning, match="by support"):
        assert cases.states().at_supports.shape == (3, 4, 4)
    with pytest.warns(DeprecationWarning, match="step.extremes"):
        values, _ = result.steps[-1].extremes()
    assert values[0, 2] == result.extremes["moment"]["max"].value
    with pytest.warns(DeprecationWarning, match="is an attribute"):
        assert train.extremes["moment"]["max"].source()["train"] == "crane"
    with pytest.warns(DeprecationWarning, match=r"x = \[...\]"):
        assert train.envelope([3.0]).fields.x.tolist() == [3.0]
    for old in ("beam", "rule"):
        with pytest.warns(DeprecationWarning, match=f"{old} is no longer for users"):
            assert getattr(result, old) is getattr(result, f"_{old}")
    with pytest.warns(DeprecationWarning, match="failed_chunks"):
        assert things["batch"].failed_chunks() == []
    with pytest.warns(DeprecationWarning, match="asdict"):
        assert things["summary"].asdict() == things["summary"].to_dict()


def test_the_old_name_of_further_settlements():
    prepared = gapbeam.prepare(scene())
    with pytest.warns(DeprecationWarning, match="extra_settlement"):
        old = prepared.solve([1.0, 1.0], settlements={"B": 0.01})
    assert old == prepared.solve([1.0, 1.0], extra_settlement={"B": 0.01})
    with pytest.warns(DeprecationWarning, match="extra_settlement"):
        assert prepared.result([1.0, 1.0], settlements={"B": 0.01}).reactions["B"] == pytest.approx(old.reactions["B"])
    assert repr(prepared).startswith("Prepared(Beam without a title: 3 spans, 4 supports, 2 loads)")


@pytest.mark.filterwarnings("error::DeprecationWarning")
@pytest.mark.parametrize("name", ["result", "combined", "over trains", "cases", "summary"])
def test_the_package_itself_uses_no_old_names(things, name):
    one = things[name]
    assert repr(one)
    assert one.report()
    assert one.plot().axes
    assert one.to_json()
    if name in ("result", "combined", "over trains"):
        assert one.to_html()


def test_a_train_demands_a_position(things):
    train = things["train"]
    for wrong in (lambda: train.at(7.3), lambda: train.at(7.3, "right"), lambda: train.at()):
        with pytest.raises(TypeError, match=r"give the position of the train too, .* What was at\(7.3\) is state\(7.3\)"):
            wrong()
    with pytest.warns(DeprecationWarning, match="state"):
        assert train.at(position=7.3).reaction.tolist() == train.state(7.3).reaction.tolist()
    assert train.at([1.0, 2.0], position=7.3).moment.shape == (2,)
    largest = train.state(7.3).extremes["moment"]["max"]
    assert (largest.source.train, largest.source.position) == ("crane", 7.3)
    assert train.at(largest.x, position=7.3).moment == pytest.approx(largest.value)
    assert train.table("events")["position"].tolist() == [event.position for event in train.events]


def test_a_train_that_tips_the_beam():
    tips = gapbeam.solve({
        "beam": {"spans": [4.0, 2.0], "EI": 1e4}, "supports": [{"node": 0, "side": "below"}, {"node": 1}],
        "trains": [{"name": "man", "axles": [[0.0, 1.0]]}],
    })  # fmt: skip
    train = tips.trains["man"]
    assert not train.ok
    assert (train.status, train.reason) == (tips.status, tips.reason)
    with pytest.raises(gapbeam.UnsolvedError, match="positions 4 to 6"):
        train.raise_for_status()
    assert "Positions" in repr(train) or "positions" in repr(train)


def test_a_train_on_a_beam_that_is_free_to_move():
    free = gapbeam.solve({
        "beam": {"spans": [4.0], "EI": 1e4}, "supports": [{"x": 2.0}],
        "trains": [{"name": "man", "axles": [[0.0, 1.0]], "from": 2.0, "to": 2.0}],
    }).trains["man"]  # fmt: skip
    assert free.ok
    assert free.reason.startswith("positions 2 to 2: the beam can move freely")
    assert "deflection" not in repr(free)


def test_cases_are_arrays_by_case(things):
    cases, prepared = things["cases"], gapbeam.prepare(scene())
    assert len(cases) == 3
    assert cases.status.tolist() == [gapbeam.Status.SOLVED] * 3
    assert cases.ok.tolist() == [True] * 3
    assert cases.reactions["B"].tolist() == cases.reaction[:, 1].tolist() == cases.reactions[1].tolist()
    assert np.asarray(cases.reactions).T.tolist() == cases.reaction.tolist()
    for k, case in enumerate(cases):
        whole = prepared.result([1.0, [0.0, 1.0, 1.5][k]])
        assert case == prepared.solve([1.0, [0.0, 1.0, 1.5][k]])
        for key in "ABCD":
            assert case.reactions[key] == pytest.approx(whole.reactions[key], abs=1e-12)
            assert cases.openings[key][k] == pytest.approx(whole.openings[key], abs=1e-12)
            assert cases.states[key][k] == case.states[key] == whole.states[key]
        assert case.at(3.0).moment == pytest.approx(whole.at(3.0).moment)
        assert cases.at(3.0, case=k).moment == case.at(3.0).moment
        for field in ("moment", "shear"):
            for kind in ("max", "min"):
                one, alone, of = cases.extremes[field][kind], case.extremes[field][kind], whole.extremes[field][kind]
                assert (one.value[k], one.x[k]) == (alone.value, alone.x)
                assert one.value[k] == pytest.approx(of.value)
                assert one.concurrent["deflection"][k] == pytest.approx(of.concurrent["deflection"], abs=1e-12)
        assert cases.result(k).reactions["B"] == pytest.approx(case.reactions["B"])
    (lifted,) = [one for one in cases.lifted if one.support == 2]
    assert (lifted.share, lifted.case) == (pytest.approx(2 / 3), 2)
    assert lifted.opening == cases.openings["C"].max()
    assert cases.table("cases")["reaction B"].tolist() == cases.reactions["B"].tolist()
    assert cases.table("supports")["lifted_share"][2] == lifted.share
    assert cases.table("fields")["moment_max"].max() == pytest.approx(cases.extremes["moment"]["max"].value.max(), rel=1e-3)
    assert [one.status for one in cases[1:]] == [0, 0]
    assert cases[[0, 2]] == cases[np.array([True, False, True])]
    assert cases[-1] == cases[2]
    assert pickle.loads(pickle.dumps(cases))[1].reactions["B"] == cases.reactions["B"][1]


def test_a_page_is_of_one_result(things):
    for name in ("cases", "batch", "summary"):
        with pytest.raises(ValueError, match="a page shows one result"):
            things[name].to_html()
    assert things["envelope"].to_html().startswith("<!DOCTYPE html>")


def test_keywords_of_others_are_refused_in_words(things):
    with pytest.raises(ValueError, match="a result has no cases"):
        things["result"].at(3.0, case=1)
    with pytest.raises(ValueError, match="factor: every case is one state"):
        things["cases"].at(3.0, factor=0.5)


def test_cases_that_are_not_there(things):
    cases = things["cases"]
    for wrong in (3, -4):
        with pytest.raises(IndexError, match=f"there is no case {wrong}; their numbers go from 0 to 2"):
            cases[wrong]
    for wrong in (len, iter, lambda one: one[0]):
        with pytest.raises(TypeError, match="without an axis of cases"):
            wrong(cases[0])
    with pytest.raises(ValueError, match=r"cases\.result\(0\)"):
        cases.result()
    with pytest.raises(KeyError, match="there is no support 'E'"):
        cases.reactions["E"]
    with pytest.raises(AttributeError, match="not among what was wanted"):
        gapbeam.prepare(scene()).solve([[1.0, 1.0]], want="moment").deflection  # noqa: B018
    assert gapbeam.prepare(scene()).solve([[1.0, 1.0]], want="moment").reactions["B"].shape == (1,)


def test_cases_that_are_not_solved():
    prepared = gapbeam.prepare({
        "beam": {"spans": [4.0, 2.0], "EI": 1e4}, "supports": [{"node": 0, "side": "below"}, {"node": 1}],
        "loads": [{"type": "force", "x": 2.0, "F": 1.0}, {"type": "force", "x": 6.0, "F": 1.0}],
    })  # fmt: skip
    cases = prepared.solve([[1.0, 0.0], [0.0, 1.0], [0.0, 2.0]])
    assert cases.ok.tolist() == [True, False, False]
    assert cases.status.tolist() == [gapbeam.Status.SOLVED, gapbeam.Status.NO_EQUILIBRIUM, gapbeam.Status.NO_EQUILIBRIUM]
    assert cases.reason.startswith("case 1: no equilibrium in this load case: the beam tips")
    assert cases.reason.endswith("1 more of 3 not solved")
    assert cases.states[0].tolist() == ["closed", None, None]
    with pytest.raises(gapbeam.UnsolvedError, match="the beam tips") as caught:
        cases.raise_for_status()
    assert caught.value.status == "no-equilibrium"
    assert not cases[1].ok
    assert cases[1].reason.startswith("no equilibrium in this load case")
    assert "1 of 3 cases solved" in repr(cases)
    assert json.loads(cases.to_json())["moment_max"][1] is None
    assert cases.lifted == []
    assert prepared.solve([[1.0, 0.0], [2.0, 0.0], [0.0, 1.0]]).plot().axes


def test_cases_of_other_kinds():
    on_ground = gapbeam.prepare({
        "beam": {"spans": [4.0, 4.0], "EI": 1e4}, "foundation": [{"k": 1000.0, "side": "below"}],
        "supports": [{"node": 0, "law": [[0.001, 20.0], [0.1, 21.0]], "side": "below"}],
        "loads": [{"type": "force", "x": 2.0, "F": 1.0}],
    })  # fmt: skip
    cases = on_ground.solve([[1.0], [30.0]], gap={0: [0.0, 0.001]})
    for k in range(2):
        assert cases[k].at(1.0).pressure == pytest.approx(cases.at(1.0).pressure[k])
        assert cases[k].result().steps[-1].reaction[0] == pytest.approx(cases.reactions[0][k], rel=1e-9)
        assert cases.states[0][k] == cases[k].result().states[0]


def test_batches_and_their_summaries(things):
    batch, summary, cases = things["batch"], things["summary"], things["cases"]
    assert batch.reactions["B"].tolist() == pytest.approx(cases.reactions["B"].tolist())
    assert batch.openings["C"].tolist() == pytest.approx(cases.openings["C"].tolist())
    assert batch.states["C"].tolist() == cases.states["C"].tolist()
    assert batch.extremes["moment"]["max"].value.tolist() == pytest.approx(cases.extremes["moment"]["max"].value.tolist())
    assert batch.extremes["moment"]["max"].x.tolist() == pytest.approx(cases.extremes["moment"]["max"].x.tolist())
    (lifted,) = [one for one in batch.lifted if one.support == 2]
    assert (lifted.share, lifted.case) == (pytest.approx(2 / 3), 2)
    assert lifted.opening == batch.openings["C"].max()
    (of_summary,) = [one for one in summary.lifted if one.support == 2]
    assert (of_summary.share, of_summary.opening) == (lifted.share, lifted.opening)
    assert summary.reactions["B"].largest == batch.reactions["B"].max()
    assert summary.extremes["moment"]["max"].quantiles[0.5] == np.sort(batch.extremes["moment"]["max"].value)[1]
    assert summary.table()["result"] == [name for name, one in summary.columns.items() if one.count]
    assert batch.table("cases")["case"].tolist() == [0, 1, 2]
    assert batch.plot("moment.max").axes[0].get_xlabel() == "largest moment [kN m]"
    with pytest.raises(ValueError, match="solve the case"):
        batch.extremes["moment"]["max"].concurrent  # noqa: B018


def test_a_batch_that_is_not_solved(tmp_path):
    falls = {
        "beam": {"spans": [4.0, 2.0], "EI": 1e4}, "supports": [{"node": 0, "side": "below"}, {"node": 1}],
        "loads": [{"type": "force", "x": 6.0, "F": 1.0, "case": "end"}, {"type": "force", "x": 2.0, "F": 3.0}],
    }  # fmt: skip
    batch = gapbeam.batch(falls, {"factors.end": [0.0, 5.0]}, tmp_path / "b", want=["reaction"])
    assert (batch.status, batch.ok) == ("no-equilibrium", False)
    assert batch.reason.startswith("1 of 2 cases are not solved; no-equilibrium: ")
    with pytest.raises(gapbeam.UnsolvedError):
        batch.raise_for_status()
    assert "1 solved, 1 no-equilibrium" in repr(batch)
    with pytest.raises(ValueError, match='take "opening" into what is wanted'):
        batch.openings  # noqa: B018


def test_a_result_keeps_its_model():
    own = scene()
    result = gapbeam.solve(own)
    own.supports[0].gap = 0.1
    assert result.scene.supports[0].gap == 0.0
    own.supports[0].gap = 0.0
    changes = (
        lambda s: setattr(s.supports[1], "gap", 0.5), lambda s: setattr(s, "title", "another"), lambda s: s.supports.append(None),
        lambda s: s.beam.spans.__setitem__(0, 1.0), lambda s: s.loads.clear(), lambda s: setattr(s.loads[0], "q", 1.0),
        lambda s: setattr(s.beam, "EI", 1.0), lambda s: s.combinations.extend([1]),
    )  # fmt: skip
    before = repr(result.scene)
    for kept in (result, pickle.loads(pickle.dumps(result)), gapbeam.prepare(own), result.combinations or result):
        for change in changes:
            with pytest.raises((AttributeError, TypeError), match=r"gapbeam\.replace\(result\.scene"):
                change(kept.scene)
    assert repr(result.scene) == before
    assert result.scene == gapbeam.read_scene(own) == result.scene
    other = gapbeam.replace(result.scene, "supports.B.gap", 0.01)
    other.title = "free again"
    assert gapbeam.solve(other).scene.supports[1].gap == 0.01
    assert gapbeam.solve(result.scene) == result


def test_in_the_model_of_combinations_too():
    combined = gapbeam.solve(scene(combinations=COMBINATIONS))
    with pytest.raises(TypeError, match="keeps its model"):
        combined.scene.combinations[0].factors["dead"] = 2.0
    columns = gapbeam.solve({"beam": {"spans": [6.0, 6.0], "EI": 1.0}, "supports": {"node": np.arange(3), "side": "below"}})
    with pytest.raises(AttributeError, match="keeps its model"):
        columns.scene.supports[0].gap = 0.5


def test_neutral_equilibrium_is_said_first():
    free = gapbeam.solve({"beam": {"spans": [4.0], "EI": 1e4}, "supports": [{"node": 0, "rotation": "free"}]})
    assert free.ok
    assert free.reason == "solved, but free to move: its position is not unique"
    for text in (repr(free), free.report(), free._repr_html_()):
        assert free.reason in text.splitlines()[0]


def test_a_step_that_is_not_there_says_why():
    fallen = gapbeam.solve(gapbeam.Scene(beam=BEAM, loads=LOADS))
    with pytest.raises(IndexError, match="no load step stands; no equilibrium at load factor 1") as caught:
        fallen.steps[-1]
    assert isinstance(caught.value, gapbeam.UnsolvedError)
    assert caught.value.status == "no-equilibrium"
    with pytest.raises(IndexError, match="there is no load step 3; their numbers go from 0 to 0"):
        gapbeam.solve(scene()).steps[3]


@pytest.mark.parametrize("name", NAMES)
def test_what_goes_to_another_process(things, name):
    """Parts and what is asked of them can be pickled, and have the same values then."""
    one = things[name]
    there = pickle.loads(pickle.dumps(one))
    assert repr(there) == repr(one)
    assert repr(pickle.loads(pickle.dumps(one.extremes))) == repr(there.extremes) == repr(one.extremes)


def test_places_of_curves_are_told_in_one_way(things):
    for name in ("result", "combined", "train"):
        one = things[name]
        assert len(one.envelope(4).fields.x) < len(one.envelope(points=8).fields.x)
        assert one.envelope(x=[3.0]).fields.x.tolist() == [3.0]
        with pytest.raises(ValueError, match="points: expected a whole number, 1 or more, got 0"):
            one.envelope(points=0)


def test_parts_say_what_they_are(things):
    result, combined, train = things["result"], things["combined"], things["train"]
    assert repr(result.steps[-1]) == "Step(factor=1)"
    assert repr(combined.combinations).startswith('Combinations("')
    assert repr(train.state(2.5)) == 'TrainState("crane", position=2.5, direction="right")'
    assert repr(things["over trains"]._result.trains) == 'Trains("crane")'
    assert repr(result.steps) == f"{type(result.steps).__name__}({len(result.steps)})"
