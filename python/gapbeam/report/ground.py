"""The ground in the report: what there is, the zones in which it acts, where the beam hangs free, or slides along its axis."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ..results import formatting as fmt
from ..results.contact import ground_in_words
from ..results.equilibrium import balance_in_words
from ..results.event_words import state_in_words
from ..results.state.ground import Contact, FreeSpan, joined, noun_of
from ..scene.ground_tables import is_table, least_and_most
from ..scene.names import label
from .contact_history import symbol
from .writer import LONGEST, Writer, left_out

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..results.result import Result
    from ..results.state.step import Step
    from ..scene.structs import Foundation, Scene

MOST_ROWS = 24
"""Zones and free spans that are listed, a dozen of each; of more some in the middle are left out, and a summary stands below."""
RIGID = float("inf")
MOST_IN_A_ROW = 3
"""Zones whose ends are written out for every load step."""


def write_foundations(say: Writer, result: "Result", at: str) -> None:
    """List the foundations with what they carry.

    Parameters
    ----------
    say : Writer
        Where to write.
    result : Result
        With a step.
    at : str
        The load factor in words.
    """
    scene, step = result.scene, result.steps[-1]
    if not scene.foundation:
        return
    say.heading(f"Foundations {at}")
    carried, touched = [0.0] * len(scene.foundation), [0.0] * len(scene.foundation)
    for zone in step.contact:
        carried[zone.foundation] += zone.resultant
    for zone in joined(step.contact):
        touched[zone.foundation] += _length(_ends(zone))
    from_, to = zip(*(fmt.stretch(scene, item) for item in scene.foundation), strict=True)
    columns = [
        ("", fmt.numbered(scene.foundation)),
        (fmt.stacked(scene, "x", "from"), fmt.column(from_, fmt.DIGITS)),
        (fmt.stacked(scene, "x", "to"), fmt.column(to, fmt.DIGITS)),
        ("side", [item.side for item in scene.foundation]),
        (fmt.stacked(scene, "k"), ["law" if item.law is not None else pair(item.k) for item in scene.foundation]),
        (f"gap\n{fmt.shown_unit(scene, 'gap')[0]}".rstrip(), [_gap(scene, item) for item in scene.foundation]),
        (fmt.stacked(scene, "length", "in contact"), fmt.column(touched, fmt.DIGITS)),
        (fmt.stacked(scene, "resultant"), fmt.column(carried, fmt.DIGITS)),
    ]
    say.columns(columns, left=(3,))
    if not scene.supports:
        for line in balance_in_words(result, step):
            say.line(line, "dim")


def write_contact(say: Writer, result: "Result", at: str) -> None:
    """List zones of contact and free spans along the beam.

    Parameters
    ----------
    say, result, at
        As for `write_foundations`.
    """
    scene, step = result.scene, result.steps[-1]
    if not ground_in_words(result):
        return
    say.heading(f"Contact with the ground {at}")
    stretches = sorted([*step.contact, *step.free_spans], key=lambda item: (item.foundation, item.from_, item.to))
    ends = [_ends(item) for item in stretches]
    places = fmt.column((x for both in ends for x in both), fmt.DIGITS)
    free = [isinstance(item, FreeSpan) for item in stretches]
    states = ["free" if isinstance(item, FreeSpan) else item.state for item in stretches]
    resultants = [None if isinstance(item, FreeSpan) else item.resultant for item in stretches]
    sags = [item.sag if isinstance(item, FreeSpan) else None for item in stretches]
    columns = [
        (fmt.stacked(scene, "x", "from"), places[::2]),
        (fmt.stacked(scene, "x", "to"), places[1::2]),
        (fmt.stacked(scene, "length"), fmt.column(map(_length, ends), fmt.DIGITS)),
        ("state", [f"{symbol('open' if state == 'free' else state, say.plain)} {state_in_words(state)}" for state in states]),
        (fmt.stacked(scene, "resultant"), _some(lambda values: fmt.column(values, fmt.DIGITS), resultants)),
        (clearance_heading(scene), _some(lambda values: fmt.shown_column(scene, "sag", values, 4)[1], sags)),
    ]
    if not any(free):
        del columns[-1]
    if len(scene.foundation) > 1:
        columns.insert(0, ("foundation", [label(scene.foundation, item.foundation) for item in stretches]))
    left = next(k for k, (name, _) in enumerate(columns) if name == "state")
    say.columns(columns, (left,), MOST_ROWS)
    if len(stretches) > MOST_ROWS:
        _summary(say, result, step)
    if any(free):
        say.line("Clearance: largest distance between beam and ground.", "dim")


def write_contact_history(say: Writer, result: "Result") -> None:
    """Tell where the beam lay on the ground at every load step.

    Parameters
    ----------
    say, result
        As for `write_foundations`.
    """
    steps = result.steps
    if len(steps) < 2 or not ground_in_words(result):
        return
    say.heading("Contact with the ground over the load")
    not_shown = range(LONGEST // 2, len(steps) - LONGEST // 2)
    shown = [k for k in range(len(steps)) if k not in not_shown]
    rows = [_step_in_a_row(result.scene.foundation, steps[k]) for k in shown]
    lengths, resultants, sags = list(zip(*rows, strict=True))[:3]
    columns = [fmt.column(values, fmt.DIGITS) for values in ([steps[k].factor for k in shown], lengths, resultants)]
    columns.append(fmt.shown_column(result.scene, "sag", sags, 4)[1])
    texts = iter(zip(*columns, [row[3] for row in rows], strict=True))
    headings = ["load factor", fmt.stacked(result.scene, "length", "in contact"), fmt.stacked(result.scene, "resultant"),
                clearance_heading(result.scene), fmt.stacked(result.scene, "x", "contact zones")]  # fmt: skip
    say.table(headings, [() if k in not_shown else next(texts) for k in range(len(steps))], left=(4,))


def write_axial_ground(say: Writer, result: "Result", at: str) -> None:
    """List the ground along the axis of the beam, and where the beam slides, or has slid last, over it.

    Parameters
    ----------
    say, result, at
        As for `write_foundations`.
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
    say.columns(columns)
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


