"""What must hold for every result, whatever the scene: checked on a family of seeded random scenes."""

import copy
import itertools
import random

import gapbeam
import numpy as np
import oracle
import pytest
from scenes import INF, cut, mirrored, nodes_of, one_sided, place, random_scene, working_scheme
from scenes.units import in_units

TOLERANCE = 2e-12
NAMES = ("deflection", "rotation", "moment", "shear")


def standing(seed):
    """The first scene from this seed on that can stand in one way only, with its result."""
    while True:
        rng = random.Random(seed)
        made = random_scene(rng, held=rng.choice((True, True, None, False)))
        steps = made["analysis"]["steps"]
        if all(oracle.solve(made, (k + 1) / steps).status == "solved" for k in range(steps)):
            result = gapbeam.solve(made)
            assert result.status == "solved", result.reason
            return made, result
        seed += 1


SEEDS = range(0, 400, 10)


@pytest.fixture(scope="module", params=SEEDS)
def solved(request):
    """One random scene with its result."""
    return standing(request.param)


def probe(made, count=17):
    """Places inside the beam, away from where anything jumps."""
    length = nodes_of(made)[-1]
    return length * (np.arange(count) + 0.4142135623730951) / count


def same(actual, expected, scale=None):
    """Equality to `TOLERANCE` of the largest value."""
    scale = np.abs(expected).max(initial=0.0) if scale is None else scale
    np.testing.assert_allclose(actual, expected, rtol=0.0, atol=TOLERANCE * scale)


def same_answers(made, one, other, x=None, mirror=False, force=1.0, length=1.0):
    """Two results that must agree: `one`, and `other` seen in other units or from behind."""
    assert one.status == other.status
    x = probe(made) if x is None else x
    turn = -1.0 if mirror else 1.0
    for k, (a, b) in enumerate(zip(one.steps, other.steps, strict=True)):
        lengths = np.abs(one.at(x, step=k).deflection).max() + np.abs(a.deflection).max()
        forces = np.abs(a.reaction).max() + np.abs(one.at(x, step=k).shear).max()
        same(b.reaction / force, a.reaction, forces)
        same(b.deflection / length, a.deflection, lengths)
        same(b.opening / length, a.opening, lengths + a.opening.max())
        moments = np.abs(one.at(x, step=k).moment).max()
        same(turn * b.couple / (force * length), a.couple, moments + np.abs(a.couple).max())
        there = (nodes_of(made)[-1] - x if mirror else x) * length
        fields, others = one.at(x, step=k), other.at(there, step=k)
        same(others.deflection / length, fields.deflection, lengths)
        same(turn * others.rotation, fields.rotation)
        same(others.moment / (force * length), fields.moment)
        same(turn * others.shear / force, fields.shear, forces)
        sharp = (np.abs(a.reaction) > 1e-11 * forces) | (a.opening > 1e-11 * lengths)
        assert all(s == t for s, t, clear in zip(a.state, b.state, sharp, strict=True) if clear)


def resultants(made, factor, about):
    """Sum of the loads, their clockwise moment about a place, and sizes of both to compare with."""
    force = turn = force_size = turn_size = 0.0
    length = nodes_of(made)[-1]
    for load in made["loads"]:
        share = factor if load.get("case", "live") == "live" else 1.0
        parts = []  # (force, place)
        if load["type"] == "force":
            parts = [(load["F"], place(made, load))]
        elif load["type"] == "moment":
            turn, turn_size = turn + share * load["M"], turn_size + abs(load["M"])
        elif load["type"] in ("uniform", "linear"):
            a, b = load.get("from", 0.0), load.get("to", length)
            q = load["q"] if load["type"] == "linear" else [load["q"]] * 2
            parts = [(q[0] * (b - a) / 2, a + (b - a) / 3), (q[1] * (b - a) / 2, a + 2 * (b - a) / 3)]
        for F, x in parts:
            force, turn = force + share * F, turn + share * F * (x - about)
            force_size, turn_size = force_size + abs(F), turn_size + abs(F) * length
    return force, turn, force_size, turn_size


def test_sums_of_forces_and_moments(solved):
    made, result = solved
    x = np.array([place(made, s) for s in made["supports"]])
    for step in result.steps:
        for about in (0.0, nodes_of(made)[-1]):
            force, turn, size, turn_size = resultants(made, step.factor, about)
            size += np.abs(step.reaction).sum()
            turn_size += (np.abs(step.reaction) * nodes_of(made)[-1]).sum() + np.abs(step.couple).sum()
            assert abs(step.reaction.sum() - force) <= TOLERANCE * size
            assert (
                abs(turn - (step.reaction * (x - about)).sum() + step.couple.sum()) <= TOLERANCE * turn_size
            )


