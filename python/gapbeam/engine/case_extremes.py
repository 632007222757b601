"""Fields of many solved cases and their extremes, from the solutions at the nodes."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from ..base.errors import check_ended
from . import calls as _engine
from .beam import RULES, Beam
from .combinations import Varied
from .quantities import BENDING

NODES_AT_A_TIME = 50_000
"""Nodes and places of all cases in a call: some milliseconds."""


def case_extremes(
    beam: Beam, rule: str, factors: np.ndarray, varied: Varied, closed: np.ndarray, status: np.ndarray,
    nodes: tuple[np.ndarray, np.ndarray, np.ndarray], names: Collection[str],
) -> dict[str, tuple[np.ndarray, np.ndarray]] | None:  # fmt: skip
    """Find the largest and smallest values of fields.

    Parameters
    ----------
    beam : Beam
        Without ground.
    rule : {"block", "single"}
        How contact states are found.
    factors, varied
        As for `solve_cases`, moduli as they are.
    closed, status : numpy.ndarray of int
        Contact states, cases by supports of the engine; 0 where a case is solved.
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
    if not set(names) <= set(BENDING):
        return None
    found = _follow(beam, rule, factors, varied, closed, status, nodes, names, np.zeros(0, np.int32), np.zeros(0))
    return found and {name: tuple(values[:, BENDING.index(name)] for values in found[:2]) for name in names}


def case_fields(
    beam: Beam, rule: str, factors: np.ndarray, varied: Varied, closed: np.ndarray, status: np.ndarray,
    nodes: tuple[np.ndarray, np.ndarray, np.ndarray], piece: np.ndarray, distance: np.ndarray,
) -> dict[str, np.ndarray] | None:  # fmt: skip
    """Find fields at places.

    Parameters
    ----------
    beam, rule, factors, varied, closed, status, nodes
        As for `case_extremes`.
    piece, distance : numpy.ndarray
        The places, as for `Solution.values`.

    Returns
    -------
    dict of numpy.ndarray or None
        Every field, cases by places; as `case_extremes` otherwise.

    Raises
    ------
    MemoryError
        The system gives no more memory.
    """
    found = _follow(beam, rule, factors, varied, closed, status, nodes, (), piece, distance)
    return found and {name: found[2][:, :, k] for k, name in enumerate(BENDING)}


def _follow(
    beam: Beam, rule: str, factors: np.ndarray, varied: Varied, closed: np.ndarray, status: np.ndarray,
    nodes: tuple[np.ndarray, ...], names: Collection[str], piece: np.ndarray, distance: np.ndarray,
) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:  # fmt: skip
    """Find extremes, their places, and fields."""
    cases, places, rows = len(factors), len(piece), len(BENDING)
    extremes, x, fields = (np.full((cases, *shape), np.nan) for shape in ((rows, 2), (rows, 2), (places + 1, rows)))
    about = np.append(piece, 1).astype(np.int32), np.append(distance, 0.0)
    want = [int(name in names) for name in BENDING]
    state = status.astype(np.int32)
    shares = np.zeros((cases, factors.shape[1] + 1))
    shares[:, :-1] = factors
    schemes = np.zeros((cases, beam.supports + 1), dtype=np.int32)
    schemes[:, :-1] = closed
    supports = np.zeros((cases, 1, 3)) if varied.supports is None else varied.supports
    spans = np.zeros((cases, 1, 2)) if varied.spans is None else varied.spans
    solutions = schemes, *(np.ascontiguousarray(one) for one in nodes)
    some = max(NODES_AT_A_TIME // (beam.links + 1 + places), 1)
    for first in range(0, cases, some):
        part = slice(first, first + some)
        there = _engine.gbcext(
            beam.handle, shares[part].T, supports[part].T, spans[part].T, RULES[rule], *(one[part].T for one in solutions), want,
            extremes[part].T, x[part].T, *about, fields[part].T, state[part],
        )  # fmt: skip
        if not there:
            return None
    check_ended(state)
    return extremes, x, fields[:, :-1]
