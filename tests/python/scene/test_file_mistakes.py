"""Mistakes of a scene file: all at once, each with its line."""

import copy
import json
import pickle
import tomllib
from pathlib import Path

import gapbeam
import pytest
from gapbeam.cli import main
from gapbeam.scene.lines import lines_of_keys

EXAMPLES = sorted((Path(__file__).resolve().parents[3] / "examples").glob("*.toml"))

BAD = """\
title = "bad"   # [supports]
[beam]
spans = [6.0, 6.0]
EI = "1e4"
[[supports]]
node = 0
sid = "below"
[[supports]]
node = 1
side = "down"
gap = "0,02"
[[supports]]
node = 7
name = "C"
[[loads]]
type = "uniform"
w = 3
[[loads]]
type = "force"
x = 30.0
F = 2
case = "wind"
[[combinations]]
name = "ULS"
factors = { wind = 1.35, snow = 1.5 }
settlements = { D = 0.01 }
[analysis]
step = 3
history = [1.0,
  inf]
[limits]
pressure = 3
"""
FOUND = [
    (4, "beam.EI"), (7, "supports[0].sid"), (10, "supports[1].side"), (11, "supports[1].gap"), (13, 'supports "C".node'),
    (17, "loads[0].w"), (20, "loads[1].x"), (25, 'combinations "ULS".factors.snow'), (26, 'combinations "ULS".settlements.D'),
    (28, "analysis.step"), (30, "analysis.history[1]"), (32, "limits.pressure"),
]  # fmt: skip


def paths(data, at=()):
    """Paths of all keys and entries."""
    yield at
    for key, one in data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ():
        yield from paths(one, (*at, key))


def test_all_mistakes_are_told_in_the_order_of_their_lines(tmp_path, capsys):
    path = tmp_path / "bad.toml"
    path.write_text(BAD)
    for read in (gapbeam.read_scene, gapbeam.solve):
        with pytest.raises(gapbeam.SceneError) as caught:
            read(path)
        assert [(line, place) for line, place, _ in caught.value.mistakes] == FOUND
        assert (caught.value.place, caught.value.problem[:17]) == ("beam.EI", "expected a number")
    lines = str(caught.value).splitlines()
    assert lines[1] == f'{path}:7: supports[0].sid: unknown key; did you mean "side"?'
    assert str(pickle.loads(pickle.dumps(caught.value))) == str(caught.value)
    assert main(["run", str(path)]) == 2
    assert capsys.readouterr().err.splitlines() == [f"gapbeam: error: {line}" for line in lines]


def test_a_side_that_is_none_says_nothing_of_the_gap(tmp_path):
    path = tmp_path / "side.toml"
    path.write_text('beam = { spans = [6.0], EI = 1.0 }\nsupports = [{ node = 0 }, { node = 1, side = "under", gap = 0.1 }]\n')
    with pytest.raises(gapbeam.SceneError) as caught:
        gapbeam.read_scene(path)
    assert [place for _, place, _ in caught.value.mistakes] == ["supports[1].side"]


@pytest.mark.parametrize(
    ("given", "place"),
    [
        ('trains = [{ name = "t", together = [["u", 0.0]] }]', "trains[0].together[0][0]"),
        ("analysis = { history = [1.0, 0.0] }", "analysis.history"),
    ],
)
def test_one_mistake_is_told_once_with_its_line(tmp_path, given, place):
    path = tmp_path / "one.toml"
    path.write_text(f"beam = {{ spans = [6.0], EI = 1.0 }}\nsupports = [{{ node = 0 }}, {{ node = 1 }}]\n{given}\n")
    for read in (gapbeam.read_scene, gapbeam.solve):
        with pytest.raises(gapbeam.SceneError) as caught:
            read(path)
        assert [(line, at) for line, at, _ in caught.value.mistakes] == [(3, place)]


