"""Many supports with laws: at one place, by balance and law from the numbers reported; a pile, beside a step program."""

import itertools
import random
import time

import gapbeam
import numpy as np
import pytest
from gapbeam import EngineError, SceneError
from gapbeam.scene.laws import law_points
from oracle.step_program import follow_steps
from scenes.law import random_law

RIGID = float("inf")
LENGTH = 4.0


def pile(places, force, slope=0.0):
    """A pile in clay: springs on both sides that yield and leave gaps, stiffer and stronger with depth."""
    supports = [{"x": 0.0, "stiffness": 1.0}]
    for i in range(places):
        for side in ("below", "above"):
            depth = 0.4 + 1.2 * i / places
            law = {"type": "hardening", "stiffness": 4e3 * depth, "limit": 12.0 * depth, "slope": slope * 4e3 * depth}
            law = law if slope else {"type": "plastic", "stiffness": 4e3 * depth, "limit": 12.0 * depth}
            supports.append({"x": 12.0 * (i + 1) / places, "side": side, "law": law, "unloading": "plastic"})
    return {
        "beam": {"spans": [12.0], "EI": 2e4},
        "supports": supports,
        "loads": [{"type": "force", "x": 0.0, "F": force}],
        "analysis": {"follow": "events", "history": [1.0, -1.0, 1.0]},
    }


@pytest.mark.parametrize(("places", "force", "slope"), [(20, 40.0, 0.0), (20, 40.0, 0.05), (40, 40.0, 0.0)])
def test_a_pile_to_and_fro(places, force, slope):
    """40 and 80 springs: at every turn of the load all that have yielded are at a kink."""
    made = pile(places, force, slope)
    result = gapbeam.solve(made)
    assert result.status == "solved"
    ends = {segment.leg: segment for segment in result.segments}
    for leg, expected in enumerate(follow_steps(made)):
        found = result.path.step(ends[leg], ends[leg].stop).deflection
        # The first time nothing unloads, and steps make no error
        assert found == pytest.approx(expected, abs=(1e-9 if leg == 0 else 2e-4) * np.abs(expected).max())


def test_time_of_an_event_grows_with_the_supports_only():
    """It doubled with each support."""
    times = []
    for places in (5, 20):
        made = pile(places, 40.0)
        best = min(_seconds(made) for _ in range(3))
        times.append(best)
    assert times[1] < 60 * times[0]  # 4 times as many supports: 16 times the work, and more of it


def _seconds(made):
    begin = time.perf_counter()
    segments = len(gapbeam.solve(made).segments)
    return (time.perf_counter() - begin) / segments


def together(rng):
    """Two to four supports with and without laws at a place, many of them rigid."""
    family = rng.choice(["hardening", "softening", "plastic", "broken"])
    supports = [{"node": 0}, {"node": 2}] if rng.random() < 0.7 else [{"node": 0, "rotation": RIGID}, {"node": 2}]
    for x in [2.0] if rng.random() < 0.7 else [2.0, 3.0]:
        for _ in range(rng.randint(2, 4)):
            memory = family in ("plastic", "broken")
            support = {"x": x, "side": rng.choice(["below", "below", "above"] + ([] if memory else ["both"]))}
            kind = rng.random()
            if 0.15 < kind < 0.25:
                support["stiffness"] = float(rng.choice([1, 10, 100]))
            elif 0.25 <= kind < 0.5:
                name = "plastic" if kind < 0.45 else "brittle"
                support["law"] = {"type": name, "stiffness": RIGID, "limit": float(rng.choice([5, 10, 20]))}
            elif kind >= 0.5:
                support["law"] = random_law(rng, family)
            if support["side"] != "both" and rng.random() < 0.6:
                support["gap"] = rng.choice([0.0, 0.125, 0.25, 0.5])
            if "law" in support and memory:
                support["unloading"] = family
            supports.append(support)
    loads = [{"type": "force", "x": rng.choice([1.0, 2.0, 3.0]), "F": rng.choice([-1, 1, 1]) * float(rng.choice([5, 15, 40, 80]))}]
    if rng.random() < 0.4:
        loads.append({"type": "uniform", "q": float(rng.choice([-4, 3, 10]))})
    if rng.random() < 0.3:
        loads[-1]["case"] = "dead"
    analysis = {"follow": "events", "at_limit": rng.choice(["stop", "jump", "follow"])}
    if rng.random() < 0.4:
        analysis = {"steps": 2}
    elif memory:
        analysis["history"] = [1.0, 0.0, 1.5, -0.5]
    beam = {"spans": [2, 2], "EI": float(rng.choice([10, 100]))}
    return {"beam": beam, "supports": supports, "loads": loads, "analysis": analysis}


