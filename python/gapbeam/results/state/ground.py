"""Zones in which the ground acts on the beam, free spans above it, and where the beam slides over ground along its axis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...engine.beam import Beam
from ...engine.ground import ground_runs, parts_that_slide
from ...engine.states import Ground
from ...engine.units import scaled

if TYPE_CHECKING:
    from .step import Step

TOUCHING = "touching"
"""State of a zone of contact that has no length."""


@dataclass(frozen=True, slots=True)
class Contact:
    """A zone in which a foundation acts.

    Attributes
    ----------
    foundation : int
        Number of the foundation in the scene.
    from_, to : float
        Its ends (length from the left end of the beam).
    state : str
        ``closed``, or ``bilateral`` where the foundation holds both ways; with a law ``branch 1``, ``branch 2`` and so on;
        ``touching`` where the beam only touches the ground, at one place and without force: `from_` is `to`.
    resultant : float
        Force on the beam, positive upward. Rigid ground (``k = inf``) pushes with point forces, too, at the ends of zones, under
        forces and at single places: each stands for itself, with `from_` equal to `to`.
    """

    foundation: int
    from_: float
    to: float
    state: str
    resultant: float


@dataclass(frozen=True, slots=True)
class FreeSpan:
    """A stretch in which the beam does not touch a one-sided foundation that is there.

    Attributes
    ----------
    foundation : int
        Number of the foundation in the scene.
    from_, to : float
        Its ends (length from the left end of the beam).
    sag : float
        Largest distance between beam and ground.
    """

    foundation: int
    from_: float
    to: float
    sag: float

    def to_dict(self) -> dict[str, float]:
        """Ends and sag as plain data."""
        return {"from": self.from_, "to": self.to, "sag": self.sag}


@dataclass(frozen=True, slots=True)
class Run:
    """Stretches beside each other in which a layer does the same.

    Attributes
    ----------
    foundation : int
        Number of the foundation in the scene.
    side : int
        1 below (pushes up only), -1 above (pushes down only), 0 both.
    law_pieces, acts : int
        Pieces of its law, 0: linear; the one on which it acts, from 1, 0: not in contact.
    from_, to : float
        Its ends (length from the left end of the beam).
    resultant : float
        Force on the beam, positive upward.
    way : float
        Largest distance between beam and layer, 0 in contact.
    touches : bool
        Whether it is a place at which the beam only touches the layer.
    """

    foundation: int
    side: int
    law_pieces: int
    acts: int
    from_: float
    to: float
    resultant: float
    way: float
    touches: bool


def find_runs(beam: Beam, ground: Ground | None) -> tuple[Run, ...]:
    """Find what every layer of ground does along the beam.

    Parameters
    ----------
    beam : Beam
    ground : Ground or None
        Its solution on the ground.

    Returns
    -------
    tuple of Run
        All layers, stretches in which one does the same joined, by foundation and from left to right.
    """
    if ground is None:
        return ()
    about, values = ground_runs(beam, ground)
    return tuple(
        Run(*codes, *numbers, bool(touches)) for (*codes, touches), numbers in zip(about.tolist(), values.tolist(), strict=True)
    )


def find_contact(runs: Sequence[Run]) -> tuple[Contact, ...]:
    """Find the zones in which the ground acts.

    Parameters
    ----------
    runs : sequence of Run
        From `find_runs`.

    Returns
    -------
    tuple of Contact
        Foundation by foundation from left to right.
    """
    return tuple(
        _touching(run) if run.touches else Contact(run.foundation, run.from_, run.to, _name(run), run.resultant)
        for run in runs
        if run.acts or run.touches
    )


def find_free_spans(runs: Sequence[Run]) -> tuple[FreeSpan, ...]:
    """Find the stretches in which the beam has no contact with one-sided ground.

    Parameters
    ----------
    runs : sequence of Run
        From `find_runs`.

    Returns
    -------
    tuple of FreeSpan
        Foundation by foundation from left to right; of one that holds both ways there are none.
    """
    both_ways = {run.foundation for run in runs if run.side > 0} & {run.foundation for run in runs if run.side < 0}
    return tuple(
        FreeSpan(run.foundation, run.from_, run.to, run.way)
        for run in runs
        if not (run.acts or run.touches or run.foundation in both_ways)
    )


def size_of(span: FreeSpan | None, quantity: str) -> float:
    """Give the size of a free span.

    Parameters
    ----------
    span : FreeSpan or None
        The span; there may be none.
    quantity : {"length", "sag"}
        Which size.

    Returns
    -------
    float
        0 if there is none.
    """
    if span is None:
        return 0.0
    return span.to - span.from_ if quantity == "length" else span.sag


def joined(contacts: Sequence[Contact]) -> list[Contact]:
    """Join what lies beside each other: zones without the branches of a law in them, with point forces, without what only touches.

    Parameters
    ----------
    contacts : sequence of Contact
        As from `find_contact`.

    Returns
    -------
    list of Contact
        In the same order, each with the state at its left end.

    Examples
    --------
    >>> zones = [Contact(0, 1.0, 2.0, "branch 1", 3.0), Contact(0, 2.0, 4.0, "branch 2", 9.0), Contact(0, 5.0, 6.0, "closed", 1.0)]
    >>> [(zone.from_, zone.to, zone.resultant) for zone in joined(zones)]
    [(1.0, 4.0, 12.0), (5.0, 6.0, 1.0)]
    """
    found: list[Contact] = []
    for zone in contacts:
        if zone.state == TOUCHING:
            continue
        last = found[-1] if found else None
        inside = last is not None and zone.from_ == zone.to and last.from_ <= zone.from_ <= last.to
        if last is not None and last.foundation == zone.foundation and (inside or zone.from_ == last.to):
            found[-1] = replace(last, to=max(last.to, zone.to), resultant=last.resultant + zone.resultant)
        else:
            found.append(zone)
    return found


def noun_of(contacts: Sequence[Contact]) -> str:
    """Give the word for what is listed.

    Parameters
    ----------
    contacts : sequence of Contact
        As from `joined`.

    Returns
    -------
    {"zone", "place"}
    """
    return "place" if any(zone.from_ == zone.to for zone in contacts) else "zone"


def with_ends_of_zones(piece: np.ndarray, distance: np.ndarray, beam: Beam, ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """Put the ends of zones among places given by piece and distance, unless they are there.

    Parameters
    ----------
    piece : numpy.ndarray of int
        The pieces, from 0, ascending.
    distance : numpy.ndarray
        Distances from their left ends, ascending in each.
    beam, ground
        As for `find_runs`.
    """
    of = ground.values[0].astype(piece.dtype) - 1
    inside = np.append(of[1:] == of[:-1], False)
    return _with_places(piece, distance, of[inside], scaled(ground.values[2, inside], beam.units.length))


def _with_places(
    piece: np.ndarray, distance: np.ndarray, other_piece: np.ndarray, other_distance: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Put places among others, unless they are there; pieces from 0 ascend, and distances in each."""
    piece, distance = np.append(piece, other_piece), np.append(distance, other_distance)
    order = np.lexsort((distance, piece))
    piece, distance = piece[order], distance[order]
    new = np.append(True, (np.diff(piece) != 0) | (np.diff(distance) != 0.0))
    return piece[new], distance[new]


