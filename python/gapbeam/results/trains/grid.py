"""Positions of a train at which states are solved: places that axles come to, and the step of the grid between them."""

from __future__ import annotations

import numpy as np

from ...engine.beam import Beam
from ...scene.ground_laws import CubicGround, tables_of
from ...scene.loads import ForceLoad
from ...scene.structs import Scene

PER_LENGTH = 16
"""States in a length in which the beam bends, and in a mean span."""


def places_of_jumps(scene: Scene) -> np.ndarray:
    """Give the places at which the shear jumps without a train.

    Returns
    -------
    numpy.ndarray
        Of supports across the beam and of forces.
    """
    supports = [support for support in scene.supports if support.direction == "normal"]
    forces = [load for load in scene.loads if isinstance(load, ForceLoad)]
    return np.unique(np.concatenate((scene.positions(supports), scene.positions(forces))))


def places_of_kinks(scene: Scene) -> np.ndarray:
    """Give the places at which an axle makes a difference when it passes.

    Returns
    -------
    numpy.ndarray
        Ends of the beam, of spans, sections and foundations; supports, hinges, forces; where tables of ground have a kink.
    """
    ends = scene.span_ends()
    stretches = [(item.from_, ends[-1] if item.to is None else item.to) for item in (*scene.sections, *scene.foundation)]
    tables = [point[0] for item in scene.foundation for table in tables_of(item) for point in table]
    inside = [x for x in tables if ends[0] < x < ends[-1]]
    found = np.concatenate((ends, places_of_jumps(scene), scene.beam.hinges, np.array(stretches).ravel(), inside))
    return np.unique(found)


def grid_step(scene: Scene, beam: Beam, deflection: float) -> float:
    """Give the distance of positions at which states are solved.

    Parameters
    ----------
    scene : Scene
        The scene.
    beam : Beam
        Made of it.
    deflection : float
        How far it goes down about, for ground that gets stiffer by that.

    Returns
    -------
    float
        A share of the mean distance of supports, or of the length in which the beam bends on the stiffest ground.
    """
    end = beam.places.end
    spans = max(len(np.unique(scene.positions(scene.supports))) - 1, 1)
    greatest = beam.columns.greatest_of_ground()
    modulus = greatest[:2].max(initial=0.0)
    k1, _, k3 = greatest[1:, beam.columns.foundation[6, :-1] == CubicGround.code]
    modulus = max(modulus, (k1 + 3.0 * k3 * deflection**2).max(initial=0.0))
    modulus = max(modulus, beam.columns.slopes_of_laws().max(initial=0.0))
    stiffness = float(beam.places.pieces[:, 1].min())
    bends = (4.0 * stiffness / modulus) ** 0.25 if modulus > 0.0 and np.isfinite(stiffness) else end
    return min(end / spans, bends) / PER_LENGTH
