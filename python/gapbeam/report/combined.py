"""The report on combinations: it begins with what governs."""

from typing import TYPE_CHECKING

import numpy as np

from ..base.characters import visible
from ..base.hints import few
from ..results import formatting as fmt
from ..results.cases.limit_states import envelopes_to_tell
from ..results.envelopes.envelope import AT_SUPPORTS
from ..results.envelopes.hints import beyond
from ..results.envelopes.lifted import NONE
from ..results.envelopes.over_path import is_followed
from ..results.equilibrium import sum_of_loads, sum_of_reactions, without_rounding
from ..results.views.extreme import IN_WORDS
from ..scene.names import labels
from ..scene.rotations import at_support, which_turn
from .axial_force import write_modes_of_combinations
from .governing import rows_of_fields, write_governing_ground
from .over_path import write_over_path
from .signs import names_with_units, positive_fields, positive_reactions
from .system import write_system
from .trains import write_trains
from .writer import Writer, chosen

if TYPE_CHECKING:
    from ..results.cases.combined import CombinedResult
    from ..results.envelopes.envelope import Envelope, Extreme
    from ..results.envelopes.ground_envelope import GroundExtreme
    from ..results.envelopes.hints import Hint
    from ..scene.structs import Scene

MOST_FOLLOWED = 100
"""Combinations that are followed from event to event for the report, to find factors between that govern."""
MOST_TIES = 2
"""Further combinations with the same value that are named."""
MOST_ROWS = 24
"""Combinations whose reactions are listed."""
MOST_SUPPORTS = 16
"""Supports whose reactions are listed."""


def write_combined(say: Writer, result: "CombinedResult", verbose: bool = False) -> None:
    """Print what a person wants to know of combinations.

    Parameters
    ----------
    say : Writer
        Where to write.
    result : CombinedResult
        What `gapbeam.solve` returned.
    verbose : bool
        Whether equations are told.
    """
    scene = result.scene
    _fallen(say, result)
    if result.has_envelope and scene.trains:
        write_trains(say, result)
    elif "solved" in result.statuses:
        _reactions(say, result)
        when = "at full load" if result.scene.analysis.history[-1] == 1.0 else "at the end of the history"
        for name, envelope in envelopes_to_tell(result):
            of = f"{'all combinations' if name is None else visible(name)} {when}"
            _fields(say, result, envelope, of)
            _supports(say, result, envelope, of)
            write_governing_ground(say, scene, envelope.foundations, f", {of}", ["combination"], _source)
        _factors_between(say, result)
        write_modes_of_combinations(say, result)
    write_over_path(say, result)
    _list(say, result)
    if verbose:
        write_system(say, result)
    say.line()
    words = f"{fmt.count(result.solves, 'solve')}, {fmt.duration(result.seconds)}"
    say.line(f"{bound_in_words(_bound(result))}{words}. More: --verbose.", "dim")


def _bound(result: "CombinedResult") -> float | None:
    """The largest error bound of the combinations, where they are few."""
    if result.scene.trains or len(result.names) > MOST_FOLLOWED:
        return None
    ends = [one.steps[-1].certificate["error_bound"] for one in result.combinations.values() if one.status == "solved"]
    return max(ends) if ends and None not in ends else None


def bound_in_words(bound: float | None) -> str:
    """Word an error bound.

    Parameters
    ----------
    bound : float or None
        As a share of the largest values.

    Returns
    -------
    str
        To stand before other words; empty where there is none, or nothing bends.
    """
    if not bound:  # it is of bending, and nothing may be there
        return ""
    return f"Error bound {bound:.0e} (relative); " if bound < 1.0 else "All values are within their error bounds; "


def _fallen(say: Writer, result: "CombinedResult") -> None:
    """Say which combinations are not solved, and why."""
    # Of trains the positions are listed that are not solved, and no more is left out
    fallen = [k for k, status in enumerate(result.statuses) if status != "solved" and not result.combinations[k].has_envelope]
    if not fallen:
        return
    say.heading("Not solved")
    for k in fallen[:10]:
        say.line(f"{visible(result.names[k])}: {result.combinations[k].reason}.", "red")
    if len(fallen) > 10:
        say.line(f"... and {len(fallen) - 10} more; --json has all.", "dim")
    if len(fallen) < len(result.names):
        say.line("They are left out of what follows.")


def _source(extreme: "Extreme | GroundExtreme") -> list[str]:
    """Name the combinations that an extreme comes from."""
    names = [visible(source.combination or "") for source in extreme.ties]
    return [few(names, 1 + MOST_TIES)]


