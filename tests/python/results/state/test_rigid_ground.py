"""Beams on rigid ground: closed forms, the limit of stiff springs, and what is refused."""

import math
from itertools import pairwise

import gapbeam
import mpmath as mp
import numpy as np
import pytest
from oracle.rigid_ground import excess
from scenes import force, scene, uniform

ROCK = {"k": math.inf, "side": "below"}


def at(x, **keys):
    """A support."""
    return {"x": x, **keys}


def solved(loads, ground=ROCK, supports=(), length=10.0, EI=1.0, N=0.0, mass=0.0, sections=(), **keys):
    """Result of a beam of one span that has to stand."""
    beam = scene([length], supports, loads, EI=EI, N=N, mass=mass, sections=sections)
    result = gapbeam.solve({**beam, "foundation": [ground], **keys})
    assert result.status == "solved", result.reason
    return result


def contact(result):
    """Ends and forces of what touches."""
    return [(one.from_, one.to, one.resultant) for one in result.steps[-1].contact]


def near(actual, expected, to=1e-13):
    """Equality to rounding of the largest."""
    np.testing.assert_allclose(np.ravel(actual), np.ravel(expected), rtol=0.0, atol=to * np.abs(expected).max())


def test_a_beam_lies_on_its_ground():
    result = solved([uniform(2.0), force(3.0, 5.0)])
    near(contact(result), [(0.0, 10.0, 20.0), (3.0, 3.0, 5.0)])
    assert result.extremes["moment"]["max"].value == result.extremes["deflection"]["max"].value == 0.0
    assert result.extremes["pressure"]["max"].value == 2.0


def test_an_end_that_is_lifted():
    """A force F lifts a beam of weight q over 2F/q, by 2 F^4/(3 EI q^3)."""
    result = solved([uniform(1.0), force(10.0, -1.5)])
    near(contact(result), [(0.0, 7.0, 7.0), (7.0, 7.0, 1.5)])
    span = result.steps[-1].free_spans[0]
    near([span.from_, span.to, span.sag], [7.0, 10.0, 27 / 8])
    near([result.extremes["moment"]["max"].value, result.extremes["shear"]["max"].value], [1.125, 1.5])
    # Also of what vanishes at both ends of the beam
    bounds = result.steps[-1].error_bounds
    assert all(1e-16 < bounds[field] < 1e-12 for field in ("deflection", "rotation", "moment", "shear")), bounds


@pytest.mark.parametrize("ratio", [1.0, 1.03, 20.0, 193.0, 900.0])
@pytest.mark.parametrize("up", [0.001, 0.0057, 0.1, 8.0])
def test_a_force_lifts_the_beam_where_its_stiffness_changes(ratio, up):
    """To both sides of it, over 3F/(2q) where EI is the same."""
    given = {**scene([5.0, 10.0], [], [uniform(10.0), force(5.0, -up)], EI=[1e3, 1e3 * ratio]), "foundation": [ROCK]}
    result = gapbeam.solve(given)
    left_over = excess(given, result)
    assert max(left_over.values()) < 1e-13, left_over
    (span,) = result.steps[-1].free_spans
    assert span.from_ < 5.0 < span.to
    if ratio == 1.0:
        near([span.from_, span.to], [5.0 - 0.075 * up, 5.0 + 0.075 * up])


@pytest.mark.parametrize("pull", [1e-6, 0.01, 1.0, 25.0, 1e4])
def test_an_end_that_is_lifted_of_a_pipe_that_is_pulled(pull):
    """From where it lies to its end, without moment at either: w_xx = a (cosh - 1) + b sinh."""
    with mp.workdps(200):
        rate = mp.sqrt(pull)

        def falls(length):
            """Deflection and force across the end, and the force where it lies."""
            a = 1 / mp.mpf(pull)
            b = -a * (mp.cosh(rate * length) - 1) / mp.sinh(rate * length)
            turn = a * (mp.sinh(rate * length) / rate - length) + b * (mp.cosh(rate * length) - 1) / rate
            way = a * ((mp.cosh(rate * length) - 1) / rate**2 - length**2 / 2)
            way += b * (mp.sinh(rate * length) / rate - length) / rate
            third = rate * (a * mp.sinh(rate * length) + b * mp.cosh(rate * length))
            return way, pull * turn - third, rate * b

        length = mp.findroot(lambda at: falls(at)[1] + mp.mpf(1.5), (1.5 + 1.0 / (1.0 / 1.5 + rate), 1.5))
        rise, _, push = falls(length)
        length, rise, push = float(length), float(abs(rise)), float(abs(push))
    lifted = solved([uniform(1.0), force(10.0, -1.5)], N=pull)
    near(contact(lifted), [(0.0, 10.0 - length, 10.0 - length), (10.0 - length, 10.0 - length, push)])
    near([lifted.steps[-1].free_spans[0].sag], [rise])


