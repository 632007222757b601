"""The interfaces say the same: C and Fortran 77, called by ctypes in the installed library, against Python, to the last digit.

The Fortran interface is what the other two marshal to; its own tests are test_api*.f90 and the example.
"""

import itertools
import math
import random
import re
import tomllib

import gapbeam
import numpy as np
import pytest
from gapbeam.base.errors import EngineError, SceneError
from gapbeam.engine.quantities import FIELDS as QUANTITIES_OF_PYTHON
from gapbeam.results.paths.branches import BranchPath
from gapbeam.results.state.breakpoints import EVENTS
from gapbeam.studies.meshes import gapped_spans
from scenes import nodes_of, random_scene
from scenes.curved import random_curved_scene
from scenes.foundation import random_scene as ground_scene
from scenes.ground import touching
from scenes.law import FAMILIES, law_scene
from scenes.moving import random_moving_scene
from scenes.rigid_ground import rigid_scene
from scenes.tabled import random_tabled_scene

from .clibrary import F77Beam
from .installation import TOP

FIELDS = ("deflection", "rotation", "moment", "shear", "axial_force", "axial_displacement")
QUANTITIES = (*FIELDS, "pressure", "curvature", "transverse")
CONDITIONS = {"open": 0, "closed": 1, "bilateral": 2, "touching": 4} | {f"branch {k}": 10 + k for k in range(1, 10)}


def scene_of(seed):
    """A random scene without sections (stretches of other stiffness are spans in these interfaces), some with axial loads."""
    rng = random.Random(seed)
    made = random_scene(rng)
    made.pop("sections", None)
    end = nodes_of(made)[-1]
    if rng.random() < 0.3:
        made["beam"]["EA"] = 10.0 ** rng.uniform(2, 5)
        made["supports"].append({"node": 0, "direction": "axial", "settlement": rng.choice((0.0, 0.01))})
        if rng.random() < 0.5:
            made["supports"].append({"x": end, "direction": "axial", "stiffness": 3e3})
        made["analysis"] = {**made.get("analysis", {}), "first_order": True}  # the others know no Euler load
        made["loads"] += [{"type": "axial", "x": rng.uniform(0.0, end), "F": rng.uniform(-9, 9)} for _ in range(2)]
    if rng.random() < 0.05:
        # Far from 1: these are solved in other units
        power = rng.choice((-250, 200))
        made["beam"]["EI"] = (np.array(made["beam"]["EI"]) * 2.0**power).tolist()
        made["beam"]["GA"] = float("inf")
        made["beam"].pop("EA", None)
        for support in made["supports"]:
            if support.get("direction") != "axial":
                support.pop("stiffness", None)
                support.pop("rotation", None) if support.get("rotation") != "fixed" else None
        for load in made["loads"]:
            for key in set(load) & {"F", "M", "q"}:
                load[key] = (np.array(load[key]) * 2.0**power).tolist()
    return made


def python_result(scene):
    """Result, or the exception."""
    try:
        return gapbeam.solve(scene)
    except (SceneError, EngineError) as error:
        return error


def solved_everywhere(library, scene):
    """The result of a scene that is solved, and its beam in C and in Fortran 77, solved under all of its loads."""
    result = python_result(scene)
    beam, message = library.prepare(scene)
    assert not message
    f77 = F77Beam(library, scene)
    assert (f77.info_, beam.solve(1.0), f77.solve(1.0)) == (0, (0, ""), 0)
    return result, beam, f77


def assert_same_state(beam, f77, result, scene, rng, bounds_too=True):
    """Everything a state says; its error bounds only if it was looked for from the same zones."""
    step = result.steps[-1]
    expected = [step.reaction, step.deflection, step.opening, step.couple, [CONDITIONS[s] for s in step.state]]
    for one in (beam, f77):
        for found, values in zip(one.at_supports(), map(np.array, expected), strict=True):
            np.testing.assert_array_equal(found, values)
    end = nodes_of(scene)[-1]
    x = [0.0, end, *(rng.uniform(0.0, end) for _ in range(3)), *nodes_of(scene)]
    for left in (False, True):
        fields = result.at(np.clip(x, 0.0, result._beam.places.end), side="left" if left else "right")
        for one in (beam, f77):
            for row, name in zip(one.fields(x, left), FIELDS, strict=True):
                values = getattr(fields, name)
                np.testing.assert_array_equal(row, np.zeros(len(x)) if values is None else values)
            for row, k in zip(one.quantities((7, 2, 6), x, left), (7, 2, 6), strict=True):
                values = getattr(fields, QUANTITIES[k])
                np.testing.assert_array_equal(row, np.zeros(len(x)) if values is None else values)
    extremes = result._pairs_of_extremes()
    for one in (beam, f77):
        value, place = one.extremes()
        for k, name in enumerate(FIELDS):
            pairs = extremes.get(name, {"max": (0.0, 0.0), "min": (0.0, 0.0)})
            np.testing.assert_array_equal(np.transpose([value[k], place[k]]), np.array([pairs["max"], pairs["min"]]))
        value, place = one.quantity_extremes((7, 3))
        for k, name in enumerate(("curvature", "shear")):
            np.testing.assert_array_equal(np.transpose([value[k], place[k]]), [extremes[name]["max"], extremes[name]["min"]])
    along = [step.error_bounds[name] for name in ("deflection", "rotation", "moment", "shear")]
    bounds = [bound or 0.0 for bound in (*step.bounds, *along)]
    size = 3 + (len(bounds) if bounds_too else 0)
    residuals = step.residuals
    numbers = [residuals["equilibrium"], residuals["compatibility"], residuals["complementarity"], *bounds]
    certificate, undecided = beam.certificate()
    of_c = [*(getattr(certificate, name) for name, _ in certificate._fields_[1:6]), *certificate.field_bound]
    assert of_c[:size] == numbers[:size]
    assert certificate.known == (step.bounds[0] is not None)
    assert np.flatnonzero(undecided).tolist() == list(step.undecided)
    of_f77, known, undecided_f77 = f77.certificate()
    assert [of_f77.tolist()[:size], known, undecided_f77.tolist()] == [numbers[:size], certificate.known, undecided.tolist()]


