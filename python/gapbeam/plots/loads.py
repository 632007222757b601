"""Loads in the panel of the beam: blocks on the beam, arrows through them, arcs for couples."""

import math
from collections import defaultdict
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.path import Path
from matplotlib.transforms import Affine2D, ScaledTranslation, Transform

from ..base.characters import visible
from ..results.formatting import number, stretch, unit
from ..scene.loads import AxialLoad, CurvatureLoad, ForceLoad, LinearLoad, MomentLoad, UniformLoad
from ..scene.table import kind_of
from .labels import LINE, Labels, text_width

if TYPE_CHECKING:
    from ..scene.structs import Scene

#: Points: height of the highest block, of a lane of blocks with its label, of the longest arrow
BLOCK, LANE, ARROW = 12.0, 23.0, 22.0
#: Points: radius of the arc of a couple; how far apart opposite forces at one place are drawn
ARC, APART = 11.0, 8.0
#: Points between the small arrows of a block
BETWEEN = 16.0
#: With more loads of a kind than this, they get no label
MOST_LABELS = 24

_HEAD = Path([(0, 0), (-0.45, 1), (0.45, 1), (0, 0)], [1, 2, 2, 79])


@dataclass
class Block:
    """A distributed load or an imposed curvature: its stretch, its two values, what it is."""

    start: float
    stop: float
    first: float
    last: float
    text: str
    unit: str
    curvature: bool = False
    lane: int = 0


@dataclass
class Arrow:
    """A point load: place, value, what it is ("force", "moment", "axial"), how far aside it is drawn.

    Its label has its middle so far from the place and its foot so high; all in points.
    """

    x: float
    value: float
    text: str
    kind: str
    aside: float = 0.0
    label: tuple[float, float] | None = None


