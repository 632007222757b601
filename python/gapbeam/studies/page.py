"""One way to write and print the table of a study."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from .corners import page

if TYPE_CHECKING:
    from rich.console import Console


@dataclass(frozen=True)
class Page:
    """A study that is one table.

    Attributes
    ----------
    study, title : str
        Its name on the command line, and its heading.
    words : sequence of str
        What the table shows, line by line.
    columns : sequence of str
        Headings of the table; the first column names what a group of rows is about.
    texts : int
        How many columns are texts, the others are numbers.
    """

    study: str
    title: str
    words: Sequence[str]
    columns: Sequence[str]
    texts: int

    def markdown(self, cells: list[list[str]]) -> str:
        """Write the page of the documentation.

        Parameters
        ----------
        cells : list of list of str
            The rows.

        Returns
        -------
        str
        """
        return page(self.title, self.study, self.words, self.columns, cells, self.texts)

    def csv(self, values: Sequence[Sequence]) -> str:
        """Write comma-separated values.

        Parameters
        ----------
        values : sequence of sequence
            The rows, with all digits.

        Returns
        -------
        str
        """
        return to_csv(self.columns, values)

    def show(self, cells: list[list[str]], console: Console | None = None) -> None:
        """Print the table, a part for each group of rows.

        Parameters
        ----------
        cells : list of list of str
            The rows.
        console : rich.console.Console, optional
            Where to print; default standard output.
        """
        from rich.console import Console

        from ..report.writer import Writer

        say = Writer(console or Console(highlight=False))
        say.line(self.title, "bold")
        say.line(" ".join(self.words), "dim")
        for group in dict.fromkeys(row[0] for row in cells):
            say.heading(group)
            rows = [row[1:] for row in cells if row[0] == group]
            say.table(self.columns[1:], rows, left=range(self.texts - 1))


def to_csv(columns: Sequence[str], values: Sequence[Sequence]) -> str:
    r"""Write comma-separated values.

    Parameters
    ----------
    columns : sequence of str
        Headings.
    values : sequence of sequence
        Rows.

    Returns
    -------
    str

    Examples
    --------
    >>> to_csv(["beam", "error"], [["one, long", 0.1]])
    'beam,error\n"one, long",0.1\n'
    """
    stream = io.StringIO()
    csv.writer(stream, lineterminator="\n").writerows([columns, *values])
    return stream.getvalue()
