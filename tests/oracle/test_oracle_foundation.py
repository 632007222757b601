"""The reference solution of one-sided foundations against closed forms and against itself."""

import pytest
from mpmath import cos, coth, e, exp, mp, mpf, pi, sin, sinh, sqrt
from scenes import at, force, moment, scene, stretch, uniform
from scenes.foundation import random_scene
from scenes.transformed import mirrored

from .foundation import Search, check, solve, zones_of
from .rigid import best
from .series import zeros
from .winkler import Problem, Solution, State

DIGITS = 30


@pytest.fixture(autouse=True)
def _many_digits():
    with mp.workdps(60):
        yield


def bed(length, loads, k=4, side="below", supports=(), EI=1, **keys):
    """A beam on one foundation, beta = 1 unless told."""
    return {**scene([length], supports, loads, EI=EI), "foundation": [{"k": k, "side": side, **keys}]}


def on_law(length, loads, law, side="both"):
    """The same with a law."""
    return {**scene([length], [], loads), "foundation": [{"side": side, "law": law}]}


def answer_of(made, digits=DIGITS):
    """The answer; there must be one."""
    answer = solve(made, digits=digits)
    assert answer.status == "solved"
    return answer


def close(actual, expected, digits=DIGITS - 8):
    """Whether numbers agree, relative to the larger of 1 and the expected one."""
    return abs(actual - expected) <= mpf(10) ** -digits * max(1, abs(expected))


def ends(answer, foundation=0):
    """Ends of zones in a row."""
    return [x for z in answer.contact[foundation] for x in (z.start, z.end)]


# P3 of the reference problems


@pytest.mark.parametrize("P", [3, mpf(1) / 1000])
def test_long_weightless_beam(P):
    answer = answer_of(bed(40, [force(20, P)]))
    assert all(close(x, 20 + s * pi / 2) for x, s in zip(ends(answer), (-1, 1), strict=True))
    assert close(4 * answer.w(20) / P, coth(pi / 2) / 2)
    assert close(answer.moment(20) / P, coth(pi / 2) / 4)
    assert close(answer.pressure(20) / P, coth(pi / 2) / 2)
    assert close(answer.contact[0][0].resultant, P)
    assert close(answer.shear(20, "left"), P / mpf(2))
    assert close(answer.shear(20), -P / mpf(2))


@pytest.mark.parametrize(("length", "lifts"), [(pi - 1e-6, False), (pi + 1e-6, True)])
def test_full_contact_of_a_short_beam(length, lifts):
    for loads in ([force(length / 2, 1)], [force(0, 1), force(length, 1)]):
        answer = answer_of(bed(length, loads))
        assert (close(ends(answer)[0], 0) and close(ends(answer)[-1], length) and len(answer.contact[0]) == 1) != lifts


def test_forces_at_both_ends():
    answer = answer_of(bed(4, [force(0, 1), force(4, 1)]))
    (a, p), (q, b) = ((z.start, z.end) for z in answer.contact[0])
    assert (a, b) == (0, 4)
    assert close(p, 1.083008, 6)
    assert close(4 - q, p)
    assert close(4 * answer.w(0), 2.061329, 6)
    assert close(-answer.moment(2), 0.337890, 6)
    assert close(-4 * answer.w(2), 0.568246, 6)


@pytest.mark.parametrize("lifted", [mpf(1) / 2, 3])
def test_heavy_beam_lifted_at_its_end(lifted):
    F = (lifted + 1) / mpf(2)
    answer = answer_of(bed(30, [uniform(1), force(0, -F)]))
    assert close(ends(answer)[0], lifted)
    assert close(answer.moment(lifted), lifted / mpf(2))
    assert close(-4 * answer.w(0), lifted + lifted**2 + 2 * lifted**3 / mpf(3) + lifted**4 / mpf(6))


# P4 and P7


