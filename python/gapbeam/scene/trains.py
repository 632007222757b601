"""Trains of a scene: checked, and as axles at distances from their position."""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite
from typing import NamedTuple

import numpy as np
from msgspec.structs import replace

from ..base.errors import SceneError
from ..engine.tolerances import END_TOLERANCE, POSITION_TOLERANCE
from .structs import Scene, Train
from .wording import enumerated, number, shown

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
    uniform : numpy.ndarray
        Uniform loads with that factor, and the distances between which each acts, to the right: a row a load.
    from_, to : float
        Positions in ascending order.
    """

    direction: str
    offset: np.ndarray
    force: np.ndarray
    uniform: np.ndarray
    from_: float
    to: float

    def acting(self, position: float, end: float, near: float) -> np.ndarray:
        """Tell which axles act at a position on a beam of a length, those nearer to its ends than `near` included."""
        x = position + self.offset
        return (x >= -near) & (x <= end + near)

    def loads(self, position: float, end: float, near: float, acts: np.ndarray) -> list[tuple[float, float, float]]:
        """Give what acts at a position: place or left end, right end (0 of an axle), value."""
        x = np.clip(position + self.offset[acts], 0.0, end)
        found = [(place, 0.0, force) for place, force in zip(x.tolist(), self.force[acts].tolist(), strict=True)]
        for q, low, high in self.uniform.tolist():
            low, high = max(position + low, 0.0), min(position + high, end)
            if q != 0.0 and high - low > near:
                found.append((low, high, q))
        return found


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
        if not (train.axles or train.together):
            problem = "has no axle; give (distance behind the first axle, force), for example [0.0, 100.0]"
            raise SceneError(f"{place}.axles", problem)
        for k, (distance, force) in enumerate(train.axles):
            _check_distance(f"{place}.axles[{k}][0]", distance)
            _check_finite(f"{place}.axles[{k}][1]", force)
        for key in ("from_", "to", "factor"):
            value = getattr(train, key)
            if value is not None:
                _check_finite(f"{place}.{key.rstrip('_')}", value)
        _check_uniform(train, f"{place}.q")
    for i, train in enumerate(scene.trains):
        place = f"trains[{i}]"
        if train.together:
            _check_together(scene, train, names, place)
        end = float(scene.span_ends()[-1])
        if isfinite(end) and end > 0.0:
            for direction in (RIGHT, LEFT) if train.both_directions else (RIGHT,):
                _range(joined(scene.trains, i), direction, end, place)


def _check_finite(place: str, value: float) -> None:
    if not isfinite(value):
        raise SceneError(place, f"expected a finite number, got {number(value)}")


def _check_distance(place: str, value: float) -> None:
    if not (isfinite(value) and value >= 0.0):
        raise SceneError(place, f"expected a distance behind the first axle, 0 or more, got {number(value)}")


def _check_uniform(train: Train, place: str) -> None:
    """Refuse uniform loads that are none."""
    if not isinstance(train.q, list):
        _check_finite(place, train.q)
        if train.q and train.axles and _longest(train) == 0.0:
            problem = f"{number(train.q)} acts over the length of the train, which is 0: all its axles stand at distance 0"
            raise SceneError(place, f"{problem}; give [[from, to, load]], or leave q out")
        return
    for k, (first, last, q) in enumerate(train.q):
        for i, value in enumerate((first, last, q)):
            _check_finite(f"{place}[{k}][{i}]", value)
        if not first < last:
            problem = f"the distances from {number(first)} to {number(last)} are no stretch; give (from, to, load), from below to"
            raise SceneError(f"{place}[{k}]", problem)


def _check_together(scene: Scene, train: Train, names: dict[str, int], place: str) -> None:
    """Refuse trains that cannot go together."""
    if train.axles:
        raise SceneError(f"{place}.together", "stands beside axles; give one of them, or the axles as a train of its own")
    if train.q != 0.0:
        raise SceneError(f"{place}.q", "a train made of others has the uniform loads that they bring; give q there")
    for k, (name, distance) in enumerate(train.together):
        where = f"{place}.together[{k}]"
        _check_distance(f"{where}[1]", distance)
        if name not in names:
            raise SceneError(f"{where}[0]", f"there is no train {shown(name)}; the names are {enumerated(map(shown, names))}")
        if scene.trains[names[name]].together:
            problem = f"the train {shown(name)} is made of others itself; name trains that have axles"
            raise SceneError(f"{where}[0]", problem)


def joined(trains: Sequence[Train], i: int) -> Train:
    """Give a train with all axles and uniform loads that it brings, with their factors.

    Parameters
    ----------
    trains : sequence of Train
        All trains of a scene; they make sense.
    i : int
        Number of the train.

    Returns
    -------
    Train
        One with axles: of trains that go together one with the axles of all.
    """
    train = trains[i]
    if not train.together:
        return train
    members = {_name(trains, k): one for k, one in enumerate(trains)}
    axles, loads = [], []
    for name, behind in train.together:
        one = members[name]
        axles += [(behind + distance, one.factor * force) for distance, force in one.axles]
        loads += [(behind + first, behind + last, one.factor * q) for first, last, q in _uniform(one)]
    return replace(train, axles=axles, together=[], q=loads)


def _uniform(train: Train) -> list[tuple[float, float, float]]:
    """Uniform loads of a train, from one distance behind its first axle to another."""
    if isinstance(train.q, list):
        return train.q
    longest = _longest(train)
    return [(0.0, longest, train.q)] if train.q and longest > 0.0 else []


def _longest(train: Train) -> float:
    """Largest distance of an axle behind the first one."""
    return max(distance for distance, _ in train.axles)


def _ends(train: Train) -> tuple[float, float]:
    """Give how far a train reaches ahead of its first axle, and how far behind it, both 0 or more."""
    loads = _uniform(train)
    return max([0.0, *(-first for first, _, _ in loads)]), max([_longest(train), *(last for _, last, _ in loads)])


def train_name(scene: Scene, i: int) -> str:
    """Name of a train.

    Parameters
    ----------
    scene : Scene
    i : int
        Number of the train.

    Returns
    -------
    str
        Its own, or ``train 1``, ``train 2`` and so on.
    """
    return _name(scene.trains, i)


def _name(trains: Sequence[Train], i: int) -> str:
    return trains[i].name or f"train {i + 1}"


def courses(train: Train, end: float) -> list[Course]:
    """Give a train as axles at distances, in every direction in which it goes.

    Parameters
    ----------
    train : Train
        From `joined`.
    end : float
        Length of the beam.

    Returns
    -------
    list of Course
        To the right first.
    """
    train = fitted(train, end)
    distance, force = np.array(train.axles, dtype=float).T
    first, last, q = np.array(_uniform(train), dtype=float).reshape(-1, 3).T
    found = []
    for direction in (RIGHT, LEFT) if train.both_directions else (RIGHT,):
        back = direction == LEFT
        with np.errstate(over="ignore"):  # the engine says that it is out of range
            factored, of_length = train.factor * force, train.factor * q
        uniform = np.column_stack((of_length, *((first, last) if back else (-last, -first))))
        offset = distance.copy() if back else -distance
        found.append(Course(direction, offset, factored, uniform, *_range(train, direction, end, "")))
    return found


def fitted(train: Train, end: float) -> Train:
    """Give a train that is longer than the beam by rounding the length of the beam.

    Parameters
    ----------
    train : Train
        From `joined`.
    end : float
        Length of the beam.

    Returns
    -------
    Train
        Any other one as it is.
    """
    ahead, behind = _ends(train)
    if not end < ahead + behind <= end * (1.0 + END_TOLERANCE):
        return train
    most = max(end - ahead, 0.0)
    axles = [(min(distance, most), force) for distance, force in train.axles]
    q = [(min(first, most), min(last, most), q) for first, last, q in train.q] if isinstance(train.q, list) else train.q
    return replace(train, axles=axles, q=q)


def nearest(train: Train, end: float) -> float:
    """Give the distance below which an axle is at the end of the beam: that of places that differ by rounding only.

    Parameters
    ----------
    train : Train
        From `joined`.
    end : float
        Length of the beam.
    """
    return POSITION_TOLERANCE * (end + max(distance for distance, _ in train.axles))


def at_ends(position: float, train: Train, direction: str, end: float, tolerance: float = END_TOLERANCE) -> float:
    """Move a train so that no axle lies beyond an end of the beam by rounding.

    Parameters
    ----------
    position : float
        Of the train.
    train : Train
        From `joined`.
    direction : {"right", "left"}
        Which way it goes.
    end : float
        Length of the beam.
    tolerance : float, optional
        Share of the length that counts as rounding.

    Returns
    -------
    float
        The position with the first such axle at that end; else the same.
    """
    for distance, _ in train.axles:
        offset = distance if direction == LEFT else -distance
        x = position + offset
        if -tolerance * end <= x < 0.0:
            return -offset
        if end < x <= end * (1.0 + tolerance):
            return end - offset
    return position


def _range(train: Train, direction: str, end: float, place: str) -> tuple[float, float]:
    """First and last position of a train, in ascending order."""
    train = fitted(train, end)
    ahead, behind = _ends(train)
    if direction == RIGHT:
        low, high = (behind, end - ahead) if train.inside else (-ahead, end + behind)
    else:
        low, high = (ahead, end - behind) if train.inside else (-behind, end + ahead)
    if low > high:
        problem = f"the train has a length of {number(ahead + behind)} and is nowhere inside the beam, which is {number(end)} long"
        raise SceneError(f"{place}.inside", f"{problem}; leave inside out")
    first = low if train.from_ is None else at_ends(train.from_, train, direction, end)
    last = high if train.to is None else at_ends(train.to, train, direction, end)
    if first > last:
        raise SceneError(f"{place}.to", f"the positions from {number(first)} to {number(last)} are none; from must be at most to")
    if train.inside:
        if first > high or last < low:
            positions = f"it is so from {number(low)} to {number(high)}"
            raise SceneError(f"{place}.inside", f"nowhere from {number(first)} to {number(last)} is the train inside; {positions}")
        first, last = max(first, low), min(last, high)
    return first + 0.0, last + 0.0  # a zero without sign
