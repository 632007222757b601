"""Paths of many supports: under axial forces and on ground as elsewhere, and symmetric ones as others."""

import contextlib

import gapbeam
import pytest
from scenes import at, force


def pads(spans, beam, **analysis):
    """Equal spans on pads of five kinds, from both ends alike, that yield and go on."""
    kinds = [min(k, spans - k) % 5 for k in range(spans + 1)]
    supports = [{"node": k, "side": "below",
                 "law": {"type": "hardening", "stiffness": 2e3, "limit": 30.0 + 4.0 * kind, "slope": 300.0}, "unloading": "plastic"}
                for k, kind in enumerate(kinds)]  # fmt: skip
    supports[0], supports[-1] = {"node": 0}, {"node": spans}
    return {"beam": {"spans": [6.0] * spans, "EI": 1e4} | beam, "supports": supports,
            "loads": [{"type": "uniform", "q": 7.0}], "analysis": {"follow": "events"} | analysis}  # fmt: skip


@pytest.mark.parametrize(("N", "k"), [(100.0, None), (-20.0, 2.0)], ids=["tension", "compression on ground"])
def test_an_event_takes_two_solves(N, k):
    """Of the whole beam, one for the dead and one for the live loads; and every pad is at its limit where it yields."""
    scene = pads(40, {"N": N})
    if k:
        scene["foundation"] = [{"k": k}]
    for support in scene["supports"]:
        support.pop("unloading", None)
    result = gapbeam.solve(scene)
    assert len(result.events) > 20
    assert result.path.solves < 4 * len(result.events) + 20
    for event in result.events:
        reaction = result.state(event.factor).reaction[event.support]
        assert reaction == pytest.approx(scene["supports"][event.support]["law"]["limit"], rel=1e-11)


def test_mirror_images_take_no_solve_of_the_whole_beam():
    """Supports that reach their limits in pairs, and turn back in pairs, are as cheap as single ones."""
    result = gapbeam.solve(pads(60, {}, history=[1.0, 0.3, 1.2]))
    events = [(event.support, event.event, event.factor) for event in result.events]
    assert {event for _, event, _ in events} == {"yields", "unloads"}
    assert sorted((support, event) for support, event, _ in events) == sorted((60 - support, event) for support, event, _ in events)
    assert result.path.solves < 20
    state = result.steps[-1]
    assert state.reaction == pytest.approx(state.reaction[::-1], rel=1e-12)
    assert state.set[1:-1] == pytest.approx(state.set[1:-1][::-1], rel=1e-12)


def test_mirror_images_beside_curves():
    """Both of a pair close at one load factor, on the curves: each is at its gap there."""
    stop = {"side": "below", "gap": 0.0076, "law": {"type": "power", "d0": 0.01, "limit": 28.6, "n": 2}}
    curve = {"side": "below", "law": {"type": "hyperbolic", "stiffness": 28760.0, "limit": 56.0}}
    pad = {"side": "below", "law": {"type": "hardening", "stiffness": 694.0, "limit": 39.7, "slope": 208.0}}
    kinds = [{}, stop, curve, pad, {"side": "below", "stiffness": 1320.0}, pad, curve, stop, {}]
    forces = [(0.15, 17.3), (53.47, 17.3), (10.95, 16.1), (42.67, 16.1)]
    scene = {"beam": {"spans": [7.98, 7.45, 5.63, 5.75, 5.75, 5.63, 7.45, 7.98], "EI": 1785.0},
             "supports": [{"node": k, **kind} for k, kind in enumerate(kinds)],
             "loads": [{"type": "force", "x": x, "F": F} for x, F in forces],
             "analysis": {"follow": "events", "history": [1.0, 0.1]}}  # fmt: skip
    result = gapbeam.solve(scene)
    left, right = (event for event in result.events if event.event == "closes" and event.support in (1, 7) and event.factor < 1.0)
    assert left.factor == pytest.approx(right.factor, rel=1e-14)
    assert result.state(left.factor, leg=0).deflection[[1, 7]] == pytest.approx([0.0076, 0.0076], rel=1e-11)


def test_a_path_that_goes_back_to_its_beginning():
    """So little tension that no sign beyond the first event is told: what is known up to there is recorded anew."""
    made = {
        "beam": {"spans": [4.0, 4.0, 4.0, 0.7], "EI": 10000.0, "N": 1e-13}, "analysis": {"follow": "events"},
        "supports": [{"node": 0, "side": "above", "stiffness": 10000.0},
                     {"node": 1, "side": "below", "law": [[0.004, 8.0], [0.008, 8.0]]},
                     {"node": 2, "side": "above"}, {"node": 3, "side": "below"}, {"x": 5.333333333333333}],
        "loads": [{"type": "force", "x": 8.0, "F": -5.0}, {"type": "force", "x": 0.4, "F": 50.0}],
    }  # fmt: skip
    with contextlib.suppress(gapbeam.EngineError):  # its signs cannot be told from rounding; the process went, before
        assert gapbeam.solve(made).steps[-1].reaction == pytest.approx([0.0, 8.0, -123.0, 11.8, 148.2], rel=1e-9)


@pytest.mark.parametrize("N", [-1e-2, -1e-6])
def test_a_path_under_next_to_no_compression_ends(N):
    """Next to where a support yields no share of the axial force leads on; without one that is where the beam gives way."""
    made = {
        "beam": {"spans": [4.0, 4.0, 4.0, 0.7], "EI": 1e4},
        "supports": [at(1, law=[[0.004, 8.0], [0.008, 8.0]]), at(2), at(3, side="below")],
        "loads": [force(0.4, 50.0)],
        "analysis": {"follow": "events"},
    }
    without = gapbeam.solve(made)
    result = gapbeam.solve({**made, "beam": {**made["beam"], "N": N}})
    assert (without.status, result.status) == ("limit-load", "buckles")
    ((first, event), (second, other)) = (((one.events[0].factor, one.events[0].event)) for one in (without, result))
    assert event == other == "yields"
    assert 0 < first - second < -1e-4 * N
