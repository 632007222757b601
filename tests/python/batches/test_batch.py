"""Batches: rows of tables as cases, files that are the same whatever happens, refusals."""

import errno
import hashlib
import os
import random
import signal
import subprocess
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import gapbeam
import numpy as np
import pytest
from gapbeam.base.characters import visible
from gapbeam.batches import folder, run
from gapbeam.batches.job import Job
from gapbeam.batches.paths import find_paths, scene_data, with_values
from gapbeam.batches.scene_cases import SceneCases
from gapbeam.batches.tables import Arrays, ParquetTable, take_table
from gapbeam.cli import main
from gapbeam.scene.names import labels
from scenes import random_scene

SCENE = {
    "beam": {"spans": [6.0, 5.0, 6.0], "EI": 1e4},
    "supports": [
        {"node": 0, "side": "below", "name": "R-101"},
        {"node": 1, "side": "below", "name": "R 102", "gap": 0.01},
        {"node": 2, "side": "below"},
        {"node": 3},
    ],
    "loads": [{"type": "uniform", "q": 5.0, "case": "dead"}, {"type": "force", "x": 3.0, "F": 20.0, "case": "wind"}],
}
TOML = """\
beam = { spans = [6.0, 5.0, 6.0], EI = 1.0e4 }
supports = [{ node = 0, side = "below" }, { node = 1, side = "below" }, { node = 2, side = "below" }, { node = 3 }]
loads = [{ type = "uniform", q = 5.0, case = "dead" }, { type = "force", x = 3.0, F = 20.0, case = "wind" }]
"""


def table(cases, seed=0):
    rng = np.random.default_rng(seed)
    return {"supports.R-101.gap": rng.normal(0.0, 0.01, cases), "factors.wind": rng.normal(1.0, 0.3, cases)}


def digests(path):
    """Every file of a folder, what begins with a dot too."""
    return {one: hashlib.sha256((path / one).read_bytes()).hexdigest() for one in sorted(os.listdir(path))}


def job(scene, columns, want=("reaction", "opening", "couple", "moment")):
    scene = gapbeam.read_scene(scene)
    return Job(scene_data(scene), find_paths(scene, columns), want, tuple(labels(scene.supports)))


# What is solved


def test_a_row_is_the_scene_with_its_numbers():
    columns = ["supports.R-101.gap", 'supports."R 102".settlement', "loads[1].F", "factors.wind", "beam.EI", "supports[2].node"]
    data = with_values(scene_data(gapbeam.read_scene(SCENE)), find_paths(gapbeam.read_scene(SCENE), columns),
                       [0.02, 0.03, 7.0, 2.0, 5e3, 2.0])  # fmt: skip
    assert data["supports"][0]["gap"] == 0.02
    assert data["supports"][1]["settlement"] == 0.03
    assert data["loads"][1]["F"] == 14.0
    assert data["beam"]["EI"] == 5e3
    assert gapbeam.read_scene(data).supports[2].node == 2


SMALL = "nt", "ap", "ue"
"""Ends of the names of lengths that supports move or leave: settlement, gap, value."""


