"""Beams on ground whose force falls: states by what their fields leave over, and the same end of the loads on two roads."""

import gapbeam
import numpy as np
from scenes.falling import random_falling_scene

from .family import Family, Verdict
from .ground import PANELS, along, at_places, supports
from .proofs import proof_faults

PROMISE = (
    "On ground whose force falls the fields satisfy the differential equations with what the curve gives for the deflection, and "
    "supports are on theirs. A beam that stands under all loads at once stands from event to event too, in the same state. Where "
    "it gives way both say so at the same factor"
)
SAME = 1e-9
SAME_LIMIT = 1e-8
"""Shares of the largest deflection, and of the load factor at which a beam gives way."""


def draw_scene(seed):
    """Kind and scene of a seed."""
    made = random_falling_scene(seed)
    return made["foundation"][0]["side"], made


def judge(made, seed=0):
    """Solve a scene at once and from event to event.

    Parameters
    ----------
    made : dict
    seed : int

    Returns
    -------
    Verdict
    """
    try:
        result = gapbeam.solve(made)
        path = gapbeam.solve({**made, "analysis": {"follow": "events"}})
    except gapbeam.EngineError as error:
        return Verdict("not followed", [] if "could not be followed" in str(error) else [str(error)])
    verdict = Verdict(path.status)
    if (result.status == "solved") != (path.status == "solved"):
        verdict.wrong.append(f"{result.status} at once, {path.status} from event to event: {result.reason or path.reason}")
    elif result.status == "solved":
        for panels in PANELS:
            if not (wrong := along(made, result, panels)):
                break
        verdict.wrong = [*wrong, *at_places(made, result), *supports(made, result), *proof_faults(made, seed)]
        x = np.linspace(0.0, made["beam"]["spans"][0], 9)
        one, other = result.at(x).deflection, path.at(x).deflection
        if np.abs(one - other).max() > SAME * np.abs(one).max():
            verdict.wrong.append("another state from event to event")
    elif path.limits and "no more than" in result.reason:
        share = float(result.reason.split("no more than ")[1].split()[0])
        if abs(share - path.limits[0].factor) > SAME_LIMIT * share:
            verdict.wrong.append(f"it gives way at {share}, from event to event at {path.limits[0].factor}")
    return verdict


FAMILY = Family("falling", PROMISE, draw_scene, judge, share=0.05)
