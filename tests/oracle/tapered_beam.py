"""Beams whose stiffness changes along them, in 40 digits: by statics and double integration, for a given contact scheme.

Independent of gapbeam: reactions, the deflection and rotation of the left end and the turns of the hinges are unknowns of one dense
system; integrals are those of Gauss with 40 points on parts of every stretch in which the depth changes by 1.4 at most.
"""

from __future__ import annotations

from itertools import pairwise

import mpmath as mp

POINTS = 40


def _gauss():
    found = []
    for i in range(1, POINTS + 1):
        x = mp.cos(mp.pi * (i - mp.mpf("0.25")) / (POINTS + mp.mpf("0.5")))
        for _ in range(60):
            a, b = mp.mpf(1), x
            for k in range(2, POINTS + 1):
                a, b = b, ((2 * k - 1) * x * b - (k - 1) * a) / k
            slope = POINTS * (a - x * b) / (1 - x * x)
            step = b / slope
            x -= step
            if abs(step) < mp.mpf(10) ** (-mp.mp.dps - 5):
                break
        found.append(((1 + x) / 2, 1 / ((1 - x * x) * slope**2)))
    return found


class TaperedBeam:
    """A beam on supports that are known to act.

    Parameters
    ----------
    length : float
    sections : list of (from, to, (EI, EI_to, power), (GA, GA_to, power))
        They cover the beam; GA may be infinite.
    loads : list of tuples
        ("force", x, F), ("moment", x, M), ("linear", from, to, qa, qb), ("curvature", from, to, kappa).
    hinges : list of float
    acting : list of (x, flexibility, level)
        Supports that act: deflection = level + flexibility times reaction.
    held : list of (x, compliance)
        Rotational restraints: rotation = compliance times couple (clockwise on the support).
    """

    def __init__(self, length, sections, loads, hinges=(), acting=(), held=()):
        self.length, self.sections, self.loads = mp.mpf(length), sections, loads
        self.hinges, self.acting, self.held = list(map(mp.mpf, hinges)), acting, held
        marks = {mp.mpf(0), self.length, *self.hinges, *(mp.mpf(a[0]) for a in (*acting, *held))}
        for a, b, *_ in sections:
            marks |= {mp.mpf(a), mp.mpf(b)}
        for kind, *rest in loads:
            marks |= set(map(mp.mpf, rest[: 1 if kind in ("force", "moment") else 2]))
        self.marks = sorted(marks)
        self.gauss = _gauss()
        self._solve()

    def _section(self, x):
        return next(one for one in self.sections if one[0] <= x < one[1] or (x == self.length and x == one[1]))

    def _stiffness(self, x, which, at):
        a, b, *both = self._section(at)
        start, stop, power = both[which]
        if start == stop:
            return mp.mpf(start)
        t = (x - mp.mpf(a)) / (mp.mpf(b) - mp.mpf(a))
        power_of = mp.mpf(1) / power
        return (mp.mpf(start) ** power_of * (1 - t) + mp.mpf(stop) ** power_of * t) ** power

    def _columns(self, x, right=False):
        """Moment and shear at x by unknowns and loads: reactions, couples; last the loads."""
        moments, shears = [], []

        def after(at):
            return x > at or (right and x == at)

        for at, *_ in self.acting:  # upward
            moments.append(max(x - mp.mpf(at), mp.mpf(0)))
            shears.append(mp.mpf(1) if after(mp.mpf(at)) else mp.mpf(0))
        for at, *_ in self.held:  # counterclockwise on the beam for a positive rotation
            moments.append(-mp.mpf(1) if after(mp.mpf(at)) else mp.mpf(0))
            shears.append(mp.mpf(0))
        m, v = mp.mpf(0), mp.mpf(0)
        for kind, *rest in self.loads:
            if kind == "force":
                m -= mp.mpf(rest[1]) * max(x - mp.mpf(rest[0]), mp.mpf(0))
                v -= mp.mpf(rest[1]) if after(mp.mpf(rest[0])) else 0
            elif kind == "moment":
                m += mp.mpf(rest[1]) if after(mp.mpf(rest[0])) else 0
            elif kind == "linear":
                a, b, qa, qb = map(mp.mpf, rest)
                s = min(max(x - a, mp.mpf(0)), b - a)
                far = max(x - b, mp.mpf(0))
                slope = (qb - qa) / (b - a)
                force = qa * s + slope * s * s / 2
                m -= qa * s * s / 2 + slope * s**3 / 6 + force * far
                v -= force
        return [*moments, m], [*shears, v]

    def _kappa(self, x):
        return sum((mp.mpf(load[3]) for load in self.loads if load[0] == "curvature" and load[1] <= x < load[2]), mp.mpf(0))

    def _integrals(self, upto):
        """Turn and deflection from all unknowns and the loads up to a place."""
        count = len(self.acting) + len(self.held) + 1
        turn, bend = [mp.mpf(0)] * count, [mp.mpf(0)] * count
        for a, b in pairwise([mark for mark in self.marks if mark < upto] + [upto]):
            middle = (a + b) / 2
            ratio = max(abs(mp.log(self._stiffness(b, k, middle) / self._stiffness(a, k, middle))) for k in (0, 1)
                        if mp.isfinite(self._stiffness(middle, k, middle)))  # fmt: skip
            parts = 1 + int(ratio / mp.mpf("0.33"))
            depth = self._stiffness(b, 0, middle) / self._stiffness(a, 0, middle)
            cuts = [a + (b - a) * (mp.mpf(k) / parts if abs(depth - 1) < mp.mpf("0.1") else
                                   (depth ** (mp.mpf(k) / parts) - 1) / (depth - 1)) for k in range(parts + 1)]  # fmt: skip
            for c, d in pairwise(cuts):
                for t, w in self.gauss:
                    x, weight = c + (d - c) * t, w * (d - c)
                    m, v = self._columns(x)
                    soft, slip = 1 / self._stiffness(x, 0, middle), 1 / self._stiffness(x, 1, middle)
                    for k in range(count):
                        bent = -soft * m[k] + (self._kappa(middle) if k == count - 1 else 0)
                        turn[k] += weight * bent
                        bend[k] += weight * (bent * (upto - x) + slip * v[k])
        return turn, bend

    def _at(self, x):
        """Rows of rotation, deflection at x (left of a hinge there): unknowns, then loads."""
        turn, bend = self._integrals(x) if x > 0 else ([mp.mpf(0)] * (len(self.acting) + len(self.held) + 1),) * 2
        jumps = [(mp.mpf(1), x - h) if x > h else (mp.mpf(0), mp.mpf(0)) for h in self.hinges]
        rotation = [*turn[:-1], mp.mpf(0), mp.mpf(1), *(j[0] for j in jumps), turn[-1]]
        deflection = [*bend[:-1], mp.mpf(1), x, *(j[1] for j in jumps), bend[-1]]
        return rotation, deflection

    def _solve(self):
        rows = []
        n, h = len(self.acting) + len(self.held), len(self.hinges)
        for k, (x, flexibility, level) in enumerate(self.acting):
            row = self._at(mp.mpf(x))[1]
            row[k] -= mp.mpf(flexibility)
            row[-1] -= mp.mpf(level)
            rows.append(row)
        for k, (x, compliance) in enumerate(self.held):
            row = self._at(mp.mpf(x))[0]
            row[len(self.acting) + k] -= mp.mpf(compliance)
            rows.append(row)
        blank = [mp.mpf(0)] * (2 + h)
        for x in self.hinges:
            m, _ = self._columns(x)
            rows.append([*m[:-1], *blank, m[-1]])
        m, v = self._columns(self.length, right=True)
        rows += [[*m[:-1], *blank, m[-1]], [*v[:-1], *blank, v[-1]]]
        matrix = mp.matrix([row[:-1] for row in rows])
        found = mp.lu_solve(matrix, mp.matrix([-row[-1] for row in rows]))
        self.unknowns = [found[i] for i in range(n + 2 + h)]
        self.reactions = self.unknowns[: len(self.acting)]

    def fields(self, x):
        """Deflection, rotation, moment and shear just left of x."""
        x = mp.mpf(x)
        rotation, deflection = self._at(x)
        m, v = self._columns(x)
        n = len(self.acting) + len(self.held)
        rows = (deflection, self.unknowns), (rotation, self.unknowns), (m, self.unknowns[:n]), (v, self.unknowns[:n])
        return tuple(sum((a * b for a, b in zip(row[:-1], u, strict=True)), row[-1]) for row, u in rows)
