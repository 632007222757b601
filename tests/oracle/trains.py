"""Exact reference solution of a train on a beam, by events in its place, in rational numbers.

The place s is that of the first axle; axle i is at s - d_i (mirrored: s + d_i) and acts where 0 <= x <= L, both ends
included. The forms of `forms.py` give every value as a linear form in the initial parameters and support forces;
what an axle adds to them is a polynomial in s as long as it passes no breakpoint, so with a fixed set of acting supports
every value is one. Between two places where something passes something

* an equilibrium exists where the load does no positive work along any free motion: roots of polynomials;
* a set of acting supports that is right at one rational place stays right up to the nearest root of odd multiplicity of
  one of its margins; what is left on both sides is done in the same way, so nothing is followed and no set is guessed;
* all places are known to 45 digits, and are equal only where that is proved (`polynomials.py`).

Where an axle is on an end of the beam the values jump; there the state at the place itself stands between the two.

Examples
--------
>>> scene = {"beam": {"spans": [1.0, 1.0], "EI": 1.0}, "supports": [{"node": i, "side": "below"} for i in range(3)],
...          "loads": [{"type": "uniform", "q": 1.0}]}
>>> [(round(float(e.place), 12), e.support, e.event) for e in Passage(scene, {"axles": [[0.0, 8.0]], "to": 1.0}).events]
[(0.194903920083, 2, 'opens'), (0.888199776858, 2, 'closes')]
"""

import itertools
import math
from dataclasses import dataclass, field
from fractions import Fraction

from .forms import Forms, cone_rays, dot, inverse, null_space, reduce_rows
from .polynomials import Place, add, between, multiply, roots, scale, trimmed, value

ZERO, ONE = Fraction(0), Fraction(1)
SIDES = ("left", "right")


class Nothing(Exception):
    """No set of acting supports is right: the motion is free without work."""


@dataclass
class Stretch:
    """Places between two events, or one place where the values jump.

    Attributes
    ----------
    start, end : Place
    home : (Fraction, Fraction)
        Rational places around both within which the polynomials hold.
    status : str
        "solved", "no-equilibrium", or "loose": in equilibrium, but some motion costs nothing.
    state : list of str
        For every support "bilateral", "closed", "open", or "tied" (touches without force all along: either is right).
    unknowns, moving : list
        Polynomials in s: the unknowns, and what the train adds to the forms at every breakpoint.
    """

    start: Place
    end: Place
    home: tuple
    status: str
    state: list = field(default_factory=list)
    unknowns: list = field(default_factory=list, repr=False)
    moving: list = field(default_factory=list, repr=False)

    @property
    def inside(self):
        """A rational place of this stretch, well inside."""
        return between(self.start, self.end) if self.start.middle != self.end.middle else self.start.middle


@dataclass
class Event:
    """A support opens or closes at `place`; from `since` on it touches without force, or there is no unique state."""

    place: Place
    support: int
    event: str
    since: Place


def advanced(state, h, f, g, q=ZERO, kappa=ZERO):
    """(w, psi, M, V), polynomials in s, at the distance h, a polynomial too, under a uniform load and curvature."""
    w, psi, M, V = state
    squared = multiply(h, h)
    cubed = multiply(squared, h)
    return [
        add(
            w, multiply(psi, h), scale(-f / 2, multiply(M, squared)), scale(-f / 6, multiply(V, cubed)),
            scale(g, multiply(V, h)), scale(q * f / 24, multiply(squared, squared)), scale((kappa - g * q) / 2, squared),
        ),
        add(psi, scale(-f, multiply(M, h)), scale(-f / 2, multiply(V, squared)), scale(q * f / 6, cubed), scale(kappa, h)),
        add(M, multiply(V, h), scale(-q / 2, squared)),
        add(V, scale(-q, h)),
    ]


def loaded(state, u, amount, order, f, g):
    """The state with a force (order 0) that acts at the distance u before it, or a uniform load (1) from there on."""
    powers = [[ONE]]
    for k in range(1, 5):
        powers.append(scale(ONE / k, multiply(powers[-1], u)))
    w, psi, M, V = state
    return [
        add(w, scale(amount * f, powers[order + 3]), scale(-amount * g, powers[order + 1])),
        add(psi, scale(amount * f, powers[order + 2])),
        add(M, scale(-amount, powers[order + 1])),
        add(V, scale(-amount, powers[order])),
    ]