def _step_in_a_row(foundations: Sequence["Foundation"], step: "Step") -> tuple[float, float, float, str]:
    """Length in contact, resultant, largest sag, and the zones in words."""
    zones = joined(step.contact)
    words = fmt.count(len(zones), noun_of(zones))
    if not zones:
        words = "none"
    elif len(zones) <= MOST_IN_A_ROW and len(foundations) == 1:
        words = ", ".join("-".join(dict.fromkeys((_number(zone.from_), _number(zone.to)))) for zone in zones)
    resultant, sag = sum(zone.resultant for zone in zones), max((span.sag for span in step.free_spans), default=0.0)
    return _together(zones), resultant, sag, words


def _summary(say: Writer, result: "Result", step: "Step") -> None:
    """Tell what is most in a long list of zones and free spans."""
    zones, spans = joined(step.contact), step.free_spans
    words = []
    if zones:
        longest = max(zones, key=lambda zone: _length(_ends(zone)))
        heaviest = max(zones, key=lambda zone: abs(zone.resultant))
        words.append(
            f"{fmt.count(len(zones), 'contact zone')}, together {_with_label(result, _together(zones))}: the longest "
            f"{_place(longest)}, the largest resultant {_with_label(result, heaviest.resultant, 'force')} {_place(heaviest)}."
        )
    if spans:
        longest, deepest = max(spans, key=lambda span: _length(_ends(span))), max(spans, key=lambda span: span.sag)
        words.append(
            f"{fmt.count(len(spans), 'free span')}, together {_with_label(result, _together(spans))}: the longest "
            f"{_place(longest)}, the largest clearance {fmt.value(result.scene, 'sag', deepest.sag)} {_place(deepest)}."
        )
    say.line(" ".join(words))


def _ends(item: Contact | FreeSpan) -> tuple[float, float]:
    return item.from_, item.to


def _length(ends: tuple[float, float]) -> float:
    return ends[1] - ends[0]


def _together(items: Sequence[Contact] | Sequence[FreeSpan]) -> float:
    return sum(_length(_ends(item)) for item in items)


def _place(item: Contact | FreeSpan) -> str:
    return f"from x = {_number(item.from_)} to {_number(item.to)}"


def _number(value: float) -> str:
    return fmt.number(value, 4)


def clearance_heading(scene: "Scene") -> str:
    """Heading of the largest distance between beam and ground."""
    return f"clearance\n{fmt.shown_unit(scene, 'sag')[0]}".rstrip()


def _with_label(result: "Result", value: float, quantity: str = "length") -> str:
    return f"{_number(value)} {fmt.unit(result.scene, quantity)}".rstrip()


def _some(write: "Callable[[list[float]], list[str]]", values: Sequence[float | None]) -> list[str]:
    """Write a column in which some places stay empty."""
    texts = iter(write([value for value in values if value is not None]))
    return ["" if value is None else next(texts) for value in values]


def pair(value: Any) -> str:
    """Write a number, the two at both ends, or the least and the greatest of a table."""
    if value is None:
        return ""
    value = least_and_most(value) if is_table(value) else value
    first, last = (value, value) if isinstance(value, int | float) else value
    return _number(first) if first == last else f"{_number(first)} to {_number(last)}"


def _gap(scene: "Scene", item: "Foundation") -> str:
    if item.profile is not None:
        return "profile"
    factor, gap = fmt.shown_unit(scene, "gap")[1], item.gap
    return pair(factor * gap if isinstance(gap, int | float) else tuple(factor * value for value in gap))
