"""Axial force in bending: closed forms, independent solutions in many digits, ground, compression, what is refused."""

import math
import random
import re

import gapbeam
import numpy as np
import pytest
from attack import axial_force as attacked
from gapbeam.base.errors import SceneError
from oracle.axial_modes import buckling, frequencies
from oracle.axial_path import follow
from scenes import axial_force as generated
from scenes import force, scene, uniform

PINS = [{"node": 0}, {"node": 1}]
STOP = {"x": 0.5, "side": "below", "gap": 0.02}
PE = math.pi**2


def beam(N, supports=PINS, loads=(), length=1.0, EI=1.0, **keys):
    """A scene of one span with an axial force."""
    found = scene([length], list(supports), list(loads), EI=EI)
    return {**found, "beam": {**found["beam"], "N": N}, **keys}


@pytest.mark.parametrize(
    ("u", "w", "moment"),
    [
        (0.001, 0.013020832009548745, 0.124999986979168),
        (1.0, 0.011818883970073909, 0.113181116029926),
        (3.0, 0.0067913090733614872, 0.0638782183397466),
    ],
)
def test_a_uniform_load_under_tension(u, w, moment):
    found = gapbeam.solve(beam(u**2, loads=[uniform(1.0)])).at(0.5)
    assert found.deflection == pytest.approx(w, rel=1e-14)
    assert found.moment == pytest.approx(moment, rel=1e-14)


@pytest.mark.parametrize(("u", "w"), [(0.001, 0.0208333312500002), (1.0, 0.0189414213699951), (3.0, 0.0110157730806506)])
def test_a_force_under_tension(u, w):
    assert gapbeam.solve(beam(u**2, loads=[force(0.5, 1.0)])).at(0.5).deflection == pytest.approx(w, rel=1e-13)


@pytest.mark.parametrize(("u", "reaction"), [(1.0, 59.75731044135905), (3.0, 57.111825264558784)])
def test_a_stop_under_tension(u, reaction):
    stop = {"x": 5.0, "side": "below", "gap": 0.005}
    result = gapbeam.solve(beam(u**2 * 100.0, [*PINS, stop], [uniform(10.0)], 10.0, 1e4))
    assert result.steps[-1].reaction[2] == pytest.approx(reaction, rel=1e-14)


def test_shear_and_transverse_force():
    u, q = 3.0, 1.0
    result = gapbeam.solve(beam(u**2, loads=[uniform(q)]))
    found = result.at([0.0, 0.2])
    # Of a simple beam the reactions do not feel N; the shear is q tanh(u/2)/u
    np.testing.assert_allclose(found.transverse, [0.5, 0.3], rtol=1e-14)
    np.testing.assert_allclose(found.shear[0], math.tanh(u / 2) / u, rtol=1e-14)
    np.testing.assert_allclose(found.transverse, found.shear + u**2 * found.rotation, rtol=1e-13)
    assert result.steps[-1].reaction[0] == 0.5
    assert result.extremes["transverse"]["max"].value == 0.5


def test_transverse_force_is_greatest_where_ground_and_load_balance():
    half = {**uniform(1.0), "from": 0.0, "to": 2.5}
    result = gapbeam.solve(beam(0.5, [], [half], 5.0, foundation=[{"k": 40.0}]))
    greatest = result.extremes["transverse"]["max"]
    assert 0.0 < greatest.x < 2.5
    assert 40.0 * result.at(greatest.x).deflection == pytest.approx(1.0, rel=1e-12)
    assert greatest.value == pytest.approx(result.at(np.linspace(0.0, 5.0, 2001)).transverse.max(), rel=1e-5)


def test_shear_flexibility_by_engesser():
    # A column of N0 = pi**2 EI/L**2 gives way at N0/(1 + N0/GA)
    columns = beam(-1.0, loads=[uniform(1.0)], analysis={"buckling": 2})
    columns["beam"]["GA"] = 5.0
    found = gapbeam.solve(columns).buckling
    np.testing.assert_allclose(found, [k**2 * PE / (1 + k**2 * PE / 5.0) for k in (1, 2)], rtol=1e-14)


