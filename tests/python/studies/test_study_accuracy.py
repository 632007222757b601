"""Error against run time: what the study tells, and that it fits what was measured."""

import csv
import io
import re

import pytest
from gapbeam.cli import main
from gapbeam.studies.accuracy import (
    FAMILIES,
    FIELDS,
    Comparison,
    families,
    findings,
    print_comparisons,
    scene_comparisons,
    to_csv,
    to_markdown,
)
from gapbeam.studies.diagram import STYLES, plot_accuracy
from gapbeam.studies.methods import Measured, front, methods
from studies.schemes import paper_beam


@pytest.fixture(scope="module")
def small():
    return list(families(largest=100))


def test_every_family_and_method_is_there(small):
    assert [one.elements for one in small] == [10, 100, 40, 10, 100, 40, 40]
    assert len({one.beam for one in small}) == len(FAMILIES)
    names = [method.name for method in methods()]
    assert [row.method for row in small[-1].rows] == [name for name in names if "fused kernel" not in name]
    assert set(names) <= set(STYLES)


def test_the_engine_is_exact_everywhere(small):
    for one in small:
        for row in one.rows:
            if row.method == "condensed mixed" or "gapbeam.solve" in row.method:
                assert row.error < 1e-14
            assert not row.failure
            assert row.seconds > 0.0


def test_steps_and_events_end_in_the_same_answer(small):
    rows = {row.method: row for row in small[-1].rows}
    assert rows["gapbeam.solve, 100 steps"].solves > rows["gapbeam.solve, 10 steps"].solves > rows["gapbeam.solve"].solves
    assert rows["gapbeam.solve, events"].error < 1e-14


def test_csv_holds_everything(small):
    rows = list(csv.DictReader(io.StringIO(to_csv(small))))
    assert tuple(rows[0]) == FIELDS
    assert len(rows) == sum(len(one.rows) for one in small)
    assert {row["front"] for row in rows} == {"0", "1"}
    assert all(float(row["error"]) >= max(float(row[k] or 0) for k in ("deflection", "moment", "reaction")) for row in rows)


def test_page_has_a_table_for_every_family(small):
    page = to_markdown(small, "accuracy.svg")
    assert page.count("\n## ") == len(FAMILIES)
    assert page.count("| condensed mixed |") == len(FAMILIES)
    assert "](accuracy.svg)" in page
    assert "**" in page


def test_picture_names_every_method(small, tmp_path):
    plot_accuracy(small, tmp_path / "accuracy.svg")
    texts = re.findall(r"<text[^>]*>([^<]+)</text>", (tmp_path / "accuracy.svg").read_text(encoding="utf-8"))
    assert {row.method for one in small for row in one.rows} <= set(texts)
    assert "one span: 10 to 100 elements" in texts
    plot_accuracy(small[:1], tmp_path / "one.png")
    assert (tmp_path / "one.png").stat().st_size > 10_000


def made(*errors, seconds=1.0, failure=""):
    methods = ("condensed mixed", "displacement")
    return [Measured(m, e, e, e, seconds * (k + 1), 1, failure) for k, (m, e) in enumerate(zip(methods, errors, strict=True))]


def test_findings_follow_the_numbers():
    good = [Comparison("easy", 10, made(1e-16, 1e-14)), Comparison("easy", 100, made(1e-16, 2e-13))]
    reached = {10: (1e-16, 1e-14), 100: (3e-16, 2e-5), 1000: (0.0, 1.0)}
    bad = [Comparison("hard", elements, made(*errors)) for elements, errors in reached.items()]
    said = findings(good + bad)
    assert "Easy: condensed mixed is right to 1e-16" in said[0]
    assert "as good for every practical purpose (2e-13 at worst)" in said[0]
    assert "is right to 1e-14 up to 10 elements and keeps no digit at 1,000" in said[1]
    assert "It takes 2.0 times the time of condensed mixed" in said[1]
    assert "method keeps 4 digits at 100" in findings(bad[1:2])[0]


def test_front():
    rows = [Measured("", e, e, e, t, 1) for e, t in ((1e-16, 2.0), (3e-16, 1.0), (1e-9, 0.5), (1e-8, 0.6), (0.5, 0.1))]
    assert front(rows) == [False, True, True, False, False]


def test_failures_are_told():
    failed = [Measured("displacement", float("inf"), float("inf"), float("inf"), 1.0, 1, "singular")]
    page = to_markdown([Comparison("one", 10, failed)])
    assert "| displacement | singular |" in page


def test_scene(capsys, tmp_path):
    assert main(["study", "accuracy", "examples/three_spans.toml", "--parts", "1", "4", "--csv", str(tmp_path / "a.csv")]) == 0
    printed = capsys.readouterr().out
    assert "Three spans on bearings that can lift off" in printed
    rows = list(csv.DictReader((tmp_path / "a.csv").open(encoding="utf-8")))
    assert {row["elements"] for row in rows} == {"4", "16"}
    assert all(float(row["error"]) < 1e-11 for row in rows)


def test_cycling_scene_is_compared():
    comparisons, remark = scene_comparisons(paper_beam(("above", "below", "below")), [2])
    assert not remark
    assert max(row.error for row in comparisons[0].rows) < 1e-11


def test_scene_that_does_not_fit_is_measured_by_the_engine_alone(capsys):
    comparisons, remark = scene_comparisons("examples/crane_runway.toml")
    assert "shear flexibility" in remark
    assert {row.method.split(",")[0] for row in comparisons[0].rows} == {"gapbeam.solve"}
    assert max(row.error for row in comparisons[0].rows) < 1e-14
    print_comparisons(comparisons, remark)
    assert "shear flexibility" in " ".join(capsys.readouterr().out.split())


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--family", "bridges"], "--family: expected one of span, spans"),
        (["--family", "span", "--largest", "5"], "--largest: no mesh has as few"),
        (["--parts", "2"], "--parts: needs a SCENE"),
        (["examples/three_spans.toml", "--parts", "0"], "expected positive numbers"),
        (["examples/three_spans.toml", "--family", "span"], "either SCENE or --family"),
        (["--csv", "same", "--markdown", "same"], "--csv, --markdown need different files"),
        (["--plot", "picture.txt"], "--plot: expected a file that ends in"),
    ],
)
def test_refusals(arguments, words, capsys):
    assert main(["study", "accuracy", *arguments]) == 2
    assert words in capsys.readouterr().err


def test_scene_without_equilibrium(capsys, tmp_path):
    scene = tmp_path / "tips.toml"
    scene.write_text(
        "beam = { spans = [1.0, 1.0], EI = 1.0 }\n"
        'supports = [{ node = 0, side = "below" }, { node = 1, side = "below" }]\n'
        'loads = [{ type = "force", node = 2, F = 1.0 }]\n',
        encoding="utf-8",
    )
    assert main(["study", "accuracy", str(scene)]) == 2
    assert "tips about the support" in capsys.readouterr().err
