"""The digests: they see the last bit and no words, and two processes give the same ones."""

import json

import numpy as np

from digests import command
from digests.collect import digests, is_for_all, numbers
from digests.drawn import FAMILIES, write_scenes

COUNT = 48


def test_the_last_bit_is_seen_and_words_are_not():
    one = {"x": [1.0, 2.0], "reason": "a", "n": np.arange(3.0)}
    assert digests(one) == digests({"n": np.arange(3.0), "x": [1.0, 2.0], "reason": "b", "seconds": 3.0})
    for key, value in (("x", [1.0, np.nextafter(2.0, 3.0)]), ("n", np.nextafter(np.arange(3.0), 9.0))):
        other = digests({**one, key: value})
        assert [kind for kind, digest in digests(one).items() if other[kind] != digest] == [key]
    assert digests(-0.0) != digests(0.0)


def test_numbers_are_sorted_by_the_keys_that_lead_to_them():
    steps = [{"factor": 1.0, "supports": [{"reaction": 2.0}, {"reaction": 3.0}]}]
    one = digests({"steps": steps})
    assert set(one) == {"steps#", "steps.factor", "steps.supports#", "steps.supports.reaction"}
    steps[0]["supports"].reverse()
    other = digests({"steps": steps})
    assert [kind for kind in one if one[kind] != other[kind]] == ["steps.supports.reaction"]


def test_numbers_may_be_compared_to_a_share_of_the_largest():
    one = numbers({"steps": [{"w": np.array([1e6, 1.0])}, {"w": np.array([2.0, 3.0]), "state": "closed"}]})
    assert one == {"steps#": [2], "steps.w": [[1e6, 1.0], [2.0, 3.0]], "steps.state": ["closed"]}
    near = {**one, "steps.w": [[1e6, 1.0], [2.0, 3.0 + 1e-9]]}
    assert all(command.alike(one[kind], near[kind], 1e-12) for kind in one)
    assert not command.alike(one["steps.w"], near["steps.w"], 0.0)
    for other in ([[1e6, 1.0], [2.0, 3.0 + 1e-5]], [[1e6, 1.0], [2.0]], [[1e6, 1.0]], [[1e6, 1.0], [2.0, float("nan")]]):
        assert not command.alike(one["steps.w"], other, 1e-12)
    assert not command.alike(["closed"], ["open"], 1.0)


def test_two_processes_give_the_same_digests(tmp_path, installed):
    scenes = tmp_path / "scenes"
    number = write_scenes(COUNT, scenes, ["examples"])  # faults are solved by tests of their own
    names = [json.loads(line)[0] for line in scenes.read_text().splitlines()]
    assert len(set(names)) == number >= COUNT
    assert {name.split()[0] for name in names} >= set(FAMILIES)
    both = []
    for which in ("here", "there"):
        lines = command.collect(scenes, number, command.Progress(which, "scenes"), installed.library)
        (tmp_path / which).write_bytes(b"".join(lines))
        both.append(command.read_digests(tmp_path / which))
    assert command.changed(*both) == ([], [])
    assert {name for name, *_ in both[0]} == set(names)
    found = [len({name for name, kind, _ in both[0] if kind == what}) for what in ("python", "cases", "C", "Fortran 77")]
    assert found[0] == number
    assert found[1] == -(-COUNT // len(FAMILIES))
    assert min(found[2:]) > COUNT // 3


def test_scenes_that_other_languages_cannot_hold():
    plain = {"beam": {"spans": [1.0], "EI": 1.0}}
    assert is_for_all(plain)
    assert not is_for_all({**plain, "trains": []})
    assert not is_for_all({**plain, "supports": [{"node": 0, "law": {"type": "cubic"}}]})


def test_what_has_changed_is_said(capsys):
    here = {("a", "C", "x"): "1", ("b", "C", "x"): "2"}
    assert command.said(here, dict(here), 2, "HEAD") == 0
    assert command.said(here, {**here, ("b", "C", "x"): "3"}, 2, "HEAD") == 1
    assert command.said({**here, ("b", "C", "y"): "4"}, here, 2, "HEAD") == 0
    assert command.said(here, {**here, ("b", "C", "z"): "4"}, 2, "HEAD") == 1
    assert command.said({}, {}, 0, "HEAD") == 1
    said = capsys.readouterr().out
    assert "changed: b (C): x" in said
    assert "changed: b (C): z" in said
    assert "new: y (C)" in said
    assert "C                 2 scenes        2 digests, 1 changed" in said
    assert "nothing has changed" in said
