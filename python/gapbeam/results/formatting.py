"""Numbers, units and places as words: what the report, the pictures and the command line share."""

import math
import statistics
from collections.abc import Iterable, Sequence
from decimal import Decimal
from typing import Any

from ..base.characters import visible
from ..engine.quantities import QUANTITIES, REPORTED
from ..scene.names import label as name_or_number
from ..scene.names import labels
from ..scene.structs import Scene

DIGITS = 5
"""Of a number in a report."""
NOISE = 1e-12
"""Values below this share of the largest one are written as zero."""


def support(scene: Scene, k: int) -> str:
    """Name a support in a sentence.

    Parameters
    ----------
    scene : Scene
    k : int
        Number of the support.

    Returns
    -------
    str
        ``support R-104``, or ``support 3`` where it has no name; ``hinge 0`` or ``rotation of 2`` where it holds a rotation.
    """
    name, noun = name_or_number(scene.supports, k), NOUNS.get(scene.supports[k].direction, "support")
    return name if name.startswith(f"{noun} ") else f"{noun} {name}"


NOUNS = {"rotational": "rotation", "hinge": "hinge"}
"""What supports are called that hold a rotation."""


def numbered(items: Sequence) -> list[str]:
    """Give number and name of supports or foundations, for the first column of a table.

    Parameters
    ----------
    items : sequence
        A list of a scene.
    """
    return [str(k) if text == str(k) else f"{k} {text}" for k, text in enumerate(labels(items))]


def number(value: float, digits: int = 6) -> str:
    """Write one number, short.

    Parameters
    ----------
    value : float
        What to write.
    digits : int
        Significant digits; whole numbers up to ten million are written out all the same.

    Examples
    --------
    >>> number(0.07718909), number(-0.0), number(44500.0), number(2.5e-9), number(1234567.8)
    ('0.0771891', '0', '44500', '2.5e-09', '1234568')
    """
    if 10.0**digits <= abs(value) < 1e7:
        return f"{value:.0f}"
    return f"{value + 0.0:.{digits}g}" if value else "0"


def column(values: Iterable[float], digits: int = 6) -> list[str]:
    """Write numbers to stand under one another: the same decimals for all.

    Parameters
    ----------
    values : iterable of float
        The column.
    digits : int
        Significant digits of the largest value. Where most values are far smaller, all get some more decimals.

    Examples
    --------
    >>> column([3.8507982, -0.53015, 0.0])
    ['3.85080', '-0.53015', '0.00000']
    >>> column([6.0, 12.0, 18.0])
    ['6', '12', '18']
    """
    values = [float(value) for value in values]
    largest = max((abs(value) for value in values if math.isfinite(value)), default=0.0)
    if largest == 0.0:
        return [number(value) for value in values]
    if not 1e-5 <= largest < 1e8:
        return [f"{value:.{digits - 1}e}" if value else "0" for value in values]
    if all(value == round(value, 3) for value in values):  # typed by a person, such as lengths
        decimals = max(len(number(abs(value), 15).partition(".")[2]) for value in values)
    else:
        typical = statistics.median(abs(value) for value in values if abs(value) > 1e-9 * largest)
        decimals = max(digits - 1 - _exponent(largest), min(2 - _exponent(typical), digits + 1 - _exponent(largest)), 0)
    texts = [f"{value:.{decimals}f}" for value in values]
    return [text[1:] if text.startswith("-") and not text.strip("-0.") else text for text in texts]


def without_noise(values: Iterable[float], bound: float | None = None) -> list[float]:
    """Write zero for what is nothing but rounding beside the largest value.

    Parameters
    ----------
    values : iterable of float
        Of one kind.
    bound : float, optional
        Error bound as a share of the largest value.

    Examples
    --------
    >>> without_noise([2.9e-11, -312676.0]), without_noise([1.0, 0.2], 0.5)
    ([0.0, -312676.0], [1.0, 0.0])
    """
    values = [float(value) for value in values]
    least = max(NOISE, bound or 0.0) * max((abs(value) for value in values if math.isfinite(value)), default=0.0)
    return [0.0 if abs(value) <= least else value for value in values]


def _exponent(value: float) -> int:
    return math.floor(math.log10(value))


