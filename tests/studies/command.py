"""The command: ``python tests/studies NAME ...``, with the errors and exit statuses of ``gapbeam``."""

import argparse
from collections.abc import Callable, Iterable, Sequence
from types import ModuleType

from gapbeam.base.errors import SceneError
from gapbeam.cli.command import Parser, run
from gapbeam.cli.studies import add_tables, beside, study_outputs, tell


def main(argv: Sequence[str] | None = None) -> int:
    """Run a study.

    Parameters
    ----------
    argv : sequence of str, optional
        Its name and options; default ``sys.argv[1:]``.

    Returns
    -------
    int
        Exit status, as of ``gapbeam``.
    """
    return run(argv, _parser)


def _parser() -> argparse.ArgumentParser:
    parser = Parser("python tests/studies", description="Measure the program itself.")
    studies = parser.add_subparsers(title="studies", metavar="NAME", required=True)

    def add(name: str, command: Callable[[argparse.Namespace], int], short: str, text: str) -> argparse.ArgumentParser:
        plain = argparse.RawDescriptionHelpFormatter
        made = studies.add_parser(name, help=short, formatter_class=plain, description=text)
        made.set_defaults(command=command)
        return made

    extremes = add(
        "extremes", _extremes, "true errors in the corners, against exact solutions",
        "Solve scenes with extreme numbers (stiffnesses, spans, gaps, loads, units, many supports) and print the\n"
        "true errors, the error bounds the program gives, times and linear solves. Takes about half a minute.",
    )  # fmt: skip
    _add_largest(extremes, 10**6, "supports")
    contact = add(
        "contact", _contact, "contact at scale, beside an active set in numpy and scipy",
        "Run gapbeam beside the active set that a user would write with numpy and scipy, on up to 10,000 one-sided\n"
        "supports; print times, linear solves and true errors. Needs scipy. Takes half a minute.",
    )  # fmt: skip
    _add_largest(contact, 10**4, "spans")
    foundation = add(
        "foundation", _foundation, "error against run time on a one-sided foundation, beside springs",
        "Solve beams on a one-sided foundation, and with up to 100,001 springs in its place by gapbeam, by scipy and,\n"
        "where it is installed, by OpenSees; print true errors of contact ends, deflections and moments, and times. Needs scipy.\n"
        "Takes five minutes, --largest 1000 one.",
    )  # fmt: skip
    _add_largest(foundation, 10**5, "elements")
    _add_plot(foundation)
    kernel = add(
        "kernel", _kernel, "time and memory traffic a node, beside LAPACK's dgbsv",
        "Solve one linear beam of up to a million nodes by the engine's elimination and by LAPACK's dgbsv, and print\n"
        "nanoseconds a node and the share of the memory's bandwidth that is used. Takes about a minute.",
    )  # fmt: skip
    _add_largest(kernel, 10**6, "nodes")
    axial = add(
        "axial", _axial, "axial force in bending, beside textbook stability functions",
        "Solve two spans under axial forces from next to none to nothing but them by gapbeam and by stability functions in\n"
        "doubles, and print true errors; time beams of up to 1,000 spans beside no axial force. Takes some seconds.",
    )  # fmt: skip
    _add_largest(axial, 1000, "spans")
    schemes = add(
        "schemes", _schemes, "linear solves until the contact state is found",
        "Count the linear solves and events of the reference problems from all starting schemes, of fronts that move\n"
        "over thousands of supports, cold and warm, and of many spans. Takes some seconds.",
    )  # fmt: skip
    schemes.add_argument("--markdown", metavar="FILE", help="write the table as a page for the documentation (.md); - is standard "
                         "output")  # fmt: skip
    trains = add(
        "trains", _trains, "error against run time of exact envelopes of trains, beside tables of positions",
        "Move a vehicle over beams, and put it at up to 100,000 positions by a loop in numpy and, where they are\n"
        "installed, by PyCBA and OpenSees; print true errors of largest and smallest moments, shears and reactions, and times.\n"
        "Takes two minutes, --largest 1000 half a minute.",
    )  # fmt: skip
    _add_largest(trains, 10**5, "positions")
    _add_plot(trains)
    batch = add(
        "batch", _batch, "cases a second of a prepared scene, beside numpy, scipy, numba and JAX",
        "Solve up to 100,000 cases of beams on supports that open by gapbeam, by numpy over cases, and, where they\n"
        "are installed, by loops in scipy and numba; print times, cold and warm, and true errors. Takes a minute and a half.",
    )  # fmt: skip
    _add_largest(batch, 10**5, "cases")
    return parser


