"""Beams on the ground: against a reference solution in 25 digits, and against themselves."""

import contextlib
import math
import pickle
from itertools import pairwise

import gapbeam
import numpy as np
import pytest
from mpmath import mp
from oracle.foundation import solve as reference
from scenes.foundation import random_scene
from scenes.ground import touching

SEEDS = 80
TIE = 1e-9
"""Nearer to another state than this zones need not be unique."""


def zones_of(contact):
    """Zones by foundation; those of a law that follow each other, or of both sides, are one."""
    found = {}
    for zone in sorted(contact, key=lambda c: (c.foundation, c.from_)):
        zones = found.setdefault(zone.foundation, [])
        if zones and zones[-1][1] == zone.from_:
            zones[-1] = [zones[-1][0], zone.to, zones[-1][2] + zone.resultant]
        else:
            zones.append([zone.from_, zone.to, zone.resultant])
    return found


def close(actual, expected, rel):
    """Whether arrays agree relative to the largest number."""
    actual, expected = np.asarray(actual, float), np.asarray(expected, float)
    return np.abs(actual - expected).max(initial=0.0) <= rel * np.abs(expected).max(initial=0.0)


def assert_agrees(result, right, made, seed):
    """Fields, reactions and, but where they need not be unique, zones are those of the reference."""
    step, length = result.steps[-1], sum(made["beam"]["spans"])
    x = np.linspace(0.013, 0.987, 17) * length
    fields = result.at(x)
    for name, of in (("deflection", right.w), ("moment", right.moment), ("shear", right.shear)):
        assert close(getattr(fields, name), [of(place) for place in x], 1e-12), (seed, name)
    assert close(step.reaction, [held.reaction for held in right.supports], 1e-11), seed
    if right.margin < TIE:
        return
    zones = zones_of(step.contact)
    expected = {i: [[z.start, z.end, z.resultant] for z in of] for i, of in enumerate(right.contact) if of}
    assert zones.keys() == expected.keys(), seed
    for i, of in expected.items():
        found, of = np.array(zones[i]), np.array(sorted(of), dtype=float)
        assert found.shape == of.shape, seed
        assert np.abs(found[:, :2] - of[:, :2]).max() <= 1e-11 * length, seed
        assert close(found[:, 2], of[:, 2], 1e-10), seed


@pytest.mark.parametrize("first", range(0, SEEDS, 10))
def test_random_scenes_agree_with_the_reference(first):
    solved = 0
    for seed in range(first, first + 10):
        made = random_scene(seed)
        result = gapbeam.solve(made)
        with mp.workdps(50):
            right = reference(made, digits=25)
            assert result.status == right.status, seed
            if result.status != "solved":
                continue
            solved += 1
            assert_agrees(result, right, made, seed)
    assert solved > 3


@pytest.mark.parametrize(
    ("seed", "status", "indifferent"),
    [
        # A couple, and nothing that pushes down: no zone bears it, however short
        (2702, "no-equilibrium", False),
        (2081, "no-equilibrium", False),
        # The beam turns about its first support for ever, pressing the ground at its edge
        (3947, "no-equilibrium", False),
        # Springs that yield: the first try does not tell; nor does the second, in which several parts move
        (2314, "no-equilibrium", False),
        (2884, "no-equilibrium", False),
        (3697, "no-equilibrium", False),
        (4323, "no-equilibrium", False),
        # Both ends guided, and nothing that pushes up
        (759, "no-equilibrium", False),
        (4852, "no-equilibrium", False),
        # On zones that doubles take for settled, and quadruple precision does not
        (3362, "no-equilibrium", False),
        # Free to move off a support, off the ground, off both: neither carries anything
        (1216, "solved", True),
        (1540, "solved", True),
        (4405, "solved", True),
        (2277, "solved", True),
        (2336, "solved", True),
        (1060, "solved", True),
        # It turns about its only support, off the ground that it touches under its load
        (506, "solved", True),
    ],
)
def test_ties(seed, status, indifferent):
    result = gapbeam.solve(random_scene(seed))
    assert result.status == status
    if status == "solved":
        step = result.steps[-1]
        assert step.indifferent == indifferent
        assert all(abs(zone.resultant) < 1e-15 for zone in step.contact)


