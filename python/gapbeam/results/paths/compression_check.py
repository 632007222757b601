"""The largest axial compression of all states of a scene, noted, and refused where it is beyond the Euler load."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain
from typing import TYPE_CHECKING

import numpy as np

from ...engine.beam import SOLVED, Beam
from ...engine.combinations import Varied, solve_combinations
from ...engine.ground import least_tensions
from ...engine.quantities import FIELDS
from ...scene.loads import AxialUniformLoad
from .branches import BranchPath
from .compression import Compression, larger
from .struts import Struts, struts_of

if TYPE_CHECKING:
    from ...scene.structs import Scene
    from ..result import Result
    from ..state.step import Step

TENSION = FIELDS.index("axial_force")


def tensions(beam: Beam, step: Step) -> np.ndarray:
    """Give the axial force of every piece in a state, the smallest along it."""
    if beam.is_on_axial_ground:
        return least_tensions(step.solution)
    return np.minimum(*(step.solution.values(*ends)[TENSION] for ends in ends_of_pieces(beam)))


def ends_of_pieces(beam: Beam) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Give the left ends of all pieces, then the right ones, as pieces and distances."""
    x = beam.places.point_x
    yield beam.find(x[:-1], left=False)
    yield beam.find(x[1:], left=True)


def compression_of(result: Result, step: Step, struts: Struts | None = None) -> Compression | None:
    """Find the largest compression of a state beside the Euler load.

    Parameters
    ----------
    result : Result
        Whose state it is.
    step : Step
        The state.
    struts : Struts, optional
        Of its beam, to be used again.

    Returns
    -------
    Compression or None
        None where nothing is compressed.
    """
    beam = result._beam
    if beam.bars < 0 or beam.feels_axial_loads:
        return None
    struts, tension = struts_of(beam) if struts is None else struts, tensions(beam, step)
    if not tension.min() < 0.0:
        return None
    return struts.of_step(result.scene, step, tension, step.breakpoints if beam.has_laws else None)


def check_compression(result: Result) -> None:
    """Note the largest compression of all states on the loading history, and refuse one that is beyond the Euler load.

    Parameters
    ----------
    result : Result
        Of one load; receives `compression`.

    Raises
    ------
    SceneError
        It is, and ``analysis.first_order`` does not let it pass.
    """
    if result._beam.bars < 0 or result._beam.feels_axial_loads:
        return
    struts, asked = struts_of(result._beam), not result.scene.analysis.first_order
    is_straight = not (result._beam.is_on_axial_ground or any(isinstance(load, AxialUniformLoad) for load in result.scene.loads))
    # Steps of movements alone have no path
    if result._beam.has_links_along and is_straight and result.path is not None:
        states = _along(result, struts)
    else:
        on_the_way = chain(result.steps, _begins(result))
        states = ((f"at load factor {step.factor:.6g} ", compression_of(result, step, struts)) for step in on_the_way)
    for where, found in chain(states, _with_trains(result, struts)):
        result.compression = larger(result.compression, found)
        if asked and found is not None and found.is_refused:
            raise found.refusal(where)
    if asked and result.compression is not None and result.compression.is_warned:
        result.remarks = [result.compression.remark()]


def _along(result: Result, struts: Struts) -> Iterator[tuple[str, Compression | None]]:
    """Go through both ends of all segments, where the path has the axial forces: no state is solved for them."""
    for closed, breakpoints, factors, tension in result.path.pressed():
        for k in struts.notable(closed, tension, breakpoints):
            yield f"at load factor {factors[k]:.6g} ", struts.largest(closed, tension[k], breakpoints=breakpoints)


def _begins(result: Result) -> Iterator[Step]:
    """States with which stretches of a path begin: with falling load more is pressed there than where they end.

    Where a path is followed for steps only, those with which its stretches end too.
    """
    path = result.path
    if not isinstance(path, BranchPath):
        return  # the load grows from stretch to stretch
    for segment in path.segments:
        yield path.begin(segment)
        if result.scene.analysis.follow == "steps":
            yield path.step(segment, segment.stop)


def _with_trains(result: Result, struts: Struts) -> Iterator[tuple[str, Compression | None]]:
    """Go through the states while trains pass: their axles change the supports that act, not the axial forces."""
    if not result.scene.trains or not result.steps:
        return
    tension = tensions(result._beam, result.steps[-1])
    if not tension.min() < 0.0:
        return
    for name, train in result.trains.items():
        for traversal in train.traversals:
            yield from ((f"with train {name} ", found) for found in traversal.compressions(struts, tension))


def refused_cases(
    beam: Beam, factors: np.ndarray, rule: str, closed: np.ndarray, varied: Varied, sections: Sequence[bool]
) -> np.ndarray:
    """Find the cases whose compression is beyond the Euler load.

    Parameters
    ----------
    beam : Beam
        Without ground.
    factors : numpy.ndarray
        Of all loads, cases by loads.
    rule : {"block", "single"}
        How schemes are found.
    closed : numpy.ndarray of int
        Where the searches start, cases by supports.
    varied : Varied
        Numbers that differ from those of the beam.
    sections : sequence of bool
        For every piece whether its EI is that of a section.
    """
    refused, struts = np.zeros(len(factors), dtype=bool), Struts(beam)
    pieces, distances = map(np.concatenate, zip(*ends_of_pieces(beam), strict=True))
    for part, found in solve_combinations(beam, factors, None, rule, closed, pieces, distances, varied, False):
        for row in np.flatnonzero(found.status == SOLVED).tolist():
            k, tension = part.start + row, found.fields[row, :, TENSION].reshape(2, -1).min(axis=0)
            if tension.min() < 0.0:
                EI = None if varied.spans is None else np.where(sections, struts.EI, varied.spans[k, beam.places.span, 0])
                one = struts.largest(found.closed[row], tension, EI)
                refused[k] = one is not None and one.is_refused
    return refused


def pieces_in_sections(scene: Scene, beam: Beam) -> np.ndarray:
    """Tell of every piece whether its EI is that of a section.

    Parameters
    ----------
    scene, beam
        The scene and its beam.
    """
    x, end = beam.places.point_x, beam.places.end
    middle, found = (x[:-1] + x[1:]) / 2, np.zeros(beam.pieces, dtype=bool)
    for section in scene.sections:
        if section.EI is not None:
            found |= (middle > section.from_) & (middle < (end if section.to is None else section.to))
    return found
