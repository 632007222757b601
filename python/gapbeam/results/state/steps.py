"""The steps of a result: few bytes are kept of each, the rest is solved again when it is looked at."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from ...base.errors import NoStepError, SceneError
from ...base.memory import LITTLE, refuse_beyond
from ...base.records import Pickled, read_only
from ...engine.beam import Beam
from ...engine.modes import Buckling
from ...scene.held import hold
from ...scene.movements import settle_movements
from ...scene.reading import beam_of
from ...scene.structs import Scene
from .arguments import whole
from .motion import FallingGround, cause_of_fall
from .step import Known, Step, name_states, solve_step

if TYPE_CHECKING:
    from ..paths.branches import BranchPath
    from ..paths.path import Path, Segment


class Steps(Pickled, Sequence[Step]):
    """The steps of a result, in the order of the load.

    A step is made when it is looked at. The step looked at last and the last one stay.

    Parameters
    ----------
    beam : Beam
        The beam.
    rule : {"block", "single"}
        How contact states are found.
    """

    def __init__(self, beam: Beam, rule: str):
        self._beam = beam
        self._rule = rule
        self._kept: dict[str, tuple[int, Step]] = {}
        self.outcome: tuple[str, str | None] = ("solved", None)  # why there are none

    def __repr__(self) -> str:
        """Show how many there are."""
        return f"{type(self).__name__}({len(self)})"

    @abstractmethod
    def _make(self, k: int) -> Step:
        """Make a step that knows how to solve itself."""

    @abstractmethod
    def closed(self, k: int) -> np.ndarray:
        """Give the contact state of a step.

        Parameters
        ----------
        k : int
            Number of the step, from 0.

        Returns
        -------
        numpy.ndarray of int
            1 where a support across the beam acts.
        """

    def beam_at(self, factor: float) -> Beam:
        """Give the beam at a load factor.

        Parameters
        ----------
        factor : float
            Load factor.
        """
        return self._beam

    @abstractmethod
    def factor(self, k: int) -> float:
        """Give the load factor of a step.

        Parameters
        ----------
        k : int
            Number of the step, from 0.
        """

    @overload
    def __getitem__(self, index: int) -> Step: ...

    @overload
    def __getitem__(self, index: slice) -> list[Step]: ...

    def __getitem__(self, index: int | slice) -> Step | list[Step]:
        """Give a step, from the end where the number is negative; or a list of steps."""
        if isinstance(index, slice):
            return [self._make(k) for k in range(len(self))[index]]
        count = len(self)
        if not count and self.outcome[1] is not None:
            raise NoStepError(*self.outcome)
        if isinstance(index, str):
            raise TypeError(f'step: expected a whole number, got "{index}"')
        index = whole("step", index)
        if not -count <= index < count:
            raise IndexError(f"there is no load step {index}; their numbers go from 0 to {count - 1}, or from -{count} to -1")
        k = index % count
        for at, step in self._kept.values():
            if at == k:
                return step
        step = self._make(k)
        self._kept["last" if k == len(self) - 1 else "latest"] = k, step
        return step

    def __iter__(self) -> Iterator[Step]:
        """Go through the steps; none stays because of that."""
        kept = dict(self._kept.values())
        return (kept[k] if k in kept else self._make(k) for k in range(len(self)))

    def history(self) -> Iterator[tuple[float, tuple[str, ...]]]:
        """Follow the contact state over the load, without solving.

        Yields
        ------
        (float, tuple of str)
            Load factor and the state of every support of a step; of equal schemes one after the other the same tuple.
        """
        before: np.ndarray | None = None
        states: tuple[str, ...] = ()
        for k in range(len(self)):
            if self._beam.has_links_along:
                yield self.factor(k), self[k].state
                continue
            closed = self.closed(k)
            if before is None or not np.array_equal(closed, before):
                before, states = closed, name_states(self._beam, closed)
            yield self.factor(k), states


class LoadSteps(Steps):
    """Equal steps of the load factor up to 1, each started from the scheme of the one before.

    A bit a support is kept of each, and what it took. As the same search from the same start, a step that is made again
    has the same digits as when it was solved first; where the scheme stays the same that takes one solve.

    Parameters
    ----------
    beam, rule
        As for `Steps`.
    start : numpy.ndarray of int
        Where the search of the first step starts.
    count : int
        Number of steps.

    Raises
    ------
    SceneError
        There is not the memory for so many.
    """

    def __init__(self, beam: Beam, rule: str, start: np.ndarray, count: int):
        super().__init__(beam, rule)
        self._start = start
        self._count = count
        self._solved = 0
        row = -(-len(start) // 8)
        what, remedy = f"{count:,} load steps", 'take fewer, or follow = "events"'
        needed = float(count) * (row + 12)
        refuse_beyond("analysis.steps", what, needed, remedy)
        try:
            self._schemes = np.empty((count, row), dtype=np.uint8)
            self._solves = np.empty(count, dtype=np.int32)
            self._seconds = np.empty(count)
        except MemoryError:
            if needed <= LITTLE:
                raise  # it is not for the steps that there is no memory
            raise SceneError("analysis.steps", f"there is no memory for {what}; {remedy}") from None

    def __len__(self) -> int:
        """Count the steps that stand."""
        return self._solved

    def factor(self, k: int) -> float:
        """Give the load factor of a step, as in `Steps`."""
        return (k + 1) / self._count

    def closed(self, k: int) -> np.ndarray:
        """Give the contact state of a step, as in `Steps`."""
        return read_only(np.unpackbits(self._schemes[k], count=len(self._start)).astype(np.int32))

    def _before(self, k: int) -> np.ndarray:
        return self.closed(k - 1) if k else self._start

    def _make(self, k: int) -> Step:
        known = Known(self.closed(k), int(self._solves[k]), float(self._seconds[k]))
        return Step(self.beam_at(self.factor(k)), self.factor(k), self._rule, self._before(k), known)

    def solve_all(self) -> tuple[float, np.ndarray | None, Buckling | FallingGround | None] | None:
        """Solve one step after the other, as long as they stand.

        Returns
        -------
        None or (float, numpy.ndarray or None, Buckling, FallingGround or None)
            None if all stand; else the load factor at which there is no equilibrium, with the free motion of the nodes,
            or None where the beam slides along its axis, and how it buckles, or what falling ground bears.

        Raises
        ------
        EngineError
            As `Beam.solve`.
        """
        for k in range(self._count):
            step = solve_step(self.beam_at(self.factor(k)), self.factor(k), self._rule, self._before(k))
            if not isinstance(step, Step):
                self._schemes, self._solves, self._seconds = (
                    part[:k].copy() for part in (self._schemes, self._solves, self._seconds)
                )
                return self.factor(k), None if step.slides else step.motion, cause_of_fall(step)
            self._schemes[k] = np.packbits(step.closed)
            self._solves[k] = step.solves
            self._seconds[k] = step.seconds
            self._solved = k + 1
            self._kept["last"] = k, step
        return None

    @property
    def solves(self) -> int:
        """Linear solves of all steps."""
        return int(self._solves[: self._solved].sum(dtype=np.int64))

    @property
    def seconds(self) -> float:
        """Time they took."""
        return float(self._seconds[: self._solved].sum())

    def nearest(self, factor: float) -> np.ndarray:
        """Give the contact state of the step nearest to a load factor.

        Parameters
        ----------
        factor : float

        Returns
        -------
        numpy.ndarray of int
            As `closed`; where no step stands, the start.
        """
        k = round(min(max(factor * self._count, 1.0), float(self._solved))) - 1
        return self._before(k + 1)


class MovedSteps(LoadSteps):
    """The same of a beam whose supports loads have moved: it is another one at every load factor.

    Parameters
    ----------
    scene : Scene
        With loads that move supports.
    beam, rule, start, count
        As for `LoadSteps`, the beam that of any load factor.
    """

    def __init__(self, scene: Scene, beam: Beam, rule: str, start: np.ndarray, count: int):
        super().__init__(beam, rule, start, count)
        self._scene = hold(scene)

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Take the attributes back."""
        super().__setstate__(state)
        hold(self._scene)

    def beam_at(self, factor: float) -> Beam:
        """Give the beam at a load factor, as in `LoadSteps`."""
        return beam_of(settle_movements(self._scene, factor))