def test_bilinear_foundation():
    answer = answer_of(on_law(40, [force(20, 2)], [[mpf("0.1"), mpf("0.4")], [mpf("0.2"), 2]]))
    assert close(answer.w(20), 0.1645574, 7)
    assert close(answer.moment(20), 0.3979051, 7)
    assert close(answer.w(mpf("20.7986225")), 0.1, 7)
    assert close(answer.contact[0][0].resultant, 2)


def test_couple_on_a_heavy_beam():
    limit = sqrt(2) * exp(pi / 4)
    assert close(limit, 3.10176639384, 11)
    for factor, zones in ((1 - mpf(10) ** -8, 1), (1 + mpf(10) ** -8, 2)):
        answer = answer_of(bed(40, [uniform(1), moment(20, limit * factor)]))
        assert len(answer.contact[0]) == zones
        assert close(answer.extremes("w")[1][1], 20 - pi / 4, 7)
    (_, p), (q, _) = ((z.start, z.end) for z in answer.contact[0])
    assert close((p + q) / 2, 20 - pi / 4, 4)
    assert q - p < 1e-3


def test_heavy_beam_pressed_in_the_middle():
    limit = -(sinh(4) + sin(mpf(4))) / (2 * mp.cosh(2) * cos(mpf(2)))
    assert close(limit, 8.47364488478, 11)
    for change, lifts in ((-1e-9, False), (1e-9, True)):
        answer = answer_of(bed(4, [force(2, limit + change), uniform(1)]))
        assert (ends(answer)[0] > 0) == lifts
    answer = answer_of(bed(4, [force(2, 20), uniform(1)]))
    assert close(ends(answer)[0], 0.21969841001, 11)
    assert close(ends(answer)[1], 4 - ends(answer)[0])
    assert close(4 * answer.w(2), 11.8336398098, 10)
    assert close(answer.moment(2), 5.3139178437, 10)
    assert close(4 * answer.w(0), -1.70843006517, 11)


def trench(a, half=28):
    """F4: a trench of half width a."""
    parts = [{"k": 4, "side": "below", **stretch(*p)} for p in ((0, half - a), (half + a, 2 * half))]
    return {**scene([2 * half], [], [uniform(1)]), "foundation": parts}


def test_trench():
    for al in (mpf(1), mpf(2)):
        answer = answer_of(trench(al))
        M = (al + al**2 + al**3 / 3) / (2 * (1 + al))
        assert close(answer.moment(28), M)
        assert close(answer.moment(28 + al), M - al**2 / 2)
        assert close(4 * answer.w(28 + al), 1 + 2 * (al + al**2 / 2 - M))
        assert ends(answer, 1) == [28 + al, 56]
    limit = mpf("2.98485989998")
    for change, zones in ((mpf(-1), 1), (mpf(1), 2)):
        assert len(answer_of(trench(limit + change * mpf(10) ** -10)).contact[1]) == zones
    answer = answer_of(trench(3))
    assert close(answer.moment(28), 2.62503711806, 11)
    assert close(answer.w(28), 11.1251941559, 10)
    assert all(close(x, y, 10) for x, y in zip(ends(answer, 1), (31, 32.88574226887, 33.09994184943, 56), strict=True))


def test_matlock_and_reese():
    made = bed(10, [force(0, 1)], k=[0, 10], side="both")
    answer = answer_of(made)
    assert close(answer.w(0), 2.42917872015, 11)
    assert close(-answer.extremes("moment")[1][0], 0.771760321509, 12)  # from the power series over the whole pile
    answer = answer_of({**made, "loads": [moment(0, -1)]})
    assert close(answer.w(0), 1.61939853158, 11)
    assert close(answer.rotation(0), -1.74676972107, 11)
    answer = answer_of({**made, "supports": [at(0, stiffness=0, rotation="fixed")]})
    assert close(answer.w(0), 0.927863708518, 12)
    assert close(abs(answer.moment(0)), 0.927081865488, 12)


