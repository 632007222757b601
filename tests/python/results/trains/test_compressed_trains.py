"""Trains over compressed beams that may have several stable states: closed forms of snapping, states solved one by one."""

import pickle

import gapbeam
import mpmath as mp
import numpy as np
import pytest
from gapbeam.html.page import html_page
from gapbeam.plots import figure
from gapbeam.report import report_text
from matplotlib.text import Text

GAP = 0.02


def strut(compression, dead, force, **train):
    """A strut of length 2 between two stops in its middle; compression beside that which it bears without them."""
    stops = [{"node": 1, "side": side, "gap": GAP} for side in ("below", "above")]
    return {
        "beam": {"spans": [1.0, 1.0], "EI": 1.0, "N": -compression * np.pi**2 / 4},
        "supports": [{"node": 0}, *stops, {"node": 2}],
        "loads": [{"type": "uniform", "q": dead, "case": "dead"}],
        "trains": [{"name": "man", "axles": [[0.0, force]], **train}],
    }


def rail(thrust, **train):
    """A heated rail on ballast that cannot pull, over three sleepers that hang."""
    ballast = {"k": 3e4, "side": "below"}
    wheels = {"name": "bogie", "axles": [[0.0, 112.5], [1.8, 112.5]], "from": 8.0, "to": 14.0}
    return {
        "beam": {"spans": [20.0], "EI": 6415.0, "N": -thrust},
        "supports": [{"node": 0}, {"node": 1}],
        "foundation": [
            {**ballast, "to": 9.0}, {**ballast, "k": 1.5e4, "gap": 5e-4, "from": 9.0, "to": 10.8}, {**ballast, "from": 10.8},
        ],
        "loads": [{"type": "uniform", "q": 1.25, "case": "dead"}],
        "trains": [{**wheels, **train}],
    }  # fmt: skip


def standing(scene, position):
    """The same with the wheels as loads that stay."""
    (train,) = scene["trains"]
    wheels = [{"type": "force", "x": position - offset, "F": force} for offset, force in train["axles"]]
    return gapbeam.solve({**scene, "trains": [], "loads": [*scene["loads"], *wheels]})


def position_of_snapping(compression, dead, force, side, first):
    """Where the stop on a side (1 below, -1 above) does not push any more: simple beam under compression, in 40 digits."""
    with mp.workdps(40):
        thrust = mp.mpf(float(compression * np.pi**2 / 4))
        k = mp.sqrt(thrust)

        def in_the_middle(at):
            at = min(at, 2 - at)
            return (mp.sin(k * at) * mp.sin(k) / (k * mp.sin(2 * k)) - at / 2) / thrust

        load = mp.mpf(dead) * ((1 / mp.cos(k) - 1) / thrust**2 - 1 / (2 * thrust))
        return float(mp.findroot(lambda at: mp.mpf(force) * in_the_middle(at) + load - side * mp.mpf(GAP), first))


@pytest.mark.parametrize(
    ("compression", "dead", "force", "snaps"),
    [
        (1.2, -0.01, 0.05, [(-1, 0.5)]), (1.5, -0.1, 0.3, [(-1, 0.4), (1, 1.86)]),
        (2.5, -0.1, 0.6, [(-1, 0.33)]), (1.5, -0.1, 0.1, []),
    ],
)  # fmt: skip
def test_a_strut_snaps_where_a_stop_does_not_push_any_more(compression, dead, force, snaps):
    result = gapbeam.solve(strut(compression, dead, force))
    events = result.trains["man"].events
    # The stop below (support 1) is numbered before the one above
    words = {-1: ["closes", "opens"], 1: ["opens", "closes"]}
    assert [event.event for event in events] == [word for side, _ in snaps for word in words[side]]
    expected = [position_of_snapping(compression, dead, force, *one) for one in snaps for _ in range(2)]
    assert [event.position for event in events] == pytest.approx(expected, abs=2e-13)


