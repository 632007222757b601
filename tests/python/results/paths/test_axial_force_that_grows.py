"""Axial forces that grow with the load factor (`N_with = "live"`): states between, events and buckling on the way."""

import math

import gapbeam
import numpy as np
import pytest
from gapbeam.report import report_text
from gapbeam.results.equilibrium import acting_axial_forces
from gapbeam.results.proof import proof_data
from mpmath import mp, mpf
from scenes import force, uniform

PE = math.pi**2
PINS = [{"node": 0}, {"node": 1}]
STOP = {"x": 0.5, "side": "below", "gap": 0.02}


def column(share, loads=(), **analysis):
    """A column of length, EI and load 1 beside a stop, under that many Euler loads."""
    beam = {"spans": [1.0], "EI": 1.0, "N": -share * PE}
    return {"beam": beam, "supports": [*PINS, STOP], "loads": list(loads) or [uniform(1.0)], "analysis": analysis}


def ground_beam(N, factor=1.0, **analysis):
    """A beam on one-sided ground and supports with gaps, all of whose loads are those of a factor."""
    return {
        "beam": {"spans": [4.0, 3.0, 5.0], "EI": 30.0, "N": [N * factor, 0.5 * N * factor, N * factor]},
        "supports": [{"node": 0}, {"node": 1, "side": "below", "gap": 0.01}, {"node": 3, "side": "below"}],
        "foundation": [{"from": 3.0, "to": 10.0, "k": 40.0, "side": "below", "gap": 0.02}],
        "loads": [uniform(2.0 * factor), force(8.5, -14.0 * factor)],
        "analysis": analysis,
    }


def factor_of_contact(share):
    """Load factor at which the column comes to its stop, by the closed form of a beam column."""

    def gap(factor):
        P = factor * mpf(-column(share)["beam"]["N"])
        k = mp.sqrt(P)
        return factor * ((1 / mp.cos(k / 2) - 1) / P**2 - 1 / (8 * P)) - mpf(0.02)

    with mp.workdps(40):
        return float(mp.findroot(gap, (mpf("0.01"), mpf(1) / share * mpf("0.999")), solver="anderson"))


@pytest.mark.parametrize("share", [0.5, 0.95, 2.0, 3.9])
def test_the_load_factor_of_contact(share):
    (event,) = gapbeam.solve(column(share, N_with="live", follow="events")).events
    assert event.factor == pytest.approx(factor_of_contact(share), rel=2e-15)


