"""Everything that the slider of a page can show: the loading history of a scene, its combinations, its trains."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from ..base.characters import visible
from ..results import formatting as fmt
from ..scene.ground_tables import at_both_ends
from ..scene.movements import number_of_moved
from ..scene.names import DEAD, labels
from ..scene.rotations import turns
from .load_ways import count_numbers, way_of_load
from .states import SIDES, is_at_places, places_on_ground
from .train_ways import MOST_NUMBERS, way_of_train

if TYPE_CHECKING:
    from ..results.envelopes.envelope import Envelope
    from ..results.result import Result
    from ..results.trains.envelope import TrainEnvelope
    from ..scene.structs import Scene

Of = tuple[str | None, str | None, str | None]
"""Names of a combination and of a train, and which way that goes; None for what there is not."""
MOST_WAYS, MOST_VALUES = 60, 12_000
"""Combinations, or trains in combinations, that a page moves; numbers that their states may take."""


class Collected:
    """Ways, and what several of them share, told once.

    Attributes
    ----------
    ways, beams, supports, loads : list of dict
        Of a way the others are given by their numbers.
    words : list of str
        For the states of supports.
    left_out : int
        Ways that are not moved, since there are so many.
    """

    def __init__(self) -> None:
        self.ways: list[dict[str, Any]] = []
        self.beams: list[dict[str, Any]] = []
        self.supports: list[list[dict[str, Any]]] = []
        self.loads: list[list[dict[str, Any]]] = []
        self.words: list[str] = []
        self.left_out = 0

    def add(self, of: Of, title: str, result: Result, way: dict[str, Any]) -> None:
        """Add a way.

        Parameters
        ----------
        of : (str, str, str)
            Names of the combination and of the train, and which way that goes; None for what there is not.
        title : str
            What it is called.
        result : Result
            Of one load.
        way : dict
            States, intervals, events; or a motion.
        """
        if way.get("intervals") == []:  # no position has a unique answer
            reason = next((one["words"] for one in way.get("lost", ())), "no state can be drawn")
            way = {"motion": [], "reason": visible(reason), "axis": "motion"}
        supports = _supports_data(result.scene, result._beam.places.levels)
        shared = {
            "beam": _number(self.beams, _beam_data(result)), "supports": _number(self.supports, supports),
            "loads": _number(self.loads, _loads_data(result.scene)),
        }  # fmt: skip
        self.ways.append({"of": list(of), "title": title, **shared, **way})


def _number(known: list[Any], one: Any) -> int:
    if one not in known:
        known.append(one)
    return known.index(one)


def collect_ways(
    result: Result, envelope: Envelope | TrainEnvelope | None, first: tuple[Of, float | None] | None = None
) -> Collected:
    """Find all that a page moves.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.
    envelope : Envelope or TrainEnvelope or None
        Its `Result.envelope`, if there is one.
    first : (tuple, float or None), optional
        The way that is shown first, as in `Collected.add`, and of a train its position.

    Returns
    -------
    Collected
        The combinations that govern come before others, where there are too many.
    """
    found = Collected()
    if not result.combinations:
        _ways_of(found, None, result, envelope, first, 1, count_numbers(result))
        return found
    names = list(result.combinations)
    chosen = set(_governing(envelope) if envelope is not None else names)
    chosen = [name for name in names if name in chosen] + [name for name in names if name not in chosen]
    numbers = 2 * len(result._beam.places.point_x) + 3 * len(result.scene.supports)
    most = max(1, min(MOST_WAYS, MOST_VALUES // numbers) // (1 + 4 * len(result.scene.trains)))
    chosen = sorted(chosen[:most], key=names.index)
    found.left_out = len(names) - len(chosen)
    together = sum(count_numbers(result.combinations[name]) for name in chosen)
    for name in chosen:
        _ways_of(found, name, result.combinations[name], envelope, first, len(chosen), together)
    return found


def _governing(envelope: Envelope | TrainEnvelope) -> Iterator[str]:
    """Names of the combinations that extremes come from."""
    for row in [*envelope.extremes.values(), *(of for support in envelope.supports for of in support.values())]:
        for one in row.values():
            if one is not None and one.combination is not None:
                yield one.combination


def _ways_of(
    found: Collected, of: str | None, result: Result, envelope: Envelope | TrainEnvelope | None,
    first: tuple[Of, float | None] | None, shared_by: int, together: int,
) -> None:  # fmt: skip
    """Add the ways of one load: that of the load, those of its trains, and how it moves where it is unstable."""
    name = visible(of or "")
    trains = result.trains.values() if result.scene.trains and result.has_answer else ()
    traversals = [(train, one) for train in trains for one in train.traversals]
    fields = {} if envelope is None else envelope.extremes
    largest = {name: max((abs(one.value) for one in row.values() if one), default=0.0) for name, row in fields.items()}
    for train, traversal in traversals:
        going = f", going {traversal.course.direction}" if len(train.traversals) > 1 else ""
        most = MOST_NUMBERS // (len(traversals) * shared_by)
        words = ": ".join(part for part in (name, f"{visible(train.name)}{going}") if part)
        way = of, train.name, traversal.course.direction
        also = [first[1]] if first is not None and first[0] == way else []
        found.add(way, words, result, way_of_train(result, train, traversal, found.words, largest, most, also))
    if result.motion or not (result.steps or traversals):
        motion = {"motion": [list(pair) for pair in result.motion or ()], "reason": visible(result.reason or ""), "axis": "motion"}
        words = fmt.MOTIONS.get(result.status, "free motion") if result.motion else "no answer"
        motion["moves"] = words
        found.add((of, None, "motion"), ": ".join(part for part in (name, words) if part), result, motion)
    if result.steps:
        alone = "without trains" if traversals else "as far as it stands" if result.motion else ""
        title = ": ".join(part for part in (name, alone) if part)
        found.add((of, None, None), title, result, way_of_load(result, found.words, together))


def _beam_data(result: Result) -> dict[str, Any]:
    """Give joints, pieces (length, and flexibility in bending and shear) and loads between the joints."""
    places = result._beam.places
    forces = np.zeros((len(places.point_x), 2))
    forces[places.node_points] = places.force
    with np.errstate(divide="ignore"):
        flexibility = 1.0 / places.pieces[:, 1:]
    found: dict[str, Any] = {
        "x": places.point_x.tolist(),
        "pieces": np.column_stack((places.pieces[:, 0], flexibility)).tolist(),
        "dead": places.dead[:, [0, 1, 2, 5]].tolist(),
        "live": places.live[:, [0, 1, 2, 5]].tolist(),
        "forces": forces.tolist(),
        "hinges": [*map(float, result.scene.beam.hinges), *result.scene.positions(result.scene.hinges).tolist()],
    }
    if is_at_places(result):
        piece, distance = places_on_ground(result)
        found["grid"] = {"piece": piece.tolist(), "x": (places.point_x[piece] + distance).tolist()}
    return found


def _supports_data(scene: Scene, levels: np.ndarray) -> list[dict[str, Any]]:
    """Give the supports as they are drawn, with the deflections at which they begin to act."""
    rows = zip(scene.supports, labels(scene.supports), scene.positions(scene.supports).tolist(), levels.tolist(), strict=True)
    return [
        {
            "name": name, "x": x, "side": SIDES.get(one.side, 0), "level": level, "gap": one.gap or 0.0,
            "axial": one.direction == "axial", "elastic": one.law is not None or bool(np.isfinite(one.stiffness)),
            "turning": 0 if one.rotation == "free" else 2 if one.rotation == "fixed" else 1,
        } | ({"turns": True} if turns(one) else {})
        for one, name, x, level in rows
    ]  # fmt: skip


def _loads_data(scene: Scene) -> list[dict[str, Any]]:
    """Give the loads as they are drawn; those that move supports with their places and ways, those of the ground with its ends."""
    nodes, found = scene.span_ends(), []
    at = scene.positions(scene.supports).tolist()
    for k, load in enumerate(scene.loads):
        kind = load.__struct_config__.tag
        one: dict[str, Any] = {"type": kind, "dead": load.case == DEAD}
        if kind == "movement":
            which = number_of_moved(scene, k, load)
            if load.foundation is not None:
                from_, to = fmt.stretch(scene, scene.foundation[which])
                one |= {"way": "ground", "x": (from_ + to) / 2, "moves": np.broadcast_to(load.value, 2).tolist()}
            else:
                support = scene.supports[which]
                turned = turns(support) or load.rotation is not None
                one |= {"way": "turn" if turned else "along" if support.direction == "axial" else "across", "x": at[which],
                        "moves": [load.value if load.rotation is None else load.rotation]}  # fmt: skip
        elif kind in ("force", "moment", "axial"):
            one["x"] = float(nodes[load.node]) if load.node is not None else load.x
            one["value"] = load.M if kind == "moment" else load.F
        else:
            one["from"], one["to"] = fmt.stretch(scene, load)
            if kind == "temperature":
                one["changes"] = {name: value for name, value in (("dT", load.dT), ("gradient", load.gradient)) if value}
                one["ends"] = [0.0, 0.0]
            else:
                one["ends"] = list(at_both_ends(load.kappa if kind == "curvature" else load.q))
        found.append(one)
    return found