class PathSteps(Steps):
    """The states at every event and at the end of a path; or at given load factors on it.

    Parameters
    ----------
    beam, rule
        As for `Steps`.
    path : Path or BranchPath
        Knows the schemes.
    factors : sequence of float, optional
        Load factors, as far as the path comes to them in a stable state.
    """

    def __init__(self, beam: Beam, rule: str, path: Path | BranchPath, factors: Sequence[float] | None = None):
        super().__init__(beam, rule)
        self._path = path
        if factors is None:
            self._at = [(segment.stop, segment) for segment in path.segments]
        else:
            found = ((factor, path.find(factor)) for factor in factors)
            self._at = [(factor, segment) for factor, segment in found if segment is not None]

    def __len__(self) -> int:
        """Count the states."""
        return len(self._at)

    def factor(self, k: int) -> float:
        """Give the load factor of a step, as in `Steps`."""
        return self._at[k][0]

    def segment(self, k: int) -> Segment:
        """Give the segment of the path on which a step lies.

        Parameters
        ----------
        k : int
            Number of the step, from 0.
        """
        return self._at[k][1]

    def closed(self, k: int) -> np.ndarray:
        """Give the contact state of a step, as in `Steps`."""
        return read_only(self._path.closed(self.segment(k)))

    def _make(self, k: int) -> Step:
        return self._path.step(self.segment(k), self.factor(k))
