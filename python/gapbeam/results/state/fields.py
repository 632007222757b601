"""Fields along a beam, and the places at which they are asked for."""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Iterator
from dataclasses import dataclass, fields

import numpy as np

from ...base.errors import EngineError, Status
from ...base.records import Record
from ...engine.beam import Beam
from ...scene.wording import shown


@dataclass(frozen=True, eq=False)
class Fields(Record):
    """Fields along the beam, read-only arrays of equal length.

    Attributes
    ----------
    x, deflection, rotation, moment, shear : numpy.ndarray
        Place and values; rotation is that of the section.
    axial_force, axial_displacement : numpy.ndarray or None
        Only with axial loads.
    pressure : numpy.ndarray or None
        Of all foundations on the beam, force per length, positive upward; only with foundations.
    curvature : numpy.ndarray
        1/length, with the sign of the moment: M/EI less the imposed curvature; it jumps where one of both does.
    transverse : numpy.ndarray or None
        Shear and axial force times slope, which loads and reactions balance; only where bending feels an axial force.
    """

    x: np.ndarray
    deflection: np.ndarray
    rotation: np.ndarray
    moment: np.ndarray
    shear: np.ndarray
    axial_force: np.ndarray | None = None
    axial_displacement: np.ndarray | None = None
    pressure: np.ndarray | None = None
    curvature: np.ndarray | None = None
    transverse: np.ndarray | None = None

    def __iter__(self) -> Iterator[tuple]:
        """Go through the places: named tuples of x and what is there, of which pandas makes a table."""
        columns = self.columns()
        row = namedtuple("Place", columns)
        return map(row._make, zip(*columns.values(), strict=True))

    def to_dict(self) -> dict[str, list[float]]:
        """As lists by name, what is not there left out.

        Returns
        -------
        dict
            Lists of floats.
        """
        return {name: column.tolist() for name, column in self.columns().items()}

    def columns(self) -> dict[str, np.ndarray]:
        """As arrays by name, what is not there left out.

        Returns
        -------
        dict
        """
        return {f.name: getattr(self, f.name) for f in fields(self) if getattr(self, f.name) is not None}


def find_places(beam: Beam, x: np.ndarray, side: str) -> tuple[np.ndarray, np.ndarray]:
    """Find places along a beam.

    Parameters
    ----------
    beam : Beam
    x : numpy.ndarray
        The places.
    side : {"right", "left"}
        Which side is meant where a field jumps.

    Returns
    -------
    piece : numpy.ndarray of int
        Pieces, from 1.
    distance : numpy.ndarray
        Distances from their left ends.

    Raises
    ------
    ValueError
        A place outside the beam; another side.
    """
    if not isinstance(side, str) or side not in ("right", "left"):
        raise ValueError(f'side: expected "right" or "left", got {shown(side)}')
    try:
        return beam.find(x, side == "left")
    except EngineError as error:
        if error.status != Status.BAD_INPUT:
            raise
        end = beam.places.end
        off = x[~((x >= 0) & (x <= end))].flat[0]
        raise ValueError(f"x: the beam goes from 0 to {end:g}, got {off:g}") from None
