"""Ground that holds a beam along its axis by friction: closed forms, very many sliders in a row, what is shown and refused."""

import json
import random
import tomllib

import gapbeam
import numpy as np
import pytest
from gapbeam.results.equilibrium import sum_of_loads, sum_of_reactions
from languages.installation import TOP
from oracle.ground_along import Bar
from scenes.links_along import random_pipe

EA, ALPHA, DT, LIMIT = 4e6, 1.2e-5, 60.0, 1.5
FULL, ANCHOR = EA * ALPHA * DT, EA * ALPHA * DT / LIMIT
"""Force that holds it in full, and the length over which friction makes it: 2880, 1920."""


def pipe(loads, length=6000.0, supports=(), history=(1.0,), ground=({"limit": LIMIT},), **more):
    return {
        "beam": {"spans": [length], "EI": 1e9, "EA": EA, "alpha": ALPHA, "depth": 1.0},
        "supports": [{"node": 0}, {"node": 1}, *({"direction": "axial", **one} for one in supports)],
        "axial_ground": list(ground), "loads": loads,
        "analysis": {"follow": "events", "history": list(history), "first_order": True}, **more,
    }  # fmt: skip


def hot(dT=DT, **keys):
    return {"type": "temperature", "dT": dT, **keys}


# Closed forms


def test_anchor_length():
    """A hot pipe is held in full beyond the anchor length; cooled, half of it slides back, and the rest stays pulled."""
    result = gapbeam.solve(pipe([hot()], history=(1.0, 0.0)))
    one, back = result.steps
    assert [(z.from_, z.to, z.way) for z in one.slip_zones] == [
        (0.0, pytest.approx(ANCHOR, rel=1e-13), "left"), (pytest.approx(6000.0 - ANCHOR, rel=1e-13), 6000.0, "right")]  # fmt: skip
    x = [0.0, 480.0, 1000.0, 1920.0, 3000.0]
    found = result.at(x, factor=1.0, leg=0)
    assert found.axial_force == pytest.approx([0.0, -720.0, -1500.0, -FULL, -FULL], rel=1e-12, abs=1e-9)
    assert found.axial_displacement == pytest.approx([-LIMIT * (ANCHOR - min(at, ANCHOR)) ** 2 / (2 * EA) for at in x], rel=1e-12)
    assert found.axial_displacement[0] == pytest.approx(-0.6912, rel=1e-12)
    found = result.at([0.0, 960.0, 1440.0, 1920.0, 3000.0], factor=0.0, leg=1)
    assert found.axial_force == pytest.approx([0.0, 1440.0, 720.0, 0.0, 0.0], rel=1e-12, abs=1e-9)
    assert found.axial_displacement[0] == pytest.approx(-0.3456, rel=1e-12)
    extremes = back.extremes["axial_force"]["max"]
    assert extremes.value == pytest.approx(1440.0, rel=1e-12)
    assert min(extremes.x, 6000.0 - extremes.x) == pytest.approx(960.0, rel=1e-12)


def test_a_hot_stretch_in_a_cold_pipe():
    """At its ends half of what holds it in full is left: slip goes as far into the cold as into the warm."""
    result = gapbeam.solve(pipe([hot(**{"from": 3000.0, "to": 9000.0})], length=12000.0))
    assert result.at([3000.0, 9000.0, 6000.0]).axial_force == pytest.approx([-FULL / 2, -FULL / 2, -FULL], rel=1e-12)
    left = result.steps[-1].slip_zones[0]
    assert (left.from_, left.to) == pytest.approx((3000.0 - ANCHOR / 2, 3000.0 + ANCHOR / 2), rel=1e-12)
    assert result.at(3000.0).axial_displacement == pytest.approx(-LIMIT * (ANCHOR / 2) ** 2 / (2 * EA), rel=1e-12)


def test_a_short_pipe_slides_from_its_middle():
    """Too short to be held in full: the fronts have met, and the force stays as friction makes it."""
    length = 1000.0
    result = gapbeam.solve(pipe([hot()], length=length))
    found = result.at([0.0, length / 4, length / 2])
    assert found.axial_force == pytest.approx([0.0, -LIMIT * length / 4, -LIMIT * length / 2], rel=1e-12, abs=1e-10)
    half = length / 2
    assert found.axial_displacement[0] == pytest.approx(-ALPHA * DT * half + LIMIT * half**2 / (2 * EA), rel=1e-12)
    assert found.axial_displacement[2] == pytest.approx(0.0, abs=1e-14)


