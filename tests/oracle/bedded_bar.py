"""A bar on springs and sliders along it, as very many of these in a row between short springs, in small load steps.

Each step is a nonlinear system: a slider takes what its spring gives, cut off at its limit (return mapping). With more nodes and
steps it tends to the bar itself, with the square of their distance.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg import solve_banded


class BeddedBar:
    """Nodes at equal distances along a scene's beam.

    Parameters
    ----------
    scene : dict
        Spans, EA, alpha, sections, axial supports, axial ground with a stiffness, loads along the beam; all places on the mesh.
    cells : int
        Nodes per length 1, less one.
    """

    def __init__(self, scene: dict, cells: int):
        end = sum(scene["beam"]["spans"])
        n = round(end * cells)
        self.x = np.arange(n + 1) / cells
        middle = (self.x[1:] + self.x[:-1]) / 2
        EA, k, limit = np.full(n, scene["beam"]["EA"]), np.zeros(n), np.zeros(n)
        for one in scene.get("sections", ()):
            EA[_inside(one, middle, end)] = one["EA"]
        for one in scene["axial_ground"]:
            a, b = one.get("from", 0.0), one.get("to") or end
            here = _inside(one, middle, end)
            k[here] = one["stiffness"]
            ends = np.broadcast_to(one.get("limit", np.inf), 2)
            limit[here] = ends[0] if ends[0] == ends[1] else (ends[0] + (ends[1] - ends[0]) * (middle[here] - a) / (b - a))
        self.bar = EA * cells
        self.k, self.limit = (_beside_nodes(one) / (2 * cells) for one in (k, limit))  # shape (2, nodes): springs on both sides
        self.support = np.zeros(n + 1)
        for one in scene["supports"]:
            if one.get("direction") == "axial":
                self.support[round(one["x"] * cells)] += min(one["stiffness"], 1e9)
        self.load = {case: np.zeros(n + 1) for case in ("dead", "live")}
        self.longer = {case: np.zeros(n) for case in ("dead", "live")}
        for one in scene["loads"]:
            case = one.get("case", "live")
            if one["type"] == "axial":
                self.load[case][round(one["x"] * cells)] += one["F"]
            elif one["type"] == "axial_uniform":
                self.load[case] += _beside_nodes(np.where(_inside(one, middle, end), one["q"], 0.0)).sum(0) / (2 * cells)
            else:
                self.longer[case][_inside(one, middle, end)] += scene["beam"]["alpha"] * one["dT"] / cells
        self.u, self.slid = np.zeros(n + 1), np.zeros((2, n + 1))

    def follow(self, history: list[float], steps: int) -> tuple[np.ndarray, np.ndarray]:
        """Put the dead loads on, then go through load factors; give forces of the bars and displacements of the nodes."""
        at = {"dead": 0.0, "live": 0.0}
        for case, goal in (("dead", 1.0), *(("live", one) for one in history)):
            begin = at[case]
            for i in range(1, steps + 1):
                at[case] = begin + (goal - begin) * i / steps
                self._step(sum(at[one] * self.load[one] for one in at), sum(at[one] * self.longer[one] for one in at))
        longer = sum(at[one] * self.longer[one] for one in at)
        return self.bar * (np.diff(self.u) - longer), self.u.copy()

    def _step(self, load: np.ndarray, longer: np.ndarray) -> None:
        """One load step, by Newton's method."""
        right = load.copy()
        right[:-1] -= self.bar * longer
        right[1:] += self.bar * longer
        stiff = np.zeros((3, len(self.u)))
        stiff[0, 1:] = stiff[2, :-1] = -self.bar
        own = self.support.copy()
        own[:-1] += self.bar
        own[1:] += self.bar
        before = None
        for _ in range(200):
            push = self.k * (self.u - self.slid)
            slides = np.abs(push) > self.limit
            if before is not None and (slides * np.sign(push) == before).all():
                break
            before = slides * np.sign(push)
            stiff[1] = own + np.where(slides, 0.0, self.k).sum(0)
            known = self.k * self.slid
            known[slides] = -np.sign(push[slides]) * self.limit[slides]
            self.u = solve_banded((1, 1), stiff, right + known.sum(0))
        else:
            raise ArithmeticError("Newton's method comes to no end")
        taken = np.clip(push, -self.limit, self.limit)
        self.slid = self.u - np.divide(taken, self.k, out=np.zeros_like(taken), where=self.k > 0.0)


def _inside(one: dict, x: np.ndarray, end: float) -> np.ndarray:
    return (x > one.get("from", 0.0)) & (x < (one.get("to") or end))


def _beside_nodes(of_cells: np.ndarray) -> np.ndarray:
    return np.array([np.append(0.0, of_cells), np.append(of_cells, 0.0)])
