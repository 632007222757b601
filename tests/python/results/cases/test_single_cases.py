"""One case in a call, only what is wanted, and cases that are filled again: the same numbers by the shortest way."""

import pickle
from concurrent.futures import ThreadPoolExecutor

import gapbeam
import numpy as np
import pytest
from scenes import at, force, scene, uniform

NAMES = ("status", "closed", "reaction", "deflection", "moment_left", "moment_right", "solves")
SPANS = [2.0, 3.0, 2.0]
LOADS = [uniform(3.0), force(4.0, 10.0), {**uniform(1.0), "to": 3.0}]
PLAIN = [at(0), at(1, side="below", gap=0.01, name="pier"), at(2, side="above", stiffness=40.0), at(3, side="below")]
KINDS = {
    "lanes": PLAIN,
    "restrained": [at(0, side="below", rotation=50.0), *PLAIN[1:]],  # one by one in the engine
    "floating": [at(1, side="below"), at(2, side="below")],  # tips under some loads
    "law": [at(0), at(1, side="below", law=[(0.1, 5.0), (0.3, 8.0)]), *PLAIN[2:]],
    "pair": [at(0), at(1, side="below"), at(1, side="above", gap=0.01), at(3)],
}


def same(one, many, k, names=NAMES):
    """Whether a case has the bits of a row."""
    return all(np.array_equal(getattr(one, name), getattr(many, name)[k], equal_nan=True) for name in names)


@pytest.mark.parametrize("kind", KINDS)
def test_one_case_has_the_bits_of_many(kind):
    beam = gapbeam.prepare(scene(SPANS, KINDS[kind], LOADS))
    rng = np.random.default_rng(11)
    rows = rng.uniform(-2.0, 5.0, (40, 3))
    supports = KINDS[kind]
    gaps = rng.uniform(0.0, 0.02, (40, len(supports))) * [one.get("side", "both") != "both" for one in supports]
    moves = rng.uniform(-0.01, 0.01, gaps.shape)
    many, moved = beam.solve(rows), beam.solve(rows, gap=gaps, settlement=moves)
    again = beam.solve(rows[0])
    for k, row in enumerate(rows):
        one = beam.solve(row)
        assert same(one, many, k)
        assert one.reaction.dtype == float
        assert one.closed.dtype == np.int32
        assert not one.reaction.flags.writeable
        assert same(beam.solve(row.tolist()), many, k)
        assert same(beam.solve(row, gap=gaps[k], settlement=moves[k]), moved, k)
        assert beam.solve(row, out=again) is again
        assert same(again, many, k)
        assert beam.solve(row, gap=gaps[k], settlement=moves[k], out=again) is again
        assert same(again, moved, k)
    solved = int(np.flatnonzero(moved.status == 0)[0])
    one = beam.solve(rows[solved], gap=gaps[solved], settlement=moves[solved])
    assert one.at([0.5, 6.0]).moment == pytest.approx(moved.at([0.5, 6.0]).moment[solved], rel=1e-12)
    assert pickle.loads(pickle.dumps(one)) == one
    assert np.array_equal(pickle.loads(pickle.dumps(one)).at(1.0).moment, one.at(1.0).moment)
    copy = pickle.loads(pickle.dumps(beam))
    assert same(copy.solve(rows[3]), many, 3)
    assert same(copy.solve(rows[3], gap=gaps[3], settlement=moves[3]), moved, 3)


def test_memory_of_results_is_used_again_only_when_nobody_has_them():
    beam = gapbeam.prepare(scene(SPANS, PLAIN, LOADS))
    rows = np.random.default_rng(6).uniform(-2.0, 5.0, (30, 3))
    given = np.asfortranarray(rows)
    kept = beam.solve(given)
    reaction, moment, extremes = kept.reaction.copy(), kept.moment_left, kept.extremes["moment"]["max"].value
    expected = moment.copy()
    given[:] = 7.0  # what was asked for stays
    address = beam.solve(rows[::-1]).reaction.ctypes.data
    assert np.array_equal(kept.reaction, reaction)
    assert np.array_equal(kept.extremes["moment"]["max"].value, extremes)
    assert beam.solve(rows).reaction.ctypes.data == address
    del kept
    for count in (30, 9, 200):
        other = beam.solve(2.0 * rows[:count])
        assert len(other.status) == min(count, 30)
        assert np.array_equal(moment, expected)
    assert np.array_equal(beam.solve(rows[:, :1] * [0.0, 0.0, 0.0]).reaction, np.zeros((30, 4)))
    assert gapbeam.prepare(scene(SPANS, PLAIN, [])).solve(np.zeros((9, 0))).reaction.shape == (9, 4)


def test_threads_share_a_prepared_beam():
    beam = gapbeam.prepare(scene(SPANS, KINDS["restrained"], LOADS))
    rows = np.random.default_rng(2).uniform(-2.0, 5.0, (400, 3))
    many = beam.solve(rows)
    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(beam.solve, rows))
    assert all(same(one, many, k) for k, one in enumerate(found))


