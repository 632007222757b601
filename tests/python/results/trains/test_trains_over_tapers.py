"""Trains over sections that taper and hinges with a stiffness, beside the states of the beam with the axles as forces."""

import random

import gapbeam
import numpy as np
import pytest
from attack.trains import draw_scene
from scenes import nodes_of
from scenes.tapered import taper, with_joints, with_tapers
from scenes.train import frozen, random_scene
from scenes.units import in_units

PAIRED = {
    "beam": {"spans": [6.75, 4.75, 5.125], "EI": 6500.0, "N": 1e-9},
    "supports": [{"node": 0, "stiffness": 832.0, "rotation": "fixed"}, {"node": 1, "side": "below", "gap": 0.0078125},
                 {"node": 2, "side": "below", "gap": 0.001953125},
                 {"node": 3, "side": "below", "gap": 0.0078125, "stiffness": 208.0}],
    "sections": [{"from": 4.75, "to": 6.875, "EI": 10500.0}],
    "loads": [{"type": "uniform", "q": 1.21875, "case": "dead"}],
    "trains": [{"name": "axle", "axles": [[0.0, 58.5]]}],
}  # fmt: skip


def drawn(seed):
    """A beam on one-sided supports with a section that tapers, and stiff hinges, under a train."""
    rng = random.Random(seed)
    while True:
        _, made = draw_scene(rng.randrange(10**6))
        if np.isfinite(made["beam"]["EI"]).all():
            break
    length, EI = nodes_of(made)[-1], float(np.min(made["beam"]["EI"]))
    start = rng.randrange(int(4 * length)) / 8
    made.setdefault("sections", []).append({"from": start, "to": start + 0.5, "EI": taper(rng, EI)})
    return with_joints(rng, made)


@pytest.mark.parametrize("seed", range(8))
def test_states_are_within_the_envelope_and_as_with_forces(seed):
    made = drawn(seed)
    result = gapbeam.solve(made)
    train, envelope = result.trains["train"], result.envelope()
    rng = random.Random(seed)
    for way in train.traversals:
        for position in (rng.uniform(way.course.from_, way.course.to) for _ in range(8)):
            still = gapbeam.solve(frozen(made, position, way.course.direction == "left"))
            if still.status != "solved":
                continue
            reaction = still.steps[-1].reaction
            state = train.state(position, way.course.direction)
            np.testing.assert_allclose(state.reaction, reaction, rtol=0.0, atol=1e-10 * np.abs(reaction).max())
            for name in ("deflection", "moment", "shear"):
                ends = envelope.extremes[name]
                size = max(abs(end.value) for end in ends.values())
                assert still.extremes[name]["max"].value <= ends["max"].value + 1e-10 * size
                assert still.extremes[name]["min"].value >= ends["min"].value - 1e-10 * size


def test_a_haunched_girder_rises_where_its_influence_line_does():
    """A symmetrical beam of two equal spans: what one axle makes at the middle support, by the integral of its bending (Betti)."""
    EI = {"from": 1.0, "to": 8.0, "power": 3}
    made = {"beam": {"spans": [1.0, 1.0], "EI": 1.0}, "supports": [{"node": k} for k in range(3)],
            "sections": [{"from": 0.0, "to": 1.0, "EI": EI}, {"from": 1.0, "to": 2.0, "EI": {**EI, "from": 8.0, "to": 1.0}}],
            "trains": [{"name": "axle", "axles": [[0.0, 1.0]]}]}  # fmt: skip
    train = gapbeam.solve(made).trains["axle"]
    x = (np.arange(20000) + 0.5) / 20000
    for s in (0.25, 0.5, 0.7):
        bent = np.where(x < s, x * (1 - s), s * (1 - x)) * x / (1 + x) ** 3
        there = -bent.sum() / (2 * (x**2 / (1 + x) ** 3).sum())
        assert train.state(s).fields(1.0).moment == pytest.approx(there, rel=1e-7)


def test_supports_change_where_they_do_without_axial_force():
    """Next to a change of a rigid support beside a short piece its state was undecided; it was noted at the next place asked."""
    results = [gapbeam.solve(made) for made in (PAIRED, {**PAIRED, "beam": {**PAIRED["beam"], "N": 0.0}})]
    where = [[(e.support, e.event, e.position) for e in one.trains["axle"].traversals[0].events] for one in results]
    assert [event[:2] for event in where[0]] == [event[:2] for event in where[1]]
    np.testing.assert_allclose([event[2] for event in where[0]], [event[2] for event in where[1]], rtol=1e-9)


