"""Every kind of load and of section alone, against a closed form.

On a simple beam the deflection is written with Macaulay's brackets <x - a>, zero left of a:

    M = R x + M0      EI w = -R x^3/6 + W0 + C x      R, C from M(L) = 0 and w(L) = 0
"""

import math

import gapbeam
import numpy as np
import pytest
from scenes import INF, at, curvature, force, linear, moment, scene, stretch, uniform

L, EI, P, Q = 7.0, 2.0e4, 40.0, 9.0
TOLERANCE = 1e-12
SIMPLE = [at(0), at(1)]
FIXED = [at(0, rotation="fixed"), at(1, rotation="fixed")]
CANTILEVER = [at(0, rotation="fixed")]


def solve(*args, **keys):
    """Result of a scene that has to be solvable."""
    result = gapbeam.solve(scene(*args, EI=keys.pop("EI", EI), **keys))
    assert result.status == "solved", result.reason
    return result


def value(result, x, name, side="right"):
    """One field at one x."""
    return float(np.ravel(getattr(result.at(x, side=side), name))[0])


def near(actual, expected, scale=None):
    """Equality to 1e-12 of `scale`, by default of the largest expected value."""
    scale = np.abs(expected).max() if scale is None else scale
    np.testing.assert_allclose(actual, expected, rtol=0.0, atol=TOLERANCE * scale)


def bracket(x, a, power):
    """Macaulay bracket <x - a>^power."""
    return np.where(x >= a, np.maximum(x - a, 0.0) ** power, 0.0)


def spread(q_a, q_b, a, b):
    """The n-fold integral of a linear load over a..b, as a function of (x, n)."""
    s = (q_b - q_a) / (b - a)

    def integral(x, n):
        one, two = np.prod(np.arange(1, n + 1)), np.prod(np.arange(1, n + 2))
        level = (q_a * bracket(x, a, n) - q_b * bracket(x, b, n)) / one
        return level + s * (bracket(x, a, n + 1) - bracket(x, b, n + 1)) / two

    return integral


def bending(kind, a, b):
    """A load and its (V0, M0, T0, W0): shear, moment, EI times rotation and deflection it adds at x."""
    if kind == "force":
        at_a = [lambda x, n=n: bracket(x, a, n) for n in range(4)]
        return force(a, P), *(lambda x, n=n, s=s, d=d: s * P * at_a[n](x) / d
                              for n, s, d in ((0, -1, 1), (1, -1, 1), (2, 1, 2), (3, 1, 6)))  # fmt: skip
    if kind == "moment":
        parts = [lambda x: 0 * x, lambda x: P * bracket(x, a, 0), lambda x: -P * bracket(x, a, 1)]
        return moment(a, P), *parts, lambda x: -P * bracket(x, a, 2) / 2
    if kind == "curvature":
        kappa = 1e-3
        return (curvature(kappa, **stretch(a, b)), lambda x: 0 * x, lambda x: 0 * x,
                lambda x: EI * kappa * (bracket(x, a, 1) - bracket(x, b, 1)),
                lambda x: EI * kappa * (bracket(x, a, 2) - bracket(x, b, 2)) / 2)  # fmt: skip
    q_a, q_b = {"uniform": (Q, Q), "triangle": (0.0, Q), "falling": (Q, 0.0), "trapezoid": (Q, -2 * Q)}[kind]
    load = uniform(Q, **stretch(a, b)) if kind == "uniform" else linear(q_a, q_b, **stretch(a, b))
    part = spread(q_a, q_b, a, b)
    return (load, lambda x: -part(x, 1), lambda x: -part(x, 2), lambda x: part(x, 3), lambda x: part(x, 4))


KINDS = ["force", "moment", "uniform", "triangle", "falling", "trapezoid", "curvature"]
PLACES = [(1.3, 4.9), (0.0, L), (0.0, 2.0), (4.5, L), (3.5, 3.6)]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("a", "b"), PLACES)
def test_simple_beam(kind, a, b):
    load, V0, M0, T0, W0 = bending(kind, a, b)
    result = solve([L], SIMPLE, [load])
    R = -M0(L) / L
    C = (R * L**3 / 6 - W0(L)) / L
    x = np.concatenate((np.linspace(0.0, L, 15)[1:-1], [a + 1e-9, (a + b) / 2]))
    x = x[(x != a) & (x != b)]
    fields = result.at(x)
    near(fields.deflection, (-R * x**3 / 6 + W0(x) + C * x) / EI)
    near(fields.rotation, (-R * x**2 / 2 + T0(x) + C) / EI)
    flat = kind == "curvature"
    near(fields.moment, R * x + M0(x), EI * 1e-3 if flat else None)
    near(fields.shear, R + V0(x), EI * 1e-3 / L if flat else None)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("a", "b"), PLACES)
