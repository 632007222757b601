"""Columns of a batch reach every table of a scene: hinges, restraints, masses and ground along the beam, as they are written."""

from copy import deepcopy

import gapbeam
import numpy as np
import pytest
from gapbeam import SceneError

SCENE = {
    "units": {"force": "kN", "length": "m"},
    "beam": {"spans": [6.0, 6.0], "EI": 1e4, "mass": 0.1},
    "supports": [
        {"node": 0, "rotation": {"stiffness": 2e3, "slack": 0.001}},
        {"node": 1, "side": "below"},
        {"node": 2, "rotation": 5e3},
    ],
    "hinges": [{"x": 3.0, "stiffness": 1e3}, {"x": 9.0, "stiffness": 2e3, "slack": 0.002, "name": "splice"}],
    "masses": [{"x": 2.0, "mass": 0.5, "name": "pump"}],
    "loads": [{"type": "uniform", "q": 10.0}],
}
PILE = {
    "beam": {"spans": [20.0], "EI": 1e5, "EA": 8e6},
    "supports": [{"node": 0}, {"node": 1}, {"node": 1, "direction": "axial", "stiffness": 5e4}],
    "axial_ground": [{"limit": [20.0, 100.0], "stiffness": 2e4, "name": "sand", "to": 15.0}, {"from": 15.0, "stiffness": 1e4}],
    "loads": [{"type": "axial", "node": 0, "F": 2000.0}],
    "analysis": {"first_order": True},
}


def put(scene, place, value):
    """Give a scene with one number replaced, by keys and numbers."""
    made = deepcopy(scene)
    at = made
    for key in place[:-1]:
        at = at[key]
    at[place[-1]] = value
    return made


@pytest.mark.parametrize(
    ("scene", "column", "place", "values", "field"),
    [
        (SCENE, "hinges[0].stiffness", ("hinges", 0, "stiffness"), [5e2, 1e3, 4e3], "moment"),
        (SCENE, "hinges.splice.slack", ("hinges", 1, "slack"), [0.0, 0.0005, 0.001], "moment"),
        (SCENE, "hinges.splice.stiffness", ("hinges", 1, "stiffness"), [0.0, 1e2, 1e6], "moment"),
        (SCENE, "supports[0].rotation.stiffness", ("supports", 0, "rotation", "stiffness"), [1e2, 1e3, 1e5], "moment"),
        (SCENE, "supports[0].rotation.slack", ("supports", 0, "rotation", "slack"), [0.0, 0.0005, 0.1], "moment"),
        (SCENE, "supports[2].rotation", ("supports", 2, "rotation"), [0.0, 1e2, 1e5], "moment"),
        (PILE, "axial_ground.sand.limit[0]", ("axial_ground", 0, "limit", 0), [10.0, 40.0, 100.0], "axial_displacement"),
        (PILE, "axial_ground[1].stiffness", ("axial_ground", 1, "stiffness"), [1e2, 1e4, 1e6], "axial_displacement"),
        (PILE, "axial_ground[1].limit", ("axial_ground", 1, "limit"), [5.0, 10.0, 100.0], "axial_displacement"),
        (PILE, "axial_ground.sand.to", ("axial_ground", 0, "to"), [5.0, 10.0, 15.0], "axial_displacement"),
    ],
    ids=lambda one: one if isinstance(one, str) and "[" in one + "[" else "",
)
def test_a_column_gives_what_the_scene_gives(tmp_path, scene, column, place, values, field):
    kept = gapbeam.batch(scene, {column: values}, tmp_path, want=[field, "reaction"]).read(["status", f"{field}.max", "reaction.1"])
    alone = [gapbeam.solve(put(scene, place, value)) for value in values]
    assert list(kept["status"]) == [one.status for one in alone] == ["solved"] * len(values)
    assert kept[f"{field}.max"].tolist() == [one.extremes[field]["max"].value for one in alone]
    assert kept["reaction.1"].tolist() == [float(one.steps[-1].reaction[1]) for one in alone]
    assert len(set(kept[f"{field}.max"].tolist())) == len(values)


