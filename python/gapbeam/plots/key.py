"""Letters and colours for what governs: combinations and trains, told once below the picture; what else stands there."""

from __future__ import annotations

import string
import textwrap
from typing import TYPE_CHECKING

from ..base.characters import visible, with_minus_signs
from ..results.contact import position_in_words
from .panels import FIXED

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from ..results.envelopes.envelope import Extreme
    from ..results.trains.members import TrainExtreme
    from ..scene.structs import Scene

COLOURS = ("#F6C667", "#9CD3F2", "#7FD0B8", "#F7F08A", "#A9BEE8", "#F0A67C", "#E3B5CF", "#D2D2D2")
"""Light, so that letters are read on them; letters tell what colours repeat."""
LETTERS = string.ascii_uppercase + string.ascii_lowercase
CHARACTERS = 125
"""Of a line of the key."""
LINE = 0.15
"""Inches of a line of the key."""


class Key:
    """Gives every source a letter when it is first asked for.

    Parameters
    ----------
    scene : Scene
        Whose beam positions are along.
    count : int
        Sources that there are: one alone needs no letter.
    told : dict, optional
        By name of the source that which is told, and its limit state.
    """

    def __init__(self, scene: Scene, count: int, told: dict[str, tuple[str, str]] | None = None) -> None:
        self._scene, self.needed = scene, count > 1
        self._told = told or {}
        self._letters: dict[str, str] = {}

    def letter(self, name: str) -> str:
        """Give the letter of a source; a number where letters are used up."""
        number = len(self._letters)
        return self._letters.setdefault(name, LETTERS[number] if number < len(LETTERS) else str(number + 1))

    def colour(self, name: str) -> str:
        """Give its colour."""
        self.letter(name)
        return COLOURS[list(self._letters).index(name) % len(COLOURS)]

    def source(self, extreme: Extreme | TrainExtreme) -> str:
        """Word where a value comes from: a letter, and the position of the train."""
        position = getattr(extreme, "position", None)
        name = source_name(extreme)
        words = [self.letter(self._told.get(name, (name, ""))[0])] if self.needed else []
        words += [] if position is None else [f"at {position_in_words(self._scene, position, 4)}"]
        return with_minus_signs(" ".join(words))

    def lines(self) -> list[str]:
        """Write the key."""
        ends = {name.rpartition(", ")[1:] for name in self._letters}
        alike = "".join(ends.pop()) if len(ends) == 1 and len(self._letters) > 1 else ""  # the same train in all
        of = {name: f" ({visible(limit_state)})" for name, limit_state in self._told.values() if limit_state}
        entries = [
            f"{letter} = {name.removesuffix(alike)}{of.get(name, '')}".replace(" ", FIXED) for name, letter in self._letters.items()
        ]
        return textwrap.wrap("; ".join(entries), CHARACTERS, break_on_hyphens=False)


def foot_height(lines: list[str]) -> float:
    """Give the height of lines at the foot of a picture (inches)."""
    return LINE * len(lines) + 0.08 * bool(lines)


def write_foot(picture: Figure, lines: list[str]) -> None:
    """Write lines at the foot of a picture, which has room for them."""
    width, height = picture.get_size_inches()
    for row, line in enumerate(reversed(lines)):
        picture.text(0.24 / width, (0.06 + LINE * row) / height, line, fontsize=7, va="bottom", color="0.15")


def source_name(of: object) -> str:
    """Name what a value comes from: a combination, a train, the way it goes.

    Parameters
    ----------
    of : Source, Extreme, TrainExtreme or Member
        Any that knows its combination, train and direction.
    """
    names = [getattr(of, name, None) for name in ("combination", "train")]
    back = " to the left" if getattr(of, "direction", None) == "left" else ""
    return ", ".join(visible(name) for name in names if name) + back
