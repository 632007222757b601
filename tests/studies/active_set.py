"""What a user would write instead of calling gapbeam: an active set in numpy and scipy, the yardstick for contact at scale.

Cubic Hermite elements, all wrong supports switched at once, a banded Cholesky solve for every contact state; plain, or
incremental with a residual that is summed element by element. As short as such programs are: straight beams of one EI on elastic
one-sided supports and pins, uniform loads and forces at nodes.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from gapbeam.base.errors import GapbeamError

MOST_SOLVES = 200
"""Linear solves before giving up."""


class NoScheme(GapbeamError):
    """A program gave up before it had a contact state."""


@dataclass
class ActiveSet:
    """What the active set found.

    Attributes
    ----------
    deflection, reaction, moment : numpy.ndarray
        At the supports of the scene; moments sagging, right of them.
    closed : numpy.ndarray of bool
        Which of them act.
    solves : int
        Linear solves.
    """

    deflection: np.ndarray
    reaction: np.ndarray
    moment: np.ndarray
    closed: np.ndarray
    solves: int


def active_set(scene: Mapping[str, Any], parts: int, incremental: bool = False) -> ActiveSet:
    """Solve a scene.

    Parameters
    ----------
    scene : mapping
        Spans, one EI, supports at nodes (``below`` and elastic, or rigid and without side), uniform loads over whole spans,
        forces at nodes of the mesh.
    parts : int
        Elements a span is cut into.
    incremental : bool
        Whether the solution is improved by increments until they no longer get smaller.

    Raises
    ------
    GapbeamError
        scipy is missing.
    NoScheme
        No scheme was found.
    """
    try:
        from scipy.linalg import cho_solve_banded, cholesky_banded
    except ModuleNotFoundError:
        raise GapbeamError("this study compares with scipy: pip install scipy") from None
    spans, EI = np.array(scene["beam"]["spans"]), scene["beam"]["EI"]
    ends = np.concatenate(([0.0], np.cumsum(spans)))
    h = np.repeat(spans / parts, parts)
    load, q = _loads(scene, ends, h, parts)
    band = np.zeros((4, len(load)))
    k = 2.0 * EI / h**3
    for row, column, value in (
        (0, 0, 6.0 * k), (1, 0, 3.0 * k * h), (2, 0, -6.0 * k), (3, 0, 3.0 * k * h),
        (0, 1, 2.0 * k * h**2), (1, 1, -3.0 * k * h), (2, 1, k * h**2),
        (0, 2, 6.0 * k), (1, 2, -3.0 * k * h), (0, 3, 2.0 * k * h**2),
    ):  # fmt: skip
        band[row, column : column + 2 * len(h) : 2] += value
    at = 2 * parts * np.array([support["node"] for support in scene["supports"]])
    stiffness = np.array([support.get("stiffness", np.inf) for support in scene["supports"]])
    level = np.array([support.get("gap", 0.0) for support in scene["supports"]])
    pinned = at[np.isinf(stiffness)]
    for d in (1, 2, 3):
        band[d, pinned] = 0.0
        band[d, pinned[pinned >= d] - d] = 0.0
    elastic = np.isfinite(stiffness)
    springs, c, gap = at[elastic], stiffness[elastic], level[elastic]
    closed = np.ones(len(springs), dtype=bool)
    u, factored, last = np.zeros(len(load)), None, np.inf
    for solves in range(1, MOST_SOLVES + 1):
        pull = np.where(closed, c, 0.0)
        rest = load if solves == 1 or not incremental else load - _element_forces(u, h, EI)
        rest = rest.copy()
        rest[springs] -= pull * ((u[springs] if incremental else 0.0) - gap)
        rest[pinned] = 0.0
        if factored is None or not np.array_equal(factored[1], closed):
            matrix = band.copy()
            matrix[0, springs] += pull
            matrix[0, pinned] = 1.0
            factored, last = (cholesky_banded(matrix, overwrite_ab=True, lower=True, check_finite=False), closed), np.inf
        change = cho_solve_banded((factored[0], True), rest, overwrite_b=True, check_finite=False)
        largest = np.abs(change[::2]).max()
        if incremental and not largest < last / 2:
            break
        u = u + change if incremental else change
        same = np.array_equal(u[springs] > gap, closed)
        if same and (not incremental or largest <= 1e-16 * np.abs(u[::2]).max()):
            break
        last = largest if same else np.inf
        closed = u[springs] > gap
    else:
        raise NoScheme(f"the active set found no contact state in {MOST_SOLVES} solves")
    acts = np.ones(len(at), dtype=bool)
    acts[elastic] = closed
    reaction = np.zeros(len(at))
    reaction[elastic] = np.where(closed, c * (u[springs] - gap), 0.0)
    reaction[~elastic] = (load - _element_forces(u, h, EI))[pinned]
    moment = np.append(_end_couples(u, h, EI)[0] - q * h**2 / 12.0, 0.0)
    return ActiveSet(u[at], reaction, moment[at // 2], acts, solves)


def _loads(scene: Mapping[str, Any], ends: np.ndarray, h: np.ndarray, parts: int) -> tuple[np.ndarray, np.ndarray]:
    """Consistent nodal loads, (w, rotation) node by node, and the uniform load on every element."""
    uniform = [load for load in scene["loads"] if load["type"] == "uniform"]
    start = np.rint(np.interp([load.get("from", 0.0) for load in uniform], ends, np.arange(len(ends)))).astype(int)
    stop = np.rint(np.interp([load.get("to", ends[-1]) for load in uniform], ends, np.arange(len(ends)))).astype(int)
    change = np.zeros(len(ends))
    value = np.array([load["q"] for load in uniform])
    if np.all(stop == start + 1):  # a sum of differences would round
        q = np.zeros(len(ends) - 1)
        np.add.at(q, start, value)
    else:
        np.add.at(change, start, value)
        np.add.at(change, stop, -value)
        q = np.cumsum(change)[:-1]
    q = np.repeat(q, parts)
    load = np.zeros(2 * len(h) + 2)
    load[:-2:2] += q * h / 2.0
    load[2::2] += q * h / 2.0
    load[1:-2:2] += q * h**2 / 12.0
    load[3::2] -= q * h**2 / 12.0
    nodes = np.concatenate(([0.0], np.cumsum(h)))
    for force in scene["loads"]:
        if force["type"] == "force":
            load[2 * int(np.argmin(np.abs(nodes - force["x"])))] += force["F"]
    return load, q


def _end_couples(u: np.ndarray, h: np.ndarray, EI: float) -> tuple[np.ndarray, np.ndarray]:
    """Couples of all elements at their ends, from the turns of these against their chords: differences first."""
    chord = np.diff(u[::2]) / h
    first, last = u[1:-2:2] - chord, u[3::2] - chord
    k = 2.0 * EI / h
    return k * (2.0 * first + last), k * (first + 2.0 * last)


def _element_forces(u: np.ndarray, h: np.ndarray, EI: float) -> np.ndarray:
    """Forces of all elements on their nodes."""
    near, far = _end_couples(u, h, EI)
    shear = (near + far) / h
    force = np.zeros(len(u))
    force[:-2:2] += shear
    force[2::2] -= shear
    force[1:-2:2] += near
    force[3::2] += far
    return force
