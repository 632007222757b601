"""Ground whose laws have parameters, curves among them: beside an oracle of its own, in Python and in refusals."""

import json

import gapbeam
import numpy as np
import pytest
from gapbeam.base.errors import SceneError
from oracle.curved import Curved
from scenes.curved import random_curved_scene

BEAM = {"spans": [20.0], "EI": 1.0e5}
LOADS = [{"type": "force", "x": 0.0, "F": 300.0}, {"type": "moment", "x": 0.0, "M": 100.0}]
SEEDS = [3, 202, 208, 257]
"""All laws, on one side and on both, in as little time as may be; many more by hand (`compare_curved`)."""


def kinks_of(scene, result):
    """Places, foundations, sides and numbers of the kinks of laws."""
    end, found = scene["beam"]["spans"][0], {}
    layers = [(run, run.from_) for run in result.steps[-1].runs] + [(run, run.to) for run in result.steps[-1].runs]
    for run, x in layers:
        ground = scene["foundation"][run.foundation]
        if min(abs(x - ground.get("from", 0.0)), abs(x - ground.get("to", end))) > 1e-12:
            found.setdefault((round(x, 10), run.foundation, run.side), []).append((run.acts, x))
    kinks = []
    for (_, foundation, side), acts in sorted(found.items()):
        least = min(acts)
        if len({number for number, _ in acts}) < 2:
            continue
        # What acts both ways without a gap changes its side at one place
        same = scene["foundation"][foundation].get("gap", 0.0) == 0.0
        if not (same and any(abs(least[1] - x) < 1e-9 and foundation == other for x, other, *_ in kinks)):
            kinks.append((least[1], foundation, side, int(least[0] > 0)))
    return kinks


def compare_curved(scene, result):
    """Largest differences of the fields from the oracle's relative to the greatest of their kind, and of kinks to the length."""

    def fields(x):
        point = result.at(x)
        return [float(np.ravel(value)[0]) for value in (point.deflection, point.rotation, point.moment, point.shear)]

    oracle = Curved(scene, fields, kinks_of(scene, result), digits=20)
    assert oracle.check_signs()
    length = scene["beam"]["spans"][0]
    places = [*(length * i / 11 for i in range(12)), *oracle.base]
    right = np.array([[float(value) for value in oracle.at(x)] for x in places])
    error = np.abs(np.array([fields(x) for x in places]) - right).max(axis=0) / np.abs(right).max(axis=0)
    ends = [abs(float(oracle.places[i]) - kink[0]) / length for i, kink in oracle.at_kink.items()]
    return max(error), max(ends, default=0.0)


@pytest.mark.parametrize("seed", SEEDS)
def test_random_scenes_have_all_digits(seed):
    scene = random_curved_scene(seed)
    error, ends = compare_curved(scene, gapbeam.solve(scene))
    assert error < 1e-14
    assert ends < 1e-15


@pytest.mark.parametrize("more", [{}, {"slope": 500.0}])
def test_the_same_as_a_polyline(more):
    kind = "hardening" if more else "plastic"
    by_pairs, by_numbers = (
        gapbeam.solve({"beam": BEAM, "foundation": [{"law": {"type": kind} | law}], "loads": LOADS})
        for law in ({"stiffness": 2e4, "limit": 100.0} | more,
                    {key: [value, value] for key, value in ({"stiffness": 2e4, "limit": 100.0} | more).items()})
    )  # fmt: skip
    x = np.linspace(0.0, 20.0, 41)
    for key in ("deflection", "moment", "pressure"):
        one, other = getattr(by_pairs.at(x), key), getattr(by_numbers.at(x), key)
        assert np.abs(one - other).max() <= 1e-14 * np.abs(one).max()
    zones, others = by_pairs.steps[-1].contact, by_numbers.steps[-1].contact
    assert [zone.state for zone in zones] == [zone.state for zone in others]
    assert [zone.resultant for zone in zones] == pytest.approx([zone.resultant for zone in others], rel=1e-13)


