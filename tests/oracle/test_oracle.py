"""The reference solution against textbook formulas and against its own definition, exactly."""

import itertools
import random
from fractions import Fraction

import mpmath
import pytest
import scenes
from scenes import INF, at, curvature, force, linear, moment, scene, stretch, uniform

import oracle

LENGTH, STIFFNESS = 3.0, 2048.0  # powers of two in EI keep the expected values exact
EI, L = Fraction(STIFFNESS), Fraction(LENGTH)


def same(actual, expected, digits=40):
    """Equality to 40 digits."""
    with mpmath.workdps(60):
        expected = mpmath.mpf(Fraction(expected).numerator) / Fraction(expected).denominator
        assert abs(actual - expected) <= mpmath.mpf(10) ** -digits * max(1, abs(expected)), (actual, expected)


def solved(*args, factor=1.0, **keys):
    """Solution of a scene that must be solvable."""
    found = oracle.solve(scene(*args, EI=keys.pop("EI", STIFFNESS), **keys), factor)
    assert found.status == "solved"
    return found


def test_simple_beam_uniform():
    found = solved([LENGTH], [at(0), at(1)], [uniform(8.0)])
    middle = found.at(1.5)
    same(middle.deflection, 5 * 8 * L**4 / (384 * EI))
    same(middle.moment, 8 * L**2 / 8)
    same(middle.rotation, 0)
    same(found.at(0.0).rotation, 8 * L**3 / (24 * EI))
    same(found.at(0.0).shear, 12)
    same(found.reaction[0], 12)


@pytest.mark.parametrize("clamp", [0, 1])
def test_cantilever(clamp):
    found = solved([LENGTH], [at(clamp, rotation="fixed")], [force(LENGTH * (1 - clamp), 5.0)])
    tip = found.at(LENGTH * (1 - clamp), "left" if clamp == 0 else "right")
    same(tip.deflection, 5 * L**3 / (3 * EI))
    same(tip.rotation, (1 - 2 * clamp) * 5 * L**2 / (2 * EI))
    same(found.couple[0], (2 * clamp - 1) * 5 * L)
    same(found.at(LENGTH / 2).moment, -5 * L / 2)


def test_fixed_fixed_triangular_load():
    found = solved([LENGTH], [at(0, rotation="fixed"), at(1, rotation="fixed")], [linear(0.0, 6.0)])
    same(found.couple[0], -6 * L**2 / 30)
    same(found.couple[1], 6 * L**2 / 20)
    same(found.reaction[0], Fraction(3, 20) * 6 * L)


def test_couple_anywhere_on_a_simple_beam():
    a, b = Fraction(1), L - 1
    found = solved([LENGTH], [at(0), at(1)], [moment(1.0, 4.0)])
    same(found.reaction[0], -4 / L)
    same(found.at(1.0, "left").moment, -4 * a / L)
    same(found.at(1.0).moment, 4 * b / L)
    # unit force at the couple (Maxwell and Betti): its rotation there is b - a times a b / (3 EI L)
    same(found.at(1.0).deflection, 4 * a * b * (b - a) / (3 * EI * L))


def test_imposed_curvature():
    kappa = Fraction(1, 1024)
    simple = solved([LENGTH], [at(0), at(1)], [curvature(float(kappa))])
    same(simple.at(1.5).deflection, -kappa * L**2 / 8)
    same(simple.at(1.5).moment, 0)
    fixed = solved([LENGTH], [at(0, rotation="fixed"), at(1, rotation="fixed")], [curvature(float(kappa))])
    same(fixed.at(1.5).deflection, 0)
    same(fixed.at(1.5).moment, EI * kappa)


@pytest.mark.parametrize(
    ("count", "expected"),
    [
        (2, ["3/8", "5/4"]),
        (3, ["2/5", "11/10"]),
        (4, ["11/28", "8/7", "13/14"]),
        (5, ["15/38", "43/38", "37/38"]),
    ],
)
def test_equal_spans(count, expected):
    found = solved([LENGTH] * count, [at(i) for i in range(count + 1)], [uniform(1.0)])
    for i, value in enumerate(expected):
        same(found.reaction[i], Fraction(value) * L)
        same(found.reaction[count - i], Fraction(value) * L)


