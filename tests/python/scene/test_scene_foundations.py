"""Foundations from what users write to the columns that the Fortran layer takes, and to points of the beam."""

import pickle
import sys
import tomllib

import numpy as np
import pytest
from gapbeam.scene import Beam, Foundation, Scene, read_scene, scene_schema
from gapbeam.scene.columns import NOT_GIVEN
from gapbeam.scene.reading import read_beam
from gapbeam.scene.tables import Table

BEAM = {"spans": [6.0, 6.0, 6.0], "EI": 1.0e4}
TEXT = """
[[foundation]]
k = 5.0e3

[[foundation]]
from = 3.0
to = 9.0
k = [0.0, 4.0e3]
side = "below"
gap = [0.01, 0.0]

[[foundation]]
from = 2.0
side = "above"
profile = [[-1.0, 0.0], [9.5, 0.02], [30.0, 0.5]]
law = [[0.01, 40.0], [0.05, 60.0]]

[[foundation]]
gap = 0.02
law = { type = "plastic", stiffness = 4.0e3, limit = 40.0 }
"""


def test_all_keys_reach_the_engine():
    scene, beam = read_beam({"beam": BEAM} | tomllib.loads(TEXT))
    assert scene.foundation[1] == Foundation(from_=3.0, to=9.0, k=(0.0, 4e3), side="below", gap=(0.01, 0.0))
    c = beam.columns
    assert c.foundation_sides.tolist() == [0, 1, -1, 0, 0]  # one entry more than there are
    assert c.foundation[:6, :4].T.tolist() == [
        [0.0, NOT_GIVEN, 5e3, 5e3, 0.0, 0.0],
        [3.0, 9.0, 0.0, 4e3, 0.01, 0.0],
        [2.0, NOT_GIVEN, 0.0, 0.0, 0.0, 0.0],
        [0.0, NOT_GIVEN, 0.0, 0.0, 0.02, 0.02],
    ]
    assert c.table_foundations.tolist() == [3, 3, 3, 0]
    assert c.table[:, :3].T.tolist() == [[-1.0, 0.0, 2.0], [9.5, 0.02, 2.0], [30.0, 0.5, 2.0]]
    assert c.ground_law_foundations.tolist() == [3, 3, 4, 4, 0]
    assert c.ground_law[:2, :4].T.tolist() == [[0.01, 40.0], [0.05, 60.0], [0.01, 40.0], [0.02, 40.0]]
    assert beam.places.point_x.tolist() == [0.0, 2.0, 3.0, 6.0, 9.0, 9.5, 12.0, 18.0]
    assert beam.places.node_points.tolist() == list(range(8))


def test_without_foundations_the_columns_are_empty():
    c = read_beam({"beam": BEAM, "supports": [{"node": 0, "rotation": "fixed"}]})[1].columns
    assert (c.foundation.shape, c.table.shape, c.ground_law.shape) == ((14, 1), (3, 1), (3, 1))


def test_a_hardening_law_keeps_its_slope():
    law = {"type": "hardening", "stiffness": 4e3, "limit": 40.0, "slope": 1e3}
    (d, f), (far, most) = read_beam({"beam": BEAM, "foundation": [{"law": law}]})[1].columns.ground_law[:2, :2].T.tolist()
    assert (d, f, (most - f) / (far - d)) == (0.01, 40.0, 1e3)


@pytest.mark.parametrize("kind", [float, np.float32, int])
def test_a_profile_as_an_array(kind):
    points = np.array([[0, 0], [9, 2], [18, 0]], dtype=kind)
    as_lists = read_scene({"beam": BEAM, "foundation": [{"k": 1.0}, {"k": 1.0, "side": "below", "profile": points.tolist()}]})
    in_dicts = read_scene({"beam": BEAM, "foundation": [{"k": 1.0}, {"k": 1.0, "side": "below", "profile": points}]})
    items = [Foundation(k=1.0), Foundation(k=1.0, side="below", profile=points)]
    in_structs = read_scene(Scene(beam=Beam(**BEAM), foundation=items))
    assert in_dicts == in_structs == as_lists == read_scene(in_dicts) == pickle.loads(pickle.dumps(in_dicts))
    assert items[1].profile is points
    points[:] = 5
    assert in_dicts == as_lists


def test_no_object_a_point_of_a_profile():
    count = 100_000
    x = np.linspace(0.0, 18.0, count)
    made = {"beam": BEAM, "foundation": [{"k": 1.0, "side": "below", "profile": np.column_stack((x, np.sin(x)))}]}
    read_scene(made)
    before = sys.getallocatedblocks()
    scene, beam = read_beam(made)
    assert sys.getallocatedblocks() - before < count // 10
    assert beam.links == count - 1  # the ends of the spans are points of the profile
    assert np.array_equal(scene.foundation[0].profile[:, 0], x)


def test_columns_are_the_same_as_lists():
    table = {"from": np.array([0.0, 6.0]), "to": [4.0, 9.0], "k": [1.0, 2.0], "side": ["below", "above"], "gap": 0.01}
    rows = [{"from": 0.0, "to": 4.0, "k": 1.0, "side": "below", "gap": 0.01}, {"from": 6.0, "to": 9.0, "k": 2.0, "side": "above"}]
    rows[1]["gap"] = 0.01
    (one, beam), (other, expected) = (read_beam({"beam": BEAM, "foundation": made}) for made in (table, rows))
    assert isinstance(one.foundation, Table)
    assert one == other
    assert beam.columns == expected.columns


def test_columns_with_profiles_and_laws_become_rows():
    profiles, laws = [[[0.0, 0.1]], [[0.0, 0.2], [6.0, 0.3]]], [[[1.0, 2.0]], [[1.0, 3.0]]]
    table = {"side": ["below", "above"], "profile": profiles, "law": laws}
    rows = [{"side": side, "profile": p, "law": law} for side, p, law in zip(table["side"], profiles, laws, strict=True)]
    assert read_scene({"beam": BEAM, "foundation": table}) == read_scene({"beam": BEAM, "foundation": rows})


def test_the_schema_describes_them():
    foundation = scene_schema()["$defs"]["Foundation"]
    assert list(foundation["properties"]) == ["from", "to", "k", "side", "gap", "profile", "law", "shear", "name"]
    assert foundation["required"] == []
    assert "ot available" not in str(foundation)
    assert [kind["type"] for kind in foundation["properties"]["k"]["anyOf"]] == ["number", "array", "null"]