def _touching(run: Run) -> Contact:
    middle = run.from_ + (run.to - run.from_) / 2
    return Contact(run.foundation, middle, middle, TOUCHING, 0.0)


def _name(run: Run) -> str:
    if run.law_pieces:
        return f"branch {run.acts}"
    return "closed" if run.side else "bilateral"


WAYS = {1: "right", -1: "left"}
JOINED = 1e-12
"""Ends of parts nearer than this share of the beam are one place."""


class SlipZone(NamedTuple):
    """A stretch over which the beam slides one way; over ground that is rigid up to its limit, or has slid last.

    Attributes
    ----------
    from_, to : float
        Its ends.
    way : {"right", "left"}
        Which way the beam goes, or went.
    friction : float
        Force of the ground on the beam along it, positive to the right.
    """

    from_: float
    to: float
    way: str
    friction: float


def slip_zones(step: Step) -> tuple[SlipZone, ...]:
    """Find the slip zones of a state.

    Parameters
    ----------
    step : Step
        The state.

    Returns
    -------
    tuple of SlipZone
        From left to right; none without ground along the beam.
    """
    if not step._beam.is_on_axial_ground:
        return ()
    places, ways, forces = parts_that_slide(step.solution)
    near, found = JOINED * float(step._beam.places.point_x[-1]), []
    for a, b, way, force in zip(*places.tolist(), map(WAYS.__getitem__, ways.tolist()), forces.tolist(), strict=True):
        if found and found[-1].way == way and a - found[-1].to <= near:
            last = found.pop()
            a, force = last.from_, last.friction + force
        if b - a > near:
            found.append(SlipZone(a, b, way, force))
    return tuple(found)


def with_ends_of_slip(piece: np.ndarray, distance: np.ndarray, step: Step) -> tuple[np.ndarray, np.ndarray]:
    """Add the ends of the slip zones to places along a beam, where the axial force has kinks.

    Parameters
    ----------
    piece, distance : numpy.ndarray
        Pieces from 0, from left to right, and distances from their left ends.
    step : Step
        The state.
    """
    ends = np.array([x for zone in step.slip_zones for x in (zone.from_, zone.to)])
    pieces, distances = step._beam.find(ends, left=False)
    return _with_places(piece, distance, (pieces - 1).astype(piece.dtype), distances)
