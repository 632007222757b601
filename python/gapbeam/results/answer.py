"""Answers in words: whether the beam stands, what has no contact and by how much, the largest values and where they come from.

The report begins with them, and a result shows them where it is displayed.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..base.characters import visible
from ..scene.structs import Scene
from ..scene.trains import LEFT
from . import formatting as fmt
from .envelopes.lifted import NONE, Lifted, lifted_supports
from .envelopes.over_path import count_states, is_followed
from .envelopes.tables import KINDS
from .plausibility import doubts_of_scene
from .state.ground import TOUCHING, joined
from .state.states import MOVING
from .utilisation import Utilisation, find_utilisations

if TYPE_CHECKING:
    from .envelopes.envelope import Envelope
    from .result import Result
    from .trains.envelope import TrainEnvelope
    from .views.extreme import Extreme

MOST_WORK = 2_000_000
"""States times pieces of the beam up to which values over the whole way of the load are looked for unasked: some seconds."""
MOST_NAMED = 8
"""Supports without contact that are named."""
WIDTH = 56
"""Characters of two values that stand in one line."""
NOT_FOLLOWED = "the path has so many states that its largest values are looked for on request only"


def has_cheap_envelope(result: Result) -> bool:
    """Whether largest values are found in some seconds, so that they are looked for unasked.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.

    Returns
    -------
    bool
    """
    if not is_followed(result):
        return True
    ones = result.combinations.values() if result.combinations else [result]
    return sum(count_states(one) for one in ones) * len(result._beam.places.pieces) <= MOST_WORK


def short(scene: Scene, quantity: str, value: float) -> str:
    """Write a value with its unit, displacements in mm where lengths are in m.

    Parameters
    ----------
    scene : Scene
        The scene with its unit labels.
    quantity : str
        As for `formatting.unit`.
    value : float
        In the unit of the scene.

    Returns
    -------
    str

    Examples
    --------
    >>> from gapbeam import Beam, Scene, Units
    >>> scene = Scene(beam=Beam([4.0], EI=1.0), units=Units("kN", "m"))
    >>> short(scene, "opening", 0.0263), short(scene, "moment", 205.5)
    ('26.3 mm', '205.5 kN m')
    """
    return f"{fmt.shown(scene, quantity, value)} {fmt.shown_unit(scene, quantity)[0]}".rstrip()


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
        at = "" if one.position is None else f" at {fmt.number(one.position, fmt.DIGITS)}"
        words.append(f"{visible(train)}{at}{direction}")
    at = one.factor
    if factor and at is not None:
        leg = getattr(one, "leg", None)
        on_leg = f" of leg {leg}" if leg and len(scene.analysis.history) > 1 else ""
        words.append(f"load factor {fmt.number(at, fmt.DIGITS)}{on_leg}")
    return ", ".join(words)


def contact_in_words(result: Result, lifted: list[Lifted]) -> list[str]:
    """Say which supports have no contact and by how much.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.
    lifted : list of Lifted
        By `lifted_supports`.

    Returns
    -------
    list of str
        Sentences; none where no support is one-sided.
    """
    scene = result.scene
    one_sided = sum(support.side != "both" for support in scene.supports)
    if not one_sided:
        return []
    if not lifted:
        return ["No support lifts off." if one_sided > 1 else "The support that can lift off does not."]
    x, lines = scene.positions(scene.supports), []
    of_history = bool(result.combinations or scene.trains or is_followed(result))
    worst = sorted(lifted, key=lambda one: -one.opening)[:MOST_NAMED]
    for one in sorted(worst):
        support = scene.supports[one.support]
        gap = abs(support.gap or 0.0)
        name = fmt.support(scene, one.support)
        verb = "has no contact: opening" if gap else "lifts off by"
        about = [f"gap {short(scene, 'gap', gap)}"] if gap else []
        about += [source for source in [source_in_words(one, scene) if of_history else ""] if source]
        words = f" ({', '.join(about)})" if about else ""
        lines.append(f"{name[0].upper()}{name[1:]} (x = {fmt.number(x[one.support], fmt.DIGITS)}) {verb} "
                     f"{short(scene, 'opening', one.opening)}{words}.")  # fmt: skip
    if len(lifted) > len(worst):
        lines.append(f"{len(lifted) - len(worst):,} more have no contact, all with smaller openings.")
    left = one_sided - len(lifted)
    if left:
        lines.append(f"The other {left:,} one-sided supports stay in contact." if left > 1
                     else "The other one-sided support stays in contact.")  # fmt: skip
    return lines


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
    if not spans and all(zone.state == "bilateral" for zone in zones):
        return []

    def words(value: float, quantity: str = "length") -> str:
        return short(scene, quantity, float(fmt.number(value, 4)))

    lines = []
    if zones:
        of = words(sum(to - from_ for from_, to in (fmt.stretch(scene, item) for item in scene.foundation)))
        together = fmt.number(sum(zone.to - zone.from_ for zone in zones), 4)
        lines.append(f"Contact with the ground in {fmt.count(len(zones), 'zone')} over {together} of {of}.")
    touching = [zone.from_ for zone in step.contact if zone.state == TOUCHING]
    if touching:
        where = f"at x = {fmt.number(touching[0], 4)}" if len(touching) == 1 else f"at {len(touching)} places"
        lines.append(f"{'It touches' if zones else 'It only touches'} the ground {where}.")
    if not lines:
        lines.append("No contact with the ground.")
    if spans:
        longest = words(max(span.to - span.from_ for span in spans))
        up_to = "up to " if len(spans) > 1 else ""
        sag = words(max(span.sag for span in spans), "sag")
        lines.append(f"{fmt.count(len(spans), 'free span')}, {up_to}{longest} long, sag {sag}.")
    return lines


def _place(scene: Scene, one: Extreme | Utilisation) -> str:
    return f"x = {fmt.number(one.x, fmt.DIGITS)}" if one.support is None else fmt.support(scene, one.support)


def _one(result: Result, name: str, one: Extreme, factor: bool) -> str:
    scene = result.scene
    source = source_in_words(one, scene, factor)
    return f"{short(scene, name, one.value)} at {_place(scene, one)}{f' ({source})' if source else ''}"


def values_in_words(result: Result, envelope: Envelope | TrainEnvelope) -> list[str]:
    """Say the largest reaction, and the largest and smallest moment, shear and deflection, each with its place and source.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.
    envelope : Envelope or TrainEnvelope
        Its `Result.envelope`.

    Returns
    -------
    list of str
        A line for each.
    """
    last = result.steps[-1].factor if result.steps else None
    lines = []
    def said(one: Extreme) -> bool:
        return one.factor not in (None, last)

    sizes = np.array([np.abs(envelope.supports.values("reaction", kind)) for kind in KINDS])
    if np.isfinite(sizes).any():
        k, i = np.unravel_index(np.nanargmax(sizes.T), sizes.T.shape)  # the first support that has it
        largest = envelope.supports[int(k)]["reaction"][KINDS[i]]
        lines.append(f"Largest reaction    {_one(result, 'reaction', largest, said(largest))}")
    for name in ("moment", "shear", "deflection"):
        both = [envelope.extremes[name][kind] for kind in KINDS]
        both = [one for one in both if one is not None]
        largest = max((abs(one.value) for one in both), default=0.0)
        both = [one for one in both if abs(one.value) > NONE * largest] or both[:1]
        texts = [_one(result, name, one, said(one)) for one in both]
        apart = "; " if sum(map(len, texts)) <= WIDTH else f"\n{'':<20}"
        lines.append(f"{f'Largest {name}':<20}{apart.join(texts)}")
    return lines


def limits_in_words(result: Result, used: dict[str, Utilisation]) -> list[str]:
    """Say how far the limits of the scene are used.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.
    used : dict of Utilisation
        By `find_utilisations`.

    Returns
    -------
    list of str
        A line for each limit; none where the scene has none.
    """
    scene, lines = result.scene, []
    for name, one in used.items():
        quantity = "stress" if name == "pressure" else name
        value, limit = (short(scene, quantity, abs(number)) for number in (one.value, one.limit))
        mark = "EXCEEDED" if one.ratio > 1.0 else "within"
        lines.append(f"{f'Limit of {name}':<20}{one.ratio:.0%} used, {mark}: {value} of {limit} at {_place(scene, one)}")
    return lines


def headline(result: Result) -> str:
    """Give the first line: the title, and that the beam is free to move where it is.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.

    Returns
    -------
    str
    """
    title = fmt.title(result.scene)
    return f"{title}: {MOVING}" if result._is_neutral else title


def outcome_in_words(result: Result) -> list[str]:
    """Say whether the beam stands; nothing where all is well.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.

    Returns
    -------
    list of str
    """
    lines = []
    if result.combinations:
        number = result.statuses.count("solved")
        lines.append(f"{number:,} of {fmt.count(len(result.names), 'combination')} solved.")
    elif result.status != "solved":
        title = "No equilibrium" if result.status == "no-equilibrium" else result.status.replace("-", " ").capitalize()
        lines.append(f"{title}. {fmt.sentence(visible(result.reason))}")
    return lines


def answer(result: Result) -> list[str]:
    """Give the answer in a few lines.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.

    Returns
    -------
    list of str
        Outcome, contact, largest values.
    """
    lines = outcome_in_words(result)
    if not result.has_envelope or (result.combinations and "solved" not in result.statuses):
        return lines
    if not has_cheap_envelope(result):
        return [*lines, f"{NOT_FOLLOWED[0].upper()}{NOT_FOLLOWED[1:]}."]
    envelope = result.envelope()
    if not envelope.extremes:
        return lines
    lines += contact_in_words(result, lifted_supports(result, envelope))
    one_sided = any(item.side != "both" for item in result.scene.foundation)
    if one_sided and result.steps and result.stands and not result.scene.trains:
        lines += ground_in_words(result)
    lines += values_in_words(result, envelope)
    lines += limits_in_words(result, find_utilisations(result, envelope))
    return lines + doubts_of_scene(result, envelope)
