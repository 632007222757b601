"""Imposed curvatures that are linear along a stretch: closed forms, and the exact solution in rational numbers."""

import random
import re
import subprocess
import sys
from pathlib import Path

import gapbeam
import numpy as np
import pytest
from gapbeam import SceneError
from gapbeam.cli import main
from gapbeam.studies.exact import Reference

CHECKERS = Path(__file__).resolve().parents[3] / "oracle" / "checkers"
L, K = 4.0, 0.012
SIMPLE = {"beam": {"spans": [L], "EI": 100.0}, "supports": [{"node": 0}, {"node": 1}],
          "loads": [{"type": "curvature", "kappa": [0.0, K]}]}  # fmt: skip


def test_simple_beam():
    """w = -K L^2/6 (t - t^3): no force, all fields and their extremes."""
    result, t = gapbeam.solve(SIMPLE), np.linspace(0.0, 1.0, 9)
    found = result.at(L * t)
    assert found.deflection == pytest.approx(-K * L**2 / 6 * (t - t**3), abs=1e-17)
    assert found.rotation == pytest.approx(-K * L / 6 * (1 - 3 * t**2), abs=1e-17)
    assert found.curvature == pytest.approx(-K * t, abs=1e-17)
    assert not found.moment.any()
    lowest = result.extremes["deflection"]["min"]
    assert (lowest.value, lowest.x) == pytest.approx((-K * L**2 / 6 * 2 / 27**0.5, L / 3**0.5), rel=1e-15)
    assert result.extremes["rotation"]["min"].value == pytest.approx(-K * L / 6, rel=1e-15)


def test_propped_cantilever():
    """M at the clamp is 3 EI/L times the rotation of its end that it undoes: K L/6."""
    supports = [{"node": 0, "rotation": "fixed"}, {"node": 1}]
    result = gapbeam.solve(SIMPLE | {"supports": supports})
    assert result.at([0.0, L / 2]).moment == pytest.approx([3 * 100.0 / L * K * L / 6, 1.5 * 100.0 / L * K * L / 6], rel=1e-14)


def beam_of(seed):
    rng = random.Random(seed)
    spans = [rng.uniform(1.0, 4.0) for _ in range(rng.randint(1, 3))]
    end, hinge = sum(spans), spans[0] * rng.uniform(0.3, 0.7)
    loads = [{"type": "uniform", "q": rng.uniform(-1.0, 3.0)}, {"type": "force", "x": rng.uniform(0.0, end), "F": 2.0}]
    for _ in range(rng.randint(1, 3)):
        a, b = sorted(rng.uniform(0.0, end) for _ in range(2))
        loads.append({"type": "curvature", "from": a, "to": b, "kappa": [rng.uniform(-0.1, 0.1), rng.uniform(-0.1, 0.1)]})
    return {
        "beam": {"spans": spans, "EI": [rng.choice([50.0, 200.0]) for _ in spans], "GA": rng.choice([np.inf, 80.0]),
                 "hinges": [hinge] if rng.random() < 0.4 and len(spans) > 1 else []},
        "supports": [{"node": k, "side": rng.choice(["both", "below"]) if 0 < k < len(spans) else "both",
                      "rotation": rng.choice(["free", "fixed", 30.0])} for k in range(len(spans) + 1)],
        "loads": loads,
    }  # fmt: skip


@pytest.mark.parametrize("seed", range(40))
def test_random_beams_beside_rationals(seed):
    scene = beam_of(seed)
    result = gapbeam.solve(scene)
    exact, step = Reference(result.scene), result.steps[-1]
    assert exact.solve(step.state)
    right = result.at(exact.x)
    scale = max(1e-3, max(abs(float(w)) for w in exact.deflection))
    assert np.abs(right.deflection - np.array(list(map(float, exact.deflection)))).max() <= 1e-13 * scale
    forces = np.array(list(map(float, exact.reaction)))
    assert np.abs(step.reaction - forces).max() <= 1e-13 * max(1.0, np.abs(forces).max())
    moments = np.array(list(map(float, exact.moment_right)))
    assert np.abs(right.moment - moments)[:-1].max() <= 1e-13 * max(1.0, np.abs(moments).max())
    assert max(step.error_bounds.values()) < 1e-11
    x = np.sort(np.concatenate([np.linspace(0.0, exact.x[-1], 2001), exact.x]))
    for quantity, there in result.extremes.items():
        for way, pick in (("max", np.max), ("min", np.min)):
            # Steps are found from both sides
            values = np.concatenate([getattr(result.at(x), quantity), getattr(result.at(x - 1e-12), quantity)])
            sampled, span = pick(values), np.ptp(values)
            beyond = there[way].value - sampled if way == "max" else sampled - there[way].value
            assert -1e-9 * (1.0 + span) <= beyond <= 1e-3 * span + 1e-9, (quantity, way)


