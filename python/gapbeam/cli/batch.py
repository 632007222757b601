"""The batches of the command line: ``gapbeam batch ...``."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import perf_counter
from typing import TYPE_CHECKING

from ..base.errors import SceneError
from .exits import FAILED, NO_SOLUTION, SOLVED, say
from .outputs import Outputs, source, until_closed

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from ..batches.batch import Batch

TEXT = """\
A column of TABLE is a key path of the scene (supports.R-104.gap, loads[2].q, beam.EI), or factors.CASE; a row is a case:

  supports.R-104.gap,factors.wind
  0.012,1.0
  0.007,-0.8

Files of results can be read in one line, also while the batch runs: pandas.read_parquet("DIR"),
polars.read_parquet("DIR/*.parquet"), duckdb: select * from 'DIR/*.parquet'. Without pyarrow they are .npy.

After any interruption the same command resumes the batch, and the files are the same to the last byte.

Exit status: 0 all cases are solved, 1 not all, 2 refused, 3 failed (cases too, for lack of memory), 130 ended by Ctrl-C, 143 by
SIGTERM.
"""


def add_batch(commands: argparse._SubParsersAction) -> None:
    """Add the command ``batch``.

    Parameters
    ----------
    commands : argparse._SubParsersAction
        The commands of ``gapbeam``.
    """
    parser = commands.add_parser(
        "batch", help="solve a scene for every row of a table", formatter_class=argparse.RawDescriptionHelpFormatter, epilog=TEXT,
        description="Solve a scene for every row of a table, or every scene of a folder, into a folder of results.",
    )  # fmt: skip
    parser.add_argument("scene", metavar="SCENE", nargs="?", help="a .toml or .json file, or a folder of them; - is standard input")
    parser.add_argument("table", metavar="TABLE", nargs="?", help="a .csv or .parquet file; none with a folder of scenes")
    parser.add_argument("--out", metavar="DIR", help="the folder for the results")
    parser.add_argument("--want", metavar="NAMES", help="what is kept of every case, separated by commas: input, reaction, "
                        "opening, couple, error_bound, fields such as moment, or moment@1.5 at a point, limit.factor (default "
                        "input,reaction,opening,deflection,moment)")  # fmt: skip
    parser.add_argument("--jobs", metavar="N", type=int, help="number of cores (default all)")
    parser.add_argument("--dask", metavar="ADDRESS", help="use the workers of a Dask scheduler instead, such as "
                        "tcp://host:8786")  # fmt: skip
    parser.add_argument("--part", metavar="I/N", help="solve only part I of N, while other commands solve the others into the same "
                        "folder, as of a job array: 1/64 to 64/64")  # fmt: skip
    parser.add_argument("--retry-failed", action="store_true", help="solve those files again that hold cases which were refused, "
                        "have no answer or failed")  # fmt: skip
    parser.add_argument("--summary", metavar="DIR", help="print how the results in a folder are distributed, also while its batch "
                        "runs; nothing is solved")  # fmt: skip
    parser.add_argument("--limit", metavar="NAME=VALUE", action="append", default=[], help="with --summary: count the cases whose "
                        "result of this name is greater; more than once if need be")  # fmt: skip
    parser.add_argument("--json", metavar="FILE", help="with --summary: write all of it as JSON (.json); - is standard output")
    parser.add_argument("--plot", metavar="FILE", help="with --summary: draw histograms (.png, .pdf or .svg)")
    parser.add_argument("--quiet", action="store_true", help="show no progress and print nothing")
    parser.set_defaults(command=_batch)


def _batch(arguments: argparse.Namespace) -> int:
    if arguments.summary is not None:
        return _summarize(arguments)
    for option in ("limit", "json", "plot"):
        if getattr(arguments, option):
            raise SceneError(f"--{option}", "is for a folder of results; give --summary DIR")
    if arguments.scene is None or arguments.out is None:
        raise SceneError("batch", "give SCENE, TABLE and --out DIR")
    from ..batches.run import run_batch

    if arguments.jobs is not None and arguments.jobs < 1:
        raise SceneError("--jobs", f"expected a positive number, got {arguments.jobs}")
    part = None if arguments.part is None else _part(arguments.part)
    want = None if arguments.want is None else [name.strip() for name in arguments.want.split(",")]
    scene = arguments.scene if os.path.isdir(arguments.scene) else source(arguments.scene)
    with _executor(arguments) as executor, _progress(not arguments.quiet) as progress:
        clock = _Clock(progress)
        done = run_batch(
            scene, arguments.table, arguments.out, want, arguments.jobs, executor, arguments.retry_failed, None, part, clock,
            by_processes=True,
        )
    return _tell(done, arguments.quiet, clock, "" if part is None else f", part {arguments.part}")


def _part(text: str) -> tuple[int, int]:
    """Read which part of a batch is to be solved."""
    number, slash, of = text.partition("/")
    if not (slash and number.isdecimal() and of.isdecimal() and 1 <= int(number) <= int(of)):
        raise SceneError("--part", f'expected a number and how many parts there are, 1/64 to 64/64, got "{text}"')
    return int(number), int(of)


@contextmanager
def _executor(arguments: argparse.Namespace) -> Iterator[Executor | None]:
    """Dask's workers, or none."""
    if arguments.dask is None:
        yield None
        return
    try:
        from distributed import Client
    except ModuleNotFoundError:
        raise SceneError("--dask", "needs Dask: pip install gapbeam[dask]") from None
    try:
        client = Client(arguments.dask, timeout=10)
    except (OSError, ValueError) as error:
        raise SceneError("--dask", f"no scheduler answers at {arguments.dask} ({error})") from None
    with client:
        if arguments.jobs is None:
            arguments.jobs = max(sum(client.ncores().values()), 1)
        yield client.get_executor()


