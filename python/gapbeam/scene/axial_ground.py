"""Ground that holds a beam along its axis."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from .table import NotNegative, Positive, Stretch

if TYPE_CHECKING:
    from .structs import Scene

MOST_MARKS = 36
"""Marks along a beam that ground holds it along its axis, at most."""


class AxialGround(Stretch, kw_only=True, gc=False):
    """Ground that holds the beam along its axis by friction, from one place to another; of those that overlap the last one counts.

    It takes up to its limit against the way of the beam. Below that it gives way by its stiffness (t-z curves of piles, soil along
    pipes), or lets nothing move. It starts without force, and remembers: see ``analysis.history``. Not beside friction of
    supports and axial supports with laws, and beside foundations only with a stiffness. Give the limit, the stiffness or both.

    Parameters
    ----------
    limit : float or pair of floats, optional
        Most that it takes along the beam (force/length), either way; a pair at both ends, linear between these, needs a
        stiffness. Default: no limit.
    stiffness : float
        Force per length for each displacement along the beam (force/length^2), until the limit is reached; infinite: rigid up to
        the limit. All such ground of a beam is rigid, or none.
    name : str, optional
        Its name; shown instead of its number.
    """

    limit: NotNegative | tuple[NotNegative, NotNegative] | None = None
    stiffness: Positive = float("inf")
    name: str | None = None


def with_ground(sections: np.ndarray, grounds: Sequence[AxialGround], not_given: float) -> np.ndarray:
    """Add ground along a beam to its sections, as sections that change no stiffness.

    Parameters
    ----------
    sections : numpy.ndarray
        As of `Columns`, a column for each, and one more; the limit, that at the right end and the stiffness are in rows of their
        own.
    grounds : sequence of AxialGround
        Of the scene.
    not_given : float
        What stands for a number that is not given.
    """
    if not grounds:
        return sections
    found = np.full((len(sections), len(grounds)), not_given)
    found[0] = [one.from_ for one in grounds]
    found[1] = [not_given if one.to is None else one.to for one in grounds]
    limits = [one.limit if isinstance(one.limit, tuple) else (one.limit, not_given) for one in grounds]
    found[9] = [np.inf if limit is None else limit for limit, _ in limits]
    found[10] = [limit for _, limit in limits]
    found[11] = [one.stiffness for one in grounds]
    found[12:] = 1.0
    return np.asfortranarray(np.hstack([sections[:, :-1], found, sections[:, -1:]]))


def places_of_marks(scene: Scene) -> list[float]:
    """Give the places at which pictures mark that ground holds the beam along its axis."""
    end, found = float(scene.span_ends()[-1]), []
    middles = (np.arange(MOST_MARKS) + 0.5) * (end / MOST_MARKS)
    for one in scene.axial_ground:
        to = end if one.to is None else one.to
        found += middles[(middles > one.from_) & (middles < to)].tolist() or [(one.from_ + to) / 2]
    return found
