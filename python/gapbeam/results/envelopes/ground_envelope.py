"""Envelopes on foundations: largest and smallest resultants, the longest and the deepest free spans, and where they come from."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ..state.ground import FreeSpan
from ..views.extreme import Extreme

if TYPE_CHECKING:
    from ..result import Result
    from ..state.step import Step
    from .envelope import Envelope

SAME = 1e-12
"""Share of the largest of them by which values that tie differ at most: of resultants, lengths and sags."""


class GroundExtreme(Extreme):
    """The largest or smallest value of a foundation over all combinations; its attributes are those of `Extreme`.

    Its quantity is ``resultant`` (force on the beam, positive upward), ``length`` or ``sag``.

    Attributes
    ----------
    ties : tuple of Source
        All sources of this value, the first one included: those whose values differ by rounding.
    """

    def __init__(self, of: Envelope, quantity: str, value: float, foundation: int, span: FreeSpan | None, which: Sequence[int]):
        self.ties = tuple(of.sources[k] for k in which)
        super().__init__(quantity, value, None, self.ties[0], foundation=foundation, span=span)
        self._of, self._which = of, which[0]

    @property
    def result(self) -> Result:
        """The result of that combination."""
        return self._of._result_of(self._which)

    @property
    def state(self) -> Step:
        """The state in which it is the value."""
        return self._of._state_of(self._which)

    @cached_property
    def concurrent(self) -> dict[str, float]:
        """What else the foundation has in this state."""
        return on_foundation(self.state, self.foundation, self.quantity)

    def to_dict(self) -> dict[str, Any]:
        """As plain data: the free span, its source, and all that tie with it."""
        span = {} if self.span is None else self.span.to_dict()
        ties = {"ties": [one.to_dict() for one in self.ties[1:]]} if len(self.ties) > 1 else {}
        return {**span, **self.source.to_dict(), **ties}


def on_foundation(state: Step, foundation: int, without: str) -> dict[str, float]:
    """Give what a foundation has in a state.

    Parameters
    ----------
    state : Step
    foundation : int
        Its number.
    without : str
        The quantity that is left out.

    Returns
    -------
    dict of float
        Its resultant, and length and sag of its longest and its deepest free span.
    """
    zones = [zone.resultant for zone in state.contact if zone.foundation == foundation]
    spans = [span for span in state.free_spans if span.foundation == foundation]
    found = {"resultant": sum(zones), "length": max((span.to - span.from_ for span in spans), default=0.0),
             "sag": max((span.sag for span in spans), default=0.0)}  # fmt: skip
    return {name: value for name, value in found.items() if name != without}


def find_ground_extremes(of: Envelope, solved: Sequence[int]) -> list[dict[str, dict[str, GroundExtreme | None]]]:
    """Find the extremes of every foundation.

    Parameters
    ----------
    of : Envelope
        Whose they are.
    solved : sequence of int
        The combinations that are solved.

    Returns
    -------
    list of dict
        For every foundation ``resultant`` with ``max`` and ``min``, and ``free_span`` with ``longest`` and ``deepest``; these are
        None where the beam lies on the foundation in all of them.
    """
    count = len(of.scene.foundation)
    resultants, spans = np.zeros((len(solved), count)), [[] for _ in range(count)]
    for row, k in enumerate(solved):
        step = of._state_of(k)
        for zone in step.contact:
            resultants[row, zone.foundation] += zone.resultant
        for span in step.free_spans:
            spans[span.foundation].append((k, span))
    found = []
    for i in range(count):
        values = resultants[:, i]
        near, rows = SAME * np.abs(values).max(), {}
        for kind, value in (("max", values.max()), ("min", values.min())):
            which = [solved[k] for k in np.flatnonzero(np.abs(values - value) <= near).tolist()]
            first = float(values[solved.index(which[0])])
            rows[kind] = GroundExtreme(of, "resultant", first, i, None, which)
        free = {"longest": _largest(of, "length", i, spans[i]), "deepest": _largest(of, "sag", i, spans[i])}
        found.append({"resultant": rows, "free_span": free})
    return found


def _largest(of: Envelope, quantity: str, foundation: int, spans: Sequence[tuple[int, FreeSpan]]) -> GroundExtreme | None:
    """Find the free span that is the longest, or that sags most: the first of those that tie, and their combinations."""
    if not spans:
        return None
    values = np.array([span.to - span.from_ if quantity == "length" else span.sag for _, span in spans])
    near = SAME * (of.scene.span_ends()[-1] if quantity == "length" else values.max())
    which = np.flatnonzero(values >= values.max() - near).tolist()
    combinations = list(dict.fromkeys(spans[k][0] for k in which))
    return GroundExtreme(of, quantity, float(values[which[0]]), foundation, spans[which[0]][1], combinations)
