"""Answers in words: whether the beam stands, what has no contact and by how much, the largest values and where they come from.

The report begins with them, and a result shows them where it is displayed.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..base.characters import visible
from ..scene.ground_laws import any_falls
from ..scene.rotations import which_turn
from ..scene.structs import Scene
from . import formatting as fmt
from .contact import contact_in_words, ground_in_words, source_in_words
from .envelopes.full_load import envelope_of_one
from .envelopes.lifted import NONE, carrying_supports, lifted_supports
from .envelopes.over_path import count_states, is_followed
from .event_words import limits_of_load_in_words
from .plausibility import doubts_of_scene, doubts_of_signs
from .utilisation import Utilisation, find_utilisations
from .views.extreme import KINDS

if TYPE_CHECKING:
    from .envelopes.envelope import Envelope
    from .result import Result
    from .trains.envelope import TrainEnvelope
    from .views.extreme import Extreme

MOST_LIMITS = 5
"""Limits of the load, and supports that yield or break, that are named."""
MOST_WORK, ON_GROUND, ON_SLOPED = 2_000_000, 30, 300
"""States times pieces of the beam up to which values over the loading history are looked for unasked: some seconds; and for how
many pieces a stretch on the ground counts, and one in which its modulus changes."""
ALONG = {"axial_force": "Largest axial force", "axial_displacement": "Axial displacement"}
"""What is said of fields along the beam."""
WIDTH = 56
"""Characters of two values that stand in one line."""
ONE_OF_SEVERAL = ("Under this compression other stable states are not excluded. This one is reached as the axial forces grow "
                  "from 0, with all other loads in full.")  # fmt: skip
"""Of a state that is not proved to be the only one."""
ON_ITS_WAY = "Under this compression other stable states are not excluded. This is the one to which the train comes on its way."
"""The same under a train."""
TRAINS_STAY = "A train begins in such a state, and stays on its branch until the beam snaps to another one."
"""Of the trains of such a beam."""
ONE_ON_FALLING_GROUND = ("The force of the ground falls, so that other stable states are not excluded. This one is reached as the "
                         "loads grow, the dead loads first.")  # fmt: skip
"""The same where ground is why."""
NOT_FOLLOWED = "the path has so many states that its largest values are looked for on request only"


def has_cheap_envelope(result: Result) -> bool:
    """Whether largest values are found in some seconds, so that they are looked for unasked.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.
    """
    if not is_followed(result):
        return True
    ones = result.combinations.values() if result.combinations else [result]
    return sum(count_states(one) * _size_of(one) for one in ones if is_followed(one)) <= MOST_WORK


def _size_of(result: Result) -> int:
    """Pieces of the beam, or what its stretches on the ground count for, at the end of the path."""
    ground = result.steps[-1].solution.ground if result.scene.foundation and result.steps else None
    if ground is None:
        return len(result._beam.places.pieces)
    return int(np.where(ground.values[4] == ground.values[5], ON_GROUND, ON_SLOPED).sum())


def known_envelope(result: Result) -> Envelope | TrainEnvelope | None:
    """Give the largest values there are: of what is solved, else of what was passed before the load could not grow.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.

    Returns
    -------
    Envelope, TrainEnvelope or None
        None where no state stands.
    """
    if result.has_envelope:
        envelope = result.envelope() if not result.combinations or "solved" in result.statuses else None
        return envelope if holds_values(envelope) else None
    return result.path_envelope() if not result.combinations and result.steps and is_followed(result) else None


def holds_values(envelope: Envelope | TrainEnvelope | None) -> bool:
    """Tell whether there is any value in an envelope: there is none where a beam falls wherever its trains are.

    Parameters
    ----------
    envelope : Envelope, TrainEnvelope or None
        Of a result.
    """
    return envelope is not None and any(one is not None for row in envelope.extremes.values() for one in row.values())


def _place(scene: Scene, one: Extreme | Utilisation) -> str:
    return f"x = {fmt.number(one.x, fmt.DIGITS)}" if one.support is None else fmt.support(scene, one.support)


def _one(result: Result, name: str, one: Extreme, factor: bool) -> str:
    scene = result.scene
    source = source_in_words(one, scene, factor)
    value = fmt.value(scene, name, one.value)
    if name == "pressure" and scene.beam.width is not None:
        value = f"{fmt.value(scene, 'stress', one.value / scene.beam.width)} ({value})"
    return f"{value} at {_place(scene, one)}{f' ({source})' if source else ''}"


def _size(envelope: Envelope | TrainEnvelope, name: str) -> float:
    """Give the largest magnitude of a field; 0 where there is none."""
    return max((abs(one.value) for one in envelope.extremes[name].values() if one is not None), default=0.0)


def values_in_words(result: Result, envelope: Envelope | TrainEnvelope) -> list[str]:
    """Say the largest reaction, and the largest and smallest moment, shear and deflection, each with its place and source.

    Axial forces and displacements too, where there are any; where there is nothing else, they alone.

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
    if sizes.size:
        sizes[:, which_turn(result.scene.supports)] = np.nan  # couples
    along = [name for name in ALONG if name in envelope.extremes and _size(envelope, name) > 0.0]
    across = ["moment", "shear", "deflection", *(["pressure"] if "pressure" in envelope.extremes else [])]
    if along and not any(_size(envelope, name) > 0.0 for name in across):
        across = []
    if np.isfinite(sizes).any() and (across or np.nanmax(sizes) > 0.0):
        k, i = np.unravel_index(np.nanargmax(sizes.T), sizes.T.shape)  # the first support that has it
        largest = envelope.supports[int(k)]["reaction"][KINDS[i]]
        lines.append(f"Largest reaction    {_one(result, 'reaction', largest, said(largest))}")
    for name in (*across, *along):
        both = [one for one in (envelope.extremes[name][kind] for kind in KINDS) if one is not None]
        if not both:
            continue  # where the beam can move freely its deflections are not unique
        largest = _size(envelope, name)
        both = [one for one in both if abs(one.value) > NONE * largest] or both[:1]
        texts = [_one(result, name, one, said(one)) for one in both]
        apart = "; " if sum(map(len, texts)) <= WIDTH else f"\n{'':<20}"
        lines.append(f"{ALONG.get(name, f'Largest {name}'):<20}{apart.join(texts)}")
    return lines