@pytest.mark.parametrize(
    ("N", "half", "w"),
    [
        (0.0, math.pi / 2, 0.136291426340921),
        (0.5, 2.065569613649225, 0.119333969689935),
        (1.0, 2.41839915231229, 0.112186856560072),
    ],
)
def test_a_weightless_beam_on_one_sided_ground(N, half, w):
    result = gapbeam.solve(beam(N, [], [force(40.0, 1.0)], 80.0, foundation=[{"k": 4.0, "side": "below"}]))
    found = result.at(40.0)
    assert found.deflection == pytest.approx(w, rel=1e-13)
    assert found.moment == pytest.approx(2 * w, rel=1e-13)
    middle = next(zone for zone in result.steps[-1].contact if zone.from_ < 40.0 < zone.to)
    assert (middle.from_, middle.to) == pytest.approx((40.0 - half, 40.0 + half), rel=1e-13)


def test_a_pasternak_layer_acts_as_tension():
    ground = {"k": 3.0}
    loads = [uniform(1.0), force(2.0, 5.0)]
    by_layer = gapbeam.solve(beam(0.0, [], loads, 5.0, foundation=[{**ground, "shear": 2.5}]))
    by_force = gapbeam.solve(beam(2.5, [], loads, 5.0, foundation=[ground]))
    x = np.linspace(0.0, 5.0, 11)
    np.testing.assert_array_equal(by_layer.at(x).deflection, by_force.at(x).deflection)
    assert by_layer.buckling == ()


@pytest.mark.parametrize(
    ("share", "reaction"), [(0.34, 0.0), (0.5, 0.14714005862549203), (0.9, 0.53807030793317657), (2.0, 1.6440875059318176)]
)
def test_a_column_against_a_stop(share, reaction):
    result = gapbeam.solve(beam(-share * PE, [*PINS, STOP], [uniform(1.0)]))
    step = result.steps[-1]
    assert step.reaction[2] == pytest.approx(reaction, rel=1e-13)
    # Beyond the Euler load nothing but the stop holds it
    assert step.unique is (share < 1.0)


def test_a_column_closes_its_stop_at_the_load_of_the_closed_form():
    closes = 0.34815287816531529
    for share, closed in ((closes * (1 - 1e-13), False), (closes * (1 + 1e-13), True)):
        step = gapbeam.solve(beam(-share * PE, [*PINS, STOP], [uniform(1.0)])).steps[-1]
        assert bool(step.closed[2]) is closed


def test_a_column_buckles_beside_its_stop():
    result = gapbeam.solve(beam(-5.0 * PE, [*PINS, STOP], [uniform(1.0)]))
    assert result.status == "buckles"
    assert "bears 0.8 times its axial forces" in result.reason
    x, w = np.transpose(result.motion)
    np.testing.assert_allclose(np.abs(w), np.abs(np.sin(2 * math.pi * x)), atol=1e-6)


@pytest.mark.parametrize("N", [1e8, 1e12, 1e16])
def test_a_beam_in_great_tension_is_a_string_but_near_its_ends(N):
    """Extremes were looked for in millions of pieces, minutes long, and at 1e16 none was found."""
    made = scene([100.0], PINS, [uniform(1.0), {"type": "linear", "q": [1.0, 2.0]}], EI=1.0, N=N)
    found = gapbeam.solve(made).extremes
    # N w'' = -(2 + x/100)
    x = max(np.roots([-1 / 200.0, -2.0, 7 / 6 * 100.0]))
    w = (700 / 6 * x - x**2 - x**3 / 600.0) / N
    assert found["deflection"]["max"].x == pytest.approx(x, rel=1e-3)
    assert found["deflection"]["max"].value == pytest.approx(w, rel=1e-5 if N < 1e9 else 1e-8)
    assert found["deflection"]["min"].value == 0.0
    # Near its ends it bends until it has the curvature of the string
    assert found["moment"]["max"].value == pytest.approx(3.0 / N, rel=1e-3)
    assert found["transverse"]["max"].value == pytest.approx(700 / 6, rel=1e-6)


