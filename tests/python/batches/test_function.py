"""One callable of a scene: the numbers of batches and of `solve`, names and units, cases that fail."""

import json
import pickle
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import gapbeam
import numpy as np
import pytest
from gapbeam.batches import wanted

EXAMPLES = Path(__file__).parents[3] / "examples"
SCENE = {
    "units": {"force": "kN", "length": "m"},
    "beam": {"spans": [6.0, 5.0, 6.0], "EI": 1e4},
    "supports": [
        {"node": 0, "side": "below", "name": "A"},
        {"node": 1, "side": "below", "name": "B", "gap": 0.01},
        {"node": 2, "side": "below"},
        {"node": 3},
    ],
    "loads": [{"type": "uniform", "q": 5.0, "case": "dead"}, {"type": "force", "x": 3.0, "F": 20.0, "case": "wind"}],
}
PREPARED = ["beam.EI[0]", "supports[1].gap", "supports[2].settlement", "factors.wind"]
ONE_BY_ONE = ["beam.EI[0]", "supports[1].gap", "loads[1].x", "factors.wind"]
OUTPUTS = [
    "moment.max", "moment.max_x", "moment.min", "reaction[3]", "reaction.A", "opening.B", "couple[3]", "deflection@15.0",
    "shear@3", "lifted[2]", "lifted.B", "error_bound.reaction",
]  # fmt: skip


def drawn(names, cases, seed=3):
    rng = np.random.default_rng(seed)
    column = {
        "beam.EI[0]": rng.uniform(5e3, 2e4, cases), "supports[1].gap": rng.normal(0.0, 0.06, cases),
        "supports[2].settlement": rng.normal(0.0, 0.06, cases), "loads[1].x": rng.uniform(0.5, 16.5, cases),
        "factors.wind": rng.uniform(-1.2, 4.0, cases),
    }  # fmt: skip
    return np.column_stack([column[name] for name in names])


def changed(names, row):
    """The scene of a case, by hand."""
    scene = gapbeam.read_scene(SCENE)
    for name, value in zip(names, row, strict=True):
        if name == "factors.wind":
            scene = gapbeam.replace(scene, "loads[1].F", value * 20.0)
        else:
            scene = gapbeam.replace(scene, name, value)
    return gapbeam.solve(scene)


@pytest.mark.parametrize("names", [PREPARED, ONE_BY_ONE], ids=["prepared", "one-by-one"])
def test_numbers_are_those_of_solve(names):
    f = gapbeam.function(SCENE, names, OUTPUTS)
    assert f._job.cases.is_prepared == (names is PREPARED)
    X = drawn(names, 40)
    found = f(X)
    seen = set()
    for row, values in zip(X, found, strict=True):
        result = changed(names, row)
        step, fields = result.steps[-1], result.at([15.0, 3.0])
        extremes = result.extremes["moment"]
        right = [
            extremes["max"].value, extremes["max"].x, extremes["min"].value, step.reaction[3], step.reaction[0],
            step.opening[1], step.couple[3], fields.deflection[0], fields.shear[1], step.opening[2] > 0.0, step.opening[1] > 0.0,
        ]  # fmt: skip
        np.testing.assert_allclose(values[:-1], right, rtol=1e-9, atol=1e-9)
        assert 0.0 <= values[-1] < 1e-8
        seen.add((values[9], values[10]))
    assert all(set(column) == {0.0, 1.0} for column in zip(*seen, strict=True))  # both supports with and without contact


@pytest.mark.parametrize("names", [PREPARED, ONE_BY_ONE], ids=["prepared", "one-by-one"])
def test_digits_are_those_of_a_batch(tmp_path, names):
    X = drawn(names, 300)
    X[17, 1] = np.nan
    columns = ["moment.max", "reaction.A", "deflection@15.0", "opening.2"]
    f = gapbeam.function(SCENE, names, columns)
    want = ["moment", "reaction", "deflection@15.0", "opening"]
    done = gapbeam.batch(SCENE, dict(zip(names, X.T, strict=True)), tmp_path, want=want)
    there = done.read([*columns, "status", "reason"])
    found = f.evaluate(X)
    assert found.values.tobytes() == np.column_stack([there[name] for name in columns]).tobytes()
    assert found.status.tolist() == there["status"].tolist()
    assert found.reason.tolist() == there["reason"].tolist()
    assert found.status[17] == "refused"
    assert np.isnan(found.values[17]).all()
    assert np.isfinite(np.delete(found.values, 17, axis=0)).all()


