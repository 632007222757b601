"""The least energy of a beam on one-sided ground with laws of all kinds, by displacement elements: another way than the engine's.

Cubic Hermite elements with Gauss points, Newton's method with the slope of the laws, and a line search on the slope of the energy
along the step, which never falls. The laws are those of `ground_laws.py`. No hinges, no shear; supports hold both ways or one way
by a stiffness, rigid ones are stiff springs. Where zones end pressures have kinks, so deflections converge with
the square of the length of the elements.
"""

from itertools import pairwise

import numpy as np
from scenes import nodes_of, place
from scipy.linalg import solveh_banded

from .ground_laws import pressure

POINTS, WEIGHTS = np.polynomial.legendre.leggauss(4)
RIGID = 1e12


def solve(made, parts):
    """Deflections of a beam on ground.

    Parameters
    ----------
    made : dict
        A scene: uniform loads and forces, factor 1.
    parts : int
        Elements between two places at which something begins or ends.

    Returns
    -------
    tuple of ndarray
        Places, deflections and rotations there.
    """
    length = nodes_of(made)[-1]
    ends = {0.0, length, *nodes_of(made)}
    for item in (*made["loads"], *made["foundation"], *made.get("supports", ())):
        ends |= {item[key] for key in ("from", "to", "x") if key in item} | {x for x, _ in item.get("profile", ())}
    ends = np.array(sorted(x for x in ends if 0.0 <= x <= length))
    x = np.unique(np.concatenate([np.linspace(a, b, parts + 1) for a, b in pairwise(ends)]))
    h, t = np.diff(x)[:, None], (1.0 + POINTS) / 2.0
    at = x[:-1, None] + h * t
    one = np.ones_like(h)
    shape = np.stack(
        [
            (1 - 3 * t**2 + 2 * t**3) * one,
            h * (t - 2 * t**2 + t**3),
            (3 * t**2 - 2 * t**3) * one,
            h * (t**3 - t**2),
        ]
    )  # (4, elements, points)
    bent = np.stack([(12 * t - 6) * one, h * (6 * t - 4), (6 - 12 * t) * one, h * (6 * t - 2)]) / h**2
    measure = WEIGHTS / 2.0 * h
    EI = np.broadcast_to(np.array(made["beam"]["EI"], dtype=float), len(made["beam"]["spans"]))
    EI = EI[np.clip(np.searchsorted(nodes_of(made), at[:, :1], side="right") - 1, 0, len(EI) - 1)]
    place_of = 2 * np.arange(len(h))[:, None] + np.arange(4)
    load = np.zeros(2 * len(x))
    for item in made["loads"]:
        if item["type"] == "force":
            load[2 * np.argmin(abs(x - item["x"]))] += item["F"]
        else:
            inside = (at > item.get("from", 0.0)) & (at < item.get("to", length))
            np.add.at(load, place_of, np.einsum("iep,ep->ei", shape, measure * inside * item["q"]))
    held = []
    for item in made.get("supports", ()):
        stiffness = min(item.get("stiffness", RIGID), RIGID)
        held.append((2 * np.argmin(abs(x - place(made, item))), stiffness, item.get("side", "both"), item.get("gap", 0.0)))

    def force(w):
        """Forces of ground and supports on the unknowns, and what makes their slope."""
        deep = np.einsum("iep,ei->ep", shape, w[place_of])
        small = 1e-7 * (abs(deep) + 1e-9)
        p = pressure(made, at, deep)
        slope = np.maximum(0.0, (pressure(made, at, deep + small) - pressure(made, at, deep - small)) / (2.0 * small))
        found = np.zeros_like(load)
        np.add.at(found, place_of, np.einsum("iep,ep->ei", shape, measure * p))
        springs = np.zeros_like(load)
        for i, k, side, gap in held:
            beyond = w[i] if side == "both" else max(0.0, w[i] - gap) if side == "below" else min(0.0, w[i] + gap)
            found[i] += k * beyond
            springs[i] += k * (side == "both" or beyond != 0.0)
        return found, slope, springs

    def band(slope, springs):
        local = np.einsum("iep,jep,ep->eij", bent, bent, measure * EI) + np.einsum("iep,jep,ep->eij", shape, shape, measure * slope)
        rows = np.zeros((4, len(load)))
        for i in range(4):
            for j in range(i + 1):
                np.add.at(rows[i - j], place_of[:, j], local[:, i, j])
        rows[0] += springs + ease
        return rows

    stiff = np.einsum("iep,jep,ep->eij", bent, bent, measure * EI)

    def bend(w):
        return np.bincount(place_of.ravel(), np.einsum("eij,ej->ei", stiff, w[place_of]).ravel(), len(load))

    ease = 1e-4 * EI.min() / length**3
    w = np.zeros_like(load)
    for _ in range(300):
        f, slope, springs = force(w)
        step = solveh_banded(band(slope, springs), load - bend(w) - f, lower=True)
        here, bends = bend(w) - load, bend(step)

        def falls(t, w=w, step=step, bends=bends, here=here):
            return step @ (here + t * bends + force(w + t * step)[0])

        first, low, high = falls(0.0), 0.0, 1.0
        while falls(high) < -0.5 * abs(first) and high < 1e12:
            low, high = high, 4.0 * high
        gone = high
        if falls(high) > 0.1 * abs(first):
            for _ in range(60):
                gone = (low + high) / 2.0
                low, high = (gone, high) if falls(gone) < 0.0 else (low, gone)
                if abs(falls(gone)) <= 0.1 * abs(first):
                    break
        w = w + gone * step
        if gone == 1.0 and abs(step[::2]).max() <= 1e-8 * abs(w[::2]).max():
            break
    else:
        raise ArithmeticError("no least energy was found")
    return x, w[::2], w[1::2]
