"""Trains: events in position, exact envelopes, influence lines; beside closed forms and states solved one by one."""

import copy
import json
import pickle
from math import sqrt

import gapbeam
import numpy as np
import pytest
from gapbeam.cli import main
from gapbeam.plots import figure
from gapbeam.report import report_text, to_csv, to_json
from scenes import at, scene, uniform


def two_spans(**changes):
    """Reference problem D1."""
    made = {
        "beam": {"spans": [1.0, 1.0], "EI": 1.0},
        "supports": [{"node": i, "side": "below"} for i in range(3)],
        "loads": [{"type": "uniform", "q": 1.0, "case": "dead"}],
        "trains": [{"name": "crane", "axles": [[0.0, 8.0]], "to": 1.0}],
    }
    return {**made, **changes}


def simple(span, *axles, **train):
    """A weightless simple beam."""
    return {
        "beam": {"spans": [span], "EI": 1.0},
        "supports": [{"node": 0}, {"node": 1}],
        "trains": [{"axles": [list(axle) for axle in axles], **train}],
    }


def random_scene(rng):
    """A beam of any kind with a train."""
    count = int(rng.integers(1, 5))
    spans = rng.choice([1.0, 2.0, 2.5], count).tolist() if rng.random() < 0.5 else rng.uniform(0.5, 4, count).tolist()
    length, stiffness = sum(spans), float(10 ** rng.uniform(-1, 3))
    made = {"beam": {"spans": spans, "EI": stiffness}, "supports": [], "loads": []}
    if rng.random() < 0.2:
        made["beam"]["GA"] = stiffness * 3
    if rng.random() < 0.3 and count > 2:
        made["beam"]["hinges"] = [spans[0] + spans[1] * 0.4]
    if rng.random() < 0.3:
        made["sections"] = [{"from": length * 0.2, "to": length * 0.45, "EI": stiffness * 3}]
    overhang = rng.random() < 0.2
    for node in range(count if overhang else count + 1):
        support = {"node": node, "side": str(rng.choice(["both", "below", "above"], p=[0.25, 0.65, 0.1]))}
        if support["side"] != "both" and rng.random() < 0.5:
            support["gap"] = float(rng.uniform(-0.2, 0.5) / stiffness)
        if rng.random() < 0.5:
            support["stiffness"] = stiffness * float(10 ** rng.uniform(-1, 2))
        if support["side"] == "below" and rng.random() < 0.3:
            support.pop("stiffness", None)
            support["law"] = [[0.05 / stiffness, 1.0], [0.25 / stiffness, 2.0]]
        made["supports"].append(support)
    made["loads"].append({"type": "uniform", "q": float(rng.uniform(0.2, 3)), "case": "dead"})
    if rng.random() < 0.4:
        made["loads"].append({"type": "linear", "from": length * 0.1, "to": length * 0.6, "q": [0.5, -1.0]})
    distances = np.concatenate([[0], np.cumsum(rng.choice([0.5, 1.0, 1.3], int(rng.integers(0, 3))))]).tolist()
    train = {"axles": [[d, float(rng.uniform(1, 10))] for d in distances], "both_directions": bool(rng.random() < 0.3)}
    if rng.random() < 0.4:
        q = float(rng.uniform(0.5, 4))
        train |= {"q": q if distances[-1] else [[0.0, 1.0, q]], "factor": 1.25}
    if rng.random() < 0.3:
        train["q"] = [[-0.7, 1.0, float(rng.uniform(0.5, 4))], [float(rng.choice([0.5, 1.0, 1.7])), 3.0, float(rng.uniform(-1, 4))]]
    return {**made, "trains": [train]}


def test_d1():
    train = gapbeam.solve(two_spans()).trains["crane"]
    assert [(event.support, event.event) for event in train.events] == [(2, "opens"), (2, "closes")]
    assert [event.position for event in train.events] == pytest.approx([0.194903920083, 0.888199776858], abs=1e-12)
    envelope = train.envelope()
    lifted = envelope.supports[2]["opening"]["max"]
    assert lifted.value == pytest.approx(0.26320023928, abs=1e-11)
    assert lifted.position == pytest.approx(1 / sqrt(3), abs=1e-12)
    rise = envelope.extremes["deflection"]["min"]
    assert (rise.x, rise.value) == pytest.approx((2.0, -lifted.value), rel=1e-14)
    state = train.state(0.5)
    assert state.reaction == pytest.approx([4.0, 6.0, 0.0], rel=1e-14)
    assert state.fields(0.5).moment == pytest.approx(4.0 * 0.5 - 0.125, rel=1e-14)
    assert state.certificate["error_bound_reaction"] < 1e-13
    # The unloaded far end stays on its support where the force is small
    small = gapbeam.solve(two_spans(trains=[{"axles": [[0.0, 9 * sqrt(3) / 4 - 1e-6]]}]))
    assert small.trains["train 1"].events == []


def test_influence_lines_of_two_spans():
    train = gapbeam.solve(two_spans()).trains["crane"]
    at = np.array([0.0, 0.25, 0.5, 1.0])
    middle = train.influence("reaction", x=1.0, position=0.05, places=at)
    assert middle.values == pytest.approx(at * (3 - at**2) / 2, abs=1e-14)
    support = train.influence("moment", x=1.0, position=0.05, places=at)
    assert support.values == pytest.approx(-at * (1 - at**2) / 4, abs=1e-14)
    # With the end lifted the first span is a simple beam
    moment = train.influence("moment", x=0.5, position=0.5, places=[0.25, 0.5, 1.5])
    assert moment.values == pytest.approx([0.125, 0.25, -0.25], abs=1e-14)
    shear = train.influence("shear", x=0.5, position=0.5, places=[0.25, 0.75])
    assert shear.values == pytest.approx([-0.25, 0.25], abs=1e-14)


