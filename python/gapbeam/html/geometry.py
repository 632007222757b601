"""The parts that all states of a beam share on a page: joints, pieces and their loads, supports, foundations, units."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..engine.quantities import QUANTITIES
from ..results import formatting as fmt
from ..scene.ground_tables import at_both_ends
from ..scene.movements import number_of_moved
from ..scene.names import DEAD, label, labels
from ..scene.rotations import turns
from ..scene.temperature import as_curvatures

if TYPE_CHECKING:
    from ..results.result import Result
    from ..scene.structs import Scene

MOST_PLACES, FEWER_PLACES = 240, 120
"""Places along a beam on the ground at which its states are given; while trains pass, of which there are more states."""
SIDES = {"below": 1, "both": 0, "above": -1}


def places_on_ground(result: Result) -> tuple[np.ndarray, np.ndarray]:
    """Choose the places at which states on the ground are given: there they are no polynomials.

    Parameters
    ----------
    result : Result
        Of one load.

    Returns
    -------
    piece : numpy.ndarray of int
        Piece of every place, from 0.
    distance : numpy.ndarray
        Distance from its left end.
    """
    most = FEWER_PLACES if result.scene.trains else MOST_PLACES
    return result._places_along(max(1, most // len(result.scene.beam.spans)))


def beam_data(result: Result) -> dict[str, Any]:
    """Give joints, pieces and loads between the joints.

    Parameters
    ----------
    result : Result
        Of one load.

    Returns
    -------
    dict
        ``x`` the joints; ``pieces`` length, 1/EI, 1/GA of each; ``dead`` and ``live`` load per length at its left and right end,
        imposed curvature, and by how much that rises; ``forces`` at the joints, dead and live; on the ground ``grid``, number of
        the piece and place of every row of a state.
    """
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
    if result._beam.in_stretches:
        piece, distance = places_on_ground(result)
        found["grid"] = {"piece": piece.tolist(), "x": (places.point_x[piece] + distance).tolist()}
    return found


def supports_data(scene: Scene, levels: np.ndarray) -> list[dict[str, Any]]:
    """Give the supports as they are drawn.

    Parameters
    ----------
    scene : Scene
    levels : numpy.ndarray
        Deflection at which each begins to act.
    """
    rows = zip(scene.supports, labels(scene.supports), scene.positions(scene.supports).tolist(), levels.tolist(), strict=True)
    return [
        {
            "name": name, "x": x, "side": SIDES.get(one.side, 0), "level": level, "gap": one.gap or 0.0,
            "axial": one.direction == "axial", "elastic": one.law is not None or bool(np.isfinite(one.stiffness)),
            "turning": 0 if one.rotation == "free" else 2 if one.rotation == "fixed" else 1,
        } | ({"turns": True} if turns(one) else {})
        for one, name, x, level in rows
    ]  # fmt: skip


def loads_data(scene: Scene) -> list[dict[str, Any]]:
    """Give the loads as they are drawn; those that move supports with their places and ways, those of the ground with its ends.

    Parameters
    ----------
    scene : Scene
        The scene; of a combination with its factors.
    """
    nodes, found = scene.span_ends(), []
    at = scene.positions(scene.supports).tolist()
    for k, (load, given) in enumerate(zip(as_curvatures(scene).loads, scene.loads, strict=True)):
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
            from_, to = fmt.stretch(scene, load)
            ends = list(at_both_ends(load.kappa if kind == "curvature" else load.q))
            if not any(ends) and getattr(given, "dT", 0.0):  # it lengthens only
                one["type"], ends = "temperature", 2 * [given.dT]
            one |= {"from": from_, "to": to, "ends": ends}
        found.append(one)
    return found


def foundations_data(scene: Scene) -> list[dict[str, Any]]:
    """Give the foundations as they are drawn."""
    found = []
    for k, one in enumerate(scene.foundation):
        from_, to = fmt.stretch(scene, one)
        found.append({"name": label(scene.foundation, k), "from": from_, "to": to, "side": SIDES[one.side]})
    return found


def units_data(scene: Scene) -> dict[str, list[Any]]:
    """Give the unit that is shown of every quantity, and how many of it are one of the scene.

    Parameters
    ----------
    scene : Scene
        With its labels.
    """
    names = [one.name for one in QUANTITIES] + ["x", "opening", "reaction", "couple", "set", "friction", "slip"]
    names += ["uniform", "sag", "resultant"]
    return {name: list(fmt.shown_unit(scene, name)) for name in names}


def panels_data(fields: dict[str, int]) -> list[dict[str, Any]]:
    """Give the fields that are drawn, each in a panel of its own.

    Parameters
    ----------
    fields : dict
        Of `Beam.fields`.

    Returns
    -------
    list of dict
        Name, words, and whether positive values go down.
    """
    return [{"name": one.name, "words": one.panel, "down": one.downward} for one in QUANTITIES if one.name in fields and one.panel]
