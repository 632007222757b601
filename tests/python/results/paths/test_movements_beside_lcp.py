"""Movements that grow with the load factor beside a linear complementarity problem along the factor, in rational numbers.

The beam lies on pins at its ends, and one-sided springs stand between. Their forces p and openings o satisfy o = a + factor b + C p
with C from Maxwell's flexibilities: every set of acting springs has the factors at which it is right, found one by one.
"""

import random
from fractions import Fraction
from itertools import pairwise, product

import gapbeam
import numpy as np
import pytest
from scenes import at, force, scene, uniform

SIDES = {"below": 1, "above": -1}


def flexibility(length, a, x):
    """Deflection at x of a beam on end pins, times EI, under a unit force at a."""
    if x > a:
        a, x = x, a
    b = length - a
    return b * x * (length**2 - b**2 - x**2) / (6 * length)


def solve(matrix, right):
    """Solve a regular system; several right sides."""
    n = len(matrix)
    rows = [list(one) + list(other) for one, other in zip(matrix, right, strict=True)]
    for k in range(n):
        pivot = next(i for i in range(k, n) if rows[i][k])
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(n):
            if i != k and rows[i][k]:
                share = rows[i][k] / rows[k][k]
                rows[i] = [p - share * q for p, q in zip(rows[i], rows[k], strict=True)]
    return [[one / rows[k][k] for one in rows[k][n:]] for k in range(n)]


def problem(made):
    """Openings without forces at factor 0, what a factor of 1 adds, and the matrix of forces."""
    length, EI = sum(map(Fraction, made["beam"]["spans"])), Fraction(made["beam"]["EI"])
    between, last = made["supports"][1:-1], len(made["supports"]) - 1
    moved = {0: [Fraction(0)] * 2, last: [Fraction(0)] * 2}
    opened = []
    for i, one in enumerate(between):
        x, side = Fraction(one["x"]), SIDES[one["side"]]
        level = [Fraction(one["settlement"]) + side * Fraction(one["gap"]), Fraction(0)]
        bent = [Fraction(0)] * 2
        for load in made["loads"]:
            case = 0 if load.get("case") == "dead" else 1
            if load["type"] == "force":
                bent[case] += Fraction(load["F"]) * flexibility(length, Fraction(load["x"]), x) / EI
            elif load["type"] == "uniform":
                bent[case] += Fraction(load["q"]) * x * (length**3 - 2 * length * x**2 + x**3) / (24 * EI)
            elif load["support"] == i + 1:
                level[case] += Fraction(load["value"])
            elif load["support"] in moved:
                share = x / length if load["support"] else 1 - x / length
                bent[case] += share * Fraction(load["value"])
        opened.append([side * (u - w) for u, w in zip(level, bent, strict=True)])
    matrix = [
        [
            SIDES[one["side"]] * SIDES[other["side"]] * flexibility(length, Fraction(one["x"]), Fraction(other["x"])) / EI
            + (1 / Fraction(one["stiffness"]) if i == j and one["stiffness"] != float("inf") else 0)
            for j, other in enumerate(between)
        ]
        for i, one in enumerate(between)
    ]
    return opened, matrix


def stretches(made):
    """Every set of acting supports that is right over some length of factors from 0 to 1: its ends, and forces as lines."""
    opened, matrix = problem(made)
    n, found = len(opened), []
    for acts in product((False, True), repeat=n):
        on = [i for i in range(n) if acts[i]]
        forces = solve([[matrix[i][j] for j in on] for i in on], [[-one for one in opened[i]] for i in on])
        p = [[Fraction(0)] * 2 for _ in range(n)]
        for i, one in zip(on, forces, strict=True):
            p[i] = one
        lines = [
            p[i] if acts[i] else [opened[i][c] + sum(matrix[i][j] * p[j][c] for j in on) for c in (0, 1)] for i in range(n)
        ]
        low, high = Fraction(0), Fraction(1)
        for start, slope in lines:
            if slope > 0:
                low = max(low, -start / slope)
            elif slope < 0:
                high = min(high, -start / slope)
            elif start < 0:
                high = Fraction(-1)
        if low < high:
            found.append((low, high, p))
    return sorted(found)


