"""Curvature along the beam: M/EI less what is imposed, in every place that tells of a quantity."""

import json
import math
import random

import gapbeam
import numpy as np
import pytest
from gapbeam.engine.quantities import BENDING, FIELDS, QUANTITIES
from scenes import INF, random_scene

SOFT, STIFF = 1.0e4, 4.0e4
BEAM = {
    "units": {"force": "kN", "length": "m"},
    "beam": {"spans": [6.0, 6.0, 6.0], "EI": [SOFT, STIFF, INF]},
    "supports": [{"node": i, "side": "below"} for i in range(4)],
    "loads": [{"type": "uniform", "q": 2.0, "case": "dead"}, {"type": "force", "x": 3.0, "F": 160.0},
              {"type": "curvature", "kappa": 1e-3, "from": 2.0, "to": 14.0}],
}  # fmt: skip


def curvature_of(result, x, side="right", factor=1.0):
    """From the moment."""
    x = np.asarray(x, dtype=float)
    inside = (lambda a, b: (x >= a) & (x < b)) if side == "right" else (lambda a, b: (x > a) & (x <= b))
    softness = np.where(inside(0, 6), 1 / SOFT, np.where(inside(6, 12), 1 / STIFF, 0.0))
    return softness * result.at(x, side=side).moment - np.where(inside(2, 14), factor * 1e-3, 0.0)


@pytest.mark.parametrize("side", ["right", "left"])
def test_it_is_the_moment_over_the_stiffness_less_what_is_imposed(side):
    result = gapbeam.solve(BEAM)
    x = np.array([0.5, 2.0, 3.0, 5.0, 6.0, 7.0, 12.0, 13.0, 14.0, 15.0])
    np.testing.assert_allclose(result.at(x, side=side).curvature, curvature_of(result, x, side), rtol=0, atol=1e-17)
    assert result.at(15.0).curvature == 0.0  # rigid
    assert result.at(13.0).curvature == -1e-3


def test_it_is_the_second_derivative_of_the_deflection():
    result, h = gapbeam.solve(BEAM), 1e-3
    x = np.array([0.5, 1.5, 2.5, 4.0, 5.0, 7.0, 8.0, 13.0, 16.0])
    bent = (result.at(x + h).deflection - 2 * result.at(x).deflection + result.at(x - h).deflection) / h**2
    np.testing.assert_allclose(-bent, result.at(x).curvature, rtol=0, atol=1e-9)


def test_shear_deformation_does_not_bend():
    one = gapbeam.solve({**BEAM, "beam": {"spans": [6.0], "EI": SOFT, "GA": 500.0}, "supports": BEAM["supports"][:2],
                         "loads": [{"type": "uniform", "q": 2.0}]})  # fmt: skip
    assert math.isclose(one.at(3.0).curvature, 9.0 / SOFT, rel_tol=1e-14)


def test_extremes_are_on_the_side_on_which_the_beam_bends_more():
    extremes = gapbeam.solve(BEAM)._pairs_of_extremes()
    assert extremes["curvature"]["max"] == pytest.approx((extremes["moment"]["max"][0] / SOFT - 1e-3, 3.0), rel=1e-13)
    # The moment above the support is the same on both sides; the softer span bends more
    assert extremes["curvature"]["min"] == pytest.approx((extremes["moment"]["min"][0] / SOFT - 1e-3, 6.0), rel=1e-13)


@pytest.mark.parametrize("seed", range(40))
def test_extremes_are_those_of_many_places(seed):
    result = gapbeam.solve(random_scene(random.Random(seed)))
    if result.status != "solved":
        pytest.skip("not solved")
    places = np.concatenate([result.fields(points=200).x, [one.x for one in result.extremes["curvature"].values()]])
    both = np.concatenate([result.at(places, side=side).curvature for side in ("left", "right")])
    extremes = result._pairs_of_extremes()["curvature"]
    size = max(abs(both).max(), 1e-300)
    assert extremes["max"][0] == pytest.approx(both.max(), abs=1e-12 * size)
    assert extremes["min"][0] == pytest.approx(both.min(), abs=1e-12 * size)


def test_cases_side_by_side_have_what_one_by_one_have():
    rng = np.random.default_rng(5)
    factors = rng.uniform(-1.0, 2.0, (40, 3))
    cases = gapbeam.prepare(BEAM).solve(factors)
    extremes, fields, x = cases.extremes["curvature"], cases.at([1.0, 6.0, 7.5, 13.0]), [1.0, 6.0, 7.5, 13.0]
    solved = 0
    for k, row in enumerate(factors):
        loads = [{**load, **{key: load[key] * factor for key in ("q", "F", "kappa") if key in load}}
                 for load, factor in zip(BEAM["loads"], row, strict=True)]  # fmt: skip
        one = gapbeam.solve({**BEAM, "loads": loads})
        if one.status != "solved":
            assert cases.status[k]
            continue
        solved += 1
        size = max(abs(one._pairs_of_extremes()["curvature"][kind][0]) for kind in ("max", "min"))
        np.testing.assert_allclose(fields.curvature[k], one.at(x).curvature, rtol=0, atol=1e-13 * size)
        for kind in ("max", "min"):
            assert extremes[kind].value[k] == pytest.approx(one._pairs_of_extremes()["curvature"][kind][0], abs=1e-13 * size)
    assert solved > 20


