"""The names that ``import gapbeam`` offers; what few programs use is imported when it is asked for."""

from importlib import import_module
from typing import TYPE_CHECKING

from .base.errors import EngineError, GapbeamError, SceneError, Status, UnsolvedError
from .base.hints import missing
from .results.cases.cases import Prepared, prepare
from .results.cases.combined import CombinedResult
from .results.cases.solved_cases import Cases
from .results.envelopes.envelope import Envelope
from .results.result import Result
from .results.state.fields import Fields
from .results.state.step import Step
from .results.state.system import System
from .results.stepping import solve
from .results.views.extreme import Extreme
from .results.views.shown import Shown
from .scene import (
    Analysis,
    AxialGround,
    AxialLoad,
    AxialUniformLoad,
    Beam,
    Combination,
    CurvatureLoad,
    ForceLoad,
    Foundation,
    Hinge,
    Limits,
    LinearLoad,
    Mass,
    MomentLoad,
    MovementLoad,
    Rotation,
    Scene,
    Section,
    Support,
    TemperatureLoad,
    Train,
    UniformLoad,
    Units,
    read_scene,
    replace,
)
from .show import display

if TYPE_CHECKING:
    from . import packs
    from .batches import sample
    from .batches.batch import Batch
    from .batches.function import function
    from .batches.run import batch
    from .results.result_schema import result_schema
    from .scene import scene_schema

    __version__: str

Shown.display = display

__all__ = [
    "Analysis",
    "AxialGround",
    "AxialLoad",
    "AxialUniformLoad",
    "Batch",
    "Beam",
    "Cases",
    "Combination",
    "CombinedResult",
    "CurvatureLoad",
    "EngineError",
    "Envelope",
    "Extreme",
    "Fields",
    "ForceLoad",
    "Foundation",
    "GapbeamError",
    "Hinge",
    "Limits",
    "LinearLoad",
    "Mass",
    "MomentLoad",
    "MovementLoad",
    "Prepared",
    "Result",
    "Rotation",
    "Scene",
    "SceneError",
    "Section",
    "Status",
    "Step",
    "Support",
    "System",
    "TemperatureLoad",
    "Train",
    "UniformLoad",
    "Units",
    "UnsolvedError",
    "__version__",
    "batch",
    "function",
    "packs",
    "prepare",
    "read_scene",
    "replace",
    "result_schema",
    "sample",
    "scene_schema",
    "solve",
]

LATER = {
    "Batch": "batches.batch", "batch": "batches.run", "function": "batches.function", "sample": "batches.sample",
    "packs": "packs", "result_schema": "results.result_schema", "scene_schema": "scene.schema",
}  # fmt: skip
"""Files of names that are imported when they are asked for."""

MEANT = {
    "pointload": "gapbeam.ForceLoad", "nodalload": "gapbeam.ForceLoad", "concentratedload": "gapbeam.ForceLoad",
    "point": "gapbeam.ForceLoad", "force": "gapbeam.ForceLoad", "pointforce": "gapbeam.ForceLoad",
    "udl": "gapbeam.UniformLoad", "distributedload": "gapbeam.UniformLoad or gapbeam.LinearLoad",
    "lineload": "gapbeam.UniformLoad or gapbeam.LinearLoad", "trapezoidalload": "gapbeam.LinearLoad",
    "triangularload": "gapbeam.LinearLoad", "pointmoment": "gapbeam.MomentLoad", "couple": "gapbeam.MomentLoad",
    "thermalload": "gapbeam.TemperatureLoad", "movingload": "gapbeam.Train",
    "vehicle": "gapbeam.Train", "axle": "gapbeam.Train(axles=[(distance, force)])", "loadcase": "case = ... of a load",
    "case": "case = ... of a load", "loadcombination": "gapbeam.Combination", "model": "gapbeam.Scene",
    "system": "gapbeam.Scene", "structure": "gapbeam.Scene", "problem": "gapbeam.Scene", "span": "gapbeam.Beam(spans=[...])",
    "bearing": "gapbeam.Support", "roller": "gapbeam.Support", "pin": "gapbeam.Support", "spring": "gapbeam.Support(stiffness=...)",
    "hinge": "gapbeam.Beam(hinges=[x])", "winkler": "gapbeam.Foundation", "soil": "gapbeam.Foundation",
    "ground": "gapbeam.Foundation", "load": "gapbeam.read_scene(path), or solve(path) at once",
    "read": "gapbeam.read_scene(path)", "open": "gapbeam.read_scene(path)", "loads": "gapbeam.read_scene(mapping)",
    "fromtoml": "gapbeam.read_scene(path)", "run": "gapbeam.solve", "analyze": "gapbeam.solve", "analyse": "gapbeam.solve",
    "calculate": "gapbeam.solve", "plot": "result.plot()", "draw": "result.plot()", "show": "result.plot()",
    "printreport": "result.report()", "summary": "result.report()", "envelope": "result.envelope()",
    "montecarlo": "gapbeam.batch with columns of gapbeam.sample", "save": "scene.to_toml(path) or result.to_json(path)",
    "error": "gapbeam.GapbeamError",
}  # fmt: skip
"""What to write for words of other programs, in lower case without underscores."""


def __getattr__(name: str) -> object:
    """Import what was left for later."""
    if name == "__version__":
        return import_module("importlib.metadata").version("gapbeam")
    if name not in LATER:
        raise AttributeError(no_such_name(name))
    module = import_module(f"{__package__}.{LATER[name]}")
    return module if name in ("packs", "sample") else getattr(module, name)


def no_such_name(name: str) -> str:
    """Word that the package has no such name, and what was probably meant.

    Parameters
    ----------
    name : str
        What was asked for.

    Examples
    --------
    >>> no_such_name("PointLoad"), no_such_name("Suport")
    ("gapbeam has no 'PointLoad'; use gapbeam.ForceLoad", "gapbeam has no 'Suport'; did you mean gapbeam.Support?")
    """
    return missing("gapbeam", name, __all__, MEANT, "gapbeam.")
