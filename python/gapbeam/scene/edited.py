"""Scenes as plain data and as TOML, and scenes with one value replaced."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping, Sequence
from copy import deepcopy
from functools import cache
from typing import Any, TypeVar

import msgspec
import numpy as np

from ..base.errors import SceneError
from ..base.hints import few, nearest
from .wording import key_of, shown

S = TypeVar("S", bound=msgspec.Struct)
PIECE = re.compile(r"""\.?(?:"(?P<quoted>(?:[^"\\]|\\.)*)"|\[(?P<index>-?\d{1,9})\]|(?P<bare>[^.\[\]"]+))""")
OF_SPANS = ("EI", "GA", "EA")
"""Keys of the beam that hold one number for all spans, or one for each."""


def to_data(value: Any) -> Any:
    """Give a scene, or a part of it, as dicts, lists, numbers and texts, what is as by default left out.

    Parameters
    ----------
    value : object
        Structs, sequences, arrays and plain values.

    Returns
    -------
    object
        By the keys of a file.
    """
    if isinstance(value, msgspec.Struct):
        config = value.__struct_config__
        found = {} if config.tag is None else {config.tag_field: config.tag}
        for name, key, default in _fields(type(value)):
            data = to_data(getattr(value, name))
            if default is msgspec.NODEFAULT or data != default:
                found[key] = data
        return found
    if isinstance(value, Mapping):
        return {key: to_data(one) for key, one in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    if isinstance(value, Sequence) and not isinstance(value, str):
        return list(map(to_data, value))
    return value


@cache
def _fields(kind: type[msgspec.Struct]) -> tuple[tuple[str, str, Any], ...]:
    """Give attribute, key of a file and default as plain data of every field; asking for them takes long."""
    return tuple(
        (field.name, field.encode_name,
         to_data(field.default if field.default_factory is msgspec.NODEFAULT else field.default_factory()))
        for field in msgspec.structs.fields(kind)
    )  # fmt: skip


def to_toml(data: Mapping[str, Any]) -> str:
    """Write plain data of a scene as TOML.

    Parameters
    ----------
    data : mapping
        As of `Scene.to_dict`.

    Examples
    --------
    >>> print(to_toml({"title": "Two spans", "beam": {"spans": [6.0, 6.0], "EI": 1e4}, "supports": [{"node": 0}, {"node": 1}]}))
    title = "Two spans"
    <BLANKLINE>
    [beam]
    spans = [6.0, 6.0]
    EI = 10000.0
    <BLANKLINE>
    [[supports]]
    node = 0
    <BLANKLINE>
    [[supports]]
    node = 1
    <BLANKLINE>
    """
    parts = ["\n".join(f"{key_of(key)} = {_value(one)}" for key, one in data.items() if not _is_table(one))]
    for key, one in data.items():
        if isinstance(one, dict):
            parts.append(f"[{key_of(key)}]\n" + _table(one))
        elif _is_table(one):
            parts += [f"[[{key_of(key)}]]\n" + _table(item) for item in one]
    return "\n\n".join(part for part in parts if part) + "\n"


def _is_table(value: Any) -> bool:
    return isinstance(value, dict) or (isinstance(value, list) and bool(value) and all(isinstance(one, dict) for one in value))


def _table(table: Mapping[str, Any]) -> str:
    return "\n".join(f"{key_of(key)} = {_value(one)}" for key, one in table.items())


def _value(value: Any) -> str:
    """Write a value of TOML on one line."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key_of(key)} = {_value(one)}" for key, one in value.items()) + "}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(_value, value)) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return repr(value) if math.isfinite(value) else str(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    return str(value)


