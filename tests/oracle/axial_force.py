"""Beams under a given axial force, with one-sided supports and two-sided ground, in many digits.

Independent of gapbeam: the state (w, psi, M, T) is carried over short cells by its Taylor series; the states at all
ends of cells and all reactions are unknowns of one sparse system. The deflections and reactions of one-sided supports
are kept to the last, and every set of acting ones is tried. T = M' + (N + G_p) w' is the transverse force, with the
share of a second parameter of the ground, and continuous where that ends. By Engesser's rule the shear force is normal
to the deflected axis: w' = psi + M'/GA.

Examples
--------
>>> found = solve({"beam": {"spans": [1.0], "EI": 1.0, "N": 9.0}, "supports": [{"node": 0}, {"node": 1}],
...                "loads": [{"type": "uniform", "q": 1.0}]})
>>> found.status, round(float(found.at(0.5).moment), 12)
('solved', 0.06387821834)
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass, field

import mpmath as mp
import numpy as np

from .axial_cells import DIGITS, Beam

MOST = 10  # one-sided supports of which all sets are tried


class Mechanism(Exception):
    """The equations are singular, whichever one-sided supports act."""


@dataclass
class Point:
    """Values at one place; shear is dM/dx, transverse M' + (N + G_p) w', slope w'."""

    deflection: mp.mpf
    rotation: mp.mpf
    moment: mp.mpf
    shear: mp.mpf
    transverse: mp.mpf
    slope: mp.mpf


def eliminate(rows, columns):
    """Gauss with scaled pivots on rows that are dicts; rows that are left, and steps for `back`."""
    rows = [dict(row) for row in rows]
    holders = {}
    for i, row in enumerate(rows):
        for c in row:
            holders.setdefault(c, set()).add(i)
    steps = []
    for c in columns:
        best, size = None, mp.mpf(10) ** (-0.7 * mp.mp.dps)
        for i in holders.get(c, ()):
            largest = max(abs(v) for column, v in rows[i].items() if column != "load")
            if abs(rows[i][c]) > size * largest:
                best, size = i, abs(rows[i][c]) / largest
        if best is None:
            raise Mechanism
        pivot = rows[best]
        for column in pivot:
            holders[column].discard(best)
        for i in holders.pop(c):
            row = rows[i]
            f = row.pop(c) / pivot[c]
            for column, v in pivot.items():
                if column != c:
                    row[column] = row.get(column, 0) - f * v
                    holders[column].add(i)
        rows[best] = None
        steps.append((c, pivot))
    return [row for row in rows if row is not None], steps


def back(steps, values):
    """Unknowns from those that are known; values["load"] is -1 (rows: sum of all = 0)."""
    for c, pivot in reversed(steps):
        values[c] = -sum(v * values[column] for column, v in pivot.items() if column != c) / pivot[c]
    return values


def acts(support, w, R):
    """Row of a support that acts."""
    c = support.stiffness
    return {w: mp.mpf(1), "load": support.level} if mp.isinf(c) else {w: c, R: mp.mpf(-1), "load": c * support.level}


