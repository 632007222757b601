"""Axial compression beside the Euler load: reported, warned of, and refused where the beam would buckle."""

import json
import math
import random
from itertools import pairwise

import gapbeam
import numpy as np
import pytest
from gapbeam import SceneError
from gapbeam.cli import main
from gapbeam.report.text import report_text
from gapbeam.scene import columns
from scenes import at, force, scene, uniform

EULER = math.pi**2
AXIAL = {"node": 0, "direction": "axial"}


@pytest.fixture(autouse=True)
def first_order(monkeypatch):
    """As beside all that axial loads that bend are not available with."""
    monkeypatch.setattr(columns, "_is_of_first_order", lambda scene: True)


def push(P, **keys):
    """A force that compresses the beam to the left of where it acts."""
    return {"type": "axial", "F": -P, **keys}


def strut(P, spans=(1.0, 1.0), supports=None, EI=1.0, loads=(), analysis=None, **keys):
    supports = [at(i) for i in range(len(spans) + 1)] if supports is None else supports
    loads = [uniform(1.0), push(P, node=len(spans)), *loads]
    return {**scene(list(spans), [*supports, AXIAL], loads, EI=EI, EA=1e3, analysis=analysis or {}), **keys}


def ratio(made, **analysis):
    made = {**made, "analysis": {**made.get("analysis", {}), "first_order": True, **analysis}}
    found = gapbeam.solve(made).compression
    return None if found is None else found.ratio


def test_tension_and_no_axial_force_are_nothing():
    assert ratio(strut(-5.0)) is None
    plain = gapbeam.solve(scene([1.0], [at(0), at(1)], [uniform(1.0)]))
    assert plain.compression is None
    assert "second order" not in plain.system.left_out
    assert "compression" not in plain.to_dict()["system"]


@pytest.mark.parametrize("share", [0.0999, 0.1001, 0.9999])
def test_what_is_left_out_is_said(share):
    result = gapbeam.solve(strut(share * EULER))
    found = result.compression
    assert found.ratio == pytest.approx(share, rel=1e-12)
    assert (found.from_, found.to, found.length) == (0.0, 1.0, 1.0)
    assert found.force == pytest.approx(share * EULER)
    data = result.to_dict()
    assert "second order" in data["system"]["left_out"]
    assert data["system"]["compression"] == {"ratio": found.ratio, "force": found.force, "from": 0.0, "to": 1.0, "length": 1.0}
    text = " ".join(report_text(result, verbose=True).split())
    assert f"effect of axial forces on bending: P L²/(π² EI) = {share:.4g}" in text
    assert ("remarks" in data) == ("comes near the Euler load" in text) == (share > 0.1)


def test_what_would_buckle_is_refused(tmp_path, capsys):
    for P in (1.0001 * EULER, 10.0 * EULER):
        with pytest.raises(SceneError, match=r"analysis\.first_order: .*would buckle.*first_order = true"):
            gapbeam.solve(strut(P))
    meant = gapbeam.solve(strut(10.0 * EULER, analysis={"first_order": True}))
    assert meant.status == "solved"
    assert meant.compression.ratio == pytest.approx(10.0)
    assert meant.remarks == []
    path = tmp_path / "strut.json"
    path.write_text(json.dumps(strut(10.0 * EULER)))
    assert main(["run", str(path)]) == 2
    assert "analysis.first_order" in capsys.readouterr().err


def test_the_supports_that_act_count():
    """The middle support is left as the load grows: then L is that of both spans."""
    supports = [at(0), at(1, side="below"), at(2)]
    lifted = strut(0.5 * EULER, supports=supports)
    assert ratio(lifted) == pytest.approx(0.5)
    lifted["loads"][0]["q"] = -1.0
    assert ratio(lifted) == pytest.approx(2.0)
    # A support without stiffness, or a guide, carries nothing
    assert ratio(strut(0.5 * EULER, supports=[at(0), at(1, stiffness=0.0), at(2)])) == pytest.approx(2.0)
    plastic = {"type": "plastic", "stiffness": 10.0, "limit": 5.0}
    assert ratio(strut(0.5 * EULER, supports=[at(0), at(1, law=plastic), at(2)])) == pytest.approx(0.5)
    open_law = strut(0.5 * EULER, supports=[at(0), at(1, side="above", law=plastic), at(2)])
    assert ratio(open_law) == pytest.approx(2.0)


