"""States of beams on ground whose force falls, by cubic elements and small steps of the loads: dead loads first, then the others.

Right to a few thousandths: the law acts at Gauss points, and a step is taken where the state is stable (the tangent
is positive definite) and does not move by more than a small part of what it moved at most.
"""

import numpy as np
from scenes import place

from .ground_laws import pressure

NODES, WEIGHTS = np.polynomial.legendre.leggauss(3)
XI = (NODES + 1) / 2
LARGEST_MOVE = 0.15
"""Share of the largest deflection by which a step may move the beam."""
LEAST_STEP = 2e-6
SETTLED = 1e-8
"""Share of all forces that may be out of balance."""


def is_stable(tangent):
    """Whether a stiffness is positive definite."""
    try:
        np.linalg.cholesky(tangent)
    except np.linalg.LinAlgError:
        return False
    return True


class Program:
    """One scene of one span.

    Parameters
    ----------
    scene : dict
        One span with EI, without shear; forces and uniform loads; supports that are rigid both ways, or springs of any side.
    cells : int
        Elements.
    """

    def __init__(self, scene: dict, cells: int = 64):
        self.scene, self.length = scene, scene["beam"]["spans"][0]
        self.cells, self.h = cells, scene["beam"]["spans"][0] / cells
        h, n = self.h, 2 * (cells + 1)
        ends = np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]])
        element = scene["beam"]["EI"] / h**3 * ends * np.outer([1, h, 1, h], [1, h, 1, h])
        self.of_cell = 2 * np.arange(cells)[:, None] + np.arange(4)
        self.stiffness = np.zeros((n, n))
        for at in self.of_cell:
            self.stiffness[np.ix_(at, at)] += element
        self.shapes = np.array([self.shape(xi) for xi in XI])
        self.x = ((np.arange(cells)[:, None] + XI) * h).ravel()
        self.springs = []
        for support in scene.get("supports", ()):
            row = self.row_at(place(scene, support))
            if "stiffness" not in support:
                self.stiffness += 1e4 * np.abs(element).max() * np.outer(row, row)
            else:
                side = {"both": 0, "below": 1, "above": -1}[support.get("side", "both")]
                self.springs.append((row, support["stiffness"], side, support.get("gap", 0.0)))
        self.dead, self.live = np.zeros(n), np.zeros(n)
        for load in scene["loads"]:
            into = self.dead if load.get("case") == "dead" else self.live
            if load["type"] == "force":
                into += load["F"] * self.row_at(load["x"])
            else:
                for at in self.of_cell:
                    into[at] += load["q"] * h * np.array([0.5, h / 12, 0.5, -h / 12])

    def shape(self, xi):
        """Cubics of a cell at a share of its length."""
        h = self.h
        return np.array([1 - 3 * xi**2 + 2 * xi**3, h * (xi - 2 * xi**2 + xi**3), 3 * xi**2 - 2 * xi**3, h * (xi**3 - xi**2)])

    def row_at(self, x):
        """Deflection at a place as a row."""
        cell = min(int(x / self.h), self.cells - 1)
        row = np.zeros(len(self.stiffness))
        row[self.of_cell[cell]] = self.shape(x / self.h - cell)
        return row

    def resist(self, w):
        """Forces of beam, ground and supports, and the tangent."""
        force, tangent = self.stiffness @ w, self.stiffness.copy()
        at = (w[self.of_cell] @ self.shapes.T).ravel()
        size = max(np.abs(at).max(), 1e-12)
        push = pressure(self.scene, self.x, at)
        slope = (pressure(self.scene, self.x, at + 1e-7 * size) - pressure(self.scene, self.x, at - 1e-7 * size)) / (2e-7 * size)
        push, slope = (v.reshape(self.cells, -1) * WEIGHTS * self.h / 2 for v in (push, slope))
        np.add.at(force, self.of_cell, push @ self.shapes)
        blocks = np.einsum("ig,ga,gb->iab", slope, self.shapes, self.shapes)
        for at_cell, block in zip(self.of_cell, blocks, strict=True):
            tangent[np.ix_(at_cell, at_cell)] += block
        for row, k, side, gap in self.springs:
            way = row @ w - side * gap
            if side and side * way <= 0.0:
                continue
            force += k * way * row
            tangent += k * np.outer(row, row)
        return force, tangent

    def settle(self, w, load):
        """The state near another one by damped Newton steps; None where there is no stable one."""
        w, scale = w.copy(), np.abs(load).max() + np.abs(self.resist(w)[0]).max()
        force, tangent = self.resist(w)
        for _ in range(50):
            off = load - force
            if np.abs(off).max() <= SETTLED * scale:
                return w if is_stable(tangent) else None
            step = np.linalg.solve(tangent + 1e-12 * np.abs(tangent).max() * np.eye(len(w)), off)
            for share in (1.0, 0.5, 0.25, 0.1):
                force, tangent = self.resist(w + share * step)
                if np.abs(load - force).max() < np.abs(off).max():
                    break
            w += share * step
        return None

    def near(self, result):
        """The state near one that is known; the first of a way."""
        x = np.arange(self.cells + 1) * self.h
        at = result.at(x, side="left")
        return np.column_stack((at.deflection, np.gradient(at.deflection, x, edge_order=2))).ravel()

    def follow(self, first, steps: int = 64) -> tuple[np.ndarray, float]:
        """Put the loads on.

        Parameters
        ----------
        first : callable
            From shares of the dead and of the other loads to a result, where to begin; called once at most.
        steps : int
            As many, where none has to be shorter.

        Returns
        -------
        w : numpy.ndarray
            The last state.
        reached : float
            0 to 1: share of the dead loads; 1 to 2: 1 and the load factor.
        """
        w, at = np.zeros(len(self.dead)), 0.0 if self.dead.any() else 1.0
        begin = at
        step, largest = 1.0 / steps, 0.0
        while at < 2.0 and step > LEAST_STEP:
            end = min(at + step, 1.0 if at < 1.0 else 2.0)
            load = min(end, 1.0) * self.dead + max(end - 1.0, 0.0) * self.live
            found = self.settle(w, load)
            if found is None and at == begin and first is not None:
                known, first = first(min(end, 1.0), max(end - 1.0, 0.0)), None
                found = self.settle(self.near(known), load) if known.status == "solved" else None
            if found is None or (largest and np.abs(found - w)[::2].max() > LARGEST_MOVE * max(largest, np.abs(found)[::2].max())):
                step /= 2
                continue
            w, at = found, end
            largest = max(largest, np.abs(w)[::2].max())
            step = min(2 * step, 1.0 / steps)
        return w, at

    def deflection(self, w, x):
        """At a place."""
        return self.row_at(x) @ w
