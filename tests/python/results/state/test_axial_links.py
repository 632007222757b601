"""Links along the beam that act one way or by a law, whose forces bending feels: stops, buffers and anchors that yield."""

import math
import random
from fractions import Fraction

import gapbeam
import numpy as np
import pytest
from oracle.axial_chain import LoadedChain
from scenes import at, force, uniform
from scenes.links_along import along, own_weight, random_stops, warm

FOLLOW = {"follow": "events"}


def pipe(dT, **analysis):
    """A pipe of three spans, held at its left end, that closes the gap to a stop when it gets warm."""
    beam = {"spans": [8.0, 8.0, 8.0], "EI": 5e3, "EA": 6e5, "alpha": 1.2e-5}
    supports = [*(at(k, side="below") for k in range(4)), along(0), along(3, side="left", gap=0.01)]
    return {"beam": beam, "supports": supports, "loads": [own_weight(1.5), warm(dT)], "analysis": analysis}


def given(scene, tensions):
    """The beam under axial forces of its spans that are given, all loads in full."""
    supports = [one for one in scene["supports"] if one.get("direction") != "axial"]
    loads = [load for load in scene["loads"] if load["type"] in ("uniform", "force")]
    beam = {"spans": scene["beam"]["spans"], "EI": scene["beam"]["EI"], "N": tensions}
    return {"beam": beam, "supports": supports, "loads": loads}


def live_times(scene, factor):
    """The scene with its live loads times a factor."""
    loads = [
        load | ({} if load.get("case") == "dead" else {key: factor * load[key] for key in ("q", "F", "dT", "value") if key in load})
        for load in scene["loads"]
    ]
    return scene | {"loads": loads}


def followed(scene, factor):
    """The chain of a scene in rationals at a load factor, and load factors of its kinks on the way there from 0."""
    chain = LoadedChain(scene["beam"], scene["supports"], scene["loads"])
    none = [Fraction(0)] * len(chain.links)
    assert chain.chain.go(*chain.rates("dead"), chain.first, none, Fraction(1))[1]
    kinks, arrived = chain.chain.go(*chain.rates("live"), chain.growth, none, Fraction(factor))
    assert arrived
    return chain, kinks


def close(a, b, rtol=1e-11):
    np.testing.assert_allclose(a, b, rtol=0, atol=rtol * np.abs(b).max())


def test_a_hot_pipe_between_stops():
    """N = -EA (alpha dT - gap/L) from the gap on; it bends as under that N."""
    result = gapbeam.solve(pipe(60.0, buckling=1, **FOLLOW))
    (event,) = result.events
    assert (event.event, event.support, event.factor) == ("closes", 5, pytest.approx(0.01 / (1.2e-5 * 60.0 * 24.0), rel=1e-15))
    assert [segment.start for segment in result.segments] == [0.0, event.factor]
    N = -6e5 * (1.2e-5 * 60.0 - 0.01 / 24.0)
    step, right = result.steps[-1], gapbeam.solve(given(pipe(60.0), N) | {"analysis": {"buckling": 1}})
    assert step.reaction[4:] == pytest.approx([-N, N], rel=1e-14)
    assert step.reaction[:4] == pytest.approx(right.steps[-1].reaction, rel=1e-13)
    assert result.at(3.0).moment == pytest.approx(right.at(3.0).moment, rel=1e-13)
    assert result.buckling == pytest.approx(right.buckling, rel=1e-13)
    assert (step.state[5], result.state(0.5).state[5]) == ("closed", "open")
    assert result.state(0.5).opening[5] == pytest.approx(0.01 - 0.5 * 1.2e-5 * 60.0 * 24.0, rel=1e-13)
    assert "closes its gap of 0.01 at load factor 0.5787" in result.report()
    assert "act on bending (second order)" in " ".join(result.report().split())


def test_it_buckles_after_the_gap_is_closed():
    """Spans of equal length between hinges buckle at the Euler load of one."""
    result = gapbeam.solve(pipe(160.0, **FOLLOW))
    euler = math.pi**2 * 5e3 / 64.0
    factor = (euler / 6e5 + 0.01 / 24.0) / (1.2e-5 * 160.0)
    assert result.status == "buckles"
    assert result.segments[-1].stop == pytest.approx(factor, rel=1e-12)
    assert gapbeam.solve(pipe(160.0)).status == "buckles"
    assert gapbeam.solve(pipe(160.0, first_order=True)).status == "solved"