def _add_largest(parser: argparse.ArgumentParser, most: int, of: str) -> None:
    parser.add_argument("--largest", metavar="N", type=int, default=most, help=f"most {of} (default {most})")
    add_tables(parser)


def _add_plot(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--plot", metavar="FILE", help="draw error against run time (.png, .pdf or .svg)")


def _extremes(arguments: argparse.Namespace) -> int:
    outputs = study_outputs(arguments)
    from gapbeam.studies.page import to_csv

    from .corners import COLUMNS, PAGE, extremes, table, values, worst
    from .extremes import cases

    forms = {
        "--csv": lambda rows: to_csv((*COLUMNS, "worst in"), values(rows)),
        "--markdown": lambda rows: PAGE.markdown(table(rows), worst(rows)),
    }
    rows = list(extremes(cases(arguments.largest)))
    return tell(outputs, forms, lambda rows: PAGE.show(table(rows), remark=worst(rows)), rows)


def _contact(arguments: argparse.Namespace) -> int:
    from . import contact as study

    return _tell_table(arguments, study, study.contact)


def _kernel(arguments: argparse.Namespace) -> int:
    from . import kernel as study

    return _tell_table(arguments, study, study.kernels)


def _axial(arguments: argparse.Namespace) -> int:
    from . import axial as study

    return _tell_table(arguments, study, study.axial)


def _schemes(arguments: argparse.Namespace) -> int:
    outputs = study_outputs(arguments)
    from .schemes import PAGE, schemes, table

    forms = {"--markdown": lambda rows: PAGE.markdown(table(rows))}
    return tell(outputs, forms, lambda rows: PAGE.show(table(rows)), list(schemes()))


def _foundation(arguments: argparse.Namespace) -> int:
    from . import foundation as study

    if arguments.largest < study.MESHES[0]:
        raise SceneError("--largest", f"no mesh has as few as {arguments.largest} elements")
    return _tell_problems(arguments, study, "foundation_figure", study.foundation)


def _trains(arguments: argparse.Namespace) -> int:
    from . import trains as study

    if arguments.largest < study.POSITIONS[0]:
        raise SceneError("--largest", f"expected at least {study.POSITIONS[0]} positions, got {arguments.largest}")
    return _tell_problems(arguments, study, "trains_figure", study.trains)


def _batch(arguments: argparse.Namespace) -> int:
    from . import batch as study

    if arguments.largest < 1:
        raise SceneError("--largest", f"expected at least one case, got {arguments.largest}")
    return _tell_problems(arguments, study, "", study.batch)


def _tell_table(arguments: argparse.Namespace, study: ModuleType, find: Callable[[int], Iterable]) -> int:
    """Tell a study that is one table."""
    outputs = study_outputs(arguments)
    rows = list(find(arguments.largest))
    if not rows:
        raise SceneError("--largest", f"nothing is as small as {arguments.largest}")
    forms = {"--csv": study.PAGE.csv, "--markdown": lambda rows: study.PAGE.markdown(study.table(rows))}
    return tell(outputs, forms, lambda rows: study.PAGE.show(study.table(rows)), rows)


def _tell_problems(arguments: argparse.Namespace, study: ModuleType, figure: str, find: Callable[[int], Iterable]) -> int:
    """Tell a study of several problems, each with programs side by side: table, findings, picture."""
    outputs = study_outputs(arguments)

    def drawing(rows: list) -> bytes:
        from gapbeam.plots.save import picture

        from . import diagram

        return picture(getattr(diagram, figure)(rows), outputs.suffix("--plot"))

    def page(rows: list) -> str:
        return study.PAGE.markdown(study.table(rows), study.findings(rows), beside(arguments))

    forms = {"--csv": study.PAGE.csv, "--plot": drawing, "--markdown": page}
    rows = list(find(arguments.largest))
    return tell(outputs, forms, lambda rows: study.PAGE.show(study.table(rows), remark=study.findings(rows)), rows)
