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


def test_clay_is_linear_between_depths_as_stated(ground):
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
            assert got[:, 1] == pytest.approx(exact[:, 1], rel=0.002)


def test_sand_is_linear_between_depths_as_stated(ground):
    law = ground[2]["law"]
    assert (ground[2]["from"], ground[2]["to"]) == (9.0, 20.0)
    for z in np.linspace(9.0, 20.0, 301):
        exact = packs.api_sand(z, D=D, phi=35.0, gamma=weight(z))
        assert np.interp(z, *zip(*law["limit"], strict=True)) == pytest.approx(exact["limit"], rel=0.002)
        assert np.interp(z, [9.0, 20.0], law["stiffness"]) == pytest.approx(exact["stiffness"], rel=1e-12)


def test_sand_from_the_ground_changes_where_its_formulas_change():
    law = packs.pile_ground([{"law": "api_sand", "to": 12.0, "phi": 35.0, "gamma": 10.0, "k": 2e4}], D=D)[0]["law"]
    assert law["stiffness"] == (0.0, 2.4e5)
    assert law["limit"][0] == (0.0, 0.0)
    assert 2.1 / 0.8 * D in [place for place, _ in law["limit"]]


def test_a_pile_in_three_layers(ground):
    """Forces balance, and a layer in two halves changes nothing that matters."""
    scene = {"beam": {"spans": [20.0], "EI": 1.5e5}, "foundation": ground, "loads": [{"type": "force", "x": 0.0, "F": 150.0}]}
    result = gapbeam.solve(scene)
    assert result.status == "solved"
    assert sum(zone.resultant for zone in result.steps[-1].contact) == pytest.approx(150.0, rel=1e-9)
    halves = [dict(layer) for layer in LAYERS]
    halves[:1] = [LAYERS[0] | {"to": 3.0, "cu": (20.0, 26.0)}, LAYERS[0] | {"cu": (26.0, 32.0)}]
    finer = gapbeam.solve(scene | {"foundation": packs.pile_ground(halves, D=D)})
    assert float(finer.at(0.0).deflection) == pytest.approx(float(result.at(0.0).deflection), rel=2e-3)
    assert finer.extremes["moment"]["min"].value == pytest.approx(result.extremes["moment"]["min"].value, rel=2e-3)


def by_springs(load, pieces=300):
    """Deflection and least moment of a pile in clay, cu = 20 + 2 z: beam elements, springs on Matlock's own curve, no gapbeam."""
    L, EI, y50 = 15.0, 1.5e5, 2.5 * 0.01 * D
    h, z = L / pieces, np.linspace(0.0, L, pieces + 1)
    cu = 20.0 + 2.0 * z
    most = np.minimum(3.0 * cu * D + 8.0 * z * D + 0.5 * cu * z, 9.0 * cu * D)
    share = np.full(z.size, h)
    share[[0, -1]] = h / 2.0
    k = EI / h**3 * np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
                              [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]])  # fmt: skip
    K, force = np.zeros((2 * z.size, 2 * z.size)), np.zeros(2 * z.size)
    for i in range(pieces):
        K[2 * i : 2 * i + 4, 2 * i : 2 * i + 4] += k
    force[0] = load
    w = np.full(2 * z.size, 0.01)
    for _ in range(60):  # secant stiffness of every spring
        y = np.maximum(np.abs(w[::2]), 1e-9)
        stiffness = 0.5 * most * np.minimum(np.cbrt(y / y50), 2.0) / y * share
        before, w = w, np.linalg.solve(K + np.diag(np.ravel(np.column_stack((stiffness, 0.0 * stiffness)))), force)
        if np.abs(w - before).max() < 1e-8:
            break
    reaction = stiffness * w[::2]
    moment = np.array([reaction[:i] @ (z[i] - z[:i]) - load * z[i] for i in range(z.size)])
    return w[0], moment.min()


@pytest.mark.parametrize("load", [40.0, 120.0, 160.0])
def test_a_pile_in_soft_clay_beside_springs_on_the_curve_itself(load):
    clay = {"law": "matlock_clay", "to": 15.0, "cu": (20.0, 50.0), "gamma": 8.0, "eps50": 0.01}
    loads = [{"type": "force", "x": 0.0, "F": load}]
    result = gapbeam.solve({"beam": {"spans": [15.0], "EI": 1.5e5}, "foundation": packs.pile_ground([clay], D=D), "loads": loads})
    head, moment = by_springs(load)
    assert float(result.at(0.0).deflection) == pytest.approx(head, rel=0.015)
    assert result.extremes["moment"]["min"].value == pytest.approx(moment, rel=0.005)
    assert float(result.at(0.0).deflection) > head  # polylines are below the curve


@pytest.mark.parametrize(
    ("layers", "message"),
    [
        ([], "pile_ground: layers: has no layer; give the layers from the ground down"),
        ([{"law": "clay"}], "pile_ground: layers[0].law: expected matlock_clay, reese_clay, api_sand, got 'clay'"),
        ([{"law": "api_sand", "to": 2.0, "gamma": 9.0}], "pile_ground: layers[0]: has no phi; api_sand needs to, gamma, phi"),
        (
            [LAYERS[0] | {"phi": 30.0}],
            "pile_ground: layers[0].phi: is no key of matlock_clay; it has to, gamma, cu, eps50, J, cyclic",
        ),
        ([LAYERS[0], LAYERS[1] | {"to": 5}], "pile_ground: layers[1].to: expected a depth below 6, where the layer begins, got 5"),
        ([LAYERS[2] | {"gamma": 0.0}], "pile_ground: layers[0]: gamma: expected a number above 0, got 0"),
        ([LAYERS[0] | {"to": "5 m"}], "pile_ground: layers[0]: to: expected a number above 0, got '5 m'"),
        (
            [LAYERS[0] | {"cu": (1.0, 2.0, 3.0)}],
            "pile_ground: layers[0].cu: expected a number, or a pair at the top and at the bottom, got (1.0, 2.0, 3.0)",
        ),
        (LAYERS[0], "pile_ground: layers[0]: expected the keys of a layer, got 'law'"),
        ([LAYERS[2] | {"phi": 60.0}], "api_sand: phi: expected 20 to 45, got 60"),
    ],
)
def test_what_makes_no_sense_is_refused(layers, message):
    with pytest.raises(gapbeam.SceneError) as error:
        packs.pile_ground(layers, D=D)
    assert str(error.value) == message
