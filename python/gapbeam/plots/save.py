"""A figure as a file: the same figure gives the same file, and its text is shown as it was written."""

import io
import os
import re
from warnings import catch_warnings, filterwarnings

from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.text import Text

from ..base.files import write_files
from .thin import thin


def literal(figure: Figure) -> Figure:
    """Let the texts of a figure be no formulas: a title may hold dollar signs.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        Complete.

    Returns
    -------
    matplotlib.figure.Figure
        The same.
    """
    for text in figure.findobj(Text):
        text.set_parse_math(False)
        text.set_usetex(False)
    return figure


def picture(figure: Figure, suffix: str) -> bytes:
    """Give the contents of a file with a figure.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        What to draw; of thousands of symbols, those that nobody could see are taken out.
    suffix : str
        .png, .pdf or .svg, in capitals or not.
    """
    for axes in figure.axes:
        for collection in axes.collections:
            thin(axes, collection)
    kind = suffix.lower().removeprefix(".")
    stream = io.BytesIO()
    with rc_context({"svg.fonttype": "none", "svg.hashsalt": "gapbeam"}), catch_warnings():
        if kind == "svg":
            filterwarnings("ignore", "Glyph .* missing")  # the viewer of the file has fonts of its own
        figure.savefig(stream, format=kind, metadata={"Date": None} if kind == "svg" else None)
    return _compact(stream.getvalue()) if kind == "svg" else stream.getvalue()


def _compact(svg: bytes) -> bytes:
    r"""Shorten a picture: neighbours of one style become one path, places have two decimals.

    Examples
    --------
    >>> _compact(b'<path d="M 0.12345 1" style="a"/>\n<path d="M 2 3" style="a"/><use x="1.23456" y="2"/>')
    b'<path d="M 0.12 1M 2 3" style="a"/>\n<use x="1.23" y="2"/>'
    """
    for part in (rb'<path (?:id="[^"]*" )?d="[^"]*"', rb"<use [^>]*>"):
        svg = re.sub(part, lambda found: re.sub(rb"(\.\d\d)\d+", rb"\1", found[0]), svg)
    svg = re.sub(rb'<path d="[^"]*"([^>]*)/>\s*(?:<path d="[^"]*"\1/>\s*)+', _joined, svg)
    return re.sub(rb'<use ([^>]*?) (style="[^"]*")/>\s*(?:<use [^>]*? \2/>\s*)+', _grouped, svg)


def _joined(found: re.Match[bytes]) -> bytes:
    """Draw paths of one style as one."""
    return b'<path d="' + b"".join(re.findall(rb'd="([^"]*)"', found[0])) + b'"' + found[1] + b"/>\n"


def _grouped(found: re.Match[bytes]) -> bytes:
    """Tell the style of neighbouring symbols once."""
    return b"<g " + found[2] + b">\n" + re.sub(rb'(<use [^>]*?) style="[^"]*"/>\s*', rb"\1/>\n", found[0]) + b"</g>\n"


def save(figure: Figure, path: str | os.PathLike) -> None:
    """Draw a figure into a file.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        What to draw; see `picture`.
    path : str or os.PathLike
        The suffix decides on the format: .png, .pdf or .svg.

    Raises
    ------
    OSError
        Names the file, and why it cannot be written; it is as it was then.
    """
    write_files({path: picture(figure, os.path.splitext(path)[1])})
