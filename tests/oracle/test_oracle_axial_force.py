"""The reference solution under axial force against closed forms, the numbers it was asked for, and itself."""

import copy
import random

import mpmath as mp
import pytest
from scenes import (
    INF,
    at,
    axial_force,
    force,
    foundation,
    linear,
    moment,
    random_scene,
    scene,
    stretch,
    uniform,
)

import oracle

from . import axial_cells
from . import foundation as ground
from .axial_force import Mechanism, solve
from .axial_ground import solve_on_ground
from .axial_modes import buckling, frequencies, inertia
from .axial_path import Mode, follow


@pytest.fixture(autouse=True)
def _many_digits():
    with mp.workdps(50):
        yield


def close(actual, expected, digits=35):
    """Whether numbers agree, relative to the expected one."""
    expected = mp.mpf(expected)
    assert abs(actual - expected) <= mp.mpf(10) ** -digits * (abs(expected) or 1), (actual, expected)


def simple(loads=(), *, length=1, EI=1, supports=(), **beam):
    """A beam on two supports at its ends, and others."""
    return scene([length], [at(0), *supports, at(1)], loads, EI=EI, **beam)


def stopped(P, gap=0.02):
    """The column of length, stiffness and load 1 with a stop at midspan, P in parts of the Euler load."""
    return simple([uniform(1.0)], supports=[at(x=0.5, side="below", gap=mp.mpf(str(gap)))], N=-P * mp.pi**2)


# Numbers of the page this was asked on


@pytest.mark.parametrize(("u", "w", "M", "F"), [
    ("0.001", ".013020832009548745", ".124999986979168", ".0208333312500002"),
    ("1", ".011818883970073909", ".113181116029926", ".0189414213699951"),
    ("3", ".0067913090733614872", ".0638782183397466", ".0110157730806506"),
])  # fmt: skip
def test_simple_beam(u, w, M, F):
    N = mp.mpf(u) ** 2
    middle = solve(simple([uniform(1.0)], N=N)).at(0.5)
    close(middle.deflection, w, 15)
    close(middle.moment, M, 14)
    close(solve(simple([force(0.5, 1.0)], N=N)).at(0.5).deflection, F, 14)


@pytest.mark.parametrize(("u", "R"), [("1", "59.75731044135905"), ("3", "57.111825264558784")])
def test_stop_under_tension(u, R):
    stop = at(x=5.0, side="below", gap=mp.mpf("0.005"))
    made = simple([uniform(10.0)], length=10, EI=10000, supports=[stop], N=mp.mpf(u) ** 2 * 100)
    close(solve(made).reaction[1], R, 15)


@pytest.mark.parametrize(("N", "half", "w"), [
    ("0", "1.5707963267948966", ".136291426340921"), ("0.5", "2.065569613649225", ".119333969689935"),
    ("1", "2.41839915231229", ".112186856560072"),
])  # fmt: skip
def test_one_sided_ground(N, half, w):
    """The contact ends where the beam on two-sided ground of that length neither presses nor pulls."""
    far = 130

    def state(end):
        made = scene([2 * far], [], [force(far, 1.0)], EI=1, N=mp.mpf(N))
        return solve({**made, "foundation": [{"from": far - end, "to": far + end, "k": 4}]}, stable=False)

    end = mp.findroot(lambda end: state(end).at(far + end).deflection, (mp.mpf(half) + 0.01, mp.mpf(half)), tol=1e-50)
    close(end, half, 13)
    top = state(end).at(far)
    close(top.deflection, w, 14)
    close(top.moment, 2 * top.deflection, 20)


def test_column_with_a_stop():
    open_ = copy.deepcopy(stopped(1))
    del open_["supports"][1]
    closes = mp.findroot(lambda P: solve(open_, P, stable=False).at(0.5).deflection - mp.mpf("0.02"), (0.34, 0.35))
    close(closes, ".34815287816531529", 16)
    assert solve(stopped(closes * 0.999)).active == ()
    for P, R in (("0.5", ".14714005862549203"), ("0.9", ".53807030793317657"), ("2", "1.6440875059318176")):
        found = solve(stopped(mp.mpf(P)))
        assert (found.status, found.active) == ("solved", (1,))
        close(found.reaction[1], R, 15)
    assert [(one[0], one[1]) for one in found.sets] == [((1,), 0), ((), 1)]  # beyond Euler's load two states, one of them stable
    close(buckling(stopped(1), (1,))[0], 4, 28)
    assert solve(stopped(4.01)).status == "buckles"


