"""Axial forces that bending feels in C and Fortran 77: states, modes and buckling have the digits of Python."""

import math
import random

import gapbeam
import numpy as np
import pytest
from gapbeam.base.errors import EngineError, SceneError
from gapbeam.engine.modes import PARTS
from scenes.axial_force import column, random_scene

from .clibrary import F77Beam
from .test_languages import assert_same_ground, assert_same_state, python_result

BUCKLING, VIBRATION, ASKED = 1, 2, 2


def both(library, scene):
    """A scene in C and Fortran 77; an error of the scene is one there too."""
    beam, message = library.prepare(scene)
    f77 = F77Beam(library, scene)
    assert (f77.info_ == 0) == (not message), message
    return beam, f77, message


def assert_same_modes(beams, result):
    """The first values of both kinds, and the shape of one mode."""
    for kind, name, values in ((BUCKLING, "buckling", result.buckling), (VIBRATION, "vibration", result.frequencies)):
        for one in beams:
            assert one.modes(kind, ASKED) == (0, list(values))
        if values:
            mode = result.mode(name, len(values))
            for one in beams:
                shape = one.mode_shape(kind, mode.value, PARTS)
                for found, expected in zip(shape[:3], (mode.x, mode.deflection, mode.moment), strict=True):
                    np.testing.assert_array_equal(found, expected)
                assert shape[3:] == (mode.amplitude, -1 if mode.support is None else mode.support)


@pytest.mark.parametrize("compression", [None, 0.6])
def test_states_and_modes_agree(library, compression):
    """Under tension and compression, on ground that resists slopes too."""
    sheared = modes = 0
    for seed in range(9):
        scene = random_scene(seed, compression=compression, mass=seed in (2, 4))
        if seed in (4, 5):
            scene["masses"] = [{"x": 0.3 * sum(scene["beam"]["spans"]), "mass": 2.0}]
        scene.pop("sections", None)
        scene["analysis"] = {"rule": "block", "steps": 1, "buckling": ASKED, "frequencies": ASKED}
        result = python_result(scene)
        beam, f77, message = both(library, scene)
        if isinstance(result, SceneError):
            assert message
            continue
        (status, message), info = beam.solve(1.0), f77.solve(1.0)
        assert info == status
        if isinstance(result, EngineError):
            assert (status > 10, message) == (True, str(result))
            continue
        assert {0: "solved", 1: "no-equilibrium", 2: "buckles"}[status] == result.status
        if status == 0:
            assert_same_state(beam, f77, result, scene, random.Random(seed))
            if "foundation" in scene:
                assert_same_ground(beam, f77, result, scene, random.Random(seed))
            assert [beam.unique(), f77.unique()] == [result.steps[-1].unique] * 2
            assert_same_modes((beam, f77), result)
            sheared += any("shear" in foundation for foundation in scene.get("foundation", ()))
            modes += bool(result.buckling) + bool(result.frequencies)
        beam.close()
    assert sheared > 0
    assert modes > 1


def test_columns_with_stops_agree(library):
    """States that are not the only ones, and beams that buckle."""
    seen = []
    for seed in range(12):
        scene = {**column(seed, share=1 + seed % 5), "analysis": {"rule": "block", "steps": 1, "buckling": ASKED}}
        result = python_result(scene)
        beam, f77, _ = both(library, scene)
        status, _ = beam.solve(1.0)
        assert f77.solve(1.0) == status
        if isinstance(result, EngineError):
            assert status > 10
            continue
        seen.append(result.status)
        if status == 2:
            assert result.status == "buckles"
            for one in (beam, f77):
                share, *shape = one.buckling()
                assert f"bears {share:.6g} times its axial forces" in result.reason
                assert list(zip(*shape, strict=True)) == result.motion
        else:
            assert (status, result.status) == (0, "solved")
            assert [beam.unique(), f77.unique()] == [result.steps[-1].unique] * 2
            assert_same_state(beam, f77, result, scene, random.Random(seed))
            assert_same_modes((beam, f77), result)
        beam.close()
    assert {"solved", "buckles"} <= set(seen)


