"""Mistakes that users of other programs make: what is said names the place, and what to write instead."""

import re

import gapbeam
import pytest

BEAM = {"spans": [6.0, 6.0], "EI": 1e4}
SUPPORTS = [{"node": 0}, {"node": 1, "side": "below"}, {"node": 2}]
LOADS = [{"type": "uniform", "q": 5.0, "case": "live"}, {"type": "force", "x": 3.0, "F": 10.0, "case": "wind"}]


def scene(**parts):
    return {"beam": BEAM, "supports": SUPPORTS, "loads": LOADS} | parts


def support(**keys):
    return scene(supports=[SUPPORTS[0] | keys, *SUPPORTS[1:]])


def load(**keys):
    return scene(loads=[keys])


IN_A_SCENE = [
    (scene(beam=BEAM | {"E": 1.0}), 'did you mean "EI"'),
    (scene(beam={"spans": [6.0], "ei": 1.0}), 'did you mean "EI"'),
    (scene(beam={"span": [6.0], "EI": 1.0}), 'did you mean "spans"'),
    (scene(beam={"spans": 12.0, "EI": 1.0}), "a list of numbers"),
    (scene(beam={"spans": [6.0, -6.0], "EI": 1.0}), "give a length above 0"),
    (scene(beam=BEAM | {"EI": "1e4"}), "write 1e4 without quotes"),
    (scene(beam=BEAM | {"EI": "1e4 kNm2"}), "numbers have no units: write 1e4 if the scene has kNm2, else convert it"),
    (support(gap="5mm"), "numbers have no units: write 5 if the scene has mm, else convert it"),
    (scene(beam=BEAM | {"EI": [1.0]}), "one per span"),
    (scene(supports=[{}]), "give node or x"),
    (scene(supports=[{"x": 20.0}]), "from x = 0 to x = 12"),
    (scene(supports=[{"node": 3}]), "the nodes of the beam are 0 to 2"),
    (scene(supports=[{"node": -1}]), "the nodes of the beam are 0 to 2"),
    (support(x=0.0), "give one of the two"),
    (support(side="down"), 'lets it lift off is "below"'),
    (support(side="roller"), 'one that holds the beam up and down is "both"'),
    (support(type="pin"), 'side = "both" holds it up and down'),
    (support(rotation=True), 'did you mean "fixed"'),
    (support(rotation="clamped"), 'did you mean "fixed"'),
    (support(stiffness=-5.0), "0 or more"),
    (support(k=5.0), 'did you mean "stiffness"'),
    (load(type="point", x=3.0, F=1.0), 'did you mean "force"'),
    (load(type="udl", q=3.0), 'did you mean "uniform"'),
    (load(type="force", x=3.0, P=1.0), 'did you mean "F"'),
    (load(type="uniform", w=1.0), 'did you mean "q"'),
    (load(type="uniform", q=1.0, **{"from": 6.0, "to": 3.0}), "from must be less than to"),
    (load(type="force", x=13.0, F=1.0), "outside the beam"),
    (load(type="force", x=3.0, F=float("nan")), "a finite number"),
    (scene(analysis={"step": 10}), 'did you mean "steps"'),
    (scene(analysis={"follow": "event"}), '"events" or "steps"'),
    (scene(combinations=[{"name": "ULS", "factors": {"G": 1.35}}]), 'the cases are "live" and "wind"'),
    (load(type="uniform", q=1.0, case="Dead"), 'nearly "dead"'),
    ("nofile.toml", "no such file"),
    ("title = 'x'", "give tomllib.loads"),
    (None, "a Scene, a mapping or the path of a file, got None"),
]  # fmt: skip


@pytest.mark.parametrize(("given", "said"), IN_A_SCENE, ids=[said for _, said in IN_A_SCENE])
def test_in_a_scene(given, said):
    with pytest.raises(gapbeam.SceneError, match=re.escape(said)):
        gapbeam.solve(given)


