"""Names of results that a function is to give, in the words of the columns of a batch."""

from __future__ import annotations

import re
from collections.abc import Sequence
from difflib import get_close_matches
from typing import NamedTuple

from ..base.errors import SceneError
from ..engine.beam import Beam
from ..results.formatting import UNITS
from ..scene.names import labels
from ..scene.structs import Scene
from ..scene.wording import choice, shown
from .scene_cases import AT_SUPPORTS, ERRORS, LIMIT
from .wanted import known_results

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
    known = [name for name in (*known_results(scene, beam), LIFTED) if name != "input"]
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
