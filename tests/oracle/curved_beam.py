"""Beams whose supports push by curves, condensed to these supports: states and load factors of events by Newton in many digits.

Compliances come from `axial_force.py`, under an axial force or on two-sided ground. No force falls with growing displacement, so
a state that is found is the only one.

Examples
--------
>>> stop = {"x": 0.5, "side": "below", "gap": 0.001, "law": {"type": "cubic", "k1": 3.0, "k3": 1e4}}
>>> scene = {"beam": {"spans": [1.0], "EI": 1.0, "N": 9.0}, "supports": [{"node": 0}, stop, {"node": 1}],
...          "loads": [{"type": "force", "x": 0.5, "F": 4.0}]}
>>> beam = CurvedBeam(scene)
>>> w, reaction = beam.state(1.0, [0.03])
>>> round(float(w[0]), 12), round(float(reaction[0]), 12)
(0.037500143502, 0.595777415944)
>>> round(float(beam.event(0, 0.01, [0.001])), 12)
0.022694730381
"""

import mpmath as mp

from .axial_history import CondensedBeam

WORKING, STEPS = 50, 60
"""Digits, and steps of Newton's method at most."""


def curve(support):
    """Force and slope of a support over the displacement past its gap, 0 or more."""
    law = support.get("law")
    if law is None:
        k = mp.mpf(support["stiffness"])
        return lambda d: (k * d, k)
    p = {key: mp.mpf(value) for key, value in law.items() if key != "type"}
    if law["type"] == "tanh":
        return lambda d: (p["limit"] * mp.tanh(p["stiffness"] * d / p["limit"]),
                          p["stiffness"] / mp.cosh(p["stiffness"] * d / p["limit"]) ** 2)  # fmt: skip
    if law["type"] == "hyperbolic":
        return lambda d: (p["stiffness"] * d / (1 + p["stiffness"] * d / p["limit"]),
                          p["stiffness"] / (1 + p["stiffness"] * d / p["limit"]) ** 2)  # fmt: skip
    if law["type"] == "cubic":
        k1, k2, k3 = (p.get(key, mp.mpf(0)) for key in ("k1", "k2", "k3"))
        return lambda d: (d * (k1 + d * (k2 + d * k3)), k1 + d * (2 * k2 + 3 * d * k3))
    return lambda d: (p["limit"] * (d / p["d0"]) ** p["n"], p["limit"] * p["n"] * (d / p["d0"]) ** (p["n"] - 1) / p["d0"])


class CurvedBeam(CondensedBeam):
    """A scene condensed to the supports that have a law, or act one way.

    Parameters
    ----------
    scene : dict
        As for `axial_force.py`, with curves by name as laws; supports that act one way have a stiffness or a law.

    Raises
    ------
    Loose
        The beam is not held without these supports.
    """

    def __init__(self, scene):
        supports = self.take(scene)
        self.curves = [curve(supports[i]) for i in self.which]
        with mp.workdps(WORKING):
            pushed, dead, live = self.compliances()
            self.soft = mp.matrix([[number(row[j]) for row in pushed] for j in range(len(self.which))])
            self.dead, self.live = [number(w) for w in dead], [number(w) for w in live]

    def past(self, k, w):
        """Displacement of support k past its gap, and which way that goes."""
        s = self.scene["supports"][self.which[k]]
        away = w - mp.mpf(s.get("settlement", 0.0))
        way = {"below": 1, "above": -1}.get(s.get("side", "both")) or (-1 if away < 0 else 1)
        return way * away - mp.mpf(s.get("gap", 0.0)), way

    def reaction(self, k, w):
        """Reaction of support k, up, and its slope."""
        d, way = self.past(k, w)
        if d > 0:
            force, slope = self.curves[k](d)
            return way * force, slope
        return mp.mpf(0), mp.mpf(0)

    def state(self, factor, start):
        """Deflections and reactions of the supports at a load factor, from deflections nearby."""
        with mp.workdps(WORKING):
            w = mp.matrix([mp.mpf(float(value)) for value in start])
            free = mp.matrix([d + mp.mpf(factor) * v for d, v in zip(self.dead, self.live, strict=True)])
            for _ in range(STEPS):
                found = [self.reaction(k, w[k]) for k in range(len(w))]
                rest = w - free + self.soft * mp.matrix([r for r, _ in found])
                step = mp.lu_solve(mp.eye(len(w)) + self.soft * mp.diag([slope for _, slope in found]), rest)
                w = w - step
                if mp.norm(step, mp.inf) <= mp.mpf(10) ** (8 - WORKING) * mp.norm(w, mp.inf):
                    return list(w), [self.reaction(k, w[k])[0] for k in range(len(w))]
        raise ArithmeticError("Newton's method does not settle")

    def event(self, number_of, factor, start):
        """The load factor nearby at which support `number_of` of `which` begins to act, or ends."""
        with mp.workdps(WORKING):
            w, at = mp.matrix([mp.mpf(float(value)) for value in start]), mp.mpf(factor)
            n = len(w)
            _, way = self.past(number_of, w[number_of])
            for _ in range(STEPS):
                found = [self.reaction(k, w[k]) if k != number_of else (mp.mpf(0), mp.mpf(0)) for k in range(n)]
                free = mp.matrix([d + at * v for d, v in zip(self.dead, self.live, strict=True)])
                rest = w - free + self.soft * mp.matrix([r for r, _ in found])
                s = self.scene["supports"][self.which[number_of]]
                line = w[number_of] - (mp.mpf(s.get("settlement", 0.0)) + way * mp.mpf(s.get("gap", 0.0)))
                system = mp.zeros(n + 1)
                system[:n, :n] = mp.eye(n) + self.soft * mp.diag([slope for _, slope in found])
                for k in range(n):
                    system[k, n] = -self.live[k]
                system[n, number_of] = 1
                step = mp.lu_solve(system, mp.matrix([*rest, line]))
                w, at = w - step[:n], at - step[n]
                if abs(step[n]) <= mp.mpf(10) ** (8 - WORKING) * abs(at):
                    return at
        raise ArithmeticError("Newton's method does not settle")


def number(value):
    """A rational number in many digits."""
    return mp.mpf(value.numerator) / value.denominator
