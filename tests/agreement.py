"""Agreement of the program with exact enumeration (`oracle.py`) on many small scenes, in status and state.

Run as a command it prints how many scenes of which kind were compared and every disagreement with its seed:

    python tests/agreement.py --count 100000 --jobs 2

Every scene is solved by both rules, from all closed or from a random start. A support that is tied (closed without
force, or touching within 1e-11 of the largest value of its kind) may be called open or closed.
"""

import argparse
import collections
import multiprocessing
import random
import sys
import time
from dataclasses import dataclass

import gapbeam
import numpy as np
import oracle
from degenerate import KINDS, draw
from scenes import one_sided

SHARP = 1e-11
RULES = ("block", "single")


@dataclass
class Verdict:
    """What became of one scene.

    Attributes
    ----------
    seed : int
    kind : str
    outcome : str
        What the enumeration says: solved, no-equilibrium, loose, indifferent; ambiguous if forces are not unique.
    tied : bool
        Whether some support is tied exactly.
    refused : bool
        Whether the program refused an indifferent or ambiguous scene.
    wrong : str
        How the program disagrees; empty if it does not.
    """

    seed: int
    kind: str
    outcome: str
    tied: bool = False
    refused: bool = False
    wrong: str = ""


def examine(seed, kind=None):
    """Draw a scene and solve it both ways.

    Parameters
    ----------
    seed : int
    kind : str, optional
        One of `degenerate.KINDS`; default: drawn too.

    Returns
    -------
    Verdict
    """
    kind, made = draw(seed, kind)
    steps = made["analysis"]["steps"]
    try:
        beam = oracle.Oracle(made)
        exact = [beam.solve(k / steps) for k in range(1, steps + 1)]
        outcome = next((s.status for s in exact if s.status != "solved"), "solved")
        if any(ambiguous(beam, solution) for solution in exact):
            outcome = "ambiguous"
    except oracle.Redundant:
        exact, outcome = [], "ambiguous"
    verdict = Verdict(seed, kind, outcome, any(any(solution.tied) for solution in exact))
    rng = random.Random(-seed - 1)
    for rule in RULES:
        start = [rng.random() < 0.5 for _ in one_sided(made)] if rng.random() < 0.6 else None
        try:
            result = gapbeam.solve(made, rule=rule, start=start)
        except gapbeam.EngineError as error:
            verdict.refused = outcome in ("indifferent", "ambiguous")
            wrong = "" if verdict.refused else f"refused: {error}"
        else:
            wrong = compare(made, beam, result, exact) if outcome != "ambiguous" else ""
        if wrong:
            verdict.wrong += f"{' | ' if verdict.wrong else ''}{rule} from {start}: {wrong}"
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


def examine_all(seeds, jobs):
    """Verdicts of many seeds, as they come."""
    if jobs < 2:
        yield from map(examine, seeds)
        return
    with multiprocessing.get_context("fork").Pool(jobs) as pool:
        yield from pool.imap_unordered(examine, seeds, chunksize=100)


def main(arguments=None):
    """The command; its exit status is 1 if there is a disagreement."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=2000, help="how many scenes (default 2000)")
    parser.add_argument("--seed", type=int, default=0, help="first seed (default 0)")
    parser.add_argument("--jobs", type=int, default=1, help="processes (default 1)")
    parser.add_argument("--show", type=int, metavar="SEED", help="print one scene and what became of it, nothing else")
    chosen = parser.parse_args(arguments)
    if chosen.show is not None:
        print(*draw(chosen.show), examine(chosen.show), sep="\n")
        return 0
    begin, kinds, outcomes, wrong = time.perf_counter(), collections.Counter(), collections.Counter(), []
    ties = refused = 0
    for verdict in examine_all(range(chosen.seed, chosen.seed + chosen.count), chosen.jobs):
        kinds[verdict.kind] += 1
        outcomes[verdict.outcome] += 1
        ties += verdict.tied
        refused += verdict.refused
        if verdict.wrong:
            wrong.append(verdict)
            print(f"seed {verdict.seed} ({verdict.kind}, {verdict.outcome}): {verdict.wrong}", flush=True)
    for name, counts in (("Kinds", {kind: kinds[kind] for kind in KINDS}), ("Outcomes", outcomes)):
        print(f"{name}: " + ", ".join(f"{key} {number:,}" for key, number in counts.items()))
    print(f"With exact ties: {ties:,}. Indifferent or ambiguous scenes that the program refused: {refused:,}.")
    print(f"{chosen.count:,} scenes by {' and '.join(RULES)} in {time.perf_counter() - begin:.0f} s")
    print(f"Disagreements: {len(wrong):,}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
