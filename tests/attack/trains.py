"""Trains at many positions: each is a scene of its own, solved in rational numbers."""

import random

import gapbeam
import oracle
from gapbeam.base.errors import Status
from scenes.train import frozen, random_scene

from .family import Family, Verdict

PROMISE = (
    "At positions all along a vehicle's way status, reactions and fields are exact. None is beyond the envelope, and the "
    "extremes reported are reached where they are said to be"
)
NEAR = 1e-9
BESIDE = 1e-7
POSITIONS = 5
ENOUGH = ("moment", "shear", "deflection")


def draw_scene(seed):
    """Kind and scene of a seed."""
    made = random_scene(seed)
    return "round" if len(set(made["beam"]["spans"])) == 1 else "any", made


def judge(made, seed=0):
    """Compare states on the way and the envelope with exact states."""
    rng = random.Random(seed)
    try:
        result = gapbeam.solve(made)
        envelope = result.envelope()
    except gapbeam.EngineError as error:
        return Verdict("forces not unique" if error.status == Status.INDETERMINATE else "refused",
                       [] if error.status == Status.INDETERMINATE else [str(error)])  # fmt: skip
    train, verdict = result.trains["train"], Verdict(result.status)
    for way in train.traversals:
        low, high = way.course.from_, way.course.to
        dense = [low + (high - low) * (k + rng.random()) / POSITIONS for k in range(POSITIONS)]
        for position in dense:
            compare(made, train, envelope, position, way.course.direction, verdict)
    rows = [(name, end, row) for name in ENOUGH for end, row in envelope.extremes[name].items() if row is not None]
    for name, end, row in rng.sample(rows, min(len(rows), 3)):
        size = max(abs(end.value) for end in envelope.extremes[name].values() if end is not None)
        reached(made, name, end, row, size, verdict)
    return verdict


def exact_at(made, position, direction):
    """The exact state with the train at a position, or its status."""
    try:
        found = oracle.solve(frozen(made, position, direction == "left"))
    except oracle.Redundant:
        return "forces not unique", None
    return found.status, found


def within(value, row, scale):
    """Whether a value is within an envelope."""
    return all(end is None or sign * (value - end.value) <= NEAR * scale for sign, end in ((1, row["max"]), (-1, row["min"])))


def compare(made, train, envelope, position, direction, verdict):
    """One position."""
    status, exact = exact_at(made, position, direction)
    where = f"train at {position!r} to the {direction}: "
    try:
        state = train.state(position, direction)
    except (ValueError, gapbeam.EngineError) as error:
        if status == "solved":
            verdict.wrong.append(f"{where}{error}")
        return
    if status == "no-equilibrium":
        verdict.wrong.append(f"{where}solved, but nothing balances it")
    if status != "solved" or state.indifferent:
        return
    force = max(1e-6 * float(exact.oracle.load_size()), *(abs(float(r)) for r in exact.reaction), 1e-300)
    for k, right in enumerate(map(float, exact.reaction)):
        if not abs(state.reaction[k] - right) <= NEAR * force:
            verdict.wrong.append(f"{where}reaction {k} is {state.reaction[k]:.12g}, exactly {right:.12g}")
        if not within(right, envelope.supports[k]["reaction"], force):
            verdict.wrong.append(f"{where}reaction {k} of {right:.12g} is beyond the envelope")
    length = float(exact.oracle.length)
    axles = [load["x"] for load in frozen(made, position, direction == "left")["loads"] if load["type"] == "force"]
    for x in {length * (k + 0.5) / 4 for k in range(4)} | set(axles[:3]):
        side = "left" if x >= length else "right"
        right, fields = exact.at(x, side), state.fields(x, side=side)
        for name in ENOUGH:
            scale = max(abs(end.value) for end in envelope.extremes[name].values() if end is not None)
            exactly = float(getattr(right, name))
            if not abs(getattr(fields, name) - exactly) <= NEAR * scale:
                verdict.wrong.append(f"{where}{name} at {x} is {getattr(fields, name):.12g}, exactly {exactly:.12g}")
            if not within(exactly, envelope.extremes[name], scale):
                verdict.wrong.append(f"{where}{name} of {exactly:.12g} at {x} is beyond the envelope")


def reached(made, name, end, row, size, verdict):
    """An extreme value where it is said to be; where something jumps it may be reached only just beside that place or position."""
    values = []
    for position in (row.position, row.position - BESIDE, row.position + BESIDE):
        status, exact = exact_at(made, position, row.direction)
        if status == "indifferent" and position == row.position:
            return  # in balance, whatever the states beside it are: the weights of two overhangs
        if status != "solved":
            continue
        length = float(exact.oracle.length)
        for x in {row.x, max(row.x - BESIDE, 0.0), min(row.x + BESIDE, length)}:
            sides = ("right",) if x == 0.0 else ("left",) if x >= length else ("left", "right")
            values += [float(getattr(exact.at(x, side), name)) for side in sides]
    # What is next to nothing beside the other extreme is as far off as that moves beside its place
    slack = max(1e-5 * max(map(abs, values), default=0.0), BESIDE * size)
    if values and not min(values) - slack <= row.value <= max(values) + slack:
        verdict.wrong.append(f"{end} of {name} is {row.value:.12g} at {row.x}, train at {row.position!r}, exactly {values}")


FAMILY = Family("trains", PROMISE, draw_scene, judge, share=0.08)
