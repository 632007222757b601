"""One-sided ground under a beam with axial forces: zones of contact by Newton's iteration on their ends; see `axial_force`.

Independent of gapbeam. In every round the ground acts both ways where the last deflection had closed its gap; the ends of
the next zones are zeros of the Taylor polynomials of the deflection less the gap.
"""

from __future__ import annotations

import copy

import mpmath as mp
import numpy as np

from .axial_cells import DIGITS, SIDES, Beam, pair
from .axial_force import polynomial, solve

SAMPLES = 33
GRADED = 0.5 ** np.arange(6, 34)  # beside the ends, where a beam that is held just at the ground may lift off for a short way
ENDS = 45  # digits to which ends settle


class Unsettled(Exception):
    """The zones have not settled."""


def solve_on_ground(scene, N_factor=1, load_factor=1, stable=True, rounds=40):
    """The state of a beam with one-sided foundations.

    Parameters
    ----------
    scene : dict
        With foundations of any side: k and gap numbers or pairs (not both pairs), no profile and no law, and no gap with side both.
    N_factor, load_factor : number
    stable : bool
        See `solve`; the ground is counted where it acts.
    rounds : int

    Returns
    -------
    solution : Solution
    zones : list of list of (from, to)
        Of every foundation of the scene; a two-sided one acts everywhere.
    """
    with mp.workdps(DIGITS):
        read = Beam({**scene, "foundation": [], "loads": []})
        grounds = [Ground(read, item) for item in scene["foundation"]]
        zones = [[(g.a, g.b)] for g in grounds]
        for _ in range(rounds):
            made = copy.deepcopy(scene)
            both = list(zip(grounds, zones, strict=True))
            made["foundation"] = [one for g, some in both for one in g.acting(some)]
            made["loads"] = [*made.get("loads", []), *(one for g, some in both for one in g.loads(some))]
            found = solve(made, N_factor, load_factor, stable=False)
            if not found.beam:
                return found, zones
            before, zones = zones, [g.zones(found) for g in grounds]
            if settled(before, zones, read.length):
                return solve(made, N_factor, load_factor, stable=stable), zones
        raise Unsettled(zones)


def settled(before, zones, length):
    """Whether the zones are those of the round before."""
    ends = [[x for one in some for zone in one for x in zone] for some in (before, zones)]
    if [len(one) for one in before] != [len(one) for one in zones]:
        return False
    return all(abs(a - b) <= mp.mpf(10) ** -ENDS * length for a, b in zip(*ends, strict=True))


class Ground:
    """A foundation of the scene."""

    def __init__(self, beam, item):
        if {"law", "profile"} & item.keys():
            raise ValueError("ground with a law or a profile")
        self.item, self.side = item, SIDES[item.get("side", "both")]
        self.a, self.b = beam.extent(item)
        if not self.side and item.get("gap"):
            raise ValueError("ground that acts both ways, with a gap: give one below and one above")
        self.k, self.gap = pair(item["k"]), pair(item.get("gap", 0))
        if self.k[0] != self.k[1] and self.gap[0] != self.gap[1]:
            raise ValueError("k and gap vary")

    def at(self, ends, x):
        """A value between those at the ends."""
        return ends[0] + (ends[1] - ends[0]) * (x - self.a) / (self.b - self.a)

    def acting(self, zones):
        """Two-sided foundations where this one acts; one without stiffness leaves marks at its own ends."""
        if not self.side:
            return [{**self.item, "side": "both"}]
        parts = [{"from": a, "to": b, "k": [self.at(self.k, x) for x in (a, b)]} for a, b in zones]
        return [{"from": self.a, "to": self.b, "k": 0}, *parts]

    def loads(self, zones):
        """What the gap makes of the two-sided ground: a load."""
        if not self.side or not any(self.gap):
            return []
        return [{"type": "linear", "from": a, "to": b, "case": "dead",
                 "q": [self.side * self.at(self.k, x) * self.at(self.gap, x) for x in (a, b)]} for a, b in zones]  # fmt: skip

    def zones(self, found):
        """Where the gap is closed."""
        if not self.side:
            return [(self.a, self.b)]
        ends, inside = [], False
        for j, cells in enumerate(found.beam.cells):
            for i, cell in enumerate(cells):
                if not self.a <= cell.a + cell.h / 2 <= self.b:
                    continue
                depth = [self.side * c for c in found.series(j, i)[0]]
                depth[0] -= self.at(self.gap, cell.a)
                depth[1] -= (self.gap[1] - self.gap[0]) * cell.h / (self.b - self.a)
                for t in (mp.mpf(0), *zeros(depth)):
                    slope = polynomial([n * c for n, c in enumerate(depth)][1:], t)
                    closed = slope > 0 if t else polynomial(depth, mp.mpf("1e-12")) > 0
                    if closed != inside:
                        ends.append(cell.a + t * cell.h)
                        inside = closed
        if inside:
            ends.append(self.b)
        return list(zip(ends[::2], ends[1::2], strict=True))


def zeros(coefficients):
    """Zeros of a polynomial in (0, 1), if it changes its sign between samples."""
    size = max(map(abs, coefficients)) or mp.mpf(1)
    t = np.concatenate([[0], GRADED[::-1], np.linspace(0, 1, SAMPLES)[1:-1], 1 - GRADED, [1]])
    f = np.polyval([float(c / size) for c in reversed(coefficients)], t)
    slope, found = [n * c for n, c in enumerate(coefficients)][1:], []
    for n in np.flatnonzero(f[:-1] * f[1:] < 0):
        low, high, down = mp.mpf(t[n]), mp.mpf(t[n + 1]), f[n] > 0
        for _ in range(40):
            middle = (low + high) / 2
            low, high = (middle, high) if (polynomial(coefficients, middle) > 0) == down else (low, middle)
        x = (low + high) / 2
        for _ in range(5):
            x -= polynomial(coefficients, x) / polynomial(slope, x)
        found.append(x)
    return found
