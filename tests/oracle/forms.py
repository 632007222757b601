"""Exact linear algebra and the initial-parameter forms under the reference solution (`equilibrium.py`).

The beam is integrated from left to right in rational numbers: deflection, rotation, moment and shear at any
x are linear forms in w(0), psi(0), the force of every support, the couple of every rotational support, the
kink at every hinge, and the loads (two last columns: dead, live).
"""

import bisect
import itertools
import math
from fractions import Fraction
from functools import cached_property


def inverse(stiffness):
    """Compliance as a fraction; 0 for an infinite stiffness."""
    return Fraction(0) if math.isinf(stiffness) else 1 / Fraction(stiffness)


def per_span(value, count):
    """A number, or one number per span, as a list."""
    return list(value) if isinstance(value, (list, tuple)) else [value] * count


def reduce_rows(rows, columns):
    """Reduced row echelon form over the first `columns` columns, exactly.

    Parameters
    ----------
    rows : list of list of Fraction
    columns : int

    Returns
    -------
    rows : list of list of Fraction
    pivots : list of int
        Pivot column of each leading row.
    """
    rows = [list(row) for row in rows]
    pivots = []
    for column in range(columns):
        top = len(pivots)
        candidates = [i for i in range(top, len(rows)) if rows[i][column]]
        if not candidates:
            continue
        best = min(candidates, key=lambda i: sum(1 for entry in rows[i] if entry))
        rows[top], rows[best] = rows[best], rows[top]
        pivot = rows[top][column]
        rows[top] = [entry / pivot if entry else entry for entry in rows[top]]
        for i, row in enumerate(rows):
            factor = row[column]
            if i != top and factor:
                rows[i] = [a - factor * b if b else a for a, b in zip(row, rows[top], strict=True)]
        pivots.append(column)
    return rows, pivots


def null_space(rows, columns):
    """Exact basis of the null space of `rows`, as a list of vectors."""
    reduced, pivots = reduce_rows(rows, columns)
    basis = []
    for free in (c for c in range(columns) if c not in pivots):
        vector = [Fraction(0)] * columns
        vector[free] = Fraction(1)
        for row, column in zip(reduced, pivots, strict=False):
            vector[column] = -row[free]
        basis.append(vector)
    return basis


def dot(a, b):
    """Scalar product that skips zeros."""
    return sum((x * y for x, y in zip(a, b, strict=True) if x and y), Fraction(0))


def cone_rays(rows, size):
    """Generators of the cone {c: rows c >= 0}: both signs of its lineality space, and its extreme rays."""
    rays = []
    for vector in null_space(rows, size):
        rays += [vector, [-entry for entry in vector]]
    _, pivots = reduce_rows(rows, size)  # coordinates of a complement of the lineality space
    if not pivots:
        return rays
    inner = [[row[c] for c in pivots] for row in rows]
    for subset in itertools.combinations(inner, len(pivots) - 1):
        lines = null_space(subset, len(pivots))
        if len(lines) != 1:
            continue
        for sign in (1, -1):
            ray = [sign * entry for entry in lines[0]]
            if all(dot(row, ray) >= 0 for row in inner):
                full = dict(zip(pivots, ray, strict=True))
                rays.append([full.get(c, Fraction(0)) for c in range(size)])
    return rays


class Reading:
    """Where everything of a scene is, as fractions.

    Parameters
    ----------
    scene : dict
        A scene with the names of the file format; `law` and `foundation` are not supported.
    """

    def __init__(self, scene):
        beam = scene["beam"]
        self.nodes = list(itertools.accumulate(map(Fraction, beam["spans"]), initial=Fraction(0)))
        self.node_at = {Fraction(float(x)): x for x in self.nodes}
        self.length = self.nodes[-1]
        self.supports = [
            dict(s, x=self.place(s))
            for s in scene.get("supports", [])
            if s.get("direction", "normal") == "normal"
        ]
        self.loads = [
            dict(load, x=self.place(load))
            if "x" in load or "node" in load
            else dict(
                load, start=self.exact_x(load.get("from", 0)), end=self.exact_x(load.get("to", self.length))
            )
            for load in scene.get("loads", [])
            if load["type"] != "axial"
        ]
        self.hinges = [self.exact_x(x) for x in beam.get("hinges", [])]
        self.turning = [i for i, s in enumerate(self.supports) if s.get("rotation", "free") != "free"]
        self.one_sided = [i for i, s in enumerate(self.supports) if s.get("side", "both") != "both"]

    def place(self, item):
        """The x of a support or load as a fraction."""
        return self.exact_x(item["x"]) if "x" in item else self.nodes[item["node"]]

    def exact_x(self, x):
        """An x as a fraction; the sum of the spans where it is that, rounded to a double."""
        return self.node_at.get(Fraction(x), Fraction(x))

    def load_size(self):
        """All loads together, each in full and counted positive, as a force."""
        total = Fraction(0)
        for load in self.loads:
            if "x" in load:
                total += (
                    Fraction(abs(load["F"]))
                    if load["type"] == "force"
                    else abs(Fraction(load["M"])) / self.length
                )
            elif load["type"] != "curvature":
                q = load["q"] if load["type"] == "linear" else [load["q"]]
                total += max(abs(Fraction(v)) for v in q) * (load["end"] - load["start"])
        return total

    @cached_property
    def bodies(self):
        """The rigid bodies between hinges, from left to right."""
        cuts = [Fraction(0), *sorted(self.hinges), self.length]
        found = [Body(a, b) for a, b in itertools.pairwise(cuts)]

        def holding(x):
            return found[max(bisect.bisect_left(cuts, x) - 1, 0)]

        for i, support in enumerate(self.supports):
            holding(support["x"]).hold(support, i in self.turning, i not in self.one_sided)
        for load in self.loads:
            if "x" in load:
                holding(load["x"]).add_at_point(load)
            elif load["type"] != "curvature":
                first, last = (max(bisect.bisect_left(cuts, load[end]) - 1, 0) for end in ("start", "end"))
                for body in found[first : last + 1]:
                    body.add_along(load)
        return found


