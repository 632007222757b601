"""The memory that there is, so that what cannot fit is refused before it starts."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

from .errors import SceneError

LITTLE = 10e6
"""Bytes that are taken without asking."""
_LIMITS = ("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes")
"""Limits of the control group that the process is in, version 2 and 1."""


def available() -> float:
    """Tell how much memory there is to be had.

    Returns
    -------
    float
        Bytes; infinite on a system that does not tell.
    """
    found = [float("inf")]
    with suppress(OSError, ValueError, StopIteration):
        lines = Path("/proc/meminfo").read_text(encoding="ascii").splitlines()
        found.append(1024.0 * int(next(line for line in lines if line.startswith("MemAvailable:")).split()[1]))
    if len(found) == 1:
        with suppress(AttributeError, OSError, ValueError):
            found.append(float(os.sysconf("SC_PHYS_PAGES")) * os.sysconf("SC_PAGE_SIZE"))
    with suppress(ImportError, OSError):
        import resource

        limit = resource.getrlimit(resource.RLIMIT_AS)[0]
        if limit != resource.RLIM_INFINITY:
            found.append(float(limit))
    for limit in _LIMITS:
        with suppress(OSError, ValueError):
            found.append(float(Path(limit).read_text(encoding="ascii")))
    return min(found)


def reserve(amount: int) -> bool:
    """See that so much of the address space is there, where it has a limit: some libraries end the process where it is not.

    Parameters
    ----------
    amount : int
        Bytes.

    Returns
    -------
    bool
        Whether it has a limit.

    Raises
    ------
    MemoryError
        It is not there.
    """
    try:
        import resource
    except ImportError:  # Windows
        return False
    if resource.getrlimit(resource.RLIMIT_AS)[0] == resource.RLIM_INFINITY:
        return False
    import mmap

    try:
        mmap.mmap(-1, amount).close()
    except OSError:
        raise MemoryError(f"{size(amount)} of the address space are needed to go on (ulimit -v)") from None
    return True


def refuse_beyond(place: str, what: str, needed: float, remedy: str) -> None:
    """Refuse what takes more memory than there is.

    Parameters
    ----------
    place : str
        Key of the scene or name of the argument that asks for it.
    what : str
        What takes the memory.
    needed : float
        How much, bytes.
    remedy : str
        What to do about it.

    Raises
    ------
    SceneError
        It cannot fit.
    """
    if needed > LITTLE and needed > (there := available()):
        raise SceneError(place, f"{what} take {size(needed)} of memory, and {size(there)} can be had; {remedy}")


def size(amount: float) -> str:
    """Word an amount of memory.

    Examples
    --------
    >>> size(512), size(13.2e9), size(2.5e6)
    ('512 bytes', '13 GB', '2.5 MB')
    """
    for factor, label in ((1e12, "TB"), (1e9, "GB"), (1e6, "MB"), (1e3, "kB")):
        if amount >= factor:
            return f"{amount / factor:.2g} {label}" if amount < 100.0 * factor else f"{amount / factor:,.0f} {label}"
    return f"{amount:.0f} bytes"
