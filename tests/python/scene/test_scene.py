"""Scenes that are right: from TOML, JSON and Python, and the JSON Schema."""

import contextlib
import json
import math
import pickle
import time
import tomllib
from fractions import Fraction
from types import MappingProxyType

import msgspec
import numpy as np
import pytest
from gapbeam.base.errors import SceneError
from gapbeam.scene import (
    Analysis,
    AxialLoad,
    Beam,
    CurvatureLoad,
    ForceLoad,
    LinearLoad,
    MomentLoad,
    Scene,
    Section,
    Support,
    UniformLoad,
    Units,
    read_scene,
    same_place,
    scene_schema,
)
from hypothesis import given, settings
from hypothesis import strategies as st

inf = math.inf

TEXT = """
title = "Three spans on bearings that can lift off"

[units]
force = "kN"
length = "m"

[beam]
spans = [6.0, 6.0, 6.0]
EI = 1.0e4
GA = inf
EA = inf
hinges = []

[[sections]]
from = 2.0
to = 4.0
EI = 2.0e4

[[supports]]
node = 0
side = "both"
stiffness = inf
gap = 0.0
settlement = 0.0
rotation = "free"

[[supports]]
x = 6.0
side = "below"
gap = -0.01

[[supports]]
node = 0
direction = "axial"

[[loads]]
type = "force"
x = 3.0
F = 25.0
case = "live"

[[loads]]
type = "moment"
node = 3
M = -2

[[loads]]
type = "uniform"
q = 5
case = "dead"

[[loads]]
type = "linear"
from = 1.5
q = [0, 2.5]

[[loads]]
type = "curvature"
to = 6.0
kappa = 1e-3

[[loads]]
type = "axial"
x = 6.0
F = 1.0

[analysis]
steps = 10
follow = "steps"
rule = "single"
"""

SCENE = Scene(
    title="Three spans on bearings that can lift off",
    units=Units(force="kN", length="m"),
    beam=Beam([6.0, 6.0, 6.0], EI=1.0e4),
    sections=[Section(from_=2.0, to=4.0, EI=2.0e4)],
    supports=[
        Support(node=0),
        Support(x=6.0, side="below", gap=-0.01),
        Support(node=0, direction="axial"),
    ],
    loads=[
        ForceLoad(x=3.0, F=25.0),
        MomentLoad(node=3, M=-2.0),
        UniformLoad(q=5.0, case="dead"),
        LinearLoad(from_=1.5, q=(0.0, 2.5)),
        CurvatureLoad(to=6.0, kappa=1e-3),
        AxialLoad(x=6.0, F=1.0),
    ],
    analysis=Analysis(steps=10, rule="single"),
)


def test_toml(tmp_path):
    path = tmp_path / "scene.TOML"
    path.write_text(TEXT)
    assert read_scene(path) == SCENE
    assert read_scene(str(path)) == SCENE
    path.write_bytes(b"\xef\xbb\xbf" + TEXT.replace("\n", "\r\n").encode())
    assert read_scene(path) == SCENE


def test_json(tmp_path):
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(msgspec.to_builtins(SCENE)))
    assert "Infinity" in path.read_text()
    assert read_scene(path) == SCENE
    path.write_text(path.read_text().replace("Infinity", "1e999"))
    assert read_scene(path) == SCENE


def test_mapping():
    data = msgspec.to_builtins(SCENE)
    assert read_scene(data) == SCENE
    assert read_scene(MappingProxyType(data | {"beam": MappingProxyType(data["beam"])})) == SCENE
    assert read_scene(data | {"supports": tuple(SCENE.supports), "beam": SCENE.beam}) == SCENE


def test_python_scene_is_copied_and_made_uniform():
    scene = Scene(
        beam=Beam(np.full(2, 6), EI=10_000, GA=np.float32(0.5), hinges=(np.float64(3.0),)),
        supports=(Support(node=np.int64(0), rotation=3), Support(x=Fraction(1, 2), stiffness=2**70)),
        loads=[LinearLoad(q=np.array([1, 2])), UniformLoad(q=3)],
    )
    read = read_scene(scene)
    assert read.beam == Beam([6.0, 6.0], EI=1e4, GA=0.5, hinges=[3.0])
    assert read.supports == [Support(node=0, rotation=3.0), Support(x=0.5, stiffness=2.0**70)]
    assert read.loads == [LinearLoad(q=(1.0, 2.0)), UniformLoad(q=3.0)]
    kinds = [
        type(value) for value in (read.beam.EI, read.loads[1].q, *read.beam.spans, read.supports[0].rotation)
    ]
    assert set(kinds) == {float}
    assert read_scene(read) == read
    read.supports[0].x = 99.0
    read.beam.spans.append(1.0)
    assert (scene.supports[0].x, len(scene.beam.spans)) == (None, 2)


