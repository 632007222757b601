"""Scenes prepared once and solved for many load cases."""

import random

import gapbeam
import numpy as np
import pytest
from gapbeam.engine.quantities import FIELDS
from scenes import at, force, random_scene, scene, uniform


def scaled(made, factors):
    """The scene of one load case."""
    loads = []
    for load, factor in zip(made["loads"], factors, strict=True):
        load = dict(load)
        for key in ("q", "F", "M", "kappa"):
            if key in load:
                value = load[key]
                load[key] = [factor * v for v in value] if isinstance(value, list | tuple) else factor * value
        loads.append(load)
    return {**made, "loads": loads, "analysis": {}}


@pytest.mark.parametrize("block", range(5))
def test_cases_are_scenes_with_scaled_loads(block):
    solved = 0
    for seed in range(40 * block, 40 * block + 40):
        rng = random.Random(seed)
        made = random_scene(rng, held=rng.choice((True, None)))
        made["analysis"] = {}
        beam = gapbeam.prepare(made)
        factors = [[rng.choice((0.0, 1.0, -1.0, 0.5, 3.0)) for _ in made["loads"]] for _ in range(3)]
        cases = beam.solve(factors)
        for k, row in enumerate(factors):
            try:
                direct = gapbeam.solve(scaled(made, row))
            except gapbeam.EngineError:
                assert cases.status[k] > 10
                continue
            assert (direct.status == "solved") == (cases.status[k] == 0)
            full = beam.result(row)
            assert full.status == direct.status
            if direct.status != "solved":
                continue
            solved += 1
            step = direct.steps[-1]
            tolerance = 1e-11 * max(np.abs(step.reaction).max(initial=0.0), np.abs(np.ravel(row)).max(initial=1e-9))
            assert cases.reaction[k] == pytest.approx(step.solution.reaction, abs=tolerance, rel=1e-11), seed
            assert cases.closed[k].tolist() == step.solution.closed.tolist() or step.undecided
            assert full.steps[-1].reaction == pytest.approx(step.reaction, abs=tolerance, rel=1e-11)
            if not step.indifferent:
                x = np.linspace(0.0, direct._beam.places.end, 7)
                for name in ("deflection", "moment"):
                    a, b = getattr(full.at(x), name), getattr(direct.at(x), name)
                    assert a == pytest.approx(b, rel=1e-9, abs=1e-10 * max(np.abs(b).max(), 1e-6)), (seed, name)
    assert solved > 60


def test_one_case_is_the_row_of_many():
    made = scene([2.0, 3.0, 2.0], [at(0), at(1, side="below", gap=0.01), at(2, side="below"), at(3)],
                 [uniform(3.0), force(4.0, 10.0), uniform(1.0, case="dead")])  # fmt: skip
    beam = gapbeam.prepare(made)
    rows = np.random.default_rng(3).uniform(-2.0, 5.0, (50, 3))
    many = beam.solve(rows)
    for k, row in enumerate(rows):
        one = beam.solve(row)
        assert one.reaction.shape == (4,)
        assert np.array_equal(one.reaction, many.reaction[k])
        assert np.array_equal(one.deflection, many.deflection[k])
        assert one.solves == many.solves[k]
    assert np.array_equal(beam.solve().reaction, beam.solve([1.0, 1.0, 1.0]).reaction)
    assert np.array_equal(beam.solve(rows, start=[False] * 4).closed, many.closed)


def test_a_case_without_equilibrium_is_recorded():
    made = scene([1.0, 1.0], [at(0, side="below"), at(1, side="below")], [{**uniform(1.0), "to": 1.0}, force(2.0, 1.0)])
    beam = gapbeam.prepare(made)
    cases = beam.solve([[1.0, 0.1], [1.0, 10.0], [2.0, 0.0]])
    assert cases.status.tolist() == [0, 1, 0]
    for name in ("reaction", "deflection", "moment_left", "moment_right"):
        assert np.isfinite(getattr(cases, name)).tolist() == [[k != 1] * getattr(cases, name).shape[1] for k in range(3)]
    assert cases.closed.tolist() == [[1, 1], [0, 0], [1, 1]]
    assert cases.reaction[2] == pytest.approx([1.0, 1.0])
    assert "tips about the support at x = 1" in beam.result([1.0, 10.0]).reason


