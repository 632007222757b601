"""Kill batches at random moments, start them again, and compare the files with those of undisturbed runs.

Usage: python tests/attack/kill_batch.py [KILLS [SEED]]     (default 50 kills; takes some minutes)

Half of the kills go to prepared beams in threads, half to single scenes in processes; every one comes after a new file is there.
"""

import hashlib
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

SCENE = Path(__file__).resolve().parents[2] / "examples" / "pipe_rack.toml"
TABLES = (("supports[1].gap", 0.0, 0.01, 20_000, 500), ("beam.EI", 5011.0, 300.0, 2_500, 50))
"""A column with mean and deviation, cases, cases a file: on a prepared beam, and one by one."""


def run(column: str, mean: float, deviation: float, cases: int, chunk: int, out: str, jobs: int) -> None:
    """Run a batch in this process."""
    from gapbeam import sample
    from gapbeam.batches.run import run_batch

    table = sample.draw(cases, {column: sample.normal(mean, deviation), "factors.live": sample.normal(1.0, 0.3)}, seed=5)
    run_batch(SCENE, table, out, None, jobs, None, False, chunk, None, by_processes=True)


def command(table: Sequence[object], out: Path, jobs: int) -> list[str]:
    """Give the command that does that in another process."""
    return [sys.executable, __file__, "--run", *map(str, (*table, out, jobs))]


def digests(folder: Path) -> dict[str, str]:
    """Every file of a folder, what begins with a dot too."""
    return {one.name: hashlib.sha256(one.read_bytes()).hexdigest() for one in sorted(folder.iterdir())}


def files(folder: Path) -> int:
    """Count the files of results."""
    return len(list(folder.glob("part-*")))


def ended(table: Sequence[object], out: Path, kills: int, rng: random.Random) -> int:
    """Start a batch until it ends by itself, and kill it up to so many times; give how often it was killed."""
    killed = 0
    while True:
        before = files(out)
        process = subprocess.Popen(command(table, out, rng.choice((1, 2, 3))))
        while killed < kills and files(out) == before and process.poll() is None:
            time.sleep(0.005)
        if killed < kills:
            time.sleep(rng.uniform(0.0, 0.4))
        if killed == kills or process.poll() is not None:
            if process.wait():
                sys.exit(f"exit status {process.returncode}")
            return killed
        process.send_signal(signal.SIGKILL)
        process.wait()
        killed += 1


def main(kills: int = 50, seed: int = 0) -> None:
    """Kill, compare, print."""
    rng = random.Random(seed)
    different = rounds = 0
    for table, share in zip(TABLES, (kills - kills // 2, kills // 2), strict=True):
        with tempfile.TemporaryDirectory() as folder:
            whole = Path(folder) / "whole"
            subprocess.run(command(table, whole, 1), check=True)
            while share:
                out = Path(folder) / str(rounds)
                share -= ended(table, out, share, rng)
                different += digests(out) != digests(whole)
                rounds += 1
    print(f"{kills} kills in {rounds} batches, {different} of which came out different")
    sys.exit(bool(different))


if __name__ == "__main__":
    if sys.argv[1:2] == ["--run"]:
        column, mean, deviation, cases, chunk, out, jobs = sys.argv[2:]
        run(column, float(mean), float(deviation), int(cases), int(chunk), out, int(jobs))
    else:
        os.chdir(tempfile.gettempdir())  # not beside a gapbeam that is not the installed one
        main(*map(int, sys.argv[1:]))
