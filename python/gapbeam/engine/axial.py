"""The axial system of a scene: bars between points with an axial load or support, in units of its own.

Signs: displacements and forces positive to the right, forces in bars in tension.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..base.errors import EngineError, Status, check_status
from ..base.records import Record, read_only
from ..scene.structs import AxialLoad, Scene
from ..scene.wording import number
from . import calls as _f77  # the engine itself, but for Ctrl-C
from .arrays import is_lost, refuse_range
from .units import Units, choose_axial_units, middle_exponent, scaled

if TYPE_CHECKING:
    from ..scene.places import Points
    from .lowering import Arrays


@dataclass(frozen=True, slots=True, eq=False)
class Axial(Record):
    """The axial system; numbers in its own units.

    Attributes
    ----------
    units : Units
        Of force and deflection, here the displacement along the axis.
    points : numpy.ndarray of int
        Points of the beam that are its nodes, n + 1.
    softness : numpy.ndarray
        Length/EA of every piece of the beam.
    flexibility : numpy.ndarray
        int 1/EA over each bar, n.
    force : numpy.ndarray
        Dead and live force at each point, positive to the right, 2 by n + 1.
    stiffness, settlement : numpy.ndarray
        Support of each point (0: none), n + 1.
    supports : numpy.ndarray of int
        Axial supports of the scene, by their number there.
    support_points : numpy.ndarray of int
        The point (0..n) of each of them.
    loads, load_points : numpy.ndarray of int
        Axial loads of the scene, by their number there, and the point (0..n) of each of them.
    load_force : numpy.ndarray
        Their forces.
    """

    units: Units
    points: np.ndarray
    softness: np.ndarray
    flexibility: np.ndarray
    force: np.ndarray
    stiffness: np.ndarray
    settlement: np.ndarray
    supports: np.ndarray
    support_points: np.ndarray
    loads: np.ndarray
    load_points: np.ndarray
    load_force: np.ndarray

    def with_factors(self, factors: np.ndarray) -> np.ndarray:
        """Sum the axial loads, each times a factor.

        Parameters
        ----------
        factors : numpy.ndarray
            Factor of every load of the scene.

        Returns
        -------
        numpy.ndarray
            Force at each point, n + 1.
        """
        return np.bincount(self.load_points, factors[self.loads] * self.load_force, len(self.points))


def lower_axial(scene: Scene, points: Points, x: np.ndarray, length: np.ndarray, EA: np.ndarray) -> Axial | None:
    """Build the axial system of a scene.

    Parameters
    ----------
    scene : Scene
        A checked scene.
    points : Points
        Its points.
    x : numpy.ndarray
        Their places.
    length, EA : numpy.ndarray
        Of every piece between two points.

    Returns
    -------
    Axial or None
        None where no axial load and no settlement asks for one.

    Raises
    ------
    EngineError
        A number left the range of double precision: which one.
    """
    supports = np.array([k for k, support in enumerate(scene.supports) if support.direction == "axial"], dtype=int)
    loads = np.array([k for k, load in enumerate(scene.loads) if isinstance(load, AxialLoad)], dtype=int)
    settlement = np.array([scene.supports[k].settlement for k in supports], dtype=float)
    if not loads.size and not settlement.any():
        return None
    stiffness = np.array([scene.supports[k].stiffness for k in supports], dtype=float)
    load_force = np.array([scene.loads[k].F for k in loads], dtype=float)
    units = choose_axial_units(length, EA, stiffness, load_force, settlement)
    unit = middle_exponent(length)
    with np.errstate(over="ignore"):
        softness = scaled(length, -unit) / scaled(EA, -unit - units.stiffness)
    for k in np.flatnonzero(is_lost(softness, np.isfinite(EA)))[:1]:
        where = f"from x = {number(x[k])} to x = {number(x[k + 1])}"
        refuse_range(f"EA = {number(EA[k])} {where} is too far from the other axial stiffnesses", "bring them nearer together")
    held = scaled(stiffness, -units.stiffness)
    for k in np.flatnonzero(is_lost(held, np.isfinite(stiffness) & (stiffness > 0.0)))[:1]:
        what = f"supports[{supports[k]}].stiffness = {number(stiffness[k])} is too far from the axial stiffness of the beam"
        refuse_range(what, "give inf (rigid) or 0 instead")
    nodes = np.unique(np.concatenate(([0, len(length)], points.load_from[loads], points.supports[supports])))
    support_points, load_points = np.searchsorted(nodes, points.supports[supports]), np.searchsorted(nodes, points.load_from[loads])
    at_nodes = np.zeros((2, len(nodes)))
    at_nodes[:, support_points] = held, scaled(settlement, -units.deflection)
    load_force = scaled(load_force, -units.force)
    dead = np.array([scene.loads[k].case == "dead" for k in loads], dtype=float)
    return Axial(
        units=units,
        points=nodes,
        softness=softness,
        flexibility=np.bincount(np.repeat(np.arange(len(nodes) - 1), np.diff(nodes)), softness),
        force=np.stack([np.bincount(load_points, share * load_force, len(nodes)) for share in (dead, 1.0 - dead)]),
        stiffness=at_nodes[0],
        settlement=at_nodes[1],
        supports=supports,
        support_points=support_points,
        loads=loads,
        load_points=load_points,
        load_force=load_force,
    )


def solve_axial(arrays: Arrays, factor: float) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
    """Solve the axial system.

    Parameters
    ----------
    arrays : Arrays
        The lowered scene, which has an axial system.
    factor : float
        Factor of the live loads.

    Returns
    -------
    displacement, tension, reaction : numpy.ndarray
        At its points, in its bars, at its points, in its own units; None where nothing holds the beam lengthwise.

    Raises
    ------
    EngineError
        Where a rigid stretch lies between two rigid supports.
    """
    axial = arrays.axial
    force = axial.force[0] + factor * axial.force[1]
    u, tension, reaction, state, place = _f77.gbaxia(axial.flexibility, force, axial.stiffness, axial.settlement)
    if state == Status.NO_MEMORY:
        check_status(state)
    if state == 2:
        x = arrays.point_x[axial.points[place]]
        raise EngineError(
            f"the axial support at x = {x:g} and another one hold a stretch with EA = inf at both ends, so their "
            "forces cannot be told apart: give the beam a finite EA",
            Status.INDETERMINATE,
        )
    return None if state == 1 else read_only((u, tension, reaction))
