"""Supports that turn the beam: slope-deflection, a couple on the spring, the beam seen from the turned support."""

import random

import gapbeam
import numpy as np
import pytest
from gapbeam import SceneError

L, EI, TURN = 5.0, 300.0, 0.01
CLAMPED = {
    "beam": {"spans": [L], "EI": EI},
    "supports": [{"node": 0, "rotation": "fixed", "name": "A"}, {"node": 1, "rotation": "fixed"}],
    "loads": [{"type": "movement", "support": "A", "rotation": TURN}],
}


def test_slope_deflection():
    """M = 4 EI/L theta at the turned end, half of it at the other, and 6 EI/L^2 theta in shear."""
    result = gapbeam.solve(CLAMPED)
    assert result.at(0.0).moment == pytest.approx(4 * EI / L * TURN, rel=1e-14)
    assert result.at(L).moment == pytest.approx(-2 * EI / L * TURN, rel=1e-14)
    assert result.steps[-1].reaction == pytest.approx(6 * EI / L**2 * TURN * np.array([-1.0, 1.0]), rel=1e-14)
    assert result.at(0.0).rotation == pytest.approx(TURN, rel=1e-14)
    assert result.extremes["rotation"]["min"].value == pytest.approx(-TURN / 3, rel=1e-13)
    assert result.extremes["deflection"]["max"].value == pytest.approx(4 / 27 * L * TURN, rel=1e-13)


def test_shear_makes_it_softer():
    """The stiffness of a bar of Timoshenko: (4 + phi)/(1 + phi) EI/L, phi = 12 EI/(GA L^2)."""
    phi = 0.7
    result = gapbeam.solve(CLAMPED | {"beam": {"spans": [L], "EI": EI, "GA": 12 * EI / (phi * L**2)}})
    assert result.at(0.0).moment == pytest.approx((4 + phi) / (1 + phi) * EI / L * TURN, rel=1e-14)


@pytest.mark.parametrize("seed", range(20))
def test_spring_is_turned_by_a_couple(seed):
    """Through an elastic restraint a rotation is its stiffness times it, as a couple: ends, inner supports, loads in between."""
    rng = random.Random(seed)
    spans = [rng.uniform(1.0, 4.0) for _ in range(rng.randint(1, 4))]
    supports = [{"node": i, "side": "both" if i in (0, len(spans)) else rng.choice(["below", "above", "both"]),
                 "gap": 0.0} for i in range(len(spans) + 1)]  # fmt: skip
    turned, stiffness, rotation = rng.randrange(len(supports)), rng.uniform(50.0, 5000.0), rng.uniform(-0.02, 0.02)
    supports[turned]["rotation"] = stiffness
    case = rng.choice(["dead", "live"])
    force = {"type": "force", "x": 0.37 * sum(spans), "F": rng.uniform(-5.0, 9.0)}
    loads = [{"type": "uniform", "q": rng.uniform(0.0, 4.0)}, force]
    scene = {"beam": {"spans": spans, "EI": 100.0, "GA": rng.choice([np.inf, 90.0])}, "supports": supports}
    turn = {"type": "movement", "support": turned, "rotation": rotation, "case": case}
    by_turn = gapbeam.solve(scene | {"loads": [*loads, turn]})
    couple = {"type": "moment", "node": turned, "M": stiffness * rotation, "case": case}
    by_couple = gapbeam.solve(scene | {"loads": [*loads, couple]})
    one, other, x = by_turn.steps[-1], by_couple.steps[-1], np.linspace(0.0, sum(spans), 23)
    assert one.state == other.state
    size = np.abs(other.reaction).max()
    assert np.abs(one.reaction - other.reaction).max() <= 1e-12 * size
    for quantity in ("deflection", "rotation"):
        found, expected = (getattr(result.at(x), quantity) for result in (by_turn, by_couple))
        assert np.abs(found - expected).max() <= 1e-12 * np.abs(expected).max()
        for kind in ("max", "min"):
            value = by_couple.extremes[quantity][kind].value
            assert abs(by_turn.extremes[quantity][kind].value - value) <= 1e-12 * np.abs(expected).max()
    # The spring has what it is turned by less what it turns the beam
    left = rotation - by_turn.at(sum(spans[:turned])).rotation
    assert one.couple[turned] == pytest.approx(stiffness * left, abs=1e-9 * size)


