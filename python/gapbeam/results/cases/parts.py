"""Lane loads on parts of spans: placed by influence lines, in the contact state that they make.

Where no support changes its state with them, superposition holds, and a load on all parts on which a line is positive makes the
most. Else the line is that of the state that the load makes, repeated until it stays: a lower bound of the worst.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from msgspec.structs import replace

from ...base.errors import WITHOUT_ANSWER, EngineError, SceneError
from ...engine.beam import SOLVED, Beam
from ...engine.influence import influence_parts
from ...scene.combinations import MOST, plan_combinations
from ...scene.cut_loads import Placement
from ...scene.loads import UniformLoad
from ...scene.movements import settle_movements
from ...scene.names import labels
from ...scene.reading import beam_of
from ...scene.structs import Scene
from ...scene.tapers import is_tapered
from ...scene.wording import key_of, number, shown
from ..state.schemes import starting_scheme
from ..state.step import Step

DIVISIONS = 10
"""Of every span: at their ends fields are looked at."""
MOST_ROUNDS = 20
"""Contact states that a placement is looked for in."""


class Target(NamedTuple):
    """What a placement is for: a quantity, its place, and which supports."""

    quantity: str
    x: float
    left: bool
    support: int | None
    name: str


class Parts:
    """Placements of the loads of a case in one combination.

    Parameters
    ----------
    scene : Scene
        With combinations.
    i : int
        Number of the combination.
    case : str
        The case whose loads are placed.
    rule : {"block", "single"}
        How contact states are found.

    Raises
    ------
    SceneError
        Influence lines are not enough: foundations, smooth laws, states that depend on the loading history.
    """

    def __init__(self, scene: Scene, i: int, case: str, rule: str):
        alone = replace(scene, combinations=[replace(scene.combinations[i], expand={})])
        one = settle_movements(plan_combinations(alone).scene_of(0))  # supports that loads move are where they are at full load
        self.case, self._rule, self._one = case, rule, replace(one, trains=[])
        self._lanes = [load for load in one.loads if load.case == case]
        self._others = [load for load in one.loads if load.case != case]
        if any(map(is_tapered, scene.sections)):
            what = "loads on parts of spans beside sections that taper are not available in this version"
            raise SceneError("sections", what)
        if any(hinge.stiffness for hinge in scene.hinges):
            what = "loads on parts of spans beside hinges with a stiffness are not available in this version"
            raise SceneError(f"combinations[{i}].expand", f"{what}; give them as loads of cases of their own")
        self._beam = self._made([])
        if self._beam.depends_on_path or not self._beam.is_linear_between_events:
            problem = (
                '"parts" needs influence lines of straight laws; with foundations, smooth laws and supports whose state '
                "depends on the loading history write the placements as cases of their own"
            )
            raise SceneError(f"combinations[{i}].expand.{key_of(case)}", problem)
        self._end = self._beam.places.end
        self.with_trains = bool(one.trains)
        self.is_exact = not one.trains
        self._states: set[bytes] = set()
        self._closed: dict[bytes, np.ndarray | None] = {}

    def placements(self) -> Iterator[Placement]:
        """Give all placements: everywhere, nowhere, and for the largest and smallest value of every quantity."""
        edges = np.array([self._end])
        for name, there in (("whole", True), ("none", False)):
            yield Placement(f"{self.case} {name}", self.case, edges, np.full((2, 1), there))
        start = self._state(edges, np.zeros((2, 1), dtype=bool))
        if start is None:
            self.is_exact = False
            start = self._state(edges, np.ones((2, 1), dtype=bool))
        for target in self.targets() if start is not None else ():
            for kind, sign in (("max", 1), ("min", -1)):
                yield from self._placed(target, kind, sign, start)

    def _placed(self, target: Target, kind: str, sign: int, closed: np.ndarray) -> Iterator[Placement]:
        """Place the loads for one value, in the state that they make."""
        chosen = np.zeros(self._beam.scene_supports, dtype=bool)
        if target.support is not None:
            chosen[target.support] = True
        piece, distance = self._beam.find(np.array([target.x]), target.left)
        place, seen = (int(piece[0]), float(distance[0])), set()
        while closed is not None and closed.tobytes() not in seen and len(seen) < MOST_ROUNDS:
            seen.add(closed.tobytes())
            try:
                edges, signs = influence_parts(self._beam, closed, target.quantity, place, chosen)
            except EngineError as error:
                if error.status not in WITHOUT_ANSWER:
                    raise
                break
            loaded = np.array([signs == sign, signs == -sign])
            again = f" ({len(seen)})" if len(seen) > 1 else ""
            yield Placement(f"{self.case} {kind} {target.name}{again}", self.case, edges, loaded)
            closed = self._state(edges, loaded)
        self.is_exact = self.is_exact and closed is not None

    def _state(self, edges: np.ndarray, loaded: np.ndarray) -> np.ndarray | None:
        """Give the contact state with a placement; None where the beam does not stand."""
        key = edges.tobytes() + loaded.tobytes()
        if key not in self._closed:
            beam = self._made(list(self._on(edges, loaded)))
            try:
                solution = Step(beam, 1.0, self._rule, starting_scheme(beam)).solution
                stands = solution.status == SOLVED and not solution.indifferent
            except EngineError as error:
                if error.status not in WITHOUT_ANSWER:
                    raise
                stands = False
            self._closed[key] = solution.closed if stands else None
            if stands:
                self._states.add(solution.closed.tobytes())
                self.is_exact = self.is_exact and len(self._states) == 1
        return self._closed[key]

    def _on(self, edges: np.ndarray, loaded: np.ndarray) -> Iterator[UniformLoad]:
        """Give the loads on the parts that have them."""
        for load in self._lanes:
            first, last = load.from_, self._end if load.to is None else load.to
            for a, b, acts in zip([0.0, *edges[:-1].tolist()], edges.tolist(), loaded[int(load.q < 0.0)].tolist(), strict=True):
                a, b = max(a, first), min(b, last)
                if acts and b > a:
                    yield UniformLoad(from_=a, to=b, q=load.q, case=self.case)

    def _made(self, lanes: list[UniformLoad]) -> Beam:
        scene = replace(self._one, loads=[*self._others, *lanes])
        return beam_of(scene)

    def targets(self) -> Iterator[Target]:
        """Give what the loads are placed for: supports first, then fields at ends and tenths of spans."""
        scene = self._one
        at = scene.positions(scene.supports).tolist()
        for k, (support, name) in enumerate(zip(scene.supports, labels(scene.supports), strict=True)):
            if support.direction == "normal":
                yield Target("reaction", at[k], False, k, f"reaction {name}")
                yield Target("deflection", at[k], at[k] >= self._end, None, f"deflection at {number(at[k])}")
        for k, (a, b) in enumerate(pairwise(scene.span_ends().tolist())):
            for part in range(DIVISIONS + 1):
                x, left = a + (b - a) * part / DIVISIONS, part == DIVISIONS
                for quantity in ("moment", "shear", *([] if part in (0, DIVISIONS) else ["deflection"])):
                    side = f" of span {k}" if part in (0, DIVISIONS) else ""
                    yield Target(quantity, b if left else x, left, None, f"{quantity} at {number(b if left else x)}{side}")


def _in_words(parts: Parts) -> str:
    """Say whether placements are the worst."""
    values = "reactions, and moments, shears and deflections at ends and tenths of spans,"
    if parts.is_exact:
        return (
            f"{values} are the largest for {shown(parts.case)} on any parts of spans, as no support changes its state with it; "
            "in between values may be slightly larger"
        )
    why = "trains pass as well" if parts.with_trains else "supports change their state with it, or the beam does not stand"
    return f"{values} are a lower bound of the largest for {shown(parts.case)} on any parts of spans, since {why}"


def place_parts(scene: Scene, rule: str) -> tuple[dict[int, list[Placement]], list[str]]:
    """Place the loads of all combinations with ``parts``.

    Parameters
    ----------
    scene : Scene
        With combinations, checked.
    rule : {"block", "single"}
        How contact states are found.

    Returns
    -------
    placed : dict
        Placements by number of the combination.
    remarks : list of str
        Whether they are the worst.

    Raises
    ------
    SceneError
        As for `Parts`.
    """
    placed, remarks = {}, []
    if any("parts" in one.expand.values() for one in scene.combinations):
        plan_combinations(scene)  # says what makes no sense
    for i, combination in enumerate(scene.combinations):
        for case in [case for case, rule_of in combination.expand.items() if rule_of == "parts"]:
            parts = Parts(scene, i, case, rule)
            if (count := 2 + 2 * len(list(parts.targets()))) > MOST:
                problem = f'"parts" makes up to {count:,} combinations, and {MOST:,} is the most; take "spans", or fewer spans'
                raise SceneError(f"combinations[{i}].expand.{key_of(case)}", problem)
            placed[i] = list(parts.placements())
            remarks.append(f"the combination {shown(combination.name)}: {_in_words(parts)}")
    return placed, remarks
