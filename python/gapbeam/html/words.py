"""Sentences that a checker has to know beside the numbers: what was left out, error bounds, how exact the pictures are."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..results import formatting as fmt
from ..results.equilibrium import feels_axial_force
from ..scene.rotations import which_turn

if TYPE_CHECKING:
    from ..results.result import Result
    from ..results.state.step import Step
    from .ways import Collected

LEFT_OUT = {
    "axial": "Axial forces and displacements: no load and no support acts along the beam.",
    "shear": "Shear deformation: no GA is given, so cross sections stay normal to the axis.",
    "foundation": "Foundations: there are none.",
    "hinges": "Hinges: there are none.",
    "rotational restraints": "Rotational restraints: no support holds the rotation of the beam.",
    "iteration": "The search for the contact state: no support acts one way only.",
    "deflections": "Deflections as unknowns: all supports that act are rigid, and moments alone determine the state.",
    "second order": "Effect of axial forces on bending (second order).",
}
"""By the words of `System.left_out`."""
BESIDE_N = {"axial": "Displacements along the beam: no load and no support acts along it; its axial force N is given."}
"""Other words where bending feels an axial force."""
FIRST_ORDER = "Equilibrium is that of the undeformed beam (first order). Deflections and rotations are small."
SECOND_ORDER = "Equilibrium is that of the deflected beam under its axial forces (second order). Slopes are small."
ALWAYS = (
    "The material is linear elastic. Supports and ground do what their keys in the input say, and nothing else.",
    "Loads act slowly: there are no inertia forces. Weight, impact and partial factors count only where the input has them.",
    "Strength, buckling, fatigue and the design of bearings are not checked, but for the limits that the input gives.",
)
"""What holds for every scene."""
EXACT = {
    "one": "It is the state at full load. Give follow = \"events\" in [analysis] to follow the load.",
    "steps": "The slider goes through the load steps of the input. Nothing is drawn between them.",
    "path": "Between two events every value is a straight line in the load factor, so all that is drawn is exact.",
    "states": "Between two events values are curved in the load factor. Drawn are states at most a pixel apart, with straight "
    "lines between them. Events and tables are exact.",
    "positions": "Between two events every value is a polynomial in the position of the train. Drawn are these polynomials.",
    "close positions": "While the train passes, states at single positions are drawn, with parabolas or straight lines between "
    "them. Tables are exact.",
}  # fmt: skip
"""How exact the pictures are, by `over` of a way."""


def left_out(result: Result) -> list[str]:
    """Say what was left out.

    Parameters
    ----------
    result : Result
        Of one load.
    """
    words, order = LEFT_OUT, FIRST_ORDER
    if feels_axial_force(result):
        words, order = LEFT_OUT | BESIDE_N, SECOND_ORDER
    return [words.get(one, one) for one in result.system.left_out] + [order, *ALWAYS]


def bounds_in_words(result: Result, step: Step) -> list[str]:
    """Say how large errors are at most.

    Parameters
    ----------
    result : Result
        Of one load.
    step : Step
        One of its states.
    """
    found, scene = [], result.scene
    largest = {name: float(abs(step.solution.extremes()[0][:, k]).max()) for name, k in result._beam.fields.items()}
    largest["reaction"] = float(np.abs(step.reaction[~which_turn(scene.supports)]).max(initial=0.0))
    for name, bound in step.error_bounds.items():
        if name == "reaction" and not scene.supports:
            continue
        if bound is None or bound == float("inf"):
            found.append(f"There is no bound for the {name}: the beam is free to move, or its state is known to fewer digits.")
            continue
        unit = fmt.unit(scene, name)
        where = "at any support" if name == "reaction" else "anywhere along the beam"
        found.append(f"No {name} is wrong by more than {bound:.1e} {unit} {where}.".replace("  ", " ")
                     + (f" The largest is {fmt.value(scene, name, largest[name])}." if name in largest else ""))  # fmt: skip
    return found


def exactness(collected: Collected, at_places: bool) -> list[str]:
    """Say how exact the pictures are.

    Parameters
    ----------
    collected : Collected
        All that the page moves.
    at_places : bool
        Whether fields are given at places (`is_at_places`).
    """
    kinds = dict.fromkeys(way["over"] for way in collected.ways if "over" in way)
    found = [EXACT[kind] for kind in kinds if kind != "one" or len(collected.ways) == 1]
    if "close positions" in kinds:
        worst = max(1.0, *(way.get("pixels", 0.0) for way in collected.ways))
        found.append(f"These are right to {fmt.count(math.ceil(worst), 'pixel')}.")
    if at_places:
        found.append("Along the beam values are given at many places, with straight lines between them.")
    elif kinds:
        found.append("Along the beam moments, shears and deflections are drawn from their polynomials.")
    if any(way.get("short") for way in collected.ways):
        found.append("The data are so many that what is drawn has seven digits.")
    left_out = sum(way.get("left_out", 0) for way in collected.ways)
    if left_out:
        found.append(f"The load has so many events that {left_out:,} stretches between two of them are not drawn.")
    if collected.left_out:
        found.append(f"{collected.left_out:,} combinations that do not govern are in the tables, not in the pictures.")
    return found
