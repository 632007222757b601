"""Loads as they are drawn beside the beam: blocks, arrows through them, arcs for couples; where each stands, and its label."""

import math
from collections import defaultdict
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from ..base.characters import visible, with_minus_signs
from ..results.formatting import count, number, stretch, unit
from ..scene.ground_tables import at_both_ends
from ..scene.loads import (
    AxialLoad,
    AxialUniformLoad,
    CurvatureLoad,
    ForceLoad,
    LinearLoad,
    MomentLoad,
    TemperatureLoad,
    UniformLoad,
)
from ..scene.movements import share_of
from ..scene.table import kind_of
from .labels import LINE, MARGIN, Labels, spread, text_width
from .sheet import is_upright

if TYPE_CHECKING:
    from ..scene.structs import Scene

#: Points: height of the highest block, of a lane of blocks with its label, of the longest arrow
BLOCK, LANE, ARROW = 12.0, 23.0, 22.0
#: Points: radius of the arc of a couple; how far apart opposite forces at one place are drawn
ARC, APART = 11.0, 8.0
#: Points between the small arrows of a block
BETWEEN = 16.0
#: With more loads of a kind than this, they get no label; with more blocks than this, narrow ones have no unit; rows of labels
MOST_LABELS, MOST_LONG, MOST_LEVELS = 24, 6, 6

