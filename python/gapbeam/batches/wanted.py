"""Names of the results that are kept of every case, looked at once, and how many cases are solved at a time."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ..base.errors import SceneError
from ..engine.beam import Beam
from ..engine.quantities import BENDING
from ..scene.combinations import plan_combinations
from ..scene.names import labels
from ..scene.structs import Scene
from ..scene.wording import choice, shown
from .job import Job
from .paths import find_paths, scene_data
from .scene_cases import AT_SUPPORTS, ERRORS, LIMIT, place_of

WANTED = ("input", "reaction", "opening", "deflection", "moment")
"""What is kept of every case where nothing else is said."""
SECONDS = 0.5
"""A chunk takes about so long on one core."""
NUMBERS = 4_000_000
"""Numbers in a chunk, at most."""
A_TRAIN = 30
"""States that a train counts for."""


def known_results(scene: Scene, beam: Beam) -> tuple[str, ...]:
    """Tell what can be kept of a case, but for values at places.

    Parameters
    ----------
    scene : Scene
        Checked.
    beam : Beam
        Its beam.
    """
    if scene.combinations or scene.trains:
        return ("input", "reaction", "opening", *BENDING)
    return ("input", *AT_SUPPORTS, *beam.fields, ERRORS, LIMIT)


def job_of(written: Scene, scene: Scene, beam: Beam, columns: Sequence[str], want: tuple[str, ...] | None) -> Job:
    """Make what is done with every row of a table.

    Parameters
    ----------
    written : Scene
        From `as_written`.
    scene : Scene
        The same, checked.
    beam : Beam
        Its beam.
    columns : sequence of str
        Of the table: key paths.
    want : tuple of str or None
        What is kept of every case; None: `WANTED`.

    Raises
    ------
    SceneError
        A column is no key path, or something is wanted that there is not.
    """
    data = scene_data(written)
    wanted = check_wanted(want, known_results(scene, beam), WANTED, float(beam.node_x[-1]))
    is_followed = scene.analysis.follow == "events" or any(support.law is not None for support in scene.supports)
    if LIMIT in wanted and not is_followed:
        raise SceneError("want", f'{LIMIT} is found where the load is followed; set analysis.follow = "events" in the scene')
    return Job(data, find_paths(written, columns), wanted, tuple(labels(scene.supports)))


def check_wanted(
    want: tuple[str, ...] | None, known: Sequence[str], default: tuple[str, ...], length: float | None = None
) -> tuple[str, ...]:
    """Check the names of what is wanted.

    Parameters
    ----------
    want : tuple of str or None
        As the caller gave it.
    known : sequence of str
        What can be kept.
    default : tuple of str
        What is wanted where nothing is said.
    length : float, optional
        Of the beam, on which there are places (``moment@15.0``); None where every case has a beam of its own.

    Returns
    -------
    tuple of str
        Each once.

    Raises
    ------
    SceneError
        Something else is wanted, or nothing.
    """
    if want is None:
        return default
    for name in want:
        field, at, _ = str(name).partition("@")
        if at and length is not None and field in known and field not in ("input", *AT_SUPPORTS, ERRORS, LIMIT):
            x = place_of(name)
            if not (math.isfinite(x) and 0.0 <= x <= length):
                raise SceneError("want", f"{shown(name)}: expected a place from 0 to {length:g}, such as {field}@{length / 2:g}")
        elif name not in known:
            there = choice(known, "and")
            places = "" if length is None else ", and fields at a place, such as moment@1.5"
            raise SceneError("want", f"expected some of {there}{places}, got {shown(name)}")
    if not want:
        raise SceneError("want", f"is empty; give some of {choice(known, 'and')}")
    return tuple(dict.fromkeys(want))


def cases_a_chunk(job: Job, scene: Scene, beam: Beam) -> int:
    """Tell how many cases take about half a second, by their number of nodes alone: files do not depend on how fast a machine is.

    Parameters
    ----------
    job : Job
        What is done with a case.
    scene, beam
        As for `job_of`.
    """
    states = 1
    if scene.combinations or scene.trains:
        states = (len(plan_combinations(scene)) if scene.combinations else 1) * (1 + A_TRAIN * len(scene.trains))
    seconds = job.cases.seconds(beam.links + 1, states)
    numbers = len(job.paths) + len(job.columns) + len(job.scene["loads"]) + 4 * len(job.supports) + 14
    most = max(min(SECONDS / seconds, NUMBERS / numbers), 1.0)
    power = 10 ** (len(str(int(most))) - 1)
    return int(most / power) * power