def pressure(law, x, deflection):
    """What a law that holds both ways says by itself, its parameters linear along a beam of 20."""
    p = {name: np.interp(x, [0.0, 20.0], ends) for name, ends in law.items() if name != "type"}
    d = np.abs(deflection)
    if law["type"] == "cubic":
        return np.sign(deflection) * (p["k1"] * d + p["k3"] * d**3)
    elastic = p["stiffness"] * d
    if law["type"] == "tanh":
        force = p["limit"] * np.tanh(elastic / p["limit"])
    elif law["type"] == "hyperbolic":
        force = elastic / (1.0 + elastic / p["limit"])
    else:
        beyond = p["limit"] + p["slope"] * (d - p["limit"] / p["stiffness"])
        force = np.where(elastic <= p["limit"], elastic, beyond)
    return np.sign(deflection) * force


@pytest.mark.parametrize(
    "law",
    [
        {"type": "tanh", "stiffness": [0.0, 6e4], "limit": [0.0, 800.0]},
        {"type": "hyperbolic", "stiffness": [1e4, 6e4], "limit": [50.0, 800.0]},
        {"type": "cubic", "k1": [1e3, 6e4], "k3": [1e7, 2e7]},
        {"type": "hardening", "stiffness": [1e4, 6e4], "limit": [50.0, 800.0], "slope": [1e3, 4e3]},
    ],
    ids=lambda law: law["type"],
)
def test_what_is_said_of_it_fits_together(law):
    result = gapbeam.solve({"beam": BEAM, "foundation": [{"law": law}], "loads": LOADS})
    step = result.steps[-1]
    assert sum(zone.resultant for zone in step.contact) == pytest.approx(300.0, rel=1e-12)
    assert step.error_bounds["deflection"] < 1e-10
    x = np.linspace(0.3, 19.7, 50)
    point = result.at(x)
    assert point.pressure == pytest.approx(pressure(law, x, point.deflection), rel=1e-11, abs=1e-9)
    most, place = result._pairs_of_extremes()["pressure"]["max"]
    assert most >= result.at(np.linspace(0.0, 20.0, 500)).pressure.max()
    assert float(result.at(place).pressure) == pytest.approx(most, rel=1e-12)
    assert json.loads(json.dumps(result.to_dict()))["steps"][0]["contact"]


def test_prepared_cases_and_events():
    sand = {"law": {"type": "tanh", "stiffness": [0.0, 6e4], "limit": [0.0, 800.0]}, "side": "below"}
    loads = [{"type": "uniform", "q": 5.0, "case": "dead"}, {"type": "force", "x": 0.0, "F": -30.0}]
    scene = {"beam": BEAM, "foundation": [sand], "loads": loads}
    cases = gapbeam.prepare(scene).solve([[1.0, 0.5], [1.0, 1.0]])
    assert cases.deflection[1].tolist() == gapbeam.solve(scene).steps[-1].solution.deflection.tolist()
    followed = gapbeam.solve(scene | {"analysis": {"follow": "events"}})
    assert followed.status == "solved"
    assert [event.event for event in followed.events] == ["end leaves"]
    before, after = (followed.state(followed.events[0].factor + d).contact[0].from_ for d in (-1e-9, 1e-9))
    assert before == 0.0 < after


@pytest.mark.parametrize(
    ("law", "place", "problem"),
    [
        ({"type": "tanh", "stiffness": [0.0, -1.0], "limit": 5.0}, "stiffness", "expected numbers of 0 or more, got [0, -1]"),
        ({"type": "plastic", "stiffness": [1.0, 2.0], "limit": 0.0}, "limit", "expected a number above 0 at one end at least"),
        ({"type": "tanh", "stiffness": 1.0, "limit": [0.0, 5.0]}, "limit", "is 0 at an end where stiffness is not"),
        ({"type": "cubic", "k1": 1.0, "k3": [1.0, 2.0], "k2": [-1.0, -3.0]}, "k2", "with k2 below -sqrt(3*k1*k3) the force falls"),
        ({"type": "cubic", "k1": 1.0, "k3": 1.0, "k2": -1.74}, "k2", "with k2 below -sqrt(3*k1*k3) the force falls"),
        ({"type": "hardening", "stiffness": 1.0, "limit": 1.0, "slope": [0.0, float("inf")]}, "slope", "expected finite numbers"),
    ],
)
def test_refusals_name_the_parameter(law, place, problem):
    with pytest.raises(SceneError) as refused:
        gapbeam.solve({"beam": BEAM, "foundation": [{"k": 1.0}, {"law": law}]})
    assert str(refused.value).startswith(f"foundation[1].law.{place}: {problem}")


