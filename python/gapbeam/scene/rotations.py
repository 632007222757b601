"""Rotations held by a law, with a slack or one way: written at a support or as a hinge, they become supports of their own."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import isfinite
from typing import Any

import numpy as np
from msgspec.structs import replace

from ..base.characters import visible
from ..base.errors import SceneError
from .joints import Hinge, Rotation
from .loads import MovementLoad
from .names import column_of, place_of
from .places import same_place
from .structs import Scene, Support
from .tables import Table
from .wording import number, shown

TURNING = ("rotational", "hinge")
"""Directions of supports that hold rotations."""


def turns(support: Support) -> bool:
    """Whether a support holds a rotation, so that angles and couples take the place of lengths and forces.

    Parameters
    ----------
    support : Support
        Of a scene.
    """
    return support.direction in TURNING


def with_stiffness(support: Support, stiffness: float) -> Support:
    """Give a support another stiffness, 0 too: what holds a rotation must have a stiffness, or a law.

    Parameters
    ----------
    support : Support
        Left as it is.
    stiffness : float
        Its stiffness.
    """
    free = {"stiffness": float("inf"), "law": [(1.0, 0.0)]} if turns(support) and not stiffness else {"stiffness": stiffness}
    return replace(support, **free)


@dataclass
class _Spread:
    """Supports, those that become one included."""

    supports: list[Support]
    of_support: dict[int, int] = field(default_factory=dict)

    def add(self, support: Support) -> int:
        self.supports.append(support)
        return len(self.supports) - 1


def at_support(scene: Scene, quantity: str, k: int) -> str:
    """Give the quantity by whose unit a value at a support is told: that of a rotation where it holds one.

    Parameters
    ----------
    scene : Scene
    quantity : str
        Of a support across the beam: ``"reaction"``, ``"opening"``, ``"gap"``, ...
    k : int
        Number of the support.
    """
    if not turns(scene.supports[k]):
        return quantity
    return "couple" if quantity == "reaction" else "rotation"


def which_turn(supports: Sequence[Support]) -> np.ndarray:
    """Find the supports that hold rotations.

    Parameters
    ----------
    supports : sequence of Support
        Of a scene.

    Returns
    -------
    numpy.ndarray of bool
    """
    return np.isin(np.array(column_of(supports, "direction"), dtype=str), TURNING)


def spread_rotations(scene: Scene) -> dict[str, str]:
    """Make supports of the rotations that are held by more than a stiffness, or beside a hinge, and of such hinges.

    A support that turns both ways freely within a slack gets a law, since only a law has a gap both ways.

    Parameters
    ----------
    scene : Scene
        Keys and types are right; changed in place.

    Returns
    -------
    dict
        Where they are written, by their places.

    Raises
    ------
    SceneError
        A slack below zero.

    Examples
    --------
    >>> from gapbeam import Beam
    >>> scene = Scene(beam=Beam([4.0], EI=1.0), supports=[Support(node=0, rotation=Rotation(slack=0.01)), Support(node=1)])
    >>> spread_rotations(scene)
    {'supports "rotation of 0"': 'supports[0].rotation'}
    >>> scene.supports[2].name, scene.supports[2].direction, scene.supports[2].gap, scene.supports[2].law
    ('rotation of 0', 'rotational', 0.01, [(0.0, 1.0)])
    """
    beside = not isinstance(scene.supports, Table) or scene.supports.column("at_hinge") is not None
    taken = {k for k, hinge in enumerate(scene.hinges) if _is_more(hinge)}
    if isinstance(scene.supports, Table):
        if taken or beside:
            scene.supports = list(scene.supports)
        else:
            return {}
    at_hinges = [k for k, one in enumerate(scene.supports) if one.at_hinge is not None]
    _check_at_hinges(scene, at_hinges)
    if at_hinges:
        held = _places(scene, [scene.supports[k] for k in at_hinges])
        elastic = [k for k, hinge in enumerate(scene.hinges) if hinge.stiffness]
        places = _places(scene, [scene.hinges[k] for k in elastic])
        taken |= {k for k, x in zip(elastic, places, strict=True) if same_place(x, held).any()}
    if not taken and not any(isinstance(one.rotation, Rotation) or one.at_hinge or turns(one) for one in scene.supports):
        return {}
    found, written = _Spread(list(scene.supports)), {}
    for k, support in enumerate(scene.supports):
        rotation = _as_table(support)
        if rotation is not None:
            _check_slack(rotation, f"supports[{k}].rotation.slack")
            found.supports[k] = replace(support, rotation="free", at_hinge=None)
            name = f"rotation of {k if support.name is None else visible(support.name)}"
            written[f"supports {shown(name)}"] = f"{place_of('supports', k, support.name)}.rotation"
            made = _held(rotation, rotation.stiffness, direction="rotational", name=name, at_hinge=support.at_hinge)
            found.of_support[k] = found.add(replace(made, node=support.node, x=support.x))
    for k, hinge in enumerate(scene.hinges):
        if k in taken:
            _check_slack(hinge, f"hinges[{k}].slack")
            made = _held(hinge, float("inf") if hinge.stiffness is None else hinge.stiffness, direction="hinge")
            name = f"hinge {k}" if hinge.name is None else hinge.name
            written[f"supports {shown(name)}"] = f"hinges[{k}]"
            found.add(replace(made, node=hinge.node, x=hinge.x, name=name))
    left = [k for k in range(len(scene.hinges)) if k not in taken]
    written |= {f"hinges[{i}]": f"hinges[{k}]" for i, k in enumerate(left)}
    scene.hinges = [scene.hinges[k] for k in left]
    scene.supports = [_with_slack(one) if turns(one) else one for one in found.supports]
    scene.loads = _on_rotations(scene, found.of_support)
    return written


def _as_table(support: Support) -> Rotation | None:
    """Give how a support holds its rotation, where it becomes a support of its own."""
    if isinstance(support.rotation, Rotation):
        return support.rotation
    if support.at_hinge is None or turns(support):
        return None
    return Rotation() if support.rotation == "fixed" else Rotation(stiffness=support.rotation)


def _check_at_hinges(scene: Scene, which: Sequence[int]) -> None:
    """Refuse a side of a hinge where a support holds no rotation."""
    for k in which:
        support = scene.supports[k]
        if isinstance(support.rotation, float | int) and not support.rotation >= 0.0:
            expected = '"free", "fixed" or a number, 0 or more'
            raise SceneError(f"supports[{k}].rotation", f"expected {expected}, got {number(support.rotation)}")
        if support.direction != "rotational" and support.rotation in ("free", 0.0):
            problem = "it says on which side of a hinge a rotation is held, and none is here; give rotation, or leave it out"
            raise SceneError(f"supports[{k}].at_hinge", problem)


def _places(scene: Scene, items: Sequence[Any]) -> np.ndarray:
    """Give the places of supports or hinges, NaN of those that are told later to have none."""
    ends = scene.span_ends()
    nodes = [None if one.node is None or not 0 <= one.node < len(ends) else float(ends[one.node]) for one in items]
    return np.array([one.x if node is None else node for one, node in zip(items, nodes, strict=True)], dtype=float)


def _is_more(hinge: Hinge) -> bool:
    """Whether a hinge is more than a stiffness."""
    return bool(hinge.slack) or hinge.side != "both" or hinge.law is not None or hinge.unloading != "elastic"


def _check_slack(of: Hinge | Rotation, place: str) -> None:
    """Refuse a slack below zero of what holds both ways; one way it is a lack of fit."""
    if of.side == "both" and not of.slack >= 0.0:
        raise SceneError(place, f"expected a number, 0 or more, got {number(of.slack)}")


def _held(of: Hinge | Rotation, stiffness: float, **keys: Any) -> Support:
    law = list(of.law) if isinstance(of.law, list) else of.law
    return Support(side=of.side, stiffness=stiffness, gap=of.slack, law=law, unloading=of.unloading, **keys)


def _with_slack(support: Support) -> Support:
    """Give a support that turns freely within a slack both ways a law: only such a one has a gap."""
    if support.side != "both" or not support.gap or support.law is not None:
        return support
    point = (1.0, support.stiffness) if isfinite(support.stiffness) else (0.0, 1.0)
    return replace(support, stiffness=float("inf"), law=[point])


def _on_rotations(scene: Scene, of_support: dict[int, int]) -> list:
    """Let rotations of supports turn what has become of their restraints."""
    if not of_support or isinstance(scene.loads, Table):
        return scene.loads
    names = {support.name: k for k, support in enumerate(scene.supports) if support.name is not None}
    loads = list(scene.loads)
    for i, load in enumerate(loads):
        if isinstance(load, MovementLoad) and load.rotation is not None and load.value is None:
            k = names.get(load.support, load.support) if isinstance(load.support, str) else load.support
            if k in of_support:
                loads[i] = replace(load, support=of_support[k], rotation=None, value=load.rotation)
    return loads
