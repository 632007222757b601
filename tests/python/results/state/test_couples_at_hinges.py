"""Couples exactly at a hinge, on the part of the beam left or right of it."""

import random

import gapbeam
import numpy as np
import pytest
from gapbeam import SceneError
from gapbeam.studies.exact import Reference

L, OVER, EI, M = 2.0, 3.0, 100.0, 6.0
GERBER = {"beam": {"spans": [L, OVER], "EI": EI, "hinges": [L]}, "supports": [{"node": 0, "rotation": "fixed"}, {"node": 2}]}


def couple(side, **keys):
    return {"type": "moment", "node": 1, "M": M, "at_hinge": side} | keys


def test_left_of_the_hinge():
    """The cantilever bends to M L^2/2EI with M all along, nothing is felt right of the hinge."""
    result = gapbeam.solve(GERBER | {"loads": [couple("left")]})
    assert result.at([0.0, 1.0, 1.999]).moment == pytest.approx([-M, -M, -M], rel=1e-14)
    assert result.at(L).deflection == pytest.approx(M * L**2 / (2 * EI), rel=1e-14)
    assert result.at(4.0).moment == 0.0
    assert np.abs(result.steps[-1].reaction).max() == 0.0
    cut = gapbeam.solve(GERBER | {"loads": [couple("left"), {"type": "force", "x": 1.5, "F": 1.0}]})
    assert cut.at([0.0, 1.5, 1.75, 1.999]).moment == pytest.approx([-M - 1.5, -M, -M, -M], rel=1e-14)


def test_right_of_the_hinge():
    """The simple part takes it by a force M/L at its ends, which the cantilever feels."""
    result = gapbeam.solve(GERBER | {"loads": [couple("right")]})
    assert result.steps[-1].reaction == pytest.approx([-M / OVER, M / OVER], rel=1e-14)
    assert result.at([0.0, L + OVER / 2, L + OVER]).moment == pytest.approx([M / OVER * L, M / 2, 0.0], abs=1e-14)
    assert result.extremes["moment"]["max"].value == pytest.approx(M, rel=1e-14)


@pytest.mark.parametrize("side", ["left", "right"])
def test_the_study_knows_the_side(side):
    result = gapbeam.solve(GERBER | {"loads": [couple(side), {"type": "uniform", "q": 1.0}]})
    exact = Reference(result.scene)
    assert exact.solve(result.steps[-1].state)
    assert result.steps[-1].reaction == pytest.approx(list(map(float, exact.reaction)), rel=1e-14)


def test_as_columns():
    """Loads as columns, one side for all of them or one each."""
    row = gapbeam.solve(GERBER | {"loads": [couple("left")]})
    for side in ("left", np.array(["left"])):
        column = gapbeam.solve(GERBER | {"loads": {"type": "moment", "x": np.array([L]), "M": np.array([M]), "at_hinge": side}})
        assert column.at(1.0).moment == row.at(1.0).moment == -M


@pytest.mark.parametrize("seed", range(12))
def test_limit_of_couples_aside(seed):
    """Beams with pieces, one-sided supports and tapers: what couples 1e-7 aside tend to."""
    rng = random.Random(seed)
    spans = [rng.uniform(1.0, 4.0) for _ in range(3)]
    end, hinge = sum(spans), spans[0] + rng.uniform(0.3, 0.7) * spans[1]
    side, value = rng.choice(["left", "right"]), rng.uniform(-9.0, 9.0)
    scene = {
        "beam": {"spans": spans, "EI": 100.0, "GA": rng.choice([np.inf, 80.0]), "hinges": [hinge]},
        "supports": [{"node": 0, "rotation": "fixed"}, {"node": 1}, {"node": 2, "side": rng.choice(["below", "both"])},
                     {"node": 3}],
        "sections": [{"from": hinge, "to": end, "EI": [100.0, 300.0]}] if rng.random() < 0.5 else [],
    }  # fmt: skip
    loads = [{"type": "uniform", "q": 4.0}, {"type": "force", "x": hinge + rng.choice([-0.1, 0.1]), "F": rng.uniform(0.0, 5.0)}]
    exact = gapbeam.solve(scene | {"loads": [*loads, {"type": "moment", "x": hinge, "M": value, "at_hinge": side}]})
    aside = hinge + (1e-7 if side == "right" else -1e-7)
    near = gapbeam.solve(scene | {"loads": [*loads, {"type": "moment", "x": aside, "M": value}]})
    x = np.linspace(0.0, end, 14)
    for quantity in ("deflection", "moment", "rotation", "shear"):
        one, other = getattr(exact.at(x), quantity), getattr(near.at(x), quantity)
        assert np.abs(one - other).max() <= 1e-5 * np.abs(other).max(), quantity
    assert np.abs(exact.steps[-1].reaction - near.steps[-1].reaction).max() <= 1e-5 * np.abs(near.steps[-1].reaction).max()


def test_cases_and_events():
    """Prepared cases and a path take it; half the couple opens a support at half the factor."""
    loads = [couple("right"), {"type": "uniform", "q": 2.0, "case": "dead"}]
    cases = gapbeam.prepare(GERBER | {"loads": loads}).solve(np.array([[1.0, 0.0], [2.0, 1.0]]))
    for k, factors in enumerate(((1.0, 0.0), (2.0, 1.0))):
        one = gapbeam.solve(GERBER | {"loads": [couple("right", M=factors[0] * M), {"type": "uniform", "q": 2.0 * factors[1]}]})
        assert cases.reaction[k] == pytest.approx(one.steps[-1].reaction, rel=1e-14)
        assert cases.extremes["moment"]["max"].value[k] == pytest.approx(one.extremes["moment"]["max"].value, rel=1e-14)
    supports = [GERBER["supports"][0], {"node": 2, "side": "below"}, {"node": 2, "side": "above", "gap": 0.01}]
    path = gapbeam.solve(GERBER | {"supports": supports, "loads": [couple("right", M=-18.0), loads[1]],
                                   "analysis": {"follow": "events"}})  # fmt: skip
    assert (path.status, path.events[0].event, path.events[0].support) == ("solved", "opens", 1)
    assert path.events[0].factor == pytest.approx(0.5, rel=1e-14)


@pytest.mark.parametrize(("changes", "words"), [
    ({"loads": [{"type": "moment", "node": 1, "M": 1.0}]}, 'say at_hinge = "left" or "right"'),
    ({"loads": [{"type": "moment", "x": 1.0, "M": 1.0, "at_hinge": "left"}]}, "loads[0].at_hinge: there is no hinge at its place"),
    ({"loads": [couple("middle")]}, 'loads[0].at_hinge: expected "left" or "right"'),
])  # fmt: skip
def test_refused(changes, words):
    with pytest.raises(SceneError) as caught:
        gapbeam.solve(GERBER | changes)
    assert words in str(caught.value)
