"""The study of foundations: its truth is that of the closed forms, springs come near it, and table and picture are whole."""

import csv
import io
import sys
from decimal import Decimal

import numpy as np
import pytest
from gapbeam.plots.save import picture

from studies import foundation as study
from studies import springs
from studies.command import main
from studies.diagram import GROUND_STYLES, foundation_figure
from studies.ground_truth import solve_ground
from studies.programs import has

DIGITS_OF_F2 = ("0.21969841001", "11.8336398098", "5.3139178437", "-1.70843006517")


def truth(name):
    scene, ends = study.PROBLEMS[name]
    return solve_ground(scene, ends, springs.places(scene["beam"]["spans"][0]).tolist())


def test_truth_of_a_free_beam_beyond_lift_off():
    found = truth("free beam")
    values = found.ends[0], 4 * found.deflection[5], found.moment[5], 4 * found.deflection[0]
    for value, digits in zip(values, DIGITS_OF_F2, strict=True):
        assert value.quantize(Decimal(digits)) == Decimal(digits)
    assert abs(found.ends[0] + found.ends[1] - 4) < Decimal("1e-60")


def test_truth_of_a_lifted_end():
    """The closed form is that of a half-infinite beam; what the far end changes fades as exp(-36)."""
    found = truth("lifted end")
    for value, exact in ((found.ends[0], 2), (found.moment[1], 1), (4 * found.deflection[0], -14)):
        assert abs(value - exact) < Decimal("1e-12")


def test_truth_minds_what_is_assumed():
    scene, _ = study.PROBLEMS["free beam"]
    for ends in ((), (0.2,), (0.2, 1.9, 2.1, 3.8), (3.0, 1.0)):
        with pytest.raises(ArithmeticError):
            solve_ground(scene, ends, [2.0])


@pytest.mark.parametrize("problem", study.PROBLEMS)
def test_springs_come_nearer_with_the_square_of_the_mesh(problem):
    pytest.importorskip("scipy")
    scene, _ = study.PROBLEMS[problem]
    exact, length = truth(problem), scene["beam"]["spans"][0]
    for make in (springs.by_gapbeam, lambda scene, n: springs.by_scipy(scene, n, incremental=True)):
        coarse, fine = (study._errors(make(scene, n)(), exact, length) for n in (100, 1000))
        assert max(fine) < 1e-3
        for a, b in zip(coarse, fine, strict=True):
            assert 25.0 < a / b < 200.0


@pytest.mark.skipif(not has("openseespy"), reason="OpenSees is not installed")
def test_opensees_agrees():
    scene, _ = study.PROBLEMS["work B"]
    found, expected = springs.by_opensees(scene, 100)(), springs.by_gapbeam(scene, 100)()
    for mine, theirs in zip(found, expected, strict=True):
        np.testing.assert_allclose(mine, theirs, rtol=0.0, atol=1e-11 * np.abs(theirs).max())


def test_springs_at_the_ends_have_half_the_stiffness():
    scene, _ = study.PROBLEMS["lifted end"]
    lists, columns = (springs.as_springs(scene, 10, columns) for columns in (False, True))
    assert [support["stiffness"] for support in lists["supports"]] == columns["supports"]["stiffness"].tolist()
    assert columns["supports"]["stiffness"].sum() == 20.0 * 4.0


@pytest.fixture(scope="module")
def rows():
    pytest.importorskip("scipy")
    study.PROCESSES, before = 1, study.PROCESSES
    yield list(study.foundation(largest=10))
    study.PROCESSES = before


def test_table(rows, capsys):
    assert [row.problem for row in rows if row.program == study.OWN] == list(study.PROBLEMS)
    assert {(row.program, row.nodes) for row in rows} >= {(study.OWN, 0), (study.INCREMENTAL, 1001), (study.SPRINGS, 11)}
    for row in rows:
        if row.program in (study.OWN, study.PREPARED):
            assert max(row.ends, row.deflection, row.moment) < 1e-15
        assert row.faster == 1.0 or (row.program, row.nodes) != (study.INCREMENTAL, 1001)
    page, table = study.PAGE, study.table(rows)
    written = list(csv.reader(io.StringIO(page.csv(rows))))
    assert tuple(written[0]) == study.COLUMNS
    assert {len(line) for line in (*written, *table)} == {len(study.COLUMNS)}
    text = page.markdown(table, study.findings(rows), "picture.svg")
    assert text.count("\n| work B ") == len(rows) / 3
    assert "--markdown docs/foundation-study.md --plot docs/foundation-study.svg" in text
    page.show(table)
    assert "lifted end" in capsys.readouterr().out


def test_picture(rows):
    drawn = picture(foundation_figure(rows), ".svg").decode()
    assert drawn.count(": contact ends<") == len(study.PROBLEMS)
    assert all(f">{name}<" in drawn for name in GROUND_STYLES if name in {row.program for row in rows})


def test_what_gives_up_is_told(monkeypatch):
    monkeypatch.setattr(study, "PROCESSES", 1)
    monkeypatch.setattr("studies.active_set.MOST_SOLVES", 2)
    monkeypatch.setattr(study, "BESIDE", (study.SPRINGS, 10))
    monkeypatch.setattr(study, "PROBLEMS", {"work B": study.PROBLEMS["work B"]})
    row = next(row for row in study.foundation(largest=10) if row.program == study.PLAIN)
    assert study.table([row])[0][3:] == ["-"] * 4 + ["fails"] * 3


def test_refused(monkeypatch, capsys):
    assert main(["foundation", "--largest", "9"]) == 2
    assert "--largest" in capsys.readouterr().err
    monkeypatch.setitem(sys.modules, "scipy.linalg", None)
    assert main(["foundation", "--largest", "10"]) == 2
    assert "pip install scipy" in capsys.readouterr().err
