"""True answers of meshed beams: the displacement method in decimals of many digits, node by node.

Another method than the engine's (cubic Hermite elements, exact at the nodes of prismatic ones), in another arithmetic. Its
loss of digits grows with the fourth power of the number of elements: of `DIGITS` decimals 50 are left for 10^5 elements.
"""

from __future__ import annotations

from dataclasses import dataclass
from decimal import Decimal, localcontext

import numpy as np

from .meshes import MeshedBeam

DIGITS = 80
"""Decimal digits carried."""
MOST_CHANGES = 100
"""Contact states tried before giving up."""


@dataclass
class Truth:
    """True values at the nodes, as unevaluated sums of two doubles.

    Attributes
    ----------
    deflection, moment, reaction : tuple of numpy.ndarray
        The nearest doubles and what they lack; moments sagging, reactions positive upward.
    closed : numpy.ndarray of bool
        Which supports act.
    right : bool
        Whether the contact state given was right.
    """

    deflection: tuple[np.ndarray, np.ndarray]
    moment: tuple[np.ndarray, np.ndarray]
    reaction: tuple[np.ndarray, np.ndarray]
    closed: np.ndarray
    right: bool = True


def error(values: np.ndarray, true: tuple[np.ndarray, np.ndarray], at: np.ndarray | slice = slice(None)) -> float:
    """Largest error of some values, relative to the largest true one.

    Parameters
    ----------
    values : numpy.ndarray
        What to judge.
    true : tuple of numpy.ndarray
        From `Truth`.
    at : slice or numpy.ndarray of int
        Nodes that count; default all.

    Returns
    -------
    float
        inf where a value is not finite.
    """
    high, low = true[0][at], true[1][at]
    values = np.asarray(values)
    if not np.all(np.isfinite(values)):
        return float("inf")
    return float(np.abs((values - high) - low).max() / np.abs(high).max())


