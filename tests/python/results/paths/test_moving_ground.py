"""Supports and ground that loads move, beside closed forms, rows of springs, and the same scenes at rest where they have gone."""

from itertools import pairwise

import gapbeam
import numpy as np
import pytest
from gapbeam.results.proof import proof_data
from mpmath import findroot, mp, mpf
from oracle.foundation import solve as reference
from scenes import at, force, linear, mirrored, scene, uniform
from scenes.ground import on_ground
from scenes.moving import at_rest, movement, random_moving_scene

EVENTS = {"follow": "events"}
ROUNDINGS = 8 * 2.0**-53
EI, K, Q = 1000.0, 50.0, 1.0
BETA = (K / (4 * EI)) ** 0.25


def told(made):
    """Factors and names of the events of a scene."""
    return [(event.factor, event.event) for event in gapbeam.solve(made | {"analysis": EVENTS}).events]


def test_ground_that_holds_both_ways_takes_the_beam_along():
    """A beam that nothing else holds goes with it, without moments, also where it turns."""
    ground = [{"k": [20.0, 60.0]}]
    made = on_ground([4.0, 6.0], ground, [movement([0.3, -0.2], foundation=0), uniform(0.0)], EI=EI)
    result = gapbeam.solve(made)
    x = np.linspace(0.0, 10.0, 21)
    assert result.at(x).deflection == pytest.approx(0.3 - 0.05 * x, abs=1e-16)
    assert abs(result.at(x).pressure).max() < 1e-14
    assert abs(result.at(x).moment).max() < 1e-14


def test_it_is_a_load_of_k_times_the_movement():
    """Where the ground is linear."""
    beam = {"spans": [5.0, 7.0], "EI": [EI, 2 * EI]}
    supports = [at(1), at(2, stiffness=30.0)]
    made = {"beam": beam, "supports": supports, "foundation": [{"k": [20.0, 60.0], "from": 0.5, "to": 11.0}]}
    moved = gapbeam.solve(made | {"loads": [movement(0.03, foundation=0)]})
    pressed = gapbeam.solve(made | {"loads": [linear(0.6, 1.8, **{"from": 0.5, "to": 11.0})]})
    x = np.linspace(0.0, 12.0, 50)
    for name in ("deflection", "moment", "shear"):
        found, right = (getattr(one.at(x), name) for one in (moved, pressed))
        assert found == pytest.approx(right, abs=1e-14 * abs(right).max())
    assert moved.at(6.0).pressure == pytest.approx(pressed.at(6.0).pressure - (20.0 + 40.0 * 5.5 / 10.5) * 0.03, rel=1e-13)


@pytest.mark.parametrize("by", [0.01, -0.3])
def test_a_support_of_a_long_beam(by):
    """Hetenyi: a deflection v at one place takes 8 EI beta^3 v, and w = v exp(-s) (cos s + sin s), s = beta x."""
    half = 20.0 / BETA
    made = on_ground([half, half], [{"k": K}], [movement(by, support=0)], [at(1)], EI=EI)
    result = gapbeam.solve(made)
    assert result.steps[-1].reaction[0] == pytest.approx(-8 * EI * BETA**3 * by, rel=1e-14)
    s = np.array([0.0, 0.3, 1.0, 2.0])
    assert result.at(half + s / BETA).deflection == pytest.approx(by * np.exp(-s) * (np.cos(s) + np.sin(s)), rel=1e-13)


def lift(height):
    """Half the free length, and the force, where a heavy long beam is held at a height above one-sided ground.

    On the ground w = q/k + exp(-s) (A cos s + B sin s), s = beta times the distance from the zone's end, where w = 0; off it w is a
    polynomial, whose slope vanishes at the support.
    """
    stiff, k, q = mpf(EI), mpf(K), mpf(Q)
    beta, a = (k / (4 * stiff)) ** (mpf(1) / 4), -q / k

    def off(length, b):
        slope, moment, shear = beta * (b - a), 2 * beta**2 * stiff * b, -2 * beta**3 * stiff * (a + b)
        psi = slope + (moment * length - shear * length**2 / 2 - q * length**3 / 6) / stiff
        w = -slope * length - (moment * length**2 / 2 - shear * length**3 / 6 - q * length**4 / 24) / stiff
        return psi, w, shear + q * length

    length, b = findroot(lambda length, b: [off(length, b)[0], off(length, b)[1] + height], (mpf(18), mpf(1)))
    return length, 2 * off(length, b)[2]


