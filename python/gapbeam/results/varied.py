"""Numbers of supports that differ from case to case, checked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import msgspec
import numpy as np
from numpy.typing import ArrayLike

from ..base.errors import SceneError
from ..engine.arrays import Columns
from ..scene.names import find, names_in_errors
from ..scene.structs import Scene
from ..scene.wording import key_of
from .arguments import numbers

Given = Mapping[str | int, ArrayLike] | ArrayLike | None
"""An array of cases by supports, or of supports; or by name or number of supports a number, or one for every case."""
KEYS = ("settlement", "gap", "stiffness")
"""What may vary, as GBCASE takes it."""


def base_values(columns: Columns) -> np.ndarray:
    """Take settlement, gap and stiffness of the supports of a scene.

    Parameters
    ----------
    columns : Columns
        Of the scene.

    Returns
    -------
    numpy.ndarray
        Supports by `KEYS`, and one row more.
    """
    return columns.support[[3, 2, 1]].T.copy()


def cases_in(given: Mapping[str, Given]) -> int | None:
    """Count the cases for which numbers are given.

    Parameters
    ----------
    given : mapping
        What is given, by keys of a support.

    Returns
    -------
    int or None
        None where there are no numbers case by case.
    """
    for key, values in given.items():
        columns = values.values() if isinstance(values, Mapping) else ()
        for column in columns:
            if np.ndim(numbers(key, column)) == 1:
                return len(np.asarray(column))
        if not (values is None or isinstance(values, Mapping)) and np.ndim(numbers(key, values)) == 2:
            return len(np.asarray(values))
    return None


def vary_supports(scene: Scene, columns: Columns, given: Mapping[str, Given], count: int) -> np.ndarray | None:
    """Put the numbers of every case together.

    Parameters
    ----------
    scene : Scene
        The scene.
    columns : Columns
        Its columns.
    given : mapping
        Of `KEYS`, what is given instead of the scene's numbers.
    count : int
        Cases.

    Returns
    -------
    numpy.ndarray or None
        Cases by supports (and one more) by `KEYS`; None where nothing is given.

    Raises
    ------
    ValueError
        Arrays of another shape.
    SceneError
        A support that is not there, or a number that makes no sense for one: names the case and the support.
    """
    if all(values is None for values in given.values()):
        return None
    m = len(scene.supports)
    all_values = np.broadcast_to(base_values(columns), (count, m + 1, len(KEYS))).copy()
    for j, key in enumerate(KEYS):
        values = given.get(key)
        if values is None:
            continue
        which: Any = slice(0, m)
        if isinstance(values, Mapping):
            which = []
            for name, column in values.items():
                place = f"{key}.{key_of(name)}"
                k = find(scene.supports, name, place, "support")
                which.append(k)
                all_values[:, k, j] = _shaped(place, column, (count,), f"a number, or {count}, one a case")
            if len(set(which)) < len(which):
                raise SceneError(key, "a support stands there twice, by its name and by its number")
        else:
            expected = f"{m} numbers, one for each support, or {count} {'row' if count == 1 else 'rows'} of them, one a case"
            all_values[:, :m, j] = _shaped(key, values, (count, m), expected)
        with names_in_errors(scene):
            _check(columns, key, np.arange(m)[which], all_values[:, :, j])
    return all_values


def _shaped(place: str, given: ArrayLike, shape: tuple[int, ...], expected: str) -> np.ndarray:
    values = numbers(place, given)
    if values.shape not in (shape, shape[1:]):
        raise ValueError(f"{place}: expected {expected}; got shape {values.shape}")
    return values


def _check(columns: Columns, key: str, which: np.ndarray, values: np.ndarray) -> None:
    """Refuse what no support, or not this one, can have; the scene's own number is always right."""
    found, base = values[:, which], base_values(columns)[which, KEYS.index(key)]
    for wrong, problem in _mistakes(columns, key, which, found):
        bad = wrong & (found != base)
        if bad.any():
            case, at = np.argwhere(bad)[0].tolist()
            raise SceneError(f"case {case}, supports[{which[at]}].{key}", f"{problem}; got {found[case, at]:.15g}")


def _mistakes(columns: Columns, key: str, which: np.ndarray, found: np.ndarray) -> list[tuple[np.ndarray, str]]:
    side, direction = columns.support_codes[:2, which]
    with_law = np.isin(which + 1, columns.law_supports[:-1])
    if key == "stiffness":
        idle = (side != 0) & ~(columns.support[1, which] > 0.0)
        return [
            (~(found > 0.0), "expected a number above 0, inf is rigid (without a support prepare a scene of its own)"),
            ((found > 0.0) & with_law, "it has a law instead of a stiffness; leave it out"),
            ((found > 0.0) & idle, "the prepared scene has stiffness = 0 here, a support that never acts; prepare it with another"),
        ]
    mistakes = [(~np.isfinite(found), "expected a finite number")]
    if key == "gap":
        two_sided = (side == 0) & ~with_law
        mistakes += [
            ((direction != 0) & (found != 0.0), "an axial support has no gap"),
            (two_sided & (found != 0.0), 'only a support with side = "below" or "above" has a gap'),
        ]
    return mistakes


def replace_supports(scene: Scene, columns: Columns, values: np.ndarray) -> tuple[Scene, Columns]:
    """Make the scene of one case.

    Parameters
    ----------
    scene, columns
        The scene; left as it is.
    values : numpy.ndarray
        Supports (and one more) by `KEYS`.

    Returns
    -------
    scene : Scene
        The same with other supports.
    columns : Columns
        Its columns.
    """
    base = base_values(columns)
    changed = [
        msgspec.structs.replace(one, **dict(zip(KEYS, row, strict=True))) if row != old else one
        for one, row, old in zip(scene.supports, values[:-1].tolist(), base[:-1].tolist(), strict=True)
    ]
    support = columns.support.copy(order="F")
    support[[3, 2, 1], :-1] = values[:-1].T
    return msgspec.structs.replace(scene, supports=changed), replace(columns, support=support)
