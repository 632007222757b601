"""Modes of a beam about a state whose deflections are given, on ground whose laws are curves: elements of high degree.

Independent of gapbeam but for the deflections: shapes are Hermite's with functions that vanish at both ends of an element
(Szabo and Babuska, Finite Element Analysis, 1991); the ground has the slope of its law at the deflection at every point of Gauss.

Examples
--------
>>> import numpy as np
>>> column = {"beam": {"spans": [1.0], "EI": 1.0, "N": -1.0, "mass": 1.0}, "supports": [{"node": 0}, {"node": 1}]}
>>> ritz = Ritz(column, np.zeros_like, marks=[], active=[0, 1])
>>> [round(float(one / np.pi**2), 9) for one in ritz.buckling(2)], [round(float(one / np.pi**2), 9) for one in ritz.frequencies(2)]
([1.0, 4.0], [0.947986717, 3.949014468])
"""

import itertools

import numpy as np
from numpy.polynomial import Polynomial, legendre
from scenes import nodes_of

from .ground_laws import SIDES, between

DEGREE = 14
"""Functions of an element that vanish at its ends."""


class Ritz:
    """Stiffness, geometric stiffness and mass over the shapes.

    Parameters
    ----------
    scene : dict
        Spans of one EI, N and mass each, supports both ways or active, ground.
    deflection : callable
        Of an array of places.
    marks : sequence of float
        Where elements end, beside the nodes: supports, ends of zones of contact.
    active : sequence of int
        Supports that act.
    """

    def __init__(self, scene, deflection, marks, active):
        self.scene, self.length, self.deflection = scene, nodes_of(scene)[-1], deflection
        supports = scene.get("supports", [])
        places = [nodes_of(scene)[one["node"]] if "node" in one else one["x"] for one in supports]
        ends = np.unique([*nodes_of(scene), *places, *marks])
        ends = ends[np.append(True, np.diff(ends) > 1e-9 * self.length)]
        self.nodes = np.unique(np.concatenate([np.linspace(a, b, 5) for a, b in itertools.pairwise(ends)]))
        count = 2 * len(self.nodes) + DEGREE * (len(self.nodes) - 1)
        self.K, self.G, self.M = np.zeros((3, count, count))
        for e in range(len(self.nodes) - 1):
            self._add(e)
        free = np.ones(count, dtype=bool)
        for k in active:
            at = 2 * int(np.abs(self.nodes - places[k]).argmin())
            if np.isinf(supports[k].get("stiffness", np.inf)):
                free[at] = False
            else:
                self.K[at, at] += supports[k]["stiffness"]
        self.K, self.G, self.M = (one[np.ix_(free, free)] for one in (self.K, self.G, self.M))

    def _add(self, e):
        """One element."""
        a, b = self.nodes[e : e + 2]
        half, beam = (b - a) / 2, self.scene["beam"]
        t, weight = legendre.leggauss(DEGREE + 14)
        weight = weight * half
        x = (a + b) / 2 + half * t
        hermite = (0.5, -0.75, 0, 0.25), (0.25, -0.25, -0.25, 0.25), (0.5, 0.75, 0, -0.25), (-0.25, -0.25, 0.25, 0.25)
        ends = [Polynomial(one) for one in hermite]
        inside = [Polynomial((1, 0, -2, 0, 1)) * legendre.Legendre.basis(k).convert(kind=Polynomial) for k in range(DEGREE)]
        shapes = [ends[0], half * ends[1], ends[2], half * ends[3], *inside]
        w, turn, bend = (np.array([one.deriv(k)(t) if k else one(t) for one in shapes]) / half**k for k in range(3))
        EI, N, mass = (self._of_span(beam.get(key, 0.0), (a + b) / 2) for key in ("EI", "N", "mass"))
        at = [*range(2 * e, 2 * e + 4), *(2 * len(self.nodes) + DEGREE * e + np.arange(DEGREE))]
        self.K[np.ix_(at, at)] += (bend * (EI * weight)) @ bend.T + (w * (self._slope(x) * weight)) @ w.T
        self.G[np.ix_(at, at)] += (turn * (N * weight)) @ turn.T
        self.M[np.ix_(at, at)] += (w * (mass * weight)) @ w.T

    def _of_span(self, value, x):
        """One value, or that of the span at a place."""
        return value[np.searchsorted(nodes_of(self.scene), x) - 1] if isinstance(value, list) else value

    def _slope(self, x):
        """Slope of all ground at its deflections."""
        total, w = np.zeros_like(x), self.deflection(x)
        for item in self.scene.get("foundation", []):
            there = (x >= item.get("from", 0.0)) & (x <= item.get("to", self.length))
            for side in SIDES[item.get("side", "both")]:
                u = side * w - between(item.get("gap", 0.0), x, item, self.length)
                total += np.where(there & (u > 0.0), slope_of_law(item, x, np.maximum(u, 0.0), self.length), 0.0)
        return total

    def buckling(self, count):
        """The first factors of all N."""
        return 1.0 / self._largest(-self.G, self.K)[:count]

    def frequencies(self, count):
        """The first circular frequencies."""
        return 1.0 / np.sqrt(self._largest(self.M, self.K + self.G)[:count])

    @staticmethod
    def _largest(A, B):
        """Eigenvalues of A to B, the largest first: these have all digits, where those of B to A would not."""
        low = np.linalg.inv(np.linalg.cholesky(B))
        return np.linalg.eigvalsh(low @ A @ low.T)[::-1]


def slope_of_law(item, x, u, length):
    """Derivative of the force of a law with parameters by the displacement u."""
    law = {key: between(value, x, item, length) for key, value in item["law"].items() if key != "type"}
    if item["law"]["type"] == "cubic":
        return law["k1"] + u * (2.0 * law.get("k2", 0.0) + 3.0 * law["k3"] * u)
    k, limit = law["stiffness"], law["limit"]
    if item["law"]["type"] in ("plastic", "hardening"):
        return np.where(k * u <= limit, k, law.get("slope", 0.0))
    share = np.clip(np.divide(k * u, limit, out=np.zeros_like(u), where=limit > 0.0), 0.0, 100.0)
    return k / (1.0 + share) ** 2 if item["law"]["type"] == "hyperbolic" else k / np.cosh(share) ** 2
