"""Limits of a design, beside which results are set; they change no result."""

from __future__ import annotations

from math import inf

from ..base.errors import SceneError
from .table import Positive, Table
from .wording import number


class Limits(Table, forbid_unknown_fields=True, kw_only=True):
    """What a design allows, each as an absolute value; report and JSON say how far each is used.

    Parameters
    ----------
    moment : float, optional
        Bending moment (force*length).
    shear : float, optional
        Shear force (force).
    reaction : float, optional
        Reaction of a support (force).
    opening : float, optional
        Opening of a support without contact (length).
    deflection : float, optional
        Deflection (length).
    pressure : float, optional
        Bearing pressure under the beam (force/length^2); needs the width of the beam.
    """

    moment: Positive | None = None
    shear: Positive | None = None
    reaction: Positive | None = None
    opening: Positive | None = None
    deflection: Positive | None = None
    pressure: Positive | None = None

    def given(self) -> dict[str, float]:
        """Give the limits there are, by quantity."""
        return {name: value for name in self.__struct_fields__ if (value := getattr(self, name)) is not None}


def check_limits(limits: Limits | None, width: float | None, has_foundation: bool) -> None:
    """Refuse limits and a width that are no numbers above 0, and limits that nothing can be set beside.

    Parameters
    ----------
    limits : Limits or None
        Of a scene.
    width : float or None
        Of the beam.
    has_foundation : bool
        Whether the scene has ground under the beam.

    Raises
    ------
    SceneError
        A number that is not above 0; a limit of the pressure without a width of the beam, or without ground.
    """
    for key, value in ({} if limits is None else limits.given()).items():
        if not value > 0.0:
            problem = f"expected a number above 0, got {number(value)}; leave it out where there is no limit"
            raise SceneError(f"limits.{key}", problem)
    if width is not None and not 0.0 < width < inf:
        raise SceneError("beam.width", f"expected a finite number above 0, got {number(width)}; give the width on the ground")
    if limits is None or limits.pressure is None:
        return
    if not has_foundation:
        raise SceneError("limits.pressure", "there is no foundation whose pressure it could limit; remove it or add [[foundation]]")
    if width is None:
        raise SceneError("limits.pressure", "a pressure per area needs the width of the beam on the ground; give beam.width")