def test_influence_lines_of_couples():
    """A propped cantilever, clamped at the left: x (L - x) (2 L - x)/(2 L**2) against the clock; at a spring a share of it."""
    places = np.array([0.0, 0.5, 1.0, 2.5, 4.0])
    clamp = -places * (4.0 - places) * (8.0 - places) / 32.0
    supports = [{"node": 0, "rotation": "fixed"}, {"node": 1, "side": "below"}]
    trains = [{"axles": [[0.0, 1.0]]}]
    asked = {"x": 0.0, "position": 2.0, "places": places}
    made = {"beam": {"spans": [4.0], "EI": 2.0}, "supports": supports, "trains": trains}
    assert gapbeam.solve(made).trains["train 1"].influence("couple", **asked).values == pytest.approx(clamp, abs=1e-14)
    # A rotational spring c: the end turns under a unit couple by L/3EI, beside the spring's own 1/c
    supports[0] = {"node": 0, "rotation": 3.0}
    shared = clamp * (4.0 / 6.0) / (4.0 / 6.0 + 1.0 / 3.0)
    train = gapbeam.solve(made).trains["train 1"]
    assert train.influence("couple", **asked).values == pytest.approx(shared, abs=1e-14)
    state = gapbeam.solve({**made, "trains": [], "loads": [{"type": "force", "x": 2.5, "F": 1.0}]})
    assert state.steps[-1].couple[0] == pytest.approx(shared[3], abs=1e-14)
    # The same on what is followed position by position
    supports[1] |= {"law": {"type": "tanh", "stiffness": 1e9, "limit": 1e9}}
    train = gapbeam.solve(made).trains["train 1"]
    assert train.influence("couple", **asked).values == pytest.approx(shared, abs=1e-8)
    with pytest.raises(ValueError, match=r"x: the support at x = 4 lets the beam rotate freely; with rotation it has a couple"):
        train.influence("couple", x=4.0, position=2.0)
    with pytest.raises(ValueError, match=r"x: there is no support at x = 3"):
        train.influence("couple", x=3.0, position=2.0)


def test_largest_moments_of_simple_beams():
    # Two equal forces at a distance d: P L/2 (1 - d/2L)**2, under either of them
    result = gapbeam.solve(simple(10.0, (0.0, 10.0), (2.0, 10.0)))
    largest = result.envelope().extremes["moment"]["max"]
    assert largest.value == pytest.approx(40.5, rel=1e-14)
    found = sorted((e.x, e.position) for e in (largest, *largest.ties))
    assert found == [pytest.approx((4.5, 6.5), rel=1e-12), pytest.approx((5.5, 5.5), rel=1e-12)]
    shear = result.envelope().extremes["shear"]
    assert (shear["max"].value, shear["min"].value) == pytest.approx((18.0, -18.0), rel=1e-14)
    curves = result.trains["train 1"].envelope(x=[2.0, 5.0]).fields
    # Influence lines: of the place 2 with ordinates 1.6 and 1.2
    assert curves.largest["moment"] == pytest.approx([28.0, 40.0], rel=1e-14)
    assert curves.smallest["moment"] == pytest.approx([0.0, 0.0], abs=1e-14)


def test_uniform_loads_between_distances():
    """Influence lines of a simple beam: of a reaction 1 - x/L, of the moment in the middle a triangle of L/4."""
    train = gapbeam.solve(simple(8.0, (1.5, 0.0), q=[[0.0, 1.0, 6.0], [2.0, 4.0, 3.0]])).trains["train 1"]
    envelope = train.envelope(x=[4.0])
    reaction = envelope.supports[0]["reaction"]["max"]
    assert (reaction.value, reaction.position) == pytest.approx(((6.0 * 4.5 + 6.0 * 7.0) / 8, 4.0), rel=1e-12)
    curves = envelope.fields
    # The same from 5 to 6: the first of these positions
    assert (curves.largest["moment"][0], curves.largest_at["moment"][0]) == pytest.approx((16.5, 5.0), rel=1e-12)
    assert train.state(4.0).reaction[0] == pytest.approx(8.625, rel=1e-14)
    assert (train.traversals[0].engine.ends[0, 0], train.traversals[0].engine.ends[-1, 1]) == (0.0, 12.0)


@pytest.mark.parametrize("both", [False, True])
def test_loads_ahead_of_the_first_axle(both):
    """The same train, seen from its first axle and from its front."""
    ahead, axles, q = 1.5, ((0.0, 8.0), (1.25, 5.0)), [[-1.5, -0.5, 6.0], [-0.25, 2.0, 3.0]]
    one = gapbeam.solve(two_spans(trains=[{"axles": axles, "q": q, "both_directions": both}])).trains["train 1"]
    behind = {"axles": [(ahead + d, force) for d, force in axles], "q": [[ahead + a, ahead + b, q] for a, b, q in q]}
    other = gapbeam.solve(two_spans(trains=[{**behind, "both_directions": both}])).trains["train 1"]
    for way, same in zip(one.traversals, other.traversals, strict=True):
        shift = ahead if way.course.direction == "right" else -ahead
        assert (way.course.from_ + shift, way.course.to + shift) == (same.course.from_, same.course.to)
    assert (one.traversals[0].course.from_, one.traversals[0].course.to) == (-1.5, 4.0)
    assert [event.event for event in one.events] == [event.event for event in other.events] != []
    found, true = one.envelope(x=np.linspace(0.0, 2.0, 9)), other.envelope(x=np.linspace(0.0, 2.0, 9))
    for name, row in true.extremes.items():
        for kind, extreme in row.items():
            assert found.extremes[name][kind].value == pytest.approx(extreme.value, rel=1e-11)
        assert found.fields.largest[name] == pytest.approx(true.fields.largest[name], rel=1e-11, abs=1e-12)


