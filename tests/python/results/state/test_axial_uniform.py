"""Loads that are distributed along the beam: closed forms, rational numbers, and what is refused."""

import json
import random
from fractions import Fraction
from itertools import accumulate, pairwise

import gapbeam
import numpy as np
import pytest
from gapbeam.results.equilibrium import sum_of_loads, sum_of_reactions

LENGTH, EA, N = 8.0, 500.0, 3.0


def along(q=N, **keys):
    return {"type": "axial_uniform", "q": q, **keys}


def scene(axial, loads, **beam):
    """A beam on two supports across it, with supports along it."""
    return {
        "beam": {"spans": [LENGTH], "EI": 1e4, "EA": EA} | beam,
        "supports": [{"node": 0}, {"node": -1 if beam.get("spans") is None else len(beam["spans"])}]
        + [{"direction": "axial", **one} for one in axial],
        "loads": loads,
    }  # fmt: skip


def solve(axial, loads, **more):
    made = scene(axial, loads)
    made["supports"][1] = {"node": 1}
    return gapbeam.solve(made | more)


def told(extreme):
    return extreme.value, extreme.x


# Closed forms


def test_a_bar_that_hangs_at_one_end():
    """N = n (L - x), u = n (L x - x^2/2)/EA."""
    result = solve([{"node": 0}], [along()])
    x = np.linspace(0.0, LENGTH, 9)
    found = result.at(x)
    assert found.axial_force == pytest.approx(N * (LENGTH - x), rel=1e-14, abs=1e-14)
    assert found.axial_displacement == pytest.approx(N * (LENGTH * x - x**2 / 2) / EA, rel=1e-14, abs=1e-16)
    assert result.steps[-1].reaction[2] == pytest.approx(-N * LENGTH, rel=1e-15)
    extremes = result.extremes
    assert told(extremes["axial_force"]["max"]) == pytest.approx((N * LENGTH, 0.0))
    assert told(extremes["axial_force"]["min"]) == pytest.approx((0.0, LENGTH), abs=1e-14)
    assert told(extremes["axial_displacement"]["max"]) == pytest.approx((N * LENGTH**2 / 2 / EA, LENGTH))


def test_between_two_stops():
    """Half at either end; the largest displacement is in the middle, where no node is: n L^2/(8 EA)."""
    result = solve([{"node": 0}, {"node": 1}], [along()])
    assert result.steps[-1].reaction[2:] == pytest.approx([-N * LENGTH / 2] * 2, rel=1e-15)
    largest = result.extremes["axial_displacement"]["max"]
    assert largest.value == pytest.approx(N * LENGTH**2 / (8 * EA), rel=1e-14)
    assert largest.x == pytest.approx(LENGTH / 2, rel=1e-14)
    assert result.at(LENGTH / 2).axial_force == pytest.approx(0.0, abs=1e-14)
    assert told(result.extremes["axial_force"]["min"]) == pytest.approx((-N * LENGTH / 2, LENGTH))


def test_a_rigid_bar_has_the_forces():
    made = scene([{"node": 0}], [along(-N, **{"from": 2.0, "to": 6.0})], EA=float("inf"))
    made["supports"][1] = {"node": 1}
    found = gapbeam.solve(made).at([0.0, 2.0, 3.0, 6.0, 8.0])
    assert found.axial_force == pytest.approx([-4 * N, -4 * N, -3 * N, 0.0, 0.0], abs=1e-14)
    assert not found.axial_displacement.any()


def test_a_stop_closes_at_its_factor():
    """The free end moves by n L^2/(2 EA); at the stop the rest is shared half and half."""
    gap = 0.1
    result = solve([{"node": 0}, {"node": 1, "side": "left", "gap": gap}], [along()], analysis={"follow": "events"})
    closes = next(event for event in result.events if event.event == "closes")
    factor = gap * 2 * EA / (N * LENGTH**2)
    assert closes.factor == pytest.approx(factor, rel=1e-14)
    assert result.steps[-1].reaction[3] == pytest.approx(-N * LENGTH * (1 - factor) / 2, rel=1e-14)
    assert result.at(LENGTH, factor=factor / 2).axial_displacement == pytest.approx(gap / 2, rel=1e-13)
    assert result.at(0.0, factor=factor / 2).axial_force == pytest.approx(N * LENGTH * factor / 2, rel=1e-13)


