"""A prepared beam: a handle of what the Fortran layer made of a scene, and typed calls with it."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING

import numpy as np

from ..base.errors import Status, check_status
from ..base.records import read_only
from . import calls as _engine  # the compiled layer itself, but for Ctrl-C
from .arrays import Columns, extended
from .layout import Curve, Layout
from .quantities import QUANTITIES
from .states import Along, Chain, Solution, State
from .units import Units

if TYPE_CHECKING:
    from .runs import Runs

SOLVED, NO_EQUILIBRIUM = Status.SOLVED, Status.NO_EQUILIBRIUM
"""Outcomes, as in gapbeam_error; codes above 10 are errors."""
RULES = {"block": 0, "single": 1}
"""Rules by which schemes are found, as in gapbeam_search."""
GIVEN = "given"
"""Instead of a rule: the scheme is known, as along a path."""
RULE_GIVEN, RULE_EXTENDED = 2, 3
"""Its code, as in gapbeam_extended_precision, and that where lines are followed beyond where it holds, as tangents are."""
ON_LINES, BY_TANGENTS, WITH_LINES, ON_POLYLINES = 0, 1, 2, 3
"""How a state meets smooth laws: on the polylines, or lines, in place of them; by tangents on the laws themselves; on lines that
have to give their forces; on polylines, as far as these give them. The last three as in gapbeam_path_states."""
METHODS = ("block tridiagonal mixed", "three-moment", "mixed with pivoting")
"""What was solved, as in gapbeam_system."""
LAW_ROW, FIRST_CURVE = 6, 3
"""Row of the laws of foundations in `Columns.foundation`, and the first of their codes that is a curve, as in gapbeam_layers."""
HINGE, RESTRAINED = 1, 2
"""Kinds of node other than plain ones (0), as in gapbeam_band."""


class RefusalError(Exception):
    """A number makes no sense: codes of the Fortran layer, for which `gapbeam.scene.refusals` has the words."""

    def __init__(self, reason: int, table: int, entry: int, partner: int, key: str, message: str):
        super().__init__(reason, table, entry, partner, key, message)
        self.codes = (reason, table, entry, partner, key, message)


class Beam(Layout):
    """A beam made ready for solving; it can be pickled, for other processes.

    Parameters
    ----------
    columns : Columns
        What it is made of.
    curves : tuple of (int, Curve), optional
        Supports with a smooth law, of which the columns have a polyline.

    Attributes
    ----------
    pieces, links, supports, scene_supports : int
        Prismatic pieces; links between nodes; supports that can carry across it; supports of the scene.
    bars : int
        Bars of the axial system; -1 if there is none.
    units : Units
        The engine's.
    rooms : list
        Those of calls for cases that are not in use now.
    spare : collections.deque
        Memory of results of cases that nobody has any more.
    has_hinges, has_restraints, has_shear, is_one_sided : bool
        What of that there is; a one-sided support that can carry.
    ground_layers : int
        Layers of ground under all its pieces; 0 without foundations.
    in_stretches, has_axial_force, feels_axial_loads : bool
        Whether it is solved stretch by stretch, as on the ground; whether bending feels axial forces, as it does then; whether it
        feels those of axial loads.
    has_laws, depends_on_path : bool
        A support with a law; one whose force may fall, or that does not unload along its law.
    also : frozenset of str
        Kinds of fields that it has beside its own, as other combinations of a scene have them: forces along it are 0, and what
        reactions balance is the shear.

    Raises
    ------
    RefusalError
        A number makes no sense.
    EngineError
        Numbers are beyond the range of doubles: which ones.
    MemoryError
        The system gives no more memory.
    """

    also: frozenset[str] = frozenset()
    _way: tuple[Runs, float] | None = None
    __hash__ = None

    def __init__(self, columns: Columns, curves: tuple[tuple[int, Curve], ...] = ()):
        self.columns, self.curves = columns, curves
        self._factors: np.ndarray | None = None
        c = columns
        handle, status, reason, table, entry, partner, key, message = _engine.gbmake(
            c.span, c.hinge, c.section, c.support_codes, c.support, c.law_supports, c.law, c.load_codes, c.load,
            c.foundation_sides, c.foundation, c.table_foundations, c.table, c.ground_law_foundations, c.ground_law, c.mass,
            c.axial_forces,
        )  # fmt: skip
        if status == Status.BAD_INPUT:
            raise RefusalError(reason, table, entry, partner, key.decode().strip(), message.decode().strip())
        check_status(status, message)
        self._take(handle)

    def _take(self, handle: int) -> None:
        """Keep a handle, and what it says of itself."""
        self.handle = _engine.Handle(handle)
        self.rooms: list[_engine.Owned] = []
        self.spare: deque[np.ndarray] = deque(maxlen=1)
        sizes, units = _engine.gbsize(handle)
        self.pieces, self.links, self.supports, self.scene_supports, self.bars, *has, layers, forced = sizes.tolist()
        self.in_stretches, self.ground_layers, self.has_axial_force = layers >= 0, max(layers, 0), forced > 0
        self.feels_axial_loads = forced > 1
        (
            self.has_hinges, self.has_restraints, self.has_shear, self.is_one_sided, self.has_laws, self.depends_on_path,
            self.has_links_along,
        ) = map(bool, has)  # fmt: skip
        self.is_on_axial_ground = has[-1] > 1
        self.units = Units(*units.tolist())
        c = self.columns
        self.handle.has_curves = bool((c.foundation[LAW_ROW] >= FIRST_CURVE).any() or c.has_varying_laws())

    def with_factors(self, factors: np.ndarray) -> Beam:
        """Make another beam: each load times its factor, all of them live.

        Parameters
        ----------
        factors : numpy.ndarray
            Of all loads.

        Raises
        ------
        EngineError
            Numbers are beyond the range of doubles.
        MemoryError
            The system gives no more memory.
        """
        handle, status, message = _engine.gbcopy(self.handle, np.append(factors, 0.0))
        check_status(status, message)
        return self._copy(handle, factors)

    def _copy(self, handle: int, factors: np.ndarray | None) -> Beam:
        beam = object.__new__(type(self))
        beam.columns, beam.curves, beam._factors, beam.also = self.columns, self.curves, factors, self.also
        beam._take(handle)
        return beam

    def with_dead_loads_alone(self) -> Beam | None:
        """Make another beam: the dead loads as live ones, as they grow before the path; None if supports move with them."""
        c = self.columns
        if (c.support[3] != 0.0).any() or (c.support[2] < 0.0).any():
            return None
        return self.with_factors(c.load_codes[1, :-1].astype(float))

    def with_breakpoints(self, breakpoints: np.ndarray) -> Beam:
        """Make another beam: the same with the laws of its supports as they have become; itself if they have not changed.

        Parameters
        ----------
        breakpoints : numpy.ndarray
            As the attribute.
        """
        if np.array_equal(breakpoints, self.breakpoints):
            return self
        handle, status, message = _engine.gblaws(self.handle, np.column_stack((breakpoints, np.zeros(4))), self.pieces)
        check_status(status, message)
        beam = self._copy(handle, self._factors)
        beam.__dict__["laws"] = self.laws  # which breakpoints they have stays
        return beam

    def begin_on_way(self, runs: Runs, position: float) -> None:
        """Let states begin where a train comes to on its way: under compression there may be others.

        Parameters
        ----------
        runs : Runs
            The train on its way.
        position : float
            At which it stands on this beam, of which nothing is solved yet.

        Raises
        ------
        EngineError
            As for the states.
        """
        self._way = runs, position
        runs.lead(position, self.handle)

    @property
    def begins_on_way(self) -> bool:
        """Whether its states are those to which a train comes on its way."""
        return self._way is not None

    def __reduce__(self) -> tuple:
        """Pickle by what it is made of."""
        breakpoints = self.breakpoints if self.has_laws else None
        return _made_of, (self.columns, self.curves, self._factors, breakpoints, self.also, self._way)

    def __eq__(self, other: object) -> bool:
        """Whether they are made of the same numbers."""
        if not isinstance(other, Beam):
            return NotImplemented
        same = self.columns == other.columns and (self._factors is None) == (other._factors is None)
        same = same and (self._factors is None or np.array_equal(self._factors, other._factors))
        return self is other or (same and (not self.has_laws or np.array_equal(self.breakpoints, other.breakpoints)))

    def solve(
        self, factor: float, rule: str, closed: np.ndarray, on_laws: int = ON_LINES, along: Along | None = None
    ) -> Solution:
        """Find the contact state at one load factor.

        Parameters
        ----------
        factor : float
            Factor of the live loads.
        rule : {"block", "single", "given"}
            How the contact state is found; GIVEN where it is known.
        closed : numpy.ndarray of int
            Starting scheme, one entry per support; left as it is.
        on_laws : {ON_LINES, BY_TANGENTS, WITH_LINES, ON_POLYLINES}
            How smooth laws are met.
        along : Along, optional
            What there is along the beam, where that is known on a path alone.

        Returns
        -------
        Solution
            The solution, or the motion where there is no equilibrium or the beam buckles.

        Raises
        ------
        EngineError
            Where no unique solution exists for another reason, with the engine's message.
        """
        m, scheme = self.supports, extended(closed)
        code = RULES.get(rule, RULE_EXTENDED if self.curves else RULE_GIVEN)
        undecided, values, counts, share, handle, status, message = _engine.gbsolv(
            self.handle, self.links, self.scene_supports, factor, code, on_laws, scheme
        )
        check_status(status, message)
        solves, method, indifferent, came_back, slides, unique, *on_ground = counts.tolist()
        start = read_only(np.array(closed)) if closed.flags.writeable else closed
        state = State(self, factor, code, start, *on_ground, on_laws, handle, along)
        chain = None
        if self.has_links_along and status == SOLVED:
            if along is not None:
                along.put_into(self, factor, handle)
            values, *found = _engine.gbalng(self.handle, handle, self.scene_supports)
            chain = Chain(*found)
            indifferent = chain.loose
        return Solution(
            status, scheme[:m], undecided[:m], values.T[:, :-1], solves, method, bool(indifferent), bool(came_back), bool(slides),
            bool(unique), share, state, chain,
        )  # fmt: skip

    def solve_again(
        self, factor: float, code: int, start: np.ndarray, on_laws: int, along: Along | None = None
    ) -> _engine.Owned:
        """Solve a state once more.

        Parameters
        ----------
        factor, code, start, on_laws, along
            As of `State`.

        Returns
        -------
        Owned

        Raises
        ------
        EngineError
            Where the first time on another machine it did not.
        """
        *_, handle, status, message = _engine.gbsolv(
            self.handle, self.links, self.scene_supports, factor, code, on_laws, extended(start)
        )
        check_status(status, message)
        if along is not None:
            along.put_into(self, factor, handle)
        return handle

    def find(self, x: np.ndarray, left: bool) -> tuple[np.ndarray, np.ndarray]:
        """Find the pieces of given places.

        Parameters
        ----------
        x : numpy.ndarray
            Places on the beam.
        left : bool
            Whether the piece left of a point is meant, or that on its right.

        Returns
        -------
        piece : numpy.ndarray of int
            The pieces, from 1.
        distance : numpy.ndarray
            Distances from their left ends.

        Raises
        ------
        EngineError
            A place is off the beam.
        """
        if not len(x):
            return np.zeros(0, np.int32), np.zeros(0)
        piece, distance, status, message = _engine.gbfind(self.handle, x, left)
        check_status(status, message)
        return piece, distance

    @property
    def fields(self) -> dict[str, int]:
        """Names of the fields that it has, and which of `FIELDS` they are."""
        own = {"bending": True, "axial": self.bars >= 0, "ground": self.ground_layers > 0, "second order": self.has_axial_force}
        return {one.name: k for k, one in enumerate(QUANTITIES) if own[one.of] or one.of in self.also}


def _made_of(
    columns: Columns, curves: tuple[tuple[int, Curve], ...], factors: np.ndarray | None, breakpoints: np.ndarray | None,
    also: frozenset[str], way: tuple[Runs, float] | None,
) -> Beam:
    """Make a beam that was pickled again."""
    beam = Beam(columns, curves)
    beam.also = also
    if way is not None:
        beam.begin_on_way(*way)
    beam = beam if factors is None else beam.with_factors(factors)
    return beam if breakpoints is None else beam.with_breakpoints(breakpoints)
