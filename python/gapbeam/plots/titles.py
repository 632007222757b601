"""Titles of pictures: as many lines as are needed, none beyond the edge of the page."""

from __future__ import annotations

from .labels import measured_width
from .panels import WIDTH

SIZE, MOST_LINES = 10.0, 2
"""Of the letters (points); lines that a title takes at most."""
HEIGHT = 0.17
"""Of a line (inches)."""


def title_lines(text: str, width: float = WIDTH - 0.48) -> list[str]:
    """Break a title at blanks; what has no room in its last line, or a word in any, is cut.

    Parameters
    ----------
    text : str
        The title.
    width : float
        Of the page (inches).

    Examples
    --------
    >>> title_lines("Bridge 7"), title_lines("Bridge 7, western abutment", 1.2)
    (['Bridge 7'], ['Bridge 7,', 'western abut...'])
    """
    lines: list[str] = [""]
    words = text.split(" ")
    for k, word in enumerate(words):
        longer = f"{lines[-1]} {word}" if lines[-1] else word
        if not lines[-1] or _fits(longer, width):
            lines[-1] = longer
        elif len(lines) < MOST_LINES:
            lines.append(word)
        else:
            lines[-1] = " ".join([lines[-1], *words[k:]])
            break
    return [_cut(line, width) for line in lines]


def _fits(text: str, width: float) -> bool:
    return measured_width(text, SIZE, "bold") <= 72.0 * width


def _cut(text: str, width: float) -> str:
    """Cut a line as far as it has no room."""
    if _fits(text, width):
        return text
    low, high = 0, len(text)
    while low + 1 < high:
        middle = (low + high) // 2
        low, high = (middle, high) if _fits(f"{text[:middle].rstrip()}...", width) else (low, middle)
    return f"{text[:low].rstrip()}..."
