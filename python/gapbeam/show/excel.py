"""The answer and the tables of a result as an Excel file."""

from __future__ import annotations

import io
from collections.abc import Mapping
from math import isfinite
from typing import Any

import numpy as np

from ..base.files import write_files
from ..results.views.columns import Columns

MOST_ROWS = 1_048_576
"""Rows of a sheet of Excel, the headings included."""
WIDEST = 40
"""Characters of a column at most."""


def excel_bytes(lines: list[str], tables: Mapping[str, Columns]) -> bytes:
    """Make the contents of an Excel file: a sheet with the answer, and one for every table.

    Parameters
    ----------
    lines : list of str
        The answer.
    tables : mapping of Columns
        By name of the sheet.

    Raises
    ------
    ImportError
        xlsxwriter is not installed.
    ValueError
        A table has more rows than a sheet.
    """
    try:
        import xlsxwriter
    except ImportError:
        raise ImportError('to_excel() needs xlsxwriter: pip install "gapbeam[excel]", or pip install xlsxwriter') from None
    for name, table in tables.items():
        if table.count >= MOST_ROWS:
            raise ValueError(f"to_excel: the table {name} has {table.count:,} rows, and a sheet of Excel {MOST_ROWS - 1:,}; "
                             f'write table("{name}").to_pandas().to_csv(path) instead')  # fmt: skip
    file = io.BytesIO()
    options = {"in_memory": True, "strings_to_formulas": False, "strings_to_urls": False, "strings_to_numbers": False}
    book = xlsxwriter.Workbook(file, options)
    bold = book.add_format({"bold": True, "bottom": 1})
    sheet = book.add_worksheet("answer")
    sheet.set_column(0, 0, 100)
    for k, line in enumerate("\n".join(lines).split("\n")):
        sheet.write_string(k, 0, line)
    for name, table in tables.items():
        sheet = book.add_worksheet(name)
        sheet.freeze_panes(1, 0)
        for k, (heading, column) in enumerate(table.items()):
            sheet.set_column(k, k, min(len(heading) + 2, WIDEST))
            sheet.write_string(0, k, heading, bold)
            for row, value in enumerate(column.tolist() if isinstance(column, np.ndarray) else column, 1):
                _write(sheet, row, k, value)
    book.close()
    return file.getvalue()


def _write(sheet: Any, row: int, column: int, value: Any) -> None:
    """Write a cell; what is not there, or is not a number, is left empty."""
    if isinstance(value, bool):
        sheet.write_boolean(row, column, value)
    elif isinstance(value, int | float):
        if isfinite(value):
            sheet.write_number(row, column, value)
        elif value == value:
            sheet.write_string(row, column, str(value))
    elif value is not None:
        sheet.write_string(row, column, str(value))


def tables_of(result: Any) -> dict[str, Columns]:
    """Give all tables of a result that have rows.

    Parameters
    ----------
    result : Result, Envelope, TrainResult, Cases, Batch or Summary
        Whose they are.

    Returns
    -------
    dict of Columns
        By kind.
    """
    return {kind: table for kind in result._kinds if (table := result.table(kind)).count}


def write_excel(result: Any, lines: list[str], path: Any) -> None:
    """Write the answer and all tables of a result.

    Parameters
    ----------
    result : Result, Envelope, TrainResult, Cases, Batch or Summary
        What is written.
    lines : list of str
        Its answer.
    path : str or os.PathLike
        File to write.

    Raises
    ------
    ImportError, ValueError
        As for `excel_bytes`.
    """
    write_files({path: excel_bytes(lines, tables_of(result))})