def test_spans_that_differ_by_case():
    stiffness = np.array([[SOFT, STIFF, 1e5], [2e4, 1e4, 5e4]])
    cases = gapbeam.prepare(BEAM).solve(np.ones((2, 3)), EI={0: stiffness[:, 0], 1: stiffness[:, 1], 2: stiffness[:, 2]})
    for k in range(2):
        one = gapbeam.solve({**BEAM, "beam": {"spans": [6.0, 6.0, 6.0], "EI": stiffness[k].tolist()}})
        for kind in ("max", "min"):
            assert cases.extremes["curvature"][kind].value[k] == pytest.approx(
                one._pairs_of_extremes()["curvature"][kind][0], rel=1e-12)  # fmt: skip


def test_combinations_have_an_envelope_of_it():
    factors = {"a": {"dead": 1.35, "live": 1.0}, "b": {"dead": 1.0}}
    result = gapbeam.solve({**BEAM, "combinations": [{"name": name, "factors": one} for name, one in factors.items()]})
    envelope = result.envelope()
    largest = max(result.combinations[name]._pairs_of_extremes()["curvature"]["max"][0] for name in "ab")
    assert envelope.extremes["curvature"]["max"].value == pytest.approx(largest, rel=1e-14)
    found = json.loads(result.to_json())
    assert list(found["envelope"]["extremes"])[-1] == "curvature"
    assert envelope.fields.largest["curvature"].max() <= largest * (1 + 1e-14)


def test_over_the_whole_path():
    made = {**BEAM, "analysis": {"follow": "events"}}
    result = gapbeam.solve(made)
    found = result.to_dict()
    assert list(found["extremes"])[-1] == "curvature"
    assert "curvature" in found["history_extremes"]
    assert list(found["fields"]) == ["x", "deflection", "rotation", "moment", "shear", "curvature"]


@pytest.mark.parametrize("ground", [False, True])
def test_trains_bend_the_softer_span_more(ground):
    made = {**BEAM, "trains": [{"name": "crane", "axles": [[0.0, 20.0], [2.0, 30.0]]}]}
    if ground:
        made = {**made, "supports": BEAM["supports"][::3], "foundation": [{"from": 4.0, "to": 14.0, "k": 2e3}],
                "beam": {"spans": [6.0, 6.0, 6.0], "EI": [SOFT, STIFF, 1e5]}}  # fmt: skip
    result = gapbeam.solve(made)
    envelope = result.envelope()
    for kind in ("max", "min"):
        one = envelope.extremes["curvature"][kind]
        there = result.at(one.x, position=one.position, side=one.side or "right")
        assert there.curvature == pytest.approx(one.value, rel=1e-9)
    largest, smallest = envelope.fields.largest["curvature"], envelope.fields.smallest["curvature"]
    assert largest.max() <= envelope.extremes["curvature"]["max"].value * (1 + 1e-9)
    smooth = ~np.isin(envelope.fields.x, [2.0, 6.0, 12.0, 14.0])  # elsewhere it does not jump
    for position in np.linspace(0.0, 20.0, 23):
        there = result.trains["crane"].state(position).fields(envelope.fields.x).curvature
        assert (there <= largest + 1e-9 * abs(largest).max())[smooth].all()
        assert (there >= smallest - 1e-9 * abs(largest).max())[smooth].all()


def test_influence_line_of_it():
    result = gapbeam.solve({**BEAM, "trains": [{"name": "crane", "axles": [[0.0, 20.0]]}]})
    train = result.trains["crane"]
    x = np.linspace(0.5, 5.5, 6)
    curvature, moment = (train.influence(what, x=3.0, places=x, position=3.0).values for what in ("curvature", "moment"))
    np.testing.assert_allclose(curvature, moment / SOFT, rtol=1e-14)


def test_it_stands_in_tables_and_pictures_but_not_in_the_report():
    pytest.importorskip("matplotlib")
    result = gapbeam.solve(BEAM)
    assert "curvature" in result.table("fields")
    assert "curvature" not in result.report()
    axes = result.plot("curvature").axes[0]
    assert axes.get_ylabel() == "curvature [1/m]"
    assert axes.yaxis_inverted()


def test_quantities_are_declared_in_the_order_of_the_engine():
    assert FIELDS[:7] == ("deflection", "rotation", "moment", "shear", "axial_force", "axial_displacement", "pressure")
    assert [one.name for one in QUANTITIES if one.of == "bending"] == list(BENDING) == [*FIELDS[:4], "curvature"]
