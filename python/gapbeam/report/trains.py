"""Trains in the report: what governs, then what happens to the supports on the way."""

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from ..base.characters import visible
from ..results import formatting as fmt
from ..results.cases.limit_states import envelopes_to_tell
from ..results.contact import position_in_words
from ..results.event_words import event_in_words
from ..results.trains.data import passing_trains
from ..results.views.extreme import IN_WORDS
from ..scene.rotations import at_support
from ..scene.trains import LEFT
from .governing import rows_of_fields, write_governing_ground
from .signs import names_with_units, positive_fields, positive_reactions
from .writer import Writer, chosen

if TYPE_CHECKING:
    from ..results.result import Result
    from ..results.trains.envelope import TrainEnvelope
    from ..results.trains.members import TrainExtreme

MOST_EVENTS = 24
"""Events that are listed; of more some in the middle are left out."""
MOST_SUPPORTS = 24
"""Supports that are listed; of more those without contact and both ends."""
MOST_GAPS = 10
"""Stretches of positions without equilibrium that are listed."""


def write_trains(say: Writer, result: "Result") -> None:
    """Write what trains make of a beam.

    Parameters
    ----------
    say : Writer
        Where to write.
    result : Result
        Of a scene with trains or without, with combinations or without.
    """
    if not result.scene.trains:
        return
    _gaps(say, result.envelope())
    for name, envelope in envelopes_to_tell(result):
        of = "" if name is None else f", {visible(name)}"
        _fields(say, result, envelope, of)
        _supports(say, result, envelope, of)
        when, source = f" while trains pass{of}", partial(_source, result)
        write_governing_ground(say, result.scene, envelope.foundations, when, _headings(result), source)
    _events(say, result)


def _source(result: "Result", one: "TrainExtreme") -> list[str]:
    """Where an extreme comes from, cell by cell."""
    text = "no train"
    if one.train is not None:
        at = position_in_words(result.scene, one.position)
        text = f"{visible(one.train)} at {at}" + (" going left" if one.direction == LEFT else "")
    text += f" or {fmt.count(len(one.ties), 'other')}" if one.ties else ""
    return [visible(one.combination or ""), text] if result.combinations else [text]


def _headings(result: "Result") -> list[str]:
    return [*(["combination"] if result.combinations else []), "train"]


def _fields(say: Writer, result: "Result", envelope: "TrainEnvelope", of: str) -> None:
    scene = result.scene
    say.heading(f"What governs while trains pass, all other loads in full{of}")
    rows = rows_of_fields(scene, envelope.extremes, partial(_source, result))
    say.table(["", "", "value", fmt.with_unit(scene, "x", "at x"), *_headings(result)], rows, (0, 1, 4, 5))
    say.line("Positions are those of the first axle. Others: positions or trains with the same value. Where a field jumps the "
             f"larger side counts. {positive_fields(scene)}", "dim")  # fmt: skip


def _supports(say: Writer, result: "Result", envelope: "TrainEnvelope", of: str) -> None:
    """Extremes of reactions, and of openings where there are any."""
    scene = result.scene
    if not scene.supports:
        return
    rows, names = [], names_with_units(scene)
    lifted = np.flatnonzero(envelope.supports.values("opening", "max") > 0.0).tolist()
    which = chosen(len(names), sorted(lifted, key=lambda k: -envelope.supports[k]["opening"]["max"].value), MOST_SUPPORTS)
    values = {kind: fmt.without_noise(envelope.supports.values("reaction", kind)) for kind in IN_WORDS}
    for k in which:
        if k is None:
            rows.append(["..."] * (3 + len(_headings(result))))
            continue
        name, row = names[k], envelope.supports[k]
        for kind, words in IN_WORDS.items():
            one = row["reaction"][kind]
            if one is not None:
                rows.append([name if kind == "max" else "", words, fmt.number(values[kind][k], fmt.DIGITS), *_source(result, one)])
        opening = row["opening"]["max"]
        if opening is not None and opening.value > 0.0:
            far = fmt.shown(scene, at_support(scene, "opening", k), opening.value)
            rows.append(["", "opening", far, *_source(result, opening)])
    say.heading(f"Supports while trains pass{of}")
    say.table(["", "", fmt.stacked(scene, "reaction"), *_headings(result)], rows, (0, 1, 3, 4), len(rows))
    say.supports_left_out(which, len(names), lifted, "stay")
    length, _ = fmt.shown_unit(scene, "opening")
    unit = f" in {length}" if length else ""
    say.line(f"Reactions {positive_reactions(scene)} positive; openings{unit} where there are any.", "dim")


def _events(say: Writer, result: "Result") -> None:
    """Changes of what holds the beam."""
    scene = result.scene
    rows = [
        [*([visible(combination)] if combination is not None else []), visible(train.name), event.direction,
         position_in_words(scene, event.position), event_in_words(scene, event)]
        for combination, train in passing_trains(result)
        for event in train.events
    ]  # fmt: skip
    if not rows:
        return
    say.heading(f"What changes {'at supports and on the ground' if scene.foundation else 'at supports'} on the way")
    first = ["combination"] if result.combinations else []
    n = len(first)
    headings = [*first, "train", "goes", fmt.stacked(scene, "x", "position"), "what happens"]
    say.table(headings, rows, (*range(n + 2), n + 3), MOST_EVENTS)


def _gaps(say: Writer, envelope: "TrainEnvelope") -> None:
    """Positions that are not solved."""
    if not envelope.unstable_positions:
        return
    say.heading("Positions that are not solved, and not in what follows")
    for member, gap in envelope.unstable_positions[:MOST_GAPS]:
        where = f"{visible(member.combination)}, " if member.combination else ""
        reason = gap.reason if gap.status != "solved" else f"{gap.reason}, and they are in what follows"
        say.line(f"{where}{visible(member.train)}, {gap.from_:.5g} to {gap.to:.5g}: {reason}.", "red")
    if len(envelope.unstable_positions) > MOST_GAPS:
        say.line(f"... and {len(envelope.unstable_positions) - MOST_GAPS} more; --json has all.", "dim")
