"""The verbs of results that draw and write; matplotlib, rich, jinja2 and xlsxwriter are loaded when first called."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from ..base.files import write_files
from ..batches.summary import Summary
from ..batches.verbs import ManyVerbs
from ..results.answer import answer as answer_of_result
from ..results.answer import headline
from ..results.cases.solved_cases import Cases
from ..results.envelopes.verbs import PartVerbs
from ..results.result import Result
from ..scene.wording import choice, shown
from .excel import write_excel
from .many import batch_answer, cases_answer, cases_summary, part_answer, part_report
from .notebook import html_of, html_of_lines

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_UNASKED = 100_000
"""Cases of a batch up to which a notebook shows histograms."""


def _whole(result: Any) -> Any:
    """Give the result of one case for that case, anything else as it is."""
    return result.result() if isinstance(result, Cases) and not result._shape else result


def answer(result: Any) -> list[str]:
    """Give the answer in a few lines.

    Parameters
    ----------
    result : Result, Envelope, TrainResult, Cases, Batch or Summary
        Of what.
    """
    result = _whole(result)
    if isinstance(result, PartVerbs):
        return part_answer(result)
    if isinstance(result, Cases):
        return cases_answer(result)
    if isinstance(result, ManyVerbs):
        return batch_answer(result)
    return [headline(result), *answer_of_result(result)]


def plot(
    result: Any, kind: str | None = None, path: str | os.PathLike | None = None, ax: Axes | None = None,
    support: int | str | None = None,
) -> Figure:  # fmt: skip
    """Draw a result.

    Parameters
    ----------
    result : Result, Envelope, TrainResult, Cases, Batch or Summary
        Of what.
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
    from ..plots.save import picture, save

    result = _whole(result)
    drawn = _pictures(result, kind, ax, support)
    if path is not None:
        if os.path.splitext(path)[1].lower() not in (".png", ".pdf", ".svg"):
            raise ValueError(f"path: expected a file that ends in .png, .pdf or .svg, got {shown(os.fspath(path))}")
        save(drawn, path)
    if ax is None:
        drawn._repr_png_ = _Bytes(picture, drawn)  # notebooks show it, with or without pyplot
    return drawn


def _pictures(result: Any, kind: str | None = None, ax: Axes | None = None, support: int | str | None = None) -> Figure:
    """Draw the picture that is meant."""
    from ..plots import figure, hysteresis_figure, path_figure
    from ..plots.batch import summary_figure
    from ..plots.diagram import draw_diagram, draw_table, draw_tables

    if support is not None and kind != "hysteresis":
        raise ValueError(f'support: only a picture of one support needs it, kind = "hysteresis"; got {shown(support)}')
    if isinstance(result, ManyVerbs):
        summary = result if isinstance(result, Summary) else None
        names = list(summary.columns if summary is not None else result.results)
        _expect(kind, names)
        _one_picture(ax, None)
        if summary is None:
            return summary_figure(result.summary(None if kind is None else [kind]))
        return summary_figure(summary._only(kind) if kind is not None else summary)
    is_result = isinstance(result, Result)
    fields = list(result._beam.fields if is_result else result.extremes)
    _expect(kind, ["path", "hysteresis", *fields] if is_result else fields)
    if kind in fields:
        return draw_diagram(result, kind, ax) if is_result else draw_table(result.scene, result.table("fields"), kind, ax)
    _one_picture(ax, fields[2])
    if isinstance(result, Cases):
        return summary_figure(cases_summary(result))
    if isinstance(result, PartVerbs):
        return draw_tables(result.scene, result.table("fields"), part_answer(result)[0])
    if kind == "hysteresis":
        return hysteresis_figure(result, support)
    return path_figure(result) if kind == "path" else figure(result)


def _expect(kind: str | None, kinds: list[str]) -> None:
    if kind is not None and kind not in kinds:
        raise ValueError(f"kind: expected None, {choice(map(shown, kinds))}, got {shown(kind)}")


