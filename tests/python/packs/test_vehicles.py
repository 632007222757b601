"""Vehicles: their numbers beside the sources that are quoted in the packs, and what they make of a simple span by hand."""

import math
from itertools import pairwise

import gapbeam
import pytest
from gapbeam import packs

SPANS = (12.0, 20.0, 30.0)


def solved(trains, span, loads=({"type": "uniform", "q": 0.0},)):
    supports = [{"node": 0}, {"node": 1}]
    return gapbeam.solve({"beam": {"spans": [span], "EI": 1e6}, "supports": supports, "loads": list(loads), "trains": trains})


def largest(trains, span):
    return solved(trains, span).envelope().extremes["moment"]["max"].value


@pytest.mark.parametrize(("lane", "force", "q"), [(1, 300.0, 9.0), (2, 200.0, 2.5), (3, 100.0, 2.5)])
def test_lm1_is_that_of_table_4_2(lane, force, q):
    """Davaine, Bridge design with Eurocodes (JRC), D1.8: 300/200/100 kN per axle, 1.2 m apart, 9 and 2.5 kN/m2."""
    assert packs.lm1(lane)["axles"] == [(0.0, force), (1.2, force)]
    assert packs.lm1_lane(lane)["q"] == 3.0 * q
    assert packs.lm1_lane(lane, width=1.0, alpha=0.8)["q"] == pytest.approx(0.8 * q, rel=1e-15)
    assert "factor" not in packs.lm1(lane)


@pytest.mark.parametrize("span", SPANS)
def test_moment_of_a_tandem_by_hand(span):
    """Two equal axles: P/(2 L) (L - a/2)^2, under one of them."""
    assert largest([packs.lm1(alpha=0.9)], span) == pytest.approx(0.9 * 300.0 / (2.0 * span) * (span - 0.6) ** 2, rel=1e-12)
    assert largest([packs.hl93_tandem()], span) == pytest.approx(1.33 * 110.0 / (2.0 * span) * (span - 0.6) ** 2, rel=1e-12)


def test_lm71_is_that_of_figure_6_2():
    """XC, EC1_rail_load_models.py: four axles of 250e3 N, 1.6 m apart; 1000 kN over 6.4 m are the 156 kN/m of the Polish code."""
    train = packs.lm71(ahead=10.0, behind=5.0, alpha=1.1, dynamic=1.2)
    places = [place for place, _ in train["axles"]]
    assert [force for _, force in train["axles"]] == [pytest.approx(275.0)] * 4
    assert [b - a for a, b in pairwise(places)] == pytest.approx([1.6, 1.6, 1.6])
    (a, b, before), (c, d, behind) = train["q"]
    assert (a, b, c, d) == pytest.approx((-10.8, -0.8, places[-1] + 0.8, places[-1] + 5.8))
    assert before == behind == pytest.approx(88.0)
    assert c - b == pytest.approx(6.4)
    assert round(4 * 250.0 / 6.4) == 156
    assert train["factor"] == 1.2
    assert "q" not in packs.lm71()


@pytest.mark.parametrize("span", SPANS)
def test_moment_of_lm71_in_the_middle_by_hand(span):
    """Axles at 0.8 and 2.4 m beside the middle, the uniform load from 3.2 m beside it to the supports."""
    train = packs.lm71(ahead=span, behind=span)
    position = span / 2.0 + 2.4
    axles = 250.0 / 4.0 * (2.0 * (span - 1.6) + 2.0 * (span - 4.8))
    uniform = 2.0 * 80.0 * (span / 2.0 - 3.2) ** 2 / 4.0
    traversal = solved([train], span).trains["LM71"]
    assert float(traversal.at(span / 2.0, position=position).moment) == pytest.approx(axles + uniform, rel=1e-11)


@pytest.mark.parametrize(
    ("track", "length", "factor"),
    [
        ("standard", 35.0, 1.1079),  # printed in a program after a bridge report (BG40)
        ("standard", 4.0, 2.16 / 1.8 + 0.73),
        ("standard", 1.0, 2.0),  # the most
        ("careful", 15.3, 1.208),  # printed in zanotowane.pl, Steel railway bridge design
        ("careful", 64.0, 1.44 / 7.8 + 0.82),
        ("careful", 3.24, 1.67),  # the most
    ],
)
def test_dynamic_factor_of_railways(track, length, factor):
    printed = {1.1079: 5e-5, 1.208: 5e-4}
    assert packs.rail_dynamic_factor(length, track) == pytest.approx(factor, abs=printed.get(factor, 1e-12))
    assert packs.rail_dynamic_factor(1e6, track) == 1.0
    assert packs.rail_dynamic_factor(0.03, track) == {"standard": 2.0, "careful": 1.67}[track]


@pytest.mark.parametrize("span", SPANS)
def test_moment_of_the_design_truck_by_hand(span):
    """AASHTO 3.6.1.2.2, 35, 145, 145 kN at 4.3 m: largest under the middle axle, with the resultant as far beyond the middle."""
    behind = (145.0 - 35.0) * 4.3 / 325.0
    moment = 325.0 / span * (span / 2.0 - behind / 2.0) ** 2 - 35.0 * 4.3
    assert largest([packs.hl93_truck()], span) == pytest.approx(1.33 * moment, rel=1e-12)
    assert sum(force for _, force in packs.hl93_truck()["axles"]) == 325.0


