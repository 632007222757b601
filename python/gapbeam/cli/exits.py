"""Exit statuses of the command, and the line on standard error that goes with one."""

import sys
from contextlib import suppress

from ..base.characters import visible

SOLVED, NO_SOLUTION, REFUSED, FAILED, INTERRUPTED = 0, 1, 2, 3, 130


def say(status: int, message: str) -> int:
    """Write one line on standard error; where that is closed, the status has to do.

    Parameters
    ----------
    status : int
        Given back.
    message : str
        The line.
    """
    with suppress(AttributeError, OSError):
        sys.stderr.write(f"gapbeam: {visible(' '.join(message.split()))}\n")
    return status