def test_pulled_at_an_end_and_let_go():
    """It gives way by F^2/(2 EA t); let go, half of that stays."""
    force = 900.0
    result = gapbeam.solve(pipe([{"type": "axial", "node": 1, "F": force}], history=(1.0, 0.0)))
    way = force**2 / (2 * EA * LIMIT)
    end = [float(result.at(6000.0, factor=f, leg=leg).axial_displacement) for f, leg in ((1.0, 0), (0.0, 1))]
    assert end == pytest.approx([way, way / 2], rel=1e-12)
    assert [(z.way, z.to - z.from_) for z in result.steps[-1].slip_zones] == [
        ("right", pytest.approx(300.0, rel=1e-11)), ("left", pytest.approx(300.0, rel=1e-11))]  # fmt: skip


def test_the_largest_displacement_inside_a_part():
    """Pulled by 900, then pushed by 450: it has gone farthest where no force is left, within what slides back."""
    result = gapbeam.solve(pipe([{"type": "axial", "node": 1, "F": 900.0}], history=(1.0, -0.5)))
    most = result.extremes["axial_displacement"]["max"]
    assert most.x == pytest.approx(5700.0, rel=1e-12)
    assert most.value == pytest.approx(300.0 * 225.0 / (2 * EA), rel=1e-11)


def test_it_is_pulled_out():
    result = gapbeam.solve(pipe([{"type": "axial", "x": 50.0, "F": 300.0}], length=100.0))
    assert result.status == "limit-load"
    assert result.limits[0].factor == pytest.approx(LIMIT * 100.0 / 300.0, rel=1e-12)


def test_a_spring_at_the_end():
    """EA eps = t (l + k l^2/(2 EA)), which is no longer linear in the load."""
    k = 4000.0
    result = gapbeam.solve(pipe([hot()], supports=[{"node": 0, "stiffness": k}, {"node": 1, "stiffness": k}]))
    length = (np.sqrt(1 + 2 * k / EA * ANCHOR) - 1) * EA / k
    assert result.steps[-1].slip_zones[0].to == pytest.approx(length, rel=1e-12)
    reaction = k * LIMIT * length**2 / (2 * EA)
    assert result.steps[-1].reaction[2:] == pytest.approx([reaction, -reaction], rel=1e-11)
    half = (np.sqrt(1 + k / EA * ANCHOR) - 1) * EA / k
    assert -result.at(0.0, factor=0.5, leg=0).axial_force * EA / k == pytest.approx(LIMIT * half**2 / 2 * 1.0, rel=1e-11)


def test_dead_loads_come_first():
    """Pulled with its dead load, then warmed: as with a history of both."""
    pull = {"type": "axial", "node": 1, "F": 900.0, "case": "dead"}
    result = gapbeam.solve(pipe([pull, hot()], history=(1.0,)))
    assert result.at(6000.0, factor=1.0).axial_force == pytest.approx(900.0, rel=1e-12)
    # Warmth slides it on to the right, from where the pull has left off
    zone = result.steps[-1].slip_zones[-1]
    assert zone.way == "right"
    assert zone.to - zone.from_ == pytest.approx((900.0 + FULL) / LIMIT, rel=1e-12)


def test_combinations_start_without_force():
    made = pipe([hot(case="sun"), {"type": "axial", "node": 1, "F": 900.0, "case": "pull"}])
    made["analysis"] = {"first_order": True}
    made["combinations"] = [{"name": "a", "factors": {"sun": 1.0}}, {"name": "b", "factors": {"pull": 2.0}}]
    result = gapbeam.solve(made)
    a, b = result.combinations[0], result.combinations[1]
    assert a.at(3000.0).axial_force == pytest.approx(-FULL, rel=1e-12)
    assert b.at(6000.0).axial_displacement == pytest.approx(1800.0**2 / (2 * EA * LIMIT), rel=1e-12)


def test_without_loads_along_the_beam_there_is_no_axial_system():
    made = pipe([{"type": "uniform", "q": 1.0}])
    assert "axial" in gapbeam.solve(made).system.left_out


# Very many sliders in a row


