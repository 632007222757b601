"""Supports, loads and sections as columns: the same results as from lists of tables, the same refusals."""

import pickle
import random
import sys
from contextlib import suppress

import gapbeam
import numpy as np
import pytest
from gapbeam.base.errors import SceneError
from gapbeam.scene.tables import Table

SPANS = 40
NODES = np.arange(SPANS + 1)
INNER = (NODES > 0) & (NODES < SPANS)
SIDE = np.where(INNER, "below", "both")
STIFFNESS = np.where(INNER, 1e5, np.inf)
GAP = np.where(INNER, 0.002 * (NODES % 3), 0.0)
Q = np.linspace(-3.0, 9.0, SPANS)
BEAM = {"spans": [6.0] * SPANS, "EI": 1e4}


def lists():
    """The scene as a user writes it in a file."""
    supports = [
        {"node": int(i), "side": str(s), "stiffness": float(k), "gap": float(g)}
        for i, s, k, g in zip(NODES, SIDE, STIFFNESS, GAP, strict=True)
    ]
    loads = [{"type": "uniform", "q": float(q), "from": 6.0 * i, "to": 6.0 * i + 6.0} for i, q in enumerate(Q)]
    sections = [{"from": 6.0 * i, "to": 6.0 * i + 3.0, "EI": 2e4} for i in range(SPANS)]
    return {"beam": BEAM, "supports": supports, "loads": loads, "sections": sections}


def columns(**changes):
    """The same as columns."""
    starts = 6.0 * np.arange(SPANS)
    return {
        "beam": {"spans": np.full(SPANS, 6.0), "EI": 1e4},
        "supports": {"node": NODES.copy(), "side": SIDE.copy(), "stiffness": STIFFNESS.copy(), "gap": GAP.copy()},
        "loads": {"type": "uniform", "q": Q.copy(), "from": starts, "to": starts + 6.0},
        "sections": {"from": starts, "to": starts + 3.0, "EI": 2e4},
    } | changes


def same(made):
    """Whether a scene has the digits of the lists."""
    one, other = gapbeam.solve(lists()), gapbeam.solve(made)
    x = np.linspace(0.0, 6.0 * SPANS, 97)
    return one.steps[-1].solution == other.steps[-1].solution and one.at(x) == other.at(x) and one.scene == other.scene


class Frame:
    """What is used of a pandas DataFrame."""

    class Series:
        def __init__(self, values):
            self.values = values

        def to_numpy(self):
            return self.values

    def __init__(self, data):
        self.data = data
        self.columns = list(data)

    def to_numpy(self):
        raise AssertionError

    def __getitem__(self, name):
        return self.Series(np.asarray(self.data[name]))


def structured(data):
    """A structured array."""
    data = {name: np.asarray(value) for name, value in data.items()}
    made = np.empty(len(next(iter(data.values()))), dtype=[(name, value.dtype) for name, value in data.items()])
    for name, value in data.items():
        made[name] = value
    return made


@pytest.mark.parametrize("kind", [dict, Frame, structured])
def test_the_same_as_lists(kind):
    assert same(columns(supports=kind(columns()["supports"])))


def test_in_a_scene_built_in_python():
    made = columns()
    beam = gapbeam.Beam(spans=made["beam"]["spans"], EI=1e4)
    assert same(gapbeam.Scene(beam=beam, **{key: made[key] for key in ("supports", "loads", "sections")}))


def test_lists_for_arrays_and_single_values_for_all():
    made = columns()
    supports = {name: value.tolist() for name, value in made["supports"].items()} | {"settlement": 0.0, "direction": "normal"}
    assert same(columns(supports=supports))


def test_rows_are_made_when_they_are_looked_at():
    scene = gapbeam.read_scene(columns())
    assert isinstance(scene.supports, Table)
    assert len(scene.supports) == SPANS + 1
    assert scene.supports[3] == gapbeam.Support(node=3, side="below", stiffness=1e5, gap=0.0)
    assert scene.supports[-1].stiffness == np.inf
    assert [load.q for load in scene.loads[:2]] == Q[:2].tolist()
    assert scene == gapbeam.read_scene(lists())
    assert pickle.loads(pickle.dumps(scene)) == scene