IN_PYTHON = {
    "gapbeam.solve(R)": "to solve it again, give its scene",
    "gapbeam.Support(0)": "write Support(node = ..., x = ...)",
    "gapbeam.Support(node=0, nod=1)": 'did you mean "node"',
    "gapbeam.solve(gapbeam.Scene(beam=gapbeam.Beam([1.0], 1.0), supports=[gapbeam.Support(node=0, side='dwon')]))": '"below"',
    "gapbeam.Support(node=0).gapp": "no attribute 'gapp'",
    "gapbeam.PointLoad": "use gapbeam.ForceLoad",
    "gapbeam.MovingLoad": "use gapbeam.Train",
    "gapbeam.Model": "use gapbeam.Scene",
    "gapbeam.load('x')": "use gapbeam.read_scene",
    "gapbeam.plot(R)": "use result.plot()",
    "R.to_dataframe()": "to_pandas()",
    "R.reaction": "did you mean reactions?",
    "R.moment(3.0)": "use at(x).moment",
    "R.deflection": "use at(x).deflection",
    "R.at(20.0)": "the beam goes from 0 to 12",
    "R.at('3')": "expected numbers",
    "R.at(3.0, step=5)": "for a load factor give factor",
    "R.at(3.0, factor='full')": "factor: expected numbers",
    "R.extremes()['M']": "did you mean 'moment'?",
    "R.combinations['ULS']": "the scene has none",
    "R.trains['x']": "the scene has no trains",
    "R.reactions['pier']": "there is no support 'pier'",
    "P.solve([1.0])": 'the loads are, by case, "live", "wind"',
    "P.solve({'live': 1.0})": 'expected a list of 2 numbers, one for each load',
    "P.solve([[1, 1]], gap={'x': [0.1]})": "no support has a name; give its number",
    "P.solve([[1, 'a']])": "expected numbers",
    "P.solve([1.0, 1.0]).moments": "use at(x).moment",
    "P.solve([[1.0, 1.0]])[1]": "there is no case 1; their numbers go from 0 to 0",
    "T.at(7.3)": "at: 7.3 is a place along the beam; give the position of the train too",
    "T.history_extremes": "use extremes",
    "R.envelope().steps": "use the steps of the result",
    "gapbeam.batch(S, {'supports[1].gapp': [1.0]}, F)": 'did you mean "supports[1].gap"',
    "gapbeam.batch(S, {'gap': [1.0]}, F)": 'such are "factors.live"',
    "gapbeam.batch(S, {}, F)": "give one array at least",
    "gapbeam.batch(S, {'factors.live': [1.0]}, F).at(3.0)": "use gapbeam.solve(batch.scene_of(case)).at(x)",
    "gapbeam.sample.normal(10.0, -1.0)": "deviation: expected 0 or a positive number",
    "R.extremes['M']": "did you mean 'moment'?",
    "setattr(R.scene.supports[1], 'gap', 0.5)": 'gapbeam.replace(result.scene, "supports[1].gap", 0.5)',
    "R.to_excel('a.xls')": "ends in .xlsx",
    "P.solve([1.0, 1.0], gaps=[0.0, 0.1, 0.0])": "did you mean gap?",
    "P.solve([1.0, 1.0], settlements=[0.0, 0.01, 0.0])": "is settlement = [...]",
    "gapbeam.solve(U).steps[-1]": "no equilibrium at load factor 1",
    "gapbeam.solve(U).reactions": "no equilibrium at load factor 1",
    "gapbeam.solve(U).raise_for_status()": "no equilibrium at load factor 1",
    "R.steps[-1].reaction.__setitem__(0, 1.0)": "read-only",
}


@pytest.fixture(scope="module")
def names(tmp_path_factory):
    return {
        "gapbeam": gapbeam, "R": gapbeam.solve(scene()), "P": gapbeam.prepare(scene()), "U": {"beam": BEAM, "loads": LOADS},
        "S": scene(), "F": tmp_path_factory.mktemp("batch") / "b",
        "T": gapbeam.solve(scene(trains=[{"name": "man", "axles": [[0.0, 1.0]]}])).trains["man"],
    }  # fmt: skip


@pytest.mark.parametrize("call", IN_PYTHON)
def test_in_python(call, names):
    with pytest.raises(Exception, match=re.escape(IN_PYTHON[call])):
        eval(call, names)


