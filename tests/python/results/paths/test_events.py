"""Events: the exact load factor of every change of the contact state."""

import random

import gapbeam
import numpy as np
import oracle
import pytest
from mpmath import mpf
from scenes import at, force, random_scene, scene, uniform

EVENTS = {"follow": "events"}


def solve(made):
    return gapbeam.solve({**made, "analysis": EVENTS})


def events(result):
    return [(event.factor, event.support, event.event) for event in result.events]


def test_midspan_gap_closes():
    """A simple beam meets a support with gap d at q = 76.8 EI d/L^4."""
    supports = [at(0), at(1, side="below", gap=0.01), at(2)]
    result = solve(scene([2.0, 2.0], supports, [uniform(10.0)], EI=3.0))
    assert events(result) == [(pytest.approx(76.8 * 3.0 * 0.01 / 4.0**4 / 10.0, rel=1e-14), 1, "closes")]


@pytest.mark.parametrize("way", [1.0, -1.0])
@pytest.mark.parametrize("friction", [0.0, 0.2])
def test_a_loose_hinge_turns_either_way(way, friction):
    """The couple grows past what the loads make at the hinge, which goes from one end of its slack to the other."""
    beam = {"spans": [4.0], "EI": 1000.0}
    loads = [{"type": "uniform", "q": way, "case": "dead"}, {"type": "moment", "x": 4.0, "M": 10.0 * way}]
    made = {"beam": beam, "loads": loads, "hinges": [{"x": 2.0, "slack": 0.01}]}
    supports = [{"node": 0}, {"node": 1, "friction": friction}, {"node": 0, "direction": "axial"}]
    result = solve({**made, "supports": supports})
    # q L^2/8 = lambda M/2
    assert [(event.event, event.factor) for event in result.events] == [
        (name, pytest.approx(0.4, rel=1e-12)) for name in ("turns", "opens", "closes")
    ]


def test_a_beam_that_turns_opens_first_and_closes_last():
    """A seesaw with 10 on its left arm tips as 20 on the right one reach half: onto the support 0.1 below."""
    supports = [at(1), at(0, side="below"), at(2, side="below", gap=0.1)]
    result = solve(scene([4.0, 4.0], supports, [force(0.0, 10.0, case="dead"), force(8.0, 20.0)], EI=1e4))
    assert events(result) == [(0.5, 1, "opens"), (0.5, 2, "turns"), (0.5, 2, "closes")]
    assert [state for _, state in result.history()] == [("bilateral", "closed", "open"), ("bilateral", "open", "closed")]
    assert result.state(1.0).reaction == pytest.approx([20.0, 0.0, 10.0], rel=1e-14)


def test_far_end_lifts():
    """Two equal spans on three one-sided supports: the far end lifts at q = 6 g exactly."""
    supports = [at(i, side="below") for i in range(3)]
    loads = [uniform(1.0, case="dead"), {**uniform(10.0), "to": 1.0}]
    result = solve(scene([1.0, 1.0], supports, loads))
    assert events(result) == [(pytest.approx(0.6, rel=1e-15), 2, "opens")]
    assert result.state(0.3).reaction == pytest.approx([0.4 + 3 * 7 / 16, 1.25 + 3 * 0.625, 0.375 - 3 / 16], abs=0.03)
    assert result.at(2.0, factor=1.0).deflection == pytest.approx(-4.0 / 24.0, rel=1e-13)


def test_plank_tips():
    """An overhanging force tips a plank of weight g when its moment reaches that of the weight."""
    supports = [at(0, side="below"), at(1, side="below")]
    loads = [{**uniform(1.0, case="dead"), "to": 1.0}, force(2.0, 10.0)]
    result = solve(scene([1.0, 1.0], supports, loads))
    assert result.status == "no-equilibrium"
    assert "above load factor 0.05:" in result.reason
    assert "tips about the support at x = 1: its left end goes up, its right end goes down" in result.reason
    assert [step.factor for step in result.steps] == [pytest.approx(0.05, rel=1e-15)]


def test_simultaneous_events():
    """A symmetric beam lifts off both its ends at once."""
    supports = [at(i, side="below") for i in range(4)]
    loads = [uniform(1.0, case="dead"), {**uniform(60.0), "from": 1.0, "to": 2.0}]
    result = solve(scene([1.0, 1.0, 1.0], supports, loads))
    assert [event.support for event in result.events] == [0, 3]
    assert result.events[0].factor == pytest.approx(result.events[1].factor, rel=1e-14)


