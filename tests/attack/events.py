"""The path over the load factor: events against steps, and both against rational numbers."""

import random
from itertools import pairwise

import gapbeam
from gapbeam.base.errors import Status

from . import draw
from .compare import Look, compare_state, motion_faults
from .exact import Exact, Fraction, NoSolution, Redundant, falls_surely, stands
from .family import Family, Verdict
from .signs import redundant

PROMISE = (
    "Following the events ends for every scene. Every event is at its exact load factor. Between events states, values and "
    "status are those of steps, and of cold solves just left and right of every event. `result.at` agrees with the status"
)
NEAR = 1e-7  # how far left and right of an event, relative to its factor
SAME, NONE = Fraction(1, 10**10), Fraction(1, 10**14)  # factors that differ relatively or absolutely by less are the same
ROUNDING = Fraction(1, 10**12)  # of the largest force or way: a sign that is zero


def draw_scene(seed):
    """Kind and scene of a seed."""
    rng = random.Random(seed)
    return draw.until_valid(lambda: draw_any(rng))


def draw_any(rng):
    """Kind and scene, which may leave no room for the beam."""
    kind = rng.choice(list(KINDS))
    sizes = rng.choice((draw.ROUND, draw.ROUND, draw.ORDINARY, draw.SPREAD))
    options = {"hinges": 0.0, "gaps": 0.7, "spans": (1, 5), "most": 7} | KINDS[kind]
    loads = options.pop("loads", {})
    if kind == "short span":
        sizes = draw.Sizes(0.5, 12)
    made = draw.draw_beam(rng, sizes, **options)
    made["loads"] = draw.draw_loads(rng, sizes, made, **loads)
    if kind == "symmetric":
        made = draw.mirror_double(made)
    if kind == "over supports":
        for load in made["loads"]:
            if load["type"] == "force":
                load["x"] = draw.place(made, rng.choice(made["supports"]))
    return kind, made


#: Kinds of scene: how beams are drawn, and their loads
KINDS = {
    "held": {"bilateral": 0.5},
    "clearances": {"bilateral": 0.05, "pairs": 0.8, "most": 8},
    "seesaw": {"bilateral": 0.15, "pairs": 0.2, "gaps": 0.9, "springs": 0.1},
    "floating": {"bilateral": 0.0, "pairs": 0.3},
    "live only": {"bilateral": 0.1, "loads": {"dead": 0.0}},
    "hinged": {"bilateral": 0.3, "hinges": 0.4},
    "symmetric": {"bilateral": 0.2, "spans": (1, 2), "most": 4},
    "over supports": {"bilateral": 0.2},
    "short span": {"bilateral": 0.3},
}


def judge(made, seed=0):
    """Follow a scene by events and by steps and compare both with exact solutions."""
    rng, verdict, beam = random.Random(seed), Verdict(), Exact(made)
    made = {key: value for key, value in made.items() if key != "analysis"}
    factors = [rng.random() for _ in range(2)]
    try:
        path = gapbeam.solve({**made, "analysis": {"follow": "events"}})
    except gapbeam.EngineError as error:
        verdict.outcome = "no single path"
        if not no_single_path(beam, error):
            verdict.outcome = "refused"
            verdict.wrong.append(f"events refused: {error}")
    else:
        verdict.outcome = path.status
        check_path(beam, path, verdict)
        ends = sorted({segment.stop for segment in path.segments})
        factors += [end * (1 + way) for end in rng.sample(ends, min(len(ends), 5)) for way in (-NEAR, NEAR)]
        check_contradictions(beam, path, factors, verdict)
    check_steps(beam, made, rng.choice((1, 2, 3, 4, 7)), factors, verdict)
    verdict.wrong = list(dict.fromkeys(verdict.wrong))
    return verdict


