"""Scenes from wherever they come, checked completely."""

from __future__ import annotations

import os
from collections.abc import Mapping
from contextlib import suppress
from math import isfinite
from operator import attrgetter
from pathlib import Path
from typing import Any

from ..base.errors import EngineError, SceneError
from ..engine.arrays import Columns
from ..engine.beam import Beam, Curve, RefusalError
from .columns import columns, curves
from .combinations import plan_combinations
from .files import Written, read_file
from .ground_laws import NO_POWER, NOT_FOR_GROUND, LawAt, PowerGround
from .ground_tables import is_table, least_and_most, settled
from .limits import check_limits
from .mistakes import all_mistakes
from .names import check_names, in_written_places, names_in_errors
from .refusals import refusal
from .rotations import spread_rotations
from .structs import Scene
from .tables import Table, take_arrays, take_tables
from .trains import check_trains
from .typed import typed
from .wording import number, shown

LARGEST_FACTOR = 1e100
"""Of a history: with greater ones loads leave the range of doubles, and which factor does it is not known there."""


def read_scene(source: Scene | Mapping[str, Any] | str | os.PathLike) -> Scene:
    """Read a scene and check it completely: keys, types and meaning.

    Parameters
    ----------
    source : Scene, mapping, str or path
        A scene built in Python, its data as dicts and lists, or the path of a ``.toml`` or ``.json`` file.
        Numpy numbers and arrays are welcome in place of numbers and lists; lists of supports, foundations, loads and
        sections may be columns: arrays by key, a pandas DataFrame, a structured array, where a single value holds for every row.

    Returns
    -------
    Scene
        An independent copy; all its numbers are floats.

    Raises
    ------
    SceneError
        Names the place, the value and what was expected.

    Examples
    --------
    >>> try:
    ...     read_scene({"beam": {"spans": [6], "EI": 1e4}, "supports": [{"node": 0, "gap": "0,02"}]})
    ... except SceneError as error:
    ...     print(error)
    supports[0].gap: expected a number, got "0,02"
    """
    source = _opened(source)
    try:
        return _checked(source)
    except SceneError as error:
        if isinstance(source, Written):
            raise all_mistakes(source, error, _checked) from None
        raise


def read_beam(source: Scene | Mapping[str, Any] | str | os.PathLike) -> tuple[Scene, Beam]:
    """Read a scene and make its beam ready for solving.

    Parameters
    ----------
    source : Scene, mapping, str or path
        As for `read_scene`.

    Returns
    -------
    scene : Scene
        As from `read_scene`.
    beam : Beam
        Its beam.

    Raises
    ------
    SceneError
        As for `read_scene`.
    EngineError
        Numbers are beyond the range of doubles.
    """
    source = _opened(source)
    try:
        scene, written = _structured(source)
        with in_written_places(written):
            beam = prepared_beam(scene)
            if isinstance(source, Written):
                _plan(scene)
        return scene, beam
    except SceneError as error:
        if isinstance(source, Written):
            raise all_mistakes(source, error, _checked) from None
        raise


def read_written(source: Scene | Mapping[str, Any] | str | os.PathLike) -> tuple[Scene, Scene, Beam]:
    """Read a scene as it is written, and checked, and make its beam; a file is opened once.

    Parameters
    ----------
    source : Scene, mapping, str or path
        As for `read_scene`.

    Returns
    -------
    written : Scene
        From `as_written`.
    scene, beam
        From `read_beam`.

    Raises
    ------
    SceneError, EngineError
        As for `read_beam`.
    """
    source = _opened(source)
    scene, beam = read_beam(source)
    return as_written(source), scene, beam


def _opened(source: Any) -> Any:
    """Read a file where its name is given."""
    return read_file(Path(source)) if isinstance(source, str | os.PathLike) else source


def _checked(source: Scene | Mapping[str, Any]) -> Scene:
    """Check a scene completely."""
    scene, written = _structured(source)
    with in_written_places(written):
        with suppress(EngineError):  # it makes sense, though it cannot be solved in double precision
            prepared_beam(scene)
        _plan(scene)
    return scene


def _plan(scene: Scene) -> None:
    """Check the combinations, if there are any."""
    if scene.combinations:
        with names_in_errors(scene):
            plan_combinations(scene)


