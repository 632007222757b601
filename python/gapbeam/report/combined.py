"""The report on combinations: it begins with what governs."""

from typing import TYPE_CHECKING

import numpy as np

from ..base.characters import visible
from ..results import formatting as fmt
from ..results.answer import short
from ..results.envelopes.envelope import AT_SUPPORTS
from ..results.envelopes.hints import beyond
from ..scene.names import labels
from .over_path import write_over_path
from .trains import write_trains
from .writer import Writer, cut

if TYPE_CHECKING:
    from ..results.cases.combined import CombinedResult
    from ..results.envelopes.envelope import Extreme
    from ..results.envelopes.ground_envelope import GroundExtreme

MOST_FOLLOWED = 100
"""Combinations that are followed from event to event for the report, to find factors between that govern."""
MOST_TIES = 2
"""Further combinations with the same value that are named."""
MOST_ROWS = 24
"""Combinations whose reactions are listed."""
PLACES = (("max", "largest"), ("min", "smallest"))


def write_combined(say: Writer, result: "CombinedResult") -> None:
    """Print what a person wants to know of combinations.

    Parameters
    ----------
    say : Writer
        Where to write.
    result : CombinedResult
        What `gapbeam.solve` returned.
    """
    scene = result.scene
    _fallen(say, result)
    if result.has_envelope and scene.trains:
        write_trains(say, result)
    elif "solved" in result.statuses:
        _reactions(say, result)
        _fields(say, result)
        _supports(say, result)
        _foundations(say, result)
        _factors_between(say, result)
    write_over_path(say, result)
    _list(say, result)
    say.line()
    say.line(f"Solved with {fmt.count(result.solves, 'linear solve')}, {fmt.duration(result.seconds)}.", "dim")


def _fallen(say: Writer, result: "CombinedResult") -> None:
    """Say which combinations are not solved, and why."""
    # Of trains the positions are listed that are not solved, and no more is left out
    fallen = [k for k, status in enumerate(result.statuses) if status != "solved" and not result.combinations[k].has_envelope]
    if not fallen:
        return
    say.heading("Not solved")
    for k in fallen[:10]:
        say.line(f"{visible(result.names[k])}: {result.combinations[k].reason}.", "red")
    if len(fallen) > 10:
        say.line(f"... and {len(fallen) - 10} more; --json has all.", "dim")
    if len(fallen) < len(result.names):
        say.line("They are left out of what follows.")


def _source(extreme: "Extreme | GroundExtreme") -> str:
    """Name the combinations that an extreme comes from."""
    names = [visible(source.combination or "") for source in extreme.ties]
    more = len(names) - 1 - MOST_TIES
    return ", ".join(names[: 1 + MOST_TIES]) + (f" and {more} more" if more > 0 else "")


def _when(result: "CombinedResult") -> str:
    """Say which state of every combination counts."""
    return "at full load" if result.scene.analysis.history[-1] == 1.0 else "at the end of the history"


def _reactions(say: Writer, result: "CombinedResult") -> None:
    """Tabulate reactions by combination, with what has lifted off."""
    scene = result.scene
    if not scene.supports:
        return
    envelope, up = result.envelope(), "^" if say.plain else "\u2191"
    reaction, opening = (envelope.at_supports[:, AT_SUPPORTS.index(name)] for name in ("reaction", "opening"))
    rows = []
    for k in cut(range(len(envelope.sources)), MOST_ROWS)[0]:
        texts = [
            f"0 {up}{short(scene, 'opening', gone).split()[0]}" if gone > 0.0 else fmt.number(force, fmt.DIGITS)
            for force, gone in zip(reaction[k].tolist(), opening[k].tolist(), strict=True)
        ]
        rows.append([visible(envelope.sources[k].combination or ""), *texts])
    for words, best in (("largest", np.nanmax), ("smallest", np.nanmin)):
        rows.append([words, *(fmt.number(value, fmt.DIGITS) for value in best(reaction, axis=0).tolist())])
    unit = fmt.unit(scene, "reaction")
    say.heading("Reactions by combination" + (f" [{unit}]" if unit else ""))
    say.table_by_name(["", *labels(scene.supports)], rows)
    hidden = len(envelope.sources) - (len(rows) - 2)
    more = f" {hidden:,} combinations in the middle are left out here; --json has all." if hidden else ""
    length, _ = fmt.shown_unit(scene, "opening")
    lifted = f"; {up} lifted off, with its opening{f' in {length}' if length else ''}" if (opening > 0.0).any() else ""
    say.line(f"Upward positive{lifted}.{more}", "dim")


def _fields(say: Writer, result: "CombinedResult") -> None:
    scene, envelope = result.scene, result.envelope()
    say.heading(f"What governs, all combinations {_when(result)}")
    rows = []
    for quantity, row in fmt.reported(envelope.extremes).items():
        for kind, words in PLACES:
            one = row[kind]
            name = fmt.shown_heading(scene, quantity) if kind == "max" else ""
            value, x = fmt.shown(scene, quantity, one.value), fmt.number(one.x, fmt.DIGITS)
            rows.append([name, words, value, x, _source(one)])
    say.table(["", "", "value", fmt.with_unit(scene, "x", "at x"), "combination"], rows, left=(0, 1, 4))
    say.line("Deflection downward, sagging moment, clockwise rotation: positive. Combinations with equal values stand beside "
             "each other.", "dim")  # fmt: skip