class Passage(Forms):
    """A train that passes over a beam, in one direction.

    Parameters
    ----------
    scene : dict
        With the names of the file format; all its loads act with factor 1.
    train : dict
        One of `[[trains]]`; `both_directions` is not looked at.
    mirrored : bool
        The mirrored train, which runs to the left.
    at : sequence of float
        Places whose curves are wanted.
    """

    def __init__(self, scene, train, mirrored=False, at=()):
        watched = [{"type": "force", "x": x, "F": 0.0} for x in at]
        super().__init__({**scene, "loads": [*scene.get("loads", ()), *watched]})
        self.mirrored = mirrored
        factor, sign = Fraction(train.get("factor", 1.0)), 1 if mirrored else -1
        self.axles = [(sign * Fraction(d), factor * Fraction(P)) for d, P in train["axles"]]
        reach = max(abs(e) for e, _ in self.axles)
        self.q, self.tail = factor * Fraction(train.get("q", 0.0)), sign * reach
        low, high = (-reach, self.length) if mirrored else (ZERO, self.length + reach)
        low, high = Fraction(train.get("from", low)), Fraction(train.get("to", high))
        if train.get("inside"):
            low = max(low, ZERO if mirrored else reach)
            high = min(high, self.length - reach if mirrored else self.length)
        self.range = low, high
        self.equations = self.list_equations()
        self.inverses, self.last = {}, tuple(True for _ in self.one_sided)
        held = [self.motion(s["x"]) for i, s in enumerate(self.supports) if i not in self.one_sided]
        self.held = held + [self.turn(self.supports[i]["x"]) for i in self.turning]
        self.rays = self.free_motions(self.held, self.one_sided)
        self.stretches = list(self.follow()) if low <= high else []

    # Motions

    def motion(self, x):
        """Displacement at x as a form in (w(0), slope at 0, kinks)."""
        return [ONE, x] + [max(x - hinge, ZERO) for hinge in self.hinges]

    def turn(self, x):
        """Slope right of x as a form in (w(0), slope at 0, kinks)."""
        return [ZERO, ONE] + [Fraction(x >= hinge) for hinge in self.hinges]

    def free_motions(self, held, leaving):
        """Free motions that keep `held` at rest and move no support of `leaving` towards its contact; their generators."""
        basis = null_space(held, 2 + len(self.hinges))
        away = [[-self.sign(i) * dot(self.motion(self.supports[i]["x"]), v) for v in basis] for i in leaving]
        return [[dot(ray, column) for column in zip(*basis, strict=True)] for ray in cone_rays(away, len(basis))] if basis else []

    def work(self, ray, moving):
        """Work of all loads along a free motion, a polynomial in s: by the moment and shear that the loads alone leave."""
        def alone(k, side, component):
            form = getattr(self, side)[k][component]
            return add([form[-2] + form[-1]], moving[k][side][component])

        V, M = alone(-1, "right", 3), alone(-1, "right", 2)
        total = add(scale(-ray[0], V), scale(ray[1], add(M, scale(-self.length, V))))
        for hinge, kink in zip(self.hinges, ray[2:], strict=True):
            before = alone(self.points.index(hinge), "left", 2)
            total = add(total, scale(kink, add(M, scale(hinge - self.length, V), scale(-ONE, before))))
        return trimmed(total)

    # Equations

    def sign(self, i):
        """1 for a support below, -1 above."""
        return 1 if self.supports[i].get("side") == "below" else -1

    def list_equations(self):
        """Equations of every state as (entries, constant, (breakpoint, side, component)); those of one-sided supports last."""
        def equation(constant, k, side, component, column=None, amount=ZERO):
            form = getattr(self, side)[k][component]
            entries = list(form[: self.unknowns])
            if column is not None:
                entries[column] += amount
            return entries, Fraction(constant) - form[-2] - form[-1], (k, side, component)

        def contact(i):
            support = self.supports[i]
            k, give = self.points.index(support["x"]), -inverse(support.get("stiffness", math.inf))
            return equation(self.acting_level(i), k, "left", 0, self.force_column + i, give)

        found = [equation(0, -1, "right", 3), equation(0, -1, "right", 2)]
        found += [contact(i) for i in range(len(self.supports)) if i not in self.one_sided]
        for column, i in enumerate(self.turning, self.couple_column):
            give = inverse(math.inf if self.supports[i]["rotation"] == "fixed" else self.supports[i]["rotation"])
            found.append(equation(0, self.points.index(self.supports[i]["x"]), "left", 1, column, give))
        found += [equation(0, self.points.index(hinge), "left", 2) for hinge in self.hinges]
        return found + [contact(i) for i in self.one_sided]

    def inverse_of(self, closed):
        """Inverse of the equations of one set of acting supports; None if there is none."""
        if closed not in self.inverses:
            first, rows = len(self.equations) - len(closed), []
            for k, (entries, _, _) in enumerate(self.equations):
                if k >= first and not closed[k - first]:
                    entries = [Fraction(c == self.force_column + self.one_sided[k - first]) for c in range(self.unknowns)]
                rows.append([*entries, *(Fraction(k == j) for j in range(self.unknowns))])
            reduced, pivots = reduce_rows(rows, self.unknowns)
            self.inverses[closed] = [r[self.unknowns :] for r in reduced] if len(pivots) == self.unknowns else None
        return self.inverses[closed]

    def solve_scheme(self, closed, moving):
        """Unknowns as polynomials in s; None if the set is singular."""
        matrix = self.inverse_of(closed)
        if matrix is None:
            return None
        right, first = [], len(self.equations) - len(closed)
        for k, (_, constant, (j, side, component)) in enumerate(self.equations):
            acts = k < first or closed[k - first]
            right.append(add([constant], scale(-ONE, moving[j][side][component])) if acts else [ZERO])
        degrees = [[p[d] if d < len(p) else ZERO for p in right] for d in range(max(map(len, right)))]
        return [[dot(row, column) for column in degrees] for row in matrix]

    def polynomial(self, unknowns, moving, k, side, component):
        """A value at breakpoint k as a polynomial in s."""
        form = getattr(self, side)[k][component]
        static, size = form[-2] + form[-1], max(map(len, unknowns))
        parts = [dot(form[: self.unknowns], [u[d] for u in unknowns]) for d in range(size)]
        return add(parts, [static], moving[k][side][component])

    def margins(self, closed, unknowns, moving):
        """What must not be negative: the force of supports that act, the opening of the others."""
        found = []
        for i, c in zip(self.one_sided, closed, strict=True):
            if c:
                found.append(trimmed(scale(Fraction(self.sign(i)), unknowns[self.force_column + i])))
            else:
                w = self.polynomial(unknowns, moving, self.points.index(self.supports[i]["x"]), "left", 0)
                found.append(trimmed(scale(Fraction(self.sign(i)), add([self.acting_level(i)], scale(-ONE, w)))))
        return found

    def right_scheme(self, m, moving):
        """A set of acting supports that is right at place m."""
        there = [{side: [[value(p, m)] for p in at[side]] for side in SIDES} for at in moving]
        closed, tried = self.last, set()
        order = self.by_distance(closed)
        while closed is not None:
            unknowns = None if closed in tried else self.solve_scheme(closed, there)
            tried.add(closed)
            wrong = [bool(p) and p[0] < 0 for p in self.margins(closed, unknowns, there)] if unknowns else [False]
            if unknowns and not any(wrong):
                self.last = closed
                return closed
            changed = tuple(c != w for c, w in zip(closed, wrong, strict=False))
            closed = changed if unknowns and len(tried) < 8 and changed not in tried else next(order, None)
        raise Nothing

    @staticmethod
    def by_distance(closed):
        """All sets of acting supports, those that differ least from one first."""
        count = len(closed)
        for size in range(count + 1):
            for changed in itertools.combinations(range(count), size):
                yield tuple(c != (k in changed) for k, c in enumerate(closed))

    # The way

    def moving_loads(self, m, exact=False):
        """What the train adds to the forms at every breakpoint, with all of it where it is at m; `exact`: at m alone."""
        def position(e):
            return [m + e] if exact else [e, ONE]

        axles = [(m + e, position(e), P) for e, P in self.axles if 0 <= m + e <= self.length]
        low, high = sorted([(m, position(ZERO)), (m + self.tail, position(self.tail))])
        state, found = [[ZERO]] * 4, []
        for k, (x, end) in enumerate(itertools.zip_longest(self.points, self.points[1:])):
            left, state = state, [*state[:3], add(state[3], *([-P] for at, _, P in axles if at == x))]
            found.append({"left": left, "right": state})
            if end is None:
                return found
            f, g, _ = self.pieces[k]
            state = advanced(state, [end - x], f, g)
            for at, p, P in axles:
                if x < at < end:
                    state = loaded(state, add([end], scale(-ONE, p)), P, 0, f, g)
            begin, finish = max(low, (x, [x])), min(high, (end, [end]))
            if self.q and begin[0] < finish[0]:
                for (_, p), q in ((begin, self.q), (finish, -self.q)):
                    state = loaded(state, add([end], scale(-ONE, p)), q, 1, f, g)

    def follow(self):
        """All stretches, in the order of s."""
        low, high = self.range
        offsets = {e for e, _ in self.axles} | {ZERO, self.tail}
        breaks = sorted({low, high} | {p - e for p in self.points for e in offsets if low < p - e < high})
        for a, b in itertools.zip_longest(breaks, breaks[1:]):
            if low == high or any(a + e in (0, self.length) for e, _ in self.axles):
                yield self.state(a)
            if b is not None:
                yield from self.on_home(a, b)

    def state(self, s):
        """The state at one rational place."""
        s = Fraction(s)
        moving = self.moving_loads(s, exact=True)
        place, works = Place.exact(s), [self.work(ray, moving) for ray in self.rays]
        if any(w and w[0] > 0 for w in works):
            return Stretch(place, place, (s, s), "no-equilibrium")
        return self.settled(place, place, (s, s), s, moving)

    def on_home(self, a, b):
        """Stretches between two places where something passes something."""
        moving = self.moving_loads((a + b) / 2)
        works = [w for w in (self.work(ray, moving) for ray in self.rays) if w]
        cuts = [Place.exact(a)]
        for root in sorted(r for w in works for r, _ in roots(w, a, b)):
            if cuts[-1] < root:
                cuts.append(root)
        cuts.append(Place.exact(b))
        for start, end in itertools.pairwise(cuts):
            m = between(start, end)
            if any(value(w, m) > 0 for w in works):
                yield Stretch(start, end, (a, b), "no-equilibrium")
            else:
                yield from self.settle(start, end, (a, b), moving)

    def settle(self, start, end, home, moving):
        """Stretches between two places where there is an equilibrium all along."""
        if not start < end:
            return []
        middle = between(start, end)
        for part in (ZERO, *(Fraction(k, 64) for k in (3, -3, 7, -7, 11, -11))):
            m = middle + part * (end.low - start.high)
            found = self.settled(start, end, home, m, moving)
            if found:
                return [*self.settle(start, found.start, home, moving), found, *self.settle(found.end, end, home, moving)]
        raise AssertionError("margins vanish everywhere")

    def settled(self, start, end, home, m, moving):
        """The stretch around m; None if some margin is zero there alone."""
        try:
            closed = self.right_scheme(m, moving)
        except Nothing:
            return Stretch(start, end, home, "loose")
        unknowns = self.solve_scheme(closed, moving)
        margins = self.margins(closed, unknowns, moving)
        if start is not end:
            if any(p and value(p, m) == 0 for p in margins):
                return None
            here = Place.exact(m)
            for root, multiplicity in (item for p in margins if p for item in roots(p, *home)):
                if multiplicity % 2:
                    if here < root and root < end:
                        end = root
                    elif root < here and start < root:
                        start = root
        state = ["bilateral"] * len(self.supports)
        for i, c, p in zip(self.one_sided, closed, margins, strict=True):
            state[i] = "tied" if not p else "closed" if c else "open"
        pressed = [self.motion(self.supports[i]["x"]) for i in self.one_sided if state[i] == "closed"]
        free = self.free_motions(self.held + pressed, [i for i in self.one_sided if state[i] == "tied"])
        return Stretch(start, end, home, "loose" if free else "solved", state, unknowns, moving)

    @property
    def events(self):
        """Events in the order of travel (mirrored: s falls); what changed where there is no unique state counts behind it."""
        known, found = {}, []
        for stretch in reversed(self.stretches) if self.mirrored else self.stretches:
            first, last = (stretch.end, stretch.start) if self.mirrored else (stretch.start, stretch.end)
            for i in self.one_sided if stretch.status == "solved" else ():
                new = stretch.state[i]
                if new != "tied":
                    old, since = known.get(i, (new, first))
                    if old != new:
                        found.append(Event(first, i, "opens" if new == "open" else "closes", since))
                    known[i] = (new, last)
        return found

    @property
    def gaps(self):
        """Intervals without equilibrium, as pairs of places in the order of s."""
        found = []
        for stretch in self.stretches:
            if stretch.status == "no-equilibrium":
                if found and found[-1][1] is not None and found[-1][1].same(stretch.start):
                    found[-1] = (found[-1][0], stretch.end)
                else:
                    found.append((stretch.start, stretch.end))
        return found
