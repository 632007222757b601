"""Key paths: the number of a scene that a column of a table stands for.

>>> from gapbeam import read_scene
>>> scene = read_scene({"beam": {"spans": [6.0], "EI": 1e4}, "supports": [{"node": 0, "name": "R-101"}, {"node": 1}],
...                     "loads": [{"type": "uniform", "q": 5.0, "case": "wind"}]})
>>> [path.parts for path in find_paths(scene, ["supports.R-101.gap", "loads[0].q", "factors.wind"])]
[('supports', 0, 'gap'), ('loads', 0, 'q'), ('factors', 'wind')]
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Any

import msgspec

from ..base.errors import SceneError
from ..scene.combinations import VALUES
from ..scene.edited import unquoted
from ..scene.names import NAMED, cases_of
from ..scene.structs import Scene, Train
from ..scene.trains import joined
from ..scene.typed import plain
from ..scene.wording import key_of, shown

HEADS = ("supports", "loads", "beam", "sections", "hinges", "foundation", "axial_ground", "masses", "trains", "combinations")
"""What of a scene has numbers that may vary by row."""
OPTIONAL = {"x", "to", "k", "EI", "GA", "EA", "N", "stiffness", "limit"}
"""Keys that hold a number where they are given."""
OF_SPANS = ("EI", "GA", "EA")
"""Keys of the beam that hold one number for all spans, or one for each."""
NAMES = (*NAMED, "hinges", "axial_ground", "masses", "trains")
"""Tables whose entries may be told by name."""
MOST = 20_000
"""Numbers of a scene among which a similar one is looked for."""
PIECE = re.compile(r"""\.?(?:"(?P<quoted>(?:[^"\\]|\\.)*)"|'(?P<single>[^']*)'|\[(?P<index>\d{1,9})\]|(?P<bare>[^.\[\]"']+))""")


@dataclass(frozen=True, slots=True)
class KeyPath:
    """A number of a scene, or the factor of a load case.

    Attributes
    ----------
    text : str
        As the column is named.
    parts : tuple of (str or int)
        Keys and numbers of entries from the top of the scene; or ``("factors", case)``.
    """

    text: str
    parts: tuple[str | int, ...]


def scene_data(scene: Scene) -> dict[str, Any]:
    """Give a scene as dicts, lists and numbers, with all its keys.

    Parameters
    ----------
    scene : Scene
        Checked.

    Returns
    -------
    dict
        Lists of supports, loads and so on are lists of dicts, however they were given.
    """
    return plain(msgspec.structs.replace(scene, **{key: list(getattr(scene, key)) for key in HEADS if key != "beam"}))


def find_paths(scene: Scene, names: Sequence[str]) -> tuple[KeyPath, ...]:
    """Find the numbers that columns are named after.

    Parameters
    ----------
    scene : Scene
        Checked.
    names : sequence of str
        Of the columns.

    Raises
    ------
    SceneError
        A column is no key path of this scene, or two of them are the same number.
    """
    data = scene_data(scene)
    found: dict[tuple[str | int, ...], KeyPath] = {}
    for name in names:
        path = KeyPath(str(name), _resolve(scene, data, str(name)))
        if path.parts in found:
            raise SceneError(f"column {shown(path.text)}", f"is the same number as column {shown(found[path.parts].text)}; leave "
                             "one of them out")  # fmt: skip
        found[path.parts] = path
    for parts, path in found.items():
        if parts[0] == "beam" and parts[:2] != parts and parts[:2] in found:
            of_all = shown(found[parts[:2]].text)
            raise SceneError(f"column {shown(path.text)}", f"is one of the spans of column {of_all}; leave one out, or give "
                             "each span a column")  # fmt: skip
    return tuple(found.values())


