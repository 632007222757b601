"""Beams on yielding supports under an axial force or on two-sided ground, condensed to these supports: exact histories of them.

Compliances come from the solution in many digits of `axial_force.py`, and are taken for rational numbers. From there on all is
as in `history.py`, which knows nothing of axial forces.

Examples
--------
>>> from .history import history
>>> prop = {"x": 0.5, "side": "below", "law": [[0.01, 1.0], [1.0, 1.0]], "unloading": "plastic"}
>>> scene = {"beam": {"spans": [1.0], "EI": 1.0, "N": 9.0}, "supports": [{"node": 0}, prop, {"node": 1}],
...          "loads": [{"type": "force", "x": 0.5, "F": 4.0}]}
>>> found = history(CondensedBeam(scene), [1.0, 0.0])
>>> [round(float(step.w[0]), 12) for step in found.steps], float(found.steps[0].reaction[0])
([0.033047319242, 0.0], 1.0)
"""

from fractions import Fraction

import mpmath as mp

from .axial_cells import DIGITS
from .axial_force import Mechanism, solve
from .cells import Loose, Problem
from .curves import ONE, ZERO, curve_of

NOTHING = mp.mpf(10) ** -60
"""Share of the largest deflection below which one is rounding, as behind a clamp."""


def exact(value):
    """An mpf as a rational number."""
    sign, digits, power, _ = mp.mpf(value)._mpf_
    return (-1) ** sign * int(digits) * Fraction(2) ** power


class CondensedBeam(Problem):
    """A scene condensed to its supports that are not linear; parameters and attributes are those of `Problem`.

    Raises
    ------
    Loose
        The beam is not held without these supports.
    """

    def __init__(self, scene):
        supports = self.take(scene)
        self.sign = [-1 if supports[i].get("side") == "above" else 1 for i in self.which]
        self.curves = [curve_of(supports[i]) for i in self.which]
        self.shift = [
            -s * Fraction(supports[i].get("settlement", 0.0)) - min(ZERO, Fraction(supports[i].get("gap", 0.0)))
            for i, s in zip(self.which, self.sign, strict=True)
        ]
        m, (pushed, dead, live) = len(self.which), self.compliances()
        self.P = [[ONE if i == j else ZERO for j in range(m)] for i in range(m)]
        self.Q = [[(pushed[j][i] * s + pushed[i][j] * s) * z / 2 for j, z in enumerate(self.sign)] for i, s in enumerate(self.sign)]
        self.g = [s * w + c for s, w, c in zip(self.sign, dead, self.shift, strict=True)], [
            s * w for s, w in zip(self.sign, live, strict=True)
        ]
        self.prepare_stiffness()

    def take(self, scene):
        """Which supports it is condensed to, and which are linear; all of them."""
        self.scene, supports = scene, scene["supports"]
        self.which = [i for i, s in enumerate(supports) if "law" in s or s.get("side", "both") != "both"]
        self.linear = [s for i, s in enumerate(supports) if i not in self.which]
        return supports

    def compliances(self):
        """Deflections at the supports `which` without them: under a force at each, under the dead loads, under the live ones."""
        pushed = [self.moved([{"type": "force", "F": 1.0, **place}]) for place in map(self.place, self.which)]
        loads = self.scene.get("loads", [])
        dead = self.moved([load for load in loads if load.get("case") == "dead"], settled=True)
        return pushed, dead, self.moved([load for load in loads if load.get("case") != "dead"])

    def place(self, i):
        """Where a support is, as in a load."""
        return {key: self.scene["supports"][i][key] for key in ("x", "node") if key in self.scene["supports"][i]}

    def moved(self, loads, settled=False):
        """Deflections at the supports `which` without them; those of the others settle with the dead loads."""
        bare = [s if settled else {**s, "settlement": 0.0} for s in self.linear]
        bare += [{**self.place(i), "stiffness": 0.0} for i in self.which]
        part = {**self.scene, "supports": bare, "loads": [{**load, "case": "live"} for load in loads]}
        with mp.workdps(DIGITS):
            try:
                found = solve(part, active=[])
            except Mechanism:
                raise Loose from None
        moved = found.deflection[len(self.linear) :]
        most = max((abs(w) for w in found.deflection), default=0)
        return [exact(w) if abs(w) > NOTHING * most else ZERO for w in moved]
