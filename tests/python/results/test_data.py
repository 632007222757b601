"""Results as data: pickled, compared, protected against changes, and questions that make no sense refused in words."""

import copy
import pickle
import random
from concurrent.futures import ProcessPoolExecutor
from decimal import Decimal
from fractions import Fraction
from multiprocessing import get_context

import gapbeam
import numpy as np
import pytest
from scenes import at, force, moment, random_scene, scene, uniform
from scenes.ground import stopped

BELOW = [at(i, side="below") for i in range(3)]


def rocking(**analysis):
    """Two spans whose far end lifts off."""
    loads = [uniform(1.0, case="dead"), uniform(10.0, to=1.0)]
    return scene([1.0, 1.0], BELOW, loads, analysis=analysis)


def pulled():
    """With axial loads and a rotational restraint."""
    supports = [at(0, rotation=5.0), at(1, side="below", gap=0.01), at(2), at(0, direction="axial")]
    loads = [uniform(3.0), {"type": "axial", "node": 2, "F": 3.0}, moment(1.5, 2.0)]
    return scene([1.0, 1.0], supports, loads, EA=100.0, analysis={"steps": 3})


def tipping():
    return scene([1.0, 1.0], BELOW[:2], [uniform(1.0, case="dead", to=1.0), force(2.0, 10.0)], analysis={"steps": 40})


RESULTS = {
    "steps": lambda: gapbeam.solve(rocking(steps=8)),
    "events": lambda: gapbeam.solve(rocking(follow="events")),
    "axial": lambda: gapbeam.solve(pulled()),
    "tipping": lambda: gapbeam.solve(tipping()),
    "ground": lambda: gapbeam.solve(stopped()),
    "events on ground": lambda: gapbeam.solve(stopped(follow="events")),
    "no step": lambda: gapbeam.solve({**tipping(), "analysis": {}}),
    "no event": lambda: gapbeam.solve(scene([1.0], BELOW[:1], [force(1.0, 3.0, case="dead")], analysis={"follow": "events"})),
    "case": lambda: gapbeam.prepare(pulled()).result([2.0, 1.0, -1.0]),
    "far units": lambda: gapbeam.solve(scene([2.0**300] * 2, BELOW, [uniform(1.0)], EI=2.0**900, analysis={"steps": 2})),
}


@pytest.fixture(params=RESULTS)
def result(request):
    return RESULTS[request.param]()


def digits(result):
    """All that a result tells but how long it took, bytes of its floats."""
    told = [result.status, result.reason, result.motion, result.solves, result.history(), result._rule]
    told += [(event.factor, event.support, event.event) for event in result.events]
    for step in result.steps:
        told += [step.factor, step.solves, step.state, step.residuals, step.bounds, step.undecided, step.indifferent]
        told += [getattr(step, name).tobytes() for name in ("reaction", "deflection", "opening", "couple")]
    told.append([{**step, "seconds": 0.0} for step in result.to_dict()["steps"]])
    if result.steps:
        told += [result.to_dict()["fields"], result._pairs_of_extremes(), result.at([0.5, 1.0], factor=0.03).moment.tobytes()]
    return told


def arrays_in(value, seen):
    """All arrays that can be reached through public attributes."""
    if isinstance(value, np.ndarray):
        yield value
    elif isinstance(value, tuple | list | gapbeam.results.state.steps.Steps):
        for part in value:
            yield from arrays_in(part, seen)
    elif type(value).__module__.startswith("gapbeam") and id(value) not in seen:
        seen.add(id(value))
        for name in dir(value):
            if name in ("reactions", "openings", "states") and isinstance(value, gapbeam.Result) and not value.steps:
                continue  # they say why there are none
            if not name.startswith("_") and not callable(getattr(value, name)):
                yield from arrays_in(getattr(value, name), seen)


def test_a_result_comes_back_from_pickling_the_same(result):
    again = pickle.loads(pickle.dumps(result))
    assert again == result
    assert digits(again) == digits(result)
    assert all(pickle.loads(pickle.dumps(step)) == step for step in result.steps)
    assert copy.deepcopy(result) == result


@pytest.mark.filterwarnings("ignore:kinks of laws are called breakpoints")
@pytest.mark.parametrize("name", RESULTS)
def test_arrays_are_read_only(name):
    fresh = RESULTS[name]()
    for found in (fresh, pickle.loads(pickle.dumps(fresh))):
        things = [found]
        if found.steps:
            things += [found.fields(), found.at([0.0, 1.0]), found.at(0.5), found.state(0.01)]
        arrays = list(arrays_in(things, set()))
        assert len(arrays) > 20 or not found.steps
        assert not any(array.flags.writeable for array in arrays)
    cases = gapbeam.prepare(rocking()).solve(np.ones((3, 2)))
    arrays = list(arrays_in([cases, pickle.loads(pickle.dumps(cases)), gapbeam.prepare(rocking())], set()))
    assert len(arrays) > 14
    assert not any(array.flags.writeable for array in arrays)