@pytest.mark.parametrize(("k", "P"), [("10", "1.2046188484569489"), ("50", "2.0075802309154398")])
def test_column_with_a_spring(k, P):
    close(buckling(simple(supports=[at(x=0.5, stiffness=mp.mpf(k))], N=-mp.pi**2))[0], P, 16)


def test_column_with_a_stiff_spring():
    factors = [buckling(simple(supports=[at(x=0.5, stiffness=16 * mp.pi**2 * s)], N=-mp.pi**2), (), 2) for s in (0.99, 1.01)]
    assert factors[0][0] < 3.99
    close(factors[0][1], 4, 28)
    close(factors[1][0], 4, 28)


def test_pipe_lifted_off_rigid_ground():
    k = mp.findroot(lambda k: mp.tan(k / 2) - k / 2, 8.98681891581813)
    close(k, "8.98681891581813", 14)
    close(k**2, "80.7629142257065", 14)
    held = scene([1], [at(0, rotation="fixed"), at(1, rotation="fixed")], [uniform(1.0)], N=-(k**2))
    close(solve(held, stable=False).at(0).moment, 0)


def test_two_spans_swing():
    made = scene([1, 1], [at(0), at(1, side="below"), at(2)], mass=1)
    for expected, actual in zip(("9.869604401089", "15.41820571698"), frequencies(made, (1,), 2), strict=True):
        close(actual, expected, 12)
    for expected, actual in zip((mp.pi**2 / 4, mp.pi**2), frequencies(made, (), 2), strict=True):
        close(actual, expected, 28)


@pytest.mark.parametrize(("N", "expected"), [(0, (".923729504793", "2.4934881405")), (5, ("1.76512387529", "3.80941611761"))])
def test_free_span_swings(N, expected):
    made = scene([10, 4, 10], [at(0), at(3)], mass=1, N=N)
    made["foundation"] = [{"k": 100, "from": 0, "to": 10}, {"k": 100, "from": 14, "to": 24}]
    for one, actual in zip(expected, frequencies(made, (), 2), strict=True):
        close(actual, one, 10)


@pytest.mark.parametrize("seed", [8, 34])
def test_zones_without_axial_force(seed):
    made = foundation.random_scene(seed)
    expected, (found, zones) = ground.solve(made), solve_on_ground(made)
    for one, other in zip(expected.supports, found.reaction, strict=True):
        assert abs(one.reaction - other) < 1e-12 * max(map(abs, found.reaction))
    ends = [x for some in expected.contact for zone in some for x in (zone.start, zone.end)]
    assert [float(x) for some in zones for zone in some for x in zone] == pytest.approx(list(map(float, ends)), abs=1e-11)


def test_zones_under_tension():
    made = scene([8], [at(0)], [force(2, 5), force(6, -0.5)], EI=20, N=15)
    made["foundation"] = [{"k": [30, 40], "side": "below"}, {"k": 50, "side": "above", "from": 3, "gap": [0.001, 0.003]}]
    found, (below, above) = solve_on_ground(made)
    assert [len(below), len(above)] == [1, 1]
    gap = {x: 0 for zone in below for x in zone} | {x: -(mp.mpf("0.001") + mp.mpf("0.002") * (x - 3) / 5) for x in above[0]}
    for x, expected in gap.items():
        if 0 < x < 8:
            assert abs(found.at(x).deflection - expected) < 1e-18


# Closed forms


@pytest.mark.parametrize("u", ["1e-6", "0.1", "40", "1e4"])
def test_any_tension(u):
    N = mp.mpf(u) ** 2
    w, M = middle_of_uniform(N)
    middle = solve(simple([uniform(1.0)], N=N), stable=False).at(0.5)
    close(middle.deflection, w)
    close(middle.moment, M)


def middle_of_uniform(N):
    """Deflection and moment at midspan of the simple beam under q = 1."""
    with mp.workdps(100):
        u = mp.sqrt(N)
        M = (1 - 1 / mp.cosh(u / 2)) / N
        return (mp.mpf(1) / 8 - M) / N, M


