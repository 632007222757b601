"""Typed calls of the Fortran engine."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from ..base.errors import Status, check_status
from ..base.records import Pickled, Record, read_only
from . import calls as _f77  # the engine itself, but for Ctrl-C
from .arrays import LONGER, STIFFER, STRONGER, check_links, refuse_farthest, to_scene
from .lowering import Arrays
from .units import scaled

SOLVED, NO_EQUILIBRIUM = Status.SOLVED, Status.NO_EQUILIBRIUM
"""Outcomes, as in gapbeam_error; codes above 10 are errors."""
_NO_MEMORY = int(Status.NO_MEMORY)  # compared faster
RULES = {"block": 0, "single": 1}
GIVEN = "given"
"""Instead of a rule: the scheme is known, as along a path."""
OPENS, CLOSES, TURNS = 0, 1, 3
"""Events, as in gapbeam_path."""
METHODS = ("block tridiagonal mixed", "three-moment", "mixed with pivoting")
"""What was solved, as in gapbeam_system."""


@dataclass(frozen=True, slots=True, eq=False)
class Solution(Record):
    """What the engine found at one load factor, in its own units (`Arrays.units`).

    Attributes
    ----------
    status : int
        SOLVED or NO_EQUILIBRIUM; in the second case only `motion` has a meaning.
    closed : numpy.ndarray of int
        1 where a support acts, 0 where it is open.
    undecided : numpy.ndarray of int
        1 where its reaction or opening is zero, so that it may be closed or open.
    deflection, moment_left, moment_right : numpy.ndarray
        At the nodes.
    shear : numpy.ndarray
        Of the links, beside that of the simple bar.
    reaction : numpy.ndarray
        Of every support, positive upward.
    motion : numpy.ndarray
        Displacements of the nodes in the free motion, positive downward, largest 1.
    solves : int
        Linear solves; they do not count when solutions are compared.
    method : int
        Index into METHODS.
    indifferent : bool
        Whether the beam can move freely without work of the loads: forces are unique, the position is not.
    came_back : bool
        Whether the rule ``single`` came back to a scheme, so that ``block`` went on.
    """

    status: int
    closed: np.ndarray
    undecided: np.ndarray
    deflection: np.ndarray
    moment_left: np.ndarray
    moment_right: np.ndarray
    shear: np.ndarray
    reaction: np.ndarray
    motion: np.ndarray
    solves: int = field(compare=False)
    method: int
    indifferent: bool
    came_back: bool


def condense(arrays: Arrays) -> np.ndarray:
    """Condense all pieces between nodes into links.

    Parameters
    ----------
    arrays : Arrays
        The lowered scene.

    Returns
    -------
    numpy.ndarray
        The links, for the other calls only.

    Raises
    ------
    EngineError
        A number left the range of double precision: which one.
    """
    links, lost, status = _f77.gbcond(*_detail(arrays))
    check_status(status)
    check_links(arrays, lost)
    return read_only(links)


def solve(arrays: Arrays, links: np.ndarray, factor: float, rule: str, closed: np.ndarray) -> Solution:
    """Find the working scheme at one load factor.

    Parameters
    ----------
    arrays : Arrays
        The lowered scene.
    links : numpy.ndarray
        Its condensed links.
    factor : float
        Factor of the live loads.
    rule : {"block", "single", "given"}
        How the working scheme is found; GIVEN where it is known.
    closed : numpy.ndarray of int
        Starting scheme, one entry per support; left as it is.

    Returns
    -------
    Solution
        The solution, or the free motion where there is no equilibrium.

    Raises
    ------
    EngineError
        Where no unique solution exists for another reason, with the engine's message.
    """
    scheme = _scheme(closed)
    *values, indifferent, came_back, status, message = _f77.gbsolv(
        *_detail(arrays), *_beam(arrays, links), factor, RULES.get(rule, 2), scheme
    )
    if status == Status.NOT_FINITE:
        refuse_farthest(arrays)
    check_status(status, message)
    solution = Solution(status, scheme, *values, bool(indifferent), bool(came_back))
    if len(closed) == 0:
        solution = replace(solution, closed=scheme[:0], undecided=scheme[:0], reaction=solution.reaction[:0])
    return solution


@dataclass(frozen=True, slots=True)
class Path:
    """A piece of the load path.

    Attributes
    ----------
    status : int
        SOLVED, or NO_EQUILIBRIUM if the beam begins to move above `factor`.
    factor : float
        How far it goes.
    closed : numpy.ndarray of int
        The scheme there, before what changes there.
    marginal : numpy.ndarray of int
        1 for the supports at zero there.
    factors : numpy.ndarray
        Load factors of the events, those at its beginning included.
    supports : numpy.ndarray of int
        Their supports, from 0.
    events : numpy.ndarray of int
        What happens to them: OPENS, CLOSES or TURNS.
    motion : numpy.ndarray
        As in `Solution`.
    solves : int
        Linear solves of the whole beam.
    nodes : int
        Nodes at which the solution was made anew besides.
    """

    status: int
    factor: float
    closed: np.ndarray
    marginal: np.ndarray
    factors: np.ndarray
    supports: np.ndarray
    events: np.ndarray
    motion: np.ndarray
    solves: int
    nodes: int


def follow(
    arrays: Arrays, links: np.ndarray, factor: float, closed: np.ndarray, marginal: np.ndarray, most: int
) -> Path:
    """Follow the load from a factor to 1, from event to event.

    Parameters
    ----------
    arrays, links, factor, closed
        As for `solve`; `closed` is the scheme at the factor.
    marginal : numpy.ndarray of int
        1 for the supports at zero there.
    most : int
        Number of events after which it stops short of 1.

    Returns
    -------
    Path
        The events on the way.

    Raises
    ------
    EngineError
        Where no unique solution exists on the way, with the engine's message.
    """
    supports = len(closed)
    closed, marginal, at = _scheme(closed), _scheme(marginal), np.array(factor)
    count, factors, which, what, motion, solves, nodes, status, message = _f77.gbpath(
        most, *_detail(arrays), *_beam(arrays, links), 1.0, at, closed, marginal
    )
    factor = float(at)
    if status == Status.NOT_FINITE:
        refuse_farthest(arrays)
    check_status(status, message, f"at load factor {factor:g}: ")
    return Path(
        status,
        factor,
        closed[:supports],
        marginal[:supports],
        factors[:count],
        which[:count] - 1,
        what[:count],
        motion,
        solves,
        nodes,
    )


class CaseSolver(Pickled):
    """Solves load cases of one beam, in the engine's units.

    Parameters
    ----------
    fixed : tuple of numpy.ndarray
        What all cases have in common, as GBCASE takes it.
    """

    def __init__(self, fixed: tuple[np.ndarray, ...]):
        self._fixed = read_only(fixed)

    def __call__(self, factors: np.ndarray, rule: int, closed: np.ndarray) -> tuple[np.ndarray, ...]:
        """Solve cases.

        Parameters
        ----------
        factors : numpy.ndarray
            Factor of every load, cases by loads.
        rule : int
            From RULES.
        closed : numpy.ndarray of int
            Starting schemes, cases by supports; they become the working schemes, all open where there is none.

        Returns
        -------
        tuple of numpy.ndarray
            Deflection, moments left and right, shear, reaction (not-a-number where a case is not solved), solves and
            status, one row a case.
        """
        cases, loads = factors.shape
        if factors.size == 0:  # f2py takes no arrays of size 0: a case of nothing, a load of nothing
            factors = np.zeros((max(cases, 1), max(loads, 1)))
            closed = closed if cases else np.ones((1, closed.shape[1]), dtype=np.int32)
        *values, solves, status = _f77.gbcase(*self._fixed, factors.T, rule, closed.T)
        if status[0] == _NO_MEMORY:  # then all are
            check_status(_NO_MEMORY)
        return (*(value.T[:cases] for value in values), solves[:cases], status[:cases])


def prepare_cases(
    arrays: Arrays,
    links: np.ndarray,
    row_load: np.ndarray,
    row_piece: np.ndarray,
    row_values: np.ndarray,
    node_load: np.ndarray,
    node: np.ndarray,
    node_values: np.ndarray,
) -> CaseSolver:
    """Condense the loads of a scene one by one.

    Parameters
    ----------
    arrays, links
        As for `solve`.
    row_load, row_piece : numpy.ndarray of int
        Load and piece of every row, in this order.
    row_values : numpy.ndarray
        Load at both ends of the piece, imposed curvature, force and couple at its right end, rows by 5.
    node_load, node : numpy.ndarray of int
        Load and node of every load at a node.
    node_values : numpy.ndarray
        Force and couple, rows by 2.

    Returns
    -------
    CaseSolver
        To be called with factors.
    """
    units = arrays.units
    row_values = scaled(row_values, -units.load)
    node_values = scaled(node_values, -units.load[3:])
    if len(row_load) == 0:  # f2py takes no arrays of size 0: a load of nothing
        row_load, row_piece, row_values = np.zeros(1), np.zeros(1), np.zeros((1, 5))
    if len(node_load) == 0:
        node_load, node, node_values = np.zeros(1), np.zeros(1), np.zeros((1, 2))

    def integers(values: np.ndarray, first: int) -> np.ndarray:
        return np.asarray(values + first, dtype=np.int32)

    count, load, link, share, status = _f77.gbshar(
        arrays.engine.pieces.T, links, _last(arrays), integers(row_load, 1), integers(row_piece, 1), row_values.T
    )
    check_status(status)
    links, kinds, compliance, _, _, *supports = _beam(arrays, links)
    return CaseSolver((
        *(links, kinds, compliance, *supports),
        *(load[:count], link[:count], np.asfortranarray(share[:, :count])),
        *(integers(node_load, 1), integers(node, 0), np.asfortranarray(node_values.T)),
    ))


def certify(
    arrays: Arrays, links: np.ndarray, factor: float, solution: Solution, starts: np.ndarray
) -> tuple[np.ndarray, np.ndarray, bool]:
    """Check a solved state, and bound its errors by comparison with a solution in quadruple precision.

    Parameters
    ----------
    arrays, links, factor
        As for `solve`.
    solution : Solution
        Solved at that factor.
    starts : numpy.ndarray
        Its fields, from `recover`.

    Returns
    -------
    residuals : numpy.ndarray
        Relative residuals of compatibility, equilibrium and complementarity.
    bounds : numpy.ndarray
        Largest errors of deflections of the nodes and of reactions; of deflections, rotations, moments, shears along the beam,
        in the engine's units.
    known : bool
        False where the beam is free to move: deflections and rotations have no bound then.

    Raises
    ------
    EngineError
        The state cannot be checked.
    """
    reaction = solution.reaction if len(solution.reaction) else np.zeros(1)
    residuals, bounds, known, status, message = _f77.gbcert(
        *_detail(arrays), *_beam(arrays, links), factor, _scheme(solution.closed),
        solution.deflection, solution.moment_left, solution.moment_right, reaction, starts,
    )  # fmt: skip
    check_status(status, message, "the state could not be checked in quadruple precision: ")
    return residuals, bounds, bool(known)


def _scheme(closed: np.ndarray) -> np.ndarray:
    """Copy a scheme, with an open support where there is none: f2py takes no arrays of size 0."""
    return np.array(closed if len(closed) else [0], dtype=np.int32)


def _detail(arrays: Arrays) -> tuple[np.ndarray, ...]:
    """Collect what the links are made of."""
    inner = arrays.engine
    return inner.pieces.T, inner.dead.T, inner.live.T, _last(arrays)


def _beam(arrays: Arrays, links: np.ndarray) -> tuple[np.ndarray, ...]:
    """Collect what every contact call needs; a support without stiffness stands for no support."""
    inner = arrays.engine
    supports = (arrays.support_nodes, arrays.support_sides, inner.support_stiffness, inner.support_contact)
    if len(arrays.supports) == 0:
        supports = (np.zeros(1, np.int32), np.ones(1, np.int32), np.zeros(1), np.zeros(1))
    return links, arrays.kinds, inner.compliance, inner.force.T, inner.couple.T, *supports


def recover(arrays: Arrays, links: np.ndarray, factor: float, solution: Solution) -> np.ndarray:
    """Fields at the left end of every piece.

    Parameters
    ----------
    arrays, links, factor
        As for `solve`.
    solution : Solution
        Solved at that factor.

    Returns
    -------
    numpy.ndarray
        Deflection, rotation, moment, shear by piece, in the engine's units, for `values` and `extremes`.
    """
    inner = arrays.engine
    starts, status = _f77.gbreco(
        inner.pieces.T,
        inner.dead.T,
        inner.live.T,
        factor,
        links,
        _last(arrays),
        arrays.kinds,
        solution.deflection,
        solution.moment_left,
        solution.moment_right,
        solution.shear,
    )
    check_status(status)
    if not np.isfinite(starts).all():
        refuse_farthest(arrays)
    return read_only(starts)


def values(arrays: Arrays, factor: float, starts: np.ndarray, piece: np.ndarray, distance: np.ndarray) -> np.ndarray:
    """Fields at given places.

    Parameters
    ----------
    arrays, factor
        As for `solve`.
    starts : numpy.ndarray
        From `recover`.
    piece : numpy.ndarray of int
        Piece of each place, from 0.
    distance : numpy.ndarray
        Distance from the piece's left end.

    Returns
    -------
    numpy.ndarray
        4 by places: deflection, rotation, moment, shear.
    """
    inner, units = arrays.engine, arrays.units
    found = np.empty((4, len(piece)))
    for part in _f77.parts(len(piece)):
        where = np.asarray(piece[part], dtype=np.int32) + np.int32(1)
        at = scaled(distance[part], -units.length)
        some = _f77.gbvalu(inner.pieces.T, inner.dead.T, inner.live.T, factor, starts, where, at)
        x = arrays.point_x[piece[part]] + distance[part]
        for k, row in enumerate(some):
            found[k, part] = _field_in_scene(arrays, k, row, x)
    return found


def _field_in_scene(arrays: Arrays, field: int, values: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Values of one of the fields in the scene's units."""
    if not np.isfinite(np.abs(values).max(initial=0.0)):
        refuse_farthest(arrays)
    name, remedy = (("deflection", LONGER), ("rotation", STIFFER), ("moment", STRONGER), ("shear", STRONGER))[field]
    return to_scene(values, arrays.units.field[field], x, name, remedy)


