"""The panel of the beam: the beam itself and the symbols of its supports.

The vertical unit of the panel is one point (1/72 inch), measured from the axis of the beam, so symbols keep their
shape whatever the length of the beam.
"""

import math
from collections import defaultdict
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.path import Path

from ..results.event_words import state_in_words
from ..results.formatting import stretch
from ..scene.axial_ground import places_of_marks
from ..scene.movements import supports_moved
from ..scene.rotations import turns
from ..scene.tapers import ends_of, is_tapered
from .reactions import arrow_lane, draw_reactions
from .sheet import is_upright
from .states import SYMBOLS, TRIANGLE, VERMILION, area, mirrored, plain_kinds
from .support_labels import SupportTexts
from .turned import Turned, is_turned, shifted

if TYPE_CHECKING:
    from ..results.state.step import Step
    from ..scene.structs import Scene, Support
    from .movements import Movements
    from .support_values import SupportValues

#: Half the depth of the beam, points
HALF = 2.5
#: Pieces of a section that tapers, each of one thickness
CUTS = 24
#: How far the symbol of a support with a gap stands off, points
OFF = 4.0
#: With more places than this, rows of ticks replace the symbols
MOST_SYMBOLS = 60

#: Symbols with their tip in the origin, below the beam; the largest coordinate is 1, one height
_GROUND = Path(
    [(-1, 0), (1, 0), *(point for x in (-0.7, -0.1, 0.5) for point in ((x + 0.35, 0), (x, -0.45)))],
    [1, 2, 1, 2, 1, 2, 1, 2],
)
_SPRING = Path([(0, 0), (0.5, -0.15), (-0.5, -0.4), (0.5, -0.65), (-0.5, -0.9), (0, -1)], [1, 2, 2, 2, 2, 2])
_WALL = Path(
    [(0, -1), (0, 1), *(point for y in np.linspace(-0.8, 1.0, 7) for point in ((0, y), (-0.35, y - 0.2)))],
    [1, 2] * 8,
)
_SETTLED = Path([(0, 1), (0, -1), (-0.35, -0.5), (0, -1), (0.35, -0.5)], [1, 2, 1, 2, 2])
#: Two half arrows, as of shear: what holds the beam along its axis
_ALONG = Path([(-1, 0.25), (1, 0.25), (0.3, 0.9), (1, -0.25), (-1, -0.25), (-0.3, -0.9)], [1, 2, 2, 1, 2, 2])
_SPIRAL = Path(np.array([(t * math.cos(7 * t), t * math.sin(7 * t)) for t in np.linspace(0.0, 1.0, 40)]))


class SupportLanes:
    """Where the supports are drawn: sizes and heights in points.

    Parameters
    ----------
    scene : Scene
        The scene.
    states : tuple of str
        State of each support.
    length : float
        Length of the drawn beam.
    ground : (float, float)
        What foundations take up below and above the axis of the beam.
    values : SupportValues, optional
        Reactions and openings that are drawn.
    kinds : tuple of str, optional
        What each support does, as `states.kinds_of`; default by its state.
    movements : Movements, optional
        Of supports, by loads.

    Attributes
    ----------
    size : float
        Height of a triangle.
    rows : list of str
        Rows of ticks by state and side, where there are too many supports for symbols; else empty.
    texts : SupportTexts
        Numbers of the supports, their reactions and openings, and gaps where there is room.
    arrows : float
        Upper end of the arrows of reactions.
    bottom, top : float
        What the supports take up below and above the axis of the beam.
    """

    def __init__(
        self, scene: "Scene", states: tuple[str, ...], length: float, ground: tuple[float, float] = (0.0, 0.0),
        values: "SupportValues | None" = None, kinds: tuple[str, ...] | None = None, movements: "Movements | None" = None,
    ) -> None:  # fmt: skip
        self.values, self.kinds = values, kinds or plain_kinds(states)
        supports = [support for support in scene.supports if support.direction == "normal"]
        self.x = scene.positions(scene.supports)
        self.places = np.unique(self.x)
        self.spacing = length / max(1, len(self.places) - 1)
        near = np.diff(self.places).min(initial=np.inf) * length / float(scene.span_ends()[-1])
        self.size = min(8.0, max(2.0, 0.75 * self.spacing), max(3.5, 0.8 * near))
        self.rows: list[str] = []
        below = above = HALF
        if len(self.places) > MOST_SYMBOLS:
            self.rows = sorted({_group(support, state) for support, state in zip(scene.supports, states, strict=True)})
            self.size = 6.0
            self.first_row = max(below, ground[0]) + 9.0
            below = self.first_row + 11.0 * len(self.rows) - 5.0
        elif supports:
            elastic = any(map(_is_elastic, supports))
            gap = any(map(_stands_off, scene.supports, states))
            depth = self.size * (1.5 + elastic) + OFF * gap
            below += depth if any(support.side != "above" for support in supports) else 2.0
            above += depth if any(support.side != "below" and support.rotation != "fixed" for support in supports) else 0
            if any(support.rotation != "free" for support in supports):
                below, above = max(below, 13.0), max(above, 12.0)
        below, above = max(below, ground[0]), max(above, ground[1])
        if movements is not None:
            below, above = max(below, movements.below), max(above, movements.above)
        self.arrows = -below - 2.0
        foot = self.arrows - arrow_lane(values)
        self.texts = SupportTexts(scene, self.x, length, foot, values, is_upright(scene), movements)
        self.bottom = self.texts.bottom
        self.top = above + 2.0


