"""Exact envelopes of a train that passes: the largest and smallest values over all its places, for `trains.py`.

Between two events every value is a polynomial in the place s, so that its extremes are at the ends and where its
derivative vanishes. Moment and shear over the whole beam: at breakpoints, on both sides of axles, at the ends of the train's
load, and where the shear vanishes, x = X + V/q, M + V^2/(2 q). Deflection over x and s: cells of the (x, s) plane are halved
until none can hold more than the best value by `CERTAIN`, bounded by Bernstein's coefficients.

Examples
--------
>>> from oracle.trains import Passage
>>> scene = {"beam": {"spans": [2.0], "EI": 1.0}, "supports": [{"node": 0}, {"node": 1}], "loads": []}
>>> passage = Passage(scene, {"axles": [[0.0, 3.0]]}, at=[1.0])
>>> float(curve(passage, "moment", 1.0)["max"].value), float(extremes(passage, "moment")["max"].places[0].x)
(1.5, 1.0)
"""

import heapq
import itertools
from dataclasses import dataclass
from fractions import Fraction
from math import comb

from .polynomials import add, bernstein, derivative, halves, multiply, roots, scale, trimmed, value
from .trains import ONE, SIDES, ZERO, advanced

EQUAL = Fraction(1, 10**35)  # values closer than this, relatively, are ties
CERTAIN = 1e-13  # of the largest deflection over x and s, relative to all of them
COMPONENT = {"deflection": 0, "rotation": 1, "moment": 2, "shear": 3}


@dataclass
class Where:
    """Place of the train and of the value, right to 40 digits (deflections over x and s: to 6)."""

    position: Fraction
    x: Fraction
    mirrored: bool


class Extreme:
    """The largest value (sign 1) or the smallest (-1), and the places where it is reached; value None: there is none.

    A value that stays the same along a stretch is listed at both ends.
    """

    def __init__(self, sign):
        self.sign, self.value, self.places = sign, None, []

    def offer(self, found, where):
        """Take note of a value."""
        margin = EQUAL * max(abs(found), ONE / 10**6)
        if self.value is None or self.sign * (found - self.value) > margin:
            self.value, self.places = found, [where]
        elif abs(found - self.value) <= margin:
            apart = (abs(w.position - where.position) + abs(w.x - where.x) for w in self.places if w.mirrored == where.mirrored)
            if all(distance > EQUAL for distance in apart):
                self.places.append(where)

    def hopeless(self, bounds):
        """Whether no value within the bounds could count."""
        if self.value is None:
            return False
        best = max(self.sign * b for b in bounds)
        return self.sign * float(self.value) > best + 1e-9 * (abs(best) + abs(float(self.value)))


def pair():
    """Nothing found yet."""
    return {"max": Extreme(1), "min": Extreme(-1)}


def merged(*pairs):
    """The extremes of several passages together."""
    found = pair()
    for one, name in itertools.product(pairs, found):
        for where in one[name].places:
            found[name].offer(one[name].value, where)
    return found


def extremes_of(passage, candidates):
    """Extremes of polynomials.

    Parameters
    ----------
    passage : Passage
    candidates : iterable of (polynomial, Stretch, polynomial, function or None)
        The value and its x over s; whether a stationary place counts (None: the ends count, too).

    Returns
    -------
    dict
        Extremes "max" and "min".
    """
    found = pair()
    for p, stretch, x, counts in candidates:
        bounds = [float(c) for c in bernstein(p, *stretch.home)]
        wanted = [extreme for extreme in found.values() if not extreme.hopeless(bounds)]
        if not wanted:
            continue
        slope = trimmed(derivative(p))
        flat = roots(slope, *stretch.home) if len(slope) > 1 else []
        places = [] if counts else [stretch.start, stretch.end]
        places += [r for r, _ in flat if stretch.start < r and r < stretch.end]
        for s in (place.middle for place in places):
            if not counts or counts(s):
                for extreme in wanted:
                    extreme.offer(value(p, s), Where(s, value(x, s), passage.mirrored))
    return found