def test_a_heavy_beam_is_lifted_off_the_ground():
    """A support stands where the beam has sunk to, and rises by 3 above the ground: the zone splits where it comes to that."""
    sunk, half = Q / K, 40.0 / BETA
    loads = [uniform(Q, case="dead"), movement(-(3.0 + sunk), support=0)]
    made = on_ground([half, half], [{"k": K, "side": "below"}], loads, [at(1, settlement=sunk)], EI=EI)
    result = gapbeam.solve(made | {"analysis": EVENTS})
    assert told(made) == [(pytest.approx(sunk / (3.0 + sunk), rel=ROUNDINGS), "zone splits")]
    with mp.workdps(30):
        length, reaction = lift(mpf(3))
        step = result.steps[-1]
        assert step.reaction[0] == pytest.approx(float(reaction), rel=1e-13)
        left, right = step.contact
        assert [half - left.to, right.from_ - half] == pytest.approx([float(length)] * 2, rel=1e-13)


@pytest.mark.parametrize(("gap", "by", "event"), [(0.05, -0.1, "zone appears"), (0.0, 0.2, "zone vanishes"),
                                                  (-0.01, 0.1, "zone vanishes")])  # fmt: skip
def test_ground_rises_to_a_beam_and_sinks_from_it(gap, by, event):
    """Under its middle, which has gone down by 5 q L^4/384 EI."""
    loads = [uniform(Q, case="dead"), movement(by, foundation="clay")]
    ground = [{"name": "clay", "k": K, "side": "below", "gap": gap, "from": 1.0, "to": 5.0}]
    made = on_ground([6.0], ground, loads, [at(0), at(1)], EI=EI)
    factor = (5 * Q * 6.0**4 / (384 * EI) - gap) / by
    assert (pytest.approx(factor, rel=ROUNDINGS), event) in told(made)


@pytest.mark.parametrize("side", ["below", "above"])
def test_ground_that_turns_touches_where_it_is_level_with_the_beam(side):
    """w = g + factor v and w' = (g + factor v)' at one place, on either side of the beam."""
    sign = 1 if side == "below" else -1
    first, last = -0.16, -0.02
    loads = [uniform(sign * Q, case="dead"), movement([sign * first, sign * last], foundation=0)]
    made = on_ground([6.0], [{"k": K, "side": side, "gap": 0.05}], loads, [at(0), at(1)], EI=EI)

    def w(x):
        return Q * x * (216 - 12 * x**2 + x**3) / (24 * EI)

    with mp.workdps(30):
        def closing(x, factor):
            slope = factor * (last - mpf(first)) / 6
            return [w(x) - (mpf(0.05) + factor * mpf(first) + slope * x), mp.diff(w, x) - slope]

        x, factor = findroot(closing, (mpf(2), mpf("0.4")))
    event = gapbeam.solve(made | {"analysis": EVENTS}).events[0]
    assert (event.event, event.factor) == ("zone appears", pytest.approx(float(factor), rel=ROUNDINGS))
    assert event.x == pytest.approx(float(x), rel=1e-7)


def test_a_support_lets_go_beside_ground():
    """What a sinking middle support carried goes to the ground; it lets go where the beam on the ground alone would be."""
    loads = [uniform(Q, case="dead"), movement(0.1, support=1)]
    made = on_ground([5.0, 5.0], [{"k": K, "side": "below"}], loads, [at(0), at(1, side="below"), at(2)], EI=EI)
    alone = gapbeam.solve(on_ground([5.0, 5.0], made["foundation"], loads[:1], [at(0), at(2)], EI=EI)).at(5.0).deflection
    assert told(made)[-1] == (pytest.approx(float(alone) / 0.1, rel=1e-14), "opens")


def test_rows_of_springs_come_to_the_ground():
    """One-sided springs that a load moves, which stand for so much ground each: their error is of second order."""
    supports = [at(0), at(1, side="below"), at(2)]
    moves = [movement(0.04, support=1), uniform(Q, case="dead"), force(3.0, 4.0)]
    loads = [*moves, movement([0.05, -0.02], foundation=0)]
    ground = on_ground([5.0, 5.0], [{"k": K, "side": "below", "gap": 0.01}], loads, supports, EI=EI)
    right = gapbeam.solve(ground).at(np.array([2.5, 5.0, 7.5])).deflection
    errors = []
    for n in (40, 80, 160):
        x = [10.0 * (k + 0.5) / n for k in range(n)]
        springs = [at(x=one, side="below", gap=0.01, stiffness=K * 10.0 / n) for one in x]
        loads = moves + [movement(0.05 - 0.007 * one, support=3 + k) for k, one in enumerate(x)]
        result = gapbeam.solve(scene([5.0, 5.0], supports + springs, loads, EI=EI, analysis=EVENTS))
        errors.append(abs(result.at(np.array([2.5, 5.0, 7.5])).deflection - right).max() / abs(right).max())
    assert errors[-1] < 1e-4
    assert all(3.0 < a / b < 5.5 for a, b in pairwise(errors))


