"""One of many cases with all that there is to say of it."""

from __future__ import annotations

import numpy as np
from msgspec.structs import replace

from ...base.errors import EngineError, SceneError
from ...engine.beam import Beam
from ...engine.combinations import Varied
from ...scene.columns import columns
from ...scene.combinations import times
from ...scene.reading import beam_of
from ...scene.structs import Scene
from ..paths.compression_check import compression_of
from ..paths.following import follow_path
from ..result import Result
from ..state.schemes import starting_scheme
from ..state.steps import LoadSteps
from .varied import replace_numbers


def result_of_case(scene: Scene, beam: Beam, rule: str, factors: np.ndarray, varied: Varied) -> Result:
    """Solve one case with all that there is to say of it, whether the beam would buckle or not.

    Parameters
    ----------
    scene : Scene
        The prepared scene.
    beam : Beam
        Made of it.
    rule : {"block", "single"}
        How contact states are found.
    factors : numpy.ndarray
        Of all loads.
    varied : Varied
        Numbers of this one case.
    """
    if not varied.is_nothing:
        scene = replace_numbers(scene, columns(scene), varied)
    if beam.depends_on_path or beam.has_links_along:  # dead loads are put on first; with factors all are live
        once = replace(scene.analysis, follow="steps", steps=1, at_limit="stop", history=[1.0])
        scene = replace(scene, analysis=once, loads=[times(load, by) for load, by in zip(scene.loads, factors, strict=True)])
        beam = beam_of(scene)
    else:
        beam = (beam if varied.is_nothing else beam_of(scene)).with_factors(factors)
    result = Result(scene, beam, rule)
    if beam.depends_on_path:
        follow_path(result)
    else:
        result.steps = LoadSteps(beam, rule, starting_scheme(beam), 1)
        fallen = result.steps.solve_all()
        if fallen is not None:
            result._refuse("in this load case", *fallen[1:])
    for step in result.steps:
        result.compression = compression_of(result, step)
    return result


def why_not_solved(scene: Scene, beam: Beam, rule: str, factors: np.ndarray, varied: Varied) -> str | None:
    """Say why a case is not solved.

    Parameters
    ----------
    scene, beam, rule, factors, varied
        As for `result_of_case`.

    Returns
    -------
    str or None
        None where it is solved.
    """
    try:
        result = result_of_case(scene, beam, rule, factors, varied)
    except (EngineError, SceneError) as error:
        return str(error)
    if not scene.analysis.first_order and result.compression is not None and result.compression.is_refused:
        return str(result.compression.refusal())
    return result.reason