def off_of_sliders(result, made, pieces):
    """Largest differences of forces and displacements, relative to the largest; None where the sliders come to no end."""
    bar = Bar(made, pieces)
    try:
        forces, ways = bar.follow(made["analysis"]["history"], 15 * pieces // 4)
    except ArithmeticError:
        return None
    exact = result.at(((bar.x[1:] + bar.x[:-1]) / 2).tolist()).axial_force, result.at(bar.x.tolist()).axial_displacement
    return max(
        np.abs(a - b).max() / np.abs(a).max() if np.abs(a).max() > 1e-9 else 0.0 for a, b in zip((forces, ways), exact, strict=True)
    )


@pytest.mark.parametrize("seed", [*range(20), 10282, 10407, 10953])  # parts that vanish together, or by rounding between changes
def test_random_histories(seed):
    """Every state stands its audit; the ends of the histories are those of sliders in a row, the nearer the more there are."""
    made = random_pipe(random.Random(seed))
    result = gapbeam.solve(made)
    for segment in result.path.segments:
        for share in (0.3, 0.7, 1.0):
            _ = result.path.step(segment, segment.start + share * (segment.stop - segment.start)).reaction
    if result.status != "solved":
        assert result.limits[-1].kind == "mechanism"
        return
    live = any(load.get("case", "live") == "live" for load in made["loads"])
    factor = made["analysis"]["history"][-1] if live else 1.0
    loads, reactions = sum_of_loads(result.scene, factor), sum_of_reactions(result.scene, result.steps[-1])
    assert loads.axial == pytest.approx(reactions.axial, abs=1e-8)
    friction = sum(zone.friction for zone in result.steps[-1].slip_zones)
    held = [k for k, one in enumerate(made["supports"]) if one.get("direction") == "axial"]
    assert loads.axial + friction + result.steps[-1].reaction[held].sum() == pytest.approx(0.0, abs=1e-8)
    rough, near = (off_of_sliders(result, made, pieces) for pieces in (8, 24))
    assert near is None or near < max(0.1, 0.7 * (rough or 0.0))


SHORT = [  # steps long beside zones that had just begun lost digits; then zones that stay short
    {
        "sections": [{"from": 1.25, "to": 3.75, "EA": 200.0}],
        "supports": [{"x": 6.75, "direction": "axial", "stiffness": 50.0}, {"x": 1.0, "direction": "axial", "stiffness": 500.0}],
        "axial_ground": [{"from": 2.0, "to": 4.75, "limit": 3.0}, {"from": 1.75, "to": 4.0, "limit": 2.0}],
        "loads": [hot(41.43532214772151, **{"from": 2.75, "to": 3.0}, case="dead"),
                  hot(-36.76571405948812, **{"from": 2.0, "to": 2.25}),
                  {"type": "axial", "F": -4.639957212521749, "x": 2.5}, {"type": "axial", "F": -0.08405522814278577, "x": 2.25}],
        "history": [1.257, 0.918, 1.267, -1.361],
    },
    {
        "sections": [{"from": 3.25, "to": 5.25, "EA": 1000.0}, {"from": 6.25, "to": 7.0, "EA": 50.0}],
        "supports": [{"x": 0.75, "direction": "axial"}, {"x": 5.25, "direction": "axial", "stiffness": 50.0}],
        "axial_ground": [{"limit": 0.5}],
        "loads": [hot(5.613092680226643, **{"from": 0.75, "to": 7.0}, case="dead"),
                  hot(15.355594020340888, **{"from": 1.5, "to": 2.0}),
                  hot(47.622824038258116, **{"from": 3.75, "to": 4.0}), {"type": "axial", "F": -4.2585384831693265, "x": 5.0}],
        "history": [0.124, -1.367, -1.241],
    },
]  # fmt: skip


@pytest.mark.parametrize("given", SHORT)
def test_zones_that_begin_short(given):
    """Zones as short as 1e-9 of a bar grow with the load: every state stands its audit."""
    keys = {key: value for key, value in given.items() if key != "history"}
    ends = [{"x": 0.0}, {"x": 8.0}]
    result = gapbeam.solve({
        "beam": {"spans": [8.0], "EI": 1e6, "EA": 100.0, "alpha": 1e-3, "depth": 1.0}, **keys, "supports": ends + given["supports"],
        "analysis": {"follow": "events", "history": given["history"], "first_order": True}})  # fmt: skip
    assert result.status == "solved"
    for segment in result.path.segments:
        for share in (0.01, 0.1, 0.3, 0.5, 0.77, 0.9, 1.0):
            _ = result.path.step(segment, segment.start + share * (segment.stop - segment.start)).reaction


# What is shown, what is refused


def test_what_is_shown():
    made = tomllib.loads((TOP / "examples" / "buried_pipe.toml").read_text())
    result = gapbeam.solve(made)
    text = gapbeam.report.report_text(result)
    assert "Slip along the ground" in text
    assert "1920" in text
    assert "no force comes of it" not in text
    data = json.loads(gapbeam.report.to_json(result))
    assert data["steps"][0]["slip_zones"][0] == {
        "from": 0.0, "to": pytest.approx(1920.0), "way": "left", "friction": pytest.approx(2880.0)}  # fmt: skip
    x = result.fields(1).x
    assert np.isclose(x, 960.0).any()
    assert '"n_parts"' in result.to_html()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"axial_ground": [{"limit": -1.0}]}, r"axial_ground\[0\]\.limit: expected a finite number, 0 or more, got -1"),
        ({"axial_ground": [{"limit": 1.0, "to": 1e9}]}, r"axial_ground\[0\]\.to: .* is outside the beam"),
        ({"foundation": [{"k": 1.0}]}, r"axial_ground\[0\]\.limit: ground along the beam beside a foundation"),
        ({"beam": {"spans": [9.0], "EI": 1.0, "alpha": 1e-5}}, r"axial_ground\[0\]\.limit: .* needs the axial stiffness"),
        ({"sections": [{"EA": [1.0, 2.0]}]}, r"axial_ground\[0\]\.limit: .* EA that changes"),
        ({"supports": [{"node": 0, "friction": 0.1}, {"node": 1}]}, r"axial_ground\[0\]\.limit: .* beside friction of supports"),
        ({"loads": [{"type": "axial_uniform", "q": 1.0}]}, r"axial_ground\[0\]\.limit: .* distributed along it"),
        ({"supports": [{"node": 0, "law": {"type": "tanh", "stiffness": 3e3, "limit": 30.0}}, {"node": 1}]},
         r"axial_ground\[0\]\.limit: .* whose law is a curve"),
    ],
)
def test_refusals(change, message):
    with pytest.raises(gapbeam.SceneError, match=message):
        gapbeam.solve(pipe([hot()]) | change)


