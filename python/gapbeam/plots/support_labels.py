"""Numbers, reactions, openings, gaps, settlements and springs of supports: texts beside the beam that keep clear of one another."""

from __future__ import annotations

import textwrap
from collections import defaultdict
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..base.characters import with_minus_signs
from ..results import formatting as fmt
from ..scene.rotations import turns
from .labels import LINE, MARGIN, Labels, spread, text_width
from .panels import FIXED
from .support_values import SupportValues, properties, short_names

if TYPE_CHECKING:
    from ..scene.structs import Scene
    from .movements import Movements

MOST_LINES = 8
"""Lines that gaps and springs may take under the numbers of the supports."""
ROWS, MOST_ROWS = 3, 6
"""Rows that reactions take at most, and openings."""
MOST_UNITS = 8
"""Places up to which every reaction has its unit beside it; else the unit stands at the left."""
MOST_PLACES, MOST_LARGEST = 60, 16
"""Places up to which all reactions and openings are labelled if there is room, and how many of either where there are more."""
DENSE = 20.0
"""Distance of places below which they are near one another (points)."""
EACH = 3
"""Supports with the same gap or spring, of which it is said once for all of them."""
BESIDE, ALONE = 40, 50
"""Characters of a line beside an upright beam; where every place has one only."""
WIDE = 110
"""Characters of a line of a note."""


class Text(NamedTuple):
    """A text: its middle along the beam, the height of its upper edge (points), words, whether it tells of no contact."""

    x: float
    y: float
    words: str
    lifted: bool = False


