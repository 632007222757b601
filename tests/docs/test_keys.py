"""The reference of every key is what the schemas say, and has an example of every key that is read."""

import math
import tomllib
from pathlib import Path
from runpy import run_path

import gapbeam
import pytest

KEYS = run_path(str(Path(__file__).resolve().parents[2] / "docs" / "keys.py"))
DEFS = gapbeam.scene_schema()["$defs"]
BASE = {"beam": {"spans": [6.0, 6.0], "EI": 1e4}, "supports": [{"node": 0}, {"node": 1}, {"node": 2}]}
NUMBERS_WITHOUT_UNIT = {"node", "steps"}


def is_number(entry):
    text = str({key: value for key, value in entry.items() if key not in ("description", "default")})
    return "'number'" in text


@pytest.mark.parametrize("name", KEYS["PAGES"])
def test_pages_are_made_of_the_schemas(name):
    assert (KEYS["REFERENCE"] / name).read_text(encoding="utf-8") == KEYS["PAGES"][name](), "run python docs/keys.py"


def test_a_default_is_left_out_of_the_meaning_whole():
    (row,) = (line for line in KEYS["table_of"]("Analysis", DEFS["Analysis"]) if line.startswith("| `history`"))
    assert row == "| `history` | list of number | no unit | `[1.0]` | Load factors gone through in turn, from event to event. |"


def test_every_table_is_there():
    assert set(KEYS["SCENE"]) == set(DEFS)


@pytest.mark.parametrize("table", DEFS)
def test_every_key_is_described_with_its_unit(table):
    assert len(DEFS[table]["description"]) > 10
    for key, entry in DEFS[table]["properties"].items():
        assert len(entry.get("description", "")) > 10, f"{table}.{key} has no description: write it into the docstring"
        if is_number(entry) and key not in NUMBERS_WITHOUT_UNIT:
            unit, meaning = KEYS["meaning_of"](entry["description"])
            assert unit != KEYS["NONE"], f"{table}.{key} has no unit: write (force/length) or (no unit) into the docstring"
            assert meaning[:1].isupper()
            assert meaning.endswith(".")


@pytest.mark.parametrize(("table", "key"), [("ForceLoad", "F"), ("MomentLoad", "M"), ("UniformLoad", "q"), ("LinearLoad", "q"),
                                            ("CurvatureLoad", "kappa"), ("AxialLoad", "F"), ("AxialUniformLoad", "q"),
                                            ("Support", "settlement"), ("Train", "axles"),
                                            ("Combination", "settlements")])  # fmt: skip
def test_signs_are_told(table, key):
    assert "positive" in DEFS[table]["properties"][key]["description"]


@pytest.mark.parametrize("table", DEFS)
def test_examples_have_every_key_and_are_read(table):
    used = set()
    for example in KEYS["SCENE"][table]["examples"]:
        data = tomllib.loads(example)
        gapbeam.read_scene(({"beam": BASE["beam"]} if {"supports", "foundation"} & data.keys() else BASE) | data)
        used |= keys_in(data)
    elsewhere = {"sections", "hinges", "foundation", "trains", "combinations", "analysis", "limits"} if table == "Scene" else set()
    assert set(DEFS[table]["properties"]) - used <= elsewhere


def keys_in(data):
    """All keys, at any depth."""
    if isinstance(data, dict):
        return set(data).union(*map(keys_in, data.values()))
    return set().union(*map(keys_in, data)) if isinstance(data, list) else set()


def test_defaults_are_those_of_the_program():
    """What the page calls the default makes the same scene as leaving the key out."""
    support = DEFS["Support"]
    for key in ("side", "stiffness", "gap", "settlement", "rotation", "direction", "unloading"):
        shown = KEYS["default_of"](support["properties"][key], key, support).strip("`")
        value = tomllib.loads(f"value = {shown}")["value"]
        assert getattr(gapbeam.Support(node=0), key) == value
    assert math.isinf(gapbeam.Beam(spans=[1.0], EI=1.0).GA)
