"""Signs in words: which values of the fields along the beam are positive."""

from __future__ import annotations

from typing import TYPE_CHECKING

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