class SupportTexts:
    """Lay out the texts of the supports from a height downward; of an upright beam to the right.

    Parameters
    ----------
    scene : Scene
        The scene.
    x : numpy.ndarray
        Places of the supports.
    length : float
        Length of the drawn beam (points).
    top : float
        Upper edge of the first line (points).
    values : SupportValues, optional
        Reactions and openings.
    upright : bool
        Whether the beam stands.
    movements : Movements, optional
        Of supports, by loads.

    Attributes
    ----------
    texts : list of Text
        What is written.
    bottom : float
        Lower edge (points).
    unit : str
        Heading of the reactions where their unit does not stand beside them; may be empty.
    notes, foot : list of str
        What holds for many supports, and what is not labelled; as much of that as belongs at the foot of the page.
    """

    def __init__(
        self, scene: Scene, x: np.ndarray, length: float, top: float, values: SupportValues | None = None, upright: bool = False,
        movements: Movements | None = None,
    ) -> None:  # fmt: skip
        self.scene, self.names, self.values, self.movements = scene, short_names(scene), values, movements
        self.scale = length / float(scene.span_ends()[-1])  # points per length
        self.page = (length + 38.0) / self.scale
        self.at: dict[float, list[int]] = defaultdict(list)
        for index, place in enumerate(x.tolist()):
            self.at[place].append(index)
        self.unit, self.notes = "", []
        self.foot: list[str] = []
        self.few = len(self.at) <= MOST_UNITS
        self.each = self._common()
        if upright:
            self.texts = self._beside(top)
            self.bottom = min((text.y - text_width(text.words) for text in self.texts), default=top) - 2.0
            self.foot = self.notes
        else:
            groups, every = self._groups()
            words = [self._numbers(group) for group in groups]
            self.texts = [Text(self._inside(_middle(group), text), top, text) for group, text in zip(groups, words, strict=True)]
            self.alone = {group[0] for group in groups if len(group) == 1}
            rows = self._reactions(top - LINE) if values is not None else 0
            self._properties(top - LINE * (1 + rows), every)
            foot = min((text.y - LINE * (1 + text.words.count("\n")) for text in self.texts), default=top)
            for k, note in enumerate(self.notes):
                self.texts.append(Text(float(scene.span_ends()[-1]) / 2, foot - 2.0 - LINE * k, note))
            self.bottom = min((text.y - LINE * (1 + text.words.count("\n")) for text in self.texts), default=top) - 1.0

    def _common(self) -> set[tuple[str, str]]:
        """Find what many supports have alike, and note it once."""
        found: dict[tuple[str, str], list[str]] = defaultdict(list)
        sides = {support.side for support in self.scene.supports} - {"both"}
        for k, support in enumerate(self.scene.supports):
            for kind, words in self._told_of(k).items():
                found[kind, support.side].append(words)
        each = {pair for pair, words in found.items() if len(words) > EACH and len(set(words)) == 1}
        notes: dict[str, list[str]] = defaultdict(list)
        for kind, side in sorted(each, key=lambda pair: (pair[1], pair[0])):
            where = f" {side}" * (len(sides) > 1 and side != "both")
            notes[f"{len(found[kind, side])} supports{where}"].append(found[kind, side][0])
        self.notes += textwrap.wrap("; ".join(f"{which}: {', '.join(words)} each" for which, words in notes.items()), WIDE)
        return each

    def _told_of(self, k: int) -> dict[str, str]:
        """Word what a support is, and what moves it."""
        return properties(self.scene, k) | (self.movements.words(k) if self.movements else {})

    def _groups(self) -> tuple[list[list[float]], int]:
        """Choose the places whose supports are numbered: near ones together, every one in so many."""
        steps = (1, 2, 5, 10, 20, 50, 10 ** max(2, len(str(len(self.at))) - 1))
        every = next(step for step in steps if len(self.at) / step <= 32)
        groups: list[list[float]] = []
        self.named = self.values is not None and every == 1 and not all(name.isdigit() for name in self.names)
        if self.named:
            return self._apart(), every
        for place in sorted(self.at)[::every]:
            if not groups or (place - _middle(groups[-1])) * self.scale > (self._width(groups[-1]) + self._width([place])) / 2:
                groups.append([place])
            elif every == 1:
                groups[-1].append(place)  # too near for a label of its own
        return groups, every

    def _apart(self) -> list[list[float]]:
        """Choose the places whose names have room beside one another; the others are named where their reactions stand."""
        places = sorted(self.at)
        close = [
            (second - first) * self.scale <= (self._width([first]) + self._width([second])) / 2
            for first, second in pairwise(places)
        ]
        beside = zip(places, [False, *close], [*close, False], strict=True)
        return [[place] for place, before, after in beside if not (before or after)]

    def _width(self, places: list[float]) -> float:
        return text_width(self._numbers(places))

    def _numbers(self, places: list[float]) -> str:
        """Write the names or numbers of the supports at some places."""
        indices = [index for place in places for index in self.at[place]]
        # What holds a rotation stands with its support
        indices = [index for index in indices if self.scene.supports[index].direction != "rotational"] or indices
        if len(indices) <= 3:
            return ", ".join(self.names[index] for index in indices)
        return fmt.ranges(sorted(indices))

    def _reactions(self, top: float) -> int:
        """Write reactions and openings, what has no contact first, then the largest; return the number of rows they take."""
        told = {place: self.values.told(indices, self.few, place not in self.alone) for place, indices in self.at.items()}
        for place in told.keys() - self.alone if self.named else ():
            if not (told[place].lines or told[place].openings):
                told[place] = told[place]._replace(lines=(self._numbers([place]),))
        told = {place: one for place, one in told.items() if one.lines or one.openings}
        if not self.few:
            self.unit = self.values.heading
        # Where places are near one another, what has no contact stands under the reactions
        dense = (len(self.at) - 1) * DENSE > self.page * self.scale
        order = sorted(told, key=lambda place: (not told[place].lifted, -told[place].size))
        if len(self.at) > MOST_PLACES:
            order = [place for lifted in (True, False) for place in [p for p in order if told[p].lifted == lifted][:MOST_LARGEST]]
        taken, used, written = Labels(), 0, 0
        tallest = max((len(one.lines) + len(one.openings) for one in told.values()), default=1)
        for place in order:
            one = told[place]
            every, lifted = (*one.lines, *one.openings), one.lifted
            words, high = "\n".join(every), len(every)
            middle = self._inside(place, words)
            for row in range(ROWS * (dense and lifted), (MOST_ROWS if lifted or self.named else ROWS) * tallest):
                if taken.take(middle * self.scale, top - LINE * (row + high), words):
                    if one.lines:
                        self.texts.append(Text(middle, top - LINE * row, "\n".join(one.lines), lifted and not one.openings))
                    if one.openings:
                        self.texts.append(Text(middle, top - LINE * (row + len(one.lines)), "\n".join(one.openings), True))
                    used, written = max(used, row + high), written + 1
                    break
        if written < len(told):
            self.notes.append(f"reactions at {written} of {fmt.count(len(told), 'place')} labelled, the largest")
        return used

    def _inside(self, place: float, words: str) -> float:
        """Move the middle of a text so that it stands on the page."""
        half = text_width(words) / 2 / self.scale
        return max(min(place, self.page - half), half - MARGIN / self.scale)

    def _properties(self, top: float, every: int) -> None:
        """Write gaps, settlements and springs under the rest, further down where they would cover one another.

        Places of which the number stands alone need not repeat it. What has no room is summed up.
        """
        if not self._write_properties(top, every):
            self._sum_up(self._write_properties(top, every, "movement"))

    def _write_properties(self, top: float, every: int, only: str = "") -> bool:
        """Write what supports are, or of it only what begins like this; nothing where not all has room."""
        rows, written = Labels(), []
        wanted = {place: words for place, indices in sorted(self.at.items()) if (words := self._of_place(place, indices, only))}
        for place, text in wanted.items() if every == 1 else ():
            middle, high = self._inside(place, text), 1 + text.count("\n")
            for line in range(MOST_LINES):
                if line + high <= MOST_LINES and rows.take(middle * self.scale, top - LINE * (line + high), text):
                    written.append(Text(middle, top - LINE * line, text))
                    break
        if len(written) < len(wanted):
            return False
        self.texts += written
        return True

    def _of_place(self, place: float, indices: list[int], only: str = "") -> str:
        """Word what the supports of a place are, as far as it is not said of all."""
        found = {
            k: [words for kind, words in self._told_of(k).items()
                if kind.startswith(only) and (kind, self.scene.supports[k].side) not in self.each]
            for k in indices
        }
        found = {k: words for k, words in found.items() if words}
        if not found:
            return ""
        same = len(found) == len(indices) and len({tuple(words) for words in found.values()}) == 1
        if same and place in getattr(self, "alone", self.at):
            return "\n".join(found[indices[0]])
        across = {k: self.scene.supports[k].side for k in indices if self.scene.supports[k].direction == "normal"}
        sides = len(set(across.values())) > 1
        names = {k: f"{self.names[k]} {across[k]}" if sides and k in across else self.names[k] for k in found}
        return "\n".join(f"{names[k]}: {words}" for k, each in found.items() for words in each)

    def _sum_up(self, moved: bool) -> None:
        """Note between which values gaps, settlements, springs and movements are, where they cannot all be written."""
        supports = [support for support in self.scene.supports if not turns(support)]
        moves = [] if moved or self.movements is None else self.movements.supports
        values = {
            "gaps": ("gap", [s.gap for s in supports if s.gap]),
            "slacks": ("rotation", [s.gap for s in self.scene.supports if s.gap and turns(s)]),
            "settlements": ("gap", [s.settlement for s in supports if s.settlement]),
            "springs": ("uniform", [s.stiffness for s in supports if 0.0 < s.stiffness < np.inf and s.law is None]),
            "movements": ("gap", [one.value for one in moves if one.kind != "turn"]),
            "turns": ("rotation", [one.value for one in moves if one.kind == "turn"]),
        }
        words = []
        for name, (quantity, found) in values.items():
            if not found or name.removesuffix("s") in {kind for kind, _ in self.each}:
                continue
            unit, factor = fmt.shown_unit(self.scene, quantity)
            low, high = (with_minus_signs(fmt.number(factor * value, 4)) for value in (min(found), max(found)))
            reach = f"of {low}" if low == high else f"from {low} to {high}"
            words.append(f"{fmt.count(len(found), name.removesuffix('s'))} {reach} {unit}".rstrip().replace(" ", FIXED))
        self.notes += [line.replace(FIXED, " ") for line in textwrap.wrap("; ".join(words), WIDE)]

    def _beside(self, start: float) -> list[Text]:
        """Write lines for every place to the right of an upright beam, moved along it as little as need be.

        Gaps, settlements and springs are summed up where not all has room, then of every place there is one line.
        """
        most = int(self.page * self.scale / LINE)
        if self.values is not None and not self.few:
            self.notes.append(f"beside supports: {self.values.heading}")
        found = self._rows_beside(True, BESIDE)
        if sum(len(rows) for _, rows, _ in found) > most:
            self._sum_up(False)
            found = self._rows_beside(False, BESIDE)
        if sum(len(rows) for _, rows, _ in found) > most:
            found = [(place, [f"{rows[0]} ..." if rows[1:] else rows[0]], lifted)
                     for place, rows, lifted in self._rows_beside(False, ALONE)]  # fmt: skip
        if len(found) > most:
            every = -(-len(found) // most)
            found, places = found[::every], fmt.count(len(found), "place")
            self.notes.append(f"{len(found)} of {places} labelled")
        wanted = [place * self.scale + LINE * (k - (len(rows) - 1) / 2) for place, rows, _ in found for k in range(len(rows))]
        texts = [(row, lifted) for _, rows, lifted in found for row in rows]
        at = spread(wanted, LINE, self.page * self.scale - LINE / 2)
        return [Text(y / self.scale, start, text, lifted) for y, (text, lifted) in zip(at, texts, strict=True)]

    def _rows_beside(self, whole: bool, characters: int) -> list[tuple[float, list[str], bool]]:
        """Word every place in rows of so many characters, with what its supports are if asked, and whether they have no contact."""
        found = []
        for place, indices in sorted(self.at.items()):
            told = self.values.told(indices, self.few, False) if self.values is not None else None
            lines = [*told.lines, *told.openings] if told else []
            of_place = self._of_place(place, indices) if whole else ""
            lines += of_place.replace("\n", ", ").split("\n") if of_place else []
            across = sum(self.scene.supports[k].direction == "normal" for k in indices)
            head = self._numbers([place])
            unbroken = [line.replace(" ", FIXED) for line in lines]  # broken between what is said
            text = head if not lines else f"{head}: {', '.join(unbroken)}" if across < 2 else ", ".join(unbroken)
            rows = [row.replace(FIXED, " ") for row in textwrap.wrap(text, characters, break_long_words=False)]
            found.append((place, rows, bool(told and told.lifted)))
        return found


def _middle(places: list[float]) -> float:
    return (places[0] + places[-1]) / 2