def is_balanced(made, step):
    """Forces, and moments about the left end where nothing is clamped."""
    force = moment = 0.0
    for load in made["loads"]:
        share = 1.0 if load.get("case") == "dead" else step.factor
        total = share * load.get("F", load.get("q", 0.0) * LENGTH)
        force, moment = force + total, moment + total * load.get("x", LENGTH / 2)
    x = np.array([s.get("x", 2.0 * s.get("node", 0)) for s in made["supports"]])
    size = np.abs(step.reaction).sum() + abs(force) + 1.0
    turned = "rotation" in made["supports"][0] or abs((step.reaction * x).sum() - moment) < 4e-9 * size
    return turned and abs(step.reaction.sum() - force) < 1e-9 * size


def is_on_its_law(support, law, deflection, reaction, size):
    """Whether a support without memory has the force of its law, either way of one that holds both."""
    ways = {"below": (1,), "above": (-1,), "both": (1, -1)}[support["side"]]
    return any(_is_on(support, law, way * deflection - support.get("gap", 0.0), way * reaction, size) for way in ways)


def _is_on(support, law, d, force, size):
    if d <= 1e-9 and abs(force) < 1e-9 * size:
        return True
    if law is None:
        k = support.get("stiffness", RIGID)
        return abs(d) < 1e-9 and force > -1e-9 * size if k == RIGID else abs(force - k * d) < 1e-8 * size
    points = [(0.0, 0.0), *map(tuple, law)]
    (a, low), (b, high) = points[-2:]
    far = abs(d) + abs(force) + 10.0
    points.append((b + far, high + far * (high - low) / (b - a)) if b > a else (b, high + far))
    for (a, low), (b, high) in itertools.pairwise(points):
        way, here = np.array([b - a, (high - low) / size]), np.array([d - a, (force - low) / size])
        share = min(1.0, max(0.0, here @ way / (way @ way)))
        if np.abs(here - share * way).max() < 1e-8:
            return True
    return False


@pytest.mark.parametrize("block", range(4))
def test_supports_at_one_place_balance(block):
    """Whatever is solved balances and lies on its laws; what statics cannot tell is refused in words."""
    solved, refused = 0, {}
    for seed in range(200 * block, 200 * (block + 1)):
        made = together(random.Random(seed))
        try:
            result = gapbeam.solve(made)
        except (SceneError, EngineError) as error:
            refused[seed] = str(error)
            continue
        solved += 1
        steps = list(result.steps)
        for segment in result.segments or ():
            for factor in (segment.start, (segment.start + segment.stop) / 2, segment.stop):
                steps.append(result.path.step(segment, factor) if hasattr(segment, "leg") else result.state(factor))
        laws = [None if s.law is None else law_points(s.law) for s in result.scene.supports]
        for step in steps:
            assert is_balanced(made, step), (seed, step.factor)
            size = np.abs(step.reaction).sum() + 1.0
            for s, law, w, r in zip(made["supports"][2:], laws[2:], step.deflection[2:], step.reaction[2:], strict=True):
                assert "unloading" in s or is_on_its_law(s, law, w, r, size), (seed, step.factor)
    assert solved > 80
    words = "both stand at", "leave no room", "have yielded to the same"
    assert {seed: error for seed, error in refused.items() if not any(word in error for word in words)} == {}


def rigid(side, limit=10.0, **more):
    return {"node": 1, "side": side, "law": {"type": "plastic", "stiffness": RIGID, "limit": limit}, **more}


def at_midspan(supports, force, **analysis):
    return {
        "beam": {"spans": [2, 2], "EI": 100},
        "supports": [{"node": 0}, {"node": 2}, *supports],
        "loads": [{"type": "force", "node": 1, "F": force}],
        "analysis": {"follow": "events", **analysis},
    }


def test_rigid_up_and_down_at_one_place_holds_both_ways():
    """One below and one above, as the documentation has it: only one of them carries at a time."""
    for force, expected in ((8.0, [8.0, 0.0]), (-8.0, [0.0, -8.0]), (15.0, [10.0, 0.0])):
        step = gapbeam.solve(at_midspan([rigid("below"), rigid("above")], force)).steps[-1]
        assert step.reaction[2:] == pytest.approx(expected, abs=1e-12)


def test_one_above_the_other():
    """Rigid at different deflections each of them is needed in turn."""
    step = gapbeam.solve(at_midspan([rigid("below"), rigid("below", 20.0, gap=0.01)], 45.0)).steps[-1]
    assert step.reaction[2:] == pytest.approx([10.0, 20.0], rel=1e-12)
    assert step.reaction.sum() == pytest.approx(45.0, rel=1e-12)


def test_rigid_supports_that_meet_on_their_way_are_refused():
    """Both have yielded to one deflection, from which they unload rigidly."""
    supports = [rigid("below", unloading="plastic"), rigid("below", 20.0, gap=0.01, unloading="plastic")]
    assert gapbeam.solve(at_midspan(supports, 45.0)).status == "solved"
    words = r"two supports at x = 2 have yielded to the same deflection .* at load factor 1, .*stiffness"
    with pytest.raises(EngineError, match=words):
        gapbeam.solve(at_midspan(supports, 45.0, history=[1.0, 0.5]))


