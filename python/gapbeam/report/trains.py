"""Trains in the report: what governs, then what happens to the supports on the way."""

from typing import TYPE_CHECKING

from ..base.characters import visible
from ..results import formatting as fmt
from ..results.train_data import passing_trains
from ..scene.trains import LEFT
from .writer import Writer

if TYPE_CHECKING:
    from ..results.result import Result
    from ..results.train_envelope import TrainEnvelope, TrainExtreme

MOST_EVENTS = 24
"""Events that are listed; of more some in the middle are left out."""
MOST_GAPS = 10
"""Stretches of positions without equilibrium that are listed."""
PLACES = (("max", "largest"), ("min", "smallest"))


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
    envelope = result.envelope()
    _gaps(say, envelope)
    _fields(say, result, envelope)
    _supports(say, result, envelope)
    _events(say, result)


def _source(result: "Result", one: "TrainExtreme") -> list[str]:
    """Where an extreme comes from, cell by cell."""
    text = "no train"
    if one.train is not None:
        text = f"{visible(one.train)} at {fmt.number(one.position)}" + (" (left)" if one.direction == LEFT else "")
    text += f" +{len(one.ties)}" if one.ties else ""
    return [visible(one.combination or ""), text] if result.combinations else [text]


def _headings(result: "Result") -> list[str]:
    return [*(["combination"] if result.combinations else []), "train"]


def _fields(say: Writer, result: "Result", envelope: "TrainEnvelope") -> None:
    scene, rows = result.scene, []
    say.heading("What governs while trains pass, all other loads in full")
    for quantity, row in envelope.extremes.items():
        for kind, words in PLACES:
            one = row[kind]
            if one is not None:
                name = fmt.with_unit(scene, quantity) if kind == "max" else ""
                rows.append([name, words, fmt.number(one.value), fmt.number(one.x), *_source(result, one)])
    say.table(["", "", "value", fmt.with_unit(scene, "x", "at x"), *_headings(result)], rows, (0, 1, 4, 5))
    say.line("Trains go to the right but for those marked; their positions are those of the first axle; + as many more with the "
             "same value. Where a field jumps the larger side counts. Deflection downward, sagging moment, clockwise rotation: "
             "positive.", "dim")  # fmt: skip


def _supports(say: Writer, result: "Result", envelope: "TrainEnvelope") -> None:
    """Extremes of reactions, and of openings where there are any."""
    scene = result.scene
    if not scene.supports:
        return
    rows = []
    for name, row in zip(fmt.numbered(scene.supports), envelope.supports, strict=True):
        for kind, words in PLACES:
            one = row["reaction"][kind]
            if one is not None:
                rows.append([name if kind == "max" else "", words, fmt.number(one.value), *_source(result, one)])
        opening = row["opening"]["max"]
        if opening is not None and opening.value > 0.0:
            rows.append(["", "opening", fmt.number(opening.value), *_source(result, opening)])
    say.heading("Supports while trains pass")
    say.table(["", "", fmt.stacked(scene, "reaction"), *_headings(result)], rows, (0, 1, 3, 4))
    length = fmt.unit(scene, "length")
    say.line("Reactions upward positive; openings" + (f" in {length}" if length else "") + " where there are any.", "dim")


def _events(say: Writer, result: "Result") -> None:
    """Changes of the working scheme."""
    scene = result.scene
    names = fmt.numbered(scene.supports)
    rows = [
        [*([visible(combination)] if combination is not None else []), visible(train.name), event.direction,
         fmt.number(event.position, 9), names[event.support], fmt.number(event.x), event.event]
        for combination, train in passing_trains(result)
        for event in train.events
    ]  # fmt: skip
    if not rows:
        return
    say.heading("Supports that change on the way")
    first = ["combination"] if result.combinations else []
    n = len(first)
    headings = [*first, "train", "goes", fmt.stacked(scene, "x", "position"), "support", fmt.stacked(scene, "x"), "event"]
    say.table(headings, rows, (*range(n + 2), n + 3, n + 5), MOST_EVENTS)


def _gaps(say: Writer, envelope: "TrainEnvelope") -> None:
    """Positions that are not solved."""
    if not envelope.gaps:
        return
    say.heading("Positions that are not solved, and not in what follows")
    for member, gap in envelope.gaps[:MOST_GAPS]:
        where = f"{visible(member.combination)}, " if member.combination else ""
        say.line(f"{where}{visible(member.train)}, {gap.from_:.6g} to {gap.to:.6g}: {gap.reason}.", "red")
    if len(envelope.gaps) > MOST_GAPS:
        say.line(f"... and {len(envelope.gaps) - MOST_GAPS} more; --json has all.", "dim")