def test_prepared_beams_give_what_scenes_give():
    """Factors, gaps, settlements, stiffnesses, moduli of random scenes, some of them impossible, on both roads."""
    seen, moving = set(), 0
    for seed in range(24):
        rng = random.Random(seed)
        held = rng.choice((True, None))
        made = random_scene(rng, held=held)
        if seed > 21:
            made["foundation"] = [{"k": 1e4, "side": "below"}]
        elif held:  # loads that move supports
            moved = [k for k, one in enumerate(made["supports"]) if one.get("direction", "normal") == "normal"]
            for case in ("dead", "live"):
                made["loads"].append({"type": "movement", "support": rng.choice(moved), "value": 0.01, "case": case})
        scene = gapbeam.read_scene(made)
        columns = [f"supports[{k}].settlement" for k in range(len(scene.supports))]
        columns += [f"supports[{k}].gap" for k, one in enumerate(scene.supports) if one.side != "both"]
        columns += [f"supports[{k}].stiffness" for k in range(len(scene.supports))]
        columns += [f"loads[{k}].value" for k, load in enumerate(made["loads"]) if load["type"] == "movement"]
        columns += [f"factors.{case}" for case in sorted({load.case for load in scene.loads})]
        spans = range(len(scene.beam.spans))
        for key in ("EI", "GA")[: seed % 3]:
            columns += [f"beam.{key}[{i}]" for i in spans] if isinstance(getattr(scene.beam, key), list) else [f"beam.{key}"]
        columns += [f"foundation[{i}].k" for i in range(len(scene.foundation))]
        made = job(scene, columns)
        if not made.cases.is_prepared:
            continue
        size = [1.0 if "factors" in name else 0.02 if name[-2:] in SMALL else 1e5 for name in columns]
        values = np.array([[s * rng.choice((0.0, 1.0, rng.uniform(-1, 1), rng.uniform(-1, 1))) for _ in range(4)] for s in size])
        for row, name in zip(values, columns, strict=True):
            if name[-2:] not in SMALL and "factors" not in name:
                row[:3] = np.abs(row[:3]) + 1.0 * (row[:3] == 0.0)  # the last case is impossible
        values[0, 3] = np.nan
        found = made.solve(Arrays(dict(zip(columns, values, strict=True))).rows(0, 4), 0)
        alone = job(scene, columns)
        alone.__dict__["cases"] = SceneCases(alone)
        for name, column in alone.solve(Arrays(dict(zip(columns, values, strict=True))).rows(0, 4), 0).items():
            tolerance = 1e-9 * max(np.nanmax(np.abs(column), initial=0.0), 1e-3) if column.dtype == float else 0.0
            same = np.allclose(found[name], column, 1e-9, tolerance, equal_nan=True) if tolerance else (found[name] == column).all()
            assert same or name.endswith("_x"), (seed, name)
        seen |= set(found["status"].tolist())
        moving += made.cases._solver.movements is not None
    assert moving > 3
    assert seen == {b"solved", b"no-equilibrium", b"refused"}


@pytest.mark.parametrize(
    ("analysis", "is_prepared"), [({"steps": 1}, True), ({"steps": 8}, True), ({"follow": "events"}, False)]
)
def test_cases_that_cannot_stand_before_all_loads_act(analysis, is_prepared):
    """An overhang tips the beam off its first support until enough of the live load holds it down."""
    scene = {
        "beam": {"spans": [4.0, 2.0], "EI": 1e4},
        "supports": [{"node": 0, "side": "below"}, {"node": 1, "side": "below"}],
        "loads": [{"type": "force", "x": 6.0, "F": 10.0, "case": "dead"}, {"type": "force", "x": 1.0, "F": 1.0}],
        "analysis": analysis,
    }
    columns = {"loads[1].F": [40.0, 100.0, 6.0]}
    made = job(scene, columns)
    assert made.cases.is_prepared == is_prepared
    found = made.solve(Arrays(columns).rows(0, 3), 0)
    scenes = [with_values(made.scene, made.paths, [force]) for force in columns["loads[1].F"]]
    assert [one.decode() for one in found["status"].tolist()] == [gapbeam.solve(one).status for one in scenes]
    held = job({**scene, "supports": [{"node": 0}, {"node": 1}]}, columns)
    assert held.cases.is_prepared


def test_what_is_kept(tmp_path):
    want = ["reaction", "shear", "couple", "error_bound"]
    done = gapbeam.batch(SCENE, table(50), tmp_path / "out", want=want)
    assert done.columns[3:6] == ("reaction.R-101", "reaction.R 102", "reaction.2")
    found = done.read()
    gap, factor = (column[7] for column in table(50).values())
    supports = [{**SCENE["supports"][0], "gap": gap}, *SCENE["supports"][1:]]
    case = gapbeam.solve({**SCENE, "supports": supports, "loads": [SCENE["loads"][0], {**SCENE["loads"][1], "F": 20.0 * factor}]})
    assert [found[f"reaction.{one}"][7] for one in ("R-101", "R 102", "2", "3")] == pytest.approx(case.steps[-1].reaction, abs=1e-9)
    assert (found["shear.min"][7], found["shear.min_x"][7]) == pytest.approx(case._pairs_of_extremes()["shear"]["min"])
    bounds = [found[f"error_bound.{kind}"][7] / bound for kind, bound in case.steps[-1].error_bounds.items()]
    assert 0.5 < min(bounds) <= max(bounds) < 30
    assert (done.done, done.cases, done.statuses()) == (50, 50, {"solved": 50})
    assert done.read("case").keys() == {"case"}
    assert gapbeam.batch(SCENE, table(2), tmp_path / "one", want="couple").columns[3:4] == ("couple.R-101",)


