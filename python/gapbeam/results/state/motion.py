"""Motions in words: free ones, those with which a beam buckles, and what ground whose force falls bears."""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ...base.errors import Status
from ...engine.beam import HINGE, Beam
from ...engine.modes import Buckling, buckled_shape
from ...engine.states import Solution

SLIDES = "the beam slides along its axis, no axial support holds it"
SLIDES_ON_GROUND = "the beam slides along its axis: the ground along it takes no more, and no axial support holds it"


class FallingGround(NamedTuple):
    """That a beam gives way because the force of the ground falls.

    Attributes
    ----------
    share : float
        Of the load factor, that the ground bears; 0 where it does not bear the dead loads.
    """

    share: float


def describe_motion(beam: Beam, motion: np.ndarray) -> str:
    """Say how a beam moves where nothing resists.

    Parameters
    ----------
    beam : Beam
    motion : numpy.ndarray
        Displacements of the nodes, positive downward, straight between hinges.

    Returns
    -------
    str
        For example "the beam tips about the support at x = 6: its left end goes up, its right end goes down; ...".
    """
    x = beam.node_x
    cuts = np.unique(np.concatenate(([0], np.flatnonzero(beam.places.kinds == HINGE), [len(x) - 1])))
    parts = [
        _describe_body(beam, motion, a, b)
        for a, b in pairwise(cuts)
        if max(abs(motion[a]), abs(motion[b])) > 0.0
    ]
    shown = parts[:4] + (["and so on"] if len(parts) > 4 else [])
    return "; ".join(shown) + "; the loads push it that way and no support resists"


def cause_of_fall(solution: Solution) -> Buckling | FallingGround | None:
    """Give how a beam buckles, or what falling ground bears; None where it simply moves.

    Parameters
    ----------
    solution : Solution
        Of a beam that does not stand.
    """
    if solution.status == Status.BUCKLES:
        return Buckling(solution.share, *buckled_shape(solution.state))
    return FallingGround(solution.share) if solution.share < 1.0 else None


def _describe_buckling(found: Buckling) -> str:
    """Say how a beam buckles."""
    k = int(np.abs(found.deflection).argmax())
    return f"with these loads the beam bears {found.share:.6g} times its axial forces, and gives way most at x = {found.x[k]:.6g}"


def _describe_falling_ground(found: FallingGround) -> str:
    """Say what falling ground bears."""
    if not found.share > 0.0:
        return "the force of the ground falls under the dead loads alone"
    return f"the force of the ground falls, and bears no more than {found.share:.12g} times that load factor"


def describe_fall(
    beam: Beam, where: str, motion: np.ndarray | None, cause: Buckling | FallingGround | None
) -> tuple[str, str]:
    """Say that a beam does not stand, and why.

    Parameters
    ----------
    beam : Beam
    where : str
        At or above which load factor; empty where that is said elsewhere.
    motion : numpy.ndarray or None
        Displacements of the nodes in the free motion; None where it slides along its axis.
    cause : Buckling, FallingGround or None
        How it buckles, or what falling ground bears; None where it simply moves.

    Returns
    -------
    status, reason : str
    """
    at = f" {where}" if where else ""
    if isinstance(cause, Buckling):
        return "buckles", f"buckles{at}: {_describe_buckling(cause)}"
    if cause is not None:
        return "no-equilibrium", f"no equilibrium{at}: {_describe_falling_ground(cause)}"
    slides = SLIDES_ON_GROUND if beam.is_on_axial_ground else SLIDES
    return "no-equilibrium", f"no equilibrium{at}: {slides if motion is None else describe_motion(beam, motion)}"


def _describe_body(beam: Beam, motion: np.ndarray, a: int, b: int) -> str:
    """One body between two hinges or ends, nodes a to b."""
    x = beam.node_x
    last = len(x) - 1
    if (a, b) == (0, last):
        name = "the beam"
    else:
        left = "the left end" if a == 0 else f"the hinge at x = {x[a]:g}"
        right = "the right end" if b == last else f"the hinge at x = {x[b]:g}"
        name = f"the part between {left} and {right}"
    size = max(abs(motion[a]), abs(motion[b]))
    if abs(motion[a] - motion[b]) <= 1e-9 * size:
        return f"{name} moves {'down' if motion[a] > 0 else 'up'} as a whole"
    if motion[a] * motion[b] > 0.0:
        return f"{name} moves {'down' if motion[a] > 0 else 'up'} and turns"
    pivot = x[a] + (x[b] - x[a]) * motion[a] / (motion[a] - motion[b])
    supports = x[beam.places.support_nodes]
    near = np.abs(supports - pivot) <= 1e-9 * (x[-1] - x[0])
    hinge_there = (a > 0 and pivot == x[a]) or (b < last and pivot == x[b])
    if near.any():
        about = f"the support at x = {supports[near][0]:g}"
    elif hinge_there:
        about = f"the hinge at x = {pivot:g}"
    else:
        about = f"x = {pivot:g}"
    left, right = ("goes down" if motion[k] > 0.0 else "goes up" if motion[k] < 0.0 else "stays" for k in (a, b))
    return f"{name} tips about {about}: its left end {left}, its right end {right}"