def test_overhangs_hinges_and_stiffnesses():
    assert ratio(strut(1.0, spans=[3.0], supports=[at(0, rotation="fixed")])) == pytest.approx(36.0 / EULER)
    assert ratio(strut(1.0, spans=[2.0, 1.5], supports=[at(0), at(1)])) == pytest.approx(9.0 / EULER)
    hinged = strut(1.0, spans=[2.0, 2.0])
    hinged["beam"]["hinges"] = [2.75]
    assert ratio(hinged) == pytest.approx((2 * 1.25) ** 2 / EULER)
    hinged["beam"]["hinges"] = [2.0]
    assert ratio(hinged) == pytest.approx(4.0 / EULER)
    soft = strut(1.0, spans=[2.0, 3.0], EI=[1.0, 4.0])
    assert ratio(soft) == pytest.approx(4.0 / EULER)
    soft["sections"] = [{"from": 2.5, "to": 2.6, "EI": 0.5}]
    assert ratio(soft) == pytest.approx(9.0 / 0.5 / EULER)
    assert ratio(strut(1.0, EI=math.inf, spans=[2.0])) == 0.0


def test_beside_a_formula_written_anew():
    """Beams with loads along them in many places: a table of axial forces, and every stretch looked at."""
    rng = random.Random(5)
    for _ in range(60):
        n = rng.randint(1, 5)
        spans, EI = [rng.uniform(0.5, 4.0) for _ in range(n)], [rng.uniform(0.5, 9.0) for _ in range(n)]
        x = np.concatenate(([0.0], np.cumsum(spans)))
        pushes = [(rng.uniform(0.0, x[-1]), rng.uniform(-3.0, 3.0)) for _ in range(4)]
        made = strut(0.0, spans=spans, EI=EI, loads=[push(P, x=place) for place, P in pushes])
        right = 0.0
        for i in range(n):
            cuts = sorted([*x[[i, i + 1]].tolist(), *(p for p, _ in pushes if x[i] < p < x[i + 1])])
            P = max(sum(F for place, F in pushes if place > (a + b) / 2) for a, b in pairwise(cuts))
            right = max(right, P * spans[i] ** 2 / (EULER * EI[i]))
        assert (ratio(made) or 0.0) == pytest.approx(right, rel=1e-9, abs=1e-12)


def test_every_step_and_event_counts():
    """The full load presses the beam onto its support again, without which it would have buckled before."""
    supports = [at(0), at(1, side="below"), at(2)]
    made = strut(0.9 * EULER, supports=supports, analysis={"steps": 2})
    made["loads"][0] |= {"q": -1.0, "case": "dead"}
    made["loads"].append(force(1.0, 1.75))
    assert ratio(made, steps=1) == pytest.approx(0.9)
    assert ratio(made) == pytest.approx(1.8)
    with pytest.raises(SceneError, match=r"at load factor 0\.5 the beam would buckle"):
        gapbeam.solve(made)
    with pytest.raises(SceneError, match="would buckle"):
        gapbeam.solve({**made, "analysis": {"follow": "events"}})


def test_falling_load_counts():
    """A support that keeps a set opens while the load falls: from there on the span is twice as long."""
    law = [[0.004, 40.0], [1.0, 300.0]]
    supports = [at(0), at(1, side="below", law=law, unloading="plastic"), at(2)]
    loads = [force(6.0, 100.0), push(3.8 * EULER * 1e4 / 144.0, node=2)]
    made = scene([6.0, 6.0], [*supports, AXIAL], loads, EI=1e4, EA=1e6)
    history = {"follow": "events", "history": [1.0, 0.0]}
    opens = next(event.factor for event in gapbeam.solve({**made, "analysis": {**history, "first_order": True}}).events[::-1])
    assert 0.28 < opens < 0.32
    assert ratio({**made, "analysis": history}) == pytest.approx(3.8 * opens, rel=1e-12)
    assert ratio(made) == pytest.approx(0.95)
    with pytest.raises(SceneError, match=r"at load factor 0\.29\d+ the beam would buckle"):
        gapbeam.solve({**made, "analysis": history})
    # What yields holds nothing
    made["supports"][1] = at(1, side="below", law={"type": "plastic", "stiffness": 1e4, "limit": 40.0})
    assert ratio(made) == pytest.approx(3.8, rel=1e-12)


