"""Scenes of the tests: plain dicts with the names of the file format, drawn at random by kind; `plain` has what all are made of."""

from .plain import (
    INF,
    at,
    curvature,
    cut,
    force,
    linear,
    mirrored,
    moment,
    nodes_of,
    one_sided,
    place,
    random_scene,
    scene,
    stretch,
    uniform,
    working_scheme,
)

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
    "working_scheme",
]
