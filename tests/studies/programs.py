"""Other programs beside gapbeam: whether they can be had, and what a first call takes in a process of its own."""

from __future__ import annotations

import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

TESTS = Path(__file__).resolve().parent.parent
"""Where the package `studies` is."""


def has(package: str) -> bool:
    """Whether a program can be had.

    Parameters
    ----------
    package : str
        Its package.
    """
    return find_spec(package) is not None


def number_printed(code: str) -> float:
    """Run Python code, which may import `studies`, in a process of its own, and take the number that it prints.

    Parameters
    ----------
    code : str
        Prints a number, such as the seconds of a call.

    Raises
    ------
    subprocess.CalledProcessError
        The code fails.

    Examples
    --------
    >>> number_printed("print(0.5)")
    0.5
    """
    code = f"import sys; sys.path.insert(0, {str(TESTS)!r}); {code}"
    words = [sys.executable, "-c", code]  # what it says when it is interrupted is nobody's concern
    run = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=True)
    return float(run.stdout)
