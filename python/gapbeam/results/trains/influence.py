"""Influence lines on foundations and smooth laws: of the beam on what acts, with the slopes that laws have there.

The ends of zones of contact move with a small force, but what they change is of its second order.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from msgspec.structs import replace as replace_struct

from ...engine.beam import SOLVED, Beam
from ...engine.quantities import FIELDS
from ...engine.units import scaled
from ...scene.columns import columns
from ...scene.ground_laws import (
    CubicGround,
    HardeningGround,
    HyperbolicGround,
    PowerGround,
    TanhGround,
    ground_points,
    is_straight,
    slopes_of_branch,
    varies,
)
from ...scene.ground_tables import is_table
from ...scene.loads import ForceLoad
from ...scene.names import label
from ...scene.reading import beam_of_columns
from ...scene.rotations import with_stiffness
from ...scene.structs import Foundation, Scene, Support
from ..envelopes.envelope import AT_SUPPORTS
from ..state.breakpoints import piece_of
from ..state.ground import TOUCHING, Contact

if TYPE_CHECKING:
    from .trains import TrainState


def influence_line(state: TrainState, what: str, x: float, chosen: np.ndarray, places: np.ndarray, side: str) -> np.ndarray:
    """Give an influence line, as `ExactTraversal.influence`; of pressures too.

    Raises
    ------
    ValueError
        Ground whose law is a curve, or nothing that holds the beam when its zones stay as they are.
    """
    scene = _linear(state)
    taken = columns(scene)
    values = []
    for place in places.tolist():
        load = taken.load.copy(order="F")
        load[0, 0] = place
        beam = beam_of_columns(scene, replace(taken, load=load))
        solution = beam.solve(1.0, "block", np.ones(beam.supports, dtype=np.int32))
        if solution.status != SOLVED:
            raise ValueError(f"position: what acts there does not hold the beam against a small force at x = {place:g}")
        if what in AT_SUPPORTS:
            values.append(float(solution.at_supports[AT_SUPPORTS.index(what), chosen].sum()))
            continue
        piece, distance = beam.find(np.array([x]), side == "left")
        fields = solution.values(piece, distance)
        row = FIELDS.index(what)
        values.append(float(fields[row, 0]) if row < len(fields) else 0.0)
    return np.array(values)


def _linear(state: TrainState) -> Scene:
    """The beam on what acts, which holds it both ways, with a unit force."""
    scene, beam = state.result.scene, state.result._beam
    supports = [_support(scene.supports[k], slope) for k, slope in enumerate(_slopes(state, beam))]
    ground = [_foundation(scene, zone) for zone in state.contact if zone.state != TOUCHING]
    return replace_struct(
        scene, supports=supports, foundation=[one for one in ground if one is not None], loads=[ForceLoad(x=0.0, F=1.0)],
        combinations=[],
    )  # fmt: skip


def _slopes(state: TrainState, beam: Beam) -> list[float]:
    """Stiffness with which every support holds the beam; 0 where it is open."""
    found = [
        support.stiffness if held != "open" else 0.0
        for support, held in zip(state.result.scene.supports, state.state, strict=True)
    ]
    units = beam.units
    for k in beam.laws if beam.has_laws else ():
        slope = piece_of(beam, k, state.closed, beam.breakpoints).slope
        found[k] = float(scaled(np.float64(slope), units.force - units.deflection))
    for (k, _), slope in zip(beam.curves, state.solution.slopes().tolist(), strict=True):
        found[k] = slope
    return found


def _support(support: Support, slope: float) -> Support:
    plain = replace_struct(support, side="both", law=None, unloading="elastic", gap=0.0, settlement=0.0)
    return with_stiffness(plain, slope)


def _foundation(scene: Scene, zone: Contact) -> Foundation | None:
    """Linear ground in a zone of contact; None where it gives way without more force."""
    item = scene.foundation[zone.foundation]
    to = scene.span_ends()[-1] if item.to is None else item.to
    shares = [(at - item.from_) / (to - item.from_) for at in (zone.from_, zone.to)]
    slope = _slope_of(scene, zone)
    if is_table(slope):
        carries = any(value > 0.0 for _, value in slope)
        return Foundation(from_=zone.from_, to=zone.to, k=slope, side="both") if carries else None
    ends = slope if isinstance(slope, tuple) else (slope, slope)
    k = tuple(max(ends[0] + share * (ends[1] - ends[0]), 0.0) for share in shares)
    return Foundation(from_=zone.from_, to=zone.to, k=k, side="both") if max(k) > 0.0 else None


def _slope_of(scene: Scene, zone: Contact) -> Any:
    """Stiffness of a foundation in a zone, one number, those at the ends of the foundation, or a table."""
    item = scene.foundation[zone.foundation]
    if item.law is None:
        return item.k
    bent = varies(item.law) and not is_straight(item.law)
    if bent or isinstance(item.law, (HyperbolicGround, TanhGround, CubicGround, PowerGround)):
        name = label(scene.foundation, zone.foundation)
        problem = f"foundation {name} acts by a curve there"
        raise ValueError(f"position: {problem}; influence lines need straight laws, so give a polyline")
    branch = int(zone.state.split()[-1])
    if varies(item.law):
        return slopes_of_branch(item.law, branch)
    points = ground_points(item.law)
    if points is not None:
        points = [(0.0, 0.0), *points]
        (d, force), (further, more) = points[min(branch, len(points) - 1) - 1 : min(branch, len(points) - 1) + 1]
        return (more - force) / (further - d)
    if branch == 1:
        return item.law.stiffness
    return item.law.slope if isinstance(item.law, HardeningGround) else 0.0
