"""Foundations with known answers: closed forms, and classical tables to their digits.

P3 beams on a foundation that cannot pull, P4 a foundation that is stiffer from some deflection on, P7 lift-off, a trench, plastic
ground, soil that gets stiffer with depth. Half-infinite and infinite beams are finite ones of beta L 40 to 60, at whose ends
nothing is left of what is looked at.
"""

import gapbeam
import mpmath as mp
import numpy as np
import pytest
from scenes import at, force, moment, scene, uniform

mp.mp.dps = 40
EI, K, BETA = 2.0, 32.0, 2**0.5  # beta = (K/4 EI)^(1/4)
Q = 1.5


def near(actual, expected, scale=None, to=1e-12):
    """Equality to 1e-12 of `scale`, by default of the largest expected value."""
    expected = np.array(expected, dtype=float)
    scale = np.abs(expected).max() if scale is None else scale
    np.testing.assert_allclose(np.array(actual, dtype=float), expected, rtol=0.0, atol=to * scale)


def ground(k=K, **keys):
    """A foundation that cannot pull, or as the keys say."""
    return {"k": k, "side": "below", **keys}


def solved(length, foundation, loads, supports=(), stiffness=EI, **keys):
    """Result of a beam of one span that has to stand."""
    foundation = foundation if isinstance(foundation, list) else [foundation]
    made = {**scene([length], supports, loads, EI=stiffness), "foundation": foundation, **keys}
    result = gapbeam.solve(made)
    assert result.status == "solved", result.reason
    return result


def ends(result):
    """Ends of the zones of contact inside the beam."""
    length = result.scene.span_ends()[-1]
    return [x for zone in result.steps[-1].contact for x in (zone.from_, zone.to) if 0.0 < x < length]


# P3


@pytest.mark.parametrize("P", [1e-3, 1.0, 7e4])
def test_contact_of_a_long_weightless_beam(P):
    """Half-length pi/(2 beta), whatever the force."""
    L = 50.0 / BETA
    result = solved(L, ground(), [force(L / 2, P)])
    half = np.pi / (2 * BETA)
    near(ends(result), [L / 2 - half, L / 2 + half], L, 1e-13)
    middle = result.at(L / 2)
    near(middle.deflection, float(mp.coth(mp.pi / 2) / 2) * P * BETA / K)
    near(middle.moment, float(mp.coth(mp.pi / 2) / 4) * P / BETA)
    near(result.steps[-1].contact[0].resultant, P)


@pytest.mark.parametrize("length", [0.5, 1.0, 3.0, 3.1415])
def test_full_contact_up_to_pi(length):
    result = solved(length / BETA, ground(), [force(length / BETA / 2, 10.0)])
    assert ends(result) == []
    assert result.steps[-1].free_spans == ()


def test_lift_beyond_pi():
    result = solved(3.1417 / BETA, ground(), [force(3.1417 / BETA / 2, 10.0)])
    assert len(ends(result)) == 2


def test_middle_lifts_between_forces_at_the_ends():
    F, L = 3.0, 4.0 / BETA
    result = solved(L, ground(), [force(0.0, F), force(L, F)])
    a, b = ends(result)
    contact, pressed, mid, uplift = _two_end_forces(mp.mpf(4))
    near([a, L - b], [float(contact) / BETA] * 2, L, 1e-11)
    near(K * result.at(0.0).deflection / (F * BETA), float(pressed))
    near(abs(result.at(L / 2).moment) * BETA / F, float(mid))
    near(-K * result.at(L / 2).deflection / (F * BETA), float(uplift))
    near([float(v) for v in (contact, pressed, mid, uplift)], [1.083008, 2.061329, 0.337890, 0.568246], 1.0, 6e-7)