def test_mistakes_in_one_case():
    """The shortest way says nothing itself."""
    beam = gapbeam.prepare(scene(SPANS, PLAIN, LOADS))
    out = beam.solve()
    for given, words in (
        ({"factors": np.array([1.0, np.nan, 1.0])}, "factors: the factor of load 1 is nan; give a finite number"),
        ({"factors": [1.0, 2.0]}, r"expected 3 numbers a case, one for each load, got shape \(2,\)"),
        ({"factors": "abc"}, "factors: expected numbers"),
        ({"gap": np.array([0.1, 0.0, 0.0, 0.0])}, r'case 0, supports\[0\].gap: only a support with side = "below" or "above"'),
        ({"gap": np.array([0.0, np.inf, 0.0, 0.0])}, 'case 0, supports "pier".gap: expected a finite number; got inf'),
        ({"stiffness": np.array([1.0, 0.0, 1.0, 1.0])}, 'case 0, supports "pier".stiffness: expected a number above 0'),
        ({"gap": np.zeros(3)}, r"gap: expected 4 numbers, one for each support, .* got shape \(3,\)"),
    ):
        for more in ({}, {"out": out}):
            with pytest.raises(ValueError, match=words):
                beam.solve(**given, **more)
    assert out == beam.solve()
    huge = beam.solve([1.0, 1.0, 1.0], settlement=np.array([1e308, 1e308, 0.0, 0.0]))
    assert huge == beam.solve([1.0, 1.0, 1.0], settlement={0: 1e308, 1: 1e308})


@pytest.mark.parametrize("kind", KINDS)
def test_only_what_is_wanted_is_made(kind):
    beam = gapbeam.prepare(scene(SPANS, KINDS[kind], LOADS))
    rows = np.random.default_rng(4).uniform(-2.0, 5.0, (20, 3))
    full = beam.solve(rows)
    for want, there in (("reaction", ["reaction"]), (("moment",), ["moment_left", "moment_right"]), ((), []),
                        (["deflection", "closed"], ["deflection"])):  # fmt: skip
        for factors, rest in ((rows, full), (rows[5], None)):
            cases = beam.solve(factors, want=want)
            for name in NAMES:
                if name in there or name in ("status", "closed", "solves"):
                    expected = getattr(full, name)[5] if rest is None else getattr(full, name)
                    assert np.array_equal(getattr(cases, name), expected, equal_nan=True)
                else:
                    assert not hasattr(cases, name)
            assert pickle.loads(pickle.dumps(cases)) == cases
            assert (cases == full) is False
            repr(cases)
    with pytest.raises(AttributeError, match=r"moment_left: not among what was wanted \(reaction\); name it in want="):
        _ = beam.solve(rows, want="reaction").moment_left
    with pytest.raises(ValueError, match=r"want: expected some of status, closed, .*, moment; got 'shear'"):
        beam.solve(rows, want=("reaction", "shear"))
    with pytest.raises(ValueError, match=r"want: expected some of .*; got 3"):
        beam.solve(rows, want=3)
    with pytest.raises(ValueError, match=r"extra_settlement: expected a mapping, .*; got \[1\]"):
        beam.solve(rows, extra_settlement=[1])
    with pytest.raises(ValueError, match=r"names: expected some of deflection, .*; got 'sheer'"):
        full._extremes_of(["sheer"])
    assert np.array_equal(beam.solve(rows, want="reaction").at(1.0).moment, full.at(1.0).moment, equal_nan=True)
    start = np.zeros(len(beam.supports), dtype=bool)
    for some, all_ in ((beam.solve(rows, one, want="reaction"), beam.solve(rows, one)) for one in (None, start)):
        pairs = (one._pairs_of_extremes()["moment"]["max"] for one in (some, all_))
        assert np.array_equal(*pairs, equal_nan=True)


@pytest.mark.parametrize("kind", KINDS)
def test_cases_are_filled_again(kind):
    beam = gapbeam.prepare(scene(SPANS, KINDS[kind], LOADS))
    rng = np.random.default_rng(8)
    first, second = rng.uniform(-2.0, 5.0, (2, 30, 3))
    for want in (None, "reaction"):
        out = beam.solve(first, want=want)
        reaction = out.reaction
        assert beam.solve(second, out=out) is out
        assert out == beam.solve(second, want=want)
        assert np.array_equal(out.at(1.0).moment, beam.solve(second).at(1.0).moment, equal_nan=True)
        if kind not in ("law", "pair"):
            assert np.shares_memory(reaction, out.reaction)
        assert beam.solve(first, settlement={0: 0.01}, out=out) == beam.solve(first, settlement={0: 0.01}, want=want)
        assert beam.solve(first, EI={1: 50.0}, out=out) == beam.solve(first, EI={1: 50.0}, want=want)
        assert beam.solve(first, out=out) == beam.solve(first, want=want)


