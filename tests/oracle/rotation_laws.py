"""Beams with laws of deflections and rotations, in rational numbers: displacement method, every combination of pieces tried.

Nodes have a deflection and a rotation, at hinges one on either side. A law is a list of pieces of a force over a displacement:
straight ones, and vertical ones at which the displacement is known. Of a beam without falling pieces the combination in which every
law is on its piece is the state.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise, product
from typing import NamedTuple

INFINITE = None
"""An end of a piece that has none, or a stiffness of a rigid law."""


class Straight(NamedTuple):
    """A piece: force = force_at + slope (u - at), between two displacements."""

    low: Fraction | None
    high: Fraction | None
    slope: Fraction
    at: Fraction
    force_at: Fraction


class Vertical(NamedTuple):
    """A piece at a displacement, between two forces."""

    at: Fraction
    low: Fraction | None
    high: Fraction | None


def pieces(side=0, stiffness=INFINITE, gap=0, points=()):
    """Pieces of a law: both ways (0), towards positive displacements (1) or negative ones (-1)."""
    gap = Fraction(gap)
    if not points and side == 0:
        if stiffness is None:
            return [Vertical(Fraction(0), None, None)]
        return [Straight(None, None, Fraction(stiffness), Fraction(0), Fraction(0))]
    corners = [(Fraction(0), Fraction(0)), *((Fraction(d), Fraction(f)) for d, f in points)]
    if not points:
        corners.append((Fraction(0), Fraction(1)) if stiffness is None else (Fraction(1), Fraction(stiffness)))
    found = []
    for way in (1, -1) if side == 0 else (side,):
        for k, ((d, f), (to, then)) in enumerate(pairwise(corners)):
            last = k == len(corners) - 2
            if to == d:
                ends = (way * f, None if last else way * then)
                found.append(Vertical(way * (gap + d), *(ends if way > 0 else ends[::-1])))
            else:
                ends = (way * (gap + d), None if last else way * (gap + to))
                found.append(Straight(*(ends if way > 0 else ends[::-1]), (then - f) / (to - d), way * (gap + d), way * f))
    free = (-gap, gap) if side == 0 else (None, gap) if side > 0 else (-gap, None)
    slack = Straight(*free, Fraction(0), Fraction(0), Fraction(0))
    return [*found, slack] if gap or side else found


def moved(law, by):
    """The pieces of a law whose support has been moved."""
    found = []
    for piece in law:
        if isinstance(piece, Vertical):
            found.append(piece._replace(at=piece.at + by))
        else:
            low, high = (None if end is None else end + by for end in (piece.low, piece.high))
            found.append(piece._replace(low=low, high=high, at=piece.at + by))
    return found


def solve(spans, stiffness, laws, q=0, forces=(), couples=()):
    """Forces and displacements of the laws.

    Parameters
    ----------
    spans : list of Fraction
    stiffness : Fraction
        EI.
    laws : list of (x, kind, pieces)
        Kind ``"w"`` of a deflection, ``"turn"`` of a rotation, ``"hinge"`` of the rotation left less that right of x, ``"left"``
        and ``"right"`` of one of these.
    q : Fraction
        Uniform load.
    forces : list of (x, F)
    couples : list of (x, "left" or "right", M)

    Returns
    -------
    (list of Fraction, list of Fraction) or None
        Forces that the laws exert against the displacements, and these; None where there is no equilibrium, or no unique state.
    """
    ends = [sum(spans[:i], Fraction(0)) for i in range(len(spans) + 1)]
    places = sorted({*ends, *(Fraction(x) for x, *_ in laws), *(Fraction(x) for x, _ in forces)})
    cut = {Fraction(x) for x, kind, _ in laws if kind == "hinge"}
    number, count = {}, 0
    for x in places:
        number[x, "w"], number[x, "left"] = count, count + 1
        number[x, "right"] = count + 2 if x in cut else count + 1
        count += 3 if x in cut else 2
    matrix = [[Fraction(0)] * count for _ in range(count)]
    load = [Fraction(0)] * count
    for a, b in pairwise(places):
        length = b - a
        at = [number[a, "w"], number[a, "right"], number[b, "w"], number[b, "left"]]
        rows = ((12, 6, -12, 6), (6, 4, -6, 2), (-12, -6, 12, -6), (6, 2, -6, 4))
        for i in range(4):
            for j in range(4):
                matrix[at[i]][at[j]] += stiffness / length**3 * rows[i][j] * length ** (i % 2 + j % 2)
            load[at[i]] += q * (length / 2, length**2 / 12, length / 2, -(length**2) / 12)[i]
    for x, force in forces:
        load[number[Fraction(x), "w"]] += force
    for x, side, couple in couples:
        load[number[Fraction(x), side]] += couple
    rows = []
    for x, kind, _ in laws:
        row = [Fraction(0)] * count
        row[number[Fraction(x), kind if kind in ("w", "right") else "left"]] = Fraction(1)
        if kind == "hinge":
            row[number[Fraction(x), "right"]] = Fraction(-1)
        rows.append(row)
    for chosen in product(*(law for *_, law in laws)):
        state = _try(matrix, load, rows, chosen)
        if state is not None:
            return state
    return None


def _try(matrix, load, rows, chosen):
    count, held = len(load), [k for k, piece in enumerate(chosen) if isinstance(piece, Vertical)]
    system = [[*row, *(rows[k][i] for k in held), load[i]] for i, row in enumerate(matrix)]
    system += [[*rows[k], *[Fraction(0)] * len(held), chosen[k].at] for k in held]
    for k, piece in enumerate(chosen):
        if k in held:
            continue
        for i in range(count):
            if rows[k][i]:
                for j in range(count):
                    system[i][j] += piece.slope * rows[k][i] * rows[k][j]
                system[i][-1] += rows[k][i] * (piece.slope * piece.at - piece.force_at)
    solution = _gauss(system)
    if solution is None:
        return None
    ways = [sum(a * b for a, b in zip(row, solution, strict=False)) for row in rows]
    forces = []
    for k, piece in enumerate(chosen):
        if k in held:
            forces.append(solution[count + held.index(k)])
            value = forces[-1]
        else:
            forces.append(piece.force_at + piece.slope * (ways[k] - piece.at))
            value = ways[k]
        if (piece.low is not None and value < piece.low) or (piece.high is not None and value > piece.high):
            return None
    return forces, ways


def _gauss(system):
    """Solve; None where the matrix is singular."""
    n = len(system)
    for k in range(n):
        pivot = next((i for i in range(k, n) if system[i][k]), None)
        if pivot is None:
            return None
        system[k], system[pivot] = system[pivot], system[k]
        for i in range(n):
            if i != k and system[i][k]:
                ratio = system[i][k] / system[k][k]
                system[i] = [a - ratio * b if b else a for a, b in zip(system[i], system[k], strict=True)]
    return [row[-1] / row[k] for k, row in enumerate(system)]
