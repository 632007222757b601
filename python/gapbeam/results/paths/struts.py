"""Stretches of a beam that may buckle, and their Euler loads.

Between neighbouring supports that act the Euler load is pi^2 EI/L^2, on an overhang, or beside a hinge, that of twice its
length; where ground acts the load at which a long beam on it buckles, 2 sqrt(k EI), if that is more. P is the largest
compression of the stretch, EI its smallest stiffness.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from ...engine.beam import Beam
from ...engine.quantities import FIELDS
from ...scene.ground_laws import (
    CubicGround,
    HardeningGround,
    HyperbolicGround,
    PlasticGround,
    PowerGround,
    TanhGround,
    slopes_of_branch,
    tables_of,
    varies,
)
from ...scene.ground_tables import least_between
from ..state.breakpoints import piece_of
from ..state.ground import TOUCHING, Contact
from .compression import REFUSED, Compression, larger

if TYPE_CHECKING:
    from ...scene.structs import Foundation, Scene
    from ..state.step import Step


MOST_KNOWN = 64
"""Schemes whose stretches are kept, to be used again."""


class Struts:
    """The stretches of a beam that may buckle.

    Parameters
    ----------
    beam : Beam
        With axial forces.
    """

    def __init__(self, beam: Beam):
        places = beam.places
        self.beam, self.x, self.EI = beam, places.point_x, places.pieces[:, 1]
        self._support_points = places.node_points[places.support_nodes]
        self._carries = beam.columns.support[1, beam.numbers] > 0.0
        self._hinges = np.zeros(len(self.x), bool)
        self._hinges[places.node_points[places.kinds == 1]] = True
        # An elastic one counts as one that turns freely: on the safe side
        for x in beam.columns.hinge[0, :-1][beam.columns.hinge[1, :-1] > 0.0].tolist():
            self._hinges[np.abs(places.point_x - x).argmin()] = True
        self._known: dict[tuple[bytes, ...], tuple[np.ndarray, np.ndarray, np.ndarray]] = {}

    def acting(self, closed: np.ndarray, breakpoints: np.ndarray | None = None) -> np.ndarray:
        """Tell which supports of the engine belong to one of the scene that resists: what yields or is broken does not."""
        beam, acts = self.beam, (closed != 0) & self._carries
        for number, (group, _, _) in beam.laws.items() if beam.has_laws else ():
            acts[group] = piece_of(beam, number, closed, beam.breakpoints if breakpoints is None else breakpoints).slope > 0.0
        return acts

    def stretches(
        self, closed: np.ndarray, breakpoints: np.ndarray | None = None
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Give first points, last points and lengths L of the stretches in a scheme.

        Parameters
        ----------
        closed : numpy.ndarray of int
            1 where a support of the engine acts.
        breakpoints : numpy.ndarray, optional
            The laws of supports as they have become; default those of the beam.
        """
        key = closed.tobytes(), b"" if breakpoints is None else breakpoints.tobytes()
        if key not in self._known:
            if len(self._known) >= MOST_KNOWN:
                self._known.clear()
            held = np.zeros(len(self.x), bool)
            held[self._support_points[self.acting(closed, breakpoints)]] = True
            ends = held | self._hinges
            ends[[0, -1]] = True
            hinged, (points,) = self._hinges & ~held, np.nonzero(ends)
            first, last = points[:-1], points[1:]
            both = (held[first] & held[last]) | (hinged[first] & hinged[last])
            self._known[key] = first, last, (self.x[last] - self.x[first]) * np.where(both, 1.0, 2.0)
        return self._known[key]

    def largest(
        self, closed: np.ndarray, tension: np.ndarray, EI: np.ndarray | None = None, breakpoints: np.ndarray | None = None
    ) -> Compression | None:
        """Find the largest compression beside the Euler load without ground.

        Parameters
        ----------
        closed : numpy.ndarray of int
            The scheme.
        tension : numpy.ndarray
            Axial force of every piece.
        EI : numpy.ndarray, optional
            Bending stiffness of every piece, if it is not the beam's own.
        breakpoints : numpy.ndarray, optional
            As for `stretches`.

        Returns
        -------
        Compression or None
            None where nothing is compressed.
        """
        found, EI = None, self.EI if EI is None else EI
        stretches = self.stretches(closed, breakpoints)
        force, critical, overhangs = self._beside_euler(stretches, tension, EI)
        with np.errstate(all="ignore"):
            ratio = np.where(force > 0.0, force / critical, 0.0)
        follows = (force > 0.0) & overhangs
        largest = np.argmax(np.where(follows, 0.0, ratio), keepdims=True)
        for k in np.union1d(np.flatnonzero(follows), largest[force[largest] > 0.0]).tolist():
            a, b, one = self._compressed(*(column[k].item() for column in stretches), tension)
            found = larger(found, self._beside(float(force[k]), euler(float(EI[a:b].min()), one), self.x[a], self.x[b], one))
        return found

    def notable(self, closed: np.ndarray, tension: np.ndarray, breakpoints: np.ndarray | None = None) -> list[int]:
        """Find the states that may have the largest compression beside the Euler load, or one beyond it.

        Parameters
        ----------
        closed, breakpoints
            As for `largest`.
        tension : numpy.ndarray
            Axial force of every piece, a row a state.

        Returns
        -------
        list of int
            Their rows.
        """
        force, critical, overhangs = self._beside_euler(self.stretches(closed, breakpoints), tension, self.EI)
        wanted = (force[:, overhangs] > 0.0).any(axis=1)
        with np.errstate(all="ignore"):
            most = np.where(overhangs, 0.0, force / critical).max(axis=1)
        wanted |= most >= REFUSED / 2
        wanted[np.argmax(most)] = True
        return np.flatnonzero(wanted).tolist()

    def _beside_euler(
        self, stretches: tuple[np.ndarray, np.ndarray, np.ndarray], tension: np.ndarray, EI: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Compression of stretches, their Euler loads, and which of them overhang, so that their length follows from it."""
        first, last, length = stretches
        if len(first) < len(EI):
            EI, tension = np.minimum.reduceat(EI, first), np.minimum.reduceat(tension, first, axis=-1)
        with np.errstate(all="ignore"):
            critical = np.pi / length * EI * (np.pi / length)
        return -tension, critical, length != self.x[last] - self.x[first]

    def _compressed(self, a: int, b: int, length: float, tension: np.ndarray) -> tuple[int, int, float]:
        """The same stretch and length; of an overhang without what is beyond all compression: that follows as it is."""
        if length == self.x[b] - self.x[a]:
            return a, b, length
        pressed = a + np.flatnonzero(tension[a:b] < 0.0)
        if b == len(self.x) - 1 and a > 0:
            b = int(pressed[-1]) + 1
        elif a == 0 and b < len(self.x) - 1:
            a = int(pressed[0])
        return a, b, 2.0 * float(self.x[b] - self.x[a])

    def _beside(self, force: float, critical: float, start: float, stop: float, length: float | None) -> Compression:
        ratio = force / critical if critical > 0.0 else np.inf
        return Compression(float(ratio), force, float(start), float(stop), length)

    def of_step(self, scene: Scene, step: Step, tension: np.ndarray, breakpoints: np.ndarray | None = None) -> Compression | None:
        """Find the largest compression of a state beside the Euler load.

        Parameters
        ----------
        scene : Scene
        step : Step
            The state.
        tension : numpy.ndarray
            Axial force of every piece.
        breakpoints : numpy.ndarray, optional
            As for `stretches`.

        Returns
        -------
        Compression or None
            None where nothing is compressed.
        """
        return self.largest(step.closed, tension, breakpoints=breakpoints)


class GroundStruts(Struts):
    """The same on the ground, which keeps a beam from buckling where it acts."""

    def of_step(self, scene: Scene, step: Step, tension: np.ndarray, breakpoints: np.ndarray | None = None) -> Compression | None:
        """Find the largest compression of a state beside what supports and ground resist, as `Struts.of_step`."""
        pressure = float(np.abs(step.solution.extremes()[0][:, FIELDS.index("pressure")]).max())
        zones = [
            (zone.from_, zone.to, zone.state, under)
            for zone in step.contact
            for under in [scene.foundation[zone.foundation]]
            if zone.state != TOUCHING
            and any(modulus(under, zone.state, pressure, (x, x), float(self.x[-1])) > 0.0 for x in _places(zone, under))
        ]
        closed, end, x = step.solution.closed, float(self.x[-1]), self.x
        supported = [tuple(one) for one in zip(*(column.tolist() for column in self.stretches(closed)), strict=True)]
        held = set(x[self._support_points[self.acting(closed)]].tolist()) | {at for zone in zones for at in zone[:2]}
        hinges, found = set(x[self._hinges].tolist()), None
        for start, stop in pairwise(sorted({0.0, end} | hinges | held)):
            first, last = (max(bisect_right(x.tolist(), at) - 1, 0) for at in (start, np.nextafter(stop, start)))
            pieces = slice(first, max(min(last, len(self.EI) - 1), first) + 1)
            force, EI = -float(tension[pieces].min()), float(self.EI[pieces].min())
            if not (force > 0.0 and stop > start):
                continue
            here = [zone for zone in zones if zone[0] <= start and stop <= zone[1]]
            k = sum(modulus(under, state, pressure, (start, stop), end) for *_, state, under in here)
            both = {start, stop} <= held or {start, stop} <= hinges - held
            length = (stop - start) * (1.0 if both else 2.0)
            critical = euler(EI, length)
            if k > 0.0:
                around = next(L for a, b, L in supported if x[a] <= start and stop <= x[b])
                length, critical = around, euler(EI, around)
                if resisted(k, EI) >= critical:
                    length, critical = None, resisted(k, EI)
            found = larger(found, self._beside(force, critical, start, stop, length))
        return found


def struts_of(beam: Beam) -> Struts:
    """Choose what the stretches of a beam that may buckle are held by.

    Parameters
    ----------
    beam : Beam
        With axial forces.
    """
    return GroundStruts(beam) if beam.in_stretches else Struts(beam)


def euler(EI: float, length: float) -> float:
    """The Euler load of a stretch of a length, in range."""
    with np.errstate(over="ignore", under="ignore"):
        return float(np.float64(np.pi / length) * EI * (np.pi / length))


def resisted(k: float, EI: float) -> float:
    """The compression at which a long beam on ground of a modulus buckles."""
    return float(2.0 * np.sqrt(k) * np.sqrt(EI))


def _places(zone: Contact, foundation: Foundation) -> list[float]:
    """Ends of a zone, and where tables of its foundation have a point in it."""
    inside = [point[0] for table in tables_of(foundation) for point in table if zone.from_ < point[0] < zone.to]
    return [zone.from_, *inside, zone.to]


def modulus(foundation: Foundation, state: str, pressure: float, between: tuple[float, float], end: float) -> float:
    """Give the least tangent modulus of a foundation in a part of a zone.

    Parameters
    ----------
    foundation : Foundation
    state : str
        Of the zone: ``branch 2`` is on the second piece of a law.
    pressure : float
        The largest pressure anywhere: a curve that gets softer is taken there.
    between : (float, float)
        Ends of the part.
    end : float
        Right end of the beam.
    """
    stretch = (foundation.from_, end if foundation.to is None else foundation.to)

    def least(value: Any) -> float:
        return least_between(value, stretch, *between)

    k, law = foundation.k, foundation.law
    if k is not None:
        return least(k)
    branch = int(state.removeprefix("branch ")) if state.startswith("branch ") else 1
    if varies(law):  # between two places the slope is one between those there
        slopes = slopes_of_branch(law, branch)
        first, last = bisect_right(slopes, (between[0], np.inf)), bisect_left(slopes, (between[1],))
        return min(slope for _, slope in slopes[max(first - 1, 0) : last + 1])
    if isinstance(law, list):
        points = [(0.0, 0.0), *law]
        (d, p), (e, q) = points[min(branch, len(points) - 1) - 1 :][:2]
        return (q - p) / (e - d)
    if isinstance(law, PlasticGround):
        return least(law.stiffness) if branch == 1 else 0.0
    if isinstance(law, HardeningGround):
        return least(law.stiffness if branch == 1 else law.slope)
    if isinstance(law, TanhGround | HyperbolicGround):
        limit = least(law.limit)
        left = max(1.0 - pressure / limit, 0.0) if limit > 0.0 else 0.0
        return least(law.stiffness) * (left * (2.0 - left) if isinstance(law, TanhGround) else left**2)
    if isinstance(law, CubicGround | PowerGround):
        a, b, c = map(least, law.values())
        return max(a - (b * b / (3.0 * c) if b < 0.0 and c > 0.0 else 0.0), 0.0)
    return 0.0
