"""Problems with known answers: closed forms where there are any, printed digits where not.

P1 is the example of the method's source (Ignatiev, Ignatiev, Bochkov 2021), P2 gaps and uplift (among them
the upper beam of Abaqus Benchmarks 1.1.1), P5 equal spans, P6 scenes on which careless switching of
supports cycles, and two larger ones.
"""

import itertools

import gapbeam
import numpy as np
import oracle
import pytest
from scenes import INF, at, force, scene, uniform

RULES = ["block", "single"]
STARTS = list(itertools.product([True, False], repeat=3))


def near(actual, expected, scale=None):
    """Equality to 1e-12 of `scale`, by default of the largest expected value."""
    scale = np.abs(expected).max() if scale is None else scale
    np.testing.assert_allclose(actual, expected, rtol=0.0, atol=1e-12 * scale)


def last(made, **keys):
    """Last step of a scene that has to be solvable."""
    result = gapbeam.solve(made, **keys)
    assert result.status == "solved", result.reason
    return result.steps[-1]


# P1


PAPER_EI, F3, F4 = 44.5, -4.3597, 2.1155


def paper(F2, sides=("above", "below", "below")):
    """The paper's cantilever on three one-sided supports."""
    supports = [at(0, rotation="fixed")] + [at(i + 1, side=side) for i, side in enumerate(sides)]
    return scene([2.0] * 3, supports, [force(2.0, F2), force(4.0, F3), force(6.0, F4)], EI=PAPER_EI)


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("start", [None, *STARTS])
@pytest.mark.parametrize(("F2", "printed"), [(0.70707, 3.8507982), (0.7707, 3.7871682)])
def test_paper_example(F2, printed, rule, start):
    step = last(paper(F2), rule=rule, start=start)
    R2, R4, w3 = F2 + 23 / 22 * F3, F4 + 4 / 11 * F3, 13 / 132 * F3 * 2.0**3 / PAPER_EI
    assert step.state == ("bilateral", "closed", "open", "closed")
    if rule == "block" or start in (None, (True, True, True)):  # the paper's rule begins with all supports closed
        assert step.solves <= 3
    near(step.reaction, [9 / 22 * -F3, R2, 0.0, R4])
    near(step.deflection, [0.0, 0.0, w3, 0.0])
    near(step.opening, [0.0, 0.0, -w3, 0.0])
    near(step.couple, [3 / 11 * F3, 0.0, 0.0, 0.0])
    assert [f"{abs(v):.7f}" for v in (step.reaction[1], step.reaction[3], w3)] == [
        f"{printed:.7f}",
        "0.5301545",
        "0.0771891",
    ]


@pytest.mark.parametrize("steps", [1, 2, 5])
def test_paper_example_has_one_scheme_at_every_load(steps):
    made = paper(0.70707)
    made["analysis"] = {"steps": steps}
    result = gapbeam.solve(made)
    assert [states for _, states in result.history()] == [("bilateral", "closed", "open", "closed")] * steps
    for step in result.steps:
        near(step.reaction, step.factor * result.steps[-1].reaction)


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("start", STARTS)
@pytest.mark.parametrize("sides", list(itertools.product(["above", "below"], repeat=3)))
def test_paper_example_in_all_orientations(sides, start, rule):
    made = paper(0.70707, sides)
    step = last(made, rule=rule, start=start)
    expected = oracle.solve(made)
    assert step.state == tuple(expected.state)
    near(step.reaction, np.array(expected.reaction, dtype=float))
    near(step.deflection, np.array(expected.deflection, dtype=float))
    listed = {"aaa": [2], "aab": [3, 4], "baa": [3], "abb": [2, 4]}.get("".join(side[0] for side in sides))
    closed = [i + 1 for i, state in enumerate(step.state) if state == "closed"]
    assert listed is None or closed == listed