def test_tension_holds_what_turns_about_one_support():
    """On one support a beam turns until N balances the loads, also where the search passes the beam without any, which moves."""
    draw = random.Random(0)
    for _ in range(300):
        forces, N = [(draw.uniform(0.0, 1.0), draw.uniform(-30.0, 30.0)) for _ in range(3)], 10.0 ** draw.uniform(-1, 1)
        about_left, about_right = sum(x * F for x, F in forces), sum((1.0 - x) * F for x, F in forces)
        ends = [{"node": 0, "side": "below"}, {"node": 1, "side": "above"}]
        result = gapbeam.solve(beam(N, supports=ends, loads=[force(x, F) for x, F in forces]))
        on_left, on_right = about_left + about_right > 0.0 < about_left, about_left + about_right < 0.0 > about_right
        assert on_left or on_right or about_right > 0.0 > about_left
        assert result.status == "solved"
        if on_left:
            assert result.at(1.0).deflection == pytest.approx(about_left / N, rel=1e-12)
        if on_right:
            assert result.at(0.0).deflection == pytest.approx(about_right / N, rel=1e-12)


def test_a_deflection_that_passes_zero_is_no_jump():
    """At the only place of the left span that was looked at: the path ended there, though nothing happens."""
    scene = {
        "beam": {"spans": [5.0, 5.0], "EI": 100.0, "N": [-20.04545455, 0.95454545]},
        "supports": [{"node": 0}, {"node": 1, "side": "below"}, {"node": 2}],
        "loads": [uniform(2.1), force(4.4152043928831635, -5.0)],
    }
    (step,) = gapbeam.solve(scene).steps
    assert not step.unique
    two_sided = {**scene, "supports": [{"node": 0}, {"node": 1}, {"node": 2}]}
    np.testing.assert_allclose(step.reaction, gapbeam.solve(two_sided).steps[-1].reaction, rtol=1e-14)


@pytest.mark.parametrize(("N", "status"), [(-1.99, "solved"), (-2.01, "buckles"), (-3.9, "buckles")])
def test_moments_that_are_rounding_are_no_jump(N, status):
    """A long beam with free ends under a uniform load on even ground only sinks; it buckles from an end, at sqrt(k EI)."""
    beam = {"spans": [30.0], "EI": 1.0, "N": N}
    result = gapbeam.solve({"beam": beam, "supports": [], "foundation": [{"k": 4.0}], "loads": [uniform(1.0)]})
    assert result.status == status
    if result.status == "buckles":
        (share,) = re.findall("bears (.*) times", result.reason)
        assert float(share) * N == pytest.approx(-2.0, rel=1e-5)


@pytest.mark.parametrize("N", [-3.0, 1e-3, 2.0, 70.0, 1e4])
def test_the_transverse_force_has_all_digits_inside_a_span(N):
    """Loads and reactions balance it, whatever bends."""
    spans = np.array([1.0, 0.8, 1.3])
    made = scene(spans.tolist(), [{"node": n} for n in range(4)], [uniform(1.0)], EI=1.0, N=N)
    result = gapbeam.solve(made)
    reactions, x = result.steps[-1].reaction, np.linspace(0.0, 3.05, 30)
    exact = [sum(reactions[np.concatenate(([0.0], np.cumsum(spans))) <= place]) - place for place in x]
    assert result.at(x).transverse == pytest.approx(exact, abs=2e-15)


def test_what_a_beam_bears_does_not_depend_on_what_it_is_asked_for():
    """A jump to another stable state on the way, at the upper stop, was taken or not as the steps fell."""
    scene = {
        "beam": {"spans": [5.0, 7.5, 6.0, 6.0], "EI": 6400.0},
        "supports": [
            {"node": 0, "side": "below", "stiffness": 1e3}, {"node": 0, "side": "above", "stiffness": 1e4, "gap": 0.002},
            {"node": 2, "side": "below"}, {"node": 3}, {"node": 4, "stiffness": 1e4},
        ],
        "loads": [uniform(1.0), force(20.7265, 25.0), force(16.7265, 25.0)],
    }  # fmt: skip

    def under(N):
        return gapbeam.solve({**scene, "beam": {**scene["beam"], "N": N}})

    found = []
    for N in (-786.0, -670.0, -600.0, -565.0):
        (share,) = re.findall("bears (.*) times", under(N).reason)
        found.append(float(share) * N)
    assert found == pytest.approx([found[0]] * 4, rel=1e-5)
    assert [under(N).status for N in (0.9999 * found[0], 1.0001 * found[0])] == ["solved", "buckles"]