def _two_end_forces(length):
    """Contact length, end deflection, moment and uplift in the middle, beta = F = k = 1 (EI = 1/4), by symmetry."""

    def unknowns(c):
        # w = e^-x (A cos + B sin) + e^x (C cos + D sin) in contact; M(0) = 0, V(0) = 1, w(c) = 0, V(c) = 0
        z = lambda x, n: [mp.diff(lambda t, f=f: f(t), x, n) for f in _waves]  # noqa: E731
        rows = mp.matrix([z(0, 2), z(0, 3), z(c, 0), z(c, 3)])
        return mp.lu_solve(rows, mp.matrix([0, 4, 0, 0])), z

    def slope(c):
        """Slope that the free middle, bent by a constant moment, does not fit."""
        s, z = unknowns(c)
        turn, bend = (sum(s[i] * z(c, n)[i] for i in range(4)) for n in (1, 2))
        return turn + bend * (length / 2 - c)

    c = mp.findroot(slope, mp.mpf("1.08"))
    s, z = unknowns(c)
    turn, bend = (sum(s[i] * z(c, n)[i] for i in range(4)) for n in (1, 2))
    free = length / 2 - c
    return c, sum(s[i] * z(0, 0)[i] for i in range(4)), abs(bend) / 4, -(turn * free + bend * free**2 / 2)


_waves = (
    lambda x: mp.exp(-x) * mp.cos(x),
    lambda x: mp.exp(-x) * mp.sin(x),
    lambda x: mp.exp(x) * mp.cos(x),
    lambda x: mp.exp(x) * mp.sin(x),
)


@pytest.mark.parametrize("lifted", [1e-3, 0.4, 1.0, 5.0])
def test_lifted_end_of_a_heavy_beam(lifted):
    lam, L = BETA * lifted, 45.0 / BETA + lifted
    result = solved(L, ground(), [force(0.0, -Q / 2 * (lifted + 1 / BETA)), uniform(Q)])
    near(ends(result), [lifted], L, 1e-13)
    near(result.at(lifted).moment, Q * lifted / (2 * BETA), to=1e-11 if lifted < 0.01 else 1e-12)
    near(-K * result.at(0.0).deflection / Q, lam + lam**2 + 2 * lam**3 / 3 + lam**4 / 6, to=1e-11 if lifted < 0.01 else 1e-12)
    near(result.steps[-1].free_spans[0].sag, -result.at(0.0).deflection)


@pytest.mark.parametrize("share", [1e-3, 0.5, 0.98, 1.0, 1 + 1e-9, 1.02, 1.1, 1.4, 2.0, 10.0])
def test_beam_that_is_lifted_at_its_end_turns_over(share):
    """From half of its weight on nothing balances the force; a stiff beam on soft ground touches over 3 (1 - share)/(2 - share)."""
    length, q = 1.0, 1.0
    foundation, loads = [ground(4.0)], [uniform(q), force(0.0, -share * q * length / 2)]
    result = gapbeam.solve({**scene([length], [], loads, EI=1e6), "foundation": foundation})
    assert result.status == ("solved" if share < 1.0 else "no-equilibrium")
    if share == 0.98:
        near(length - ends(result)[0], 3 * 0.02 / 1.02, to=1e-4)


# P4


def test_bilinear_foundation():
    """k = 4 up to 0.1, then 16."""
    L = 60.0
    law = [[0.1, 0.4], [1.0, 14.8]]
    result = solved(L, {"law": law}, [force(L / 2, 2.0)], stiffness=1.0)
    zone, w, M = _bilinear()
    inner = [x for contact in result.steps[-1].contact if contact.state == "branch 2" for x in (contact.from_, contact.to)]
    near(inner, [L / 2 - float(zone), L / 2 + float(zone)], L, 1e-13)
    near(result.at(L / 2).deflection, float(w))
    near(result.at(L / 2).moment, float(M))
    near([float(v) for v in (zone, w, M)], [0.7986225, 0.1645574, 0.3979051], 1.0, 6e-8)