def test_the_arrays_of_the_caller_stay_his_own():
    result, x = gapbeam.solve(rocking()), np.array([0.0, 1.0])
    fields = result.at(x)
    x[0] = 0.5
    assert fields.x.tolist() == [0.0, 1.0]
    factors = np.ones((2, 2))
    gapbeam.prepare(rocking()).solve(factors)
    factors[0, 0] = 2.0


def total(beam, row):
    return beam.solve(row).reaction.sum()


def test_process_pools():
    """A process of its own gives and takes results, steps and prepared beams."""
    beam = gapbeam.prepare(rocking())
    rows = np.random.default_rng(1).uniform(0.5, 2.0, (6, 2))
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        results = list(pool.map(gapbeam.solve, [rocking(steps=4), rocking(follow="events"), tipping()]))
        totals = list(pool.map(total, [beam] * 6, rows))
        histories = list(pool.map(gapbeam.Result.history, results))
    assert results == [gapbeam.solve(made) for made in (rocking(steps=4), rocking(follow="events"), tipping())]
    assert totals == [total(beam, row) for row in rows]
    assert histories == [result.history() for result in results]


def test_a_prepared_beam_comes_back_the_same():
    for made in (rocking(), pulled(), scene([1.0], [at(0), at(1)], []), scene([2.0**300], [at(0), at(1)], [uniform(1.0)])):
        beam = gapbeam.prepare(made)
        again = pickle.loads(pickle.dumps(beam))
        rows = np.random.default_rng(2).uniform(-1.0, 2.0, (20, len(made["loads"])))
        assert again.solve(rows) == beam.solve(rows)
        assert again.result(rows[0]) == beam.result(rows[0])
        assert again.scene == beam.scene


def test_comparing_answers():
    """Always a bool; equal is what was solved the same way, unequal what differs in one number."""
    made, other = rocking(steps=2), rocking(steps=2)
    other["loads"][1]["q"] = 10.5
    pairs = [
        (gapbeam.solve(made), gapbeam.solve(made), gapbeam.solve(other)),
        (gapbeam.solve(made).steps[0], gapbeam.solve(made).steps[0], gapbeam.solve(made).steps[1]),
        (gapbeam.solve(made).at([0.0, 1.0]), gapbeam.solve(made).at([0.0, 1.0]), gapbeam.solve(made).at([0.0, 1.0, 2.0])),
        (gapbeam.solve(made).system, gapbeam.solve(made).system, gapbeam.solve(pulled()).system),
        *[[gapbeam.prepare(s).solve(np.ones((3, 2))) for s in (made, made, other)]],
        *[[gapbeam.read_scene(s) for s in (made, made, other)]],
        *[[gapbeam.solve(s).steps[0].solution for s in (made, made, other)]],
    ]
    for one, same, different in pairs:
        assert (one == same) is True
        assert (one != same) is False
        assert (one == different) is False
        assert (one != different) is True
        assert (one == 3) is False
        assert one != None  # noqa: E711


def test_a_result_differs_by_its_loads_though_the_scene_is_the_same():
    beam = gapbeam.prepare(rocking())
    assert beam.result([1.0, 1.0]) != beam.result([1.0, 1.1])
    assert beam.result([1.0, 1.0]).scene == beam.result([1.0, 1.1]).scene


def test_unsolved_cases_are_equal_to_themselves():
    beam = gapbeam.prepare(tipping())
    cases = beam.solve([[1.0, 1.0], [1.0, 0.01]])
    assert np.isnan(cases.reaction[0]).all()
    assert cases == beam.solve([[1.0, 1.0], [1.0, 0.01]])


def test_curves_without_values_are_equal_to_themselves():
    """Of a train under which the beam stands at no position."""
    made = {**tipping(), "analysis": {}, "loads": tipping()["loads"][:1]}
    made["trains"] = [{"axles": [[0.0, 100.0]], "from": 1.5}]
    one, same = (gapbeam.solve(made).envelope().fields for _ in range(2))
    assert np.isnan(one.largest["moment"]).all()
    assert one == same
    assert one != gapbeam.solve({**made, "trains": [{"axles": [[0.0, 0.01]]}]}).envelope().fields


def test_scenes_that_hold_arrays_can_be_compared():
    def made(spans, q):
        return gapbeam.Scene(beam=gapbeam.Beam(spans=spans, EI=1.0), loads=[gapbeam.LinearLoad(q=q)])

    lists, arrays = made([1.0, 2.0], (1.0, 2.0)), made(np.array([1.0, 2.0]), np.array([1.0, 2.0]))
    assert (lists == arrays, arrays == lists, arrays == made(np.array([1.0, 2.0]), [1.0, 2.0])) == (True, True, True)
    assert (lists != arrays, arrays != lists) == (False, False)
    for other in (made(np.array([1.0, 3.0]), (1.0, 2.0)), made(np.ones(3), (1.0, 2.0)), made([1.0, 2.0], np.array([1.0, 3.0]))):
        assert (lists == other, arrays == other, other == arrays) == (False, False, False)
        assert arrays != other