@pytest.mark.parametrize("N", [-1e4, -1e9, -1e300])
@pytest.mark.parametrize(
    "ground", [None, {"k": 10.0}, {"law": [[0.1, 1.0], [0.2, 1.1]]}, {"law": {"type": "cubic", "k1": 10.0, "k3": 3.0}}]
)
def test_hopeless_compression_is_cut_no_finer_than_what_the_beam_bears(N, ground):
    """N of a slip of the keyboard once took minutes, or the memory."""

    def beam_under(N):
        scene = {"beam": {"spans": [6.0], "EI": 1.0, "N": N}, "supports": [{"node": 0}, {"node": 1}]}
        if ground:
            scene["foundation"] = [{"side": "below", **ground}]
        return gapbeam.solve({**scene, "loads": [uniform(1.0)]})

    (share,), (other,) = (re.findall("bears (.*) times", beam_under(value).reason) for value in (N, -1e3))
    assert float(share) * N == pytest.approx(float(other) * -1e3, rel=2e-5)
    if not ground:
        assert float(share) * N == pytest.approx(-((math.pi / 6) ** 2), rel=1e-5)


@pytest.mark.parametrize("N", [-215.0, -300.0, -1000.0])
def test_a_beam_without_loads_buckles_off_ground_that_presses_it(N):
    """Beyond that no zones are in equilibrium; to look for some anew at every share once took minutes."""
    ground = {"k": 300.0, "side": "above", "gap": -0.001}
    result = gapbeam.solve({"beam": {"spans": [9.0], "EI": 4000.0, "N": N}, "supports": [{"x": 3.0}], "foundation": [ground]})
    assert result.status == "buckles"
    (share,) = re.findall("bears (.*) times", result.reason)
    assert float(share) * N == pytest.approx(-210.147, rel=1e-5)


@pytest.mark.parametrize("N", [-60.0, -150.0])
def test_ground_that_yields_lets_a_rail_buckle(N):
    """At the limit load of 400 Hermite elements, 4 points each, followed by the deflection in the middle: 53.64458."""
    law = {"type": "tanh", "stiffness": 10.0, "limit": 5.0}
    data = scene([20.0], PINS, [force(10.0, 6.0)], EI=100.0, N=N)
    result = gapbeam.solve({**data, "foundation": [{"side": "both", "law": law}]})
    assert result.status == "buckles"
    share = float(re.search(r"the beam bears (\S+) times", result.reason)[1])
    assert share * -N == pytest.approx(53.64458, rel=2e-6)


def test_a_beam_without_a_support_at_its_end_buckles_at_a_quarter():
    result = gapbeam.solve(beam(-0.26 * PE, [{"node": 0, "rotation": "fixed"}], [uniform(1.0)]))
    assert result.status == "buckles"
    assert gapbeam.solve(beam(-0.24 * PE, [{"node": 0, "rotation": "fixed"}], [uniform(1.0)])).status == "solved"


@pytest.mark.parametrize(("k", "factor"), [(10.0, 1.2046188484569489), (50.0, 2.0075802309154398), (16 * PE, 4.0), (500.0, 4.0)])
def test_factors_of_buckling(k, factor):
    result = gapbeam.solve(beam(-PE, [*PINS, {"x": 0.5, "stiffness": k}], [uniform(1.0)], analysis={"buckling": 1}))
    assert result.buckling == pytest.approx((factor,), rel=1e-14)


def test_frequencies_with_a_support_closed_and_open():
    for gap, expected in ((0.0, (9.869604401089, 15.41820571698)), (1.0, (2.467401100272, 9.869604401089))):
        supports = [{"node": 0}, {"node": 1, "side": "below", "gap": gap}, {"node": 2}]
        found = scene([1.0, 1.0], supports, [uniform(1.0)], EI=1.0)
        result = gapbeam.solve({**found, "beam": {**found["beam"], "mass": 1.0}, "analysis": {"frequencies": 2}})
        assert result.frequencies == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(("N", "expected"), [(0.0, (0.923729504793, 2.4934881405)), (5.0, (1.76512387529, 3.80941611761))])
