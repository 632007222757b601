"""The words for what the Fortran layer refuses, in a scene's own terms."""

from __future__ import annotations

from bisect import bisect_left
from itertools import accumulate
from math import isfinite, isnan
from typing import Any

from msgspec import Struct

from ..base.errors import SceneError
from .columns import KINDS
from .ground_laws import PowerGround, varies
from .rotations import turns
from .sides import ONE_WAY, SIDES
from .structs import Scene
from .table import kind_of
from .wording import number, shown

(NO_SPAN, NOT_EXPECTED, TOO_LONG, LOST_LENGTH, AT_END, OFF_BEAM, NO_PLACE, NO_NODE, NO_STRETCH, NOT_AXIAL, NO_GAP, NOT_HELD, TWICE,
 NO_ROOM, AT_HINGE, IDLE, BAD_LAW, BAD_LOAD) = range(1, 19)  # fmt: skip
"""Reasons, as in gapbeam_input_error."""
SPANS, HINGES, SUPPORTS, LOADS, SECTIONS, FOUNDATIONS = range(1, 7)
"""Tables, as in gapbeam_input_error."""
NAMES = {HINGES: "beam.hinges", SUPPORTS: "supports", LOADS: "loads", SECTIONS: "sections", FOUNDATIONS: "foundation"}
EXPECTED = {
    "stiffness": "a number, 0 or more (inf = rigid)",
    "k": "a finite number, 0 or more",
    "gap": "a finite number",
    "settlement": "a finite number",
    "rotation": '"free", "fixed" or a number, 0 or more',
    "friction": "a finite number, 0 or more",
    "limit": "a finite number, 0 or more",
}
OF_AXIAL_GROUND = {"friction": "limit", "friction_to": "limit", "bedding": "stiffness"}
"""Keys of ground along the beam, by those of the sections that it is given to the layer as."""
AXIAL = {
    "rotation": "an axial support holds no rotation; a normal one here can do that",
}


def refusal(scene: Scene, reason: int, table: int, entry: int, partner: int, key: str, message: str) -> SceneError:
    """Word a refusal of the Fortran layer.

    Parameters
    ----------
    scene : Scene
        What is refused.
    reason, table, entry, partner : int
        As in the layer's error_type; entries count from 1.
    key : str
        What of the entry it is about.
    message : str
        The layer's own words.
    """
    if table == SPANS:
        return _beam_refusal(scene, reason, entry - 1, key)
    if not table:
        return SceneError(f"analysis.{key}", message)
    i = entry - 1
    items = scene.beam.hinges if table == HINGES else getattr(scene, NAMES[table])
    if table == HINGES and i >= len(items):  # those with a table of their own come after the others
        path, items, i = _hinge(scene, i), scene.hinges, i - len(items)
        if items[i].x is None:
            reason = NO_PLACE if items[i].node is None else reason if 0 <= items[i].node <= len(scene.beam.spans) else NO_NODE
    elif table == SECTIONS and i >= len(items):  # ground along the beam is given to the layer as sections
        i, items = i - len(items), scene.axial_ground
        ours = OF_AXIAL_GROUND.get(key, key)
        path, message, key = f"axial_ground[{i}]", message.replace(f": {key}: ", f": {ours}: "), ours
        if key == "limit" and items[i].limit is None:
            return SceneError(path, "give its limit, its stiffness or both")
    else:
        path = f"{NAMES[table]}[{i}]"
    item, end = items[i], scene.span_ends()[-1]
    if table == SECTIONS and key and (reason == BAD_LAW or not isinstance(getattr(item, key, 0.0), float | int | None)):
        return SceneError(f"{path}.{key}", message.partition(": ")[2].removeprefix(f"{key}: "))
    if reason == BAD_LAW:
        return _bad_law(item, path, key, partner, message)
    if reason == BAD_LOAD:
        problem = message.partition(": ")[2].removeprefix(f"{key}: ")
        return SceneError(f"{path}.{key if key == 'from' or hasattr(item, key) else KINDS[kind_of(item)][1]}", problem)
    if reason == NOT_EXPECTED:
        return _wrong_number(item, table, path, key)
    if reason == OFF_BEAM:
        x = item if isinstance(item, float) else getattr(item, "from_" if key == "from" else key or "x")
        problem = f"{number(x)} is outside the beam, which runs from x = 0 to x = {number(end)}"
        return SceneError(path if isinstance(item, float) else f"{path}.{key or 'x'}", problem)
    if reason == NO_NODE:
        nodes = f"the nodes of the beam are 0 to {len(scene.beam.spans)}"
        return SceneError(f"{path}.node", f"there is no node {number(item.node)}; {nodes}")
    if reason == NO_PLACE:
        return SceneError(path, "its position is missing; give node or x")
    if reason == NO_STRETCH:
        stretch = f"from = {number(item.from_)} to = {number(end if item.to is None else item.to)}"
        return SceneError(path, f"the stretch {stretch} has no length; from must be less than to")
    if table == SUPPORTS:
        return _support_refusal(scene, reason, i, partner - 1, key)

    def x() -> str:
        return number(item if isinstance(item, float) else scene.positions([item])[0])

    words = {
        AT_END: lambda: f"x = {x()} is an end of the beam, where no hinge can be; remove it",
        TWICE: lambda: f"at x = {x()} there is a hinge already ({_hinge(scene, partner - 1)}); remove one of them",
        IDLE: lambda: "changes nothing; give EI, GA or EA",
        NOT_HELD: lambda: 'nothing holds the beam horizontally; give a support direction = "axial", friction, or axial_ground',
        AT_HINGE: lambda: f"the moment acts exactly at the hinge at x = {x()}, so it is unclear which side takes it; say at_hinge "
        '= "left" or "right"',
    }
    return SceneError(path, words[reason]())


