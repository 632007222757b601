"""The ground in pictures: hatched under or over the beam, with the zones of contact, and its surface beside the deflection."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D

from ..base.characters import visible
from ..results.formatting import stretch
from ..results.state.ground import TOUCHING
from ..scene.ground_laws import PlasticGround
from ..scene.movements import ground_moved
from .beam import HALF, OFF
from .labels import LINE, Labels, text_width
from .sheet import is_upright
from .states import face
from .thin import outline
from .turned import Turned

if TYPE_CHECKING:
    from ..engine.beam import Beam
    from ..results.state.ground import Contact
    from ..scene.structs import Foundation, Scene
    from .bezier import Cells
    from .movements import Movements

STRIP = 6.0
"""Depth of the hatched strip, points."""
SWING = 9.0
"""How far off the surface is drawn where its gap is largest, when gaps vary, points."""
MOST_NAMES, MOST_UNNAMED = 12, 4
"""Foundations up to which they are named, and numbered where none has a name."""
MOST_STATES = 3
"""States of one colour from which on the legend names the first only."""
HATCHES = {"below": "/////", "above": "/////", "both": "xxxxx"}
WORDS = {"closed": "in contact", "bilateral": "bilateral ground", TOUCHING: "touching"}
TOUCHED = "|"
"""Mark of a place at which the beam only touches the ground."""
PER_LENGTH, CELLS_PER_LENGTH = 20, 4
"""Points of a polyline, and cells of a curve, in every length of (4 EI/k)^(1/4), within which it bends."""
FINE = 100
"""Points on the height of a panel by which labels keep clear of the surface of the ground."""
CELLS, MANY, MOST_CELLS = 4, 200, 25_000
"""Cells of a span without ground; spans from which on half as many do; cells of a beam at most."""


@dataclass
class Layer:
    """A foundation as it is drawn.

    Attributes
    ----------
    number : int
        In the scene.
    side : str
        As in the scene; what acts from both sides is drawn below.
    x, y : numpy.ndarray
        Its surface: places, heights in points.
    rim : float
        Where the strip ends.
    """

    number: int
    side: str
    x: np.ndarray
    y: np.ndarray
    rim: float


class GroundLanes:
    """Where foundations are drawn: heights in points; those that overlap on one side lie under one another.

    Parameters
    ----------
    scene : Scene
        The scene.
    width : float
        Length of the drawn beam.
    movements : Movements, optional
        Of foundations, by loads.

    Attributes
    ----------
    layers : list of Layer
        The foundations.
    names : list of (float, float, str, str)
        Their names: place, height, words, alignment.
    below, above : float
        What they take up below and above the axis of the beam; 0 where there is none.
    """

    def __init__(self, scene: Scene, width: float, movements: Movements | None = None) -> None:
        self.layers: list[Layer] = []
        self.width = width
        end = float(scene.span_ends()[-1])
        scale = width / end
        surfaces = [surface(scene, item) for item in scene.foundation]
        low = min((gap.min() for _, gap in surfaces), default=0.0)
        high = max((gap.max() for _, gap in surfaces), default=0.0)
        varying = any(np.ptp(gap) > 0.0 for _, gap in surfaces)
        words = ["" if item.name is None else visible(item.name) for item in scene.foundation]
        if not any(words) and 1 < len(words) <= MOST_UNNAMED:
            words = [f"foundation {number}" for number in range(len(words))]
        moved = {} if movements is None else movements.ground
        words = [", ".join(filter(None, (name, *moved.get(number, ())))) for number, name in enumerate(words)]
        self.upright = is_upright(scene)
        self.names: list[tuple[float, float, str, str]] = []
        self.below = self.above = 0.0
        lanes: dict[int, list[list[float]]] = {1: [], -1: []}  # ends of what lies there, and where it begins and ends in height
        taken = Labels()
        for number, (item, (x, gap)) in enumerate(zip(scene.foundation, surfaces, strict=True)):
            sign = -1 if item.side == "above" else 1
            off = np.where(gap > 0.0, OFF, 0.0)
            if varying:
                off = SWING * (gap - min(low, 0.0)) / (high - min(low, 0.0))
            lane = next((lane for lane in lanes[sign] if lane[0] <= x[0]), None)
            if lane is None:
                top = lanes[sign][-1][3] + 3.0 if lanes[sign] else HALF + 0.8
                lane = [x[-1], top, top + STRIP + max(SWING * varying, OFF), 0.0]
                lane[3] = lane[2]
                lanes[sign].append(lane)
            lane[0] = x[-1]
            self.layers.append(Layer(number, item.side, x, -sign * (lane[1] + off), -sign * lane[2]))
            if words[number] and len(surfaces) <= MOST_NAMES:
                self._name(words[number], (x[0] + x[-1]) / 2, lane, sign, scale, taken)
        self.below, self.above = (max((lane[3] for lane in lanes[sign]), default=0.0) for sign in (1, -1))

    def _name(self, words: str, x: float, lane: list[float], sign: int, scale: float, taken: Labels) -> None:
        """Write the name of a foundation beyond its strip, further off where one is there already."""
        if self.upright:
            self.names.append((x, -sign * (lane[2] + 2.0), words, "top" if sign > 0 else "bottom"))
            lane[3] = max(lane[3], lane[2] + 4.0 + text_width(words))
            return
        for row in range(MOST_NAMES):
            foot = -sign * (lane[2] + 1.0 + LINE * row) - (LINE if sign > 0 else 0.0)
            if taken.take(x * scale, foot, words):
                self.names.append((x, foot + (LINE if sign > 0 else 0.0), words, "top" if sign > 0 else "bottom"))
                lane[3] = max(lane[3], lane[2] + 2.0 + LINE * (row + 1))
                return


def surface(scene: Scene, item: Foundation) -> tuple[np.ndarray, np.ndarray]:
    """Give the gap along a foundation.

    Parameters
    ----------
    scene : Scene
    item : Foundation
        One of its foundations.

    Returns
    -------
    x, gap : numpy.ndarray
        From its left to its right end, straight in between.
    """
    from_, to = stretch(scene, item)
    if item.profile is None:
        return np.array([from_, to]), np.array(np.broadcast_to(item.gap, 2), dtype=float)
    points = np.asarray(item.profile, dtype=float)
    inside = points[(points[:, 0] > from_) & (points[:, 0] < to)]
    ends = np.interp([from_, to], points[:, 0], points[:, 1])
    return np.r_[from_, inside[:, 0], to], np.r_[ends[0], inside[:, 1], ends[1]]


def draw_ground(axes: Axes | Turned, lanes: GroundLanes, contact: tuple[Contact, ...]) -> None:
    """Draw the foundations in the panel of the beam, thick where they carry.

    Parameters
    ----------
    axes : matplotlib.axes.Axes or Turned
        The panel; its vertical unit is one point.
    lanes : GroundLanes
        Where to draw.
    contact : tuple of Contact
        The zones of contact.
    """
    zones: dict[str, list[np.ndarray]] = {}
    for layer in lanes.layers:
        x, y = outline(layer.x, layer.y, lanes.width)
        axes.fill_between(x, y, layer.rim, facecolor="white", edgecolor="0.6", linewidth=0.0, hatch=HATCHES[layer.side], zorder=1,
                          label=f"ground {layer.number}")  # fmt: skip
        axes.plot(x, y, color="0.35", linewidth=0.7, zorder=2, label=f"surface {layer.number}")
        for zone in contact:
            if zone.foundation == layer.number:
                inside = slice(*np.searchsorted(x, [zone.from_, zone.to]))
                places = np.r_[zone.from_, x[inside], zone.to]
                zones.setdefault(zone.state, []).append(np.column_stack((places, np.interp(places, x, y))))
    for x, y, words, va in lanes.names:
        axes.text(x, y, words, fontsize=6.5, color="0.25", ha="center", va=va, zorder=7)
    places = zones.pop(TOUCHING, None)
    if places:
        axes.plot(*np.concatenate([line[:1] for line in places]).T, linestyle="none", marker=TOUCHED, markersize=5,
                  markeredgewidth=1.2, color=_shade("closed"), zorder=2.6, label=f"contact {TOUCHING}")  # fmt: skip
    for state, lines in zones.items():
        points = [line[0] for line in lines if line[0, 0] == line[-1, 0]]
        if points:
            axes.plot(*np.transpose(points), linestyle="none", marker="o", markersize=4.5, color=_shade(state), zorder=2.6,
                      label="point contact")  # fmt: skip
        axes.add_collection(LineCollection(lines, colors=_shade(state), linewidths=2.6, capstyle="butt", joinstyle="round",
                                           zorder=2.5, label=f"contact {state}"))  # fmt: skip


def zone_handles(contact: tuple[Contact, ...], scene: Scene) -> list[Line2D]:
    """Make the entries of the legend for the zones of contact; what branches of laws are is said in words."""
    words: dict[tuple[str, bool], list[str]] = {}  # by colour, and whether it only touches
    for state in sorted({zone.state for zone in contact}, key=_by_number):
        name = WORDS.get(state) or _branch(scene, {zone.foundation for zone in contact if zone.state == state}, state)
        words.setdefault((_shade("closed" if state == TOUCHING else state), state == TOUCHING), []).append(name)
    return [
        Line2D([], [], linestyle="none", marker=TOUCHED if touches else "_", markersize=5 if touches else 8,
               markeredgewidth=1.2 if touches else 2.6, color=colour,
               label=", ".join(names) if len(names) < MOST_STATES else f"{names[0]} and beyond")
        for (colour, touches), names in words.items()
    ]  # fmt: skip


def _by_number(state: str) -> list[str]:
    """Give a key by which branch 10 comes after branch 2."""
    return [word.zfill(9) if word.isdigit() else word for word in state.split()]


def _branch(scene: Scene, foundations: set[int], state: str) -> str:
    """Name a branch of a law of the ground: elastic, then plastic where that is all there is."""
    number = int(state.rpartition(" ")[2])
    plastic = all(isinstance(scene.foundation[k].law, PlasticGround) for k in foundations)
    if plastic and number < 3:
        return ("elastic ground", "ground at its strength")[number - 1]
    return f"segment {number} of the ground's law"


def _contact_lines(scene: Scene, factor: float) -> Iterator[tuple[int, float, np.ndarray, np.ndarray]]:
    """Give where foundations begin to act: number, 1 below or -1 above, places and deflections."""
    for number, (item, moved) in enumerate(zip(scene.foundation, ground_moved(scene, factor), strict=True)):
        x, gap = surface(scene, item)
        for sign in {"below": (1.0,), "above": (-1.0,), "both": (1.0, -1.0)}[item.side]:
            if item.side != "both" or gap.any():
                yield number, sign, x, sign * gap + np.interp(x, x[[0, -1]], moved)


def near_surface(scene: Scene, cells: Cells, length: float, factor: float) -> list[tuple[float, float]]:
    """Give points on the surface of the ground near the beam, which labels keep clear of.

    Parameters
    ----------
    scene : Scene
    cells : Cells
        Its fields.
    length : float
        Length of the drawn beam (points).
    factor : float

    Returns
    -------
    list of (float, float)
        Places and deflections.
    """
    found = []
    size = 3.0 * float(np.ptp(np.append(cells.values["deflection"], 0.0)))
    for _, sign, x, levels in _contact_lines(scene, factor):
        at = np.linspace(x[0], x[-1], max(2, int(length * (x[-1] - x[0]) / float(scene.span_ends()[-1]))))
        y = np.interp(at, x, levels)
        parts = np.maximum(1, np.ceil(np.abs(np.diff(y)) / (size or 1.0) * FINE)).astype(int)  # more where it is steep
        index = np.concatenate([k + np.arange(count) / count for k, count in enumerate(parts.clip(max=FINE).tolist())])
        fine_x, fine_y = (np.interp(index, np.arange(len(at)), values) for values in (at, y))
        for off in (0.0, sign * 0.04 * size):
            found += [(float(a), float(b) + off) for a, b in zip(fine_x, fine_y, strict=True) if abs(b) < size]
    return found


def draw_surface(axes: Axes | Turned, scene: Scene, width: float, room: float, factor: float) -> None:
    """Draw in the panel of the deflection where the ground begins to act, as far as that is near the beam.

    Parameters
    ----------
    axes : matplotlib.axes.Axes or Turned
        The panel with the deflection, positive downward.
    scene : Scene
    width : float
        Length of the drawn beam (points).
    room : float
        What is left free beyond the surface, as a share of the range.
    factor : float
    """
    high, low = sorted(axes.get_ylim())
    size = low - high
    levels = [(number, sign, *outline(x, y, width)) for number, sign, x, y in _contact_lines(scene, factor)]
    seen = np.concatenate([y for *_, y in levels] or [np.zeros(0)])
    seen = seen[(seen > high - size / 2) & (seen < low + size / 2)]
    high, low = min([high, *(seen - room * size)]), max([low, *(seen + room * size)])
    for number, sign, x, y in levels:
        axes.fill_between(x, y, y + sign * 0.05 * size, facecolor="none", edgecolor="0.65", linewidth=0.0, hatch="//////", zorder=2)
        axes.plot(x, y, color="0.45", linewidth=0.8, zorder=2, label=f"surface {number}")
    axes.set_ylim(low, high)


def cells_a_span(scene: Scene, beam: Beam) -> int:
    """Count the cells of a span in which fields are as good as cubics: more on stiff ground, where the beam bends more sharply.

    Parameters
    ----------
    scene : Scene
    beam : Beam
        Made of it.
    """
    spans = len(scene.beam.spans)
    plain = CELLS if spans <= MANY else CELLS // 2
    return int(max(plain, min(points_a_span(scene, beam) * CELLS_PER_LENGTH / PER_LENGTH, MOST_CELLS // spans)))


def points_a_span(scene: Scene, beam: Beam) -> float:
    """Count the points that a span needs so that fields on stiff ground look smooth.

    Parameters
    ----------
    scene : Scene
    beam : Beam
        Made of it.

    Returns
    -------
    float
        0 without foundations.
    """
    columns = beam.columns
    moduli = [columns.greatest_of_ground()[0].max(initial=0.0)]
    moduli.append(columns.slopes_of_laws().max(initial=0.0))
    stiffness = float(beam.places.pieces[:, 1].min())
    return PER_LENGTH * max(scene.beam.spans) * (max(moduli) / (4.0 * stiffness)) ** 0.25


def _shade(state: str) -> str:
    """Give the grey of a zone: bilateral ground is fainter than one-sided ground in contact."""
    return "0.6" if state == "bilateral" else face(state)
