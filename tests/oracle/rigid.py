"""Parts of `foundation.py`: rigid motions that do work (in fractions), and a rough state in doubles."""

from fractions import Fraction

import numpy as np
from mpmath import libmp, mp, mpf


def exact(v):
    """A number of mpmath as a fraction."""
    p, q = libmp.to_rational(mpf(v)._mpf_)
    return Fraction(int(p), int(q))


class Motions:
    """Rigid motions of a beam, with hinges, that supports and foundations allow: `limits` v <= 0.

    Unknowns are the deflections at the ends and hinges. Foundations whose law ends level take part of the work
    (`taken`): a force times a deflection each, together not less than what they really take.
    """

    def __init__(self, problem):
        self.corners = sorted({mpf(0), problem.length, *problem.hinges})
        self.work, self.limits, self.taken = [Fraction(0)] * len(self.corners), [], []
        for x, v in problem.forces.items():
            self.load(v, self.value(x))
        for x, v in problem.couples.items():
            self.load(v, self.rate(x))
        for s in problem.supports:
            self.limits += [self.value(s.x, sign) for sign in ((s.side,) if s.side else (1, -1)) if s.stiffness]
            self.limits += [[sign * v for v in self.rate(s.x)] for sign in (1, -1) if s.rotation]
        for c in problem.atoms:
            h, (q0, q1) = c.b - c.a, c.q
            self.load((q0 / 2 + q1 * h / 6) * h, self.value(c.a))
            self.load((q0 / 2 + q1 * h / 3) * h, self.value(c.b))
            self.rest(c)

    def value(self, x, sign=1):
        """Form of the deflection at x."""
        i = next(i for i in range(1, len(self.corners)) if x <= self.corners[i])
        part = exact(x - self.corners[i - 1]) / exact(self.corners[i] - self.corners[i - 1])
        places = range(len(self.corners))
        return [sign * (1 - part if j == i - 1 else part if j == i else Fraction(0)) for j in places]

    def rate(self, x):
        """Form of the rotation at x."""
        i = next(i for i in range(1, len(self.corners)) if x <= self.corners[i])
        each = 1 / exact(self.corners[i] - self.corners[i - 1])
        return [-each if j == i - 1 else each if j == i else Fraction(0) for j in range(len(self.corners))]

    def load(self, v, form):
        """Add the work of a load."""
        self.work = [a + exact(v) * b for a, b in zip(self.work, form, strict=True)]

    def rest(self, c):
        """What the foundations under an atom do."""
        last = {}  # (slope of the last piece, force of it drawn back to where its law begins), by foundation and side
        for t in c.terms:
            k, force = last.get((t.foundation, t.side), (mpf(0), mpf(0)))
            mine = [u for u in c.terms if u.foundation == t.foundation and u.side in (0, t.side)]
            first = mine[0].gap[0]
            middle = t.k[0] + t.k[1] * (c.b - c.a) / 2
            last[t.foundation, t.side] = k + middle, force - middle * (t.gap[0] - first)
        for (i, side), (k, force) in last.items():
            whole = k + (last.get((i, 0), (0, 0))[0] if side else 0)
            alone = side or not any((i, s) in last for s in (1, -1))
            for x in (c.a, c.b):
                if whole > mpf(10) ** (5 - mp.dps) and alone:
                    self.limits += [self.value(x, sign) for sign in ((side,) if side else (1, -1))]
                elif force > 0 and side:
                    self.taken.append((exact(force * (c.b - c.a) / 2), self.value(x, side)))

    def some_work(self):
        """Whether along some motion the load does work that nothing can take up: no equilibrium. Sure if true."""
        return best(self.work, self.limits, self.taken) > Fraction(1, 10**12) * sum(map(abs, self.work))

    def some_without_work(self):
        """Whether along some motion nothing does work; sure if true."""
        limits = [*self.limits, *(form for _, form in self.taken), [-v for v in self.work]]
        unit = [[sign * Fraction(i == j) for j in range(len(self.work))] for i in range(len(self.work)) for sign in (1, -1)]
        return any(best(e, limits, []) > 0 for e in unit)