def test_friction_holds_it():
    """Braking along a beam on three supports that rub: all of them share it, none slides; N jumps by friction there."""
    made = {
        "beam": {"spans": [4.0, 4.0], "EI": 1e4, "EA": EA},
        "supports": [{"node": k, "side": "below", "friction": 0.5} for k in range(3)],
        "loads": [{"type": "uniform", "q": 10.0, "case": "dead"}, along(1.0)],
    }
    result = gapbeam.solve(made)
    assert result.steps[-1].friction == pytest.approx([-2.0, -4.0, -2.0], rel=1e-13)
    assert result.at(1.0).axial_force == pytest.approx(1.0, rel=1e-13)
    assert result.steps[-1].extremes["axial_displacement"]["max"].value == pytest.approx(16.0 / (8 * EA), rel=1e-13)
    made["loads"][1]["q"] = 6.0  # of 48 the ends hold 7.5 each, and the middle 25
    result = gapbeam.solve(made | {"analysis": {"follow": "events"}})
    assert result.limits[0].factor == pytest.approx(40.0 / 48.0, rel=1e-13)


# Rational numbers


def exact(made):
    """Displacements of the points by Fractions: stiffness EA/L of every piece, half of its load at either end."""
    F = Fraction
    ends = list(accumulate([F(0), *map(F, made["beam"]["spans"])]))
    x = {*ends}
    for one in made["loads"]:
        x |= {F(one["from"]), F(one["to"])} if "from" in one else {F(one["x"])}
    for one in made["sections"]:
        x |= {F(one["from"]), F(one["to"])}
    x |= {F(one["x"]) for one in made["supports"]}
    x = sorted(x)
    n = len(x) - 1
    middle = [(a + b) / 2 for a, b in pairwise(x)]

    def there(one, k):
        return F(one["from"]) <= middle[k] <= F(one["to"])

    soft = [F(made["beam"]["EA"])] * n
    for one in made["sections"]:
        soft = [F(one["EA"]) if there(one, k) else old for k, old in enumerate(soft)]
    length = [b - a for a, b in pairwise(x)]
    load = [sum(F(one["q"]) for one in made["loads"] if one["type"] == "axial_uniform" and there(one, k)) for k in range(n)]
    warm = [sum(F(made["beam"]["alpha"]) * F(one["dT"]) for one in made["loads"] if one["type"] == "temperature" and there(one, k))
            for k in range(n)]  # fmt: skip
    matrix = [[F(0)] * (n + 1) for _ in range(n + 1)]
    right = [F(0)] * (n + 1)
    for k in range(n):
        c = soft[k] / length[k]
        for i, j, sign in ((k, k, 1), (k + 1, k + 1, 1), (k, k + 1, -1), (k + 1, k, -1)):
            matrix[i][j] += sign * c
        for i, sign in ((k, -1), (k + 1, 1)):
            right[i] += sign * soft[k] * warm[k] + load[k] * length[k] / 2
    for one in made["loads"]:
        if one["type"] == "axial":
            right[x.index(F(one["x"]))] += F(one["F"])
    for one in made["supports"]:
        if one.get("direction") == "axial":
            i = x.index(F(one["x"]))
            matrix[i][i] += F(one["stiffness"])
            right[i] += F(one["stiffness"]) * F(one.get("settlement", 0))
    for k in range(n + 1):
        for i in range(k + 1, n + 1):
            share = matrix[i][k] / matrix[k][k]
            matrix[i] = [a - share * b for a, b in zip(matrix[i], matrix[k], strict=True)]
            right[i] -= share * right[k]
    u = [F(0)] * (n + 1)
    for k in reversed(range(n + 1)):
        u[k] = (right[k] - sum(matrix[k][j] * u[j] for j in range(k + 1, n + 1))) / matrix[k][k]

    def fields(at):
        k = max(i for i in range(n) if x[i] <= at)
        s, whole = at - x[k], length[k]
        force = soft[k] * ((u[k + 1] - u[k]) / whole - warm[k]) + load[k] * (whole / 2 - s)
        return force, u[k] + (u[k + 1] - u[k]) * s / whole + load[k] * s * (whole - s) / (2 * soft[k])

    return fields