def test_a_case_that_fails_is_a_row_with_its_reason(tmp_path):
    columns = {"beam.EI": [1e4, -1.0, np.nan, 1e4], "supports[3].stiffness": [np.inf, np.inf, np.inf, 0.0],
               "factors.wind": [1.0, 1.0, 1.0, -50.0]}  # fmt: skip
    done = gapbeam.batch(SCENE, columns, tmp_path / "out")
    found = done.read()
    assert found["status"].tolist() == ["solved", "refused", "refused", "no-equilibrium"]
    assert found["reason"][1] == "beam.EI: expected a number above 0 (inf = rigid), got -1"
    assert found["reason"][2] == "beam.EI: expected a number, got nan"
    assert found["reason"][3].startswith("no equilibrium at load factor 1: ")
    assert np.isnan(found["moment.max"]).tolist() == [False, True, True, True]
    with pytest.raises(ValueError, match=r"case: expected a whole number, got 1\.5"):
        done.scene_of(1.5)
    assert gapbeam.solve(done.scene_of(3)).reason == found["reason"][3]
    assert done._failed_chunks() == [0]


def test_a_case_without_an_answer_along_the_beam_is_none(tmp_path):
    """Across the beam there is one, and the row was said to be solved, with not-a-number for every reaction."""
    scene = {
        "beam": {"spans": [6.0, 7.0], "EI": 1e4},
        "supports": [{"node": 0}, {"node": 1, "side": "below", "friction": 0.3}, {"node": 2}, {"x": 3.0, "direction": "axial"}],
        "loads": [{"type": "force", "x": 4.0, "F": 30.0, "case": "dead"}, {"type": "movement", "support": 3, "value": 0.001}],
    }
    found = gapbeam.batch(scene, {"factors.dead": [1.0, 0.5]}, tmp_path).read()
    assert found["status"].tolist() == ["no-answer"] * 2
    assert "statics cannot tell" in found["reason"][0]


def test_a_stiffness_of_one_span_where_the_scene_has_one_for_all(tmp_path):
    """The other spans keep the scene's number, on both roads."""
    columns = {"beam.EI[1]": [2e4, 5e3], "beam.GA[0]": [1e4, 1e5]}
    alone = job(SCENE, columns)
    alone.__dict__["cases"] = SceneCases(alone)
    rows = Arrays(columns).rows(0, 2)
    for one in (job(SCENE, columns), alone):
        found = one.solve(rows, 0)
        for case in range(2):
            EI, GA = (column[case] for column in columns.values())
            beam = {"spans": [6.0, 5.0, 6.0], "EI": [1e4, EI, 1e4], "GA": [GA, np.inf, np.inf]}
            step = gapbeam.solve({**SCENE, "beam": beam}).steps[-1]
            assert [found[f"reaction.{one}"][case] for one in ("R-101", "R 102", "2", "3")] == pytest.approx(step.reaction)
    for columns in (["beam.EI", "beam.EI[0]"], ["beam.EI[0]", "beam.EI"]):
        with pytest.raises(gapbeam.SceneError, match=r'^column "beam.EI\[0\]": is one of the spans of column "beam.EI"; leave one'):
            find_paths(gapbeam.read_scene(SCENE), columns)


def test_numbers_too_large_for_a_double_are_a_reason(tmp_path):
    """They are not taken to be infinite; what is written as inf is."""
    text = "beam.GA,loads[1].F\n1e400,1.0\n1e4,-1e999\n1e4,inf\ninf,1.0\nInfinity,2.0\n1e4,2.0\n"
    (tmp_path / "table.csv").write_text(text)
    found = gapbeam.batch(SCENE, tmp_path / "table.csv", tmp_path / "out").read()
    assert found["status"].tolist() == 3 * ["refused"] + 3 * ["solved"]
    assert found["reason"][0].startswith("beam.GA: 1e400 is beyond the largest number of double precision, 1.8e308; ")
    assert found["reason"][1].startswith("loads[1].F: -1e999 is beyond ")
    assert found["reason"][2] == "loads[1].F: expected a finite number, got inf"
    assert np.isnan(found["reaction.2"]).tolist() == 3 * [True] + 3 * [False]


@pytest.mark.parametrize("tiny", ["1e-400", "-3.0E-324999", "0." + 400 * "0" + "5", "0." + 250 * "0" + "5e-99"])
def test_numbers_too_small_for_a_double_are_a_reason(tmp_path, tiny):
    """They are not taken to be zero; what is written as zero is."""
    (tmp_path / "table.csv").write_text(f"beam.GA,loads[1].F\n1e4,{tiny}\n1e4,0.0\n1e4,0e-400\n1e4,1e-310\n")
    found = gapbeam.batch(SCENE, tmp_path / "table.csv", tmp_path / "out").read()
    assert found["status"].tolist() == ["refused", "solved", "solved", "solved"]
    assert found["reason"][0].startswith("loads[1].F: ")
    assert " is nearer to zero than any number of double precision, 4.9e-324; " in found["reason"][0]