@pytest.mark.parametrize(
    "law", [{"k": 4.0}, {"law": [[1.0, 4.0], [2.0, 5.0]]}, {"law": {"type": "tanh", "stiffness": 4.0, "limit": 5.0}}]
)
def test_a_beam_that_lies_evenly_cannot_move(law):
    """The ground takes the load where it is: no moment, no shear, and yet it carries."""
    made = {"beam": {"spans": [8.0], "EI": 3.0}, "loads": [{"type": "uniform", "q": 1.0}]}
    step = gapbeam.solve({**made, "foundation": [{"side": "below", **law}]}).steps[-1]
    assert not step.indifferent
    assert step.error_bounds["deflection"] < 1e-14
    assert [zone.resultant for zone in step.contact] == [8.0]


def scaled_scene(seed, factor):
    """A random scene with its live loads, forces and couples, times a factor."""
    made = random_scene(seed)
    for load in made["loads"]:
        if load.get("case") != "dead":
            load |= {key: load[key] * factor for key in ("F", "M") if key in load}
    return made


@pytest.mark.parametrize("F", [20.0, 400.0])
def test_moduli_that_add_up_to_a_constant(F):
    """One rises as the other falls; the force of that on a slope is quadratic along the beam."""
    made = {
        "beam": {"spans": [4.0], "EI": 100.0},
        "foundation": [{"k": [100.0, 300.0], "side": "below", "gap": [0.0, 0.02]}, {"k": [300.0, 100.0], "side": "below"}],
        "loads": [{"type": "uniform", "q": 60.0}, {"type": "force", "x": 1.0, "F": F}],
    }
    result, x = gapbeam.solve(made), np.linspace(0.0, 4.0, 17)
    fields = result.at(x)
    with mp.workdps(50):
        right = reference(made, digits=25)
        for name, of in (("deflection", right.w), ("moment", right.moment)):
            assert close(getattr(fields, name), [of(place) for place in x], 1e-12), name
    assert [zone.foundation for zone in result.steps[-1].contact] == [0, 1]


@pytest.mark.parametrize("beside", [1e-13, 1e-11, 1e-7, 1e-5])
@pytest.mark.parametrize("support", [{"side": "above", "gap": 0.01}, {"side": "below", "gap": 0.2}])
def test_a_load_next_to_a_support_that_does_not_act(beside, support):
    """As far as its gap a beam of that length would hardly be bent: that hid the sign of the reaction."""
    made = {"beam": {"spans": [4.0, 10.0], "EI": 10000.0}, "foundation": [{"k": 100.0}],
            "loads": [{"type": "force", "x": 4.0 - beside, "F": 50.0}]}  # fmt: skip
    alone = gapbeam.solve(made).steps[-1]
    step = gapbeam.solve({**made, "supports": [{"node": 1, **support}]}).steps[-1]
    assert step.state == ("open",)
    assert step.contact[0].resultant == alone.contact[0].resultant
    for name, bound in alone.error_bounds.items():
        assert step.error_bounds[name] == pytest.approx(bound, rel=10.0)


@pytest.mark.parametrize("side", ["both", "above"])
@pytest.mark.parametrize(("F", "status"), [(1.3, "solved"), (1.4, "no-equilibrium"), (20.0, "no-equilibrium")])
def test_a_tie_that_yields_holds_a_beam_on_an_edge_up_to_its_force(side, F, status):
    """About the edge of the ground F has a lever of 3, and the tie, which takes 2 at most, one of 2."""
    made = {"beam": {"spans": [4.0, 2.0], "EI": 4000.0}, "foundation": [{"from": 4.0, "to": 4.5, "k": 1000.0, "side": "below"}],
            "supports": [{"node": 2, "side": side, "law": [[0.002, 2.0], [0.004, 2.0]]}],
            "loads": [{"type": "force", "x": 1.0, "F": F}]}  # fmt: skip
    result = gapbeam.solve(made)
    assert result.status == status
    if status == "solved":
        assert result.reactions[0] == -2.0
    else:
        assert "tips about x = 4: its left end goes down, its right end goes up" in result.reason


