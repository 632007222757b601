"""Many cases in C and Fortran 77, called by ctypes in the installed library, against `Prepared.solve`, to the last bit."""

import ctypes as c
import random

import gapbeam
import numpy as np
import pytest
from gapbeam.base.errors import GapbeamError
from scenes import random_scene

from .clibrary import RULES, F77Beam, Options, pointer


def solve_in_c(beam, factors, given, rule):
    """Status, message, statuses, reactions, deflections, moments."""
    library, cases, message = beam.c, c.c_void_p(), c.create_string_buffer(400)
    text = message, c.c_size_t(400)
    status = library.gapbeam_prepare_cases(beam.handle, c.byref(cases), *text)
    if status != 0:
        return status, message.value.decode(), None
    count, nodes = len(factors), library.gapbeam_count_nodes(beam.handle)
    found = [np.empty(count, np.int32), *(np.empty((count, n)) for n in (beam.supports, nodes, nodes, nodes))]
    options = Options(c.sizeof(Options), RULES[rule], 0)
    status = library.gapbeam_solve_cases(
        beam.handle, cases, count, pointer(factors), *(None if one is None else pointer(one) for one in given), c.byref(options),
        *map(pointer, found[:2]), None, *map(pointer, found[2:]), *text,
    )  # fmt: skip
    library.gapbeam_free_cases(cases)
    return status, message.value.decode(), found


def solve_in_f77(library, scene, factors, given, rule, like):
    """INFO, and what GHMANY fills: statuses, reactions, deflections, moments, of the shapes of those of C."""
    beam = F77Beam(library, scene)
    varied = any(one is not None for one in given)
    own = [[one.get(key, default) for one in scene["supports"]] for key, default in
           (("settlement", 0.0), ("gap", 0.0), ("stiffness", np.inf))]  # fmt: skip
    shape = len(factors), len(scene["supports"])
    values = [np.broadcast_to(np.array(base, dtype=float), shape) if one is None else one
              for one, base in zip(given, own, strict=True)]  # fmt: skip
    supports = np.stack(values, axis=-1).copy()
    found = [np.empty_like(one) for one in like]
    conditions = np.empty(shape, np.int32)
    cases = np.zeros(1, np.int64)
    info = beam.call("ghcase", beam.beam, cases) or beam.call(
        "ghmany", beam.beam, cases, shape[0], factors, int(varied), supports, RULES[rule], *found[:2], conditions, *found[2:]
    )
    beam.call("ghfree", cases)
    return info, found


def given_for(rng, scene, count):
    """Settlements, gaps and stiffnesses of the supports in every case, or what of them is not given."""
    supports = scene["supports"]
    moves, gaps, springs = (np.zeros((count, len(supports))) for _ in range(3))
    for k, one in enumerate(supports):
        for case in range(count):
            moves[case, k] = rng.choice((0.0, rng.uniform(-0.01, 0.02)))
            gaps[case, k] = 0.0 if one.get("side", "both") == "both" else rng.choice((0.0, rng.uniform(-0.01, 0.02)))
            springs[case, k] = one.get("stiffness", np.inf) or 0.0
            if springs[case, k] > 0.0:
                springs[case, k] = rng.choice((np.inf, 10.0 ** rng.uniform(2, 5)))
    return [rng.choice((one, None)) for one in (moves, gaps, springs)]


