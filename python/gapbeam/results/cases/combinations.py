"""The results of the combinations of a scene, each made when it is looked at."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from ...base.errors import WITHOUT_ANSWER, EngineError, SceneError, Status, check_status
from ...base.hints import few
from ...base.records import Pickled
from ...engine.beam import Beam
from ...engine.combinations import Combined
from ...engine.quantities import QUANTITIES
from ...scene.combinations import Plan
from ...scene.movements import replace_settlements
from ...scene.names import labels, names_in_errors
from ...scene.reading import beam_of, beam_of_columns
from ...scene.wording import shown
from ..envelopes.full_load import at_full_load
from ..envelopes.tables import extremes_while_trains_pass
from ..paths.following import follow_load
from ..result import Result
from ..state.schemes import starting_scheme
from ..views.extreme import KINDS

KEPT = 64
"""Results of combinations that stay once they have been looked at."""


class Combinations(Pickled, Mapping[str, Result]):
    """Results by name of the combination, or by its number; each is made when it is looked at.

    Parameters
    ----------
    plan : Plan
        The combinations.
    beam : Beam
        Made of the plan's scene, nothing combined.
    rule : {"block", "single"}
        How contact states are found.
    start : numpy.ndarray of int
        Where every search starts.

    Attributes
    ----------
    failed : dict
        Those that are known to have no unique answer: the code of the error by number.
    """

    def __init__(self, plan: Plan, beam: Beam, rule: str, start: np.ndarray):
        self._plan, self._beam, self._rule, self._start = plan, beam, rule, start
        self.failed: dict[int, Status] = {}
        self._kept: OrderedDict[int, Result] = OrderedDict()
        self._solved: tuple[Combined, tuple[str, ...], dict[str, int]] | None = None

    def take(self, found: Combined, statuses: tuple[str, ...], fields: dict[str, int]) -> None:
        """Take what came of all, for `columns`.

        Parameters
        ----------
        found : Combined
            Their states at full load.
        statuses : tuple of str
            The status of each.
        fields : dict
            Names of the fields, and which of FIELDS they are.
        """
        self._solved = found, statuses, fields

    def columns(self) -> dict[str, Any]:
        """As columns of a table with a row for every combination, for example for pandas.

        Returns
        -------
        dict
            ``combination``, ``status``, ``limit_state`` where there are any; of every field its extremes and their places
            (``moment_max``, ``moment_max_x``), of every
            support its reaction (``reaction R-104``, or by number), at full load; with trains the extremes over all their
            positions, of reactions too (``reaction R-104_max``). Not-a-number where a combination is not solved.
        """
        found, statuses, fields = self._solved
        table: dict[str, Any] = {"combination": list(self._plan.names), "status": list(statuses)}
        if any(self._plan.limit_states):
            table["limit_state"] = list(self._plan.limit_states)
        scene = self._plan.scene
        if scene.trains:
            return table | extremes_while_trains_pass(self)
        for name, column in fields.items():
            for i, kind in enumerate(KINDS):
                table |= {
                    f"{name}_{kind}": found.extremes[:, column, i],
                    f"{name}_{kind}_x": found.places[:, column, i],
                }
        return table | {
            f"reaction {name}": found.at_supports[:, 0, k] for k, name in enumerate(labels(scene.supports))
        }

    def __len__(self) -> int:
        """Count the combinations."""
        return len(self._plan)

    def __iter__(self) -> Iterator[str]:
        """Go through the names."""
        return iter(self._plan.names)

    def __getitem__(self, key: str | int) -> Result:
        """Give the result of a combination.

        Raises
        ------
        KeyError
            There is no such combination.
        """
        k = self.number(key)
        if k not in self._kept:
            self._kept[k] = self._make(k)
            if len(self._kept) > KEPT:
                self._kept.popitem(last=False)
        return self._kept[k]

    def number(self, key: str | int) -> int:
        """Find a combination.

        Parameters
        ----------
        key : str or int
            Its name, or its number.

        Returns
        -------
        int
            Its number, from 0.

        Raises
        ------
        KeyError
            There is no such combination.
        """
        names = self._plan.names
        if isinstance(key, str) and key in names:
            return names.index(key)
        if isinstance(key, int) and -len(names) <= key < len(names):
            return key % len(names)
        raise KeyError(f"there is no combination {shown(key)}; there are {self._few()}")

    def __repr__(self) -> str:
        """Show the names, of many only the first."""
        return f"Combinations({self._few()})"

    def _few(self) -> str:
        return few(map(shown, self._plan.names))

    def beam_of(self, k: int) -> Beam:
        """Make the beam of a combination, with its loads on it and its supports moved.

        Parameters
        ----------
        k : int
            Its number.

        Returns
        -------
        Beam

        Raises
        ------
        SceneError
            Supports that moved leave no room for each other.
        EngineError
            Numbers are beyond the range of doubles.
        """
        plan, base = self._plan, self._beam.columns
        load, support = base.load.copy(order="F"), base.support.copy(order="F")
        load[2:, :-1] *= plan.factors[k]
        support[3, :-1] += plan.settlements[k]
        scene = replace_settlements(plan.scene, plan.settlements[k]) if plan.settlements[k].any() else plan.scene
        return self._like_others(beam_of_columns(scene, replace(base, load=load, support=support), self._beam.curves))

    def _like_others(self, beam: Beam) -> Beam:
        """Give it the fields that all combinations have, so that what is 0 in one of them counts in the envelope."""
        beam.also = frozenset(QUANTITIES[k].of for k in self._beam.fields.values())
        return beam

    def _make(self, k: int) -> Result:
        plan = self._plan
        with _named(plan, k):
            scene, beam = plan.scene_of(k), self.beam_of(k)
            try:
                with names_in_errors(plan.scene):
                    if plan.scheme_of[k] is not None:
                        return self._in_scheme(k, plan.scheme_of[k])
                    result = Result(scene, beam, self._rule)
                    follow_load(result, self._start)
                    if k in self.failed:
                        at_full_load(result)  # what is wrong may be with its fields
                        check_status(self.failed[k], b"it has no unique answer")
                    return result
            except EngineError as error:
                if error.status not in WITHOUT_ANSWER:
                    raise
                result = Result(scene, beam, self._rule)
                result._refuse_answer(error)
                return result

    def _in_scheme(self, k: int, other: int) -> Result:
        """Solve with the contact state of another combination."""
        plan, before = self._plan, self[other]
        if not before.stands:
            result = Result(plan.scene_of(k), self.beam_of(k), self._rule)
            result.status, result.has_answer = "no-equilibrium" if before.status == "solved" else before.status, False
            result.reason = (
                f"the combination {shown(plan.names[other])}, whose contact state it takes, is not solved"
            )
            result.steps.outcome = result.status, result.reason
            return result
        acts = [state != "open" for state in before.steps[-1].state]
        scene = plan.scene_of(k, acts)
        beam = self._like_others(beam_of(scene))
        result = Result(scene, beam, self._rule)
        follow_load(result, starting_scheme(beam))
        if result.reason:
            result.reason += f" (in the contact state of {shown(plan.names[other])})"
        return result


class _named:
    """Put the name of a combination before what is raised inside."""

    def __init__(self, plan: Plan, k: int) -> None:
        self._name = f"combinations {shown(plan.names[k])}"

    def __enter__(self) -> None: ...

    def __exit__(self, kind: Any, error: BaseException | None, trace: Any) -> None:
        if isinstance(error, SceneError):
            raise SceneError(
                self._name, f"{error.place}: {error.problem}" if error.place else error.problem
            ) from None
        if isinstance(error, EngineError):
            raise EngineError(f"{self._name}: {error}", error.status) from None
