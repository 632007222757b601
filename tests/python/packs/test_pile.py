"""The ground of a pile: layers beside the curves at every depth, and a pile in it."""

import gapbeam
import numpy as np
import pytest
from gapbeam import packs

LAYERS = [
    {"law": "matlock_clay", "to": 6.0, "cu": (20.0, 32.0), "gamma": 8.0, "eps50": 0.01},
    {"law": "reese_clay", "to": 9.0, "cu": (90.0, 120.0), "gamma": 9.0, "eps50": 0.005, "J": 0.25},
    {"law": "api_sand", "to": 20.0, "phi": 35.0, "gamma": 10.0},
]
D = 0.6


def weight(z):
    """Unit weight above a depth, on average."""
    return np.interp(z, [0.0, 6.0, 9.0, 20.0], [0.0, 48.0, 75.0, 185.0]) / z


@pytest.fixture(scope="module")
def ground():
    return packs.pile_ground(LAYERS, D=D)


def test_clay_is_linear_between_depths_within_one_per_cent(ground):
    for layer, one in zip(LAYERS[:2], ground, strict=False):
        places = [at["x"] for at in one["law"]]
        table = np.array([at["points"] for at in one["law"]])
        for z in np.linspace(max(one["from"], 0.01), one["to"], 301):
            between = (z - one["from"]) / (one["to"] - one["from"])
            cu = float(np.interp(between, [0.0, 1.0], layer["cu"]))
            given = {"D": D, "cu": cu, "gamma": weight(z), "eps50": layer["eps50"], "J": layer.get("J", 0.5)}
            if layer["law"] == "reese_clay":
                given["average_cu"] = 0.5 * (layer["cu"][0] + cu)
            exact = np.array(getattr(packs, layer["law"])(z, **given))
            got = np.array([[np.interp(z, places, table[:, k, column]) for column in (0, 1)] for k in range(table.shape[1])])
            assert got[:, 0] == pytest.approx(exact[:, 0], rel=1e-12)
            assert got[:, 1] == pytest.approx(exact[:, 1], rel=0.01)


def test_sand_is_linear_between_depths_within_one_per_cent(ground):
    law = ground[2]["law"]
    assert (ground[2]["from"], ground[2]["to"]) == (9.0, 20.0)
    for z in np.linspace(9.0, 20.0, 301):
        exact = packs.api_sand(z, D=D, phi=35.0, gamma=weight(z))
        assert np.interp(z, *zip(*law["limit"], strict=True)) == pytest.approx(exact["limit"], rel=0.01)
        assert np.interp(z, [9.0, 20.0], law["stiffness"]) == pytest.approx(exact["stiffness"], rel=1e-12)


def test_sand_from_the_ground_changes_where_its_formulas_change():
    law = packs.pile_ground([{"law": "api_sand", "to": 12.0, "phi": 35.0, "gamma": 10.0, "k": 2e4}], D=D)[0]["law"]
    assert law["stiffness"] == (0.0, 2.4e5)
    assert law["limit"][0] == (0.0, 0.0)
    assert 2.1 / 0.8 * D in [place for place, _ in law["limit"]]


def test_a_pile_in_three_layers(ground):
    """Forces and moments balance, the soil carries no more than it can, and finer layers change nothing that matters."""
    scene = {"beam": {"spans": [20.0], "EI": 1.5e5}, "foundation": ground, "loads": [{"type": "force", "x": 0.0, "F": 150.0}]}
    result = gapbeam.solve(scene)
    assert result.status == "solved"
    assert sum(zone.resultant for zone in result.steps[-1].contact) == pytest.approx(150.0, rel=1e-9)
    halves = [dict(layer) for layer in LAYERS]
    halves[:1] = [LAYERS[0] | {"to": 3.0, "cu": (20.0, 26.0)}, LAYERS[0] | {"cu": (26.0, 32.0)}]
    finer = gapbeam.solve(scene | {"foundation": packs.pile_ground(halves, D=D)})
    assert float(finer.at(0.0).deflection) == pytest.approx(float(result.at(0.0).deflection), rel=2e-3)
    assert finer.extremes["moment"]["min"].value == pytest.approx(result.extremes["moment"]["min"].value, rel=2e-3)


@pytest.mark.parametrize(
    ("layers", "message"),
    [
        ([], "pile_ground: layers: has no layer; give the layers from the ground down"),
        ([{"law": "clay"}], "pile_ground: layers[0].law: expected matlock_clay, reese_clay, api_sand, got 'clay'"),
        ([{"law": "api_sand", "to": 2.0, "gamma": 9.0}], "pile_ground: layers[0]: has no phi; api_sand needs to, gamma, phi"),
        ([LAYERS[0] | {"phi": 30.0}], "pile_ground: layers[0].phi: is no key of matlock_clay; it has to, gamma, cu, eps50, J"),
        ([LAYERS[0], LAYERS[1] | {"to": 5}], "pile_ground: layers[1].to: expected a depth below 6, where the layer begins, got 5"),
        ([LAYERS[2] | {"gamma": 0.0}], "pile_ground: layers[0]: gamma: expected a number above 0, got 0"),
        ([LAYERS[2] | {"phi": 60.0}], "api_sand: phi: expected 20 to 45, got 60"),
    ],
)
def test_what_makes_no_sense_is_refused(layers, message):
    with pytest.raises(gapbeam.SceneError) as error:
        packs.pile_ground(layers, D=D)
    assert str(error.value) == message