def varies_by_case(scene: Mapping[str, Any], path: KeyPath) -> bool:
    """Whether a number may differ from case to case on a beam that is prepared once.

    Parameters
    ----------
    scene : mapping
        From `scene_data`.
    path : KeyPath
        Of the number.
    """
    head, *rest = path.parts
    if head == "beam":
        return rest[0] in ("EI", "GA")
    if head == "foundation":  # a modulus that is one number
        return rest[1:] == ["k"] and isinstance(scene["foundation"][rest[0]]["k"], int | float)
    if head == "loads":
        load = scene["loads"][rest[0]]
        if rest[1] == "dT" or (rest[1] == "gradient" and load["dT"]):  # a case has one factor for all values of a load
            return False
        return len(rest) == 2 and rest[1] in VALUES and not isinstance(load[rest[1]], list)
    if head == "supports" and rest[1] == "gap":  # it moves the place where a one-sided support begins to act
        support = scene["supports"][rest[0]]
        return support["side"] != "both" and support["law"] is None
    if head == "supports" and rest[1] == "stiffness":
        return scene["supports"][rest[0]]["law"] is None
    return head == "factors" or (head == "supports" and rest[1] == "settlement")


def with_values(data: Mapping[str, Any], paths: Sequence[KeyPath], values: Sequence[float]) -> dict[str, Any]:
    """Put a row of a table into a scene.

    Parameters
    ----------
    data : mapping
        From `scene_data`; left as it is.
    paths : sequence of KeyPath
        Of the columns.
    values : sequence of float
        One for each; factors multiply the loads and trains of their case, after all other numbers are in their places.

    Returns
    -------
    dict
        Another scene.
    """
    scene = dict(data)
    factors: dict[str | int, float] = {}
    for path, value in zip(paths, values, strict=True):
        if path.parts[0] == "factors":
            factors[path.parts[1]] = value
        else:
            scene = _put(_by_span(scene, path.parts), path.parts, value)
    if factors:
        scene["loads"] = [_times(load, factors[load["case"]]) if load["case"] in factors else load for load in scene["loads"]]
        scene["trains"] = [
            {**train, "factor": factors[train["case"]] * train["factor"]} if train["case"] in factors else train
            for train in _joined(scene["trains"])
        ]
    return scene