class LoadLanes:
    """Where the loads are drawn: heights in points above the axis of the beam.

    Parameters
    ----------
    scene : Scene
        The scene.
    base : float
        Where the loads may begin.
    width : float
        Width of the panel.
    factor : float
        Load factor of all loads but the dead ones.

    Attributes
    ----------
    blocks, arrows : list
        The loads.
    base, arrows_from, top : float
        Where blocks begin, where the arrows of forces reach beyond the blocks, and the end of it all.
    """

    def __init__(self, scene: "Scene", base: float, width: float, factor: float = 1.0) -> None:
        above = [support for support in scene.supports if support.side != "below" and support.direction == "normal"]
        self.above = scene.positions(above)
        self.end = float(scene.span_ends()[-1])
        self.scale = (width - 60) / self.end  # points per length
        self.blocks = _blocks(scene, factor, self.scale)
        self.arrows = _arrows(scene, factor)
        _set_apart(self.arrows, self.scale)
        couples = any(arrow.kind == "moment" for arrow in self.arrows)
        self.base = max(base, ARC + 2.0 + LINE * (len(self.arrows) <= MOST_LABELS)) if couples else base
        self.labelled = len(self.blocks) <= MOST_LABELS
        lanes = _pack(self.blocks)
        self.lane = LANE if self.labelled else BLOCK + 3.0
        self.arrows_from = self.base + self.lane * lanes
        largest = max((abs(arrow.value) for arrow in self.arrows if arrow.kind == "force"), default=1.0) or 1.0
        self.lengths = [0.35 * ARROW + 0.65 * ARROW * abs(arrow.value) / largest for arrow in self.arrows]
        ends = [self.tip(arrow, length) for arrow, length in zip(self.arrows, self.lengths, strict=True)]
        if len(self.arrows) <= MOST_LABELS:
            self._place_labels(ends, page=width - 22.0)
        self.top = max([self.arrows_from, *ends, *(arrow.label[1] + LINE for arrow in self.arrows if arrow.label)]) + 2.0

    def tip(self, arrow: Arrow, length: float) -> float:
        """Give the upper end of the symbol of a point load."""
        if arrow.kind == "force":
            return self.arrows_from + length
        return ARC if arrow.kind == "moment" else self.axial(arrow)[2] + 1.0

    def foot(self, arrow: Arrow) -> float:
        """Give the lower end of the arrow of a force: the beam, or above the symbol of a support there."""
        return self.base if np.any(np.abs(self.above - arrow.x) * self.scale < 9.0) else 3.5

    def axial(self, arrow: Arrow) -> tuple[float, float, float]:
        """Give start and tip of a horizontal arrow, from its place on, and its height: outside an end, above the axis elsewhere."""
        direction = 1.0 if arrow.value > 0 else -1.0
        outside = -1.0 if arrow.x <= 1e-9 * self.end else 1.0 if arrow.x >= self.end * (1.0 - 1e-9) else 0.0
        start, stop = (0.0, 22.0 * direction) if outside in (0.0, direction) else (22.0 * outside, 2.0 * outside)
        beside = 8.0 * (outside or direction) if self.foot(arrow) > 3.5 else 0.0  # of the symbol of a support
        return start + beside, stop + beside, 0.0 if outside else 7.0

    def _place_labels(self, ends: list[float], page: float) -> None:
        """Write every label above its arrow, or to the side where it stands there; higher where something is there already.

        `ends` are the upper ends of the arrows; what is put to the side ends before the edge of the page, points.
        """
        labels = Labels()
        lines = [
            (arrow.x * self.scale + arrow.aside, top)
            for arrow, top in zip(self.arrows, ends, strict=True) if arrow.kind == "force"
        ]  # fmt: skip
        for arrow, end in sorted(zip(self.arrows, ends, strict=True), key=lambda pair: (pair[1], pair[0].x)):
            half, x = text_width(arrow.text) / 2, arrow.x * self.scale
            above, asides = arrow.aside, [arrow.aside]
            if arrow.kind == "moment":
                asides += [half + ARC / 2, -half - ARC / 2]
            elif arrow.kind == "axial":
                start, stop, _ = self.axial(arrow)
                above = (start + stop) / 2
                asides = [above, math.copysign(half + 2.0, stop - start)]
            elif arrow.aside:
                asides.insert(0, math.copysign(half, arrow.aside))
            places = [(aside, end + 1.0) for aside in asides if x + aside + half < page]
            # One of so many is free: a label or an arrow is in the way of less than two of them
            places += [(above, end + 1.0 + level * LINE) for level in range(4 * MOST_LABELS)]
            for aside, y in places:
                crossed = any(abs(x + aside - at) < half and end < top and y < top for at, top in lines)
                if not crossed and labels.take(x + aside, y, arrow.text):
                    arrow.label = aside, y
                    break


def draw_loads(axes: Axes, lanes: LoadLanes) -> None:
    """Draw all loads at their full size.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        The panel; its vertical unit is one point.
    lanes : LoadLanes
        The loads, and where to draw them.
    """
    if lanes.blocks:
        _draw_blocks(axes, lanes)
    _draw_forces(axes, lanes)
    _draw_couples(axes, lanes)
    for arrow in lanes.arrows:
        if arrow.kind == "axial":
            _draw_axial(axes, arrow, lanes)
        if arrow.label:
            axes.annotate(arrow.text, (arrow.x, arrow.label[1]), (arrow.label[0], 0.0), textcoords="offset points",
                          fontsize=6.8, ha="center", va="bottom", zorder=7)  # fmt: skip


def _share(load: object, factor: float) -> float:
    """Give the share of a load that acts at a load factor."""
    return 1.0 if load.case == "dead" else factor