def test_a_part_of_a_beam_on_an_edge():
    """A load at the very end of the ground tips the part up to the first hinge; the part behind the next one lies on the ground."""
    made = {"beam": {"spans": [6.0], "EI": 2850.0, "hinges": [1.7, 2.3]}, "foundation": [{"k": 196.0, "side": "below"}],
            "loads": [{"type": "force", "x": 0.0, "F": 43.0}, {"type": "uniform", "q": 5.0, "from": 2.3}]}  # fmt: skip
    result = gapbeam.solve(made)
    assert result.status == "no-equilibrium"
    assert "the part between the left end and the hinge at x = 1.7 tips about x = 0: its left end stays" in result.reason
    assert "moves" not in result.reason
    made["loads"][0]["x"] = 1e-4
    zone, _ = gapbeam.solve(made).steps[-1].contact
    assert (zone.from_, zone.to, zone.resultant) == (0.0, pytest.approx(3e-4, rel=1e-9), pytest.approx(43.0, rel=1e-9))


def beyond_a_hinge(to=6.0, **beam):
    """Ground that is pressed up to a hinge, and beyond it a part without load."""
    return {"beam": {"spans": [6.0], "EI": 2e4, "hinges": [4.0]} | beam, "foundation": [{"k": 3000.0, "side": "below", "to": to}],
            "loads": [{"type": "uniform", "q": 7.0, "to": 4.0}]}  # fmt: skip


def test_a_part_without_load_beyond_a_hinge_turns_without_end():
    """The ground pushes its end up as long as it touches there, however little, and nothing holds the rest."""
    made = beyond_a_hinge()
    for scene in (made, made | {"analysis": {"follow": "events"}}, beyond_a_hinge(GA=1e4)):
        result = gapbeam.solve(scene)
        assert result.status == "no-equilibrium"
        assert "the part between the hinge at x = 4 and the right end tips about the hinge at x = 4" in result.reason
        assert "moves" not in result.reason
    gap = made | {"foundation": [made["foundation"][0] | {"gap": 0.001}], "analysis": {"follow": "events"}}
    result = gapbeam.solve(gap)
    assert result.status == "no-equilibrium"
    assert max((step.factor for step in result.steps), default=0.0) < 1e-8
    assert "moves" not in result.reason


@pytest.mark.parametrize(("hinges", "load", "turn"), [
    ([5.6, 6.1], {"type": "force", "x": 5.96, "F": 24.0}, [(0.0, 5.6), (6.1, 8.0)]),
    ([1.0, 2.0, 2.7], {"type": "uniform", "q": 8.0, "to": 1.0}, [(1.0, 2.0), (2.0, 2.7), (2.7, 8.0)]),
])  # fmt: skip
def test_parts_without_load_on_both_sides_of_hinges_turn_without_end(hinges, load, turn):
    """The loads do no work along their motions, so nothing may push there; ground would, for the hinges are pressed into it."""
    made = {"beam": {"spans": [2.0, 2.0, 4.0], "EI": 1e4, "hinges": hinges}, "foundation": [{"k": 1e3, "side": "below"}],
            "loads": [load]}  # fmt: skip
    result = gapbeam.solve(made)
    assert result.status == "no-equilibrium"
    places = [x for x, displacement in result.motion if displacement < 0.0]
    assert all(any(a <= x <= b for a, b in turn) for x in places)
    assert {0.0, 8.0} & set(places) == {0.0, 8.0} & {x for pair in turn for x in pair}


