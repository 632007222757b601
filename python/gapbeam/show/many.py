"""Answers of what is no whole result: an envelope, one of its trains, many cases, a batch."""

from __future__ import annotations

from collections import Counter
from typing import Any

import numpy as np

from ..base.characters import visible
from ..base.errors import Status
from ..batches.batch import Batch
from ..batches.summary import Summary, distribution
from ..results import formatting as fmt
from ..results.answer import holds_values, values_in_words
from ..results.cases.solved_cases import Cases
from ..results.contact import contact_in_words
from ..results.envelopes.lifted import Lifted, carrying_supports
from ..results.envelopes.verbs import PartVerbs
from ..results.trains.trains import TrainResult
from ..results.views.columns import Columns
from ..scene.rotations import at_support
from ..scene.structs import Scene
from .notebook import SHOWN

MOST_NAMED = 8
"""Supports without contact that are named."""
FIELDS = ("moment", "shear", "deflection")
"""Fields of cases whose extremes are told and drawn."""


def cases_answer(cases: Cases) -> list[str]:
    """Give the answer of cases in a few lines.

    Parameters
    ----------
    cases : Cases
        With an axis of cases.

    Returns
    -------
    list of str
        How many are solved, what has no contact in which part of them, the largest values with their cases.
    """
    scene, count, solved = cases.scene, len(cases), int(np.sum(cases.ok))
    lines = [f"{fmt.title(scene)}: {solved:,} of {fmt.count(count, 'case')} solved"]
    if (reason := cases.reason) is not None:
        lines.append(fmt.sentence(visible(reason)))
    if not solved:
        return lines
    lines += _lifted_in_words(scene, cases.lifted)
    for name in FIELDS:
        texts = []
        for one, best in zip(cases.extremes[name].values(), (np.nanargmax, np.nanargmin), strict=True):
            k = int(best(one.value))
            place = fmt.number(float(one.x[k]), fmt.DIGITS)
            texts.append(f"{fmt.value(scene, name, float(one.value[k]))} at x = {place} (case {k})")
        lines.append(f"{f'Largest {name}':<20}{'; '.join(texts)}")
    return lines


def _lifted_in_words(scene: Scene, lifted: list[Lifted]) -> list[str]:
    """Say which supports have no contact in which part of the cases; nothing where no support is one-sided."""
    if not any(support.side != "both" for support in scene.supports):
        return []
    if not lifted:
        return ["No support lifts off in any case."]
    lines = []
    for one in sorted(sorted(lifted, key=lambda one: -one.share)[:MOST_NAMED]):
        name, far = fmt.support(scene, one.support), fmt.value(scene, at_support(scene, "opening", one.support), one.opening)
        lines.append(f"{name[0].upper()}{name[1:]} has no contact in {100 * one.share:.3g} % of the cases, "
                     f"opening up to {far} (case {one.case}).")  # fmt: skip
    if len(lifted) > MOST_NAMED:
        lines.append(f"{len(lifted) - MOST_NAMED:,} more have no contact in fewer cases.")
    return lines


def batch_answer(batch: Batch | Summary) -> list[str]:
    """Give the answer of a batch in a few lines.

    Parameters
    ----------
    batch : Batch or Summary

    Returns
    -------
    list of str
        How many cases are done and how they ended; of a summary the quantiles of its first results.
    """
    where = f" in {batch.path}" if isinstance(batch, Batch) else ""
    outcomes = ", ".join(f"{count:,} {outcome}" for outcome, count in batch._outcomes.items())
    lines = [f"Batch{where}: {batch.done:,} of {fmt.count(batch.cases, 'case')} done"]
    lines += [f"Outcomes: {outcomes}."] if outcomes else []
    if (reason := batch.reason) is not None:
        lines.append(fmt.sentence(visible(reason)))
    if isinstance(batch, Summary):
        there = [(name, one) for name, one in batch.columns.items() if one.count]
        for name, one in there[:MOST_NAMED]:
            shares = ", ".join(f"{fmt.number(value, 4)} ({100 * share:g} %)" for share, value in one.quantiles.items())
            lines.append(f"{name:<20}{shares}")
        lines += [f"... {len(there) - MOST_NAMED:,} more results"] if len(there) > MOST_NAMED else []
    else:
        lines.append(f"Results: {', '.join(batch.results[:MOST_NAMED])}" + (" ..." if len(batch.results) > MOST_NAMED else ""))
    return lines


def cases_summary(cases: Cases) -> Summary:
    """Tell how reactions and extremes of cases are distributed.

    Parameters
    ----------
    cases : Cases
        With an axis of cases.
    """
    table: dict[str, Any] = {
        f"{name}.{kind}": one.value for name in FIELDS for kind, one in cases.extremes[name].items()
    }
    table |= {f"reaction.{key}": values for key, values in cases.reactions.items()}
    statuses = {Status(one).word: count for one, count in Counter(cases.status.tolist()).items()}
    first = next((word for word in statuses if word != "solved"), None)
    reasons = {} if first is None else {first: cases.reason}
    columns = {name: distribution(np.asarray(values, dtype=float)) for name, values in table.items()}
    units = {name: fmt.shown_unit(cases.scene, name.partition(".")[0]) for name in columns}
    return Summary(len(cases), len(cases), statuses, reasons, columns, units)


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