def test_a_case_without_a_unique_answer_is_recorded():
    """A rigid beam on three rigid supports: its reactions are not unique where all of them act."""
    supports = [at(0, side="below"), at(1, side="below"), at(2, side="below")]
    beam = gapbeam.prepare(scene([1.0, 1.0], supports, [force(0.5, 1.0), force(1.0, 1.0)], EI=np.inf))
    cases = beam.solve([[0.0, 1.0], [1.0, 1.0]])
    assert cases.status[0] == gapbeam.Status.INDETERMINATE
    assert np.isnan(cases.reaction[0]).all()
    assert not cases.closed[0].any()


def test_far_units():
    """Scenes that are solved in other units inside."""
    big = 2.0**300
    made = scene([2.0 * big, 2.0 * big], [at(0), at(1, side="below"), at(2)], [uniform(1.0), force(big, 2.0 * big)])
    small = scene([2.0, 2.0], [at(0), at(1, side="below"), at(2)], [uniform(1.0), force(1.0, 2.0)])
    a, b = gapbeam.prepare(made).solve([1.0, 3.0]), gapbeam.prepare(small).solve([1.0, 3.0])
    assert a.reaction / big == pytest.approx(b.reaction, rel=1e-14)


def test_axial_loads_have_factors_too():
    made = scene([2.0], [at(0), at(1), {"node": 0, "direction": "axial"}],
                 [{"type": "axial", "node": 1, "F": 3.0}, uniform(1.0)])  # fmt: skip
    result = gapbeam.prepare(made).result([2.0, 1.0])
    assert result.steps[-1].reaction[2] == pytest.approx(-6.0)


def test_no_loads():
    beam = gapbeam.prepare(scene([1.0], [at(0), at(1)], []))
    assert beam.solve().status == 0
    assert beam.solve().reaction.tolist() == [0.0, 0.0]


def test_loads_of_which_rounding_leaves_nothing():
    """Beside a movement of a support: reactions to them were said to be zero, from 1e-40 on or so, where even rounding was gone."""
    supports = [at(0, stiffness=1.0, settlement=0.25), at(1, side="below", gap=0.125)]
    beam = gapbeam.prepare(scene([4.0, 4.0], supports, [force(6.609375, 1.0)], EI=0.5))
    cases = beam.solve([[1e-20], [1e-36], [1e-100], [1e-300]])
    assert cases.status.tolist() == [0, 13, 13, 13]
    assert cases.reaction[0] == pytest.approx([-0.65234375e-20, 1.65234375e-20], rel=1e-12)


def test_great_cases_leave_nothing_behind():
    """The search for one of them ended with positions that are no numbers; later cases came out with other last digits or codes."""
    beam = gapbeam.prepare({
        "beam": {"spans": [1.328125, 3.296875], "EI": 1000.0, "GA": 1000.0, "hinges": [0.171875]},
        "supports": [at(0, side="below", settlement=0.0085), at(0, side="above", gap=0.0001, settlement=0.0085), at(1), at(2)],
        "loads": [{"type": "linear", "q": [1.676, 1.682]}],
    })  # fmt: skip
    alone, after = beam.solve([-1.0]), beam.solve([[-1.9918128850552894e305], [-1.0]])
    assert (after.reaction[1] == alone.reaction).all()
    assert after.solves[1] == alone.solves


def test_trains_are_not_left_out():
    made = {**scene([4.0], [at(0), at(1)], [uniform(1.0)]), "trains": [{"axles": [[0.0, 10.0]]}]}
    with pytest.raises(gapbeam.SceneError, match="trains: cases are prepared for loads that stay where they are; leave trains out"):
        gapbeam.prepare(made)


def test_mistakes():
    beam = gapbeam.prepare(scene([1.0], [at(0), at(1)], [uniform(1.0), uniform(2.0)]))
    with pytest.raises(ValueError, match=r"expected 2 numbers a case, one for each load, got shape \(3,\)"):
        beam.solve([1.0, 2.0, 3.0])
    with pytest.raises(ValueError, match="factors: case 1, the factor of load 1 is nan; give a finite number"):
        beam.solve([[1.0, 1.0], [1.0, np.nan]])
    with pytest.raises(ValueError, match="expected one case"):
        beam.result([[1.0, 1.0]])
    with pytest.raises(gapbeam.SceneError, match="rule: expected one of block, single"):
        gapbeam.prepare(scene([1.0], [at(0), at(1)], []), rule="fast")


