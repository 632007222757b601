"""Models drawn at random through the C interface (`models.c`), built with the address and the undefined-behaviour sanitizers."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

from .family import Family, Verdict
from .workers import judge_all

PROMISE = (
    "Whatever the arrays of a model hold: no access outside them, no undefined operation, no leak, no end of the process. "
    "Statuses are those documented, and an error writes nothing. What is solved is finite, and the floating-point "
    "environment is the caller's again"
)
TOP = Path(__file__).parents[2]
BUILD = TOP / ".venv" / "build" / "checks"
DRIVER = BUILD / "tests" / "attack_models"
AT_A_TIME = 200
OUTCOMES = {
    0: "solved", 1: "no-equilibrium", 11: "bad input", 12: "indeterminate", 13: "not converged", 14: "not finite", 15: "no memory",
    17: "other version",
}  # fmt: skip


def build():
    """Build the driver, in the folder and with the options that `tests/run` has for its build with checks."""
    tools = os.environ | {"PATH": os.pathsep.join((str(Path(sys.executable).parent), os.environ["PATH"]))}
    commands = [["ninja", "-C", BUILD, DRIVER.relative_to(BUILD)]]
    if not (BUILD / "build.ninja").exists():
        commands.insert(0, ["meson", "setup", BUILD, TOP, "--native-file", TOP / "tests" / "checked.ini"])
    for command in commands:
        if shutil.which(command[0], path=tools["PATH"]) is None:
            sys.exit(f"models: {command[0]} is needed to build them: sh tests/run sets it up")
        done = subprocess.run(list(map(str, command)), env=tools, capture_output=True, text=True)
        if done.returncode:
            sys.exit(f"models: {done.stdout}{done.stderr}")


def run(seeds, limit):
    """Judge the models of some seeds in one process, and again from the next one where it ends before its time.

    Parameters
    ----------
    seeds : range
    limit : float
        Seconds for one.

    Returns
    -------
    list of (int, Verdict)
    """
    found, first = [], seeds.start
    while first < seeds.stop:
        command = [DRIVER, str(first), str(seeds.stop - first), str(max(int(limit), 1))]
        done = subprocess.run(command, capture_output=True, text=True, errors="replace")
        here = read_lines(done.stdout)
        last = here[-1][0] if here else first
        if not here or not here[-1][1].outcome:
            end = ("hang", f"no answer within {limit:g} s") if done.returncode == -14 else ("aborted", summary(done))
            if not here:
                here = [(first, Verdict())]
            here[-1][1].outcome = end[0]
            here[-1][1].wrong.append(end[1])
        elif done.returncode not in (0, 1):  # all are done: something is left over
            if len(seeds) > 1:
                return [pair for seed in seeds for pair in run(range(seed, seed + 1), limit)]
            here[-1][1].wrong.append(summary(done))
        found += here
        first = last + 1
    return found


def read_lines(text):
    """Pairs of seed and verdict from what the driver prints."""
    found = []
    for line in text.splitlines():
        if line.startswith("! "):
            found[-1][1].wrong.append(line[2:])
        elif line.startswith("= "):
            status = int(line[2:])
            found[-1][1].outcome = OUTCOMES.get(status, f"status {status}")
        elif line.strip().isdigit():
            found.append((int(line), Verdict()))
    return found


def summary(done):
    """What the sanitizers say, or how the process ended."""
    lines = [line for line in done.stderr.splitlines() if "ERROR" in line or "runtime error" in line or "SUMMARY" in line]
    return "; ".join(lines[:3]) or f"the process ended with status {done.returncode}: {done.stderr[-200:]}"


class Models(Family):
    """The family that runs many cases in one process of the driver."""

    def verdicts(self, seeds, jobs, limit, until):
        build()
        chunks = [range(k, min(k + AT_A_TIME, seeds.stop)) for k in range(seeds.start, seeds.stop, AT_A_TIME)]
        for _, found in judge_all(lambda chunk: run(chunk, limit), chunks, jobs, float("inf"), until):
            yield from found


def draw(seed):
    """The seed is the case: the driver draws it."""
    return "", seed


def judge(_, seed):
    """The verdict on one seed."""
    build()
    ((_, verdict),) = run(range(seed, seed + 1), 20.0)
    return verdict


def write(seed, title):
    """The model in words."""
    text = subprocess.run([DRIVER, str(seed)], capture_output=True, text=True).stdout
    return ".txt", f"{title}\n{text}".encode()


def read(path):
    """The seed of a model that was written."""
    seed = int(path.read_text().split()[1].rstrip(":"))
    return seed, seed


FAMILY = Models("models", PROMISE, draw, judge, write, read)
