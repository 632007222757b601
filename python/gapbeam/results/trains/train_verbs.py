"""The verbs of a result for one of its trains: largest and smallest values over its positions, and values at one of them."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING, Any

from ...scene.trains import RIGHT
from ..envelopes.tables import event_columns
from ..envelopes.verbs import PartVerbs
from ..views.columns import Columns
from .data import lost_positions, train_data

if TYPE_CHECKING:
    from ..envelopes.envelope import Curves
    from ..state.fields import Fields
    from ..views.extreme import Extremes
    from .envelope import TrainEnvelope
    from .trains import TrainState


class TrainVerbs(PartVerbs):
    """What is asked of a train in the words of results."""

    _kinds = ("supports", "fields", "events")
    # Whoever has written at(7.3) meant a position
    _NO_POSITION = (
        "at: {x} is a place along the beam; give the position of the train too, as at({x}, position = ...). "
        "What was at(7.3) is state(7.3)"
    )

    @property
    def status(self) -> str:
        """``solved`` if the beam stands at all positions; else as of a `Result`."""
        return self._lost[0]

    @property
    def reason(self) -> str | None:
        """At which positions the beam does not stand, and why; or else at which it is free to move."""
        return self._lost[1]

    @cached_property
    def _lost(self) -> tuple[str, str | None]:
        free = next((f"positions {gap.from_:.6g} to {gap.to:.6g}: {gap.reason}" for gap in self.unstable_positions), None)
        return lost_positions({self.name: self}) or ("solved", free)

    @cached_property
    def _ranges(self) -> TrainEnvelope:
        return self.envelope()

    @property
    def extremes(self) -> Extremes:
        """Exact extremes of every field over all positions, by field, then by ``max`` and ``min``."""
        return self._ranges.extremes

    def _seen_states(self) -> Iterator[tuple[str, ...]]:
        return self._ranges._seen_states()

    def _curves_at(self, x: Any) -> Curves:
        return self.envelope(x=x).fields

    def at(
        self, x: Any = None, *old: Any, position: float | None = None, direction: str = RIGHT, side: str = "right"
    ) -> Fields | TrainState:
        """Exact values anywhere along the beam while the train is at a position.

        Parameters
        ----------
        x : float or array_like
            Places along the beam.
        *old
            What stood behind a position when that was the first argument: it is refused.
        position : float
            Position of the first axle of the train.
        direction : {"right", "left"}
            Which way it goes; left needs ``both_directions``.
        side : {"right", "left"}
            Which value is taken where a field jumps.

        Returns
        -------
        Fields
            Arrays of the shape of `x`.

        Raises
        ------
        TypeError
            Without a position.
        ValueError
            A place outside the beam; no equilibrium at that position, or the train does not go that way.

        Examples
        --------
        >>> import gapbeam
        >>> crane = gapbeam.solve({
        ...     "beam": {"spans": [4.0], "EI": 1e4}, "supports": [{"node": 0}, {"node": 1}],
        ...     "trains": [{"name": "crane", "axles": [[0.0, 8.0]]}],
        ... }).trains["crane"]
        >>> float(crane.at(2.0, position=2.0).moment)
        8.0
        >>> crane.at(2.0)
        Traceback (most recent call last):
        ...
        TypeError: at: 2.0 is a place along the beam; give the position of the train too, as at(2.0, position = ...). \
What was at(7.3) is state(7.3)
        """
        if old or position is None:
            raise TypeError(self._NO_POSITION.format(x=x))
        if x is None:
            warnings.warn("at(position = ...) without a place is called state(...)", DeprecationWarning, stacklevel=2)
            return self.state(position, direction)
        return self.state(position, direction).fields(x, side)

    def table(self, kind: str = "supports") -> Columns:
        """Give a table of the largest and smallest values over all positions, or of the events.

        Parameters
        ----------
        kind : {"supports", "fields", "events"}
            Of the supports, along the beam, or what changes at which position.

        Returns
        -------
        Columns
            As of `Shown.table`.
        """
        if kind == "events":
            return Columns(event_columns(self.scene, [(None, self.name, event) for event in self.events], of_trains=True))
        return super().table(kind)

    def to_dict(self) -> dict[str, Any]:
        """Everything as plain data, in the form of the JSON output.

        Returns
        -------
        dict
            Only numbers, strings, lists and dicts.
        """
        return {**train_data(self, self._result.scene), "envelope": self._ranges.to_dict()}
