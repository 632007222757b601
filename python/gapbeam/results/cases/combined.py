"""The combinations of a scene: each has a result of its own, and all of them together an envelope."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base.errors import WITHOUT_ANSWER, SceneError
from ...base.memory import refuse_beyond
from ...base.records import read_only
from ...engine.beam import Beam
from ...scene.combinations import Plan, plan_combinations
from ...scene.names import label
from ...scene.reading import beam_of
from ...scene.structs import Scene
from ...scene.wording import key_of, shown
from ..data import combined_data
from ..envelopes.envelope import AT_SUPPORTS, Envelope
from ..envelopes.full_load import on_both_sides
from ..envelopes.hints import Hint, find_hints
from ..paths.compression import larger
from ..result import Result
from ..state.arguments import whole
from ..state.fields import Fields
from ..trains.envelope import TrainEnvelope, places_given
from ..trains.members import Member, Standing
from ..views.extreme import Extremes, Source
from ..views.labelled import Labelled, by_support
from .combinations import Combinations
from .combined_solver import AtOnce, OneByOne
from .limit_states import members_of, without_others
from .parts import place_parts

if TYPE_CHECKING:
    from ..state.step import Step
    from ..trains.trains import Trains

WORST = ("solved", "limit-load", "buckles", "no-equilibrium", *(status.word for status in WITHOUT_ANSWER))
"""Outcomes, the worst last: that is the outcome of all combinations together."""


class NoSteps(Sequence):
    """No steps, and what to look at instead.

    Parameters
    ----------
    words : str
        What is said to who asks for one.
    """

    def __init__(self, words: str):
        self._words = words

    def __len__(self) -> int:
        """Count them."""
        return 0

    def __getitem__(self, index: int | slice) -> list:
        """Give none."""
        if isinstance(index, slice):
            return []
        raise IndexError(self._words)


class CombinedResult(Result):
    """All combinations of a scene.

    What a `Result` says of one load is asked of one of its `combinations`, or of the `envelope` of all.

    Attributes
    ----------
    status : str
        ``solved`` if all combinations are; else that of the worst.
    reason : str or None
        Which are not solved, and why the first of them is not.
    names : tuple of str
        The combinations, patterns written out.
    statuses : tuple of str
        The status of each.
    remarks : list of str
        What else is to be known: load cases that act in none of them, schemes that are not decided.
    """

    def __init__(self, scene: Scene, plan: Plan, beam: Beam, rule: str, start: np.ndarray, remarks: Sequence[str] = ()):
        super().__init__(scene, beam, rule)
        if plan.settlements[:, ~beam.bends].any():
            beam.also = frozenset({"axial"})
        self.names = plan.names
        self._plan = plan
        numbers = 4 * beam.scene_supports + beam.supports + len(scene.loads) + 40
        what = f"the results of {len(plan):,} combinations"
        refuse_beyond("combinations", what, 16.0 * len(plan) * numbers, "take fewer at a time")
        self._combinations = Combinations(plan, beam, rule, start)
        self._words = (
            f"the scene has {len(plan)} combinations, each with a result of its own; take for example "
            f"result.combinations[{plan.names[0]!r}], or result.envelope()"
        )
        self.steps = NoSteps(self._words)
        self._near: list[str] = []
        begin = perf_counter()
        self._check_products()
        kind = AtOnce if scene.analysis.is_one_step and beam.beyond_one_search is None and not scene.trains else OneByOne
        self._solver = kind(self._combinations)
        self._found, reasons = self._solver.solve(self._note_compression)
        self.statuses = tuple(reasons)
        self._combinations.take(self._found, self.statuses, self._beam.fields)
        if not scene.analysis.first_order:
            for k in self._solver.compressed(self._found):
                self._note_compression(k)
        self._seconds = perf_counter() - begin
        self.remarks = [f"no combination has loads of the case {shown(case)}" for case in plan.idle]
        self.remarks += self._near
        self.remarks += remarks
        self.remarks += [words for k in range(len(plan)) if (words := self._doubt(k))]
        fallen = [k for k, status in enumerate(self.statuses) if status != "solved"]
        if fallen:
            self.status = max(self.statuses, key=WORST.index)
            first = next(k for k in fallen if self.statuses[k] == self.status)
            more = f"; {len(fallen) - 1} more of {len(self.names)} not solved" if len(fallen) > 1 else ""
            self.reason = f"combination {shown(self.names[first])}: {self.combinations[first].reason}{more}"

    def __eq__(self, other: object) -> bool:
        """Whether scene, outcomes and all values are equal."""
        if not isinstance(other, CombinedResult):
            return NotImplemented
        return self is other or (
            self.scene == other.scene and self._rule == other._rule and self.statuses == other.statuses
            and np.array_equal(self._found.at_supports, other._found.at_supports, equal_nan=True)
            and np.array_equal(self._found.extremes, other._found.extremes, equal_nan=True)
        )  # fmt: skip

    __hash__ = None

    @property
    def combinations(self) -> Combinations:
        """Results of the combinations by name or number; each is made when it is looked at."""
        return self._combinations

    @property
    def factors(self) -> np.ndarray:
        """Factor of every load, combinations by loads (those that patterns cut are several)."""
        return self._plan.factors

    @property
    def solves(self) -> int:
        """Linear solves until all schemes were found."""
        return int(self._found.solves.sum(dtype=np.int64))

    @property
    def seconds(self) -> float:
        """Time of these."""
        return self._seconds

    def _chosen(self, step: int | None = None, factor: float | None = None) -> Step:
        raise ValueError(self._words)

    def history(self) -> list[tuple[float, tuple[str, ...]]]:
        """Refuse: every combination has a history of its own."""
        raise ValueError(self._words)

    def state(self, factor: float, leg: int | None = None) -> Step:
        """Refuse: every combination has states of its own."""
        return self._chosen(None, factor)

    def _by_support(self, quantity: str) -> Labelled:
        if self.scene.trains:
            return super()._by_support(quantity)
        rows = self._found.at_supports[:, AT_SUPPORTS.index(quantity)]
        keys = by_support(self.scene, quantity, rows[0]).keys()
        return Labelled(quantity, "combination", self.names, [Labelled(quantity, "support", keys, row) for row in rows])

    @property
    def extremes(self) -> Extremes:
        """Exact extremes of every field over all combinations, with trains over all positions, as of `envelope`."""
        return Extremes(self.envelope, self._chosen, 'result.extremes["moment"]["max"].value')

    @property
    def states(self) -> Labelled:
        """States of the supports at the end of the load, by combination, then by support; None where one is not solved."""
        none = [None] * len(self.scene.supports)
        steps = ((one.steps[-1] if len(one.steps) else None) for one in self.combinations.values())
        rows = [by_support(self.scene, "state", none if step is None else step.state) for step in steps]
        return Labelled("state", "combination", self.names, rows)

    def _doubt(self, k: int) -> str:
        """Say whether the scheme that a combination takes is not decided."""
        other = self._plan.scheme_of[k]
        if other is None or not self.combinations[other].stands:
            return ""
        before = self.combinations[other].steps[-1]
        if not before.undecided:
            return ""
        which = ", ".join(
            f"{label(self.scene.supports, i)} (taken as {before.state[i]})" for i in before.undecided
        )
        return (
            f"the combination {shown(self.names[k])} takes the contact state of {shown(self.names[other])}, "
            f"in which reaction or opening "
            f"of support {which} is zero, so that it may be closed or open"
        )

    def _check_products(self) -> None:
        """Refuse loads that leave the range of doubles with their factors."""
        with np.errstate(over="ignore"):
            largest = np.abs(self._beam.columns.load[2:, :-1]).max(axis=0, initial=0.0)
            wrong = np.argwhere(~np.isfinite(self._plan.factors * largest))
        if len(wrong):
            k, load = wrong[0].tolist()
            name, case = self.scene.combinations[self._plan.origin[k]].name, self._plan.scene.loads[load].case
            place = f"combinations {shown(name)}.factors.{key_of(case)}"
            raise SceneError(place, f"loads[{load}] times this factor is beyond the range of numbers; give a smaller one")

    def _note_compression(self, k: int) -> None:
        """Keep the largest compression of all combinations, and what is to be said of it."""
        one = self.combinations[k]
        if one.compression is not None and larger(self.compression, one.compression) is one.compression:
            self.compression = one.compression
            self._near = [f"combination {shown(self.names[k])}: {remark}" for remark in one.remarks]

    @property
    def trains(self) -> Trains:
        """Refuse: trains pass in every combination."""
        return self._chosen(None)

    @property
    def limit_states(self) -> tuple[str, ...]:
        """Names of the limit states that combinations belong to, in the order of the scene."""
        return tuple(dict.fromkeys(name for name in self._plan.limit_states if name))

    def envelope(self, points: int = 20, *, x: Any = None, limit_state: str | None = None) -> Envelope | TrainEnvelope:
        """Largest and smallest values of all combinations that are solved, each at its full load, as `Result.envelope`.

        Parameters
        ----------
        points, x
            As there.
        limit_state : str, optional
            Only the combinations of this limit state.

        Raises
        ------
        ValueError
            There is no such limit state, or none of its combinations is solved.
        """
        places, chosen = places_given(self._beam, x), members_of(limit_state, self._plan.limit_states)
        points = whole("points", points, least=1)
        if self.scene.trains:
            return TrainEnvelope(self, list(self._members(chosen)), places, points)
        sources = [Source(name) for name in self.names]
        at_supports, extremes = (without_others(values, chosen) for values in (self._found.at_supports, self._found.extremes))
        envelope = Envelope(
            self, self._beam.fields, sources, at_supports, extremes, self._found.places,
            self.combinations.__getitem__, partial(self._curves, points, places, chosen), places is not None,
        )  # fmt: skip
        envelope.limit_state = limit_state
        return envelope

    def _has_envelope_of(self, limit_state: str) -> bool:
        """Whether there is anything in the envelope of a limit state."""
        return any(
            self.statuses[k] == "solved" or self.combinations[k].has_envelope
            for k in np.flatnonzero(members_of(limit_state, self._plan.limit_states)).tolist()
        )

    def _members(self, chosen: np.ndarray | None = None) -> Iterator[Member]:
        """Go through the trains in every combination, and the combinations in which none acts.

        Parameters
        ----------
        chosen : numpy.ndarray of bool, optional
            Which combinations; default all.
        """
        for k, name in enumerate(self.names):
            if chosen is not None and not chosen[k]:
                continue
            result = self.combinations[k]
            if not result.has_answer:
                continue
            if result.scene.trains:
                yield from result.trains._members(name)
            elif result.status == "solved":
                yield Standing(result, name)

    def hints(self) -> list[Hint]:
        """Where a load factor between governs, as `Result.hints`, of every combination that has a scheme of its own.

        Returns
        -------
        list of Hint
        """
        own = [k for k, other in enumerate(self._plan.scheme_of) if other is None]
        return [hint for k in own for hint in find_hints(self.combinations[k], self.names[k])]

    def to_data(
        self, points: int = 20, steps: Callable[[Iterator], Any] = list, fields: Callable[[Fields], dict] = Fields.to_dict
    ) -> dict[str, Any]:
        """Everything as plain data, as `Result.to_data`, with the combinations in place of the steps.

        Parameters
        ----------
        points, steps, fields
            As there.

        Returns
        -------
        dict
        """
        return combined_data(self, points, steps)

    @property
    def has_envelope(self) -> bool:
        """Whether there is anything in the envelope."""
        return "solved" in self.statuses or any(one.has_envelope for one in self.combinations.values())

    def _curves(
        self, points: int, x: np.ndarray | None, chosen: np.ndarray
    ) -> tuple[np.ndarray, Iterator[tuple[slice, np.ndarray]]]:
        """Places along the beam, and the fields there of some combinations at a time."""
        x, parts = self._curves_of_all(points, x)
        return x, ((part, without_others(values, chosen[part])) for part, values in parts)

    def _curves_of_all(
        self, points: int, x: np.ndarray | None
    ) -> tuple[np.ndarray, Iterator[tuple[slice, np.ndarray]]]:
        if x is not None:
            piece, distance = map(
                np.concatenate, zip(self._beam.find(x, False), self._beam.find(x, True), strict=True)
            )
            x, left = on_both_sides(x)
            return x, self._solver.fields_at(self._found, self.statuses, piece, distance, x, left)
        piece, distance = self._places_along(points)
        x, at_end = self._beam.places.x_of(piece, distance)
        return x, self._solver.fields_at(self._found, self.statuses, piece + np.int32(1), distance, x, at_end)


def solve_combined(scene: Scene, beam: Beam, rule: str, start: np.ndarray) -> CombinedResult:
    """Solve the combinations of a scene.

    Parameters
    ----------
    scene : Scene
        Checked.
    beam : Beam
        Made of it.
    rule : {"block", "single"}
        How contact states are found.
    start : numpy.ndarray of int
        Where every search starts: no result depends on those before it.

    Raises
    ------
    SceneError
        A combination makes no sense, or moves supports so that they leave no room for each other.
    """
    placed, remarks = place_parts(scene, rule)
    plan = plan_combinations(scene, placed)
    if plan.scene is not scene:
        beam = beam_of(plan.scene)
    return CombinedResult(scene, plan, beam, rule, read_only(start), remarks)