def test_contact_conditions(solved):
    made, result = solved
    for step in result.steps:
        lengths = np.abs(step.deflection).max() + np.abs(step.opening).max() + 1e-3
        for i, support in enumerate(made["supports"]):
            side, R, w, apart = (
                support.get("side", "both"),
                step.reaction[i],
                step.deflection[i],
                step.opening[i],
            )
            level = support.get("settlement", 0.0) + {"below": 1, "above": -1, "both": 0}[side] * support.get(
                "gap", 0.0
            )
            spring = level + R / support.get("stiffness", INF)
            assert step.state[i] in (("bilateral",) if side == "both" else ("closed", "open"))
            assert apart >= 0.0
            assert apart * R == 0.0
            assert side != "below" or R >= 0.0
            assert side != "above" or R <= 0.0
            if step.state[i] == "open":
                assert R == 0.0
                same(apart, level - w if side == "below" else w - level, lengths)
            else:
                assert apart == 0.0
                same(w, spring, lengths)
            if support.get("rotation", "free") == "free":
                assert step.couple[i] == 0.0


def test_residuals_are_small(solved):
    for step in solved[1].steps:
        for name in ("equilibrium", "compatibility", "complementarity"):
            assert 0.0 <= step.certificate[name] < 1e-12, name


def test_closed_supports_as_bilateral_ones_give_the_same(solved):
    made, result = solved
    frozen = working_scheme(made, result.steps[-1].state)
    frozen["analysis"] = {"steps": 1}
    linear = gapbeam.solve(frozen)
    assert linear.status == "solved"
    kept = [i for i, state in enumerate(result.steps[-1].state) if state != "open"]
    same(linear.steps[-1].reaction, result.steps[-1].reaction[kept])
    x = probe(made)
    for name in NAMES:
        same(getattr(linear.at(x), name), getattr(result.at(x), name))


@pytest.mark.parametrize("seed", range(25))
def test_superposition_where_nothing_opens(seed):
    made = random_scene(random.Random(seed), held=True, linear_only=True)
    made["analysis"] = {"steps": 1}
    half = len(made["loads"]) // 2
    parts = {"all": made["loads"], "first": made["loads"][:half], "second": made["loads"][half:], "none": []}
    results = {name: gapbeam.solve({**made, "loads": loads}) for name, loads in parts.items()}
    x = probe(made)
    for name in NAMES:
        whole, first, second, none = (getattr(results[key].at(x), name) for key in parts)
        size = sum(np.abs(part).max() for part in (whole, first, second, none))
        same(first + second - none, whole, size)
    whole, first, second, none = (results[key].steps[-1].reaction for key in parts)
    same(first + second - none, whole, sum(np.abs(part).max() for part in (whole, first, second, none)))


def test_mirror_image(solved):
    made, result = solved
    same_answers(made, result, gapbeam.solve(mirrored(made)), mirror=True)


@pytest.mark.parametrize(("force", "length"), [(1e6, 1.0), (1e-6, 1.0), (1.0, 1e6), (1.0, 1e-6), (1e-6, 1e6)])
def test_other_units(solved, force, length):
    made, result = solved
    other = gapbeam.solve(in_units(made, force, length))
    same_answers(made, result, other, force=force, length=length)


@pytest.mark.parametrize("share", [0.5, 0.123])
def test_span_cut_in_two(solved, share):
    made, result = solved
    for span in range(len(made["beam"]["spans"])):
        same_answers(made, result, gapbeam.solve(cut(made, span, share)))


def test_both_rules_agree(solved):
    made, _ = solved
    same_answers(made, gapbeam.solve(made, rule="block"), gapbeam.solve(made, rule="single"))


def test_repeated_call_is_the_same_to_the_last_bit(solved):
    made, result = solved
    before = copy.deepcopy(made)
    again = gapbeam.solve(made)
    assert made == before
    for a, b in zip(result.steps, again.steps, strict=True):
        assert a.state == b.state
        assert a.solves == b.solves
        for name in ("reaction", "deflection", "opening", "couple"):
            assert getattr(a, name).tobytes() == getattr(b, name).tobytes()
    x = probe(made)
    for name in NAMES:
        assert getattr(result.at(x), name).tobytes() == getattr(again.at(x), name).tobytes()


def stiffness_at(made, key, x):
    """EI or GA at one place."""
    value = made["beam"].get(key, INF)
    if isinstance(value, list):
        value = value[int(np.searchsorted(nodes_of(made), x)) - 1]
    for section in made.get("sections", ()):
        if key in section and section.get("from", 0.0) < x < section.get("to", INF):
            value = section[key]
    return value


def spread_at(made, x, factor):
    """Distributed load and imposed curvature at one place."""
    q = kappa = 0.0
    for load in made["loads"]:
        a, b = load.get("from", 0.0), load.get("to", nodes_of(made)[-1])
        share = factor if load.get("case", "live") == "live" else 1.0
        if load["type"] in ("force", "moment") or not a < x < b:
            continue
        if load["type"] == "curvature":
            kappa += share * load["kappa"]
        else:
            first, last = load["q"] if load["type"] == "linear" else (load["q"], load["q"])
            q += share * (first + (last - first) * (x - a) / (b - a))
    return q, kappa


