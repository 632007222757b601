"""Combinations that take the contact state of another one: with gaps, sides and settlements, beside rational numbers."""

import random

import gapbeam
import oracle
import pytest
from scenes import at, force, place, scene

from .test_combinations import by_hand


def held_in_scheme(written, states):
    """The beam of a given scheme, and which supports are left: open ones are gone, closed ones hold where they touch."""
    touches = oracle.Oracle({**written, "loads": []}).acting_level
    supports = {
        i: {key: value for key, value in one.items() if key not in ("side", "gap")} | {"settlement": float(touches(i))}
        for i, one in enumerate(written["supports"])
        if states[i] != "open"
    }
    return {**written, "supports": list(supports.values())}, list(supports)


def exact_scheme(made, one, states):
    """Reactions and deflections in rational numbers of a combination that takes a scheme."""
    written, there = held_in_scheme(by_hand(made, one), states)
    solution = oracle.solve(written)
    reaction = dict(zip(there, solution.reaction, strict=True))
    places = [place(made, support) for support in made["supports"]]
    return [float(reaction.get(i, 0)) for i in range(len(places))], [float(solution.at(x).deflection) for x in places]


@pytest.mark.parametrize("side", ["below", "above"])
@pytest.mark.parametrize("gap", [-0.004, 0.0, 0.004])
@pytest.mark.parametrize("settlement", [-0.003, 0.0, 0.003])
def test_a_closed_support_holds_where_it_touches(side, gap, settlement):
    """Closed by a great load either way, it is a support both ways at settlement + gap below, settlement - gap above the beam."""
    push = 400.0 if side == "below" else -400.0
    made = scene([2.0, 2.0], [at(0), at(1, side=side, gap=gap, settlement=settlement), at(2)],
                 [force(2.0, push, case="a"), force(1.0, 7.0, case="b")], EI=1e3) | {
        "combinations": [{"name": "x", "factors": {"a": 1.0}},
                         {"name": "y", "factors": {"b": 1.0}, "settlements": {"1": 0.001}, "scheme_of": "x"}]}  # fmt: skip
    x, y = (gapbeam.solve(made).combinations[name].steps[-1] for name in "xy")
    assert x.state[1] == "closed"
    level = settlement + 0.001 + (gap if side == "below" else -gap)
    assert y.deflection[1] == pytest.approx(level, rel=1e-12, abs=1e-16)
    # A simple beam under F in the first quarter sags 11 F L^3 / 768 EI in the middle, and L^3 / 48 EI under a unit force there
    assert y.reaction[1] == pytest.approx((11 * 7.0 / 768 - level * 1e3 / 64) * 48, rel=1e-12)


def test_schemes_taken_from_others_are_solved_exactly():
    """Gaps of either sign, both sides, settlements, springs, movements in either combination; beside rational numbers."""
    states = set()
    for seed in range(60):
        rng = random.Random(seed)
        count = rng.randint(2, 4)
        supports = [at(0, settlement=rng.choice((0.0, 0.002)))]
        for i in range(1, count + 1):
            one = {"side": rng.choice(("below", "below", "above")), "gap": rng.choice((-0.004, 0.0, 0.002, 0.006))}
            spring = {"stiffness": 5e3} if rng.random() < 0.3 else {}
            supports.append(at(i, settlement=rng.choice((-0.003, 0.0, 0.0, 0.001)), **one, **spring))
        supports.append(at(count + 1))
        spans = [rng.choice((1.0, 1.5, 2.0)) for _ in range(count + 1)]
        loads = [force(rng.uniform(0.1, sum(spans) - 0.1), rng.uniform(-60, 90), case=case) for case in "aabb"]
        made = scene(spans, supports, loads, EI=1e3)

        def moves(rng=rng, supports=supports):
            return {str(i): rng.choice((-0.002, 0.0, 0.003)) for i in range(len(supports))}

        leads, takes = ({"factors": {case: rng.choice((1.0, 1.35))}, "settlements": moves()} for case in "ab")
        made["combinations"] = [dict(leads, name="leads"), dict(takes, name="takes", scheme_of="leads")]
        result = gapbeam.solve(made)
        first, second = (result.combinations[name].steps[-1] for name in ("leads", "takes"))
        assert [a == "open" for a in first.state] == [b == "open" for b in second.state], seed
        reaction, deflection = exact_scheme(made, takes, first.state)
        assert second.reaction == pytest.approx(reaction, abs=1e-11 * max(map(abs, reaction))), seed
        assert second.deflection == pytest.approx(deflection, abs=1e-11 * max(map(abs, deflection))), seed
        states |= {(one["side"], one["gap"] > 0, state) for one, state in zip(supports, first.state, strict=True) if "side" in one}
    assert len(states) == 8  # both sides, gaps of either sign, closed and open


def test_without_the_other_combination_there_is_no_step_and_it_is_said_why():
    result = gapbeam.solve({
        "beam": {"spans": [4.0], "EI": 1e4}, "supports": [{"node": 0, "side": "below"}],
        "loads": [{"type": "force", "x": 3.0, "F": 1.0}],
        "combinations": [{"name": "falls", "factors": {"live": 1.0}},
                         {"name": "takes", "factors": {"live": 1.0}, "scheme_of": "falls"}],
    })  # fmt: skip
    with pytest.raises(gapbeam.UnsolvedError, match='no load step stands; the combination "falls", whose contact state'):
        result.combinations["takes"].table("supports")


@pytest.mark.parametrize(("side", "couple"), [("clockwise", 0.0), ("counterclockwise", 36.0 / 7.0)])
def test_a_restraint_that_turns_the_beam_one_way_only(side, couple):
    """Two spans L under q: without a couple at the end 3 q L / 8, held there 11 q L / 28, with a couple of q L^2 / 14."""
    made = scene([6.0, 6.0], [at(0, rotation={"side": side}), at(1, side="below"), at(2)],
                 [{"type": "uniform", "q": 2.0, "case": "dead"}, force(3.0, 60.0, case="crane")], EI=1e4)  # fmt: skip
    factors = {"dead": 1.0, "crane": 1.0}
    made["combinations"] = [{"name": "x", "factors": factors}, {"name": "y", "factors": {"dead": 1.0}, "scheme_of": "x"}]
    result = gapbeam.solve(made)
    state = result.combinations["x"].states["rotation of 0"]
    assert state == ("closed" if couple else "open")
    found = result.combinations["y"].reactions
    assert found["rotation of 0"] == pytest.approx(couple, rel=1e-12)
    # The three-moment equation: 4 M1 - couple = - q L^2 / 2
    middle = (-36.0 + couple) / 4
    left = 6.0 + (middle + couple) / 6
    assert [found[0], found[2]] == pytest.approx([left, 6.0 + middle / 6], rel=1e-12)