class System:
    """The equations of a beam, condensed to the deflections and reactions of its one-sided supports."""

    def __init__(self, beam):
        self.beam, self.rows, self.columns, known = beam, [], [], {}
        for j, x in enumerate(beam.marks):
            left, right = [("l", j, c) for c in range(4)], [("r", j, c) for c in range(4)]
            self.columns += [*left, *right]
            self.join(j, x, left, right)
            for i, cell in enumerate(beam.cells[j] if j < len(beam.cells) else ()):
                after = [("c", j, i, c) for c in range(4)] if i + 1 < len(beam.cells[j]) else [("l", j + 1, c) for c in range(4)]
                matrix, particular = cell.transfer(known)
                for c in range(4):
                    row = {right[n]: matrix[n][c] for n in range(4) if matrix[n][c]}
                    self.rows.append({**row, after[c]: mp.mpf(-1), "load": -particular[c]})
                if after[0][0] == "c":
                    self.columns += after
                right = after
        self.left, self.steps = eliminate(self.rows, self.columns)

    def join(self, j, x, left, right):
        """What holds at a mark."""
        one, beam = mp.mpf(1), self.beam
        here = [(i, s) for i, s in enumerate(beam.supports) if s.x == x]
        self.rows.append({left[0]: one, right[0]: -one})
        force = {left[3]: one, right[3]: -one, "load": sum((F for at, F in beam.forces if at == x), mp.mpf(0))}
        for i, s in here:  # reactions
            force[("R", i)] = one
            if s.side:
                self.rows.append({right[0]: one, ("w", i): -one})
            else:
                self.columns.append(("R", i))
                self.rows.append(acts(s, right[0], ("R", i)))
        self.rows.append(force)
        if x in beam.hinges:
            sides, c = {"left": {left[2]: one, ("H", j): -one}, "right": {right[2]: -one, ("H", j): one}}, beam.hinges[x]
            self.columns.append(("H", j))
            self.rows.append({("H", j): one, left[1]: -c, right[1]: c} if c else {("H", j): one})
        else:
            sides = {None: {left[2]: one, right[2]: -one}}
            self.rows.append({left[1]: one, right[1]: -one})
        for at, row in sides.items():
            row["load"] = -sum((M for place, M, part in beam.couples if place == x and (at is None or part == at)), mp.mpf(0))
            for i, s in here:
                if s.rotation and (at is None or s.at_hinge == at):
                    row[("C", i)] = one  # couple on the beam, clockwise
                    self.columns.append(("C", i))
                    psi = (left if at == "left" else right)[1]
                    turned = beam.turned.get(i, mp.mpf(0))
                    row_of = {psi: one, "load": turned}
                    if not mp.isinf(s.rotation):
                        row_of = {psi: s.rotation, ("C", i): one, "load": s.rotation * turned}
                    self.rows.append(row_of)
            self.rows.append(row)
        for end, state in ((0, left), (len(beam.marks) - 1, right)):
            if j == end:
                self.rows += [{state[2]: one}, {state[3]: one}]

    def at_contact(self, active):
        """Deflections and reactions of one-sided supports if those act, or None where nothing holds the beam."""
        rows = list(self.left)
        for i in self.beam.one_sided:
            s = self.beam.supports[i]
            rows.append(acts(s, ("w", i), ("R", i)) if i in active else {("R", i): mp.mpf(1)})
        try:
            _, steps = eliminate(rows, [(name, i) for i in self.beam.one_sided for name in "wR"])
        except Mechanism:
            return None
        return back(steps, {"load": mp.mpf(-1)})

    def wrong(self, active, values):
        """Supports that would change, and those for which both states are right."""
        wrong, tied = [], []
        size = max((abs(values[name, i]) for i in self.beam.one_sided for name in "R"), default=mp.mpf(0))
        far = max((abs(values["w", i]) + abs(self.beam.supports[i].level) for i in self.beam.one_sided), default=mp.mpf(0))
        for i in self.beam.one_sided:
            s = self.beam.supports[i]
            push, gap = s.side * values["R", i], s.side * (s.level - values["w", i])
            margin = push / (size or 1) if i in active else gap / (far or 1)
            if abs(margin) < mp.mpf(10) ** (-mp.mp.dps // 2):
                tied.append(i)
            elif margin < 0:
                wrong.append(i)
        return wrong, tied

    def sets(self):
        """All sets of acting supports that satisfy every condition, with values and ties; of many supports one."""
        sided = self.beam.one_sided
        if len(sided) > MOST:
            return self.search()
        found = []
        for count in range(len(sided) + 1):
            for active in itertools.combinations(sided, count):
                values = self.at_contact(active)
                if values is not None:
                    wrong, tied = self.wrong(active, values)
                    if not wrong:
                        found.append((active, values, tied))
        return found

    def search(self):
        """Change all wrong supports while that gets better, else the last wrong one (Murty)."""
        active, least, patience = set(self.beam.one_sided), len(self.beam.one_sided) + 1, 10
        for _ in range(2000):
            values = self.at_contact(active)
            if values is None:
                active.add(next(i for i in self.beam.one_sided if i not in active))
                continue
            wrong, tied = self.wrong(active, values)
            if not wrong:
                return [(tuple(sorted(active)), values, tied)]
            if len(wrong) < least:
                least, patience = len(wrong), 10
            else:
                patience -= 1
            active ^= set(wrong if patience > 0 else wrong[-1:])
        return []


@dataclass
class Solution:
    """The answer.

    Attributes
    ----------
    status : str
        "solved", "buckles" (states in equilibrium, none of them stable), "no-equilibrium".
    active : tuple of int
        One-sided supports that act, by their place in the scene.
    sets : list of (active, negative modes or None if not counted, ties)
        All sets that satisfy the conditions (up to ten one-sided supports), the chosen one first: the first stable one.
    reaction, deflection, opening, couple : list of mpf
        In the order of the scene's supports; a couple is that on the beam, clockwise.
    """

    status: str
    active: tuple = ()
    sets: list = field(default_factory=list)
    reaction: list = field(default_factory=list)
    deflection: list = field(default_factory=list)
    opening: list = field(default_factory=list)
    couple: list = field(default_factory=list)
    beam: Beam = None
    values: dict = field(default_factory=dict, repr=False)
    known: dict = field(default_factory=dict, repr=False)

    def series(self, j, i):
        """The fields in a cell, kept."""
        if (j, i) not in self.known:
            start = [self.values["c", j, i - 1, c] if i else self.values["r", j, c] for c in range(4)]
            self.known[j, i] = self.beam.cells[j][i].series(start)
        return self.known[j, i]

    def at(self, x, side="right"):
        """Values at a place, from one side where they jump."""
        with mp.workdps(DIGITS):
            x, beam = mp.mpf(x), self.beam
            near = next((j for j, m in enumerate(beam.marks) if abs(m - x) <= mp.mpf("1e-13") * beam.length), None)
            j = near - (side == "left") if near is not None else sum(m < x for m in beam.marks) - 1
            j = min(max(j, 0), len(beam.cells) - 1)
            x = x if near is None else beam.marks[near]
            cells = beam.cells[j]
            i = min(max(int((x - cells[0].a) / cells[0].h), 0), len(cells) - 1)
            cell, t = cells[i], (x - cells[i].a) / cells[i].h
            return self.point(cell, self.series(j, i), t)

    @staticmethod
    def point(cell, series, t):
        w, psi, M, T, slope = (polynomial(one, t) for one in series)
        return Point(w, psi, M, T - cell.N * slope, T, slope)

    def extremes(self, samples=33):
        """{"deflection": {"max": (value, x), "min": ...}, "moment": ...}, by samples of every cell and Newton."""
        with mp.workdps(DIGITS):
            found = {"deflection": [], "moment": []}
            for j, cells in enumerate(self.beam.cells):
                for i, cell in enumerate(cells):
                    series = self.series(j, i)
                    for t in (0, 1):
                        point = self.point(cell, series, t)
                        found["deflection"].append((point.deflection, cell.a + t * cell.h, None))
                        found["moment"].append((point.moment, cell.a + t * cell.h, None))
                    shear = [T - cell.N * s for T, s in zip(series[3], series[4], strict=True)]
                    for name, value, change in (("deflection", series[0], series[4]), ("moment", series[2], shear)):
                        found[name] += turns(cell, value, change, samples)
            return {name: {"max": best(some, 1), "min": best(some, -1)} for name, some in found.items()}


def polynomial(coefficients, t):
    """Value; lowest power first."""
    value = mp.mpf(0)
    for c in reversed(coefficients):
        value = value * t + c
    return value


def turns(cell, value, change, samples):
    """Places in a cell where a derivative changes its sign, roughly: (value, x, how to refine)."""
    size = max(map(abs, change)) or mp.mpf(1)
    t = np.linspace(0, 1, samples)
    f = np.polyval([float(c / size) for c in reversed(change)], t)
    some = []
    for n in np.flatnonzero((f[:-1] * f[1:] <= 0) & (f[:-1] != 0)):
        middle = mp.mpf(t[n] + t[n + 1]) / 2
        some.append((polynomial(value, middle), cell.a + middle * cell.h, (cell, value, change, t[n], t[n + 1])))
    return some


def best(some, sign):
    """The largest (sign 1) or least value among ends and turns; turns are refined where they may win."""
    exact = [(value, x) for value, x, refine in some if refine is None]
    for *_, refine in sorted((one for one in some if one[2]), key=lambda one: -sign * one[0])[:8]:
        cell, values, change, low, high = refine
        low, high = mp.mpf(low), mp.mpf(high)
        sense = mp.sign(polynomial(change, high))
        for _ in range(30):
            middle = (low + high) / 2
            low, high = (low, middle) if polynomial(change, middle) * sense > 0 else (middle, high)
        t = (low + high) / 2
        for _ in range(5):
            f, slope = polynomial(change, t), polynomial([n * c for n, c in enumerate(change)][1:], t)
            t -= f / slope if slope else 0
        exact.append((polynomial(values, t), cell.a + t * cell.h))
    return max(exact, key=lambda one: sign * one[0])


def solve(beam, N_factor=1, load_factor=1, omega=0, active=None, stable=True):
    """The state of a beam.

    Parameters
    ----------
    beam : dict
        A scene.
    N_factor, load_factor, omega : number
        See `Beam`; omega: amplitudes under loads in phase.
    active : sequence of int, optional
        One-sided supports that act, whatever the signs; default: all sets are tried.
    stable : bool
        Count negative modes of the sets found (none without compression), and take the first that is stable.

    Returns
    -------
    Solution
    """
    from .axial_modes import inertia

    with mp.workdps(DIGITS):
        read = Beam(beam, N_factor, load_factor, omega)
        system = System(read)
        if active is None:
            sets = system.sets()
        else:
            values = system.at_contact(active)
            sets = [] if values is None else [(tuple(active), values, [])]
        count = stable and active is None and (omega or any(c.N < 0 for part in read.cells for c in part))

        def modes(acting):
            return inertia(beam, acting, N_factor, omega) if count else 0 if stable else None

        sets = [(s, modes(s), tied, values) for s, values, tied in sets]
        sets.sort(key=lambda one: one[1] or 0)
        if not sets:
            return Solution("no-equilibrium")
        chosen, negative, _, values = sets[0]
        values = back(system.steps, dict(values))
        zero = mp.mpf(0)
        found = Solution("buckles" if negative else "solved", chosen, [one[:3] for one in sets], beam=read, values=values)
        for i, s in enumerate(read.supports):
            found.reaction.append(values["R", i])
            found.deflection.append(values["r", read.marks.index(s.x), 0])
            apart = s.side * (s.level - found.deflection[-1])
            found.opening.append(apart if s.side and i not in chosen else zero)
            found.couple.append(values.get(("C", i), zero))
        return found
