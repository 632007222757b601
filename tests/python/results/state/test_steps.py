"""Many load steps: little is kept of each, and what is looked at is as it was when it was solved."""

import gc
import json
import pickle
import resource
import subprocess
import sys
import tracemalloc
from itertools import pairwise

import gapbeam
import numpy as np
import pytest
from gapbeam.base import memory
from gapbeam.report import report_text, to_csv, to_json
from scenes import at, force, scene, uniform


def lifted(spans, steps, **analysis):
    """Bearings, some with a gap, that are met and left one after the other as the far end is pulled up."""
    supports = [at(0), *(at(i, side="below", gap=0.002 * (i % 3)) for i in range(1, spans + 1))]
    loads = [uniform(2.0, case="dead"), force(6.0 * spans, -4.2 * spans)]
    return scene([6.0] * spans, supports, loads, EI=1e4, analysis={"steps": steps, **analysis})


def tipping(steps):
    loads = [uniform(1.0, case="dead", to=1.0), force(2.0, 10.0)]
    return scene([1.0, 1.0], [at(0, side="below"), at(1, side="below")], loads, analysis={"steps": steps})


def test_steps_are_a_sequence():
    steps = gapbeam.solve(lifted(3, 8)).steps
    factors = [k / 8 for k in range(1, 9)]
    assert len(steps) == 8
    assert bool(steps)
    assert [step.factor for step in steps] == factors
    assert [steps[k].factor for k in range(-8, 8)] == factors * 2
    assert [step.factor for step in reversed(steps)] == factors[::-1]
    for part in (slice(None), slice(2, 5), slice(-3, None), slice(None, None, -2), slice(7, 2), slice(0, 100)):
        assert [step.factor for step in steps[part]] == factors[part]
        assert steps[part] == [steps[k] for k in range(8)[part]]
    assert steps[np.int64(2)] == steps[2]
    assert steps[2] in steps
    assert steps.index(steps[2]) == 2
    for wrong in (8, -9):
        with pytest.raises(IndexError):
            steps[wrong]
    with pytest.raises(TypeError):
        steps["1"]


def test_no_steps():
    steps = gapbeam.solve(tipping(1)).steps
    assert len(steps) == 0
    assert list(steps) == steps[:] == []
    assert not steps


def test_a_step_looked_at_is_the_one_that_was_solved():
    """Solved one after the other by hand, each from the scheme of the one before: the same digits, whatever the order."""
    made = lifted(9, 40)
    result = gapbeam.solve(made)
    alone = gapbeam.solve({**made, "analysis": {}})
    schemes = {step.state for step in result.steps}
    assert len(schemes) > 5
    start = np.ones(10, dtype=np.int32)
    solves = 0
    for k in range(40):
        solution = alone._beam.solve((k + 1) / 40, "block", start)
        for step in (result.steps[k], pickle.loads(pickle.dumps(result)).steps[k - 40]):
            assert step.solution == solution
            assert step.solves == step.solution.solves == solution.solves
            assert step.closed.tolist() == solution.closed.tolist()
        start, solves = solution.closed, solves + solution.solves
    assert result.solves == solves
    assert result.seconds == pytest.approx(sum(step.seconds for step in result.steps))
    assert result.history() == [(step.factor, step.state) for step in result.steps]


def test_steps_up_to_the_one_that_falls():
    result = gapbeam.solve(tipping(1000))
    assert result.status == "no-equilibrium"
    assert len(result.steps) == 50
    assert result.steps[-1].factor == 0.05
    assert "at load factor 0.051:" in result.reason
    assert len(pickle.dumps(result)) < 8_000


def test_the_last_step_is_not_solved_again(monkeypatch):
    result = gapbeam.solve(lifted(3, 8))
    monkeypatch.setattr(gapbeam.engine.beam.Beam, "solve", None)
    result._pairs_of_extremes()
    assert result.steps[-1].reaction.shape == (4,)
    assert len(result.history()) == 8
    assert [step.solves for step in result.steps]
    assert result.steps[-1].residuals


def kept(made):
    """Bytes that a result holds, apart from what it holds with one step."""
    held = []
    for steps in (made["analysis"]["steps"], 1):
        tracemalloc.start()
        result = gapbeam.solve({**made, "analysis": {"steps": steps}})
        gc.collect()  # empties the free lists as well
        held.append(tracemalloc.get_traced_memory()[0])
        tracemalloc.stop()
        assert result.status == "solved"
    return held[0] - held[1]


