"""What ``import gapbeam`` offers."""

from importlib.metadata import version

from .errors import EngineError, GapbeamError, SceneError, Status
from .prepared import Cases, Prepared, prepare
from .results import Fields, Result, System
from .scene import (
    Analysis,
    AxialLoad,
    Beam,
    CurvatureLoad,
    ForceLoad,
    Foundation,
    LinearLoad,
    MomentLoad,
    Scene,
    Section,
    Support,
    UniformLoad,
    Units,
    read_scene,
    scene_schema,
)
from .states import Step
from .stepping import solve

__version__ = version("gapbeam")

__all__ = [
    "Analysis",
    "AxialLoad",
    "Beam",
    "Cases",
    "CurvatureLoad",
    "EngineError",
    "Fields",
    "ForceLoad",
    "Foundation",
    "GapbeamError",
    "LinearLoad",
    "MomentLoad",
    "Prepared",
    "Result",
    "Scene",
    "SceneError",
    "Section",
    "Status",
    "Step",
    "Support",
    "System",
    "UniformLoad",
    "Units",
    "__version__",
    "prepare",
    "read_scene",
    "scene_schema",
    "solve",
]
