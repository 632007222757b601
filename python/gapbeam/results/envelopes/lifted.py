"""Supports without contact: which, by how much, and when."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...scene.rotations import which_turn
from ..views.extreme import KINDS, given_of

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ...scene.structs import Support
    from ..result import Result
    from ..trains.envelope import TrainEnvelope
    from ..views.extreme import Extreme
    from .envelope import Envelope

NONE = 1e-10
"""Openings below this share of the largest deflection, or rotation, are said to be none."""


class Lifted(NamedTuple):
    """A one-sided support without contact, where its opening is largest.

    Attributes
    ----------
    support : int
        Its number in the scene.
    opening : float
        Distance of the beam from its seat, the gap included.
    factor : float or None
        Load factor; None in a combination at full load and while trains pass.
    combination, train : str or None
        Names of the combination, and of the train.
    position : float or None
        Of the train.
    case : int or None
        Of many cases the number of the one with this opening.
    share : float or None
        Of many cases the part of those that are solved in which the support has no contact, from 0 to 1.
    """

    support: int
    opening: float
    factor: float | None = None
    combination: str | None = None
    train: str | None = None
    position: float | None = None
    case: int | None = None
    share: float | None = None

    to_dict = given_of


def least_openings(supports: Sequence[Support], extremes: Mapping[str, Mapping[str, Extreme | None]]) -> np.ndarray:
    """Give the openings up to which supports are said to be in contact: those of restraints and hinges are rotations.

    Parameters
    ----------
    supports : sequence of Support
        Of the scene.
    extremes : mapping
        Of the fields, those of cases as arrays.

    Returns
    -------
    numpy.ndarray
        In the order of the supports.
    """
    turning = which_turn(supports)

    def largest(name: str) -> float:
        values = [np.abs(one.value).ravel() for one in extremes[name].values() if one is not None]
        return float(np.fmax.reduce(np.concatenate([np.zeros(1), *values])))

    return NONE * np.where(turning, largest("rotation") if turning.any() else 0.0, largest("deflection"))


def lifted_supports(result: Result, envelope: Envelope | TrainEnvelope) -> list[Lifted]:
    """Find the supports that are without contact somewhere on the way of the load, in a combination or while trains pass.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.
    envelope : Envelope or TrainEnvelope
        Its `Result.envelope`.

    Returns
    -------
    list of Lifted
        In the order of the supports.
    """
    found = []
    least = least_openings(result.scene.supports, envelope.extremes)
    for k in np.flatnonzero(envelope.supports.values("opening", "max") > least).tolist():
        one = envelope.supports[k]["opening"]["max"]
        factor = one.factor
        if factor is None and one.train is None and one.combination is None and result.steps:
            factor = result.steps[-1].factor
        found.append(Lifted(k, one.value, factor, one.combination, one.train, one.position))
    return found


def carrying_supports(envelope: Envelope | TrainEnvelope) -> set[int]:
    """Find the supports that carry something somewhere in an envelope.

    Parameters
    ----------
    envelope : Envelope or TrainEnvelope
        Of a result.

    Returns
    -------
    set of int
        Their numbers in the scene.
    """
    sizes = np.array([np.abs(envelope.supports.values("reaction", kind)) for kind in KINDS])
    return set(np.flatnonzero((sizes > NONE * np.nanmax(sizes, initial=0.0)).any(axis=0)).tolist())


def lifted_in_cases(openings: np.ndarray, solved: np.ndarray, least: np.ndarray) -> list[Lifted]:
    """Find the supports that are without contact in some of many cases, and in which part of them.

    Parameters
    ----------
    openings : numpy.ndarray
        Cases by supports.
    solved : numpy.ndarray of bool
        Which cases count.
    least : numpy.ndarray
        By `least_openings`.

    Returns
    -------
    list of Lifted
        In the order of the supports.
    """
    there = np.where(solved[:, None] & (openings > least), openings, -np.inf)
    share = np.isfinite(there).sum(axis=0) / max(int(solved.sum()), 1)
    cases = there.argmax(axis=0) if len(there) else np.zeros(there.shape[1], int)
    return [Lifted(k, float(there[cases[k], k]), case=int(cases[k]), share=float(share[k])) for k in np.flatnonzero(share).tolist()]
