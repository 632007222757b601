"""The study of the command line, ``gapbeam study accuracy``, and what any study is told by."""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from ..base.errors import SceneError
from ..base.progress import shown_progress
from .exits import SOLVED
from .outputs import Outputs, source, until_closed

MOVED = ("batch", "contact", "extremes", "foundation", "kernel", "schemes", "trains")
"""Studies of the program itself, which the package held before version 0.4."""


def refuse_moved(words: Sequence[str]) -> None:
    """Say where a study is now that the package held before; to be left out in version 0.5.

    Parameters
    ----------
    words : sequence of str
        Arguments of ``gapbeam``.

    Raises
    ------
    SceneError
        They ask for such a study.
    """
    if len(words) > 1 and words[0] == "study" and words[1] in MOVED:
        raise SceneError(f"study {words[1]} measures the program itself and is not installed: python tests/studies {words[1]} "
                         "in a checkout")  # fmt: skip


def add_studies(commands: argparse._SubParsersAction) -> None:
    """Add the command ``study``.

    Parameters
    ----------
    commands : argparse._SubParsersAction
        The commands of ``gapbeam``.
    """
    what = "error against run time by each method"
    study = commands.add_parser("study", help=f"{what}, on a scene", description="Compare gapbeam with other methods.")
    studies = study.add_subparsers(title="studies", metavar="STUDY", required=True)
    accuracy = studies.add_parser(
        "accuracy", help=f"{what}, on families of beams or on a scene", formatter_class=argparse.RawDescriptionHelpFormatter,
        description="Solve the same meshed beams by the engine's methods, by LAPACK's dgbsv and by the displacement method, and\n"
        "print true errors and times, the Pareto front marked. All families take two minutes, --largest 10000 some seconds.",
    )  # fmt: skip
    accuracy.add_argument("scene", metavar="SCENE", nargs="?", help="a .toml or .json file instead of the built-in families")
    accuracy.add_argument("--family", metavar="NAME", action="append", default=[], help="one built-in family only: span (one span, "
                          "finely meshed), spans (many), jumps (of EI), springs (soft and stiff), gaps (one-sided)")  # fmt: skip
    accuracy.add_argument("--parts", metavar="N", type=int, nargs="+", help="elements into which each stretch of SCENE is cut, one "
                          "comparison for each (default 1 4 16 64)")  # fmt: skip
    accuracy.add_argument("--largest", metavar="N", type=int, default=10**6, help="most elements (default 1000000)")
    add_tables(accuracy)
    accuracy.add_argument("--plot", metavar="FILE", help="draw error against run time (.png, .pdf or .svg)")
    accuracy.set_defaults(command=_study_accuracy)


def add_tables(parser: argparse.ArgumentParser) -> None:
    """Add the options of a study for its table.

    Parameters
    ----------
    parser : argparse.ArgumentParser
        Of the study.
    """
    parser.add_argument("--csv", metavar="FILE", help="write the table with all digits (.csv); - is standard output, nothing else")
    parser.add_argument("--markdown", metavar="FILE", help="write the table as a page for the documentation (.md); - as above")


def _study_accuracy(arguments: argparse.Namespace) -> int:
    outputs = study_outputs(arguments, arguments.scene)
    from ..studies.accuracy import (
        FAMILIES,
        PARTS,
        families,
        print_comparisons,
        scene_comparisons,
        to_csv,
        to_markdown,
    )

    for name in arguments.family:
        if name not in FAMILIES:
            raise SceneError("--family", f'expected one of {", ".join(FAMILIES)}, got "{name}"')
    if arguments.scene and arguments.family:
        raise SceneError("give either SCENE or --family, not both")
    if arguments.parts and not arguments.scene:
        raise SceneError("--parts", "needs a SCENE to cut")
    if min([arguments.largest, *(arguments.parts or [])]) < 1:
        raise SceneError("--parts and --largest", "expected positive numbers")
    remark = ""
    with shown_progress("comparing"):
        if arguments.scene:
            comparisons, remark = scene_comparisons(source(arguments.scene), arguments.parts or PARTS)
        else:
            comparisons = list(families(arguments.family, arguments.largest))
    if not comparisons:
        raise SceneError("--largest", f"no mesh has as few as {arguments.largest} elements")

    def drawing(comparisons: list) -> bytes:
        from ..plots.save import picture
        from ..studies.diagram import accuracy_figure

        return picture(accuracy_figure(comparisons), outputs.suffix("--plot"))

    def page(comparisons: list) -> str:
        options = [arguments.scene or "", *(f"--family {name}" for name in arguments.family)]
        return to_markdown(comparisons, beside(arguments), remark, " ".join(options))

    forms = {"--csv": to_csv, "--plot": drawing, "--markdown": page}
    return tell(outputs, forms, lambda comparisons: print_comparisons(comparisons, remark), comparisons)


def beside(arguments: argparse.Namespace) -> str:
    """Name of the picture as seen from the page, if there is one.

    Parameters
    ----------
    arguments : argparse.Namespace
        Of a study.
    """
    return os.path.relpath(arguments.plot, Path(arguments.markdown).parent) if getattr(arguments, "plot", None) else ""


def study_outputs(arguments: argparse.Namespace, scene: str | None = None) -> Outputs:
    """Check the files that the options of a study name.

    Parameters
    ----------
    arguments : argparse.Namespace
        Of the study.
    scene : str, optional
        Name of the scene that it reads.
    """
    return Outputs({f"--{name}": getattr(arguments, name, None) for name in ("csv", "markdown", "plot")}, scene)


def tell(outputs: Outputs, forms: Mapping[str, Callable], show: Callable, rows: list) -> int:
    """Write what a study found into the files asked for, and print it unless one of them is standard output.

    Parameters
    ----------
    outputs : Outputs
        The files.
    forms : mapping of str to callable
        What makes the content of each from the rows, by option.
    show : callable
        Prints the rows.
    rows : list
        What was found.

    Returns
    -------
    int
        Exit status.
    """
    contents = {option: form(rows) for option, form in forms.items() if option in outputs}
    outputs.write({option: [content] if isinstance(content, str) else content for option, content in contents.items()})
    if not outputs.on_standard_output:
        with until_closed():
            show(rows)
    return SOLVED