def draw_beam(axes: Axes | Turned, scene: "Scene", states: tuple[str, ...], lanes: SupportLanes) -> None:
    """Draw the beam, its hinges and its supports.

    Parameters
    ----------
    axes : matplotlib.axes.Axes or Turned
        The panel; its vertical unit is one point.
    scene : Scene
    states : tuple of str
        State of each support.
    lanes : SupportLanes
        Where to draw.
    """
    _girder(axes, scene)
    if scene.axial_ground:
        _ground_along(axes, scene)
    if scene.beam.hinges:
        axes.scatter(scene.beam.hinges, [0.0] * len(scene.beam.hinges), s=22, c="white", edgecolors="black",
                     linewidths=1.0, zorder=6, label="hinges")  # fmt: skip
    if scene.hinges:
        axes.scatter(scene.positions(scene.hinges), [0.0] * len(scene.hinges), s=26, c="0.8", edgecolors="black",
                     linewidths=1.0, zorder=6, marker="D", label="elastic hinges")  # fmt: skip
    if lanes.rows:
        _ticks(axes, scene, states, lanes)
    else:
        _symbols(axes, scene, states, lanes)
    if lanes.values is not None:
        draw_reactions(axes, lanes.values, lanes.x, lanes.arrows)
    for x, y, words, lifted in lanes.texts.texts:
        axes.text(x, y, words, fontsize=6.5, ha="center", va="top", color=VERMILION if lifted else "0.15", linespacing=1.15)
    if lanes.texts.unit and not is_turned(axes):
        axes.annotate(lanes.texts.unit, (0.0, lanes.arrows), (-14, -3), xycoords="data", textcoords="offset points", fontsize=6.5,
                      ha="right", va="top", annotation_clip=False)  # fmt: skip


def draw_contacts(
    axes: Axes | Turned, scene: "Scene", lanes: SupportLanes, step: "Step", largest: float
) -> list[tuple[float, float]]:
    """Mark in the panel of the deflection where one-sided supports meet the beam, and how far it is off open ones: to scale.

    Parameters
    ----------
    axes : matplotlib.axes.Axes or Turned
        The panel, positive downward.
    scene : Scene
    lanes : SupportLanes
        What each support does.
    step : Step
        The state.
    largest : float
        Largest deflection; supports much farther off are left out.

    Returns
    -------
    list of (float, float)
        The marks: x and displacement.
    """
    if len(scene.supports) > 2 * MOST_SYMBOLS:
        return []
    groups, opened = defaultdict(list), []
    level = supports_moved(scene, step.factor) + np.array([support.settlement for support in scene.supports])
    for k, (support, state, x) in enumerate(zip(scene.supports, lanes.kinds, lanes.x, strict=True)):
        if (support.side != "both" or level[k] or step.set[k]) and support.direction == "normal":
            sign = -1.0 if support.side == "above" else 1.0
            y = level[k] + sign * (support.gap + step.set[k])
            if abs(y) <= 1.5 * largest:
                groups[state, sign].append((float(x), y))
                if state == "open" and step.opening[k] > 0.02 * largest:
                    opened += [(x, y), (x, step.deflection[k]), (np.nan, np.nan)]
    if opened:
        axes.plot(*np.transpose(opened), color=VERMILION, linewidth=0.9, marker="_", markersize=4, zorder=3.5, label="openings")
    for (state, sign), points in groups.items():
        x, y = np.transpose(points)
        symbol = SYMBOLS[state]
        axes.scatter(x, y, marker=mirrored(symbol.path, sign), s=area(5.0), facecolors=symbol.face,
                     edgecolors=symbol.edge, linewidths=0.75 * symbol.width, zorder=4, label=f"contact {state}")  # fmt: skip
    return [point for points in groups.values() for point in points]


