"""Ground along the axis of the beam in the report: what there is, and where the beam slides over it."""

from typing import TYPE_CHECKING

from ..results import formatting as fmt
from .ground import pair
from .writer import LONGEST, Writer, left_out

if TYPE_CHECKING:
    from ..results.result import Result

RIGID = float("inf")

def write_axial_ground(say: Writer, result: "Result", at: str) -> None:
    """List the ground along the beam, and where the beam slides, or has slid last, over it.

    Parameters
    ----------
    say : Writer
        Where to write.
    result : Result
        With a step.
    at : str
        The load factor in words.
    """
    scene, zones = result.scene, result.steps[-1].slip_zones
    grounds = scene.axial_ground
    if not grounds:
        return
    say.heading("Ground along the beam")
    from_, to = zip(*(fmt.stretch(scene, item) for item in grounds), strict=True)
    columns = [
        ("", fmt.numbered(grounds)),
        (fmt.stacked(scene, "x", "from"), fmt.column(from_, fmt.DIGITS)),
        (fmt.stacked(scene, "x", "to"), fmt.column(to, fmt.DIGITS)),
        (fmt.stacked(scene, "k", "stiffness"), ["rigid" if item.stiffness == RIGID else pair(item.stiffness) for item in grounds]),
        (fmt.stacked(scene, "uniform", "limit"), ["none" if item.limit is None else pair(item.limit) for item in grounds]),
    ]
    say.table([name for name, _ in columns], list(zip(*(texts for _, texts in columns), strict=True)))
    if not zones:
        return
    say.heading(f"Slip along the ground {at}")
    rows = [
        [fmt.number(one.from_, fmt.DIGITS), fmt.number(one.to, fmt.DIGITS), fmt.number(one.to - one.from_, fmt.DIGITS),
         one.way, fmt.shown(scene, "reaction", one.friction)]
        for one in zones[:LONGEST]
    ]  # fmt: skip
    say.table(["from", "to", "length", "way of the beam", fmt.shown_heading(scene, "reaction", "friction")], rows)
    when = "Now, or last. " if all(one.stiffness == RIGID for one in grounds) else ""
    say.line(f"{when}Friction on the beam: positive to the right.{left_out(len(zones))}", "dim")
