"""True answers of beams on foundations: transfer matrices in decimals of many digits.

Another method than the engine's, in another arithmetic: every stretch between two places where anything changes is a power
series of deflection, rotation, moment and shear, carried from left to right with the deflection and rotation of the left end and
the reactions of rigid supports as unknowns; growing and fading waves are not told apart, since the digits outlast them. The
ends of contact are corrected by the zeros of the distance beside them, until none moves, and then the sign of every distance and
reaction is asked all along the beam. An equilibrium is unique, so what passes is true.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from decimal import Decimal, localcontext
from itertools import pairwise
from math import inf, log, sqrt
from typing import Any

DIGITS = 140
"""Decimal digits carried, besides those that growing waves take."""
GOOD = 40
"""Digits to which the ends are found."""
MOST_SOLVES = 60
"""Corrections of the ends before giving up."""
SAMPLES = 12
"""Places in every stretch at which the sign of the distance is asked."""
SIDES = {"below": 1, "above": -1, "both": 0}

Vector = list[Decimal]
Rows = list[Vector]
Zone = tuple[int, float | Decimal, float | Decimal]


@dataclass
class GroundTruth:
    """True values of a beam on foundations.

    Attributes
    ----------
    ends : list of Decimal
        Where contact begins and ends inside the beam, from left to right.
    deflection, rotation, moment, shear : list of Decimal
        At the places asked for, shear right of what acts there, at the right end of the beam left of it.
    reaction, resultant : list of Decimal
        Of every support; of every zone.
    solves : int
        Corrections of the ends.
    """

    ends: Vector
    deflection: Vector
    rotation: Vector
    moment: Vector
    shear: Vector
    reaction: Vector
    resultant: Vector
    solves: int


def solve_ground(scene: Mapping[str, Any], ends: Sequence[float], x: Sequence[float]) -> GroundTruth:
    """Solve a beam on one foundation that cannot pull, from the ends of contact.

    Parameters
    ----------
    scene : mapping
        As for `solve_zones`, with one foundation all along.
    ends : sequence of float
        About where contact begins and ends inside the beam, from left to right. Whether its left end is in contact is found.
    x : sequence of float
        Places at which values are wanted.

    Raises
    ------
    ArithmeticError
        As for `solve_zones`.

    Examples
    --------
    Long, heavy, one end lifted by 1.5 q/beta: two are free.

    >>> beam = {"beam": {"spans": [30.0], "EI": 1.0}, "foundation": [{"k": 4.0, "side": "below"}],
    ...         "loads": [{"type": "uniform", "q": 1.0}, {"type": "force", "x": 0.0, "F": -1.5}]}
    >>> found = solve_ground(beam, [2.1], [2.0])
    >>> round(found.ends[0], 20), round(found.moment[0], 20)
    (Decimal('2.00000000000000000000'), Decimal('1.00000000000000000000'))
    """
    length = sum(map(Decimal, scene["beam"]["spans"]))
    for first in (0, 1):
        marks = [Decimal(0), *map(Decimal, ends), length]
        try:
            return solve_zones(scene, [(0, a, b) for a, b in list(pairwise(marks))[first::2]], x)
        except ArithmeticError as error:
            wrong = error
    raise wrong


def solve_zones(scene: Mapping[str, Any], zones: Sequence[Zone], x: Sequence[float], closed: Sequence[bool] = ()) -> GroundTruth:
    """Solve a beam on foundations.

    Parameters
    ----------
    scene : mapping
        Spans, EI, GA; supports at nodes, rigid or elastic, with gaps; uniform loads, forces; foundations with k (also a pair), gap
        or profile.
    zones : sequence of (int, float, float)
        About where every foundation that acts one way is in contact: its number, from, to.
    x : sequence of float
        Places at which values are wanted.
    closed : sequence of bool
        Which supports act, of all.

    Raises
    ------
    ArithmeticError
        The ends do not come to rest, or something holds where it should not, or does not where it should.
    """
    with localcontext() as context:
        context.prec = DIGITS
        beam = _Beam(scene, list(closed))
        exactly = [(number, Decimal(a), Decimal(b)) for number, a, b in zones]
        context.prec += int(beam.growth(exactly) / log(10.0))
        return beam.solve(exactly, [Decimal(at) for at in x])


@dataclass
class _Layer:
    """A foundation between two places where its line bends: values at its left end and slopes."""

    number: int
    side: int
    from_: Decimal
    to: Decimal
    k: tuple[Decimal, Decimal]
    gap: tuple[Decimal, Decimal]

    def distance(self, at: Decimal, w: Decimal) -> Decimal:
        """How deep the beam is in the ground."""
        return self.side * w - self.gap[0] - self.gap[1] * (at - self.from_)


@dataclass
class _Support:
    at: Decimal
    side: int
    level: Decimal
    stiffness: Decimal | None
    closed: bool
    unknown: int = 0


@dataclass
class _Solved:
    """Linear forms at all marks, and the unknowns: 1, deflection and rotation of the left end, reactions of rigid supports."""

    marks: Vector
    states: list[Rows]
    unknowns: Vector = field(default_factory=list)

    def value(self, row: Vector) -> Decimal:
        return sum((c * u for c, u in zip(row, self.unknowns, strict=True)), Decimal(0))


class _Beam:
    """A scene, exactly."""

    def __init__(self, scene: Mapping[str, Any], closed: list[bool]):
        beam = scene["beam"]
        self.nodes = [Decimal(0)]
        for span in beam["spans"]:
            self.nodes.append(self.nodes[-1] + Decimal(span))
        self.length = self.nodes[-1]
        EI = beam["EI"] if isinstance(beam["EI"], list) else [beam["EI"]] * len(beam["spans"])
        self.flexibility = [Decimal(0) if value == inf else 1 / Decimal(value) for value in EI]
        self.shear = Decimal(0) if beam.get("GA", inf) == inf else 1 / Decimal(beam["GA"])
        self.forces = [(self._place(load), Decimal(load["F"])) for load in scene["loads"] if load["type"] == "force"]
        self.spread = [
            (Decimal(load.get("from", 0.0)), Decimal(load["to"]) if "to" in load else self.length, Decimal(load["q"]))
            for load in scene["loads"]
            if load["type"] == "uniform"
        ]
        self.supports = [self._support(item) for item in scene.get("supports", [])]
        for support, acts in zip(self.supports, closed or [True] * len(self.supports), strict=True):
            support.closed = acts
        self.layers = [layer for number, item in enumerate(scene["foundation"]) for layer in self._layers(number, item)]

    def _place(self, item: Mapping[str, Any]) -> Decimal:
        return Decimal(item["x"]) if "x" in item else self.nodes[item["node"]]

    def _support(self, item: Mapping[str, Any]) -> _Support:
        side, stiffness = SIDES[item.get("side", "both")], item.get("stiffness", inf)
        level = Decimal(item.get("gap", 0.0)) * (side or 1)
        return _Support(self._place(item), side, level, None if stiffness == inf else Decimal(stiffness), True)

    def _layers(self, number: int, item: Mapping[str, Any]) -> list[_Layer]:
        start, end = Decimal(item.get("from", 0.0)), Decimal(item["to"]) if "to" in item else self.length

        def both(value: Any) -> list[tuple[Decimal, Decimal]]:
            pair = value if isinstance(value, list) else [value, value]
            return list(zip((start, end), map(Decimal, pair), strict=True))

        gap = [(Decimal(at), Decimal(g)) for at, g in item["profile"]] if "profile" in item else both(item.get("gap", 0.0))
        gap = [(min(start, gap[0][0]), gap[0][1]), *gap, (max(end, gap[-1][0]), gap[-1][1])]
        k = both(item["k"])
        slope = (k[1][1] - k[0][1]) / (end - start)
        made = []
        for (a, g), (b, h) in pairwise(gap):
            a, b, before, steep = max(a, start), min(b, end), a, (h - g) / (b - a) if b > a else Decimal(0)
            if b > a:
                made.append(_Layer(number, SIDES[item.get("side", "both")], a, b, (k[0][1] + slope * (a - start), slope),
                                   (g + steep * (a - before), steep)))  # fmt: skip
        return made

    def growth(self, zones: list[tuple[int, Decimal, Decimal]]) -> float:
        """Logarithm of how much the waves of all zones may grow, twice."""
        moduli = [max(layer.k[0], layer.k[0] + layer.k[1] * (layer.to - layer.from_)) for layer in self.layers]
        modulus = float(max(moduli)) * (1 + max(layer.number for layer in self.layers))
        rate = sqrt(2.0) * (modulus * float(max(self.flexibility))) ** 0.25 + 2.0 * sqrt(modulus * float(self.shear))
        held = [layer.to - layer.from_ for layer in self.layers if not layer.side]
        return rate * float(sum(held, sum((b - a for _, a, b in zones), Decimal(0))))

    def solve(self, zones: list[tuple[int, Decimal, Decimal]], x: Vector) -> GroundTruth:
        bounds = {layer.number: self._extent(layer.number) for layer in self.layers}
        for solves in range(1, MOST_SOLVES + 1):  # noqa: B007  it is told
            self._demand_order(zones, bounds)
            solved = self._state(zones, [])
            moved, moves = [], [Decimal(0)]
            for number, a, b in zones:
                ends = []
                for end, bound in zip((a, b), bounds[number], strict=True):
                    move = Decimal(0) if end == bound else self._move(solved, number, end)
                    moves.append(abs(move))
                    ends.append(end - move)
                moved.append((number, *ends))
            zones = moved
            if max(moves) < self.length.scaleb(-GOOD):
                break
        else:
            raise ArithmeticError("contact ends do not come to rest")
        self._demand_order(zones, bounds)
        self._check(zones, bounds)
        return self._answer(zones, x, solves)

    def _extent(self, number: int) -> tuple[Decimal, Decimal]:
        mine = [layer for layer in self.layers if layer.number == number]
        return mine[0].from_, mine[-1].to

    def _demand_order(self, zones: list[tuple[int, Decimal, Decimal]], bounds: Mapping[int, tuple[Decimal, Decimal]]) -> None:
        last: dict[int, Decimal] = {}
        for number, a, b in zones:
            if not max(last.get(number, bounds[number][0]), bounds[number][0]) <= a < b <= bounds[number][1]:
                raise ArithmeticError("contact ends cross each other or leave the ground")
            last[number] = b

    def _move(self, solved: _Solved, number: int, end: Decimal) -> Decimal:
        """How far an end lies from the zero of the distance beside it."""
        rows = solved.states[solved.marks.index(end)]
        layer = next(layer for layer in self.layers if layer.number == number and layer.from_ <= end <= layer.to)
        slope = solved.value(rows[1]) + self.shear * solved.value(rows[3])
        return layer.distance(end, solved.value(rows[0])) / (layer.side * slope - layer.gap[1])

    def _check(self, zones: list[tuple[int, Decimal, Decimal]], bounds: Mapping[int, tuple[Decimal, Decimal]]) -> None:
        """Ask for the signs of all distances and reactions."""
        marks = self._state(zones, []).marks
        inside = [a + (b - a) * i / SAMPLES for a, b in pairwise(marks) for i in range(1, SAMPLES)]
        solved = self._state(zones, inside)
        known = {at: solved.value(rows[0]) for at, rows in zip(solved.marks, solved.states, strict=True)}
        for layer in self.layers:
            for at in inside:
                if layer.side and layer.from_ < at < layer.to:
                    acts = any(number == layer.number and a < at < b for number, a, b in zones)
                    if (layer.distance(at, known[at]) > 0) != acts:
                        raise ArithmeticError("contact is not where it was assumed")
        for support, reaction in zip(self.supports, self._reactions(solved), strict=True):
            away = support.side * (known[support.at] - support.level)
            if (support.side * reaction < 0) if support.closed else away > 0:
                raise ArithmeticError("a support pulls, or is passed")

    def _reactions(self, solved: _Solved) -> Vector:
        found = []
        for support in self.supports:
            if not support.closed:
                found.append(Decimal(0))
            elif support.stiffness is None:
                found.append(solved.unknowns[support.unknown])
            else:
                w = solved.value(solved.states[solved.marks.index(support.at)][0])
                found.append(support.stiffness * (w - support.level))
        return found

    def _answer(self, zones: list[tuple[int, Decimal, Decimal]], x: Vector, solves: int) -> GroundTruth:
        solved = self._state(zones, x)
        places = [solved.states[solved.marks.index(at)] for at in x]
        values = [[solved.value(rows[k]) for rows in places] for k in range(4)]
        pushes = []
        for number, a, b in zones:
            at_a, at_b = (solved.value(solved.states[solved.marks.index(end)][4 + number]) for end in (a, b))
            pushes.append(at_b - at_a)
        ends = sorted({end for _, *both in zones for end in both if 0 < end < self.length})
        return GroundTruth(ends, *values, self._reactions(solved), pushes, solves)

    def _state(self, zones: list[tuple[int, Decimal, Decimal]], x: Vector) -> _Solved:
        """Deflection, rotation, moment, shear and the forces of all foundations so far, contact assumed in given zones."""
        marks = {Decimal(0), self.length, *self.nodes, *x, *(at for at, _ in self.forces), *(s.at for s in self.supports)}
        marks |= {end for a, b, _ in self.spread for end in (a, b)} | {end for _, *both in zones for end in both}
        marks |= {end for layer in self.layers for end in (layer.from_, layer.to)}
        places = sorted(marks)
        rigid = [support for support in self.supports if support.closed and support.stiffness is None]
        width, count = 3 + len(rigid), 4 + 1 + max(layer.number for layer in self.layers)
        for unknown, support in enumerate(rigid, 3):
            support.unknown = unknown
        state = [[Decimal(0)] * width for _ in range(count)]
        state[0][1] = state[1][2] = Decimal(1)
        solved, conditions = _Solved(places, []), []
        for at, after in zip(places, [*places[1:], None], strict=True):
            if after is None:  # where values are those left of what acts there
                solved.states.append([[*row] for row in state])
            for place, F in self.forces:
                if place == at:
                    state[3][0] -= F
            for support in self.supports:
                if support.at != at or not support.closed:
                    continue
                if support.stiffness is None:
                    state[3][support.unknown] += 1
                    conditions.append(([*state[0]], support.level))
                else:
                    state[3] = [v + support.stiffness * w for v, w in zip(state[3], state[0], strict=True)]
                    state[3][0] -= support.stiffness * support.level
            if after is not None:
                solved.states.append([[*row] for row in state])
                state = self._carry(state, at, after, zones)
        conditions += [(state[2], Decimal(0)), (state[3], Decimal(0))]
        solved.unknowns = _solve([[*row[1:], value - row[0]] for row, value in conditions])
        return solved

    def _carry(self, state: Rows, a: Decimal, b: Decimal, zones: list[tuple[int, Decimal, Decimal]]) -> Rows:
        """Go on to the right, by the series of all of them: w' = psi + V/GA, psi' = -M/EI, M' = V, V' = -q + k (w - gap)."""
        h, middle = b - a, (a + b) / 2
        flexibility = next(f for f, (p, q) in zip(self.flexibility, pairwise(self.nodes), strict=True) if p < middle < q)
        load = sum((q for p, r, q in self.spread if p < middle < r), Decimal(0))
        acting = []
        for layer in self.layers:
            held = layer.side == 0 or any(n == layer.number and p < middle < q for n, p, q in zones)
            if held and layer.from_ < middle < layer.to:
                k = layer.k[0] + layer.k[1] * (a - layer.from_), layer.k[1] * h
                line = [(layer.side or 1) * v for v in (layer.gap[0] + layer.gap[1] * (a - layer.from_), layer.gap[1] * h)]
                acting.append((layer.number, k, (k[0] * line[0], k[0] * line[1] + k[1] * line[0], k[1] * line[1])))
        sums = [[*row] for row in state]
        terms, before = [[*row] for row in state[:4]], [Decimal(0)] * len(state[0])
        n, quiet = 0, 0
        while quiet < 6:
            w, psi, moment, shear = terms
            pushes = []
            for number, k, constant in acting:
                push = [k[0] * new + k[1] * old for new, old in zip(w, before, strict=True)]
                push[0] -= constant[n] if n < 3 else 0
                pushes.append((number, push))
            gain = [sum(column, Decimal(0)) for column in zip(*(push for _, push in pushes), strict=True)] or [Decimal(0)] * len(w)
            gain[0] -= load if n == 0 else 0
            share = h / (n + 1)
            before = w
            terms = [
                [share * (p + self.shear * v) for p, v in zip(psi, shear, strict=True)],
                [-share * flexibility * m for m in moment],
                [share * v for v in shear],
                [share * g for g in gain],
            ]
            for number, push in pushes:
                sums[4 + number] = [s + share * p for s, p in zip(sums[4 + number], push, strict=True)]
            sums[:4] = [[s + t for s, t in zip(*both, strict=True)] for both in zip(sums[:4], terms, strict=True)]
            n += 1
            small = n > 4 and all(s + t == s for rows in zip(sums[:4], terms, strict=True) for s, t in zip(*rows, strict=True))
            quiet = quiet + 1 if small else 0
        return sums


def _solve(rows: Rows) -> Vector:
    """Solve linear equations by elimination with pivots; a 1 before their unknowns."""
    n = len(rows)
    for j in range(n):
        best = max(range(j, n), key=lambda i: abs(rows[i][j]) / max(map(abs, rows[i][:n])) if any(rows[i][:n]) else -1)
        rows[j], rows[best] = rows[best], rows[j]
        if not rows[j][j]:
            raise ArithmeticError("nothing holds the beam")
        for i in range(j + 1, n):
            ratio = rows[i][j] / rows[j][j]
            rows[i] = [Decimal(0)] * (j + 1) + [v - ratio * p for v, p in zip(rows[i][j + 1 :], rows[j][j + 1 :], strict=True)]
    found = [Decimal(0)] * n
    for j in reversed(range(n)):
        found[j] = (rows[j][n] - sum((rows[j][i] * found[i] for i in range(j + 1, n)), Decimal(0))) / rows[j][j]
    return [Decimal(1), *found]

