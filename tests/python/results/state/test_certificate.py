"""Certificates: the error bound holds and is not wasteful; what precision cannot decide is named; free positions are said."""

import random

import gapbeam
import numpy as np
import oracle
import pytest
from mpmath import mpf
from scenes import INF, at, force, random_scene, scene, stretch, uniform

PIVOTING = 2  # of Solution.method


def true_errors(made, step, supports):
    """Largest errors of deflections at supports and of reactions, and the largest values."""
    exact = oracle.solve(made)
    if exact.status != "solved":
        return None
    errors = []
    for name in ("deflection", "reaction"):
        true, found = getattr(exact, name), getattr(step, name)
        errors.append(max((abs(float(mpf(true[k]) - mpf(float(found[k])))) for k in supports), default=0.0))
    return errors


@pytest.mark.parametrize("block", range(8))
def test_bound_holds_and_is_not_wasteful(block):
    compared = 0
    for seed in range(1000 * block, 1000 * block + 60):
        rng = random.Random(seed)
        made = random_scene(rng, held=rng.choice((True, None)))
        made["analysis"] = {}
        result = gapbeam.solve(made)
        if result.status != "solved" or result.steps[-1].indifferent:
            continue
        step = result.steps[-1]
        errors = true_errors(made, step, result._beam.numbers)
        if errors is None:
            continue
        compared += 1
        sizes = (np.abs(step.solution.deflection).max(), np.abs(step.reaction).max(initial=0.0))
        for error, bound, size in zip(errors, step.bounds, sizes, strict=True):
            assert error <= bound, seed
            if size > 1e-9 and error > 1e-14 * size:
                assert bound <= 1000 * error, seed
    assert compared > 20


@pytest.mark.parametrize("seed", [110, 410, 601])
def test_places_and_loads_that_are_rounded(seed):
    """A place near a rounded end of a span; loads that springs alone carry; a short soft stretch beside a rigid one."""
    rng = random.Random(seed)
    made = random_scene(rng, held=rng.choice((True, None)))
    made["analysis"] = {}
    result, exact = gapbeam.solve(made), oracle.solve(made)
    step = result.steps[-1]
    errors = true_errors(made, step, result._beam.numbers)
    assert all(error <= bound for error, bound in zip(errors, step.bounds, strict=True))
    places = [sum(made["beam"]["spans"]) * (k + 0.4937) / 11 for k in range(11)]
    found = result.at(places)
    for kind in ("deflection", "rotation", "moment", "shear"):
        true = [getattr(exact.at(x), kind) for x in places]
        error = max(abs(float(a - mpf(float(b)))) for a, b in zip(true, getattr(found, kind), strict=True))
        assert error <= step.error_bounds[kind], kind


def test_stiff_and_soft_together():
    """Bounds grow where the problem itself is badly conditioned, and still hold."""
    supports = [at(0, stiffness=1e-9), at(1, stiffness=1e12), at(2, stiffness=1e-9)]
    made = scene([1.0, 1.0], supports, [force(0.5, 1.0), force(1.7, -0.3)], EI=1e3)
    result = gapbeam.solve(made)
    errors = true_errors(made, result.steps[-1], range(3))
    assert all(error <= bound for error, bound in zip(errors, result.steps[-1].bounds, strict=True))


LOST = {
    "between two stops": scene(
        [1.625],
        [at(1, side="below", gap=0.00394, settlement=0.00659), at(0, side="below", gap=0.00462, stiffness=4.11e9),
         at(1, side="above", gap=0.00899, settlement=0.00659)],
        [uniform(-11.7), force(0.40625, 23.1), {"type": "linear", "q": [-4.06, 3.86], "case": "dead"}], EI=1.87e10),
    "a short stiff end": scene(
        [0.0390625, 30.0, 0.15625],
        [at(1, side="above", gap=4460.0), at(0, side="below", gap=-0.0589), at(3, side="below", gap=9.25e6, stiffness=1170.0),
         at(2, stiffness=3.22e-5)],
        [uniform(-318.0, **stretch(0.0390625, 30.1953125)), force(30.0390625, 2.08e6),
         uniform(2430.0, **stretch(30.0390625, 30.1953125))], EI=1270.0, GA=[INF, 103.0, INF]),
}  # fmt: skip


