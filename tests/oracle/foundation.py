"""Reference solution of beams on one-sided foundations, to any number of digits, by a method unlike the engine's.

The beam is cut into stretches, each with its solution as a Taylor series of the differential equation; they are
marched through from left to right (initial parameters; more digits make up for growing exponentials). Where a
foundation acts is found by repetition: all zeros of its closing are the new ends. At the end the state is checked
anew against the scene: the law at many places, the sign of every support.

Conventions where the documents leave the choice open:

* Every law is a sum of terms k_j max(0, s w - g_j), s = 1 below, -1 above. Side "both" means both sides, each with
  the gap; where that is zero everywhere the first piece is one bilateral term that acts everywhere.
* A contact zone is where the law has been reached (its force may be zero); touching is no contact. Zones and gaps
  shorter than 10**(-digits/2) of the beam are dropped.
* Settlements, lacks of fit and dead loads act in full at any factor; rotational restraints act whatever the contact.
* A couple or a rotational restraint at a hinge is refused, as are vertical and falling pieces of a foundation's law.

Signs: docs/method.md; resultants and reactions are forces on the beam, positive upward.

Examples
--------
>>> beam = {"spans": [2.0], "EI": 1.0}
>>> answer = solve({"beam": beam, "foundation": [{"k": 4.0, "side": "below"}], "loads": [{"type": "uniform", "q": 2.0}]})
>>> answer.status, float(answer.w(1)), [float(z.resultant) for z in answer.contact[0]]
('solved', 0.5, [4.0])
"""

import itertools
from dataclasses import dataclass, field

from mpmath import mp, mpf

from .rigid import Motions, rough_state
from .series import slope, value, zeros
from .winkler import SIDES, Problem, Singular, Solution, State, number, pair


@dataclass
class Zone:
    """A stretch of contact; `start`, `end` may be used as (from, to)."""

    start: mpf
    end: mpf
    side: int
    resultant: mpf


@dataclass
class Answer:
    """What `solve` gives.

    Attributes
    ----------
    status : str
        "solved"; "no-equilibrium" (a rigid motion does work that nothing can take up: sure); "free" (the load is in
        balance, but some rigid motion is resisted by nothing, so deflections are not unique; mostly without
        values); "unknown" (given up; never a wrong answer).
    supports : list of Held
    contact : list of list of Zone
        For every foundation, from left to right.
    margin : mpf
        How far the state is from another one, relative: least reaction, opening, slope at ends of zones. Small
        (1e-9, say): a tie, where zones and states need not be unique.
    solves : int
    digits : int
        Of the working precision.
    """

    status: str
    supports: list = field(default_factory=list)
    contact: list = field(default_factory=list)
    margin: object = 0
    solves: int = 0
    digits: int = 15
    solution: object = field(default=None, repr=False)

    def at(self, x, side="right"):
        """(w, psi, M, V) at x, to the left or to the right of what acts there."""
        with mp.workdps(self.digits):
            return self.solution.at(number(x), side)

    def w(self, x):
        """Deflection."""
        return self.at(x)[0]

    def rotation(self, x, side="right"):
        """Rotation of the section."""
        return self.at(x, side)[1]

    def moment(self, x, side="right"):
        """Bending moment."""
        return self.at(x, side)[2]

    def shear(self, x, side="right"):
        """Shear force."""
        return self.at(x, side)[3]

    def pressure(self, x):
        """Pressure of all foundations on the beam, upward; at their ends that inside."""
        with mp.workdps(self.digits):
            problem = self.solution.problem
            return mp.fsum(pressure(f, number(x), self.w(x), problem) for f in problem.foundation)

    def extremes(self, name):
        """((largest value, x), (least value, x)) of "w", "rotation", "moment" or "shear", at jumps of either side."""
        with mp.workdps(self.digits):
            column, found = ["w", "rotation", "moment", "shear"].index(name), []
            for cell, series in self.solution.pieces:
                s = series[column]
                for tau in (mpf(0), *zeros(slope(s))[0], mpf(1)):
                    found.append((value(s, tau), cell.a + tau * cell.h))
            return max(found), min(found)