def test_quantities_have_the_same_numbers_everywhere(library):
    assert QUANTITIES == QUANTITIES_OF_PYTHON
    header = (TOP / "fortran" / "face" / "gapbeam.h.in").read_text()
    assert int(re.search(r"GAPBEAM_QUANTITIES = (\d+)", header)[1]) == len(QUANTITIES)
    scene = {"beam": {"spans": [4.0], "EI": 1.0}, "supports": [{"node": 0}, {"node": 1}], "loads": [{"type": "uniform", "q": 1.0}]}
    for beam in (library.prepare(scene)[0], F77Beam(library, scene)):
        assert beam.solve(1.0) in (0, (0, ""))
        np.testing.assert_array_equal(beam.quantities(range(len(QUANTITIES)), [2.0])[7], [2.0])
        bad = -4 if isinstance(beam, F77Beam) else 11
        beam.quantities([0, len(QUANTITIES)], [2.0], expect=bad)


@pytest.mark.parametrize("first", range(0, 600, 100))
def test_steps_agree(library, first):
    seen = set()
    for seed in range(first, first + 100):
        scene = scene_of(seed)
        rule, steps = scene["analysis"]["rule"], scene["analysis"]["steps"]
        result = python_result(scene)
        beam, message = library.prepare(scene)
        if isinstance(result, SceneError):
            assert beam == 11, (seed, str(result))
            assert F77Beam(library, scene).info_ < 0
            seen.add(11)
            continue
        assert not message
        f77 = F77Beam(library, scene)
        assert f77.info_ == 0
        solves = []
        for k in range(1, steps + 1):
            status, message = beam.solve(k / steps, rule)
            assert f77.solve(k / steps, rule, start=min(k - 1, 1)) == status
            if status != 0:
                break
            solves.append(beam.info().solves)
        seen.add(status)
        if isinstance(result, EngineError):
            assert message == str(result)
        elif result.status == "no-equilibrium":
            assert status == 1
            for one in (beam, f77):
                x, motion = one.motion()
                if result.motion is None:
                    assert beam.info().slides
                    assert not motion.any()
                else:
                    assert list(zip(x, motion, strict=True)) == result.motion
        else:
            assert status == 0
            assert solves == [step.solves for step in result.steps]
            assert_same_state(beam, f77, result, scene, random.Random(seed))
        beam.close()
    assert {0, 1} <= seen


def test_a_long_beam(library):
    """30,000 spans under loads of all kinds."""
    scene, rng = gapped_spans(30_000), random.Random(5)
    end = nodes_of(scene)[-1]
    for _ in range(100):
        x = rng.uniform(0.0, end)
        scene["loads"] += [{"type": "force", "x": x, "F": 3.0}, {"type": "moment", "x": rng.uniform(0.0, end), "M": -2.0}]
        scene["loads"].append({"type": "linear", "q": [1.0, -3.0], "from": x / 2, "to": x / 2 + 7.0})
    result, beam, f77 = solved_everywhere(library, scene)
    assert_same_state(beam, f77, result, scene, rng)
    beam.close()


@pytest.mark.parametrize("first", range(0, 300, 100))
def test_events_agree(library, first):
    events = 0
    for seed in range(first, first + 100):
        scene = scene_of(seed)
        rule = scene["analysis"]["rule"]
        scene["analysis"] = {"follow": "events", "rule": rule, "first_order": True}
        result = python_result(scene)
        beam, _ = library.prepare(scene)
        if isinstance(result, SceneError):
            continue
        f77 = F77Beam(library, scene)
        status, message, found = beam.follow(1.0, rule)
        info, found_f77 = f77.follow(1.0, rule)
        assert info == status
        if isinstance(result, EngineError):
            assert status > 10
            assert message == str(result)
            continue
        assert (status == 1) == (result.status == "no-equilibrium")
        expected = [(e.factor, e.support, {"opens": 0, "closes": 1, "turns": 3}[e.event]) for e in result.events]
        assert found == expected
        assert found_f77 == expected
        events += len(expected)
        if status == 0:
            assert_same_state(beam, f77, result, scene, random.Random(seed))
        elif result.motion is not None:
            assert list(zip(*beam.motion(), strict=True)) == result.motion
            assert f"load factor {beam.info().factor:.16g}" in result.reason
        beam.close()
    assert events > 10