def test_the_range_of_rear_spacings_finds_a_worse_one_over_a_pier():
    """AASHTO: between 4300 and 9000 mm to produce extreme force effects."""
    trucks = packs.hl93_trucks(5)
    spacings = [truck["axles"][2][0] - truck["axles"][1][0] for truck in trucks]
    assert spacings == pytest.approx([4.3, 5.475, 6.65, 7.825, 9.0])
    beam = {"spans": [12.0, 12.0], "EI": 1e6}
    supports = [{"node": i} for i in range(3)]
    result = gapbeam.solve({"beam": beam, "supports": supports, "loads": [packs.hl93_lane()], "trains": trucks})
    worst = result.envelope().extremes["moment"]["min"]
    assert worst.train != trucks[0]["name"]
    assert packs.hl93_lane()["q"] == 9.3


@pytest.mark.parametrize(("speed", "kind", "factor"), [(20.0 / 60.0, "HC4", 1.43), (0.1, "HC1", 1.067), (0.2, "HC2", 1.168)])
def test_hoisting_factor(speed, kind, factor):
    """The first is printed in a program after AS 5221.1:2021: 20 m/min, greatest phi2min: 1.43; the others are 1.05 + 0.017 etc."""
    assert packs.hoisting_factor(speed, kind) == pytest.approx(factor, abs=4e-3 if kind == "HC4" else 1e-12)


@pytest.mark.parametrize("span", [9.0, 12.0, 15.0])
def test_crane_pair(span):
    first, second = [(0.0, 180.0), (3.6, 180.0)], [(0.0, 120.0), (3.2, 120.0)]
    trains = packs.crane_pair(first, second, 5.5, dynamic=1.2)
    assert [train["name"] for train in trains] == ["crane 1", "crane 2", "both"]
    for train, force, base in zip(trains, (180.0, 120.0), (3.6, 3.2), strict=False):
        assert largest([train], span) == pytest.approx(1.2 * force / (2.0 * span) * (span - base / 2.0) ** 2, rel=1e-12)
    both = solved(trains, span).trains["both"]
    x = [8.7, 8.7 - 3.6, 8.7 - 5.5, 8.7 - 8.7]
    reaction = 1.2 * sum(P * (1.0 - place / span) for P, place in zip((180.0, 180.0, 120.0, 120.0), x, strict=True))
    assert float(both.state(8.7).reaction[0]) == pytest.approx(reaction, rel=1e-12)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (lambda: packs.lm1(4), "lm1: lane: there are the lanes 1, 2 and 3, each of them once, got 4"),
        (lambda: packs.lm1_lane((1, 1)), "lm1_lane: lane: there are the lanes 1, 2 and 3, each of them once, got (1, 1)"),
        (lambda: packs.lm1(alpha=-1.0), "lm1: alpha: expected 0 or more, got -1"),
        (lambda: packs.lm71(dynamic=0.0), "lm71: dynamic: expected a number above 0, got 0"),
        (lambda: packs.rail_dynamic_factor(9.0, "good"), "rail_dynamic_factor: track: expected 'standard' or 'careful', got"),
        (lambda: packs.lm71(ahead=math.inf), "lm71: ahead: expected 0 or more, got inf"),
        (lambda: packs.hl93_truck(4.0), "hl93_truck: rear_spacing: expected 4.3 to 9, got 4"),
        (lambda: packs.hl93_trucks(1), "hl93_trucks: count: expected 2 or more spacings, got 1"),
        (lambda: packs.crane_pair([(0.0, 1.0), (3.0, 1.0)], [(0.0, 1.0)], 2.0), "crane_pair: distance: 2 is within the first"),
        (lambda: packs.lm71(dynamic="1.2"), "lm71: dynamic: expected a number above 0, got '1.2'"),
        (lambda: packs.hl93_trucks(2.5), "hl93_trucks: count: expected 2 or more spacings, got 2.5"),
        (lambda: packs.crane_pair([0.0, 3.0], [(0.0, 1.0)], 4.0), "crane_pair: first: expected pairs of a distance and"),
        (lambda: packs.hoisting_factor(0.1, "HC5"), "hoisting_factor: hoisting_class: the classes are HC1, HC2, HC3, HC4, got"),
    ],
)
def test_what_makes_no_sense_is_refused(wrong, message):
    with pytest.raises(gapbeam.SceneError) as error:
        wrong()
    assert str(error.value).startswith(message)


def test_what_has_no_source_is_left_out_in_words():
    with pytest.raises(AttributeError, match=r"as2870_mound.*was not found in a source.*profile"):
        _ = packs.as2870_mound
    with pytest.raises(AttributeError, match="no 'lm2'; it has api_sand, "):
        _ = packs.lm2


def test_they_are_trains_of_the_objects_of_python_too():
    assert gapbeam.Train(**packs.hl93_truck()).factor == 1.33
    assert gapbeam.UniformLoad(**{key: value for key, value in packs.lm1_lane().items() if key != "type"}).q == 27.0
