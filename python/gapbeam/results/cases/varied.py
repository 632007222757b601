"""Numbers of supports, spans and foundations that differ from case to case, checked."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite
from types import SimpleNamespace
from typing import Any

import msgspec
import numpy as np
from numpy.typing import ArrayLike

from ...base.errors import SceneError
from ...engine.arrays import Columns
from ...engine.combinations import Varied
from ...engine.layout import AXIAL
from ...scene.names import find, names_in_errors
from ...scene.structs import Scene
from ...scene.wording import key_of
from ..state.arguments import numbers

Given = Mapping[str | int, ArrayLike] | ArrayLike | None
"""An array of cases by supports, or of supports; or by name or number of supports a number, or one for every case. So of spans and
foundations."""
OF_SUPPORTS = ("settlement", "gap", "stiffness")
"""What may vary of supports, as GBCASE takes it."""
OF_SPANS = ("EI", "GA")
"""And of spans, as GBCOMB takes it; of foundations it is k."""
KEYS = (*OF_SUPPORTS, *OF_SPANS, "k")
NOTHING = Varied()
"""Where all is as in the scene."""


def base_values(columns: Columns) -> np.ndarray:
    """Take settlement, gap and stiffness of the supports of a scene.

    Parameters
    ----------
    columns : Columns
        Of the scene.

    Returns
    -------
    numpy.ndarray
        Supports by `OF_SUPPORTS`, and one row more.
    """
    return columns.support[[3, 2, 1]].T.copy()


def cases_in(given: Mapping[str, Given]) -> int | None:
    """Count the cases for which numbers are given.

    Parameters
    ----------
    given : mapping
        What is given, by `KEYS`.

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


def vary(scene: Scene, columns: Columns, given: Mapping[str, Given], count: int) -> Varied:
    """Put the numbers of every case together.

    Parameters
    ----------
    scene : Scene
    columns : Columns
        Its columns.
    given : mapping
        By `KEYS`, what is given instead of the scene's numbers.
    count : int
        Cases.

    Raises
    ------
    ValueError
        Arrays of another shape.
    SceneError
        A support, span or foundation that is not there, or a number that makes no sense for one: names the case and the place.
    """
    given = {key: values for key, values in given.items() if values is not None}
    if not given:
        return NOTHING
    supports = spans = moduli = None
    with names_in_errors(scene):
        for key, values in given.items():
            if key in OF_SUPPORTS:
                if supports is None:
                    supports = np.broadcast_to(base_values(columns), (count, len(scene.supports) + 1, 3)).copy()
                of_key = supports[:, :, OF_SUPPORTS.index(key)]
                which = _take(key, values, scene.supports, "support", of_key)
                if not (isinstance(values, np.ndarray) and _are_right(columns, key, values)):
                    _check_supports(columns, key, which, of_key)
            elif key in OF_SPANS:
                if spans is None:
                    spans = np.broadcast_to(columns.span[[1, 2]].T, (count, columns.span.shape[1], 2)).copy()
                of_key = spans[:, :, OF_SPANS.index(key)]
                which = _take(key, values, [SimpleNamespace(name=None)] * len(scene.beam.spans), "span", of_key)
                if not (of_key[:, :-1] > 0.0).all():  # the scene's own are
                    found, places = of_key[:, which], [f"beam.{key}[{k}]" for k in which]
                    _refuse(~(found > 0.0), found, places, "expected a number above 0, inf is rigid")
            else:
                moduli = np.full((count, len(scene.foundation) + 1), -1.0)
                _check_moduli(columns, _take(key, values, scene.foundation, "foundation", moduli), moduli)
    return Varied(supports, spans, moduli)


def _take(key: str, given: Given, items: Sequence[Any], noun: str, values: np.ndarray) -> list[int]:
    """Put what is given into its columns of `values`, cases by items (and one more), and say which these are."""
    count, m = values.shape[0], values.shape[1] - 1
    if not isinstance(given, Mapping):
        expected = f"{m} numbers, one for each {noun}, or {count} {'row' if count == 1 else 'rows'} of them, one a case"
        values[:, :m] = _shaped(key, given, (count, m), expected)
        return list(range(m))
    which = []
    for name, column in given.items():
        place = f"{key}.{key_of(name)}"
        k = find(items, name, place, noun)
        which.append(k)
        values[:, k] = _shaped(place, column, (count,), f"a number, or {count}, one a case")
    if len(set(which)) < len(which):
        raise SceneError(key, f"a {noun} stands there twice, by its name and by its number")
    return which


def _shaped(place: str, given: ArrayLike, shape: tuple[int, ...], expected: str) -> np.ndarray:
    values = numbers(place, given)
    if values.shape not in (shape, shape[1:]):
        raise ValueError(f"{place}: expected {expected}; got shape {values.shape}")
    return values


def _refuse(wrong: np.ndarray, found: np.ndarray, places: Sequence[str], problem: str) -> None:
    """Refuse the first number that is wrong, cases by places."""
    if wrong.any():
        case, at = np.argwhere(wrong)[0].tolist()
        raise SceneError(f"case {case}, {places[at]}", f"{problem}; got {found[case, at]:.15g}")