def _bilinear():
    """Half-length of the stiffer zone, deflection and moment under the force, in 40 digits."""
    b = mp.sqrt(2)  # stiffer: 16 w - 1.2, beta = sqrt 2; softer: beta = 1

    def solve(c):
        # middle: w = 0.075 + sum of four waves with w'(0) = 0, V(0) = -1; outside: e^-y (A cos + B sin); all joined at c
        inner = lambda x, n: [mp.diff(lambda t, f=f: f(b * t), x, n) for f in _waves]  # noqa: E731
        outer = lambda n: [mp.diff(f, 0, n) for f in _waves[:2]]  # noqa: E731
        rows = [[*inner(0, 1), 0, 0], [*inner(0, 3), 0, 0], *([*inner(c, n), *(-v for v in outer(n))] for n in range(4))]
        found = mp.lu_solve(mp.matrix(rows), mp.matrix([0, 1, -mp.mpf("0.075"), 0, 0, 0]))
        return found, inner

    c = mp.findroot(lambda c: solve(c)[0][4] - mp.mpf("0.1"), mp.mpf("0.8"))
    s, inner = solve(c)
    return c, sum(s[i] * inner(0, 0)[i] for i in range(4)) + mp.mpf("0.075"), -sum(s[i] * inner(0, 2)[i] for i in range(4))


# P7, F1 F2 F4


def test_first_lift_off_beside_a_couple():
    M0 = float(mp.sqrt(2) * mp.exp(mp.pi / 4)) * Q / BETA**2
    near(M0, 3.10176639384 * Q / BETA**2, to=1e-11)
    L = 50.0 / BETA
    for share, lifts in ((1 - 1e-9, False), (1 + 1e-9, True)):
        result = solved(L, ground(), [moment(L / 2, share * M0), uniform(Q, case="dead")])
        assert bool(ends(result)) is lifts
    a, b = ends(result)
    near((a + b) / 2, L / 2 - np.pi / 4 / BETA, L, 1e-5)  # up to the curvature of the deflection there


def test_first_lift_off_beside_a_couple_as_an_event():
    M0 = float(mp.sqrt(2) * mp.exp(mp.pi / 4)) * Q / BETA**2
    L = 50.0 / BETA
    loads = [moment(L / 2, 2 * M0), uniform(Q, case="dead")]
    result = solved(L, ground(), loads, analysis={"follow": "events"})
    first = result.events[0]
    assert first.event == "zone splits"
    near(first.factor, 0.5)
    near(first.x, L / 2 - np.pi / 4 / BETA, L, 1e-7)  # a touching place is known to half the digits


def _lift_off(length):
    return float(-(mp.sinh(length) + mp.sin(length)) / (2 * mp.cosh(length / 2) * mp.cos(length / 2)))


@pytest.mark.parametrize("length", [3.5, 4.0, 6.0])
def test_ends_of_a_free_heavy_beam_lift(length):
    P, L = _lift_off(mp.mpf(length)) * Q / BETA, length / BETA
    if length == 4.0:
        near(P, 8.47364488478 * Q / BETA, to=1e-11)
    for share, lifts in ((1 - 1e-9, 0), (1 + 1e-9, 2)):
        assert len(ends(solved(L, ground(), [force(L / 2, share * P), uniform(Q, case="dead")]))) == lifts
    result = solved(L, ground(), [force(L / 2, 2 * P), uniform(Q, case="dead")], analysis={"follow": "events"})
    near([event.factor for event in result.events], [0.5, 0.5])
    assert {event.event for event in result.events} == {"end leaves"}
    assert sorted(event.x for event in result.events) == [0.0, L]


def test_free_heavy_beam_beyond_lift_off():
    result = solved(4.0, ground(4.0), [force(2.0, 20.0), uniform(1.0)], stiffness=1.0)
    a, b = ends(result)
    near([a, 4.0 - b], [0.21969841001] * 2, 4.0, 1e-11)
    near(4.0 * result.at(2.0).deflection, 11.8336398098, to=1e-11)
    near(result.at(2.0).moment, 5.3139178437, to=2e-11)
    near(4.0 * result.at([0.0, 4.0]).deflection, [-1.70843006517] * 2, to=1e-11)


