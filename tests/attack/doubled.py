"""Several supports at a place: plain ones in rational numbers, laws beside one support whose law is the sum of theirs."""

import random
from fractions import Fraction
from itertools import pairwise

import gapbeam
from gapbeam.base.errors import Status
from oracle.laws import follow
from scenes.law import law_scene, random_law

from . import draw, signs
from .family import Family, Verdict

PROMISE = (
    "Each of two or three supports at one point has the force that its own stiffness, gap or curve gives. Supports with "
    "curves carry together what one with the sum of their curves carries, in its exact state. Where shares are not unique "
    "the scene is refused"
)
NEAR = 1e-10


def draw_scene(seed):
    """Kind and scene of a seed."""
    rng = random.Random(seed)
    if rng.random() < 0.5:
        return draw.until_valid(lambda: ("plain", plain(rng)))
    with_laws = []
    while not with_laws:
        made = law_scene(rng.randrange(10**6), "hardening")
        with_laws = [k for k, support in enumerate(made["supports"]) if "law" in support]
    made["analysis"] = {"follow": rng.choice(("steps", "events"))}
    chosen = rng.choice(with_laws)
    twins = [dict(made["supports"][chosen], law=random_law(rng, "hardening")) for _ in range(rng.choice((1, 1, 2)))]
    made["supports"][chosen + 1 : chosen + 1] = twins
    return "laws", made


def plain(rng):
    """A beam some of whose one-sided supports stand beside others."""
    sizes = rng.choice((draw.ROUND, draw.ORDINARY, draw.SPREAD))
    made = draw.draw_beam(rng, sizes, bilateral=rng.choice((0.1, 0.4)), most=4, hinges=rng.choice((0.0, 0.2)), spans=(1, 4))
    sided = [support for support in made["supports"] if "side" in support]
    for support in rng.sample(sided, min(len(sided), rng.choice((1, 2)))):
        twin = {key: value for key, value in support.items() if key in ("node", "x", "side")}
        if rng.random() < 0.7:
            twin["gap"] = rng.choice((1.0, 1.0, -1.0)) * sizes.number(rng, 0.01)
        if rng.random() < 0.7:
            twin["stiffness"] = sizes.number(rng, 1e4)
        made["supports"].insert(rng.randrange(len(made["supports"]) + 1), twin)
    made["loads"] = draw.draw_loads(rng, sizes, made)
    return made


def judge(made, seed=0):
    """Compare a scene with what is exact."""
    if not any("law" in support for support in made["supports"]):
        return signs.judge(made, seed)
    groups = {}
    for k, support in enumerate(made["supports"]):
        groups.setdefault((draw.place(made, support), "law" in support), []).append(k)
    together = [[made["supports"][k] for k in group] for group in groups.values()]
    exact = follow({**made, "supports": [dict(group[0], law=added([s["law"] for s in group])) if "law" in group[0] else group[0]
                                         for group in together], "analysis": {"follow": "events"}})  # fmt: skip
    verdict = Verdict(exact.status)
    if exact.status != "solved":
        verdict.outcome = f"no exact path: {exact.status}"
        return verdict
    try:
        result = gapbeam.solve(made)
    except (gapbeam.SceneError, gapbeam.EngineError) as error:
        verdict.outcome = "forces not unique"
        named = "rigid at the same deflection" in str(error) or getattr(error, "status", None) == Status.INDETERMINATE
        if not named or not any(map(shares_are_free, together)):
            verdict.wrong.append(f"refused: {error}")
        return verdict
    if result.status != "solved":
        verdict.wrong.append(f"{result.status}, not solved: {result.reason}")
        return verdict
    step, ends = result.steps[-1], exact.end
    number = {k: i for i, k in enumerate(exact.problem.which)}
    size = max(1.0, *(abs(float(force)) for force in ends.reaction))
    way = max(1e-3, *(abs(float(w)) for w in ends.w))
    for k, group in enumerate(groups.values()):
        if k not in number:
            continue
        force, deflection = float(ends.reaction[number[k]]), float(ends.w[number[k]])
        carried = sum(step.reaction[i] for i in group)
        if not abs(carried - force) <= NEAR * size:
            verdict.wrong.append(f"supports {group} carry {carried:.9g}, not {force:.9g}")
        verdict.wrong += [f"support {i} at {step.deflection[i]:.9g}, not {deflection:.9g}" for i in group
                          if not abs(step.deflection[i] - deflection) <= NEAR * way]  # fmt: skip
    return verdict


def shares_are_free(group):
    """Whether two laws of a group have a vertical piece at the same deflection."""
    steep = [x[0] for s in group if "law" in s for x, y in pairwise([[0.0, 0.0], *s["law"]]) if x[0] == y[0]]
    return len(set(steep)) < len(steep)


def added(laws):
    """The law of several supports at a place with the same gap and side: the sum of their forces at every deflection."""
    if len(laws) == 1:
        return laws[0]
    curves = [[(Fraction(0), Fraction(0)), *((Fraction(d), Fraction(r)) for d, r in law)] for law in laws]
    points, wall = [], min((curve[-1][0] for curve in curves if curve[-1][0] == curve[-2][0]), default=None)
    for d in sorted({d for curve in curves for d, _ in curve if wall is None or d <= wall}):
        for side in (0, -1):  # before a vertical piece, and after it
            point = [float(d), float(sum(force(curve, d, side) for curve in curves))]
            if point not in (points[-1:] or [[0.0, 0.0]]):
                points.append(point)
    if wall is not None:
        return points
    beyond = Fraction(points[-1][0]) + 1
    return [*points, [float(beyond), float(sum(force(curve, beyond, -1) for curve in curves))]]


def force(curve, d, side):
    """Force of a law that does not fall; at a vertical piece of its lower (0) or upper (-1) end."""
    there = [r for at, r in curve if at == d]
    if there:
        return there[side]
    for (a, r), (b, s) in pairwise(curve):
        if a < d < b:
            return r + (s - r) * (d - a) / (b - a)
    (a, r), (b, s) = curve[-2:]
    return s + (s - r) / (b - a) * (d - b)


FAMILY = Family("doubled", PROMISE, draw_scene, judge, share=0.4)