@pytest.mark.parametrize("limit", ["1e-400", "1e400"])
def test_limits_on_the_command_line_are_in_range(tmp_path, limit, capsys):
    gapbeam.batch(SCENE, {"loads[1].F": [1.0]}, tmp_path / "out")
    assert main(["batch", "--summary", str(tmp_path / "out"), "--limit", f"reaction.2={limit}"]) == 2
    assert f"--limit: reaction.2: {limit} is " in capsys.readouterr().err


def test_envelopes_of_combinations_and_trains(tmp_path):
    storm = {"name": "storm", "factors": {"dead": 1.0, "wind": 1.0, "crane": 1.0}, "settlements": {"R-101": 0.01}}
    combinations = [{"name": "calm", "factors": {"dead": 1.0}}, storm]
    train = {"name": "crane", "axles": [[0.0, 9.0], [2.0, 9.0]], "case": "crane"}
    columns = {"supports.R-101.gap": [0.0, 0.02], "combinations.storm.settlements.R-101": [0.03, 0.01],
               "factors.crane": [1.0, 2.0], "trains.crane.axles[1][1]": [9.0, 5.0]}  # fmt: skip
    scene = {**SCENE, "trains": [train], "combinations": combinations}
    done = gapbeam.batch(scene, columns, tmp_path / "out")
    assert done.statuses() == {"solved": 2}
    for case in range(2):
        row = {name: column[case] for name, column in done.read().items()}
        envelope = gapbeam.solve(done.scene_of(case)).envelope()
        for kind in ("max", "min"):
            assert row[f"reaction.R-101.{kind}"] == envelope.supports[0]["reaction"][kind].value
            moment = envelope.extremes["moment"][kind]
            assert (row[f"moment.{kind}"], row[f"moment.{kind}_x"]) == (moment.value, moment.x)
    heavier = {**train, "factor": 2.0, "axles": [[0.0, 9.0], [2.0, 5.0]]}
    supports = [{**SCENE["supports"][0], "gap": 0.02}, *SCENE["supports"][1:]]
    envelope = gapbeam.solve({**scene, "trains": [heavier], "supports": supports}).envelope()
    assert envelope.extremes["moment"]["max"].value == row["moment.max"]
    with pytest.raises(gapbeam.SceneError, match="want: expected some of input, reaction, opening, deflection"):
        gapbeam.batch(scene, columns, tmp_path / "out", want=["couple"])


def test_combinations_of_all_rows_are_solved_together(tmp_path):
    combinations = [{"name": "calm", "factors": {"dead": 1.0}}, {"name": "storm", "factors": {"dead": 0.9, "wind": 1.5}}]
    scene = {**SCENE, "combinations": combinations}
    columns = {"supports.R-101.gap": [0.0, 0.02, np.nan, 0.01], "factors.wind": [1.0, 2.0, 1.0, 1e308], "beam.EI": 4 * [2e4]}
    want = ["input", "reaction", "opening", "moment", "moment@3.0", "shear@6.0"]
    done = gapbeam.batch(scene, columns, tmp_path, want=want)
    made = job(scene, columns, tuple(want))
    assert made.cases.is_prepared
    found = done.read([*made.columns, "status"])
    assert found["status"][:2].tolist() == ["solved", "solved"]
    assert "solved" not in found["status"][2:]
    assert all(np.isnan(found[name][2:]).all() for name in made.columns if name not in columns)
    for case in (0, 1):
        envelope = gapbeam.solve(done.scene_of(case)).envelope()
        there = gapbeam.solve(done.scene_of(case)).envelope(x=[3.0, 6.0]).fields
        for kind, curve in (("max", there.largest), ("min", there.smallest)):
            expected = {f"moment@3.0.{kind}": curve["moment"][0], f"shear@6.0.{kind}": curve["shear"][1]}
            expected[f"moment.{kind}"] = envelope.extremes["moment"][kind].value
            expected[f"moment.{kind}_x"] = envelope.extremes["moment"][kind].x
            for name in ("reaction", "opening"):
                expected |= {f"{name}.{one}.{kind}": envelope.supports[k][name][kind].value for k, one in enumerate(made.supports)}
            assert {name: found[name][case] for name in expected} == pytest.approx(expected, rel=1e-13, abs=1e-15)