def _is_elastic(support: "Support") -> bool:
    """Whether a support is drawn as a spring."""
    return support.law is not None or math.isfinite(support.stiffness)


def _stands_off(support: "Support", state: str) -> bool:
    """Whether the symbol of a support does not touch the beam: it has a gap, or no contact."""
    return support.direction == "normal" and (support.gap > 0 or state == "open")


def _group(support: "Support", state: str) -> str:
    """Name the collection of a support: state and side."""
    if support.direction != "normal":
        return support.direction
    return state if support.side == "both" else f"{state} {support.side}"


def _girder(axes: Axes | Turned, scene: "Scene") -> None:
    """Draw the beam, the thicker the stiffer."""
    ends = scene.span_ends()
    tapered = [np.linspace(*stretch(scene, section), CUTS + 1) for section in scene.sections if is_tapered(section)]
    cuts = np.unique([*ends, *(x for section in scene.sections for x in stretch(scene, section)), *np.ravel(tapered)])
    middle = (cuts[1:] + cuts[:-1]) / 2
    spans = np.clip(np.searchsorted(ends, middle) - 1, 0, len(ends) - 2)
    stiffness = np.broadcast_to(np.asarray(scene.beam.EI, float), len(ends) - 1)[spans].copy()
    for section in scene.sections:
        if section.EI is not None:
            start, stop = stretch(scene, section)
            there = (middle > start) & (middle < stop)
            left, right, power = ends_of(section.EI)
            share = (middle[there] - start) / (stop - start)
            depth = np.power([left, right], 1 / power)
            stiffness[there] = left if left == right else (depth[0] * (1 - share) + depth[1] * share) ** power
    finite = stiffness[np.isfinite(stiffness)]
    share = np.cbrt(np.minimum(stiffness / (finite.max() if len(finite) else 1.0), 1.0))
    widths = np.where(np.isfinite(stiffness), 1.2 + 2.3 * share, 2 * HALF)
    pieces = [[(a, 0.0), (b, 0.0)] for a, b in pairwise(cuts)]
    axes.add_collection(LineCollection(pieces, linewidths=widths, colors="0.2", capstyle="projecting", zorder=3, label="beam"))


def _symbols(axes: Axes | Turned, scene: "Scene", states: tuple[str, ...], lanes: SupportLanes) -> None:
    """Draw every support as a symbol; equal ones are one collection."""
    symbols, springs, ground, settled = (defaultdict(list) for _ in range(4))
    end = float(scene.span_ends()[-1])
    beside_axial = {x for support, x in zip(scene.supports, lanes.x.tolist(), strict=True) if support.direction == "axial"}
    for support, state, kind, x in zip(scene.supports, states, lanes.kinds, lanes.x, strict=True):
        if support.direction == "axial":
            _axial(axes, scene, x, end, lanes, kind)
            continue
        if turns(support):
            _rotation(axes, support, x, end, lanes.size * bool(beside_axial & {x}))
            continue
        if support.rotation == "fixed":
            _clamp(axes, x, end)
            if support.side == "both":
                continue
        elif support.rotation != "free" and support.rotation:
            _spiral(axes, x, end, "black", "rotational spring", off=lanes.size * bool(beside_axial & {x}))
        for sign in (1.0, -1.0):
            if support.side == ("above" if sign > 0 else "below"):
                continue
            y = HALF + (OFF if _stands_off(support, state) else 0.0)
            label = f"{state} {'below' if sign > 0 else 'above'}"
            symbols[label, kind, sign].append((x, -sign * y))
            y += lanes.size
            if _is_elastic(support):
                springs[sign].append((x, -sign * y))
                y += lanes.size
            ground[sign].append((x, -sign * y))
        if support.settlement:
            settled[math.copysign(1.0, support.settlement)].append((x, -y if support.side != "above" else y))
    for sign, points in settled.items():  # a small arrow beside the symbol
        x, y = np.transpose(points)
        axes.scatter(x, y, marker=mirrored(_SETTLED, sign), s=area(6.0), facecolors="none",
                     edgecolors=VERMILION, linewidths=1.0, zorder=5, transform=shifted(axes, 1.1 * lanes.size),
                     label="settlements")  # fmt: skip
    for (label, kind, sign), points in symbols.items():
        x, y = np.transpose(points)
        symbol = SYMBOLS[kind]
        axes.scatter(x, y, marker=mirrored(symbol.path, sign), s=area(lanes.size), facecolors=symbol.face,
                     edgecolors=symbol.edge, linewidths=symbol.width, zorder=5, label=label)  # fmt: skip
    for name, path, sets in (("springs", _SPRING, springs), ("ground", _GROUND, ground)):
        for sign, points in sets.items():
            x, y = np.transpose(points)
            axes.scatter(x, y, marker=mirrored(path, sign), s=area(lanes.size * (1.0 if name == "springs" else 0.75)),
                         facecolors="none", edgecolors="black", linewidths=0.7, zorder=4, label=name)  # fmt: skip