def best(work, limits, taken):
    """Maximum of work v - sum f max(0, g v) for |v_j| <= 1, limits v <= 0 (simplex method with Bland's rule)."""
    n, m = len(work), len(taken)
    unit = [[Fraction(i == j) for j in range(n)] for i in range(n)]
    zero = [Fraction(0)] * m
    rows = [[*r, *(-v for v in r), *zero, Fraction(0)] for r in {tuple(r) for r in limits if any(r)}]
    rows += [[*r, *(-v for v in r), *zero, Fraction(1)] for sign in (1, -1) for r in ([sign * v for v in u] for u in unit)]
    rows += [
        [*g, *(-v for v in g), *(Fraction(-(i == j)) for j in range(m)), Fraction(0)] for i, (_, g) in enumerate(taken)
    ]
    width = 2 * n + m
    table = [[*r[:-1], *(Fraction(i == j) for j in range(len(rows))), r[-1]] for i, r in enumerate(rows)]
    basis = [width + i for i in range(len(rows))]
    gain = [*work, *(-v for v in work), *(-f for f, _ in taken), *[Fraction(0)] * (len(rows) + 1)]
    while True:
        enter = next((j for j, v in enumerate(gain[:-1]) if v > 0), None)
        if enter is None:
            return -gain[-1]
        ratios = [(r[-1] / r[enter], basis[i], i) for i, r in enumerate(table) if r[enter] > 0]
        leave = min(ratios)[2]
        table[leave] = [v / table[leave][enter] for v in table[leave]]
        for i, r in enumerate(table):
            if i != leave and r[enter]:
                table[i] = [a - r[enter] * b if b else a for a, b in zip(r, table[leave], strict=True)]
        gain = [a - gain[enter] * b for a, b in zip(gain, table[leave], strict=True)]
        basis[leave] = enter


class Elements:
    """The beam as cubic elements in doubles; everything that acts on one side as springs at points."""

    def __init__(self, problem, count=80):
        self.problem, self.springs, self.spots = problem, [], []
        self.dofs = 0
        K, f, placed = [], [], {}
        step = float(problem.length) / count
        right = None
        for i, c in enumerate(problem.atoms):
            a, b = float(c.a), float(c.b)
            if right is None:
                right = self.new(2)
            placed[c.a] = right
            if c.a in problem.hinges:
                right = [right[0], self.new(1)[0]]
            n = max(1, round((b - a) / step))
            h = (b - a) / n
            for j in range(n):
                left, right = right, self.new(2)
                K.append((left + right, element(h, float(c.EI), float(c.GA))))
                for part in (0, 1):
                    xi = 0.5 + (part - 0.5) / 3**0.5
                    t = (j + xi) * h
                    shape = hermite(xi, h)
                    f.append((left + right, shape * float(c.q[0] + c.q[1] * t) * h / 2))
                    for number, term in enumerate(c.terms):
                        k, g = (float(v[0] + v[1] * t) for v in (term.k, term.gap))
                        self.spots.append((i, number, a + (j + part / 2) * h, a + (j + part / 2 + 0.5) * h))
                        self.springs.append((left + right, shape, k * h / 2, term.side, g))
                bend = float(c.kappa) * float(c.EI)
                f.append(([left[1], right[1]], np.array([-bend, bend])))
        placed[problem.length] = right
        f += [([placed[x][0]], np.array([float(v)])) for x, v in problem.forces.items()]
        f += [([placed[x][1]], np.array([float(v)])) for x, v in problem.couples.items()]
        self.K, self.f = np.zeros((self.dofs, self.dofs)), np.zeros(self.dofs)
        for dofs, v in K:
            self.K[np.ix_(dofs, dofs)] += v
        for dofs, v in f:
            self.f[dofs] += v
        stiff = 1e6 * float(max(c.EI for c in problem.atoms)) / step**3 * 1e-4
        for s in problem.supports:
            k = min(float(s.stiffness), stiff)
            if s.side:
                self.springs.append(([placed[s.x][0]], np.ones(1), k, s.side, float(s.gap + s.side * s.settlement)))
            else:
                self.K[placed[s.x][0], placed[s.x][0]] += k
                self.f[placed[s.x][0]] += k * float(s.settlement)
            self.K[placed[s.x][1], placed[s.x][1]] += min(float(s.rotation), stiff * step**2)
        self.at = np.array([[*dofs, *dofs[:1] * (4 - len(dofs))] for dofs, *_ in self.springs], int).reshape(-1, 4)
        self.shape = np.array([[*shape, *[0.0] * (4 - len(shape))] for _, shape, *_ in self.springs]).reshape(-1, 4)
        self.shape *= np.array([s[3] or 1 for s in self.springs]).reshape(-1, 1)
        self.k = np.array([s[2] for s in self.springs])
        self.gap = np.array([s[4] if s[3] else -np.inf for s in self.springs])

    def new(self, count):
        """Numbers of new unknowns."""
        self.dofs += count
        return list(range(self.dofs - count, self.dofs))

    def solve(self, steps=60):
        """Which springs act: Newton's rule with a line search on the energy."""
        K = self.K + 1e-9 * np.abs(np.diag(self.K)).min() * np.eye(self.dofs)
        free = np.isinf(self.gap)
        gap = np.where(free, 0.0, self.gap)
        u, acting = np.zeros(self.dofs), np.ones(len(gap), bool)
        for _ in range(steps):
            H, f = K.copy(), self.f.copy()
            k = np.where(acting, self.k, 0.0)[:, None]
            np.add.at(H, (self.at[:, :, None], self.at[:, None]), k[:, None] * self.shape[:, :, None] * self.shape[:, None])
            np.add.at(f, self.at, k * gap[:, None] * self.shape)
            d = banded(H, f) - u
            e, de = ((self.shape * v[self.at]).sum(1) for v in (u, d))
            at_zero, change = ((K * u).sum(1) - self.f) @ d, (K * d).sum(1) @ d
            e -= gap

            def rate(t, e=e, de=de, at_zero=at_zero, change=change):
                over = e + t * de
                return at_zero + t * change + (self.k * np.where(free, over, np.maximum(over, 0.0))) @ de

            low, high = 0.0, 1.0
            while rate(high) < 0 and high < 1e3:
                high *= 2
            for _ in range(50):
                middle = (low + high) / 2
                low, high = (middle, high) if rate(middle) < 0 else (low, middle)
            new = free | (e + de > 0)
            if (new == acting).all():
                return acting
            u = u + high * d
            acting = free | (e + high * de > 0)
        return acting