def random_bar(rng):
    """Springs along a beam, sections, forces, temperatures and loads on stretches, all on a grid of quarters."""
    spans = [rng.choice((2.0, 3.5, 5.0)) for _ in range(rng.randint(1, 3))]
    end = sum(spans)

    def stretch():
        a, b = sorted(rng.sample(range(int(4 * end) + 1), 2))
        return {"from": a / 4, "to": b / 4}

    def place():
        return rng.randrange(int(4 * end) + 1) / 4

    loads = [{**along(rng.randint(-20, 20)), **stretch(), "case": rng.choice(("dead", "live"))} for _ in range(rng.randint(1, 3))]
    loads += [{"type": "axial", "F": rng.randint(-20, 20), "x": place()} for _ in range(rng.randint(0, 2))]
    loads += [{"type": "temperature", "dT": rng.randint(-9, 9), **stretch()} for _ in range(rng.randint(0, 2))]
    rng.shuffle(loads)
    sections = [{**stretch(), "EA": 2.0 ** rng.randint(6, 12)} for _ in range(rng.randint(0, 2))]
    places = rng.sample(range(int(4 * end) + 1), rng.randint(1, 4))
    axial = [{"x": k / 4, "direction": "axial", "stiffness": 2.0 ** rng.randint(2, 9), "settlement": rng.choice((0.0, 0.125))}
             for k in places]  # fmt: skip
    return {
        "beam": {"spans": spans, "EI": 1e4, "EA": 1024.0, "alpha": 2.0**-12, "depth": 1.0}, "sections": sections,
        "supports": [{"x": 0.0}, {"x": end}, *axial], "loads": loads, "analysis": {"first_order": True},
    }  # fmt: skip


@pytest.mark.parametrize("seed", range(60))
def test_random_bars(seed):
    rng = random.Random(seed)
    made = random_bar(rng)
    fields, end = exact(made), sum(made["beam"]["spans"])
    result = gapbeam.solve(made)
    places = [k / 8 for k in range(int(8 * end)) if k % 2]
    found = result.at(places)
    right = [fields(Fraction(x)) for x in places]
    forces, ways = ([float(one[k]) for one in right] for k in range(2))
    assert found.axial_force == pytest.approx(forces, abs=1e-13 * max(map(abs, forces)) + 1e-300)
    assert found.axial_displacement == pytest.approx(ways, abs=1e-13 * max(map(abs, ways)) + 1e-300)
    for name, values in (("axial_force", found.axial_force), ("axial_displacement", found.axial_displacement)):
        for kind, bound in (("max", values.max()), ("min", values.min())):
            extreme = result.extremes[name][kind]
            size = 1e-12 * np.abs(values).max()
            assert extreme.value >= bound - size if kind == "max" else extreme.value <= bound + size
            there = [result.at(extreme.x, side=side) for side in ("left", "right")]
            assert min(abs(getattr(one, name) - extreme.value) for one in there) <= size
    loads, reactions = sum_of_loads(result.scene, 1.0), sum_of_reactions(result.scene, result.steps[-1])
    assert loads.axial == pytest.approx(reactions.axial, abs=1e-10)
    # By events and combinations, and as one of many cases
    factors = {one.get("case", "live"): 1.0 for one in made["loads"]}
    ways = [gapbeam.solve(made | {"combinations": [{"name": "a", "factors": factors}]}).combinations[0],
            gapbeam.solve(made | {"analysis": {"first_order": True, "follow": "events"}}),
            gapbeam.prepare(made).result(np.ones(len(made["loads"])))]  # fmt: skip
    for other in ways:
        assert other.at(places).axial_force == pytest.approx(found.axial_force, abs=1e-12 * max(map(abs, forces)) + 1e-300)