def _trench(al):
    M = (al + al**2 + al**3 / 3) / (2 * (1 + al))
    return M, M - al**2 / 2, 1 + 2 * (al + al**2 / 2 - M)


@pytest.mark.parametrize("al", [0.01, 0.5, 1.5, 2.98])
def test_heavy_beam_over_a_trench(al):
    a, L = al / BETA, 40.0 / BETA
    grounds = [ground(to=L / 2 - a), ground(**{"from": L / 2 + a})]
    result = solved(L, grounds, [uniform(Q)])
    assert ends(result) == pytest.approx([L / 2 - a, L / 2 + a])
    middle, shoulder, w = _trench(al)
    near(result.at([L / 2, L / 2 - a, L / 2 + a]).moment, np.array([middle, shoulder, shoulder]) * Q / BETA**2)
    near(K * result.at([L / 2 - a, L / 2 + a]).deflection / Q, [w, w])


def test_heavy_beam_over_a_wider_trench():
    """beta a = 3, beyond 2.985: the beam lifts beside the shoulders."""
    middle = 25.0
    grounds = [ground(4.0, to=middle - 3.0), ground(4.0, **{"from": middle + 3.0})]
    result = solved(2 * middle, grounds, [uniform(1.0)], stiffness=1.0)
    near(result.at(middle).moment, 2.62503711806, to=1e-11)
    near(result.at(middle).deflection, 11.1251941559, to=1e-11)
    right = [x - middle for x in ends(result) if x > middle]
    near(right, [3.0, 4.88574226887, 5.09994184943], 50.0, 1e-11)
    near([middle - x for x in ends(result) if x < middle][::-1], right, 50.0, 1e-13)


@pytest.mark.parametrize(("al", "lifts"), [(2.98485989997, False), (2.98485990000, True)])
def test_width_of_a_trench_at_which_the_beam_lifts_beside_it(al, lifts):
    middle = 25.0
    grounds = [ground(4.0, to=middle - al), ground(4.0, **{"from": middle + al})]
    result = solved(2 * middle, grounds, [uniform(1.0)], stiffness=1.0)
    assert len(ends(result)) == (6 if lifts else 2)


# P7, soil that gets stiffer with depth (Matlock and Reese)

A_Y, B_Y, A_S, A_M, FIXED_Y, FIXED_M = (
    2.42917872015, 1.61939853158, -1.74676972107, 0.771760321509, 0.927863708518, -0.927081865488,
)  # fmt: skip


@pytest.mark.parametrize(("n_h", "stiffness"), [(1.0, 1.0), (3000.0, 2.2e5)])
def test_pile_in_soil_that_gets_stiffer_with_depth(n_h, stiffness):
    T = (stiffness / n_h) ** 0.2
    L, H, M = 10.0 * T, 100.0, 70.0
    soil = {"k": [0.0, n_h * L]}
    pushed = solved(L, soil, [force(0.0, H)], stiffness=stiffness)
    turned = solved(L, soil, [moment(0.0, M)], stiffness=stiffness)
    fixed = solved(L, soil, [force(0.0, H)], [at(0, rotation="fixed", stiffness=0.0, side="below")], stiffness=stiffness)
    unit = H * T**3 / stiffness
    near(pushed.at(0.0).deflection / unit, A_Y, to=1e-11)
    near(abs(turned.at(0.0).deflection) / (M * T**2 / stiffness), B_Y, to=1e-11)
    near(abs(turned.at(0.0).rotation) / (M * T / stiffness), -A_S, to=1e-11)
    near(fixed.at(0.0).deflection / unit, FIXED_Y, to=1e-11)
    near(abs(fixed.at(0.0).moment) / (H * T), -FIXED_M, to=1e-11)
    # Matlock and Reese's finite differences
    for mine, printed in ((A_Y, 2.435), (B_Y, 1.623), (-A_S, 1.75), (FIXED_Y, 0.93)):
        assert mine == pytest.approx(printed, rel=4e-3)


