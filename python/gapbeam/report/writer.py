"""The few shapes a report is made of: a line, a heading, a table, a list of names and values."""

from collections import Counter
from collections.abc import Iterable, Sequence

from rich import box
from rich.cells import cell_len
from rich.console import Console
from rich.table import Table
from rich.text import Text

from ..results.formatting import ranges

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
        whole: bool = False,
    ) -> None:
        """Write a table; numbers of the columns in `left` are flush left, the others flush right.

        More than `longest` rows are cut in the middle, and a line says so. Columns whose words do not fit beside the others stand
        below, behind the first one again.
        """
        shown, hidden = cut(rows, longest)
        columns = [list(texts) for texts in zip(headings, *shown, strict=True)]
        for number, part in enumerate(_parts_of_table(columns, self.width, whole)):
            if number:
                self.line()
            table = Table(box=PLAIN if self.plain else box.SIMPLE_HEAD, show_edge=False, padding=(0, 1, 0, 0))
            for k, width in zip(part, _widths_of_columns([columns[k] for k in part], self.width), strict=True):
                justify = "left" if k in left else "right"
                table.add_column(Text(headings[k]), justify=justify, overflow="fold", vertical="top", width=width)
            for index, row in enumerate(shown):
                if hidden and index == len(shown) // 2:
                    table.add_row(*["..."] * len(part))
                table.add_row(*(Text(row[k]) for k in part))
            self.console.print(table)
        if hidden:
            self.line(
                f"{hidden:,} rows in the middle are left out here; all are in the output of --json.", "italic"
            )

    def columns(
        self, columns: Sequence[tuple[str, Sequence[str]]], left: Sequence[int] = (), longest: int = LONGEST
    ) -> None:  # fmt: skip
        """Write a table as `table` does, given as columns: the heading and the texts of each."""
        self.table([name for name, _ in columns], list(zip(*(texts for _, texts in columns), strict=True)), left, longest)

    def table_by_name(self, headings: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
        """Write a table of numbers by name, with whole names: columns that do not fit stand below, by name again."""
        self.table(headings, rows, left=[0], whole=True)

    def supports_left_out(self, which: Sequence[int | None], count: int, lifted: Sequence[int], verb: str) -> None:
        """Say how many supports a table leaves out that shows some of `count` (from `chosen`), and which of them lift off."""
        if None in which:
            lost = sorted(set(lifted).difference(which))
            words = f"no contact at {ranges(lost)}" if lost else f"all of them {verb} in contact"
            hidden = count - len(set(which) - {None})
            self.line(f"{hidden:,} supports are left out here; {words}. All are in the output of --json.", "italic")

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


def _widths_of_columns(columns: Sequence[Sequence[str]], width: int) -> Sequence[int | None]:
    """Choose widths that break no word, where all texts do not fit but all words do; None: as the table has it by itself.

    Examples
    --------
    >>> _widths_of_columns([["reaction kN", "2.11"], ["slip mm", "0.5"]], 18)
    [8, 7]
    >>> _widths_of_columns([["reaction kN", "2.11"], ["slip mm", "0.5"]], 80)
    [None, None]
    """
    room = width - GAP * len(columns) + 1
    wanted = _widest_lines(columns)
    least = _widest_words(columns)
    if sum(wanted) <= room or sum(least) > room:
        return [None] * len(columns)
    while sum(wanted) > room:  # the widest one that can gives way
        can = [most if most > word else 0 for most, word in zip(wanted, least, strict=True)]
        wanted[can.index(max(can))] -= 1
    return wanted


def _widest_lines(columns: Sequence[Sequence[str]]) -> list[int]:
    """Measure the widest line of every column."""
    return [max(cell_len(line) for text in texts for line in text.split("\n")) for texts in columns]


def _widest_words(columns: Sequence[Sequence[str]]) -> list[int]:
    """Measure the widest word of every column."""
    return [max((cell_len(word) for text in texts for word in text.split()), default=0) for texts in columns]


def _parts_of_table(columns: Sequence[Sequence[str]], width: int, whole: bool = False) -> list[list[int]]:
    """Divide the columns of a table whose words do not fit beside one another; the first one stands in every part.

    One with the heading of another one, such as ``from``, stands with the one before it. Where `whole`, texts are not broken at
    blanks if columns may stand below instead.

    Examples
    --------
    >>> _parts_of_table([["support", "A"], ["reaction", "2.11"], ["slip", "0.5"]], 18)
    [[0, 1], [0, 2]]
    >>> _parts_of_table([["support", "A"], ["reaction", "2.11"], ["slip", "0.5"]], 24)
    [[0, 1, 2]]
    """
    wide = [one + GAP for one in _widest_lines(columns)]
    if not whole and sum(_widest_words(columns)) + GAP * len(columns) - 1 <= width:
        return [list(range(len(columns)))]
    often = Counter(heading for heading, *_ in columns)
    parts: list[list[int]] = [[0]]
    for k in range(1, len(columns)):
        with_next = [j for j in (k, k + 1) if j == k or (j < len(columns) and often[columns[j][0]] > 1)]
        if len(parts[-1]) > 1 and often[columns[k][0]] == 1 and sum(wide[j] for j in (*parts[-1], *with_next)) > width:
            parts.append([0])
        parts[-1].append(k)
    return parts


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
