"""The verbs of a result for its parts: envelopes, and one of its trains."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar

from ...scene.names import names_data
from ..views.columns import Columns, one_of
from ..views.labelled import Labelled, by_support
from ..views.shown import Shown
from .lifted import Lifted, lifted_supports

if TYPE_CHECKING:
    from ...scene.structs import Scene
    from ..result import Result
    from ..state.fields import Fields
    from ..trains.envelope import TrainEnvelope
    from ..views.extreme import Extreme
    from .envelope import Curves, Envelope


class PartVerbs(Shown):
    """What is asked of a part of a result in the words of results; values are the largest and the smallest ones."""

    _result: Result

    @property
    def scene(self) -> Scene:
        """What was solved."""
        return self._result.scene

    @property
    def status(self) -> str:
        """Outcome of the result."""
        return self._result.status

    @property
    def reason(self) -> str | None:
        """Why it is not solved, or else what is to be known of its outcome."""
        return self._result.reason

    @property
    def _ranges(self) -> Envelope | TrainEnvelope:
        """Where the largest and smallest values are."""
        return self

    def _by_support(self, quantity: str) -> Labelled:
        return by_support(self.scene, quantity, [row[quantity] for row in self._ranges.supports])

    @property
    def states(self) -> Labelled:
        """All states that a support is in, a tuple by number and name of the support: ``("closed", "open")``."""
        seen = list(self._seen_states())
        columns = zip(*seen, strict=True) if seen else [()] * len(self.scene.supports)  # where no state stands
        return by_support(self.scene, "state", [tuple(sorted(set(column))) for column in columns])

    def _seen_states(self) -> Any:
        """States of all supports, one state of the beam after the other."""
        raise NotImplementedError

    @property
    def lifted(self) -> list[Lifted]:
        """One-sided supports without contact, each where its opening is largest."""
        return lifted_supports(self._result, self._ranges)

    def at(self, x: Any, **where: Any) -> Curves | Fields:
        """Largest and smallest values anywhere along the beam; or the values in one state.

        Parameters
        ----------
        x : float or array_like
            Places along the beam.
        **where
            ``factor``, ``leg``, ``position``, ``combination`` and so on, as for `Result.at`.

        Returns
        -------
        Curves or Fields
            Curves with ``largest`` and ``smallest`` by field; fields of the state that is meant.

        Raises
        ------
        ValueError, KeyError
            As for `Result.at`.
        """
        return self._result.at(x, **where) if where else self._curves_at(x)

    def _curves_at(self, x: Any) -> Curves:
        return self._result.envelope(x=x).fields

    _kinds = ("supports", "fields")
    _tells_what_is_not_solved = False  # in plain data, as an empty list
    meant: ClassVar = {"historyextremes": "extremes, which are those of the envelope", "steps": "the steps of the result"}

    def table(self, kind: str = "supports") -> Columns:
        """Give a table of the largest and smallest values.

        Parameters
        ----------
        kind : {"supports", "fields"}
            Of the supports, or along the beam.

        Returns
        -------
        Columns
            As of `Shown.table`.
        """
        ranges = self._ranges
        return Columns((ranges.supports if one_of(kind, self._kinds) == "supports" else ranges).columns())

    def to_dict(self) -> dict[str, Any]:
        """Everything as plain data, in the form of the JSON output.

        Returns
        -------
        dict
            Only numbers, strings, lists and dicts.
        """
        scene = self.scene

        def pairs(row: Mapping[str, Extreme | None], with_x: bool = False) -> dict[str, list[Any]]:
            told = {kind: one for kind, one in row.items() if one is not None or self._tells_what_is_not_solved}
            return {kind: [] if one is None else [one.value, *[one.x] * with_x, one.to_dict()] for kind, one in told.items()}

        def rows(items: Sequence[Any], found: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
            named = zip(names_data(items), found, strict=True)
            return [{**name, **{what: pairs(row) for what, row in one.items()}} for name, one in named]

        return {
            "supports": rows(scene.supports, self.supports),
            **({"foundations": rows(scene.foundation, self.foundations)} if scene.foundation else {}),
            "extremes": {name: pairs(row, with_x=True) for name, row in self.extremes.items()},
            "fields": self.fields.to_dict(),
        }
