"""Quantities along the beam, declared once: name, unit, what determines it, how it is drawn.

How they come from the solution stands in Fortran: `fields_at` in fortran/beam/element.f90 for bending, in fortran/result/query.f90
for axial ones, in fortran/result/pressure.f90 for the ground. Their order is that of the engine's arrays.
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
    of : {"bending", "axial", "ground"}
        What a scene must have for it; every beam bends.
    by_equilibrium : bool
        Whether forces determine it, so that it is unique where the beam can move freely without work of the loads.
    panel : str or None
        Its words beside an axis; None where it is not drawn.
    downward : bool
        Whether positive values are drawn downward.
    """

    name: str
    unit: str
    of: str = "bending"
    by_equilibrium: bool = False
    panel: str | None = None
    downward: bool = False


QUANTITIES = (
    Quantity("deflection", "{length}", panel="deflection", downward=True),
    Quantity("rotation", "rad"),
    Quantity("moment", "{force} {length}", by_equilibrium=True, panel="moment", downward=True),
    Quantity("shear", "{force}", by_equilibrium=True, panel="shear"),
    Quantity("axial_force", "{force}", "axial", panel="axial force"),
    Quantity("axial_displacement", "{length}", "axial"),
    Quantity("pressure", "{force}/{length}", "ground", panel="pressure"),
)

FIELDS = tuple(one.name for one in QUANTITIES)
BENDING = tuple(one.name for one in QUANTITIES if one.of == "bending")
"""Those that every beam has; error bounds, cases side by side and trains have them."""
