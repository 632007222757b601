"""A scene condensed to its supports that are not linear, and the ways on from a state of it, in rational numbers.

The beam comes from the initial-parameter forms of the reference solution (`equilibrium.py`). What belongs to the beam
alone is eliminated once; what is left is one relation for the supports that are not linear,

    P d + Q r = g_dead + lambda g_live,

with d their displacements towards the support and r their pushes, both in the direction of the side. Each
support runs along a polyline (d, r): an open ray, the pieces of its law, a last ray. In one cell (a piece
for every support) the solutions form a line.
"""

import math
from dataclasses import dataclass
from fractions import Fraction

from .curves import ONE, ZERO, Columns, curve_of, signature
from .equilibrium import Oracle
from .forms import dot, null_space, reduce_rows


class Loose(Exception):
    """Part of the beam can move, or forces can change, without any of the supports with laws."""


class Beam(Oracle):
    """The linear part of a scene; supports that are not linear are only forces."""

    def load_column(self, load):
        """Column of the dead loads or of all others."""
        return self.unknowns + (load.get("case", "live") != "dead")


@dataclass
class Way:
    """A direction in which the path can go on.

    Attributes
    ----------
    pieces : tuple of int
        The piece of every support.
    places : list of Fraction
        Parameter of every support on its piece.
    rates : list of Fraction
        Rates of these parameters.
    rate : Fraction
        Rate of the load factor.
    index, drops, null : int
        Negative eigenvalues (vertical drops included), drops, zero eigenvalues.
    turns : tuple of int
        For every support 1 or -1 where it leaves a kink forward or back, else 0.
    heading : tuple of Fraction
        Rates of (d, r, load factor), scaled to compare ways.
    """

    pieces: tuple
    places: list
    rates: list
    rate: Fraction
    index: int
    drops: int
    null: int
    turns: tuple
    heading: tuple


