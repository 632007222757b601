"""Extremes over the loading history in the report: it may have been worse than at its end."""

from typing import TYPE_CHECKING

import numpy as np

from ..base.characters import visible
from ..base.hints import few
from ..results import formatting as fmt
from ..results.answer import has_cheap_envelope
from ..results.envelopes.envelope import AT_SUPPORTS
from ..results.envelopes.hints import CLOSE
from ..results.envelopes.over_path import is_followed
from ..results.views.extreme import IN_WORDS
from ..scene.rotations import at_support
from .governing import rows_of_fields
from .writer import Writer

if TYPE_CHECKING:
    from ..results.envelopes.envelope import Source
    from ..results.envelopes.over_path import PathEnvelope
    from ..results.result import Result

MOST_ROWS = 20
"""Values at supports that are listed."""
MOST_MISSING = 5
"""States that could not be solved that are named."""
OVER = {
    "path": "Every load factor on the way counts, on both sides of jumps.",
    "states": "Values are curved between events here: 3 to 23 states between each two count.",
    "steps": 'Only the load steps count; follow = "events" has what is between.',
}
TITLE = "Largest values over the loading history"


def write_over_path(say: Writer, result: "Result", at: str = "") -> None:
    """Print the largest and smallest values over the loading history.

    Parameters
    ----------
    say : Writer
        Where to write.
    result : Result
        What `gapbeam.solve` returned.
    at : str
        The end of the load in words, where its values stand above.
    """
    if not is_followed(result):
        return
    scene = result.scene
    if not has_cheap_envelope(result):
        say.heading(TITLE)
        say.line("Not looked for: the path has so many states that this takes long; --json has them, and "
                 "result.history_extremes in Python.")  # fmt: skip
        return
    found = result.path_envelope()
    legs, beyond = len(scene.analysis.history) > 1, _beyond(found)
    rows = rows_of_fields(scene, found.extremes, lambda one: _where(one.source, legs))
    last = None if result.combinations else found.sources[-1]
    at_end = last is not None and all(one.source == last for row in found.extremes.values() for one in row.values())
    only_at_end = bool(at and at_end)
    if only_at_end and not beyond:
        say.line()
        say.line(f"Nothing is larger on the way there. {OVER[found.over]}", "dim")
        return
    say.heading(TITLE)
    headings = ["", "", "value", fmt.with_unit(scene, "x", "at x"), *_headings(result, legs)]
    if only_at_end:
        say.line(f"Along the beam the values {at} are the largest.")
    else:
        say.table(headings, rows, left=(0, 1))
    if beyond:
        names, before = fmt.numbered(scene.supports), None
        shown = _chosen(found, beyond)
        rows = []
        for k, what, kind in shown:
            one = found.supports[k][what][kind]
            name, before = "" if k == before else names[k], k
            unit = at_support(scene, what, k)
            rows.append([name, f"{IN_WORDS[kind]} {what}", fmt.shown(scene, unit, one.value), *_where(one.source, legs)])
        if not only_at_end:
            say.line()
        say.table(["support", "", "value", *_headings(result, legs)], rows, left=(0, 1))
        if len(shown) < len(beyond):
            say.line(f"{len(beyond) - len(shown):,} more such values are left out here; --json has all.", "italic")
        say.line("All other supports have theirs at the start or at the end.", "dim")
    say.line(OVER[found.over], "dim")
    if found.missing:
        factors = few([fmt.number(source.factor, 5) for source, _ in found.missing], MOST_MISSING)
        why = visible(found.missing[0][1])
        say.line(f"Not counted, since they could not be solved: load factor {factors} ({why}).", "red")


def _chosen(found: "PathEnvelope", beyond: list[tuple[int, str, str]]) -> list[tuple[int, str, str]]:
    """Choose values at supports: those of openings before all others, then the largest."""
    def rank(one: tuple[int, str, str]) -> tuple[bool, float]:
        k, what, kind = one
        return what != "opening" or kind != "max", -abs(found.supports[k][what][kind].value)

    return sorted(sorted(beyond, key=rank)[:MOST_ROWS], key=lambda one: one[0])


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
    return [fmt.number(source.factor, fmt.DIGITS), *[str(source.leg)] * legs, *names]