def smooth_stretches(made):
    """Stretches without a jump of anything, long enough to differentiate on."""
    length = nodes_of(made)[-1]
    marks = {*nodes_of(made), *made["beam"].get("hinges", ())}
    for item in (*made["supports"], *made["loads"], *made.get("sections", ())):
        if "x" in item or "node" in item:
            marks.add(place(made, item))
        else:
            marks |= {item.get("from", 0.0), item.get("to", length)}
    marks = sorted(marks)
    return [(a, b) for a, b in itertools.pairwise(marks) if b - a > 0.04 * length]


def test_fields_satisfy_the_beam_equations(solved):
    """w' = psi + V/GA, psi' = -M/EI + kappa, M' = V, V' = -q: exact on polynomials through 6 points."""
    made, result = solved
    factor = result.steps[-1].factor
    cosines = np.cos(np.pi * (np.arange(6) + 0.5) / 6)
    for a, b in smooth_stretches(made):
        x = (a + b) / 2 - (b - a) / 2 * cosines
        fields = result.at(x)
        q, kappa = np.array([spread_at(made, v, factor) for v in x]).T
        EI, GA = (stiffness_at(made, key, (a + b) / 2) for key in ("EI", "GA"))
        wanted = {"deflection": fields.rotation + fields.shear / GA, "rotation": kappa - fields.moment / EI,
                  "moment": fields.shear, "shear": -q}  # fmt: skip
        for name, slope in wanted.items():
            values = getattr(fields, name)
            fitted = np.polynomial.Polynomial.fit(x, values, 5).deriv()(x)
            noise = np.abs(values).max() / (b - a)
            np.testing.assert_allclose(
                fitted, slope, rtol=0.0, atol=1e-11 * (np.abs(slope).max() + 30 * noise)
            )


def test_fields_jump_by_what_acts(solved):
    made, result = solved
    step, length = result.steps[-1], nodes_of(made)[-1]
    spots = sorted({place(made, item) for item in made["supports"]})
    everything = result.at(probe(made))
    forces = np.abs(everything.shear).max() + np.abs(step.reaction).max()
    moments = np.abs(everything.moment).max() + np.abs(step.couple).max()
    for x in (x for x in spots if 0.0 < x < length):
        left, right = result.at(x, side="left"), result.at(x, side="right")
        here = [i for i, s in enumerate(made["supports"]) if abs(place(made, s) - x) < 1e-9]
        loads = [load for load in made["loads"] if load["type"] in ("force", "moment")]
        loads = [load for load in loads if abs(place(made, load) - x) < 1e-9]
        share = [step.factor if load.get("case", "live") == "live" else 1.0 for load in loads]
        P = sum(s * load.get("F", 0.0) for s, load in zip(share, loads, strict=True))
        C = sum(s * load.get("M", 0.0) for s, load in zip(share, loads, strict=True))
        same(right.shear - left.shear, step.reaction[here].sum() - P, forces + abs(P))
        same(right.moment - left.moment, step.couple[here].sum() + C, moments + abs(C))
        same(right.deflection, step.deflection[here[0]], np.abs(everything.deflection).max())
        same(left.deflection, step.deflection[here[0]], np.abs(everything.deflection).max())
    for x in made["beam"].get("hinges", ()):
        same(result.at(x, side="left").moment, 0.0, moments)
        same(result.at(x, side="right").moment, 0.0, moments)


def test_extremes_are_reached_and_not_exceeded(solved):
    _, result = solved
    extremes, table = result._pairs_of_extremes(), result.fields(points=50)
    for name in NAMES:
        values = getattr(table, name)
        size = np.abs(values).max()
        (high, x_high), (low, x_low) = extremes[name]["max"], extremes[name]["min"]
        assert values.max() <= high + TOLERANCE * size
        assert values.min() >= low - TOLERANCE * size
        for value, x in ((high, x_high), (low, x_low)):
            reached = [np.ravel(getattr(result.at(x, side=side), name))[0] for side in ("left", "right")]
            assert min(abs(v - value) for v in reached) <= TOLERANCE * size, (name, value, x)


def test_the_family_has_everything():
    """The other tests mean little if the scenes are all alike."""
    seen = set()
    for made, result in map(standing, SEEDS):
        seen |= {state for step in result.steps for state in step.state}
        seen |= {load["type"] for load in made["loads"]}
        seen |= {"hinges"} & made["beam"].keys() | {"sections"} & made.keys()
        seen |= {"rigid" for s in made.get("sections", ()) if s.get("EI") == INF}
        seen |= {"one-sided only"} if len(one_sided(made)) == len(made["supports"]) else set()
    assert seen >= {"open", "closed", "bilateral", "one-sided only", "hinges", "sections", "rigid"}
    assert seen >= {"force", "moment", "uniform", "linear", "curvature"}
