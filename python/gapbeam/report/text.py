"""A result as text: the report for people.

rich is imported only when a report is printed.
"""

import io
import textwrap
from collections import Counter
from typing import TYPE_CHECKING

import numpy as np

from ..base.characters import visible
from ..base.hints import few
from ..results import formatting as fmt
from ..results.answer import MOST_LIMITS, answer, has_cheap_envelope, headline, known_envelope
from ..results.envelopes.over_path import is_followed
from ..results.equilibrium import balance_in_words
from ..results.event_words import state_in_words
from ..results.plausibility import SIGN
from ..results.state.step import BOUNDED
from ..scene.names import label, labels
from ..scene.rotations import at_support, which_turn
from .axial_force import axial_forces_in_words, some_of, write_axial_force
from .combined import bound_in_words, write_combined
from .contact_history import contact_table, event_table, legend, merged, symbol
from .ground import write_axial_ground, write_contact, write_contact_history, write_foundations
from .over_path import write_over_path
from .signs import positive_along, positive_fields, positive_reactions
from .system import write_system
from .trains import write_trains
from .writer import LONGEST, Writer, chosen, left_out

if TYPE_CHECKING:
    from rich.console import Console

    from ..results.result import Result
    from ..results.state.step import Step
    from ..scene.structs import Support

VALUES, VALUE_COLUMN = ("Largest ", "Axial displacement "), 20
"""How lines with the largest values begin, and where the values do."""
MOST_EVENTS, MOST_TOLD = 40, 10
"""Events that the report lists, and supports that a sentence names."""


def print_report(result: "Result", console: "Console | None" = None, verbose: bool = False) -> None:
    """Print what a person wants to know of a result, the answer first.

    Parameters
    ----------
    result : Result
        What `gapbeam.solve` returned.
    console : rich.console.Console, optional
        Where to print; default standard output, without colours where that is no terminal.
    verbose : bool
        Whether equations, residuals and run time are told in detail.
    """
    from rich.console import Console

    say, scene = Writer(console or Console(highlight=False)), result.scene
    _answer(say, result)
    if result.combinations:
        write_combined(say, result, verbose)
        return
    write_trains(say, result)
    if not result.stands:
        _no_solution(say, result)
    if result.steps:
        at = "without trains" if scene.trains else f"at load factor {fmt.number(result.steps[-1].factor, fmt.DIGITS)}"
        if not result.stands:
            at += ", the last state that stands"
        _supports(say, result, at)
        _rotations(say, result, at)
        _hinges(say, result, at)
        write_axial_ground(say, result, at)
        write_foundations(say, result, at)
        write_contact(say, result, at)
        _extremes(say, result, at)
        write_axial_force(say, result, at)
        write_over_path(say, result, at)
        _history(say, result)
        _events(say, result)
        write_contact_history(say, result)
        _doubts(say, result)
    if verbose:
        write_system(say, result)
    if verbose and result.steps:
        _steps(say, result)
    elif result.steps:
        _solver(say, result)


def report_text(result: "Result", width: int = 80, verbose: bool = False) -> str:
    """Write the report to a string without colours.

    Parameters
    ----------
    result : Result
        What `gapbeam.solve` returned.
    width : int
        Characters a line.
    verbose : bool
        As for `print_report`.
    """
    from rich.console import Console

    class Unicode(io.StringIO):
        encoding = "utf-8"

    stream = Unicode()
    print_report(result, Console(file=stream, width=width, highlight=False, color_system=None), verbose)
    return stream.getvalue()


def _answer(say: "Writer", result: "Result") -> None:
    """The answer, before anything else."""
    say.line(headline(result), "bold")
    rough = [segment.stop for segment in result.segments if not getattr(segment, "exact", True)]
    rough += [limit.factor for limit in result.limits if not limit.exact and limit.factor not in rough]
    if rough:
        which = few([fmt.number(factor, 5) for factor in rough], MOST_LIMITS)
        say.line(f"Known on the polylines of the smooth laws only, to about one part in a hundred: load factor {which}.")
    for words in answer(result):
        say.line(_hanging(words, say.width), "red" if words.startswith(SIGN) or " EXCEEDED: " in words else "")
    for remark in result.remarks:
        say.line(fmt.sentence(visible(remark)), "red")


