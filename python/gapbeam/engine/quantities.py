"""Quantities along the beam, declared once: name, unit, what determines it, how it is drawn.

How they come from the solution stands in Fortran: in fortran/beam/quantities.f90, in fortran/response/query.f90 for axial ones, in
fortran/response/pressure.f90 for the ground. They have the same order there, and the engine's arrays have it.
"""

from __future__ import annotations

from typing import NamedTuple


class Quantity(NamedTuple):
    """A quantity along the beam.

    Attributes
    ----------
    name : str
        As in results, JSON and CSV.
    unit : str
        Of ``{force}`` and ``{length}``.
    meaning : str
        What it is, with its sign, in a sentence.
    of : {"bending", "axial", "ground", "second order"}
        What a scene must have for it; every beam bends.
    by_equilibrium : bool
        Whether forces determine it, so that it is unique where the beam can move freely without work of the loads.
    bounded : bool
        Whether error bounds are found for it.
    reported : bool
        Whether it stands among the largest and smallest values of the report.
    panel : str or None
        Its words beside an axis; None where it is not drawn.
    downward : bool
        Whether positive values are drawn downward.
    """

    name: str
    unit: str
    meaning: str
    of: str = "bending"
    by_equilibrium: bool = False
    bounded: bool = False
    reported: bool = True
    panel: str | None = None
    downward: bool = False


QUANTITIES = (
    Quantity("deflection", "{length}", "Deflection (length), positive downward.",
             bounded=True, panel="deflection", downward=True),
    Quantity("rotation", "rad", "Rotation (rad), positive clockwise.", bounded=True),
    Quantity("moment", "{force} {length}", "Bending moment (force*length), positive sagging.",
             by_equilibrium=True, bounded=True, panel="moment", downward=True),
    Quantity("shear", "{force}", "Shear force (force), the derivative of the moment.",
             by_equilibrium=True, bounded=True, panel="shear"),
    Quantity("axial_force", "{force}", "Axial force (force), tension positive; only with axial loads.",
             "axial", panel="axial force"),
    Quantity("axial_displacement", "{length}",
             "Displacement along the beam (length), positive to the right; only with axial loads.",
             "axial"),
    Quantity("pressure", "{force}/{length}",
             "Line reaction of the ground (force/length), positive where it pushes the beam up; only with foundations.",
             "ground", panel="pressure"),
    Quantity("curvature", "1/{length}", "Curvature M/EI less what is imposed (1/length), positive as the sagging moment.",
             by_equilibrium=True, reported=False, downward=True),
    Quantity("transverse", "{force}",
             "Transverse force (force), shear and axial force times slope, which loads and reactions balance; only with N.",
             "second order", by_equilibrium=True),
)

FIELDS = tuple(one.name for one in QUANTITIES)
NUMBERS = {name: number for number, name in enumerate(FIELDS, start=1)}
"""Their numbers in the engine."""
BENDING = tuple(one.name for one in QUANTITIES if one.of == "bending")
"""Those that every beam has; cases side by side and trains have them."""
BOUNDED = tuple(one.name for one in QUANTITIES if one.bounded)
"""Those of bending that have error bounds, which come first."""
REPORTED = tuple(one.name for one in QUANTITIES if one.reported)
