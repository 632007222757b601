"""Names of supports, loads and foundations: unique within their kind, and used wherever a number would be."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from operator import attrgetter
from typing import Any

import numpy as np

from ..base.characters import visible
from ..base.errors import EngineError, SceneError
from .structs import Scene
from .tables import Table
from .wording import enumerated, shown

NAMED = ("supports", "foundation", "loads", "combinations")
"""Lists of a scene whose entries may have names."""
DEAD = "dead"
"""The case that acts in full from the start."""


def names_of(items: Sequence[Any]) -> list[str | None]:
    """Give the names of supports, loads, foundations or combinations.

    Parameters
    ----------
    items : sequence
        A list of a scene.
    """
    return column_of(items, "name")


def name_data(item: Any) -> dict[str, str]:
    """Give the name of an entry of a scene as plain data, empty where it has none."""
    return {} if item.name is None else {"name": item.name}


def names_data(items: Sequence[Any]) -> list[dict[str, str]]:
    """Give the names of entries as plain data, each empty where there is none.

    Parameters
    ----------
    items : sequence
        A list of a scene.
    """
    return [{} if name is None else {"name": name} for name in names_of(items)]


def cases_of(items: Sequence[Any]) -> list[str]:
    """Give the cases of loads.

    Parameters
    ----------
    items : sequence of Load
        The loads of a scene.

    Returns
    -------
    list of str
        One for every load.
    """
    return column_of(items, "case")


def column_of(items: Sequence[Any], key: str) -> list[Any]:
    """Give one attribute of all entries, without making an object of each where they are columns.

    Parameters
    ----------
    items : sequence
        A list of a scene.
    key : str
        The attribute.
    """
    if not isinstance(items, Table):
        return list(map(attrgetter(key), items))
    column = items.column(key)
    return column.tolist() if isinstance(column, np.ndarray) else [column] * len(items)


def label(items: Sequence[Any], k: int) -> str:
    """Give the name of an entry, or its number where it has none.

    Parameters
    ----------
    items : sequence
        A list of a scene.
    k : int
        Which entry, from 0.

    Returns
    -------
    str
        For one line of text.
    """
    name = items[k].name
    return str(k) if name is None else visible(name)


def labels(items: Sequence[Any]) -> list[str]:
    """Give the names of all entries, or their numbers where they have none.

    Parameters
    ----------
    items : sequence
        A list of a scene.

    Returns
    -------
    list of str
        For one line of text.
    """
    return [str(k) if name is None else visible(name) for k, name in enumerate(names_of(items))]


def place_of(key: str, k: int, name: str | None) -> str:
    """Give the place of an entry, by its name where it has one.

    Parameters
    ----------
    key : str
        The list of the scene.
    k : int
        Which entry, from 0.
    name : str or None
        Its name.

    Examples
    --------
    >>> place_of("supports", 2, None), place_of("supports", 2, "R-104")
    ('supports[2]', 'supports "R-104"')
    """
    return f"{key}[{k}]" if name is None else f"{key} {shown(name)}"


def find(items: Sequence[Any], key: str | int, place: str, noun: str) -> int:
    """Find an entry by its name or by its number.

    Parameters
    ----------
    items : sequence
        A list of a scene.
    key : str or int
        Name, or number from 0 (in a file it is written as a text).
    place, noun : str
        Where the key stands, and what the entries are, for the error.

    Raises
    ------
    SceneError
        There is no such entry.
    """
    names = names_of(items)
    if isinstance(key, str) and key in names:  # None is no name
        return names.index(key)
    if isinstance(key, bool | np.bool_) or not isinstance(key, str | int | np.integer):
        raise SceneError(place, f"expected the name of a {noun}, or its number from 0, got {key!r}")
    if not isinstance(key, str) or re.fullmatch(r"\d{1,18}", key):
        if 0 <= int(key) < len(items):
            return int(key)
        there = f"their numbers go from 0 to {len(items) - 1}" if len(items) else "there are none"
        raise SceneError(place, f"there is no {noun} {key}; {there}")
    known = [shown(name) for name in names if name is not None]
    there = f"the names are {enumerated(known)}" if known else f"no {noun} has a name; give its number"
    raise SceneError(place, f"there is no {noun} {shown(key)}; {there}")


def check_names(scene: Scene) -> None:
    """Refuse names that stand twice or say nothing, and cases that are nearly ``dead``.

    Parameters
    ----------
    scene : Scene
        Keys and types are right.

    Raises
    ------
    SceneError
        Names the place.
    """
    for key in (*NAMED, "hinges"):
        # What a hinge holds is told among the supports
        beside = names_of(scene.supports) if key == "hinges" else ()
        seen = {name: f"supports[{k}]" for k, name in enumerate(beside) if name is not None}
        names = names_of(getattr(scene, key))
        if names.count(None) == len(names):
            continue
        for i, name in enumerate(names):
            if name is None:
                continue
            place = f"{key}[{i}].name"
            if not name.strip():
                raise SceneError(place, "is empty; give a name or leave it out")
            # What speaks of combinations does so by name; only where there is none is a text taken for a number
            if key != "combinations" and re.fullmatch(r"\s*\d+\s*", name):
                raise SceneError(place, f"{shown(name)} could be taken for a number; give a name with a letter in it")
            if name in seen:
                raise SceneError(place, f"{shown(name)} is the name of {seen[name]} already; give another one")
            seen[name] = f"{key}[{i}]"
    cases = cases_of(scene.loads)
    for case in dict.fromkeys(cases):
        place = f"loads[{cases.index(case)}].case"
        if not case.strip():
            raise SceneError(place, "is empty; give a name")
        if case != DEAD and case.strip().casefold() == DEAD:
            problem = f'{shown(case)} is nearly "dead", which acts in full from the start; write that, or another name'
            raise SceneError(place, problem)


@contextmanager
def names_in_errors(scene: Scene) -> Iterator[None]:
    """Put names for numbers into what is raised inside: ``supports "R-104".gap`` for ``supports[2].gap``.

    Parameters
    ----------
    scene : Scene
        Whose names they are.
    """
    try:
        yield
    except SceneError as error:
        place, problem = _named(scene, error.place), _named(scene, error.problem)
        if (place, problem) == (error.place, error.problem):
            raise
        raise SceneError(place, problem) from None
    except EngineError as error:
        text = _named(scene, str(error))
        if text == str(error):
            raise
        raise EngineError(text, error.status) from None


def _named(scene: Scene, text: str) -> str:
    def name(found: re.Match) -> str:
        items, k = getattr(scene, found[1]), int(found[2])
        given = items[k].name if k < len(items) else None
        return found[0] if found[3] == ".name" else f"{place_of(found[1], k, given)}{found[3]}"

    return re.sub(rf"\b({'|'.join(NAMED)})\[(\d+)\](\.name\b|)", name, text)


@contextmanager
def in_written_places(places: dict[str, str]) -> Iterator[None]:
    """Put places of a scene as it is written into what is raised inside.

    Parameters
    ----------
    places : dict
        By places of the scene as it is solved: from `spread_rotations`.
    """
    try:
        yield
    except SceneError as error:
        raise SceneError(_written(places, error.place), _written(places, error.problem)) from None


def _written(places: dict[str, str], text: str) -> str:
    if not places:
        return text

    def written(found: re.Match) -> str:
        place, key = places[found[1]], found[2]
        if key == ".at_hinge":
            return place.removesuffix(".rotation") + key
        return place + {".gap": ".slack", ".direction": ""}.get(key, key)

    return re.sub(rf"(?<![\w.])({'|'.join(map(re.escape, places))})(\.gap\b|\.direction\b|\.at_hinge\b|)", written, text)