def test_what_holds_a_part_without_load_beyond_a_hinge():
    """Where the ground ends at the hinge it is free to turn; tension, or a stop above it, say where it stays."""
    free = gapbeam.solve(beyond_a_hinge(to=4.0))
    assert free.steps[-1].indifferent
    assert free.at(4.0).deflection == pytest.approx(7.0 / 3000.0, rel=1e-12)
    pulled = gapbeam.solve(beyond_a_hinge(N=10.0))
    x = np.linspace(4.0, pulled.steps[-1].contact[-1].to, 2001)
    couple = np.trapezoid(3000.0 * pulled.at(x).deflection * (x - 4.0), x)
    assert couple == pytest.approx(10.0 * (pulled.at(4.0).deflection - pulled.at(6.0).deflection), rel=1e-6)
    stopped = gapbeam.solve(beyond_a_hinge() | {"supports": [{"x": 6.0, "side": "above", "gap": 0.01}]})
    assert not stopped.steps[-1].indifferent
    assert stopped.at(6.0).deflection == -0.01


def test_a_load_that_a_support_takes_beside_ground_that_is_not_touched():
    """Nothing else carries: the rounding of that in a rigid beam was refused by the audit."""
    made = {"beam": {"spans": [3.324], "EI": math.inf, "hinges": [0.3986]}, "supports": [{"node": 0}, {"node": 1}],
            "foundation": [{"k": 100.0, "side": "above", "gap": 0.002, "from": 2.6, "to": 3.3}],
            "loads": [{"type": "force", "node": 0, "F": -26.068410645078863}]}  # fmt: skip
    result = gapbeam.solve(made)
    assert result.steps[-1].indifferent
    assert result.steps[-1].reaction == pytest.approx([-26.068410645078863, 0.0], abs=1e-30)


def test_a_beam_without_load_in_a_clearance():
    """It lies on ground that has moved, or touches an edge of it, and is free to move; rounding said that it stood on the edge."""
    lying = {"beam": {"spans": [12.0], "EI": float("inf")},
             "foundation": [{"k": 1e4, "side": "below", "gap": 0.002, "name": "moved"}, {"k": 5e3, "side": "above", "gap": 0.002}],
             "loads": [{"type": "movement", "foundation": "moved", "value": -0.0024}]}  # fmt: skip
    lifted = {"beam": {"spans": [3.0], "EI": 2000.0}, "supports": [{"node": 1, "side": "below", "gap": 0.002}],
              "foundation": [{"k": 1000.0, "side": "above", "to": 2.01}],
              "loads": [{"type": "movement", "support": 0, "value": -0.0021}]}  # fmt: skip
    pressed = {"beam": {"spans": [5.0], "EI": float("inf"), "hinges": [2.9]},
               "foundation": [{"k": 1e4, "side": "above", "gap": 0.002, "name": "moved", "from": 0.56, "to": 4.59}],
               "loads": [{"type": "movement", "foundation": "moved", "value": value} for value in (0.0018, 0.0045)]}  # fmt: skip
    for scene, at, deflection in ((lying, 0.0, -0.0004), (lifted, 3.0, -0.0001), (pressed, 5.0, 0.0043)):
        result = gapbeam.solve(scene)
        assert result.steps[-1].indifferent
        assert result.at(at).deflection == pytest.approx(deflection, rel=1e-12)
        assert max(abs(one.value) for one in result.extremes["moment"].values()) < 1e-30
        followed = gapbeam.solve(scene | {"analysis": {"follow": "events"}})
        assert followed.status == "solved"
        assert followed.steps[-1].indifferent


