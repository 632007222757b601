"""Loads that move supports, hinges and ground: an arrow beside the support, an arc where it turns, with value and unit."""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.path import Path

from ..scene.loads import MovementLoad
from ..scene.movements import number_of_moved, share_of
from ..scene.rotations import turns
from .load_symbols import CLOCKWISE
from .loads import name_or_case
from .sheet import is_upright
from .states import area
from .support_values import LYING, UPRIGHT, with_unit
from .turned import Turned, shifted

if TYPE_CHECKING:
    from ..scene.structs import Scene

TURN, LONG = 15.0, 13.0
"""Radius of an arc, length of an arrow (points)."""
_ARROW = Path([(0, 0), (0, -0.7), (0, -1), (-0.22, -0.55), (0.22, -0.55), (0, -1)], [1, 2, 1, 2, 2, 79])
"""From its foot in the origin downward."""


class Movement(NamedTuple):
    """What a load does to a support: ``"across"`` the beam, ``"along"`` it or ``"turn"``; its value, and words."""

    support: int
    kind: str
    value: float
    words: str


class Movements:
    """Loads that move supports and ground, as far as they act.

    Parameters
    ----------
    scene : Scene
        The scene.
    factor : float
        Load factor of all loads but the dead ones.

    Attributes
    ----------
    supports : list of Movement
        Those of supports, restraints and hinges.
    ground : dict of int to list of str
        Words for those of foundations, by number.
    """

    def __init__(self, scene: Scene, factor: float = 1.0) -> None:
        self.supports: list[Movement] = []
        self.ground: dict[int, list[str]] = defaultdict(list)
        (along, around), (across, _) = (UPRIGHT, LYING) if is_upright(scene) else (LYING, UPRIGHT)
        cases = len({load.case for load in scene.loads})
        for k, load in enumerate(scene.loads):
            share = share_of(load, factor)
            if not isinstance(load, MovementLoad) or not share:
                continue
            name, which = name_or_case(load, cases), number_of_moved(scene, k, load)
            if load.foundation is not None:
                first, last = (share * value for value in np.broadcast_to(load.value, 2).tolist())
                ends = [f"{f'{across[end > 0.0]} ' * bool(end)}{with_unit(scene, 'gap', abs(end))}" for end in (first, last)]
                self.ground[which].append(f"moves {' to '.join(dict.fromkeys(ends))} {name}".rstrip())
                continue
            value = share * (load.value if load.rotation is None else load.rotation)
            support = scene.supports[which]
            kind = "turn" if turns(support) or load.rotation is not None else "along" if support.direction == "axial" else "across"
            arrows = {"turn": around, "along": along, "across": across}[kind]
            size = with_unit(scene, "rotation" if kind == "turn" else "gap", abs(value))
            verb = "turns" if kind == "turn" else "moves"
            self.supports.append(Movement(which, kind, value, f"{verb} {arrows[value > 0.0]} {size} {name}".rstrip()))

    def words(self, k: int) -> dict[str, str]:
        """Word what moves a support, by a kind for each."""
        said = [one.words for one in self.supports if one.support == k]
        return {f"movement {i}": words for i, words in enumerate(said)}

    @property
    def above(self) -> float:
        """What arcs take above the axis of the beam (points)."""
        return TURN + 1.0 if any(one.kind == "turn" for one in self.supports) else 0.0

    @property
    def below(self) -> float:
        """What arrows and arcs take below it (points)."""
        return LONG + 4.0 if self.supports else 0.0


def draw_movements(axes: Axes | Turned, movements: Movements, x: np.ndarray, end: float, size: float) -> None:
    """Draw an arrow or an arc at every support that a load moves.

    Parameters
    ----------
    axes : matplotlib.axes.Axes or Turned
        The panel of the beam; its vertical unit is one point.
    movements : Movements
        What moves.
    x : numpy.ndarray
        Places of the supports.
    end : float
        Length of the beam.
    size : float
        Height of the symbol of a support (points).
    """
    for one in movements.supports:
        place, sign = float(x[one.support]), 1.0 if one.value > 0.0 else -1.0
        look = {"facecolors": "black", "edgecolors": "black", "linewidths": 1.1, "zorder": 6, "label": f"moves {one.kind}"}
        if one.kind == "turn":
            path = Path(CLOCKWISE.vertices * (sign, 1.0), CLOCKWISE.codes)
            axes.scatter([place], [0.0], marker=path, s=area(TURN), **(look | {"facecolors": "none"}))
        elif one.kind == "along":  # outside an end of the beam, beyond the symbol of the support
            outward = -1.0 if place <= end / 2 else 1.0
            path = Path(_ARROW.vertices[:, ::-1] * (-sign, 1.0), _ARROW.codes)
            off = outward * (size + 8.0) + (-LONG if sign * outward < 0.0 else 0.0) * sign
            axes.scatter([place], [0.0], marker=path, s=area(LONG), transform=shifted(axes, off), **look)
        else:
            path = Path(_ARROW.vertices * (1.0, sign), _ARROW.codes)
            axes.scatter([place], [-3.0 if sign > 0.0 else -3.0 - LONG], marker=path, s=area(LONG),
                         transform=shifted(axes, -size - 4.0), **look)  # fmt: skip