@contextmanager
def _progress(wanted: bool) -> Iterator[Callable[[int, int], None] | None]:
    """A bar with rate and time left, on a terminal."""
    if not wanted or sys.stderr is None or not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (BarColumn(), TextColumn("{task.fields[count]}  {task.fields[rate]}"), TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True)) as bar:
        task = bar.add_task("", total=1, count="", rate="")
        clock = _Clock()

        def progress(done: int, total: int) -> None:
            clock(done, total)
            rate = f"{clock.rate:,.0f} a second" if clock.cases else ""
            bar.update(task, completed=done, total=total, count=f"{done:,} of {total:,} cases", rate=rate)

        yield progress


def _summarize(arguments: argparse.Namespace) -> int:
    """Tell how the results in a folder are distributed."""
    if arguments.scene is not None or arguments.out is not None:
        raise SceneError("--summary", "solves nothing; leave SCENE, TABLE and --out out")
    outputs = Outputs({"--json": arguments.json, "--plot": arguments.plot})
    from ..batches.batch import Batch
    from ..scene.wording import out_of_range

    limits: dict[str, list[float]] = {}
    for text in arguments.limit:
        name, _, value = text.rpartition("=")
        try:
            limit = float(value)
        except ValueError:
            raise SceneError("--limit", f'expected a name and a number, such as reaction.R-101=12.5, got "{text}"') from None
        if problem := out_of_range(value, limit):
            raise SceneError("--limit", f"{name}: {problem}")
        limits.setdefault(name, []).append(limit)
    summary = Batch(arguments.summary).summary(limits=limits)
    contents: dict[str, bytes | list[str]] = {}
    if "--json" in outputs:
        import json

        contents["--json"] = [json.dumps(summary.to_dict(), indent=1, allow_nan=False) + "\n"]
    if "--plot" in outputs:
        from ..plots.batch import summary_figure
        from ..plots.save import picture

        contents["--plot"] = picture(summary_figure(summary), outputs.suffix("--plot"))
    outputs.write(contents)
    if not arguments.quiet and not outputs.on_standard_output:
        from ..report.batch import print_summary

        with until_closed():
            print_summary(summary)
    return SOLVED


class _Clock:
    """Counts the cases that are solved now, and the time it takes."""

    def __init__(self, progress: Callable[[int, int], None] | None = None):
        self._progress = progress
        self.before: int | None = None
        self.cases, self.begin, self.seconds = 0, perf_counter(), 0.0

    def __call__(self, done: int, total: int) -> None:
        self.before = done if self.before is None else self.before
        self.cases, self.seconds = done - self.before, perf_counter() - self.begin
        if self._progress is not None:
            self._progress(done, total)

    @property
    def rate(self) -> float:
        """Cases a second."""
        return self.cases / self.seconds


def _tell(done: Batch, quiet: bool, clock: _Clock, part: str) -> int:
    """Say how many cases there are by their outcome."""
    statuses = done.statuses()
    counts = ", ".join(f"{count:,} {status}" for status, count in statuses.items())
    if clock.cases:
        counts += f"; {clock.cases:,} of them in {clock.seconds:.3g} s, {clock.rate:,.0f} a second"
    if not quiet:
        with until_closed():
            print(f"{done.path}{part}: {done.done:,} of {done.cases:,} cases: {counts}")
    if "failed" in statuses:
        return say(FAILED, f"error: {statuses['failed']:,} cases failed: {done.reasons()['failed']}")
    return SOLVED if set(statuses) <= {"solved"} else NO_SOLUTION
