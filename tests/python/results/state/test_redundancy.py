"""Rigid stretches on more one-sided rigid supports than they need: refused where other reactions would do, and only there."""

import itertools
import math

import gapbeam
import numpy as np
import pytest
from gapbeam import Status
from scenes import at, force, one_sided, scene, uniform

RIGID = {"EI": math.inf}


def below(node, **keys):
    return at(node, side="below", **keys)


three = [below(0), below(1), below(2)]
chain = [below(0), below(1), below(3), below(4)]
SCENES = {
    "load over the middle of three": (scene([1.0, 1.0], three, [force(1.0, 6.0)], **RIGID), None),
    "load beside it": (scene([1.0, 1.0], three, [force(0.5, 6.0)], **RIGID), None),
    "load over the first: the others carry nothing": (
        scene([1.0, 1.0], three, [force(0.0, 6.0)], **RIGID),
        [6.0, 0.0, 0.0],
    ),
    "no load": (scene([1.0, 1.0], three, [], **RIGID), [0.0, 0.0, 0.0]),
    "the middle one is out of reach": (
        scene([1.0, 1.0], [below(0), below(1, gap=0.1), below(2)], [force(1.0, 6.0)], **RIGID),
        [3.0, 0.0, 3.0],
    ),
    "the middle one yields": (
        scene([1.0, 1.0], [below(0), below(1, stiffness=9.0), below(2)], [force(1.0, 6.0)], **RIGID),
        [3.0, 0.0, 3.0],
    ),
    "the first holds both ways": (
        scene([1.0, 1.0], [at(0), below(1), below(2)], [force(0.0, 6.0)], **RIGID),
        [6.0, 0.0, 0.0],
    ),
    "the middle one holds both ways": (
        scene([1.0, 1.0], [below(0), at(1), below(2)], [force(1.0, 6.0)], **RIGID),
        None,
    ),
    "held from above and from below": (
        scene(
            [1.0, 1.0],
            [at(0), below(1), at(1, side="above"), at(2, side="above")],
            [force(1.0, 6.0)],
            **RIGID,
        ),
        None,
    ),
    "a hinge leaves the outer supports idle": (
        scene([1.0] * 4, chain, [uniform(2.0)], hinges=[2.0], **RIGID),
        [0.0, 4.0, 4.0, 0.0],
    ),
    "one of them pressed as well": (
        scene([1.0] * 4, chain, [uniform(2.0), force(0.0, 1.0)], hinges=[2.0], **RIGID),
        None,
    ),
    "an elastic span between two rigid ones": (
        scene([1.0, 1.0, 1.0], [below(i) for i in range(4)], [force(1.5, 8.0)], EI=[math.inf, 1.0, math.inf]),
        [0.0, 4.0, 4.0, 0.0],
    ),
    "fixed against rotation": (
        scene([1.0, 1.0], [at(0, rotation="fixed"), below(1)], [force(1.0, 6.0)], **RIGID),
        None,
    ),
    "rigid but for shear": (scene([1.0, 1.0], three, [force(1.0, 6.0)], GA=2.0, **RIGID), [0.0, 6.0, 0.0]),
}


@pytest.mark.parametrize("name", SCENES)
def test_closed_forms_from_every_start(name):
    made, reaction = SCENES[name]
    for start in itertools.product((True, False), repeat=len(one_sided(made))):
        if reaction is None:
            with pytest.raises(
                gapbeam.EngineError, match="more rigid supports than statics can tell apart"
            ) as refused:
                gapbeam.solve(made, start=start)
            assert refused.value.status == Status.INDETERMINATE
        else:
            assert gapbeam.solve(made, start=start).steps[-1].reaction == pytest.approx(reaction, abs=1e-14)


def test_cases_and_combinations_say_which():
    loads = [force(1.0, 6.0, case="middle"), force(0.0, 6.0, case="end")]
    made = scene([1.0, 1.0], three, loads, **RIGID)
    for start in itertools.product((True, False), repeat=3):
        cases = gapbeam.prepare(made).solve(np.array([[1.0, 0.0], [0.0, 1.0]]), start=start)
        assert cases.status.tolist() == [Status.INDETERMINATE, Status.SOLVED]
        assert np.isnan(cases.reaction[0]).all()
        assert cases.reaction[1].tolist() == [6.0, 0.0, 0.0]
    made["combinations"] = [{"name": name, "factors": {name: 1.0}} for name in ("middle", "end")]
    assert gapbeam.solve(made).statuses == ("indeterminate", "solved")