def test_ground_stops_a_beam_that_next_to_nothing_holds():
    """Pressed at its left end, the beam turns until the ground above its right end stops it, on zones of 1e-4 and 1e-6."""
    made = {"beam": {"spans": [3.0, 4.0], "EI": 1e4},
            "supports": [{"node": 1, "side": "below", "gap": 0.002}, {"node": 0, "side": "above", "gap": 0.002}],
            "foundation": [{"k": 1e4, "side": "below", "gap": 0.005}, {"k": 1e3, "side": "above", "gap": 0.005}],
            "loads": [{"type": "force", "x": 0.0, "F": 24.0}]}  # fmt: skip
    assert [round(zone.to - zone.from_, 6) for zone in gapbeam.solve(made).steps[-1].contact] == [1.15272, 1.433377]
    for less in (1e-8, 1e-10):
        made["loads"][0]["F"] = 24.0 * less
        with contextlib.suppress(gapbeam.EngineError):  # that zones could not be settled; they cannot say that it falls
            assert gapbeam.solve(made).status == "solved"


def test_a_beam_about_to_tip_over_an_edge():
    """All of it stands on 6e-7 next to the edge, in three zones, two of them 1e-12 long; and then it tips."""
    made = scaled_scene(10316, 0.0383832)
    with mp.workdps(50):
        ends = sorted(float(zone.end) for zones in reference(made, digits=25).contact for zone in zones)
    found = zones_of(gapbeam.solve(made).steps[-1].contact)
    assert sorted(zone[1] for zones in found.values() for zone in zones) == pytest.approx(ends, rel=1e-15)
    assert gapbeam.solve(scaled_scene(10316, 0.0383834)).status == "no-equilibrium"


@pytest.mark.parametrize("over", [0.0, 1e-15, -1e-15, 1e-14, -1e-14])
def test_a_place_that_is_only_touched(over):
    (zone,) = gapbeam.solve(touching(over)).steps[-1].contact
    assert (zone.state, zone.from_, zone.to, zone.resultant) == ("touching", zone.to, pytest.approx(4.0, abs=1e-7), 0.0)


@pytest.mark.parametrize(("over", "states"), [(1e-12, ["closed"]), (-1e-12, [])])
def test_contact_and_none_beside_a_touch(over, states):
    assert [zone.state for zone in gapbeam.solve(touching(over)).steps[-1].contact] == states


@pytest.mark.parametrize("gap", [{"gap": 2.0}, {"profile": [[0.0, 9.0], [1.0, 17.0 / 24.0], [2.0, 9.0]]}])
def test_a_tip_or_a_peak_that_is_touched(gap):
    beam = {"spans": [2.0], "EI": 1.0}
    made = {"beam": beam, "supports": [{"node": 0, "rotation": "fixed"}], "loads": [{"type": "uniform", "q": 1.0}]}
    (zone,) = gapbeam.solve({**made, "foundation": [{"k": 4.0, "side": "below", **gap}]}).steps[-1].contact
    assert (zone.state, zone.from_, zone.resultant) == ("touching", 2.0 if "gap" in gap else 1.0, 0.0)


def test_a_rigid_support_on_the_ground_is_no_touch():
    made = {"beam": {"spans": [8.0, 8.0], "EI": 1.0}, "supports": [{"node": i} for i in range(3)]}
    made |= {"foundation": [{"k": 4.0, "side": "below"}], "loads": [{"type": "uniform", "q": -1.0}]}
    step = gapbeam.solve(made).steps[-1]
    assert step.contact == ()
    assert [(span.from_, span.to) for span in step.free_spans] == [(0.0, 16.0)]


@pytest.fixture
def made():
    """A beam that lifts off in two places."""
    return {
        "beam": {"spans": [30.0], "EI": 1.0},
        "foundation": [{"k": 4.0, "side": "below"}],
        "loads": [
            {"type": "uniform", "q": 1.0, "case": "dead"},
            {"type": "force", "x": 15.0, "F": 16.0},
            {"type": "force", "x": 25.0, "F": -8.0},
        ],
    }


