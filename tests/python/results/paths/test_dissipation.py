"""Energy that supports dissipate along a history, beside springs with sliders that are followed one by one."""

import math
import random
import tomllib
from pathlib import Path

import gapbeam
import pytest
from gapbeam.results.paths.dissipation import dissipated

EXAMPLES = Path(__file__).resolve().parents[4] / "examples"


def scene_of(seed):
    """A beam on a link that yields both ways, or a support that yields one way."""
    rng = random.Random(seed)
    points, d, f, slope = [], 0.0, 0.0, rng.choice([4.0, 16.0, 64.0])
    for _ in range(rng.randint(2, 4)):
        d, f = d + (width := rng.choice([0.03125, 0.0625])), f + slope * width
        points.append([d, f])
        slope *= rng.choice([0.0, 0.25, 0.5])
    history = [rng.choice([1.0, 2.0, -1.0, 0.5, 0.0, -2.0]) for _ in range(5)]
    history = [factor for k, factor in enumerate(history) if k == 0 or factor != history[k - 1]]
    side = rng.choice(["both", "both", "below"])
    link = {"x": 1.0, "law": points, "unloading": "plastic", "side": side}
    return {"beam": {"spans": [2.0], "EI": 1.0}, "supports": [{"node": 0}, {"node": 1}, link],
            "loads": [{"type": "force", "x": 1.0, "F": rng.choice([4.0, 8.0, 16.0])}],
            "analysis": {"follow": "events", "history": history}}  # fmt: skip


def sliders(points, ways):
    """Work of the sliders of a law both ways, while its displacement goes from place to place."""
    slopes = [(f - g) / (d - e) for (d, f), (e, g) in zip(points, [[0.0, 0.0], *points[:-1]], strict=True)]
    springs = [(a - b, d) for a, b, (d, _) in zip(slopes, slopes[1:], points, strict=False) if a > b]
    slips, work, before = [0.0] * len(springs), 0.0, 0.0
    found = []
    for way in ways:
        for k, (stiffness, reach) in enumerate(springs):
            stretch = min(reach, max(-reach, way - slips[k]))
            work += stiffness * reach * abs(way - stretch - slips[k])
            slips[k] = way - stretch
        before = way
        found.append(work)
    assert before == ways[-1]
    return found


@pytest.mark.parametrize("seed", range(40))
def test_beside_sliders(seed):
    result = gapbeam.solve(scene_of(seed))
    lost = dissipated(result)
    assert lost.shape == (len(result.steps), 3)
    assert not lost[:, :2].any()
    ways, support = [float(step.deflection[2]) for step in result.steps], result.scene.supports[2]
    if support.side == "both":
        assert lost[:, 2].tolist() == pytest.approx(sliders(support.law, ways), abs=1e-13)
    assert all(after >= before - 1e-13 for before, after in zip(lost[:-1, 2], lost[1:, 2], strict=True))


def test_a_plateau_times_the_set():
    """One way, elastic and then level: the force at which it yields times the set."""
    scene = {"beam": {"spans": [2.0], "EI": 1.0}, "supports": [{"node": 0}, {"node": 1}],
             "loads": [{"type": "force", "x": 1.0, "F": 4.0}], "analysis": {"follow": "events", "history": [1.0, 0.0, 1.5, 0.0]}}
    scene["supports"].append({"x": 1.0, "side": "below", "law": [[0.0625, 1.0], [1.0, 1.0]], "unloading": "plastic"})  # fmt: skip
    result = gapbeam.solve(scene)
    for step, lost in zip(result.steps, dissipated(result)[:, 2], strict=True):
        assert lost == pytest.approx(step.set[2], abs=1e-13)
    assert result.steps[-1].set[2] > 0.1
    supports = result.to_dict()["steps"][-1]["supports"]
    assert [one.get("dissipated") for one in supports[:2]] == [None, None]
    assert supports[2]["dissipated"] == pytest.approx(result.steps[-1].set[2], abs=1e-13)


