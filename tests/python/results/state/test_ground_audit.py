"""States on the ground stand their own audit, and the residuals of their certificates are what it measured."""

import gapbeam
import pytest
from scenes import curved, foundation
from scenes import ground as ground_scenes

MAKERS = {"lines": (foundation.random_scene, 250), "curves": (curved.random_curved_scene, 50)}


@pytest.mark.parametrize("kind", MAKERS)
def test_nothing_right_is_refused(kind):
    make, count = MAKERS[kind]
    measured = []
    for seed in range(10_000, 10_000 + count):
        result = gapbeam.solve(make(seed))
        if result.status == "solved":
            measured.append(result.steps[-1].residuals)
    assert len(measured) > count / 3
    assert max(max(residuals.values()) for residuals in measured) < 1e-14
    # Nobody writes zeros: they are measured
    for name in ("equilibrium", "compatibility"):
        assert sum(residuals[name] > 0.0 for residuals in measured) > 0.9 * len(measured), name
    assert any(residuals["complementarity"] > 0.0 for residuals in measured)


@pytest.mark.parametrize("make", ["rail", "stopped", "two", "yielding", "touching", "footing"])
def test_plain_scenes_and_their_paths_stand(make):
    made = getattr(ground_scenes, make)()
    assert gapbeam.solve(made).status == "solved"
    followed = gapbeam.solve({**made, "analysis": {"follow": "events"}})
    assert followed.status == "solved"
    assert all(0.0 <= value < 1e-12 for value in followed.steps[-1].certificate.values() if value is not None)


def test_a_long_and_a_short_beam_are_integrated():
    ground = [{"k": 1.0, "side": "below"}]
    for length in (1e-3, 1.0, 30.0, 300.0, 1e4):
        made = ground_scenes.on_ground(
            [length], ground, [{"type": "force", "x": length / 3, "F": 2.0}], EI=0.25
        )
        made["loads"].append({"type": "uniform", "q": 1.0, "case": "dead"})
        step = gapbeam.solve(made).steps[-1]
        assert 0.0 < max(step.residuals.values()) < 1e-14