@pytest.mark.parametrize("depth", [mpf(1) / 2, mpf(2)])
def test_pile_in_plastic_soil(depth):
    answer = answer_of(on_law(30, [force(0, (1 + depth) / 2)], [[mpf(1) / 4, 1], [1, 1]]))
    expected = (depth**4 + 4 * depth**3 + 6 * depth**2 + 6 * depth + 6) / 6
    assert close(4 * answer.w(0), expected)
    assert close(answer.w(depth), mpf(1) / 4)
    if depth >= 1:
        assert close(abs(answer.extremes("moment")[1][0]), (1 + depth) ** 2 / 8)


# Other closed forms, and parts


def test_profile_of_one_shape_with_the_beam():
    """A rigid block that follows a slope: the gap is closed evenly, and only the mean load matters."""
    answer = answer_of(bed(2, [uniform(8)], profile=[[-1, mpf(-1)], [3, mpf(3)]]))
    assert close(answer.w(0), 2)
    assert close(answer.w(2), 4)
    assert abs(answer.moment(1)) < 1e-25


def test_a_zone_of_a_millionth():
    top = mpf(5) / 384
    gap = top * (1 - mpf(10) ** -14)
    answer = answer_of(bed(1, [uniform(1)], k=1, gap=gap, supports=[at(0), at(1)]))
    (zone,) = answer.contact[0]
    assert close(zone.start + zone.end, 1)
    half = sqrt((top - gap) * 2 / (mpf(1) / 8))
    assert close((zone.end - zone.start) / 2 / half, 1, 6)
    assert half < 1e-7


@pytest.mark.parametrize("GA", [mpf(1) / 2, mpf(3)])
def test_shear_flexible_beam(GA):
    """Long beam: w = A exp(p x) + B exp(q x) with EI r^4 - (k EI/GA) r^2 + k = 0; psi = 0, V = -1/2 at the force."""
    k = mpf(4)
    answer = answer_of({**bed(76, [force(38, 1)], k=k, side="both"), "beam": {"spans": [76], "EI": 1, "GA": GA}})
    p, q = (-sqrt((k / GA + s * sqrt((k / GA) ** 2 - 4 * k)) / 2) for s in (1, -1))
    A, B = mp.lu_solve(mp.matrix([[k / p, k / q], [p, q]]), mp.matrix([mpf(-1) / 2, mpf(-1) / (2 * GA)]))
    assert close(answer.w(38), (A + B).real)


def test_support_with_a_gap():
    """Two thirds of a beam's weight go to the foundation it lies on before its end is met by a support."""
    made = scene([2.0], [at(1, side="below", gap=1)], [uniform(4), moment(2, 4)])
    answer = answer_of({**made, "foundation": [{"k": 4, "side": "both"}]})
    assert answer.supports[0].closed
    assert close(answer.w(2), 1)
    assert close(answer.supports[0].reaction + sum(z.resultant for z in answer.contact[0]), 8)
    loose = answer_of({**made, "supports": [at(1, side="below", gap=8)], "foundation": [{"k": 4, "side": "both"}]})
    assert not loose.supports[0].closed


def test_dead_loads_keep_their_size():
    made = bed(3, [uniform(1, case="dead"), force(1, 6)])
    scaled = bed(3, [uniform(1), force(1, 3)])
    assert close(solve(made, 0.5, DIGITS).w(0), answer_of(scaled).w(0))


@pytest.mark.parametrize(
    ("made", "status"),
    [
        (bed(2, [uniform(-1)]), "no-equilibrium"),
        (bed(2, [force(2, 1)], to=1), "no-equilibrium"),
        (bed(2, [force(2, 1)], to=1, supports=[at(0)]), "solved"),
        (on_law(2, [uniform(2)], [[1, 1], [2, 1]], "below"), "no-equilibrium"),
        (on_law(2, [uniform(0.5)], [[1, 1], [2, 1]], "below"), "solved"),
        (on_law(2, [uniform(2)], [[1, 1], [2, 1]]), "no-equilibrium"),
        (on_law(2, [uniform(-2)], [[1, 1], [2, 1]]), "no-equilibrium"),
        (on_law(2, [uniform(-2)], [[1, 1], [2, 2]]), "solved"),
        (on_law(2, [uniform(0.5)], [[1, 1], [2, 1]]), "solved"),
        (scene([1.0], [at(0)], [force(0, 1)]), "free"),
        (bed(4, [force(0, 1)], supports=[at(0, side="below")]), "free"),
    ],
)
def test_whether_it_stands(made, status):
    assert solve(made, digits=DIGITS).status == status