def test_a_load_that_runs_ahead():
    """Influence lines of a simple beam: the reaction of a load that fills the beam is half of it, an axle behind gives none yet."""
    train = gapbeam.solve(simple(8.0, (0.0, 5.0), q=[[-20.0, 0.0, 3.0]])).trains["train 1"]
    assert (train.traversals[0].course.from_, train.traversals[0].course.to) == (-20.0, 8.0)
    assert train.state(-6.0).reaction == pytest.approx([12.0, 12.0], rel=1e-14)
    assert train.state(-16.0).reaction == pytest.approx([9.0, 3.0], rel=1e-14)
    reaction = train.envelope().supports[0]["reaction"]["max"]
    assert (reaction.value, reaction.position) == pytest.approx((17.0, 0.0), abs=1e-12)


def test_inside_with_loads_ahead():
    made = simple(8.0, (0.0, 5.0), (1.0, 5.0), q=[[-2.0, 3.0, 3.0]], inside=True, both_directions=True)
    train = gapbeam.solve(made).trains["train 1"]
    assert [(way.course.from_, way.course.to) for way in train.traversals] == [(3.0, 6.0), (2.0, 5.0)]
    longer = gapbeam.solve(simple(8.0, (0.0, 5.0), q=[[-2.0, 6.0 * (1.0 + 1e-15), 3.0]], inside=True)).trains["train 1"]
    assert longer.traversals[0].course.from_ == longer.traversals[0].course.to == 6.0


def test_a_plank_tips(tmp_path, capsys):
    made = two_spans(
        beam={"spans": [2.0, 1.0], "EI": 1.0},
        supports=[{"node": 0, "side": "below"}, {"node": 1, "side": "below"}],
        trains=[{"name": "man", "axles": [[0.0, 5.0]]}, {"name": "back", "axles": [[0.0, 5.0]], "both_directions": True}],
    )
    result = gapbeam.solve(made)
    (gap,) = result.trains["man"].unstable_positions
    assert (gap.from_, gap.to) == pytest.approx((2.3, 3.0), rel=1e-14)
    assert "tips about the support at x = 2" in gap.reason
    assert [gap.direction for gap in result.trains["back"].unstable_positions] == ["right", "left"]
    assert result.envelope().supports[0]["reaction"]["min"].value == pytest.approx(0.0, abs=1e-13)
    assert len(result.envelope().unstable_positions) == 3
    with pytest.raises(ValueError, match=r"position: no equilibrium at position 2\.5 of train man"):
        result.trains["man"].state(2.5)
    assert "tips about" in report_text(result)
    (tmp_path / "plank.json").write_text(json.dumps(made))
    assert main(["run", str(tmp_path / "plank.json"), "--quiet"]) == 1
    assert "train man, positions 2.3 to 3: no equilibrium: the beam tips" in capsys.readouterr().err
    (tmp_path / "crane.json").write_text(json.dumps(two_spans()))
    assert main(["run", str(tmp_path / "crane.json"), "--quiet"]) == 0


@pytest.mark.parametrize("seed", range(40))
def test_nothing_is_beyond_the_envelope(seed):
    rng = np.random.default_rng(seed)
    try:
        result = gapbeam.solve(random_scene(rng))
    except gapbeam.EngineError:
        return
    train = result.trains["train 1"]
    envelope = train.envelope(x=np.linspace(0.0, result.scene.span_ends()[-1], 5))
    curves = envelope.fields
    for way in train.traversals:
        passage, course = way.engine, way.course
        assert (passage.ends[1:, 0] == passage.ends[:-1, 1]).all()
        for position in (course.from_, course.to, *rng.uniform(course.from_, course.to, 12)):
            which = np.flatnonzero((passage.ends[:, 0] <= position) & (position <= passage.ends[:, 1]))
            try:
                state = train.state(position, course.direction)
            except ValueError:
                assert (passage.status[which] != 0).any()
                continue
            if (passage.status[which] != 0).any() or state.indifferent:
                continue
            if len(which) == 1:
                decided = state.solution.undecided == 0
                assert (passage.closed[which[0]] == state.solution.closed)[decided].all()
            fields, extremes = state.fields(curves.x), state.result._pairs_of_extremes()
            for name, row in envelope.extremes.items():
                slack = 1e-11 * max(abs(row["max"].value), abs(row["min"].value))
                assert row["min"].value - slack <= extremes[name]["min"][0]
                assert extremes[name]["max"][0] <= row["max"].value + slack
                assert (curves.smallest[name] - slack <= getattr(fields, name)).all()
                assert (getattr(fields, name) <= curves.largest[name] + slack).all()
            for k, row in enumerate(envelope.supports):
                slack = 1e-11 * max(abs(e.value) for e in row["reaction"].values())
                assert row["reaction"]["min"].value - slack <= state.reaction[k] <= row["reaction"]["max"].value + slack
    for name, row in envelope.extremes.items():
        for kind, extreme in row.items():
            if extreme is None:
                continue
            state = train.state(extreme.position, extreme.direction)
            if state.indifferent:  # where it begins to move its position is not unique
                continue
            found = state.extremes[name][kind].value
            assert found == pytest.approx(extreme.value, rel=1e-10, abs=1e-11 * abs(row["max"].value))


