"""A small part of every family of `attack`, the same in every run; and that the judges see what they are to see."""

import os
import random
import re
import resource
import signal
import time
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace

import gapbeam
import numpy as np
import pytest
from oracle.forms import Reading
from scenes import at, force, scene, uniform
from scenes.degenerate import draw as draw_degenerate
from scipy.optimize import linprog

from attack import command, compare, doubled, draw, events, hinges, memory, models, mutants
from attack.exact import Exact, NoSolution, Redundant, falls_surely, moves_freely, stands
from attack.family import Family, Verdict
from attack.workers import Ended, judge_all

TOP = Path(__file__).resolve().parents[2]
SMALL = {
    "events": 60, "signs": 150, "hinges": 60, "mutants": 60, "memory": 8,
    "laws": 60, "yielding": 20, "curves": 20, "doubled": 60, "ground": 60, "trains": 12, "combinations": 25, "batches": 40,
    "roads": 19, "mixed": 30,
}  # fmt: skip


@pytest.fixture(autouse=True)
def memory_without_limit():
    """A judge that is called in this process sets a limit, which later tests are not to have."""
    limits = resource.getrlimit(resource.RLIMIT_AS)
    yield
    resource.setrlimit(resource.RLIMIT_AS, limits)


@pytest.mark.parametrize("family", SMALL)
def test_a_small_part(family):
    found = command.FAMILIES[family].verdicts(range(SMALL[family]), 1, 20.0, float("inf"))
    assert {seed: verdict.wrong for seed, verdict in found if verdict.wrong} == {}


def test_the_page_has_every_promise():
    page = (TOP / "docs" / "reliability.md").read_text()
    for family in command.FAMILIES.values():
        assert f"| {family.promise} |" in page, family.name


# The judges


def with_more_load(made):
    """A scene whose loads and axles are a millionth more."""
    more = 1 + 1e-6

    def times(item):
        return {key: np.multiply(value, more).tolist() if key in ("F", "M", "q", "kappa") else value for key, value in item.items()}

    trains = [times(train) | {"axles": [[d, F * more] for d, F in train["axles"]]} for train in made.get("trains", ())]
    return {**made, "loads": [times(load) for load in made["loads"]]} | ({"trains": trains} if trains else {})


@pytest.mark.parametrize("family", ["laws", "yielding", "curves", "doubled", "ground", "trains", "combinations", "batches"])
def test_answers_to_a_little_more_load_are_seen(family, monkeypatch):
    judge, seen, solved = command.FAMILIES[family], 0, 0
    cases = [judge.draw(seed)[1] for seed in range(16)]
    for name in ("solve", "prepare"):
        right = getattr(gapbeam, name)
        monkeypatch.setattr(gapbeam, name, lambda made, right=right, **keys: right(with_more_load(made), **keys))
    for seed, case in enumerate(cases):
        verdict = judge.judged(case, seed)
        if verdict.outcome == "solved":
            solved, seen = solved + 1, seen + bool(verdict.wrong)
    assert solved > 5
    assert seen > solved / 2


def test_laws_are_added_where_pieces_are_vertical_and_at_walls():
    one, other = [[1.0, 2.0], [1.0, 4.0], [2.0, 5.0]], [[0.5, 3.0], [1.5, 3.0]]
    assert doubled.added([one, other]) == [[0.5, 4.0], [1.0, 5.0], [1.0, 7.0], [1.5, 7.5], [2.0, 8.0], [3.0, 9.0]]
    assert doubled.added([one, [[1.5, 3.0], [1.5, 9.0]]]) == [[1.0, 4.0], [1.0, 6.0], [1.5, 7.5], [1.5, 13.5]]
    assert doubled.shares_are_free([{"law": one}, {"law": [[1.0, 1.0], [1.0, 2.0]]}])
    assert not doubled.shares_are_free([{"law": one}, {"law": other}])


def solved(made, **keys):
    """A scene, its exact beam and its last step."""
    result = gapbeam.solve(made, **keys)
    return Exact(made), result.steps[-1], compare.Look(result, {})


LIFTED = scene([2.0, 2.0], [at(0), at(1, side="below"), at(2, side="below", gap=0.25)], [uniform(8.0), force(4.0, -4.0)], EI=64.0)


