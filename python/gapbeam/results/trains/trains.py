"""Trains: loads that move over the beam, followed from event to event, and what they make at most.

Positions are those of the first axle. The loads of the scene stay, dead and live ones in full. A state is that of supports that
act one way, so superposition does not hold: at every position the right supports act. The engine follows them by polynomials in
the position (`ExactTraversal`), but on foundations and with smooth laws, where there are none, `SampledTraversal` does.

>>> import gapbeam
>>> result = gapbeam.solve({
...     "beam": {"spans": [1.0, 1.0], "EI": 1.0},
...     "supports": [{"node": i, "side": "below"} for i in range(3)],
...     "loads": [{"type": "uniform", "q": 1.0, "case": "dead"}],
...     "trains": [{"name": "crane", "axles": [[0.0, 8.0]], "to": 1.0}],
... })
>>> [(event.support, event.event, round(event.position, 12)) for event in result.trains["crane"].events]
[(2, 'opens', 0.194903920083), (2, 'closes', 0.888199776858)]
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ...base.errors import EngineError
from ...base.hints import no_such
from ...base.records import Record
from ...engine.beam import GIVEN
from ...engine.tolerances import POSITION_TOLERANCE
from ...scene.columns import ROTATION
from ...scene.reading import beam_of
from ...scene.trains import LEFT, RIGHT, at_ends, courses, fitted, joined, nearest, train_name
from ...scene.wording import choice, number, shown
from ..state.arguments import finite, whole
from ..state.schemes import starting_scheme
from ..state.state_extremes import extremes_of_state
from ..state.step import Step
from ..state.steps import LoadSteps
from ..views.extreme import Extremes, Source
from .envelope import TrainEnvelope, places_along, places_given
from .members import Member, fields_of
from .neutral import loaded
from .sampled import SampledTraversal
from .train_verbs import TrainVerbs
from .traversals import ExactTraversal, TrainEvent, UnstablePositions

if TYPE_CHECKING:
    from ..result import Result
    from ..state.fields import Fields


@dataclass(frozen=True, slots=True, eq=False)
class Influence(Record):
    """An influence line: what a unit force, downward, adds while the same supports act.

    Attributes
    ----------
    places : numpy.ndarray
        Where the force is.
    values : numpy.ndarray
        What it makes.
    """

    places: np.ndarray
    values: np.ndarray


class TrainState(Step):
    """The state at one position of a train: a step whose beam has the train's axles as forces.

    Attributes
    ----------
    name : str
        Of the train.
    position : float
        Its position.
    direction : {"right", "left"}
        Which way it goes.
    result : Result
        The same as the result of a scene with these forces: fields anywhere, extremes, report.
    """

    def __init__(self, result: Result, position: float, direction: str, name: str):
        super().__init__(result._beam, 1.0, result._rule, result.steps.closed(0))
        self.name = name
        self.position = position
        self.direction = direction
        self.result = result

    def __repr__(self) -> str:
        """Show where the train is."""
        return f"TrainState({shown(self.name)}, position={number(self.position)}, direction={shown(self.direction)})"

    def fields(self, x: Any, side: str = "right") -> Fields:
        """Exact values anywhere along the beam.

        Parameters
        ----------
        x, side
            As for `Result.at`.

        Returns
        -------
        Fields
        """
        return self.result.at(x, side=side)

    @property
    def extremes(self) -> Extremes:
        """Exact largest and smallest values of every field, by field, then by ``max`` and ``min``."""
        source = Source(train=self.name, position=self.position, direction=self.direction)
        find = partial(extremes_of_state, self, self._beam, source)
        return Extremes(find, self.result._pairs_of_extremes, 'state.extremes["moment"]["max"].value')


class TrainResult(TrainVerbs):
    """A train that goes over the beam; it has the verbs of results, with largest and smallest values over all positions.

    Attributes
    ----------
    name : str
        Its name.
    train : Train
        What it is.
    """

    def __init__(self, result: Result, i: int):
        self.name, self.train = train_name(result.scene, i), result.scene.trains[i]
        self._result, self._joined = result, fitted(joined(result.scene.trains, i), float(result.scene.span_ends()[-1]))

    @cached_property
    def traversals(self) -> list[ExactTraversal] | list[SampledTraversal]:
        """The train in every direction in which it goes."""
        result = self._result
        end = result._beam.places.end
        near = nearest(self._joined, end)
        try:
            kind = ExactTraversal if result._beam.is_linear_between_events else SampledTraversal
            return [kind(result, course, near, self.name) for course in courses(self._joined, end)]
        except EngineError as error:
            raise EngineError(f"train {self.name}: {error}", error.status) from None

    @property
    def ways(self) -> list[ExactTraversal] | list[SampledTraversal]:
        """Give the same as `traversals`, by the name that it had."""
        warnings.warn("ways of a train are called traversals", DeprecationWarning, stacklevel=2)
        return self.traversals

    @property
    def events(self) -> list[TrainEvent]:
        """Every change of the contact state at its exact position, in the order in which they happen."""
        return [event for traversal in self.traversals for event in traversal.events]

    @property
    def unstable_positions(self) -> list[UnstablePositions]:
        """Positions at which the beam is unstable, is not held in one place, or has no unique answer."""
        return [one for traversal in self.traversals for one in traversal.unstable_positions]

    @property
    def gaps(self) -> list[UnstablePositions]:
        """Give the same as `unstable_positions`, by the name that it had."""
        warnings.warn("gaps of a train are called unstable_positions", DeprecationWarning, stacklevel=2)
        return self.unstable_positions

    @property
    def solves(self) -> int:
        """Linear solves."""
        return sum(traversal.solves for traversal in self.traversals)

    def envelope(self, points: int = 20, *, x: Any = None) -> TrainEnvelope:
        """Largest and smallest values over all positions, as `Result.envelope`.

        Parameters
        ----------
        points, x
            As there.

        Returns
        -------
        TrainEnvelope

        Raises
        ------
        ValueError
            A place outside the beam.
        """
        if np.ndim(points):  # they stood there before
            warnings.warn("places of an envelope are given as x = [...]", DeprecationWarning, stacklevel=2)
            points, x = 20, points
        places = places_given(self._result._beam, x)
        return TrainEnvelope(self._result, self._members(), places, whole("points", points, least=1))

    renamed: ClassVar = {"members": "_members"}

    def _members(self, combination: str | None = None) -> list[Member]:
        """What an envelope is made of: the train in every direction.

        Parameters
        ----------
        combination : str, optional
            Name of the combination.
        """
        return [member for traversal in self.traversals for member in traversal.members(self, combination)]

    def state(self, position: float, direction: str = RIGHT, scheme: np.ndarray | None = None) -> TrainState:
        """The state at a position of the train.

        Parameters
        ----------
        position : float
            Position of its first axle; any, also beyond those that the scene gives.
        direction : {"right", "left"}
            Which way it goes; left needs ``both_directions``.
        scheme : numpy.ndarray of int, optional
            Which supports act, where that is known: at a position at which the beam tips, that before or after.

        Returns
        -------
        TrainState
            A step, with fields and extremes; the axles are forces of its beam, so it has a certificate.

        Raises
        ------
        ValueError
            Without equilibrium there, or the train does not go that way.
        """
        position = finite("position", position)
        traversal = self._traversal(direction)
        # Extremes beside the end, where an axle has just left, are farther off
        position = at_ends(position, self._joined, direction, self._result._beam.places.end, POSITION_TOLERANCE)
        scene = loaded(self._result.scene, traversal.course, traversal.near, position)
        beam = beam_of(scene)
        if isinstance(traversal, SampledTraversal):
            traversal.loads.lead(beam, position)
        result = self._result._another(scene, beam, self._result._rule if scheme is None else GIVEN)
        result.steps = LoadSteps(result._beam, result._rule, starting_scheme(result._beam) if scheme is None else scheme, 1)
        fallen = result.steps.solve_all()
        if fallen is not None:
            result._refuse(f"at position {position:g} of train {self.name}", *fallen[1:])
            raise ValueError(f"position: {result.reason}")
        return TrainState(result, position, traversal.course.direction, self.name)

    def influence(
        self, what: str, *, x: float, position: float, direction: str = RIGHT, places: Any = None, side: str = "right"
    ) -> Influence:
        """Influence line while the supports act that act at a position of the train.

        Parameters
        ----------
        what : {"reaction", "couple", "moment", "shear", "rotation", "deflection", "pressure"}
            What it is of: couple on the beam from the supports at x, clockwise; pressure on foundations only.
        x : float
            Place on the beam; for a reaction or couple that of the support.
        position, direction
            Of the train.
        places : array_like, optional
            Where the unit force is; default: 20 divisions of every span, and all places where something is.
        side : {"right", "left"}
            Which value is taken where it jumps at x.

        Returns
        -------
        Influence
            It says what a small force adds; a larger one may open or close supports.

        Raises
        ------
        ValueError
            A place outside the beam, no support there, no equilibrium at that position, or ground whose law is a curve.
        """
        beam, traversal, of_supports = self._result._beam, self._traversal(direction), ("reaction", "couple")
        if what not in (has_lines := (*fields_of(beam), *of_supports)):
            raise ValueError(f"what: expected {choice(shown(name) for name in has_lines)}, got {shown(what)}")
        state = self.state(position, direction)
        x = float(places_given(beam, [finite("x", x)])[0])
        places = places_along(beam) if places is None else places_given(beam, places, "places")
        at = self._result.scene.positions(self._result.scene.supports)
        chosen = (np.abs(at - x) <= traversal.near) & beam.across
        if what in of_supports and not chosen.any():
            raise ValueError(f"x: there is no support at x = {x:g}")
        if what == "couple" and not beam.columns.support[ROTATION, :-1][chosen].any():
            raise ValueError(f"x: the support at x = {x:g} lets the beam rotate freely; with rotation it has a couple")
        return Influence(places, traversal.influence(state, what, x, chosen, places, side))

    def _traversal(self, direction: str) -> ExactTraversal | SampledTraversal:
        for traversal in self.traversals:
            if traversal.course.direction == direction:
                return traversal
        if direction not in (RIGHT, LEFT):
            raise ValueError(f'direction: expected "right" or "left", got {shown(direction)}')
        raise ValueError(f"direction: train {self.name} goes to the right only; give both_directions = true")


class Trains(Mapping[str, TrainResult]):
    """Trains by name, in the order of the scene."""

    def __init__(self, result: Result):
        self._by_name = {train_name(result.scene, i): TrainResult(result, i) for i in range(len(result.scene.trains))}

    def __getitem__(self, name: str) -> TrainResult:
        """Give a train by its name."""
        if name not in self._by_name:
            without = f"the scene has no trains, so none {name!r}: give it some, trains = [...]"
            raise KeyError(no_such("train", name, self._by_name) if self._by_name else without)
        return self._by_name[name]

    def __iter__(self) -> Iterator[str]:
        """Go through the names."""
        return iter(self._by_name)

    def __len__(self) -> int:
        """Count the trains."""
        return len(self._by_name)

    def __repr__(self) -> str:
        """Show the names."""
        return f"Trains({', '.join(map(shown, self))})"

    def pass_all(self) -> None:
        """Move all trains over the beam, so that what stands in the way of one is said at once."""
        for train in self._by_name.values():
            train.traversals  # noqa: B018

    def _members(self, combination: str | None = None) -> list[Member]:
        """Go through the trains as what an envelope is made of, as `TrainResult._members`."""
        return [member for train in self.values() for member in train._members(combination)]