def test_paper_beam_has_no_event():
    """Without gaps the scheme is the same at every load factor above 0."""
    supports = [at(0, rotation="fixed"), at(1, side="above"), at(2, side="below"), at(3, side="below")]
    loads = [force(2.0, 0.70707), force(4.0, -4.3597), force(6.0, 2.1155)]
    result = solve(scene([2.0, 2.0, 2.0], supports, loads, EI=44.5))
    assert result.events == []
    assert result.steps[-1].state == ("bilateral", "closed", "open", "closed")


def test_abaqus_stops():
    """Reference P2: the stop at x = 3 acts first, that at x = 1 joins in between P = 120 and 140."""
    supports = [at(0, rotation="fixed"), at(1, side="below", gap=0.01), at(3, side="below", gap=0.01)]
    result = solve(scene([1.0] * 5, supports, [force(2.0, 200.0)], EI=2162.7))
    assert [(event.support, event.event) for event in result.events] == [(2, "closes"), (1, "closes")]
    assert 120 < 200 * result.events[1].factor < 140


# Beams that lose their hold at half of the load, at once, on both ends, at 0.3; the last one has nothing to turn against there.
TURNING = {
    "seesaw": scene(
        [4.0, 4.0],
        [at(1), at(0, side="below"), at(2, side="below", gap=0.1)],
        [force(0.0, 10.0, case="dead"), force(8.0, 20.0)],
        EI=1e4,
    ),
    "seesaw without weight": scene(
        [4.0, 4.0],
        [at(1), at(0, side="below", gap=0.01), at(2, side="below", gap=0.01)],
        [force(8.0, 20.0)],
        EI=1e4,
    ),
    "shaft": scene(
        [400.0, 400.0],
        [at(node, side=side, gap=0.06) for node in (0, 2) for side in ("below", "above")],
        [uniform(0.151, case="dead"), force(400.0, -3000.0)],
        EI=6.32e10,
    ),
    "overhang with an uplift bearing": scene(
        [4.0, 2.0],
        [at(0, side="below"), at(0, side="above", gap=0.01), at(1, side="below")],
        [uniform(1.0, case="dead"), force(6.0, 10.0)],
        EI=1e4,
    ),
    "overhang": scene(
        [4.0, 2.0],
        [at(0, side="below"), at(1, side="below")],
        [uniform(1.0, case="dead"), force(6.0, 10.0)],
        EI=1e4,
    ),
}


@pytest.mark.parametrize("name", TURNING)
def test_status_and_states_never_contradict(name):
    """Where the path says that the beam stands it has a state, that of the load alone; where not, it has none."""
    made = TURNING[name]
    path = solve(made)
    assert path.status == ("no-equilibrium" if name == "overhang" else "solved")
    reached = path.path.segments[-1].stop if path.status == "no-equilibrium" else 1.0
    events_at = {event.factor for event in path.events} | {reached}
    steps = [share / 16 for share in range(1, 17)]
    for factor in sorted({*steps, *(near for place in events_at for near in (place - 1e-6, place + 1e-6) if 0.0 < near <= 1.0)}):
        loads = [{**load, "F": factor * load["F"]} if load.get("case") != "dead" else load for load in made["loads"]]
        alone = gapbeam.solve({**made, "loads": loads})
        assert alone.status == ("solved" if factor <= reached else "no-equilibrium"), factor
        if factor > reached:
            with pytest.raises(ValueError, match="there is no equilibrium at load factor"):
                path.at(0.0, factor=factor)
            continue
        state = path.state(factor)
        assert state.indifferent == alone.steps[-1].indifferent, factor
        if state.indifferent:
            continue  # where it turns it may be anywhere on its way
        assert state.state == alone.steps[-1].state, factor
        for x in (0.0, sum(made["beam"]["spans"])):
            w = alone.at(x).deflection
            assert path.at(x, factor=factor).deflection == pytest.approx(w, rel=1e-9, abs=1e-12)