def test_json_has_lines_too(tmp_path):
    data = tomllib.loads(BAD)
    data["analysis"]["history"] = [1.0]
    path = tmp_path / "bad.json"
    path.write_text(json.dumps(data, indent=1))
    with pytest.raises(gapbeam.SceneError) as caught:
        gapbeam.read_scene(path)
    text = path.read_text().splitlines()
    assert len(caught.value.mistakes) == len(FOUND) - 1
    for line, place, _ in caught.value.mistakes:
        assert place.split(".")[-1].partition("[")[0] in text[line - 1]


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_every_key_of_the_examples_has_its_line(path):
    text = path.read_text()
    lines, data = lines_of_keys(text), tomllib.loads(text)
    assert set(lines) == set(paths(data))
    for at, line in lines.items():
        if at and isinstance(at[-1], str):
            assert at[-1] in text.splitlines()[line - 1]
    assert set(lines_of_keys(json.dumps(data))) == set(lines)


def test_what_toml_may_look_like():
    text = """\
title = \'\'\'
# no [comment]
x = 1 \'\'\'
x.y."z w" = { a = [1, { b = 'q]' }], c.d = 2 } # c = 3
[[a.b]]
c = 1
[[a.b.e]]
f = 2021-01-01 00:00:00
[a.b.g]
h = "x\\"y"
[[a.b]]
c = [
 1, # one
 [2, 3],
]
"""
    lines = lines_of_keys(text)
    assert set(lines) == set(paths(tomllib.loads(text)))
    assert (lines["x", "y", "z w", "c", "d"], lines["a", "b", 0, "g", "h"], lines["a", "b", 1, "c", 1, 0]) == (4, 10, 14)


@pytest.mark.parametrize(
    ("change", "found"),
    [
        ('[[supports]]\nnode = 1\nlaw = { type = "plastic", stiffness = 1.0 }\n', [(11, "supports[2].law.limit")]),
        ('[[supports]]\nname = "A"\nx = 99.0\n[[supports]]\nname = "A"\nx = 3.0\n',
         [(11, 'supports "A".x'), (13, "supports[3].name")]),
        ('[[supports]]\nnode = 1\nside = "below"\ngap = "x"\n', [(12, "supports[2].gap")]),
        ('[[loads]]\ntype = "axial"\nx = 1.0\nF = 2.0\n', [(9, "loads[0]")]),
        ("[[sections]]\nfrom = 2.0\nto = 1.0\nEI = 3.0\n[[loads]]\ntype = 'force'\nx = 8.0\nF = 1.0\n",
         [(9, "sections[0]"), (15, "loads[0].x")]),
        ("supports = 3\n", None),
    ],
)  # fmt: skip
def test_mistakes_of_meaning(tmp_path, change, found):
    start = "[beam]\nspans = [6.0]\nEI = 1.0e4\n\n[[supports]]\nnode = 0\n[[supports]]\nnode = 1\n"
    path = tmp_path / "a.toml"
    path.write_text(start + change if found is not None else "supports = 3\n[beam]\nspans = [6.0]\nEI = -1.0\n")
    with pytest.raises(gapbeam.SceneError) as caught:
        gapbeam.read_scene(path)
    expected = [(1, "supports"), (4, "beam.EI")] if found is None else found
    assert [(line, place) for line, place, _ in caught.value.mistakes] == expected


def test_data_from_python_are_told_as_before():
    data = tomllib.loads(BAD)
    before = copy.deepcopy(data)
    with pytest.raises(gapbeam.SceneError) as caught:
        gapbeam.read_scene(data)
    assert str(caught.value).startswith("beam.EI: expected")
    assert data == before


ODD = """\
beam = { spans = [6.0, 6.0], EI = 1e4 }
[[supports]]
node = 0
name = 'a "\\ b'
gap = 1.0
[[supports]]
nodex = 1
name = "a name that is by far too long for any message that has to stand in one line"
[[supports]]
node = 2
gap = 0.01
SIDE_ = "below"
[[supports]]
node = 1
gap = 0.01
side = 3
[[loads]]
name = "a load whose name is by far too long for any message that has to stand in one line"
type = "uniform"
q = 1.0
casex = "wind"
to = -inf
[[combinations]]
name = 'rest'
factors = { wind = 1.0 }
"""


