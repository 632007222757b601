"""Sizes and words that pictures share: panels and their axes, outcomes, long texts."""

import textwrap
from typing import TYPE_CHECKING

from ..engine.quantities import QUANTITIES
from ..results import formatting as fmt

if TYPE_CHECKING:
    from ..results.result import Result
    from ..scene.structs import Scene

#: Inches. The width is that of an A4 page between its margins.
WIDTH, LEFT, RIGHT, PANEL, SPACE = 7.4, 0.95, 0.15, 1.5, 0.14

#: Points of a curve at most, about: a span gets fewer points where there are many spans
MOST_POINTS = 100_000

Point = tuple[float, float]

#: Quantity, words on the axis, whether positive values are drawn downward
PANELS = tuple((one.name, one.panel, one.downward) for one in QUANTITIES if one.panel)


def outcome(result: "Result") -> str:
    """Say why there is no equilibrium, or which limit the load has.

    Parameters
    ----------
    result : Result
        That is not solved to the end.
    """
    begin = "No equilibrium. " if result.status == "no-equilibrium" else ""
    return "\n".join(textwrap.wrap(begin + fmt.sentence(result.reason), 105))


def cut_text(text: str, most: int) -> str:
    """Cut a text after so many characters.

    Examples
    --------
    >>> cut_text("a long text", 8)
    'a lon...'
    """
    return text if len(text) <= most else text[: most - 3] + "..."


def axis_label(scene: "Scene", quantity: str, words: str, positive: str | None = None) -> str:
    """Word the label of an axis, with its unit and its sign.

    Parameters
    ----------
    scene : Scene
        The scene.
    quantity, words : str
        What it shows, and what is written.
    positive : str, optional
        Where all positive values go, in pictures of upright beams.
    """
    if quantity == "motion":
        return f"{words}\nscale arbitrary"
    label = fmt.shown_heading(scene, quantity, words)
    sign = {"moment": "drawn on the tension side", "pressure": "positive upward", "deflection": "positive downward"}
    if positive is not None:
        sign = {"moment": sign["moment"], "pressure": "positive to the left", "deflection": f"positive to the {positive}"}
    return f"{label}\n{sign.get(quantity, '')}".rstrip()


def counts(value: float, extreme: dict[str, tuple[float, float]]) -> bool:
    """Decide whether an extreme is worth words: zero at an end of the beam is not."""
    return abs(value) > 1e-6 * max(abs(pair[0]) for pair in extreme.values())