def test_fixed_fixed_beam(kind, a, b):
    """Clamping couples: the area under M/EI - kappa and its first moment vanish."""
    load, _, M0, T0, W0 = bending(kind, a, b)
    step = solve([L], FIXED, [load]).steps[-1]
    # EI psi(L) = -(C L + R L^2/2) + T0(L) = 0 and EI w(L) = -(C L^2/2 + R L^3/6) + W0(L) = 0
    R = (6 * L * T0(L) - 12 * W0(L)) / L**3
    C = T0(L) / L - R * L / 2
    near(step.couple, [C, -(C + R * L + M0(L))], abs(C) + abs(R * L))
    near(step.reaction[0], R, abs(C) / L + abs(R))


@pytest.mark.parametrize("a", [0.5, 3.0, 6.9])
def test_values_left_and_right_of_a_jump(a):
    result = solve([L], SIMPLE, [force(a, P)])
    near(value(result, a, "shear", "left"), P * (L - a) / L, P)
    near(value(result, a, "shear", "right"), -P * a / L, P)
    near(value(result, a, "deflection"), P * a**2 * (L - a) ** 2 / (3 * EI * L))
    result = solve([L], SIMPLE, [moment(a, P)])
    near(value(result, a, "moment", "left"), -P * a / L, P)
    near(value(result, a, "moment", "right"), P * (L - a) / L, P)


@pytest.mark.parametrize("stiffness", [INF, 500.0])
def test_load_at_a_support_goes_into_the_support(stiffness):
    result = solve([L, L], [at(0), at(1), at(2, stiffness=stiffness)], [force(2 * L, P), force(L, 2 * P)])
    near(result.steps[-1].reaction, [0.0, 2 * P, P] if stiffness == INF else _on_a_spring(500.0), 2 * P)


def _on_a_spring(c):
    """Reactions of two spans whose right end, on a spring, carries P: an overhang beyond the first span."""
    beam = 3 * EI / (L**2 * (L + L))  # stiffness of the overhang against its tip force
    tip = P * beam / (beam + c)
    return [-tip, 2 * P + 2 * tip, P - tip]


def test_load_at_a_free_end_and_couple_at_an_end():
    result = solve([L], CANTILEVER, [moment(L, P)])
    near(value(result, L, "deflection", "left"), P * L**2 / (2 * EI))
    near(value(result, L, "rotation", "left"), P * L / EI)
    near(value(result, L / 2, "moment"), -P)
    result = solve([L], SIMPLE, [moment(0.0, P)])
    near(value(result, 0.0, "moment"), P)
    near(value(result, 0.0, "rotation"), P * L / (3 * EI))
    near(value(result, L, "rotation", "left"), -P * L / (6 * EI))


def test_curvature_moves_a_free_beam_and_loads_a_held_one():
    kappa = 2e-3
    result = solve([L], SIMPLE, [curvature(kappa)])
    x = np.linspace(0.0, L, 9)[1:-1]
    near(result.at(x).deflection, -kappa * x * (L - x) / 2)
    near(result.at(x).moment, 0 * x, EI * kappa)
    result = solve([L], FIXED, [curvature(kappa)])
    near(result.at(x).moment, EI * kappa + 0 * x)
    near(result.at(x).deflection, 0 * x, kappa * L**2)
    result = solve([L, L], [at(0), at(1), at(2)], [curvature(kappa)])
    near(value(result, L, "moment"), 1.5 * EI * kappa)


@pytest.mark.parametrize("f", [0.01, 0.3, 25.0])
def test_shear_flexible_simple_beam_and_cantilever(f):
    GA = EI / (f * L**2)
    result = solve([L], SIMPLE, [uniform(Q)], GA=GA)
    x = np.linspace(0.0, L, 9)[1:-1]
    near(
        result.at(x).deflection, Q * x * (L**3 - 2 * L * x**2 + x**3) / (24 * EI) + Q * x * (L - x) / (2 * GA)
    )
    near(result.at(x).rotation, Q * (L**3 - 6 * L * x**2 + 4 * x**3) / (24 * EI))
    result = solve([L], CANTILEVER, [force(L, P)], GA=GA)
    near(value(result, L, "deflection", "left"), P * L**3 / (3 * EI) + P * L / GA)
    near(value(result, L, "rotation", "left"), P * L**2 / (2 * EI))
    result = solve([L, L], [at(0), at(1), at(2)], [uniform(Q)], GA=GA)
    near(result.steps[-1].reaction[1], Q * L * (5 / 4 + 3 * f) / (1 + 3 * f))


def test_beam_that_is_flexible_in_shear_only():
    GA = 300.0
    result = solve([L], SIMPLE, [force(2.0, P)], EI=INF, GA=GA)
    near(value(result, 2.0, "deflection"), P * 2.0 * (L - 2.0) / (L * GA))
    near(value(result, 1.0, "rotation"), 0.0, P / GA)
    near(value(result, 1.0, "moment"), P * (L - 2.0) / L)


def test_stepped_cantilever():
    a, n = 3.0, 4.0  # the stiffer part at the clamp, n times as stiff
    expected = P / (3 * EI) * ((L**3 - (L - a) ** 3) / n + (L - a) ** 3)
    result = solve([L], CANTILEVER, [force(L, P)], sections=[stretch(0.0, a, EI=n * EI)])
    near(value(result, L, "deflection", "left"), expected)
    result = solve([a, L - a], CANTILEVER, [force(L, P)], EI=[n * EI, EI])
    near(value(result, L, "deflection", "left"), expected)


