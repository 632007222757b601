"""Loads drawn beside the beam."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.path import Path

from .labels import LINE
from .loads import ARC, BETWEEN, Arrow, Block, LoadLanes
from .states import HEAD, area, mirrored
from .turned import Turned, points_from


def draw_loads(axes: Axes | Turned, lanes: LoadLanes) -> None:
    """Draw all loads at their full size.

    Parameters
    ----------
    axes : matplotlib.axes.Axes or Turned
        The panel; its vertical unit is one point.
    lanes : LoadLanes
        The loads, and where to draw them.
    """
    if lanes.blocks:
        _draw_blocks(axes, lanes)
    _draw_forces(axes, lanes)
    _draw_couples(axes, lanes)
    if lanes.note:
        axes.text(lanes.end / 2, lanes.top - LINE - 1.0, lanes.note, fontsize=6.8, ha="center", va="bottom", zorder=7)
    _lead(axes, lanes)
    for arrow in lanes.arrows:
        if arrow.kind == "axial":
            _draw_axial(axes, arrow, lanes)
        if arrow.label:
            axes.annotate(arrow.text, (arrow.x, arrow.label[1]), (arrow.label[0], 0.0), textcoords="offset points",
                          fontsize=6.8, ha="center", va="bottom", zorder=7)  # fmt: skip


def _lead(axes: Axes | Turned, lanes: LoadLanes) -> None:
    """Lead from labels that are off to their arrows."""
    lines = []
    for arrow, length in zip(lanes.arrows, lanes.lengths, strict=True):
        if arrow.kind == "force" and arrow.label:
            tip, off = lanes.tip(arrow, length), arrow.label[0] - arrow.aside
            if arrow.label[1] - tip > LINE or (lanes.upright and abs(off) > LINE / 2):
                x = arrow.x + arrow.aside / lanes.scale
                lines.append([(x, tip), (x + off * lanes.upright / lanes.scale, arrow.label[1])])
    axes.add_collection(LineCollection(lines, colors="0.6", linewidths=0.4, zorder=5, label="leaders"))


def _draw_blocks(axes: Axes | Turned, lanes: LoadLanes) -> None:
    blocks = lanes.blocks
    groups: dict[str, list] = {"down": [], "up": [], "curvature": []}
    ticks, heads = [], {1.0: [], -1.0: []}
    for block in blocks:
        y = lanes.base + lanes.lane * block.lane
        if block.curvature:
            groups["curvature"].append([(block.start, y), (block.start, y + 5), (block.stop, y + 5), (block.stop, y)])
        else:
            for start, stop, left, right, sign in _onesigned(block, *lanes.heights(block)):
                corners = [(start, y), (start, y + left), (stop, y + right), (stop, y)]
                groups["down" if sign > 0 else "up"].append(corners)
                _block_arrows(start, stop, (left, right), y, lanes.scale, sign, ticks, heads)
    if lanes.labelled:
        _label_blocks(axes, lanes)
    width = 0.5 if len(blocks) <= 60 else 0.2
    styles = {"down": ("0.9", None), "up": ("white", "----"), "curvature": ("white", "//////")}
    for name, corners in groups.items():
        if corners:
            face, hatch = styles[name]
            hatch = hatch if len(blocks) <= 500 else None  # too fine to see, and slow
            axes.add_collection(PolyCollection(corners, facecolors=face, edgecolors="0.35", linewidths=width, hatch=hatch,
                                               zorder=2, label=f"distributed {name}"))  # fmt: skip
    axes.add_collection(LineCollection(ticks, colors="0.35", linewidths=0.5, zorder=2))
    for sign, points in heads.items():
        if points:
            _heads(axes, points, sign, 3.2, "0.35")


def _onesigned(block: Block, first: float, last: float) -> list[tuple[float, float, float, float, float]]:
    """Cut a block where its load changes sign: both ends of every part, its heights there, and its sign."""
    if not min(block.first, block.last) < 0.0 < max(block.first, block.last):
        return [(block.start, block.stop, first, last, 1.0 if block.first + block.last >= 0.0 else -1.0)]
    zero = block.start + (block.stop - block.start) * first / (first + last)
    sign = 1.0 if block.first > 0.0 else -1.0
    return [(block.start, zero, first, 0.0, sign), (zero, block.stop, 0.0, last, -sign)]


def _block_arrows(
    start: float, stop: float, heights: tuple[float, float], y: float, scale: float, sign: float, ticks: list, heads: dict
) -> None:
    """Fill a block with small arrows where it is wide and high enough for them."""
    pieces = int((stop - start) * scale / BETWEEN)
    if not 1 <= pieces <= 200:
        return
    for share in np.linspace(0.0, 1.0, pieces + 1):
        height = heights[0] + (heights[1] - heights[0]) * share
        if height > 4.0:
            x = start + (stop - start) * share
            ticks.append([(x, y), (x, y + height)])
            heads[sign].append((x, y if sign > 0 else y + height))


def _label_blocks(axes: Axes | Turned, lanes: LoadLanes) -> None:
    """Write the labels of blocks; where many are narrow, the unit once for all."""
    for block in lanes.blocks:
        if block.label is None:
            continue
        x, above, text, crossed = block.label
        behind = {"bbox": {"facecolor": "white", "edgecolor": "none", "pad": 0.3, "alpha": 0.85}} if crossed else {}
        axes.text(x, lanes.base + lanes.lane * block.lane + above, text, fontsize=6.8 - 0.8 * lanes.short, ha="center",
                  va="bottom", zorder=7, **behind)  # fmt: skip
    for lane in {block.lane for block in lanes.blocks} if lanes.short else ():
        y = lanes.base + lanes.lane * lane
        text = next((lanes.unit for block in lanes.blocks if block.lane == lane and not block.curvature), "")
        axes.annotate(text, (0.0, y), (-4, 0), textcoords="offset points", fontsize=6.8, ha="right", va="bottom")


def _heads(axes: Axes | Turned, points: list, sign: float, size: float, colour: str) -> None:
    """Draw arrow heads with their tips in the points, downward for a positive sign."""
    x, y = np.transpose(points)
    axes.scatter(x, y, marker=mirrored(HEAD, -sign), s=area(size), c=colour, linewidths=0, zorder=6)


def _draw_forces(axes: Axes | Turned, lanes: LoadLanes) -> None:
    forces = [(arrow, length) for arrow, length in zip(lanes.arrows, lanes.lengths, strict=True) if arrow.kind == "force"]
    width = 1.1 if len(forces) <= 60 else 0.6
    places = [arrow.x + arrow.aside / lanes.scale for arrow, _ in forces]
    lines = [
        [(x, lanes.foot(arrow)), (x, lanes.tip(arrow, length))] for x, (arrow, length) in zip(places, forces, strict=True)
    ]
    axes.add_collection(LineCollection(lines, colors="black", linewidths=width, zorder=6, label="forces"))
    for sign in (1.0, -1.0):
        points = [
            (x, lanes.foot(arrow) if sign > 0 else lanes.tip(arrow, length))
            for x, (arrow, length) in zip(places, forces, strict=True) if sign * arrow.value > 0
        ]  # fmt: skip
        if points:
            _heads(axes, points, sign, 6.0 if len(forces) <= 60 else 3.0, "black")


def _draw_couples(axes: Axes | Turned, lanes: LoadLanes) -> None:
    for sign in (1.0, -1.0):
        x = [arrow.x for arrow in lanes.arrows if arrow.kind == "moment" and sign * arrow.value > 0]
        if x:
            path = Path(CLOCKWISE.vertices * (sign, 1.0), CLOCKWISE.codes)
            axes.scatter(x, [0.0] * len(x), marker=path, s=area(ARC), facecolors="none", edgecolors="black",
                         linewidths=1.1, zorder=6, label="couples")  # fmt: skip


def _draw_axial(axes: Axes | Turned, arrow: Arrow, lanes: LoadLanes) -> None:
    """Draw a horizontal arrow."""
    start, stop, y = lanes.axial(arrow)
    axes.annotate("", xy=(stop, y), xytext=(start, y), xycoords=points_from(axes, arrow.x),
                  textcoords=points_from(axes, arrow.x), annotation_clip=False, zorder=6,
                  arrowprops={"arrowstyle": "-|>", "color": "black", "linewidth": 1.1, "shrinkA": 0, "shrinkB": 0})  # fmt: skip


def _arc() -> Path:
    """Make a clockwise arc over the beam with its head, radius 1."""
    angles = np.radians(np.linspace(215.0, -35.0, 40))
    points = np.column_stack((np.cos(angles), np.sin(angles)))
    forward = np.array([np.sin(angles[-1]), -np.cos(angles[-1])])
    wings = [points[-1] - 0.5 * _rotated(forward, side) for side in (35.0, -35.0)]
    return Path([*points, wings[0], points[-1], wings[1]], [1] + [2] * 39 + [1, 2, 2])


def _rotated(vector: np.ndarray, degrees: float) -> np.ndarray:
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]])


CLOCKWISE = _arc()
"""The arc of a couple."""