@pytest.mark.parametrize("count", [0, 1, 3])
@pytest.mark.parametrize("loads", [[], [uniform(1.0), force(0.5, 2.0)]])
@pytest.mark.parametrize("supports", [[at(0), at(1)], [at(0, rotation="fixed")]])
def test_tables_of_any_number_of_cases(count, loads, supports):
    beam = gapbeam.prepare(scene([1.0], supports, loads))
    cases = beam.solve(np.ones((count, len(loads))))
    one = beam.solve()
    assert cases.status.tolist() == [0] * count
    for name in ("closed", "reaction", "deflection", "moment_left", "moment_right"):
        table, row = getattr(cases, name), getattr(one, name)
        assert table.shape == (count, *row.shape)
        assert all(np.array_equal(line, row) for line in table)
    assert cases.solves.shape == (count,)


def test_factors_of_other_types():
    beam = gapbeam.prepare(rocking())
    true = beam.solve([1.0, 0.5])
    for factors in ((1, 0.5), [Fraction(1), Decimal("0.5")], np.array([1.0, 0.5], dtype=np.longdouble), np.float32([1, 0.5])):
        assert beam.solve(factors) == true
    assert beam.solve([True, False]) == beam.solve([1.0, 0.0])
    assert beam.solve(np.asfortranarray([[1.0, 0.5]] * 3)).reaction[2].tolist() == true.reaction.tolist()


@pytest.mark.parametrize(
    ("factors", "message"),
    [
        ([], r"factors: expected 2 numbers a case, one for each load, got shape \(0,\)"),
        (1.0, r"factors: expected 2 numbers a case, one for each load, got shape \(\)"),
        (np.ones((2, 0)), r"got shape \(2, 0\)"),
        (np.ones((1, 1, 2)), r"got shape \(1, 1, 2\)"),
        ("1, 2", 'factors: expected numbers, got "1, 2"'),
        (["1", "2"], r'factors: expected numbers, got \["1", "2"\]'),
        ([1.0, None], r"factors: expected numbers, got \[1.0, null\]"),
        ([1.0, 2j], "factors: expected numbers, got "),
        ([[1.0, 2.0], [1.0]], "factors: expected numbers in rows of equal length"),
        ([1, 10**400], "factors: expected numbers that double precision holds"),
        (np.ma.masked_array([1.0, 2.0], [False, True]), "factors: expected numbers, some of these are masked"),
        ([1.0, np.inf], "factors: the factor of load 1 is inf; give a finite number"),
        ({"a": 1}, "factors: expected a list of 2 numbers, one for each load, got a table"),
    ],
)
def test_factors_that_make_no_sense(factors, message):
    with pytest.raises(ValueError, match=message):
        gapbeam.prepare(rocking()).solve(factors)


def test_a_beam_without_loads_takes_no_factors():
    beam = gapbeam.prepare(scene([1.0], [at(0), at(1)], []))
    assert beam.solve([]) == beam.solve()
    with pytest.raises(ValueError, match=r"expected 0 numbers a case, one for each load, got shape \(3,\)"):
        beam.solve([1.0, 2.0, 3.0])


STARTS = [
    ([True], "start: expected 3 entries, one per {}, got 1"),
    (True, "start: expected a list of True [(]closed[)] and False, one per {}, got true"),
    ("abc", 'start: expected a list of True [(]closed[)] and False, one per {}, got "abc"'),
    ([[True, False, True]], "start: expected a list of True [(]closed[)] and False, one per {}, got "),
    ([[True], [False, True], []], "start: expected a list of True [(]closed[)] and False"),
    ([True, 0.5, True], r"start\[1\]: expected True [(]closed[)] or False, got 0.5"),
    ([True, True, "open"], r'start\[0\]: expected True [(]closed[)] or False, got "True"'),
    (["closed"] * 3, r'start\[0\]: expected True [(]closed[)] or False, got "closed"'),
    ([True, True, None], r"start\[2\]: expected True [(]closed[)] or False, got null"),
    (np.array([1.0, np.nan, 0.0]), r"start\[1\]: expected True [(]closed[)] or False, got nan"),
]


@pytest.mark.parametrize(("start", "message"), STARTS)
def test_starts_that_make_no_sense(start, message):
    with pytest.raises(gapbeam.SceneError, match=message.format("one-sided support")):
        gapbeam.solve(rocking(), start=start)
    with pytest.raises(gapbeam.SceneError, match=message.format("support across the beam")):
        gapbeam.prepare(rocking()).solve(start=start)


