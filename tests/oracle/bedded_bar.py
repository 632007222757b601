"""A bar on springs and sliders along it, as very many of these in a row between short springs, in small load steps.

Each step is a nonlinear system: a slider takes what its spring gives, cut off at its limit (return mapping). With more nodes and
steps it tends to the bar itself, with the square of their distance.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg import solve_banded

from .ground_along import Mesh, beside_nodes


class BeddedBar(Mesh):
    """The same on such ground; parameters as for `Mesh`, the ground with its stiffnesses and limits."""

    def __init__(self, scene: dict, cells: int):
        super().__init__(scene, cells)
        k, limit = np.zeros(len(self.middle)), np.zeros(len(self.middle))
        for one in scene["axial_ground"]:
            a, b = one.get("from", 0.0), one.get("to") or self.end
            here = self.inside(one)
            k[here] = one["stiffness"]
            ends = np.broadcast_to(one.get("limit", np.inf), 2)
            limit[here] = ends[0] if ends[0] == ends[1] else (ends[0] + (ends[1] - ends[0]) * (self.middle[here] - a) / (b - a))
        # Springs on both sides of the nodes
        self.k, self.limit = (beside_nodes(one) / (2 * cells) for one in (k, limit))
        self.slid = np.zeros((2, len(self.x)))

    def step(self, load: np.ndarray, longer: np.ndarray) -> None:
        """One load step, by Newton's method."""
        right = load.copy()
        right[:-1] -= self.stiffness * longer
        right[1:] += self.stiffness * longer
        stiff = np.zeros((3, len(self.u)))
        stiff[0, 1:] = stiff[2, :-1] = -self.stiffness
        own = self.spring.copy()
        own[:-1] += self.stiffness
        own[1:] += self.stiffness
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
