"""Extremes on the whole way of the load in the report: it may have been worse than at its end."""

from typing import TYPE_CHECKING

import numpy as np

from ..base.characters import visible
from ..results import formatting as fmt
from ..results.answer import has_cheap_envelope
from ..results.envelopes.envelope import AT_SUPPORTS
from ..results.envelopes.hints import CLOSE
from ..results.envelopes.over_path import is_followed
from .writer import Writer

if TYPE_CHECKING:
    from ..results.envelopes.over_path import PathEnvelope
    from ..results.result import Result
    from ..results.views.extreme import Source

MOST_ROWS = 20
"""Values at supports that are listed."""
MOST_MISSING = 5
"""States that could not be solved that are named."""
PLACES = (("max", "largest"), ("min", "smallest"))
OVER = {
    "path": "Exact: of every load factor that was passed, on both sides of jumps.",
    "states": "Values are curved between the events here: of the events and 23 states between each two.",
    "steps": 'Of the load steps only; follow = "events" has those between as well.',
}


def write_over_path(say: Writer, result: "Result") -> None:
    """Print the largest and smallest values over the whole way of the load.

    Parameters
    ----------
    say : Writer
        Where to write.
    result : Result
        What `gapbeam.solve` returned.
    """
    if not is_followed(result):
        return
    scene = result.scene
    say.heading("Largest values over the whole way of the load")
    if not has_cheap_envelope(result):
        say.line("Not looked for: the path has so many states that this takes long; --json has them, and "
                 "result.history_extremes in Python.")  # fmt: skip
        return
    found = result.path_envelope()
    legs = len(scene.analysis.history) > 1
    headings = ["", "", "value", fmt.with_unit(scene, "x", "at x"), *_headings(result, legs)]
    rows = []
    for quantity, row in found.extremes.items():
        for kind, words in PLACES:
            one, name = row[kind], fmt.shown_heading(scene, quantity) if kind == "max" else ""
            value, x = fmt.shown(scene, quantity, one.value), fmt.number(one.x, fmt.DIGITS)
            rows.append([name, words, value, x, *_where(one.source, legs)])
    say.table(headings, rows, left=(0, 1))
    beyond = _beyond(found)
    if beyond:
        names = fmt.numbered(scene.supports)
        rows, before = [], None
        for k, what, kind in beyond:
            one = found.supports[k][what][kind]
            name, before = "" if k == before else names[k], k
            rows.append([name, f"{dict(PLACES)[kind]} {what}", fmt.shown(scene, what, one.value), *_where(one.source, legs)])
        say.line()
        say.table(["support", "", "value", *_headings(result, legs)], rows, left=(0, 1), longest=MOST_ROWS)
        say.line("All other supports have their largest and smallest values where the way begins or ends.", "dim")
    say.line(OVER[found.over], "dim")
    if found.missing:
        factors = ", ".join(fmt.number(source.factor, 5) for source, _ in found.missing[:MOST_MISSING])
        more = f" and {len(found.missing) - MOST_MISSING} more" if len(found.missing) > MOST_MISSING else ""
        why = visible(found.missing[0][1])
        say.line(f"Not counted, since they could not be solved: load factor {factors}{more} ({why}).", "red")


def _beyond(found: "PathEnvelope") -> list[tuple[int, str, str]]:
    """Choose what has been larger or smaller at a support on the way than where any way begins or ends: support, quantity, kind."""
    names = [source.combination for source in found.sources]
    ends = [k for k, name in enumerate(names) if k in (0, len(names) - 1) or name != names[k - 1] or name != names[k + 1]]
    chosen = []
    for what in ("reaction", "opening"):
        values = found.at_supports[:, AT_SUPPORTS.index(what)]
        near = CLOSE * np.abs(values).max(initial=0.0)
        for kind, best in (("max", np.max), ("min", np.min)):
            more = np.abs(best(values, axis=0) - best(values[ends], axis=0)) > near
            chosen += [(k, what, kind) for k in np.flatnonzero(more).tolist()]
    return sorted(chosen, key=lambda one: one[0])


def _headings(result: "Result", legs: bool) -> list[str]:
    return ["load factor", *["leg"] * legs, *["combination"] * bool(result.combinations)]


def _where(source: "Source", legs: bool) -> list[str]:
    """Say where an extreme comes from."""
    names = [] if source.combination is None else [visible(source.combination)]
    return [fmt.number(source.factor, 10), *[str(source.leg)] * legs, *names]