def test_simplex():
    assert best([1, 2], [[1, 0]], []) == 2
    assert best([1, 2], [[1, 0], [0, 1]], []) == 0
    assert best([3], [], [(2, [1])]) == 1
    assert best([1], [], [(2, [1])]) == 0


def test_zeros_that_lie_close_together():
    a, b = mpf(1) / 3, mpf(1) / 3 + mpf(10) ** -15
    found, touching = zeros([a * b * e, -(a + b + a * b / 7) * e, (1 + (a + b) / 7) * e, -e / 7])
    assert not touching
    assert all(close(x, y, 40) for x, y in zip(found, (a, b), strict=True))
    assert zeros([a * a + mpf(10) ** -30, -2 * a, mpf(1)]) == ([], [])
    assert zeros([a * a, -2 * a, mpf(1)], tiny=mpf(10) ** -40)[0] == []


@pytest.mark.parametrize("seed", [44, 48])
def test_other_beginnings(seed):
    made = random_scene(seed)
    answer = answer_of(made, 25)
    with mp.workdps(answer.digits):
        search = Search(Problem(made, 1), 25)
        for solution in (search.run(search.full()), search.all_schemes()):
            assert close(solution.at(mpf(1), "right")[0], answer.w(1), 18)


def test_wrong_states_are_found_out():
    answer = answer_of(trench(3))
    with mp.workdps(answer.digits):
        problem = answer.solution.problem
        search = Search(problem, DIGITS)
        right = answer.solution.state.zones
        shifted = [[tuple((p, q - mpf(10) ** -12) for p, q in z) for z in atom] for atom in right]
        for zones in (shifted, search.full().zones):
            solution = Solution(problem, State((), zones))
            with pytest.raises(AssertionError):
                check(solution, [zones_of(solution, i) for i in (0, 1)], search)


# Random scenes


@pytest.mark.parametrize("seed", range(16))
def test_mirrored_scenes_and_more_digits(seed):
    made = random_scene(seed)
    answer, other = solve(made, digits=25), solve(mirrored(made), digits=35)
    assert answer.status == other.status
    assert answer.status in ("solved", "no-equilibrium")
    if answer.status == "solved" and answer.margin > 1e-12:
        length = Problem(made, 1).length
        size = max(abs(answer.w(length * i / 7)) for i in range(8))
        for i in range(8):
            assert abs(answer.w(length * i / 7) - other.w(length * (7 - i) / 7)) <= 1e-18 * size
        for mine, theirs in zip(answer.contact, other.contact, strict=True):
            assert len(mine) == len(theirs)
            for p, q in zip(mine, theirs[::-1], strict=True):
                assert abs(p.start + q.end - length) < 1e-18 * length
        assert [h.closed for h in answer.supports] == [h.closed for h in other.supports]


def test_random_scenes_are_worth_solving():
    answers = [(made, solve(made, digits=20)) for made in map(random_scene, range(100, 118))]
    solved = [(made, a) for made, a in answers if a.status == "solved"]
    lifted = [a for made, a in solved if sum(z.end - z.start for zones in a.contact for z in zones) < 0.99 * extent(made)]
    assert not [a for _, a in answers if a.status == "unknown"]
    assert len(solved) >= 12
    assert len(lifted) >= 6


def extent(made):
    """Length of all foundations together."""
    length = sum(made["beam"]["spans"])
    return sum(f.get("to", length) - f.get("from", 0.0) for f in made["foundation"])
