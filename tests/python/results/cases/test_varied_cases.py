"""Stiffnesses of spans and moduli of foundations by case, against scenes of their own."""

import random

import gapbeam
import numpy as np
import pytest
from scenes import at, force, random_scene, scene, uniform


def direct(made, row, changes):
    """The scene of one case, prepared for itself."""
    beam = {**made["beam"], **{key: list(map(float, values)) for key, values in changes.items() if key in ("EI", "GA")}}
    return gapbeam.prepare({**made, "beam": beam}).solve(row)


def agrees(cases, k, one, scale, tolerance=1e-11):
    """Whether a row is a case solved for itself."""
    assert cases.status[k] == one.status
    for name in ("reaction", "deflection", "moment_left", "moment_right"):
        a, b = getattr(cases, name)[k], getattr(one, name)
        size = np.abs(b[np.isfinite(b)]).max(initial=scale if name != "deflection" else 1e-9)
        assert a == pytest.approx(b, rel=tolerance, abs=tolerance * size, nan_ok=True), name


def test_stiffnesses_of_spans_by_case():
    solved = 0
    for seed in range(40):
        rng = random.Random(seed)
        made = random_scene(rng, held=rng.choice((True, None)))
        made["analysis"] = {}
        beam, spans = gapbeam.prepare(made), len(made["beam"]["spans"])
        draw = np.random.default_rng(seed)
        rows = draw.choice((0.0, 1.0, -1.0, 3.0), (4, len(made["loads"])))
        base = np.broadcast_to(made["beam"]["EI"], spans)
        given = {"EI": base * draw.choice((0.5, 1.0, 3.0), (4, spans))}
        if seed % 2:
            given["GA"] = draw.choice((1e3, 1e5, np.inf), (4, spans))
        cases = beam.solve(rows, **given)
        full, moments, extremes = beam.result, cases.at([0.3]).moment, cases._pairs_of_extremes()
        for k, row in enumerate(rows):
            changes = {key: values[k] for key, values in given.items()}
            one = direct(made, row, changes)
            agrees(cases, k, one, np.abs(row).max(initial=1e-9), 1e-9)
            if one.status == 0:
                solved += 1
                for name, values in one._pairs_of_extremes().items():
                    size = max(abs(value) for value, _ in values.values())
                    for kind, (value, _) in values.items():
                        assert extremes[name][kind][0][k] == pytest.approx(value, rel=1e-9, abs=1e-9 * size), name
                result = full(row, **changes)
                assert changes["EI"].tolist() == result.scene.beam.EI
                assert moments[k] == pytest.approx(result.at([0.3]).moment, rel=1e-9, abs=1e-9)
    assert solved > 80


def test_moduli_of_foundations_by_case():
    made = scene([4.0, 4.0], [at(0), at(1, side="below", gap=0.01)], [uniform(3.0), force(6.0, 10.0)], EI=500.0)
    made["foundation"] = [{"k": 40.0, "side": "below", "to": 5.0, "name": "clay"}, {"k": 90.0, "from": 5.0}]
    beam = gapbeam.prepare(made)
    rows = [[1.0, 1.0], [1.0, -2.0], [0.5, 3.0]]
    moduli = [20.0, 60.0, 400.0]
    cases = beam.solve(rows, k={"clay": moduli}, EI={"1": [300.0, 500.0, 900.0]}, gap={1: 0.02})
    for k, row in enumerate(rows):
        own = {**made, "foundation": [{**made["foundation"][0], "k": moduli[k]}, made["foundation"][1]]}
        own["beam"] = {**made["beam"], "EI": [500.0, [300.0, 500.0, 900.0][k]]}
        own["supports"] = [at(0), at(1, side="below", gap=0.02)]
        one = gapbeam.prepare(own).result(row)
        assert cases.reaction[k] == pytest.approx(one.steps[-1].reaction, rel=1e-11)
        assert cases.at(3.0).moment[k] == pytest.approx(float(one.at(3.0).moment), rel=1e-10)
        same = beam.result(row, k={"clay": moduli[k]}, EI=[500.0, [300.0, 500.0, 900.0][k]], gap={1: 0.02})
        assert same.scene.foundation[0].k == moduli[k]
        assert same.steps[-1].reaction == pytest.approx(one.steps[-1].reaction, rel=1e-13)
        pressure = cases.extremes["pressure"]["max"].value[k]
        assert pressure == pytest.approx(one.extremes["pressure"]["max"].value, rel=1e-10)