def test_frequencies_of_a_free_span(N, expected):
    ground = [{"k": 100.0, "to": 10.0}, {"k": 100.0, "from": 14.0}]
    found = scene([10.0, 4.0, 10.0], [{"node": 0}, {"node": 3}], [uniform(1.0)], EI=1.0)
    data = {**found, "beam": {**found["beam"], "N": N, "mass": 1.0}, "foundation": ground, "analysis": {"frequencies": 2}}
    assert gapbeam.solve(data).frequencies == pytest.approx(expected, rel=1e-11)


def test_modes_are_shaped_as_sines():
    data = beam(-1.0, loads=[uniform(1.0)], analysis={"buckling": 2, "frequencies": 2})
    data["beam"]["mass"] = 2.0
    result = gapbeam.solve(data)
    np.testing.assert_allclose(result.buckling, [PE, 4 * PE], rtol=1e-14)
    np.testing.assert_allclose(result.frequencies, [math.sqrt((k**4 * PE**2 - k**2 * PE) / 2.0) for k in (1, 2)], rtol=1e-14)
    for kind in ("buckling", "vibration"):
        mode = result.mode(kind, 2)
        np.testing.assert_allclose(np.abs(mode.deflection), np.abs(np.sin(2 * math.pi * mode.x)), atol=1e-10)
    with pytest.raises(ValueError, match="number: expected 1 or more, got 0"):
        result.mode("buckling", 0)
    held = beam(-1.0, [{"node": 0, "rotation": "fixed"}], loads=[uniform(1.0)], masses=[{"node": 1, "mass": 1.0}])
    with pytest.raises(ValueError, match="number: there are 1 such modes, got 2"):
        gapbeam.solve({**held, "analysis": {"frequencies": 1}}).mode("vibration", 2)
    with pytest.raises(ValueError, match='expected "buckling" or "vibration"'):
        result.mode("bending")


def test_without_compression_there_is_no_buckling():
    assert gapbeam.solve(beam(4.0, loads=[uniform(1.0)], analysis={"buckling": 3})).buckling == ()


def test_a_moment_between_the_ends_of_a_string_is_found():
    """Far from its ends a part in great tension bends as the string does: that plateau was not looked at (5e-5 less)."""
    EI, N, kappa, q = 101.0, 8.79e6, 5.18e-05, 0.05
    loads = [{"type": "curvature", "kappa": kappa, "case": "dead"}, {**uniform(q), "from": 2.875, "to": 3.875}]
    found = gapbeam.solve(scene([7.625], PINS, loads, EI=EI, N=N)).extremes["moment"]["max"]
    assert found.value == pytest.approx(EI * (kappa + q / N), rel=1e-13)
    assert 2.9 < found.x < 3.85


def test_a_little_compression_is_not_followed_step_by_step():
    """Counts of solves: the state with all of it is next to that without."""
    bearings = [{"node": k, "side": "below"} for k in range(11)]

    def steps(N):
        made = scene([6.0] * 10, bearings, [uniform(10.0)], EI=1e4, N=N)
        step = gapbeam.solve(made).steps[-1]
        assert step.unique is False
        return step.solves

    assert steps(-1.0) == 4
    assert steps(-200.0) == 4


@pytest.mark.parametrize(("power", "factors"), [
    (2, [0.25 + (k * math.pi / math.log(2.0)) ** 2 for k in (1, 2, 3)]), (4, [(2.0 * k * math.pi) ** 2 for k in (1, 2, 3)]),
])  # fmt: skip
def test_struts_that_taper_buckle_as_closed_forms_say(power, factors):
    """EI = (1 + x)^power: sqrt(1 + x) sin(sqrt(N - 1/4) ln(1 + x)), and (1 + x) sin(sqrt(N) x/(1 + x)) (Timoshenko and Gere)."""
    taper = [{"from": 0.0, "to": 1.0, "EI": {"from": 1.0, "to": 2.0**power, "power": power}}]
    result = gapbeam.solve(beam(-1.0, loads=[uniform(1.0)], sections=taper, analysis={"buckling": 3}))
    np.testing.assert_allclose(result.buckling, factors, rtol=1e-14)