def test_cases_agree(library):
    """Random scenes, cases with and without other supports, also such as leave no room for each other."""
    seen, moving = {0: 0, 1: 0, 11: 0}, 0
    library.c.gapbeam_free_cases.argtypes = [c.c_void_p]
    for seed in range(120):
        rng = random.Random(seed)
        scene = random_scene(rng)
        scene.pop("sections", None)
        if seed % 3 == 0:  # loads that move supports
            moved = [k for k, one in enumerate(scene["supports"]) if one.get("direction", "normal") == "normal"]
            scene["loads"] += [{"type": "movement", "support": rng.choice(moved), "value": rng.uniform(-0.02, 0.02), "case": case}
                               for case in ("dead", "live") if moved]  # fmt: skip
        beam, message = library.prepare(scene)
        try:
            prepared = gapbeam.prepare(scene)
        except GapbeamError:
            assert message or solve_in_c(beam, np.ones((1, len(scene["loads"]))), [None] * 3, "block")[0] != 0
            continue
        count, rule = rng.choice((1, 3, 11)), rng.choice(("block", "single"))
        prepared = gapbeam.prepare(scene, rule=rule)
        factors = np.array([[rng.uniform(-0.5, 2.0) for _ in scene["loads"]] for _ in range(count)]).reshape(count, -1)
        given = given_for(rng, scene, count)
        status, message, found = solve_in_c(beam, factors, given, rule)
        assert status == 0, (seed, message)
        moves, gaps, springs = given
        expected = prepared.solve(factors, settlement=moves, gap=gaps, stiffness=springs)
        across = np.isin(np.arange(len(scene["supports"])), prepared.supports)
        assert found[0].tolist() == expected.status.tolist(), seed
        names = ("reaction", "deflection", "moment_left", "moment_right")
        for name, values in zip(names, [found[1][:, across], *found[2:]], strict=True):
            assert values.tobytes() == getattr(expected, name).tobytes(), (seed, name)
        assert np.isnan(found[1][:, ~across]).all()
        info, in_f77 = solve_in_f77(library, scene, factors, given, rule, found)
        assert info == 0
        assert [one.tobytes() for one in in_f77] == [one.tobytes() for one in found]
        for one in found[0].tolist():
            seen[one] = seen.get(one, 0) + 1
        moving += prepared._solver.movements is not None
        beam.close()
    assert min(seen.values()) > 3
    assert moving > 9


@pytest.mark.parametrize("keys", [{"foundation": [{"k": 1e3, "side": "below"}]}, {"N": 500.0}, {"N": -3.0}])
def test_cases_in_stretches(library, keys):
    """On ground, and with axial forces that bending feels; with other gaps too, and with loads that move supports."""
    scene = {"beam": {"spans": [6.0, 6.0], "EI": 1e4}, "supports": [{"node": 0}, {"node": 1, "side": "below"}, {"node": 2}],
             "loads": [{"type": "uniform", "q": 1.0}, {"type": "force", "x": 9.0, "F": -5.0},
                       {"type": "movement", "support": 0, "value": 0.01}]}  # fmt: skip
    (scene["beam"] if "N" in keys else scene).update(keys)
    rng = np.random.default_rng(1)
    factors, gaps = rng.uniform(0.0, 2.0, (40, 3)), np.zeros((40, 3))
    gaps[:, 1] = rng.uniform(0.0, 0.01, 40)
    for loads, given in ((2, None), (2, gaps), (3, None), (3, gaps)):
        some = {**scene, "loads": scene["loads"][:loads]}
        beam, _ = library.prepare(some)
        status, message, found = solve_in_c(beam, factors[:, :loads].copy(), [None, given, None], "block")
        assert status == 0, message
        expected = gapbeam.prepare(some).solve(factors[:, :loads], gap=given)
        assert found[0].tolist() == expected.status.tolist() == [0] * 40
        for name, values in zip(("reaction", "deflection", "moment_left", "moment_right"), found[1:], strict=True):
            np.testing.assert_allclose(values, getattr(expected, name), rtol=0, atol=1e-13 * np.abs(values).max())
        info, in_f77 = solve_in_f77(library, some, factors[:, :loads].copy(), [None, given, None], "block", found)
        assert (info, [one.tobytes() for one in in_f77]) == (0, [one.tobytes() for one in found])
        beam.close()