# P2


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("share", [0.5, 1 - 1e-9, 1 + 1e-9, 2.0, 30.0])
@pytest.mark.parametrize("c", [INF, 850.0])
def test_support_with_a_gap_at_midspan(c, share, rule):
    L, EI, d = 5.0, 3200.0, 0.012
    q = share * 76.8 * EI * d / L**4
    made = scene([L], [at(0), at(1), at(x=L / 2, side="below", gap=d, stiffness=c)], [uniform(q)], EI=EI)
    step = last(made, rule=rule)
    beam, free = 48 * EI / L**3, 5 * q * L**4 / (384 * EI)
    stopped = d if c == INF else (5 * q * L / 8 + c * d) / (beam + c)
    w = stopped if share > 1 else free
    R = (free - w) * beam
    assert step.state[2] == ("closed" if share > 1 else "open")
    near(step.deflection, [0.0, 0.0, w])
    near(step.reaction, [(q * L - R) / 2, (q * L - R) / 2, R], q * L)


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize(
    ("P", "at_1", "at_3"),
    [
        *((40.0, 0.0, 18.3), (60.0, 0.0, 28.7), (80.0, 0.0, 39.1), (100.0, 0.0, 49.5), (120.0, 0.0, 59.8)),
        *((140.0, 10.7, 68.6), (160.0, 31.6, 75.9), (180.0, 52.5, 83.2), (200.0, 73.4, 90.4)),
    ],
)
def test_cantilever_between_stops(P, at_1, at_3, rule):
    EI, d = 2162.7, 0.01
    stops = [at(1, side="below", gap=d), at(3, side="below", gap=d)]
    step = last(scene([1.0] * 5, [at(0, rotation="fixed"), *stops], [force(2.0, P)], EI=EI), rule=rule)
    np.testing.assert_allclose(
        step.reaction[1:], [at_1, at_3], rtol=0.0, atol=0.06
    )  # the digits printed there

    def bend(a, x):
        """Deflection at x by a unit force at a."""
        a, x = max(a, x), min(a, x)
        return x**2 * (3 * a - x) / (6 * EI)

    flexibility = np.array([[bend(1, 1), bend(1, 3)], [bend(1, 3), bend(3, 3)]])
    free = P * np.array([bend(1, 2), bend(2, 3)])
    both, second = np.linalg.solve(flexibility, free - d), [0.0, (free[1] - d) / flexibility[1, 1]]
    R = np.array(both if at_1 else second)
    near(step.reaction, [P - R.sum(), *R])
    near(step.deflection[1:], free - flexibility @ R, free[1])
    assert step.state[1:] == ("closed" if at_1 else "open", "closed")


@pytest.mark.parametrize("rule", RULES)
def test_far_end_lifts_at_six_times_the_own_weight(rule):
    made = scene([1.0, 1.0], [at(i, side="below") for i in range(3)],
                 [uniform(1.0, case="dead"), uniform(10.0, to=1.0)], analysis={"steps": 20})  # fmt: skip
    result = gapbeam.solve(made, rule=rule)
    assert result.status == "solved"
    for step in result.steps:
        q = 10.0 * step.factor
        lifted = max(q - 6.0, 0.0)
        if abs(q - 6.0) > 1e-9:  # at q = 6 both are right
            assert step.state == ("closed", "closed", "open" if lifted else "closed")
        flat = [(6 + 7 * q) / 16, (20 + 10 * q) / 16, (6 - q) / 16]
        near(step.reaction, [q / 2, 2 + q / 2, 0.0] if lifted else flat)
        near(step.opening, [0.0, 0.0, lifted / 24], 1.0)
    near(result.steps[-1].reaction, [5.0, 7.0, 0.0])
    near(result.steps[-1].opening[2], 1 / 6)


@pytest.mark.parametrize("rule", RULES)
def test_heavy_beam_lifted_off_a_rigid_base(rule):
    """Nodes every 0.1: own weight spread over the lifted part, given to the nodes where the beam lies."""
    count, h, F = 60, 0.1, 1.5
    length = 2 * F
    touch = round(length / h)
    lumps = [force(i * h, h / (2 if i in (touch, count) else 1)) for i in range(touch, count + 1)]
    made = scene([h] * count, [at(i, side="below") for i in range(count + 1)],
                 [force(0.0, -F), uniform(1.0, to=touch * h), *lumps])  # fmt: skip
    step = last(made, rule=rule)
    assert step.state == ("open",) * touch + ("closed",) * (count + 1 - touch)
    near(step.opening[0], length**4 / 24)
    near(step.reaction[touch], length / 2 + h / 2)
    near(step.reaction[touch + 1 : -1], h + np.zeros(count - touch - 1), length)


@pytest.mark.parametrize("rule", RULES)
def test_heavy_beam_with_its_weight_spread_everywhere(rule):
    made = scene([0.1] * 60, [at(i, side="below") for i in range(61)], [force(0.0, -1.5), uniform(1.0)])
    step = last(made, rule=rule)
    lifted = step.state.index("closed")
    assert abs(0.1 * lifted - 3.0) < 0.15
    assert step.opening[0] == pytest.approx(3.375, rel=0.02)
    assert step.reaction.sum() == pytest.approx(4.5, rel=1e-12)


# P5


EQUAL = {2: [3 / 8, 5 / 4], 3: [0.4, 1.1], 4: [11 / 28, 8 / 7, 13 / 14], 5: [15 / 38, 43 / 38, 37 / 38]}