def test_defaults():
    scene = read_scene(
        {"beam": {"spans": [1], "EI": inf}, "supports": [{"node": 0}], "sections": [{"GA": 3}]}
    )
    assert (scene.title, scene.units, scene.loads, scene.foundation) == ("", Units(), [], [])
    assert (scene.beam.GA, scene.beam.EA, scene.beam.hinges) == (inf, inf, [])
    assert scene.analysis == Analysis(steps=1, follow="steps", rule="block")
    support = Support(
        node=0,
        x=None,
        side="both",
        stiffness=inf,
        gap=0.0,
        settlement=0.0,
        rotation="free",
        direction="normal",
        law=None,
        unloading="elastic",
    )
    assert scene.supports == [support]
    assert scene.sections == [Section(from_=0.0, to=None, EI=None, GA=3.0, EA=None)]
    assert UniformLoad(q=1.0) == UniformLoad(from_=0.0, to=None, q=1.0, case="live")
    assert read_scene(Scene(beam=Beam([1.0], EI=1.0))).supports == []


@pytest.mark.parametrize(
    "parts",
    [
        {"supports": [{"x": 6, "side": "below", "gap": 0.1}, {"x": 6, "side": "above", "gap": 0.1}]},
        {"supports": [{"x": 6, "side": "below"}, {"x": 6, "side": "above"}]},
        {
            "supports": [
                {"x": 6, "side": "below", "settlement": 0.3},
                {"x": 6, "side": "above", "settlement": 0.1 + 0.2},
            ]
        },
        {"supports": [{"x": 6}, {"x": 6, "stiffness": 5}, {"x": 6, "side": "below", "gap": 0.1}]},
        {"supports": [{"x": 6}, {"x": 6, "direction": "axial"}, {"x": 6.001}]},
        {"supports": [{"x": 6, "stiffness": 3}, {"x": 6, "stiffness": 3}, {"x": 6, "stiffness": 0}]},
        {
            "supports": [
                {"x": 6, "rotation": 3},
                {"x": 6, "stiffness": 3, "rotation": "fixed"},
                {"x": 3, "rotation": inf},
            ]
        },
        {
            "supports": [{"x": -1e-16}, {"x": 18.000000000000004}],
            "loads": [{"type": "force", "x": 18.000000000000004, "F": 1}],
        },
        {"loads": [{"type": "uniform", "q": 1, "from": -1e-16, "to": 18.000000000000004}]},
        {
            "beam": {"spans": [6, 6], "EI": [1, inf], "GA": [inf, 1], "hinges": [9, 3]},
            "loads": [{"type": "moment", "x": 6, "M": 1}, {"type": "force", "x": 3, "F": 1}],
            "supports": [{"x": 3}, {"x": 6, "rotation": "fixed"}],
        },
    ],
)
def test_accepted(parts):
    read_scene({"beam": {"spans": [6, 6, 6], "EI": 1}} | parts)


def test_span_ends_and_positions():
    scene = read_scene(
        {"beam": {"spans": [0.1] * 1000, "EI": 1}, "supports": [{"node": 7}, {"x": -1e-17}, {"x": 30.0}]}
    )
    exact = [float(Fraction(0.1) * i) for i in range(1001)]
    assert scene.span_ends().tolist() == exact
    assert scene.positions(scene.supports).tolist() == [exact[7], 0.0, 30.0]
    assert scene.positions([]).shape == (0,)


@given(st.lists(st.floats(1e-3, 1e3), min_size=1, max_size=300))
def test_span_ends_are_exact(spans):
    ends, total = Scene(beam=Beam(spans, EI=1.0)).span_ends(), Fraction(0)
    assert ends[0] == 0.0
    for end, span in zip(ends[1:], spans, strict=True):
        total += Fraction(span)
        assert abs(Fraction(float(end)) - total) <= Fraction(math.ulp(float(total)))


