"""Supports that hold the rotation exactly at a hinge, of the part left or right of it: closed forms, and rational numbers."""

import random
from fractions import Fraction

import gapbeam
import numpy as np
import pytest
from gapbeam import SceneError
from gapbeam.report.text import report_text
from oracle.rotation_laws import moved, pieces, solve

from .test_rotations import assert_close, held, last_step

INF = float("inf")


def restraint(rng):
    """A rotation that is held: what a scene says, and pieces."""
    kind = rng.random()
    if kind < 0.25:
        return "fixed", pieces()
    if kind < 0.5:
        stiffness = rng.choice([1, 4, 16])
        return float(stiffness), pieces(0, stiffness)
    return held(rng, {1: "counterclockwise", -1: "clockwise"})


def joint(rng, x):
    """A hinge of any kind: keys of a scene, and pieces."""
    kind = rng.random()
    if kind < 0.3:
        return {"beam": [float(x)]}, pieces(0, 0)
    if kind < 0.4:
        return {"hinges": [{"x": float(x)}]}, pieces(0, 0)
    if kind < 0.6:
        stiffness = rng.choice([1, 8])
        return {"hinges": [{"x": float(x), "stiffness": float(stiffness)}]}, pieces(0, stiffness)
    keys, law = held(rng, {1: "sagging", -1: "hogging"})
    return {"hinges": [{"x": float(x), **keys}]}, law


def beam_of(seed):
    """A random beam with a hinge, and mostly a support beside it: a scene, and the same for the oracle."""
    rng = random.Random(seed)
    spans = [Fraction(rng.randint(2, 4), 2) for _ in range(rng.randint(1, 2))]
    ends = [sum(spans[:k], Fraction(0)) for k in range(len(spans) + 1)]
    x = rng.choice([Fraction(1, 2), Fraction(3, 4), *ends[1:-1]])
    supports, laws = [], []
    for place in ends:
        if place != x and rng.random() < 0.9:
            side = rng.choice([0, 0, 1])
            supports.append({"x": float(place), "side": "below" if side else "both", "rotation": rng.choice(["free", "fixed"])})
            laws += [(place, "w", pieces(side, None))]
            if supports[-1]["rotation"] == "fixed":
                laws.append((place, "turn", None))
    side, (keys, law) = rng.choice(["left", "right"]), restraint(rng)
    turned, at_hinge = Fraction(rng.choice([0, 0, 1, -2]), 32), rng.random()
    if at_hinge < 0.15:
        turned = 0  # couples alone
    elif at_hinge < 0.6:
        way, stiffness, gap = rng.choice([0, 1]), rng.choice([None, 16]), Fraction(rng.choice([0, 1]), 64)
        gap = gap if way else 0
        supports.append({"x": float(x), "side": "below" if way else "both", "gap": float(gap), "rotation": keys, "at_hinge": side,
                         "stiffness": INF if stiffness is None else float(stiffness)})  # fmt: skip
        laws.append((x, "w", pieces(way, stiffness, gap)))
    else:
        keys = {"stiffness": INF if keys == "fixed" else keys} if not isinstance(keys, dict) else dict(keys)
        keys["gap"] = keys.pop("slack", 0.0)
        if "law" in keys:
            keys.pop("stiffness", None)
        supports.append({"x": float(x), "direction": "rotational", "at_hinge": side, **keys})
    hinge, between = joint(rng, x)
    q, force = Fraction(rng.randint(-1, 2)), (spans[0] * Fraction(2, 5), Fraction(rng.choice([-2, 1, 3])))
    couples = [(x, one, Fraction(rng.randint(-3, 3), 4)) for one in ("left", "right") if rng.random() < 0.4]
    loads = [{"type": "uniform", "q": float(q)}, {"type": "force", "x": float(force[0]), "F": float(force[1])},
             *({"type": "moment", "x": float(x), "M": float(M), "at_hinge": one} for _, one, M in couples)]  # fmt: skip
    if turned:
        key = "value" if "direction" in supports[-1] else "rotation"
        loads.append({"type": "movement", "support": len(supports) - 1, key: float(turned)})
    scene = {"beam": {"spans": list(map(float, spans)), "EI": 0.5, "hinges": hinge.get("beam", [])}, "supports": supports,
             "hinges": hinge.get("hinges", []), "loads": loads}  # fmt: skip
    every = [(place, kind, pieces() if law is None else law) for place, kind, law in laws]
    if at_hinge >= 0.15:
        every.append((x, side, moved(law, turned)))
    every.append((x, "hinge", between))
    about = (spans, Fraction(1, 2), every, q, [(Fraction(loads[1]["x"]), force[1])], couples)
    return scene, about