def test_states_and_extremes_are_those_to_which_the_train_comes():
    scene = strut(1.5, -0.1, 0.3)
    result = gapbeam.solve(scene)
    man, envelope = result.trains["man"], result.envelope(x=[1.0])
    # Put on at 0.4 the force presses the strut down; on its way it comes when that is up, and leaves it so
    assert standing(scene, 0.4).at([1.0]).deflection[0] == pytest.approx(GAP, rel=1e-12)
    deflections = [man.state(at).fields([1.0]).deflection[0] for at in (0.4, 0.45, 1.8, 1.9)]
    assert deflections == pytest.approx([-GAP, GAP, GAP, -GAP], rel=1e-12)
    again = pickle.loads(pickle.dumps(man.state(0.4)))
    assert again.fields([1.0]).deflection[0] == pytest.approx(-GAP, rel=1e-12)
    for quantity in ("moment", "deflection", "shear"):
        for which in ("max", "min"):
            extreme = envelope.extremes[quantity][which]
            there = man.state(extreme.position).result
            values = [getattr(there.at([extreme.x], side=side), quantity)[0] for side in ("left", "right")]
            assert min(abs(value - extreme.value) for value in values) < 1e-12
    ends = [envelope.fields.largest["deflection"][0], envelope.fields.smallest["deflection"][0]]
    assert ends == pytest.approx([GAP, -GAP], rel=1e-12)
    assert "until the beam snaps" in " ".join(report_text(result).split())
    assert "the one to which the train comes" in " ".join(report_text(man.state(0.4).result).split())
    assert "until the beam snaps" in html_page(result)


def test_the_way_back_is_refused_where_it_would_be_another_one():
    with pytest.raises(gapbeam.SceneError, match=r"man goes to the left .* compression lets snap .* mirror the beam"):
        gapbeam.solve(strut(1.5, -0.1, 0.3, both_directions=True))
    with pytest.raises(gapbeam.SceneError, match="goes to the left"):
        gapbeam.solve(rail(2500.0, axles=[[0.0, -40.0]], both_directions=True))
    both = gapbeam.solve(strut(1.5, -0.1, 0.1, both_directions=True)).trains["man"]
    assert both.state(1.0, "left").fields([1.0]).deflection[0] == pytest.approx(-GAP, rel=1e-12)


def test_a_heated_rail_under_a_bogie():
    scene = rail(1500.0, both_directions=True)
    result = gapbeam.solve(scene)
    assert result.status == "solved"
    assert not result.steps[-1].unique
    envelope = result.envelope(x=np.linspace(0.5, 19.5, 20).tolist())
    for quantity in ("moment", "deflection", "pressure"):
        for which in ("max", "min"):
            extreme = envelope.extremes[quantity][which]
            if extreme.direction == "right":
                there = standing(scene, extreme.position).at([extreme.x])
                assert getattr(there, quantity)[0] == pytest.approx(extreme.value, rel=1e-10, abs=1e-12)
    for position in (8.3, 9.77, 11.0, 13.9):
        there = standing(scene, position).at(envelope.fields.x)
        assert (there.moment <= envelope.fields.largest["moment"] + 1e-9).all()
        assert (there.moment >= envelope.fields.smallest["moment"] - 1e-9).all()
    # Going left the first wheel is where the last one was; the ways have 9.8 to 14 in common
    events = result.trains["bogie"].events
    right = [one.position for one in events if one.direction == "right" and one.position > 9.8]
    left = [one.position + 1.8 for one in events[::-1] if one.direction == "left" and one.position < 12.2]
    assert left == pytest.approx(right, abs=1e-9)
    assert len(right) > 3
    assert any("bogie, N \N{MINUS SIGN}1500" in text.get_text() for text in figure(result).findobj(Text))
    cold = gapbeam.solve(rail(0.0)).envelope()
    assert envelope.extremes["moment"]["max"].value > cold.extremes["moment"]["max"].value


def test_a_rail_buckles_where_a_train_lifts_it():
    scene = rail(2500.0, axles=[[0.0, -40.0]])
    train = gapbeam.solve(scene).trains["bogie"]
    assert [gap.status for gap in train.unstable_positions] == ["buckles"] * len(train.unstable_positions)
    assert train.unstable_positions
    for gap in train.unstable_positions:
        for inside, outside in ((gap.from_ + 1e-6, gap.from_ - 1e-6), (gap.to - 1e-6, gap.to + 1e-6)):
            assert standing(scene, inside).status == "buckles"
            if 8.0 < outside < 14.0:
                assert standing(scene, outside).status == "solved"
