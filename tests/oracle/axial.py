"""Exact reference solution of the axial system, a bar apart from bending.

Displacements u and forces are positive to the right, axial forces N positive in tension: u' = N/EA, and a
force F to the right makes N jump by -F. Unknowns: u(0) and the force of every axial support on the beam.

Examples
--------
>>> bar = Bar({"beam": {"spans": [4.0], "EI": 1.0, "EA": 8.0},
...            "supports": [{"node": 0, "direction": "axial"}, {"node": 1, "direction": "axial"}],
...            "loads": [{"type": "axial", "x": 1.0, "F": 4.0}]})
>>> bar.reaction, [float(u) for u in bar.at(1.0)]
([Fraction(-3, 1), Fraction(-1, 1)], [0.375, -1.0])
"""

import math
from fractions import Fraction

from .forms import dot, inverse, per_span, reduce_rows


class Bar:
    """The axial system of a scene at one load factor, solved.

    Parameters
    ----------
    scene : dict
    factor : float

    Attributes
    ----------
    reaction, displacement : list of Fraction
        One entry for each axial support, in scene order.
    """

    def __init__(self, scene, factor=1.0):
        beam = scene["beam"]
        self.nodes = [math.fsum(beam["spans"][:i]) for i in range(len(beam["spans"]) + 1)]
        self.supports = [s for s in scene["supports"] if s.get("direction") == "axial"]
        self.loads = [load for load in scene["loads"] if load["type"] == "axial"]
        self.factor = Fraction(factor)
        stiffness = per_span(beam.get("EA", math.inf), len(beam["spans"]))
        self.stretches = list(zip(self.nodes[:-1], self.nodes[1:], stiffness, strict=True))
        self.stretches += [
            (s.get("from", 0.0), s.get("to", self.nodes[-1]), s["EA"])
            for s in scene.get("sections", [])
            if "EA" in s
        ]
        unknowns = 1 + len(self.supports)
        self.weights = [Fraction(0)] * unknowns + [Fraction(1)]
        rows = [self.forms(self.nodes[-1], "right")[1]]
        for k, support in enumerate(self.supports):
            row = self.forms(self.place(support), "right")[0]
            row[1 + k] += inverse(
                support.get("stiffness", math.inf)
            )  # force on the beam = -stiffness (u - settlement)
            row[-1] -= Fraction(support.get("settlement", 0.0))
            rows.append(row)
        reduced, pivots = reduce_rows(rows, unknowns)
        if len(pivots) < unknowns:
            raise ZeroDivisionError("the axial system is singular")
        self.weights = [-row[-1] for row in reduced] + [Fraction(1)]
        self.reaction = self.weights[1:-1]
        self.displacement = [self.at(self.place(s))[0] for s in self.supports]

    def place(self, item):
        """The x of a support or load."""
        return item["x"] if "x" in item else self.nodes[item["node"]]

    def forms(self, x, side):
        """Linear forms of (u, N) at x in the unknowns and 1."""
        x = Fraction(x)
        marks = {Fraction(p) for p in self.nodes} | {Fraction(p) for s in self.stretches for p in s[:2]}
        marks |= {Fraction(self.place(item)) for item in (*self.supports, *self.loads)} | {x}
        marks = sorted(marks)
        u = [Fraction(0)] * len(self.weights)
        N = list(u)
        u[0] = Fraction(1)
        for k, mark in enumerate(marks):
            if mark == x and side == "left":
                break
            for i, support in enumerate(self.supports):
                if Fraction(self.place(support)) == mark:
                    N[1 + i] -= 1
            for load in self.loads:
                if Fraction(self.place(load)) == mark:
                    N[-1] -= Fraction(load["F"]) * (self.factor if load.get("case", "live") == "live" else 1)
            if mark == x:
                break
            EA = next(s[2] for s in reversed(self.stretches) if s[0] <= mark < s[1])
            stretch = inverse(EA) * (marks[k + 1] - mark)
            u = [a + stretch * b for a, b in zip(u, N, strict=True)]
        return u, N

    def at(self, x, side="right"):
        """Displacement and axial force at x, as fractions."""
        return tuple(dot(form, self.weights) for form in self.forms(x, side))
