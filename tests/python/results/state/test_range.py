"""The range of double precision: any units will do, what does not fit is refused by name, and every result is a number."""

import json
import math
import random

import gapbeam
import numpy as np
import pytest
from gapbeam.base.errors import EngineError, SceneError, Status
from gapbeam.report import report_text
from languages.clibrary import F77Beam
from scenes import at, curvature, force, moment, nodes_of, random_scene, scene, stretch, uniform
from scenes.extreme import POWERS, extreme_scene, in_units

FIELDS = ("deflection", "rotation", "moment", "shear")
NOT_FINITE = Status.NOT_FINITE
CONDITIONS = {"open": 0, "closed": 1, "bilateral": 2}


def simple(spans=(6.0,), supports=None, loads=None, **beam):
    """A simple beam under a uniform load, or what is given instead."""
    supports = [at(i) for i in range(len(spans) + 1)] if supports is None else supports
    return scene(spans, supports, [uniform(1.0)] if loads is None else loads, **{"EI": 1e4, **beam})


@pytest.mark.parametrize("seed", range(150))
def test_every_unit_has_the_same_digits(seed):
    """Units of length, force and deflection up to 2^300: every result is the same number in other units."""
    rng = random.Random(seed)
    made = random_scene(rng)
    units = [rng.randint(-300, 300) for _ in range(3)]
    try:
        other = in_units(made, *units)
    except OverflowError:
        pytest.skip("a number of the scene does not fit")
    here = gapbeam.solve(made)
    there = gapbeam.solve(other)
    assert there.status == here.status
    if here.status != "solved":
        assert [w for _, w in there.motion] == [w for _, w in here.motion]
        return
    length, strength, way = units
    for a, b in zip(here.steps, there.steps, strict=True):
        assert b.state == a.state
        assert b.undecided == a.undecided
        for name, power in (("reaction", strength), ("deflection", way), ("opening", way), ("couple", strength + length)):
            np.testing.assert_array_equal(getattr(b, name), np.ldexp(getattr(a, name), power))
        assert b.bounds == (None if a.bounds[0] is None else math.ldexp(a.bounds[0], way), math.ldexp(a.bounds[1], strength))
    x = np.linspace(0.0, here._beam.places.end, 23)
    fields, others = here.at(x), there.at(np.ldexp(x, length))
    extremes, far = here._pairs_of_extremes(), there._pairs_of_extremes()
    for name, power in zip(FIELDS, (way, way - length, strength + length, strength), strict=True):
        np.testing.assert_array_equal(getattr(others, name), np.ldexp(getattr(fields, name), power))
        for which in ("max", "min"):
            value, place = extremes[name][which]
            assert far[name][which] == (math.ldexp(value, power), math.ldexp(place, length))


def test_axial_system_in_any_units():
    supports = [at(0), at(1), at(0, direction="axial", settlement=2e-3), at(1, direction="axial", stiffness=5.0)]
    loads = [{"type": "axial", "x": 2.0, "F": 3.0}]
    meant = {"first_order": True}
    here = gapbeam.solve(scene([6.0], supports, loads, EI=1.0, EA=7.0, analysis=meant))
    for strength, way in ((-900, 0), (900, 0), (0, -1000), (-600, -600), (400, 800)):
        made = scene([6.0], [dict(s) for s in supports], [{**loads[0], "F": math.ldexp(3.0, strength)}], EI=1.0,
                     analysis=meant)  # fmt: skip
        made["beam"]["EA"] = math.ldexp(7.0, strength - way)
        made["supports"][2]["settlement"] = math.ldexp(2e-3, way)
        made["supports"][3]["stiffness"] = math.ldexp(5.0, strength - way)
        there = gapbeam.solve(made)
        np.testing.assert_array_equal(there.steps[0].reaction, np.ldexp(here.steps[0].reaction, strength))
        np.testing.assert_array_equal(there.steps[0].deflection, np.ldexp(here.steps[0].deflection, way))
        for x in (0.5, 2.0, 4.0):
            assert there.at(x).axial_force == math.ldexp(here.at(x).axial_force, strength)
            assert there.at(x).axial_displacement == math.ldexp(here.at(x).axial_displacement, way)
        assert there.extremes["axial_force"]["max"].value == math.ldexp(here.extremes["axial_force"]["max"].value, strength)


