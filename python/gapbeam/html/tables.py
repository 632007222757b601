"""Tables of a page: texts as a person reads them, each with the number by which it is sorted."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..base.characters import visible, with_minus_signs
from ..report.signs import positive_along, positive_fields, positive_reactions
from ..results import formatting as fmt
from ..results.contact import source_in_words
from ..results.data import modes_data
from ..results.event_words import state_in_words
from ..results.views.extreme import IN_WORDS
from ..scene.names import label, labels
from ..scene.rotations import turns

if TYPE_CHECKING:
    from ..results.envelopes.envelope import Envelope
    from ..results.result import Result
    from ..results.trains.envelope import TrainEnvelope
    from ..scene import Scene

MOST_ROWS = 200
"""Rows of a table; all are in the JSON output."""


class Cell(NamedTuple):
    """What stands in a cell, and the number by which it is sorted, if it is one."""

    text: str
    value: float | None = None


class TableData(NamedTuple):
    """A table of the page."""

    name: str
    title: str
    head: list[str]
    rows: list[list[Cell]]
    note: str = ""
    jumps: list[tuple[int, int]] | None = None


def tables_of(result: Result, envelope: Envelope | TrainEnvelope | None, ways: list[dict[str, Any]]) -> list[TableData]:
    """Make the tables.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.
    envelope : Envelope or TrainEnvelope or None
        Its `Result.envelope`, if there is one.
    ways : list of dict
        What the page moves; rows of events lead there.

    Returns
    -------
    list of TableData
        Those that have rows.
    """
    found = [_supports(result)]
    if envelope is not None and envelope.extremes:
        found.append(_extremes(result, envelope))
        if result.combinations or result.scene.trains or hasattr(envelope, "over"):
            found.append(_support_extremes(result, envelope))
    if result.combinations:
        found.append(_combinations(result))
    found += [_events(result, ways), _zones(result), _modes(result)]
    return [one._replace(rows=one.rows[:MOST_ROWS], note=_cut(one)) for one in found if one.rows]


def _cut(table: TableData) -> str:
    more = len(table.rows) - MOST_ROWS
    return f"{table.note} {more:,} more rows are in the output of --json.".strip() if more > 0 else table.note


def _number(value: float, text: str | None = None) -> Cell:
    return Cell(with_minus_signs(fmt.number(value, fmt.DIGITS) if text is None else text), float(value))


def _shown(result: Result, quantity: str, value: float) -> Cell:
    return _number(value, fmt.shown(result.scene, quantity, value)) if np.isfinite(value) else Cell("")


def _with_units(scene: Scene, k: int, name: str) -> str:
    """Name a support; one that holds a rotation with the units of its couple and its angles, for which the columns have no room."""
    if not turns(scene.supports[k]):
        return name
    angle = "mrad" if fmt.shown_unit(scene, "deflection")[1] == 1000.0 else "rad"
    return f"{name} [{', '.join(filter(None, (fmt.unit(scene, 'couple'), angle)))}]"


def _supports(result: Result) -> TableData:
    """The supports in the state that is drawn: the page fills in its numbers."""
    scene = result.scene
    rows = zip(labels(scene.supports), scene.positions(scene.supports).tolist(), scene.supports, strict=True)
    quantities = ["reaction", "deflection", "opening"]
    step = result.steps[-1] if len(result.steps) else None
    if step is not None and step.couple.any():
        quantities.append("couple")
    if step is not None and any(step.sliding):
        quantities += ["friction", "slip"]
    head = ["support", fmt.shown_heading(scene, "x"), "side", "state", *(fmt.shown_heading(scene, name) for name in quantities)]
    table, quiet = [], {} if step is None else {of: fmt.without_noise(getattr(step, of)) for of in quantities}
    for k, (name, x, support) in enumerate(rows):
        side = "axial" if support.direction == "axial" else support.side
        values = [Cell("", 0.0) if step is None else _shown(result, of, quiet[of][k]) for of in quantities]
        state = Cell("" if step is None else state_in_words(step.state[k]))
        table.append([Cell(_with_units(scene, k, name)), _number(x), Cell(side), state, *values])
    note = f"Reactions are positive {positive_reactions(scene)}."
    if "slip" in quantities:
        note += f" Friction and slip: positive {positive_along(scene)}."
    return TableData("supports", "Supports in the state that is drawn", head, table, note)


def _extremes(result: Result, envelope: Envelope | TrainEnvelope) -> TableData:
    rows = []
    for name, row in fmt.reported(envelope.extremes).items():
        for kind, one in row.items():
            if one is not None:
                words = f"{IN_WORDS[kind]} {fmt.shown_heading(result.scene, name)}"
                source = Cell(source_in_words(one, result.scene))
                rows.append([Cell(words), _shown(result, name, one.value), _number(one.x), source])
    head = ["", "value", fmt.shown_heading(result.scene, "x", "at x"), "from"]
    if not any(row[3].text for row in rows):
        head, rows = head[:3], [row[:3] for row in rows]
    return TableData("extremes", "Largest and smallest values along the beam", head, rows,
                     positive_fields(result.scene))  # fmt: skip


def _support_extremes(result: Result, envelope: Envelope | TrainEnvelope) -> TableData:
    names, rows = labels(result.scene.supports), []
    one_sided = any(support.side != "both" for support in result.scene.supports)
    chosen = [("reaction", "max"), ("reaction", "min"), *([("opening", "max")] if one_sided else [])]
    found = [[support[quantity][kind] for quantity, kind in chosen] for support in envelope.supports]
    quiet = [fmt.without_noise(np.nan if one is None else one.value for one in column) for column in zip(*found, strict=True)]
    for k, name in enumerate(names):
        row = [Cell(_with_units(result.scene, k, name))]
        for i, (quantity, _) in enumerate(chosen):
            row.append(_shown(result, quantity, quiet[i][k]))
            row.append(Cell(source_in_words(found[k][i], result.scene) if found[k][i] is not None and quiet[i][k] else ""))
        rows.append(row)
    head = ["support"]
    for quantity, kind in chosen:
        head += [fmt.shown_heading(result.scene, quantity, f"{IN_WORDS[kind]} {quantity}"), "from"]
    return TableData("support-extremes", "Largest and smallest values at the supports", head, rows)


def _combinations(result: Result) -> TableData:
    columns = result.combinations.columns()
    fields = [name for name in ("moment", "shear", "deflection") if f"{name}_max" in columns]
    head = ["combination", "status", *(["limit state"] if "limit_state" in columns else [])]
    for name in fields:
        head += [fmt.shown_heading(result.scene, name, f"{IN_WORDS[kind]} {name}") for kind in IN_WORDS]
    rows = []
    for k, (name, status) in enumerate(zip(columns["combination"], columns["status"], strict=True)):
        values = [_shown(result, of, float(columns[f"{of}_{kind}"][k])) for of in fields for kind in IN_WORDS]
        limit_state = [Cell(visible(columns["limit_state"][k]))] if "limit_state" in columns else []
        rows.append([Cell(visible(name)), Cell(status), *limit_state, *values])
    return TableData("combinations", "Combinations", head, rows)


def _events(result: Result, ways: list[dict[str, Any]]) -> TableData:
    several = sum(bool(way.get("events")) for way in ways) > 1
    rows, jumps = [], []
    for k, way in enumerate(ways):
        for i, one in enumerate(way.get("events", ())):
            at = one.get("factor", one["at"])
            place = [_number(one["x"]) if "x" in one else Cell("")]
            rows.append([*([Cell(way["title"])] if several else []), _number(at, fmt.number(at, 10)), Cell(one["words"]), *place])
            jumps.append((k, i))
    axis = "position of the train" if result.scene.trains else "load factor"
    head = [*(["way"] if several else []), axis, "event", fmt.shown_heading(result.scene, "x")]
    return TableData("events", "Events", head, rows, "Click the number to see the state.", jumps)


def _zones(result: Result) -> TableData:
    """Contact with the ground at the end of the load."""
    step = result.steps[-1] if len(result.steps) else None
    scene, rows = result.scene, []

    def add(what: str, foundation: int, of: Iterable[Cell]) -> None:
        rows.append([Cell(what), Cell(label(scene.foundation, foundation)), *of])

    if step is not None and scene.foundation:
        for zone in step.contact:
            ends = [_number(value) for value in (zone.from_, zone.to, zone.to - zone.from_)]
            add(state_in_words(zone.state), zone.foundation, [*ends, _shown(result, "resultant", zone.resultant), Cell("")])
        for span in step.free_spans:
            ends = [_number(value) for value in (span.from_, span.to, span.to - span.from_)]
            add("free span", span.foundation, [*ends, Cell(""), _shown(result, "sag", span.sag)])
    head = ["", "foundation", *(fmt.shown_heading(scene, "x", words) for words in ("from", "to", "length")),
            fmt.shown_heading(scene, "resultant"), fmt.shown_heading(scene, "sag")]  # fmt: skip
    return TableData("zones", "Contact with the ground at the end of the load", head, rows)


def _modes(result: Result) -> TableData:
    """Factors of buckling and frequencies at the end of the load."""
    found = {} if result.combinations or not len(result.steps) else modes_data(result)
    columns = {}
    if found.get("buckling"):
        columns["buckling factor of all N"] = found["buckling"]
    if found.get("frequencies"):
        columns["omega [rad per unit of time]"] = found["frequencies"]
        columns["f = omega/2\u03c0"] = [value / (2.0 * np.pi) for value in found["frequencies"]]
    rows = [
        [_number(k + 1), *(_number(values[k]) if k < len(values) else Cell("") for values in columns.values())]
        for k in range(max(map(len, columns.values()), default=0))
    ]
    note = "With the supports and the ground that act there."
    return TableData("modes", "Modes at the end of the load", ["number", *columns], rows, note)
