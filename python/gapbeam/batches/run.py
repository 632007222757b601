"""Run a batch: every row of a table is a case of a scene, and results go into files that last."""

from __future__ import annotations

import hashlib
import os
import pickle
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import Executor
from importlib.metadata import version
from pathlib import Path
from typing import Any

import msgspec

from ..base.errors import SceneError
from ..engine.quantities import BENDING
from ..results.state.arguments import whole
from ..scene.combinations import plan_combinations
from ..scene.names import labels
from ..scene.reading import read_beam
from ..scene.structs import Scene
from ..scene.wording import choice, shown
from .batch import Batch
from .chunks import FORMATS, best_format, writer
from .folder import Folder, as_json, begin_folder, locked, open_folder
from .job import WANTED, Job
from .paths import find_paths, scene_data
from .scene_cases import AT_SUPPORTS, ERRORS
from .tables import SceneFolder, Table, take_table
from .workers import cores, in_turn, processes, threads, work

SECONDS = 0.5
"""A chunk takes about so long on one core."""
NUMBERS = 4_000_000
"""Numbers in a chunk, at most."""
SCENES_A_FILE = 100
A_TRAIN = 30
"""States that a train counts for."""
CHUNKS_A_WORKER = 2
"""Chunks that are given to an executor for each of its workers, so that none waits."""


def batch(
    scene: Scene | Mapping[str, Any] | str | os.PathLike, table: Any = None, out: str | os.PathLike = "", *,
    want: str | Iterable[str] | None = None, jobs: int | None = None, executor: Executor | None = None, retry_failed: bool = False,
    chunk: int | None = None, progress: Callable[[int, int], None] | None = None,
) -> Batch:  # fmt: skip
    """Solve a scene for every row of a table, into a folder.

    Whatever ends it, the same call continues where it was, and the files are the same to the last byte as if nothing had
    happened, whatever the number of workers.

    Parameters
    ----------
    scene : Scene, mapping, str or path
        As for `gapbeam.solve`; or a folder of scenes, each of which is a case.
    table : str, path, mapping, DataFrame or iterable
        A .csv or .parquet file; or columns in Python, a number a case: arrays by name, pairs of a name and an array, or draws
        from `gapbeam.sample`. A column is a key path of the scene (``supports.R-104.gap``, ``loads[2].q``, ``beam.EI``), or
        ``factors.CASE``, by which the loads of a case are multiplied. None where `scene` is a folder.
    out : str or path
        The folder for the results.
    want : str or iterable of str, optional
        What is kept of every case: ``input`` (the row of the table), ``reaction``, ``opening``, ``couple`` (of every support), and
        the largest and smallest value of fields with their places: ``deflection``, ``rotation``, ``moment``, ``shear``,
        ``axial_force``, ``axial_displacement``, ``pressure``; and ``error_bound``, the largest errors of reactions and fields,
        where a case is one state. Default: input, reaction, opening, deflection, moment.
    jobs : int, optional
        Threads, default one for every core. Of an executor how many workers it has.
    executor : concurrent.futures.Executor, optional
        Works instead of threads: a pool of processes, Dask's ``client.get_executor()``, ``mpi4py.futures``. It stays open.
    retry_failed : bool
        Solve those files again that hold cases that were refused, have no answer or failed.
    chunk : int, optional
        Cases a file; default as many as take half a second or so.
    progress : callable, optional
        Called with the number of cases that are done and that of all, from time to time.

    Returns
    -------
    Batch
        What is in the folder.

    Raises
    ------
    SceneError
        The scene or the table is not valid, or the folder holds something else.
    LostWorkerError
        A process is gone; started again the batch continues.
    OSError
        The folder cannot be written; started again the batch continues.

    Examples
    --------
    >>> import gapbeam, tempfile
    >>> scene = {"beam": {"spans": [6.0, 6.0], "EI": 1e4}, "loads": [{"type": "uniform", "q": 5.0}],
    ...          "supports": [{"node": 0}, {"node": 1, "side": "below", "name": "pier"}, {"node": 2}]}
    >>> done = gapbeam.batch(scene, {"supports.pier.gap": [0.0, 0.01, 0.1], "loads[0].q": [5.0, 6.0, 7.0]}, tempfile.mkdtemp())
    >>> done.read(["reaction.pier"])["reaction.pier"].round(3)
    array([37.5  , 42.222, 24.722])
    """
    return run_batch(scene, table, out, want, jobs, executor, retry_failed, chunk, progress, by_processes=False)


def run_batch(
    scene: Any, table: Any, out: str | os.PathLike, want: str | Iterable[str] | None, jobs: int | None, executor: Executor | None,
    retry_failed: bool, chunk: int | None, progress: Callable[[int, int], None] | None, *, by_processes: bool,
) -> Batch:  # fmt: skip
    """Run a batch from a program that can be started anew for other processes.

    Parameters
    ----------
    scene, table, out, want, jobs, executor, retry_failed, chunk, progress
        As for `batch`.
    by_processes : bool
        Whether processes work instead of threads where cases are solved one by one, mostly in Python.

    Returns
    -------
    Batch
    """
    if not os.fspath(out):
        raise SceneError("out", "give a folder for the results")
    want = (want,) if isinstance(want, str) else want
    rows, job, scene_digest, size = _plan(scene, table, None if want is None else tuple(want))
    path = Path(out)
    if retry_failed not in (True, False):
        raise ValueError(f"retry_failed: expected True or False, got {shown(retry_failed)}")
    jobs = whole("jobs", jobs, least=1) if jobs is not None else getattr(executor, "_max_workers", None) or cores()
    if chunk is not None:
        size = whole("chunk", chunk, least=1)
    with locked(path):
        folder = _begin(path, rows, job, scene_digest, size, chunk is None)
        _run(folder, rows, job, jobs, executor, retry_failed, progress, by_processes)
    return Batch(path)