@pytest.mark.parametrize("settlement", [0.0, 0.002])
@pytest.mark.parametrize("held", ["normal", "axial", "rotational"])
def test_sets_of_what_yields_both_ways(held, settlement):
    """A spring 50/99 beside one with a slider, together 100: under 1.2 times the factor its slider slips to and fro."""
    support = {"x": 2.0, "direction": held, "law": [[0.01, 1.0], [1.0, 1.5]], "unloading": "plastic", "settlement": settlement}
    load = {"normal": {"type": "force", "x": 2.0, "F": 1.2}, "axial": {"type": "axial", "x": 2.0, "F": 1.2},
            "rotational": {"type": "moment", "x": 2.0, "M": 1.2}}[held]  # fmt: skip
    others = [{"x": 0.0}] if held == "normal" else [{"x": 0.0}, {"x": 2.0}] if held == "axial" else [{"x": 2.0}]
    if held == "rotational":
        del support["settlement"]
    scene = {"beam": {"spans": [1.0, 1.0], "EI": 100.0, "EA": 100.0}, "supports": [*others, support], "loads": [load],
             "analysis": {"follow": "events", "history": [1.0, 0.5, 0.0, -1.0, 0.2, 1.0]}}  # fmt: skip
    result = gapbeam.solve(scene)
    # Where nothing happens on the way, the ends of the legs; the first yield, at 1/1.2, and two later ones are events
    sets = [float(step.set[-1]) for step in result.steps]
    assert sets == pytest.approx([0.0, 0.394, 0.394, 0.394, 0.394, -0.394, -0.394, -0.394, 0.394], abs=1e-13)
    slip = (1.0 - 0.5 / 99.0) * 0.396
    lost = [0.0, slip, slip, slip, slip, 3 * slip, 3 * slip, 3 * slip, 5 * slip]
    assert dissipated(result)[:, -1].tolist() == pytest.approx(lost, abs=1e-13)
    for segment in result.path.segments:
        inside = result.path.step(segment, (segment.start + 2 * segment.stop) / 3)
        energy, left, way = inside.solution.yielded()[:, -1].tolist()
        force = 100.0 * (way - left)
        assert abs(inside.reaction[-1]) == pytest.approx(abs(force), abs=1e-13)
        # Of the spring without slider, and of the other
        assert energy == pytest.approx(way**2 / 2 / 1.98 + (force - way / 1.98) ** 2 / 2 / (100.0 - 1 / 1.98), abs=1e-13)


def test_an_axial_stop_keeps_its_set():
    """A stop that yielded is reached later by its set, and has lost what it took up less what it gave back."""
    stop = {"x": 1.0, "direction": "axial", "side": "right", "gap": 0.1, "law": [[0.01, 1.0], [1.0, 1.5]], "unloading": "plastic"}
    scene = {"beam": {"spans": [1.0, 1.0], "EI": 100.0, "EA": 100.0},
             "supports": [{"x": 0.0}, {"x": 2.0}, {"x": 0.0, "direction": "axial"}, stop],
             "loads": [{"type": "axial", "x": 1.0, "F": -25.0}],
             "analysis": {"follow": "events", "history": [1.0, -0.2, 1.1]}}  # fmt: skip
    result = gapbeam.solve(scene)
    # 25 = 100 u + R, R = 1 + (u - 0.11)/1.98
    u = (25.0 - 1.0 + 0.11 / 1.98) / (100.0 + 1 / 1.98)
    reaction = 25.0 - 100.0 * u
    left = u - 0.1 - reaction / 100.0
    lost = 0.005 + (1.0 + reaction) / 2 * (u - 0.11) - reaction**2 / 200.0
    first = next(k for k, step in enumerate(result.steps) if step.factor == 1.0)
    back = next(k for k, step in enumerate(result.steps) if step.factor == -0.2)
    for k in (first, back):
        assert result.steps[k].set[-1] == pytest.approx(left, abs=1e-13)
        assert dissipated(result)[k, -1] == pytest.approx(lost, abs=1e-13)
    assert result.steps[back].opening[-1] == pytest.approx(0.1 + left + 0.05, abs=1e-13)


def test_what_a_support_moves_itself_is_no_work_of_its_law():
    """A prop that is jacked up against a beam without yielding keeps nothing and loses nothing."""
    prop = {"x": 1.0, "side": "below", "law": [[0.01, 1.0], [1.0, 1.5]], "unloading": "plastic", "name": "prop"}
    scene = {"beam": {"spans": [2.0], "EI": 1.0}, "supports": [{"x": 0.0}, {"x": 2.0}, prop],
             "loads": [{"type": "movement", "support": "prop", "value": -0.05}],
             "analysis": {"follow": "events", "history": [1.0, 0.5]}}  # fmt: skip
    result = gapbeam.solve(scene)
    assert result.steps[-1].reaction[2] > 0.0
    assert [float(step.set[2]) for step in result.steps] == pytest.approx([0.0] * len(result.steps), abs=1e-15)
    assert dissipated(result)[:, 2].tolist() == pytest.approx([0.0] * len(result.steps), abs=1e-15)


def test_friction_takes_force_times_slip():
    result = gapbeam.solve(tomllib.loads((EXAMPLES / "pipe_rack_hot.toml").read_text()))
    lost = dissipated(result)
    assert (lost[1:] >= lost[:-1] - 1e-12 * lost.max()).all()
    assert lost.max() > 0.0
    for k, support in enumerate(result.scene.supports):
        assert support.friction or not lost[:, k].any()
        if support.friction:
            assert lost[-1, k] == pytest.approx(result.loop(k, friction=True).energy, rel=1e-12, abs=1e-15)


def test_no_history_no_energy():
    scene = scene_of(0)
    scene["supports"][2] = {"x": 1.0, "side": "below"}
    del scene["analysis"]
    assert dissipated(gapbeam.solve(scene)) is None
    assert math.isfinite(gapbeam.solve(scene).steps[-1].reaction[2])