def solved(passage, forces=False):
    """Stretches with a unique state; `forces`: and those where forces alone are unique, a motion being free without work."""
    return (s for s in passage.stretches if s.status == "solved" or (forces and s.status == "loose" and s.unknowns))


def reaction(passage, i):
    """Extremes of the force of support i."""
    x, column = [passage.supports[i]["x"]], passage.force_column + i
    return extremes_of(passage, ((s.unknowns[column], s, x, None) for s in solved(passage, True)))


def opening(passage, i):
    """Extremes of the opening of one-sided support i; 0 where it acts."""
    x, k = passage.supports[i]["x"], passage.points.index(passage.supports[i]["x"])

    def polynomial(s):
        if s.state[i] != "open":
            return [ZERO]
        w = passage.polynomial(s.unknowns, s.moving, k, "left", 0)
        return scale(Fraction(passage.sign(i)), add([passage.acting_level(i)], scale(-ONE, w)))

    return extremes_of(passage, ((polynomial(s), s, [x], None) for s in solved(passage)))


def curve(passage, name, x):
    """Extremes of "deflection", "rotation", "moment" or "shear" at one of the places the passage was made for."""
    k = passage.points.index(passage.exact_x(x))
    return extremes_of(
        passage,
        (
            (passage.polynomial(s.unknowns, s.moving, k, side, COMPONENT[name]), s, [passage.exact_x(x)], None)
            for s in solved(passage, name in ("moment", "shear"))
            for side in SIDES
        ),
    )


@dataclass
class Part:
    """A part of the beam between a breakpoint, an axle or an end of the train's load, and the next.

    Polynomials in s: its beginning x, its length h, (w, psi, M, V) at both ends; numbers: q, kappa, 1/EI, 1/GA.
    """

    x: list
    h: list
    begin: list
    end: list
    q: Fraction
    kappa: Fraction
    f: Fraction
    g: Fraction


def parts(passage, stretch):
    """Parts of the beam on one stretch, from left to right."""
    m, fixed = stretch.inside, stretch.home[0] == stretch.home[1]

    def position(e):
        return [m + e] if fixed else [e, ONE]

    marks = [(m + e, position(e), P) for e, P in passage.axles]
    marks += [(m + e, position(e), ZERO) for e in (ZERO, passage.tail) if passage.q]
    low, high = sorted((m, m + passage.tail))
    for k, (x, end) in enumerate(itertools.pairwise(passage.points)):
        f, g, loads = passage.pieces[k]
        if any(slope for _, _, slope, _ in loads):
            raise ValueError("extremes over x are found under uniform loads only")
        static, kappa = sum(load[1] for load in loads), sum(load[3] for load in loads)
        state = [passage.polynomial(stretch.unknowns, stretch.moving, k, "right", c) for c in range(4)]
        inside = sorted(mark for mark in marks if x < mark[0] < end)
        for before, after in itertools.pairwise([(x, [x], ZERO), *inside, (end, [end], ZERO)]):
            covered = low <= before[0] and after[0] <= high and low < high
            q = Fraction(static + (passage.q if covered else 0))
            state = [*state[:3], add(state[3], [-before[2]])]
            h = add(after[1], scale(-ONE, before[1]))
            found = Part(before[1], h, state, advanced(state, h, f, g, q, Fraction(kappa)), q, Fraction(kappa), f, g)
            yield found
            state = found.end


def extremes(passage, name):
    """Extremes of "moment" or "shear" over all x and s."""
    return extremes_of(passage, candidates(passage, COMPONENT[name], name == "moment"))