def test_what_cannot_vary():
    made = scene([1.0, 1.0], [at(0), at(1), at(2)], [uniform(1.0)])
    made["foundation"] = [
        {"k": 5.0, "to": 0.5, "name": "clay"}, {"k": [5.0, 6.0], "from": 0.5, "to": 1.0}, {"law": [[0.1, 2.0]], "from": 1.0}
    ]  # fmt: skip
    beam = gapbeam.prepare(made)
    for given, words in (
        ({"EI": [[1.0, 1.0], [1.0, -2.0]]}, r"case 1, beam\.EI\[1\]: expected a number above 0, inf is rigid; got -2"),
        ({"EI": {0: [1.0, np.nan]}}, r"case 1, beam\.EI\[0\]: expected a number above 0, inf is rigid; got nan"),
        ({"GA": {1: 0.0}}, r"case 0, beam\.GA\[1\]: expected a number above 0"),
        ({"EI": {2: 1.0}}, r"EI\.2: there is no span 2; their numbers go from 0 to 1"),
        ({"EI": {"left": 1.0}}, r'EI\.left: there is no span "left"; no span has a name; give its number'),
        ({"EI": [1.0, 1.0, 1.0]}, r"EI: expected 2 numbers, one for each span, or 1 row of them, one a case; got shape \(3,\)"),
        ({"k": {"clay": [1.0, 0.0]}}, r'case 1, foundation "clay"\.k: expected a finite number above 0; got 0'),
        ({"k": {0: np.inf}}, r'case 0, foundation "clay"\.k: expected a finite number above 0; got inf'),
        ({"k": {1: 2.0}}, r"case 0, foundation\[1\]\.k: the prepared scene has a pair here"),
        ({"k": {2: 2.0}}, r"case 0, foundation\[2\]\.k: it has a law instead of a modulus; leave it out"),
        ({"k": {"sand": 2.0}}, r'k\.sand: there is no foundation "sand"; the names are "clay"'),
    ):
        with pytest.raises(ValueError, match=words):
            beam.solve(**given)


def test_a_case_out_of_range_is_recorded():
    beam = gapbeam.prepare(scene([1.0, 1.0], [at(0), at(1), at(2)], [uniform(1.0)]))
    cases = beam.solve(EI={0: [1.0, 1e-300, 2.0], 1: [1.0, 1e300, 2.0]})
    assert cases.status.tolist() == [0, gapbeam.Status.NOT_FINITE, 0]
    assert np.array_equal(cases.reaction[2], beam.solve(EI=[2.0, 2.0]).reaction)


@pytest.mark.parametrize("given", [{"settlement": {0: 0.02}}, {"gap": {1: 0.02}}, {"EI": [2e4, 2e4]}])
def test_a_case_on_a_curve_has_a_result_on_the_curve(given):
    law = {"type": "tanh", "stiffness": 1e3, "limit": 50.0}
    beam = gapbeam.prepare(scene([6.0, 6.0], [at(0), at(1, side="below", law=law), at(2)], [uniform(20.0)], EI=1e4))
    case = beam.solve([1.0], **given)
    step = case.result().steps[-1]
    assert step.exact
    assert step.reaction == pytest.approx(case.reaction, rel=1e-13)
    deflection = step.deflection[1] - given.get("gap", {1: 0.0})[1]
    assert step.reaction[1] == pytest.approx(50.0 * np.tanh(1e3 * deflection / 50.0), rel=1e-13)
