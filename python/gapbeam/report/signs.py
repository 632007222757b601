"""Signs and units in words: which values are positive along the beam, and what those at supports that turn are told in."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..results import formatting as fmt
from ..scene.rotations import turns

if TYPE_CHECKING:
    from ..scene.structs import Scene


def positive_fields(scene: Scene) -> str:
    """Say which fields along the beam are positive; a beam that is drawn upright has its deflections to the right.

    Returns
    -------
    str
        A sentence.

    Examples
    --------
    >>> from gapbeam import Beam, Scene
    >>> positive_fields(Scene(beam=Beam([1.0], EI=1.0)))
    'Deflection downward, sagging moment, clockwise rotation: positive.'
    >>> positive_fields(Scene(beam=Beam([1.0], EI=1.0, direction="down")))
    'Deflection to the right, moment with tension on the right, counterclockwise rotation: positive.'
    """
    if scene.beam.direction == "down":
        return "Deflection to the right, moment with tension on the right, counterclockwise rotation: positive."
    return "Deflection downward, sagging moment, clockwise rotation: positive."


def positive_reactions(scene: Scene) -> str:
    """Say which way reactions are positive: upward, of a beam that is drawn upright to the left."""
    return "to the left" if scene.beam.direction == "down" else "upward"


def positive_along(scene: Scene) -> str:
    """Say which way is positive along the beam."""
    return "downward" if scene.beam.direction == "down" else "to the right"


def names_with_units(scene: Scene) -> list[str]:
    """Name the supports in a table of reactions and openings, those that hold rotations with the units of couples and angles.

    Parameters
    ----------
    scene : Scene
        The scene with its unit labels.
    """
    units = ", ".join(filter(None, (fmt.unit(scene, "couple"), "rad")))
    return [
        f"{name} [{units}]" if turns(support) else name
        for name, support in zip(fmt.numbered(scene.supports), scene.supports, strict=True)
    ]
