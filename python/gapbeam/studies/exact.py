"""Exact solution of a scene in rational numbers, to measure errors by.

The unknowns are the deflection and the moments left and right of **every** place where anything changes: nothing is
condensed, and sections, supports and loads are read from the scene, not from the engine's arrays. The contact state is
taken from a result and its contact conditions are checked; where they fail, schemes are changed until they hold, which
proves the solution right. Long beams are solved with decimals of `DIGITS` digits instead of fractions, which would
grow with the number of places.

Axial loads and axial supports are not treated.
"""

from __future__ import annotations

from collections.abc import Sequence
from decimal import Decimal, localcontext
from fractions import Fraction
from itertools import pairwise
from math import inf, isinf

import numpy as np

from ..base.errors import SceneError
from ..results.equilibrium import axial_forces
from ..scene.ground_tables import at_both_ends
from ..scene.loads import CurvatureLoad, ForceLoad, MomentLoad
from ..scene.places import locate
from ..scene.reading import read_beam
from ..scene.rotations import which_turn
from ..scene.sides import SIDES
from ..scene.structs import Scene
from ..scene.tapers import is_tapered
from ..scene.temperature import as_curvatures

DIGITS = 200
"""Decimal digits where a beam has too many places for fractions."""
MOST_EXACT = 60
"""Places up to which fractions are used."""
MOST_CHANGES = 200
"""Schemes tried before giving up."""

Form = dict
"""A linear form: coefficients by unknown; the constant term has the key -1."""