def test_later_sections_win():
    layers = [
        stretch(0.0, 5.0, EI=EI / 50),
        stretch(0.0, 3.0, EI=4 * EI),
        stretch(3.0, L, EI=EI),
        {"GA": 1e4},
    ]
    result = solve([L], CANTILEVER, [force(L, P)], sections=layers)
    expected = P / (3 * EI) * ((L**3 - 4.0**3) / 4 + 4.0**3) + P * L / 1e4
    near(value(result, L, "deflection", "left"), expected)


def test_rigid_part():
    a = 2.5
    result = solve([L], CANTILEVER, [force(L, P)], sections=[stretch(0.0, a, EI=INF)])
    near(value(result, L, "deflection", "left"), P * (L - a) ** 3 / (3 * EI))
    near(value(result, a, "deflection"), 0.0, P * L**3 / EI)
    near(value(result, a / 2, "moment"), -P * (L - a / 2))
    middle = solve([L], SIMPLE, [force(L / 2, P)], sections=[stretch(a, L - a, EI=INF)])
    near(value(middle, L / 2, "deflection"), P / 2 * a**3 / (3 * EI))


def test_rigid_beam_on_springs():
    c = 300.0
    step = solve([L, L], [at(i, stiffness=c) for i in range(3)], [force(2 * L, P)], EI=INF).steps[-1]
    near(step.reaction, [P / 3 - P / 2, P / 3, P / 3 + P / 2])
    near(step.deflection, step.reaction / c)


def test_curvature_of_a_rigid_part():
    kappa = 1e-3
    result = solve([L], CANTILEVER, [curvature(kappa, to=2.0)], EI=INF)
    near(value(result, L, "deflection", "left"), kappa * (2.0**2 / 2 + 2.0 * (L - 2.0)))


def test_dead_and_live_loads_follow_the_load_factor():
    loads = [
        uniform(Q, case="dead"),
        force(L / 2, P, case="live"),
        moment(L, P),
        curvature(1e-3, case="dead"),
    ]
    result = solve([L], SIMPLE, loads, analysis={"steps": 4})
    assert [step.factor for step in result.steps] == [0.25, 0.5, 0.75, 1.0]
    for k, step in enumerate(result.steps):
        near(step.reaction[0], Q * L / 2 + step.factor * (P / 2 - P / L), Q * L)
        middle = (
            5 * Q * L**4 / 384 / EI - 1e-3 * L**2 / 8 + step.factor * (P * L**3 / 48 - P * L**2 / 16) / EI
        )
        near(result.at(L / 2, step=k).deflection, middle, Q * L**4 / EI)


@pytest.mark.parametrize(("q_a", "q_b"), [(0.0, 3.7), (3.7, 0.0)])
def test_extremes_under_a_triangular_load(q_a, q_b):
    length, q = 6.5, max(q_a, q_b)
    extremes = solve([length], SIMPLE, [linear(q_a, q_b)])._pairs_of_extremes()

    def place(share):
        return length * (share if q_b else 1.0 - share)

    moment, x = extremes["moment"]["max"]
    assert moment == pytest.approx(q * length**2 / (9 * math.sqrt(3)), rel=1e-14)
    assert x == pytest.approx(place(1 / math.sqrt(3)), rel=1e-7)
    share = math.sqrt(1 - math.sqrt(8 / 15))
    expected = q * length**4 / (360 * EI) * share * (7 - 10 * share**2 + 3 * share**4)
    deflection, x = extremes["deflection"]["max"]
    assert deflection == pytest.approx(expected, rel=1e-13)
    assert x == pytest.approx(place(share), rel=1e-7)


def test_many_loads_add_up():
    a = np.linspace(0.2, 6.8, 34)
    result = solve([L], SIMPLE, [force(float(x), P) for x in a])
    near(result.steps[-1].reaction, [P * np.sum(L - a) / L, P * np.sum(a) / L])
    b = L - a
    end = np.sum(P * a * b * (L + b) / (6 * EI * L))
    near(value(result, 0.0, "rotation"), end)


def test_points_that_differ_by_rounding_are_one():
    x = 0.1 + 0.2  # 0.30000000000000004
    supports = [at(0), at(x=0.3), at(1)]
    result = solve(
        [1.0], supports, [force(x, P), uniform(Q, **stretch(x, 1.0))], sections=[stretch(0.0, x, EI=3 * EI)]
    )
    exact = solve([1.0], supports, [force(0.3, P), uniform(Q, **stretch(0.3, 1.0))],
                  sections=[stretch(0.0, 0.3, EI=3 * EI)])  # fmt: skip
    near(result.steps[-1].reaction, exact.steps[-1].reaction)
    near(value(result, 0.3, "shear", "left"), value(exact, 0.3, "shear", "left"), P)
    near(value(result, 0.3, "shear", "right"), value(exact, 0.3, "shear", "right"), P)
