"""Long beams, in which the last changes of the scheme are made where they are: the answer does not depend on the way."""

import random

import gapbeam
import numpy as np
import pytest
from scenes import at, force, scene, uniform


def long_beam(rng):
    """Hundreds of supports below and above, rigid and elastic, with gaps, lack of fit and hinges."""
    spans = rng.randint(300, 900)
    stiffness = rng.choice((None, 1e1, 1e3, 1e6))
    supports = [at(0, rotation=rng.choice(("free", "fixed")))]
    for i in range(1, spans):
        rigid = stiffness is None or rng.random() < 0.2
        gap = rng.choice((0.0, 0.0, rng.uniform(-0.005, 0.02)))
        supports.append(
            at(i, side=rng.choice(("below", "below", "above", "both")), gap=0.0, **({} if rigid else {"stiffness": stiffness}))
        )
        if supports[-1]["side"] != "both":
            supports[-1]["gap"] = gap
    supports.append(at(spans))
    loads = [{**uniform(rng.uniform(-3.0, 3.0)), "from": float(i), "to": i + 1.0} for i in range(spans)]
    loads += [force(rng.uniform(0.0, spans), rng.uniform(-5.0, 5.0)) for _ in range(10)]
    hinges = [i + 0.5 for i in range(5, spans - 5, 50)] if rng.random() < 0.4 else []
    made = scene([1.0] * spans, supports, loads, EI=rng.choice((1.0, 30.0)))
    made["beam"]["hinges"] = hinges
    return made


@pytest.mark.parametrize("seed", range(24))
def test_any_start_ends_in_the_same_state(seed):
    rng = random.Random(seed)
    made = long_beam(rng)
    one_sided = sum(support["side"] != "both" for support in made["supports"] if "side" in support)
    steps = [
        gapbeam.solve(made, rule=rule, start=start).steps[-1]
        for rule, start in (
            ("block", None),
            ("block", [rng.random() < 0.5 for _ in range(one_sided)]),
            ("block", [False] * one_sided),
            ("single", None),
        )
    ]
    first = steps[0]
    assert first.certificate["complementarity"] <= 1e-15
    assert max(first.residuals.values()) < 1e-15
    for step in steps[1:]:
        assert step.state == first.state
        assert step.reaction == pytest.approx(first.reaction, abs=1e-14 * np.abs(first.reaction).max())
        assert step.deflection == pytest.approx(first.deflection, abs=1e-14 * np.abs(first.deflection).max())


def test_least_index_goes_on_from_the_best_scheme():
    """A beam without loads that a few supports raise: the scheme tried last, with 1,000 more wrong, is no place to begin."""
    rng, spans = np.random.default_rng(0), 1200
    gap = rng.normal(0.002, 0.001, spans + 1) * rng.choice([0, 1], spans + 1)
    stiffness = np.where(rng.random(spans + 1) < 0.5, 10 ** rng.uniform(2, 6, spans + 1), np.inf)
    supports = {"node": np.arange(spans + 1), "side": "below", "stiffness": stiffness, "gap": gap}
    beam = {"spans": rng.uniform(2, 8, spans).round(3).tolist(), "EI": 883022.0}
    step = gapbeam.solve({"beam": beam, "supports": supports, "loads": [{"type": "uniform", "q": 0.0}]}).steps[-1]
    assert step.solves < 10_000
    assert np.all(step.reaction >= 0.0)
    assert np.all(step.opening >= -1e-15)


def test_without_loads_a_beam_rests_off_all_its_supports():
    """Random lacks of fit: pressed onto them by weak springs it was given up after seconds, though nothing acts at all."""
    rng = np.random.default_rng(0)
    supports = {"node": np.arange(801), "side": "below", "gap": rng.uniform(-0.02, 0.02, 801)}
    made = {"beam": {"spans": rng.uniform(3.0, 8.0, 800).tolist(), "EI": 1e4}, "supports": supports, "loads": []}
    step = gapbeam.solve(made).steps[-1]
    assert step.indifferent
    assert not step.reaction.any()
    assert step.opening.min() > 0.0
    assert step.solves < 2_000