class Reference:
    """A scene made ready for exact solution at load factor 1.

    Parameters
    ----------
    scene : Scene
        As `read_scene` returns it.

    Attributes
    ----------
    x : list of float
        The places where values are known, as the scene would name them; the middle of every span is among them.
    deflection, moment_left, moment_right, shear_left, shear_right : list
        There, after `solve`: fractions, or decimals for long beams.
    reaction, place_deflection : list
        Of every support, and of the beam there.
    """

    def __init__(self, scene: Scene):
        if any(map(is_tapered, scene.sections)):
            raise SceneError("sections", "the exact solution of the study does not know sections that taper; leave them out")
        if any(one.stiffness for one in scene.hinges):
            raise SceneError("hinges", "the exact solution of the study does not know hinges with a stiffness; leave them out")
        if any(run.left for run in axial_forces(scene)):
            raise SceneError("beam.N", "the exact solution of the study does not know axial forces in bending; leave them out")
        if read_beam(scene)[1].feels_axial_loads:
            what = "axial loads that bend the beam; say analysis.first_order = true"
            raise SceneError("loads", f"the exact solution of the study does not know {what}")
        if which_turn(scene.supports).any():
            what = "restraints and hinges with laws, a slack or a side"
            raise SceneError("supports", f"the exact solution of the study does not know {what}; leave them out")
        scene = as_curvatures(scene)
        ends = scene.span_ends()
        exact_ends = [Fraction(0)]
        for span in scene.beam.spans:
            exact_ends.append(exact_ends[-1] + Fraction(span))

        def places(x: Sequence[float]) -> list[Fraction]:
            span, offset = locate(np.array(x, dtype=float), ends)
            return [exact_ends[i] + Fraction(d) for i, d in zip(span.tolist(), offset.tolist(), strict=True)]

        def at(items: list) -> list[Fraction]:
            x = places([0.0 if item.x is None else item.x for item in items])
            return [exact_ends[i.node] if i.x is None else there for i, there in zip(items, x, strict=True)]

        def along(items: list) -> list[tuple[Fraction, Fraction]]:
            stop = [ends[-1] if item.to is None else item.to for item in items]
            return list(zip(places([item.from_ for item in items]), places(stop), strict=True))

        points = [load for load in scene.loads if isinstance(load, ForceLoad | MomentLoad)]
        stretches = [load for load in scene.loads if not isinstance(load, ForceLoad | MomentLoad)]
        sections = [(0, 0, None)] + [(*where, s) for where, s in zip(along(scene.sections), scene.sections, strict=True)]
        loads = [(*where, load) for where, load in zip(along(stretches), stretches, strict=True)]
        hinges = [*places(scene.beam.hinges), *at(scene.hinges)]
        held, loaded = at(scene.supports), at(points)
        marks = [x for a, b, _ in (*sections, *loads) for x in (a, b)]
        middles = places(ends[:-1] + np.array(scene.beam.spans) / 2)
        where = sorted({*exact_ends, *hinges, *held, *loaded, *marks, *middles})
        index = {x: i for i, x in enumerate(where)}
        self.kind = Fraction if len(where) <= MOST_EXACT else Decimal
        self.x = [_name(x, exact_ends, ends) for x in where]
        self.hinges = {index[x] for x in hinges}
        self.supports = scene.supports
        self.support_points = [index[x] for x in held]
        # The couples left of hinges are among those at their places
        self.force, self.couple, self.left_of_hinge = ([Fraction(0)] * len(where) for _ in range(3))
        for load, x in zip(points, loaded, strict=True):
            if isinstance(load, ForceLoad):
                self.force[index[x]] += Fraction(load.F)
            else:
                self.couple[index[x]] += Fraction(load.M)
                self.left_of_hinge[index[x]] += Fraction(load.M if load.at_hinge == "left" else 0.0)
        self.pieces = [_piece(a, b, scene, exact_ends, sections, loads) for a, b in pairwise(where)]
        self.sign = [SIDES[support.side] for support in scene.supports]
        self.level = [Fraction(s.settlement) + k * Fraction(s.gap) for s, k in zip(self.supports, self.sign, strict=True)]

    def solve(self, state: Sequence[str]) -> bool:
        """Solve, starting from a contact state.

        Parameters
        ----------
        state : sequence of str
            ``closed``, ``open`` or ``bilateral`` for every support.

        Returns
        -------
        bool
            Whether this scheme was right.

        Raises
        ------
        ZeroDivisionError
            A scheme on the way is a mechanism or statically ambiguous, or no scheme was found.
        """
        closed = [name != "open" for name in state]
        with localcontext() as context:
            context.prec, context.Emax, context.Emin = DIGITS, 10**9, -(10**9)
            for change in range(MOST_CHANGES):
                self._solve(closed)
                wrong = [i for i, k in enumerate(self.sign) if k and self._violated(i, k, closed[i])]
                if not wrong:
                    return change == 0
                for i in wrong if change < 5 else wrong[:1]:
                    closed[i] = not closed[i]
        raise ZeroDivisionError("no contact state satisfies the contact conditions exactly")

    def error(self, name: str, values: Sequence[float], scale: str = "", inner: slice = slice(None)) -> float:
        """Largest error of some values, relative to the largest true one.

        Parameters
        ----------
        name : str
            Attribute that holds the true values.
        values : sequence of float
            What to judge.
        scale : str, optional
            Attribute whose largest value counts instead.
        inner : slice, optional
            Which values are judged.

        Returns
        -------
        float
            0 where all are zero and right, inf where a value is not finite.
        """
        true, values = getattr(self, name)[inner], list(values)[inner]
        if not all(abs(value) < inf for value in values):
            return inf
        with localcontext() as context:
            context.prec, context.Emax, context.Emin = DIGITS, 10**9, -(10**9)
            size = max((abs(value) for value in getattr(self, scale or name)), default=0)
            off = max((abs(self.kind(float(a)) - b) for a, b in zip(values, true, strict=True)), default=0)
            return float(off / size) if size else (inf if off else 0.0)

    def _violated(self, i: int, sign: int, closed: bool) -> bool:
        if closed:
            return sign * self.reaction[i] < 0
        return sign * (self._number(self.level[i]) - self.place_deflection[i]) < 0

    def _number(self, value: Fraction):
        return value if self.kind is Fraction else Decimal(value.numerator) / Decimal(value.denominator)

    def _solve(self, closed: Sequence[bool]) -> None:
        """Solve one scheme; unknowns 3i, 3i + 1, 3i + 2 are w, M left and M right of place i."""
        count, one, number = len(self.x), self.kind(1), self._number
        left = [({}, {})]  # rotation and shear left of every place
        right = []
        for i, (h, f, g, q, s, kappa, more) in enumerate(self.pieces):
            a, b = {3 * i + 2: one}, {3 * i + 4: one}
            shear = _sum((number(1 / h), b), (number(-1 / h), a), (number(q * h / 2 + s * h**2 / 6), {-1: one}))
            bent = kappa * h / 2 + more * h**2 / 6
            bend = number(f * (-q * h**3 / 24 - s * h**4 / 120) - bent + g * (q * h / 2 + s * h**2 / 6))
            turn = _sum((number(1 / h), {3 * i + 3: one}), (number(-1 / h), {3 * i: one}), (number(f * h / 2), a),
                        (number(f * h**2 / 6 - g), shear), (bend, {-1: one}))  # fmt: skip
            right.append((turn, shear))
            loaded = number(f * (q * h**3 / 6 + s * h**4 / 24) + kappa * h + more * h**2 / 2)
            last = _sum((one, turn), (number(-f * h), a), (number(-f * h**2 / 2), shear), (loaded, {-1: one}))
            left.append((last, _sum((one, shear), (number(-q * h - s * h**2 / 2), {-1: one}))))
        right.append(({}, {}))
        rigid, stiffness, support_force, turning = {}, [one * 0] * count, [{}] * count, [Fraction(0)] * count
        for k, (support, i) in enumerate(zip(self.supports, self.support_points, strict=True)):
            if support.rotation != "free":
                turning[i] = inf if support.rotation == "fixed" or isinf(turning[i]) else turning[i] + Fraction(support.rotation)
            if closed[k] and isinf(support.stiffness):
                if i in rigid:
                    raise ZeroDivisionError("two rigid supports act at one place")
                rigid[i] = k
            elif closed[k]:
                c = number(Fraction(support.stiffness))
                stiffness[i] += c
                part = _sum((c, {3 * i: one}), (-c * number(self.level[k]), {-1: one}))
                support_force[i] = _sum((one, support_force[i]), (one, part))
        rows, balance = [], []
        for i in range(count):
            w, m_left, m_right = ({3 * i + k: one} for k in range(3))
            rows += [m_left] if i == 0 else []
            rows += [m_right] if i == count - 1 else []
            (psi_left, v_left), (psi_right, v_right) = left[i], right[i]
            jump = _sum((one, m_right), (-one, m_left), (-number(self.couple[i]), {-1: one}))
            if isinf(turning[i]):
                rows += [psi for psi in (psi_left, psi_right) if psi]
            else:
                rows.append(_sum((one, jump), (number(turning[i]), psi_right or psi_left)))
                if i in self.hinges:
                    rows.append(_sum((one, m_left), (number(self.left_of_hinge[i]), {-1: one})))
                elif 0 < i < count - 1:
                    rows.append(_sum((one, psi_left), (-one, psi_right)))
            balance.append(_sum((number(self.force[i]), {-1: one}), (-one, v_left), (one, v_right), (-one, support_force[i])))
            here = rigid.get(i)
            rows.append(balance[-1] if here is None else _sum((one, w), (-number(self.level[here]), {-1: one})))
        values = _eliminate(rows, 3 * count, exact=self.kind is Fraction)

        def value(form: Form):
            return sum((c * values[k] for k, c in form.items()), one * 0)

        self.deflection, self.moment_left, self.moment_right = values[0:-1:3], values[1:-1:3], values[2:-1:3]
        self.shear_left, self.shear_right = ([value(form) for _, form in side] for side in (left, right))
        self.place_deflection = [self.deflection[i] for i in self.support_points]
        self.reaction = []
        for k, (support, i) in enumerate(zip(self.supports, self.support_points, strict=True)):
            if not closed[k]:
                self.reaction.append(one * 0)
            elif rigid.get(i) == k:
                self.reaction.append(value(balance[i]))
            else:
                c = number(Fraction(support.stiffness))
                self.reaction.append(c * (self.deflection[i] - number(self.level[k])))


