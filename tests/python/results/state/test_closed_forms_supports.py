"""Every kind of support alone, against a closed form."""

import gapbeam
import numpy as np
import pytest
from scenes import INF, at, force, moment, scene, stretch, uniform

L, EI, P, Q = 6.0, 1.25e4, 30.0, 7.0
TOLERANCE = 1e-12


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


@pytest.mark.parametrize(("side", "stands"), [("below", True), ("above", False)])
def test_guided_at_both_ends(side, stands):
    """Supports that open there go on holding rotations; what holds it is the one between them, or nothing."""
    ends = [at(i, side="above", rotation="fixed") for i in (0, 2)]
    result = gapbeam.solve(scene([L, L], [*ends, at(1, side=side, gap=0.1)], [uniform(Q)], EI=EI))
    assert result.status == ("solved" if stands else "no-equilibrium")
    if stands:
        near(result.steps[-1].reaction, [0.0, 0.0, 2 * Q * L])
        near(value(result, 0.0, "deflection"), 0.1 + Q * L**4 / (24 * EI))
        near(value(result, 0.0, "moment"), Q * L**2 / 6)


def test_simple_beam():
    result = solve([L], [at(0), at(1)], [uniform(Q)])
    step = result.steps[-1]
    near(step.reaction, [Q * L / 2, Q * L / 2])
    near(value(result, L / 2, "deflection"), 5 * Q * L**4 / (384 * EI))
    near(value(result, L / 2, "moment"), Q * L**2 / 8)
    near(value(result, 0.0, "rotation"), Q * L**3 / (24 * EI))
    near(value(result, L, "rotation", "left"), -Q * L**3 / (24 * EI))
    near(value(result, L, "shear", "left"), -Q * L / 2)
    assert step.state == ("bilateral", "bilateral")
    assert step.couple.tolist() == [0.0, 0.0]


@pytest.mark.parametrize("clamp", [0, 1])
def test_cantilever(clamp):
    free, turn = (L, 1.0) if clamp == 0 else (0.0, -1.0)
    result = solve([L], [at(clamp, rotation="fixed")], [force(free, P)])
    side = "left" if clamp == 0 else "right"
    near(value(result, free, "deflection", side), P * L**3 / (3 * EI))
    near(value(result, free, "rotation", side), turn * P * L**2 / (2 * EI))
    near(value(result, L / 2, "moment"), -P * L / 2)
    near(value(result, L / 2, "shear"), turn * P)
    near(result.steps[-1].reaction, [P])
    near(result.steps[-1].couple, [-turn * P * L])


def test_propped_cantilever():
    result = solve([L], [at(0, rotation="fixed"), at(1)], [uniform(Q)])
    near(result.steps[-1].reaction, [5 * Q * L / 8, 3 * Q * L / 8])
    near(result.steps[-1].couple, [-Q * L**2 / 8, 0.0])
    x = np.linspace(0.0, L, 13)[1:-1]
    near(result.at(x).deflection, Q * x**2 * (3 * L**2 - 5 * L * x + 2 * x**2) / (48 * EI))


def test_fixed_fixed():
    result = solve([L], [at(0, rotation="fixed"), at(1, rotation="fixed")], [uniform(Q)])
    near(result.steps[-1].couple, [-Q * L**2 / 12, Q * L**2 / 12])
    near(value(result, L / 2, "moment"), Q * L**2 / 24)
    near(value(result, L / 2, "deflection"), Q * L**4 / (384 * EI))


@pytest.mark.parametrize(
    ("count", "moments"),
    [
        (2, [1 / 8]),
        (3, [1 / 10, 1 / 10]),
        (4, [3 / 28, 1 / 14, 3 / 28]),
        (5, [2 / 19, 3 / 38, 3 / 38, 2 / 19]),
    ],
)
def test_support_moments_of_equal_spans(count, moments):
    result = solve([L] * count, [at(i) for i in range(count + 1)], [uniform(Q)])
    near(result.at(L * np.arange(1, count)).moment, -Q * L**2 * np.array(moments))


