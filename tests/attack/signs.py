"""The program's own states in rational numbers, over many decades of magnitudes."""

import itertools
import random
from bisect import bisect
from functools import partial

import gapbeam
from gapbeam.base.errors import Status

from . import draw
from .compare import Look, compare_state, motion_faults
from .enumeration import ambiguous
from .exact import Exact, Fraction, NoSolution, Redundant, falls_surely
from .family import Family, Verdict
from .proofs import proof_faults

PROMISE = (
    "Every state satisfies the contact conditions in rational numbers, over nine decades to either side of ordinary "
    "magnitudes. Otherwise it names the supports that do not as undecided. No bound is below the true error. Status and "
    "state depend neither on the start nor on the rule. Refused are scenes in which loads are lost in a rounding of "
    "quadruple precision"
)
SIZES = {"ordinary": draw.ORDINARY, "round": draw.ROUND, "spread": draw.SPREAD, "wide": draw.WIDE, "outlier": draw.ORDINARY}
QUADRUPLE, LEFT_OUT = Fraction(1, 2**113), Fraction(1, 2**27)  # a rounding; the share of loads that may be left out as one
OUTLIERS = ("EI", "GA", "stiffness", "rotation", "gap", "settlement", "F", "M", "q")


def draw_scene(seed):
    """Kind and scene of a seed."""
    rng = random.Random(seed)
    return draw.until_valid(lambda: draw_any(rng))


def draw_any(rng):
    """Kind and scene, which may leave no room for the beam."""
    kind = rng.choices(list(SIZES), (3, 2, 2, 4, 3))[0]
    sizes = SIZES[kind]
    made = draw.draw_beam(rng, sizes, bilateral=rng.choice((0.0, 0.4, 0.4, 0.6)), hinges=rng.choice((0.0, 0.0, 0.3)))
    made["loads"] = draw.draw_loads(rng, sizes, made)
    if kind == "outlier":
        items = [(item, key) for item in (made["beam"], *made["supports"], *made["loads"]) for key in OUTLIERS
                 if isinstance(item.get(key), float) and item[key] != draw.INF]  # fmt: skip
        for item, key in rng.sample(items, min(len(items), rng.randint(1, 2))):
            item[key] = float(f"{item[key] * 10.0 ** rng.choice((-15, -12, -9, -6, 6, 9, 12, 15)):.3g}")
    return kind, made


def judge(made, seed=0):
    """Solve a scene from several starts by both rules and compare each answer with the exact one."""
    rng, count = random.Random(seed), len(draw.one_sided(made))
    beam = Exact(made)
    falls, sharp = falls_surely(beam, Fraction(1))
    verdict = Verdict("no-equilibrium" if falls else "solved")
    tries = [("block", None), ("single", None)]
    if count:
        tries += [("block", [False] * count), (rng.choice(("block", "single")), [rng.random() < 0.5 for _ in range(count)])]
    states, free = set(), set()
    for rule, start in tries:
        where = f"{rule} from {'the default' if start is None else ''.join('co'[not c] for c in start)}: "
        try:
            result = gapbeam.solve(made, rule=rule, start=start)
        except gapbeam.EngineError as error:
            if error.status == Status.INDETERMINATE and redundant(beam):
                verdict.outcome = "forces not unique"
            elif error.status == Status.NOT_CONVERGED and loads_are_lost(beam, made):
                verdict.outcome = "loads lost"
            else:
                verdict.wrong.append(f"{where}refused: {error}")
            continue
        if sharp and (result.status == "no-equilibrium") != falls:
            verdict.wrong.append(f"{where}{result.status}, not {verdict.outcome}")
        elif result.status == "no-equilibrium":
            verdict.wrong += [where + fault for fault in motion_faults(beam, result.motion, Fraction(1)) if sharp]
        else:
            step = result.steps[-1]
            compare_state(beam, step, Look(result, {}), verdict, where)
            states.add(decided(step))
            free.add(step.indifferent or bool(step.undecided))  # an undecided support may be what holds it
    if len(free) > 1:
        verdict.wrong.append("whether the beam can move freely depends on start or rule")
    if len(states) > 1 and verdict.outcome == "solved" and not alike(states):
        verdict.wrong.append(f"the state depends on start or rule: {sorted(states)}")
    verdict.wrong += proof_faults(made, seed)
    return verdict


def decided(step):
    """The state, "?" where it is not decided: named so, or without force where the beam can move freely."""
    idle = [step.indifferent and abs(force) <= step.bounds[1] for force in step.reaction]
    return tuple("?" if i in step.undecided or idle[i] else name for i, name in enumerate(step.state))


def alike(states):
    """Whether states differ in undecided supports only."""
    return all(len({name for name in column if name != "?"}) < 2 for column in zip(*states, strict=True))


def redundant(beam):
    """Whether other forces would do as well: in the best scheme, or in every right one."""
    try:
        solution = beam.solve()
    except Redundant:
        return True
    return ambiguous(beam, solution) if solution.values else not any(map(partial(right, beam), schemes(beam)))


def loads_are_lost(beam, made):
    """Whether a rounding of deflections in quadruple precision is, at the stiffest stretch, too great a force beside the loads."""
    ends = list(itertools.accumulate(made["beam"]["spans"], initial=0.0))
    EI = made["beam"]["EI"] if isinstance(made["beam"]["EI"], list) else [made["beam"]["EI"]] * (len(ends) - 1)
    at = [(min(bisect(ends, float((a + b) / 2)), len(EI)) - 1, b - a) for a, b in itertools.pairwise(beam.points)]
    stiffest = max((Fraction(EI[k]) / length**3 for k, length in at if EI[k] != draw.INF), default=Fraction(0))
    try:
        solution = beam.solve()
    except Redundant:
        return False
    moves = max((abs(Fraction(float(w))) for w in solution.deflection), default=Fraction(0))
    values = [load[key] for load in made["loads"] for key in ("F", "q") if key in load]
    load = max((abs(Fraction(part)) for value in values for part in (value if isinstance(value, list) else [value])), default=0)
    return stiffest * moves * QUADRUPLE > LEFT_OUT * load


def schemes(beam):
    """All schemes of a beam."""
    return itertools.product((True, False), repeat=len(beam.one_sided))


def right(beam, closed):
    """Whether a scheme is right, and its forces are unique."""
    try:
        return not beam.wrong(closed, beam.scheme(closed, Fraction(1)).at(Fraction(1)))
    except (NoSolution, Redundant):
        return False


FAMILY = Family("signs", PROMISE, draw_scene, judge, share=0.4)