def test_scenes_of_a_folder(tmp_path):
    (tmp_path / "scenes").mkdir()
    for name, text in (("b.toml", TOML), ("a.toml", TOML.replace("q = 5.0", "q = 6.0")), ("c.toml", "nonsense")):
        (tmp_path / "scenes" / name).write_text(text)
    assert main(["batch", str(tmp_path / "scenes"), "--out", str(tmp_path / "out"), "--jobs", "1", "--quiet"]) == 1
    found = gapbeam.Batch(tmp_path / "out").read()
    assert found["scene"].tolist() == ["a.toml", "b.toml", "c.toml"]
    assert found["status"].tolist() == ["solved", "solved", "refused"]
    assert found["reaction.max"][1] == gapbeam.solve(tmp_path / "scenes" / "b.toml").steps[-1].reaction.max()


def test_scenes_of_a_folder_without_supports(tmp_path):
    (tmp_path / "scenes").mkdir()
    rail = "beam = { spans = [6.0], EI = 1e4 }\nfoundation = [{ k = 1e3 }]\nloads = [{ type = 'uniform', q = 5.0 }]\n"
    (tmp_path / "scenes" / "rail.toml").write_text(rail)
    found = gapbeam.batch(tmp_path / "scenes", None, tmp_path / "out").read()
    assert found["status"].tolist() == ["solved"]
    assert np.isnan([found[f"{name}.{kind}"] for name in ("reaction", "opening") for kind in ("max", "min")]).all()


def test_reactions_of_a_folder_are_those_across_the_beam(tmp_path):
    (tmp_path / "scenes").mkdir()
    text = TOML.replace("{ node = 3 }]", "{ node = 3 }, { node = 0, direction = 'axial' }]")
    text = text.replace("loads = [", "loads = [{ type = 'axial', x = 6.0, F = 900.0 }, ")
    (tmp_path / "scenes" / "a.toml").write_text(text)
    found = gapbeam.batch(tmp_path / "scenes", None, tmp_path / "out").read()
    reactions = gapbeam.solve(tmp_path / "scenes" / "a.toml").steps[-1].reaction
    assert (found["reaction.min"][0], found["reaction.max"][0]) == (reactions[:4].min(), reactions[:4].max())
    assert found["reaction.min"][0] > reactions[4]


def test_text_of_the_user_goes_into_files(tmp_path):
    for k, text in enumerate(("a\ud800b", "x\x1b[31m\u200b", "{0} $x$ Träger")):
        scene = {**SCENE, "title": text, "supports": [{**SCENE["supports"][0], "name": text}, *SCENE["supports"][1:]]}
        done = gapbeam.batch(scene, {"supports[0].gap": [0.0], "beam.EI": [1e4]}, tmp_path / str(k))
        assert f"reaction.{visible(text)}" in done.columns
        assert done.scene_of(0).title in (text, visible(text))
        assert done.summary().columns[f"reaction.{visible(text)}"].count == 1


# Tables


def test_tables_of_all_kinds_are_one(tmp_path):
    pyarrow = pytest.importorskip("pyarrow")
    from pyarrow import parquet

    columns = table(3000)
    parquet.write_table(pyarrow.table(columns), tmp_path / "t.parquet", row_group_size=700)
    lines = [",".join(map(repr, map(float, row))) for row in zip(*columns.values(), strict=True)]
    (tmp_path / "t.csv").write_bytes(("\ufeff" + ",".join(columns) + "\r\n" + "\r\n".join([*lines[:9], "", *lines[9:]])).encode())
    for source in (tmp_path / "t.parquet", tmp_path / "t.csv", iter(columns.items())):
        made = take_table(source)
        assert (made.names, made.cases) == (tuple(columns), 3000)
        for first, stop in ((0, 1000), (1000, 2500), (2500, 3000), (701, 702)):
            values, problems = made.rows(first, stop).columns()
            assert not problems
            assert np.array_equal(values, [column[first:stop] for column in columns.values()])
    assert isinstance(take_table(tmp_path / "t.parquet"), ParquetTable)


def test_lines_that_are_no_numbers(tmp_path):
    (tmp_path / "t.csv").write_bytes(b"supports[1].gap,factors.wind\n,1\n0.01,1\nabc,1\n0.01\n,2\n1\r2,1\n0.02,1\n")
    found = gapbeam.batch(SCENE, tmp_path / "t.csv", tmp_path / "out").read(["status", "reason"])
    assert found["status"].tolist() == ["refused", "solved", "refused", "refused", "refused", "refused", "solved"]
    assert found["reason"].tolist()[2:6] == [
        'supports[1].gap: expected a number, got "abc"', "the line has 1 values, and the table 2 columns",
        'supports[1].gap: expected a number, got ""', "the line holds a carriage return that ends no line",
    ]  # fmt: skip
    (tmp_path / "t.csv").write_bytes(b"supports[1].gap\r0.01\r0.02\r")
    with pytest.raises(gapbeam.SceneError, match="first line: holds a carriage return that ends no line; write each case"):
        take_table(tmp_path / "t.csv")


