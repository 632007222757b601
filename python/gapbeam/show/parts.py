"""Answers and reports of parts of a result: an envelope, one of its trains."""

from __future__ import annotations

from ..results import formatting as fmt
from ..results.answer import holds_values, values_in_words
from ..results.contact import contact_in_words
from ..results.envelopes.lifted import carrying_supports
from ..results.envelopes.verbs import PartVerbs
from ..results.trains.trains import TrainResult
from ..results.views.columns import Columns
from .notebook import SHOWN


def part_answer(part: PartVerbs) -> list[str]:
    """Give the answer of a part of a result in a few lines.

    Parameters
    ----------
    part : PartVerbs
        An envelope, or a train.

    Returns
    -------
    list of str
        What it is of and its outcome, contact, largest values.
    """
    result, ranges = part._result, part._ranges
    what = f"train {part.name}" if isinstance(part, TrainResult) else "largest and smallest values"
    lines = [f"{fmt.title(part.scene)}: {what}"]
    if part.reason is not None:
        lines.append(fmt.sentence(part.reason))
    if holds_values(ranges):
        lines += contact_in_words(result, part.lifted, carrying_supports(ranges)) + values_in_words(result, ranges)
    return lines


def part_report(part: PartVerbs) -> str:
    """Write the report of a part of a result: its answer, and its tables but that along the beam.

    Parameters
    ----------
    part : PartVerbs
        An envelope, or a train.
    """
    lines = part_answer(part)
    supports = part.table("supports")
    if supports.count:
        lines += ["", "Supports", repr(Columns({name: supports[name] for name in SHOWN if name in supports}))]
    if "events" in part._kinds and (events := part.table("events")).count:
        lines += ["", "Events", repr(events)]
    return "\n".join([*lines, ""])
