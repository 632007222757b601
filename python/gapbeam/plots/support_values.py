"""Words of supports in pictures: reactions, openings, contact states; of one state, or of an envelope."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from ..base.characters import with_minus_signs
from ..results import formatting as fmt
from ..results.views.extreme import KINDS
from ..scene.names import labels
from ..scene.rotations import turns
from .panels import cut_text
from .sheet import is_upright

if TYPE_CHECKING:
    from ..results.envelopes.envelope import Envelope
    from ..results.state.step import Step
    from ..results.trains.envelope import TrainEnvelope
    from ..scene.structs import Scene
    from .key import Key

DIGITS = 4
"""Of a reaction."""
MOST_CHARACTERS = 26
"""Of the name of a support."""
NONE = 1e-9
"""Reactions and openings below this share of the largest, or of the deflections, are said to be none."""
LYING = "\N{LEFTWARDS ARROW}\N{RIGHTWARDS ARROW}", "\N{ANTICLOCKWISE OPEN CIRCLE ARROW}\N{CLOCKWISE OPEN CIRCLE ARROW}"
UPRIGHT = "\N{UPWARDS ARROW}\N{DOWNWARDS ARROW}", LYING[1][::-1]
"""Arrows along the beam and around, each the negative one first."""


class Told(NamedTuple):
    """What is said of the supports of a place.

    Attributes
    ----------
    lines : tuple of str
        Reactions; openings too where none acts.
    size : float
        The largest reaction or opening.
    lifted : bool
        Whether none of them acts, or one lifts off in an envelope.
    openings : tuple of str
        More lines, on openings in an envelope.
    """

    lines: tuple[str, ...]
    size: float
    lifted: bool
    openings: tuple[str, ...] = ()


class SupportValues(Protocol):
    """Values at supports.

    Attributes
    ----------
    up, down : numpy.ndarray
        The largest reactions that push the beam up and down, 0 where there is none, of supports across the beam.
    heading : str
        What the numbers are, where they stand without a unit.
    """

    up: np.ndarray
    down: np.ndarray
    heading: str

    def told(self, indices: Sequence[int], few: bool, named: bool) -> Told:
        """Word what the supports of a place do: with units if there are few, by their names if asked."""


class StateValues:
    """Reactions and openings of one state.

    Parameters
    ----------
    scene : Scene
        The scene.
    step : Step
        The state.
    """

    def __init__(self, scene: Scene, step: Step) -> None:
        self._scene, self._step, self._names = scene, step, short_names(scene)
        force = _across(scene, step.reaction)
        self._small = NONE * float(np.abs(step.reaction).max(initial=0.0))
        self.up, self.down = np.maximum(force, 0.0), np.maximum(-force, 0.0)
        self.heading = fmt.with_unit(scene, "reaction")
        self._along, self._round = UPRIGHT if is_upright(scene) else LYING

    def told(self, indices: Sequence[int], few: bool, named: bool) -> Told:
        """As `SupportValues.told`."""
        scene, step, found, largest, axial = self._scene, self._step, [], 0.0, 0.0
        for k in indices:
            force = abs(float(step.reaction[k]))
            if force <= self._small or turns(scene.supports[k]):
                continue
            if scene.supports[k].direction == "axial":
                arrow = self._along[int(step.reaction[k] > 0.0)]
                found.append((k, f"{arrow} {with_unit(scene, 'reaction', force)}"))
                axial = max(axial, force)
            else:
                found.append((k, with_unit(scene, "reaction", force) if few else fmt.number(force, DIGITS)))
                largest = max(largest, force)
        across = [k for k in indices if scene.supports[k].direction == "normal"]
        small = NONE * float(np.abs(step.deflection).max(initial=0.0))
        opened = [k for k in across if step.state[k] == "open" and step.opening[k] > small]
        lifted = bool(opened) and not largest and all(step.state[k] == "open" for k in across)
        if lifted:
            largest = max(float(step.opening[k]) for k in opened)
            found += [(k, f"open {with_unit(scene, 'opening', float(step.opening[k]))}") for k in opened]
        elif across and not largest and few:
            found.append((across[0], "0"))
        rubs = [k for k in across if abs(float(step.friction[k])) > self._small]
        found += [
            (k, f"{self._along[int(step.friction[k] > 0.0)]} {with_unit(scene, 'friction', abs(float(step.friction[k])))}")
            for k in rubs
        ]
        words = [text for _, text in found]
        if named or len(across) > 1:  # named once, where its values begin
            at = [i for i, (k, _) in enumerate(found) if i == 0 or k != found[i - 1][0]]
            words = [f"{self._names[k]}: {text}" if i in at else text for i, (k, text) in enumerate(found)]
        small = NONE * float(np.abs(step.couple).max(initial=0.0))
        for k in indices:
            if abs(step.couple[k]) > small:
                arrow = self._round[int(step.couple[k] > 0.0)]
                words.append(f"{arrow} {with_unit(scene, 'couple', abs(float(step.couple[k])))}")
        return Told(tuple(words), max(largest, axial), lifted)


class EnvelopeValues:
    """Largest and smallest reactions, and the largest openings, with what they come from.

    Parameters
    ----------
    scene : Scene
        The scene.
    envelope : Envelope or TrainEnvelope
        Of it.
    key : Key
        Letters of what governs.
    """

    def __init__(self, scene: Scene, envelope: Envelope | TrainEnvelope, key: Key) -> None:
        self._scene, self._key, self._names = scene, key, short_names(scene)
        self._rows = envelope.supports
        count = len(scene.supports)
        pairs = ((name, kind) for name in ("reaction", "opening") for kind in KINDS)
        self._values = {pair: self._rows.values(*pair) if count else np.zeros(0) for pair in pairs}
        high, low = self._values["reaction", "max"], self._values["reaction", "min"]
        self.up, self.down = np.maximum(_across(scene, high), 0.0), np.maximum(-_across(scene, low), 0.0)
        self._small = NONE * float(max(np.abs(high).max(initial=0.0), np.abs(low).max(initial=0.0)))
        self.heading = fmt.with_unit(scene, "reaction")

    def told(self, indices: Sequence[int], few: bool, named: bool) -> Told:
        """As `SupportValues.told`."""
        words: list[str] = []
        openings: list[str] = []
        size, lifted, across = 0.0, False, [k for k in indices if self._scene.supports[k].direction == "normal"]
        held = {self._scene.supports[k].side for k in across} & {"below", "both"}
        for k in indices:
            support = self._scene.supports[k]
            if turns(support):
                continue
            both = (float(self._values["reaction", kind][k]) for kind in KINDS)
            high, low = (0.0 if abs(value) <= self._small else value for value in both)
            lines = [("max", "reaction", high)] if high > self._small or (support.side != "above" and high > low) else []
            if low < -self._small or (support.side != "above" and high > self._small):
                lines.append(("min", "reaction", low))
            if high and abs(high - low) <= self._small:
                lines = [("", "reaction", high)]  # whatever governs
            opening = float(self._values["opening", "max"][k])
            alone = support.side == "below" or not held
            if k in across and support.side != "both" and alone and opening > 0.0 and low <= self._small:
                lines.append(("open", "opening", opening))
                lifted = True
            size = max(size, abs(high), abs(low))
            begin = f"{self._names[k]} " if named or len(across) > 1 or (across and k not in across) else ""
            told = {id(words): begin, id(openings): begin}  # named once, where its values begin
            for kind, name, value in lines:
                if kind == "min" and abs(value) <= self._small and any(one[0] == "open" for one in lines):
                    continue  # that it opens says so
                text = with_unit(self._scene, name, value) if few or name == "opening" else fmt.number(value, DIGITS)
                source = self._key.source(self._rows[k][name]["max" if kind == "open" else kind]) if kind else ""
                short = source and " at " not in f" {source}"
                where = openings if kind == "open" else words
                begin = told.pop(id(where), "")
                line = with_minus_signs(f"{begin}{kind} {text}" if kind else f"{begin.strip()}: {text}".removeprefix(": "))
                where += [f"{line}, {source}"] if short else [line, *[source] * bool(source)]
        return Told(tuple(words), size, lifted, tuple(openings))

def short_names(scene: Scene) -> list[str]:
    """Name the supports; long names are cut at the end, or in the middle where the ends tell them apart."""
    whole = labels(scene.supports)
    found = [cut_text(name, MOST_CHARACTERS) for name in whole]
    half, often = MOST_CHARACTERS // 2 - 1, Counter(found)
    return [
        cut if cut == name or often[cut] == 1 else f"{name[:half]}...{name[-half:]}" for name, cut in zip(whole, found, strict=True)
    ]


def properties(scene: Scene, k: int) -> dict[str, str]:
    """Word the gap, the settlement and the spring of a support.

    Parameters
    ----------
    scene : Scene
    k : int
        Number of the support.

    Returns
    -------
    dict of str to str
        What there is, by kind.
    """
    support = scene.supports[k]
    found = {}
    if turns(support):
        if support.gap:
            found["gap"] = f"slack {with_unit(scene, 'rotation', support.gap)}"
        if support.law is None and support.stiffness < np.inf:
            found["spring"] = f"rotational spring {fmt.number(support.stiffness, DIGITS)} {_turning(scene)}".rstrip()
        return {kind: with_minus_signs(words) for kind, words in found.items()}
    if support.gap:
        found["gap"] = f"gap {with_unit(scene, 'gap', support.gap)}"
    if support.settlement:
        words = "moves" if support.direction == "axial" else "settles" if support.settlement > 0.0 else "raised"
        value = support.settlement if support.direction == "axial" else abs(support.settlement)
        found["settlement"] = f"{words} {with_unit(scene, 'gap', value)}"
    if support.law is None and 0.0 < support.stiffness < np.inf:
        found["spring"] = f"spring {fmt.number(support.stiffness, DIGITS)} {fmt.unit(scene, 'uniform')}".rstrip()
    if support.friction:
        found["friction"] = f"friction {fmt.number(support.friction, DIGITS)}"
    if not isinstance(support.rotation, str) and support.rotation:
        found["rotation"] = f"rotational spring {fmt.number(support.rotation, DIGITS)} {_turning(scene)}".rstrip()
    return {kind: with_minus_signs(words) for kind, words in found.items()}


def with_unit(scene: Scene, quantity: str, value: float) -> str:
    """Write a value with its unit, displacements in mm where lengths are in m."""
    return fmt.value(scene, quantity, value, DIGITS)


def _turning(scene: Scene) -> str:
    unit = fmt.unit(scene, "couple")
    return f"{unit}/rad" if unit else ""


def _across(scene: Scene, values: np.ndarray) -> np.ndarray:
    """Take values of supports across the beam, 0 of the others."""
    return np.where([support.direction == "normal" for support in scene.supports], values, 0.0) if len(values) else np.zeros(0)
