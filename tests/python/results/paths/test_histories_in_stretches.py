"""Histories of supports that keep a set, under axial forces and on ground that holds both ways.

Random ones stand beside exact histories in `tests/attack/yielding.py`.
"""

import itertools
import math
import random

import gapbeam
import numpy as np
import pytest
from gapbeam.plots.path import path_figure

from .test_axial_springs import pile
from .test_rotation_histories import pair_of
from .test_sliders import mixed_scene

PROP = {"x": 0.5, "side": "below", "law": [[0.01, 1.0], [1.0, 1.0]], "unloading": "plastic"}


def string(**keys):
    """A beam of length 1 that is pulled by 9, on a plastic prop."""
    return {"beam": {"spans": [1.0], "EI": 1.0, "N": 9.0}, "supports": [{"node": 0}, PROP, {"node": 1}],
            "loads": [{"type": "force", "x": 0.5, "F": 4.0}],
            "analysis": {"follow": "events", "history": [1.0, 0.0]}} | keys  # fmt: skip


def moored(**keys):
    """A compressed pile, whose tie and cap yield."""
    tie = {"x": 0.0, "side": "both", "law": [[0.004, 60.0], [0.05, 80.0]], "unloading": "plastic"}
    cap = {"x": 0.0, "direction": "rotational", "law": [[0.002, 90.0], [0.05, 110.0]], "unloading": "plastic"}
    return {"beam": {"spans": [10.0], "EI": 3e4, "N": -400.0, "mass": 0.3}, "foundation": [{"k": [500.0, 9000.0]}],
            "supports": [tie, cap], "loads": [{"type": "force", "x": 0.0, "F": 200.0}],
            "analysis": {"follow": "events", "history": [1.0, 0.0, -0.6]}} | keys  # fmt: skip


def test_a_string_on_a_prop():
    """A force in its middle moves it by c = (1/2 - tanh(3/2)/3)/18 times that."""
    c = (0.5 - math.tanh(1.5) / 3.0) / 18.0
    result = gapbeam.solve(string())
    assert [event.event for event in result.events] == ["yields", "unloads", "opens"]
    right = [(1.0 + 0.01 / c) / 4.0, 1.0, (3.0 - 0.01 / c) / 4.0]
    assert [event.factor for event in result.events] == pytest.approx(right, rel=1e-14)
    assert result.steps[-1].set[1] == pytest.approx(3.0 * c - 0.01, rel=1e-13)


@pytest.mark.parametrize("seed", range(24))
def test_beside_a_lever_and_beside_half_the_beam(seed):
    """A law of a rotation is that of a deflection of a lever, which the axial force does not reach."""
    scene, other, ratio = pair_of(seed)
    N = random.Random(seed).choice([0.3, 5.0, -0.4])
    scene["beam"]["N"], spans = N, len(other["beam"]["spans"])
    other["beam"]["N"] = [N, 0.0] if spans == 2 else N
    turned, known = gapbeam.solve(scene), gapbeam.solve(other)
    assert [event.event for event in turned.events] == [event.event for event in known.events]
    for one, two in zip(turned.steps, known.steps, strict=True):
        assert one.factor == pytest.approx(two.factor, abs=1e-13)
        assert one.reaction[-1] == pytest.approx(two.reaction[-1], abs=1e-13)
        assert one.set[-1] == pytest.approx(ratio * two.set[-1], abs=1e-13)


@pytest.mark.parametrize("seed", range(12))
def test_stops_on_the_way_change_nothing(seed):
    rng = random.Random(seed)
    scene, ends = mixed_scene(rng)
    EI, ends = scene["beam"]["EI"], [factor for factor, _ in itertools.groupby(ends)]
    if seed % 3:
        scene["beam"]["N"] = EI * rng.choice([1e-4, 0.1, 30.0])
    if seed % 3 < 2:
        scene["foundation"] = [{"k": EI * rng.choice([1e-3, 1.0, 100.0])}]
    stops, numbers = [], []
    for start, stop in itertools.pairwise([0.0, *ends]):
        stops += [start + (stop - start) * share for share in (0.31, 0.77, 1.0)]
        numbers.append(len(stops) - 1)
    once, often = (gapbeam.solve(scene | {"analysis": {"history": history, "follow": "events"}}) for history in (ends, stops))
    assert once.status == often.status == "solved"
    for leg, number in enumerate(numbers):
        one, other = once.state(ends[leg], leg=leg), often.state(ends[leg], leg=number)
        for name in ("reaction", "deflection"):
            right = getattr(one, name)
            assert getattr(other, name) == pytest.approx(right, abs=1e-11 * max(1e-6, np.abs(right).max()))


