"""Certificates of many cases: bounds hold, are those of single cases or near them, and are said not to be where there are none."""

import random

import gapbeam
import numpy as np
import oracle
import pytest
from mpmath import mpf
from scenes import at, force, random_scene, scene, uniform

KINDS = ("deflection", "rotation", "moment", "shear")


def random_cases(seed):
    """Draw a beam that anything may be at, and its cases with loads of either sign."""
    rng = random.Random(seed)
    made = random_scene(rng, held=rng.choice((True, None)))
    made["analysis"] = {}
    beam = gapbeam.prepare(made)
    factors = [[rng.choice((-1.0, 0.5, 1.0, 1.5)) for _ in made["loads"]] for _ in range(3)]
    return made, beam, beam.solve(factors), factors


def loads_times(made, factors):
    """Take factors, by which nothing is rounded, into the loads of a scene."""
    loads = [dict(load) for load in made["loads"]]
    for load, factor in zip(loads, factors, strict=True):
        for name in {"q", "F", "M", "kappa"} & load.keys():
            load[name] = (np.array(load[name]) * factor).tolist()
    return {**made, "loads": loads}


@pytest.mark.parametrize("block", range(3))
def test_bounds_hold(block):
    compared = 0
    for seed in range(1000 * block, 1000 * block + 15):
        made, beam, cases, factors = random_cases(seed)
        bounds = cases.error_bounds()
        exact = oracle.solve(loads_times(made, factors[0]))
        if exact.status != "solved" or cases.status[0]:
            continue
        compared += 1
        length = sum(made["beam"]["spans"])
        places = [x for x in (length * (k + 0.4937) / 8 for k in range(8)) if np.abs(beam.node_x - x).min() > 1e-9]
        found = cases.at(places)
        for kind in KINDS:
            true = [getattr(exact.at(x), kind) for x in places]
            error = max(abs(float(a - mpf(float(b)))) for a, b in zip(true, getattr(found, kind)[0], strict=True))
            assert error <= bounds[kind][0], (seed, kind)
        true = [mpf(exact.reaction[k]) for k in beam.supports]
        error = max(abs(float(a - mpf(float(b)))) for a, b in zip(true, cases.reaction[0], strict=True))
        assert error <= bounds["reaction"][0], seed
    assert compared > 8


def test_beside_single_certificates():
    """Residuals are small; bounds are never much smaller, and mostly less than 5 times as large."""
    ratios = []
    for seed in range(60):
        _, beam, cases, factors = random_cases(seed)
        several = cases.certificate()
        for i in range(3):
            if cases.status[i]:
                assert all(np.isnan(values[i]) for values in several.values())
                continue
            one = beam.result(factors[i]).steps[-1].certificate
            assert {name: value is None for name, value in one.items()} == {n: bool(np.isnan(v[i])) for n, v in several.items()}
            for name in ("equilibrium", "compatibility"):
                assert several[name][i] <= one[name] + 1e-15
            assert several["complementarity"][i] <= one["complementarity"] + 1e-15
            # Where all forces are zero but for rounding, their relative errors are anything
            bounds = {name: value for name, value in one.items() if name.startswith("error_")}
            ratios += [several[name][i] / value for name, value in bounds.items() if value and value < 1e-6]
    assert np.quantile(ratios, 0.01) > 0.5
    assert np.median(ratios) < 5
    assert np.quantile(ratios, 0.99) < 50


SPANS = {"spans": [4.0, 5.0, 3.0], "EI": 2e4}
RIGHT = [at(1, side="below"), at(2), at(3)]
OTHERS = {
    "one span": scene([4.0], [at(0, rotation="fixed"), at(1, side="below")], [uniform(2.0)]),
    "law": scene([4.0, 5.0, 3.0], [at(0), {"node": 1, "law": [[0.001, 4.0], [0.01, 8.0]]}, at(3)], [uniform(2.0)]),
    "ground": {"beam": SPANS, "foundation": [{"k": 500.0}], "loads": [uniform(2.0), force(3.0, 9.0)]},
    "two at a place": scene([4.0, 5.0, 3.0], [at(0), *RIGHT, at(1, side="above", gap=0.001)], [uniform(2.0)]),
}  # fmt: skip


@pytest.mark.parametrize("made", OTHERS.values(), ids=OTHERS)
def test_beams_that_go_alone(made):
    """One by one the certificates are those of single cases, but for the last digits of their numbers."""
    beam = gapbeam.prepare(made)
    factors = np.array([[1.0], [1.5]]) * np.ones(len(made["loads"]))
    several = beam.solve(factors).error_bounds()
    for i in range(2):
        one = beam.result(factors[i]).steps[-1].error_bounds
        for name, value in one.items():
            assert value / 2 <= several[name][i] <= 2 * value


def test_numbers_by_case_and_what_was_wanted():
    beam = gapbeam.prepare(scene([4.0, 5.0, 3.0], [at(0), *RIGHT], [uniform(2.0), force(2.0, 5.0)]))
    gaps = {1: [0.0, 0.001, 0.02]}
    cases = beam.solve([1.0, 2.0], gap=gaps, want="reaction")
    bounds = cases.error_bounds()
    assert bounds["moment"].shape == (3,)
    for i, gap in enumerate(gaps[1]):
        one = beam.solve([1.0, 2.0], gap={1: gap})
        assert {name: value.item() for name, value in one.error_bounds().items()} == {n: v[i] for n, v in bounds.items()}
    softer = beam.solve([1.0, 2.0], EI={0: [1e4, 2e4]}).error_bounds()
    assert (softer["moment"] > 0.0).all()
    assert (softer["moment"] < 1e-11).all()


def test_not_solved_and_free_to_move():
    made = scene([2.0, 2.0, 1.0], [at(0, side="below"), at(2, side="below")], [force(1.0, 4.0)], hinges=[4.5])
    cases = gapbeam.prepare(made).solve([[1.0], [-1.0]])
    assert cases.status.tolist() == [0, 1]
    bounds, certificate = cases.error_bounds(), cases.certificate()
    assert np.isnan([bounds["deflection"], bounds["rotation"], certificate["error_bound"]]).all()
    assert np.isfinite(bounds["reaction"]).tolist() == [True, False]
    assert not gapbeam.prepare(made).solve(np.zeros((0, 1))).certificate()["error_bound"].size
