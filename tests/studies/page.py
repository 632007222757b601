"""One way to write and print the table of a study."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import astuple, dataclass
from typing import TYPE_CHECKING, Any

from gapbeam.studies.page import markdown_table, to_csv

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
    file : str
        Name of its page, where that is another than the study's.
    caption : str
        What its picture shows, if it has one.
    """

    study: str
    title: str
    words: Sequence[str]
    columns: Sequence[str]
    texts: int
    file: str = ""
    caption: str = ""

    def markdown(self, cells: list[list[str]], remark: str = "", picture: str = "") -> str:
        """Write the page of the documentation.

        Parameters
        ----------
        cells : list of list of str
            The rows.
        remark : str
            What is to be said of them.
        picture : str
            Name of the picture's file beside the page, if there is one.
        """
        file = self.file or self.study
        drawn = f" --plot docs/{file}.svg" if picture else ""
        made = f"This page is made by `python tests/studies {self.study} --markdown docs/{file}.md{drawn}`."
        said = ["", f"![{self.caption}]({picture})"] if picture else []
        said += ["", "Findings:"] if remark.startswith("* ") else []
        said += ["", remark] if remark else []
        table = markdown_table(self.columns, cells, self.texts)
        return "\n".join([f"# {self.title}", "", made, "", *self.words, *said, "", *table]) + "\n"

    def csv(self, rows: Iterable[Any]) -> str:
        """Write comma-separated values with all digits, times in seconds.

        Parameters
        ----------
        rows : iterable of dataclass
            Whose attributes are the columns.
        """
        return to_csv(self.columns, [astuple(row) for row in rows])

    def show(self, cells: list[list[str]], console: Console | None = None, remark: str = "") -> None:
        """Print the table, a part for each group of rows where the first column names one.

        Parameters
        ----------
        cells : list of list of str
            The rows.
        console : rich.console.Console, optional
            Where to print; default standard output.
        remark : str
            What is to be said of the rows.
        """
        from gapbeam.report.writer import Writer
        from rich.console import Console

        say = Writer(console or Console(highlight=False))
        say.line(self.title, "bold")
        for line in self.words:
            say.line(line, "dim")
        if self.texts == 1:
            say.line()
            say.table(self.columns, cells, left=(0,))
        for group in dict.fromkeys(row[0] for row in cells if self.texts > 1):
            say.heading(group)
            rows = [row[1:] for row in cells if row[0] == group]
            say.table(self.columns[1:], rows, left=range(self.texts - 1))
        if remark:
            say.line()
            say.line(remark)