@pytest.mark.parametrize("made", LOST.values(), ids=LOST)
def test_what_elimination_loses_is_in_the_bounds(made):
    """The errors are many times what the last digits of the data move: bounds by those alone are below them."""
    step = gapbeam.solve(made).steps[-1]
    errors = true_errors(made, step, range(len(made["supports"])))
    assert all(error <= bound for error, bound in zip(errors, step.bounds, strict=True))


def test_bound_where_pivoting_is_needed():
    """Rigid stretches beside clamps and rigid supports: LAPACK solves them, and the bound holds as well."""
    compared = 0
    for seed in range(400):
        rng = random.Random(seed)
        spans = [1.3] * rng.randint(2, 5)
        EI = [rng.choice((1.0, 7.0, INF, INF)) for _ in spans]
        kinds = ({}, {}, {"stiffness": rng.choice((0.3, 50.0))}, {"rotation": "fixed"}, None, None)
        supports = [at(i, **kind) for i in range(len(spans) + 1) if (kind := rng.choice(kinds)) is not None]
        made = scene(spans, supports, [uniform(1.7), force(rng.uniform(0.0, 2.5), 3.3)], EI=EI)
        try:
            step = gapbeam.solve(made).steps[-1]
        except (gapbeam.EngineError, IndexError):
            continue
        if step.solution.method != PIVOTING:
            continue
        compared += 1
        errors = true_errors(made, step, range(len(supports)))
        sizes = (np.abs(step.solution.deflection).max(), np.abs(step.reaction).max(initial=0.0))
        for error, bound, size in zip(errors, step.bounds, sizes, strict=True):
            assert error <= bound <= 1e-9 * size, seed
    assert compared > 20


def test_tie_is_named():
    """Reference P6: both deflections equal their gaps exactly, so neither contact is decided."""
    supports = [
        at(0),
        at(1, side="below", stiffness=1e5, gap=0.015),
        at(2, side="below", stiffness=1e6, gap=0.010),
        at(3),
    ]
    result = gapbeam.solve(scene([1.0, 1.0, 1.0], supports, [force(1.0, 60.0), force(2.0, -30.0)], EI=1000.0))
    assert result.steps[-1].undecided == (1, 2)
    assert result.to_dict()["steps"][-1]["undecided"] == [1, 2]


def test_clear_cases_are_not_named():
    supports = [at(i, side="below") for i in range(3)]
    loads = [uniform(1.0, case="dead"), {**uniform(10.0), "to": 1.0}]
    assert gapbeam.solve(scene([1.0, 1.0], supports, loads)).steps[-1].undecided == ()


LOADS = [uniform(3.0, case="dead"), force(15.0, 40.0), force(3.0, -60.0)]


@pytest.mark.parametrize("soft", [{"law": {"type": "tanh", "stiffness": 5e4, "limit": 30.0}}, {"stiffness": 1e-60}])
def test_a_spring_that_holds_nothing_spoils_no_bound(soft):
    """A law at its limit has a slope of 1e-65; the beam is held by the other supports, and its bounds are theirs."""
    one_sided = [at(1, side="below", stiffness=5e4, gap=0.004), at(2, side="below", stiffness=5e4)]
    supports = [at(0), *one_sided, {"node": 3, **soft}, at(4)]
    result = gapbeam.solve(scene([6.0] * 4, supports, LOADS, EI=12e3))
    step = result.steps[-1]
    assert step.certificate["error_bound"] < 1e-11
    assert step.undecided == ()
    assert step.opening[1] > 0.05
    assert f"{step.deflection[3]:.5g}" in result.report()


def test_indifferent_position():
    """A part without load on a hinge can turn freely; the forces elsewhere are unique."""
    made = scene([2.0, 2.0, 1.0], [at(0), at(2)], [force(1.0, 4.0)], hinges=[4.5])
    step = gapbeam.solve(made).steps[-1]
    assert step.indifferent
    assert step.bounds[0] is None
    assert step.certificate["error_bound"] is step.certificate["error_bound_deflection"] is None
    assert np.abs(step.reaction - [3.0, 1.0]).max() <= step.bounds[1] < 1e-10


def test_no_supports_at_all():
    result = gapbeam.solve(scene([2.0], [], [uniform(1.0)]))
    assert result.status == "no-equilibrium"
    assert "moves down as a whole" in result.reason
    assert result.motion == [(0.0, 1.0), (2.0, 1.0)]
