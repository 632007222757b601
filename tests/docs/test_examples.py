"""The examples: each solves, makes sense, and shows what it says."""

import re
import runpy
from pathlib import Path

import gapbeam
import numpy as np
import pytest
from gapbeam.report.contact_history import merged

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
SCENES = sorted(EXAMPLES.glob("*.toml"))


def load_total(scene, factor):
    """All vertical load at a load factor."""
    total = 0.0
    for load in scene.loads:
        share = 1.0 if load.case == "dead" else factor
        if hasattr(load, "q"):
            end = scene.span_ends()[-1] if load.to is None else load.to
            total += share * float(np.mean(load.q)) * (end - load.from_)
        elif isinstance(load, gapbeam.ForceLoad):
            total += share * load.F
    return total


def states(name):
    """The different schemes of an example in their order."""
    result = gapbeam.solve(EXAMPLES / f"{name}.toml")
    assert result.status == "solved"
    return [row[2] for row in merged(result.history())], result.steps[-1]


def each(result):
    """The results of the combinations, or the one there is."""
    return list(result.combinations.values()) or [result]


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_scene_solves_and_balances(path):
    result = gapbeam.solve(path)
    assert result.status == "solved"
    assert path.read_text().startswith("# ")
    assert result.scene.title
    assert result.scene.units.force
    for one in each(result):
        balances(one)


def balances(result):
    """No support pulls, and reactions carry the loads."""
    for step in result.steps:
        one_sided = {"below": 1.0, "above": -1.0, "both": 0.0, "left": -1.0, "right": 1.0}
        signs = np.array([one_sided[support.side] for support in result.scene.supports])
        largest = np.abs(step.reaction).max(initial=0.0)
        assert (signs * step.reaction >= -1e-12 * largest).all()
        acting = np.array([support.stiffness > 0.0 for support in result.scene.supports], dtype=bool)
        assert (step.opening[acting] >= 0.0).all()
        assert not (step.opening * step.reaction).any()
    ground = sum(zone.resultant for zone in step.contact)
    across = np.array([support.direction == "normal" for support in result.scene.supports], dtype=bool)
    assert step.reaction[across].sum() + ground == pytest.approx(load_total(result.scene, step.factor), rel=1e-10)


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_both_rules_agree(path):
    results = (each(gapbeam.solve(path, rule=rule)) for rule in ("block", "single"))
    for one, other in zip(*results, strict=True):
        block, single = one.steps[-1], other.steps[-1]
        assert block.state == single.state
        size = np.abs(block.reaction).max(initial=0.0)
        np.testing.assert_allclose(block.reaction, single.reaction, rtol=0, atol=1e-11 * size)
        assert block.contact == single.contact


@pytest.mark.parametrize(("name", "reaction"), [("paper_beam", 3.8507982), ("paper_beam_printed_load", 3.7871682)])
def test_paper_beam(name, reaction):
    schemes, step = states(name)
    assert schemes == [("bilateral", "closed", "open", "closed")]
    assert -step.reaction[1] == pytest.approx(reaction, abs=5e-8)
    assert step.reaction[3] == pytest.approx(0.5301545, abs=5e-8)
    assert step.opening[2] == pytest.approx(0.0771891, abs=5e-8)


def test_pipe_rack_lifts_off_bit_by_bit():
    schemes, step = states("pipe_rack")
    openings = [scheme.count("open") for scheme in schemes]
    assert openings == sorted(set(openings))
    assert openings[0] == 0
    assert openings[-1] >= 2
    assert 0.001 < step.opening.max() < 0.1


def test_shaft_crosses_its_clearance():
    schemes, step = states("shaft_clearance")
    assert schemes[0][1] == schemes[0][3] == "open"  # at first it lies in the lower halves
    assert "closed" in (step.state[1], step.state[3])  # at the end upper ones hold it
    for lower, upper in ((0, 1), (2, 3), (4, 5)):
        assert (step.state[lower], step.state[upper]) != ("closed", "closed")


def test_crane_runway_pulls_at_its_bolts():
    schemes, step = states("crane_runway")
    assert [scheme[2:] for scheme in schemes] == [("closed", "open"), ("open", "open"), ("open", "closed")]
    assert step.deflection[3] < -0.005


def test_snap_through_has_two_limit_points():
    result = gapbeam.solve(EXAMPLES / "snap_through.toml")
    assert [80.0 * event.factor for event in result.events] == pytest.approx([50.0, 35.0])
    assert result.limits[0].landing.deflection[2] == pytest.approx(0.0325)


def test_shear_pin_breaks_and_the_arm_goes_to_both_stops():
    result = gapbeam.solve(EXAMPLES / "rubber_stops.toml")
    assert [limit.causes for limit in result.limits] == [((1, "breaks"),)]
    assert result.state(result.limits[0].factor).reaction[1] == 0.0  # the stable state there is the one after the jump
    happens = [(event.support, event.event) for event in result.events if event.support > 1]
    assert happens == [(2, "closes"), (2, "hardens"), (2, "unloads"), (2, "opens"), (3, "closes"), (3, "hardens")]
    assert result.steps[-1].reaction[1] == 0.0


