"""One callable of a scene: numbers of the scene in, results out, for programs that compute on."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from difflib import get_close_matches
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..base.errors import SceneError
from ..results.formatting import unit
from ..results.state.arguments import numbers, whole
from ..scene.key_units import key_unit
from ..scene.reading import read_written
from ..scene.structs import Scene
from ..scene.wording import shown
from .job import Job
from .paths import KeyPath
from .scene_cases import LIMIT, SOLVED
from .tables import Numbers
from .wanted import Output, cases_a_chunk, find_outputs, job_of
from .workers import cores

LEAST = 500
"""Cases for which another thread is started."""


class Evaluated(NamedTuple):
    """Results of a function, and what came of every case.

    Attributes
    ----------
    values : numpy.ndarray
        As the function gives them, not-a-number where a case is not solved.
    status : numpy.ndarray of str
        ``solved``, ``no-equilibrium``, ``limit-load``, ``refused``, ``no-answer``, ``failed``, as of `gapbeam.batch`.
    reason : numpy.ndarray of str
        Why a case is not solved, in words; empty where it is.
    """

    values: np.ndarray
    status: np.ndarray
    reason: np.ndarray


class Function:
    """A scene as a function of some of its numbers; it can be called from several threads, and pickled.

    Attributes
    ----------
    inputs, outputs : tuple of str
        Names, as they were given.
    units : dict of str
        By name of the input or output, with the labels of the scene; empty where it has none.
    nominal : numpy.ndarray
        What the scene has for the inputs; not-a-number where it has no number, 1 for a factor.
    """

    def __init__(self, job: Job, outputs: tuple[Output, ...], chunk: int, threads: int, units: dict[str, str]):
        self._job, self._columns, self._chunk, self._threads = job, outputs, chunk, threads
        self.inputs = tuple(path.text for path in job.paths)
        self.outputs = tuple(one.name for one in outputs)
        self.units = units
        self.nominal = np.array([_number_at(job.scene, path) for path in job.paths])
        self.nominal.setflags(write=False)
        self._idle = [job]  # a job is at work in one thread at a time

    def __repr__(self) -> str:
        """Show the names."""
        return f"Function(inputs={list(self.inputs)}, outputs={list(self.outputs)})"

    def __getstate__(self) -> dict[str, Any]:
        """Pickle without what other threads work with."""
        return {**self.__dict__, "_idle": [self._job]}

    def __call__(self, X: ArrayLike) -> np.ndarray:
        """Compute the outputs.

        Parameters
        ----------
        X : array_like
            A number for every input; or a row of them for every case.

        Returns
        -------
        numpy.ndarray
            A number for every output; or a row of them for every case. Not-a-number where a case is not solved.

        Raises
        ------
        ValueError
            `X` has another shape, or holds something else than numbers.
        """
        return self.evaluate(X).values

    def evaluate(self, X: ArrayLike) -> Evaluated:
        """Compute the outputs, and tell what came of every case.

        Parameters
        ----------
        X : array_like
            As for a call.

        Returns
        -------
        Evaluated
            Of one case a status and a reason without an axis of cases.

        Raises
        ------
        ValueError
            As for a call.
        """
        X = numbers("X", X)
        if X.ndim not in (1, 2) or X.shape[-1] != len(self.inputs):
            raise ValueError(f"X: expected {len(self.inputs)} numbers a case, one for each input, got shape {X.shape}; "
                             f"the inputs are {', '.join(self.inputs)}")  # fmt: skip
        rows = np.ascontiguousarray(np.atleast_2d(X).T)
        count = rows.shape[1]
        size = max(min(self._chunk, -(-count // self._threads)), min(LEAST, self._chunk))
        parts = [rows[:, first : first + size] for first in range(0, max(count, 1), size)]
        if len(parts) == 1:
            found = [self._solve(rows)]
        else:
            with ThreadPoolExecutor(min(self._threads, len(parts)), "gapbeam-function") as pool:
                found = list(pool.map(self._solve, parts))
        whole = [np.concatenate(kind) for kind in zip(*found, strict=True)]
        return Evaluated(*(kind[0] if X.ndim == 1 else kind for kind in whole))

    def _solve(self, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Solve some cases in this thread."""
        try:
            job = self._idle.pop()
        except IndexError:
            job = Job(**self._job.__getstate__())
        try:
            found = job.solve(Numbers(rows), 0)
        finally:
            self._idle.append(job)
        status, reason = (np.char.decode(found[name], "utf-8") for name in ("status", "reason"))
        values = np.empty((rows.shape[1], len(self._columns)))
        for k, one in enumerate(self._columns):
            column = found[one.column]
            if one.is_lifted:
                column = np.where(np.isnan(column), np.nan, column > 0.0)
            elif one.column == LIMIT:
                column = np.where((status == SOLVED) & np.isnan(column), np.inf, column)
            values[:, k] = column
        return values, status, reason

    def gradient(self, X: ArrayLike, step: ArrayLike) -> np.ndarray:
        """Approximate the derivatives by central differences.

        Where a support opens or closes within a step the derivative jumps, and this is a mean of both.

        Parameters
        ----------
        X : array_like
            As for a call.
        step : float or array_like
            Of all inputs, or of each, in its unit; above 0.

        Returns
        -------
        numpy.ndarray
            Outputs by inputs; or such a table for every case. Not-a-number where a case beside is not solved.

        Raises
        ------
        ValueError
            As for a call; or a step that is not above 0.
        """
        X, steps = numbers("X", X), np.asarray(numbers("step", step))
        count = len(self.inputs)
        if steps.shape not in ((), (count,)) or not ((steps > 0.0) & np.isfinite(steps)).all():
            raise ValueError(f"step: expected a number above 0, or {count}, one for each input, got {shown(steps.tolist())}")
        moves = np.diag(np.broadcast_to(steps, count))
        beside = np.concatenate([X[..., None, :] + moves, X[..., None, :] - moves], axis=-2)
        values = self(beside.reshape(-1, X.shape[-1])).reshape(*beside.shape[:-1], len(self.outputs))
        up, down = values[..., :count, :], values[..., count:, :]
        width = np.diagonal(beside[..., :count, :] - beside[..., count:, :], axis1=-2, axis2=-1)  # as it was rounded
        return np.swapaxes((up - down) / width[..., None], -2, -1)


