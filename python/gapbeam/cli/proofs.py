"""Proofs on the command line: ``gapbeam prove`` and ``gapbeam check-proof``."""

from __future__ import annotations

import argparse
import json
import os
import sys
from pathlib import Path

from ..base.errors import SceneError
from .exits import REFUSED, SOLVED, say
from .outputs import Outputs, source

CHECKERS = ("proof_checker.py", "proof_checker_ground.py")
"""Without ground, and with it."""
TEXT = """\
The file is checked by a short program that shares nothing with gapbeam:
tests/oracle/checkers/proof_checker.py, or proof_checker_ground.py beside it for beams on the ground.
They need python-flint.
"""
ANSWERS = "Exit status: 0 proved, 1 refuted, 2 not decided, or the checkers are not here."


def add_proofs(commands: argparse._SubParsersAction) -> None:
    """Add the commands ``prove`` and ``check-proof``.

    Parameters
    ----------
    commands : argparse._SubParsersAction
        The commands of ``gapbeam``.
    """
    plain = argparse.RawDescriptionHelpFormatter
    prove = commands.add_parser(
        "prove", help="write a state so that others can check it", formatter_class=plain,
        description="Solve a scene and write one state of it: its scene, what every support does, deflections and reactions to\n"
        "the last digit; or the motion of a beam that nothing holds.", epilog=TEXT,
    )  # fmt: skip
    prove.add_argument("scene", metavar="SCENE", help="a .toml or .json file; - is standard input")
    prove.add_argument("-o", "--output", metavar="FILE", required=True, help="the proof (.json); - is standard output")
    prove.add_argument("--factor", metavar="F", type=float, help="load factor of the state (default the last one)")
    prove.add_argument("--combination", metavar="NAME", help="which combination (default the last one)")
    prove.set_defaults(command=_prove)
    check = commands.add_parser(
        "check-proof", help="check a state that was written by prove", formatter_class=plain,
        description="Run the checker that shares nothing with gapbeam on a file from gapbeam prove.", epilog=f"{TEXT}\n{ANSWERS}",
    )  # fmt: skip
    check.add_argument("proof", metavar="FILE", help="a file from gapbeam prove")
    check.set_defaults(command=_check)


def _prove(arguments: argparse.Namespace) -> int:
    outputs = Outputs({"--output": arguments.output}, arguments.scene)
    from ..results.proof import proof_data

    data = proof_data(source(arguments.scene), arguments.factor, arguments.combination)
    outputs.write({"--output": [json.dumps(data, indent=1) + "\n"]})
    return SOLVED


def _check(arguments: argparse.Namespace) -> int:
    try:
        with open(arguments.proof, encoding="utf-8") as stream:
            on_ground = bool(json.load(stream)["scene"].get("foundation"))
    except (ValueError, LookupError, TypeError, AttributeError):
        raise SceneError(arguments.proof, "is no file from gapbeam prove") from None
    name = CHECKERS[on_ground]
    found = next((path for folder in _folders() if (path := folder / name).is_file()), None)
    if found is None:
        return say(REFUSED, f"not decided: {name} is not here; it is in tests/oracle/checkers of gapbeam's sources; run this there")
    try:
        import flint  # noqa: F401
    except ImportError:
        return say(REFUSED, "not decided: the checker needs python-flint; pip install python-flint")
    sys.stdout.flush()
    import subprocess

    return subprocess.run([sys.executable, os.fspath(found), arguments.proof], check=False).returncode


def _folders() -> list[Path]:
    """Where the checkers may be: in the sources of which this package is part, or in those where the command is run."""
    here = Path.cwd()
    return [folder / "tests" / "oracle" / "checkers" for folder in (*Path(__file__).resolve().parents[3:4], here, *here.parents)]
