"""The few shapes a report is made of: a line, a heading, a table, a list of names and values."""

from collections.abc import Iterable, Sequence

from rich import box
from rich.cells import cell_len
from rich.console import Console
from rich.table import Table
from rich.text import Text

#: Tables with more rows than this are cut
LONGEST = 40
#: Between two columns of a table
GAP = 2
#: Supports at either end that a cut table shows always
ENDS = 5


class Writer:
    """Writes to a rich console; plain characters only where the console knows no others.

    Parameters
    ----------
    console : rich.console.Console
        Where to write.
    """

    def __init__(self, console: Console) -> None:
        self.console = console
        self.width = console.width
        self.plain = not (console.encoding or "ascii").lower().startswith("utf")

    def line(self, text: str = "", style: str = "") -> None:
        """Write one paragraph, wrapped at the width of the console."""
        self.console.print(Text(text, style=style))

    def heading(self, text: str) -> None:
        """Write the title of a section."""
        self.line()
        self.line(text, "bold")

    def table(
        self,
        headings: Sequence[str],
        rows: Sequence[Sequence[str]],
        left: Sequence[int] = (),
        longest: int = LONGEST,
    ) -> None:
        """Write a table; numbers of the columns in `left` are flush left, the others flush right.

        More than `longest` rows are cut in the middle, and a line says so.
        """
        shown, hidden = cut(rows, longest)
        table = Table(box=PLAIN if self.plain else box.SIMPLE_HEAD, show_edge=False, padding=(0, 1, 0, 0))
        widths = widths_of_columns([list(texts) for texts in zip(headings, *shown, strict=True)], self.width)
        for index, (heading, width) in enumerate(zip(headings, widths, strict=True)):
            table.add_column(
                Text(heading), justify="left" if index in left else "right", overflow="fold", vertical="top", width=width
            )
        for index, row in enumerate(shown):
            if hidden and index == len(shown) // 2:
                table.add_row(*["..."] * len(headings))
            table.add_row(*(Text(cell) for cell in row))
        self.console.print(table)
        if hidden:
            self.line(
                f"{hidden:,} rows in the middle are left out here; all are in the output of --json.", "italic"
            )

    def table_by_name(self, headings: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
        """Write a table of numbers by name, with whole names: columns that do not fit stand below, by name again."""
        names, *columns = ([heading, *(row[k] for row in rows)] for k, heading in enumerate(headings))
        wide = [max(map(cell_len, texts)) + GAP for texts in (names, *columns)]
        first = 1
        while first < len(headings):
            last = first + 1
            while last < len(headings) and wide[0] + sum(wide[first : last + 1]) <= self.width:
                last += 1
            if first > 1:
                self.line()
            part = slice(first, last)
            self.table([headings[0], *headings[part]], [[row[0], *row[part]] for row in rows], left=[0])
            first = last

    def pairs(self, rows: Sequence[tuple[str, str]]) -> None:
        """Write names and what there is to say of them."""
        table = Table(box=None, show_header=False, padding=(0, 2, 0, 0))
        table.add_column(no_wrap=True)
        table.add_column(overflow="fold")
        for name, text in rows:
            table.add_row(Text(name, style="dim"), Text(text))
        self.console.print(table)


#: A line under the headings and nothing else
PLAIN = box.Box("    \n    \n -- \n    \n    \n    \n    \n    \n", ascii=True)


def widths_of_columns(columns: Sequence[Sequence[str]], width: int) -> Sequence[int | None]:
    """Choose widths that break no word, where all texts do not fit but all words do.

    Parameters
    ----------
    columns : sequence of sequence of str
        Heading and cells of each.
    width : int
        Of all of them.

    Returns
    -------
    sequence of int or None
        None: as the table has it by itself.

    Examples
    --------
    >>> widths_of_columns([["reaction kN", "2.11"], ["slip mm", "0.5"]], 18)
    [8, 7]
    >>> widths_of_columns([["reaction kN", "2.11"], ["slip mm", "0.5"]], 80)
    [None, None]
    """
    room = width - GAP * len(columns) + 1
    wanted = [max(map(cell_len, texts)) for texts in columns]
    least = [max((cell_len(word) for text in texts for word in text.split()), default=0) for texts in columns]
    if sum(wanted) <= room or sum(least) > room:
        return [None] * len(columns)
    while sum(wanted) > room:  # the widest one that can gives way
        can = [most if most > word else 0 for most, word in zip(wanted, least, strict=True)]
        wanted[can.index(max(can))] -= 1
    return wanted


def cut(rows: Sequence, longest: int = LONGEST) -> tuple[list, int]:
    """Select the rows to show of a long table, and count those left out.

    Examples
    --------
    >>> shown, hidden = cut(range(1000))
    >>> len(shown), hidden, shown[19], shown[-1]
    (40, 960, 19, 999)
    """
    if len(rows) <= longest:
        return list(rows), 0
    half = longest // 2
    return [*rows[:half], *rows[-half:]], len(rows) - 2 * half


def chosen(count: int, important: Iterable[int], longest: int = LONGEST) -> list[int | None]:
    """Choose the rows of a long table: both ends, and the important ones before all others; None where some are left out.

    Examples
    --------
    >>> chosen(100, [40, 41], longest=12)
    [0, 1, 2, 3, 4, None, 40, 41, None, 95, 96, 97, 98, 99]
    >>> chosen(3, [])
    [0, 1, 2]
    """
    if count <= longest:
        return list(range(count))
    ends = {*range(ENDS), *range(count - ENDS, count)}
    room = max(longest - len(ends), 2)
    found: list[int | None] = []
    for k in sorted(ends | set([k for k in important if k not in ends][:room])):
        if found and k != found[-1] + 1:
            found.append(None)
        found.append(k)
    return found


def left_out(count: int) -> str:
    """Say how many rows of a table are left out.

    Parameters
    ----------
    count : int
        Rows of all of it.
    """
    return f" {count - LONGEST:,} more are in the output of --json." if count > LONGEST else ""
