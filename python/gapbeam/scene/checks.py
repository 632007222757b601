"""Checks of scenes: are keys and types right, does every value make sense.

Whatever is wrong raises a `SceneError` that names the place, the value and what was expected. The checks look
at whole columns of numbers at once; only where one fails is the message composed for the row that failed.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from numbers import Real
from operator import attrgetter
from typing import TYPE_CHECKING, Any, TypeVar

import msgspec
import numpy as np

from ..base.characters import visible
from ..base.errors import SceneError
from .places import POSITION_TOLERANCE, same_place
from .wording import as_text, explain, number, shown

if TYPE_CHECKING:
    from .structs import Scene, Support

S = TypeVar("S", bound=msgspec.Struct)

TOO_DEEP = "tables or lists are nested too deeply"


def typed(source: S | Mapping[str, Any], struct: type[S]) -> S:
    """Turn data into a struct whose keys and types are right, all through.

    Parameters
    ----------
    source : struct or mapping
        Structs built in Python hold whatever they were given, so they are checked like any other data. Numpy
        numbers and arrays may stand for numbers and lists.
    struct : type
        The struct to make.

    Returns
    -------
    struct
        Independent of `source`.
    """
    try:
        if isinstance(source, struct):
            return msgspec.msgpack.decode(msgspec.msgpack.encode(source, enc_hook=_simple), type=struct)
        if not _has_structs(source):
            return msgspec.convert(source, struct)
    except (msgspec.ValidationError, OverflowError, RecursionError, TypeError, UnicodeEncodeError):
        pass  # once more, slowly: to word the message, or to take numpy numbers and what UTF-8 does not know
    try:
        data = msgspec.to_builtins(source, enc_hook=_simple, str_keys=False)
        try:
            return msgspec.convert(data, struct)
        except UnicodeEncodeError:  # titles and labels may hold halves of characters; this is a key or a choice
            data = _written_out(data)
            return msgspec.convert(data, struct)
    except msgspec.ValidationError as error:
        raise explain(error, data, struct) from None
    except RecursionError:
        raise SceneError("the scene", TOO_DEEP) from None


def plain(struct: msgspec.Struct) -> dict[str, Any]:
    """Give a struct, whatever it holds, as dicts, lists and numbers.

    Parameters
    ----------
    struct : Struct
        As built in Python.

    Returns
    -------
    dict
        By its keys.
    """
    return msgspec.msgpack.decode(msgspec.msgpack.encode(struct, enc_hook=_simple), strict=False)


def _simple(value: Any) -> Any:
    """Numbers and lists for what stands for them; anything else as its text, to be refused as such."""
    if isinstance(value, np.ma.MaskedArray):
        value = value.astype(object).filled("masked")  # numpy's null would mean that the key is left out
    if hasattr(value, "tolist"):
        listed = value.tolist()
        if type(listed) is not type(value):
            return listed
        return f"{value} ({type(value).__name__}; take float() of it)"  # more digits than a double holds
    if isinstance(value, Mapping):
        return dict(value)
    with suppress(OverflowError):
        if isinstance(value, Real):
            return float(value)
    return as_text(value)


def _written_out(data: Any) -> Any:
    """All texts of plain data without halves of characters."""
    if isinstance(data, dict):
        return {_written_out(key): _written_out(value) for key, value in data.items()}
    if isinstance(data, list):
        return [_written_out(item) for item in data]
    return visible(data) if isinstance(data, str) else data


def _has_structs(data: Mapping[str, Any]) -> bool:
    """Whether structs stand among the data; msgspec would take them unchecked."""
    kinds = set(map(type, data.values()))
    for value in data.values():
        if isinstance(value, list | tuple):
            kinds.update(map(type, value))
    return any(issubclass(kind, msgspec.Struct) for kind in kinds)


def check(scene: Scene) -> None:
    """Refuse a scene that makes no sense.

    Parameters
    ----------
    scene : Scene
        Keys and types are right already.

    Raises
    ------
    SceneError
        Of several errors the first one found.
    """
    ends = _check_spans(scene)
    _check_beam(scene, ends)
    sections = Rows("sections", scene.sections)
    sections.stretch(ends)
    idle = np.ones(len(scene.sections), dtype=bool)
    for key in ("EI", "GA", "EA"):
        values = sections.column(key)
        sections.refuse(values <= 0, key, "a number above 0 (inf = rigid)")
        idle &= np.isnan(values)
    sections.refuse_first(idle, "", "changes nothing; give EI, GA or EA")
    _check_supports(scene, ends)
    if scene.foundation:
        raise SceneError(
            "foundation[0]", "foundations are not available in this version; use elastic supports"
        )
    _check_loads(scene, ends)
    if scene.analysis.steps < 1:
        raise SceneError("analysis.steps", f"expected a whole number, 1 or more, got {shown(scene.analysis.steps)}")


class Rows:
    """Equal structs of a scene, their numbers by column.

    Parameters
    ----------
    name : str
        Key of the list in the scene.
    items : sequence of Struct
        The structs.
    index : sequence of int, optional
        Place of each in that list.
    """

    def __init__(self, name: str, items: Sequence[Any], index: Sequence[int] | None = None) -> None:
        self.name, self.items = name, items
        self.index = range(len(items)) if index is None else index

    def path(self, row: int, key: str = "") -> str:
        """Path of a row, or of one key in it."""
        return f"{self.name}[{self.index[row]}]" + (f".{key}" if key else "")

    def column(self, key: str, finite: bool = False) -> np.ndarray:
        """Numbers of one key, nan where there is none; a nan (or, if asked, inf) of the user is refused."""
        values = list(map(attrgetter("from_" if key == "from" else key), self.items))
        if not values or (values[0] is None and values.count(None) == len(values)):
            return np.full(len(values), np.nan)
        try:
            numbers = np.fromiter(values, float if np.isscalar(values[0] or 0.0) else (float, 2), len(values))
        except OverflowError:  # msgspec minds integers that are too large, but not those far below 0
            row = next(row for row, value in enumerate(values) if isinstance(value, int) and value < -(2**31))
            raise SceneError(self.path(row, key), f"expected a whole number, got {shown(values[row])}") from None
        wrong = ~np.isfinite(numbers) if finite else np.isnan(numbers)
        bad = np.flatnonzero(wrong if wrong.ndim == 1 else wrong.any(axis=1))
        if bad.size and bad.size > values.count(None):
            row = next(row for row in bad.tolist() if values[row] is not None)
            kind = "finite numbers" if numbers.ndim > 1 else "a finite number" if finite else "a number"
            raise SceneError(self.path(row, key), f"expected {kind}, got {shown(values[row])}")
        return numbers

    def refuse(self, wrong: np.ndarray, key: str, expected: str) -> None:
        """Refuse the first row whose value is wrong."""
        if wrong.any():
            row = int(np.argmax(wrong))
            value = shown(getattr(self.items[row], key))
            raise SceneError(self.path(row, key), f"expected {expected}, got {value}")

    def refuse_first(self, wrong: np.ndarray, key: str, problem: str) -> None:
        """Refuse the first row that is wrong, whatever its value."""
        if wrong.any():
            raise SceneError(self.path(int(np.argmax(wrong)), key), problem)

    def points(self, ends: np.ndarray) -> None:
        """Check places by node or x."""
        x, node = self.column("x"), self.column("node")
        wrong = np.isnan(x) == np.isnan(node)
        if wrong.any():
            row = int(np.argmax(wrong))
            if np.isnan(x[row]):
                raise SceneError(self.path(row), "its place is missing; give node or x")
            both = f"node = {number(node[row])} and x = {number(x[row])}"
            raise SceneError(self.path(row), f"has both {both}; give one of the two")
        wrong = (node < 0) | (node >= len(ends))
        if wrong.any():
            row = int(np.argmax(wrong))
            nodes = f"the nodes of the beam are 0 to {len(ends) - 1}"
            raise SceneError(self.path(row, "node"), f"there is no node {number(node[row])}; {nodes}")
        self.inside(x, "x", ends)

    def inside(self, x: np.ndarray, key: str, ends: np.ndarray) -> None:
        """Refuse what lies off the beam by more than rounding."""
        slack = POSITION_TOLERANCE * ends[-1]
        wrong = (x < -slack) | (x > ends[-1] + slack)
        if wrong.any():
            row = int(np.argmax(wrong))
            raise SceneError(self.path(row, key), _outside(x[row], ends))

    def stretch(self, ends: np.ndarray) -> None:
        """Check that from and to are on the beam."""
        for key in ("from", "to"):
            self.inside(self.column(key), key, ends)


def _outside(x: float, ends: np.ndarray) -> str:
    return f"{number(x)} is outside the beam, which runs from x = 0 to x = {number(ends[-1])}"


def _check_spans(scene: Scene) -> np.ndarray:
    """Check the spans; return their ends."""
    spans = np.array(scene.beam.spans, dtype=float)
    if not spans.size:
        raise SceneError("beam.spans", "the beam has no span; give at least one length, for example [6.0]")
    wrong = ~(np.isfinite(spans) & (spans > 0))
    with np.errstate(over="ignore", invalid="ignore"):
        ends = scene.span_ends()
    if wrong.any():
        i = int(np.argmax(wrong))
        if not np.isfinite(spans[i]):
            raise SceneError(f"beam.spans[{i}]", f"expected a finite length above 0, got {number(spans[i])}")
        begin, end = number(ends[i]), number(ends[i] + spans[i])
        stretch = f"the span from x = {begin} to x = {end} has length {number(spans[i])}"
        raise SceneError(f"beam.spans[{i}]", f"{stretch}; give a length above 0 or remove it")
    if not np.isfinite(ends[-1]):
        raise SceneError("beam.spans", "the beam is too long for the range of numbers")
    wrong = same_place(ends[1:], ends[:-1])
    if wrong.any():
        i = int(np.argmax(wrong))
        lost = f"a length of {number(spans[i])} is lost in rounding at x = {number(ends[i])}"
        raise SceneError(f"beam.spans[{i}]", f"{lost}; give a greater length or remove it")
    return ends


def _check_beam(scene: Scene, ends: np.ndarray) -> None:
    """Check stiffnesses and hinges."""
    beam = scene.beam
    for key in ("EI", "GA", "EA"):
        value = getattr(beam, key)
        values = np.array(value, dtype=float)
        if values.ndim and len(values) != len(beam.spans):
            count = f"has {len(values)} values for {len(beam.spans)} spans"
            raise SceneError(f"beam.{key}", f"{count}; give one number, or one per span")
        wrong = ~(np.atleast_1d(values) > 0)
        if wrong.any():
            i = int(np.argmax(wrong))
            place = f"beam.{key}" + (f"[{i}]" if values.ndim else "")
            got = number(np.atleast_1d(values)[i])
            raise SceneError(place, f"expected a number above 0 (inf = rigid), got {got}")
    x = np.array(beam.hinges, dtype=float)
    slack = POSITION_TOLERANCE * ends[-1]
    for i in np.flatnonzero(~((x > slack) & (x < ends[-1] - slack)))[:1]:
        problem = _outside(x[i], ends)
        if np.isnan(x[i]):
            problem = "expected a number, got nan"
        elif -slack <= x[i] <= ends[-1] + slack:
            problem = f"x = {number(x[i])} is an end of the beam, where no hinge can be; remove it"
        raise SceneError(f"beam.hinges[{i}]", problem)


def _check_supports(scene: Scene, ends: np.ndarray) -> None:
    """Check supports, each alone."""
    rows = Rows("supports", scene.supports)
    items = rows.items
    rows.points(ends)
    stiffness = rows.column("stiffness")
    rows.refuse(stiffness < 0, "stiffness", "a number, 0 or more (inf = rigid)")
    gap = rows.column("gap", finite=True)
    rows.column("settlement", finite=True)
    turn = rotational_stiffnesses(items)
    rows.refuse(~(turn >= 0), "rotation", '"free", "fixed" or a number, 0 or more')
    bilateral = np.array([item.side == "both" for item in items], dtype=bool)
    axial = np.array([item.direction == "axial" for item in items], dtype=bool)

    law = np.array([item.law is not None for item in items], dtype=bool)
    for wrong, key, problem in (
        (axial & ~bilateral, "side", 'an axial support holds on both sides; use side = "both"'),
        (axial & (gap != 0), "gap", "an axial support has no gap; remove it"),
        (
            axial & (turn != 0),
            "rotation",
            "an axial support holds no rotation; a normal one here can do that",
        ),
        (bilateral & (gap != 0), "gap", 'only a support with side = "below" or "above" has a gap'),
        (law & (stiffness != np.inf), "", "has both stiffness and law; give one of the two"),
        (law, "law", "piecewise linear laws are not available in this version; give stiffness instead"),
    ):
        rows.refuse_first(wrong, key, problem)


def _check_loads(scene: Scene, ends: np.ndarray) -> None:
    """Check loads, kind by kind."""
    kinds: dict[str, list[int]] = {}
    for i, load in enumerate(scene.loads):
        kinds.setdefault(load.__struct_config__.tag, []).append(i)
    for kind, index in kinds.items():
        rows = Rows("loads", [scene.loads[i] for i in index], index)
        if kind in ("force", "moment", "axial"):
            rows.points(ends)
        else:
            rows.stretch(ends)
        rows.column(_VALUE[kind], finite=True)
        if kind == "axial" and not any(support.direction == "axial" for support in scene.supports):
            problem = 'nothing holds the beam horizontally; give a support direction = "axial"'
            raise SceneError(rows.path(0), problem)


def rotational_stiffnesses(supports: Sequence[Support]) -> np.ndarray:
    """Collect the stiffnesses of rotational restraints.

    Parameters
    ----------
    supports : sequence of Support
        Supports of a scene.

    Returns
    -------
    numpy.ndarray
        Of each (force*length/rad): 0 free, inf fixed.
    """
    return np.array([_ROTATION.get(support.rotation, support.rotation) for support in supports], dtype=float)


_ROTATION = {"free": 0.0, "fixed": np.inf}


def contact_levels(supports: Sequence[Support]) -> np.ndarray:
    """Collect the deflections at which supports begin to act.

    Parameters
    ----------
    supports : sequence of Support
        Supports of a scene.

    Returns
    -------
    numpy.ndarray
        Of each (length, positive downward): settlement + gap (below), settlement - gap (above), settlement (both).
    """
    settlement, gap = (np.array(list(map(attrgetter(key), supports)), dtype=float) for key in ("settlement", "gap"))
    with np.errstate(over="ignore"):  # inf is refused with the other numbers that leave the range
        return settlement + np.array([SIDES[support.side] for support in supports], dtype=float) * gap


SIDES = {"both": 0, "below": 1, "above": -1}
"""Sides of a support, as in gapbeam_model."""

_VALUE = {"force": "F", "moment": "M", "axial": "F", "uniform": "q", "linear": "q", "curvature": "kappa"}
