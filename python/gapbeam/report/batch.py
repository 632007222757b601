"""Summaries of batches as text."""

import io
from typing import TYPE_CHECKING

from ..results import formatting as fmt
from .writer import Writer

if TYPE_CHECKING:
    from rich.console import Console

    from ..batches.summary import Summary


def print_summary(summary: "Summary", console: "Console | None" = None) -> None:
    """Print how the results of a batch are distributed.

    Parameters
    ----------
    summary : Summary
        From `Batch.summary`.
    console : rich.console.Console, optional
        Where to print; default standard output.
    """
    from rich.console import Console

    say = Writer(console or Console(highlight=False))
    say.line(f"{summary.done:,} of {summary.cases:,} cases", "bold")
    say.pairs([(status, f"{count:,}" + _first(summary, status)) for status, count in summary.statuses.items()])
    columns = {name: one for name, one in summary.columns.items() if one.count}
    if not columns:
        return
    say.heading("Results of the cases that are solved")
    shares = list(next(iter(columns.values())).quantiles)
    rows = [
        [name, *(fmt.number(value, 4) for value in (one.mean, one.least, *one.quantiles.values(), one.largest))]
        for name, one in columns.items()
    ]
    say.table_by_name(["", "mean", "least", *(f"{100 * share:g} %" for share in shares), "largest"], rows)
    say.line("50 %: half of the cases give no more than this. Values are in the units of the scene.")
    above = [
        [name, fmt.number(limit), f"{count:,}", f"{count / one.count:.6g}"]
        for name, one in columns.items()
        for limit, count in one.above.items()
    ]
    if above:
        say.heading("Cases above a limit")
        say.table_by_name(["", "limit", "cases", "share"], above)


def summary_text(summary: "Summary") -> str:
    """Write the summary to a string without colours.

    Parameters
    ----------
    summary : Summary
        From `Batch.summary`.
    """
    from rich.console import Console

    stream = io.StringIO()
    print_summary(summary, Console(file=stream, width=80, highlight=False, color_system=None))
    return stream.getvalue()


def _first(summary: "Summary", status: str) -> str:
    """The reason of the first case that ended like this."""
    return f"; the first one: {summary.reasons[status]}" if status in summary.reasons else ""
