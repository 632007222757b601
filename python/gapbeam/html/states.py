"""One state of a beam as numbers from which a page draws it again: exact values at the joints, on the ground at many places."""

from __future__ import annotations

import base64
from typing import TYPE_CHECKING, Any

import numpy as np

from ..engine.beam import SOLVED
from ..engine.quantities import FIELDS
from ..scene.loads import AxialUniformLoad
from ..scene.tapers import is_tapered

if TYPE_CHECKING:
    from ..results.result import Result
    from ..results.state.step import Step

MOST_PLACES, FEWER_PLACES = 240, 120
"""Places along a beam on the ground at which its states are given; while trains pass, of which there are more states."""
SIDES = {"below": 1, "both": 0, "above": -1}
ROW = {name: k for k, name in enumerate(FIELDS)}
OF_SUPPORTS = ("reaction", "opening", "deflection", "couple", "set", "friction", "slip")
ALWAYS = 3
"""Of these so many are given even where all are zero."""
ON_GROUND = {"w": "deflection", "m": "moment", "v": "shear", "p": "pressure"}
"""What is given of a state at many places."""
DIGITS = "0123456789abcdefghijklmnopqrstuvwxyz"
AXIAL_GRID = 129
"""Places at which the axial force is given on ground along the beam, where it has kinks between the joints."""
EQUAL = 1e-13
"""Share of the largest moment by which those on both sides of a joint differ by rounding."""
FIELD_OF = {**ON_GROUND, "m_left": "moment", "n": "axial_force", "n_left": "axial_force", "n_grid": "axial_force"}
"""Fields by the short names of the columns of a state."""


def packed(values: np.ndarray) -> str:
    """Write numbers as single precision in base 64: seven digits, which is more than a picture shows.

    Parameters
    ----------
    values : numpy.ndarray
        The numbers.

    Examples
    --------
    >>> packed(np.array([1.0, -2.5]))
    'AACAPwAAIMA='
    """
    return base64.b64encode(np.ascontiguousarray(values, dtype="<f4").tobytes()).decode()


def is_at_places(result: Result) -> bool:
    """Whether states are given at many places: on the ground, under axial forces and where sections taper they are no polynomials.

    Parameters
    ----------
    result : Result
        Of one load.
    """
    return result._beam.in_stretches or any(map(is_tapered, result.scene.sections))


