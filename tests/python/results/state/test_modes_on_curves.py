"""Buckling and vibration about states on ground whose law is a curve, where the ground is as soft as its curve is steep."""

import math
import random

import gapbeam
import numpy as np
import pytest
from oracle.modes_by_ritz import Ritz
from scenes.curved import random_curved_scene

FREE = 4.730040744862704
"""First root of cos(b) cosh(b) = 1: a beam with both ends free."""


@pytest.mark.parametrize(
    ("law", "slope"),
    [
        ({"type": "tanh", "stiffness": 8.0, "limit": 5.0}, 8.0 * (1.0 - 0.6**2)),
        ({"type": "hyperbolic", "stiffness": 8.0, "limit": 5.0}, 8.0 * (1.0 - 0.6) ** 2),
        ({"type": "cubic", "k1": 2.0, "k3": 1.0}, 2.0 + 3.0),
    ],
)
def test_a_free_beam_that_sinks_everywhere_alike(law, slope):
    """It goes up and down, and rocks, at sqrt(k/m), and bends beyond."""
    data = {"beam": {"spans": [1.5, 2.5], "EI": 3.0, "mass": 0.5}, "foundation": [{"law": law}],
            "loads": [{"type": "uniform", "q": 3.0}], "analysis": {"frequencies": 3}}  # fmt: skip
    bends = math.sqrt((slope + 3.0 * (FREE / 4.0) ** 4) / 0.5)
    result = gapbeam.solve(data)
    assert result.frequencies == pytest.approx([math.sqrt(slope / 0.5), math.sqrt(slope / 0.5), bends], rel=1e-13)
    shape = result.mode("vibration", 3)
    assert abs(shape.deflection).max() == 1.0
    assert shape.deflection[0] == pytest.approx(shape.deflection[-1], rel=1e-9)


@pytest.mark.parametrize("N", [0.0, -1.0])
@pytest.mark.parametrize(
    "law",
    [
        {"type": "tanh", "stiffness": 8.0, "limit": 5.0},
        {"type": "cubic", "k1": 8.0, "k3": 1.0},
        {"type": "plastic", "stiffness": 8.0, "limit": 5.0},
        [(0.5, 4.0), (1.0, 5.0)],
    ],
)
def test_ground_that_holds_both_ways_holds_a_beam_at_rest(law, N):
    """Without any load it is as stiff as at first; it counted twice, or not at all, so that a pile without load buckled."""
    data = {"beam": {"spans": [4.0], "EI": 3.0, "mass": 0.5, "N": N}, "loads": [], "analysis": {"frequencies": 3, "buckling": 2}}
    held, yields = (gapbeam.solve({**data, "foundation": [one]}) for one in ({"k": 8.0}, {"law": law, "side": "both"}))
    assert yields.frequencies == pytest.approx(held.frequencies, rel=1e-13)
    assert yields.buckling == pytest.approx(held.buckling, rel=1e-13)
    assert not yields.steps[-1].indifferent
    zone, = yields.steps[-1].contact
    assert (zone.from_, zone.to) == (0.0, 4.0)


def test_ground_with_a_gap_does_not_hold_a_beam_at_rest():
    law = {"type": "tanh", "stiffness": 8.0, "limit": 5.0}
    data = {"beam": {"spans": [4.0], "EI": 3.0, "mass": 0.5}, "supports": [{"node": 0}, {"node": 1}], "loads": []}
    data |= {"foundation": [{"law": law, "gap": 0.1}], "analysis": {"frequencies": 1}}
    assert gapbeam.solve(data).frequencies == pytest.approx([math.pi**2 / 16.0 * math.sqrt(6.0)], rel=1e-13)


def with_masses(seed):
    """A scene of curves with a mass, half of them pressed along their axis so far that they bear it."""
    draw = random.Random(seed)
    data = random_curved_scene(seed)
    data["beam"].pop("GA", None)
    beam = data["beam"]
    beam["mass"] = draw.choice([0.2, 1.0, 5.0])
    if draw.random() < 0.6:
        beam["N"] = draw.choice([-0.4, -0.1, 3.0]) * beam["EI"] / beam["spans"][0] ** 2
    return {**data, "analysis": {"frequencies": 9, "buckling": 2}}


SEEDS = [1, 5, 10, 18, 26, 27]
"""Where the ground holds the beam as stiffly as it bends: else doubles of the other program lose what the ground holds."""


@pytest.mark.parametrize("seed", SEEDS)
def test_random_beams(seed):
    data = with_masses(seed)
    result = gapbeam.solve(data)
    assert result.status == "solved"
    runs = result.steps[-1].runs
    active = [k for k, state in enumerate(result.steps[-1].state) if state != "open"]
    ritz = Ritz(data, lambda x: result.at(x).deflection, [*(run.from_ for run in runs), *(run.to for run in runs)], active)
    assert len(result.frequencies) == 9
    np.testing.assert_allclose(result.frequencies, ritz.frequencies(9), rtol=1e-10)
    if data["beam"].get("N", 0.0) < 0.0:
        assert len(result.buckling) == 2
        np.testing.assert_allclose(result.buckling, ritz.buckling(2), rtol=1e-10)