class Body:
    """A part of the beam from a to b that moves as a rigid body, by the displacements of its ends.

    Attributes
    ----------
    a, b : Fraction
    rows : list of (Fraction, Fraction, bool)
        What its supports ask: coefficients of the two displacements whose sum must be 0 or more; True: 0.
    """

    def __init__(self, a, b):
        self.a, self.b, self.rows = a, b, []
        self._work = {"dead": [Fraction(0), Fraction(0)], "live": [Fraction(0), Fraction(0)]}

    def hold(self, support, turns, bilateral):
        """Add a support; one without stiffness asks for nothing."""
        if turns:
            self.rows.append((Fraction(-1), Fraction(1), True))
        if support.get("stiffness") != 0:
            share = (support["x"] - self.a) / (self.b - self.a)
            sign = -1 if support.get("side") == "below" else 1
            self.rows.append((sign * (1 - share), sign * share, bilateral))

    def _add(self, load, left, right):
        work = self._work[load.get("case", "live")]
        work[0] += left
        work[1] += right

    def add_at_point(self, load):
        """Add a force or a couple."""
        length = self.b - self.a
        if load["type"] == "force":
            amount, share = Fraction(load["F"]), (load["x"] - self.a) / length
            self._add(load, amount * (1 - share), amount * share)
        else:
            turn = Fraction(load["M"]) / length
            self._add(load, -turn, turn)

    def add_along(self, load):
        """Add what a distributed load does on this body."""
        start, end = max(load["start"], self.a), min(load["end"], self.b)
        if start >= end:
            return
        q0, q1 = (Fraction(load["q"]),) * 2 if load["type"] == "uniform" else map(Fraction, load["q"])
        slope = (q1 - q0) / (load["end"] - load["start"])
        first, last, h = q0 + slope * (start - load["start"]), q0 + slope * (end - load["start"]), end - start
        total = (first + last) * h / 2
        about = (first + 2 * last) * h * h / 6 + total * (start - self.a)
        self._add(load, total - about / (self.b - self.a), about / (self.b - self.a))

    def work(self, factor):
        """Work of the loads for a unit displacement of the left and of the right end."""
        dead, live = self._work["dead"], self._work["live"]
        return dead[0] + factor * live[0], dead[1] + factor * live[1]


