"""Keys and values of a scene by the words of other programs: hints at the right ones, no second names."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

KEYS = {
    "k": "stiffness", "spring": "stiffness", "kz": "stiffness", "clearance": "gap", "offset": "settlement", "displacement":
    "settlement", "pos": "x", "position": "x", "location": "x", "at": "x", "fx": "F", "fy": "F", "fz": "F", "p": "F", "force": "F",
    "load": "F", "w": "q", "udl": "q", "intensity": "q", "magnitude": "F", "value": "F", "moment": "M", "mz": "M", "my": "M",
    "lengths": "spans", "length": "spans", "l": "spans", "ks": "k", "modulus": "k", "bedding": "k", "start": "from", "a": "from",
    "x1": "from", "end": "to", "b": "to", "x2": "to", "group": "case", "loadcase": "case", "wheels": "axles", "loads": "axles",
}  # fmt: skip
"""Keys of scenes by those of others, in lower case; they hold where the table has such a key."""
OF_SUPPORTS = {
    "type": 'a support has no type: side = "both" holds it up and down (a pin or roller), "below" lets it lift off, rotation = '
    '"fixed" clamps it',
    "kind": 'a support has no kind: side = "both" holds it up and down, "below" lets it lift off',
    "fixed": 'did you mean rotation = "fixed"?',
}
"""What supports have in other words."""
_BELOW = 'a support that lies under the beam and lets it lift off is "below"'
_BOTH = 'one that holds the beam up and down is "both", one from which it can lift off "below"'
_EITHER = f'{_BELOW}, one that holds it down only is "above"'
VALUES = {
    ("side", "down"): _EITHER, ("side", "up"): _EITHER, ("side", "bottom"): _BELOW, ("side", "lower"): _BELOW,
    ("side", "under"): _BELOW,
    ("side", "compression"): _BELOW, ("side", "top"): 'did you mean "above"?', ("side", "upper"): 'did you mean "above"?',
    ("side", "tension"): 'one that holds the beam down only is "above"', ("side", "roller"): _BOTH, ("side", "pin"): _BOTH,
    ("side", "pinned"): _BOTH, ("side", "hinged"): _BOTH, ("side", "fixed"): f'{_BOTH}; rotation = "fixed" clamps it',
    ("rotation", "true"): 'did you mean "fixed"?', ("rotation", "false"): 'did you mean "free"?',
    ("rotation", "clamped"): 'did you mean "fixed"?', ("rotation", "rigid"): 'did you mean "fixed"?',
    ("rotation", "pinned"): 'did you mean "free"?', ("rotation", "hinged"): 'did you mean "free"?',
    ("type", "point"): 'did you mean "force"?', ("type", "concentrated"): 'did you mean "force"?',
    ("type", "pointload"): 'did you mean "force"?', ("type", "nodal"): 'did you mean "force"?',
    ("type", "udl"): 'did you mean "uniform"?', ("type", "distributed"): 'did you mean "uniform" or "linear"?',
    ("type", "line"): 'did you mean "uniform" or "linear"?', ("type", "trapezoidal"): 'did you mean "linear"?',
    ("type", "triangular"): 'did you mean "linear"?', ("type", "couple"): 'did you mean "moment"?',
    ("type", "thermal"): 'did you mean "temperature"?',
    ("type", "moving"): "loads that move are trains",
}  # fmt: skip
"""What was probably meant by a value, by its key and the value in lower case."""
LAW = '{ type = "tanh", stiffness = 2e4, limit = 90.0 }'
"""An example of a law of the ground by name."""
TAPERED = re.compile(r"beam\.(EI|GA|EA)(\[\d+\])?")
"""Places of stiffnesses, where a pair or a table was probably meant as one that changes along the beam."""
LONGEST = 30
"""Characters of a text that is read as a number, to be written again."""
NUMBER = re.compile(r"\s*[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?\s*(?P<unit>[A-Za-z][\w ^*/.-]*)?")


def meant_by_key(key: str, known: list[str], place: str) -> str | None:
    """Say what a key was probably meant to be.

    Parameters
    ----------
    key : str
        As written.
    known : list of str
        The keys of the table.
    place : str
        Where the table is.

    Examples
    --------
    >>> meant_by_key("P", ["type", "x", "F"], "loads[0]"), meant_by_key("k", ["node", "stiffness"], "supports[0]")
    ('did you mean "F"?', 'did you mean "stiffness"?')
    """
    if place.startswith("supports") and key.lower() in OF_SUPPORTS:
        return OF_SUPPORTS[key.lower()]
    other = None if place.endswith(".law") else KEYS.get(key.lower())
    return f'did you mean "{other}"?' if other in known else None


def meant_by_value(place: str, value: Any, expected: str) -> str:
    """Say what a value was probably meant to be.

    Parameters
    ----------
    place : str
        Where it is.
    value : object
        As written.
    expected : str
        What was expected there.

    Returns
    -------
    str
        Begins with a semicolon; empty where there is nothing to say.

    Examples
    --------
    >>> meant_by_value("beam.EI", "1e4 kN m^2", "a number")
    '; numbers have no units: write 1e4 if the scene has kN m^2, else convert it'
    """
    key = place.rpartition(".")[2]
    if place.rpartition("[")[0].endswith(".axles"):
        return "; an axle is [distance behind the first axle, force]"
    if TAPERED.fullmatch(place) and isinstance(value, list | tuple | Mapping) and len(value) > 1:
        return "; give a stiffness that changes along the beam in [[sections]]: EI = [at from, at to]"
    if expected == "a list of tables" and isinstance(value, Mapping):
        return f"; write each as [[{place}]]"
    if expected == "a table" and isinstance(value, list) and value and isinstance(value[0], Mapping):
        return f"; write it as [{place}]"
    if not isinstance(value, str | bool):
        return ""
    if key == "law" and place.startswith("foundation"):
        return "; give points [displacement, force per length], or a law by name such as " + LAW
    if (hint := VALUES.get((key, str(value).lower()))) is not None:
        return f"; {hint}"
    is_short = isinstance(value, str) and len(value) <= LONGEST
    found = NUMBER.fullmatch(value) if is_short and "number" in expected else None
    if found is None:
        return ""
    if not found["unit"]:
        return f"; write {value.strip()} without quotes"
    figure, unit = value[: found.start("unit")].strip(), found["unit"].strip()
    return f"; numbers have no units: write {figure} if the scene has {unit}, else convert it"
