"""A train at many positions in numpy: the yardstick for exact envelopes.

It is what a careful script does: all positions at once, one inverse for every set of supports that act, the
positions at which that set changes halved until doubles have no number between, and all positions at which an axle is at a support,
with the shears on both sides of it. Moments are taken at supports, under axles and where the shear is zero between them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from .active_set import NoScheme

MOST_CHANGES = 40
"""Changes of the supports that act before giving up."""
HALVINGS = 52
"""Halvings of an interval of positions in which that set changes."""
SEARCHES = 40
"""Halvings of the distance at which a better position is searched for."""
ZERO = 1e-12
"""Share of the heaviest axle, or of the largest deflection, that is taken for zero: else a support at an event changes for ever."""


@dataclass
class Swept:
    """Largest and smallest values over all positions.

    Attributes
    ----------
    moment, shear : numpy.ndarray
        The largest and the smallest.
    reaction : numpy.ndarray
        The same of every support, 2 by supports.
    """

    moment: np.ndarray
    shear: np.ndarray
    reaction: np.ndarray


class Sweep:
    """A beam of straight spans and the train that goes over it, as arrays.

    Parameters
    ----------
    scene : mapping
        As for `solve_train`.
    """

    def __init__(self, scene: Mapping[str, Any]):
        self.h = np.array(scene["beam"]["spans"])
        self.x = np.concatenate(([0.0], np.cumsum(self.h)))
        self.EI, self.q = float(scene["beam"]["EI"]), sum(load["q"] for load in scene["loads"])
        self.at = np.array([item["node"] for item in scene["supports"]])
        self.one_sided = np.array([item.get("side", "both") == "below" for item in scene["supports"]])
        self.c = np.array([item.get("stiffness", np.inf) for item in scene["supports"]])
        self.d, self.P = np.array(scene["trains"][0]["axles"]).T
        self.last = self.x[-1] + self.d.max()
        k, h = 2.0 * self.EI / self.h**3, self.h
        self.k = np.array([[6 + 0 * h, 3 * h, -6 + 0 * h, 3 * h], [3 * h, 2 * h**2, -3 * h, h**2],
                           [-6 + 0 * h, -3 * h, 6 + 0 * h, -3 * h], [3 * h, h**2, -3 * h, 2 * h**2]]) * k  # fmt: skip
        n = 2 * len(self.x)
        self.K = np.zeros((n, n))
        for e in range(len(h)):
            self.K[2 * e : 2 * e + 4, 2 * e : 2 * e + 4] += self.k[:, :, e]
        self.inverses: dict[bytes, np.ndarray] = {}

    def axles(self, s: np.ndarray, left: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Spans and distances in them of all axles.

        Parameters
        ----------
        s : numpy.ndarray
            Positions of the first axle.
        left : numpy.ndarray of bool
            Whether an axle that is at a support belongs to the span before it.

        Returns
        -------
        span : numpy.ndarray of int
            Axles by positions; -1 off the beam.
        a : numpy.ndarray
            Distances from the left end of the span.
        """
        places = s - self.d[:, None]
        near = self.x[np.abs(places[..., None] - self.x).argmin(axis=-1)]
        places = np.where(np.abs(places - near) < 1e-12 * self.x[-1], near, places)
        span = np.where(left, np.searchsorted(self.x, places, "left"), np.searchsorted(self.x, places, "right")) - 1
        span = np.where((span < 0) | (span >= len(self.h)), -1, span)
        return span, np.where(span < 0, 0.0, places - self.x[span])

    def loads(self, span: np.ndarray, a: np.ndarray) -> np.ndarray:
        """Forces and couples of all spans on their nodes, positions by spans by 4.

        Parameters
        ----------
        span, a : numpy.ndarray
            From `axles`.
        """
        h, n = self.h, span.shape[1]
        found = np.zeros((n, len(h), 4))
        found += self.q * np.array([h / 2, h**2 / 12, h / 2, -(h**2) / 12]).T
        rows = np.arange(n)
        for e, at, P in zip(span, a, self.P, strict=True):
            t = at / h[e]
            shape = [(1 + 2 * t) * (1 - t) ** 2, at * (1 - t) ** 2, t * t * (3 - 2 * t), -at * t * (1 - t)]
            found[rows, e] += np.where(e < 0, 0.0, P)[:, None] * np.array(shape).T
        return found

    def solve(self, s: np.ndarray, left: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Solve all positions: supports that are wrong change until none is.

        Parameters
        ----------
        s, left : numpy.ndarray
            As for `axles`.

        Returns
        -------
        closed : numpy.ndarray of bool
            Positions by supports.
        reaction : numpy.ndarray
            The same.
        ends : numpy.ndarray
            Moment and shear at the left ends of the spans, 2 by positions by spans.

        Raises
        ------
        NoScheme
            No set of supports that act was found.
        """
        local = self.loads(*self.axles(s, left))
        f = np.zeros((len(s), len(self.K)))
        for e in range(len(self.h)):
            f[:, 2 * e : 2 * e + 4] += local[:, e]
        w = np.empty_like(f)
        closed, todo = np.ones((len(s), len(self.at)), bool), np.arange(len(s))
        for _ in range(MOST_CHANGES):
            schemes, of = np.unique(closed[todo], axis=0, return_inverse=True)
            for k, scheme in enumerate(schemes):
                rows = todo[of.ravel() == k]
                w[rows] = f[rows] @ self._inverse(scheme)
            reaction = self._reactions(w[todo], f[todo], closed[todo])
            deep = w[todo][:, 2 * self.at]
            pulls, reaches = reaction < -ZERO * self.P.max(), deep > ZERO * np.abs(deep).max(initial=0.0)
            wrong = self.one_sided & np.where(closed[todo], pulls, reaches)
            todo = todo[wrong.any(axis=1)]
            if not len(todo):
                break
            closed[todo] ^= wrong[wrong.any(axis=1)]
        else:
            raise NoScheme(f"the loop over positions found no supports that act in {MOST_CHANGES} solves")
        ends = np.array([
            [w[:, 2 * e : 2 * e + 4] @ self.k[row, :, e] - local[:, e, row] for e in range(len(self.h))] for row in (1, 0)
        ])  # fmt: skip
        return closed, self._reactions(w, f, closed), ends.transpose(0, 2, 1) * np.array([1.0, -1.0])[:, None, None]

    def _inverse(self, closed: np.ndarray) -> np.ndarray:
        """Inverse of the stiffness, rigid supports held."""
        key = closed.tobytes()
        if key not in self.inverses:
            K, rigid = self.K.copy(), 2 * self.at[closed & np.isinf(self.c)]
            elastic = closed & np.isfinite(self.c)
            K[2 * self.at[elastic], 2 * self.at[elastic]] += self.c[elastic]
            K[rigid], K[:, rigid] = 0.0, 0.0
            K[rigid, rigid] = 1.0
            self.inverses[key] = np.linalg.inv(K)
            self.inverses[key][rigid] = 0.0
        return self.inverses[key]

    def _reactions(self, w: np.ndarray, f: np.ndarray, closed: np.ndarray) -> np.ndarray:
        rest = (f - w @ self.K)[:, 2 * self.at] if np.isinf(self.c).any() else 0.0
        elastic = np.where(np.isinf(self.c), 0.0, self.c) * w[:, 2 * self.at]
        return np.where(closed, np.where(np.isinf(self.c), rest, elastic), 0.0)

    def values(self, s: np.ndarray, left: np.ndarray, reaction: np.ndarray, ends: np.ndarray) -> np.ndarray:
        """Largest and smallest values of every state.

        Parameters
        ----------
        s, left : numpy.ndarray
            As for `axles`.
        reaction, ends : numpy.ndarray
            From `solve`.

        Returns
        -------
        numpy.ndarray
            Largest and smallest (2) moment, shear and reaction of every support, by positions.
        """
        span, a = self.axles(s, left)
        rows, axles = np.arange(len(s)), list(zip(span, a, self.P, strict=True))
        moment, shear = ends
        far = moment + shear * self.h - self.q * self.h**2 / 2
        far_shear = shear - self.q * self.h
        for e, at, P in axles:
            there = np.where(e < 0, 0.0, P)
            far[rows, e] -= there * (self.h[e] - at)
            far_shear[rows, e] -= there
        moments, shears, inside = [moment, far], [shear, far_shear], []
        if self.q:
            first = np.broadcast_to(self.h, moment.shape).copy()
            for e, at, _ in axles:
                first[rows, e] = np.where(e < 0, first[rows, e], np.minimum(first[rows, e], at))
            inside.append(self._peaks(moment, shear, (shear > 0.0) & (shear < self.q * first)))
        for e, at, P in axles:
            m, v = moment[rows, e] + shear[rows, e] * at - self.q * at**2 / 2, shear[rows, e] - self.q * at
            following = self.h[e]  # the distance to which it is straight
            for other, b, Q in axles:
                m, v = (where - np.where((other == e) & (b < at), Q * arm, 0.0) for where, arm in ((m, at - b), (v, 1.0)))
                following = np.where((other == e) & (b > at), np.minimum(following, b), following)
            m, v, after = (np.where(e < 0, 0.0, what) for what in (m, v, v - P))
            moments, shears = [*moments, m], [*shears, v, after]
            if self.q:
                inside.append(self._peaks(m, after, (after > 0.0) & (after < self.q * (following - at))))
        found = np.empty((2, 2 + len(self.at), len(s)))
        for i, best in enumerate((np.maximum, np.minimum)):
            for k, arrays in enumerate((moments if i else (*moments, *inside), shears)):
                found[i, k] = best.reduce([best.reduce(v, axis=1) if v.ndim > 1 else v for v in arrays])
            found[i, 2:] = reaction.T
        return found

    def at_positions(self, s: np.ndarray, left: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Solve positions, and give which supports act, and `values`.

        Parameters
        ----------
        s, left : numpy.ndarray
            As for `axles`.

        Returns
        -------
        closed, values : numpy.ndarray
        """
        closed, reaction, ends = self.solve(s, left)
        return closed, self.values(s, left, reaction, ends)

    def _peaks(self, moment: np.ndarray, shear: np.ndarray, where: np.ndarray) -> np.ndarray:
        """Moments at which the shear has come to zero under the uniform load."""
        return np.where(where, moment + shear**2 / (2.0 * self.q), moment)


def by_numpy(scene: Mapping[str, Any], positions: int, refined: bool = False) -> Callable[[], Swept]:
    """Make the call of the loop in numpy.

    Parameters
    ----------
    scene : mapping
        As for `solve_train`.
    positions : int
        Equidistant ones, to which those are added at which an axle is at a support, or the supports that act change.
    refined : bool
        Whether the neighbourhood of every position at which something is largest is searched.

    Returns
    -------
    callable
    """
    return partial(_numpy, scene, positions, refined)


def _numpy(scene: Mapping[str, Any], positions: int, refined: bool) -> Swept:
    sweep = Sweep(scene)
    s, left = _positions(sweep, positions)
    closed, values = sweep.at_positions(s, left)
    change = np.flatnonzero((closed[1:] != closed[:-1]).any(axis=1) & (s[1:] > s[:-1]))
    low, high, before = s[change], s[change + 1], closed[change]
    side = np.zeros(len(change), bool)
    for _ in range(HALVINGS if len(change) else 0):
        middle = (low + high) / 2.0
        same = (sweep.solve(middle, side)[0] == before).all(axis=1)
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    events = np.concatenate((low, high))
    values = np.append(values, sweep.at_positions(events, np.concatenate((side, side)))[1], axis=2)
    found = np.array([values[0].max(axis=1), values[1].min(axis=1)])
    return swept(_refined(sweep, np.append(s, events), values, sweep.last / (positions - 1)) if refined else found)


def swept(found: np.ndarray) -> Swept:
    """Name the largest and smallest values of all positions.

    Parameters
    ----------
    found : numpy.ndarray
        The largest and the smallest (2) of moment, shear, and reactions.
    """
    return Swept(found[:, 0], found[:, 1], found[:, 2:])


def _refined(sweep: Sweep, s: np.ndarray, values: np.ndarray, step: float) -> np.ndarray:
    """Search beside the best position of every value, nearer and nearer, for a better one."""
    sign = np.array([1.0, -1.0])[:, None]
    best = (sign[..., None] * values).argmax(axis=2).ravel()
    at, kind = s[best], np.arange(best.size)
    most = (sign[..., None] * values).max(axis=2).ravel()
    right = np.zeros(2 * at.size, bool)
    for _ in range(SEARCHES):
        step /= 2.0
        tried = np.clip(np.concatenate((at - step, at + step)), 0.0, sweep.last)
        there = (sign[..., None] * sweep.at_positions(tried, right)[1]).reshape(at.size, -1)
        for part in (slice(0, at.size), slice(at.size, None)):
            new = there[kind, np.arange(2 * at.size)[part]]
            at, most = np.where(new > most, tried[part], at), np.maximum(new, most)
    return sign * most.reshape(2, -1)


def _positions(sweep: Sweep, positions: int) -> tuple[np.ndarray, np.ndarray]:
    """Equidistant positions, and twice those at which an axle is at a support."""
    equal = np.linspace(0.0, sweep.last, positions)
    passing = np.unique((sweep.x + sweep.d[:, None]).ravel())
    equal = equal[(np.abs(equal[:, None] - passing) > 1e-9 * sweep.last).all(axis=1)]
    s = np.concatenate((equal, passing, passing))
    left = np.arange(len(s)) >= len(s) - len(passing)
    order = np.lexsort((~left, s))
    return s[order], left[order]