BELOW = [{"node": node, "side": "below"} for node in range(3)]
OUTCOMES = [
    (scene(supports=[]), "moves down as a whole"),
    (scene(supports=[{"node": 0}]), "tips about the support at x = 0"),
    (scene(supports=BELOW, loads=[{"type": "force", "x": 3.0, "F": -10.0}]), "moves up as a whole"),
]


@pytest.mark.parametrize(("given", "said"), OUTCOMES, ids=[said for _, said in OUTCOMES])
def test_outcomes_are_no_errors_and_say_why(given, said):
    result = gapbeam.solve(given)
    assert not result.ok
    assert said in result.reason
    assert said in repr(result)


def test_a_gap_in_another_unit_is_doubted():
    result = gapbeam.solve(scene(supports=[SUPPORTS[0], SUPPORTS[1] | {"gap": 2.0}, SUPPORTS[2]]))
    assert "supports[1].gap = 2 is" in repr(result)
    assert "is it in the unit of the spans?" in repr(result)


def test_pandas_takes_fields_and_steps(names):
    pandas = pytest.importorskip("pandas")
    result = names["R"]
    assert pandas.DataFrame(result.fields())["moment"].max() == result.fields().moment.max()
    table = pandas.DataFrame(result.steps[-1])
    assert table["reaction"].tolist() == list(result.reactions)
    assert table["state"].tolist() == list(result.states)


NUMBERS = {
    "numpy scalars": lambda n, p: scene(supports=[{"node": n.int64(k)} for k in range(3)], beam={"spans": n.full(2, 6), "EI": 1}),
    "whole floats": lambda n, p: scene(supports=[{"node": float(k)} for k in range(3)], analysis={"steps": 2.0}),
    "ranges": lambda n, p: scene(beam={"spans": range(6, 8), "EI": 1e4}, supports={"node": range(3)}),
    "nullable columns": lambda n, p: scene(supports=p.DataFrame({"node": [0, 1, 2], "gap": [0.0] * 3}).convert_dtypes()),
    "whole floats in a table": lambda n, p: scene(supports=p.DataFrame({"node": [0.0, 1.0, 2.0]})),
    "Float64": lambda n, p: scene(beam={"spans": p.Series([6.0, 6.0], dtype="Float64"), "EI": 1e4}),
}


@pytest.mark.parametrize("name", NUMBERS)
def test_numbers_of_others_are_taken(name):
    numpy, pandas = pytest.importorskip("numpy"), pytest.importorskip("pandas")
    result = gapbeam.solve(NUMBERS[name](numpy, pandas))
    assert len(result.reactions) == 3
    prepared = gapbeam.prepare(result.scene)
    expected = prepared.solve([1.0, 2.0]).reaction.tolist()
    for factors in (range(1, 3), pandas.Series([1, 2], dtype="Int64"), pandas.Series([1.0, 2.0], dtype="Float64")):
        assert prepared.solve(factors).reaction.tolist() == expected
    x = pandas.Series([1, 2], dtype="Int64")
    for places in (x, range(1, 3)):
        assert result.at(places, step=-1.0).moment.tolist() == result.at([1.0, 2.0]).moment.tolist()


MISSING = {
    "gapbeam.solve(scene(beam={'spans': pandas.Series([6, None], dtype='Int64')}))": 'beam.spans[1]: expected a number, got',
    "gapbeam.solve(scene(supports=pandas.DataFrame({'node': [0, None, 2]}).convert_dtypes()))": "supports[1].node: expected",
    "P.solve(pandas.Series([1, None], dtype='Int64').astype(object))": "some of these are missing (pandas.NA)",
    "P.solve([1.0, 1.0], gap={1: pandas.NA})": "gap: expected numbers, and some of these are missing",
    "gapbeam.solve(scene(supports=[{'node': 0.5}]))": "supports[0].node: expected a whole number, got 0.5",
}


@pytest.mark.parametrize("call", MISSING)
def test_missing_numbers_are_refused_in_words(call, names):
    pandas = pytest.importorskip("pandas")
    with pytest.raises(ValueError, match=re.escape(MISSING[call])):
        eval(call, {**names, "pandas": pandas, "scene": scene})


def test_what_was_missing_is_there(names):
    result = names["R"]
    assert result.report()
    assert result.plot().axes
    assert len(result.reactions) == 3
    assert len(list(result.fields())) == len(result.fields().x)