def assert_same_history(found, path):
    """Everything that a history says."""
    history, (first, last) = path._history, path._history.runs.T
    np.testing.assert_array_equal(found.along.T, [history.along[first, 0], history.along[last, 1]])
    about = history.about[last]
    about[:, 3] = history.about[first, 3]
    np.testing.assert_array_equal(found.about[:, [0, 1, 3, 4, 5]] + [1, 0, 0, 0, 0], about[:, :5])
    assert found.exact == about[:, 5].astype(bool).tolist()
    numbers = numbers_of(path)
    stable = {numbers[k]: segment.stable for k, segment in enumerate(path.segments)}
    assert {k: bool(found.about[k, 2]) for k in stable} == stable
    assert found.events == [(e.factor, e.support, e.event) for e in path.events]
    landings = [int(np.searchsorted(last, to - 1)) if to else -1 for to in history.limits[:, 3]]
    limits = [(a.factor, a.kind, a.leg, to) for a, to in zip(path.limits, landings, strict=True)]
    assert [limit[:4] for limit in found.limits] == limits
    assert all(on or not limit.exact for limit, (*_, on) in zip(path.limits, found.limits, strict=True))
    assert found.ending == path.ending


def numbers_of(path):
    """Number of every segment among the stretches of C and Fortran 77."""
    return [path._history.runs[:, 0].tolist().index(segment.first) for segment in path.segments]


def yield_both_ways(scene):
    """Make laws whose segments get flatter two-way."""
    for one in scene["supports"]:
        law = one.get("law")
        if not law or law[0][0] == 0.0 or "gap" in one or len(law) < 2:
            continue
        points = [[0.0, 0.0], *law]
        slopes = [(b[1] - a[1]) / (b[0] - a[0]) if b[0] > a[0] else math.inf for a, b in itertools.pairwise(points)]
        if all(0.0 <= b <= a for a, b in itertools.pairwise(slopes)):
            one["side"] = "both"


@pytest.mark.parametrize("family", FAMILIES)
def test_laws_agree(library, family):
    """Beams whose supports follow laws: histories and every state on them, or events where no way matters."""
    seen, kinds = set(), set()
    for seed in range(80):
        scene = law_scene(seed, family, alone=None)
        at_limit = ("stop", "jump", "follow")[seed % 3]
        scene["analysis"]["at_limit"] = at_limit
        if family == "plastic" and seed % 4 == 1:
            yield_both_ways(scene)
        if seed % 3 == 0:
            k = seed % len(scene["supports"])
            scene["loads"].append({"type": "movement", "support": k, "value": 0.125 * (seed % 5 - 2)})
        result = python_result(scene)
        beam, message = library.prepare(scene)
        assert not message
        f77 = F77Beam(library, scene)
        assert f77.info_ == 0
        if isinstance(result, EngineError):
            status, message, _ = beam.follow_history(scene["analysis"].get("history", [1.0]), at_limit)
            assert (status > 10, message) == (True, str(result))
        elif isinstance(result.path, BranchPath):
            seen.add(result.path.ending)
            kinds |= {limit.kind for limit in result.limits}
            factors = scene["analysis"].get("history", [1.0])
            status, message, found = beam.follow_history(factors, at_limit)
            info, found_f77 = f77.follow_history(factors, at_limit)
            assert (status, message, info) == (0, "", 0)
            assert_same_history(found, result.path)
            assert_same_history(found_f77, result.path)
            for k, limit in enumerate(result.limits):
                (status, energy), (info, same) = beam.released(k), f77.released(k)
                if limit.leg < 0 or limit.landing is None:
                    assert (status, info) == (11, -3)
                else:
                    assert (status, info) == (0, 0)
                    assert [energy, same] == pytest.approx([limit.released] * 2, rel=1e-14)
            motion = beam.history_motion()
            assert (motion is None) == (result.path.motion is None)
            if motion is not None:
                assert list(zip(*motion, strict=True)) == result.motion
            for step, number in zip(result.steps, numbers_of(result.path), strict=True):
                assert beam.solve_on_path(number, step.factor) == (0, "")
                assert f77.solve_on_path(number, step.factor) == 0
                np.testing.assert_array_equal(beam.at_supports()[0], step.reaction)
            if result.steps:
                assert_same_state(beam, f77, result, scene, random.Random(seed))
        else:
            status, message, found = beam.follow(1.0)
            assert (status, message) == (int(result.status == "no-equilibrium"), "")
            info, found_f77 = f77.follow(1.0)
            assert (info, found_f77) == (status, found)
            assert [(f, k) for f, k, _ in found] == [(e.factor, e.support) for e in result.events]
            for (*_, condition), event in zip(found, result.events, strict=True):
                assert {"opens": condition == 0, "turns": condition == 3}.get(event.event, condition in (1, *range(11, 20)))
            if status == 0:
                assert_same_state(beam, f77, result, scene, random.Random(seed))
            seen.add("events")
        beam.close()
    assert seen & {"events", ""}
    assert family == "hardening" or kinds


