"""Beams on supports that act one way only: gaps, lift-off, hinges, solved by the classical mixed method.

Five lines are enough:

>>> import gapbeam
>>> scene = gapbeam.Scene(beam=gapbeam.Beam(spans=[6.0, 6.0], EI=1e4), loads=[gapbeam.UniformLoad(q=5.0, to=6.0)])
>>> scene.supports = [gapbeam.Support(node=i, side="below") for i in range(3)]
>>> scene.loads.append(gapbeam.UniformLoad(q=1.0, case="dead"))
>>> gapbeam.solve(scene).steps[-1].reaction.round(3)
array([15.375, 26.25 ,  0.375])

Units: any consistent set. Signs: x to the right; deflections and loads positive downward, reactions upward, moments
sagging, rotations and couples clockwise.
"""

from importlib.metadata import version as _version

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

__version__ = _version("gapbeam")

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
