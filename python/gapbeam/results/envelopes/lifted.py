"""Supports without contact: which, by how much, and when."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..views.extreme import KINDS, given_of

if TYPE_CHECKING:
    from ..result import Result
    from ..trains.envelope import TrainEnvelope
    from .envelope import Envelope

NONE = 1e-10
"""Openings below this share of the largest deflection are said to be none."""


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
    deflection = envelope.extremes["deflection"]
    largest = max((abs(one.value) for one in deflection.values() if one is not None), default=0.0)
    found = []
    for k in np.flatnonzero(envelope.supports.values("opening", "max") > NONE * largest).tolist():
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


def lifted_in_cases(openings: np.ndarray, solved: np.ndarray, largest: float) -> list[Lifted]:
    """Find the supports that are without contact in some of many cases, and in which part of them.

    Parameters
    ----------
    openings : numpy.ndarray
        Cases by supports.
    solved : numpy.ndarray of bool
        Which cases count.
    largest : float
        The largest deflection of all.

    Returns
    -------
    list of Lifted
        In the order of the supports.
    """
    there = np.where(solved[:, None] & (openings > NONE * largest), openings, -np.inf)
    share = np.isfinite(there).sum(axis=0) / max(int(solved.sum()), 1)
    cases = there.argmax(axis=0) if len(there) else np.zeros(there.shape[1], int)
    return [Lifted(k, float(there[cases[k], k]), case=int(cases[k]), share=float(share[k])) for k in np.flatnonzero(share).tolist()]