def duration(seconds: float) -> str:
    """Word a run time with a unit that suits it.

    Examples
    --------
    >>> duration(1.2e-5), duration(0.0034), duration(12.0)
    ('12.0 us', '3.40 ms', '12.0 s')
    """
    for factor, label in ((1e6, "us"), (1e3, "ms"), (1.0, "s")):
        value = seconds * factor
        if value < 999.5 or label == "s":
            decimals = 2 if value < 9.995 else 1 if value < 99.95 else 0
            return f"{value:.{decimals}f} {label}"
    raise AssertionError("unreachable")


def count(quantity: int, noun: str) -> str:
    """Word a number of things, with the plural where it belongs.

    Examples
    --------
    >>> count(1, "span"), count(3, "span"), count(12345, "load")
    ('1 span', '3 spans', '12,345 loads')
    """
    return f"{quantity:,} {noun}" + ("" if quantity == 1 else "s")


def sentence(reason: str | None) -> str:
    """Make the reason of an outcome a sentence to stand under a heading that names the outcome.

    Examples
    --------
    >>> sentence("no equilibrium at load factor 1: the beam tips")
    'At load factor 1: the beam tips.'
    """
    text = (reason or "no reason was given").removeprefix("no equilibrium ").rstrip(".")
    return f"{text[0].upper()}{text[1:]}."


def ranges(indices: Sequence[int]) -> str:
    """Write ascending integers with their runs drawn together.

    Examples
    --------
    >>> ranges([1, 2, 3, 7, 9, 10])
    '1-3, 7, 9-10'
    """
    runs: list[list[int]] = []
    for index in indices:
        if runs and index == runs[-1][1] + 1:
            runs[-1][1] = index
        else:
            runs.append([index, index])
    return ", ".join(str(first) if first == last else f"{first}-{last}" for first, last in runs)


def stretch(scene: Scene, item: object) -> tuple[float, float]:
    """Give the two ends of a section or a distributed load; what the scene leaves out is the end of the beam."""
    return item.from_, (float(scene.span_ends()[-1]) if item.to is None else item.to)


def title(scene: Scene, without: str = "Beam without a title") -> str:
    r"""Give the title of a scene for one line of a report or a picture.

    Parameters
    ----------
    scene : Scene
    without : str
        What to call it where it has none.

    Examples
    --------
    >>> from gapbeam import Beam, Scene
    >>> title(Scene(beam=Beam([4.0], EI=1.0), title="Bridge\n2")), title(Scene(beam=Beam([4.0], EI=1.0)))
    ('Bridge\\n2', 'Beam without a title')
    """
    return visible(scene.title) or without


UNITS = {one.name: one.unit for one in QUANTITIES} | {
    **dict.fromkeys(("x", "opening", "set", "gap", "sag", "length", "slip"), "{length}"),
    **dict.fromkeys(("reaction", "force", "resultant", "friction"), "{force}"),
    "couple": "{force} {length}", "EI": "{force} {length}^2",
    "uniform": "{force}/{length}", "k": "{force}/{length}^2", "stress": "{force}/{length}^2",
}
"""Of quantities along the beam, at supports and in scenes."""
AREAS = {("N", "m"): "Pa", ("kN", "m"): "kPa", ("MN", "m"): "MPa", ("N", "mm"): "MPa", ("kN", "mm"): "GPa"}
"""Names of a force over an area."""
HUGE = 1e300
"""Beyond it a value may leave the range of doubles in a smaller unit."""
SMALL = ("deflection", "axial_displacement", "opening", "sag", "gap", "set", "slip")
"""Displacements, which are small beside lengths."""


MOTIONS = {"no-equilibrium": "free motion", "buckles": "buckling mode"}
"""What the motion of a beam that does not stand is called, by its status."""


def reported(extremes: dict[str, Any]) -> dict[str, Any]:
    """Take what the report tells of extremes along the beam.

    Parameters
    ----------
    extremes : dict
        By name of the quantity.
    """
    return {name: row for name, row in extremes.items() if name in REPORTED}