def assert_same_ground(beam, f77, result, scene, rng):
    """Where the ground acts, and its pressure."""
    step, end = result.steps[-1], result._beam.places.end
    contact = [(z.foundation, z.from_, z.to, CONDITIONS[z.state], z.resultant) for z in step.contact]
    free = [(f.foundation, f.from_, f.to, f.sag) for f in step.free_spans]
    x = np.clip([0.0, end, *(rng.uniform(0.0, end) for _ in range(4)), *nodes_of(scene)], 0.0, end)
    top, bottom = (result._pairs_of_extremes()["pressure"][key] for key in ("max", "min"))
    for one in (beam, f77):
        assert one.contact() == contact
        assert one.free_spans() == free
        for left in (False, True):
            np.testing.assert_array_equal(one.pressure(x, left), result.at(x, side="left" if left else "right").pressure)
        value, place = one.pressure_extremes()
        assert list(zip(value, place, strict=True)) == [top, bottom]
    return len(contact), len(free)


def test_touches_agree(library):
    scene = {key: value for key, value in touching().items() if key != "units"}
    scene["analysis"] = {"rule": "block", "steps": 1}
    result = gapbeam.solve(scene)
    assert [zone.state for zone in result.steps[-1].contact] == ["touching"]
    beam, _ = library.prepare(scene)
    f77 = F77Beam(library, scene)
    assert (beam.solve(1.0), f77.solve(1.0)) == ((0, ""), 0)
    assert_same_ground(beam, f77, result, scene, random.Random(1))
    beam.close()


@pytest.mark.parametrize("first", range(0, 600, 100))
def test_foundations_agree(library, first):
    """Beams on foundations, also with other loads than they were prepared with."""
    seen, zones, spans = set(), 0, 0
    for seed in range(first, first + 100):
        scene, rule, steps = ground_scene(seed), ("block", "single")[seed % 2], 1 + seed // 2 % 2
        scene.pop("sections", None)
        scene["analysis"] = {"rule": rule, "steps": steps}
        result = python_result(scene)
        # Every third one prepared under other loads, at other places
        before = scene | {"loads": [{"type": "force", "x": 0.0, "F": 1.0}] * len(scene["loads"])} if seed % 3 == 0 else scene
        beam, message = library.prepare(before)
        assert not message
        f77 = F77Beam(library, before)
        assert f77.info_ == 0
        if before is not scene:
            assert (beam.replace_loads(library, scene), f77.replace_loads(scene)) == (0, 0)
        solves = []
        for k in range(1, steps + 1):
            status, message = beam.solve(k / steps, rule)
            assert f77.solve(k / steps, rule, start=min(k - 1, 1)) == status
            if status != 0:
                break
            solves.append(beam.info().solves)
        seen.add(status)
        if isinstance(result, EngineError):
            assert (status > 10, message) == (True, str(result))
        elif result.status == "no-equilibrium":
            assert status == 1
            for one in (beam, f77):
                assert list(zip(*one.motion(), strict=True)) == result.motion
        else:
            assert (status, solves) == (0, [step.solves for step in result.steps])
            assert_same_state(beam, f77, result, scene, random.Random(seed))
            found = assert_same_ground(beam, f77, result, scene, random.Random(seed))
            zones, spans = zones + found[0], spans + found[1]
            assert beam.follow(1.0)[:2] == (11, "the beam has a foundation: use follow_ground")
            assert f77.follow(1.0)[0] == -1
            status, message = beam.follow_history([1.0], "stop")[:2]
            assert status == 0 or (status, "a history" in message) == (11, True)
        beam.close()
    assert {0, 1} <= seen
    assert min(zones, spans) > 50


def test_tables_of_foundations_agree(library):
    """Of moduli and of parameters of laws."""
    solved = 0
    for seed in range(40):
        scene = {"supports": [], **random_tabled_scene(seed), "analysis": {"rule": "block", "steps": 1}}
        if any(isinstance(item.get("law"), list) and isinstance(item["law"][0], dict) for item in scene["foundation"]):
            continue  # polylines at several places are in Python and Fortran only
        scene.pop("sections", None)
        beam, message = library.prepare(scene)
        f77 = F77Beam(library, scene)
        try:
            result = python_result(scene)
        except gapbeam.SceneError:
            assert message
            assert f77.info_ < 0
            continue
        assert not message
        status = {"solved": 0, "no-equilibrium": 1}[result.status]
        assert (beam.solve(1.0)[0], f77.solve(1.0)) == (status, status)
        if status == 0:
            solved += 1
            zones = result.steps[-1].contact
            contact = [(z.foundation, z.from_, z.to, CONDITIONS[z.state], z.resultant) for z in zones]
            assert beam.contact() == f77.contact() == contact
        beam.close()
    assert solved > 20


def stands_alike_on_ground(library, scene, seed, path=None):
    """A beam on ground in every language: its state, if it stands, and the status with which its load path is refused, if it is."""
    scene = scene | {"analysis": {"rule": "block", "steps": 1}}
    result = python_result(scene)
    beam, message = library.prepare(scene)
    assert not message
    f77 = F77Beam(library, scene)
    assert f77.info_ == 0
    status = {"solved": 0, "no-equilibrium": 1}[result.status]
    assert (beam.solve(1.0)[0], f77.solve(1.0)) == (status, status)
    if status == 0:
        assert_same_state(beam, f77, result, scene, random.Random(seed))
        assert_same_ground(beam, f77, result, scene, random.Random(seed))
        if path is not None:
            assert beam.follow_ground(1.0)[0] == path
    beam.close()
    return status == 0


