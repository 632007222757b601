"""The contact state (which supports act) over the load, and its events, as rows of text."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from string import ascii_lowercase
from typing import TYPE_CHECKING

from ..results.event_words import event_in_words, reaction_at, state_in_words
from ..results.formatting import DIGITS, number, ranges

if TYPE_CHECKING:
    from ..results.envelopes.over_path import PathEnvelope
    from ..results.paths.ground_path import GroundEvent
    from ..results.paths.path import Event
    from ..results.result import Result

#: State -> character; the second where the terminal knows only ASCII
SYMBOLS = {"closed": ("●", "#"), "open": ("○", "o"), "bilateral": ("▲", "^"), "touching": ("◐", "~")}

#: Up to so many supports, each has a symbol; above, the changes are listed
MOST_SYMBOLS = 200

#: Supports on one line, in groups of ten
LINE = 50

History = Iterable[tuple[float, Sequence[str]]]


def symbol(state: str, plain: bool = False) -> str:
    """Give the character of a state; a digit for the segment of a support law.

    Examples
    --------
    >>> symbol("open", plain=True), symbol("branch 2")
    ('o', '2')
    """
    if state in SYMBOLS:
        return SYMBOLS[state][plain]
    number = int(state.removeprefix("branch "))
    return str(number) if number < 10 else ascii_lowercase[min(number - 10, 25)]


def legend(states: Sequence[str], plain: bool = False) -> str:
    """Explain the symbols of these states.

    Examples
    --------
    >>> legend(["closed", "open"], plain=True)
    '# in contact  o no contact'
    """
    seen = [state for state in SYMBOLS if state in states]
    seen += sorted(set(states) - set(SYMBOLS), key=lambda state: (len(state), state))
    return "  ".join(f"{symbol(state, plain)} {state_in_words(state)}" for state in seen)


def merged(history: History) -> list[tuple[float, float, tuple[str, ...]]]:
    """Draw consecutive equal contact states together: first factor, last factor, states.

    Examples
    --------
    >>> merged([(0.5, ("open",)), (0.75, ("closed",)), (1.0, ("closed",))])
    [(0.5, 0.5, ('open',)), (0.75, 1.0, ('closed',))]
    """
    rows: list[tuple[float, float, tuple[str, ...]]] = []
    for factor, states in history:
        if rows and rows[-1][2] == tuple(states):
            rows[-1] = (rows[-1][0], factor, rows[-1][2])
        else:
            rows.append((factor, factor, tuple(states)))
    return rows


def contact_table(history: History, width: int, plain: bool = False) -> tuple[list[str], list[list[str]]]:
    """Give headings and rows of the history: as much as fits, a summary where it does not.

    Parameters
    ----------
    history : iterable of (factor, states)
        As from `Result.history`.
    width : int
        Characters a line.
    plain : bool
        ASCII only.

    Returns
    -------
    headings : list of str
    rows : list of list of str
        One per contact state.

    Examples
    --------
    >>> contact_table([(0.5, ("bilateral", "closed")), (1.0, ("bilateral", "open"))], 80, plain=True)
    (['load factor', 'support 0', '1'], [['0.5', '^', '#'], ['1', '^', 'o']])
    """
    rows = merged(history)
    supports = len(rows[0][2])
    factors = [_span(first, last) for first, last, _ in rows]
    if 24 + 3 * supports <= width and supports <= LINE:
        headings = ["load factor", "support 0", *(str(index) for index in range(1, supports))]
        return headings, [
            [factor, *(symbol(state, plain) for state in states)]
            for factor, (_, _, states) in zip(factors, rows, strict=True)
        ]
    if supports <= MOST_SYMBOLS:
        return _grouped(factors, rows, width, plain)
    return _changes(factors, rows)


def event_table(
    result: Result, events: Sequence[Event] | Sequence[GroundEvent], envelope: PathEnvelope | None = None
) -> tuple[list[str], list[list[str]], tuple[int, ...]]:
    """Give headings and rows of the events, and the columns that are flush left.

    Parameters
    ----------
    result : Result
        Of one load.
    events : sequence of Event or GroundEvent
        In the order of the load.
    envelope : PathEnvelope, optional
        Of the loading history; it knows the reactions at which supports yield or break.

    Returns
    -------
    headings : list of str
    rows : list of list of str
    left : tuple of int
    """
    rows = []
    for event in events:
        of_support = event.support is not None
        reaction = reaction_at(result, envelope, event.support, event.factor, event.event) if of_support else None
        rows.append([number(event.factor, DIGITS), event_in_words(result.scene, event, reaction)])
    return ["load factor", "what happens"], rows, (1,)


def _span(first: float, last: float) -> str:
    return number(last, 4) if first == last else f"{number(first, 4)} to {number(last, 4)}"


def _grouped(factors: list[str], rows: list, width: int, plain: bool) -> tuple[list[str], list[list[str]]]:
    """Write symbols in groups of ten, several lines a contact state."""
    line = min(LINE, max(10, (width - 26) // 11 * 10))
    ruler = " ".join(str(index).ljust(10) for index in range(0, line, 10)).rstrip()
    table = []
    for factor, (_, _, states) in zip(factors, rows, strict=True):
        symbols = "".join(symbol(state, plain) for state in states)
        for start in range(0, len(symbols), line):
            part = symbols[start : start + line]
            groups = " ".join(part[at : at + 10] for at in range(0, len(part), 10))
            table.append([factor if start == 0 else "", str(start), groups])
    return ["load factor", "from", ruler], table


def _changes(factors: list[str], rows: list) -> tuple[list[str], list[list[str]]]:
    """Tell how many there are of each state, and which supports changed since the contact state before."""
    table = []
    before = None
    for factor, (_, _, states) in zip(factors, rows, strict=True):
        text = "start"
        if before is not None:
            changed = [index for index, pair in enumerate(zip(before, states, strict=True)) if pair[0] != pair[1]]
            parts = []
            for name, verb in (("closed", "close"), ("open", "open")):
                which = [index for index in changed if states[index] == name]
                if which:
                    parts.append(f"{len(which)} {verb}: {_few(which)}")
            text = "; ".join(parts) or f"{len(changed)} change segment: {_few(changed)}"
        table.append([factor, str(states.count("closed")), str(states.count("open")), text])
        before = states
    return ["load factor", "closed", "open", "change, supports by number"], table


def _few(indices: list[int], most: int = 48) -> str:
    """Write the indices, cut after about `most` characters."""
    parts = ranges(indices).split(", ")
    text = ""
    for position, part in enumerate(parts):
        longer = f"{text}, {part}" if text else part
        if len(longer) > most and position < len(parts) - 1:
            return text + ", ..."
        text = longer
    return text
