"""The verbs of results that draw and write; matplotlib, rich and jinja2 are loaded when first called."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from ..base.files import write_files
from ..results.result import Result
from ..scene.wording import choice, shown
from .notebook import html_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def plot(
    result: Result, kind: str | None = None, path: str | os.PathLike | None = None, ax: Axes | None = None,
    support: int | str | None = None,
) -> Figure:  # fmt: skip
    """Draw a result.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.
    kind, path, ax, support
        As for `Shown.plot`.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    ValueError
        There is no such picture, or an `ax` for one that has panels of its own.
    """
    from ..plots import figure, hysteresis_figure, path_figure
    from ..plots.diagram import draw_diagram
    from ..plots.save import picture, save

    fields = list(result.beam.fields)
    whole = {None: figure, "path": path_figure, "hysteresis": lambda one: hysteresis_figure(one, support)}
    if kind not in (*whole, *fields):
        raise ValueError(f"kind: expected None, {choice(map(shown, ['path', 'hysteresis', *fields]))}, got {shown(kind)}")
    if support is not None and kind != "hysteresis":
        raise ValueError(f'support: only a picture of one support needs it, kind = "hysteresis"; got {shown(support)}')
    if kind in fields:
        drawn = draw_diagram(result, kind, ax)
    elif ax is not None:
        raise ValueError(f"ax: this picture has panels of its own; give one field to draw there, as kind = {shown(fields[2])}")
    else:
        drawn = whole[kind](result)
    if path is not None:
        if os.path.splitext(path)[1].lower() not in (".png", ".pdf", ".svg"):
            raise ValueError(f"path: expected a file that ends in .png, .pdf or .svg, got {shown(os.fspath(path))}")
        save(drawn, path)
    if ax is None:
        drawn._repr_png_ = _Bytes(picture, drawn)  # notebooks show it, with or without pyplot
    return drawn


class _Bytes:
    """A picture as PNG, made when it is asked for."""

    def __init__(self, picture: Any, drawn: Figure) -> None:
        self._picture, self._drawn = picture, drawn

    def __call__(self) -> bytes:
        return self._picture(self._drawn, ".png")


def report(result: Result) -> str:
    """Write the report of a result.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.

    Returns
    -------
    str
    """
    from ..report import report_text

    return report_text(result)


def to_json(result: Result, path: str | os.PathLike | None = None, points: int = 20) -> str:
    """Write a result as JSON.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.
    path : str or os.PathLike, optional
        File to write as well.
    points : int
        Divisions of each span in the table of fields.

    Returns
    -------
    str
    """
    from ..report import to_json as as_json

    text = as_json(result, points)
    if path is not None:
        write_files({path: [text]})
    return text


def to_html(result: Result, path: str | os.PathLike | None = None) -> str:
    """Write a result as a page of HTML.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.
    path : str or os.PathLike, optional
        File to write as well.

    Returns
    -------
    str
    """
    from ..html.page import html_page

    text = html_page(result)
    if path is not None:
        write_files({path: [text]})
    return text


def notebook(result: Result) -> str:
    """Write what a notebook shows of a result.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.

    Returns
    -------
    str
    """
    from ..plots import figure
    from ..plots.save import picture

    return html_of(result, lambda: picture(figure(result), ".svg"))
