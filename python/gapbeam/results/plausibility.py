"""Plausibility: what in a scene is probably a slip of a unit or of a decimal point, with its key and value."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from . import formatting as fmt

if TYPE_CHECKING:
    from .envelopes.envelope import Envelope
    from .result import Result
    from .trains.envelope import TrainEnvelope

LARGE, SMALL = 0.1, 1e-9
"""Deflections beyond these shares of a span are rarely meant."""
LARGE_GAP = 0.1
"""A gap beyond this share of the shortest span is as rare."""


def doubts_of_scene(result: Result, envelope: Envelope | TrainEnvelope) -> list[str]:
    """Name what is probably not meant.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.
    envelope : Envelope or TrainEnvelope
        Its `Result.envelope`.

    Returns
    -------
    list of str
        Sentences, each with key and value.
    """
    scene, found = result.scene, []
    spans = [span for span in scene.beam.spans if span > 0.0]
    longest, shortest = max(spans), min(spans)
    moved = any(support.settlement or support.gap for support in scene.supports) or bool(len(scene.foundation))
    if not len(scene.loads) and not scene.trains and not moved:
        return ["No load acts: loads is empty."]
    stiffness = scene.beam.EI if isinstance(scene.beam.EI, int | float) else max(scene.beam.EI)
    deflection = max((abs(one.value) for one in envelope.extremes["deflection"].values() if one is not None), default=0.0)
    asked = f"is beam.EI = {fmt.number(stiffness)} in the units of spans and loads?"
    if deflection > LARGE * longest:
        found.append(f"The deflection is {deflection / longest:.2g} of the longest span: {asked}")
    elif 0.0 < deflection < SMALL * shortest and math.isfinite(stiffness):
        found.append(f"The deflection is {deflection / shortest:.1g} of the shortest span: {asked}")
    for k, support in enumerate(scene.supports):
        if abs(support.gap or 0.0) > LARGE_GAP * shortest:
            gap = f"supports[{k}].gap = {fmt.number(support.gap)}"
            found.append(f"{gap} is more than a tenth of the shortest span: is it in the unit of the spans?")
            break
    return found
