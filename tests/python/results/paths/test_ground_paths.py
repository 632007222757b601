"""The load path of beams on the ground: every change at its own factor, whatever the grid, and few solves for it."""

import copy

import gapbeam
import pytest
import scenes
from mpmath import mp, mpf
from oracle.foundation import solve as reference
from scenes.foundation import random_scene
from scenes.ground import on_ground, over_peaks, pile, rough_pipe
from scenes.plain import at, force, stretch, uniform
from scenes.transformed import mirrored

ROUNDINGS = 4 * 2.0**-53
LOOK = 4  # linear solves for a place of the grid
CHANGE = 40  # for a change: where it happens, and states on both sides of it


def told(made):
    """Factors, places and names of the events of a scene."""
    return [(event.factor, event.x, event.event) for event in gapbeam.solve(made).events]


@pytest.mark.parametrize("seed", range(3))
def test_a_rough_seabed_needs_few_solves(seed):
    result = gapbeam.solve(rough_pipe(seed))
    assert len(result.events) > 5
    assert result.path.solves < 64 * LOOK + CHANGE * len(result.events)


@pytest.mark.parametrize("seed", range(3))
def test_what_a_rough_seabed_does_is_where_states_change(seed):
    """Just below and just above the factor the zones are others by what the event says."""
    more = {"zone appears": 1, "zone splits": 1, "zone vanishes": -1, "zones merge": -1, "end reaches": 0, "end leaves": 0}
    result = gapbeam.solve(rough_pipe(seed))
    for event in result.events:
        before, after = (result.state(event.factor * (1 + d)).contact for d in (-1e-8, 1e-8))
        assert len(after) - len(before) == more[event.event], event


def test_ends_of_a_pile_take_as_few_solves_as_its_head():
    """What changes at the right end of the beam is found where it changes, and not by halves."""
    one, other = gapbeam.solve(pile(150.0)), gapbeam.solve(pile(150.0, turned=True))
    assert [event.factor for event in one.events] == pytest.approx([event.factor for event in other.events], rel=1e-12)
    assert one.path.solves == pytest.approx(other.path.solves, rel=0.1)


@pytest.mark.parametrize("turned", [False, True])
def test_states_where_layers_meet_at_a_kink_of_their_laws(turned):
    """A zone that ends there has next to no length, but it is no edge: the same ground acts beside it."""
    result = gapbeam.solve(pile(60.0, turned))
    events = [event for event in result.events if event.x == (18.3 - 6.1 if turned else 6.1)]
    assert len(events) > 10
    for event in events:
        w = [result.state(event.factor * (1 + share)).extremes["deflection"]["max"].value for share in (-1e-14, 0.0, 1e-14)]
        assert w == pytest.approx([w[1]] * 3, rel=1e-13)


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("law", [
    {"type": "hardening", "stiffness": [0.0, 0.844], "limit": [0.0, 1.95], "slope": [0.0268, 0.0971]},
    {"type": "plastic", "stiffness": [0.0, 0.844], "limit": [0.0, 1.95]},
])  # fmt: skip
def test_a_law_that_begins_from_nothing_yields_there(law, turned):
    """Stiffness and limit are zero at an end, but at what displacement it yields there is known, to all digits."""
    loads = [{"type": "uniform", "q": 0.497}, {"type": "uniform", "q": 0.0627, "case": "dead"}]
    made = on_ground([4.5], [{"side": "below", "law": law}], loads, EI=0.665, analysis={"follow": "events"})
    result = gapbeam.solve(mirrored(made) if turned else made)
    event = result.events[0]
    assert (event.event, event.x, event.branch) == ("zone appears", 4.5 if turned else 0.0, 2)
    assert result.at(event.x, factor=event.factor).deflection == pytest.approx(1.95 / 0.844, rel=1e-14)
    yielded = []
    for more in (1e-10, 1e-9, 1e-8, 1e-7):
        (zone,) = (zone for zone in result.state(event.factor * (1 + more)).contact if zone.state == "branch 2")
        yielded.append((zone.to - zone.from_) / more)
    assert yielded == pytest.approx([yielded[-1]] * 4, rel=1e-5)


def test_a_beam_tips_after_few_solves():
    """Next to the end next to nothing holds it, and rounding tells what: the end is known from the work of the loads."""
    made = on_ground([4.125], [{"side": "below", "law": {"type": "cubic", "k1": [162.0, 481.0], "k3": 4.48e7}}],
                     [force(0.0, -0.683), uniform(0.0453, case="dead")], EI=1.66, analysis={"follow": "events"})  # fmt: skip
    result = gapbeam.solve(made)
    assert result.status == "no-equilibrium"
    assert result.path.segments[-1].stop == pytest.approx(0.0453 * 4.125 / 2 / 0.683, rel=1e-12)
    assert result.path.solves < 600