def _one_picture(ax: Axes | None, field: str | None) -> None:
    if ax is not None:
        instead = "leave ax out" if field is None else f"give one field to draw there, as kind = {shown(field)}"
        raise ValueError(f"ax: this picture has panels of its own; {instead}")


class _Bytes:
    """A picture as PNG, made when it is asked for."""

    def __init__(self, picture: Any, drawn: Figure) -> None:
        self._picture, self._drawn = picture, drawn

    def __call__(self) -> bytes:
        return self._picture(self._drawn, ".png")


def report(result: Any) -> str:
    """Write the report of a result.

    Parameters
    ----------
    result : Result, Envelope, TrainResult, Cases, Batch or Summary
        Of what.
    """
    from ..report import report_text
    from ..report.batch import summary_text

    result = _whole(result)
    if isinstance(result, PartVerbs):
        return part_report(result)
    if isinstance(result, Cases):
        table = result.table("supports")
        return "\n".join([*cases_answer(result), "", "Supports", repr(table), "", summary_text(cases_summary(result))])
    if isinstance(result, ManyVerbs):
        return summary_text(result if isinstance(result, Summary) else result.summary())
    return report_text(result)


def to_json(result: Any, path: str | os.PathLike | None = None, points: int = 20) -> str:
    """Write a result as JSON.

    Parameters
    ----------
    result : Result, Envelope, TrainResult, Cases, Batch or Summary
        Of what.
    path : str or os.PathLike, optional
        File to write as well.
    points : int
        Divisions of each span in the table of fields.
    """
    from ..report import data_as_json
    from ..report import to_json as as_json

    result = _whole(result)
    text = as_json(result, points) if isinstance(result, Result) else data_as_json(result.to_dict())
    if path is not None:
        write_files({path: [text]})
    return text


def to_excel(result: Any, path: str | os.PathLike) -> None:
    """Write the answer and all tables of a result as an Excel file.

    Parameters
    ----------
    result : Result, Envelope, TrainResult, Cases, Batch or Summary
        Of what.
    path : str or os.PathLike
        File to write.

    Raises
    ------
    ValueError
        The name does not end in .xlsx.
    ImportError
        xlsxwriter is not installed.
    """
    if os.path.splitext(path)[1].lower() != ".xlsx":
        raise ValueError(f"path: expected a file that ends in .xlsx, got {shown(os.fspath(path))}")
    write_excel(_whole(result), answer(result), path)


def to_html(result: Any, path: str | os.PathLike | None = None) -> str:
    """Write a result as a page of HTML.

    Parameters
    ----------
    result : Result, Envelope or TrainResult
        Of one load or of combinations; of a part of a result that whole result is shown.
    path : str or os.PathLike, optional
        File to write as well.

    Raises
    ------
    ValueError
        These are many cases.
    """
    from ..html.page import html_page

    result = _whole(result)
    result = result._result if isinstance(result, PartVerbs) else result
    if not isinstance(result, Result):
        of = "cases.result(0)" if isinstance(result, Cases) else "gapbeam.solve(batch.scene_of(0))"
        raise ValueError(f"to_html: a page shows one result, and these are many; take that of a case, {of}.to_html(path)")
    text = html_page(result)
    if path is not None:
        write_files({path: [text]})
    return text


def notebook(result: Any) -> str:
    """Write what a notebook shows of a result.

    Parameters
    ----------
    result : Result, Envelope, TrainResult, Cases, Batch or Summary
        Of what.
    """
    from ..plots.save import picture

    result = _whole(result)

    def drawn() -> bytes:
        return picture(_pictures(result), ".svg")

    if isinstance(result, Result):
        return html_of(result, answer(result), drawn)
    return html_of_lines(answer(result), _table(result), drawn if _is_small(result) else None)


def _table(result: Any) -> Any:
    """Give the table that a notebook shows."""
    if isinstance(result, Summary):
        return result.table()
    if isinstance(result, ManyVerbs):
        return result.table("results") if _is_small(result) else None
    return result.table("supports")


def _is_small(result: Any) -> bool:
    """Whether a picture is made unasked."""
    return isinstance(result, Summary) or getattr(result, "done", 0) <= MOST_UNASKED
