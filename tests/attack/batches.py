"""Many cases of a beam at once, side by side in wide registers or in segments, beside scenes solved one by one."""

import random

import gapbeam
import numpy as np
import oracle
from python.results.cases.test_prepared import scaled
from scenes import random_scene

from .family import Family, Verdict

PROMISE = (
    "Every case has the status, contact state and reactions of a scene of its own, also with factors of loads and gaps by "
    "case. The reactions are exact. No case depends on the others"
)
NEAR = 1e-10
ROWS = (1, 3, 9, 17, 33)
LOOKED_AT = 3


def draw_scene(seed):
    """Kind and scene of a seed; the factors and gaps of its cases are in it."""
    rng = random.Random(seed)
    made = random_scene(rng, held=rng.choice((True, None)))
    rows = rng.choice(ROWS)
    kind = rng.choice(("loads", "loads and gaps"))
    made["analysis"] = {}
    made["cases"] = {"factors": [[rng.choice((0.0, 1.0, -1.0, 0.5, 3.0)) for _ in made["loads"]] for _ in range(rows)], "gaps": {}}
    if kind == "loads and gaps":
        sided = [k for k, support in enumerate(made["supports"]) if support.get("gap", 0.0) > 0.0]
        for k in sided:
            made["cases"]["gaps"][str(k)] = [made["supports"][k]["gap"] * rng.choice((0.5, 1.0, 4.0)) for _ in range(rows)]
    return kind, made


def judge(made, seed=0):
    """Solve all cases at once and some of them alone."""
    made = dict(made)
    cases = made.pop("cases")
    gaps = {int(k): values for k, values in cases["gaps"].items()}
    beam, verdict = gapbeam.prepare(made), Verdict("solved")
    found = beam.solve(cases["factors"], **({"gap": gaps} if gaps else {}))
    for k in random.Random(seed).sample(range(len(cases["factors"])), min(LOOKED_AT, len(cases["factors"]))):
        one = scaled(made, cases["factors"][k])
        one["supports"] = [dict(support, **({"gap": gaps[i][k]} if i in gaps else {})) for i, support in enumerate(one["supports"])]
        verdict.wrong += [f"case {k}: {fault}" for fault in compare(one, found, k)]
        alone = beam.solve([cases["factors"][k]], **({"gap": {i: [row[k]] for i, row in gaps.items()}} if gaps else {}))
        if alone.status[0] != found.status[k] or not np.array_equal(alone.reaction[0], found.reaction[k], equal_nan=True):
            verdict.wrong.append(f"case {k} depends on its company")
    return verdict


def compare(one, found, k):
    """What is wrong with a case beside its scene."""
    try:
        direct = gapbeam.solve(one)
    except gapbeam.EngineError as error:
        return [] if found.status[k] == error.status else [f"status {found.status[k]}, not {int(error.status)}"]
    if (direct.status == "solved") != (found.status[k] == 0):
        return [f"status {found.status[k]}, alone {direct.status}"]
    if direct.status != "solved":
        return []
    faults, step = [], direct.steps[-1]
    if not step.indifferent and not step.undecided and step.solution.closed.tolist() != found.closed[k].tolist():
        faults.append("another contact state than alone")
    size = max(np.abs(step.reaction).max(initial=0.0), 1e-9)
    alone = np.abs(found.reaction[k] - step.solution.reaction).max(initial=0.0)
    if not alone <= NEAR * size + 2 * step.bounds[1]:
        faults.append(f"reactions differ by {alone:.3g} of {size:.3g} from those alone")
    try:
        exact = oracle.solve(one)
    except oracle.Redundant:
        return faults
    if exact.status in ("solved", "loose"):
        right = np.array([float(force) for force in exact.reaction])
        off = np.abs(found.reaction[k] - right[list(direct._beam.numbers)]).max(initial=0.0)
        if not off <= NEAR * max(size, np.abs(right).max(initial=0.0)) + 2 * step.bounds[1]:
            faults.append(f"reactions are off by {off:.3g} of {size:.3g}")
    elif exact.status == "no-equilibrium":
        faults.append("solved, but nothing balances it")
    return faults


FAMILY = Family("batches", PROMISE, draw_scene, judge, share=0.4)
