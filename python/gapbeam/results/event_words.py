"""States and events in words: what happens to a support or to the ground, at which load, with which reaction."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from ..scene.movements import moves_with_load
from ..scene.names import DEAD, cases_of, label
from ..scene.rotations import at_support
from . import formatting as fmt
from .envelopes.envelope import AT_SUPPORTS
from .paths.path import Event
from .state.breakpoints import OF_SUPPORTS, OF_ZONES

if TYPE_CHECKING:
    from ..scene.structs import Scene
    from .envelopes.over_path import PathEnvelope
    from .paths.ground_path import GroundEvent
    from .result import Result
    from .trains.traversals import TrainEvent

STATES = {"closed": "in contact", "open": "no contact", "bilateral": "two-way"}
"""States of supports and zones in reports; the names in results and files stay."""
EVENT_WORDS = dict((OF_SUPPORTS | OF_ZONES).values())
LIMITS = {"limit": "Limit load", "bifurcation": "Bifurcation", "mechanism": "Limit load (mechanism)"}
"""Kinds of limits of the load."""
WITHOUT_CONTACT = {"opens": "lets go", "closes": "holds"}
"""Words for supports along the beam, and for rotations."""
LOST = ("yields", "softens", "breaks")
"""Events after which a support carries no more than before."""


def limit_in_words(result: Result, kind: str) -> str:
    """Word a limit of the load.

    Parameters
    ----------
    result : Result
        Of one load.
    kind : str
        Of the limit, a key of `LIMITS`.

    Returns
    -------
    str
        Where nothing moves freely, as between supports that loads move, it is no mechanism.
    """
    is_free = kind != "mechanism" or result.motion is not None or not moves_with_load(result.scene)
    return LIMITS[kind] if is_free else "Limit of movements"


def state_in_words(state: str) -> str:
    """Word the state of a support or of a zone.

    Parameters
    ----------
    state : str
        As in results.

    Examples
    --------
    >>> state_in_words("closed"), state_in_words("branch 2"), state_in_words("touching")
    ('in contact', 'segment 2', 'touching')
    """
    return STATES.get(state, state.replace("branch", "segment"))


def share_in_words(scene: Scene, factor: float) -> str:
    """Word a load factor in a sentence: a share of the load where it scales all of it.

    Examples
    --------
    >>> from gapbeam import Beam, ForceLoad, Scene
    >>> scene = Scene(beam=Beam([6.0], EI=1.0), loads=[ForceLoad(x=2.0, F=5.0)])
    >>> share_in_words(scene, 0.7015), share_in_words(scene, -0.5)
    ('at 70.15 % of the load', 'at load factor -0.5')
    """
    if factor > 0.0 and DEAD not in cases_of(scene.loads):
        return f"at {fmt.number(100.0 * factor, fmt.DIGITS)} % of the load"
    return f"at load factor {fmt.number(factor, fmt.DIGITS)}"


def reaction_at(result: Result, envelope: PathEnvelope | None, support: int, factor: float, event: str) -> float | None:
    """Find the reaction at which a support yields, softens or breaks.

    Parameters
    ----------
    result : Result
        Of one load.
    envelope : PathEnvelope or None
        Over its loading history.
    support : int
        Its number.
    factor : float
    event : str
        What happens.

    Returns
    -------
    float or None
        None where it is not known: for other events, and for what happens during a jump.
    """
    jumps = [limit for limit in result.limits if limit.factor == factor]
    if envelope is None or event not in LOST or (jumps and all((support, event) not in limit.causes for limit in jumps)):
        return None
    there = [k for k, source in enumerate(envelope.sources) if source.factor == factor]
    values = envelope.at_supports[there, AT_SUPPORTS.index("reaction"), support]
    return float(values[np.abs(values).argmax()]) if len(values) else None


def event_in_words(scene: Scene, event: Event | GroundEvent | TrainEvent, reaction: float | None = None) -> str:
    """Say what happens, to what and where.

    Parameters
    ----------
    scene : Scene
    event : Event, GroundEvent or TrainEvent
        What happens.
    reaction : float, optional
        Of the support, where it is at a reaction that it happens.

    Returns
    -------
    str
        ``support pin (x = 3) breaks (90 kN)``.
    """
    x = fmt.number(event.x, fmt.DIGITS)
    if event.support is None:
        branch = getattr(event, "branch", 1)
        of = f" of segment {branch}" if branch > 1 else ""
        known = len(scene.foundation) > 1 or scene.foundation[0].name is not None
        name = f"ground {label(scene.foundation, event.foundation)}: " if known else "ground: "
        return f"{name}{EVENT_WORDS[event.event]}{of} at x = {x}"
    quantity = at_support(scene, "reaction", event.support)
    force = f" ({fmt.value(scene, quantity, abs(reaction))})" if reaction else ""
    words = EVENT_WORDS[event.event]
    if event.event == "hardens" and _falls_to_a_level(scene.supports[event.support].law):
        words = "reaches its residual force"
    if scene.supports[event.support].direction != "normal":
        words = WITHOUT_CONTACT.get(event.event, words)
    return f"{fmt.support(scene, event.support)} (x = {x}) {words}{force}"


def _falls_to_a_level(law: object) -> bool:
    """Whether a law gets steeper only where its force has fallen, and stays from there on."""
    if not isinstance(law, list):
        return False
    points = [(0.0, 0.0), *law]
    slopes = [(s - r) / (e - d) if e != d else math.copysign(math.inf, s - r) for (d, r), (e, s) in pairwise(points)]
    rises = [(one, two) for one, two in pairwise(slopes) if two > one]
    return bool(rises) and all(one < 0.0 == two for one, two in rises)


def limits_of_load_in_words(result: Result, envelope: PathEnvelope | None, most: int) -> list[str]:
    """Say which limits the load has, and which supports yield or break apart from these.

    Parameters
    ----------
    result : Result
        Of one load.
    envelope : PathEnvelope or None
        Over its loading history.
    most : int
        Limits, and supports, that are named.

    Returns
    -------
    list of str
        Sentences.
    """
    scene, x = result.scene, result.scene.positions(result.scene.supports)

    def happening(k: int, factor: float, event: str) -> str:
        return event_in_words(scene, Event(factor, k, float(x[k]), event), reaction_at(result, envelope, k, factor, event))

    lines, told = [], set()
    for limit in result.limits:
        told |= {(k, event) for k, event in limit.causes}
    for limit in result.limits[:most]:
        causes = ", ".join(happening(k, limit.factor, event) for k, event in limit.causes)
        words = f"{limit_in_words(result, limit.kind)} {share_in_words(scene, limit.factor)}{f': {causes}' if causes else ''}"
        lines.append(f"{words}.")
    if len(result.limits) > most:
        lines.append(f"... and {fmt.count(len(result.limits) - most, 'more limit')}.")
    lost: dict[tuple[int, str], Event] = {}
    for event in result.events:
        if event.event in LOST and event.support is not None and (event.support, event.event) not in told:
            lost.setdefault((event.support, event.event), event)
    for (k, what), event in list(lost.items())[:most]:
        words = f"{share_in_words(scene, event.factor)} {happening(k, event.factor, what)}"
        lines.append(f"{words[0].upper()}{words[1:]}.")
    if len(lost) > most:
        more = sorted({k for k, _ in list(lost)[most:]})
        lines.append(f"... and {fmt.count(len(more), 'more support')} that yield, soften or break: {fmt.ranges(more)}.")
    return lines
