"""Vehicles, p-y curves, ground of piles, with sources.

All are parts of a scene. Forces are in kN, lengths in m, unless a function says that any consistent units do. What had no source
that could be found and quoted is left out: the shape of the mounds of AS 2870.
"""

from .pile import pile_ground
from .py_curves import api_sand, matlock_clay, reese_clay
from .vehicles import (
    crane_pair,
    hl93_lane,
    hl93_tandem,
    hl93_truck,
    hl93_trucks,
    hoisting_factor,
    lm1,
    lm1_lane,
    lm71,
    rail_dynamic_factor,
)

__all__ = [
    "api_sand",
    "crane_pair",
    "hl93_lane",
    "hl93_tandem",
    "hl93_truck",
    "hl93_trucks",
    "hoisting_factor",
    "lm1",
    "lm1_lane",
    "lm71",
    "matlock_clay",
    "pile_ground",
    "rail_dynamic_factor",
    "reese_clay",
]

LEFT_OUT = {
    "as2870_mound": "the shape of the mound in AS 2870, appendix F, was not found in a source that can be quoted; give the mound "
    "as profile = [(x, gap), ...] of a foundation",
}
"""Packs that one looks for here, and why they are not there."""


def __getattr__(name: str) -> object:
    """Refuse what is not there, and say why."""
    if name in LEFT_OUT:
        raise AttributeError(f"gapbeam.packs has no {name!r}: {LEFT_OUT[name]}")
    raise AttributeError(f"gapbeam.packs has no {name!r}; it has {', '.join(__all__)}")