def check_path(beam, path, verdict):
    """Every segment and every event of a path."""
    segments = path.segments
    end = Fraction(segments[-1].stop) if segments else Fraction(0)
    if path.status == "solved" and end != 1:
        verdict.wrong.append(f"events: solved, but the path ends at {float(end):.17g}")
    if path.status == "no-equilibrium":
        check_end(beam, path, end, verdict)
    schemes = []
    for segment in segments:
        middle = Fraction((segment.start + segment.stop) / 2)
        if segment.stop - segment.start <= SAME * middle:  # as long as the error that the factors of its ends may have
            schemes.append(None)
            continue
        where = f"events at {float(middle):.9g}: "
        try:
            step = path.state(float(middle))
        except (ValueError, gapbeam.EngineError) as error:
            verdict.wrong.append(f"{where}{error}")
            return
        if not compare_state(beam, step, Look(path, {"factor": step.factor}), verdict, where):
            return
        closed = [step.state[i] == "closed" for i in beam.one_sided]
        try:
            schemes.append((closed, beam.scheme(closed, middle)))
        except NoSolution:
            return
        check_segment(beam, segment, *schemes[-1], verdict)
    for (before, after), segment in zip(pairwise(schemes), segments, strict=False):
        if before is not None and after is not None:
            check_changes(beam, path, Fraction(segment.stop), before, after, verdict)


def check_end(beam, path, end, verdict):
    """That there is no equilibrium above the end of the path, and that nothing resists its motion."""
    above = end + max(end, 1) * Fraction(NEAR)
    if path.reason.startswith("no equilibrium at load factor 0:"):
        above = Fraction(0)
    falls, sharp = falls_surely(beam, above, Fraction(1, 10**14))
    if not falls:
        if sharp:
            verdict.wrong.append(f"events: no equilibrium above {float(end):.17g}, where the beam can stand")
    elif above <= 1:
        verdict.wrong += [f"events above {float(end):.9g}: {fault}" for fault in motion_faults(beam, path.motion, above)]


def check_segment(beam, segment, closed, found, verdict):
    """That a scheme is right from one end of a segment to the other."""
    if found.loose:
        return
    low, high, below, above = beam.interval(closed, found)
    for factor, root, supports, missed in (
        (Fraction(segment.start), low, below, low is not None and low > segment.start),
        (Fraction(segment.stop), high, above, high is not None and high < segment.stop),
    ):
        if missed and not is_zero(beam, closed, found, factor, root, supports):
            verdict.wrong.append(
                f"events: the scheme from {segment.start:.17g} to {segment.stop:.17g} is right from {shown(low)} to "
                f"{shown(high)} only, supports {supports}"
            )


def check_changes(beam, path, factor, before, after, verdict):
    """That the events at one factor lead from one scheme to the next, and that something does happen there."""
    idle = set()
    for closed, found in (before, after):
        if not found.loose:
            idle |= {i for i in beam.one_sided if beam.course(closed, i, found) == (0, 0)}
    changed = {i for i, a, b in zip(beam.one_sided, before[0], after[0], strict=True) if a != b}
    here = [event for event in path.events if event.factor == factor]
    unnamed = changed - idle - {event.support for event in here}
    if unnamed:
        verdict.wrong.append(f"events at {float(factor):.17g}: supports {sorted(unnamed)} change and are not named")
    last = {event.support: event.event for event in here if event.event in ("opens", "closes")}
    for i, event in last.items():
        if i not in idle and i in beam.one_sided and (event == "closes") != after[0][beam.one_sided.index(i)]:
            verdict.wrong.append(f"events at {float(factor):.17g}: support {i} {event}, but not in the scheme after it")
    if before[1].loose or after[1].loose or not changed - idle:
        return
    _, high, _, ends = beam.interval(*before)
    low, _, begins, _ = beam.interval(*after)
    ended = high is not None and is_zero(beam, *before, factor, high, ends)
    begun = low is not None and is_zero(beam, *after, factor, low, begins)
    if not ended and not begun:
        verdict.wrong.append(
            f"events: a change at {float(factor):.17g}, but the schemes there end at {shown(high)} and begin at {shown(low)}"
        )