@dataclass
class Block:
    """A distributed load, an imposed curvature or a temperature: its stretch, its two values, what it is.

    Its label: middle along the beam, height above the foot of the block (points), words, whether an arrow goes through it.
    """

    start: float
    stop: float
    first: float
    last: float
    text: str
    unit: str
    curvature: bool = False
    lane: int = 0
    label: tuple[float, float, str, bool] | None = None


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
    length : float
        Length of the drawn beam.
    factor : float
        Load factor of all loads but the dead ones.

    Attributes
    ----------
    blocks, arrows : list
        The loads.
    note : str
        Sums up loads that have no labels.
    base, arrows_from, top : float
        Where blocks begin, where the arrows of forces reach beyond the blocks, and the end of it all.
    """

    def __init__(self, scene: "Scene", base: float, length: float, factor: float = 1.0) -> None:
        above = [support for support in scene.supports if support.side != "below" and support.direction == "normal"]
        self.above = scene.positions(above)
        self.along = scene.positions([support for support in scene.supports if support.direction == "axial"])
        self.end = float(scene.span_ends()[-1])
        self.scale = length / self.end  # points per length
        self.upright = is_upright(scene)
        self.blocks = _blocks(scene, factor, self.scale)
        self.arrows = _arrows(scene, factor)
        _set_apart(self.arrows, self.scale)
        couples = any(arrow.kind == "moment" for arrow in self.arrows)
        self.base = max(base, ARC + 2.0 + LINE * (len(self.arrows) <= MOST_LABELS)) if couples else base
        self.labelled = len(self.blocks) <= MOST_LABELS
        lanes = _pack(self.blocks)
        self.largest = max((abs(v) for one in self.blocks if not one.curvature for v in (one.first, one.last)), default=0.0) or 1.0
        self.unit = unit(scene, "uniform")
        rows = self._label_blocks(length + 38.0) if self.labelled else 0
        self.lane = LANE + LINE * rows if self.labelled else BLOCK + 3.0
        if self.upright and self.labelled:  # labels stand beside blocks, not above them
            self.lane += max((text_width(f"{block.text} {block.unit}") for block in self.blocks), default=0.0) - LINE
        self.arrows_from = self.base + self.lane * lanes
        largest = max((abs(arrow.value) for arrow in self.arrows if arrow.kind == "force"), default=1.0) or 1.0
        self.lengths = [0.35 * ARROW + 0.65 * ARROW * abs(arrow.value) / largest for arrow in self.arrows]
        ends = [self.tip(arrow, length) for arrow, length in zip(self.arrows, self.lengths, strict=True)]
        if len(self.arrows) <= MOST_LABELS:
            if self.upright:
                self._place_beside(ends, length)
            else:
                self._place_labels(ends, page=length + 38.0)
        high = [arrow.label[1] + (text_width(arrow.text) if self.upright else LINE) for arrow in self.arrows if arrow.label]
        self.top = max([self.arrows_from, *ends, *high]) + 2.0
        self.note = self._unlabelled(scene)
        if self.note:
            self.top += text_width(self.note) if self.upright else LINE

    def _unlabelled(self, scene: "Scene") -> str:
        """Word between which values loads are that are too many for a label each."""
        blocks = [value for block in self.blocks if not block.curvature for value in (block.first, block.last)]
        kinds = [("distributed load", blocks, len(blocks) // 2, "uniform")] * (not self.labelled)
        of_arrows = ("force", "force", "force"), ("moment", "couple", "couple"), ("axial", "axial load", "force")
        for kind, words, quantity in of_arrows:
            values = [arrow.value for arrow in self.arrows if arrow.kind == kind]
            kinds += [(words, values, len(values), quantity)] * (len(self.arrows) > MOST_LABELS)
        return "; ".join(
            f"{count(many, words)} from {signed(min(values), 4)} to {signed(max(values), 4)} {unit(scene, quantity)}".rstrip()
            for words, values, many, quantity in kinds if values
        )

    def heights(self, block: Block) -> tuple[float, float]:
        """Give the heights of a block at both ends (points)."""
        if block.curvature:
            return 5.0, 5.0
        first, last = (BLOCK * abs(value) / self.largest for value in (block.first, block.last))
        if block.first == block.last:
            first = last = max(first, 4.5) if first else 0.0  # however small, it is to be seen
        return first, last

    def _label_blocks(self, page: float) -> int:
        """Label every block in its widest stretch without an arrow, above labels that are there; give the rows that takes.

        Where many are narrow only their values are written, and the unit once for all.
        """
        forces = sorted(arrow.x * self.scale + arrow.aside for arrow in self.arrows if arrow.kind == "force")
        texts = [f"{block.text} {block.unit}".rstrip() for block in self.blocks]
        narrow = [text_width(text) > (one.stop - one.start) * self.scale for text, one in zip(texts, self.blocks, strict=True)]
        self.short = any(narrow) and len(self.blocks) > MOST_LONG
        taken: dict[int, Labels] = defaultdict(Labels)
        most = 0
        for block, text in zip(self.blocks, texts, strict=True):
            cuts = np.array([block.start * self.scale, *forces, block.stop * self.scale])
            cuts = cuts[(cuts >= cuts[0]) & (cuts <= cuts[-1])]
            widest, top = int(np.argmax(np.diff(cuts))), max(self.heights(block)) + 0.5
            value = signed(block.first, 3) if block.first == block.last else block.text
            text, row = value if self.short else text, 0
            half, middle = text_width(text) / 2, (cuts[widest] + cuts[widest + 1]) / 2
            if not self.upright:
                middle = min(max(middle, half - MARGIN), page - half)
                under = [one for one in self.blocks if one.lane == block.lane and abs(
                    (one.start + one.stop) * self.scale / 2 - middle) < half + (one.stop - one.start) * self.scale / 2]
                top = max(max(self.heights(one)) for one in (block, *under)) + 0.5
                free = (row for row in range(MOST_LEVELS) if taken[block.lane].take(middle, top + LINE * row, text))
                row = next(free, -1)
            if row >= 0:
                crossed = any(abs(at - middle) < half for at in forces)
                block.label, most = (middle / self.scale, top + LINE * row, text, crossed), max(most, row)
        return most

    def tip(self, arrow: Arrow, length: float) -> float:
        """Give the upper end of the symbol of a point load."""
        if arrow.kind == "force":
            return self.arrows_from + length
        return ARC if arrow.kind == "moment" else self.axial(arrow)[2] + (6.0 if self._is_held(arrow) else 1.0)

    def foot(self, arrow: Arrow) -> float:
        """Give the lower end of the arrow of a force: the beam, or above the symbol of a support there."""
        return self.base if np.any(np.abs(self.above - arrow.x) * self.scale < 9.0) else 3.5

    def axial(self, arrow: Arrow) -> tuple[float, float, float]:
        """Give start and tip of a horizontal arrow, from its place on, and its height: outside an end, above the axis elsewhere."""
        direction = 1.0 if arrow.value > 0 else -1.0
        outside = -1.0 if arrow.x <= 1e-9 * self.end else 1.0 if arrow.x >= self.end * (1.0 - 1e-9) else 0.0
        start, stop = (0.0, 22.0 * direction) if outside in (0.0, direction) else (22.0 * outside, 2.0 * outside)
        beside = 8.0 * (outside or direction) if self.foot(arrow) > 3.5 else 0.0  # of the symbol of a support
        beside = 10.0 * outside if outside and self._is_held(arrow) else beside
        return start + beside, stop + beside, 0.0 if outside else 7.0

    def _is_held(self, arrow: Arrow) -> bool:
        """Whether the symbol of a support along the beam is there."""
        return bool(np.any(np.abs(self.along - arrow.x) * self.scale < 9.0))

    def _place_beside(self, ends: list[float], length: float) -> None:
        """Write labels to the left of an upright beam, behind their arrows, moved along it as little as need be."""
        chosen = sorted(zip(self.arrows, ends, strict=True), key=lambda pair: (pair[0].x, pair[0].aside))
        wanted = [arrow.x * self.scale + arrow.aside - (14.0 if arrow.kind == "axial" and arrow.x <= 0.0 else 0.0)
                  for arrow, _ in chosen]  # fmt: skip
        for (arrow, end), at in zip(chosen, spread(wanted, LINE, length + 24.0), strict=True):
            arrow.label = at - arrow.x * self.scale, end + 3.0

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
            else:  # beside its tip rather than above a label that another one would be in the way of
                asides += [half + 2.0, -half - 2.0]
            places = [(aside, end + 1.0) for aside in asides if half - MARGIN < x + aside < page - half]
            above = min(max(above, half - MARGIN - x), page - half - x)
            # One of so many is free: a label or an arrow is in the way of less than two of them
            places += [(above, end + 1.0 + level * LINE) for level in range(4 * MOST_LABELS)]
            for aside, y in places:
                crossed = any(abs(x + aside - at) < half and end < top and y < top for at, top in lines)
                if not crossed and labels.take(x + aside, y, arrow.text):
                    arrow.label = aside, y
                    break


def _blocks(scene: "Scene", factor: float, scale: float) -> list[Block]:
    blocks = []
    cases = len({load.case for load in scene.loads})
    for load in scene.loads:
        share = share_of(load, factor)
        if not isinstance(load, UniformLoad | LinearLoad | CurvatureLoad | TemperatureLoad | AxialUniformLoad) or not share:
            continue
        if isinstance(load, AxialUniformLoad):
            way = "to the left" if share * load.q < 0.0 else "to the right"
            words = f"{_unit_and_case(scene, load, 'uniform', cases)} {way}".strip()
            blocks.append(Block(*stretch(scene, load), 0.0, 0.0, signed(abs(share * load.q), 4), words, True))
            continue
        if isinstance(load, TemperatureLoad):
            told = [f"{name} {signed(share * value, 4)}" for name, value in (("dT", load.dT), ("gradient", load.gradient)) if value]
            words = _unit_and_case(scene, load, None, cases)
            blocks.append(Block(*stretch(scene, load), 0.0, 0.0, ", ".join(told), words, True))
            continue
        if isinstance(load, CurvatureLoad):
            first, last = (share * one for one in at_both_ends(load.kappa))
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
        if block.text:
            continue
        way = -1.0 if pointed and not block.curvature and max(block.first, block.last) <= 0.0 else 1.0
        values = [signed(way * value, 4) for value in (block.first, block.last)]
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
        value = share_of(load, factor) * (load.M if kind == "moment" else load.F)
        if not share_of(load, factor):
            continue
        text = f"{signed(abs(value), 5)} {_unit_and_case(scene, load, quantity, cases)}".rstrip()
        arrows.append(Arrow(float(x), value, text, kind))
    return arrows


def signed(value: float, digits: int) -> str:
    """Write a number with a minus sign proper."""
    return with_minus_signs(number(value, digits))


def _unit_and_case(scene: "Scene", load: object, quantity: str | None, cases: int) -> str:
    """Word the unit of a load, if it has one, and its name, or its case where the scene has several."""
    return f"{unit(scene, quantity) if quantity else ''} {name_or_case(load, cases)}".strip()


def name_or_case(load: object, cases: int) -> str:
    """Give the name of a load, or its case where the scene has several."""
    return visible(load.name or (load.case if cases > 1 else ""))


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