def test_where_a_beam_stands_on_an_edge_both_factors_are_said():
    """Its zone is as short as what is missing of the last factor, so states end before. The work of the loads tells how far."""
    stop = [at(0, side="below", gap=9.32e-6), at(0, side="above", gap=2e-6)]
    loads = [uniform(-5.69, **stretch(0.125, 1.0)), uniform(1.9221, case="dead")]
    keys = {"EI": 301.0, "hinges": [0.25], "analysis": {"follow": "events"}}
    result = gapbeam.solve(on_ground([1.375], [{"side": "below", "k": 1.02e7, "gap": -5.09e-6}], loads, stop, **keys))
    exact, last = 1.9221 * 0.6875 / (5.69 * 0.59375), result.path.segments[-1].stop
    assert exact * (1 - 1e-6) < last < exact * (1 - 1e-12)
    assert result.path.beyond == pytest.approx(exact, rel=1e-12)
    assert f"above a load factor between {last:.12g} and {exact:.12g}: " in result.reason


@pytest.mark.parametrize("gap", [1.0, 1.0 + 2.0**-40, 1.0 - 2.0**-40, 0.3, 3.999, 1e-3])
def test_a_peak_is_touched_at_its_factor(gap):
    """At a place of the grid, next to one, and anywhere; in the beginning and at the end."""
    factor, x, event = told(over_peaks([(1.0, gap)]))[0]
    assert factor == pytest.approx(gap / 4, rel=ROUNDINGS, abs=0)
    assert (x, event) == (1.0, "zone appears")


@pytest.mark.parametrize("k", [1e-9, 50.0, 1e9])
@pytest.mark.parametrize("gap", [1.0, 0.7, 1e-9])
def test_level_ground_is_touched_at_its_factor(k, gap):
    """However stiff: the distance bends sharply where contact begins."""
    made = over_peaks([]) | {"foundation": [{"k": k, "side": "below", "gap": gap}]}
    factor, x, event = told(made)[0]
    assert factor == pytest.approx(gap / 4, rel=ROUNDINGS, abs=0)
    assert x == pytest.approx(1.0, rel=1e-7)
    assert event == "zone appears"


@pytest.mark.parametrize("law", [[[1e-3, 1.0], [2e-3, 1.5], [1.0, 2.0]], {"type": "tanh", "stiffness": 50.0, "limit": 5.0}])
def test_ground_with_a_law_is_touched_at_its_factor(law):
    factor, x, event = told(over_peaks([]) | {"foundation": [{"law": law, "side": "both", "gap": 0.5}]})[0]
    assert factor == pytest.approx(0.125, rel=ROUNDINGS, abs=0)
    assert x == pytest.approx(1.0, rel=1e-7)
    assert event == "zone appears"


@pytest.mark.parametrize("way", [0.0, 1e-14, 1e-12, 1e-9])
def test_events_however_near_to_each_other(way):
    """Symmetric ones at one factor, others each at its own; both stand in their order."""
    events = gapbeam.solve(over_peaks([(1.5, 1.0 + way), (0.5, 1.0)])).events
    first = [event for event in events if event.event == "zone appears"]
    assert {event.foundation: event.factor for event in first} == pytest.approx(
        {0: (1.0 + way) / 2.75, 1: 1.0 / 2.75}, rel=ROUNDINGS, abs=0)  # fmt: skip
    assert [event.factor for event in events] == sorted(event.factor for event in events)


def test_a_support_takes_what_the_ground_would():
    made = over_peaks([(1.0, 1.5)])
    made["supports"].append({"x": 1.0, "side": "below", "gap": 1.0})
    (event,) = gapbeam.solve(made).events
    assert (event.support, event.event) == (2, "closes")
    assert event.factor == pytest.approx(0.25, rel=ROUNDINGS, abs=0)


