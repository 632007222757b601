"""Places, supports and laws along a prepared beam, and how its states depend on the loads."""

from __future__ import annotations

from functools import cached_property
from typing import Protocol

import numpy as np

from ..base.records import read_only
from . import calls as _engine
from .arrays import Columns, Places
from .laws import CurveValues

AXIAL, ROTATIONAL, RELATIVE = 1, (2, 4, 5), 3
"""Directions of supports along the beam, of its rotation (also left and right of a hinge), and of a hinge, as in gapbeam_scene."""


class Curve(Protocol):
    """A smooth law."""

    def scale(self) -> float:
        """Give a displacement that is typical of the law."""

    def values(self, d: float) -> CurveValues:
        """Give all that the law has at such a displacement."""


class Layout:
    """What there is along a beam.

    Attributes
    ----------
    handle, columns, curves, pieces, links, supports, scene_supports, in_stretches, depends_on_path, has_links_along
        As of `Beam`.
    is_on_axial_ground
        As of `Beam`.
    """

    handle: _engine.Handle
    columns: Columns
    curves: tuple[tuple[int, Curve], ...]
    pieces: int
    links: int
    supports: int
    scene_supports: int
    in_stretches: bool
    depends_on_path: bool
    has_links_along: bool
    is_on_axial_ground: bool

    @cached_property
    def places(self) -> Places:
        """What there is along it."""
        end, x, span, pieces, dead, live, points, kinds, turning, force, couple, at, levels = _engine.gbplac(
            self.handle, self.pieces, self.links, self.supports, self.scene_supports
        )
        return Places(
            end, x, span, pieces.T, dead.T, live.T, points, kinds, turning, force.T, couple.T, at[:-1], levels[:-1]
        )

    @cached_property
    def node_x(self) -> np.ndarray:
        """X of every node."""
        return read_only(self.places.point_x[self.places.node_points])

    @cached_property
    def _numbered(self) -> tuple[np.ndarray, np.ndarray]:
        number, laws = _engine.gbnumb(self.handle, self.supports)
        return read_only(number[:-1]), read_only(laws[:, :-1])

    @property
    def numbers(self) -> np.ndarray:
        """Number in the scene of every support of the engine: those across the beam that can carry, a law once a breakpoint."""
        return self._numbered[0]

    @property
    def breakpoints(self) -> np.ndarray:
        """Contact level, force, slope and slope before (rows) of every support of the engine, in its units."""
        return self._numbered[1]

    @cached_property
    def laws(self) -> dict[int, tuple[slice, int, int]]:
        """Supports of the scene with a law: its breakpoints, how many are below its middle, piece there, 0 if it is open."""
        which = self.columns.with_laws()
        which = which[self.bends[which]]
        first, last = (np.searchsorted(self.numbers, which, side=side) for side in ("left", "right"))
        breakpoints = last - first
        both, gap = self.sides[which] == 0, self.columns.support[2, which]
        one_piece = both & (breakpoints == 1)
        middle = np.where(one_piece, 1, np.where(both, breakpoints // 2, 0))
        at_middle = (both & (gap == 0.0)).astype(int)
        rows = zip(map(slice, first.tolist(), last.tolist()), middle.tolist(), at_middle.tolist(), strict=True)
        return dict(zip(which.tolist(), rows, strict=True))

    @cached_property
    def smooth(self) -> frozenset[int]:
        """Supports of the scene with a smooth law."""
        return frozenset(number for number, _ in self.curves)

    @cached_property
    def across(self) -> np.ndarray:
        """Which supports of the scene are across the beam, neither axial nor of a rotation."""
        return read_only(self.columns.support_codes[1, :-1] == 0)

    @cached_property
    def bends(self) -> np.ndarray:
        """Which supports of the scene bend the beam: all but axial ones."""
        return read_only(self.columns.support_codes[1, :-1] != AXIAL)

    @cached_property
    def sides(self) -> np.ndarray:
        """Side of every support of the scene."""
        return self.columns.support_codes[0, :-1]

    @property
    def is_linear_between_events(self) -> bool:
        """Whether values are linear in the loads from one event to the next: no zones that change, and no law that is a curve.

        Histories are followed in stretches only that stay as they are.
        """
        return not (self.curves or self.is_on_axial_ground or (self.in_stretches and not self.depends_on_path))

    @property
    def beyond_one_search(self) -> str | None:
        """What states take beyond one search for the supports that act: the ``path`` of the load, or a ``curve``; None: nothing."""
        return "path" if self.depends_on_path else "curve" if self.curves else None

    @property
    def is_solved_alone(self) -> bool:
        """Whether no other case helps to solve a case: on ground, with an axial force that bending feels, on curves, on a path."""
        return self.in_stretches or self.beyond_one_search is not None

    @property
    def has_one_sided_ground(self) -> bool:
        """Whether some foundation acts one way only, or by a law."""
        return bool(self.columns.foundation_sides[:-1].any()) or len(self.columns.ground_law_foundations) > 1
