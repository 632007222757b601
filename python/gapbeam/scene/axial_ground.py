"""Ground that holds a beam along its axis."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .table import NotNegative, Stretch


class AxialGround(Stretch, kw_only=True, gc=False):
    """Ground that holds the beam along its axis by friction, from one place to another; of those that overlap the last one counts.

    It takes up to its limit against the way of the beam, and lets nothing move where it holds. It starts without force, and
    remembers: see ``analysis.history``. Not beside foundations, friction of supports and axial supports with laws.

    Parameters
    ----------
    limit : float
        Most that it takes along the beam (force/length), either way.
    name : str, optional
        Its name; shown instead of its number.
    """

    limit: NotNegative
    name: str | None = None


def with_ground(sections: np.ndarray, grounds: Sequence[AxialGround], not_given: float) -> np.ndarray:
    """Add ground along a beam to its sections, as sections that change no stiffness.

    Parameters
    ----------
    sections : numpy.ndarray
        As of `Columns`, a column for each, and one more; the limit is in the last row.
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
    found[8:11] = 1.0
    found[11] = [one.limit for one in grounds]
    return np.asfortranarray(np.hstack([sections[:, :-1], found, sections[:, -1:]]))
