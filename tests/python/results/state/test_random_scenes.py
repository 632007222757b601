"""Random scenes against the exact solution of `oracle/equilibrium.py`: values, contact states, and whether it can stand.

Agreement is asked to 1e-12 of the largest value of each kind. Where the answer itself moves by more than that
when every number of the scene changes in its last digits, no method in double precision can do better; there
the bound is that movement.
"""

import copy
import random
from fractions import Fraction

import gapbeam
import numpy as np
import oracle
import pytest
from hypothesis import given, note
from hypothesis import strategies as st
from oracle import axial
from scenes import nodes_of, one_sided, place, random_scene

TOLERANCE = 1e-12
KINDS = ("deflection", "rotation", "moment", "shear")


def exact_values(solution, points):
    """Everything compared, by kind, as arrays of floats."""
    fields = [solution.at(x, side) for x, side in points]
    values = {kind: np.array([float(getattr(point, kind)) for point in fields]) for kind in KINDS}
    values["reaction"] = np.array([float(v) for v in solution.reaction])
    values["couple"] = np.array([float(v) for v in solution.couple])
    values["support deflection"] = np.array([float(v) for v in solution.deflection])
    values["opening"] = np.array([float(v) for v in solution.opening])
    return values


def engine_values(result, index, points):
    """The same from the program under test."""
    fields = [result.at(x, step=index, side=side) for x, side in points]
    values = {kind: np.array([float(np.ravel(getattr(f, kind))[0]) for f in fields]) for kind in KINDS}
    step = result.steps[index]
    values.update({"reaction": step.reaction, "couple": step.couple, "opening": step.opening})
    values["support deflection"] = step.deflection
    return values


def scales(made, values):
    """The largest value of each kind; all forces count as one kind, and so do all displacements.

    What is zero throughout (the forces of a curvature imposed on a simple beam, the deflection under a couple
    on a clamp) comes out as the rounding error of something else, so the other kinds give a least scale.
    """

    def largest(*kinds):
        return max(np.abs(values[kind]).max(initial=0.0) for kind in kinds)

    lengths, forces = largest("deflection", "opening", "support deflection"), largest("reaction", "shear")
    rotations, couples, L = largest("rotation"), largest("couple", "moment"), nodes_of(made)[-1]
    EI = np.max(made["beam"]["EI"])
    least = max(1e-3 * forces * L, 1e-3 * couples, 1e-2 * EI * lengths / L**2)
    forces, couples = max(forces, least / L), max(couples, least)
    lengths, rotations = max(lengths, 0.1 * least * L**2 / EI), max(rotations, 0.1 * least * L / EI)
    same = dict.fromkeys(("reaction", "shear"), forces) | dict.fromkeys(("couple", "moment"), couples)
    same |= dict.fromkeys(("deflection", "opening", "support deflection"), lengths)
    return same | {"rotation": rotations}


def shaken(made, seed):
    """The scene with every number changed in its last digits, and where each place went."""
    rng, new, moved = random.Random(seed), copy.deepcopy(made), {}
    numbers = {"EI", "GA", "stiffness", "rotation", "gap", "settlement", "F", "M", "q", "kappa"}
    places = {"x", "from", "to", "hinges"}
    nodes = nodes_of(made)

    def shift(value, place):
        if isinstance(value, list):
            return [shift(number, place) for number in value]
        if isinstance(value, str) or (place and value in nodes):
            return value
        return moved.setdefault((place, value), value * (1 + rng.choice((-1, 1)) * 4e-16))

    for item in (new["beam"], *new["supports"], *new["loads"], *new.get("sections", ())):
        for key in item.keys() & (numbers | places):
            item[key] = shift(item[key], key in places)
    return new, {x: there for (place, x), there in moved.items() if place}


def sensitivity(made, factor, points, values, scale):
    """How far the exact answer moves, relative to its scale, when the scene moves in its last digits."""
    moved = dict.fromkeys(values, 0.0)
    for seed in range(4):
        other, moved_to = shaken(made, seed)
        solution = oracle.solve(other, factor)
        if solution.status != "solved":
            return dict.fromkeys(values, np.inf)
        others = exact_values(solution, [(moved_to.get(x, x), side) for x, side in points])
        for kind in values:
            size = np.abs(others[kind] - values[kind]).max(initial=0.0) / (scale[kind] or 1.0)
            moved[kind] = max(moved[kind], size)
    return moved