@pytest.mark.parametrize(("given", "power"), [([1.0, 3.0], 1), ({"from": 1.0, "to": 40.0, "power": 3}, 3)])
def test_an_end_that_is_lifted_of_a_haunch(given, power):
    """Over 2F/q as any other, since that is statics; the rise is the integral of (l - t) M/EI."""
    last = given[1] if power == 1 else given["to"]
    with mp.workdps(30):
        depth = lambda x: 1 + (mp.mpf(last) ** (mp.mpf(1) / power) - 1) * x / 10  # noqa: E731
        rise = mp.quad(lambda t: (3 - t) * (1.5 * t - t**2 / 2) / depth(7 + t) ** power, [0, 1, 2, 3])
    lifted = solved([uniform(1.0), force(10.0, -1.5)], sections=[{"from": 0.0, "to": 10.0, "EI": given}])
    near(contact(lifted), [(0.0, 7.0, 7.0), (7.0, 7.0, 1.5)])
    near([lifted.steps[-1].free_spans[0].sag], [float(rise)])


def test_an_end_that_is_lifted_of_a_haunch_that_is_pulled():
    """EI = 1 + x/5, N = 2: M_x = T - N w_x, T_x = -q from where it lies, in Taylor series of many digits."""
    with mp.workdps(25):

        def end(length):
            rates = lambda x, y: [y[1], -y[2] / (1 + (10 - length + x) / 5), y[3] - 2 * y[1], -1]  # noqa: E731
            return mp.odefun(rates, 0, [0, 0, 0, length - mp.mpf("1.5")])(length)

        length = mp.findroot(lambda length: end(length)[2], (mp.mpf("2.3"), mp.mpf("2.4")), solver="secant", tol=1e-18)
        rise = float(-end(length)[0])
        length = float(length)
    pulled = solved([uniform(1.0), force(10.0, -1.5)], N=2.0, sections=[{"from": 0.0, "to": 10.0, "EI": [1.0, 3.0]}])
    near([pulled.steps[-1].free_spans[0].from_, pulled.steps[-1].free_spans[0].sag], [10.0 - length, rise])


def test_where_the_axial_force_changes_on_a_slope():
    """Held along its axis there, the beam leans on the ground with the change times the slope, or is lifted by that."""
    given = {**scene([4.0, 6.0], [], [uniform(5.0)], EI=[10.0, 2000.0], N=[7.0, 40.0]),
             "foundation": [ROCK | {"gap": [0.0, 0.1], "from": 0.0, "to": 10.0}]}  # fmt: skip
    result = gapbeam.solve(given)
    near([one for one in contact(result) if one[0] == one[1] <= 4.0], [(0.0, 0.0, 0.07), (4.0, 4.0, 0.33)])
    assert [round(one.to, 9) for one in result.steps[-1].free_spans] == [10.0]
    given["foundation"][0]["gap"] = [0.1, 0.0]
    result = gapbeam.solve(given)
    left_over = excess(given, result)
    assert [one.from_ < 4.0 < one.to for one in result.steps[-1].free_spans] == [False, True]
    assert max(left_over.values()) < 1e-13, left_over


