"""A result in a notebook: title, answer, a small table and the picture, as HTML."""

from __future__ import annotations

import base64
from collections.abc import Callable
from html import escape

from ..results.answer import known_envelope
from ..results.result import Result
from ..results.views.columns import Columns

MOST_ROWS = 12
"""Rows of the table."""
MOST_DRAWN = 60
"""Spans and supports up to which a picture is made unasked."""
SHOWN = (
    "support", "x", "state", "reaction", "opening", "reaction_max", "reaction_min", "opening_max", "lifted_share",
    "result", "mean", "least", "1 %", "50 %", "99 %", "largest",
)  # fmt: skip
"""Columns of the table."""


def html_of(result: Result, lines: list[str], picture: Callable[[], bytes]) -> str:
    """Write the answer, a table of the supports and the picture of a result as HTML.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.
    lines : list of str
        Title and answer.
    picture : callable
        Makes it, as SVG.

    Returns
    -------
    str
        Without scripts and without anything from elsewhere.
    """
    scene = result.scene
    there = result.has_envelope and scene.supports and known_envelope(result) is not None
    table = result.table("supports") if there else None
    small = max(len(scene.beam.spans), len(scene.supports)) <= MOST_DRAWN
    return html_of_lines(lines, table, picture if small else None)


def html_of_lines(lines: list[str], table: Columns | None, picture: Callable[[], bytes] | None) -> str:
    """Write an answer, a table and a picture as HTML.

    Parameters
    ----------
    lines : list of str
        Title and answer.
    table : Columns, optional
        Its first rows are shown.
    picture : callable, optional
        Makes it, as SVG.

    Returns
    -------
    str
        Without scripts and without anything from elsewhere.
    """
    title, *rest = map(escape, lines)
    parts = [f"<strong>{title}</strong>", f"<pre>{chr(10).join(rest)}</pre>"]
    if table is not None:
        parts.append(_html_table(table))
    if picture is not None:
        data = base64.b64encode(picture()).decode()
        parts.append(f'<img style="max-width:100%" alt="{title}" src="data:image/svg+xml;base64,{data}">')
    return f"<div>{''.join(parts)}</div>"


def _html_table(table: Columns) -> str:
    """Write the first rows of some columns of a table as HTML."""
    chosen = Columns({name: table[name] for name in SHOWN if name in table})
    head = "".join(f"<th>{escape(name)}</th>" for name in chosen)
    rows = "".join(f"<tr>{''.join(f'<td>{escape(word)}</td>' for word in row)}</tr>" for row in chosen.rows(MOST_ROWS))
    more = f"<p>{chosen.count - MOST_ROWS:,} more rows</p>" if chosen.count > MOST_ROWS else ""
    return f"<table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>{more}"
