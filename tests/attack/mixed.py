"""Scenes in which parts of many kinds meet, on every road."""

from scenes.mixed import mixed_scene

from . import roads
from .family import Family

PROMISE = (
    "Where supports with laws, curves, friction and restraints, hinges, tapers, ground, axial forces, temperatures, masses and GA "
    "meet, reactions, fields and extremes are the same on every road, and events are at the same factors"
)


def draw(seed):
    """What meets, and a scene with it."""
    kind, made = mixed_scene(seed)
    return kind, {**made, "analysis": {}}


FAMILY = Family("mixed", PROMISE, draw, roads.judge, share=0.1)