def test_ranges_of_positions():
    def ends(**train):
        way = gapbeam.solve(simple(10.0, (0.0, 1.0), (2.0, 1.0), **train)).trains["train 1"].traversals[-1]
        return way.engine.ends[0, 0], way.engine.ends[-1, 1]

    assert ends() == (0.0, 12.0)
    assert ends(both_directions=True) == (-2.0, 10.0)
    assert ends(inside=True) == (2.0, 10.0)
    assert ends(inside=True, both_directions=True) == (0.0, 8.0)
    assert ends(**{"from": 1.0, "to": 3.0}) == (1.0, 3.0)
    assert ends(**{"from": 1.0, "to": 3.0, "inside": True}) == (2.0, 3.0)
    assert ends(**{"from": 5.0, "to": 5.0}) == (5.0, 5.0)


def test_axles_at_the_ends_act():
    # Both axles act only at position 10.0; an axle enters the beam, or leaves it, at once
    result = gapbeam.solve(simple(10.0, (0.0, 3.0), (10.0, 4.0)))
    supports = result.envelope().supports
    assert (supports[0]["reaction"]["max"].value, supports[1]["reaction"]["max"].value) == pytest.approx((4.0, 4.0))
    train = result.trains["train 1"]
    assert train.state(10.0).reaction == pytest.approx([4.0, 3.0])
    assert train.state(10.0 - 1e-9).reaction == pytest.approx([0.0, 3.0], abs=1e-8)
    assert train.state(10.0 + 1e-9).reaction == pytest.approx([4.0, 0.0], abs=1e-8)


def test_pickled():
    result = gapbeam.solve(two_spans())
    envelope = result.envelope()
    for again in (pickle.loads(pickle.dumps(result)), copy.deepcopy(result)):
        assert again == result
        assert again.trains["crane"].events == result.trains["crane"].events
        assert again.envelope().extremes == envelope.extremes
    assert pickle.loads(pickle.dumps(envelope)).fields == envelope.fields


@pytest.mark.parametrize("power", [-200, -40, 40, 200])
def test_any_units(power):
    """The same in other units of force: all forces and stiffnesses times a power of two."""
    factor = 2.0**power
    made = two_spans(
        beam={"spans": [1.0, 1.0], "EI": factor},
        loads=[{"type": "uniform", "q": factor, "case": "dead"}],
        trains=[{"name": "crane", "axles": [[0.0, 8.0 * factor]], "to": 1.0}],
    )
    train, other = gapbeam.solve(made).trains["crane"], gapbeam.solve(two_spans()).trains["crane"]
    assert [e.position for e in train.events] == pytest.approx([e.position for e in other.events], rel=1e-13)
    moment, same = (t.envelope().extremes["moment"]["max"] for t in (train, other))
    assert (moment.value / factor, moment.x) == pytest.approx((same.value, same.x), rel=1e-13)


def test_outputs():
    result = gapbeam.solve(two_spans())
    data = json.loads(to_json(result))
    (train,) = data["trains"]
    assert [event["event"] for event in train["events"]] == ["opens", "closes"]
    assert data["envelope"]["supports"][2]["opening"]["max"][1]["train"] == "crane"
    value, x, source = data["envelope"]["extremes"]["moment"]["max"]
    assert (value, x, source["position"]) == pytest.approx((32 / 17, 8 / 17, 8 / 17), rel=1e-12)
    assert len(data["envelope"]["fields"]["x"]) == len(data["envelope"]["fields"]["moment"]["max"])
    assert "What governs" in report_text(result)
    assert ",shear_max,shear_min," in to_csv(result).splitlines()[0]
    assert len(figure(result).axes) == 4


