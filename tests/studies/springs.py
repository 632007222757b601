"""A foundation as nodal springs: what a user writes who has no foundation, for gapbeam itself, scipy and OpenSees."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from gapbeam.results.stepping import solve

from .active_set import NoScheme, active_set


class Found(NamedTuple):
    """What one program found.

    Attributes
    ----------
    ends : numpy.ndarray
        Where contact begins and ends inside the beam, from left to right.
    deflection, moment : numpy.ndarray
        At the places asked for.
    """

    ends: np.ndarray
    deflection: np.ndarray
    moment: np.ndarray


PLACES = 10
"""Parts of the beam at whose ends deflection and moment are asked for: nodes of every mesh."""
MOST_ITERATIONS = 200
"""Newton iterations that OpenSees is allowed."""
SMALLEST_CHANGE = 1e-9
"""Norm of the last change that it is asked for; once no spring changes any more the one after is rounding."""


def as_springs(scene: Mapping[str, Any], elements: int, columns: bool = False) -> dict[str, Any]:
    """Put springs in the place of a foundation.

    Parameters
    ----------
    scene : mapping
        One span on one foundation with k, all over.
    elements : int
        Into which the beam is cut; there is one spring more, those at the ends of half the stiffness.
    columns : bool
        Whether the supports are columns instead of dicts.

    Returns
    -------
    dict
        The scene.

    Examples
    --------
    >>> made = as_springs({"beam": {"spans": [4.0], "EI": 1.0}, "foundation": [{"k": 3.0, "side": "below"}], "loads": []}, 2)
    >>> made["beam"]["spans"], [support["stiffness"] for support in made["supports"]]
    ([2.0, 2.0], [3.0, 6.0, 3.0])
    """
    h = scene["beam"]["spans"][0] / elements
    stiffness = np.full(elements + 1, scene["foundation"][0]["k"] * h)
    stiffness[[0, -1]] /= 2.0
    made = {key: value for key, value in scene.items() if key != "foundation"}
    if columns:
        supports: Any = {"node": np.arange(elements + 1), "side": "below", "stiffness": stiffness}
        spans: Any = np.full(elements, h)
    else:
        supports = [{"node": i, "side": "below", "stiffness": c} for i, c in enumerate(stiffness.tolist())]
        spans = [h] * elements
    return {**made, "beam": {**scene["beam"], "spans": spans}, "supports": supports}


def zeros(w: np.ndarray, h: float) -> np.ndarray:
    """Find where a line through deflections at equal distances crosses zero.

    Parameters
    ----------
    w : numpy.ndarray
        Deflections.
    h : float
        Distance of the nodes.

    Examples
    --------
    >>> zeros(np.array([-1.0, 3.0, 2.0]), 4.0)
    array([1.])
    """
    at = np.flatnonzero((w[1:] > 0.0) != (w[:-1] > 0.0))
    return h * (at + w[at] / (w[at] - w[at + 1]))


def by_gapbeam(scene: Mapping[str, Any], elements: int) -> Callable[[], Found]:
    """Make the call of gapbeam itself, supports as columns.

    Parameters
    ----------
    scene : mapping
        With a foundation.
    elements : int
        Of the mesh.

    Returns
    -------
    callable
    """
    made, length = as_springs(scene, elements, columns=True), scene["beam"]["spans"][0]

    def run() -> Found:
        result = solve(made)
        w = result.steps[-1].deflection
        at = result.at(places(length))
        return Found(zeros(w, length / elements), at.deflection, at.moment)

    return run


def by_scipy(scene: Mapping[str, Any], elements: int, incremental: bool) -> Callable[[], Found]:
    """Make the call of the active set in numpy and scipy.

    Parameters
    ----------
    scene : mapping
        With a foundation.
    elements : int
        Of the mesh.
    incremental : bool
        As for `active_set`.

    Returns
    -------
    callable
    """
    made, h = as_springs(scene, elements), scene["beam"]["spans"][0] / elements
    step = elements // PLACES

    def run() -> Found:
        found = active_set(made, 1, incremental)
        return Found(zeros(found.deflection, h), found.deflection[::step], found.moment[::step])

    return run


def by_opensees(scene: Mapping[str, Any], elements: int) -> Callable[[], Found]:
    """Make the call of OpenSees: elastic beam elements on springs without tension, Newton, banded matrix.

    Parameters
    ----------
    scene : mapping
        With a foundation; uniform loads all over, and forces at nodes of the mesh.
    elements : int
        Of the mesh.

    Returns
    -------
    callable
    """
    return partial(_opensees, scene, elements)


def _opensees(scene: Mapping[str, Any], n: int) -> Found:
    import openseespy.opensees as ops

    h = scene["beam"]["spans"][0] / n
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.geomTransf("Linear", 1)
    k = scene["foundation"][0]["k"]
    ops.uniaxialMaterial("ENT", 1, k * h)
    ops.uniaxialMaterial("ENT", 2, k * h / 2.0)
    for i in range(n + 1):
        ground = n + 1 + i
        ops.node(i, h * i, 0.0)
        ops.node(ground, h * i, 0.0)
        ops.fix(ground, 1, 1, 1)
        ops.element("zeroLength", ground, ground, i, "-mat", 2 if i in (0, n) else 1, "-dir", 2)
    ops.fix(0, 1, 0, 0)
    for i in range(n):
        ops.element("elasticBeamColumn", i, i, i + 1, 1.0, float(scene["beam"]["EI"]), 1.0, 1)
    ops.timeSeries("Constant", 1)
    ops.pattern("Plain", 1, 1)
    for load in scene["loads"]:
        if load["type"] == "uniform":
            ops.eleLoad("-range", 0, n - 1, "-type", "-beamUniform", -float(load["q"]))
        else:
            ops.load(round(load["x"] / h), 0.0, -float(load["F"]), 0.0)
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("BandSPD")
    ops.test("NormDispIncr", SMALLEST_CHANGE, MOST_ITERATIONS, 0)
    ops.algorithm("Newton")
    ops.integrator("LoadControl", 0.0)
    ops.analysis("Static", "-noWarnings")
    if ops.analyze(1):
        raise NoScheme("OpenSees does not converge")
    w = np.array([-ops.nodeDisp(i, 2) for i in range(n + 1)])
    step = n // PLACES
    moment = [-ops.eleResponse(i, "force")[2] for i in range(0, n, step)]
    return Found(zeros(w, h), w[::step], np.array([*moment, ops.eleResponse(n - 1, "force")[5]]))


def places(length: float) -> np.ndarray:
    """Places at which deflection and moment are asked for.

    Parameters
    ----------
    length : float
        Of the beam.
    """
    return length / PLACES * np.arange(PLACES + 1)