def test_axial_loads_agree(library):
    """That bending feels, and of first order where that is asked for."""
    pressed = 0
    for seed in range(16):
        scene = column(seed, share=0.8)
        force = scene["beam"].pop("N")
        scene["supports"].append({"node": 0, "direction": "axial"})
        scene["loads"].append({"type": "axial", "node": 1, "F": force, "case": ("dead", "live")[seed % 2]})
        scene["analysis"] = {"rule": "block", "first_order": seed % 4 == 3}
        result = python_result(scene)
        assert result._beam.feels_axial_loads is (seed % 4 < 3)
        beam, f77, _ = both(library, scene)
        status, _ = beam.solve(1.0)
        assert f77.solve(1.0) == status == 0
        assert_same_state(beam, f77, result, scene, random.Random(seed))
        pressed += result._beam.feels_axial_loads
        beam.close()
    assert pressed == 12


def test_stretched_beams_agree(library):
    """Held along their axis at two places, steps among them; and what is refused."""
    for seed in range(6):
        scene = column(seed, share=0.8)
        scene["beam"].pop("N")
        scene["beam"]["EA"] = 1e4
        scene["supports"] += [{"node": 0, "direction": "axial"}, {"node": 1, "direction": "axial", "stiffness": 300.0 * (1 + seed)}]
        scene["analysis"] = {"rule": "block", "stretching": True}
        result = python_result(scene)
        assert result.at(0.3).axial_force > 0.0
        beam, f77, _ = both(library, scene)
        status, _ = beam.solve(1.0)
        assert f77.solve(1.0) == status == 0
        assert_same_state(beam, f77, result, scene, random.Random(seed))
        beam.close()
    scene["supports"].pop()
    _, _, message = both(library, scene)
    assert "at two places, not at 1" in message


def test_load_paths_agree(library):
    """From event to event with axial forces that stay what they are, or grow."""
    events = 0
    for seed in range(12):
        analysis = {"rule": "block", "follow": "events", "N_with": ("dead", "live")[seed % 2]}
        scene = {**column(seed, share=0.7), "analysis": analysis}
        result = gapbeam.solve(scene)
        beam, f77, _ = both(library, scene)
        status, found = beam.follow_ground(1.0)
        assert f77.follow_ground(1.0) == (status, found)
        assert (status, result.status) == (0, "solved")
        assert [(f, k) for f, k, *_ in found] == [(e.factor, e.support) for e in result.events]
        assert beam.follow(1.0)[:2] == (11, "the beam has an axial force N: use follow_ground")
        assert f77.follow(1.0)[0] == -1
        events += len(found)
        beam.close()
    assert events > 4


def test_columns_that_buckle_on_their_way_agree(library):
    """Pulled off its stop a column gives way where the stop has nothing to push any more."""
    scene = {
        "beam": {"spans": [1.0], "EI": 1.0, "N": -2 * math.pi**2},
        "supports": [{"node": 0}, {"x": 0.5, "side": "below", "gap": 0.02}, {"node": 1}],
        "loads": [{"type": "uniform", "q": 1.0, "case": "dead"}, {"type": "force", "x": 0.5, "F": -3.0}],
        "analysis": {"rule": "block", "follow": "events"},
    }
    beam, f77, _ = both(library, scene)
    assert beam.follow_ground(1.0) == f77.follow_ground(1.0) == (2, [])
    assert beam.info().factor == pytest.approx(1.6440875059318176 / 3, rel=1e-13)
    (share, x, w), (same, *shape) = beam.buckling(), f77.buckling()
    assert share == same == pytest.approx(0.5, rel=1e-9)
    np.testing.assert_array_equal([x, w], shape)
    np.testing.assert_allclose(abs(w), np.sin(math.pi * x), atol=1e-8)
    beam.close()


@pytest.mark.parametrize(
    ("where", "key", "value", "words", "info"),
    [
        ("beam", "N", math.inf, "N: expected a finite number", -29),
        ("beam", "mass", -1.0, "mass: expected a finite number, 0 or more", -29),
        ("foundation", "shear", -1.0, "shear: expected a finite number, 0 or more", -30),
        ("foundation", "gap", 0.1, "shear: ground with a second parameter holds the beam both ways", -30),
        ("foundation", "k", -1.0, "k: expected", -16),
    ],
)
def test_wrong_numbers_are_refused(library, where, key, value, words, info):
    scene = {
        "beam": {"spans": [6.0], "EI": 3e3, "N": -1.0}, "supports": [{"node": 0}, {"node": 1}], "loads": [],
        "foundation": [{"k": 10.0, "shear": 2.0}],
    }  # fmt: skip
    (scene["beam"] if where == "beam" else scene["foundation"][0])[key] = value
    status, message = library.prepare(scene)
    assert (status, words in message) == (11, True), message
    f77 = F77Beam(library, scene)
    assert (f77.info_, f77.entry[0]) == (info, 1)