def test_shear_flexible_two_spans():
    f = Fraction(1, 4)
    found = solved([LENGTH] * 2, [at(0), at(1), at(2)], [uniform(1.0)], EI=2304.0, GA=1024.0)  # EI / (f L^2)
    same(found.reaction[1], L * (Fraction(5, 4) + 3 * f) / (1 + 3 * f))


def test_shear_flexible_cantilever():
    found = solved([LENGTH], [at(0, rotation="fixed")], [force(LENGTH, 2.0)], GA=64.0)
    same(found.at(LENGTH, "left").deflection, 2 * L**3 / (3 * EI) + 2 * L / 64)
    same(found.at(LENGTH, "left").rotation, 2 * L**2 / (2 * EI))


def test_rigid_part_of_a_cantilever():
    found = solved(
        [LENGTH], [at(0, rotation="fixed")], [force(LENGTH, 2.0)], sections=[stretch(0.0, 1.0, EI=INF)]
    )
    same(found.at(LENGTH, "left").deflection, 2 * (L - 1) ** 3 / (3 * EI))
    same(found.at(1.0).rotation, 0)


def test_settlement_and_springs():
    supports = [at(0), at(1, settlement=0.25), at(2)]
    same(solved([LENGTH] * 2, supports).reaction[1], -48 * EI / 4 / (2 * L) ** 3)
    supports = [at(0), at(1, stiffness=16.0), at(2)]
    found = solved([LENGTH] * 2, supports, [force(LENGTH, 7.0)])
    same(found.reaction[1], 7 * 16 / (16 + 48 * EI / (2 * L) ** 3))
    found = solved([LENGTH], [at(0, rotation=512.0), at(1)], [moment(0.0, 3.0)])
    same(found.at(0.0).rotation, 3 / (512 + 3 * EI / L))
    same(found.couple[0], -512 * 3 / (512 + 3 * EI / L))


def test_hinged_beam():
    found = solved([4.0, 4.0], [at(0, rotation="fixed"), at(2)], [force(6.0, 8.0)], hinges=[4.0])
    same(found.reaction[1], 4)
    same(found.couple[0], -4 * 4)
    same(found.at(4.0).deflection, 4 * Fraction(4) ** 3 / (3 * EI))
    same(found.at(4.0).moment, 0)
    assert found.at(4.0, "left").rotation != found.at(4.0).rotation


@pytest.mark.parametrize("misprint", ["0.70707", "0.7707"])
def test_paper_example(misprint):
    supports = [at(0, rotation="fixed"), at(1, side="above"), at(2, side="below"), at(3, side="below")]
    loads = [force(2.0, float(misprint)), force(4.0, -4.3597), force(6.0, 2.1155)]
    found = oracle.solve(scene([2.0] * 3, supports, loads, EI=44.5))
    F2, F3, F4 = (Fraction(load["F"]) for load in loads)
    assert found.state == ["bilateral", "closed", "open", "closed"]
    same(found.reaction[1], F2 + Fraction(23, 22) * F3)
    same(found.reaction[3], F4 + Fraction(4, 11) * F3)
    same(found.opening[2], -Fraction(13, 132) * F3 * 8 / Fraction(44.5))


@pytest.mark.parametrize(
    ("sides", "closed"), [("aaa", "c.."), ("aab", ".cc"), ("baa", ".c."), ("abb", "c.c")]
)
def test_paper_example_other_sides(sides, closed):
    names = {"a": "above", "b": "below"}
    supports = [at(0, rotation="fixed")] + [at(i + 1, side=names[side]) for i, side in enumerate(sides)]
    loads = [force(2.0, 0.70707), force(4.0, -4.3597), force(6.0, 2.1155)]
    found = oracle.solve(scene([2.0] * 3, supports, loads, EI=44.5))
    assert found.state[1:] == ["closed" if mark == "c" else "open" for mark in closed]


@pytest.mark.parametrize(
    ("q", "status", "state"), [(5.0, "solved", ["closed"] * 3), (7.0, "solved", ["closed"] * 2 + ["open"])]
)
def test_two_span_uplift(q, status, state):
    loads = [uniform(1.0, case="dead"), uniform(q, to=1.0)]
    found = oracle.solve(scene([1.0, 1.0], [at(i, side="below") for i in range(3)], loads))
    assert (found.status, found.state) == (status, state)
    same(found.opening[2], max(Fraction(0), (Fraction(q) - 6) / 24))


