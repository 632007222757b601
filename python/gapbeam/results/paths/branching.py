"""Stable paths beyond a bifurcation on smooth laws, and where the load stops growing along one of them.

On polylines of equal laws that soften together the slopes on both sides of a breakpoint decide what is stable, and these depend on
where the breakpoints happen to be. Here the equations of `Arc` are followed on the laws themselves from the bifurcation on, by
pseudo-arclength (Keller 1977) with short steps.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...engine.arcs import Arc, ArcState, LostError
from ..state.smooth import SmoothLaws

ASIDE = 0.01
"""How far beside the bifurcation the branches are looked for, in sizes of the deflections."""
FIRST, LONGEST, SHORTEST = 0.005, 0.05, 1e-7
"""Steps along a branch, in sizes of the deflections and the factor."""
MOST = 5_000
"""Steps after which a branch is given up."""
BEND = 0.1
"""Longest change of direction in a step."""
SETTLED, CORRECTIONS = 1e-13, 12
"""Relative change at which a point is found, and corrections that this may take."""
RISES = 1e-10
"""Relative change of the load factor by which it rises or falls."""
SINGULAR = 1e-4
"""Relative singular value below which a direction is left out where branches cross."""
NEAREST, LESS_INDEPENDENT = 1e-5, 4.0
"""How near to a crossing of branches the equations are looked at; how much less dependent than that tells they may be."""
NEAR = 1e-9
"""Relative size of what is zero."""


class Branch(NamedTuple):
    """What comes after a bifurcation.

    Attributes
    ----------
    points : list of numpy.ndarray
        Deflections at the laws and load factor, from the bifurcation on; the bifurcation only where no way on is stable.
    arrives : bool
        Whether it ends at the load factor wanted; else the load cannot grow beyond its end.
    lost : bool
        Whether a stable way goes on, but not to be followed: another support passes an end of its piece, for instance.
    """

    points: list[np.ndarray]
    arrives: bool
    lost: bool = False


class Tracer:
    """The equations at the smooth laws, about a state at which the path branches.

    Parameters
    ----------
    arc : Arc
        Through the state.
    state : State
        The bifurcation.
    """

    def __init__(self, arc: Arc, state: ArcState):
        self._arc, self._laws, self._origin = arc, SmoothLaws(arc.beam), state.point.copy()
        self._force = self._forces(state.point)[0]
        self._weights = arc.weights

    def _forces(self, point: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        d, way = self._laws.past_the_gap(point[:-1])
        force, slope = self._laws.forces_and_slopes(d)
        return force * way, slope, d

    def _jacobian(self, point: np.ndarray) -> np.ndarray:
        """Derivatives by relative deflections and factor, in relative deflections."""
        slope = self._forces(point)[1]
        left = np.eye(len(slope)) + self._arc.flexibility * (slope - self._arc.springs)
        return np.column_stack([left, -self._arc.under_load * self._weights[-1] / self._weights[0]])

    def _residual(self, point: np.ndarray) -> np.ndarray:
        moved = point - self._origin
        pushed = self._forces(point)[0] - self._force - self._arc.springs * moved[:-1]
        return (moved[:-1] - moved[-1] * self._arc.under_load + self._arc.flexibility @ pushed) / self._weights[0]

    def _correct(self, point: np.ndarray, along: np.ndarray) -> np.ndarray:
        """Go to the path at right angles to a direction."""
        start = point
        for _ in range(CORRECTIONS):
            matrix = np.vstack([self._jacobian(point), along])
            wrong = np.append(self._residual(point), along @ ((point - start) / self._weights))
            change = np.linalg.lstsq(matrix, -wrong, rcond=NEAR)[0]
            point = point + change * self._weights
            if np.abs(change).max() <= SETTLED:
                return point
        if np.abs(change).max() <= NEAR:
            return point
        raise LostError

    def _tangent(self, point: np.ndarray, like: np.ndarray) -> np.ndarray:
        """Direction of the path in relative numbers, as far as it is one, in the way of another one."""
        tangent = np.linalg.svd(self._jacobian(point))[2][-1]
        return tangent if tangent @ like > 0.0 else -tangent

    def _is_stable(self, point: np.ndarray) -> bool:
        values = self._arc.eigenvalues(self._forces(point)[1])
        return bool(values.min() > -NEAR * np.abs(values).max())

    def _check(self, point: np.ndarray) -> None:
        """Whether all supports are still on their pieces."""
        d = self._forces(point)[2]
        if ((d > 0.0) != (self._forces(self._origin)[2] > 0.0)).any() or not self._arc.holds_at(point, NEAR):
            raise LostError

    def follow(self, way: int, goal: float) -> Branch:
        """Follow a stable way on until the load cannot grow any more.

        Parameters
        ----------
        way : int
            1 or -1: where the load goes.
        goal : float
            Load factor at which to end.

        Returns
        -------
        Branch

        Raises
        ------
        LostError
            Whether a stable way goes on cannot be told.
        """
        jacobian = self._jacobian(self._origin)[:, :-1]
        *_, sizes, rows = np.linalg.svd(jacobian)
        if len(sizes) > 1 and sizes[-2] < SINGULAR * sizes[0]:
            raise LostError
        null = np.append(rows[-1], 0.0)
        null = null * (1.0 if null[np.abs(null).argmax()] > 0.0 else -1.0)
        found, size = [], max(abs(self._origin[-1]), self._weights[-1] * ASIDE)
        for side in (1.0, -1.0):
            point = self._correct(self._origin + side * ASIDE * null * self._weights, null)
            rise = way * (point[-1] - self._origin[-1])
            if abs(rise) < RISES * size:
                raise LostError
            if rise > 0.0 and self._is_stable(point):
                found.append((point, side * null))
        if not found:
            return Branch([self._origin], False)
        point, like = found[0]
        try:
            self._check(point)
            return self._go_on([self._origin, point], self._tangent(point, like), way, goal)
        except LostError:
            return Branch([self._origin, point], False, True)

    def _go_on(self, points: list[np.ndarray], tangent: np.ndarray, way: int, goal: float) -> Branch:
        step = FIRST
        for _ in range(MOST):
            point = points[-1]
            try:
                ahead = self._correct(point + step * tangent * self._weights, tangent)
                turned = self._tangent(ahead, tangent)
                if np.abs(turned - tangent).max() > BEND:
                    raise LostError
            except LostError:
                step /= 2
                if step < SHORTEST:
                    raise
                continue
            if way * turned[-1] <= 0.0:
                top = self._crossing(point, tangent, step)
                if top is None:
                    top = self._top(point, tangent, step, way)
                    self._check(top)
                    return Branch([*points, top], False)
                points, tangent, step = [*points, top], self._across(top, way), FIRST
                points.append(self._correct(top + step * tangent * self._weights, tangent))
                tangent = self._tangent(points[-1], tangent)
                if not (way * tangent[-1] > 0.0 and self._is_stable(points[-1])):
                    raise LostError
                continue
            if way * (ahead[-1] - goal) >= 0.0:
                end = self.at_factor([*points, ahead], goal)
                self._check(end)
                return Branch([*points, end], True)
            if not self._is_stable(ahead):
                raise LostError
            self._check(ahead)
            points.append(ahead)
            tangent, step = turned, min(1.3 * step, LONGEST)
        raise LostError

    def _top(self, point: np.ndarray, tangent: np.ndarray, step: float, way: int) -> np.ndarray:
        """Where the load stops growing, within a step."""
        low, high = 0.0, step
        for _ in range(60):
            middle = (low + high) / 2
            ahead = self._correct(point + middle * tangent * self._weights, tangent)
            low, high = (middle, high) if way * self._tangent(ahead, tangent)[-1] > 0.0 else (low, middle)
        return self._correct(point + low * tangent * self._weights, tangent)

    def _crossing(self, point: np.ndarray, tangent: np.ndarray, step: float) -> np.ndarray | None:
        """Where other branches cross within a step, at which the load is stationary too; None where none does.

        The equations are dependent there, and nearby as much less so as it is nearer. At the point itself nothing is found well.
        """
        place, size, first = step / 2, step / 2, 0.0
        while size > NEAREST:
            beside = [self._correct(point + at * tangent * self._weights, tangent) for at in (place - size, place + size)]
            low, high = (self._tangent(at, tangent)[-1] for at in beside)
            most = max(map(self._independence, beside)) / size
            first = first or most
            if most > LESS_INDEPENDENT * first or low * high > 0.0:
                return None
            place += size * (low + high) / (low - high)
            size /= 10.0
        return (beside[0] + beside[1]) / 2

    def _independence(self, point: np.ndarray) -> float:
        """How far the equations are from dependent ones: they are where branches cross."""
        sizes = np.linalg.svd(self._jacobian(point), compute_uv=False)
        return float(sizes[-1] / sizes[0])

    def _across(self, point: np.ndarray, way: int) -> np.ndarray:
        """Direction of the other branch where branches cross."""
        jacobian = self._jacobian(point)
        ahead = np.append(np.linalg.lstsq(jacobian[:, :-1], -jacobian[:, -1], rcond=SINGULAR)[0], 1.0)
        return way * ahead / np.linalg.norm(ahead)

    def at_factor(self, points: list[np.ndarray], factor: float) -> np.ndarray:
        """Find the point of a branch at a load factor.

        Parameters
        ----------
        points : list of numpy.ndarray
            Points along which the factor rises or falls.
        factor : float
            Between those of the first and the last one.

        Returns
        -------
        numpy.ndarray

        Raises
        ------
        LostError
            There is none.
        """
        factors = np.array([point[-1] for point in points])
        k = int(np.clip(np.flatnonzero((factors[:-1] - factor) * (factors[1:] - factor) <= 0.0)[:1].sum(), 0, len(points) - 2))
        share = (factor - factors[k]) / (factors[k + 1] - factors[k])
        along = np.append(np.zeros(len(points[0]) - 1), 1.0)
        point = points[k] + share * (points[k + 1] - points[k])
        point[-1] = factor
        return self._correct(point, along)
