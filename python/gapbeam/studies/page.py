"""The table of a study as text."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Sequence

from ..base.characters import cell


def to_csv(columns: Sequence[str], values: Sequence[Sequence]) -> str:
    r"""Write comma-separated values.

    Parameters
    ----------
    columns : sequence of str
        Headings.
    values : sequence of sequence
        Rows.

    Examples
    --------
    >>> to_csv(["beam", "error"], [["one, long", 0.1]])
    'beam,error\n"one, long",0.1\n'
    """
    stream = io.StringIO()
    csv.writer(stream, lineterminator="\n").writerows(map(cell, row) for row in (columns, *values))
    return stream.getvalue()


def markdown_table(columns: Iterable[str], cells: list[list[str]], texts: int) -> list[str]:
    """Write one table of a page.

    Parameters
    ----------
    columns : iterable of str
        Headings.
    cells : list of list of str
        Its rows.
    texts : int
        How many columns are texts, the others are numbers.

    Returns
    -------
    list of str
        Its lines.
    """
    rule = "|---" * texts + "|---:" * (len(cells[0]) - texts) + "|"
    rows = ["| " + " | ".join(row) + " |" for row in (list(columns), *cells)]
    return [rows[0], rule, *rows[1:]]


def literal_markdown(text: str) -> str:
    r"""Write a text of the user so that Markdown shows it as it is.

    Parameters
    ----------
    text : str
        One line.

    Examples
    --------
    >>> literal_markdown("EI_1 <b> [x](y)")
    'EI\\_1 \\<b\\> \\[x\\](y)'
    """
    return re.sub(r"([\\`*_\[\]<>#|$~])", r"\\\1", text)