def test_one_case_and_no_case():
    f = gapbeam.function(SCENE, PREPARED, OUTPUTS)
    X = drawn(PREPARED, 3)
    assert f(X[1]).shape == (12,)
    assert f(X[1]).tobytes() == f(X)[1].tobytes()
    one = f.evaluate(X[1])
    assert (one.status, one.reason) == ("solved", "")
    assert f(np.empty((0, 4))).shape == (0, 12)
    assert f.evaluate(np.empty((0, 4))).status.shape == (0,)


def test_threads_change_nothing(monkeypatch):
    X = drawn(PREPARED, 2100)
    alone = gapbeam.function(SCENE, PREPARED, OUTPUTS[:-1], threads=1)(X)
    many = gapbeam.function(SCENE, PREPARED, OUTPUTS[:-1], threads=4)
    assert many(X).tobytes() == alone.tobytes()
    with ThreadPoolExecutor(4) as pool:
        assert all(values.tobytes() == alone.tobytes() for values in pool.map(many, [X] * 4))
    monkeypatch.setattr(wanted, "SECONDS", 0.001)
    small = gapbeam.function(SCENE, PREPARED, OUTPUTS[:-1], threads=1)
    assert small._chunk < 1000
    assert small(X).tobytes() == alone.tobytes()


def test_pickled_ones_are_the_same():
    f = gapbeam.function(SCENE, PREPARED, OUTPUTS)
    X = drawn(PREPARED, 20)
    before = f(X)
    again = pickle.loads(pickle.dumps(f))
    assert (again.inputs, again.outputs, again.units) == (f.inputs, f.outputs, f.units)
    assert again(X).tobytes() == before.tobytes()


def test_names_units_and_what_the_scene_has():
    f = gapbeam.function(SCENE, [*PREPARED, "supports[1].stiffness", "loads[0].q", "supports[0].rotation"], OUTPUTS)
    assert [f.units[name] for name in f.inputs] == ["kN m^2", "m", "m", "", "kN/m", "kN/m", "kN m/rad"]
    assert [f.units[name] for name in f.outputs] == ["kN m", "m", "kN m", "kN", "kN", "m", "kN m", "m", "kN", "", "", "kN"]
    assert f.nominal.tolist()[:6] == [1e4, 0.01, 0.0, 1.0, np.inf, 5.0]
    assert np.isnan(f.nominal[6])
    bare = gapbeam.function({**SCENE, "units": {}}, PREPARED, ["moment.max"])
    assert set(bare.units.values()) == {""}


@pytest.mark.parametrize("more", [
    {"combinations": [{"name": "a", "factors": {"dead": 1.0}}, {"name": "b", "factors": {"dead": 1.0, "wind": 1.5}}]},
    {"trains": [{"name": "crane", "axles": [[0.0, 30.0], [2.0, 30.0]]}]},
], ids=["combinations", "trains"])  # fmt: skip
def test_envelopes_have_a_largest_and_a_smallest_value(more):
    scene = {**SCENE, **more}
    outputs = ["reaction[1].max", "reaction.B.min", "moment.max", "moment@15.0.min", "moment@3.max", "lifted.B"]
    f = gapbeam.function(scene, ["supports.B.gap"], outputs)
    for gap in (0.0, 0.15):
        envelope = gapbeam.solve(gapbeam.replace(gapbeam.read_scene(scene), "supports[1].gap", gap)).envelope()
        there = gapbeam.solve(gapbeam.replace(gapbeam.read_scene(scene), "supports[1].gap", gap)).envelope(x=[15.0, 3.0]).fields
        row = envelope.supports[1]
        right = [
            row["reaction"]["max"].value, row["reaction"]["min"].value, envelope.extremes["moment"]["max"].value,
            there.smallest["moment"][0], there.largest["moment"][1], row["opening"]["max"].value > 0.0,
        ]  # fmt: skip
        np.testing.assert_allclose(f([gap]), right, rtol=1e-12)
    with pytest.raises(gapbeam.SceneError, match=r'no "reaction\[1\]"; did you mean "reaction.B.m'):
        gapbeam.function(scene, ["supports.B.gap"], ["reaction[1]"])


