"""The command: what it attacks, prints and writes."""

import argparse
import json
import sys
import time
import traceback
from functools import partial
from pathlib import Path

from . import events, hinges, signs
from .table import Row, markdown
from .verdict import Verdict
from .workers import judge_all

FAMILIES = {family.NAME: family for family in (events, signs, hinges)}


def judge_seed(family, seed):
    """Draw the case of a seed and judge it; the case itself is kept only where something is wrong."""
    kind, made = family.draw_scene(seed)
    return kind, judged(family, made, seed)


def judged(family, made, seed):
    """The verdict on a case; an exception that the program does not promise is one, too."""
    try:
        return family.judge(made, seed)
    except Exception as error:
        return Verdict("raised", [f"{type(error).__name__}: {error} ({traceback.extract_tb(error.__traceback__)[-1]})"])


def attack(family, seeds, jobs, limit, seconds, folder):
    """Judge the cases of one family.

    Parameters
    ----------
    family : module
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
    row = Row(family.NAME, family.PROMISE)
    begin = time.monotonic()
    for seed, answer in judge_all(partial(judge_seed, family), seeds, jobs, limit, begin + seconds):
        kind, verdict = answer if isinstance(answer, tuple) else ("", answer)
        row.add(verdict)
        if verdict.wrong:
            path = write_failure(family, seed, verdict, folder)
            print(f"{path} ({kind}, {verdict.outcome}): {'; '.join(verdict.wrong)[:500]}", flush=True)
    row.seconds = time.monotonic() - begin
    return row


def write_failure(family, seed, verdict, folder):
    """Write the scene that failed; its title says what is wrong."""
    _, made = family.draw_scene(seed)
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{family.NAME}-{seed}.json"
    path.write_text(json.dumps({"title": f"{family.NAME} {seed}: {'; '.join(verdict.wrong)}"[:2000], **made}) + "\n")
    return path


def judge_again(path, name):
    """Judge a scene that was written."""
    family = FAMILIES[name or Path(path).name.partition("-")[0]]
    made = json.loads(Path(path).read_text())
    seed = int("".join(c for c in made.pop("title", "").partition(":")[0] if c.isdigit()) or 0)
    verdict = judged(family, made, seed)
    print(verdict.outcome, *verdict.wrong, sep="\n")
    return 1 if verdict.wrong else 0


def command_line(chosen):
    """What was asked, as far as it matters for the page."""
    words = ["python tests/attack", f"--count {chosen.count}", *(f"--family {name}" for name in chosen.family or ())]
    return " ".join([*words, f"--markdown {chosen.markdown}"])


def main(arguments=None):
    """The command; its exit status is 1 if something is wrong."""
    parser = argparse.ArgumentParser("python tests/attack", description=__doc__.splitlines()[0])
    parser.add_argument("--family", choices=FAMILIES, action="append", help="one family, may be repeated; default all")
    parser.add_argument("--count", type=int, default=1000, help="cases of each family (default 1000)")
    parser.add_argument("--seconds", type=float, default=float("inf"), help="time for each family; default no limit")
    parser.add_argument("--seed", type=int, default=0, help="first seed (default 0)")
    parser.add_argument("--jobs", type=int, default=1, help="processes (default 1)")
    parser.add_argument("--limit", type=float, default=20.0, help="seconds after which a case counts as a hang (default 20)")
    parser.add_argument("--failures", type=Path, default=Path("attack-failures"), metavar="FOLDER", help="where failures are written")
    parser.add_argument("--scene", metavar="FILE", help="judge one scene that was written, nothing else")
    parser.add_argument("--markdown", type=Path, metavar="FILE", help="write the page of the documentation")
    chosen = parser.parse_args(arguments)
    if chosen.scene:
        return judge_again(chosen.scene, (chosen.family or [None])[0])
    rows = []
    for name in chosen.family or FAMILIES:
        seeds = range(chosen.seed, chosen.seed + chosen.count)
        row = attack(FAMILIES[name], seeds, chosen.jobs, chosen.limit, chosen.seconds, chosen.failures)
        print(row.text(), flush=True)
        rows.append(row)
    if chosen.markdown:
        chosen.markdown.write_text(markdown(rows, command_line(chosen)))
    return 1 if any(row.wrong for row in rows) else 0
