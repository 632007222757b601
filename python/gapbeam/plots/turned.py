"""Axes whose horizontal and vertical directions are exchanged, for beams that stand upright, such as piles.

What is drawn below a lying beam stands to the right of an upright one, and x runs downward.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import Collection, LineCollection, PolyCollection
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.transforms import Affine2D, ScaledTranslation, Transform

MIRROR = np.array([[0.0, -1.0], [-1.0, 0.0]])
"""From points to the right and upward to the same, turned."""
ACROSS = {"top": "left", "bottom": "right", "center": "center"}
ALONG = {"left": "top", "right": "bottom", "center": "center"}
"""Alignments of texts, from those beside a lying beam."""


class Turned:
    """Axes to draw a beam on as if it lay.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        Where it stands.
    sign : float
        -1 where heights above the beam go to the left, 1 for values that go to the right.
    """

    turned = True

    def __init__(self, axes: Axes, sign: float) -> None:
        self.axes, self.sign, self.figure = axes, sign, axes.figure

    @property
    def bbox(self) -> Any:
        """Where the axes are."""
        return self.axes.bbox

    def plot(self, x: Any, y: Any, *style: str, **look: Any) -> list:
        """Draw a line."""
        if look.get("marker") is not None:
            look["marker"] = _marker(look["marker"])
        return self.axes.plot(self.sign * np.asarray(y, dtype=float), x, *style, **look)

    def scatter(self, x: Any, y: Any, marker: Any = "o", **look: Any) -> Collection:
        """Draw symbols."""
        return self.axes.scatter(self.sign * np.asarray(y, dtype=float), x, marker=_marker(marker), **look)

    def fill_between(self, x: Any, first: Any, second: Any = 0.0, **look: Any) -> Collection:
        """Fill between two curves."""
        return self.axes.fill_betweenx(x, self.sign * np.asarray(first), self.sign * np.asarray(second), **look)

    def add_collection(self, collection: Collection) -> Collection:
        """Add lines or areas."""
        if isinstance(collection, LineCollection):
            collection.set_segments([self._turn(line) for line in collection.get_segments()])
        elif isinstance(collection, PolyCollection):
            collection.set_verts([self._turn(path.vertices[:-1]) for path in collection.get_paths()])
        return self.axes.add_collection(collection)

    def add_artist(self, patch: PathPatch) -> PathPatch:
        """Add a path."""
        path = patch.get_path()
        patch.set_path(Path(self._turn(path.vertices), path.codes))
        return self.axes.add_artist(patch)

    def text(self, x: float, y: float, words: str, ha: str = "center", va: str = "top", **look: Any) -> Any:
        """Write beside the beam what would stand below or above a lying one."""
        return self.axes.text(self.sign * y, x, words, ha=ACROSS[va], va=ALONG[ha], **look)

    def annotate(self, words: str, xy: Any, xytext: Any = None, ha: str = "center", va: str = "top", **look: Any) -> Any:
        """Write with an offset in points; arrows in transforms of their own stay as they are."""
        if isinstance(look.get("xycoords"), Transform):
            return self.axes.annotate(words, xy=xy, xytext=xytext, **look)
        (x, y), (right, up) = xy, xytext
        return self.axes.annotate(words, (self.sign * y, x), (-up, -right), ha=ACROSS[va], va=ALONG[ha], **look)

    def axvline(self, x: float, **look: Any) -> Any:
        """Draw a line across the beam."""
        return self.axes.axhline(x, **look)

    def axhline(self, y: float, **look: Any) -> Any:
        """Draw a line along the beam."""
        return self.axes.axvline(self.sign * y, **look)

    def get_xlim(self) -> tuple[float, float]:
        """Give the ends of what is drawn along the beam."""
        low, high = self.axes.get_ylim()
        return min(low, high), max(low, high)

    def get_ylim(self) -> tuple[float, float]:
        """Give the limits across."""
        low, high = self.axes.get_xlim()
        return (low, high) if self.sign > 0.0 else (-high, -low)

    def set_ylim(self, low: float, high: float) -> None:
        """Set the limits across; values always rise to the right."""
        low, high = min(low, high), max(low, high)
        self.axes.set_xlim((low, high) if self.sign > 0.0 else (-high, -low))

    def yaxis_inverted(self) -> bool:
        """Whether large values are below: never."""
        return False

    def set_axis_off(self) -> None:
        """Draw no frame."""
        self.axes.set_axis_off()

    def _turn(self, points: np.ndarray) -> np.ndarray:
        return np.asarray(points)[:, ::-1] * (self.sign, 1.0)


def _marker(marker: str | Path) -> str | Path:
    """Turn a symbol with its beam."""
    if isinstance(marker, str):
        return {"|": "_", "_": "|"}.get(marker, marker)
    return Path(marker.vertices @ MIRROR.T, marker.codes)


def is_turned(axes: Axes | Turned) -> bool:
    """Whether the beam stands upright."""
    return isinstance(axes, Turned)


def raw(axes: Axes | Turned) -> Axes:
    """Give the axes of matplotlib."""
    return axes.axes if isinstance(axes, Turned) else axes


def shifted(axes: Axes | Turned, points: float) -> Transform:
    """Make the transform of a panel, moved along the beam by some points."""
    by = (0.0, -points / 72) if is_turned(axes) else (points / 72, 0.0)
    return raw(axes).transData + ScaledTranslation(*by, axes.figure.dpi_scale_trans)


def points_from(axes: Axes | Turned, x: float) -> Transform:
    """Make the transform that measures points along the beam and upward from a place on its axis."""
    turn = Affine2D(np.block([[MIRROR, np.zeros((2, 1))], [np.zeros((1, 2)), np.ones((1, 1))]])) if is_turned(axes) else Affine2D()
    place = (0.0, x) if is_turned(axes) else (x, 0.0)
    return turn + Affine2D().scale(1.0 / 72.0) + axes.figure.dpi_scale_trans + ScaledTranslation(*place, raw(axes).transData)