def beam_of(scene: Scene) -> Beam:
    """Make the beam of a scene.

    Parameters
    ----------
    scene : Scene
        Keys and types are right.

    Raises
    ------
    SceneError
        It makes no sense.
    """
    with names_in_errors(scene):
        taken = columns(scene)
    return beam_of_columns(scene, taken, curves(scene, taken))


def beam_of_columns(scene: Scene, taken: Columns, smooth: tuple[tuple[int, Curve], ...] = ()) -> Beam:
    """Make the beam of a scene whose numbers are taken already.

    Parameters
    ----------
    scene : Scene
        By whose places it is told what is wrong.
    taken : Columns
        Its numbers.
    smooth : tuple of (int, Curve)
        Its smooth laws.

    Raises
    ------
    SceneError
        It makes no sense.
    """
    with names_in_errors(scene):
        try:
            return Beam(taken, smooth)
        except RefusalError as refused:
            raise refusal(scene, *refused.codes) from None


def prepared_beam(scene: Scene) -> Beam:
    """Make the beam of a scene that is solved as it is.

    Parameters
    ----------
    scene : Scene
        As for `beam_of`.

    Raises
    ------
    SceneError
        It makes no sense, or its history needs to be followed.
    """
    beam = beam_of(scene)
    if scene.analysis.has_history and scene.analysis.follow == "steps":
        raise SceneError("analysis.history", 'a history needs follow = "events"')
    return beam


def as_written(source: Scene | Mapping[str, Any] | str | os.PathLike) -> Scene:
    """Read a scene of which only keys and types are checked, with rotations where they were written.

    Parameters
    ----------
    source : Scene, mapping, str or path
        As for `read_scene`, in whose scenes restraints and hinges that are more than a stiffness are supports of their own.

    Raises
    ------
    SceneError
        A key, type or name is wrong.
    """
    source = _opened(source)
    if isinstance(source, Written):
        source = dict(source)
    if not isinstance(source, Scene | Mapping):
        again = "; to solve it again, give its scene" if hasattr(source, "scene") else ""
        got = f"a {type(source).__name__}" if again else "None" if source is None else shown(source)
        raise SceneError(f"expected a Scene, a mapping or the path of a file, got {got}{again}")
    source, tables = take_tables(source)
    source, arrays = take_arrays(source)
    scene = typed(source, Scene)
    for key, table in tables.items():
        setattr(scene, key, table)
    for (i, key), array in arrays.items():
        setattr(scene.foundation[i], key, array)
    check_names(scene)
    with names_in_errors(scene):
        _settle_foundations(scene)
    return scene


def _structured(source: Scene | Mapping[str, Any]) -> tuple[Scene, dict[str, str]]:
    """A scene whose keys and types are right, and which asks for nothing that this version has not; where its supports stand."""
    scene = as_written(source)
    with names_in_errors(scene):
        _check_laws(scene)
        written = spread_rotations(scene)
        _check_foundations(scene)
    check_trains(scene)
    check_limits(scene.limits, scene.beam.width, bool(len(scene.foundation)))
    if scene.analysis.steps < 1:
        raise SceneError("analysis.steps", f"expected a whole number, 1 or more, got {shown(scene.analysis.steps)}")
    if scene.analysis.stretching:
        _check_stretching(scene)
    if not scene.analysis.history:
        raise SceneError("analysis.history", "has no load factor; give one at least, for example [1.0]")
    if scene.analysis.follow == "events" and not any(scene.analysis.history):
        problem = "has no load factor other than 0, so there is nothing to follow"
        raise SceneError("analysis.history", f"{problem}; give one, or for dead loads alone leave the others out")
    for i, factor in enumerate(scene.analysis.history):
        if not abs(factor) <= LARGEST_FACTOR:
            most = f" of at most {LARGEST_FACTOR:g}" if isfinite(factor) else ""
            raise SceneError(f"analysis.history[{i}]", f"expected a finite number{most}, got {number(factor)}")
    return scene, written


def _check_stretching(scene: Scene) -> None:
    """Refuse what there is no stretching beside, in this version."""
    asked = scene.analysis
    beside = {
        "first_order = true": asked.first_order, 'follow = "events"': asked.follow == "events", "history": asked.has_history,
        "at_limit": asked.at_limit != "stop", "trains": bool(scene.trains),
    }  # fmt: skip
    for what, is_there in beside.items():
        if is_there:
            problem = f"beside {what} it is not available in this version; leave one of both out, or give steps"
            raise SceneError("analysis.stretching", problem)


