"""A scene in rational numbers: what a given contact state gives, over the load factor, and whether anything can stand.

The forms and their equations are those of `oracle/equilibrium.py`. Here no scheme is looked for by enumeration: the program's own
scheme is solved exactly and its signs are read. Whether an equilibrium exists is decided without any scheme, from body to
body between the hinges, so beams may have as many hinges and supports as one likes.
"""

import copy
from dataclasses import dataclass
from fractions import Fraction

from oracle import Oracle, Redundant
from oracle.forms import reduce_rows

ZERO = Fraction(0)


class NoSolution(Exception):
    """A scheme in which the loads cannot be carried at all."""


@dataclass
class Affine:
    """The unknowns of one scheme over the load factor: `constant` + factor `rate`.

    Attributes
    ----------
    constant, rate : list of Fraction
        Including the weights of dead and live loads at the end.
    loose : bool
        Whether some part may lie in other places with the same forces.
    """

    constant: list
    rate: list
    loose: bool

    def at(self, factor):
        """The unknowns at one load factor, as a fraction."""
        return [a + factor * b if b else a for a, b in zip(self.constant, self.rate, strict=True)]


class Exact(Oracle):
    """A scene made ready for exact solution in given schemes.

    Parameters
    ----------
    scene : dict
        A scene with the names of the file format.
    """

    def scheme(self, closed, factor):
        """What one scheme gives.

        Parameters
        ----------
        closed : sequence of bool
            One entry for every one-sided support.
        factor : Fraction
            Load factor at which it must have a solution.

        Returns
        -------
        Affine

        Raises
        ------
        NoSolution
            Nothing holds the loads in this scheme.
        Redundant
            Its forces are not unique.
        """
        rows = self.fixed_rows + [
            self.contact_row(i) if c else self.open_row(i) for i, c in zip(self.one_sided, closed, strict=True)
        ]
        size = self.unknowns
        made = [[*entries, right[0] + right[1], right[2]] for entries, right in rows]
        reduced, pivots = reduce_rows(made, size)
        if any(row[-2] + factor * row[-1] for row in reduced[len(pivots) :]):
            raise NoSolution
        constant, rate = [ZERO] * size, [ZERO] * size
        for row, column in zip(reduced, pivots, strict=False):
            constant[column], rate[column] = row[-2], row[-1]
        loose = len(pivots) < size
        if loose and any(vector[k] for vector in self._free(reduced, pivots) for k in range(2, self.kink_column)):
            raise Redundant
        return Affine([*constant, Fraction(1), ZERO], [*rate, ZERO, Fraction(1)], loose)

    def _free(self, reduced, pivots):
        """Null vectors of reduced rows."""
        for free in (c for c in range(self.unknowns) if c not in pivots):
            vector = [ZERO] * self.unknowns
            vector[free] = Fraction(1)
            for row, column in zip(reduced, pivots, strict=False):
                vector[column] = -row[free]
            yield vector

    def measure(self, closed, i, values):
        """Push of a closed or distance of an open one-sided support; negative where the scheme is wrong."""
        return self.push(i, values) if closed[self.one_sided.index(i)] else self.distance(i, values)

    def wrong(self, closed, values):
        """One-sided supports at which a scheme has the wrong sign, exactly."""
        return [i for i in self.one_sided if self.measure(closed, i, values) < 0]

    def settle(self, closed, factor):
        """Find the right scheme from another one: the wrong support of least index changes, as long as there is one.

        Parameters
        ----------
        closed : sequence of bool
        factor : Fraction

        Returns
        -------
        closed : list of bool
        values : list of Fraction

        Raises
        ------
        Redundant
            The forces are not unique in any right scheme.
        NoSolution
            Nothing can stand.
        """
        closed = list(closed)
        for _ in range(200):
            try:
                found = self.scheme(closed, factor)
            except (NoSolution, Redundant):
                break
            values = found.at(factor)
            wrong = self.wrong(closed, values)
            if not wrong:
                return closed, values
            if found.loose:
                break
            k = self.one_sided.index(wrong[0])
            closed[k] = not closed[k]
        solution = self.solve(factor)
        if solution.status not in ("solved", "loose"):
            raise NoSolution(solution.status)
        return [solution.state[i] == "closed" for i in self.one_sided], solution.values

    def course(self, closed, i, found):
        """What `measure` gives over the load factor: its value at 0 and its rate."""
        start, end = (self.measure(closed, i, found.at(Fraction(factor))) for factor in (0, 1))
        return start, end - start

    def interval(self, closed, found):
        """Load factors between which a scheme is right, and the supports that end it there.

        Parameters
        ----------
        closed : sequence of bool
        found : Affine

        Returns
        -------
        low, high : Fraction or None
            None where it goes on for ever.
        below, above : list of int
            The supports that are zero there.
        """
        low = high = None
        below, above = [], []
        for i in self.one_sided:
            g0, g1 = self.course(closed, i, found)
            if not g1:
                continue
            root = -g0 / g1
            if g1 > 0 and (low is None or root >= low):
                below = [*below, i] if root == low else [i]
                low = root
            elif g1 < 0 and (high is None or root <= high):
                above = [*above, i] if root == high else [i]
                high = root
        return low, high, below, above