@pytest.mark.parametrize("side", ["both", "below"])
@pytest.mark.parametrize("count", EQUAL)
def test_equal_spans(count, side):
    q, L = 3.0, 4.5
    step = last(scene([L] * count, [at(i, side=side) for i in range(count + 1)], [uniform(q)], EI=800.0))
    half = EQUAL[count]
    near(step.reaction, q * L * np.array(half + half[::-1][len(half) * 2 - count - 1 :]))


@pytest.mark.parametrize("f", [0.0, 0.01, 0.25, 10.0])
def test_shear_flexible_two_spans(f):
    q, L, EI = 3.0, 4.5, 800.0
    GA = EI / (f * L**2) if f else INF
    step = last(scene([L, L], [at(0), at(1), at(2)], [uniform(q)], EI=EI, GA=GA))
    near(step.reaction[1], q * L * (5 / 4 + 3 * f) / (1 + 3 * f))


# P6


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("start", [None, *STARTS])
def test_smallest_scene_that_cycles(start, rule):
    supports = [
        at(0),
        at(1, side="above", stiffness=1e6, gap=-0.009),
        at(2, side="below", stiffness=1e8, gap=0.018),
        at(3, side="below", stiffness=1e6, gap=-0.012),
        at(4),
    ]
    made = scene([1.0] * 4, supports, [force(1.0, -80.0), force(2.0, 35.0)], EI=1000.0)
    step = last(made, rule=rule, start=start)
    assert step.state[1:4] == ("closed", "open", "closed")
    assert [f"{w:.8f}" for w in step.deflection[1:4]] == ["0.00888281", "0.00046923", "-0.01191242"]
    near(step.reaction, np.array(oracle.solve(made).reaction, dtype=float))


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("start", [None, *itertools.product([True, False], repeat=2)])
def test_tie_does_not_cycle(start, rule):
    supports = [
        at(0),
        at(1, side="below", stiffness=1e5, gap=0.015),
        at(2, side="below", stiffness=1e6, gap=0.010),
        at(3),
    ]
    made = scene([1.0] * 3, supports, [force(1.0, 60.0), force(2.0, -30.0)], EI=1000.0)
    step = last(made, rule=rule, start=start)
    near(step.deflection, [0.0, 0.015, 0.010, 0.0])
    near(step.reaction, [30.0, 0.0, 0.0, 0.0])


def work_a(count):
    """Equal spans on springs with gaps, loads from a seeded generator."""
    supports = [at(0), at(count)]
    supports += [at(i, side="below", stiffness=1e5, gap=0.002 * (i % 3)) for i in range(1, count)]
    q = np.random.default_rng(7).uniform(-10.0, 25.0, count)
    loads = [uniform(float(q[i]), **{"from": 6.0 * i, "to": 6.0 * (i + 1)}) for i in range(count)]
    return scene([6.0] * count, supports, loads, EI=1e4)


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize(("count", "closed", "largest"), [(10, 8, "0.03416"), (100, 65, "1.838")])
def test_many_spans_on_springs_with_gaps(count, closed, largest, rule):
    step = last(work_a(count), rule=rule)
    assert step.state.count("closed") == closed
    assert f"{np.abs(step.deflection).max():.4g}" == largest


def test_a_thousand_spans_on_springs_with_gaps():
    result = gapbeam.solve(work_a(1000))
    assert result.steps[-1].state.count("closed") == 687
    assert f"{np.abs(result.steps[-1].deflection).max():.4g}" == "31.89"  # of the supports
    extremes = result._pairs_of_extremes()["deflection"]
    assert f"{max(abs(extremes[end][0]) for end in ('max', 'min')):.4g}" == "31.99"  # of the beam


def test_many_spans_against_the_oracle():
    made = work_a(10)
    made["supports"] = [s for s in made["supports"] if s["node"] != 5]
    step, expected = last(made), oracle.solve(made)
    assert step.state == tuple(expected.state)
    near(step.reaction, np.array(expected.reaction, dtype=float))
    near(step.deflection, np.array(expected.deflection, dtype=float))


@pytest.mark.parametrize(("count", "closed", "largest"), [(100, 42, "0.2621"), (1000, 407, "0.2610")])
def test_free_beam_on_one_sided_springs(count, closed, largest):
    h = 100.0 / count
    supports = [
        at(i, side="below", stiffness=1e4 * h / (2 if i in (0, count) else 1)) for i in range(count + 1)
    ]
    made = scene([h] * count, supports, [uniform(1.0), force(50.0, 500.0), force(30.0, -60.0)], EI=1e5)
    step = last(made)
    assert step.state.count("closed") == closed
    assert f"{np.abs(step.deflection).max():.4f}" == largest
    near(step.reaction.sum(), 540.0)
