"""The command ``gapbeam``: run a scene, check it, print the schema of scenes.

What a command does not need is not imported: checking a scene loads neither rich nor matplotlib.
"""

import argparse
import os
import re
import sys
import warnings
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from importlib.util import find_spec
from textwrap import shorten
from traceback import extract_tb
from typing import TYPE_CHECKING, NoReturn

from ..base.characters import visible
from ..base.errors import GapbeamError, SceneError, SceneFileError, Status
from ..base.memory import reserve
from ..base.progress import shown_progress
from .batch import add_batch
from .exits import FAILED, INTERRUPTED, NO_SOLUTION, REFUSED, SOLVED, say
from .new import add_new
from .outputs import Outputs, source, until_closed
from .proofs import add_proofs
from .studies import add_studies, refuse_moved

if TYPE_CHECKING:
    from ..results.cases.combined import CombinedResult
    from ..results.result import Result
    from ..scene.structs import Scene

#: Bytes of the address space that loading numpy and the engine takes, every further thread of OpenBLAS, their buffers, and
#: loading matplotlib
FOR_NUMPY, FOR_A_THREAD, FOR_BUFFERS, FOR_PICTURES = 200_000_000, 100_000_000, 80_000_000, 120_000_000

#: Solved by LAPACK, since a rigid beam on three rigid supports is
FOR_LAPACK = {"beam": {"spans": [1.0, 1.0], "EI": float("inf")}, "supports": [{"node": 0}, {"node": 1}, {"node": 2}]}

SCENE = """\
A small scene, beam.toml:

  title = "Two spans, the bearing in the middle can lift off"

  [units]                  # labels for the report only
  force = "kN"
  length = "m"

  [beam]
  spans = [6.0, 6.0]       # their ends are nodes 0, 1, 2
  EI = 1.0e4

  [[supports]]
  node = 0                 # or x = 0.0

  [[supports]]
  node = 1
  side = "below"           # pushes the beam up only; "above": down only; "both" (default)
  gap = 0.01               # to be closed before it acts

  [[supports]]
  node = 2

  [[loads]]
  type = "uniform"         # force, moment, uniform, linear, curvature, axial
  q = 20.0                 # from, to: the whole beam unless given
"""

SIGNS = """\
Signs:
  deflection, forces, distributed loads   positive downward
  support reactions                       positive upward
  bending moment                          positive sagging; shear is its derivative
  rotations, couples                      positive clockwise
  axial forces and displacements          positive to the right
Units: any consistent set. The scene's labels go into the report and change no number.
"""

STATUSES = """\
Exit status:
  0    solved, or the scene is valid
  1    the structure is unstable, or a combination or a position of a train is, or has no unique answer: the
       report says why
  2    refused: bad input, a file that cannot be read or written, or a scene without one single answer;
       a line on standard error for every mistake says where and why, no file is written
  3    failed: not enough memory, or a fault of gapbeam; one line says what happened and what to do
  130  ended by Ctrl-C: no file is written in part
  143  ended by SIGTERM, likewise
"""

DESCRIPTION = "Beams of many spans on supports that act on one side only, with gaps: a scene file in, a report out."


class Parser(argparse.ArgumentParser):
    """Refuses in one line, and says so when the help cannot be written."""

    def error(self, message: str) -> NoReturn:
        """Refuse.

        Parameters
        ----------
        message : str
            What is wrong.
        """
        scene = re.search(r"invalid choice: '([^']*\.(?:toml|json))'", message)
        raise SceneError(f"a command is missing; did you mean: gapbeam run {scene[1]}" if scene else
                         f"{message} (see {self.prog} --help)")  # fmt: skip

    def print_help(self, file: None = None) -> None:
        """Print the help.

        Parameters
        ----------
        file : None
            Standard output.
        """
        with until_closed():
            print(self.format_help(), end="", file=file)