# Whether an equilibrium exists


def stands(beam, factor, leeway=ZERO):
    """Whether an equilibrium exists, by the free motions of the beam, exactly.

    A free motion is straight between hinges, leaves bilateral supports and clamps at rest, and moves no one-sided support
    into its contact, whatever its gap. Going from left to right, all that matters of the bodies passed is the largest work
    that the loads do on them while the hinge between moves by 1 down or up.

    Parameters
    ----------
    beam : Reading
    factor : Fraction
    leeway : Fraction
        Work, as a share of all loads times the largest displacements, that is added (negative: taken away).

    Returns
    -------
    str
        "falls" if the loads do work along a free motion, "indifferent" if they do none along some, "stands" if they do
        negative work along all or there is none.
    """
    extra = leeway * beam.load_size()
    best = {1: ZERO, -1: ZERO}  # work on all bodies so far while the last cut moves by that; None: it cannot
    indifferent = False
    for body in beam.bodies:
        (left, right), rows = body.work(factor), body.rows
        work = {s: None if best[s] is None else best[s] + left * s + extra for s in best}
        for s in best:  # the right end stays
            if work[s] is not None and all(held(c * s, bilateral) for c, _, bilateral in rows):
                if work[s] > 0:
                    return "falls"
                indifferent = indifferent or work[s] == 0
        best = {s: best_work(work, right * s + extra, rows, s) for s in best}
    for s in best:
        if best[s] is not None and best[s] >= 0:
            if best[s] > 0:
                return "falls"
            indifferent = True
    return "indifferent" if indifferent else "stands"


def held(value, bilateral):
    """Whether a displacement away from a support is one that it allows."""
    return value == 0 if bilateral else value >= 0


def best_work(work, own, rows, s):
    """Largest work while the right end of a body moves by s; None if it cannot."""
    low, high = None, None
    for c, d, bilateral in rows:
        if c == 0:
            if not held(d * s, bilateral):
                return None
            continue
        end = -d * s / c
        if bilateral or c > 0:
            low = end if low is None else max(low, end)
        if bilateral or c < 0:
            high = end if high is None else min(high, end)
    if low is not None and high is not None and low > high:
        return None
    found = []
    for side in (1, -1):  # moves of the left end down, and up
        if work[side] is None:
            continue
        a, b = (low, high) if side > 0 else (None if high is None else -high, None if low is None else -low)
        a = ZERO if a is None else max(a, ZERO)
        if b is not None and b < a:
            continue
        found.append(a * work[side])
        if b is not None:
            found.append(b * work[side])
    if (low is None or low <= 0) and (high is None or high >= 0):
        found.append(ZERO)
    return max(found) + own if found else None


def moves_freely(beam, values, leeway=ZERO):
    """Whether a beam can move, however little, from a state without any change of the forces.

    Parameters
    ----------
    beam : Exact
    values : list of Fraction
        The unknowns of a right scheme.
    leeway : Fraction
        Share of all loads and of the largest contact level up to which forces and distances count as none.

    Returns
    -------
    bool
    """
    force, way = leeway * beam.load_size(), leeway * max((abs(beam.acting_level(i)) for i in beam.one_sided), default=ZERO)
    free = copy.copy(beam)
    vars(free).pop("bodies", None)
    free.loads, free.supports, free.one_sided = [], [dict(support) for support in beam.supports], []
    for i in beam.one_sided:
        if beam.push(i, values) > force:
            continue  # it holds both ways
        free.one_sided.append(i)
        if beam.distance(i, values) > way:
            free.supports[i]["stiffness"] = 0  # as good as absent
    return stands(free, ZERO) == "indifferent"


def falls_surely(beam, factor, leeway=Fraction(1, 10**12)):
    """Whether an equilibrium exists, and whether this stays so if the loads do a little more or less work.

    Returns
    -------
    falls : bool
    sharp : bool
    """
    falls = stands(beam, factor) == "falls"
    other = stands(beam, factor, -leeway if falls else leeway) == "falls"
    return falls, falls == other
