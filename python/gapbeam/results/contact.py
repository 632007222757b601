"""Contact in words: which supports have no contact and by how much, how much of the ground carries."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

from ..base.characters import visible
from ..scene.names import column_of, label
from ..scene.rotations import at_support, turns
from ..scene.structs import Scene
from ..scene.trains import LEFT
from . import formatting as fmt
from .envelopes.lifted import Lifted
from .envelopes.over_path import is_followed
from .event_words import share_in_words
from .state.ground import TOUCHING, joined, noun_of

if TYPE_CHECKING:
    from .result import Result
    from .views.extreme import Extreme

MOST_NAMED = 8
"""Supports without contact that are told one by one."""
SAME = 1.0 + 1e-9
"""Share of a gap up to which an opening is that gap."""


def source_in_words(one: Lifted | Extreme, scene: Scene, factor: bool = True) -> str:
    """Say where a value comes from: combination, train and its position, load factor.

    Parameters
    ----------
    one : Lifted or Extreme
        Has some of ``combination``, ``train``, ``position``, ``factor``, ``leg``.
    scene : Scene
        Knows the history of its load.
    factor : bool
        Whether the load factor is said, where there is one.

    Returns
    -------
    str
        Empty where there is nothing to say.
    """
    words = [] if one.combination is None else [visible(one.combination)]
    train = one.train
    if train is not None:
        direction = " going left" if getattr(one, "direction", None) == LEFT else ""
        at = "" if one.position is None else f" at {position_in_words(scene, one.position)}"
        words.append(f"{visible(train)}{at}{direction}")
    at = one.factor
    if factor and at is not None:
        leg = getattr(one, "leg", None)
        on_leg = f" of leg {leg}" if leg and len(scene.analysis.history) > 1 else ""
        words.append(f"load factor {fmt.number(at, fmt.DIGITS)}{on_leg}")
    return ", ".join(words)


def position_in_words(scene: Scene, x: float, digits: int = fmt.DIGITS) -> str:
    """Write the position of a train: 0 where it is nothing but rounding beside the length of the beam.

    Parameters
    ----------
    scene : Scene
    x, digits : float, int
        The position, and significant digits.
    """
    return fmt.number(x if abs(x) > fmt.NOISE * float(scene.span_ends()[-1]) else 0.0, digits)


def contact_in_words(result: Result, lifted: list[Lifted], carrying: Collection[int] = ()) -> list[str]:
    """Say which supports have no contact and by how much.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.
    lifted : list of Lifted
        By `lifted_supports`.
    carrying : collection of int
        By `carrying_supports`.

    Returns
    -------
    list of str
        Sentences; none where no support is one-sided.
    """
    supports = result.scene.supports
    one_sided = {k for k, side in enumerate(column_of(supports, "side")) if side != "both"}
    if not one_sided:
        return []
    broken = {event.support for event in result.events if event.event == "breaks"} if not result.combinations else set()
    lost = len((broken & one_sided) - {one.support for one in lifted})
    x, lines = result.scene.positions(supports), _closed_gaps(result, {one.support for one in lifted})
    if not lifted and not lost:
        return [*lines, "No support lifts off." if len(one_sided) > 1 or lines else "The support that can lift off does not."]
    largest = sorted(lifted, key=lambda one: (turns(supports[one.support]), -one.opening))
    for one in sorted(largest[:MOST_NAMED]):
        place = f"{_named(result.scene, one.support)} (x = {fmt.number(x[one.support], fmt.DIGITS)})"
        lines.append(f"{place} {_how_far(result, one, one.support in carrying)}.")
    if more := sorted(one.support for one in largest[MOST_NAMED:]):
        named = ", ".join(label(supports, k) for k in more) if len(more) <= MOST_NAMED else fmt.ranges(more)
        lines.append(f"{len(more):,} more have no contact, all with smaller openings: {named}.")
    left = len(one_sided) - len(lifted) - lost
    if left:
        lines.append(f"The other {left:,} one-sided supports stay in contact." if left > 1
                     else "The other one-sided support stays in contact.")  # fmt: skip
    return lines


def _named(scene: Scene, k: int) -> str:
    """Name a support at the beginning of a sentence."""
    name = fmt.support(scene, k)
    return f"{name[0].upper()}{name[1:]}"


def _closed_gaps(result: Result, lifted: set[int]) -> list[str]:
    """Say which supports with a gap are reached, where the load is not followed and nothing else tells it."""
    scene = result.scene
    if result.combinations or scene.trains or is_followed(result) or not result.steps:
        return []
    gaps, states = column_of(scene.supports, "gap"), result.steps[-1].state
    closed = [k for k, gap in enumerate(gaps) if gap and gap > 0.0 and states[k] != "open" and k not in lifted]
    if len(closed) > MOST_NAMED:
        return [f"{len(closed):,} supports close their gaps."]
    x = scene.positions(scene.supports)
    return [
        f"{_named(scene, k)} (x = {fmt.number(x[k], fmt.DIGITS)}) "
        f"{'is at the end of its slack' if turns(scene.supports[k]) else 'closes its gap'} of "
        f"{fmt.value(scene, at_support(scene, 'gap', k), gaps[k])}."
        for k in closed
    ]


def _how_far(result: Result, one: Lifted, carries: bool) -> str:
    """Say how far a support is from the beam, whether it carries elsewhere, and what becomes of that."""
    scene = result.scene
    gap, followed = max(scene.supports[one.support].gap or 0.0, 0.0), is_followed(result)
    source = source_in_words(one, scene) if result.combinations or scene.trains or followed else ""
    ends_closed = followed and not result.combinations and not scene.trains and result.steps[-1].state[one.support] != "open"
    opening = fmt.value(scene, at_support(scene, "opening", one.support), one.opening)
    if turns(scene.supports[one.support]):
        return f"turns freely, {opening} from where it holds{f' ({source})' if source else ''}"
    if ends_closed and gap and one.opening <= SAME * gap:
        closing = (event for event in result.events if event.support == one.support and event.event == "closes")
        first = next(closing, None)
        when = f" {share_in_words(scene, first.factor)}" if first is not None and len(scene.analysis.history) == 1 else ""
        return f"closes its gap of {fmt.value(scene, 'gap', gap)}{when}"
    about = ", ".join([*([f"gap {fmt.value(scene, 'gap', gap)}"] if gap else []), *([source] if source else [])])
    ends_there = result.steps and not (ends_closed or result.combinations or scene.trains) and one.factor == result.steps[-1].factor
    apart = "has no contact: opening" if ends_there or not (carries or ends_closed) else "is not always in contact: opening up to"
    words = f"{apart if gap else 'lifts off by'} {opening}{f' ({about})' if about else ''}"
    return f"{words}, and is in contact at the end" if ends_closed else words


def ground_in_words(result: Result) -> list[str]:
    """Say how much of one-sided ground carries at the last step.

    Parameters
    ----------
    result : Result
        A solved one.

    Returns
    -------
    list of str
        Sentences; none where nothing can lift off.
    """
    step, scene = result.steps[-1], result.scene
    zones, spans = joined(step.contact), step.free_spans
    if not spans and all(item.side == "both" for item in scene.foundation):
        return []

    def words(value: float, quantity: str = "length") -> str:
        return fmt.value(scene, quantity, float(fmt.number(value, 4)))

    lines = []
    if zones:
        of = words(sum(to - from_ for from_, to in (fmt.stretch(scene, item) for item in scene.foundation)))
        together = fmt.number(sum(zone.to - zone.from_ for zone in zones), 4)
        places = f", in {len(zones):,} {noun_of(zones)}s" if len(zones) > 1 else ""
        over = f"over {together} of {of}{places}"
        if all(zone.from_ == zone.to for zone in zones):
            over = f"at {fmt.count(len(zones), 'place')}"
        lines.append(f"Contact with the ground {over}.")
    touching = [zone.from_ for zone in step.contact if zone.state == TOUCHING]
    if touching:
        where = f"at x = {fmt.number(touching[0], 4)}" if len(touching) == 1 else f"at {len(touching)} places"
        lines.append(f"{'It touches' if zones else 'It only touches'} the ground {where}.")
    if not lines:
        lines.append("No contact with the ground.")
    if spans:
        longest, highest = max(spans, key=lambda span: span.to - span.from_), words(max(span.sag for span in spans), "sag")
        ends = f"from x = {fmt.number(longest.from_, 4)} to {fmt.number(longest.to, 4)}"
        length = words(longest.to - longest.from_)
        lines.append(f"1 free span, {ends}: {length} long, up to {highest} above the ground." if len(spans) == 1 else
                     f"{len(spans):,} free spans, the longest {ends}: {length}; up to {highest} above the ground.")  # fmt: skip
    return lines
