"""Cases of beams with an axial force that bending feels, or on ground: sums of responses beside each case solved alone."""

import pickle
import random

import gapbeam
import numpy as np
import pytest
from gapbeam.base.errors import Status

CASES = 150
NAMES = ("reaction", "deflection", "moment_left", "moment_right")


def drawn(seed):
    """A beam with one-sided supports under an axial force given or of a load, or on ground that holds both ways."""
    draw = random.Random(seed)
    n, kind = draw.randint(1, 10), draw.choice(["N", "N", "pressed", "ground", "axial"])
    spans, EI = [draw.choice([1.0, 2.0, 3.5, 6.0]) for _ in range(n)], 10 ** draw.uniform(-1, 4)
    scene = {"beam": {"spans": spans, "EI": EI}, "supports": [], "loads": []}
    if kind in ("N", "pressed"):
        sign = 1.0 if kind == "N" else -0.02
        scene["beam"]["N"] = sign * 10 ** draw.uniform(-3, 2) * EI / sum(spans) ** 2
    for k in range(n + 1):
        if draw.random() < 0.85 or k in (0, n):
            support = {"node": k, "side": draw.choice(["below", "below", "above", "both"])}
            if support["side"] != "both":
                support["gap"] = draw.choice([0.0, 0.0, 0.001, 0.01])
            if draw.random() < 0.5:
                support["stiffness"] = 10 ** draw.uniform(0, 5)
            if draw.random() < 0.2:
                support["settlement"] = draw.uniform(-0.01, 0.01)
            scene["supports"].append(support)
    if kind == "ground":
        scene["foundation"] = [{"to": sum(spans) * draw.choice([1.0, 0.5]), "k": 10 ** draw.uniform(-1, 3), "side": "both"}]
    for _ in range(draw.randint(1, 4)):
        if draw.random() < 0.5:
            left, right = sorted(draw.uniform(0.0, sum(spans)) for _ in "ab")
            scene["loads"].append({"type": "uniform", "q": draw.uniform(-5.0, 20.0), "from": left, "to": right})
        else:
            scene["loads"].append({"type": "force", "x": draw.uniform(0.0, sum(spans)), "F": draw.uniform(-30.0, 80.0)})
    if kind == "axial":
        scene["supports"].append({"node": 0, "direction": "axial"})
        push = 10 ** draw.uniform(-2, 2) * EI / max(spans) ** 2
        scene["loads"].append({"type": "axial", "node": n, "F": draw.choice([1.0, 1.0, -0.01]) * push})
    rows = np.random.default_rng(seed).normal(1.0, 1.0, (CASES, len(scene["loads"])))
    if draw.random() < 0.5:
        rows = np.round(2.0 * rows) / 2.0  # ties
    if kind == "axial":
        rows[:, -1] = 1.0
    return scene, rows


def largest(cases, name, k=None):
    values = [getattr(cases, one) for one in NAMES if one.startswith(name.split("_")[0])]
    return max((np.abs(one if k is None else one[k]).max(initial=0.0) for one in values), default=0.0)


def test_sums_of_responses():
    """Those of many cases, in the scheme of each, and what is asked of them later."""
    sums = total = 0
    for seed in range(60):
        scene, rows = drawn(seed)
        prepared = gapbeam.prepare(scene)
        prepared.solve(rows)
        cases = prepared.solve(rows)
        sums, total = sums + int((cases.solves == 0).sum()), total + CASES
        for k in range(0, CASES, 9):
            alone = prepared.solve(rows[k])
            assert alone.status == cases.status[k], (seed, k)
            if alone.status != Status.SOLVED:
                continue
            assert alone.closed.tolist() == cases.closed[k].tolist()
            for name in NAMES:
                difference = np.abs(getattr(alone, name) - getattr(cases, name)[k]).max(initial=0.0)
                assert difference <= 2e-14 * largest(alone, name), (seed, k, name)
    assert sums > 0.5 * total