class Problem:
    """A scene condensed to its supports that are not linear.

    Parameters
    ----------
    scene : dict
        With the names of the file format: supports linear, one-sided or with `law` (points); no foundation.

    Attributes
    ----------
    which : list of int
        Indices of the supports that are not linear, in the scene.
    sign : list of int
        1 for `below` and `both`, -1 for `above`.
    curves : list of Curve
    P, Q : list of list of Fraction
    g : (list, list) of Fraction
        Right sides of the dead (with settlements and lacks of fit) and of the live loads.
    """

    def __init__(self, scene):
        self.scene = scene
        supports = scene["supports"]
        self.which = [i for i, s in enumerate(supports) if "law" in s or s.get("side", "both") != "both"]
        self.sign = [-1 if supports[i].get("side") == "above" else 1 for i in self.which]
        self.curves = [curve_of(supports[i]) for i in self.which]
        bare = {"law", "stiffness", "gap", "settlement", "unloading", "side"}
        linear = [
            {**{key: v for key, v in s.items() if key not in bare}, "side": "below"} if i in self.which else s
            for i, s in enumerate(supports)
        ]
        self.beam = Beam({**scene, "supports": linear})
        self.condense(supports)
        self.prepare_stiffness()

    def condense(self, supports):
        """Eliminate everything but displacements and pushes of the supports `which`."""
        beam, m = self.beam, len(self.which)
        forces = [beam.force_column + i for i in self.which]
        self.kept = [c for c in range(beam.unknowns) if c not in forces]
        rows = []
        for entries, (constant, dead, live) in beam.fixed_rows:
            pushes = [s * entries[c] for s, c in zip(self.sign, forces, strict=True)]
            rows.append([*(entries[c] for c in self.kept), *[ZERO] * m, *pushes, constant + dead, live])
        self.shift = []
        for k, i in enumerate(self.which):
            form, s = beam.form(beam.supports[i]["x"], 0), self.sign[k]
            shift = -s * Fraction(supports[i].get("settlement", 0.0))
            if supports[i].get("side", "both") != "both":
                shift -= min(ZERO, Fraction(supports[i].get("gap", 0.0)))
            self.shift.append(shift)
            own = [ONE if j == k else ZERO for j in range(m)]
            pushes = [-s * z * form[c] for z, c in zip(self.sign, forces, strict=True)]
            rows.append(
                [*(-s * form[c] for c in self.kept), *own, *pushes, s * form[-2] + shift, s * form[-1]]
            )
        reduced, pivots = reduce_rows(rows, len(self.kept))
        if len(pivots) < len(self.kept):
            raise Loose
        self.inner = reduced[: len(self.kept)]
        rest = [row[len(self.kept) :] for row in reduced[len(self.kept) :]]
        for row in rest:  # whole numbers keep the gcds short
            scale = math.lcm(*(entry.denominator for entry in row))
            row[:] = [entry * scale for entry in row]
        self.P = [row[:m] for row in rest]
        self.Q = [row[m : 2 * m] for row in rest]
        self.g = [row[2 * m] for row in rest], [row[2 * m + 1] for row in rest]

    def prepare_stiffness(self):
        """Basis Z of the displacements the beam can have at these supports, and its stiffness there."""
        m = len(self.which)
        left = null_space([list(c) for c in zip(*self.Q, strict=True)], m) if m else []
        held = [[dot(row, c) for c in zip(*self.P, strict=True)] for row in left]
        self.basis = null_space(held, m)
        images = []
        for z in self.basis:
            rows = [[*q, -dot(p, z)] for p, q in zip(self.P, self.Q, strict=True)]
            reduced, pivots = reduce_rows(rows, m)
            r = [ZERO] * m
            for row, c in zip(reduced, pivots, strict=False):
                r[c] = row[-1]
            images.append(r)
        self.stiffness = [[-dot(z, r) for r in images] for z in self.basis]
        if self.stiffness != [list(c) for c in zip(*self.stiffness, strict=True)]:
            raise AssertionError("the condensed stiffness is not symmetric: the oracle is wrong")

    def inertia(self, pieces, curves=None):
        """Negative and zero eigenvalues of the tangent stiffness with supports on vertical pieces held, and drops."""
        slopes = [c.slope(k) for c, k in zip(curves or self.curves, pieces, strict=True)]
        n = len(self.basis)
        tangent = [list(row) for row in self.stiffness]
        rigid = []
        for i, slope in enumerate(slopes):
            e = [z[i] for z in self.basis]
            if isinstance(slope, float):
                rigid.append(e)
            elif slope:
                for a in range(n):
                    if e[a]:
                        tangent[a] = [x + slope * e[a] * y for x, y in zip(tangent[a], e, strict=True)]
        free = null_space(rigid, n)
        images = [[dot(row, z) for row in tangent] for z in free]
        negative, null = signature([[dot(a, b) for b in images] for a in free])
        drops = sum(slope == -math.inf for slope in slopes)
        return negative + drops, null, drops

    def ways(self, places, load, back=None, curves=None):
        """All directions the path can go on in from a point of equilibrium.

        Parameters
        ----------
        places : list of (int, Fraction)
            Piece and parameter of every support.
        load : list of Fraction
            Right side of the loads that change.
        back : tuple of Fraction, optional
            Heading of the way the path came by: its reverse is left out.
        curves : list of Curve, optional
            Other curves than those of the scene.

        Returns
        -------
        ways : list of Way
        loose : bool
            Some cell around has more than one direction in it (they are not among the ways).
        """
        curves = curves or self.curves
        choices = [curve.choices(place) for curve, place in zip(curves, places, strict=True)]
        found, loose = {}, False
        for picked, columns in self.cells(choices, curves):
            lines = columns.add([-g for g in load]).null_lines()
            loose = loose or len(lines) > 1
            for turn in (1, -1) if len(lines) == 1 else ():
                order = sorted(range(len(picked)), key=list(picked).__getitem__)
                way = self.make_way(picked, [turn * lines[0][k] for k in order], turn * lines[0][-1], curves)
                if way and (back is None or tuple(-x for x in way.heading) != back):
                    old = found.get(way.heading)
                    if old is None or way.index < old.index:
                        found[way.heading] = way
        return list(found.values()), loose

    def cells(self, choices, curves):
        """Choices {support: (piece, t, sign)} of every cell, and its columns, those common to cells eliminated once."""
        order = sorted(range(len(choices)), key=lambda i: len(choices[i]))
        stack = [({}, Columns())]
        while stack:
            picked, columns = stack.pop()
            if len(picked) == len(order):
                yield picked, columns
                continue
            i = order[len(picked)]
            for choice in reversed(choices[i]):
                stack.append(({**picked, i: choice}, columns.add(self.column(i, choice[0], curves))))

    def make_way(self, picked, rates, rate, curves):
        """The way with these rates, or None if they leave the cell."""
        chosen = [picked[i] for i in range(len(picked))]
        if any(sign * x < 0 for (_, _, sign), x in zip(chosen, rates, strict=True)):
            return None
        if all(x == 0 for x in rates):
            return None
        pieces = tuple(k for k, _, _ in chosen)
        index, null, drops = self.inertia(pieces, curves)
        heading = [rate]
        for curve, k, x in zip(curves, pieces, rates, strict=True):
            heading += [x * part for part in curve.pieces[k][1]]
        size = sum(map(abs, heading))
        turns = tuple(sign if x else 0 for (_, _, sign), x in zip(chosen, rates, strict=True))
        return Way(
            pieces,
            [t for _, t, _ in chosen],
            rates,
            rate,
            index,
            drops,
            null,
            turns,
            tuple(x / size for x in heading),
        )

    def starts(self, ways, load):
        """The ways a leg can begin with, from a state that is taken to be stable.

        Falling loads are no ways where they are stable (they belong to the reversed load), and motions at constant
        load only if the load does work along them.
        """
        found = []
        for way in ways:
            motion = way.heading[1::2]
            if (
                way.rate > 0
                or (way.rate < 0 and way.index)
                or (way.rate == 0 and dot(self.force(load), motion) > 0)
            ):
                found.append(way)
        return found

    def force(self, load):
        """The loads as forces on the supports held, to their sides; the supports must be able to move one by one."""
        rows, pivots = reduce_rows([[*q, g] for q, g in zip(self.Q, load, strict=True)], len(self.which))
        if len(pivots) < len(self.which):
            raise Loose
        return [row[-1] for row in rows]

    def displacements(self, points, weights):
        """Deflections (down) of the supports `which` from their (d, r); weights of dead and live loads."""
        found = []
        for k, (d, _) in enumerate(points):
            found.append(self.sign[k] * (d - self.shift[k] * weights[0]))
        return found

    def values(self, points, weights):
        """All unknowns of the beam (and the weights), for `Oracle.state_at`."""
        known = [d for d, _ in points] + [r for _, r in points]
        values = [ZERO] * self.beam.unknowns
        for c, row in zip(self.kept, self.inner, strict=True):
            tail = row[len(self.kept) :]
            values[c] = dot(tail[-2:], weights) - dot(tail[:-2], known)
        for i, s, (_, r) in zip(self.which, self.sign, points, strict=True):
            values[self.beam.force_column + i] = s * r
        return [*values, *weights]

    def energy(self, points, weights):
        """Potential energy but for a constant that depends on the weights; None if the stiffness is not regular."""
        m = len(self.which)
        if len(self.basis) < m:
            return None
        load = [dot((a, b), weights) for a, b in zip(*self.g, strict=True)]
        f = self.force(load)
        d = [x for x, _ in points]
        total = dot(d, [dot(row, d) for row in self.stiffness]) / 2 - dot(f, d)
        return total + sum((curve.work(x) for curve, x in zip(self.curves, d, strict=True)), ZERO)

    def column(self, i, k, curves):
        """Column of support i on piece k."""
        u, v = curves[i].pieces[k][1]
        return [u * p[i] + v * q[i] for p, q in zip(self.P, self.Q, strict=True)]