def candidates(passage, component, stationary):
    """What `extremes_of` looks at: both ends of every part, and moments where the shear vanishes between."""
    for stretch in solved(passage, True):
        for part in parts(passage, stretch):
            if any(value(part.h, s.middle) > 0 for s in (stretch.start, stretch.end)):
                yield part.begin[component], stretch, part.x, None
                yield part.end[component], stretch, add(part.x, part.h), None
            if stationary and part.q:
                distance = scale(1 / part.q, part.begin[3])
                peak = add(part.begin[2], scale(1 / (2 * part.q), multiply(part.begin[3], part.begin[3])))
                yield peak, stretch, add(part.x, distance), within(distance, part.h)
                for end in (stretch.start.middle, stretch.end.middle):
                    if within(distance, part.h)(end):
                        yield [value(peak, end)], Fixed(stretch, end), add(part.x, distance), None


def within(distance, length):
    """Whether 0 <= distance <= length at a place."""
    return lambda s: 0 <= value(distance, s) <= value(length, s)


class Fixed:
    """One end of a stretch as a stretch of its own."""

    def __init__(self, stretch, s):
        self.start = self.end = stretch.start if s == stretch.start.middle else stretch.end
        self.home = (s, s)


def deflection(passage):
    """Extremes of the deflection over all x and s, certain to `CERTAIN`; places to about 6 digits."""
    cells = []
    for stretch in solved(passage):
        low, high = stretch.start.low, stretch.end.high
        for part in parts(passage, stretch):
            w, psi, M, V = part.begin
            squared = multiply(part.h, part.h)
            powers = [
                w,
                multiply(add(psi, scale(part.g, V)), part.h),
                multiply(add(scale(-part.f / 2, M), [(part.kappa - part.g * part.q) / 2]), squared),
                scale(-part.f / 6, multiply(multiply(V, part.h), squared)),
                scale(part.q * part.f / 24, multiply(squared, squared)),
            ]
            size = max(map(len, powers))
            rows = [bernstein(p + [ZERO] * (size - len(p)), low, high) for p in powers]
            grid = [[float(sum(comb(i, k) * rows[k][j] / comb(4, k) for k in range(i + 1))) for j in range(size)] for i in range(5)]
            cells.append((grid, (0.0, 1.0), (float(low), float(high)), part))
    return {name: certain(passage, cells, sign) for name, sign in (("max", 1), ("min", -1))}


def certain(passage, cells, sign):
    """The largest of sign times the polynomials of the cells, by halving the one with the largest bound."""
    found, order = Extreme(sign), itertools.count()
    size = max((abs(c) for grid, *_ in cells for row in grid for c in row), default=0.0)
    heap = []

    def push(grid, t, s, part):
        for i, j in itertools.product((0, -1), repeat=2):
            height = Fraction(grid[i][j])
            if found.value is None or sign * (height - found.value) > 0:
                place = Fraction(s[j])
                x = value(part.x, place) + Fraction(t[i]) * value(part.h, place)
                found.value, found.places = height, [Where(place, x, passage.mirrored)]
        heapq.heappush(heap, (-max(sign * c for row in grid for c in row), next(order), grid, t, s, part))

    for cell in cells:
        push(*cell)
    while heap and -heap[0][0] > sign * float(found.value) + CERTAIN * size:
        _, _, grid, t, s, part = heapq.heappop(heap)
        along = max((abs(a - b) for row in grid for a, b in itertools.pairwise(row)), default=0.0)
        across = max(abs(a - b) for upper, lower in itertools.pairwise(grid) for a, b in zip(upper, lower, strict=True))
        if along > across:
            both, middle = [halves(row) for row in grid], (s[0] + s[1]) / 2
            push([b[0] for b in both], t, (s[0], middle), part)
            push([b[1] for b in both], t, (middle, s[1]), part)
        else:
            both, middle = [halves(column) for column in zip(*grid, strict=True)], (t[0] + t[1]) / 2
            push([list(r) for r in zip(*(b[0] for b in both), strict=True)], (t[0], middle), s, part)
            push([list(r) for r in zip(*(b[1] for b in both), strict=True)], (middle, t[1]), s, part)
    return found