def test_same_place():
    assert same_place(6.0, 6.0 * (1 + 63 * 2.0**-52))
    assert not same_place(6.0, 6.0 * (1 + 66 * 2.0**-52))
    assert same_place(0.0, 0.0)
    assert not same_place(0.0, 1e-300)
    assert same_place(np.array([1.0, 2.0]), 1.0).tolist() == [True, False]


def test_pickle():
    assert pickle.loads(pickle.dumps(SCENE)) == SCENE


@settings(max_examples=60)
@given(
    st.recursive(
        st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
        lambda inner: (
            st.lists(inner, max_size=3)
            | st.dictionaries(
                st.sampled_from(["beam", "spans", "EI", "supports", "loads", "x", "type", "q", "law"]),
                inner,
                max_size=3,
            )
        ),
        max_leaves=8,
    )
)
def test_any_data_is_read_or_refused(data):
    base = {"beam": {"spans": [1.0], "EI": 1.0}}
    for source in (
        {"beam": data},
        base | {"supports": data},
        base | {"loads": [data]},
        base | {"title": data},
    ):
        with contextlib.suppress(SceneError):
            read_scene(source)


def test_large_scene_is_checked_quickly():
    spans = 20_000
    data = {
        "beam": {"spans": [6.0] * spans, "EI": 1e4},
        "sections": [{"from": 1.5 * i, "to": 1.5 * i + 1, "EI": 2e4} for i in range(4 * spans)],
        "supports": [{"node": i, "side": "below", "gap": 0.002 * (i % 3)} for i in range(spans)],
    }
    best = inf
    for _ in range(3):
        start = time.perf_counter()
        read_scene(data)
        best = min(best, time.perf_counter() - start)
    assert best < 0.5  # a tenth of it measured; the room is for slow machines


# The JSON Schema


def valid(value, schema, root):
    """Whether a value fits: the part of JSON Schema that `scene_schema` makes use of."""
    if "$ref" in schema and not valid(value, root["$defs"][schema["$ref"].rpartition("/")[2]], root):
        return False
    if "anyOf" in schema and not any(valid(value, member, root) for member in schema["anyOf"]):
        return False
    if "enum" in schema and value not in schema["enum"]:
        return False
    kinds = {
        "object": dict,
        "array": list,
        "string": str,
        "number": (int, float),
        "integer": int,
        "null": type(None),
    }
    if "type" in schema and not isinstance(value, kinds[schema["type"]]):
        return False
    if isinstance(value, int | float):
        return value >= schema.get("minimum", -inf) and value > schema.get("exclusiveMinimum", -inf)
    if isinstance(value, list):
        members = schema.get("prefixItems") or [schema.get("items", {})] * len(value)
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", inf):
            return False
        return all(valid(item, member, root) for item, member in zip(value, members, strict=True))
    if isinstance(value, dict) and "properties" in schema:
        known = schema["properties"]
        if not value.keys() <= known.keys() or not set(schema["required"]) <= value.keys():
            return False
        return all(valid(item, known[key], root) for key, item in value.items())
    return True


def test_schema_fits_the_example():
    schema = scene_schema()
    data = tomllib.loads(TEXT)
    assert valid(data, schema, schema)
    assert valid({"beam": {"spans": [1.0], "EI": inf}}, schema, schema)
    for wrong in (
        {"suports": []},
        {"beam": {"spans": []}},
        {"loads": [{"type": "force"}]},
        {"analysis": {"steps": 0}},
        {"supports": [{"side": "up"}]},
        {"supports": [{"stiffness": -1.0}]},
        {"supports": [{"node": -1}]},
        {"sections": [{"EI": 0.0}]},
        {"loads": [{"type": "linear", "q": [1.0]}]},
        {"title": 3},
    ):
        assert not valid(data | wrong, schema, schema), wrong


def test_schema_is_json_and_describes_every_key():
    schema = scene_schema()
    assert json.loads(json.dumps(schema, allow_nan=False)) == schema
    assert len(schema["$defs"]) == 38
    for name, table in schema["$defs"].items():
        assert table["description"], name
        assert "Parameters" not in table["description"]
        for key, entry in table["properties"].items():
            assert key == "type" or entry.get("description"), (name, key)
    support = schema["$defs"]["Support"]["properties"]
    assert support["settlement"]["description"].startswith(
        "Movement of the support itself (length), positive downward"
    )
    assert support["law"]["description"].startswith("Instead of stiffness: points")
