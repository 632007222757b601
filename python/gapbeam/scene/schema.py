"""The JSON Schema of scenes, made from the structs and their docstrings."""

from __future__ import annotations

import inspect
import math
import re
from typing import Any, get_args

import msgspec

from .analysis import Analysis
from .axial_ground import AxialGround
from .ground_laws import GroundLawTable, LawAt
from .joints import Hinge, Rotation
from .laws import LawTable
from .limits import Limits
from .loads import Load
from .masses import Mass
from .structs import Beam, Combination, Foundation, Scene, Section, Support, Train, Units
from .tapers import Taper


def scene_schema() -> dict[str, Any]:
    """JSON Schema of a scene, for editors that complete and check TOML or JSON files.

    Returns
    -------
    dict
        For `json.dumps`. Defaults of inf stand in the descriptions only: JSON has no such number.

    Examples
    --------
    >>> scene_schema()["$defs"]["Support"]["properties"]["gap"]["description"]
    'Distance to be closed before it acts (length); negative = set too high; one-sided supports only.'
    """
    schema = msgspec.json.schema(Scene)
    grounds = Foundation, AxialGround
    tables = (Units, Beam, Section, Taper, Hinge, Support, Rotation, *grounds, Mass, Train, Combination, Analysis, Limits, Scene)
    for struct in (*tables, *get_args(Load), *get_args(LawTable), *get_args(GroundLawTable), LawAt):
        table = schema["$defs"][struct.__name__]
        table["description"] = inspect.cleandoc(struct.__doc__).partition("\n\n")[0]
        texts: dict[str, str] = {}
        for base in reversed(struct.__mro__[:-3]):
            texts |= _parameters(base.__doc__ or "")
        for key, entry in table["properties"].items():
            if key == "type":
                entry["description"] = "Says which table this is."
            if key in texts:
                entry["description"] = texts[key]
            if isinstance(entry.get("default"), float) and math.isinf(entry["default"]):
                del entry["default"]
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": "gapbeam scene", **schema}


def _parameters(docstring: str) -> dict[str, str]:
    """Descriptions of the parameters in a NumPy docstring, by key."""
    entries = re.findall(r"^(\w+) : .*\n((?:[ ]{4}.*\n?)+)", inspect.cleandoc(docstring), re.MULTILINE)
    return {name.rstrip("_"): " ".join(text.split()).replace("`", "") for name, text in entries}
