"""Scenes seen otherwise, with a known effect: from behind, upside down, with one more node, without what does not act."""

import copy

from .plain import nodes_of

TURNED = {"left": "right", "right": "left", "clockwise": "counterclockwise", "counterclockwise": "clockwise"}
OVER = {"below": "above", "above": "below", "sagging": "hogging", "hogging": "sagging",
        "clockwise": "counterclockwise", "counterclockwise": "clockwise"}  # fmt: skip
PARTS = ("supports", "loads", "sections", "hinges", "foundation", "axial_ground", "masses")
ALONG_BEAM = ("spans", "EI", "GA", "EA", "N", "mass", "alpha", "depth")
ALONG_PART = ("q", "value", "EI", "GA", "EA", "N", "k", "gap", "profile", "limit", "stiffness", "kappa", "dT", "gradient")
TURNS_OVER = {"moment": "M", "axial": "F", "axial_uniform": "q"}
"""What acts along the beam or turns it, by type of load: it changes its sign seen from behind."""
TURNED_OVER = {"force": ["F"], "moment": ["M"], "uniform": ["q"], "linear": ["q"], "curvature": ["kappa"],
               "temperature": ["gradient"], "movement": ["value", "rotation"]}  # fmt: skip
"""What acts across the beam or bends it: it changes its sign upside down."""


def mirrored(made):
    """The scene seen from behind: x becomes length - x; it may have anything but trains."""
    new = copy.deepcopy(made)
    length, last = nodes_of(made)[-1], len(made["beam"]["spans"])

    def turned(value):
        """By span, from one end to the other, or a table of places."""
        if isinstance(value, dict):
            return {**value, "from": value["to"], "to": value["from"]}
        if not isinstance(value, list) or not value:
            return value
        return [[length - x, y] for x, y in value[::-1]] if isinstance(value[0], list) else value[::-1]

    beam = new["beam"]
    beam.update({key: turned(beam[key]) for key in ALONG_BEAM if key in beam})
    beam.update({"hinges": sorted(length - x for x in beam["hinges"])} if "hinges" in beam else {})
    for item in (item for part in PARTS for item in new.get(part, ())):
        if "node" in item:
            item["node"] = last - item["node"]
        elif "x" in item:
            item["x"] = length - item["x"]
        if "from" in item or "to" in item:
            item["from"], item["to"] = length - item.get("to", length), length - item.get("from", 0.0)
        item.update({key: turned(item[key]) for key in ALONG_PART if key in item})
        item.update({key: TURNED.get(item[key], item[key]) for key in ("side", "at_hinge") if key in item})
    for support in new.get("supports", ()):
        rotation = support.get("rotation")
        if isinstance(rotation, dict) and "side" in rotation:
            rotation["side"] = TURNED.get(rotation["side"], rotation["side"])
        if support.get("direction") == "axial" and "settlement" in support:
            support["settlement"] *= -1.0
    for load in new["loads"]:
        key = TURNS_OVER.get(load["type"])
        if load["type"] == "movement" and "support" in load:
            axial = new["supports"][load["support"]].get("direction") == "axial"
            key = "rotation" if "rotation" in load else "value" if axial else None
        load.update({key: -load[key]} if key else {})
    for item in new.get("foundation", ()):
        law = item.get("law")
        if isinstance(law, dict):
            item["law"] = {key: turned(value) for key, value in law.items()}
        elif law and isinstance(law[0], dict):
            item["law"] = [{**at, "x": length - at["x"]} for at in law[::-1]]
    return new


def upside_down(made):
    """The scene with up and down changed: what pushes up pushes down."""
    new = copy.deepcopy(made)
    supports, loads = new.get("supports", ()), new["loads"]
    across = [one for one in supports if one.get("direction") != "axial"]
    turning = [one["rotation"] for one in supports if isinstance(one.get("rotation"), dict)]
    for item in (*across, *turning, *new.get("hinges", ()), *new.get("foundation", ())):
        item.update({"side": OVER.get(item["side"], item["side"])} if "side" in item else {})
    for item in across:
        item.update({"settlement": -item["settlement"]} if "settlement" in item else {})
    for load in loads:
        keys = TURNED_OVER.get(load["type"], ())
        if load["type"] == "movement" and "support" in load and supports[load["support"]].get("direction") == "axial":
            keys = ()
        load.update({key: _negative(load[key]) for key in keys if key in load})
    return new


def _negative(value):
    """A number, or a pair of them."""
    return [-one for one in value] if isinstance(value, list) else -value


def cut(made, span, share):
    """The same beam with one more node, at `share` of one span."""
    new = copy.deepcopy(made)
    length = made["beam"]["spans"][span]
    new["beam"]["spans"][span : span + 1] = [length * share, length * (1.0 - share)]
    for key in ALONG_BEAM[1:]:
        if isinstance(new["beam"].get(key), list):
            new["beam"][key].insert(span, new["beam"][key][span])
    for item in (item for part in PARTS for item in new.get(part, ())):
        if item.get("node", 0) > span:
            item["node"] += 1
    return new


def working_scheme(made, states):
    """The bilateral structure of a contact state: closed supports hold, open ones are gone."""
    new = copy.deepcopy(made)
    new["supports"] = []
    for support, state in zip(made["supports"], states, strict=True):
        support = dict(support)
        side, gap = support.pop("side", "both"), support.pop("gap", 0.0)
        if state == "closed":
            support["settlement"] = support.get("settlement", 0.0) + (gap if side == "below" else -gap)
        if state != "open":
            new["supports"].append(support)
    return new