def _check_supports(columns: Columns, key: str, which: list[int], values: np.ndarray) -> None:
    """Refuse what no support, or not this one, can have; the scene's own number is always right."""
    found, base = values[:, which], base_values(columns)[which, OF_SUPPORTS.index(key)]
    for wrong, problem in _mistakes(columns, key, np.array(which, dtype=int), found):
        bad = wrong & (found != base)
        if bad.any():
            _refuse(bad, found, [f"supports[{k}].{key}" for k in which], problem)


def _are_right(columns: Columns, key: str, values: np.ndarray) -> bool:
    """Whether the numbers of all supports, in one array, are right at a glance, as nearly always."""
    which = _staying(columns)[OF_SUPPORTS.index(key)]
    with np.errstate(over="ignore", invalid="ignore"):
        fine = (values > 0.0).all() if key == "stiffness" else isfinite(np.add.reduce(values, None))
    return bool(fine and (values[..., which] == base_values(columns)[which, OF_SUPPORTS.index(key)]).all())


def _staying(columns: Columns) -> tuple[np.ndarray, ...]:
    """Supports that mostly have the scene's own number in all cases, by `OF_SUPPORTS`."""
    side, direction = columns.support_codes[:2, :-1]
    with_law = np.isin(np.arange(len(side)), columns.with_laws())
    idle = with_law | ~(columns.support[1, :-1] > 0.0)
    return np.zeros(0, int), np.flatnonzero((side == 0) | (direction == AXIAL)), np.flatnonzero(idle)


def _mistakes(columns: Columns, key: str, which: np.ndarray, found: np.ndarray) -> list[tuple[np.ndarray, str]]:
    side, direction = columns.support_codes[:2, which]
    with_law = np.isin(which, columns.with_laws())
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
            ((direction == AXIAL) & (found != 0.0), "an axial support has no gap"),
            (two_sided & (found != 0.0), 'only a support with side = "below" or "above" has a gap'),
        ]
    return mistakes


def _check_moduli(columns: Columns, which: list[int], values: np.ndarray) -> None:
    """Refuse what is no modulus, and foundations that have none, or two."""
    found, places = values[:, which], [f"foundation[{k}].k" for k in which]
    at_ends = columns.foundation[2:4, which]
    _refuse(~((found > 0.0) & np.isfinite(found)), found, places, "expected a finite number above 0")
    with_table = np.broadcast_to(np.isin(which, columns.of_tables(1)[0]), found.shape)
    _refuse(with_table, found, places, "the prepared scene has a table here, which stays; prepare it with one number")
    with_law = np.broadcast_to(~(at_ends > 0.0).any(axis=0), found.shape)
    _refuse(with_law, found, places, "it has a law instead of a modulus; leave it out")
    pairs = np.broadcast_to(at_ends[0] != at_ends[1], found.shape)
    _refuse(pairs, found, places, "the prepared scene has a pair here, (at from, at to), which stays; prepare it with one number")


class SupportArrays:
    """Numbers of all supports for one case, given as arrays, and looked at as shortly as can be.

    Parameters
    ----------
    columns : Columns
        Of the scene.
    """

    def __init__(self, columns: Columns):
        self.base = base_values(columns)
        self.shape = (len(self.base) - 1,)
        self.stays = [(which, self.base[which, j].tolist()) for j, which in enumerate(_staying(columns))]

    def take(self, *given: Given) -> np.ndarray | None:
        """Put the numbers of a case together.

        Parameters
        ----------
        *given : numpy.ndarray or None
            By `OF_SUPPORTS`.

        Returns
        -------
        numpy.ndarray or None
            Supports (and one more) by `OF_SUPPORTS`; None where they are not given as arrays, or something is wrong: then `vary`
            takes them, or says what.
        """
        values = self.base.copy()
        for j, one in enumerate(given):
            if one is None:
                continue
            if type(one) is not np.ndarray or one.dtype != float or one.shape != self.shape:
                return None
            which, own = self.stays[j]
            fine = (one > 0.0).all() if j == 2 else isfinite(sum(one.tolist()))
            if not fine or one[which].tolist() != own:
                return None
            values[:-1, j] = one
        return values


def replace_numbers(scene: Scene, columns: Columns, varied: Varied) -> Scene:
    """Make the scene of one case.

    Parameters
    ----------
    scene, columns
        The scene and its columns; left as they are.
    varied : Varied
        Of one case.
    """
    changed: dict[str, Any] = {}
    if varied.supports is not None:
        values, base = varied.supports[0, :-1].tolist(), base_values(columns)[:-1].tolist()
        changed["supports"] = [
            msgspec.structs.replace(one, **dict(zip(OF_SUPPORTS, row, strict=True))) if row != old else one
            for one, row, old in zip(scene.supports, values, base, strict=True)
        ]
    if varied.spans is not None:
        rows = dict(zip(OF_SPANS, varied.spans[0, :-1].T.tolist(), strict=True))
        changed["beam"] = msgspec.structs.replace(scene.beam, **rows)
    if varied.moduli is not None:
        changed["foundation"] = [
            one if k < 0.0 else msgspec.structs.replace(one, k=k)
            for one, k in zip(scene.foundation, varied.moduli[0, :-1].tolist(), strict=True)
        ]
    return msgspec.structs.replace(scene, **changed)