def replace(scene: S, path: str, value: Any) -> S:
    """Give a scene with one value replaced; the scene itself stays as it is.

    Parameters
    ----------
    scene : Scene
    path : str
        Where the value is, as in messages: keys, numbers and names of entries.
    value : object
        What is to stand there; checked when the scene is solved.

    Returns
    -------
    Scene

    Raises
    ------
    SceneError
        There is no such place.

    Examples
    --------
    >>> from gapbeam import Beam, Scene, Support
    >>> scene = Scene(beam=Beam([6.0, 6.0], EI=1e4), supports=[Support(node=i) for i in range(3)])
    >>> stiffer = replace(replace(scene, "beam.EI[1]", 2e4), "supports[2].gap", 0.01)
    >>> stiffer.beam.EI, stiffer.supports[2].gap, scene.supports[2].gap
    ([10000.0, 20000.0], 0.01, 0.0)
    """
    new = deepcopy(scene)
    pieces = pieces_of(path)
    owner, place = new, ""
    for k, piece in enumerate(pieces):
        key = _key(owner, piece, place)
        place += f"[{key}]" if isinstance(key, int) else f".{piece}" if place else str(piece)
        if k == len(pieces) - 1:
            _set(owner, key, value)
            return new
        inner = owner[key] if isinstance(owner, Mapping | list) else getattr(owner, key)
        if isinstance(inner, Sequence | np.ndarray) and not isinstance(inner, list | str):
            inner = list(inner)
        elif pieces[:k] == ["beam"] and key in OF_SPANS and not isinstance(inner, list):
            inner = [inner] * len(new.beam.spans)
        _set(owner, key, inner)
        owner = inner
    return new


def pieces_of(path: str) -> list[str | int]:
    """Give keys and numbers of a path as they are written.

    Parameters
    ----------
    path : str
        As in messages.

    Returns
    -------
    list of str or int

    Raises
    ------
    SceneError
        It is no path.

    Examples
    --------
    >>> pieces_of('supports "R-1".law[2][0]')
    ['supports', 'R-1', 'law', 2, 0]
    """
    pieces: list[str | int] = []
    at = 0
    for piece in PIECE.finditer(path):
        if piece.start() != at:
            break
        at = piece.end()
        text = unquoted(piece["quoted"] or "") if piece["bare"] is None else piece["bare"].strip()
        pieces.append(int(piece["index"]) if piece["index"] else text)
    if at != len(path) or not pieces:
        raise SceneError(shown(path), 'is no key path of a scene; such are "supports[2].gap" and "beam.EI"')
    return pieces


def unquoted(text: str) -> str:
    r"""Read what stands between quotation marks, as `shown` writes it; by hand a backslash may stand there alone.

    Parameters
    ----------
    text : str
        Without the quotation marks.

    Examples
    --------
    >>> unquoted(r'the \"hot\" leg'), unquoted(r"C:\piers")
    ('the "hot" leg', 'C:\\piers')
    """
    try:
        return json.loads(f'"{text}"', strict=False)
    except ValueError:
        return text


def _set(owner: Any, key: str | int, value: Any) -> None:
    if isinstance(owner, Mapping | list):
        owner[key] = value
    else:
        setattr(owner, key, value)


def _key(owner: Any, piece: str | int, place: str) -> str | int:
    """Find a piece of a path: attribute of a struct, key of a dict, number in a list."""
    if isinstance(owner, list):
        names = [getattr(one, "name", None) for one in owner]
        k = names.index(piece) if piece in names else piece
        if isinstance(k, int) and -len(owner) <= k < len(owner):
            return k % len(owner)
        known = [shown(name) for name in names if name is not None]
        there = f"there are {len(owner)}" + (f", by name {few(known)}" if known else "")
        raise SceneError(place, f"there is no entry {shown(piece)}; {there}")
    if isinstance(owner, Mapping):
        return piece
    if not isinstance(owner, msgspec.Struct):
        raise SceneError(place, f"is {shown(owner)}, so that there is no {shown(piece)} in it")
    keys = {field.encode_name: field.name for field in msgspec.structs.fields(owner)}
    if piece not in keys:
        near = nearest(str(piece), keys)
        hint = f"; did you mean {shown(near)}?" if near else f"; the keys are {', '.join(keys)}"
        raise SceneError(f"{place}.{piece}".lstrip("."), f"unknown key{hint}")
    return keys[piece]
