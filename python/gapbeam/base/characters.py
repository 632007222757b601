"""Characters that are not seen and change how a line of text looks, or begin a formula in a table; minus signs."""

import re

UNSEEN = re.compile(
    "[\0-\x1f\x7f-\x9f"  # control characters
    "\xad\u200b\u2060-\u2064\ufeff"  # of no width
    "\u200e\u200f\u202a-\u202e\u2066-\u2069"  # what turns the direction of writing
    "\u2028\u2029"  # ends of lines
    "\ud800-\udfff\ufffe\uffff]"  # halves of characters, and what is none
)


def visible(text: str) -> str:
    r"""Write what would not be seen as an escape, and everything else as it is.

    Parameters
    ----------
    text : str
        A title, a label, a name, in the words of a user.

    Returns
    -------
    str
        One line that a terminal, a picture and a file in UTF-8 can show.

    Examples
    --------
    >>> visible("50 % of $F$ [kN]"), visible("beam\n\x1b[31m")
    ('50 % of $F$ [kN]', 'beam\\n\\x1b[31m')
    """
    return UNSEEN.sub(lambda found: found[0].encode("unicode_escape").decode("ascii"), text)


HYPHEN = re.compile(r"(?<!\w)-")
"""Not that of a name, and not that of an exponent."""


def with_minus_signs(text: str) -> str:
    """Write minus signs proper, in pictures and pages.

    Parameters
    ----------
    text : str
        With numbers.

    Returns
    -------
    str
        Hyphens of names and of exponents stay.

    Examples
    --------
    >>> with_minus_signs("R-104: -2.5e-09 kN")
    'R-104: \N{MINUS SIGN}2.5e-09 kN'
    """
    return HYPHEN.sub("\N{MINUS SIGN}", text)


FORMULA = ("=", "+", "-", "@")
"""What a cell begins with that spreadsheets take for a formula; they do not see tabs and ends of lines before it."""


def cell(value: object) -> object:
    """Give what stands in a cell of a table that a spreadsheet may open: no text that it would work out.

    Parameters
    ----------
    value : object
        A name, or a number, which stays.

    Returns
    -------
    object
        The text in one line, with an apostrophe before it where it begins like a formula.

    Examples
    --------
    >>> cell("=1+1"), cell("dead + wind"), cell(-1.5)
    ("'=1+1", 'dead + wind', -1.5)
    """
    if not isinstance(value, str):
        return value
    return ("'" if value.lstrip().startswith(FORMULA) else "") + visible(value)
