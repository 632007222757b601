"""The command ``gapbeam``: run a scene, check it, print the schema of scenes.

What a command does not need is not imported: checking a scene loads neither rich nor matplotlib.
"""

import argparse
import json
import os
import sys
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import NoReturn

from .errors import GapbeamError, SceneError

#: Exit statuses
SOLVED, NO_SOLUTION, BAD_INPUT = 0, 1, 2

#: Suffixes of pictures
PICTURES = (".png", ".pdf", ".svg")

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
  0  solved, or the scene is valid
  1  the structure cannot stand: the report says how it moves
  2  bad input: one line on standard error, nothing is written
"""

DESCRIPTION = "Beams of many spans on supports that act on one side only, with gaps: a scene file in, a report out."


class _Parser(argparse.ArgumentParser):
    """Refuses in one line."""

    def error(self, message: str) -> NoReturn:
        raise SceneError(f"{message} (see {self.prog} --help)")


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command.

    Parameters
    ----------
    argv : sequence of str, optional
        Arguments without the name of the program; default ``sys.argv[1:]``.

    Returns
    -------
    int
        Exit status: 0 solved or valid, 1 the structure cannot stand, 2 bad input.
    """
    try:
        arguments = _parser().parse_args(argv)
        return arguments.command(arguments)
    except (GapbeamError, OSError) as error:
        print(f"gapbeam: error: {_one_line(error)}", file=sys.stderr)
        return BAD_INPUT


@contextmanager
def _until_closed() -> Iterator[None]:
    """Write to standard output until its reader has seen enough; a title may hold characters it has not."""
    if hasattr(sys.stdout, "reconfigure"):
        sys.stdout.reconfigure(errors="replace")
    try:
        yield
        sys.stdout.flush()
    except (BrokenPipeError, SystemExit):  # rich turns the first into the second
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _one_line(error: Exception) -> str:
    if isinstance(error, OSError) and error.filename is not None:
        return f"{error.filename}: {error.strerror}"
    return " ".join(str(error).split())


def _parser() -> argparse.ArgumentParser:
    plain = argparse.RawDescriptionHelpFormatter
    parser = _Parser("gapbeam", description=DESCRIPTION, formatter_class=plain, epilog=f"{SCENE}\n{STATUSES}")
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version and stop")
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)

    run = commands.add_parser(
        "run", help="solve a scene and report", formatter_class=plain, epilog=f"{SCENE}\n{SIGNS}\n{STATUSES}",
        description="Solve a scene and print a report: the system, which supports act over the load, reactions and "
        "openings,\nextremes with their places, residuals against run time.",
    )  # fmt: skip
    _add_scene(run)
    run.add_argument("--json", metavar="FILE", help="write everything as JSON; - is standard output, without report")
    run.add_argument("--csv", metavar="FILE", help="write the fields along the beam at the last load step as a table; "
                     "- is standard output, without report")  # fmt: skip
    run.add_argument("--plot", metavar="FILE", help="draw beam, deflection, moment and shear (.png, .pdf or .svg)")
    run.add_argument("--path", metavar="FILE", help="draw reactions and openings over the load factor, every event marked; "
                     "best with follow = \"events\" (.png, .pdf or .svg)")  # fmt: skip
    run.add_argument("--quiet", action="store_true", help="print no report")
    run.set_defaults(command=_run)

    check = commands.add_parser(
        "check", help="validate a scene and tell what it holds", formatter_class=plain,
        description="Validate a scene without solving it; print one line on what it holds.",
        epilog=f"{SCENE}\n{SIGNS}\n{STATUSES}",
    )  # fmt: skip
    _add_scene(check)
    check.set_defaults(command=_check)

    schema = commands.add_parser(
        "schema", help="print the JSON Schema of scenes", formatter_class=plain,
        description="Print the JSON Schema of scenes: editors complete and check scenes by it.",
        epilog="For editors with Taplo (Even Better TOML): gapbeam schema > gapbeam.schema.json, and as the first\n"
        f"line of a scene\n\n  #:schema ./gapbeam.schema.json\n\n{SCENE}\n{SIGNS}\n{STATUSES}",
    )  # fmt: skip
    schema.set_defaults(command=_schema)

    from .cli_studies import add_studies

    add_studies(commands)
    return parser


