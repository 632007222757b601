"""Scenes, read and checked: TOML, JSON or Python."""

from ..engine.tolerances import POSITION_TOLERANCE
from .analysis import Analysis
from .axial_ground import AxialGround
from .edited import replace
from .joints import Hinge, Rotation
from .limits import Limits
from .loads import (
    AxialLoad,
    AxialUniformLoad,
    CurvatureLoad,
    ForceLoad,
    LinearLoad,
    Load,
    MomentLoad,
    MovementLoad,
    TemperatureLoad,
    UniformLoad,
)
from .masses import Mass
from .places import same_place
from .reading import read_scene
from .schema import scene_schema
from .structs import Beam, Combination, Foundation, Scene, Section, Support, Train, Units

__all__ = [
    "POSITION_TOLERANCE", "Analysis", "AxialGround", "AxialLoad", "AxialUniformLoad", "Beam", "Combination", "CurvatureLoad",
    "ForceLoad", "Foundation", "Hinge", "Limits", "LinearLoad", "Load", "Mass", "MomentLoad", "MovementLoad", "Rotation", "Scene",
    "Section", "Support", "TemperatureLoad", "Train", "UniformLoad", "Units", "read_scene", "replace", "same_place",
    "scene_schema",
]  # fmt: skip
