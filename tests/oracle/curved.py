"""Beams on ground whose laws have parameters, curves among them; many digits, written apart from the engine.

Shooting from place to place: the fields w, psi, M and V right of all places, the places at which laws have kinks, and the reactions
of rigid supports are the unknowns. Gragg's rule, extrapolated, in mpmath's numbers goes from one place to the next; Newton's
method, its derivatives by complex steps in doubles, finds the unknowns from a rough guess. The energy is convex, so what it finds
is the only solution if signs are right: `check_signs`.

Scenes have one span with constant EI and GA, forces, moments, uniform loads and supports that hold both ways.
"""

import cmath
import math

import mpmath
import numpy as np
from mpmath import mpf

ROWS = 12
"""Of the extrapolation: an error of order 24."""
LOST = 10**6
"""Roundings that the extrapolation may differ by in its last step."""
SIDES = {"below": (1,), "above": (-1,), "both": (1, -1)}


class Curved:
    """A solution.

    Parameters
    ----------
    scene : dict
        As for gapbeam, the load factor 1.
    guess : callable
        w, psi, M, V right of a place, or near it.
    kinks : list of (float, int, int, int)
        Places of kinks, the foundation, its side there (1 below), and the kink (0: contact, 1: limit), in rising order.
    digits : int
        Decimal digits.
    """

    def __init__(self, scene, guess, kinks, digits=24):
        self.scene, self.kinks, self.digits = scene, kinks, digits
        self.EI, self.GA = scene["beam"]["EI"], scene["beam"].get("GA", math.inf)
        self.end = scene["beam"]["spans"][0]
        self.supports = scene.get("supports", [])
        self.rigid = [s for s in self.supports if "stiffness" not in s]
        fixed = {0.0, self.end}
        for item in [*scene["loads"], *self.supports, *scene["foundation"]]:
            fixed |= {item[key] for key in ("x", "from", "to") if key in item}
        marks = sorted(fixed | {x for x, *_ in kinks})
        k = max(stiffest(ground) for ground in scene["foundation"])
        longest = 0.35 * (4 * self.EI / k) ** 0.25
        self.base = [marks[0]]
        for right in marks[1:]:
            left = self.base[-1]
            parts = max(1, math.ceil((right - left) / longest))
            self.base += [left + (right - left) * i / parts for i in range(1, parts)] + [right]
        self.at_kink = {self.base.index(kink[0]): kink for kink in kinks}
        middles = [(a + b) / 2 for a, b in zip(self.base[:-1], self.base[1:], strict=True)]
        self.acting = [self.pieces(x, float(guess(x)[0])) for x in middles]
        with mpmath.workdps(digits + 6):
            even = [load for load in scene["loads"] if load["type"] == "uniform"]
            self.load = [mpmath.fsum(load["q"] for load in even if within(load, x, self.end)) for x in middles]
            self.unknowns = [mpf(float(v)) for x in self.base[:-1] for v in guess(x)]
            self.unknowns += [mpf(kink[0]) for kink in kinks] + [mpf(0)] * len(self.rigid)
            self.newton()

    def split(self, unknowns):
        """Places, fields right of them, reactions of rigid supports."""
        n = len(self.base) - 1
        places = [x if isinstance(unknowns[0], complex) else mpf(x) for x in self.base]
        for at, x in zip(sorted(self.at_kink), unknowns[4 * n :], strict=False):
            places[at] = x
        return places, [unknowns[4 * i : 4 * i + 4] for i in range(n)], unknowns[4 * n + len(self.at_kink) :]

    def pieces(self, x, w):
        """(foundation, side, piece of its law) of all that acts at a place."""
        found = []
        for which, ground in enumerate(self.scene["foundation"]):
            for side in SIDES[ground["side"]]:
                u = side * w - ground.get("gap", 0.0)
                if within(ground, x, self.end) and u > 0:
                    law = ground["law"]
                    bilinear = law["type"] in ("plastic", "hardening")
                    beyond = bilinear and self.parameter(ground, "stiffness", x) * u > self.parameter(ground, "limit", x)
                    found.append((which, side, 1 + beyond))
        return found

    def parameter(self, ground, key, x):
        """A parameter of the law of a foundation at a place."""
        value = ground["law"].get(key, 0.0)
        if not isinstance(value, (tuple, list)):
            return value
        a, b = ground.get("from", 0.0), ground.get("to", self.end)
        return value[0] + (value[1] - value[0]) * ((x - a) / (b - a))

    def force(self, which, side, piece, x, w):
        """Force of a foundation per length, up."""
        ground = self.scene["foundation"][which]
        u = side * w - ground.get("gap", 0.0)
        kind = ground["law"]["type"]
        if kind == "cubic":
            k1, k2, k3 = (self.parameter(ground, key, x) for key in ("k1", "k2", "k3"))
            return side * (u * (k1 + u * (k2 + u * k3)))
        k, limit = self.parameter(ground, "stiffness", x), self.parameter(ground, "limit", x)
        if kind in ("plastic", "hardening"):
            if piece == 1:
                return side * k * u
            slope = self.parameter(ground, "slope", x)
            return side * (limit + slope * (u - limit / k)) if kind == "hardening" else side * limit
        if limit == 0:
            return 0 * u
        if kind == "hyperbolic":
            return side * k * u / (1 + k * u / limit)
        return side * limit * (mpmath.tanh if isinstance(u, mpf) else cmath.tanh)(k * u / limit)

    def slope(self, i, x, y):
        """Derivatives of w, psi, M, V in a part."""
        pressure = sum(self.force(*acting, x, y[0]) for acting in self.acting[i])
        shear = y[3] / self.GA if math.inf > self.GA else 0.0
        return [y[1] + shear, -y[2] / self.EI, y[3], pressure - (self.load[i] if isinstance(x, mpf) else float(self.load[i]))]

    def jump(self, i, y, reactions):
        """Fields right of a place from those left of it, and by what rigid supports there are missed."""
        y, missed, x = list(y), [], self.base[i]
        for item in self.scene["loads"]:
            if item.get("x") == x:
                y[3 if item["type"] == "force" else 2] += item["M"] if item["type"] == "moment" else -item["F"]
        for support in self.supports:
            if support["x"] == x:
                y[3] += support["stiffness"] * y[0] if "stiffness" in support else reactions[self.rigid.index(support)]
                missed += [y[0]] if "stiffness" not in support else []
        return y, missed

    def residual(self, unknowns, ends):
        """What is not zero yet."""
        places, state, reactions = self.split(unknowns)
        found = []
        for i in range(len(places)):
            before = [*state[0][:2], 0.0, 0.0] if i == 0 else ends[i - 1]
            y, missed = self.jump(i, before, reactions)
            found += missed
            if i == len(places) - 1:
                return [*found, y[2], y[3]]
            found += [state[i][n] - y[n] for n in ((2, 3) if i == 0 else range(4))]
            if i in self.at_kink:
                _, which, side, kink = self.at_kink[i]
                ground = self.scene["foundation"][which]
                u = side * before[0] - ground.get("gap", 0.0)
                k, limit = (self.parameter(ground, key, places[i]) for key in ("stiffness", "limit"))
                found.append(k * u - limit if kink else u)
        return found

    def newton(self):
        """Newton's method with derivatives that stay."""
        n = len(self.base) - 1
        floats = [complex(v) for v in self.unknowns]
        places, state, _ = self.split(floats)
        ends = [self.rough(i, places, state[i]) for i in range(n)]
        columns = []
        for j in range(len(floats)):
            moved = list(floats)
            moved[j] += 1e-30j
            places, state, _ = self.split(moved)
            at = sorted(self.at_kink)[j - 4 * n] if 4 * n <= j < 4 * n + len(self.at_kink) else None
            touched = {j // 4} if j < 4 * n else {at - 1, at} if at is not None else set()
            now = [self.rough(i, places, state[i]) if i in touched else ends[i] for i in range(n)]
            columns.append([complex(r).imag / 1e-30 for r in self.residual(moved, now)])
        matrix = np.array(columns).T
        rows = 1 / np.maximum(np.abs(matrix).max(axis=1), 1e-300)
        scaled = np.linalg.inv(matrix * rows[:, None])
        for _ in range(40):
            places, state, _ = self.split(self.unknowns)
            self.ends = [extrapolated(lambda x, y, i=i: self.slope(i, x, y), state[i], places[i], places[i + 1]) for i in range(n)]
            rest = self.residual(self.unknowns, self.ends)
            size = max(abs(r) * row for r, row in zip(rest, rows, strict=True)) or mpf(1)
            change = scaled @ np.array([float(r * row / size) for r, row in zip(rest, rows, strict=True)])
            self.unknowns = [v - size * mpf(c) for v, c in zip(self.unknowns, change.tolist(), strict=True)]
            largest = [max(abs(v) for v in self.unknowns[k : 4 * n : 4]) for k in range(4)]
            if all(abs(size * change[k : 4 * n : 4]).max() <= largest[k] * mpf(10) ** -self.digits for k in range(4)):
                self.places, self.state, self.reactions = self.split(self.unknowns)
                return
        raise ArithmeticError("not settled")

    def rough(self, i, places, y, steps=6):
        """Fields at the end of a part in doubles (Runge and Kutta)."""
        h = (places[i + 1] - places[i]) / steps
        for k in range(steps):
            x = places[i] + k * h
            a = self.slope(i, x, y)
            b = self.slope(i, x + h / 2, [v + h / 2 * d for v, d in zip(y, a, strict=True)])
            c = self.slope(i, x + h / 2, [v + h / 2 * d for v, d in zip(y, b, strict=True)])
            d = self.slope(i, x + h, [v + h * d for v, d in zip(y, c, strict=True)])
            y = [v + h / 6 * (p + 2 * q + 2 * r + s) for v, p, q, r, s in zip(y, a, b, c, d, strict=True)]
        return y

    def at(self, x):
        """w, psi, M, V right of a place, at the right end left of it."""
        with mpmath.workdps(self.digits + 6):
            if x >= self.end:
                return self.ends[-1]
            i = max(k for k, a in enumerate(self.places[:-1]) if a <= x)
            return extrapolated(lambda s, y: self.slope(i, s, y), self.state[i], self.places[i], mpf(x))

    def check_signs(self):
        """Whether every law is on the piece that was assumed, in all parts."""
        middles = [(a + b) / 2 for a, b in zip(self.places[:-1], self.places[1:], strict=True)]
        return all(self.pieces(x, self.at(x)[0]) == acting for x, acting in zip(middles, self.acting, strict=True))


def extrapolated(slope, y, a, b):
    """Solve y' = slope(x, y) from a to b: Gragg's midpoint rule, extrapolated in the square of the step; in halves if need be."""
    table = []
    for row in range(1, ROWS + 1):
        n = 2 * row
        h = (b - a) / n
        last, now = y, [v + h * d for v, d in zip(y, slope(a, y), strict=True)]
        for k in range(1, n):
            last, now = now, [v + 2 * h * d for v, d in zip(last, slope(a + k * h, now), strict=True)]
        new = [[(p + q + h * d) / 2 for p, q, d in zip(now, last, slope(b, now), strict=True)]]
        for j in range(1, row):
            ratio = mpf(row) / (row - j)
            share = 1 / (ratio * ratio - 1)
            new.append([p + (p - q) * share for p, q in zip(new[j - 1], table[j - 1], strict=True)])
        table = new
    if any(abs(p - q) > LOST * mpmath.eps * (abs(p) + abs(v)) for p, q, v in zip(table[-1], table[-2], y, strict=True)):
        middle = (a + b) / 2
        return extrapolated(slope, extrapolated(slope, y, a, middle), middle, b)
    return table[-1]


def within(item, x, end):
    """Whether a place lies inside a stretch."""
    return item.get("from", 0.0) < x < item.get("to", end)


def stiffest(ground):
    """The greatest stiffness of a law at first."""
    value = ground["law"].get("stiffness", ground["law"].get("k1"))
    return 3 * max(value) if isinstance(value, (tuple, list)) else 3 * value
