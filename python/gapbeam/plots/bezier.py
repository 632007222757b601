"""Curves of fields as cubic Bezier pieces: control points as plain arrays, for whatever draws them.

Between places where something changes, moment, shear and axial force are polynomials of degree three at most, so that one cubic
is the field itself. Deflections are of degree five at most and are cut into some cells; so are fields on the ground.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from ..results.result import Result
    from ..results.state.fields import Fields

MOVE, LINE, CURVE = 1, 2, 4
"""Codes of the vertices of a path, as matplotlib has them; a curve has three vertices."""
TO_CONTROL = np.array([[6.0, 0.0, 0.0, 0.0], [-5.0, 18.0, -9.0, 2.0], [2.0, -9.0, 18.0, -5.0], [0.0, 0.0, 0.0, 6.0]]) / 6.0
"""From the values of a cubic at 0, 1/3, 2/3, 1 to its control points."""


SIXTHS = np.array([1.0, 3.0, 5.0]) / 6.0
AT_SIXTHS = np.array([[5.0, 15.0, -5.0, 1.0], [-1.0, 9.0, 9.0, -1.0], [1.0, -5.0, 15.0, 5.0]]) / 16.0
"""Places in a cell, and from the values of a cubic at 0, 1/3, 2/3, 1 to those there."""
SEEN, MOST_HALVINGS = 2e-3, 12
"""Share of the range of a field that is seen, and how often a cell is halved to show it."""


@dataclass(frozen=True, eq=False)
class Cells:
    """Cells of a beam, in which every field is as good as a cubic, and the fields at four places of each.

    Attributes
    ----------
    x : numpy.ndarray
        Cells by 4: the ends, and the places at a third and at two thirds.
    values : dict of str to numpy.ndarray
        By field, of the same shape.
    """

    x: np.ndarray
    values: dict[str, np.ndarray]

    def control_points(self, quantity: str) -> np.ndarray:
        """Give the control points of a field.

        Parameters
        ----------
        quantity : str
            The field.

        Returns
        -------
        numpy.ndarray
            Cells by 4 by 2: place and value. The curve begins in the first and ends in the last of the four.
        """
        return np.stack((self.x, _control_values(self.values[quantity])), axis=-1)

    def along(self, quantity: str) -> tuple[np.ndarray, np.ndarray]:
        """Give places and values from left to right, both sides where a field jumps."""
        return self.x.ravel(), self.values[quantity].ravel()


def _control_values(values: np.ndarray) -> np.ndarray:
    """Turn values of cubics at 0, 1/3, 2/3 and 1 into those of their control points.

    Examples
    --------
    >>> import numpy as np
    >>> t = np.array([[0.0, 1 / 3, 2 / 3, 1.0]])
    >>> _control_values(t**3 - t).round(12).tolist()  # -3 b = c, the slope at 0
    [[0.0, -0.333333333333, -0.666666666667, 0.0]]
    """
    found = values @ TO_CONTROL.T
    found[:, [0, 3]] = values[:, [0, 3]]
    return found


def cells_of(result: Result, step: int, cells: int) -> Cells:
    """Cut the beam into cells, and ask for its fields.

    Parameters
    ----------
    result : Result
        What `gapbeam.solve` returned.
    step : int
        Load step.
    cells : int
        In a span, beside all places where something changes.
    """
    ends = result.fields(step, points=cells)
    left = np.flatnonzero(np.diff(ends.x) > 0.0)
    low, wide = ends.x[left], np.diff(ends.x)[left]
    inner = result.at(np.concatenate((low + wide / 3.0, low + wide * (2.0 / 3.0))), step)
    tables = [(name, column, getattr(inner, name)) for name, column in ends.columns().items()]
    of = {name: np.column_stack((column[left], *between.reshape(2, -1), column[left + 1])) for name, column, between in tables}
    if result._beam.has_axial_force:
        of = _halved(of, lambda x: result.at(x, step))
    return Cells(of.pop("x"), of)


def _halved(of: dict[str, np.ndarray], at: Callable[[np.ndarray], Fields]) -> dict[str, np.ndarray]:
    """Halve cells in which a field is no cubic to the eye: beside supports a beam in tension bends within a short length."""
    size = {name: SEEN * np.ptp(values) for name, values in of.items()}
    done = []
    for _ in range(MOST_HALVINGS):
        low, wide = of["x"][:, 0], of["x"][:, 3] - of["x"][:, 0]
        found = at((low + wide * SIXTHS[:, None]).ravel())
        between = {name: getattr(found, name).reshape(3, -1).T for name in of}
        off = [np.abs(values @ AT_SIXTHS.T - between[name]).max(axis=1) > size[name] for name, values in of.items()]
        rough = np.any(off, axis=0)
        done.append({name: values[~rough] for name, values in of.items()})
        if not rough.any():
            break
        every = {name: np.insert(values[rough], [1, 2, 3], between[name][rough], axis=1) for name, values in of.items()}
        of = {name: np.concatenate((values[:, :4], values[:, 3:])) for name, values in every.items()}
    else:
        done.append(of)
    order = np.argsort(np.concatenate([one["x"][:, 0] for one in done]), kind="stable")
    return {name: np.concatenate([one[name] for one in done])[order] for name in of}


def path_of(points: np.ndarray, flat: float) -> tuple[np.ndarray, np.ndarray]:
    """Chain cubics into one path, lines where they are straight.

    Parameters
    ----------
    points : numpy.ndarray
        Control points, cells by 4 by 2, from left to right. Where one cell does not begin where the one before ends, a line
        leads there: a jump.
    flat : float
        Height below which a curve is drawn as a line.

    Returns
    -------
    vertices, codes : numpy.ndarray
        As of `matplotlib.path.Path`.

    Examples
    --------
    >>> import numpy as np
    >>> straight = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]])
    >>> vertices, codes = path_of(np.stack((straight, straight + (3.0, 1.0))), 0.01)
    >>> vertices.tolist(), codes.tolist()
    ([[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [6.0, 1.0]], [1, 2, 2, 2])
    """
    thirds = np.array([1.0, 2.0]) / 3.0
    y = points[:, :, 1]
    chord = y[:, :1] + (y[:, 3:] - y[:, :1]) * thirds
    straight = (np.abs(y[:, 1:3] - chord) <= flat).all(axis=1) | (points[:, 1:3] == points[:, (0, 3)]).all(axis=(1, 2))
    jump = np.append(True, (points[1:, 0] != points[:-1, 3]).any(axis=1))
    codes = np.full((len(points), 4), CURVE, dtype=np.uint8)
    codes[:, 0] = LINE
    codes[straight, 3] = LINE
    kept = np.column_stack((jump, ~straight, ~straight, np.ones(len(points), dtype=bool)))
    vertices, codes = points[kept], codes[kept]
    codes[0] = MOVE
    return vertices, codes


def smooth(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Round a curve of which points are known: between them it rises where they rise, and nowhere else.

    Slopes are those of Fritsch and Carlson (1980): harmonic means of those to both neighbours, zero where the curve turns.

    Parameters
    ----------
    x, y : numpy.ndarray
        Points from left to right; where it jumps two at a place, or next to it.

    Returns
    -------
    numpy.ndarray
        Control points, as for `path_of`.

    Examples
    --------
    >>> import numpy as np
    >>> smooth(np.array([0.0, 3.0, 6.0]), np.array([0.0, 3.0, 6.0]))[0].tolist()
    [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [3.0, 3.0]]
    """
    known = np.isfinite(y)
    x, y = x[known], y[known]
    wide = np.diff(x)
    steep = wide > 1e-7 * (x[-1] - x[0]) if len(x) else wide > 0.0
    slope = np.divide(np.diff(y), wide, out=np.zeros(len(wide)), where=steep)
    inner = np.zeros(len(x))
    if len(slope) > 1:
        left, right, both = slope[:-1], slope[1:], steep[:-1] & steep[1:]
        rising = both & (left * right > 0.0)
        inner[1:-1] = np.where(both, np.divide(2.0 * left * right, left + right, out=np.zeros(len(left)), where=rising), 0.0)
        inner[1:-1] = np.where(steep[:-1] & ~steep[1:], left, np.where(~steep[:-1] & steep[1:], right, inner[1:-1]))
    if len(slope):
        inner[0], inner[-1] = slope[0], slope[-1]
    third = np.where(steep, wide, 0.0) / 3.0
    low, high = np.column_stack((x[:-1], y[:-1])), np.column_stack((x[1:], y[1:]))
    first = low + np.column_stack((third, inner[:-1] * third))
    second = high - np.column_stack((third, inner[1:] * third))
    return np.stack((low, first, second, high), axis=1)
