"""Distributions of the results of a batch as a picture."""

from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from ..results import formatting as fmt
from .save import literal

if TYPE_CHECKING:
    from ..batches.summary import Distribution, Summary

MOST = 12
"""Histograms in a picture."""
ACROSS = 3


def summary_figure(summary: "Summary") -> Figure:
    """Draw histograms of the results of a batch as a matplotlib figure.

    Parameters
    ----------
    summary : Summary
        From `Batch.summary`; of many results the first twelve are drawn, those with limits before the others, those that are
        the same in every case last.

    Returns
    -------
    matplotlib.figure.Figure
        A histogram for each result with its median, and limits with the share of cases above.
    """
    there = {name: one for name, one in summary.columns.items() if one.count}
    names = sorted(there, key=lambda name: (not there[name].above, there[name].least == there[name].largest))[:MOST]
    rows = max(-(-len(names) // ACROSS), 1)
    picture = Figure(figsize=(7.5, 0.5 + 1.9 * rows), dpi=200, layout="constrained")
    picture.suptitle(f"{summary.done:,} of {summary.cases:,} cases", fontsize=10, fontweight="bold", x=0.01, ha="left")
    for k, name in enumerate(names):
        axes = picture.add_subplot(rows, min(ACROSS, len(names)), k + 1)
        _draw(axes, name, there[name])
    lines = ["line: median"] if any(0.5 in one.quantiles for one in there.values()) else []
    lines += ["dashed: limit"] if any(one.above for one in there.values()) else []
    picture.supxlabel("; ".join(lines), fontsize=7, x=0.99, ha="right")
    return literal(picture)


def _draw(axes: object, name: str, one: "Distribution") -> None:
    axes.stairs(one.counts / one.count, one.edges, fill=True, color="0.75")
    axes.set_title(name, fontsize=8)
    axes.tick_params(labelsize=7)
    axes.locator_params(axis="x", nbins=4)
    axes.spines[["top", "right"]].set_visible(False)
    if 0.5 in one.quantiles:
        axes.axvline(one.quantiles[0.5], color="black", linewidth=0.8)
    for limit, count in one.above.items():
        axes.axvline(limit, color="black", linewidth=0.8, linestyle="--")
        axes.annotate(
            f"{count / one.count:.3g} above {fmt.number(limit, 4)}", (0.98, 0.98), xycoords="axes fraction", fontsize=7, ha="right",
            va="top", bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.8},
        )  # fmt: skip
