"""Tables: columns by name."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ...scene.wording import choice, shown
from .. import formatting as fmt

if TYPE_CHECKING:
    import pandas as pd

ROWS = 20
"""Rows that are shown."""


class Columns(dict):
    """The columns of a table by name, each an array or a list with an entry for every row.

    Examples
    --------
    >>> Columns({"support": ["A", "B"], "reaction": np.array([2.5, -1.0])})
    support  reaction
    A        2.5
    B        -1
    """

    @property
    def count(self) -> int:
        """Rows."""
        return len(next(iter(self.values()))) if self else 0

    def rows(self, most: int | None = None) -> list[list[str]]:
        """Word the rows.

        Parameters
        ----------
        most : int, optional
            Rows that are given; default all.

        Returns
        -------
        list of list of str
        """
        return [list(row) for row in zip(*([_word(one) for one in column[:most]] for column in self.values()), strict=True)]

    def __repr__(self) -> str:
        """Show the first rows."""
        rows = [list(self), *self.rows(ROWS)]
        wide = [max(map(len, column)) for column in zip(*rows, strict=True)]
        lines = ["  ".join(word.ljust(width) for word, width in zip(row, wide, strict=True)).rstrip() for row in rows]
        return "\n".join([*lines, *([f"... {self.count:,} rows"] if self.count > ROWS else [])])

    def to_pandas(self) -> pd.DataFrame:
        """As a DataFrame.

        Returns
        -------
        pandas.DataFrame

        Raises
        ------
        ImportError
            pandas is not installed.
        """
        try:
            import pandas as pd
        except ImportError:
            raise ImportError("to_pandas() needs pandas: pip install pandas") from None
        return pd.DataFrame(dict(self))


def _word(value: Any) -> str:
    if isinstance(value, float | np.floating):
        return fmt.number(float(value))
    return "" if value is None else str(value)


def one_of(kind: str, kinds: Sequence[str] | Mapping[str, Any]) -> str:
    """Take one of some words.

    Parameters
    ----------
    kind : str
        What the caller gave.
    kinds : sequence or mapping of str
        What there is.

    Raises
    ------
    ValueError
        It is none of them.
    """
    if not isinstance(kind, str) or kind not in kinds:
        raise ValueError(f"kind: expected {choice(map(shown, kinds))}, got {shown(kind)}")
    return kind
