"""The digests: they see the last bit and no words, and two processes give the same ones."""

import json

import numpy as np

from digests import command
from digests.collect import digest, is_for_all
from digests.drawn import FAMILIES, write_scenes

COUNT = 500


def test_the_last_bit_is_seen_and_words_are_not():
    one = {"x": [1.0, 2.0], "reason": "a", "n": np.arange(3.0)}
    assert digest(one) == digest({"n": np.arange(3.0), "x": [1.0, 2.0], "reason": "b", "seconds": 3.0})
    assert digest(one) != digest({**one, "x": [1.0, np.nextafter(2.0, 3.0)]})
    assert digest(one) != digest({**one, "n": np.nextafter(np.arange(3.0), 9.0)})
    assert digest(-0.0) != digest(0.0)


def test_two_processes_give_the_same_digests(tmp_path, installed):
    scenes = tmp_path / "scenes"
    number = write_scenes(COUNT, scenes)
    names = [json.loads(line)[0] for line in scenes.read_text().splitlines()]
    assert len(set(names)) == number >= COUNT
    assert {name.split()[0] for name in names} >= set(FAMILIES)
    both = [command.collect(scenes, installed.library, tmp_path / str(number)) for number in range(2)]
    here, there = (command.read_digests(*begun) for begun in both)
    assert not command.changed(here, there)
    assert {name for name, _ in here} == set(names)
    found = [sum(kind == what for _, kind in here) for what in ("python", "cases", "C", "Fortran 77")]
    assert found[0] == number
    assert found[1] == COUNT // len(FAMILIES)
    assert min(found[2:]) > COUNT // 3


def test_scenes_that_other_languages_cannot_hold():
    plain = {"beam": {"spans": [1.0], "EI": 1.0}}
    assert is_for_all(plain)
    assert not is_for_all({**plain, "trains": []})
    assert not is_for_all({**plain, "supports": [{"node": 0, "law": {"type": "cubic"}}]})


def test_what_has_changed_is_said(capsys):
    here = {("a", "C"): "1", ("b", "C"): "2"}
    assert command.said(here, dict(here), 2, "HEAD") == 0
    assert command.said(here, {**here, ("b", "C"): "3"}, 2, "HEAD") == 1
    assert command.said({}, {}, 0, "HEAD") == 1
    said = capsys.readouterr().out
    assert "changed: b (C)" in said
    assert "C                 2 digests, 1 changed" in said
    assert "nothing has changed" in said