def _spiral(
    axes: Axes | Turned, x: float, end: float, color: str, label: str, side: str | None = None, off: float = 0.0
) -> None:  # fmt: skip
    outward = -8.0 - off if x <= 1e-9 * end or side == "left" else 8.0 + off if x >= end * (1.0 - 1e-9) or side else 0.0
    axes.scatter([x], [0.0], marker=_SPIRAL, s=area(7.0), facecolors="none", edgecolors=color, zorder=6,
                 linewidths=0.9, transform=shifted(axes, outward), label=label)  # fmt: skip


def _rotation(axes: Axes | Turned, support: "Support", x: float, end: float, off: float) -> None:
    """Draw what holds a rotation by a law, with a slack, one way or beside a hinge: a spiral, or a hinge that is not white."""
    if support.direction == "rotational":
        _spiral(axes, x, end, VERMILION, "rotations at hinges" if support.at_hinge else "rotations with laws", support.at_hinge,
                off)  # fmt: skip
    else:
        axes.scatter([x], [0.0], s=26, c="0.8", edgecolors=VERMILION, linewidths=1.2, zorder=6, marker="o",
                     label="hinges with laws")  # fmt: skip


def _clamp(axes: Axes | Turned, x: float, end: float) -> None:
    """Draw a wall at an end of the beam, a wall on either side inside it."""
    for sign in (1.0, -1.0):
        if (sign < 0.0 and x <= 1e-9 * end) or (sign > 0.0 and x >= end * (1.0 - 1e-9)):
            continue  # nothing of the beam on that side
        vertices = _WALL.vertices * (sign, 1.0)
        axes.scatter([x], [0.0], marker=Path(vertices, _WALL.codes), s=area(11.0), facecolors="none",
                     edgecolors="black", linewidths=1.0, zorder=5, label="clamp")  # fmt: skip


def _ground_along(axes: Axes | Turned, scene: "Scene") -> None:
    """Mark where ground holds the beam along its axis."""
    marks = places_of_marks(scene)
    axes.scatter(marks, [HALF + 3.5] * len(marks), marker=_ALONG, s=30, facecolors="none", edgecolors="0.35", linewidths=0.7,
                 zorder=4, label="ground along the beam")  # fmt: skip


def _axial(axes: Axes | Turned, scene: "Scene", x: float, end: float, lanes: SupportLanes, kind: str) -> None:
    """Draw a horizontal support: a triangle outside the end of the beam, or under it where it is inside."""
    outward = -1.0 if x <= end / 2 else 1.0
    clamped = any(
        support.rotation == "fixed" and place == x
        for support, place in zip(scene.supports, lanes.x, strict=True)
    )
    path = Path(TRIANGLE.vertices[:, ::-1] * (-outward, 1.0), TRIANGLE.codes)
    beside = shifted(axes, outward * (6.0 if clamped else 1.0))
    symbol = SYMBOLS[kind]
    axes.scatter([x], [0.0], marker=path, s=area(lanes.size), facecolors=symbol.face, edgecolors=symbol.edge,
                 linewidths=symbol.width, zorder=5, transform=beside, label="axial")  # fmt: skip


def _ticks(axes: Axes | Turned, scene: "Scene", states: tuple[str, ...], lanes: SupportLanes) -> None:
    """Draw one row of ticks for every state and side."""
    groups = defaultdict(list)
    for support, state, x in zip(scene.supports, states, lanes.x, strict=True):
        groups[_group(support, state)].append(x)
    for row, label in enumerate(lanes.rows):
        y = -lanes.first_row - 11.0 * row
        x = groups[label]
        axes.scatter(x, [y] * len(x), marker="|", s=64, c="black", linewidths=min(1.5, max(0.25, 0.6 * lanes.spacing)),
                     zorder=4, label=label)  # fmt: skip
        state, _, side = label.partition(" ")
        words = "along the beam" if label == "axial" else f"{state_in_words(state)} {side}".strip()
        axes.annotate(words, (0.0, y), (-4, 0), xycoords=("data", "data"), textcoords="offset points", fontsize=6.5,
                      ha="right", va="center", annotation_clip=False, rotation=90 * is_turned(axes))  # fmt: skip