def test_odd_names_have_their_lines_and_what_follows_from_a_mistake_is_none(tmp_path):
    path = tmp_path / "odd.toml"
    path.write_text(ODD)
    with pytest.raises(gapbeam.SceneError) as error:
        gapbeam.read_scene(path)
    assert [(line, ODD.splitlines()[line - 1].split(" =")[0]) for line, *_ in error.value.mistakes] == [
        (5, "gap"), (7, "nodex"), (12, "SIDE_"), (16, "side"), (21, "casex"), (22, "to"),
    ], str(error.value)

    case = BAD[: BAD.index("EI")] + "EI = 1e4\n[[combinations]]\nname = 'r'\n[combinations.factors]\n'sn\"ow' = 1.0\n"
    path.write_text(case)
    with pytest.raises(gapbeam.SceneError) as error:
        gapbeam.read_scene(path)
    assert error.value.mistakes[-1][0] == len(case.splitlines())


def test_an_entry_is_replaced_by_the_name_that_messages_show():
    scene = gapbeam.Scene(beam=gapbeam.Beam([6.0], EI=1e4), supports=[gapbeam.Support(node=0, name='a "\\ b')])
    assert gapbeam.replace(scene, r'supports "a \"\\ b".gap', 0.5).supports[0].gap == 0.5


def test_mistakes_of_restraints_and_hinges_are_told_where_they_are_written(tmp_path):
    path = tmp_path / "rotations.toml"
    path.write_text("""\
beam = { spans = [6.0, 6.0], EI = 1e4 }
[[supports]]
node = 0
rotation = { law = { type = "plastic", stiffness = -1.0, limit = 1.0 } }
[[supports]]
node = 1
name = "pier"
rotation = { law = [[0.01, 5.0], [0.02, 5.0]], unloading = "plastic", slack = 0.001 }
[[hinges]]
x = 3.0
law = [[0.01, 5.0], [0.02, 3.0], [0.03, 3.0]]
""")
    with pytest.raises(gapbeam.SceneError) as caught:
        gapbeam.read_scene(path)
    assert [(line, place) for line, place, _ in caught.value.mistakes] == [
        (4, "supports[0].rotation.law.stiffness"), (8, 'supports "pier".rotation.slack'), (11, "hinges[0].law"),
    ]  # fmt: skip


@pytest.mark.parametrize(("change", "key"), [({"x": 20.0}, "x"), ({"x": 9.0, "stiffness": -5.0}, "stiffness")])
def test_a_hinge_behind_one_with_slack_keeps_its_number(change, key):
    hinges = [{"x": 3.0, "slack": 0.01}, {"stiffness": 5.0, **change}]
    made = {"beam": {"spans": [6.0, 6.0], "EI": 1e4}, "supports": [{"node": 0}, {"node": 1}], "hinges": hinges}
    with pytest.raises(gapbeam.SceneError) as caught:
        gapbeam.read_scene(made)
    assert caught.value.place == f"hinges[1].{key}"


@pytest.mark.parametrize(
    ("keys", "law", "wrong"),
    [
        ("gap = 0.004", '{type = "cubik", k1 = 200.0, k3 = 4e6}', 'got "cubik"'),
        ('side = "below"\nunloading = "broken"', "[[0.01, 7.0], [0.005, 0.0], [0.5, 0.0]]", "go back"),
    ],
)
def test_what_a_law_is_for_is_no_mistake_where_the_law_is_one(tmp_path, keys, law, wrong):
    """Without its law, which is wrong, a support has no gap both ways, and unloads along nothing."""
    path = tmp_path / "stops.toml"
    path.write_text(f"[beam]\nspans = [3.0]\nEI = 900.0\n[[supports]]\nnode = 0\n[[supports]]\nnode = 1\n{keys}\nlaw = {law}\n")
    with pytest.raises(gapbeam.SceneError) as error:
        gapbeam.solve(str(path))
    assert str(error.value).count("supports") == 1
    assert wrong in str(error.value)