def test_the_arrays_of_the_caller_stay_his_own():
    made = columns()
    scene = gapbeam.read_scene(made)
    for part in ("supports", "loads", "sections"):
        for value in made[part].values():
            if isinstance(value, np.ndarray):
                value[0] = value[-1]
    assert scene == gapbeam.read_scene(lists())


def test_loads_of_every_kind():
    x = np.array([1.0, 7.5])
    kinds = [
        ({"type": "force", "x": x, "F": [2.0, 3.0]}, ["F"]),
        ({"type": "moment", "x": x, "M": [2.0, 3.0], "case": "dead"}, ["M"]),
        ({"type": "linear", "q": [[1.0, 2.0], [3.0, -1.0]], "to": x}, ["q"]),
        ({"type": "curvature", "kappa": [1e-4, 2e-4], "from": x}, ["kappa"]),
        ({"type": "force", "node": [1, 2], "F": 4.0}, []),
    ]
    for loads, values in kinds:
        rows = [
            {name: (value[k] if isinstance(value, list | np.ndarray) else value) for name, value in loads.items()} for k in (0, 1)
        ]
        found, expected = (gapbeam.solve({**lists(), "loads": made}) for made in (loads, rows))
        assert found.steps[-1].solution == expected.steps[-1].solution, loads
        assert isinstance(found.scene.loads, Table), values


def test_loads_of_several_kinds():
    loads = {"type": ["force", "force"], "x": [1.0, 2.0], "F": [2.0, 3.0]}
    assert gapbeam.solve({**lists(), "loads": loads}).scene.loads[1] == gapbeam.ForceLoad(x=2.0, F=3.0)


REFUSED = [
    ({"supports": {"node": [0, 1, 2], "gap": [0.0, 0.1]}}, "supports: its columns are of unequal length: node has 3 and gap has 2"),
    ({"supports": {"node": [0, 99]}}, "supports[1].node: there is no node 99; the nodes of the beam are 0 to 40"),
    ({"supports": {"x": [0.0, np.nan]}}, "supports[1].x: expected a number, got nan"),
    ({"supports": {"node": [0, 1], "side": ["both", "under"]}}, 'supports[1].side: expected "above", "below", "both", "left" or'),
    ({"supports": {"nodes": [0, 1]}}, 'supports[0].nodes: unknown key; did you mean "node"?'),
    ({"supports": {"node": [0.5, 1.0]}}, "supports[0].node: expected a whole number, got 0.5"),
    ({"supports": {"node": [0, 1], "x": [0.0, 6.0]}}, "supports[0]: has both node = 0 and x = 0; give one of the two"),
    ({"supports": {"node": [0, 1], "name": [101, 102]}}, "supports[0].name: expected a text in quotes, got 101"),
    ({"loads": {"type": "uniform", "q": [1.0, 2.0], "case": [1, 2]}}, "loads[0].case: expected a text in quotes, got 1"),
    ({"supports": {"node": 0}}, "supports: expected a list of tables, got a table; write each as [[supports]]"),
    ({"supports": {"node": [0, 1], "gap": [0.0, 0.1]}}, 'supports[1].gap: only a support with side = "below" or "above" has a gap'),
    ({"supports": {"node": [0, 1], "stiffness": [1.0, -2.0]}}, "supports[1].stiffness: expected a number, 0 or more"),
    ({"loads": {"type": "uniform", "too": [1.0], "q": 2.0}}, 'loads[0].too: unknown key; did you mean "to"?'),
    ({"loads": {"type": "uniform", "from": [1.0]}}, "loads[0].q: this key is missing; give a number"),
    ({"loads": {"type": "snow", "q": [1.0]}}, 'loads[0].type: expected "force", "moment", "uniform"'),
    ({"loads": {"type": "force", "x": [1.0], "F": ["a"]}}, 'loads[0].F: expected a number, got "a"'),
    ({"sections": {"from": [0.0, 9.0], "to": [3.0, 8.0], "EI": 2.0}}, "sections[1]: the stretch from = 9 to = 8 has no length"),
    ({"foundation": {"k": [1.0, -2.0]}}, "foundation[1].k: expected a finite number, 0 or more, got -2.0"),
    ({"foundation": {"from": [1.0, 2.0]}}, "foundation[0].k: this key is missing; give a number"),
    ({"supports": {"node": np.ma.array([0, 1], mask=[False, True])}}, "supports[1].node: expected a whole number"),
]


