"""A sample of the scenes of other families, proved by the checker that shares nothing with gapbeam; without python-flint none."""

import re

import gapbeam
from gapbeam.results.proof import proof_data

try:
    import proof_checker
    import proof_checker_ground
except ImportError:
    proof_checker = None

EVERY = 8  # so many seeds have one that is proved


def proof_faults(made, seed):
    """What the checker finds wrong in the last state of a scene, as a list of at most one line.

    What gapbeam names as not decided by the data is not asked, and what the checker does not decide is no fault, nor are values
    that are farther off than the checker allows, by no more than their certificate says.
    """
    if proof_checker is None or seed % EVERY:
        return []
    try:
        data = proof_data(made)
        step = gapbeam.solve(data["scene"]).steps[-1] if data["status"] == "solved" else None
        if step and step.undecided:
            return []
        decide = proof_checker_ground.decide_on_ground if made.get("foundation") else proof_checker.decide
        decide(data)
    except (gapbeam.SceneError, gapbeam.EngineError):
        return []
    except proof_checker.Answer as answer:
        off = re.search(r"values are off by (\S+) of the largest", answer.args[1])
        if answer.args[0] != 1 or (off and float(off[1]) <= step.certificate["error_bound"]):
            return []
        return [f"proof: refuted: {answer.args[1]}"]
    return []