def test_whole_numbers_that_doubles_do_not_hold(tmp_path):
    pyarrow = pytest.importorskip("pyarrow")
    from pyarrow import parquet

    parquet.write_table(pyarrow.table({"beam.EI": [2**53 + 1, 1, None]}), tmp_path / "t.parquet")
    values, _ = take_table(tmp_path / "t.parquet").rows(0, 3).columns()
    assert np.array_equal(values, [[2.0**53, 1.0, np.nan]], equal_nan=True)


def test_cells_over_two_lines_are_refused(tmp_path):
    """They were two cases, each refused, and all later cases had other numbers."""
    for text, line in (('factors.wind,"factors.dead"\n1,"1"\n2,"1\n"\n', 3), ('"factors\n.wind"\n1\n', 1)):
        (tmp_path / "t.csv").write_text(text)
        with pytest.raises(gapbeam.SceneError, match=f"line {line}: a quoted cell continues in the next line; write"):
            take_table(tmp_path / "t.csv")


@pytest.mark.parametrize(
    ("columns", "message"),
    [
        ({"supports.R-1.gap": [0.0]}, 'column "supports.R-1.gap": is no key path of the scene; did you mean "supports.R-101.gap"?'),
        ({"factors.wnd": [0.0]}, 'column "factors.wnd": is no key path of the scene; did you mean "factors.wind"?'),
        ({"supports[9].gap": [0.0]}, 'column "supports[9].gap": there is no entry 9; the scene has 4 there, 0 to 3'),
        ({"x": [0.0]}, 'column "x": is no key path of the scene; such are '),
        ({"supports[0].side": [0.0]}, 'column "supports[0].side": is "below" in the scene; only numbers can be taken from a table'),
        ({"beam.spans": [0.0]}, 'column "beam.spans": is a list of 3 numbers here; name one of them, such as "beam.spans[0]"'),
        ({"supports[0].gap": [0.0], "supports.R-101.gap": [0.0]}, 'column "supports.R-101.gap": is the same number as column'),
        ({"supports[0].gap": [0.0, 1.0], "factors.wind": [1.0]}, "table: its columns are of unequal length: supports[0].gap has 2"),
        ({"supports[0].gap": ["a"]}, 'column "supports[0].gap": expected numbers, one a case'),
        ({"supports[0].gap": []}, "table: has no row"),
        ({}, "table: has no column"),
        ({"combinations[0].factors.wind": [1.0]}, 'column "combinations[0].factors.wind": is no key path of the scene'),
        (7, "table: expected columns of numbers by name"),
        ("t.txt", 't.txt: a table ends in .csv or .parquet, not in ".txt"'),
        ("t.csv", "t.csv: there is no such file"),
        (None, "table: give a table, or a folder of scenes"),
    ],
)
def test_tables_that_are_refused(columns, message, tmp_path):
    with pytest.raises(gapbeam.SceneError) as error:
        gapbeam.batch(SCENE, columns, tmp_path / "out")
    assert str(error.value).startswith(message)
    assert not (tmp_path / "out").exists()


def test_scenes_that_are_refused(tmp_path):
    with pytest.raises(gapbeam.SceneError, match=r'want: expected some of input, .*got "pressure"'):
        gapbeam.batch(SCENE, table(3), tmp_path / "out", want=["pressure"])


# Files that last


def undisturbed(path):
    """A run with one thread: six files."""
    pytest.importorskip("pyarrow")
    gapbeam.batch(SCENE, table(550), path, jobs=1, chunk=100)
    return digests(path)


@pytest.fixture
def whole(tmp_path):
    return undisturbed(tmp_path / "whole")


