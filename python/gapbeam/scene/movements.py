"""Loads that move supports: as settlements, by case, and refused where no support moves."""

from __future__ import annotations

from typing import Literal, NamedTuple

import msgspec
import numpy as np

from ..base.errors import SceneError
from .loads import Load, MovementLoad
from .names import DEAD, find
from .structs import Scene, Support


def replace_settlements(scene: Scene, moves: np.ndarray) -> Scene:
    """Move supports further.

    Parameters
    ----------
    scene : Scene
        The scene; left as it is.
    moves : numpy.ndarray
        Further movement of every support.
    """
    return msgspec.structs.replace(
        scene, supports=[_moved(one, by) for one, by in zip(scene.supports, moves.tolist(), strict=True)]
    )


class Movements(NamedTuple):
    """Loads that move supports, each by its value times a factor.

    Attributes
    ----------
    load, support : numpy.ndarray of int
        Numbers of the loads, and of the supports that they move.
    value : numpy.ndarray
        Movements (length), positive downward, of an axial support to the right.
    """

    load: np.ndarray
    support: np.ndarray
    value: np.ndarray

    def add_to(self, moves: np.ndarray, factors: np.ndarray) -> None:
        """Add what they do in some cases.

        Parameters
        ----------
        moves : numpy.ndarray
            Movements of supports, cases by supports; changed in place.
        factors : numpy.ndarray
            Of all loads, cases by loads.
        """
        with np.errstate(over="ignore", invalid="ignore"):  # the engine says which case is out of range
            for load, support, value in zip(*(column.tolist() for column in self), strict=True):
                moves[:, support] += factors[:, load] * value


def take_movements(scene: Scene, only_dead: bool = False) -> tuple[Scene, Movements | None]:
    """Take what moves supports out of the loads.

    Parameters
    ----------
    scene : Scene
        The scene; left as it is.
    only_dead : bool
        Whether what moves them as the load grows stays.

    Returns
    -------
    scene : Scene
        The same with as many loads, of which none moves a support.
    movements : Movements or None
        None where there are none.
    """
    loads = list(scene.loads)
    which = [k for k, load in enumerate(loads) if _moves_support(load) and (load.case == DEAD or not only_dead)]
    if not which:
        return scene, None
    supports = [number_of_moved(scene, k, loads[k]) for k in which]
    taken = Movements(np.array(which), np.array(supports), np.array([loads[k].value for k in which]))
    for k in which:
        loads[k] = msgspec.structs.replace(loads[k], value=0.0)
    return msgspec.structs.replace(scene, loads=loads), taken


def settle_movements(scene: Scene, factor: float = 1.0) -> Scene:
    """Make loads that move supports settlements, as they are at full load.

    Parameters
    ----------
    scene : Scene
        The scene; left as it is.
    factor : float
        Load factor, if not 1.
    """
    moves = supports_moved(scene, factor)
    scene, taken = take_movements(scene)
    if taken is None:
        return scene
    others = set(range(len(scene.loads))).difference(taken.load.tolist())
    return replace_settlements(msgspec.structs.replace(scene, loads=[scene.loads[k] for k in sorted(others)]), moves)


def moves_with_load(scene: Scene) -> bool:
    """Whether supports or ground move with the load factor."""
    return any(isinstance(load, MovementLoad) and load.case != DEAD for load in scene.loads)


def supports_moved(scene: Scene, factor: float) -> np.ndarray:
    """Give how far loads have moved every support."""
    moves = np.zeros(len(scene.supports))
    for k, load in enumerate(scene.loads):
        if _moves_support(load):
            moves[number_of_moved(scene, k, load)] += share_of(load, factor) * load.value
    return moves


def ground_moved(scene: Scene, factor: float) -> np.ndarray:
    """Give how far loads have moved every foundation at its left and its right end, foundations by 2.

    Parameters
    ----------
    scene, factor
        As for `supports_moved`.
    """
    moves = np.zeros((len(scene.foundation), 2))
    for k, load in enumerate(scene.loads):
        if moves_ground(load):
            moves[number_of_moved(scene, k, load)] += share_of(load, factor) * np.asarray(load.value)
    return moves


def what_moves(load: MovementLoad, place: str) -> Literal["support", "rotation", "foundation"]:
    """Tell whether a load moves a support, turns it, or moves a foundation.

    Parameters
    ----------
    load : MovementLoad
    place : str
        Its place in the scene.

    Raises
    ------
    SceneError
        It says too little or too much.
    """
    if (load.support is None) == (load.foundation is None):
        missing = "is missing; give the support that moves, or foundation"
        raise SceneError(f"{place}.support", missing if load.support is None else "and foundation are both given; make two loads")
    if load.foundation is not None:
        if load.rotation is not None or load.value is None:
            what = "is missing; a foundation moves by value (length), a pair [at from, at to] where it turns"
            raise SceneError(f"{place}.value", what)
        return "foundation"
    if isinstance(load.value, tuple):
        raise SceneError(f"{place}.value", "a support moves by one number; a pair is for a foundation")
    if (load.value is None) == (load.rotation is None):
        both = "and rotation are both given; make two loads"
        raise SceneError(f"{place}.value", "is missing; give value (length) or rotation (rad)" if load.value is None else both)
    return "support" if load.rotation is None else "rotation"


def number_of_moved(scene: Scene, k: int, load: MovementLoad) -> int:
    """Find the support or foundation that a load moves.

    Parameters
    ----------
    scene : Scene
    k, load : int, MovementLoad
        The load and its number.
    """
    if load.foundation is not None:
        return find(scene.foundation, load.foundation, f"loads[{k}].foundation", "foundation")
    return find(scene.supports, load.support, f"loads[{k}].support", "support")


def _moves_support(load: Load) -> bool:
    """Whether a load moves a support and does not turn it."""
    return isinstance(load, MovementLoad) and load.value is not None and load.foundation is None


def moves_ground(load: Load) -> bool:
    """Whether a load moves a foundation."""
    return isinstance(load, MovementLoad) and load.foundation is not None


def refuse_movements(scene: Scene, problem: str) -> None:
    """Refuse loads that move supports.

    Parameters
    ----------
    scene : Scene
    problem : str
        What cannot be had with them.

    Raises
    ------
    SceneError
        There is one.
    """
    for k, load in enumerate(scene.loads):
        if moves_ground(load):
            raise SceneError(f"loads[{k}]", f"{problem} in this version; write it as the gap of the foundation")
        if _moves_support(load):
            raise SceneError(f"loads[{k}]", f"{problem} in this version; write it as the settlement of the support")
        if isinstance(load, MovementLoad):
            raise SceneError(f"loads[{k}]", f"{problem} in this version; a couple there does the same where nothing else turns")


def share_of(load: Load, factor: float) -> float:
    """Give the share of a load that acts at a load factor.

    Parameters
    ----------
    load, factor : Load, float
        The load, and the load factor.
    """
    return 1.0 if load.case == DEAD else factor


def _moved(support: Support, by: float) -> Support:
    return msgspec.structs.replace(support, settlement=support.settlement + by) if by else support