@pytest.mark.parametrize("seed", range(60))
def test_random_beams_beside_chains_in_rationals(seed):
    """Forces along the beam, and what bends under them, at full load and on the way; and where links change."""
    scene = random_stops(random.Random(f"stops {seed}"))
    result = gapbeam.solve(scene | {"analysis": FOLLOW})
    assert result._beam.feels_axial_loads
    if result.status == "buckles":
        return
    which = [k for k, one in enumerate(scene["supports"]) if one.get("direction") == "axial"]
    for factor in (1.0, 0.40625):
        chain, kinks = followed(scene, factor)
        right = gapbeam.solve(given(live_times(scene, factor), list(map(float, chain.chain.tension))))
        assert right.status == "solved"
        for step in (result.state(factor), gapbeam.solve(live_times(scene, factor)).steps[-1]):
            close(np.delete(step.reaction, which), right.steps[-1].reaction)
            close(step.reaction[which], [float(link.force) for link in chain.links], 1e-13)
        if factor == 1.0:
            told = [event.factor for event in result.events if event.support in which]
            assert all(min(abs(at - float(kink)) for kink in kinks) <= 1e-14 for at in told)
            beginning = {float(kink) for kink in kinks if kink > 0}
            assert all(min(abs(at - kink) for at in told) <= 1e-14 for kink in beginning)


@pytest.mark.parametrize("seed", range(60, 76))
def test_in_every_way(seed):
    """By steps, prepared, and as a combination."""
    scene = random_stops(random.Random(f"stops {seed}"))
    scene["loads"] = [load | {"case": load.get("case", "live")} for load in scene["loads"] if load["type"] != "movement"]
    path = gapbeam.solve(scene | {"analysis": FOLLOW})
    steps = gapbeam.solve(scene | {"analysis": {"steps": 4}})
    assert steps.status == path.status
    if path.status == "buckles":
        return
    for step in steps.steps:
        close(step.reaction, path.state(step.factor).reaction)
    across = [one.get("direction") != "axial" for one in scene["supports"]]
    factors = {"dead": 1.0, "live": 0.75}
    row = [factors[load["case"]] for load in scene["loads"]]
    cases = gapbeam.prepare(scene).solve(np.array([row, [1.0] * len(row)]))
    close(cases.reaction, [path.state(0.75).reaction[across], path.state(1.0).reaction[across]])
    combined = gapbeam.solve(scene | {"combinations": [{"name": "hot", "factors": factors}]})
    close(combined.combinations["hot"].steps[-1].reaction, path.state(0.75).reaction)


def test_what_yields_along_the_beam_is_followed_with_the_load():
    """An anchor that yields: the chain remembers nothing else than the load that grows."""
    anchor = along(0, law=[[0.01, 30.0], [1.0, 30.0]], unloading="plastic")
    supports = [at(0), at(1, side="below"), at(2), anchor, along(2, stiffness=500.0)]
    push = {"type": "axial", "node": 2, "F": -100.0}
    scene = {"beam": {"spans": [4.0, 4.0], "EI": 1e3, "EA": 1e5}, "supports": supports, "loads": [uniform(1.0), push]}
    result = gapbeam.solve(scene | {"analysis": FOLLOW})
    assert result._beam.feels_axial_loads
    # Bar and spring beside the anchor: 3000 u at the left end, 500 (u + 8 N/EA) at the right one
    bar = 1e5 / 8.0
    anchored = 1.0 / (1.0 / 3000.0 + 1.0 / bar)
    factor = 30.0 / (100.0 * anchored / (anchored + 500.0))
    assert [(event.event, event.support) for event in result.events] == [("yields", 3)]
    assert result.events[0].factor == pytest.approx(factor, rel=1e-14)
    assert result.steps[-1].reaction[3:] == pytest.approx([30.0, 70.0], rel=1e-14)
    right = gapbeam.solve(given(scene, -30.0))
    close(result.steps[-1].reaction[:3], right.steps[-1].reaction, 1e-13)


