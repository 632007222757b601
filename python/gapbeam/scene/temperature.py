"""Temperature loads as the curvatures and elongations that they impose."""

from __future__ import annotations

from math import isfinite
from typing import Any

import msgspec
import numpy as np

from ..base.errors import SceneError
from .loads import CurvatureLoad, TemperatureLoad
from .structs import Beam, Scene
from .table import kind_of
from .wording import number, unequal_to_spans


def check_beam(beam: Beam) -> None:
    """Refuse a thermal expansion or a depth that makes no sense.

    Parameters
    ----------
    beam : Beam
        Keys and types are right.

    Raises
    ------
    SceneError
        Names the key and the value.
    """
    for key, least, expected in (("alpha", -np.inf, "a finite number"), ("depth", 0.0, "a finite number above 0")):
        value = getattr(beam, key)
        if isinstance(value, list) and len(value) != len(beam.spans):
            raise unequal_to_spans(key, len(value), len(beam.spans))
        for i, one in enumerate(value if isinstance(value, list) else [] if value is None else [value]):
            if not (isfinite(one) and one > least):
                place = f"beam.{key}[{i}]" if isinstance(value, list) else f"beam.{key}"
                raise SceneError(place, f"expected {expected}, got {number(one)}")


def is_held_along(scene: Scene) -> bool:
    """Tell whether a support or the ground holds the beam along its axis, so that elongations matter.

    Parameters
    ----------
    scene : Scene
        Keys and types are right.
    """
    return bool(scene.axial_ground) or any(support.direction == "axial" or support.friction for support in scene.supports)


def effect_of(scene: Scene, k: int, load: Any) -> tuple[float, float]:
    """Give what a temperature load imposes.

    Parameters
    ----------
    scene : Scene
        Keys and types are right.
    k : int
        Number of the load.
    load : TemperatureLoad

    Returns
    -------
    curvature : float
        Minus alpha gradient/depth: warmer below bends as a sagging moment does, and makes w'' smaller (1/length).
    strain : float
        Elongation per length, alpha dT; it matters between axial supports only.

    Raises
    ------
    SceneError
        What it needs is missing, or changes along it.
    """
    for key in ("dT", "gradient"):
        if not isfinite(getattr(load, key)):
            raise SceneError(f"loads[{k}].{key}", f"expected a finite number, got {number(getattr(load, key))}")
    alpha = _along(scene, k, load, "alpha")
    return -alpha * load.gradient / _along(scene, k, load, "depth") if load.gradient else 0.0, alpha * load.dT


def _along(scene: Scene, k: int, load: Any, key: str) -> float:
    """The one value of a number of the beam along a load."""
    value = getattr(scene.beam, key)
    if value is None:
        raise SceneError(f"beam.{key}", f"this key is missing; loads[{k}] with a temperature needs it")
    if not isinstance(value, list):
        return value
    ends = scene.span_ends()
    first = min(max(int(np.searchsorted(ends, load.from_, side="right")) - 1, 0), len(value) - 1)
    last = len(value) if load.to is None else max(int(np.searchsorted(ends, load.to)), first + 1)
    for i, one in enumerate(value[first:last], first):
        if one != value[first]:
            problem = f"beam.{key} changes along it, at x = {number(ends[i])}"
            raise SceneError(f"loads[{k}]", f"{problem}; give a load for each part, from there and to there")
    return value[first]


def as_curvatures(scene: Scene, *, those_that_bend_only: bool = False) -> Scene:
    """Put the curvatures that they impose in the place of temperature loads.

    Parameters
    ----------
    scene : Scene
        Keys and types are right; left as it is.
    those_that_bend_only : bool
        True: loads that make a beam longer which is held along its axis stay.

    Returns
    -------
    Scene
        With as many loads, in their order.
    """
    if not any(kind_of(load) is TemperatureLoad for load in scene.loads):
        return scene
    loads = [
        CurvatureLoad(from_=load.from_, to=load.to, kappa=effect_of(scene, k, load)[0], name=load.name, case=load.case)
        if kind_of(load) is TemperatureLoad and not (those_that_bend_only and load.dT and is_held_along(scene)) else load
        for k, load in enumerate(scene.loads)
    ]  # fmt: skip
    return msgspec.structs.replace(scene, loads=loads)