def test_factors_multiply_it():
    beam = gapbeam.prepare(scene([{"node": 0}], [along(), along(case="dead", q=1.0)]) | {"supports": [
        {"node": 0}, {"node": 1}, {"node": 0, "direction": "axial"}]})  # fmt: skip
    forces = beam.solve([[1.0, 0.0], [-2.0, 3.0]]).at(0.0).axial_force
    assert forces == pytest.approx([N * LENGTH, (-2 * N + 3) * LENGTH], rel=1e-14)


# Compression, pictures, words, refusals


def test_compression_is_that_at_the_end():
    """A column of which the foot carries n L is refused where that is beyond the Euler load, which is on the safe side."""
    euler = np.pi**2 * 1e4 / LENGTH**2
    for share, is_refused in ((0.9, False), (1.1, True)):
        made = scene([{"node": 1}], [along(share * euler / LENGTH)], EA=1e6)
        made["supports"][1] = {"node": 1}
        made["beam"]["GA"] = 1e9  # where bending does not feel it
        if is_refused:
            with pytest.raises(gapbeam.SceneError, match="would buckle"):
                gapbeam.solve(made)
            assert gapbeam.prepare(made).solve([1.0]).status != 0
        else:
            assert gapbeam.solve(made).compression.force == pytest.approx(share * euler, rel=1e-12)
            assert gapbeam.prepare(made).solve([1.0]).status == 0


def test_what_is_shown():
    result = solve([{"node": 0}], [along(-N)], units={"force": "kN", "length": "m"})
    text = gapbeam.report.report_text(result)
    assert "24" in text
    data = json.loads(gapbeam.report.to_json(result))
    assert data["extremes"]["axial_force"]["min"] == pytest.approx([-24.0, 0.0])
    page = result.to_html()
    assert '"type": "axial_uniform"' in page or '"type":"axial_uniform"' in page
    from gapbeam.plots import figure

    words = [one.get_text() for axes in figure(result).axes for one in axes.texts]
    assert any("to the left" in one for one in words)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"q": float("nan")}, r"loads\[0\]\.q: expected a finite number"),
        ({"to": 9.0}, "outside the beam"),
    ],
)
def test_refusals(change, message):
    with pytest.raises(gapbeam.SceneError, match=message):
        solve([{"node": 0}], [along() | change])


def test_nothing_holds_it():
    with pytest.raises(gapbeam.SceneError, match="nothing holds the beam horizontally"):
        solve([], [along()])


def test_beside_tapers_of_EA_it_is_refused():
    made = solve([{"node": 0}], [along()]).scene
    tapered = gapbeam.replace(made, "sections", [gapbeam.Section(from_=1.0, to=3.0, EA=[100.0, 200.0])])
    with pytest.raises(gapbeam.SceneError, match=r"loads\[0\]\.from: a load along the beam where EA changes"):
        gapbeam.solve(tapered)
    assert gapbeam.solve(gapbeam.replace(tapered, "loads", [gapbeam.AxialUniformLoad(from_=3.0, q=1.0)])).status == "solved"


@pytest.mark.parametrize("F", [100.0, 240.0, 400.0])
def test_a_beam_that_a_load_along_it_pulls_is_cut_for_the_tension_that_it_comes_under(F):
    """From event to event as by steps: stretches carried from small loads on are short enough for all of the tension."""
    supports = [{"node": 0}, {"node": 1, "side": "below", "gap": 0.02}, {"node": 2}, {"node": 0, "direction": "axial"}]
    loads = [
        {"type": "uniform", "q": 3.0, "case": "dead"}, {"type": "axial", "node": 2, "F": F},
        {"type": "axial_uniform", "q": 40.0, "from": 0.0, "to": 5.0},
    ]  # fmt: skip
    made = {"beam": {"spans": [5.0, 5.0], "EI": 100.0, "EA": 8192.0}, "supports": supports, "loads": loads}
    by_events, by_steps = (gapbeam.solve(made | {"analysis": analysis}) for analysis in ({"follow": "events"}, {"steps": 8}))
    for step in by_steps.steps:
        found = by_events.state(step.factor)
        assert found.reaction == pytest.approx(step.reaction, rel=1e-12, abs=1e-12)