def test_how_the_beam_is_cut_does_not_matter(made):
    one = gapbeam.solve(made)
    cut = {**made, "beam": {"spans": [0.1, 6.9, 12.75, 0.25, 10.0], "EI": 1.0}}
    cut["foundation"] = [{"k": 4.0, "side": "below", "from": a, "to": b} for a, b in pairwise([0.0, 3.3, 20.0, 29.95, 30.0])]
    many = gapbeam.solve(cut)
    x = np.linspace(0.0, 30.0, 61)
    for name in ("deflection", "rotation", "moment", "shear"):
        assert close(getattr(many.at(x), name), getattr(one.at(x), name), 1e-13), name
    ends = [end for zone in one.steps[-1].contact for end in (zone.from_, zone.to)]
    of_all = [end for zone in many.steps[-1].contact for end in (zone.from_, zone.to)]
    assert all(min(abs(end - other) for other in of_all) < 1e-12 for end in ends)
    total = sum(zone.resultant for zone in many.steps[-1].contact)
    assert total == pytest.approx(30.0 + 16.0 - 8.0, rel=1e-14)


def test_mirrored(made):
    one = gapbeam.solve(made)
    other = {**made, "loads": [made["loads"][0], *({**load, "x": 30.0 - load["x"]} for load in made["loads"][1:])]}
    mirrored = gapbeam.solve(other)
    x = np.linspace(0.25, 29.75, 41)
    assert close(mirrored.at(30.0 - x).deflection, one.at(x).deflection, 1e-14)
    assert close(mirrored.at(30.0 - x).shear, -one.at(x, side="left").shear, 1e-14)


def test_steps_and_events_end_in_the_same_state(made):
    by_steps = gapbeam.solve({**made, "analysis": {"steps": 3}})
    by_events = gapbeam.solve({**made, "analysis": {"follow": "events"}})
    assert [event.event for event in by_events.events] == ["zone splits"]
    event = by_events.events[0]
    # Where it splits, the beam only touches the ground
    state = by_events.state(event.factor)
    assert abs(by_events.at(event.x, factor=event.factor).deflection) < 1e-13
    assert len(state.contact) in (1, 2)
    assert by_events.steps[-1].contact == by_steps.steps[-1].contact
    np.testing.assert_array_equal(by_events.fields().moment, by_steps.fields().moment)


@pytest.mark.parametrize(
    ("seed", "factors"),
    [
        (10054, []),  # at first the load is nothing beside the gaps
        (10132, [0.3497043154, 0.3497043154, 0.6559202896, 0.6603196871]),  # a tip goes from one side to the other
        (10694, [0.0160900765855, 0.0505876444925, 0.8306545490421, 0.9208138247134]),  # a hinged part comes down on a peak
        (12079, [0.0268999587376, 0.1504553797692]),  # and on the end of the ground
    ],
)
def test_paths_along_which_next_to_nothing_holds_for_a_while(seed, factors):
    result = gapbeam.solve({**random_scene(seed), "analysis": {"follow": "events"}})
    assert result.status == "solved"
    assert [event.factor for event in result.events] == pytest.approx(factors, rel=1e-9)


