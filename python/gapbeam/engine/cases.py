"""Many load cases of a beam in one call of the compiled layer, or one at the least cost of a call."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

import numpy as np

from ..base.errors import ENDED, Status, check_status
from . import calls as _engine
from .beam import RULES, Beam
from .blocks import block_of, new_block
from .combinations import Varied

WANTED = ("deflection", "moment_left", "moment_right", "reaction")
"""What need not be wanted, in the order of GBCASE."""
ALWAYS = ("status", "closed", "solves")
"""What comes with every case."""
NOT_FINITE = -1
"""Status of GBONE where a factor is not finite."""
NONE = np.zeros((1, 1, 3)).T
"""Where supports, and likewise spans, are those of the beam."""


def split_loads(beam: Beam) -> None:
    """Condense the loads of a beam one by one, for what follows."""
    check_status(_engine.gbshar(beam.handle, beam.pieces + beam.columns.load.shape[1]))


def _room(beam: Beam) -> _engine.Owned:
    """Take a room that is not in use, or a new one."""
    try:
        return beam.rooms.pop()
    except IndexError:
        address = _engine.gbroom()
        if not address:
            check_status(Status.NO_MEMORY)
        return _engine.Owned(address)


def solve_cases(
    beam: Beam, factors: np.ndarray, rule: str, closed: np.ndarray, varied: Varied | None = None,
    want: Collection[str] = WANTED, into: Mapping[str, np.ndarray] | None = None,
) -> dict[str, np.ndarray]:  # fmt: skip
    """Solve load cases.

    Parameters
    ----------
    beam : Beam
        Its loads are split.
    factors : numpy.ndarray
        Factor of every load, cases by loads.
    rule : {"block", "single"}
        How contact states are found.
    closed : numpy.ndarray of int
        Starting scheme of all cases.
    varied : Varied, optional
        Numbers of spans, and of supports where none has a law, that differ from those of the beam.
    want : collection of str
        Which of `WANTED` are made.
    into : mapping, optional
        What an earlier call for as many cases of this beam, of which the same was wanted, has given: its arrays are filled again.

    Returns
    -------
    dict of numpy.ndarray
        `ALWAYS` and what is wanted, one row a case: deflection, moments left and right of the nodes, reactions in the scene's units
        (not-a-number where a case is not solved), schemes (all open where there is none), solves and status.
    """
    cases, m, n = len(factors), beam.supports, beam.links + 1
    shares = np.ascontiguousarray(factors) if factors.shape[1] else np.zeros((cases, 1))
    supports, spans = NONE, NONE[:2]
    if varied is not None and varied.supports is not None:
        supports = varied.supports.T
    if varied is not None and varied.spans is not None:
        spans = varied.spans.T
    shapes = [((cases, width), float) for name, width in zip(WANTED, (n, n, n, m + 1), strict=True) if name in want]
    shapes += [((cases, m + 1), np.int32), ((cases,), np.int32), ((cases,), np.int32)]
    numbers = sum(shape[1] for shape, _ in shapes[:-3])
    block = new_block(beam.spare, cases * (8 * numbers + 4 * (m + 3))) if into is None else block_of(into["status"])
    *made, schemes, solves, status = block.arrays(shapes)
    found = dict(zip((name for name in WANTED if name in want), made, strict=True))
    schemes[:, :m] = closed
    if cases:
        room = _room(beam)
        _engine.gbcase(
            beam.handle, room, shares.T, supports, spans, RULES[rule], schemes.T,
            *(found[name].T if name in found else np.empty((cases, 1)).T for name in WANTED), solves, status,
        )
        beam.rooms.append(room)
        if status[0] in ENDED:  # then all are
            check_status(status[0])
    if "reaction" in found:
        found["reaction"] = found["reaction"][:, :m]
    return {**found, "closed": schemes[:, :m], "solves": solves, "status": status}


class OneCase:
    """One case at a time of a beam without ground, from all supports closed: one short call, into one array.

    Parameters
    ----------
    beam : Beam
        With some loads, which are split, and so few nodes that a call is short.
    rule : {"block", "single"}
        How contact states are found.
    scene : object
        What the beam is made of, for who asks.

    Attributes
    ----------
    shape : tuple
        Of the factors.
    size : int
        Numbers of a block.
    """

    def __init__(self, beam: Beam, rule: str, scene: Any = None):
        self.scene = scene
        n, m, loads = beam.links + 1, beam.supports, beam.columns.load.shape[1] - 1
        self.beam, self.rule, self.shape = beam, rule, (loads,)
        ends = np.cumsum([1, 1, n, n, n, m, m, loads]).tolist()
        names = ("status", "solves", *WANTED, "closed", "factors")
        self.parts = {name: slice(first, last) for name, first, last in zip(names, [0, *ends], ends, strict=False)}
        self.size = ends[-1]
        self._call = _engine.gbone, beam.handle, RULES[rule], NONE[:, :, 0], beam.rooms

    def solve(self, factors: np.ndarray, supports: np.ndarray | None, block: np.ndarray) -> bool:
        """Solve a case.

        Parameters
        ----------
        factors : numpy.ndarray of float
            Of all loads.
        supports : numpy.ndarray or None
            Settlement, gap and stiffness of the scene's supports instead of their own, supports (and one more) by 3.
        block : numpy.ndarray of float
            Becomes the results.

        Returns
        -------
        bool
            False where a factor is not finite.
        """
        call, handle, rule, own, rooms = self._call
        try:
            room = rooms.pop()
        except IndexError:
            room = _room(self.beam)
        try:
            status = call(handle, room, factors, own if supports is None else supports.T, rule, block)
        except BaseException:
            _engine.go_on((handle,))
            raise
        rooms.append(room)
        if status in ENDED:
            check_status(status)
        return status != NOT_FINITE

    def take(self, block: np.ndarray, name: str) -> np.ndarray | np.int32:
        """Take a result out of a block.

        Parameters
        ----------
        block : numpy.ndarray
            By `solve`.
        name : str
            Of `ALWAYS`, `WANTED`, or factors.
        """
        values = block[self.parts[name]]
        if name == "closed":
            return values.astype(np.int32)
        return np.int32(values[0]) if name in ("status", "solves") else values
