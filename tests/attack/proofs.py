"""A sample of the scenes of other families, proved by the checker that shares nothing with gapbeam; without python-flint none."""

import gapbeam
from gapbeam.results.proof import proof_data

try:
    import proof_checker
except ImportError:
    proof_checker = None

EVERY = 8  # so many seeds have one that is proved


def proof_faults(made, seed):
    """What the checker finds wrong in the last state of a scene, as a list of at most one line.

    What gapbeam names as not decided by the data is not asked, and what the checker does not decide is no fault.
    """
    if proof_checker is None or seed % EVERY:
        return []
    try:
        data = proof_data(made)
        if data["status"] == "solved" and gapbeam.solve(data["scene"]).steps[-1].undecided:
            return []
        proof_checker.decide(data)
    except (gapbeam.SceneError, gapbeam.EngineError):
        return []
    except proof_checker.Answer as answer:
        return [f"proof: refuted: {answer.args[1]}"] if answer.args[0] == 1 else []
    return []
