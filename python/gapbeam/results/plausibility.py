"""Plausibility: what in a scene is probably a slip of a unit or of a decimal point, with its key and value."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..scene.names import column_of
from ..scene.rotations import which_turn
from ..scene.temperature import is_held_along
from . import formatting as fmt
from .equilibrium import sum_of_loads
from .state.ground import joined
from .views.extreme import KINDS

if TYPE_CHECKING:
    from ..scene.structs import Scene
    from .envelopes.envelope import Envelope
    from .result import Result
    from .trains.envelope import TrainEnvelope

LARGE, SMALL = 0.1, 1e-8
"""Deflections beyond these shares of a span are rarely meant."""
LARGE_GAP, LARGE_UNUSED_GAP, BESIDE = 0.1, 0.02, 10.0
"""Gaps and settlements beyond a share of the shortest span are as rare; of a gap that stays open a smaller share is enough, where
it is so many times the largest deflection."""
SIGN = "Check:"
"""How such a sentence begins."""


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
    scene = result.scene
    if words := _no_load(scene):
        return [f"{SIGN} {words}"]
    spans = [span for span in scene.beam.spans if span > 0.0]
    longest, shortest = max(spans), min(spans)
    deflection = max((abs(one.value) for one in envelope.extremes["deflection"].values() if one is not None), default=0.0)
    found = [*_displaced(scene, shortest, deflection, envelope), *_off_beam(scene)]
    if deflection > LARGE * longest and not found:
        found.append(_soft(result, longest, deflection, envelope))
    elif 0.0 < deflection < SMALL * shortest and math.isfinite(stiffness := _stiffness(scene)):
        share = f"{deflection / shortest:.1g} of the shortest span"
        found.append(f"beam.EI = {fmt.number(stiffness)} makes a largest deflection of only {share}; are its units those of spans "
                     "and loads?")  # fmt: skip
    return [f"{SIGN} {words}" for words in found]


def doubts_of_signs(result: Result) -> list[str]:
    """Say that loads are positive downward, where the beam falls upward.

    Parameters
    ----------
    result : Result
        That is not solved.

    Returns
    -------
    list of str
        One sentence or none.
    """
    scene = result.scene
    if result.combinations or result.status != "no-equilibrium" or scene.trains:
        return []
    if set(column_of(scene.supports, "side")) != {"below"} or sum_of_loads(scene, 1.0).force >= 0.0:
        return []
    k, key, value = min(
        ((k, key, np.min(getattr(load, key))) for k, load in enumerate(scene.loads) for key in ("F", "q") if hasattr(load, key)),
        key=lambda one: one[2],
    )
    return [f"{SIGN} loads[{k}].{key} = {fmt.number(float(value))} acts upward; loads are positive downward."]


def _no_load(scene: Scene) -> str | None:
    if scene.trains or len(scene.foundation) or any(one.settlements for one in scene.combinations):
        return None
    if any(column_of(scene.supports, "settlement")) or any(gap and gap < 0.0 for gap in column_of(scene.supports, "gap")):
        return None
    if not len(scene.loads):
        return "loads is empty, so no load acts."
    keys = ("F", "M", "q", "kappa", "value", "gradient")
    if not any(np.any(getattr(load, key)) for load in scene.loads for key in keys if hasattr(load, key)):
        if any(getattr(load, "dT", 0.0) for load in scene.loads):
            if is_held_along(scene):
                return None
            return "loads have dT alone, which lengthens a beam that nothing holds along its axis: no force comes of it."
        return "all values of loads are 0, so no load acts."
    return None


def _off_beam(scene: Scene) -> list[str]:
    """Trains that never come to the beam."""
    end = float(scene.span_ends()[-1])
    return [
        f"trains[{k}] has no axle on the beam between its from and to, which are places of its first axle."
        for k, one in enumerate(scene.trains)
        if one.axles and ((one.from_ or 0.0) - max(distance for distance, _ in one.axles) > end or (one.to or 0.0) < 0.0)
    ]


def _displaced(scene: Scene, shortest: float, deflection: float, envelope: Envelope | TrainEnvelope) -> list[str]:
    """Gaps and settlements that are large beside the spans."""
    found, gaps = [], np.abs([gap or 0.0 for gap in column_of(scene.supports, "gap")])
    settlements = np.abs(np.array(column_of(scene.supports, "settlement"), dtype=float))
    if len(gaps):
        gaps[which_turn(scene.supports)] = settlements[which_turn(scene.supports)] = 0.0  # angles
    unused = np.array(envelope.supports.values("opening", "min")) > 0.0 if len(gaps) else gaps > 0.0
    wrong = (gaps > LARGE_GAP * shortest) | (unused & (gaps > LARGE_UNUSED_GAP * shortest) & (gaps > BESIDE * deflection))
    for key, which in (("gap", wrong), ("settlement", settlements > LARGE_GAP * shortest)):
        if which.any():
            k = int(which.argmax())
            found.append(_long(f"supports[{k}].{key}", getattr(scene.supports[k], key), shortest))
    for one in scene.combinations:
        for name, value in one.settlements.items():
            if abs(value) > LARGE_GAP * shortest and len(found) < 2:
                found.append(_long(f"combinations {one.name}.settlements.{name}", value, shortest))
    return found


def _long(place: str, value: float, shortest: float) -> str:
    share = _share(abs(value) / shortest, "shortest")
    return f"{place} = {fmt.number(value)} is {share}; is it in the unit of the spans?"


def _soft(result: Result, longest: float, deflection: float, envelope: Envelope | TrainEnvelope) -> str:
    """What makes the deflections large: a spring, the ground, else the beam or its loads."""
    scene, limit = result.scene, LARGE * longest
    springs = np.array(column_of(scene.supports, "stiffness"), dtype=float)
    if len(springs):
        reactions = np.max([np.abs(envelope.supports.values("reaction", kind)) for kind in KINDS], axis=0)
        reactions[which_turn(scene.supports)] = 0.0
        with np.errstate(divide="ignore", invalid="ignore"):
            given = np.nan_to_num(reactions / springs, nan=0.0, posinf=0.0)
        if given.max() > limit:
            k = int(given.argmax())
            share = _share(given[k] / longest, "longest")
            return f"supports[{k}].stiffness = {fmt.number(springs[k])} gives by {share}; is it a force per length?"
    steps = result.steps if not result.combinations and not scene.trains else ()
    for zone in joined(steps[-1].contact) if len(steps) else ():
        k = scene.foundation[zone.foundation].k
        if isinstance(k, int | float) and k * limit * (zone.to - zone.from_) < abs(zone.resultant):
            place = f"foundation[{zone.foundation}].k = {fmt.number(k)}"
            return f"{place} gives by more than a tenth of the longest span; is it a force per length and length of beam?"
    share = _share(deflection / longest, "longest")
    return (f"beam.EI = {fmt.number(_stiffness(scene))} makes a largest deflection of {share}; are its units those of spans and "
            "loads?")  # fmt: skip


def _share(value: float, which: str) -> str:
    return f"{fmt.number(100.0 * value, 2)} % of the {which} span"


def _stiffness(scene: Scene) -> float:
    """The largest stiffness of the beam."""
    return float(np.max(scene.beam.EI))
