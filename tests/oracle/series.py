"""Parts of `foundation.py`: solutions of a stretch of beam as Taylor series, and all zeros of such series.

Series are in tau = t/h, 0 <= tau <= 1 over the stretch, lowest power first.
"""

import functools
import itertools
import math
from dataclasses import dataclass

import numpy as np
from mpmath import mp, mpf

REACH = 4  # longest stretch, in units of 1/(largest modulus of the roots of its characteristic equation)


def reach(k, EI, GA, h):
    """Bound of h times the largest exponent of w' = psi + V/GA, psi' = -M/EI, M' = V, V' = k w, k >= 0."""
    return h * mp.sqrt(k / GA + mp.sqrt(k / EI))


def growth(k, EI, GA, h):
    """The largest real part of these exponents, times h."""
    shear, bending = k / GA, mp.sqrt(k / EI)
    rest = shear**2 / 4 - bending**2
    return h * (mp.sqrt(shear / 2 + mp.sqrt(rest)) if rest > 0 else mp.sqrt((bending + shear / 2) / 2))


@dataclass(frozen=True)
class Taper:
    """A stiffness that is a power of a depth which is linear from start to end, values its own there."""

    start: mpf
    end: mpf
    at_start: mpf
    at_end: mpf
    power: int

    def depth(self, x):
        """Depth, and its slope."""
        first, last = (v ** (mpf(1) / self.power) for v in (self.at_start, self.at_end))
        slope_of_it = (last - first) / (self.end - self.start)
        return first + slope_of_it * (x - self.start), slope_of_it

    def at(self, x):
        """The stiffness."""
        return self.depth(x)[0] ** self.power

    def polynomial(self, a, h):
        """From a on in steps of h."""
        depth, rise = self.depth(a)
        return [math.comb(self.power, n) * depth ** (self.power - n) * (rise * h) ** n for n in range(self.power + 1)]


class Stretch:
    """A stretch a..b with w' = psi + V/GA, psi' = -M/EI + kappa, M' = V, V' = K w + source.

    K = K[0] + K[1] t and source = sum source[m] t**m, t from a. `tapers`: those of EI and GA, None where they are constant.
    """

    def __init__(self, a, b, EI, GA, kappa, K, source, tapers=(None, None)):
        self.a, self.b, self.h = a, b, b - a
        self.EI, self.GA, self.kappa, self.K = EI, GA, kappa, K
        self.source = [c * self.h**m for m, c in enumerate(source)]
        stiffest = max(K[0], K[0] + K[1] * self.h, 0)
        self.terms = 6 if not any(K) else terms_for(float(reach(stiffest, EI, GA, self.h)), mp.dps)
        growing = [abs(t.depth(a)[1] * self.h / t.depth(a)[0]) for t in tapers if t]
        if growing:
            self.terms += int((mp.dps + 8) * mp.ln(10) / -mp.ln(max(growing))) + 12
        self.stiff = [t.polynomial(a, self.h) if t else None for t in tapers]

    def series(self, y, loaded=True):
        """Series of w, psi, M and V that begin with y at a."""
        h, K0, K1 = self.h, self.K[0], self.K[1] * self.h
        shear, flex = h / self.GA, -h / self.EI
        W, P, M, V = ([v] for v in y)
        bent, slid = [], []  # psi' and V/GA, in parts of h, where EI and GA change: EI psi' = -M
        for m in range(self.terms):
            n = m + 1
            w, p = h * P[m], flex * M[m] if M[m] else mpf(0)
            if self.stiff[0]:
                bent.append(divided(-M[m], self.stiff[0], bent))
                p = h * bent[m]
            if self.stiff[1]:
                slid.append(divided(V[m], self.stiff[1], slid))
                w += h * slid[m]
            elif shear:
                w += shear * V[m]
            if not m and loaded and self.kappa:
                p += h * self.kappa
            load = K0 * W[m] if W[m] and K0 else mpf(0)
            if m and K1:
                load += K1 * W[m - 1]
            if loaded and m < len(self.source):
                load += self.source[m]
            for column, v in ((W, w), (P, p), (M, h * V[m] if V[m] else mpf(0)), (V, h * load)):
                column.append(v / n if v else v)
        return W, P, M, V

    @functools.cached_property
    def transfer(self):
        """(matrix, rest): y(b) = matrix y(a) + rest."""
        unit = [[mpf(i == j) for i in range(4)] for j in range(4)]
        columns = [[mp.fsum(s) for s in self.series(y, loaded=False)] for y in unit]
        rest = [mp.fsum(s) for s in self.series([mpf(0)] * 4)]
        return list(zip(*columns, strict=True)), rest


