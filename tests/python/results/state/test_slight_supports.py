"""What is next to nothing beside the beam holds nothing, and takes no digit from what does."""

import gapbeam
import numpy as np
import pytest


def crane(*more):
    """A beam over two supports with a free end at its left."""
    return {
        "beam": {"spans": [2.0, 3.0, 4.0, 5.0], "EI": 1200.0},
        "supports": [{"node": 3, "stiffness": 300.0, "side": "below", "gap": 0.005}, {"node": 4, "rotation": 1200.0}, *more],
        "loads": [{"type": "uniform", "q": 5.0}, {"type": "force", "x": 5.94, "F": 45.0}, {"type": "force", "x": 5.0, "F": -8.7}],
    }


@pytest.mark.parametrize("power", [-25, -35, -70, -100, -200, -300])
@pytest.mark.parametrize("node", [0, 2])
@pytest.mark.parametrize("side", ["both", "below"])
def test_they_are_nothing(node, power, side):
    """At 1e-35 and less a free end had a deflection of 0, or of 32768, and nothing said so."""
    free = gapbeam.solve(crane())
    held = gapbeam.solve(crane({"node": node, "stiffness": 10.0**power, "side": side}))
    for x in (0.0, 2.0, 5.0, 9.0):
        assert held.at(x).deflection == pytest.approx(free.at(x).deflection, rel=1e-13)
    assert held.steps[-1].reaction[:2] == pytest.approx(free.steps[-1].reaction, rel=1e-13)
    assert abs(held.steps[-1].reaction[2]) <= 20 * 10.0**power


@pytest.mark.parametrize("power", [-20, -21, -23, -26, -35, -60, -70, -140, -300])
@pytest.mark.parametrize("kind", ["rotation", "N", "compression", "ground", "two-sided ground"])
def test_nor_do_restraints_ground_and_axial_forces(kind, power):
    """A restraint of 1e-60 halved the deflection of a free end, and nothing said so; the others were refused by the audit."""
    little, made = 10.0**power, crane()
    if kind == "rotation":
        made["supports"][0]["rotation"] = little
    elif "ground" in kind:
        made["foundation"] = [{"k": little, "side": "both" if "two" in kind else "below"}]
    else:
        made["beam"]["N"] = little if kind == "N" else -little
    free, held = gapbeam.solve(crane()), gapbeam.solve(made)
    for x in (0.0, 2.0, 5.0, 9.0):
        assert held.at(x).deflection == pytest.approx(free.at(x).deflection, rel=1e-13)
    assert held.steps[-1].reaction == pytest.approx(free.steps[-1].reaction, rel=1e-13)


@pytest.mark.parametrize("spring", [1e-22, 1e-26, 1e-30, 1e-40])
@pytest.mark.parametrize("restraint", [1e-20, 1e-24, 1e-30])
def test_what_holds_a_beam_together_counts(restraint, spring):
    """Springs were left out beside a restraint that is softer still: a deflection was 1e6 times too great."""
    made = {"beam": {"spans": [10.0], "EI": 1e4},
            "supports": [{"node": 0, "rotation": restraint}, {"node": 1, "stiffness": spring}],
            "loads": [{"type": "force", "x": 10.0, "F": 1e-20}]}  # fmt: skip
    assert gapbeam.solve(made).at(10.0).deflection == pytest.approx(1e-20 / (restraint / 100.0 + spring), rel=1e-14)


def test_where_nothing_else_holds_they_count():
    """Springs that are soft beside a beam that is all but rigid."""
    scene = {
        "beam": {"spans": [4.0], "EI": 1e40}, "supports": [{"node": 0, "stiffness": 2.0}, {"node": 1, "stiffness": 1.0}],
        "loads": [{"type": "force", "x": 1.0, "F": 8.0}],
    }  # fmt: skip
    step = gapbeam.solve(scene).steps[-1]
    assert step.reaction == pytest.approx([6.0, 2.0], rel=1e-14)
    assert step.deflection == pytest.approx([3.0, 2.0], rel=1e-14)
    pivot = scene | {"supports": [{"node": 0}, {"node": 1, "stiffness": 1.0}]}
    assert gapbeam.solve(pivot).steps[-1].deflection == pytest.approx([0.0, 2.0], rel=1e-14)


@pytest.mark.parametrize("count", [1, 3, 20])
@pytest.mark.parametrize("power", [-20, -35, -60, -70, -140, -300])
@pytest.mark.parametrize("node", [0, 2])
def test_cases_with_stiffnesses_of_their_own(node, power, count):
    """Prepared cases had deflections off by 1e-8 at 1e-60, and by 1e232 times at 1e-300."""
    alone = gapbeam.solve(crane({"node": node, "stiffness": 10.0**power}))
    prepared = gapbeam.prepare(crane({"node": node, "stiffness": 1.0}))
    cases = prepared.solve(stiffness=np.tile([300.0, np.inf, 10.0**power], (count, 1)))
    assert not cases.status.any()
    place = {0: 0, 2: 1}[node]
    assert cases.deflection[:, place] == pytest.approx(np.full(count, alone.steps[-1].deflection[2]), rel=1e-13)


def test_cases_with_spans_of_their_own():
    """Beside a beam that is all but rigid a restraint and a spring are nothing, and in the next case they are again."""
    made = crane({"node": 0, "stiffness": 1e-3})
    made["supports"][0] = {"node": 3}
    prepared = gapbeam.prepare(made)
    stiffness = np.array([1e3, 1e70, 1e4, 1e250, 1e3, 1e3])
    cases = prepared.solve(EI=np.tile(stiffness[:, None], (1, 4)))
    for k, EI in enumerate(stiffness):
        alone = gapbeam.solve({**made, "beam": {**made["beam"], "EI": float(EI)}})
        assert cases.deflection[k, 0] == pytest.approx(alone.at(0.0).deflection, rel=1e-13)