def _reactions(say: Writer, result: "CombinedResult") -> None:
    """Tabulate reactions by combination, with what has lifted off, and their sums beside those of the loads."""
    scene = result.scene
    if not scene.supports:
        return
    envelope, up = result.envelope(), "^" if say.plain else "\u2191"
    reaction, opening = (envelope.at_supports[:, AT_SUPPORTS.index(name)] for name in ("reaction", "opening"))
    turning = which_turn(scene.supports)
    deflection = np.nanmax(np.abs(envelope.at_supports[:, AT_SUPPORTS.index("deflection")][:, ~turning]), initial=0.0)
    lifted = (opening > NONE * deflection) & ~turning
    supports = [i for i in _columns_of(np.where(turning, 0.0, reaction), lifted) if not turning[i]]
    shown = _rows_of(reaction, opening, supports)
    rows = []
    for k in shown:
        name, one = visible(envelope.sources[k].combination or ""), envelope._result_of(k)
        if one.status != "solved":
            rows.append([name, *["-"] * (len(supports) + 2)])
            continue
        forces = fmt.without_noise(reaction[k].tolist())
        texts = [
            f"0 {up}{fmt.number(fmt.shown_unit(scene, 'opening')[1] * opening[k, i], 3)}" if lifted[k, i]
            else fmt.number(forces[i], fmt.DIGITS)
            for i in supports
        ]  # fmt: skip
        step = one.steps[-1]
        sums = without_rounding(sum_of_reactions(one.scene, step).force, sum_of_loads(one.scene, step.factor).force)
        rows.append([name, *texts, *(fmt.number(value, fmt.DIGITS) for value in sums)])
    for words, best in (("largest", np.nanmax), ("smallest", np.nanmin)):
        ends = fmt.without_noise(best(reaction, axis=0).tolist())
        rows.append([words, *(fmt.number(ends[i], fmt.DIGITS) for i in supports), "", ""])
    names = labels(scene.supports)
    say.heading(fmt.with_unit(scene, "reaction", "Reactions by combination"))
    say.table_by_name(["", *(names[i] for i in supports), "sum", "loads"], rows)
    length, _ = fmt.shown_unit(scene, "opening")
    mark = f"; {up} no contact, with its opening{f' in {length}' if length else ''}" if lifted.any() else ""
    words = [f"{positive_reactions(scene).capitalize()} positive{mark}."]
    if hidden := len(envelope.sources) - len(shown):
        words.append(f"{hidden:,} combinations are left out here, which neither govern nor lift a support more; --json has all.")
    if hidden := int((~turning).sum()) - len(supports):
        lost = [i for i in np.flatnonzero(lifted.any(axis=0)).tolist() if i not in supports]
        words.append(f"{hidden:,} supports are left out here{f'; no contact at {fmt.ranges(lost)}' if lost else ''}.")
    if scene.foundation:
        words.append("The sum has the ground in it.")
    say.line(" ".join(words), "dim")
    if turning.any():
        _couples(say, result, reaction, [k for k in shown if envelope._result_of(k).status == "solved"])


def _couples(say: Writer, result: "CombinedResult", couple: np.ndarray, shown: list[int]) -> None:
    """Tabulate couples of what holds rotations by combination."""
    scene, envelope = result.scene, result.envelope()
    which = np.flatnonzero(which_turn(scene.supports))[:MOST_SUPPORTS].tolist()
    say.heading(fmt.with_unit(scene, "couple", "Couples by combination"))
    rows = [
        [visible(envelope.sources[k].combination or ""), *(fmt.number(value, fmt.DIGITS) for value in couple[k, which].tolist())]
        for k in shown
    ]
    say.table_by_name(["", *(fmt.support(scene, i) for i in which)], rows)
    say.line("Counterclockwise positive; of a hinge its sagging moment.", "dim")


def _rows_of(reaction: np.ndarray, opening: np.ndarray, supports: list[int]) -> list[int]:
    """Choose combinations: those that govern at the supports that are shown, then those in which supports have no contact."""
    count = len(reaction)
    if count <= MOST_ROWS:
        return list(range(count))
    solved = np.isfinite(reaction).all(axis=1)
    gone, most, least = (np.where(solved[:, None], values, -np.inf) for values in (opening, reaction, -reaction))
    ranked = sorted(supports, key=lambda i: -gone[:, i].max())
    governs = [int(values[:, i].argmax()) for i in ranked for values in (gone, most, least)]
    return sorted(list(dict.fromkeys([*governs, *np.argsort(-gone.max(axis=1), kind="stable").tolist()]))[:MOST_ROWS])


def _columns_of(reaction: np.ndarray, lifted: np.ndarray) -> list[int]:
    """Choose supports: those without contact somewhere, then those with the largest reactions."""
    most = np.nanmax(np.abs(reaction), axis=0)
    ranked = sorted(range(len(most)), key=lambda i: (not lifted[:, i].any(), -most[i]))
    return sorted(ranked[:MOST_SUPPORTS])


def _fields(say: Writer, result: "CombinedResult", envelope: "Envelope", of: str) -> None:
    say.heading(f"What governs, {of}")
    rows = rows_of_fields(result.scene, envelope.extremes, _source)
    say.table(["", "", "value", fmt.with_unit(result.scene, "x", "at x"), "combination"], rows, left=(0, 1, 4))
    say.line(f"{positive_fields(result.scene)} Combinations with equal values stand beside each other.", "dim")


