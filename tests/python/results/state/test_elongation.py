"""Elongations by temperature between axial supports, beside closed forms and chains in rational numbers."""

import itertools
import math
import random
from fractions import Fraction

import gapbeam
import pytest
from scenes import at, scene

ALPHA = 1.2e-5


def chain(EA, supports, loads, spans=(4.0, 2.0, 6.0)):
    """A beam on rollers with axial supports by node: (node, stiffness, settlement)."""
    across = [at(k) for k in range(len(spans) + 1)]
    along = [at(k, direction="axial", stiffness=c, settlement=d) for k, c, d in supports]
    found = scene(list(spans), [*across, *along], loads, EI=1e7)
    return found | {"beam": found["beam"] | {"alpha": ALPHA, "EA": EA}}


def warm(dT, **keys):
    return {"type": "temperature", "dT": dT, **keys}


def test_between_rigid_supports():
    """N = -EA alpha dT; a free end moves by alpha dT L, and without axial supports nothing is to be solved."""
    held = gapbeam.solve(chain(4e6, [(0, math.inf, 0.0), (3, math.inf, 0.0)], [warm(60.0)]))
    assert held.at([1.0, 9.0]).axial_force == pytest.approx([-2880.0, -2880.0], rel=1e-14)
    free = gapbeam.solve(chain(4e6, [(0, math.inf, 0.0)], [warm(60.0)]))
    assert free.at([0.0, 3.0, 12.0]).axial_displacement == pytest.approx([0.0, ALPHA * 60 * 3, ALPHA * 60 * 12], rel=1e-14)
    assert free.extremes["axial_displacement"]["max"].value == pytest.approx(ALPHA * 60 * 12, rel=1e-14)
    loose = gapbeam.solve(chain(4e6, [], [warm(60.0)]))
    assert "axial" in loose.to_dict()["system"]["left_out"]


def test_rigid_bars_are_pushed_apart():
    """With infinite EA a spring c at the end takes c alpha dT L; where only one span is warm, its length counts."""
    result = gapbeam.solve(chain(math.inf, [(0, math.inf, 0.0), (3, 500.0, 0.0)], [warm(60.0, **{"from": 4.0, "to": 6.0})]))
    assert result.at(1.0).axial_force == pytest.approx(-500.0 * ALPHA * 60.0 * 2.0, rel=1e-14)
    assert result.at([4.0, 5.0, 9.0]).axial_displacement == pytest.approx([0.0, ALPHA * 60, ALPHA * 120], rel=1e-14)


@pytest.mark.parametrize("seed", range(40))
def test_random_chains(seed):
    """Beside tridiagonal equations in rational numbers: bars EA/L (du - alpha dT L), springs, forces, at a load factor."""
    rng = random.Random(seed)
    spans = [rng.randint(2, 40) / 8 for _ in range(rng.randint(1, 6))]
    n = len(spans)
    EA = [rng.choice((1e2, 1e4, 4e6)) for _ in spans]
    springs = [(k, rng.choice((10.0, 1e3, 1e6)), rng.randint(-8, 8) / 1024) for k in range(n + 1) if k == 0 or rng.random() < 0.4]
    heat = [rng.randint(-40, 80) for _ in spans]
    forces = [rng.randint(-50, 50) for _ in range(n + 1)]
    ends = [sum(spans[:k]) for k in range(n + 1)]
    loads = [warm(float(heat[k]), **{"from": ends[k], "to": ends[k + 1]}, case=rng.choice(("dead", "live"))) for k in range(n)]
    loads += [{"type": "axial", "node": k, "F": float(f)} for k, f in enumerate(forces)]
    factor = Fraction(3, 8)
    share = [Fraction(1) if one["case"] == "dead" else factor for one in loads[:n]]
    # Equilibrium at every node, unknown displacements
    rows = [[Fraction(0)] * (n + 2) for _ in range(n + 1)]
    longer = [Fraction(ALPHA * h) * Fraction(spans[k]) * share[k] for k, h in enumerate(heat)]
    for k in range(n):
        stiff = Fraction(EA[k]) / Fraction(spans[k])
        for node, sign in ((k, 1), (k + 1, -1)):
            rows[node][k] += sign * stiff
            rows[node][k + 1] -= sign * stiff
            rows[node][-1] -= sign * stiff * longer[k]
    for k, c, d in springs:
        rows[k][k] += Fraction(c)
        rows[k][-1] += Fraction(c) * Fraction(d)
    for k, f in enumerate(forces):
        rows[k][-1] += factor * f
    for i in range(n + 1):
        for j in range(i + 1, n + 1):
            ratio = rows[j][i] / rows[i][i]
            rows[j] = [b - ratio * a for a, b in zip(rows[i], rows[j], strict=True)]
    u = [Fraction(0)] * (n + 1)
    for i in range(n, -1, -1):
        u[i] = (rows[i][-1] - sum(rows[i][j] * u[j] for j in range(i + 1, n + 1))) / rows[i][i]
    tension = [Fraction(EA[k]) / Fraction(spans[k]) * (u[k + 1] - u[k] - longer[k]) for k in range(n)]
    result = gapbeam.solve(chain(EA, springs, loads, spans))
    middles = [(a + b) / 2 for a, b in itertools.pairwise(ends)]
    found = result.at(middles, factor=float(factor))
    size = max(max(map(abs, tension)), max(map(abs, forces)), 1)
    far = max(max(map(abs, u)), max(map(abs, longer)))
    assert found.axial_force == pytest.approx([float(one) for one in tension], abs=float(1e-12 * size))
    assert found.axial_displacement == pytest.approx([float(a + b) / 2 for a, b in itertools.pairwise(u)], abs=float(1e-12 * far))