def _supports(say: Writer, result: "CombinedResult") -> None:
    scene = result.scene
    if not scene.supports:
        return
    say.heading(f"Supports, all combinations {_when(result)}")
    one_sided = any(support.side != "both" for support in scene.supports)
    rows = []
    for name, row in zip(fmt.numbered(scene.supports), result.envelope().supports, strict=True):
        for kind, words in PLACES:
            one = row["reaction"][kind]
            texts = [name if kind == "max" else "", words, fmt.number(one.value, fmt.DIGITS), _source(one)]
            if one_sided:
                opening = row["opening"][kind]
                texts += [fmt.shown(scene, "opening", opening.value), _source(opening) if opening.value else ""]
            rows.append(texts)
    headings = ["", "", fmt.stacked(scene, "reaction"), "combination"]
    if one_sided:
        headings += [fmt.shown_column(scene, "opening", [])[0], "combination"]
    say.table(headings, rows, left=(0, 1, 3, 5))
    say.line("Reactions upward positive.", "dim")


def _foundations(say: Writer, result: "CombinedResult") -> None:
    """Tell what the foundations carry at most and at least, and where the beam hangs free."""
    scene = result.scene
    if not scene.foundation:
        return
    say.heading(f"Foundations, all combinations {_when(result)}")
    names, found = fmt.numbered(scene.foundation), result.envelope().foundations
    rows = []
    for name, row in zip(names, found, strict=True):
        for kind, words in PLACES:
            one = row["resultant"][kind]
            rows.append([name if kind == "max" else "", words, fmt.number(one.value, fmt.DIGITS), _source(one)])
    say.table(["", "", fmt.stacked(scene, "resultant"), "combination"], rows, left=(0, 1, 3))
    rows = []
    for name, row in zip(names, found, strict=True):
        for kind, one in row["free_span"].items():
            if one is not None:
                span = one.span
                numbers = [fmt.number(value, 4) for value in (span.from_, span.to, span.to - span.from_, span.sag)]
                rows.append([name if kind == "longest" else "", kind, *numbers, _source(one)])
    if not rows:
        say.line("Resultants upward positive. The beam hangs free nowhere.", "dim")
        return
    say.line("Resultants upward positive.", "dim")
    say.heading(f"Free spans, all combinations {_when(result)}")
    quantities = (("x", "from"), ("x", "to"), ("length", "length"), ("sag", "sag"))
    headings = [fmt.stacked(scene, quantity, words) for quantity, words in quantities]
    say.table(["", "", *headings, "combination"], rows, left=(0, 1, 6))
    say.line("Sag: largest distance between beam and ground.", "dim")


def _factors_between(say: Writer, result: "CombinedResult") -> None:
    """Say where a factor between governs."""
    say.heading("Factors between")
    if not result.is_linear_between_events:
        say.line("Not looked for: on foundations, with smooth laws and where the state depends on the way of the load, values are "
                 "not linear between events.")  # fmt: skip
        return
    if len(result.names) > MOST_FOLLOWED:
        say.line(f"Not looked for: more than {MOST_FOLLOWED} combinations; result.hints() in Python follows all of them.")
        return
    envelope, scene = result.envelope(), result.scene
    largest = {(name, None, kind): one.value for name, row in envelope.extremes.items() for kind, one in row.items()}
    for k, row in enumerate(envelope.supports):
        largest |= {(name, k, kind): one.value for name in ("reaction", "opening") for kind, one in row[name].items()}
    found = list(beyond(result.hints(), largest))
    if not found:
        say.line("Nothing is greater where all loads but the dead ones have only a part of their factors.")
        return
    names = labels(scene.supports)
    words = dict(PLACES)
    rows = [
        [
            hint.quantity if hint.support is None else f"{hint.quantity} of {names[hint.support]}", words[hint.kind],
            fmt.number(hint.value), fmt.number(hint.x), visible(hint.combination or ""), fmt.number(hint.factor, 5),
            fmt.number(largest[hint.quantity, hint.support, hint.kind]),
        ]
        for hint in found
    ]  # fmt: skip
    headings = ["", "", "value", fmt.with_unit(scene, "x", "at x"), "combination", "load factor", "at full load"]
    say.table(headings, rows, left=(0, 1, 4))
    say.line("With supports that open and close the full load need not be the worst: these values are greater where the loads "
             "(all but the dead ones) have that part of their factors.")  # fmt: skip


def _list(say: Writer, result: "CombinedResult") -> None:
    say.heading("Combinations")
    scene = result.scene
    given = [
        [
            visible(one.name),
            ", ".join(f"{fmt.number(factor, 4)} {visible(case)}" for case, factor in one.factors.items()) or "no load",
            "; ".join(_about(one)),
        ]
        for one in scene.combinations
    ]
    say.table(["name", "factors of cases", ""], given, left=(0, 1, 2))


def _about(combination: object) -> list[str]:
    """Say what else a combination asks for."""
    words = [f"{visible(str(key))} settles {fmt.number(value, 4)}" for key, value in combination.settlements.items()]
    if combination.scheme_of is not None:
        words.append(f"contact state of {visible(combination.scheme_of)}")
    words += [f"all patterns of {visible(case)} ({rule})" for case, rule in combination.expand.items()]
    return words