@pytest.mark.parametrize("seed", [5, 8, 56])
def test_positions_of_events_do_not_depend_on_units(seed):
    """A support has a force on one side of an event, a distance on the other. Nearly prismatic, they are polynomials' roots."""
    made = random_scene(seed)
    length, EI = sum(made["beam"]["spans"]), made["beam"]["EI"]
    right = None
    if not isinstance(EI, list):
        right = events_of(made)
        made["sections"] = [{"from": 0.0, "to": length, "EI": [EI, EI * (1.0 + 2.0**-51)]}]
    else:
        made = with_tapers(random.Random(seed), made)
    found = events_of(made)
    assert found
    if right is not None:
        assert [one[1:] for one in found] == [one[1:] for one in right]
        assert [one[0] for one in found] == pytest.approx([one[0] for one in right], abs=1e-12 * length)
    for force, unit in ((2.0**10, 1.0), (1.0, 2.0**-7)):
        other = events_of(in_units(made, force, unit))
        assert [one[1:] for one in other] == [one[1:] for one in found]
        assert [one[0] / unit for one in other] == pytest.approx([one[0] for one in found], abs=1e-11 * length)


def events_of(made):
    return [(one.position, one.support, one.event) for train in gapbeam.solve(made).trains.values() for one in train.events]


def spring(node, **keys):
    return {"node": node, "side": "below", **keys}


@pytest.mark.parametrize(("spans", "EI", "supports", "axles", "q"), [
    # The state at the very end touches a support without force, which another one then opened
    ([3.0, 5.0, 6.0, 5.0], 1e4, [spring(0, gap=0.005), {"node": 1}, spring(2), spring(3, gap=0.002), {"node": 4}],
     [[0.0, 74.0], [2.0, 129.0]], 0.0),
    # An axle so near a support that rounding hides for 6e-6 whether the next one pushes: the event was at the end of that
    ([6.0, 3.0, 4.0, 5.0], 1e4, [{"node": 0}, spring(1, gap=0.002), spring(2, gap=0.002), spring(3, stiffness=5e5), {"node": 4}],
     [[0.0, 58.0]], 1.0),
    # Undecided just before it opens: the event was lost
    ([3.0, 4.0, 6.0, 3.0], 2e3, [{"node": 0, "stiffness": 5e5}, spring(1), spring(2, gap=0.001),
                                 spring(3, gap=0.002, stiffness=1e4), {"node": 4}], [[0.0, 75.0]], 0.0),
])  # fmt: skip
def test_events_over_a_taper_by_a_rounding_are_those_without_it(spans, EI, supports, axles, q):
    made = {"beam": {"spans": spans, "EI": EI}, "supports": supports, "trains": [{"name": "t", "axles": axles}],
            "loads": [{"type": "uniform", "q": q, "case": "dead"}] if q else []}  # fmt: skip
    right = gapbeam.solve(made).trains["t"].events
    found = gapbeam.solve({**made, "sections": [{"EI": [EI, np.nextafter(EI, np.inf)]}]}).trains["t"].events
    assert [(one.support, one.event) for one in found] == [(one.support, one.event) for one in right]
    assert [one.position for one in found] == pytest.approx([one.position for one in right], abs=1e-10)


def test_changes_too_near_each_other_to_be_told_apart_are_nowhere_else():
    """Three of two supports within 3e-11: two that undo each other are not seen, and no support stays closed after that."""
    made = {"beam": {"spans": [3.0, 4.0, 6.0, 4.0], "EI": 2e3},
            "supports": [{"node": 0}, spring(1, gap=0.001, stiffness=1e4), spring(2, gap=0.002), spring(3, gap=0.002), {"node": 4}],
            "trains": [{"name": "t", "axles": [[0.0, 34.0], [2.0, 142.0]]}],
            "sections": [{"EI": [2e3, np.nextafter(2e3, np.inf)]}]}  # fmt: skip
    *_, last = gapbeam.solve(made).trains["t"].events
    assert (last.support, last.event, last.position) == (2, "opens", pytest.approx(18.9982897384, abs=1e-9))
