"""Distributions of the results of a batch as a picture."""

import textwrap
from typing import TYPE_CHECKING

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter

from ..base.characters import with_minus_signs
from ..results import formatting as fmt
from ..results.views.extreme import IN_WORDS
from .panels import FIXED
from .save import literal

if TYPE_CHECKING:
    from ..batches.summary import Distribution, Summary

MOST = 12
"""Histograms in a picture."""
ACROSS = 3
SHADE, LIMIT = "#9CC3E0", "#B84A00"
"""Colours of the histograms, and of limits."""
CUT = 5.0
"""How many times higher than the next a bar is that is cut."""
CHARACTERS = 110
"""Of a line of a note."""


def summary_figure(summary: "Summary") -> Figure:
    """Draw histograms of the results of a batch as a matplotlib figure.

    Parameters
    ----------
    summary : Summary
        From `Batch.summary`; of many results the first twelve are drawn, those with limits before the others. Those that are
        the same in every case are named below.

    Returns
    -------
    matplotlib.figure.Figure
        A histogram for each result: percentages of the cases over its value with unit. Lines are medians; limits have the
        percentage of cases above, openings that of the cases in which the support has no contact.
    """
    there = {name: one for name, one in summary.columns.items() if one.count}
    varying = sorted((name for name in there if there[name].least < there[name].largest), key=lambda name: not there[name].above)
    names, alike = varying[:MOST], [name for name in there if there[name].least == there[name].largest]
    lines = _notes(summary, {name: there[name] for name in names}, alike, len(varying))
    rows = max(-(-len(names) // ACROSS), 1)
    picture = Figure(figsize=(7.5, 0.5 + 2.0 * rows + 0.16 * len(lines)), dpi=200, layout="constrained")
    head = f"{summary.done:,} of {summary.cases:,} cases done"
    more = [f"{count:,} {status}" for status, count in summary.statuses.items()]
    picture.suptitle(f"{head}: {', '.join(more)}" if more else head, fontsize=10, fontweight="bold", x=0.01, ha="left")
    for k, name in enumerate(names):
        axes = picture.add_subplot(rows, min(ACROSS, len(names)), k + 1)
        _draw(axes, summary, name, there[name])
        if k % ACROSS == 0:
            axes.set_ylabel("share of cases", fontsize=7.5)
    picture.supxlabel("\n".join(lines), fontsize=7, x=0.01, ha="left")
    return literal(picture)


def _draw(axes: Axes, summary: "Summary", name: str, one: "Distribution") -> None:
    unit, factor = summary.units.get(name, ("", 1.0))
    axes.stairs(one.counts / one.count, one.edges, fill=True, color=SHADE)
    axes.set_xlabel(fmt.heading(_words(name), unit), fontsize=7.5)
    axes.tick_params(labelsize=7)
    axes.locator_params(axis="both", nbins=4)
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: with_minus_signs(fmt.number(factor * value, 4))))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: _percent(value)))
    axes.spines[["top", "right"]].set_visible(False)
    words = []
    shares = sorted((one.counts / one.count).tolist())
    if len(shares) > 1 and shares[-1] > CUT * shares[-2] > 0.0:  # nearly all in one bar: what else there is would not be seen
        axes.set_ylim(0.0, 1.4 * shares[-2])
        words.append(f"one bar is cut, {_percent(shares[-1])} high")
    if 0.5 in one.quantiles:
        axes.axvline(one.quantiles[0.5], color="black", linewidth=0.9)
    if name.startswith("opening.") and one.positive:
        words.append(f"no contact: {_percent(one.positive / one.count)}")
    for limit, count in one.above.items():
        if name.startswith("opening.") and limit == 0.0:
            continue  # said already
        axes.axvline(limit, color=LIMIT, linewidth=1.0, linestyle="--")
        words.append(with_minus_signs(f"above {fmt.number(factor * limit, 4)}: {_percent(count / one.count)}"))
    axes.set_title("\n".join(words), fontsize=7.5, loc="right", color=LIMIT)


def _notes(summary: "Summary", drawn: "dict[str, Distribution]", alike: list[str], varying: int) -> list[str]:
    """Say what lines mean, and what is not drawn."""
    words = ["line: median"] if any(0.5 in one.quantiles for one in drawn.values()) else []
    words += ["dashed: limit"] if any(one.above for one in drawn.values()) else []
    words += [f"{len(drawn)} of {varying} results drawn"] if varying > len(drawn) else []
    if alike:
        values = []
        for name in alike[:MOST]:
            unit, factor = summary.units.get(name, ("", 1.0))
            value = with_minus_signs(fmt.number(factor * summary.columns[name].least, 4))
            values.append(f"{_words(name)} = {value} {unit}".rstrip().replace(" ", FIXED))
        words.append(f"the same in every case: {', '.join(values)}{', ...' * (len(alike) > MOST)}")
    return [line.replace(FIXED, " ") for line in textwrap.wrap("; ".join(words), CHARACTERS)]


def _words(name: str) -> str:
    """Name a result: ``opening.2`` is the opening of support 2.

    Examples
    --------
    >>> _words("opening.west"), _words("moment.max"), _words("reaction.2")
    ('opening of west', 'largest moment', 'reaction of support 2')
    """
    quantity, _, support = name.partition(".")
    if support in IN_WORDS:
        return f"{IN_WORDS[support]} {quantity.replace('_', ' ')}"
    if support:
        return f"{quantity} of {f'support {support}' if support.isdigit() else support}"
    return name.replace("_", " ")


def _percent(share: float) -> str:
    return f"{fmt.number(100.0 * share, 3)} %"
