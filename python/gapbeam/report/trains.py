"""Trains in the report: what governs, then what happens to the supports on the way."""

from typing import TYPE_CHECKING

from ..base.characters import visible
from ..results import formatting as fmt
from ..results.trains.data import passing_trains
from ..scene.trains import LEFT
from .scheme import changed_item, words_of_event
from .writer import Writer

if TYPE_CHECKING:
    from ..results.result import Result
    from ..results.trains.envelope import TrainEnvelope
    from ..results.trains.members import TrainExtreme

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
    _foundations(say, result, envelope)
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
    for quantity, row in fmt.reported(envelope.extremes).items():
        for kind, words in PLACES:
            one = row[kind]
            if one is not None:
                name = fmt.shown_heading(scene, quantity) if kind == "max" else ""
                value, x = fmt.shown(scene, quantity, one.value), fmt.number(one.x, fmt.DIGITS)
                rows.append([name, words, value, x, *_source(result, one)])
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
            rows.append(["", "opening", fmt.shown(scene, "opening", opening.value), *_source(result, opening)])
    say.heading("Supports while trains pass")
    say.table(["", "", fmt.stacked(scene, "reaction"), *_headings(result)], rows, (0, 1, 3, 4))
    length, _ = fmt.shown_unit(scene, "opening")
    say.line("Reactions upward positive; openings" + (f" in {length}" if length else "") + " where there are any.", "dim")


def _foundations(say: Writer, result: "Result", envelope: "TrainEnvelope") -> None:
    """What the foundations carry at most and at least, and where the beam hangs free."""
    scene = result.scene
    if not scene.foundation:
        return
    rows, spans = [], []
    for name, row in zip(fmt.numbered(scene.foundation), envelope.foundations, strict=True):
        for kind, words in PLACES:
            one = row["resultant"][kind]
            if one is not None:
                rows.append([name if kind == "max" else "", words, fmt.number(one.value), *_source(result, one)])
        for kind, one in row["free_span"].items():
            if one is not None:
                ends = one.span.from_, one.span.to, one.span.to - one.span.from_, one.span.sag
                numbers = [fmt.number(value, 4) for value in ends]
                spans.append([name if kind == "longest" else "", kind, *numbers, *_source(result, one)])
    say.heading("Foundations while trains pass")
    say.table(["", "", fmt.stacked(scene, "resultant"), *_headings(result)], rows, (0, 1, 3, 4))
    say.line("Resultants upward positive." + ("" if spans else " The beam hangs free nowhere."), "dim")
    if spans:
        say.heading("Free spans while trains pass")
        quantities = (("x", "from"), ("x", "to"), ("length", "length"), ("sag", "sag"))
        headings = [fmt.stacked(scene, quantity, words) for quantity, words in quantities]
        say.table(["", "", *headings, *_headings(result)], spans, (0, 1, 6, 7))
        say.line("Sag: largest distance between beam and ground.", "dim")


def _events(say: Writer, result: "Result") -> None:
    """Changes of what holds the beam."""
    scene = result.scene
    mixed, names = bool(scene.foundation), fmt.numbered(scene.supports)
    rows = [
        [*([visible(combination)] if combination is not None else []), visible(train.name), event.direction,
         fmt.number(event.position, 9), changed_item(scene, event, mixed) if mixed else names[event.support],
         fmt.number(event.x), words_of_event(event)]
        for combination, train in passing_trains(result)
        for event in train.events
    ]  # fmt: skip
    if not rows:
        return
    say.heading(f"{'Supports and zones of contact' if mixed else 'Supports'} that change on the way")
    first = ["combination"] if result.combinations else []
    n = len(first)
    places = [fmt.stacked(scene, "x", "position"), "at" if mixed else "support", fmt.stacked(scene, "x")]
    headings = [*first, "train", "goes", *places, "event"]
    say.table(headings, rows, (*range(n + 2), n + 3, n + 5), MOST_EVENTS)


def _gaps(say: Writer, envelope: "TrainEnvelope") -> None:
    """Positions that are not solved."""
    if not envelope.unstable_positions:
        return
    say.heading("Positions that are not solved, and not in what follows")
    for member, gap in envelope.unstable_positions[:MOST_GAPS]:
        where = f"{visible(member.combination)}, " if member.combination else ""
        reason = gap.reason if gap.status != "solved" else f"{gap.reason}, and they are in what follows"
        say.line(f"{where}{visible(member.train)}, {gap.from_:.6g} to {gap.to:.6g}: {reason}.", "red")
    if len(envelope.unstable_positions) > MOST_GAPS:
        say.line(f"... and {len(envelope.unstable_positions) - MOST_GAPS} more; --json has all.", "dim")