def test_pile_leaves_a_gap():
    result = gapbeam.solve(EXAMPLES / "pile_head.toml")
    left = result.steps[-1].set
    assert 0.02 < left[0] < 0.04
    assert 0.01 < left[2] < 0.02
    assert not left[[1, 3]].any()
    assert not left[4:].any()
    assert 0.03 < result.at(0.0, factor=1.0).deflection < 0.1


def test_jack_up_has_its_kinks():
    result = gapbeam.solve(EXAMPLES / "shaft_jack_up.toml")
    assert [(event.support, event.event) for event in result.events] == [(2, "opens"), (4, "opens"), (5, "closes"), (3, "closes")]


def test_rail_lifts_beside_the_bogie():
    """By superposition of two wheels on a long beam in full contact: cos + sin, damped (Hetenyi 1946)."""
    result = gapbeam.solve(EXAMPLES / "rail_lift_off.toml")
    EI, k, q, F, apart = 6415.0, 3.0e4, 1.25, 112.5, 2.5
    beta = (k / (4 * EI)) ** 0.25
    x = np.linspace(2.0, 4.0, 200_001)
    w = sum(np.exp(-beta * d) * (np.cos(beta * d) + np.sin(beta * d)) for d in (x, x + apart))
    assert [event.event for event in result.events] == ["zone splits"] * 2
    for event in result.events:
        assert event.factor == pytest.approx(q / k / -(w.min() * F * beta / (2 * k)), rel=1e-5)
        assert abs(event.x - 15.0) == pytest.approx(x[w.argmin()] + apart / 2, abs=1e-4)


def test_footing_lifts_and_turns_over():
    scene = gapbeam.read_scene(EXAMPLES / "strip_footing.toml")
    assert [event.event for event in gapbeam.solve(scene).events] == ["end leaves"]
    scene.loads[2].M = 2400.0
    over = gapbeam.solve(scene)
    assert over.status == "no-equilibrium"
    assert over.segments[-1].stop == pytest.approx(780.0 * 3.0 / 2400.0, rel=1e-9)  # the weight at the edge


def test_seabed_span_breaks_in_two():
    result = gapbeam.solve(EXAMPLES / "seabed_pipe.toml")
    assert [event.event for event in result.events] == ["zone appears", "end reaches"]
    before, after = (result.state(result.events[0].factor + d).free_spans for d in (-1e-6, 1e-6))
    assert len(after) == len(before) + 1
    assert all(span.sag > 0.0 for span in after)


def test_sand_yields_from_above():
    result = gapbeam.solve(EXAMPLES / "laterally_loaded_pile.toml")
    depths = [max((zone.to for zone in step.contact if zone.state == "branch 2"), default=0.0) for step in result.steps]
    assert depths[:4] == [0.0] * 4
    assert depths == sorted(depths)
    heads = [float(result.at(0.0, step=number).deflection) for number in range(10)]
    assert heads[3] == pytest.approx(4 * heads[0], rel=1e-12)
    assert 1.2 < heads[9] / (10 * heads[0]) < 1.3


def test_slab_on_mound_script(capsys, tmp_path):
    script = runpy.run_path(str(EXAMPLES / "slab_on_mound.py"))
    EI = script["find_stiffness"](script["PERMITTED"])
    assert script["bending"](script["with_stiffness"](EI)) == pytest.approx(script["PERMITTED"], rel=1e-10)
    used = gapbeam.read_scene(EXAMPLES / "slab_on_mound.toml").beam.EI
    assert used == pytest.approx(EI, rel=1e-3)
    script["main"](tmp_path)
    printed = re.search(r"```text\n(bends by.*?)```", (EXAMPLES.parent / "docs" / "foundation.md").read_text(), re.DOTALL)[1]
    assert printed in capsys.readouterr().out
    assert (tmp_path / "slab_on_mound.png").stat().st_size > 10_000


def test_pipe_rack_gaps_script(capsys, tmp_path):
    script = runpy.run_path(str(EXAMPLES / "pipe_rack_gaps.py"))
    script["main"](tmp_path / "out", 4000)
    shown = re.search(r"```text\n(20,000 cases.*?)```", (EXAMPLES.parent / "docs" / "batch.md").read_text(), re.DOTALL)[1]
    printed, shown = (re.findall(r"(\d+\.\d+) kN", text) for text in (capsys.readouterr().out, shown))
    assert [float(one) for one in printed] == pytest.approx([float(one) for one in shown], rel=0.01)


def test_shaft_offsets_script(capsys):
    script = runpy.run_path(str(EXAMPLES / "shaft_offsets.py"))
    script["main"]()
    before, after = map(float, re.search(r"bearing: (\S+) kN in line, (\S+) kN with", capsys.readouterr().out).groups())
    assert before == 0.0
    assert after > 8.0


def test_paper_beam_script(capsys, tmp_path):
    script = runpy.run_path(str(EXAMPLES / "paper_beam.py"))
    script["main"](tmp_path / "new" / "folder")
    out = capsys.readouterr().out
    for text in ("3.8507982", "3.7871682", "0.5301545", "0.0771891", "LIRA", "misprint"):
        assert text in out
    assert (tmp_path / "new" / "folder" / "paper_beam.png").stat().st_size > 10_000