def test_cases_whose_filling_was_interrupted(monkeypatch):
    """The call that was left behind may still write into their arrays."""
    beam = gapbeam.prepare(scene(SPANS, PLAIN, LOADS))
    rows = np.random.default_rng(8).uniform(-2.0, 5.0, (500, 3))
    out = beam.solve(rows)
    reaction = out.reaction

    def interrupted(*_):
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr("gapbeam.engine.calls._long_cases", interrupted)
        with pytest.raises(KeyboardInterrupt):
            beam.solve(rows, out=out)
    with pytest.raises(AttributeError, match=r"reaction: these cases were to be filled again .* solve them again"):
        _ = out.reaction
    with pytest.raises(ValueError, match="these cases were to be filled again"):
        out.at(1.0)
    assert beam.solve(rows, out=out) == beam.solve(rows)
    assert not np.shares_memory(out.reaction, reaction)


def test_cases_that_cannot_be_filled_again():
    beam = gapbeam.prepare(scene(SPANS, PLAIN, LOADS))
    other = gapbeam.prepare(scene(SPANS, PLAIN, LOADS))
    rows = np.ones((3, 3))
    for given, words in (
        ({"factors": rows, "out": beam.solve()}, "out: these are one case without an axis of cases, and there are 3 cases"),
        ({"factors": rows[:2], "out": beam.solve(rows)}, "out: these are 3 cases, and there are 2 cases to solve; give as many"),
        ({"factors": rows, "out": other.solve(rows)}, "out: these cases are of another prepared beam"),
        ({"factors": rows[0], "out": other.solve()}, "out: these cases are of another prepared beam"),
        ({"factors": rows, "want": "deflection", "out": beam.solve(rows)}, "out: of these cases deflection, .* was wanted"),
        ({"factors": rows, "out": rows}, "out: expected Cases, of this beam, got ndarray"),
        ({"factors": rows[0], "out": 3}, "out: expected Cases, of this beam, got int"),
    ):
        with pytest.raises(ValueError, match=words):
            beam.solve(**given)


@pytest.mark.parametrize("kind", KINDS)
def test_extremes_do_not_depend_on_what_was_wanted(kind):
    beam = gapbeam.prepare(scene(SPANS, KINDS[kind], LOADS))
    rows = np.random.default_rng(5).uniform(-2.0, 5.0, (20, 3))
    for given in ({}, {"settlement": {0: 0.01}}, {"EI": {1: np.linspace(0.5, 2.0, 20)}}):
        expected = beam.solve(rows, **given)._pairs_of_extremes()
        some = [beam.solve(rows, want=want, **given) for want in ("reaction", "moment", ())]
        again = beam.solve(rows, out=beam.solve(rows[::-1], **given), **given)
        for cases in (*some, again, pickle.loads(pickle.dumps(some[0]))):
            for name, found in cases._pairs_of_extremes().items():
                for sense in found:
                    assert np.array_equal(found[sense], expected[name][sense], equal_nan=True), (name, sense)


@pytest.mark.parametrize("first_order", [True, False])
@pytest.mark.parametrize("loads", [[1.0, 1.0], [[1.0, 1.0], [2.0, 1.0]]])
def test_cases_say_that_forces_along_the_beam_cannot_be_told(first_order, loads):
    """Two supports hold a beam of infinite EA along its axis, and share a force: the values along it would be none."""
    made = {"beam": {"spans": [4.0, 4.0], "EI": 1e4},
            "supports": [{"node": 0}, {"node": 1}, {"node": 2}, *({"node": i, "direction": "axial"} for i in (0, 2))],
            "loads": [{"type": "uniform", "q": 1.0}, {"type": "axial", "x": 2.0, "F": 5.0}],
            "analysis": {"first_order": first_order}}  # fmt: skip
    with pytest.raises(gapbeam.EngineError, match="cannot be told apart") as refused:
        gapbeam.solve(made)
    cases = gapbeam.prepare(made).solve(loads)
    assert not np.any(cases.ok)
    assert np.all(cases.status == refused.value.status)
    assert np.isnan(cases.reaction).all()
    assert "cannot be told apart" in cases.reason
    made["beam"]["EA"] = 1e6
    cases = gapbeam.prepare(made).solve(loads)
    assert np.all(cases.ok)
    assert np.isfinite(cases.reactions[4]).all()


def test_a_movement_of_one_case_is_shared_by_no_other():
    made = {"beam": {"spans": [4.0], "EI": 1e4}, "loads": [{"type": "uniform", "q": 1.0}],
            "supports": [{"node": 0}, {"node": 1}, *({"node": i, "direction": "axial"} for i in (0, 1))]}  # fmt: skip
    cases = gapbeam.prepare(made).solve(extra_settlement={3: [0.0, 0.001]})
    assert cases.ok.tolist() == [True, False]
    assert "cannot be told apart" in cases.reason
