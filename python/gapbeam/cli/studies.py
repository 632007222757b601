"""The studies of the command line: ``gapbeam study ...``."""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING

from ..base.errors import SceneError
from .exits import SOLVED
from .outputs import Outputs, source, until_closed

if TYPE_CHECKING:
    from ..studies.page import Page

PLAIN = argparse.RawDescriptionHelpFormatter


def add_studies(commands: argparse._SubParsersAction) -> None:
    """Add the command ``study``.

    Parameters
    ----------
    commands : argparse._SubParsersAction
        The commands of ``gapbeam``.
    """
    study = commands.add_parser("study", help="measure the program itself", description="Measure the program itself.")
    studies = study.add_subparsers(title="studies", metavar="STUDY", required=True)
    extremes = studies.add_parser(
        "extremes", help="true errors in the corners, against exact solutions", formatter_class=PLAIN,
        description="Solve scenes with extreme numbers (stiffnesses, spans, gaps, loads, units, many supports) and print the\n"
        "true errors, the error bounds the program gives, times and linear solves. Takes about half a minute.",
    )  # fmt: skip
    _add_tables(extremes)
    extremes.add_argument("--largest", metavar="N", type=int, default=10**6, help="most supports (default 1000000)")
    extremes.set_defaults(command=_study_extremes)
    accuracy = studies.add_parser(
        "accuracy", help="error against run time by each method, on families of beams or on a scene", formatter_class=PLAIN,
        description="Solve the same meshed beams by the engine's methods, by LAPACK's dgbsv and by the displacement method, and\n"
        "print true errors and times, the Pareto front marked. All families take two minutes, --largest 10000 some seconds.",
    )  # fmt: skip
    accuracy.add_argument("scene", metavar="SCENE", nargs="?", help="a .toml or .json file instead of the built-in families")
    accuracy.add_argument("--family", metavar="NAME", action="append", default=[], help="one built-in family only: span (one span, "
                          "finely meshed), spans (many), jumps (of EI), springs (soft and stiff), gaps (one-sided)")  # fmt: skip
    accuracy.add_argument("--parts", metavar="N", type=int, nargs="+", help="elements into which each stretch of SCENE is cut, one "
                          "comparison for each (default 1 4 16 64)")  # fmt: skip
    accuracy.add_argument("--largest", metavar="N", type=int, default=10**6, help="most elements (default 1000000)")
    _add_tables(accuracy)
    accuracy.add_argument("--plot", metavar="FILE", help="draw error against run time (.png, .pdf or .svg)")
    accuracy.set_defaults(command=_study_accuracy)
    contact = studies.add_parser(
        "contact", help="contact at scale, beside an active set in numpy and scipy", formatter_class=PLAIN,
        description="Run gapbeam beside the active set that a user would write with numpy and scipy, on up to 10,000 one-sided\n"
        "supports; print times, linear solves and true errors. Needs scipy. Takes half a minute.",
    )  # fmt: skip
    contact.add_argument("--largest", metavar="N", type=int, default=10**4, help="most spans (default 10000)")
    _add_tables(contact)
    contact.set_defaults(command=_study_contact)
    foundation = studies.add_parser(
        "foundation", help="error against run time on a one-sided foundation, beside springs", formatter_class=PLAIN,
        description="Solve beams on a one-sided foundation, and with up to 100,001 springs in its place by gapbeam, by scipy and,\n"
        "where it is installed, by OpenSees; print true errors of contact ends, deflections and moments, and times. Needs scipy.\n"
        "Takes five minutes, --largest 1000 one.",
    )  # fmt: skip
    foundation.add_argument("--largest", metavar="N", type=int, default=10**5, help="most elements (default 100000)")
    _add_tables(foundation)
    foundation.add_argument("--plot", metavar="FILE", help="draw error against run time (.png, .pdf or .svg)")
    foundation.set_defaults(command=_study_foundation)
    kernel = studies.add_parser(
        "kernel", help="time and memory traffic a node, beside LAPACK's dgbsv", formatter_class=PLAIN,
        description="Solve one linear beam of up to a million nodes by the engine's elimination and by LAPACK's dgbsv, and print\n"
        "nanoseconds a node and the share of the memory's bandwidth that is used. Takes about a minute.",
    )  # fmt: skip
    kernel.add_argument("--largest", metavar="N", type=int, default=10**6, help="most nodes (default 1000000)")
    _add_tables(kernel)
    kernel.set_defaults(command=_study_kernel)
    schemes = studies.add_parser(
        "schemes", help="linear solves until the working scheme is found", formatter_class=PLAIN,
        description="Count the linear solves and events of the reference problems from all starting schemes, of fronts that move\n"
        "over thousands of supports, cold and warm, and of many spans. Takes some seconds.",
    )  # fmt: skip
    schemes.add_argument("--markdown", metavar="FILE", help="write the table as a page for the documentation (.md); - is standard "
                         "output")  # fmt: skip
    schemes.set_defaults(command=_study_schemes)
    trains = studies.add_parser(
        "trains", help="error against run time of exact envelopes of trains, beside tables of positions", formatter_class=PLAIN,
        description="Move a vehicle over beams, and put it at up to 100,000 positions by a loop in numpy and, where they are\n"
        "installed, by PyCBA and OpenSees; print true errors of largest and smallest moments, shears and reactions, and times.\n"
        "Takes two minutes, --largest 1000 half a minute.",
    )  # fmt: skip
    trains.add_argument("--largest", metavar="N", type=int, default=10**5, help="most positions (default 100000)")
    _add_tables(trains)
    trains.add_argument("--plot", metavar="FILE", help="draw error against run time (.png, .pdf or .svg)")
    trains.set_defaults(command=_study_trains)
    batch = studies.add_parser(
        "batch", help="cases a second of a prepared scene, beside numpy, scipy, numba and JAX", formatter_class=PLAIN,
        description="Solve up to 100,000 cases of beams on supports that open by gapbeam, by numpy over cases, and, where they\n"
        "are installed, by loops in scipy and numba; print times, cold and warm, and true errors. Takes a minute and a half.",
    )  # fmt: skip
    batch.add_argument("--largest", metavar="N", type=int, default=10**5, help="most cases (default 100000)")
    _add_tables(batch)
    batch.set_defaults(command=_study_batch)


