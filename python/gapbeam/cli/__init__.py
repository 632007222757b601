"""Command ``gapbeam``: it sees to signals, then loads the rest of itself.

Signals and little memory are answered from the first line on, so nothing is imported here that Python has not loaded itself.
"""

import os
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import NoReturn

ENDS = {"SIGINT": b"interrupted", "SIGTERM": b"ended by SIGTERM", "SIGHUP": b"ended by SIGHUP"}
"""Signals that end the command, and what it says then."""
SHOW_CURSOR = b"\x1b[?25h"
"""What a terminal is told: a bar of progress hides it."""


def main(argv: "Sequence[str] | None" = None) -> int:
    """Run the command.

    Parameters
    ----------
    argv : sequence of str, optional
        Arguments without the name of the program; default ``sys.argv[1:]``: then the process is the command's own. Warnings are one
        line each, Ctrl-C and SIGTERM end it, and libraries that it loads start no threads.

    Returns
    -------
    int
        Exit status: 0 solved or valid, 1 the structure is unstable, 2 refused, 3 failed, 130 ended by Ctrl-C, 143 by SIGTERM.
    """
    try:
        if argv is None:
            see_to_signals()
            prepare_libraries()
        from .command import run
    except (MemoryError, ImportError) as error:  # before anything is there that could say it better
        if sys.stderr is not None:
            what = "not enough memory" if isinstance(error, MemoryError) else f"a part of gapbeam cannot be loaded ({error})"
            sys.stderr.write(f"gapbeam: error: {what}; give it more memory, or install it again\n")
        return 3
    return run(argv)


def see_to_signals() -> None:
    """Let signals end the process with nothing written in part; those that somebody ignores or sees to stay as they are."""
    import _signal  # the module signal loads others first

    for name in ENDS:
        number = getattr(_signal, name, None)
        if number is None or _signal.getsignal(number) not in (_signal.SIG_DFL, _signal.default_int_handler):
            continue
        try:
            _signal.signal(number, _end)
        except ValueError:  # only the main thread may
            return


def prepare_libraries() -> None:
    """Tell libraries what they look for when they are loaded, unless the user has told them.

    Linear systems here are small, and where there is little memory OpenBLAS ends the process if its threads get none.
    """
    if not {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "GOTO_NUM_THREADS"} & os.environ.keys():
        os.environ["OPENBLAS_NUM_THREADS"] = "1"
    os.environ.setdefault("ARROW_DEFAULT_MEMORY_POOL", "system")  # its own take much of the address space beforehand


def _end(number: int, _: object) -> "NoReturn":
    """End the process at once: Python drops a KeyboardInterrupt that comes while it frees objects, and a call may go on beside."""
    remove = getattr(sys.modules.get("gapbeam.base.files"), "remove_unfinished", None)
    if remove is not None:
        remove()
    import _signal

    text = next(text for name, text in ENDS.items() if getattr(_signal, name, None) == number)
    try:
        os.write(2, (SHOW_CURSOR if os.isatty(2) else b"") + b"gapbeam: " + text + b"\n")
    finally:
        os._exit(128 + number)


__all__ = ["main"]
