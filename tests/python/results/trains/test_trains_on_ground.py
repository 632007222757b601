"""Trains on foundations and over smooth laws: closed forms, states solved one by one, the exact road where both hold."""

import json
import pickle
from math import cos, exp, sin

import gapbeam
import numpy as np
import pytest
from gapbeam.cli import main
from gapbeam.plots import figure
from gapbeam.report import report_text, to_csv, to_json
from oracle import foundation

from .test_trains import loads_of

STIFFNESS, MODULUS, FORCE = 100.0, 6.4, 8.0
BETA = (MODULUS / (4 * STIFFNESS)) ** 0.25


def long_beam(length=90.0, **train):
    """A beam on ground that holds both ways, so long that its ends are not felt in the middle."""
    train = {"axles": [[0.0, FORCE]], "from": length / 2 - 0.5, "to": length / 2 + 0.5} | train
    return {"beam": {"spans": [length], "EI": STIFFNESS}, "foundation": [{"k": MODULUS}], "trains": [train]}


def rail(**changes):
    """A rail on ground that cannot pull, with a stop below it."""
    made = {
        "beam": {"spans": [12.0], "EI": 200.0},
        "supports": [{"x": 7.0, "side": "below", "stiffness": 300.0, "gap": 0.01, "name": "stop"}],
        "foundation": [{"k": 60.0, "side": "below", "name": "ballast"}],
        "loads": [{"type": "uniform", "q": 0.5, "case": "dead"}],
        "trains": [{"name": "bogie", "axles": [[0.0, 10.0], [1.5, 10.0]]}],
    }
    return {**made, **changes}


def tipping():
    """Ground under the middle of a plank only: it stands while the resultant of weight and force is on it."""
    return {
        "beam": {"spans": [10.0], "EI": 500.0},
        "foundation": [{"from": 4.0, "to": 6.0, "k": 40.0, "side": "below"}],
        "loads": [{"type": "uniform", "q": 1.0, "case": "dead"}],
        "trains": [{"name": "man", "axles": [[0.0, 5.0]]}],
    }


def test_a_force_on_a_long_beam():
    result = gapbeam.solve(long_beam())
    train = result.trains["train 1"]
    assert train.events == train.unstable_positions == []
    extremes = train.envelope().extremes
    assert extremes["moment"]["max"].value == pytest.approx(FORCE / (4 * BETA), rel=1e-13)
    assert extremes["moment"]["max"].x == pytest.approx(extremes["moment"]["max"].position, rel=1e-12)
    assert extremes["moment"]["min"].value == pytest.approx(-exp(-np.pi / 2) * FORCE / (4 * BETA), rel=1e-12)
    assert extremes["deflection"]["max"].value == pytest.approx(FORCE * BETA / (2 * MODULUS), rel=1e-13)
    assert extremes["pressure"]["max"].value == pytest.approx(FORCE * BETA / 2, rel=1e-13)
    assert [abs(extreme.value) for extreme in extremes["shear"].values()] == pytest.approx([FORCE / 2] * 2, rel=1e-13)
    for distance in (0.0, 1.0, 3.7):
        a = BETA * distance
        lines = {"moment": exp(-a) * (cos(a) - sin(a)) / (4 * BETA), "pressure": BETA / 2 * exp(-a) * (cos(a) + sin(a))}
        for what, value in lines.items():
            found = train.influence(what, x=45.0, position=45.2, places=[45.0 - distance, 45.0 + distance]).values
            assert found == pytest.approx([value, value], abs=1e-13)
    # What passes a place makes there at most what it makes anywhere
    curves = train.envelope(x=[45.1]).fields
    assert curves.largest["moment"] == pytest.approx([FORCE / (4 * BETA)], rel=1e-13)
    assert curves.largest_at["moment"] == pytest.approx([45.1], rel=1e-13)


def test_a_force_comes_onto_a_free_end():
    """It acts with its whole force at once: at the end twice as much as a force inside, and four times the deflection."""
    envelope = gapbeam.solve(long_beam(length=60.0, to=1.0, **{"from": -1.0})).trains["train 1"].envelope()
    largest = envelope.extremes["deflection"]["max"]
    assert (largest.value, largest.x, largest.position) == (pytest.approx(2 * FORCE * BETA / MODULUS, rel=1e-13), 0.0, 0.0)
    assert envelope.extremes["shear"]["min"].value == pytest.approx(-FORCE, rel=1e-13)
    assert envelope.foundations[0]["resultant"]["max"].value == pytest.approx(FORCE, rel=1e-13)
    before = envelope.foundations[0]["resultant"]["min"]
    assert before.value == pytest.approx(0.0, abs=1e-13)
    assert before.position < 0.0