def run(argv: Sequence[str] | None = None, make_parser: Callable[[], argparse.ArgumentParser] | None = None) -> int:
    """Run the command, whatever signals are to do.

    Parameters
    ----------
    argv : sequence of str, optional
        As for `gapbeam.cli.main`.
    make_parser : callable, optional
        Makes the parser of another command, whose defaults hold its function as ``command``; it ends as this one does.

    Returns
    -------
    int
        As there.
    """
    if argv is None:
        warnings.formatwarning = lambda message, *_: f"gapbeam: warning: {message}\n"
    try:
        if make_parser is None:
            refuse_moved(sys.argv[1:] if argv is None else argv)
        arguments = (make_parser or _parser)().parse_args(argv)
        if reserve(FOR_NUMPY + FOR_A_THREAD * (_threads() - 1)):
            _take_buffers()
        return arguments.command(arguments)
    except KeyboardInterrupt:
        return say(INTERRUPTED, "interrupted")
    except Exception as error:
        return _report(error)


def _take_buffers() -> None:
    """Let OpenBLAS take its buffers while there is memory for them: where it gets none it ends the process, with status 1."""
    import numpy as np

    from ..results.stepping import solve

    reserve(FOR_BUFFERS)
    np.linalg.inv(np.eye(2))
    with suppress(GapbeamError):
        solve(FOR_LAPACK)


def _threads() -> int:
    """Threads that OpenBLAS starts, as far as somebody has told it."""
    told = os.environ.get("OPENBLAS_NUM_THREADS", os.environ.get("OMP_NUM_THREADS", ""))
    return max(int(told), 1) if told.isdecimal() else os.cpu_count() or 1


def _report(error: Exception) -> int:
    """Say what went wrong, and whose fault it is."""
    lost = isinstance(error, RuntimeError) and "can't start new thread" in str(error)
    if isinstance(error, MemoryError) or lost or getattr(error, "status", None) == Status.NO_MEMORY:
        return say(FAILED, f"error: not enough memory{_reason(error)}; ask for fewer load steps or files, or give it more")
    if isinstance(error, SceneFileError):
        for line in error.args[0].splitlines():
            say(REFUSED, f"error: {line}")
        return REFUSED
    if isinstance(error, GapbeamError):
        return say(FAILED if getattr(error, "is_failure", False) else REFUSED, f"error: {error}")
    if isinstance(error, OSError) and error.filename is not None:
        return say(REFUSED, f"error: {os.fsdecode(error.filename)}: {error.strerror}")
    if isinstance(error, ImportError):
        while isinstance(error.__cause__, ImportError):
            error = error.__cause__
        return say(FAILED, f"error: a part of gapbeam cannot be loaded{_reason(error)}; give it more memory, or install it again")
    frames = [frame for frame in extract_tb(error.__traceback__) if os.path.dirname(frame.filename) == os.path.dirname(__file__)]
    place = f"{os.path.basename(frames[-1].filename)}, line {frames[-1].lineno}"
    return say(
        FAILED,
        f"internal error: {type(error).__name__}{_reason(error)} in {place}; this is a fault of gapbeam, not of the scene: "
        "please send this line, the scene and what gapbeam --version prints to those who maintain it",
    )


def _reason(error: Exception) -> str:
    return f" ({shorten(str(error), 300)})" if str(error) else ""