@pytest.mark.parametrize(
    ("train", "message"),
    [
        ({"axles": []}, r"trains\[0\]\.axles: has no axle"),
        ({"axles": [[-1.0, 1.0]]}, r"trains\[0\]\.axles\[0\]\[0\]: expected a distance .* got -1"),
        ({"axles": [[0.0, float("inf")]]}, r"trains\[0\]\.axles\[0\]\[1\]: expected a finite number, got inf"),
        ({"axles": [[0.0, 1.0], [5.0, 1.0]], "inside": True}, r"trains\[0\]\.inside: the train has a length of 5"),
        ({"axles": [[0.0, 1.0]], "from": 2.0, "to": 1.0}, r"trains\[0\]\.to: the positions from 2 to 1 are none"),
        ({"axles": [[0.0, 1.0]], "together": "b"}, r"trains\[0\]\.together: expected a list of pairs of a text in quotes and a"),
        ({"axles": [[0.0, 1.0]], "together": [["b", 1.0]]}, r"trains\[0\]\.together: stands beside axles"),
        ({"together": [["b", 1.0]]}, r'trains\[0\]\.together\[0\]\[0\]: there is no train "b"; the names are "train 1"'),
        ({"together": [["train 1", 1.0]]}, r"trains\[0\]\.together\[0\]\[0\]: .* is made of others itself"),
        ({"together": [["b", [1.0, 2.0]]]}, r"trains\[0\]\.together\[0\]\[1\]: expected one distance, got \[1\.0, 2\.0\]: where"),
        ({"together": [["b", -1.0]]}, r"trains\[0\]\.together\[0\]\[1\]: expected a distance .* got -1"),
        ({"together": [["b", 1.0]], "q": 2.0}, r"trains\[0\]\.q: a train made of others has the uniform loads"),
        ({"axles": [[0.0, 1.0]], "q": [[2.0, 1.0, 5.0]]}, r"trains\[0\]\.q\[0\]: the distances from 2 to 1 are no stretch"),
        ({"axles": [[0.0, 1.0]], "q": 5.0}, r"trains\[0\]\.q: 5 acts over the length of the train, which is 0: .* \[\[from, to"),
        ({"axles": [[0.0, 1.0]], "q": [[float("-inf"), 1.0, 5.0]]}, r"trains\[0\]\.q\[0\]\[0\]: expected a finite .* -inf"),
        ({"axles": [[0.0, 1.0]], "q": [[-2.0, 1.0, 5.0]], "inside": True}, r"trains\[0\]\.inside: the train has a length of 3"),
        ({"axles": [[0.0, 1.0]], "q": "5"}, r'trains\[0\]\.q: expected a number or a list of lists of three numbers, got "5"'),
        ({"axles": [[0.0, 1.0]], "unfavourable": True}, r"trains\[0\]\.unfavourable: axles only where"),
    ],
)
def test_refusals(train, message):
    with pytest.raises(gapbeam.SceneError, match=message):
        gapbeam.solve(two_spans(trains=[train]))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"supports": [{"node": 0}, {"node": 1, "side": "below", "law": {"type": "plastic", "stiffness": 1.0, "limit": 1.0}}]},
         "supports: supports whose state depends on the loading history cannot be combined with trains"),
    ],
)  # fmt: skip
def test_what_trains_cannot_go_over(change, message):
    with pytest.raises(gapbeam.SceneError, match=message):
        gapbeam.solve(two_spans(**change))


def loads_of(train, position, direction, end):
    """A train as loads, by hand; uniform loads as stretches."""
    sign, found = {"right": -1.0, "left": 1.0}[direction], []
    for distance, force in train["axles"]:
        x = position + sign * distance
        if -1e-9 <= x <= end + 1e-9:
            found.append({"type": "force", "x": min(max(x, 0.0), end), "F": train.get("factor", 1.0) * force})
    q = train.get("q", 0.0)
    for first, last, value in q if isinstance(q, list) else [(0.0, max(d for d, _ in train["axles"]), q)]:
        low, high = sorted((position + sign * first, position + sign * last))
        low, high = max(low, 0.0), min(high, end)
        if high - low > 1e-9:
            found.append({"type": "uniform", "q": train.get("factor", 1.0) * value, "from": low, "to": high})
    return found


@pytest.mark.parametrize("seed", range(8))
def test_together(seed):
    """Trains together are one train with all their axles and uniform loads; beside their loads put on by hand."""
    rng = np.random.default_rng(seed)
    made, other = random_scene(rng), random_scene(rng)["trains"][0]
    if seed % 2:
        other["q"] = [[-0.5, 2.0, 3.0], [1.5, 4.0, float(rng.uniform(-1, 2))]]
    (one,), behind, both = made["trains"], float(rng.choice([1.0, 2.5, rng.uniform(0, 4)])), bool(seed % 3)
    made["trains"] = [one, other, {"name": "both", "together": [["train 1", 0.0], ["train 2", behind]], "factor": 1.5,
                                   "both_directions": both}]  # fmt: skip
    axles, q = [], []
    for train, d in ((one, 0.0), (other, behind)):
        factor, given = train.get("factor", 1.0), train.get("q", 0.0)
        axles += [[d + at, factor * P] for at, P in train["axles"]]
        stretches = given if isinstance(given, list) else [[0.0, max(at for at, _ in train["axles"]), given]]
        q += [[d + first, d + last, factor * value] for first, last, value in stretches if first < last]
    merged = {"axles": axles, "q": q, "factor": 1.5, "both_directions": both}
    try:
        together = gapbeam.solve(made).trains["both"]
        alone = gapbeam.solve({**made, "trains": [merged]}).trains["train 1"]
    except gapbeam.EngineError:
        return
    assert together.events == alone.events
    assert together.unstable_positions == alone.unstable_positions
    envelope = together.envelope()
    for name, row in alone.envelope().extremes.items():
        assert {kind: e and e.value for kind, e in row.items()} == {k: e and e.value for k, e in envelope.extremes[name].items()}
    for way in together.traversals:
        course, end = way.course, float(gapbeam.read_scene(made).span_ends()[-1])
        for position in rng.uniform(course.from_, course.to, 6):
            loads = [*made["loads"], *loads_of(merged, position, course.direction, end)]
            state = gapbeam.solve({**made, "loads": loads, "trains": []})
            if state.status != "solved" or state.steps[-1].indifferent:
                continue
            there = together.state(position, course.direction).reaction
            assert there == pytest.approx(state.steps[-1].reaction, rel=1e-9, abs=1e-9)
            for name, row in state._pairs_of_extremes().items():
                found = envelope.extremes[name]
                slack = 1e-10 * max(abs(found["max"].value), abs(found["min"].value))
                assert found["min"].value - slack <= row["min"][0] <= row["max"][0] <= found["max"].value + slack


