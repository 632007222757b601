"""The command: what it attacks, prints and writes."""

import argparse
import math
import time
from pathlib import Path

from . import (
    axial_force,
    batches,
    combinations,
    curves,
    doubled,
    enumeration,
    events,
    falling,
    ground,
    hinges,
    laws,
    layers,
    memory,
    mixed,
    models,
    mutants,
    roads,
    signs,
    softening,
    trains,
    yielding,
)  # fmt: skip
from .table import Row, markdown

MODULES = (
    enumeration, events, signs, hinges, laws, yielding, softening, curves, doubled, ground, falling, layers, trains, combinations,
    batches, roads, mixed, axial_force, mutants, models, memory,
)  # fmt: skip
FAMILIES = {module.FAMILY.name: module.FAMILY for module in MODULES}


def attack(family, seeds, jobs, limit, seconds, folder):
    """Judge the cases of one family.

    Parameters
    ----------
    family : Family
    seeds : iterable of int
    jobs : int
    limit, seconds : float
        Time for one case, and for all.
    folder : Path
        Where failures are written.

    Returns
    -------
    Row
    """
    row, begin = Row(family.name, family.promise), time.monotonic()
    for seed, verdict in family.verdicts(seeds, jobs, limit, begin + seconds):
        row.add(verdict)
        if verdict.wrong:
            name, text = family.failure(seed, verdict)
            folder.mkdir(parents=True, exist_ok=True)
            (folder / name).write_bytes(text)
            print(f"{folder / name} ({verdict.kind}, {verdict.outcome}): {'; '.join(verdict.wrong)[:500]}", flush=True)
    row.seconds = time.monotonic() - begin
    return row


def judge_again(path, name):
    """Judge a case that was written."""
    family = FAMILIES[name or path.name.partition("-")[0]]
    verdict = family.judged(*family.read(path))
    print(verdict.outcome, *verdict.wrong, sep="\n")
    return 1 if verdict.wrong else 0


def command_line(chosen):
    """What was asked, as far as it matters for the page."""
    words = ["python tests/attack", f"--count {chosen.count}", *(f"--family {name}" for name in chosen.family or ())]
    words += [f"--seconds {chosen.seconds:g}"] if chosen.seconds < float("inf") else []
    return " ".join([*words, f"--markdown {chosen.markdown}"])


def main(arguments=None):
    """The command; its exit status is 1 if something is wrong."""
    parser = argparse.ArgumentParser("python tests/attack", description=__doc__.splitlines()[0])
    parser.add_argument("--family", choices=FAMILIES, action="append", help="one family, may be repeated; default all")
    parser.add_argument("--count", type=int, default=1000, help="cases of each family (default 1000), fewer where they take long")
    parser.add_argument("--seconds", type=float, default=float("inf"), help="time for each family; default no limit")
    parser.add_argument("--seed", type=int, default=0, help="first seed (default 0)")
    parser.add_argument("--jobs", type=int, default=1, help="processes (default 1)")
    parser.add_argument("--limit", type=float, default=30.0, help="seconds after which a case counts as a hang (default 30)")
    parser.add_argument("--failures", type=Path, default=Path("attack-failures"), metavar="FOLDER", help="for what failed")
    parser.add_argument("--scene", type=Path, metavar="FILE", help="judge one scene that was written, nothing else")
    parser.add_argument("--markdown", type=Path, metavar="FILE", help="write the page of the documentation")
    chosen = parser.parse_args(arguments)
    if chosen.scene:
        return judge_again(chosen.scene, (chosen.family or [None])[0])
    rows = []
    for name in chosen.family or FAMILIES:
        seeds = range(chosen.seed, chosen.seed + math.ceil(FAMILIES[name].share * chosen.count))
        row = attack(FAMILIES[name], seeds, chosen.jobs, chosen.limit, chosen.seconds, chosen.failures)
        print(row.text(), flush=True)
        rows.append(row)
    if chosen.markdown:
        chosen.markdown.write_text(markdown(rows, command_line(chosen)))
    return 1 if any(row.wrong for row in rows) else 0
