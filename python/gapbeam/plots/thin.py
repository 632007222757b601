"""Thinning of pictures of very long beams: what no eye can part is drawn once, or drawing would take minutes."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import Collection, LineCollection, PathCollection, PolyCollection

MOST_SHAPES, MOST_POINTS = 5_000, 4_000
"""Symbols, lines or areas of a kind, and points of a curve, that are all drawn."""
APART = 0.4
"""Points (1/72 inch) between what can be seen side by side."""


def outline(x: np.ndarray, y: np.ndarray, width: float) -> tuple[np.ndarray, np.ndarray]:
    """Of a curve leave the first, the lowest, the highest and the last of the points that stand at one place.

    Parameters
    ----------
    x, y : numpy.ndarray
        The curve, from left to right; left as it is where it has few points.
    width : float
        Of the picture (points).
    """
    if len(x) <= MOST_POINTS:
        return x, y
    column = np.floor((x - x[0]) / (x[-1] - x[0]) * (width / APART))
    first = np.flatnonzero(np.append(True, np.diff(column) > 0))
    last = np.append(first[1:], len(x)) - 1
    by_height = np.lexsort((y, column))
    kept = np.unique(np.concatenate((first, by_height[first], by_height[last], last)))
    return x[kept], y[kept]


def coarse(x: np.ndarray, y: np.ndarray, off: float) -> tuple[np.ndarray, np.ndarray]:
    """Leave points of a curve out that are next to the chord of their neighbours: for the area under it, which has no edge.

    Parameters
    ----------
    x, y : numpy.ndarray
        The curve, from left to right.
    off : float
        How far off the chord they may be.

    Returns
    -------
    x, y : numpy.ndarray

    Examples
    --------
    >>> import numpy as np
    >>> coarse(np.arange(5.0), np.array([0.0, 1.0, 2.0, 3.0, 1.0]), 0.1)
    (array([0., 3., 4.]), array([0., 3., 1.]))
    """
    for _ in range(4):
        inner = np.arange(1, len(x) - 1, 2)
        left, right = inner - 1, inner + 1
        wide = x[right] - x[left]
        share = np.divide(x[inner] - x[left], wide, out=np.zeros(len(inner)), where=wide > 0.0)
        near = np.abs(y[left] + share * (y[right] - y[left]) - y[inner]) < off
        kept = np.ones(len(x), dtype=bool)
        kept[inner[near & (wide > 0.0) & (x[inner] > x[left]) & (x[inner] < x[right])]] = False
        x, y = x[kept], y[kept]
    return x, y


def thin(axes: Axes, collection: Collection) -> None:
    """Of symbols, lines or areas that stand at one place, as far as can be seen, leave the highest and the lowest.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        The panel.
    collection : matplotlib.collections.Collection
        In the panel; left as it is where it holds few.
    """
    symbols = isinstance(collection, PathCollection)
    shapes = collection.get_offsets() if symbols else [path.vertices for path in collection.get_paths()]
    if len(shapes) <= MOST_SHAPES:
        return
    low, high = shapes, shapes
    if not symbols:
        low, high = (np.array([extreme(shape, axis=0) for shape in shapes]) for extreme in (np.min, np.max))
    middle = axes.transData.transform((low + high) / 2)[:, 0]
    column = np.round(middle * 72 / axes.figure.dpi / APART)
    kept = np.zeros(len(shapes), dtype=bool)
    for height in (high[:, 1], -low[:, 1]):
        order = np.lexsort((height, column))
        kept[order[np.append(np.diff(column[order]) > 0, True)]] = True
    chosen = np.flatnonzero(kept)
    if symbols:
        collection.set_offsets(shapes[chosen])
    elif isinstance(collection, LineCollection):
        collection.set_segments([shapes[k] for k in chosen])
    elif isinstance(collection, PolyCollection):
        collection.set_verts([shapes[k][:-1] for k in chosen])
    widths = np.asarray(collection.get_linewidths())
    if len(widths) == len(shapes):
        collection.set_linewidths(widths[chosen])
