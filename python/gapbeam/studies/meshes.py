"""Meshed beams as plain arrays, for the studies: families of them, and scenes cut into elements.

What a meshed beam cannot hold (hinges, shear flexibility and so on) is left to the engine; see `Unfit`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..engine.beam import HINGE, RESTRAINED
from ..results.formatting import title
from ..scene.loads import CurvatureLoad, LinearLoad, MomentLoad, TemperatureLoad
from ..scene.reading import read_beam
from ..scene.structs import Scene
from ..scene.tapers import is_tapered

SEED = 2021
"""Of all families with random numbers."""


class Unfit(ValueError):
    """A scene holds something that plain arrays of a meshed beam do not; the message says what."""


@dataclass
class MeshedBeam:
    """A beam of n prismatic elements, a node at each of their n + 1 ends.

    Attributes
    ----------
    name : str
        What to call it.
    length, EI, q : numpy.ndarray
        Of every element; uniform load, positive downward.
    side : numpy.ndarray of int
        Of the support at every node: 1 below, -1 above, 0 both.
    stiffness, level : numpy.ndarray
        Of that support: 0 none, inf rigid; the deflection at which it begins to act.
    force : numpy.ndarray
        At every node, positive downward.
    clamped : tuple of bool
        Whether the rotation is held at the first and the last node.
    scene : Scene or None
        The scene it was cut from, if any.
    x : numpy.ndarray or None
        Where the nodes are in that scene.
    supports : numpy.ndarray of int or None
        Its supports of some stiffness across the beam, from left to right, by their number in the scene.
    """

    name: str
    length: np.ndarray
    EI: np.ndarray
    q: np.ndarray
    stiffness: np.ndarray
    side: np.ndarray | None = None
    level: np.ndarray | None = None
    force: np.ndarray | None = None
    clamped: tuple[bool, bool] = (False, False)
    scene: Scene | None = None
    x: np.ndarray | None = None
    supports: np.ndarray | None = None

    def __post_init__(self) -> None:
        """Fill in what was left out."""
        nodes = len(self.length) + 1
        for name, kind in (("side", np.int32), ("level", float), ("force", float)):
            if getattr(self, name) is None:
                setattr(self, name, np.zeros(nodes, kind))

    @property
    def elements(self) -> int:
        """Number of elements."""
        return len(self.length)

    @property
    def one_sided(self) -> int:
        """Number of one-sided supports."""
        return int(np.count_nonzero(self.side[self.stiffness > 0.0]))


def one_span(elements: int) -> MeshedBeam:
    """Make a simple beam under a uniform load, finely meshed.

    Parameters
    ----------
    elements : int
        Of length 3/16, so that their sum has no rounding error.
    """
    held = np.zeros(elements + 1)
    held[[0, -1]] = np.inf
    return MeshedBeam("one span", np.full(elements, 0.1875), np.full(elements, 7.3), np.full(elements, 1.1), held)


def many_spans(elements: int) -> MeshedBeam:
    """Make many spans of random lengths, stiffnesses and loads on rigid supports, 4 elements each.

    Parameters
    ----------
    elements : int
        At least 4.
    """
    spans = elements // 4
    random = np.random.default_rng(SEED)
    length, EI, q = random.uniform(1.0, 3.0, spans), random.uniform(50.0, 200.0, spans), random.uniform(-1.0, 2.0, spans)
    held = np.zeros(4 * spans + 1)
    held[::4] = np.inf
    return MeshedBeam("many spans", np.repeat(length, 4), np.repeat(EI, 4), np.repeat(q, 4), held)


def stiffness_jumps(elements: int) -> MeshedBeam:
    """Make three spans whose elements have EI from 1e-3 to 1e3 at random.

    Parameters
    ----------
    elements : int
        A third of them in every span, or nearly so.
    """
    random = np.random.default_rng(SEED)
    held = np.zeros(elements + 1)
    held[[0, elements // 3, 2 * elements // 3, -1]] = np.inf
    EI = 10.0 ** random.uniform(-3.0, 3.0, elements)
    return MeshedBeam("jumps of EI", np.full(elements, 0.3), EI, np.full(elements, 1.1), held)


def soft_and_stiff(elements: int) -> MeshedBeam:
    """Make a beam on springs, one after every 4 elements, from 1e-6 to 1e6 times as stiff as the elements.

    Parameters
    ----------
    elements : int
        At least 4; a multiple of 4 is taken.
    """
    spans = elements // 4
    random = np.random.default_rng(SEED)
    springs = np.zeros(4 * spans + 1)
    springs[::4] = 10.0 ** random.uniform(-6.0, 6.0, spans + 1)
    force = np.zeros(4 * spans + 1)
    force[2::4] = random.uniform(-1.0, 2.0, spans)
    return MeshedBeam(
        "soft and stiff", np.full(4 * spans, 0.7), np.full(4 * spans, 0.9), np.full(4 * spans, 0.2), springs, force=force
    )


def gapped_spans(count: int) -> dict[str, Any]:
    """Reference problem P6, work A: many equal spans on springs with gaps under random loads.

    Parameters
    ----------
    count : int
        Spans.

    Returns
    -------
    dict
        The scene.
    """
    q = np.random.default_rng(7).uniform(-10, 25, count).tolist()
    inner = [{"node": i, "side": "below", "stiffness": 1e5, "gap": 0.002 * (i % 3)} for i in range(1, count)]
    return {
        "beam": {"spans": [6.0] * count, "EI": 1e4},
        "supports": [{"node": 0}, *inner, {"node": count}],
        "loads": [{"type": "uniform", "from": 6.0 * j, "to": 6.0 * (j + 1), "q": q[j]} for j in range(count)],
    }


def mesh(source: Mapping[str, Any] | Scene | str, parts: int, name: str = "") -> MeshedBeam:
    """Cut a scene into elements.

    Parameters
    ----------
    source : Scene, mapping or path
        The scene; the loads are those of load factor 1.
    parts : int
        Elements into which each stretch between two places where anything changes is cut.
    name : str
        What to call it.

    Raises
    ------
    Unfit
        Where the scene holds what meshed beams do not.

    Examples
    --------
    >>> beam = mesh({"beam": {"spans": [2.0, 3.0], "EI": 5.0}, "supports": [{"node": i} for i in range(3)],
    ...              "loads": [{"type": "force", "x": 1.0, "F": 4.0}]}, parts=2)
    >>> beam.length.tolist(), beam.force.tolist()
    ([0.5, 0.5, 0.5, 0.5, 1.5, 1.5], [0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 0.0])
    """
    scene, beam = read_beam(source)
    arrays = beam.places
    ends = (0, len(arrays.pieces))
    clamps = arrays.kinds == RESTRAINED
    others = any(isinstance(load, CurvatureLoad | TemperatureLoad | LinearLoad | MomentLoad) for load in scene.loads)
    at_ends = np.isin(arrays.node_points, ends)
    places = arrays.node_points[arrays.support_nodes]
    for wrong, what in (
        (np.any(arrays.kinds == HINGE) or any(one.stiffness for one in scene.hinges), "hinges"),
        (any(map(is_tapered, scene.sections)), "sections that taper"),
        (len(scene.foundation) > 0, "foundations"),
        (beam.has_axial_force, "an axial force N in bending"),
        (np.any(clamps & ~at_ends) or np.isfinite(arrays.turning[clamps]).any(), "a rotational support that is no clamp at an end"),
        (np.isfinite(arrays.pieces[:, 2]).any(), "shear flexibility"),
        (np.isinf(arrays.pieces[:, 1]).any(), "a rigid stretch"),
        (others, "loads other than forces and uniform ones"),
        (len(set(places.tolist())) < len(places), "two supports at one place"),
    ):  # fmt: skip
        if wrong:
            raise Unfit(what)
    EI = arrays.pieces[:, 1]
    loads = arrays.dead + arrays.live
    nodes = parts * len(EI) + 1
    force, stiffness, level, side = np.zeros(nodes), np.zeros(nodes), np.zeros(nodes), np.zeros(nodes, np.int32)
    force[parts::parts] = loads[:, 3]
    force[parts * arrays.node_points] = arrays.force.sum(axis=1)
    at, order = parts * places, np.argsort(places)
    stiffness[at], level[at] = beam.columns.support[1, beam.numbers], arrays.levels[beam.numbers]
    side[at] = beam.sides[beam.numbers]
    length = np.repeat(arrays.pieces[:, 0] / parts, parts)
    x = np.append(np.repeat(arrays.point_x[:-1], parts), arrays.point_x[-1])
    x[:-1] += np.tile(np.arange(parts), len(EI)) * length
    return MeshedBeam(
        name or title(scene, "scene"),
        length,
        np.repeat(EI, parts),
        np.repeat(loads[:, 0], parts),
        stiffness,
        side,
        level,
        force,
        (bool(clamps[0]), bool(clamps[-1])),
        scene,
        x,
        beam.numbers[order[stiffness[at[order]] > 0.0]],
    )