def test_where_a_plank_tips():
    result = gapbeam.solve(tipping())
    first, last = result.trains["man"].unstable_positions
    assert (first.from_, first.to, last.from_, last.to) == pytest.approx((0.0, 2.0, 8.0, 10.0), abs=1e-8)
    assert "the beam tips about x = 4" in first.reason
    # Next to these positions hardly a zone is left, and values grow without bound
    assert result.envelope().extremes["pressure"]["max"].value > 1e6
    assert (result.envelope().fields.smallest["pressure"] >= 0.0).all()
    with pytest.raises(ValueError, match="position: no equilibrium at position 9 of train man"):
        result.trains["man"].state(9.0)


def assert_nothing_beyond(made, result, positions, x):
    """States solved one by one are never beyond the envelope."""
    (train,) = made["trains"]
    found = result.trains["train 1"] if "name" not in train else result.trains[train["name"]]
    envelope = found.envelope(x=x)
    curves, end = envelope.fields, float(result.scene.span_ends()[-1])
    for way in found.traversals:
        course = way.course
        for position in (course.from_, course.to, *(course.from_ + (course.to - course.from_) * np.asarray(positions))):
            loads = [*made["loads"], *loads_of(train, position, course.direction, end)]
            state = gapbeam.solve({**made, "loads": loads, "trains": []})
            inside = any(gap.from_ <= position <= gap.to for gap in way.unstable_positions)
            assert (state.status != "solved" or state.steps[-1].indifferent) == inside
            if inside:
                continue
            for name, row in state._pairs_of_extremes().items():
                high, low = envelope.extremes[name]["max"], envelope.extremes[name]["min"]
                slack = 1e-12 * max(abs(high.value), abs(low.value))
                assert low.value - slack <= row["min"][0] <= row["max"][0] <= high.value + slack
                for side in ("left", "right"):
                    values = getattr(state.at(x, side=side), name)
                    assert (curves.smallest[name] - slack <= values).all()
                    assert (values <= curves.largest[name] + slack).all()
            for k, row in enumerate(envelope.supports):
                high, low = row["reaction"]["max"].value, row["reaction"]["min"].value
                slack = 1e-12 * max(abs(high), abs(low))
                assert low - slack <= state.steps[-1].reaction[k] <= high + slack
    for name, row in envelope.extremes.items():
        for kind, extreme in row.items():
            value = found.state(extreme.position, extreme.direction).extremes[name][kind].value
            # Beside a support a little away from it
            assert value == pytest.approx(extreme.value, rel=1e-6 if name == "shear" else 1e-11, abs=1e-12 * abs(row["max"].value))