def test_laws_of_foundations_by_parameters_agree(library):
    """Curves too, with numbers and with pairs."""
    for seed in (1, 3, 5, 7, 9, 11, 12, 18, 21, 26, 28, 35):
        stands_alike_on_ground(library, {"supports": [], **random_curved_scene(seed)}, seed)


def test_rigid_ground_agrees(library):
    """Zones and point forces, also where a beam cannot stand."""
    assert sum(stands_alike_on_ground(library, rigid_scene(seed), seed, path=11) for seed in range(30)) > 20


@pytest.mark.parametrize("drawn", [ground_scene, random_moving_scene])
def test_load_paths_on_foundations_agree(library, drawn):
    """Events of zones and supports along the load, and the state at its end; also where loads move supports and ground."""
    found = []
    for seed in range(22):
        scene, rule = drawn(seed), ("block", "single")[seed % 2]
        scene.pop("sections", None)
        scene["analysis"] = {"rule": rule, "follow": "events"}
        result = python_result(scene)
        beam, _ = library.prepare(scene)
        f77 = F77Beam(library, scene)
        status, events = beam.follow_ground(1.0, rule)
        info, same = f77.follow_ground(1.0, rule)
        assert (info, same) == (status, events)
        if isinstance(result, EngineError):
            assert status > 10
        else:
            assert status == (0 if result.status == "solved" else 1)
            names = [(f, k, g, x, EVENTS[change], branch) for f, k, g, x, change, branch in events]
            assert names == [
                (e.factor, *(-1 if number is None else number for number in (e.support, e.foundation)), e.x, e.event, e.branch)
                for e in result.events
            ]
            found += events
            if status == 0:
                assert_same_state(beam, f77, result, scene, random.Random(seed), bounds_too=False)
        beam.close()
    changes = {change for *_, change, _ in found}
    assert changes >= {0, 1, 20, 21}
    assert changes & {24, 25}


NAMED = [
    {"type": "tanh", "stiffness": 4e3, "limit": 36.0}, {"type": "hyperbolic", "stiffness": 900.0, "limit": 20.0},
    {"type": "cubic", "k1": 400.0, "k2": -1e3, "k3": 1e5}, {"type": "power", "d0": 0.01, "limit": 30.0, "n": 0.4},
    {"type": "power", "d0": 0.01, "limit": 30.0, "n": 2.0}, {"type": "plastic", "stiffness": 4e3, "limit": 6.0},
    {"type": "hardening", "stiffness": 400.0, "limit": 20.0, "slope": 4e3},
]  # fmt: skip
SMOOTH = {"tanh", "hyperbolic", "cubic", "power"}


@pytest.mark.parametrize("seed", range(12))
def test_laws_of_supports_by_name_agree(library, seed):
    """Curves are met with the same digits, and so are the events on them."""
    rng = np.random.default_rng(seed)
    sides = rng.choice(["both", "below", "above"], size=6).tolist()
    supports = [
        {"x": 2.0*k + 1, "side": side, "law": NAMED[int(rng.integers(len(NAMED)))], "settlement": float(rng.choice([0.0, 1e-3]))}
        | ({} if side == "both" else {"gap": float(rng.choice([0.0, 0.002]))})
        for k, side in enumerate(sides)
    ]
    scene = {
        "beam": {"spans": [6.0, 6.0], "EI": 3e3}, "supports": [{"node": 0}, {"node": 2}, *supports],
        "loads": [{"type": "uniform", "q": float(rng.uniform(-20, 20)), "from": 0.0, "to": 12.0}],
    }  # fmt: skip
    beam, message = library.prepare(scene)
    assert message == ""
    f77 = F77Beam(library, scene)
    assert f77.info_ == 0
    assert beam.solve(1.0)[0] == f77.solve(1.0) == 0
    step = gapbeam.solve(scene).steps[-1]
    for one in (beam, f77):
        reaction, deflection, opening, *_ = one.at_supports()
        np.testing.assert_array_equal([reaction, deflection, opening], [step.reaction, step.deflection, step.opening])
    path = python_result({**scene, "analysis": {"follow": "events"}})
    (status, message, events), (info, same) = beam.follow(1.0), f77.follow(1.0)
    if isinstance(path, EngineError):
        assert status > 10
        assert info > 10
        assert message in str(path)
        return
    assert (status, info) == (0, 0)
    assert events == same
    assert [(factor, k) for factor, k, _ in events] == [(event.factor, event.support) for event in path.events]
    smooth = {k for k, support in enumerate(scene["supports"]) if support.get("law", {}).get("type") in SMOOTH}
    assert {state for _, k, state in events if k in smooth} <= {0, 3, 11}