def test_largest_moment_of_a_pile_in_such_soil():
    result = solved(10.0, {"k": [0.0, 10.0]}, [force(0.0, 1.0)], stiffness=1.0)
    extremes = result._pairs_of_extremes()["moment"]
    largest = max(abs(value) for value, _ in extremes.values())
    near(largest, A_M, to=1e-11)


# P7, plastic ground


@pytest.mark.parametrize("delta", [0.25, 1.0, 2.0, 3.5])
def test_pile_in_plastic_ground(delta):
    """E1: plastic down to delta/beta; from delta = 3.868 on the ground behind yields as well."""
    p_u = 9.0
    H = p_u / (2 * BETA) * (1 + delta)
    L = (delta + 45.0) / BETA
    law = {"type": "plastic", "stiffness": K, "limit": p_u}
    result = solved(L, {"law": law}, [force(0.0, H)])
    plastic = [contact for contact in result.steps[-1].contact if contact.state == "branch 2"]
    assert [contact.from_ for contact in plastic] == [0.0]
    near(plastic[0].to, delta / BETA, L, 1e-13)
    near(plastic[0].resultant, p_u * delta / BETA)
    near(K * result.at(0.0).deflection / p_u, (delta**4 + 4 * delta**3 + 6 * delta**2 + 6 * delta + 6) / 6)
    if delta >= 1.0:
        near(abs(result.at(H / p_u).moment), H**2 / (2 * p_u))


@pytest.mark.parametrize(("share", "zones"), [(1 - 1e-6, 1), (1 + 1e-6, 2)])
def test_plastic_ground_yields_behind_the_pile(share, zones):
    """Below the plastic zone k w/p_u = e^-y (cos y - delta sin y), which comes down to -1."""

    def lowest(delta):
        y = mp.atan2(delta + 1, delta - 1)
        return mp.exp(-y) * (mp.cos(y) - delta * mp.sin(y))

    delta = mp.findroot(lambda delta: lowest(delta) + 1, mp.mpf("3.9"))
    near(delta, 3.86759488393, to=1e-11)
    p_u = 9.0
    H = p_u / (2 * BETA) * (1 + share * float(delta))
    result = solved(50.0 / BETA, {"law": {"type": "plastic", "stiffness": K, "limit": p_u}}, [force(0.0, H)])
    plastic = [contact for contact in result.steps[-1].contact if contact.state == "branch 2"]
    assert len(plastic) == zones
    if zones == 2:
        assert plastic[1].resultant < 0.0 < plastic[0].resultant
        y = float(delta + mp.atan2(delta + 1, delta - 1))
        near((plastic[1].from_ + plastic[1].to) / 2, y / BETA, 50.0 / BETA, 1e-4)


@pytest.mark.parametrize("delta", [0.25, 2.0])
def test_largest_moment_of_a_pile_in_plastic_ground(delta):
    p_u = 9.0
    H = p_u / (2 * BETA) * (1 + delta)
    law = {"type": "plastic", "stiffness": K, "limit": p_u}
    result = solved((delta + 45.0) / BETA, {"law": law}, [force(0.0, H)])
    largest = max(abs(value) for value, _ in result._pairs_of_extremes()["moment"].values())
    if delta >= 1.0:
        near(largest, H**2 / (2 * p_u))
    else:
        assert largest > abs(result.at(delta / BETA).moment)


def test_elastic_below_the_plastic_limit():
    """At H = p_u/(2 beta) the ground is about to yield at the head."""
    p_u = 9.0
    law = {"type": "plastic", "stiffness": K, "limit": p_u}
    H = p_u / (2 * BETA)
    result = solved(45.0 / BETA, {"law": law}, [force(0.0, (1 - 1e-9) * H)])
    assert {contact.state for contact in result.steps[-1].contact} == {"branch 1"}
    near(K * result.at(0.0).deflection / p_u, 1 - 1e-9)