def test_elastic_supports():
    c = 700.0
    result = solve([L], [at(0, stiffness=c), at(1, stiffness=3 * c)], [force(L / 3, P)])
    near(result.steps[-1].reaction, [2 * P / 3, P / 3])
    near(result.steps[-1].deflection, [2 * P / (3 * c), P / (9 * c)])
    bend = P * (L / 3) ** 2 * (2 * L / 3) ** 2 / (3 * EI * L)
    near(value(result, L / 3, "deflection"), bend + 2 / 3 * 2 * P / (3 * c) + 1 / 3 * P / (9 * c))


def test_elastic_support_in_the_middle():
    c = 900.0
    result = solve([L, L], [at(0), at(1, stiffness=c), at(2)], [uniform(Q)])
    expected = 5 * Q * (2 * L) ** 4 / (384 * EI) / (1 / c + (2 * L) ** 3 / (48 * EI))
    near(result.steps[-1].reaction[1], expected)
    near(result.steps[-1].deflection[1], expected / c)


@pytest.mark.parametrize("absent", [{"stiffness": 0.0}, {"rotation": 0.0}])
def test_zero_stiffness_is_no_support(absent):
    middle = at(x=L / 2, **absent) if "stiffness" in absent else None
    supports = [at(0), at(1, **({} if middle else absent)), *([middle] if middle else [])]
    result = solve([L], supports, [uniform(Q)])
    near(result.steps[-1].reaction[:2], [Q * L / 2, Q * L / 2])
    near(value(result, L / 2, "deflection"), 5 * Q * L**4 / (384 * EI))
    assert not np.any(result.steps[-1].couple)


def test_stiffness_may_be_anything_between_absent_and_rigid():
    beam = 48 * EI / (2 * L) ** 3
    for c in 10.0 ** np.arange(-12, 25, 4):
        result = solve([L, L], [at(0), at(1, stiffness=c), at(2)], [force(L, P)])
        near(result.steps[-1].reaction[1], P * c / (c + beam), P * min(1.0, c / beam))
        near(result.steps[-1].deflection[1], P / (c + beam))


def test_settlement_of_a_middle_support():
    d = 0.013
    result = solve([L, L], [at(0), at(1, settlement=d), at(2)])
    R = -48 * EI * d / (2 * L) ** 3
    near(result.steps[-1].reaction, [-R / 2, R, -R / 2])
    near(result.steps[-1].deflection, [0.0, d, 0.0])
    near(value(result, L, "moment"), -R * (2 * L) / 4)


def test_settlement_of_clamps():
    d = 0.02
    result = solve([L], [at(0, rotation="fixed"), at(1, rotation="fixed", settlement=d)])
    near(result.steps[-1].couple, [-6 * EI * d / L**2, -6 * EI * d / L**2])
    near(result.steps[-1].reaction, [12 * EI * d / L**3, -12 * EI * d / L**3])


def test_settlement_of_an_elastic_support():
    d, c = 0.02, 500.0
    result = solve([L], [at(0, rotation="fixed"), at(1, stiffness=c, settlement=d)])
    w = d * c / (c + 3 * EI / L**3)
    near(result.steps[-1].deflection, [0.0, w])
    near(result.steps[-1].reaction, [c * (d - w), -c * (d - w)])


def test_rotational_spring_at_an_end():
    k = 4000.0
    result = solve([L], [at(0, rotation=k), at(1)], [uniform(Q)])
    M = Q * L**3 / (24 * EI) / (1 / k + L / (3 * EI))
    near(result.steps[-1].couple, [-M, 0.0])
    near(value(result, 0.0, "moment"), -M)
    near(value(result, 0.0, "rotation"), M / k)


def test_rotational_spring_at_an_inner_support():
    k, a, b, M0 = 5000.0, 4.0, 7.0, 55.0
    result = solve([a, b], [at(0), at(1, rotation=k), at(2)], [moment(a, M0)])
    turn = M0 / (k + 3 * EI / a + 3 * EI / b)
    near(value(result, a, "rotation"), turn)
    near(result.steps[-1].couple, [0.0, -k * turn, 0.0])
    near(value(result, a, "moment", "left"), -3 * EI / a * turn, M0)
    near(value(result, a, "moment"), 3 * EI / b * turn, M0)


