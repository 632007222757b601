"""The study of trains: its truth is that of closed forms and of the engine, positions come near it, table and picture are whole."""

import csv
import io
from decimal import Decimal

import gapbeam
import numpy as np
import pytest
from gapbeam.plots.save import picture

from studies import train_positions as positions
from studies import train_programs as programs
from studies import trains as study
from studies.command import main
from studies.diagram import TRAIN_STYLES, trains_figure
from studies.programs import has
from studies.train_truth import solve_train


@pytest.fixture(scope="module")
def truths():
    return {name: solve_train(scene) for name, scene in study.PROBLEMS.items()}


def test_truth_of_a_span():
    """Two equal forces a apart: the largest moment is P (L - a/2)^2 / (2 L), under one of them (Culmann)."""
    scene = {
        "beam": {"spans": [16.0], "EI": 1.0},
        "supports": [{"node": 0}, {"node": 1}],
        "loads": [],
        "trains": [{"axles": [[0.0, 8.0], [4.0, 8.0]]}],
    }
    found = solve_train(scene)
    for values, expected in ((found.moment, (49, 0)), (found.shear, (14, -14)), (found.reaction[0], (14, 0))):
        assert max(abs(value - true) for value, true in zip(values, expected, strict=True)) < Decimal("1e-50")


@pytest.mark.parametrize("problem", study.PROBLEMS)
def test_gapbeam_has_all_digits(problem, truths):
    scene = study.PROBLEMS[problem]
    assert max(study._errors(study._own(scene), truths[problem])) < 4e-15
    events = gapbeam.solve(scene).trains["truck"].events
    assert [event.support for event in events] == [support for _, support in truths[problem].events]
    assert len(events) == (0 if problem == "both ways" else 8)
    for event, (position, _) in zip(events, truths[problem].events, strict=True):
        assert abs(Decimal(event.position) - position) < Decimal("1e-13")


@pytest.mark.parametrize("problem", study.PROBLEMS)
def test_positions_come_nearer_with_the_square_of_their_distance(problem, truths):
    few, many = (study._errors(positions.by_numpy(study.PROBLEMS[problem], n)(), truths[problem]) for n in (50, 2000))
    assert max(few[1], many[1]) < 1e-14  # shears are largest where an axle is at a support
    assert 1e-4 < max(few) < 1e-2
    assert max(many) < 1e-5
    assert max(study._errors(positions.by_numpy(study.PROBLEMS[problem], 100, refined=True)(), truths[problem])) < 1e-11


@pytest.mark.skipif(not has("openseespy"), reason="OpenSees is not installed")
def test_opensees_agrees():
    for scene in study.PROBLEMS.values():
        sweep = positions.Sweep(scene)
        s = np.linspace(0.0, sweep.last, 41)
        left = np.zeros(41, bool)
        values = sweep.at_positions(s, left)[1]
        expected = positions.swept(np.array([values[0].max(axis=1), values[1].min(axis=1)]))
        found = programs.by_opensees(scene, 41)()
        for mine, theirs in zip(vars(found).values(), vars(expected).values(), strict=True):
            np.testing.assert_allclose(mine, theirs, rtol=0.0, atol=1e-8 * np.abs(theirs).max())


@pytest.mark.skipif(not has("pycba"), reason="PyCBA is not installed")
def test_pycba_agrees_within_its_step(truths):
    moment, shear, most, least = study._errors(programs.by_pycba(study.PROBLEMS["both ways"], 257)(), truths["both ways"])
    assert max(moment, shear, most) < 0.02
    assert least > 0.4  # its envelopes begin at zero


@pytest.fixture(scope="module")
def rows(truths):
    with pytest.MonkeyPatch.context() as patch:
        names = {id(scene): name for name, scene in study.PROBLEMS.items()}
        patch.setattr(study, "solve_train", lambda scene: truths[names[id(scene)]])
        patch.setattr(study, "ROUNDS", 1)
        patch.setattr(study, "BESIDE", (study.REFINED, 100))
        yield list(study.trains(largest=100))


def test_table(rows, capsys):
    assert [row.problem for row in rows if row.program == study.OWN] == list(study.PROBLEMS)
    assert {row.program for row in rows} == {study.OWN, study.NUMPY, study.REFINED, study.PYCBA, study.OPENSEES}
    page, table = study.PAGE, study.table(rows)
    assert table[-1][1:5] == ["PyCBA", "-", "-", "-"]
    assert table[-1][-1] == ("cannot" if has("pycba") else "not installed")
    written = list(csv.reader(io.StringIO(page.csv(rows))))
    assert tuple(written[0]) == study.COLUMNS
    assert {len(line) for line in (*written, *table)} == {len(study.COLUMNS)}
    text = page.markdown(table, study.findings(rows), "picture.svg")
    assert text.count("\n| bearings ") == sum(row.problem == "bearings" for row in rows)
    assert "--markdown docs/trains-study.md --plot docs/trains-study.svg" in text
    page.show(table)
    assert "both ways" in capsys.readouterr().out


def test_picture(rows):
    drawn = picture(trains_figure(rows), ".svg").decode()
    assert drawn.count(": largest reaction<") == len(study.PROBLEMS)
    shown = {row.program for row in rows if row.positions or row.program == study.OWN}
    assert all(f">{name}<" in drawn for name in TRAIN_STYLES if name in shown)


def test_command(rows, monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(study, "trains", lambda largest: iter(rows))
    page, drawn, table = (str(tmp_path / f"trains-study.{suffix}") for suffix in ("md", "svg", "csv"))
    assert main(["trains", "--largest", "100", "--markdown", page, "--plot", drawn, "--csv", table]) == 0
    assert "for two beams](trains-study.svg)" in (tmp_path / "trains-study.md").read_text()
    assert "Moving loads: exact envelopes" in capsys.readouterr().out
    assert len((tmp_path / "trains-study.csv").read_text().splitlines()) == len(rows) + 1


def test_what_gives_up_is_told(monkeypatch):
    monkeypatch.setattr(positions, "MOST_CHANGES", 1)
    scene = study.PROBLEMS["bearings"]
    assert study._try(positions.by_numpy(scene, 100)) is None
    row = study.Row("bearings", study.NUMPY, 100, float("inf"), 0.0, *[float("inf")] * 4)
    assert study.table([row])[0][3:] == ["-"] * 2 + ["fails"] * 4


def test_refused(capsys):
    assert main(["trains", "--largest", "99"]) == 2
    assert "--largest" in capsys.readouterr().err