SCENES = {
    "rail": rail(),
    "layers": rail(
        beam={"spans": [5.0, 7.0], "EI": 200.0, "hinges": [6.0]},
        supports=[{"node": 0}, {"node": 2, "side": "below", "gap": -0.002}],
        foundation=[{"k": 20.0, "side": "below", "to": 9.0}, {"from": 3.0, "law": [[0.05, 2.0], [0.2, 4.0]], "side": "below"}],
        trains=[{"axles": [[0.0, 6.0]], "q": [[-0.5, 2.5, 1.0]], "factor": 1.2, "both_directions": True}],
    ),
    "smooth": rail(
        beam={"spans": [4.0, 4.0, 4.0], "EI": 200.0},
        supports=[
            {"node": 0, "side": "below"}, {"node": 3, "side": "below"},
            {"node": 1, "side": "below", "gap": 0.002, "law": {"type": "tanh", "stiffness": 400.0, "limit": 15.0}},
            {"node": 2, "law": {"type": "hyperbolic", "stiffness": 400.0, "limit": 15.0}},
        ],
        foundation=[],
    ),
    "pads": rail(
        beam={"spans": [4.0, 4.0, 4.0], "EI": 200.0},
        supports=[
            {"node": 0, "side": "below"}, {"node": 3, "side": "below"},
            {"node": 1, "side": "below", "gap": 0.002, "law": {"type": "cubic", "k1": 100.0, "k3": 1e5}},
            {"node": 2, "law": {"type": "hyperbolic", "stiffness": 400.0, "limit": 15.0}},
        ],
        foundation=[{"k": 8.0, "side": "below", "gap": 0.001, "from": 2.0, "to": 7.0}],
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", SCENES)
def test_nothing_is_beyond_the_envelope(name):
    positions = np.random.default_rng(len(name)).uniform(size=10)
    assert_nothing_beyond(SCENES[name], gapbeam.solve(SCENES[name]), positions, np.array([0.0, 2.3, 5.0, 7.0, 12.0]))


def test_the_smallest_between_two_states_of_the_grid():
    """Where zones are born beside it, as a search among states nowhere farther than 1e-4 from the next one finds it."""
    made = SCENES["layers"]
    train = gapbeam.solve({**made, "trains": [made["trains"][0] | {"both_directions": False}]}).trains["train 1"]
    curves = train.envelope(x=[1.75]).fields
    at = curves.smallest_at["deflection"][0]
    found = min(train.at([1.75], position=position).deflection[0] for position in np.linspace(at - 2e-3, at + 2e-3, 41))
    assert curves.smallest["deflection"][0] == pytest.approx(found, rel=1e-9)
    assert curves.smallest["deflection"][0] <= found * (1 + 1e-13)
    assert found < 0.00744342


@pytest.mark.parametrize("pull", [{}, {"N": 30.0}], ids=["plain", "tension"])
def test_a_law_that_is_nearly_a_line(pull):
    """Beside the polynomials in the position for a spring; under tension beside what a spring makes of states."""
    def beam(support):
        support = {"node": 1, "side": "below", "gap": 0.01, **support}
        return gapbeam.solve(rail(beam={"spans": [6.0, 6.0], "EI": 200.0, **pull}, foundation=[],
                                  supports=[{"node": 0, "side": "below"}, support, {"node": 2, "side": "below"}]))  # fmt: skip

    line, curve = beam({"stiffness": 90.0}), beam({"law": {"type": "tanh", "stiffness": 90.0, "limit": 1e9}})
    events, others = line.trains["bogie"].events, curve.trains["bogie"].events
    assert [(event.support, event.event) for event in events] == [(event.support, event.event) for event in others]
    assert [event.position for event in events] == pytest.approx([event.position for event in others], abs=1e-11)
    one, other = line.envelope(), curve.envelope()
    for name, row in one.extremes.items():
        for kind, extreme in row.items():
            assert other.extremes[name][kind].value == pytest.approx(extreme.value, rel=1e-11)
        for found, true in ((other.fields.largest, one.fields.largest), (other.fields.smallest, one.fields.smallest)):
            assert found[name] == pytest.approx(true[name], abs=1e-11 * np.abs(true[name]).max())
    for row, true in zip(other.supports, one.supports, strict=True):
        assert row["reaction"]["max"].value == pytest.approx(true["reaction"]["max"].value, rel=1e-11)
    asked = {"x": 6.0, "position": 5.0, "places": [2.0, 6.0]}
    lines = [result.trains["bogie"].influence("reaction", **asked).values for result in (line, curve)]
    assert lines[1] == pytest.approx(lines[0], rel=1e-11)


def test_beside_the_oracle():
    made = rail()
    found = gapbeam.solve(made).envelope().extremes["moment"]["max"]
    train = made.pop("trains")[0]
    loads = [*made["loads"], *loads_of(train, found.position, "right", 12.0)]
    answer = foundation.solve({**made, "loads": loads})
    assert float(answer.solution.at(found.x, "left")[2]) == pytest.approx(found.value, rel=1e-12)


def test_events():
    result = gapbeam.solve(rail())
    train = result.trains["bogie"]
    happens = {(event.support, event.foundation, event.event) for event in train.events}
    assert {(0, None, "closes"), (0, None, "opens"), (None, 0, "end leaves"), (None, 0, "end reaches")} <= happens
    closes = next(event for event in train.events if event.event == "closes")
    assert train.state(closes.position - 1e-6).state == ("open",)
    assert train.state(closes.position + 1e-6).state == ("closed",)
    assert train.state(closes.position).reaction[0] == pytest.approx(0.0, abs=1e-10)
    # The mirrored train meets the mirrored events in the same order
    mirrored = rail(supports=[{**rail()["supports"][0], "x": 5.0}], trains=[{**rail()["trains"][0], "both_directions": True}])
    back = gapbeam.solve(mirrored).trains["bogie"].traversals[1]
    assert [(event.support, event.event) for event in back.events] == [(event.support, event.event) for event in train.events]
    assert [12.0 - event.position for event in back.events] == pytest.approx([event.position for event in train.events], abs=1e-9)


def test_where_zones_meet():
    """As the oracle has it, to 40 digits; the place is that of the highest point of the gap as it closes."""
    train = gapbeam.solve(rail(supports=[], trains=[{"axles": [[0.0, 10.0]]}])).trains["train 1"]
    first, last = (event for event in train.events if event.event in ("zones merge", "zone splits"))
    assert (first.position, 12.0 - last.position) == pytest.approx([0.30114185288453195] * 2, abs=3e-14)
    assert (first.x, 12.0 - last.x) == pytest.approx([4.857325820506625] * 2, abs=3e-9)


def test_outputs(tmp_path):
    result = gapbeam.solve(rail(trains=[{**rail()["trains"][0], "from": 3.0, "to": 5.0}]))
    data = json.loads(to_json(result))
    assert result.to_dict() == data
    (train,) = data["trains"]
    event = next(event for event in train["events"] if "foundation" in event)
    assert (event["foundation"], event["name"]) == (0, "ballast")
    (ballast,) = data["envelope"]["foundations"]
    value, source = ballast["free_span"]["longest"]
    assert source["to"] - source["from"] == pytest.approx(value)
    state = result.envelope().foundations[0]["free_span"]["longest"].state
    assert max(span.to - span.from_ for span in state.free_spans) == pytest.approx(value, rel=1e-12)
    assert "pressure" in data["envelope"]["extremes"]
    text = report_text(result)
    assert "Free spans while trains pass" in text
    assert "ground ballast: " in text
    assert ",pressure_max,pressure_min," in to_csv(result).splitlines()[0]
    assert len(figure(result).axes) == 5
    again = pickle.loads(pickle.dumps(result))
    assert again.trains["bogie"].events == result.trains["bogie"].events
    assert again.envelope().extremes == result.envelope().extremes
    (tmp_path / "plank.json").write_text(json.dumps({**tipping(), "trains": [{"axles": [[0.0, 5.0]], "from": 7.5, "to": 9.0}]}))
    assert main(["run", str(tmp_path / "plank.json"), "--quiet"]) == 1


def test_combinations_and_trains_together():
    trains = [{"name": "a", "axles": [[0.0, 8.0]], "case": "a"},
              {"name": "both", "together": [["a", 0.0], ["a", 2.0]], "case": "b"}]  # fmt: skip
    made = rail(trains=trains, combinations=[{"name": "one", "factors": {"dead": 1.0, "a": 1.5}},
                                             {"name": "two", "factors": {"dead": 1.2, "b": 1.0}, "settlements": {"stop": 0.02}},
                                             {"name": "none", "factors": {"dead": 3.0}}])  # fmt: skip
    result = gapbeam.solve(made)
    assert [list(one.trains) for one in result.combinations.values()] == [["a"], ["both"], []]
    alone = rail(trains=[{"axles": [[0.0, 12.0]]}])
    largest = result.combinations["one"].envelope().extremes["moment"]["max"]
    assert largest.value == pytest.approx(gapbeam.solve(alone).envelope().extremes["moment"]["max"].value, rel=1e-12)
    envelope = result.envelope()
    assert envelope.foundations[0]["resultant"]["max"].combination == "two"
    assert envelope.foundations[0]["resultant"]["min"].combination in ("one", "two", "none")
    assert envelope.extremes["moment"]["max"].value >= largest.value


def test_what_is_refused():
    with pytest.raises(gapbeam.SceneError, match=r"trains: the train train 1 would take states at .* give from and to"):
        gapbeam.solve(long_beam(length=9e4, **{"from": 0.0, "to": 9e4}))
    curved = rail(foundation=[{"law": {"type": "tanh", "stiffness": 60.0, "limit": 9.0}, "side": "below"}],
                  trains=[{"axles": [[0.0, 10.0]], "from": 5.0, "to": 5.1}])  # fmt: skip
    train = gapbeam.solve(curved).trains["train 1"]
    with pytest.raises(ValueError, match="position: foundation 0 acts by a curve there; influence lines need straight laws"):
        train.influence("moment", x=5.0, position=5.0)


def test_without_its_trains_a_beam_has_no_unique_answer():
    """The message is about the beam that stays, of which a train may know nothing."""
    beam = {"spans": [2.0, 2.0, 4.0], "EI": float("inf")}
    supports = [{"node": 0}, {"node": 1, "side": "below"}, {"node": 2, "side": "below"}]
    made = {"beam": beam, "supports": supports, "loads": [{"type": "uniform", "q": 0.1, "to": 4.0}],
            "trains": [{"axles": [[0.0, 10.0]], "from": 6.0, "to": 7.0}]}  # fmt: skip
    with pytest.raises(gapbeam.EngineError, match=r"^without its trains a rigid stretch .* finite stiffness$"):
        gapbeam.solve(made)


def test_each_side_of_an_end_of_a_foundation_is_a_place_of_its_own():
    """Pressure jumps where the modulus does; an axle there makes on either side what that side's ground takes."""
    made = rail(supports=[], foundation=[{"k": 60.0, "to": 6.0}, {"k": 15.0, "from": 6.0}],
                trains=[{"axles": [[0.0, 10.0]], "from": 5.5, "to": 6.5}])  # fmt: skip
    curves = gapbeam.solve(made).envelope().fields
    left, right = np.flatnonzero(curves.x == 6.0)
    largest = curves.largest["pressure"]
    assert largest[right] == pytest.approx(largest[left] / 4, rel=1e-9)


def test_a_support_at_an_end_of_the_ground_acts_from_where_the_zone_comes_to_it():
    """Both begin at one deflection, and next to it the support bears no more than rounding."""
    made = {"beam": {"spans": [4.0], "EI": 1000.0}, "supports": [{"node": 0}, {"node": 1, "side": "below"}],
            "foundation": [{"k": 2000.0, "side": "below"}],
            "trains": [{"axles": [[0.0, 10.0]]}]}  # fmt: skip
    train = gapbeam.solve(made).trains["train 1"]
    of_support, of_zone = train.events
    assert (of_support.support, of_support.event, of_zone.event) == (1, "closes", "end reaches")
    assert of_support.position == of_zone.position
    states = [gapbeam.solve(made | {"trains": [], "loads": [{"type": "force", "x": x, "F": 10.0}]}).steps[-1].state[1]
              for x in (of_support.position - 1e-6, of_support.position + 1e-6)]  # fmt: skip
    assert states == ["open", "closed"]


def test_the_place_of_a_couple_is_none_between_two_states():
    """Beside ground that holds next to nothing the exact road knows it."""
    made = {"beam": {"spans": [4.0], "EI": 4000.0}, "supports": [{"node": 0}, {"node": 1}],
            "loads": [{"type": "moment", "x": 1.418, "M": 4.0, "case": "dead"}],
            "trains": [{"axles": [[0.0, 3.8], [0.55, 2.9], [2.05, 4.9]]}]}  # fmt: skip
    exact = gapbeam.solve(made).envelope().extremes["moment"]["max"]
    found = gapbeam.solve(made | {"foundation": [{"k": 1e-9}]}).envelope().extremes["moment"]["max"]
    assert (found.value, found.x, found.position) == pytest.approx((exact.value, exact.x, exact.position), rel=1e-12)


@pytest.mark.parametrize(("rotation", "instead"), [
    ({"side": "clockwise"}, "free"), ({"side": "counterclockwise"}, "fixed"), ({"slack": 0.1}, "free"),
])  # fmt: skip
def test_influence_lines_beside_restraints_that_are_open(rotation, instead):
    """They hold nothing then, or as a clamp does."""
    made = {
        "beam": {"spans": [6.0, 6.0], "EI": 1e4}, "foundation": [{"k": 500.0}], "trains": [{"name": "t", "axles": [[0.0, 20.0]]}],
        "supports": [{"node": 0}, {"node": 1}, {"node": 2}], "loads": [{"type": "uniform", "q": 2.0, "case": "dead"}],
    }  # fmt: skip

    def line(rotation):
        supports = [{"node": 0, "rotation": rotation}, *made["supports"][1:]]
        return gapbeam.solve(made | {"supports": supports}).trains["t"].influence("moment", x=3.0, position=2.0).values

    assert line(rotation) == pytest.approx(line(instead), rel=1e-12, abs=1e-15)
