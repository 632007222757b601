"""Beams on ground whose force falls: states by what their fields leave over, and the same end of the loads on two roads."""

from itertools import pairwise

import gapbeam
import numpy as np
from oracle.ground_laws import SIDES
from scenes.falling import filled, random_falling_scene

from .family import Family, Verdict
from .ground import another_state, followed, left_over

PROMISE = (
    "On ground whose force falls the fields satisfy the differential equations with what the curve gives for the deflection, and "
    "supports are on theirs. A beam that stands under all loads at once stands from event to event too, in the same state. Where "
    "it gives way both say so at the same factor"
)
PLACES = 400
NEAR = 0.999
"""Share of the way to a peak."""
SAME_LIMIT = 1e-8
"""Share of the load factor at which a beam gives way."""


def draw_scene(seed):
    """Kind and scene of a seed."""
    made = random_falling_scene(seed)
    return made["foundation"][0]["side"], made


def judge(made, seed=0):
    """Solve a scene at once and from event to event."""
    try:
        result = gapbeam.solve(made)
        path = followed(made)
    except gapbeam.EngineError as error:
        return Verdict("not followed", [] if "could not be followed" in str(error) else [str(error)])
    verdict = Verdict(path.status)
    if (result.status == "solved") != (path.status == "solved"):
        verdict.wrong.append(f"{result.status} at once, {path.status} from event to event: {result.reason or path.reason}")
    elif result.status == "solved":
        verdict.wrong = [*left_over(made, result, seed), *another_state(made, result, path)]
    elif is_borne_below_the_peaks(made):
        verdict.wrong.append(f"it stands on ground that never falls, nowhere at a peak, but here: {result.reason}")
    elif path.limits and "no more than" in result.reason:
        share = float(result.reason.split("no more than ")[1].split()[0])
        if abs(share - path.limits[0].factor) > SAME_LIMIT * share:
            verdict.wrong.append(f"it gives way at {share}, from event to event at {path.limits[0].factor}")
    return verdict


def is_borne_below_the_peaks(made):
    """Whether a beam on ground that never falls stands under its dead loads, and parts of the others, and comes to no peak."""
    dead = any(load.get("case") == "dead" for load in made["loads"])
    for share in (*([0.0] if dead else []), 0.25, 0.5, 0.75, 1.0):
        try:
            result = gapbeam.solve(filled(made, 1.0, share))
        except gapbeam.EngineError:
            return False
        if result.status != "solved" or is_beyond_a_peak(made, result):
            return False
    return True


def is_beyond_a_peak(made, result):
    """Whether any ground is pressed as far as where its force falls."""
    end = made["beam"]["spans"][0]
    for item in made["foundation"]:
        x = np.linspace(item.get("from", 0.0), item.get("to", end), PLACES)
        w = result.at(x).deflection
        pressed = max((side * w - item.get("gap", 0.0)).max() for side in SIDES[item["side"]])
        if any(pressed >= NEAR * d for points in polylines_of(item["law"]) for (d, p), (_, q) in pairwise(points) if q < p):
            return True
    return False


def polylines_of(law):
    """Polylines of a law at its places, or everywhere; none where it has a name."""
    if isinstance(law, dict):
        return []
    return [at["points"] for at in law] if isinstance(law[0], dict) else [law]


FAMILY = Family("falling", PROMISE, draw_scene, judge, share=0.05)