def test_clamp_at_an_inner_support():
    result = solve([L, L], [at(0), at(1, rotation="fixed"), at(2)], [uniform(Q, to=L)])
    near(result.steps[-1].reaction, [3 * Q * L / 8, 5 * Q * L / 8, 0.0])
    near(result.steps[-1].couple, [0.0, Q * L**2 / 8, 0.0])
    near(value(result, 1.5 * L, "deflection"), 0.0, Q * L**4 / EI)
    near(value(result, L, "moment", "left"), -Q * L**2 / 8)
    near(value(result, L, "moment", "right"), 0.0, Q * L**2)


def test_rotational_support_that_carries_no_force():
    result = solve([L], [at(0), at(1), at(x=L / 4, stiffness=0.0, rotation="fixed")], [moment(L / 4, 9.0)])
    near(result.steps[-1].couple, [0.0, 0.0, -9.0])
    near(value(result, L / 2, "deflection"), 0.0, 9.0 * L**2 / EI)


def test_support_anywhere_is_the_same_as_at_a_node():
    placed = solve([L + 3.0], [at(0), at(x=L), at(1)], [uniform(Q)])
    noded = solve([L, 3.0], [at(0), at(1), at(2)], [uniform(Q)])
    near(placed.steps[-1].reaction, noded.steps[-1].reaction)
    x = np.linspace(0.0, L + 3.0, 31)
    near(placed.at(x).deflection, noded.at(x).deflection)


def test_overhang():
    a = 2.5
    result = solve([L, a], [at(0), at(1)], [force(L + a, P)])
    near(value(result, L + a, "deflection", "left"), P * a**2 * (L + a) / (3 * EI))
    near(result.steps[-1].reaction, [-P * a / L, P * (L + a) / L])
    near(value(result, L, "moment"), -P * a)


def test_gerber_hinge():
    a, b = 2.0, 5.0
    result = solve([L, a + b], [at(0), at(1), at(2)], [force(L + a + b / 2, P)], hinges=[L + a])
    near(result.steps[-1].reaction, [-P / 2 * a / L, P / 2 * (1 + a / L), P / 2])
    tip = P / 2 * a**2 * (L + a) / (3 * EI)
    near(value(result, L + a, "deflection"), tip)
    near(value(result, L + a, "moment"), 0.0, P * L)
    near(value(result, L + a, "rotation", "left"), P / 2 * (a * L / 3 + a**2 / 2) / EI)
    near(value(result, L + a, "rotation", "right"), P * b**2 / (16 * EI) - tip / b)


def test_hinge_at_a_support():
    result = solve([L, L], [at(0), at(1), at(2)], [uniform(Q)], hinges=[L])
    near(result.steps[-1].reaction, [Q * L / 2, Q * L, Q * L / 2])
    near(value(result, L / 2, "moment"), Q * L**2 / 8)
    near(value(result, L, "rotation", "right"), Q * L**3 / (24 * EI))


def test_hinge_in_a_fixed_fixed_beam():
    result = solve([L], [at(0, rotation="fixed"), at(1, rotation="fixed")], [force(L / 2, P)], hinges=[L / 2])
    near(value(result, L / 2, "deflection"), P / 2 * (L / 2) ** 3 / (3 * EI))
    near(result.steps[-1].couple, [-P * L / 4, P * L / 4])


def test_open_support_still_holds_the_rotation():
    supports = [at(0), at(1, side="above", rotation="fixed"), at(2)]
    step = solve([L, L], supports, [uniform(Q, to=L), uniform(2 * Q, **stretch(L, 2 * L))]).steps[-1]
    assert step.state[1] == "open"
    # symmetric part: half of a beam with a sliding clamp; antisymmetric part: two propped cantilevers
    near(step.couple, [0.0, -Q * L**2 / 8, 0.0])
    near(step.deflection[1], 5 * 1.5 * Q * (2 * L) ** 4 / (384 * EI))


SIGN = {"below": 1.0, "above": -1.0}


