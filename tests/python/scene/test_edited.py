"""Scenes as data and as TOML: what is written reads back the same."""

import json
import tomllib
from pathlib import Path

import gapbeam
import pytest

EXAMPLES = sorted((Path(__file__).resolve().parents[3] / "examples").rglob("*.toml"))


@pytest.mark.parametrize("path", EXAMPLES, ids=[path.stem for path in EXAMPLES])
def test_examples_read_back_the_same(path):
    scene = gapbeam.read_scene(path)
    text = scene.to_toml()
    again = gapbeam.read_scene(tomllib.loads(text))
    assert again == scene
    assert again.to_toml() == text
    assert gapbeam.read_scene(json.loads(json.dumps(scene.to_dict()))) == scene
    other = gapbeam.replace(scene, "title", "another")
    assert (other == scene, other.title) == (False, "another")
    assert gapbeam.replace(other, "title", scene.title) == scene


def test_there_are_examples():
    assert len(EXAMPLES) > 10
