"""Tables of what governs: combinations, trains and the loading history differ only in where values come from."""

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ..results import formatting as fmt
from ..results.views.extreme import IN_WORDS
from .ground import clearance_heading
from .signs import positive_reactions
from .writer import Writer

if TYPE_CHECKING:
    from ..scene.structs import Scene

Source = Callable[[Any], list[str]]
"""Says where an extreme comes from, cell by cell."""


def rows_of_fields(scene: "Scene", extremes: Mapping[str, Mapping[str, Any]], source: Source) -> list[list[str]]:
    """Make the rows of the largest and smallest values along the beam.

    Parameters
    ----------
    scene : Scene
        The scene with its unit labels.
    extremes : mapping
        By field, then by ``max`` and ``min``; None where nothing is solved.
    source : callable
        Gives the last cells of a row.

    Returns
    -------
    list of list of str
        Name, kind, value, place and where it comes from.
    """
    rows = []
    for quantity, row in fmt.reported(extremes).items():
        there = {kind: one for kind, one in row.items() if one is not None}
        values = fmt.without_noise(one.value for one in there.values())
        for (kind, one), value in zip(there.items(), values, strict=True):
            name = fmt.shown_heading(scene, quantity) if kind == "max" else ""
            place = fmt.number(one.x, fmt.DIGITS)
            rows.append([name, IN_WORDS[kind], fmt.shown(scene, quantity, value), place, *source(one)])
    return rows


def write_governing_ground(
    say: Writer, scene: "Scene", found: Sequence[Mapping[str, Mapping[str, Any]]], when: str, headings: Sequence[str],
    source: Source,
) -> None:  # fmt: skip
    """Tell what the foundations carry at most and at least, and where the beam hangs free.

    Parameters
    ----------
    say : Writer
        Where to write.
    scene : Scene
        With foundations or without.
    found : sequence of mapping
        `Envelope.foundations`.
    when : str
        What stands behind "Foundations" in the heading.
    headings : sequence of str
        Of the cells that say where a value comes from.
    source : callable
        Gives these cells.
    """
    if not scene.foundation:
        return
    rows, spans = [], []
    for name, row in zip(fmt.numbered(scene.foundation), found, strict=True):
        for kind, one in row["resultant"].items():
            if one is not None:
                rows.append([name * (kind == "max"), IN_WORDS[kind], fmt.number(one.value, fmt.DIGITS), *source(one)])
        for kind, one in row["free_span"].items():
            if one is not None:
                ends = one.span.from_, one.span.to, one.span.to - one.span.from_
                numbers = [*(fmt.number(value, 4) for value in ends), fmt.shown(scene, "sag", one.span.sag)]
                spans.append([name * (kind == "longest"), kind, *numbers, *source(one)])
    say.heading(f"Foundations{when}")
    say.table(["", "", fmt.stacked(scene, "resultant"), *headings], rows, (0, 1, 3, 4))
    say.line(f"Resultants {positive_reactions(scene)} positive." + ("" if spans else " There is no free span."), "dim")
    if spans:
        say.heading(f"Free spans{when}")
        places = [fmt.stacked(scene, quantity, words) for quantity, words in (("x", "from"), ("x", "to"), ("length", "length"))]
        say.table(["", "", *places, clearance_heading(scene), *headings], spans, (0, 1, 6, 7))
        say.line("Clearance: largest distance between beam and ground.", "dim")