def complaints(**changes):
    """What is said of a state some of whose values are others."""
    beam, right, look = solved(LIFTED)
    names = ("factor", "state", "reaction", "undecided", "indifferent", "bounds", "error_bounds", "solution")
    step = SimpleNamespace(**{name: getattr(right, name) for name in names} | changes)
    verdict = Verdict()
    compare.compare_state(beam, step, look, verdict)
    return " ".join(verdict.wrong)


def test_a_right_state_is_right():
    assert complaints() == ""
    assert solved(LIFTED)[1].state == ("bilateral", "closed", "open")


def test_a_wrong_sign_is_seen():
    assert "not named undecided, at supports 2" in complaints(state=("bilateral", "closed", "closed"))
    assert "not named" not in complaints(state=("bilateral", "closed", "closed"), undecided=(2,))


def test_a_mechanism_is_seen():
    made = scene([2.0], [at(0), at(1, side="below")], [force(1.0, 1.0)])
    with pytest.raises(NoSolution):
        Exact(made).scheme([False], Fraction(1))


def test_freedom_that_is_not_there_is_seen():
    assert "said to be free to move" in complaints(indifferent=True)
    beam = Exact(scene([2.0], [at(0), at(1, side="below", gap=0.5)], [force(0.0, 1.0)]))
    values = beam.scheme([True], Fraction(1)).at(Fraction(1))
    assert moves_freely(beam, values)
    beam = Exact(scene([2.0], [at(0), at(1, side="below")], [force(1.0, 1.0)]))
    assert not moves_freely(beam, beam.scheme([True], Fraction(1)).at(Fraction(1)))


def test_wrong_values_and_bounds_are_seen():
    step = solved(LIFTED)[1]
    assert "reaction bound" in complaints(reaction=step.reaction + np.array([0.0, 1e-9, 0.0]))
    assert "nan" in complaints(reaction=step.reaction * np.nan)
    assert "deflection bound 0 below" in complaints(bounds=(0.0, 0.0), factor=1.0 + 1e-9)
    for kind in step.error_bounds:
        assert f"{kind} bound 0 below" in complaints(error_bounds={**step.error_bounds, kind: 0.0}, factor=1.0 + 1e-9)
        assert f"{kind}: " in complaints(error_bounds={**step.error_bounds, kind: None})


def test_motions_are_judged():
    beam = Reading(scene([2.0, 2.0], [at(0), at(1, side="below")], [force(4.0, -1.0)], hinges=[1.0]))
    judged = {
        ((0.0, 0.0), (1.0, 0.0), (4.0, -1.0)): "",
        ((0.0, 0.0), (1.0, 0.5), (4.0, 1.0)): "goes into support 1",
        ((0.0, 0.0), (1.0, -1.0), (4.0, 2.0)): "no work",
        ((0.0, 1.0), (1.0, 0.5), (4.0, -1.0)): "holds both ways",
        ((0.0, 0.0), (2.0, -0.75), (4.0, -1.0)): "bends",
        ((0.0, 0.0), (1.0, 0.0), (4.0, 0.0)): "nothing",
        (): "no motion",
    }
    for motion, said in judged.items():
        found = "; ".join(compare.motion_faults(beam, list(motion), Fraction(1)))
        assert (said in found) if said else not found, (motion, found)


def work_at_most(beam):
    """The largest work along a free motion whose displacements at hinges and ends are at most 1, by a linear programme."""
    count = len(beam.bodies) + 1
    work, rows = np.zeros(count), {False: [], True: []}
    for k, body in enumerate(beam.bodies):
        work[k : k + 2] += np.array(body.work(Fraction(1)), dtype=float)
        for left, right, bilateral in body.rows:
            row = np.zeros(count)
            row[k : k + 2] = float(left), float(right)
            rows[bilateral].append(row)
    held = {f"{name}_{side}": value for bilateral, name, sign in ((False, "A", -1.0), (True, "A", 1.0)) if rows[bilateral]
            for side, value in (("eq" if bilateral else "ub", sign * np.array(rows[bilateral])),)}  # fmt: skip
    zeros = {"b" + key[1:]: np.zeros(len(value)) for key, value in held.items()}
    return -linprog(-work, **held, **zeros, bounds=[(-1.0, 1.0)] * count).fun