def test_powers_are_refused_with_the_reason():
    with pytest.raises(SceneError, match="infinitely stiff at first"):
        gapbeam.solve({"beam": BEAM, "foundation": [{"law": {"type": "power", "d0": 0.01, "limit": 5.0, "n": 0.33}}]})


@pytest.mark.parametrize("n", [1, 2, 3])
def test_powers_that_are_cubics(n):
    cubic = {"type": "cubic", "k1": 0.0, "k3": 0.0} | {f"k{n}": 60.0 / 0.01**n}
    tables = {"type": "power", "d0": 0.01, "limit": [[0.0, 60.0]], "n": n}
    for law in ({"type": "power", "d0": 0.01, "limit": 60.0, "n": n}, {**tables, "limit": [60.0, 60.0]}, tables):
        loads = [{"type": "force", "x": 5.0, "F": 100.0}]
        results = [gapbeam.solve({"beam": BEAM, "foundation": [{"law": one}], "loads": loads}) for one in (law, cubic)]
        moments = [result._pairs_of_extremes()["moment"]["max"] for result in results]
        assert moments[0] == pytest.approx(moments[1], rel=1e-13)


@pytest.mark.parametrize(("turn", "digits"), [(0.6, 1e-11), (10.0, 1e-8), (300.0, 1e-4)])
def test_a_rigid_pile_as_near_to_its_limit_load_as_one_likes(turn, digits):
    """With p = 400 x/L tanh(22.5 turn (a - x)) and e = pi^2/(12 (22.5 turn)^2): F L/400 = a^2 - L^2/2 + e, a^3 + 3 a e = L^3/2."""
    length, e = 6.0, np.pi**2 / (12.0 * (22.5 * turn) ** 2)
    pivot = max(np.roots([1.0, 0.0, 3.0 * e, -(length**3) / 2.0]).real)
    F = 400.0 / length * (pivot**2 - length**2 / 2.0 + e)
    law = {"type": "tanh", "stiffness": [0.0, 9e3], "limit": [0.0, 400.0]}
    pile = {"beam": {"spans": [length], "EI": np.inf}, "foundation": [{"law": law}], "loads": [{"type": "force", "x": 0.0, "F": F}]}
    fields = gapbeam.solve(pile).at([0.0, pivot, length])
    assert np.abs(fields.rotation + turn).max() <= digits * turn
    assert abs(fields.deflection[1]) <= digits * fields.deflection[0]
    # Nor are piles that bend lost there
    assert gapbeam.solve({**pile, "beam": {"spans": [length], "EI": 2e5}}).at(0.0).deflection > fields.deflection[0]


def test_the_limit_load_of_a_pile_on_curves():
    law = {"type": "tanh", "stiffness": [0.0, 9e3], "limit": [0.0, 400.0]}
    pile = {"beam": {"spans": [6.0], "EI": 2e5}, "foundation": [{"law": law}], "loads": [{"type": "force", "x": 0.0, "F": 500.0}]}
    path = gapbeam.solve({**pile, "analysis": {"follow": "events"}})
    assert path.status == "limit-load"
    limit = 2400.0 * (0.25 ** (1 / 3) - 0.5) / 500.0
    assert f"and {limit:.12g};" in path.reason
    assert limit * (1.0 - 1e-6) < path.segments[-1].stop < limit
