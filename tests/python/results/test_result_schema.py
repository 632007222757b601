"""The JSON Schema of results: it is one, it describes every key, and every example's output follows it."""

import json
import sys
from pathlib import Path

import gapbeam
import pytest
from gapbeam.cli import main
from gapbeam.report import to_json
from jsonschema import Draft202012Validator

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"
SCENES = sorted(EXAMPLES.rglob("*.toml"))
SCHEMA = gapbeam.result_schema()
VALIDATOR = Draft202012Validator(SCHEMA)
MECHANISM = {"beam": {"spans": [4.0], "EI": 1e4}, "supports": [{"node": 0}], "loads": [{"type": "force", "x": 3.0, "F": 5.0}]}
PULLED = {**MECHANISM, "supports": [{"node": 0, "direction": "axial"}, {"node": 0}, {"node": 1}],
          "loads": [{"type": "axial", "x": 4.0, "F": -2.0}]}  # fmt: skip
LIMITED = {
    **MECHANISM,
    "supports": [{"node": 0, "side": "below"}, {"node": 1, "side": "below"}],
    "foundation": [{"k": 10.0, "side": "below", "name": "sand"}],
    "loads": [{"type": "force", "x": 1.0, "F": 5.0, "case": "a"}, {"type": "force", "x": 1.0, "F": -9.0, "case": "b"}],
    "combinations": [{"name": "one", "factors": {"a": 1.0}}, {"name": "no", "factors": {"b": 1.0}}],
    "limits": {"moment": 1.0, "reaction": 2.0},
    "analysis": {"follow": "events"},
}

SEESAW = {
    "beam": {"spans": [4.0, 4.0], "EI": 1e4},
    "supports": [{"node": 1, "side": "below"}, {"node": 2, "side": "below"}],
    "loads": [{"type": "uniform", "q": 1.0, "case": "dead"}],
    "trains": [{"axles": [[0.0, 30.0]]}],
}
FREE = {"beam": {"spans": [4.0], "EI": 1e4},
        "supports": [{"x": 2.0, "side": "below"}], "loads": [{"type": "force", "x": 2.0, "F": 1.0}]}
RIGID = {
    "beam": {"spans": [1.0, 1.0], "EI": float("inf")},
    "supports": [{"node": 0}, {"node": 1}, {"node": 2}],
    "loads": [{"type": "uniform", "q": 1.0, "case": "dead"}],
    "combinations": [{"name": "weight", "factors": {"dead": 1.0}}],
}
OTHERS = {"unstable": MECHANISM, "axial": PULLED, "limits": LIMITED, "tipping under a train": SEESAW, "free to move": FREE,
          "without a unique answer": RIGID}  # fmt: skip


def check(result):
    data = json.loads(to_json(result, 3))
    assert data["schema"] == SCHEMA["title"] == "gapbeam-result 1"
    assert [f"{error.json_path}: {error.message[:300]}" for error in VALIDATOR.iter_errors(data)] == []


def test_it_is_a_schema():
    Draft202012Validator.check_schema(SCHEMA)


def test_every_key_is_described_and_used():
    for name, table in SCHEMA["$defs"].items():
        assert table["description"].endswith("."), name
        for key, entry in table["properties"].items():
            assert len(entry["description"]) > 5, f"{name}.{key}"
            assert entry["description"].endswith((".", "or")), f"{name}.{key}"
    text = json.dumps(SCHEMA)
    assert [name for name in SCHEMA["$defs"] if f'"#/$defs/{name}"' not in text] == []


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_examples_follow_it(path):
    check(gapbeam.solve(path))


@pytest.mark.parametrize("scene", OTHERS.values(), ids=OTHERS)
def test_other_outcomes_follow_it(scene):
    check(gapbeam.solve(scene))


def test_it_refuses_what_is_not_described():
    data = json.loads(to_json(gapbeam.solve(EXAMPLES / "three_spans.toml"), 3))
    data["steps"][0]["supports"][0]["reactions"] = data["steps"][0]["supports"][0].pop("reaction")
    assert len(list(VALIDATOR.iter_errors(data))) == 2


def test_the_command_prints_it(capsys, monkeypatch):
    monkeypatch.setattr(sys, "argv", ["gapbeam"])
    assert main(["schema", "--results"]) == 0
    assert json.loads(capsys.readouterr().out) == SCHEMA
