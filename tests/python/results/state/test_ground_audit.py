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


@pytest.mark.parametrize(
    "where",
    [
        # Between two supports nothing bends the beam but the rounding of two couples that cancel; ground touches it there
        {"beam": {"spans": [6.0], "EI": 4000.0, "hinges": [2.0]}, "supports": [{"x": 2.0}, {"x": 3.0}]},
        # Left of a spring nothing is left but that
        {"beam": {"spans": [6.0], "EI": 4000.0}, "supports": [{"x": 3.0, "law": [[0.005, 5.0], [0.01, 20.0]]}]},
    ],
)
def test_what_rounding_leaves_of_couples_that_cancel_stands(where):
    couples = [{"type": "moment", "x": 6.0, "M": 20.0}, {"type": "moment", "x": 3.0, "M": -20.0}]
    where = {**where, "foundation": [{"k": 1000.0, "side": "above"}], "loads": couples}
    result = gapbeam.solve({**where, "analysis": {"follow": "events"}})
    assert result.status == "solved"
    assert abs(result.steps[-1].reaction).max() < 1e-28


def test_a_support_at_a_knee_of_its_law_has_its_force():
    """At a quarter of the couple that is left the spring has just come back to its knee."""
    result = gapbeam.solve({
        "beam": {"spans": [6.0], "EI": 4000.0, "hinges": [2.0]}, "foundation": [{"k": 1000.0, "side": "above"}],
        "supports": [{"x": 2.0}, {"x": 3.0, "law": [[0.005, 5.0], [0.01, 20.0]]}], "analysis": {"follow": "events"},
        "loads": [{"type": "moment", "x": 6.0, "M": 20.0, "case": "dead"}, {"type": "moment", "x": 3.0, "M": -20.0}],
    })  # fmt: skip
    assert [(round(event.factor, 12), event.support, event.event) for event in result.events] == [(0.75, 1, "unloads")]
    assert result.state(0.75).reaction.tolist() == [-5.0, 5.0]


def test_what_rounding_of_a_slack_leaves_without_load_stands():
    """Beyond the slack a part of the beam stands aside; what rounding makes of that are forces at supports elsewhere."""
    made = {
        "beam": {"spans": [4.0, 6.0, 6.0], "EI": 1000.0, "mass": 1.0}, "hinges": [{"x": 12.0, "slack": 0.002}],
        "supports": [{"node": 0}, {"node": 2, "side": "below"}, {"node": 3, "side": "above"}],
        "loads": [{"type": "force", "x": 4.0, "F": 100.0}], "analysis": {"follow": "events", "history": [1.0, 0.0]},
    }  # fmt: skip
    step = gapbeam.solve(made).steps[-1]
    assert abs(step.reaction).max() < 1e-30
    assert step.deflection[2:].tolist() == pytest.approx([0.008, -0.002], rel=1e-12)