@pytest.mark.parametrize(
    ("EI", "q"),
    [
        *((1e-310, 1e-312), (5e-324, 5e-324), (1e-310, 1e-320), (1e308, 1.0)),
        *((1.7e308, 1e300), (1e300, 1e-10), (1.0, 1e-310), (1.0, 1e300)),
    ],
)
def test_numbers_at_the_ends_of_the_range(library, EI, q):
    made = simple(EI=EI, loads=[uniform(q)])
    result = gapbeam.solve(made)
    beam, _ = library.prepare(made)
    assert beam.solve(1.0) == (0, "")
    # The loads themselves may have few digits; what follows from them is as exact as a double can say it
    assert result.steps[0].reaction == pytest.approx(3.0 * q, rel=1e-15)
    assert result.at(3.0).moment == pytest.approx(4.5 * q, rel=1e-15)
    expected = math.ldexp(16.875, math.frexp(q)[1] - math.frexp(EI)[1]) * math.frexp(q)[0] / math.frexp(EI)[0]
    assert result.at(3.0).deflection == pytest.approx(expected, rel=1e-15, abs=5e-324)
    assert beam.fields([3.0])[0] == result.at(3.0).deflection
    beam.close()


REFUSED = [
    (simple([5e-324, 6.0], supports=[at(0), at(1), at(2)]), "the length of the stretch from x = 0 to x = 4.94065645841247e-324"),
    (simple([6.0, 1e300], EI=1e4, loads=[force(3.0, 1.0)]), "the length of the stretch from x = 6 to x = 1e+300"),
    (simple([6.0, 6.0], EI=[1e308, 1e-308]), "EI = 1e+308 from x = 0 to x = 6"),
    (simple(GA=1e-320), "GA = 9.99988867182683e-321 from x = 0 to x = 6"),
    (simple(supports=[at(0), at(1, stiffness=5e-324)]), "supports[1].stiffness = 4.94065645841247e-324"),
    (simple(EI=1e-30, supports=[at(0), at(1), at(x=3.0, stiffness=1.7e308)]), "supports[2].stiffness = 1.7e+308"),
    (simple(EI=1e-10, supports=[at(0, rotation=1.7e308), at(1)]), "rotation = 1.7e+308 of the supports at x = 0"),
    (simple(supports=[at(0, stiffness=1.0, rotation=1.7e308), at(0, rotation=1.7e308), at(1)]), "rotations of supports[1]"),
    (simple(loads=[force(3.0, 1.7e308)] * 2), "the loads from x = 0 to x = 3 are too great together"),
    (simple(supports=[at(0), at(1), at(2)], spans=[3.0, 3.0], loads=[force(3.0, 1e308)] * 2), "the loads at x = 3 are too great"),
    (
        simple(supports=[at(0), at(1), at(x=3.0, side="below", gap=1e308, settlement=1e308)]),
        "supports[2] acts at a deflection of inf",
    ),
    (simple(loads=[force(3.0, 1.7e308), uniform(5e307)]), "the reaction of the support at x = 0 is too great"),
    (simple(supports=[at(0, rotation="fixed")], loads=[force(6.0, 1e308)], EI=1e308), "the moment at x = 0 is too great"),
    (simple(supports=[at(0, rotation="fixed")], EI=1e-307), "the deflection at x = 6 is too great"),
    (simple(supports=[at(0), at(1), at(0, direction="axial")], EA=1e-320, loads=[{"type": "axial", "node": 1, "F": 1.0}]),
     "the axial displacement at x = 6 is too great"),
    (simple([6.0, 6.0], supports=[at(0), at(2), at(0, direction="axial")], EA=[1e308, 1e-308],
            loads=[{"type": "axial", "node": 1, "F": 1.0}]), "EA = 1e-308 from x = 6 to x = 12"),
    (simple(supports=[at(0), at(1), at(0, direction="axial", stiffness=5e-324)], EA=1.0,
            loads=[{"type": "axial", "node": 1, "F": 1.0}]), "supports[2].stiffness = 4.94065645841247e-324"),
]  # fmt: skip


@pytest.mark.parametrize(("made", "what"), REFUSED)
def test_what_does_not_fit_is_refused_by_name(library, made, what):
    with pytest.raises(EngineError) as caught:
        gapbeam.solve(made)
    assert caught.value.status == NOT_FINITE
    assert str(caught.value).startswith("numbers left the range of double precision: ")
    assert what in str(caught.value)
    beam, message = library.prepare(made)
    f77 = F77Beam(library, made)
    status, info = beam, f77.info_
    if not isinstance(beam, int):
        (status, message), info = beam.solve(1.0), f77.solve(1.0)
        beam.close()
    assert status == NOT_FINITE
    assert info == NOT_FINITE
    word = what.partition(" = ")[0].partition("[")[0].removesuffix("s")
    assert word in message


