"""Long beams that rub while supports lift off and close: limits of friction go on as they do but around what happens."""

import random

import gapbeam
import numpy as np
import pytest
from scenes import at, force
from scenes.links_along import own_weight, warm

FRICTION = 0.3


def rack(seed, supports=450):
    """A long beam with gaps, pulled up here and there while it gets warm; stops along it hold it."""
    rng = random.Random(seed)
    held = [at(n, side="below", friction=FRICTION, gap=rng.choice((0.0, 0.0, 0.002)) if 0 < n < supports - 1 else 0.0)
            for n in range(supports)]  # fmt: skip
    held += [{"node": n, "direction": "axial"} for n in sorted(rng.sample(range(supports), rng.randint(1, 3)))]
    pulled = rng.sample(range(1, supports - 1), supports // 9)
    loads = [own_weight(2.0), warm(60.0), *(force(6.0 * n, -rng.uniform(10.0, 40.0)) for n in pulled)]
    beam = {"spans": [6.0] * (supports - 1), "EI": 1e4, "EA": 4e5, "alpha": 1.2e-5}
    analysis = {"follow": "events", "history": [1.0, 0.0, 1.0], "first_order": True}
    return {"beam": beam, "supports": held, "loads": loads, "analysis": analysis}


@pytest.mark.parametrize("seed", range(4))
def test_friction_keeps_to_its_limits(seed):
    """On every segment what sticks is within its limit, what slides has it, and slides where friction does not push it."""
    made = rack(seed)
    result = gapbeam.solve(made)
    n = len(made["beam"]["spans"]) + 1
    assert {event.event for event in result.events} == {"opens", "closes", "slips", "sticks"}
    allowed = 1e-12 * FRICTION * max(result.steps[-1].reaction)
    for segment in result.path.segments:
        ends = [result.path.step(segment, factor) for factor in (segment.start, segment.stop)]
        for step in ends:
            room = FRICTION * step.reaction[:n] - np.abs(step.friction[:n])
            assert room.min() >= -allowed, segment
            assert np.abs(room[[s in ("left", "right") for s in step.sliding[:n]]]).max(initial=0.0) <= allowed, segment
        before, after = (step.slip[:n] for step in ends)
        sticks = [s == "sticks" for s in ends[0].sliding[:n]]
        moved = after - before
        assert np.abs(moved[sticks]).max(initial=0.0) <= 1e-15, segment
        pushes = ends[1].friction[:n] * moved
        assert pushes.max() <= 1e-15 * np.abs(ends[1].friction[:n]).max(), segment


def test_what_lifts_off_does_not_slip_before():
    """Between two stops nothing moves: a limit that falls to nothing where a support lifts off holds up to there."""
    made = rack(1)
    ends = [{"node": node, "direction": "axial"} for node in (0, len(made["beam"]["spans"]))]
    made["supports"] = [support for support in made["supports"] if "side" in support] + ends
    assert {event.event for event in gapbeam.solve(made).events} == {"opens", "closes"}