def test_what_touches_under_dead_loads_is_no_event():
    """The chain cools until it touches the stop without force, but for rounding: it presses from the first of the load on."""
    stops = [along(1, side="left", gap=-0.00390625, stiffness=64.0), along(1, side="right", gap=0.015625, stiffness=64.0)]
    loads = [force(0.8390613145377058, 10.0), {"type": "axial", "x": 0.0, "F": 250.0}, warm(-16.0, case="dead")]
    beam = {"spans": [2.0], "EI": 1e3, "EA": 8192.0, "alpha": 2.0**-13}
    scene = {"beam": beam, "supports": [at(0), at(1), *stops, along(0, stiffness=16.0)], "loads": loads}
    result = gapbeam.solve(scene | {"analysis": FOLLOW})
    assert result.events == []
    assert result.steps[-1].state[2] == "closed"


def test_a_beam_that_leaves_its_stop_slides():
    beam = {"spans": [4.0, 4.0], "EI": 1e3, "EA": 1e5}
    push = [{"type": "axial", "node": 2, "F": -40.0, "case": "dead"}, {"type": "axial", "node": 2, "F": 100.0}]
    scene = {"beam": beam, "supports": [at(0), at(1), at(2), along(0, side="right")], "loads": [own_weight(1.0), *push]}
    for analysis in (FOLLOW, {}, {"steps": 10}):
        result = gapbeam.solve(scene | {"analysis": analysis})
        assert result.status == "no-equilibrium"
        assert "slides along its axis" in result.reason
    result = gapbeam.solve(scene | {"analysis": FOLLOW})
    assert result.segments[-1].stop == pytest.approx(0.4, rel=1e-12)


def test_on_ground_that_holds_one_way():
    """A rail between buffers with a gap: it buckles up at less warmth than it would rise from the ground without N."""
    supports = [along(0), along(1, side="left", gap=0.002)]
    beam = {"spans": [20.0], "EI": 1e3, "EA": 1e5, "alpha": 1e-5}
    loads = [own_weight(1.0), force(10.0, -12.0), warm(22.0)]
    scene = {"beam": beam, "supports": supports, "foundation": [{"k": 50.0, "side": "below"}], "loads": loads}
    result = gapbeam.solve(scene | {"analysis": FOLLOW})
    assert (result.events[0].support, result.events[0].event) == (1, "closes")
    right = gapbeam.solve({**given(scene, -1e5 * (2.2e-4 - 1e-4)), "foundation": scene["foundation"]})
    assert right.status == result.status == "solved"
    assert result.at(10.0).deflection == pytest.approx(right.at(10.0).deflection, rel=1e-12)
    assert result.at(10.0).moment == pytest.approx(right.at(10.0).moment, rel=1e-12)


def test_trains_pass_under_what_they_push():
    scene = pipe(60.0) | {"trains": [{"axles": [[0.0, 2.0], [1.5, 3.0]]}]}
    for k in (0, 2, 3):
        scene["supports"][k]["side"] = "both"
    N = -6e5 * (1.2e-5 * 60.0 - 0.01 / 24.0)
    passed, right = gapbeam.solve(scene), gapbeam.solve(given(scene, N) | {"trains": scene["trains"]})
    for name in ("moment", "deflection"):
        for one, other in zip(*(of.envelope().extremes[name].values() for of in (passed, right)), strict=True):
            assert one.value == pytest.approx(other.value, rel=1e-11)


@pytest.mark.parametrize(
    "more",
    [
        {"analysis": {"history": [1.0, 0.0], **FOLLOW}},
        {"supports": [at(x=4.0, side="below", gap=0.1, friction=0.3)]},
        {"supports": [at(x=4.0, law=[[0.01, 3.0], [1.0, 3.0]], unloading="plastic")]},
    ],
)
def test_beside_what_is_followed_with_memory_they_are_of_first_order(more):
    scene = pipe(60.0)
    scene["supports"] = scene["supports"] + more.get("supports", [])
    scene["analysis"] = more.get("analysis", {})
    result = gapbeam.solve(scene)
    assert not result._beam.feels_axial_loads
    hot = result.state(1.0, leg=0) if scene["analysis"] else result.state(1.0)
    assert hot.reaction[5] == pytest.approx(gapbeam.solve(pipe(60.0)).steps[-1].reaction[5], rel=1e-12)


def test_stretching_beside_them_is_refused():
    with pytest.raises(gapbeam.SceneError, match="stretching beside"):
        gapbeam.solve(pipe(60.0, stretching=True))