def test_fields_and_extremes_of_cases_are_those_of_their_results():
    for seed in range(12):
        rng = random.Random(seed)
        made = random_scene(rng, held=rng.choice((True, None)))
        made["analysis"] = {}
        for k, support in enumerate(made["supports"]):
            support["name"] = f"S{k}"
        beam = gapbeam.prepare(made)
        factors = [[rng.choice((0.0, 1.0, -1.0, 3.0)) for _ in made["loads"]] for _ in range(3)]
        moved = {f"S{rng.randrange(len(made['supports']))}": [0.01, -0.02, 0.0]} if made["supports"] else None
        x = np.linspace(0.0, sum(made["beam"]["spans"]), 9)
        for settlements in (None, moved):
            cases = beam.solve(factors, extra_settlement=settlements)
            fields, extremes = cases.at(x, side="left"), cases._pairs_of_extremes()
            for k, row in enumerate(factors):
                if cases.status[k]:
                    assert np.isnan(fields.moment[k]).all()
                    continue
                one = beam.result(row, {key: values[k] for key, values in (settlements or {}).items()})
                scale = 1e-12 * max(np.abs(row).max(initial=0.0), 1e-9) * 1e3
                assert cases.reaction[k] == pytest.approx(one.steps[-1].reaction[beam.supports], rel=1e-11, abs=scale), seed
                there = one.at(x, side="left")
                assert fields.moment[k] == pytest.approx(there.moment, rel=1e-10, abs=scale)
                assert fields.shear[k] == pytest.approx(there.shear, rel=1e-10, abs=scale)
                for name in () if one.steps[-1].indifferent else ("deflection", "rotation"):
                    assert getattr(fields, name)[k] == pytest.approx(getattr(there, name), rel=1e-9, abs=1e-12), name
                largest = one.extremes["shear"]["max"].value
                assert extremes["shear"]["max"][0][k] == pytest.approx(largest, rel=1e-11, abs=scale)
                for name, field in one._pairs_of_extremes().items():
                    if name in ("deflection", "rotation") and one.steps[-1].indifferent:
                        continue
                    size = 1e-11 * max(abs(extreme) for extreme, _ in field.values())
                    for kind, (extreme, place) in field.items():
                        value, at = (numbers[k] for numbers in extremes[name][kind])
                        assert value == pytest.approx(extreme, rel=0, abs=max(size, scale * (name in ("moment", "shear")), 1e-15))
                        # Where it is said to be it is, on one side or the other
                        there = [getattr(one.at(at, side=side), name) for side in ("left", "right")]
                        assert min(abs(x - value) for x in there) <= max(1e3 * size, scale, 1e-14), (seed, name, place)
                if not one.steps[-1].indifferent:
                    nodes = one.at(beam.node_x)
                    assert cases.deflection[k] == pytest.approx(nodes.deflection, rel=1e-9, abs=1e-12)
                    assert cases.moment_right[k, :-1] == pytest.approx(nodes.moment[:-1], rel=1e-10, abs=scale)
                    left = one.at(beam.node_x, side="left").moment[1:]
                    assert cases.moment_left[k, 1:] == pytest.approx(left, rel=1e-10, abs=scale)
                    assert cases.moment_left[k, 0] == cases.moment_right[k, -1] == 0.0


@pytest.mark.parametrize(("short", "factor"), [(1e-9, 1.0), (1e-6, -2.0), (1.0, 1e-150), (1.0, 1e150), (1.0, 0.0)])
def test_extremes_where_digits_or_range_are_short(short, factor):
    """Then the whole case is solved once more."""
    made = scene([5.0, short, 5.0], [at(0), at(1, side="below"), at(2, side="below"), at(3)], [uniform(1.0), force(2.0, 7.0)])
    cases = gapbeam.prepare(made).solve([[factor, 0.5 * factor], [1.0, 1.0]])
    extremes, states = cases._pairs_of_extremes(), cases._combined()
    for name, field in extremes.items():
        for row, kind in enumerate(("max", "min")):
            values = states.extremes[:, FIELDS.index(name)]
            assert field[kind][0] == pytest.approx(values[:, row], rel=1e-12, abs=0.0), name
            assert np.abs(field[kind][0] - values[:, row]).max() <= 1e-12 * np.abs(values).max(), name


