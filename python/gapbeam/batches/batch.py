"""The results that a batch has written so far."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from difflib import get_close_matches
from typing import Any, ClassVar

import numpy as np

from ..base.errors import SceneError
from ..base.hints import few
from ..results import formatting as fmt
from ..results.state.arguments import whole
from ..scene.reading import as_written, read_scene
from ..scene.structs import Beam, Scene, Units
from ..scene.wording import shown
from .chunks import TEXTS, count_statuses, read_columns
from .folder import from_json, open_folder
from .paths import find_paths, with_values
from .summary import Summary, summarize
from .verbs import BatchVerbs

FAILED = {"refused", "no-answer", "failed"}
"""Outcomes that are no outcome of the structure."""


class Batch(BatchVerbs):
    """Results in the folder of a batch, also while it runs.

    It has the verbs of results, with arrays that have an entry for every case that is done.

    Parameters
    ----------
    path : str or path
        The folder.
    part : (int, int), optional
        Only what this part has solved, as of `gapbeam.batch`.

    Attributes
    ----------
    cases : int
        Cases of the whole table.
    done : int
        Cases that are solved so far, or have failed.
    columns : tuple of str
        Names of what `read` gives.

    Raises
    ------
    SceneError
        There is no batch in that folder.
    """

    def __init__(self, path: str | os.PathLike, part: tuple[int, int] | None = None):
        self._folder = open_folder(path, part)
        manifest = self._folder.manifest
        self._chunks = self._folder.done()
        self.path = self._folder.path
        self.cases: int = manifest["cases"]
        self.done: int = sum(stop - first for first, stop in map(self._folder.part, self._chunks))
        of_folder = () if manifest["data"] is not None else ("scene",)
        self.columns: tuple[str, ...] = ("case", *of_folder, "status", "reason", *manifest["columns"])

    @property
    def scene(self) -> Scene:
        """The scene of the batch, its numbers as they are without the table.

        Raises
        ------
        ValueError
            Its cases are files.
        """
        data = self._folder.manifest["data"]
        if data is None:
            raise ValueError("scene: the cases of this batch are files; read the one that the column scene names")
        return read_scene(from_json(data))

    @property
    def numbers(self) -> tuple[str, ...]:
        """Columns that hold numbers."""
        return tuple(name for name in self.columns if name not in TEXTS and name != "case")

    @property
    def results(self) -> tuple[str, ...]:
        """Columns that hold results: numbers that are not from the table."""
        return tuple(name for name in self.numbers if name not in self._folder.manifest["inputs"])

    def unit(self, name: str) -> tuple[str, float] | None:
        """Give the unit in which pictures show a result, by the labels of the scene.

        Parameters
        ----------
        name : str
            Of the result.

        Returns
        -------
        (str, float) or None
            The unit, and how many of it are one of the scene; None where the folder holds no single scene, or nothing is known.
        """
        data = self._folder.manifest["data"]
        quantity = name.partition(".")[0]
        if data is None or quantity not in fmt.UNITS:
            return None
        return fmt.shown_unit(Scene(beam=Beam(spans=[], EI=1.0), units=Units(**(data.get("units") or {}))), quantity)

    def _chosen(self, names: str | Sequence[str] | None) -> tuple[str, ...]:
        """Names of columns as they are given; default all."""
        return self.columns if names is None else (names,) if isinstance(names, str) else tuple(names)

    def chunks(self, names: str | Sequence[str] | None = None) -> Iterator[dict[str, np.ndarray]]:
        """Go through what is done, file by file.

        Parameters
        ----------
        names : str or sequence of str, optional
            Of the columns; default all.

        Yields
        ------
        dict of numpy.ndarray
            By name.

        Raises
        ------
        SceneError
            There is no such column, or a file cannot be read.
        """
        names = self._chosen(names)
        for name in names:
            if name not in self.columns:
                near = get_close_matches(str(name), self.columns, n=1, cutoff=0.5)
                hint = f"did you mean {shown(near[0])}?" if near else f"there are {few(map(shown, self.columns))}"
                raise SceneError(str(self.path), f"has no column {shown(name)}; {hint}")
        for k in self._chunks:
            yield self._columns_of(k, names)

    def _columns_of(self, chunk: int, names: Sequence[str]) -> dict[str, np.ndarray]:
        """Read columns of a file, which has the cases that it should have."""
        found = read_columns(self._folder.file(chunk), names)
        for column in found.values():
            self._folder.expect_cases(chunk, len(column))
        return found

    def _statuses_of(self, chunk: int) -> dict[str, int]:
        """Count the cases of a file by their outcome, likewise."""
        found = count_statuses(self._folder.file(chunk))
        self._folder.expect_cases(chunk, sum(found.values()))
        return found

    def read(self, names: str | Sequence[str] | None = None) -> dict[str, np.ndarray]:
        """Give columns of all cases that are done, as `pandas.DataFrame` takes them.

        Parameters
        ----------
        names : str or sequence of str, optional
            Of the columns; default all.

        Returns
        -------
        dict of numpy.ndarray
            By name; texts are empty, and numbers not-a-number, where there is none.

        Raises
        ------
        SceneError
            As for `chunks`.
        """
        names = self._chosen(names)
        parts = list(self.chunks(names))
        return {name: np.concatenate([part[name] for part in parts]) if parts else np.empty(0) for name in names}

    def statuses(self) -> dict[str, int]:
        """Count the cases by their outcome.

        Returns
        -------
        dict of int
            ``solved``, ``no-equilibrium``, ``limit-load``, ``refused``, ``no-answer``, ``failed``: those that there are.
        """
        found: Counter[str] = Counter()
        for chunk in self._chunks:
            found.update(self._statuses_of(chunk))
        return dict(found.most_common())

    def reasons(self) -> dict[str, str]:
        """Give the reason of the first case of every outcome that has one.

        Returns
        -------
        dict of str
            By outcome.
        """
        found: dict[str, str] = {}
        for chunk in self._chunks:
            if self._statuses_of(chunk).keys() - found.keys() - {"solved"}:
                part = self._columns_of(chunk, ["status", "reason"])
                for k in np.flatnonzero(part["reason"] != "").tolist():
                    found.setdefault(part["status"][k], part["reason"][k])
        return found

    renamed: ClassVar = {"failed_chunks": "_failed_chunks"}

    def _failed_chunks(self) -> list[int]:
        """Give the files with cases that were refused, have no answer or failed, by number."""
        return [chunk for chunk in self._chunks if FAILED & self._statuses_of(chunk).keys()]

    def summary(self, names: Iterable[str] | None = None, **options: Any) -> Summary:
        """Tell how results are distributed: quantiles, histograms, how many exceed a limit.

        Parameters
        ----------
        names : iterable of str, optional
            Of results; default all but the places of extremes.
        **options
            ``shares``, ``limits``, ``bins`` as for `gapbeam.batches.summary.summarize`.

        Returns
        -------
        Summary
            Of the cases that are done so far; counts and quantiles are exact.

        Raises
        ------
        SceneError, ValueError
            As there.
        """
        return summarize(self, names, **options)

    def scene_of(self, case: int) -> Scene:
        """Give a case as a scene of its own, for `gapbeam.solve`.

        Parameters
        ----------
        case : int
            Its number, from 0; it must be done.

        Returns
        -------
        Scene

        Raises
        ------
        ValueError
            The case is not done, or its row was not kept (``want`` without ``input``).
        SceneError
            Its numbers make no scene.
        """
        manifest: dict[str, Any] = self._folder.manifest
        if manifest["data"] is None:
            raise ValueError("scene_of: the cases of this batch are files; solve the one that the column scene names")
        if "input" not in manifest["want"]:
            raise ValueError('scene_of: the rows of the table were not kept; take "input" into what is wanted')
        size, case = manifest["chunk"], whole("case", case)
        if not 0 <= case < self.cases or case // size not in self._chunks:
            raise ValueError(f"scene_of: case {case} is not done; there are {self.done:,} of {self.cases:,}")
        data = from_json(manifest["data"])
        row = self._columns_of(case // size, manifest["inputs"])
        values = [float(row[name][case % size]) for name in manifest["inputs"]]
        paths = find_paths(as_written(data), manifest["inputs"])
        return read_scene(with_values(data, paths, values))
