"""The names that ``import gapbeam`` offers."""

from importlib.metadata import version

from .base.errors import EngineError, GapbeamError, SceneError, Status
from .batches import sample
from .batches.batch import Batch
from .batches.run import batch
from .results.cases.cases import Prepared, prepare
from .results.cases.combined import CombinedResult
from .results.cases.solved_cases import Cases
from .results.envelopes.envelope import Envelope
from .results.result import Result
from .results.state.fields import Fields
from .results.state.step import Step
from .results.state.system import System
from .results.stepping import solve
from .scene import (
    Analysis,
    AxialLoad,
    Beam,
    Combination,
    CurvatureLoad,
    ForceLoad,
    Foundation,
    Limits,
    LinearLoad,
    MomentLoad,
    Scene,
    Section,
    Support,
    Train,
    UniformLoad,
    Units,
    read_scene,
    scene_schema,
)

__version__ = version("gapbeam")

__all__ = [
    "Analysis",
    "AxialLoad",
    "Batch",
    "Beam",
    "Cases",
    "Combination",
    "CombinedResult",
    "CurvatureLoad",
    "EngineError",
    "Envelope",
    "Fields",
    "ForceLoad",
    "Foundation",
    "GapbeamError",
    "Limits",
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
    "Train",
    "UniformLoad",
    "Units",
    "__version__",
    "batch",
    "prepare",
    "read_scene",
    "sample",
    "scene_schema",
    "solve",
]
