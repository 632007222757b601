"""Compressed beams that give way where a support is lost or yields, or leaves them without any load: closed forms and elements."""

import itertools
import math
import random
import re

import gapbeam
import numpy as np
import pytest
from mpmath import findroot, mp, mpf
from mpmath import tan as tangent
from scenes import at, force, scene


def share_of(result):
    assert result.status == "buckles"
    return float(re.search(r"bears (\S+) times", result.reason)[1])


def test_a_strut_whose_joint_yields():
    """Halves of length a: M (u cot u - P a/(2 c)) = F a/2 with u = a sqrt(P/EI), until M is what the joint yields at."""
    EI, a, c, limit, F = 1000.0, 2.0, 4000.0, 5.0, 2.0

    def left_over(u, F):
        return limit * (u / tangent(u) - u**2 * EI / a / (2 * c)) - F * a / 2

    with mp.workdps(30):
        P = float(findroot(lambda u: left_over(u, F), (mpf("0.5"), mpf("1.5")), solver="anderson") ** 2 * EI / a**2)
        u = mp.sqrt(mpf(0.9 * P) / EI) * a
        most = float(left_over(u, 0) * 2 / a)
    law = [[limit / c, limit], [limit / c + 0.1, limit + 30.0]]
    strut = scene([2 * a], [at(0), at(1)], [force(a, F)], EI=EI, N=-1.5 * P) | {"hinges": [{"x": a, "law": law}]}
    result = gapbeam.solve(strut)
    assert share_of(result) == pytest.approx(1 / 1.5, rel=1e-5)
    # The mode has its kink in the joint
    x, w = np.transpose(result.motion)
    assert abs(w[np.searchsorted(x, a)]) == pytest.approx(1.0)
    assert max(abs(np.interp(a / 2, x, w)), 0.5) < 0.6
    # Under less of it the load cannot grow beyond
    strut["beam"]["N"] = -0.9 * P
    strut["loads"] = [force(a, 1.5 * most)]
    followed = gapbeam.solve({**strut, "analysis": {"follow": "events"}})
    assert followed.status == "buckles"
    assert float(re.search(r"above load factor (\S+):", followed.reason)[1]) == pytest.approx(1 / 1.5, rel=1e-11)
    strut["loads"] = [force(a, most * (1 - 1e-9))]
    assert gapbeam.solve(strut).status == "solved"


def test_a_beam_whose_support_yields():
    """w = s (F - R) at the middle, s = (tan k/(2 k) - 1/2)/P, k = sqrt(P/EI): R = 2 where 1/s = -100: 200 hold, 50 do not."""

    def left_over(k):
        return tangent(k) / (2 * k) - mpf("0.5") + k**2

    EI = 100.0
    with mp.workdps(30):
        P = float(EI * findroot(left_over, (mpf("1.6"), mpf("1.8")), solver="anderson") ** 2)
    middle = at(1, side="below", law=[[0.01, 2.0], [0.02, 2.5]])
    made = scene([1.0, 1.0], [at(0), middle, at(2)], [force(1.0, 1.0)], EI=EI, N=-1.1 * P)
    assert share_of(gapbeam.solve(made)) == pytest.approx(1 / 1.1, rel=1e-5)
    made["beam"]["N"] = -P * (1 - 1e-9)
    assert gapbeam.solve(made).steps[-1].reaction[1] == pytest.approx(2.0, rel=1e-6)


@pytest.mark.parametrize("side", ["below", "above"])
def test_a_column_without_loads_leaves_its_support(side):
    column = scene([1.0, 1.0], [at(0), at(1, side=side), at(2)], EI=1.0, N=-5.0)
    result = gapbeam.solve(column)
    assert share_of(result) == pytest.approx(math.pi**2 / 4 / 5.0, rel=1e-5)
    assert max((w for _, w in result.motion), key=abs) == pytest.approx(-1.0 if side == "below" else 1.0)
    # Under less of it the factor says so
    stands = gapbeam.solve({**column, "beam": {**column["beam"], "N": -1.0}, "analysis": {"buckling": 2}})
    assert stands.buckling[0] == pytest.approx(math.pi**2 / 4, rel=1e-14)
    mode = stands.mode("buckling", 1)
    assert np.abs(mode.deflection) == pytest.approx(np.sin(math.pi * np.asarray(mode.x) / 2), abs=1e-9)
    # Held both ways, or pressed onto it by next to nothing, it stands
    assert gapbeam.solve(scene([1.0, 1.0], [at(0), at(1), at(2)], EI=1.0, N=-5.0)).status == "solved"
    pressed = {**column, "loads": [force(0.7, 1e-9 if side == "below" else -1e-9)]}
    assert gapbeam.solve(pressed).status == "solved"
    # Lifted off by the first of a load that grows it buckles; that was told as a mechanism
    lifted = {**column, "loads": [force(0.7, -1.0 if side == "below" else 1.0)], "analysis": {"follow": "events"}}
    result = gapbeam.solve(lifted)
    assert result.reason.startswith("buckles at load factor 0:")
    assert share_of(result) == pytest.approx(math.pi**2 / 4 / 5.0, rel=1e-5)


