"""Sizes and words that pictures share: panels and their axes, outcomes, long texts."""

import textwrap
from typing import TYPE_CHECKING

from matplotlib.ticker import ScalarFormatter

from ..base.characters import with_minus_signs
from ..engine.quantities import QUANTITIES
from ..results import formatting as fmt
from ..results.equilibrium import acting_axial_forces, feels_axial_force

if TYPE_CHECKING:
    from ..results.result import Result
    from ..results.state.step import Step
    from ..scene.structs import Scene

#: Inches. The width is that of an A4 page between its margins.
WIDTH, LEFT, RIGHT, PANEL, SPACE = 7.4, 0.95, 0.15, 1.5, 0.14

#: Points of a curve at most, about: a span gets fewer points where there are many spans
MOST_POINTS = 100_000

#: Of a line of a heading
MOST_CHARACTERS = 105
FIXED = "\N{NO-BREAK SPACE}"
PLAIN = 1e-3, 1e6
"""Largest numbers of an axis between which they have equally many decimals."""

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
    words = (begin + fmt.sentence(result.reason)).replace(" = ", f"{FIXED}={FIXED}")
    return "\n".join(textwrap.wrap(words, MOST_CHARACTERS)).replace(FIXED, " ")


def axial_force_told(result: "Result", step: "Step") -> str:
    """Say between which values the axial force is that bending feels; nothing where there is none.

    Parameters
    ----------
    result : Result
        Of one load.
    step : Step
        One of its states.
    """
    if not feels_axial_force(result):
        return ""
    forces = [force for *_, left, right in acting_axial_forces(result, step) for force in (left, right)]
    ends = dict.fromkeys(fmt.value(result.scene, "axial_force", force) for force in (min(forces), max(forces)))
    return with_minus_signs(f", N {' to '.join(ends)}")


def cut_text(text: str, most: int) -> str:
    """Cut a text after so many characters.

    Examples
    --------
    >>> cut_text("a long text", 8)
    'a lon...'
    """
    return text if len(text) <= most else text[: most - 3] + "..."


class Numbers(ScalarFormatter):
    """Numbers of an axis in the unit that is shown, without a power of ten apart from them.

    Parameters
    ----------
    factor : float
        How many shown units are one of the scene.
    """

    def __init__(self, factor: float = 1.0) -> None:
        super().__init__(useOffset=False)
        self.set_scientific(False)
        self.factor = factor

    def __call__(self, value: float, position: int | None = None) -> str:
        """Write a number."""
        largest = max(map(abs, self.axis.get_view_interval()))
        if self.factor == 1.0 and (PLAIN[0] <= largest < PLAIN[1] or not largest):
            return super().__call__(value, position)
        return with_minus_signs(fmt.number(self.factor * value))


def axis_label(scene: "Scene", quantity: str, words: str, positive: str | None = None) -> str:
    """Word the label of an axis, with its unit and its sign.

    Parameters
    ----------
    scene : Scene
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
