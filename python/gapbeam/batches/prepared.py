"""Many cases at once on a prepared beam: columns are loads, factors of cases, numbers of supports, stiffnesses, moduli."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf
from typing import Any

import numpy as np

from ..base.errors import GapbeamError, SceneError, Status
from ..engine.quantities import BENDING
from ..results.cases.cases import prepare
from ..results.cases.varied import OF_SPANS
from ..results.stepping import solve
from ..scene.columns import SIDES
from ..scene.combinations import VALUES
from ..scene.names import DEAD
from .paths import KeyPath, with_values

ROWS = {"reaction": 0, "opening": 2, "couple": 3}
"""Values at supports, as `Cases.states` has them."""


def prepared_road(scene: dict[str, Any], paths: Sequence[KeyPath]) -> PreparedRoad | None:
    """Prepare a scene for the cases of a table, where they can be solved on a prepared beam.

    Parameters
    ----------
    scene : dict
        As plain data.
    paths : sequence of KeyPath
        What the columns of the table are.

    Returns
    -------
    PreparedRoad or None
        None where each case has to be solved as a scene of its own.
    """
    if any(scene[key] for key in ("combinations", "trains")) or scene["analysis"]["history"] != [1.0]:
        return None
    if not all(_varies(scene, path) for path in paths):
        return None
    try:
        return PreparedRoad(scene, paths)
    except GapbeamError:
        return None


def _varies(scene: dict[str, Any], path: KeyPath) -> bool:
    head, *rest = path.parts
    if head == "beam":
        return rest[0] in OF_SPANS
    if head == "foundation":  # a modulus that is one number
        return rest[1:] == ["k"] and isinstance(scene["foundation"][rest[0]]["k"], int | float)
    if head == "loads":
        return len(rest) == 2 and rest[1] in VALUES and not isinstance(scene["loads"][rest[0]][rest[1]], list)
    if head == "supports" and rest[1] == "gap":  # it moves the place where a one-sided support begins to act
        support = scene["supports"][rest[0]]
        return support["side"] != "both" and support["law"] is None
    if head == "supports" and rest[1] == "stiffness":
        return scene["supports"][rest[0]]["law"] is None
    return head == "factors" or (head == "supports" and rest[1] == "settlement")


def _is_held(scene: dict[str, Any]) -> bool:
    """Whether what holds both ways keeps the beam from moving, so that it can stand under any loads."""
    kept = {key: [one for one in scene[key] if one["side"] == "both" and one["law"] is None] for key in ("supports", "foundation")}
    try:
        nothing = {key: [] for key in ("loads", "trains", "combinations")}
        return not solve({**scene, **kept, **nothing, "analysis": {}}).steps[-1].indifferent
    except GapbeamError:
        return False


def shares_before(scene: dict[str, Any]) -> list[float]:
    """Give the shares of the live loads at which a beam has to stand, before all of them act, for all load steps to stand.

    Parameters
    ----------
    scene : dict
        As plain data.

    Returns
    -------
    list of float
        The loads under which supports without laws have an equilibrium are a convex set, in which no load is: where the first
        step stands and the last one, those between do, and without dead loads the last one is enough.
    """
    steps, held = scene["analysis"]["steps"], (*scene["supports"], *scene["foundation"])
    if any(one["law"] is not None for one in held) or _is_rigid(scene):
        return [k / steps for k in range(1, steps)]
    return [1 / steps] if steps > 1 and any(load["case"] == DEAD for load in scene["loads"]) else []


def _is_rigid(scene: dict[str, Any]) -> bool:
    """Whether any stretch is rigid, so that statics may not tell the reactions of some scheme on the way apart."""
    given = [scene["beam"]["EI"], *(one["EI"] for one in scene["sections"])]
    return any(inf in (one if isinstance(one, list) else [one]) for one in given)


def at_once(scene: dict[str, Any], paths: Sequence[KeyPath]) -> dict[str, Any]:
    """Leave out load steps that change nothing.

    Parameters
    ----------
    scene : dict
        As plain data, of a case that is solved as a scene of its own.
    paths : sequence of KeyPath
        What varies by case.

    Returns
    -------
    dict
        With one load step where whether a case is solved, and its state then, do not depend on those before it.
    """
    analysis = scene["analysis"]
    if analysis["steps"] == 1 or analysis["follow"] != "steps" or analysis["history"] != [1.0]:
        return scene
    if not all(path.parts[0] in ("combinations", "trains") or _varies(scene, path) for path in paths):
        return scene
    loose = any(path.parts[0] == "supports" and path.parts[2] == "stiffness" for path in paths)
    if shares_before(scene) and (loose or len(shares_before(scene)) > 1 or not _is_held(scene)):
        return scene
    return {**scene, "analysis": {**analysis, "steps": 1}}


class PreparedRoad:
    """A scene prepared for the columns of a table: what varies by case is 1 or 0 in it, so that the digits are those of the table.

    Parameters
    ----------
    scene : dict
        As plain data.
    paths : sequence of KeyPath
        What the columns of the table are.

    Raises
    ------
    GapbeamError
        The scene cannot be prepared.
    """

    def __init__(self, scene: dict[str, Any], paths: Sequence[KeyPath]):
        values = [0.0 if path.parts[0] == "supports" and path.parts[2] != "stiffness" else 1.0 for path in paths]
        scene = with_values(scene, paths, values)
        self._beam = prepare(scene)
        # Shares of the live loads at which a case has to stand before all of them act
        self._before: list[float] = []
        analysis = scene["analysis"]
        if (analysis["steps"] > 1 or analysis["follow"] == "events") and not _is_held(scene):
            if analysis["follow"] == "events":
                raise SceneError("analysis.follow", "the beam may lose its hold at any share of the loads")
            self._before = shares_before(scene)
        self._paths = paths
        self._cases = np.array([load["case"] for load in scene["loads"]], dtype=object)
        held = scene["supports"]
        self._sides = [SIDES[support["side"]] for support in held]
        self._own = {key: [support[key] for support in held] for key in ("settlement", "gap")}
        x = self._beam.scene.positions(self._beam.scene.supports)
        self._nodes = np.abs(self._beam.node_x - x[:, None]).argmin(axis=1)
        # Reactions and openings then follow from what is known of the nodes
        self._is_simple = not scene["foundation"] and all(
            one["law"] is None and one["direction"] == "normal" and one["stiffness"] > 0.0 for one in held
        )

    def seconds(self, want: Sequence[str], nodes: int) -> float:
        """Tell roughly how long a case takes.

        Parameters
        ----------
        want : sequence of str
            What is kept.
        nodes : int
            Of the beam.

        Returns
        -------
        float
        """
        steps = 1 + len(self._before)
        if self._beam.scene.foundation:
            return 2e-2 * steps
        # From the solutions at the nodes, which are not found again for it
        known = {"input", "reaction", "opening", *BENDING}
        if not any(path.parts[0] == "beam" for path in self._paths):
            known.add("error_bound")
        is_known = self._is_simple and set(want) <= known
        return steps * (3e-6 + 4e-7 * nodes if is_known else 2e-5 + 3e-6 * nodes)

    def solve(
        self, values: np.ndarray, want: Sequence[str], numbers: dict[str, np.ndarray], supports: Sequence[str]
    ) -> np.ndarray:
        """Solve cases.

        Parameters
        ----------
        values : numpy.ndarray
            Columns by cases.
        want : sequence of str
            What is kept.
        numbers : dict of numpy.ndarray
            By name of the column; changed where cases are solved.
        supports : sequence of str
            Names of all supports.

        Returns
        -------
        numpy.ndarray of bool
            Which cases are solved.
        """
        factors, given = self._numbers(values)
        fine = np.isfinite(factors).all(axis=1)
        for key, columns in given.items():
            for column in columns.values():
                fine &= np.isfinite(column) if key in ("settlement", "gap", "k") else column > 0.0
                fine &= column > 0.0 if key == "k" else True
        factors[~fine] = 0.0
        for key, columns in given.items():
            for k, column in columns.items():
                columns[k] = np.where(fine, column, 0.0 if key in ("settlement", "gap") else 1.0)
        done = ("input", "error_bound", *(("reaction", "opening") if self._is_simple else ()))
        rest = [name for name in want if name not in done]
        fields = [name for name in rest if name not in ROWS]
        nodes = ("deflection", "moment") if fields or "error_bound" in want else ("deflection",)
        found = self._beam.solve(factors, want=("reaction", *nodes), **given)
        solved = fine & (found.status == Status.SOLVED)
        for share in self._before:
            part = factors * np.where(self._cases == DEAD, 1.0, share)
            solved &= self._beam.solve(part, want=(), **given).status == Status.SOLVED
        if self._is_simple:
            for k, one in enumerate(supports):
                if "reaction" in want:
                    numbers[f"reaction.{one}"][solved] = found.reaction[solved, k] + 0.0  # there is one zero
                if "opening" in want:
                    settlement, gap = (given.get(key, {}).get(k, own[k]) for key, own in self._own.items())
                    away = self._sides[k] * (settlement + self._sides[k] * gap - found.deflection[:, self._nodes[k]])
                    numbers[f"opening.{one}"][solved] = np.where(found.closed[:, k], 0.0, np.maximum(away, 0.0) + 0.0)[solved]
        for kind, bound in (found.error_bounds() if "error_bound" in want else {}).items():
            numbers[f"error_bound.{kind}"][solved] = bound[solved]
        states = found.states() if len(rest) > len(fields) else None
        for name in (name for name in rest if name in ROWS):
            for k, one in enumerate(supports):
                numbers[f"{name}.{one}"][solved] = states.at_supports[solved, ROWS[name], k]
        for name, extremes in (found.extremes_of(fields) if fields else {}).items():
            for kind, (extreme, place) in extremes.items():
                numbers[f"{name}.{kind}"][solved] = extreme[solved]
                numbers[f"{name}.{kind}_x"][solved] = place[solved]
        return solved

    def _numbers(self, values: np.ndarray) -> tuple[np.ndarray, dict[str, dict[int, np.ndarray]]]:
        """Factor of every load, cases by loads, and what `Prepared.solve` takes by number of a support, span or foundation."""
        factors, given = np.ones((values.shape[1], len(self._cases))), {}
        with np.errstate(over="ignore", invalid="ignore"):
            for path, column in zip(self._paths, values, strict=True):
                head, *rest = path.parts
                if head == "loads":
                    factors[:, rest[0]] *= column
                elif head == "factors":
                    factors[:, self._cases == rest[0]] *= column[:, None]
                elif head == "beam":
                    which = rest[1:] or range(len(self._beam.scene.beam.spans))
                    given.setdefault(rest[0], {}).update(dict.fromkeys(which, column))
                else:
                    given.setdefault(rest[1], {})[rest[0]] = column
        return factors, given
