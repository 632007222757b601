"""Parts of `foundation.py`: a scene cut into stretches, and its linear solution for given contact."""

import bisect
import itertools
from dataclasses import dataclass
from fractions import Fraction

from mpmath import mp, mpf

from .series import REACH, Stretch, Taper, growth, reach, value

SIDES = {"below": 1, "above": -1, "both": 0}
GENTLE = 4  # a tapered part is so many times shorter than the way to where its depth would vanish


@dataclass
class Support:
    x: mpf
    side: int
    stiffness: mpf
    gap: mpf
    settlement: mpf
    rotation: mpf  # stiffness, 0 = free

    @property
    def target(self):
        """Deflection at which it begins to act."""
        return self.settlement + self.side * self.gap


@dataclass(frozen=True)
class Term:
    """max(0, s w - g) times a stiffness, over a whole atom; s = 0: w times the stiffness."""

    foundation: int
    first: bool  # whether this is where its law begins
    side: int
    k: tuple  # k and gap: value at the atom's left end and slope
    gap: tuple


@dataclass
class Atom:
    """A part of the beam within which nothing but the contact changes; EI and GA are the least there."""

    a: mpf
    b: mpf
    EI: mpf
    GA: mpf
    tapers: tuple
    kappa: mpf
    q: tuple
    terms: list


@dataclass
class Held:
    """A support in the answer."""

    x: mpf
    deflection: mpf
    reaction: mpf
    couple: mpf
    closed: bool


def number(v):
    """A number of the scene, exactly."""
    return mpf(v.numerator) / v.denominator if isinstance(v, Fraction) else mpf(v)


def pair(v):
    """Values at the two ends of a number or a pair."""
    return tuple(map(number, v)) if isinstance(v, (list, tuple)) else (number(v), number(v))


def taper(v, start, end):
    """How a stiffness changes along its section, None where it does not."""
    if isinstance(v, dict):
        at_start, at_end, power = number(v["from"]), number(v["to"]), v.get("power", 1)
    elif isinstance(v, (list, tuple)):
        at_start, at_end, power = *map(number, v), 1
    else:
        return None
    return Taper(start, end, at_start, at_end, power) if at_start != at_end else None