def test_a_support_that_does_not_move_is_no_other_way():
    """Both come to a kink at a deflection of 0.01, at which the one that breaks holds the beam until it has: that is one way on."""
    breaks = {"node": 1, "side": "below", "law": {"type": "brittle", "stiffness": 500.0, "limit": 5.0}}
    softens = {"node": 1, "side": "below", "law": [[0.01, 4.0], [0.05, 1.0], [1.0, 1.0]]}
    result = gapbeam.solve(at_midspan([breaks, softens], 100.0, at_limit="follow"))
    beam = 48 * 100 / 4.0**3
    assert [(limit.factor, limit.kind) for limit in result.limits] == [(pytest.approx((9.0 + beam * 0.01) / 100), "limit")]
    assert result.segments[1].others == ()


@pytest.mark.parametrize("supports", [
    [{"x": 2, "law": {"type": "cubic", "k1": 2500, "k3": 3.5e8}}],
    [{"x": 0, "law": {"type": "tanh", "stiffness": 10000, "limit": 98}}],
    [{"x": 5, "law": {"type": "power", "d0": 0.005, "limit": 33.9, "n": 1}}],
    [{"x": 0, "stiffness": 1e4}, {"x": 10, "law": {"type": "cubic", "k1": 1e4, "k3": 3e8}, "rotation": 1.0}],
    [{"x": 5, "side": "below", "rotation": {"law": {"type": "plastic", "stiffness": 2670, "limit": 30.6}}}],
    [{"x": 10, "rotation": {"law": {"type": "plastic", "stiffness": 0.008, "limit": 1}}}, {"x": 0, "law": [[1, 3e-5], [1, 1]]}],
    [{"x": 0, "law": {"type": "power", "d0": 0.005, "limit": 40, "n": 0.33}},
     {"x": 10, "law": {"type": "brittle", "stiffness": 1, "limit": 1}}],
])  # fmt: skip
@pytest.mark.parametrize("analysis", [{}, {"follow": "events"}])
def test_laws_where_nothing_acts(supports, analysis):
    step = gapbeam.solve({"beam": {"spans": [10], "EI": 2e4}, "supports": supports, "analysis": analysis}).steps[-1]
    assert np.abs([*step.reaction, *step.deflection, *step.solution.moment_left]).max() < 1e-24


@pytest.mark.parametrize(("law", "load"), [
    ([[0, 1], [1, 80]], 40),
    ({"type": "hardening", "stiffness": 1, "limit": 1, "slope": 2e4}, 80),
])  # fmt: skip
def test_a_load_at_the_only_support_to_a_breakpoint(law, load):
    supports, loads = [{"x": 1.73, "law": law}], [{"type": "force", "x": 1.73, "F": load}]
    scene = {"beam": {"spans": [4], "EI": 1}, "supports": supports, "loads": loads, "analysis": {"follow": "events"}}
    step = gapbeam.solve(scene).steps[0]
    assert (step.factor, step.reaction[0]) == (pytest.approx(1 / load), pytest.approx(1.0))


def test_supports_that_take_all_of_a_load_beside_laws():
    yields = {"type": "hardening", "stiffness": 5000, "limit": 6, "slope": 2e4}
    keeps = {"law": [[0.001, 7], [0.02, 7]], "unloading": "plastic"}
    supports = [{"x": 0, "rotation": {"law": yields}}, {"x": 1, "rotation": keeps}]
    scene = {"beam": {"spans": [10], "EI": 2e4}, "supports": supports, "loads": [{"type": "force", "x": 0, "F": 70}]}
    assert gapbeam.solve({**scene, "analysis": {"follow": "events"}}).steps[-1].reaction[:2].tolist() == [70.0, 0.0]


@pytest.mark.parametrize("n", [0.33, 0.9])
@pytest.mark.parametrize("held", [{}, {"side": "below"}, {"law": [[0, 50], [0.01, 60]]}])
@pytest.mark.parametrize("analysis", [{}, {"follow": "events"}])
def test_a_curve_that_begins_steep_takes_nothing_where_another_support_holds(n, held, analysis):
    curve = {"type": "power", "d0": 0.01, "limit": 36, "n": n}
    supports = [{"x": 0}, {"x": 2, "law": curve}, {"x": 2, **held}, {"x": 6}]
    scene = {"beam": {"spans": [6], "EI": 1e4}, "supports": supports, "loads": [{"type": "force", "x": 4, "F": 32}]}
    assert gapbeam.solve({**scene, "analysis": analysis}).reactions == pytest.approx([-8, 0, 28, 12], abs=1e-13)