def unit(scene: Scene, quantity: str) -> str:
    """Give the unit of a quantity by the labels of the scene; empty where it has none.

    Parameters
    ----------
    scene : Scene
        The scene with its unit labels.
    quantity : str
        ``"x"``, ``"deflection"``, ``"moment"``, ...; the names used in the results.

    Examples
    --------
    >>> from gapbeam import read_scene
    >>> scene = read_scene({"units": {"force": "kN", "length": "m"}, "beam": {"spans": [4.0], "EI": 1e4},
    ...                     "supports": [{"node": 0}, {"node": 1}]})
    >>> unit(scene, "moment"), unit(scene, "uniform"), unit(scene, "rotation"), unit(scene, "EI")
    ('kN m', 'kN/m', 'rad', 'kN m^2')
    """
    force, length = visible(scene.units.force), visible(scene.units.length)
    if quantity == "stress" and (force, length) in AREAS:
        return AREAS[force, length]
    pattern = UNITS[quantity]
    if ("{force}" in pattern and not force) or ("{length}" in pattern and not length):
        return ""
    return pattern.format(force=force, length=length)


def with_unit(scene: Scene, quantity: str, name: str | None = None) -> str:
    """Word a heading such as ``moment [kN m]``.

    Parameters
    ----------
    scene : Scene
        The scene with its unit labels.
    quantity : str
        As for `unit`.
    name : str, optional
        What to call it; default the quantity itself.
    """
    return heading(name or quantity.replace("_", " "), unit(scene, quantity))


def heading(words: str, label: str) -> str:
    """Put the label of a unit behind the words of a heading, if there is one."""
    return f"{words} [{label}]" if label else words


def stacked(scene: Scene, quantity: str, name: str | None = None) -> str:
    """Word a heading with the unit on a second line, which keeps columns narrow."""
    label = unit(scene, quantity)
    return (name or quantity) + (f"\n{label}" if label else "")


def shown_unit(scene: Scene, quantity: str) -> tuple[str, float]:
    """Give the unit that a report shows, and how many of it are one of the scene: displacements in mm where lengths are in m.

    Parameters
    ----------
    scene : Scene
        The scene with its unit labels.
    quantity : str
        As for `unit`.

    Returns
    -------
    unit : str
        Empty where the scene has no label.
    factor : float
        1000 for mm, else 1.
    """
    label = unit(scene, quantity)
    return ("mm", 1e3) if label == "m" and quantity in SMALL else (label, 1.0)


def shown(scene: Scene, quantity: str, value: float, digits: int = DIGITS) -> str:
    """Write a value as a report shows it, without its unit.

    Parameters
    ----------
    scene : Scene
        The scene with its unit labels.
    quantity : str
        As for `unit`.
    value : float
        In the unit of the scene.
    digits : int
        At most.
    """
    factor = shown_unit(scene, quantity)[1]
    if abs(value) > HUGE:  # in the smaller unit it may be no double
        return f"{Decimal(factor) * Decimal(float(value)):.{digits - 1}e}"
    return number(factor * value, digits)


def value(scene: Scene, quantity: str, number: float, digits: int = DIGITS) -> str:
    """Write a value as `shown` does, with its unit.

    Examples
    --------
    >>> from gapbeam import Beam, Scene, Units
    >>> scene = Scene(beam=Beam([4.0], EI=1.0), units=Units("kN", "m"))
    >>> value(scene, "opening", 0.0263), value(scene, "moment", 205.5)
    ('26.3 mm', '205.5 kN m')
    """
    return f"{shown(scene, quantity, number, digits)} {shown_unit(scene, quantity)[0]}".rstrip()


def shown_heading(scene: Scene, quantity: str, words: str | None = None) -> str:
    """Word a heading such as ``deflection [mm]`` for values by `shown`."""
    return heading(words or quantity.replace("_", " "), shown_unit(scene, quantity)[0])


def shown_column(scene: Scene, quantity: str, values: Iterable[float], digits: int = DIGITS) -> tuple[str, list[str]]:
    """Word a column of a report: its heading with the unit on a second line, and its numbers.

    Parameters
    ----------
    scene : Scene
        The scene with its unit labels.
    quantity : str
        As for `unit`.
    values : iterable of float
        In the unit of the scene.
    digits : int
        As for `column`.

    Returns
    -------
    heading : str
    texts : list of str
    """
    label, factor = shown_unit(scene, quantity)
    heading, values = quantity + (f"\n{label}" if label else ""), [float(value) for value in values]
    if any(abs(value) > HUGE for value in values):
        return heading, [shown(scene, quantity, value) for value in values]
    return heading, column([factor * value for value in values], digits)
