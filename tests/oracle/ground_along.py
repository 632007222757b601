"""A bar on ground that rubs along it, as very many sliders in a row: springs between nodes, a limit at each, small load steps.

Each step is a problem of its own: the forces that sliders take stay within their limits, and those at a limit slide that way only.
It is solved by changing states of sliders until all agree. With more nodes and steps it tends to the bar itself.
"""

from __future__ import annotations

import numpy as np


class Mesh:
    """A bar at equal distances along a scene's beam, with its axial supports and loads.

    Parameters
    ----------
    scene : dict
        Spans, EA, alpha, sections, axial supports, temperatures and loads along the beam, all places on the mesh.
    cells : int
        Nodes per length 1, less one.
    """

    def __init__(self, scene: dict, cells: int):
        self.end = sum(scene["beam"]["spans"])
        n = round(self.end * cells)
        self.x = np.arange(n + 1) / cells
        self.middle = (self.x[1:] + self.x[:-1]) / 2
        EA = np.full(n, scene["beam"]["EA"])
        for one in scene.get("sections", ()):
            EA[self.inside(one)] = one["EA"]
        self.stiffness = EA * cells
        self.spring = np.zeros(n + 1)
        for one in scene["supports"]:
            if one.get("direction") == "axial":
                self.spring[round(one["x"] * cells)] += min(one["stiffness"], 1e9)
        self.load = {case: np.zeros(n + 1) for case in ("dead", "live")}
        self.longer = {case: np.zeros(n) for case in ("dead", "live")}
        for one in scene["loads"]:
            case = one.get("case", "live")
            if one["type"] == "axial":
                self.load[case][round(one["x"] * cells)] += one["F"]
            elif one["type"] == "axial_uniform":
                self.load[case] += beside_nodes(np.where(self.inside(one), one["q"], 0.0)).sum(0) / (2 * cells)
            else:
                self.longer[case][self.inside(one)] += scene["beam"]["alpha"] * one["dT"] / cells
        self.u = np.zeros(n + 1)

    def inside(self, one: dict) -> np.ndarray:
        """Which cells lie in a stretch."""
        return (self.middle > one.get("from", 0.0)) & (self.middle < (one.get("to") or self.end))

    def follow(self, history: list[float], steps: int) -> tuple[np.ndarray, np.ndarray]:
        """Put the dead loads on, then go through load factors; give forces of the springs and displacements of the nodes."""
        at = {"dead": 0.0, "live": 0.0}
        for case, goal in (("dead", 1.0), *(("live", one) for one in history)):
            if case == "dead" and not (self.load["dead"].any() or self.longer["dead"].any()):
                continue
            begin = at[case]
            for k in range(1, steps + 1):
                at[case] = begin + (goal - begin) * k / steps
                self.step(sum(at[one] * self.load[one] for one in at), sum(at[one] * self.longer[one] for one in at))
        longer = sum(at[one] * self.longer[one] for one in at)
        return self.stiffness * (np.diff(self.u) - longer), self.u.copy()


def beside_nodes(of_cells: np.ndarray) -> np.ndarray:
    """Values of the cells on the left and on the right of the nodes, shape (2, nodes)."""
    return np.array([np.append(0.0, of_cells), np.append(of_cells, 0.0)])


class Bar(Mesh):
    """The same on ground that rubs along it; parameters as for `Mesh`, the ground with its limits."""

    def __init__(self, scene: dict, cells: int):
        super().__init__(scene, cells)
        limit = np.zeros(len(self.middle))
        for one in scene["axial_ground"]:
            limit[self.inside(one)] = one["limit"]
        self.limit = beside_nodes(limit).sum(0) / (2 * cells)
        self.state = np.where(self.limit > 0.0, 0, 2)

    def step(self, load: np.ndarray, longer: np.ndarray) -> None:
        """One load step: 0 sticks, 1 and -1 slide to the right and to the left."""
        before, state = self.u, self.state
        for count in range(4000):
            with np.errstate(divide="raise", invalid="raise"):  # nothing holds the beam in these states
                u, friction = self._solve(load, longer, state, before)
            stuck, slides = state == 0, abs(state) == 1
            over = np.where(stuck & (np.abs(friction) > self.limit * (1 + 1e-12) + 1e-14), -np.sign(friction), 0).astype(int)
            back = slides & ((u - before) * state < -1e-15)
            if not (over.any() or back.any()):
                break
            changes = (over != 0) | back
            if count > 30:  # one at a time, which ends (Murty)
                changes[np.flatnonzero(changes)[0] + 1 :] = False
            state = np.where(changes, over, state)
        else:
            raise ArithmeticError("the states do not agree")
        self.u, self.state = u, state

    def _solve(
        self, load: np.ndarray, longer: np.ndarray, state: np.ndarray, before: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Displacements and friction (on the bar, to the right) for given states."""
        c, n = self.stiffness, len(before)
        right = load - np.where(abs(state) == 1, state * self.limit, 0.0)
        right[:-1] -= c * longer
        right[1:] += c * longer
        diagonal = self.spring.copy()
        diagonal[:-1] += c
        diagonal[1:] += c
        fixed, u = state == 0, np.where(state == 0, before, 0.0)
        a, b = np.zeros(n), np.zeros(n)  # u[i] = a[i] + b[i] u[i + 1]
        for i in range(n):
            if fixed[i]:
                a[i] = u[i]
                continue
            pivot, value = diagonal[i], right[i]
            if i:
                pivot -= c[i - 1] * b[i - 1]
                value += c[i - 1] * a[i - 1]
            a[i], b[i] = value / pivot, (c[i] / pivot if i < n - 1 else 0.0)
        u[-1] = a[-1]
        for i in range(n - 2, -1, -1):
            u[i] = a[i] + b[i] * u[i + 1]
        force = c * (np.diff(u) - longer)
        balance = load - self.spring * u + np.append(force, 0.0) - np.append(0.0, force)
        return u, np.where(fixed, -balance, np.where(abs(state) == 1, -state * self.limit, 0.0))