def test_movements_of_cases_are_checked():
    beam = gapbeam.prepare(scene([2.0], [at(0, name="A"), at(1)], [uniform(1.0)]))
    assert beam.solve([1.0], extra_settlement={"A": 0.5}).deflection[0] == 0.5
    with pytest.raises(gapbeam.SceneError, match=r'extra_settlement\.C: there is no support "C"'):
        beam.solve(extra_settlement={"C": 1.0})
    assert beam.solve(extra_settlement={"A": [1.0, 2.0]}).deflection[:, 0].tolist() == [1.0, 2.0]
    with pytest.raises(ValueError, match=r"extra_settlement\.A: expected a finite number, or 3"):
        beam.solve([[1.0]] * 3, extra_settlement={"A": [1.0, 2.0]})


def test_movements_of_nothing_change_no_digit_of_a_case():
    """Beside cases with movements, supports at one place are solved in another way: so is a case whose movements are all 0."""
    supports = [at(0, side="below"), at(0, side="above", gap=0.01), at(1, side="below"), at(2)]
    beam = gapbeam.prepare(scene([2.9, 3.3], supports, [uniform(1.7), force(0.7, 3.1)]))
    rng = np.random.default_rng(3)
    factors, moves = rng.uniform(-1.0, 2.0, (40, 2)), rng.uniform(-0.1, 0.1, 40) * (np.arange(40) % 2)
    cases = beam.solve(factors, extra_settlement={2: moves})
    for k in range(0, 40, 2):
        assert (beam.solve(factors[k], extra_settlement={2: 0.0}).reaction == cases.reaction[k]).all()


def test_cases_are_those_that_were_solved():
    beam = gapbeam.prepare(scene([2.0], [at(0), at(1)], [uniform(1.0)]))
    factors = np.array([[1.0], [2.0]])
    cases = beam.solve(factors)
    factors[:] = 5.0
    assert cases.at(1.0).moment.tolist() == [0.5, 1.0]


def test_supports_vary_by_case():
    """Against scenes of their own, to the last digit; supports by laws, two at a place and on ground by another way."""
    plain = [at(0), at(1, side="below", gap=0.01, name="pier"), at(2, side="above", stiffness=40.0), at(3, side="below")]
    loads = [uniform(3.0), force(4.0, 10.0)]
    others = {
        "law": [at(0), at(1, side="below", law=[(0.1, 5.0), (0.3, 8.0)]), at(2), at(3, side="below")],
        "pair": [at(0), at(1, side="below", gap=0.01), at(1, side="above", gap=0.01), at(3, side="below", stiffness=70.0)],
    }
    rng = np.random.default_rng(5)
    for kind, supports in {"plain": plain, **others}.items():
        made = scene([2.0, 3.0, 2.0], supports, loads)
        beam = gapbeam.prepare(made)
        factors = rng.uniform(-2.0, 5.0, (6, 2))
        sides = np.array([one.get("side", "both") != "both" for one in supports])
        gap = rng.uniform(0.0, 0.05, (6, 4)) * sides
        settlement = rng.uniform(-0.02, 0.02, 6)
        given = {"gap": gap, "settlement": {0: settlement, "3": 0.01}}
        if kind != "law":
            given["stiffness"] = {3: rng.uniform(10.0, 200.0, 6)}
        cases = beam.solve(factors, **given)
        for k, row in enumerate(factors):
            own = [dict(one, gap=gap[k, i]) for i, one in enumerate(supports)]
            own[0]["settlement"], own[3]["settlement"] = settlement[k], 0.01
            if kind != "law":
                own[3]["stiffness"] = given["stiffness"][3][k]
            direct = gapbeam.prepare(scene([2.0, 3.0, 2.0], own, loads)).solve(row)
            tolerance = 0 if kind == "plain" else 1e-13
            assert cases.status[k] == direct.status
            assert cases.closed[k].tolist() == direct.closed.tolist()
            for name in ("reaction", "deflection", "moment_left", "moment_right"):
                assert getattr(cases, name)[k] == pytest.approx(getattr(direct, name), rel=tolerance, abs=tolerance), (kind, name)
            one = {key: values[k] if key == "gap" else {i: np.broadcast_to(v, 6)[k] for i, v in values.items()}
                   for key, values in given.items()}  # fmt: skip
            full = beam.result(row, **one)
            assert full.steps[-1].reaction == pytest.approx(cases.reaction[k], rel=1e-12, abs=1e-12)
            assert cases.at([1.0]).moment[k] == pytest.approx(full.at([1.0]).moment, rel=1e-12)
    beam = gapbeam.prepare(scene([2.0, 3.0, 2.0], plain, loads))
    assert beam.solve(settlement={"pier": [0.0, 0.1]}).reaction.shape == (2, 4)
    assert np.array_equal(beam.solve(settlement={0: 0.1}).reaction, beam.solve(extra_settlement={0: 0.1}).reaction)


