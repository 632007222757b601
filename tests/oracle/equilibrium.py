"""Exact reference solution of a scene, by a method unlike the engine's.

The beam is integrated from left to right in rational numbers (initial parameters): deflection, rotation,
moment and shear at any x are linear forms in the unknowns

    w(0), psi(0), the force of every support, the couple of every rotational support, the kink at every hinge

and the loads. The equations (free right end, supports, springs, hinges) are solved exactly with fractions,
so a rigid section is 1/EI = 0, a rigid support is a compliance of 0, and a singular state is singular
without any tolerance. One-sided supports: all contact states are ranked in double precision, the conditions
of the best ones are then decided exactly. Whether an equilibrium exists is decided by the rigid motions
alone.

Signs: deflections and loads positive downward, support forces upward, sagging moments, clockwise couples
and rotations; w' = psi + V/GA, psi' = -M/EI + kappa, M' = V, V' = -q; a couple C makes M jump by +C, a
force P makes V jump by -P.

Examples
--------
>>> scene = {"beam": {"spans": [4.0], "EI": 1.0}, "supports": [{"node": 0}, {"node": 1}],
...          "loads": [{"type": "force", "x": 2.0, "F": 3.0}]}
>>> float(solve(scene).at(2.0).moment)
3.0
"""

import bisect
import itertools
import math
from dataclasses import dataclass, field
from fractions import Fraction

import mpmath
import numpy as np

from .forms import Forms, cone_rays, dot, null_space, reduce_rows

DIGITS = 50
ROUNDING = Fraction(1, 10**11)  # of all loads together: less counts as no work at all


class Redundant(Exception):
    """The support forces are not unique, as with three rigid supports on a rigid beam."""


@dataclass
class Point:
    """Values at one x; mpmath numbers."""

    deflection: mpmath.mpf
    rotation: mpmath.mpf
    moment: mpmath.mpf
    shear: mpmath.mpf


@dataclass
class Solution:
    """What the oracle knows about one load factor; lists are in the order of the scene's supports.

    Attributes
    ----------
    status : str
        "solved", "no-equilibrium", "indifferent" (in equilibrium, but some free motion, as far as one likes,
        costs nothing; no values), or "loose" (the same within clearances; forces are unique, places not).
    motion : list of (float, Fraction)
        For "no-equilibrium": the free motion, piecewise linear, along which the load does positive work.
    reaction, deflection, opening, couple : list of mpf
    state : list of str
    tied : list of bool
        True where the contact is closed without force: "closed" and "open" are both right.
    """

    status: str
    motion: list = field(default_factory=list)
    reaction: list = field(default_factory=list)
    deflection: list = field(default_factory=list)
    opening: list = field(default_factory=list)
    couple: list = field(default_factory=list)
    state: list = field(default_factory=list)
    tied: list = field(default_factory=list)
    values: list = field(default_factory=list, repr=False)
    oracle: object = field(default=None, repr=False)

    def valid_states(self):
        """All contact states that satisfy the conditions (more than one only where a contact is tied).

        Returns
        -------
        set of tuple of str
        """
        choices = [
            ("closed", "open") if tied else (state,)
            for state, tied in zip(self.state, self.tied, strict=True)
        ]
        return set(itertools.product(*choices))

    def at(self, x, side="right"):
        """Exact values at `x`, from the right or the left where they jump.

        Parameters
        ----------
        x : float
        side : str

        Returns
        -------
        Point
        """
        with mpmath.workdps(DIGITS):
            return Point(*(to_mpf(value) for value in self.oracle.state_at(Fraction(x), side, self.values)))


def to_mpf(value):
    """A fraction as an mpmath number of `DIGITS` digits."""
    with mpmath.workdps(DIGITS):
        return mpmath.mpf(value.numerator) / value.denominator