def test_prepared_cases(made):
    prepared = gapbeam.prepare(made)
    factors = np.array([[1.0, 1.0, 1.0], [1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [2.0, 1.0, 0.5]])
    cases = prepared.solve(factors)
    assert cases.status.tolist() == [0, 0, 1, 0]
    assert np.isnan(cases.deflection[2]).all()
    np.testing.assert_array_equal(cases.deflection[0], gapbeam.solve(made).at(prepared.node_x).deflection)
    assert cases.deflection[1] == pytest.approx(0.25, rel=1e-15)


def test_pickled(made):
    result = gapbeam.solve(made)
    again = pickle.loads(pickle.dumps(result))
    assert again == result
    assert again.steps[-1].contact == result.steps[-1].contact


@pytest.mark.parametrize(
    "ground",
    [
        [{"k": [4.0, 1.0], "profile": [[0.0, 0.1], [9.0, -0.3], [30.0, 0.2]]}],
        # Layers in one place whose gaps slope differently
        [{"k": 4.0, "gap": [-0.5, 0.2]}, {"k": 1.0, "gap": [0.1, -0.9]}, {"k": 0.5, "gap": -1.0}],
        # Whose moduli vary, but not their sum
        [{"k": [4.0, 1.0], "gap": [-0.6, 0.2]}, {"k": [1.0, 4.0], "gap": [0.1, -0.9]}],
    ],
)
def test_extremes_are_not_exceeded(made, ground):
    made = {**made, "foundation": [{"side": "below", **layer} for layer in ground]}
    if len(ground) > 1:  # no place at which the moment has a corner, where the pressure would peak too
        made["loads"] = [made["loads"][0], {"type": "uniform", "q": 1.0, "from": 12.0, "to": 18.0}]
    result = gapbeam.solve(made)
    extremes = result._pairs_of_extremes()
    x = np.linspace(0.0, 30.0, 3001)
    fields = result.at(x)
    for name in ("deflection", "rotation", "moment", "shear", "pressure"):
        values, (top, at_top), (bottom, at_bottom) = getattr(fields, name), extremes[name]["max"], extremes[name]["min"]
        size = np.abs(values).max()
        assert values.max() <= top + 1e-13 * size, name
        assert values.min() >= bottom - 1e-13 * size, name
        near = [result.at([at_top, at_bottom], side=side) for side in ("left", "right")]
        assert min(abs(getattr(of, name)[0] - top) for of in near) <= 1e-13 * size, name
        assert min(abs(getattr(of, name)[1] - bottom) for of in near) <= 1e-13 * size, name
        if name != "shear":  # which jumps
            assert top <= values.max() + 1e-3 * size, name


def test_free_spans_and_their_sag():
    made = {
        "beam": {"spans": [10.0], "EI": 50.0},
        "foundation": [{"k": 1e4, "side": "below", "profile": [[0.0, 0.0], [4.0, 0.0], [5.0, 0.4], [6.0, 0.0], [10.0, 0.0]]}],
        "loads": [{"type": "uniform", "q": 1.0}],
    }
    result = gapbeam.solve(made)
    (span,) = result.steps[-1].free_spans
    # It touches a little beyond the shoulders, where it is pressed in
    assert 4.0 < span.from_ < 4.01
    assert 5.99 < span.to < 6.0
    assert span.from_ + span.to == pytest.approx(10.0, abs=1e-11)
    assert span.sag == pytest.approx(0.4 - result.at(5.0).deflection, rel=1e-12)


@pytest.mark.parametrize("EI", [math.inf, 1e5])
@pytest.mark.parametrize(
    ("limit", "load", "pivot", "most"),
    [
        ([100.0, 100.0], {"type": "force", "F": 600.0}, 5.0 * math.sqrt(2.0), 1000.0 * (math.sqrt(2.0) - 1.0) / 600.0),
        ([0.0, 300.0], {"type": "force", "F": 900.0}, 10.0 * 0.5 ** (1 / 3), 3000.0 * (0.25 ** (1 / 3) - 0.5) / 900.0),
        ([100.0, 100.0], {"type": "moment", "M": 3000.0}, 5.0, 2500.0 / 3000.0),
    ],
)
def test_limit_loads_of_piles(EI, limit, load, pivot, most):
    """The pile turns about a place below which the soil resists the other way (Broms)."""
    law = {"type": "plastic", "stiffness": [100.0 * p for p in limit], "limit": limit}
    made = {"beam": {"spans": [10.0], "EI": EI}, "foundation": [{"law": law}], "loads": [{**load, "x": 0.0}]}
    path = gapbeam.solve({**made, "analysis": {"follow": "events"}})
    assert path.status == "limit-load"
    assert f"beyond load factor {most:.12g};" in path.reason
    assert f"about x = {pivot:.6g}:" in path.reason
    for change, status in ((-1e-12, "solved"), (1e-12, "no-equilibrium")):
        (size,) = (key for key in load if key != "type")
        made["loads"] = [{**load, "x": 0.0, size: load[size] * most * (1.0 + change)}]
        assert gapbeam.solve(made).status == status


@pytest.mark.parametrize("seed", [98, 107])
def test_zones_are_born_where_the_reference_says(seed):
    made = random_scene(seed)
    path = gapbeam.solve({**made, "analysis": {"follow": "events"}})
    event = [event for event in path.events if event.event == "zone appears"][-1]
    for change, born in ((-1e-12, False), (1e-12, True)):
        found = reference(made, factor=event.factor * (1.0 + change), digits=30).contact[event.foundation]
        assert any(zone.end - zone.start < 1e-10 and abs(zone.start - event.x) < 1e-9 for zone in found) == born


@pytest.mark.parametrize("seed", range(1, 5))
def test_many_axles_on_a_rail_take_few_rounds(seed):
    """Ends that went farther than asked joined zones which parted again, round after round."""
    loads = [{"type": "force", "x": x, "F": 120.0} for x in np.random.default_rng(seed).uniform(0.0, 300.0, 30).tolist()]
    ground = [{"k": 4e4, "side": "below"}]
    result = gapbeam.solve(
        {"beam": {"spans": [300.0], "EI": 6.4e3}, "foundation": ground, "loads": [{"type": "uniform", "q": 0.6}, *loads]}
    )
    assert result.steps[-1].solves < 20
    assert sum(zone.resultant for zone in result.steps[-1].contact) == pytest.approx(30 * 120.0 + 180.0, rel=1e-14)


@pytest.mark.parametrize("side", ["both", "below"])
@pytest.mark.parametrize(
    ("supports", "rigid"),
    [
        ([{"node": 0, "rotation": "fixed"}, {"node": 1, "rotation": "fixed"}], [(0, 1), (3, 4)]),
        (
            [{"node": 0, "rotation": "fixed"}, {"x": 2.0, "rotation": 300.0, "stiffness": 200.0, "settlement": 0.01}],
            [(0, 1.5), (1.5, 3)],
        ),
        ([{"node": 0}, {"x": 1.0, "settlement": 0.01}, {"node": 1, "stiffness": 50.0}], [(0, 2)]),
        ([{"node": 0}, {"x": 1.0}, {"x": 1.5, "side": "below", "gap": 0.01}], [(0, 2)]),
    ],
)
def test_a_rigid_stretch_whose_place_is_known_is_the_limit_of_stiff_ones(side, supports, rigid):
    def solved(stiffness):
        sections = [{"from": a, "to": b, "EI": stiffness} for a, b in rigid]
        loads = [{"type": "uniform", "q": 3.0}, {"type": "force", "x": 0.7, "F": 9.0}, {"type": "force", "x": 2.2, "F": -20.0}]
        made = {"beam": {"spans": [4.0], "EI": 1e3}, "loads": loads, "supports": supports, "sections": sections}
        return gapbeam.solve({**made, "foundation": [{"k": 500.0, "side": side}]})

    exact, stiff = solved(math.inf), solved(1e13)
    assert exact.status == "solved"
    assert exact.steps[-1].solves < 20
    assert close(exact.steps[-1].reaction, stiff.steps[-1].reaction, 1e-7)
    x = np.linspace(0.0, 4.0, 17)
    for name in ("deflection", "moment"):
        assert close(getattr(exact.at(x), name), getattr(stiff.at(x), name), 1e-7), name


def test_too_many_rigid_supports_are_refused_without_springs():
    made = {"beam": {"spans": [1.0, 1.0, 1.0], "EI": math.inf}, "foundation": [{"k": 500.0, "side": "below"}]}
    supports = [{"node": i} for i in range(4)]
    # Of a few nodes, not of thousands
    with pytest.raises(gapbeam.EngineError, match=r"near x = \d rests on more rigid supports"):
        gapbeam.solve({**made, "supports": supports, "loads": [{"type": "uniform", "q": 3.0}]})