def test_what_breaks_counts_though_steps_pass_over_it():
    """A pin that breaks on the way, and a stop that closes after it: the last step has both ends held again."""
    pin = at(1, side="below", law={"type": "brittle", "stiffness": 1e5, "limit": 50.0}, unloading="broken")
    stop = at(1, side="below", gap=0.25)
    loads = [force(6.0, 100.0), push(1.8 * EULER * 1e4 / 144.0, node=2)]
    made = scene([6.0, 6.0], [at(0), pin, stop, at(2), AXIAL], loads, EI=1e4, EA=1e6)
    closes = 0.25 / (100.0 * 12.0**3 / (48 * 1e4))
    for follow in ("events", "steps"):
        assert ratio(made, follow=follow, at_limit="jump") == pytest.approx(1.8 * closes, rel=1e-12)


def test_of_an_overhang_what_is_pressed_counts():
    """Beyond the push nothing bends it: a soft tip there follows as it is."""
    made = strut(0.0, spans=[2.0, 3.0], supports=[at(0), at(1)], EI=[9.0, 0.1], loads=[push(1.0, x=3.0)])
    made["sections"] = [{"from": 2.0, "to": 3.0, "EI": 4.0}]
    assert ratio(made) == pytest.approx(4.0 / 4.0 / EULER)
    assert ratio({**made, "loads": [uniform(1.0), push(1.0, node=2)]}) == pytest.approx(36.0 / 0.1 / EULER)
    mirror = strut(0.0, spans=[3.0, 2.0], supports=[at(1), at(2)], EI=[0.1, 9.0], loads=[{"type": "axial", "x": 2.0, "F": 1.0}])
    mirror["supports"][-1] = {**AXIAL, "node": 2}
    mirror["sections"] = [{"from": 2.0, "to": 3.0, "EI": 4.0}]
    assert ratio(mirror) == pytest.approx(4.0 / 4.0 / EULER)


def test_on_the_ground():
    ground = [{"k": 4.0}]
    rail = scene([30.0], [AXIAL], [uniform(1.0), push(3.0, node=1)], EA=1e3) | {"foundation": ground}
    found = gapbeam.solve(rail).compression
    assert (found.ratio, found.length) == (pytest.approx(3.0 / 4.0), None)
    rail["loads"][1]["F"] = -4.001
    with pytest.raises(SceneError, match=r"P/\(2 sqrt\(k EI\)\)"):
        gapbeam.solve(rail)
    assert ratio(rail | {"foundation": [{"k": 4.0}, {"k": 12.0}]}) == pytest.approx(4.001 / 8.0)
    assert ratio(rail | {"foundation": [{"k": [1.0, 9.0]}]}) == pytest.approx(4.001 / 2.0)
    # Supports near to each other hold it where the ground would not
    near = rail | {"supports": [*(at(x=x) for x in np.linspace(0.0, 30.0, 16).tolist()), AXIAL], "foundation": [{"k": 1e-6}]}
    assert ratio(near) == pytest.approx(4.001 * 4.0 / EULER)
    # A free span between two patches of ground
    patches = rail | {"foundation": [{"k": 100.0, "to": 10.0}, {"k": 100.0, "from": 14.0}]}
    assert ratio(patches) == pytest.approx(max(4.001 * 16.0 / EULER, 4.001 / 20.0))
    yields = rail | {"foundation": [{"k": 2.0}, {"side": "below", "law": [[0.01, 0.02], [1.0, 0.03]]}]}
    assert ratio(yields) == pytest.approx(4.001 / (2 * math.sqrt(2.0 + 0.01 / 0.99)))