def test_tie_at_the_limit_of_uplift():
    loads = [uniform(1.0, case="dead"), uniform(6.0, to=1.0)]
    found = oracle.solve(scene([1.0, 1.0], [at(i, side="below") for i in range(3)], loads))
    assert found.tied == [False, False, True]
    assert found.valid_states() == {("closed", "closed", "closed"), ("closed", "closed", "open")}


@pytest.mark.parametrize(
    ("supports", "loads", "status"),
    [
        ([at(0)], [force(1.0, 1.0)], "no-equilibrium"),
        ([at(0)], [force(0.0, 1.0)], "indifferent"),
        ([], [uniform(1.0)], "no-equilibrium"),
        ([at(0, side="below"), at(1, side="below")], [force(1.0, -1.0)], "no-equilibrium"),
        ([at(0, side="below"), at(1, side="below")], [force(1.0, 1.0)], "solved"),
        ([at(0, side="below"), at(1, side="below")], [force(3.0, 1.0)], "indifferent"),
        ([at(0, side="below"), at(x=2.0, side="below")], [force(3.0, 1.0)], "no-equilibrium"),
        ([at(0, side="above"), at(x=2.0, side="below")], [force(3.0, 1.0)], "solved"),
        (
            [at(0, side="below", stiffness=2.0), at(0, side="above", gap=1.0, stiffness=3.0)],
            [moment(1.0, 1.0)],
            "no-equilibrium",
        ),
        ([at(0), at(1, rotation="fixed")], [force(1.0, 1.0)], "solved"),
        ([at(1, rotation=1.0, stiffness=2.0)], [force(1.0, 1.0)], "solved"),
    ],
)
def test_stability(supports, loads, status):
    assert oracle.solve(scene([LENGTH], supports, loads)).status == status


def test_free_motion_does_work_and_meets_no_support():
    supports = [at(0, side="below"), at(x=2.0, side="below")]
    found = oracle.solve(scene([LENGTH], supports, [force(3.0, 1.0)]))
    (x0, w0), (x1, w1) = found.motion
    assert (x0, x1) == (0.0, LENGTH)
    assert w1 > 0
    assert w0 < 0
    assert w0 + (w1 - w0) * 2 / L == 0  # it tips about the second support


def test_redundant_forces_are_refused():
    with pytest.raises(oracle.Redundant):
        oracle.solve(scene([1.0, 1.0], [at(i) for i in range(3)], [uniform(1.0)], EI=INF))


@pytest.mark.parametrize("seed", range(40))
def test_definition_holds(seed):
    """The differential equations, and that no other contact state is admissible with other values."""
    made = scenes.random_scene(random.Random(seed))
    made["supports"] = [
        s
        for i, s in enumerate(made["supports"])
        if i in scenes.one_sided(made)[:4] or s.get("side", "both") == "both"
    ]
    beam = oracle.Oracle(made)
    found = beam.solve()
    if found.status != "solved":
        assert bool(found.motion) == (found.status == "no-equilibrium")
        return
    weights = (Fraction(1),) * 3
    for closed in itertools.product((True, False), repeat=len(beam.one_sided)):
        values = beam.exact(closed, weights)
        if values is not None and beam.admissible(closed, values):
            assert values == found.values
    step = Fraction(1, 2**60)
    for start, end, (f, g, loads) in zip(beam.points[:-1], beam.points[1:], beam.pieces, strict=True):
        x, h = (start + end) / 2, step * (end - start)
        before, here, after = (beam.state_at(p, "right", found.values) for p in (x - h, x, x + h))
        w, psi, M, V = ((b - a) / (2 * h) for a, b in zip(before, after, strict=True))
        q = sum((q + rise * (x - start)) * found.values[column] for column, q, rise, _ in loads)
        kappa = sum(kappa * found.values[column] for column, _, _, kappa in loads)
        for slope, value in ((w, here[1] + g * here[3]), (psi, kappa - f * here[2]), (M, here[3]), (V, -q)):
            assert abs(slope - value) <= abs(value) * step + step
