"""The corners of the study extremes: every one to 1e-12, against exact solutions."""

import csv
import io
import random
from pathlib import Path

import gapbeam
import oracle
import pytest
from gapbeam.studies import exact
from scenes import INF, at, force, random_scene, scene, uniform

from studies import corners as study
from studies.command import main
from studies.extremes import cases, in_units

TOLERANCE = 1e-12
DOCS = Path(__file__).parents[2] / "docs" / "extremes.md"
CASES = list(cases(10**4))


@pytest.mark.parametrize(
    "case", [pytest.param(case, id=f"{case.corner}: {case.value}") for case in CASES if not case.ill_conditioned]
)
def test_corner(case):
    (row,) = study.extremes([case])
    assert row.covered, (row.error, row.bound)
    assert row.error <= TOLERANCE, (row.kind, row.worst)
    if row.error > 1e-14:
        assert row.bound <= 1000 * row.error, (row.error, row.bound)


@pytest.mark.parametrize("value", ["0.001", "1e-06", "1e-09"])
def test_bound_says_what_is_ill_conditioned(value):
    case = next(case for case in CASES if case.ill_conditioned and case.value == value)
    (row,) = study.extremes([case])
    assert row.covered, (row.error, row.bound)


# The exact solution itself


@pytest.mark.parametrize("most", [0, 10**6], ids=["decimals", "fractions"])
@pytest.mark.parametrize("seed", range(40))
def test_exact_solution_agrees_with_another_method(seed, most, monkeypatch):
    monkeypatch.setattr(exact, "MOST_EXACT", most)
    made = random_scene(random.Random(seed), held=True)
    found = oracle.solve(made)
    reference = exact.Reference(gapbeam.read_scene(made))
    assert reference.solve(found.state)
    for name, values in (("reaction", found.reaction), ("place_deflection", found.deflection)):
        assert reference.error(name, [float(v) for v in values]) <= 1e-13  # the other one rounds the x of nodes
    for side in ("left", "right"):
        inner = slice(1, None) if side == "left" else slice(None, -1)
        fields = [found.at(x, side) for x in reference.x]
        for name in ("moment", "shear"):
            values = [float(getattr(point, name)) for point in fields]
            assert reference.error(f"{name}_{side}", values, inner=inner) <= 1e-13


def test_exact_solution_corrects_a_wrong_scheme():
    made = scene([1.0] * 3, [at(0), at(1, side="below"), at(2, side="below"), at(3)], [force(0.5, 8.0)])
    reference = exact.Reference(gapbeam.read_scene(made))
    assert not reference.solve(["bilateral", "open", "closed", "bilateral"])
    assert reference.solve(["bilateral", "closed", "open", "bilateral"])
    assert reference.reaction[2] == 0
    assert reference.error("reaction", gapbeam.solve(made).steps[-1].reaction) < 1e-15


def test_exact_solution_refuses_mechanisms():
    reference = exact.Reference(gapbeam.read_scene(scene([1.0], [at(0)], [uniform(1.0)])))
    with pytest.raises(ZeroDivisionError, match="mechanism"):
        reference.solve(["bilateral"])


def test_errors_are_seen():
    made = scene([1.0, 1.0], [at(0), at(1), at(2)], [uniform(1.0)])
    reference = exact.Reference(gapbeam.read_scene(made))
    reference.solve(["bilateral"] * 3)
    assert reference.error("reaction", [0.375, 1.25, 0.375]) == 0.0
    assert reference.error("reaction", [0.375, 1.25 * (1 + 1e-8), 0.375]) == pytest.approx(1e-8)
    assert reference.error("reaction", [0.375, INF, 0.375]) == INF


# The command


def test_units_are_exact():
    made = scene([3.0], [at(0, rotation=5.0), at(1, gap=0.5, side="below")], [uniform(7.0)], EI=INF)
    assert in_units(in_units(made, 4.0, 0.25), 0.25, 4.0) == made
    assert in_units(made, 2.0, 8.0)["loads"][0]["q"] == 7.0 * 2.0 / 8.0


def test_command(capsys, monkeypatch, tmp_path):
    chosen = [case for case in CASES if case.corner in ("nearly a mechanism", "load beside load")]
    monkeypatch.setattr("studies.extremes.cases", lambda largest: iter(chosen))
    assert main(["extremes", "--csv", str(tmp_path / "t.csv")]) == 0
    printed = capsys.readouterr().out
    assert "nearly a mechanism" in printed
    assert "Worst of all:" in printed
    rows = list(csv.DictReader(io.StringIO((tmp_path / "t.csv").read_text())))
    assert [(row["corner"], row["value"]) for row in rows] == [(case.corner, case.value) for case in chosen]
    assert all(float(row["true error"]) < TOLERANCE for row in rows)
    assert main(["extremes", "--markdown", "-"]) == 0
    assert capsys.readouterr().out.count("| load beside load |") == 3


def test_page_of_the_documentation_is_the_command_s():
    lines = [line.split(" | ") for line in DOCS.read_text().splitlines() if line.startswith("| ")]
    found = [(line[0].removeprefix("| "), line[1]) for line in lines[1:]]
    assert found == [(case.corner, case.value) for case in cases()]
    assert DOCS.read_text().startswith(study.PAGE.markdown(study.table([study.Row("", "", 0)]), "Worst").partition("Worst")[0])