def test_cases_and_batches(tmp_path):
    made = strut(1.0, supports=[at(0), at(1, side="below"), at(2)])
    beam = gapbeam.prepare(made)
    cases = beam.solve([[1.0, 0.5 * EULER], [1.0, 10.0 * EULER], [1.0, -10.0 * EULER]])
    assert cases.status.tolist() == [0, gapbeam.Status.BAD_INPUT, 0]
    assert np.isnan(cases.reaction[1]).all()
    assert np.isnan(cases.at([0.5]).moment[1]).all()
    assert np.isnan(cases.extremes["moment"]["max"].value).tolist() == [False, True, False]
    assert np.isnan(cases.error_bounds()["moment"]).tolist() == [False, True, False]
    with pytest.raises(SceneError, match="would buckle"):
        beam.result([1.0, 10.0 * EULER])
    assert beam.solve([1.0, 10.0 * EULER]).status == gapbeam.Status.BAD_INPUT
    # Numbers of spans and supports by case count
    half = [1.0, 0.5 * EULER]
    assert beam.solve(half, EI={0: [0.49, 0.51]}).status.tolist() == [11, 0]
    assert beam.solve(half, gap={1: [0.0, 0.5]}).status.tolist() == [0, 11]
    meant = gapbeam.prepare({**made, "analysis": {"first_order": True}})
    assert meant.solve([1.0, 10.0 * EULER]).status == 0
    path = tmp_path / "strut.json"
    path.write_text(json.dumps(made))
    table = tmp_path / "cases.csv"
    table.write_text(f"loads[1].F\n{-0.5 * EULER}\n{-10 * EULER}\n")
    batch = gapbeam.batch(path, table, out=tmp_path / "out")
    rows = batch.read()
    assert [str(one) for one in rows["status"]] == ["solved", "refused"]
    assert "analysis.first_order" in str(rows["reason"][1])


def test_ground_in_cases():
    rail = scene([30.0], [AXIAL], [uniform(1.0), push(4.0, node=1)], EA=1e3) | {"foundation": [{"k": 4.0}]}
    cases = gapbeam.prepare(rail).solve([[1.0, 1.0], [1.0, 0.5]])
    assert cases.status.tolist() == [11, 0]
    assert np.isnan(cases.extremes["moment"]["max"].value).tolist() == [True, False]


def test_combinations():
    made = strut(EULER)
    made["combinations"] = [{"name": "weak", "factors": {"live": 0.05}}, {"name": "strong", "factors": {"live": 0.5}}]
    result = gapbeam.solve(made)
    assert result.compression.ratio == pytest.approx(0.5)
    assert [remark.startswith('combination "strong"') for remark in result.remarks] == [True]
    assert result.to_dict()["compression"]["ratio"] == pytest.approx(0.5)
    for analysis in ({}, {"steps": 2}):
        made["analysis"] = analysis
        made["combinations"][1]["factors"]["live"] = 2.0
        with pytest.raises(SceneError, match=r'combinations "strong": analysis\.first_order'):
            gapbeam.solve(made)
    made["analysis"] = {"first_order": True}
    assert gapbeam.solve(made).status == "solved"


@pytest.mark.parametrize("ground", [False, True])
def test_trains(ground):
    """A train lifts the beam off its middle support where it stands."""
    made = strut(0.5 * EULER, spans=(1.0, 1.0), supports=[at(0), at(1, side="above"), at(2)])
    made["loads"][0]["q"] = -1.0
    made["trains"] = [{"axles": [[0.0, 0.1]]}]
    if ground:
        made["foundation"] = [{"k": 1e-6}]
    assert ratio(made) == pytest.approx(0.5)
    made["trains"] = [{"axles": [[0.0, 10.0]]}]
    assert ratio(made) == pytest.approx(2.0)
    with pytest.raises(SceneError, match="with train train 1 the beam would buckle"):
        gapbeam.solve(made)


def test_movements_alone_over_links_along_the_beam():
    """Before they act a part can move freely, so their steps are solved by themselves; that ended in an AttributeError."""
    supports = [at(0, law=[[0.004, 22.0], [0.03, 67.5]]), at(1, side="below"), at(2, side="below", law=[[0.004, 40.0]], gap=0.004),
                {"node": 0, "direction": "axial"}, {"node": 0, "direction": "axial", "side": "left", "gap": 0.002}]  # fmt: skip
    loads = [{"type": "movement", "support": 1, "value": 0.0018, "case": "dead"}]
    result = gapbeam.solve(scene([2.5, 6.0], supports, loads, EI=2600.0, EA=1.8e5))
    assert (result.status, result.path, result.compression) == ("solved", None, None)