@pytest.mark.parametrize("block", range(4))
def test_standing_is_what_a_linear_programme_finds(block):
    kinds = set()
    for seed in range(1000 + 50 * block, 1050 + 50 * block):
        beam = Reading(hinges.draw_scene(seed)[1])
        falls, sharp = falls_surely(beam, Fraction(1), Fraction(1, 10**6))
        kinds.add(falls)
        assert not sharp or falls == (work_at_most(beam) > 1e-8 * float(beam.load_size())), seed
    assert kinds == {False, True}


@pytest.mark.parametrize("block", range(4))
def test_standing_is_what_the_rays_of_the_cone_say(block):
    words = {"falls": "no-equilibrium", "stands": "solved", "indifferent": "indifferent"}
    for seed in range(100 * block, 100 * block + 100):
        beam = Exact(draw_degenerate(seed)[1])
        assert words[stands(beam, Fraction(1))] == beam.stability((Fraction(1),) * 3)[0], seed


def test_intervals_of_schemes_end_where_signs_change():
    checked = 0
    for seed in range(40):
        beam = Exact(events.draw_scene(seed)[1])
        closed = [random.Random(seed).random() < 0.5 for _ in beam.one_sided]
        try:
            found = beam.scheme(closed, Fraction(1, 2))
        except (NoSolution, Redundant):
            continue
        low, high, below, above = beam.interval(closed, found)
        for end, supports in ((low, below), (high, above)):
            if end is not None:
                checked += 1
                assert all(beam.measure(closed, i, found.at(end)) == 0 for i in supports)
        if low is not None and high is not None and low < high:
            wrong = beam.wrong(closed, found.at((low + high) / 2))
            assert all(beam.course(closed, i, found)[1] == 0 for i in wrong)
    assert checked > 20


def test_events_at_wrong_factors_are_seen():
    made = scene([2.0, 2.0], [at(0), at(1, side="below", gap=0.0625), at(2)], [uniform(8.0)], EI=3.0)
    path = gapbeam.solve({**made, "analysis": {"follow": "events"}})
    beam, verdict = Exact(made), Verdict()
    events.check_path(beam, path, verdict)
    assert verdict.wrong == []
    first, second = path.segments
    schemes = [([False], beam.scheme([False], Fraction(1, 100))), ([True], beam.scheme([True], Fraction(1)))]
    events.check_segment(beam, replace(first, stop=first.stop * (1 + 1e-6)), *schemes[0], verdict)
    events.check_segment(beam, replace(second, start=second.start * (1 - 1e-6)), *schemes[1], verdict)
    assert [text.startswith("events: the scheme from") for text in verdict.wrong] == [True, True]
    events.check_changes(beam, path, Fraction(1, 2), *schemes, verdict)
    assert "[1] change and are not named" in verdict.wrong[2]
    assert "a change at 0.5" in verdict.wrong[3]


def test_reactions_out_of_balance_are_seen():
    made = scene([2.0, 2.0], [at(0), at(1), at(2)], [uniform(4.0)], hinges=[3.0])
    beam, step = Reading(made), gapbeam.solve(made).steps[-1]
    assert hinges.balance_faults(beam, step) == []
    same = {name: getattr(step, name) for name in ("couple", "factor", "bounds", "undecided")}
    other = SimpleNamespace(reaction=step.reaction + np.array([0.0, 1e-6, 0.0]), **same)
    assert "no balance at x = 0" in " ".join(hinges.balance_faults(beam, other))


def test_doubled_beams_are_symmetric():
    for seed in range(20):
        rng = random.Random(seed)
        made = draw.draw_beam(rng, draw.ROUND, spans=(1, 2), most=3)
        made["loads"] = draw.draw_loads(rng, draw.ROUND, made)
        beam = Exact(draw.mirror_double(made))
        kinds = sorted((support["x"], support.get("side"), support.get("gap")) for support in beam.supports)
        assert kinds == sorted((beam.length - x, side, gap) for x, side, gap in kinds)


def test_cases_are_the_same_in_every_run():
    for name in SMALL:
        draw_case = command.FAMILIES[name].draw
        assert [draw_case(seed) for seed in range(8)] == [draw_case(seed) for seed in range(8)]


