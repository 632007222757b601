"""Beams with many hinges: whether they stand, against the forces that each hinge can take."""

import random
from fractions import Fraction

import gapbeam
from gapbeam.base.errors import Status
from oracle.forms import Reading

from . import draw
from .compare import motion_faults
from .exact import falls_surely, stands
from .family import Family, Verdict

PROMISE = (
    "Beams with many hinges are correctly reported as stable or not. If not, the loads do work along the motion given, and "
    "no support blocks it. If stable, the reactions have the right signs and balance the loads on every body"
)

BALANCE = Fraction(1, 10**10)  # of the forces at a hinge


def draw_scene(seed):
    """Kind and scene of a seed."""
    rng = random.Random(seed)
    return draw.until_valid(lambda: draw_any(rng))


def draw_any(rng):
    """Kind and scene, which may leave no room for the beam."""
    kind = rng.choices(("few", "many", "held", "spread", "long"), (4, 2, 3, 2, 1))[0]
    if kind == "long":
        return kind, draw_long(rng)
    sizes = {"spread": draw.SPREAD}.get(kind, rng.choice((draw.ROUND, draw.ORDINARY)))
    spans = {"few": (2, 6), "many": (10, 40)}.get(kind, (3, 12))
    while True:
        made = draw.draw_beam(
            rng, sizes, spans=spans, bilateral=0.6 if kind == "held" else rng.choice((0.0, 0.2, 0.4)), most=1000,
            pairs=0.3, hinges=rng.choice((0.3, 0.6, 0.8)), springs=rng.choice((0.0, 0.3)),
        )  # fmt: skip
        if made["beam"].get("hinges"):
            break
    made["loads"] = draw.draw_loads(rng, sizes, made, most=rng.choice((3, 10)), down=rng.random() < 0.6)
    return kind, made


def draw_long(rng):
    """A heavy beam with many supports from which forces here and there lift it, most often nearly as far as it can stand."""
    count = rng.choice((60, 150, 400))
    made = draw.draw_beam(
        rng, draw.ORDINARY, spans=(count // 2, count), most=10**6, bilateral=rng.choice((0.0, 0.0, 0.02)),
        pairs=rng.choice((0.0, 0.1)), hinges=rng.choice((0.02, 0.1, 0.3, 0.8)), springs=rng.choice((0.0, 0.3, 1.0)),
        above=rng.choice((0.0, 0.0, 0.15)),
    )  # fmt: skip
    rest_on_two(made)
    length, most = draw.nodes_of(made)[-1], rng.choice((1.0, 5.0, 20.0))
    lifted = [draw.force(length * rng.randrange(4096) / 4096.0, round(-most * rng.random(), 2)) for _ in range(count // 2)]
    made["loads"] = [draw.uniform(2.0, case="dead"), *lifted]
    if rng.random() < 0.7:
        share = nearly(Reading(made)) * rng.choice((1 - 1e-2, 1 - 1e-6, 1 + 1e-6, 1 + 1e-2))
        for load in lifted:
            load["F"] *= share
    return made


def rest_on_two(made):
    """Leave out hinges so that every body rests on two supports at least."""
    places, kept = sorted({draw.place(made, support) for support in made["supports"]}), []
    for hinge in made["beam"].pop("hinges", []):
        inside = [x for x in places if (kept[-1] if kept else -1.0) < x <= hinge]
        if len(inside) > 1 and sum(x > hinge for x in places) > 1:
            kept.append(hinge)
    made["beam"]["hinges"] = kept


def nearly(beam):
    """The load factor up to which a beam can stand, to some digits; 1 where it cannot at 0."""
    low, high = Fraction(0), Fraction(16)
    if stands(beam, low) == "falls":
        return 1.0
    for _ in range(24):
        middle = (low + high) / 2
        low, high = (low, middle) if stands(beam, middle) == "falls" else (middle, high)
    return float(low)


def judge(made, seed=0):
    """Compare status and motion, and check the equilibrium of the reactions."""
    rng, count = random.Random(seed), len(draw.one_sided(made))
    beam = Reading(made)
    falls, sharp = falls_surely(beam, Fraction(1))
    verdict = Verdict("no-equilibrium" if falls else "solved")
    for start in (None, [rng.random() < 0.5 for _ in range(count)]):
        where = "" if start is None else "from another start: "
        try:
            result = gapbeam.solve(made, start=start)
        except gapbeam.EngineError as error:
            if error.status != Status.INDETERMINATE:
                verdict.wrong.append(f"{where}refused: {error}")
            continue
        if sharp and (result.status == "no-equilibrium") != falls:
            verdict.wrong.append(f"{where}{result.status}, not {verdict.outcome}")
        elif result.status == "no-equilibrium":
            verdict.wrong += [where + fault for fault in motion_faults(beam, result.motion, Fraction(1)) if sharp]
        else:
            verdict.wrong += [where + fault for fault in balance_faults(beam, result.steps[-1])]
    return verdict


def balance_faults(beam, step):
    """What is wrong with the reactions of a state: signs, and the balance of the bodies between hinges."""
    faults = []
    for i in beam.one_sided:
        push = step.reaction[i] * (1.0 if beam.supports[i]["side"] == "below" else -1.0)
        if not push >= -step.bounds[1] and i not in step.undecided:
            faults.append(f"support {i} pulls by {-push:.3g}")
    bodies = beam.bodies
    work = [[Fraction(0), Fraction(0)] for _ in range(len(bodies) + 1)]  # while one cut moves; and the size of its terms
    terms = [(k + end, amount) for k, body in enumerate(bodies) for end, amount in enumerate(body.work(Fraction(step.factor)))]
    for i, support in enumerate(beam.supports):
        k = next(k for k, body in enumerate(bodies) if support["x"] <= body.b)
        length = bodies[k].b - bodies[k].a
        share, turn = (support["x"] - bodies[k].a) / length, Fraction(step.couple[i]) / length
        force = Fraction(step.reaction[i])
        terms += [(k, -force * (1 - share)), (k + 1, -force * share), (k, -turn), (k + 1, turn)]
    for k, amount in terms:
        work[k][0] += amount
        work[k][1] += abs(amount)
    size = BALANCE * beam.load_size() + len(beam.supports) * Fraction(step.bounds[1])
    for k, (total, largest) in enumerate(work):
        if abs(total) > BALANCE * largest + size:
            x = float(bodies[k].a if k < len(bodies) else bodies[-1].b)
            faults.append(f"no balance at x = {x:g}: {float(total):.3g} of {float(largest):.3g}")
    return faults


FAMILY = Family("hinges", PROMISE, draw_scene, judge, share=0.5)