def _name(x: Fraction, exact_ends: list[Fraction], ends: np.ndarray) -> float:
    """The x of a place as a scene names it: a node's rounded x, and the distance from there."""
    span = max(int(np.searchsorted(ends, float(x), side="right")) - 1, 0)
    span = next(i for i in (span + 1, span, span - 1) if i < len(ends) and exact_ends[i] <= x)
    return float(ends[span] + float(x - exact_ends[span]))


def _piece(a, b, scene: Scene, ends, sections, loads) -> tuple[Fraction, ...]:
    """Length, 1/EI, 1/GA, load and imposed curvature at the left end, each followed by its slope."""
    span = next(i for i, x in enumerate(ends[1:]) if a < x)
    soft = []
    for name in ("EI", "GA"):
        given = getattr(scene.beam, name)
        value = given[span] if isinstance(given, list) else given
        for start, stop, section in sections:
            if section is not None and start <= a < stop and getattr(section, name) is not None:
                value = getattr(section, name)
        soft.append(Fraction(0) if isinf(value) else 1 / Fraction(value))
    q = slope = kappa = more = Fraction(0)
    for start, stop, load in loads:
        if not start <= a < stop:
            continue
        first, last = map(Fraction, at_both_ends(load.kappa if isinstance(load, CurvatureLoad) else load.q))
        rise = (last - first) / (stop - start)
        if isinstance(load, CurvatureLoad):
            kappa, more = kappa + first + rise * (a - start), more + rise
        else:
            q, slope = q + first + rise * (a - start), slope + rise
    return (b - a, *soft, q, slope, kappa, more)


