"""Positions of a train at which the beam can move freely, without work of the loads: what is not unique there is its place alone.

A support where it can move carries nothing, wherever it stands within what is free. With such supports, as many as it takes, the
beam is held, and forces are those of a train on any other beam.
"""

from __future__ import annotations

from contextlib import suppress

import numpy as np
from msgspec.structs import replace

from ...base.errors import GapbeamError, Status
from ...engine.beam import Beam
from ...engine.states import Solution
from ...engine.trains import Traversal
from ...scene.loads import ForceLoad, UniformLoad
from ...scene.reading import beam_of
from ...scene.structs import Scene, Support
from ...scene.trains import LEFT, Course

NOTHING = 2.0**-30
"""Share of the loads that a support which carries nothing may have by rounding."""
AWAY = 2.0**-16
"""Share of the beam, or of its deflection, by which a support that holds nothing can be moved."""


def traversal_of(beam: Beam, course: Course, from_: float, to: float) -> Traversal:
    """Move a train over a beam.

    Parameters
    ----------
    beam : Beam
    course : Course
        The train.
    from_, to : float
        Positions.

    Raises
    ------
    EngineError
        No unique state exists at some position.
    """
    return Traversal(beam, course.offset, course.force, course.uniform, from_, to, course.direction == LEFT)


def loaded(scene: Scene, course: Course, near: float, position: float) -> Scene:
    """Put a train onto a beam, as forces.

    Parameters
    ----------
    scene : Scene
        The beam.
    course : Course
        The train.
    near : float
        Distance below which an axle is at the end of the beam.
    position : float
        Of the train.

    Returns
    -------
    Scene
        Without trains.
    """
    end = float(scene.span_ends()[-1])
    found = course.loads(position, end, near, course.acting(position, end, near))
    loads = [UniformLoad(q=value, from_=left, to=right) if right else ForceLoad(x=left, F=value) for left, right, value in found]
    return replace(scene, loads=[*scene.loads, *loads], trains=[], combinations=[])


def held_traversal(scene: Scene, course: Course, near: float, from_: float, to: float) -> Traversal | None:
    """Move a train over a beam that can move freely, and is kept from it by supports that carry nothing.

    Parameters
    ----------
    scene : Scene
        The beam.
    course : Course
        The train.
    near : float
        Distance below which an axle is at the end of the beam.
    from_, to : float
        Positions at which it can move freely.

    Returns
    -------
    Traversal or None
        Its supports are those of the scene, and others after them; None where no such supports are found.
    """
    own = len(scene.supports)
    try:
        held = _hold(scene, course, near, from_ + (to - from_) / 2)
        if held is None:
            return None
        traversal = traversal_of(beam_of(held), course, from_, to)
        if (traversal.status != Status.SOLVED).any():
            return None
        reactions = [np.abs(one.values[:, 0, : one.count[:, 0].min(), 0]).max() for one in traversal.extremes()[1]]
    except GapbeamError:
        return None
    load = max(np.abs(course.force).max(initial=0.0), *reactions)
    return traversal if max(reactions[own:]) <= NOTHING * load else None


def _hold(scene: Scene, course: Course, near: float, position: float) -> Scene | None:
    """Hold a beam at its ends and hinges, where it can move freely."""
    def solution_of(some: Scene) -> Solution:
        return _solve(loaded(some, course, near, position))

    end = float(scene.span_ends()[-1])
    free = solution_of(scene)
    for x in 2 * (0.0, end, *scene.beam.hinges):  # one that is held may move when another is
        if not free.indifferent:
            return scene
        beam = beam_of(scene)
        k = int(np.abs(beam.node_x - x).argmin())
        level = float(np.ldexp(free.deflection[k], beam.units.deflection))
        carrying_nothing, movable = [], False
        for away in (0.0, AWAY, -AWAY):
            held = replace(scene, supports=[*scene.supports, Support(x=x, settlement=level + away * max(abs(level), AWAY * end))])
            with suppress(GapbeamError):  # beside another support there may be no room for it, or no answer with it
                solution = solution_of(held)
                reactions = np.abs(solution.at_supports[0])
                if solution.status == Status.SOLVED and reactions[-1] <= NOTHING * reactions.max():  # it carries nothing
                    carrying_nothing.append((held, solution))
                    movable |= away != 0.0
        if movable:
            scene, free = carrying_nothing[0]
    return None if free.indifferent else scene


def _solve(scene: Scene) -> Solution:
    beam = beam_of(scene)
    return beam.solve(1.0, "block", np.ones(beam.supports, dtype=np.int32))