def _hanging(words: str, width: int) -> str:
    """Break the largest values so that what goes on stands under the values."""
    if not words.startswith(VALUES):
        return words
    look = {"subsequent_indent": VALUE_COLUMN * " ", "break_long_words": False, "break_on_hyphens": False}
    return "\n".join(textwrap.fill(line, width, **look) for line in words.split("\n"))


def _solver(say: "Writer", result: "Result") -> None:
    """How it was solved, in one line."""
    way = fmt.count(len(result.steps), "step") if result.path is None else fmt.count(len(result.events), "event")
    bound = result.steps[-1].certificate["error_bound"] if result.steps else None
    say.line()
    say.line(f"{bound_in_words(bound)}{way}, {fmt.count(result.solves, 'solve')}, {fmt.duration(result.seconds)}. More: --verbose.",
             "dim")  # fmt: skip


def _no_solution(say: "Writer", result: "Result") -> None:
    if result.without_trains is not None:
        say.heading("Without its trains the beam is unstable")
        say.line(fmt.sentence(result.without_trains))
        say.line("This state is not in the envelope, and changes nothing of it.")
    if result.limits and result.limits[-1].landing is not None:
        _landing(say, result, result.limits[-1].landing)
    if result.motion:
        scene = result.scene
        say.line()
        motion = result.motion
        if result.status == "buckles":
            say.line(axial_forces_in_words(result, None))
            say.line("The mode (sign and scale arbitrary):")
            motion = some_of(motion)
        else:
            say.line("The mechanism (straight between the points, scale arbitrary):")
        points = [fmt.column(values, fmt.DIGITS) for values in zip(*motion, strict=True)]
        say.table([fmt.with_unit(scene, "x"), "displacement, downward"], list(zip(*points, strict=True)))


def _landing(say: "Writer", result: "Result", landing: "Step") -> None:
    """Where the beam would be next."""
    which = [k for k, support in enumerate(result.scene.supports) if support.law is not None]
    scene = result.scene
    texts = [
        f"{fmt.support(scene, k)} on {state_in_words(landing.state[k])}, {at_support(scene, 'deflection', k)} "
        f"{fmt.value(scene, at_support(scene, 'deflection', k), landing.deflection[k])}"
        for k in which[:10]
    ]
    more = f", and {len(which) - 10} more" if len(which) > 10 else ""
    say.line(f"The next stable state along the path at this load factor (dynamics may lead elsewhere): {'; '.join(texts)}{more}.")


def _history(say: "Writer", result: "Result") -> None:
    supports = result.scene.supports
    if all(state == "bilateral" for state in result.steps[-1].state):
        return
    # Of steps with the same contact state the first and the last do
    runs = merged(result.steps.history())
    history = [(factor, states) for first, last, states in runs for factor in (first, last)]
    say.heading("Contact state over the load")
    headings, rows = contact_table(history, say.width, say.plain)
    say.table(headings, rows, left=(0, len(headings) - 1) if len(headings) < len(supports) + 1 else (0,))
    states = {state for _, states in history for state in states}
    numbering = "Supports are numbered from 0 as in the scene."
    say.line(f"{legend(list(states), say.plain)}    {numbering}", "dim")