def divided(term, polynomial, before):
    """The next term of a quotient by a polynomial, from those before."""
    return (term - mp.fsum(c * before[-n] for n, c in enumerate(polynomial[1 : len(before) + 1], 1))) / polynomial[0]


@functools.cache
def terms_for(x, digits):
    """Terms after which those of exp(x) are below 10**-digits."""
    n, size, target = 0, 0.0, -(digits + 8) * math.log(10)
    while n < 2 * x + 8 or size > target:
        n += 1
        size += math.log(max(x, 1e-300)) - math.log(n)
    return n + 3


def value(series, tau):
    """Value of a series."""
    result = mpf(0)
    for c in reversed(series):
        result = result * tau + c
    return result


def slope(series):
    """Derivative of a series by tau."""
    return [m * c for m, c in enumerate(series)][1:] or [mpf(0)]


def zeros(series, signs=None, tiny=0):
    """All zeros in 0..1, ascending, and the places where it only touches zero or may do so.

    Parameters
    ----------
    series : list of mpf
    signs : (bool, bool), optional
        Whether the value counts as positive at 0 and at 1.
    tiny : mpf
        Values at extremes up to this size count as touching: no zero there.
    """
    known = dict(zip((mpf(0), mpf(1)), signs, strict=True)) if signs else {}
    found, touching = [], []
    derivative = slope(series)

    def positive(tau):
        if tau not in known:
            known[tau] = value(series, tau) > 0
        return known[tau]

    for low, high, kind in parts(series):
        ends = [low, high]
        if kind == "doubt":
            touching.append(low)
        elif kind == "one extreme" and (value(derivative, low) > 0) != (value(derivative, high) > 0):
            top = bisected(derivative, low, high)
            ends = [low, top, high]
            if abs(value(series, top)) <= tiny:
                touching.append(top)
                known[top] = positive(low)
        for p, q in itertools.pairwise(ends):
            if positive(p) != positive(q):
                found.append(bisected(series, p, q))
    return sorted(found), touching


def parts(series):
    """Parts of 0..1 that together hold all zeros, each with at most one extreme; decided in doubles, with room."""
    largest = max(map(abs, series))
    if not largest:
        return
    a = np.array([float(c / largest) for c in series])
    keep = np.flatnonzero(np.abs(a) > 1e-19)[-1] + 1
    half = shift(keep, 0.5)
    stack = [(0, 0, half @ a[:keep])]
    noise = 1e-12 * max(1.0, np.abs(stack[0][2]).sum())
    left, right = shift(keep, -0.5), shift(keep, 0.5)
    steps = np.arange(1, keep)
    while stack:
        depth, place, b = stack.pop()
        low, high = mpf(place) / 2**depth, mpf(place + 1) / 2**depth
        first = b[1:] * steps
        second = first[1:] * steps[:-1]
        if definite(b, noise):
            continue
        if definite(first, noise * keep / 2**depth):
            yield low, high, "monotone"
        elif definite(second, noise * keep**2 / 4**depth):
            yield low, high, "one extreme"
        elif depth == 40:
            yield low, high, "doubt"
        else:
            stack += [(depth + 1, 2 * place, left @ b), (depth + 1, 2 * place + 1, right @ b)]


def definite(b, noise):
    """Whether a series about the middle of an interval, -1..1, surely has no zero there."""
    return len(b) > 0 and abs(b[0]) > np.abs(b[1:]).sum() + noise


@functools.cache
def shift(n, by):
    """Matrix that turns a series in x into one in y, x = by + y/2."""
    return np.array(
        [[math.comb(j, i) * by ** (j - i) * 0.5**i if j >= i else 0.0 for j in range(n)] for i in range(n)]
    )


def bisected(series, low, high):
    """The zero between two places with values of unlike sign: Newton's rule, halving where that leaves the interval."""
    size = mp.fsum(map(abs, series)) * mpf(10) ** (8 - mp.dps)
    at_low, at_high = value(series, low), value(series, high)
    for end, v in ((low, at_low), (high, at_high)):
        if abs(v) <= size:
            return end
    if (at_low > 0) == (at_high > 0):
        return low if abs(at_low) < abs(at_high) else high
    derivative, rising = slope(series), at_high > 0
    x = low + (high - low) * at_low / (at_low - at_high)
    for _ in range(4 * mp.dps):
        v, d = value(series, x), value(derivative, x)
        if abs(v) <= size * mpf(10) ** -4:
            break
        low, high = (low, x) if (v > 0) == rising else (x, high)
        new = x - v / d if d else low
        x, step = (new, abs(new - x)) if low < new < high else ((low + high) / 2, high - low)
        if step < mpf(10) ** (6 - mp.dps):
            break
    return x
