"""Polylines of supports, and exact linear algebra one column at a time (for `laws.py`)."""

import itertools
import math
from fractions import Fraction

ZERO, ONE = Fraction(0), Fraction(1)


class Curve:
    """A polyline (d, r) of one support, parametrised along itself.

    Piece k has a base point, a forward direction (u, v) and a label; its parameter t is 0 at the base point.
    The first piece is a ray with t <= 0, the last one a ray with t >= 0, the others have 0 <= t <= 1.
    Vertex k lies between pieces k and k + 1.

    Parameters
    ----------
    points : list of (Fraction, Fraction)
    before, after : (Fraction, Fraction)
        Forward directions of the two rays.
    labels : list of int
        Branch numbers, one per piece: 0 = open, 1, 2, ... = pieces of the law, negative on the mirrored side.
    """

    def __init__(self, points, before, after, labels):
        inner = [(a, (b[0] - a[0], b[1] - a[1])) for a, b in itertools.pairwise(points)]
        self.pieces = [(points[0], before), *inner, (points[-1], after)]
        self.labels = labels
        self.last = len(self.pieces) - 1
        if len(labels) != len(self.pieces):
            raise ValueError("one label per piece")

    def at(self, place):
        """The point (d, r) at a place (piece, t)."""
        (d, r), (u, v) = self.pieces[place[0]]
        return d + place[1] * u, r + place[1] * v

    def end(self, k):
        """Parameter at the far end of piece k (0 for the first ray)."""
        return ZERO if k == 0 else ONE

    def choices(self, place):
        """Pieces that can be gone along from a place: list of (piece, t, -1 | 0 | 1), the sign t must change with."""
        k, t = place
        if t == 0 and k > 0:
            k -= 1
        elif t != self.end(k) or k == self.last:
            return [(k, t, 0)]
        return [(k, self.end(k), -1), (k + 1, ZERO, 1)]

    def room(self, k, t, rate):
        """How much t can change in the direction of `rate` before the piece ends; None without end."""
        if rate > 0:
            return None if k == self.last else self.end(k) - t
        return None if k == 0 else t

    def slope(self, k):
        """Slope of piece k; inf for vertical, -inf for a vertical drop."""
        u, v = self.pieces[k][1]
        return v / u if u else math.copysign(math.inf, v)

    def find(self, d, r=None):
        """The first place along the curve with displacement d (and push r, if given)."""
        for k, ((d0, r0), (u, v)) in enumerate(self.pieces):
            t = (d - d0) / u if u else ZERO if r is None else (r - r0) / v
            fits = d0 + t * u == d and (r is None or r0 + t * v == r)
            if fits and (t <= 0 or k > 0) and (t >= 0 or k == 0) and (t <= 1 or k in (0, self.last)):
                return k, t
        raise ValueError(f"the curve does not reach {d}")

    def work(self, d):
        """Area under the curve from its first point to displacement d."""
        total, here = ZERO, self.find(d)
        k0 = 0 if self.pieces[0][0][0] > d else 1
        for k in range(k0, here[0] + 1):
            t = here[1] if k == here[0] else self.end(k)
            (_, r), (u, v) = self.pieces[k]
            total += u * t * (r + v * t / 2)
        return total


def fractions_of(points):
    """Points of a law as pairs of fractions, beginning with (0, 0)."""
    law = [(Fraction(d), Fraction(r)) for d, r in points]
    return law if law[0] == (0, 0) else [(ZERO, ZERO), *law]


def curve_of(support):
    """The curve of a support of a scene, in (displacement to its side, push).

    Parameters
    ----------
    support : dict

    Returns
    -------
    Curve
    """
    gap = max(ZERO, Fraction(support.get("gap", 0.0)))
    if "law" not in support:
        stiffness = support.get("stiffness", math.inf)
        ray = (ZERO, ONE) if math.isinf(stiffness) else (ONE, Fraction(stiffness))
        return Curve([(gap, ZERO)], (ONE, ZERO), ray, [0, 1])
    law = fractions_of(support["law"])
    ray = (law[-1][0] - law[-2][0], law[-1][1] - law[-2][1])
    count = len(law) - 1
    if support.get("side", "both") != "both":
        points = [(d + gap, r) for d, r in law[:-1]]
        return Curve(points, (ONE, ZERO), ray, list(range(count + 1)))
    if count == 1:  # one straight line: a ray on either side of the origin
        return Curve([(ZERO, ZERO)], ray, ray, [1, 1])
    points = [(-d, -r) for d, r in law[-2:0:-1]] + law[1:-1]
    return Curve(points, ray, ray, [-k for k in range(count, 1, -1)] + list(range(1, count + 1)))


class Columns:
    """Columns of a matrix, eliminated one after the other; adding one makes a new object."""

    def __init__(self, steps=()):
        self.steps = steps

    def add(self, column):
        """The columns with one more; each step is (pivot row or None, column, [(row, factor)])."""
        column = list(column)
        used = set()
        for pivot, _, factors in self.steps:
            if pivot is None:
                continue
            used.add(pivot)
            if column[pivot]:
                for row, factor in factors:
                    column[row] -= factor * column[pivot]
        left = [row for row in range(len(column)) if row not in used and column[row]]
        if not left:
            return Columns((*self.steps, (None, column, ())))
        p = left[0]
        return Columns((*self.steps, (p, column, [(row, column[row] / column[p]) for row in left[1:]])))

    def solve(self, right):
        """The combination of the columns that gives `right`."""
        return self.add([-x for x in right]).null_lines()[0][:-1]

    def null_lines(self):
        """Basis of the null space."""
        lines = []
        for f, (pivot, column, _) in enumerate(self.steps):
            if pivot is not None:
                continue
            x, residual = [ZERO] * len(self.steps), list(column)
            x[f] = ONE
            for k in range(f - 1, -1, -1):
                p, other, _ = self.steps[k]
                if p is not None and residual[p]:
                    x[k] = -residual[p] / other[p]
                    residual = [a + x[k] * b if b else a for a, b in zip(residual, other, strict=True)]
            lines.append(x)
        return lines


def signature(matrix):
    """Numbers of negative and of zero eigenvalues of a symmetric matrix, by congruence."""
    a = [list(row) for row in matrix]
    negative = 0
    while a:
        n = len(a)
        k = next((i for i in range(n) if a[i][i]), None)
        if k is None:
            pair = next(((i, j) for i in range(n) for j in range(i) if a[i][j]), None)
            if pair is None:
                return negative, n
            i, j = pair  # add row and column j to i: the diagonal becomes 2 a_ij
            a[i] = [x + y for x, y in zip(a[i], a[j], strict=True)]
            for row in a:
                row[i] += row[j]
            continue
        negative += a[k][k] < 0
        rest = [i for i in range(n) if i != k]
        a = [[a[i][j] - a[i][k] * a[k][j] / a[k][k] for j in rest] for i in rest]
    return negative, 0