def _limits_in_words(result: Result, used: dict[str, Utilisation]) -> list[str]:
    """Say how far the limits of the scene are used, a line for each."""
    scene, lines = result.scene, []
    for name, one in used.items():
        quantity = "stress" if name == "pressure" else name
        value, limit = (fmt.value(scene, quantity, abs(number)) for number in (one.value, one.limit))
        mark = "EXCEEDED" if one.ratio > 1.0 else "within"
        of = ", ".join(visible(str(one.source[key])) for key in ("combination", "train") if key in one.source)
        where = f"{_place(scene, one)}{f' ({of})' if of else ''}"
        lines.append(f"{f'Limit of {name}':<20}{one.ratio:.0%} used, {mark}: {value} of {limit} at {where}")
    return lines


def headline(result: Result) -> str:
    """Give the first line: the title, and that the beam is free to move where it is.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.
    """
    title = fmt.title(result.scene)
    return f"{title}: {result._neutral_words}" if result._neutral_words else title


def is_one_of_several(result: Result) -> bool:
    """Tell whether the last state is not known to be the only stable one.

    Parameters
    ----------
    result : Result
        Of one load or of combinations; of these False.
    """
    return bool(not result.combinations and result._beam.in_stretches and result.steps and not result.steps[-1].unique)


def _outcome_in_words(result: Result) -> list[str]:
    """Say whether the beam stands; nothing where all is well."""
    lines = []
    if result.combinations:
        number = result.statuses.count("solved")
        lines.append(f"{number:,} of {fmt.count(len(result.names), 'combination')} solved.")
    elif result.status != "solved" and not result.limits:
        title = "No equilibrium" if result.status == "no-equilibrium" else result.status.replace("-", " ").capitalize()
        said = fmt.sentence(visible(result.reason))
        lines.append(said if said.startswith(title) else f"{title}. {said}")
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
    lines, cheap = _outcome_in_words(result), has_cheap_envelope(result)
    envelope = known_envelope(result) if cheap else None
    if not result.combinations and not result.scene.trains:
        lines += limits_of_load_in_words(result, envelope if is_followed(result) else None, MOST_LIMITS)
    if not cheap:
        lines.append(f"{NOT_FOLLOWED[0].upper()}{NOT_FOLLOWED[1:]}.")
        if result.stands and not result.combinations:
            lines += ["At full load:", *values_in_words(result, envelope_of_one(result, 1))]
        return lines
    if envelope is None or not envelope.extremes:
        return lines + doubts_of_signs(result)
    if not result.has_envelope:
        lines.append("Up to there:")
    lines += contact_in_words(result, lifted_supports(result, envelope), carrying_supports(envelope))
    one_sided = any(item.side != "both" for item in result.scene.foundation)
    if one_sided and result.steps and result.stands and not result.scene.trains:
        lines += ground_in_words(result)
    lines += values_in_words(result, envelope)
    lines += _limits_in_words(result, find_utilisations(result, envelope))
    if result.stands and is_one_of_several(result):
        falling = any_falls(result.scene.foundation)
        lines.append(ONE_ON_FALLING_GROUND if falling else ON_ITS_WAY if result._beam.begins_on_way else ONE_OF_SEVERAL)
        if result.scene.trains and not falling:
            lines.append(TRAINS_STAY)
    return lines + doubts_of_scene(result, envelope)
