"""The compiled yardsticks of the studies: each as accurate as it is said to be, and failing where it is said to fail."""

import numpy as np
import pytest
from gapbeam.studies.meshes import (
    MeshedBeam,
    gapped_spans,
    many_spans,
    mesh,
    one_span,
    soft_and_stiff,
    stiffness_jumps,
)
from gapbeam.studies.methods import methods, yardstick
from gapbeam.studies.truth import error, solve_exactly
from studies.schemes import paper_beam, sprung_base

METHODS = {method.name: method for method in methods() if "solve" not in method.name}
MIXED = [name for name in METHODS if "displacement" not in name]
REFINED = ["condensed mixed", "nodal mixed + 1 dd", "dgbsv + 2"]


def propped():
    """Clamps, settlement, a gap that closes at a rigid support, one that stays open, a spring and a free end."""
    length = np.array([0.7, 1.1, 0.4, 0.9, 1.3, 0.6])
    stiffness = np.array([np.inf, 0.0, np.inf, 50.0, np.inf, 0.0, 0.0])
    side = np.array([0, 0, 1, -1, 1, 0, 0], np.int32)
    level = np.array([0.01, 0.0, 0.02, -0.5, 0.004, 0.0, 0.0])
    force = np.array([0.0, 3.0, 0.0, 0.0, 0.0, 1.0, 2.0])
    return MeshedBeam(
        "propped", length, 40.0 + 10.0 * length, 2.0 * length, stiffness, side, level, force, clamped=(True, False)
    )


def clamped_right():
    length = np.array([1.0, 0.6, 0.8])
    stiffness = np.array([0.0, 30.0, 0.0, np.inf])
    return MeshedBeam("clamped on the right", length, 5.0 * length, 1.0 - length, stiffness, clamped=(False, True))


BEAMS = {
    "one span": one_span(10),
    "many spans": many_spans(40),
    "jumps": stiffness_jumps(30),
    "springs": soft_and_stiff(40),
    "work A": mesh(gapped_spans(10), 4),
    "work B": mesh(sprung_base(20), 1),
    "paper": mesh(paper_beam(("above", "below", "below")), 3),
    "propped": propped(),
    "clamped right": clamped_right(),
}
TRUTHS = {name: solve_exactly(beam) for name, beam in BEAMS.items()}


def errors(method, beam, truth):
    answer = METHODS[method].run(beam, 1)
    assert not answer.failure
    pairs = ((answer.deflection, truth.deflection), (answer.moment, truth.moment), (answer.reaction, truth.reaction))
    return [error(values, true) for values, true in pairs if values is not None]


def same_state(method, beam, truth):
    return np.array_equal(METHODS[method].run(beam, 1).closed, truth.closed)


@pytest.mark.parametrize(("method", "beam"), [(m, b) for m in METHODS for b in BEAMS if METHODS[m].fits(BEAMS[b])])
def test_true_answers(method, beam):
    assert same_state(method, BEAMS[beam], TRUTHS[beam])
    largest = max(errors(method, BEAMS[beam], TRUTHS[beam]))
    assert largest < (1e-14 if method in REFINED else 1e-11 if method in MIXED else 1e-8)


@pytest.mark.parametrize("make", [one_span, stiffness_jumps])
def test_refinement_reaches_1e_14_on_fine_meshes(make):
    beam = make(4000)
    truth = solve_exactly(beam)
    plain = max(errors("dgbsv", beam, truth))
    assert plain > 1e-11
    for method in REFINED:
        assert max(errors(method, beam, truth)) < 1e-14
    assert max(errors("nodal mixed + 1", beam, truth)) < 1e-13
    assert max(errors("dgbsv + 1", beam, truth)) < plain / 1e3


def test_increments_mend_deflections_and_not_moments():
    """The displacement method at 4,000 elements: n**4 lost when plain, n**2 of the moments even with increments."""
    beam = one_span(4000)
    truth = solve_exactly(beam)
    plain = errors("displacement", beam, truth)
    deflection, moment, _ = errors("displacement, incremental", beam, truth)
    assert plain[0] > 1e-5
    assert deflection < 1e-12
    assert 1e-12 < moment < plain[1] / 1e3


def test_displacement_method_is_as_good_where_spans_are_short():
    beam = many_spans(4000)
    assert max(errors("displacement", beam, solve_exactly(beam))) < 1e-13


def test_kernel_fits_linear_beams_with_supported_ends():
    fits = {name for name, beam in BEAMS.items() if METHODS["fused kernel"].fits(beam)}
    assert fits == {"one span", "many spans", "jumps", "springs"}


@pytest.mark.parametrize("method", METHODS)
def test_mechanism_is_not_solved(method):
    beam = one_span(3)
    beam.stiffness = np.array([np.inf, 0.0, 0.0, 0.0])
    answer = METHODS[method].run(beam, 1)
    # Rounding may leave a pivot that is not zero; then the numbers are large, and that is what users of LAPACK get
    assert answer.failure == "singular" or np.abs(answer.deflection).max() > 1e10


def test_cycles_are_left():
    """Switching all wrong supports cycles on the paper's beam: after 40 solves one at a time is switched."""
    answer = METHODS["displacement"].run(BEAMS["paper"], 1)
    assert 40 < answer.solves < 50
    assert METHODS["condensed mixed"].run(BEAMS["paper"], 1).solves == 3


@pytest.mark.parametrize("number", [0, 1])
@pytest.mark.parametrize("precise", [False, True])
def test_both_residuals_refine_both_factors(number, precise):
    for name, beam in BEAMS.items():
        answer = yardstick("", number, 2, precise=precise).run(beam, 1)
        assert max(error(answer.deflection, TRUTHS[name].deflection), error(answer.moment, TRUTHS[name].moment)) < 2e-15


def test_repeats_do_not_change_the_answer():
    for method in METHODS.values():
        once, often = method.run(BEAMS["springs"], 1), method.run(BEAMS["springs"], 3)
        assert np.array_equal(once.deflection, often.deflection)
        assert np.array_equal(once.moment, often.moment)


def test_reactions_can_be_left_out():
    beam = BEAMS["many spans"]
    plain, without = yardstick("", 1).run(beam, 1), yardstick("", 1, reactions=False).run(beam, 1)
    assert np.array_equal(plain.moment, without.moment)
    assert np.any(plain.reaction)
    assert not np.any(without.reaction)