FIELDS_REFUSED = [
    (simple([1e308], EI=1.0, loads=[curvature(1e-3)]), "deflection"),
    (simple([1e100], EI=1.0, loads=[uniform(1e-50)]), "deflection"),
    (simple([1e200], EI=math.inf, GA=math.inf, loads=[uniform(1e-50)]), "moment"),
    (simple([1e-200], EI=1e-300, loads=[moment(1e-200, 1e210)], supports=[at(0, rotation="fixed")]), "rotation|curvature"),
]


@pytest.mark.parametrize(("made", "name"), FIELDS_REFUSED)
def test_fields_too_great_are_refused_by_name(library, made, name):
    """At the supports nothing is too great: the scene is solved, and the field is refused where it is asked for."""
    result = gapbeam.solve(made)
    assert result.status == "solved"
    middle = result._beam.places.end / 2
    beam, _ = library.prepare(made)
    f77 = F77Beam(library, made)
    assert beam.solve(1.0)[0] == f77.solve(1.0) == 0
    for asked in (lambda: result.at(middle), result.extremes, result.fields, result.to_dict):
        with pytest.raises(EngineError, match=f"the ({name}) at x = .* is too great") as caught:
            asked()
        assert caught.value.status == NOT_FINITE
    for one in (beam, f77):
        assert np.isnan(one.fields([0.0, middle], expect=NOT_FINITE)).all()  # nothing is written then
        one.extremes(expect=NOT_FINITE)
    if "curvature" in name:  # of a short beam it is greater than rotation and deflection, and Python asks for all
        assert np.isfinite(beam.fields([0.0])).all()
    else:
        assert np.isfinite(result.at(0.0).deflection)
    beam.close()


def outcome(made):
    """Status and result of a scene."""
    try:
        result = gapbeam.solve(made)
    except SceneError:
        return Status.BAD_INPUT, None
    except EngineError as error:
        return error.status, None
    return (0, result) if result.status == "solved" else (1, result)


@pytest.mark.parametrize("decades", [3, 10, 30, 100, 300])
def test_extreme_scenes_are_finite_or_refused_everywhere(library, decades):
    """Scenes of any magnitudes: Python, C and Fortran 77 say the same, and all numbers of what is solved are numbers."""
    seen = set()
    for seed in range(80):
        rng = random.Random(f"{decades} {seed}")
        made = extreme_scene(rng, decades)
        status, result = outcome(made)
        seen.add(status)
        beam, _ = library.prepare(made)
        f77 = F77Beam(library, made)
        if isinstance(beam, int):
            assert (beam, f77.info_ < 0 or f77.info_) == (status, status == Status.BAD_INPUT or status), seed
            continue
        steps = made["analysis"]["steps"]
        for k in range(1, steps + 1):
            found = beam.solve(k / steps)[0]
            assert f77.solve(k / steps, start=min(k - 1, 1)) == found
            if found:
                break
        assert found == status, seed
        if status == 0:
            assert_finite_and_equal(made, result, beam, f77, seed)
        beam.close()
    assert {0, 1} <= seen
    assert (NOT_FINITE in seen) == (decades >= 100)


def gives_no_fields(result):
    """Are some fields of a result too great; if not, all its data are numbers."""
    try:
        result._pairs_of_extremes()
        json.dumps(result.to_dict(), allow_nan=False)
    except EngineError as error:
        return error.status == NOT_FINITE
    return False


def assert_finite_and_equal(made, result, beam, f77, seed):
    """All that a result says."""
    for step in result.steps:
        values = [step.reaction, step.deflection, step.opening, step.couple]
        assert np.isfinite(values).all(), seed
        json.dumps(step.certificate, allow_nan=False)
    axial = np.array([support.get("direction") == "axial" for support in made["supports"]])
    values = np.array([*values, [CONDITIONS[state] for state in step.state]])
    for one in (beam, f77):
        np.testing.assert_array_equal(np.array(one.at_supports())[:, ~axial], values[:, ~axial])
    end = result._beam.places.end
    x = np.clip(np.concatenate((nodes_of(made), np.linspace(0.0, 1.0, 9) * end)), 0.0, end)
    if gives_no_fields(result):
        return
    fields = [getattr(result.at(x), name) for name in FIELDS]
    assert np.isfinite(fields).all(), seed
    for one in (beam, f77):
        np.testing.assert_array_equal(one.fields(x)[:4], fields)