def test_cold_pulls_the_beam_to_its_ground():
    """Axial loads pull as N does; what compresses a beam that nothing else holds is refused."""
    ends = [at(0.0, direction="axial"), at(10.0, direction="axial")]
    loads, keys = [uniform(1.0), force(10.0, -1.5)], {"EA": 100.0, "alpha": 1e-3}
    cold = gapbeam.solve({**scene([10.0], ends, [*loads, {"type": "temperature", "dT": -10.0}], **keys), "foundation": [ROCK]})
    near(contact(cold), contact(solved(loads, N=1.0)))
    with pytest.raises(gapbeam.EngineError, match="compressed in this version only where it is stable off the ground"):
        gapbeam.solve({**scene([10.0], ends, [*loads, {"type": "temperature", "dT": 10.0}], **keys), "foundation": [ROCK]})


def rock_beyond(supports, loads=(), **keys):
    """A beam of 20 m that lies on rock from 6 m on, under its weight."""
    beam = scene([6.0, 14.0], supports, [uniform(2.0), *loads], EI=500.0)
    return gapbeam.solve({**beam, "foundation": [ROCK | {"from": 6.0}], **keys})


def test_rotations_with_laws_and_turned_supports_beside_the_ground():
    """As with the couples that they give."""
    pinned = [at(0.0)]
    yields = rock_beyond([at(0.0, rotation={"law": [[0.0, 3.0], [1.0, 3.0]]})])
    near(contact(yields), contact(rock_beyond(pinned, [{"type": "moment", "x": 0.0, "M": -3.0}])))
    turned = rock_beyond([at(0.0, rotation="fixed")], [{"type": "movement", "support": 0, "rotation": 0.01}])
    couple = {"type": "moment", "x": 0.0, "M": float(turned.at(0.0).moment)}
    near(contact(turned), contact(rock_beyond(pinned, [couple])))
    near([turned.at(0.0).rotation], [0.01])
    slack = rock_beyond([at(0.0, rotation="fixed")], hinges=[{"x": 3.0, "stiffness": 500.0, "slack": 1e-3}])
    moment = float(slack.at(3.0).moment)
    passed = [{"type": "moment", "x": 3.0, "M": sign * moment, "at_hinge": side} for side, sign in (("left", -1.0), ("right", 1.0))]
    near(contact(slack), contact(rock_beyond([at(0.0, rotation="fixed")], passed, hinges=[{"x": 3.0}])))
    turns = [float(slack.at(3.0, side=side).rotation) for side in ("left", "right")]
    near([500.0 * (turns[0] - turns[1] - math.copysign(1e-3, moment))], [moment], 1e-12)


def test_a_curvature_that_changes_beside_the_ground():
    """As many that are the same along short lengths."""
    off = []
    for parts in (20, 40):
        cuts = [5.0 * k / parts for k in range(parts + 1)]
        steps = [{"type": "curvature", "from": a, "to": b, "kappa": 0.002 * (a + b) / 2} for a, b in pairwise(cuts)]
        changes = {"type": "curvature", "from": 0.0, "to": 5.0, "kappa": [0.0, 0.01]}
        told, expected = (rock_beyond([at(0.0, rotation="fixed")], loads).steps[-1] for loads in ([changes], steps))
        off.append(abs(told.reaction[0] - expected.reaction[0]))
    assert off[1] < off[0] / 3.9 < 1e-3


def test_over_a_stop():
    """A beam over a stop of height D hangs free over (72 EI D/q)^(1/4) on both sides."""
    result = solved([uniform(3.0)], supports=[at(5.0, side="below", gap=-0.02)], EI=200.0)
    free = (72 * 200.0 * 0.02 / 3.0) ** 0.25
    near([one.to - one.from_ for one in result.steps[-1].free_spans], [2 * free])
    near(result.steps[-1].reaction, [3.0 * 2 * free * 2 / 3])