def test_limit_factor_is_there_where_the_load_ends_before():
    f = gapbeam.function(EXAMPLES / "snap_through.toml", ["loads[0].F"], ["limit.factor", "reaction[0]"])
    force = float(f.nominal[0])
    alone = gapbeam.solve(EXAMPLES / "snap_through.toml").limits[0].factor
    found = f.evaluate([[force], [1.25 * force], [force / 2]])
    np.testing.assert_allclose(found.values[:, 0], [alone, alone / 1.25, np.inf])
    tipping = {
        "beam": {"spans": [4.0, 4.0, 2.0], "EI": 1e4}, "supports": [{"node": i, "side": "below"} for i in range(3)],
        "loads": [{"type": "uniform", "q": 3.0, "case": "dead"}, {"type": "force", "x": 10.0, "F": 100.0}],
        "analysis": {"follow": "events"},
    }  # fmt: skip
    f = gapbeam.function(tipping, ["loads[1].F"], ["limit.factor", "reaction[2]"])
    found = f.evaluate([[100.0], [50.0], [30.0]])
    np.testing.assert_allclose(found.values[:2, 0], [0.45, 0.9])
    assert found.values[2, 0] == np.inf
    assert found.status.tolist() == ["no-equilibrium", "no-equilibrium", "solved"]
    assert np.isnan(found.values[:2, 1]).all()
    with pytest.raises(gapbeam.SceneError, match="follow"):
        gapbeam.function(SCENE, PREPARED, ["limit.factor"])


def test_gradients_are_central_differences():
    f = gapbeam.function(SCENE, ["loads[0].q", "supports[2].settlement"], ["reaction.A", "moment@3"])
    x = np.array([5.0, 0.0])
    slope = f.gradient(x, [0.1, 1e-4])
    assert slope.shape == (2, 2)
    # Linear while no contact changes
    np.testing.assert_allclose(f(x + np.array([0.05, 5e-5])), f(x) + slope @ [0.05, 5e-5], rtol=1e-9)
    assert f.gradient([x, x + 0.01, x], [0.1, 1e-4]).shape == (3, 2, 2)
    np.testing.assert_allclose(f.gradient([x, 2 * x], [0.1, 1e-4])[0], slope)
    for wrong in (0.0, [-1.0, 1.0], [1.0, 1.0, 1.0], np.nan):
        with pytest.raises(ValueError, match="step: expected a number above 0, or 2"):
            f.gradient(x, wrong)


def test_places_beyond_a_shorter_beam_are_refused():
    f = gapbeam.function(SCENE, ["beam.spans[2]"], ["moment@16.5"])
    found = f.evaluate([[6.0], [5.0]])
    assert found.status.tolist() == ["solved", "refused"]
    assert found.reason[1].startswith("moment@16.5: the beam of this case ends at 16")


@pytest.mark.parametrize(("inputs", "outputs", "words"), [
    (["beam.EIs"], ["moment.max"], 'did you mean "beam.EI"'),
    (PREPARED, ["momentt.max"], "did you mean moment"),
    (PREPARED, ["moment"], 'did you mean "moment.m'),
    (PREPARED, ["reaction[4]"], "there is no support 4; the scene has 4, 0 to 3"),
    (PREPARED, ["reaction.C"], 'no "reaction.C"; did you mean "reaction.'),
    (PREPARED, ["moment@17.5"], "expected a place from 0 to 17"),
    (PREPARED, ["moment@here"], "expected a place from 0 to 17"),
    (PREPARED, ["pressure.max"], "there is no"),
    (PREPARED, ["input"], "there is no"),
    (PREPARED, [], "outputs: is empty"),
    ([], ["moment.max"], "inputs: is empty"),
    (PREPARED, ["moment.max", "moment.max"], "is there twice"),
])  # fmt: skip
def test_mistakes_are_said(inputs, outputs, words):
    with pytest.raises(gapbeam.SceneError, match=words.replace("[", r"\[")):
        gapbeam.function(SCENE, inputs, outputs)