def test_cases_are_refused_one_by_one():
    made = simple([6.0, 6.0], EI=1e-300, loads=[uniform(1e-300), force(3.0, 1e-300)], supports=[at(0, rotation="fixed"), at(1)])
    beam = gapbeam.prepare(made)
    cases = beam.solve([[1.0, 1.0], [1e307, 1e300], [0.0, 1e308], [1.0, 2.0]])
    assert cases.status.tolist() == [0, NOT_FINITE, NOT_FINITE, 0]
    assert np.isnan(cases.deflection[1:3]).all()
    assert np.isfinite(cases.deflection[[0, 3]]).all()
    assert not cases.closed[1:3].any()
    for row, factors in ((0, [1.0, 1.0]), (3, [1.0, 2.0])):
        assert cases.reaction[row] == pytest.approx(beam.result(factors).steps[0].reaction, rel=1e-13)
    with pytest.raises(EngineError) as caught:
        beam.result([1e307, 1e300])
    assert caught.value.status == NOT_FINITE


def test_other_loads_have_other_units(library):
    """Loads that are replaced by others far from them, and by some that do not fit: then the old ones stay."""
    supports = [at(0), at(1, side="below", gap=1e-3), at(2)]
    ordinary, small, great, wrong = (
        simple([6.0, 6.0], supports, [uniform(q), force(4.0, F), force(4.0, F)])
        for q, F in ((3.0, 9.0), (3e-300, 9e-300), (3e303, 9e300), (3.0, 1.7e308))
    )
    beam, _ = library.prepare(ordinary)
    for made in (small, ordinary, great, wrong, ordinary):
        status = beam.replace_loads(library, made)
        expected = great if made is wrong else made
        assert status == (NOT_FINITE if made is wrong else 0)
        assert beam.solve(1.0) == (0, "")
        step = gapbeam.solve(expected).steps[0]
        np.testing.assert_array_equal(beam.at_supports()[:3], [step.reaction, step.deflection, step.opening])
    beam.close()


def test_powers_name_every_number_of_a_scene():
    made = random_scene(random.Random(1))
    keys = {key for item in (made["beam"], *made["supports"], *made["loads"]) for key in item}
    assert keys - set(POWERS) <= {"node", "side", "type", "case", "rotation"}
    assert in_units(in_units(made, 7, -3, 5), -7, 3, -5) == made


@pytest.mark.parametrize("follow", ["steps", "events"])
def test_support_without_stiffness(library, follow):
    """It never carries: open, and its opening says where the beam is, past it where that is negative."""
    made = simple([4.0], [at(0), at(1), at(x=2.0, side="above", stiffness=0.0, gap=0.1)])
    made["supports"] += [at(x=2.0, side="below", stiffness=0.0, gap=1e-4, rotation=3.0), at(x=1.0, stiffness=0.0)]
    made["analysis"] = {"follow": follow}
    step = gapbeam.solve(made, start=[True, False]).steps[-1]
    w = step.deflection[2]
    assert w == pytest.approx(5 * 4.0**4 / 384e4, rel=1e-12)
    assert step.state == ("bilateral", "bilateral", "open", "open", "bilateral")
    assert step.opening.tolist() == [0.0, 0.0, 0.1 + w, 1e-4 - w, 0.0]
    assert step.opening[3] < 0.0
    assert step.reaction[2:].tolist() == [0.0, 0.0, 0.0]
    assert step.couple[3] == pytest.approx(0.0, abs=1e-15)
    assert step.undecided == ()
    beam, _ = library.prepare(made)
    assert beam.solve(1.0) == (0, "")
    assert beam.follow(1.0)[2] == []
    values = [step.reaction, step.deflection, step.opening, step.couple, [CONDITIONS[s] for s in step.state]]
    for one in (beam, F77Beam(library, made)):
        assert one.solve(1.0) in (0, (0, ""))
        np.testing.assert_array_equal(one.at_supports(), values)
    cases = gapbeam.prepare(made).solve([[1.0], [2.0]])
    assert cases.closed.tolist() == [[1, 1, 0, 0, 1]] * 2
    assert cases.reaction[0].tolist() == step.reaction.tolist()
    beam.close()