class Problem:
    """A scene with loads of one factor, cut into atoms."""

    def __init__(self, scene, factor):
        beam = scene["beam"]
        spans = [number(v) for v in beam["spans"]]
        self.nodes = [mp.fsum(spans[:i]) for i in range(len(spans) + 1)]
        self.length = self.nodes[-1]
        self.hinges = {number(v) for v in beam.get("hinges", [])}
        self.supports = [self.support(s) for s in scene.get("supports", [])]
        self.foundation = scene.get("foundation", [])
        self.forces, self.couples, self.spread = {}, {}, []
        for load in scene.get("loads", []):
            self.add_load(load, mpf(1) if load.get("case", "live") == "dead" else number(factor))
        self.cut(scene)

    def place(self, item):
        """The x of a support or a load at a point."""
        return number(item["x"]) if "x" in item else self.nodes[item["node"]]

    def extent(self, item):
        """(from, to)."""
        return number(item.get("from", 0)), number(item.get("to", self.length))

    def support(self, item):
        """A support of the scene."""
        rotation = {"free": 0, "fixed": mp.inf}.get(item.get("rotation", "free"), item.get("rotation"))
        values = (number(item.get(key, default)) for key, default in (("stiffness", mp.inf), ("gap", 0), ("settlement", 0)))
        return Support(self.place(item), SIDES[item.get("side", "both")], *values, number(rotation))

    def add_load(self, load, factor):
        """Sort a load into what acts at points and what is spread: (from, to, q at its ends, kappa)."""
        kind = load["type"]
        if kind in ("force", "moment"):
            at, name = (self.forces, "F") if kind == "force" else (self.couples, "M")
            x = self.place(load)
            at[x] = at.get(x, mpf(0)) + factor * number(load[name])
        else:
            q = pair(load["q"]) if kind in ("uniform", "linear") else (mpf(0), mpf(0))
            kappa = number(load["kappa"]) if kind == "curvature" else mpf(0)
            self.spread.append((*self.extent(load), [factor * v for v in q], factor * kappa))

    def cut(self, scene):
        """Make the atoms."""
        beam, sections = scene["beam"], [(*self.extent(s), s) for s in scene.get("sections", [])]
        marks = {*self.nodes, *self.hinges, *self.forces, *self.couples, *(s.x for s in self.supports)}
        for start, end, *_ in (*sections, *self.spread, *map(self.extent, self.foundation)):
            marks |= {start, end}
        for item in self.foundation:
            marks |= {number(x) for x, _ in item.get("profile", [])}
        self.atoms = []
        for a, b in itertools.pairwise(sorted(x for x in marks if 0 <= x <= self.length)):
            middle, stiffness, tapers = (a + b) / 2, {}, {}
            for name in ("EI", "GA"):
                v = beam.get(name, mp.inf)
                if isinstance(v, (list, tuple)):
                    v = v[bisect.bisect(self.nodes, middle) - 1]
                v, p, q = ([(v, a, b)] + [(s[name], p, q) for p, q, s in sections if p < middle < q and name in s])[-1]
                tapers[name] = taper(v, p, q)
                stiffness[name] = min(tapers[name].at(a), tapers[name].at(b)) if tapers[name] else number(v)
            acting = [load for load in self.spread if load[0] < middle < load[1]]
            q0, q1 = (mp.fsum(line(p, q, *ends, x)[0] for p, q, ends, _ in acting) for x in (a, b))
            kappa = mp.fsum(load[3] for load in acting)
            terms = [t for i in range(len(self.foundation)) for t in self.terms(i, a, b)]
            n = max(1, int(mp.ceil(reach(stiffest(terms, b - a), stiffness["EI"], stiffness["GA"], b - a) / REACH)))
            for t in filter(None, tapers.values()):
                n = max(n, int(mp.ceil(GENTLE * abs(t.depth(a)[1]) * (b - a) / min(t.depth(a)[0], t.depth(b)[0]))))
            for i in range(n):
                p, q = a + (b - a) * i / n, b if i == n - 1 else a + (b - a) * (i + 1) / n
                moved = [
                    Term(t.foundation, t.first, t.side, moved_line(t.k, p - a), moved_line(t.gap, p - a)) for t in terms
                ]
                slope_q = (q1 - q0) / (b - a)
                made = {k: min(t.at(p), t.at(q)) if t else stiffness[k] for k, t in tapers.items()}
                of_atom = (q0 + slope_q * (p - a), slope_q)
                self.atoms.append(Atom(p, q, **made, tapers=tuple(tapers.values()), kappa=kappa, q=of_atom, terms=moved))
        self.growth = mp.fsum(growth(stiffest(c.terms, c.b - c.a), c.EI, c.GA, c.b - c.a) for c in self.atoms)
        self.stretches = {}

    def terms(self, i, a, b):
        """Terms of a foundation over a..b."""
        item = self.foundation[i]
        start, end = self.extent(item)
        if not start < (a + b) / 2 < end:
            return
        side = SIDES[item.get("side", "both")]
        gap = gap_line(item, start, end, a, b)
        if "law" in item:
            law = [(mpf(0), mpf(0)), *([number(v) for v in p] for p in item["law"])]
            steps = [((s - r) / (e - d), d) for (d, r), (e, s) in itertools.pairwise(law)]
            rises = [(k - before, d) for (before, _), (k, d) in zip([(0, 0), *steps], steps, strict=False)]
            if any(k < 0 for k, _ in steps):
                raise ValueError("a falling law")
            pieces = [((k, mpf(0)), d) for k, d in rises]
        else:
            pieces = [(line(start, end, *pair(item["k"]), a), mpf(0))]
        for j, (k, d) in enumerate(pieces):
            bilateral = side == 0 and j == 0 and not any(pair(item.get("gap", 0))) and "profile" not in item
            for s in (0,) if bilateral else (1, -1) if side == 0 else (side,):
                yield Term(i, j == 0, s, k, (mpf(0), mpf(0)) if bilateral else (gap[0] + d, gap[1]))

    def stretch(self, i, a, b, acting):
        """The stretch a..b of atom i where some of its terms act."""
        key = i, a, b, acting
        if key not in self.stretches:
            atom = self.atoms[i]
            K, source = [mpf(0)] * 2, [-v for v in moved_line(atom.q, a - atom.a)] + [mpf(0)]
            for term in itertools.compress(atom.terms, acting):
                k, g = moved_line(term.k, a - atom.a), moved_line(term.gap, a - atom.a)
                K = [p + q for p, q in zip(K, k, strict=True)]
                source = [c - term.side * d for c, d in zip(source, product(k, g), strict=True)]
            made = Stretch(a, b, atom.EI, atom.GA, atom.kappa, K, source, atom.tapers)
            made.atom, made.acting = atom, acting
            self.stretches[key] = made
        return self.stretches[key]


