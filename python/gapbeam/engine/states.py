"""Solved states: a handle in the compiled layer each, whose numbers come out where they are asked for."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from ..base.errors import check_status
from ..base.records import Record, read_only
from . import calls as _engine
from .quantities import BOUNDED, FIELDS, NUMBERS
from .units import scaled

if TYPE_CHECKING:
    from .beam import Beam

GROUND_ROWS = 19
"""Rows of `Ground.values` beside those of the layers, as GBGGET has them."""
ON_DEMAND = ("deflection", "moment_left", "moment_right", "shear", "reaction", "motion", "displacement", "tension")
"""Arrays of a state that come out of the compiled layer where they are asked for, in the order of GBSGET."""
ALONG_ONLY = 2
"""Of `Chain.loose`: free to move along the axis, held across it."""
ALL = np.array(list(NUMBERS.values()), dtype=np.int32)
"""Numbers of all quantities along the beam."""


class Along(Protocol):
    """What there is along the beam, where that is known on a path alone."""

    def put_into(self, beam: Beam, factor: float, state: _engine.Owned) -> None:
        """Put it into a state."""


class Chain(NamedTuple):
    """Links along the beam, one entry a support of the scene.

    Attributes
    ----------
    conditions : numpy.ndarray of int
        State of every support, as gapbeam_pieces numbers it.
    friction : numpy.ndarray
        Force of friction on the beam, to the right, in the scene's units.
    slip : numpy.ndarray
        How far the beam has gone over the support, to the right, in the scene's units.
    slides : numpy.ndarray of int
        1 where the beam slides over the support to the right, -1 to the left, 0 where it sticks.
    loose : int
        1 where the beam can move freely, 2 where it can along its axis only.
    """

    conditions: np.ndarray
    friction: np.ndarray
    slip: np.ndarray
    slides: np.ndarray
    loose: int


class State:
    """A state in the compiled layer; pickled by what it is solved from, and solved again when it is looked at after that.

    Parameters
    ----------
    beam : Beam
        The beam.
    factor : float
        Load factor.
    code : int
        How the scheme is found, as GBSOLV takes it.
    start : numpy.ndarray of int
        Where the search for it starts.
    stretches, layers : int
        Of a beam on the ground its stretches, and most layers under one of them; else 0.
    on_laws : int
        How it meets smooth laws, as `Beam.solve`.
    handle : Owned, optional
        Of the state.
    along : Along, optional
        What there is along the beam, where that is known on a path alone.
    """

    def __init__(
        self, beam: Beam, factor: float, code: int, start: np.ndarray, stretches: int, layers: int,
        on_laws: int, handle: _engine.Owned | None = None, along: Along | None = None,
    ):  # fmt: skip
        self.beam, self.factor, self.code, self.start = beam, factor, code, read_only(start)
        self.stretches, self.layers, self.on_laws, self.along = stretches, layers, on_laws, along
        if handle is not None:
            self.handle = handle

    def __reduce__(self) -> tuple:
        """Pickle by what it is solved from."""
        about = self.beam, self.factor, self.code, self.start, self.stretches, self.layers, self.on_laws
        return type(self), (*about, None, self.along)

    @cached_property
    def handle(self) -> _engine.Owned:
        """Its number in the compiled layer."""
        return self.beam.solve_again(self.factor, self.code, self.start, self.on_laws, self.along)

    @cached_property
    def arrays(self) -> dict[str, np.ndarray]:
        """The arrays of ON_DEMAND."""
        beam, bars = self.beam, max(self.beam.bars, 0)
        found = dict(zip(ON_DEMAND, _engine.gbsget(self.handle, beam.links, beam.supports, bars), strict=True))
        found |= {"reaction": found["reaction"][:-1], "tension": found["tension"][:-1]}
        return read_only(found)

    @cached_property
    def fields(self) -> _engine.Owned:
        """Its fields at the pieces, in the compiled layer; EngineError where one left the range of doubles."""
        fields, status, message = _engine.gbreco(self.beam.handle, self.beam.pieces, self.handle)
        check_status(status, message)
        return fields

    @cached_property
    def ground(self) -> Ground | None:
        """What is in its stretches, with foundations."""
        return Ground(self) if self.layers else None


class Ground:
    """A solution on the ground, stretch by stretch from left to right, in the engine's units.

    Parameters
    ----------
    state : State
        The state.
    """

    __hash__ = None

    def __init__(self, state: State):
        self.state = state

    def __reduce__(self) -> tuple:
        """Pickle with the state."""
        return type(self), (self.state,)

    def __eq__(self, other: object) -> bool:
        """Whether all numbers are equal."""
        if not isinstance(other, Ground):
            return NotImplemented
        pairs = zip(self._taken, other._taken, strict=True)
        return self is other or all(np.array_equal(a, b, equal_nan=True) for a, b in pairs)

    @cached_property
    def _taken(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        return read_only(_engine.gbgget(self.state.handle, self.state.stretches, self.state.layers))

    @property
    def values(self) -> np.ndarray:
        """A column a stretch.

        Rows: piece (from 1); distances of its ends from the left end of the piece, length; moduli at its ends; loads qa, qb, qc,
        kappa beside the chord; deflections, moments, rotations, shears at its ends; slope of the chord; and of every layer under
        it the force up, then the piece of its law on which it acts (0: not in contact).
        """
        return self._taken[0]

    @property
    def bounds(self) -> np.ndarray:
        """Of the errors of deflection, rotation, moment, shear, reactions."""
        return self._taken[1]

    @property
    def residuals(self) -> np.ndarray:
        """Of compatibility, equilibrium and complementarity, by the audit that the state stood."""
        return self._taken[2]

    @property
    def layers(self) -> int:
        """Most layers under a stretch."""
        return self.state.layers

    @property
    def stretches(self) -> int:
        """Stretches between nodes, of which the ends of zones are some."""
        return self.state.stretches

    @property
    def resultants(self) -> np.ndarray:
        """Force of every layer on the beam, up, layers by stretches."""
        return self.values[GROUND_ROWS : GROUND_ROWS + self.layers]

    @property
    def acts(self) -> np.ndarray:
        """Piece of its law on which every layer acts, layers by stretches."""
        return read_only(self.values[GROUND_ROWS + self.layers :].astype(np.int32))


def _array(name: str, doc: str) -> property:
    """An array of the state that is looked at where it is asked for."""
    return property(lambda self: self.state.arrays[name], doc=doc)


@dataclass(frozen=True, slots=True, eq=False)
class Solution(Record):
    """What the engine found at one load factor, in its own units (`Beam.units`).

    Attributes
    ----------
    status : int
        SOLVED, NO_EQUILIBRIUM or BUCKLES; else only `motion`, `slides` and `share` have a meaning.
    closed : numpy.ndarray of int
        1 where a support acts, 0 where it is open.
    undecided : numpy.ndarray of int
        1 where its reaction or opening is zero, so that it may be closed or open.
    at_supports : numpy.ndarray
        Reaction, deflection, opening and couple of the scene's supports in its units, 4 rows.
    solves : int
        Linear solves; they do not count when solutions are compared.
    method : int
        Index into METHODS.
    indifferent : bool
        Whether the beam can move freely without work of the loads: forces are unique, the position is not.
    came_back : bool
        Whether the rule ``single`` came back to a scheme, so that ``block`` went on.
    slides : bool
        Whether nothing holds the beam along its axis.
    unique : bool
        Whether it is known to be the only one; under compression, and on ground whose force falls, there may be others.
    share : float
        Share of the axial forces that the beam bears where it buckles, of the load factor where the ground's force falls; else 1.
    state : State
        All the rest.
    chain : Chain, optional
        Of links along the beam.
    """

    status: int
    closed: np.ndarray
    undecided: np.ndarray
    at_supports: np.ndarray
    solves: int = field(compare=False)
    method: int
    indifferent: bool
    came_back: bool
    slides: bool
    unique: bool
    share: float
    state: State = field(compare=False)
    chain: Chain | None = field(default=None, compare=False)

    def __eq__(self, other: object) -> bool:
        """Whether all numbers are equal."""
        same = super(Solution, self).__eq__(other)
        if same is not True or self is other:
            return same
        pairs = [(getattr(self, name), getattr(other, name)) for name in ON_DEMAND]
        return all(np.array_equal(a, b, equal_nan=True) for a, b in pairs) and self.ground == other.ground

    def slopes(self) -> np.ndarray:
        """Give the slopes of the smooth laws in the scene's units, in the order of `Beam.curves`."""
        beam = self.state.beam
        return _engine.gbslop(beam.handle, self.state.handle, len(beam.curves) + 1)[:-1]

    def yielded(self) -> np.ndarray:
        """Give what supports with plastic unloading keep on a loading history, in the scene's units; 0 of others.

        Returns
        -------
        numpy.ndarray
            Elastic energies, permanent sets, and displacements less what the supports have moved themselves, shape (3, nsupport).
        """
        beam = self.state.beam
        return _engine.gbyiel(beam.handle, self.state.handle, beam.scene_supports)[:-1].T

    deflection = _array("deflection", "Deflections of the nodes.")
    moment_left = _array("moment_left", "Moments left of the nodes.")
    moment_right = _array("moment_right", "Moments right of the nodes.")
    shear = _array("shear", "Shears of the links, beside those of the simple bar.")
    reaction = _array("reaction", "Reaction of every support, positive upward.")
    motion = _array("motion", "Displacements of the nodes in the free motion, positive downward, largest 1.")
    displacement = _array("displacement", "Displacements of the points of the axial system.")
    tension = _array("tension", "Forces in the bars of the axial system.")

    @property
    def ground(self) -> Ground | None:
        """What is in its stretches, with foundations."""
        return self.state.ground

    def certify(self) -> tuple[np.ndarray, np.ndarray, bool]:
        """Check it, and bound its errors by comparison with a solution in quadruple precision.

        Returns
        -------
        residuals : numpy.ndarray
            Relative residuals of compatibility, equilibrium and complementarity.
        bounds : numpy.ndarray
            Largest errors of deflections of the nodes and of reactions; of deflections, rotations, moments, shears along the
            beam, in the engine's units.
        known : bool
            False where the beam is free to move: deflections and rotations have no bound then.

        Raises
        ------
        EngineError
            The state cannot be checked.
        """
        beam = self.state.beam
        residuals, bounds, known, status, message = _engine.gbcert(beam.handle, beam.links + 1, self.state.handle)
        check_status(status, message, "the state could not be checked in quadruple precision: ")
        return residuals, bounds, bool(known)

    def values(self, piece: np.ndarray, distance: np.ndarray) -> np.ndarray:
        """Fields at given distances from the left ends of pieces.

        Parameters
        ----------
        piece : numpy.ndarray of int
            The pieces, from 1.
        distance : numpy.ndarray
            The distances, in the scene's units.

        Returns
        -------
        numpy.ndarray
            FIELDS by places, in the scene's units; zero of what the beam does not have.

        Raises
        ------
        EngineError
            A field left the range of doubles.
        """
        state = self.state
        found = np.empty((len(FIELDS), len(piece)))
        for part in _engine.parts(len(piece)):
            found[:, part], status, message = _engine.gbvalu(
                state.beam.handle, state.stretches, state.handle, state.fields, ALL, piece[part], distance[part]
            )
            check_status(status, message)
        return found

    def extremes(self) -> tuple[np.ndarray, np.ndarray]:
        """Exact extremes of all fields.

        Returns
        -------
        values, x : numpy.ndarray
            Maximum and minimum (rows) of every field in the order of FIELDS (columns), and where they are.

        Raises
        ------
        EngineError
            A field left the range of doubles.
        """
        state = self.state
        values, x, status, message = _engine.gbextr(
            state.beam.handle, state.beam.pieces, state.stretches, state.handle, state.fields, ALL
        )
        check_status(status, message)
        return values, x

    def largest_fields(self) -> np.ndarray:
        """Largest absolute values of deflection, rotation, moment, shear, in the engine's units."""
        state, beam = self.state, self.state.beam
        if beam.in_stretches:
            values, _ = self.extremes()
            bounded = [FIELDS.index(name) for name in BOUNDED]
            return scaled(np.abs(values[:, bounded]).max(axis=0), -np.array(beam.units.field))
        return _engine.gblarg(beam.handle, beam.pieces, state.handle, state.fields)
