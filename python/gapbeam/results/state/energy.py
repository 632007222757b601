"""Work of the loads, for the energy between two states of a path."""

from __future__ import annotations

import numpy as np

from ...engine.beam import Beam
from ...engine.quantities import FIELDS
from ...engine.states import Solution
from ...scene.loads import CurvatureLoad, ForceLoad, MomentLoad
from ...scene.structs import Scene
from .smooth import SmoothLaws
from .step import Step

POINTS, WEIGHTS = np.polynomial.legendre.leggauss(4)
"""Exact for the fields of a piece times a load that is linear there."""


def work_of_loads(scene: Scene, case: str, beam: Beam, step: Step) -> float:
    """Work that the live or the dead loads in full would do along the displacements of a state.

    Parameters
    ----------
    scene : Scene
        With the loads; those along the axis are left out.
    case : {"live", "dead"}
        Which of them.
    beam : Beam
        Its beam.
    step : Step
        A state of it.

    Returns
    -------
    float
        Force times length; of imposed curvatures what the moments do along them.
    """
    total = 0.0
    ends = scene.span_ends()
    for load in scene.loads:
        if load.case != case:
            continue
        if isinstance(load, ForceLoad | MomentLoad):
            x = scene.positions([load])
            kind, value = ("deflection", load.F) if isinstance(load, ForceLoad) else ("rotation", load.M)
            # A couple at a hinge is refused, so the rotation has one value
            total += value * _field(beam, step, kind, *beam.find(x, left=bool(x[0] > 0.0)))[0]
        elif hasattr(load, "to"):
            total += _along(beam, step, load, load.from_, float(ends[-1]) if load.to is None else load.to)
    return total


def bulge(beam: Beam, start: Solution, stop: Solution) -> float:
    """Area between smooth laws and their chords, along a path on which all else is linear.

    What the loads do between two states is the mean of their work at both times what they grow by, less this area: for the
    supports with smooth laws hand over the difference (Betti).

    Parameters
    ----------
    beam : Beam
        The beam.
    start, stop : Solution
        States on the laws.

    Returns
    -------
    float
        Force times length.
    """
    if not beam.curves:
        return 0.0
    laws, found = SmoothLaws(beam), 0.0
    ends = [laws.deflections(solution) for solution in (start, stop)]
    (d_start, way_start), (d_stop, way_stop) = map(laws.past_the_gap, ends)
    forces = [way * laws.forces_and_slopes(d)[0] for d, way in ((d_start, way_start), (d_stop, way_stop))]
    for i, curve in enumerate(laws.curves):
        chord = (forces[0][i] + forces[1][i]) / 2 * (ends[1][i] - ends[0][i])
        found += curve.values(max(d_stop[i], 0.0)).work - curve.values(max(d_start[i], 0.0)).work - chord
    return float(found)


def _along(beam: Beam, step: Step, load: object, start: float, stop: float) -> float:
    """Work of a distributed load or an imposed curvature."""
    x, length = beam.places.point_x, beam.places.pieces[:, 0]
    middle = (x[:-1] + x[1:]) / 2
    which = np.flatnonzero((middle > start) & (middle < stop))
    share = (POINTS + 1) / 2
    piece = np.repeat(which, len(share)).astype(np.int32)
    distance = (length[which][:, None] * share).ravel()
    weight = (length[which][:, None] * WEIGHTS / 2).ravel()
    if isinstance(load, CurvatureLoad):
        return -float(np.dot(weight, _field(beam, step, "moment", piece + np.int32(1), distance))) * load.kappa
    first, last = load.q if isinstance(load.q, tuple) else (load.q, load.q)
    q = first + (last - first) * ((x[piece] + distance - start) / (stop - start))
    return float(np.dot(weight * q, _field(beam, step, "deflection", piece + np.int32(1), distance)))


def _field(beam: Beam, step: Step, kind: str, piece: np.ndarray, distance: np.ndarray) -> np.ndarray:
    return step.solution.values(piece, distance)[FIELDS.index(kind)]