def check_step(made, result, index, solution, points):
    """One load step against its exact solution."""
    step = result.steps[index]
    expected, actual = exact_values(solution, points), engine_values(result, index, points)
    scale = scales(made, expected)
    wrong = {}
    for kind, values in expected.items():
        error = np.abs(actual[kind] - values).max(initial=0.0)
        if not error <= TOLERANCE * scale[kind]:
            wrong[kind] = error / (scale[kind] or 1.0)
    if wrong:  # seldom
        bound = sensitivity(made, step.factor, points, expected, scale)
        wrong = {kind: (size, bound[kind]) for kind, size in wrong.items() if not size <= 100 * bound[kind]}
    assert not wrong, f"relative errors, and movement of the exact answer: {wrong}"
    force = scale["reaction"] or 1.0
    for i, (state, right) in enumerate(zip(step.state, solution.state, strict=True)):
        sharp = abs(solution.reaction[i]) > 1e-11 * force or solution.opening[i] > 1e-11 * scale["opening"]
        assert state == right or (not sharp and i in one_sided(made)), (i, state, right)


def proves_no_equilibrium(made, beam, motion, factor):
    """Whether a motion from the program is free, keeps off every support, and is followed by the load."""
    x, w = (np.array(column, dtype=float) for column in zip(*motion, strict=True))
    assert set(np.round(x, 9)) <= {
        round(v, 9) for v in (0.0, nodes_of(made)[-1], *map(float, beam.hinges), *x)
    }
    size = np.abs(w).max()
    assert size > 0
    hinges = np.array([float(h) for h in beam.hinges])
    for k in range(1, len(x) - 1):
        slopes = (w[k] - w[k - 1]) / (x[k] - x[k - 1]), (w[k + 1] - w[k]) / (x[k + 1] - x[k])
        bent = abs(slopes[1] - slopes[0]) > 1e-9 * size
        assert not bent or np.abs(hinges - x[k]).min(initial=np.inf) < 1e-9, "bends where there is no hinge"
    for support in made["supports"]:
        here = np.interp(place(made, support), x, w)
        side = support.get("side", "both")
        assert side == "above" or here <= 1e-9 * size, "moves into a support"
        assert side == "below" or here >= -1e-9 * size, "moves into a support"
        if support.get("rotation", "free") != "free":
            k = int(np.clip(np.searchsorted(x, place(made, support)), 1, len(x) - 1))
            assert abs(w[k] - w[k - 1]) <= 1e-9 * size, "turns where rotation is held"
    slope = np.diff(w) / np.diff(x)
    vector = [Fraction(w[0]), Fraction(slope[0])]
    vector += [Fraction(_kink(x, slope, hinge)) for hinge in hinges]
    weights = (Fraction(1), Fraction(1), Fraction(factor))
    return beam.work(vector, weights) > 0


def _kink(x, slope, hinge):
    """Change of slope at a hinge of a piecewise linear motion."""
    k = int(np.argmin(np.abs(x - hinge)))
    return float(slope[k] - slope[k - 1]) if abs(x[k] - hinge) < 1e-9 and 0 < k < len(slope) else 0.0


def compare(made, points, **keys):
    """Solve a scene both ways and compare every load step."""
    beam, steps = oracle.Oracle(made), made["analysis"]["steps"]
    exact = [beam.solve(k / steps) for k in range(1, steps + 1)]
    try:
        result = gapbeam.solve(made, **keys)
    except gapbeam.EngineError:  # an honest answer only where a part is free to move without any work
        assert any(solution.status == "indifferent" for solution in exact)
        return "refused"
    if any(solution.status in ("indifferent", "loose") for solution in exact):
        return check_forces_only(made, result, exact, points)
    fallen = next((k for k, solution in enumerate(exact) if solution.status == "no-equilibrium"), None)
    assert result.status == ("solved" if fallen is None else "no-equilibrium"), result.reason
    assert len(result.steps) == (steps if fallen is None else fallen)
    for index in range(len(result.steps)):
        check_step(made, result, index, exact[index], points)
    if fallen is not None:
        assert result.reason
        assert proves_no_equilibrium(made, beam, result.motion, (fallen + 1) / steps)
    return result.status


