"""Loads that move supports: as settlements, by case, and refused where no support moves."""

from __future__ import annotations

from typing import NamedTuple

import msgspec
import numpy as np

from ..base.errors import SceneError
from .loads import MovementLoad
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


def take_movements(scene: Scene) -> tuple[Scene, Movements | None]:
    """Take what moves supports out of the loads.

    Parameters
    ----------
    scene : Scene
        The scene; left as it is.

    Returns
    -------
    scene : Scene
        The same with as many loads, of which none moves a support.
    movements : Movements or None
        None where there are none.
    """
    loads = list(scene.loads)
    which = [k for k, load in enumerate(loads) if isinstance(load, MovementLoad) and load.value is not None]
    if not which:
        return scene, None
    supports = [find(scene.supports, loads[k].support, f"loads[{k}].support", "support") for k in which]
    taken = Movements(np.array(which), np.array(supports), np.array([loads[k].value for k in which]))
    for k in which:
        loads[k] = msgspec.structs.replace(loads[k], value=0.0)
    return msgspec.structs.replace(scene, loads=loads), taken


def settle_movements(scene: Scene) -> Scene:
    """Make loads that move supports settlements, as they are at full load.

    Parameters
    ----------
    scene : Scene
        The scene; left as it is.
    """
    scene, taken = take_movements(scene)
    if taken is None:
        return scene
    moves = np.zeros((1, len(scene.supports)))
    taken.add_to(moves, np.ones((1, len(scene.loads))))
    others = set(range(len(scene.loads))).difference(taken.load.tolist())
    return replace_settlements(msgspec.structs.replace(scene, loads=[scene.loads[k] for k in sorted(others)]), moves[0])


def moves_supports(scene: Scene) -> bool:
    """Whether supports move with the load factor.

    Parameters
    ----------
    scene : Scene
        The scene.
    """
    return any(isinstance(load, MovementLoad) and load.case != DEAD for load in scene.loads)


def refuse_movements(scene: Scene, problem: str) -> None:
    """Refuse loads that move supports.

    Parameters
    ----------
    scene : Scene
        The scene.
    problem : str
        What cannot be had with them.

    Raises
    ------
    SceneError
        There is one.
    """
    for k, load in enumerate(scene.loads):
        if isinstance(load, MovementLoad) and load.value is not None:
            raise SceneError(f"loads[{k}]", f"{problem} in this version; write it as the settlement of the support")
        if isinstance(load, MovementLoad):
            raise SceneError(f"loads[{k}]", f"{problem} in this version; a couple there does the same where nothing else turns")


def _moved(support: Support, by: float) -> Support:
    return msgspec.structs.replace(support, settlement=support.settlement + by) if by else support