def test_an_end_on_a_support_leaves_where_the_beam_is_level_with_the_ground():
    """The distance there is zero at all factors; the slope decides."""
    loads = [scenes.uniform(4.0, case="dead"), scenes.force(0.5, -30.0)]
    made = on_ground([3.0], [{"k": 50.0, "side": "below"}], loads, [scenes.at(0), scenes.at(1)], EI=50.0)
    result = gapbeam.solve(made | {"analysis": {"follow": "events"}})
    ends = [event for event in result.events if event.event == "end leaves"]
    assert ends
    for event in ends:
        slopes = [result.at_state(result.state(event.factor * (1 + d)), event.x).rotation for d in (-1e-6, 1e-6)]
        assert slopes[0] * slopes[1] < 0
        assert abs(slopes[0] + slopes[1]) < 1e-5 * abs(slopes[1] - slopes[0])


def what_acts(made, factor):
    """Zones with whether they come to an end of their foundation, and supports that carry, by the oracle."""
    right, length = reference(made, factor, digits=50), sum(made["beam"]["spans"])
    zones = []
    for item, of in zip(made["foundation"], right.contact, strict=True):
        ends = (item.get("from", 0.0), item.get("to", length))
        zones.append([(abs(zone.start - ends[0]) < 1e-20, abs(zone.end - ends[1]) < 1e-20) for zone in of])
    return zones, [abs(held.reaction) > 1e-25 for held in right.supports]


@pytest.mark.parametrize("seed", [16, 23, 73, 186, 243, 310])
def test_random_paths_change_where_the_oracle_does(seed):
    """In 50 digits the zones are others 1e-14 below and above each factor."""
    made = random_scene(seed)
    events = [event for event in gapbeam.solve(made | {"analysis": {"follow": "events"}}).events if event.branch == 1]
    assert events
    with mp.workdps(80):
        for event in events:
            below, above = (what_acts(made, mpf(event.factor) * (1 + mpf(d))) for d in ("-1e-14", "1e-14"))
            assert below != above, event


def test_a_beam_tips_where_its_loads_begin_to_do_work():
    """About the right end: up by the force over a length of 1, down by the weight over a length of 1.5."""
    loads = [scenes.uniform(4.0, case="dead"), scenes.force(0.5, -9.0)]
    made = on_ground([1.5], [{"k": 50.0, "side": "below"}], loads, EI=10.0, analysis={"follow": "events"})
    result = gapbeam.solve(made)
    assert result.status == "no-equilibrium"
    assert result.path.segments[-1].stop == pytest.approx(4.0 * 1.5**2 / 2 / 9.0, rel=1e-13)


def test_a_beam_tips_off_ground_whose_curve_levels_off():
    """Where it does, no state can be settled beside rounding; that was an answer without a status."""
    law = {"type": "hyperbolic", "stiffness": [0.0, 5020.0], "limit": [0.0, 18.8]}
    ground = {"side": "below", "from": 0.5, "to": 1.5, "gap": 0.00133, "law": law}
    loads = [scenes.force(1.875, -6.3), scenes.uniform(0.182, case="dead")]
    supports = [{"x": 2.625, "stiffness": 1880.0}]
    result = gapbeam.solve(on_ground([4.25], [ground], loads, supports, EI=379.0, analysis={"follow": "events"}))
    assert result.status == "limit-load"
    weight, lift = 0.182 * 4.25 * (2.625 - 4.25 / 2), 6.3 * (2.625 - 1.875)
    assert result.path.segments[-1].stop == pytest.approx(weight / lift, rel=1e-5)
    assert result.path.segments[-1].stop < weight / lift
    assert "the beam tips about the support at x = 2.625" in result.reason


def smaller(made, share):
    """A scene with a share of all loads, gaps and settlements: everything is that share of it, at the same load factors."""
    new = copy.deepcopy(made)

    def times(value):
        return [times(one) for one in value] if isinstance(value, list) else value * share

    for item in (*new["loads"], *new["supports"], *new["foundation"]):
        for key in item.keys() & {"F", "M", "q", "kappa", "gap", "settlement", "law"}:
            item[key] = times(item[key])
        if "profile" in item:
            item["profile"] = [[x, share * gap] for x, gap in item["profile"]]
    return new


@pytest.mark.parametrize("seed", [18, 21, 51, 199, 218, 235, 240, 254])
def test_factors_of_supports_do_not_hang_on_the_unit_of_force(seed):
    """They are exact: in other units the last step towards them is another one."""
    made = random_scene(seed)
    one, same = (gapbeam.solve(each | {"analysis": {"follow": "events"}}).events for each in (made, smaller(made, 2.0**-200)))
    assert [event.factor for event in one] == pytest.approx([event.factor for event in same], rel=ROUNDINGS, abs=0)
    assert any(event.support is not None for event in one)
