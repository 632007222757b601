"""The examples with an axial force in bending, beside closed forms, series and formulas that know nothing of the engine."""

import math
import re
from itertools import pairwise
from pathlib import Path

import gapbeam
import mpmath
import numpy as np
import pytest

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


def solved(name, **changes):
    """An example, some of its numbers replaced."""
    scene = gapbeam.read_scene(EXAMPLES / f"{name}.toml")
    for path, value in changes.items():
        scene = gapbeam.replace(scene, path.replace("__", "."), value)
    return gapbeam.solve(scene)


def bisect(function, low, high):
    """A root between two places."""
    sign = function(low)
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if (function(middle) > 0) == (sign > 0) else (low, middle)
    return (low + high) / 2


def test_pipe_span_beside_the_recommended_practice():
    """DNV-RP-F105 (2006), 6.7: first frequency by the effective span, without the term of its sag."""
    for N in (0.0, 250.0, 500.0):
        pipe = solved("tensioned_pipe_span", beam__N=N)
        EI, m, k, span = 8.7e4, 0.38, 900.0, max(pipe.steps[-1].free_spans, key=lambda one: one.sag)
        length = span.to - span.from_
        beta = math.log10(k * length**4 / EI)
        effective = length * 4.73 / (-0.066 * beta**2 + 1.02 * beta + 0.63)
        buckling = 4 * math.pi**2 * EI / effective**2
        practice = 3.56 * math.sqrt(EI / (m * effective**4) * (1 + N / buckling))
        assert pipe.frequencies[0] / (2 * math.pi) == pytest.approx(practice, rel=0.035)


def lifted(a, P, EI=6415.0, k=3.0e4, q=3.0):
    """w and three derivatives where a rail is lifted over 2 a under compression P: of that part, of that in contact, of q."""
    kappa = math.sqrt(P / EI)
    c, s = math.cos(kappa * a), math.sin(kappa * a)
    up = np.array([[1, a, c, s], [0, 1, -kappa * s, kappa * c], [0, 0, -(kappa**2) * c, -(kappa**2) * s],
                   [0, 0, kappa**3 * s, -(kappa**3) * c]])  # fmt: skip
    alpha, beta = (math.sqrt(math.sqrt(k / (4 * EI)) + sign * P / (4 * EI)) for sign in (-1, 1))
    root = complex(-alpha, beta)  # exp(root (s - a)), its real and imaginary part
    down = np.array([[(root**n).real, (root**n).imag] for n in range(4)])
    load = [np.array([q * a**2 / (2 * P), q * a / P, q / P, 0.0]), np.array([q / k, 0.0, 0.0, 0.0])]
    return kappa, up, down, load


def jack_of(a, P, EI=6415.0):
    """The jack that lifts a rail over 2 a, both ends of the lifted part at the level of the ground."""
    kappa, up, down, (of_up, of_down) = lifted(a, P)
    rows, right = np.zeros((7, 7)), np.zeros(7)
    rows[0, [1, 3]] = 1.0, kappa  # no slope in the middle
    rows[1, [3, 6]] = EI * kappa**3, -0.5  # half the jack: -EI w''' - P w'
    rows[2:5, :4], rows[2:5, 4:6], right[2:5] = up[1:], -down[1:], (of_down - of_up)[1:]
    rows[5, :4], right[5] = up[0], -of_up[0]
    rows[6, 4:6], right[6] = down[0], -of_down[0]
    return np.linalg.solve(rows, right)[6]


def of_scheme(P, a):
    """Zero where the rail buckles with its lifted part as it is."""
    kappa, up, down, _ = lifted(a, P)
    rows = np.zeros((6, 6))
    rows[0, [1, 3]] = 1.0, kappa
    rows[1, 3] = 1.0
    rows[2:, :4], rows[2:, 4:] = up, -down
    return np.linalg.det(rows)


def largest_jack(P):
    """The largest jack that a rail bears under compression P: the first one as the lifted part grows."""
    low, step = 2.0, 0.05
    while jack_of(low + step, P) > jack_of(low, P):
        low += step
    low, high = low - step, low + step
    for _ in range(60):
        a, b = low + (high - low) / 3, high - (high - low) / 3
        low, high = (a, high) if jack_of(a, P) < jack_of(b, P) else (low, b)
    return jack_of(low, P)


def test_hot_rail_lifts_and_buckles():
    rail = solved("hot_rail")
    assert not rail.steps[-1].unique
    span = rail.steps[-1].free_spans[0]
    a = bisect(lambda half: jack_of(half, 737.0) - 15.0, 2.0, 4.0)
    assert (span.to - span.from_) / 2 == pytest.approx(a, rel=1e-8)
    P = 737.0 * rail.buckling[0]
    assert bisect(lambda one: of_scheme(one, a), 0.99 * P, 1.01 * P) == pytest.approx(P, rel=1e-7)
    most = bisect(lambda one: largest_jack(one) - 15.0, 1500.0, 4000.0)
    over = solved("hot_rail", beam__N=-3000.0)
    assert over.status == "buckles"
    assert float(re.search(r"bears (\S+) times", over.reason)[1]) == pytest.approx(most / 3000.0, rel=2e-6)
    x, w = np.transpose(over.motion)
    assert x[np.abs(w).argmax()] == pytest.approx(20.0)
    assert solved("hot_rail", beam__N=-0.999 * most).status == "solved"