@pytest.mark.parametrize("side", ["below", "above"])
def test_a_column_without_loads_leaves_its_ground(side):
    """It is held by the ground one way only, however much it bears with it."""
    made = scene([10.0], [at(0), at(1)], EI=1.0, N=-0.05) | {"foundation": [{"k": 100.0, "side": side}]}
    euler = math.pi**2 / 100.0
    assert gapbeam.solve({**made, "analysis": {"buckling": 1}}).buckling == pytest.approx([euler / 0.05], rel=1e-14)
    for N in (0.11, 1.0, 19.0, 21.0, 1e3):
        result = gapbeam.solve({**made, "beam": {**made["beam"], "N": -N}})
        assert share_of(result) == pytest.approx(euler / N, rel=1e-5)
        assert max((w for _, w in result.motion), key=abs) == pytest.approx(-1.0 if side == "below" else 1.0)
    # Its weight presses it on
    heavy = {**made, "beam": {**made["beam"], "N": -1.0}, "loads": [{"type": "uniform", "q": 1.0 if side == "below" else -1.0}]}
    assert gapbeam.solve(heavy).status == "solved"


def test_a_hinge_with_slack_turns_under_next_to_nothing():
    made = scene([1.0, 1.0], [at(0), at(1, side="below"), at(2)], EI=1.0, N=-1.0) | {"hinges": [{"x": 0.5, "slack": 0.01}]}
    assert share_of(gapbeam.solve(made)) == 0.0


def least_compression(spans, sides, parts=6):
    """By cubic elements, all ways of leaving some of the one-sided supports: the least compression with a mode that may."""
    nodes = parts * len(spans) + 1
    K, G = np.zeros((2, 2 * nodes, 2 * nodes))
    for e in range(nodes - 1):
        h, at_ = spans[e // parts] / parts, slice(2 * e, 2 * e + 4)
        K[at_, at_] += np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h**2, -6 * h, 2 * h**2],
                                 [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h**2, -6 * h, 4 * h**2]]) / h**3  # fmt: skip
        G[at_, at_] += np.array([[36, 3 * h, -36, 3 * h], [3 * h, 4 * h**2, -3 * h, -(h**2)],
                                 [-36, -3 * h, 36, -3 * h], [3 * h, -(h**2), -3 * h, 4 * h**2]]) / (30 * h)  # fmt: skip
    ways = {2 * parts * i: (1.0 if side == "below" else -1.0) for i, side in enumerate(sides) if side != "both"}
    both = [2 * parts * i for i, side in enumerate(sides) if side == "both"]
    least = math.inf
    for held in (list(some) for r in range(len(ways) + 1) for some in itertools.combinations(ways, r)):
        free = np.setdiff1d(np.arange(2 * nodes), both + held)
        values, modes = np.linalg.eig(np.linalg.solve(K[np.ix_(free, free)], G[np.ix_(free, free)]))
        for value, mode in zip(values.real, modes.real.T, strict=True):
            w = dict(zip(free.tolist(), mode / np.abs(mode).max(), strict=True))
            pressed = [w.get(place, 0.0) * way for place, way in ways.items()]
            if value > 0 and (max(pressed) <= 1e-9 or min(pressed) >= -1e-9):
                least = min(least, 1 / value)
    return least


@pytest.mark.parametrize("seed", range(25))
def test_columns_without_loads_beside_elements(seed):
    rng = random.Random(seed)
    spans = [rng.uniform(1.0, 3.0) for _ in range(rng.randint(2, 4))]
    sides = ["both", *(rng.choice(["below", "above", "both"]) for _ in spans[1:]), "both"]
    sides[1] = rng.choice(["below", "above"])
    least = least_compression(spans, sides)
    supports = [at(i, side=side) for i, side in enumerate(sides)]
    assert gapbeam.solve(scene(spans, supports, EI=1.0, N=-0.99 * least)).status == "solved"
    result = gapbeam.solve(scene(spans, supports, EI=1.0, N=-1.01 * least))
    assert share_of(result) == pytest.approx(1 / 1.01, rel=1e-3)