def scaled(made, factor):
    """The scene at rest with its live loads times a factor."""
    rest = at_rest(made, factor)
    for load in rest["loads"]:
        for key in ("F", "M", "q", "kappa") if load.get("case") != "dead" else ():
            if key in load:
                load[key] = [factor * one for one in load[key]] if isinstance(load[key], list) else factor * load[key]
    return rest


def compare(made, result, state):
    """In a state everything is as with settlements and gaps."""
    x, factor = np.linspace(0.0, sum(made["beam"]["spans"]), 41), state.factor
    fields, other = result.at_state(state, x), gapbeam.solve(scaled(made, factor)).at(x)
    for name in ("deflection", "moment", "shear", "pressure"):
        found, right = getattr(fields, name), getattr(other, name)
        assert found == pytest.approx(right, abs=1e-11 * abs(right).max()), (factor, name)


@pytest.mark.parametrize("block", range(6))
def test_random_scenes(block):
    """Between events, at the end, and on steps."""
    compared = 0
    for seed in range(12 * block, 12 * block + 12):
        made = random_moving_scene(seed)
        try:
            result = gapbeam.solve(made | {"analysis": EVENTS})
        except gapbeam.GapbeamError:  # supports that leave no room
            continue
        if result.status != "solved":
            continue
        for a, b in pairwise([0.0, *sorted({one.factor for one in result.events}), 1.0]):
            if b - a > 1e-6:
                compare(made, result, result.state((a + b) / 2))
                compared += 1
        steps = gapbeam.solve(made | {"analysis": {"steps": 3}})
        for step in steps.steps:
            compare(made, steps, step)
    assert compared > 12


def what_acts(made, factor):
    """Zones with whether they come to an end of their foundation, and supports that carry, by the oracle."""
    right, length = reference(at_rest(made, factor), factor, digits=50), sum(made["beam"]["spans"])
    zones = []
    for item, of in zip(at_rest(made, factor)["foundation"], right.contact, strict=True):
        ends = (item.get("from", 0.0), item.get("to", length))
        zones.append([(abs(zone.start - ends[0]) < 1e-20, abs(zone.end - ends[1]) < 1e-20) for zone in of])
    return zones, [abs(held.reaction) > 1e-25 for held in right.supports]


@pytest.mark.parametrize("seed", [2, 7, 15, 18, 21, 23, 47])
def test_random_paths_change_where_the_oracle_does(seed):
    """In 50 digits the zones are others, or the supports that carry, 2e-15 below and above each factor."""
    made = random_moving_scene(seed)
    events = [event for event in gapbeam.solve(made | {"analysis": EVENTS}).events if event.branch == 1]
    assert events
    with mp.workdps(80):
        for event in events:
            below, above = (what_acts(made, mpf(event.factor) * (1 + mpf(d))) for d in ("-2e-15", "2e-15"))
            assert below != above, event


@pytest.mark.parametrize("seed", [7, 12, 16, 18, 21, 23])
def test_mirrored_scenes(seed):
    made = random_moving_scene(seed)
    one, other = (gapbeam.solve(each | {"analysis": EVENTS}) for each in (made, mirrored(made)))
    assert [event.factor for event in one.events] == pytest.approx([event.factor for event in other.events], rel=1e-11)
    x = np.linspace(0.0, sum(made["beam"]["spans"]), 33)
    w, back = one.at(x).deflection, other.at(x[::-1]).deflection
    assert w == pytest.approx(back, abs=1e-12 * abs(w).max())


def moved(**keys):
    """Three supports, a weight, and three movements of two cases and of the weight's."""
    ground = [{"name": "clay", "from": 2.0, "to": 18.0, "k": K, "side": "below", "gap": 0.01}]
    loads = [
        uniform(0.3, case="dead"), movement(0.02, support=1, case="sinks"),
        movement([0.03, 0.01], foundation="clay", case="heaves"), movement(0.002, foundation="clay", case="dead"),
    ]  # fmt: skip
    return on_ground([10.0, 10.0], ground, loads, [at(0), at(1, side="below"), at(2)], EI=EI, **keys)


FACTORS = {"a": (1.35, 1.5, 0.0), "b": (1.0, 0.5, -1.0), "c": (1.0, 0.0, 2.0)}
"""Of the cases dead, sinks and heaves."""


def rested(dead, sinks, heaves):
    """The same at rest."""
    gap = [0.01 + 0.002 * dead + by * heaves for by in (0.03, 0.01)]
    ground = [{"from": 2.0, "to": 18.0, "k": K, "side": "below", "gap": gap}]
    supports = [at(0), at(1, side="below", settlement=0.02 * sinks), at(2)]
    return on_ground([10.0, 10.0], ground, [uniform(0.3 * dead)], supports, EI=EI)


