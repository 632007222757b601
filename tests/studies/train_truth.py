"""True envelopes of trains: Macaulay's functions in decimals of many digits.

Another method than the engine's, in another arithmetic. Deflection and slope of the left end and the forces of all supports that
act are the unknowns; every load adds a power of the distance to it, over all spans, and the digits outlast what cancels. While no
axle passes a support and the same supports act, all values are polynomials in the position of the train: eight positions give
them. Where one of them changes its sign is an event. Every largest value is that of some polynomial on some stretch.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from decimal import Decimal, localcontext
from itertools import accumulate, pairwise
from math import inf
from typing import Any

DIGITS = 60
"""Decimal digits carried."""
NODES = 8
"""Positions that give a polynomial: the largest moment inside a span under a uniform load has degree 6."""
SAMPLES = 48
"""Divisions of a stretch at which roots and largest values are looked for."""
HALVINGS = 170
"""Halvings of an interval around a root."""
SHARE = Decimal("0.03")
"""Values nearer to the largest one, in its share, are looked at more closely."""

Polynomial = list[Decimal]
"""Coefficients, the constant first, over the share of a stretch that is passed."""
Matrix = list[list[Decimal]]


@dataclass
class TrainTruth:
    """True envelope of a train that has gone over a beam to the right.

    Attributes
    ----------
    moment, shear : tuple of Decimal
        Largest and smallest value.
    reaction : list of tuple of Decimal
        The same of every support.
    events : list of (Decimal, int)
        Positions at which supports open or close, and which.
    """

    moment: tuple[Decimal, Decimal]
    shear: tuple[Decimal, Decimal]
    reaction: list[tuple[Decimal, Decimal]]
    events: list[tuple[Decimal, int]]


def solve_train(scene: Mapping[str, Any]) -> TrainTruth:
    """Move the train of a scene over its beam.

    Parameters
    ----------
    scene : mapping
        Spans, one EI, supports at nodes, ``both`` or ``below``, rigid or elastic; one dead uniform load all over; one train with
        axles only.

    Raises
    ------
    ArithmeticError
        At some position no supports that act are right.

    Examples
    --------
    Three supports that cannot pull.

    >>> beam = {"beam": {"spans": [1.0, 1.0], "EI": 1.0}, "supports": [{"node": i, "side": "below"} for i in range(3)],
    ...         "loads": [{"type": "uniform", "q": 1.0, "case": "dead"}], "trains": [{"axles": [[0.0, 8.0]]}]}
    >>> found = solve_train(beam)
    >>> [(round(position, 12), support) for position, support in found.events[:2]]
    [(Decimal('0.194903920083'), 2), (Decimal('0.888199776858'), 2)]
    """
    with localcontext() as context:
        context.prec = DIGITS
        way = _Way(scene)
        stretches = list(way.stretches())
        moment = [curve for stretch in stretches for curve in stretch.moments()]
        shear = [curve for stretch in stretches for curve in stretch.shears()]
        events = []
        for before, after in pairwise(stretches):
            events += [(after.start, k) for k, (a, b) in enumerate(zip(before.closed, after.closed, strict=True)) if a != b]
        return TrainTruth(
            _both(moment), _both(shear),
            [_both([stretch.reaction(k) for stretch in stretches]) for k in range(len(way.supports))], events,
        )  # fmt: skip


Curve = tuple[Polynomial, Callable[[Decimal], bool] | None]
"""A polynomial on a stretch, and where it holds, if not everywhere."""


class _Way:
    """A beam and a train that goes over it."""

    def __init__(self, scene: Mapping[str, Any]) -> None:
        self.nodes = list(accumulate(map(Decimal, scene["beam"]["spans"]), initial=Decimal(0)))
        self.end, self.EI = self.nodes[-1], Decimal(scene["beam"]["EI"])
        self.q = sum((Decimal(load["q"]) for load in scene["loads"]), Decimal(0))
        self.supports = [
            (self.nodes[item["node"]], item.get("side", "both") == "below", Decimal(item.get("stiffness", inf)))
            for item in scene["supports"]
        ]
        train = scene["trains"][0]
        self.axles = [(Decimal(distance), Decimal(force)) for distance, force in train["axles"]]
        self.points = [(Decimal(k) + 1) / (NODES + 1) for k in range(NODES)]
        self.to_powers = _inverse([[t**k for k in range(NODES)] for t in self.points])
        self.closed = tuple(True for _ in self.supports)

    def stretches(self) -> Iterator[_Stretch]:
        """Stretches on which all values are polynomials, from left to right."""
        last = self.end + max(distance for distance, _ in self.axles)
        passing = {node + distance for node in self.nodes for distance, _ in self.axles}
        for a, b in pairwise(sorted(position for position in passing if 0 <= position <= last)):
            yield from self._settled(a, b, a, b)

    def _settled(self, a: Decimal, b: Decimal, low: Decimal, high: Decimal) -> Iterator[_Stretch]:
        """Stretches between two events, of one between two positions at which an axle passes a support."""
        if high - low < Decimal(10) ** -40 * self.end:
            return
        middle = (low + high) / 2
        closed = self._scheme(middle, (a + b) / 2)
        stretch = self._stretch(a, b, closed)
        first, last = (low - a) / (b - a), (high - a) / (b - a)
        at = (middle - a) / (b - a)
        for margin in stretch.margins:
            for root in _roots(margin, Decimal(0), Decimal(1)):
                first, last = (root, last) if first < root < at else (first, root) if at < root < last else (first, last)
        stretch.first, stretch.last = first, last
        yield from self._settled(a, b, low, stretch.start)
        yield stretch
        yield from self._settled(a, b, stretch.end, high)

    def _scheme(self, position: Decimal, middle: Decimal) -> tuple[bool, ...]:
        """Supports that act at a position: those that are wrong change until none is."""
        tried = set()
        closed = self.closed
        while closed not in tried:
            tried.add(closed)
            _, margins = self._solve(position, middle, closed)
            wrong = [margin is not None and margin < 0 for margin in margins]
            if not any(wrong):
                self.closed = closed
                return closed
            closed = tuple(acts != change for acts, change in zip(closed, wrong, strict=True))
        raise ArithmeticError(f"no supports that act are right at {position}")

    def _there(self, position: Decimal, middle: Decimal) -> list[tuple[Decimal, Decimal]]:
        """Axles that are on the beam in the middle of a stretch, where they are at a position of it."""
        return [(position - d, P) for d, P in self.axles if 0 <= middle - d <= self.end]

    def _solve(self, position: Decimal, middle: Decimal, closed: Sequence[bool]) -> tuple[list[Decimal], list[Decimal | None]]:
        """Reactions, and what must not be negative: forces of supports that act, openings of the others."""
        L, EI = self.end, self.EI
        loads = self._there(position, middle)
        acts = [k for k, c in enumerate(closed) if c]

        def moved(x: Decimal) -> Decimal:
            return sum((P * max(x - a, Decimal(0)) ** 3 / 6 for a, P in loads), self.q * x**4 / 24)

        rows, right = [], []
        for k in acts:
            x, _, c = self.supports[k]
            row = [EI, EI * x] + [-(max(x - self.supports[j][0], Decimal(0)) ** 3) / 6 for j in acts]
            row[2 + acts.index(k)] -= EI / c
            rows.append(row)
            right.append(-moved(x))
        rows.append([Decimal(0), Decimal(0)] + [Decimal(1) for _ in acts])
        right.append(sum((P for _, P in loads), self.q * L))
        rows.append([Decimal(0), Decimal(0)] + [L - self.supports[j][0] for j in acts])
        right.append(sum((P * (L - a) for a, P in loads), self.q * L**2 / 2))
        found = _solved(rows, right)
        reactions = [Decimal(0)] * len(closed)
        for k, force in zip(acts, found[2:], strict=True):
            reactions[k] = force
        margins: list[Decimal | None] = []
        for k, (x, one_sided, _) in enumerate(self.supports):
            if not one_sided:
                margins.append(None)
            elif closed[k]:
                margins.append(reactions[k])
            else:
                lifted = sum((reactions[j] * max(x - self.supports[j][0], Decimal(0)) ** 3 / 6 for j in acts), Decimal(0))
                margins.append(-(found[0] + found[1] * x + (moved(x) - lifted) / EI))
        return reactions, margins

    def _stretch(self, a: Decimal, b: Decimal, closed: tuple[bool, ...]) -> _Stretch:
        middle = (a + b) / 2
        found = [self._solve(a + t * (b - a), middle, closed) for t in self.points]
        reactions = [self._fitted([reactions[k] for reactions, _ in found]) for k in range(len(closed))]
        margins = [self._fitted([row[k] for _, row in found]) for k, one in enumerate(self.supports) if one[1]]
        return _Stretch(self, a, b, closed, reactions, margins, self._there(a, middle))

    def _fitted(self, values: Sequence[Decimal]) -> Polynomial:
        return [sum((c * v for c, v in zip(row, values, strict=True)), Decimal(0)) for row in self.to_powers]


@dataclass
class _Stretch:
    """Positions at which axles stay between the same supports, and the part of them in which the same supports act."""

    way: _Way
    a: Decimal
    b: Decimal
    closed: tuple[bool, ...]
    reactions: list[Polynomial]
    margins: list[Polynomial]
    axles: list[tuple[Decimal, Decimal]]
    first: Decimal = field(default=Decimal(0))
    last: Decimal = field(default=Decimal(1))

    @property
    def start(self) -> Decimal:
        return self.a + self.first * (self.b - self.a)

    @property
    def end(self) -> Decimal:
        return self.a + self.last * (self.b - self.a)

    def __post_init__(self) -> None:
        way, step = self.way, self.b - self.a
        forces: list[tuple[Polynomial, Polynomial]] = [
            ([x], reaction) for (x, _, _), reaction in zip(way.supports, self.reactions, strict=True)
        ]
        forces += [([x, step], [-P]) for x, P in self.axles]
        forces.sort(key=lambda force: _value(force[0], Decimal(1) / 2))
        self.pieces: list[tuple[Polynomial, Polynomial, Polynomial]] = []  # length, moment and shear at the left end
        at, moment, shear = [Decimal(0)], [Decimal(0)], [Decimal(0)]
        for place, force in [*forces, ([way.end], [Decimal(0)])]:
            length = _sum(place, _times([Decimal(-1)], at))
            self.pieces.append((length, moment, shear))
            moment = _sum(moment, _times(shear, length), _times([-way.q / 2], _times(length, length)))
            shear = _sum(shear, _times([-way.q], length), force)
            at = place

    def reaction(self, k: int) -> Curve:
        """Force of a support."""
        return self._part(self.reactions[k]), None

    def moments(self) -> Iterator[Curve]:
        """Moments at the ends of all pieces, and inside them where the shear is zero."""
        for length, moment, shear in self.pieces:
            yield self._part(moment), None
            if self.way.q:
                inner = self._part(_sum(moment, _times([1 / (2 * self.way.q)], _times(shear, shear))))
                yield inner, _inside(self._part(shear), self._part(length), self.way.q)

    def shears(self) -> Iterator[Curve]:
        """Shears at both ends of all pieces."""
        for length, _, shear in self.pieces:
            if any(length):
                yield self._part(shear), None
                yield self._part(_sum(shear, _times([-self.way.q], length))), None

    def _part(self, polynomial: Polynomial) -> Polynomial:
        """The polynomial over the share of the part."""
        width, found = self.last - self.first, [Decimal(0)]
        for c in reversed(polynomial):
            found = _sum(_times(found, [self.first, width]), [c])
        return found


def _inside(shear: Polynomial, length: Polynomial, q: Decimal) -> Callable[[Decimal], bool]:
    return lambda t: 0 < _value(shear, t) / q < _value(length, t)


def _both(curves: list[Curve]) -> tuple[Decimal, Decimal]:
    """Largest and smallest value of all."""
    return _largest(curves), -_largest([(_times([Decimal(-1)], curve), where) for curve, where in curves])


def _largest(curves: list[Curve]) -> Decimal:
    places = [Decimal(k) / SAMPLES for k in range(SAMPLES + 1)]
    tables = [[_value(curve, t) if where is None or where(t) else None for t in places] for curve, where in curves]
    best = max(value for table in tables for value in table if value is not None)
    near = best - SHARE * abs(best)
    for (curve, where), table in zip(curves, tables, strict=True):
        slope = [k * c for k, c in enumerate(curve)][1:]
        for k, value in enumerate(table):
            if value is None or value < near:
                continue
            for t in _roots(slope, places[max(k - 1, 0)], places[min(k + 1, SAMPLES)], 2):
                if where is None or where(t):
                    best = max(best, _value(curve, t))
    return best


def _roots(polynomial: Polynomial, low: Decimal, high: Decimal, parts: int = SAMPLES) -> list[Decimal]:
    """Places at which a polynomial changes its sign."""
    found = []
    places = [low + (high - low) * k / parts for k in range(parts + 1)]
    for a, b in pairwise(places):
        positive = _value(polynomial, a) > 0
        if positive != (_value(polynomial, b) > 0):
            for _ in range(HALVINGS):
                middle = (a + b) / 2
                a, b = (middle, b) if (_value(polynomial, middle) > 0) == positive else (a, middle)
            found.append((a + b) / 2)
    return found


def _value(polynomial: Polynomial, t: Decimal) -> Decimal:
    total = Decimal(0)
    for c in reversed(polynomial):
        total = total * t + c
    return total


def _sum(*polynomials: Polynomial) -> Polynomial:
    size = max(map(len, polynomials))
    return [sum((p[k] for p in polynomials if k < len(p)), Decimal(0)) for k in range(size)]


def _times(a: Polynomial, b: Polynomial) -> Polynomial:
    found = [Decimal(0)] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            found[i + j] += x * y
    return found


def _solved(rows: Matrix, right: Sequence[Decimal]) -> list[Decimal]:
    """Solve a system by elimination with row interchanges."""
    table = [[*row, value] for row, value in zip(rows, right, strict=True)]
    n = len(table)
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(table[i][k]))
        table[k], table[pivot] = table[pivot], table[k]
        for i in range(k + 1, n):
            share = table[i][k] / table[k][k]
            if share:
                table[i] = [a - share * b for a, b in zip(table[i], table[k], strict=True)]
    found = [Decimal(0)] * n
    for k in reversed(range(n)):
        found[k] = (table[k][n] - sum((table[k][j] * found[j] for j in range(k + 1, n)), Decimal(0))) / table[k][k]
    return found


def _inverse(rows: Matrix) -> Matrix:
    n = len(rows)
    columns = [_solved(rows, [Decimal(i == k) for i in range(n)]) for k in range(n)]
    return [list(row) for row in zip(*columns, strict=True)]
