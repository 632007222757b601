"""An elastoplastic step program for supports that push and keep a set, independent of the engine.

Hermite elements between supports and loads, one spring at a place and side whose force follows `min(stiffness (d - set), limit)`
and never pulls, small load steps, Newton's method with a line search in each. Nothing of it looks for kinks.
"""

import itertools

import numpy as np

STEPS = 150
NEWTON = 200


class Springs:
    """One-sided springs with the law plastic or hardening and unloading plastic, by their scene entries."""

    def __init__(self, supports, places):
        self.row = np.array([2 * places.index(s["x"]) for s in supports])
        self.side = np.array([1.0 if s["side"] == "below" else -1.0 for s in supports])
        self.gap = np.array([s.get("gap", 0.0) for s in supports])
        laws = [s["law"] for s in supports]
        self.k, self.limit = (np.array([law[key] for law in laws]) for key in ("stiffness", "limit"))
        self.slope = np.array([law.get("slope", 0.0) for law in laws])
        self.set = np.zeros(len(supports))

    def forces(self, u):
        """Forces up, slopes, and the sets that go with deflections `u`."""
        d = self.side * u[self.row] - self.gap
        most = self.limit + self.slope * (d - self.limit / self.k)
        trial = self.k * (d - self.set)
        yields = trial > most
        force = np.where(yields, most, np.maximum(trial, 0.0))
        slope = np.where(yields, self.slope, np.where(trial >= 0.0, self.k, 0.0))
        return self.side * force, slope, np.where(yields, d - most / self.k, self.set)


def follow_steps(scene, steps=STEPS):
    """Deflections of the supports at the load factors of a scene's history."""
    length, EI = scene["beam"]["spans"][0], scene["beam"]["EI"]
    places = sorted({0.0, length, *(s["x"] for s in scene["supports"]), *(f["x"] for f in scene["loads"])})
    beam = np.zeros((2 * len(places), 2 * len(places)))
    for i, (a, b) in enumerate(itertools.pairwise(places)):
        h = b - a
        beam[2 * i : 2 * i + 4, 2 * i : 2 * i + 4] += (EI / h**3) * np.array([
            [12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
            [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h],
        ])  # fmt: skip
    for s in scene["supports"]:
        if "law" not in s:
            beam[2 * places.index(s["x"]), 2 * places.index(s["x"])] += s["stiffness"]
    springs = Springs([s for s in scene["supports"] if "law" in s], places)
    load = np.zeros(len(beam))
    for force in scene["loads"]:
        load[2 * places.index(force["x"])] += force["F"]
    rows = [2 * places.index(s["x"]) for s in scene["supports"]]
    u, at, found = np.zeros(len(beam)), 0.0, []
    for goal in scene["analysis"]["history"]:
        for factor in np.linspace(at, goal, steps + 1)[1:]:
            u = _settle(beam, springs, factor * load, u)
            springs.set = springs.forces(u)[2]
        at = goal
        found.append(u[rows])
    return found


def _settle(beam, springs, load, u):
    def residual(u):
        left = load - beam @ u
        np.add.at(left, springs.row, -springs.forces(u)[0])
        return left

    for _ in range(NEWTON):
        tangent = beam.copy()
        np.add.at(tangent, (springs.row, springs.row), springs.forces(u)[1])
        left = residual(u)
        change = np.linalg.solve(tangent + 1e-9 * np.diag(np.diag(beam)), left)
        share, low, high = 1.0, 0.0, 1.0
        if residual(u + change) @ change < -1e-12 * abs(left @ change):
            for _ in range(60):
                share = (low + high) / 2
                low, high = (share, high) if residual(u + share * change) @ change > 0.0 else (low, share)
        u = u + share * change
        if np.abs(change).max() < 1e-13 * max(1e-3, np.abs(u).max()):
            return u
    raise ArithmeticError("no convergence")