def test_frequencies_of_free_spans():
    """Clamped where they leave the ground, pinned on a peak: over a stop, those of a span with one end pinned, or none."""
    EI, q, height, mass = 200.0, 3.0, 0.02, 1.5
    free = (72 * EI * height / q) ** 0.25
    pinned, clamped = lambda b: mp.tan(b) - mp.tanh(b), lambda b: mp.cos(b) * mp.cosh(b) - 1
    roots = [mp.findroot(*one) for one in ((pinned, 3.9), (clamped, 4.7), (pinned, 7.1), (clamped, 7.9))]
    expected = [float((root / free) ** 2) * math.sqrt(EI / mass) for root in roots]
    keys = {"mass": mass, "analysis": {"frequencies": 4}}
    stop = solved([uniform(q)], supports=[at(5.0, side="below", gap=-height)], EI=EI, **keys)
    near(stop.frequencies, expected)
    peak = ROCK | {"profile": [[0.0, 0.0], [4.5, 0.0], [5.0, -height], [5.5, 0.0], [10.0, 0.0]]}
    near(solved([uniform(q)], peak, EI=EI, **keys).frequencies, expected)
    assert np.abs(stop.mode("vibration", 2).deflection).max() == 1.0
    assert solved([uniform(q)], EI=EI, **keys).frequencies == ()  # all of it lies


def test_over_an_edge():
    """Beyond an edge a couple m lifts the beam off the ground over 2 sqrt(m/q), and it leans on the edge."""
    result = solved([uniform(1.0, **{"from": 0.0, "to": 6.0}), force(10.0, 0.25)], ground=ROCK | {"to": 6.0})
    span = result.steps[-1].free_spans[0]
    near([span.from_, span.to], [6.0 - 2 * math.sqrt(1.0), 6.0])
    near(contact(result), [(0.0, 4.0, 4.0), (4.0, 4.0, 0.5), (6.0, 6.0, 1.75)])


def test_touching_at_one_place():
    """The floor under a simple beam takes what is missing of the deflection, until the moment there would vanish."""
    supports = [at(0.0), at(10.0)]
    free = 5 * 2.0 * 10.0**4 / (384 * 1e3)
    result = solved([uniform(2.0)], ROCK | {"gap": 0.1}, supports, EI=1e3)
    near(contact(result), [(5.0, 5.0, (free - 0.1) * 48e3 / 1000.0)])
    # Then it lies there: a bar without moments at both ends falls by q a^4/(24 EI) to where it is level
    result = solved([uniform(2.0)], ROCK | {"gap": 0.01}, supports, EI=1e3)
    aside = (24 * 1e3 * 0.01 / 2.0) ** 0.25
    near([contact(result)[0][0], contact(result)[-1][1]], [aside, 10.0 - aside])


def test_a_slab_that_curls():
    """Cold above, an end lifts over sqrt(2 EI kappa/q) by EI kappa^2/(2q); where it lies it is bent back all along."""
    kappa, EI, q = 2e-3, 5e3, 4.0
    result = solved([uniform(q, case="dead"), {"type": "curvature", "kappa": -kappa}], EI=EI)
    free, rise = math.sqrt(2 * EI * kappa / q), EI * kappa**2 / (2 * q)
    near([(one.from_, one.to, one.sag) for one in result.steps[-1].free_spans], [(0, free, rise), (10 - free, 10, rise)])
    near(contact(result), [(free, free, q * free), (free, 10 - free, q * (10 - 2 * free)), (10 - free, 10 - free, q * free)])
    near(result.at([4.0, 5.0, 6.0]).moment, [-EI * kappa] * 3)


def test_the_limit_of_stiff_springs():
    """With a stiffness k the lifted length is off by the order of k^(-1/4)."""
    loads = [uniform(1.0), force(10.0, -1.5)]
    off = []
    for k in (1e6, 1e10):
        span = solved(loads, {"k": k, "side": "below"}).steps[-1].free_spans[-1]
        off.append(abs(span.to - span.from_ - 3.0))
    assert off[1] < off[0] / 9 < 0.02


def test_where_the_beam_cannot_stand():
    result = gapbeam.solve({**scene([10.0], [], [uniform(-1.0)]), "foundation": [ROCK]})
    assert result.status == "no-equilibrium"
    loads = [uniform(1.0, **{"from": 0.0, "to": 6.0}), force(10.0, 6.0)]
    result = gapbeam.solve({**scene([10.0], [], loads), "foundation": [ROCK | {"to": 6.0}]})
    assert result.status == "no-equilibrium"