def test_where_the_load_path_comes_to_it():
    """On springs at its ends the beam comes down on three supports at once: from there on nobody knows their shares."""
    supports = [at(0, stiffness=1.0), *(below(i, gap=1.0) for i in (1, 2, 3)), at(4, stiffness=1.0)]
    made = scene([1.0] * 4, supports, [force(2.0, 10.0)], **RIGID)
    made["analysis"] = {"follow": "events"}
    with pytest.raises(gapbeam.EngineError, match=r"at load factor 0\.2: a rigid stretch"):
        gapbeam.solve(made)
    made["loads"][0]["F"] = 2.0  # until they touch
    assert gapbeam.solve(made).steps[-1].reaction.tolist() == [1.0, 0.0, 0.0, 0.0, 1.0]


def test_trains_and_foundations():
    made = scene([1.0, 1.0], three, [], **RIGID) | {"trains": [{"name": "t", "axles": [[0.0, 6.0]]}]}
    (gap,) = gapbeam.solve(made).trains["t"].unstable_positions
    assert (gap.from_, gap.to) == (0.0, 2.0)
    assert "statics can tell apart" in gap.reason
    made = scene([1.0, 1.0], three, [force(1.0, 6.0)], **RIGID)
    made["foundation"] = [{"k": 4.0, "side": "below"}]
    with pytest.raises(gapbeam.EngineError, match="more rigid supports than statics can tell apart"):
        gapbeam.solve(made)


def test_where_the_reactions_of_a_load_path_go_from_one_support_to_another():
    """A rigid beam that bends by what is imposed touches three supports at once, at one load factor."""
    supports = [at(0), below(1), below(2, gap=0.002)]
    made = scene([3.0, 3.0], supports, [force(4.0, 10.0), {"type": "curvature", "kappa": 5e-4}], **RIGID)
    made["analysis"] = {"follow": "events"}
    result = gapbeam.solve(made)
    assert [(event.support, event.event, event.factor) for event in result.events] == [
        (1, "opens", pytest.approx(4 / 9)), (2, "closes", pytest.approx(4 / 9))]  # fmt: skip
    at_event, last = result.steps
    assert at_event.reaction == pytest.approx(np.array([-1 / 3, 4 / 3, 0]) * 40 / 9)
    assert last.reaction == pytest.approx([10 / 3, 0, 20 / 3])
    made["foundation"] = [{"k": 100.0}]  # a state at an event is there to be read, too
    result = gapbeam.solve(made)
    assert [event.support for event in result.events] == [1, 2]
    assert result.steps[0].state == ("bilateral", "closed", "open")
    assert result.steps[0].reaction[1] > 0.0


@pytest.mark.parametrize(("spans", "supports"), [
    ([1.0, 1.0], [below(1, gap=-0.001)]),
    ([1.0, 1.0], [at(0, side="above", gap=0.003), below(1, gap=0.002), below(2, gap=-0.001)]),
    ([6.0, 4.0, 6.0, 6.0], [at(2, side="above", gap=0.002, settlement=0.001, stiffness=1000.0), at(3, side="above", gap=0.005),
                            below(None, gap=0.001, stiffness=100.0, x=1.04)]),
])  # fmt: skip
def test_a_rigid_beam_without_load_has_no_forces(spans, supports):
    """Nothing bends with which what rounding leaves could be compared: such states were refused by their audit."""
    made = scene(spans, supports, [], **RIGID)
    result = gapbeam.solve(made)
    assert result.status == "solved"
    assert not result.steps[-1].reaction.any()
    loaded = {**made, "loads": [force(1.0, 1.0)], "analysis": {"follow": "events"}}
    assert gapbeam.solve(loaded).status == gapbeam.solve({**loaded, "analysis": {}}).status
