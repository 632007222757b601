"""Results: the states of a scene, and all that is asked of them: trains, envelopes, hints, plain data."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from typing import Any

from ..base.hints import Named
from ..engine.beam import Beam
from ..scene.structs import Scene
from .answer import known_envelope
from .data import result_data
from .envelopes.envelope import Envelope
from .envelopes.full_load import envelope_of_one
from .envelopes.hints import Hint, find_hints
from .envelopes.lifted import Lifted, lifted_supports
from .envelopes.over_path import PathEnvelope, is_followed
from .state.arguments import whole
from .state.fields import Fields
from .trains.data import lost_positions
from .trains.envelope import TrainEnvelope, places_given
from .trains.members import Member
from .trains.trains import Trains
from .utilisation import Utilisation, find_utilisations
from .verbs import Verbs
from .views.extreme import Extremes


class Result(Verbs):
    """All load steps of a scene.

    It can be pickled, for other processes, and continues there with the same digits; all its arrays are read-only. Two
    results are equal if scene, outcome and events are, and all steps to the last digit; how long it took does not count.

    Attributes
    ----------
    scene : Scene
        What was solved.
    status : str
        ``solved``, ``no-equilibrium``, ``buckles``, or ``limit-load``: supports soften or yield, and the load cannot grow on. Of a
        combination also ``indeterminate``, ``not-converged``, ``not-finite``: it has no unique answer.
    reason : str or None
        Why there is no equilibrium or no unique answer, or which limit there is; of a beam that is solved, but free to move
        without work of the loads, that it is.
    motion : list of (float, float) or None
        The free motion then: x and displacement (positive downward, largest 1), straight lines between.
    steps : sequence of Step
        The load steps up to there; following events, the states at every event and at the end. What is kept of a step is
        its scheme; its values are solved for when it is looked at.
    path : Path, BranchPath, GroundPath or None
        Following events, the schemes along the load; with supports whose state depends on it always.
    without_trains : str or None
        Why the beam is unstable while no train is on it, which is not in the envelope and does not count for `status`; None
        where it can, and in scenes without trains.
    has_answer : bool
        Whether there is a unique answer, be it that the beam is unstable.
    compression : Compression or None
        The largest axial compression beside the Euler load in all steps, and while trains pass: what its effect on bending is,
        is left out. None where nothing is compressed.
    remarks : list of str
        What else is to be known: compression that comes near the Euler load.
    """

    def _another(self, scene: Scene, beam: Beam, rule: str) -> Result:
        """Begin the result of another scene, as that of a train at one position.

        Parameters
        ----------
        scene : Scene
        beam : Beam
            Its beam.
        rule : str
            How the contact state is found.

        Returns
        -------
        Result
            Without states.
        """
        return Result(scene, beam, rule)

    @cached_property
    def trains(self) -> Trains:
        """Trains by name; followed over the beam when something is asked of them."""
        return Trains(self)

    def _take_trains(self) -> None:
        """Take the outcome from the positions of the trains; what the beam does without them is no part of the envelope."""
        self.without_trains = self._reason
        lost = lost_positions(self.trains)
        self.status, self.reason = lost or ("solved", None)

    @property
    def stands(self) -> bool:
        """Whether the beam stands under all loads but the trains."""
        return self.without_trains is None if self.scene.trains and self.has_answer else self.status == "solved"

    @property
    def has_envelope(self) -> bool:
        """Whether there is anything in an envelope; with trains positions may be left out of it."""
        return self.status == "solved" or bool(self.scene.trains and self.has_answer)

    @property
    def combinations(self) -> Mapping[str, Result]:
        """Results of the combinations by name; empty where the scene has none."""
        return Named("combination", without="the scene has none; ask the result itself")

    def envelope(self, points: int = 20, *, x: Any = None) -> Envelope | TrainEnvelope:
        """Largest and smallest values: with trains over all their positions, else over the whole way of the load.

        Parameters
        ----------
        points : int
            Divisions of every span at which its curves are made, when they are asked for.
        x : array_like, optional
            Places of the curves instead; where a field jumps the larger and the smaller side count.

        Returns
        -------
        Envelope or TrainEnvelope
            Following events, a history or load steps a `PathEnvelope`, each value with its load factor; up to a limit load, where
            there is one. Else at full load.

        Raises
        ------
        ValueError
            The beam is not solved, or a place is outside the beam.
        """
        points, places = whole("points", points, least=1), places_given(self._beam, x)
        if self.scene.trains:
            return TrainEnvelope(self, list(self._members()), places, points)
        if is_followed(self):
            return self.path_envelope(points, x=x)
        return envelope_of_one(self, points, places)

    @property
    def history_extremes(self) -> Extremes:
        """Largest and smallest fields over the whole way of the load, by field, then by ``max`` and ``min``."""
        return Extremes(self.path_envelope, self.path_envelope, "result.history_extremes, or path_envelope()")

    def path_envelope(self, points: int = 20, *, x: Any = None) -> PathEnvelope:
        """Largest and smallest values over the whole way of the load, without trains; with combinations over the ways of all.

        Parameters
        ----------
        points, x
            As for `envelope`.

        Returns
        -------
        PathEnvelope
            Exact for a path from event to event; with smooth laws and on foundations of states along it; else of the load steps.

        Raises
        ------
        ValueError
            The load is not followed, no state stands, or a place is outside the beam.
        """
        points, places = whole("points", points, least=1), places_given(self._beam, x)
        if not is_followed(self):
            raise ValueError('the load is not followed; give load steps, a history or follow = "events"')
        if x is not None or points != 20:
            return PathEnvelope(self, points, places)
        return self._over_path

    @cached_property
    def _over_path(self) -> PathEnvelope:
        return PathEnvelope(self)

    def __getstate__(self) -> dict[str, Any]:
        """Pickle without what is found again when it is asked for."""
        return {key: value for key, value in self.__dict__.items() if key != "_over_path"}

    def _members(self) -> Iterator[Member]:
        """Go through what an envelope with trains is made of.

        Yields
        ------
        Member
            Every train in every direction.
        """
        yield from self.trains._members()

    @property
    def lifted(self) -> list[Lifted]:
        """One-sided supports without contact, each where its opening is largest on the way, in a combination, under a train."""
        envelope = known_envelope(self)
        return lifted_supports(self, envelope) if envelope is not None else []

    @property
    def utilisations(self) -> dict[str, Utilisation]:
        """How far the limits of the scene are used, by quantity; empty where there are none, or where nothing stands."""
        envelope = known_envelope(self) if self.scene.limits is not None else None
        return find_utilisations(self, envelope) if envelope is not None else {}

    def hints(self) -> list[Hint]:
        """Where a load factor between 0 (the dead loads alone) and 1 governs: extremes that are greater there than at both ends.

        Returns
        -------
        list of Hint
            The load is followed from event to event, so that nothing is missed between. None for beams on foundations or with
            smooth laws, and where the state depends on the loading history.
        """
        return find_hints(self)

    def to_dict(self, points: int = 20) -> dict[str, Any]:
        """Everything as plain data, in the form of the JSON output.

        Parameters
        ----------
        points : int
            As in `fields`.

        Returns
        -------
        dict
            Only numbers, strings, lists and dicts.

        Raises
        ------
        ValueError
            As in `fields`.
        """
        return self.to_data(points)

    def to_data(
        self, points: int = 20, steps: Callable[[Iterator], Any] = list, fields: Callable[[Fields], dict] = Fields.to_dict
    ) -> dict[str, Any]:
        """Everything as plain data, the parts that are long as the caller wants them.

        Parameters
        ----------
        points : int
            As in `fields`.
        steps : callable
            What becomes of the steps, which come one by one, each made when its turn comes: a list unless given.
        fields : callable
            What becomes of the fields: lists unless given.

        Returns
        -------
        dict
        """
        return result_data(self, points, steps, fields)