def _sum(*terms: tuple) -> Form:
    """Sum of factors times forms."""
    result: Form = {}
    for factor, form in terms:
        if factor:
            for k, c in form.items():
                result[k] = result[k] + factor * c if k in result else factor * c
    return result


def _eliminate(rows: list[Form], count: int, exact: bool) -> list:
    """Unknowns that make all forms zero; a 1 for the constant term is appended."""
    waiting: list[list[Form]] = [[] for _ in range(count)]

    def sort_in(row: Form) -> None:
        first = min((k for k, c in row.items() if c and k >= 0), default=None)
        if first is None:
            raise ZeroDivisionError("the structure is a mechanism or statically ambiguous")
        waiting[first].append({k: c for k, c in row.items() if (c and k < 0) or k >= first})

    for row in rows:
        sort_in(row)
    pivots = []
    for column, candidates in enumerate(waiting):
        if not candidates:
            raise ZeroDivisionError("the structure is a mechanism or statically ambiguous")
        best = min(candidates, key=len) if exact else max(candidates, key=lambda row: abs(row[column]))
        pivots.append(best)
        for row in candidates:
            if row is best:
                continue
            factor = row[column] / best[column]
            for k, c in best.items():
                old, taken = row.get(k, 0), factor * c
                row[k] = old - taken
                if not exact and abs(row[k]) < abs(taken).scaleb(-DIGITS // 2):
                    row[k] = taken * 0
            del row[column]
            sort_in(row)
    values = [None] * count + [rows[0][next(iter(rows[0]))] * 0 + 1]
    for column in range(count - 1, -1, -1):
        row = pivots[column]
        values[column] = -sum(c * values[k] for k, c in row.items() if k != column) / row[column]
    return values