@pytest.mark.parametrize("X", [1.0, [1.0, 2.0], np.zeros((3, 5)), np.zeros((2, 2, 4))])
def test_other_shapes_are_refused(X):
    with pytest.raises(ValueError, match="X: expected 4 numbers a case"):
        gapbeam.function(SCENE, PREPARED, ["moment.max"])(X)


def test_a_path_with_quotes_in_a_name_is_taken_as_it_is_suggested():
    scene = {"beam": {"spans": [6.0], "EI": 1e4}, "loads": [{"type": "uniform", "q": 1.0}],
             "supports": [{"node": 0, "side": "below", "name": 'a "b" \\c'}, {"node": 1}]}  # fmt: skip
    with pytest.raises(gapbeam.SceneError) as error:
        gapbeam.function(scene, ['supports.a "b" \\c.gap'], ["reaction[0]"])
    suggested = json.loads(str(error.value).partition("did you mean ")[2].removesuffix("?"))
    assert gapbeam.function(scene, [suggested], ["reaction[0]"])([0.0]) == pytest.approx([3.0])


def test_units_of_laws_tables_and_tapers():
    """By the place of a number in its table: of rotations, of values at places, of the ends of a taper."""
    scene = {
        "units": {"force": "kN", "length": "m"}, "beam": {"spans": [4.0, 4.0], "EI": 1e3},
        "supports": [{"node": 0, "rotation": {"law": {"type": "plastic", "stiffness": 1e3, "limit": 2.0}}}, {"node": 2},
                     {"node": 1, "law": {"type": "hardening", "stiffness": 1e3, "limit": 2.0, "slope": 1.0}}],
        "hinges": [{"x": 2.0, "law": [[0.01, 2.0]]}],
        "sections": [{"to": 1.0, "EI": {"from": 1e3, "to": 2e3, "power": 3}}],
        "loads": [{"type": "uniform", "q": 1.0}],
    }  # fmt: skip
    units = {
        "supports[0].rotation.law.stiffness": "kN m/rad", "supports[0].rotation.law.limit": "kN m",
        "supports[2].law.stiffness": "kN/m", "supports[2].law.limit": "kN",
        "hinges[0].law[0][0]": "rad", "hinges[0].law[0][1]": "kN m",
        "sections[0].EI.from": "kN m^2", "sections[0].EI.to": "kN m^2", "sections[0].to": "m",
    }  # fmt: skip
    found = gapbeam.function(scene, list(units), ["moment.max"]).units
    assert {name: found[name] for name in units} == units
    clay = {"type": "tanh", "stiffness": [[0.0, 1e3], [8.0, 2e3]], "limit": [20.0, 30.0]}
    units = {
        "foundation[0].law.stiffness[1][0]": "m", "foundation[0].law.stiffness[1][1]": "kN/m^2",
        "foundation[0].law.limit[1]": "kN/m", "foundation[1].k[1][0]": "m", "foundation[1].k[1][1]": "kN/m^2",
        "foundation[2].law[0].x": "m", "foundation[2].law[0].points[0][0]": "m", "foundation[2].law[0].points[0][1]": "kN/m",
    }  # fmt: skip
    layer = [{"x": x, "points": [[0.01, 5.0]]} for x in (0.0, 8.0)]
    ground = {"foundation": [{"law": clay}, {"k": [[0.0, 1e3], [8.0, 2e3]]}, {"law": layer}]}
    found = gapbeam.function({**scene, **ground, "supports": [], "hinges": []}, list(units), ["moment.max"]).units
    assert {name: found[name] for name in units} == units
    sinks = [{"name": "sinks", "factors": {"live": 1.0}, "settlements": {"0": 0.01}}]
    units = {"combinations.sinks.settlements.0": "m", "combinations.sinks.factors.live": ""}
    found = gapbeam.function({**scene, "combinations": sinks}, list(units), ["moment.max"]).units
    assert {name: found[name] for name in units} == units