def test_support_without_stiffness_changes_no_answer():
    """The answer is that of the scene with a support that could act both ways, and has no stiffness either."""
    for seed in range(60):
        rng = random.Random(seed)
        made = random_scene(rng)
        made.pop("sections", None)
        end = nodes_of(made)[-1]
        idle = [at(x=rng.choice((0.0, end, 0.37 * end)), side=rng.choice(("below", "above")), stiffness=0.0) for _ in range(2)]
        with_idle = {**made, "supports": idle[:1] + made["supports"] + idle[1:]}
        # A support is a node even if it carries nothing
        made["supports"] = [at(x=s["x"], stiffness=0.0) for s in idle] + made["supports"]
        here, there = outcome(made), outcome(with_idle)
        assert there[0] == here[0]
        if here[0] != 0:
            continue
        for a, b in zip(here[1].steps, there[1].steps, strict=True):
            assert b.reaction[1:-1] == pytest.approx(a.reaction[2:], rel=1e-9, abs=1e-12 * np.abs(a.reaction).max())
            assert b.state[1:-1] == a.state[2:] or b.undecided
            assert b.state[0] == b.state[-1] == "open"


def test_open_support_holds_the_rotation(library):
    """A rotational restraint belongs to the place: open or closed, the beam is held as by a guide, and the report says so."""
    made = simple([4.0, 4.0], [at(0), at(1, side="below", rotation=500.0), at(2)], EI=100.0)
    made["loads"] = [uniform(-1.0, **stretch(0.0, 4.0))]
    made["units"] = {"force": "kN", "length": "m"}
    result = gapbeam.solve(made)
    step = result.steps[0]
    assert step.state[1] == "open"
    assert step.couple[1] == pytest.approx(-500.0 * result.at(4.0).rotation, rel=1e-12)
    assert abs(step.couple[1]) > 0.1
    text = report_text(result, width=200)
    assert f"No contact, but the rotation is still held: support 1 (x = 4, couple {step.couple[1]:.5g} kN m)." in text
    # The same as a rotational spring beside a support that is not there
    free = gapbeam.solve({**made, "supports": [at(0), at(1, stiffness=0.0, rotation=500.0), at(2)]})
    np.testing.assert_array_equal(free.steps[0].couple, step.couple)
    beam, _ = library.prepare(made)
    assert beam.solve(1.0) == (0, "")
    assert beam.at_supports()[3].tolist() == step.couple.tolist()
    beam.close()


@pytest.mark.parametrize("power", [0, 400, -400])
def test_laws_far_from_one_stay_when_loads_are_lowered_anew(power):
    """The engine's units are far from 1 here; laws are kept in them alone."""
    scale = 2.0**power
    made = simple([6.0, 6.0], [at(0), at(1, law=[[0.001, 10.0 * scale], [0.1, 20.0 * scale]]), at(2)], EI=1000.0 * scale)
    made["loads"] = [uniform(10.0 * scale)]
    step = gapbeam.solve(made).steps[-1]
    again = gapbeam.prepare(made).result([1.0]).steps[-1]
    np.testing.assert_array_equal(again.reaction, step.reaction)
    np.testing.assert_array_equal(again.deflection, step.deflection)
    assert step.reaction[1] / scale == pytest.approx(60.96, abs=0.01)


def test_reactions_are_not_lost_beside_a_great_lack_of_fit():
    """A support 1e30 too high: quadruple precision tells its reaction no more, and nothing may be said of it."""
    supports = [at(i, side="below") for i in range(6)]
    made = scene([6.0] * 5, supports, [uniform(2.0), force(3.0, 100.0), force(16.0, 50.0)], EI=1e4)
    supports[1]["gap"] = -1e25
    assert gapbeam.solve(made).steps[-1].reaction.tolist() == pytest.approx([0.0, 1075.0 / 6, 0.0, 0.0, 0.0, 185.0 / 6])
    supports[1]["gap"] = -1e30
    with pytest.raises(EngineError, match="so great that reactions to the loads are lost"):
        gapbeam.solve(made)


def test_load_factors_beyond_what_can_be_solved_are_named():
    supports = [{"node": 0}, {"node": 1, "side": "below", "gap": 0.002}, {"node": 2}]
    loads = [{"type": "uniform", "q": 2.0}, {"type": "force", "x": 3.0, "F": 40.0}]
    made = {"beam": {"spans": [6.0, 6.0], "EI": 1e4}, "supports": supports, "loads": loads}
    with pytest.raises(gapbeam.SceneError, match=r"history\[0\]: expected a finite number of at most 1e\+100, got 1e\+300"):
        gapbeam.solve({**made, "analysis": {"follow": "events", "history": [1e300]}})
    loads[1]["F"] = 1e250
    with pytest.raises(EngineError, match=r"left the range of double precision.*; choose a greater unit of force"):
        report_text(gapbeam.solve({**made, "analysis": {"follow": "events", "history": [1e90]}}))