def test_a_support_at_the_level_of_the_ground_takes_all():
    result = solved([uniform(1.0)], supports=[at(0.0), at(4.0), at(10.0, rotation="fixed")])
    assert result.steps[-1].reaction.tolist() == [0.0, 0.0, 0.0]
    near(contact(result), [(0.0, 10.0, 10.0)])


def test_steps_combinations_and_prepared_cases():
    loads = [uniform(1.0, case="dead"), force(10.0, -1.5)]
    lifted = [step.contact[0].to for step in solved(loads, analysis={"steps": 3}).steps]
    near(lifted, [9.0, 8.0, 7.0])
    combinations = [{"name": "low", "factors": {"dead": 1.0, "live": 0.5}}, {"name": "high", "factors": {"dead": 1.0, "live": 1.0}}]
    result = gapbeam.solve({**scene([10.0], [], loads), "foundation": [ROCK], "combinations": combinations})
    assert result.envelope().extremes["moment"]["max"].value == pytest.approx(1.125, rel=1e-13)
    cases = gapbeam.prepare({**scene([10.0], [], loads), "foundation": [ROCK]}).solve([[1.0, 0.5], [1.0, 1.0], [1.0, 2.0]])
    near(cases.extremes["moment"]["max"].value, [0.75**2 / 2, 1.5**2 / 2, 3.0**2 / 2])


def test_point_forces_in_report_data_and_picture():
    result = solved([uniform(1.0), force(10.0, -1.5)])
    zones = result.to_dict()["steps"][-1]["contact"]
    assert [(zone["from"], zone["to"], zone["state"]) for zone in zones] == [(0.0, 7.0, "closed"), (7.0, 7.0, "closed")]
    assert "7   7       0  ● in contact        1.5" in result.report()
    over = solved([uniform(1.0)], ROCK | {"profile": [[0.0, 0.0], [4.0, -0.1], [8.0, 0.0]]}, EI=1e4)
    assert "places" in over.report()
    labels = [line.get_label() for axes in over.plot().axes for line in axes.lines]
    assert "point contact" in labels


@pytest.mark.parametrize(
    ("keys", "problem"),
    [
        (
            {
                "sections": [{"from": 2.0, "to": 8.0, "EI": [1.0, 2.0]}],
                "loads": [{"type": "curvature", "from": 4.0, "to": 5.0, "kappa": 0.1}],
            },
            "foundation[0].k: from x = 4 to x = 5 a curvature is imposed on a beam that tapers there, which on rigid ground is not "
            "available in this version; give the ground a stiffness",
        ),
        (
            {"foundation": [{"k": math.inf}]},
            "foundation[0].side: rigid ground holds the beam one way only; give side below or above",
        ),
        (
            {"foundation": [ROCK | {"k": [1.0, math.inf]}]},
            "foundation[0].k: rigid ground is rigid all along, got inf at one end only; give two foundations",
        ),
        (
            {"foundation": [ROCK | {"to": 4.0}, {"k": 1.0, "from": 4.0}]},
            "foundation[0].k: rigid ground beside ground that gives way is not available in this version; give all of it a "
            "stiffness, or none",
        ),
        (
            {"beam": {"spans": [10.0], "EI": 1.0, "GA": 5.0}},
            "foundation[0].k: from x = 0 to x = 10 the beam has a finite GA there, which on rigid ground is not available in this "
            "version; give the ground a stiffness",
        ),
        (
            {"supports": [at(2.0, settlement=0.1)]},
            "supports[0]: this one holds the beam at a deflection of 0.1, which the rigid ground there stops at 0; give the "
            "foundation a greater gap",
        ),
        (
            {"supports": [at(2.0, direction="rotational", law=[[0.0, 1.0], [1.0, 2.0]])]},
            "supports[0].direction: a support that holds a rotation by a law, a slack, one way or at a hinge is not available over "
            "rigid ground; give the ground a stiffness",
        ),
        (
            {"supports": [at(2.0, rotation=3.0)]},
            "supports[0].rotation: a support that holds the rotation elastically is not available over rigid ground; hold it "
            "rigidly, or not",
        ),
        (
            {"trains": [{"axles": [[0.0, 1.0]]}]},
            "trains: the train train 1 goes over rigid ground, which is not available in this version; give the ground a stiffness",
        ),
    ],
)
def test_what_is_refused(keys, problem):
    with pytest.raises(gapbeam.SceneError) as error:
        gapbeam.solve({**scene([10.0], [], [uniform(1.0)]), "foundation": [ROCK]} | keys)
    assert str(error.value) == problem


