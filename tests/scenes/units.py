"""Scenes in other units: every number by the unit that its key has in the schema."""

import math
import re

from gapbeam.scene import Units
from gapbeam.scene.key_units import key_unit
from gapbeam.scene.reading import as_written


def in_units(made, force, length):
    """The same beam with every force times one number, and every length times another.

    Parameters
    ----------
    made : dict
        Left as it is.
    force, length : float
        Powers of two change no digit.

    Returns
    -------
    dict
    """
    scene = as_written(made)
    scene.units = Units("F", "L")

    def convert(value, *parts):
        if isinstance(value, dict):
            return {key: convert(one, *parts, key) for key, one in value.items()}
        if isinstance(value, list | tuple):
            return [convert(one, *parts, k) for k, one in enumerate(value)]
        if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
            return value
        forces, lengths = powers(key_unit(scene, parts))
        return value * force**forces * length**lengths if forces or lengths else value

    return {key: one if key in ("units", "analysis", "title") else convert(one, key) for key, one in made.items()}


def powers(unit):
    """Powers of force and length in a unit.

    >>> powers("F L^2"), powers("F/L^2"), powers("1/L"), powers("F L/rad"), powers("F time^2/L")
    ((1, 2), (1, -2), (0, -1), (1, 1), (1, -1))
    """
    found, sign = {"F": 0, "L": 0}, 1
    for name, power, over in re.findall(r"([A-Za-z1]+)(?:\^(\d))?|(/)", unit):
        if over:
            sign = -1
        elif name in found:
            found[name] += sign * int(power or 1)
    return found["F"], found["L"]
