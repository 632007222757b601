"""Units of the numbers of a scene, as its docstrings tell them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache

from ..base.characters import visible
from .rotations import turns
from .schema import scene_schema
from .structs import Scene

TABLES = {"beam": "Beam", "sections": "Section", "hinges": "Hinge", "supports": "Support", "foundation": "Foundation",
          "axial_ground": "AxialGround", "masses": "Mass", "trains": "Train", "combinations": "Combination"}  # fmt: skip
"""Tables of a scene by the key under which they are."""
OF_LAWS = ("supports", "hinges", "foundation")
"""Tables of a scene whose entries may have a law that is a table."""
OF_ROTATIONS = {"force/length": "force*length/rad", "force": "force*length", "length": "rad"}
"""Units of the numbers of a law where it holds a rotation."""
ONE = r"(?:force|length|rad|1)(?:[*/^](?:\d|force|length|time|rad|\([^)]*\)))*"
UNIT = re.compile(rf"\(({ONE}(?:, {ONE})*)(?:, from the left end(?: of the beam)?)?\)")
"""In a description: the unit of a number, or those of a pair."""


@cache
def _units() -> dict[tuple[str, str], tuple[str, ...]]:
    """Units by table and key, of pairs two."""
    found = {}
    for table, one in scene_schema()["$defs"].items():
        for key, entry in one["properties"].items():
            unit = UNIT.search(entry.get("description", ""))
            found[table, key] = tuple(unit[1].split(", ")) if unit else ()
    return found


def key_unit(scene: Scene, parts: Sequence[str | int]) -> str:
    """Give the unit of a number of a scene by the labels of the scene.

    Parameters
    ----------
    scene : Scene
    parts : sequence of (str or int)
        Keys and numbers of entries from the top of the scene, as of `gapbeam.batches.paths.KeyPath`.

    Returns
    -------
    str
        Empty where it has none, or the scene has no labels.

    Examples
    --------
    >>> from gapbeam import Beam, Scene, Units
    >>> scene = Scene(beam=Beam([4.0], EI=1.0), units=Units("kN", "m"))
    >>> key_unit(scene, ("beam", "EI", 0)), key_unit(scene, ("supports", 2, "stiffness")), key_unit(scene, ("factors", "wind"))
    ('kN m^2', 'kN/m', '')
    """
    head, *rest = parts
    table = TABLES.get(str(head), "")
    keys = [one for one in rest if isinstance(one, str)]
    items = getattr(scene, str(head)) if head in ("loads", *OF_LAWS) else []
    entry = items[rest[0]] if len(items) and rest[0] < len(items) else None
    if head == "loads":
        table = type(entry).__name__
    turning = head == "hinges" or (head == "supports" and entry is not None and turns(entry))
    if table == "Support" and keys[:1] == ["rotation"] and len(keys) > 1:
        table, keys, entry, turning = "Rotation", keys[1:], getattr(entry, "rotation", None), True
    if keys[:1] == ["law"] and len(keys) == 2:
        law = getattr(entry, "law", None)
        table = "LawAt" if isinstance(law, list) else type(law).__name__
    elif table == "Support" and turning:
        table, keys = "Rotation", ["slack" if keys[-1] in ("gap", "settlement") else keys[-1]]
    if table == "Combination" or (table == "Section" and len(keys) == 2 and keys[1] != "power"):  # by name; of a taper
        keys = keys[:1]
    pair = _units().get((table, keys[-1] if keys else ""), ())
    if not pair:
        return ""
    if len(pair) == 1 and len(rest) > 1 and isinstance(rest[-2], int) and isinstance(rest[-1], int):
        pair = ("length", *pair)  # values at places
    at = rest[-1] if isinstance(rest[-1], int) and len(pair) > 1 else 0
    force, length = visible(scene.units.force), visible(scene.units.length)
    pattern = pair[min(at, len(pair) - 1)]
    if turning and keys[0] == "law" and len(keys) == 2:
        pattern = OF_ROTATIONS.get(pattern, pattern)
    if ("force" in pattern and not force) or ("length" in pattern and not length):
        return ""
    words = {"force": force, "length": length, "*": " "}
    return re.sub(r"force|length|\*", lambda match: words[match[0]], pattern)