def check_forces_only(made, result, exact, points):
    """Scenes in which some part may lie in more than one place: the forces are the same in all of them."""
    if all(solution.status in ("solved", "loose") for solution in exact):
        assert result.status == "solved", result.reason
        for index, solution in enumerate(exact):
            expected, actual = exact_values(solution, points), engine_values(result, index, points)
            scale = scales(made, expected)
            for kind in ("reaction", "couple", "moment", "shear"):
                np.testing.assert_allclose(actual[kind], expected[kind], rtol=0.0, atol=1e-11 * scale[kind])
    return "loose"


def draw_points(rng, made):
    """Where the fields are compared: anywhere, and on both sides of nodes, supports and loads."""
    length = nodes_of(made)[-1]
    special = [
        place(made, item) for item in (*made["supports"], *made["loads"]) if "x" in item or "node" in item
    ]
    points = [(x, side) for x in special for side in ("left", "right") if 0.0 < x < length]
    points += [(0.0, "right"), (length, "left")]
    return points + [
        (length * (0.001 + 0.998 * rng.random()), rng.choice(("left", "right"))) for _ in range(6)
    ]


@given(st.randoms(use_true_random=False), st.sampled_from([True, None, None, False]))
def test_random_scene(rng, held):
    made = random_scene(rng, held=held)
    points = draw_points(rng, made)
    note(repr(made))
    compare(made, points)


@pytest.mark.parametrize("rule", ["block", "single"])
@pytest.mark.parametrize("seed", range(60))
def test_any_starting_scheme(seed, rule):
    rng = random.Random(1000 + seed)
    made = random_scene(rng, held=rng.choice((True, None, False)))
    start = [rng.random() < 0.5 for _ in one_sided(made)]
    compare(made, draw_points(rng, made), rule=rule, start=start)


@pytest.mark.parametrize("seed", range(20))
def test_axial_system(seed):
    rng = random.Random(2000 + seed)
    made = random_scene(rng, held=True, linear_only=True)
    made["analysis"] = {"steps": rng.randint(1, 3)}
    length = nodes_of(made)[-1]
    made["beam"]["EA"] = [rng.uniform(1e3, 1e5) for _ in made["beam"]["spans"]]
    made.setdefault("sections", []).append({"from": 0.0, "to": length / 3, "EA": 5e4})
    spots = [{"node": 0}, {"x": length / 7}, {"node": len(made["beam"]["spans"])}]
    for spot in spots[: rng.randint(1, 3)]:
        spring = {"stiffness": rng.uniform(1e2, 1e5)} if rng.random() < 0.5 else {}
        made["supports"].append(dict(spot, direction="axial", **spring))
    rng.shuffle(made["supports"])
    made["loads"] += [{"type": "axial", "x": length * rng.random(), "F": rng.uniform(-50.0, 50.0),
                       "case": rng.choice(("dead", "live"))} for _ in range(3)]  # fmt: skip
    result = gapbeam.solve(made)
    rows = [i for i, s in enumerate(made["supports"]) if s.get("direction") == "axial"]
    points = [(length * rng.random(), side) for side in ("left", "right", "left", "right")]
    for index, step in enumerate(result.steps):
        bar = axial.Bar(made, step.factor)
        u, N = (
            np.array(column, dtype=float)
            for column in zip(*(bar.at(*point) for point in points), strict=True)
        )
        force, way = (
            np.abs([float(v) for v in values]).max() for values in (bar.reaction, [*bar.displacement, *u])
        )
        np.testing.assert_allclose(
            step.reaction[rows], np.array(bar.reaction, float), atol=TOLERANCE * force, rtol=0
        )
        here = np.array(bar.displacement, float)
        np.testing.assert_allclose(step.deflection[rows], here, atol=TOLERANCE * way, rtol=0)
        for k, (x, side) in enumerate(points):
            fields = result.at(x, step=index, side=side)
            assert abs(float(np.ravel(fields.axial_force)[0]) - N[k]) <= TOLERANCE * max(
                force, np.abs(N).max()
            )
            assert abs(float(np.ravel(fields.axial_displacement)[0]) - u[k]) <= TOLERANCE * way