@pytest.mark.parametrize("start", [[1, 0, 1], (True, False, True), np.array([1, 0, 1]), np.array([True, False, True])])
def test_starts_of_other_types(start):
    true = gapbeam.solve(rocking(), start=[True, False, True])
    again = gapbeam.solve(rocking(), start=start)
    assert again == true
    assert again.solves == true.solves
    beam = gapbeam.prepare(rocking())
    assert beam.solve(start=start).solves == beam.solve(start=[True, False, True]).solves


@pytest.mark.parametrize(
    ("question", "message"),
    [
        (lambda r: r.fields(points=0), "points: expected a whole number, 1 or more, got 0"),
        (lambda r: r.fields(points=-3), "points: expected a whole number, 1 or more, got -3"),
        (lambda r: r.fields(points=2.5), "points: expected a whole number, 1 or more, got 2.5"),
        (lambda r: r.to_dict(points="20"), 'points: expected a whole number, 1 or more, got "20"'),
        (lambda r: r.to_dict(points=True), "points: expected a whole number, 1 or more, got true"),
        (lambda r: r.fields(points=10**15), "points: fields at 1000000000000000 points a span take 240,000 TB of memory"),
        (lambda r: r.fields(points=10**400), "points: fields at 100"),
        (lambda r: r.at(0.5, step=1, factor=0.5), "step: give a load step or a load factor, not both"),
        (lambda r: r.at(0.5, step=1.5), "step: expected a whole number, got 1.5"),
        (lambda r: r.at(0.5, step="last"), 'step: expected a whole number, got "last"'),
        (lambda r: r.at(0.5, factor=np.nan), "factor: expected a finite number, got nan"),
        (lambda r: r.at(0.5, factor=np.inf), "factor: expected a finite number, got inf"),
        (lambda r: r.at(0.5, factor="1"), 'factor: expected numbers, got "1"'),
        (lambda r: r.state([0.5, 0.6]), r"factor: expected one number, got an array of shape \(2,\)"),
        (lambda r: r.at("left"), 'x: expected numbers, got "left"'),
        (lambda r: r.at(None), "x: expected numbers, got null"),
        (lambda r: r.at([0.5, np.nan]), "x: the beam goes from 0 to 2, got nan"),
        (lambda r: r.at(np.ma.masked_array([0.5], [True])), "x: expected numbers, some of these are masked"),
        (lambda r: r.at(0.5, side="both"), 'side: expected "right" or "left", got "both"'),
        (lambda r: r.at(0.5, side=np.array(["left", "right"])), 'side: expected "right" or "left"'),
    ],
)
@pytest.mark.parametrize("follow", ["steps", "events"])
def test_questions_that_make_no_sense(question, message, follow):
    with pytest.raises(ValueError, match=message):
        question(gapbeam.solve(rocking(follow=follow)))


@pytest.mark.parametrize("ask", [gapbeam.Result.fields, gapbeam.Result._chosen, lambda r, step: r.at(0.5, step=step)])
def test_steps_that_are_not_there(ask):
    result = gapbeam.solve(rocking(steps=4))
    for step in (4, -5):
        with pytest.raises(IndexError, match=f"step: expected a number from 0 to 3, or from -4 to -1, got {step}"):
            ask(result, step)
    with pytest.raises(IndexError, match="no load step stands; no equilibrium at load factor 1: the beam tips"):
        ask(gapbeam.solve({**tipping(), "analysis": {}}), -1)


def test_questions_of_other_types():
    result = gapbeam.solve(rocking(steps=4))
    assert result.at(1, step=np.int64(1)) == result.at(1.0, step=1)
    assert result.at(Fraction(1, 2), factor=Fraction(1, 2)) == result.at(0.5, factor=0.5)
    assert result.at([]).moment.shape == (0,)
    assert result.at([[0.0], [1.0]]).moment.shape == (2, 1)
    assert result.at([1.0]) == result.at(np.float32([1.0]))


def test_rules_that_are_none():
    for rule in (5, ["block"], "fast"):
        with pytest.raises(gapbeam.SceneError, match="rule: expected one of block, single, got "):
            gapbeam.solve(rocking(), rule=rule)


@pytest.mark.parametrize("block", range(4))
def test_random_results_come_back_the_same(block):
    for seed in range(50 * block, 50 * block + 50):
        rng = random.Random(seed)
        made = random_scene(rng)
        made["analysis"] = rng.choice(({"steps": 3}, {"steps": 3, "rule": "single"}, {"follow": "events"}))
        try:
            result = gapbeam.solve(made)
        except gapbeam.EngineError:
            continue
        again = pickle.loads(pickle.dumps(result))
        assert again == result
        assert digits(again) == digits(result)
