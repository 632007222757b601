"""Limits of the address space: every task under limits from nothing at all to enough, each time in a process of its own."""

import contextlib
import ctypes
import faulthandler
import gc
import io
import json
import os
import pickle
import random
import re
import resource
import signal
import sys
from functools import cache
from pathlib import Path

import gapbeam
import numpy as np
from gapbeam.base.errors import Status
from gapbeam.cli import main
from gapbeam.report import to_json
from gapbeam.studies.meshes import gapped_spans
from studies.schemes import lifted_end, sprung_base

from .family import Family, Verdict, write_scene

PROMISE = (
    "Under any limit of the address space a call gives the right result or ends in a MemoryError. A load case of many ends "
    "in a status, the command in one line. The process continues, nothing is printed, and the next call has its memory "
    "again"
)
RIGHT, REFUSED, WRONG = 40, 41, 42  # exit statuses that nothing else gives
SECONDS = 20


def numbers(result):
    return [step.reaction.tolist() for step in result.steps], [(event.factor, event.support) for event in result.events]


def by_steps(made):
    return numbers(gapbeam.solve({**made, "analysis": {"steps": 3}}))


def by_events(made):
    return numbers(gapbeam.solve({**made, "analysis": {"follow": "events"}}))


def fields(made):
    result = gapbeam.solve(made)
    return result._pairs_of_extremes(), result.fields().to_dict(), result.steps[-1].undecided


def cases(made):
    """Reactions; a case for which there was no memory says so in its status, and the others go on."""
    beam = gapbeam.prepare(made)
    found = beam.solve([[1.0 + 0.01 * k] * len(made["loads"]) for k in range(50)])
    if np.any(found.status == Status.NO_MEMORY):
        raise MemoryError
    return found.reaction.tolist()


def written(made):
    return re.sub(r'"seconds": \S+', "", to_json(gapbeam.solve(made)))


def command(made):
    """The report; an exit status above 1 with one line on standard error is a refusal."""
    out, err, stdin = io.StringIO(), io.StringIO(), sys.stdin
    sys.stdin = io.TextIOWrapper(io.BytesIO(json.dumps(made).encode()))
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        status = main(["run", "-", "--csv", "-"])
    sys.stdin = stdin
    if status > 1 and err.getvalue().count("\n") == 1 and not out.getvalue():
        raise MemoryError
    return status, out.getvalue(), err.getvalue()


TASKS = {task.__name__: task for task in (by_steps, by_events, fields, cases, written, command)}
SCENES = {"gaps": gapped_spans, "springs": sprung_base, "lifted": lifted_end}


def draw(seed):
    """Kind; and task, beam, its supports, and the share of the memory that it needs."""
    rng = random.Random(seed)
    task, beam = rng.choice(list(TASKS)), rng.choice(list(SCENES))
    return task, (task, beam, rng.choice((20, 20, 100, 100, 400)), rng.random() ** 3)


@cache
def get_ready():
    """Import what tasks import when they first need it, and let the stack grow: a limit would end the process where it does.

    No task here begins a thread, whose memory would stay.
    """
    json.loads("[" * 900 + "]" * 900)
    for task in (fields, written, command):
        task(SCENES["gaps"](3))


@cache
def known(task, beam, count):
    """Scene, result without a limit, and the memory that it takes; found out in a process of its own, which leaves nothing here."""
    get_ready()
    made = SCENES[beam](count)
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        give_back()
        before = in_use()
        result = TASKS[task](made)
        with os.fdopen(writing, "wb") as pipe:
            pickle.dump((result, peak() - before), pipe)
        os._exit(0)
    os.close(writing)
    with os.fdopen(reading, "rb") as pipe:
        expected, needed = pickle.load(pipe)
    os.waitpid(child, 0)
    return made, expected, needed


def give_back():
    """Give back what is free: it would count as room under a limit."""
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)


def in_use():
    """Addresses in use, bytes."""
    return int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()


def peak():
    """The most that were, bytes."""
    return int(re.search(r"VmPeak:\s+(\d+)", Path("/proc/self/status").read_text())[1]) * 1024


def judge(case, seed=0):
    """Do one task under one limit.

    Parameters
    ----------
    case : (str, str, int, float)
        Task, beam, its supports, and the limit as a share of the memory that the task needs.
    seed : int
        Not used.

    Returns
    -------
    Verdict
    """
    task, beam, count, share = case
    made, expected, needed = known(task, beam, count)
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        end = WRONG
        try:
            os.dup2(writing, 1)
            os.dup2(writing, 2)
            faulthandler.enable(2)  # says where, if it comes to that
            signal.alarm(SECONDS)
            end = attempt(TASKS[task], made, expected, int(share * needed))
        finally:
            os._exit(end)
    os.close(writing)
    with os.fdopen(reading, errors="replace") as pipe:
        said = pipe.read()
    _, how = os.waitpid(child, 0)
    verdict = Verdict("result")
    if os.WIFSIGNALED(how):
        name = signal.Signals(os.WTERMSIG(how)).name
        verdict.outcome = "hang" if name == "SIGALRM" else "aborted"
        verdict.wrong.append(f"ended by {name} under {share:.4f} of {needed:,} bytes")
    elif os.WEXITSTATUS(how) == REFUSED:
        verdict.outcome = "no memory"
    elif os.WEXITSTATUS(how) != RIGHT:
        verdict.outcome = "wrong" if os.WEXITSTATUS(how) == WRONG else "aborted"
        verdict.wrong.append(f"exit status {os.WEXITSTATUS(how)} under {share:.4f} of {needed:,} bytes")
    if said:
        verdict.wrong.append(f"said: {' '.join(said.split())[:300]}")
    return verdict


def attempt(task, made, expected, room):
    """Do a task with so many bytes more than are in use, and once more without a limit; how it ended."""
    give_back()
    hard = resource.getrlimit(resource.RLIMIT_AS)[1]
    resource.setrlimit(resource.RLIMIT_AS, (in_use() + room, hard))
    result, problem = None, None
    try:
        result = task(made)
    except MemoryError:
        pass
    except BaseException as error:
        problem = error
    resource.setrlimit(resource.RLIMIT_AS, (hard, hard))
    if problem is not None:
        os.write(2, f"{type(problem).__name__}: {problem}\n".encode())
        return WRONG
    if result is not None and result != expected:
        os.write(2, b"another result than without a limit\n")
        return WRONG
    if result is None and task(made) != expected:
        os.write(2, b"after a refusal the next result is wrong\n")
        return WRONG
    return REFUSED if result is None else RIGHT


def write(case, title):
    """The scene; its title begins with the case."""
    task, beam, count, share = case
    return write_scene(SCENES[beam](count), f"{task} {beam} {count} {share!r}: {title}")


def read(path):
    """The case that a title begins with."""
    task, beam, count, share = json.loads(path.read_bytes())["title"].partition(":")[0].split()
    return (task, beam, int(count), float(share)), 0


FAMILY = Family("memory", PROMISE, draw, judge, write, read, share=0.08)