def _supports(say: Writer, result: "CombinedResult", envelope: "Envelope", of: str) -> None:
    scene = result.scene
    if not scene.supports:
        return
    say.heading(f"Supports, {of}")
    one_sided = any(support.side != "both" for support in scene.supports)
    rows, names = [], names_with_units(scene)
    lifted = np.flatnonzero(envelope.supports.values("opening", "max") > 0.0).tolist()
    which = chosen(len(names), lifted, MOST_ROWS)
    for k in which:
        if k is None:
            rows.append(["..."] * (6 if one_sided else 4))
            continue
        row = envelope.supports[k]
        for kind, words in IN_WORDS.items():
            one = row["reaction"][kind]
            texts = [names[k] if kind == "max" else "", words, fmt.number(one.value, fmt.DIGITS), *_source(one)]
            if one_sided:
                opening = row["opening"][kind]
                far = fmt.shown(scene, at_support(scene, "opening", k), opening.value)
                texts += [far, *(_source(opening) if opening.value else [""])]
            rows.append(texts)
    headings = ["", "", fmt.stacked(scene, "reaction"), "combination"]
    if one_sided:
        headings += [fmt.shown_column(scene, "opening", [])[0], "combination"]
    say.table(headings, rows, left=(0, 1, 3, 5), longest=len(rows))
    say.supports_left_out(which, len(names), lifted, "stay")
    say.line(f"Reactions {positive_reactions(scene)} positive.", "dim")


def _factors_between(say: Writer, result: "CombinedResult") -> None:
    """Say where a load factor between 0 and 1 governs."""
    if not result.is_linear_between_events and is_followed(result):
        return  # the largest values over the loading history follow
    say.heading("Load factors between 0 and 1")
    if not result.is_linear_between_events:
        say.line("Not looked for: on foundations, with smooth laws and where the state depends on the loading history, values are "
                 "not linear between events.")  # fmt: skip
        return
    if len(result.names) > MOST_FOLLOWED:
        say.line(f"Not looked for: more than {MOST_FOLLOWED} combinations; result.hints() in Python follows all of them.")
        return
    envelope, scene = result.envelope(), result.scene
    largest = {(name, None, kind): one.value for name, row in envelope.extremes.items() for kind, one in row.items()}
    for k, row in enumerate(envelope.supports):
        largest |= {(name, k, kind): one.value for name in ("reaction", "opening") for kind, one in row[name].items()}
    found = [
        hint for hint in beyond(result.hints(), largest)
        if fmt.shown(scene, hint.quantity, hint.value)
        != fmt.shown(scene, hint.quantity, largest[hint.quantity, hint.support, hint.kind])
    ]  # fmt: skip
    if not found:
        say.line("No extreme is exceeded at a smaller load factor. Dead loads act in full there; all others are scaled by it.")
        return
    names = labels(scene.supports)
    rows = [
        [
            _of(hint, names, scene), IN_WORDS[hint.kind], fmt.shown(scene, _unit_of(hint, scene), hint.value),
            fmt.number(hint.x, fmt.DIGITS), visible(hint.combination or ""), fmt.number(hint.factor, fmt.DIGITS),
            fmt.shown(scene, _unit_of(hint, scene), largest[hint.quantity, hint.support, hint.kind]),
        ]
        for hint in found
    ]  # fmt: skip
    headings = ["", "", "value", fmt.with_unit(scene, "x", "at x"), "combination", "load factor", "at full load"]
    say.table(headings, rows, left=(0, 1, 4))
    say.line("With supports that open and close the full load need not be the worst: these values are greater where the loads "
             "(all but the dead ones) have that part of their factors.")  # fmt: skip


def _unit_of(hint: "Hint", scene: "Scene") -> str:
    """Give the quantity by whose unit a hint is told."""
    return hint.quantity if hint.support is None else at_support(scene, hint.quantity, hint.support)


def _of(hint: "Hint", names: list[str], scene: "Scene") -> str:
    """Name the quantity of a hint, with its unit."""
    return fmt.shown_heading(scene, _unit_of(hint, scene)) + ("" if hint.support is None else f" of {names[hint.support]}")


def _list(say: Writer, result: "CombinedResult") -> None:
    say.heading("Combinations")
    scene = result.scene
    given = [
        [
            visible(one.name),
            ", ".join(f"{fmt.number(factor, 4)} {visible(case)}" for case, factor in one.factors.items()) or "no load",
            "; ".join(_about(one)),
        ]
        for one in scene.combinations
    ]
    say.table(["name", "factors of cases", ""], given, left=(0, 1, 2))


def _about(combination: object) -> list[str]:
    """Say what else a combination asks for."""
    words = [visible(combination.limit_state)] if combination.limit_state else []
    words += [f"{visible(str(key))} settles {fmt.number(value, 4)}" for key, value in combination.settlements.items()]
    if combination.scheme_of is not None:
        words.append(f"contact state of {visible(combination.scheme_of)}")
    words += [
        f"{visible(case)} on parts of spans" if rule == "parts" else f"all patterns of {visible(case)} ({rule})"
        for case, rule in combination.expand.items()
    ]
    return words
