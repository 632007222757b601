"""Trains of a scene: checked, and as axles at distances from their position."""

from __future__ import annotations

from math import isfinite
from typing import NamedTuple

import numpy as np

from ..base.errors import SceneError
from .places import POSITION_TOLERANCE
from .structs import Scene, Train
from .wording import number, shown

RIGHT, LEFT = "right", "left"
"""Directions in which a train goes."""


class Course(NamedTuple):
    """A train in one direction.

    Attributes
    ----------
    direction : {"right", "left"}
        Which way it goes.
    offset, force : numpy.ndarray
        Distances of the axles from the position of the train, to the right, and their forces with the factor of the train.
    uniform : tuple of float
        Uniform load with that factor, and the distances between which it acts.
    from_, to : float
        Positions in ascending order.
    """

    direction: str
    offset: np.ndarray
    force: np.ndarray
    uniform: tuple[float, float, float]
    from_: float
    to: float


def check_trains(scene: Scene) -> None:
    """Refuse trains that make no sense.

    Parameters
    ----------
    scene : Scene
        Keys and types are right.

    Raises
    ------
    SceneError
        Names the place, the value and what was expected.
    """
    names: dict[str, int] = {}
    for i, train in enumerate(scene.trains):
        place = f"trains[{i}]"
        name = train_name(scene, i)
        if name in names:
            raise SceneError(f"{place}.name", f"trains[{names[name]}] has the name {shown(name)} already; give another one")
        names[name] = i
        if not train.axles:
            problem = "has no axle; give (distance behind the first axle, force), for example [0.0, 100.0]"
            raise SceneError(f"{place}.axles", problem)
        for k, (distance, force) in enumerate(train.axles):
            if not (isfinite(distance) and distance >= 0.0):
                problem = f"expected a distance behind the first axle, 0 or more, got {number(distance)}"
                raise SceneError(f"{place}.axles[{k}][0]", problem)
            if not isfinite(force):
                raise SceneError(f"{place}.axles[{k}][1]", f"expected a finite number, got {number(force)}")
        for key in ("from_", "to", "factor", "q"):
            value = getattr(train, key)
            if value is not None and not isfinite(value):
                raise SceneError(f"{place}.{key.rstrip('_')}", f"expected a finite number, got {number(value)}")
        end = float(scene.span_ends()[-1])
        if isfinite(end) and end > 0.0:
            for direction in (RIGHT, LEFT) if train.both_directions else (RIGHT,):
                _range(train, direction, end, place)


def train_name(scene: Scene, i: int) -> str:
    """Name of a train.

    Parameters
    ----------
    scene : Scene
        The scene.
    i : int
        Number of the train.

    Returns
    -------
    str
        Its own, or ``train 1``, ``train 2`` and so on.
    """
    return scene.trains[i].name or f"train {i + 1}"


def courses(train: Train, end: float) -> list[Course]:
    """Give a train as axles at distances, in every direction in which it goes.

    Parameters
    ----------
    train : Train
        It makes sense.
    end : float
        Length of the beam.

    Returns
    -------
    list of Course
        To the right first.
    """
    distance, force = np.array(train.axles, dtype=float).T
    longest = float(distance.max())
    found = []
    for direction in (RIGHT, LEFT) if train.both_directions else (RIGHT,):
        back = direction == LEFT
        uniform = (train.factor * train.q, 0.0 if back else -longest, longest if back else 0.0)
        offset = distance.copy() if back else -distance
        found.append(Course(direction, offset, train.factor * force, uniform, *_range(train, direction, end, "")))
    return found


def nearest(train: Train, end: float) -> float:
    """Give the distance below which an axle is at the end of the beam: that of places that differ by rounding only.

    Parameters
    ----------
    train : Train
        The train.
    end : float
        Length of the beam.

    Returns
    -------
    float
    """
    return POSITION_TOLERANCE * (end + max(distance for distance, _ in train.axles))


def _range(train: Train, direction: str, end: float, place: str) -> tuple[float, float]:
    """First and last position of a train, in ascending order."""
    longest = max(distance for distance, _ in train.axles)
    if direction == RIGHT:
        low, high = (longest, end) if train.inside else (0.0, end + longest)
    else:
        low, high = (0.0, end - longest) if train.inside else (-longest, end)
    if low > high:
        problem = f"the train has a length of {number(longest)} and is nowhere inside the beam, which is {number(end)} long"
        raise SceneError(f"{place}.inside", f"{problem}; leave inside out")
    first = low if train.from_ is None else train.from_
    last = high if train.to is None else train.to
    if first > last:
        raise SceneError(f"{place}.to", f"the positions from {number(first)} to {number(last)} are none; from must be at most to")
    if train.inside:
        if first > high or last < low:
            positions = f"it is so from {number(low)} to {number(high)}"
            raise SceneError(f"{place}.inside", f"nowhere from {number(first)} to {number(last)} is the train inside; {positions}")
        first, last = max(first, low), min(last, high)
    return first, last
