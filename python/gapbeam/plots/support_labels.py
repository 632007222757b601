"""Numbers, reactions, openings and gaps of supports: texts below the beam that keep clear of one another."""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..results import formatting as fmt
from ..scene.names import labels
from .labels import LINE, Labels, text_width

if TYPE_CHECKING:
    from ..results.state.step import Step
    from ..scene.structs import Scene

DIGITS = 4
"""Of a reaction."""
MOST_LINES = 6
"""Lines that the gaps may take under the numbers of the supports."""
ROWS, MOST_ROWS = 2, 5
"""Rows that reactions take at most, and openings."""
MOST_UNITS = 8
"""Places up to which every reaction has its unit beside it; else the unit stands at the left."""
MOST_PLACES, MOST_LARGEST = 60, 16
"""Places up to which all reactions and openings are labelled if there is room, and how many of either where there are more."""
DENSE = 20.0
"""Distance of places below which they are near one another (points)."""
NONE = 1e-9
"""Reactions and openings below this share of the largest, or of the deflections, are said to be none."""


class Text(NamedTuple):
    """A text: its middle along the beam, the height of its upper edge (points), words, whether it tells of no contact."""

    x: float
    y: float
    words: str
    lifted: bool = False


class SupportTexts:
    """Lay out the texts of the supports from a height downward.

    Parameters
    ----------
    scene : Scene
        The scene.
    x : numpy.ndarray
        Places of the supports.
    width : float
        Width of the panel (points).
    top : float
        Upper edge of the first line (points).
    step : Step, optional
        State whose reactions and openings are written.

    Attributes
    ----------
    texts : list of Text
        What is written.
    bottom : float
        Lower edge (points).
    unit : str
        Heading of the reactions where their unit does not stand beside them; may be empty.
    note : str
        How many reactions are labelled, where not all are; else empty. It is the last of the texts.
    """

    def __init__(self, scene: Scene, x: np.ndarray, width: float, top: float, step: Step | None = None) -> None:
        self.scene, self.names = scene, labels(scene.supports)
        self.scale = (width - 60.0) / float(scene.span_ends()[-1])  # points per length
        self.page = (width - 22.0) / self.scale
        self.at: dict[float, list[int]] = defaultdict(list)
        for index, place in enumerate(x.tolist()):
            self.at[place].append(index)
        self.unit = self.note = ""
        groups, every = self._groups()
        self.texts = [Text(_middle(group), top, self._numbers(group)) for group in groups]
        self.alone = {group[0] for group in groups if len(group) == 1}
        rows = self._reactions(step, top - LINE) if step is not None else 0
        if every == 1:
            self._gaps(top - LINE * (1 + rows))
        if self.note:
            foot = min(text.y - LINE * (1 + text.words.count("\n")) for text in self.texts)
            self.texts.append(Text(float(scene.span_ends()[-1]) / 2, foot - 2.0, self.note))
        self.bottom = min((text.y - LINE * (1 + text.words.count("\n")) for text in self.texts), default=top) - 1.0

    def _groups(self) -> tuple[list[list[float]], int]:
        """Choose the places whose supports are numbered: near ones together, every one in so many."""
        steps = (1, 2, 5, 10, 20, 50, 10 ** max(2, len(str(len(self.at))) - 1))
        every = next(step for step in steps if len(self.at) / step <= 32)
        groups: list[list[float]] = []
        for place in sorted(self.at)[::every]:
            if not groups or (place - _middle(groups[-1])) * self.scale > (self._width(groups[-1]) + self._width([place])) / 2:
                groups.append([place])
            elif every == 1:
                groups[-1].append(place)  # too near for a label of its own
        return groups, every

    def _width(self, places: list[float]) -> float:
        return text_width(self._numbers(places))

    def _numbers(self, places: list[float]) -> str:
        """Write the names or numbers of the supports at some places."""
        indices = [index for place in places for index in self.at[place]]
        if len(indices) <= 3:
            return ", ".join(self.names[index] for index in indices)
        return fmt.ranges(sorted(indices))

    def _reactions(self, step: Step, top: float) -> int:
        """Write reactions and openings, what has no contact first, then the largest; return the number of rows they take."""
        few = len(self.at) <= MOST_UNITS
        lines = {place: found for place, indices in self.at.items() if (found := self._lines(step, place, indices, few))}
        if not few:
            self.unit = fmt.with_unit(self.scene, "reaction")
        # Where places are near one another, what has no contact stands under the reactions
        dense = (len(self.at) - 1) * DENSE > self.page * self.scale
        order = sorted(lines, key=lambda place: (not lines[place][2], -lines[place][1]))
        if len(self.at) > MOST_PLACES:
            order = [place for lifted in (True, False) for place in [p for p in order if lines[p][2] == lifted][:MOST_LARGEST]]
        taken, used, written = Labels(), 0, 0
        for place in order:
            words, _, lifted = lines[place]
            middle = min(place, self.page - text_width(words) / 2 / self.scale)
            high = 1 + words.count("\n")
            for row in range(ROWS * (dense and lifted), MOST_ROWS if lifted else ROWS):
                if taken.take(middle * self.scale, top - LINE * (row + high), words):
                    self.texts.append(Text(middle, top - LINE * row, words, lifted))
                    used, written = max(used, row + high), written + 1
                    break
        if written < len(lines):
            self.note = f"reactions at {written} of {fmt.count(len(lines), 'place')} labelled, the largest"
        return used

    def _lines(self, step: Step, place: float, indices: list[int], few: bool) -> tuple[str, float, bool] | None:
        """Word what the supports of a place do: a line each, the largest reaction or opening, and whether none of them acts."""
        scene, found, largest, axial = self.scene, [], 0.0, 0.0
        small = NONE * float(np.abs(step.reaction).max(initial=0.0))
        acting = [k for k in indices if abs(step.reaction[k]) > small]
        for k in acting:
            force = abs(float(step.reaction[k]))
            if scene.supports[k].direction == "axial":
                arrow = "\N{RIGHTWARDS ARROW}" if step.reaction[k] > 0.0 else "\N{LEFTWARDS ARROW}"
                found.append((k, f"{arrow} {_with_unit(scene, 'reaction', force)}"))
                axial = max(axial, force)
            else:
                found.append((k, _with_unit(scene, "reaction", force) if few else fmt.number(force, DIGITS)))
                largest = max(largest, force)
        across = [k for k in indices if scene.supports[k].direction == "normal"]
        small = NONE * float(np.abs(step.deflection).max(initial=0.0))
        lifted = bool(across) and not largest and all(step.state[k] == "open" and step.opening[k] > small for k in across)
        if lifted:
            largest = max(float(step.opening[k]) for k in across)
            found += [(k, f"open {_with_unit(scene, 'opening', float(step.opening[k]))}") for k in across]
        elif across and not largest and few:
            found.append((across[0], "0"))
        named = len(across) > 1 or place not in self.alone
        words = [f"{self.names[k]}: {text}" if named else text for k, text in found]
        small = NONE * float(np.abs(step.couple).max(initial=0.0))
        for k in indices:
            if abs(step.couple[k]) > small:
                arrow = "\N{CLOCKWISE OPEN CIRCLE ARROW}" if step.couple[k] > 0.0 else "\N{ANTICLOCKWISE OPEN CIRCLE ARROW}"
                words.append(f"{arrow} {_with_unit(scene, 'couple', abs(float(step.couple[k])))}")
        return ("\n".join(words), max(largest, axial), lifted) if words else None

    def _gaps(self, top: float) -> None:
        """Write the gaps under the rest, further down where they would cover one another; none where that goes too far.

        Places of which the number stands alone need not repeat it.
        """
        rows, written, supports = Labels(), [], self.scene.supports
        for place, indices in sorted(self.at.items()):
            gaps = {k: _with_unit(self.scene, "gap", supports[k].gap) for k in indices if supports[k].gap}
            if not gaps:
                continue
            sides = {supports[k].side for k in indices}
            each = [f"{self.names[k]}{f' {supports[k].side}' if len(sides) > 1 else ''}: gap {gap}" for k, gap in gaps.items()]
            texts = ["\n".join(each)] * MOST_LINES
            if place in self.alone and len(gaps) == len(indices) and len(set(gaps.values())) == 1:
                texts[0] = f"gap {gaps[indices[0]]}"  # right under the numbers, and the same for all of them
            for line, text in enumerate(texts):
                middle = min(place, self.page - text_width(text) / 2 / self.scale)
                lines = line + 1 + text.count("\n")
                if lines <= MOST_LINES and rows.take(middle * self.scale, top - LINE * lines, text):
                    written.append(Text(middle, top - LINE * line, text))
                    break
            else:
                return
        self.texts += written


def _middle(places: list[float]) -> float:
    return (places[0] + places[-1]) / 2


def _with_unit(scene: Scene, quantity: str, value: float) -> str:
    """Write a value with its unit, displacements in mm where lengths are in m."""
    unit, factor = fmt.shown_unit(scene, quantity)
    return f"{fmt.number(factor * value, DIGITS)} {unit}".rstrip()