@pytest.mark.parametrize("analysis", [{}, EVENTS, {"steps": 3}])
def test_combinations_multiply_movements(analysis):
    cases = ("dead", "sinks", "heaves")
    combinations = [{"name": name, "factors": dict(zip(cases, by, strict=True))} for name, by in FACTORS.items()]
    result = gapbeam.solve(moved(analysis=analysis) | {"combinations": combinations})
    x = np.linspace(0.0, 20.0, 41)
    for name, by in FACTORS.items():
        right = gapbeam.solve(rested(*by))
        assert result.combinations[name].at(x).deflection == pytest.approx(right.at(x).deflection, abs=1e-15)
        assert result.combinations[name].steps[-1].reaction == pytest.approx(right.steps[-1].reaction, abs=1e-13)
    assert result.envelope().extremes["deflection"]["min"].value < -0.005  # of ground that heaves


def test_prepared_cases_and_batches():
    """Every load by a factor of its own, also from the columns of a table."""
    prepared = gapbeam.prepare(moved())
    by = np.array([[dead, sinks, heaves, dead] for dead, sinks, heaves in FACTORS.values()])
    cases = prepared.solve(by)
    for k, factors in enumerate(FACTORS.values()):
        right = gapbeam.solve(rested(*factors))
        assert cases.reaction[k] == pytest.approx(right.steps[-1].reaction, abs=1e-13)
        assert prepared.result(by[k]).at(10.0).moment == pytest.approx(right.at(10.0).moment, abs=1e-13)
    names = ["loads[1].value", "factors.heaves", "loads[3].value"]
    numbers = gapbeam.function(moved(), names, [f"reaction[{k}]" for k in range(3)])([[0.02, 0.0, 0.002], [0.01, -1.0, 0.0]])
    for k, factors in enumerate(((1.0, 1.0, 0.0), (1.0, 0.5, -1.0))):
        right = rested(*factors)
        if k:
            right["foundation"][0]["gap"] = [0.01 - 0.03, 0.01 - 0.01]
        assert numbers[k] == pytest.approx(gapbeam.solve(right).steps[-1].reaction, abs=1e-13)


def test_trains_find_everything_moved():
    """They pass where live movements have come to their full values."""
    train = [{"name": "crane", "axles": [[0.0, 5.0], [2.0, 5.0]]}]
    found, right = (gapbeam.solve(one | {"trains": train}) for one in (moved(), rested(1.0, 1.0, 1.0)))
    for name in ("deflection", "moment", "shear", "pressure"):
        one, other = (each.envelope().extremes[name] for each in (found, right))
        assert [one[way].value for way in ("max", "min")] == pytest.approx([other[way].value for way in ("max", "min")], abs=1e-12)
    events = [[(event.support, event.event) for event in one.trains["crane"].events] for one in (found, right)]
    assert len(events[0]) > 4
    assert events[0] == events[1]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"foundation": "sand"}, r"loads\[0\].foundation: there is no foundation"),
        ({"foundation": 0, "support": 0}, "and foundation are both given"),
        ({"support": 0, "value": [1.0, 2.0]}, "a support moves by one number"),
        ({"foundation": 0, "value": None, "rotation": 0.1}, "a foundation moves by value"),
        ({"foundation": 0, "value": [0.1, float("inf")]}, "expected finite numbers"),
        ({"foundation": 0, "value": 1.2e308}, "smaller gaps and movements"),
        ({}, "give the support that moves, or foundation"),
    ],
)
def test_refusals(change, message):
    load = {"type": "movement", "value": 0.1, **change}
    load = {key: value for key, value in load.items() if value is not None}
    made = on_ground([4.0], [{"k": 100.0}], [load, movement(1.2e308, foundation=0)], [at(0), at(1)], EI=EI)
    with pytest.raises(gapbeam.GapbeamError, match=message):
        gapbeam.solve(made)


def test_supports_that_meet_are_named():
    """A support raised by 0.05 comes to one 0.02 above it at a factor of 0.4."""
    supports = [at(0), at(1, side="below", gap=0.01), at(1, side="above", gap=0.01), at(2)]
    made = on_ground([4.0, 4.0], [{"k": 100.0}], [uniform(10.0), movement(-0.05, support=1)], supports, EI=2000.0)
    for analysis in ({}, EVENTS):
        with pytest.raises(gapbeam.EngineError, match=r"supports\[1\] and supports\[2\].* from load factor 0.4 on"):
            gapbeam.solve(made | {"analysis": analysis})


def test_proofs_refuse_ground_that_moves():
    with pytest.raises(gapbeam.SceneError, match="write it as the gap of the foundation"):
        proof_data(moved())
