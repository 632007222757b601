"""The foundations of a pile from a table of layers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.polynomial import Polynomial

from ..base.errors import SceneError
from .given import check_above_zero
from .py_curves import api_sand, matlock_clay, reese_clay, sand_coefficients, sand_modulus, ultimate_sand

PARTS = 24
"""Into which a layer is divided between the depths where a formula changes."""
NEEDS = {
    "matlock_clay": (("to", "gamma", "cu", "eps50"), ("J", "cyclic")),
    "reese_clay": (("to", "gamma", "cu", "eps50"), ("J",)),
    "api_sand": (("to", "gamma", "phi"), ("k", "cyclic")),
}
"""Keys of a layer by its law: those it has to have, and those it may have."""


def pile_ground(layers: Sequence[Mapping[str, Any]], *, D: float) -> list[dict[str, Any]]:
    """Give the foundations of a pile whose head is at the ground, x being the depth.

    Every layer is one foundation. Its resistance follows the depth, with the weight of all that lies above; depths count from the
    ground, also in lower layers, as API has it. Between the depths at which it is calculated (24 parts of a layer, and where a
    formula changes) it is linear, within 0.2 % for usual layers.

    Parameters
    ----------
    layers : sequence of mapping
        From the ground down, each with ``law`` (``"matlock_clay"``, ``"reese_clay"`` or ``"api_sand"``), ``to`` (depth of its
        bottom) and the parameters of this law. ``cu`` may be a pair (at the top, at the bottom), linear in between. ``average_cu``
        of reese_clay is taken from the top of the layer.
    D : float
        Diameter of the pile (length).

    Returns
    -------
    list of dict
        Foundations, for the key ``foundation`` of a scene.

    Raises
    ------
    SceneError
        Names the layer, the key and the value.

    Examples
    --------
    >>> ground = pile_ground([
    ...     {"law": "matlock_clay", "to": 5.0, "cu": (20.0, 30.0), "gamma": 8.0, "eps50": 0.01},
    ...     {"law": "api_sand", "to": 15.0, "phi": 35.0, "gamma": 10.0}], D=0.6)
    >>> [(one["name"], one["from"], one["to"]) for one in ground]
    [('1 matlock_clay', 0.0, 5.0), ('2 api_sand', 5.0, 15.0)]
    """
    check_above_zero("pile_ground", D=D)
    if not layers:
        raise SceneError("pile_ground: layers", "has no layer; give the layers from the ground down")
    top = stress = 0.0
    ground = []
    for number, layer in enumerate(layers):
        _check_layer(f"pile_ground: layers[{number}]", layer, top)
        law = _sand(layer, D, top, stress) if layer["law"] == "api_sand" else _clay(layer, D, top, stress)
        ground.append({"name": f"{number + 1} {layer['law']}", "from": top, "to": float(layer["to"]), "law": law})
        stress += layer["gamma"] * (layer["to"] - top)
        top = float(layer["to"])
    return ground


def _check_layer(place: str, layer: Mapping[str, Any], top: float) -> None:
    """Refuse layers whose keys are not those of their law, or that have no thickness."""
    if not isinstance(layer, Mapping):
        raise SceneError(place, f"expected the keys of a layer, got {layer!r}")
    if layer.get("law") not in NEEDS:
        raise SceneError(f"{place}.law", f"expected {', '.join(NEEDS)}, got {layer.get('law')!r}")
    needed, allowed = NEEDS[layer["law"]]
    for key in needed:
        if key not in layer:
            raise SceneError(place, f"has no {key}; {layer['law']} needs {', '.join(needed)}")
    for key in layer:
        if key not in ("law", *needed, *allowed):
            raise SceneError(f"{place}.{key}", f"is no key of {layer['law']}; it has {', '.join((*needed, *allowed))}")
    check_above_zero(place, gamma=layer["gamma"], to=layer["to"])
    if not layer["to"] > top:
        raise SceneError(f"{place}.to", f"expected a depth below {top:g}, where the layer begins, got {layer['to']:g}")
    if np.shape(layer.get("cu", 0.0)) not in ((), (2,)):
        raise SceneError(f"{place}.cu", f"expected a number, or a pair at the top and at the bottom, got {layer['cu']!r}")


def _depths(top: float, bottom: float, changes: Sequence[float]) -> list[float]:
    """Depths at which a layer is calculated."""
    ends = [top, *sorted(z for z in changes if top < z < bottom), bottom]
    parts = [np.linspace(a, b, max(2, round(PARTS * (b - a) / (bottom - top)) + 1)) for a, b in pairwise(ends)]
    return [float(z) for z in np.unique(np.concatenate(parts))]


def _clay(layer: Mapping[str, Any], D: float, top: float, stress: float) -> list[dict[str, Any]]:
    """Polylines of clay at depths."""
    curve = {"matlock_clay": matlock_clay, "reese_clay": reese_clay}[layer["law"]]
    bottom = float(layer["to"])
    upper, lower = np.broadcast_to(np.asarray(layer["cu"], dtype=float), 2)
    growth = (lower - upper) / (bottom - top)
    t = Polynomial([0.0, 1.0])  # depth within the layer
    cu = upper + growth * t
    average = upper + 0.5 * growth * t if curve is reese_clay else cu
    J = layer.get("J", 0.5)
    between = D * (3.0 * average + stress + layer["gamma"] * t) + J * average * (top + t) - 9.0 * D * cu
    changes = [top + float(root.real) for root in between.roots() if abs(root.imag) < 1e-9]
    law = []
    for z in _depths(top, bottom, changes):
        weight = (stress + layer["gamma"] * (z - top)) / z if z else layer["gamma"]
        more = {"average_cu": float(average(z - top))} if curve is reese_clay else {"cyclic": layer.get("cyclic", False)}
        law.append({"x": z, "points": curve(z, D=D, cu=float(cu(z - top)), gamma=weight, eps50=layer["eps50"], J=J, **more)})
    return law


def _sand(layer: Mapping[str, Any], D: float, top: float, stress: float) -> dict[str, Any]:
    """Curve of sand whose limit is a table over the depth."""
    bottom, phi, cyclic = float(layer["to"]), layer["phi"], layer.get("cyclic", False)
    k = layer.get("k", sand_modulus(phi))
    api_sand(bottom, D=D, phi=phi, gamma=layer["gamma"], k=k)  # checks what is given
    C1, C2, C3 = sand_coefficients(phi)
    depths = _depths(top, bottom, [2.1 / 0.8 * D, (C3 - C2) * D / C1])
    limit = [(z, ultimate_sand(z, D, phi, stress + layer["gamma"] * (z - top), cyclic)) for z in depths]
    return {"type": "tanh", "stiffness": (k * top, k * bottom), "limit": limit}
