"""Contact at scale and the kernel: the yardsticks find what gapbeam finds, and the tables hold what they should."""

import csv
import io
import sys

import gapbeam
import numpy as np
import pytest
from gapbeam.studies.meshes import gapped_spans, one_span
from gapbeam.studies.methods import kernel, yardstick
from gapbeam.studies.truth import error, solve_exactly, solve_one_span

from studies import contact as study_contact
from studies import kernel as study_kernel
from studies.active_set import active_set
from studies.command import main
from studies.schemes import sprung_base

WORKS = {"A": (gapped_spans, 4), "B": (sprung_base, 1)}


@pytest.mark.parametrize("incremental", [False, True])
@pytest.mark.parametrize(("work", "count"), [("A", 10), ("A", 1000), ("B", 100), ("B", 1000)])
def test_active_set_agrees_with_gapbeam(work, count, incremental):
    pytest.importorskip("scipy")
    make, parts = WORKS[work]
    scene = make(count)
    found, step = active_set(scene, parts, incremental), gapbeam.solve(scene).steps[-1]
    assert np.array_equal(found.closed, np.array(step.state) != "open")
    close = 1e-14 if incremental else 1e-6
    for mine, theirs in ((found.deflection, step.deflection), (found.reaction, step.reaction)):
        assert np.abs(mine - theirs).max() < close * np.abs(theirs).max()


def test_gapbeam_is_right_to_the_last_digit_at_scale():
    """Work A with 1,000 spans and work B with 1,000 springs, against decimals of 80 digits."""
    for make in (gapped_spans, sprung_base):
        scene = make(1000)
        beam, step = study_contact.mesh(scene, 1), gapbeam.solve(scene).steps[-1]
        truth = solve_exactly(beam, np.array(step.state) != "open")
        assert truth.right
        assert error(step.deflection, truth.deflection) < 1e-15
        assert error(step.reaction, truth.reaction) < 1e-15


def test_contact_table(monkeypatch, capsys):
    pytest.importorskip("scipy")
    monkeypatch.setattr(study_contact, "PROCESSES", 1)
    monkeypatch.setattr(study_contact, "ROUNDS", 3)
    rows = list(study_contact.contact(largest=100))
    assert [row.problem for row in rows[::7]] == ["work A, 10 spans", "work A, 100 spans", "work B, 100 springs"]
    assert not any(row.wrong for row in rows)
    for row in rows:
        largest = {"active set": 1e-10, "active set, incremental": 1e-14}.get(row.program, 1e-15)
        assert max(row.deflection, row.reaction) < largest
    assert {row.program: row.solves for row in rows[:7]}["gapbeam.solve"] == 2
    page, table = study_contact.PAGE, study_contact.table(rows)
    written = list(csv.reader(io.StringIO(page.csv(rows))))
    assert tuple(written[0]) == study_contact.COLUMNS
    assert {len(line) for line in (*written, *table)} == {len(study_contact.COLUMNS)}
    assert page.markdown(table).count("\n| work ") == len(rows)
    page.show(table)
    assert "work B, 100 springs" in capsys.readouterr().out


def test_without_scipy(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "scipy.linalg", None)
    assert main(["contact", "--largest", "10"]) == 2
    assert "pip install scipy" in capsys.readouterr().err


def test_kernel_table(monkeypatch, capsys):
    monkeypatch.setattr(study_kernel, "WORK", 5000)
    monkeypatch.setattr(study_kernel, "stream_bandwidth", lambda: 2.5e10)
    rows = list(study_kernel.kernels(largest=1000))
    assert {row.nodes for row in rows} == {10, 100, 1000}
    for row in rows:
        assert row.difference < (1e-9 if row.method == "dgbsv" else 1e-13)
        assert row.faster == 1.0 or row.method != "dgbsv"
    assert {(row.method, row.state) for row in rows} >= {("dgbsv", 184), ("fused kernel", 48)}
    page, table = study_kernel.PAGE, study_kernel.table(rows)
    written = list(csv.reader(io.StringIO(page.csv(rows))))
    assert tuple(written[0]) == study_kernel.COLUMNS
    assert {len(line) for line in (*written, *table)} == {len(study_kernel.COLUMNS)}
    assert page.markdown(table).count("\n| random |") == len(rows) / 2
    page.show(table)
    assert "fused kernel" in capsys.readouterr().out


@pytest.mark.parametrize("make", [one_span, study_kernel.random_beam])
def test_what_the_kernel_study_times_is_right(make):
    beam = make(300)
    truth = solve_exactly(beam)
    plain = (yardstick("nodal mixed", 0, reactions=False), yardstick("dgbsv", 1, reactions=False), kernel())
    for method, allowed in (*((method, 1e-11) for method in plain), (kernel(1), 4e-16)):
        answer = method.run(beam, 1)
        assert error(answer.deflection, truth.deflection) < allowed
        assert error(answer.moment, truth.moment) < allowed


def test_a_refined_kernel_keeps_all_digits_on_fine_meshes():
    beam = one_span(100_000)
    truth = solve_one_span(beam)
    errors = []
    for method in (kernel(), kernel(1)):
        answer = method.run(beam, 1)
        errors.append(max(error(answer.deflection, truth.deflection), error(answer.moment, truth.moment)))
    assert errors[0] > 1e-14
    assert errors[1] < 1e-15


def test_bandwidth_is_measured():
    assert 1e8 < study_kernel.stream_bandwidth(10**5) < 1e13


def test_command(capsys):
    assert main(["kernel", "--largest", "5"]) == 2
    assert "--largest" in capsys.readouterr().err