@pytest.mark.parametrize("side", [None, "both", "below"])
def test_proofs_know_it(tmp_path, side):
    scene, proof = tmp_path / "scene.toml", tmp_path / "proof.json"
    made, checker = beam_of(3), "proof_checker.py"
    if side:
        made, checker = {**SIMPLE, "foundation": [{"k": 50.0, "side": side}]}, "proof_checker_ground.py"
    gapbeam.read_scene(made).to_toml(scene)
    assert main(["prove", str(scene), "-o", str(proof)]) == 0
    done = subprocess.run([sys.executable, CHECKERS / checker, proof], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout.split()[0]) == (0, "proved")


def test_combinations_cases_and_events():
    scene = beam_of(5)
    curved = [load | {"case": "tendons"} if load["type"] == "curvature" else load for load in scene["loads"]]
    scene = scene | {"loads": curved}
    factors = [(1.0, 1.0), (0.5, -2.0), (0.0, 1.0)]
    combined = [{"name": str(k), "factors": {"live": a, "tendons": b}} for k, (a, b) in enumerate(factors)]
    result = gapbeam.solve({**scene, "combinations": combined})
    many = gapbeam.prepare(scene).solve([[b if "kappa" in load else a for load in curved] for a, b in factors])
    for k, (a, b) in enumerate(factors):
        loads = [dict(load) for load in curved]
        for load in loads:
            for key in ("q", "F"):
                if key in load:
                    load[key] *= a
            if "kappa" in load:
                load["kappa"] = [b * one for one in load["kappa"]]
        one = gapbeam.solve({**scene, "loads": loads})
        other = result.combinations[str(k)]
        assert other.steps[-1].reaction == pytest.approx(one.steps[-1].reaction, abs=1e-13)
        assert many.reaction[k] == pytest.approx(one.steps[-1].reaction, abs=1e-13)
        for quantity in ("deflection", "moment"):
            value = one.extremes[quantity]["max"].value
            assert other.extremes[quantity]["max"].value == pytest.approx(value, rel=1e-12)
            assert many.extremes[quantity]["max"].value[k] == pytest.approx(value, rel=1e-12)
    path = gapbeam.solve({**scene, "analysis": {"follow": "events"}})
    assert path.steps[-1].reaction == pytest.approx(gapbeam.solve(scene).steps[-1].reaction, abs=1e-13)


def test_pairs_columns_and_scales():
    """A pair of equal numbers is one number, on ground too; columns, and lengths far from one."""
    ground = {"beam": {"spans": [L], "EI": 100.0}, "foundation": [{"k": 10.0}]}
    one, pair = (gapbeam.solve(ground | {"loads": [{"type": "curvature", "kappa": k}]}) for k in (K, [K, K]))
    assert pair.at(1.0).moment == one.at(1.0).moment != 0.0
    for kappa in (np.array([[0.0, K]]), [[0.0, K]]):
        column = gapbeam.solve(SIMPLE | {"loads": {"type": "curvature", "kappa": kappa}})
        assert column.at(1.0).deflection == gapbeam.solve(SIMPLE).at(1.0).deflection
    scale = 2.0**300
    far = gapbeam.solve({**SIMPLE, "beam": {"spans": [L * scale], "EI": 100.0},
                         "loads": [{"type": "curvature", "kappa": [0.0, K / scale]}]})  # fmt: skip
    assert far.at(scale).rotation == gapbeam.solve(SIMPLE).at(1.0).rotation


@pytest.mark.parametrize("changes", [
    {"trains": [{"axles": [[0.0, 1.0]]}]}, {"foundation": [{"k": 10.0, "side": "below"}]},
    {"foundation": [{"k": 10.0}], "sections": [{"EI": [100.0, 300.0]}]},
    {"beam": {"spans": [L], "EI": 100.0, "N": -1.0}, "sections": [{"EI": [100.0, 300.0]}]},
])  # fmt: skip
def test_what_may_stand_beside_it(changes):
    """As the reference of keys says."""
    assert gapbeam.solve(SIMPLE | changes).status == "solved"


@pytest.mark.parametrize(("changes", "words"), [
    ({"sections": [{"EI": [100.0, 300.0]}]}, "loads[0].kappa: a curvature that changes along a section that tapers"),
    ({"foundation": [{"k": np.inf, "side": "below"}], "supports": []}, "loads[0].kappa: a support that is turned"),
    ({"loads": [{"type": "curvature", "kappa": [0.0, np.inf]}]}, "loads[0].kappa: expected finite numbers, got [0.0, inf]"),
    ({"loads": [{"type": "curvature", "kappa": [0.0, 1.0, 2.0]}]}, "loads[0].kappa: expected"),
])  # fmt: skip
def test_refused(changes, words):
    with pytest.raises(SceneError) as caught:
        gapbeam.solve(SIMPLE | changes).extremes  # noqa: B018 - trains are asked there
    assert words in str(caught.value)


def test_picture_and_page(tmp_path):
    result = gapbeam.solve(SIMPLE)
    assert "curvature 0 to 0.012" in [text.get_text() for axes in result.plot().axes for text in axes.texts]
    result.to_html(tmp_path / "page.html")
    assert re.search(r'"ends": ?\[0.0, ?0.012\]', (tmp_path / "page.html").read_text())