def _hinge(scene: Scene, i: int) -> str:
    """The place of a hinge: those with a table of their own come after the others."""
    first = len(scene.beam.hinges)
    return f"beam.hinges[{i}]" if i < first else f"hinges[{i - first}]"


def _bad_law(item: Any, path: str, key: str, point: int, message: str) -> SceneError:
    """Give the layer's own words: "foundation 1 of 2: law: point 3: ...", where key and point may be missing."""
    problem = message.partition(": ")[2].removeprefix(f"{key}: ").removeprefix(f"point {point}: ")
    if key:
        path += f".{key}"
    if isinstance(item.law, PowerGround) and key.startswith("law.k"):
        path = path.removesuffix(key) + "law.limit"
    if point and key.startswith("law") and varies(item.law):
        ends = list(accumulate(len(place.points) for place in item.law))
        where = bisect_left(ends, point)
        inside = f"points[{point - 1 - (ends[where - 1] if where else 0)}]" if key == "law" else key.removeprefix("law.")
        return SceneError(f"{path.removesuffix(key)}law[{where}].{inside}", problem)
    if point and not (key == "law" and isinstance(item.law, Struct)):
        path += f"[{point - 1}]"
    return SceneError(path, problem)


def _beam_refusal(scene: Scene, reason: int, i: int, key: str) -> SceneError:
    if reason == NO_SPAN:
        return SceneError("beam.spans", "the beam has no span; give at least one length, for example [6.0]")
    if reason == TOO_LONG:
        return SceneError("beam.spans", "the beam is too long for the range of numbers")
    ends, length = scene.span_ends(), float(scene.beam.spans[i])
    if reason == LOST_LENGTH:
        lost = f"a length of {number(length)} is lost in rounding at x = {number(ends[i])}"
        return SceneError(f"beam.spans[{i}]", f"{lost}; give a greater length or remove it")
    if key != "length":
        value = getattr(scene.beam, key)
        place, got = (f"beam.{key}[{i}]", value[i]) if hasattr(value, "__len__") else (f"beam.{key}", value)
        expected = "a finite number, tension positive" if key == "N" else "a number above 0 (inf = rigid)"
        return SceneError(place, f"expected {expected}, got {number(got)}")
    if not isfinite(length):
        return SceneError(f"beam.spans[{i}]", f"expected a finite length above 0, got {number(length)}")
    stretch = f"the span from x = {number(ends[i])} to x = {number(ends[i] + length)} has length {number(length)}"
    return SceneError(f"beam.spans[{i}]", f"{stretch}; give a length above 0 or remove it")


def _wrong_number(item: Any, table: int, path: str, key: str) -> SceneError:
    if isinstance(item, float):
        return SceneError(path, "expected a number, got nan")
    if table == LOADS and key in ("value", "value_to"):
        key = KINDS[kind_of(item)][1]
        if getattr(item, key) is None:
            key = "rotation"
    value = getattr(item, "from_" if key == "from" else key)
    expected = EXPECTED.get("limit" if table == HINGES else key, "a finite number") if table != LOADS else "a finite number"
    if table == SECTIONS and key not in ("limit", "N"):
        expected = "a number above 0 (inf = rigid)"
    if isinstance(value, tuple | list):
        expected = "finite numbers, 0 or more" if key == "k" else "finite numbers"
    elif table == SUPPORTS and key == "stiffness" and turns(item) and not isnan(value):
        expected = "a number above 0 (inf = rigid)"
    elif key in ("x", "from", "to") or (isnan(value) and (table == SECTIONS or key == "stiffness")):
        expected = "a number"
    return SceneError(f"{path}.{key}", f"expected {expected}, got {shown(value)}")


def _support_refusal(scene: Scene, reason: int, i: int, other: int, key: str) -> SceneError:
    path, item = f"supports[{i}]", scene.supports[i]
    if reason == NOT_AXIAL:
        return SceneError(f"{path}.{key}", AXIAL[key])
    if reason == NO_GAP:
        ways = " or ".join(f'"{way}"' for way in ONE_WAY[item.direction])
        return SceneError(f"{path}.gap", f"only a support with side = {ways} has a gap")
    if reason == AT_HINGE:
        problem = 'there is a hinge here, so it is unclear which side is held; say at_hinge = "left" or "right"'
        return SceneError(f"{path}.rotation", problem)
    x = number(scene.positions([item])[0])
    if reason == TWICE and key == "law":
        what = "are rigid at the same deflection, so statics cannot tell what each of them takes"
        return SceneError(path, f"this one and supports[{other}] both stand at x = {x} and {what}; give one a finite stiffness")
    if reason == TWICE:
        what = {"direction": "hold the beam horizontally", "rotation": "hold the rotation of the beam rigidly"}
        does = what.get(key, f'are rigid with side = "{item.side}"')
        return SceneError(path, f"this one and supports[{other}] both stand at x = {x} and {does}; remove one of them")
    partner = scene.supports[other]
    what = "rotation" if turns(item) else "deflection"
    here = f"this one ({item.side}, acts at a {what} of {number(contact_level(item))})"
    there = f"supports[{other}] ({partner.side}, acts at {number(contact_level(partner))})"
    return SceneError(path, f"{here} and {there} leave no room at x = {x}; give a greater gap")


def contact_level(support: Any) -> float:
    """Deflection at which a support begins to act.

    Parameters
    ----------
    support : Support

    Returns
    -------
    float
        Length, positive downward: settlement + gap (below), settlement - gap (above), settlement (both).
    """
    return support.settlement + SIDES[support.side] * support.gap
