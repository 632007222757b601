"""True answers of a free beam on a one-sided foundation: transfer matrices in decimals of many digits.

Another method than the engine's, in another arithmetic: the deflection of every stretch between contact ends and forces is a
power series, carried from left to right with two unknowns, deflection and slope of the left end; growing and fading waves are not
told apart, since the digits outlast them. The ends are corrected by the zeros of the deflection beside them, until none moves,
and then the sign of the gap is asked all along the beam. An equilibrium is unique, so what passes is true.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal, localcontext
from itertools import count, pairwise
from math import factorial
from typing import Any

DIGITS = 140
"""Decimal digits carried; waves over beta L = 40 take 35 of them, the series at the most as many."""
GOOD = 40
"""Digits to which the ends are found."""
MOST_SOLVES = 60
"""Corrections of the ends before giving up."""
SAMPLES = 40
"""Places in every stretch at which the sign of the gap is asked."""

Vector = list[Decimal]
Rows = list[Vector]


@dataclass
class GroundTruth:
    """True values of a beam on a one-sided foundation.

    Attributes
    ----------
    ends : list of Decimal
        Where contact begins and ends inside the beam, from left to right.
    deflection, moment : list of Decimal
        At the places asked for.
    solves : int
        Corrections of the ends.
    """

    ends: list[Decimal]
    deflection: list[Decimal]
    moment: list[Decimal]
    solves: int


def solve_ground(scene: Mapping[str, Any], ends: Sequence[float], x: Sequence[float]) -> GroundTruth:
    """Solve a free beam of one EI on one foundation that cannot pull.

    Parameters
    ----------
    scene : mapping
        One span, one EI, one foundation with k, uniform loads all over, forces at x.
    ends : sequence of float
        About where contact begins and ends inside the beam, from left to right. Whether its left end is in contact is found.
    x : sequence of float
        Places at which values are wanted.

    Returns
    -------
    GroundTruth

    Raises
    ------
    ArithmeticError
        The ends do not come to rest, or the beam is in the ground or held by it where it should not be.

    Examples
    --------
    Long, heavy, one end lifted by 1.5 q/beta: two are free.

    >>> beam = {"beam": {"spans": [30.0], "EI": 1.0}, "foundation": [{"k": 4.0, "side": "below"}],
    ...         "loads": [{"type": "uniform", "q": 1.0}, {"type": "force", "x": 0.0, "F": -1.5}]}
    >>> found = solve_ground(beam, [2.1], [2.0])
    >>> round(found.ends[0], 20), round(found.moment[0], 20)
    (Decimal('2.00000000000000000000'), Decimal('1.00000000000000000000'))
    """
    length, EI, k = (Decimal(v) for v in (scene["beam"]["spans"][0], scene["beam"]["EI"], scene["foundation"][0]["k"]))
    q = sum((Decimal(load["q"]) for load in scene["loads"] if load["type"] == "uniform"), Decimal(0))
    forces = [(Decimal(load["x"]), Decimal(load["F"])) for load in scene["loads"] if load["type"] == "force"]
    with localcontext() as context:
        context.prec = DIGITS
        for first in (True, False):
            try:
                return _Beam(length, EI, k, q, forces, first).solve([Decimal(end) for end in ends], [Decimal(at) for at in x])
            except ArithmeticError as error:
                wrong = error
        raise wrong


class _Beam:
    """A beam that is in contact at its left end, or is not."""

    def __init__(self, length: Decimal, EI: Decimal, k: Decimal, q: Decimal, forces: list[tuple[Decimal, Decimal]], first: bool):
        self.length, self.EI, self.k, self.q, self.forces, self.first = length, EI, k, q, forces, first

    def solve(self, ends: Vector, x: Vector) -> GroundTruth:
        for solves in range(1, MOST_SOLVES + 1):  # noqa: B007  it is told
            if sorted(ends) != ends or any(not 0 < end < self.length for end in ends):
                raise ArithmeticError("contact ends cross each other or leave the beam")
            values = self._values(ends, ends)
            moves = [w / slope for w, slope, *_ in values]
            ends = [end - move for end, move in zip(ends, moves, strict=True)]
            if max((abs(move) for move in moves), default=Decimal(0)) < self.length.scaleb(-GOOD):
                break
        else:
            raise ArithmeticError("contact ends do not come to rest")
        self._check(ends)
        found = self._values(ends, x)
        return GroundTruth(ends, [w for w, *_ in found], [-self.EI * curvature for _, _, curvature, _ in found], solves)

    def _check(self, ends: Vector) -> None:
        """Ask for the sign of the gap between the contact ends."""
        marks = [Decimal(0), *ends, self.length]
        acts = self.first
        for a, b in pairwise(marks):
            inside = [a + (b - a) * i / SAMPLES for i in range(1, SAMPLES)]
            if any((w > 0) != acts for w, *_ in self._values(ends, inside)):
                raise ArithmeticError("contact is not where it was assumed")
            acts = not acts

    def _values(self, ends: Vector, x: Vector) -> Rows:
        """Deflection and its first three derivatives at some places, contact assumed between given ends."""
        places = sorted({Decimal(0), *ends, *(at for at, _ in self.forces), *x, self.length})
        # Deflection and derivatives by left deflection, left slope and load
        zero, one = Decimal(0), Decimal(1)
        state = [[one, zero, zero], [zero, one, zero], [zero] * 3, [zero] * 3]
        known, acts = {}, self.first
        for at, after in zip(places, [*places[1:], None], strict=True):
            if at in ends:
                acts = not acts
            for place, F in self.forces:
                if place == at:
                    state[3] = [*state[3][:2], state[3][2] + F / self.EI]
            known[at] = state
            if after is not None:
                state = self._carry(state, after - at, self.k / self.EI if acts else zero)
        # At the right end neither moment nor shear is left
        (a, b, f), (c, d, g) = state[2], state[3]
        det = a * d - b * c
        w, slope = (b * g - d * f) / det, (c * f - a * g) / det
        return [[row[0] * w + row[1] * slope + row[2] for row in known[at]] for at in x]

    def _carry(self, state: Rows, length: Decimal, stiffness: Decimal) -> Rows:
        """Go on to the right: w'''' = q/EI - stiffness w."""
        c = _series(length, stiffness)
        step = [[c[j - i] if j >= i else -stiffness * c[4 + j - i] for j in range(4)] for i in range(4)]
        load = [self.q / self.EI * c[4 - i] for i in range(4)]
        made = [[sum(row[j] * state[j][n] for j in range(4)) for n in range(3)] for row in step]
        return [[*row[:2], row[2] + value] for row, value in zip(made, load, strict=True)]


def _series(x: Decimal, stiffness: Decimal) -> Vector:
    """Sums of (-stiffness)^n x^(4n + j)/(4n + j)! for j = 0 to 4."""
    if not stiffness:
        return [x**j / factorial(j) for j in range(5)]
    found = [Decimal(0)] * 5
    term, tiny = Decimal(1), Decimal(1).scaleb(-2 * DIGITS)
    for n in count():
        for j in range(4):
            found[j] += term
            term = term * x / (4 * n + j + 1)
        found[4] += term
        term *= -stiffness
        if abs(term) < tiny:
            return found
    raise AssertionError