def solve_exactly(beam: MeshedBeam, closed: np.ndarray | None = None) -> Truth:
    """Solve a beam; wrong supports are switched until the contact conditions hold.

    Parameters
    ----------
    beam : MeshedBeam
    closed : numpy.ndarray of bool, optional
        Contact state to begin with; default all closed.

    Raises
    ------
    ArithmeticError
        Where a scheme on the way is a mechanism, or none is found.

    Examples
    --------
    >>> from gapbeam.studies.meshes import one_span
    >>> beam = one_span(10)
    >>> length = beam.length.sum()
    >>> float(solve_exactly(beam).moment[0][5] / (1.1 * length**2 / 8))
    1.0
    """
    supported = beam.stiffness > 0.0
    closed = supported.copy() if closed is None else np.array(closed, dtype=bool)
    with localcontext() as context:
        context.prec = DIGITS
        for change in range(MOST_CHANGES):
            w, m, r = _solve(beam, closed.tolist())
            wrong = [
                i
                for i in np.flatnonzero(supported & (beam.side != 0)).tolist()
                if int(beam.side[i]) * (r[i] if closed[i] else Decimal(beam.level[i]) - w[i]) < 0
            ]
            if not wrong:
                return Truth(_pairs(w), _pairs(m), _pairs(r), closed, change == 0)
            closed[wrong if change < MOST_CHANGES // 2 else wrong[:1]] ^= True
    raise ArithmeticError("no contact state satisfies the contact conditions exactly")


def _pairs(values: list[Decimal]) -> tuple[np.ndarray, np.ndarray]:
    high = [float(value) for value in values]
    return np.array(high), np.array([float(value - Decimal(near)) for value, near in zip(values, high, strict=True)])


def _solve(beam: MeshedBeam, closed: list[bool]) -> tuple[list[Decimal], list[Decimal], list[Decimal]]:
    """Deflections, moments and reactions of a scheme, by block elimination from left to right."""
    n = beam.elements
    zero = Decimal(0)
    h, EI, q = ([Decimal(value) for value in column.tolist()] for column in (beam.length, beam.EI, beam.q))
    level, force = ([Decimal(value) for value in column.tolist()] for column in (beam.level, beam.force))
    stiffness = beam.stiffness.tolist()
    held = [closed[i] and stiffness[i] == float("inf") for i in range(n + 1)]
    clamped = [beam.clamped[0], *[False] * (n - 1), beam.clamped[1]]
    load = list(force)
    for i in range(n):
        half = q[i] * h[i] / 2
        load[i] += half
        load[i + 1] += half
    # What the elements on the left pass on to the node: stiffness a, b, c of (w, rotation) and load f, g
    a = b = c = f = g = zero
    factor = []
    for i in range(n + 1):
        f += load[i]
        if i > 0:
            g -= q[i - 1] * h[i - 1] ** 2 / 12
        if i < n:
            k = 2 * EI[i] / h[i] ** 3
            k12, k6, k4, k2 = 6 * k, 3 * k * h[i], 2 * k * h[i] ** 2, k * h[i] ** 2
            a, b, c = a + k12, b + k6, c + k4
            g += q[i] * h[i] ** 2 / 12
        if closed[i] and not held[i]:
            spring = Decimal(stiffness[i])
            a += spring
            f += spring * level[i]
        # Inverse [p s; s t] of [a b; b c] where both displacements are unknown; known ones: w = level, rotation = 0
        x = level[i] if held[i] else zero
        if held[i] and clamped[i]:
            p = s = t = zero
        elif held[i]:
            p, s, t = zero, zero, 1 / c
            f, g = zero, g - b * x
        elif clamped[i]:
            p, s, t = 1 / a, zero, zero
        else:
            determinant = a * c - b * b
            if not determinant > 0:
                raise ArithmeticError("the structure is a mechanism")
            p, s, t = c / determinant, -b / determinant, a / determinant
        u, v = p * f + s * g + x, s * f + t * g
        if i == n:
            break
        factor.append((p, s, t, u, v, k12, k6, k2))
        # Column of the next node: rows w: (-k12, k6), rotation: (-k6, k2)
        pw, pr = -p * k12 - s * k6, -s * k12 - t * k6
        qw, qr = p * k6 + s * k2, s * k6 + t * k2
        a = k12 + k12 * pw + k6 * pr
        b = -k6 + k12 * qw + k6 * qr
        c = k4 - k6 * qw - k2 * qr
        f = k12 * u + k6 * v
        g = -k6 * u - k2 * v
    w, rotation = [u], [v]
    for p, s, t, u, v, k12, k6, k2 in reversed(factor):
        f, g = k12 * w[-1] - k6 * rotation[-1], k6 * w[-1] - k2 * rotation[-1]
        w.append(u + p * f + s * g)
        rotation.append(v + s * f + t * g)
    w.reverse()
    rotation.reverse()
    moment, shear = [], [zero]
    for i in range(n):
        chord = (w[i + 1] - w[i]) / h[i]
        k = 2 * EI[i] / h[i]
        first, last = rotation[i] - chord, rotation[i + 1] - chord
        couple = q[i] * h[i] ** 2 / 12
        moment.append(k * (2 * first + last) - couple)
        shear.append(3 * k * (first + last) / h[i])
    moment.append(-k * (first + 2 * last) - couple)
    shear.append(zero)
    reaction = [
        load[i] + shear[i] - shear[i + 1] if held[i] else Decimal(stiffness[i]) * (w[i] - level[i]) if closed[i] else zero
        for i in range(n + 1)
    ]
    return w, moment, reaction


def solve_one_span(beam: MeshedBeam) -> Truth:
    """Closed form of a simple beam of equal elements under a uniform load.

    Parameters
    ----------
    beam : MeshedBeam
        From `one_span`.
    """
    n = beam.elements
    with localcontext() as context:
        context.prec = DIGITS
        h, EI, q = Decimal(float(beam.length[0])), Decimal(float(beam.EI[0])), Decimal(float(beam.q[0]))
        bend, turn = q * h**4 / (24 * EI), q * h**2 / 2
        w = [bend * (i * (n - i) * (n * n + n * i - i * i)) for i in range(n + 1)]
        m = [turn * (i * (n - i)) for i in range(n + 1)]
        r = [Decimal(0)] * (n + 1)
        r[0] = r[-1] = q * h * n / 2
        return Truth(_pairs(w), _pairs(m), _pairs(r), beam.stiffness > 0.0)
