"""Reaction over movement of one support along the loading history, and the energy that it takes up in every cycle."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ...base.hints import no_such
from ...base.records import Record
from ...scene.names import labels
from ...scene.wording import shown
from .branches import BranchPath

if TYPE_CHECKING:
    from ..result import Result
    from ..state.step import Step

ROUNDING = 1e-12
"""Share of what goes in and out of a cycle below which what stays in it is rounding."""
FINE = 200
"""States about along a path that is not kept as segments."""


class Cycle(NamedTuple):
    """A cycle of the load: to a factor of its history and back to the next, or what is left at the end.

    Attributes
    ----------
    points : slice
        Of the states.
    legs : tuple of int
        Which factors of the history are gone to.
    energy : float
        What the support takes up: its reaction times its movement, summed up (force times length). Where the load does not come
        back, part of it is kept and not dissipated.
    closed : bool
        Whether the load comes back to where the cycle began.
    """

    points: slice
    legs: tuple[int, ...]
    energy: float
    closed: bool


@dataclass(frozen=True, slots=True, eq=False)
class Loop(Record):
    """Reaction over movement of a support, state by state in the order of the path: at both ends of every stretch of it.

    Attributes
    ----------
    support : int
        Number of the support.
    factor : numpy.ndarray
        Load factors.
    leg : numpy.ndarray of int
        Which factor of the history each state is on the way to, from 0.
    movement : numpy.ndarray
        Deflection of the beam there, positive downward; of an axial support, and of friction, along the beam, to the right. The
        rotation that a support holds, clockwise; of a hinge that left of it less that right of it.
    reaction : numpy.ndarray
        Force on the beam, positive upward; of an axial support, and of friction, to the right. The couple of what holds a rotation,
        counterclockwise; of a hinge its sagging moment.
    cycles : list of Cycle
        Two factors of the history each.
    """

    support: int
    factor: np.ndarray
    leg: np.ndarray
    movement: np.ndarray
    reaction: np.ndarray
    cycles: list[Cycle]

    @property
    def energy(self) -> float:
        """What the support takes up over the whole history: what is dissipated, and what it keeps at its end."""
        return float(sum(cycle.energy for cycle in self.cycles))


def loop_of(result: Result, support: int | str | None = None, friction: bool = False) -> Loop:
    """Give reaction and movement of a support along the loading history.

    Parameters
    ----------
    result : Result
        Of one load.
    support : int or str, optional
        Number or name; default the one that takes up most energy.
    friction : bool
        True: what friction does along the beam, instead of the reaction.

    Raises
    ------
    ValueError
        No state stands, there is no such support, or it has no friction.
    """
    if result.combinations:
        raise ValueError("every combination has a way of the load of its own; take one of them, result.combinations[NAME]")
    if not result.steps:
        raise ValueError(f"there is no state: {result.reason}")
    states, legs = _way(result)
    supports = result.scene.supports
    names = ("friction", "slip") if friction else ("reaction", "deflection")
    force, movement = (np.array([getattr(state, name) for state in states]) for name in names)
    # Pushed to the right a support pushes to the left; upward is against deflections already
    along = np.array([friction or one.direction == "axial" for one in supports], dtype=bool)
    taken = np.where(along, -force, force)
    if support is None:
        across = [k for k, one in enumerate(supports) if (one.friction if friction else one.direction != "axial")]
        if not across:
            raise ValueError("support: none has friction" if friction else "support: there is none across the beam")
        most = (abs(_energy(taken[:, k], movement[:, k])) for k in across)
        chosen = max(zip(most, np.abs(force[:, across]).max(axis=0), [-k for k in across], across, strict=True))[3]
    else:
        chosen = _number(result, support)
        if friction and not supports[chosen].friction:
            raise ValueError(f"support: {labels(supports)[chosen]} has no friction")
    factors = np.array([state.factor for state in states])
    cycles = _cycles(taken[:, chosen], movement[:, chosen], factors, legs)
    return Loop(chosen, factors, legs, movement[:, chosen], force[:, chosen], cycles)


def _cycles(force: np.ndarray, movement: np.ndarray, factors: np.ndarray, legs: np.ndarray) -> list[Cycle]:
    """Cut the loading history into cycles: two factors of its history each."""
    there = np.unique(legs).tolist()
    found = []
    for first in range(0, len(there), 2):
        pair = tuple(there[first : first + 2])
        which = np.flatnonzero(np.isin(legs, pair))
        begin = max(int(which[0]) - 1, 0)  # from where the one before ended
        points = slice(begin, int(which[-1]) + 1)
        back = len(pair) == 2 and bool(factors[points][0] == factors[points][-1])
        found.append(Cycle(points, pair, _energy(force[points], movement[points]), back))
    return found


def _energy(force: np.ndarray, movement: np.ndarray) -> float:
    """Sum up reaction times movement; exact where the force is linear from state to state, and 0 where it is but rounding."""
    parts = (force[1:] + force[:-1]) / 2 * np.diff(movement)
    energy = float(parts.sum())
    return energy if abs(energy) > ROUNDING * np.abs(parts).sum() else 0.0


def _way(result: Result) -> tuple[list[Step], np.ndarray]:
    """Give the states in the order of the path, and the leg of each."""
    path = result.path
    if isinstance(path, BranchPath):
        states, legs = [], []
        for segment in path.segments:
            there = path.along(segment)
            states += there
            legs += [segment.leg] * len(there)
        if path.ending and path.limits and path.limits[-1].landing is not None:
            # Where a jump would land that is not made
            states.append(path.limits[-1].landing)
            legs.append(legs[-1])
        return states, np.array(legs, dtype=int)
    if result.segments:
        ends = [0.0, *sorted({segment.stop for segment in result.segments})]
        between = [a + (b - a) * share for a, b in pairwise(ends) for share in np.linspace(0.0, 1.0, max(2, FINE // len(ends)))]
        states = [result.state(factor) for factor in dict.fromkeys(between)]
        return states, np.zeros(len(states), dtype=int)
    states = list(result.steps)
    rises = np.sign(np.diff([0.0, *(state.factor for state in states)]))
    return states, np.concatenate(([0], np.cumsum(rises[1:] * rises[:-1] < 0.0))).astype(int)


def _number(result: Result, support: Any) -> int:
    """Find a support by its number or its name."""
    names = labels(result.scene.supports)
    if support in names:
        support = names.index(support)
    if isinstance(support, str):
        raise ValueError(no_such("support", support, names))
    if not isinstance(support, int | np.integer) or isinstance(support, bool) or not -len(names) <= support < len(names):
        raise ValueError(f"support: expected a number below {len(names)} or a name, got {shown(support)}")
    return range(len(names))[support]