class Forms(Reading):
    """Linear forms of a scene in its unknowns, and the equations they have to satisfy.

    Parameters
    ----------
    scene : dict
        As for `Reading`.
    """

    def __init__(self, scene):
        super().__init__(scene)
        self.force_column = 2
        self.couple_column = 2 + len(self.supports)
        self.kink_column = self.couple_column + len(self.turning)
        self.unknowns = self.kink_column + len(self.hinges)
        self.stretches = self.stiffness_stretches(scene["beam"], scene.get("sections", []))
        self.integrate()
        self.fixed_rows = self.state_independent_rows()

    def stiffness_stretches(self, beam, sections):
        """List of (from, to, 1/EI, 1/GA); later ones win."""
        count = len(beam["spans"])
        bending, shear = per_span(beam["EI"], count), per_span(beam.get("GA", math.inf), count)
        stretches = [
            (a, b, inverse(EI), inverse(GA))
            for a, b, EI, GA in zip(self.nodes[:-1], self.nodes[1:], bending, shear, strict=True)
        ]
        for section in sections:
            stretches.append(
                (
                    self.exact_x(section.get("from", 0)),
                    self.exact_x(section.get("to", self.length)),
                    inverse(section["EI"]) if "EI" in section else None,
                    inverse(section["GA"]) if "GA" in section else None,
                )
            )
        return stretches

    def compliance(self, x, which):
        """1/EI (`which` = 2) or 1/GA (3) just right of x."""
        return next(s[which] for s in reversed(self.stretches) if s[0] <= x < s[1] and s[which] is not None)

    def integrate(self):
        """Linear forms of (w, psi, M, V) left and right of every breakpoint."""
        xs = {Fraction(0), self.length, *self.hinges, *(s["x"] for s in self.supports)}
        xs.update(*(s[:2] for s in self.stretches))
        xs.update(*([load["x"]] if "x" in load else [load["start"], load["end"]] for load in self.loads))
        self.points = sorted(xs)
        width = self.unknowns + 2
        state = [[Fraction(0)] * width for _ in range(4)]
        state[0][0] = state[1][1] = Fraction(1)
        self.left, self.right, self.pieces = [], [], []
        for x, end in itertools.zip_longest(self.points, self.points[1:]):
            self.left.append([list(form) for form in state])
            self.add_jumps(state, x)
            self.right.append([list(form) for form in state])
            if end is not None:
                self.pieces.append((self.compliance(x, 2), self.compliance(x, 3), self.piece_loads(x, end)))
                state = self.advance(state, self.pieces[-1], end - x)

    def add_jumps(self, state, x):
        """Add what acts at one point to the linear forms."""
        for i, support in enumerate(self.supports):
            if support["x"] == x:
                state[3][self.force_column + i] += 1
        for k, i in enumerate(self.turning):
            if self.supports[i]["x"] == x:
                state[2][self.couple_column + k] += 1
        for k, hinge in enumerate(self.hinges):
            if hinge == x:
                state[1][self.kink_column + k] += 1
        for load in self.loads:
            if load.get("x") == x:
                column = self.load_column(load)
                if load["type"] == "force":
                    state[3][column] -= Fraction(load["F"])
                else:
                    state[2][column] += Fraction(load["M"])

    def load_column(self, load):
        """Column of the dead or of the live loads."""
        return self.unknowns + (load.get("case", "live") == "live")

    def piece_loads(self, start, end):
        """List of (column, q at start, slope of q, kappa) of one piece."""
        found = []
        for load in self.loads:
            if "x" in load or not (load["start"] <= start and end <= load["end"]):
                continue
            q0, slope, kappa = Fraction(0), Fraction(0), Fraction(0)
            if load["type"] == "uniform":
                q0 = Fraction(load["q"])
            elif load["type"] == "linear":
                first, last = map(Fraction, load["q"])
                slope = (last - first) / (load["end"] - load["start"])
                q0 = first + slope * (start - load["start"])
            else:
                kappa = Fraction(load["kappa"])
            found.append((self.load_column(load), q0, slope, kappa))
        return found

    @staticmethod
    def advance(state, piece, h):
        """The forms at distance h from the start of a piece."""
        f, g, loads = piece
        w, psi, M, V = state
        f1, f2, f3 = f * h, f * h**2 / 2, f * h**3 / 6
        new = [
            [a + b * h - f2 * c + (g * h - f3) * d for a, b, c, d in zip(w, psi, M, V, strict=True)],
            [b - f1 * c - f2 * d if c or d else b for b, c, d in zip(psi, M, V, strict=True)],
            [c + d * h if d else c for c, d in zip(M, V, strict=True)],
            list(V),
        ]
        for column, q, slope, kappa in loads:
            new[3][column] -= q * h + slope * h**2 / 2
            new[2][column] -= q * h**2 / 2 + slope * h**3 / 6
            new[1][column] += kappa * h + f * (q * h**3 / 6 + slope * h**4 / 24)
            new[0][column] += (
                kappa * h**2 / 2
                + f * (q * h**4 / 24 + slope * h**5 / 120)
                - g * (q * h**2 / 2 + slope * h**3 / 6)
            )
        return new

    def form(self, x, which):
        """Linear form of w (0), psi (1) or M (2) at a breakpoint, left of it."""
        return self.left[self.points.index(x)][which]

    def row(self, form, constant, extra=()):
        """Equation form + extra = constant as (matrix entries, right side: constant, dead, live)."""
        entries = form[: self.unknowns]
        for column, value in extra:
            entries[column] += value
        return entries, (Fraction(constant), -form[-2], -form[-1])

    def contact_row(self, i):
        """Equation of support i when it acts."""
        support = self.supports[i]
        compliance = inverse(support.get("stiffness", math.inf))
        return self.row(
            self.form(support["x"], 0), self.acting_level(i), [(self.force_column + i, -compliance)]
        )

    def acting_level(self, i):
        """Deflection at which support i begins to act."""
        support = self.supports[i]
        gap = (
            Fraction(support.get("gap", 0.0))
            * {"both": 0, "below": 1, "above": -1}[support.get("side", "both")]
        )
        return Fraction(support.get("settlement", 0.0)) + gap

    def state_independent_rows(self):
        """Equations that hold in every contact state."""
        rows = [self.row(self.right[-1][3], 0), self.row(self.right[-1][2], 0)]
        rows += [self.contact_row(i) for i in range(len(self.supports)) if i not in self.one_sided]
        for k, i in enumerate(self.turning):
            rotation = self.supports[i]["rotation"]
            compliance = inverse(math.inf if rotation == "fixed" else rotation)
            rows.append(
                self.row(self.form(self.supports[i]["x"], 1), 0, [(self.couple_column + k, compliance)])
            )
        return rows + [self.row(self.form(x, 2), 0) for x in self.hinges]

    def open_row(self, i):
        """Equation of support i when it does not act."""
        entries = [Fraction(0)] * self.unknowns
        entries[self.force_column + i] = Fraction(1)
        return entries, (Fraction(0),) * 3
