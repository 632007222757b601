"""Beams under a given axial force, read and cut into short cells that the state (w, psi, M, T) crosses; see `axial_force`."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import mpmath as mp

from .winkler import taper

DIGITS = 90
REACH = 16  # a cell is at most so many lengths of decay long
GENTLE = 4  # and tapers by no more than one part in so many
SIDES = {"below": 1, "above": -1, "both": 0}


@dataclass(frozen=True)
class Cell:
    """A short part of the beam; k, q and kappa are (value at its left end, slope)."""

    a: mp.mpf
    h: mp.mpf
    EI: mp.mpf
    GA: mp.mpf
    N: mp.mpf  # with the second parameter of the ground
    k: tuple  # less mass times omega^2
    q: tuple
    kappa: tuple
    growth: mp.mpf = 0  # of the depth over the cell, in parts of that at its left end, where EI is given
    power: int = 0  # of the depth in EI

    def terms(self, start, q, kappa):
        """Taylor coefficients of w, psi, M, T and w' in t = (x - a)/h as integers, and what one of them is worth in each."""
        h, B = self.h, self.EI
        if mp.isinf(B):
            B = abs(self.N) * h**2 or mp.mpf(1)
        bits, s = 3 * mp.mp.prec // 2 + 64, 1 + self.N / self.GA
        units = (mp.mpf(1), 1 / h, B / h**2, B / h**3, 1 / h)
        first = [v / unit for v, unit in zip(start, units, strict=False)]
        loads = [[q[0] * h**4 / B, kappa[0] * h**2], [q[1] * h**5 / B, kappa[1] * h**3]]
        shift = mp.mag(max(map(abs, (*first, *loads[0], *loads[1]))) or mp.mpf(1))

        def whole(value, power):
            return int(mp.ldexp(value, bits - power))

        turn, slip, grows = (whole(v, 0) for v in (1 / s, B / (self.GA * h**2 * s), self.growth))
        soft = [whole(B / self.EI, 0)]  # B/EI as a series
        pull, k0, k1 = (whole(v, 0) for v in (self.N * h**2 / B, self.k[0] * h**4 / B, self.k[1] * h**5 / B))
        loads = [[whole(v, shift) for v in both] for both in loads]
        found, before, n = [tuple(whole(v, shift) for v in first)], 0, 0
        slopes, small = [], 1 << (bits // 4)
        while n % 5 or n < 10 or any(abs(v) > small for one in found[-5:] for v in one):
            w, psi, _, T = found[-1]
            load, bent = loads[n] if n < 2 else (0, 0)
            slope = (psi * turn + T * slip) >> bits
            slopes.append(slope)
            curved = sum(one[2] * f for one, f in zip(found[-len(soft) :], reversed(soft), strict=False)) >> bits
            if self.power:
                soft.append(-(self.power + n) * (soft[-1] * grows >> bits) // (n + 1))
            n += 1
            found.append((slope // n, (bent - curved) // n, (T - (slope * pull >> bits)) // n,
                          (((w * k0 + before * k1) >> bits) - load) // n))  # fmt: skip
            before = w
        slopes.append(0)
        return [*zip(*found, strict=True), slopes], [mp.ldexp(unit, shift - bits) for unit in units]

    def series(self, start, q=None, kappa=None):
        """Taylor coefficients of w, psi, M, T and w' in t = (x - a)/h from the state at the left end."""
        found, worth = self.terms(start, q or self.q, kappa or self.kappa)
        return [[v * unit for v in one] for one, unit in zip(found, worth, strict=True)]

    def transfer(self, known):
        """Matrix (columns) of the homogeneous state over the cell, and the particular state at its end; `known` keeps them."""
        key = (self.h, self.EI, self.GA, self.N, self.k, self.growth, self.power)
        none = (mp.mpf(0),) * 2

        def end(start, q, kappa):
            found, worth = self.terms(start, q, kappa)
            return [sum(one) * unit for one, unit in zip(found[:4], worth, strict=False)]

        if key not in known:
            known[key] = [end([mp.mpf(i == j) for i in range(4)], none, none) for j in range(4)]
        particular, loads = [mp.mpf(0)] * 4, (*self.q, *self.kappa)
        for i, load in enumerate(loads):
            if load:
                if (key, i) not in known:
                    unit = [mp.mpf(i == j) for j in range(4)]
                    known[key, i] = end([mp.mpf(0)] * 4, tuple(unit[:2]), tuple(unit[2:]))
                particular = [p + load * one for p, one in zip(particular, known[key, i], strict=True)]
        return known[key], particular


@dataclass
class Support:
    x: mp.mpf
    side: int
    stiffness: mp.mpf
    level: mp.mpf  # deflection at which it begins to act
    rotation: mp.mpf  # stiffness
    at_hinge: str


def pair(value):
    """Values at two ends of a number or a pair."""
    return tuple(map(mp.mpf, value)) if isinstance(value, list | tuple) else (mp.mpf(value),) * 2


class Beam:
    """A scene (dict) read: marks along it, and cells between them.

    Parameters
    ----------
    scene : dict
        Names of the scene format; foundations act both ways; `masses` = [{"x" or "node", "mass"}] are lumped.
    N_factor, load_factor : number
        Of all axial forces; of all loads that are not dead.
    omega : number
        Circular frequency of motion in phase.
    """

    def __init__(self, scene, N_factor=1, load_factor=1, omega=0):
        beam, self.omega = scene["beam"], mp.mpf(omega)
        spans = list(map(mp.mpf, beam["spans"]))
        self.nodes = [mp.fsum(spans[:i]) for i in range(len(spans) + 1)]
        self.length, self.marks = self.nodes[-1], []
        for x in self.nodes:
            self.mark(x)
        self.hinges = {self.mark(x): mp.mpf(0) for x in beam.get("hinges", [])}  # and their stiffness
        self.hinges |= {self.place(h): mp.mpf(h.get("stiffness", 0)) for h in scene.get("hinges", [])}
        self.supports = [self.support(s) for s in scene["supports"]]
        self.one_sided = [i for i, s in enumerate(self.supports) if s.side]
        self.masses = [(self.place(m), mp.mpf(m["mass"])) for m in scene.get("masses", [])]
        self.forces, self.couples, spread = [], [], []
        self.turned = {}  # rotation of a support, by its place in the scene
        for load in scene.get("loads", []):
            factor = mp.mpf(1 if load.get("case") == "dead" else load_factor)
            kind = load["type"]
            if kind == "force":
                self.forces.append((self.place(load), factor * mp.mpf(load["F"])))
            elif kind == "moment":
                self.couples.append((self.place(load), factor * mp.mpf(load["M"]), load.get("at_hinge")))
            elif kind == "movement" and load.keys() <= {"type", "support", "rotation", "case"}:
                self.turned[load["support"]] = self.turned.get(load["support"], 0) + factor * mp.mpf(load["rotation"])
            elif kind in ("uniform", "linear", "curvature"):
                ends = [factor * v for v in pair(load["kappa" if kind == "curvature" else "q"])]
                spread.append((*self.extent(load), "kappa" if kind == "curvature" else "q", ends))
            else:
                raise ValueError(f"load of type {kind}")
        grounds = [(*self.extent(f), f) for f in scene.get("foundation", [])]
        if any(f.get("side", "both") != "both" or {"gap", "law", "profile"} & f.keys() for *_, f in grounds):
            raise ValueError("ground that is more than a two-sided one: see axial_ground")
        sections = [(*self.extent(s), s) for s in scene.get("sections", [])]
        self.marks.sort()
        self.cells, self.axial, self.mass, self.tapers = [], [], [], []  # for every part between marks
        for a, b in itertools.pairwise(self.marks):
            middle, span, tapered = (a + b) / 2, sum(x < (a + b) / 2 for x in self.nodes) - 1, None
            values = {"EI": None, "GA": mp.inf, "N": 0, "mass": 0}
            for name in values:
                given = beam.get(name, values[name])
                values[name] = given[span] if isinstance(given, list) else given
                for start, stop, section in sections:
                    if start < middle < stop and name in section:
                        values[name] = section[name]
                        tapered = taper(section[name], start, stop) if name == "EI" else tapered
            self.tapers.append(tapered)
            if tapered:
                values["EI"] = min(tapered.at(a), tapered.at(b))
            here = {name: mp.mpf(value) for name, value in values.items()}
            lines = {"q": [mp.mpf(0)] * 2, "kappa": [mp.mpf(0)] * 2, "k": [-here["mass"] * self.omega**2] * 2}
            self.axial.append(here["N"])
            here["N"] *= mp.mpf(N_factor)
            parts = [(*part[:3], part[3]) for part in spread] + [(*g[:2], "k", pair(g[2].get("k", 0))) for g in grounds]
            for start, stop, name, ends in parts:
                if start < middle < stop:
                    for i, x in enumerate((a, b)):
                        lines[name][i] += ends[0] + (ends[1] - ends[0]) * (x - start) / (stop - start)
            self.mass.append(here["mass"])
            here["N"] += sum(mp.mpf(g.get("shear", 0)) for start, stop, g in grounds if start < middle < stop)
            if not 1 + here["N"] / here["GA"] > 0:
                raise ValueError("the compression reaches GA")
            self.cells.append(self.cut(a, b, here, lines))

    def mark(self, x):
        """A place that is one of the marks, rounding apart."""
        x = mp.mpf(x)
        for other in self.marks:
            if abs(other - x) <= mp.mpf("1e-13") * self.length:
                return other
        self.marks.append(x)
        return x

    def place(self, item):
        return self.mark(item["x"] if "x" in item else self.nodes[item["node"]])

    def extent(self, item):
        return self.mark(item.get("from", 0)), self.mark(item.get("to", self.length))

    def support(self, item):
        other = {"law", "direction", "friction", "unloading"} & item.keys()
        if other:
            raise ValueError(f"support with {sorted(other)}")
        side = SIDES[item.get("side", "both")]
        rotation = {"free": 0, "fixed": mp.inf}.get(item.get("rotation", "free"), item.get("rotation"))
        level = mp.mpf(item.get("settlement", 0)) + side * mp.mpf(item.get("gap", 0))
        return Support(self.place(item), side, mp.mpf(item.get("stiffness", mp.inf)), level, mp.mpf(rotation), item.get("at_hinge"))

    def cut(self, a, b, here, lines):
        """Cells of equal length."""
        k = max(map(abs, lines["k"]))
        s, p = 1 + here["N"] / here["GA"], abs(here["N"]) / here["EI"] + k / here["GA"]
        root = mp.sqrt((p + mp.sqrt(p * p + 4 * s * k / here["EI"])) / (2 * s))
        count = 1 + int(root * (b - a) / REACH + GENTLE * steepness(self.tapers[-1], a, b))
        h = (b - a) / count
        found = []
        for i in range(count):
            at = {name: (v[0] + (v[1] - v[0]) * i / count, (v[1] - v[0]) / (b - a)) for name, v in lines.items()}
            EI = stiffness_of(self.tapers[-1], here["EI"], a + i * h, h)
            found.append(Cell(a + i * h, h, GA=here["GA"], N=here["N"], **EI, **at))
        return found


def steepness(tapered, a, b):
    """Change of the depth between two places, in parts of the least."""
    if not tapered:
        return 0
    return abs(tapered.depth(b)[0] - tapered.depth(a)[0]) / min(tapered.depth(a)[0], tapered.depth(b)[0])


def stiffness_of(tapered, EI, a, h):
    """EI of a cell; of one that tapers that at its left end, with growth and power."""
    if not tapered:
        return {"EI": EI}
    depth, slope = tapered.depth(a)
    return {"EI": tapered.at(a), "growth": slope * h / depth, "power": tapered.power}
