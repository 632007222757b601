"""A figure as a file: the same figure gives the same file, and its text is shown as it was written."""

import io
import os
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

    Returns
    -------
    bytes
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
    return stream.getvalue()


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
