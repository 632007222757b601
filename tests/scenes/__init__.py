"""Scenes of the tests: plain dicts with the names of the file format, drawn at random by kind; `plain` has what all are made of."""

from .plain import (
    INF,
    at,
    curvature,
    force,
    linear,
    moment,
    nodes_of,
    one_sided,
    place,
    random_scene,
    scene,
    stretch,
    uniform,
)
from .transformed import cut, mirrored, upside_down, working_scheme

__all__ = [
    "INF",
    "at",
    "curvature",
    "cut",
    "force",
    "linear",
    "mirrored",
    "moment",
    "nodes_of",
    "one_sided",
    "place",
    "random_scene",
    "scene",
    "stretch",
    "uniform",
    "upside_down",
    "working_scheme",
]