@pytest.mark.parametrize("side", ["below", "above"])
@pytest.mark.parametrize("stiffness", [INF, 800.0])
@pytest.mark.parametrize("gap", [0.0, 0.01, -0.01])
@pytest.mark.parametrize("settlement", [0.0, 0.004])
@pytest.mark.parametrize("load", [P, -P, 3 * P, -3 * P])
def test_one_sided_support_in_the_middle(side, stiffness, gap, settlement, load):
    """A simple beam of span 2 L on a stop at midspan: a spring in series with a gap."""
    supports = [at(0), at(2), at(1, side=side, stiffness=stiffness, gap=gap, settlement=settlement)]
    step = solve([L, L], supports, [force(L, load)]).steps[-1]
    beam, sign = 48 * EI / (2 * L) ** 3, SIGN[side]
    stop = settlement + sign * gap
    free = load / beam
    closes = sign * (free - stop) > 0
    R = (free - stop) / (1 / beam + 1 / stiffness) if closes else 0.0
    w = (load - R) / beam
    assert step.state == ("bilateral", "bilateral", "closed" if closes else "open")
    near(step.reaction, [(load - R) / 2, (load - R) / 2, R], abs(load))
    near(step.deflection, [0.0, 0.0, w], abs(free) + abs(stop))
    near(step.opening[2], 0.0 if closes else sign * (stop - w), abs(free) + abs(stop))


@pytest.mark.parametrize("load", [2.0, 80.0, -80.0])
def test_clearance_on_both_sides(load):
    lower, upper = 0.015, 0.006
    supports = [at(0), at(1, side="below", gap=lower), at(1, side="above", gap=upper), at(2)]
    step = solve([L, L], supports, [force(L, load)]).steps[-1]
    beam = 48 * EI / (2 * L) ** 3
    w = min(max(load / beam, -upper), lower)
    near(step.deflection, [0.0, w, w, 0.0])
    near(step.opening, [0.0, lower - w, upper + w, 0.0], lower + upper)
    R = load - beam * w
    near(step.reaction, [(load - R) / 2, max(R, 0.0), min(R, 0.0), (load - R) / 2], abs(load))


def test_bar_between_two_axial_supports():
    EA, a, F = 3.0e5, 2.0, 12.0
    supports = [at(0), at(1), at(0, direction="axial"), at(1, direction="axial")]
    result = solve([L], supports, [{"type": "axial", "x": a, "F": F}], EA=EA)
    near(result.steps[-1].reaction, [0.0, 0.0, -F * (L - a) / L, -F * a / L])
    near(value(result, a / 2, "axial_force"), F * (L - a) / L)
    near(value(result, L, "axial_force", "left"), -F * a / L)
    near(value(result, a, "axial_displacement"), F * a * (L - a) / (L * EA))


def test_bar_on_axial_springs_with_a_stiffer_part():
    EA, k, F = 3.0e5, 900.0, 12.0
    supports = [
        at(0),
        at(1),
        at(0, direction="axial", stiffness=k),
        at(1, direction="axial", stiffness=2 * k),
    ]
    sections = [stretch(0.0, L / 2, EA=2 * EA)]
    result = solve([L], supports, [{"type": "axial", "node": 0, "F": F}], EA=EA, sections=sections)
    inner = L / 2 / (2 * EA) + L / 2 / EA + 1 / (2 * k)  # compliance of the way to the right support
    right = F / (1 + k * inner)
    near(result.steps[-1].reaction[2:], [right - F, -right])
    near(result.steps[-1].deflection[2:], [(F - right) / k, right / (2 * k)])


@pytest.mark.parametrize(
    ("supports", "loads"),
    [
        ([at(0)], [uniform(Q)]),
        ([at(0, rotation="fixed", stiffness=0.0)], [force(L, P)]),
        ([at(0), at(1), at(0, direction="axial", stiffness=0.0)], [{"type": "axial", "x": L, "F": 1.0}]),
        ([at(0, side="below"), at(1, side="below")], [uniform(-Q)]),
        ([at(0, side="below"), at(x=L / 3, side="below")], [uniform(Q)]),
        ([at(0, side="above"), at(x=L / 3, side="below")], [uniform(-Q)]),
    ],
)
def test_no_equilibrium(supports, loads):
    result = gapbeam.solve(scene([L], supports, loads, EI=EI))
    assert result.status == "no-equilibrium"
    assert result.reason
    assert len(result.steps) == 0