def _parser() -> argparse.ArgumentParser:
    plain = argparse.RawDescriptionHelpFormatter
    parser = Parser("gapbeam", description=DESCRIPTION, formatter_class=plain, epilog=f"{SCENE}\n{STATUSES}")
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version and stop")
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)

    run = commands.add_parser(
        "run", help="solve a scene and report", formatter_class=plain, epilog=f"{SCENE}\n{SIGNS}\n{STATUSES}",
        description="Solve a scene and print a report, the answer first: what lifts off and by how much, the largest values\n"
        "with their places; then reactions and openings, sums beside the loads, events, what governs.",
    )  # fmt: skip
    _add_scene(run)
    run.add_argument("--json", metavar="FILE", help="write everything as JSON (.json); - is standard output, without report")
    run.add_argument("--csv", metavar="FILE", help="write the fields along the beam at the last load step, of combinations "
                     "and trains their envelope, as a table (.csv); - is standard output, without report")  # fmt: skip
    run.add_argument("--xlsx", metavar="FILE", help="write the answer and the tables of supports, fields, combinations and events "
                     "for Excel (.xlsx); needs xlsxwriter: pip install \"gapbeam[excel]\"")  # fmt: skip
    run.add_argument("--plot", metavar="FILE", help="draw beam, deflection, moment, shear, with foundations pressure, of "
                     "combinations and trains their envelope (.png, .pdf or .svg)")  # fmt: skip
    run.add_argument("--path", metavar="FILE", help="draw reactions and openings (nonlinear: deflections), with foundations zones "
                     "of contact, over the load factor, every event marked; best with follow = \"events\" (.png, .pdf or "
                     ".svg)")  # fmt: skip
    run.add_argument("--html", metavar="FILE", help="write a page with a slider, tables and checks, to look at, print and sign "
                     "(.html); - is standard output, without report")  # fmt: skip
    run.add_argument("--quiet", action="store_true", help="print no report")
    run.add_argument("--limits", action="store_true", help="exit with status 1 if a limit of [limits] is exceeded")
    run.add_argument("--verbose", action="store_true", help="add equations, residuals and run time to the report")
    run.set_defaults(command=_run)

    check = commands.add_parser(
        "check", help="check a scene and say what it holds", formatter_class=plain,
        description="Validate a scene without solving it; print one line on what it holds.",
        epilog=f"{SCENE}\n{SIGNS}\n{STATUSES}",
    )  # fmt: skip
    _add_scene(check)
    check.set_defaults(command=_check)

    schema = commands.add_parser(
        "schema", help="print the JSON Schema of scenes or results", formatter_class=plain,
        description="Print the JSON Schema of scenes: editors complete and check scenes by it.",
        epilog="For editors with Taplo (Even Better TOML): gapbeam schema > gapbeam.schema.json, and as the first\n"
        f"line of a scene\n\n  #:schema ./gapbeam.schema.json\n\n{SCENE}\n{SIGNS}\n{STATUSES}",
    )  # fmt: skip
    schema.add_argument("--results", action="store_true", help="that of the JSON output instead, for programs that read it")
    schema.set_defaults(command=_schema)

    add_new(commands)
    add_batch(commands)
    add_proofs(commands)
    add_studies(commands)
    return parser