def _supports(say: "Writer", result: "Result", at: str) -> None:
    scene, step = result.scene, result.steps[-1]
    if not scene.supports:
        return
    say.heading(f"Supports {at}")
    names = fmt.numbered(scene.supports)
    sides = [_side(support) for support in scene.supports]
    states = [f"{symbol(state, say.plain)} {state_in_words(state)}" for state in step.state]
    bounds = step.certificate
    reaction, deflection = (
        fmt.without_noise(getattr(step, name), bounds[f"error_bound_{name}"]) for name in ("reaction", "deflection")
    )
    turning = which_turn(scene.supports)
    quantities = {"reaction": reaction, "couple": step.couple, "deflection": deflection}
    if not step.couple[~turning].any():
        del quantities["couple"]
    if any(state != "bilateral" for state, turned in zip(step.state, turning, strict=True) if not turned):
        quantities["opening"] = step.opening
    if step.set[~turning].any():
        quantities["set"] = step.set
    if any(step.sliding):
        quantities |= {"friction": step.friction, "slip": step.slip}
    for digits in (5, 4, 3):
        columns = [
            ("", names),
            (fmt.stacked(scene, "x"), fmt.column(scene.positions(scene.supports), fmt.DIGITS)),
            ("side", sides),
            ("state", states),
            *(fmt.shown_column(scene, name, values, digits) for name, values in quantities.items()),
        ]
        if sum(1 + max(map(len, (*name.split("\n"), *texts))) for name, texts in columns) <= say.width:
            break  # numbers are shortened rather than broken
    left = (2, 3) if names == [str(k) for k in range(len(names))] else (0, 2, 3)
    rows = list(zip(*(texts for _, texts in columns), strict=True))
    lifted = [k for k, state in enumerate(step.state) if state == "open" and not turning[k]]
    which = [k for k in chosen(len(rows), lifted) if k is None or not turning[k]]
    say.table([name for name, _ in columns], [rows[k] if k is not None else ["..."] * len(columns) for k in which], left=left)
    say.supports_left_out(which, int((~turning).sum()), lifted, "are")
    for line in balance_in_words(result, step):
        say.line(line, "dim")
    counts = Counter(state_in_words(state) for state, turned in zip(step.state, turning, strict=True) if not turned)
    upright = scene.beam.direction == "down"
    couples = f", couples {'counter' * upright}clockwise" * ("couple" in quantities)
    signs = f"{positive_reactions(scene).capitalize()} positive{couples}"
    say.line(f"{signs}; {', '.join(f'{counts[state]:,} {state}' for state in sorted(counts))}.", "dim")
    along = {"right": positive_along(scene), "left": "upward" if upright else "to the left"}
    if slides := [f"{name} {along[way]}" for name, way in zip(labels(scene.supports), step.sliding, strict=True) if way in along]:
        signs = f"Friction and slip: positive {positive_along(scene)}."
        say.line(f"The beam slides over support {few(slides, MOST_TOLD)}. {signs}", "dim")
    _restraints_of_open_supports(say, result)


def _hinges(say: "Writer", result: "Result", at: str) -> None:
    """Write moments and relative rotations of hinges with a stiffness."""
    scene, hinges = result.scene, result.steps[-1].hinges
    if not hinges:
        return
    say.heading(f"Hinges with a stiffness {at}")
    rows = [
        [fmt.number(one.x, fmt.DIGITS), fmt.shown(scene, "moment", one.moment), fmt.shown(scene, "rotation", one.rotation)]
        for one in hinges[:LONGEST]
    ]
    say.table([fmt.with_unit(scene, "x"), fmt.shown_heading(scene, "moment"), fmt.shown_heading(scene, "rotation")], rows)
    say.line(f"Rotation left of the hinge less that right of it.{left_out(len(hinges))}", "dim")


def _rotations(say: "Writer", result: "Result", at: str) -> None:
    """Write what holds rotations by a law, with a slack or one way."""
    scene, step = result.scene, result.steps[-1]
    which = np.flatnonzero(which_turn(scene.supports)).tolist()
    if not which:
        return
    say.heading(f"Rotations {at}")
    x, opening, left = scene.positions(scene.supports), any(step.state[k] == "open" for k in which), step.set[which].any()
    rows = [
        [
            fmt.support(scene, k), fmt.number(x[k], fmt.DIGITS), scene.supports[k].side,
            f"{symbol(step.state[k], say.plain)} {state_in_words(step.state[k])}",
            fmt.shown(scene, "couple", step.reaction[k]), fmt.shown(scene, "rotation", step.deflection[k]),
            *([fmt.shown(scene, "rotation", step.opening[k])] if opening else []),
            *([fmt.shown(scene, "rotation", step.set[k])] if left else []),
        ]
        for k in which[:LONGEST]
    ]  # fmt: skip
    heads = [fmt.stacked(scene, "couple"), fmt.stacked(scene, "rotation")]
    to_go = [fmt.stacked(scene, "rotation", "to go")] if opening else []
    set_kept = [fmt.stacked(scene, "rotation", "set")] if left else []
    say.table(["", fmt.stacked(scene, "x"), "side", "state", *heads, *to_go, *set_kept], rows, left=(0, 2, 3))
    say.line("Couple on the beam: counterclockwise; rotation of the beam: clockwise. Of a hinge: sagging moment, and rotation left "
             f"of it less that right of it.{left_out(len(which))}", "dim")  # fmt: skip


def _side(support: "Support") -> str:
    if support.direction != "axial":
        return support.side
    return "axial" if support.side == "both" else f"axial {support.side}"


