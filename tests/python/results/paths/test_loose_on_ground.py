"""Beams without weight that are loose between gaps: they touch the ground with next to nothing, or next to nothing holds a part."""

import gapbeam
import pytest
from mpmath import findroot, mp, mpf, sqrt
from oracle.foundation import solve as reference
from scenes.plain import force

BELOW, ABOVE, GAP, LENGTH = 1e4, 1e3, 0.005, 7.0
PLACES = (0.0, 5.0, 9.0)
BETWEEN = [{"k": BELOW, "side": "below", "gap": GAP}, {"k": ABOVE, "side": "above", "gap": GAP}]


def between_gaps(load, **more):
    """A beam between two grounds, pressed down at its left end."""
    return {"beam": {"spans": [3.0, 4.0], "EI": 1e4}, "loads": [force(0.0, load)], "foundation": BETWEEN, **more}


def deflections(result, places, factor=None):
    return [float(result.at(x, factor=factor).deflection) for x in places]


def wedges(load):
    """Deflections of the ends of a rigid one: by wedges of pressure, lengths a and b, slope (2 gap)/(L - a - b)."""

    def pressures(a, b):
        slope = 2 * mpf(GAP) / (mpf(LENGTH) - a - b)
        return slope, BELOW * slope * a**2 / 2, ABOVE * slope * b**2 / 2

    def unbalanced(a, b):
        _, left, right = pressures(a, b)
        return (left - right) / load - 1, (left * a / 3 - right * (mpf(LENGTH) - b / 3)) / (load * a)

    with mp.workdps(40):
        a = sqrt(2 * mpf(load) * LENGTH / (BELOW * 2 * GAP))
        b = sqrt(2 * mpf(load) * a / (3 * ABOVE * 2 * GAP))
        a, b = findroot(unbalanced, (a, b), tol=1e-50, maxsteps=200)
        slope = pressures(a, b)[0]
        return float(GAP + slope * a), float(-GAP - slope * b)


@pytest.mark.parametrize("load", [10.0, 1e-2, 1e-5, 1e-8, 1e-10])
def test_a_rigid_beam_touches_by_wedges_however_short_they_are(load):
    made = between_gaps(load)
    made["beam"]["EI"] = float("inf")
    result = gapbeam.solve(made)
    assert result.status == "solved"
    assert deflections(result, (0.0, LENGTH)) == pytest.approx(wedges(load), rel=1e-15, abs=0)


def test_its_load_is_followed_from_zero():
    result = gapbeam.solve(between_gaps(24.0, analysis={"follow": "events"}))
    assert (result.status, result.events) == ("solved", [])
    assert len(result.state(1e-6).contact) == 2


FLAPS = {
    "beam": {"spans": [4.0, 2.0, 3.0], "EI": 2000.0, "hinges": [6.0]},
    "supports": [{"node": 1, "side": "below", "gap": 0.002}, {"node": 1, "side": "above"}],
    "foundation": [{"k": 1000.0, "side": "below", "gap": 0.005, "from": 0.5, "to": 8.8},
                   {"k": 10000.0, "side": "above", "gap": 0.001}],
    "loads": [force(0.0, 21.0)],
}  # fmt: skip


def test_a_part_beyond_a_hinge_is_followed_with_it():
    """It turns through the clearance until both its ends touch, by forces of millionths of the load."""
    result = gapbeam.solve({**FLAPS, "analysis": {"follow": "events"}})
    assert [event.event for event in result.events] == ["closes"]
    factor = result.events[0].factor
    for share, holds in ((0.999, False), (1.001, True)):
        right = reference(FLAPS, factor * share)
        assert (abs(right.supports[1].reaction) > 0) == holds
        assert deflections(result, PLACES, factor * share) == pytest.approx([float(right.w(x)) for x in PLACES], rel=1e-13)


def test_a_path_goes_on_where_states_next_to_a_change_cannot_be_settled():
    """A part whose hinge meets the ground turns until its other end does: next to there forces have no digits."""
    made = {
        "beam": {"spans": [3.166, 4.822, 3.113, 1.699], "EI": 64000.0, "hinges": [1.8158]},
        "supports": [{"node": 0, "side": "below", "gap": 0.00706, "stiffness": 10000.0}],
        "foundation": [{"k": 5000.0, "side": "below"}, {"k": 1000.0, "side": "above", "gap": 0.005}],
        "loads": [force(10.21, -38.06231977467491)],
    }
    result = gapbeam.solve({**made, "analysis": {"follow": "events"}})
    assert result.status == "solved"
    assert [event.event for event in result.events] == ["zone appears"] * 2
    first, second = (event.factor for event in result.events)
    assert second == pytest.approx(first, rel=1e-8)
    assert result.path.solves < 3000, "by halves it takes twice as many, beside those that lead nowhere"
    right = reference(made, 0.882)
    assert 0 < 0.882 - second < 1e-3
    assert sum(len(zones) for zones in right.contact) == len(result.state(0.882).contact) == 3
    assert deflections(result, PLACES, 0.882) == pytest.approx([float(right.w(x)) for x in PLACES], rel=1e-13)


@pytest.mark.parametrize("times", [0.078, 0.09, 0.12])
def test_what_hangs_at_a_hinge_without_load_changes_nothing(times):
    """Forces that rounding leaves of couples must not keep it from coming to rest."""
    made = {
        "beam": {"spans": [5.915, 1.202, 2.608], "EI": 10000.0, "hinges": [7.117]},
        "foundation": [{"k": 10000.0, "side": "below", "gap": 0.002, "from": 3.3, "to": 6.8},
                       {"k": 1000.0, "side": "above", "gap": 0.001, "from": 1.1, "to": 2.1}],
        "loads": [{"type": "moment", "M": times * 29.936144881967085, "x": 0.01}, force(4.11, times * 3.8558882752802446),
                  {"type": "moment", "M": times * -14.517124002196445, "x": 4.06}],
    }  # fmt: skip
    with_it = gapbeam.solve(made)
    without = gapbeam.solve({**made, "beam": {"spans": [5.915, 1.202], "EI": 10000.0}})
    places = (0.0, 2.0, 4.1, 7.0)
    assert deflections(with_it, places) == pytest.approx(deflections(without, places), rel=1e-12)