def test_values_are_linear_between_events():
    result = gapbeam.solve(moored())
    ends = [0.0, *(event.factor for event in result.events if event.factor <= 1.0)][:3]
    for a, b in itertools.pairwise(ends):
        one, middle, two = (result.at(3.0, factor=f, leg=0).moment for f in (a, (a + b) / 2, b))
        assert middle == pytest.approx((one + two) / 2, rel=1e-13)
    assert "curved between events" not in result.report()


def test_modes_feel_the_segments_that_act():
    asked = {"follow": "events", "frequencies": 2, "buckling": 1}
    result = gapbeam.solve(moored(analysis=asked))
    springs = [{"x": 0.0, "stiffness": 20.0 / 0.046}, {"x": 0.0, "direction": "rotational", "stiffness": 20.0 / 0.048}]
    linear = gapbeam.solve(moored(supports=springs, analysis=asked | {"follow": "steps"}))
    assert result.frequencies == pytest.approx(linear.frequencies, rel=1e-13)
    assert result.buckling == pytest.approx(linear.buckling, rel=1e-13)


@pytest.mark.parametrize("case", ["dead", "live"])
def test_modes_of_supports_that_stay_where_they_have_yielded(case):
    """Under dead loads alone they stand at the end of their way, on the piece that they came on; rounding chose one."""
    yields = {"side": "below", "unloading": "plastic"}
    supports = [{"x": 0.0}, {"x": 7.59, **yields, "side": "both", "law": [[0.004, 11.2], [0.03, 65.8]]},
                {"x": 14.58, **yields, "law": [[0.004, 9.6], [0.03, 68.8]]}, {"x": 20.69, "side": "below"}]  # fmt: skip
    loads = [{"type": "linear", "q": [-1.17, 2.66], "from": 2.38, "to": 14.92, "case": case},
             {"type": "force", "F": 32.59, "x": 8.69, "case": case}]  # fmt: skip
    made = {"beam": {"spans": [7.59, 6.99, 6.11], "EI": 1220.15, "mass": 1.86}, "supports": supports, "loads": loads}
    result = gapbeam.solve({**made, "analysis": {"frequencies": 2, "follow": "events"}})
    assert result.steps[-1].state == ("bilateral", "branch 2", "branch 2", "open")
    # As if springs with the slopes of these pieces held it
    for support, law in zip(supports, ([1.0], [0.026, 54.6], [0.026, 59.2], [1.0]), strict=True):
        support.pop("law", None)
        support.pop("unloading", None)
        support.update({"side": "both", "stiffness": law[1] / law[0]} if len(law) > 1 else {})
    beside = {**made, "loads": [{"type": "force", "x": 8.69, "F": 1.0}, {"type": "force", "x": 20.69, "F": -50.0}]}
    expected = gapbeam.solve({**beside, "analysis": {"frequencies": 2}})
    assert expected.steps[-1].state[3] == "open"
    assert result.frequencies == pytest.approx(expected.frequencies, rel=1e-10)


def test_prepared_cases_and_combinations_are_put_on_once():
    made = moored(analysis={})
    for factor, reaction in zip((0.5, 1.0), gapbeam.prepare(made).solve([[0.5], [1.0]]).reaction, strict=True):
        alone = gapbeam.solve(made | {"loads": [made["loads"][0] | {"F": 200.0 * factor}]})
        assert reaction.tolist() == alone.steps[-1].reaction.tolist()
    both = gapbeam.solve(made | {"combinations": [{"name": "half", "factors": {"live": 0.5}}]})
    half = gapbeam.solve(made | {"loads": [made["loads"][0] | {"F": 100.0}]})
    assert both.combinations["half"].steps[-1].reaction.tolist() == half.steps[-1].reaction.tolist()


def test_what_is_along_the_beam_does_not_feel_it():
    history = {"follow": "events", "history": [1.0, -0.4, 0.8], "first_order": True}
    bearings = [*pile()["supports"], {"node": 0}, {"node": 1}]
    known = gapbeam.solve(pile(supports=bearings, analysis=history))
    tie = {"x": 0.0, "law": [[1e-4, 1.0], [1.0, 2.0]], "unloading": "plastic"}
    loads = [*pile()["loads"], {"type": "force", "x": 0.0, "F": 50.0}]
    made = pile(foundation=[{"k": 1e4}], supports=[*pile()["supports"], tie], loads=loads, analysis=history)
    result = gapbeam.solve(made)
    assert {event.support for event in result.events} == {1}
    for leg, factor in enumerate(history["history"]):
        one, other = (each.at(5.0, factor=factor, leg=leg) for each in (known, result))
        assert one.axial_force == pytest.approx(other.axial_force, rel=1e-13)
        assert one.axial_displacement == pytest.approx(other.axial_displacement, rel=1e-13)


