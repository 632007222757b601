"""Solve a scene: its one load, or all its combinations."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any

from ..scene.names import names_in_errors
from ..scene.reading import read_beam
from ..scene.structs import Scene
from .cases.combined import solve_combined
from .paths.following import follow_load
from .result import Result
from .state.schemes import choose_rule, starting_scheme


def solve(
    source: Scene | Mapping[str, Any] | str | os.PathLike,
    *,
    rule: str | None = None,
    start: Sequence[bool] | None = None,
) -> Result:
    """Solve a scene.

    Parameters
    ----------
    source : Scene, mapping, str or path
        A scene built in Python, its data as dicts and lists, or the path of a ``.toml`` or ``.json`` file.
    rule : {"block", "single"}, optional
        How the contact state is found, instead of the scene's own ``analysis.rule``.
    start : sequence of bool, optional
        Starting scheme of the first load step: one entry per one-sided support in the order of the scene, True =
        closed. Default: all closed. It changes the number of solves, not the answer.

    Returns
    -------
    Result
        With status ``solved``, ``no-equilibrium`` or ``limit-load``; of a scene with combinations a `CombinedResult`.

    Raises
    ------
    SceneError
        The scene, `rule` or `start` is not valid; or there is not the memory for so many steps.
    EngineError
        No unique answer exists, for example where a rigid beam rests on three rigid supports.

    Examples
    --------
    >>> import gapbeam
    >>> result = gapbeam.solve({
    ...     "beam": {"spans": [2.0, 2.0], "EI": 100.0},
    ...     "supports": [{"node": 0}, {"node": 1, "side": "below", "gap": 0.001}, {"node": 2}],
    ...     "loads": [{"type": "uniform", "q": 3.0}],
    ... })
    >>> result.steps[-1].reaction.round(4)
    array([2.2875, 7.425 , 2.2875])
    """
    scene, beam = read_beam(source)
    rule = choose_rule(scene, rule)
    closed = starting_scheme(beam, start)
    with names_in_errors(scene):
        if scene.combinations:
            return solve_combined(scene, beam, rule, closed)
        result = Result(scene, beam, rule)
        follow_load(result, closed)
        return result
