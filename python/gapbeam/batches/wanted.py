"""Names of the results that are wanted: of a batch, and of a function in the words of its columns."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from difflib import get_close_matches
from typing import NamedTuple

from ..base.errors import SceneError
from ..engine.beam import Beam
from ..engine.quantities import BENDING
from ..results.formatting import UNITS
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


def _known_results(scene: Scene, beam: Beam) -> tuple[str, ...]:
    """Tell what can be kept of a case, but for values at places."""
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
    wanted = check_wanted(want, _known_results(scene, beam), WANTED, float(beam.node_x[-1]))
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


LIFTED = "lifted"
NUMBERED = re.compile(r"([a-z_]+)(?:\[(\d+)\]|\.(\d+))(\.max|\.min)?")


class Output(NamedTuple):
    """A result that is asked for.

    Attributes
    ----------
    name : str
        As it was given.
    column : str
        Of the results of a batch.
    want : str
        What is kept of a case for it.
    quantity : str
        For its unit; empty where it has none.
    is_lifted : bool
        Whether it tells if there is an opening.
    """

    name: str
    column: str
    want: str
    quantity: str
    is_lifted: bool = False

    @property
    def plain_unit(self) -> str:
        """Its unit where it is no quantity of results."""
        return "rad" if self.quantity == "rotation" else ""


def find_outputs(scene: Scene, beam: Beam, names: Sequence[str]) -> tuple[Output, ...]:
    """Find the columns that outputs are.

    Parameters
    ----------
    scene : Scene
        Checked.
    beam : Beam
        Its beam.
    names : sequence of str
        Of the outputs.

    Raises
    ------
    SceneError
        There is no such output.
    """
    known = [name for name in (*_known_results(scene, beam), LIFTED) if name != "input"]
    supports = labels(scene.supports)
    return tuple(_output(scene, supports, name, known) for name in names)


def _output(scene: Scene, supports: Sequence[str], name: str, known: Sequence[str]) -> Output:
    column, quantity = name.strip(), re.split(r"[.@\[]", name.strip(), maxsplit=1)[0]
    numbered = NUMBERED.fullmatch(column)
    if numbered and quantity in (*AT_SUPPORTS, LIFTED):
        k = int(numbered[2] or numbered[3])
        if numbered[2] or numbered[3] not in supports:  # a name goes before a number
            if k >= len(supports):
                raise SceneError("outputs", f"{shown(name)}: there is no support {k}; the scene has {len(supports)}, 0 to "
                                 f"{len(supports) - 1}")  # fmt: skip
            column = f"{quantity}.{supports[k]}{numbered[4] or ''}"
    if column == LIMIT and LIMIT in known:
        return Output(name, column, LIMIT, "")
    if quantity not in known or quantity == LIMIT:
        near = get_close_matches(quantity, known, n=1, cutoff=0.6)
        hint = f"did you mean {near[0]}?" if near else f"results are {choice(known, 'and')}"
        raise SceneError("outputs", f"there is no {shown(name)}; {hint}")
    if quantity == LIFTED:
        end = ".max" if scene.combinations or scene.trains else ""
        return Output(name, f"opening{column.removeprefix(LIFTED).removesuffix('.max')}{end}", "opening", "", True)
    if "@" in column:
        return Output(name, column, column.removesuffix(".max").removesuffix(".min"), quantity)
    kind = column.partition(".")[2]
    of = "x" if kind.endswith("_x") and quantity not in AT_SUPPORTS else kind if quantity == ERRORS else quantity
    return Output(name, column, quantity, of if of in UNITS else "")