def test_events_are_refused():
    with pytest.raises(gapbeam.EngineError, match="not followed from event to event in this version; take steps"):
        solved([uniform(1.0)], analysis={"follow": "events"})


def test_rigid_ground_that_moves():
    """Ground that sinks under its right half is ground with a corner; at load factor 1/2 it has sunk by half."""
    ground = [ROCK | {"to": 6.0, "name": "left"}, ROCK | {"from": 6.0, "name": "right"}]
    loads = [uniform(1.0, case="dead"), {"type": "movement", "foundation": "right", "value": [0.0, 0.02]}]
    given = {**scene([10.0], [], loads, EI=100.0), "foundation": ground, "analysis": {"steps": 2}}
    result = gapbeam.solve(given)
    for step, sunk in zip(result.steps, (0.01, 0.02), strict=True):
        still = {**scene([10.0], [], loads[:1], EI=100.0), "foundation": [ground[0], ground[1] | {"gap": [0.0, sunk]}]}
        expected = gapbeam.solve(still).steps[-1].contact
        assert [one.foundation for one in step.contact] == [one.foundation for one in expected]
        near([(one.from_, one.to, one.resultant) for one in step.contact],
             [(one.from_, one.to, one.resultant) for one in expected])  # fmt: skip


def test_rigid_foundations_one_over_another_are_refused():
    """They ended the process."""
    ground = [{"side": "below", "from": 0.2, "to": 1.5, "k": math.inf}, {"side": "below", "k": math.inf}]
    with pytest.raises(gapbeam.SceneError, match=r"foundation\[0\]\.k: from x = 0\.2 to x = 1\.5 one foundation lies over another"):
        gapbeam.solve({"beam": {"spans": [2.0, 3.5], "EI": 1800.0}, "supports": [], "loads": [], "foundation": ground})


@pytest.mark.parametrize("side", ["below", "above"])
@pytest.mark.parametrize("couple", [-0.7, 0.7])
def test_a_support_about_which_the_beam_turns_into_the_ground(side, couple):
    """Ground beside the support would have to take the couple without a lever, by a force without bounds."""
    scene = {"beam": {"spans": [7], "EI": 3000}, "supports": [{"x": 2}], "foundation": [{"k": float("inf"), "side": side}],
             "loads": [{"type": "moment", "x": 6.98, "M": couple}]}  # fmt: skip
    with pytest.raises(gapbeam.EngineError, match="hold it where it turns into the ground"):
        gapbeam.solve(scene)


@pytest.mark.parametrize("kappa", [0.001, -0.001])
def test_a_beam_that_balances_on_a_peak_and_touches_beside_it_without_force(kappa):
    """It may tilt off what it touches: forces are unique, the position is not."""
    rock = {"k": math.inf, "side": "below", "profile": [[0.0, 0.03], [3.0, 0.0], [6.0, 0.03]]}
    loads = [{"type": "uniform", "q": 1.0}, {"type": "curvature", "kappa": kappa}]
    scene = {"beam": {"spans": [6.0], "EI": 1e4}, "foundation": [rock], "loads": loads}
    for supports in ([], [{"node": 0, "side": "below"}], [{"node": 1, "side": "below"}]):
        result = gapbeam.solve({**scene, "supports": supports})
        assert result.steps[-1].indifferent
        assert result.reason == "solved, but free to move: its position is not unique"
        assert result.at(3.0).moment == pytest.approx(-4.5, rel=1e-14)
    held = gapbeam.solve({**scene, "supports": [{"node": 0}]})
    assert not held.steps[-1].indifferent