@pytest.mark.parametrize("supports", [[at(0), at(1)], [at(0), at(0, side="above", gap=1.0), at(1)]])
def test_no_cases(supports):
    beam = gapbeam.prepare(scene([1.0], supports, [uniform(1.0)]))
    for cases in (beam.solve(np.zeros((0, 1))), beam.solve(gap={0: []})):
        assert cases.reaction.shape == (0, len(supports))
        assert cases.at([0.2, 0.4, 0.6]).moment.shape == (0, 3)
        assert cases.extremes["moment"]["max"].value.shape == cases._combined().status.shape == (0,)


def test_great_factors_are_no_infinite_ones(recwarn):
    beam = gapbeam.prepare(scene([1.0], [at(0), at(1)], [uniform(1.0), uniform(-1.0)]))
    assert beam.solve([[1e308, 1e308]]).status == [0]
    assert not recwarn.list


def test_mistakes_in_supports_by_case():
    supports = [at(0), at(1, side="below", name="pier"), at(2, side="below", stiffness=0.0)]
    beam = gapbeam.prepare(scene([1.0, 1.0], supports, [uniform(1.0)]))
    for given, words in (
        ({"gap": {"pier": [0.0, np.nan]}}, 'case 1, supports "pier".gap: expected a finite number; got nan'),
        ({"gap": [0.1, 0.0, 0.0]}, r'case 0, supports\[0\].gap: only a support with side = "below" or "above" has a gap; got 0.1'),
        ({"stiffness": {1: [1.0, 0.0]}}, 'case 1, supports "pier".stiffness: expected a number above 0'),
        ({"stiffness": {2: 1.0}}, r"case 0, supports\[2\].stiffness: the prepared scene has stiffness = 0 here"),
        ({"settlement": {"peer": 1.0}}, 'settlement.peer: there is no support "peer"'),
        ({"gap": np.zeros((2, 2))}, r"gap: expected 3 numbers, one for each support, or 2 rows of them, .* got shape \(2, 2\)"),
        ({"gap": {1: 0.0, "pier": 0.1}}, "gap: a support stands there twice"),
        ({"gap": {np.int64(7): 0.0}}, "gap.7: there is no support 7; their numbers go from 0 to 2"),
        ({"gap": {1.0: 0.0}}, 'gap."1.0": expected the name of a support, or its number from 0, got 1.0'),
        ({"gap": {None: 0.0}}, "gap.None: expected the name of a support, or its number from 0, got None"),
        ({"extra_settlement": {True: 0.0}}, "extra_settlement.True: expected the name of a support, or its number from 0"),
    ):
        with pytest.raises(ValueError, match=words):
            beam.solve(**given)


@pytest.mark.parametrize("varied", [{}, {"settlement": {0: 0.001}}])
def test_reactions_beside_a_support_that_never_carries_and_a_law_of_two_pieces(varied):
    """As many breakpoints as supports, and yet not one of each."""
    supports = [at(0), at(1, side="below", stiffness=0.0), at(2, side="below"), at(3)]
    for law in ([[0.01, 50.0], [0.02, 60.0]], [[0.01, 50.0], [0.02, 60.0], [1.0, 70.0]]):
        supports[2]["law"] = law
        beam = gapbeam.prepare(scene([2.0, 3.0, 5.0], supports, [uniform(10.0)], EI=1e4))
        for factors in ([1.0], [[1.0], [2.0]]):
            cases = beam.solve(factors, **varied)
            (first,) = np.atleast_2d(cases.reaction)[:1]
            expected = beam.result([1.0], **varied).steps[-1].reaction
            assert first == pytest.approx(expected, rel=1e-12, abs=1e-12 * 50.0)
            assert np.atleast_2d(cases.closed)[0].tolist() == [1, 0, 1, 1]
