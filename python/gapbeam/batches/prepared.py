"""Many cases at once on a prepared beam: columns are loads, factors of cases, or gaps, settlements and stiffnesses of supports."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..base.errors import GapbeamError, Status
from ..results.cases import prepare
from ..scene.columns import SIDES
from ..scene.combinations import VALUES
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
    if any(scene[key] for key in ("foundation", "combinations", "trains")) or scene["analysis"]["history"] != [1.0]:
        return None
    if not all(_varies(scene, path) for path in paths):
        return None
    try:
        return PreparedRoad(scene, paths)
    except GapbeamError:
        return None


def _varies(scene: dict[str, Any], path: KeyPath) -> bool:
    head, *rest = path.parts
    if head == "loads":
        return len(rest) == 2 and rest[1] in VALUES and not isinstance(scene["loads"][rest[0]][rest[1]], list)
    if head == "supports" and rest[1] == "gap":  # it moves the place where a one-sided support begins to act
        support = scene["supports"][rest[0]]
        return support["side"] != "both" and support["law"] is None
    if head == "supports" and rest[1] == "stiffness":
        return scene["supports"][rest[0]]["law"] is None
    return head == "factors" or (head == "supports" and rest[1] == "settlement")


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
        self._paths = paths
        self._cases = np.array([load["case"] for load in scene["loads"]], dtype=object)
        self._sides = [SIDES[support["side"]] for support in scene["supports"]]
        held = scene["supports"]
        self._levels = [one["settlement"] + side * one["gap"] for one, side in zip(held, self._sides, strict=True)]
        x = self._beam.scene.positions(self._beam.scene.supports)
        self._nodes = np.abs(self._beam.node_x - x[:, None]).argmin(axis=1)
        # Reactions and openings then follow from what is known of the nodes
        self._is_simple = all(one["law"] is None and one["direction"] == "normal" and one["stiffness"] > 0.0 for one in held)

    def knows(self, want: Sequence[str]) -> bool:
        """Whether what is wanted follows from the solutions at the nodes, which are not found again for it."""
        return self._is_simple and set(want) <= {"input", "reaction", "opening", "deflection", "rotation", "moment", "shear"}

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
        factors, moves, stiffness = self._numbers(values)
        fine = np.isfinite(factors).all(axis=1)
        for row in moves.values():
            fine &= np.isfinite(row)
        for row in stiffness.values():
            fine &= row > 0.0
        factors[~fine] = 0.0
        found = self._beam.solve(
            factors, settlements={k: np.where(fine, row, 0.0) for k, row in moves.items()},
            stiffness={k: np.where(fine, row, 1.0) for k, row in stiffness.items()} or None,
        )
        solved = fine & (found.status == Status.SOLVED)
        rest = [name for name in want if name != "input"]
        if self._is_simple:
            rest = [name for name in rest if name not in ("reaction", "opening")]
            for k, one in enumerate(supports):
                if "reaction" in want:
                    numbers[f"reaction.{one}"][solved] = found.reaction[solved, k] + 0.0  # there is one zero
                if "opening" in want:
                    away = self._sides[k] * (self._levels[k] + moves.get(k, 0.0) - found.deflection[:, self._nodes[k]])
                    numbers[f"opening.{one}"][solved] = np.where(found.closed[:, k], 0.0, np.maximum(away, 0.0) + 0.0)[solved]
        if any(name in ROWS for name in rest):
            states = found.states()
            for name in (name for name in rest if name in ROWS):
                for k, one in enumerate(supports):
                    numbers[f"{name}.{one}"][solved] = states.at_supports[solved, ROWS[name], k]
        for name, extremes in found.extremes_of([name for name in rest if name not in ROWS]).items():
            for kind, (extreme, place) in extremes.items():
                numbers[f"{name}.{kind}"][solved] = extreme[solved]
                numbers[f"{name}.{kind}_x"][solved] = place[solved]
        return solved

    def _numbers(self, values: np.ndarray) -> tuple[np.ndarray, dict[int, np.ndarray], dict[int, np.ndarray]]:
        """Factor of every load, cases by loads, movements and stiffnesses of supports."""
        factors, moves, stiffness = np.ones((values.shape[1], len(self._cases))), {}, {}
        with np.errstate(over="ignore", invalid="ignore"):
            for path, column in zip(self._paths, values, strict=True):
                if path.parts[0] == "loads":
                    factors[:, path.parts[1]] *= column
                elif path.parts[0] == "factors":
                    factors[:, self._cases == path.parts[1]] *= column[:, None]
                elif path.parts[2] == "stiffness":
                    stiffness[path.parts[1]] = column
                else:
                    _, k, key = path.parts
                    moves[k] = moves.get(k, 0.0) + (column if key == "settlement" else self._sides[k] * column)
        return factors, moves, stiffness