def test_a_step_takes_few_bytes():
    """A bit a support, 4 bytes for its solves, 8 for its time."""
    gapbeam.solve(lifted(3, 3))  # what the first call imports and caches
    for spans, row in ((3, 1), (30, 4)):
        assert kept(lifted(spans, 3000)) < 3000 * (row + 12) + 20_000


def test_looking_at_many_steps_keeps_few():
    result = gapbeam.solve(lifted(3, 3000))
    tracemalloc.start()
    largest = max(step.deflection.max() for step in result.steps)
    for k in range(0, 3000, 7):
        assert result.steps[k].deflection.max() <= largest
    gc.collect()
    assert tracemalloc.get_traced_memory()[0] < 50_000
    tracemalloc.stop()


def test_everything_works_with_many_steps():
    result = gapbeam.solve(lifted(3, 2000))
    tracemalloc.start()
    text = report_text(result, verbose=True)
    assert tracemalloc.get_traced_memory()[1] < 4e6
    tracemalloc.stop()
    assert "1,960 rows in the middle are left out here; all are in the output of --json" in text
    assert "Together 2," in text
    assert len(text.splitlines()) < 150
    written = to_json(result)
    data = json.loads(written)
    assert data == json.loads(json.dumps(result.to_dict()))
    assert [step["factor"] for step in data["steps"]] == [step.factor for step in result.steps]
    assert to_csv(result).count("\n") > 60


def test_json_of_steps_is_laid_out_like_the_rest():
    lines = to_json(gapbeam.solve(lifted(3, 2))).splitlines()
    start = lines.index(' "steps": [')
    assert lines[start + 1] == "  {"
    assert lines[start + 2] == '   "factor": 0.5,'
    assert lines[start + 5] == '   "supports": ['
    assert lines[start + 6].startswith('    {"x": 0.0, "side": "both"')


def test_what_cannot_fit_is_refused(monkeypatch):
    monkeypatch.setattr(memory, "available", lambda: 2e9)
    refusal = (
        "analysis.steps: 1,000,000,000 load steps take 13 GB of memory, and 2 GB can be had; take fewer, or follow = \"events\""
    )
    with pytest.raises(gapbeam.SceneError) as error:
        gapbeam.solve(lifted(3, 10**9))
    assert str(error.value) == refusal
    gapbeam.solve(lifted(3, 10**9, follow="events"))


def test_json_that_cannot_fit_is_refused(monkeypatch):
    result = gapbeam.solve(lifted(3, 9000))
    monkeypatch.setattr(memory, "available", lambda: 1e6)
    with pytest.raises(gapbeam.SceneError, match=r"analysis.steps: 9,000 steps as JSON take \d\d MB of memory, and 1 MB"):
        to_json(result)


@pytest.mark.parametrize("steps", [10**9, 2**31 - 1])
def test_steps_beyond_the_limit_of_the_process(tmp_path, steps):
    """A limit that the process is under is kept to: one line, and nothing taken."""
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(lifted(3, steps)))

    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (2_000_000_000, 2_000_000_000))

    run = [sys.executable, "-m", "gapbeam", "run", str(path)]
    done = subprocess.run(run, capture_output=True, text=True, preexec_fn=limit, timeout=60, check=False)
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.count("\n") == 1
    assert done.stderr.startswith(f"gapbeam: error: analysis.steps: {steps:,} load steps take ")


def test_the_memory_there_is():
    assert 1e6 < memory.available() < 1e16
    words = [memory.size(amount) for amount in (0.0, 999.0, 1500.0, 2.4e10, 3.1e15)]
    assert words == ["0 bytes", "999 bytes", "1.5 kB", "24 GB", "3,100 TB"]


def test_events_have_steps_too():
    result = gapbeam.solve(lifted(9, 1, follow="events"))
    assert len(result.steps) == len(result.segments) > 3
    assert [step.factor for step in result.steps] == [segment.stop for segment in result.segments]
    assert all(a.state != b.state for a, b in pairwise(result.steps))
    assert result.history() == [(step.factor, step.state) for step in result.steps]
    assert result.steps[-2] == result.steps[len(result.steps) - 2]


def test_the_old_name_of_breakpoints_warns():
    made = {"beam": {"spans": [1.0], "EI": 1.0}, "supports": [{"node": 0, "law": [[1.0, 2.0]]}, {"node": 1}]}
    step = gapbeam.solve(made).steps[-1]
    with pytest.warns(DeprecationWarning, match="called breakpoints"):
        assert (step.kinks == step.breakpoints).all()
