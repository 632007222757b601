"""The true values of the studies: the displacement method in decimals beside exact fractions of the mixed method."""

import numpy as np
import pytest
from gapbeam.scene import read_scene
from gapbeam.studies.exact import Reference
from gapbeam.studies.meshes import MeshedBeam, Unfit, gapped_spans, mesh, one_span
from gapbeam.studies.truth import error, solve_exactly, solve_one_span
from studies.schemes import paper_beam, sprung_base

CLAMPED = {
    "beam": {"spans": [2.0, 3.0], "EI": [4.0, 7.0]},
    "supports": [
        {"node": 0, "rotation": "fixed", "settlement": 0.01},
        {"x": 1.25, "side": "above", "gap": 0.02},
        {"node": 2, "rotation": "fixed"},
    ],
    "loads": [{"type": "uniform", "q": 3.0, "from": 0.5, "to": 4.0}, {"type": "force", "x": 2.75, "F": -20.0}],
    "sections": [{"from": 1.0, "to": 2.5, "EI": 11.0}],
}
SCENES = {
    "paper": paper_beam(("above", "below", "below")),
    "gaps": gapped_spans(10),
    "springs": sprung_base(20),
    "clamped": CLAMPED,
}


@pytest.mark.parametrize("name", SCENES)
def test_decimals_agree_with_fractions(name):
    """Two methods and two ways to read the scene; cut in two, the middles of the stretches are common to both."""
    scene = read_scene(SCENES[name])
    beam = mesh(scene, 2)
    truth = solve_exactly(beam)
    reference, supported = Reference(scene), np.flatnonzero(beam.stiffness)
    assert reference.solve(["closed" if closed else "open" for closed in truth.closed[supported]])
    node = {x: i for i, x in enumerate(beam.x.tolist())}
    shared = [(k, node[x]) for k, x in enumerate(reference.x) if x in node]
    assert len(shared) > len(scene.beam.spans)
    moments = [*reference.moment_right[:-1], reference.moment_left[-1]]
    for exact, true in ((reference.deflection, truth.deflection), (moments, truth.moment)):
        nodes = np.array([i for _, i in shared])
        assert error([float(exact[k]) for k, _ in shared], (true[0][nodes], true[1][nodes])) < 2e-15
    assert error([float(r) for r in reference.reaction], truth.reaction, supported) < 2e-15


def test_closed_form_of_one_span():
    beam = one_span(30)
    exact, closed = solve_exactly(beam), solve_one_span(beam)
    for name in ("deflection", "moment", "reaction"):
        assert error(getattr(closed, name)[0], getattr(exact, name)) < 2e-16


def test_digits_do_not_run_out():
    """The same beam as two and as ten thousand elements."""
    fine, coarse = one_span(10_000), one_span(2)
    coarse.length *= 5000.0
    middle = solve_exactly(coarse).deflection[0][1]
    assert solve_exactly(fine).deflection[0][5000] == middle


def test_wrong_scheme_is_mended():
    beam = mesh(gapped_spans(10), 1)
    right = solve_exactly(beam)
    wrong = solve_exactly(beam, np.where(beam.side == 0, beam.stiffness > 0.0, ~right.closed))
    assert not wrong.right
    assert np.array_equal(wrong.closed, right.closed)
    assert solve_exactly(beam, right.closed).right


def test_mechanism():
    beam = MeshedBeam("free", np.ones(2), np.ones(2), np.ones(2), np.zeros(3))
    with pytest.raises(ArithmeticError, match="mechanism"):
        solve_exactly(beam)


def test_error_of_numbers_that_are_none():
    true = (np.ones(2), np.zeros(2))
    assert error(np.array([np.nan, 1.0]), true) == np.inf
    assert error(np.array([1.0, 1.5]), true) == 0.5


HINGED = {"beam": {"spans": [1.0, 1.0], "EI": 1.0, "hinges": [1.5]}, "supports": [{"node": 0}, {"node": 1}, {"node": 2}]}


@pytest.mark.parametrize(
    ("change", "what"),
    [
        ({}, "hinges"),
        ({"beam": {"spans": [1.0, 1.0], "EI": 1.0, "GA": 3.0}}, "shear flexibility"),
        ({"beam": {"spans": [1.0, 1.0], "EI": [1.0, float("inf")]}}, "a rigid stretch"),
        ({"beam": {"spans": [1.0, 1.0], "EI": 1.0}, "loads": [{"type": "moment", "x": 0.5, "M": 1.0}]}, "loads other than"),
        ({"beam": {"spans": [1.0, 1.0], "EI": 1.0}, "supports": [{"node": 1, "rotation": "fixed"}]}, "rotational support"),
        ({"beam": {"spans": [2.0], "EI": 1.0}, "supports": [{"node": 0, "rotation": 5.0}]}, "rotational support"),
        (
            {"beam": {"spans": [2.0], "EI": 1.0}, "supports": [{"x": 1.0, "side": s, "gap": 0.1} for s in ("below", "above")]},
            "two supports",
        ),
    ],
)
def test_what_does_not_fit_is_named(change, what):
    with pytest.raises(Unfit, match=what):
        mesh({**HINGED, **change}, 1)