def stiffest(terms, h):
    """Largest stiffness of all terms together within a length h, or more."""
    return mp.fsum(max(t.k[0], t.k[0] + t.k[1] * h, 0) for t in terms)


def line(start, end, at_start, at_end, x):
    """(value at x, slope) of a straight line."""
    rate = (at_end - at_start) / (end - start)
    return at_start + rate * (x - start), rate


def moved_line(v, t):
    """A line (value, slope) seen from t further right."""
    return v[0] + v[1] * t, v[1]


def product(p, q):
    """Product of two lines."""
    return p[0] * q[0], p[0] * q[1] + p[1] * q[0], p[1] * q[1]


def gap_line(item, start, end, a, b):
    """Gap over a..b, within which it is straight, as (value, slope)."""
    if "profile" not in item:
        return line(start, end, *pair(item.get("gap", 0)), a)
    points = [tuple(map(number, p)) for p in item["profile"]]
    for (x, g), (y, h) in itertools.pairwise(points):
        if x < (a + b) / 2 < y:
            return line(x, y, g, h, a)
    return (points[0] if b <= points[0][0] else points[-1])[1], mpf(0)


@dataclass
class State:
    """What acts: supports, and for every atom and term the intervals, as a tuple of (from, to)."""

    closed: tuple
    zones: list

    def shape(self):
        """All of it but the places of ends."""
        return self.closed, [[len(z) for z in atom] for atom in self.zones]

    def moved(self, other):
        """Largest distance of ends from those of a state with the same shape."""
        ends = [[x for atom in s.zones for z in atom for ends in z for x in ends] for s in (self, other)]
        return max((abs(x - y) for x, y in zip(*ends, strict=True)), default=mpf(0))


class Singular(Exception):
    """The structure can move."""


