"""Where a beam slides over ground along its axis."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...engine.axial_ground import parts_that_slide
from .ground import with_places

if TYPE_CHECKING:
    from .step import Step

WAYS = {1: "right", -1: "left"}
JOINED = 1e-12
"""Ends of parts nearer than this share of the beam are one place."""


class SlipZone(NamedTuple):
    """A stretch over which the beam slides one way; over ground that is rigid up to its limit, or has slid last.

    Attributes
    ----------
    from_, to : float
        Its ends.
    way : {"right", "left"}
        Which way the beam goes, or went.
    friction : float
        Force of the ground on the beam along it, positive to the right.
    """

    from_: float
    to: float
    way: str
    friction: float


def slip_zones(step: Step) -> tuple[SlipZone, ...]:
    """Find the slip zones of a state.

    Parameters
    ----------
    step : Step
        The state.

    Returns
    -------
    tuple of SlipZone
        From left to right; none without ground along the beam.
    """
    if not step._beam.is_on_axial_ground:
        return ()
    places, ways, forces = parts_that_slide(step.solution)
    near, found = JOINED * float(step._beam.places.point_x[-1]), []
    for a, b, way, force in zip(*places.tolist(), map(WAYS.__getitem__, ways.tolist()), forces.tolist(), strict=True):
        if found and found[-1].way == way and a - found[-1].to <= near:
            last = found.pop()
            a, force = last.from_, last.friction + force
        if b - a > near:
            found.append(SlipZone(a, b, way, force))
    return tuple(found)


def with_ends_of_slip(piece: np.ndarray, distance: np.ndarray, step: Step) -> tuple[np.ndarray, np.ndarray]:
    """Add the ends of the slip zones to places along a beam, where the axial force has kinks.

    Parameters
    ----------
    piece, distance : numpy.ndarray
        Pieces from 0, from left to right, and distances from their left ends.
    step : Step
        The state.
    """
    ends = np.array([x for zone in step.slip_zones for x in (zone.from_, zone.to)])
    pieces, distances = step._beam.find(ends, left=False)
    return with_places(piece, distance, (pieces - 1).astype(piece.dtype), distances)
