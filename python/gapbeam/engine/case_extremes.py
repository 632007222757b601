"""Extremes of the fields of many solved cases, from their solutions at the nodes."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from ..base.errors import Status, check_status
from . import calls as _engine
from .beam import FIELDS, RULES, Beam

NODES_AT_A_TIME = 50_000
"""Nodes of all cases in a call: some milliseconds."""


def case_extremes(
    beam: Beam, rule: str, factors: np.ndarray, supports: np.ndarray | None, closed: np.ndarray, status: np.ndarray,
    nodes: tuple[np.ndarray, np.ndarray, np.ndarray], names: Collection[str],
) -> dict[str, tuple[np.ndarray, np.ndarray]] | None:  # fmt: skip
    """Find the largest and smallest values of fields.

    Parameters
    ----------
    beam : Beam
        The beam.
    rule : {"block", "single"}
        How working schemes are found.
    factors, supports : numpy.ndarray
        As for `Beam.solve_cases`.
    closed, status : numpy.ndarray of int
        Working schemes, cases by supports of the engine; 0 where a case is solved.
    nodes : tuple of numpy.ndarray
        Deflection, moments left and right of the nodes, cases by nodes.
    names : collection of str
        Of the fields.

    Returns
    -------
    dict of tuple of numpy.ndarray or None
        Of every field maximum and minimum, and where they are, cases by 2, not-a-number where a case is not solved. None where
        beam or fields are not such as are found here: then each case has to be solved again.

    Raises
    ------
    MemoryError
        The system gives no more memory.
    """
    if not set(names) <= set(FIELDS[:4]) or beam.ground_layers:
        return None
    cases, width = len(factors), beam.links + 1
    found = np.full((2, cases, 4, 2), np.nan)
    want = [int(name in names) for name in FIELDS[:4]]
    state = status.astype(np.int32)
    shares = np.zeros((cases, factors.shape[1] + 1))
    shares[:, :-1] = factors
    schemes = np.zeros((cases, beam.supports + 1), dtype=np.int32)
    schemes[:, :-1] = closed
    own = np.zeros((cases, 1, 3)) if supports is None else supports
    w, left, right = (np.ascontiguousarray(one) for one in nodes)
    some = max(NODES_AT_A_TIME // width, 1)
    for first in range(0, max(cases, 1), some):
        part = slice(first, first + some)
        arrays = schemes, w, left, right
        results = found[0, part].T, found[1, part].T, state[part]
        if not len(results[-1]):
            break
        there = _engine.gbcext(
            beam.handle, shares[part].T, own[part].T, RULES[rule], *(one[part].T for one in arrays), want, *results
        )
        if not there:
            return None
    if Status.NO_MEMORY in state:
        check_status(Status.NO_MEMORY)
    return {name: (found[0, :, FIELDS.index(name)], found[1, :, FIELDS.index(name)]) for name in names}