def test_wrong_uses_of_a_file_are_seen(monkeypatch):
    def judged(text, name="", answer=None):
        if name:
            monkeypatch.setattr(*(mutants, name) if name == "main" else (mutants.gapbeam, name), answer)
        return mutants.judge((".json", text)).wrong

    good = b'{"beam": {"spans": [2.0], "EI": 1.0}, "supports": [{"node": 0, "rotation": "fixed"}]}'
    assert judged(good) == judged(b"{") == []
    assert any("exit status 3" in text for text in judged(good, "main", lambda _: 3))
    assert any("KeyError" in text for text in judged(good, "main", lambda _: {}[1]))
    assert any("solve(dict): KeyError" in text for text in judged(good, "solve", lambda _: {}[1]))


def test_what_the_driver_of_models_says_is_read():
    found = dict(models.read_lines("5\n! solve: a status that is not documented (3)\n= 0\n6\n= 11\n7\n"))
    assert found[5].wrong == ["solve: a status that is not documented (3)"]
    assert [found[seed].outcome for seed in (5, 6, 7)] == ["solved", "bad input", ""]


def test_wrong_ends_for_want_of_memory_are_seen(monkeypatch):
    def end(task):
        monkeypatch.setitem(memory.TASKS, "by_steps", task)
        monkeypatch.setattr(memory, "known", lambda *_: ({}, 1, 0))
        verdict = memory.judge(("by_steps", "gaps", 3, 1.0))
        return verdict.outcome, bool(verdict.wrong)

    refusals = iter([MemoryError, None])

    def once(_):
        if error := next(refusals):
            raise error
        return 1

    assert end(lambda _: 1) == ("result", False)
    assert end(once) == ("no memory", False)
    assert end(lambda _: 2) == ("wrong", True)
    assert end(lambda _: os._exit(1)) == ("aborted", True)
    assert end(lambda _: os.kill(os.getpid(), signal.SIGKILL)) == ("aborted", True)
    assert end(lambda _: {}[1]) == ("wrong", True)
    assert end(lambda _: os.write(1, b"x"))[1]


# The command


def hang_or_end(task):
    """Sleep, end, or answer."""
    if task == "sleep":
        time.sleep(60)
    if task == "end":
        os.kill(os.getpid(), signal.SIGKILL)
    return task


def test_processes_that_hang_or_end():
    answers = dict(judge_all(hang_or_end, ["a", "sleep", "end", "b"], 2, 1.0))
    assert answers == {"a": "a", "b": "b", "sleep": Ended("hang", "no answer within 1 s"), "end": answers["end"]}
    assert re.fullmatch(r"the process ended with signal \d+", answers["end"].how)


def test_no_case_begins_after_its_time():
    assert list(judge_all(hang_or_end, ["a"], 1, 1.0, until=0.0)) == []


def judge_odd(made, seed):
    """Finds fault with odd scenes, and fails on the fifth."""
    if seed == 5:
        raise KeyError("five")
    wrong = ["it is odd"] if made["loads"][0]["F"] % 2 else []
    return Verdict("solved", wrong, {"reaction": [1.0 + made["loads"][0]["F"]]})


ODD = Family("odd", "Nothing is odd", lambda seed: ("any", scene([1.0], [at(0)], [force(1.0, seed)])), judge_odd)


def test_command_writes_failures_and_its_page(tmp_path, capsys, monkeypatch):
    monkeypatch.setitem(command.FAMILIES, "odd", ODD)
    page, failures = tmp_path / "page.md", tmp_path / "failures"
    options = ["--family", "odd", "--count", "6", "--seed", "2", "--failures", str(failures), "--markdown", str(page)]
    assert command.main(options) == 1
    said = capsys.readouterr().out
    assert "odd: 6 cases" in said
    assert "wrong 3, of which hangs 0, aborts 0" in said
    assert "bound/error of reaction: median 5" in said
    assert sorted(path.name for path in failures.iterdir()) == ["odd-3.json", "odd-5.json", "odd-7.json"]
    assert gapbeam.read_scene(failures / "odd-3.json").title == "odd 3: it is odd"
    assert "KeyError" in gapbeam.read_scene(failures / "odd-5.json").title
    assert "| odd | 6 | 3 | 0 | 0 | Nothing is odd |" in page.read_text()
    assert command.main(["--scene", str(failures / "odd-3.json")]) == 1
    assert "it is odd" in capsys.readouterr().out
    assert command.main([*options[:2], "--count", "1", "--seed", "2"]) == 0