def _add_tables(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--csv", metavar="FILE", help="write the table with all digits (.csv); - is standard output, nothing else")
    parser.add_argument("--markdown", metavar="FILE", help="write the table as a page for the documentation (.md); - as above")


def _study_extremes(arguments: argparse.Namespace) -> int:
    outputs = _outputs(arguments)
    from ..studies.corners import COLUMNS, PAGE, extremes, table, values, worst
    from ..studies.extremes import cases
    from ..studies.page import to_csv

    forms = {
        "--csv": lambda rows: to_csv((*COLUMNS, "worst in"), values(rows)),
        "--markdown": lambda rows: PAGE.markdown(table(rows), worst(rows)),
    }
    rows = list(extremes(cases(arguments.largest)))
    return _tell(outputs, forms, lambda rows: PAGE.show(table(rows), remark=worst(rows)), rows)


def _study_accuracy(arguments: argparse.Namespace) -> int:
    outputs = _outputs(arguments, arguments.scene)
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
        return to_markdown(comparisons, _beside(arguments), remark, " ".join(options))

    forms = {"--csv": to_csv, "--plot": drawing, "--markdown": page}
    return _tell(outputs, forms, lambda comparisons: print_comparisons(comparisons, remark), comparisons)


def _study_contact(arguments: argparse.Namespace) -> int:
    outputs = _outputs(arguments)
    from ..studies.contact import PAGE, contact, table

    return _tell_page(arguments, outputs, PAGE, list(contact(arguments.largest)), table)


def _study_foundation(arguments: argparse.Namespace) -> int:
    from ..studies import foundation as study

    if arguments.largest < study.MESHES[0]:
        raise SceneError("--largest", f"no mesh has as few as {arguments.largest} elements")
    return _tell_problems(arguments, study, "foundation_figure", study.foundation)


def _study_trains(arguments: argparse.Namespace) -> int:
    from ..studies import trains as study

    if arguments.largest < study.POSITIONS[0]:
        raise SceneError("--largest", f"expected at least {study.POSITIONS[0]} positions, got {arguments.largest}")
    return _tell_problems(arguments, study, "trains_figure", study.trains)


def _study_batch(arguments: argparse.Namespace) -> int:
    from ..studies import batch as study

    if arguments.largest < 1:
        raise SceneError("--largest", f"expected at least one case, got {arguments.largest}")
    return _tell_problems(arguments, study, "", study.batch)


def _tell_problems(arguments: argparse.Namespace, study: ModuleType, figure: str, run: Callable[[int], Iterable]) -> int:
    """Tell a study of several problems, each with programs side by side: table, findings, picture."""
    outputs = _outputs(arguments)

    def drawing(rows: list) -> bytes:
        from ..plots.save import picture
        from ..studies import diagram

        return picture(getattr(diagram, figure)(rows), outputs.suffix("--plot"))

    def page(rows: list) -> str:
        return study.PAGE.markdown(study.table(rows), study.findings(rows), _beside(arguments))

    forms = {"--csv": study.PAGE.csv, "--plot": drawing, "--markdown": page}
    rows = list(run(arguments.largest))
    return _tell(outputs, forms, lambda rows: study.PAGE.show(study.table(rows), remark=study.findings(rows)), rows)


def _study_kernel(arguments: argparse.Namespace) -> int:
    outputs = _outputs(arguments)
    from ..studies.kernel import PAGE, kernels, table

    return _tell_page(arguments, outputs, PAGE, list(kernels(arguments.largest)), table)


def _study_schemes(arguments: argparse.Namespace) -> int:
    outputs = _outputs(arguments)
    from ..studies.schemes import PAGE, schemes, table

    forms = {"--markdown": lambda rows: PAGE.markdown(table(rows))}
    return _tell(outputs, forms, lambda rows: PAGE.show(table(rows)), list(schemes()))


def _beside(arguments: argparse.Namespace) -> str:
    """Name of the picture as seen from the page, if there is one."""
    return os.path.relpath(arguments.plot, Path(arguments.markdown).parent) if getattr(arguments, "plot", None) else ""


def _outputs(arguments: argparse.Namespace, scene: str | None = None) -> Outputs:
    """Check the files that the options of a study name."""
    return Outputs({f"--{name}": getattr(arguments, name, None) for name in ("csv", "markdown", "plot")}, scene)


def _tell_page(arguments: argparse.Namespace, outputs: Outputs, page: Page, rows: list, table: Callable) -> int:
    """Tell a study that is one table."""
    if not rows:
        raise SceneError("--largest", f"nothing is as small as {arguments.largest}")
    forms = {"--csv": page.csv, "--markdown": lambda rows: page.markdown(table(rows))}
    return _tell(outputs, forms, lambda rows: page.show(table(rows)), rows)


def _tell(outputs: Outputs, forms: Mapping[str, Callable], show: Callable, rows: list) -> int:
    """Write what a study found into the files asked for, and print it unless one of them is standard output."""
    contents = {option: form(rows) for option, form in forms.items() if option in outputs}
    outputs.write({option: [content] if isinstance(content, str) else content for option, content in contents.items()})
    if not outputs.on_standard_output:
        with until_closed():
            show(rows)
    return SOLVED