@pytest.mark.parametrize("kind", ["parquet", "npy"])
def test_bytes_are_the_same_whatever_works(kind, tmp_path, monkeypatch):
    if kind == "parquet":
        pytest.importorskip("pyarrow")
    monkeypatch.setattr(run, "best_format", lambda: kind)
    gapbeam.batch(SCENE, table(550), tmp_path / "one", jobs=1, chunk=100)
    gapbeam.batch(SCENE, table(550), tmp_path / "three", jobs=3, chunk=100)
    with ProcessPoolExecutor(2, get_context("spawn")) as pool:
        done = gapbeam.batch(SCENE, table(550), tmp_path / "processes", executor=pool, chunk=100)
    assert digests(tmp_path / "one") == digests(tmp_path / "three") == digests(tmp_path / "processes")
    assert done.read(["case"])["case"].tolist() == list(range(550))
    assert f"part-000005.{kind}" in digests(tmp_path / "one")


def heed_ctrl_c():
    """What a shell starts in the background ignores Ctrl-C, and so do all its children."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


@pytest.mark.parametrize(("number", "words"), [(signal.SIGINT, "interrupted"), (signal.SIGTERM, "ended by SIGTERM")])
def test_signals_end_the_command(tmp_path, number, words):
    """Whether processes or threads work, one line is said, nothing in part is left, and the folder goes on."""
    (tmp_path / "beam.toml").write_text(TOML)
    for column, rows in (("factors.wind", 1_000_000), ("beam.EI", 200_000)):
        (tmp_path / f"{column}.csv").write_text("\n".join([column, *["1.0"] * rows]))
        command = [sys.executable, "-m", "gapbeam", "batch", "beam.toml", f"{column}.csv", "--out", column, "--jobs", "2"]
        process = subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.PIPE, text=True, preexec_fn=heed_ctrl_c,
                                   start_new_session=True)  # fmt: skip
        while not (tmp_path / column / "_manifest.json").exists() and process.poll() is None:
            time.sleep(0.01)
        time.sleep(0.1)
        os.killpg(process.pid, number)
        assert process.communicate()[1] == f"gapbeam: {words}\n"
        assert process.returncode == 128 + number
        assert gapbeam.Batch(tmp_path / column).done < 200_000
        assert not list((tmp_path / column).glob(".part-*"))


def test_it_goes_on_after_kills(tmp_path):
    """SIGKILL as soon as some files are there, and at a random moment."""
    program = f"""if True:
        import sys
        sys.path.insert(0, {str(Path(__file__).parents[2])!r})
        from python.batches.test_batch import SCENE, gapbeam, table, time
        gapbeam.batch(SCENE, table(6000), "out", jobs=2, chunk=500, progress=lambda *_: time.sleep(0.1))
    """
    for _ in range(2):
        process = subprocess.Popen([sys.executable, "-c", program], cwd=tmp_path)
        before = len(list(tmp_path.glob("out/part-*")))
        while len(list(tmp_path.glob("out/part-*"))) == before and process.poll() is None:
            time.sleep(0.01)
        time.sleep(random.uniform(0.0, 0.05))
        process.send_signal(signal.SIGKILL)
        process.wait()
    assert gapbeam.Batch(tmp_path / "out").done < 6000
    gapbeam.batch(SCENE, table(6000), tmp_path / "out")
    gapbeam.batch(SCENE, table(6000), tmp_path / "whole", jobs=1, chunk=500)
    assert digests(tmp_path / "out") == digests(tmp_path / "whole")


def test_a_full_disk_and_what_was_in_part(tmp_path, whole, monkeypatch):
    sync, calls = os.fsync, []

    def full(descriptor):
        calls.append(descriptor)
        if len(calls) == 7:  # files and folders
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        sync(descriptor)

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space left on device; when that is mended, start the same batch again") as error:
        gapbeam.batch(SCENE, table(550), tmp_path / "out", jobs=2, chunk=100)
    assert str(tmp_path / "out" / "part-0") in error.value.filename
    (tmp_path / "out" / ".part-000004.parquet").write_bytes(b"half")
    gapbeam.batch(SCENE, table(550), tmp_path / "out")  # files of as many cases as before
    assert digests(tmp_path / "out") == whole


def test_ctrl_c_leaves_what_goes_on(tmp_path, whole):
    def progress(done, cases):
        if done > 100:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        gapbeam.batch(SCENE, table(550), tmp_path / "out", jobs=2, chunk=100, progress=progress)
    assert 0 < gapbeam.Batch(tmp_path / "out").done < 550
    gapbeam.batch(SCENE, table(550), tmp_path / "out")
    assert digests(tmp_path / "out") == whole


def test_a_folder_of_something_else_is_refused(tmp_path, whole):
    def refusal(scene=SCENE, columns=None, out=tmp_path / "whole", **options):
        with pytest.raises(gapbeam.SceneError) as error:
            gapbeam.batch(scene, table(550) if columns is None else columns, out, **options)
        return error.value.problem

    remedy = "; give --out another folder, or remove this one to begin anew"
    assert refusal(columns=table(550, seed=1)) == "holds results of another table" + remedy
    assert refusal({**SCENE, "title": "other"}) == "holds results of another scene" + remedy
    assert refusal(chunk=50) == "has files of 100 cases, not of 50" + remedy
    assert refusal(want=["reaction"]).startswith("holds other columns (supports.R-101.gap, factors.wind, reaction.R-101, ")
    with folder.locked(tmp_path / "whole"):
        assert refusal() == "another batch writes into this folder; wait for its end, or give another one"
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "notes.txt").write_text("mine")
    assert refusal(out=tmp_path / "other") == "holds other files, and no batch; give --out a new folder"
    file = tmp_path / "other" / "notes.txt"
    assert refusal(out=file) == "is a file, and results go into a folder; give --out another name"
    with pytest.raises(gapbeam.SceneError, match=r"notes\.txt: is no folder of a batch"):
        gapbeam.Batch(file)
    assert digests(tmp_path / "whole") == whole


def test_a_file_that_is_damaged_is_named(tmp_path, whole):
    file = tmp_path / "whole" / "part-000002.parquet"
    file.write_bytes(file.read_bytes()[:-100])
    with pytest.raises(gapbeam.SceneError, match=r"part-000002.*remove it and start the batch again, which makes it anew"):
        gapbeam.Batch(tmp_path / "whole").summary()
    file.unlink()
    gapbeam.batch(SCENE, table(550), tmp_path / "whole")
    assert digests(tmp_path / "whole") == whole


def test_a_table_that_becomes_shorter_is_told(tmp_path):
    (tmp_path / "t.csv").write_text("factors.wind\n" + "1.0\n" * 50)

    def progress(done, cases):
        (tmp_path / "t.csv").write_text("factors.wind\n" + "1.0\n" * 10)

    with pytest.raises(gapbeam.SceneError, match="has become shorter while it was read"):
        gapbeam.batch(SCENE, tmp_path / "t.csv", tmp_path / "out", chunk=20, progress=progress)


def test_failed_cases_are_solved_again(tmp_path, whole, monkeypatch):
    def short_of_memory(*_):
        raise MemoryError

    with monkeypatch.context() as patch:
        patch.setattr("gapbeam.batches.scene_cases.solve", short_of_memory)
        patch.setattr("gapbeam.batches.prepared.PreparedCases.solve_together", short_of_memory)
        done = gapbeam.batch(SCENE, table(550), tmp_path / "out", chunk=100)
    assert done.statuses() == {"failed": 550}
    assert done.read(["reason"])["reason"][0].startswith("not enough memory")
    assert gapbeam.batch(SCENE, table(550), tmp_path / "out").statuses() == {"failed": 550}
    gapbeam.batch(SCENE, table(550), tmp_path / "out", retry_failed=True)
    assert digests(tmp_path / "out") == whole


def test_pandas_reads_it_in_one_line(tmp_path):
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("pyarrow")
    done = gapbeam.batch(SCENE, pandas.DataFrame(table(250)), tmp_path / "out", chunk=100)
    frame = pandas.read_parquet(tmp_path / "out")
    assert list(frame.columns) == list(done.columns)
    assert frame["reaction.R-101"].tolist() == done.read(["reaction.R-101"])["reaction.R-101"].tolist()


def test_command(tmp_path, capsys, monkeypatch):
    (tmp_path / "beam.toml").write_text(TOML)
    (tmp_path / "t.csv").write_text("factors.wind,beam.EI\n1,1e4\n2,1e4\n-40,1e4\n")
    command = ["batch", str(tmp_path / "beam.toml"), str(tmp_path / "t.csv"), "--out", str(tmp_path / "out")]
    assert main([*command, "--jobs", "1"]) == 1
    assert "out: 3 of 3 cases: 2 solved, 1 no-equilibrium; 3 of them in " in capsys.readouterr().out
    assert main(command) == 1
    assert capsys.readouterr().out.endswith("out: 3 of 3 cases: 2 solved, 1 no-equilibrium\n")
    assert main([*command, "--jobs", "0"]) == 2
    assert main(command[:3]) == 2
    assert "--jobs: expected a positive number, got 0" in capsys.readouterr().err
    monkeypatch.setitem(sys.modules, "distributed", None)
    assert main([*command, "--dask", "tcp://127.0.0.1:1"]) == 2
    assert "--dask: needs Dask: pip install gapbeam[dask]" in capsys.readouterr().err
