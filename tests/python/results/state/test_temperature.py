"""Temperature loads beside closed forms, beside the curvatures that they impose, and what is refused."""

import random
from fractions import Fraction

import gapbeam
import numpy as np
import pytest
from gapbeam import SceneError

EI, ALPHA, DEPTH = 2.0e4, 1.2e-5, 0.6


def scene(loads, beam=None, **more):
    """Two equal spans of 6."""
    return {
        "beam": {"spans": [6.0, 6.0], "EI": EI, "alpha": ALPHA, "depth": DEPTH} | (beam or {}),
        "supports": [{"node": 0}, {"node": 1}, {"node": 2}],
        "loads": [{"type": "temperature", **load} for load in loads],
        **more,
    }


def test_warmer_below_sags_on_one_span():
    """A single span is bent without force: w = alpha gradient L^2/(8 depth) down at midspan."""
    one = scene([{"gradient": 20.0}], {"spans": [6.0]}) | {"supports": [{"node": 0}, {"node": 1}]}
    result = gapbeam.solve(one)
    assert result.at(3.0).deflection == pytest.approx(ALPHA * 20.0 / DEPTH * 36.0 / 8.0, rel=1e-14)
    assert abs(result.at(3.0).moment) < 1e-12


def test_two_spans_make_the_couple_of_the_textbook():
    """The middle support holds the sag down: M = -1.5 EI alpha gradient/depth over it, hogging."""
    result = gapbeam.solve(scene([{"gradient": 20.0}]))
    moment = -1.5 * EI * ALPHA * 20.0 / DEPTH
    assert result.at(6.0).moment == pytest.approx(moment, rel=1e-14)
    assert result.steps[-1].reaction.tolist() == pytest.approx([moment / 6, -moment / 3, moment / 6], rel=1e-13)


def test_clamped_beam_has_the_couple_without_bending():
    clamps = [{"node": 0, "rotation": "fixed"}, {"node": 2, "rotation": "fixed"}]
    result = gapbeam.solve(scene([{"gradient": 20.0}]) | {"supports": clamps})
    assert result.at(3.0).moment == pytest.approx(-EI * ALPHA * 20.0 / DEPTH, rel=1e-13)
    assert abs(result.at(3.0).deflection) < 1e-15


def test_a_support_lets_go_at_its_temperature():
    """Under its dead load the middle support carries 1.25 q L; warmer above it lets go where M/3 is as much."""
    one = scene([{"gradient": -100.0, "case": "sun"}])
    one["supports"][1]["side"] = "below"
    one["loads"].append({"type": "uniform", "q": 0.4, "case": "dead"})
    result = gapbeam.solve(one | {"analysis": {"follow": "events"}})
    opens = next(event for event in result.events if event.event == "opens")
    exact = Fraction(5, 4) * Fraction(0.4) * 6 / (Fraction(3, 2) * Fraction(EI) * Fraction(ALPHA) * 100 / Fraction(DEPTH) / 3)
    assert opens.factor == pytest.approx(float(exact), rel=1e-13)


def test_dT_alone_lengthens_a_free_beam_and_makes_no_force():
    result = gapbeam.solve(scene([{"dT": 60.0}]))
    assert not np.any(result.steps[-1].reaction)