def _joined(trains: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """The same where each brings its own axles: the factor of a member's case is not that of a train that it is part of."""
    if not any(train["together"] for train in trains):
        return trains
    typed = msgspec.convert(trains, list[Train])
    return [msgspec.to_builtins(joined(typed, i)) for i in range(len(trains))]


def _by_span(scene: dict[str, Any], parts: tuple[str | int, ...]) -> dict[str, Any]:
    """The same with a number for every span where one span gets its own, and there was one number for all."""
    beam = scene["beam"]
    if parts[0] != "beam" or len(parts) < 3 or isinstance(beam[parts[1]], list):
        return scene
    return {**scene, "beam": {**beam, parts[1]: [beam[parts[1]]] * len(beam["spans"])}}


def _put(old: Any, parts: tuple[str | int, ...], value: float) -> Any:
    """The same with one number replaced; what does not lead there is shared."""
    if not parts:
        return int(value) if isinstance(old, int) and value.is_integer() else value
    new = old.copy()
    new[parts[0]] = _put(old[parts[0]], parts[1:], value)
    return new


def _times(load: dict[str, Any], factor: float) -> dict[str, Any]:
    given = {key: load[key] for key in VALUES if load.get(key) is not None}
    made = {key: [factor * one for one in value] if isinstance(value, list) else factor * value for key, value in given.items()}
    return load | made


def _resolve(scene: Scene, data: dict[str, Any], name: str) -> tuple[str | int, ...]:
    pieces = _pieces(name)
    place = f"column {shown(name)}"
    if not pieces:
        raise _unknown(scene, data, place, name)
    if pieces[0] == "factors":
        if len(pieces) != 2 or pieces[1] not in _cases(scene):
            raise _unknown(scene, data, place, name)
        return "factors", pieces[1]
    if pieces[0] not in HEADS:
        raise _unknown(scene, data, place, name)
    value: Any = data
    parts: list[str | int] = []
    for piece in pieces:
        if len(parts) == 2 and parts[0] == "beam" and parts[1] in OF_SPANS and not isinstance(value, list):
            value = [value] * len(data["beam"]["spans"])
        if isinstance(value, dict) and piece in value:
            key: str | int = piece
        elif isinstance(value, list) and (found := _entries(value, piece, len(parts) == 1 and parts[0] in NAMES)):
            if len(found) > 1:
                problem = f"there are {len(found)} of the name {shown(piece)}; give the number of one"
                raise SceneError(place, f"{problem}, as {parts[0]}[{found[0]}]")
            key = found[0]
        elif isinstance(value, list) and value and re.fullmatch(r"\d+", str(piece)):
            raise SceneError(place, f"there is no entry {piece}; the scene has {len(value)} there, 0 to {len(value) - 1}")
        else:
            raise _unknown(scene, data, place, name)
        parts.append(key)
        value = value[key]
    if isinstance(value, list) and value and isinstance(value[0], int | float):
        raise SceneError(place, f"is a list of {len(value)} numbers here; name one of them, such as {shown(name + '[0]')}")
    if not _may_vary(parts[-1], value):
        if isinstance(value, dict | list):
            raise _unknown(scene, data, place, name)
        raise SceneError(place, f"is {shown(value)} in the scene; only numbers can be taken from a table")
    return tuple(parts)


def _cases(scene: Scene) -> dict[str, None]:
    """Load cases, in their order."""
    return dict.fromkeys((*cases_of(scene.loads), *(train.case for train in scene.trains)))


def _pieces(name: str) -> list[str | int] | None:
    """Keys and numbers of a path as they are written; None where it is none."""
    found: list[str | int] = []
    at = 0
    for piece in PIECE.finditer(name):
        if piece.start() != at or (not found and (name[0] == "." or piece["index"])):
            return None
        at = piece.end()
        text = next(piece[kind] for kind in ("quoted", "single", "index", "bare") if piece[kind] is not None)
        text = unquoted(text) if piece["quoted"] is not None else text
        found.append(int(text) if piece["index"] else text.strip() if piece["bare"] else text)
    return found if at == len(name) and found else None


def _entries(items: list, piece: str | int, named: bool) -> list[int]:
    """Numbers of the entries of a list that have a name or number."""
    if named and isinstance(piece, str):
        found = [k for k, one in enumerate(items) if one["name"] == piece]
        if found:
            return found
        piece = int(piece) if re.fullmatch(r"\d{1,9}", piece) else -1
    return [piece] if isinstance(piece, int) and 0 <= piece < len(items) else []


def _may_vary(key: str | int, value: Any) -> bool:
    if isinstance(value, bool):
        return False
    return isinstance(value, int | float) or (value is None and key in OPTIONAL) or key == "rotation"


def _unknown(scene: Scene, data: dict[str, Any], place: str, name: str) -> SceneError:
    paths = list(islice(_all_paths(scene, data), MOST))
    folded = {path.casefold(): path for path in reversed(paths)}
    near = difflib.get_close_matches(name.casefold().strip(), folded, n=1, cutoff=0.6)
    if near:
        return SceneError(place, f"is no key path of the scene; did you mean {shown(folded[near[0]])}?")
    few = paths[:1] + [path for path in paths if path.startswith("supports") and path.endswith("gap")][:1] + paths[-1:]
    return SceneError(place, f"is no key path of the scene; such are {', '.join(map(shown, dict.fromkeys(few)))}")


def _all_paths(scene: Scene, data: dict[str, Any]) -> Iterator[str]:
    """Every number of a scene as a path, by names where there are any."""
    for case in _cases(scene):
        yield f"factors.{key_of(case)}"
    for head in HEADS:
        yield from _paths_in(head, data[head], head in NAMES)


def _paths_in(path: str, value: Any, named: bool) -> Iterator[str]:
    if isinstance(value, dict):
        for key, one in value.items():
            if isinstance(one, dict | list):
                yield from _paths_in(f"{path}.{key}", one, False)
            elif _may_vary(key, one):
                yield f"{path}.{key}"
    elif isinstance(value, list):
        for k, one in enumerate(value):
            name = one.get("name") if named else None
            at = f"{path}[{k}]" if not name else f"{path}.{key_of(name)}"
            if isinstance(one, dict | list):
                yield from _paths_in(at, one, False)
            elif _may_vary(k, one):
                yield at