def test_what_touches_without_weight():
    """Two bodies without weight on soft one-sided supports, bent by imposed curvature: where they lie is not unique, forces are."""
    made = {
        "beam": {"spans": [5.5, 3.85], "EI": 35900.0, "hinges": [5.5]},
        "supports": [
            {"node": 1, "side": "below", "gap": 0.0014, "stiffness": 14500.0, "settlement": -0.0047},
            {"node": 0, "side": "below", "stiffness": 44300.0, "settlement": 0.0121},
        ],
        "sections": [{"from": 4.675, "to": 7.0125, "EI": 97900.0}],
        "loads": [{"type": "curvature", "kappa": -0.00079, "from": 1.16875, "to": 5.84375}],
    }
    path = solve(made)
    assert path.status == "solved"
    for step in (*path.steps, *gapbeam.solve(made).steps):
        assert step.indifferent
        assert np.abs(step.reaction).max() == 0.0


def crossing(made, segment, opens, support):
    """Exact load factor at which reaction or opening of a support is zero, from two states inside a segment."""
    exact = oracle.Oracle(made)
    factors = [segment.start + (segment.stop - segment.start) * share for share in (0.25, 0.75)]
    states = [exact.solve(factor) for factor in factors]
    if any(not state.reaction for state in states):
        return None  # indifferent: the position is not unique, so gaps have no values
    values = [mpf(state.reaction[support] if opens else state.opening[support]) for state in states]
    if values[0] == values[1] == 0:
        return None  # it touched without force and left when another support began to act
    return mpf(factors[0]) - values[0] * (mpf(factors[1]) - mpf(factors[0])) / (values[1] - values[0])


def followed_path(made):
    """None where the beam can move freely without work: no single path exists, and it is said so."""
    try:
        return solve(made)
    except gapbeam.EngineError as error:
        if "can move freely without work" not in str(error):
            raise
        return None


@pytest.mark.parametrize("block", range(10))
def test_random_paths(block):
    """The path ends where a direct solve ends, and every event is where it should be."""
    followed = 0
    for seed in range(100 * block, 100 * block + 100):
        rng = random.Random(seed)
        made = random_scene(rng, held=rng.choice((True, None)))
        made["analysis"] = {}
        direct = gapbeam.solve(made)
        path = followed_path(made)
        if path is None or path.status != "solved":
            # The beam may stand again at factor 1, but not all the way there
            continue
        assert direct.status == "solved"
        followed += 1
        scale = max(np.abs(direct.steps[-1].reaction).max(initial=0.0), 1e-6)
        assert path.steps[-1].reaction == pytest.approx(direct.steps[-1].reaction, abs=1e-11 * scale), seed
        turns = {event.factor for event in path.events if event.event == "turns"}
        for event in path.events:
            if event.factor in turns:
                continue  # the beam moves a finite way there: openings jump
            before = [segment for segment in path.segments if segment.stop == event.factor]
            normal = path._beam.numbers.tolist().index(event.support)
            if not before or normal != event.support:
                continue  # axial supports shift the numbering; other seeds do
            true = crossing(made, before[0], path.path.closed(before[0])[event.support], event.support)
            assert true is None or abs(true - event.factor) <= 1e-12, (seed, event)
    assert followed > 50


def long_beam(spans):
    """A beam over supports with gaps that close one by one, here and there."""
    supports = [at(i, side="below", gap=0.02 * ((7 * i) % 11) / 11) for i in range(spans + 1)]
    supports[0] = at(0)
    supports[-1] = at(spans)
    loads = [{**uniform(0.2 + 1.8 * ((13 * i) % 17) / 17), "from": float(i), "to": i + 1.0} for i in range(spans)]
    return scene([1.0] * spans, supports, [*loads, uniform(0.5, case="dead")], EI=3.0)


def test_an_event_costs_what_it_changes():
    """Not more nodes an event in a beam ten times as long, and no solve of the whole beam for it."""
    costs, solves = [], []
    for spans in (300, 3000):
        result = solve(long_beam(spans))
        assert len(result.events) > spans / 20
        assert result.path.solves < 15
        costs.append(result.path.nodes / len(result.events))
        solves.append(result.path.solves)
        last = gapbeam.solve({**long_beam(spans), "analysis": {}}).steps[-1]
        assert last.state == result.steps[-1].state
        assert result.steps[-1].solves == 1
    assert costs[1] < 1.2 * costs[0] < 200