def extremes(arrays: Arrays, factor: float, starts: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Exact extremes of all fields.

    Parameters
    ----------
    arrays, factor, starts
        As for `values`.

    Returns
    -------
    values : numpy.ndarray
        Maximum and minimum (rows) of deflection, rotation, moment, shear (columns).
    x : numpy.ndarray
        Where they are.
    """
    inner, units = arrays.engine, arrays.units
    value, where, distance = _f77.gbextr(inner.pieces.T, inner.dead.T, inner.live.T, factor, starts)
    x = arrays.point_x[where - 1] + scaled(distance, units.length)
    return np.stack([_field_in_scene(arrays, k, value[:, k], x[:, k]) for k in range(4)], axis=1), x


def largest_fields(arrays: Arrays, factor: float, starts: np.ndarray) -> np.ndarray:
    """Largest absolute values of all fields.

    Parameters
    ----------
    arrays, factor, starts
        As for `values`.

    Returns
    -------
    numpy.ndarray
        Of deflection, rotation, moment, shear, in the engine's units.
    """
    inner = arrays.engine
    return np.abs(_f77.gbextr(inner.pieces.T, inner.dead.T, inner.live.T, factor, starts)[0]).max(axis=0)


def _last(arrays: Arrays) -> np.ndarray:
    """Last piece of every link, counted from 1."""
    return arrays.node_points[1:].astype(np.int32)