def _add_scene(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("scene", metavar="SCENE", help="a .toml or .json file; - is standard input")


class _Version(argparse.Action):
    """Looks the version up only when asked."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> NoReturn:
        from importlib.metadata import version

        with until_closed():
            print(f"gapbeam {version('gapbeam')}")
        parser.exit()


def _run(arguments: argparse.Namespace) -> int:
    names = {"--json": arguments.json, "--csv": arguments.csv, "--xlsx": arguments.xlsx, "--plot": arguments.plot,
             "--path": arguments.path, "--html": arguments.html}  # fmt: skip
    outputs = Outputs(names, arguments.scene)
    if "--xlsx" in outputs and find_spec("xlsxwriter") is None:
        raise SceneError("--xlsx", 'needs xlsxwriter, which is not installed: pip install "gapbeam[excel]"')
    from ..results.stepping import solve
    from ..scene.reading import read_scene

    scene = read_scene(source(arguments.scene))
    if arguments.limits and scene.limits is None:
        raise SceneError("--limits", "the scene has no [limits] that could be exceeded; give some, or leave the option out")
    if scene.combinations and "--path" in outputs:
        raise SceneError("--path", "draws the way of one load, and the scene has combinations; leave it out, or draw that of one "
                         'of them in Python: gapbeam.solve(SCENE).combinations[NAME].plot("path")')  # fmt: skip
    with shown_progress("solving", not arguments.quiet):
        result = solve(scene)
    solved = result.status == "solved"
    from ..report.text import print_report

    with shown_progress("writing files", not arguments.quiet and not outputs.on_standard_output):
        contents = _contents(arguments, outputs, result)
        outputs.write(contents)
    if not arguments.quiet and not outputs.on_standard_output:
        with until_closed():  # after the files: the reader of the report, such as head, may leave early
            print_report(result, verbose=arguments.verbose)
    elif not solved:
        say(NO_SOLUTION, result.reason)
    for option in ("--csv", "--xlsx", "--path"):
        if option in outputs and option not in contents:
            say(NO_SOLUTION, f"{outputs[option]} is not written: there is nothing to show without equilibrium")
    exceeded = [name for name, one in result.utilisations.items() if one.ratio > 1.0] if arguments.limits else []
    if exceeded:
        say(NO_SOLUTION, f"beyond its limit: {', '.join(exceeded)}")
    return SOLVED if solved and not exceeded else NO_SOLUTION


def _contents(
    arguments: argparse.Namespace, outputs: Outputs, result: "Result | CombinedResult"
) -> dict[str, bytes | Iterable[str]]:
    """Make what the options ask for."""
    from ..report.json_csv import csv_parts, json_parts, to_json

    if "--plot" in outputs or "--path" in outputs:
        reserve(FOR_PICTURES)
    contents: dict[str, bytes | Iterable[str]] = {}
    if "--json" in outputs:
        # A file grows part by part; what goes to standard output is made first, so that no failure cuts it off
        contents["--json"] = [to_json(result)] if outputs["--json"] == "-" else json_parts(result)
    if "--csv" in outputs and result.has_envelope:
        contents["--csv"] = csv_parts(result)
    if "--xlsx" in outputs and result.has_envelope:
        from ..results.answer import answer, headline
        from ..show.excel import excel_bytes, tables_of

        contents["--xlsx"] = excel_bytes([headline(result), *answer(result)], tables_of(result))
    if "--plot" in outputs:
        from ..plots.result import figure
        from ..plots.save import picture

        contents["--plot"] = picture(figure(result), outputs.suffix("--plot"))
    if "--path" in outputs and result.steps:
        from ..plots.path import path_figure
        from ..plots.save import picture

        contents["--path"] = picture(path_figure(result), outputs.suffix("--path"))
    if "--html" in outputs:
        from ..html.page import Source, html_page

        contents["--html"] = [html_page(result, None if arguments.scene == "-" else Source.of_file(arguments.scene))]
    return contents


def _check(arguments: argparse.Namespace) -> int:
    from ..results.formatting import count, number, unit
    from ..scene.combinations import plan_combinations
    from ..scene.reading import read_scene

    scene = read_scene(source(arguments.scene))
    length = f"{number(float(scene.span_ends()[-1]))} {unit(scene, 'x')}".rstrip()
    one_sided = sum(support.side != "both" for support in scene.supports)
    parts = [
        f"{count(len(scene.beam.spans), 'span')}, {length}",
        f"{count(len(scene.supports), 'support')}, {one_sided:,} of them one-sided",
        *_foundations(scene),
        count(len(scene.loads), "load"),
        *([count(len(plan_combinations(scene)), "combination")] if scene.combinations else []),
        *([count(len(scene.trains), "train")] if scene.trains else []),
    ]
    with until_closed():
        print(f"{visible(arguments.scene)}: valid: " + "; ".join(parts))
    return SOLVED


def _foundations(scene: "Scene") -> list[str]:
    """Count the foundations, if there are any."""
    from ..results.formatting import count

    one_sided = sum(item.side != "both" for item in scene.foundation)
    return [f"{count(len(scene.foundation), 'foundation')}, {one_sided:,} of them one-sided"] if scene.foundation else []


def _schema(arguments: argparse.Namespace) -> int:
    import json

    if arguments.results:
        from ..results.result_schema import result_schema as schema
    else:
        from ..scene.schema import scene_schema as schema

    with until_closed():
        print(json.dumps(schema(), indent=2, allow_nan=False))
    return SOLVED