def test_curves_of_supports_on_foundations_agree(library):
    """In C as in Python: states and events; Fortran 77 takes laws by name without foundations only."""
    curves, events = [law for law in NAMED if law["type"] in SMOOTH], 0
    for seed in range(22):
        scene = ground_scene(seed) | {"analysis": {"follow": "events"}}
        scene.pop("sections", None)
        for k, support in enumerate(scene["supports"]):
            if (k + seed) % 2 and "law" not in support:
                support.pop("stiffness", None)
                support["law"] = curves[(k + seed) % len(curves)]
        result = python_result(scene)
        beam, message = library.prepare(scene)
        assert message == ""
        status, found = beam.follow_ground(1.0, "block")
        assert not isinstance(result, EngineError)
        assert status == (0 if result.status == "solved" else 1)
        assert [(f, k) for f, k, *_ in found] == [(e.factor, -1 if e.support is None else e.support) for e in result.events]
        events += len(found)
        if status == 0:
            np.testing.assert_allclose(beam.at_supports()[0], result.steps[-1].reaction, rtol=1e-12, atol=1e-12)
        beam.close()
    assert events > 10


def soft_scene(seed):
    """Supports with cubics whose forces fall, beside others, and load factors in turn."""
    rng = np.random.default_rng(seed)
    supports, total = [{"node": 0}, {"node": 2}], 0.0
    for x in (1.0, 2.5, 4.0)[: int(rng.integers(1, 4))]:
        size, k1 = float(rng.choice([0.01, 0.03])), float(rng.uniform(100.0, 3e3))
        law = {"type": "cubic", "k1": k1, "k2": -float(rng.uniform(1.6, 1.99)) * k1 / size, "k3": k1 / size**2}
        total += k1 * size
        supports.append({"x": x, "side": str(rng.choice(["below", "both"])), "law": law})
    other = [{"law": NAMED[0]}, {"law": {"type": "brittle", "stiffness": 500.0, "limit": 4.0}}, {"stiffness": 50.0, "gap": 0.02},
             {"law": {"type": "plastic", "stiffness": 500.0, "limit": 4.0}, "unloading": "plastic"}]  # fmt: skip
    supports.append({"x": 3.0, "side": "below", **other[seed % 4]})
    history = [[1.0], [1.0, 0.0], [0.6, -0.3, 1.0], [1.0, 0.0, 0.8]][int(rng.integers(4))]
    return {
        "beam": {"spans": [2.0, 3.0], "EI": float(rng.choice([10.0, 100.0]))}, "supports": supports,
        "loads": [
            {"type": "force", "x": 2.0, "F": total * float(rng.uniform(0.5, 1.5))}, {"type": "uniform", "q": 0.5, "case": "dead"},
        ],
        "analysis": {"follow": "events", "at_limit": ("stop", "jump", "follow")[seed % 3], "history": history},
    }  # fmt: skip


@pytest.mark.parametrize("ground", [[], [{"k": 20.0}]])
def test_turned_supports_and_loads_along_the_beam_agree(library, ground):
    """From C and Fortran 77, elastic and rigid ones, dead and live, beside couples at a hinge, on ground as well."""
    scene = {
        "beam": {"spans": [3.0, 2.0], "EI": 80.0, "EA": 300.0, "hinges": [4.0]},
        "supports": [{"node": 0, "rotation": "fixed"}, {"node": 1, "side": "below"}, {"node": 2, "rotation": 40.0},
                     {"node": 0, "direction": "axial"}, {"node": 2, "direction": "axial", "stiffness": 50.0}],
        "loads": [{"type": "movement", "support": 0, "rotation": 0.02}, {"type": "uniform", "q": 1.0, "case": "dead"},
                  {"type": "movement", "support": 2, "rotation": -0.01, "case": "dead"},
                  {"type": "axial_uniform", "q": 1.5, "from": 0.5, "to": 4.5},
                  *({"type": "moment", "x": 4.0, "M": 0.7, "at_hinge": side} for side in ("left", "right"))],
        "foundation": ground,
    }  # fmt: skip
    result, beam, f77 = solved_everywhere(library, scene)
    for one in (beam, f77):
        np.testing.assert_array_equal(one.at_supports()[0], result.steps[-1].reaction)
    assert result.steps[-1].reaction[3:].sum() == pytest.approx(-6.0, rel=1e-14)


def states_on_history(library, scene):
    """Follow the history of a scene, or of an example by its name, in all languages: the same events, and every state of each."""
    if isinstance(scene, str):
        scene = tomllib.loads((TOP / "examples" / f"{scene}.toml").read_text())
    result = python_result(scene)
    beam, message = library.prepare(scene)
    assert not message
    f77 = F77Beam(library, scene)
    assert f77.info_ == 0
    history = scene["analysis"]["history"]
    status, message, found = beam.follow_history(history, "stop")
    info, found_f77 = f77.follow_history(history, "stop")
    assert (status, message, info) == (0, "", 0)
    assert_same_history(found, result.path)
    assert_same_history(found_f77, result.path)
    for step, number in zip(result.steps, numbers_of(result.path), strict=True):
        assert beam.solve_on_path(number, step.factor) == (0, "")
        assert f77.solve_on_path(number, step.factor) == 0
        yield step, beam, f77