class Oracle(Forms):
    """A scene made ready for exact solution at any load factor.

    Parameters
    ----------
    scene : dict
        A scene with the names of the file format; `law` and `foundation` are not supported.
    """

    def solve(self, factor=1.0):
        """Solution at one load factor.

        Parameters
        ----------
        factor : float

        Returns
        -------
        Solution
        """
        weights = (Fraction(1), Fraction(1), Fraction(factor))
        status, motion = self.stability(weights)
        if status != "solved":
            return Solution(status, motion)
        singular = False
        for state in self.ranked_states(weights):
            values = self.exact(state, weights)
            if values is None:
                singular = True
            elif self.admissible(state, values):
                found = self.describe(state, values)
                found.status = "loose" if self.moves_in_clearance(values) else "solved"
                return found
        raise Redundant("forces are not unique" if singular else "no admissible state: the oracle is wrong")

    def exact(self, closed, weights):
        """Unknowns (and load weights) in one contact state, or None if it is singular."""
        rows = self.fixed_rows + [
            self.contact_row(i) if c else self.open_row(i)
            for i, c in zip(self.one_sided, closed, strict=True)
        ]
        reduced, pivots = reduce_rows(
            [[*entries, dot(right, weights)] for entries, right in rows], self.unknowns
        )
        if len(pivots) < self.unknowns:
            return None
        return [row[-1] for row in reduced] + list(weights[1:])

    def distance(self, i, values):
        """Opening of one-sided support i (negative: penetrated)."""
        w = dot(self.form(self.supports[i]["x"], 0), values)
        return (self.acting_level(i) - w) * (1 if self.supports[i]["side"] == "below" else -1)

    def push(self, i, values):
        """Force of one-sided support i, positive when it pushes."""
        return values[self.force_column + i] * (1 if self.supports[i]["side"] == "below" else -1)

    def admissible(self, closed, values):
        """Whether the contact conditions hold, exactly."""
        return all(
            self.push(i, values) >= 0 if c else self.distance(i, values) >= 0
            for i, c in zip(self.one_sided, closed, strict=True)
        )

    def ranked_states(self, weights):
        """All contact states, the most promising first (judged in double precision)."""
        count = len(self.one_sided)
        states = list(itertools.product((True, False), repeat=count))
        if count == 0:
            return states
        rows = self.fixed_rows + [self.contact_row(i) for i in self.one_sided]
        matrix = np.array([[float(entry) for entry in entries] for entries, _ in rows])
        right = np.array([float(dot(r, weights)) for _, r in rows])
        scale = np.abs(matrix).max(axis=0)
        scale[scale == 0.0] = 1.0
        matrix /= scale
        lines = np.abs(matrix).max(axis=1)
        lines[lines == 0.0] = 1.0
        matrix, right = matrix / lines[:, None], right / lines
        return sorted(states, key=lambda state: self.violation(state, matrix, right))

    def violation(self, closed, matrix, right):
        """Rough measure of how far a contact state is from admissible."""
        count = len(closed)
        system, load = matrix.copy(), right.copy()
        for k, c in enumerate(closed):
            if not c:
                system[k - count] = 0.0
                system[k - count, self.force_column + self.one_sided[k]] = 1.0
                load[k - count] = 0.0
        try:
            values = np.linalg.solve(system, load)
        except np.linalg.LinAlgError:
            return math.inf
        if not np.all(np.isfinite(values)):
            return math.inf
        residual = matrix[-count:] @ values - right[-count:]
        sign = np.array([1.0 if self.supports[i]["side"] == "below" else -1.0 for i in self.one_sided])
        push = sign * values[[self.force_column + i for i in self.one_sided]]
        bad = np.where(
            closed, -push / (np.abs(push).max() or 1.0), sign * residual / (np.abs(residual).max() or 1.0)
        )
        return max(0.0, bad.max()) + (1e3 if np.linalg.cond(system) > 1e14 else 0.0)

    def describe(self, closed, values):
        """The solution as numbers."""
        found = Solution("solved", values=values, oracle=self)
        states = dict(zip(self.one_sided, closed, strict=True))
        for i, support in enumerate(self.supports):
            apart = self.distance(i, values) if i in states and not states[i] else Fraction(0)
            force = values[self.force_column + i]
            touching = i in states and force == 0 and self.distance(i, values) == 0
            found.state.append("bilateral" if i not in states else "open" if apart > 0 else "closed")
            found.tied.append(touching)
            found.reaction.append(to_mpf(force))
            found.deflection.append(to_mpf(dot(self.form(support["x"], 0), values)))
            found.opening.append(to_mpf(apart))
            turned = self.turning.index(i) if i in self.turning else None
            found.couple.append(
                to_mpf(Fraction(0) if turned is None else values[self.couple_column + turned])
            )
        return found

    def state_at(self, x, side, values):
        """Exact (w, psi, M, V) at x for given unknowns."""
        x = self.exact_x(x)
        if x in self.points:
            forms = (self.left if side == "left" else self.right)[self.points.index(x)]
        else:
            k = bisect.bisect(self.points, x) - 1
            forms = self.advance(self.right[k], self.pieces[k], x - self.points[k])
        return [dot(form, values) for form in forms]

    def stability(self, weights):
        """Whether a free motion exists along which the load does work.

        A free motion is rigid between hinges, leaves bilateral supports and rotational springs at rest and
        moves no one-sided support towards its contact. An equilibrium exists if and only if the load does no
        positive work along any of them; it is unique if the work is negative along all.

        Returns
        -------
        status : str
        motion : list of (float, Fraction)
        """
        count = 2 + len(self.hinges)
        held = [self.motion_value(s["x"]) for i, s in enumerate(self.supports) if i not in self.one_sided]
        held += [self.motion_slope(self.supports[i]["x"]) for i in self.turning]
        basis = null_space(held, count)
        if not basis:
            return "solved", []
        leave = [self.leaving(i, basis) for i in self.one_sided]
        size = self.load_size()
        indifferent = False
        for ray in cone_rays(leave, len(basis)):
            vector = [dot(ray, column) for column in zip(*basis, strict=True)]
            xs = [Fraction(0), *sorted(self.hinges), self.length]
            motion = [(float(x), dot(self.motion_value(x), vector)) for x in xs]
            gain, none = self.work(vector, weights), ROUNDING * size * max(abs(w) for _, w in motion)
            if gain > none:
                return "no-equilibrium", motion
            indifferent = indifferent or gain >= -none
        return ("indifferent" if indifferent else "solved"), []

    def leaving(self, i, basis):
        """How far each motion takes the beam away from one-sided support i."""
        sign = -1 if self.supports[i]["side"] == "below" else 1
        return [sign * dot(self.motion_value(self.supports[i]["x"]), vector) for vector in basis]

    def moves_in_clearance(self, values):
        """Whether a solution can be moved a little, freely, between the supports that carry nothing."""
        places = [abs(dot(self.form(s["x"], 0), values)) for s in self.supports]
        none, touch = ROUNDING * self.load_size(), ROUNDING * max(places)
        held = [self.motion_value(s["x"]) for i, s in enumerate(self.supports) if i not in self.one_sided]
        held += [self.motion_slope(self.supports[i]["x"]) for i in self.turning]
        held += [
            self.motion_value(self.supports[i]["x"]) for i in self.one_sided if self.push(i, values) > none
        ]
        basis = null_space(held, 2 + len(self.hinges))
        idle = [
            i for i in self.one_sided if self.push(i, values) <= none and self.distance(i, values) <= touch
        ]
        return bool(basis) and bool(cone_rays([self.leaving(i, basis) for i in idle], len(basis)))

    def motion_value(self, x):
        """Displacement at x of a free motion, as a form in (w(0), slope at 0, kinks)."""
        return [Fraction(1), x] + [max(x - hinge, Fraction(0)) for hinge in self.hinges]

    def motion_slope(self, x):
        """Slope right of x of a free motion, as a form in (w(0), slope at 0, kinks)."""
        return [Fraction(0), Fraction(1)] + [Fraction(x >= hinge) for hinge in self.hinges]

    def work(self, motion, weights):
        """Work of the loads along a free motion."""
        total = Fraction(0)
        for load in self.loads:
            if "x" in load:
                form = (
                    self.motion_value(load["x"]) if load["type"] == "force" else self.motion_slope(load["x"])
                )
                amount = Fraction(load["F"] if load["type"] == "force" else load["M"])
                total += amount * dot(form, motion) * weights[self.load_column(load) - self.unknowns + 1]
        for x, end, (_, _, loads) in zip(self.points[:-1], self.points[1:], self.pieces, strict=True):
            value, slope, h = dot(self.motion_value(x), motion), dot(self.motion_slope(x), motion), end - x
            for column, q, rise, _ in loads:
                area = q * value * h + (q * slope + rise * value) * h**2 / 2 + rise * slope * h**3 / 3
                total += area * weights[column - self.unknowns + 1]
        return total


def solve(scene, factor=1.0):
    """Exact solution of a scene (dict) at one load factor.

    Parameters
    ----------
    scene : dict
    factor : float

    Returns
    -------
    Solution
    """
    return Oracle(scene).solve(factor)