def function(
    scene: Scene | Mapping[str, Any] | str | os.PathLike, inputs: Sequence[str], outputs: Sequence[str], *,
    threads: int | None = None,
) -> Function:  # fmt: skip
    """Make a function of a scene.

    It goes the way of `gapbeam.batch`, without files: through a prepared beam where all inputs allow it.

    Parameters
    ----------
    scene : Scene, mapping, str or path
        As for `gapbeam.solve`.
    inputs : sequence of str
        Key paths of the scene, or ``factors.CASE``, as columns of the table of `gapbeam.batch`.
    outputs : sequence of str
        Columns of the results of `gapbeam.batch`: ``reaction.NAME`` or ``reaction[3]``, ``opening``, ``couple``; ``moment.max``,
        ``moment.max_x``, ``moment.min`` and so on of all fields; ``deflection@15.0``, a field at a place; ``limit.factor``, at
        which the load cannot go on; ``error_bound.moment``. And ``lifted[2]``, 1 where a support is without contact, else 0.
        With combinations or trains a value at a support or a place ends in ``.max`` or ``.min``.
    threads : int, optional
        How many may work at many cases; default one for every core.

    Returns
    -------
    Function

    Raises
    ------
    SceneError
        The scene is not valid, an input is no key path, or there is no such output.

    Examples
    --------
    >>> import gapbeam
    >>> scene = {"units": {"force": "kN", "length": "m"}, "beam": {"spans": [6.0, 6.0], "EI": 1e4},
    ...          "loads": [{"type": "uniform", "q": 5.0}],
    ...          "supports": [{"node": 0}, {"node": 1, "side": "below", "name": "pier"}, {"node": 2}]}
    >>> f = gapbeam.function(scene, ["supports.pier.gap", "loads[0].q"], ["reaction[1]", "moment@6", "lifted.pier"])
    >>> f([[0.0, 5.0], [0.1, 5.0], [0.2, 5.0]]).round(3)
    array([[ 37.5  , -22.5  ,   0.   ],
           [  9.722,  60.833,   0.   ],
           [  0.   ,  90.   ,   1.   ]])
    >>> f.units
    {'supports.pier.gap': 'm', 'loads[0].q': 'kN/m', 'reaction[1]': 'kN', 'moment@6': 'kN m', 'lifted.pier': ''}
    >>> f([0.0, -1e400]), str(f.evaluate([0.0, -1e400]).status)
    (array([nan, nan, nan]), 'refused')
    """
    written, checked, beam = read_written(scene)
    names = {"inputs": inputs, "outputs": outputs}
    for key, given in names.items():
        names[key] = (given,) if isinstance(given, str) else tuple(map(str, given))
        if not names[key]:
            raise SceneError(key, "is empty; give one name at least")
        if doubled := [name for name in names[key] if names[key].count(name) > 1]:
            raise SceneError(key, f"{shown(doubled[0])} is there twice; leave one out")
    found = find_outputs(checked, beam, names["outputs"])
    job = job_of(written, checked, beam, names["inputs"], tuple(dict.fromkeys(one.want for one in found)))
    for one in found:
        if one.column not in job.columns:
            near = get_close_matches(one.column, job.columns, n=1, cutoff=0.5)
            raise SceneError("outputs", f"there is no {shown(one.name)}; did you mean {shown((near or job.columns)[0])}?")
    threads = whole("threads", threads, least=1) if threads is not None else cores()
    units = {path.text: key_unit(written, path.parts) for path in job.paths}
    units |= {one.name: unit(checked, one.quantity) if one.quantity else one.plain_unit for one in found}
    return Function(job, found, cases_a_chunk(job, checked, beam), threads, units)


def _number_at(data: Any, path: KeyPath) -> float:
    """What a scene has at a path."""
    if path.parts[0] == "factors":
        return 1.0
    for part in path.parts:
        if isinstance(data, list | tuple | dict):
            data = data[part]
    return float(data) if isinstance(data, int | float) else np.nan
