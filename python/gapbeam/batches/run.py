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
from ..base.progress import shown_progress
from ..engine.quantities import BENDING
from ..results.state.arguments import whole
from ..scene.reading import read_written
from ..scene.structs import Scene
from ..scene.wording import shown
from .batch import Batch
from .chunks import FORMATS, best_format, writer
from .folder import Folder, Share, as_json, begin_folder, locked, open_folder
from .job import Job
from .scene_cases import ERRORS
from .tables import SceneFolder, Table, take_table
from .wanted import WANTED, cases_a_chunk, check_wanted, job_of
from .workers import cores, in_turn, processes, threads, work

SCENES_A_FILE = 100
CHUNKS_A_WORKER = 2
"""Chunks that are given to an executor for each of its workers, so that none waits."""


def batch(
    scene: Scene | Mapping[str, Any] | str | os.PathLike, table: Any = None, out: str | os.PathLike = "", *,
    want: str | Iterable[str] | None = None, jobs: int | None = None, executor: Executor | None = None, retry_failed: bool = False,
    chunk: int | None = None, part: tuple[int, int] | None = None, progress: Callable[[int, int], None] | None = None,
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
        ``axial_force``, ``axial_displacement``, ``pressure``; fields at a place, ``moment@1.5``; and where a case is one state
        ``error_bound``, the largest errors of reactions and fields, and ``limit.factor``, at which a load that is followed
        cannot go on. Default: input, reaction, opening, deflection, moment.
    jobs : int, optional
        Threads, default one for every core. Of an executor how many workers it has.
    executor : concurrent.futures.Executor, optional
        Works instead of threads: a pool of processes, Dask's ``client.get_executor()``, ``mpi4py.futures``. It stays open.
    retry_failed : bool
        Solve those files again that hold cases that were refused, have no answer or failed.
    chunk : int, optional
        Cases a file; default as many as take half a second or so.
    part : (int, int), optional
        Solve only a part, (3, 10) the third of ten, while others solve the rest into the same folder, as on other machines.
    progress : callable, optional
        Called with the number of cases that are done and that of all, from time to time. Default: a line on a terminal, after a
        second.

    Returns
    -------
    Batch
        What is in the folder; of a part its own cases.

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
    with shown_progress("cases", progress is None) as shown_one:
        progress = progress or shown_one
        return run_batch(scene, table, out, want, jobs, executor, retry_failed, chunk, part, progress, by_processes=False)


def run_batch(
    scene: Any, table: Any, out: str | os.PathLike, want: str | Iterable[str] | None, jobs: int | None, executor: Executor | None,
    retry_failed: bool, chunk: int | None, part: tuple[int, int] | None, progress: Callable[[int, int], None] | None, *,
    by_processes: bool,
) -> Batch:  # fmt: skip
    """Run a batch from a program that can be started anew for other processes.

    Parameters
    ----------
    scene, table, out, want, jobs, executor, retry_failed, chunk, part, progress
        As for `batch`.
    by_processes : bool
        Whether processes work instead of threads where cases are solved one by one, mostly in Python.
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
    share = None if part is None else _checked_part(part)
    with locked(path, share):
        folder = _begin(path, rows, job, scene_digest, size, chunk is None, share)
        _run(folder, rows, job, jobs, executor, retry_failed, progress, by_processes)
    return Batch(path, share)


def _checked_part(part: Any) -> tuple[int, int]:
    """Check which part is to be solved: its number, from 1, and how many there are."""
    is_pair = isinstance(part, Sequence) and not isinstance(part, str) and len(part) == 2
    if not is_pair or any(type(one) is not int for one in part) or not 1 <= part[0] <= part[1]:
        raise SceneError("part", f"expected a number and how many parts there are, as (3, 10), the third of ten; got {shown(part)}")
    return part[0], part[1]


def _plan(scene: Any, table: Any, want: tuple[str, ...] | None) -> tuple[Table, Job, str, int]:
    """Check what is to be done; give the table, the job, a hash of the scene, and how many cases a file has."""
    if isinstance(scene, str | os.PathLike) and os.path.isdir(scene):
        if table is not None:
            raise SceneError(str(scene), "is a folder, whose scenes are the cases; leave the table out")
        rows: Table = SceneFolder(Path(scene))
        job = Job(None, (), check_wanted(want, ("reaction", "opening", *BENDING, ERRORS), WANTED[1:]), ())
        return rows, job, "", SCENES_A_FILE
    if table is None:
        raise SceneError("table", "give a table, or a folder of scenes in place of the scene")
    written, checked, beam = read_written(scene)
    rows = take_table(table)
    if not rows.cases:
        raise SceneError("table", "has no row; give a case at least")
    job = job_of(written, checked, beam, rows.names, want)
    digest = hashlib.sha256(msgspec.msgpack.encode(job.scene)).hexdigest()
    return rows, job, digest, cases_a_chunk(job, checked, beam)


def _begin(path: Path, rows: Table, job: Job, scene: str, size: int, may_differ: bool, share: Share | None) -> Folder:
    kind = best_format()
    if (path / "_manifest.json").exists():
        before = open_folder(path).manifest
        kind = before["format"] if before.get("format") in FORMATS else kind
        size = before.get("chunk", size) if may_differ else size
    return begin_folder(path, {
        "gapbeam": version("gapbeam"), "format": kind, "writer": writer(kind), "scene": scene, "table": rows.digest,
        "inputs": [one.text for one in job.paths], "want": list(job.want), "columns": list(job.columns), "cases": rows.cases,
        "chunk": size, "chunks": -(-rows.cases // size), "supports": list(job.supports), "data": as_json(job.scene),
    }, share)  # fmt: skip


def _run(
    folder: Folder, rows: Table, job: Job, jobs: int, executor: Executor | None, retry_failed: bool,
    progress: Callable[[int, int], None] | None, by_processes: bool,
) -> None:  # fmt: skip
    """Solve what is not done yet."""
    done = set(folder.done())
    if retry_failed:
        done -= set(Batch(folder.path, folder.share)._failed_chunks())
    left = [k for k in folder.chunks() if k not in done]
    total, open_ = (sum(stop - first for first, stop in map(folder.part, which)) for which in (folder.chunks(), left))
    cases = total - open_
    packed = pickle.dumps(job)
    key, kind = hashlib.sha256(packed).hexdigest(), folder.manifest["format"]

    def arguments(chunk: int) -> tuple:
        first, stop = folder.part(chunk)
        return key, packed, rows.rows(first, stop), first, kind

    def each(executor: Executor, call: Callable) -> None:
        nonlocal cases
        tasks = ((k, lambda k=k: arguments(k)) for k in left)
        if progress is not None:
            progress(cases, total)
        for k, data in in_turn(executor, tasks, call, CHUNKS_A_WORKER * jobs):
            folder.write(k, data)
            first, stop = folder.part(k)
            cases += stop - first
            if progress is not None:
                progress(cases, total)

    if executor is not None:
        each(executor, work)
    elif by_processes and jobs > 1 and left and not job.cases.is_prepared:
        with processes(min(jobs, len(left))) as pool:
            each(pool, work)
    else:
        with threads(min(jobs, max(len(left), 1))) as (pool, call):
            each(pool, call)