def test_friction_agrees(library):
    """Links along the beam: events, states of supports, forces and slips of friction have the digits of Python."""
    for step, *beams in states_on_history(library, "pipe_rack_hot"):
        ways = [{"left": -1, "right": 1}.get(way, 0) for way in step.sliding]
        for one in beams:
            np.testing.assert_array_equal(one.at_supports()[0], step.reaction)
            for values, expected in zip(one.friction(), (step.friction, step.slip, ways), strict=True):
                np.testing.assert_array_equal(values, expected)
    assert step.friction.any()


@pytest.mark.parametrize("changes", [
    {"sections": [{"from": 1.0, "to": 3.0, "EI": [80.0, 20.0]}, {"from": 3.0, "EI": {"from": 20.0, "to": 90.0, "power": 3},
                                                                  "GA": [40.0, 90.0]}]},
    {"sections": [{"from": 2.0, "to": 4.0, "EI": 30.0, "N": -1.0}, {"to": 2.0, "EI": {"from": 90.0, "to": 20.0, "power": 2}}],
     "masses": [{"x": 2.0, "mass": 0.3}], "beam": {"spans": [3.0, 2.0], "EI": 80.0, "N": 2.0, "mass": 0.1}},
    {"sections": [{"from": 1.0, "to": 4.0, "EI": [80.0, 20.0]}], "foundation": [{"k": 9.0, "side": "below"}]},
])  # fmt: skip
def test_sections_agree(library, changes):
    """Steps, tapers, axial forces of sections: reactions have the digits of Python."""
    scene = {
        "beam": {"spans": [3.0, 2.0], "EI": 80.0}, "supports": [{"node": 0}, {"node": 1, "side": "below"}, {"node": 2}],
        "loads": [{"type": "uniform", "q": 1.0}, {"type": "force", "x": 4.0, "F": 3.0}], **changes,
    }  # fmt: skip
    result, beam, f77 = solved_everywhere(library, scene)
    for one in (beam, f77):
        np.testing.assert_array_equal(one.at_supports()[0], result.steps[-1].reaction)
    wrong = scene | {"sections": [*scene["sections"], {"from": 0.0, "to": 1.0, "EI": [1.0, -3.0]}]}
    assert "number above 0" in library.prepare(wrong)[1]
    f77 = F77Beam(library, wrong)
    assert (f77.info_, f77.entry[0]) == (-36, len(wrong["sections"]))


@pytest.mark.parametrize("ground", [
    [{"limit": 0.05}, {"from": 40.0, "limit": 0.02}],
    [{"stiffness": 40.0, "limit": 0.05}, {"from": 40.0, "stiffness": 9.0, "limit": [0.05, 0.01]}],
])  # fmt: skip
def test_ground_along_the_beam_agrees(library, ground):
    """A pipe that is heated, cooled and pulled slips in its ground: events and states have the digits of Python."""
    scene = {
        "beam": {"spans": [40.0, 20.0], "EI": 10.0, "EA": 2000.0, "alpha": 1e-5},
        "supports": [*({"node": k} for k in range(3)), {"node": 0, "direction": "axial", "stiffness": 5.0}],
        "loads": [{"type": "temperature", "dT": 50.0, "to": 40.0}, {"type": "axial", "node": 2, "F": 0.4}],
        "axial_ground": ground,
        "analysis": {"history": [1.0, -0.5], "follow": "events", "first_order": True},
    }  # fmt: skip
    for step, *beams in states_on_history(library, scene):
        for one in beams:
            np.testing.assert_array_equal(one.at_supports()[0], step.reaction)
        assert step.slip_zones
        assert step.reaction[-1]


def test_a_pile_in_ground_across_and_along_it_agrees(library):
    """On a foundation there is no path: states and fields have the digits of Python; what is pulled out slides."""
    scene = {
        "beam": {"spans": [20.0], "EI": 1e5, "EA": 8e6}, "supports": [{"node": 1, "direction": "axial", "stiffness": 5e4}],
        "foundation": [{"k": [0.0, 4e4], "side": "both"}], "axial_ground": [{"stiffness": 2e4, "limit": [20.0, 100.0]}],
        "loads": [{"type": "axial", "node": 0, "F": 1000.0}, {"type": "force", "node": 0, "F": 100.0},
                  {"type": "axial_uniform", "q": 5.0, "case": "dead"}],
        "analysis": {"first_order": True},
    }  # fmt: skip
    result, beam, f77 = solved_everywhere(library, scene)
    assert_same_state(beam, f77, result, scene, random.Random(1))
    scene |= {"supports": [], "loads": [{"type": "axial", "node": 0, "F": 2000.0}]}
    assert library.prepare(scene)[0].solve(1.0)[0] == 1


def test_restraints_and_hinges_with_laws_agree(library):
    """Supports that hold rotations, along a history: events, couples, rotations and fields have the digits of Python."""
    states = []
    for step, *beams in states_on_history(library, "yielding_joints"):
        for one in beams:
            expected = step.reaction, step.deflection, step.opening, step.couple
            for values, known in zip(one.at_supports()[:4], expected, strict=True):
                np.testing.assert_array_equal(values, known)
        states.append(set(step.state))
    assert states[1] == {"bilateral", "branch 1", "branch 2"}