def test_together_in_combinations():
    """It acts by its own case, with the axles and factors of its members whatever their cases are."""
    trains = [{"name": "a", "axles": [[0.0, 8.0]], "factor": 0.5, "case": "a"}, {"name": "b", "axles": [[0.0, 2.0]], "case": "b"},
              {"name": "ab", "together": [["a", 0.0], ["b", 0.5]], "case": "ab"}]  # fmt: skip
    made = two_spans(trains=trains, combinations=[{"name": "both", "factors": {"dead": 1.0, "ab": 2.0}}])
    both = gapbeam.solve(made).combinations["both"]
    assert list(both.trains) == ["ab"]
    alone = gapbeam.solve(two_spans(trains=[{"axles": [[0.0, 8.0], [0.5, 4.0]]}])).trains["train 1"]
    assert both.trains["ab"].events == alone.events
    assert both.trains["ab"].state(0.75).reaction.tolist() == alone.state(0.75).reaction.tolist()


@pytest.mark.parametrize("seed", range(4))
def test_axial_loads_do_not_meet_trains(seed):
    """Bending is as without them; axial supports and fields are at every position what they are without a train."""
    rng = np.random.default_rng(seed)
    made = random_scene(rng)
    plain = gapbeam.solve(made).trains["train 1"]
    length = sum(made["beam"]["spans"])
    made["beam"]["EA"] = 50.0
    made["supports"].append({"node": 0, "direction": "axial", "settlement": 0.01})
    made["supports"].append({"x": length, "direction": "axial", "stiffness": 9.0})
    made["loads"].append({"type": "axial", "x": length / 4, "F": 3.0})
    made["analysis"] = {**made.get("analysis", {}), "first_order": True}
    result = gapbeam.solve(made)
    train, count = result.trains["train 1"], len(made["supports"]) - 2
    assert [(e.support, e.event) for e in train.events] == [(e.support, e.event) for e in plain.events]
    assert [e.position for e in train.events] == pytest.approx([e.position for e in plain.events], rel=1e-12)
    for name, row in plain.envelope().extremes.items():
        found = train.envelope().extremes[name]
        assert [found[k].value for k in found] == pytest.approx([row[k].value for k in row], rel=1e-12)
    give = length / 50.0
    right = (0.01 + 3.0 * give / 4) / (give + 1 / 9.0)  # the spring at the right end carries what the rest moves there
    for k, value in ((count, right - 3.0), (count + 1, -right)):
        reaction = train.envelope().supports[k]["reaction"]
        assert [reaction[kind].value for kind in ("max", "min")] == pytest.approx([value, value], rel=1e-12)
    state = train.state(plain.traversals[0].course.to / 2)
    assert state.fields(length * 0.9).axial_force == pytest.approx(-right, rel=1e-12)


def test_positions_without_a_unique_answer_are_gaps():
    """A rigid stretch turns about its first support until the wheel has 1.5, the fixed-end moment beside it, there; then it rests
    on three rigid supports, until the wheel has left."""
    made = {
        "beam": {"spans": [2.0, 2.0, 2.0], "EI": [1.0, float("inf"), float("inf")]},
        "supports": [{"node": 0}, *({"node": i, "side": "below"} for i in (1, 2, 3))],
        "loads": [{"type": "force", "x": 1.0, "F": 4.0, "case": "dead"}],
        "trains": [{"axles": [[0.0, 5.0]]}],
    }
    train = gapbeam.solve(made).trains["train 1"]
    (gap,) = train.unstable_positions
    assert (gap.from_, gap.to) == pytest.approx((2.3, 6.0), rel=1e-14)
    assert gap.reason == "no unique answer: a rigid stretch rests on more rigid supports than statics can tell apart"
    assert train.envelope().supports[1]["reaction"]["max"].value == pytest.approx(7.75, rel=1e-14)
    made["trains"][0]["both_directions"] = True
    assert [gap.direction for gap in gapbeam.solve(made).trains["train 1"].unstable_positions] == ["right", "left"]


def test_a_beam_that_slides_stands_at_no_position():
    made = two_spans(loads=[{"type": "axial", "node": 1, "F": 1.0}, {"type": "uniform", "q": 1.0}])
    made["beam"]["EA"] = 1.0
    made["supports"].append({"node": 0, "direction": "axial", "stiffness": 0.0})
    crane = gapbeam.solve(made).trains["crane"]
    (gap,) = crane.unstable_positions
    assert (gap.from_, gap.to) == (0.0, 1.0)
    assert gap.reason == "no equilibrium: the beam slides along its axis, no axial support holds it"
    assert crane.envelope().extremes["moment"]["max"] is None


def test_a_law_that_holds_both_ways_resists_both_ways():
    """The motion is the one that the loads can bring about, so the gap ends where it does no work: 20 (9 - x) = 0.5 9**2/2."""
    supports = [at(0, side="below"), at(1, side="below"), at(2, law=[(0.005, 20.0), (0.03, 60.0)])]
    made = scene([6.0, 3.0], supports, [uniform(0.5, case="dead")]) | {"trains": [{"name": "t", "axles": [[0.0, -20.0]]}]}
    (gap,) = gapbeam.solve(made).trains["t"].unstable_positions
    assert (gap.from_, gap.to) == (0.0, pytest.approx(7.9875, rel=1e-14))
    assert "tips about the support at x = 9" in gap.reason


def test_names():
    with pytest.raises(gapbeam.SceneError, match=r'trains\[1\]\.name: trains\[0\] has the name "a" already'):
        gapbeam.solve(two_spans(trains=[{"name": "a", "axles": [[0.0, 1.0]]}] * 2))


