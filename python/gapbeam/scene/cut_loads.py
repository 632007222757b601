"""Distributed loads cut for patterns: at the ends of spans, and where parts of a beam begin that are loaded or not."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import msgspec
import numpy as np

from ..base.errors import SceneError
from .loads import LinearLoad, UniformLoad
from .names import labels
from .structs import Combination, Scene
from .wording import key_of, number, shown

SAME = 1e-9
"""Share of the beam below which places of cuts are one."""


class Placement(NamedTuple):
    """Where the loads of a case stand.

    Attributes
    ----------
    name : str
        For what they stand there.
    case : str
        The case.
    edges : numpy.ndarray
        Right ends of parts of the beam.
    loaded : numpy.ndarray of bool
        Which of them have the loads: those down first, then those up (two rows).
    """

    name: str
    case: str
    edges: np.ndarray
    loaded: np.ndarray

    def acts(self, middles: np.ndarray) -> np.ndarray:
        """Tell which loads act.

        Parameters
        ----------
        middles : numpy.ndarray
            Of every load its middle, and 0 where it is down, 1 where it is up (rows).

        Returns
        -------
        numpy.ndarray
            1.0 or 0.0.
        """
        part = np.minimum(np.searchsorted(self.edges, middles[0]), len(self.edges) - 1)
        return self.loaded[middles[1].astype(int), part].astype(float)


def check_parts(place: str, combination: Combination) -> None:
    """Refuse what does not go with parts of spans.

    Parameters
    ----------
    place : str
        Of the combination in the scene.
    combination : Combination

    Raises
    ------
    SceneError
        Other patterns, or the contact state of another combination.
    """
    case = next((case for case, rule in combination.expand.items() if rule == "parts"), None)
    if case is None:
        return
    if len(combination.expand) > 1:
        problem = '"parts" goes with no other pattern; write a combination for each pattern of the other case'
        raise SceneError(f"{place}.expand.{key_of(case)}", problem)
    if combination.scheme_of is not None:
        raise SceneError(f"{place}.scheme_of", 'does not go with expand = "parts"; leave it out')


def cut_loads(
    scene: Scene, placed: Mapping[int, Sequence[Placement]]
) -> tuple[Scene, dict[str, np.ndarray], np.ndarray]:
    """Cut the distributed loads of cases that have patterns.

    Parameters
    ----------
    scene : Scene
        With combinations.
    placed : mapping
        As for `plan_combinations`.

    Returns
    -------
    scene : Scene
        With more loads.
    spans : dict
        By case with ``spans`` the span of every load, -1 for those of other cases.
    middles : numpy.ndarray
        As for `Placement.acts`.

    Raises
    ------
    SceneError
        Loads that cannot be cut, or a support inside a span.
    """
    by_spans, in_parts = (
        list(dict.fromkeys(case for one in scene.combinations for case, rule in one.expand.items() if rule == wanted))
        for wanted in ("spans", "parts")
    )
    if not (by_spans or in_parts):
        return scene, {}, np.zeros((2, len(scene.loads)))
    ends = scene.span_ends()
    if by_spans:
        _check_spans(scene, ends)
    loads: list[Any] = []
    of: list[int] = []
    middles: list[tuple[float, bool]] = []
    for i, load in enumerate(scene.loads):
        if load.case not in (*by_spans, *in_parts):
            loads.append(load)
            of.append(-1)
            middles.append((0.0, False))
            continue
        _check_load(i, load, load.case in in_parts)
        places = [ends] * (load.case in by_spans)
        places += [one.edges for row in placed.values() for one in row if one.case == load.case]
        left, right = load.from_, float(ends[-1]) if load.to is None else load.to
        cuts = _apart([left, *np.concatenate([np.zeros(0), *places]).tolist()], left, right, SAME * float(ends[-1]))
        for part, (a, b) in enumerate(pairwise(cuts)):
            span = int(np.searchsorted(ends, (a + b) / 2)) - 1
            words = f"part {part}" if load.case in in_parts else f"span {span}"
            loads.append(_part(load, left, right, a, b, words) if len(cuts) > 2 or load.case in by_spans else load)
            of.append(span)
            middles.append(((a + b) / 2, isinstance(load, UniformLoad) and load.q < 0.0))
    found = np.array(of, dtype=int)
    names = np.array([load.case for load in loads], dtype=object)
    return (
        msgspec.structs.replace(scene, loads=loads),
        {case: np.where(names == case, found, -1) for case in by_spans},
        np.array(middles, dtype=float).reshape(-1, 2).T,
    )


def _apart(places: Sequence[float], left: float, right: float, least: float) -> list[float]:
    """Places between two in ascending order, both included, none nearer to another than that."""
    found = [left]
    for place in sorted(places):
        if place - found[-1] > least and right - place > least:
            found.append(place)
    return [*found, right]


def _check_load(i: int, load: Any, in_parts: bool) -> None:
    """Refuse loads that cannot be cut."""
    kinds, rule, words = (
        ((UniformLoad,), "parts", "uniform") if in_parts else ((UniformLoad, LinearLoad), "spans", "distributed")
    )
    if not isinstance(load, kinds):
        raise SceneError(f"loads[{i}]", f'a case with expand = "{rule}" has {words} loads only; give this one another '
                         f"case than {shown(load.case)}")  # fmt: skip


def _part(load: Any, left: float, right: float, a: float, b: float, words: str) -> Any:
    """A distributed load between two places."""
    name = None if load.name is None else f"{load.name}, {words}"
    if isinstance(load, UniformLoad) or (a, b) == (left, right):  # which may be no length at all
        return msgspec.structs.replace(load, from_=a, to=b, name=name)
    at = [load.q[0] + (load.q[1] - load.q[0]) * ((x - left) / (right - left)) for x in (a, b)]
    q = (load.q[0] if a == left else at[0], load.q[1] if b == right else at[1])
    return msgspec.structs.replace(load, from_=a, to=b, q=q, name=name)


def _check_spans(scene: Scene, ends: np.ndarray) -> None:
    """Patterns go from span end to span end: a support between would be passed over without a word."""
    x = scene.positions(scene.supports)
    names = labels(scene.supports)
    for k, support in enumerate(scene.supports):
        if support.direction == "normal" and np.abs(ends - x[k]).min(initial=np.inf) > SAME * ends[-1]:
            i = next(i for i, one in enumerate(scene.combinations) if "spans" in one.expand.values())
            case = next(case for case, rule in scene.combinations[i].expand.items() if rule == "spans")
            raise SceneError(
                f"combinations[{i}].expand.{key_of(case)}",
                f'"spans" loads the spans of the beam one by one, but support {names[k]} at x = {number(x[k])} stands inside a '
                "span; make beam.spans end at the supports",
            )