@pytest.mark.parametrize("hinge", [{}, {"stiffness": 30.0}, {"slack": 0.01}])
@pytest.mark.parametrize("side", ["left", "right"])
def test_supports_and_couples_at_hinges_agree(library, side, hinge):
    """Rigid, elastic and with a law, left and right of free hinges and others, beside a couple."""
    law = {"law": [[0.02, 1.0], [0.2, 1.5]]}
    for rotation, ground in (("fixed", []), (40.0, []), (law, []), (law, [{"k": 20.0, "side": "below"}])):
        scene = {
            "beam": {"spans": [3.0, 2.0], "EI": 80.0, "hinges": [] if hinge else [3.0]},
            "hinges": [{"x": 3.0, **hinge}] if hinge else [],
            "supports": [{"node": 0, "rotation": "fixed"}, {"node": 2},
                         {"node": 1, "side": "below", "gap": 0.001, "rotation": rotation, "at_hinge": side}],
            "loads": [{"type": "uniform", "q": 1.0},
                      {"type": "moment", "x": 3.0, "M": 0.7, "at_hinge": "right"}],
            "foundation": ground,
        }  # fmt: skip
        result, beam, f77 = solved_everywhere(library, scene)
        step = result.steps[-1]
        for one in (beam, f77):
            expected = step.reaction, step.deflection, step.opening, step.couple
            for values, known in zip(one.at_supports()[:4], expected, strict=True):
                np.testing.assert_array_equal(values, known)
        assert abs(step.couple[2]) > 0.0


@pytest.mark.parametrize("ground", [[], [{"k": 20.0, "side": "below"}]])
def test_curvatures_that_change_agree(library, ground):
    scene = {
        "beam": {"spans": [3.0, 2.0], "EI": 80.0, "GA": 50.0},
        "supports": [{"node": 0, "rotation": "fixed"}, {"node": 1, "side": "below"}, {"node": 2}],
        "loads": [{"type": "curvature", "from": 0.5, "to": 4.0, "kappa": [0.01, -0.03]}, {"type": "uniform", "q": 1.0}],
        "foundation": ground,
    }  # fmt: skip
    result, beam, f77 = solved_everywhere(library, scene)
    for one in (beam, f77):
        np.testing.assert_array_equal(one.at_supports()[0], result.steps[-1].reaction)


def test_histories_on_curves_agree(library):
    """Paths past limit points, whole histories, their states and energies have the digits of Python."""
    kinds, rough, events, refused = set(), 0, 0, 0
    for seed in (11, 14, 16, 18, 21, 22, 44):  # others take long
        scene = soft_scene(seed)
        result = python_result(scene)
        beam, message = library.prepare(scene)
        assert not message
        f77 = F77Beam(library, scene)
        status, message, found = beam.follow_history(scene["analysis"]["history"], scene["analysis"]["at_limit"])
        info, found_f77 = f77.follow_history(scene["analysis"]["history"], scene["analysis"]["at_limit"])
        if isinstance(result, EngineError):
            refused += 1
            assert status > 10 or "the path leads to a reaction" in str(result)
            assert status < 10 or message in str(result)
            continue
        assert (status, message, info) == (0, "", 0), seed
        assert_same_history(found, result.path)
        assert_same_history(found_f77, result.path)
        for k, limit in enumerate(result.limits):
            kinds.add((limit.kind, limit.exact))
            if limit.leg >= 0 and limit.landing is not None:
                assert [*beam.released(k), *f77.released(k)] == [0, limit.released] * 2
        events += len(result.events)
        for step, segment, number in zip(result.steps, result.path.segments, numbers_of(result.path), strict=True):
            assert (step.exact, segment.exact) == (found.exact[number],) * 2
            there = [step.factor, 0.3 * segment.start + 0.7 * segment.stop]
            for factor in there:
                state = result.path.step(segment, factor)
                status, message = beam.solve_on_path(number, factor)
                if not state.exact:
                    assert (status, f77.solve_on_path(number, factor)) == (13, 13)
                    assert "is known on the polylines of the smooth laws only" in message
                    rough += 1
                    continue
                assert (status, message, f77.solve_on_path(number, factor)) == (0, "", 0), seed
                for one in (beam, f77):
                    reaction, deflection, *_ = one.at_supports()
                    np.testing.assert_array_equal([reaction, deflection], [state.reaction, state.deflection])
        beam.close()
    assert ("limit", True) in kinds
    assert rough > 0
    assert events > 20
    assert refused < 15


def test_wrong_laws_of_supports_by_name_are_refused(library):
    scene = {"beam": {"spans": [6.0], "EI": 3e3}, "supports": [{"node": 0}, {"node": 1, "law": NAMED[0]}], "loads": []}
    for key, value, words in (
        ("limit", 0.0, "law.limit: expected a finite number above 0, got 0"),
        ("stiffness", np.inf, "law.stiffness: expected a finite number above 0"),
    ):
        scene["supports"][1]["law"] = NAMED[0] | {key: value}
        assert words in library.prepare(scene)[1]
        f77 = F77Beam(library, scene)
        assert (f77.info_, f77.entry[0]) == (-16, 2)