@pytest.mark.parametrize("seed", range(200))
def test_random_scenes_are_those_of_the_curvatures(seed):
    """The kappa of every span taken by hand, in all ways of solving."""
    rng = random.Random(seed)
    n = rng.randint(1, 4)
    spans = [rng.choice([1.0, 2.5, 7.0]) for _ in range(n)]
    by_span = rng.random() < 0.5
    alpha = [rng.choice([1e-5, 1.2e-5, 3e-2]) for _ in spans] if by_span else [rng.choice([1e-5, 2e-3])] * n
    depth = [rng.choice([0.1, 0.6, 3.0]) for _ in spans] if by_span else [rng.choice([0.2, 5.0])] * n
    beam = {"spans": spans, "EI": 10.0 ** rng.randint(-2, 5)}
    ends = [sum(spans[:i]) for i in range(n + 1)]
    supports = [{"node": i, "side": rng.choice(["both", "below", "below", "above"]), "stiffness": 10.0 ** rng.randint(0, 6)}
                for i in range(n + 1)]  # fmt: skip
    supports[0]["side"] = supports[-1]["side"] = "both"
    warm, bent = [], []
    for i in range(n):
        for _ in range(rng.randint(0, 2)):
            gradient, cuts = rng.choice([-30.0, 10.0, 40.0]), sorted(rng.sample(range(5), 2))
            place = {"from": ends[i] + spans[i] * cuts[0] / 4, "to": ends[i] + spans[i] * cuts[1] / 4,
                     "case": rng.choice(["dead", "live", "sun"])}  # fmt: skip
            warm.append({"type": "temperature", "gradient": gradient, "dT": rng.choice([0.0, 9.0]), **place})
            bent.append({"type": "curvature", "kappa": -alpha[i] * gradient / depth[i], **place})
    if not warm:
        return
    more = {"supports": supports, "analysis": {"follow": rng.choice(["steps", "events"])}}
    if rng.random() < 0.4:
        factors = {"dead": rng.choice([0.9, 1.35]), "live": 1.5, "sun": rng.choice([-2.0, 0.6])}
        factors = {case: factor for case, factor in factors.items() if case in {load["case"] for load in warm}}
        more["combinations"] = [{"name": "a", "factors": factors}, {"name": "b", "factors": {warm[0]["case"]: 1.0}}]
    keys = {"alpha": alpha if by_span else alpha[0], "depth": depth if by_span else depth[0]}
    found = gapbeam.solve({"beam": beam | keys, "loads": warm, **more})
    other = gapbeam.solve({"beam": beam, "loads": bent, **more})
    names = ["a", "b"] if "combinations" in more else [None]
    for name in names:
        steps = [(one.combinations[name] if name else one).steps for one in (found, other)]
        assert len(steps[0]) == len(steps[1])
        for a, b in zip(*steps, strict=True):
            assert np.allclose(a.reaction, b.reaction, rtol=1e-12, atol=1e-12 * np.abs(b.reaction).max(initial=0.0))


def test_cases_in_a_table_vary_the_gradient(tmp_path):
    one = scene([{"gradient": 20.0}, {"gradient": 1.0, "to": 6.0, "case": "dead"}])
    one["supports"][1]["side"] = "below"
    table = {"loads[0].gradient": [-20.0, 5.0, 30.0], "factors.dead": [1.0, 2.0, -1.0], "loads[0].dT": [0.0, 1.0, 2.0]}
    found = gapbeam.batch(one, table, tmp_path / "out", want="reaction").read()
    for k in range(3):
        loads = [{"gradient": table["loads[0].gradient"][k]},
                 {"gradient": table["factors.dead"][k], "to": 6.0, "case": "dead"}]  # fmt: skip
        alone = scene(loads)
        alone["supports"][1]["side"] = "below"
        expected = gapbeam.solve(alone).steps[-1].reaction.tolist()
        got = [found[f"reaction.{i}"][k] for i in range(3)]
        assert got == pytest.approx(expected, rel=1e-12, abs=1e-12)


@pytest.mark.parametrize(("loads", "beam", "words"), [
    ([{"gradient": 1.0}], {"alpha": None}, "beam.alpha: this key is missing; loads[0] with a temperature needs it"),
    ([{"gradient": 1.0}], {"depth": None}, "beam.depth: this key is missing"),
    ([{"gradient": float("inf")}], {}, "loads[0].gradient: expected a finite number, got inf"),
    ([{"dT": float("nan")}], {}, "loads[0].dT: expected a finite number, got nan"),
    ([{"gradient": 1.0}], {"alpha": [1e-5, 2e-5]}, "loads[0]: beam.alpha changes along it, at x = 6; give a load for each part"),
    ([], {"alpha": [1e-5]}, "beam.alpha: has 1 value for 2 spans"),
    ([], {"depth": 0.0}, "beam.depth: expected a finite number above 0, got 0"),
    ([], {"depth": [1.0, -1.0]}, "beam.depth[1]: expected a finite number above 0, got -1"),
])  # fmt: skip
def test_what_makes_no_sense_is_refused(loads, beam, words):
    one = scene(loads, beam)
    one["beam"] = {key: value for key, value in one["beam"].items() if value is not None}
    with pytest.raises(SceneError) as refused:
        gapbeam.read_scene(one)
    assert words in str(refused.value)


def test_pictures_and_pages_take_it(tmp_path):
    one = scene([{"gradient": 20.0, "dT": 5.0}])
    result = gapbeam.solve(one)
    result.plot(path=tmp_path / "one.svg")
    assert (tmp_path / "one.svg").stat().st_size
    assert "html" in result.to_html()
    bent = one | {"beam": {"spans": [6.0, 6.0], "EI": EI}, "loads": [{"type": "curvature", "kappa": -ALPHA * 20.0 / DEPTH}]}
    assert gapbeam.solve(bent).steps[-1].reaction.tolist() == result.steps[-1].reaction.tolist()
