"""The path over the load factor: reactions as straight lines from event to event."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from . import formatting as fmt

if TYPE_CHECKING:
    from .results import Result

MOST_LINES = 12
"""Supports whose reactions are drawn; of more those with the largest."""
STYLES = ("-", "--", "-.", ":")


def plot_path(result: Result, path: str | os.PathLike) -> None:
    """Draw the path into a file.

    Parameters
    ----------
    result : Result
        What `gapbeam.solve` returned, best with ``follow = "events"``.
    path : str or os.PathLike
        The suffix decides on the format: .png, .pdf or .svg.
    """
    with rc_context({"svg.fonttype": "none", "svg.hashsalt": "gapbeam"}):
        metadata = {"Date": None} if str(path).lower().endswith(".svg") else None
        path_figure(result).savefig(path, metadata=metadata)


def path_figure(result: Result) -> Figure:
    """Draw reactions and openings over the load factor, every event marked.

    Parameters
    ----------
    result : Result
        What `gapbeam.solve` returned.

    Returns
    -------
    matplotlib.figure.Figure
        Two panels; between events the lines are exact.
    """
    scene = result.scene
    states = list(result.steps)
    if result.segments:
        states.insert(0, result.state(0.0))
    factors = np.array([step.factor for step in states])
    picture = Figure(figsize=(7.4, 6.2), dpi=200, layout="constrained")
    picture.suptitle(scene.title or "Beam without a title", x=0.02, ha="left", fontsize=11, fontweight="bold")
    upper, lower = picture.subplots(2, 1, sharex=True)
    normal = [k for k, support in enumerate(scene.supports) if support.direction == "normal"]
    for axes, words, rows in (
        (upper, fmt.with_unit(scene, "reaction", "reaction, upward positive"), [s.reaction for s in states]),
        (lower, fmt.with_unit(scene, "opening", "opening"), [s.opening for s in states]),
    ):
        table = np.array(rows).reshape(len(states), -1)
        most = sorted(normal, key=lambda k: -np.abs(table[:, k]).max(initial=0.0))[:MOST_LINES]
        for k in sorted(k for k in most if np.abs(table[:, k]).max(initial=0.0) > 0.0):
            style, shade = STYLES[k % len(STYLES)], 0.25 * (k // len(STYLES) % 3)
            axes.plot(factors, table[:, k], style, color=str(shade), linewidth=1.3, label=f"support {k}")
            at = [event.factor for event in result.events if event.support == k]
            values = np.interp(at, factors, table[:, k])
            opens = [event.event == "opens" for event in result.events if event.support == k]
            for x, y, is_open in zip(at, values, opens, strict=True):
                axes.plot(x, y, "o", color="black", markerfacecolor="white" if is_open else "black", markersize=5)
        axes.set_ylabel(words)
        axes.grid(True, color="0.9", linewidth=0.6)
        axes.axhline(0.0, color="black", linewidth=0.8)
        for spine in ("top", "right"):
            axes.spines[spine].set_visible(False)
        if axes.get_legend_handles_labels()[0]:
            axes.legend(frameon=False, fontsize=8, ncols=2)
    lower.set_xlabel("load factor (circles: filled, the support closes; open, it opens)")
    return picture