def test_a_part_that_tips_where_all_has_yielded():
    """Beside its own stretches the ground cuts the beam where its series ask for that: nodes are those of the scene."""
    prop = {"x": 55.0, "law": [[0.01, 60.0], [0.05, 60.0]], "unloading": "plastic"}
    result = gapbeam.solve(moored(beam={"spans": [50.0, 5.0], "EI": 1e4, "hinges": [50.0]}, supports=[prop],
                                  foundation=[{"k": [1e5, 3e5], "from": 0.0, "to": 50.0}],
                                  loads=[{"type": "force", "x": 55.0, "F": 200.0}]))  # fmt: skip
    assert result.status == "limit-load"
    assert result.steps[-1].factor == pytest.approx(0.3, rel=1e-14)
    assert result.motion == [(0.0, 0.0), (50.0, 0.0), (55.0, 1.0)]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"analysis": {"follow": "events", "N_with": "live"}}, "do not grow with the load; give N with N_with dead"),
        ({"foundation": [{"k": 500.0, "side": "below"}]}, r"foundation\[0\]: .*both ways by k alone"),
        ({"foundation": [{"k": 500.0, "gap": 0.01}]}, r"foundation\[0\]: .*both ways by k alone"),
        ({"foundation": [{"law": {"type": "tanh", "stiffness": 500.0, "limit": 20.0}}]}, "both ways by k alone"),
        ({"beam": {"spans": [10.0], "EI": 3e4, "N": -6e4}}, "is stable with all supports that yield or act one way open"),
        ({"loads": [{"type": "movement", "foundation": 0, "value": 0.01}]}, "a load that moves a foundation beside a history"),
    ],
)  # fmt: skip
def test_refusals(change, message):
    with pytest.raises(gapbeam.EngineError, match=message):
        gapbeam.solve(moored(**change))


def test_the_picture_goes_where_the_load_goes():
    """Back and forth, with the values of the path; zones of ground that never change are no panel of it."""
    result = gapbeam.solve(moored())
    axes = path_figure(result).axes
    ends = [result.path.step(segment, factor) for segment in result.segments for factor in (segment.start, segment.stop)]
    drawn = [line.get_xydata() for line in axes[0].lines if line.get_label() == "support 0"]
    points = np.concatenate(drawn)
    assert all(np.abs(points - (step.factor, step.reaction[0])).sum(axis=1).min() < 1e-12 for step in ends)
    assert all(min(abs(x - step.factor) + abs(y - step.reaction[0]) for step in ends) < 1e-12 for x, y in points)
    assert not any("contact" in one.get_ylabel() for one in axes)


@pytest.mark.parametrize(
    ("beam", "law", "place", "history"),
    [
        ({"spans": [1.0], "EI": 4000.0, "N": 52.41735509914854},
         [[0.009895120171645996, 12.567765876441374], [0.019790240343291993, 17.27947510375549]], 1.0, [0.0, 1.0]),
        ({"spans": [5.216879434275907, 1.2397936129075584, 3.661087391562813], "EI": 3000.0, "N": 75.97367410492672},
         [[0.018572682558764556, 3.064731380114307], [0.03714536511752911, 3.442788985450506]], 10.0, [1.0, 0.0]),
    ],
)  # fmt: skip
def test_without_loads_nothing_is_left_on_curves(beam, law, place, history):
    """Forces are counted from where curves bend, and what cancels there is rounding beside no forces at all."""
    ends = [{"node": 0, "law": law}, {"node": len(beam["spans"]), "stiffness": 0.0}]
    if len(beam["spans"]) == 1:
        ends[1]["rotation"] = {"law": [[0.001, 1.0], [0.003, 1.0]], "unloading": "plastic"}
    result = gapbeam.solve({"beam": beam, "supports": ends, "loads": [{"type": "force", "x": place, "F": 0.1}],
                            "analysis": {"follow": "events", "history": history}})  # fmt: skip
    assert result.to_dict()["status"] == "solved"
    assert abs(result.loop(0).reaction[0 if history[0] == 0.0 else -1]) < 1e-13