@pytest.mark.parametrize("N", [25.0, 3.0, -3.0, -5.0])
def test_every_step_is_that_of_axial_forces_given_there(N):
    result = gapbeam.solve(ground_beam(N, steps=5, N_with="live"))
    assert len(result.steps) == 5
    for step in result.steps:
        given = gapbeam.solve(ground_beam(N, step.factor)).steps[-1]
        np.testing.assert_allclose(step.reaction, given.reaction, rtol=0, atol=1e-13 * np.abs(given.reaction).max())
        assert step.unique == given.unique
        for name, one in step.extremes.items():
            for key, value in one.items():
                assert value.value == pytest.approx(given.extremes[name][key].value, rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("N", [25.0, -3.0, -5.0])
def test_at_its_event_contact_changes(N):
    """States of axial forces given a little below and above it have other contact; its zones and supports change nowhere else."""
    result = gapbeam.solve(ground_beam(N, follow="events", N_with="live"))
    assert result.status == "solved"
    factors = [event.factor for event in result.events]
    assert len(factors) >= 2

    def contact(factor):
        state = gapbeam.solve(ground_beam(N, factor)).steps[-1]
        return state.closed.tolist(), len(state.contact)

    ends = [0.0, *factors, 1.0]
    for k, factor in enumerate(factors, 1):
        below, above = contact(factor * (1 - 1e-9)), contact(factor * (1 + 1e-9))
        assert below != above
        assert contact(0.5 * (ends[k - 1] + factor)) == below
        assert contact(0.5 * (ends[k + 1] + factor)) == above


def test_a_column_buckles_where_its_force_has_grown_to_that():
    """Between two stops of the grid of load factors, to all digits."""
    result = gapbeam.solve(column(4.1, N_with="live", follow="events"))
    assert result.status == "buckles"
    assert "buckles above load factor 0.97560975609756" in result.reason
    steps = gapbeam.solve(column(4.1, N_with="live", steps=40))
    assert steps.status == "buckles"
    assert [step.factor for step in steps.steps] == [k / 40 for k in range(1, 40)]


def test_a_beam_lifts_off_and_buckles():
    path = gapbeam.solve(ground_beam(-7.0, follow="events", N_with="live"))
    assert path.status == "buckles"
    last = path.steps[-1].factor
    assert gapbeam.solve(ground_beam(-7.0, last * (1 - 1e-9))).status == "solved"
    assert gapbeam.solve(ground_beam(-7.0, last * (1 + 1e-9))).status == "buckles"


def test_a_path_ends_where_its_state_is_found_again():
    """Axial forces that grow with the load help to hold it down beyond what it bears before they are put on: a beam that is about
    to tip bears none of them. Values at its end ended the process."""
    scene = {
        "beam": {"spans": [4.0], "EI": 1e4}, "analysis": {"follow": "events"},
        "supports": [{"node": 0}, {"node": 1, "side": "below"}, {"node": 0, "direction": "axial"}],
        "loads": [{"type": "uniform", "q": 2.0, "case": "dead"}, {"type": "force", "x": 3.0, "F": -40.0},
                  {"type": "axial", "x": 2.0, "F": -10.0}],
    }  # fmt: skip
    path = gapbeam.solve(scene)
    assert path.status == "no-equilibrium"
    assert "above load factor 0.13333333" in path.reason
    assert "tips" in path.reason
    assert path.steps[-1].factor == pytest.approx(16.0 / 120.0, rel=1e-9)
    assert path.steps[-1].reaction[2] == pytest.approx(10.0 * path.steps[-1].factor, rel=1e-13)
    assert path.report()


def test_a_path_under_a_given_force_ends_where_its_state_is_found_again():
    """Some half a percent below the end that the path itself comes to."""
    scene = {
        "beam": {"spans": [4.0, 3.0], "EI": 2e4, "N": -30.0}, "analysis": {"follow": "events"},
        "supports": [{"node": k, "side": "below", "settlement": -0.003 * (k == 1)} for k in range(3)],
        "loads": [{"type": "uniform", "q": 2.5, "case": "dead"}, {"type": "force", "x": 0.8, "F": -72.0},
                  {"type": "force", "x": 5.9, "F": -22.0}], "hinges": [{"x": 3.9, "stiffness": 0.0, "slack": 0.001}],
    }  # fmt: skip
    path = gapbeam.solve(scene)
    assert path.status == "no-equilibrium"
    last = path.steps[-1]
    assert last.solution.status == 0
    assert sum(last.reaction) == pytest.approx(7.0 * 2.5 - 94.0 * last.factor, rel=1e-12)
    assert path.report()


def test_factors_of_buckling_are_those_of_the_axial_force_there():
    half, whole = (gapbeam.solve(column(share, N_with="live", buckling=2)) for share in (0.4, 0.8))
    np.testing.assert_allclose(half.buckling, np.multiply(whole.buckling, 2.0), rtol=1e-15)
    # In combinations all is there in full
    scene = column(0.8, [{**uniform(1.0), "case": "q"}], N_with="live")
    scene["combinations"] = [{"name": "A", "factors": {"q": 1.0}}]
    alone = gapbeam.solve(column(0.8)).steps[-1].reaction
    np.testing.assert_array_equal(gapbeam.solve(scene).combinations["A"].steps[-1].reaction, alone)


def test_sums_and_proofs_have_what_has_grown():
    """Half of the axial force at half of the loads."""
    result = gapbeam.solve(column(0.8, N_with="live", steps=2))
    for step, share in zip(result.steps, (0.4, 0.8), strict=True):
        assert acting_axial_forces(result, step) == [(0.0, 1.0, -share * PE, -share * PE)]
    scene = proof_data(column(0.8, N_with="live"), factor=0.5)["scene"]
    assert scene["beam"]["N"] == -0.4 * PE
    assert scene["loads"][0]["q"] == 0.5


def test_the_report_says_so():
    words = report_text(gapbeam.solve(column(0.5, N_with="live", steps=2)))
    assert "It grows with the load factor." in words
    assert "acts in full at every load factor" not in words