def _plan(scene: Any, table: Any, want: tuple[str, ...] | None) -> tuple[Table, Job, str, int]:
    """Check what is to be done; give the table, the job, a hash of the scene, and how many cases a file has."""
    if isinstance(scene, str | os.PathLike) and os.path.isdir(scene):
        if table is not None:
            raise SceneError(str(scene), "is a folder, whose scenes are the cases; leave the table out")
        rows: Table = SceneFolder(Path(scene))
        job = Job(None, (), _wanted(want, ("reaction", "opening", *BENDING, ERRORS), WANTED[1:]), ())
        return rows, job, "", SCENES_A_FILE
    if table is None:
        raise SceneError("table", "give a table, or a folder of scenes in place of the scene")
    checked, beam = read_beam(scene)
    rows = take_table(table)
    if not rows.cases:
        raise SceneError("table", "has no row; give a case at least")
    data = scene_data(checked)
    known = ("input", *AT_SUPPORTS, *beam.fields, ERRORS)
    states = 1
    if checked.combinations or checked.trains:
        known = ("input", "reaction", "opening", *BENDING)
        states = (len(plan_combinations(checked)) if checked.combinations else 1) * (1 + A_TRAIN * len(checked.trains))
    job = Job(data, find_paths(checked, rows.names), _wanted(want, known, WANTED), tuple(labels(checked.supports)))
    digest = hashlib.sha256(msgspec.msgpack.encode(data)).hexdigest()
    return rows, job, digest, _cases_a_file(job, beam.links + 1, len(rows.names), states)


def _wanted(want: tuple[str, ...] | None, known: Sequence[str], default: tuple[str, ...]) -> tuple[str, ...]:
    if want is None:
        return default
    for name in want:
        if name not in known:
            raise SceneError("want", f"expected some of {choice(known, 'and')}, got {shown(name)}")
    if not want:
        raise SceneError("want", f"is empty; give some of {choice(known, 'and')}")
    return tuple(dict.fromkeys(want))


def _cases_a_file(job: Job, nodes: int, columns: int, states: int) -> int:
    """Cases that take about half a second, by their number of nodes alone: files must not depend on how fast a machine is."""
    seconds = job.cases.seconds(nodes, states)
    numbers = columns + len(job.columns) + len(job.scene["loads"]) + 4 * len(job.supports) + 14
    most = max(min(SECONDS / seconds, NUMBERS / numbers), 1.0)
    power = 10 ** (len(str(int(most))) - 1)
    return int(most / power) * power


def _begin(path: Path, rows: Table, job: Job, scene: str, size: int, may_differ: bool) -> Folder:
    kind = best_format()
    if (path / "_manifest.json").exists():
        before = open_folder(path).manifest
        kind = before["format"] if before.get("format") in FORMATS else kind
        size = before.get("chunk", size) if may_differ else size
    return begin_folder(path, {
        "gapbeam": version("gapbeam"), "format": kind, "writer": writer(kind), "scene": scene, "table": rows.digest,
        "inputs": [one.text for one in job.paths], "want": list(job.want), "columns": list(job.columns), "cases": rows.cases,
        "chunk": size, "chunks": -(-rows.cases // size), "supports": list(job.supports), "data": as_json(job.scene),
    })  # fmt: skip


def _run(
    folder: Folder, rows: Table, job: Job, jobs: int, executor: Executor | None, retry_failed: bool,
    progress: Callable[[int, int], None] | None, by_processes: bool,
) -> None:  # fmt: skip
    """Solve what is not done yet."""
    done = set(folder.done())
    if retry_failed:
        done -= set(Batch(folder.path)._failed_chunks())
    left = [k for k in range(folder.manifest["chunks"]) if k not in done]
    cases = folder.manifest["cases"] - sum(stop - first for first, stop in map(folder.part, left))
    packed = pickle.dumps(job)
    key, kind = hashlib.sha256(packed).hexdigest(), folder.manifest["format"]

    def arguments(chunk: int) -> tuple:
        first, stop = folder.part(chunk)
        return key, packed, rows.rows(first, stop), first, kind

    def each(executor: Executor, call: Callable) -> None:
        nonlocal cases
        tasks = ((k, lambda k=k: arguments(k)) for k in left)
        if progress is not None:
            progress(cases, folder.manifest["cases"])
        for k, data in in_turn(executor, tasks, call, CHUNKS_A_WORKER * jobs):
            folder.write(k, data)
            first, stop = folder.part(k)
            cases += stop - first
            if progress is not None:
                progress(cases, folder.manifest["cases"])

    if executor is not None:
        each(executor, work)
    elif by_processes and jobs > 1 and left and not job.cases.is_prepared:
        with processes(min(jobs, len(left))) as pool:
            each(pool, work)
    else:
        with threads(min(jobs, max(len(left), 1))) as (pool, call):
            each(pool, call)