def test_shear_by_engesser():
    GA, P = mp.mpf(20), mp.pi**2
    factors = buckling(simple(N=-1, GA=GA), (), 3)
    for n, factor in enumerate(factors, 1):
        close(factor, n * n * P / (1 + n * n * P / GA), 28)
    N, q = mp.mpf(-4), [uniform(1.0)]
    s = 1 + N / GA
    c = mp.sqrt(-N / s)  # EI (1 + N/GA) M'' - N M = -q EI s ..., M = 0 at the ends
    M = (1 - 1 / mp.cos(c / 2)) / N
    middle = solve(simple(q, N=N, GA=GA)).at(0.5)
    close(middle.moment, M)
    close(middle.deflection, (mp.mpf(1) / 8 - M) / N)


def test_ground_tension_layer_mass():
    k, N, G, m, GA = map(mp.mpf, ("700", "-30", "13", "2.5", "400"))
    made = {**simple(N=N, GA=GA, mass=m), "foundation": [{"k": k, "shear": G}]}
    wave = [(n * mp.pi) ** 2 for n in range(1, 4)]
    expected = [mp.sqrt(((a * a * (1 + (N + G) / GA) / (1 + a / GA)) + (N + G) * a / (1 + a / GA) + k) / m) for a in wave]
    for one, actual in zip(sorted(expected), frequencies(made, (), 3), strict=True):
        close(actual, one, 28)
    other = {**simple(N=N + G, GA=GA, mass=m), "foundation": [{"k": k}]}
    close(frequencies(other)[0], min(expected), 28)


def test_rigid_bars_and_lumped_mass():
    bars = scene([1, 1], [at(0), at(1, stiffness=5), at(2)], EI=INF, N=-2, hinges=[1])
    close(buckling(bars)[0], mp.mpf(5) / 4, 28)  # P = c l/2
    bars = {**scene([1, 1], [at(0), at(2)], [force(1, 7)], EI=INF, N=-2), "hinges": [{"node": 1, "stiffness": 6}]}
    close(buckling(bars)[0], 6, 28)  # P = 4 c/(2 l)
    close(solve(bars).at(1).deflection, mp.mpf(7) / (4 * 6 - 4))  # 7/2 - 2 w = moment of the joint = 2 c w
    made = {**simple(), "masses": [{"x": 0.5, "mass": 3}]}
    close(frequencies(made, (), 1)[0], 4, 28)  # 48/3
    assert len(frequencies({**scene([1], []), "masses": [{"x": 0.5, "mass": 3}]}, (), 1)) == 1


def test_several_at_once():
    pair_ = scene([1, 1], [at(0), at(1, rotation="fixed"), at(2)], N=-1, mass=1)
    first = [mp.findroot(lambda u: mp.tan(u) - u, 4.4934) ** 2] * 2
    for one, actual in zip(first, buckling(pair_, (), 2), strict=True):
        close(actual, one, 28)
    close(frequencies(pair_, (), 2, 0)[1], mp.findroot(lambda b: mp.tan(b) - mp.tanh(b), 3.9266) ** 2, 28)


def test_string_between_hinges():
    made = scene([1, 1, 1], [at(0, rotation="fixed"), at(3, rotation="fixed")], [force(1.5, 2.0)], hinges=[1, 2], N=8)
    with pytest.raises(Mechanism):
        solve(scene([1, 1], [at(0), at(2)], [force(1, 1)], hinges=[1]), stable=False)
    string = scene([1, 1], [at(0), at(2)], [force(1, 3)], hinges=[1], N=8)
    close(solve(string).at(1).deflection, mp.mpf(3) / 16)
    assert solve(made).status == "solved"


# Against the exact solution without axial force, and against itself


@pytest.mark.parametrize("seed", range(8))
def test_without_axial_force(seed):
    made = random_scene(random.Random(seed), held=True)
    exact, found = oracle.solve(made, 0.75), solve(made, 1, 0.75)
    assert found.status == exact.status == "solved"
    for name in ("reaction", "couple", "deflection", "opening"):
        some = list(map(float, getattr(exact, name)))
        assert list(map(float, getattr(found, name))) == pytest.approx(some, rel=1e-12, abs=1e-12 * max(map(abs, some)))
    for part in range(1, 8):
        x = sum(made["beam"]["spans"]) * part / 8
        one, other = exact.at(x), found.at(x)
        for name in ("deflection", "rotation", "moment", "shear"):
            assert float(getattr(other, name)) == pytest.approx(float(getattr(one, name)), rel=1e-12, abs=1e-14)


