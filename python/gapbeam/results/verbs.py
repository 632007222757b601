"""Methods that all results share, their verbs: values of supports, tables, and values anywhere in any state."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, ClassVar

from ..scene.names import labels
from .envelopes.tables import event_columns
from .paths.loop import Loop, loop_of
from .state.fields import Fields
from .state.states import States
from .views.columns import Columns, one_of
from .views.extreme import Extreme, Extremes
from .views.labelled import Labelled, by_support
from .views.shown import Shown

if TYPE_CHECKING:
    from .result import Result
    from .trains.trains import TrainResult

TABLES = ("supports", "fields", "combinations", "events")
"""The tables of a result."""
OF_STEP = ("reaction", "deflection", "opening", "couple")
"""What a table tells of every support in one state."""


class Verbs(Shown, States):
    """What is asked of every result in the same words."""

    renamed: ClassVar = {
        "beam": "_beam", "rule": "_rule", "members": "_members", "places_along": "_places_along", "another": "_another",
        "refuse": "_refuse", "refuse_answer": "_refuse_answer", "refuse_limit": "_refuse_limit", "take_trains": "_take_trains",
    }  # fmt: skip

    @property
    def _kinds(self) -> tuple[str, ...]:
        """Tables that there are."""
        return ("supports", "fields", *["combinations"] * bool(self.combinations), "events")

    @property
    def states(self) -> Labelled:
        """States of the supports at the end of the load, ``closed``, ``open`` or ``bilateral``, of a law ``branch 1`` and so on.

        By number and name of the support; with combinations by combination, then by support. While trains pass states change:
        ask for those at a position, ``result.trains[name].state(position).state``.
        """
        return by_support(self.scene, "state", self._chosen(None).state)

    def _by_support(self, quantity: str) -> Labelled:
        if self.scene.trains:
            return by_support(self.scene, quantity, [row[quantity] for row in self.envelope().supports])
        return by_support(self.scene, quantity, getattr(self._chosen(None), quantity))

    def at(
        self, x: Any, step: int | None = None, side: str = "right", factor: float | None = None, *, leg: int | None = None,
        position: float | None = None, train: str | None = None, direction: str = "right", combination: str | int | None = None,
        case: int | None = None,
    ) -> Fields:  # fmt: skip
        """Exact values anywhere along the beam.

        Parameters
        ----------
        x : float or array_like
            Places along the beam.
        step : int, optional
            Number of the load step; default the last.
        side : {"right", "left"}
            Which value is taken where a field jumps.
        factor : float, optional
            Any load factor instead of a step; solved for when asked.
        leg : int, optional
            Which factor of the history the load goes to then, from 0; default the last time that it passes `factor`.
        position : float, optional
            Of a train, that of its first axle.
        train : str, optional
            Its name; needed where there are several.
        direction : {"right", "left"}
            Which way it goes.
        combination : str or int, optional
            Name or number of a combination.
        case : int, optional
            Of prepared cases only (`Cases.at`): a result has none.

        Returns
        -------
        Fields
            Arrays of the shape of `x`.

        Raises
        ------
        ValueError
            A place outside the beam, or something else than numbers; another side; both a step and a factor, or one that
            is no number; no equilibrium at that factor or position.
        IndexError
            There is no such step.
        KeyError
            There is no such combination or train.

        Examples
        --------
        >>> import gapbeam
        >>> result = gapbeam.solve({
        ...     "beam": {"spans": [4.0], "EI": 1e4}, "supports": [{"node": 0}, {"node": 1}],
        ...     "trains": [{"name": "crane", "axles": [[0.0, 8.0]]}],
        ... })
        >>> float(result.at(2.0, position=2.0).moment)
        8.0
        """
        if case is not None:
            raise ValueError("case: a result has no cases; prepared ones have, gapbeam.prepare(scene).solve([...]).at(x, case=0)")
        if combination is not None:
            one = self.combinations[combination]
            return one.at(x, step, side, factor, leg=leg, position=position, train=train, direction=direction)
        if position is not None:
            if (step, factor, leg) != (None, None, None):
                raise ValueError("position: trains pass at full load; leave step, factor and leg out")
            return self._train(train).state(position, direction).fields(x, side)
        if train is not None:
            raise ValueError("train: give its position too, as position = 0.0")
        if leg is None:
            return self.at_state(self._chosen(step, factor), x, side)
        if factor is None or step is not None:
            raise ValueError("leg: give the load factor on it too, as factor = 1.0, and no step")
        return self.at_state(self.state(factor, leg), x, side)

    def loop(self, support: int | str | None = None, *, friction: bool = False) -> Loop:
        """Give reaction and movement of a support along the loading history, with the energy that it takes up in every cycle.

        Parameters
        ----------
        support : int or str, optional
            Number or name; default the one that takes up most energy.
        friction : bool
            True: what friction does along the beam, instead of the reaction.

        Returns
        -------
        Loop

        Raises
        ------
        ValueError
            No state stands, there is no such support, or it has no friction.
        """
        return loop_of(self, support, friction)

    def _train(self, name: str | None) -> TrainResult:
        trains = self.trains
        if name is None and len(trains) != 1:
            raise ValueError(f"train: give one of the {len(trains)} trains" if trains else "position: the scene has no trains")
        return trains[next(iter(trains)) if name is None else name]

    @property
    def extremes(self) -> Extremes:
        """Exact largest and smallest values of every field at the end of the load, with trains over all positions.

        By field, then by ``max`` and ``min``: each an `Extreme` with ``value``, ``x``, ``source`` and ``concurrent``. Those of a
        step has ``result.steps[k].extremes``, those of the way of the load `history_extremes`.
        """
        at_end = super().extremes
        if not self.scene.trains:
            return at_end
        return Extremes(self._extremes_with_trains, at_end._call, at_end._instead)

    def _extremes_with_trains(self) -> dict[str, dict[str, Extreme]]:
        along = dict(self._chosen(None).extremes) if self.stands else {}  # forces along the beam do not meet trains
        return {**along, **self.envelope().extremes}

    def table(self, kind: str = "supports", points: int = 20) -> Columns:
        """Give a table.

        Parameters
        ----------
        kind : {"supports", "fields", "combinations", "events"}
            Supports and fields are those at the end of the load; with combinations or trains their largest and smallest values.
            Events are those of the load, with trains those of the trains.
        points : int
            Divisions of every span in the table of fields.

        Returns
        -------
        Columns
            Columns by name; ``to_pandas()`` makes a DataFrame of them.

        Raises
        ------
        ValueError
            There is no such table.

        Examples
        --------
        >>> import gapbeam
        >>> scene = gapbeam.Scene(beam=gapbeam.Beam([4.0, 2.0], EI=1e4), loads=[gapbeam.UniformLoad(q=6.0, to=4.0)])
        >>> scene.supports = [gapbeam.Support(node=i, side="below", name=name) for i, name in enumerate("ABC")]
        >>> gapbeam.solve(scene).table("supports").to_pandas()[["support", "reaction", "state"]]  # doctest: +SKIP
        >>> list(gapbeam.solve(scene).table("supports"))
        ['support', 'x', 'side', 'state', 'reaction', 'deflection', 'opening', 'couple']
        """
        return Columns(table_of(self, one_of(kind, TABLES), points))


def table_of(result: Result, kind: str, points: int = 20) -> dict[str, Any]:
    """Make a table of a result.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.
    kind : str
        One of `TABLES`.
    points : int
        Divisions of every span in the table of fields.

    Returns
    -------
    dict
        Columns by name.

    Raises
    ------
    ValueError
        The scene has no combinations.
    """
    if kind == "combinations":
        if not result.combinations:
            raise ValueError(f"kind: the scene has no combinations; there are {', '.join(one for one in TABLES if one != kind)}")
        return result.combinations.columns()
    if kind == "events":
        return _events(result)
    if result.combinations or result.scene.trains:
        return result.envelope().supports.columns() if kind == "supports" else result.envelope(points).columns()
    if kind == "fields":
        return result.fields(points=points).columns()
    step, scene = result.steps[-1], result.scene
    return {
        "support": labels(scene.supports), "x": scene.positions(scene.supports),
        "side": [support.side for support in scene.supports], "state": list(step.state),
        **{name: getattr(step, name) for name in OF_STEP},
    }  # fmt: skip


def _events(result: Result) -> dict[str, Any]:
    """Events of the load, or of trains; with combinations those of all."""
    of_trains = bool(result.scene.trains)

    def found(one: Result) -> Iterator[tuple[str | None, Any]]:
        if not of_trains:
            yield from ((None, event) for event in one.events)
        for name, train in one.trains.items() if of_trains else ():
            yield from ((name, event) for event in train.events)

    ones = result.combinations.items() if result.combinations else [(None, result)]
    rows = [(name, train, event) for name, one in ones if one.has_answer for train, event in found(one)]
    return event_columns(result.scene, rows, of_trains, bool(result.combinations))