def random_jacking(rng, tied):
    """A beam with springs between, of which some move; tied: mirrored, with round numbers, so that events coincide."""
    scale, soft = 2.0 ** rng.randint(-30, 30), 2.0 ** rng.randint(-20, 20)
    spans = [float(rng.randint(1, 6)) for _ in range(rng.randint(1, 3))]
    spans = spans + spans[::-1] if tied else spans
    length = sum(spans)
    unit = scale / 64 if tied else scale / 1000.0
    gaps = [0.0, 0.0, unit, 2 * unit] if tied else [0.0, *(rng.randint(-40, 80) * unit for _ in range(3))]
    places = sorted(rng.sample([k * length / 16.0 for k in range(1, 16)], rng.randint(1, 4)))
    if tied:
        places = sorted({*places[:2], *(length - x for x in places[:2])})
    between = []
    for x in places:
        twin = next((one for one in between if tied and one["x"] == length - x), None)
        one = dict(twin) if twin else {
            "side": rng.choice(("below", "below", "above")), "gap": abs(rng.choice(gaps)), "settlement": rng.choice(gaps),
            "stiffness": rng.choice((float("inf"), soft, 64 * soft, soft / 64)),
        }  # fmt: skip
        between.append({**one, "x": x})
    supports = [at(0), *between, at(len(spans))]
    size = scale * soft
    loads = [uniform(rng.choice((0.0, 1.0, 2.0)) * size / length, case="dead")]
    if rng.random() < 0.5:
        loads.append(force(length / 2, rng.randint(-4, 8) * size / 4, **rng.choice(({}, {"case": "dead"}))))
    last = len(supports) - 1
    middle = [k for k, one in enumerate(supports) if one.get("x") == length / 2]
    groups = [middle or [0, last]] if tied else [[k] for k in rng.sample(range(last + 1), rng.randint(1, last + 1))]
    for group in groups:
        keys = {"value": rng.randint(-128, 128) * unit, **rng.choice(({}, {}, {"case": "dead"}))}
        loads += [{"type": "movement", "support": k, **keys} for k in group]
    return scene(spans, supports, [one for one in loads if any(one.get(key) for key in ("q", "F", "value"))],
                 EI=soft * length**3 / 48.0 if not tied else soft * 64.0)  # fmt: skip


def compare_forces(found, made, exact, factor):
    """Reactions of the springs at a factor beside the exact ones."""
    forces = next(p for a, b, p in exact if a <= factor <= b)
    sides = [SIDES[one["side"]] for one in made["supports"][1:-1]]
    right = [side * float(p + Fraction(factor) * q) for side, (p, q) in zip(sides, forces, strict=True)]
    size = max(max(map(abs, one)) for one in forces)
    assert found[1:-1] == pytest.approx(np.array(right), abs=float(1e-12 * size))


def compare(made):
    """Forces in the middle of every stretch, the factors at which they change direction (how many are they?), combinations."""
    result = gapbeam.solve({**made, "analysis": {"follow": "events"}})
    assert result.status == "solved"
    exact = stretches(made)
    ends = sorted({float(one) for low, high, _ in exact for one in (low, high)})
    for low, high in pairwise(ends):
        compare_forces(result.state((low + high) / 2).reaction, made, exact, (low + high) / 2)
    kinks = sorted({float(b) for (_, b, p), (_, _, q) in pairwise(exact) if p != q and b < 1})
    events = [one.factor for one in result.events]
    for kink in kinks:
        assert min(abs(kink - one) for one in events) <= 1e-12, (kink, events)
    for event in events:
        assert min(abs(event - one) for one in ends) <= 1e-12, (event, ends)
    cases = {load.get("case", "live") for load in made["loads"]}
    factors = [0.25, 0.8125, 1.0] if cases else []
    named = [{"name": f"c{k}", "factors": {one: 1.0 if one == "dead" else by for one in cases}} for k, by in enumerate(factors)]
    combined = gapbeam.solve({**made, "combinations": named}).combinations if cases else []
    for k, factor in enumerate(factors):
        compare_forces(combined[k].steps[-1].reaction, made, exact, factor)
    return len(kinks)


@pytest.mark.parametrize("block", range(8))
def test_random_jackings(block):
    rng = random.Random(f"jacking {block}")
    assert sum(compare(random_jacking(rng, tied=k % 2 == 1)) for k in range(40)) > 10