def test_masses_are_counted(tmp_path):
    done = gapbeam.batch(SCENE, {"masses.pump.mass": [0.1, 2.0]}, tmp_path, want=["input", "moment"])
    first = {"analysis": {"frequencies": 1}}
    found = [gapbeam.solve(done.scene_of(k).to_dict() | first).frequencies for k in range(2)]
    alone = [gapbeam.solve(put(SCENE | first, ("masses", 0, "mass"), one)).frequencies for one in (0.1, 2.0)]
    np.testing.assert_array_equal(found, alone)
    assert found[1][0] < found[0][0]


def test_a_hinge_without_slack_is_no_support(tmp_path):
    kept = gapbeam.batch(SCENE, {"hinges.splice.slack": [0.002, 0.0]}, tmp_path, want=["reaction"])
    solved = kept.read(["reaction.splice", "reaction.2"])
    assert np.isfinite(solved["reaction.2"]).all()
    assert np.isnan(solved["reaction.splice"]).tolist() == [False, True]


def test_a_hinge_gets_a_slack_in_some_rows(tmp_path):
    scene = put(SCENE, ("hinges",), [{"x": 3.0, "stiffness": 1e3}])
    kept = gapbeam.batch(scene, {"hinges[0].slack": [0.0, 0.001]}, tmp_path, want=["moment"]).read(["moment.max"])["moment.max"]
    alone = [gapbeam.solve(put(scene, ("hinges", 0, "slack"), one)).extremes["moment"]["max"].value for one in (0.0, 0.001)]
    assert kept.tolist() == alone


def test_load_steps_at_which_a_restraint_begins_to_act_are_kept(tmp_path):
    """A beam on one pin and on a one-sided restraint: it stands under all loads, and under no dead load alone."""
    scene = {
        "beam": {"spans": [4.0], "EI": 1e3},
        "supports": [{"node": 0, "rotation": {"side": "counterclockwise", "stiffness": 1e4}}],
        "loads": [{"type": "uniform", "q": -1.0, "case": "dead"}, {"type": "uniform", "q": 3.0}],
        "analysis": {"steps": 4},
    }
    done = gapbeam.batch(scene, {"factors.live": [1.0, 1.5]}, tmp_path, want=["moment"])
    alone = [gapbeam.solve(put(scene, ("loads", 1, "q"), 3.0 * one)) for one in (1.0, 1.5)]
    assert [one.status for one in alone] == ["no-equilibrium", "solved"]
    assert list(done.read(["status"])["status"]) == [one.status for one in alone]


def test_load_steps_at_which_a_restraint_cannot_hold_are_kept(tmp_path):
    """A cantilever whose clamp yields at 1: its weight alone is too much for it, and what lifts it comes step by step.

    Beside ground, here far above it, its states do not ask for a path.
    """
    scene = {
        "beam": {"spans": [1.0], "EI": 1e3}, "foundation": [{"k": 1.0, "side": "above", "gap": 5.0}],
        "supports": [{"node": 0, "rotation": {"law": [[0.01, 1.0], [1.0, 1.0]]}}],
        "loads": [{"type": "force", "node": 1, "F": 2.0, "case": "dead"}, {"type": "force", "node": 1, "F": -1.5}],
        "analysis": {"steps": 4},
    }  # fmt: skip
    weights, factors = [2.0, 1.2, 0.9], [1.0, 1.5, 2.0]
    done = gapbeam.batch(scene, {"loads[0].F": weights, "factors.live": factors}, tmp_path, want=["moment"])
    both = zip(weights, factors, strict=True)
    alone = [put(put(scene, ("loads", 0, "F"), weight), ("loads", 1, "F"), -1.5 * by) for weight, by in both]
    assert list(done.read(["status"])["status"]) == [gapbeam.solve(one).status for one in alone]
    assert "solved" not in done.read(["status"])["status"][:1]


def test_a_name_that_stands_twice_is_told(tmp_path):
    twice = put(PILE, ("axial_ground", 1, "name"), "sand")
    with pytest.raises(SceneError, match=r'there are 2 of the name "sand"; give the number of one, as axial_ground\[0\]'):
        gapbeam.batch(twice, {"axial_ground.sand.stiffness": [1.0]}, tmp_path)


def test_units_of_what_is_written():
    inputs = ["hinges.splice.slack", "supports[0].rotation.stiffness", "hinges[0].stiffness"]
    function = gapbeam.function(SCENE, inputs, ["moment.max"])
    assert list(function.units.values()) == ["rad", "kN m/rad", "kN m/rad", "kN m"]
    assert function.nominal.tolist() == [0.002, 2e3, 1e3]