@pytest.mark.parametrize("spans", [3, 40])
def test_widths_agree(library, spans):
    """Cases in lanes."""
    rng = np.random.default_rng(spans)
    side = [{"side": "below", "stiffness": 1e5}] * (spans - 1)
    supports = [{"node": 0}, *({"node": i + 1, **one} for i, one in enumerate(side)), {"node": spans}]
    loads = [{"type": "uniform", "from": 6.0 * i, "to": 6.0 * i + 6.0, "q": 1.0} for i in range(spans)]
    scene = {"beam": {"spans": [6.0] * spans, "EI": 1e4}, "supports": supports, "loads": loads}
    factors, gaps = rng.uniform(-10, 25, (700, spans)), rng.uniform(0.0, 0.01, (700, spans + 1))
    gaps[:, [0, -1]] = 0.0
    beam, _ = library.prepare(scene)
    status, _, found = solve_in_c(beam, factors, [None, gaps, None], "block")
    expected = gapbeam.prepare(scene).solve(factors, gap=gaps)
    assert status == 0
    for values, name in zip(found, ("status", "reaction", "deflection", "moment_left", "moment_right"), strict=True):
        assert values.tobytes() == getattr(expected, name).tobytes(), name
    beam.close()


RACK = {
    "beam": {"spans": [6.0, 6.0], "EI": 1e4, "EA": 1e6, "alpha": 1.2e-5},
    "supports": [*({"node": k, "side": "below", "friction": 0.3} for k in range(3)), {"node": 0, "direction": "axial"}],
    "loads": [{"type": "uniform", "q": 10.0, "case": "dead"}, {"type": "temperature", "dT": 60.0},
              {"type": "force", "x": 9.0, "F": 20.0}],
}  # fmt: skip
PILE = {
    "beam": {"spans": [20.0], "EI": 1e5, "EA": 8e6}, "axial_ground": [{"stiffness": 2e4, "limit": 60.0}],
    "supports": [{"node": 0}, {"node": 1}, {"node": 1, "direction": "axial", "stiffness": 5e4}],
    "loads": [{"type": "axial", "node": 0, "F": 1000.0}, {"type": "force", "x": 5.0, "F": 10.0}], "analysis": {"first_order": True},
}  # fmt: skip
YIELDING = {"unloading": "plastic", "law": [[0.01, 5.0], [0.05, 6.0]]}
CURVE = {"law": {"type": "tanh", "stiffness": 500.0, "limit": 8.0}}


@pytest.mark.parametrize(
    "scene",
    [
        RACK, PILE, PILE | {"foundation": [{"k": 1e4}]},
        *(RACK | {"supports": [{"node": 0}, {"node": 1, **law}, {"node": 2}, {"node": 0, "direction": "axial"}]}
          for law in (YIELDING, CURVE)),
    ],
    ids=["friction", "ground along", "ground along and below", "plastic", "curve"],
)  # fmt: skip
def test_cases_on_paths(library, scene):
    """Beams whose state depends on the loading history, and on curves: the digits of Python."""
    beam, message = library.prepare(scene)
    assert not message
    factors = np.array([[1.0, 1.0, 1.0], [1.35, -0.5, 1.0], [1.0, 1.0, -30.0], [0.0, 1.0, 0.5]])[:, : len(scene["loads"])].copy()
    status, message, found = solve_in_c(beam, factors, [None] * 3, "block")
    assert (status, message) == (0, "")
    expected = gapbeam.prepare(scene).solve(factors)
    assert found[0].tolist() == expected.status.tolist()
    assert 0 in expected.status
    names, across = ("reaction", "deflection", "moment_left", "moment_right"), expected.reaction.shape[1]
    for name, values in zip(names, [found[1][:, :across], *found[2:]], strict=True):
        assert values.tobytes() == getattr(expected, name).tobytes(), name
    info, in_f77 = solve_in_f77(library, scene, factors, [None] * 3, "block", found)
    assert (info, [one.tobytes() for one in in_f77]) == (0, [one.tobytes() for one in found])
    beam.close()
