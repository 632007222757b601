"""Random cases of a beam on supports that open, and the displacement method for them, in numpy.

Equal spans of one EI, held both ways at the ends, between them on springs that only push; deflection and rotation of every node.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

SPAN, EI, STIFFNESS = 6.0, 1e4, 1e5
"""Length of every span, and what bends and gives."""
SUPPORTS = "random gaps, 12 supports"
"""The problem in which the supports vary."""
SIZES = {
    "3 spans": (3, 100_000), "10 spans": (10, 100_000), "100 spans": (100, 10_000), "1,000 spans": (1000, 200),
    SUPPORTS: (11, 10_000),
}  # fmt: skip
"""Spans and most cases of the problems."""


@dataclass
class Batch:
    """Cases of one beam.

    Attributes
    ----------
    q : numpy.ndarray
        Uniform loads, cases by spans; positive downward.
    gap, settlement : numpy.ndarray
        Of the supports, cases by supports; no gap at the ends.
    factors : bool
        Whether only the loads vary.
    """

    q: np.ndarray
    gap: np.ndarray
    settlement: np.ndarray
    factors: bool

    def scene(self) -> dict[str, Any]:
        """Make the scene of which these are cases, with loads of 1 if these alone vary, and else those of the first case.
        """
        n = self.q.shape[1]
        q = np.ones(n) if self.factors else self.q[0]
        inner = [{"node": i, "side": "below", "stiffness": STIFFNESS, "gap": float(self.gap[0, i])} for i in range(1, n)]
        return {
            "beam": {"spans": [SPAN] * n, "EI": EI},
            "supports": [{"node": 0}, *inner, {"node": n}],
            "loads": [{"type": "uniform", "from": SPAN * j, "to": SPAN * (j + 1), "q": float(q[j])} for j in range(n)],
        }

    def first(self, count: int) -> Batch:
        """Take the first cases.

        Parameters
        ----------
        count : int
            How many.
        """
        return Batch(self.q[:count], self.gap[:count], self.settlement[:count], self.factors)


@dataclass
class Found:
    """What a program found.

    Attributes
    ----------
    deflection, moment, reaction : numpy.ndarray
        At every support, cases by supports; downward, sagging, upward.
    closed : numpy.ndarray of bool
        Which of them act.
    """

    deflection: np.ndarray
    moment: np.ndarray
    reaction: np.ndarray
    closed: np.ndarray


def make(problem: str, most: int) -> Batch:
    """Draw the cases of a problem.

    Parameters
    ----------
    problem : str
        From `SIZES`.
    most : int
        Most cases.
    """
    spans, cases = SIZES[problem]
    cases = min(cases, most)
    random = np.random.default_rng(7)
    q = random.uniform(-10.0, 25.0, (cases, spans))
    gap = np.tile(0.002 * (np.arange(spans + 1) % 3), (cases, 1))
    settlement = np.zeros_like(gap)
    if problem == SUPPORTS:
        q[:] = q[0]
        gap, settlement = random.uniform(0.0, 0.01, gap.shape), random.normal(0.0, 0.005, gap.shape)
    gap[:, [0, -1]] = 0.0
    return Batch(q, gap, settlement, problem != SUPPORTS)


def links() -> tuple[float, float, float, float]:
    """Stiffnesses of a span: force by deflection, force by rotation, couple by rotation near and far.

    Returns
    -------
    tuple of float
    """
    return 12.0 * EI / SPAN**3, 6.0 * EI / SPAN**2, 4.0 * EI / SPAN, 2.0 * EI / SPAN


def nodal(batch: Batch) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Put the loads on the nodes.

    Parameters
    ----------
    batch : Batch
        The cases.

    Returns
    -------
    force, couple, level : numpy.ndarray
        Of the loads, and the deflections at which supports begin to act; nodes by cases.
    """
    half = batch.q.T * SPAN / 2.0
    force, couple = (np.zeros((len(half) + 1, len(batch.q))) for _ in range(2))
    force[:-1], couple[:-1] = half, half * SPAN / 6.0
    force[1:] += half
    couple[1:] -= half * SPAN / 6.0
    return force, couple, np.ascontiguousarray((batch.gap + batch.settlement).T)


def complete(batch: Batch, force: np.ndarray, level: np.ndarray, w: np.ndarray, turn: np.ndarray, closed: np.ndarray) -> Found:
    """Find moments and reactions from the displacements.

    Parameters
    ----------
    batch : Batch
        The cases.
    force, level : numpy.ndarray
        From `nodal`.
    w, turn, closed : numpy.ndarray
        Deflections, rotations, and which supports act; nodes by cases.
    """
    chord = np.diff(w, axis=0) / SPAN
    first, last = turn[:-1] - chord, turn[1:] - chord
    k = 2.0 * EI / SPAN
    moment = np.zeros_like(w)
    moment[1:-1] = (k * (2.0 * first + last) - batch.q.T * SPAN**2 / 12.0)[1:]
    reaction = np.where(closed, STIFFNESS * (w - level), 0.0)
    reaction[0] = force[0] - 3.0 * k * (first[0] + last[0]) / SPAN
    reaction[-1] = force[-1] + 3.0 * k * (first[-1] + last[-1]) / SPAN
    return Found(w.T, moment.T, reaction.T, closed.T)


def matrix_of(nodes: int) -> np.ndarray:
    """Stiffness matrix of the beam without supports, (w, rotation) node by node.

    Parameters
    ----------
    nodes : int
        How many.
    """
    k12, k6, k4, k2 = links()
    block = np.array([[k12, k6, -k12, k6], [k6, k4, -k6, k2], [-k12, -k6, k12, -k6], [k6, k2, -k6, k4]])
    matrix = np.zeros((2 * nodes, 2 * nodes))
    for i in range(0, 2 * nodes - 2, 2):
        matrix[i : i + 4, i : i + 4] += block
    return matrix
