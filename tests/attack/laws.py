"""Supports that follow laws: paths, end states and histories beside exact ones, in rational numbers."""

import random
from itertools import pairwise

import gapbeam
import numpy as np
from gapbeam.engine.paths import Followed
from oracle.history import history
from oracle.laws import follow
from scenes.law import law_scene, symmetric_scene

from .family import Family, Verdict

PROMISE = (
    "On paths with falling curves every segment has its leg, load factors, direction and index, and all branches are found. "
    "On non-decreasing curves the end is the exact state. After histories of plastic and brittle supports so are states and "
    "sets"
)
FACTORS = 1e-12
STATES = 1e-11
SHORTEST = 1e-15
"""Way of a segment below which doubles do not tell whether it is one."""
KINDS = {"softening": 4, "symmetric": 1, "hardening": 2, "plastic": 2, "broken": 1}


def draw_scene(seed):
    """Kind and scene of a seed."""
    rng = random.Random(seed)
    kind = rng.choices(list(KINDS), list(KINDS.values()))[0]
    number = rng.randrange(10**6)
    return kind, symmetric_scene(number, "softening") if kind == "symmetric" else law_scene(number, kind)


def judge(made, seed=0, problem=None):
    """Follow a scene and compare it with its exact path or history; `problem` is the condensed scene, if that is known."""
    if "history" in made["analysis"]:
        return judge_history(made, problem)
    path = follow(problem or made)
    verdict = Verdict(path.status)
    if path.status != "solved" or not path.segments:
        verdict.outcome = f"no exact path: {path.status}" if path.status != "solved" else "nothing to follow"
    elif any(segment.null for segment in path.segments):
        verdict.outcome = "critical: falls exactly as steeply as the beam is stiff"
    elif all(segment.index == 0 for segment in path.segments):
        result = gapbeam.solve(made)
        if result.status != "solved":
            verdict.wrong.append(f"{result.status}, not solved: {result.reason}")
        else:
            verdict.wrong += state_faults(result.steps[-1], path.end, path.problem.which, "the end")
    falls = any(s < r for one in made["supports"] for (_, r), (_, s) in pairwise([(0.0, 0.0), *one.get("law", ())]))
    if falls and path.segments and verdict.outcome == "solved":
        verdict.wrong += path_faults(made, path)
    return verdict


def path_faults(made, path):
    """How the engine's segments differ from the exact ones."""
    found = Followed(gapbeam.scene.reading.read_beam(made)[1], np.array([1.0]), "follow", 2000).history()
    rows = [(leg, direction, index, ways, *ends) for ends, (leg, direction, index, ways, *_) in
            zip(found.along.tolist(), found.about.tolist(), strict=True)
            if direction == 0 or abs(ends[1] - ends[0]) > SHORTEST]  # fmt: skip
    ways = {special.segment: len(special.ways) for special in path.specials if len(special.ways) > 1}
    exact = [(s.leg, s.rate, s.index, ways.get(k, 1), float(s.start.factor), float(s.end.factor))
             for k, s in enumerate(path.segments) if s.rate == 0 or abs(s.end.factor - s.start.factor) > SHORTEST]  # fmt: skip
    if len(rows) == len(exact) + 1 and rows[-1][4:] == (0.0, 1.0):
        rows.pop()  # live loads that act on rigid supports only
    if found.ending:
        return [f"the path ends ({found.ending}), which it does not"]
    for k, (row, right) in enumerate(zip(rows, exact, strict=False)):
        if row[:4] != right[:4] or not np.allclose(row[4:], right[4:], rtol=FACTORS, atol=FACTORS):
            return [f"segment {k}: leg, direction, index, ways, from, to are {row}, not {right}"]
    return [] if len(rows) == len(exact) else [f"{len(rows)} segments, not {len(exact)}"]


def state_faults(step, state, which, where):
    """How deflections and reactions differ from exact ones, relative to the largest, or to 1e-3 and 1."""
    faults = []
    for name, exact, least in (("deflection", state.w, 1e-3), ("reaction", state.reaction, 1.0)):
        right = np.array([float(value) for value in exact])
        off, size = np.abs(getattr(step, name)[which] - right).max(initial=0.0), max(np.abs(right).max(initial=0.0), least)
        if not off <= STATES * size:
            faults.append(f"{where}: {name} off by {off:.3g} of {size:.3g}")
    return faults


def judge_history(made, problem=None):
    """A history of load factors, at the end of every leg."""
    exact = history(problem or made)
    verdict = Verdict(exact.status)
    if exact.status != "solved":
        verdict.outcome = f"no exact history: {exact.status}"
        return verdict
    result = gapbeam.solve(made)
    last = {segment.leg: k for k, segment in enumerate(result.segments)}
    steps, which = [result.steps[k] for _, k in sorted(last.items())], exact.problem.which
    if result.status != "solved" or len(steps) != len(exact.steps):
        verdict.wrong.append(f"{result.status} after {len(steps)} legs, not {len(exact.steps)}: {result.reason}")
        return verdict
    for leg, (step, state, sets) in enumerate(zip(steps, exact.steps, exact.sets, strict=True)):
        verdict.wrong += state_faults(step, state, which, f"leg {leg}")
        off = np.abs(step.set[which] - [float(value) for value in sets]).max(initial=0.0)
        if not off <= STATES:
            verdict.wrong.append(f"leg {leg}: sets off by {off:.3g}")
    return verdict


FAMILY = Family("laws", PROMISE, draw_scene, judge, share=0.4)