class Solution:
    """The beam in a given state: a linear problem. `bed`: springs at all marks, against rigid motions."""

    def __init__(self, problem, state, bed=0):
        self.problem, self.state, self.bed = problem, state, bed
        self.cells, self.rows = [], []
        zero, one = mpf(0), mpf(1)
        self.columns = [[zero] * 4, [one, zero, zero, zero], [zero, one, zero, zero]]
        before, reactions, couples, seen = [], {}, {}, {}
        for i, atom in enumerate(problem.atoms):
            self.pass_point(atom.a, reactions, couples, seen)
            marks = {atom.a, atom.b, *(x for z in state.zones[i] for ends in z for x in ends)}
            for a, b in itertools.pairwise(sorted(marks)):
                at = zip(atom.terms, state.zones[i], strict=True)
                acting = tuple(t.side == 0 or any(p < (a + b) / 2 < q for p, q in z) for t, z in at)
                cell = problem.stretch(i, a, b, acting)
                self.cells.append(cell)
                before.append([*map(list, self.columns)])
                self.columns = [carried(cell, c, n == 0) for n, c in enumerate(self.columns)]
        self.pass_point(problem.length, reactions, couples, seen)
        self.rows += [[c[2] for c in self.columns], [c[3] for c in self.columns]]
        self.factors = [one, *solved(self.rows, len(self.columns) - 1, problem.growth)]
        starts = [[self.total(v) for v in zip(*y, strict=True)] for y in before]
        self.pieces = [(c, c.series(y)) for c, y in zip(self.cells, starts, strict=True)]
        self.final = [self.total(v) for v in zip(*self.columns, strict=True)]
        self.held = []
        for j, s in enumerate(problem.supports):
            w, psi = (self.total(v) for v in seen[j])
            force = self.factors[reactions[j]] if j in reactions else mpf(0)
            if state.closed[j] and s.stiffness != mp.inf:
                force = s.stiffness * (w - s.target)
            couple = self.factors[couples[j]] if j in couples else -s.rotation * psi if s.rotation else mpf(0)
            self.held.append(Held(s.x, w, force, couple, state.closed[j]))

    def total(self, parts):
        """A linear form of the unknowns."""
        return mp.fdot(zip(parts, self.factors, strict=False))

    def unknown(self, component):
        """A new unknown that adds to a component of what follows; its number."""
        self.columns.append([mpf(i == component) for i in range(4)])
        return len(self.columns) - 1

    def pass_point(self, x, reactions, couples, seen):
        """What acts at a point."""
        problem = self.problem
        turned = x in problem.couples or any(s.x == x and s.rotation for s in problem.supports)
        if x in problem.hinges:
            if turned:
                raise ValueError("a couple at a hinge")
            self.rows.append([c[2] for c in self.columns])
            self.unknown(1)
        self.columns[0][2] += problem.couples.get(x, 0)
        self.columns[0][3] -= problem.forces.get(x, 0)
        w, psi = ([c[i] for c in self.columns] for i in (0, 1))
        for j, s in enumerate(problem.supports):
            if s.x != x:
                continue
            seen[j] = w, psi
            if self.state.closed[j] and s.stiffness == mp.inf:
                self.rows.append([w[0] - s.target, *w[1:]])
                reactions[j] = self.unknown(3)
            elif self.state.closed[j]:
                self.push(3, s.stiffness, [w[0] - s.target, *w[1:]])
            if s.rotation == mp.inf:
                self.rows.append(psi)
                couples[j] = self.unknown(2)
            elif s.rotation:
                self.push(2, -s.rotation, psi)
        if self.bed:
            self.push(3, self.bed, w)

    def push(self, component, factor, form):
        """Add a multiple of a form in the unknowns to a component."""
        for c, v in zip(self.columns, form, strict=False):
            c[component] += factor * v

    def at(self, x, side):
        """(w, psi, M, V)."""
        if not 0 <= x <= self.problem.length:
            raise ValueError("not on the beam")
        ends = [c.b for c in self.cells]
        i = bisect.bisect_left(ends, x) if side == "left" else bisect.bisect([c.a for c in self.cells], x) - 1
        if x == (self.problem.length if side == "right" else 0):
            return tuple(self.final) if x else (*(s[0] for s in self.pieces[0][1][:2]), mpf(0), mpf(0))
        cell, series = self.pieces[i]
        return tuple(value(s, (x - cell.a) / cell.h) for s in series)


def carried(cell, y, loaded):
    """A column at the end of a stretch."""
    matrix, rest = cell.transfer
    return [mp.fdot(zip(row, y, strict=True)) + (r if loaded else 0) for row, r in zip(matrix, rest, strict=True)]


def solved(rows, n, growth):
    """Solution x of sum over j >= 1 of row[j] x[j] = -row[0]; rows may be short."""
    rows = [[*r[1:], *[mpf(0)] * (n + 1 - len(r)), -r[0]] for r in rows]
    if len(rows) != n:
        raise Singular
    scale = [max(abs(r[j]) for r in rows) or mpf(1) for j in range(n)]
    rows = [[v / s for v, s in zip(r, [*scale, 1], strict=True)] for r in rows]
    rows = [[v / (max(map(abs, r[:n])) or 1) for v in r] for r in rows]
    least = mpf(10) ** -(2 * growth / mp.ln(10) + 25)
    for j in range(n):
        k = max(range(j, n), key=lambda i: abs(rows[i][j]))
        if abs(rows[k][j]) < least:
            raise Singular
        rows[j], rows[k] = rows[k], rows[j]
        for i in range(j + 1, n):
            if rows[i][j]:
                f = rows[i][j] / rows[j][j]
                rows[i] = [a - f * b if b else a for a, b in zip(rows[i], rows[j], strict=True)]
    x = [mpf(0)] * n
    for j in reversed(range(n)):
        x[j] = (rows[j][n] - mp.fdot(rows[j][j + 1 : n], x[j + 1 :])) / rows[j][j]
    return [v / s for v, s in zip(x, scale, strict=True)]
