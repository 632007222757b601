"""A train at many positions by other programs: PyCBA and OpenSees, where they are installed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np

from .active_set import NoScheme
from .train_positions import Sweep, Swept, swept


def by_pycba(scene: Mapping[str, Any], positions: int) -> Callable[[], Swept]:
    """Make the call of PyCBA: a vehicle that goes over a beam held both ways, from entering to having left it.

    Parameters
    ----------
    scene : mapping
        As for `solve_train`; supports that hold both ways and are rigid, at all ends of spans.
    positions : int
        Equidistant ones.

    Returns
    -------
    callable
    """
    return partial(_pycba, scene, positions)


def _pycba(scene: Mapping[str, Any], positions: int) -> Swept:
    import pycba

    spans = scene["beam"]["spans"]
    beam = pycba.BeamAnalysis(np.array(spans), float(scene["beam"]["EI"]), [-1, 0] * (len(spans) + 1))
    for k in range(len(spans)):
        beam.add_udl(k + 1, sum(load["q"] for load in scene["loads"]))
    d, P = np.array(scene["trains"][0]["axles"]).T
    bridge = pycba.BridgeAnalysis(beam, pycba.Vehicle(np.diff(d), P))
    found = bridge.run_vehicle((sum(spans) + d[-1]) / (positions - 1))
    return Swept(
        np.array([found.Mmax.max(), found.Mmin.min()]), np.array([found.Vmax.max(), found.Vmin.min()]),
        np.array([found.Rmaxval, found.Rminval]),
    )  # fmt: skip


def axles_missing(beams: int = 300) -> tuple[int, int]:
    """Count beams of three spans on which PyCBA leaves out the last axle of a vehicle that has come to the last support.

    Parameters
    ----------
    beams : int
        How many are tried: spans and distances between axles are random tenths.

    Returns
    -------
    missing, tried : int
    """
    import pycba

    random, missing = np.random.default_rng(1), 0
    for _ in range(beams):
        spans, gaps = random.integers(50, 300, 3) / 10, random.integers(10, 50, 2) / 10
        bridge = pycba.BridgeAnalysis(pycba.BeamAnalysis(spans, 1.0, [-1, 0] * 4), pycba.Vehicle(gaps, np.ones(3)))
        missing += bridge.static_vehicle(bridge.ba.beam.length + bridge.veh.L).R[-1] < 0.5
    return int(missing), beams


def by_opensees(scene: Mapping[str, Any], positions: int) -> Callable[[], Swept]:
    """Make the call of OpenSees: elastic beam elements, springs without tension under one-sided supports, Newton's method.

    Parameters
    ----------
    scene : mapping
        As for `solve_train`; one-sided supports are elastic.
    positions : int
        Equidistant ones, a load step each.

    Returns
    -------
    callable
    """
    return partial(_opensees, scene, positions)


def _opensees(scene: Mapping[str, Any], positions: int) -> Swept:
    import openseespy.opensees as ops

    sweep = Sweep(scene)
    n = len(sweep.x)
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.geomTransf("Linear", 1)
    for i, x in enumerate(sweep.x.tolist()):
        ops.node(i, x, 0.0)
    for k, (i, one_sided, c) in enumerate(zip(sweep.at.tolist(), sweep.one_sided, sweep.c.tolist(), strict=True)):
        if np.isinf(c):
            ops.fix(i, int(i == 0), 1, 0)
            continue
        ops.fix(i, int(i == 0), 0, 0)
        ops.node(n + k, sweep.x[i], 0.0)
        ops.fix(n + k, 1, 1, 1)
        ops.uniaxialMaterial("ENT" if one_sided else "Elastic", k + 1, c)
        ops.element("zeroLength", n + k, n + k, i, "-mat", k + 1, "-dir", 2)
    for e in range(n - 1):
        ops.element("elasticBeamColumn", e, e, e + 1, 1.0, sweep.EI, 1.0, 1)
    ops.timeSeries("Constant", 1)
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("BandGeneral")
    ops.test("NormDispIncr", 1e-13, 50, 0)
    ops.algorithm("Newton")
    ops.integrator("LoadControl", 0.0)
    ops.analysis("Static", "-noWarnings")
    s = np.linspace(0.0, sweep.last, positions)
    left = np.zeros(positions, bool)
    span, a = sweep.axles(s, left)
    reaction, ends = np.zeros((positions, len(sweep.at))), np.zeros((2, positions, n - 1))
    elements = range(n - 1)
    for row in range(positions):
        ops.pattern("Plain", 1, 1)
        if sweep.q:
            ops.eleLoad("-range", 0, n - 2, "-type", "-beamUniform", -float(sweep.q))
        for e, at, P in zip(span[:, row].tolist(), a[:, row].tolist(), sweep.P.tolist(), strict=True):
            if e >= 0:
                ops.eleLoad("-ele", e, "-type", "-beamPoint", -P, at / float(sweep.h[e]))
        if ops.analyze(1):
            raise NoScheme("OpenSees does not converge")
        forces = [ops.eleResponse(e, "force") for e in elements]
        ends[0, row], ends[1, row] = [-force[2] for force in forces], [force[1] for force in forces]
        up = [force[1] for force in forces] + [0.0]
        reaction[row] = np.array([up[i] + (forces[i - 1][4] if i else 0.0) for i in sweep.at.tolist()])
        ops.remove("loadPattern", 1)
    values = sweep.values(s, left, reaction, ends)
    return swept(np.array([values[0].max(axis=1), values[1].min(axis=1)]))
