"""Extremes as columns of tables, which go to pandas or into a CSV file as they are."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ...scene.names import labels
from ..views.extreme import KINDS

if TYPE_CHECKING:
    from ...scene.structs import Scene
    from ..cases.combinations import Combinations
    from .envelope import Curves

SOURCES = ("combination", "train", "position", "direction")
"""What tells where an extreme comes from."""


class SupportRows(list):
    """Extremes at supports while trains pass: for every support a dict by quantity, then by ``max`` and ``min``.

    Parameters
    ----------
    scene : Scene
        The scene.
    rows : list of dict
        The extremes; None where nothing is solved.
    """

    def __init__(self, scene: Scene, rows: list[dict[str, dict[str, Any]]]) -> None:
        super().__init__(rows)
        self._scene = scene

    def values(self, quantity: str, kind: str) -> np.ndarray:
        """Give the largest or smallest value of every support.

        Parameters
        ----------
        quantity : str
            For example ``reaction``.
        kind : {"max", "min"}
            Which.

        Returns
        -------
        numpy.ndarray
            Not a number where nothing is solved.
        """
        ones = [row[quantity][kind] for row in self]
        return np.array([np.nan if one is None else one.value for one in ones])

    def columns(self) -> dict[str, Any]:
        """As columns of a table, for example for pandas.

        Returns
        -------
        dict
            ``support`` (name or number), ``x``, and of every quantity ``reaction_max`` and ``reaction_min``, each with
            ``reaction_max_combination`` (in a scene with combinations), ``..._train``, ``..._position`` and ``..._direction``.
        """
        found = support_places(self._scene)
        sources = SOURCES if self._scene.combinations else SOURCES[1:]
        for quantity in self[0] if self else ():
            for kind in KINDS:
                ones = [row[quantity][kind] for row in self]
                found[f"{quantity}_{kind}"] = self.values(quantity, kind)
                found |= {f"{quantity}_{kind}_{key}": [getattr(one, key, None) for one in ones] for key in sources}
        return found


def support_places(scene: Scene) -> dict[str, Any]:
    """Begin a table with a row for every support.

    Returns
    -------
    dict
        ``support`` (name or number) and ``x``.
    """
    return {"support": labels(scene.supports), "x": np.array(scene.positions(scene.supports))}


def curves_with_sources(curves: Curves, sources: Sequence[Any], keys: Sequence[str]) -> dict[str, Any]:
    """Give curves as columns, and then where their values come from.

    Parameters
    ----------
    curves : Curves
    sources : sequence
        What they number.
    keys : sequence of str
        Attributes of these that are wanted.

    Returns
    -------
    dict
        As `Curves.columns`; lists such as ``moment_max_combination``, in which None stands where there is no value.
    """
    found: dict[str, Any] = curves.columns()
    for kind, values, numbers in (("max", curves.largest, curves.largest_of), ("min", curves.smallest, curves.smallest_of)):
        for name in values:
            of = np.where(np.isnan(values[name]), -1, numbers[name]).tolist()
            found |= {f"{name}_{kind}_{key}": [None if k < 0 else getattr(sources[k], key) for k in of] for key in keys}
    return found


def event_columns(
    scene: Scene, rows: Sequence[tuple[str | None, str | None, Any]], of_trains: bool, with_combinations: bool = False
) -> dict[str, Any]:
    """Give events as columns of a table.

    Parameters
    ----------
    scene : Scene
        Knows the names of supports and foundations.
    rows : sequence of (str or None, str or None, event)
        Combination, train, and the event of a support or of the ground.
    of_trains : bool
        Whether events have a position of a train, else a load factor.
    with_combinations : bool
        Whether combinations are named.
    """
    names = {"support": labels(scene.supports), "foundation": labels(scene.foundation)}
    table: dict[str, Any] = {"combination": [name for name, _, _ in rows]} if with_combinations else {}
    if of_trains:
        table |= {"train": [train for _, train, _ in rows], "direction": [event.direction for *_, event in rows]}
    where = "position" if of_trains else "factor"
    table[where] = np.array([getattr(event, where) for *_, event in rows], dtype=float)
    for kind, known in names.items():
        if kind == "support" or scene.foundation:
            which = [getattr(event, kind, None) for *_, event in rows]
            table[kind] = [None if k is None else known[k] for k in which]
    return table | {"x": np.array([event.x for *_, event in rows], dtype=float), "event": [event.event for *_, event in rows]}


def extremes_while_trains_pass(combinations: Combinations) -> dict[str, np.ndarray]:
    """Find the extremes of every combination over all positions of trains, or of its one state where none acts.

    Parameters
    ----------
    combinations : Combinations
        All of them.

    Returns
    -------
    dict
        Columns of `Combinations.columns`, a row a combination.
    """
    rows: list[dict[str, float]] = []
    for one in combinations.values():
        row: dict[str, float] = {}
        if one.has_envelope:
            envelope = one.envelope()
            found = [(name, kind, extreme) for name, kinds in envelope.extremes.items() for kind, extreme in kinds.items()]
            for name, kind, extreme in found:
                if extreme is not None:
                    row |= {f"{name}_{kind}": extreme.value, f"{name}_{kind}_x": extreme.x}
            for name, support in zip(labels(one.scene.supports), envelope.supports, strict=True):
                row |= {f"reaction {name}_{kind}": e.value for kind, e in support["reaction"].items() if e is not None}
        rows.append(row)
    keys = dict.fromkeys(key for row in rows for key in row)
    return {key: np.array([row.get(key, np.nan) for row in rows]) for key in keys}