def _restraints_of_open_supports(say: "Writer", result: "Result") -> None:
    """Say which open supports still hold the rotation of the beam."""
    step, x = result.steps[-1], result.scene.positions(result.scene.supports)
    names = labels(result.scene.supports)
    held = [
        f"{names[k]} (x = {fmt.number(x[k], fmt.DIGITS)}, couple {fmt.value(result.scene, 'couple', step.couple[k])})"
        for k, (support, state) in enumerate(zip(result.scene.supports, step.state, strict=True))
        if state == "open" and support.rotation not in ("free", 0.0)
    ]
    if held:
        say.line(f"No contact, but the rotation is still held: support {few(held, MOST_TOLD)}.")


def _extremes(say: "Writer", result: "Result", at: str) -> None:
    scene = result.scene
    say.heading(f"Extremes {at}")
    rows = []
    bounds = result.steps[-1].certificate
    for quantity, extreme in fmt.reported(result._pairs_of_extremes()).items():
        (largest, x_largest), (smallest, x_smallest) = extreme["max"], extreme["min"]
        largest, smallest = fmt.without_noise([largest, smallest], bounds.get(f"error_bound_{quantity}"))
        texts = [fmt.shown(scene, quantity, largest), fmt.number(x_largest, fmt.DIGITS)]
        texts += [fmt.shown(scene, quantity, smallest), fmt.number(x_smallest, fmt.DIGITS)]
        rows.append([fmt.shown_heading(scene, quantity), *texts])
    x = fmt.with_unit(scene, "x", "at x")
    say.table(["", "largest", x, "smallest", x], rows, left=(0,))
    say.line(positive_fields(result.scene), "dim")


def _steps(say: "Writer", result: "Result") -> None:
    # Following events, the states between are solved only if asked for
    steps = result.steps if result.path is None else result.steps[-1:]
    kinds = list(steps[-1].residuals)
    say.heading("Residuals against run time")
    rows, worst, came_back = [], 0.0, False
    not_shown = range(LONGEST // 2, len(steps) - LONGEST // 2)
    for k, step in enumerate(steps):
        if k in not_shown:
            rows.append(())
            continue
        residuals = [step.residuals[kind] for kind in kinds]
        worst = max(worst, *residuals)
        came_back = came_back or step.came_back
        texts = [fmt.number(step.factor, 4), str(step.solves), fmt.duration(step.seconds)]
        rows.append([*texts, *(f"{residual:.1e}" for residual in residuals)])
    say.table(["load factor", "solves", "time", *kinds], rows)
    if len(steps) > 1:
        solves, seconds = fmt.count(result.solves, "solve"), fmt.duration(result.seconds)
        of_shown = " of these" if len(not_shown) else ""
        say.line(f"Together {solves}, {seconds}; largest residual{of_shown} {worst:.1e}.", "dim")
    if came_back:
        say.line("The rule single returned to an earlier contact state; from there the rule block was used.")
    bounds = ((kind, steps[-1].certificate[f"error_bound_{kind}"]) for kind in BOUNDED)
    listed = ", ".join(f"{kind} {bound:.1e}" for kind, bound in bounds if bound is not None)
    if listed:
        say.line(f"Error bounds at the last step, relative to the largest of each kind: {listed}.")


def _doubts(say: "Writer", result: "Result") -> None:
    """What is not decided at the last step."""
    step = result.steps[-1]
    if step.undecided:
        x = result.scene.positions(result.scene.supports)
        words = {False: "Reaction and opening are zero, so contact is undecided", True: "Exactly at a kink of its curve"}
        for with_law, what in words.items():
            which = [k for k in step.undecided if (result.scene.supports[k].law is not None) == with_law]
            if which:
                names = few([f"{label(result.scene.supports, k)} (x = {x[k]:g})" for k in which], MOST_TOLD)
                say.line(f"{what}: support {names}.")


def _events(say: "Writer", result: "Result") -> None:
    if result.scene.analysis.follow != "events":
        return
    say.heading("Events")
    if not result.events:
        reach = "at all load factors" if result.stands else "up to that load factor"
        say.line(f"The contact state is the same {reach}.")
        return
    shown = result.events[:MOST_EVENTS]
    cheap = is_followed(result) and has_cheap_envelope(result)
    say.table(*event_table(result, shown, known_envelope(result) if cheap and not result.scene.trains else None))
    if len(result.events) > len(shown):
        say.line(f"... and {len(result.events) - len(shown)} more; --json has all.", "dim")