def places_on_ground(result: Result) -> tuple[np.ndarray, np.ndarray]:
    """Choose the places at which states are given that are no polynomials.

    Parameters
    ----------
    result : Result
        Of one load.

    Returns
    -------
    piece : numpy.ndarray of int
        Piece of every place, from 0.
    distance : numpy.ndarray
        Distance from its left end.
    """
    most = FEWER_PLACES if result.scene.trains else MOST_PLACES
    return result._places_along(max(1, most // len(result.scene.beam.spans)))


class Recorder:
    """Makes the records of the states of one beam.

    Parameters
    ----------
    result : Result
        Of one load.
    words : list of str
        Words for the states of supports; new ones are added.
    short : {0, 1, 2}
        Of how much only seven digits are kept: nothing, what is between the supports, everything.
    """

    def __init__(self, result: Result, words: list[str], short: int = 0) -> None:
        self._beam, self._words, self._short = result._beam, words, short
        self.x = result._beam.places.point_x
        self.grid = places_on_ground(result) if is_at_places(result) else None
        self._is_spread = any(isinstance(load, AxialUniformLoad) for load in result.scene.loads)

    def codes(self, states: tuple[str, ...]) -> str:
        """Number the states of the supports.

        Parameters
        ----------
        states : tuple of str
            Of `Step.state`.

        Returns
        -------
        str
            A digit for every support, of 36; what comes after has the last one.
        """
        for state in dict.fromkeys(states):
            if state not in self._words and len(self._words) < len(DIGITS):
                self._words.append(state)
        return "".join(DIGITS[self._words.index(state)] if state in self._words else DIGITS[-1] for state in states)

    def columns(self, step: Step) -> dict[str, np.ndarray]:
        """Give the numbers of a state between which states are drawn.

        Parameters
        ----------
        step : Step
            A state of the beam.

        Returns
        -------
        dict
            On the ground its fields at many places; else deflections of the joints, moments left and right of the pieces.
        """
        found = {}
        if self.grid is not None:
            values = step.values(self.grid[0] + np.int32(1), self.grid[1])
            found = {name: values[ROW[field]] for name, field in ON_GROUND.items()}
            if self._beam.in_stretches:
                return found
        beam = step._beam
        right, left = (step.values(*beam.find(x, side)) for x, side in ((self.x[:-1], False), (self.x[1:], True)))
        if self.grid is None:
            w, m = ROW["deflection"], ROW["moment"]
            found = {"w": np.append(right[w], left[w, -1]), "m": right[m], "m_left": left[m]}
        if self._beam.bars >= 0:
            found["n"] = right[ROW["axial_force"]]
            if self._is_spread:
                found["n_left"] = left[ROW["axial_force"]]
        if self._beam.is_on_axial_ground:
            grid = np.linspace(0.0, self.x[-1], AXIAL_GRID)
            found["n_grid"] = step.values(*beam.find(grid, left=False))[ROW["axial_force"]]
        return found

    def record(self, step: Step) -> dict[str, Any]:
        """Give a state with the same doubles as in the JSON output.

        Parameters
        ----------
        step : Step
            A state of the beam.

        Returns
        -------
        dict
            Of supports ``reaction``, ``opening``, ``deflection``, and others where there are any; on the ground the
            zones of contact and free spans.
        """
        found: dict[str, Any] = {"factor": step.factor}
        for k, name in enumerate(OF_SUPPORTS):
            values = getattr(step, name)
            if k < ALWAYS or values.any():
                found |= {f"{name}_packed": packed(values)} if self._short > 1 else {name: values.tolist()}
        if self._beam.is_on_axial_ground:
            found["n_parts"] = _axial_parts(step)
        columns = self.columns(step)
        if self.grid is not None:
            found |= on_ground(step)
            return found | {f"{name}_packed": packed(values) for name, values in columns.items()}
        columns = joined_moments(columns)
        if self._short:
            return found | {f"{name}_packed": packed(values) for name, values in columns.items()}
        return found | {name: values.tolist() for name, values in columns.items()}


def joined_moments(columns: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Give one moment for both sides of the joints, where no couple makes it jump.

    Parameters
    ----------
    columns : dict
        By `Recorder.columns`.
    """
    m, left = columns["m"], columns["m_left"]
    if np.abs(m[1:] - left[:-1]).max(initial=0.0) > EQUAL * np.abs(m).max():
        return columns
    return {name: values for name, values in columns.items() if name != "m_left"} | {"m": np.append(m, left[-1])}


def _axial_parts(step: Step) -> list[list[float]]:
    """Give the axial force of a state on ground along the beam: both ends of every part that is straight, or nearly, and forces.

    It has kinks inside the pieces, and curves where that ground gives way.
    """
    beam, n = step._beam, ROW["axial_force"]
    points, ends = beam.places.point_x, [end for zone in step.slip_zones for end in (zone.from_, zone.to)]
    x = np.unique([*points.tolist(), *ends, *np.linspace(points[0], points[-1], AXIAL_GRID).tolist()])
    right, left = (step.values(*beam.find(places, side))[n] for places, side in ((x[:-1], False), (x[1:], True)))
    return np.column_stack([x[:-1], x[1:], right, left]).tolist()


def on_ground(step: Step) -> dict[str, Any]:
    """Give what does not follow from the values at many places: zones of contact, free spans, exact extremes.

    Parameters
    ----------
    step : Step
        A state on the ground.

    Returns
    -------
    dict
        ``zones`` foundation, ends, state, resultant; ``free`` foundation, ends, sag; ``extremes`` by field value and place of
        the largest and of the smallest.
    """
    values, x = step.solution.extremes()
    return {
        "zones": [[one.foundation, one.from_, one.to, one.state, one.resultant] for one in step.contact],
        "free": [[one.foundation, one.from_, one.to, one.sag] for one in step.free_spans],
        "extremes": {name: [values[:, ROW[name]].tolist(), x[:, ROW[name]].tolist()] for name in ON_GROUND.values()},
    }


def stands(step: Step) -> bool:
    """Whether a state is one of equilibrium.

    Parameters
    ----------
    step : Step
        The state.
    """
    return step.solution.status == SOLVED
