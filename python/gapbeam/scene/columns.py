"""A scene as columns of numbers, as the Fortran layer takes it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from operator import attrgetter
from typing import Any

import numpy as np
from msgspec import Struct

from ..base.errors import SceneError
from ..engine.arrays import GAP, MODULUS, Columns
from ..engine.beam import Curve
from ..engine.laws import PARAMETERS
from .axial_ground import AxialGround, with_ground
from .ground_laws import ground_parameters, parameter_tables, points_with_places
from .ground_tables import at_both_ends, is_table, points_of
from .laws import is_smooth
from .loads import (
    AxialLoad,
    AxialUniformLoad,
    CurvatureLoad,
    ForceLoad,
    LinearLoad,
    MomentLoad,
    MovementLoad,
    TemperatureLoad,
    UniformLoad,
)
from .masses import check_masses
from .movements import number_of_moved, what_moves
from .sides import AT_HINGE, DIRECTIONS, SIDES, refuse_sides
from .structs import Scene
from .table import kind_of
from .tables import Table
from .tapers import Taper, ends_of
from .temperature import check_beam, effect_of
from .wording import number, shown, unequal_to_spans

BY_X = -1
"""Instead of a node: the place is given by x."""
NOT_GIVEN = -np.finfo(float).max
"""Instead of a place, the right end of a stretch, or a stiffness of a section."""
UNLOADING = {"elastic": 0, "plastic": 1, "broken": 2}
SETTLEMENT, ROTATION = 3, 4
"""Rows of the settlement and of the rotational stiffness in the numbers of supports."""
ROTATIONS = {"free": 0.0, "fixed": np.inf}
FORCE, COUPLE, DISTRIBUTED, CURVATURE, AXIAL_FORCE, MOVEMENT, TEMPERATURE, ROTATION_OF_SUPPORT = range(1, 9)
AXIAL_UNIFORM, GROUND_MOVEMENT, LINEAR_CURVATURE = 11, 12, 13
MOVEMENTS = {"support": MOVEMENT, "rotation": ROTATION_OF_SUPPORT, "foundation": GROUND_MOVEMENT}
COUPLES = {None: COUPLE, "left": 9, "right": 10}
"""Couples, by the side of a hinge on which they act."""
KINDS = {
    ForceLoad: (FORCE, "F"),
    MomentLoad: (COUPLE, "M"),
    AxialLoad: (AXIAL_FORCE, "F"),
    AxialUniformLoad: (AXIAL_UNIFORM, "q"),
    UniformLoad: (DISTRIBUTED, "q"),
    LinearLoad: (DISTRIBUTED, "q"),
    CurvatureLoad: (CURVATURE, "kappa"),
    TemperatureLoad: (TEMPERATURE, "gradient"),
    MovementLoad: (MOVEMENT, "value"),
}
"""Kinds of load, as in gapbeam_scene, and the key of their value."""


def columns(scene: Scene) -> Columns:
    """Take the numbers of a scene.

    Parameters
    ----------
    scene : Scene
        Keys and types are right.

    Raises
    ------
    SceneError
        Numbers of the beam that do not belong together, two places for one thing, or none that double precision holds.
    """
    beam, spans = scene.beam, len(scene.beam.spans)
    span = _empty(6, spans)
    span[0, :spans] = beam.spans
    span[5] = 0.0
    with_masses = bool(scene.analysis.frequencies)
    for row, key in enumerate(("EI", "GA", "EA", "N", "mass"), 1):
        values = np.asarray(getattr(beam, key), dtype=float)
        if values.ndim and len(values) != spans and spans:
            raise unequal_to_spans(key, len(values), spans)
        if key != "mass" or with_masses:
            span[row, :spans] = values if spans else np.inf
    check_beam(beam)
    hinge = _empty(2, len(beam.hinges) + len(scene.hinges))
    free = len(beam.hinges)
    hinge[0, :free], hinge[1, :free] = beam.hinges, 0.0
    hinge[0, free:-1] = _x_of(scene, "hinges")
    hinge[1, free:-1] = [one.stiffness or 0.0 for one in scene.hinges]
    places = _x_of(scene, "masses")
    check_masses(beam, scene.masses, places)
    mass = _empty(2, len(places) if with_masses else 0)
    if with_masses:
        mass[0, :-1], mass[1, :-1] = places, [one.mass for one in scene.masses]
    codes, values = _supports(scene.supports)
    law_supports, law = _laws(scene.supports, _points_given)
    load_codes, load_values = _loads(scene)
    if not scene.combinations:
        _settle(load_codes[:, :-1], load_values[:, :-1], values)
    return Columns(
        span, hinge, _sections(scene.sections, scene.axial_ground), codes, values, law_supports, law, load_codes, load_values,
        *_foundations(scene.foundation), *_tables(scene.foundation), *_laws(scene.foundation, points_with_places, rows=3), mass,
        np.array([scene.analysis.N_with == "live", _is_of_first_order(scene), scene.analysis.stretching,
                  bool(scene.trains)], np.int32),
    )  # fmt: skip


def _is_of_first_order(scene: Scene) -> bool:
    """Whether axial loads have no effect on bending: where that is asked for, and beside what is followed without it."""
    asked = scene.analysis
    return asked.first_order or asked.has_history or asked.at_limit != "stop"


def curves(scene: Scene, taken: Columns) -> tuple[tuple[int, Curve], ...]:
    """Take the smooth laws of a scene.

    Parameters
    ----------
    scene : Scene
        Keys and types are right.
    taken : Columns
        Its numbers.

    Returns
    -------
    tuple of (int, Curve)
        Number of the support, and its law.
    """
    laws = ((i, scene.supports[i].law) for i in taken.with_laws().tolist())
    return tuple((i, law) for i, law in laws if is_smooth(law))


def _empty(rows: int, count: int, kind: type = float) -> np.ndarray:
    found = np.empty((rows, count + 1), dtype=kind, order="F")
    found[:, count] = 0
    return found


def _sections(items: Sequence[Any], grounds: Sequence[AxialGround]) -> np.ndarray:
    found = _empty(15, len(items))
    found[0, :-1], found[1, :-1] = _numbers(items, "from_"), _optional(items, "to")
    found[8, :-1], found[9], found[10], found[11] = _optional(items, "N"), 0.0, NOT_GIVEN, np.inf
    for row, power, key in ((2, 12, "EI"), (4, 13, "GA"), (6, 14, "EA")):
        found[row + 1], found[power] = NOT_GIVEN, 1.0
        values = _column(items, key)
        tapered = [i for i, one in enumerate(values) if isinstance(one, tuple | Taper)] if isinstance(values, list) else []
        if not tapered:
            found[row, :-1] = _optional(items, key)
            continue
        found[row, :-1] = [NOT_GIVEN if one is None else ends_of(one)[0] for one in values]
        for i in tapered:
            found[[row + 1, power], i] = ends_of(values[i])[1:]
    return with_ground(found, grounds, NOT_GIVEN)


def _supports(items: Sequence[Any]) -> tuple[np.ndarray, np.ndarray]:
    codes, found = _empty(5, len(items), np.int32), _empty(6 + PARAMETERS, len(items))
    sides = _column(items, "side")
    codes[0, :-1] = _coded(sides, SIDES)
    codes[1, :-1] = _words(items, "direction", DIRECTIONS)
    refuse_sides(sides, codes)
    codes[1, :-1] += np.where(codes[1, :-1] == DIRECTIONS["rotational"], _words(items, "at_hinge", AT_HINGE), 0).astype(np.int32)
    codes[2, :-1], found[0, :-1] = _places("supports", items, range(len(items)))
    for row, key in enumerate(("stiffness", "gap", "settlement"), 1):
        found[row, :-1] = _numbers(items, key)
    found[ROTATION, :-1] = _rotations(items)
    unloading = _column(items, "unloading")
    elastic = unloading == "elastic" if isinstance(unloading, str) else isinstance(unloading, list) and (
        unloading.count("elastic") == len(unloading)
    )
    codes[3, :-1] = 0 if elastic else _words(items, "unloading", UNLOADING)
    codes[4, :-1], found[5:-1, :-1] = 0, 0.0
    found[-1, :-1] = _numbers(items, "friction")
    laws = [] if isinstance(items, Table) else list(map(attrgetter("law"), items))
    for i, law in enumerate(laws if laws.count(None) < len(laws) else ()):
        if isinstance(law, Struct):
            codes[4, i], found[5:-1, i] = law.code, law.parameters()
    return codes, found


def _points_given(law: Any) -> list[tuple[float, float]] | None:
    """Give the points of a law of a support; None where it is given by its name."""
    return None if isinstance(law, Struct) else law


def _foundations(items: Sequence[Any]) -> tuple[np.ndarray, np.ndarray]:
    sides, found = _empty(1, len(items), np.int32)[0], _empty(8 + 2 * PARAMETERS, len(items))
    sides[:-1] = _words(items, "side", SIDES)
    found[0, :-1], found[1, :-1] = _numbers(items, "from_"), _optional(items, "to")
    found[2:4, :-1], found[4:6, :-1] = _at_both_ends(items, "k"), _at_both_ends(items, "gap")
    found[6:-1, :-1], found[-1, :-1] = 0.0, _numbers(items, "shear")
    if not isinstance(items, Table):
        for i, item in enumerate(items):
            if item.law is not None:
                found[6:-1, i] = ground_parameters(item.law)
    return sides, found


def _at_both_ends(items: Sequence[Any], key: str) -> Any:
    """Numbers at the left and at the right end, given as one or as a pair; 0 where there is none, or a table."""
    values = _column(items, key)
    if not isinstance(values, list):
        return 0.0 if values is None else values
    return np.array(list(map(at_both_ends, values)), dtype=float).reshape(-1, 2).T


def _tables(items: Sequence[Any]) -> tuple[np.ndarray, np.ndarray]:
    """Points of tables, and the numbers of their foundations, from 1; none of them can be given as columns."""
    tables = []
    for i, item in enumerate(() if isinstance(items, Table) else items, 1):
        given = [(GAP, item.profile), (MODULUS, item.k), *parameter_tables(item.law)]
        tables += [(i, quantity, table) for quantity, table in given if is_table(table)]
    return points_of(tables)


def _laws(
    items: Sequence[Any], points_of: Callable[[Any], Sequence[tuple[float, ...]] | None], rows: int = 2
) -> tuple[np.ndarray, np.ndarray]:
    """Points of laws, and the numbers of their supports or foundations, from 1; none of them can be given as columns."""
    laws = [] if isinstance(items, Table) else list(map(attrgetter("law"), items))
    which = [i for i, law in enumerate(laws) if law is not None] if laws.count(None) < len(laws) else []
    points = [(i + 1, *point) for i in which for point in points_of(laws[i]) or ()]
    supports, found = _empty(1, len(points), np.int32)[0], _empty(rows, len(points))
    for k, (support, *point) in enumerate(points):
        supports[k], found[:, k] = support, point
    return supports, found


def _settle(codes: np.ndarray, values: np.ndarray, supports: np.ndarray) -> None:
    """Make movements that act in full from the start settlements, which they are but for factors of combinations."""
    for k in np.flatnonzero((codes[0] == MOVEMENT) & (codes[1] == 1)).tolist():
        supports[SETTLEMENT, codes[2, k] - 1] += values[2, k]
        values[2, k] = 0.0


def _loads(scene: Scene) -> tuple[np.ndarray, np.ndarray]:
    items = scene.loads
    codes, found = _empty(3, len(items), np.int32), _empty(4, len(items))
    (kinds, cases, nodes), (left, right, values, values_to) = codes[:, :-1], found[:, :-1]
    of = _column(items, "case")
    cases[:] = of == "dead" if isinstance(of, str | np.ndarray) else [case == "dead" for case in of]
    for one, some in _groups(items).items():
        group = items if isinstance(some, slice) else [items[k] for k in some.tolist()]
        kind, key = KINDS[one]
        kinds[some] = kind
        if kind == MOVEMENT:
            numbered = list(zip(np.arange(len(items))[some].tolist(), group, strict=True))
            kinds[some] = [MOVEMENTS[what_moves(load, f"loads[{k}]")] for k, load in numbered]
            nodes[some] = [number_of_moved(scene, k, load) + 1 for k, load in numbered]
            left[some] = right[some] = 0.0
        elif kind in (DISTRIBUTED, CURVATURE, TEMPERATURE, AXIAL_UNIFORM):
            nodes[some], left[some], right[some] = BY_X, _numbers(group, "from_"), _optional(group, "to")
        else:
            nodes[some], left[some] = _places("loads", group, np.arange(len(items))[some])
            right[some] = 0.0
        if kind == COUPLE:
            sides = _column(group, "at_hinge")
            kinds[some] = COUPLES[sides] if sides is None or isinstance(sides, str) else [COUPLES[side] for side in sides]
        if kind == MOVEMENT:
            given = _pairs([load.value if load.rotation is None else load.rotation for load in group])
        elif kind == CURVATURE:
            given = _pairs(_column(group, key))
            kinds[some] = np.where(given[:, 0] == given[:, 1], CURVATURE, LINEAR_CURVATURE)
        elif kind == TEMPERATURE:
            given = np.array([effect_of(scene, k, load) for k, load in zip(np.arange(len(items))[some], group, strict=True)])
        else:
            given = _numbers(group, key)
        values[some], values_to[some] = given.T if given.ndim == 2 else (given, given)
    return codes, found


def _groups(items: Sequence[Any]) -> dict[type, Any]:
    """Index of the loads of every type."""
    types = [items.struct] if isinstance(items, Table) else list(map(type, items))
    if not (found := set(types)) <= KINDS.keys():  # some belong to a result
        types = list(map(kind_of, items))
        found = set(types)
    if len(found) < 2:
        return dict.fromkeys(found, slice(None))
    numbers = {one: k for k, one in enumerate(KINDS) if one in found}
    of = np.fromiter(map(numbers.__getitem__, types), np.int8, len(types))
    return {one: np.flatnonzero(of == k) for one, k in numbers.items()}


def _column(items: Sequence[Any], key: str) -> Any:
    """Values of a key; one word, or None, where all rows have that."""
    if isinstance(items, Table):
        return items.column(key)
    values = list(map(attrgetter(key), items))
    is_one = values and (values[0] is None or isinstance(values[0], str)) and values.count(values[0]) == len(values)
    return values[0] if is_one else values


def _numbers(items: Sequence[Any], key: str) -> np.ndarray:
    found = np.asarray(_column(items, key), dtype=float)
    return found.reshape(len(items), *found.shape[1:])


def _pairs(values: Any) -> np.ndarray:
    """Numbers at both ends of stretches, given as one or as a pair, n by 2."""
    if isinstance(values, np.ndarray):
        return values if values.ndim == 2 else np.column_stack((values, values))
    return np.array(list(map(at_both_ends, values)), dtype=float).reshape(-1, 2)


def _words(items: Sequence[Any], key: str, codes: dict[str, int]) -> Any:
    return _coded(_column(items, key), codes)


def _coded(values: Any, codes: dict[str, int]) -> Any:
    if values is None or isinstance(values, str):
        return codes[values]
    if isinstance(values, np.ndarray):
        return sum(code * (values == word) for word, code in codes.items())
    return list(map(codes.__getitem__, values))


def _rotations(items: Sequence[Any]) -> Any:
    values = _column(items, "rotation")
    if isinstance(values, str):
        return ROTATIONS[values]
    if isinstance(values, np.ndarray) and values.dtype == float:
        return values
    return np.array(list(map(ROTATIONS.get, values, values)), dtype=float)


def _optional(items: Sequence[Any], key: str) -> Any:
    """Numbers, NOT_GIVEN where there is none."""
    values = _column(items, key)
    if values is None:
        return NOT_GIVEN
    if not isinstance(values, list):
        return values
    found = np.array(values, dtype=float)
    if None in values:
        found[[value is None for value in values]] = NOT_GIVEN
    return found


def _x_of(scene: Scene, name: str) -> np.ndarray:
    """Places by x of hinges or masses; infinite where a node is not there."""
    items = getattr(scene, name)
    if not items:
        return np.zeros(0)
    nodes, places = (np.broadcast_to(one, len(items)) for one in _places(name, items, range(len(items))))
    ends = np.append(scene.span_ends(), np.inf)  # no node is there beyond the last one, nor before the first
    by_node = ends[np.where(nodes < 0, len(ends) - 1, np.minimum(nodes, len(ends) - 1))]
    return np.where(nodes == BY_X, places, by_node)


def _places(name: str, items: Sequence[Any], index: Sequence[int]) -> tuple[Any, Any]:
    """Nodes, BY_X where there is none, and x, NOT_GIVEN where there is none."""
    x, node = _optional(items, "x"), _nodes(name, _column(items, "node"), index)
    both = np.broadcast_to((node != BY_X) & (x != NOT_GIVEN), len(items))
    if both.any():
        row = int(both.argmax())
        there = f"node = {number(items[row].node)} and x = {number(items[row].x)}"
        raise SceneError(f"{name}[{index[row]}]", f"has both {there}; give one of the two")
    return node, x


def _nodes(name: str, values: Any, index: Sequence[int]) -> Any:
    """Nodes, BY_X where there is none; those below 0 less 1, so that none is taken for BY_X."""
    if isinstance(values, list):
        if None in values:
            values = [-0.5 if value is None else value for value in values]  # less 1 and cut off this is BY_X
        if min(values, default=0) < -(2**31):  # msgspec minds only integers that are too large
            row = next(row for row, value in enumerate(values) if value < -(2**31))
            raise SceneError(f"{name}[{index[row]}].node", f"expected a whole number, got {shown(values[row])}")
    if values is None:
        return BY_X
    found = np.asarray(values, dtype=float)
    return np.maximum(found - (found < 0), -(2**31)).astype(np.int32)