def banded(H, f, width=4):
    """Solution of H u = f with a symmetric band matrix."""
    H, u, n = H.tolist(), f.tolist(), len(f)
    for j in range(n):
        for i in range(j + 1, min(n, j + width + 1)):
            part = H[i][j] / H[j][j]
            for m in range(i, min(n, j + width + 1)):
                H[m][i] -= part * H[m][j]
            u[i] -= part * u[j]
    for j in reversed(range(n)):
        u[j] = (u[j] - sum(H[i][j] * u[i] for i in range(j + 1, min(n, j + width + 1)))) / H[j][j]
    return np.array(u)


def hermite(xi, h):
    """Cubic shape functions."""
    return np.array([1 - 3 * xi**2 + 2 * xi**3, h * (xi - 2 * xi**2 + xi**3), 3 * xi**2 - 2 * xi**3, h * (xi**3 - xi**2)])


def element(h, EI, GA):
    """Stiffness matrix of an element."""
    p = 12 * EI / (GA * h * h)
    a, b, c = 12 / h**2, 6 / h, 4 + p
    d = 2 - p
    return EI / (h * (1 + p)) * np.array([[a, b, -a, b], [b, c, -b, d], [-a, -b, a, -b], [b, d, -b, c]])


def rough_state(problem):
    """(closed, zones) of a rough solution in doubles."""
    mesh = Elements(problem)
    acting = mesh.solve()
    closed, at = [], len(mesh.spots)
    for s in problem.supports:
        closed.append(bool(acting[at]) if s.side else True)
        at += bool(s.side)
    zones = [[[] for _ in c.terms] for c in problem.atoms]
    for on, (i, number, p, q) in zip(acting, mesh.spots, strict=False):
        if on and problem.atoms[i].terms[number].side:
            zone = zones[i][number]
            p, q = (min(max(mpf(x), problem.atoms[i].a), problem.atoms[i].b) for x in (p, q))
            if zone and abs(zone[-1][1] - p) < problem.length * 1e-9:
                zone[-1] = (zone[-1][0], q)
            else:
                zone.append((p, q))
    return tuple(closed), [[tuple(z) for z in atom] for atom in zones]