def _blocks(scene: "Scene", factor: float, scale: float) -> list[Block]:
    blocks = []
    cases = len({load.case for load in scene.loads})
    for load in scene.loads:
        share = _share(load, factor)
        if not isinstance(load, UniformLoad | LinearLoad | CurvatureLoad) or not share:
            continue
        if isinstance(load, CurvatureLoad):
            first = last = share * load.kappa
        elif isinstance(load, UniformLoad):
            first = last = share * load.q
        else:
            first, last = share * load.q[0], share * load.q[1]
        quantity = "curvature" if isinstance(load, CurvatureLoad) else "uniform"
        words = _unit_and_case(scene, load, quantity, cases)
        blocks.append(Block(*stretch(scene, load), first, last, "", words, quantity == "curvature"))
    # Small arrows say which way a load acts; the sign says it only where there are none
    pointed = all((block.stop - block.start) * scale >= BETWEEN for block in blocks)
    for block in blocks:
        way = -1.0 if pointed and not block.curvature and max(block.first, block.last) <= 0.0 else 1.0
        values = [_signed(way * value, 4) for value in (block.first, block.last)]
        block.text = "curvature " * block.curvature + (values[0] if block.first == block.last else " to ".join(values))
    return blocks


def _set_apart(arrows: list[Arrow], scale: float) -> None:
    """Draw opposite forces side by side where one would cover the other; `scale` is in points per length."""
    columns = defaultdict(list)
    for arrow in arrows:
        if arrow.kind == "force" and arrow.value:
            columns[arrow.x, arrow.value < 0.0].append(arrow)
    for left, right in pairwise(sorted(columns)):
        overlap = APART - (right[0] - left[0]) * scale
        if overlap > 0.0 and left[1] != right[1]:
            for column, way in ((left, -0.5), (right, 0.5)):
                for arrow in columns[column]:
                    arrow.aside += way * overlap


def _arrows(scene: "Scene", factor: float) -> list[Arrow]:
    kinds = {ForceLoad: ("force", "force"), MomentLoad: ("moment", "moment"), AxialLoad: ("axial", "force")}
    loads = [load for load in scene.loads if kind_of(load) in kinds]
    arrows = []
    cases = len({load.case for load in scene.loads})
    for load, x in zip(loads, scene.positions(loads), strict=True):
        kind, quantity = kinds[kind_of(load)]
        value = _share(load, factor) * (load.M if kind == "moment" else load.F)
        if not _share(load, factor):
            continue
        text = f"{_signed(abs(value), 5)} {_unit_and_case(scene, load, quantity, cases)}".rstrip()
        arrows.append(Arrow(float(x), value, text, kind))
    return arrows


def _signed(value: float, digits: int) -> str:
    return number(value, digits).replace("-", "\N{MINUS SIGN}")


def _unit_and_case(scene: "Scene", load: object, quantity: str, cases: int) -> str:
    """Word the unit of a load, and its name, or its case where the scene has several."""
    return f"{unit(scene, quantity)} {visible(load.name or (load.case if cases > 1 else ''))}".strip()


def _pack(blocks: list[Block], most: int = 6) -> int:
    """Put blocks that overlap into lanes above one another; return the number of lanes."""
    ends: list[float] = []
    for block in sorted(blocks, key=lambda block: (block.curvature, block.start, -block.stop)):
        tolerance = 1e-9 * abs(block.stop)
        lane = next((lane for lane, end in enumerate(ends) if block.start >= end - tolerance), len(ends))
        lane = min(lane, most - 1)
        if lane == len(ends):
            ends.append(block.stop)
        ends[lane] = max(ends[lane], block.stop)
        block.lane = lane
    return len(ends)


def _draw_blocks(axes: Axes, lanes: LoadLanes) -> None:
    blocks = lanes.blocks
    largest = max((max(abs(block.first), abs(block.last)) for block in blocks if not block.curvature), default=0.0)
    groups: dict[str, list] = {"down": [], "up": [], "curvature": []}
    ticks, tops, heads = [], [], {1.0: [], -1.0: []}
    for block in blocks:
        y = lanes.base + lanes.lane * block.lane
        if block.curvature:
            first = last = 5.0
            groups["curvature"].append([(block.start, y), (block.start, y + 5), (block.stop, y + 5), (block.stop, y)])
        else:
            first, last = (BLOCK * abs(value) / (largest or 1.0) for value in (block.first, block.last))
            if block.first == block.last:
                first = last = max(first, 4.5) if first else 0.0  # however small, it is to be seen
            for start, stop, left, right, sign in _one_signed(block, first, last):
                corners = [(start, y), (start, y + left), (stop, y + right), (stop, y)]
                groups["down" if sign > 0 else "up"].append(corners)
                _block_arrows(start, stop, (left, right), y, lanes.scale, sign, ticks, heads)
        tops.append(y + max(first, last))
    if lanes.labelled:
        _label_blocks(axes, lanes, tops)
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