@pytest.mark.parametrize("follow", ["steps", "events"])
def test_seen_from_the_turned_end(follow):
    """A clamped end that turns by theta: all else as if the supports had moved by -theta x, and the beam turned with it."""
    supports = [{"node": 0, "rotation": "fixed"}, {"node": 1, "side": "below", "gap": 0.02}, {"node": 2, "side": "below"}]
    loads = [{"type": "uniform", "q": 1.0, "case": "dead"}]
    base = {"beam": {"spans": [3.0, 2.0], "EI": 80.0}, "analysis": {"follow": follow}}
    turned = gapbeam.solve(base | {"supports": supports, "loads": [*loads, {"type": "movement", "support": 0, "rotation": -0.05}]})
    moved = [{"type": "movement", "support": k, "value": 0.05 * x} for k, x in ((1, 3.0), (2, 5.0))]
    still = gapbeam.solve(base | {"supports": supports, "loads": [*loads, *moved]})
    assert turned.steps[-1].state == still.steps[-1].state
    assert np.allclose(turned.steps[-1].reaction, still.steps[-1].reaction, rtol=0.0, atol=1e-12)
    if follow == "events":
        ways = [[(one.support, one.event, round(one.factor, 12)) for one in result.events] for result in (turned, still)]
        assert ways[0] == ways[1]
        assert ways[0]


def test_combinations_cases_and_pieces():
    """Factors of cases scale the rotation; a force of zero that cuts a span changes nothing."""
    loads = [{"type": "movement", "support": 0, "rotation": TURN, "case": "set"}, {"type": "force", "x": 2.0, "F": 10.0},
             {"type": "force", "x": 3.0, "F": 0.0}]  # fmt: skip
    scene = CLAMPED | {"loads": loads}
    cases = gapbeam.prepare(scene).solve(np.array([[2.0, 1.0, 1.0], [-1.0, 0.0, 0.0]]))
    both = gapbeam.solve(scene | {"combinations": [{"name": "a", "factors": {"set": 2.0, "live": 1.0}},
                                                   {"name": "b", "factors": {"set": -1.0}}]})  # fmt: skip
    for k, one in enumerate(both.combinations.values()):
        assert np.allclose(one.steps[-1].reaction, cases.reaction[k], rtol=1e-13, atol=0.0)
        assert cases.extremes["rotation"]["max"].value[k] == pytest.approx(one.extremes["rotation"]["max"].value, rel=1e-13)
        assert cases.at(3.0).deflection[k] == pytest.approx(one.at(3.0).deflection, rel=1e-13)
    assert both.combinations["a"].at(0.0).rotation == pytest.approx(2 * TURN, rel=1e-13)
    assert both.combinations["b"].at(0.0).moment == pytest.approx(-4 * EI / L * TURN, rel=1e-13)


def test_moved_from_the_start_under_trains():
    """A movement of case dead is a settlement, under trains as well."""
    scene = {"beam": {"spans": [4.0, 4.0], "EI": 1e4}, "supports": [{"node": i} for i in range(3)],
             "trains": [{"axles": [[0.0, 10.0]]}]}  # fmt: skip
    moved = gapbeam.solve(scene | {"loads": [{"type": "movement", "support": 1, "value": 0.01, "case": "dead"}]})
    scene["supports"][1]["settlement"] = 0.01
    pair = [result.envelope().extremes["moment"]["max"].value for result in (moved, gapbeam.solve(scene))]
    assert pair[0] == pair[1]


@pytest.mark.parametrize(("changes", "words"), [
    ({"loads": [{"type": "movement", "support": 0}]}, "loads[0].value: is missing; give value (length) or rotation (rad)"),
    ({"loads": [{"type": "movement", "support": 0, "value": 0.1, "rotation": 0.1}]}, "both given; make two loads"),
    ({"loads": [{"type": "movement", "support": 0, "rotation": np.nan}]}, "loads[0].rotation: expected a finite number, got nan"),
    ({"supports": [{"node": 0, "name": "A"}, {"node": 1}]}, "loads[0].support: it leaves the rotation of the beam free"),
    ({"supports": [{"node": 0, "name": "A", "rotation": 9.0}, {"node": 0, "side": "above", "gap": 1.0, "rotation": 9.0},
                   {"node": 1}]},
     "another support at its place holds the rotation of the beam, too"),
])  # fmt: skip
def test_what_turns_nothing(changes, words):
    with pytest.raises(SceneError) as caught:
        gapbeam.solve(CLAMPED | changes)
    assert words in str(caught.value)
