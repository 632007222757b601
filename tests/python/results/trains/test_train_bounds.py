"""Trains whose extreme values lie where the bounds of stretches alone lead: hills between looks, none of them higher elsewhere."""

import json

import gapbeam
from gapbeam.report import to_json
from scenes import at, scene, stretch, uniform
from scenes.train import differences, passages_of


def hill_of_an_opening():
    """The end lifts twice, under 32 and, when that has left, under 33, each time the most within a stretch.

    A light axle comes onto the beam where the first is near the top of its hill, so that 0.728 is seen there at the end of a
    stretch; the second hill, 0.755, is seen from its foot alone, and no support has another extreme value on its stretch.
    """
    supports = [at(0, side="below"), at(1), at(4), at(5), at(6)]
    made = scene([2.0, 1.0, 1.5, 1.5, 4.0, 4.0, 2.0], supports, [uniform(1.0)], EI=64.0)
    return made | {"trains": [{"axles": [[0.0, 32.0], [3.75, 1 / 64], [24.0, 33.0]]}]}


def kink_over_a_hinge():
    """The long span rises under a load beyond it, the most where that passes a hinge, two links away and between two looks.

    Before that it has risen less, under the load before it, seen as a light axle leaves the beam; another one leaves where the load
    comes to the next support. A heavy axle in the last span, which nothing else bends, has all other extreme values.
    """
    supports = [*(at(i) for i in (0, 1, 3, 4)), at(5, rotation="fixed")]
    made = scene([5.0, 9.25, 6.75, 0.75, 4.0], supports, [uniform(-1.0, **stretch(5.0, 21.0))], EI=1024.0, hinges=[21.5, 21.75])
    return made | {"trains": [{"axles": [[0.0, 4096.0], [25.0, 1 / 64], [44.0, 1 / 64], [48.0, 128.0]], "from": 23.75}]}


def answer(made):
    """The result as plain data."""
    return json.loads(to_json(gapbeam.solve(made)))


def test_a_hill_inside_a_stretch_is_not_passed_over():
    made = hill_of_an_opening()
    data = answer(made)
    assert differences(made, data) == []
    value, where = data["envelope"]["supports"][0]["opening"]["max"]
    assert 0.75 < value < 0.76
    assert 26.0 < where["position"] < 30.0


def test_a_kink_over_a_hinge_is_not_passed_over():
    made = kink_over_a_hinge()
    data = answer(made)
    assert differences(made, data) == []
    value, x, where = data["envelope"]["extremes"]["deflection"]["min"]
    assert -1.14 < value < -1.13
    assert 5.0 < x < 21.0
    assert where["position"] == 21.5 + 48.0


def test_the_loads_that_are_there_to_be_seen_are_seen():
    """What the two scenes rest on: stretches end where the light axles come and go."""
    ends = [float(stretch.start) for stretch in passages_of(hill_of_an_opening())[0].stretches]
    assert 3.75 in ends
    ends = [float(stretch.start) for stretch in passages_of(kink_over_a_hinge())[0].stretches]
    assert {25.75 + 25.0, 21.5 + 48.0, 25.75 + 44.0} <= set(ends)