@pytest.mark.parametrize("behind", [False, True])
@pytest.mark.parametrize("off", [0.0, 1e-15, -1e-15, 1e-12])
def test_a_part_that_would_buckle_by_itself_by_chance(off, behind):
    """N = k L: elimination from the spring on comes to a pivot that is rounding, whether the rest holds the beam or does not."""
    spans, N, x, ends = [5.0, 3.0], [-250.0 * (1.0 + off), 0.0], 2.78, (0, 2)
    if behind:
        spans, N, x, ends = spans[::-1], N[::-1], 8.0 - x, ends[::-1]

    def solved(*more):
        supports = [at(ends[0], stiffness=50.0), at(ends[1]), *more]
        return gapbeam.solve(scene(spans, supports, [force(x, 10.0)], EI=1000.0, N=N) | {"analysis": {"buckling": 1}})

    held = solved(at(1))
    assert held.status == "solved"
    assert held.buckling == pytest.approx([1.14731604961708], rel=4e-12)
    total = np.sum(held.steps[-1].reaction)
    assert total == pytest.approx(10.0, rel=1e-14)
    for more in ((), (at(1, side="above"),)):
        assert share_of(solved(*more)) == pytest.approx(0.90334, rel=1e-5)


@pytest.mark.parametrize("load", [2.0, 4.748940880243849])
def test_at_just_the_load_under_which_it_buckles(load):
    """A pin and a spring k under N = k L: whatever rounding leaves of the last pivot, nothing holds it, seen from either side."""
    for supports, x in (([at(0), at(1, stiffness=50.0)], load), ([at(0, stiffness=50.0), at(1)], 5.0 - load)):
        strut = scene([5.0], supports, [{"type": "uniform", "q": 2.0}, force(x, 8.0)], EI=1000.0, N=-250.0)
        assert share_of(gapbeam.solve(strut)) == pytest.approx(1.0, rel=1e-9)


@pytest.mark.parametrize("off", [0.0, 1e-15, 1e-14, -1e-13, 1e-12, 1e-11])
def test_huge_numbers_that_elimination_passes_on_are_refined_away(off):
    """The part from the spring of 50 to the next support would buckle by itself under this N, or one next to it."""
    spans, N = [5.0, 3.0, 2.0, 5.0, 5.0], [-0.25, -0.25, -0.25, -250.0 * (1.0 + off), -250.0 * (1.0 + off)]
    above = [at(k, side="above", gap=0.005) for k in (1, 3)]
    supports = [at(0), above[0], at(2), above[1], at(4, stiffness=400.0), at(5, stiffness=50.0)]
    loads = [{"type": "uniform", "q": 3.0}, force(16.561054491466937, -8.0)]
    there = gapbeam.solve(scene(spans, supports, loads, EI=1000.0, N=N))
    behind = [{**one, "node": 5 - one["node"]} for one in reversed(supports)]
    turned = scene(spans[::-1], behind, [loads[0], force(20.0 - 16.561054491466937, -8.0)], EI=1000.0, N=N[::-1])
    assert gapbeam.solve(turned).steps[-1].reaction[::-1] == pytest.approx(there.steps[-1].reaction, rel=1e-12)


@pytest.mark.parametrize(("N", "status"), [(0.99, "solved"), (1.01, "buckles"), (3.0, "buckles")])
def test_a_strut_whose_supports_all_cease_to_push_at_once(N, status):
    """Couples m (1 + c k tan(kL/2)/P) and m on a strut whose left end a spring c turns: all of it bends as under m at that P."""
    EI, L, P, c, m = 400.0, 8.0, 30.0, 120.0, -1.0
    k = math.sqrt(P / EI)
    left = m * (1 + c * k * math.tan(k * L / 2) / P)
    loads = [{"type": "moment", "node": 0, "M": left}, {"type": "moment", "node": 1, "M": -m}]
    result = gapbeam.solve(scene([L], [{"node": 0, "side": "below", "rotation": c}, at(1)], loads, EI=EI, N=-N * P))
    assert result.status == status
    if status == "buckles":
        assert share_of(result) == pytest.approx(1 / N, rel=1e-5)
