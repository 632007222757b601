"""Balances: a beam over a rigid middle, with equal softening cubics under its tips. They soften together, where the path branches.

By hand: both arms take the same force P = load - r(x) = load - r(y), and bend by P/k each, k = 3 EI/a**3, while the beam turns
freely about its middle: (x + y)/2 = P/k, r(x) = r(y). The symmetric state loses its stability at the peak x0 of the law.
Beside it the load is k (x + y)/2 + c for a force c in both, x and y being two of the three roots of r = c, whose sum is -k2/k3
less the third one z. So it rises beyond the bifurcation if and only if k > 2 r'(z), at z with r(z) = r(x0); then it rises
all the way, until the beam is straight again.
"""

import random

import gapbeam
import mpmath as mp
import pytest


def balance(seed):
    rng = random.Random(seed)
    a, EI = rng.choice([1.0, 2.0, 3.0]), float(rng.choice([1.0, 10.0, 50.0, 200.0]))
    k1 = float(rng.choice([10.0, 50.0, 100.0]))
    k3 = k1 * 10 ** rng.uniform(0, 3)
    law = {"type": "cubic", "k1": k1, "k2": -rng.uniform(1.75, 1.99) * (k1 * k3) ** 0.5, "k3": k3}
    d = 2 * (k1 / k3) ** 0.5
    force = 3 * EI / a**3 * d + force_of(law, d)
    return {
        "beam": {"spans": [a, a], "EI": EI},
        "supports": [{"node": 0, "side": "below", "law": law}, {"node": 1}, {"node": 2, "side": "below", "law": law}],
        "loads": [{"type": "force", "node": node, "F": force} for node in (0, 2)],
        "analysis": {"follow": "events"},
    }


def force_of(law, d):
    return d * (law["k1"] + d * (law["k2"] + law["k3"] * d))


def by_hand(made):
    """Stiffness of an arm, load factor of the bifurcation, and whether the load rises beyond."""
    law, (a, _) = made["supports"][0]["law"], made["beam"]["spans"]
    with mp.workdps(40):
        k1, k2, k3 = (mp.mpf(law[key]) for key in ("k1", "k2", "k3"))
        k = 3 * mp.mpf(made["beam"]["EI"]) / mp.mpf(a) ** 3
        top = (-k2 - mp.sqrt(k2 * k2 - 3 * k1 * k3)) / (3 * k3)
        z = -k2 / k3 - 2 * top
        bifurcation = (k * top + force_of({"k1": k1, "k2": k2, "k3": k3}, top)) / mp.mpf(made["loads"][0]["F"])
        return float(k), float(bifurcation), k > 2 * (k1 + z * (2 * k2 + 3 * k3 * z))


@pytest.mark.parametrize("block", range(2))
def test_balances(block):
    rising = 0
    for seed in range(12 * block, 12 * (block + 1)):
        made = balance(seed)
        k, bifurcation, rises = by_hand(made)
        rising += rises
        result = gapbeam.solve(made)
        if not rises:
            (limit,) = result.limits
            assert (result.status, limit.kind, result.segments[-1].exact) == ("limit-load", "bifurcation", True), seed
            assert limit.factor == pytest.approx(bifurcation, rel=1e-12)
            continue
        assert (result.status, result.limits) == ("solved", []), seed
        first, branch = result.segments
        assert (first.stop, branch.start, branch.stop) == (pytest.approx(bifurcation, rel=1e-12), first.stop, 1.0)
        assert first.exact
        assert branch.exact
        assert branch.stable
        law, force = made["supports"][0]["law"], made["loads"][0]["F"]
        turned = []
        for share in (1e-3, 0.05, 0.2, 0.5, 1.0):
            step = result.path.step(branch, branch.start + share * (branch.stop - branch.start))
            x, _, y = step.deflection
            turned.append(abs(x - y) / max(abs(x), abs(y)))
            assert force_of(law, x) == pytest.approx(force_of(law, y), rel=1e-9), seed
            assert step.reaction[0] == pytest.approx(force_of(law, x), rel=1e-9)
            assert k * (x + y) / 2 + force_of(law, x) == pytest.approx(step.factor * force, rel=1e-9)
        assert turned[0] > 1e-3
    assert 2 < rising < 9


def test_what_polylines_get_wrong_is_refused_where_the_path_goes_on():
    """With a jump the landing lies on a path that only the polylines tell."""
    made = balance(0)
    made["analysis"]["at_limit"] = "jump"
    with pytest.raises(gapbeam.EngineError, match=r"0\.1751.* equal smooth laws soften together.*at_limit = \"stop\""):
        gapbeam.solve(made)
