"""Masses of a beam that stand at a place."""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite
from typing import TYPE_CHECKING

import numpy as np

from ..base.errors import SceneError
from ..engine.tolerances import POSITION_TOLERANCE
from .table import NotNegative, Point
from .wording import number

if TYPE_CHECKING:
    from .structs import Beam


class Mass(Point, kw_only=True, gc=False):
    """A mass at a place that moves with the beam, for `analysis.frequencies`; its weight is a load of its own.

    Parameters
    ----------
    mass : float
        Mass (force*time^2/length): t with kN, m and s.
    """

    mass: NotNegative


def check_masses(beam: Beam, masses: Sequence[Mass], places: np.ndarray) -> None:
    """Refuse masses that make no sense, whether or not frequencies are asked for.

    Parameters
    ----------
    beam : Beam
        Keys and types are right.
    masses : sequence of Mass
        Those at places.
    places : numpy.ndarray
        Their x, of no meaning where there is none.

    Raises
    ------
    SceneError
        Names the key and the value.
    """
    given = beam.mass if isinstance(beam.mass, list) else [beam.mass]
    for i, mass in enumerate(given):
        _check_mass(mass, f"beam.mass[{i}]" if isinstance(beam.mass, list) else "beam.mass")
    last, end = len(beam.spans), sum(beam.spans)
    for i, (one, x) in enumerate(zip(masses, places.tolist(), strict=True)):
        place = f"masses[{i}]"
        if one.x is one.node is None:
            raise SceneError(place, "its position is missing; give node or x")
        if one.node is not None and not 0 <= one.node <= last:
            raise SceneError(f"{place}.node", f"there is no node {one.node}; the nodes of the beam are 0 to {last}")
        if one.x is not None and not -POSITION_TOLERANCE * end <= x <= end * (1.0 + POSITION_TOLERANCE) and not _is_off(beam):
            raise SceneError(f"{place}.x", f"{number(x)} is outside the beam, which runs from x = 0 to x = {number(end)}")
        _check_mass(one.mass, f"{place}.mass")


def _is_off(beam: Beam) -> bool:
    """Tell whether spans make no sense, which is refused of them."""
    return not all(isfinite(span) and span > 0.0 for span in beam.spans)


def _check_mass(mass: float, place: str) -> None:
    if not (isfinite(mass) and mass >= 0.0):
        raise SceneError(place, f"expected a finite number, 0 or more, got {number(mass)}")