def _one_signed(block: Block, first: float, last: float) -> list[tuple[float, float, float, float, float]]:
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


def _label_blocks(axes: Axes, lanes: LoadLanes, tops: list[float]) -> None:
    """Label every block in its widest stretch without an arrow; where it is narrow, the unit once for all."""
    forces = sorted(arrow.x + arrow.aside / lanes.scale for arrow in lanes.arrows if arrow.kind == "force")
    short = any(
        text_width(f"{block.text} {block.unit}") > (block.stop - block.start) * lanes.scale for block in lanes.blocks
    ) and len(lanes.blocks) > 6
    for block, top in zip(lanes.blocks, tops, strict=True):
        cuts = np.array([block.start, *(x for x in forces if block.start < x < block.stop), block.stop])
        widest = int(np.argmax(np.diff(cuts)))
        text = f"{block.text} {block.unit}".rstrip()
        if short:
            text = _signed(block.first, 3) if block.first == block.last else block.text
        axes.text((cuts[widest] + cuts[widest + 1]) / 2, top + 0.5, text, fontsize=6.8 - 0.8 * short, ha="center",
                  va="bottom", zorder=7)  # fmt: skip
    for lane in {block.lane for block in lanes.blocks} if short else ():
        y = lanes.base + lanes.lane * lane
        text = next(block.unit for block in lanes.blocks if block.lane == lane)
        axes.annotate(text, (0.0, y), (-4, 0), textcoords="offset points", fontsize=6.8, ha="right", va="bottom")


def _heads(axes: Axes, points: list, sign: float, size: float, colour: str) -> None:
    """Draw arrow heads with their tips in the points, downward for a positive sign."""
    x, y = np.transpose(points)
    path = Path(_HEAD.vertices * (1.0, sign), _HEAD.codes)
    axes.scatter(x, y, marker=path, s=(2.0 * size) ** 2, c=colour, linewidths=0, zorder=6)


def _draw_forces(axes: Axes, lanes: LoadLanes) -> None:
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


def _draw_couples(axes: Axes, lanes: LoadLanes) -> None:
    for sign in (1.0, -1.0):
        x = [arrow.x for arrow in lanes.arrows if arrow.kind == "moment" and sign * arrow.value > 0]
        if x:
            path = Path(_ARC.vertices * (sign, 1.0), _ARC.codes)
            axes.scatter(x, [0.0] * len(x), marker=path, s=(2.0 * ARC) ** 2, facecolors="none", edgecolors="black",
                         linewidths=1.1, zorder=6, label="couples")  # fmt: skip


def _draw_axial(axes: Axes, arrow: Arrow, lanes: LoadLanes) -> None:
    """Draw a horizontal arrow."""
    start, stop, y = lanes.axial(arrow)
    axes.annotate("", xy=(stop, y), xytext=(start, y), xycoords=_points_from(axes, arrow.x),
                  textcoords=_points_from(axes, arrow.x), annotation_clip=False, zorder=6,
                  arrowprops={"arrowstyle": "-|>", "color": "black", "linewidth": 1.1, "shrinkA": 0, "shrinkB": 0})  # fmt: skip


def _points_from(axes: Axes, x: float) -> Transform:
    """Make the transform that measures points from a place on the axis of the beam."""
    return Affine2D().scale(1.0 / 72.0) + axes.figure.dpi_scale_trans + ScaledTranslation(x, 0.0, axes.transData)


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


_ARC = _arc()
