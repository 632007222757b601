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
    (scene(beam=BEAM | {"EI": "1e4 kNm2"}), "numbers have no units: write 1e4"),
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
    "P.solve([1.0, 1.0], gaps=[0.0, 0.1, 0.0])": "did you mean gap?",
    "P.solve([1.0, 1.0], settlements=[0.0, 0.01, 0.0])": "is settlement = [...]",
    "gapbeam.solve(U).steps[-1]": "no equilibrium at load factor 1",
    "gapbeam.solve(U).reactions": "no equilibrium at load factor 1",
    "gapbeam.solve(U).raise_for_status()": "no equilibrium at load factor 1",
    "R.steps[-1].reaction.__setitem__(0, 1.0)": "read-only",
}


@pytest.fixture(scope="module")
def names():
    return {
        "gapbeam": gapbeam, "R": gapbeam.solve(scene()), "P": gapbeam.prepare(scene()), "U": {"beam": BEAM, "loads": LOADS},
    }  # fmt: skip


@pytest.mark.parametrize("call", IN_PYTHON)
def test_in_python(call, names):
    with pytest.raises(Exception, match=re.escape(IN_PYTHON[call])):
        eval(call, names)


def test_what_was_missing_is_there(names):
    result = names["R"]
    assert result.report()
    assert result.plot().axes
    assert len(result.reactions) == 3
    assert len(list(result.fields())) == len(result.fields().x)