@pytest.mark.parametrize(("parts", "expected"), REFUSED, ids=[expected for _, expected in REFUSED])
def test_refused(parts, expected):
    with pytest.raises(SceneError) as caught:
        gapbeam.read_scene({**lists(), **parts})
    assert str(caught.value).startswith(expected)


def test_no_object_a_support():
    """Reading columns makes arrays only, however many rows there are."""
    few, many = columns(), 20_000
    made = {
        "beam": {"spans": np.full(many, 6.0), "EI": 1e4},
        "supports": {"node": np.arange(many + 1), "side": "below"},
        "loads": {"type": "uniform", "q": np.ones(many), "from": 6.0 * np.arange(many), "to": 6.0 * np.arange(many) + 6.0},
    }
    gapbeam.read_scene(few)
    before = sys.getallocatedblocks()
    scene = gapbeam.read_scene(made)
    assert sys.getallocatedblocks() - before < 2 * many  # the spans are a list of floats, as in every scene
    assert len(scene.supports) == many + 1


ODD = [
    np.array([0, 1, 2]), np.array(["both", "below", "above"]), np.array([True, False, True]), np.array([1 + 2j, 1, 2]),
    np.array([None, 1, 2], dtype=object), np.array([["a"], ["b"], ["c"]]), np.array([np.nan, 1, 2]), np.array([2**63 - 1, 1, 2]),
    np.array([-5, 1, 2]), np.array([], dtype=float), np.array([1, 2]), np.zeros((3, 2)), np.zeros((3, 3)), np.float16([1, 2, 3]),
    np.longdouble([1, 2, 3]), np.ma.array([1, 2, 3], mask=[0, 1, 0]), [0.0, 3.0, 6.0], ["free", "fixed", 3.0], [None] * 3,
    (0, 1, 2), "both", None, 1, -1, 1.5, float("inf"), np.array(5), np.array(["2020"], dtype="M8"), ["a\ud800", "b", "c"], b"x",
    {}, [], [[1], [2], [3]], [[1], [2, 3], 4], 2**70, [10**400, 1, 1],
]  # fmt: skip
KEYS = {
    "supports": ("node", "x", "side", "stiffness", "gap", "settlement", "rotation", "direction", "law", "other"),
    "loads": ("q", "F", "M", "kappa", "x", "node", "from", "to", "case", "other"),
    "sections": ("from", "to", "EI", "GA", "EA", "other"),
    "foundation": ("from", "to", "k", "side", "gap", "profile", "law", "other"),
}
TYPES = ["uniform", "force", "moment", "linear", "curvature", "axial", ["uniform"] * 3, np.array(["force", "axial", "force"]), 5]


@pytest.mark.parametrize("block", range(4))
def test_odd_columns(block):
    """Whatever stands in columns: a result, or a refusal in words."""
    for seed in range(500 * block, 500 * block + 500):
        rng = random.Random(seed)
        made = {"beam": {"spans": [3.0, 3.0], "EI": 1e4}, "supports": [{"node": 0}, {"node": 2}]}
        for key in rng.sample(list(KEYS), rng.randint(1, 2)):
            made[key] = {name: rng.choice(ODD) for name in rng.sample(KEYS[key], rng.randint(1, 3))}
            if key == "loads":
                made[key]["type"] = rng.choice(TYPES)
        with suppress(SceneError, gapbeam.EngineError):
            result = gapbeam.solve(made)
            assert list(result.scene.supports) == [result.scene.supports[k] for k in range(len(result.scene.supports))], seed


def test_words_beside_numbers():
    supports = {"node": [0, 1, 2], "rotation": ["free", 5.0, "fixed"]}
    rows = [{"node": 0}, {"node": 1, "rotation": 5.0}, {"node": 2, "rotation": "fixed"}]
    found, expected = (gapbeam.solve({**lists(), "supports": made}) for made in (supports, rows))
    assert found.steps[-1].solution == expected.steps[-1].solution