def _add_scene(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("scene", metavar="SCENE", help="a .toml or .json file; - is standard input")


class _Version(argparse.Action):
    """Looks the version up only when asked."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> NoReturn:
        from . import __version__

        print(f"gapbeam {__version__}")
        parser.exit()


def _source(name: str) -> Mapping | str:
    """Give `read_scene` what it takes: the name of a file, or the contents of standard input."""
    if name != "-":
        return name
    text = sys.stdin.read()
    try:
        return json.loads(text) if text.lstrip().startswith("{") else tomllib.loads(text)
    except ValueError as error:
        raise SceneError("standard input", str(error)) from None


def _run(arguments: argparse.Namespace) -> int:
    outputs = {"--json": arguments.json, "--csv": arguments.csv, "--plot": arguments.plot, "--path": arguments.path}
    _check_outputs(outputs)
    from .scene import read_scene
    from .stepping import solve

    result = solve(read_scene(_source(arguments.scene)))
    status = SOLVED if result.status == "solved" else NO_SOLUTION
    report_wanted = not arguments.quiet and "-" not in outputs.values()
    from .report import print_report, to_csv, to_json

    if arguments.json:
        _write(arguments.json, to_json(result))
    if arguments.csv and status == SOLVED:
        _write(arguments.csv, to_csv(result))
    if arguments.plot:
        from .plots import plot

        plot(result, arguments.plot)
    if arguments.path and result.steps:
        from .plots_path import plot_path

        plot_path(result, arguments.path)
    if report_wanted:  # after the files: the reader of the report, such as head, may leave early
        with _until_closed():
            print_report(result)
    elif status != SOLVED:
        print(f"gapbeam: {result.reason}", file=sys.stderr)
    if arguments.csv and status != SOLVED:
        print(f"gapbeam: {arguments.csv} is not written: there are no fields without equilibrium", file=sys.stderr)
    return status


def _write(name: str, text: str) -> None:
    if name == "-":
        with _until_closed():
            sys.stdout.write(text)
    else:
        Path(name).write_text(text, encoding="utf-8", newline="")


def _check_outputs(outputs: Mapping[str, str | None]) -> None:
    """Refuse before solving what could not be written after it."""
    names = [name for name in outputs.values() if name]
    for option, name in outputs.items():
        if name is None:
            continue
        if name == "-" and option not in ("--plot", "--path"):
            continue
        path = Path(name)
        if option in ("--plot", "--path") and path.suffix.lower() not in PICTURES:
            raise SceneError(option, f'expected a file that ends in .png, .pdf or .svg, got "{name}"')
        if not name or path.is_dir():
            raise SceneError(option, f'expected the name of a file, got "{name}"')
        if not path.parent.is_dir():
            raise SceneError(option, f'the folder of "{name}" does not exist')
        if not os.access(path if path.exists() else path.parent, os.W_OK):
            raise SceneError(option, f'no permission to write "{name}"')
    if len(set(names)) < len(names):
        raise SceneError(f"{', '.join(option for option, name in outputs.items() if name)} need different files")


def _check(arguments: argparse.Namespace) -> int:
    from .formatting import count, number
    from .scene import read_scene

    scene = read_scene(_source(arguments.scene))
    length = f"{number(float(scene.span_ends()[-1]))} {scene.units.length}".rstrip()
    one_sided = sum(support.side != "both" for support in scene.supports)
    parts = [
        f"{count(len(scene.beam.spans), 'span')}, {length}",
        f"{count(len(scene.supports), 'support')}, {one_sided:,} of them one-sided",
        count(len(scene.loads), "load"),
    ]
    with _until_closed():
        print(f"{arguments.scene}: valid: " + "; ".join(parts))
    return SOLVED


def _schema(_: argparse.Namespace) -> int:
    from .scene import scene_schema

    with _until_closed():
        print(json.dumps(scene_schema(), indent=2, allow_nan=False))
    return SOLVED