def test_trains_in_combinations():
    """A train acts where its case has a factor, on the beam as the combination loads it; the envelope is that of all."""
    made = two_spans(
        trains=[{"name": "crane", "axles": [[0.0, 8.0]], "to": 1.0, "case": "crane"}, {"axles": [[0.0, 1.0]], "case": "cart"}],
        combinations=[
            {"name": "alone", "factors": {"dead": 5.0}},
            {"name": "half", "factors": {"dead": 1.0, "crane": 0.5}, "settlements": {1: 0.01}},
            {"name": "full", "factors": {"dead": 1.0, "crane": 1.0}},
        ],
    )
    result = gapbeam.solve(made)
    crane = result.combinations["full"].trains
    assert list(crane) == ["crane"]
    assert [e.position for e in crane["crane"].events] == [e.position for e in gapbeam.solve(two_spans()).trains["crane"].events]
    assert not result.combinations["alone"].trains
    envelope = result.envelope()
    assert [(m.combination, m.train) for m in envelope._members] == [("alone", None), ("half", "crane"), ("full", "crane")]
    parts = [result.combinations[name].envelope() for name in result.names]
    for quantity, row in envelope.extremes.items():
        assert row["max"].value == max(part.extremes[quantity]["max"].value for part in parts)
        assert row["min"].value == min(part.extremes[quantity]["min"].value for part in parts)
    least = envelope.extremes["moment"]["min"]
    assert (least.combination, least.train, least.value) == ("alone", None, pytest.approx(-0.625))
    assert least.state.reaction[1] == pytest.approx(6.25)
    half = envelope.supports[1]["deflection"]["max"]
    assert (half.combination, half.value) == ("half", pytest.approx(0.01))
    curves = result.envelope(x=[1.0, 0.5]).fields
    assert curves.smallest["moment"][0] == least.value
    assert np.isnan(curves.smallest_at["moment"][0])
    data = json.loads(to_json(result))
    assert [(train["name"], train["combination"]) for train in data["trains"]] == [("crane", "half"), ("crane", "full")]
    assert data["envelope"]["extremes"]["moment"]["min"][2]["combination"] == "alone"
    assert "full" in report_text(result)
    with pytest.raises(ValueError, match="3 combinations"):
        _ = result.trains
    made["combinations"][1]["expand"] = {"crane": "signs"}
    with pytest.raises(gapbeam.SceneError, match="trains have no patterns"):
        gapbeam.solve(made)


def test_concurrent_values():
    """What else there is where a value governs: the state there, solved with the axles as forces."""
    envelope = gapbeam.solve(two_spans()).envelope()
    largest = envelope.extremes["moment"]["max"]
    there = largest.state.fields(largest.x, largest.side or "right")
    assert float(there.moment) == pytest.approx(largest.value, rel=1e-13)
    assert largest.concurrent["deflection"] == float(there.deflection)
    opening = envelope.supports[2]["opening"]["max"]
    assert opening.state.opening[2] == pytest.approx(opening.value, rel=1e-12)
    assert opening.concurrent["reaction"] == 0.0


@pytest.mark.parametrize("power", [-20, -36, -40, -44])
def test_tips_at_the_very_end(power):
    """So little before the end that its length in doubles is a few units in the last place of the position."""
    made = two_spans(
        beam={"spans": [2.0, 1.0], "EI": 1.0}, supports=[{"node": i, "side": "below"} for i in range(2)],
        trains=[{"name": "train", "axles": [[0.0, 1.5], [0.5, 2.0**power]]}],
    )  # fmt: skip
    # About the support at 2: the weight holds with 3/2, the second axle pushes with 2**power*(position - 5/2)
    first = 3.0 - 2.0**power / 3.0
    gaps = gapbeam.solve(made).trains["train"].unstable_positions
    assert (gaps[0].from_, gaps[0].to) == pytest.approx((first, 3.0), abs=1e-12) if gaps else 3.0 - first < 1e-12


@pytest.mark.parametrize(
    ("train", "same"),
    [
        ({"axles": [[0.0, 0.0], [0.5, 0.0]]}, {"axles": [[0.0, 0.0]], "from": 5.0, "to": 6.0}),
        ({"axles": [[0.0, 1e-9]]}, {"axles": [[0.0, 0.0]]}),
        ({"axles": [[0.0, 8.0], [0.5, 0.0]]}, {"axles": [[0.0, 8.0]]}),
    ],
)
def test_what_moves_without_a_force_changes_nothing(train, same):
    # Extreme values that stay the same while cells get longer were searched for without end
    found, expected = (gapbeam.solve(two_spans(trains=[one])).envelope().extremes for one in (train, same))
    for name, kinds in expected.items():
        for kind, extreme in kinds.items():
            assert found[name][kind].value == pytest.approx(extreme.value, rel=1e-8, abs=1e-12), (name, kind)


def test_deflections_at_rigid_supports_are_their_levels():
    """They were off by rounding where they are largest or smallest."""
    supports = [at(0, side="below"), at(1, side="below", gap=0.0067), at(2, side="below", settlement=-0.003), at(3, side="above")]
    made = scene([6.0, 5.0, 4.0], supports, [uniform(3.0, case="dead")], EI=1e4)
    made["trains"] = [{"name": "t", "axles": [[0.0, 60.0], [1.7, 80.0]]}]
    envelope = gapbeam.solve(made).envelope(x=[0.0, 6.0, 11.0, 15.0])
    largest = [one["deflection"]["max"].value for one in envelope.supports]
    assert largest[:3] == [0.0, 0.0067, -0.003]
    assert envelope.supports[3]["deflection"]["min"].value == 0.0
    assert envelope.fields.largest["deflection"].tolist()[:3] == largest[:3]


