"""Combinations of load cases as factors of every load and movements of every support, patterns written out."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from math import isfinite
from typing import Any

import msgspec
import numpy as np

from ..base.errors import SceneError
from ..base.records import read_only
from .cut_loads import Placement, check_parts, cut_loads
from .movements import replace_settlements
from .names import cases_of, find
from .rotations import with_stiffness
from .sides import SIDES
from .structs import Combination, Scene, Support
from .tables import Table
from .trains import joined, train_name
from .wording import enumerated, key_of, number, shown

MOST = 10_000
"""Combinations that patterns may make of those of a scene."""
VALUES = ("F", "M", "q", "kappa", "value", "rotation", "gradient", "dT")
"""Attributes of loads that are multiplied by factors."""


@dataclass(frozen=True)
class Plan:
    """The combinations of a scene as numbers.

    Attributes
    ----------
    scene : Scene
        The scene; distributed loads that have patterns are cut at the ends of spans.
    names : tuple of str
        Of all combinations, patterns written out.
    factors : numpy.ndarray
        Factor of every load, combinations by loads.
    settlements : numpy.ndarray
        Further movement of every support, combinations by supports.
    scheme_of : tuple of (int or None)
        The combination whose contact state is taken, by number.
    trains : numpy.ndarray
        Factor of every train, combinations by trains.
    idle : tuple of str
        Cases that act in none of them.
    origin : tuple of int
        The number in the scene of the combination that each is a pattern of.
    """

    scene: Scene
    names: tuple[str, ...]
    factors: np.ndarray
    settlements: np.ndarray
    scheme_of: tuple[int | None, ...]
    trains: np.ndarray
    idle: tuple[str, ...]
    origin: tuple[int, ...]

    @property
    def limit_states(self) -> tuple[str, ...]:
        """The limit state of each, empty where it has none."""
        return tuple(self.scene.combinations[i].limit_state for i in self.origin)

    def __len__(self) -> int:
        """Count the combinations."""
        return len(self.names)

    def scene_of(self, k: int, acts: Sequence[bool] | None = None) -> Scene:
        """Write a combination as a scene of its own.

        Parameters
        ----------
        k : int
            Which one, from 0.
        acts : sequence of bool, optional
            For every support, whether it acts: it holds both ways then, and else does not carry.

        Returns
        -------
        Scene
            Its loads and trains are those that act, times their factors; its supports have moved.
        """
        scene, title = self.scene, self.names[k]
        loads = [times(load, factor) for load, factor in zip(scene.loads, self.factors[k].tolist(), strict=True) if factor]
        supports: Sequence[Support] = scene.supports
        if self.settlements[k].any():
            supports = replace_settlements(scene, self.settlements[k]).supports
        if acts is not None:
            supports = [_held(one, act) for one, act in zip(supports, acts, strict=True)]
        title = f"{scene.title}: {title}" if scene.title else title
        trains = [
            msgspec.structs.replace(joined(scene.trains, i), name=train_name(scene, i), factor=train.factor * factor)
            for i, (train, factor) in enumerate(zip(scene.trains, self.trains[k].tolist(), strict=True))
            if factor
        ]
        return msgspec.structs.replace(scene, title=title, loads=loads, trains=trains, supports=supports, combinations=[])


def times(load: Any, factor: float) -> Any:
    """Multiply a load.

    Parameters
    ----------
    load : Load
        The load; left as it is.
    factor : float
        By what.
    """
    given = {key: value for key in VALUES if (value := getattr(load, key, None)) is not None}
    made = {
        key: tuple(factor * one for one in value) if isinstance(value, tuple) else factor * value for key, value in given.items()
    }
    return msgspec.structs.replace(load, **made)


def _held(support: Support, acts: bool) -> Support:
    """A support as it is in a given scheme: both ways from where it begins to act, or without stiffness."""
    if support.side == "both":
        return support
    if not acts:
        return with_stiffness(support, 0.0)
    level = support.settlement + SIDES[support.side] * support.gap
    return msgspec.structs.replace(support, side="both", gap=0.0, settlement=level)


def plan_combinations(scene: Scene, placed: Mapping[int, Sequence[Placement]] | None = None) -> Plan:
    """Take the combinations of a scene.

    Parameters
    ----------
    scene : Scene
        Keys and types are right, and names are unique.
    placed : mapping, optional
        Of combinations with ``parts``, by number, where the loads of that case stand; without it they stand everywhere.

    Raises
    ------
    SceneError
        A combination speaks of what is not there, or patterns make too many.
    """
    there = dict.fromkeys((*cases_of(scene.loads), *(train.case for train in scene.trains)))
    for i, combination in enumerate(scene.combinations):
        _check(i, combination, there, {train.case for train in scene.trains})
    cut, spans, middles = cut_loads(scene, placed or {})
    column = {case: k for k, case in enumerate(there)}
    case_of_load = np.array([column[case] for case in cases_of(cut.loads)], dtype=int)
    loads_of = {case: np.flatnonzero(case_of_load == k) for case, k in column.items()}
    names: list[str] = []
    factors: list[np.ndarray] = []
    origin: list[int] = []
    _check_count(scene, spans, placed or {})
    of_cases = np.array([[one.factors.get(case, 0.0) for case in there] for one in scene.combinations], dtype=float)
    of_loads = of_cases.reshape(len(scene.combinations), len(there))[:, case_of_load]
    for i, combination in enumerate(scene.combinations):
        stand = [(one.name, one.acts(middles)) for one in (placed or {}).get(i, ())]
        for name, row in _patterns(combination, of_loads[i], loads_of, spans, stand):
            names.append(name)
            factors.append(row)
            origin.append(i)
    _check_expanded(names, origin)
    table = np.array(factors).reshape(len(names), len(case_of_load))
    movements = np.zeros((len(scene.combinations), len(scene.supports)))
    for i, combination in enumerate(scene.combinations):
        if combination.settlements:
            movements[i] = _settlements(scene, i)
    moving = np.array(
        [[scene.combinations[i].factors.get(train.case, 0.0) for train in scene.trains] for i in origin], dtype=float
    ).reshape(len(origin), len(scene.trains))
    acts = {train.case for train, column in zip(scene.trains, moving.T, strict=True) if column.any()}
    idle = [case for case in there if case not in acts and not table[:, loads_of[case]].any()]
    return Plan(
        cut, tuple(names), read_only(table), read_only(movements[origin]), _schemes(scene, names, origin), read_only(moving),
        tuple(idle), tuple(origin),
    )


def _check(i: int, combination: Combination, cases: dict[str, None], moving: set[str]) -> None:
    """Refuse cases that are not there, and numbers that are none."""
    if combination.factors.keys() <= cases.keys() and all(map(isfinite, combination.factors.values())) and not combination.expand:
        return
    place = f"combinations[{i}]"
    for key in (*combination.factors, *combination.expand):
        if key not in cases:
            where = f"{place}.{'factors' if key in combination.factors else 'expand'}.{key_of(key)}"
            there = f"the cases are {enumerated(map(shown, cases))}" if cases else "the scene has no loads"
            raise SceneError(where, f"no load is of this case; {there}")
    for key, factor in combination.factors.items():
        if not isfinite(factor):
            raise SceneError(f"{place}.factors.{key_of(key)}", f"expected a finite number, got {number(factor)}")
    for key in combination.expand:
        if key in moving:
            problem = "a train is of this case, and trains have no patterns; give the train a case of its own"
            raise SceneError(f"{place}.expand.{key_of(key)}", problem)
        if not combination.factors.get(key):
            problem = "has no factor" if key not in combination.factors else "has the factor 0, so all its patterns are the same"
            raise SceneError(f"{place}.expand.{key_of(key)}", f"{problem}; give it one in factors")
    check_parts(place, combination)


def _settlements(scene: Scene, i: int) -> np.ndarray:
    """Movements of all supports."""
    row = np.zeros(len(scene.supports))
    seen: dict[int, str] = {}
    for key, value in scene.combinations[i].settlements.items():
        place = f"combinations[{i}].settlements.{key_of(key)}"
        k = find(scene.supports, key, place, "support")
        if not isfinite(value):
            raise SceneError(place, f"expected a finite number, got {number(value)}")
        if k in seen:
            raise SceneError(place, f"this support has a movement already, as {shown(seen[k])}; give one of the two")
        seen[k] = str(key)
        row[k] = value
    return row


def _check_count(scene: Scene, spans: dict[str, np.ndarray], placed: Mapping[int, Sequence[Placement]]) -> None:
    """Refuse more combinations than anybody looks at."""
    total = 0
    for i, combination in enumerate(scene.combinations):
        made = 1
        for case, rule in combination.expand.items():
            if rule == "parts":
                made *= len(placed.get(i, (1,)))
            else:
                made *= 2 if rule == "signs" else 2 ** len(set(spans[case][spans[case] >= 0].tolist()))
        total += made
        if total > MOST and combination.expand:
            raise SceneError(
                f"combinations[{i}].expand",
                f"makes {made:,} combinations, {total:,} with those before it, and {MOST:,} is the most; name the patterns that "
                "count as cases of their own",
            )


def _patterns(
    combination: Combination, plain: np.ndarray, loads_of: dict[str, np.ndarray], spans: dict[str, np.ndarray],
    stand: Sequence[tuple[str, np.ndarray]],
) -> Iterator[tuple[str, np.ndarray]]:
    """Names and factors of what a combination stands for."""
    ways = []
    for case, rule in combination.expand.items():
        if rule == "signs":
            ways.append([(f"{case} {sign}", loads_of[case], value) for sign, value in (("+", 1.0), ("-", -1.0))])
            continue
        if rule == "parts":
            seen: dict[bytes, tuple[str, np.ndarray, np.ndarray]] = {}
            for name, row in stand:
                there = row[loads_of[case]]
                seen.setdefault(there.tobytes(), (name, loads_of[case], there))
            ways += [list(seen.values())] if stand else []
            continue
        span = spans[case]
        reached = sorted(set(span[span >= 0].tolist()))
        patterns = product((1, 0), repeat=len(reached))
        ways.append(
            [
                (f"{case} {''.join(map(str, bits))}", loads_of[case], np.isin(span[loads_of[case]], np.compress(bits, reached)))
                for bits in patterns
            ]
        )
    if not ways:
        yield combination.name, plain
        return
    for chosen in product(*ways):
        row = plain.copy()
        for _, which, times in chosen:
            row[which] = plain[which] * times
        yield f"{combination.name} [{'; '.join(word for word, _, _ in chosen)}]", row + 0.0


def _check_expanded(names: list[str], origin: list[int]) -> None:
    """Names of patterns must not be names of others."""
    seen: dict[str, int] = {}
    for name, i in zip(names, origin, strict=True):
        if name in seen:
            raise SceneError(f"combinations[{i}].name", f"{shown(name)} is also a pattern of combinations[{seen[name]}]; rename it")
        seen[name] = i


def _schemes(scene: Scene, names: list[str], origin: list[int]) -> tuple[int | None, ...]:
    """Numbers of the combinations whose schemes are taken."""
    found: list[int | None] = []
    numbers = {name: k for k, name in enumerate(names)}
    heads = [one.name for one in scene.combinations]
    for i in origin:
        wanted, place = scene.combinations[i].scheme_of, f"combinations[{i}].scheme_of"
        if wanted is None:
            found.append(None)
            continue
        if wanted == heads[i]:
            raise SceneError(place, "is the combination itself; name another one, or leave it out")
        if wanted not in numbers:
            if wanted in heads:
                first = next(name for name, k in zip(names, origin, strict=True) if heads[k] == wanted)
                raise SceneError(place, f"{shown(wanted)} stands for several; name one of them, such as {shown(first)}")
            raise SceneError(place, f"there is no combination {shown(wanted)}; there are {enumerated(map(shown, heads))}")
        if scene.combinations[origin[numbers[wanted]]].scheme_of is not None:
            raise SceneError(place, f"{shown(wanted)} itself takes the scheme of another one; name that one")
        found.append(numbers[wanted])
    if any(k is not None for k in found):
        _check_schemes(scene, next(i for i, one in enumerate(scene.combinations) if one.scheme_of is not None))
    return tuple(found)


def _check_schemes(scene: Scene, i: int) -> None:
    """Refuse what has no scheme of supports that are open or closed."""
    place = f"combinations[{i}].scheme_of"
    if scene.foundation:
        raise SceneError(place, "zones of contact with a foundation are no scheme that another combination can take; leave it out")
    if not isinstance(scene.supports, Table):
        for k, support in enumerate(scene.supports):
            if support.law is not None:
                raise SceneError(place, f"supports[{k}] has a law, which is not just open or closed; leave scheme_of out")
