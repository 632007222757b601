"""A simple beam on supports with cubic laws, by another method: its flexibility in closed form, small steps along the path, and
limit points as roots of the bordered system in 40 digits.

Nothing of gapbeam is used. The beam has length 1 and bending stiffness EI, supports push up where it is pressed down.
"""

from itertools import pairwise

import mpmath as mp
import numpy as np

STEP = 0.004
"""Length of a step in sizes of the laws."""


def flexibility(x, a, EI):
    """Deflection at x of a simple beam of length 1 due to a force of 1 at a."""
    x, a = (x, a) if x <= a else (a, x)
    return x * (1 - a) * (1 - x * x - (1 - a) ** 2) / (6 * EI)


class Problem:
    """Equations x = factor*u - F r(x)."""

    def __init__(self, places, laws, loads, EI):
        self.laws = laws
        exact = [[flexibility(mp.mpf(a), mp.mpf(b), mp.mpf(EI)) for b in places] for a in places]
        self.F = mp.matrix(exact)
        self.u = mp.matrix([mp.fsum(mp.mpf(P) * flexibility(mp.mpf(a), mp.mpf(at), mp.mpf(EI)) for at, P in loads) for a in places])
        self.F_rough, self.u_rough = np.array(self.F.tolist(), dtype=float), np.array(self.u.tolist(), dtype=float)[:, 0]
        self.k1, self.k2, self.k3 = (np.array([float(law[k]) for law in laws]) for k in range(3))
        self.size = max((law[0] / law[2]) ** 0.5 for law in laws)

    def law(self, i, d):
        """Force, slope and its derivative, in many digits."""
        k1, k2, k3 = map(mp.mpf, self.laws[i])
        return (d * (k1 + d * (k2 + k3 * d)), k1 + d * (2 * k2 + 3 * k3 * d), 2 * k2 + 6 * k3 * d) if d > 0 else (mp.mpf(0),) * 3

    def rough(self, x):
        """Forces and slopes in doubles."""
        d = np.maximum(x, 0.0)
        return d * (self.k1 + d * (self.k2 + self.k3 * d)), np.where(x > 0, self.k1 + d * (2 * self.k2 + 3 * self.k3 * d), 0.0)

    def tangent(self, y, before):
        """Direction of the path, and the sign of the determinant."""
        _, slope = self.rough(y[:-1])
        matrix = np.zeros((len(y), len(y)))
        matrix[:-1, :-1] = np.eye(len(slope)) + self.F_rough * slope
        matrix[:-1, -1] = -self.u_rough
        matrix[-1] = before
        found = np.linalg.solve(matrix, np.append(np.zeros(len(slope)), 1.0))
        return found / np.linalg.norm(found / self.weights), float(np.linalg.slogdet(matrix[:-1, :-1])[0])

    def follow(self, target, most=200_000):
        """States in steps along the path, up to a load factor; with the direction of the load and the sign of the determinant."""
        count = len(self.laws)
        self.weights = np.append(np.full(count, self.size), 1.0)
        y, before = np.zeros(count + 1), np.append(self.u_rough, 1.0)
        rows = []
        for step in range(most):
            way, sign = self.tangent(y, before / self.weights**2)
            rows.append((y.copy(), np.sign(way[-1]), sign, way))
            if y[-1] > target:
                return rows
            before, place = way, y + STEP * min(1.0, (step + 1) / 200) * way
            y = place.copy()
            for _ in range(20):
                force, slope = self.rough(y[:-1])
                matrix = np.zeros((count + 1, count + 1))
                matrix[:-1, :-1] = np.eye(count) + self.F_rough * slope
                matrix[:-1, -1] = -self.u_rough
                matrix[-1] = way / self.weights**2
                left = np.append(y[-1] * self.u_rough - self.F_rough @ force - y[:-1], way / self.weights**2 @ (place - y))
                change = np.linalg.solve(matrix, left)
                y += change
                if np.abs(change / self.weights).max() < 1e-13:
                    break
        return None

    def limit_point(self, y, way):
        """Deflections and load factor where the load turns round, near a state, in 40 digits."""
        count = len(self.laws)
        with mp.workdps(45):
            scale = np.abs(way[:-1]).max()
            fixed = int(np.abs(way[:-1]).argmax())

            def equations(*unknowns):
                x, factor, phi = unknowns[:count], unknowns[count], unknowns[count + 1 :]
                r, s = zip(*[self.law(i, x[i])[:2] for i in range(count)], strict=True)
                rows = [x[i] - factor * self.u[i] + mp.fsum(self.F[i, j] * r[j] for j in range(count)) for i in range(count)]
                rows += [phi[i] + mp.fsum(self.F[i, j] * s[j] * phi[j] for j in range(count)) for i in range(count)]
                return [*rows, phi[fixed] - 1]

            start = [*map(mp.mpf, y), *map(mp.mpf, way[:-1] / (way[fixed] if way[fixed] else scale))]
            found = mp.findroot(equations, start, tol=mp.mpf(10) ** -70, maxsteps=50)
            return [found[i] for i in range(count)], found[count]

    def state(self, y, factor):
        """Deflections at a load factor, near a state."""
        count = len(self.laws)
        with mp.workdps(45):

            def equations(*x):
                r = [self.law(i, x[i])[0] for i in range(count)]
                return [x[i] - factor * self.u[i] + mp.fsum(self.F[i, j] * r[j] for j in range(count)) for i in range(count)]

            found = mp.findroot(equations, [mp.mpf(v) for v in y[:-1]], tol=mp.mpf(10) ** -70, maxsteps=50)
            return list(found)

    def event(self, y, i):
        """Deflections and load factor where a support opens or closes, near a state."""
        count = len(self.laws)
        with mp.workdps(45):

            def equations(*unknowns):
                x = [*unknowns[:i], mp.mpf(0), *unknowns[i : count - 1]]
                r = [self.law(j, x[j])[0] for j in range(count)]
                return [x[k] - unknowns[-1] * self.u[k] + mp.fsum(self.F[k, j] * r[j] for j in range(count)) for k in range(count)]

            found = mp.findroot(equations, [mp.mpf(v) for v in np.delete(y, i)], tol=mp.mpf(10) ** -70, maxsteps=50)
            return found[count - 1] if count > 1 else found

    def happenings(self, rows):
        """Load factors of limit points, with deflections, and of events, in the order of the path; None where it branches."""
        found = []
        for (y, way, sign, direction), (z, next_way, next_sign, _) in pairwise(rows[1:]):
            crossed = np.flatnonzero(np.sign(y[:-1]) != np.sign(z[:-1])).tolist()
            if len(crossed) > 1 or (crossed and way != next_way) or (way == next_way) != (sign == next_sign):
                return None
            if crossed:
                found.append((None, self.event(y, crossed[0])))
            elif way != next_way:
                found.append(self.limit_point(y, direction))
        return found