def test_light_trains_beside_great_loads():
    """Searched for along the line on which a field is nearly the same, this took minutes."""
    made = scene([6.0, 6.0], [at(i) for i in range(3)], [uniform(6e11, case="dead")], EI=1e4)
    made["trains"] = [{"name": "t", "axles": [[0.0, 60.0], [2.5, 80.0]]}]
    result = gapbeam.solve(made)
    envelope, train = result.envelope(), result.trains["t"]
    moment = envelope.extremes["moment"]
    assert 0.0 < moment["max"].value - 9 / 128 * 6e11 * 6.0**2 < (60.0 + 80.0) * 6.0 / 4
    for position in (-1.0, 0.0, 1.3, 2.7, 6.0, 8.9, 12.0):
        assert max(train.state(position).result._pairs_of_extremes()["moment"]["max"]) <= moment["max"].value * (1 + 4e-15)


def test_the_end_of_the_beam_as_the_sum_of_its_spans() -> None:
    """A sum that rounding puts beyond the end is at the end, as it is for `at`."""
    spans = [7.29, 6.17, 6.01]
    scene = {
        "beam": {"spans": spans, "EI": 1e4},
        "supports": [{"node": node} for node in range(4)],
        "loads": [{"type": "uniform", "q": 1.0}],
        "trains": [{"name": "axle", "axles": [[0.0, 1.0]]}],
    }
    result = gapbeam.solve(scene)
    end = gapbeam.prepare(scene | {"trains": []}).node_x[-1]
    beyond = np.nextafter(end, 99.0)
    assert result.at(beyond).moment == pytest.approx(0.0, abs=1e-12)
    assert result.envelope(x=[end]).fields.largest["shear"] == result.envelope(x=[beyond]).fields.largest["shear"]
    line = result.trains["axle"].influence("moment", x=beyond, position=3.0, places=[beyond])
    assert line.values == pytest.approx(0.0, abs=1e-12)
    with pytest.raises(ValueError, match=r"x: the beam goes from 0 to 19\.47, got 19\.5"):
        result.envelope(x=[19.5])


def test_old_names_warn():
    train = gapbeam.solve(simple(10.0, (0.0, 1.0))).trains["train 1"]
    with pytest.warns(DeprecationWarning, match="called traversals"):
        assert train.ways == train.traversals
    for one in (train, train.envelope()):
        with pytest.warns(DeprecationWarning, match="called unstable_positions"):
            assert one.gaps == one.unstable_positions == []


@pytest.mark.parametrize("live", [0.0, 2.0])
def test_curves_of_a_combination_in_the_state_of_another(live):
    """Its beam is cut at other places, since loads that do not act there are no loads of it."""
    taking = {"name": "takes", "factors": {"dead": 1.0, "wind": 1.0} | ({"live": live} if live else {}), "scheme_of": "leads"}
    result = gapbeam.solve({
        "beam": {"spans": [6.0, 6.0], "EI": 1e4}, "supports": [{"node": i, "side": "below"} for i in range(3)],
        "loads": [{"type": "uniform", "q": 5.0, "case": "dead"},
                  {"type": "uniform", "from": 1.0, "to": 2.0, "q": 1.0, "case": "snow"},
                  {"type": "force", "x": 3.5, "F": 80.0, "case": "wind"}],
        "trains": [{"name": "t", "axles": [[0.0, 6.0]]}],
        "combinations": [{"name": "leads", "factors": {"dead": 1.0, "live": 1.0, "snow": 1.0}}, taking],
    })  # fmt: skip
    largest = result.envelope().extremes["moment"]["max"]
    assert (largest.combination, largest.x) == ("takes", 3.5)
    places = np.linspace(0.1, 11.9, 60)
    curves, alone = result.envelope(x=[*places, 3.5]).fields, result.combinations["takes"].envelope(x=[*places, 3.5]).fields
    assert curves.largest["moment"][-1] == pytest.approx(largest.value, rel=1e-12)
    for name in ("moment", "deflection", "rotation"):
        both = result.combinations["leads"].envelope(x=[*places, 3.5]).fields.largest[name]
        np.testing.assert_allclose(curves.largest[name], np.maximum(both, alone.largest[name]), rtol=1e-9, atol=1e-12)


def test_a_curve_that_begins_steep_is_met_where_it_acts():
    """Next to where it begins its deflection hardly grows: it lifted off 1.3e-7 before the train had let go of it."""
    law = {"type": "power", "d0": 0.0015, "limit": 8.0, "n": 0.5}
    made = {
        "beam": {"spans": [6.0, 6.0, 4.0, 5.0], "EI": 6.4e4}, "trains": [{"name": "axle", "axles": [[0.0, 50.0]]}],
        "supports": [{"node": 0}, {"node": 1, "side": "below", "gap": 0.002, "law": law}, {"node": 2}, {"node": 4}],
    }  # fmt: skip
    train = gapbeam.solve(made).trains["axle"]
    assert [event.event for event in train.events] == ["closes", "opens"]
    for event, way in zip(train.events, (1, -1), strict=True):
        outside, inside = (train.state(event.position + way * d).reaction[1] for d in (-1e-11, 1e-11))
        assert outside == 0.0 < inside