def test_a_mast_that_tapers_under_its_own_weight():
    """EI = (2 - x)^3, weight per length q: the first zero of theta' at the top, by series in 40 digits."""
    foot = [{"node": 0, "rotation": "fixed"}, {"node": 0, "direction": "axial"}]
    made = scene([1.0], foot, [{"type": "axial_uniform", "q": -1.0}], EI=1.0)
    made["sections"] = [{"from": 0.0, "to": 1.0, "EI": {"from": 8.0, "to": 1.0, "power": 3}}]
    result = gapbeam.solve({**made, "analysis": {"buckling": 1}})
    assert result.buckling[0] == pytest.approx(41.8351974423022958, rel=1e-14)


def test_a_thread_that_tapers_is_refused():
    """Series would cross it in steps without end."""
    taper = [{"from": 0.0, "to": 1.0, "EI": [1.0, 2.0]}]
    with pytest.raises(gapbeam.GapbeamError, match="next to a thread"):
        gapbeam.solve(beam(1e10, loads=[uniform(1.0)], sections=taper))


@pytest.mark.parametrize("power", [1, 2, 3, 4])
@pytest.mark.parametrize("GA", [1.05, 50.0, float("inf")])
def test_nothing_holds_a_tapered_beam_that_flies_up(power, GA):
    """Rounding did: it was solved, with deflections of 1e35."""
    taper = {"from": 0.5, "to": 1.25, "EI": {"from": 1.17, "to": 0.0589, "power": power}}
    data = {
        "beam": {"spans": [1.25], "EI": 0.00334, "N": 0.0349, "GA": GA}, "supports": [{"node": 1, "side": "below"}],
        "sections": [{"from": 0.25, "to": 1.125, "EI": 0.0134, "N": 0.047}, taper],
        "loads": [uniform(-92.0, **{"from": 0.375, "to": 0.625}), uniform(7.22), {"type": "moment", "x": 0.75, "M": 4.15}],
    }  # fmt: skip
    result = gapbeam.solve(data)
    assert result.status == "no-equilibrium"
    assert "the beam moves up as a whole" in result.reason
    data["loads"][0]["q"] = -7.22 * 1.25 / 0.25  # in balance
    assert gapbeam.solve(data).steps[-1].indifferent


def test_cases_of_a_tapered_beam_are_those_of_single_scenes():
    made = generated.random_scene(7, compression=0.6, tapers=True)
    for load in made["loads"]:
        load.pop("case", None)
    factors = np.random.default_rng(0).uniform(-1.0, 2.0, (3, len(made["loads"])))
    cases = gapbeam.prepare(made).solve(factors)
    for case, row in enumerate(factors):
        loads = [
            {**load, **{key: np.multiply(load[key], factor).tolist() for key in ("F", "M", "q", "kappa") if key in load}}
            for load, factor in zip(made["loads"], row, strict=True)
        ]
        reaction = gapbeam.solve({**made, "loads": loads}).steps[-1].reaction
        np.testing.assert_allclose(cases.reaction[case], reaction, rtol=0.0, atol=1e-13 * np.abs(reaction).max())


def test_modes_of_long_beams_have_shapes():
    """The number of places at which they are told is bounded."""
    count = 4000
    made = scene([6.0] * count, [{"node": k} for k in range(count + 1)], [uniform(10.0)], EI=1e4, N=-1.0)
    result = gapbeam.solve({**made, "analysis": {"buckling": 1}})
    assert result.buckling[0] == pytest.approx(1e4 * PE / 36.0, rel=1e-6)
    assert result.mode("buckling", 1).deflection.max() == pytest.approx(1.0)


@pytest.mark.parametrize(("kind", "seeds"), [
    ("tension", [0, 6, 12]), ("on ground", [1, 7, 13, 19]), ("compression", [2, 8, 14, 20]),
    ("modes", [3, 9]), ("stops", [4, 28]), ("tapers", [5, 11, 17, 23, 29]),
])  # fmt: skip
def test_random_beams(kind, seeds):
    for seed in seeds:
        drawn, made = attacked.draw_scene(seed)
        assert drawn == kind
        assert attacked.judge(made).wrong == [], seed


