"""Small scenes, many of them degenerate, against an enumeration of all contact states (`oracle.equilibrium`), in status and state.

Every scene is solved by both rules, from all closed or from a random start. A support that is tied (closed without
force, or touching within 1e-11 of the largest value of its kind) may be called open or closed.
"""

import random

import gapbeam
import numpy as np
import oracle
from scenes import one_sided
from scenes.degenerate import draw

from .family import Family, Verdict

PROMISE = (
    "Status, states and reactions are those of an enumeration of all contact states in rational numbers. The scenes are "
    "small, with exact ties, loads that cancel, rigid stretches and cycling contact states. Where forces are not unique, "
    "the scene is refused. Where positions are not, it may be"
)
SHARP = 1e-11
RULES = ("block", "single")


def judge(made, seed=0):
    """Solve a scene both ways and compare it with the enumeration."""
    steps = made["analysis"]["steps"]
    try:
        beam = oracle.Oracle(made)
        exact = [beam.solve(k / steps) for k in range(1, steps + 1)]
        outcome = next((s.status for s in exact if s.status != "solved"), "solved")
        if any(ambiguous(beam, solution) for solution in exact):
            outcome = "ambiguous"
    except oracle.Redundant:
        exact, outcome = [], "ambiguous"
    verdict = Verdict(outcome)
    rng = random.Random(-seed - 1)
    for rule in RULES:
        start = [rng.random() < 0.5 for _ in one_sided(made)] if rng.random() < 0.6 else None
        try:
            result = gapbeam.solve(made, rule=rule, start=start)
        except gapbeam.EngineError as error:
            wrong = "" if outcome in ("indifferent", "ambiguous") else f"refused: {error}"
        else:
            if outcome != "ambiguous":
                wrong = compare(made, beam, result, exact)
            else:
                wrong = "forces that are not unique" if result.status == "solved" else ""
        if wrong:
            verdict.wrong.append(f"{rule} from {start}: {wrong}")
    return verdict


def ambiguous(beam, solution):
    """Whether other forces would do as well: some state of stress needs no load and reverses no support."""
    if solution.status not in ("solved", "loose") or all(s[2] for s in beam.stretches):
        return False
    touching = [i for i in beam.one_sided if solution.state[i] == "closed" or solution.tied[i]]
    rows = [beam.contact_row(i) if i in touching else beam.open_row(i) for i in beam.one_sided]
    basis = oracle.null_space([entries for entries, _ in beam.fixed_rows + rows], beam.unknowns)
    columns = range(beam.force_column, beam.kink_column)
    idle = [i for i in touching if solution.reaction[i] == 0]
    sign = {"below": 1, "above": -1}
    pushes = [
        [sign[beam.supports[i]["side"]] * vector[beam.force_column + i] for vector in basis] for i in idle
    ]
    for ray in oracle.cone_rays(pushes, len(basis)) if basis else ():
        if any(oracle.dot(ray, [vector[column] for vector in basis]) for column in columns):
            return True
    return False


def compare(made, beam, result, exact):
    """How a result disagrees with the exact solutions of its steps; empty if it does not."""
    fallen = next((k for k, s in enumerate(exact) if s.status == "no-equilibrium"), None)
    if any(s.status == "indifferent" for s in exact[:fallen]):
        return "" if fallen is not None or result.status == "solved" else f"status {result.status}, not indifferent"
    expected = "solved" if fallen is None else "no-equilibrium"
    if result.status != expected:
        return f"status {result.status}, not {expected}: {result.reason}"
    if len(result.steps) != (len(exact) if fallen is None else fallen):
        return f"{len(result.steps)} steps stand, not {fallen}"
    pairs = zip(result.steps, exact, strict=False)
    return next(filter(None, (compare_step(made, beam, *pair) for pair in pairs)), "")


def compare_step(made, beam, step, solution):
    """How one load step disagrees."""
    reaction = np.array([float(v) for v in solution.reaction])
    opening = np.array([float(v) for v in solution.opening])
    way = np.abs([float(v) for v in solution.deflection])
    ways = max(opening.max(), way.max())
    bent = 1e-3 * ways * max((1.0 / s[2] for s in beam.stretches if s[2]), default=0) / beam.length**3
    forces = max(np.abs(reaction).max(), 0.1 * float(beam.load_size()), float(bent))
    loose = solution.status == "loose"  # places are not unique, forces are
    unlike = []
    for i, (state, right) in enumerate(zip(step.state, solution.state, strict=True)):
        sharp = abs(reaction[i]) > SHARP * forces or (opening[i] > SHARP * ways and not loose)
        if state != right and (sharp or i not in one_sided(made)):
            unlike.append(f"support {i} {state}, not {right}")
    off = np.abs(step.reaction - reaction).max()
    if off > 1e-9 * forces:
        unlike.append(f"reactions off by {off:g} of {forces:g}")
    return "; ".join(unlike)


FAMILY = Family("enumeration", PROMISE, draw, judge, share=0.5)