def pile_of(P, H, EI=2.2e5, above=6.0, depth=20.0, rise=2500.0):
    """Equations of a pile with a free head: constants of its part in water, then of a power series in the ground."""
    with mpmath.workdps(40):
        terms = 160
        basis = []
        for first in range(4):
            c = [mpmath.mpf(int(n == first)) for n in range(4)]
            for n in range(terms):
                of_ground = rise * c[n - 1] if n else 0
                c.append(-(P * (n + 2) * (n + 1) * c[n + 2] + of_ground) / (EI * (n + 4) * (n + 3) * (n + 2) * (n + 1)))
            basis.append(c)

        def at(c, z, derivative):
            power = range(derivative, terms + 4)
            return mpmath.fsum(c[n] * mpmath.ff(n, derivative) * mpmath.mpf(z) ** (n - derivative) for n in power)

        kappa = mpmath.sqrt(mpmath.mpf(P) / EI)
        # In the water, from the head down: a + b y + c sin(kappa y), as the head has no moment
        sine = [mpmath.sin(kappa * above + mpmath.pi * n / 2) * kappa**n for n in range(4)]
        water = [[1, above, sine[0]], [0, 1, sine[1]], [0, 0, sine[2]], [0, 0, sine[3]]]
        rows, right = mpmath.zeros(7), mpmath.zeros(7, 1)
        rows[0, 1], right[0] = -P, -H  # transverse force of the head: -EI w''' - P w', for the load H is -H
        for n in range(4):
            for k in range(3):
                rows[1 + n, k] = water[n][k]
            for k in range(4):
                rows[1 + n, 3 + k] = -at(basis[k], 0, n)
        for k in range(4):
            rows[5, 3 + k] = at(basis[k], depth, 2)
            rows[6, 3 + k] = EI * at(basis[k], depth, 3) + P * at(basis[k], depth, 1)
        return rows, right


def test_pile_beside_power_series():
    pile = solved("pile_under_weight")
    with mpmath.workdps(40):
        a, *_ = mpmath.lu_solve(*pile_of(1500, 60))
        assert pile.at(0.0).deflection == pytest.approx(float(a), rel=1e-12)
        P = 1500 * pile.buckling[0]
        signs = [mpmath.sign(mpmath.det(pile_of(P * (1 + share), 0)[0])) for share in (-1e-9, 1e-9)]
    assert signs[0] == -signs[1]


EULER = math.pi**2 * 5184.0 / 36.0
QL = 3.0 * 6.0


@pytest.mark.parametrize(("share", "reaction"), [(0.5, 0.14714005862549203), (0.9, 0.53807030793317657), (2.0, 1.6440875059318176)])
def test_column_beside_a_stop(share, reaction):
    column = solved("column_stop", beam__N=-share * EULER)
    assert column.steps[-1].reaction[1] / QL == pytest.approx(reaction, rel=1e-12)
    assert column.buckling[0] == pytest.approx(4.0 / share, rel=1e-12)
    assert bool(column.steps[-1].unique) == (share < 1.0)


def test_column_closes_and_buckles():
    states = [solved("column_stop", beam__N=-(0.34815287816531529 + way * 1e-9) * EULER).steps[-1].state[1] for way in (-1, 1)]
    assert states == ["open", "closed"]
    over = solved("column_stop", beam__N=-5.0 * EULER)
    assert over.status == "buckles"
    assert "bears 0.8 times" in over.reason
    assert pytest.approx(-2.0 * EULER, rel=1e-6) == solved("column_stop").scene.beam.N


def test_cable_is_a_string():
    cable = solved("cable_on_rollers")
    N, EI, m, length, gap = 200.0, 4.0, 0.0102, 60.0, 0.4
    sag = length**2 / (8 * N) - EI / N**2 * (1 - 1 / math.cosh(length / 2 * math.sqrt(N / EI)))  # under q = 1
    (event,) = cable.events
    assert event.factor == pytest.approx((gap / sag - 0.1) / 0.15, rel=1e-12)

    def of(spans, n):
        wave = n * math.pi * spans / length
        return wave * math.sqrt((N + EI * wave**2) / m)

    free = solved("cable_on_rollers", loads=cable.scene.loads[:1])
    np.testing.assert_allclose(free.frequencies, [of(1, n) for n in (1, 2, 3)], rtol=1e-12)
    assert cable.frequencies[0] == pytest.approx(of(2, 1), rel=1e-12)  # half by half against each other
    assert all(a < b for a, b in pairwise(cable.frequencies))
    # The tension carries: moments are the load times EI/N, but beside the roller
    assert cable.at(15.0).moment == pytest.approx(0.25 * EI / N, rel=1e-9)
