"""Lumped masses, and the amplitudes at which modes open or close supports."""

import math
import random

import gapbeam
import numpy as np
import pytest
from gapbeam.base.errors import SceneError
from oracle.axial_modes import frequencies
from scenes import force, scene, uniform


def test_closed_forms():
    """A mass in the middle of a simple beam, at the end of a cantilever, and at the end of a hanging pendulum."""
    simple = scene([1.0], [{"node": 0}, {"node": 1}], [], EI=1.0)
    data = {**simple, "masses": [{"x": 0.5, "mass": 3.0}], "analysis": {"frequencies": 3}}
    assert gapbeam.solve(data).frequencies == pytest.approx([4.0], rel=1e-14)
    data = {**scene([2.0], [{"node": 0, "rotation": "fixed"}], [], EI=5.0), "masses": [{"node": 1, "mass": 0.5}]}
    result = gapbeam.solve({**data, "analysis": {"frequencies": 1}})
    assert result.frequencies == pytest.approx([math.sqrt(3.0 * 5.0 / 8.0 / 0.5)], rel=1e-14)
    assert result.mode("vibration").deflection[-1] == 1.0
    string = {**scene([1.0], [{"node": 0}], [], EI=1.0), "masses": [{"node": 1, "mass": 2.0}], "analysis": {"frequencies": 1}}
    string["beam"]["N"] = 8.0
    assert gapbeam.solve(string).frequencies == pytest.approx([2.0], rel=1e-14)


def test_masses_at_one_place_add_up_and_held_ones_do_not_move():
    simple = scene([1.0], [{"node": 0}, {"node": 1}], [], EI=1.0, mass=1.0)
    one = {**simple, "masses": [{"x": 0.25, "mass": 3.0}], "analysis": {"frequencies": 4}}
    three = {**one, "masses": [{"x": 0.25, "mass": 1.0}, {"node": 0, "mass": 9.0}, {"x": 0.25, "mass": 2.0}]}
    assert gapbeam.solve(one).frequencies == gapbeam.solve(three).frequencies


def drawn(seed):
    """A beam with lumped masses, some without any other, on supports, springs and ground, pulled or pressed."""
    draw = random.Random(seed)
    n = draw.randint(1, 4)
    spans = [draw.choice([0.5, 1.0, 2.0]) for _ in range(n)]
    nodes = [i for i in range(n + 1) if i in (0, n) or draw.random() < 0.7]
    supports = [{"node": i, "stiffness": draw.choice([math.inf, 10.0, 1e3])} for i in nodes]
    supports[0]["rotation"] = draw.choice(["free", "fixed", 3.0])
    data = scene(spans, supports, [], EI=[draw.choice([0.5, 1.0, 4.0]) for _ in spans])
    data["beam"]["N"] = [draw.choice([0.0, 5.0, -0.3, 40.0]) for _ in spans]
    if draw.random() < 0.6:
        data["beam"]["mass"] = [draw.choice([0.0, 0.5, 2.0]) for _ in spans]
    if draw.random() < 0.3:
        data["foundation"] = [{"k": draw.choice([1.0, 100.0])}]
    data["masses"] = [{"x": draw.uniform(0.0, sum(spans)), "mass": 10 ** draw.uniform(-2, 2)} for _ in range(draw.randint(1, 4))]
    if draw.random() < 0.3:
        data["masses"].append({"node": draw.randint(0, n), "mass": 1.0})
    return data


@pytest.mark.parametrize("seed", range(20))
def test_random_beams(seed):
    """All there are, beside counts in 40 digits."""
    data = drawn(seed)
    result = gapbeam.solve({**data, "analysis": {"frequencies": 4}})
    assert result.status == "solved"
    expected = frequencies(data, range(len(data["supports"])), 4)
    assert len(result.frequencies) == len(expected)
    np.testing.assert_allclose(result.frequencies, [float(value) for value in expected], rtol=1e-12)


def test_amplitudes():
    """Of the first mode of two spans under their weight: what opens the middle support, and what closes a stop beside them."""
    supports = [{"node": 0}, {"node": 1, "side": "below"}, {"node": 2}, {"x": 0.5, "side": "above", "gap": 0.02}]
    data = scene([1.0, 1.0], supports, [uniform(1.0)], EI=1.0, mass=1.0)
    data["analysis"] = {"frequencies": 2}
    result = gapbeam.solve(data)
    first, second = (result.mode("vibration", k) for k in (1, 2))
    # The first has a node at the middle support, which so stays; the stop has its gap and the deflection of the beam there
    opening = 0.02 + result.at(0.5).deflection
    at_stop = abs(first.deflection[np.argmin(abs(first.x - 0.5))])
    assert (first.support, first.amplitude) == (3, pytest.approx(opening / at_stop, rel=1e-12))
    # The second pulls at the middle support by the jump of its shear, as its moments at both sides of it have
    left, right = (second.moment[side][np.argmin(abs(second.x - 1.0))] for side in (0, 1))
    assert left == pytest.approx(right)
    without = gapbeam.solve({**data, "supports": supports[:3]}).mode("vibration", 2)
    beta = 15.41820571698**0.5
    here = without.x[without.x <= 1.0]
    largest = max(abs(np.sin(beta * here) - math.sin(beta) / math.sinh(beta) * np.sinh(beta * here)))
    rate = 2.0 * beta**3 * abs(math.cos(beta) + math.sin(beta) / math.tanh(beta)) / largest
    assert (without.support, without.amplitude) == (1, pytest.approx(1.25 / rate, rel=1e-9))
    assert "opens" in result.report() or "closes" in result.report()
    alone = gapbeam.solve({**data, "supports": [{"node": 0}, {"node": 2}]}).mode("vibration", 1)
    assert (alone.support, alone.amplitude) == (None, math.inf)