def everything():
    """A beam with all there is."""
    made = scene([3, 4, 5], [at(0, rotation=50), at(1), at(2, side="below", gap=0.01), at(x=9.5, side="above"), at(3)],
                 [linear(1, 5), force(4.5, 7), moment(8, 3), uniform(-2, **stretch(6, 11))],
                 EI=[20, 30, 25], GA=[100, 400, INF], N=[-4, 6, -3], hinges=[5], mass=0.2)  # fmt: skip
    return {**made, "foundation": [{"from": 2, "to": 9, "k": [3, 40], "shear": 2}], "sections": [stretch(3.5, 6, EI=60, N=9)]}


def test_cells_do_not_matter(monkeypatch):
    one = solve(everything())
    monkeypatch.setattr(axial_cells, "REACH", 3)
    other = solve(everything())
    assert one.sets == other.sets
    for name in ("reaction", "couple"):
        for a, b in zip(getattr(one, name), getattr(other, name), strict=True):
            close(a, b)


def test_counts_beside_factors():
    for n, value in enumerate(buckling(everything(), (2,), 2)):
        assert [inertia(everything(), (2,), value * s) for s in (0.999, 1.001)] == [n, n + 1]


def test_extremes_and_equilibrium():
    found = solve(everything())
    places = [mp.mpf(12) * i / 120 for i in range(121)]
    for name, some in found.extremes().items():
        values = [getattr(found.at(x), name) for x in places]
        for value, x in some.values():
            close(getattr(found.at(x), name), value, 30)
        assert 0 <= some["max"][0] - max(values) < 0.02 * (max(values) - min(values))
        assert 0 <= min(values) - some["min"][0] < 0.02 * (max(values) - min(values))
    with mp.workdps(12):
        ground = mp.quad(lambda x: (3 + 37 * (x - 2) / 7) * found.at(x).deflection, [2, 3, 3.5, 4.5, 5, 6, 7, 8, 9])
    close(sum(found.reaction) + ground, 36 + 7 - 10, 9)


def test_states_of_equilibrium_grow_beside_a_factor():
    """Two methods: the response changes its sign at the factor that the count has found."""
    factor = buckling(everything(), (2,))[0]
    one, other = (solve(everything(), factor * (1 + s * mp.mpf(10) ** -20), active=(2,), stable=False) for s in (-1, 1))
    close(one.at(6).deflection / other.at(6).deflection, -1, 15)
    assert abs(one.at(6).deflection) > 1e10


# Paths and shapes


def test_shapes():
    shape = Mode(simple(N=-1), (), buckling(simple(N=-1), (), 2)[1])
    close(shape.at(0.125) / shape.at(0.25), mp.sqrt(2) / 2, 20)
    close(abs(shape.at(0.25)), 1, 20)
    made = scene([1, 1], [at(0), at(1, side="below", gap=0.5), at(2)], mass=1)
    shape = Mode(made, (), 1, frequencies(made)[0])
    close(shape.deflection[1], 1, 20)
    close(shape.at(0.5), mp.sqrt(2) / 2, 20)


def test_path_of_a_column_with_a_stop():
    path = follow(stopped(2))
    assert (path.status, path.jumps) == ("solved", [])
    assert [active for _, active in path.states] == [(), (1,)]
    assert path.states[1][0] == pytest.approx(0.34815 / 2, abs=1e-4)
    close(path.end.reaction[1], "1.6440875059318176", 15)
    path = follow(stopped(4.2))
    assert path.status == "buckles"


# Random scenes


@pytest.mark.parametrize("seed", range(3))
def test_random_tension(seed):
    found = solve(axial_force.random_scene(seed))
    assert (found.status, len(found.sets)) == ("solved", 1)


def test_random_compression():
    made = axial_force.random_scene(4, compression=0.5, ground=True)
    assert [inertia(made, (), factor) for factor in (1, 1.9, 2.1)] == [0, 0, 1]
    assert len(solve(made).sets) == 1


def test_random_columns():
    found = [solve(axial_force.column(seed)) for seed in (1, 2, 9, 10)]
    assert {one.status for one in found} > {"solved"}
    assert max(len(one.sets) for one in found) > 1
