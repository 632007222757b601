"""Hinges of a beam, and how a support holds its rotation, where these are more than free or fixed."""

from __future__ import annotations

import math
from typing import Literal

from .laws import Law
from .table import HingeSide, NotNegative, Point, Table, TurnSide

inf = math.inf


class Hinge(Point, kw_only=True, gc=False):
    """A hinge inside the beam that turns against a couple; one without anything is as those of ``beam.hinges``.

    Its rotation is that left of it less that right of it, positive with a sagging moment. Not beside rigid
    stretches of the beam. With slack, side or law it is a support of direction hinge in results.

    Parameters
    ----------
    stiffness : float, optional
        Couple per relative rotation (force*length/rad); default 0, with slack or a side inf (rigid).
    slack : float
        Relative rotation (rad), either way, within which it turns freely.
    side : {"both", "sagging", "hogging", "counterclockwise", "clockwise"}
        Sagging holds against sagging moments only, hogging against hogging ones; default both. Or by the couple on the part left of
        it: counterclockwise is sagging, clockwise hogging.
    law : list of (float, float) or table, optional
        Instead of stiffness: points of a curve, rotation past the slack and moment (rad, force*length), as of a support. Or a table
        with a type, plastic or hardening.
    unloading : {"elastic", "plastic"}
        As of a support: plastic yields and keeps a rotation, by springs with sliders side by side.
    """

    stiffness: NotNegative | None = None
    slack: NotNegative = 0.0
    side: HingeSide = "both"
    law: Law | None = None
    unloading: Literal["elastic", "plastic"] = "elastic"


class Rotation(Table, forbid_unknown_fields=True, kw_only=True, gc=False):
    """How a support holds the rotation of the beam, where it is more than a stiffness; a support of its own in results.

    Parameters
    ----------
    stiffness : float
        Couple per rotation (force*length/rad); default inf (rigid).
    slack : float
        Rotation (rad) within which it turns freely, from where the support stands.
    side : {"both", "counterclockwise", "clockwise"}
        Which way it turns the beam, as a foot that tips; default both.
    law : list of (float, float) or table, optional
        Instead of stiffness: points of a curve, rotation past the slack and couple (rad, force*length), as of a support. Or a table
        with a type, plastic or hardening.
    unloading : {"elastic", "plastic"}
        As of a support: plastic yields and keeps a rotation, by springs with sliders side by side.
    """

    stiffness: NotNegative = inf
    slack: float = 0.0
    side: TurnSide = "both"
    law: Law | None = None
    unloading: Literal["elastic", "plastic"] = "elastic"