def _check_laws(scene: Scene) -> None:
    """Refuse what the columns of a law would not show any more."""
    if isinstance(scene.supports, Table):
        return
    laws = list(map(attrgetter("law"), scene.supports))
    if laws.count(None) == len(laws):
        return
    for i, (support, law) in enumerate(zip(scene.supports, laws, strict=True)):
        if law is None:
            continue
        if support.stiffness != float("inf"):
            raise SceneError(f"supports[{i}]", "has both stiffness and law; give one of the two")
        if isinstance(law, list) and not law:
            raise SceneError(f"supports[{i}].law", "has no point; give (displacement past the gap, force)")


def _polylines(law: list[Any], place: str) -> list[tuple[str, list[Any]]]:
    """The polylines of a law, one or one for every place, and where they stand."""
    with_places = [isinstance(one, LawAt) for one in law]
    if not any(with_places):
        return [(place, law)]
    if not all(with_places):
        raise SceneError(place, "expected pairs of numbers, or tables with x and points, got some of both")
    for k, one in enumerate(law):
        if not isfinite(one.x):
            raise SceneError(f"{place}[{k}].x", f"expected a finite number, got {number(one.x)}")
        if k and one.x == law[k - 1].x:
            problem = f"there is a law at x = {number(one.x)} already; leave one out, or give a step two places"
            raise SceneError(f"{place}[{k}].x", problem)
    return [(f"{place}[{k}].points", one.points) for k, one in enumerate(law)]


def _check_power(law: PowerGround, place: str) -> None:
    """Refuse exponents that are not available, and what the cubic made of it would not show any more."""
    if law.n not in (1.0, 2.0, 3.0):
        raise SceneError(f"{place}.n", f"expected 1, 2 or 3, got {number(law.n)}: {NO_POWER}")
    if not law.d0 > 0.0:
        raise SceneError(f"{place}.d0", f"expected a number above 0, got {number(law.d0)}")
    least, most = least_and_most(law.limit)
    if least < 0.0:
        raise SceneError(f"{place}.limit", f"expected numbers of 0 or more, got {number(least)}")
    if not most > 0.0:
        raise SceneError(f"{place}.limit", "is 0 everywhere, so it never carries; remove the foundation")


def _settle_foundations(scene: Scene) -> None:
    """Tell pairs from tables."""
    if isinstance(scene.foundation, Table):
        return
    for i, foundation in enumerate(scene.foundation):
        foundation.k = settled(foundation.k, f"foundation[{i}].k")
        law = foundation.law
        for key in () if law is None or isinstance(law, list) or type(law) in NOT_FOR_GROUND else law.__struct_fields__:
            setattr(law, key, settled(getattr(law, key), f"foundation[{i}].law.{key}"))


def _check_foundations(scene: Scene) -> None:
    """Refuse what the columns of a foundation would not show any more, and laws that are not available."""
    if isinstance(scene.foundation, Table):
        return
    for i, foundation in enumerate(scene.foundation):
        place, law = f"foundation[{i}]", foundation.law
        if foundation.k is None and law is None:
            raise SceneError(f"{place}.k", "this key is missing; give a number")
        if foundation.k is not None and law is not None:
            raise SceneError(place, "has both k and law; give one of the two")
        if foundation.profile is not None and not len(foundation.profile):
            raise SceneError(f"{place}.profile", "has no point; give (x, gap)")
        if isinstance(law, list):
            for key, points in _polylines(law, f"{place}.law"):
                if not points:
                    raise SceneError(key, "has no point; give (displacement past the gap, force per length)")
        elif problem := NOT_FOR_GROUND.get(type(law)):
            raise SceneError(f"{place}.law", problem)
        elif law is not None:
            for key in law.__struct_fields__:
                given = getattr(law, key)
                for value in () if is_table(given) else given if isinstance(given, tuple) else (given,):
                    if not isfinite(value):
                        raise SceneError(f"{place}.law.{key}", f"expected finite numbers, got {number(value)}")
            if isinstance(law, PowerGround):
                _check_power(law, f"{place}.law")
