"""Combinations of load cases, each beside a scene of its own that is solved in rational numbers."""

import random

import gapbeam
import numpy as np
import oracle
from gapbeam.base.errors import Status
from python.results.cases.test_combinations import by_hand, combined
from python.results.cases.test_scheme_of import held_in_scheme
from scenes import random_scene

from .family import Family, Verdict

PROMISE = (
    "Every combination has the exact status, reactions and fields of the scene with its loads multiplied and its supports "
    "moved. Load patterns and contact states of other combinations are included. The envelope has the extremes of all"
)
NEAR = 1e-9


def draw_scene(seed):
    """Kind and scene of a seed."""
    rng = random.Random(seed)
    while True:
        made = combined(rng, random_scene(rng, held=rng.choice((True, None))))
        made["analysis"] = {}
        kind = rng.choice(("plain", "plain", "signs", "scheme"))
        first, second, _ = made["combinations"]
        if kind == "signs":
            first["expand"] = {case: "signs" for case, factor in first["factors"].items() if factor}
        if kind == "scheme":
            second["scheme_of"] = first["name"]
        try:
            gapbeam.read_scene(made)
        except gapbeam.SceneError:
            continue
        return kind, made


def scenes_of(made):
    """The scenes of all combinations by name, written by hand, and the combination whose scheme each takes."""
    found = {}
    for one in made["combinations"]:
        signed = list(one.get("expand", ()))
        for k in range(2 ** len(signed)):
            signs = {case: -1.0 if k >> i & 1 else 1.0 for i, case in enumerate(reversed(signed))}
            words = "; ".join(f"{case} {'+' if signs[case] > 0 else '-'}" for case in signed)
            factors = {case: factor * signs.get(case, 1.0) for case, factor in one["factors"].items()}
            name = f"{one['name']} [{words}]" if signed else one["name"]
            found[name] = by_hand(made, {**one, "factors": factors}), one.get("scheme_of")
    return found


def judge(made, seed=0):
    """Solve all combinations at once and every one exactly."""
    verdict = Verdict()
    try:
        result = gapbeam.solve(made)
    except gapbeam.SceneError as error:
        verdict.outcome = "refused"
        for written, _ in scenes_of(made).values():
            try:
                gapbeam.read_scene(written)
            except gapbeam.SceneError:
                return verdict
        verdict.wrong.append(f"refused: {error}")
        return verdict
    verdict.outcome, expected = result.status, scenes_of(made)
    if list(result.names) != list(expected):
        verdict.wrong.append(f"the combinations are {result.names}, not {list(expected)}")
        return verdict
    for name, (written, leader) in expected.items():
        verdict.wrong += [f"{name}: {fault}" for fault in compare(result, name, written, leader)]
    return verdict


def compare(result, name, written, leader):
    """What is wrong with a combination."""
    found = result.combinations[name]
    if leader is not None:
        first = result.combinations[leader]
        if first.status != "solved" or first.steps[-1].undecided:
            return []
        written, there = held_in_scheme(written, first.steps[-1].state)
    try:
        exact = oracle.solve(written)
        status = "indifferent" if exact.status == "loose" else exact.status
    except oracle.Redundant:
        status = Status.INDETERMINATE.word
    if status == "indifferent" or status == Status.INDETERMINATE.word:
        return []
    if found.status != status:
        return [f"{found.status}, not {status}: {found.reason}"]
    if status != "solved":
        return []
    step = found.steps[-1]
    if leader is not None and step.indifferent:
        return []
    reaction = np.zeros(len(step.reaction))
    reaction[there if leader is not None else slice(None)] = [float(force) for force in exact.reaction]
    faults, size = [], max(np.abs(reaction).max(initial=0.0), 1e-6 * float(exact.oracle.load_size()), 1e-300)
    off = np.abs(step.reaction - reaction).max(initial=0.0)
    if not off <= NEAR * size + 2 * step.bounds[1]:
        faults.append(f"reactions off by {off:.3g} of {size:.3g}")
    places = [x * float(exact.oracle.length) for x in (0.1337, 0.3141, 0.4823, 0.6517, 0.8779)]  # where no couple acts
    for kind in ("deflection", "moment") if not step.indifferent else ("moment",):
        right = np.array([float(getattr(exact.at(x), kind)) for x in places])
        off = np.abs(getattr(found.at(places), kind) - right).max()
        if not off <= NEAR * np.abs(right).max() + 2 * step.error_bounds[kind]:
            faults.append(f"{kind} off by {off:.3g} of {np.abs(right).max():.3g}")
        row = result.envelope().extremes[kind]
        slack = NEAR * max(abs(end.value) for end in row.values())
        if not (row["min"].value - slack <= right.min() and right.max() <= row["max"].value + slack):
            faults.append(f"{kind} beyond the envelope")
    return faults


FAMILY = Family("combinations", PROMISE, draw_scene, judge, share=0.2)
