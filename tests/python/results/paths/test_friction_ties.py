"""Beams that rub and slide to both sides at once: where they go hangs not on rounding, nor on nodes, nor on how they are seen."""

import random

import gapbeam
import numpy as np
import pytest
from gapbeam.report import report_text
from scenes import at, cut, force, mirrored
from scenes.links_along import own_weight, warm


@pytest.mark.parametrize("x", [2.0, 2.09, 2.0856268460933722])
def test_what_slides_to_both_sides_goes_to_both_alike(x):
    """As it cools nothing holds the beam; then the force does."""
    supports = [at(0, side="below", friction=0.3), at(1, side="below"), at(2, side="below", friction=0.3)]
    loads = [own_weight(15.0), force(x, 25.0), warm(-40.0, case="dead")]
    made = {"beam": {"spans": [1.5, 1.5], "EI": 1e3, "EA": 3e4, "alpha": 1e-3}, "supports": supports, "loads": loads}
    places = np.array([0.0, 1.0, 3.0])
    moved = gapbeam.solve(made).at(places).axial_displacement
    assert moved[0] > -moved[2] == pytest.approx(0.04 * 1.5 - 0.3 * 8.4375 * 1.5 / 3e4, rel=1e-12)
    assert gapbeam.solve(cut(made, 1, 0.25)).at(places).axial_displacement == pytest.approx(moved, rel=1e-12)
    behind = gapbeam.solve(mirrored(made)).at(3.0 - places).axial_displacement
    assert -behind == pytest.approx(moved, rel=1e-12)


def symmetric_rack(seed):
    """A beam of several spans on supports that rub, the same from both sides, cooled or heated."""
    rng = random.Random(seed)
    half = [rng.uniform(0.5, 5.0) for _ in range(rng.randint(1, 4))]
    spans = half + half[::-1] if rng.random() < 0.5 else half[:-1] + half[::-1]
    supports = [at(node, side="below", friction=0.3) for node in range(len(spans) + 1)]
    loads = [own_weight(rng.uniform(1.0, 30.0)), {"type": "uniform", "q": rng.uniform(1.0, 30.0)},
             warm(rng.choice((-60.0, 45.3)), case=rng.choice(("dead", "live")))]  # fmt: skip
    beam = {"spans": spans, "EI": 10 ** rng.uniform(2.0, 5.0), "EA": 10 ** rng.uniform(4.0, 6.0), "alpha": 1.2e-5}
    return {"beam": beam, "supports": supports, "loads": loads}


@pytest.mark.parametrize("analysis", [{}, {"history": [1.0, 0.0, 1.0], "follow": "events"}])
def test_symmetric_beams_move_symmetrically(analysis):
    """Reactions of both sides differ by rounding, which would let one side slip alone, and take all of the movement."""
    for seed in range(40):
        made = symmetric_rack(seed)
        result = gapbeam.solve({**made, "analysis": analysis})
        x = np.linspace(0.0, sum(made["beam"]["spans"]), 9)
        u = result.at(x).axial_displacement
        assert u == pytest.approx(-u[::-1], abs=1e-9 * np.abs(u).max()), seed


def test_it_says_that_it_slides():
    """A heated beam on two supports that both rub slides over both; as it cools a little it sticks to both."""
    made = {"beam": {"spans": [6.0], "EI": 2e4, "EA": 5e5, "alpha": 1.2e-5},
            "supports": [at(0, side="below", friction=0.3), at(1, side="below", friction=0.3)],
            "loads": [own_weight(8.0), warm(60.0)]}  # fmt: skip
    words = "solved, but free to slide along its axis"
    assert gapbeam.solve(made).reason == words
    assert report_text(gapbeam.solve(made)).splitlines()[0].endswith(words)
    assert gapbeam.solve(made | {"analysis": {"history": [1.0, 0.99], "follow": "events"}}).reason is None
