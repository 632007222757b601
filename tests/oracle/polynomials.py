"""Polynomials with rational coefficients, and their real roots without doubt, for the reference solution of trains.

A polynomial is a list of fractions, the constant first. A root is a `Place`: a bracket as narrow as one likes, and the
polynomial that changes its sign there, so that two places can be told apart, or proved equal, without a tolerance.
Roots are isolated by the rule of signs in Bernstein's basis: no change, no root; one change, one root.
"""

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import comb, lcm

BITS = 150  # a bracket is this many times halved: 45 digits


def add(*polynomials):
    """Sum of polynomials."""
    size = max(map(len, polynomials))
    return [sum(p[k] for p in polynomials if k < len(p)) for k in range(size)]


def scale(factor, p):
    """A number times a polynomial."""
    return [factor * c for c in p]


def multiply(p, q):
    """Product of two polynomials."""
    product = [Fraction(0)] * (len(p) + len(q) - 1)
    for i, a in enumerate(p):
        if a:
            for j, b in enumerate(q):
                product[i + j] += a * b
    return product


def value(p, x):
    """p(x)."""
    total = Fraction(0)
    for c in reversed(p):
        total = total * x + c
    return total


def derivative(p):
    """p'."""
    return [k * c for k, c in enumerate(p)][1:] or [Fraction(0)]


def trimmed(p):
    """Without leading zeros."""
    size = len(p)
    while size and not p[size - 1]:
        size -= 1
    return p[:size]


def divide(p, q):
    """Quotient and remainder."""
    p, q = list(p), trimmed(q)
    quotient = [Fraction(0)] * max(len(p) - len(q) + 1, 1)
    for k in range(len(p) - len(q), -1, -1):
        quotient[k] = p[k + len(q) - 1] / q[-1]
        for j, c in enumerate(q):
            p[k + j] -= quotient[k] * c
    return quotient, trimmed(p)


def common(p, q):
    """Greatest common divisor, with leading coefficient 1."""
    p, q = trimmed(p), trimmed(q)
    while q:
        p, q = q, divide(p, q)[1]
        q = scale(1 / q[-1], q) if q else q
    return scale(1 / p[-1], p)


def bernstein(p, a, b):
    """Coefficients of p in Bernstein's basis on a..b."""
    shifted = list(p)
    for start in range(len(p) - 1):
        for k in range(len(p) - 2, start - 1, -1):
            shifted[k] += a * shifted[k + 1]
    n, width = len(p) - 1, b - a
    shifted = [c * width**k / comb(n, k) for k, c in enumerate(shifted)]
    return [sum(comb(i, k) * shifted[k] for k in range(i + 1)) for i in range(n + 1)]


def changes(coefficients):
    """Number of changes of sign; zeros do not count."""
    signs = [c > 0 for c in coefficients if c]
    return sum(x != y for x, y in pairwise(signs))


def halves(coefficients):
    """Bernstein's coefficients on both halves (de Casteljau)."""
    left, right, row = [], [], list(coefficients)
    while row:
        left.append(row[0])
        right.append(row[-1])
        row = [(x + y) / 2 for x, y in pairwise(row)]
    return left, right[::-1]


@dataclass
class Place:
    """A real number between `low` and `high`, the only root of p there (a simple one), or equal to both.

    Examples
    --------
    >>> two = Place.exact(2)
    >>> [(root, multiplicity)] = roots([Fraction(-2), Fraction(0), Fraction(1)], Fraction(1), Fraction(2))
    >>> float(root), root < two, root.same(two)
    (1.4142135623730951, True, False)
    """

    low: Fraction
    high: Fraction
    p: list

    @classmethod
    def exact(cls, x):
        """A rational number."""
        return cls(Fraction(x), Fraction(x), [-Fraction(x), Fraction(1)])

    @property
    def middle(self):
        """A fraction within 45 digits."""
        return (self.low + self.high) / 2

    def __float__(self):
        return float(self.middle)

    def narrow(self, times):
        """Halve the bracket."""
        if self.low == self.high:
            return
        whole = lcm(*(c.denominator for c in self.p))
        integers = [int(c * whole) for c in self.p]
        denominator = lcm(self.low.denominator, self.high.denominator)
        low, high = int(self.low * denominator), int(self.high * denominator)

        def sign(x):
            total, power = 0, 1
            for c in reversed(integers):
                total, power = total * x + c * power, power * denominator
            return (total > 0) - (total < 0)

        upper = sign(high)
        if upper == 0:
            upper = -sign(low) or 1 if sign(low) else self.slope_sign()
        for _ in range(times):
            low, high, denominator = 2 * low, 2 * high, 2 * denominator
            middle = (low + high) // 2
            found = sign(middle)
            if found == 0:
                low = high = middle
                break
            low, high = (low, middle) if found == upper else (middle, high)
        self.low, self.high = Fraction(low, denominator), Fraction(high, denominator)

    def slope_sign(self):
        """Sign of p just left of `high`, which is another root of p."""
        return -1 if next(c for c in reversed(bernstein(self.p, self.low, self.high)) if c) < 0 else 1

    def same(self, other):
        """Whether two places are equal, proved."""
        while True:
            low, high = max(self.low, other.low), min(self.high, other.high)
            if low > high:
                return False
            if self.low == self.high and other.low == other.high:
                return True
            shared = common(self.p, other.p)
            if len(shared) == 1:
                return False
            ends = value(shared, low), value(shared, high)
            if low == high:
                return ends[0] == 0
            if ends[0] * ends[1] < 0:
                return True
            self.narrow(20)
            other.narrow(20)

    def __lt__(self, other):
        if self.high < other.low:
            return True
        if other.high < self.low or self.same(other):
            return False
        while True:
            if self.high <= other.low:
                return True
            if other.high <= self.low:
                return False
            self.narrow(20)
            other.narrow(20)


def isolate(p, coefficients, a, b):
    """Places of the roots between a and b, ends excluded, of a polynomial without multiple roots there."""
    count = changes(coefficients)
    if count == 0:
        return []
    if count == 1:
        found = Place(a, b, p)
        found.narrow(BITS)
        return [found]
    middle = (a + b) / 2
    left, right = halves(coefficients)
    at_middle = [Place.exact(middle)] if left[-1] == 0 else []
    return isolate(p, left, a, middle) + at_middle + isolate(p, right, middle, b)


def roots(p, a, b):
    """Roots between a and b, ends excluded, in order, each with its multiplicity.

    Parameters
    ----------
    p : list of Fraction
        Not zero everywhere.
    a, b : Fraction

    Returns
    -------
    list of (Place, int)
    """
    p = trimmed(p)
    coefficients = bernstein(p, a, b)
    if changes(coefficients) < 2:
        return [(place, 1) for place in isolate(p, coefficients, a, b)]
    found, multiplicity = [], 1
    rest = common(p, derivative(p))
    simple = divide(p, rest)[0]  # every root once
    while len(trimmed(simple)) > 1:
        further = common(simple, rest)  # those with a higher multiplicity
        factor = divide(simple, further)[0]
        found += [(place, multiplicity) for place in isolate(factor, bernstein(factor, a, b), a, b)]
        simple, rest, multiplicity = further, divide(rest, further)[0], multiplicity + 1
    return sorted(found, key=lambda item: item[0].middle)


def between(start, end):
    """A short rational number well between two places."""
    low, high = start.high, end.low
    for digits in (8, 2**10, 2**20, 2**40, 2**80):
        guess = Fraction(round((low + high) / 2 * digits), digits)
        if low < guess < high and min(guess - low, high - guess) * 8 > high - low:
            return guess
    return (low + high) / 2