def test_under_trains_it_is_refused():
    made = pipe([hot()])
    made["trains"] = [{"axles": [[0.0, 1.0]]}]
    made["analysis"] = {"first_order": True}
    with pytest.raises(gapbeam.SceneError, match="ground along the beam"):
        gapbeam.solve(made)


@pytest.mark.parametrize(
    ("at_limit", "slack"), [("stop", {"rotation": {"slack": 0.002}}), ("jump", {"rotation": {"slack": 0.002}})]
)
def test_what_jumps_is_set_free_as_without_ground_along_the_beam(at_limit, slack):
    """While it jumps nothing changes along it, though the path that tells what is set free goes to other load factors."""
    falls = [[0.002, 10.0], [0.006, 5.0], [0.01, 5.0]]
    made = {
        "beam": {"spans": [3.0], "EI": 1000.0, "EA": 1e5}, "analysis": {"follow": "events", "at_limit": at_limit},
        "supports": [{"node": 1}, {"x": 1.0, "law": falls}, {"x": 1.5, "law": [[0.002, 4.0], [0.006, 2.0], [0.01, 2.0]], **slack},
                     {"node": 1, "direction": "axial"}],
        "loads": [{"type": "force", "x": 1.0, "F": 20.0}, {"type": "axial", "x": 0.75, "F": 30.0}],
    }  # fmt: skip
    alone, held = (gapbeam.solve({**made, **ground}) for ground in ({}, {"axial_ground": [{"limit": 1.0}]}))
    assert len(alone.limits) == len(held.limits) == 1
    assert held.limits[0].released == pytest.approx(alone.limits[0].released, rel=1e-12)
    assert held.limits[0].factor == alone.limits[0].factor
    assert held.at(3.0, side="left").axial_force == pytest.approx(3.0 - 30.0 * held.steps[-1].factor, rel=1e-12)