@pytest.mark.parametrize("follow", ["steps", "events"])
@pytest.mark.parametrize("seed", range(60))
def test_random_beams_beside_rationals(seed, follow):
    scene, about = beam_of(seed)
    exact = solve(*about)
    step = last_step(scene, follow, exact)
    if step is None:
        return
    if exact is None:  # a part of it hangs there without load
        assert step.indifferent
        return
    kinds = [kind for _, kind, _ in about[2]]
    # In results: supports across the beam, that at the hinge, and the hinge where it has a law or is held
    order = [k for way in ("w", "left", "right", "hinge") for k, kind in enumerate(kinds) if kind == way]
    forces, ways = (np.array([float(values[k]) for k in order[:len(step.reaction)]]) for values in exact)
    assert_close(step, forces, ways)
    assert step.error_bounds["moment"] < 1e-11


BRACKET = {
    "beam": {"spans": [4.0, 4.0], "EI": 100.0, "hinges": [4.0]},
    "supports": [{"node": 0}, {"node": 1, "rotation": "fixed", "at_hinge": "left"}, {"node": 2}],
    "loads": [{"type": "uniform", "q": 1.0}],
}


def held_by(**keys):
    return [BRACKET["supports"][0], {"node": 1, **keys}, BRACKET["supports"][2]]


@pytest.mark.parametrize(("side", "sign"), [("left", 1.0), ("right", -1.0)])
def test_one_part_is_clamped(side, sign):
    """That part has q L^2/8 at its end, or that over 1 + 3 EI/(c L); the other is a simple beam."""
    for rotation, share in (("fixed", 1.0), (75.0, 0.5), ({"stiffness": 75.0}, 0.5)):
        result = gapbeam.solve(BRACKET | {"supports": held_by(rotation=rotation, at_hinge=side)})
        couple = sign * 2.0 * share
        assert result.steps[-1].couple.tolist() == pytest.approx([0.0, couple, 0.0, 0.0], rel=1e-15)
        assert result.at([2.0, 6.0]).moment.tolist() == pytest.approx([2.0 - share, 2.0][:: int(sign)], rel=1e-15)
        assert result.extremes["moment"]["min"].value == pytest.approx(-2.0 * share, rel=1e-15)
        assert result.steps[-1].reaction[1] == pytest.approx(4.0 + share / 2.0, rel=1e-15)


@pytest.mark.parametrize("stiffness", [1e-9, 1.0, 1e9])
@pytest.mark.parametrize("EI", [1.0, 2.0**400])
def test_couples_at_an_elastic_hinge(stiffness, EI):
    """Arms of 4 EI/L on both sides, and the hinge as a spring of c between their ends: c (a + 4) = 4 b = M beside it."""
    scene = {"beam": {"spans": [1.0, 1.0], "EI": EI}, "hinges": [{"node": 1, "stiffness": stiffness * EI}],
             "supports": [{"node": 0, "rotation": "fixed"}, {"node": 1}, {"node": 2, "rotation": "fixed"}]}  # fmt: skip
    c = Fraction(stiffness)
    far = c / (c + 4)  # of the couple that goes through the hinge into the other arm
    passed = float(4 * far / (c * 4 / (c + 4) + 4))
    for side, sign in (("left", 1.0), ("right", -1.0)):
        load = {"type": "moment", "node": 1, "M": EI, "at_hinge": side}
        result = gapbeam.solve(scene | {"loads": [load]})
        assert result.steps[-1].hinges[0].moment == pytest.approx(sign * passed * EI, rel=1e-14)
        ends = result.at([0.0, 2.0]).moment
        assert ends[0 if side == "right" else 1] == pytest.approx(-sign * passed / 2 * EI, rel=1e-14)
        assert ends[1 if side == "right" else 0] == pytest.approx(sign * (1.0 - passed) / 2 * EI, rel=1e-14)


PLASTIC = {"law": [[0.004, 0.5], [0.1, 0.7]], "unloading": "plastic"}


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize("hinge", [{"x": 3.0}, {"x": 3.0, "law": [[0.002, 0.3], [0.1, 0.3]], "unloading": "plastic"}])
def test_history_as_of_a_support_aside(side, hinge):
    """Events and states of a history are those with the support 1e-7 aside, with axial forces beside."""
    def scene(x, **keys):
        return {
            "beam": {"spans": [4.0, 4.0], "EI": 100.0, "EA": 500.0, "GA": 60.0}, "hinges": [hinge],
            "supports": [{"node": 0, "rotation": "fixed"}, {"node": 1, "side": "below", "gap": 0.001}, {"node": 2, "side": "below"},
                         {"node": 0, "direction": "axial"}, {"x": x, "direction": "rotational", **PLASTIC, **keys}],
            "loads": [{"type": "uniform", "q": 1.0, "case": "dead"}, {"type": "force", "x": 2.5, "F": 12.0},
                      {"type": "axial", "x": 3.5, "F": 2.0}],
            "analysis": {"follow": "events", "history": [1.0, -0.4, 1.2]},
        }  # fmt: skip
    at = gapbeam.solve(scene(3.0, at_hinge=side))
    aside = gapbeam.solve(scene(3.0 + (1e-7 if side == "right" else -1e-7)))
    assert at.status == aside.status
    assert [(one.support, one.event) for one in at.events] == [(one.support, one.event) for one in aside.events]
    assert [one.factor for one in at.events] == pytest.approx([one.factor for one in aside.events], abs=1e-5)
    assert len(at.events) >= 4
    for one, other in zip(at.steps, aside.steps, strict=True):
        assert one.reaction.tolist() == pytest.approx(other.reaction.tolist(), abs=2e-5)
        assert one.deflection.tolist() == pytest.approx(other.deflection.tolist(), abs=2e-5)


