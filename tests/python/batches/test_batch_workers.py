"""Batches on workers that are lost: processes, Dask's by the library and by its command line, MPI's; bytes are compared."""

import json
import os
import shutil
import signal
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor
from contextlib import ExitStack, contextmanager
from multiprocessing import get_context
from pathlib import Path

import gapbeam
import pytest

from .test_batch import SCENE, digests, table, undisturbed

MPI = """
import os, signal, sys, time
sys.path.insert(0, {tests!r})
from mpi4py.futures import MPIPoolExecutor
from python.batches.test_batch import SCENE, gapbeam, table

if __name__ == "__main__":
    with MPIPoolExecutor() as pool:
        worker = pool.submit(os.getpid).result()

        def progress(done, cases):
            if done >= 200 and sys.argv[1] == "kill":
                os.kill(worker, signal.SIGKILL)
                time.sleep(100.0)  # mpirun ends this process too

        gapbeam.batch(SCENE, table(550), "out", executor=pool, chunk=100, progress=progress)
"""
"""A program for ``mpirun ... python -m mpi4py.futures``."""


@pytest.fixture
def whole(tmp_path):
    return undisturbed(tmp_path / "whole")


def test_a_lost_process_is_told(tmp_path, whole):
    def progress(done, cases):
        for process in list(pool._processes.values()):
            process.kill()

    with ProcessPoolExecutor(1, get_context("spawn")) as pool:
        pool.submit(int).result()
        with pytest.raises(gapbeam.GapbeamError, match=r"a worker is gone .* start the same batch again, and it continues"):
            gapbeam.batch(SCENE, table(550), tmp_path / "out", executor=pool, chunk=100, progress=progress)
    gapbeam.batch(SCENE, table(550), tmp_path / "out")
    assert digests(tmp_path / "out") == whole


def test_dask_solves_what_a_lost_worker_had(tmp_path, whole):
    distributed = pytest.importorskip("distributed")
    killed = []

    def progress(done, cases):
        if done >= 100 and not killed:
            killed.append(next(iter(cluster.workers.values())).pid)
            os.kill(killed[0], signal.SIGKILL)

    options = {"n_workers": 2, "threads_per_worker": 1, "processes": True, "dashboard_address": None}
    with distributed.LocalCluster(**options) as cluster, distributed.Client(cluster) as client:
        gapbeam.batch(SCENE, table(550), tmp_path / "out", executor=client.get_executor(), jobs=1, chunk=100, progress=progress)
    assert killed
    assert digests(tmp_path / "out") == whole


@contextmanager
def started(*arguments):
    """A program of Dask, as long as it is wanted."""
    process = subprocess.Popen([sys.executable, "-m", "dask", *arguments], stderr=subprocess.DEVNULL)
    try:
        yield process
    finally:
        process.kill()
        process.wait()


def test_dask_by_its_command_line(tmp_path, whole):
    """A scheduler and two workers as programs of their own, one of which is killed; then the command on the other one."""
    distributed = pytest.importorskip("distributed")
    file = str(tmp_path / "scheduler.json")
    worker = "worker", "--scheduler-file", file, "--nthreads", "1", "--no-nanny", "--no-dashboard"
    with ExitStack() as programs:
        programs.enter_context(started("scheduler", "--scheduler-file", file, "--port", "0", "--no-dashboard"))
        workers = [programs.enter_context(started(*worker)) for _ in range(2)]

        def progress(done, cases):
            if done >= 100:
                workers[0].kill()

        with distributed.Client(scheduler_file=file, timeout=60) as client:
            client.wait_for_workers(2, timeout=60)
            address = client.scheduler.address
            gapbeam.batch(SCENE, table(550), tmp_path / "out", executor=client.get_executor(), chunk=100, progress=progress)
        assert workers[0].poll() is not None
        assert digests(tmp_path / "out") == whole

        (tmp_path / "beam.json").write_text(json.dumps(SCENE))
        (tmp_path / "t.csv").write_text("factors.wind\n1\n2\n")
        command = [sys.executable, "-m", "gapbeam", "batch", "beam.json", "t.csv", "--out", "cli", "--dask", address]
        said = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True).stdout
    assert said.startswith("cli: 2 of 2 cases: 2 solved; 2 of them in ")


def test_mpi_goes_on_after_a_lost_worker(tmp_path, whole):
    """With a worker mpirun ends all the others; the same program goes on."""
    pytest.importorskip("mpi4py")
    if shutil.which("mpirun") is None:
        pytest.skip("there is no mpirun")
    (tmp_path / "program.py").write_text(MPI.format(tests=str(Path(__file__).parents[2])))
    as_root = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1"}

    def run(what):
        command = ["mpirun", "-n", "3", sys.executable, "-m", "mpi4py.futures", "program.py", what]
        process = subprocess.run(command, cwd=tmp_path, env=os.environ | as_root, capture_output=True, text=True, timeout=120)
        return process.returncode

    assert run("kill") != 0
    assert 0 < gapbeam.Batch(tmp_path / "out").done < 550
    assert run("go on") == 0
    assert digests(tmp_path / "out") == whole