def shown(factor):
    return "any factor" if factor is None else f"{float(factor):.17g}"


def is_zero(beam, closed, found, factor, root, supports):
    """Whether a factor is that of an event, or what ends there is zero as far as the digits go."""
    if abs(factor - root) <= max(SAME * max(abs(root), abs(factor)), NONE):
        return True
    courses = {i: beam.course(closed, i, found) for i in beam.one_sided}
    kind = dict(zip(beam.one_sided, closed, strict=True))
    ways = max(abs(beam.acting_level(i)) for i in beam.one_sided)  # what distances are differences of
    for i in supports:
        size = max(abs(a) + abs(b) * factor for j, (a, b) in courses.items() if kind[j] == kind[i])
        if abs(courses[i][0] + courses[i][1] * factor) > ROUNDING * (size if kind[i] else max(size, ways)):
            return False
    return True


def check_contradictions(beam, path, factors, verdict):
    """That `result.at` and the status say the same."""
    for factor in [*factors, 1.0]:
        falls, sharp = falls_surely(beam, Fraction(factor))
        if factor > 1.0 or not sharp:
            continue
        try:
            path.at(0.0, factor=factor)
        except ValueError as error:
            if not falls:
                verdict.wrong.append(f"events: at({factor:.17g}): {error}")
        except gapbeam.EngineError as error:
            verdict.wrong.append(f"events: at({factor:.17g}) refused: {error}")
        else:
            if falls:
                verdict.wrong.append(f"events: at({factor:.17g}) has values where there is no equilibrium")


def check_steps(beam, made, count, factors, verdict):
    """States by steps and cold ones."""
    try:
        result = gapbeam.solve({**made, "analysis": {"steps": count}})
    except gapbeam.EngineError as error:
        if not no_single_path(beam, error):
            verdict.wrong.append(f"{count} steps refused: {error}")
        return
    for k, step in enumerate(result.steps):
        if not compare_state(beam, step, Look(result, {"step": k}), verdict, f"step {step.factor:.9g}: "):
            return
    if len(result.steps) < count:
        factor = Fraction((len(result.steps) + 1) / count)
        falls, sharp = falls_surely(beam, factor)
        if sharp and not falls:
            verdict.wrong.append(f"steps: no equilibrium at {float(factor):.9g}, where the beam can stand")
        elif sharp:
            verdict.wrong += [f"step {float(factor):.9g}: {fault}" for fault in motion_faults(beam, result.motion, factor)]
    for factor in factors:
        falls, sharp = falls_surely(beam, Fraction(factor))
        try:
            step = result.state(factor)
        except ValueError as error:
            if sharp and not falls:
                verdict.wrong.append(f"cold: {error}")
        except gapbeam.EngineError as error:
            if not no_single_path(beam, error):
                verdict.wrong.append(f"cold at {factor:.17g} refused: {error}")
        else:
            if falls and sharp:
                verdict.wrong.append(f"cold at {factor:.17g}: solved where there is no equilibrium")
            else:
                compare_state(beam, step, Look(result, {"factor": factor}), verdict, f"cold at {factor:.17g}: ")


def no_single_path(beam, error):
    """Whether no single answer exists over some of the load: forces or places are not unique."""
    for factor in (*(Fraction(k, 13) for k in range(1, 14)), *(Fraction(1, 4**k) for k in range(2, 16))):
        if stands(beam, factor) == "indifferent":
            return True
        try:
            _, values = beam.settle([True] * len(beam.one_sided), factor)
        except Redundant:
            return error.status == Status.INDETERMINATE
        except NoSolution:
            continue
        if beam.moves_in_clearance(values):
            return True
    return error.status == Status.INDETERMINATE and redundant(beam)


FAMILY = Family("events", PROMISE, draw_scene, judge, share=0.12)