def test_what_is_asked_later():
    scene, rows = drawn(3)
    cases = gapbeam.prepare(scene).solve(rows[:20])
    again = pickle.loads(pickle.dumps(cases))
    values, places = cases._pairs_of_extremes()["moment"]["max"]
    for k in (0, 7, 19):
        if cases.status[k] == Status.SOLVED:
            result = cases.result(k)
            assert values[k] == pytest.approx(result.extremes["moment"]["max"].value, rel=1e-12)
            assert cases[k].at(0.5).moment == pytest.approx(result.at(0.5).moment, rel=1e-12)
            assert again[k : k + 1].extremes["moment"]["max"].value[0] == values[k]
    assert places.shape == (20,)


def test_other_supports_and_moduli():
    """Cases in which these vary are no sums."""
    scene = {"beam": {"spans": [4.0, 4.0], "EI": 100.0, "N": 30.0}, "supports": [{"node": k, "side": "below"} for k in range(3)],
             "foundation": [{"k": 50.0, "name": "clay"}], "loads": [{"type": "uniform", "q": 1.0}]}  # fmt: skip
    prepared = gapbeam.prepare(scene)
    gaps = prepared.solve([1.0], gap={1: [0.0, 0.01, 0.02]})
    moduli = prepared.solve([1.0], k=[[50.0], [80.0]])
    assert gaps.reaction[0] == pytest.approx(prepared.solve([1.0]).reaction, rel=1e-14)
    assert moduli.reaction[0] == pytest.approx(gaps.reaction[0], rel=1e-14)
    for k, gap in enumerate((0.0, 0.01, 0.02)):
        scene["supports"][1]["gap"] = gap
        assert gaps.reaction[k] == pytest.approx([step.reaction for step in gapbeam.solve(scene).steps][-1], rel=1e-13)
    assert (gaps.solves > 0).all()


def test_axial_loads_by_case():
    """Some with the axial force of the first case, some with others, in any order."""
    scene = {"beam": {"spans": [4.0, 4.0], "EI": 100.0}, "supports": [{"node": k, "side": "below"} for k in range(3)],
             "loads": [{"type": "uniform", "q": 1.0, "to": 4.0}, {"type": "axial", "node": 2, "F": 20.0}]}  # fmt: skip
    scene["supports"].append({"node": 0, "direction": "axial"})
    prepared = gapbeam.prepare(scene)
    rows = np.array([[1.0 + 0.1 * k, 2.0 if k % 3 == 2 else 1.0] for k in range(30)])
    cases = prepared.solve(rows)
    assert (cases.solves == 0).sum() == 17  # of 20 beside those by which the responses came
    given = {"beam": {**scene["beam"], "N": 40.0}, "supports": scene["supports"][:3], "loads": scene["loads"][:1]}
    given = gapbeam.prepare(given)
    assert cases.reaction[2::3] == pytest.approx(given.solve(rows[2::3, :1]).reaction, rel=1e-13)
    turned = prepared.solve(rows[::-1])
    assert turned.reaction == pytest.approx(cases.reaction[::-1], rel=1e-13)


def test_a_compressed_beam_that_buckles():
    """Its cases are recorded, and the others go on."""
    column = {"beam": {"spans": [1.0], "EI": 1.0}, "supports": [{"node": 0}, {"node": 1}, {"node": 0, "direction": "axial"}],
              "loads": [{"type": "uniform", "q": 1.0}, {"type": "axial", "node": 1, "F": -1.0}]}  # fmt: skip
    cases = gapbeam.prepare(column).solve([[1.0, 9.0], [1.0, 11.0], [2.0, 9.0]])
    assert cases.status.tolist() == [Status.SOLVED, Status.BUCKLES, Status.SOLVED]
    assert cases.deflection[2].max() == pytest.approx(2.0 * cases.deflection[0].max(), rel=1e-14)
