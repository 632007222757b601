"""Piles in layers from event to event: states at and beside events, between them, and seen from behind."""

import random
from itertools import pairwise

import gapbeam
from scenes.layered import random_layered_scene
from scenes.transformed import mirrored

from .family import Family, Verdict
from .ground import another_state, followed, left_over

PROMISE = (
    "A pile in layers with laws has the same state under all loads at once and from event to event. At every event there is a "
    "state, and just beside it; between two events the same zones act. Seen from behind all events are at the same factors"
)
SAME_FACTOR = 1e-10
APART = 1e-7
"""Shares of the load factor: of events that are the same, and of those that states are looked at between."""
MOST = 8
"""Events of a path whose states are looked at."""


def draw_scene(seed):
    """Kind and scene of a seed."""
    made = random_layered_scene(seed)
    return made["foundation"][0]["side"], made


def judge(made, seed=0):
    """Solve a scene at once and from event to event."""
    rng = random.Random(seed)
    try:
        result, path = gapbeam.solve(made), followed(made)
    except gapbeam.EngineError as error:
        return Verdict("refused", [str(error)])
    verdict = Verdict(path.status)
    if result.status != "solved":
        if path.status == "solved":
            verdict.wrong.append(f"{result.status} at once, {path.status} from event to event: {result.reason}")
        return verdict
    if path.status != "solved":
        verdict.wrong.append(f"solved at once, {path.status} from event to event: {path.reason}")
        return verdict
    verdict.wrong = [*left_over(made, result, seed), *another_state(made, result, path)]
    try:
        verdict.wrong += at_events(path, rng)
        verdict.wrong += from_behind(made, path)
    except gapbeam.EngineError as error:
        verdict.wrong.append(f"on the path: {error}")
    return verdict


def at_events(path, rng):
    """What is wrong at events, beside and between them."""
    events = path.events
    for event in rng.sample(list(events), min(MOST, len(events))):
        for share in (-1e-9, 0.0, 1e-9):
            try:
                zones_at(path, event.factor * (1 + share))
            except gapbeam.EngineError as error:
                yield f"{event.event} at {event.factor!r}, x = {event.x}: {error}"
    factors = [0.0, *(event.factor for event in events), 1.0]
    wide = [(low, high) for low, high in pairwise(factors) if high - low > APART * high]
    for low, high in rng.sample(wide, min(MOST, len(wide))):
        shares = (0.001, rng.random(), 0.999) if low > 0.0 else (rng.random(), 0.999)
        zones = [zones_at(path, low + share * (high - low)) for share in shares]
        if any(zones[0] != some for some in zones):
            yield f"between {low!r} and {high!r} zones change without an event: {zones}"


def zones_at(path, factor):
    """Foundation and state of the zones, from left to right; ground that acts both ways always does on its first branch."""
    always = {number for number, item in enumerate(path.scene.foundation) if item.side == "both"}
    zones = ((zone.foundation, zone.state) for zone in path.state(factor).contact)
    return [(number, state) for number, state in zones if not (number in always and state == "branch 1")]


def from_behind(made, path):
    """What differs where the scene is seen from behind."""
    other = followed(mirrored(made))
    mine, theirs = (sorted(event.factor for event in some.events) for some in (path, other))
    if len(mine) != len(theirs):
        yield f"{len(mine)} events, and from behind {len(theirs)}"
        return
    for one, two in zip(mine, theirs, strict=True):
        if abs(one - two) > SAME_FACTOR * one:
            yield f"an event at {one!r} is at {two!r} from behind"


FAMILY = Family("layers", PROMISE, draw_scene, judge, share=0.05)