def test_combinations_and_cases_are_states():
    law = {"law": [[0.01, 1.0], [0.1, 1.2]], "slack": 0.001}
    scene = BRACKET | {"supports": held_by(rotation=law, at_hinge="right", side="below"), "hinges": [],
                       "loads": [*BRACKET["loads"], {"type": "force", "x": 5.0, "F": -2.0, "case": "wind"}]}  # fmt: skip
    factors = [(1.0, 1.0), (0.5, -1.0), (0.0, 1.0), (2.0, 0.0)]
    combined = [{"name": str(k), "factors": {"live": a, "wind": b}} for k, (a, b) in enumerate(factors)]
    result = gapbeam.solve({**scene, "combinations": combined})
    many = gapbeam.prepare(scene).solve(factors)
    for k, (a, b) in enumerate(factors):
        loads = [{"type": "uniform", "q": a}, {"type": "force", "x": 5.0, "F": -2.0 * b}]
        step = gapbeam.solve({**scene, "loads": loads}).steps[-1]
        for other in (result.combinations[str(k)].steps[-1].reaction, many.reaction[k]):
            assert other.tolist() == pytest.approx(step.reaction.tolist(), abs=1e-13)


@pytest.mark.parametrize("follow", ["steps", "events"])
@pytest.mark.parametrize("ground", [[], [{"k": 5.0}]])
@pytest.mark.parametrize("side", ["left", "right"])
def test_a_restraint_at_a_hinge_that_yields(side, ground, follow):
    """Its couple is the moment on its side of the free hinge, and there is none on the other."""
    held = {"node": 1, "rotation": {"law": [[0.001, 0.5], [1.0, 0.5]]}, "at_hinge": side}
    scene = {"beam": {"spans": [2.0, 2.0], "EI": 100.0, "hinges": [2.0]}, "supports": [{"node": 0}, held, {"node": 2}],
             "loads": [{"type": "uniform", "q": 5.0}], "foundation": ground, "analysis": {"follow": follow}}  # fmt: skip
    result = gapbeam.solve(scene)
    assert result.steps[-1].state[3] == "branch 2"
    assert {at: result.at(2.0, side=at).moment for at in ("left", "right")} == {"left": 0.0, "right": 0.0, side: -0.5}


def test_names_report_picture_and_file():
    result = gapbeam.solve(BRACKET | {"supports": held_by(rotation=5.0, at_hinge="left", name="wall")})
    assert [one.name for one in result.scene.supports] == [None, "wall", None, "rotation of wall"]
    assert "1 of a rotation at a hinge" in " ".join(report_text(result, verbose=True).split())
    drawn = [one.get_label() for axes in result.plot().axes for one in axes.collections]
    assert "rotations at hinges" in drawn
    again = gapbeam.solve(result.scene.to_dict())
    assert again.steps[-1] == result.steps[-1]


@pytest.mark.parametrize(("changes", "words"), [
    ({"supports": held_by(rotation="fixed")},
     'supports[1].rotation: there is a hinge here, so it is unclear which side is held; say at_hinge = "left" or "right"'),
    ({"supports": held_by(rotation={"slack": 0.1})}, 'say at_hinge = "left" or "right"'),
    ({"supports": held_by(rotation={"slack": 0.1}), "beam": {"spans": [4.0, 4.0], "EI": 1.0},
      "hinges": [{"node": 1, "stiffness": 2.0}]}, 'say at_hinge = "left" or "right"'),
    ({"beam": {"spans": [4.0, 4.0], "EI": 1.0}}, "at_hinge: there is no hinge at its place; leave it out"),
    ({"supports": held_by(at_hinge="left")}, "supports[1].at_hinge: it says on which side of a hinge a rotation is held"),
    ({"supports": held_by(rotation=-1.0, at_hinge="left")},
     'supports[1].rotation: expected "free", "fixed" or a number, 0 or more'),
    ({"supports": [*BRACKET["supports"], {"node": 1, "direction": "rotational", "at_hinge": "right", "name": "B"}]},
     'supports[1].at_hinge: the other side of the hinge is held too'),
    ({"beam": {"spans": [4.0, 4.0], "EI": [INF, 1.0], "hinges": [4.0]}}, "beside a rigid beam"),
])  # fmt: skip
def test_refused(changes, words):
    with pytest.raises(SceneError) as caught:
        gapbeam.solve(BRACKET | changes).extremes  # noqa: B018 - trains are asked there
    assert words in str(caught.value)
