"""The study of many cases: all programs agree with exact solutions and with each other; table and page are whole."""

import csv
import io

import numpy as np
import pytest

from studies import batch as study
from studies import batch_limits
from studies import batch_programs as programs
from studies.batch_cases import SUPPORTS
from studies.command import main

CASES = {"3 spans": 300, "10 spans": 100, "100 spans": 5, "1,000 spans": 3, SUPPORTS: 100}


@pytest.fixture(scope="module", params=CASES)
def problem(request):
    cases = programs.make(request.param, CASES[request.param])
    own = programs.PROGRAMS[programs.OWN](cases)()
    return cases, own, [study._exactly(cases, own, case) for case in range(3)]


def test_gapbeam_has_all_digits(problem):
    _, own, truths = problem
    assert all(truth.right for truth in truths)
    assert max(study.errors(own, truths)) < 1e-15
    assert not own.closed[:, 1:-1].all()


@pytest.mark.parametrize("name", [name for name in programs.PROGRAMS if name != programs.OWN])
def test_programs_agree(problem, name, monkeypatch):
    cases, own, truths = problem
    if name.startswith("jax"):
        pytest.importorskip("jax")
    if name.startswith("numba"):
        monkeypatch.setattr(programs, "_compiled", lambda: programs.loop)  # what numba compiles, as it is
    if name == "numpy, matrices" and cases.q.shape[1] >= 100:
        with pytest.raises(programs.NoScheme):
            programs.PROGRAMS[name](cases)
        return
    monkeypatch.setattr(programs, "BLOCK", 64)
    found = programs.PROGRAMS[name](cases)()
    assert max(study.errors(found, truths)) < 2e-12
    np.testing.assert_array_equal(found.closed, own.closed)
    for key, values in vars(own).items():
        np.testing.assert_allclose(getattr(found, key), values, rtol=0.0, atol=1e-11 * abs(values).max(initial=1e-300), err_msg=key)


@pytest.mark.parametrize("name", [name for name in programs.PROGRAMS if name != programs.OWN])
def test_what_is_not_settled_is_given_up(name, monkeypatch):
    if name.startswith("jax"):
        pytest.importorskip("jax")
    monkeypatch.setattr(programs, "MOST_ROUNDS", 1)
    monkeypatch.setattr(programs, "_compiled", lambda: programs.loop)
    with pytest.raises(programs.NoScheme, match="not settled in 1 rounds"):
        programs.PROGRAMS[name](programs.make("10 spans", 50))()


def test_table(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(study, "SIZES", {name: study.SIZES[name] for name in ("3 spans", SUPPORTS)})
    compiled = {"numba, loop", "jax, all cases"}
    monkeypatch.setattr(study, "PROGRAMS", {name: one for name, one in programs.PROGRAMS.items() if name not in compiled})
    monkeypatch.setattr(study, "ROUNDS", 1)
    monkeypatch.setattr(study, "PROCESSES", 1)
    for module in (study, batch_limits):
        monkeypatch.setattr(module, "bandwidth", lambda: 1e10)
    rows = list(study.batch(largest=30))
    assert [row.cases for row in rows] == [30] * 12
    limits = [row for row in rows if row.program.startswith("limit")]
    assert [row.program for row in limits] == ["limit, memory", "limit, arithmetic"] * 2
    assert all(0.0 < row.ratio < 1.0 and np.isnan(row.cold) for row in limits)
    assert not any(row.states for row in rows)
    assert all(row.seconds > 0.0 and (0.0 < row.cold < float("inf") or row in limits) for row in rows)
    rows.append(study.Row("100 spans", "numpy, matrices"))
    table = study.table(rows)
    written = list(csv.reader(io.StringIO(study.PAGE.csv(rows))))
    assert tuple(written[0]) == study.COLUMNS
    assert {len(line) for line in (*written, *table)} == {len(study.COLUMNS)}
    assert table[-1][2] == "gives up"
    monkeypatch.setattr(study, "batch", lambda largest: iter(rows[:-1]))
    page = tmp_path / "batch-study.md"
    assert main(["batch", "--largest", "30", "--markdown", str(page), "--csv", str(tmp_path / "a.csv")]) == 0
    assert "* 3 spans: gapbeam solves" in page.read_text()
    assert "--markdown docs/batch-study.md`" in page.read_text()
    assert "Run time of many load cases" in capsys.readouterr().out
    assert main(["batch", "--largest", "0"]) == 2
