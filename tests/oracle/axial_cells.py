"""Beams under a given axial force, read and cut into short cells that the state (w, psi, M, T) crosses; see `axial_force`."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import mpmath as mp

DIGITS = 90
REACH = 16  # a cell is at most so many lengths of decay long
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

    def series(self, start, q=None, kappa=None):
        """Taylor coefficients of w, psi, M, T and w' in t = (x - a)/h from the state at the left end."""
        q, kappa = q or self.q, kappa or self.kappa
        soft, slip, s = 1 / self.EI, 1 / self.GA, 1 + self.N / self.GA
        h, k = self.h, (self.k[0], self.k[1] * self.h)
        loads = {0: (q[0], kappa[0]), 1: (q[1] * h, kappa[1] * h)}
        coefficients, slopes, before, n = [list(start)], [], mp.mpf(0), 0
        size = sum(map(abs, start)) + sum(map(abs, (*q, *kappa)))
        tiny = mp.eps * size / 1000
        while n % 5 or n < 10 or any(abs(v) > tiny for one in coefficients[-5:] for v in one):
            w, psi, M, T = coefficients[-1]
            load, bent = loads.get(n, (0, 0))
            slope = (psi + T * slip) / s
            spring = k[0] * w + k[1] * before if k[1] else k[0] * w
            f = h / (n + 1)
            step = [f * slope, f * (bent - M * soft), f * (T - self.N * slope), f * (spring - load)]
            slopes.append(slope)
            coefficients.append(step)
            before, n = w, n + 1
        slopes.append((coefficients[-1][1] + coefficients[-1][3] * slip) / s)
        return [*map(list, zip(*coefficients, strict=True)), slopes]

    def transfer(self, known):
        """Matrix (columns) of the homogeneous state over the cell, and the particular state at its end; `known` keeps them."""
        key = (self.h, self.EI, self.GA, self.N, self.k)
        none = (mp.mpf(0),) * 2

        def end(start, q, kappa):
            return [mp.fsum(one) for one in self.series(start, q, kappa)[:4]]

        if key not in known:
            known[key] = [end([mp.mpf(i == j) for i in range(4)], none, none) for j in range(4)]
        load = (key, self.q, self.kappa)
        if load not in known:
            known[load] = end([mp.mpf(0)] * 4, self.q, self.kappa) if any((*self.q, *self.kappa)) else [mp.mpf(0)] * 4
        return known[key], known[load]


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
        self.hinges = {self.mark(x) for x in beam.get("hinges", [])} | {self.mark(self.place(h)) for h in scene.get("hinges", [])}
        self.supports = [self.support(s) for s in scene["supports"]]
        self.one_sided = [i for i, s in enumerate(self.supports) if s.side]
        self.masses = [(self.place(m), mp.mpf(m["mass"])) for m in scene.get("masses", [])]
        self.forces, self.couples, spread = [], [], []
        for load in scene.get("loads", []):
            factor = mp.mpf(1 if load.get("case") == "dead" else load_factor)
            kind = load["type"]
            if kind == "force":
                self.forces.append((self.place(load), factor * mp.mpf(load["F"])))
            elif kind == "moment":
                self.couples.append((self.place(load), factor * mp.mpf(load["M"]), load.get("at_hinge")))
            elif kind in ("uniform", "linear", "curvature"):
                ends = [factor * v for v in pair(load["kappa" if kind == "curvature" else "q"])]
                spread.append((*self.extent(load), "kappa" if kind == "curvature" else "q", ends))
            else:
                raise ValueError(f"load of type {kind}")
        grounds = [(*self.extent(f), f) for f in scene.get("foundation", [])]
        if any(f.get("side", "both") != "both" for *_, f in grounds):
            raise ValueError("one-sided ground")
        sections = [(*self.extent(s), s) for s in scene.get("sections", [])]
        self.marks.sort()
        self.cells, self.axial, self.mass = [], [], []  # for every part between marks
        for a, b in itertools.pairwise(self.marks):
            middle, span = (a + b) / 2, sum(x < (a + b) / 2 for x in self.nodes) - 1
            values = {"EI": None, "GA": mp.inf, "N": 0, "mass": 0}
            for name in values:
                given = beam.get(name, values[name])
                values[name] = given[span] if isinstance(given, list) else given
                for start, stop, section in sections:
                    if start < middle < stop and name in section:
                        values[name] = section[name]
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
        side = SIDES[item.get("side", "both")]
        rotation = {"free": 0, "fixed": mp.inf}.get(item.get("rotation", "free"), item.get("rotation"))
        level = mp.mpf(item.get("settlement", 0)) + side * mp.mpf(item.get("gap", 0))
        return Support(self.place(item), side, mp.mpf(item.get("stiffness", mp.inf)), level, mp.mpf(rotation), item.get("at_hinge"))

    def cut(self, a, b, here, lines):
        """Cells of equal length."""
        k = max(map(abs, lines["k"]))
        s, p = 1 + here["N"] / here["GA"], abs(here["N"]) / here["EI"] + k / here["GA"]
        root = mp.sqrt((p + mp.sqrt(p * p + 4 * s * k / here["EI"])) / (2 * s))
        count = 1 + int(root * (b - a) / REACH)
        h = (b - a) / count
        found = []
        for i in range(count):
            at = {name: (v[0] + (v[1] - v[0]) * i / count, (v[1] - v[0]) / (b - a)) for name, v in lines.items()}
            found.append(Cell(a + i * h, h, here["EI"], here["GA"], here["N"], **at))
        return found
