"""Supports that soften or break, under axial forces, on ground and with mass. Random ones are in `tests/attack/softening.py`."""

import math

import gapbeam
import numpy as np
import pytest
from scenes.law import law_scene

C = (0.5 - math.tanh(1.5) / 3.0) / 18.0
"""Deflection of the middle of a string (EI = 1, L = 1, N = 9) under a force of 1 there."""
SNAP = {"x": 0.5, "side": "below", "law": [[0.01, 1.0], [0.012, 0.2], [1.0, 0.2]]}


def string(**analysis):
    """A string on a prop that softens faster than it is stiff."""
    return {"beam": {"spans": [1.0], "EI": 1.0, "N": 9.0}, "supports": [{"node": 0}, SNAP, {"node": 1}],
            "loads": [{"type": "force", "x": 0.5, "F": 4.0}], "analysis": {"follow": "events", **analysis}}  # fmt: skip


def test_a_string_snaps_through():
    """It comes to rest on the last piece; what is released is the area between the load and what the path can bear."""
    result = gapbeam.solve(string(at_limit="jump"))
    top, bottom = (1.0 + 0.01 / C) / 4.0, (0.2 + 0.012 / C) / 4.0
    assert [event.event for event in result.events] == ["softens", "hardens"]
    assert result.limits[0].factor == pytest.approx(top, rel=1e-14)
    landed = C * (4.0 * top - 0.2)
    assert result.limits[0].released == pytest.approx(2.0 * (top - bottom) * (landed - 0.01), rel=1e-12)
    assert result.steps[-1].deflection[1] == pytest.approx(C * 3.8, rel=1e-13)
    assert gapbeam.solve(string()).limits[0].factor == pytest.approx(top, rel=1e-14)


def test_unstable_states_of_a_path():
    """On the way back the prop is on its falling piece, which no search from outside would find."""
    result = gapbeam.solve(string(at_limit="follow"))
    assert [(segment.stable, segment.index) for segment in result.path.segments] == [(True, 0), (False, 1), (True, 0)]
    assert [step.deflection[1] for step in result.steps] == pytest.approx([0.01, 0.012, C * 3.8], rel=1e-13)
    assert [step.reaction[1] for step in result.steps] == pytest.approx([1.0, 0.2, 0.2], rel=1e-13)


@pytest.mark.parametrize("seed", range(16))
def test_mass_changes_no_path(seed):
    """With mass the beam is solved in stretches, without it as links; the path is the same."""
    made = law_scene(seed, "softening" if seed % 4 else "broken")
    made["analysis"]["at_limit"] = ("jump", "follow")[seed % 2]
    heavy = {**made, "beam": {**made["beam"], "mass": 0.5}, "analysis": {**made["analysis"], "frequencies": 1}}
    plain, massive = gapbeam.solve(made), gapbeam.solve(heavy)
    assert massive.status == plain.status
    assert [(e.support, e.event) for e in massive.events] == [(e.support, e.event) for e in plain.events]
    assert [e.factor for e in massive.events] == pytest.approx([e.factor for e in plain.events], rel=1e-12, abs=1e-13)
    released = [[limit.released or 0.0 for limit in one.limits] for one in (massive, plain)]
    assert released[0] == pytest.approx(released[1], rel=1e-9, abs=1e-12)
    for one, two in zip(massive.steps, plain.steps, strict=True):
        size = np.abs(two.reaction).max() + np.abs(two.deflection).max()
        assert one.reaction == pytest.approx(two.reaction, abs=1e-12 * size)
        assert one.deflection == pytest.approx(two.deflection, abs=1e-12 * size)


def test_a_softening_prop_slows_a_beam_down():
    """A symmetric mode of a simple beam with a spring k in its middle: k = -4 EI b^3/(tan bl - tanh bl), l half its length."""
    law = [[0.01, 20.0], [0.05, 8.0], [1.0, 8.0]]
    scene = {"beam": {"spans": [10.0], "EI": 1e4, "mass": 1.0},
             "supports": [{"node": 0}, {"x": 5.0, "side": "below", "law": law}, {"node": 1}],
             "loads": [{"type": "uniform", "q": 4.4}], "analysis": {"follow": "events", "frequencies": 1}}  # fmt: skip
    result = gapbeam.solve(scene)
    assert [event.event for event in result.events] == ["softens"]
    b = math.sqrt(result.frequencies[0]) / 10.0
    assert -4e4 * b**3 / (math.tan(5.0 * b) - math.tanh(5.0 * b)) == pytest.approx(-300.0, rel=1e-11)


def test_a_strut_on_a_prop_that_snaps():
    """Under compression, u = 2 over the length: the deflection of the middle of a simple beam-column under a force of 1."""
    c = (math.tan(1.0) - 1.0) / 16.0
    scene = string(at_limit="follow") | {"beam": {"spans": [1.0], "EI": 1.0, "N": -4.0}}
    result = gapbeam.solve(scene)
    assert result.limits[0].factor == pytest.approx((1.0 + 0.01 / c) / 4.0, rel=1e-13)
    assert [step.deflection[1] for step in result.steps] == pytest.approx([0.01, 0.012, c * 3.8], rel=1e-12)
    assert [segment.index for segment in result.path.segments] == [0, 1, 0]


def test_back_at_no_load_nothing_is_left():
    """Rounding of what a law gives about its origin is no force, and no deflection."""
    law = [[28.4 / 8528.4, 28.4], [1.5 * 28.4 / 8528.4, 34.08], [0.01, 17.0], [0.1, 22.0]]
    scene = {"beam": {"spans": [2.57, 3.11, 7.64, 6.19, 7.78], "EI": 605.1, "mass": 1.0},
             "supports": [{"node": 0}, {"node": 1, "stiffness": 2002.1}, {"node": 2}, {"node": 3, "side": "above"},
                          {"node": 4, "side": "below", "stiffness": 633.6}, {"node": 5, "side": "both", "law": law}],
             "loads": [{"type": "uniform", "q": 48.7}],
             "analysis": {"follow": "events", "history": [1.0, 0.0], "at_limit": "follow", "frequencies": 1}}  # fmt: skip
    state = gapbeam.solve(scene).steps[-1]
    assert not state.reaction.any()
    assert not state.deflection.any()