@pytest.mark.parametrize("seed", [1, 9, 11, 22, 25, 39])
def test_columns_against_stops_beyond_the_euler_load(seed):
    data = generated.column(seed)
    path, result = follow(data), gapbeam.solve(data)
    assert result.status == path.status
    if path.status == "solved":
        step = result.steps[-1]
        assert step.unique is False
        exact = [float(value) for value in path.end.reaction]
        np.testing.assert_allclose(step.reaction, exact, rtol=0.0, atol=1e-13 * max(map(abs, exact)))


@pytest.mark.parametrize("seed", [2, 4])
def test_modes_of_random_beams(seed):
    data = generated.random_scene(seed, compression=0.7, mass=True)
    result = gapbeam.solve({**data, "analysis": {"buckling": 2, "frequencies": 2}})
    acting = attacked.acting(data, result)
    for found, exact in ((result.buckling, buckling(data, acting, 2)), (result.frequencies, frequencies(data, acting, 2))):
        np.testing.assert_allclose(found, [float(value) for value in exact], rtol=1e-14)


def test_no_axial_force_leaves_all_bits():
    data = scene([6.0, 6.0], [{"node": 0}, {"node": 1, "side": "below", "gap": 0.01}, {"node": 2}], [uniform(5.0)], EI=1e4)
    with_zero = {**data, "beam": {**data["beam"], "N": 0.0, "mass": 3.0}}
    x = np.linspace(0.0, 12.0, 13)
    one, other = gapbeam.solve(data), gapbeam.solve(with_zero)
    np.testing.assert_array_equal(one.at(x).moment, other.at(x).moment)
    assert one.at(x).transverse is None
    assert other.steps[-1].solution.ground is None


def test_sections_and_spans_have_their_own():
    data = beam(2.0, loads=[uniform(1.0)], length=3.0)
    by_sections = {**data, "beam": {**data["beam"], "N": 0.0}, "sections": [{"N": 5.0}, {"from": 0.0, "to": 3.0, "N": 2.0}]}
    assert gapbeam.solve(data).at(1.0).deflection == gapbeam.solve(by_sections).at(1.0).deflection


@pytest.mark.parametrize(
    ("keys", "place", "words"),
    [
        ({"sections": [{"from": 0.2, "to": 0.8, "GA": [9.0, 8.0]}]}, "sections[0].GA", "changes along a section beside an axial"),
        ({"foundation": [{"k": 1.0, "side": "below", "shear": 2.0}]}, "foundation[0].shear", "holds the beam both ways"),
    ],
)
def test_what_is_not_there_is_refused_in_words(keys, place, words):
    with pytest.raises(SceneError) as caught:
        gapbeam.solve(beam(-1.0, loads=[uniform(1.0)], **keys))
    assert caught.value.place == place
    assert words in str(caught.value)


def test_compression_beyond_the_shear_stiffness_is_refused():
    data = beam(-6.0, loads=[uniform(1.0)])
    data["beam"]["GA"] = 5.0
    with pytest.raises(gapbeam.GapbeamError, match="not below GA there"):
        gapbeam.solve(data)


@pytest.mark.parametrize(("force", "deflection"), [(1e-3, 0.0100206489), (1.0, 0.0101209548)])
def test_a_column_against_a_stop_both_ways_that_hardens(force, deflection):
    """It counted as held by the stiff ends of the law in the middle of it: refused, and it could have been unstable."""
    euler = math.pi**2 * 25.0
    scene = {
        "beam": {"spans": [1.0, 1.0], "EI": 100.0, "N": -1.05 * euler},
        "supports": [{"node": 0}, {"node": 1, "law": [[0.01, 0.1], [0.02, 100.0]]}, {"node": 2}],
        "loads": [{"type": "force", "x": 1.0, "F": force}], "analysis": {"buckling": 1},
    }  # fmt: skip
    result = gapbeam.solve(scene)
    step = result.steps[-1]
    k = math.sqrt(1.05 * euler / 100.0)
    soft = (math.tan(k) / (2 * k) - 0.5) / (1.05 * euler)
    assert step.deflection[1] == pytest.approx(deflection, rel=1e-8)
    assert step.deflection[1] == pytest.approx(soft * (force - step.reaction[1]), rel=1e-11)
    assert result.buckling[0] > 1.0
    straight = gapbeam.solve(scene | {"loads": []})
    assert straight.status == "buckles"
    assert "0.96802 times" in straight.report().replace("\n", " ")
