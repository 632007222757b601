"""A scene to start from: ``gapbeam new``."""

from __future__ import annotations

import argparse
import os
from pathlib import Path

from ..base.errors import SceneError
from ..base.files import write_files
from ..base.hints import nearest
from .exits import SOLVED
from .outputs import until_closed

TEMPLATES = Path(__file__).parent / "templates"
TASKS = {
    "bridge": "uplift of end bearings under traffic, a pier that settles",
    "crane-runway": "two cranes on their way over a runway, uplift at its columns",
    "footing": "a strip footing under an eccentric column",
    "pile": "a pile in soft clay, pushed sideways, by p-y curves",
    "pipe-rack": "a steam line on racks, cold, hot and under test",
    "shaft": "a shaft in bearings with clearance",
    "slab": "a slab on clay that has shrunk at its edges",
    "stops": "a shear pin that breaks, and a rubber stop",
    "tolerances": "bearings at heights that scatter",
}
"""What the scenes are about, by the names of their files."""


def add_new(commands: argparse._SubParsersAction) -> None:
    """Add the command ``new``.

    Parameters
    ----------
    commands : argparse._SubParsersAction
        The commands of ``gapbeam``.
    """
    tasks = "\n".join(f"  {name:14}{about}" for name, about in TASKS.items())
    new = commands.add_parser(
        "new", help="write a scene to start from, with comments", formatter_class=argparse.RawDescriptionHelpFormatter,
        description="Write a scene of a common task to NAME.toml, with comments, to be changed into one's own.",
        epilog=f"Names:\n{tasks}\n\nThen: gapbeam run NAME.toml\n",
    )  # fmt: skip
    new.add_argument("name", metavar="NAME", help=f"one of {', '.join(TASKS)}")
    new.set_defaults(command=_new)


def _new(arguments: argparse.Namespace) -> int:
    name = arguments.name
    if name not in TASKS:
        meant = nearest(name.removesuffix(".toml").replace("_", "-"), TASKS)
        hint = f"; did you mean {meant}? There are" if meant else "; there are"
        raise SceneError(f'no scene is called "{name}"{hint}: {", ".join(TASKS)}')
    file = f"{name}.toml"
    if os.path.lexists(file):
        raise SceneError(file, f"is there already, and is left as it is; move it, or call gapbeam new {name} in another folder")
    write_files({file: (TEMPLATES / file).read_bytes()})
    with until_closed():
        print(f"{file} is written; gapbeam run {file} solves it")
    return SOLVED