def solve(scene, factor=1, digits=40):
    """The state of a scene at a load factor.

    Parameters
    ----------
    scene : dict
        As in the scene format; numbers may be mpmath's or fractions too.
    factor : number
        Of all loads but dead ones.
    digits : int
        Ends of zones are exact to 10**(5 - digits) of the beam at least.

    Returns
    -------
    Answer
    """
    with mp.workdps(30):
        growth = Problem(scene, factor).growth
    working = digits + 40 + int(2 * growth / mp.ln(10))
    with mp.workdps(working):
        problem = Problem(scene, factor)
        motions = Motions(problem)
        if motions.some_work():
            return Answer("no-equilibrium")
        search = Search(problem, digits)
        try:
            solution = search.from_elements() or search.run(search.full()) or search.all_schemes()
        except Singular:
            return Answer("free", solves=search.solves)
        if solution is None:
            return Answer("free" if motions.some_without_work() else "unknown", solves=search.solves)
        contact = [zones_of(solution, i) for i in range(len(problem.foundation))]
        margin = check(solution, contact, search)
        free = margin < mpf(10) ** -(digits // 2) and motions.some_without_work()
        return Answer("free" if free else "solved", solution.held, contact, margin, search.solves, working, solution)


class Redundant(Exception):
    """Two rigid supports hold the same."""


class Search:
    """Repetition of linear solutions until the state agrees with the solution."""

    def __init__(self, problem, digits):
        self.problem, self.digits, self.solves = problem, digits, 0
        self.least = problem.length * mpf(10) ** -(digits // 2)  # zones and gaps
        self.near = problem.length * mpf(10) ** (5 - digits)
        self.tiny = mpf(10) ** -(digits + 10)
        force = mp.fsum(abs(v) for v in [*problem.forces.values(), *(c.q[0] * (c.b - c.a) for c in problem.atoms)])
        force += mp.fsum(map(abs, problem.couples.values())) / problem.length
        bend = force * problem.length / min(c.EI for c in problem.atoms) + max(abs(c.kappa) for c in problem.atoms)
        moved = max([abs(s.target) for s in problem.supports], default=0)
        self.size = (bend * problem.length**2 + moved or 1) * mpf(10) ** -20  # deflections below are rounding, or ties

    def full(self):
        """Everything acts, of rigid supports at one place only the first."""
        rigid = [s.x if s.stiffness == mp.inf else None for s in self.problem.supports]
        closed = tuple(x is None or x not in rigid[:i] for i, x in enumerate(rigid))
        zones = [[((c.a, c.b),) if t.side else () for t in c.terms] for c in self.problem.atoms]
        return State(closed, zones)

    def linear(self, state, bed=True):
        """Solution for a state; where that can move, on soft springs."""
        self.solves += 1
        try:
            return Solution(self.problem, state)
        except Singular:
            if not bed:
                raise
        stiffest = max(c.EI for c in self.problem.atoms)
        try:
            return Solution(self.problem, state, stiffest / self.problem.length**3 / 1000)
        except Singular:
            raise Redundant from None

    def run(self, state, limit=60, fixed=False):
        """The solution whose state agrees with it, or None after too many steps; `fixed`: leave supports alone."""
        for _ in range(limit):
            try:
                solution = self.linear(state)
            except Redundant:
                return None
            new = self.state_of(solution, fixed)
            if new.shape() == state.shape() and new.moved(state) <= self.near:
                return self.linear(new, bed=False)  # Singular: held by nothing, and the load is in balance
            state = new
        return None

    def from_elements(self):
        """The same from the state of a rough finite element solution in doubles."""
        closed, zones = rough_state(self.problem)
        return self.run(State(closed, zones))

    def all_schemes(self):
        """The same with every choice of acting supports in turn."""
        sides = [s.side for s in self.problem.supports]
        if sum(map(bool, sides)) > 6:
            return None
        zones = rough_state(self.problem)[1]
        for closed in itertools.product(*((True, False) if side else (True,) for side in sides)):
            solution = self.run(State(closed, zones), 20, fixed=True)
            if solution and self.state_of(solution).closed == closed:
                return solution
        return None

    def state_of(self, solution, fixed=False):
        """The state that belongs to the deflections and forces of a solution; sets `margin`."""
        problem, old, closed = self.problem, solution.state, []
        size_w = max([self.size, *(abs(c) for _, s in solution.pieces for c in (s[0][0], mp.fsum(s[0])))])
        size_r = sum(map(abs, problem.forces.values())) + max([abs(h.reaction) for h in solution.held], default=0) or 1
        self.margin = mpf(1)
        for s, h in zip(problem.supports, solution.held, strict=True):
            over = s.side * h.reaction / size_r if h.closed else s.side * (h.deflection - s.target) / size_w
            if s.side:
                self.margin = min(self.margin, abs(over))
            keep = fixed or not s.side
            closed.append(h.closed if keep else over >= -self.tiny if h.closed else over > self.tiny)
        cells = [list(g) for _, g in itertools.groupby(solution.pieces, key=lambda piece: id(piece[0].atom))]
        zones = [
            [self.zones(atom_cells, n, size_w) if t.side else () for n, t in enumerate(atom_cells[0][0].atom.terms)]
            for atom_cells in cells
        ]
        return State(tuple(closed) if not fixed else old.closed, zones)

    def zones(self, pieces, n, size):
        """Where term n acts within an atom."""
        term, first, last = pieces[0][0].atom.terms[n], pieces[0][0].a, pieces[-1][0].b
        over = [excess(cell, series, term) for cell, series in pieces]
        signs = [*(f[0] > 0 for f in over), mp.fsum(over[-1]) > 0]
        found = []
        for (cell, _), f, at_ends in zip(pieces, over, itertools.pairwise(signs), strict=True):
            if max(map(abs, f)) <= self.tiny * size:
                self.margin, marks, now = mpf(0), [], cell.acting[n]
            else:
                (marks, touching), now = zeros(f, at_ends, self.tiny * size), at_ends[0]
                for tau in (*marks, *touching):
                    if self.least < cell.a + tau * cell.h - first < last - first - self.least:
                        self.margin = min(self.margin, abs(value(slope(f), tau)) / max(map(abs, f)))
            for p, q in itertools.pairwise([mpf(0), *marks, mpf(1)]):
                if now:
                    found.append((cell.a + p * cell.h, cell.a + q * cell.h if q < 1 else cell.b))
                now = not now
        found = [(p, q) for p, q in joined(found, self.least) if q - p > self.least]
        return tuple((first if p - first < self.least else p, last if last - q < self.least else q) for p, q in found)


def excess(cell, series, term):
    """Series of s w - g in a stretch."""
    f = [term.side * c for c in series[0]]
    f[0] -= term.gap[0] + term.gap[1] * (cell.a - cell.atom.a)
    f[1] -= term.gap[1] * cell.h
    return f


def joined(intervals, least=0):
    """Intervals in order, those joined that are not further apart than `least`."""
    made = []
    for p, q in intervals:
        if made and p - made[-1][1] <= least:
            made[-1] = (made[-1][0], q)
        else:
            made.append((p, q))
    return made


def zones_of(solution, i):
    """Zones of contact of a foundation."""
    zones = []
    for side in (-1, 0, 1):
        extents, forces = [], []
        for cell, series in solution.pieces:
            at_work = [t for t, on in zip(cell.atom.terms, cell.acting, strict=True) if on and t.foundation == i]
            if any(t.first and t.side == side for t in at_work):
                mine = [t for t in at_work if t.side == side or side == 0]
                extents.append((cell.a, cell.b))
                forces.append((cell.a, mp.fsum(push_of(cell, series, t) for t in mine)))
        for p, q in joined(extents):
            zones.append(Zone(p, q, side, mp.fsum(r for x, r in forces if p <= x < q)))
    return sorted(zones, key=lambda z: z.start)


def push_of(cell, series, term):
    """Force of a term on the beam over a stretch, upward."""
    t = cell.a - cell.atom.a
    k0, k1 = term.k[0] + term.k[1] * t, term.k[1] * cell.h
    f = excess(cell, series, term) if term.side else series[0]
    return (term.side or 1) * cell.h * mp.fsum(c * (k0 / (m + 1) + k1 / (m + 2)) for m, c in enumerate(f))


def pressure(item, x, w, problem):
    """Pressure of a foundation on the beam, upward, straight from the scene."""
    start, end = problem.extent(item)
    if not start <= x <= end:
        return mpf(0)

    def between(points):
        points = [tuple(map(number, p)) for p in points]
        for (a, f), (b, g) in itertools.pairwise(points):
            if x <= b and x >= a:
                return f + (g - f) * (x - a) / (b - a)
        return points[0][1] if x < points[0][0] else points[-1][1]

    def force(d):
        if "law" not in item:
            return between(zip((start, end), pair(item["k"]), strict=True)) * d
        law = [(mpf(0), mpf(0)), *(tuple(map(number, p)) for p in item["law"])]
        (a, f), (b, g) = next((piece for piece in itertools.pairwise(law) if d <= piece[1][0]), law[-2:])
        return f + (g - f) * (d - a) / (b - a)

    gap = between(item["profile"] if "profile" in item else zip((start, end), pair(item.get("gap", 0)), strict=True))
    side = SIDES[item.get("side", "both")]
    down, up = w - gap, -w - gap
    return (force(down) if side >= 0 and down > 0 else 0) - (force(up) if side <= 0 and up > 0 else 0)


def covers(extent, cell):
    """Whether a foundation is under a stretch."""
    return extent[0] < (cell.a + cell.b) / 2 < extent[1]


def check(solution, contact, search):
    """Raise unless a solution fulfils every condition of its scene; returns the margin."""
    problem, close = search.problem, mpf(10) ** (8 - search.digits)
    again = search.state_of(solution)
    agrees = again.shape() == solution.state.shape() and again.moved(solution.state) <= search.near
    demand(agrees, "the state is not that of its solution")
    loads = [(c.q[0] + c.q[1] * (c.b - c.a) / 2) * (c.b - c.a) for c in problem.atoms] + [*problem.forces.values()]
    forces = [h.reaction for h in solution.held] + [z.resultant for zones in contact for z in zones]
    size = mp.fsum(map(abs, loads + forces)) + max(abs(c) for _, s in solution.pieces for c in s[3])
    bend = max(c.EI * (abs(c.kappa) + max(map(abs, s[1])) / problem.length) for c, s in solution.pieces)
    size += bend / problem.length or mpf(1)
    demand(abs(mp.fsum(loads) - mp.fsum(forces)) <= close * size, "forces are not in balance")
    for cell, (W, _, _, V) in solution.pieces:
        rate, base, acting = slope(V), cell.a - cell.atom.a, [f for f in problem.foundation if covers(problem.extent(f), cell)]
        for tau in (mpf(j) / 6 for j in range(7)):
            x, t = cell.a + tau * cell.h, base + tau * cell.h
            got = value(rate, tau) / cell.h + cell.atom.q[0] + cell.atom.q[1] * t
            want = mp.fsum(pressure(f, x, value(W, tau), problem) for f in acting)
            demand(abs(got - want) <= close * (size / problem.length + abs(got)), "a law is not kept")
    size_w = max([search.size, *(abs(s[0][0]) for _, s in solution.pieces)])
    for s, h in zip(problem.supports, solution.held, strict=True):
        closing = s.side * (h.deflection - s.target) if s.side else h.deflection - s.target
        force = s.side * h.reaction if s.side else h.reaction
        acts = closing > 0 if s.side and s.stiffness != mp.inf else h.closed
        law = s.stiffness * closing if s.stiffness != mp.inf and acts else 0
        if s.stiffness == mp.inf:
            kept = closing <= close * size_w and (force >= -close * size if s.side else True)
            kept = kept and min(abs(closing) / size_w, abs(force) / size) <= close
        else:
            kept = abs(force - law) <= close * size
        demand(kept, "a support's law is not kept")
    return search.margin


def demand(condition, message):
    """Raise an error unless a condition holds."""
    if not condition:
        raise AssertionError(message)