@pytest.mark.parametrize(
    ("mass", "place", "words"),
    [
        ({"x": 2.0, "mass": 1.0}, "masses[0].x", "2 is outside the beam, which runs from x = 0 to x = 1"),
        ({"node": 5, "mass": 1.0}, "masses[0].node", "there is no node 5; the nodes of the beam are 0 to 1"),
        ({"x": 0.5, "node": 0, "mass": 1.0}, "masses[0]", "give one of the two"),
        ({"x": math.nan, "mass": 1.0}, "masses[0].x", "nan is outside the beam"),
        ({"x": 0.5, "mass": math.nan}, "masses[0].mass", "expected a finite number, 0 or more, got nan"),
        ({"x": 0.5, "mass": -1.0}, "masses[0].mass", "0 or more"), ({"x": 0.5}, "masses[0].mass", "missing"),
        ({"mass": 1.0}, "masses[0]", "its position is missing; give node or x"),
    ],
)  # fmt: skip
@pytest.mark.parametrize("frequencies", [0, 1])
def test_what_is_refused(mass, place, words, frequencies):
    simple = scene([1.0], [{"node": 0}, {"node": 1}], [uniform(1.0), force(0.5, 1.0)], EI=1.0)
    with pytest.raises(SceneError) as caught:
        gapbeam.solve({**simple, "masses": [mass], "analysis": {"frequencies": frequencies}})
    assert caught.value.place == place
    assert words in str(caught.value)


def test_modes_of_steps_and_under_trains():
    """Every state has modes of its own: under half the load a support is still open, and an axle opens another one."""
    supports = [{"node": 0}, {"node": 1}, {"node": 2, "side": "below", "gap": 0.008}]
    made = scene([4.0, 4.0], supports, [uniform(3.0)], EI=1e4, mass=0.5)
    made |= {"analysis": {"frequencies": 2, "steps": 8}, "trains": [{"axles": [[0.0, 90.0]]}]}
    still = {key: value for key, value in made.items() if key != "trains"}
    steps = gapbeam.solve(still).steps
    assert [step.state[2] for step in steps] == sorted((step.state[2] for step in steps), reverse=True)
    assert {step.state[2] for step in steps} == {"open", "closed"}
    for step in steps:
        alone = gapbeam.solve(still | {"supports": made["supports"][: 2 + (step.state[2] == "closed")]})
        assert step.modes("vibration", 2) == pytest.approx(alone.frequencies, rel=1e-12)
    train = gapbeam.solve(made).trains["train 1"]
    for position, state in ((2.0, "open"), (6.0, "closed")):
        under = train.state(position)
        loaded = gapbeam.solve(still | {"loads": [*made["loads"], force(position, 90.0)]})
        assert under.state[2] == loaded.steps[-1].state[2] == state
        assert under.modes("vibration", 2) == under.result.frequencies == pytest.approx(loaded.frequencies, rel=1e-13)
        assert under.mode("vibration", 2).amplitude == pytest.approx(loaded.mode("vibration", 2).amplitude, rel=1e-9)


@pytest.mark.parametrize(("kind", "count", "words"), [
    ("sideways", 1, 'kind: expected "buckling" or "vibration", got \'sideways\''),
    ("vibration", 0, "count: expected 1 or more, got 0"),
])  # fmt: skip
def test_what_has_no_modes(kind, count, words):
    made = scene([4.0], [{"node": 0}, {"node": 1}], [], EI=1.0, mass=1.0) | {"analysis": {"frequencies": 1}}
    with pytest.raises(ValueError, match=words):
        gapbeam.solve(made).steps[-1].modes(kind, count)


GUIDED = {"node": 0, "rotation": "fixed", "stiffness": 0.0}


@pytest.mark.parametrize(
    ("supports", "loads", "hinges", "phases"),
    [
        # tan u + tanh u = 0 is guided at one end; cos u cosh u = 1 is free
        ([GUIDED], [{"type": "moment", "node": 1, "M": 1.0}], [], (0.0, 2.365020372431352)),
        ([], [{"type": "curvature", "kappa": 0.01}], [], (0.0, 0.0, 4.730040744862704, 7.853204624095838)),
        ([{"x": 0.3, "side": "below"}], [], [1.3, 2.7, 3.5], (0.0, 0.0, 0.0, 0.0)),
    ],
)
def test_beams_that_move_freely_have_frequencies_beyond_zero(supports, loads, hinges, phases):
    beam = {"spans": [4.0], "EI": 100.0, "mass": 2.0, "hinges": hinges}
    asked = {"beam": beam, "supports": supports, "loads": loads, "analysis": {"frequencies": len(phases)}}
    result = gapbeam.solve(asked)
    assert result.steps[-1].indifferent
    assert result.frequencies == pytest.approx([(u / 4) ** 2 * math.sqrt(50) for u in phases], rel=1e-13)
    assert all(np.abs(result.mode("vibration", i + 1).deflection).max() == 1 for i in range(len(phases)))
